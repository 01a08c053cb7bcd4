!> In which order the groups of fields are solved for, and by which matrices.
!>
!> Where a group depends on those before it only, forward substitution through the blocks below the diagonal is the
!> exact step of the whole system, and every group has a matrix and a solver of its own. A solver of unsymmetric
!> matrices that is asked for by name gets the whole system as one matrix instead.
!>
!> A Newton step is for the first `n_coupled` groups; those after them are solved for when these have converged
!> (`solve_group`). Where these act back on the first ones, all take their turns until none has anything left to do: a
!> sweep.
module litz_scheme
   use litz_kinds, only: dp
   use litz_equations, only: equations_t, system_t
   use litz_equilibration, only: equilibrate, scaled_maximum, power_of_two_below
   use litz_errors, only: error_t
   use litz_fields, only: n_groups, group_mechanical, depends_on
   use litz_linear_solver, only: linear_solver_t, csr_matrix_t
   use litz_model, only: coupling_default, coupling_updated, coupling_swept, coupling_full
   use litz_solver_factory, only: create_solver, resolved_solver
   use litz_solver_names, only: solver_default, solves_by_blocks
   use litz_sparse_pattern, only: csr_entries, csr_add_product
   implicit none
   private
   public :: scheme_t

   type :: solver_holder_t
      class(linear_solver_t), allocatable :: solver
   end type solver_holder_t

   type :: scheme_t
      !> One of the constants of litz_solver_names
      integer :: kind = solver_default
      !> Groups that are in a Newton step
      integer :: n_coupled = n_groups
      !> These are one matrix
      logical :: is_whole = .false.
      !> Groups after those act back on them, and take more than one iteration
      logical :: is_swept = .false.
      !> Near the solution these are in one Newton step with the first ones all the same
      logical :: is_full = .false.
      !> Negative pivots of the first group in the last factorisation; -1: not known
      integer :: negative_pivots = -1
      !> The last step was made with an earlier factor of the first group
      logical :: has_kept = .false.
      !> Group and equation in it that the last call failed at; 0: none is to blame
      integer :: failed_group = 0, failed_equation = 0
      type(solver_holder_t), private :: group(n_groups), whole
      !> The system as it was factored, where it is one matrix
      type(csr_matrix_t), private :: joined
   contains
      procedure :: create => scheme_create
      procedure :: is_created
      procedure :: is_same
      procedure :: analyse => scheme_analyse
      procedure :: factor => scheme_factor
      procedure :: factor_group
      procedure :: solve => scheme_solve
      procedure :: solve_system
      procedure :: solve_group
      procedure :: precondition_group
   end type scheme_t

contains

   !> Choose solver and coupling.
   subroutine scheme_create(self, kind, coupling, error)
      class(scheme_t), intent(inout) :: self
      !> One of the constants of litz_solver_names, and of the couplings of litz_model
      integer, intent(in) :: kind, coupling
      type(error_t), allocatable, intent(out) :: error
      integer :: i

      self%kind = resolved_solver(kind)
      self%n_coupled = coupled_groups(self%kind, coupling)
      self%is_swept = any(coupling == [coupling_swept, coupling_full])
      self%is_full = coupling == coupling_full
      self%is_whole = self%n_coupled > 1 .and. .not. solves_by_blocks(self%kind)
      do i = 1, n_groups
         call create_solver(kind, self%group(i)%solver, error)
         if (allocated(error)) return
      end do
      if (self%is_whole) call create_solver(kind, self%whole%solver, error)
   end subroutine scheme_create

   !> Groups in a Newton step; solvers by blocks leave all but the first one to updates by default.
   pure integer function coupled_groups(kind, coupling) result(n)
      !> Solver, and coupling of the groups: constants of the model
      integer, intent(in) :: kind, coupling
      logical :: is_updated

      is_updated = any(coupling == [coupling_updated, coupling_swept, coupling_full]) .or. &
         (coupling == coupling_default .and. solves_by_blocks(kind))
      n = merge(1, n_groups, is_updated)
   end function coupled_groups

   pure logical function is_created(self)
      class(scheme_t), intent(in) :: self

      is_created = allocated(self%group(1)%solver)
   end function is_created

   !> Solver and coupling would be the same.
   pure logical function is_same(self, kind, coupling)
      class(scheme_t), intent(in) :: self
      !> As of `create`
      integer, intent(in) :: kind, coupling

      is_same = self%is_created() .and. self%kind == resolved_solver(kind) .and. &
         self%n_coupled == coupled_groups(resolved_solver(kind), coupling) .and. &
         (self%is_swept .eqv. any(coupling == [coupling_swept, coupling_full])) .and. &
         (self%is_full .eqv. coupling == coupling_full)
   end function is_same

   !> Symbolic work; call again only when the pattern has changed.
   subroutine scheme_analyse(self, matrix, error)
      class(scheme_t), intent(inout) :: self
      type(system_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      integer :: i

      do i = 1, n_groups
         if (self%is_whole .and. i == 1) cycle
         self%group(i)%solver%offset = equations_before(matrix, i)
         call self%group(i)%solver%analyse(matrix%block(i, i), error)
         if (allocated(error)) return
      end do
      if (.not. self%is_whole) return
      call join(matrix, self%joined)
      self%whole%solver%n_counted = matrix%block(1, 1)%n_rows
      call self%whole%solver%analyse(self%joined, error)
   end subroutine scheme_analyse

   !> Numeric factorisation of what a Newton step needs.
   subroutine scheme_factor(self, matrix, error, is_near)
      class(scheme_t), intent(inout) :: self
      type(system_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      !> The last one was of a matrix near this one, whose factors may do; default: no
      logical, intent(in), optional :: is_near
      real(dp), allocatable :: row_scale(:), column_scale(:)
      integer :: i

      if (self%is_whole) then
         do i = 2, n_groups
            call self%group(i)%solver%release()
         end do
         call join(matrix, self%joined)
         call scale_groups(matrix, row_scale, column_scale)
         call self%whole%solver%factor(self%joined, matrix%symmetric(1), error, row_scale, column_scale)
         call blame_whole(self, matrix)
      else
         do i = 1, self%n_coupled
            call self%factor_group(i, matrix, error, is_near)
            if (allocated(error)) exit
         end do
      end if
      call note_pivots(self, matrix)
   end subroutine scheme_factor

   !> What the last factorisation tells about the first group.
   subroutine note_pivots(self, matrix)
      class(scheme_t), intent(inout) :: self
      type(system_t), intent(in) :: matrix

      if (self%is_whole) then
         self%has_kept = .false.
         self%negative_pivots = self%whole%solver%negative_pivots
      else
         self%has_kept = self%group(1)%solver%has_kept
         self%negative_pivots = self%group(1)%solver%negative_pivots
      end if
      if (self%negative_pivots > 0 .and. .not. (matrix%symmetric(1) .or. matrix%unsymmetric_by_friction)) then
         self%negative_pivots = -1
      end if
   end subroutine note_pivots

   !> Numeric factorisation of the block of one group with itself.
   subroutine factor_group(self, group, matrix, error, is_near)
      class(scheme_t), intent(inout) :: self
      !> One of the groups of litz_fields; not the first one where the system is one matrix
      integer, intent(in) :: group
      type(system_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      !> As of `factor`
      logical, intent(in), optional :: is_near

      if (group == group_mechanical) then
         self%group(group)%solver%may_keep = .false.
         if (present(is_near)) self%group(group)%solver%may_keep = is_near
         call self%group(group)%solver%factor(matrix%block(group, group), matrix%symmetric(group), error, &
            coupling=matrix%slip_coupling%value)
      else
         call self%group(group)%solver%factor(matrix%block(group, group), matrix%symmetric(group), error)
      end if
      call blame(self, group, self%group(group)%solver%failed_equation)
   end subroutine factor_group

   !> A Newton step: the corrections of the coupled groups, others stay.
   subroutine scheme_solve(self, matrix, equations, rhs, correction, error)
      class(scheme_t), intent(inout) :: self
      !> As of the last `factor`
      type(system_t), intent(in) :: matrix
      type(equations_t), intent(in) :: equations
      !> (n_slots, n_nodes)
      real(dp), intent(in) :: rhs(:, :)
      !> Set for the free unknowns (n_slots, n_nodes)
      real(dp), intent(inout) :: correction(:, :)
      type(error_t), allocatable, intent(out) :: error
      real(dp), allocatable :: b(:), x(:)
      integer :: i

      associate (start => [(equations_before(matrix, i), i=1, self%n_coupled + 1)])
         allocate (x(start(self%n_coupled + 1)), b(start(self%n_coupled + 1)))
         do i = 1, self%n_coupled
            b(start(i) + 1:start(i + 1)) = equations%gather(i, rhs)
         end do
         call self%solve_system(matrix, b, x, error)
         call note_pivots(self, matrix)
         if (allocated(error)) return
         do i = 1, self%n_coupled
            call equations%spread_to_nodes(i, x(start(i) + 1:start(i + 1)), correction)
         end do
      end associate
   end subroutine scheme_solve

   !> `K x = b` with all coupled groups, one after the other.
   subroutine solve_system(self, matrix, b, x, error)
      class(scheme_t), intent(inout) :: self
      !> As of the last `factor`
      type(system_t), intent(in) :: matrix
      !> Right-hand side (equations of all coupled groups)
      real(dp), intent(in) :: b(:)
      !> Solution (equations of all coupled groups)
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error
      real(dp) :: left(size(b))
      integer :: i, j

      if (self%is_whole) then
         call self%whole%solver%solve(self%joined, b, x, error)
         call blame_whole(self, matrix)
         return
      end if
      left = b
      associate (start => [(equations_before(matrix, i), i=1, n_groups + 1)])
         do i = 1, self%n_coupled
            do j = 1, i - 1
               if (.not. depends_on(i, j) .or. start(i + 1) == start(i) .or. start(j + 1) == start(j)) cycle
               call csr_add_product(matrix%block(i, j), -1.0_dp, x(start(j) + 1:start(j + 1)), &
                  left(start(i) + 1:start(i + 1)))
            end do
            call self%solve_group(i, matrix, left(start(i) + 1:start(i + 1)), x(start(i) + 1:start(i + 1)), error)
            if (allocated(error)) return
         end do
      end associate
   end subroutine solve_system

   !> `K x = b` with the block of one group with itself.
   subroutine solve_group(self, group, matrix, b, x, error)
      class(scheme_t), intent(inout) :: self
      !> One of the groups of litz_fields, which has been factored
      integer, intent(in) :: group
      type(system_t), intent(in) :: matrix
      !> Right-hand side (equations of the group)
      real(dp), intent(in) :: b(:)
      !> Solution (equations of the group)
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error

      call self%group(group)%solver%solve(matrix%block(group, group), b, x, error)
      call blame(self, group, self%group(group)%solver%failed_equation)
   end subroutine solve_group

   !> The same as a step of an iteration that corrects itself: by the factor at hand alone.
   subroutine precondition_group(self, group, b, x, error)
      class(scheme_t), intent(inout) :: self
      !> One of the groups of litz_fields, for which `solve_group` has been called since it was factored
      integer, intent(in) :: group
      !> Right-hand side (equations of the group)
      real(dp), intent(in) :: b(:)
      !> Nearly the solution (equations of the group)
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error

      if (size(b) > 0) call self%group(group)%solver%solve_once(b, x, error)
   end subroutine precondition_group

   !> Which equation the last call failed at.
   pure subroutine blame(self, group, equation)
      class(scheme_t), intent(inout) :: self
      !> Equation in the group; 0: none
      integer, intent(in) :: group, equation

      self%failed_equation = equation
      self%failed_group = merge(group, 0, equation > 0)
   end subroutine blame

   !> The same where the system is one matrix.
   pure subroutine blame_whole(self, matrix)
      class(scheme_t), intent(inout) :: self
      type(system_t), intent(in) :: matrix
      integer :: i

      call blame(self, 0, 0)
      associate (equation => self%whole%solver%failed_equation)
         if (equation == 0) return
         do i = n_groups, 1, -1
            if (equation > equations_before(matrix, i)) exit
         end do
         call blame(self, i, equation - equations_before(matrix, i))
      end associate
   end subroutine blame_whole

   !> Number of equations of the groups before this one.
   pure integer function equations_before(matrix, group) result(n)
      type(system_t), intent(in) :: matrix
      !> One of the groups of litz_fields, or one more than there are
      integer, intent(in) :: group
      integer :: i

      n = 0
      do i = 1, group - 1
         n = n + matrix%block(i, i)%n_rows
      end do
   end function equations_before

   !> One matrix of all blocks.
   pure subroutine join(matrix, joined)
      type(system_t), intent(in) :: matrix
      type(csr_matrix_t), intent(out) :: joined
      integer :: i, j, row, next, n, entries

      entries = 0
      do i = 1, n_groups
         do j = 1, i
            if (depends_on(i, j)) entries = entries + csr_entries(matrix%block(i, j))
         end do
      end do
      n = equations_before(matrix, n_groups + 1)
      joined%n_rows = n
      joined%n_columns = n
      allocate (joined%row_start(n + 1), joined%column(entries), joined%value(entries))
      next = 1
      do i = 1, n_groups
         do row = 1, matrix%block(i, i)%n_rows
            joined%row_start(equations_before(matrix, i) + row) = next
            do j = 1, i
               if (.not. depends_on(i, j) .or. matrix%block(j, j)%n_rows == 0) cycle
               call append(matrix%block(i, j), row, equations_before(matrix, j), joined, next)
            end do
         end do
      end do
      joined%row_start(n + 1) = next
   end subroutine join

   !> Row of `block` as the next entries of `joined`, its columns moved by `shift`.
   pure subroutine append(block, row, shift, joined, next)
      type(csr_matrix_t), intent(in) :: block
      !> Row of `block`
      integer, intent(in) :: row
      !> What is added to each column number
      integer, intent(in) :: shift
      type(csr_matrix_t), intent(inout) :: joined
      !> Place of the next entry in `joined`; moved past the row
      integer, intent(inout) :: next
      integer :: n

      associate (first => block%row_start(row), last => block%row_start(row + 1) - 1)
         n = last - first + 1
         joined%column(next:next + n - 1) = block%column(first:last) + shift
         joined%value(next:next + n - 1) = block%value(first:last)
      end associate
      next = next + n
   end subroutine append

   !> Each group is scaled to unit diagonal. The blocks below the diagonal are then brought to entries of one at most by
   !> the ratio of the units of force and value of their group, which changes no block on the diagonal. So pivots are
   !> found there.
   subroutine scale_groups(matrix, row_scale, column_scale)
      type(system_t), intent(in) :: matrix
      !> (equations)
      real(dp), allocatable, intent(out) :: row_scale(:), column_scale(:)
      real(dp) :: ratio(n_groups), largest
      integer :: start(n_groups + 1), i, j

      start = [(equations_before(matrix, i), i=1, n_groups + 1)]
      allocate (row_scale(start(n_groups + 1)), column_scale(start(n_groups + 1)))
      ratio = 1
      do i = 1, n_groups
         associate (scale_i => column_scale(start(i) + 1:start(i + 1)))
            call equilibrate(matrix%block(i, i), scale_i)
            row_scale(start(i) + 1:start(i + 1)) = scale_i
            do j = 1, i - 1
               if (.not. depends_on(i, j) .or. start(i + 1) == start(i) .or. start(j + 1) == start(j)) cycle
               largest = scaled_maximum(matrix%block(i, j), scale_i, row_scale(start(j) + 1:start(j + 1)))
               if (largest > 1) ratio(i) = min(ratio(i), ratio(j)*power_of_two_below(1/largest))
            end do
         end associate
      end do
      do i = 1, n_groups
         row_scale(start(i) + 1:start(i + 1)) = ratio(i)*row_scale(start(i) + 1:start(i + 1))
         column_scale(start(i) + 1:start(i + 1)) = column_scale(start(i) + 1:start(i + 1))/ratio(i)
      end do
   end subroutine scale_groups

end module litz_scheme
