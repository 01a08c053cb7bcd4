!> Currents of all contacts together, where several of them share elements.
!>
!> The current of a contact raises the potential of the other contacts on its two elements. With `R` the diagonal matrix
!> of the spots' resistances and `A` what the currents do inside the elements, all currents follow from
!> `(R + A) I = N_V V`, symmetric and positive definite. What a contact does to itself, the diagonal `D` of `R + A`, is
!> part of the contact element (contact_electricity); here is what is beyond it: `(R + A)^-1 - D^-1`.
!> Source: theory section 7.
module litz_shared_conductors
   use litz_element_ends, only: element_ends_t, collect_ends, rise_at_ends
   use litz_kinds, only: dp
   use litz_mutual_resistances, only: mutual_resistances_t
   implicit none
   private
   public :: shared_conductors_t, collect_shared

   !> The error of the conjugate gradients over that of the start, if nothing else is said; and their steps at most
   real(dp), parameter :: accurate = 1.0e-15_dp
   integer, parameter :: max_steps = 200

   type :: shared_conductors_t
      !> Some element has more than one contact, or contacts raise each other's potential in a wire
      logical :: present = .false.
      !> Nodes (4, n) and N_V (4, n) of each contact: barred 1, barred 2, 1, 2
      integer, allocatable :: nodes(:, :)
      real(dp), allocatable :: n_v(:, :)
      !> Of the spot, and diagonal of R + A (n) [ohm]
      real(dp), allocatable :: resistance(:), diagonal(:)
      type(mutual_resistances_t) :: mutual
      type(element_ends_t) :: ends
      !> rho L0/(4 A) [ohm] of each element that has any
      real(dp), allocatable :: scale(:)
   contains
      procedure :: voltages
      procedure :: currents
      procedure :: add_beyond
      procedure :: add_product
   end type shared_conductors_t

contains

   !> The contacts with a current, and which elements they share.
   subroutine collect_shared(elements, nodes, xi, scale, resistance, mutual, shared)
      !> Elements (2, n), barred first, and nodes (4, n)
      integer, intent(in) :: elements(:, :), nodes(:, :)
      !> Places in the elements (2, n), rho L0/(4 A) [ohm] of the elements (2, n), resistances of the spots (n) [ohm]
      real(dp), intent(in) :: xi(:, :), scale(:, :), resistance(:)
      type(mutual_resistances_t), intent(in) :: mutual
      type(shared_conductors_t), intent(out) :: shared
      integer :: i

      call collect_ends(elements, xi, shared%ends)
      associate (n_elements => size(shared%ends%element))
         shared%present = size(mutual%resistance) > 0 .or. (2*size(resistance) > n_elements .and. any(scale > 0))
         allocate (shared%scale(n_elements))
      end associate
      shared%nodes = nodes
      shared%resistance = resistance
      shared%mutual = mutual
      shared%diagonal = resistance + sum(scale*(1 - xi**2), 1)
      allocate (shared%n_v(4, size(resistance)))
      do i = 1, size(resistance)
         shared%n_v(:, i) = [1 - xi(1, i), 1 + xi(1, i), -(1 - xi(2, i)), -(1 + xi(2, i))]/2
         shared%scale(shared%ends%place_of(:, i)) = scale(:, i)
      end do
   end subroutine collect_shared

   !> `N_V V` of each contact (n) [V].
   pure function voltages(self, potential)
      class(shared_conductors_t), intent(in) :: self
      !> (n_nodes) [V]
      real(dp), intent(in) :: potential(:)
      real(dp) :: voltages(size(self%resistance))
      integer :: i

      do i = 1, size(voltages)
         voltages(i) = dot_product(self%n_v(:, i), potential(self%nodes(:, i)))
      end do
   end function voltages

   !> Solve `(R + A) I = voltage` by conjugate gradients with the diagonal as preconditioner.
   subroutine currents(self, voltage, current, rise, of_others, accuracy)
      class(shared_conductors_t), intent(in) :: self
      !> (n) [V]
      real(dp), intent(in) :: voltage(:)
      !> From the barred to the unbarred wire (n) [A]
      real(dp), intent(out) :: current(:)
      !> Of the potential above the linear one at the contact in either element (2, n) [V], barred first
      real(dp), intent(out) :: rise(:, :)
      !> What other contacts add to the voltage of each contact (n) [V]
      real(dp), intent(out) :: of_others(:)
      !> Error over that of the start; absent: to round-off
      real(dp), intent(in), optional :: accuracy
      real(dp), dimension(size(voltage)) :: left, direction, product
      real(dp) :: error, error_before, error_allowed, step
      integer :: k

      current = voltage/self%diagonal
      error_allowed = accurate**2*sum(voltage*current)
      if (present(accuracy)) error_allowed = max(error_allowed, accuracy**2*sum(voltage*current))
      call multiply(self, current, product, rise, of_others)
      left = voltage - product
      direction = left/self%diagonal
      error = sum(left**2/self%diagonal)
      do k = 1, max_steps
         if (.not. error > error_allowed) exit
         call multiply(self, direction, product, rise, of_others)
         step = error/sum(direction*product)
         current = current + step*direction
         left = left - step*product
         error_before = error
         error = sum(left**2/self%diagonal)
         direction = left/self%diagonal + error/error_before*direction
      end do
      call multiply(self, current, product, rise, of_others)
   end subroutine currents

   !> `(R + A) I`, with the rise of the potential that belongs to it.
   subroutine multiply(self, current, product, rise, of_others)
      type(shared_conductors_t), intent(in) :: self
      !> From the barred to the unbarred wire (n) [A]
      real(dp), intent(in) :: current(:)
      !> `(R + A) I` (n), and rise of the potential above the linear one in either element (2, n) [V], barred first
      real(dp), intent(out) :: product(:), rise(:, :)
      !> What other contacts add to the voltage of each contact (n) [V]
      real(dp), intent(out) :: of_others(:)
      real(dp) :: entering(size(self%ends%xi))

      ! the current leaves the barred wire
      entering = merge(-1, 1, self%ends%side == 1)*current(self%ends%contact)
      call rise_at_ends(self%ends, self%scale, entering, rise)
      product = self%resistance*current - rise(1, :) + rise(2, :)
      of_others = self%mutual%voltages(current)
      product = product + of_others
   end subroutine multiply

   !> Add to `y` the currents that leave the nodes beyond those of the contact elements, `N_V^T (I - D^-1 N_V V)`.
   pure subroutine add_beyond(self, voltage, current, y)
      class(shared_conductors_t), intent(in) :: self
      !> N_V V [V] and I [A] of the contacts (n)
      real(dp), intent(in) :: voltage(:), current(:)
      !> (n_nodes) [A]
      real(dp), intent(inout) :: y(:)
      integer :: i, a

      do i = 1, size(current)
         do a = 1, 4
            y(self%nodes(a, i)) = y(self%nodes(a, i)) + self%n_v(a, i)*(current(i) - voltage(i)/self%diagonal(i))
         end do
      end do
   end subroutine add_beyond

   !> `y = y + N_V^T ((R + A)^-1 - D^-1) N_V V`
   subroutine add_product(self, potential, accuracy, y)
      class(shared_conductors_t), intent(in) :: self
      !> (n_nodes) [V]
      real(dp), intent(in) :: potential(:)
      !> Of the currents, relative
      real(dp), intent(in) :: accuracy
      !> (n_nodes) [A]
      real(dp), intent(inout) :: y(:)
      real(dp) :: voltage(size(self%resistance)), current(size(self%resistance)), rise(2, size(self%resistance)), &
         of_others(size(self%resistance))

      voltage = self%voltages(potential)
      call self%currents(voltage, current, rise, of_others, accuracy)
      call self%add_beyond(voltage, current, y)
   end subroutine add_product

end module litz_shared_conductors
