!> A model, the state that its run has reached, and all that an increment works on.
module litz_problem
   use litz_assembly, only: iterate_t
   use litz_contact_candidates, only: prepare_contact
   use litz_contact_points, only: contact_set_t
   use litz_element_library, only: elements_t, prepare_elements
   use litz_equations, only: equations_t, system_t
   use litz_fields, only: n_slots
   use litz_kinds, only: dp
   use litz_loading, only: loading_t
   use litz_model, only: model_t
   use litz_rotations, only: identity3
   use litz_run_warnings, only: run_warnings_t
   use litz_scatter, only: forces_t
   use litz_scheme, only: scheme_t
   use litz_state, only: state_t
   use litz_timing, only: timing_t
   use litz_wires, only: wires_t, build_wires, measure_wires
   implicit none
   private
   public :: problem_t, prepare_problem

   !> Everything an increment works on.
   type :: problem_t
      type(model_t) :: model
      type(wires_t) :: wires
      type(elements_t) :: elements
      type(contact_set_t) :: contact
      type(loading_t) :: loading
      type(state_t) :: state
      type(iterate_t) :: iterate
      type(equations_t) :: equations
      type(system_t) :: matrix
      type(forces_t) :: forces
      type(scheme_t) :: scheme
      !> Damping of the increment against displacement [N/m] and rotation [N m]; 0: none
      real(dp) :: damping(2) = 0
      !> The pattern must be built and analysed before the next solve
      logical :: pattern_changed = .true.
      !> The solver holds a symmetric factor of a state that is not far from the present one
      logical :: has_factor = .false.
      !> Iterations that have kept it
      integer :: factor_age = 0
      !> Converged increments, and iterations with those of rejected increments, since the run began
      integer :: n_increments = 0, n_iterations = 0
      type(timing_t) :: timing
      type(run_warnings_t) :: warnings
   end type problem_t

contains

   !> The undeformed model, before its first step.
   subroutine prepare_problem(model, problem)
      type(model_t), intent(in) :: model
      type(problem_t), intent(out) :: problem

      problem%model = model
      call build_wires(model, problem%wires)
      call prepare_elements(model, problem%wires, problem%elements)
      call measure_wires(problem%elements%length, problem%wires)
      call prepare_contact(model, problem%wires, problem%elements, problem%contact)
      call start_state(problem)
   end subroutine prepare_problem

   !> The undeformed model without voltages, and arrays of the iteration.
   subroutine start_state(problem)
      type(problem_t), intent(inout) :: problem
      integer :: n, m

      n = problem%model%n_nodes
      m = problem%model%n_elements
      associate (state => problem%state, iterate => problem%iterate)
         allocate (state%value(n_slots, n), state%reaction(n_slots, n), state%load(n_slots, n), &
            state%stabilizing_force(n_slots, n), source=0.0_dp)
         allocate (state%section_forces(6, m), source=0.0_dp)
         allocate (state%element_current(m), state%current_density(m), state%joule_heat(m), source=0.0_dp)
         allocate (state%contacts(0))
         state%rotation = spread(identity3, 3, n)
         allocate (iterate%sigma(6, m), iterate%strain(6, m), iterate%section_forces(6, m), iterate%b(6, 12, m), &
            source=0.0_dp)
         allocate (iterate%element_current(m), iterate%joule_heat(m), source=0.0_dp)
         allocate (iterate%change(n_slots, n), source=0.0_dp)
      end associate
   end subroutine start_state

end module litz_problem
