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
   !> Number of unknowns: 28
   integer, intent(in) :: ndofel
   !> Number of right-hand sides
   integer, intent(in) :: nrhs
   !> Number of entries of `svars`
   integer, intent(in) :: nsvars
   !> Number of real properties
   integer, intent(in) :: nprops
   !> Number of coordinates of a node
   integer, intent(in) :: mcrd
   !> Number of nodes: 4
   integer, intent(in) :: nnode
   !> Number of the type of element
   integer, intent(in) :: jtype
   !> Numbers of the step and of the increment
   integer, intent(in) :: kstep, kinc
   !> Number of the element
   integer, intent(in) :: jelem
   !> Number of the distributed load
   integer, intent(in) :: ndload
   !> Number of predefined fields
   integer, intent(in) :: npredf
   !> Rows of `rhs` and `du`
   integer, intent(in) :: mlvarx
   !> Number of distributed loads on the element
   integer, intent(in) :: mdload
   !> Number of integer properties
   integer, intent(in) :: njprop
   !> Right-hand side: minus the residual
   real(dp), intent(inout) :: rhs(mlvarx, *)
   !> Tangent: minus the derivative of the right-hand side
   real(dp), intent(inout) :: amatrx(ndofel, ndofel)
   !> History; at every call Abaqus gives those of the last converged state
   real(dp), intent(inout) :: svars(*)
   !> (2): elastic energy
   real(dp), intent(inout) :: energy(8)
   !> Real properties (nprops), see litz_user_element
   real(dp), intent(in) :: props(nprops)
   !> Positions of the nodes before loading (mcrd, nnode) [m]
   real(dp), intent(in) :: coords(mcrd, nnode)
   !> Displacements [m], rotation vectors [rad] and voltages [V] (ndofel), all of them totals
   real(dp), intent(in) :: u(ndofel)
   !> Their increments (mlvarx, nrhs)
   real(dp), intent(in) :: du(mlvarx, *)
   !> Rates of the unknowns (ndofel), first and second
   real(dp), intent(in) :: v(ndofel), a(ndofel)
   !> Time in the step and in all (2) [s]
   real(dp), intent(in) :: time(2)
   !> Time of the increment [s]
   real(dp), intent(in) :: dtime
   !> Parameters of the time integration
   real(dp), intent(in) :: params(*)
   !> Distributed loads (mdload, nrhs) and their increments
   real(dp), intent(in) :: adlmag(mdload, *), ddlmag(mdload, *)
   !> Predefined fields (2, npredf, nnode)
   real(dp), intent(in) :: predef(2, npredf, nnode)
   !> Time of the step [s]
   real(dp), intent(in) :: period
   !> Types of the distributed loads (mdload, nrhs)
   integer, intent(in) :: jdltyp(mdload, *)
   !> What kind of step it is, and what is asked for
   integer, intent(in) :: lflags(*)
   !> Integer properties (njprop): the options of litz_user_element
   integer, intent(in) :: jprops(njprop)
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
