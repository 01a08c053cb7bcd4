!> The linear step of an iteration: for the correction of all unknowns at the present tangent.
module litz_linear_step
   use litz_kinds, only: dp
   use litz_assembly, only: assemble
   use litz_convergence, only: left_before
   use litz_errors, only: error_t
   use litz_fields, only: field_displacement, n_slots, first_slot, last_slot
   use litz_full_step, only: factor_full, solve_full
   use litz_problem, only: problem_t
   use litz_timing, only: phase_factor, phase_solve, phase_update
   implicit none
   private
   public :: solve_step, repeat_step, factor_tangent

   !> Steps that an iteration repeats at most: by then few contacts change
   integer, parameter :: max_repeats = 5
   !> A step that is taken anew goes no farther than so many times what it was
   real(dp), parameter :: most_growth = 2

contains

   !> Factor and solve for the correction of all unknowns (n_slots, n_nodes), prescribed ones included.
   subroutine solve_step(problem, keep, is_near, allowed, only_change, correction, error)
      type(problem_t), intent(inout) :: problem
      !> The tangent of an earlier iteration will do
      logical, intent(in) :: keep
      !> The tangent is near the last one that was factored
      logical, intent(in) :: is_near
      !> Residuals of the fields that are allowed (n_fields)
      real(dp), intent(in) :: allowed(:)
      !> For what the increment has changed alone, without what the last one has left over
      logical, intent(in) :: only_change
      !> Linear step of all unknowns (n_slots, n_nodes)
      real(dp), intent(out) :: correction(:, :)
      type(error_t), allocatable, intent(out) :: error
      real(dp) :: rhs(n_slots, problem%model%n_nodes)

      call problem%timing%lap(phase_update)
      if (.not. keep) call factor_tangent(problem, error, is_near)
      call problem%timing%lap(phase_factor)
      if (allocated(error)) return
      correction = problem%iterate%prescribed
      associate (forces => problem%forces)
         rhs = problem%loading%load - forces%internal - forces%iteration - forces%prescribed
      end associate
      if (only_change) rhs = rhs - left_before(problem)
      if (problem%coupled_step) then
         call solve_full(problem, allowed, rhs, correction, error)
      else
         call problem%scheme%solve(problem%matrix, problem%equations, rhs, correction, error)
      end if
      problem%factor_age = merge(problem%factor_age + 1, 0, keep .or. problem%scheme%has_kept)
      call problem%iterate%carry(correction)
      call problem%timing%lap(phase_solve)
   end subroutine solve_step

   !> Take a step anew as long as it closes and opens contacts that the tangent has not supposed to: with those that it
   !> closes, where the iterate is. The first step of an increment would push wires into each other that are about to
   !> touch, as there is nothing yet that resists them. One that sets wires free is not taken anew: that is for an
   !> iteration which sees how they are then. Source: theory section 9.
   subroutine repeat_step(problem, allowed, correction, error)
      type(problem_t), intent(inout) :: problem
      !> Residuals of the fields that are allowed (n_fields)
      real(dp), intent(in) :: allowed(:)
      !> Linear step of all unknowns (n_slots, n_nodes)
      real(dp), intent(inout) :: correction(:, :)
      !> Input that cannot be evaluated
      type(error_t), allocatable, intent(out) :: error
      real(dp) :: repeated(size(correction, 1), size(correction, 2))
      type(error_t), allocatable :: singular
      logical :: has_changed
      integer :: i, n

      do n = 1, max_repeats
         has_changed = .false.
         do i = 1, size(problem%terms)
            call problem%terms(i)%term%suppose(problem%domain_t, correction, has_changed)
         end do
         if (.not. has_changed) return
         call assemble(problem, error)
         if (allocated(error)) return
         call solve_step(problem, .false., .true., allowed, .false., repeated, singular)
         if (allocated(singular)) return
         if (.not. length_of(repeated) <= most_growth*length_of(correction)) return
         correction = repeated
      end do

   contains

      !> Largest displacement of a step along an axis, at any node [m].
      real(dp) function length_of(step)
         !> (n_slots, n_nodes)
         real(dp), intent(in) :: step(:, :)

         length_of = problem%processes%largest(maxval(abs(step(first_slot(field_displacement):last_slot( &
            field_displacement), :))))
      end function length_of

   end subroutine repeat_step

   !> Factor the tangent, or make ready to solve with it by an earlier factor.
   subroutine factor_tangent(problem, error, is_near)
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable, intent(out) :: error
      !> The last one was near it; default: no
      logical, intent(in), optional :: is_near

      if (problem%coupled_step) then
         call factor_full(problem, error)
      else
         call problem%scheme%factor(problem%matrix, error, is_near)
      end if
      problem%has_factor = all(problem%matrix%symmetric) .and. .not. allocated(error)
   end subroutine factor_tangent

end module litz_linear_step
