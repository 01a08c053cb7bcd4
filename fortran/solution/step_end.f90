!> When a step is over: at its end, or with END=SS as soon as nothing changes any more.
module litz_step_end
   use litz_fields, only: field_displacement, temperature_slots
   use litz_kinds, only: dp
   use litz_loading, only: amplitudes_are_over
   use litz_model, only: radius_at, step_t
   use litz_problem, only: problem_t
   use litz_stored_heat, only: changes_by_heat
   implicit none
   private
   public :: reaches_end, step_is_over, fastest_change

   integer, parameter :: slot = temperature_slots(1)
   !> Times and radii agree to this part
   real(dp), parameter :: tolerance = 1.0e-9_dp

contains

   !> No increment is left after this step time.
   pure logical function reaches_end(step, step_time)
      type(step_t), intent(in) :: step
      !> [s]
      real(dp), intent(in) :: step_time

      reaches_end = step_time >= step%total*(1 - tolerance)
   end function reaches_end

   !> The increment that has converged is the last one of the step. What amplitudes still have to bring keeps it going.
   logical function step_is_over(problem, step)
      type(problem_t), intent(in) :: problem
      type(step_t), intent(in) :: step

      associate (state => problem%state)
         step_is_over = reaches_end(step, state%step_time)
         if (step_is_over .or. .not. step%steady_rate > 0 .or. state%increment == 0) return
         if (radii_lag(problem, step)) return
         if (amplitudes_are_over(problem%model, step, state%step_time, state%time)) then
           step_is_over = fastest_change(problem) < step%steady_rate
         end if
      end associate
   end function step_is_over

   !> Rigid surfaces have not yet taken up what their radii did while motions were held.
   pure logical function radii_lag(problem, step)
      type(problem_t), intent(in) :: problem
      type(step_t), intent(in) :: step
      integer :: i

      radii_lag = .false.
      if (.not. step%solves(field_displacement)) return
      associate (radius => problem%state%surface_radius)
         radii_lag = any(abs(radius - [(radius_at(problem%model, i, problem%state%time), i=1, size(radius))]) &
            > tolerance*radius)
      end associate
   end function radii_lag

   !> Of a free temperature, the mean over the last increment [K/s]. What melts takes up heat as long as it does.
   real(dp) function fastest_change(problem)
      type(problem_t), intent(in) :: problem
      real(dp), dimension(problem%model%n_nodes, 1) :: change

      associate (state => problem%state)
         change = changes_by_heat(problem%model, problem%elements%length, reshape([state%value(slot, :), &
            state%temperature_before], [problem%model%n_nodes, 2]))
         fastest_change = problem%processes%largest(max(0.0_dp, maxval(abs(change(:, 1)), &
            problem%equations%number(slot, :) > 0)))/state%time_increment
      end associate
   end function fastest_change

end module litz_step_end
