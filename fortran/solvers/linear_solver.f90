!> The one interface of all linear solvers: analyse a pattern once, factor values, solve.
module litz_linear_solver
   use litz_kinds, only: dp
   use litz_errors, only: error_t, fail, exit_internal
   use litz_solver_names, only: solver_default, solver_keyword
   implicit none
   private
   public :: linear_solver_t, csr_matrix_t, system_matrix_t, check_right_side

   !> Compressed sparse rows; columns ascending within a row, indices from 1.
   type :: csr_matrix_t
      integer :: n_rows = 0, n_columns = 0
      !> (n_rows + 1): first entry of each row, and one past the last
      integer, allocatable :: row_start(:)
      integer, allocatable :: column(:)
      real(dp), allocatable :: value(:)
   end type csr_matrix_t

   !> The semi-coupled system `[K_mm 0; K_me K_ee]` over the free unknowns, mechanics first.
   !> The upper right block is zero, so it is not there.
   type :: system_matrix_t
      !> Full patterns (both triangles), structurally symmetric
      type(csr_matrix_t) :: mm, ee
      type(csr_matrix_t) :: me
      !> The values of `mm` are symmetric
      logical :: mm_symmetric = .true.
   end type system_matrix_t

   type, abstract :: linear_solver_t
      !> One of the constants of litz_solver_names
      integer :: kind = solver_default
      !> Negative eigenvalues of a symmetric `mm`, counted by the pivots of the last `factor`; 0 where it, or the
      !> symmetric part of an unsymmetric one, is positive definite (stable equilibrium); -1: the solver does not know
      integer :: negative_pivots = -1
      !> .false.: there are at least so many
      logical :: negative_pivots_exact = .true.
      !> Equation at which the last call gave up, mechanics first, then electricity (`n_m + i`); 0: none is to blame
      integer :: failed_equation = 0
   contains
      !> Symbolic work; call again only when the pattern has changed
      procedure(analyse_interface), deferred :: analyse
      !> Numeric factorisation of the whole system
      procedure(factor_interface), deferred :: factor
      !> Numeric factorisation that `solve_mechanical` needs at least
      procedure(factor_interface), deferred :: factor_mechanical
      !> Numeric factorisation of `ee` alone, for `solve_electric`
      procedure(factor_interface), deferred :: factor_electric
      !> `[mm 0; me ee] [x_m; x_e] = [b_m; b_e]`, the monolithic step
      procedure(solve_interface), deferred :: solve
      !> `mm x = b`
      procedure(solve_part_interface), deferred :: solve_mechanical
      !> `ee x = b`
      procedure(solve_part_interface), deferred :: solve_electric
      !> What the user writes after NAME=
      procedure :: name => linear_solver_name
   end type linear_solver_t

   abstract interface
      subroutine analyse_interface(self, matrix, error)
         import :: linear_solver_t, system_matrix_t, error_t
         implicit none
         class(linear_solver_t), intent(inout) :: self
         type(system_matrix_t), intent(in) :: matrix
         type(error_t), allocatable, intent(out) :: error
      end subroutine analyse_interface
      !> A singular matrix is an error with code `exit_solver` that names the equation where it was found. One that is
      !> so only to working precision may pass here and be found by `solve`.
      subroutine factor_interface(self, matrix, error)
         import :: linear_solver_t, system_matrix_t, error_t
         implicit none
         class(linear_solver_t), intent(inout) :: self
         type(system_matrix_t), intent(in) :: matrix
         type(error_t), allocatable, intent(out) :: error
      end subroutine factor_interface
      subroutine solve_interface(self, matrix, b_m, b_e, x_m, x_e, error)
         import :: linear_solver_t, system_matrix_t, error_t, dp
         implicit none
         class(linear_solver_t), intent(inout) :: self
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
      end subroutine solve_interface
      subroutine solve_part_interface(self, matrix, b, x, error)
         import :: linear_solver_t, system_matrix_t, error_t, dp
         implicit none
         class(linear_solver_t), intent(inout) :: self
         type(system_matrix_t), intent(in) :: matrix
         !> Right-hand side of the block (n)
         real(dp), intent(in) :: b(:)
         !> Solution of the block (n); meaningless after an error
         real(dp), intent(out) :: x(:)
         type(error_t), allocatable, intent(out) :: error
      end subroutine solve_part_interface
   end interface

contains

   pure function linear_solver_name(self) result(name)
      class(linear_solver_t), intent(in) :: self
      character(len=:), allocatable :: name

      name = trim(solver_keyword(self%kind))
   end function linear_solver_name

   !> The right-hand side of a block must be as long as the block has rows.
   subroutine check_right_side(block, b, error)
      type(csr_matrix_t), intent(in) :: block
      !> Right-hand side (n)
      real(dp), intent(in) :: b(:)
      type(error_t), allocatable, intent(out) :: error
      character(len=80) :: lengths

      if (size(b) == block%n_rows) return
      write (lengths, '(i0, a, i0, a)') size(b), ' values for ', block%n_rows, ' equations'
      error = fail(exit_internal, 'linear solver: a right-hand side of '//trim(lengths))
   end subroutine check_right_side

end module litz_linear_solver
