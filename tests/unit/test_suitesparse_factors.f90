!> What the solvers read out of the libraries' factors: pivots, and the equation at which a factorisation stopped.
program test_suitesparse_factors
   use litz_kinds, only: dp
   use litz_errors, only: error_t
   use litz_linear_solver, only: csr_matrix_t
   use litz_scaled_factor, only: scaled_factor_t
   use litz_sparse_factor, only: sparse_factor_t
   use litz_sparse_pattern, only: pattern_from_cliques, csr_position, csr_add_product
   use litz_cholesky_or_lu, only: cholesky_or_lu_t
   use litz_cholmod, only: cholmod_factor_t
   use litz_concus_golub_widlund, only: symmetric_part, solve_by_symmetric_part
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
   call the_symmetric_part_solves_what_is_nearly_symmetric()
   call the_solver_falls_back_where_the_skew_part_is_large()
   call a_coupling_is_left_to_the_iteration()
   call an_earlier_factor_solves_what_is_near()
   call what_is_far_is_factored_anew()
   call an_earlier_factor_is_kept_where_that_pays_alone()
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

   !> 3 on the diagonal, -1 + s above it and -1 - s below.
   subroutine skew_chain(s, matrix)
      real(dp), intent(in) :: s
      type(csr_matrix_t), intent(out) :: matrix
      integer :: i

      call pattern_from_cliques(n, [(2*i - 1, i=1, n)], [(i, i + 1, i=1, n - 1)], matrix)
      do i = 1, n
         matrix%value(csr_position(matrix, i, i)) = 3
         if (i == n) exit
         matrix%value(csr_position(matrix, i, i + 1)) = s - 1
         matrix%value(csr_position(matrix, i + 1, i)) = -s - 1
      end do
   end subroutine skew_chain

   subroutine the_symmetric_part_solves_what_is_nearly_symmetric()
      type(scaled_factor_t) :: cholesky
      type(csr_matrix_t) :: matrix, part
      type(error_t), allocatable :: error
      real(dp) :: b(n), x(n)
      logical :: converged
      integer :: i

      call skew_chain(0.3_dp, matrix)
      call symmetric_part(matrix, part)
      call check(abs(part%value(csr_position(part, 7, 8)) + 1) < epsilon(1.0_dp) .and. &
         abs(part%value(csr_position(part, 8, 7)) + 1) < epsilon(1.0_dp), 'the symmetric part is the mean')
      allocate (cholmod_factor_t :: cholesky%backend)
      call cholesky%analyse(part, 0, error)
      call cholesky%factor(part, [(1.0_dp, i=1, n)], [(1.0_dp, i=1, n)], error)
      b = [(sin(1.0_dp*i), i=1, n)]
      call solve_by_symmetric_part(matrix, cholesky, b, x, converged, error)
      call check(converged .and. .not. allocated(error), 'a small skew part converges')
      call csr_add_product(matrix, -1.0_dp, x, b)
      call check(maxval(abs(b)) < 1.0e-14_dp, 'to a residual of round-off')
      call skew_chain(100.0_dp, matrix)
      call solve_by_symmetric_part(matrix, cholesky, b, x, converged, error)
      call check(.not. converged, 'a large skew part does not converge, and says so')
   end subroutine the_symmetric_part_solves_what_is_nearly_symmetric

   subroutine the_solver_falls_back_where_the_skew_part_is_large()
      type(cholesky_or_lu_t) :: solver
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error
      real(dp) :: b(n), x(n)
      integer :: i, try

      call skew_chain(100.0_dp, matrix)
      call solver%analyse(matrix, error)
      do try = 1, 2
         call solver%factor(matrix, .false., error)
         call check(.not. allocated(error), 'factors')
         b = [(sin(1.0_dp*i), i=1, n)]
         call solver%solve(matrix, b, x, error)
         call check(.not. allocated(error) .and. solver%lu_used, 'solves by LU')
         call csr_add_product(matrix, -1.0_dp, x, b)
         call check(maxval(abs(b)) < 1.0e-13_dp, 'the solution of the fallback')
      end do
   end subroutine the_solver_falls_back_where_the_skew_part_is_large

   !> A slip that follows a stiff force: the symmetric part has a negative eigenvalue, the rest of the chain has none.
   subroutine a_coupling_is_left_to_the_iteration()
      type(cholesky_or_lu_t) :: solver
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error
      real(dp) :: b(n), x(n)
      real(dp), allocatable :: coupling(:)
      integer :: i, k

      call skew_chain(0.01_dp, matrix)
      allocate (coupling(size(matrix%value)), source=0.0_dp)
      do k = matrix%row_start(5), matrix%row_start(6) - 1
         if (matrix%column(k) == 6) coupling(k) = 20
      end do
      matrix%value = matrix%value + coupling
      call solver%analyse(matrix, error)
      call solver%factor(matrix, .false., error)
      call check(.not. allocated(error) .and. solver%lu_used, 'the symmetric part is indefinite')
      call check(solver%negative_pivots <= 0, 'which does not make a stable matrix one with negative pivots')
      call solver%factor(matrix, .false., error, coupling=coupling)
      b = [(sin(1.0_dp*i), i=1, n)]
      call solver%solve(matrix, b, x, error)
      call check(.not. (allocated(error) .or. solver%lu_used), 'Cholesky of the rest will do')
      call check(solver%negative_pivots == -1, 'nothing is known of the pivots of the whole')
      call csr_add_product(matrix, -1.0_dp, x, b)
      call check(maxval(abs(b)) < 1.0e-7_dp, 'the solution with the coupling')
      b = [(sin(1.0_dp*i), i=1, n)]
      call skew_chain(100.0_dp, matrix)
      call solver%factor(matrix, .false., error, coupling=0*coupling)
      call solver%solve(matrix, b, x, error)
      call csr_add_product(matrix, -1.0_dp, x, b)
      call check(solver%lu_used .and. maxval(abs(b)) < 1.0e-13_dp, 'LU where the rest is not near either')
   end subroutine a_coupling_is_left_to_the_iteration

   !> Full matrices: a factorisation takes n^3/3 operations, the factor is stored as n^2 numbers.
   subroutine full_matrix(m, diagonal, skew, matrix)
      integer, intent(in) :: m
      !> Of each equation (m): with the rest 1/(1 + |i - j|) they are positive definite above 2 ln m
      real(dp), intent(in) :: diagonal(:)
      !> Added above the diagonal, taken away below
      real(dp), intent(in) :: skew
      type(csr_matrix_t), intent(out) :: matrix
      integer :: i, j

      call pattern_from_cliques(m, [1, m + 1], [(i, i=1, m)], matrix)
      do i = 1, m
         do j = 1, m
            matrix%value(csr_position(matrix, i, j)) = 1.0_dp/(1 + abs(i - j)) + sign(skew, real(j - i, dp))
         end do
         matrix%value(csr_position(matrix, i, i)) = diagonal(i)
      end do
   end subroutine full_matrix

   subroutine solve_and_check(solver, matrix, tolerance, what)
      type(cholesky_or_lu_t), intent(inout) :: solver
      type(csr_matrix_t), intent(in) :: matrix
      !> Of the residual, relative to the right-hand side
      real(dp), intent(in) :: tolerance
      character(len=*), intent(in) :: what
      type(error_t), allocatable :: error
      real(dp) :: b(matrix%n_rows), x(matrix%n_rows), left(matrix%n_rows)
      integer :: i

      b = [(sin(1.0_dp*i), i=1, size(b))]
      call solver%solve(matrix, b, x, error)
      call check(.not. allocated(error), what//': no error')
      left = b
      call csr_add_product(matrix, -1.0_dp, x, left)
      call check(norm2(left) <= tolerance*norm2(b), what//': the residual')
   end subroutine solve_and_check

   subroutine an_earlier_factor_solves_what_is_near()
      integer, parameter :: m = 600
      type(cholesky_or_lu_t) :: solver
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error
      real(dp) :: coupling(m*m)
      integer :: i

      call begin(solver, m)
      call full_matrix(m, [(21 + 0.5_dp*sin(1.0_dp*i), i=1, m)], 0.0_dp, matrix)
      call solver%factor(matrix, .true., error)
      call solve_and_check(solver, matrix, 3.0e-4_dp, 'one that is near')
      call check(solver%has_kept, 'the factor was kept')
      call check(solver%negative_pivots == -1, 'nothing is known of the pivots of a matrix that was not factored')
      call full_matrix(m, [(21 + 0.5_dp*sin(1.0_dp*i), i=1, m)], 1.0e-3_dp, matrix)
      coupling = 0
      coupling(2) = 0.1_dp
      matrix%value = matrix%value + coupling
      call solver%factor(matrix, .false., error, coupling=coupling)
      call solve_and_check(solver, matrix, 3.0e-4_dp, 'one that is near and not symmetric')
      call check(solver%has_kept, 'the factor was kept for that, too')
   end subroutine an_earlier_factor_solves_what_is_near

   !> The first of matrices that are near each other: that with 20 on the diagonal.
   subroutine begin(solver, m)
      type(cholesky_or_lu_t), intent(inout) :: solver
      integer, intent(in) :: m
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error
      integer :: i

      call full_matrix(m, [(20.0_dp, i=1, m)], 0.0_dp, matrix)
      if (.not. allocated(solver%lu)) call solver%analyse(matrix, error)
      solver%may_keep = .false.
      call solver%factor(matrix, .true., error)
      call check(.not. (allocated(error) .or. solver%has_kept), 'the first matrix has a factor of its own')
      solver%may_keep = .true.
   end subroutine begin

   subroutine what_is_far_is_factored_anew()
      integer, parameter :: m = 600
      type(cholesky_or_lu_t) :: solver
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error
      real(dp) :: coupling(m*m)
      integer :: i

      call begin(solver, m)
      call full_matrix(m, [(20.0_dp*i, i=1, m)], 0.0_dp, matrix)
      call solver%factor(matrix, .true., error)
      call check(solver%has_kept, 'a matrix that is far is tried with the earlier factor')
      call solve_and_check(solver, matrix, 1.0e-13_dp, 'and solved with its own')
      call check(.not. solver%has_kept .and. solver%negative_pivots == 0, 'it is known to be positive definite then')
      call solver%factor(matrix, .true., error)
      call check(.not. solver%has_kept, 'those after it are not tried')
      call begin(solver, m)
      call full_matrix(m, [(20*i*cos(1.0_dp*i), i=1, m)], 0.0_dp, matrix)
      call solver%factor(matrix, .true., error)
      call solve_and_check(solver, matrix, 1.0e-12_dp, 'an indefinite one')
      call check(solver%lu_used .and. solver%negative_pivots > 0, 'whose negative pivots are told')
      call solver%factor(matrix, .true., error)
      call check(.not. solver%has_kept, 'an LU is not kept')
      call begin(solver, m)
      call full_matrix(m, [(20.0_dp*i, i=1, m)], 1.0e-3_dp, matrix)
      coupling = 0
      coupling(2) = 3.0e4_dp
      matrix%value = matrix%value + coupling
      call solver%factor(matrix, .false., error, coupling=coupling)
      call solve_and_check(solver, matrix, 1.0e-8_dp, 'one with a coupling')
      call check(.not. (solver%has_kept .or. solver%lu_used), 'which is left out of the new factor')
   end subroutine what_is_far_is_factored_anew

   !> A chain is factored as fast as a step of the iteration takes.
   subroutine an_earlier_factor_is_kept_where_that_pays_alone()
      type(cholesky_or_lu_t) :: solver
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error

      call skew_chain(0.0_dp, matrix)
      call solver%analyse(matrix, error)
      call solver%factor(matrix, .true., error)
      solver%may_keep = .true.
      call solver%factor(matrix, .true., error)
      call check(.not. solver%has_kept .and. solver%negative_pivots == 0, 'a chain is factored anew')
      call pattern_from_cliques(0, [1], [integer ::], matrix)
      call solver%analyse(matrix, error)
      call solver%factor(matrix, .true., error)
      call solver%factor(matrix, .true., error)
      call check(.not. (allocated(error) .or. solver%has_kept), 'no equations are nothing to factor')
   end subroutine an_earlier_factor_is_kept_where_that_pays_alone

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
