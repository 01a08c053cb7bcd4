!> By how much each wire turns along its way: whether it can come back to itself between two of its places.
!>
!> Two places of a wire touch where the line between them is perpendicular to the wire at both. With that line the wire
!> between them is a closed curve, which turns by `2 pi` or more (Fenchel); its two corners are right angles. So the
!> wire between them turns by `pi` or more. Places between which it turns by less have no contact, and do not overlap
!> unless a bend between them is tighter than the wire is thick (litz_tight_bends). Source: theory section 4.
module litz_wire_turning
   use litz_kinds, only: dp, pi
   use litz_axis, only: axis_turning
   use litz_contact_tangents, only: axis_of_element
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_parallel, only: worth_threads
   use litz_wires, only: wires_t
   implicit none
   private
   public :: wire_turning_t, measure_turning

   !> A wire that turns by less [rad] does not come back. Along a line a place may carry a contact while its wire is
   !> tilted by 15 degrees against the other one: by as much less than `pi` the wire may turn
   real(dp), parameter :: least_turning = pi - 15*pi/180

   type :: wire_turning_t
      !> By how much each element turns, and its wire before it (n_elements) [rad], at most: see `axis_turning`
      real(dp), allocatable :: own(:), before(:)
      !> By how much each closed wire turns in all (n_wires) [rad]
      real(dp), allocatable :: around(:)
   contains
      procedure :: along
      procedure :: comes_back
   end type wire_turning_t

contains

   !> How all wires turn in a configuration; by no less than in an earlier one.
   subroutine measure_turning(model, wires, elements, x, rotation, turning, earlier)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(wire_turning_t), intent(inout) :: turning
      !> One that counts where it is greater
      type(wire_turning_t), intent(in), optional :: earlier
      integer :: e, w, i

      if (.not. allocated(turning%own)) allocate (turning%own(model%n_elements), turning%before(model%n_elements), &
         turning%around(wires%n_wires))
      !$omp parallel do schedule(static) if (model%n_elements >= worth_threads)
      do e = 1, model%n_elements
         turning%own(e) = axis_turning(axis_of_element(model, wires, elements, e, x, rotation))
      end do
      !$omp end parallel do
      if (present(earlier)) turning%own = max(turning%own, earlier%own)
      do w = 1, wires%n_wires
         turning%around(w) = 0
         do i = wires%first(w), wires%first(w + 1) - 1
            turning%before(wires%element(i)) = turning%around(w)
            turning%around(w) = turning%around(w) + turning%own(wires%element(i))
         end do
      end do
   end subroutine measure_turning

   !> By how much a wire turns from the one to the other of two elements, these included [rad], at most; of a closed
   !> wire not over the node where its arc lengths begin.
   pure real(dp) function along(self, wires, a, b)
      class(wire_turning_t), intent(in) :: self
      type(wires_t), intent(in) :: wires
      !> Two elements of one wire
      integer, intent(in) :: a, b
      integer :: first, last

      first = merge(a, b, wires%place(a) < wires%place(b))
      last = a + b - first
      along = self%before(last) + self%own(last) - self%before(first)
   end function along

   !> Whether a wire can come back to itself between two of its elements, these included: around a closed wire by both
   !> ways.
   pure logical function comes_back(self, wires, a, b)
      class(wire_turning_t), intent(in) :: self
      type(wires_t), intent(in) :: wires
      !> Two elements of one wire
      integer, intent(in) :: a, b
      real(dp) :: turned

      turned = self%along(wires, a, b)
      comes_back = turned >= least_turning
      ! the other way around begins and ends with the same two elements
      if (comes_back .and. wires%circumference(wires%wire(a)) > 0) comes_back = &
         self%around(wires%wire(a)) - turned + self%own(a) + self%own(b) >= least_turning
   end function comes_back

end module litz_wire_turning
