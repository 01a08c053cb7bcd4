!> The contact element as user element of Abaqus/Standard.
!>
!>     *USER ELEMENT, TYPE=U1, NODES=4, COORDINATES=3, PROPERTIES=10, I PROPERTIES=5, VARIABLES=6, UNSYMM
!>      1, 2, 3, 4, 5, 6, 9
!>     *UEL PROPERTY, ELSET=CONTACTS
!>      (8 real properties on a line, then the other 2, then the 5 integer ones; see litz_user_element)
!>
!> For static procedures. A pair of elements is one user element: all that may touch are listed in the input file.
subroutine uel(rhs, amatrx, svars, energy, ndofel, nrhs, nsvars, props, nprops, coords, mcrd, nnode, u, du, v, a, &
   jtype, time, dtime, kstep, kinc, jelem, params, ndload, jdltyp, adlmag, predef, npredf, lflags, mlvarx, ddlmag, &
   mdload, pnewdt, jprops, njprop, period)
   use litz_kinds, only: dp
   use litz_user_element, only: user_contact, n_history, history_energy, contact_active
   implicit none
   integer, intent(in) :: ndofel, nrhs, nsvars, nprops, mcrd, nnode, jtype, kstep, kinc, jelem, ndload, npredf, &
      mlvarx, mdload, njprop
   !> Right-hand side: minus the residual
   real(dp), intent(inout) :: rhs(mlvarx, *)
   !> Tangent: minus the derivative of the right-hand side
   real(dp), intent(inout) :: amatrx(ndofel, ndofel)
   !> History; at every call Abaqus gives those of the last converged state
   real(dp), intent(inout) :: svars(*)
   !> (2): elastic energy
   real(dp), intent(inout) :: energy(8)
   real(dp), intent(in) :: props(nprops), coords(mcrd, nnode), u(ndofel), du(mlvarx, *), v(ndofel), a(ndofel)
   real(dp), intent(in) :: time(2), dtime, params(*), adlmag(mdload, *), ddlmag(mdload, *), predef(2, npredf, nnode), &
      period
   integer, intent(in) :: jdltyp(mdload, *), lflags(*), jprops(njprop)
   !> Below 1: the increment is to be tried again, that much shorter
   real(dp), intent(inout) :: pnewdt
   !> lflags(3): what is asked for
   integer, parameter :: tangent_and_residual = 1, tangent = 2, residual = 5
   real(dp), parameter :: shorter = 0.5_dp
   real(dp) :: k(28, 28), r(28), history(n_history)
   integer :: info

   amatrx = 0
   rhs(:ndofel, :nrhs) = 0
   if (all(lflags(3) /= [tangent_and_residual, tangent, residual])) return
   history = svars(:n_history)
   call user_contact(coords(1:3, 1:4), reshape(u, [7, 4]), props, jprops, history, k, r, info)
   if (info < contact_active) then
      pnewdt = shorter
      return
   end if
   if (lflags(3) /= residual) amatrx = k
   if (lflags(3) == tangent) return
   rhs(:ndofel, 1) = -r
   svars(:n_history) = history
   energy(2) = history(history_energy)
end subroutine uel
