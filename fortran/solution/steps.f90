!> The steps of a run: increments, cut-backs, and the message where these do not help.
module litz_steps
   use litz_audit, only: audit_t, audit_increment, audit_error
   use litz_capture, only: capture_state
   use litz_convergence, only: measure_scales, nodal_residual
   use litz_diagnosis, only: not_converged
   use litz_element_loads, only: load_lorentz
   use litz_equations, only: number_equations
   use litz_errors, only: error_t, fail, exit_input, exit_not_converged
   use litz_fields, only: fields, n_slots, field_displacement, field_temperature, field_of_dof, field_of_slot, &
      slot_of_dof
   use litz_increment_warnings, only: add_increment_warnings
   use litz_kinds, only: dp
   use litz_loading, only: loading_t, start_loading, load_targets, move_radii, next_break_point
   use litz_line_contact, only: serves_lines
   use litz_model, only: model_t, step_t, nodal_value_t, coupling_default, coupling_updated, coupling_swept, &
      coupling_full, ramp_at
   use litz_negative_pivots, only: count_negative_pivots, begins_elsewhere
   use litz_newton, only: solve_increment
   use litz_outcome, only: outcome_t, cause_not_finite, cause_large_change, cause_lost_contact, &
      cause_turned_ends, cause_fed_part
   use litz_observer, only: observer_t
   use litz_parallel_wires, only: shallow_angle
   use litz_problem, only: problem_t
   use litz_reports, only: iteration_report_t, increment_report_t
   use litz_step_control, only: course_t
   use litz_step_end, only: reaches_end, step_is_over
   use litz_text, only: to_text
   use litz_timing, only: phase_update, phase_output
   implicit none
   private
   public :: run_step, begin_step

contains

   !> Solve a step, from its start or from where the problem stands in it.
   subroutine run_step(problem, number, solver, continued, course, observer, error)
      type(problem_t), intent(inout) :: problem
      !> Step, and one of the solver constants of the model; 0: as the step says
      integer, intent(in) :: number, solver
      !> The problem stands somewhere in this step, and the course with it
      logical, intent(in) :: continued
      type(course_t), intent(inout) :: course
      class(observer_t), intent(inout) :: observer
      type(error_t), allocatable, intent(out) :: error
      type(loading_t) :: restored
      logical :: restart_taken
      character(len=120) :: text

      associate (step => problem%model%steps(number), state => problem%state)
         restored = problem%loading
         call begin_step(problem, step, solver, error)
         if (allocated(error)) return
         if (continued) then
            restored%given = problem%loading%given
            restored%prescribed = problem%loading%prescribed
            restored%converged_ramp = ramp_at(step, state%step_time)
            restored%time = state%time
            restored%converged_time = state%time
            restored%solves = problem%loading%solves
            restored%stays = problem%loading%stays
            restored%surface_radius = state%surface_radius
            problem%loading = restored
            state%ends_step = step_is_over(problem, step)
         else
            call course%control%start(step)
            state%step = number
            state%increment = 0
            state%step_time = 0
            state%ends_step = .false.
            course%start_time = state%time
         end if
         do while (.not. state%ends_step)
            if (state%increment >= step%max_increments) then
               write (text, '(a, i0, a, i0, a, es10.3, a, es10.3)') 'step ', number, ': the ', step%max_increments, &
                  ' increments of INC= are used up at step time', state%step_time, ' of', step%total
               error = fail(exit_not_converged, trim(text))
               return
            end if
            call run_increment(problem, step, course, observer, error)
            if (allocated(error)) return
            call observer%offer_restart(problem, course, restart_taken, error)
            if (allocated(error)) return
            ! a run that continues from here has none either
            if (restart_taken) then
               problem%has_factor = .false.
               if (allocated(problem%left_over)) deallocate (problem%left_over)
            end if
         end do
      end associate
   end subroutine run_step

   !> Supports, solver and equations of the step.
   subroutine begin_step(problem, step, solver, error)
      type(problem_t), intent(inout) :: problem
      type(step_t), intent(in) :: step
      !> One of the solver constants of the model; 0: as the step says
      integer, intent(in) :: solver
      type(error_t), allocatable, intent(out) :: error
      logical, dimension(n_slots, problem%model%n_nodes) :: exists, stays, is_there
      logical :: same_system
      integer, allocatable :: number_before(:, :)
      integer :: kind, coupling

      problem%energies_before = problem%state%energies
      call start_loading(step, problem%state, problem%loading)
      call request_slots(problem, step%has_solved, stays)
      call request_slots(problem, step%solves, exists)
      associate (eliminated => problem%iterate%constraints%of > 0, n => problem%model%n_nodes)
         problem%loading%stays = stays .or. (eliminated .and. spread(step%has_solved(field_of_slot), 2, n))
         call release(step, problem%loading%stays)
         is_there = exists .or. (eliminated .and. spread(step%solves(field_of_slot), 2, n))
      end associate
      call refuse_absent_unknowns(problem%model, step%boundary, exists, error)
      call find_given_values(problem%model, step, is_there, problem%loading, error)
      call refuse_absent_unknowns(problem%model, step%load, is_there, error)
      if (allocated(error)) return
      if (problem%scheme%is_created()) number_before = problem%equations%number
      call number_equations(problem%loading%fixed, exists, problem%equations)
      kind = merge(solver, step%solver, solver > 0)
      coupling = coupling_of(step)
      same_system = problem%scheme%is_same(kind, coupling)
      if (same_system) same_system = all(number_before == problem%equations%number)
      same_system = .not. problem%processes%any(.not. same_system)
      if (.not. same_system) then
         call problem%scheme%create(kind, coupling, error)
         if (allocated(error)) return
         problem%matrix%is_two_way = problem%scheme%is_full
         problem%pattern_changed = .true.
      end if
      problem%has_factor = .false.
   end subroutine begin_step

   !> What a step before has given and this one does not returns to its initial value, also where one has solved for it.
   pure subroutine release(step, stays)
      type(step_t), intent(in) :: step
      !> (n_slots, n_nodes)
      logical, intent(inout) :: stays(:, :)
      integer :: i

      if (.not. allocated(step%let_go)) return
      do i = 1, size(step%let_go)
         stays(slot_of_dof(step%let_go(i)%dof), step%let_go(i)%node) = .false.
      end do
   end subroutine release

   !> Motions and temperatures have one Newton step unless the deck asks for turns, and so have motions and potentials
   !> where currents move wires in a magnetic field; temperatures alone have the iteration of a turn.
   pure integer function coupling_of(step) result(coupling)
      type(step_t), intent(in) :: step

      coupling = step%coupling
      if (step%solves(field_temperature) .or. any(step%element_loads%kind == load_lorentz)) then
         coupling = merge(coupling_full, coupling_swept, step%solves(field_displacement) .and. &
            step%coupling /= coupling_updated)
      else if (coupling == coupling_full) then
         coupling = coupling_default
      end if
   end function coupling_of

   !> Unknowns that the terms have in a step.
   subroutine request_slots(problem, solves, exists)
      type(problem_t), intent(inout) :: problem
      !> Fields that it solves for (n_fields)
      logical, intent(in) :: solves(:)
      !> (n_slots, n_nodes)
      logical, intent(out) :: exists(:, :)
      integer :: i

      problem%loading%solves = solves
      exists = .false.
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%request_slots(problem%domain_t, exists)
      end do
   end subroutine request_slots

   !> A value or load of an unknown that no term has would be without effect.
   pure subroutine refuse_absent_unknowns(model, items, exists, error)
      type(model_t), intent(in) :: model
      type(nodal_value_t), intent(in) :: items(:)
      !> (n_slots, n_nodes)
      logical, intent(in) :: exists(:, :)
      type(error_t), allocatable, intent(inout) :: error
      integer :: i

      do i = 1, size(items)
         if (allocated(error)) return
         associate (dof => items(i)%dof, node => items(i)%node)
            if (.not. exists(slot_of_dof(dof), node)) error = fail(exit_input, 'degree of freedom '//to_text(dof)// &
               ' ('//trim(fields(field_of_dof(dof))%name)//') is prescribed or loaded at node '// &
               to_text(model%node_id(node))//', where nothing has it')
         end associate
      end do
   end subroutine refuse_absent_unknowns

   !> An optional field has values where it is no unknown, too: those that the deck gives. Of an unknown none can be.
   pure subroutine find_given_values(model, step, exists, loading, error)
      type(model_t), intent(in) :: model
      type(step_t), intent(in) :: step
      !> Unknowns, and what equations eliminate (n_slots, n_nodes)
      logical, intent(in) :: exists(:, :)
      type(loading_t), intent(inout) :: loading
      type(error_t), allocatable, intent(inout) :: error
      integer :: i

      loading%given = .not. exists .and. spread(fields(field_of_slot)%is_optional .and. &
         model%has_field(field_of_slot), 2, model%n_nodes)
      do i = 1, size(step%predefined)
         if (allocated(error)) return
         associate (dof => step%predefined(i)%dof, node => step%predefined(i)%node)
            if (exists(slot_of_dof(dof), node)) error = fail(exit_input, 'the '// &
               trim(fields(field_of_dof(dof))%name)//' of node '//to_text(model%node_id(node))//' is given, where'// &
               ' it is an unknown; prescribe it by *BOUNDARY, degree of freedom '//to_text(dof))
         end associate
      end do
   end subroutine find_given_values

   !> One increment with its cut-backs.
   subroutine run_increment(problem, step, course, observer, error)
      type(problem_t), intent(inout) :: problem
      type(step_t), intent(in) :: step
      type(course_t), intent(inout) :: course
      class(observer_t), intent(inout) :: observer
      type(error_t), allocatable, intent(out) :: error
      type(iteration_report_t) :: report
      type(outcome_t) :: outcome
      type(audit_t) :: audit
      real(dp) :: break_point, increment, target, ratio
      character(len=:), allocatable :: reason
      logical :: possible
      integer :: i

      associate (step_time => problem%state%step_time, start_time => course%start_time, control => course%control)
         report%step = problem%state%step
         report%increment = problem%state%increment + 1
         report%attempt = 0
         break_point = next_break_point(problem%model, step, step_time, start_time + step_time)
         do
            report%attempt = report%attempt + 1
            increment = control%propose(step_time, break_point)
            target = step_time + increment
            call load_targets(problem%model, step, target, start_time + target, problem%loading)
            call move_radii(problem%model, step, target, problem%state, problem%loading)
            do i = 1, size(problem%terms)
               call problem%terms(i)%term%apply_load(problem%domain_t, step, target, increment)
            end do
            call solve_increment(problem, step, report, observer, outcome, error)
            if (allocated(error)) return
            problem%n_iterations = problem%n_iterations + outcome%iterations
            call find_bearable_ratio(problem, step, ratio, reason)
            if (outcome%converged .and. ratio < 1) call refuse_change(reason, outcome)
            if (outcome%converged) exit
            problem%has_factor = .false.
            call observer%attempt_done(problem, report_of(problem, outcome, audit, increment, target, start_time), &
               error)
            if (allocated(error)) return
            if (outcome%cause /= cause_large_change) ratio = 1
            possible = control%cut(step, increment, report%attempt, ratio)
            if (outcome%cause == cause_lost_contact) then
               if (.not. control%refuse(outcome%finding, problem%wires%wire, target)) possible = .false.
            end if
            if (outcome%cause == cause_turned_ends) then
               if (.not. control%refuse_turned(target)) possible = .false.
            end if
            if (outcome%cause == cause_fed_part .and. outcome%fed_at_start) possible = .false.
            if (.not. possible) then
               call give_up(problem, step, outcome, increment, observer, error)
               return
            end if
         end do
         ! the tangent of any other increment is the first that the next one factors, unless that begins elsewhere
         if (reaches_end(step, target) .or. begins_elsewhere(problem)) then
            call count_negative_pivots(problem, outcome, error)
            if (allocated(error)) return
         end if
         call advance(problem, outcome, increment, target, start_time)
         problem%state%ends_step = step_is_over(problem, step)
         audit = audit_increment(problem%processes, problem%model, problem%state, problem%loading, &
            nodal_residual(problem), measure_scales(problem))
         problem%state%audit = [audit%force, audit%moment, audit%current, audit%power, audit%penetration]
         call problem%timing%lap(phase_update)
         if (.not. ratio > 1) call warn_of_smallest(problem, reason)
         call report_increment(problem, outcome, audit, &
            report_of(problem, outcome, audit, increment, target, start_time), observer, error)
         if (allocated(error)) return
         call control%accept(step, step_time, outcome%effort(), min(ratio, 1/epsilon(ratio))*increment)
      end associate
   end subroutine run_increment

   !> An increment that is no smaller because no smaller one is allowed.
   subroutine warn_of_smallest(problem, reason)
      type(problem_t), intent(inout) :: problem
      !> Why it ought to be
      character(len=*), intent(in) :: reason

      associate (state => problem%state)
         call problem%warnings%set_place(state%step, state%increment, state%time)
         call problem%warnings%add('smallest_increment', 'the smallest increment (third value of the procedure) is'// &
            ' not small enough: '//reason, value=state%time_increment, unit=problem%model%units%label('s'))
      end associate
   end subroutine warn_of_smallest

   !> The largest increment that all terms bear, over the one that has converged.
   subroutine find_bearable_ratio(problem, step, ratio, reason)
      type(problem_t), intent(in) :: problem
      type(step_t), intent(in) :: step
      !> Over the one that has converged
      real(dp), intent(out) :: ratio
      !> Why no larger one is
      character(len=:), allocatable, intent(out) :: reason
      character(len=:), allocatable :: reason_of_term
      real(dp) :: ratio_of_term
      integer :: i

      ratio = huge(ratio)
      reason = ''
      if (step%direct) return
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%bearable_increment(problem%domain_t, step, ratio_of_term, reason_of_term)
         if (.not. ratio_of_term < ratio) cycle
         ratio = ratio_of_term
         reason = reason_of_term
      end do
      ratio_of_term = ratio
      ratio = -problem%processes%largest(-ratio)
      if (ratio_of_term > ratio) reason = ''
      reason = problem%processes%first_text(reason)
   end subroutine find_bearable_ratio

   pure subroutine refuse_change(reason, outcome)
      !> Why it is refused, for messages
      character(len=*), intent(in) :: reason
      type(outcome_t), intent(inout) :: outcome

      outcome%converged = .false.
      outcome%cause = cause_large_change
      outcome%reason = reason
   end subroutine refuse_change

   !> The iterate becomes the converged state.
   subroutine advance(problem, outcome, increment, step_time, start_time)
      type(problem_t), intent(inout) :: problem
      type(outcome_t), intent(in) :: outcome
      !> Increment, time of the step at its end, and total time at the start of the step [s]
      real(dp), intent(in) :: increment, step_time, start_time

      problem%n_increments = problem%n_increments + 1
      problem%state%increment = outcome%last%increment
      problem%state%iterations = outcome%iterations
      problem%state%step_time = step_time
      problem%state%time = start_time + step_time
      problem%state%time_increment_before = problem%state%time_increment
      problem%state%time_increment = increment
      call capture_state(problem)
   end subroutine advance

   !> Report an increment that has converged; one that fails its audit ends the run.
   subroutine report_increment(problem, outcome, audit, report, observer, error)
      type(problem_t), intent(inout) :: problem
      type(outcome_t), intent(in) :: outcome
      type(audit_t), intent(in) :: audit
      type(increment_report_t), intent(in) :: report
      class(observer_t), intent(inout) :: observer
      type(error_t), allocatable, intent(out) :: error

      if (len(audit%finding) == 0) call observer%increment_accepted(problem, error)
      if (allocated(error)) return
      call add_increment_warnings(problem, outcome, audit)
      call observer%warnings_added(problem, error)
      if (allocated(error)) return
      call observer%attempt_done(problem, report, error)
      if (.not. allocated(error) .and. len(audit%finding) > 0) error = audit_error(problem%state, audit)
      call problem%timing%lap(phase_output)
   end subroutine report_increment

   !> End the run with a message that says how far the iteration had come.
   subroutine give_up(problem, step, outcome, increment, observer, error)
      type(problem_t), intent(inout) :: problem
      type(step_t), intent(in) :: step
      type(outcome_t), intent(in) :: outcome
      !> The last one that was tried [s]
      real(dp), intent(in) :: increment
      class(observer_t), intent(inout) :: observer
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: write_error
      character(len=:), allocatable :: place

      error = not_converged(problem, step, outcome, problem%state%step_time, increment, outcome%last%attempt)
      if (problem%n_increments > 0) error%message = error%message//' The results hold all increments before.'
      if (outcome%cause == cause_not_finite) return
      associate (state => problem%state)
         state%increment = outcome%last%increment
         state%iterations = outcome%iterations
         state%time = state%time + increment
         state%step_time = state%step_time + increment
         state%time_increment = increment
         state%audit = 0
      end associate
      call observer%begin_giving_up(problem, write_error)
      call capture_state(problem)
      call observer%given_up(problem, place, write_error)
      if (allocated(write_error)) return
      error%message = error%message//' The iterate that was given up, and its contacts, are in '//place//'.'
   end subroutine give_up

   !> The report of an increment, converged or cut.
   function report_of(problem, outcome, audit, increment, step_time, start_time) result(report)
      type(problem_t), intent(in) :: problem
      type(outcome_t), intent(in) :: outcome
      !> Of an accepted increment
      type(audit_t), intent(in) :: audit
      !> Increment, time of the step at its end, and total time at the start of the step [s]
      real(dp), intent(in) :: increment, step_time, start_time
      type(increment_report_t) :: report
      character(len=:), allocatable :: remark

      report%step = outcome%last%step
      report%increment = outcome%last%increment
      report%attempts = outcome%last%attempt
      report%iterations = outcome%iterations
      report%time = start_time + step_time
      report%step_time = step_time
      report%time_increment = increment
      report%residual = outcome%last%residual
      report%negative_pivots = outcome%negative_pivots
      report%contacts = outcome%last%contacts_active
      report%contact_force = outcome%last%contact_force
      report%converged = outcome%converged
      remark = remark_of(problem, outcome)
      if (outcome%converged) then
         report%audit = problem%state%audit
         if (len(audit%finding) > 0) remark = 'audit failed: '//audit%finding
         report%at_round_off = outcome%at_round_off
      end if
      report%remark = without_last_semicolon(remark)
   end function report_of

   !> What a user should know of an increment; empty: nothing.
   function remark_of(problem, outcome) result(remark)
      type(problem_t), intent(in) :: problem
      type(outcome_t), intent(in) :: outcome
      character(len=:), allocatable :: remark, joule
      character(len=120) :: text
      integer :: i, n

      remark = ''
      if (.not. outcome%converged) then
         remark = 'cut: '//outcome%reason
         return
      end if
      if (outcome%negative_pivots > 0) remark = 'negative pivots: beyond a critical load; '
      if (problem%model%steps(outcome%last%step)%controls%stabilize > 0) then
         joule = problem%model%units%after('J')
         write (text, '(a, es9.2, 2a, es9.2, 2a)') 'stabilization has taken', problem%state%energies%stabilization, &
            joule, ', the beams hold', problem%state%energies%strain, joule, ';'
         remark = remark//trim(text)//' '
      end if
      n = 0
      do i = 1, size(problem%contact%points)
         associate (point => problem%contact%points(i))
            if (point%closed .and. sin(point%kinematics%angle) < sin(shallow_angle) .and. &
               .not. serves_lines(problem%model, point%pair)) n = n + 1
         end associate
      end do
      n = problem%processes%sum(n)
      if (n > 0) then
         write (text, '(i0, a)') n, ' contacts cross at less than 10 degrees;'
         remark = remark//trim(text)//' '
      end if
   end function remark_of

   !> Remarks end in semicolons, because others may follow.
   pure function without_last_semicolon(remark) result(text)
      !> Remarks, each with a semicolon at its end
      character(len=*), intent(in) :: remark
      character(len=:), allocatable :: text

      text = trim(remark)
      if (len(text) > 0) then
         if (text(len(text):) == ';') text = text(:len(text) - 1)
      end if
   end function without_last_semicolon

end module litz_steps
