!> What a place stands for next to the end of the wire that it lies along.
!>
!> There the overlap ends between two places, wherever the end comes to lie: the last place that has its foot on the
!> wire stands for all that lies between it and the end, the next one, which is beyond, for nothing.
module litz_line_laps
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_point_t, leg_t
   use litz_element_library, only: elements_t
   use litz_line_places, only: line_places_t
   use litz_wires, only: wires_t
   implicit none
   private
   public :: share_at_lap, distances_to_ends, lap_from_end, lap_at_crossing

   !> Ends and places that are nearer to each other than this part of the distance of places lie side by side: all
   !> places of a lap have to find the same
   real(dp), parameter :: tie = 1.0e-8_dp

contains

   !> Part of its length for which a place stands; more than 1 where the next one is beyond the end.
   pure real(dp) function share_at_lap(wires, elements, places, cosine, point) result(share)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(line_places_t), intent(in) :: places
      !> Of the angle between the elements, the sign of which says whether they run the same way
      real(dp), intent(in) :: cosine
      type(contact_point_t), intent(in) :: point
      real(dp) :: to_end(2), own(2), spacing
      integer :: side, ahead

      share = 1
      to_end = distances_to_ends(wires, elements, point%element_bar, point%arc_bar)
      side = minloc(to_end, 1)
      spacing = elements%length(point%element)/places%n_parts(point%element)
      if (to_end(side) >= spacing - tie*spacing) return
      ahead = merge(side, 3 - side, cosine*wires%direction(point%element_bar)*wires%direction(point%element) > 0)
      own = distances_to_ends(wires, elements, point%element, point%arc)
      ! the wire of the place ends first
      if (own(ahead) <= to_end(side) + tie*spacing .and. .not. point%foot_at_end) return
      share = 0
      if (point%foot_at_end) return
      associate (length => places%length(point%line_place))
         share = (length - spacing/2 + to_end(side))/length
      end associate
   end function share_at_lap

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

   !> Half of the length along which two wires that cross lie beside each other, until one of them ends [m].
   pure real(dp) function lap_at_crossing(wires, elements, point) result(half_lap)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point
      real(dp) :: own(2), other(2)
      logical :: runs_along

      runs_along = point%kinematics%cos_angle*product(wires%direction([point%element_bar, point%element])) > 0
      own = distances_to_ends(wires, elements, point%element, point%arc)
      other = distances_to_ends(wires, elements, point%element_bar, point%arc_bar)
      if (.not. runs_along) other = other([2, 1])
      half_lap = sum(min(own, other)/2)
   end function lap_at_crossing

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
