!> Numbers of the free unknowns, and the sparse matrices of their equations.
!>
!> The free unknowns of a node are numbered one after the other within their group of fields, and all rows of a node
!> have the same columns. So a pair of nodes is found by one offset within its rows, and a cell scatters whole blocks.
module litz_equations
   use litz_kinds, only: dp, int64
   use litz_errors, only: error_t
   use litz_fields, only: n_slots, n_groups, first_slot_of_group, last_slot_of_group, depends_on
   use litz_linear_solver, only: csr_matrix_t
   use litz_sparse_pattern, only: pattern_from_cliques, check_entries
   implicit none
   private
   public :: equations_t, system_t, number_equations, build_system, block_offset

   type :: equations_t
      !> Equations of each group of fields
      integer :: count(n_groups) = 0
      !> Equation of each unknown within its group (n_slots, n_nodes); 0: prescribed or absent
      integer, allocatable :: number(:, :)
      !> Free unknowns of each group at each node (n_groups, n_nodes)
      integer, allocatable :: n_free(:, :)
      !> Neighbours of each node, itself included, ascending
      type(csr_matrix_t) :: nodes
      !> Position within a row where the columns of a neighbour begin, by the group of the columns
      !> (n_groups, entries of `nodes`)
      integer, allocatable :: offset(:, :)
   contains
      procedure :: gather
      procedure :: spread_to_nodes
   end type equations_t

   !> The tangent over the free unknowns, by groups of fields.
   type :: system_t
      !> Rows of the first group, columns of the second one; no rows where the first does not depend on the second
      type(csr_matrix_t) :: block(n_groups, n_groups)
      !> The values of the block of a group with itself are symmetric
      logical :: symmetric(n_groups) = .true.
      !> Friction alone makes the block of motions unsymmetric, and no moment about a fixed axis or load that turns: its
      !> pivots count negative eigenvalues all the same
      logical :: unsymmetric_by_friction = .false.
      !> The part of the block of motions that couples the slip of contacts to their normal forces, by the limit of
      !> friction: of rank one for each contact that slips, and far from symmetric. Rows and values only; no values
      !> where nothing slips
      type(csr_matrix_t) :: slip_coupling
      !> The blocks of what groups do to those before them are there, too
      logical :: is_two_way = .false.
   contains
      procedure :: has_block
   end type system_t

contains

   !> Number the unknowns that exist and are not prescribed.
   pure subroutine number_equations(fixed, exists, equations)
      !> Prescribed unknowns, and those that a cell of the node asks for (n_slots, n_nodes)
      logical, intent(in) :: fixed(:, :), exists(:, :)
      type(equations_t), intent(inout) :: equations
      integer :: node, slot, group, n

      n = size(fixed, 2)
      if (allocated(equations%number)) deallocate (equations%number, equations%n_free)
      allocate (equations%number(n_slots, n), equations%n_free(n_groups, n), source=0)
      equations%count = 0
      do node = 1, n
         do group = 1, n_groups
            do slot = first_slot_of_group(group), last_slot_of_group(group)
               if (fixed(slot, node) .or. .not. exists(slot, node)) cycle
               equations%count(group) = equations%count(group) + 1
               equations%number(slot, node) = equations%count(group)
               equations%n_free(group, node) = equations%n_free(group, node) + 1
            end do
         end do
      end do
   end subroutine number_equations

   !> Entries of the free unknowns of a group, from values of all nodes.
   pure function gather(self, group, nodal) result(entries)
      class(equations_t), intent(in) :: self
      !> One of the groups of litz_fields
      integer, intent(in) :: group
      !> (n_slots, n_nodes)
      real(dp), intent(in) :: nodal(:, :)
      !> (equations of the group)
      real(dp) :: entries(self%count(group))
      integer :: node, slot

      do node = 1, size(nodal, 2)
         do slot = first_slot_of_group(group), last_slot_of_group(group)
            if (self%number(slot, node) > 0) entries(self%number(slot, node)) = nodal(slot, node)
         end do
      end do
   end function gather

   !> Set the values of the free unknowns of a group; others stay.
   pure subroutine spread_to_nodes(self, group, entries, nodal)
      class(equations_t), intent(in) :: self
      !> One of the groups of litz_fields
      integer, intent(in) :: group
      !> (equations of the group)
      real(dp), intent(in) :: entries(:)
      !> (n_slots, n_nodes)
      real(dp), intent(inout) :: nodal(:, :)
      integer :: node, slot

      do node = 1, size(nodal, 2)
         do slot = first_slot_of_group(group), last_slot_of_group(group)
            if (self%number(slot, node) > 0) nodal(slot, node) = entries(self%number(slot, node))
         end do
      end do
   end subroutine spread_to_nodes

   !> Patterns of all blocks from the groups of nodes that share an element or may share a contact.
   subroutine build_system(clique_start, clique_nodes, equations, matrix, error)
      !> (n + 1) and members: nodes of clique i are `clique_nodes(clique_start(i):clique_start(i + 1) - 1)`
      integer, intent(in) :: clique_start(:), clique_nodes(:)
      type(equations_t), intent(inout) :: equations
      type(system_t), intent(inout) :: matrix
      !> There are more entries than can be counted
      type(error_t), allocatable, intent(out) :: error
      integer(int64) :: entries
      integer :: n, node, row_group, column_group

      n = size(equations%number, 2)
      call pattern_from_cliques(n, clique_start, clique_nodes, equations%nodes, entries)
      ! each node brings one equation at least
      call check_entries(n, entries, error)
      if (allocated(error)) return
      do row_group = 1, n_groups
         entries = 0
         do node = 1, n
            associate (first => equations%nodes%row_start(node), last => equations%nodes%row_start(node + 1) - 1, &
               n_free => equations%n_free(row_group, :))
               entries = entries + int(n_free(node), int64)*sum(n_free(equations%nodes%column(first:last)))
            end associate
         end do
         call check_entries(equations%count(row_group), entries, error)
         if (allocated(error)) return
      end do
      call place_blocks(equations)
      do column_group = 1, n_groups
         do row_group = 1, n_groups
            if (matrix%has_block(row_group, column_group)) call expand(equations, row_group, column_group, &
               matrix%block(row_group, column_group))
         end do
      end do
   end subroutine build_system

   !> The equations of a group have the unknowns of another one in them.
   pure logical function has_block(self, row_group, column_group)
      class(system_t), intent(in) :: self
      !> Groups of the equations and of the unknowns
      integer, intent(in) :: row_group, column_group

      has_block = depends_on(row_group, column_group) .or. self%is_two_way
   end function has_block

   !> Where the columns of each neighbour begin in the rows of a node.
   pure subroutine place_blocks(equations)
      type(equations_t), intent(inout) :: equations
      integer :: node, k, next(n_groups)

      if (allocated(equations%offset)) deallocate (equations%offset)
      allocate (equations%offset(n_groups, size(equations%nodes%column)))
      do node = 1, equations%nodes%n_rows
         next = 0
         do k = equations%nodes%row_start(node), equations%nodes%row_start(node + 1) - 1
            equations%offset(:, k) = next
            next = next + equations%n_free(:, equations%nodes%column(k))
         end do
      end do
   end subroutine place_blocks

   !> The pattern of one block of the system.
   pure subroutine expand(equations, row_group, column_group, matrix)
      type(equations_t), intent(in) :: equations
      !> Groups of the equations and of the unknowns
      integer, intent(in) :: row_group, column_group
      type(csr_matrix_t), intent(inout) :: matrix
      integer :: node, k, row, i, slot, position

      matrix%n_rows = equations%count(row_group)
      matrix%n_columns = equations%count(column_group)
      if (allocated(matrix%row_start)) deallocate (matrix%row_start, matrix%column, matrix%value)
      allocate (matrix%row_start(matrix%n_rows + 1))
      row = 0
      position = 1
      do node = 1, equations%nodes%n_rows
         do i = 1, equations%n_free(row_group, node)
            row = row + 1
            matrix%row_start(row) = position
            do k = equations%nodes%row_start(node), equations%nodes%row_start(node + 1) - 1
               position = position + equations%n_free(column_group, equations%nodes%column(k))
            end do
         end do
      end do
      matrix%row_start(matrix%n_rows + 1) = position
      allocate (matrix%column(position - 1))
      allocate (matrix%value(position - 1), source=0.0_dp)
      position = 1
      do node = 1, equations%nodes%n_rows
         do i = 1, equations%n_free(row_group, node)
            do k = equations%nodes%row_start(node), equations%nodes%row_start(node + 1) - 1
               do slot = first_slot_of_group(column_group), last_slot_of_group(column_group)
                  associate (number => equations%number(slot, equations%nodes%column(k)))
                     if (number == 0) cycle
                     matrix%column(position) = number
                     position = position + 1
                  end associate
               end do
            end do
         end do
      end do
   end subroutine expand

   !> Entry of the node graph that holds the neighbour; the offsets are stored there.
   pure integer function block_offset(equations, node, neighbour) result(entry)
      type(equations_t), intent(in) :: equations
      !> Two nodes that share a cell
      integer, intent(in) :: node, neighbour
      integer :: low, high

      low = equations%nodes%row_start(node)
      high = equations%nodes%row_start(node + 1) - 1
      do while (low < high)
         entry = (low + high)/2
         if (equations%nodes%column(entry) < neighbour) then
            low = entry + 1
         else
            high = entry
         end if
      end do
      entry = low
   end function block_offset

end module litz_equations
