!> What the factorisation of one square sparse matrix offers to the solvers; every library has its own extension.
module litz_sparse_factor
   use litz_kinds, only: dp
   use litz_errors, only: error_t
   use litz_linear_solver, only: csr_matrix_t
   implicit none
   private
   public :: sparse_factor_t, smallest_pivot

   !> A pivot of a matrix with unit diagonal that is no larger has lost every digit: the matrix is singular.
   real(dp), parameter :: smallest_pivot = 16*epsilon(1.0_dp)

   type, abstract :: sparse_factor_t
      !> (n) pivot met at each equation in the last `factor`; not allocated where the library does not tell
      real(dp), allocatable :: pivot(:)
      !> Each equation was eliminated by its own diagonal, so that the signs of a symmetric matrix's pivots count its
      !> negative eigenvalues (Sylvester's law of inertia)
      logical :: diagonal_pivots = .false.
      !> Equation at which the last `factor` had to stop because its pivot vanished, or was negative where the method
      !> cannot have that; 0: it went through
      integer :: failed_equation = 0
   contains
      !> Symbolic work; call again only when the pattern has changed
      procedure(analyse_interface), deferred :: analyse
      !> Numeric factorisation. `error` is for want of memory and the like; a matrix that cannot be factored sets
      !> `failed_equation` instead.
      procedure(analyse_interface), deferred :: factor
      !> `A x = b`
      procedure(solve_interface), deferred :: solve
      !> Give back the memory of the last `factor`, keep the symbolic work
      procedure(release_interface), deferred :: release
      procedure :: negative_pivots => count_negative_pivots
   end type sparse_factor_t

   abstract interface
      subroutine analyse_interface(self, matrix, error)
         import :: sparse_factor_t, csr_matrix_t, error_t
         implicit none
         class(sparse_factor_t), intent(inout) :: self
         type(csr_matrix_t), intent(in) :: matrix
         type(error_t), allocatable, intent(out) :: error
      end subroutine analyse_interface
      subroutine solve_interface(self, b, x, error)
         import :: sparse_factor_t, error_t, dp
         implicit none
         class(sparse_factor_t), intent(inout) :: self
         !> Right-hand side (n)
         real(dp), intent(in) :: b(:)
         !> Solution (n); meaningless after an error
         real(dp), intent(out) :: x(:)
         type(error_t), allocatable, intent(out) :: error
      end subroutine solve_interface
      subroutine release_interface(self)
         import :: sparse_factor_t
         implicit none
         class(sparse_factor_t), intent(inout) :: self
      end subroutine release_interface
   end interface

contains

   !> Negative eigenvalues of the symmetric block of the first equations; -1: not known.
   integer function count_negative_pivots(self, n) result(negative)
      class(sparse_factor_t), intent(in) :: self
      !> Number of these equations
      integer, intent(in) :: n

      negative = -1
      if (self%diagonal_pivots) negative = count(self%pivot(:n) < 0)
   end function count_negative_pivots

end module litz_sparse_factor
