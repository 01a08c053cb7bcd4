!> How far the overlap of a contact reaches along its wires, and what the end of a wire changes of its law.
!>
!> The overlap of a crossing falls from its middle as a parabola. Where it is cut by the end of a wire the cylinder has
!> its integral up to there, and the round end has the rest, so that a contact slides on to the round end without a
!> jump. Source: theory section 10.
module litz_contact_lens
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_point_t
   use litz_element_library, only: elements_t
   use litz_lens_law, only: smooth_step
   use litz_line_kinematics, only: lens_sine
   use litz_line_laps, only: distances_to_ends
   use litz_wires, only: wires_t
   implicit none
   private
   public :: has_lens, half_length_of, divide_at_ends, flatness, least_bend, wedge_length, deepest

   !> Sines of the angle between an axis and the surface of the other wire up to which they lie side by side, and from
   !> which on one runs into the other (5 and 15 degrees)
   real(dp), parameter :: flat_tilt = 0.0872_dp, steep_tilt = 0.2588_dp
   !> Overlap beyond which a lens counts as no longer, in smaller radii
   real(dp), parameter :: deepest = 0.02_dp
   !> Overlap at an end by which its length is told, at least, in distances of the axes
   real(dp), parameter :: least_overlap = 1.0e-5_dp
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

   !> `aW = sqrt(2 d delta)/s` of a crossing; from the end of a wire on that of a wedge [m].
   pure real(dp) function half_length_of(point, largest_overlap) result(half_length)
      !> With a lens
      type(contact_point_t), intent(in) :: point
      !> Overlap that counts at most [m]: iterates overlap deeply for a moment, which makes no lines of them
      real(dp), intent(in) :: largest_overlap
      real(dp) :: overlap

      overlap = max(0.0_dp, min(-point%gap, largest_overlap))
      if (any(point%held)) then
         associate (tilt => point%tilt(merge(2, 1, point%held(2))), bend => point%bend(merge(2, 1, point%held(2))))
            ! at first touch a tilt of round-off would tell lines from ends
            overlap = max(overlap, least_overlap*point%kinematics%distance)
            half_length = wedge_length(tilt, bend, overlap)
         end associate
      else
         half_length = sqrt(2*point%kinematics%distance*overlap)/lens_sine(point%kinematics)
      end if
   end function half_length_of

   !> How far an overlap reaches from the end of a wire on, where the distance grows:
   !> `2 delta/(t + sqrt(t^2 + 2 k delta))` [m].
   pure real(dp) function wedge_length(tilt, bend, overlap) result(length)
      !> t [-], k [1/m] and delta [m], which is positive
      real(dp), intent(in) :: tilt, bend, overlap
      real(dp) :: square

      square = tilt**2 + 2*bend*overlap
      length = huge(length)
      if (square > 0) length = 2*overlap/max(tilt + sqrt(square), tiny(square))
   end function wedge_length

   !> What the cylinders and the round ends of the two wires have of the force. What has been found for a closed contact
   !> stays until the forces balance.
   pure subroutine divide_at_ends(wires, elements, point)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(inout) :: point
      real(dp) :: overlap, sine, to_end, u
      integer :: side

      if (point%is_divided .or. point%gap >= 0 .or. .not. point%kinematics%distance > 0) return
      point%is_divided = .true.
      associate (pair => [point%element_bar, point%element], arc => [point%arc_bar, point%arc], &
         d => point%kinematics%distance)
         overlap = min(-point%gap, deepest*minval(elements%radius(pair)))
         sine = 1
         if (.not. any(point%held)) sine = max(lens_sine(point%kinematics), sin(point%kinematics%angle))
         do side = 1, 2
            to_end = distance_to_round_end(wires, elements, pair(side), arc(side))
            if (.not. point%held(side) .or. to_end > at_end*elements%length(pair(side))) then
               call divide(to_end*sine/sqrt(2*d*overlap), point%of_cylinder(side), point%of_end(side))
            else
               u = beyond_end(point%tilt(side), merge(1/d, point%bend(side), all(point%held)), overlap, &
                  minval(elements%radius(pair)))
               call divide(u, point%of_cylinder(side), point%of_end(side))
               point%of_cylinder(side) = flatness(point%tilt(side))*point%of_cylinder(side)
            end if
         end do
      end associate
      ! cylinders that are cut on both sides have nothing between their ends
      point%of_crossing = 1
      if (all(point%of_end > 0)) point%of_crossing = &
         smooth_step((sin(point%kinematics%angle) - flat_tilt)/(steep_tilt - flat_tilt))
   end subroutine divide_at_ends

   !> Length of wire to the nearer end of its wire at which nothing goes straight on [m].
   pure real(dp) function distance_to_round_end(wires, elements, e, arc) result(distance)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      !> Arc length along its wire [m]
      real(dp), intent(in) :: arc
      real(dp) :: to_ends(2)

      to_ends = distances_to_ends(wires, elements, e, arc)
      associate (first => wires%element(wires%first(wires%wire(e))), &
         last => wires%element(wires%first(wires%wire(e) + 1) - 1))
         if (wires%goes_on(merge(1, 2, wires%direction(first) > 0), first)) to_ends(1) = huge(distance)
         if (wires%goes_on(merge(2, 1, wires%direction(last) > 0), last)) to_ends(2) = huge(distance)
      end associate
      distance = minval(to_ends)
   end function distance_to_round_end

   !> The parts of cylinder and end, of the force that each would have with the overlap at the point. Of a parabola that
   !> is `1 - u^2` of its middle, the cylinder has the integral from the end on, `S = (2 + 3u - u^3)/4`; forces go with
   !> the power 3/2 of the overlap.
   pure subroutine divide(u, of_cylinder, of_end)
      !> From the end to the middle of the overlap, over its half length: positive on the wire, negative beyond its end
      real(dp), intent(in) :: u
      !> In parts of these forces
      real(dp), intent(out) :: of_cylinder, of_end
      real(dp) :: integral

      integral = smooth_step((1 + u)/2)                                                    ! S
      of_cylinder = integral
      of_end = 1 - integral
      if (abs(u) >= 1) return
      if (u > 0) of_end = of_end*(1 - u**2)**1.5_dp
      if (u < 0) of_cylinder = of_cylinder/(1 - u**2)**1.5_dp
   end subroutine divide

   !> u of a contact at the end of a wire, where the distance would be least beyond it, at `-t/k`, with the overlap
   !> `delta + t^2/(2 k)`.
   pure real(dp) function beyond_end(tilt, bend, overlap, radius) result(u)
      !> Slope [-] and curvature [1/m] of the distance along the wire, and overlap at the end [m]
      real(dp), intent(in) :: tilt, bend, overlap
      !> The smaller radius [m], over which a tilt of round-off makes no difference
      real(dp), intent(in) :: radius

      u = -tilt/sqrt(2*least_bend(bend, overlap, radius)*overlap + tilt**2)
   end function beyond_end

   !> Curvature of the distance along a wire from its end on, of an overlap that is no longer than a radius [1/m].
   pure real(dp) function least_bend(bend, overlap, radius)
      !> [1/m], [m], [m]
      real(dp), intent(in) :: bend, overlap, radius

      least_bend = max(bend, 2*overlap/radius**2)
   end function least_bend

   !> 1 where an axis lies along the surface of the other wire, 0 where it runs into it.
   pure real(dp) function flatness(tilt)
      !> Sine of the angle
      real(dp), intent(in) :: tilt

      flatness = 1 - smooth_step((tilt - flat_tilt)/(steep_tilt - flat_tilt))
   end function flatness

end module litz_contact_lens
