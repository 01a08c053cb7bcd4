!> One matrix solved by its LU factors; any library can do it.
module litz_lu_solver
   use litz_kinds, only: dp
   use litz_equilibration, only: equilibrate
   use litz_errors, only: error_t
   use litz_linear_solver, only: linear_solver_t, csr_matrix_t, check_right_side
   use litz_scaled_factor, only: scaled_factor_t
   use litz_sparse_factor, only: sparse_factor_t
   implicit none
   private
   public :: create_lu_solver

   type, extends(linear_solver_t) :: lu_solver_t
      type(scaled_factor_t) :: lu
   contains
      procedure :: analyse => lu_analyse
      procedure :: factor => lu_factor
      procedure :: solve => lu_solve
      procedure :: release => lu_release
   end type lu_solver_t

contains

   !> The solver from an empty factorisation of some library.
   subroutine create_lu_solver(backend, solver)
      !> Comes back not allocated
      class(sparse_factor_t), allocatable, intent(inout) :: backend
      class(linear_solver_t), allocatable, intent(out) :: solver
      type(lu_solver_t), allocatable :: new

      allocate (new)
      call move_alloc(backend, new%lu%backend)
      call move_alloc(new, solver)
   end subroutine create_lu_solver

   subroutine lu_analyse(self, matrix, error)
      class(lu_solver_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error

      call self%lu%analyse(matrix, self%offset, error)
   end subroutine lu_analyse

   subroutine lu_factor(self, matrix, symmetric, error, row_scale, column_scale, coupling)
      class(lu_solver_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      !> Its values are symmetric, at least among the equations whose pivots are counted
      logical, intent(in) :: symmetric
      type(error_t), allocatable, intent(out) :: error
      !> Powers of two (n_rows); without them the diagonal is made about 1
      real(dp), intent(in), optional :: row_scale(:), column_scale(:)
      !> Not needed: the whole matrix is factored (entries)
      real(dp), intent(in), optional :: coupling(:)
      real(dp) :: scale(matrix%n_rows)

      self%negative_pivots = -1
      if (present(row_scale) .and. present(column_scale)) then
         call self%lu%factor(matrix, row_scale, column_scale, error)
      else
         call equilibrate(matrix, scale)
         call self%lu%factor(matrix, scale, scale, error)
      end if
      self%failed_equation = self%lu%failed_equation
      if (allocated(error) .or. .not. symmetric) return
      if (min(self%n_counted, matrix%n_rows) == 0) then
         self%negative_pivots = 0
      else if (self%lu%backend%diagonal_pivots) then
         self%negative_pivots = count(self%lu%backend%pivot(:min(self%n_counted, matrix%n_rows)) < 0)
      end if
   end subroutine lu_factor

   subroutine lu_solve(self, matrix, b, x, error)
      class(lu_solver_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      !> Right-hand side (n)
      real(dp), intent(in) :: b(:)
      !> Solution (n); of no use after an error
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error

      call check_right_side(matrix, b, error)
      if (allocated(error)) return
      call self%lu%solve(b, x, error)
      self%failed_equation = self%lu%failed_equation
   end subroutine lu_solve

   subroutine lu_release(self)
      class(lu_solver_t), intent(inout) :: self

      call self%lu%release()
   end subroutine lu_release

end module litz_lu_solver
