!> *LORENTZ: forces of a given magnetic field on the currents that are computed. Source: theory section 16.
!>
!> Motions depend on potentials by this term alone, which is why steps with it solve for both in turns, or in one Newton
!> step (litz_steps).
module litz_lorentz_term
   use litz_kinds, only: dp
   use litz_domain, only: domain_t, element_flow_t
   use litz_element_loads, only: element_load_t, load_lorentz
   use litz_end_forces, only: nodal_state
   use litz_errors, only: error_t
   use litz_fields, only: field_temperature, motion_slots, potential_slots, temperature_slots
   use litz_line_forces, only: lorentz_force
   use litz_loaded_elements, only: loaded_elements_t, load_axis
   use litz_loading, only: element_loads_at
   use litz_model, only: step_t
   use litz_parallel, only: worth_threads
   use litz_scatter, only: chunk
   implicit none
   private
   public :: lorentz_term_t, new_lorentz_term

   !> Of each node: potential and temperature
   integer, parameter :: both_slots(2) = [potential_slots(1), temperature_slots(2)]

   type, extends(loaded_elements_t) :: lorentz_term_t
      !> Flux density at the origin, and its derivatives by x, y and z, at the end of the increment and when it began
      !> (12, n) [N/(A m), N/(A m^2)]
      real(dp), allocatable :: field(:, :), start_field(:, :)
   contains
      procedure :: apply_load
      procedure :: start
      procedure :: evaluate
   end type lorentz_term_t

contains

   pure type(lorentz_term_t) function new_lorentz_term() result(term)
      allocate (term%members(0), term%start_force(12, 0), term%force(12, 0), term%field(12, 0), term%start_field(12, 0))
   end function new_lorentz_term

   subroutine apply_load(self, domain, step, step_time, increment)
      class(lorentz_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      type(step_t), intent(in) :: step
      !> Time of the step at the end of the increment, and the increment [s]
      real(dp), intent(in) :: step_time, increment

      call self%take_loaded(step%element_loads, load_lorentz, load_lorentz, domain%model%n_elements)
      associate (state => domain%state, n => size(self%members))
         self%field = self%force
         self%start_field = self%force
         if (n == 0) return
         call collect(self, element_loads_at(domain%model, step, step_time, state%time - state%step_time), self%field)
         call collect(self, element_loads_at(domain%model, step, state%step_time, state%time - state%step_time), &
            self%start_field)
      end associate
   end subroutine apply_load

   !> The fields of the elements.
   pure subroutine collect(self, loads, field)
      class(lorentz_term_t), intent(in) :: self
      type(element_load_t), intent(in) :: loads(:)
      !> (12, n)
      real(dp), intent(inout) :: field(:, :)
      integer, allocatable :: place(:)
      integer :: i

      allocate (place(maxval(self%members)))
      place(self%members) = [(i, i=1, size(self%members))]
      do i = 1, size(loads)
         if (loads(i)%kind == load_lorentz) field(:, place(loads(i)%element)) = loads(i)%value
      end do
   end subroutine collect

   !> Forces of the last increment, of which half of the work is.
   subroutine start(self, domain)
      class(lorentz_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      real(dp) :: k(12, 12), by_current(12)
      integer :: i

      do i = 1, size(self%members)
         call force_on(domain, self%members(i), domain%state%element_current(self%members(i)), &
            self%start_field(:, i), k, self%start_force(:, i), by_current)
      end do
   end subroutine start

   subroutine evaluate(self, domain, error)
      class(lorentz_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Never
      type(error_t), allocatable, intent(out) :: error
      real(dp), allocatable :: k(:, :, :), by_flow(:, :, :)
      integer :: first, last, i

      if (domain%motions_stand .or. size(self%members) == 0) return
      call domain%lose_symmetry()
      allocate (k(12, 12, min(chunk, size(self%members))), by_flow(12, 4, min(chunk, size(self%members))))
      do first = 1, size(self%members), chunk
         last = min(size(self%members), first + chunk - 1)
         !$omp parallel do schedule(static) if (last - first >= worth_threads)
         do i = first, last
            call evaluate_element(self, domain, i, k(:, :, i - first + 1), by_flow(:, :, i - first + 1))
         end do
         !$omp end parallel do
         associate (nodes => domain%model%connectivity(:, self%members(first:last)), n => last - first + 1)
            call domain%add_cells(nodes, motion_slots, motion_slots, k(:, :, :n), self%force(:, first:last))
            if (domain%coupled_step) call domain%add_cells(nodes, motion_slots, both_slots, by_flow(:, :, :n))
         end associate
      end do
   end subroutine evaluate

   subroutine evaluate_element(self, domain, i, k, by_flow)
      class(lorentz_term_t), intent(inout) :: self
      type(domain_t), intent(in) :: domain
      !> Place among the members
      integer, intent(in) :: i
      !> Derivatives by motions (12, 12), and by potential and temperature of the first node and of the second (12, 4)
      real(dp), intent(out) :: k(12, 12), by_flow(12, 4)
      real(dp) :: by_current(12)
      type(element_flow_t) :: flow

      flow = domain%flow_in(self%members(i))
      call force_on(domain, self%members(i), flow%own, self%field(:, i), k, self%force(:, i), by_current)
      if (domain%coupled_step) self%force(:, i) = self%force(:, i) + by_current*(flow%current - flow%own)
      k = k + spread(by_current, 2, 12)*spread(flow%by_motion, 1, 12)
      by_flow(:, 1) = by_current*flow%by_voltage
      by_flow(:, 3) = -by_flow(:, 1)
      by_flow(:, 2) = 0
      if (domain%loading%solves(field_temperature)) by_flow(:, 2) = by_current*flow%by_temperature
      by_flow(:, 4) = by_flow(:, 2)
   end subroutine evaluate_element

   !> Nodal forces of an element that carries a current, at the present iterate.
   pure subroutine force_on(domain, element, current, field, k, r, by_current)
      type(domain_t), intent(in) :: domain
      !> Index of the element
      integer, intent(in) :: element
      !> From the first to the second node [A], and flux density with its derivatives (12)
      real(dp), intent(in) :: current, field(12)
      !> As of `lorentz_force` (12, 12), (12), (12)
      real(dp), intent(out) :: k(12, 12), r(12), by_current(12)
      real(dp) :: x(3, 2), triads(3, 3, 2)

      call nodal_state(domain, element, x, triads)
      call lorentz_force(load_axis(domain, element), x, triads(:, 1, :), domain%elements%length(element), current, &
         field(:3), reshape(field(4:), [3, 3]), k, r, by_current)
   end subroutine force_on

end module litz_lorentz_term
