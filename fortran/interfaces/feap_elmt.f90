!> The contact element as user element of FEAP and FEAPpv. `hdata.h` and `comblk.h` are files of those programs.
!>
!>     MATErial,1
!>       USER,1
!>       r rb E Eb nu nub rho rhob penalty value     (see litz_user_element; barred first)
!>       normal spot axis voltage                    (numbers of the laws)
!>
!> Control data: 3 space dimensions, 7 unknowns for each node, 4 nodes for each element. The tangent is unsymmetric:
!> UTANgent. FEAP adds the components of rotation vectors, which must stay below a full turn.
subroutine elmt01(d, ul, xl, ix, tl, s, r, ndf, ndm, nst, isw)
   use litz_kinds, only: dp
   use litz_user_element, only: user_contact, n_history, n_properties, n_options, option_rotations, contact_active
   implicit none
   include 'hdata.h'
   include 'comblk.h'
   !> Unknowns of each node
   integer, intent(in) :: ndf
   !> Space dimensions
   integer, intent(in) :: ndm
   !> Unknowns of the element: 28
   integer, intent(in) :: nst
   !> What is asked for
   integer, intent(in) :: isw
   !> Numbers of the nodes (4)
   integer, intent(in) :: ix(*)
   !> Material data: properties, then options
   real(dp), intent(inout) :: d(*)
   !> Unknowns (ndf, nodes, kinds); kind 1: totals of the present iterate [m, rad, V]
   real(dp), intent(in) :: ul(ndf, nst/ndf, *)
   !> Positions of the nodes before loading (ndm, nodes) [m]
   real(dp), intent(in) :: xl(ndm, *)
   !> Temperatures of the nodes (nodes), not used
   real(dp), intent(in) :: tl(*)
   !> Tangent (nst, nst)
   real(dp), intent(inout) :: s(nst, nst)
   !> Minus the residual (nst) [N, N m, A]
   real(dp), intent(inout) :: r(nst)
   integer, parameter :: read_data = 1, tangent_and_residual = 3, residual = 6
   logical, external :: tinput
   character(len=15) :: unused(1)
   real(dp) :: k(28, 28), internal(28), history(n_history), options(n_options)
   integer :: info

   select case (isw)
   case (read_data)
      if (tinput(unused, 0, d, n_properties)) error stop 'contact element: 10 properties are needed'
      if (tinput(unused, 0, options, n_options - 1)) error stop 'contact element: 4 options are needed'
      options(option_rotations) = 1
      d(n_properties + 1:n_properties + n_options) = options
      nh1 = n_history
   case (tangent_and_residual, residual)
      history = hr(nh1:nh1 + n_history - 1)
      call user_contact(xl(1:3, 1:4), ul(1:7, 1:4, 1), d(:n_properties), &
         nint(d(n_properties + 1:n_properties + n_options)), history, k, internal, info)
      if (info < contact_active) error stop 'contact element: the wires overlap where they are parallel'
      hr(nh2:nh2 + n_history - 1) = history
      r(:28) = -internal
      if (isw == tangent_and_residual) s(:28, :28) = k
   end select
end subroutine elmt01
