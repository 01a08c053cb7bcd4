!> The converged iterate as a state: fields for the results and the start of the next increment.
module litz_capture
   use litz_communicator, only: communicator_t
   use litz_fields, only: field_displacement, field_potential, field_rotation, first_slot, last_slot, motion_slots
   use litz_grounding, only: find_connected
   use litz_kinds, only: dp
   use litz_problem, only: problem_t
   use litz_rotations, only: nearest_rotation_vector
   use litz_section_strains, only: find_section_strains
   use litz_state, only: energies_t
   implicit none
   private
   public :: capture_state

contains

   !> Take over what has converged.
   subroutine capture_state(problem)
      type(problem_t), intent(inout) :: problem
      type(energies_t) :: energies
      integer :: i, node
      logical :: connected(problem%model%n_nodes)

      ! what is there already counts once
      energies = energies_t()
      if (problem%processes%process == 1) energies = problem%state%energies
      energies%strain = 0
      energies%contact = 0
      energies%work = energies%work + work_of_increment(problem)
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%add_energies(problem%domain_t, energies)
      end do
      call sum_energies(problem%processes, energies)
      associate (state => problem%state, iterate => problem%iterate, loading => problem%loading, &
         internal => problem%forces%internal, first => first_slot(field_rotation), last => last_slot(field_rotation))
         state%energies = energies
         state%mechanical_temperature = problem%mechanical_temperature()
         state%value = iterate%value
         state%rotation = iterate%rotation
         do node = 1, problem%model%n_nodes
            state%value(first:last, node) = nearest_rotation_vector(state%rotation(:, :, node), &
               iterate%value(first:last, node))
         end do
         state%load = loading%load
         problem%left_over = loading%load - internal
         state%reaction = merge(internal - loading%load, 0.0_dp, loading%fixed)
         state%outer_force = 0
         state%surface_heat = 0
         state%line_load = 0
         loading%converged_value = loading%value
         associate (x => first_slot(field_displacement), z => last_slot(field_displacement))
            loading%largest_motion = problem%processes%largest(max(loading%largest_motion, &
               maxval(abs(loading%value(x:z, :)), mask=loading%prescribed(x:z, :))))
         end associate
         loading%converged_ramp = loading%ramp
         loading%converged_time = loading%time
         state%surface_radius = loading%surface_radius
      end associate
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%accept(problem%domain_t)
      end do
      call find_connected(problem, field_potential, connected)
      problem%state%has_potential = merge(1.0_dp, 0.0_dp, connected)
      if (problem%state%has_section_results) call find_section_strains(problem)
   end subroutine capture_state

   subroutine sum_energies(processes, energies)
      class(communicator_t), intent(in) :: processes
      type(energies_t), intent(inout) :: energies
      real(dp) :: total(7)

      total = processes%sum([energies%work, energies%strain, energies%contact, energies%friction, energies%yielding, &
         energies%stabilization, energies%thermal])
      energies = energies_t(work=total(1), strain=total(2), contact=total(3), friction=total(4), yielding=total(5), &
         stabilization=total(6), thermal=total(7))
   end subroutine sum_energies

   !> What supports and loads have done: mean force times displacement, mean moment times rotation.
   pure real(dp) function work_of_increment(problem) result(work)
      type(problem_t), intent(in) :: problem
      integer :: node
      logical :: has_local_axes(problem%model%n_nodes)
      real(dp), dimension(motion_slots(2)) :: outer_start, outer

      work = 0
      ! their work is that along the axes
      has_local_axes = .false.
      if (allocated(problem%model%local_axes)) has_local_axes(problem%model%local_axes%node) = .true.
      associate (first => motion_slots(1), last => motion_slots(2), state => problem%state, &
         loading => problem%loading, internal => problem%forces%internal)
         do node = 1, problem%model%n_nodes
            if (has_local_axes(node) .or. .not. problem%processes%owns(node)) cycle
            outer_start = state%reaction(first:last, node) + state%load(first:last, node)
            outer = merge(internal(first:last, node), loading%load(first:last, node), loading%fixed(first:last, node))
            work = work + dot_product(outer_start + outer, problem%iterate%change(first:last, node))/2
         end do
      end associate
   end function work_of_increment

end module litz_capture
