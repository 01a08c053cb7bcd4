!> What wires that yield have from before where they touch: the law of a lens or of a place of a line, with the dents of
!> the largest force.
!>
!> Source: theory section 15.
module litz_yielding_wires
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_point_t
   use litz_hertz, only: hertz_ellipse
   use litz_law_input, only: wire_pair_t
   use litz_lens_law, only: smooth_step
   use litz_normal_law, only: normal_law_t
   use litz_yielding_lens, only: yielding_lens_t, with_dent
   use litz_yielding_line, only: yielding_line, line_dent, line_dent_t, line_state_t, line_state_at_overlap
   use litz_yielding_place, only: yielding_place_t
   use litz_yielding_spot, only: yielding_crossing
   implicit none
   private
   public :: lens_of_wires, place_of_wires, depth_of_lens, part_yielded

   !> Depth of a dent over the overlap that made it, from which on metal has yielded as a whole
   real(dp), parameter :: yielded = 0.25_dp

contains

   !> The lens of a crossing whose section counts.
   pure type(yielding_lens_t) function lens_of_wires(law, pair, point) result(lens)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> With its law per length
      type(contact_point_t), intent(in) :: point
      integer :: unused_info

      lens%strip = yielding_line(point%line, pair, spread(law%yield_stress, 1, 2), law%hardness, point%law_angle)
      call hertz_ellipse(pair%radius, pair%young, pair%poisson, point%law_angle, lens%ellipse, unused_info)
      call yielding_crossing(lens%ellipse, pair%poisson, spread(law%yield_stress, 1, 2), law%hardness, lens%spot, &
         unused_info)
      lens%sine = point%law_sine
      lens%strip_share = point%section_share
      lens = with_dent(lens, point%history%dent%at_any_angle())
   end function lens_of_wires

   !> A place of a line. In the lens of a crossing it has been pressed as deep as that tells, too.
   pure type(yielding_place_t) function place_of_wires(law, pair, point) result(place)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> With its law per length
      type(contact_point_t), intent(in) :: point
      type(line_state_t) :: made
      real(dp) :: largest

      place%strip = yielding_line(point%line, pair, spread(law%yield_stress, 1, 2), law%hardness, point%law_angle)
      largest = point%history%dent%felt_force()
      if (point%in_lens .and. point%deepest > point%lens_depth) then
         made = line_state_at_overlap(place%strip, line_dent_t(), point%deepest - point%lens_depth)
         largest = max(largest, made%force)
      end if
      place%dent = line_dent(place%strip, largest)
   end function place_of_wires

   !> Overlap beyond which a lens has a force [m].
   pure real(dp) function depth_of_lens(lens) result(depth)
      type(yielding_lens_t), intent(in) :: lens
      type(line_state_t) :: made
      type(line_dent_t) :: dent

      depth = 0
      if (.not. lens%deepest > 0) return
      made = line_state_at_overlap(lens%strip, line_dent_t(), lens%deepest)
      dent = line_dent(lens%strip, made%force)
      depth = dent%depth
      if (lens%strip_share < 1) depth = min(depth, lens%dent%depth)
   end function depth_of_lens

   !> How far the metal has yielded: from 0, elastic, to 1.
   elemental real(dp) function part_yielded(depth, deepest) result(part)
      !> Depth of the dent, and the overlap that made it [m]
      real(dp), intent(in) :: depth, deepest

      part = 0
      if (deepest > 0) part = smooth_step(depth/(yielded*deepest))
   end function part_yielded

end module litz_yielding_wires
