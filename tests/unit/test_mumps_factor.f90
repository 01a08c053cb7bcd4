!> MUMPS by itself: inertia, vanishing pivots, memory, and workspace that pivoting outgrows.
program test_mumps_factor
   use litz_kinds, only: dp
   use litz_cholesky_or_lu, only: cholesky_or_lu_t
   use litz_errors, only: error_t, exit_solver
   use litz_linear_solver, only: csr_matrix_t
   use litz_mumps, only: mumps_factor_t
   use litz_sparse_pattern, only: pattern_from_cliques, csr_position, csr_add_product
   implicit none

   integer, parameter :: n = 60
   integer :: failures = 0

   call negative_pivots_are_negative_eigenvalues()
   call an_unsymmetric_matrix_is_solved_and_has_no_inertia()
   call a_vanished_pivot_is_named()
   call the_block_solver_counts_where_diagonals_vanish()
   call a_released_factor_can_be_had_again()
   call a_factor_that_does_not_fit_is_refused()
   call workspace_grows_with_pivots_put_off()
   if (failures > 0) error stop 1

contains

   !> `diagonal` on and -1 beside the diagonal, with eigenvalues `diagonal - 2 cos(k pi/(n + 1))`.
   subroutine make_chain(diagonal, matrix, equations)
      real(dp), intent(in) :: diagonal
      type(csr_matrix_t), intent(out) :: matrix
      integer, intent(in), optional :: equations
      integer :: i, m

      m = n
      if (present(equations)) m = equations
      call pattern_from_cliques(m, [(2*i - 1, i=1, m)], [(i, i + 1, i=1, m - 1)], matrix)
      matrix%value = -1
      do i = 1, m
         matrix%value(csr_position(matrix, i, i)) = diagonal
      end do
   end subroutine make_chain

   integer function negative_eigenvalues(diagonal) result(negative)
      real(dp), intent(in) :: diagonal
      real(dp), parameter :: pi = acos(-1.0_dp)
      integer :: k

      negative = count([(diagonal - 2*cos(k*pi/(n + 1)) < 0, k=1, n)])
   end function negative_eigenvalues

   !> With a zero diagonal every pivot takes two equations.
   subroutine negative_pivots_are_negative_eigenvalues()
      type(mumps_factor_t) :: factor
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error
      real(dp), parameter :: diagonal(5) = [3.0_dp, 1.2_dp, 0.3_dp, 0.0_dp, -1.1_dp]
      integer :: i

      call make_chain(diagonal(1), matrix)
      call factor%analyse(matrix, error)
      call stop_on(error)
      do i = 1, size(diagonal)
         call make_chain(diagonal(i), matrix)
         call factor%factor(matrix, error)
         call stop_on(error)
         call check(factor%failed_equation == 0, 'no pivot vanishes')
         call check(factor%negative_pivots(n) == negative_eigenvalues(diagonal(i)), 'inertia')
         call check(factor%negative_pivots(n - 1) == -1, 'the inertia of a part is not known')
         call residual_is_small(factor, matrix, 'symmetric')
      end do
   end subroutine negative_pivots_are_negative_eigenvalues

   subroutine an_unsymmetric_matrix_is_solved_and_has_no_inertia()
      type(mumps_factor_t) :: factor
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error
      integer :: i

      factor%symmetric = .false.
      call make_chain(0.3_dp, matrix)
      do i = 1, n - 1
         matrix%value(csr_position(matrix, i, i + 1)) = 0.4_dp
      end do
      call factor%analyse(matrix, error)
      call stop_on(error)
      call factor%factor(matrix, error)
      call stop_on(error)
      call check(factor%negative_pivots(n) == -1, 'no inertia of an unsymmetric matrix')
      call residual_is_small(factor, matrix, 'unsymmetric')
   end subroutine an_unsymmetric_matrix_is_solved_and_has_no_inertia

   subroutine a_vanished_pivot_is_named()
      type(mumps_factor_t) :: factor
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error
      integer, parameter :: bad = 23

      call pattern_from_cliques(n, [1], [integer ::], matrix)
      matrix%value = 1
      matrix%value(bad) = 1.0e-17_dp
      call factor%analyse(matrix, error)
      call stop_on(error)
      call factor%factor(matrix, error)
      call check(.not. allocated(error) .and. factor%failed_equation == bad, 'the equation whose pivot vanished')
      matrix%value(bad) = -1.0e-12_dp
      call factor%factor(matrix, error)
      call check(.not. allocated(error) .and. factor%failed_equation == 0, 'a small pivot is one')
      call check(factor%negative_pivots(n) == 1, 'and has its sign')
   end subroutine a_vanished_pivot_is_named

   !> LU leaves the diagonal here and could not tell. Of few equations it factors all the same: that is faster.
   subroutine the_block_solver_counts_where_diagonals_vanish()
      integer, parameter :: sizes(2) = [60, 600]
      type(cholesky_or_lu_t) :: solver
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error
      real(dp), allocatable :: b(:), x(:)
      integer :: i, k

      do k = 1, size(sizes)
         call make_chain(0.0_dp, matrix, sizes(k))
         call solver%analyse(matrix, error)
         call stop_on(error)
         call solver%factor(matrix, .true., error)
         call stop_on(error)
         call check(solver%lu_used .and. (solver%negative_pivots_exact .eqv. sizes(k) == 600), 'exact with MUMPS')
         if (solver%negative_pivots_exact) call check(solver%negative_pivots == sizes(k)/2, &
            'half of the eigenvalues are negative')
         b = [(sin(1.0_dp*i), i=1, sizes(k))]
         allocate (x(sizes(k)))
         call solver%solve(matrix, b, x, error)
         call stop_on(error)
         call csr_add_product(matrix, -1.0_dp, x, b)
         call check(maxval(abs(b)) < 1.0e-13_dp*maxval(abs(x)), 'block solver: solution')
         deallocate (x)
      end do
   end subroutine the_block_solver_counts_where_diagonals_vanish

   subroutine a_released_factor_can_be_had_again()
      type(mumps_factor_t) :: factor
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error

      call make_chain(0.3_dp, matrix)
      call factor%analyse(matrix, error)
      call stop_on(error)
      call factor%factor(matrix, error)
      call stop_on(error)
      call factor%release()
      call factor%factor(matrix, error)
      call stop_on(error)
      call residual_is_small(factor, matrix, 'after a release')
   end subroutine a_released_factor_can_be_had_again

   subroutine a_factor_that_does_not_fit_is_refused()
      type(mumps_factor_t) :: factor
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error

      call make_saddle(900, matrix)
      factor%memory_limit = 1
      call factor%analyse(matrix, error)
      call check(allocated(error), 'a factor larger than the memory')
      if (.not. allocated(error)) return
      call check(error%code == exit_solver, 'exit code of solvers')
      call check(index(error%message, 'of memory') > 0, 'says how much is needed')
   end subroutine a_factor_that_does_not_fit_is_refused

   subroutine workspace_grows_with_pivots_put_off()
      type(mumps_factor_t) :: factor
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error

      call make_saddle(900, matrix)
      factor%relaxation = 1
      call factor%analyse(matrix, error)
      call stop_on(error)
      call factor%factor(matrix, error)
      call stop_on(error)
      call check(factor%relaxation > 1, 'a first workspace that is too small')
      call check(factor%negative_pivots(matrix%n_rows) == 900, 'as many negative pivots as constraints')
      call residual_is_small(factor, matrix, 'saddle')
   end subroutine workspace_grows_with_pivots_put_off

   !> `[eps I, B^T; B, 0]` with constraints numbered and eliminated among the unknowns: their pivots are put off.
   subroutine make_saddle(constraints, matrix)
      integer, intent(in) :: constraints
      type(csr_matrix_t), intent(out) :: matrix
      integer :: start(constraints + 1), members(4*constraints), i, j, c

      do i = 1, constraints
         start(i) = 4*i - 3
         c = 2*i
         members(4*i - 3:4*i) = [c, 2*i - 1, 1 + modulo(2*i + 60, 2*constraints), 1 + modulo(2*i*i + 6, 2*constraints)]
      end do
      start(constraints + 1) = 4*constraints + 1
      call pattern_from_cliques(2*constraints, start, members, matrix)
      matrix%value = 0
      do i = 1, 2*constraints
         if (modulo(i, 2) == 1) matrix%value(csr_position(matrix, i, i)) = 1.0e-6_dp
      end do
      do i = 1, constraints
         do j = 4*i - 2, 4*i
            c = members(4*i - 3)
            if (modulo(members(j), 2) == 0) cycle
            matrix%value(csr_position(matrix, c, members(j))) = matrix%value(csr_position(matrix, c, members(j))) &
               + 1/real(j - 4*i + 3, dp)
            matrix%value(csr_position(matrix, members(j), c)) = matrix%value(csr_position(matrix, c, members(j)))
         end do
      end do
   end subroutine make_saddle

   subroutine residual_is_small(factor, matrix, what)
      type(mumps_factor_t), intent(inout) :: factor
      type(csr_matrix_t), intent(in) :: matrix
      character(len=*), intent(in) :: what
      type(error_t), allocatable :: error
      real(dp) :: b(matrix%n_rows), x(matrix%n_rows), scale
      integer :: i

      b = [(sin(1.0_dp*i), i=1, size(b))]
      call factor%solve(b, x, error)
      call stop_on(error)
      scale = maxval(abs(b)) + maxval(abs(x))
      call csr_add_product(matrix, -1.0_dp, x, b)
      call check(maxval(abs(b)) < 1.0e-13_dp*scale, what//': solution')
   end subroutine residual_is_small

   subroutine check(condition, what)
      logical, intent(in) :: condition
      character(len=*), intent(in) :: what

      if (condition) return
      failures = failures + 1
      print '(2a)', 'failed: ', what
   end subroutine check

   subroutine stop_on(error)
      type(error_t), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      print '(a)', error%message
      error stop 1
   end subroutine stop_on

end program test_mumps_factor
