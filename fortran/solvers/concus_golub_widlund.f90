!> Solution of an unsymmetric system by the Cholesky factor of its symmetric part.
!>
!> `A = S + N` with `S` symmetric positive definite and `N` skew. In the inner product of `S` the operator `S^-1 N` is
!> skew too, so a recurrence of three terms finds the Galerkin solution in the growing Krylov space. The error falls by
!> `L/(1 + sqrt(1 + L^2))` a step, with `L` the spectral radius of `S^-1 N`: a few steps where a moment about a fixed
!> axis or a little slip makes the tangent unsymmetric. `A` itself need not be factored, which takes the pivots of an
!> LU.
!>
!> Source: P. Concus, G. H. Golub, Lecture Notes in Economics and Mathematical Systems 134 (1976) 56;
!> O. Widlund, SIAM J. Numer. Anal. 15 (1978) 801.
module litz_concus_golub_widlund
   use litz_kinds, only: dp
   use litz_errors, only: error_t
   use litz_linear_solver, only: csr_matrix_t
   use litz_scaled_factor, only: scaled_factor_t
   use litz_sparse_pattern, only: csr_add_product, csr_position
   implicit none
   private
   public :: symmetric_part, solve_by_symmetric_part

   !> More steps cost as much as an LU
   integer, parameter :: max_steps = 40
   !> Error in the norm of `S` over that of the solution: beyond the first, steps that no longer halve it are round-off
   real(dp), parameter :: accurate = 1.0e-10_dp, exact = 1.0e-15_dp

contains

   !> `S = (A + A^T)/2` of a matrix with a symmetric pattern.
   subroutine symmetric_part(matrix, part)
      type(csr_matrix_t), intent(in) :: matrix
      type(csr_matrix_t), intent(out) :: part
      integer :: row, k, mirrored

      part = matrix
      do row = 1, matrix%n_rows
         do k = matrix%row_start(row), matrix%row_start(row + 1) - 1
            if (matrix%column(k) <= row) cycle
            mirrored = csr_position(matrix, matrix%column(k), row)
            part%value(k) = (matrix%value(k) + matrix%value(mirrored))/2
            part%value(mirrored) = part%value(k)
         end do
      end do
   end subroutine symmetric_part

   !> `A x = b`
   subroutine solve_by_symmetric_part(matrix, factor, b, x, converged, error)
      !> `A`, the factor of `S`
      type(csr_matrix_t), intent(in) :: matrix
      type(scaled_factor_t), intent(inout) :: factor
      !> Right-hand side (n)
      real(dp), intent(in) :: b(:)
      !> Solution (n)
      real(dp), intent(out) :: x(:)
      !> .false.: `N` is too large, `x` is not a solution
      logical, intent(out) :: converged
      type(error_t), allocatable, intent(out) :: error
      real(dp), allocatable :: residual(:), correction(:), x_before(:), x_next(:)
      real(dp) :: omega, rho, rho_before, rho_start
      integer :: step

      allocate (correction(size(b)), x_before(size(b)), source=0.0_dp)
      converged = .true.
      x = 0
      omega = 1
      rho_before = 0
      rho_start = 0
      do step = 1, max_steps
         residual = b
         call csr_add_product(matrix, -1.0_dp, x, residual)
         if (step == 1) then
            call factor%solve(residual, correction, error)
         else
            call factor%solve_once(residual, correction, error)
         end if
         if (allocated(error)) return
         rho = dot_product(correction, residual)
         if (step == 1) rho_start = rho
         if (.not. rho > exact**2*rho_start) return
         if (step > 1) then
            if (rho > rho_before/4 .and. rho <= accurate**2*rho_start) return
            omega = 1/(1 + rho/(rho_before*omega))
         end if
         x_next = x_before + omega*(correction + x - x_before)
         x_before = x
         x = x_next
         rho_before = rho
      end do
      converged = .false.
   end subroutine solve_by_symmetric_part

end module litz_concus_golub_widlund
