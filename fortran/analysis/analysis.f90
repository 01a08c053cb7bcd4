!> A run from the resolved model to the closed result files: steps, increments, cut-backs.
module litz_analysis
   use, intrinsic :: iso_fortran_env, only: output_unit
   use litz_audit, only: audit_t, audit_increment, audit_error
   use litz_available_memory, only: memory_text
   use litz_kinds, only: dp, pi
   use litz_capture, only: start_state, capture_state
   use litz_contact_findings, only: finding_t, finding_none, finding_deep
   use litz_contact_net, only: inspect_contacts
   use litz_contact_pairs, only: prepare_contact, find_candidates, locate_points
   use litz_contact_points, only: contact_point_t
   use litz_diagnosis, only: not_converged
   use litz_element_library, only: prepare_elements
   use litz_equations, only: number_equations
   use litz_errors, only: error_t, error_list_t, fail, exit_input, exit_not_converged, exit_files
   use litz_increment_warnings, only: add_deck_warnings, add_start_warnings, add_increment_warnings
   use litz_loading, only: loading_t, start_loading, load_targets, next_break_point
   use litz_model, only: model_t, step_t, solver_block, coupling_default, coupling_monolithic, coupling_updated, &
      request_contact
   use litz_newton, only: problem_t, outcome_t, solve_increment, measure_scales, nodal_residual, cause_not_finite, &
      cause_lost_contact
   use litz_parallel_wires, only: shallow_angle
   use litz_step_control, only: step_control_t
   use litz_restart_file, only: restart_file_t, course_t, read_restart, wants_restart
   use litz_run_warnings, only: run_warnings_t
   use litz_result_lock, only: lock_results, unlock_results
   use litz_results, only: results_t, iteration_report_t, increment_report_t
   use litz_output_files, only: check_writable, same_file
   use litz_stabilization, only: damping_stiffness
   use litz_solver_factory, only: create_solver, resolved_solver
   use litz_timing, only: timing_t, peak_memory, phase_preparation, phase_search, phase_update, phase_output
   use litz_warning_messages, only: issue_warnings, print_warning_count
   use litz_wires, only: build_wires, measure_wires
!$ use omp_lib, only: omp_set_num_threads
   implicit none
   private
   public :: run_options_t, run_analysis, check_model

   !> Wires may overlap in the reference by this fraction of the smaller radius without being an interference fit
   real(dp), parameter :: allowed_overlap = 0.01_dp

   type :: run_options_t
      character(len=:), allocatable :: deck_path
      !> Empty: the current directory
      character(len=:), allocatable :: output_directory
      !> One of the solver constants of the model; 0: as the deck says
      integer :: solver = 0
      !> 0: as the environment says
      integer :: threads = 0
      !> Restart file to go on from, empty: none; step and increment in it, 0: the last one
      character(len=:), allocatable :: restart_path
      integer :: restart_step = 0, restart_increment = 0
      !> No progress on the terminal
      logical :: quiet = .false.
      !> Print where time and memory went
      logical :: print_timing = .false.
      !> What reading the deck has warned of
      type(error_list_t) :: deck_warnings
      !> Running since the program began
      type(timing_t) :: timing
   end type run_options_t

contains

   !> Run all steps.
   subroutine run_analysis(model, options, error)
      type(model_t), intent(in) :: model
      type(run_options_t), intent(in) :: options
      type(error_t), allocatable, intent(out) :: error
      type(problem_t) :: problem
      type(results_t) :: results
      type(restart_file_t) :: restart
      type(course_t) :: course
      real(dp), allocatable :: overlap(:)
      type(error_t), allocatable :: close_error
      character(len=:), allocatable :: lock_warning
      logical :: continued
      integer :: i

!$    if (options%threads > 0) call omp_set_num_threads(options%threads)
      call prepare_problem(model, problem)
      problem%timing = options%timing
      call problem%timing%lap(phase_preparation)
      call find_initial_overlap(problem, overlap, error)
      if (allocated(error)) return
      ! an interference fit begins without stress: what resolves it does work from the first increment on
      problem%contact%clearance = overlap
      problem%contact%converged_clearance = overlap
      call problem%timing%lap(phase_search)
      continued = len(options%restart_path) > 0
      if (continued) then
         call continue_from(options, problem, course, error)
         if (allocated(error)) return
      end if
      call add_deck_warnings(options%deck_warnings, problem%warnings)
      if (.not. continued) call add_start_warnings(problem)
      if (problem%state%step > 1) overlap = 0
      call lock_results(result_base(options), lock_warning, error)
      if (allocated(error)) return
      call open_restart_file(restart, problem, options, error)
      call results%open(model, options%output_directory, deck_stem(options%deck_path), problem%state, error)
      if (allocated(error)) then
         call restart%close(close_error)
         call unlock_results()
         return
      end if
      if (len(lock_warning) > 0) call problem%warnings%add('no_lock', lock_warning)
      if (.not. options%quiet) call print_header(model)
      call issue_warnings(problem, results, error)
      if (.not. allocated(error)) call results%write_increment(model, problem%state, .true., error)
      call problem%timing%lap(phase_output)
      call problem%progress%start(.not. options%quiet, sum(model%steps%total), problem%state%time)
      do i = max(1, problem%state%step), size(model%steps)
         if (allocated(error)) exit
         call run_step(problem, model%steps(i), i, overlap, continued, course, options, results, restart, error)
         overlap = 0
         continued = .false.
      end do
      call problem%progress%clear
      call results%list_warnings(problem%warnings, error)
      call results%close(.not. allocated(error), error)
      call restart%close(error)
      call unlock_results()
      if (allocated(error) .and. results%leaves_older()) error%message = error%message//' The results of an earlier'// &
         ' run stay as they are; the tables of this one are '//result_base(options)//'_unconverged.sta and .cvg.'
      call problem%timing%lap(phase_output)
      if (options%print_timing) write (output_unit, '(a)', advance='no') problem%timing%table(problem%n_iterations)
      if (.not. (allocated(error) .or. options%quiet)) call print_end(problem, options)
      call print_warning_count(problem%warnings, result_base(options)// &
         trim(merge('_unconverged.sta', '.sta            ', results%leaves_older())))
   end subroutine run_analysis

   !> Take over a converged increment of an earlier run.
   subroutine continue_from(options, problem, course, error)
      type(run_options_t), intent(in) :: options
      type(problem_t), intent(inout) :: problem
      type(course_t), intent(out) :: course
      type(error_t), allocatable, intent(inout) :: error

      if (same_file(options%restart_path, restart_path(options))) then
         error = fail(exit_files, 'the results of the run that is continued, '//result_base(options)// &
            '.*, would be overwritten; name another directory with -o')
         return
      end if
      call read_restart(options%restart_path, options%restart_step, options%restart_increment, problem, course, error)
   end subroutine continue_from

   !> The file from which this run can be continued, where a step asks for it.
   subroutine open_restart_file(restart, problem, options, error)
      type(restart_file_t), intent(inout) :: restart
      type(problem_t), intent(inout) :: problem
      type(run_options_t), intent(in) :: options
      type(error_t), allocatable, intent(inout) :: error

      if (.not. any(problem%model%steps%restart_frequency > 0)) return
      call check_writable(restart_path(options), error)
      call restart%open(restart_path(options), problem, error)
   end subroutine open_restart_file

   pure function restart_path(options) result(path)
      type(run_options_t), intent(in) :: options
      character(len=:), allocatable :: path

      path = result_base(options)//'.restart.h5'
   end function restart_path

   !> What can be told without solving: wires, and the crossings at the start.
   subroutine check_model(model, report, warnings, error)
      type(model_t), intent(in) :: model
      character(len=:), allocatable, intent(out) :: report
      type(run_warnings_t), intent(out) :: warnings
      type(error_t), allocatable, intent(out) :: error
      type(problem_t) :: problem
      real(dp), allocatable :: overlap(:)
      character(len=200) :: line
      integer :: i

      report = ''
      call prepare_problem(model, problem)
      call find_initial_overlap(problem, overlap, error)
      if (allocated(error)) return
      write (line, '(a, i0)') 'wires (chains of elements): ', problem%wires%n_wires
      report = trim(line)//new_line('a')
      if (.not. problem%contact%present) return
      write (line, '(a, i0, a, i0, a)') 'contact search: ', size(problem%contact%candidates, 2), &
         ' pairs of elements are near, ', size(problem%contact%points), ' crossings within reach'
      report = report//trim(line)//new_line('a')
      call add_start_warnings(problem)
      warnings = problem%warnings
      do i = 1, min(20, size(problem%contact%points))
         associate (point => problem%contact%points(i))
            write (line, '(a, i0, a, i0, a, f6.2, a, es11.3, a)') '  elements ', model%element_id(point%element_bar), &
               ' and ', model%element_id(point%element), ': crossing angle ', &
               min(point%kinematics%angle, pi - point%kinematics%angle)*180/pi, ' degrees, gap ', point%gap, &
               ' '//trim(model%units%length)
            report = report//trim(line)//new_line('a')
         end associate
      end do
   end subroutine check_model

   subroutine prepare_problem(model, problem)
      type(model_t), intent(in) :: model
      type(problem_t), intent(out) :: problem

      problem%model = model
      call build_wires(model, problem%wires)
      call prepare_elements(model, problem%wires, problem%elements)
      call measure_wires(problem%elements%length, problem%wires)
      call prepare_contact(model, problem%elements, problem%contact)
      call start_state(problem)
   end subroutine prepare_problem

   !> Largest overlap of the reference configuration for each pair that is meant as an interference fit; an error for
   !> any other pair.
   subroutine find_initial_overlap(problem, overlap, error)
      type(problem_t), intent(inout) :: problem
      real(dp), allocatable, intent(out) :: overlap(:)
      type(error_t), allocatable, intent(out) :: error
      integer :: i, n_refused, worst
      logical :: changed
      character(len=400) :: text

      allocate (overlap(size(problem%model%contact_pairs)), source=0.0_dp)
      if (.not. problem%contact%present) return
      associate (model => problem%model, contact => problem%contact, state => problem%state)
         call find_candidates(model, problem%wires, problem%elements, model%x, state%rotation, model%x, &
            state%rotation, contact, changed, error)
         if (allocated(error)) return
         call locate_points(model, problem%wires, problem%elements, model%x, state%rotation, model%x, state%rotation, &
            contact)
         n_refused = 0
         worst = 0
         do i = 1, size(contact%points)
            associate (point => contact%points(i))
               if (model%contact_pairs(point%pair)%interference_fit) then
                  point%fit = max(0.0_dp, -point%gap)
                  overlap(point%pair) = max(overlap(point%pair), point%fit)
               else if (-point%gap > allowed_overlap*minval(radii(point))) then
                  n_refused = n_refused + 1
                  if (worst == 0) worst = i
                  if (point%gap < contact%points(worst)%gap) worst = i
               end if
            end associate
         end do
         contact%converged = contact%points
         call refuse_unmodelled(problem, error)
         if (n_refused == 0 .or. allocated(error)) return
         associate (point => contact%points(worst), pair => model%contact_pairs(contact%points(worst)%pair))
            write (text, '(a, i0, a, i0, a, es9.2, a, f0.1, a, i0, a)') 'the wires of elements ', &
               model%element_id(point%element_bar), ' and ', model%element_id(point%element), &
               ' overlap at the start by', -point%gap, ' '//trim(model%units%length)//', that is ', &
               -100*point%gap/minval(radii(point)), &
               ' % of the smaller radius (allowed: 1 %; ', n_refused, &
               ' crossings overlap in all); move the wires apart, or add INTERFERENCE FIT to *CONTACT PAIR'
            error = fail(exit_input, trim(text))
            error%file = pair%file
            error%line = pair%line
         end associate
      end associate

   contains

      pure function radii(point)
         type(contact_point_t), intent(in) :: point
         real(dp) :: radii(2)

         radii = problem%elements%radius([point%element_bar, point%element])
      end function radii

   end subroutine find_initial_overlap

   !> Wires that overlap at the start in a way that is not modelled.
   subroutine refuse_unmodelled(problem, error)
      type(problem_t), intent(in) :: problem
      type(error_t), allocatable, intent(out) :: error
      type(finding_t) :: finding

      finding = inspect_contacts(problem%model, problem%wires, problem%elements, problem%contact, problem%model%x, &
         problem%state%rotation)
      if (finding%kind == finding_none .or. finding%kind == finding_deep) return
      error = fail(exit_input, 'at the start '//finding%describe(problem%model)//'. '//finding%advice(problem%model))
   end subroutine refuse_unmodelled

   subroutine run_step(problem, step, number, overlap, continued, course, options, results, restart, error)
      type(problem_t), intent(inout) :: problem
      type(step_t), intent(in) :: step
      integer, intent(in) :: number
      !> Interference that this step resolves, one per contact pair [m]
      real(dp), intent(in) :: overlap(:)
      !> The problem stands somewhere in this step, and the course with it
      logical, intent(in) :: continued
      type(course_t), intent(inout) :: course
      type(run_options_t), intent(in) :: options
      type(results_t), intent(inout) :: results
      type(restart_file_t), intent(inout) :: restart
      type(error_t), allocatable, intent(out) :: error
      type(loading_t) :: restored
      real(dp) :: step_time
      character(len=120) :: text

      restored = problem%loading
      call begin_step(problem, step, options, error)
      if (allocated(error)) return
      if (continued) then
         problem%loading = restored
      else
         call course%control%start(step)
         problem%state%step = number
         problem%state%increment = 0
         problem%state%step_time = 0
         course%start_time = problem%state%time
      end if
      step_time = problem%state%step_time
      do while (step_time < step%total*(1 - 1.0e-9_dp))
         if (problem%state%increment >= step%max_increments) then
            write (text, '(a, i0, a, i0, a, es10.3, a, es10.3)') 'step ', number, ': the ', step%max_increments, &
               ' increments of INC= are used up at step time', step_time, ' of', step%total
            error = fail(exit_not_converged, trim(text))
            return
         end if
         call run_increment(problem, step, overlap, course%control, course%start_time, step_time, options, results, &
            error)
         if (allocated(error)) return
         if (.not. wants_restart(step, problem%state%increment, step_time)) cycle
         call restart%write(problem, course, error)
         if (allocated(error)) return
         ! a run that goes on from here has none either
         problem%has_factor = .false.
      end do
   end subroutine run_step

   !> Supports, solver and equations of the step.
   subroutine begin_step(problem, step, options, error)
      type(problem_t), intent(inout) :: problem
      type(step_t), intent(in) :: step
      type(run_options_t), intent(in) :: options
      type(error_t), allocatable, intent(out) :: error
      logical :: in_beam(problem%model%n_nodes), in_conductor(problem%model%n_nodes)
      integer, allocatable :: mechanical(:, :), electric(:)
      integer :: e, kind
      logical :: same_system

      call start_loading(step, problem%state, problem%loading)
      in_beam = .false.
      in_conductor = .false.
      do e = 1, problem%model%n_elements
         in_beam(problem%model%connectivity(:, e)) = .true.
         if (problem%elements%resistivity(e) > 0) in_conductor(problem%model%connectivity(:, e)) = .true.
      end do
      if (allocated(problem%solver)) then
         mechanical = problem%equations%mechanical
         electric = problem%equations%electric
      end if
      call number_equations(problem%loading%fixed, in_beam, in_conductor, problem%equations)
      kind = resolved_solver(merge(options%solver, step%solver, options%solver > 0))
      same_system = .false.
      if (allocated(problem%solver)) same_system = problem%solver%kind == kind .and. &
         all(mechanical == problem%equations%mechanical) .and. all(electric == problem%equations%electric)
      if (.not. same_system) then
         if (allocated(problem%solver)) deallocate (problem%solver)
         call create_solver(kind, problem%solver, error)
         if (allocated(error)) return
         problem%pattern_changed = .true.
      end if
      problem%has_factor = .false.
      problem%coupling = step%coupling
      if (problem%coupling == coupling_default) then
         problem%coupling = merge(coupling_updated, coupling_monolithic, kind == solver_block)
      end if
   end subroutine begin_step

   !> One increment with its cut-backs.
   subroutine run_increment(problem, step, overlap, control, start_time, step_time, options, results, error)
      type(problem_t), intent(inout) :: problem
      type(step_t), intent(in) :: step
      real(dp), intent(in) :: overlap(:)
      type(step_control_t), intent(inout) :: control
      real(dp), intent(in) :: start_time
      real(dp), intent(inout) :: step_time
      type(run_options_t), intent(in) :: options
      type(results_t), intent(inout) :: results
      type(error_t), allocatable, intent(out) :: error
      type(iteration_report_t) :: report
      type(outcome_t) :: outcome
      type(audit_t) :: audit
      real(dp) :: break_point, increment, target
      integer :: attempt
      logical :: possible

      report%step = problem%state%step
      report%increment = problem%state%increment + 1
      break_point = next_break_point(problem%model, step, step_time, start_time + step_time)
      attempt = 0
      do
         attempt = attempt + 1
         increment = control%propose(step_time, break_point)
         target = step_time + increment
         report%attempt = attempt
         call load_targets(problem%model, step, target, start_time + target, problem%loading)
         problem%contact%clearance = overlap*max(0.0_dp, 1 - target/step%total)
         problem%damping = damping_stiffness(problem%model, problem%elements%length, step%controls%stabilize, &
            increment/step%total)
         call solve_increment(problem, step, report, results, outcome, error)
         if (allocated(error)) return
         problem%n_iterations = problem%n_iterations + outcome%iterations
         if (outcome%converged) exit
         problem%has_factor = .false.
         call report_increment(problem, outcome, audit, attempt, increment, target, start_time, options, results, error)
         if (allocated(error)) return
         possible = control%cut(step, increment, attempt)
         if (outcome%cause == cause_lost_contact) then
            if (.not. control%refuse(outcome%finding, problem%wires%wire, target)) possible = .false.
         end if
         if (.not. possible) then
            call give_up(problem, step, outcome, step_time, increment, attempt, results, options, error)
            return
         end if
      end do
      step_time = target
      problem%n_increments = problem%n_increments + 1
      problem%state%increment = report%increment
      problem%state%iterations = outcome%iterations
      problem%state%step_time = step_time
      problem%state%time = start_time + step_time
      problem%state%time_increment = increment
      call capture_state(problem)
      audit = audit_increment(problem%model, problem%state, nodal_residual(problem), measure_scales(problem))
      problem%state%audit = [audit%force, audit%moment, audit%current, audit%power, audit%penetration]
      call problem%timing%lap(phase_update)
      if (len(audit%finding) == 0) call results%write_increment(problem%model, problem%state, .false., error)
      if (allocated(error)) return
      call add_increment_warnings(problem, outcome, audit)
      call issue_warnings(problem, results, error)
      if (allocated(error)) return
      ! its line comes last: an increment that has one is whole in all other files
      call report_increment(problem, outcome, audit, attempt, increment, step_time, start_time, options, results, error)
      if (.not. allocated(error) .and. len(audit%finding) > 0) error = audit_error(problem%state, audit)
      if (allocated(error)) return
      call problem%timing%lap(phase_output)
      call control%accept(step, step_time, outcome%factorisations)
   end subroutine run_increment

   !> End the run in words, and write down how far the iteration had come.
   subroutine give_up(problem, step, outcome, step_time, increment, attempts, results, options, error)
      type(problem_t), intent(inout) :: problem
      type(step_t), intent(in) :: step
      type(outcome_t), intent(in) :: outcome
      real(dp), intent(in) :: step_time, increment
      integer, intent(in) :: attempts
      type(results_t), intent(inout) :: results
      type(run_options_t), intent(in) :: options
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: write_error

      error = not_converged(problem, step, outcome, step_time, increment, attempts)
      if (problem%n_increments > 0) error%message = error%message//' The results hold all increments before.'
      if (outcome%cause == cause_not_finite) return
      problem%state%increment = outcome%last%increment
      problem%state%iterations = outcome%iterations
      problem%state%time = problem%state%time + increment
      problem%state%step_time = step_time + increment
      problem%state%time_increment = increment
      problem%state%audit = 0
      call results%begin_unconverged(problem%model, problem%state, write_error)
      call capture_state(problem)
      call results%write_unconverged(problem%model, problem%state, problem%warnings, write_error)
      if (allocated(write_error)) return
      error%message = error%message//' The iterate that was given up, and its contacts, are in '// &
         result_base(options)//'_unconverged*.'
   end subroutine give_up

   !> A line of the .sta file, and of the terminal.
   subroutine report_increment(problem, outcome, audit, attempt, increment, step_time, start_time, options, &
      results, error)
      type(problem_t), intent(inout) :: problem
      type(outcome_t), intent(in) :: outcome
      !> Of an accepted increment
      type(audit_t), intent(in) :: audit
      integer, intent(in) :: attempt
      real(dp), intent(in) :: increment, step_time, start_time
      type(run_options_t), intent(in) :: options
      type(results_t), intent(inout) :: results
      type(error_t), allocatable, intent(out) :: error
      type(increment_report_t) :: report
      character(len=:), allocatable :: remark
      character(len=160) :: line

      report%step = outcome%last%step
      report%increment = outcome%last%increment
      report%attempts = attempt
      report%iterations = outcome%iterations
      report%time = start_time + step_time
      report%step_time = step_time
      report%time_increment = increment
      report%residual = outcome%last%residual
      report%negative_pivots = outcome%negative_pivots
      report%contacts = outcome%last%contacts_active
      remark = remark_of(problem, outcome)
      if (outcome%converged) then
         report%audit = problem%state%audit
         if (len(audit%finding) > 0) remark = 'audit failed: '//audit%finding
      end if
      report%remark = without_last_semicolon(remark)
      if (outcome%converged .and. outcome%at_round_off) report%remark = remark//'accepted at the limit of round-off'
      call results%write_status(report, error)
      if (options%quiet) return
      call problem%progress%clear
      if (outcome%converged) problem%progress%done = report%time
      write (line, '(i5, i6, i5, i6, 2es13.5, i10, es13.5)') report%step, report%increment, attempt, &
         outcome%iterations, report%time, increment, report%contacts, sum(problem%contact%points%force)
      write (output_unit, '(a)') trim(trim(line)//'  '//without_last_semicolon(remark))
      call print_contacts(problem, outcome)
   end subroutine report_increment

   subroutine print_header(model)
      type(model_t), intent(in) :: model

      if (allocated(model%heading)) write (output_unit, '(a)') trim(model%heading)
      write (output_unit, '(a)') model%units%in_header( &
         ' step   inc  att iters     time [s]  increment [s]  contacts  sum of F [N]')
   end subroutine print_header

   subroutine print_end(problem, options)
      type(problem_t), intent(in) :: problem
      type(run_options_t), intent(in) :: options
      character(len=80) :: counts
      character(len=12) :: seconds

      write (seconds, '(f12.2)') problem%timing%total()
      write (counts, '(a, i0, a, i0, a)') 'finished: ', problem%n_increments, ' increments, ', problem%n_iterations, &
         ' iterations, '
      write (output_unit, '(a)') trim(counts)//' '//trim(adjustl(seconds))//' s, at most '// &
         memory_text(peak_memory())//' of memory; results in '//result_base(options)//'.*'
   end subroutine print_end

   !> The lines that *CONTACT PRINT asks for.
   subroutine print_contacts(problem, outcome)
      type(problem_t), intent(in) :: problem
      type(outcome_t), intent(in) :: outcome
      integer :: i

      if (.not. outcome%converged) return
      if (.not. any(problem%model%steps(problem%state%step)%requests%kind == request_contact)) return
      do i = 1, size(problem%state%contacts)
         associate (contact => problem%state%contacts(i), id => problem%model%element_id, &
            units => problem%model%units)
            write (output_unit, '(6x, a, i0, a, i0, a, i0, a, es11.4, a, es11.4, a, es11.4, a, es11.4, a)') &
               'contact ', contact%id, ' (elements ', id(contact%element_bar), ', ', id(contact%element), &
               '): gap ', contact%gap, ' '//units%label('m')//', force ', contact%force, &
               ' '//units%label('N')//', resistance ', contact%resistance, &
               ' '//units%label('ohm')//', current ', contact%current, ' '//units%label('A')
         end associate
      end do
   end subroutine print_contacts

   !> What a user should know of an increment, in words; empty when there is nothing.
   function remark_of(problem, outcome) result(remark)
      type(problem_t), intent(in) :: problem
      type(outcome_t), intent(in) :: outcome
      character(len=:), allocatable :: remark
      character(len=120) :: text
      integer :: n

      remark = ''
      if (.not. outcome%converged) then
         remark = 'cut: '//outcome%reason
         return
      end if
      if (outcome%negative_pivots > 0) remark = 'negative pivots: beyond a critical load; '
      if (any(problem%damping > 0)) then
         write (text, '(a, es9.2, a, es9.2, a)') 'stabilization has taken', problem%state%energies%stabilization, &
            ' J, the beams hold', problem%state%energies%strain, ' J;'
         remark = remark//trim(text)//' '
      end if
      n = count(problem%contact%points%closed .and. sin(problem%contact%points%kinematics%angle) < sin(shallow_angle))
      if (n > 0) then
         write (text, '(i0, a)') n, ' contacts cross at less than 10 degrees;'
         remark = remark//trim(text)//' '
      end if
   end function remark_of

   !> Remarks end in semicolons, because others may follow.
   pure function without_last_semicolon(remark) result(text)
      character(len=*), intent(in) :: remark
      character(len=:), allocatable :: text

      text = trim(remark)
      if (len(text) > 0) then
         if (text(len(text):) == ';') text = text(:len(text) - 1)
      end if
   end function without_last_semicolon

   !> Directory and stem that the result files share.
   pure function result_base(options) result(base)
      type(run_options_t), intent(in) :: options
      character(len=:), allocatable :: base

      base = deck_stem(options%deck_path)
      if (len_trim(options%output_directory) > 0) base = trim(options%output_directory)//'/'//base
   end function result_base

   !> File name without directory and ending.
   pure function deck_stem(path) result(stem)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: stem
      integer :: dot

      stem = path(index(path, '/', back=.true.) + 1:)
      dot = index(stem, '.', back=.true.)
      if (dot > 1) stem = stem(:dot - 1)
   end function deck_stem

end module litz_analysis
