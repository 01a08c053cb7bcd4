!> Order of elimination for wires that meet at joints: inside a wire node by node, then the joints.
!>
!> A node with two neighbours is eliminated without any fill but the edge between them, and a wire of many elements
!> leaves one edge between its joints. What is left is a small graph, which a method of nested dissection orders in
!> less time, and better, than the equations one by one.
module litz_joint_order
   use litz_linear_solver, only: csr_matrix_t
   implicit none
   private
   public :: joint_graph_t, find_joints, joints_last

   type :: joint_graph_t
      !> First row of each node, and one past the last (nodes + 1); the rows of a node have the same columns
      integer, allocatable :: first_row(:)
      !> Nodes with at most two neighbours, as they are to be eliminated; none if no node has more
      integer, allocatable :: inner(:)
      !> All other nodes, ascending
      integer, allocatable :: joints(:)
      !> Pattern (joints, joints) of those with an edge or a wire between them, without the diagonal
      type(csr_matrix_t) :: edges
   end type joint_graph_t

contains

   pure type(joint_graph_t) function find_joints(matrix) result(found)
      !> Structurally symmetric pattern
      type(csr_matrix_t), intent(in) :: matrix
      type(csr_matrix_t) :: nodes
      !> Place of a node among the joints; 0: inner
      integer, allocatable :: joint(:)
      integer :: i

      call group_rows(matrix, found%first_row, nodes)
      associate (degree => nodes%row_start(2:) - nodes%row_start(:nodes%n_rows))
         found%joints = pack([(i, i=1, nodes%n_rows)], degree > 2 .or. all(degree <= 2))
      end associate
      allocate (joint(nodes%n_rows), source=0)
      joint(found%joints) = [(i, i=1, size(found%joints))]
      call follow_wires(nodes, joint, found)
   end function find_joints

   !> Rows one after the other with the same columns are a node; `nodes` is the graph of these, without the diagonal.
   pure subroutine group_rows(matrix, first_row, nodes)
      type(csr_matrix_t), intent(in) :: matrix
      !> First row of each node, and one past the last (nodes + 1)
      integer, allocatable, intent(out) :: first_row(:)
      type(csr_matrix_t), intent(out) :: nodes
      integer :: node_of(matrix%n_rows), row, node, k, last, n

      n = 0
      do row = 1, matrix%n_rows
         if (.not. continues_node(matrix, row)) n = n + 1
         node_of(row) = n
      end do
      allocate (first_row(n + 1))
      first_row(node_of(matrix%n_rows:1:-1)) = [(row, row=matrix%n_rows, 1, -1)]
      first_row(n + 1) = matrix%n_rows + 1
      nodes%n_rows = n
      nodes%n_columns = n
      associate (start => matrix%row_start)
         allocate (nodes%row_start(n + 1), nodes%column(sum(start(first_row(:n) + 1) - start(first_row(:n)))))
      end associate
      nodes%row_start(1) = 1
      n = 0
      do node = 1, nodes%n_rows
         last = 0
         do k = matrix%row_start(first_row(node)), matrix%row_start(first_row(node) + 1) - 1
            if (node_of(matrix%column(k)) == last) cycle
            last = node_of(matrix%column(k))
            if (last == node) cycle
            n = n + 1
            nodes%column(n) = last
         end do
         nodes%row_start(node + 1) = n + 1
      end do
      nodes%column = nodes%column(:n)
   end subroutine group_rows

   pure logical function continues_node(matrix, row) result(same)
      type(csr_matrix_t), intent(in) :: matrix
      !> Whose columns are compared with those of the row before
      integer, intent(in) :: row

      same = .false.
      if (row == 1) return
      associate (start => matrix%row_start, column => matrix%column)
         if (start(row + 1) - start(row) /= start(row) - start(row - 1)) return
         same = all(column(start(row):start(row + 1) - 1) == column(start(row - 1):start(row) - 1))
      end associate
   end function continues_node

   !> From each joint along its wires to the joints at their other ends.
   pure subroutine follow_wires(nodes, joint, found)
      type(csr_matrix_t), intent(in) :: nodes
      !> Place of each node among the joints; 0: inner (nodes)
      integer, intent(in) :: joint(:)
      type(joint_graph_t), intent(inout) :: found
      logical :: taken(nodes%n_rows)
      integer :: last_seen(size(found%joints)), column(size(nodes%column))
      integer :: i, k, n, n_inner, here, before, next

      allocate (found%inner(nodes%n_rows - size(found%joints)))
      allocate (found%edges%row_start(size(found%joints) + 1))
      found%edges%n_rows = size(found%joints)
      found%edges%n_columns = size(found%joints)
      found%edges%row_start(1) = 1
      taken = joint > 0
      last_seen = 0
      n = 0
      n_inner = 0
      do i = 1, size(found%joints)
         last_seen(i) = i
         do k = nodes%row_start(found%joints(i)), nodes%row_start(found%joints(i) + 1) - 1
            before = found%joints(i)
            here = nodes%column(k)
            do while (joint(here) == 0)
               if (.not. taken(here)) then
                  n_inner = n_inner + 1
                  found%inner(n_inner) = here
                  taken(here) = .true.
               end if
               next = next_along(nodes, before, here)
               if (next == 0) exit
               before = here
               here = next
            end do
            if (joint(here) == 0) cycle
            if (last_seen(joint(here)) == i) cycle
            last_seen(joint(here)) = i
            n = n + 1
            column(n) = joint(here)
         end do
         found%edges%row_start(i + 1) = n + 1
      end do
      found%edges%column = column(:n)
      ! wires that meet no joint
      found%inner(n_inner + 1:) = pack([(i, i=1, nodes%n_rows)], .not. taken)
   end subroutine follow_wires

   !> The neighbour of an inner node on its other side; 0: the wire ends.
   pure integer function next_along(nodes, before, here) result(next)
      type(csr_matrix_t), intent(in) :: nodes
      !> Node from which one comes, and inner node at which one is
      integer, intent(in) :: before, here
      integer :: k

      next = 0
      do k = nodes%row_start(here), nodes%row_start(here + 1) - 1
         if (nodes%column(k) /= before) next = nodes%column(k)
      end do
   end function next_along

   !> `order(new) = old` for the rows of the matrix.
   pure function joints_last(found, joint_order) result(order)
      type(joint_graph_t), intent(in) :: found
      !> `joint_order(new) = old` for the joints
      integer, intent(in) :: joint_order(:)
      integer, allocatable :: order(:)
      integer :: sequence(size(found%inner) + size(joint_order)), i, n, row

      sequence = [found%inner, found%joints(joint_order)]
      allocate (order(found%first_row(size(found%first_row)) - 1))
      n = 0
      do i = 1, size(sequence)
         do row = found%first_row(sequence(i)), found%first_row(sequence(i) + 1) - 1
            n = n + 1
            order(n) = row
         end do
      end do
   end function joints_last

end module litz_joint_order
