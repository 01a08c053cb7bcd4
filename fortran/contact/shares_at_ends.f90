!> What of a contact at an end or joint is carried there, and what along the legs of the wires.
!>
!> Places along a line have a share of the contact; cylinders at an end or joint have the rest, round ends and joints
!> more where little is left for places. Source: theory section 10.
module litz_shares_at_ends
   use litz_kinds, only: dp
   use litz_bent_contacts, only: feels_bends, sine_of_bends
   use litz_contact_lens, only: half_length_on, angle_of_axes, flatness, least_bend, wedge_of, wedge_t, deepest, &
      least_overlap, longest, small_sine, moderate_sine
   use litz_contact_points, only: contact_point_t, contact_set_t, points_by_place_t, leg_t, is_contact_of
   use litz_cut_lens, only: is_cut
   use litz_element_library, only: elements_t
   use litz_lens_law, only: share_of_ends, share_of_line, smooth_step
   use litz_line_laps, only: lap_from_end
   use litz_line_places, only: line_places_t, place_at, resolved_at_ends
   use litz_normal_law, only: normal_law_t
   use litz_rotations, only: cross
   use litz_wires, only: wires_t
   implicit none
   private
   public :: own_t, share_end, share_on_legs, share_along, share_of_lens, share_at_crossing
   public :: half_pass, least_sine

   !> Weight of one of the two passes
   real(dp), parameter :: half_pass = 0.5_dp
   !> Least angle that the law of a contact at an end sees [rad]
   real(dp), parameter :: least_sine = 1.0e-3_dp

   !> Cosine of the angle between wires that lie along each other (15 degrees)
   real(dp), parameter :: along_each_other = 0.966_dp
   !> Least part of a force that counts in a mean
   real(dp), parameter :: tiny_part = 1.0e-100_dp
   !> What a crossing has where it lies: share of the places there, length of what ends leave of its overlap [m], and
   !> the sine that its law sees.
   type :: own_t
      real(dp) :: line_share = 0, length = 0, sine = 1
   end type own_t

contains

   !> What the end of a wire carries, or a joint: of each of its legs all but the share of the places there, which lose
   !> theirs where the axis leans towards the other wire. A round end or joint is part of the longest line there.
   pure subroutine share_end(law, wires, elements, contact, by_place, point)
      type(normal_law_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      type(points_by_place_t), intent(in) :: by_place
      type(contact_point_t), intent(inout) :: point
      type(contact_point_t) :: deeper
      real(dp) :: radius

      radius = minval(point%radius)
      point%lens_sine = sine_at_end(point, longest*radius)
      if (.not. any(point%held .and. .not. point%at_end)) then
         point%section_share = 0
         if (.not. law%line_penalty() > 0) point%section_share = section_of_end(wires, elements, point)
         point%spot_section = point%section_share
         associate (kept => point%history%spot_shape%overlap)
            if (.not. law%line_penalty() > 0 .and. kept > -point%gap) then
               deeper = point
               deeper%gap = -kept
               point%spot_section = max(point%section_share, section_of_end(wires, elements, deeper))
            end if
         end associate
      end if
      point%lens_share = share_of_lens(law, point, angle_of_axes(point))
      call share_on_legs(law, wires, elements, contact, by_place, own_t(), point)
      if (count(point%held) == 1) call leave_to_twin(wires, contact%points, point)
   end subroutine share_end

   !> How much the section counts in the law of an end: by the length of the overlap, of a wedge twice as much.
   pure real(dp) function section_of_end(wires, elements, point) result(share)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point
      type(wedge_t) :: wedge

      wedge = wedge_of(point)
      share = share_of_line((1 + wedge%lean)*length_of_end(wires, elements, point)/minval(point%radius))
   end function section_of_end

   !> How far the overlap of an end reaches along both wires, until one of them ends [m].
   pure real(dp) function length_of_end(wires, elements, point) result(length)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point
      integer :: i, j

      length = 0
      do i = 1, size(point%legs)
         do j = 1, size(point%legs)
            associate (bar => point%legs(i), leg => point%legs(j))
               if (is_contact_of(bar, leg)) length = max(length, min(half_length_on(point, bar, leg, &
                  deepest*minval(point%radius)), lap_on(wires, elements, point, bar, leg)))
            end associate
         end do
      end do
   end function length_of_end

   !> What a contact carries: of each of its legs, by what its cylinder has of the force, all but the share of the
   !> places there. Next to a joint these are the stretch on which it lies and the legs beyond the joint. The law sees
   !> the mean length of what is left of their overlaps.
   pure subroutine share_on_legs(law, wires, elements, contact, by_place, own, point)
      type(normal_law_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      type(points_by_place_t), intent(in) :: by_place
      !> Of a crossing
      type(own_t), intent(in) :: own
      type(contact_point_t), intent(inout) :: point
      real(dp) :: part, parts, of_crossing, of_cylinders, of_ends, length, lap, sine, left, over_sine, section
      real(dp) :: of_sections
      integer :: i, j

      if (.not. allocated(point%legs)) then
         call divide_share(1 - own%line_share, share_beside_places(elements, contact%places, [point%element_bar, &
            point%element], 1 - own%line_share, own%length), point)
         return
      end if
      parts = 0
      of_cylinders = 0
      left = 0
      over_sine = 0
      of_sections = 0
      of_ends = 1
      do i = 1, size(point%legs)
         do j = 1, size(point%legs)
            associate (bar => point%legs(i), leg => point%legs(j))
               if (.not. (bar%side == 1 .and. leg%side == 2)) cycle
               if (any(point%held) .and. .not. is_contact_of(bar, leg)) cycle
               of_crossing = 1 - own%line_share
               length = own%length
               sine = own%sine
               section = point%section_share
               if (any(point%held) .or. .not. is_contact_of(bar, leg)) then
                  of_crossing = 1 - line_share_on(wires, elements, contact, by_place, bar, leg)
                  length = half_length_on(point, bar, leg, deepest*minval(point%radius))
                  section = 0
                  lap = lap_on(wires, elements, point, bar, leg)
                  if (.not. law%line_penalty() > 0) section = share_of_line(min(length, lap)/minval(point%radius))
                  ! as far as it is part of a longer overlap, only ends bound that
                  length = min(length/max(1 - point%long_share, epsilon(length)), lap)
                  sine = sine_on(law, point, bar, leg)
               end if
               ! equal parts where no cylinder has any, or places carry all
               part = max(bar%part*leg%part, tiny_part)
               parts = parts + part
               of_cylinders = of_cylinders + part*of_crossing
               part = part*max(of_crossing, tiny_part)
               left = left + part
               over_sine = over_sine + part/sine
               of_sections = of_sections + part/sine*section
               of_ends = min(of_ends, share_beside_places(elements, contact%places, [bar%element, leg%element], &
                  of_crossing, length))
            end associate
         end do
      end do
      call divide_share(of_cylinders/parts, of_ends, point)
      if (.not. point%lens%is_near_joint) return
      point%lens_sine = left/over_sine
      point%lens_share = 1
      point%section_share = of_sections/over_sine
   end subroutine share_on_legs

   !> Sine that the law sees of two legs that meet at a joint.
   pure real(dp) function sine_on(law, point, bar, leg) result(sine)
      type(normal_law_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point
      !> Of the barred and of the unbarred wire
      type(leg_t), intent(in) :: bar, leg
      real(dp) :: bend, of_axes, radius, share
      logical :: begins(2)

      radius = minval(point%radius)
      of_axes = norm2(cross(bar%direction, leg%direction))
      begins = point%held .or. .not. [bar%at_contact, leg%at_contact]
      bend = merge(bar%bend_of_law, leg%bend_of_law, begins(1))
      if (all(begins)) bend = of_axes**2/point%kinematics%distance
      share = share_of_lens(law, point, asin(min(1.0_dp, of_axes)))
      sine = (1 - share)*sine_of_bends(point, asin(min(1.0_dp, of_axes))) &
         + share*sqrt(point%kinematics%distance*max(0.0_dp, bend))
      sine = min(1.0_dp, max(sine, sqrt(point%kinematics%distance*least_bend(0.0_dp, max(least_overlap &
         *point%kinematics%distance, min(-point%gap, deepest*radius)), longest*radius))))
   end function sine_on

   !> Share of the contact at an end or joint that is carried along the line of two of its legs.
   pure real(dp) function line_share_on(wires, elements, contact, by_place, bar, leg) result(share)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      type(points_by_place_t), intent(in) :: by_place
      !> Of the barred and the unbarred wire, on which the contact is
      type(leg_t), intent(in) :: bar, leg

      share = 0
      if (size(contact%line_points) > 0) share = half_pass*(share_along(wires, elements, contact, by_place, &
         bar%element, bar%xi, leg%element, leg%arc) + share_along(wires, elements, contact, by_place, leg%element, &
         leg%xi, bar%element, bar%arc))
      share = share*flatness(max(bar%tilt, leg%tilt))
   end function line_share_on

   !> How far two legs lie beside each other from a contact on, until one of them ends [m].
   pure real(dp) function lap_on(wires, elements, point, bar, leg) result(lap)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point
      !> Of the barred and the unbarred wire, on which the contact is
      type(leg_t), intent(in) :: bar, leg

      lap = huge(lap)
      if (point%held(1)) lap = lap_from_end(wires, elements, bar, leg)
      if (point%held(2)) lap = min(lap, lap_from_end(wires, elements, leg, bar))
   end function lap_on

   !> Wires that lie along each other touch at the ends of both: what is of the end of the other one is the matter of
   !> the contact there, and of what is of both each has a half.
   pure subroutine leave_to_twin(wires, points, point)
      type(wires_t), intent(in) :: wires
      type(contact_point_t), intent(in) :: points(:)
      type(contact_point_t), intent(inout) :: point
      integer :: i, other

      other = merge(2, 1, point%held(1))
      if (.not. point%lens%near(other) .or. abs(point%kinematics%cos_angle) < along_each_other) return
      do i = 1, size(points)
         associate (twin => points(i))
            if (.not. (twin%gap < 0 .and. twin%held(other) .and. .not. twin%held(3 - other))) cycle
            if (twin%lens%side(other) /= point%lens%side(other)) cycle
            if (.not. is_on_legs(twin)) cycle
            point%lens%share(merge(2, 1, other == 1), merge(2, 1, other == 2)) = 0
            point%lens%share(1, 1) = point%lens%share(1, 1)/2
            point%lens%share(2, 2) = point%lens%share(2, 2)/2
            return
         end associate
      end do

   contains

      !> On the same wires, of a joint on one of its legs.
      pure logical function is_on_legs(twin)
         type(contact_point_t), intent(in) :: twin

         associate (legs => point%legs)
            is_on_legs = any(legs%at_contact .and. legs%side == 1 .and. wires%wire(legs%element) &
               == wires%wire(twin%element_bar)) .and. any(legs%at_contact .and. legs%side == 2 .and. &
               wires%wire(legs%element) == wires%wire(twin%element))
         end associate
      end function is_on_legs

   end subroutine leave_to_twin

   !> Sine of straight wires between which the distance would be as curved.
   pure real(dp) function sine_at_end(point, length) result(sine)
      type(contact_point_t), intent(in) :: point
      !> Of an overlap, at most [m]
      real(dp), intent(in) :: length
      type(wedge_t) :: wedge
      real(dp) :: bend
      logical :: at_joint(2)

      ! along the end of one wire it is that over one of the legs of the other one
      at_joint = point%held .and. .not. point%at_end
      bend = maxval(point%bend, .not. at_joint([2, 1]))
      if (all(at_joint)) bend = sin(point%lens%angle)**2/point%kinematics%distance
      sine = sqrt(point%kinematics%distance*least_bend(bend, max(0.0_dp, min(-point%gap, &
         deepest*minval(point%radius))), length))
      wedge = wedge_of(point)
      sine = max(sine, sqrt(point%kinematics%distance*wedge%bend_of_law))
      sine = max(least_sine, min(1.0_dp, sine))
   end function sine_at_end

   !> Share of a contact that is carried along one of the wires: of the two places next to it.
   pure real(dp) function share_along(wires, elements, contact, by_place, e, xi, other, arc) result(share)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      type(points_by_place_t), intent(in) :: by_place
      !> Element
      integer, intent(in) :: e
      !> Place in it
      real(dp), intent(in) :: xi
      !> Element of the other wire
      integer, intent(in) :: other
      !> Arc length there [m]
      real(dp), intent(in) :: arc
      real(dp) :: u
      integer :: i

      u = (1 + max(-1.0_dp, min(1.0_dp, xi)))/2*contact%places%n_parts(e)
      i = min(int(u), contact%places%n_parts(e) - 1)
      share = (i + 1 - u)*at(place_at(contact%places, e, i)) + (u - i)*at(place_at(contact%places, e, i + 1))

   contains

      !> At a place: that of its point on the other wire, if it has one near the crossing.
      pure real(dp) function at(place)
         !> Its number
         integer, intent(in) :: place
         integer :: k

         at = 0
         k = by_place%last(place)
         do while (k > 0)
            associate (of_line => contact%line_points(k))
               if (wires%wire(of_line%element_bar) == wires%wire(other)) then
                  if (wires%arc_between(wires%wire(other), of_line%arc_bar, arc) < &
                     elements%length(e) + elements%length(other)) at = of_line%line_share
               end if
            end associate
            k = by_place%before(k)
         end do
      end function at

   end function share_along

   !> What round ends carry beside the places along a line: what these leave, and more where little is left for them.
   pure real(dp) function share_beside_places(elements, places, pair, of_crossing, length) result(share)
      type(elements_t), intent(in) :: elements
      type(line_places_t), intent(in) :: places
      !> Elements (2)
      integer, intent(in) :: pair(2)
      !> What places leave, and length of what the ends leave of the overlap [m]
      real(dp), intent(in) :: of_crossing, length

      share = share_of_ends(1 - of_crossing, length, resolved_at_ends(places, pair, elements%length(pair), &
         elements%radius(pair)))
   end function share_beside_places

   !> What a contact carries: cylinders what places along the line leave, round ends and joints their share.
   pure subroutine divide_share(of_cylinders, of_ends, point)
      !> [-]
      real(dp), intent(in) :: of_cylinders, of_ends
      type(contact_point_t), intent(inout) :: point

      point%lens%share = 1
      point%lens%beside_places = 0
      point%weight = of_cylinders
      if (.not. is_cut(point%lens)) return
      point%weight = max(of_cylinders, of_ends)
      if (.not. point%weight > 0) return
      point%lens%share = of_ends/point%weight
      point%lens%beside_places = 0
      if (of_ends > of_cylinders) point%lens%beside_places = 1 - of_cylinders/of_ends
      point%lens%share(1, 1) = of_cylinders/point%weight
   end subroutine divide_share

   !> How much the lens counts beside the angle of the axes.
   pure real(dp) function share_of_lens(law, point, angle) result(share)
      type(normal_law_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point
      !> [rad]
      real(dp), intent(in) :: angle

      share = max(point%section_share, &
         1 - smooth_step((sin(angle) - small_sine)/(moderate_sine - small_sine)))
      if (law%is_per_length_only()) share = 1
   end function share_of_lens

   !> The same at a crossing: Hertz's law sees there how the wires are bent at any angle.
   pure real(dp) function share_at_crossing(law, point, angle) result(share)
      type(normal_law_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point
      !> [rad]
      real(dp), intent(in) :: angle

      share = 0
      if (.not. feels_bends(law)) share = share_of_lens(law, point, angle)
   end function share_at_crossing

end module litz_shares_at_ends
