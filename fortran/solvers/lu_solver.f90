!> One matrix solved by its LU factors, which any library can do; by L D L^T where it is symmetric, if another one can.
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

   type :: lazy_factor_t
      type(scaled_factor_t) :: factor
      !> Symbolic work has been done for this pattern
      logical :: is_analysed = .false.
   end type lazy_factor_t

   !> The factorisations that can be used: of any matrix, of symmetric ones
   integer, parameter :: lu = 1, ldl = 2

   type, extends(linear_solver_t) :: lu_solver_t
      private
      type(lazy_factor_t) :: method(ldl)
      !> Symmetric matrices with fewer equations are factored as all others
      integer :: symmetric_from = 0
      !> The one of the last `factor`
      integer :: used = lu
   contains
      procedure :: analyse => lu_analyse
      procedure :: factor => lu_factor
      procedure :: solve => lu_solve
      procedure :: solve_once => lu_solve_once
      procedure :: release => lu_release
   end type lu_solver_t

contains

   !> The solver from empty factorisations of some libraries.
   subroutine create_lu_solver(backend, solver, symmetric_backend, symmetric_from)
      !> Comes back not allocated
      class(sparse_factor_t), allocatable, intent(inout) :: backend
      class(linear_solver_t), allocatable, intent(out) :: solver
      !> For symmetric matrices, if allocated; comes back not allocated
      class(sparse_factor_t), allocatable, intent(inout), optional :: symmetric_backend
      !> Number of equations from which it is used; all without it
      integer, intent(in), optional :: symmetric_from
      type(lu_solver_t), allocatable :: new

      allocate (new)
      call move_alloc(backend, new%method(lu)%factor%backend)
      if (present(symmetric_backend)) call move_alloc(symmetric_backend, new%method(ldl)%factor%backend)
      if (present(symmetric_from)) new%symmetric_from = symmetric_from
      call move_alloc(new, solver)
   end subroutine create_lu_solver

   !> Which factorisation is needed is known with the values: the symbolic work is done then, where there is a choice.
   subroutine lu_analyse(self, matrix, error)
      class(lu_solver_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error

      call self%release()
      self%method%is_analysed = .false.
      self%used = lu
      if (method_for(self, .true., matrix%n_rows) == lu) call prepare(self, matrix, error)
   end subroutine lu_analyse

   pure integer function method_for(self, symmetric, n)
      class(lu_solver_t), intent(in) :: self
      !> The matrix is
      logical, intent(in) :: symmetric
      !> Number of equations
      integer, intent(in) :: n

      method_for = merge(ldl, lu, symmetric .and. n >= self%symmetric_from .and. &
         allocated(self%method(ldl)%factor%backend))
   end function method_for

   !> Symbolic work of the factorisation that is used, unless it has been done.
   subroutine prepare(self, matrix, error)
      class(lu_solver_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error

      associate (method => self%method(self%used))
         if (method%is_analysed) return
         call method%factor%analyse(matrix, self%offset, error)
         method%is_analysed = .not. allocated(error)
      end associate
   end subroutine prepare

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
      integer :: n_counted

      self%negative_pivots = -1
      n_counted = min(self%n_counted, matrix%n_rows)
      self%used = method_for(self, symmetric .and. n_counted == matrix%n_rows, matrix%n_rows)
      call self%method(lu + ldl - self%used)%factor%release()
      call prepare(self, matrix, error)
      if (allocated(error)) return
      associate (factor => self%method(self%used)%factor)
         if (self%used == lu .and. present(row_scale) .and. present(column_scale)) then
            call factor%factor(matrix, row_scale, column_scale, error)
         else
            call equilibrate(matrix, scale)
            call factor%factor(matrix, scale, scale, error)
         end if
         self%failed_equation = factor%failed_equation
         if (allocated(error)) return
         self%negative_pivots = 0
         if (n_counted > 0) self%negative_pivots = factor%backend%negative_pivots(n_counted)
      end associate
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
      associate (factor => self%method(self%used)%factor)
         call factor%solve(b, x, error)
         self%failed_equation = factor%failed_equation
      end associate
   end subroutine lu_solve

   subroutine lu_solve_once(self, b, x, error)
      class(lu_solver_t), intent(inout) :: self
      !> Right-hand side (n)
      real(dp), intent(in) :: b(:)
      !> Nearly the solution (n); of no use after an error
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error

      call self%method(self%used)%factor%solve_once(b, x, error)
   end subroutine lu_solve_once

   subroutine lu_release(self)
      class(lu_solver_t), intent(inout) :: self
      integer :: i

      do i = 1, size(self%method)
         call self%method(i)%factor%release()
      end do
   end subroutine lu_release

end module litz_lu_solver
