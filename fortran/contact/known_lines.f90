!> Whether an overlap of two tubes is part of a line contact that is known.
module litz_known_lines
   use litz_kinds, only: dp, pi
   use litz_contact_points, only: contact_point_t, points_by_wire_t, arc_at
   use litz_element_library, only: elements_t
   use litz_tube_overlaps, only: tube_overlap_t
   use litz_wires, only: wires_t
   implicit none
   private
   public :: is_on_known_line

   !> At the end of a wire: the axis may lean towards the other wire by this angle [rad] at most (5 degrees)
   real(dp), parameter :: largest_tilt = 5*pi/180

contains

   !> A point of a line contact of the same two wires is within reach of its deepest place.
   pure logical function is_on_known_line(wires, elements, points, by_wire, pair, radius, overlap) result(is_known)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> The points of all line contacts, and these by the wires of their feet
      type(contact_point_t), intent(in) :: points(:)
      type(points_by_wire_t), intent(in) :: by_wire
      !> Two elements
      integer, intent(in) :: pair(2)
      !> Their radii (2) [m]
      real(dp), intent(in) :: radius(2)
      type(tube_overlap_t), intent(in) :: overlap
      real(dp) :: arc(2), reach(2)
      integer :: side, k

      is_known = .false.
      if (any(abs(overlap%place) >= 1) .and. leans(overlap)) return
      arc = arc_at(wires, elements, pair, overlap%place)
      reach = elements%length(pair)/2 + sum(radius)
      do side = 1, 2
         k = by_wire%first(wires%wire(pair(side)))
         do while (k > 0 .and. .not. is_known)
            associate (point => points(k), other => 3 - side)
               if (is_in_contact(point) .and. wires%wire(point%element) == wires%wire(pair(other))) is_known = &
                  wires%arc_between(wires%wire(pair(side)), arc(side), point%arc_bar) < reach(side) .and. &
                  wires%arc_between(wires%wire(pair(other)), arc(other), point%arc) < reach(other)
            end associate
            k = by_wire%next(k)
         end do
      end do
   end function is_on_known_line

   !> It carries a part of the contact, or what is left of an interference fit keeps it open.
   pure logical function is_in_contact(point)
      type(contact_point_t), intent(in) :: point

      is_in_contact = point%kinematics%gap < 0 .and. (point%weight > 0 .or. point%gap >= 0)
   end function is_in_contact

   !> One of the axes runs into the other wire there.
   pure logical function leans(overlap)
      type(tube_overlap_t), intent(in) :: overlap
      real(dp) :: tilt

      associate (w => overlap%line, x1 => overlap%tangent(:, 2), xb1 => overlap%tangent(:, 1))
         tilt = maxval(abs([dot_product(w, x1)/norm2(x1), dot_product(w, xb1)/norm2(xb1)]))/norm2(w)
      end associate
      leans = tilt >= sin(largest_tilt)
   end function leans

end module litz_known_lines
