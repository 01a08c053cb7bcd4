!> One increment: the Newton iteration to equilibrium at given loads and prescribed values.
!>
!> Section forces and contact forces are independent variables of the iteration, which makes it converge in few steps
!> from far away; the residual that decides is always the true one. Source: theory section 9.
module litz_newton
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use litz_kinds, only: dp
   use litz_assembly, only: clear_system, assemble_beams, assemble_conductors, assemble_load_stiffness, motion_slots, &
      potential_slots
   use litz_contact_findings, only: finding_t, finding_none
   use litz_contact_forces, only: apply_normal_law, assemble_contacts, predict_contacts, refused_contact
   use litz_contact_candidates, only: find_candidates, candidates_hold
   use litz_contact_crossings, only: locate_points
   use litz_contact_points, only: contact_set_t
   use litz_contact_step, only: bearable_fraction
   use litz_contact_tangents, only: follow_centre_line
   use litz_equations, only: build_system
   use litz_errors, only: error_t
   use litz_fields, only: fields, n_fields, n_slots, n_groups, group_mechanical, group_electric, first_slot, &
      last_slot, last_slot_of_group, field_displacement, field_rotation, field_potential
   use litz_friction_iteration, only: friction_iteration_t
   use litz_grounding, only: ground_floating_conductors
   use litz_convergence, only: measure_residual, has_converged, corrections_small, worst_field
   use litz_loading, only: prescribed_increment
   use litz_iterate_motion, only: move_iterate
   use litz_lost_contacts, only: find_lost_contacts
   use litz_model, only: step_t
   use litz_parallel, only: worth_threads
   use litz_observer, only: observer_t
   use litz_potentials, only: solve_potentials
   use litz_problem, only: problem_t
   use litz_reports, only: iteration_report_t
   use litz_stabilization, only: assemble_stabilization
   use litz_timing, only: phase_search, phase_contact, phase_check, phase_assembly, phase_analyse, &
      phase_factor, phase_solve, phase_update, phase_output
   use litz_turned_ends, only: turned_ends_t, most_turned_ends
   implicit none
   private
   public :: outcome_t, solve_increment, count_negative_pivots, start_iterate, evaluate
   public :: cause_iterations, cause_not_finite, cause_singular, cause_lost_contact, cause_turned_ends

   !> Why an increment is given up
   integer, parameter :: cause_iterations = 1, cause_not_finite = 2, cause_singular = 3, cause_lost_contact = 4, &
      cause_turned_ends = 5, cause_failed_law = 6

   type :: outcome_t
      logical :: converged = .false.
      !> All of them, and those that factored the tangent
      integer :: iterations = 0, factorisations = 0
      !> Why it was given up, for the user
      character(len=:), allocatable :: reason
      !> One of the causes above; 0: it was not
      integer :: cause = 0
      !> What is wrong with its contacts
      type(finding_t) :: finding
      !> The last iteration and the one before
      type(iteration_report_t) :: last, before
      !> The tolerance that ended the iteration was that of round-off in one of the fields
      logical :: at_round_off = .false.
      !> Negative pivots of the last factorisation; -1: not known, or none was made
      integer :: negative_pivots = -1
      !> The same of the state in which the increment began; -1 also: its tangent was not factored
      integer :: negative_pivots_at_start = -1
      !> The last factorisation was that of the state in which the increment began
      logical :: only_start_factored = .false.
      !> Some factorisation of this attempt had negative pivots
      logical :: passed_critical = .false.
   end type outcome_t

   !> Iterations at most, in multiples of I_C, where contacts open and close as predicted all the way
   integer, parameter :: max_iterations = 4

   !> A factor of the tangent is kept if the last iteration has left no more than this of the residual. That is about
   !> how much the tangent has changed in it, and what the next iteration with the old one will leave.
   real(dp), parameter :: kept_reduction = 0.01_dp

contains

   !> Bring the iterate from the last converged state to equilibrium with the loading's present targets.
   subroutine solve_increment(problem, step, report, observer, outcome, error)
      type(problem_t), intent(inout) :: problem
      type(step_t), intent(in) :: step
      !> Step, increment and attempt are given
      type(iteration_report_t), intent(in) :: report
      class(observer_t), intent(inout) :: observer
      type(outcome_t), intent(out) :: outcome
      !> What the observer ends the run for, or an input error met on the way; not: an increment that failed
      type(error_t), allocatable, intent(out) :: error
      real(dp) :: increment(n_slots, problem%model%n_nodes), correction(n_slots, problem%model%n_nodes)
      real(dp) :: x_start(3, problem%model%n_nodes)
      type(error_t), allocatable :: solver_error
      character(len=:), allocatable :: refusal
      integer, allocatable :: numbers(:)
      integer :: counted, first_updated
      logical :: keep

      call start_iterate(problem)
      x_start = problem%iterate%x
      call prescribed_increment(problem%loading, problem%state, increment)
      ! groups that are updated after the others take what is prescribed at once
      first_updated = last_slot_of_group(problem%scheme%n_coupled) + 1
      call move_iterate(problem, increment(first_updated:, :), first_updated)
      increment(first_updated:, :) = 0
      outcome%last = report
      outcome%last%contacts_active = count(problem%contact%points%closed)
      numbers = [outcome%last%contacts_active]
      counted = 0
      do
         call evaluate(problem, x_start, increment, error)
         if (allocated(error)) return
         outcome%before = outcome%last
         call measure_residual(problem, step, outcome%last, outcome%at_round_off)
         call count_contacts(problem%contact, outcome%last)
         if (outcome%last%factor_age == 0 .and. &
            .not. only_contacts_changed(outcome%last, numbers)) counted = counted + 1
         numbers = [numbers, outcome%last%contacts_active]
         if (has_converged(outcome%last, group_mechanical) .and. problem%contact%present .and. &
            .not. any(abs(increment) > 0) .and. &
            any(problem%elements%shear_flexible)) then
            ! the axes have sheared since the increment began: contact is to balance where they are now
            call follow_centre_line(problem%model, problem%elements, problem%iterate%x, problem%iterate%rotation, &
               problem%wires)
            call evaluate(problem, x_start, increment, error)
            if (allocated(error)) return
            call measure_residual(problem, step, outcome%last, outcome%at_round_off)
         end if
         ! the monolithic tangent leaves out what contacts on the same element do to each other
         if ((problem%scheme%n_coupled < n_groups .or. problem%contact%shared%present) .and. &
            (.not. any(abs(increment) > 0))) then
            if (has_converged(outcome%last, group_mechanical)) then
               call update_potentials(problem, x_start, increment, outcome%last, solver_error, error)
               if (allocated(error)) return
               if (allocated(solver_error)) then
                  call give_up(outcome, cause_singular, solver_error%message)
                  return
               end if
               call measure_residual(problem, step, outcome%last, outcome%at_round_off)
            end if
         end if
         call problem%timing%lap(phase_update)
         call observer%iteration_done(problem, outcome%last, error)
         call problem%timing%lap(phase_output)
         if (allocated(error)) return
         refusal = refused_contact(problem%model, problem%contact)
         if (len(refusal) > 0) then
            call give_up(outcome, cause_failed_law, refusal)
            return
         end if
         if (.not. all(ieee_is_finite(outcome%last%residual))) then
            call give_up(outcome, cause_not_finite, 'the iteration left the range of finite numbers')
            return
         end if
         if ((.not. any(abs(increment) > 0)) .and. all(outcome%last%residual <= outcome%last%allowed)) then
            if (corrections_small(step, problem%iterate%change, outcome%last)) exit
         end if
         if (counted > step%controls%i_c .or. outcome%iterations >= max_iterations*step%controls%i_c) then
            call give_up(outcome, cause_iterations, worst_field(problem%model, problem%scheme%n_coupled, outcome%last))
            return
         end if
         keep = keeps_factor(problem, step, outcome)
         call solve_step(problem, increment, keep, correction, solver_error)
         if (allocated(solver_error)) then
            call give_up(outcome, cause_singular, solver_error%message)
            return
         end if
         call note_solve(problem, keep, outcome)
         call update(problem, step, correction, any(abs(increment(motion_slots(1):motion_slots(2), :)) > 0), &
            outcome%last)
         increment = 0
      end do
      outcome%converged = .true.
      call refuse_wrong_state(problem, x_start, outcome)
      call problem%timing%lap(phase_check)
   end subroutine solve_increment

   !> What a solve has shown.
   pure subroutine note_solve(problem, kept, outcome)
      type(problem_t), intent(in) :: problem
      !> The factor was that of an earlier iteration
      logical, intent(in) :: kept
      type(outcome_t), intent(inout) :: outcome

      outcome%iterations = outcome%iterations + 1
      outcome%last%iteration = outcome%iterations
      outcome%last%factor_age = problem%factor_age
      if (.not. kept) then
         outcome%factorisations = outcome%factorisations + 1
         outcome%negative_pivots = problem%scheme%negative_pivots
         outcome%only_start_factored = outcome%iterations == 1
         if (outcome%only_start_factored) outcome%negative_pivots_at_start = outcome%negative_pivots
      end if
      outcome%passed_critical = outcome%passed_critical .or. outcome%negative_pivots > 0
   end subroutine note_solve

   subroutine give_up(outcome, cause, reason)
      type(outcome_t), intent(inout) :: outcome
      !> One of `cause_...`
      integer, intent(in) :: cause
      !> Message for the user
      character(len=*), intent(in) :: reason

      outcome%converged = .false.
      outcome%cause = cause
      outcome%reason = reason
   end subroutine give_up

   !> The iterate takes over the converged state; contacts forget the predictions of the last iteration.
   subroutine start_iterate(problem)
      type(problem_t), intent(inout) :: problem

      problem%iterate%change = 0
      problem%iterate%value = problem%state%value
      problem%iterate%rotation = problem%state%rotation
      problem%iterate%x = problem%model%x &
         + problem%state%value(first_slot(field_displacement):last_slot(field_displacement), :)
      problem%iterate%sigma_from_strain = .true.
      problem%contact%points = problem%contact%converged
      problem%contact%points%predicted = .false.
      problem%contact%points%mixed_force = problem%contact%points%force
      problem%contact%points%friction_iteration = friction_iteration_t()
      if (problem%contact%present) call follow_centre_line(problem%model, problem%elements, problem%iterate%x, &
         problem%iterate%rotation, problem%wires)
      problem%contact%depth = max(0.0_dp, maxval(-problem%contact%points%kinematics%gap))
   end subroutine start_iterate

   !> Contact search, forces and tangent at the present iterate.
   subroutine evaluate(problem, x_start, increment, error)
      type(problem_t), intent(inout) :: problem
      !> Positions when the increment began (3, n_nodes) [m], and
      !> prescribed increments of this iteration (n_slots, n_nodes)
      real(dp), intent(in) :: x_start(:, :), increment(:, :)
      type(error_t), allocatable, intent(out) :: error

      associate (model => problem%model, wires => problem%wires, elements => problem%elements, &
         iterate => problem%iterate, contact => problem%contact, timing => problem%timing)
         call timing%lap(phase_update)
         if (contact%present) then
            call refresh_candidates(problem, x_start, error)
            if (allocated(error)) return
            call timing%lap(phase_search)
            call locate_points(model, wires, elements, x_start, problem%state%rotation, iterate%x, iterate%rotation, &
               contact)
            call apply_normal_law(model, elements, contact)
            call timing%lap(phase_contact)
         end if
         if (problem%pattern_changed) call rebuild_pattern(problem, error)
         if (allocated(error)) return
         call clear_system(iterate, problem%matrix, problem%forces)
         call assemble_beams(model, wires, elements, problem%equations, increment, iterate, problem%matrix, &
            problem%forces, timing)
         call assemble_conductors(model, elements, problem%equations, increment, iterate, problem%matrix, &
            problem%forces)
         call assemble_contacts(model, wires, elements, problem%equations, increment, iterate, contact, &
            problem%matrix, problem%forces, timing, error)
         if (allocated(error)) return
         call assemble_load_stiffness(problem%equations, problem%loading%load, problem%forces, problem%matrix)
         if (any(problem%damping > 0)) call assemble_stabilization(problem%damping, problem%equations, increment, &
            iterate, problem%matrix, problem%forces)
         call ground_floating_conductors(model, elements, contact, problem%equations, &
            problem%loading%fixed(potential_slots(1), :), problem%loading%load(potential_slots(1), :), problem%matrix, &
            error)
         call timing%lap(phase_assembly)
      end associate
   end subroutine evaluate

   !> New candidates when a node has moved too far since they were collected.
   subroutine refresh_candidates(problem, x_start, error)
      type(problem_t), intent(inout) :: problem
      !> Positions when the increment began (3, n_nodes) [m]
      real(dp), intent(in) :: x_start(:, :)
      type(error_t), allocatable, intent(out) :: error
      logical :: changed

      associate (contact => problem%contact, x => problem%iterate%x)
         if (candidates_hold(problem%model, problem%wires, problem%elements, contact, x, &
            problem%iterate%rotation)) return
         call find_candidates(problem%model, problem%wires, problem%elements, x_start, problem%state%rotation, x, &
            problem%iterate%rotation, contact, changed, error)
         problem%pattern_changed = problem%pattern_changed .or. changed
      end associate
   end subroutine refresh_candidates

   !> Pattern of the system and the solver's symbolic work.
   subroutine rebuild_pattern(problem, error)
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable, intent(out) :: error
      integer, allocatable :: start(:), nodes(:)
      integer :: n_elements, n_candidates, i

      n_elements = problem%model%n_elements
      n_candidates = size(problem%contact%candidates, 2)
      allocate (start(n_elements + n_candidates + 1), nodes(2*n_elements + 4*n_candidates))
      do i = 1, n_elements
         start(i) = 2*i - 1
         nodes(2*i - 1:2*i) = problem%model%connectivity(:, i)
      end do
      do i = 1, n_candidates
         start(n_elements + i) = 2*n_elements + 4*i - 3
         nodes(2*n_elements + 4*i - 3:2*n_elements + 4*i) = reshape( &
            problem%model%connectivity(:, problem%contact%candidates(1:2, i)), [4])
      end do
      start(size(start)) = size(nodes) + 1
      call build_system(start, nodes, problem%equations, problem%matrix, error)
      if (allocated(error)) return
      call problem%timing%lap(phase_assembly)
      call problem%scheme%analyse(problem%matrix, error)
      call problem%timing%lap(phase_analyse)
      problem%pattern_changed = .false.
      problem%has_factor = .false.
   end subroutine rebuild_pattern

   subroutine count_contacts(contact, report)
      type(contact_set_t), intent(in) :: contact
      type(iteration_report_t), intent(inout) :: report
      integer :: i

      report%contacts_active = count(contact%points%closed)
      report%contacts_new = count(contact%points%closed .and. contact%points%predicted .and. &
         contact%points%predicted_gap >= 0)
      report%contacts_lost = count(.not. contact%points%closed .and. contact%points%predicted .and. &
         contact%points%predicted_gap < 0)
      report%penetration = 0
      do i = 1, size(contact%points)
         report%penetration = max(report%penetration, -contact%points(i)%gap)
      end do
   end subroutine count_contacts

   !> Modified Newton: the factor at hand is good for another iteration. The first one of an increment continues
   !> with that of the last increment.
   pure logical function keeps_factor(problem, step, outcome)
      type(problem_t), intent(in) :: problem
      type(step_t), intent(in) :: step
      type(outcome_t), intent(in) :: outcome

      associate (last => outcome%last, before => outcome%before)
         keeps_factor = problem%has_factor .and. problem%matrix%symmetric(group_mechanical) .and. &
            problem%factor_age < step%reform_kernel .and. last%contacts_new == 0 .and. last%contacts_lost == 0 .and. &
            last%contacts_active == before%contacts_active
         if (outcome%iterations > 0 .and. keeps_factor) keeps_factor = all( &
            last%residual <= max(last%allowed, kept_reduction*before%residual))
      end associate
   end function keeps_factor

   !> More or fewer contacts are closed than before, each one as the linear equations predicted: they hold for the whole
   !> increment, and one of any smaller size (at first touch) would go through the same changes. Not worth a cut. A
   !> number that returns is no progress but a cycle.
   pure logical function only_contacts_changed(report, numbers)
      type(iteration_report_t), intent(in) :: report
      !> Closed contacts of each iteration before (n_iterations)
      integer, intent(in) :: numbers(:)

      only_contacts_changed = all(report%contacts_active /= numbers) .and. report%contacts_new == 0 .and. &
         report%contacts_lost == 0
   end function only_contacts_changed

   !> Voltages with the conductances of the new displacements: exact in one linear solve.
   subroutine update_potentials(problem, x_start, increment, report, solver_error, error)
      type(problem_t), intent(inout) :: problem
      !> Positions when the increment began (3, n_nodes) [m], and
      !> prescribed increments of this iteration (n_slots, n_nodes)
      real(dp), intent(in) :: x_start(:, :), increment(:, :)
      type(iteration_report_t), intent(inout) :: report
      type(error_t), allocatable, intent(out) :: solver_error, error
      real(dp) :: b(problem%equations%count(group_electric)), x(problem%equations%count(group_electric))
      real(dp) :: correction(potential_slots(2), problem%model%n_nodes)

      if (size(b) > 0 .and. .not. has_converged(report, group_electric)) then
         b = problem%equations%gather(group_electric, problem%loading%load - problem%forces%internal)
         call problem%timing%lap(phase_update)
         call problem%scheme%factor_group(group_electric, problem%matrix, solver_error)
         call problem%timing%lap(phase_factor)
         if (.not. allocated(solver_error)) call solve_potentials(problem%scheme, problem%matrix, problem%equations, &
            problem%contact%shared, b, x, solver_error)
         call problem%timing%lap(phase_solve)
         if (allocated(solver_error)) return
         correction = 0
         call problem%equations%spread_to_nodes(group_electric, x, correction)
         call move_iterate(problem, correction(potential_slots(1):, :), potential_slots(1))
         report%correction(field_potential) = maxval(abs(x))
         call evaluate(problem, x_start, increment, error)
      end if
   end subroutine update_potentials

   !> Factor and solve for the correction of all unknowns (n_slots, n_nodes), prescribed ones included.
   subroutine solve_step(problem, increment, keep, correction, error)
      type(problem_t), intent(inout) :: problem
      !> Prescribed increments of this iteration (n_slots, n_nodes)
      real(dp), intent(in) :: increment(:, :)
      !> The factor of an earlier iteration will do
      logical, intent(in) :: keep
      !> Linear step of all unknowns (n_slots, n_nodes)
      real(dp), intent(out) :: correction(:, :)
      type(error_t), allocatable, intent(out) :: error

      call problem%timing%lap(phase_update)
      if (.not. keep) call factor_tangent(problem, error)
      problem%factor_age = merge(problem%factor_age + 1, 0, keep)
      call problem%timing%lap(phase_factor)
      if (allocated(error)) return
      correction = increment
      call problem%scheme%solve(problem%matrix, problem%equations, problem%loading%load - problem%forces%internal &
         - problem%forces%iteration - problem%forces%prescribed, correction, error)
      call problem%timing%lap(phase_solve)
   end subroutine solve_step

   subroutine factor_tangent(problem, error)
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable, intent(out) :: error

      call problem%scheme%factor(problem%matrix, error)
      problem%has_factor = problem%matrix%symmetric(group_mechanical) .and. .not. allocated(error)
   end subroutine factor_tangent

   !> Factor the tangent of a converged iterate, which no iteration has done, for its negative pivots. A singular one
   !> tells nothing: nothing is solved with it.
   subroutine count_negative_pivots(problem, outcome)
      type(problem_t), intent(inout) :: problem
      type(outcome_t), intent(inout) :: outcome
      type(error_t), allocatable :: singular

      call factor_tangent(problem, singular)
      if (.not. allocated(singular)) then
         outcome%negative_pivots = problem%scheme%negative_pivots
         outcome%only_start_factored = .false.
      end if
      call problem%timing%lap(phase_factor)
   end subroutine count_negative_pivots

   !> `q <- q + eta dq`, `sigma <- (1 - eta) sigma + eta C (e + B dq)`, contact forces likewise.
   !> Source: theory section 9.
   subroutine update(problem, step, correction, prescribed, report)
      type(problem_t), intent(inout) :: problem
      type(step_t), intent(in) :: step
      !> Linear step of all unknowns (n_slots, n_nodes)
      real(dp), intent(in) :: correction(:, :)
      !> The step carries prescribed motion: it is taken whole, and the section forces are not believed
      logical, intent(in) :: prescribed
      type(iteration_report_t), intent(inout) :: report
      real(dp) :: eta, rotation, dq(2*motion_slots(2))
      integer :: field, e

      rotation = sqrt(maxval(sum(correction(first_slot(field_rotation):last_slot(field_rotation), :)**2, 1)))
      eta = 1
      if (.not. prescribed) then
         if (rotation > step%controls%rotation_cap) eta = step%controls%rotation_cap/rotation
         eta = min(eta, bearable_fraction(problem%model, problem%elements, problem%contact, correction))
      end if
      associate (iterate => problem%iterate, elements => problem%elements)
         !$omp parallel do schedule(static) private(dq) if (problem%model%n_elements >= worth_threads)
         do e = 1, problem%model%n_elements
            dq = reshape(correction(motion_slots(1):motion_slots(2), problem%model%connectivity(:, e)), [size(dq)])
            iterate%sigma(:, e) = (1 - eta)*iterate%sigma(:, e) + eta*elements%rigidity(:, e)* &
               (iterate%strain(:, e) + matmul(iterate%b(:, :, e), dq))
         end do
         !$omp end parallel do
         iterate%sigma_from_strain = prescribed
      end associate
      call predict_contacts(problem%model, eta, correction, problem%contact)
      call move_iterate(problem, eta*correction, 1)
      do field = 1, n_fields
         call largest_column(eta*correction(first_slot(field):last_slot(field), :), report%correction(field), &
            report%correction_node(field))
      end do
   end subroutine update

   pure subroutine largest_column(values, largest_norm, column)
      !> Vectors (components, n)
      real(dp), intent(in) :: values(:, :)
      !> Euclidean norm of the largest vector, in the unit of the vectors
      real(dp), intent(out) :: largest_norm
      !> Number of that vector
      integer, intent(out) :: column

      column = maxloc(sum(values**2, 1), 1)
      largest_norm = norm2(values(:, column))
   end subroutine largest_column

   !> Reject a converged state in which the ends of an element are turned against each other too far, or in which wires
   !> have passed through each other or overlap without a contact.
   subroutine refuse_wrong_state(problem, x_start, outcome)
      type(problem_t), intent(in) :: problem
      !> Positions when the increment began (3, n_nodes) [m]
      real(dp), intent(in) :: x_start(:, :)
      type(outcome_t), intent(inout) :: outcome
      type(turned_ends_t) :: most

      most = most_turned_ends(problem%model, problem%wires, problem%state%rotation, problem%iterate)
      if (most%too_far()) then
         call give_up(outcome, cause_turned_ends, most%describe(problem%model))
         return
      end if
      outcome%finding = find_lost_contacts(problem, x_start)
      if (outcome%finding%kind /= finding_none) call give_up(outcome, cause_lost_contact, &
         outcome%finding%describe(problem%model))
   end subroutine refuse_wrong_state

end module litz_newton
