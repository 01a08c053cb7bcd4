!> The one interface of all linear solvers: analyse a pattern once, factor values, solve.
module litz_linear_solver
   use litz_kinds, only: dp
   use litz_errors, only: error_t, fail, exit_internal
   use litz_solver_names, only: solver_default, solver_keyword
   implicit none
   private
   public :: linear_solver_t, csr_matrix_t, check_right_side

   !> Compressed sparse rows; columns ascending within a row, indices from 1.
   type :: csr_matrix_t
      integer :: n_rows = 0, n_columns = 0
      !> (n_rows + 1): first entry of each row, and one past the last
      integer, allocatable :: row_start(:)
      integer, allocatable :: column(:)
      real(dp), allocatable :: value(:)
   end type csr_matrix_t

   type, abstract :: linear_solver_t
      !> One of the constants of litz_solver_names
      integer :: kind = solver_default
      !> Number of equations before the first of this matrix, for messages
      integer :: offset = 0
      !> Pivots are counted in so many first equations only
      integer :: n_counted = huge(1)
      !> The matrix of the next `factor` is near the last one: a solver may keep the factor that it has, and iterate
      logical :: may_keep = .false.
      !> It has done so: nothing is known of the pivots of this matrix
      logical :: has_kept = .false.
      !> Negative eigenvalues of a symmetric matrix, counted by the pivots of the last `factor`; 0 where it, or the
      !> symmetric part of an unsymmetric one, is positive definite (stable equilibrium); -1: the solver cannot tell
      integer :: negative_pivots = -1
      !> .false.: there are at least so many
      logical :: negative_pivots_exact = .true.
      !> Equation at which the last call gave up; 0: none is to blame
      integer :: failed_equation = 0
   contains
      !> Symbolic work; call again only when the pattern has changed
      procedure(analyse_interface), deferred :: analyse
      !> Numeric factorisation
      procedure(factor_interface), deferred :: factor
      !> `A x = b`
      procedure(solve_interface), deferred :: solve
      !> The same by the factor at hand alone, for an iteration that corrects itself; `solve` has been called before
      procedure(solve_once_interface), deferred :: solve_once
      !> Give back the memory of the last `factor`, keep the symbolic work
      procedure(release_interface), deferred :: release
      !> What the user writes after NAME=
      procedure :: name => linear_solver_name
   end type linear_solver_t

   abstract interface
      subroutine analyse_interface(self, matrix, error)
         import :: linear_solver_t, csr_matrix_t, error_t
         implicit none
         class(linear_solver_t), intent(inout) :: self
         !> Full pattern (both triangles), structurally symmetric but for blocks that are zero
         type(csr_matrix_t), intent(in) :: matrix
         type(error_t), allocatable, intent(out) :: error
      end subroutine analyse_interface
      !> A singular matrix is an error with code `exit_solver` that names the equation where it was found. One that is
      !> so only to working precision may pass here and be found by `solve`.
      subroutine factor_interface(self, matrix, symmetric, error, row_scale, column_scale, coupling)
         import :: linear_solver_t, csr_matrix_t, error_t, dp
         implicit none
         class(linear_solver_t), intent(inout) :: self
         type(csr_matrix_t), intent(in) :: matrix
         !> Its values are symmetric, at least among the equations whose pivots are counted
         logical, intent(in) :: symmetric
         type(error_t), allocatable, intent(out) :: error
         !> Powers of two that make the entries comparable (n_rows); without them the diagonal is made about 1
         real(dp), intent(in), optional :: row_scale(:), column_scale(:)
         !> A part of the matrix without which it is nearly symmetric (entries): a solver may factor the rest alone, and
         !> iterate
         real(dp), intent(in), optional :: coupling(:)
      end subroutine factor_interface
      subroutine solve_interface(self, matrix, b, x, error)
         import :: linear_solver_t, csr_matrix_t, error_t, dp
         implicit none
         class(linear_solver_t), intent(inout) :: self
         !> What was factored
         type(csr_matrix_t), intent(in) :: matrix
         !> Right-hand side (n)
         real(dp), intent(in) :: b(:)
         !> Solution (n); of no use after an error
         real(dp), intent(out) :: x(:)
         type(error_t), allocatable, intent(out) :: error
      end subroutine solve_interface
      subroutine solve_once_interface(self, b, x, error)
         import :: linear_solver_t, error_t, dp
         implicit none
         class(linear_solver_t), intent(inout) :: self
         !> Right-hand side (n)
         real(dp), intent(in) :: b(:)
         !> Nearly the solution (n); of no use after an error
         real(dp), intent(out) :: x(:)
         type(error_t), allocatable, intent(out) :: error
      end subroutine solve_once_interface
      subroutine release_interface(self)
         import :: linear_solver_t
         implicit none
         class(linear_solver_t), intent(inout) :: self
      end subroutine release_interface
   end interface

contains

   pure function linear_solver_name(self) result(name)
      class(linear_solver_t), intent(in) :: self
      character(len=:), allocatable :: name

      name = trim(solver_keyword(self%kind))
   end function linear_solver_name

   !> The right-hand side must be as long as the matrix has rows.
   subroutine check_right_side(matrix, b, error)
      type(csr_matrix_t), intent(in) :: matrix
      !> Right-hand side (n)
      real(dp), intent(in) :: b(:)
      type(error_t), allocatable, intent(out) :: error
      character(len=80) :: lengths

      if (size(b) == matrix%n_rows) return
      write (lengths, '(i0, a, i0, a)') size(b), ' values for ', matrix%n_rows, ' equations'
      error = fail(exit_internal, 'linear solver: a right-hand side of '//trim(lengths))
   end subroutine check_right_side

end module litz_linear_solver
