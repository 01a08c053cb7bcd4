!> LU factorisation of an unsymmetric matrix within its profile, by dot products over active columns.
!>
!> Row i of L is stored from the first nonzero column of row i of the matrix, column j of U from the first nonzero row
!> of column j: without pivoting nothing fills in outside.
!> Source: K.-J. Bathe, Finite Element Procedures, section 8.2.3; R. L. Taylor's `datri` for the unsymmetric form.
module litz_skyline
   use litz_kinds, only: dp, int64
   use litz_errors, only: error_t, fail, exit_solver
   use litz_linear_solver, only: csr_matrix_t
   use litz_sparse_pattern, only: csr_transpose
   use litz_sparse_factor, only: sparse_factor_t, smallest_pivot
   use litz_reverse_cuthill_mckee, only: reverse_cuthill_mckee
   use litz_available_memory, only: available_memory, memory_text
   implicit none
   private
   public :: skyline_factor_t

   !> One triangle by rows of L or columns of U: line i holds its entries first(i)..i-1 one after the other.
   type :: profile_t
      integer, allocatable :: first(:)
      !> Entry k of line i is `value(start(i) + k)`
      integer(int64), allocatable :: start(:)
      real(dp), allocatable :: value(:)
   end type profile_t

   type, extends(sparse_factor_t) :: skyline_factor_t
      !> Most memory the factors may take [bytes]; 0: what the machine has available
      integer(int64) :: memory_limit = 0
      !> New number of each equation
      integer, allocatable :: position(:)
      !> L with unit diagonal, U without its diagonal
      type(profile_t) :: lower, upper
      !> Diagonal of U, in the new order
      real(dp), allocatable :: diagonal(:)
   contains
      procedure :: analyse => skyline_analyse
      procedure :: factor => skyline_factor
      procedure :: solve => skyline_solve
      procedure :: release => skyline_release
   end type skyline_factor_t

   interface
      pure real(dp) function ddot(n, x, step_x, y, step_y)
         import :: dp
         implicit none
         !> Number of products
         integer, intent(in) :: n
         !> Distance between the entries that are used
         integer, intent(in) :: step_x, step_y
         !> The vectors
         real(dp), intent(in) :: x(*), y(*)
      end function ddot
   end interface

contains

   subroutine skyline_analyse(self, matrix, error)
      class(skyline_factor_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      integer :: order(matrix%n_rows), k
      integer(int64) :: bytes, limit

      call self%release()
      call reverse_cuthill_mckee(symmetrised(matrix), order)
      if (allocated(self%position)) deallocate (self%position)
      allocate (self%position(matrix%n_rows))
      self%position(order) = [(k, k=1, matrix%n_rows)]
      call set_profiles(matrix, self%position, self%lower, self%upper)

      bytes = factor_bytes(self)
      limit = self%memory_limit
      if (limit == 0) limit = available_memory()
      if (bytes > limit) call refuse(matrix%n_rows, bytes, limit, error)
   end subroutine skyline_analyse

   pure integer(int64) function factor_bytes(self)
      class(skyline_factor_t), intent(in) :: self

      factor_bytes = storage_size(1.0_dp)/8*(profile_size(self%lower) + profile_size(self%upper) + size(self%position))
   end function factor_bytes

   subroutine refuse(n, bytes, limit, error)
      !> Number of equations
      integer, intent(in) :: n
      !> Memory that the profile needs [bytes]
      integer(int64), intent(in) :: bytes
      !> Memory that may be used [bytes]
      integer(int64), intent(in) :: limit
      type(error_t), allocatable, intent(out) :: error
      character(len=12) :: number

      write (number, '(i0)') n
      error = fail(exit_solver, 'skyline solver: the profile of '//trim(number)//' equations needs '// &
         memory_text(bytes)//' of memory, '//memory_text(limit)//' are available; take *SOLVER, NAME=BLOCK or '// &
         'NAME=UMFPACK, which store fewer zeros (in a build with SuiteSparse)')
   end subroutine refuse

   !> Pattern of `A + A^T`.
   function symmetrised(matrix) result(graph)
      type(csr_matrix_t), intent(in) :: matrix
      type(csr_matrix_t) :: graph, transpose
      logical, allocatable :: seen(:)
      integer :: row, count, k

      call csr_transpose(matrix, transpose)
      graph%n_rows = matrix%n_rows
      graph%n_columns = matrix%n_columns
      allocate (graph%row_start(matrix%n_rows + 1))
      allocate (graph%column(2*size(matrix%column)))
      allocate (seen(matrix%n_rows), source=.false.)
      count = 0
      do row = 1, matrix%n_rows
         graph%row_start(row) = count + 1
         do k = matrix%row_start(row), matrix%row_start(row + 1) - 1
            call add(matrix%column(k))
         end do
         do k = transpose%row_start(row), transpose%row_start(row + 1) - 1
            call add(transpose%column(k))
         end do
         seen(graph%column(graph%row_start(row):count)) = .false.
      end do
      graph%row_start(matrix%n_rows + 1) = count + 1
   contains
      subroutine add(column)
         !> Column of the entry
         integer, intent(in) :: column

         if (seen(column)) return
         seen(column) = .true.
         count = count + 1
         graph%column(count) = column
      end subroutine add
   end function symmetrised

   pure subroutine set_profiles(matrix, position, lower, upper)
      type(csr_matrix_t), intent(in) :: matrix
      !> Place of each equation in the order of elimination (n)
      integer, intent(in) :: position(:)
      type(profile_t), intent(inout) :: lower, upper
      integer :: row, i, j, k

      lower%first = [(k, k=1, matrix%n_rows)]
      upper%first = lower%first
      do row = 1, matrix%n_rows
         i = position(row)
         do k = matrix%row_start(row), matrix%row_start(row + 1) - 1
            j = position(matrix%column(k))
            if (j < i) lower%first(i) = min(lower%first(i), j)
            if (i < j) upper%first(j) = min(upper%first(j), i)
         end do
      end do
      lower%start = line_starts(lower%first)
      upper%start = line_starts(upper%first)
   end subroutine set_profiles

   pure function line_starts(first) result(start)
      !> First column of each line of the profile (n)
      integer, intent(in) :: first(:)
      integer(int64) :: start(size(first)), used
      integer :: i

      used = 0
      do i = 1, size(first)
         start(i) = used + 1 - first(i)
         used = used + i - first(i)
      end do
   end function line_starts

   pure integer(int64) function profile_size(profile)
      type(profile_t), intent(in) :: profile
      integer :: i

      profile_size = 0
      do i = 1, size(profile%first)
         profile_size = profile_size + i - profile%first(i)
      end do
   end function profile_size

   subroutine skyline_factor(self, matrix, error)
      class(skyline_factor_t), intent(inout) :: self
      type(csr_matrix_t), intent(in) :: matrix
      type(error_t), allocatable, intent(out) :: error
      integer :: failed, status

      if (.not. allocated(self%diagonal)) then
         allocate (self%diagonal(matrix%n_rows), self%lower%value(profile_size(self%lower)), &
            self%upper%value(profile_size(self%upper)), stat=status)
         if (status /= 0) then
            call refuse(matrix%n_rows, factor_bytes(self), available_memory(), error)
            return
         end if
      end if
      call fill_profiles(matrix, self%position, self%lower, self%upper, self%diagonal)
      call factor_profiles(self%lower, self%upper, self%diagonal, failed)
      self%pivot = self%diagonal(self%position)
      self%diagonal_pivots = failed == 0
      self%failed_equation = 0
      if (failed > 0) self%failed_equation = findloc(self%position, failed, dim=1)
   end subroutine skyline_factor

   pure subroutine fill_profiles(matrix, position, lower, upper, diagonal)
      type(csr_matrix_t), intent(in) :: matrix
      !> Place of each equation in the order of elimination (n)
      integer, intent(in) :: position(:)
      type(profile_t), intent(inout) :: lower, upper
      !> Diagonal of the matrix (n) in the order of elimination
      real(dp), intent(out) :: diagonal(:)
      integer :: row, i, j, k

      lower%value = 0
      upper%value = 0
      diagonal = 0
      do row = 1, matrix%n_rows
         i = position(row)
         do k = matrix%row_start(row), matrix%row_start(row + 1) - 1
            j = position(matrix%column(k))
            if (j < i) then
               lower%value(lower%start(i) + j) = matrix%value(k)
            else if (i < j) then
               upper%value(upper%start(j) + i) = matrix%value(k)
            else
               diagonal(i) = matrix%value(k)
            end if
         end do
      end do
   end subroutine fill_profiles

   !> `A = L U` in place: column j of U and row j of L from all lines before them.
   pure subroutine factor_profiles(lower, upper, diagonal, failed)
      type(profile_t), intent(inout) :: lower, upper
      !> In: the diagonal of the matrix (n). Out: that of `U`
      real(dp), intent(inout) :: diagonal(:)
      !> Line whose pivot vanished; 0: all went well
      integer, intent(out) :: failed
      integer :: i, j

      do j = 1, size(diagonal)
         do i = upper%first(j) + 1, j - 1
            ! u_ij = a_ij - sum_k l_ik u_kj
            upper%value(upper%start(j) + i) = upper%value(upper%start(j) + i) - line_product(lower, i, upper, j, i)
         end do
         do i = lower%first(j), j - 1
            ! l_ji = (a_ji - sum_k l_jk u_ki)/u_ii
            lower%value(lower%start(j) + i) = &
               (lower%value(lower%start(j) + i) - line_product(upper, i, lower, j, i))/diagonal(i)
         end do
         diagonal(j) = diagonal(j) - line_product(lower, j, upper, j, j)
         failed = j
         if (.not. abs(diagonal(j)) > smallest_pivot) return
      end do
      failed = 0
   end subroutine factor_profiles

   !> Sum over k < `before` of entry k of line i of `a` times entry k of line j of `b`.
   pure real(dp) function line_product(a, i, b, j, before) result(sum)
      type(profile_t), intent(in) :: a, b
      !> Line of `a`
      integer, intent(in) :: i
      !> Line of `b`
      integer, intent(in) :: j
      !> Where the sum ends, this entry not included
      integer, intent(in) :: before
      integer :: k

      k = max(a%first(i), b%first(j))
      sum = 0
      if (k < before) sum = ddot(before - k, a%value(a%start(i) + k), 1, b%value(b%start(j) + k), 1)
   end function line_product

   subroutine skyline_solve(self, b, x, error)
      class(skyline_factor_t), intent(inout) :: self
      !> Right-hand side (n)
      real(dp), intent(in) :: b(:)
      !> Solution (n)
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error
      real(dp) :: y(size(b))
      integer :: i

      y(self%position) = b
      do i = 1, size(y)
         associate (first => self%lower%first(i), start => self%lower%start(i))
            if (first < i) y(i) = y(i) - ddot(i - first, self%lower%value(start + first), 1, y(first), 1)
         end associate
      end do
      do i = size(y), 1, -1
         associate (first => self%upper%first(i), start => self%upper%start(i))
            y(i) = y(i)/self%diagonal(i)
            y(first:i - 1) = y(first:i - 1) - y(i)*self%upper%value(start + first:start + i - 1)
         end associate
      end do
      x = y(self%position)
   end subroutine skyline_solve

   subroutine skyline_release(self)
      class(skyline_factor_t), intent(inout) :: self

      if (allocated(self%diagonal)) deallocate (self%diagonal)
      if (allocated(self%lower%value)) deallocate (self%lower%value)
      if (allocated(self%upper%value)) deallocate (self%upper%value)
   end subroutine skyline_release

end module litz_skyline
