!> Wires that are drawn as curves with so few elements that each node is a kink.
!>
!> A kink has a round joint, which takes part in contact beside the places along the elements: where such a curve lies
!> along another wire, or along itself as turns of a coil do, it has too much force. Source: theory, ends and kinks.
module litz_coarse_curves
   use litz_kinds, only: dp, pi
   use litz_contact_points, only: contact_set_t
   use litz_model, only: model_t
   use litz_rotations, only: cross
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

contains

   !> How many wires of contact pairs are drawn so, with the one that turns most at a node; empty: none.
   function describe_coarse_curves(model, contact) result(text)
      type(model_t), intent(in) :: model
      type(contact_set_t), intent(in) :: contact
      character(len=:), allocatable :: text
      type(wire_chains_t) :: chains
      logical :: touches(model%n_elements)
      integer, allocatable :: ordered(:), first(:)
      real(dp) :: turn, worst
      integer :: w, n, example

      text = ''
      touches = may_touch(model, contact)
      if (.not. any(touches)) return
      call find_wire_chains(model%connectivity, model%n_nodes, chains)
      call order_by_place(chains, ordered, first)
      n = 0
      worst = 0
      example = 0
      do w = 1, size(first) - 1
         turn = turn_of_curve(model, touches, ordered(first(w):first(w + 1) - 1))
         if (.not. turn > 0) cycle
         n = n + 1
         if (.not. turn > worst) cycle
         worst = turn
         example = w
      end do
      if (n == 0) return
      text = 'the wire of elements '//to_text(model%element_id(ordered(first(example))))//' to '// &
         to_text(model%element_id(ordered(first(example + 1) - 1)))
      if (n > 1) text = text//' (and '//to_text(n - 1)//' more)'
      text = text//' is drawn with '//to_text(nint(2*pi/worst))//' elements a turn: it turns by '// &
         to_text(nint(worst*180/pi))//' degrees at each of several nodes in a row, and nodes that turn by more'// &
         ' than '//to_text(nint(corner_angle*180/pi))//' degrees are kinks, with round joints, by which a curve that'// &
         ' lies along another wire or its own turns has too much force; take at least '// &
         to_text(ceiling(2*pi/corner_angle) + 1)//' elements a turn'
   end function describe_coarse_curves

   !> Elements of wires that may touch others, themselves or rigid surfaces.
   pure function may_touch(model, contact) result(touches)
      type(model_t), intent(in) :: model
      type(contact_set_t), intent(in) :: contact
      logical :: touches(model%n_elements)
      integer :: i

      touches = .false.
      if (allocated(contact%members)) touches(contact%members) = .true.
      if (.not. allocated(model%surface_pairs)) return
      do i = 1, size(model%surface_pairs)
         touches(model%element_sets(model%surface_pairs(i)%set)%members) = .true.
      end do
   end function may_touch

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

   !> Largest turn of nodes of a wire that several in a row have alike [rad]; 0: there are none.
   pure real(dp) function turn_of_curve(model, touches, elements) result(largest)
      type(model_t), intent(in) :: model
      !> Elements that may touch something (n_elements)
      logical, intent(in) :: touches(:)
      !> Of the wire, one after another (n)
      integer, intent(in) :: elements(:)
      real(dp) :: before(3), axis(3), turn, last, smallest
      integer :: i, in_row

      largest = 0
      last = 0
      smallest = 0
      in_row = 0
      before = 0
      do i = 2, size(elements)
         call turn_between(model, elements(i - 1), elements(i), turn, axis)
         if (.not. (turn > corner_angle .and. turn < largest_turn .and. all(touches(elements(i - 1:i))))) then
            in_row = 0
         else if (in_row > 0 .and. max(turn, last) <= alike*min(turn, last) .and. &
            dot_product(axis, before) >= least_cosine) then
            in_row = in_row + 1
            smallest = min(smallest, turn)
         else
            in_row = 1
            smallest = turn
         end if
         last = turn
         before = axis
         if (in_row >= least_in_row) largest = max(largest, smallest)
      end do
   end function turn_of_curve

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
