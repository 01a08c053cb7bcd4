!> The system at the present iterate: cells, pattern, forces and tangent of all terms.
module litz_assembly
   use litz_element_library, only: heat_elements
   use litz_equations, only: build_system
   use litz_errors, only: error_t
   use litz_fields, only: temperature_slots
   use litz_grounding, only: ground_floating_parts
   use litz_problem, only: problem_t
   use litz_timing, only: phase_assembly, phase_analyse
   implicit none
   private
   public :: evaluate, assemble

contains

   !> Forces and tangent at the present iterate.
   subroutine evaluate(problem, error, motions_stand)
      type(problem_t), intent(inout) :: problem
      !> More cells than can be counted, or input that cannot be evaluated
      type(error_t), allocatable, intent(out) :: error
      !> Since the last call only potentials, and temperatures that the mechanics does not see, have changed; absent:
      !> anything may have
      logical, intent(in), optional :: motions_stand

      problem%motions_stand = .false.
      if (present(motions_stand)) problem%motions_stand = motions_stand
      call heat_elements(problem%model, problem%iterate%value(temperature_slots(1), :), &
         problem%mechanical_temperature(), problem%elements)
      if (.not. problem%motions_stand) call locate(problem, error)
      if (allocated(error)) return
      call assemble(problem, error)
   end subroutine evaluate

   !> Forces and tangent of the cells that have been found.
   subroutine assemble(problem, error)
      type(problem_t), intent(inout) :: problem
      !> More entries than can be counted, or input that cannot be evaluated
      type(error_t), allocatable, intent(out) :: error
      integer :: i

      if (problem%processes%any(problem%pattern_changed)) call rebuild_pattern(problem, error)
      if (allocated(error)) return
      call problem%clear_system()
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%evaluate(problem%domain_t, error)
         if (allocated(error)) return
      end do
      associate (matrix => problem%matrix)
         matrix%symmetric = .not. problem%processes%any(.not. matrix%symmetric)
         matrix%unsymmetric_by_friction = problem%processes%any(matrix%unsymmetric_by_friction)
      end associate
      call ground_floating_parts(problem, error)
      call problem%timing%lap(phase_assembly)
   end subroutine assemble

   !> Find the cells of all terms.
   subroutine locate(problem, error)
      type(problem_t), intent(inout) :: problem
      !> More cells than can be counted
      type(error_t), allocatable, intent(out) :: error
      integer :: i

      do i = 1, size(problem%terms)
         call problem%terms(i)%term%locate(problem%domain_t, error)
         if (allocated(error)) return
      end do
   end subroutine locate

   !> Pattern of the system, of the elements and of what else the terms connect, and the solver's symbolic work.
   subroutine rebuild_pattern(problem, error)
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable, intent(out) :: error
      integer, allocatable :: start(:), members(:), nodes(:, :)
      integer :: i

      allocate (start(1), source=1)
      allocate (members(0))
      call append(problem%model%connectivity, start, members)
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%connect(problem%domain_t, nodes)
         call append(nodes, start, members)
      end do
      if (size(problem%iterate%bodies%dependents) > 0) call problem%iterate%bodies%extend_cliques(start, members)
      if (problem%iterate%constraints%n > 0) call problem%iterate%constraints%extend_cliques(start, members)
      call build_system(start, members, problem%equations, problem%matrix, error)
      if (allocated(error)) return
      call problem%timing%lap(phase_assembly)
      call problem%scheme%analyse(problem%matrix, error)
      call problem%timing%lap(phase_analyse)
      problem%pattern_changed = .false.
      problem%has_factor = .false.
   end subroutine rebuild_pattern

   !> Add cells of equal size to a list of groups of nodes.
   pure subroutine append(cells, start, members)
      !> (nodes of a cell, cells)
      integer, intent(in) :: cells(:, :)
      !> Where each group starts among the members, and one more (n_groups + 1); nodes of all groups
      integer, allocatable, intent(inout) :: start(:), members(:)
      integer :: i, last

      last = start(size(start))
      start = [start, [(last + i*size(cells, 1), i=1, size(cells, 2))]]
      members = [members, reshape(cells, [size(cells)])]
   end subroutine append

end module litz_assembly
