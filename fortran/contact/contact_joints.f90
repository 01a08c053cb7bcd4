!> Elements that are joined: next to each other along a wire, or at a corner or a branch.
!>
!> Near the joint they overlap by their construction; farther along they may touch like any others.
module litz_contact_joints
   use litz_kinds, only: dp
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_wires, only: wires_t
   implicit none
   private
   public :: path_between, lead_apart, walk_along, joint_radii

   !> Joined wires may overlap up to this many radii along them: a bend has no room for more
   real(dp), parameter :: joint_radii = 4.0_dp
   !> Elements that leave their chords by less than this part of their lengths cannot come round to their neighbours
   real(dp), parameter :: slightly_bent = 0.2_dp

contains

   !> Length of wire between a place on one element and a place on another one that it is joined to [m]; where the joint
   !> is not a shared node, it counts from the nearest ends.
   pure real(dp) function path_between(model, wires, elements, pair, place) result(path)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Two elements, and places in [-1, 1] (2)
      integer, intent(in) :: pair(2)
      real(dp), intent(in) :: place(2)
      real(dp) :: arc(2), from_end(2, 2)
      integer :: i, j
      logical :: shares

      if (wires%wire(pair(1)) == wires%wire(pair(2))) then
         arc = wires%arc(pair) + wires%direction(pair)*place*elements%length(pair)/2
         path = wires%arc_between(wires%wire(pair(1)), arc(1), arc(2))
         return
      end if
      from_end(1, :) = (1 + place)/2*elements%length(pair)
      from_end(2, :) = (1 - place)/2*elements%length(pair)
      path = huge(1.0_dp)
      shares = .false.
      do i = 1, 2
         do j = 1, 2
            if (model%connectivity(i, pair(1)) /= model%connectivity(j, pair(2))) cycle
            shares = .true.
            path = min(path, from_end(i, 1) + from_end(j, 2))
         end do
      end do
      if (.not. shares) path = minval(from_end(:, 1)) + minval(from_end(:, 2))
   end function path_between

   !> Two elements that share a node lead away from each other there and are hardly bent: they cannot touch beyond it.
   pure logical function lead_apart(model, elements, pair, x, sagitta)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> Two elements, their nodal positions (3, 4) [m], and how far they leave their chords (2) [m]
      integer, intent(in) :: pair(2)
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
      !> Element of the place, and the place in [-1, 1]; 0: the wire ends before
      integer, intent(out) :: element
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
