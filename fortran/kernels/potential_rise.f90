!> Potential inside a conducting element above the linear one, where currents enter it between its nodes.
!>
!> Source: theory section 7. Ohm's law of a straight conductor whose ends keep their potentials: Green's function
!> `rho L0/(4 A) (1 + xi_<)(1 - xi_>)` of the second derivative, with `xi_<` and `xi_>` the smaller and the larger
!> place.
module litz_potential_rise
   use litz_kinds, only: dp
   implicit none
   private
   public :: potential_rise, moved_rise

contains

   !> `rise_i = s sum_j (1 + min(xi_i, xi_j)) (1 - max(xi_i, xi_j)) I_j`; one pass up and one down.
   pure subroutine potential_rise(scale, xi, current, rise)
      !> s = rho L0/(4 A) [ohm]
      real(dp), intent(in) :: scale
      !> Places (n) in [-1, 1], ascending, and the currents that enter there (n) [A]
      real(dp), intent(in) :: xi(:), current(:)
      !> (n) [V]
      real(dp), intent(out) :: rise(:)
      real(dp) :: moment
      integer :: i

      moment = 0
      do i = 1, size(xi)
         moment = moment + (1 + xi(i))*current(i)
         rise(i) = scale*(1 - xi(i))*moment
      end do
      moment = 0
      do i = size(xi), 1, -1
         rise(i) = rise(i) + scale*(1 + xi(i))*moment
         moment = moment + (1 - xi(i))*current(i)
      end do
   end subroutine potential_rise

   !> How this rise changes as the places move.
   pure subroutine moved_rise(scale, xi, dxi, current, rise)
      !> s = rho L0/(4 A) [ohm]
      real(dp), intent(in) :: scale
      !> Places (n) in [-1, 1], ascending, and by how much they move (n); the currents that enter there (n) [A]
      real(dp), intent(in) :: xi(:), dxi(:), current(:)
      !> (n) [V]
      real(dp), intent(out) :: rise(:)
      real(dp) :: moment, moved
      integer :: i

      moment = 0
      moved = 0
      do i = 1, size(xi)
         moment = moment + (1 + xi(i))*current(i)
         moved = moved + dxi(i)*current(i)
         rise(i) = scale*((1 - xi(i))*moved - dxi(i)*moment)
      end do
      moment = 0
      moved = 0
      do i = size(xi), 1, -1
         rise(i) = rise(i) + scale*(dxi(i)*moment - (1 + xi(i))*moved)
         moment = moment + (1 - xi(i))*current(i)
         moved = moved + dxi(i)*current(i)
      end do
   end subroutine moved_rise

end module litz_potential_rise
