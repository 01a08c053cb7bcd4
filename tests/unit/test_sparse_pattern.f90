!> Patterns, products and orderings of sparse matrices against dense ones.
program test_sparse_pattern
   use litz_kinds, only: dp, int64
   use litz_errors, only: error_t, exit_memory
   use litz_linear_solver, only: csr_matrix_t
   use litz_sparse_pattern, only: pattern_from_cliques, csr_position, csr_transpose, csr_multiply, csr_add_product, &
      csr_entries, check_entries
   use litz_equilibration, only: equilibrate
   use litz_reverse_cuthill_mckee, only: reverse_cuthill_mckee
   implicit none

   integer, parameter :: n = 40
   integer :: failures = 0

   call start_random_numbers()
   call members_of_a_clique_are_coupled()
   call an_unknown_alone_keeps_its_diagonal()
   call a_pattern_without_unknowns_is_empty()
   call transpose_and_products_agree_with_dense_ones()
   call a_shuffled_chain_is_put_in_order()
   call loose_parts_are_all_ordered()
   call scaling_gives_a_positive_definite_matrix_unit_diagonal()
   call scaling_bounds_an_indefinite_matrix()
   call more_entries_than_can_be_counted_are_refused()
   call a_pattern_stops_at_the_most_entries_and_tells_their_number()
   if (failures > 0) error stop 1

contains

   subroutine more_entries_than_can_be_counted_are_refused()
      type(error_t), allocatable :: error

      call check_entries(10, huge(1) - 1_int64, error)
      call check(.not. allocated(error), 'as many entries as can be counted are allowed')
      call check_entries(10, int(huge(1), int64), error)
      call check(allocated(error), 'one more entry is refused')
      if (allocated(error)) call check(index(error%message, '2147483647 entries') > 0, 'the message has the number')
      if (allocated(error)) call check(error%code == exit_memory, 'it is a matter of memory')
   end subroutine more_entries_than_can_be_counted_are_refused

   !> Four unknowns that are all coupled have 16 entries.
   subroutine a_pattern_stops_at_the_most_entries_and_tells_their_number()
      type(csr_matrix_t) :: matrix
      integer(int64) :: entries

      call pattern_from_cliques(4, [1, 5], [1, 2, 3, 4], matrix, entries, max_entries=15_int64)
      call check(entries == 16 .and. csr_entries(matrix) == 0, 'more entries are counted, but not made')
      call pattern_from_cliques(4, [1, 5], [1, 2, 3, 4], matrix, entries, max_entries=16_int64)
      call check(entries == 16 .and. csr_entries(matrix) == 16, 'as many are made')
   end subroutine a_pattern_stops_at_the_most_entries_and_tells_their_number

   !> Random cliques with repeated members and with zeros, compared entry by entry.
   subroutine members_of_a_clique_are_coupled()
      type(csr_matrix_t) :: matrix
      logical :: coupled(n, n)
      integer :: start(13), members(72), clique, i, j, row, column
      real(dp) :: draw(72)

      call random_number(draw)
      members = int(draw*(n + 1))
      start = [(1 + 6*clique, clique=0, 12)]
      members(8) = members(7)
      members(20) = 0
      call pattern_from_cliques(n, start, members, matrix)

      coupled = .false.
      do i = 1, n
         coupled(i, i) = .true.
      end do
      do clique = 1, 12
         do i = start(clique), start(clique + 1) - 1
            do j = start(clique), start(clique + 1) - 1
               if (members(i) > 0 .and. members(j) > 0) coupled(members(i), members(j)) = .true.
            end do
         end do
      end do
      call check(count(coupled) > 3*n, 'the cliques couple something')
      call check(csr_entries(matrix) == count(coupled), 'as many entries as couplings')
      call check(size(matrix%column) == csr_entries(matrix) .and. size(matrix%value) == csr_entries(matrix), 'no slack')
      do row = 1, n
         do column = 1, n
            call check((csr_position(matrix, row, column) > 0) .eqv. coupled(row, column), 'entry where coupled')
         end do
         associate (columns => matrix%column(matrix%row_start(row):matrix%row_start(row + 1) - 1))
            call check(all(columns(2:) > columns(:size(columns) - 1)), 'columns ascend')
         end associate
      end do
   end subroutine members_of_a_clique_are_coupled

   subroutine an_unknown_alone_keeps_its_diagonal()
      type(csr_matrix_t) :: matrix

      call pattern_from_cliques(3, [1, 3], [3, 1], matrix)
      call check(all(matrix%row_start == [1, 3, 4, 6]), 'rows of two, one and two entries')
      call check(all(matrix%column == [1, 3, 2, 1, 3]), 'unknown 2 is coupled with itself alone')
   end subroutine an_unknown_alone_keeps_its_diagonal

   subroutine a_pattern_without_unknowns_is_empty()
      type(csr_matrix_t) :: matrix, never_set

      call pattern_from_cliques(0, [1], [integer ::], matrix)
      call check(csr_entries(matrix) == 0 .and. all(matrix%row_start == [1]), 'no unknowns, no entries')
      call check(csr_entries(never_set) == 0, 'a matrix never set has no entries')
   end subroutine a_pattern_without_unknowns_is_empty

   subroutine transpose_and_products_agree_with_dense_ones()
      type(csr_matrix_t) :: matrix, transposed
      real(dp) :: x(7), y(5), expected(5), a(5, 7)
      integer :: row

      matrix%n_rows = 5
      matrix%n_columns = 7
      matrix%row_start = [1, 3, 3, 6, 7, 9]
      matrix%column = [2, 7, 1, 3, 4, 5, 1, 7]
      matrix%value = [1.0_dp, -2.0_dp, 3.0_dp, 4.0_dp, -5.0_dp, 6.0_dp, 7.0_dp, 8.0_dp]
      a = dense(matrix)
      call random_number(x)
      call csr_multiply(matrix, x, y)
      call check(maxval(abs(y - matmul(a, x))) < 1.0e-14_dp, 'A x')
      expected = y - 3*matmul(a, x)
      call csr_add_product(matrix, -3.0_dp, x, y)
      call check(maxval(abs(y - expected)) < 1.0e-14_dp, 'y - 3 A x')
      call csr_transpose(matrix, transposed)
      call check(transposed%n_rows == 7 .and. transposed%n_columns == 5, 'shape of the transpose')
      call check(maxval(abs(dense(transposed) - transpose(a))) < tiny(1.0_dp), 'values of the transpose')
      do row = 1, 7
         associate (columns => transposed%column(transposed%row_start(row):transposed%row_start(row + 1) - 1))
            call check(all(columns(2:) > columns(:size(columns) - 1)), 'columns of the transpose ascend')
         end associate
      end do
   end subroutine transpose_and_products_agree_with_dense_ones

   !> A chain numbered at random has bandwidth 1 again, whatever vertex the search starts from.
   subroutine a_shuffled_chain_is_put_in_order()
      type(csr_matrix_t) :: graph
      integer :: label(n), order(n), position(n), i

      label = shuffled()
      call pattern_from_cliques(n, [(2*i - 1, i=1, n)], [(label(i), label(i + 1), i=1, n - 1)], graph)
      call reverse_cuthill_mckee(graph, order)
      position(order) = [(i, i=1, n)]
      call check(all(abs(position(label(2:)) - position(label(:n - 1))) == 1), 'neighbours stand side by side')
   end subroutine a_shuffled_chain_is_put_in_order

   subroutine loose_parts_are_all_ordered()
      type(csr_matrix_t) :: graph
      integer :: order(n), seen(n), i

      call pattern_from_cliques(n, [1, 4, 6, 10], [1, 20, 40, 3, 39, 5, 7, 9, 11], graph)
      call reverse_cuthill_mckee(graph, order)
      seen = 0
      do i = 1, n
         seen(order(i)) = seen(order(i)) + 1
      end do
      call check(all(seen == 1), 'every vertex has one place')
   end subroutine loose_parts_are_all_ordered

   subroutine scaling_gives_a_positive_definite_matrix_unit_diagonal()
      type(csr_matrix_t) :: matrix
      real(dp) :: scale(2)

      call pattern_from_cliques(2, [1, 3], [1, 2], matrix)
      matrix%value = [3.0e8_dp, 1.0e2_dp, 1.0e2_dp, 5.0e-4_dp]
      call equilibrate(matrix, scale)
      call check(all(scale**2*[3.0e8_dp, 5.0e-4_dp] > 0.24_dp), 'diagonal not far below one')
      call check(all(scale**2*[3.0e8_dp, 5.0e-4_dp] <= 1), 'diagonal one at most')
      call check(all(abs(fraction(scale) - 0.5_dp) < tiny(1.0_dp)), 'powers of two')
   end subroutine scaling_gives_a_positive_definite_matrix_unit_diagonal

   subroutine scaling_bounds_an_indefinite_matrix()
      type(csr_matrix_t) :: matrix
      real(dp) :: scale(2)

      call pattern_from_cliques(2, [1, 3], [1, 2], matrix)
      matrix%value = [1.0e-6_dp, 1.0e3_dp, 1.0e3_dp, 2.0_dp]
      call equilibrate(matrix, scale)
      call check(scale(1)*1.0e3_dp*scale(2) <= 1, 'off-diagonal one at most')
      call check(scale(1)*1.0e3_dp*scale(2) > 0.24_dp, 'off-diagonal not far below one')
   end subroutine scaling_bounds_an_indefinite_matrix

   function shuffled() result(label)
      integer :: label(n), i, j, kept
      real(dp) :: draw

      label = [(i, i=1, n)]
      do i = n, 2, -1
         call random_number(draw)
         j = 1 + int(draw*i)
         kept = label(i)
         label(i) = label(j)
         label(j) = kept
      end do
   end function shuffled

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

   subroutine check(condition, what)
      logical, intent(in) :: condition
      character(len=*), intent(in) :: what

      if (condition) return
      failures = failures + 1
      print '(2a)', 'failed: ', what
   end subroutine check

   !> The same numbers in every run.
   subroutine start_random_numbers()
      integer :: length, k

      call random_seed(size=length)
      call random_seed(put=[(1000 + 17*k, k=1, length)])
   end subroutine start_random_numbers

end program test_sparse_pattern
