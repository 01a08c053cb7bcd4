!> Elements that are joined: along a wire that does not come back between them, or at a corner or a branch.
!>
!> Near the joint they overlap by their construction; farther along they may touch like any others.
module litz_contact_joints
   use litz_kinds, only: dp, pi
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_wire_turning, only: wire_turning_t
   use litz_wires, only: wires_t
   implicit none
   private
   public :: are_joined, end_paths, path_between, lead_apart, walk_along, joint_length, joined_radii

   !> Elements of two wires that share a node do not touch each other where they are nearer than this many contact
   !> radii along them
   real(dp), parameter :: joined_radii = 8.0_dp
   !> Joined wires may overlap up to this many radii along them: a bend has no room for more
   real(dp), parameter :: corner_radii = 4.0_dp
   !> Elements that leave their chords by less than this part of their lengths cannot come round to their neighbours
   real(dp), parameter :: slightly_bent = 0.2_dp

contains

   !> Two elements share a node, their wire does not come back between them or has no room for that, or a short path
   !> joins their wires.
   pure logical function are_joined(model, wires, elements, turning, a, b)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(wire_turning_t), intent(in) :: turning
      !> Two elements
      integer, intent(in) :: a, b
      real(dp) :: radius

      are_joined = .true.
      if (any(model%connectivity(:, a) == model%connectivity(1, b)) .or. &
         any(model%connectivity(:, a) == model%connectivity(2, b))) return
      radius = max(elements%radius(a), elements%radius(b))
      if (wires%wire(a) == wires%wire(b)) then
         if (.not. turning%comes_back(wires, a, b)) return
         if (wires%arc_between(wires%wire(a), wires%arc(a), wires%arc(b)) + sum(elements%length([a, b]))/2 &
            < joint_length(wires, elements, [a, b])) return
      else if (wires%is_joined(wires%wire(a)) .and. wires%is_joined(wires%wire(b))) then
         if (joined_within(1) .or. joined_within(2)) return
      end if
      are_joined = .false.

   contains

      !> A short path along elements that share nodes leads from this end of the one element to the other element.
      pure logical function joined_within(side)
         !> 1, 2: first or second node of the first element
         integer, intent(in) :: side

         joined_within = leads_to(b, model%connectivity(side, a), a, joined_radii*radius, model, wires, elements)
      end function joined_within

   end function are_joined

   !> Whether a path from a node, not back into the element it is reached by, leads to an element before its length is
   !> used up.
   pure recursive logical function leads_to(goal, node, from, length, model, wires, elements) result(leads)
      !> Element to be reached, node where the path begins, and element that it came along
      integer, intent(in) :: goal, node, from
      !> Length that is left [m]
      real(dp), intent(in) :: length
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      integer :: i, e

      leads = .false.
      do i = wires%first_at_node(node), wires%first_at_node(node + 1) - 1
         e = abs(wires%at_node(i))
         if (e == from) cycle
         leads = e == goal
         if (.not. leads .and. elements%length(e) < length) leads = leads_to(goal, &
            model%connectivity(merge(2, 1, wires%at_node(i) < 0), e), e, length - elements%length(e), model, wires, &
            elements)
         if (leads) return
      end do
   end function leads_to

   !> Length along the wires between two places within which they overlap by their construction [m]: of one wire, half
   !> the circumference of the tightest bend that it has room for.
   pure real(dp) function joint_length(wires, elements, pair)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Two elements
      integer, intent(in) :: pair(2)

      joint_length = merge(pi, corner_radii, wires%wire(pair(1)) == wires%wire(pair(2)))*maxval(elements%radius(pair))
   end function joint_length

   !> Lengths of the shortest ways along elements between the ends of two elements [m]; `huge` beyond a limit.
   pure function end_paths(model, wires, elements, pair, limit) result(between)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Two elements
      integer, intent(in) :: pair(2)
      !> [m]
      real(dp), intent(in) :: limit
      !> From the first and second node of the first element to those of the second one (2, 2) [m]
      real(dp) :: between(2, 2)
      integer :: i, j

      do j = 1, 2
         do i = 1, 2
            between(i, j) = way(model, wires, elements, model%connectivity(i, pair(1)), &
               model%connectivity(j, pair(2)), pair, limit)
         end do
      end do
   end function end_paths

   !> Length of the shortest way from one node to another [m], not back along the element that leads there, and not
   !> through the one that it leads to.
   pure recursive real(dp) function way(model, wires, elements, from, goal, not_along, limit) result(length)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Nodes, and elements (2) that are not to be used
      integer, intent(in) :: from, goal, not_along(2)
      !> [m]
      real(dp), intent(in) :: limit
      integer :: i, e

      length = 0
      if (from == goal) return
      length = huge(1.0_dp)
      do i = wires%first_at_node(from), wires%first_at_node(from + 1) - 1
         e = abs(wires%at_node(i))
         if (any(e == not_along) .or. elements%length(e) > limit) cycle
         length = min(length, elements%length(e) + way(model, wires, elements, &
            model%connectivity(merge(2, 1, wires%at_node(i) < 0), e), goal, [e, not_along(2)], &
            limit - elements%length(e)))
      end do
   end function way

   !> Length of wire between a place on one element and a place on another one that it is joined to [m]; `huge` where
   !> no way is as short as the limit of `end_paths`.
   pure real(dp) function path_between(wires, elements, pair, place, between) result(path)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Two elements
      integer, intent(in) :: pair(2)
      !> Place in each of them, in [-1, 1] (2)
      real(dp), intent(in) :: place(2)
      !> `end_paths` of the pair (2, 2) [m]
      real(dp), intent(in) :: between(2, 2)
      real(dp) :: arc(2), from_end(2, 2)
      integer :: i, j

      if (wires%wire(pair(1)) == wires%wire(pair(2))) then
         arc = wires%arc(pair) + wires%direction(pair)*place*elements%length(pair)/2
         path = wires%arc_between(wires%wire(pair(1)), arc(1), arc(2))
         return
      end if
      from_end(1, :) = (1 + place)/2*elements%length(pair)
      from_end(2, :) = (1 - place)/2*elements%length(pair)
      path = huge(1.0_dp)
      do j = 1, 2
         do i = 1, 2
            if (between(i, j) < huge(1.0_dp)) path = min(path, from_end(i, 1) + between(i, j) + from_end(j, 2))
         end do
      end do
   end function path_between

   !> Two elements that share a node lead away from each other there and are hardly bent: they cannot touch beyond it.
   pure logical function lead_apart(model, elements, pair, x, sagitta)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> Two elements
      integer, intent(in) :: pair(2)
      !> Their nodal positions (3, 4) [m], and how far their axes leave their chords (2) [m]
      real(dp), intent(in) :: x(3, 4), sagitta(2)
      real(dp) :: chord(3, 2)
      integer :: i, j

      lead_apart = .false.
      if (any(sagitta > slightly_bent*elements%length(pair))) return
      chord(:, 1) = x(:, 2) - x(:, 1)
      chord(:, 2) = x(:, 4) - x(:, 3)
      do i = 1, 2
         do j = 1, 2
            if (model%connectivity(i, pair(1)) /= model%connectivity(j, pair(2))) cycle
            lead_apart = (3 - 2*i)*(3 - 2*j)*dot_product(chord(:, 1), chord(:, 2)) < 0
            if (.not. lead_apart) return
         end do
      end do
   end function lead_apart

   !> The place on a wire at an arc length from one end of an element, on this element and those that continue it.
   pure subroutine walk_along(wires, elements, from, side, arc, element, place)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Element, and 1 or 2: the walk begins at its first or second node and goes through it
      integer, intent(in) :: from, side
      !> Length of the walk [m]
      real(dp), intent(in) :: arc
      !> Element of the place; 0: the wire ends before
      integer, intent(out) :: element
      !> The place in [-1, 1]
      real(dp), intent(out) :: place
      real(dp) :: left
      integer :: first, next

      element = from
      first = side
      left = arc
      place = 0
      do while (left > elements%length(element))
         left = left - elements%length(element)
         next = wires%next(3 - first, element)
         if (next == 0 .or. next == from) then
            element = 0
            return
         end if
         ! elements of one wire may run against each other
         if (wires%direction(next) /= wires%direction(element)) first = 3 - first
         element = next
      end do
      place = (3 - 2*first)*(2*left/elements%length(element) - 1)
   end subroutine walk_along

end module litz_contact_joints
