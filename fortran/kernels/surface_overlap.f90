!> Where the wire of an element overlaps a rigid surface.
!>
!> The gap along the axis is followed from place to place; every minimum and maximum between two places is looked up, so
!> that a short overlap, or a short gap within a long one, is found as well as a long one. A part that overlaps ends
!> where the gap has a maximum that is far less deep than the rest: where the wire begins to lift off there, the
!> integral of the forces over the parts changes without a jump.
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
   !> A maximum of the gap divides a part where the overlap has fallen to less than this of the deepest one; what varies
   !> less is smooth
   real(dp), parameter :: shallow = 0.9_dp
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
      logical :: is_top(2*n_grid)
      integer :: i, n

      call list_places(surface, p, radius, place, gap, is_top, n)
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
               first(parts) = place_of_change(surface, p, radius, .false., place(i), place(i - 1))
            else if (gap(i) >= 0 .and. gap(i - 1) < 0) then
               last(parts) = place_of_change(surface, p, radius, .false., place(i - 1), place(i))
            else if (is_top(i) .and. gap(i) < 0 .and. gap(i) > shallow*overlap%gap) then
               last(parts) = place(i)
               parts = parts + 1
               first(parts) = place(i)
            end if
         end do
         if (gap(n) < 0) last(parts) = place(n)
      end associate
   end subroutine find_surface_overlap

   !> Evenly spaced places, and the minima and maxima between them, in order.
   pure subroutine list_places(surface, p, radius, place, gap, is_top, n)
      type(rigid_surface_t), intent(in) :: surface
      !> Axis in powers of xi (3, 0:3) [m]
      real(dp), intent(in) :: p(3, 0:3)
      !> Of the wire [m]
      real(dp), intent(in) :: radius
      !> Places and gaps [m] there (n)
      real(dp), intent(out) :: place(:), gap(:)
      !> The gap is largest there (n)
      logical, intent(out) :: is_top(:)
      !> How many there are
      integer, intent(out) :: n
      real(dp) :: xi, slope, slope_before, unused_slope
      logical :: falls_again
      integer :: i

      n = 0
      slope_before = 0
      is_top = .false.
      do i = 1, n_grid
         xi = -1 + 2*real(i - 1, dp)/(n_grid - 1)
         n = n + 1
         place(n) = xi
         call gap_at(surface, p, radius, xi, gap(n), slope)
         falls_again = slope_before > 0 .and. slope <= 0
         if (falls_again .or. slope_before < 0 .and. slope > 0) then
            place(n + 1) = place(n)
            gap(n + 1) = gap(n)
            is_top(n) = falls_again
            if (falls_again) then
               place(n) = place_of_change(surface, p, radius, .true., xi, place(n - 1))
            else
               place(n) = place_of_change(surface, p, radius, .true., place(n - 1), xi)
            end if
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

   !> Where the gap, or its slope, changes its sign, by halving the way between two places.
   pure real(dp) function place_of_change(surface, p, radius, of_slope, negative, positive) result(xi)
      type(rigid_surface_t), intent(in) :: surface
      !> Axis in powers of xi (3, 0:3) [m]
      real(dp), intent(in) :: p(3, 0:3)
      !> Of the wire [m]
      real(dp), intent(in) :: radius
      !> Of the slope: its least gap; else where it touches
      logical, intent(in) :: of_slope
      !> A place where it is negative, and one where it is not
      real(dp), intent(in) :: negative, positive
      real(dp) :: low, high, gap, slope
      integer :: i

      low = negative
      high = positive
      do i = 1, n_halvings
         xi = (low + high)/2
         call gap_at(surface, p, radius, xi, gap, slope)
         if (merge(slope, gap, of_slope) < 0) then
            low = xi
         else
            high = xi
         end if
      end do
   end function place_of_change

end module litz_surface_overlap
