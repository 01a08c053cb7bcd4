!> What a run leaves behind: result files, restart file, warnings, and lines on the terminal.
module litz_run_output
   use litz_errors, only: error_t, fail, exit_files
   use litz_live_progress, only: live_progress_t
   use litz_observer, only: observer_t
   use litz_output_files, only: check_writable, same_file
   use litz_problem, only: problem_t
   use litz_reports, only: iteration_report_t, increment_report_t
   use litz_restart_file, only: restart_file_t, wants_restart
   use litz_result_lock, only: lock_results, unlock_results
   use litz_results, only: results_t
   use litz_step_control, only: course_t
   use litz_terminal, only: print_header, print_increment, print_contacts, print_end
   use litz_warning_messages, only: has_new_warnings, print_new_warnings, print_warning_count
   implicit none
   private
   public :: run_output_t

   type, extends(observer_t) :: run_output_t
      !> Directory and stem that all files share
      character(len=:), allocatable :: base
      !> Nothing goes to standard output
      logical :: quiet = .false.
      type(results_t), private :: results
      type(restart_file_t), private :: restart
      type(live_progress_t), private :: progress
   contains
      procedure :: open => output_open
      procedure :: start => output_start
      procedure :: close => output_close
      procedure :: end => output_end
      procedure :: check_continued => output_check_continued
      procedure :: iteration_done => output_iteration
      procedure :: increment_accepted => output_increment
      procedure :: warnings_added => output_warnings
      procedure :: attempt_done => output_attempt
      procedure :: offer_restart => output_restart
      procedure :: begin_giving_up => output_begin_giving_up
      procedure :: given_up => output_given_up
   end type run_output_t

contains

   !> A restart file that this run continues is none that it writes itself.
   subroutine output_check_continued(self, path, error)
      class(run_output_t), intent(in) :: self
      !> Of the file that is read
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error

      if (same_file(path, restart_path(self))) error = fail(exit_files, 'the results of the run that is continued, '// &
         self%base//'.*, would be overwritten; name another directory with -o')
   end subroutine output_check_continued

   !> Begin all files; after an error they are closed.
   subroutine output_open(self, problem, error)
      class(run_output_t), intent(inout) :: self
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable, intent(inout) :: error
      type(error_t), allocatable :: close_error
      character(len=:), allocatable :: lock_warning

      call lock_results(self%base, lock_warning, error)
      if (allocated(error)) return
      if (any(problem%model%steps%restart_frequency > 0)) then
         call check_writable(restart_path(self), error)
         call self%restart%open(restart_path(self), problem, error)
      end if
      if (.not. allocated(error)) call self%results%open(problem%processes, problem%model, self%base, problem%state, &
         error)
      if (allocated(error)) then
         call self%restart%close(close_error)
         call unlock_results()
         return
      end if
      if (len(lock_warning) > 0) call problem%warnings%add('no_lock', lock_warning)
   end subroutine output_open

   !> The state that the run starts from, and what there is to warn of.
   subroutine output_start(self, problem, error)
      class(run_output_t), intent(inout) :: self
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable, intent(inout) :: error

      if (.not. self%quiet) call print_header(problem%model)
      call self%warnings_added(problem, error)
      if (.not. allocated(error)) call self%results%write_increment(problem%model, problem%state, .true., error)
      call self%progress%start(.not. self%quiet, sum(problem%model%steps%total), problem%state%time)
   end subroutine output_start

   subroutine output_iteration(self, problem, report, error)
      class(run_output_t), intent(inout) :: self
      type(problem_t), intent(in) :: problem
      type(iteration_report_t), intent(in) :: report
      type(error_t), allocatable, intent(inout) :: error

      call self%results%write_iteration(problem%model, report, error)
      call self%progress%show(report)
   end subroutine output_iteration

   subroutine output_increment(self, problem, error)
      class(run_output_t), intent(inout) :: self
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable, intent(inout) :: error

      call self%results%write_increment(problem%model, problem%state, .false., error)
   end subroutine output_increment

   !> What is new goes to the user, also of a quiet run, and into the files.
   subroutine output_warnings(self, problem, error)
      class(run_output_t), intent(inout) :: self
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable, intent(inout) :: error

      call self%results%write_warnings(problem%warnings, error)
      if (has_new_warnings(problem%warnings)) call self%progress%clear
      call print_new_warnings(problem%warnings)
   end subroutine output_warnings

   subroutine output_attempt(self, problem, report, error)
      class(run_output_t), intent(inout) :: self
      type(problem_t), intent(in) :: problem
      type(increment_report_t), intent(in) :: report
      type(error_t), allocatable, intent(inout) :: error

      call self%results%write_status(problem%model, report, error)
      if (self%quiet) return
      call self%progress%clear
      if (report%converged) self%progress%done = report%time
      call print_increment(report)
      if (report%converged) call print_contacts(problem)
   end subroutine output_attempt

   !> At every n-th increment of a step and at its last, where the deck asks for it.
   subroutine output_restart(self, problem, course, taken, error)
      class(run_output_t), intent(inout) :: self
      type(problem_t), intent(inout) :: problem
      type(course_t), intent(inout) :: course
      !> .true.: the increment was written, or an error was met on the way
      logical, intent(out) :: taken
      type(error_t), allocatable, intent(inout) :: error

      taken = wants_restart(problem%model%steps(problem%state%step), problem%state%increment, problem%state%ends_step)
      if (taken) call self%restart%write(problem, course, error)
   end subroutine output_restart

   subroutine output_begin_giving_up(self, problem, error)
      class(run_output_t), intent(inout) :: self
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable, intent(inout) :: error

      call self%results%begin_unconverged(problem%model, problem%state, error)
   end subroutine output_begin_giving_up

   subroutine output_given_up(self, problem, place, error)
      class(run_output_t), intent(inout) :: self
      type(problem_t), intent(in) :: problem
      !> Names of the files that were written, for a message
      character(len=:), allocatable, intent(out) :: place
      type(error_t), allocatable, intent(inout) :: error

      call self%results%write_unconverged(problem%model, problem%state, problem%warnings, error)
      place = self%base//'_unconverged*'
   end subroutine output_given_up

   !> Close all files, also after an error.
   subroutine output_close(self, problem, error)
      class(run_output_t), intent(inout) :: self
      type(problem_t), intent(in) :: problem
      !> That of the run, or the first one of closing
      type(error_t), allocatable, intent(inout) :: error

      call self%progress%clear
      call self%results%list_warnings(problem%warnings, error)
      call self%results%close(.not. allocated(error), error)
      call self%restart%close(error)
      call unlock_results()
      if (allocated(error) .and. self%results%leaves_older()) error%message = error%message//' The results of an'// &
         ' earlier run stay as they are; the tables of this one are '//self%base//'_unconverged.sta and .cvg.'
   end subroutine output_close

   !> The last lines.
   subroutine output_end(self, problem, finished)
      class(run_output_t), intent(in) :: self
      type(problem_t), intent(in) :: problem
      !> The run came to its end
      logical, intent(in) :: finished

      if (finished .and. .not. self%quiet) call print_end(problem, self%base)
      call print_warning_count(problem%warnings, self%base// &
         trim(merge('_unconverged.sta', '.sta            ', self%results%leaves_older())))
   end subroutine output_end

   pure function restart_path(self) result(path)
      class(run_output_t), intent(in) :: self
      character(len=:), allocatable :: path

      path = self%base//'.restart.h5'
   end function restart_path

end module litz_run_output
