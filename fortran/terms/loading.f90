!> Prescribed values, loads and given values as functions of time.
!>
!> Without an amplitude a value ramps over the step from what it was at the start of the step, and is there at once in a
!> step over time; what a step no longer
!> names ramps to zero (loads), to its initial value (what is given and no unknown, such as a temperature; one that an
!> earlier step has solved for stays, unless the step before gave it) or is set free (prescribed values). Source:
!> Abaqus's rules for static steps.
module litz_loading
   use litz_kinds, only: dp
   use litz_fields, only: fields, n_fields, n_slots, first_slot, last_slot, field_displacement, field_rotation, &
      field_of_dof, field_of_slot, group_mechanical, slot_of_dof
   use litz_element_loads, only: element_load_t
   use litz_model, only: model_t, step_t, nodal_value_t, element_heat_t, factor_at, radius_at, ramp_at
   use litz_rotations, only: rotation_exp, nearest_rotation_vector
   use litz_state, only: state_t
   implicit none
   private
   public :: loading_t, start_loading, load_targets, prescribed_increment, next_break_point, initial_values, heat_at, &
      element_loads_at, amplitudes_are_over, move_radii

   type :: loading_t
      !> Fields that the step solves for (n_fields)
      logical :: solves(n_fields) = .true.
      !> .true. where the step prescribes the value (n_slots, n_nodes)
      logical, allocatable :: prescribed(:, :)
      !> .true. where the value is prescribed, or held because the step does not solve for motions (n_slots, n_nodes)
      logical, allocatable :: fixed(:, :)
      !> .true. where the value is given and no unknown (n_slots, n_nodes)
      logical, allocatable :: given(:, :)
      !> .true. where what is given stays as it is, unless the step names it (n_slots, n_nodes)
      logical, allocatable :: stays(:, :)
      !> Values at the start of the step, of what is prescribed or given and of loads (n_slots, n_nodes)
      real(dp), allocatable :: start_value(:, :), start_load(:, :)
      !> Values at the time last asked for (n_slots, n_nodes) [m, rad, V, K] and [N, N m, A, W]
      real(dp), allocatable :: value(:, :), load(:, :)
      !> Values at the last converged increment (n_slots, n_nodes)
      real(dp), allocatable :: converged_value(:, :)
      !> Largest displacement that has been prescribed at a converged increment so far [m]
      real(dp) :: largest_motion = 0
      !> The part of what ramps over the step that is reached, at the time last asked for and at the last converged
      !> increment
      real(dp) :: ramp = 0, converged_ramp = 0
      !> Time since the analysis began: the time last asked for, and that of the last converged increment [s]
      real(dp) :: time = 0, converged_time = 0
      !> Radii of the rigid surfaces at the time last asked for (n_surfaces) [m]
      real(dp), allocatable :: surface_radius(:)
   contains
      procedure :: lag_left
   end type loading_t

contains

   !> Begin a step: which unknowns are prescribed, and from what value everything ramps.
   !>
   !> What was prescribed before continues from its prescribed value: a single rotation, an angle about a fixed axis,
   !> cannot be read from the state, and a value that stays the same must not even change by round-off.
   subroutine start_loading(step, state, loading)
      type(step_t), intent(in) :: step
      type(state_t), intent(in) :: state
      type(loading_t), intent(inout) :: loading
      logical, allocatable :: kept(:, :)
      integer :: i, n

      n = size(state%value, 2)
      if (.not. allocated(loading%load)) then
         allocate (loading%load(n_slots, n), source=0.0_dp)
         allocate (loading%value(n_slots, n), loading%start_value(n_slots, n), &
            loading%converged_value(n_slots, n), loading%start_load(n_slots, n))
      end if
      if (.not. allocated(loading%prescribed)) allocate (loading%prescribed(n_slots, n), source=.false.)
      if (.not. allocated(loading%given)) allocate (loading%given(n_slots, n), source=.false.)
      if (.not. allocated(loading%stays)) allocate (loading%stays(n_slots, n), source=.false.)
      loading%start_load = loading%load
      loading%start_value = state%value
      loading%converged_ramp = 0
      loading%time = state%time
      loading%converged_time = state%time
      call move_alloc(loading%prescribed, kept)
      allocate (loading%prescribed(n_slots, n), source=.false.)
      do i = 1, size(step%boundary)
         loading%prescribed(slot_of_dof(step%boundary(i)%dof), step%boundary(i)%node) = .true.
      end do
      loading%fixed = loading%prescribed
      loading%solves = step%solves
      where (spread(.not. step%solves(field_of_slot) .and. fields(field_of_slot)%group == group_mechanical, 2, n)) &
         loading%fixed = .true.
      associate (first => first_slot(field_rotation), last => last_slot(field_rotation))
         do i = 1, n
            ! a rotation vector and single angles are different things
            if (all(kept(first:last, i)) .neqv. all(loading%prescribed(first:last, i))) kept(first:last, i) = .false.
         end do
      end associate
      kept = kept .and. loading%prescribed
      where (kept) loading%start_value = loading%converged_value
      loading%value = loading%start_value
      loading%converged_value = loading%start_value
   end subroutine start_loading

   !> Values and loads at a step time.
   subroutine load_targets(model, step, step_time, total_time, loading)
      type(model_t), intent(in) :: model
      type(step_t), intent(in) :: step
      !> Time since the step began, and since the analysis began [s]
      real(dp), intent(in) :: step_time, total_time
      type(loading_t), intent(inout) :: loading
      real(dp) :: ramp
      integer :: i, slot

      ramp = ramp_at(step, step_time)
      loading%ramp = ramp
      loading%time = total_time
      call set_given_values()
      do i = 1, size(step%boundary)
         associate (item => step%boundary(i))
            if (.not. step%solves(field_of_dof(item%dof))) cycle
            slot = slot_of_dof(item%dof)
            loading%value(slot, item%node) = loading%start_value(slot, item%node)
            if (.not. item%stays) loading%value(slot, item%node) = value_at(item, loading%value(slot, item%node))
         end associate
      end do
      loading%load = (1 - ramp)*loading%start_load
      do i = 1, size(step%load)
         call set_load(step%load(i))
      end do
      do i = 1, n_slots
         if (fields(field_of_slot(i))%is_optional .and. .not. step%solves(field_of_slot(i))) loading%load(i, :) = 0
      end do

   contains

      !> What no line of this step names returns to its initial value, or stays.
      subroutine set_given_values()
         if (.not. any(loading%given)) return
         where (loading%given .and. loading%stays) loading%value = loading%start_value
         where (loading%given .and. .not. loading%stays) loading%value = loading%start_value &
            + ramp*(initial_values(model) - loading%start_value)
         do i = 1, size(step%predefined)
            associate (item => step%predefined(i))
               slot = slot_of_dof(item%dof)
               loading%value(slot, item%node) = value_at(item, loading%start_value(slot, item%node))
            end associate
         end do
      end subroutine set_given_values

      pure real(dp) function value_at(item, start) result(value)
         type(nodal_value_t), intent(in) :: item
         !> Value when the step began
         real(dp), intent(in) :: start

         if (item%amplitude == 0) then
            value = start + ramp*(item%value - start)
         else
            value = item%value*factor_at(model, item%amplitude, step_time, total_time)
         end if
      end function value_at

      subroutine set_load(item)
         type(nodal_value_t), intent(in) :: item

         slot = slot_of_dof(item%dof)
         loading%load(slot, item%node) = value_at(item, loading%start_load(slot, item%node))
      end subroutine set_load

   end subroutine load_targets

   !> Radii of the rigid surfaces at the time of the loading. They stay where the step does not solve for motions; what
   !> amplitudes have done meanwhile is taken up evenly over the next step that does.
   pure subroutine move_radii(model, step, step_time, state, loading)
      type(model_t), intent(in) :: model
      type(step_t), intent(in) :: step
      !> Since the step began [s]
      real(dp), intent(in) :: step_time
      type(state_t), intent(in) :: state
      type(loading_t), intent(inout) :: loading
      real(dp) :: left                                                    ! of the lag when the increment began
      integer :: i

      loading%surface_radius = state%surface_radius
      if (.not. step%solves(field_displacement)) return
      left = max(0.0_dp, (step%total - step_time)/(step%total - state%step_time))
      do i = 1, size(loading%surface_radius)
         loading%surface_radius(i) = radius_at(model, i, loading%time) &
            + left*(state%surface_radius(i) - radius_at(model, i, state%time))
      end do
   end subroutine move_radii

   !> How much of what strains lag behind the temperatures at the start of the increment is left at its end: where
   !> temperatures have changed while motions were held, wires take them up over the next step that moves them.
   pure real(dp) function lag_left(self)
      class(loading_t), intent(in) :: self

      lag_left = 0
      if (self%ramp < 1) lag_left = (1 - self%ramp)/(1 - self%converged_ramp)
   end function lag_left

   !> What enters and leaves the elements on their length at a step time (n_elements).
   pure function heat_at(model, step, step_time, start_time) result(heat)
      type(model_t), intent(in) :: model
      type(step_t), intent(in) :: step
      !> Time since the step began, and total time at which it began [s]
      real(dp), intent(in) :: step_time, start_time
      type(element_heat_t) :: heat(size(step%heat))
      integer :: i

      heat = step%heat
      do i = 1, size(heat)
         associate (given => step%heat(i), total_time => start_time + step_time)
            heat(i)%source_before = given%source_before*factor_at(model, given%before_amplitude, 0.0_dp, start_time)
            heat(i)%source = value_from(model, step, step_time, start_time, heat(i)%source_before, given%source, &
               given%source_amplitude)
            heat(i)%film = given%film*factor_at(model, given%film_amplitude, step_time, total_time)
            heat(i)%sink = given%sink*factor_at(model, given%sink_amplitude, step_time, total_time)
            heat(i)%surroundings = given%surroundings*factor_at(model, given%surroundings_amplitude, step_time, &
               total_time)
         end associate
      end do
   end function heat_at

   !> A value that ramps over the step from what was there before, or follows an amplitude.
   elemental real(dp) function value_from(model, step, step_time, start_time, before, value, amplitude)
      type(model_t), intent(in) :: model
      type(step_t), intent(in) :: step
      !> Time since the step began, and total time at which it began [s]
      real(dp), intent(in) :: step_time, start_time
      !> When the step begins, and at its end or where the factor is one
      real(dp), intent(in) :: before, value
      !> Index of the amplitude; 0: none
      integer, intent(in) :: amplitude

      if (amplitude > 0) then
         value_from = value*factor_at(model, amplitude, step_time, start_time + step_time)
      else
         value_from = before + ramp_at(step, step_time)*(value - before)
      end if
   end function value_from

   !> Loads on the length of elements at a step time; when the step begins they are still those before it.
   pure function element_loads_at(model, step, step_time, start_time) result(loads)
      type(model_t), intent(in) :: model
      type(step_t), intent(in) :: step
      !> Time since the step began, and total time at which it began [s]
      real(dp), intent(in) :: step_time, start_time
      type(element_load_t) :: loads(size(step%element_loads))
      integer :: i

      loads = step%element_loads
      do i = 1, size(loads)
         associate (given => step%element_loads(i))
            loads(i)%before = given%before*factor_at(model, given%before_amplitude, 0.0_dp, start_time)
            if (.not. step_time > 0) then
               loads(i)%value = loads(i)%before
            else
               loads(i)%value = value_from(model, step, step_time, start_time, loads(i)%before, given%value, &
                  given%amplitude)
            end if
         end associate
      end do
   end function element_loads_at

   !> Values before the first step (n_slots, n_nodes).
   pure function initial_values(model) result(value)
      type(model_t), intent(in) :: model
      real(dp) :: value(n_slots, model%n_nodes)
      integer :: i

      value = 0
      do i = 1, size(model%initial)
         value(slot_of_dof(model%initial(i)%dof), model%initial(i)%node) = model%initial(i)%value
      end do
   end function initial_values

   !> What the first iteration of an increment must add to each prescribed unknown (n_slots, n_nodes).
   !>
   !> Where all three rotations of a node are prescribed they are its rotation vector, which may go beyond pi; a single
   !> one is the angle about a fixed axis, added up over the increments.
   pure subroutine prescribed_increment(loading, state, increment)
      type(loading_t), intent(in) :: loading
      type(state_t), intent(in) :: state
      !> (n_slots, n_nodes) [m, rad, V]; zero where nothing is prescribed
      real(dp), intent(out) :: increment(:, :)
      integer :: node, field

      increment = 0
      do node = 1, size(increment, 2)
         do field = 1, n_fields
            associate (first => first_slot(field), last => last_slot(field))
               if (.not. any(loading%fixed(first:last, node))) cycle
               associate (target => loading%value(first:last, node), &
                  converged => loading%converged_value(first:last, node), fixed => loading%fixed(first:last, node), &
                  changed => loading%fixed(first:last, node) .and. abs(loading%value(first:last, node) &
                  - loading%converged_value(first:last, node)) > 0)
                  if (.not. fields(field)%is_rotation) then
                     where (changed) increment(first:last, node) = target - state%value(first:last, node)
                  else if (all(fixed) .and. any(changed)) then
                     increment(first:last, node) = nearest_rotation_vector(matmul(rotation_exp(target), &
                        transpose(state%rotation(:, :, node))), target - converged)
                  else
                     where (changed) increment(first:last, node) = target - converged
                  end if
               end associate
            end associate
         end do
      end do
   end subroutine prescribed_increment

   !> The first corner of an amplitude used in this step after `step_time`, or the end of the step [s of step time]:
   !> no increment passes over it, so that peaks are met.
   real(dp) function next_break_point(model, step, step_time, total_time) result(next)
      type(model_t), intent(in) :: model
      type(step_t), intent(in) :: step
      !> Time since the step began, and since the analysis began [s]
      real(dp), intent(in) :: step_time, total_time
      logical :: used(size(model%amplitudes))
      real(dp) :: shift, margin
      integer :: i, k

      used = used_amplitudes(model, step)
      next = step%total
      margin = 1.0e-9_dp*step%total
      do i = 1, size(used)
         if (.not. used(i)) cycle
         associate (amplitude => model%amplitudes(i))
            shift = merge(total_time - step_time, 0.0_dp, amplitude%total_time)
            do k = 1, size(amplitude%time)
               if (amplitude%time(k) - shift > step_time + margin) next = min(next, amplitude%time(k) - shift)
            end do
         end associate
      end do
   end function next_break_point

   !> No amplitude of the step changes anything any more.
   pure logical function amplitudes_are_over(model, step, step_time, total_time) result(are_over)
      type(model_t), intent(in) :: model
      type(step_t), intent(in) :: step
      !> Time since the step began, and since the analysis began [s]
      real(dp), intent(in) :: step_time, total_time
      logical :: used(size(model%amplitudes))
      integer :: i

      used = used_amplitudes(model, step)
      are_over = .true.
      do i = 1, size(used)
         associate (amplitude => model%amplitudes(i))
            if (used(i)) are_over = are_over .and. amplitude%time(size(amplitude%time)) &
               <= merge(total_time, step_time, amplitude%total_time) + 1.0e-9_dp*step%total
         end associate
      end do
   end function amplitudes_are_over

   !> What values, loads, forces on elements and heat of the step follow, and radii of rigid surfaces (amplitudes).
   pure function used_amplitudes(model, step) result(used)
      type(model_t), intent(in) :: model
      type(step_t), intent(in) :: step
      logical :: used(size(model%amplitudes))

      used = .false.
      call mark(step%boundary)
      call mark(step%load)
      call mark(step%predefined)
      if (step%solves(field_displacement)) call mark_amplitudes(model%surfaces%radius_amplitude)
      associate (heat => step%heat)
         call mark_amplitudes([heat%source_amplitude, heat%film_amplitude, heat%sink_amplitude, &
            heat%surroundings_amplitude])
      end associate
      call mark_amplitudes(step%element_loads%amplitude)

   contains

      pure subroutine mark(items)
         type(nodal_value_t), intent(in) :: items(:)

         call mark_amplitudes(items%amplitude)
      end subroutine mark

      pure subroutine mark_amplitudes(amplitude)
         !> Indices of amplitudes; 0: none (n)
         integer, intent(in) :: amplitude(:)
         integer :: j

         do j = 1, size(amplitude)
            if (amplitude(j) > 0) used(amplitude(j)) = .true.
         end do
      end subroutine mark_amplitudes

   end function used_amplitudes

end module litz_loading
