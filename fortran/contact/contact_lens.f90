!> How far the overlap of a contact reaches along its wires, and what the end of a wire changes of its law.
!>
!> The surface of a wire is curved across the axis alone, but for its round ends. Where the overlap reaches up to the end
!> the curvature along the axis counts in part, so that a contact slides from a crossing on to the round end without a
!> jump. Source: theory section 10.
module litz_contact_lens
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_point_t
   use litz_element_library, only: elements_t
   use litz_line_kinematics, only: lens_sine
   use litz_wires, only: wires_t
   implicit none
   private
   public :: has_lens, half_length_of, set_roundness, rounded_share, smooth_step, deepest

   !> Overlap beyond which a lens counts as no longer, in smaller radii
   real(dp), parameter :: deepest = 0.02_dp
   !> Nearer to an end than this part of its element is there
   real(dp), parameter :: at_end = 1.0e-9_dp

contains

   !> The overlap has an end, and its length is known.
   pure logical function has_lens(point)
      !> A crossing, or the contact of an end
      type(contact_point_t), intent(in) :: point

      has_lens = point%kinematics%distance > 0
      if (has_lens .and. .not. any(point%held)) has_lens = lens_sine(point%kinematics) > 0
   end function has_lens

   !> `aW = sqrt(2 d delta)/s` of a crossing; from the end of a wire on, where the distance grows with the slope `t`,
   !> `aW = 2 delta/(t + sqrt(t^2 + 2 k delta))` [m].
   pure real(dp) function half_length_of(point, largest_overlap) result(half_length)
      !> With a lens
      type(contact_point_t), intent(in) :: point
      !> Overlap that counts at most [m]: iterates overlap deeply for a moment, which makes no lines of them
      real(dp), intent(in) :: largest_overlap
      real(dp) :: overlap, square

      overlap = max(0.0_dp, min(-point%gap, largest_overlap))
      if (any(point%held)) then
         associate (tilt => point%tilt(merge(2, 1, point%held(2))), bend => point%bend(merge(2, 1, point%held(2))))
            square = tilt**2 + 2*bend*overlap
            half_length = merge(huge(half_length), 0.0_dp, overlap > 0)
            if (square > 0) half_length = 2*overlap/(tilt + sqrt(square))
         end associate
      else
         half_length = sqrt(2*point%kinematics%distance*overlap)/lens_sine(point%kinematics)
      end if
   end function half_length_of

   !> How round the surfaces are where they touch: not at all where the overlap does not reach up to the end of the wire,
   !> half where its middle is at the end, wholly where the wires would be nearest to each other so far beyond it that the
   !> overlap would end there. What has been found for a closed contact stays until the forces balance.
   pure subroutine set_roundness(wires, elements, point)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(inout) :: point
      real(dp) :: overlap, sine, to_end
      integer :: side

      if (point%is_rounded .or. point%gap >= 0 .or. .not. point%kinematics%distance > 0) return
      point%is_rounded = .true.
      point%roundness = 0
      associate (pair => [point%element_bar, point%element], arc => [point%arc_bar, point%arc], &
         d => point%kinematics%distance)
         overlap = min(-point%gap, deepest*minval(elements%radius(pair)))
         sine = 1
         if (.not. any(point%held)) sine = max(lens_sine(point%kinematics), sin(point%kinematics%angle))
         do side = 1, 2
            to_end = distance_to_end(wires, elements, pair(side), arc(side))
            if (.not. point%held(side) .or. to_end > at_end*elements%length(pair(side))) then
               point%roundness(side) = roundness_at(to_end, sine**2/d, overlap)
            else if (all(point%held)) then
               point%roundness(side) = roundness_beyond(point%tilt(side), 1/d, overlap)
            else
               point%roundness(side) = roundness_beyond(point%tilt(side), point%bend(side), overlap)
            end if
         end do
      end associate
   end subroutine set_roundness

   !> With the nearest place so far within the end of a wire.
   pure real(dp) function roundness_at(to_end, bend, overlap) result(roundness)
      !> [m], curvature of the distance [1/m], and overlap there [m]
      real(dp), intent(in) :: to_end, bend, overlap

      roundness = 0
      if (to_end < sqrt(2*overlap/bend)) roundness = 1 - smooth_step((1 + to_end/sqrt(2*overlap/bend))/2)
   end function roundness_at

   !> At the end of a wire, with the nearest place beyond it, at `-t/k`, with the overlap `delta + t^2/(2 k)` there.
   pure real(dp) function roundness_beyond(tilt, bend, overlap) result(roundness)
      !> Slope [-] and curvature [1/m] of the distance along the wire, and overlap at the end [m]
      real(dp), intent(in) :: tilt, bend, overlap

      roundness = 1
      if (bend > 0) roundness = roundness_at(-tilt/bend, bend, overlap + tilt**2/(2*bend))
   end function roundness_beyond

   !> Both surfaces as one: 0, cylinders, to 1.
   pure real(dp) function rounded_share(point)
      type(contact_point_t), intent(in) :: point

      rounded_share = 1 - product(1 - point%roundness)
   end function rounded_share

   !> Length of wire to the nearer end of its wire [m]; huge along a closed wire.
   pure real(dp) function distance_to_end(wires, elements, e, arc) result(distance)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      !> Arc length along its wire [m]
      real(dp), intent(in) :: arc

      distance = huge(distance)
      associate (w => wires%wire(e), last => wires%element(wires%first(wires%wire(e) + 1) - 1))
         if (.not. wires%circumference(w) > 0) distance = min(arc, wires%arc(last) + elements%length(last)/2 - arc)
      end associate
   end function distance_to_end

   !> 0 up to 0, 1 from 1 on, without a corner.
   elemental real(dp) function smooth_step(u)
      !> [-]
      real(dp), intent(in) :: u

      associate (v => max(0.0_dp, min(1.0_dp, u)))
         smooth_step = v**2*(3 - 2*v)
      end associate
   end function smooth_step

end module litz_contact_lens
