!> Wires that are drawn as curves with so few elements that each node is a kink.
!>
!> A kink has a round joint, which takes part in contact beside the places along the elements: where such a curve lies
!> along another wire, or along itself as turns of a coil do, it has too much force. Source: theory, ends and kinks.
module litz_coarse_curves
   use litz_kinds, only: dp, pi
   use litz_contact_points, only: contact_set_t
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_parallel_wires, only: lie_side_by_side
   use litz_rotations, only: cross
   use litz_state, only: contact_t
   use litz_text, only: to_text
   use litz_wire_chains, only: wire_chains_t, find_wire_chains
   use litz_wires, only: corner_angle
   implicit none
   private
   public :: describe_coarse_curves

   !> Nodes in a row that turn alike from which on a wire is meant as a curve
   integer, parameter :: least_in_row = 3
   !> A wire that turns more at each node is a polygon [rad]
   real(dp), parameter :: largest_turn = 61*pi/180
   !> Neighbouring turns are alike within this factor, and their axes within 45 degrees
   real(dp), parameter :: alike = 2, least_cosine = sqrt(0.5_dp)
   !> Angle between elements up to which they lie along each other: half of the largest turn, and some degrees [rad]
   real(dp), parameter :: along_angle = 35*pi/180

contains

   !> How many wires are drawn so and lie along others or themselves, with the one that turns most at a node; empty:
   !> none.
   function describe_coarse_curves(model, elements, contact, contacts) result(text)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> With candidates
      type(contact_set_t), intent(in) :: contact
      !> Of a state; none: the candidates that are close to each other in the reference configuration count
      type(contact_t), intent(in) :: contacts(:)
      character(len=:), allocatable :: text
      type(wire_chains_t) :: chains
      real(dp) :: turn(model%n_elements), worst
      logical :: along(model%n_elements)
      integer, allocatable :: ordered(:), first(:)
      integer :: w, n, example

      text = ''
      call find_wire_chains(model%connectivity, model%n_nodes, chains)
      call order_by_place(chains, ordered, first)
      turn = 0
      do w = 1, size(first) - 1
         call find_curves(model, ordered(first(w):first(w + 1) - 1), turn)
      end do
      if (.not. any(turn > 0)) return
      along = lies_along(model, elements, contact, contacts, turn)
      n = 0
      worst = 0
      example = 0
      do w = 1, size(first) - 1
         associate (of_wire => ordered(first(w):first(w + 1) - 1))
            if (.not. any(along(of_wire))) cycle
            n = n + 1
            if (.not. maxval(turn(of_wire)) > worst) cycle
            worst = maxval(turn(of_wire))
            example = w
         end associate
      end do
      if (n == 0) return
      text = 'the wire of elements '//to_text(model%element_id(ordered(first(example))))//' to '// &
         to_text(model%element_id(ordered(first(example + 1) - 1)))
      if (n > 1) text = text//' (and '//to_text(n - 1)//' more)'
      text = text//' is drawn with '//to_text(nint(2*pi/worst))//' elements a turn: it turns by '// &
         to_text(nint(worst*180/pi))//' degrees at each of several nodes in a row, and nodes that turn by more'// &
         ' than '//to_text(nint(corner_angle*180/pi))//' degrees are kinks, with round joints, by which a curve'// &
         ' that lies along another wire or its own turns has too much force; take at least '// &
         to_text(ceiling(2*pi/corner_angle) + 1)//' elements a turn'
   end function describe_coarse_curves

   !> Which elements of curves lie along others (n_elements).
   function lies_along(model, elements, contact, contacts, turn) result(along)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      !> Of a state; none: the candidates that are close to each other in the reference configuration count
      type(contact_t), intent(in) :: contacts(:)
      !> Of the curve of each element (n_elements) [rad]; 0: it is part of none
      real(dp), intent(in) :: turn(:)
      logical :: along(model%n_elements)
      integer :: i

      along = .false.
      do i = 1, size(contacts)
         if (.not. sin(contacts(i)%angle) < sin(along_angle)) cycle
         call note(contacts(i)%element_bar, contacts(i)%element)
      end do
      if (size(contacts) > 0) return
      do i = 1, size(contact%candidates, 2)
         associate (pair => contact%candidates(1:2, i))
            if (.not. any(turn(pair) > 0)) cycle
            if (lie_side_by_side(model, elements, pair(1), pair(2), along_angle)) call note(pair(1), pair(2))
         end associate
      end do

   contains

      subroutine note(a, b)
         !> Two elements that lie along each other
         integer, intent(in) :: a, b

         along(a) = along(a) .or. turn(a) > 0
         along(b) = along(b) .or. turn(b) > 0
      end subroutine note

   end function lies_along

   !> The elements in the order of the wires, and along each.
   pure subroutine order_by_place(chains, ordered, first)
      type(wire_chains_t), intent(in) :: chains
      !> Elements (n_elements); those of wire w are `ordered(first(w):first(w + 1) - 1)`
      integer, allocatable, intent(out) :: ordered(:), first(:)
      integer :: e

      allocate (first(maxval(chains%wire) + 1), source=0)
      do e = 1, size(chains%wire)
         first(chains%wire(e) + 1) = first(chains%wire(e) + 1) + 1
      end do
      first(1) = 1
      do e = 2, size(first)
         first(e) = first(e - 1) + first(e)
      end do
      allocate (ordered(size(chains%wire)))
      do e = 1, size(chains%wire)
         ordered(first(chains%wire(e)) + chains%place(e) - 1) = e
      end do
   end subroutine order_by_place

   !> Where several nodes of a wire in a row turn alike: the least of their turns, for all of their elements.
   pure subroutine find_curves(model, elements, turn)
      type(model_t), intent(in) :: model
      !> Of the wire, one after another (n)
      integer, intent(in) :: elements(:)
      !> Of the curve of each element (n_elements) [rad]; 0: it is part of none
      real(dp), intent(inout) :: turn(:)
      real(dp) :: before(3), axis(3), angle, last, least
      integer :: i, in_row

      last = 0
      least = 0
      in_row = 0
      before = 0
      do i = 2, size(elements)
         call turn_between(model, elements(i - 1), elements(i), angle, axis)
         if (.not. (angle > corner_angle .and. angle < largest_turn)) then
            in_row = 0
         else if (in_row > 0 .and. max(angle, last) <= alike*min(angle, last) .and. &
            dot_product(axis, before) >= least_cosine) then
            in_row = in_row + 1
            least = min(least, angle)
         else
            in_row = 1
            least = angle
         end if
         last = angle
         before = axis
         if (in_row >= least_in_row) turn(elements(i - in_row:i)) = least
      end do
   end subroutine find_curves

   !> By which angle, and about which axis, a wire turns from one element to the next.
   pure subroutine turn_between(model, a, b, turn, axis)
      type(model_t), intent(in) :: model
      !> The two elements, which share a node
      integer, intent(in) :: a, b
      !> [rad]
      real(dp), intent(out) :: turn
      !> Unit vector; 0 where the wire goes straight on
      real(dp), intent(out) :: axis(3)
      real(dp) :: into(3), out_of(3)
      integer :: side_a, side_b

      side_a = merge(1, 2, any(model%connectivity(:, b) == model%connectivity(1, a)))
      side_b = merge(1, 2, model%connectivity(1, b) == model%connectivity(side_a, a))
      into = model%x(:, model%connectivity(side_a, a)) - model%x(:, model%connectivity(3 - side_a, a))
      out_of = model%x(:, model%connectivity(3 - side_b, b)) - model%x(:, model%connectivity(side_b, b))
      axis = cross(into, out_of)
      turn = atan2(norm2(axis), dot_product(into, out_of))
      if (norm2(axis) > 0) axis = axis/norm2(axis)
   end subroutine turn_between

end module litz_coarse_curves
