!> Times of one matrix: litz's block solver, CHOLMOD called directly, and dense products of matrices.
!>
!>     factorisation MATRIX REPETITIONS
!>
!> MATRIX is a stream of 32-bit integers and 64-bit reals: rows, entries, row_start(rows + 1) and column(entries) from
!> 1, value(entries). Prints a line for each measurement: its name, and a value for each repetition; the programs
!> alternate.
program factorisation
   use, intrinsic :: iso_c_binding, only: c_int, c_int64_t, c_double
   use litz_kinds, only: dp, int64
   use litz_blas_threads, only: set_blas_threads
   use litz_cholesky_or_lu, only: cholesky_or_lu_t
   use litz_errors, only: error_t
   use litz_linear_solver, only: csr_matrix_t
!$ use omp_lib, only: omp_get_max_threads
   implicit none

   interface
      !> See direct_cholmod.c; ordering 0: CHOLMOD's own choice, 1: METIS, 2: AMD
      function direct_cholmod(n, start, row, value, ordering, seconds, flops, entries) bind(c) result(status)
         import :: c_int, c_int64_t, c_double
         implicit none
         integer(c_int64_t), value :: n
         integer(c_int64_t), intent(in) :: start(*), row(*)
         real(c_double), intent(in) :: value(*)
         integer(c_int), value :: ordering
         !> Symbolic and numeric work, and a solution
         real(c_double), intent(out) :: seconds(3), flops, entries
         integer(c_int) :: status
      end function direct_cholmod
      subroutine dgemm(transa, transb, m, n, k, alpha, a, lda, b, ldb, beta, c, ldc)
         import :: dp
         implicit none
         character, intent(in) :: transa, transb
         integer, intent(in) :: m, n, k, lda, ldb, ldc
         real(dp), intent(in) :: alpha, beta, a(lda, *), b(ldb, *)
         real(dp), intent(inout) :: c(ldc, *)
      end subroutine dgemm
   end interface

   character(len=*), parameter :: ordering_name(0:2) = ['default', 'metis  ', 'amd    ']
   type(csr_matrix_t) :: matrix
   character(len=4096) :: word
   integer :: repetitions, repetition, ordering

   call get_command_argument(2, word)
   read (word, *) repetitions
   call get_command_argument(1, word)
   call read_matrix(trim(word))
!$ call set_blas_threads(omp_get_max_threads())
   do repetition = 1, repetitions
      call time_products()
      call time_litz()
      do ordering = 0, 2
         call time_cholmod(ordering)
      end do
   end do

contains

   subroutine read_matrix(path)
      character(len=*), intent(in) :: path
      integer :: unit, rows, entries

      open (newunit=unit, file=path, access='stream', form='unformatted', status='old', action='read')
      read (unit) rows, entries
      matrix%n_rows = rows
      matrix%n_columns = rows
      allocate (matrix%row_start(rows + 1), matrix%column(entries), matrix%value(entries))
      read (unit) matrix%row_start, matrix%column, matrix%value
      close (unit)
   end subroutine read_matrix

   subroutine time_litz()
      type(cholesky_or_lu_t) :: solver
      type(error_t), allocatable :: error
      real(dp) :: b(matrix%n_rows), x(matrix%n_rows), begin

      b = 1
      begin = clock()
      call solver%analyse(matrix, error)
      call report('litz_analyse', clock() - begin)
      begin = clock()
      call solver%factor(matrix, .true., error)
      call report('litz_factor', clock() - begin)
      if (allocated(error)) error stop 'the matrix cannot be factored'
      if (solver%negative_pivots /= 0) error stop 'the matrix is not positive definite'
      begin = clock()
      call solver%solve(matrix, b, x, error)
      call report('litz_solve', clock() - begin)
   end subroutine time_litz

   subroutine time_cholmod(ordering)
      integer, intent(in) :: ordering
      real(c_double) :: seconds(3), flops, entries
      integer(c_int) :: status

      associate (mm => matrix, name => 'cholmod_'//trim(ordering_name(ordering)))
         status = direct_cholmod(int(mm%n_rows, c_int64_t), int(mm%row_start, c_int64_t) - 1, &
            int(mm%column, c_int64_t) - 1, mm%value, int(ordering, c_int), seconds, flops, entries)
         if (status /= 0) error stop 'CHOLMOD failed'
         call report(name//'_analyse', seconds(1))
         call report(name//'_factor', seconds(2))
         call report(name//'_solve', seconds(3))
         call report(name//'_flops', flops)
         call report(name//'_entries', entries)
      end associate
   end subroutine time_cholmod

   !> Operations per second of the product of two dense matrices.
   subroutine time_products()
      integer, parameter :: n = 1500
      real(dp), allocatable :: a(:, :), b(:, :), c(:, :)
      real(dp) :: begin

      allocate (a(n, n), b(n, n), c(n, n), source=1.0_dp)
      begin = clock()
      call dgemm('n', 'n', n, n, n, 1.0_dp, a, n, b, n, 0.0_dp, c, n)
      call report('product_rate', 2*real(n, dp)**3/(clock() - begin))
   end subroutine time_products

   subroutine report(name, value)
      character(len=*), intent(in) :: name
      real(dp), intent(in) :: value

      print '(a, es16.8)', name, value
   end subroutine report

   !> [s]
   real(dp) function clock()
      integer(int64) :: ticks, rate

      call system_clock(ticks, rate)
      clock = real(ticks, dp)/rate
   end function clock

end program factorisation
