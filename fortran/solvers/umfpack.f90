!> LU factorisation by UMFPACK, 64-bit integers.
!>
!> Source: T. A. Davis, ACM TOMS 30 (2004) 196, and the UMFPACK user guide.
module litz_umfpack
   use, intrinsic :: iso_c_binding, only: c_ptr, c_null_ptr, c_associated, c_int64_t, c_double
   use litz_kinds, only: dp
   use litz_errors, only: error_t, fail, exit_solver
   use litz_linear_solver, only: csr_matrix_t
   use litz_sparse_factor, only: sparse_factor_t
   implicit none
   private
   public :: umfpack_factor_t

   !> Places in the control array, C index + 1, and what stands there (umfpack.h)
   integer, parameter :: control_length = 20, info_length = 90
   integer, parameter :: strategy = 6, ordering = 11, scaling = 17, refinement_steps = 8
   real(c_double), parameter :: strategy_symmetric = 3, ordering_metis = 3, scaling_none = 0

   integer(c_int64_t), parameter :: umfpack_ok = 0, umfpack_singular = 1
   integer(c_int64_t), parameter :: umfpack_out_of_memory = -1

   !> UMFPACK wants compressed columns. The rows of A are the columns of its transpose, so it is given A^T and asked
   !> for solutions with the transpose of what it was given.
   integer(c_int64_t), parameter :: solve_transposed = 1

   type, extends(sparse_factor_t) :: umfpack_factor_t
      private
      type(c_ptr) :: symbolic = c_null_ptr, numeric = c_null_ptr
      integer(c_int64_t), allocatable :: start(:), index(:)
      real(c_double) :: control(control_length) = 0
   contains
      procedure :: analyse => umfpack_analyse
      procedure :: factor => umfpack_factor
      procedure :: solve => umfpack_solve
      procedure :: release => umfpack_release
      final :: umfpack_finalise
   end type umfpack_factor_t

   interface
      subroutine umfpack_dl_defaults(control) bind(c)
         import :: c_double
         implicit none
         !> Settings of UMFPACK (20)
         real(c_double), intent(out) :: control(*)
      end subroutine umfpack_dl_defaults

      function umfpack_dl_symbolic(n_row, n_col, ap, ai, ax, symbolic, control, info) bind(c) result(status)
         import :: c_int64_t, c_double, c_ptr
         implicit none
         !> Numbers of rows and columns
         integer(c_int64_t), value :: n_row, n_col
         !> Place of the first entry of each column and one past the last (n_col + 1), from 0
         integer(c_int64_t), intent(in) :: ap(*)
         !> Row of each entry, from 0, ascending within a column
         integer(c_int64_t), intent(in) :: ai(*)
         !> Entries of the matrix
         real(c_double), intent(in) :: ax(*)
         type(c_ptr), intent(out) :: symbolic
         !> Settings of UMFPACK (20)
         real(c_double), intent(in) :: control(*)
         !> Statistics of UMFPACK (90)
         real(c_double), intent(out) :: info(*)
         integer(c_int64_t) :: status
      end function umfpack_dl_symbolic

      function umfpack_dl_numeric(ap, ai, ax, symbolic, numeric, control, info) bind(c) result(status)
         import :: c_int64_t, c_double, c_ptr
         implicit none
         !> Place of the first entry of each column and one past the last (n_col + 1), from 0
         integer(c_int64_t), intent(in) :: ap(*)
         !> Row of each entry, from 0, ascending within a column
         integer(c_int64_t), intent(in) :: ai(*)
         !> Entries of the matrix
         real(c_double), intent(in) :: ax(*)
         type(c_ptr), value :: symbolic
         type(c_ptr), intent(out) :: numeric
         !> Settings of UMFPACK (20)
         real(c_double), intent(in) :: control(*)
         !> Statistics of UMFPACK (90)
         real(c_double), intent(out) :: info(*)
         integer(c_int64_t) :: status
      end function umfpack_dl_numeric

      !> Without refinement the matrix is not looked at, so null pointers stand in for it
      function umfpack_dl_solve(sys, ap, ai, ax, x, b, numeric, control, info) bind(c) result(status)
         import :: c_int64_t, c_double, c_ptr
         implicit none
         !> Which system is solved, such as `solve_transposed`
         integer(c_int64_t), value :: sys
         type(c_ptr), value :: ap, ai, ax
         !> Solution (n)
         real(c_double), intent(out) :: x(*)
         !> Right-hand side (n)
         real(c_double), intent(in) :: b(*)
         type(c_ptr), value :: numeric
         !> Settings of UMFPACK (20)
         real(c_double), intent(in) :: control(*)
         !> Statistics of UMFPACK (90)
         real(c_double), intent(out) :: info(*)
         integer(c_int64_t) :: status
      end function umfpack_dl_solve

      !> Null pointers for the parts that are not wanted
      function umfpack_dl_get_numeric(lp, lj, lx, up, ui, ux, p, q, dx, do_recip, rs, numeric) bind(c) result(status)
         import :: c_int64_t, c_double, c_ptr
         implicit none
         type(c_ptr), value :: lp, lj, lx, up, ui, ux
         !> Row of the matrix that each pivot is in (n), from 0
         integer(c_int64_t), intent(out) :: p(*)
         !> Column of the matrix that each pivot is in (n), from 0
         integer(c_int64_t), intent(out) :: q(*)
         !> Pivots (n)
         real(c_double), intent(out) :: dx(*)
         type(c_ptr), value :: do_recip, rs
         type(c_ptr), value :: numeric
         integer(c_int64_t) :: status
      end function umfpack_dl_get_numeric

      subroutine umfpack_dl_free_symbolic(symbolic) bind(c)
         import :: c_ptr
         implicit none
         type(c_ptr), intent(inout) :: symbolic
      end subroutine umfpack_dl_free_symbolic

      subroutine umfpack_dl_free_numeric(numeric) bind(c)
         import :: c_ptr
         implicit none
         type(c_ptr), intent(inout) :: numeric
      end subroutine umfpack_dl_free_numeric
   end interface

contains

   subroutine umfpack_analyse(self, matrix, error)
      class(umfpack_factor_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      real(c_double) :: info(info_length)
      integer(c_int64_t) :: n, status

      call self%release()
      if (c_associated(self%symbolic)) call umfpack_dl_free_symbolic(self%symbolic)
      call umfpack_dl_defaults(self%control)
      self%control(strategy) = strategy_symmetric
      self%control(ordering) = ordering_metis
      self%control(scaling) = scaling_none
      self%control(refinement_steps) = 0
      n = matrix%n_rows
      self%start = int(matrix%row_start, c_int64_t) - 1
      self%index = int(matrix%column, c_int64_t) - 1
      status = umfpack_dl_symbolic(n, n, self%start, self%index, matrix%value, self%symbolic, self%control, info)
      if (status /= umfpack_ok) error = umfpack_error(status, matrix%n_rows)
   end subroutine umfpack_analyse

   subroutine umfpack_factor(self, matrix, error)
      class(umfpack_factor_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      real(c_double) :: info(info_length)
      integer(c_int64_t) :: status

      call self%release()
      self%failed_equation = 0
      status = umfpack_dl_numeric(self%start, self%index, matrix%value, self%symbolic, self%numeric, self%control, info)
      if (status /= umfpack_ok .and. status /= umfpack_singular) then
         error = umfpack_error(status, matrix%n_rows)
         return
      end if
      call get_pivots(self, matrix%n_rows)
   end subroutine umfpack_factor

   !> Pivot of each equation; zero where a singular matrix left none.
   subroutine get_pivots(self, n)
      type(umfpack_factor_t), intent(inout) :: self
      !> Number of equations
      integer, intent(in) :: n
      integer(c_int64_t) :: p(n), q(n), status
      real(dp) :: diagonal(n)

      status = umfpack_dl_get_numeric(c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, c_null_ptr, p, q, &
         diagonal, c_null_ptr, c_null_ptr, self%numeric)
      self%diagonal_pivots = status == umfpack_ok .and. all(p == q)
      if (.not. allocated(self%pivot)) allocate (self%pivot(n))
      if (size(self%pivot) /= n) self%pivot = diagonal
      ! the columns of the transpose, in the order `q`, are the equations
      self%pivot(q + 1) = diagonal
   end subroutine get_pivots

   subroutine umfpack_solve(self, b, x, error)
      class(umfpack_factor_t), intent(inout) :: self
      !> Right-hand side (n)
      real(dp), intent(in) :: b(:)
      !> Solution (n); meaningless after an error
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error
      real(c_double) :: info(info_length)
      integer(c_int64_t) :: status

      status = umfpack_dl_solve(solve_transposed, c_null_ptr, c_null_ptr, c_null_ptr, x, b, self%numeric, &
         self%control, info)
      if (status /= umfpack_ok) error = umfpack_error(status, size(b))
   end subroutine umfpack_solve

   function umfpack_error(status, n) result(error)
      !> What UMFPACK returned, not `umfpack_ok`
      integer(c_int64_t), intent(in) :: status
      !> Number of equations
      integer, intent(in) :: n
      type(error_t) :: error
      character(len=12) :: equations, code

      write (equations, '(i0)') n
      write (code, '(i0)') status
      select case (status)
      case (umfpack_out_of_memory)
         error = fail(exit_solver, 'UMFPACK: not enough memory to factor '//trim(equations)//' equations')
      case (umfpack_singular)
         error = fail(exit_solver, 'UMFPACK: the matrix of '//trim(equations)//' equations is singular')
      case default
         error = fail(exit_solver, 'UMFPACK: stopped with status '//trim(code)//' on '//trim(equations)//' equations')
      end select
   end function umfpack_error

   subroutine umfpack_release(self)
      class(umfpack_factor_t), intent(inout) :: self

      if (c_associated(self%numeric)) call umfpack_dl_free_numeric(self%numeric)
   end subroutine umfpack_release

   subroutine umfpack_finalise(self)
      type(umfpack_factor_t), intent(inout) :: self

      call self%release()
      if (c_associated(self%symbolic)) call umfpack_dl_free_symbolic(self%symbolic)
   end subroutine umfpack_finalise

end module litz_umfpack
