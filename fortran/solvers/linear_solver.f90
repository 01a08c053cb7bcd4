!> The one interface of all linear solvers: analyse a pattern once, factor values, solve.
module litz_linear_solver
   use litz_kinds, only: dp
   use litz_errors, only: error_t
   implicit none
   private
   public :: linear_solver_t, csr_matrix_t, system_matrix_t

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
      !> Negative pivots met in the last factorisation of `mm`; -1: the solver cannot tell
      integer :: negative_pivots = -1
   contains
      !> Symbolic work; call again only when the pattern has changed
      procedure(analyse_interface), deferred :: analyse
      !> Numeric factorisation of the whole system
      procedure(factor_interface), deferred :: factor
      !> Numeric factorisation of `ee` alone, for `solve_electric`
      procedure(factor_interface), deferred :: factor_electric
      !> `[mm 0; me ee] [x_m; x_e] = [b_m; b_e]`, the monolithic step
      procedure(solve_interface), deferred :: solve
      !> `mm x = b`
      procedure(solve_part_interface), deferred :: solve_mechanical
      !> `ee x = b`
      procedure(solve_part_interface), deferred :: solve_electric
      procedure(name_interface), deferred, nopass :: name
   end type linear_solver_t

   abstract interface
      subroutine analyse_interface(self, matrix, error)
         import :: linear_solver_t, system_matrix_t, error_t
         class(linear_solver_t), intent(inout) :: self
         type(system_matrix_t), intent(in) :: matrix
         type(error_t), allocatable, intent(out) :: error
      end subroutine analyse_interface
      !> A singular matrix is an error with code `exit_solver` that names the equation where it was found
      subroutine factor_interface(self, matrix, error)
         import :: linear_solver_t, system_matrix_t, error_t
         class(linear_solver_t), intent(inout) :: self
         type(system_matrix_t), intent(in) :: matrix
         type(error_t), allocatable, intent(out) :: error
      end subroutine factor_interface
      subroutine solve_interface(self, matrix, b_m, b_e, x_m, x_e, error)
         import :: linear_solver_t, system_matrix_t, error_t, dp
         class(linear_solver_t), intent(inout) :: self
         type(system_matrix_t), intent(in) :: matrix
         real(dp), intent(in) :: b_m(:), b_e(:)
         real(dp), intent(out) :: x_m(:), x_e(:)
         type(error_t), allocatable, intent(out) :: error
      end subroutine solve_interface
      subroutine solve_part_interface(self, matrix, b, x, error)
         import :: linear_solver_t, system_matrix_t, error_t, dp
         class(linear_solver_t), intent(inout) :: self
         type(system_matrix_t), intent(in) :: matrix
         real(dp), intent(in) :: b(:)
         real(dp), intent(out) :: x(:)
         type(error_t), allocatable, intent(out) :: error
      end subroutine solve_part_interface
      function name_interface() result(name)
         character(len=:), allocatable :: name
      end function name_interface
   end interface

end module litz_linear_solver
