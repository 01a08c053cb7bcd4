!> Observers of a run: the iteration and the steps report to them and write nothing themselves.
module litz_observer
   use litz_errors, only: error_t
   use litz_problem, only: problem_t
   use litz_reports, only: iteration_report_t, increment_report_t
   use litz_step_control, only: course_t
   implicit none
   private
   public :: observer_t

   type, abstract :: observer_t
   contains
      procedure(on_iteration), deferred :: iteration_done
      procedure(on_problem), deferred :: increment_accepted
      procedure(on_problem), deferred :: warnings_added
      procedure(on_attempt), deferred :: attempt_done
      procedure(on_course), deferred :: offer_restart
      procedure(on_problem), deferred :: begin_giving_up
      procedure(on_iterate), deferred :: given_up
   end type observer_t

   abstract interface

      !> The residual of an iterate is known.
      subroutine on_iteration(self, problem, report, error)
         import :: observer_t, problem_t, iteration_report_t, error_t
         implicit none
         class(observer_t), intent(inout) :: self
         type(problem_t), intent(in) :: problem
         type(iteration_report_t), intent(in) :: report
         !> What ends the run, such as a full disk
         type(error_t), allocatable, intent(inout) :: error
      end subroutine on_iteration

      !> `increment_accepted`: the state is a new one, and has passed its audit. `warnings_added`: some may be new;
      !> those that have been reported are marked so. `begin_giving_up`: the iterate is about to become the state.
      subroutine on_problem(self, problem, error)
         import :: observer_t, problem_t, error_t
         implicit none
         class(observer_t), intent(inout) :: self
         type(problem_t), intent(inout) :: problem
         type(error_t), allocatable, intent(inout) :: error
      end subroutine on_problem

      !> An increment was accepted or cut. Comes last, after everything else about it has been written.
      subroutine on_attempt(self, problem, report, error)
         import :: observer_t, problem_t, increment_report_t, error_t
         implicit none
         class(observer_t), intent(inout) :: self
         type(problem_t), intent(in) :: problem
         type(increment_report_t), intent(in) :: report
         type(error_t), allocatable, intent(inout) :: error
      end subroutine on_attempt

      !> The run can be continued from here.
      subroutine on_course(self, problem, course, taken, error)
         import :: observer_t, problem_t, course_t, error_t
         implicit none
         class(observer_t), intent(inout) :: self
         !> Only read, although what writes it could also set it
         type(problem_t), intent(inout) :: problem
         type(course_t), intent(inout) :: course
         !> It was written down
         logical, intent(out) :: taken
         type(error_t), allocatable, intent(inout) :: error
      end subroutine on_course

      !> The state is the iterate at which the run gives up.
      subroutine on_iterate(self, problem, place, error)
         import :: observer_t, problem_t, error_t
         implicit none
         class(observer_t), intent(inout) :: self
         type(problem_t), intent(in) :: problem
         !> Where a user finds it; empty: nowhere
         character(len=:), allocatable, intent(out) :: place
         type(error_t), allocatable, intent(inout) :: error
      end subroutine on_iterate

   end interface

end module litz_observer
