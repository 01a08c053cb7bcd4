!> Groups of fields that a Newton step leaves out: when each is solved for, and whose turn it is where they act back.
!>
!> Source: theory section 13.
module litz_turns
   use litz_kinds, only: dp
   use litz_assembly, only: evaluate
   use litz_convergence, only: measure_residual, has_converged, group_converged, part_of_allowed
   use litz_errors, only: error_t
   use litz_fields, only: n_groups
   use litz_group_solution, only: has_mutual_tangent
   use litz_group_update, only: update_group
   use litz_model, only: step_t
   use litz_outcome, only: outcome_t
   use litz_problem, only: problem_t
   use litz_sweep, only: hand_over
   implicit none
   private
   public :: update_groups, evaluate_for_step

   !> Residuals over the allowed ones with which a group of a sweep has no other turn
   real(dp), parameter :: part_at_end = 0.1_dp

contains

   !> Forces and tangent for the next Newton step, of all unknowns where that is near enough to a solution. A part of a
   !> conductor without a path to a prescribed value has no potentials yet.
   subroutine evaluate_for_step(problem, error)
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable, intent(out) :: error

      problem%coupled_step = problem%scheme%is_full .and. .not. problem%is_far
      if (problem%coupled_step) call problem%iterate%warm_mechanics()
      call evaluate(problem, error)
      if (allocated(error) .or. .not. (problem%coupled_step .and. problem%is_fed)) return
      problem%is_far = .true.
      call leave_common_step(problem, error)
   end subroutine evaluate_for_step

   !> From here on the mechanics stays what it is.
   subroutine leave_common_step(problem, error)
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable, intent(out) :: error

      problem%coupled_step = .false.
      call evaluate(problem, error, motions_stand=.true.)
   end subroutine leave_common_step

   !> Groups that the Newton step leaves out, and those of which it does not have the whole tangent: each is solved for
   !> at the values of those before it, once these have converged. That is exact where the group is linear.
   subroutine update_groups(problem, step, outcome, solver_error, error)
      type(problem_t), intent(inout) :: problem
      type(step_t), intent(in) :: step
      type(outcome_t), intent(inout) :: outcome
      type(error_t), allocatable, intent(out) :: solver_error, error
      logical :: is_over
      integer :: group

      if (problem%coupled_step .and. .not. needs_turn(problem, outcome)) return
      if (problem%coupled_step) call leave_common_step(problem, error)
      if (allocated(error)) return
      do group = 2, n_groups
         if (group <= problem%scheme%n_coupled) then
            if (.not. has_mutual_tangent(problem, group)) cycle
         end if
         if (outcome%in_turn /= group) then
            if (.not. (has_converged(outcome%last, group - 1) .or. takes_over(problem, outcome, group))) return
            if (is_done(problem, outcome, group)) then
               if (mechanics_lags(problem)) call hand_over(problem, step, &
                  outcome%last, outcome%at_round_off, error)
               if (allocated(error)) return
               cycle
            end if
            if (problem%scheme%is_swept) call outcome%end_turn(group)
         end if
         call update_group(problem, group, outcome%last, solver_error, error)
         if (allocated(solver_error) .or. allocated(error)) return
         call measure_residual(problem, step, outcome%last, outcome%at_round_off)
         if (outcome%in_turn /= group) cycle
         call note_update(problem, outcome)
         is_over = group_converged(outcome%last, group) .or. (problem%scheme%is_full .and. .not. problem%is_far)
         if (.not. is_over) cycle
         call outcome%end_turn(1)
         call hand_over(problem, step, outcome%last, outcome%at_round_off, error)
         if (allocated(error)) return
      end do
   end subroutine update_groups

   !> In a sweep the mechanics does not see the present temperatures.
   logical function mechanics_lags(problem)
      type(problem_t), intent(in) :: problem

      mechanics_lags = problem%processes%any(problem%scheme%is_swept .and. problem%iterate%mechanics_lags())
   end function mechanics_lags

   !> The temperatures take their turn before the motions balance. First of all in an increment, as they follow a
   !> current that changes at once, and the motions, which take more iterations, need not be found twice; then whenever
   !> these are nearer to their balance than to what the temperatures have still to do to them.
   pure logical function takes_over(problem, outcome, group)
      type(problem_t), intent(in) :: problem
      type(outcome_t), intent(in) :: outcome
      !> One of the groups of litz_fields
      integer, intent(in) :: group

      takes_over = .false.
      if (.not. problem%scheme%is_swept .or. group_converged(outcome%last, group)) return
      takes_over = outcome%motions_have_come_far() .or. needs_turn(problem, outcome)
      if (outcome%sweeps == 0) takes_over = .not. problem%is_fed
   end function takes_over

   !> A step of motions and temperatures together has led the latter astray, as where a contact has gained most of its
   !> force, by which its conductance goes with a power: potentials and temperatures are solved for at these motions.
   pure logical function needs_turn(problem, outcome)
      type(problem_t), intent(in) :: problem
      type(outcome_t), intent(in) :: outcome

      needs_turn = problem%scheme%is_full .and. outcome%iterations > 0 .and. .not. problem%is_fed
      if (problem%coupled_step) needs_turn = needs_turn .and. outcome%is_astray
   end function needs_turn

   !> A group has nothing to do after those before it. In a sweep it has one more iteration where its residuals, which
   !> the last turn of the motions has left, are within their tolerances but not far below: those of many nodes add up.
   pure logical function is_done(problem, outcome, group)
      type(problem_t), intent(in) :: problem
      type(outcome_t), intent(in) :: outcome
      !> One of the groups of litz_fields
      integer, intent(in) :: group

      if (problem%scheme%is_swept) then
         is_done = part_of_allowed(outcome%last, group) <= part_at_end
      else
         is_done = group_converged(outcome%last, group)
      end if
   end function is_done

   !> An iteration of a group that takes its turn.
   pure subroutine note_update(problem, outcome)
      type(problem_t), intent(in) :: problem
      type(outcome_t), intent(inout) :: outcome

      outcome%iterations = outcome%iterations + 1
      outcome%factorisations = outcome%factorisations + 1
      outcome%counted = outcome%counted + 1
      outcome%last%iteration = outcome%iterations
      outcome%last%factor_age = 0
      outcome%kept_tangent = .false.
   end subroutine note_update

end module litz_turns
