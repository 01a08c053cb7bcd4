!> Where the wire of an element overlaps a rigid surface.
!>
!> The gap along the axis is followed from place to place; every minimum between two places is looked up, so that a
!> short overlap is found as well as a long one.
module litz_surface_overlap
   use litz_kinds, only: dp
   use litz_rigid_surface, only: rigid_surface_t, surface_distance
   implicit none
   private
   public :: surface_overlap_t, find_surface_overlap, gap_at

   !> Places along the element at which the gap is looked at
   integer, parameter :: n_grid = 17
   !> Most parts of an element that overlap the surface
   integer, parameter :: most_parts = n_grid
   !> Halvings of the distance of two places: to round-off
   integer, parameter :: n_halvings = 52

   type :: surface_overlap_t
      !> Parts of the element that overlap, in order: first and last place of each
      integer :: n = 0
      real(dp) :: first(most_parts) = 0, last(most_parts) = 0
      !> Place of the smallest gap, and that gap [m]
      real(dp) :: nearest = 0, gap = huge(1.0_dp)
   end type surface_overlap_t

contains

   pure subroutine find_surface_overlap(surface, p, radius, overlap)
      type(rigid_surface_t), intent(in) :: surface
      !> Axis in powers of xi (3, 0:3) [m], from `axis_polynomial`
      real(dp), intent(in) :: p(3, 0:3)
      !> Of the wire [m]
      real(dp), intent(in) :: radius
      type(surface_overlap_t), intent(out) :: overlap
      real(dp) :: place(2*n_grid), gap(2*n_grid)
      integer :: i, n

      call list_places(surface, p, radius, place, gap, n)
      i = minloc(gap(:n), 1)
      overlap%nearest = place(i)
      overlap%gap = gap(i)
      if (overlap%gap >= 0) return
      associate (first => overlap%first, last => overlap%last, parts => overlap%n)
         if (gap(1) < 0) then
            parts = 1
            first(1) = place(1)
         end if
         do i = 2, n
            if (gap(i) < 0 .and. gap(i - 1) >= 0) then
               parts = parts + 1
               first(parts) = place_of_touch(surface, p, radius, place(i), place(i - 1))
            else if (gap(i) >= 0 .and. gap(i - 1) < 0) then
               last(parts) = place_of_touch(surface, p, radius, place(i - 1), place(i))
            end if
         end do
         if (gap(n) < 0) last(parts) = place(n)
      end associate
   end subroutine find_surface_overlap

   !> Evenly spaced places and the minima between them, in order.
   pure subroutine list_places(surface, p, radius, place, gap, n)
      type(rigid_surface_t), intent(in) :: surface
      !> Axis in powers of xi (3, 0:3) [m]
      real(dp), intent(in) :: p(3, 0:3)
      !> Of the wire [m]
      real(dp), intent(in) :: radius
      !> Places and gaps [m] there (n)
      real(dp), intent(out) :: place(:), gap(:)
      !> How many there are
      integer, intent(out) :: n
      real(dp) :: xi, slope, slope_before, unused_slope
      integer :: i

      n = 0
      slope_before = 0
      do i = 1, n_grid
         xi = -1 + 2*real(i - 1, dp)/(n_grid - 1)
         n = n + 1
         place(n) = xi
         call gap_at(surface, p, radius, xi, gap(n), slope)
         if (slope_before < 0 .and. slope > 0) then
            place(n + 1) = place(n)
            gap(n + 1) = gap(n)
            place(n) = place_of_minimum(surface, p, radius, place(n - 1), xi)
            call gap_at(surface, p, radius, place(n), gap(n), unused_slope)
            n = n + 1
         end if
         slope_before = slope
      end do
   end subroutine list_places

   !> Gap at a place, and how it changes along the element.
   pure subroutine gap_at(surface, p, radius, xi, gap, slope)
      type(rigid_surface_t), intent(in) :: surface
      !> Axis in powers of xi (3, 0:3) [m]
      real(dp), intent(in) :: p(3, 0:3)
      !> Of the wire [m], and the place
      real(dp), intent(in) :: radius, xi
      !> [m], and its derivative by xi [m]
      real(dp), intent(out) :: gap, slope
      real(dp) :: normal(3)

      call surface_distance(surface, p(:, 0) + xi*(p(:, 1) + xi*(p(:, 2) + xi*p(:, 3))), gap, normal)
      gap = gap - radius
      slope = dot_product(normal, p(:, 1) + xi*(2*p(:, 2) + xi*3*p(:, 3)))
   end subroutine gap_at

   !> Between a place with a falling gap and one with a rising gap.
   pure real(dp) function place_of_minimum(surface, p, radius, falling, rising) result(xi)
      type(rigid_surface_t), intent(in) :: surface
      !> Axis in powers of xi (3, 0:3) [m]
      real(dp), intent(in) :: p(3, 0:3)
      !> Of the wire [m], and the two places
      real(dp), intent(in) :: radius, falling, rising
      real(dp) :: low, high, gap, slope
      integer :: i

      low = falling
      high = rising
      do i = 1, n_halvings
         xi = (low + high)/2
         call gap_at(surface, p, radius, xi, gap, slope)
         if (slope < 0) low = xi
         if (slope >= 0) high = xi
      end do
   end function place_of_minimum

   !> Between a place that overlaps and one that does not.
   pure real(dp) function place_of_touch(surface, p, radius, inside, outside) result(xi)
      type(rigid_surface_t), intent(in) :: surface
      !> Axis in powers of xi (3, 0:3) [m]
      real(dp), intent(in) :: p(3, 0:3)
      !> Of the wire [m], and the two places
      real(dp), intent(in) :: radius, inside, outside
      real(dp) :: low, high, gap, slope
      integer :: i

      low = inside
      high = outside
      do i = 1, n_halvings
         xi = (low + high)/2
         call gap_at(surface, p, radius, xi, gap, slope)
         if (gap < 0) low = xi
         if (gap >= 0) high = xi
      end do
   end function place_of_touch

end module litz_surface_overlap
