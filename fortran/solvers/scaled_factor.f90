!> Factorisation of one square matrix with what every library needs around it: scaling to unit diagonal, the verdict
!> that a matrix is singular, and a step of iterative refinement.
module litz_scaled_factor
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use litz_kinds, only: dp
   use litz_errors, only: error_t, fail, exit_solver, exit_internal
   use litz_linear_solver, only: csr_matrix_t
   use litz_parallel, only: worth_threads
   use litz_sparse_pattern, only: csr_entries, csr_add_product
   use litz_sparse_factor, only: sparse_factor_t, smallest_pivot
   implicit none
   private
   public :: scaled_factor_t

   !> The first step of refinement corrects a solution by about its relative error. A correction beyond this leaves
   !> hardly one digit: the matrix is singular to working precision. (A wire of 10 000 elements held at one end stays
   !> below, one that can turn about that end comes out near 1.)
   real(dp), parameter :: largest_correction = 0.05_dp

   type :: scaled_factor_t
      class(sparse_factor_t), allocatable :: backend
      !> `diag(row_scale) A diag(column_scale)`, which is what the backend sees
      type(csr_matrix_t) :: matrix
      real(dp), allocatable :: row_scale(:), column_scale(:)
      !> Number of equations before the first of this matrix, for messages
      integer :: offset = 0
      !> Equation of this matrix at which the last `factor` or `solve` failed; 0: none
      integer :: failed_equation = 0
      logical :: factored = .false.
   contains
      procedure :: analyse => scaled_factor_analyse
      procedure :: factor => scaled_factor_factor
      procedure :: solve => scaled_factor_solve
      procedure :: solve_once => scaled_factor_solve_once
      procedure :: release => scaled_factor_release
   end type scaled_factor_t

contains

   subroutine scaled_factor_analyse(self, matrix, offset, error)
      class(scaled_factor_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      !> Number of equations of the whole system before those of the matrix, for messages
      integer, intent(in) :: offset
      type(error_t), allocatable, intent(out) :: error

      self%factored = .false.
      self%failed_equation = 0
      self%offset = offset
      self%matrix = matrix
      if (matrix%n_rows == 0) return
      call self%backend%analyse(self%matrix, error)
   end subroutine scaled_factor_analyse

   subroutine scaled_factor_factor(self, matrix, row_scale, column_scale, error)
      class(scaled_factor_t), intent(inout) :: self
      !> The pattern that was analysed, any values
      type(csr_matrix_t), intent(in) :: matrix
      !> (n_rows) positive, powers of two; 0 for an equation without any entry
      real(dp), intent(in) :: row_scale(:), column_scale(:)
      type(error_t), allocatable, intent(out) :: error
      integer :: row, infinite, empty

      self%factored = .false.
      self%failed_equation = 0
      if (matrix%n_rows /= self%matrix%n_rows .or. csr_entries(matrix) /= csr_entries(self%matrix)) then
         error = fail(exit_internal, 'linear solver: the pattern of the matrix has changed since it was analysed')
         return
      end if
      self%row_scale = row_scale
      self%column_scale = column_scale
      infinite = matrix%n_rows + 1
      empty = matrix%n_rows + 1
      !$omp parallel do schedule(static) reduction(min: infinite, empty) if (matrix%n_rows >= worth_threads)
      do row = 1, matrix%n_rows
         associate (first => matrix%row_start(row), last => matrix%row_start(row + 1) - 1)
            if (.not. all(ieee_is_finite(matrix%value(first:last)))) then
               infinite = min(infinite, row)
            else if (.not. row_scale(row) > 0) then
               empty = min(empty, row)
            else
               self%matrix%value(first:last) = row_scale(row)*matrix%value(first:last) &
                  *column_scale(matrix%column(first:last))
            end if
         end associate
      end do
      !$omp end parallel do
      if (min(infinite, empty) <= matrix%n_rows) then
         if (infinite <= empty) then
            call give_up(self, infinite, 'has a coefficient that is infinite or not a number', error)
         else
            call give_up(self, empty, 'has no coefficient other than zero', error)
         end if
         return
      end if
      if (matrix%n_rows > 0) call factor_backend(self, error)
      self%factored = .not. allocated(error)
   end subroutine scaled_factor_factor

   subroutine factor_backend(self, error)
      class(scaled_factor_t), intent(inout) :: self
      type(error_t), allocatable, intent(out) :: error
      integer :: weakest

      call self%backend%factor(self%matrix, error)
      if (allocated(error)) return
      weakest = self%backend%failed_equation
      if (weakest == 0 .and. allocated(self%backend%pivot)) then
         weakest = minloc(abs(self%backend%pivot), dim=1)
         if (abs(self%backend%pivot(weakest)) > smallest_pivot) weakest = 0
      end if
      if (weakest > 0) call give_up(self, weakest, 'has a vanishing pivot: the matrix is singular', error)
   end subroutine factor_backend

   !> `A x = b`
   subroutine scaled_factor_solve(self, b, x, error)
      class(scaled_factor_t), intent(inout) :: self
      !> Right-hand side (n)
      real(dp), intent(in) :: b(:)
      !> Solution (n); meaningless after an error
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error
      real(dp), allocatable :: residual(:), correction(:)

      self%failed_equation = 0
      if (.not. self%factored) then
         error = fail(exit_internal, 'linear solver: solve was called without a factorisation')
         return
      end if
      if (size(b) == 0) return
      allocate (correction(size(b)))
      residual = self%row_scale*b
      call self%backend%solve(residual, x, error)
      if (allocated(error)) return
      call csr_add_product(self%matrix, -1.0_dp, x, residual)
      call self%backend%solve(residual, correction, error)
      if (allocated(error)) return
      if (.not. maxval(abs(correction)) <= largest_correction*maxval(abs(x))) then
         call give_up(self, maxloc(abs(correction), dim=1), &
            'is undetermined: the matrix is singular to working precision', error)
         return
      end if
      x = self%column_scale*(x + correction)
   end subroutine scaled_factor_solve

   !> The same without refinement and verdict, for iterations that correct themselves; `solve` has been called before.
   subroutine scaled_factor_solve_once(self, b, x, error)
      class(scaled_factor_t), intent(inout) :: self
      !> Right-hand side (n)
      real(dp), intent(in) :: b(:)
      !> Solution (n); meaningless after an error
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error

      call self%backend%solve(self%row_scale*b, x, error)
      x = self%column_scale*x
   end subroutine scaled_factor_solve_once

   subroutine give_up(self, equation, reason, error)
      class(scaled_factor_t), intent(inout) :: self
      !> Number of the equation within the matrix
      integer, intent(in) :: equation
      !> What is wrong about it, as the end of a sentence
      character(len=*), intent(in) :: reason
      type(error_t), allocatable, intent(out) :: error
      character(len=12) :: number

      self%failed_equation = equation
      write (number, '(i0)') self%offset + equation
      error = fail(exit_solver, 'linear solver: equation '//trim(number)//' '//reason)
   end subroutine give_up

   subroutine scaled_factor_release(self)
      class(scaled_factor_t), intent(inout) :: self

      self%factored = .false.
      if (allocated(self%backend)) call self%backend%release()
   end subroutine scaled_factor_release

end module litz_scaled_factor
