!> Factorisation by MUMPS: L D L^T of a symmetric matrix, definite or not, and L U of an unsymmetric one.
!>
!> Source: P. R. Amestoy, I. S. Duff, J.-Y. L'Excellent, J. Koster, SIAM J. Matrix Anal. Appl. 23 (2001) 15, and the
!> MUMPS users' guide.
module litz_mumps
   use, intrinsic :: iso_c_binding, only: c_ptr, c_null_ptr, c_associated, c_int, c_int64_t, c_double
   use litz_kinds, only: dp, int64
   use litz_available_memory, only: available_memory, memory_text
   use litz_elimination_order, only: find_elimination_order
   use litz_errors, only: error_t, fail, exit_solver
   use litz_linear_solver, only: csr_matrix_t
   use litz_sparse_factor, only: sparse_factor_t, smallest_pivot
   use litz_text, only: to_text
   implicit none
   private
   public :: has_mumps, create_mumps_factor, mumps_version, mumps_factor_t

   !> This build has MUMPS
   logical, parameter :: has_mumps = .true.

   !> Status codes, INFOG(1): workspaces that pivoting has outgrown, and a failed allocation
   integer(c_int), parameter :: out_of_workspace(6) = [-8, -9, -14, -15, -17, -20], out_of_memory = -13
   !> Workspace beyond the estimate [%]: at first, and at most
   integer, parameter :: first_relaxation = 20, last_relaxation = 1500

   !> No single pivots are told, only how many are negative.
   type, extends(sparse_factor_t) :: mumps_factor_t
      !> The matrices are symmetric; fixed once one has been analysed
      logical :: symmetric = .true.
      !> Most memory the factor may take [bytes]; 0: what the machine has available
      integer(int64) :: memory_limit = 0
      !> Workspace beyond the estimate [%]
      integer :: relaxation = first_relaxation
      type(c_ptr), private :: handle = c_null_ptr
      !> Equation that is eliminated first, second, ... (n), from 0
      integer(c_int64_t), allocatable, private :: order(:)
   contains
      procedure :: analyse => mumps_analyse
      procedure :: factor => mumps_factor
      procedure :: solve => mumps_solve
      procedure :: release => mumps_release
      procedure :: negative_pivots => mumps_negative_pivots
      final :: mumps_finalise
   end type mumps_factor_t

   interface
      function mumps_shim_create(symmetric, smallest) bind(c) result(handle)
         import :: c_ptr, c_int, c_double
         implicit none
         !> Not 0: the matrices are symmetric
         integer(c_int), value :: symmetric
         !> Size of a pivot that counts as vanished
         real(c_double), value :: smallest
         type(c_ptr) :: handle
      end function mumps_shim_create

      subroutine mumps_shim_destroy(handle) bind(c)
         import :: c_ptr
         implicit none
         type(c_ptr), value :: handle
      end subroutine mumps_shim_destroy

      function mumps_shim_analyse(handle, n, start, column, order, relax) bind(c) result(status)
         import :: c_ptr, c_int, c_int64_t
         implicit none
         type(c_ptr), value :: handle
         !> Number of equations
         integer(c_int), value :: n
         !> First entry of each row and one past the last (n + 1), from 1
         integer(c_int), intent(in) :: start(*)
         !> Column of each entry, from 1
         integer(c_int), intent(in) :: column(*)
         !> Equation that is eliminated first, second, ... (n), from 0
         integer(c_int64_t), intent(in) :: order(*)
         !> Workspace beyond the estimate [%]
         integer(c_int), value :: relax
         integer(c_int) :: status
      end function mumps_shim_analyse

      function mumps_shim_memory(handle) bind(c) result(bytes)
         import :: c_ptr, c_int64_t
         implicit none
         type(c_ptr), value :: handle
         integer(c_int64_t) :: bytes
      end function mumps_shim_memory

      function mumps_shim_factor(handle, start, column, value, relax, failed) bind(c) result(status)
         import :: c_ptr, c_int, c_double
         implicit none
         type(c_ptr), value :: handle
         !> First entry of each row and one past the last (n + 1), from 1
         integer(c_int), intent(in) :: start(*)
         !> Column of each entry, from 1
         integer(c_int), intent(in) :: column(*)
         !> Entries of the matrix
         real(c_double), intent(in) :: value(*)
         !> Workspace beyond the estimate [%]
         integer(c_int), value :: relax
         !> Equation whose pivot vanished; 0: none
         integer(c_int), intent(out) :: failed
         integer(c_int) :: status
      end function mumps_shim_factor

      function mumps_shim_negative_pivots(handle) bind(c) result(n)
         import :: c_ptr, c_int
         implicit none
         type(c_ptr), value :: handle
         integer(c_int) :: n
      end function mumps_shim_negative_pivots

      function mumps_shim_detail(handle) bind(c) result(detail)
         import :: c_ptr, c_int
         implicit none
         type(c_ptr), value :: handle
         integer(c_int) :: detail
      end function mumps_shim_detail

      function mumps_shim_solve(handle, x) bind(c) result(status)
         import :: c_ptr, c_int, c_double
         implicit none
         type(c_ptr), value :: handle
         !> In: right-hand side. Out: solution (n)
         real(c_double), intent(inout) :: x(*)
         integer(c_int) :: status
      end function mumps_shim_solve

      subroutine mumps_shim_version(version) bind(c)
         import :: c_int
         implicit none
         !> Main, sub and patch version (3)
         integer(c_int), intent(out) :: version(*)
      end subroutine mumps_shim_version
   end interface

contains

   subroutine create_mumps_factor(symmetric, factor)
      !> The matrices are symmetric
      logical, intent(in) :: symmetric
      class(sparse_factor_t), allocatable, intent(out) :: factor
      type(mumps_factor_t), allocatable :: new

      allocate (new)
      new%symmetric = symmetric
      call move_alloc(new, factor)
   end subroutine create_mumps_factor

   !> For `litz --version`.
   function mumps_version() result(text)
      character(len=:), allocatable :: text
      integer(c_int) :: version(3)

      call mumps_shim_version(version)
      text = 'MUMPS '//to_text(int(version(1)))//'.'//to_text(int(version(2)))//'.'//to_text(int(version(3)))
   end function mumps_version

   subroutine mumps_analyse(self, matrix, error)
      class(mumps_factor_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error

      call self%release()
      call find_elimination_order(matrix, self%order, error)
      if (.not. allocated(error)) call analyse_in_order(self, matrix, error)
   end subroutine mumps_analyse

   !> The symbolic work of MUMPS, which does not outlive the numbers.
   subroutine analyse_in_order(self, matrix, error)
      class(mumps_factor_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      integer(c_int) :: status

      status = out_of_memory
      self%handle = mumps_shim_create(merge(1_c_int, 0_c_int, self%symmetric), smallest_pivot)
      if (c_associated(self%handle)) status = mumps_shim_analyse(self%handle, int(matrix%n_rows, c_int), &
         matrix%row_start, matrix%column, self%order, int(self%relaxation, c_int))
      if (status < 0) then
         call report_status(self, status, matrix%n_rows, error)
      else
         call check_memory(self, mumps_shim_memory(self%handle), matrix%n_rows, error)
      end if
   end subroutine analyse_in_order

   !> A factor that does not fit is refused before the system would kill the run for it.
   subroutine check_memory(self, bytes, n, error)
      class(mumps_factor_t), intent(in) :: self
      !> What the factorisation takes [bytes]
      integer(int64), intent(in) :: bytes
      !> Number of equations
      integer, intent(in) :: n
      type(error_t), allocatable, intent(out) :: error
      integer(int64) :: limit

      limit = self%memory_limit
      if (limit == 0) limit = available_memory()
      if (bytes <= limit) return
      error = fail(exit_solver, 'MUMPS: the factorisation of '//to_text(n)//' equations needs '//memory_text(bytes)// &
         ' of memory, '//memory_text(limit)//' are available; use a coarser mesh or a machine with more memory')
   end subroutine check_memory

   !> Pivots that are put off to keep the factor accurate need room that no analysis foresees.
   subroutine mumps_factor(self, matrix, error)
      class(mumps_factor_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      integer(int64) :: estimate
      integer(c_int) :: status, failed

      self%failed_equation = 0
      if (.not. c_associated(self%handle)) call analyse_in_order(self, matrix, error)
      if (allocated(error)) return
      estimate = mumps_shim_memory(self%handle)
      do
         status = mumps_shim_factor(self%handle, matrix%row_start, matrix%column, matrix%value, &
            int(self%relaxation, c_int), failed)
         if (all(status /= out_of_workspace) .or. self%relaxation >= last_relaxation) exit
         self%relaxation = 2*self%relaxation
         call check_memory(self, estimate*(100 + self%relaxation)/(100 + first_relaxation), matrix%n_rows, error)
         if (allocated(error)) return
      end do
      if (status < 0) call report_status(self, status, matrix%n_rows, error)
      if (.not. allocated(error)) self%failed_equation = int(failed)
   end subroutine mumps_factor

   subroutine mumps_solve(self, b, x, error)
      class(mumps_factor_t), intent(inout) :: self
      !> Right-hand side (n)
      real(dp), intent(in) :: b(:)
      !> Solution (n); meaningless after an error
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error
      integer(c_int) :: status

      x = b
      status = mumps_shim_solve(self%handle, x)
      if (status < 0) call report_status(self, status, size(b), error)
   end subroutine mumps_solve

   subroutine report_status(self, status, n, error)
      class(mumps_factor_t), intent(in) :: self
      !> INFOG(1), negative
      integer(c_int), intent(in) :: status
      !> Number of equations
      integer, intent(in) :: n
      type(error_t), allocatable, intent(out) :: error

      if (status == out_of_memory .or. any(status == out_of_workspace)) then
         error = fail(exit_solver, 'MUMPS: not enough memory to factor '//to_text(n)//' equations')
      else
         error = fail(exit_solver, 'MUMPS: stopped with status '//to_text(int(status))//' ('// &
            to_text(int(mumps_shim_detail(self%handle)))//') on '//to_text(n)//' equations')
      end if
   end subroutine report_status

   !> Sylvester's law of inertia holds for the blocks of one and two equations of D alike.
   integer function mumps_negative_pivots(self, n) result(negative)
      class(mumps_factor_t), intent(in) :: self
      !> Number of first equations that are asked for: all
      integer, intent(in) :: n

      negative = -1
      if (self%symmetric .and. n == size(self%order)) negative = int(mumps_shim_negative_pivots(self%handle))
   end function mumps_negative_pivots

   subroutine mumps_release(self)
      class(mumps_factor_t), intent(inout) :: self

      if (c_associated(self%handle)) call mumps_shim_destroy(self%handle)
      self%handle = c_null_ptr
   end subroutine mumps_release

   subroutine mumps_finalise(self)
      type(mumps_factor_t), intent(inout) :: self

      call self%release()
   end subroutine mumps_finalise

end module litz_mumps
