!> The overlap of a contact at a given force: the inverse of its normal law, whatever kind of contact it is.
module litz_overlap_of_force
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_point_t
   use litz_cut_forces, only: kept_part
   use litz_law_input, only: wire_pair_t
   use litz_lens_forces, only: find_overlap_of_lens
   use litz_lens_law, only: lens_t
   use litz_line_law, only: line_overlap_t, line_overlap
   use litz_normal_forces, only: is_lens, first_overlap
   use litz_normal_law, only: normal_law_t, overlap_of_force_t, overlap_at_force
   use litz_round_end, only: end_force_t, force_of_end
   use litz_yielding_lens, only: lens_at_force
   use litz_yielding_place, only: place_state_t, overlap_of_place
   use litz_yielding_wires, only: lens_of_wires
   implicit none
   private
   public :: overlap_of_point

   !> Newton's method on the force of a place stops at this part of it
   real(dp), parameter :: tolerance = 1.0e-12_dp
   integer, parameter :: max_iterations = 50

contains

   !> The overlap of a point at a force, and its stiffness.
   pure type(overlap_of_force_t) function overlap_of_point(law, pair, point, force, weight) result(found)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> Greater than 0 [N], and the share of a crossing [-] or the length of a line [m] that carries it
      real(dp), intent(in) :: force, weight
      type(line_overlap_t) :: line
      type(place_state_t) :: place
      real(dp) :: share

      if (point%line_place > 0 .and. law%yields()) then
         call overlap_of_place(point%yielding_place, force/weight, found%overlap, place, found%delastic_dforce)
         found%stiffness = place%stiffness
         found%elastic_stiffness = place%elastic_stiffness
      else if (point%line_place > 0) then
         if (point%lap%round_end%hertz > 0) then
            found = overlap_of_end(law, point, force, weight)
            return
         end if
         line = line_overlap(point%line, force/weight, law%line_penalty())
         found = overlap_of_force_t(line%overlap, line%stiffness, line%dstiffness_dforce)
      else if (is_lens(law, point)) then
         share = weight*kept_part(point)
         if (law%yields()) then
            found = lens_at_force(lens_of_wires(law, pair, point), force/share)
         else
            found = overlap_of_lens(law, pair, point, force/share)
         end if
         found%stiffness = share*found%stiffness
         found%elastic_stiffness = share*found%elastic_stiffness
         return
      else
         found = overlap_at_force(law, force/weight, pair, point%ellipse, point%history%dent%at_any_angle())
      end if
      found%stiffness = weight*found%stiffness
      found%elastic_stiffness = weight*found%elastic_stiffness
   end function overlap_of_point

   !> A place with the round end of its wire: the force per length of the line by Newton's method, from where the line
   !> would have it all.
   pure type(overlap_of_force_t) function overlap_of_end(law, point, force, weight) result(found)
      type(normal_law_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point
      !> [N], and the length of the line [m]
      real(dp), intent(in) :: force, weight
      type(line_overlap_t) :: line
      type(end_force_t) :: of_end
      real(dp) :: density, excess
      integer :: i

      density = force/weight
      do i = 1, max_iterations
         line = line_overlap(point%line, density, law%line_penalty())
         of_end = force_of_end(point%lap%round_end, line%overlap)
         excess = weight*density + of_end%force - force
         found%stiffness = weight*line%stiffness + of_end%stiffness
         if (abs(excess) <= tolerance*force) exit
         density = max(density/10, density - excess*line%stiffness/found%stiffness)
      end do
      found%overlap = line%overlap
      found%dstiffness_dforce = (weight*line%stiffness*line%dstiffness_dforce + of_end%dstiffness)/found%stiffness
   end function overlap_of_end

   !> The force of a lens goes with a power of the overlap, which hardly changes: with the exponent `k delta/F` the
   !> stiffness `k` changes by `(k - F/delta)/F`.
   pure type(overlap_of_force_t) function overlap_of_lens(law, pair, point, force) result(found)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> [N]
      real(dp), intent(in) :: force
      type(lens_t) :: lens

      call find_overlap_of_lens(point%line, point%law_sine, law%line_penalty(), force, &
         max(-point%gap, first_overlap*minval(pair%radius)), found%overlap, lens)
      found%stiffness = -lens%dforce_dgap
      found%dstiffness_dforce = (found%stiffness - force/found%overlap)/force
   end function overlap_of_lens

end module litz_overlap_of_force
