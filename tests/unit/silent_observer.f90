!> Someone who is told of a run and does nothing about it.
module silent_observer
   use litz_errors, only: error_t
   use litz_observer, only: observer_t
   use litz_problem, only: problem_t
   use litz_reports, only: iteration_report_t, increment_report_t
   use litz_step_control, only: course_t
   implicit none
   private
   public :: silent_t

   type, extends(observer_t) :: silent_t
   contains
      procedure :: iteration_done => ignore_iteration
      procedure :: increment_accepted => ignore_problem
      procedure :: warnings_added => ignore_problem
      procedure :: attempt_done => ignore_attempt
      procedure :: offer_restart => ignore_course
      procedure :: begin_giving_up => ignore_problem
      procedure :: given_up => ignore_iterate
   end type silent_t

contains

   subroutine ignore_iteration(self, problem, report, error)
      class(silent_t), intent(inout) :: self
      type(problem_t), intent(in) :: problem
      type(iteration_report_t), intent(in) :: report
      type(error_t), allocatable, intent(inout) :: error
   end subroutine ignore_iteration

   subroutine ignore_problem(self, problem, error)
      class(silent_t), intent(inout) :: self
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable, intent(inout) :: error
   end subroutine ignore_problem

   subroutine ignore_attempt(self, problem, report, error)
      class(silent_t), intent(inout) :: self
      type(problem_t), intent(in) :: problem
      type(increment_report_t), intent(in) :: report
      type(error_t), allocatable, intent(inout) :: error
   end subroutine ignore_attempt

   subroutine ignore_course(self, problem, course, taken, error)
      class(silent_t), intent(inout) :: self
      type(problem_t), intent(inout) :: problem
      type(course_t), intent(inout) :: course
      logical, intent(out) :: taken
      type(error_t), allocatable, intent(inout) :: error

      taken = .false.
   end subroutine ignore_course

   subroutine ignore_iterate(self, problem, place, error)
      class(silent_t), intent(inout) :: self
      type(problem_t), intent(in) :: problem
      character(len=:), allocatable, intent(out) :: place
      type(error_t), allocatable, intent(inout) :: error

      place = ''
   end subroutine ignore_iterate

end module silent_observer
