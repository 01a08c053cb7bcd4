!> Prescribed values and loads over the steps of an analysis: three nodes, of which each holds another case.
program test_loading
   use litz_fields, only: n_slots, temperature_slots
   use litz_kinds, only: dp, pi
   use litz_loading, only: loading_t, start_loading, load_targets, prescribed_increment, next_break_point, &
      initial_values
   use litz_model, only: model_t, step_t, nodal_value_t, amplitude_t, dof_potential, dof_temperature
   use litz_rotations, only: identity3, rotation_exp
   use litz_state, only: state_t
   implicit none

   !> Amplitudes of the model: a triangle over the time of a step, a wave over that of the analysis
   integer, parameter :: triangle = 1, wave = 2
   !> Slot of the potential
   integer, parameter :: potential = 7, temperature = temperature_slots(1)
   real(dp), parameter :: length = 2
   integer :: failures = 0

   call a_value_ramps_from_where_the_node_is()
   call a_prescribed_value_goes_on_from_its_own()
   call a_value_that_a_step_no_longer_names_is_free()
   call a_single_angle_goes_on()
   call loads_ramp_from_what_the_step_before_left()
   call a_load_that_a_step_no_longer_names_ramps_to_zero()
   call an_amplitude_of_the_step_begins_with_each_step()
   call an_amplitude_of_the_analysis_goes_on_over_the_steps()
   call an_amplitude_stays_at_its_ends()
   call an_increment_leads_to_the_prescribed_value()
   call what_stays_prescribed_is_not_moved_by_round_off()
   call rotation_vectors_may_pass_full_turns()
   call angles_add_up()
   call the_corners_of_amplitudes_are_met()
   call an_amplitude_that_is_not_used_has_no_corners()
   call given_values_ramp_from_what_they_were()
   call a_given_value_that_no_step_names_returns_to_the_initial_one()
   call given_values_follow_amplitudes()
   if (failures > 0) error stop 1

contains

   subroutine a_value_ramps_from_where_the_node_is()
      type(state_t) :: state
      type(loading_t) :: loading
      type(step_t) :: step

      state = state_at_rest()
      state%value(3, 1) = 0.4_dp
      state%value(potential, 2) = 5
      step = new_step(boundary=[nodal_value_t(1, 3, 1.0_dp), nodal_value_t(2, dof_potential, 1.0_dp)])
      call start_loading(step, state, loading)
      call check(count(loading%fixed) == 2 .and. loading%fixed(3, 1) .and. loading%fixed(potential, 2), &
         'what the step names is prescribed, and nothing else')
      call check(near(loading%value(3, 1), 0.4_dp), 'a step begins where the node is')
      call load_targets(new_model(), step, 0.25_dp*length, 0.25_dp*length, loading)
      call check(near(loading%value(3, 1), 0.55_dp), 'a quarter of the way after a quarter of the step')
      call check(near(loading%value(potential, 2), 4.0_dp), 'voltages, too')
      call load_targets(new_model(), step, length, length, loading)
      call check(near(loading%value(3, 1), 1.0_dp) .and. near(loading%value(potential, 2), 1.0_dp), &
         'the value at the end of the step')
   end subroutine a_value_ramps_from_where_the_node_is

   !> The state has the prescribed value up to the round-off of the iteration.
   subroutine a_prescribed_value_goes_on_from_its_own()
      type(state_t) :: state
      type(loading_t) :: loading
      type(step_t) :: step

      state = state_at_rest()
      step = new_step(boundary=[nodal_value_t(1, 3, 0.1_dp)])
      call run_through(step, state, loading)
      state%value(3, 1) = 0.1_dp*(1 + 1.0e-12_dp)
      call start_loading(step, state, loading)
      call check(same(loading%start_value(3, 1), 0.1_dp), 'it starts from the very value')
      call load_targets(new_model(), step, 0.3_dp*length, 1.3_dp*length, loading)
      call check(same(loading%value(3, 1), 0.1_dp), 'what stays the same does not even change by round-off')
   end subroutine a_prescribed_value_goes_on_from_its_own

   subroutine a_value_that_a_step_no_longer_names_is_free()
      type(state_t) :: state
      type(loading_t) :: loading
      type(step_t) :: step
      real(dp) :: increment(n_slots, 3)

      state = state_at_rest()
      call run_through(new_step(boundary=[nodal_value_t(1, 3, 0.1_dp), nodal_value_t(1, 2, 0.2_dp)]), state, loading)
      state%value(3, 1) = 0.09_dp
      step = new_step(boundary=[nodal_value_t(1, 2, 0.3_dp)])
      call start_loading(step, state, loading)
      call check(same(loading%value(3, 1), 0.09_dp), 'what it was prescribed to be is forgotten')
      call check(count(loading%fixed) == 1 .and. loading%fixed(2, 1), 'only what this step names is prescribed')
      call load_targets(new_model(), step, length, 2*length, loading)
      call prescribed_increment(loading, state, increment)
      call check(same(increment(3, 1), 0.0_dp), 'the free value is left to the iteration')
      ! prescribed again, after the structure has moved it
      state%value(3, 1) = 0.07_dp
      call start_loading(new_step(boundary=[nodal_value_t(1, 3, 0.1_dp)]), state, loading)
      call check(same(loading%start_value(3, 1), 0.07_dp), 'prescribed again it ramps from where it has got to')
   end subroutine a_value_that_a_step_no_longer_names_is_free

   !> An angle about one axis is no component of the rotation vector of a node that turns about others, too.
   subroutine a_single_angle_goes_on()
      type(state_t) :: state
      type(loading_t) :: loading

      state = state_at_rest()
      call run_through(new_step(boundary=[nodal_value_t(1, 4, 7.0_dp)]), state, loading)
      state%value(4:6, 1) = [0.6_dp, 0.2_dp, -0.1_dp]
      call start_loading(new_step(boundary=[nodal_value_t(1, 4, 8.0_dp)]), state, loading)
      call check(same(loading%start_value(4, 1), 7.0_dp), 'the angle goes on')
      call start_loading(new_step(boundary=all_rotations([1.0_dp, 0.0_dp, 0.0_dp])), state, loading)
      call check(all(abs(loading%start_value(4:6, 1) - state%value(4:6, 1)) <= 0), &
         'the rotation vector starts from that of the node')
      call load_targets(new_model(), new_step(boundary=all_rotations([1.0_dp, 0.0_dp, 0.0_dp])), length, length, &
         loading)
      loading%converged_value = loading%value
      state%value(4, 1) = 0.9_dp
      call start_loading(new_step(boundary=all_rotations([2.0_dp, 0.0_dp, 0.0_dp])), state, loading)
      call check(same(loading%start_value(4, 1), 1.0_dp), 'the rotation vector goes on')
      call start_loading(new_step(boundary=[nodal_value_t(1, 4, 2.0_dp)]), state, loading)
      call check(same(loading%start_value(4, 1), 0.9_dp), 'an angle after a rotation vector starts from the state')
   end subroutine a_single_angle_goes_on

   subroutine loads_ramp_from_what_the_step_before_left()
      type(state_t) :: state
      type(loading_t) :: loading
      type(step_t) :: step

      state = state_at_rest()
      step = new_step(load=[nodal_value_t(2, 5, 8.0_dp)], current=[nodal_value_t(3, dof_potential, 2.0_dp)])
      call start_loading(step, state, loading)
      call load_targets(new_model(), step, 0.25_dp*length, 0.25_dp*length, loading)
      call check(near(loading%load(5, 2), 2.0_dp) .and. near(loading%load(potential, 3), 0.5_dp), &
         'a quarter of the loads after a quarter of the step')
      call load_targets(new_model(), step, length, length, loading)
      step = new_step(load=[nodal_value_t(2, 5, 4.0_dp)], current=[nodal_value_t(3, dof_potential, 2.0_dp)])
      call start_loading(step, state, loading)
      call load_targets(new_model(), step, 0.75_dp*length, 1.75_dp*length, loading)
      call check(near(loading%load(5, 2), 5.0_dp), 'a changed load ramps from the old one')
      call check(same(loading%load(potential, 3), 2.0_dp), 'one that stays the same stays')
      call check(.not. any(loading%fixed), 'a load prescribes nothing')
   end subroutine loads_ramp_from_what_the_step_before_left

   subroutine a_load_that_a_step_no_longer_names_ramps_to_zero()
      type(state_t) :: state
      type(loading_t) :: loading
      type(step_t) :: step

      state = state_at_rest()
      call run_through(new_step(load=[nodal_value_t(2, 5, 8.0_dp)], &
         current=[nodal_value_t(3, dof_potential, 2.0_dp)]), state, loading)
      step = new_step()
      call start_loading(step, state, loading)
      call load_targets(new_model(), step, 0.25_dp*length, 1.25_dp*length, loading)
      call check(near(loading%load(5, 2), 6.0_dp) .and. near(loading%load(potential, 3), 1.5_dp), &
         'three quarters are left after a quarter of the step')
      call load_targets(new_model(), step, length, 2*length, loading)
      call check(.not. any(abs(loading%load) > 0), 'nothing is left at its end')
      call start_loading(step, state, loading)
      call load_targets(new_model(), step, 0.5_dp*length, 2.5_dp*length, loading)
      call check(.not. any(abs(loading%load) > 0), 'nor in the step that follows')
   end subroutine a_load_that_a_step_no_longer_names_ramps_to_zero

   !> Value times factor, wherever the step began: 0 to 1 at half the step, -1 at its end.
   subroutine an_amplitude_of_the_step_begins_with_each_step()
      type(state_t) :: state
      type(loading_t) :: loading
      type(step_t) :: step
      integer :: i

      state = state_at_rest()
      state%value(3, 1) = 0.4_dp
      step = new_step(boundary=[nodal_value_t(1, 3, 3.0_dp, triangle)], load=[nodal_value_t(2, 1, 6.0_dp, triangle)])
      do i = 0, 1
         call start_loading(step, state, loading)
         call load_targets(new_model(), step, 0.25_dp*length, (i + 0.25_dp)*length, loading)
         call check(near(loading%value(3, 1), 1.5_dp) .and. near(loading%load(1, 2), 3.0_dp), 'half way up')
         call load_targets(new_model(), step, 0.75_dp*length, (i + 0.75_dp)*length, loading)
         call check(near(loading%value(3, 1), 0.0_dp) .and. near(loading%load(1, 2), 0.0_dp), 'half way down')
         call load_targets(new_model(), step, length, (i + 1)*length, loading)
         call check(near(loading%value(3, 1), -3.0_dp) .and. near(loading%load(1, 2), -6.0_dp), 'at its end')
         loading%converged_value = loading%value
      end do
   end subroutine an_amplitude_of_the_step_begins_with_each_step

   !> 0 at the beginning, 1 at 1.5 steps, 0 at 2.5 steps.
   subroutine an_amplitude_of_the_analysis_goes_on_over_the_steps()
      type(state_t) :: state
      type(loading_t) :: loading
      type(step_t) :: step

      state = state_at_rest()
      step = new_step(boundary=[nodal_value_t(1, 3, 3.0_dp, wave)], &
         current=[nodal_value_t(2, dof_potential, 6.0_dp, wave)])
      call run_through(step, state, loading)
      call check(near(loading%value(3, 1), 2.0_dp) .and. near(loading%load(potential, 2), 4.0_dp), 'after one step')
      call start_loading(step, state, loading)
      call load_targets(new_model(), step, 0.5_dp*length, 1.5_dp*length, loading)
      call check(near(loading%value(3, 1), 3.0_dp) .and. near(loading%load(potential, 2), 6.0_dp), 'at the peak')
      call load_targets(new_model(), step, 0.75_dp*length, 1.75_dp*length, loading)
      call check(near(loading%value(3, 1), 2.25_dp) .and. near(loading%load(potential, 2), 4.5_dp), 'behind it')
   end subroutine an_amplitude_of_the_analysis_goes_on_over_the_steps

   subroutine an_amplitude_stays_at_its_ends()
      type(model_t) :: model
      type(state_t) :: state
      type(loading_t) :: loading
      type(step_t) :: step

      model = new_model()
      model%amplitudes(triangle) = amplitude_t('', [0.25_dp, 0.75_dp]*length, [0.5_dp, 2.0_dp])
      state = state_at_rest()
      step = new_step(load=[nodal_value_t(2, 1, 6.0_dp, triangle)])
      call start_loading(step, state, loading)
      call load_targets(model, step, 0.1_dp*length, 0.1_dp*length, loading)
      call check(near(loading%load(1, 2), 3.0_dp), 'before its first point')
      call load_targets(model, step, length, length, loading)
      call check(near(loading%load(1, 2), 12.0_dp), 'behind its last point')
   end subroutine an_amplitude_stays_at_its_ends

   subroutine an_increment_leads_to_the_prescribed_value()
      type(state_t) :: state
      type(loading_t) :: loading
      type(step_t) :: step
      real(dp) :: increment(n_slots, 3)

      state = state_at_rest()
      step = new_step(boundary=[nodal_value_t(1, 3, 0.2_dp), nodal_value_t(2, dof_potential, 5.0_dp)])
      call start_loading(step, state, loading)
      call load_targets(new_model(), step, 0.5_dp*length, 0.5_dp*length, loading)
      call prescribed_increment(loading, state, increment)
      call check(near(increment(3, 1), 0.1_dp) .and. near(increment(potential, 2), 2.5_dp), 'half of it')
      call check(count(abs(increment) > 0) == 2, 'nothing else is moved')
      loading%converged_value = loading%value
      ! round-off of the first increment is made good in the second
      state%value(3, 1) = 0.1_dp + 1.0e-9_dp
      state%value(potential, 2) = 2.5_dp
      call load_targets(new_model(), step, length, length, loading)
      call prescribed_increment(loading, state, increment)
      call check(same(state%value(3, 1) + increment(3, 1), 0.2_dp), 'the value is met, wherever the node was')
   end subroutine an_increment_leads_to_the_prescribed_value

   subroutine what_stays_prescribed_is_not_moved_by_round_off()
      type(state_t) :: state
      type(loading_t) :: loading
      type(step_t) :: step
      real(dp) :: increment(n_slots, 3)

      state = state_at_rest()
      step = new_step(boundary=[nodal_value_t(1, 3, 0.2_dp), all_rotations([0.0_dp, 0.3_dp, 0.0_dp])])
      call run_through(step, state, loading)
      state%value(3, 1) = 0.2_dp*(1 + 1.0e-12_dp)
      state%rotation(:, :, 1) = rotation_exp([0.0_dp, 0.3_dp + 1.0e-12_dp, 0.0_dp])
      call start_loading(step, state, loading)
      call load_targets(new_model(), step, 0.5_dp*length, 1.5_dp*length, loading)
      call prescribed_increment(loading, state, increment)
      call check(.not. any(abs(increment) > 0), 'a value that is held is not taken back and forth')
   end subroutine what_stays_prescribed_is_not_moved_by_round_off

   subroutine rotation_vectors_may_pass_full_turns()
      type(state_t) :: state
      type(loading_t) :: loading
      type(step_t) :: step
      real(dp) :: increment(n_slots, 3)

      state = state_at_rest()
      step = new_step(boundary=all_rotations([4*pi, 0.0_dp, 0.0_dp]))
      call start_loading(step, state, loading)
      call load_targets(new_model(), step, length, length, loading)
      call prescribed_increment(loading, state, increment)
      call check(norm2(increment(4:6, 1) - [4*pi, 0.0_dp, 0.0_dp]) < 1.0e-12_dp, 'two turns in one increment')
      ! from a turn about x to the sum with one about y: what is between them is no difference of vectors
      loading%converged_value(4:6, 1) = [0.5_dp, 0.0_dp, 0.0_dp]
      state%rotation(:, :, 1) = rotation_exp([0.5_dp, 0.0_dp, 0.0_dp])
      loading%value(4:6, 1) = [0.5_dp, 0.4_dp, 0.0_dp]
      call prescribed_increment(loading, state, increment)
      call check(maxval(abs(matmul(rotation_exp(increment(4:6, 1)), state%rotation(:, :, 1)) &
         - rotation_exp([0.5_dp, 0.4_dp, 0.0_dp]))) < 1.0e-14_dp, 'it leads from one rotation to the other')
   end subroutine rotation_vectors_may_pass_full_turns

   subroutine angles_add_up()
      type(state_t) :: state
      type(loading_t) :: loading
      type(step_t) :: step
      real(dp) :: increment(n_slots, 3)

      state = state_at_rest()
      step = new_step(boundary=[nodal_value_t(1, 6, 8.0_dp)])
      call start_loading(step, state, loading)
      call load_targets(new_model(), step, 0.75_dp*length, 0.75_dp*length, loading)
      loading%converged_value = loading%value
      ! the rotation vector of a node that has turned by 6 about z, and about other axes besides
      state%value(4:6, 1) = [0.1_dp, 0.2_dp, -0.3_dp]
      call load_targets(new_model(), step, length, length, loading)
      call prescribed_increment(loading, state, increment)
      call check(near(increment(6, 1), 2.0_dp), 'the angle from the last increment to this one')
      call check(.not. any(abs(increment(4:5, 1)) > 0), 'the other angles are free')
   end subroutine angles_add_up

   subroutine the_corners_of_amplitudes_are_met()
      type(model_t) :: model
      type(step_t) :: step

      model = new_model()
      step = new_step(load=[nodal_value_t(2, 1, 6.0_dp, triangle)])
      call check(near(next_break_point(model, step, 0.0_dp, 0.0_dp), length/2), 'the first corner')
      call check(near(next_break_point(model, step, 0.4_dp*length, 5.4_dp*length), length/2), 'in later steps, too')
      call check(near(next_break_point(model, step, 0.5_dp*length*(1 - 1.0e-12_dp), 0.5_dp*length), length), &
         'a corner that has been met is passed, but for round-off')
      step = new_step(boundary=[nodal_value_t(1, 3, 1.0_dp, wave)])
      call check(near(next_break_point(model, step, 0.0_dp, 0.0_dp), length), 'the end of a step before the corner')
      call check(near(next_break_point(model, step, 0.25_dp*length, 1.25_dp*length), length/2), &
         'a corner in the time of the analysis, in that of the step')
      step = new_step(current=[nodal_value_t(2, dof_potential, 1.0_dp, triangle), &
         nodal_value_t(3, dof_potential, 1.0_dp, wave)])
      call check(near(next_break_point(model, step, 0.0_dp, 1.25_dp*length), 0.25_dp*length), 'the next one of several')
   end subroutine the_corners_of_amplitudes_are_met

   subroutine an_amplitude_that_is_not_used_has_no_corners()
      call check(near(next_break_point(new_model(), new_step(load=[nodal_value_t(2, 1, 6.0_dp)]), 0.0_dp, 0.0_dp), &
         length), 'the end of the step')
   end subroutine an_amplitude_that_is_not_used_has_no_corners

   !> Begin a step and converge at its end.
   subroutine run_through(step, state, loading)
      type(step_t), intent(in) :: step
      type(state_t), intent(in) :: state
      type(loading_t), intent(inout) :: loading

      call start_loading(step, state, loading)
      call load_targets(new_model(), step, length, length, loading)
      loading%converged_value = loading%value
   end subroutine run_through

   function new_model() result(model)
      type(model_t) :: model

      model%n_nodes = 3
      allocate (model%initial(2))
      model%initial = [nodal_value_t(1, dof_temperature, 20.0_dp), nodal_value_t(2, dof_temperature, 20.0_dp)]
      allocate (model%amplitudes(2), model%surfaces(0))
      model%amplitudes(triangle) = amplitude_t('', [0.0_dp, 0.5_dp, 1.0_dp]*length, [0.0_dp, 1.0_dp, -1.0_dp])
      model%amplitudes(wave) = amplitude_t('', [0.0_dp, 1.5_dp, 2.5_dp]*length, [0.0_dp, 1.0_dp, 0.0_dp], .true.)
   end function new_model

   function new_step(boundary, load, current, predefined) result(step)
      type(nodal_value_t), intent(in), optional :: boundary(:), load(:), current(:), predefined(:)
      type(step_t) :: step

      step%total = length
      allocate (step%boundary(0), step%load(0), step%predefined(0), step%heat(0), step%element_loads(0))
      if (present(boundary)) step%boundary = boundary
      if (present(load)) step%load = load
      if (present(predefined)) step%predefined = predefined
      if (present(current)) step%load = [step%load, current]
   end function new_step

   !> Where a value is an unknown none is given.
   subroutine given_values_ramp_from_what_they_were()
      type(state_t) :: state
      type(loading_t) :: loading
      type(step_t) :: step

      call begin_warm(state, loading, new_step(predefined=[nodal_value_t(1, dof_temperature, 100.0_dp)]), step)
      loading%given(temperature, 3) = .false.
      state%value(temperature, 3) = 7
      call start_loading(step, state, loading)
      call load_targets(new_model(), step, 0.25_dp*length, 0.25_dp*length, loading)
      call check(near(loading%value(temperature, 1), 40.0_dp), 'a quarter of the way from its initial value')
      call check(same(loading%value(temperature, 2), 20.0_dp), 'what no line names does not even change by round-off')
      call check(same(loading%value(temperature, 3), 7.0_dp), 'an unknown is left alone')
      call check(.not. any(loading%fixed), 'nothing is prescribed')
   end subroutine given_values_ramp_from_what_they_were

   subroutine a_given_value_that_no_step_names_returns_to_the_initial_one()
      type(state_t) :: state
      type(loading_t) :: loading
      type(step_t) :: step

      call begin_warm(state, loading, new_step(), step)
      state%value(temperature, 1) = 100
      state%value(temperature, 3) = 80
      call start_loading(step, state, loading)
      call load_targets(new_model(), step, 0.25_dp*length, 0.25_dp*length, loading)
      call check(near(loading%value(temperature, 1), 80.0_dp), 'to the initial temperature')
      call check(near(loading%value(temperature, 3), 60.0_dp), 'or to zero')
      call load_targets(new_model(), step, length, length, loading)
      call check(near(loading%value(temperature, 1), 20.0_dp), 'at the end of the step')
   end subroutine a_given_value_that_no_step_names_returns_to_the_initial_one

   subroutine given_values_follow_amplitudes()
      type(state_t) :: state
      type(loading_t) :: loading
      type(step_t) :: step

      call begin_warm(state, loading, new_step(predefined=[nodal_value_t(1, dof_temperature, 50.0_dp, triangle)]), step)
      call load_targets(new_model(), step, 0.25_dp*length, 0.25_dp*length, loading)
      call check(near(loading%value(temperature, 1), 25.0_dp), 'the amplitude is the factor of the value')
      call check(near(next_break_point(new_model(), step, 0.0_dp, 0.0_dp), length/2), 'its corner is met')
   end subroutine given_values_follow_amplitudes

   !> A step that begins at the initial temperatures, which are given at all nodes.
   subroutine begin_warm(state, loading, new, step)
      type(state_t), intent(out) :: state
      type(loading_t), intent(out) :: loading
      type(step_t), intent(in) :: new
      type(step_t), intent(out) :: step

      step = new
      state = state_at_rest()
      state%value = initial_values(new_model())
      call start_loading(step, state, loading)
      loading%given(temperature, :) = .true.
   end subroutine begin_warm

   !> The rotation vector of the first node.
   function all_rotations(vector) result(items)
      real(dp), intent(in) :: vector(3)
      type(nodal_value_t) :: items(3)
      integer :: i

      items = [(nodal_value_t(1, 3 + i, vector(i)), i=1, 3)]
   end function all_rotations

   function state_at_rest() result(state)
      type(state_t) :: state

      allocate (state%value(n_slots, 3), source=0.0_dp)
      state%rotation = spread(identity3, 3, 3)
   end function state_at_rest

   !> But for round-off.
   pure logical function near(found, expected)
      real(dp), intent(in) :: found, expected

      near = abs(found - expected) <= 4*epsilon(1.0_dp)*max(1.0_dp, abs(expected))
   end function near

   !> To the last bit.
   pure logical function same(found, expected)
      real(dp), intent(in) :: found, expected

      same = .not. abs(found - expected) > 0
   end function same

   subroutine check(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what

      if (holds) return
      failures = failures + 1
      print '(2a)', 'FAILED: ', what
   end subroutine check

end program test_loading
