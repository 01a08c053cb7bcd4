!> How far the overlap of a contact reaches along its wires, and what the end of a wire changes of its law.
!>
!> The overlap of a crossing falls from its middle as a parabola, which the end of a wire cuts: litz_cut_lens has the
!> energy that is left. Source: theory section 10.
module litz_contact_lens
   use litz_kinds, only: dp, pi
   use litz_axis_choices, only: axis_hermite
   use litz_bent_contacts, only: is_bent, bends_of, qualities_of
   use litz_bent_wires, only: bent_crossing_t
   use litz_closest_points, only: parallel_sine
   use litz_contact_points, only: contact_point_t, leg_t, is_contact_of
   use litz_cut_lens, only: cut_lens_t, flat_tilt, is_cut, steep_tilt
   use litz_element_library, only: elements_t
   use litz_end_places, only: place_at_end_t
   use litz_lens_law, only: smooth_step
   use litz_line_kinematics, only: sine_at_angle
   use litz_line_laps, only: distances_to_ends
   use litz_wires, only: wires_t
   implicit none
   private
   public :: has_lens, half_length_of, half_length_on, divide_at_ends, tells_shares, angle_of_axes, place_at_ends, &
      angle_of_law, sine_of_lens, sine_of_overlap, ends_of_wires, second_ends, is_at_cut_end, cut_ends, flatness, &
      least_bend, wedge_of, wedge_t, wedge_length, deepest, least_overlap, longest, small_sine, moderate_sine

   !> Sines of the angle between the axes up to which the lens alone gives the angle of the law, and from which on the
   !> axes do (5 and 10 degrees)
   real(dp), parameter :: small_sine = 0.0872_dp, moderate_sine = 0.1736_dp
   !> Below this cosine the angle of the law is a right one
   real(dp), parameter :: smallest_cosine = 1.0e-6_dp
   !> Part of the sine of a lens to which it falls at most as the wires turn within an iteration
   real(dp), parameter :: least_part = 0.5_dp
   !> Overlap over the distance of the axes that is no more than round-off
   real(dp), parameter :: near_round_off = 1.0e-12_dp
   !> Overlap beyond which a lens counts as no longer, in smaller radii
   real(dp), parameter :: deepest = 0.02_dp
   !> An overlap that ends or joints cut counts as no longer, in smaller radii: longer ones are the matter of places
   real(dp), parameter :: longest = 2
   !> Half length of the ellipse whose law the cylinder has along a wedge of overlap, over the length of that (from
   !> half-spaces)
   real(dp), parameter :: reach = 0.3_dp
   !> Half length of the parabola in which a wedge ends, over that of the wedge
   real(dp), parameter :: whole_wedge = 4
   !> Overlap at an end by which its length is told, at least, in distances of the axes
   real(dp), parameter :: least_overlap = 1.0e-5_dp
   !> Half lengths of a lens up to which it may come to be cut within an increment, of an overlap of at least this part
   !> of the smaller radius
   real(dp), parameter :: felt = 2, least_felt = 1.0e-3_dp
   !> Nearer to an end than this part of its element is there
   real(dp), parameter :: at_end = 1.0e-9_dp
   !> Part of the curvature along wires side by side that is their own, at least: what ends leave has no corner there
   real(dp), parameter :: least_own_bend = 0.1_dp

   !> The overlap from the end of a wire on, which is part of no longer one.
   type :: wedge_t
      !> Which of the wires ends there
      integer :: wire = 0
      !> How much it is a wedge, from 0 to 1
      real(dp) :: lean = 0
      !> Curvature of the distance in the ellipse whose law the cylinder has there, and in the parabola that ends in the
      !> wedge [1/m]
      real(dp) :: bend_of_law = 0, bend = 0
   end type wedge_t

contains

   !> The overlap has an end, and its length is known.
   pure logical function has_lens(point)
      !> A crossing, or the contact of an end
      type(contact_point_t), intent(in) :: point

      has_lens = point%kinematics%distance > 0
      if (has_lens .and. .not. any(point%held)) has_lens = sine_of_overlap(point) > 0
   end function has_lens

   !> Sine s of a crossing (10.14), of its axes as they are: 0 where the wires follow each other.
   pure real(dp) function sine_of_overlap(point) result(sine)
      !> A crossing
      type(contact_point_t), intent(in) :: point
      real(dp) :: slope, curvature

      call sine_at_angle(qualities_of(point), point%kinematics%angle, sine, slope, curvature)
   end function sine_of_overlap

   !> How the angle that the law of a crossing sees changes with that of the axes.
   pure subroutine angle_of_law(point, slope, curvature)
      type(contact_point_t), intent(in) :: point
      !> First and second derivative by the angle of the axes [-, 1/rad]; 0 at right angles, which nothing changes
      real(dp), intent(out) :: slope, curvature
      real(dp) :: cosine, of_lens, slope_of_lens, curvature_of_lens
      type(bent_crossing_t) :: straight

      ! the smaller one between straight wires
      slope = sign(1.0_dp, cos(point%kinematics%angle))
      curvature = 0
      if (is_bent(point)) then
         straight = bends_of(point, point%kinematics%angle)
         slope = straight%slope
         curvature = straight%curvature
      end if
      if (.not. point%lens_share > 0) return
      slope = 0
      cosine = cos(point%law_angle)
      if (.not. cosine > smallest_cosine) return
      ! sin(theta) = (1 - share) sin(psi) + share s(psi)
      associate (share => point%lens_share, psi => point%kinematics%angle)
         call sine_of_lens(point, of_lens, slope_of_lens, curvature_of_lens)
         slope = ((1 - share)*cos(psi) + share*slope_of_lens)/cosine
         curvature = (sin(point%law_angle)*slope**2 - (1 - share)*sin(psi) + share*curvature_of_lens)/cosine
      end associate
   end subroutine angle_of_law

   !> Sine of the lens of a crossing at the present angle of the axes; next to ends and joints it stays.
   pure subroutine sine_of_lens(point, sine, slope, curvature)
      !> With the sine and the qualities of its last shares
      type(contact_point_t), intent(in) :: point
      !> And its first and second derivative by the angle
      real(dp), intent(out) :: sine, slope, curvature

      logical :: stays

      stays = is_cut(point%lens) .or. .not. all(point%lens_quality > 0)
      sine = point%lens_sine
      if (.not. stays) then
         ! of parallel axes the angle is stationary
         associate (least => asin(parallel_sine))
            call sine_at_angle(point%lens_quality, max(least, min(pi - least, point%kinematics%angle)), &
               sine, slope, curvature)
            stays = .not. (sine > least_part*point%lens_sine .and. sin(point%kinematics%angle) > parallel_sine)
            sine = max(sine, least_part*point%lens_sine)
         end associate
      end if
      if (.not. stays) return
      slope = 0
      curvature = 0
   end subroutine sine_of_lens

   !> `aW = sqrt(2 d delta)/s` of a crossing; from the end of a wire on that of a wedge, the longest at a joint [m].
   pure real(dp) function half_length_of(point, largest_overlap) result(half_length)
      !> With a lens
      type(contact_point_t), intent(in) :: point
      !> Overlap that counts at most [m]: iterates overlap deeply for a moment, which makes no lines of them
      real(dp), intent(in) :: largest_overlap
      integer :: i, j

      if (.not. any(point%held)) then
         half_length = sqrt(2*point%kinematics%distance*max(0.0_dp, min(-point%gap, largest_overlap))) &
            /sine_of_overlap(point)
         return
      end if
      half_length = 0
      do i = 1, size(point%legs)
         do j = 1, size(point%legs)
            if (is_contact_of(point%legs(i), point%legs(j))) half_length = max(half_length, half_length_on(point, &
               point%legs(i), point%legs(j), largest_overlap))
         end do
      end do
   end function half_length_of

   !> How far the overlap of a contact reaches along two of its legs that begin at an end or joint [m]: where the
   !> contact is, or next to it.
   pure real(dp) function half_length_on(point, bar, leg, largest_overlap) result(half_length)
      type(contact_point_t), intent(in) :: point
      !> Of the barred and the unbarred wire
      type(leg_t), intent(in) :: bar, leg
      !> Overlap that counts at most [m]
      real(dp), intent(in) :: largest_overlap
      real(dp) :: overlap, bend(2), tilt(2)
      logical :: is_wedge(2)

      bend = [bar%bend, leg%bend]
      tilt = [bar%tilt, leg%tilt]
      ! where end meets end, the normal leans on both wires: that on the other one as if it went on
      if (all(point%held .and. point%at_end)) tilt = abs(tilt + dot_product(bar%direction, leg%direction)*tilt([2, 1]))
      ! the curvature along a leg is that over the other one
      if (all(point%held) .and. .not. all(point%at_end)) bend = max(0.0_dp, 1 - dot_product(bar%along, leg%along)**2 &
         - [bar%tilt, leg%tilt]**2)/point%kinematics%distance
      ! at first touch a tilt of round-off would tell lines from ends
      overlap = min(-point%gap, largest_overlap)
      is_wedge = point%held
      if (.not. any(point%held)) then
         is_wedge = .not. [bar%at_contact, leg%at_contact]
         overlap = min(overlap, minval([bar%overlap, leg%overlap], is_wedge))
      end if
      overlap = max(overlap, least_overlap*point%kinematics%distance)
      half_length = huge(half_length)
      if (is_wedge(1)) half_length = wedge_length(tilt(1), bend(1), overlap)
      if (is_wedge(2)) half_length = min(half_length, wedge_length(tilt(2), bend(2), overlap))
   end function half_length_on

   !> The wedge at the end of a wire that leans on another one: that of wires side by side, and not half of a lens as
   !> where wires cross over the end of one, nor as long as places along the wires resolve. Where ends of wires
   !> meet that lead opposite ways it is that of the wire that leans more on the other one, as if that went on. Source:
   !> theory (10.18b).
   pure type(wedge_t) function wedge_of(point) result(wedge)
      type(contact_point_t), intent(in) :: point
      real(dp) :: bend, radius, length, cosine, slope(2), own_bend(2)

      if (.not. any(point%held) .or. .not. point%gap < 0) return
      slope = abs(point%tilt)
      own_bend = point%bend
      if (all(point%held)) then
         cosine = dot_product(point%tangent(:, 1), point%tangent(:, 2))
         slope = point%tilt + cosine*point%tilt([2, 1])
         own_bend = (1 - cosine**2 - slope**2)/point%kinematics%distance
      end if
      wedge%wire = maxloc(slope, 1, point%held)
      radius = minval(point%radius)
      associate (i => wedge%wire, overlap => min(-point%gap, deepest*radius), tilt => slope(wedge%wire))
         if (.not. (all(point%at_end .eqv. point%held) .and. tilt > 0)) return
         bend = max(0.0_dp, own_bend(i))
         length = wedge_length(tilt, own_bend(i), overlap)
         wedge%lean = tilt**2/(tilt**2 + 2*bend*overlap)*(1 - smooth_step(length/radius - 1)) &
            *(1 - smooth_step((sqrt(bend*point%kinematics%distance) - small_sine/2)/(small_sine/2)))
         if (.not. wedge%lean > 0) return
         ! no rounder than that of wires at right angles
         wedge%bend_of_law = wedge%lean*2*overlap/((reach*length)**2 + 2*point%kinematics%distance*overlap)
         wedge%bend = wedge%lean*2*overlap/(whole_wedge*length)**2
      end associate
   end function wedge_of

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

   !> How the ends and joints of the two wires cut the overlap. What has been found for a closed contact stays until the
   !> forces balance.
   pure subroutine divide_at_ends(wires, elements, point)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(inout) :: point
      real(dp) :: overlap, radius, to_end(2), way(3, 2), least(2), own
      type(wedge_t) :: wedge
      integer :: i

      if (point%lens%is_known .or. point%gap >= 0 .or. .not. point%kinematics%distance > 0) return
      call divide_at_joints(point)
      associate (pair => [point%element_bar, point%element], lens => point%lens, d => point%kinematics%distance)
         lens%of_ball = point%radius - elements%radius(pair)
         radius = minval(point%radius)
         do i = 1, 2
            call find_free_end(wires, elements, point, i, lens%side(i), to_end(i))
         end do
         lens%near = lens%side > 0
         lens%distance = d
         do i = 1, 2
            way(:, i) = point%tangent(:, i)
            if (lens%near(i) .and. .not. point%at_end(i)) way(:, i) = &
               -direction_of_end(wires, pair(i), lens%side(i))*way(:, i)
         end do
         lens%cosine = dot_product(way(:, 1), way(:, 2))/max(norm2(way(:, 1))*norm2(way(:, 2)), tiny(d))
         lens%bend = bends_over_feet(point, lens%cosine)
         overlap = min(-point%gap, deepest*radius)
         wedge = wedge_of(point)
         least = d*least_bend(0.0_dp, overlap, longest*radius)
         if (wedge%lean > 0) least(wedge%wire) = max(least(wedge%wire), d*wedge%bend)
         lens%own_bend = max(least_own_bend, lens%bend/max(lens%bend, least))
         lens%bend = max(lens%bend, least)
         if (wedge%lean > 0) then
            own = lens%bend(wedge%wire)
            lens%of_wedge = max(1.0_dp, d*wedge%bend_of_law/own)
            ! along the other wire the same parabola is as curved
            lens%bend = max(lens%bend, own/(own + lens%cosine**2))
         end if
         ! nothing is felt of an end that is farther away
         overlap = max(overlap, least_felt*radius)
         to_end = merge(to_end, 0.0_dp, lens%near .and. .not. point%at_end)
         lens%near = lens%near .and. lens%bend*to_end**2 < felt**2*2*d*overlap
      end associate
      call place_at_ends(wires, elements, point)
   end subroutine divide_at_ends

   !> What joints change of the overlap, and the angle of the law.
   pure subroutine divide_at_joints(point)
      type(contact_point_t), intent(inout) :: point

      associate (lens => point%lens, parts => point%present_parts)
         lens%is_known = tells_shares(point)
         lens%has_energies = .false.
         lens%is_near_joint = parts%is_near
         lens%of_joint(1, :) = parts%of_cylinder
         lens%of_joint(2, :) = parts%of_end
         lens%is_mixed = parts%is_mixed
         lens%young = parts%young
         lens%poisson = parts%poisson
         lens%angle = merge(parts%angle, point%kinematics%angle, parts%is_near)
         ! cylinders that are cut on both sides have nothing between their joints
         lens%of_crossing = 1
         if (all(parts%of_end > 0)) lens%of_crossing = smooth_step((sin(lens%angle) - flat_tilt)/(steep_tilt &
            - flat_tilt))
      end associate
   end subroutine divide_at_joints

   !> The overlap is more than that of round-off at first touch, so that what is found of it may stay.
   pure logical function tells_shares(point)
      type(contact_point_t), intent(in) :: point

      tells_shares = -point%gap > near_round_off*point%kinematics%distance
   end function tells_shares

   !> Angle of the axes, next to a joint the mean one that the law sees [rad].
   pure real(dp) function angle_of_axes(point) result(angle)
      type(contact_point_t), intent(in) :: point

      angle = merge(point%lens%angle, point%kinematics%angle, point%lens%is_near_joint)
   end function angle_of_axes

   !> The distance times its curvature along either wire, over the feet on the other one (2) [-].
   pure function bends_over_feet(point, cosine) result(bend)
      type(contact_point_t), intent(in) :: point
      !> Of the angle between the wires
      real(dp), intent(in) :: cosine
      real(dp) :: bend(2), square_of_sine

      if (any(point%held)) then
         square_of_sine = (1 - cosine)*(1 + cosine)
         ! the foot is on several legs
         if (point%lens%is_near_joint) square_of_sine = sin(point%lens%angle)**2
         bend = square_of_sine
         if (.not. any(point%held .and. .not. point%at_end)) bend = merge(point%kinematics%distance*point%bend &
            + point%tilt**2, bend, point%held)
         ! along the other wire, which may end near by, the same lens is as curved: b2 = c2 - gamma^2/c1 with c2 = 1
         if (count(point%held) == 1 .and. .not. any(point%held .and. .not. point%at_end)) then
            associate (own => max(0.0_dp, sum(bend, mask=point%held)))
               bend = merge(bend, own/max(own + cosine**2, tiny(own)), point%held)
            end associate
         end if
      else
         associate (m_inverse => point%kinematics%between_q)
            bend = 1/([m_inverse(2, 2), m_inverse(1, 1)]*point%kinematics%squares([2, 1]))
         end associate
         ! of wires that are curved about each other more than of straight ones
         bend = max(bend, (1 - cosine)*(1 + cosine))
      end if
   end function bends_over_feet

   !> Where a contact is along its wires, as seen from the ends that cut it.
   pure subroutine place_at_ends(wires, elements, point)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(inout) :: point
      real(dp) :: to_ends(2)
      integer :: i

      associate (pair => [point%element_bar, point%element], arc => [point%arc_bar, point%arc])
         do i = 1, 2
            if (.not. point%lens%near(i)) cycle
            if (point%at_end(i)) then
               point%place(i) = (2*i - 3)*dot_product(point%kinematics%point_bar - point%kinematics%point, &
                  point%tangent(:, i))
            else
               to_ends = distances_to_ends(wires, elements, pair(i), arc(i))
               point%place(i) = to_ends(point%lens%side(i))
            end if
         end do
      end associate
   end subroutine place_at_ends

   !> A place is at a free end of its wire.
   pure logical function is_at_cut_end(wires, elements, e, arc, radius)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      !> Arc length along its wire, and smaller radius of the contact [m]
      real(dp), intent(in) :: arc, radius

      is_at_cut_end = any(cut_ends(wires, elements, e, radius) .and. distances_to_ends(wires, elements, e, arc) &
         <= at_end*elements%length(e))
   end function is_at_cut_end

   !> The ends of a wire that cut overlaps for themselves: the free ones (2). One just behind a joint is part of that.
   pure function cut_ends(wires, elements, e, radius)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Element of the wire
      integer, intent(in) :: e
      !> The smaller one of the contact [m]
      real(dp), intent(in) :: radius
      logical :: cut_ends(2)

      cut_ends = wires%is_free(:, wires%wire(e))
      if (.not. all(cut_ends)) cut_ends = cut_ends .and. &
         sum(distances_to_ends(wires, elements, e, wires%arc(e))) >= radius
   end function cut_ends

   !> The ends that cut a contact, as the kernels want them.
   pure function ends_of_wires(wires, elements, axis, point) result(ends)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      type(contact_point_t), intent(in) :: point
      type(place_at_end_t) :: ends(2)
      real(dp) :: xi(2)
      integer :: pair(2), i

      pair = [point%element_bar, point%element]
      xi = [point%xi_bar, point%xi]
      ends%held = point%held
      ! of a place along a line the foot moves
      if (point%line_place > 0) ends%held = [point%foot_at_end, .true.]
      do i = 1, 2
         if (.not. point%lens%near(i)) cycle
         ends(i)%direction = direction_of_end(wires, pair(i), point%lens%side(i))
         if (.not. point%at_end(i)) cycle
         ends(i)%inward = point%tangent(:, i)
         ends(i)%node = 2*i - merge(1, 0, xi(i) < 0)
         ends(i)%turns = axis == axis_hermite
         ends(i)%length = elements%length(pair(i))
         ends(i)%other_node = 4*i - 1 - ends(i)%node
      end do
   end function ends_of_wires

   !> The second ends of both wires, from which places along them are counted.
   pure function second_ends(wires, point) result(ends)
      type(wires_t), intent(in) :: wires
      type(contact_point_t), intent(in) :: point
      type(place_at_end_t) :: ends(2)

      ends%held = point%held
      if (point%line_place > 0) ends%held = [point%foot_at_end, .true.]
      ends%direction = wires%direction([point%element_bar, point%element])
   end function second_ends

   !> 1 where an end of its wire lies in the direction of xi of an element, -1 where it lies against it.
   pure integer function direction_of_end(wires, e, side) result(direction)
      type(wires_t), intent(in) :: wires
      !> Element; first (1) or second (2) end
      integer, intent(in) :: e, side

      direction = (2*side - 3)*wires%direction(e)
   end function direction_of_end

   !> The nearer free end of a wire.
   pure subroutine find_free_end(wires, elements, point, i, side, distance)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point
      !> 1: barred, 2: unbarred wire
      integer, intent(in) :: i
      !> 1 or 2, 0: there is none
      integer, intent(out) :: side
      !> Length of wire to it [m]
      real(dp), intent(out) :: distance
      real(dp) :: to_ends(2)

      side = 0
      distance = huge(distance)
      associate (pair => [point%element_bar, point%element], arc => merge(point%arc_bar, point%arc, i == 1))
         to_ends = distances_to_ends(wires, elements, pair(i), arc)
         ! a joint has several legs, of which none is the one of the contact
         if (point%held(i) .and. .not. point%at_end(i) .and. any(to_ends <= at_end*elements%length(pair(i)))) return
         to_ends = merge(to_ends, distance, cut_ends(wires, elements, pair(i), minval(point%radius)))
      end associate
      if (.not. any(to_ends < distance)) return
      side = minloc(to_ends, 1)
      distance = to_ends(side)
   end subroutine find_free_end

   !> Curvature of the distance along a wire from its end on, of an overlap that is no longer than this [1/m].
   pure real(dp) function least_bend(bend, overlap, length)
      !> [1/m], [m], [m]
      real(dp), intent(in) :: bend, overlap, length

      least_bend = max(bend, 2*overlap/length**2)
   end function least_bend

   !> 1 where an axis lies along the surface of the other wire, 0 where it runs into it.
   pure real(dp) function flatness(tilt)
      !> Sine of the angle
      real(dp), intent(in) :: tilt

      flatness = 1 - smooth_step((tilt - flat_tilt)/(steep_tilt - flat_tilt))
   end function flatness

end module litz_contact_lens
