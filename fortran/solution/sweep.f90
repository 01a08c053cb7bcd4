!> Motions and temperatures that take their turns: what motions see when their turn begins again.
!>
!> If temperatures follow from those that the mechanics saw as a smooth function, its fixed point is found by Aitken's
!> extrapolation of vectors: the next ones are those that the mechanics saw and a multiple of their lag. Source: U.
!> Kuettler, W. A. Wall, Comput. Mech. 43 (2008) 61-72, equation (44).
module litz_sweep
   use litz_kinds, only: dp
   use litz_assembly, only: evaluate
   use litz_convergence, only: measure_residual
   use litz_errors, only: error_t
   use litz_model, only: step_t
   use litz_problem, only: problem_t
   use litz_reports, only: iteration_report_t
   implicit none
   private
   public :: hand_over

contains

   !> The mechanics sees the present temperatures; if the residuals do not all hold with them, extrapolated ones.
   subroutine hand_over(problem, step, report, at_round_off, error)
      type(problem_t), intent(inout) :: problem
      type(step_t), intent(in) :: step
      type(iteration_report_t), intent(inout) :: report
      !> As of `measure_residual`
      logical, intent(inout) :: at_round_off
      type(error_t), allocatable, intent(out) :: error
      real(dp) :: extrapolated(problem%model%n_nodes)

      problem%coupled_step = problem%scheme%is_full .and. .not. problem%is_far
      call problem%iterate%extrapolate(extrapolated)
      call problem%iterate%warm_mechanics()
      call evaluate(problem, error)
      if (allocated(error)) return
      call measure_residual(problem, step, report, at_round_off)
      if (problem%coupled_step) return
      if (all(report%residual <= report%allowed)) return
      if (.not. problem%processes%any(any(abs(extrapolated - problem%iterate%mechanical_temperature) > 0))) return
      problem%iterate%mechanical_temperature = extrapolated
      call evaluate(problem, error)
      if (allocated(error)) return
      call measure_residual(problem, step, report, at_round_off)
   end subroutine hand_over

end module litz_sweep
