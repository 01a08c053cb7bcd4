!> What a place stands for next to the end of the wire that it lies along.
!>
!> There the overlap ends between two places, wherever the end comes to lie: the last two places that have their feet on
!> the wire stand for all that lies between them and the end, the next one, which is beyond, for nothing. A short lap
!> bounds the far field of the places in it.
module litz_line_laps
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_point_t, leg_t
   use litz_element_library, only: elements_t
   use litz_lens_law, only: share_of_line, share_of_point, slope_of_line_share, smooth_step
   use litz_line_kinematics, only: line_profile_t
   use litz_line_places, only: line_places_t, resolved_at_ends
   use litz_round_end, only: round_end_t
   use litz_wires, only: wires_t
   implicit none
   private
   public :: find_lap, slide_along_lap, cell_at_lap, distances_to_ends, lap_from_end, lap_at_crossing, bound_by_lap
   public :: find_round_end

   !> Ends and places that are nearer to each other than this part of the distance of places lie side by side: all
   !> places of a lap have to find the same
   real(dp), parameter :: tie = 1.0e-8_dp
   !> Part of the overlap at one place from which on that at the next one goes on
   real(dp), parameter :: goes_on = 0.25_dp

   !> Part of the Hertz contact of a round end that lies beyond the end of a line
   real(dp), parameter :: half_of_end = 0.5_dp
   !> Radii that round ends add to the length of a lap (from half-spaces, see the theory)
   real(dp), parameter :: beyond_lap = 0.4_dp

contains

   !> Part of its length for which a place stands. What lies between the last place of a lap and its end has the linear
   !> course that the last two places tell, so that nothing jumps where the end passes a place: with the distance `h` of
   !> places, of which the end is `r` behind the last one, that one has `r + r^2/(2 h)` more than up to itself, and the
   !> one before it `r^2/(2 h)` less, as far as the overlap goes on to the last one. As their feet slide they gain or
   !> lose length. Where both wires end within two distances of places, no two places tell a course: the place at the
   !> end of its wire stands for the whole lap, until from `h` on it passes its length on to the next one, `h - r` and
   !> `2 r`. Of the two passes one begins at either end of the lap, so that together they have the sum of a linear
   !> course. The energy per length is curved where the course of the force is linear: as the end passes a place the sum
   !> changes by half of a second difference. What the sum should have instead, the integral and the error of the
   !> trapezoidal rule of as long a lap, has that change as a force along the wires.
   pure subroutine find_lap(wires, elements, places, profile, rate, point, share, of_lap, of_course)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(line_places_t), intent(in) :: places
      !> Of the distance round the place
      type(line_profile_t), intent(in) :: profile
      !> By how much the foot moves along the element of the other wire as the place does [-]
      real(dp), intent(in) :: rate
      !> Out: with the end that it is next to
      type(contact_point_t), intent(inout) :: point
      !> [-], and how the length changes with the distance of the foot from the end [-], and how that does [1/m] (2)
      real(dp), intent(out) :: share, of_lap(2)
      !> How what the linear course leaves of the integral changes with that distance, in curvatures of what is
      !> integrated [m^2], and how that does [m]
      real(dp), intent(out) :: of_course(2)
      real(dp) :: behind, spacing, beyond, own_end(2), linear
      integer :: ahead
      logical :: is_last

      point%lens%near = .false.
      share = 1
      of_lap = 0
      of_course = 0
      call find_end_of_lap(wires, elements, places, rate, point, ahead, behind)
      if (ahead == 0) return
      share = 0
      if (point%foot_at_end) return
      spacing = 2*half_part(elements, places, point%element)
      own_end = distances_to_ends(wires, elements, point%element, point%arc)
      is_last = behind < spacing - tie*spacing
      linear = share_of_course(wires, profile, spacing, ahead, is_last, point)
      associate (length => places%length(point%line_place), before => own_end(3 - ahead))
         beyond = max(0.0_dp, behind - spacing)
         if (before < (1 - tie)*spacing) then
            share = (min(behind, spacing) - (1 + linear)/2*beyond)/length
            of_lap(1) = merge(1.0_dp, -(1 + linear)/2, is_last)/abs(rate)
         else if (before < (2 - tie)*spacing .and. is_last) then
            share = (3 + linear)/2*behind/length
            of_lap(1) = (3 + linear)/(2*abs(rate))
            associate (r => behind/spacing)
               of_course = linear*[spacing*(18*r - 2 - 3*r**2), (18 - 6*r)/abs(rate)]*spacing/(12*abs(rate))
            end associate
         else if (is_last) then
            share = (length - spacing/2 + behind + linear*behind**2/(2*spacing))/length
            of_lap = [1 + linear*behind/spacing, linear/(spacing*abs(rate))]/abs(rate)
            associate (r => behind/spacing)
               of_course = linear*[spacing*(6*r**2 + 6*r + 1), (12*r + 6)/abs(rate)]*spacing/(12*abs(rate))
            end associate
         else
            share = (length - linear*beyond**2/(2*spacing))/length
            of_lap = -linear*[beyond, 1/abs(rate)]/(spacing*abs(rate))
         end if
      end associate
      point%lens%near(1) = .true.
      associate (to_ends => distances_to_ends(wires, elements, point%element_bar, point%arc_bar))
         point%lens%side(1) = minloc(to_ends, 1)
         point%place(1) = minval(to_ends)
      end associate
   end subroutine find_lap

   !> How far the last two places of a lap tell the course up to its end: an overlap that ends before the last one does
   !> not go on.
   pure real(dp) function share_of_course(wires, profile, spacing, ahead, is_last, point) result(share)
      type(wires_t), intent(in) :: wires
      type(line_profile_t), intent(in) :: profile
      !> Of places [m]
      real(dp), intent(in) :: spacing
      !> The end of the lap lies towards the first (1) or the second end (2) of the wire of the place
      integer, intent(in) :: ahead
      !> The place is the last one, or the one before that
      logical, intent(in) :: is_last
      type(contact_point_t), intent(in) :: point
      real(dp) :: way, overlap(2)

      way = spacing*wires%direction(point%element)*merge(1, -1, (ahead == 2) .neqv. is_last)
      overlap = [-point%gap, -point%gap - (profile%slope + profile%bend*way/2)*way]
      if (is_last) overlap = overlap([2, 1])
      share = smooth_step(overlap(2)/max(goes_on*overlap(1), tiny(share)))
   end function share_of_course

   !> The length for which a place stands, and what bounds its far field, as its foot has slid.
   pure subroutine slide_along_lap(wires, elements, point)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the weight and the place that it had
      type(contact_point_t), intent(inout) :: point
      real(dp) :: to_end(2), slid

      if (.not. point%lens%near(1)) return
      to_end = distances_to_ends(wires, elements, point%element_bar, point%arc_bar)
      associate (now => to_end(point%lens%side(1)))
         slid = now - point%place(1)
         point%weight = max(0.0_dp, point%weight + (point%lap%dweight + point%lap%d2weight*slid/2)*slid)
         point%lap%dweight = point%lap%dweight + point%lap%d2weight*slid
         point%lap%of_course = point%lap%of_course + point%lap%dof_course*slid
         point%lap%strip_bound = max(0.0_dp, point%lap%strip_bound + point%lap%dstrip_bound*slid)
         associate (round => point%lap%round_end)
            round%beyond = round%beyond + round%dbeyond*slid
         end associate
         point%place(1) = now
      end associate
   end subroutine slide_along_lap

   !> From a place to the ends of the part of its wire for which it stands, against and along its element (2) [m].
   pure function cell_at_lap(wires, elements, places, rate, point) result(reach)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(line_places_t), intent(in) :: places
      !> By how much the foot moves along the element of the other wire as the place does [-]
      real(dp), intent(in) :: rate
      type(contact_point_t), intent(in) :: point
      real(dp) :: reach(2), behind, half
      integer :: ahead

      half = half_part(elements, places, point%element)
      reach = half
      ! at a node, the other side lies in the next element, if there is one
      if (point%xi <= -1) reach(1) = places%length(point%line_place) - reach(2)
      if (point%xi >= 1) reach(2) = places%length(point%line_place) - reach(1)
      call find_end_of_lap(wires, elements, places, rate, point, ahead, behind)
      if (ahead == 0 .or. behind >= 2*half*(1 - tie)) return
      if (wires%direction(point%element) < 0) ahead = 3 - ahead
      reach(ahead) = max(0.0_dp, reach(ahead) - half + behind)
   end function cell_at_lap

   !> The end of the other wire, where it comes before the next place but one and the end of the wire of this one.
   pure subroutine find_end_of_lap(wires, elements, places, rate, point, ahead, behind)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(line_places_t), intent(in) :: places
      !> By how much the foot moves along the element of the other wire as the place does [-]
      real(dp), intent(in) :: rate
      type(contact_point_t), intent(in) :: point
      !> It lies towards the first (1) or the second end (2) of the wire of the place; 0: there is none
      integer, intent(out) :: ahead
      !> How far the wire of the place leads from it to the end [m]
      real(dp), intent(out) :: behind
      real(dp) :: from_ends(2), own(2), spacing
      integer :: side

      ahead = 0
      from_ends = distances_to_ends(wires, elements, point%element_bar, point%arc_bar)
      side = minloc(from_ends, 1)
      spacing = 2*half_part(elements, places, point%element)
      behind = 0
      if (.not. point%foot_at_end) then
         if (.not. from_ends(side) < 2*spacing*(1 - tie)*abs(rate)) return
         behind = from_ends(side)/abs(rate)
      end if
      ahead = merge(side, 3 - side, rate*wires%direction(point%element_bar)*wires%direction(point%element) > 0)
      own = distances_to_ends(wires, elements, point%element, point%arc)
      ! the wire of the place ends first
      if (own(ahead) <= behind + tie*spacing .and. .not. point%foot_at_end) ahead = 0
   end subroutine find_end_of_lap

   !> Half of the distance of places in an element [m].
   pure real(dp) function half_part(elements, places, e)
      type(elements_t), intent(in) :: elements
      type(line_places_t), intent(in) :: places
      !> Element
      integer, intent(in) :: e

      half_part = elements%length(e)/places%n_parts(e)/2
   end function half_part

   !> How far two wires lie beside each other from the end of one of them on, until the other one ends [m].
   pure real(dp) function lap_from_end(wires, elements, leg, other) result(lap)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Of a contact of an end: the wire that ends there, and the other one
      type(leg_t), intent(in) :: leg, other
      real(dp) :: from_end(2), to_ends(2)
      logical :: is_forward

      from_end = distances_to_ends(wires, elements, leg%element, leg%arc)
      to_ends = distances_to_ends(wires, elements, other%element, other%arc)
      ! from its first end on the wire leads forward
      is_forward = (from_end(1) < from_end(2)) .eqv. dot_product(leg%along, other%along) &
         *product(wires%direction([leg%element, other%element])) > 0
      lap = to_ends(merge(2, 1, is_forward))
   end function lap_from_end

   !> How far two wires lie beside each other from their crossing on, until one of them ends, on the longer side [m]: as
   !> the crossing comes to an end, all that lies between that and the other one.
   pure real(dp) function lap_at_crossing(wires, elements, point) result(lap)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point

      lap = maxval(min(distances_to_ends(wires, elements, point%element, point%arc), other_way(wires, elements, point)))
   end function lap_at_crossing

   !> Between ends that are near each other the strip itself bounds the field of a place, beside the sections. Pressed
   !> evenly its approach in a half-space is `2 f/(pi E*) (ln(4 h/b) + 1/2)` in the middle of the lap, with the half
   !> length h, and a little more for the round ends beyond it.
   pure subroutine bound_by_lap(wires, elements, radius, point)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> The smaller one [m]
      real(dp), intent(in) :: radius
      !> In: with the end that it is next to; out: with the end that bounds its lap alone
      type(contact_point_t), intent(inout) :: point
      real(dp) :: lap, length, of_strip, short, to_ends(2)
      integer :: side

      call find_lap_round(wires, elements, point, lap, side)
      length = exp(0.5_dp)*lap/2 + beyond_lap*radius
      of_strip = (4*length)**(-2)
      short = 1 - share_of_line(lap/2/radius)
      point%lap%strip_bound = short*of_strip
      if (side > 0 .and. (side == point%lens%side(1) .or. .not. point%lens%near(1))) then
         to_ends = distances_to_ends(wires, elements, point%element_bar, point%arc_bar)
         point%lens%near(1) = .true.
         point%lens%side(1) = side
         point%place(1) = to_ends(side)
         point%lap%dstrip_bound = -exp(0.5_dp)*point%lap%strip_bound/length &
            - slope_of_line_share(lap/2/radius)/(2*radius)*of_strip
      end if
   end subroutine bound_by_lap

   !> The round end of the wire of a place that is its last one: half of its Hertz contact, as far as the places along
   !> the line carry what is before it, and the contact at the end does not carry a short lap.
   pure subroutine find_round_end(wires, elements, places, line_share, point)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(line_places_t), intent(in) :: places
      !> Of the place [-]
      real(dp), intent(in) :: line_share
      type(contact_point_t), intent(inout) :: point
      real(dp) :: own(2), other(2), short, slope
      integer :: inner

      point%lap%round_end = round_end_t()
      own = distances_to_ends(wires, elements, point%element, point%arc)
      inner = maxloc(own, 1)
      if (point%foot_at_end .or. .not. own(3 - inner) < tie*elements%length(point%element)) return
      if (.not. wires%is_free(3 - inner, wires%wire(point%element))) return
      other = other_way(wires, elements, point)
      associate (pair => [point%element_bar, point%element])
         call share_of_point(min(own(inner), other(inner)), resolved_at_ends(places, pair, elements%length(pair), &
            elements%radius(pair)), short, slope)
      end associate
      associate (round => point%lap%round_end, lens => point%lens)
         round%share = half_of_end*min(line_share, 1 - short)
         round%distance = point%kinematics%distance
         round%beyond = other(3 - inner)
         associate (side => merge(3 - inner, inner, runs_along(wires, point)))
            if (.not. lens%near(1) .and. round%beyond < round%distance) then
               lens%near(1) = .true.
               lens%side(1) = side
               point%place(1) = round%beyond
            end if
            if (lens%near(1)) round%dbeyond = merge(1, -1, lens%side(1) == side)
         end associate
      end associate
   end subroutine find_round_end

   !> How far two wires lie beside each other, from the end of either of them to that of either, and the end of the
   !> barred wire that bounds this lap alone, so that it changes as the foot slides.
   pure subroutine find_lap_round(wires, elements, point, lap, side)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Between the ends
      type(contact_point_t), intent(in) :: point
      !> [m]
      real(dp), intent(out) :: lap
      !> Towards the first (1) or the second end (2); 0: both ends of it or none bound the lap
      integer, intent(out) :: side
      real(dp) :: own(2), other(2)

      own = distances_to_free_ends(point%element, point%arc)
      other = distances_to_free_ends(point%element_bar, point%arc_bar)
      if (.not. runs_along(wires, point)) other = other([2, 1])
      lap = sum(min(huge(lap)/2, own, other))
      side = 0
      if (count(other < own) /= 1) return
      side = findloc(other < own, .true., 1)
      if (.not. runs_along(wires, point)) side = 3 - side

   contains

      !> Beyond a joint wires go on (2) [m].
      pure function distances_to_free_ends(e, arc) result(distance)
         !> Element
         integer, intent(in) :: e
         !> Arc length along its wire [m]
         real(dp), intent(in) :: arc
         real(dp) :: distance(2)

         distance = merge(distances_to_ends(wires, elements, e, arc), huge(arc), wires%is_free(:, wires%wire(e)))
      end function distances_to_free_ends

   end subroutine find_lap_round

   !> Way on the barred wire to its ends, against and along the unbarred one (2) [m].
   pure function other_way(wires, elements, point) result(way)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point
      real(dp) :: way(2)

      way = distances_to_ends(wires, elements, point%element_bar, point%arc_bar)
      if (.not. runs_along(wires, point)) way = way([2, 1])
   end function other_way

   pure logical function runs_along(wires, point)
      type(wires_t), intent(in) :: wires
      type(contact_point_t), intent(in) :: point

      runs_along = point%kinematics%cos_angle*product(wires%direction([point%element_bar, point%element])) > 0
   end function runs_along

   !> Lengths of wire from a place to the first and to the second end [m]; huge along a closed wire.
   pure function distances_to_ends(wires, elements, e, arc) result(distance)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      !> Arc length along its wire [m]
      real(dp), intent(in) :: arc
      real(dp) :: distance(2)

      distance = huge(distance)
      associate (w => wires%wire(e), last => wires%element(wires%first(wires%wire(e) + 1) - 1))
         if (.not. wires%circumference(w) > 0) distance = [arc, wires%arc(last) + elements%length(last)/2 - arc]
      end associate
   end function distances_to_ends

end module litz_line_laps
