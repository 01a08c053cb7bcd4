!> One increment: the Newton iteration to equilibrium at given loads and prescribed values.
!>
!> Section forces and contact forces are independent variables of the iteration, which makes it converge in few steps
!> from far away; the residual that decides is always the true one. Source: theory section 9.
module litz_newton
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use litz_kinds, only: dp
   use litz_contact_findings, only: finding_none
   use litz_assembly, only: evaluate
   use litz_convergence, only: measure_residual, vanishes_in_round_off, left_before, has_converged, corrections_small, &
      worst_field
   use litz_element_library, only: heat_elements
   use litz_errors, only: error_t
   use litz_fields, only: field_displacement, n_fields, n_slots, first_slot, last_slot, last_slot_of_group, &
      first_slot_of_group, n_groups, group_transport, temperature_slots
   use litz_grounding, only: describe_fed_part
   use litz_group_update, only: note_distance
   use litz_linear_step, only: solve_step, repeat_step
   use litz_loading, only: prescribed_increment
   use litz_lost_contacts, only: find_lost_contacts
   use litz_model, only: step_t
   use litz_outcome, only: outcome_t, cause_iterations, cause_not_finite, cause_singular, cause_lost_contact, &
      cause_turned_ends, cause_fed_part, cause_no_solution, cause_failed_law, cause_exceeded_limit
   use litz_observer, only: observer_t
   use litz_problem, only: problem_t
   use litz_reports, only: iteration_report_t
   use litz_term, only: status_t
   use litz_timing, only: phase_check, phase_factor, phase_solve, phase_update, phase_output
   use litz_turns, only: update_groups, evaluate_for_step
   use litz_turned_ends, only: turned_ends_t, most_turned_ends
   implicit none
   private
   public :: solve_increment, start_iterate

   !> Iterations at most, in multiples of I_C, where contacts open and close as predicted all the way
   integer, parameter :: max_iterations = 4

   !> Iterations to balance from where terms anticipate
   integer, parameter :: still_to_go = 2

   !> Iterations that an increment has at least from where forces have balanced first
   integer, parameter :: after_balance = 6

   !> A factor of the tangent is kept if the last iteration has left no more than this of the residual. That is about
   !> how much the tangent has changed in it, and what the next iteration with the old one will leave.
   real(dp), parameter :: kept_reduction = 0.01_dp

   !> An increment is not cut while each iteration leaves no more than this of the residual
   real(dp), parameter :: fast_reduction = 0.1_dp

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
      real(dp) :: correction(n_slots, problem%model%n_nodes), eta
      type(error_t), allocatable :: solver_error
      character(len=:), allocatable :: refusal
      integer, allocatable :: numbers(:)
      logical :: keep, is_near, only_change

      call start_iterate(problem)
      call prescribe(problem)
      outcome%last = report
      call count_status(problem, outcome%last)
      numbers = [outcome%last%contacts_active]
      do
         outcome%before = outcome%last
         if (outcome%in_turn == 1) then
            call evaluate_for_step(problem, error)
            if (allocated(error)) return
            if (outcome%iterations == 0) outcome%fed_at_start = problem%is_fed
            call measure_residual(problem, step, outcome%last, outcome%at_round_off)
         end if
         if (outcome%in_turn == 1) call outcome%note_residual()
         call count_status(problem, outcome%last)
         if (outcome%in_turn == 1 .and. .not. outcome%kept_tangent .and. &
            .not. only_contacts_changed(outcome%last, numbers)) outcome%counted = outcome%counted + 1
         numbers = [numbers, outcome%last%contacts_active]
         if (.not. carries_prescribed(problem)) then
            call settle(problem, step, outcome, error)
            if (allocated(error)) return
            if (problem%is_fed .and. has_converged(outcome%last, 1)) then
               call give_up(outcome, cause_fed_part, describe_fed_part(problem))
               return
            end if
            call update_groups(problem, step, outcome, solver_error, error)
            if (allocated(error)) return
            if (allocated(solver_error)) then
               call give_up(outcome, cause_singular, solver_error%message)
               return
            end if
         end if
         call problem%timing%lap(phase_update)
         call observer%iteration_done(problem, outcome%last, error)
         call problem%timing%lap(phase_output)
         if (allocated(error)) return
         refusal = refusal_of(problem)
         if (len(refusal) > 0) then
            call give_up(outcome, cause_failed_law, refusal)
            return
         end if
         if (.not. all(ieee_is_finite(outcome%last%residual))) then
            call give_up(outcome, cause_not_finite, 'the iteration left the range of finite numbers')
            return
         end if
         only_change = .false.
         if (outcome%iterations == 0 .and. outcome%in_turn == 1 .and. outcome%at_round_off .and. &
            all(outcome%last%residual <= outcome%last%allowed)) then
            only_change = vanishes_in_round_off(problem, step)
         end if
         if (.not. (carries_prescribed(problem) .or. only_change) .and. &
            all(outcome%last%residual <= outcome%last%allowed)) then
            if (corrections_small(problem%processes, step, problem%iterate%change, outcome%last)) then
               ! what the other groups have changed since may have come last
               if (problem%scheme%is_swept) call settle(problem, step, outcome, error)
               if (allocated(error)) return
               if (all(outcome%last%residual <= outcome%last%allowed)) exit
            end if
         end if
         if (is_hopeless(step, outcome)) then
            call give_up(outcome, cause_iterations, worst_field(problem%model, problem%scheme%n_coupled, outcome%last))
            return
         end if
         if (outcome%in_turn > 1) cycle
         keep = keeps_factor(problem, step, outcome)
         is_near = outcome%iterations > 0 .and. step%reform_kernel == 0
         call solve_step(problem, keep, is_near, outcome%last%allowed, only_change, correction, solver_error)
         if (allocated(solver_error)) then
            call give_up(outcome, cause_singular, solver_error%message)
            return
         end if
         call note_solve(problem, keep, outcome)
         if (outcome%iterations == 1 .and. .not. only_change) then
            call repeat_step(problem, outcome%last%allowed, correction, error)
            if (allocated(error)) return
         end if
         call update(problem, step, correction, outcome%last, eta)
         call outcome%note_fraction(eta)
      end do
      outcome%converged = .true.
      call refuse_wrong_state(problem, outcome)
      call problem%timing%lap(phase_check)
   end subroutine solve_increment

   !> What a solve has shown.
   pure subroutine note_solve(problem, kept, outcome)
      type(problem_t), intent(in) :: problem
      !> The tangent was that of an earlier iteration
      logical, intent(in) :: kept
      type(outcome_t), intent(inout) :: outcome

      outcome%iterations = outcome%iterations + 1
      outcome%last%iteration = outcome%iterations
      outcome%last%factor_age = problem%factor_age
      outcome%kept_tangent = kept
      if (.not. kept) then
         outcome%factorisations = outcome%factorisations + 1
      end if
      if (.not. (kept .or. problem%scheme%has_kept)) then
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

   !> The iterate takes over the converged state, and what is given, as temperatures are, at the end of the increment.
   subroutine start_iterate(problem)
      type(problem_t), intent(inout) :: problem
      integer :: i

      call problem%iterate%start(problem%state, problem%model%x)
      associate (loading => problem%loading, iterate => problem%iterate)
         where (loading%given)
            iterate%value = loading%value
            iterate%change = loading%value - problem%state%value
         end where
      end associate
      call problem%iterate%warm_mechanics()
      ! where a step goes on, the first of an increment is tried with all unknowns, too
      problem%is_far = .not. (problem%scheme%is_full .and. problem%state%increment > 0)
      call heat_elements(problem%model, problem%iterate%value(temperature_slots(1), :), &
         problem%mechanical_temperature(), problem%elements)
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%start(problem%domain_t)
      end do
   end subroutine start_iterate

   !> What is prescribed of the increment is part of the first correction; groups that are updated after the others take
   !> theirs at once.
   subroutine prescribe(problem)
      type(problem_t), intent(inout) :: problem
      integer :: first_updated

      associate (prescribed => problem%iterate%prescribed)
         call prescribed_increment(problem%loading, problem%state, prescribed)
         call problem%iterate%carry(prescribed)
         first_updated = last_slot_of_group(problem%scheme%n_coupled) + 1
         call problem%iterate%move(problem%state, problem%model%x, prescribed(first_updated:, :), first_updated)
         prescribed(first_updated:, :) = 0
      end associate
      call problem%iterate%warm_mechanics()
   end subroutine prescribe

   !> The next correction has prescribed values in it.
   logical function carries_prescribed(problem)
      type(problem_t), intent(in) :: problem

      carries_prescribed = problem%processes%any(any(abs(problem%iterate%prescribed) > 0))
   end function carries_prescribed

   !> Once the forces of the first group balance, terms bring up to date what they have held back; or before, when the
   !> iterate tells well enough what that will be, so that the iterations that are left are with it. Where no motion is
   !> free the first group balances from the start: there all that warms, and swells, has to come to rest first.
   subroutine settle(problem, step, outcome, error)
      type(problem_t), intent(inout) :: problem
      type(step_t), intent(in) :: step
      type(outcome_t), intent(inout) :: outcome
      type(error_t), allocatable, intent(out) :: error
      logical :: has_moved, moves
      integer :: i

      has_moved = .false.
      moves = problem%processes%any(any(problem%equations%number(first_slot_of_group(1):last_slot_of_group(1), :) > 0))
      if (has_converged(outcome%last, merge(1, n_groups, moves))) then
         do i = 1, size(problem%terms)
            call problem%terms(i)%term%settle(problem%domain_t, has_moved)
         end do
         has_moved = problem%processes%any(has_moved)
         if (has_moved .and. outcome%to_balance == 0) then
            outcome%to_balance = outcome%factorisations
            outcome%counted = min(outcome%counted, step%controls%i_c - after_balance)
         end if
      else if (moves) then
         do i = 1, size(problem%terms)
            call problem%terms(i)%term%anticipate(problem%domain_t, outcome%last%residual(field_displacement), &
               has_moved)
         end do
         has_moved = problem%processes%any(has_moved)
         if (has_moved .and. outcome%to_balance == 0) outcome%to_balance = outcome%factorisations + still_to_go
      end if
      if (.not. has_moved) return
      call evaluate(problem, error)
      if (allocated(error)) return
      call measure_residual(problem, step, outcome%last, outcome%at_round_off)
   end subroutine settle

   !> Why some term cannot go on from the present iterate; empty: all can.
   function refusal_of(problem) result(reason)
      type(problem_t), intent(in) :: problem
      character(len=:), allocatable :: reason
      integer :: i

      reason = ''
      do i = 1, size(problem%terms)
         if (len(reason) == 0) reason = problem%terms(i)%term%refusal(problem%domain_t)
      end do
      reason = problem%processes%first_text(reason)
   end function refusal_of

   subroutine count_status(problem, report)
      type(problem_t), intent(in) :: problem
      type(iteration_report_t), intent(inout) :: report
      type(status_t) :: status
      integer :: i

      do i = 1, size(problem%terms)
         call problem%terms(i)%term%count_status(status)
      end do
      associate (processes => problem%processes)
         report%contacts_active = processes%sum(status%active)
         report%contacts_new = processes%sum(status%new)
         report%contacts_lost = processes%sum(status%lost)
         report%contact_force = processes%sum(status%force)
         report%penetration = processes%largest(status%penetration)
      end associate
   end subroutine count_status

   !> Modified Newton: the factor at hand is good for another iteration. The first one of an increment continues
   !> with that of the last increment.
   pure logical function keeps_factor(problem, step, outcome)
      type(problem_t), intent(in) :: problem
      type(step_t), intent(in) :: step
      type(outcome_t), intent(in) :: outcome

      associate (last => outcome%last, before => outcome%before)
         keeps_factor = problem%has_factor .and. all(problem%matrix%symmetric) .and. &
            problem%factor_age < step%reform_kernel .and. last%contacts_new == 0 .and. last%contacts_lost == 0 .and. &
            last%contacts_active == before%contacts_active
         if (outcome%iterations > 0 .and. keeps_factor) keeps_factor = all( &
            last%residual <= max(last%allowed, kept_reduction*before%residual))
      end associate
   end function keeps_factor

   !> More iterations than an increment is allowed, or no hope that they would lead anywhere.
   pure logical function is_hopeless(step, outcome)
      type(step_t), intent(in) :: step
      type(outcome_t), intent(in) :: outcome

      associate (most => step%controls%i_c)
         is_hopeless = max(outcome%counted, outcome%sweeps) > most .and. .not. is_nearly_there(outcome)
         is_hopeless = is_hopeless .or. outcome%iterations >= max_iterations*most
         ! what may not be cut goes on as long as it can
         is_hopeless = is_hopeless .or. (outcome%leads_nowhere() .and. .not. step%direct)
      end associate
   end function is_hopeless

   !> The last iteration has brought the forces so much nearer to balance that a few more will do.
   pure logical function is_nearly_there(outcome)
      type(outcome_t), intent(in) :: outcome

      associate (last => outcome%last, before => outcome%before)
         is_nearly_there = outcome%in_turn == 1 .and. all(last%residual <= max(last%allowed, &
            fast_reduction*before%residual))
      end associate
   end function is_nearly_there

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

   !> `q <- q + eta dq`; terms take their own unknowns along. Prescribed motion is taken whole.
   !> Source: theory section 9.
   subroutine update(problem, step, correction, report, eta)
      type(problem_t), intent(inout) :: problem
      type(step_t), intent(in) :: step
      !> Linear step of all unknowns (n_slots, n_nodes)
      real(dp), intent(inout) :: correction(:, :)
      type(iteration_report_t), intent(inout) :: report
      !> Fraction of it that is taken
      real(dp), intent(out) :: eta
      integer :: i, field

      if (problem%coupled_step) call take_near(problem, correction)
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%foresee(problem%domain_t, correction)
      end do
      eta = 1
      if (.not. problem%processes%any(any(abs(problem%iterate%prescribed(:last_slot_of_group(1), :)) > 0))) then
         do i = 1, size(problem%terms)
            eta = min(eta, problem%terms(i)%term%bearable_fraction(problem%domain_t, step, correction))
         end do
         eta = -problem%processes%largest(-eta)
      end if
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%predict(problem%domain_t, eta, correction)
      end do
      ! what is prescribed is reached, be the rest a part of a step
      call problem%iterate%move(problem%state, problem%model%x, &
         merge(correction, eta*correction, problem%loading%fixed), 1)
      problem%iterate%prescribed = 0
      do field = 1, n_fields
         call largest_vector(problem, eta*correction(first_slot(field):last_slot(field), :), report%correction(field), &
            report%correction_node(field))
      end do
   end subroutine update

   !> A step to temperatures that are far leaves these, and potentials, where they are: it moves wires alone.
   subroutine take_near(problem, correction)
      type(problem_t), intent(inout) :: problem
      !> Linear step of all unknowns (n_slots, n_nodes)
      real(dp), intent(inout) :: correction(:, :)
      integer :: i

      do i = 1, size(problem%terms)
         call problem%terms(i)%term%shorten(problem%domain_t, correction)
      end do
      call note_distance(problem, problem%processes%largest(maxval(abs(correction(temperature_slots(1), :)))))
      if (problem%is_far) correction(first_slot_of_group(group_transport):, :) = 0
   end subroutine take_near

   subroutine largest_vector(problem, values, largest_norm, node_id)
      type(problem_t), intent(in) :: problem
      !> Vectors (components, n_nodes)
      real(dp), intent(in) :: values(:, :)
      !> Euclidean norm of the largest vector, in the unit of the vectors
      real(dp), intent(out) :: largest_norm
      !> Number of its node in the deck
      integer, intent(out) :: node_id
      real(dp) :: id(1)
      integer :: node

      node = maxloc(sum(values**2, 1), 1)
      largest_norm = norm2(values(:, node))
      id = problem%model%node_id(node)
      call problem%processes%take_largest(largest_norm, id)
      node_id = nint(id(1))
   end subroutine largest_vector

   !> Reject a converged state that is beyond a limit of the deck or no solution for some term, in which the ends of an
   !> element are turned against each other too far, or in which wires have passed through each other or overlap without
   !> a contact.
   subroutine refuse_wrong_state(problem, outcome)
      type(problem_t), intent(in) :: problem
      type(outcome_t), intent(inout) :: outcome
      type(turned_ends_t) :: most
      character(len=:), allocatable :: reason
      integer :: i

      do i = 1, size(problem%terms)
         reason = problem%processes%first_text(problem%terms(i)%term%exceeded_limit(problem%domain_t))
         if (len(reason) == 0) cycle
         call give_up(outcome, cause_exceeded_limit, reason)
         return
      end do
      do i = 1, size(problem%terms)
         reason = problem%processes%first_text(problem%terms(i)%term%rejection(problem%domain_t))
         if (len(reason) == 0) cycle
         call give_up(outcome, cause_no_solution, reason)
         return
      end do
      most = most_turned_ends(problem%model, problem%wires, problem%state%rotation, problem%iterate)
      reason = ''
      if (most%too_far()) reason = most%describe(problem%model)
      reason = problem%processes%first_text(reason)
      if (len(reason) > 0) then
         call give_up(outcome, cause_turned_ends, reason)
         return
      end if
      outcome%finding = find_lost_contacts(problem)
      if (outcome%finding%kind /= finding_none) call give_up(outcome, cause_lost_contact, &
         outcome%finding%describe(problem%model))
   end subroutine refuse_wrong_state

end module litz_newton
