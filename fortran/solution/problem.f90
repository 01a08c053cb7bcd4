!> A model, the state that its run has reached, and all that an increment works on.
module litz_problem
   use litz_communicator, only: communicator_t, one_process_t
   use litz_contact_candidates, only: prepare_contact
   use litz_contact_points, only: contact_set_t
   use litz_domain, only: domain_t
   use litz_element_library, only: prepare_elements
   use litz_fields, only: n_slots, temperature_slots
   use litz_kinds, only: dp
   use litz_linear_constraints, only: new_linear_constraints
   use litz_loading, only: initial_values
   use litz_model, only: model_t, radius_at
   use litz_result_quantities, only: choose_results
   use litz_rigid_bodies, only: new_rigid_bodies
   use litz_rotations, only: identity3
   use litz_run_warnings, only: run_warnings_t
   use litz_scheme, only: scheme_t
   use litz_superconductors, only: new_superconductors
   use litz_term, only: term_entry_t
   use litz_term_list, only: list_terms
   use litz_state, only: energies_t
   use litz_wires, only: build_wires, measure_wires
   implicit none
   private
   public :: problem_t, prepare_problem

   !> Everything an increment works on.
   type, extends(domain_t) :: problem_t
      !> What adds to the equations, in this order
      type(term_entry_t), allocatable :: terms(:)
      !> The contacts, which one of the terms works on
      type(contact_set_t), pointer :: contact => null()
      type(scheme_t) :: scheme
      !> A flux is fed into a part without a path to a prescribed value
      logical :: is_fed = .false.
      !> The node where, if it is one of this process, and the field; 0: none
      integer :: fed_node = 0, fed_field = 0
      !> The solver holds a symmetric factor of a state that is not far from the present one
      logical :: has_factor = .false.
      !> The temperatures of the iterate are far from their solution
      logical :: is_far = .true.
      !> Iterations that have kept it
      integer :: factor_age = 0
      !> What the last converged increment has left of the loads, and accepted (n_slots, n_nodes) [N, N m, A, W]; not
      !> known behind a restart
      real(dp), allocatable :: left_over(:, :)
      !> Converged increments, and iterations with those of rejected increments, since the run began
      integer :: n_increments = 0, n_iterations = 0
      type(run_warnings_t) :: warnings
      !> When the present step began, or was gone on with
      type(energies_t) :: energies_before
   contains
      final :: release
   end type problem_t

contains

   !> The undeformed model, before its first step.
   subroutine prepare_problem(model, problem, processes)
      type(model_t), intent(in) :: model
      type(problem_t), intent(inout) :: problem
      !> Those that hold the model, of which this is what the present one has; absent: that has all
      class(communicator_t), intent(in), optional :: processes

      if (present(processes)) then
         allocate (problem%processes, source=processes)
      else
         allocate (one_process_t :: problem%processes)
      end if
      problem%model = model
      call build_wires(model, problem%wires)
      call prepare_elements(model, problem%wires, problem%elements)
      call measure_wires(problem%elements%length, problem%wires)
      allocate (problem%contact)
      call prepare_contact(model, problem%wires, problem%elements, problem%contact)
      call start_state(problem)
      call note_initial_temperatures(problem)
      problem%iterate%bodies = new_rigid_bodies(model)
      problem%iterate%constraints = new_linear_constraints(model)
      problem%superconductors = new_superconductors(model)
      call list_terms(problem%domain_t, problem%contact, problem%terms)
      call problem%iterate%start(problem%state, model%x)
      call problem%note_metal()
      allocate (problem%left_over(n_slots, model%n_nodes), source=0.0_dp)
   end subroutine prepare_problem

   !> The undeformed model without voltages, at its initial temperatures.
   subroutine start_state(problem)
      type(problem_t), intent(inout) :: problem
      integer :: n, m, i

      n = problem%model%n_nodes
      m = problem%model%n_elements
      associate (state => problem%state)
         call choose_results(problem%model, state)
         allocate (state%reaction(n_slots, n), state%load(n_slots, n), &
            state%outer_force(n_slots, n), state%damping(n_slots, n), source=0.0_dp)
         allocate (state%section_forces(6, m), state%line_load(3, m), state%section_ends(12, m), &
            state%section_strains(8, m), source=0.0_dp)
         allocate (state%element_current(m), state%current_density(m), state%joule_heat(m), state%heat_flux(m), &
            state%heat_made(m), state%surface_heat(m), state%heat_stored(m), state%temperature_before(n), &
            state%temperature_earlier(n), state%has_potential(n), source=0.0_dp)
         allocate (state%metal(2, m), source=0.0_dp)
         allocate (state%superconductors(4, merge(m, 0, state%has_superconductors)), source=0.0_dp)
         allocate (state%contacts(0), state%surface_contacts(0))
         state%value = initial_values(problem%model)
         state%mechanical_temperature = state%value(temperature_slots(1), :)
         state%rotation = spread(identity3, 3, n)
         state%surface_radius = [(radius_at(problem%model, i, 0.0_dp), i=1, size(problem%model%surfaces))]
         problem%loading%surface_radius = state%surface_radius
         allocate (problem%film(m), source=0.0_dp)
      end associate
   end subroutine start_state

   !> Thermal strain counts from these.
   subroutine note_initial_temperatures(problem)
      type(problem_t), intent(inout) :: problem
      integer :: i

      associate (elements => problem%elements, temperature => problem%state%value(temperature_slots(1), :))
         do i = 1, size(elements%heated)
            elements%initial_temperature(:, i) = temperature(problem%model%connectivity(:, elements%heated(i)))
         end do
      end associate
   end subroutine note_initial_temperatures

   subroutine release(problem)
      type(problem_t), intent(inout) :: problem

      if (associated(problem%contact)) deallocate (problem%contact)
   end subroutine release

end module litz_problem
