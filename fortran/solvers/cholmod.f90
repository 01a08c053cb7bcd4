!> Supernodal Cholesky factorisation by CHOLMOD of a symmetric positive definite matrix.
!>
!> Source: Y. Chen, T. A. Davis, W. W. Hager, S. Rajamanickam, ACM TOMS 35 (2008) 22.
module litz_cholmod
   use, intrinsic :: iso_c_binding, only: c_ptr, c_null_ptr, c_associated, c_int, c_int64_t, c_double
   use litz_kinds, only: dp, int64
   use litz_available_memory, only: available_memory, memory_text
   use litz_elimination_order, only: find_elimination_order
   use litz_errors, only: error_t, fail, exit_solver
   use litz_linear_solver, only: csr_matrix_t
   use litz_sparse_factor, only: sparse_factor_t
   implicit none
   private
   public :: cholmod_factor_t

   integer(c_int), parameter :: cholmod_ok = 0, cholmod_not_positive_definite = 1
   integer(c_int), parameter :: cholmod_out_of_memory = -2, cholmod_too_large = -3

   !> A matrix that is not positive definite fails at the equation where that was found; its pivot is then -1.
   type, extends(sparse_factor_t) :: cholmod_factor_t
      !> Most memory the factor may take [bytes]; 0: what the machine has available
      integer(int64) :: memory_limit = 0
      type(c_ptr), private :: handle = c_null_ptr
      integer(c_int64_t), allocatable, private :: start(:), index(:)
   contains
      procedure :: analyse => cholmod_analyse
      procedure :: factor => cholmod_factor
      procedure :: solve => cholmod_solve
      procedure :: release => cholmod_release
      procedure :: operations => cholmod_operations
      procedure :: entries => cholmod_entries
      final :: cholmod_finalise
   end type cholmod_factor_t

   interface
      function cholmod_shim_create() bind(c) result(handle)
         import :: c_ptr
         implicit none
         type(c_ptr) :: handle
      end function cholmod_shim_create

      subroutine cholmod_shim_destroy(handle) bind(c)
         import :: c_ptr
         implicit none
         type(c_ptr), value :: handle
      end subroutine cholmod_shim_destroy

      function cholmod_shim_analyse(handle, n, start, row, order) bind(c) result(status)
         import :: c_ptr, c_int64_t, c_int
         implicit none
         type(c_ptr), value :: handle
         !> Number of equations
         integer(c_int64_t), value :: n
         !> Place of the first entry of each column and one past the last (n + 1), from 0
         integer(c_int64_t), intent(in) :: start(*)
         !> Row of each entry, from 0, ascending within a column
         integer(c_int64_t), intent(in) :: row(*)
         !> Equation that may be eliminated first, second, ... (n), from 0
         integer(c_int64_t), intent(in) :: order(*)
         integer(c_int) :: status
      end function cholmod_shim_analyse

      function cholmod_shim_factor_entries(handle) bind(c) result(entries)
         import :: c_ptr, c_int64_t
         implicit none
         type(c_ptr), value :: handle
         integer(c_int64_t) :: entries
      end function cholmod_shim_factor_entries

      function cholmod_shim_operations(handle) bind(c) result(operations)
         import :: c_ptr, c_double
         implicit none
         type(c_ptr), value :: handle
         real(c_double) :: operations
      end function cholmod_shim_operations

      function cholmod_shim_factor(handle, n, start, row, value, failed) bind(c) result(status)
         import :: c_ptr, c_int64_t, c_double, c_int
         implicit none
         type(c_ptr), value :: handle
         !> Number of equations
         integer(c_int64_t), value :: n
         !> Place of the first entry of each column and one past the last (n + 1), from 0
         integer(c_int64_t), intent(in) :: start(*)
         !> Row of each entry, from 0, ascending within a column
         integer(c_int64_t), intent(in) :: row(*)
         !> Entries of both triangles; the upper one is read
         real(c_double), intent(in) :: value(*)
         !> Column, from 0, whose pivot is not positive
         integer(c_int64_t), intent(inout) :: failed
         integer(c_int) :: status
      end function cholmod_shim_factor

      subroutine cholmod_shim_pivots(handle, pivot) bind(c)
         import :: c_ptr, c_double
         implicit none
         type(c_ptr), value :: handle
         !> Squares of the diagonal of the factor (n), in the order of the equations
         real(c_double), intent(out) :: pivot(*)
      end subroutine cholmod_shim_pivots

      function cholmod_shim_solve(handle, n, b, x) bind(c) result(status)
         import :: c_ptr, c_int64_t, c_double, c_int
         implicit none
         type(c_ptr), value :: handle
         !> Number of equations
         integer(c_int64_t), value :: n
         !> Right-hand side (n)
         real(c_double), intent(in) :: b(*)
         !> Solution (n)
         real(c_double), intent(out) :: x(*)
         integer(c_int) :: status
      end function cholmod_shim_solve

      subroutine cholmod_shim_release(handle) bind(c)
         import :: c_ptr
         implicit none
         type(c_ptr), value :: handle
      end subroutine cholmod_shim_release
   end interface

contains

   subroutine cholmod_analyse(self, matrix, error)
      class(cholmod_factor_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      integer(c_int64_t), allocatable :: order(:)
      integer(c_int) :: status

      if (.not. c_associated(self%handle)) self%handle = cholmod_shim_create()
      if (.not. c_associated(self%handle)) then
         error = cholmod_error(cholmod_out_of_memory, matrix%n_rows)
         return
      end if
      self%start = int(matrix%row_start, c_int64_t) - 1
      self%index = int(matrix%column, c_int64_t) - 1
      if (allocated(self%pivot)) deallocate (self%pivot)
      allocate (self%pivot(matrix%n_rows))
      call find_elimination_order(matrix, order, error)
      if (allocated(error)) return
      status = cholmod_shim_analyse(self%handle, int(matrix%n_rows, c_int64_t), self%start, self%index, order)
      if (status /= cholmod_ok) then
         error = cholmod_error(status, matrix%n_rows)
      else
         call check_memory(self, matrix%n_rows, error)
      end if
   end subroutine cholmod_analyse

   !> A factor that does not fit is refused before the system would kill the run for it.
   subroutine check_memory(self, n, error)
      class(cholmod_factor_t), intent(in) :: self
      !> Number of equations
      integer, intent(in) :: n
      type(error_t), allocatable, intent(out) :: error
      integer(int64) :: bytes, limit
      character(len=12) :: equations

      bytes = storage_size(1.0_dp)/8*cholmod_shim_factor_entries(self%handle)
      limit = self%memory_limit
      if (limit == 0) limit = available_memory()
      if (bytes <= limit) return
      write (equations, '(i0)') n
      error = fail(exit_solver, 'CHOLMOD: the factor of '//trim(equations)//' equations needs '//memory_text(bytes)// &
         ' of memory, '//memory_text(limit)//' are available; use a coarser mesh or a machine with more memory')
   end subroutine check_memory

   subroutine cholmod_factor(self, matrix, error)
      class(cholmod_factor_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      integer(c_int64_t) :: failed
      integer(c_int) :: status

      self%failed_equation = 0
      self%diagonal_pivots = .true.
      failed = 0
      status = cholmod_shim_factor(self%handle, int(matrix%n_rows, c_int64_t), self%start, self%index, matrix%value, &
         failed)
      select case (status)
      case (cholmod_not_positive_definite)
         self%failed_equation = int(failed) + 1
         self%pivot = -1
         call self%release()
      case (cholmod_ok)
         call cholmod_shim_pivots(self%handle, self%pivot)
      case default
         error = cholmod_error(status, matrix%n_rows)
      end select
   end subroutine cholmod_factor

   subroutine cholmod_solve(self, b, x, error)
      class(cholmod_factor_t), intent(inout) :: self
      !> Right-hand side (n)
      real(dp), intent(in) :: b(:)
      !> Solution (n); meaningless after an error
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error
      integer(c_int) :: status

      status = cholmod_shim_solve(self%handle, size(b, kind=c_int64_t), b, x)
      if (status /= cholmod_ok) error = cholmod_error(status, size(b))
   end subroutine cholmod_solve

   function cholmod_error(status, n) result(error)
      !> What the shim returned, not `cholmod_ok`
      integer(c_int), intent(in) :: status
      !> Number of equations
      integer, intent(in) :: n
      type(error_t) :: error
      character(len=12) :: equations, code

      write (equations, '(i0)') n
      write (code, '(i0)') status
      select case (status)
      case (cholmod_out_of_memory, cholmod_too_large)
         error = fail(exit_solver, 'CHOLMOD: not enough memory to factor '//trim(equations)//' equations')
      case default
         error = fail(exit_solver, 'CHOLMOD: stopped with status '//trim(code)//' on '//trim(equations)//' equations')
      end select
   end function cholmod_error

   !> Operations of a factorisation.
   real(dp) function cholmod_operations(self) result(operations)
      class(cholmod_factor_t), intent(in) :: self

      operations = cholmod_shim_operations(self%handle)
   end function cholmod_operations

   !> Numbers in the factor.
   real(dp) function cholmod_entries(self) result(entries)
      class(cholmod_factor_t), intent(in) :: self

      entries = real(cholmod_shim_factor_entries(self%handle), dp)
   end function cholmod_entries

   subroutine cholmod_release(self)
      class(cholmod_factor_t), intent(inout) :: self

      if (c_associated(self%handle)) call cholmod_shim_release(self%handle)
   end subroutine cholmod_release

   subroutine cholmod_finalise(self)
      type(cholmod_factor_t), intent(inout) :: self

      if (c_associated(self%handle)) call cholmod_shim_destroy(self%handle)
      self%handle = c_null_ptr
   end subroutine cholmod_finalise

end module litz_cholmod
