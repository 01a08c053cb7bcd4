!> Lenses that are parts of longer overlaps: the wires still overlap beyond them, or they reach into each other.
module litz_long_overlaps
   use litz_kinds, only: dp, pi
   use litz_contact_lens, only: has_lens, half_length_of, half_length_on
   use litz_contact_points, only: contact_set_t
   use litz_crossings_of_wires, only: crossings_of_wires_t
   use litz_element_library, only: elements_t
   use litz_lens_law, only: smooth_step
   use litz_wires, only: wires_t
   implicit none
   private
   public :: find_long_overlaps

   !> Half lengths of a lens from its crossing where it ends, and where what overlaps is none of it: the crest of a wave
   !> that closes altogether (see litz_crossings_of_wires)
   real(dp), parameter :: lens_ends = 1, goes_on = pi/2
   !> Part of the overlap of a crossing that makes the lens part of a longer overlap where it is left beyond the lens: a
   !> tenth of its force is
   real(dp), parameter :: counts_beyond = 0.25_dp

contains

   !> Crossings beyond whose lens the places next to it still overlap, or whose lens reaches into that of another one:
   !> gradually, as the lens and the overlaps beyond it change.
   subroutine find_long_overlaps(wires, elements, sorted, contact)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> The crossings of the set
      type(crossings_of_wires_t), intent(in) :: sorted
      type(contact_set_t), intent(inout) :: contact
      !> aW [m]; 0: no lens (n_points)
      real(dp) :: half_length(size(contact%points))
      real(dp) :: reach, distance, length
      integer :: i, nearest, legs(2)

      half_length = 0
      do i = 1, size(contact%points)
         associate (crossing => contact%points(i))
            if (crossing%gap < 0 .and. has_lens(crossing)) half_length(i) = half_length_of(crossing, huge(distance))
         end associate
      end do
      contact%points%long_share = 0
      call sorted%mark_common_lenses(wires, half_length, contact%points)
      do i = 1, size(contact%line_points)
         associate (point => contact%line_points(i), pair => [contact%line_points(i)%element_bar, &
            contact%line_points(i)%element])
            if (.not. point%gap < 0) cycle
            reach = sum(elements%length(pair))
            call sorted%find_nearest(wires, reach, reach, point, nearest, distance, legs)
            if (nearest == 0) cycle
            if (.not. half_length(nearest) > 0) cycle
            length = half_length(nearest)
            associate (crossing => contact%points(nearest))
               ! what goes on beyond a joint is as long as the leg there
               if (any(legs > 0) .and. .not. any(crossing%held)) cycle
               if (any(crossing%held)) length = half_length_on(crossing, crossing%legs(legs(1)), &
                  crossing%legs(legs(2)), huge(length))
               ! no overlap is shorter than that of round ends
               length = max(length, sqrt(-2*crossing%kinematics%distance*crossing%gap))
               crossing%long_share = max(crossing%long_share, smooth_step((distance/length - lens_ends) &
                  /(goes_on - lens_ends))*smooth_step(point%gap/(counts_beyond*crossing%gap)))
            end associate
         end associate
      end do
   end subroutine find_long_overlaps

end module litz_long_overlaps
