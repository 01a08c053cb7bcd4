!> Groups of fields that are solved for after those they depend on.
!>
!> Source: theory section 13, for potentials and temperatures.
module litz_group_update
   use litz_kinds, only: dp
   use litz_assembly, only: evaluate
   use litz_errors, only: error_t
   use litz_fields, only: fields, n_fields, n_slots, field_temperature, first_slot, last_slot, first_slot_of_group, &
      last_slot_of_group
   use litz_group_solution, only: solve_for_group, hold_fields
   use litz_problem, only: problem_t
   use litz_reports, only: iteration_report_t
   use litz_timing, only: phase_factor, phase_solve, phase_update
   implicit none
   private
   public :: update_group, note_distance

   !> A correction of the temperatures of no more than this part of the largest one, from absolute zero, is near enough
   !> to the solution for a Newton step of potentials and temperatures together (0.5 is not)
   real(dp), parameter :: near = 0.1_dp

contains

   !> Fields that act on each other are solved for one after the other far from the solution, where Newton's method for
   !> all of them diverges, and together near it.
   subroutine update_group(problem, group, report, solver_error, error)
      type(problem_t), intent(inout) :: problem
      !> One of the groups of litz_fields
      integer, intent(in) :: group
      type(iteration_report_t), intent(inout) :: report
      type(error_t), allocatable, intent(out) :: solver_error, error
      integer :: field

      if (problem%equations%count(group) == 0) return
      if (problem%loading%solves(field_temperature) .and. problem%is_far) then
         do field = 1, n_fields
            if (fields(field)%group /= group) cycle
            call update_fields(problem, group, field, report, solver_error, error)
            if (allocated(solver_error) .or. allocated(error)) return
         end do
      else
         call update_fields(problem, group, 0, report, solver_error, error)
      end if
      call note_distance(problem, report%correction(field_temperature))
   end subroutine update_group

   !> Whether the temperatures are far from their solution, by their correction.
   subroutine note_distance(problem, correction)
      type(problem_t), intent(inout) :: problem
      !> The largest one [K]
      real(dp), intent(in) :: correction

      associate (temperature => problem%iterate%value(first_slot(field_temperature), :))
         problem%is_far = correction > near*problem%processes%largest(maxval(abs(temperature &
            - problem%model%absolute_zero)))
      end associate
   end subroutine note_distance

   subroutine update_fields(problem, group, free, report, solver_error, error)
      type(problem_t), intent(inout) :: problem
      !> One of the groups of litz_fields, and the field in it that is not held; 0: none is
      integer, intent(in) :: group, free
      type(iteration_report_t), intent(inout) :: report
      type(error_t), allocatable, intent(out) :: solver_error, error
      real(dp), dimension(problem%equations%count(group)) :: b, x
      real(dp) :: correction(n_slots, problem%model%n_nodes)
      integer :: field, i

      b = problem%equations%gather(group, problem%loading%load - problem%forces%internal)
      if (free > 0) call hold_fields(problem, group, free, b)
      call problem%timing%lap(phase_update)
      call problem%scheme%factor_group(group, problem%matrix, solver_error)
      call problem%timing%lap(phase_factor)
      if (.not. allocated(solver_error)) call solve_for_group(problem, group, free, report%allowed, b, x, &
         solver_error)
      call problem%timing%lap(phase_solve)
      if (allocated(solver_error)) return
      correction = 0
      call problem%equations%spread_to_nodes(group, x, correction)
      call problem%iterate%constraints%carry(correction)
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%shorten(problem%domain_t, correction)
      end do
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%follow(problem%domain_t, correction)
      end do
      associate (first => first_slot_of_group(group), last => last_slot_of_group(group))
         call problem%iterate%move(problem%state, problem%model%x, correction(first:last, :), first)
      end associate
      do field = 1, n_fields
         if (fields(field)%group == group .and. (free == 0 .or. free == field)) report%correction(field) = &
            problem%processes%largest(maxval(abs(correction(first_slot(field):last_slot(field), :))))
      end do
      call evaluate(problem, error, motions_stand=.true.)
   end subroutine update_fields

end module litz_group_update
