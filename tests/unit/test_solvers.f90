!> Every solver of the build against LAPACK's dense LU, and against matrices that must be refused.
!>
!> The systems look like those of the program: nodes with three displacements and three rotations in unlike units,
!> chains of elements with a few contacts between them, conduction along the chains, and currents at the contacts that
!> depend on all displacements there.
program test_solvers
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use litz_kinds, only: dp, int64
   use litz_errors, only: error_t, exit_solver
   use litz_equations, only: system_t
   use litz_linear_solver, only: linear_solver_t, csr_matrix_t
   use litz_model, only: coupling_monolithic, coupling_updated
   use litz_scheme, only: scheme_t
   use litz_solver_names, only: solver_default, solver_block, solver_umfpack, solver_skyline, solver_mumps, &
      solver_keyword
   use litz_solver_factory, only: create_solver, resolved_solver, available_solvers
   use litz_sparse_pattern, only: pattern_from_cliques, csr_position
   use litz_skyline, only: skyline_factor_t
   implicit none

   interface
      subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
         import :: dp
         implicit none
         integer, intent(in) :: n, nrhs, lda, ldb
         real(dp), intent(inout) :: a(lda, *), b(ldb, *)
         integer, intent(out) :: ipiv(*), info
      end subroutine dgesv
      subroutine dsyev(jobz, uplo, n, a, lda, w, work, lwork, info)
         import :: dp
         implicit none
         character(len=1), intent(in) :: jobz, uplo
         integer, intent(in) :: n, lda, lwork
         real(dp), intent(inout) :: a(lda, *)
         real(dp), intent(out) :: w(*), work(*)
         integer, intent(out) :: info
      end subroutine dsyev
   end interface

   integer, parameter :: positive_definite = 1, indefinite = 2, unsymmetric = 3
   integer, parameter :: kinds(4) = [solver_block, solver_umfpack, solver_skyline, solver_mumps]
   integer :: failures = 0, i

   call start_random_numbers()
   call missing_solvers_are_refused_in_words()
   do i = 1, size(kinds)
      if (is_there(kinds(i))) call test_solver(kinds(i))
   end do
   call skyline_refuses_a_profile_beyond_memory()
   if (failures > 0) error stop 1

contains

   subroutine test_solver(kind)
      integer, intent(in) :: kind
      integer :: definiteness

      do definiteness = positive_definite, unsymmetric
         call solutions_agree_with_lapack(kind, definiteness, 14, 9)
         call solutions_agree_with_lapack(kind, definiteness, 14, 0)
      end do
      call solutions_agree_with_lapack(kind, positive_definite, 0, 9)
      call solutions_agree_with_lapack(kind, positive_definite, 0, 1)
      call solutions_agree_with_lapack(kind, positive_definite, 0, 0)
      call one_equation_in_each_field(kind)
      call refinement_repairs_a_small_pivot(kind)
      call new_values_need_no_new_analysis(kind)
      call a_new_pattern_needs_one(kind)
      call definiteness_may_come_and_go(kind)
      call electric_field_alone(kind)
      call negative_pivots_are_negative_eigenvalues(kind)
      call an_equation_without_entries_is_named(kind)
      call not_a_number_is_named(kind)
      call two_equal_equations_are_singular(kind)
      call a_loose_wire_is_singular(kind)
      call a_loose_conductor_is_singular(kind)
   end subroutine test_solver

   logical function is_there(kind)
      integer, intent(in) :: kind
      class(linear_solver_t), allocatable :: solver
      type(error_t), allocatable :: error

      call create_solver(kind, solver, error)
      is_there = allocated(solver)
   end function is_there

   subroutine missing_solvers_are_refused_in_words()
      class(linear_solver_t), allocatable :: solver
      type(error_t), allocatable :: error
      integer :: k

      do k = 1, size(kinds)
         call create_solver(kinds(k), solver, error)
         call check(allocated(solver) .neqv. allocated(error), 'either a solver or an error')
         call check(index(available_solvers(), trim(solver_keyword(kinds(k)))) > 0, '--version mentions the solver')
         if (allocated(error)) then
            call check(error%code == exit_solver, 'a missing solver has the exit code of solvers')
            call check(index(error%message, trim(solver_keyword(kinds(k)))) > 0, 'the missing solver is named')
            call check(index(error%message, 'allowed: ') > 0 .and. index(error%message, 'SKYLINE') > 0, &
               'the allowed solvers are named')
         end if
      end do
      call create_solver(solver_skyline, solver, error)
      call check(.not. allocated(error), 'the skyline solver is always there')
      call create_solver(solver_default, solver, error)
      call check(.not. allocated(error), 'the default solver is always there')
      call check(solver%kind == resolved_solver(solver_default), 'the default solver knows its name')
      call check(resolved_solver(solver_umfpack) == solver_umfpack, 'a choice stands')
      call create_solver(99, solver, error)
      call check(allocated(error), 'there is no solver 99')
   end subroutine missing_solvers_are_refused_in_words

   subroutine solutions_agree_with_lapack(kind, definiteness, nodes, conductor_nodes)
      integer, intent(in) :: kind, definiteness, nodes, conductor_nodes
      type(scheme_t) :: solver
      type(system_t) :: matrix

      call make_system(definiteness, nodes, conductor_nodes, matrix)
      call new_solver(kind, matrix, solver)
      call solve_and_compare(solver, matrix, 'monolithic step')
   end subroutine solutions_agree_with_lapack

   subroutine one_equation_in_each_field(kind)
      integer, intent(in) :: kind
      type(scheme_t) :: solver
      type(system_t) :: matrix
      type(error_t), allocatable :: error
      real(dp) :: x(2)

      call pattern_from_cliques(1, [1, 2], [1], matrix%block(1, 1))
      matrix%block(2, 2) = matrix%block(1, 1)
      matrix%block(2, 1) = matrix%block(1, 1)
      matrix%block(1, 1)%value = 4
      matrix%block(2, 1)%value = 6
      matrix%block(2, 2)%value = 2
      call new_solver(kind, matrix, solver)
      call solver%factor(matrix, error)
      call stop_on(error)
      call solver%solve_system(matrix, [8.0_dp, 10.0_dp], x, error)
      call stop_on(error)
      call check(maxval(abs(x - [2, -1])) < 1.0e-15_dp, name_of(solver%kind)//': [4 0; 6 2] x = [8; 10]')
   end subroutine one_equation_in_each_field

   !> Near a limit point a diagonal can almost vanish though the matrix is well conditioned.
   subroutine refinement_repairs_a_small_pivot(kind)
      integer, intent(in) :: kind
      type(scheme_t) :: solver
      type(system_t) :: matrix

      call pattern_from_cliques(2, [1, 3], [1, 2], matrix%block(1, 1))
      matrix%block(1, 1)%value = [1.0e-10_dp, 1/3.0_dp, 1/3.0_dp, 1.0e-10_dp]
      call pattern_from_cliques(0, [1], [integer ::], matrix%block(2, 2))
      call pattern_from_cliques(0, [1], [integer ::], matrix%block(2, 1))
      call new_solver(kind, matrix, solver)
      call solve_and_compare(solver, matrix, 'a small pivot')
   end subroutine refinement_repairs_a_small_pivot

   subroutine new_values_need_no_new_analysis(kind)
      integer, intent(in) :: kind
      type(scheme_t) :: solver
      type(system_t) :: matrix

      call make_system(positive_definite, 14, 9, matrix)
      call new_solver(kind, matrix, solver)
      call solve_and_compare(solver, matrix, 'first values')
      matrix%block(1, 1)%value = 3*matrix%block(1, 1)%value
      matrix%block(2, 1)%value = -matrix%block(2, 1)%value
      matrix%block(2, 2)%value = 0.2_dp*matrix%block(2, 2)%value
      call solve_and_compare(solver, matrix, 'second values')
   end subroutine new_values_need_no_new_analysis

   subroutine a_new_pattern_needs_one(kind)
      integer, intent(in) :: kind
      type(scheme_t) :: solver
      type(system_t) :: matrix
      type(error_t), allocatable :: error

      call make_system(positive_definite, 14, 9, matrix)
      call new_solver(kind, matrix, solver)
      call solve_and_compare(solver, matrix, 'before the pattern changed')
      call make_system(positive_definite, 17, 11, matrix)
      call solver%factor(matrix, error)
      call check(allocated(error), name_of(solver%kind)//': another pattern without analysis is noticed')
      call solver%analyse(matrix, error)
      call stop_on(error)
      call solve_and_compare(solver, matrix, 'after the pattern changed')
   end subroutine a_new_pattern_needs_one

   !> A Newton iteration through a buckling load: stable, unstable, stable.
   subroutine definiteness_may_come_and_go(kind)
      integer, intent(in) :: kind
      type(scheme_t) :: solver
      type(system_t) :: stable, unstable

      call make_system(positive_definite, 14, 9, stable)
      unstable = stable
      call soften(unstable%block(1, 1))
      call new_solver(kind, stable, solver)
      call solve_and_compare(solver, stable, 'before buckling')
      call solve_and_compare(solver, unstable, 'buckled')
      call solve_and_compare(solver, stable, 'after buckling')
      unstable%symmetric(1) = .false.
      call solve_and_compare(solver, unstable, 'buckled, said to be unsymmetric')
   end subroutine definiteness_may_come_and_go

   !> The voltages with new conductances while the mechanical factors stay.
   subroutine electric_field_alone(kind)
      integer, intent(in) :: kind
      type(scheme_t) :: solver
      type(system_t) :: matrix
      type(error_t), allocatable :: error
      real(dp), allocatable :: b_m(:), b_e(:), x_m(:), x_e(:)

      call make_system(positive_definite, 14, 9, matrix)
      call solver%create(kind, coupling_updated, error)
      call stop_on(error)
      call solver%analyse(matrix, error)
      call stop_on(error)
      allocate (b_m(matrix%block(1, 1)%n_rows), b_e(matrix%block(2, 2)%n_rows))
      allocate (x_m(size(b_m)), x_e(size(b_e)))
      call random_number(b_m)
      call random_number(b_e)
      call solver%factor(matrix, error)
      call stop_on(error)
      matrix%block(2, 2)%value = 7*matrix%block(2, 2)%value
      call solver%factor_group(2, matrix, error)
      call stop_on(error)
      call solver%solve_group(2, matrix, b_e, x_e, error)
      call stop_on(error)
      call compare(dense(matrix%block(2, 2)), b_e, x_e, name_of(kind)//': electric field by itself')
      call solver%solve_system(matrix, b_m, x_m, error)
      call stop_on(error)
      call compare(dense(matrix%block(1, 1)), b_m, x_m, name_of(kind)//': mechanical field by itself')
      call solver%solve_group(1, matrix, b_e, x_m, error)
      call check(allocated(error), name_of(kind)//': a right-hand side of the wrong length is noticed')
   end subroutine electric_field_alone

   subroutine negative_pivots_are_negative_eigenvalues(kind)
      integer, intent(in) :: kind
      type(scheme_t) :: solver
      type(system_t) :: matrix
      type(error_t), allocatable :: error
      integer :: expected

      call make_system(positive_definite, 14, 9, matrix)
      call new_solver(kind, matrix, solver)
      call solver%factor(matrix, error)
      call stop_on(error)
      call check(solver%negative_pivots == 0, name_of(solver%kind)// &
         ': a stable equilibrium has no negative pivot')
      call soften(matrix%block(1, 1))
      call solver%factor(matrix, error)
      call stop_on(error)
      expected = negative_eigenvalues(dense(matrix%block(1, 1)))
      call check(expected > 1, 'the softened matrix has several negative eigenvalues')
      call check(solver%negative_pivots == expected, name_of(solver%kind)// &
         ': negative pivots are as many as negative eigenvalues')
      matrix%symmetric(1) = .false.
      call solver%factor(matrix, error)
      call stop_on(error)
      call check(solver%negative_pivots == -1, name_of(solver%kind)//': no count for an unstable unsymmetric matrix')
   end subroutine negative_pivots_are_negative_eigenvalues

   subroutine an_equation_without_entries_is_named(kind)
      integer, intent(in) :: kind
      type(system_t) :: matrix

      call make_system(positive_definite, 14, 9, matrix)
      call clear_equation(matrix%block(1, 1), 31)
      call must_fail(kind, matrix, 31, 'a mechanical equation without entries')
      call make_system(positive_definite, 14, 9, matrix)
      call clear_equation(matrix%block(2, 2), 5)
      call must_fail(kind, matrix, matrix%block(1, 1)%n_rows + 5, 'an electric equation without entries')
   end subroutine an_equation_without_entries_is_named

   subroutine not_a_number_is_named(kind)
      integer, intent(in) :: kind
      type(system_t) :: matrix

      call make_system(positive_definite, 14, 9, matrix)
      matrix%block(1, 1)%value(matrix%block(1, 1)%row_start(12)) = ieee_value(1.0_dp, ieee_quiet_nan)
      call must_fail(kind, matrix, 12, 'not a number')
   end subroutine not_a_number_is_named

   !> `[2 2; 2 2]`, small enough for the vanishing pivot to be exactly zero.
   subroutine two_equal_equations_are_singular(kind)
      integer, intent(in) :: kind
      type(system_t) :: matrix

      call pattern_from_cliques(2, [1, 3], [1, 2], matrix%block(1, 1))
      matrix%block(1, 1)%value = 2
      call pattern_from_cliques(0, [1], [integer ::], matrix%block(2, 2))
      call pattern_from_cliques(0, [1], [integer ::], matrix%block(2, 1))
      call must_fail(kind, matrix, 0, 'two equal equations')
      matrix%symmetric(1) = .false.
      call must_fail(kind, matrix, 0, 'two equal equations, said to be unsymmetric')
   end subroutine two_equal_equations_are_singular

   !> Two rigid-body motions that rounding hides: the determinant is not zero in floating point.
   subroutine a_loose_wire_is_singular(kind)
      integer, intent(in) :: kind
      type(system_t) :: matrix
      integer :: elements

      elements = 10
      do while (elements <= 1000)
         call make_wire(elements, 0, matrix)
         call must_fail(kind, matrix, 0, 'a wire that nothing holds')
         call make_wire(elements, 1, matrix)
         call must_fail(kind, matrix, 0, 'a wire that can turn about its end')
         call make_wire(elements, 2, matrix)
         call must_pass(kind, matrix, 'a wire clamped at one end')
         elements = 10*elements
      end do
   end subroutine a_loose_wire_is_singular

   subroutine a_loose_conductor_is_singular(kind)
      integer, intent(in) :: kind
      type(system_t) :: matrix
      integer :: row, k

      call make_system(positive_definite, 14, 9, matrix)
      do row = 1, matrix%block(2, 2)%n_rows
         k = csr_position(matrix%block(2, 2), row, row)
         associate (block => matrix%block(2, 2))
            block%value(k) = block%value(k) - sum(block%value(block%row_start(row):block%row_start(row + 1) - 1))
         end associate
      end do
      call must_fail(kind, matrix, 0, 'a conductor without a prescribed potential')
   end subroutine a_loose_conductor_is_singular

   subroutine skyline_refuses_a_profile_beyond_memory()
      type(skyline_factor_t) :: factor
      type(system_t) :: matrix
      type(error_t), allocatable :: error

      call make_system(positive_definite, 14, 0, matrix)
      factor%memory_limit = 1000
      call factor%analyse(matrix%block(1, 1), error)
      call check(allocated(error), 'skyline refuses more memory than there is')
      if (allocated(error)) then
         call check(error%code == exit_solver, 'skyline refuses with the exit code of solvers')
         call check(index(error%message, '0.001 MB') > 0, 'skyline says how much there is')
         call check(index(error%message, 'NAME=BLOCK') > 0, 'skyline says which solver to take')
      end if
      factor%memory_limit = 10_int64**6
      call factor%analyse(matrix%block(1, 1), error)
      call check(.not. allocated(error), 'skyline takes what fits')
   end subroutine skyline_refuses_a_profile_beyond_memory

   ! ---- solving and comparing ----

   subroutine new_solver(kind, matrix, solver)
      integer, intent(in) :: kind
      type(system_t), intent(in) :: matrix
      type(scheme_t), intent(out) :: solver
      type(error_t), allocatable :: error

      call solver%create(kind, coupling_monolithic, error)
      call stop_on(error)
      call solver%analyse(matrix, error)
      call stop_on(error)
   end subroutine new_solver

   subroutine solve_and_compare(solver, matrix, what)
      type(scheme_t), intent(inout) :: solver
      type(system_t), intent(in) :: matrix
      character(len=*), intent(in) :: what
      type(error_t), allocatable :: error
      real(dp), dimension(matrix%block(1, 1)%n_rows + matrix%block(2, 2)%n_rows) :: b, x

      call random_number(b)
      call solver%factor(matrix, error)
      call stop_on(error)
      call solver%solve_system(matrix, b, x, error)
      call stop_on(error)
      call check(solver%failed_equation == 0, name_of(solver%kind)//': no equation is blamed')
      call compare(dense_system(matrix), b, x, name_of(solver%kind)//': '//what)
   end subroutine solve_and_compare

   !> The residual of each equation is round-off of its own terms, and the solution is LAPACK's as far as the condition
   !> of the matrix (kept mild by `make_system`) lets both be right.
   subroutine compare(a, b, x, what)
      real(dp), intent(in) :: a(:, :), b(:), x(:)
      character(len=*), intent(in) :: what
      real(dp) :: reference(size(b), 1), factors(size(b), size(b)), backward_error
      integer :: pivots(size(b)), info

      if (size(b) == 0) return
      backward_error = maxval(abs(b - matmul(a, x))/(matmul(abs(a), abs(x)) + abs(b)))
      call check(backward_error < 20*epsilon(1.0_dp), what//': residual')
      factors = a
      reference(:, 1) = b
      call dgesv(size(b), 1, factors, size(b), pivots, reference, size(b), info)
      call check(info == 0, what//': LAPACK solves it')
      call check(maxval(abs(x - reference(:, 1))) < 1.0e-10_dp*maxval(abs(x)), what//': solution')
   end subroutine compare

   !> Refused by factor or by solve, with an error that names an equation: `expected`, or any if that is 0.
   subroutine must_fail(kind, matrix, expected, what)
      integer, intent(in) :: kind, expected
      type(system_t), intent(in) :: matrix
      character(len=*), intent(in) :: what
      type(scheme_t) :: solver
      type(error_t), allocatable :: error
      character(len=12) :: number
      integer :: failed

      call new_solver(kind, matrix, solver)
      call factor_and_solve(solver, matrix, error)
      call check(allocated(error), name_of(solver%kind)//': '//what//' is refused')
      if (.not. allocated(error)) return
      call check(error%code == exit_solver, name_of(solver%kind)//': '//what//', exit code')
      call check(solver%failed_equation > 0, name_of(solver%kind)//': '//what//', an equation is blamed')
      failed = solver%failed_equation + merge(matrix%block(1, 1)%n_rows, 0, solver%failed_group == 2)
      if (expected > 0) call check(failed == expected, name_of(kind)//': '//what//', which equation')
      write (number, '(i0)') failed
      call check(index(error%message, 'equation '//trim(number)//' ') > 0, name_of(kind)//': '//what//', in words')
   end subroutine must_fail

   subroutine must_pass(kind, matrix, what)
      integer, intent(in) :: kind
      type(system_t), intent(in) :: matrix
      character(len=*), intent(in) :: what
      type(scheme_t) :: solver
      type(error_t), allocatable :: error

      call new_solver(kind, matrix, solver)
      call factor_and_solve(solver, matrix, error)
      call check(.not. allocated(error), name_of(solver%kind)//': '//what//' is solved')
   end subroutine must_pass

   subroutine factor_and_solve(solver, matrix, error)
      type(scheme_t), intent(inout) :: solver
      type(system_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      real(dp), dimension(matrix%block(1, 1)%n_rows + matrix%block(2, 2)%n_rows) :: b, x

      call random_number(b)
      call solver%factor(matrix, error)
      if (allocated(error)) return
      call solver%solve_system(matrix, b, x, error)
   end subroutine factor_and_solve

   ! ---- systems ----

   subroutine make_system(definiteness, nodes, conductor_nodes, matrix)
      integer, intent(in) :: definiteness, nodes, conductor_nodes
      type(system_t), intent(out) :: matrix

      call make_mechanics(nodes, matrix%block(1, 1))
      call make_conduction(conductor_nodes, matrix%block(2, 2))
      call make_coupling(conductor_nodes, 6*nodes, matrix%block(2, 1))
      matrix%symmetric(1) = definiteness /= unsymmetric
      if (definiteness == indefinite) call soften(matrix%block(1, 1))
      if (definiteness == unsymmetric) call skew(matrix%block(1, 1))
   end subroutine make_system

   !> A chain of nodes with three contacts across it; every clique adds a random positive definite block. Displacements
   !> in N/m, rotations in N m: unlike units by a factor of a million.
   subroutine make_mechanics(nodes, mm)
      integer, intent(in) :: nodes
      type(csr_matrix_t), intent(out) :: mm
      integer :: members(12*(nodes + 2)), start(nodes + 3), element, first, second, row, column, k, n
      real(dp) :: block(12, 12), root(12, 12), unit(12)

      n = merge(nodes + 2, 0, nodes > 1)
      unit(:6) = [1.0e3_dp, 1.0e3_dp, 1.0e3_dp, 1.0_dp, 1.0_dp, 1.0_dp]
      unit(7:) = unit(:6)
      start(:n + 1) = [(12*k + 1, k=0, n)]
      do element = 1, n
         first = element
         second = element + 1
         if (element >= nodes) first = element - nodes + 1
         if (element >= nodes) second = nodes - 2*(element - nodes)
         members(start(element):start(element + 1) - 1) = [(6*(first - 1) + k, k=1, 6), (6*(second - 1) + k, k=1, 6)]
      end do
      call pattern_from_cliques(6*nodes, start(:n + 1), members(:12*n), mm)
      do element = 1, n
         call random_number(root)
         block = matmul(transpose(root - 0.5_dp), root - 0.5_dp)
         associate (rows => members(start(element):start(element + 1) - 1))
            do column = 1, 12
               block(column, column) = block(column, column) + 1
               do row = 1, 12
                  k = csr_position(mm, rows(row), rows(column))
                  mm%value(k) = mm%value(k) + unit(row)*block(row, column)*unit(column)
               end do
            end do
         end associate
      end do
   end subroutine make_mechanics

   !> Subtract from the diagonal until some eigenvalues are negative.
   subroutine soften(mm)
      type(csr_matrix_t), intent(inout) :: mm
      integer :: row, k

      do row = 1, mm%n_rows
         k = csr_position(mm, row, row)
         mm%value(k) = mm%value(k)*merge(-0.7_dp, 0.6_dp, mod(row, 7) == 0)
      end do
   end subroutine soften

   !> As friction or a follower force does.
   subroutine skew(mm)
      type(csr_matrix_t), intent(inout) :: mm
      integer :: row, k

      do row = 1, mm%n_rows
         do k = mm%row_start(row), mm%row_start(row + 1) - 1
            if (mm%column(k) > row) mm%value(k) = 0.8_dp*mm%value(k)
         end do
      end do
   end subroutine skew

   !> Chain of conductors, the first node joined to a prescribed potential.
   subroutine make_conduction(nodes, ee)
      integer, intent(in) :: nodes
      type(csr_matrix_t), intent(out) :: ee
      integer :: element, k, n, position
      real(dp) :: conductance

      n = max(nodes - 1, 0)
      call pattern_from_cliques(nodes, [(2*k + 1, k=0, n)], [(k, k + 1, k=1, n)], ee)
      if (nodes > 0) ee%value(1) = 2.0e7_dp
      do element = 1, n
         call random_number(conductance)
         conductance = 1.0e7_dp*(conductance + 0.5_dp)
         do k = element, element + 1
            position = csr_position(ee, k, k)
            ee%value(position) = ee%value(position) + conductance
            position = csr_position(ee, k, 2*element + 1 - k)
            ee%value(position) = -conductance
         end do
      end do
   end subroutine make_conduction

   !> Two rows, as of one contact, with every displacement of four nodes: far larger numbers than on the diagonals.
   subroutine make_coupling(n_rows, n_columns, me)
      integer, intent(in) :: n_rows, n_columns
      type(csr_matrix_t), intent(out) :: me
      integer :: row, k, entries

      entries = merge(min(24, n_columns), 0, n_rows >= 5)
      me%n_rows = n_rows
      me%n_columns = n_columns
      allocate (me%row_start(n_rows + 1))
      do row = 1, n_rows + 1
         me%row_start(row) = 1 + entries*(merge(1, 0, row > 2) + merge(1, 0, row > 5))
      end do
      allocate (me%column(me%row_start(n_rows + 1) - 1), me%value(me%row_start(n_rows + 1) - 1))
      me%column = [(k, k=1, entries), (k, k=n_columns - entries + 1, n_columns)]
      call random_number(me%value)
      me%value = 1.0e12_dp*(me%value - 0.5_dp)
   end subroutine make_coupling

   !> Deflections and slopes of a slender wire of length 1 mm, of which the first `held` are held.
   !> Source: the Bernoulli beam with cubic deflection, any textbook.
   subroutine make_wire(elements, held, matrix)
      integer, intent(in) :: elements, held
      type(system_t), intent(out) :: matrix
      integer :: members(4, elements), element, row, column, k
      real(dp) :: block(4, 4), l, variation

      members = reshape([(max(0, 2*(element - 1) + [1, 2, 3, 4] - held), element=1, elements)], [4, elements])
      call pattern_from_cliques(2*elements + 2 - held, [(4*k + 1, k=0, elements)], reshape(members, [size(members)]), &
         matrix%block(1, 1))
      call pattern_from_cliques(0, [1], [integer ::], matrix%block(2, 2))
      call pattern_from_cliques(0, [1], [integer ::], matrix%block(2, 1))
      l = 1.0e-3_dp/elements
      do element = 1, elements
         call random_number(variation)
         block = (1 + variation)/l**3*reshape([12.0_dp, 6*l, -12.0_dp, 6*l, 6*l, 4*l*l, -6*l, 2*l*l, &
            -12.0_dp, -6*l, 12.0_dp, -6*l, 6*l, 2*l*l, -6*l, 4*l*l], [4, 4])
         do column = 1, 4
            do row = 1, 4
               if (members(row, element) == 0 .or. members(column, element) == 0) cycle
               k = csr_position(matrix%block(1, 1), members(row, element), members(column, element))
               matrix%block(1, 1)%value(k) = matrix%block(1, 1)%value(k) + block(row, column)
            end do
         end do
      end do
   end subroutine make_wire

   subroutine clear_equation(matrix, equation)
      type(csr_matrix_t), intent(inout) :: matrix
      integer, intent(in) :: equation
      integer :: row, k

      matrix%value(matrix%row_start(equation):matrix%row_start(equation + 1) - 1) = 0
      do row = 1, matrix%n_rows
         k = csr_position(matrix, row, equation)
         if (k > 0) matrix%value(k) = 0
      end do
   end subroutine clear_equation

   ! ---- dense matrices ----

   function dense_system(matrix) result(a)
      type(system_t), intent(in) :: matrix
      real(dp), dimension(matrix%block(1, 1)%n_rows + matrix%block(2, 2)%n_rows, &
         matrix%block(1, 1)%n_rows + matrix%block(2, 2)%n_rows) :: a
      integer :: n_m

      n_m = matrix%block(1, 1)%n_rows
      a(:n_m, :n_m) = dense(matrix%block(1, 1))
      a(:n_m, n_m + 1:) = 0
      a(n_m + 1:, :n_m) = dense(matrix%block(2, 1))
      a(n_m + 1:, n_m + 1:) = dense(matrix%block(2, 2))
   end function dense_system

   function dense(matrix) result(a)
      type(csr_matrix_t), intent(in) :: matrix
      real(dp) :: a(matrix%n_rows, matrix%n_columns)
      integer :: row, k

      a = 0
      do row = 1, matrix%n_rows
         do k = matrix%row_start(row), matrix%row_start(row + 1) - 1
            a(row, matrix%column(k)) = matrix%value(k)
         end do
      end do
   end function dense

   integer function negative_eigenvalues(a)
      real(dp), intent(in) :: a(:, :)
      real(dp) :: vectors(size(a, 1), size(a, 1)), eigenvalues(size(a, 1)), work(8*size(a, 1))
      integer :: info

      vectors = a
      call dsyev('N', 'U', size(a, 1), vectors, size(a, 1), eigenvalues, work, size(work), info)
      call check(info == 0, 'LAPACK finds the eigenvalues')
      negative_eigenvalues = count(eigenvalues < 0)
   end function negative_eigenvalues

   ! ---- reporting ----

   function name_of(kind) result(name)
      integer, intent(in) :: kind
      character(len=:), allocatable :: name

      name = trim(solver_keyword(kind))
   end function name_of

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
      print '(a)', error%text()
      error stop 1
   end subroutine stop_on

   !> The same numbers in every run.
   subroutine start_random_numbers()
      integer :: length, k

      call random_seed(size=length)
      call random_seed(put=[(1000 + 17*k, k=1, length)])
   end subroutine start_random_numbers

end program test_solvers
