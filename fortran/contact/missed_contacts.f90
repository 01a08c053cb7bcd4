!> Overlaps of two elements that are no contact of the ledger: local minima of the distance of the two tubes.
module litz_missed_contacts
   use litz_kinds, only: dp
   use litz_axis, only: axis_polynomial, axis_sagitta
   use litz_closest_points, only: local_minima, max_minima
   use litz_contact_findings, only: finding_t, worse_of, finding_none, finding_missed, finding_second, finding_joined, &
      finding_end, finding_kink, finding_line
   use litz_contact_joints, only: end_paths, path_between, lead_apart, joint_length, joined_radii
   use litz_contact_points, only: contact_set_t, contact_point_t, points_by_wire_t, pair_geometry, axis_of_pair, &
      away_from, arc_at, points_by_place_t
   use litz_element_library, only: elements_t
   use litz_joint_overlaps, only: inspect_legs, leads_to_joint
   use litz_known_lines, only: is_on_known_line
   use litz_model, only: model_t
   use litz_rotations, only: cross
   use litz_straight_segments, only: segment_distance
   use litz_tube_overlaps, only: tube_overlap_t, overlap_at, overlap_of_reference, unseen_overlap
   use litz_wires, only: wires_t
   implicit none
   private
   public :: inspect_pair, is_at

   !> Overlaps at angles with a sine below this are side by side (10 degrees)
   real(dp), parameter :: side_by_side = 0.17_dp
   !> Cosine between the line to the other wire and an axis that counts as zero
   real(dp), parameter :: flat = 1.0e-6_dp
   !> Places nearer to a contact than this, in sums of radii, are that contact
   real(dp), parameter :: same_contact = 0.2_dp

contains

   !> The worst overlap of two elements that is no contact; `finding_none`: none.
   subroutine inspect_pair(model, wires, elements, contact, by_wire, by_place, candidate, has_point, is_joined, &
      x, rotation, finding)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the points of this state: crossings by their barred wires, points of lines by their places
      type(contact_set_t), intent(in) :: contact
      type(points_by_wire_t), intent(in) :: by_wire
      type(points_by_place_t), intent(in) :: by_place
      !> Barred element, unbarred element, contact pair (3)
      integer, intent(in) :: candidate(3)
      !> The two elements have a contact point; they are joined, and no candidate
      logical, intent(in) :: has_point, is_joined
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(finding_t), intent(out) :: finding
      type(tube_overlap_t) :: overlap
      real(dp) :: xe(3, 4), t(3, 4), length(2), places(2, max_minima), leave(2)
      integer :: k, n_places, axis, kind

      associate (pair => candidate(1:2), radius => elements%radius(candidate(1:2)))
         axis = axis_of_pair(model, candidate(3))
         call pair_geometry(model, wires, elements, pair(1), pair(2), x, rotation, xe, t, length)
         leave(1) = axis_sagitta(axis_polynomial(axis, length(1), xe(:, 1:2), t(:, 1:2)))
         leave(2) = axis_sagitta(axis_polynomial(axis, length(2), xe(:, 3:4), t(:, 3:4)))
         if (segment_distance(xe) - sum(leave) > sum(radius)) return
         if (is_joined) then
            if (lead_apart(model, elements, pair, xe, leave)) return
         end if
         call local_minima(xe, t, length, axis, places, n_places)
         do k = 1, n_places
            overlap = overlap_at(axis, radius, xe, t, length, places(:, k))
            if (overlap%depth < unseen_overlap) cycle
            kind = kind_of(model, wires, elements, contact, by_wire, by_place, candidate, has_point, is_joined, &
               x, rotation, overlap)
            if (kind /= finding_none) finding = worse_of(finding, finding_t(kind, pair, overlap%depth))
         end do
         if (is_joined) call inspect_legs(model, wires, elements, candidate, x, rotation, finding)
      end associate
   end subroutine inspect_pair

   !> What is wrong with an overlap; `finding_none`: nothing, or it is found elsewhere.
   integer function kind_of(model, wires, elements, contact, by_wire, by_place, candidate, has_point, is_joined, &
      x, rotation, overlap) result(kind)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the points of this state: crossings by their barred wires, points of lines by their places
      type(contact_set_t), intent(in) :: contact
      type(points_by_wire_t), intent(in) :: by_wire
      type(points_by_place_t), intent(in) :: by_place
      !> Barred element, unbarred element, contact pair (3)
      integer, intent(in) :: candidate(3)
      !> The two elements have a contact point; they are joined, and no candidate
      logical, intent(in) :: has_point, is_joined
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(tube_overlap_t), intent(in) :: overlap
      type(tube_overlap_t) :: overlap0
      integer :: beyond(2)

      kind = finding_none
      beyond(1) = element_beyond(model, wires, contact, candidate(3), candidate(1), overlap%place(1), overlap%line, x, &
         rotation)
      beyond(2) = element_beyond(model, wires, contact, candidate(3), candidate(2), overlap%place(2), -overlap%line, &
         x, rotation)
      if (any(beyond > 0)) then
         ! further along it is found again, but towards a joint it would be called part of that
         if (.not. leads_to_joint(model, wires, elements, contact%turning, candidate(1:2), beyond)) return
         overlap0 = overlap_of_reference(model, wires, elements, candidate, overlap%place)
         if (.not. overlap0%depth > 0) kind = finding_joined
      else if (is_part_of_joint(model, wires, elements, candidate(1:2), overlap%place)) then
         return
      else if (is_joined) then
         kind = finding_joined
      else if (.not. (is_known(model, wires, elements, contact%points, by_wire, candidate(1:2), overlap%place) .or. &
         is_on_line(model, wires, elements, contact, by_place, candidate, x, rotation, overlap))) then
         kind = kind_of_missed(model, wires, contact, candidate, has_point, overlap)
      end if
   end function kind_of

   !> Elements of one wire, or of joined wires, overlap so near to each other along them that they do by their
   !> construction.
   pure logical function is_part_of_joint(model, wires, elements, pair, place)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Two elements
      integer, intent(in) :: pair(2)
      !> In [-1, 1] (2)
      real(dp), intent(in) :: place(2)

      is_part_of_joint = path_between(wires, elements, pair, place, end_paths(model, wires, elements, pair, &
         joined_radii*maxval(elements%radius(pair)))) < joint_length(wires, elements, pair)
   end function is_part_of_joint

   !> The element of the contact pair that is joined to an end of this one, and along which the distance falls
   !> further; 0: none.
   pure integer function element_beyond(model, wires, contact, pair, e, xi, line, x, rotation)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(contact_set_t), intent(in) :: contact
      !> Contact pair and element
      integer, intent(in) :: pair, e
      !> Place in the element, and the line from the other wire to this one (3) [m]
      real(dp), intent(in) :: xi, line(3)
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      integer :: i, other, node

      element_beyond = 0
      if (abs(xi) < 1) return
      node = model%connectivity(merge(1, 2, xi < 0), e)
      do i = wires%first_at_node(node), wires%first_at_node(node + 1) - 1
         other = abs(wires%at_node(i))
         if (other == e .or. .not. is_named(contact, other, pair)) cycle
         if (dot_product(line, away_from(model, wires, axis_of_pair(model, pair), other, &
            merge(1, 2, wires%at_node(i) < 0), x, rotation)) < -flat*norm2(line)) then
            element_beyond = other
            return
         end if
      end do
   end function element_beyond

   !> Whether a contact pair names an element on either side.
   pure logical function is_named(contact, e, pair)
      type(contact_set_t), intent(in) :: contact
      !> Element and contact pair
      integer, intent(in) :: e, pair

      is_named = contact%in_bar(e, pair) .or. contact%in_set(e, pair)
   end function is_named

   !> The contacts have one of these two wires at this place; of others that meet in the same node, at a kink.
   pure logical function is_known(model, wires, elements, points, by_wire, pair, place)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> All points, and these by their barred wires
      type(contact_point_t), intent(in) :: points(:)
      type(points_by_wire_t), intent(in) :: by_wire
      !> Barred and unbarred element (2)
      integer, intent(in) :: pair(2)
      !> In [-1, 1] (2)
      real(dp), intent(in) :: place(2)
      integer, allocatable :: barred(:), unbarred(:)
      real(dp) :: near_node(2)
      integer :: i, j

      near_node = 2*same_contact*sum(elements%radius(pair))/elements%length(pair)
      allocate (barred, source=elements_at(model, wires, pair(1), place(1), near_node(1)))
      allocate (unbarred, source=elements_at(model, wires, pair(2), place(2), near_node(2)))
      is_known = .false.
      do i = 1, size(barred)
         do j = 1, size(unbarred)
            call look_up([barred(i), unbarred(j)], [1, 2])
            ! which of two wires is the barred one may differ along a kinked wire
            if (size(barred)*size(unbarred) > 1) call look_up([unbarred(j), barred(i)], [2, 1])
            if (is_known) return
         end do
      end do

   contains

      !> Whether there is a contact of two elements, given by which of their nodes they have at the place, if any.
      pure subroutine look_up(signed, order)
         !> Elements, - : at their first node, and what they are: 1 barred, 2 unbarred (2)
         integer, intent(in) :: signed(2), order(2)
         real(dp) :: xi(2)
         integer :: k

         xi = merge(place(order), sign(1.0_dp, real(signed, dp)), abs(signed) == pair(order))
         k = by_wire%first(wires%wire(abs(signed(1))))
         do while (k > 0 .and. .not. is_known)
            ! where an end carries nothing places beside it do
            is_known = (points(k)%weight > 0 .or. any(points(k)%held)) .and. is_at(wires, elements, points(k), &
               abs(signed), arc_at(wires, elements, abs(signed), xi))
            k = by_wire%next(k)
         end do
      end subroutine look_up

   end function is_known

   !> It is part of a line contact of these two elements, or of others that meet in the same node.
   logical function is_on_line(model, wires, elements, contact, by_place, candidate, x, rotation, overlap)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the points of this state, and those of lines by their places
      type(contact_set_t), intent(in) :: contact
      type(points_by_place_t), intent(in) :: by_place
      !> Barred element, unbarred element, contact pair (3)
      integer, intent(in) :: candidate(3)
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(tube_overlap_t), intent(in) :: overlap
      integer, allocatable :: barred(:), unbarred(:)
      type(tube_overlap_t) :: other
      real(dp) :: xe(3, 4), t(3, 4), length(2), place(2)
      integer :: i, j, pair(2)

      is_on_line = is_on_known_line(wires, elements, contact, by_place, candidate(1:2), overlap)
      if (is_on_line .or. all(abs(overlap%place) < 1)) return
      allocate (barred, source=elements_at(model, wires, candidate(1), overlap%place(1), 0.0_dp))
      allocate (unbarred, source=elements_at(model, wires, candidate(2), overlap%place(2), 0.0_dp))
      do i = 1, size(barred)
         do j = 1, size(unbarred)
            pair = abs([barred(i), unbarred(j)])
            place = merge(overlap%place, sign(1.0_dp, real([barred(i), unbarred(j)], dp)), pair == candidate(1:2))
            call pair_geometry(model, wires, elements, pair(1), pair(2), x, rotation, xe, t, length)
            other = overlap_at(axis_of_pair(model, candidate(3)), elements%radius(pair), xe, t, length, place)
            is_on_line = is_on_known_line(wires, elements, contact, by_place, pair, other)
            if (is_on_line) return
         end do
      end do
   end function is_on_line

   !> All elements at a place, as +-element (- : at its first node).
   pure function elements_at(model, wires, e, place, near_node) result(signed)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      !> Element
      integer, intent(in) :: e
      !> In [-1, 1], and how near to 1 is at a node
      real(dp), intent(in) :: place, near_node
      integer, allocatable :: signed(:)

      if (abs(place) < 1 - near_node) then
         signed = [e]
      else
         associate (node => model%connectivity(merge(1, 2, place < 0), e))
            signed = wires%at_node(wires%first_at_node(node):wires%first_at_node(node + 1) - 1)
         end associate
      end if
   end function elements_at

   !> A contact of a barred wire is that with another wire at these arc lengths; with itself, in either order.
   pure logical function is_at(wires, elements, point, pair, arc)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> On the barred wire
      type(contact_point_t), intent(in) :: point
      !> Elements of the two wires, barred first (2)
      integer, intent(in) :: pair(2)
      !> Arc lengths, barred first (2) [m]
      real(dp), intent(in) :: arc(2)
      real(dp) :: allowed

      is_at = .false.
      if (wires%wire(point%element) /= wires%wire(pair(2))) return
      allowed = same_contact*sum(elements%radius(pair))
      is_at = all(wires%arc_between(wires%wire(pair), arc, [point%arc_bar, point%arc]) < allowed)
      if (is_at .or. wires%wire(pair(1)) /= wires%wire(pair(2))) return
      is_at = all(wires%arc_between(wires%wire(pair), arc, [point%arc, point%arc_bar]) < allowed)
   end function is_at

   !> Why an overlap of two elements that are not joined is no contact.
   pure integer function kind_of_missed(model, wires, contact, candidate, has_point, overlap) result(kind)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(contact_set_t), intent(in) :: contact
      !> Barred element, unbarred element, contact pair (3)
      integer, intent(in) :: candidate(3)
      !> The two elements have a contact point
      logical, intent(in) :: has_point
      type(tube_overlap_t), intent(in) :: overlap
      integer :: i, k, node

      kind = merge(finding_second, finding_missed, has_point)
      associate (tangent => overlap%tangent)
         if (norm2(cross(tangent(:, 1), tangent(:, 2))) < side_by_side*product(norm2(tangent, 1))) then
            kind = finding_line
            return
         end if
      end associate
      do k = 1, 2
         if (abs(overlap%place(k)) < 1) cycle
         node = model%connectivity(merge(1, 2, overlap%place(k) < 0), candidate(k))
         kind = merge(finding_end, finding_kink, count([(is_named(contact, abs(wires%at_node(i)), candidate(3)), &
            i=wires%first_at_node(node), wires%first_at_node(node + 1) - 1)]) == 1)
         if (kind == finding_end) return
      end do
   end function kind_of_missed

end module litz_missed_contacts
