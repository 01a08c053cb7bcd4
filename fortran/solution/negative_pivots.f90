!> Negative pivots of the tangent of an increment that has converged.
module litz_negative_pivots
   use litz_assembly, only: evaluate
   use litz_errors, only: error_t
   use litz_fields, only: group_mechanical
   use litz_linear_step, only: factor_tangent
   use litz_outcome, only: outcome_t
   use litz_problem, only: problem_t
   use litz_timing, only: phase_factor
   implicit none
   private
   public :: count_negative_pivots, begins_elsewhere

contains

   !> The first tangent of the next increment is not that of the state in which this one has ended, or there is none:
   !> temperatures change before motions, of which a straight wire between clamps has none.
   pure logical function begins_elsewhere(problem)
      type(problem_t), intent(in) :: problem

      begins_elsewhere = problem%scheme%is_swept .or. size(problem%elements%heated) > 0
   end function begins_elsewhere

   !> Factor the tangent of a converged iterate, which no iteration has done, for its negative pivots. A singular one
   !> tells nothing: nothing is solved with it. Where temperatures change before motions, the section forces of the
   !> tangent are those before that, and so are those that the next increment begins with.
   subroutine count_negative_pivots(problem, outcome, error)
      type(problem_t), intent(inout) :: problem
      type(outcome_t), intent(inout) :: outcome
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: singular
      integer :: i

      if (begins_elsewhere(problem)) then
         if (problem%equations%count(group_mechanical) == 0) return
         do i = 1, size(problem%terms)
            call problem%terms(i)%term%agree()
         end do
         call evaluate(problem, error)
         if (allocated(error)) return
         outcome%negative_pivots_at_start = -1
      end if
      call factor_tangent(problem, singular)
      if (.not. allocated(singular)) then
         outcome%negative_pivots = problem%scheme%negative_pivots
         outcome%only_start_factored = .false.
      end if
      call problem%timing%lap(phase_factor)
   end subroutine count_negative_pivots

end module litz_negative_pivots
