!> Where an axis overlaps a rigid plane: a wavy one, which lifts off between two lows.
program test_surface_overlap
   use litz_kinds, only: dp
   use litz_rigid_surface, only: rigid_surface_t
   use litz_surface_choices, only: surface_plane
   use litz_surface_overlap, only: surface_overlap_t, find_surface_overlap
   implicit none

   !> The gap is `4 xi^3 - 0.6 xi^2 - 2.97 xi + height`, largest at -0.45 between the places that are looked at
   real(dp), parameter :: top = -0.45_dp
   real(dp), parameter :: top_height = 4*top**3 - 0.6_dp*top**2 - 2.97_dp*top
   real(dp), parameter :: end_height = -4 - 0.6_dp + 2.97_dp
   real(dp), parameter :: radius = 1.0e-3_dp
   integer :: failures = 0

   call a_short_gap_within_a_long_contact_is_found()
   call a_part_ends_where_the_wire_is_about_to_lift_off()
   call a_deep_contact_is_one_part()
   call parts_change_without_a_jump_as_the_wire_lifts_off()
   if (failures > 0) error stop 1

contains

   !> The wire with its top at this height over the plane.
   type(surface_overlap_t) function overlap_of(height) result(overlap)
      real(dp), intent(in) :: height
      real(dp) :: p(3, 0:3)

      p = 0
      p(1, 1) = 1
      p(3, :) = [height - top_height + radius, -2.97_dp, -0.6_dp, 4.0_dp]
      call find_surface_overlap(rigid_surface_t(surface_plane, [0.0_dp, 0.0_dp, 0.0_dp], &
         [0.0_dp, 0.0_dp, 1.0_dp], 0.0_dp), p, radius, overlap)
   end function overlap_of

   !> Much shorter than the way between two places.
   subroutine a_short_gap_within_a_long_contact_is_found()
      real(dp), parameter :: height = 1.0e-4_dp
      type(surface_overlap_t) :: overlap
      real(dp) :: half

      overlap = overlap_of(height)
      ! near its top the gap is `height - 6 (xi - top)^2`
      half = sqrt(height/6)
      call check(overlap%n == 2, 'two parts')
      call check(abs(overlap%last(1) - (top - half)) < 0.02_dp*half, 'end of the first part')
      call check(abs(overlap%first(2) - (top + half)) < 0.02_dp*half, 'begin of the second part')
   end subroutine a_short_gap_within_a_long_contact_is_found

   subroutine a_part_ends_where_the_wire_is_about_to_lift_off()
      type(surface_overlap_t) :: overlap

      overlap = overlap_of(-1.0e-4_dp)
      call check(overlap%n == 2, 'two parts that meet')
      call check(abs(overlap%last(1) - top) < 1.0e-9_dp, 'the first ends at the top')
      call check(abs(overlap%first(2) - top) < 1.0e-9_dp, 'the second begins there')
      call check(abs(overlap%first(1) + 1) < 1.0e-9_dp, 'the first begins with the element')
      call check(abs(overlap%nearest + 1) < 1.0e-9_dp, 'the lowest place is there, too')
   end subroutine a_part_ends_where_the_wire_is_about_to_lift_off

   subroutine a_deep_contact_is_one_part()
      type(surface_overlap_t) :: overlap

      overlap = overlap_of(-30*(top_height - end_height))
      call check(overlap%n == 1, 'one part')
      call check(abs(overlap%first(1) + 1) < 1.0e-9_dp .and. abs(overlap%last(1) - 1) < 1.0e-9_dp, 'the whole element')
   end subroutine a_deep_contact_is_one_part

   !> Just above and just below the plane, ends differ by the width of the gap only.
   subroutine parts_change_without_a_jump_as_the_wire_lifts_off()
      type(surface_overlap_t) :: above, below

      above = overlap_of(1.0e-10_dp)
      below = overlap_of(-1.0e-10_dp)
      call check(above%n == below%n, 'as many parts')
      call check(maxval(abs(above%last(:2) - below%last(:2))) < 1.0e-5_dp, 'ends')
      call check(maxval(abs(above%first(:2) - below%first(:2))) < 1.0e-5_dp, 'begins')
   end subroutine parts_change_without_a_jump_as_the_wire_lifts_off

   subroutine check(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what

      if (holds) return
      failures = failures + 1
      print '(2a)', 'failed: ', what
   end subroutine check

end program test_surface_overlap
