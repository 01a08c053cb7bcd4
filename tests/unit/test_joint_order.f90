!> Order of elimination: along the wires, the joints last.
program test_joint_order
   use, intrinsic :: iso_c_binding, only: c_int64_t
   use litz_elimination_order, only: find_elimination_order
   use litz_errors, only: error_t
   use litz_joint_order, only: joint_graph_t, find_joints, joints_last
   use litz_linear_solver, only: csr_matrix_t
   use litz_sparse_pattern, only: pattern_from_cliques
   implicit none

   integer :: failures = 0

   call wires_between_two_joints_fill_no_more_than_their_joints()
   call rows_of_a_node_stay_together()
   call rings_ends_and_single_nodes_are_ordered_too()
   call a_wire_is_one_edge_between_its_joints()
   if (failures > 0) error stop 1

contains

   !> Four wires of seven inner nodes from node 1 to node 2. Along a wire every node has three entries in its column:
   !> itself, the next node, the joint at which the elimination began; the joints have two and one.
   subroutine wires_between_two_joints_fill_no_more_than_their_joints()
      integer, parameter :: wires = 4, inner = 7
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error
      integer(c_int64_t), allocatable :: order(:)
      integer, allocatable :: ends(:)
      integer :: wire, i, before

      allocate (ends(0))
      do wire = 1, wires
         before = 1
         do i = 1, inner
            ! numbered across the wires, so that neighbours along a wire are not neighbours in number
            ends = [ends, before, 2 + wire + wires*(i - 1)]
            before = 2 + wire + wires*(i - 1)
         end do
         ends = [ends, before, 2]
      end do
      call graph_of(2 + wires*inner, ends, matrix)
      call find_elimination_order(matrix, order, error)
      call check(.not. allocated(error), 'there is an order')
      call check(is_permutation(int(order) + 1), 'every equation once')
      call check(all(order(size(order) - 1:) < 2), 'the joints come last')
      call check(factor_entries(matrix, int(order) + 1) == 3*wires*inner + 3, 'entries of the factor')
   end subroutine wires_between_two_joints_fill_no_more_than_their_joints

   !> A star of three bars with three unknowns at each node.
   subroutine rows_of_a_node_stay_together()
      integer, parameter :: m = 3
      type(csr_matrix_t) :: matrix
      type(joint_graph_t) :: graph
      integer, allocatable :: order(:)
      integer :: i, bar

      call pattern_from_cliques(4*m, [(2*m*(bar - 1) + 1, bar=1, 4)], &
         [([(i, i=1, m), (m*bar + i, i=1, m)], bar=1, 3)], matrix)
      graph = find_joints(matrix)
      call check(all(graph%first_row == [1, 4, 7, 10, 13]), 'nodes of three rows')
      call check(size(graph%joints) == 1 .and. all(graph%joints == 1), 'the centre is the joint')
      order = joints_last(graph, [1])
      call check(all(order == [4, 5, 6, 7, 8, 9, 10, 11, 12, 1, 2, 3]), 'bars, then the centre')
   end subroutine rows_of_a_node_stay_together

   !> A closed ring (1 to 5), a wire with free ends (6 to 8), a node without neighbours (9), alone and beside a star (10
   !> to 13) with a joint.
   subroutine rings_ends_and_single_nodes_are_ordered_too()
      integer, parameter :: loose(14) = [1, 2, 2, 3, 3, 4, 4, 5, 5, 1, 6, 7, 7, 8]
      type(csr_matrix_t) :: matrix
      type(error_t), allocatable :: error
      integer(c_int64_t), allocatable :: order(:)

      call graph_of(9, loose, matrix)
      call find_elimination_order(matrix, order, error)
      call check(.not. allocated(error) .and. is_permutation(int(order) + 1), 'every equation once, without joints')
      call graph_of(13, [loose, 10, 11, 10, 12, 10, 13], matrix)
      call find_elimination_order(matrix, order, error)
      call check(.not. allocated(error) .and. is_permutation(int(order) + 1), 'every equation once, beside a joint')
   end subroutine rings_ends_and_single_nodes_are_ordered_too

   !> Four joints, each wired to the others by 0 or 1 or 2 inner nodes, and a loop of three nodes at joint 1.
   subroutine a_wire_is_one_edge_between_its_joints()
      type(csr_matrix_t) :: matrix
      type(joint_graph_t) :: graph

      call graph_of(13, [1, 5, 5, 6, 6, 2, 1, 7, 7, 3, 1, 8, 8, 4, 2, 9, 9, 3, 2, 4, 3, 10, 10, 4, 1, 11, 11, 12, 12, &
         13, 13, 1], matrix)
      graph = find_joints(matrix)
      call check(all(graph%joints == [1, 2, 3, 4]), 'four joints')
      call check(size(graph%inner) == 9 .and. is_permutation([graph%joints, graph%inner]), 'nine inner nodes')
      call check(all(graph%edges%row_start == [1, 4, 7, 10, 13]), 'each joint with the three others')
   end subroutine a_wire_is_one_edge_between_its_joints

   !> Pattern of nodes joined by edges.
   subroutine graph_of(n, ends, matrix)
      integer, intent(in) :: n, ends(:)
      type(csr_matrix_t), intent(out) :: matrix
      integer :: i

      call pattern_from_cliques(n, [(2*i - 1, i=1, size(ends)/2 + 1)], ends, matrix)
   end subroutine graph_of

   !> Entries below and on the diagonal after an elimination that is followed entry by entry.
   integer function factor_entries(matrix, order) result(entries)
      type(csr_matrix_t), intent(in) :: matrix
      integer, intent(in) :: order(:)
      logical :: filled(matrix%n_rows, matrix%n_rows)
      integer :: i, k

      filled = .false.
      do i = 1, matrix%n_rows
         filled(matrix%column(matrix%row_start(i):matrix%row_start(i + 1) - 1), i) = .true.
      end do
      filled = filled(order, order)
      entries = 0
      do k = 1, matrix%n_rows
         entries = entries + count(filled(k:, k))
         do i = k + 1, matrix%n_rows
            if (filled(i, k)) filled(k + 1:, i) = filled(k + 1:, i) .or. filled(k + 1:, k)
         end do
      end do
   end function factor_entries

   pure logical function is_permutation(order)
      integer, intent(in) :: order(:)
      integer :: i

      is_permutation = all([(count(order == i) == 1, i=1, size(order))])
   end function is_permutation

   subroutine check(condition, what)
      logical, intent(in) :: condition
      character(len=*), intent(in) :: what

      if (condition) return
      failures = failures + 1
      print '(2a)', 'failed: ', what
   end subroutine check

end program test_joint_order
