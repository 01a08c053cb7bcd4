!> What of a contact is carried at a crossing, and what along the line: by the length along which the wires overlap.
!>
!> A short overlap is the matter of the crossing in it, which has its integral in closed form; a long one that of the
!> places along it; between the two each has a share. Within an iteration the shares stay. Source: theory section 10.
module litz_line_shares
   use litz_kinds, only: dp, pi
   use litz_axis_choices, only: axis_hermite
   use litz_bent_contacts, only: is_bent, bends_of, sine_of_bends, qualities_of, settle_bends, change_of_bends, &
      change_of_resistance
   use litz_bent_wires, only: bent_crossing_t
   use litz_contact_lens, only: has_lens, sine_of_lens, sine_of_overlap, half_length_of, half_length_on, &
      divide_at_ends, tells_shares, place_at_ends, flatness, least_bend, deepest
   use litz_contact_points, only: contact_point_t, contact_set_t, points_by_place_t, chain_by_place, pair_geometry, &
      law_too_curved
   use litz_cut_lens, only: cut_lens_t, is_cut
   use litz_crossings_of_wires, only: crossings_of_wires_t, sort_crossings
   use litz_element_library, only: elements_t
   use litz_lap_of_place, only: lap_of_place_t
   use litz_lens_growth, only: settle_growth
   use litz_lens_law, only: share_of_point, share_of_line, smooth_step
   use litz_line_contact, only: serves_lines
   use litz_line_kinematics, only: line_profile_t, line_profile
   use litz_line_laps, only: find_lap, cell_at_lap, lap_at_crossing, bound_by_lap, find_round_end
   use litz_line_places, only: line_places_t, resolved_at_ends, resolved_by_places, spacing_of_places
   use litz_long_overlaps, only: find_long_overlaps
   use litz_model, only: model_t
   use litz_normal_forces, only: settle_ends, wires_of
   use litz_normal_law, only: normal_law_t
   use litz_parallel, only: worth_threads
   use litz_settled_angles, only: settle_angle
   use litz_share_changes, only: change_of_cut, change_of_cylinders, change_of_energies, change_of_law
   use litz_shares_at_ends, only: own_t, share_end, share_on_legs, share_along, share_at_crossing, half_pass, &
      least_sine
   use litz_turned_places, only: add_torque_of_place
   use litz_wires, only: wires_t
   implicit none
   private
   public :: share_crossings, share_line_point, has_grown, renew_shares

   !> q below which places have no clear foot, and from which on they have (theory section 10)
   real(dp), parameter :: least_quality = 0.25_dp, good_quality = 0.5_dp
   !> Shares that were found at less than this part of an overlap tell nothing of it: it is twice as long
   real(dp), parameter :: telling = 0.25_dp
   !> Less than this leads nowhere
   real(dp), parameter :: least_tilt = 1.0e-9_dp
   !> A change of the force by how the wires are bent matters this much more than one of a share
   real(dp), parameter :: bends_matter = 1000

   !> Part of the curvature of a lens from which on a place is in it: half of what is left of it at the end of the
   !> overlap of a wave, as that begins to be one with the next
   real(dp), parameter :: bends_as_lens = 0.25_dp

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
            if (point%shared_overlap > 0 .and. has_grown(point)) point%lens = cut_lens_t()
            call divide_at_ends(wires, elements, point)
            call place_at_ends(wires, elements, point)
            call set_angle_of_axes(point)
         end associate
      end do
      ! what a contact at an end carries depends on how ends cut the one at the other end
      do i = 1, size(contact%points)
         associate (point => contact%points(i))
            if (.not. serves_lines(model, point%pair)) cycle
            associate (law => model%interactions(model%contact_pairs(point%pair)%interaction)%normal)
               if (has_grown(point) .or. (law%is_per_length_only() .and. .not. point%shared_overlap > 0)) then
                  call reshare_crossing(law, wires, elements, contact, by_place, point)
               end if
            end associate
            call blend_angle_of_lens(point)
         end associate
      end do
   end subroutine share_crossings

   !> The angle that a law sees is that of the axes, or of the straight wires that stand for bent ones; next to ends and
   !> joints that of the axes stays what it was in the last state in balance.
   pure subroutine set_angle_of_axes(point)
      type(contact_point_t), intent(inout) :: point
      type(bent_crossing_t) :: straight

      point%law_angle = merge(point%lens%angle, point%kinematics%angle, is_cut(point%lens))
      ! of wires that run opposite ways the smaller one
      point%law_angle = min(point%law_angle, pi - point%law_angle)
      ! wires that are parallel may well meet end to end
      if (any(point%held)) point%law_angle = max(least_sine, point%law_angle)
      point%law_sine = sin(point%law_angle)
      point%bends%ratio = 1
      point%bends%as_equal = .false.
      if (.not. is_bent(point)) return
      straight = bends_of(point, point%law_angle)
      point%bends%ratio = straight%ratio
      point%bends%as_equal = straight%as_equal
      point%law_sine = straight%sine
      point%law_angle = asin(min(1.0_dp, straight%sine))
   end subroutine set_angle_of_axes

   !> It is that of straight wires with as long a lens, as far as that counts.
   pure subroutine blend_angle_of_lens(point)
      type(contact_point_t), intent(inout) :: point
      real(dp) :: sine, slope, curvature

      if (.not. point%lens_share > 0) return
      call sine_of_lens(point, sine, slope, curvature)
      point%law_sine = (1 - point%lens_share)*point%law_sine + point%lens_share*sine
      point%law_angle = asin(min(1.0_dp, point%law_sine))
   end subroutine blend_angle_of_lens

   !> What has been found of an overlap was that of one so much shorter that it tells nothing of it.
   pure logical function has_grown(point)
      type(contact_point_t), intent(in) :: point

      has_grown = point%gap < 0 .and. point%shared_overlap < -telling*point%gap
   end function has_grown

   !> What a crossing carries, with its force in proportion.
   subroutine reshare_crossing(law, wires, elements, contact, by_place, point)
      type(normal_law_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      type(points_by_place_t), intent(in) :: by_place
      type(contact_point_t), intent(inout) :: point
      real(dp) :: before

      before = point%weight
      call share_crossing(law, wires, elements, contact, by_place, point)
      ! the iteration goes on from the overlap that it has come to
      if (before > 0) point%mixed_force = point%mixed_force*(point%weight/before)
   end subroutine reshare_crossing

   !> What a crossing carries. Its law sees the angle of the axes; at small angles and along long lenses it sees that of
   !> straight wires with as long a lens.
   subroutine share_crossing(law, wires, elements, contact, by_place, point)
      type(normal_law_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      type(points_by_place_t), intent(in) :: by_place
      type(contact_point_t), intent(inout) :: point
      type(own_t) :: own
      real(dp) :: half_length, lap, radius

      ! an iterate in which the wires have passed each other tells nothing
      if (.not. point%kinematics%distance > 0) return
      point%shared_overlap = huge(radius)
      if (point%gap < 0) point%shared_overlap = merge(-point%gap, 0.0_dp, tells_shares(point))
      point%weight = 0
      point%lens_quality = 0
      if (.not. has_lens(point)) return
      if (any(point%held)) then
         call share_end(law, wires, elements, contact, by_place, point)
         return
      end if
      radius = minval(point%radius)
      half_length = half_length_of(point, deepest*radius)
      lap = lap_at_crossing(wires, elements, point)
      point%section_share = point%history%dent%share_of_section(share_of_line(min(half_length, lap)/radius))
      ! a penalty does not depend on the far field
      if (law%line_penalty() > 0) point%section_share = 0
      point%spot_section = max(point%section_share, share_of_kept(point, lap, radius))
      point%lens_sine = sine_of_overlap(point)
      point%lens_quality = qualities_of(point)
      point%lens_share = share_at_crossing(law, point, point%kinematics%angle)
      own%line_share = line_share_at(wires, elements, contact, by_place, point)
      ! as far as a lens is part of a longer overlap, only ends bound that
      own%length = min(half_length/max(1 - point%long_share, epsilon(radius)), lap)
      own%sine = (1 - point%lens_share)*sine_of_bends(point, point%kinematics%angle) &
         + point%lens_share*point%lens_sine
      call share_on_legs(law, wires, elements, contact, by_place, own, point)
   end subroutine share_crossing

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
      quality = qualities_of(point)
      share = share_of_pass(quality)*share_along(wires, elements, contact, by_place, point%element_bar, point%xi_bar, &
         point%element, point%arc) + share_of_pass(quality([2, 1]))*share_along(wires, elements, contact, by_place, &
         point%element, point%xi, point%element_bar, point%arc_bar)
   end function line_share_at

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
      type(contact_point_t) :: earlier
      integer :: i

      largest_change = 0
      sorted = sort_crossings(wires, contact%points)
      call find_long_overlaps(wires, elements, sorted, contact)
      do i = 1, size(contact%points)
         associate (point => contact%points(i), law => model%interactions(model%contact_pairs( &
            contact%points(i)%pair)%interaction)%normal)
            call settle_angle(point)
            point%lens_has_dent = point%dent_depth > 0
            point%torque_of_dents = 0
            if (point%gap < 0) then
               earlier = point
               call settle_bends(model, wires, elements, x, rotation, law, point)
               largest_change = max(largest_change, point%weight*max(bends_matter*change_of_bends(earlier, point), &
                  change_of_resistance(earlier, point)))
            end if
            if (serves_lines(model, point%pair)) call settle_growth(law, wires_of(model, elements, point), point)
         end associate
      end do
      call renew_places(model, wires, elements, x, rotation, sorted, contact, largest_change)
      if (size(contact%line_points) > 0) by_place = chain_by_place(size(contact%places%xi), contact%line_points)
      do i = 1, size(contact%points)
         associate (point => contact%points(i))
            if (.not. point%gap < 0) cycle
            earlier = point
            point%lens = cut_lens_t()
            call divide_at_ends(wires, elements, point)
            largest_change = max(largest_change, change_of_cut(earlier%lens, point%lens))
            associate (law => model%interactions(model%contact_pairs(point%pair)%interaction)%normal)
               if (point%shared_overlap > 0) call reshare_crossing(law, wires, elements, contact, by_place, point)
               largest_change = max(largest_change, change_of_cylinders(earlier, point))
               if (serves_lines(model, point%pair)) call settle_growth(law, wires_of(model, elements, point), point)
               if (is_cut(point%lens)) then
                  call set_angle_of_axes(point)
                  if (serves_lines(model, point%pair)) call blend_angle_of_lens(point)
                  call settle_ends(law, wires_of(model, elements, point), point)
                  largest_change = max(largest_change, change_of_energies(earlier%lens, point%lens))
               end if
            end associate
            largest_change = max(largest_change, change_of_law(earlier, point))
         end associate
      end do
   end subroutine renew_shares

   !> The same of the points of line contacts; in which torques of dents count at their crossings.
   subroutine renew_places(model, wires, elements, x, rotation, sorted, contact, largest_change)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      !> The crossings of the set
      type(crossings_of_wires_t), intent(in) :: sorted
      type(contact_set_t), intent(inout) :: contact
      !> Largest change of any share so far [-]
      real(dp), intent(inout) :: largest_change
      real(dp) :: xe(3, 4), t(3, 4), length(2), before
      integer :: i, crossing(size(contact%line_points))

      !$omp parallel do schedule(static) private(before, xe, t, length) reduction(max:largest_change) &
      !$omp if (size(contact%line_points) >= worth_threads)
      do i = 1, size(contact%line_points)
         associate (point => contact%line_points(i))
            before = point%weight
            call pair_geometry(model, wires, elements, point%element_bar, point%element, x, rotation, xe, t, length)
            call share_line_point(wires, elements, contact, sorted, xe, t, length, point, crossing(i))
            if (point%gap < 0) largest_change = max(largest_change, abs(point%weight - before)/contact%places%length( &
               point%line_place))
         end associate
      end do
      !$omp end parallel do
      do i = 1, size(contact%line_points)
         if (contact%line_points(i)%lens_has_dent) call add_torque_of_place(model, elements, contact%line_points(i), &
            contact%points(crossing(i)))
      end do
   end subroutine renew_places

   !> What the point carries: nothing where the overlap that it lies in is short, which is the matter of a crossing, and
   !> nothing where one wire runs into the other.
   !>
   !> Along the wire of the place the distance to the other is `D(s) = D + t s + k s^2/2`, which is below the sum of the
   !> radii over a half length `aW = sqrt(2 (delta + t^2/(2 k))/k)`: for straight wires that of their crossing.
   pure subroutine share_line_point(wires, elements, contact, sorted, xe, tangents, length, point, crossing)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the crossings, and these along their wires
      type(contact_set_t), intent(in) :: contact
      type(crossings_of_wires_t), intent(in) :: sorted
      !> Nodal positions (3, 4) [m] and tangents (3, 4), reference lengths (2) [m]: element of the foot first
      real(dp), intent(in) :: xe(3, 4), tangents(3, 4), length(2)
      type(contact_point_t), intent(inout) :: point
      !> In whose lens it may lie, or 0
      integer, intent(out) :: crossing
      type(line_profile_t) :: profile
      real(dp) :: tilt, reach, distance, rate, of_length, of_lap(2), of_course(2), part, curvature
      integer :: legs(2)

      crossing = 0
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
         point%energy_ratio = 1
         point%section_share = 1
         ! of the energy per length along the wire
         curvature = profile%slope**2*point%lap%stiffness - bend*point%lap%force
         point%lap = lap_of_place_t(force=point%lap%force, stiffness=point%lap%stiffness)
         point%spot_section = 1
         point%kept_overlap = 0
         point%deepest = 0
         point%lens_depth = 0
         point%in_lens = .false.
         point%lens_has_dent = .false.
         point%shared_overlap = huge(d)
         if (bend > 0 .or. tilt > 0) then
            ! to where the wires are nearest; of a wedge, as far as one reaches that counts
            if (bend > 0) then
               reach = 1.5_dp*tilt/bend + 2*spacing_of_places(contact%places, pair, length)
            else
               reach = 1.5_dp*deepest*minval(elements%radius(pair))/max(tilt, least_tilt) &
                  + 2*spacing_of_places(contact%places, pair, length)
            end if
            ! what is up to twice as far becomes another overlap
            call sorted%find_nearest(wires, 2*reach, 2*reach + 2*sum(elements%radius(pair)), point, crossing, &
               distance, legs)
            if (crossing > 0) then
               associate (of => contact%points(crossing))
                  call share_with(of, legs, 2 - distance/reach, bend, contact%places, elements, point)
                  if (point%line_share < 1) point%shared_overlap = max(0.0_dp, -of%gap)
               end associate
            else if (bend > 0) then
               if (-point%gap + tilt**2/(2*bend) <= 0) then
                  point%line_share = 0
                  point%shared_overlap = 0
               end if
            end if
         end if
         rate = point%kinematics%cos_angle/max(least_quality, quality(1))
         call find_lap(wires, elements, contact%places, profile, rate, point, of_length, of_lap, of_course)
         part = point%line_share*share_of_pass(quality)*flatness(tilt)
         point%lap%dweight = part*of_lap(1)
         point%lap%d2weight = part*of_lap(2)
         point%lap%of_course = part*of_course(1)*curvature
         point%lap%dof_course = part*of_course(2)*curvature
         call bound_by_lap(wires, elements, minval(elements%radius(pair)), point)
         call find_round_end(wires, elements, contact%places, min(1.0_dp, part/half_pass), point)
         point%weight = part*contact%places%length(point%line_place)*of_length
         point%cell%reach = cell_at_lap(wires, elements, contact%places, rate, point)
         point%settled_weight = point%weight
         if (.not. any(quality > least_quality)) point%law_status = law_too_curved
      end associate
   end subroutine share_line_point

   !> What the line carries of a crossing, and how much the section of the wires counts in its law: both by the length
   !> of the lens.
   pure subroutine share_with(crossing, legs, nearness, bend, places, elements, point)
      type(contact_point_t), intent(in) :: crossing
      !> At an end or joint, or beyond one: its legs on the wires of the point, barred first (2)
      integer, intent(in) :: legs(2)
      !> From 1 on where its lens should lie as seen from the place, 0 where that is a different overlap
      real(dp), intent(in) :: nearness
      !> Curvature of the distance at the place [1/m]
      real(dp), intent(in) :: bend
      type(line_places_t), intent(in) :: places
      type(elements_t), intent(in) :: elements
      !> Out: with `line_share` and `section_share`
      type(contact_point_t), intent(inout) :: point
      real(dp) :: half_length, of_crossing, short, slope, radius, spacing, at_end
      integer :: pair(2)

      if (.not. has_lens(crossing)) return
      short = (1 - crossing%long_share)*smooth_step(nearness)
      ! a wedge is cut by an end or joint, and not by a crossing; what bends less than its lens goes on beyond it
      if (.not. any(legs > 0)) short = short*smooth_step(bend*crossing%kinematics%distance &
         /(bends_as_lens*sine_of_overlap(crossing)**2))
      if (.not. short > 0) return
      radius = minval(crossing%radius)
      if (any(legs > 0)) then
         associate (bar => crossing%legs(legs(1)), leg => crossing%legs(legs(2)))
            pair = [bar%element, leg%element]
            half_length = half_length_on(crossing, bar, leg, deepest*radius)
         end associate
         at_end = 1
      else
         pair = [crossing%element_bar, crossing%element]
         half_length = half_length_of(crossing, deepest*radius)
         ! as it comes to an end it is one of that
         at_end = maxval(merge(smooth_step(1 - crossing%place/half_length), 0.0_dp, crossing%lens%near))
      end if
      spacing = (1 - at_end)*resolved_by_places(places, pair, elements%length(pair)) + at_end*resolved_at_ends(places, &
         pair, elements%length(pair), elements%radius(pair))
      call share_of_point(half_length, spacing, of_crossing, slope)
      point%line_share = 1 - short*of_crossing
      point%energy_ratio = 1 + short*(crossing%energy_ratio - 1)
      point%section_share = point%history%dent%share_of_section(1 - short*(1 - share_of_line(half_length/radius)))
      point%spot_section = point%section_share
      ! next to an end the overlap is a wedge
      point%in_lens = .not. any(legs > 0)
      call bound_field(crossing, half_length, radius, point)
      if (.not. point%in_lens) return
      point%kept_overlap = crossing%kept_overlap
      point%deepest = crossing%deepest
      point%lens_has_dent = crossing%lens_has_dent
      ! of straight wires slope^2/(2 bend), on one that bends not so
      point%lens_depth = max(0.0_dp, point%gap - crossing%gap)
      point%spot_section = max(point%spot_section, share_of_kept(crossing, huge(radius), radius))
   end subroutine share_with

   !> How much the section counted in the largest lens of a crossing.
   pure real(dp) function share_of_kept(crossing, lap, radius) result(share)
      type(contact_point_t), intent(in) :: crossing
      !> Largest half length that counts, and the smaller radius [m]
      real(dp), intent(in) :: lap, radius
      real(dp) :: half_length

      half_length = sqrt(2*crossing%kinematics%distance*crossing%kept_overlap)/sine_of_overlap(crossing)
      share = share_of_line(min(half_length, lap)/radius)
   end function share_of_kept

   !> Either the sections of the wires bound the field of a place, or how the wires part does: where they hardly part at
   !> the place itself, as side by side in a plane, it is the lens of the crossing to which it belongs.
   pure subroutine bound_field(crossing, half_length, radius, point)
      type(contact_point_t), intent(in) :: crossing
      !> Of its overlap, and the smaller radius [m]
      real(dp), intent(in) :: half_length, radius
      !> With its `section_share`; out: its law sees at least this angle
      type(contact_point_t), intent(inout) :: point
      real(dp) :: bend

      bend = (1 - point%section_share)*least_bend(0.0_dp, max(0.0_dp, min(-crossing%gap, deepest*radius)), &
         max(half_length, radius))
      point%law_sine = max(point%law_sine, sqrt(point%kinematics%distance*bend))
      point%law_angle = asin(min(1.0_dp, point%law_sine))
   end subroutine bound_field

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
