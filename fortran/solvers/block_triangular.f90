!> The solver that makes use of the zero block: `mm` and `ee` are factored apart, by Cholesky where they are positive
!> definite. Forward substitution through `me` then gives the monolithic step exactly.
module litz_block_triangular
   use litz_kinds, only: dp
   use litz_errors, only: error_t
   use litz_linear_solver, only: linear_solver_t, csr_matrix_t, system_matrix_t, check_right_side
   use litz_sparse_pattern, only: csr_add_product
   use litz_equilibration, only: equilibrate
   use litz_concus_golub_widlund, only: symmetric_part, solve_by_symmetric_part
   use litz_scaled_factor, only: scaled_factor_t
   use litz_cholmod, only: cholmod_factor_t
   use litz_umfpack, only: umfpack_factor_t
   implicit none
   private
   public :: block_solver_t

   !> One block on the diagonal: Cholesky first, of the symmetric part where the block has another; LU where that cannot
   !> be, or where the skew part is too large for it.
   type :: diagonal_block_t
      type(scaled_factor_t) :: cholesky, lu
      !> The values are symmetric
      logical :: symmetric = .true.
      !> The LU has its symbolic work done
      logical :: lu_analysed = .false.
      !> The last factorisation is the LU
      logical :: lu_used = .false.
      integer :: offset = 0
      integer :: failed_equation = 0
   contains
      procedure :: analyse => block_analyse
      procedure :: factor => block_factor
      procedure :: solve => block_solve
   end type diagonal_block_t

   type, extends(linear_solver_t) :: block_solver_t
      type(diagonal_block_t) :: mechanical, electric
   contains
      procedure :: analyse => block_solver_analyse
      procedure :: factor => block_solver_factor
      procedure :: factor_mechanical => block_solver_factor_mechanical
      procedure :: factor_electric => block_solver_factor_electric
      procedure :: solve => block_solver_solve
      procedure :: solve_mechanical => block_solver_solve_mechanical
      procedure :: solve_electric => block_solver_solve_electric
   end type block_solver_t

contains

   subroutine block_analyse(self, matrix, offset, error)
      class(diagonal_block_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      !> Number of equations before the first of this block
      integer, intent(in) :: offset
      type(error_t), allocatable, intent(out) :: error

      self%offset = offset
      self%lu_analysed = .false.
      if (.not. allocated(self%cholesky%backend)) allocate (cholmod_factor_t :: self%cholesky%backend)
      if (.not. allocated(self%lu%backend)) allocate (umfpack_factor_t :: self%lu%backend)
      call self%lu%release()
      call self%cholesky%analyse(matrix, offset, error)
   end subroutine block_analyse

   subroutine block_factor(self, matrix, symmetric, error)
      class(diagonal_block_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      !> .true.: the matrix is symmetric, and its Cholesky factor solves it exactly
      logical, intent(in) :: symmetric
      type(error_t), allocatable, intent(out) :: error

      call self%lu%release()
      self%symmetric = symmetric
      call factor_cholesky(self, matrix, error)
      self%failed_equation = self%cholesky%failed_equation
      self%lu_used = self%failed_equation > 0
      if (self%lu_used) call factor_lu(self, matrix, error)
   end subroutine block_factor

   subroutine factor_cholesky(self, matrix, error)
      class(diagonal_block_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      type(csr_matrix_t) :: part
      real(dp) :: scale(matrix%n_rows)

      if (self%symmetric) then
         call equilibrate(matrix, scale)
         call self%cholesky%factor(matrix, scale, scale, error)
      else
         call symmetric_part(matrix, part)
         call equilibrate(part, scale)
         call self%cholesky%factor(part, scale, scale, error)
      end if
   end subroutine factor_cholesky

   subroutine factor_lu(self, matrix, error)
      class(diagonal_block_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      real(dp) :: scale(matrix%n_rows)

      call self%cholesky%release()
      if (.not. self%lu_analysed) then
         call self%lu%analyse(matrix, self%offset, error)
         if (allocated(error)) return
         self%lu_analysed = .true.
      end if
      call equilibrate(matrix, scale)
      call self%lu%factor(matrix, scale, scale, error)
      self%failed_equation = self%lu%failed_equation
   end subroutine factor_lu

   subroutine block_solve(self, matrix, b, x, error)
      class(diagonal_block_t), intent(inout) :: self
      !> What was factored
      type(csr_matrix_t), intent(in) :: matrix
      !> Right-hand side (n)
      real(dp), intent(in) :: b(:)
      !> Solution (n); meaningless after an error
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error
      logical :: converged

      if (.not. (self%lu_used .or. self%symmetric)) then
         call solve_by_symmetric_part(matrix, self%cholesky, b, x, converged, error)
         self%failed_equation = self%cholesky%failed_equation
         if (allocated(error) .or. converged) return
         self%lu_used = .true.
         call factor_lu(self, matrix, error)
         if (allocated(error)) return
      end if
      if (self%lu_used) then
         call self%lu%solve(b, x, error)
         self%failed_equation = self%lu%failed_equation
      else
         call self%cholesky%solve(b, x, error)
         self%failed_equation = self%cholesky%failed_equation
      end if
   end subroutine block_solve

   subroutine block_solver_analyse(self, matrix, error)
      class(block_solver_t), intent(inout) :: self
      type(system_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error

      call self%mechanical%analyse(matrix%mm, 0, error)
      if (allocated(error)) return
      call self%electric%analyse(matrix%ee, matrix%mm%n_rows, error)
   end subroutine block_solver_analyse

   subroutine block_solver_factor(self, matrix, error)
      class(block_solver_t), intent(inout) :: self
      type(system_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error

      call self%factor_mechanical(matrix, error)
      if (allocated(error)) return
      call self%factor_electric(matrix, error)
   end subroutine block_solver_factor

   subroutine block_solver_factor_mechanical(self, matrix, error)
      class(block_solver_t), intent(inout) :: self
      type(system_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error

      self%negative_pivots = -1
      call self%mechanical%factor(matrix%mm, matrix%mm_symmetric, error)
      self%failed_equation = self%mechanical%failed_equation
      if (allocated(error)) return
      if (matrix%mm_symmetric .or. .not. self%mechanical%lu_used) call count_negative_pivots(self)
   end subroutine block_solver_factor_mechanical

   !> A failed Cholesky factor shows only that there is a negative pivot; the LU gives their number if it could keep to
   !> the diagonal. A matrix with a positive definite symmetric part has none.
   subroutine count_negative_pivots(self)
      class(block_solver_t), intent(inout) :: self

      self%negative_pivots = 0
      self%negative_pivots_exact = .true.
      if (.not. self%mechanical%lu_used) return
      self%negative_pivots_exact = self%mechanical%lu%backend%diagonal_pivots
      self%negative_pivots = 1
      if (self%negative_pivots_exact) self%negative_pivots = count(self%mechanical%lu%backend%pivot < 0)
   end subroutine count_negative_pivots

   subroutine block_solver_factor_electric(self, matrix, error)
      class(block_solver_t), intent(inout) :: self
      type(system_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error

      call self%electric%factor(matrix%ee, .true., error)
      call set_electric_failure(self)
   end subroutine block_solver_factor_electric

   subroutine block_solver_solve(self, matrix, b_m, b_e, x_m, x_e, error)
      class(block_solver_t), intent(inout) :: self
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
      real(dp) :: b(size(b_e))

      call self%solve_mechanical(matrix, b_m, x_m, error)
      if (allocated(error)) return
      b = b_e
      if (size(b_m) > 0 .and. size(b_e) > 0) call csr_add_product(matrix%me, -1.0_dp, x_m, b)
      call self%solve_electric(matrix, b, x_e, error)
   end subroutine block_solver_solve

   subroutine block_solver_solve_mechanical(self, matrix, b, x, error)
      class(block_solver_t), intent(inout) :: self
      type(system_matrix_t), intent(in) :: matrix
      !> Right-hand side (n_m) [N, N m]
      real(dp), intent(in) :: b(:)
      !> Solution (n_m) [m, rad]
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error

      call check_right_side(matrix%mm, b, error)
      if (allocated(error)) return
      call self%mechanical%solve(matrix%mm, b, x, error)
      self%failed_equation = self%mechanical%failed_equation
   end subroutine block_solver_solve_mechanical

   subroutine block_solver_solve_electric(self, matrix, b, x, error)
      class(block_solver_t), intent(inout) :: self
      type(system_matrix_t), intent(in) :: matrix
      !> Right-hand side (n_e) [A]
      real(dp), intent(in) :: b(:)
      !> Solution (n_e) [V]
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error

      call check_right_side(matrix%ee, b, error)
      if (allocated(error)) return
      call self%electric%solve(matrix%ee, b, x, error)
      call set_electric_failure(self)
   end subroutine block_solver_solve_electric

   subroutine set_electric_failure(self)
      class(block_solver_t), intent(inout) :: self

      self%failed_equation = self%electric%failed_equation
      if (self%failed_equation > 0) self%failed_equation = self%electric%offset + self%failed_equation
   end subroutine set_electric_failure

end module litz_block_triangular
