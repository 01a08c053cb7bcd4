!> The system `[mm 0; me ee]` solved as one unsymmetric matrix; any library can do it.
module litz_monolithic
   use litz_kinds, only: dp
   use litz_errors, only: error_t
   use litz_linear_solver, only: linear_solver_t, csr_matrix_t, system_matrix_t, check_right_side
   use litz_sparse_pattern, only: csr_entries
   use litz_equilibration, only: equilibrate, scaled_maximum, power_of_two_below
   use litz_scaled_factor, only: scaled_factor_t
   use litz_sparse_factor, only: sparse_factor_t
   implicit none
   private
   public :: create_monolithic

   type, extends(linear_solver_t) :: monolithic_solver_t
      type(scaled_factor_t) :: whole, electric
      integer :: n_m = 0
   contains
      procedure :: analyse => monolithic_analyse
      procedure :: factor => monolithic_factor
      procedure :: factor_mechanical => monolithic_factor
      procedure :: factor_electric => monolithic_factor_electric
      procedure :: solve => monolithic_solve
      procedure :: solve_mechanical => monolithic_solve_mechanical
      procedure :: solve_electric => monolithic_solve_electric
   end type monolithic_solver_t

contains

   !> The solver from two empty factorisations of one library.
   subroutine create_monolithic(whole, electric, solver)
      !> Come back not allocated
      class(sparse_factor_t), allocatable, intent(inout) :: whole, electric
      class(linear_solver_t), allocatable, intent(out) :: solver
      type(monolithic_solver_t), allocatable :: monolithic

      allocate (monolithic)
      call move_alloc(whole, monolithic%whole%backend)
      call move_alloc(electric, monolithic%electric%backend)
      call move_alloc(monolithic, solver)
   end subroutine create_monolithic

   subroutine monolithic_analyse(self, matrix, error)
      class(monolithic_solver_t), intent(inout) :: self
      type(system_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      type(csr_matrix_t) :: whole

      self%n_m = matrix%mm%n_rows
      call join(matrix, whole)
      call self%whole%analyse(whole, 0, error)
      if (allocated(error)) return
      call self%electric%analyse(matrix%ee, self%n_m, error)
   end subroutine monolithic_analyse

   !> One matrix of the four blocks, mechanics first.
   pure subroutine join(matrix, whole)
      type(system_matrix_t), intent(in) :: matrix
      type(csr_matrix_t), intent(out) :: whole
      integer :: n_m, row, next, entries

      n_m = matrix%mm%n_rows
      entries = csr_entries(matrix%mm) + csr_entries(matrix%me) + csr_entries(matrix%ee)
      whole%n_rows = n_m + matrix%ee%n_rows
      whole%n_columns = whole%n_rows
      allocate (whole%row_start(whole%n_rows + 1), whole%column(entries), whole%value(entries))
      next = 1
      do row = 1, n_m
         whole%row_start(row) = next
         call append(matrix%mm, row, 0, whole, next)
      end do
      do row = 1, matrix%ee%n_rows
         whole%row_start(n_m + row) = next
         if (n_m > 0) call append(matrix%me, row, 0, whole, next)
         call append(matrix%ee, row, n_m, whole, next)
      end do
      whole%row_start(whole%n_rows + 1) = next
   end subroutine join

   !> Row of `block` as the next entries of `whole`, its columns moved by `shift`.
   pure subroutine append(block, row, shift, whole, next)
      type(csr_matrix_t), intent(in) :: block
      !> Row of `block`
      integer, intent(in) :: row
      !> What is added to each column number
      integer, intent(in) :: shift
      type(csr_matrix_t), intent(inout) :: whole
      !> Place of the next entry in `whole`; moved past the row
      integer, intent(inout) :: next
      integer :: count

      associate (first => block%row_start(row), last => block%row_start(row + 1) - 1)
         count = last - first + 1
         whole%column(next:next + count - 1) = block%column(first:last) + shift
         whole%value(next:next + count - 1) = block%value(first:last)
      end associate
      next = next + count
   end subroutine append

   subroutine monolithic_factor(self, matrix, error)
      class(monolithic_solver_t), intent(inout) :: self
      type(system_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      type(csr_matrix_t) :: whole
      real(dp), allocatable :: row_scale(:), column_scale(:)

      self%negative_pivots = -1
      call self%electric%release()
      call join(matrix, whole)
      call system_scales(matrix, row_scale, column_scale)
      call self%whole%factor(whole, row_scale, column_scale, error)
      self%failed_equation = self%whole%failed_equation
      if (allocated(error)) return
      if (matrix%mm_symmetric .and. self%n_m == 0) self%negative_pivots = 0
      if (matrix%mm_symmetric .and. self%n_m > 0) then
         if (self%whole%backend%diagonal_pivots) self%negative_pivots = count(self%whole%backend%pivot(:self%n_m) < 0)
      end if
   end subroutine monolithic_factor

   !> Each field is scaled to unit diagonal; `K_me` is then brought to entries of one at most by the ratio of the units
   !> of current and voltage, which changes neither `mm` nor `ee`. So pivots are found on the diagonal.
   subroutine system_scales(matrix, row_scale, column_scale)
      type(system_matrix_t), intent(in) :: matrix
      !> (n_m + n_e)
      real(dp), allocatable, intent(out) :: row_scale(:), column_scale(:)
      real(dp) :: scale_m(matrix%mm%n_rows), scale_e(matrix%ee%n_rows), coupling, ratio

      call equilibrate(matrix%mm, scale_m)
      call equilibrate(matrix%ee, scale_e)
      ratio = 1
      if (size(scale_m) > 0 .and. size(scale_e) > 0) then
         coupling = scaled_maximum(matrix%me, scale_e, scale_m)
         if (coupling > 1) ratio = power_of_two_below(1/coupling)
      end if
      row_scale = [scale_m, ratio*scale_e]
      column_scale = [scale_m, scale_e/ratio]
   end subroutine system_scales

   subroutine monolithic_factor_electric(self, matrix, error)
      class(monolithic_solver_t), intent(inout) :: self
      type(system_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      real(dp) :: scale(matrix%ee%n_rows)

      call equilibrate(matrix%ee, scale)
      call self%electric%factor(matrix%ee, scale, scale, error)
      self%failed_equation = 0
      if (self%electric%failed_equation > 0) self%failed_equation = self%n_m + self%electric%failed_equation
   end subroutine monolithic_factor_electric

   subroutine monolithic_solve(self, matrix, b_m, b_e, x_m, x_e, error)
      class(monolithic_solver_t), intent(inout) :: self
      type(system_matrix_t), intent(in) :: matrix
      !> Right-hand side of the mechanical block (n_m) [N, N m]
      real(dp), intent(in) :: b_m(:)
      !> Right-hand side of the electric block (n_e) [A]
      real(dp), intent(in) :: b_e(:)
      !> Solution of the mechanical block (n_m) [m, rad]
      real(dp), intent(out) :: x_m(:)
      !> Solution of the electric block (n_e) [V]
      real(dp), intent(out) :: x_e(:)
      type(error_t), allocatable, intent(out) :: error
      real(dp) :: x(size(b_m) + size(b_e))

      call check_right_side(matrix%mm, b_m, error)
      if (.not. allocated(error)) call check_right_side(matrix%ee, b_e, error)
      if (allocated(error)) return
      call self%whole%solve([b_m, b_e], x, error)
      self%failed_equation = self%whole%failed_equation
      if (allocated(error)) return
      x_m = x(:size(b_m))
      x_e = x(size(b_m) + 1:)
   end subroutine monolithic_solve

   subroutine monolithic_solve_mechanical(self, matrix, b, x, error)
      class(monolithic_solver_t), intent(inout) :: self
      type(system_matrix_t), intent(in) :: matrix
      !> Right-hand side (n_m) [N, N m]
      real(dp), intent(in) :: b(:)
      !> Solution (n_m) [m, rad]
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error
      real(dp) :: b_e(matrix%ee%n_rows), x_e(matrix%ee%n_rows)

      b_e = 0
      call self%solve(matrix, b, b_e, x, x_e, error)
   end subroutine monolithic_solve_mechanical

   subroutine monolithic_solve_electric(self, matrix, b, x, error)
      class(monolithic_solver_t), intent(inout) :: self
      type(system_matrix_t), intent(in) :: matrix
      !> Right-hand side (n_e) [A]
      real(dp), intent(in) :: b(:)
      !> Solution (n_e) [V]
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error
      real(dp) :: b_m(matrix%mm%n_rows), x_m(matrix%mm%n_rows)

      if (self%electric%factored) then
         call self%electric%solve(b, x, error)
         self%failed_equation = 0
         if (self%electric%failed_equation > 0) self%failed_equation = self%n_m + self%electric%failed_equation
      else
         b_m = 0
         call self%solve(matrix, b_m, b, x_m, x, error)
      end if
   end subroutine monolithic_solve_electric

end module litz_monolithic
