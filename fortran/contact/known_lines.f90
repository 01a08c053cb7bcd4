!> Whether an overlap of two tubes is part of a line contact that is known.
module litz_known_lines
   use litz_kinds, only: dp, pi
   use litz_contact_points, only: contact_point_t, contact_set_t, arc_at, points_by_place_t
   use litz_element_library, only: elements_t
   use litz_line_places, only: place_at
   use litz_tube_overlaps, only: tube_overlap_t
   use litz_wires, only: wires_t
   implicit none
   private
   public :: is_on_known_line

   !> At the end of a wire: the axis may lean towards the other wire by this angle [rad] at most (5 degrees)
   real(dp), parameter :: largest_tilt = 5*pi/180

contains

   !> A point of a line contact of the same two wires is within reach of its deepest place.
   pure logical function is_on_known_line(wires, elements, contact, by_place, pair, overlap) result(is_known)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the points of lines, and these by their places
      type(contact_set_t), intent(in) :: contact
      type(points_by_place_t), intent(in) :: by_place
      !> Two elements
      integer, intent(in) :: pair(2)
      type(tube_overlap_t), intent(in) :: overlap
      real(dp) :: arc(2), reach(2)
      integer :: side, ahead

      is_known = .false.
      if (size(contact%line_points) == 0) return
      if (any(abs(overlap%place) >= 1) .and. leans(overlap)) return
      arc = arc_at(wires, elements, pair, overlap%place)
      reach = elements%length(pair)/2 + sum(elements%radius(pair))
      do side = 1, 2
         is_known = is_known .or. has_point_on(pair(side))
         do ahead = 1, 2
            is_known = is_known .or. has_point_along(side, ahead)
         end do
      end do

   contains

      !> Further along the wire of one of the elements, beyond one of its ends.
      pure logical function has_point_along(side, ahead) result(has_point)
         !> Number of the element, and of its end
         integer, intent(in) :: side, ahead
         real(dp) :: distance
         integer :: before, e, next

         has_point = .false.
         before = pair(side)
         e = wires%next(ahead, before)
         distance = 0
         do while (e > 0 .and. e /= pair(side) .and. distance < reach(side) .and. .not. has_point)
            has_point = has_point_on(e)
            distance = distance + elements%length(e)
            next = wires%next(merge(2, 1, wires%next(1, e) == before), e)
            before = e
            e = next
         end do
      end function has_point_along

      !> At a place of an element.
      pure logical function has_point_on(e) result(has_point)
         !> Its number
         integer, intent(in) :: e
         integer :: i, k

         has_point = .false.
         do i = 0, contact%places%n_parts(e)
            k = by_place%last(place_at(contact%places, e, i))
            do while (k > 0 .and. .not. has_point)
               has_point = is_in_reach(contact%line_points(k))
               k = by_place%before(k)
            end do
            if (has_point) return
         end do
      end function has_point_on

      !> The point is one of the same two wires, and near.
      pure logical function is_in_reach(point)
         type(contact_point_t), intent(in) :: point
         integer :: foot

         is_in_reach = .false.
         do foot = 1, 2
            associate (own => 3 - foot)
               if (wires%wire(point%element_bar) /= wires%wire(pair(foot)) .or. wires%wire(point%element) /= &
                  wires%wire(pair(own)) .or. .not. is_in_contact(point)) cycle
               is_in_reach = is_in_reach .or. (wires%arc_between(wires%wire(pair(foot)), arc(foot), point%arc_bar) &
                  < reach(foot) .and. wires%arc_between(wires%wire(pair(own)), arc(own), point%arc) < reach(own))
            end associate
         end do
      end function is_in_reach

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
