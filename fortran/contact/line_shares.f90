!> What of a contact is carried at a crossing, and what along the line: by the length along which the wires overlap.
!>
!> A short overlap is the matter of the crossing in it, which has its integral in closed form; a long one that of the
!> places along it; between the two each has a share. Within an iteration the shares stay. Source: theory section 10.
module litz_line_shares
   use litz_kinds, only: dp, pi
   use litz_axis_choices, only: axis_hermite
   use litz_contact_lens, only: has_lens, half_length_of, divide_at_ends, place_at_ends, flatness, least_bend, deepest
   use litz_contact_points, only: contact_point_t, contact_set_t, pair_geometry, law_too_curved
   use litz_cut_forces, only: settle_cut
   use litz_cut_lens, only: cut_lens_t
   use litz_crossings_of_wires, only: crossings_of_wires_t, sort_crossings
   use litz_element_library, only: elements_t
   use litz_lens_law, only: share_of_point, share_of_ends, share_of_line, smooth_step
   use litz_line_contact, only: serves_lines
   use litz_line_kinematics, only: lens_sine, crossing_qualities, line_profile_t, line_profile
   use litz_line_laps, only: find_lap, cell_at_lap, lap_from_end, lap_at_crossing
   use litz_line_places, only: line_places_t, place_at, spacing_of_places
   use litz_model, only: model_t
   use litz_normal_forces, only: wires_of
   use litz_normal_law, only: normal_law_t
   use litz_wires, only: wires_t
   implicit none
   private
   public :: share_crossings, share_line_point, renew_shares, points_by_place_t, chain_by_place

   !> Weight of one of the two passes
   real(dp), parameter :: half_pass = 0.5_dp
   !> q below which places have no clear foot, and from which on they have (theory section 10)
   real(dp), parameter :: least_quality = 0.25_dp, good_quality = 0.5_dp
   !> Evenly spaced places resolve an overlap as those of Lobatto's rule at this part of their distance do
   real(dp), parameter :: resolution = 0.65_dp
   !> Sines of the angle between the axes up to which the lens alone gives the angle of the law, and from which on the
   !> axes do (5 and 10 degrees)
   real(dp), parameter :: small_sine = 0.0872_dp, moderate_sine = 0.1736_dp
   !> Less than this leads nowhere
   real(dp), parameter :: least_tilt = 1.0e-9_dp
   !> Least angle that the law of a contact at an end sees [rad]
   real(dp), parameter :: least_sine = 1.0e-3_dp

   !> Cosine of the angle between wires that lie along each other (15 degrees)
   real(dp), parameter :: along_each_other = 0.966_dp

   !> A change of the sine of a lens, relative to it, matters this much more than one of a share
   real(dp), parameter :: sine_matters = 20

   !> Half lengths of a lens from its crossing where it has certainly ended
   real(dp), parameter :: lens_ends = 1.2_dp

   !> The points of line contacts of each place, as chains.
   type :: points_by_place_t
      !> Last point of each place (n_places), and the one before each point (n_points); 0: none
      integer, allocatable :: last(:), before(:)
   end type points_by_place_t

contains

   !> How much of its contact each crossing carries, and by which law: what is not carried along the line there. What
   !> has been found for a crossing stays until the forces balance.
   subroutine share_crossings(model, wires, elements, contact)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the points of line contacts
      type(contact_set_t), intent(inout) :: contact
      type(points_by_place_t) :: by_place
      integer :: i

      if (size(contact%line_points) > 0) by_place = chain_by_place(size(contact%places%xi), contact%line_points)
      do i = 1, size(contact%points)
         associate (point => contact%points(i))
            call divide_at_ends(wires, elements, point)
            call place_at_ends(wires, elements, point)
            call set_angle_of_axes(point)
            if (.not. serves_lines(model, point%pair)) cycle
            associate (law => model%interactions(model%contact_pairs(point%pair)%interaction)%normal)
               if ((point%gap < 0 .or. law%is_per_length_only()) .and. .not. point%is_shared) then
                  call share_crossing(law, wires, elements, contact, by_place, point)
               end if
            end associate
            call blend_angle_of_lens(point)
         end associate
      end do
   end subroutine share_crossings

   !> The angle that a law sees is that of the axes; next to ends it stays what it was in the last state in balance.
   pure subroutine set_angle_of_axes(point)
      type(contact_point_t), intent(inout) :: point

      point%law_angle = merge(point%lens%angle, point%kinematics%angle, any(point%lens%near))
      ! wires that are parallel may well meet end to end
      if (any(point%held)) point%law_angle = max(least_sine, min(pi - least_sine, point%law_angle))
      point%law_sine = sin(point%law_angle)
   end subroutine set_angle_of_axes

   !> It is that of straight wires with as long a lens, as far as that counts.
   pure subroutine blend_angle_of_lens(point)
      type(contact_point_t), intent(inout) :: point

      if (.not. point%lens_share > 0) return
      point%law_sine = (1 - point%lens_share)*point%law_sine + point%lens_share*point%lens_sine
      point%law_angle = asin(min(1.0_dp, point%law_sine))
   end subroutine blend_angle_of_lens

   !> What a crossing carries. Its law sees the angle of the axes; at small angles and along long lenses it sees that of
   !> straight wires with as long a lens.
   subroutine share_crossing(law, wires, elements, contact, by_place, point)
      type(normal_law_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      type(points_by_place_t), intent(in) :: by_place
      type(contact_point_t), intent(inout) :: point
      real(dp) :: half_length, radius

      ! an iterate in which the wires have passed each other tells nothing
      if (.not. point%kinematics%distance > 0) return
      point%is_shared = .true.
      point%weight = 0
      if (.not. has_lens(point)) return
      if (any(point%held)) then
         call share_end(law, wires, elements, contact, by_place, point)
         return
      end if
      point%lens_sine = lens_sine(point%kinematics)
      radius = minval(elements%radius([point%element_bar, point%element]))
      half_length = half_length_of(point, deepest*radius)
      call give_to_ends(elements, contact%places, line_share_at(wires, elements, contact, by_place, point), &
         merge(min(half_length, lap_at_crossing(wires, elements, point)), huge(radius), all(point%lens%near)), point)
      point%section_share = share_of_line(half_length/radius)
      ! a penalty does not depend on the far field
      if (law%line_penalty() > 0) point%section_share = 0
      point%lens_share = share_of_lens(law, point)
   end subroutine share_crossing

   !> What places along the line leave of a contact it carries itself; its round ends carry more where little is left
   !> for places.
   pure subroutine give_to_ends(elements, places, line_share, length, point)
      type(elements_t), intent(in) :: elements
      type(line_places_t), intent(in) :: places
      !> Part that places carry, and length of what the ends leave of the overlap [m]
      real(dp), intent(in) :: line_share, length
      type(contact_point_t), intent(inout) :: point

      associate (pair => [point%element_bar, point%element])
         point%weight = share_of_ends(line_share, length, resolution*spacing_of_places(places, pair, &
            elements%length(pair)))
      end associate
      point%lens%share = 1
      if (point%weight > 0) point%lens%share(1, 1) = (1 - line_share)/point%weight
   end subroutine give_to_ends

   !> How much the lens counts beside the angle of the axes.
   pure real(dp) function share_of_lens(law, point) result(share)
      type(normal_law_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point

      share = max(point%section_share, &
         1 - smooth_step((sin(point%kinematics%angle) - small_sine)/(moderate_sine - small_sine)))
      if (law%is_per_length_only()) share = 1
   end function share_of_lens

   !> What the end of a wire carries: all but the share of the places there, which lose theirs where the axis leans
   !> towards the other wire.
   pure subroutine share_end(law, wires, elements, contact, by_place, point)
      type(normal_law_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      type(points_by_place_t), intent(in) :: by_place
      type(contact_point_t), intent(inout) :: point
      real(dp) :: share, radius

      radius = minval(elements%radius([point%element_bar, point%element]))
      share = 0
      if (size(contact%line_points) > 0) share = half_pass*(share_along(wires, elements, contact, by_place, &
         point%element_bar, point%xi_bar, point%element, point%arc) + share_along(wires, elements, contact, by_place, &
         point%element, point%xi, point%element_bar, point%arc_bar))
      call give_to_ends(elements, contact%places, share*flatness(maxval(point%tilt)), min(half_length_of(point, &
         deepest*radius), lap_from_end(wires, elements, point, merge(2, 1, point%held(2)))), point)
      if (count(point%held) == 1) call leave_to_twin(wires, contact%points, point)
      point%lens_sine = sine_at_end(point, radius)
      point%lens_share = share_of_lens(law, point)
   end subroutine share_end

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
            if (wires%wire(twin%element_bar) /= wires%wire(point%element_bar)) cycle
            if (wires%wire(twin%element) /= wires%wire(point%element)) cycle
            point%lens%share(merge(2, 1, other == 1), merge(2, 1, other == 2)) = 0
            point%lens%share(1, 1) = point%lens%share(1, 1)/2
            point%lens%share(2, 2) = point%lens%share(2, 2)/2
            return
         end associate
      end do
   end subroutine leave_to_twin

   !> Sine of straight wires between which the distance would be as curved.
   pure real(dp) function sine_at_end(point, radius) result(sine)
      type(contact_point_t), intent(in) :: point
      !> The smaller one [m]
      real(dp), intent(in) :: radius

      sine = sqrt(point%kinematics%distance*least_bend(maxval(point%bend), max(0.0_dp, min(-point%gap, &
         deepest*radius)), radius))
      sine = max(least_sine, min(1.0_dp, sine))
   end function sine_at_end

   !> Share of the contact that is carried along the line where two wires cross: of both passes, as their places have
   !> it.
   pure real(dp) function line_share_at(wires, elements, contact, by_place, point) result(share)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      type(points_by_place_t), intent(in) :: by_place
      !> The crossing
      type(contact_point_t), intent(in) :: point
      real(dp) :: quality(2)

      share = 0
      if (size(contact%line_points) == 0) return
      quality = crossing_qualities(point%kinematics)
      share = share_of_pass(quality)*share_along(wires, elements, contact, by_place, point%element_bar, point%xi_bar, &
         point%element, point%arc) + share_of_pass(quality([2, 1]))*share_along(wires, elements, contact, by_place, &
         point%element, point%xi, point%element_bar, point%arc_bar)
   end function line_share_at

   !> The same along one of the wires: between the two places next to the crossing.
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

   !> Bring up to date what is carried along the line, once the forces balance: within an iteration it stays.
   subroutine renew_shares(model, wires, elements, x, rotation, contact, largest_change)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(contact_set_t), intent(inout) :: contact
      !> Of the share of a point that is in contact [-]
      real(dp), intent(out) :: largest_change
      type(points_by_place_t) :: by_place
      type(crossings_of_wires_t) :: sorted
      real(dp) :: xe(3, 4), t(3, 4), length(2), before
      type(contact_point_t) :: earlier
      integer :: i

      largest_change = 0
      sorted = sort_crossings(wires, contact%points)
      call find_long_overlaps(wires, elements, sorted, contact)
      do i = 1, size(contact%line_points)
         associate (point => contact%line_points(i))
            before = point%weight
            call pair_geometry(model, wires, elements, point%element_bar, point%element, x, rotation, xe, t, length)
            call share_line_point(wires, elements, contact, sorted, xe, t, length, point)
            if (point%gap < 0) largest_change = max(largest_change, abs(point%weight - before) &
               /contact%places%length(point%line_place))
         end associate
      end do
      if (size(contact%line_points) > 0) by_place = chain_by_place(size(contact%places%xi), contact%line_points)
      do i = 1, size(contact%points)
         associate (point => contact%points(i))
            if (.not. point%gap < 0) cycle
            earlier = point
            point%lens = cut_lens_t()
            call divide_at_ends(wires, elements, point)
            largest_change = max(largest_change, change_of_cut(earlier%lens, point%lens))
            associate (law => model%interactions(model%contact_pairs(point%pair)%interaction)%normal)
               if (point%is_shared) call share_crossing(law, wires, elements, contact, by_place, point)
               if (any(point%lens%near)) then
                  call set_angle_of_axes(point)
                  if (serves_lines(model, point%pair)) call blend_angle_of_lens(point)
                  call settle_cut(law, wires_of(model, elements, point), point)
               end if
            end associate
            largest_change = max(largest_change, change_of(earlier, point))
         end associate
      end do
   end subroutine renew_shares

   !> How much the law of a contact near ends has changed: by the shapes of its overlap, and by what it has of them.
   pure real(dp) function change_of_cut(earlier, lens) result(change)
      type(cut_lens_t), intent(in) :: earlier, lens

      change = 0
      if (any(earlier%near .neqv. lens%near)) change = 1
      if (any(earlier%near .neqv. lens%near) .or. .not. any(lens%near)) return
      change = max(maxval(abs(lens%share - earlier%share)), maxval(abs(lens%bend/earlier%bend - 1)), &
         abs(lens%cosine - earlier%cosine))
   end function change_of_cut

   !> How much the law of a crossing has changed: its share, and the sine that it sees.
   pure real(dp) function change_of(earlier, point) result(change)
      type(contact_point_t), intent(in) :: earlier, point

      change = max(abs(point%weight - earlier%weight), abs(point%section_share - earlier%section_share), &
         abs(point%lens_share - earlier%lens_share))
      if (earlier%lens_sine > 0) change = max(change, sine_matters*point%weight*point%lens_share &
         *abs(point%lens_sine/earlier%lens_sine - 1))
   end function change_of

   !> Put points of line contacts into chains, one for each place.
   pure type(points_by_place_t) function chain_by_place(n_places, points) result(by_place)
      !> Places on all wires
      integer, intent(in) :: n_places
      type(contact_point_t), intent(in) :: points(:)
      integer :: k

      allocate (by_place%last(n_places), by_place%before(size(points)), source=0)
      do k = 1, size(points)
         by_place%before(k) = by_place%last(points(k)%line_place)
         by_place%last(points(k)%line_place) = k
      end do
   end function chain_by_place

   !> What the point carries: nothing where the overlap that it lies in is short, which is the matter of a crossing, and
   !> nothing where one wire runs into the other.
   !>
   !> Along the wire of the place the distance to the other is `D(s) = D + t s + k s^2/2`, which is below the sum of the
   !> radii over a half length `aW = sqrt(2 (delta + t^2/(2 k))/k)`: for straight wires that of their crossing.
   pure subroutine share_line_point(wires, elements, contact, sorted, xe, tangents, length, point)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the crossings, and these along their wires
      type(contact_set_t), intent(in) :: contact
      type(crossings_of_wires_t), intent(in) :: sorted
      !> Nodal positions (3, 4) [m] and tangents (3, 4), reference lengths (2) [m]: element of the foot first
      real(dp), intent(in) :: xe(3, 4), tangents(3, 4), length(2)
      type(contact_point_t), intent(inout) :: point
      type(line_profile_t) :: profile
      real(dp) :: tilt, reach, distance, of_length, part
      integer :: i

      profile = line_profile(xe, tangents, length, axis_hermite, point%xi_bar, point%xi, point%kinematics%normal, &
         point%kinematics%distance)
      associate (d => point%kinematics%distance, bend => profile%bend, quality => profile%quality, &
         pair => [point%element_bar, point%element])
         tilt = abs(profile%slope)
         point%law_sine = sqrt(max(0.0_dp, d*bend))
         point%law_angle = asin(min(1.0_dp, point%law_sine))
         if (point%foot_at_end) then
            bend = (quality(2) - tilt**2)/d
            tilt = max(tilt, abs(profile%slope_bar))
         end if
         point%line_share = 1
         point%section_share = 1
         point%in_lens = .false.
         if (bend > 0 .or. tilt > 0) then
            ! to where the wires are nearest; of a wedge, as far as one reaches that counts
            if (bend > 0) then
               reach = 1.5_dp*tilt/bend + 2*spacing_of_places(contact%places, pair, length)
            else
               reach = 1.5_dp*deepest*minval(elements%radius(pair))/max(tilt, least_tilt) &
                  + 2*spacing_of_places(contact%places, pair, length)
            end if
            call sorted%find_nearest(wires, contact%points, reach, reach + 2*sum(elements%radius(pair)), point, i, &
               distance)
            ! a wedge is cut by an end, and not by a crossing
            if (i > 0) then
               if (bend > 0 .or. any(contact%points(i)%held)) call share_with(contact%points(i), contact%places, &
                  elements, point)
            end if
            ! the lens is still open
            if (i == 0 .and. bend > 0) then
               if (-point%gap + tilt**2/(2*bend) <= 0) point%line_share = 0
            end if
         end if
         call find_lap(wires, elements, contact%places, point%kinematics%cos_angle, point, of_length)
         part = point%line_share*share_of_pass(quality)*flatness(tilt)
         point%dweight_dlap = merge(part, 0.0_dp, point%lens%near(1))
         point%weight = part*contact%places%length(point%line_place)*of_length
         point%cell%reach = cell_at_lap(wires, elements, contact%places, point)
         point%settled_weight = point%weight
         if (.not. any(quality > least_quality)) point%law_status = law_too_curved
      end associate
   end subroutine share_line_point

   !> Crossings beyond whose lens the places next to it still overlap, or whose lens reaches into that of another one.
   subroutine find_long_overlaps(wires, elements, sorted, contact)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> The crossings of the set
      type(crossings_of_wires_t), intent(in) :: sorted
      type(contact_set_t), intent(inout) :: contact
      !> aW [m]; 0: no lens (n_points)
      real(dp) :: half_length(size(contact%points))
      real(dp) :: reach, distance
      integer :: i, nearest

      half_length = 0
      do i = 1, size(contact%points)
         associate (crossing => contact%points(i))
            if (crossing%gap < 0 .and. has_lens(crossing)) half_length(i) = half_length_of(crossing, huge(distance))
         end associate
      end do
      contact%points%is_long = .false.
      call sorted%mark_common_lenses(wires, half_length, contact%points)
      do i = 1, size(contact%line_points)
         associate (point => contact%line_points(i), pair => [contact%line_points(i)%element_bar, &
            contact%line_points(i)%element])
            if (.not. point%gap < 0) cycle
            reach = sum(elements%length(pair))
            call sorted%find_nearest(wires, contact%points, reach, reach, point, nearest, distance)
            if (nearest == 0) cycle
            if (.not. half_length(nearest) > 0) cycle
            contact%points(nearest)%is_long = contact%points(nearest)%is_long .or. distance > &
               lens_ends*half_length(nearest) + spacing_of_places(contact%places, pair, elements%length(pair))
         end associate
      end do
   end subroutine find_long_overlaps

   !> What the line carries of a crossing, and how much the section of the wires counts in its law: both by the length
   !> of the lens.
   pure subroutine share_with(crossing, places, elements, point)
      type(contact_point_t), intent(in) :: crossing
      type(line_places_t), intent(in) :: places
      type(elements_t), intent(in) :: elements
      !> Out: with `line_share` and `section_share`
      type(contact_point_t), intent(inout) :: point
      real(dp) :: half_length, of_crossing, slope, radius

      if (crossing%is_long .or. .not. has_lens(crossing)) return
      associate (pair => [crossing%element_bar, crossing%element])
         radius = minval(elements%radius(pair))
         half_length = half_length_of(crossing, deepest*radius)
         call share_of_point(half_length, resolution*spacing_of_places(places, pair, elements%length(pair)), &
            of_crossing, slope)
      end associate
      point%line_share = 1 - of_crossing
      point%section_share = share_of_line(half_length/radius)
      ! next to an end the overlap is a wedge
      point%in_lens = .not. any(crossing%held)
   end subroutine share_with

   !> Of the two passes: half, unless one wire is curved about the other so that the other's places have no clear foot
   !> on it.
   pure real(dp) function share_of_pass(quality)
      !> q of this pass and of the other one
      real(dp), intent(in) :: quality(2)
      real(dp) :: clear(2)

      clear(1) = smooth_step((quality(1) - least_quality)/(good_quality - least_quality))
      clear(2) = smooth_step((quality(2) - least_quality)/(good_quality - least_quality))
      share_of_pass = half_pass
      if (sum(clear) > 0) share_of_pass = clear(1)/sum(clear)
   end function share_of_pass

end module litz_line_shares
