!> Scaling of a matrix to unit diagonal, which makes pivots of unlike units comparable.
module litz_equilibration
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use litz_kinds, only: dp
   use litz_linear_solver, only: csr_matrix_t
   use litz_parallel, only: worth_threads
   use litz_sparse_pattern, only: csr_position
   implicit none
   private
   public :: equilibrate, scaled_maximum, power_of_two_below

contains

   !> Scale `d` for which `D A D` has entries of size one at most and, where `A` is positive definite, a diagonal
   !> of about one.
   !>
   !> Powers of two, so that scaling rounds nothing. A row whose diagonal is small beside its other entries (an
   !> indefinite matrix) is scaled by those.
   subroutine equilibrate(matrix, scale)
      type(csr_matrix_t), intent(in) :: matrix
      !> (n_rows); 0 for an equation without any entry, or with one that is infinite or not a number
      real(dp), intent(out) :: scale(:)
      real(dp) :: row_maximum(size(scale)), reference
      integer :: row, diagonal

      !$omp parallel do schedule(static) private(diagonal, reference) if (matrix%n_rows >= worth_threads)
      do row = 1, matrix%n_rows
         associate (values => matrix%value(matrix%row_start(row):matrix%row_start(row + 1) - 1))
            reference = 0
            if (all(ieee_is_finite(values))) then
               diagonal = csr_position(matrix, row, row)
               if (diagonal > 0) reference = abs(matrix%value(diagonal))
               if (.not. reference > 0 .and. size(values) > 0) reference = maxval(abs(values))
            end if
         end associate
         scale(row) = 0
         if (reference > 0) scale(row) = 1/sqrt(reference)
      end do
      !$omp end parallel do
      !$omp parallel do schedule(static) if (matrix%n_rows >= worth_threads)
      do row = 1, matrix%n_rows
         row_maximum(row) = scaled_row_maximum(matrix, row, scale(row), scale)
      end do
      !$omp end parallel do
      where (row_maximum > 1) scale = scale/sqrt(row_maximum)
      scale = power_of_two_below(scale)
   end subroutine equilibrate

   !> Largest entry of `diag(row_scale) A diag(column_scale)`.
   pure real(dp) function scaled_maximum(matrix, row_scale, column_scale) result(maximum)
      type(csr_matrix_t), intent(in) :: matrix
      !> Factors of the rows (n), not negative
      real(dp), intent(in) :: row_scale(:)
      !> Factors of the columns (n), not negative
      real(dp), intent(in) :: column_scale(:)
      integer :: row

      maximum = 0
      do row = 1, matrix%n_rows
         maximum = max(maximum, scaled_row_maximum(matrix, row, row_scale(row), column_scale))
      end do
   end function scaled_maximum

   pure real(dp) function scaled_row_maximum(matrix, row, row_scale, column_scale) result(maximum)
      type(csr_matrix_t), intent(in) :: matrix
      !> Number of the row
      integer, intent(in) :: row
      !> Its factor; not positive: the row counts as empty
      real(dp), intent(in) :: row_scale
      !> Factors of the columns (n), not negative
      real(dp), intent(in) :: column_scale(:)
      integer :: k

      maximum = 0
      if (.not. row_scale > 0) return
      do k = matrix%row_start(row), matrix%row_start(row + 1) - 1
         maximum = max(maximum, row_scale*abs(matrix%value(k))*column_scale(matrix%column(k)))
      end do
   end function scaled_row_maximum

   !> Largest power of two that is not above `a`; 0 stays 0.
   elemental real(dp) function power_of_two_below(a) result(power)
      !> Not negative
      real(dp), intent(in) :: a

      power = 0
      if (a > 0) power = set_exponent(1.0_dp, exponent(a))
   end function power_of_two_below

end module litz_equilibration
