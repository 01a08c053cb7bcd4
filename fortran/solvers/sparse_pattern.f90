!> Patterns and products of sparse matrices in compressed rows.
module litz_sparse_pattern
   use litz_kinds, only: dp, int64
   use litz_errors, only: error_t, fail, exit_memory
   use litz_linear_solver, only: csr_matrix_t
   use litz_parallel, only: worth_threads
   implicit none
   private
   public :: pattern_from_cliques, csr_position, csr_transpose, csr_multiply, csr_add_product, csr_entries
   public :: check_entries

   !> Entries of a matrix are counted in default integers, and one more for the end of the last row
   integer, parameter :: max_countable = huge(1) - 1

contains

   !> Square pattern in which all members of a clique are coupled with each other, and everyone with himself.
   !>
   !> A clique is what one element or one contact ties together: equation numbers, or node numbers for a pattern of
   !> node blocks. The work is the sum of the squares of the clique sizes: a row is gathered in any order and handed out
   !> as a column of the transpose, whose rows so come out ascending, and the pattern is its own transpose.
   pure subroutine pattern_from_cliques(n, clique_start, clique_members, matrix, entries, max_entries)
      !> Number of members: rows and columns of the pattern
      integer, intent(in) :: n
      !> (cliques + 1): first member of each clique, and one past the last
      integer, intent(in) :: clique_start(:)
      !> Members 1..n in any order, repetitions allowed; 0 is left out (an unknown without an equation)
      integer, intent(in) :: clique_members(:)
      !> Structurally symmetric, with a full diagonal; values zero
      type(csr_matrix_t), intent(out) :: matrix
      !> Number of entries that the pattern has
      integer(int64), intent(out), optional :: entries
      !> A pattern with more entries is not made; default: as many as can be counted
      integer(int64), intent(in), optional :: max_entries
      integer, allocatable :: cliques_start(:), cliques_of(:), neighbours(:), free(:), last_seen(:)
      integer(int64) :: total, most
      integer :: row, count, k

      most = max_countable
      if (present(max_entries)) most = max_entries
      call cliques_of_members(n, clique_start, clique_members, cliques_start, cliques_of)
      allocate (neighbours(n), last_seen(n))
      allocate (matrix%row_start(n + 1))

      last_seen = 0
      total = 0
      matrix%row_start(1) = 1
      do row = 1, n
         call gather_neighbours(row, cliques_start, cliques_of, clique_start, clique_members, last_seen, neighbours, &
            count)
         total = total + count
         matrix%row_start(row + 1) = int(min(total, most)) + 1
      end do
      if (present(entries)) entries = total
      if (total > most) return
      matrix%n_rows = n
      matrix%n_columns = n

      allocate (matrix%column(matrix%row_start(n + 1) - 1))
      allocate (matrix%value(matrix%row_start(n + 1) - 1), source=0.0_dp)
      free = matrix%row_start(:n)
      last_seen = 0
      do row = 1, n
         call gather_neighbours(row, cliques_start, cliques_of, clique_start, clique_members, last_seen, neighbours, &
            count)
         do k = 1, count
            matrix%column(free(neighbours(k))) = row
            free(neighbours(k)) = free(neighbours(k)) + 1
         end do
      end do
   end subroutine pattern_from_cliques

   !> The inverse lists: the cliques each unknown belongs to.
   pure subroutine cliques_of_members(n, clique_start, clique_members, start, cliques)
      !> Number of members
      integer, intent(in) :: n
      !> First member of each clique, and one past the last (cliques + 1)
      integer, intent(in) :: clique_start(:)
      !> Members 1..n of one clique after the other (entries of all cliques); 0: left out
      integer, intent(in) :: clique_members(:)
      !> First clique of each member in `cliques`, and one past the last (n + 1)
      integer, allocatable, intent(out) :: start(:)
      !> The cliques of each member (entries of all cliques), one member after the other
      integer, allocatable, intent(out) :: cliques(:)
      integer, allocatable :: free(:)
      integer :: clique, k, member

      allocate (start(n + 1), source=0)
      do k = 1, clique_start(size(clique_start)) - 1
         member = clique_members(k)
         if (member > 0) start(member + 1) = start(member + 1) + 1
      end do
      start(1) = 1
      do k = 1, n
         start(k + 1) = start(k) + start(k + 1)
      end do
      allocate (cliques(start(n + 1) - 1))
      free = start(:n)
      do clique = 1, size(clique_start) - 1
         do k = clique_start(clique), clique_start(clique + 1) - 1
            member = clique_members(k)
            if (member == 0) cycle
            cliques(free(member)) = clique
            free(member) = free(member) + 1
         end do
      end do
   end subroutine cliques_of_members

   !> Everyone who shares a clique with `row`, each once, `row` first.
   pure subroutine gather_neighbours(row, cliques_start, cliques, clique_start, clique_members, last_seen, neighbours, &
      count)
      !> The member whose neighbours are wanted
      integer, intent(in) :: row
      !> First clique of each member in `cliques`, and one past the last (n + 1)
      integer, intent(in) :: cliques_start(:)
      !> The cliques of each member (entries of all cliques), one member after the other
      integer, intent(in) :: cliques(:)
      !> First member of each clique, and one past the last (cliques + 1)
      integer, intent(in) :: clique_start(:)
      !> Members 1..n of one clique after the other (entries of all cliques); 0: left out
      integer, intent(in) :: clique_members(:)
      !> (n) the last row for which each unknown was gathered
      integer, intent(inout) :: last_seen(:)
      !> (n), of which the first `count` are set
      integer, intent(inout) :: neighbours(:)
      !> Number of neighbours, `row` included
      integer, intent(out) :: count
      integer :: i, k, member

      count = 1
      neighbours(1) = row
      last_seen(row) = row
      do i = cliques_start(row), cliques_start(row + 1) - 1
         do k = clique_start(cliques(i)), clique_start(cliques(i) + 1) - 1
            member = clique_members(k)
            if (member == 0) cycle
            if (last_seen(member) == row) cycle
            last_seen(member) = row
            count = count + 1
            neighbours(count) = member
         end do
      end do
   end subroutine gather_neighbours

   !> Where entry (row, column) stands in `matrix%value`; 0: it is not in the pattern.
   pure integer function csr_position(matrix, row, column) result(position)
      type(csr_matrix_t), intent(in) :: matrix
      !> Place of the entry in the matrix, from 1
      integer, intent(in) :: row, column
      integer :: low, high

      low = matrix%row_start(row)
      high = matrix%row_start(row + 1) - 1
      do while (low <= high)
         position = low + (high - low)/2
         if (matrix%column(position) == column) return
         if (matrix%column(position) < column) then
            low = position + 1
         else
            high = position - 1
         end if
      end do
      position = 0
   end function csr_position

   !> Number of stored entries; 0 also for a matrix that was never set.
   pure integer function csr_entries(matrix) result(entries)
      type(csr_matrix_t), intent(in) :: matrix

      entries = 0
      if (matrix%n_rows > 0) entries = matrix%row_start(matrix%n_rows + 1) - 1
   end function csr_entries

   !> More entries of a matrix than can be counted are refused. (Those of its factors are counted in 64 bits.)
   subroutine check_entries(equations, entries, error)
      !> Number of equations
      integer, intent(in) :: equations
      !> That the matrix would have
      integer(int64), intent(in) :: entries
      type(error_t), allocatable, intent(out) :: error
      character(len=120) :: text

      if (entries <= max_countable) return
      write (text, '(a, i0, a, i0, a, i0)') 'the matrix of ', equations, ' equations has ', entries, &
         ' entries; at most ', max_countable
      error = fail(exit_memory, 'linear solver: '//trim(text)// &
         ' can be numbered. Use a coarser mesh, or fewer wires in contact.')
   end subroutine check_entries

   !> `transpose = matrix^T`, columns ascending.
   pure subroutine csr_transpose(matrix, transpose)
      type(csr_matrix_t), intent(in) :: matrix
      type(csr_matrix_t), intent(out) :: transpose
      integer, allocatable :: free(:)
      integer :: row, column, k

      transpose%n_rows = matrix%n_columns
      transpose%n_columns = matrix%n_rows
      allocate (transpose%row_start(matrix%n_columns + 1), source=0)
      allocate (transpose%column(csr_entries(matrix)), transpose%value(csr_entries(matrix)))
      do k = 1, csr_entries(matrix)
         column = matrix%column(k)
         transpose%row_start(column + 1) = transpose%row_start(column + 1) + 1
      end do
      transpose%row_start(1) = 1
      do k = 1, matrix%n_columns
         transpose%row_start(k + 1) = transpose%row_start(k) + transpose%row_start(k + 1)
      end do
      free = transpose%row_start(:matrix%n_columns)
      do row = 1, matrix%n_rows
         do k = matrix%row_start(row), matrix%row_start(row + 1) - 1
            column = matrix%column(k)
            transpose%column(free(column)) = row
            transpose%value(free(column)) = matrix%value(k)
            free(column) = free(column) + 1
         end do
      end do
   end subroutine csr_transpose

   !> `y = A x`
   subroutine csr_multiply(matrix, x, y)
      type(csr_matrix_t), intent(in) :: matrix
      !> (n_columns)
      real(dp), intent(in) :: x(:)
      !> (n_rows)
      real(dp), intent(out) :: y(:)

      y = 0
      call csr_add_product(matrix, 1.0_dp, x, y)
   end subroutine csr_multiply

   !> `y = y + factor A x`
   subroutine csr_add_product(matrix, factor, x, y)
      type(csr_matrix_t), intent(in) :: matrix
      !> Any number
      real(dp), intent(in) :: factor
      !> (n_columns)
      real(dp), intent(in) :: x(:)
      !> (n_rows)
      real(dp), intent(inout) :: y(:)
      real(dp) :: product
      integer :: row, k

      !$omp parallel do schedule(static) private(product, k) if (matrix%n_rows >= worth_threads)
      do row = 1, matrix%n_rows
         product = 0
         do k = matrix%row_start(row), matrix%row_start(row + 1) - 1
            product = product + matrix%value(k)*x(matrix%column(k))
         end do
         y(row) = y(row) + factor*product
      end do
      !$omp end parallel do
   end subroutine csr_add_product

end module litz_sparse_pattern
