!> Potential inside a conducting element above the linear one, where currents enter it between its nodes; or its
!> temperature, where heat does.
!>
!> Source: theory section 7. Ohm's law of a straight conductor whose ends keep their potentials: Green's function
!> `rho L0/(4 A) (1 + xi_<)(1 - xi_>)` of the second derivative, with `xi_<` and `xi_>` the smaller and the larger
!> place. Where a film takes heat between the nodes, the factors are those of the fin (section 13).
module litz_potential_rise
   use litz_fin, only: fin_parts, fin_growth
   use litz_kinds, only: dp
   implicit none
   private
   public :: potential_rise, moved_rise

contains

   !> `rise_i = s sum_j (1 + min(xi_i, xi_j)) (1 - max(xi_i, xi_j)) I_j`; one pass up and one down.
   pure subroutine potential_rise(scale, w2, xi, current, rise)
      !> s = rho L0/(4 A) [ohm] or L0/(4 lambda A) [K/W], and w^2 of the film; 0: there is none
      real(dp), intent(in) :: scale, w2
      !> Places (n) in [-1, 1], ascending, and what enters there (n) [A], [W]
      real(dp), intent(in) :: xi(:), current(:)
      !> (n) [V], [K]
      real(dp), intent(out) :: rise(:)
      real(dp) :: factor(2), unused(2), moment
      integer :: i

      moment = 0
      do i = 1, size(xi)
         call find_factors(w2, xi(i), factor, unused)
         moment = moment + factor(2)*current(i)
         rise(i) = scale*factor(1)*moment
      end do
      moment = 0
      do i = size(xi), 1, -1
         call find_factors(w2, xi(i), factor, unused)
         rise(i) = rise(i) + scale*factor(2)*moment
         moment = moment + factor(1)*current(i)
      end do
      if (w2 > 0) rise = fin_growth(w2)*rise
   end subroutine potential_rise

   !> How this rise changes as the places move.
   pure subroutine moved_rise(scale, w2, xi, dxi, current, rise)
      !> s = rho L0/(4 A) [ohm] or L0/(4 lambda A) [K/W], and w^2 of the film; 0: there is none
      real(dp), intent(in) :: scale, w2
      !> Places (n) in [-1, 1], ascending, and by how much they move (n); what enters there (n) [A], [W]
      real(dp), intent(in) :: xi(:), dxi(:), current(:)
      !> (n) [V], [K]
      real(dp), intent(out) :: rise(:)
      real(dp) :: factor(2), slope(2), moment, moved
      integer :: i

      moment = 0
      moved = 0
      do i = 1, size(xi)
         call find_factors(w2, xi(i), factor, slope)
         moment = moment + factor(2)*current(i)
         moved = moved + slope(2)*dxi(i)*current(i)
         rise(i) = scale*(factor(1)*moved + slope(1)*dxi(i)*moment)
      end do
      moment = 0
      moved = 0
      do i = size(xi), 1, -1
         call find_factors(w2, xi(i), factor, slope)
         rise(i) = rise(i) + scale*(slope(2)*dxi(i)*moment + factor(2)*moved)
         moment = moment + factor(1)*current(i)
         moved = moved + slope(1)*dxi(i)*current(i)
      end do
      if (w2 > 0) rise = fin_growth(w2)*rise
   end subroutine moved_rise

   !> `1 - xi` and `1 + xi` (2), and their derivatives by the place; under a film what stands for them.
   pure subroutine find_factors(w2, xi, factor, slope)
      !> w^2 of the film; 0: there is none
      real(dp), intent(in) :: w2
      !> Place
      real(dp), intent(in) :: xi
      !> (2)
      real(dp), intent(out) :: factor(2), slope(2)

      factor = [1 - xi, 1 + xi]
      slope = [-1, 1]
      if (.not. w2 > 0) return
      call fin_parts(w2, xi, factor, slope)
      factor = 2*factor
      slope = 2*slope
   end subroutine find_factors

end module litz_potential_rise
