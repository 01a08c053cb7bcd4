!> What the solvers read out of the libraries' factors: pivots, and the equation at which a factorisation stopped.
program test_suitesparse_factors
   use litz_kinds, only: dp
   use litz_errors, only: error_t
   use litz_linear_solver, only: csr_matrix_t
   use litz_sparse_factor, only: sparse_factor_t
   use litz_sparse_pattern, only: pattern_from_cliques, csr_position
   use litz_cholmod, only: cholmod_factor_t
   use litz_umfpack, only: umfpack_factor_t
   use litz_skyline, only: skyline_factor_t
   implicit none

   integer, parameter :: n = 60
   integer :: failures = 0
   class(sparse_factor_t), allocatable :: factor

   allocate (cholmod_factor_t :: factor)
   call pivots_multiply_to_the_determinant(factor, 'CHOLMOD')
   call a_negative_diagonal_is_found(factor, 'CHOLMOD')
   call a_factor_that_does_not_fit_is_refused()
   deallocate (factor)
   allocate (umfpack_factor_t :: factor)
   call pivots_multiply_to_the_determinant(factor, 'UMFPACK')
   call an_empty_equation_is_found(factor, 'UMFPACK')
   deallocate (factor)
   allocate (skyline_factor_t :: factor)
   call pivots_multiply_to_the_determinant(factor, 'skyline')
   call an_empty_equation_is_found(factor, 'skyline')
   deallocate (factor)
   if (failures > 0) error stop 1

contains

   !> Tridiagonal with 2 cosh(a) on and -1 beside the diagonal: the determinant is sinh((n + 1) a)/sinh(a).
   subroutine pivots_multiply_to_the_determinant(factor, name)
      class(sparse_factor_t), intent(inout) :: factor
      character(len=*), intent(in) :: name
      real(dp), parameter :: a = 0.3_dp
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error
      integer :: i

      call pattern_from_cliques(n, [(2*i - 1, i=1, n)], [(i, i + 1, i=1, n - 1)], matrix)
      matrix%value = -1
      do i = 1, n
         matrix%value(csr_position(matrix, i, i)) = 2*cosh(a)
      end do
      call factor%analyse(matrix, error)
      call check(.not. allocated(error), name//': analysis')
      call factor%factor(matrix, error)
      call check(.not. allocated(error) .and. factor%failed_equation == 0, name//': factorisation')
      call check(factor%diagonal_pivots, name//': pivots on the diagonal')
      call check(abs(sum(log(factor%pivot)) - log(sinh((n + 1)*a)/sinh(a))) < 1.0e-12_dp, name//': determinant')
   end subroutine pivots_multiply_to_the_determinant

   subroutine a_negative_diagonal_is_found(factor, name)
      class(sparse_factor_t), intent(inout) :: factor
      character(len=*), intent(in) :: name
      integer, parameter :: bad = 23

      call factor_diagonal(factor, bad, -1.0_dp)
      call check(factor%failed_equation == bad, name//': the equation with the negative diagonal')
      call factor_diagonal(factor, bad, 1.0_dp)
      call check(factor%failed_equation == 0, name//': goes on when the diagonal is positive again')
   end subroutine a_negative_diagonal_is_found

   subroutine an_empty_equation_is_found(factor, name)
      class(sparse_factor_t), intent(inout) :: factor
      character(len=*), intent(in) :: name
      integer, parameter :: bad = 23

      call factor_diagonal(factor, bad, 0.0_dp)
      call check(minloc(abs(factor%pivot), dim=1) == bad, name//': the equation with the zero diagonal')
      call check(abs(factor%pivot(bad)) < tiny(1.0_dp), name//': its pivot is zero')
   end subroutine an_empty_equation_is_found

   !> A tridiagonal matrix of n equations has n + n - 1 numbers in its factor; supernodes may store a few zeros more.
   subroutine a_factor_that_does_not_fit_is_refused()
      type(cholmod_factor_t) :: factor
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error
      integer :: i

      call pattern_from_cliques(n, [(2*i - 1, i=1, n)], [(i, i + 1, i=1, n - 1)], matrix)
      factor%memory_limit = 8*(2*n - 1) - 1
      call factor%analyse(matrix, error)
      call check(allocated(error), 'CHOLMOD: a factor larger than the memory')
      if (allocated(error)) call check(index(error%message, 'of memory') > 0, 'CHOLMOD: says how much is needed')
      factor%memory_limit = 8*n*n
      call factor%analyse(matrix, error)
      call check(.not. allocated(error), 'CHOLMOD: a factor that fits')
   end subroutine a_factor_that_does_not_fit_is_refused

   !> The unit matrix but for one equation.
   subroutine factor_diagonal(factor, equation, value)
      class(sparse_factor_t), intent(inout) :: factor
      integer, intent(in) :: equation
      real(dp), intent(in) :: value
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error

      call pattern_from_cliques(n, [1], [integer ::], matrix)
      matrix%value = 1
      matrix%value(equation) = value
      call factor%analyse(matrix, error)
      call check(.not. allocated(error), 'analysis of a diagonal matrix')
      call factor%factor(matrix, error)
      call check(.not. allocated(error), 'factorisation of a diagonal matrix')
   end subroutine factor_diagonal

   subroutine check(condition, what)
      logical, intent(in) :: condition
      character(len=*), intent(in) :: what

      if (condition) return
      failures = failures + 1
      print '(2a)', 'failed: ', what
   end subroutine check

end program test_suitesparse_factors
