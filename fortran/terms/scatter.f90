!> From cells to the system: forces of all unknowns, and the tangent over the free ones.
!>
!> A cell is a group of nodes: an element, a contact, a node by itself. Its equations are those of some slots of each of
!> its nodes, and its tangent has columns of some slots of each: rows of one group of fields, columns of one group.
!> Every thread adds the rows of its own nodes, cell after cell: no row has two writers, and each sum has the same order
!> for any number of threads.
module litz_scatter
   use litz_kinds, only: dp
   use litz_communicator, only: communicator_t
   use litz_equations, only: equations_t, system_t, block_offset
   use litz_fields, only: fields, n_fields, n_slots, field_of_slot, first_slot, last_slot, first_slot_of_group, &
      field_displacement
   use litz_linear_solver, only: csr_matrix_t
   use litz_parallel, only: worth_threads, owned
   implicit none
   private
   public :: forces_t, clear_forces, scatter, scatter_tangent, chunk

   !> Cells evaluated between two scatters: the tangents of elements, and nearly those of contacts, stay in the cache
   integer, parameter :: chunk = 1024

   !> Forces over all unknowns (n_slots, n_nodes): forces, moments, currents that leave the node.
   type :: forces_t
      real(dp), allocatable :: internal(:, :)
      !> What contacts that the prediction and the present gap judge differently add for this iteration only
      real(dp), allocatable :: iteration(:, :)
      !> What the forces on nodes (3, n_nodes) [N] of the section forces that the iteration supposes are beyond the true
      !> ones; only where there are rigid bodies, whose arms feel them
      real(dp), allocatable :: supposed(:, :)
      !> Tangent times the prescribed increments
      real(dp), allocatable :: prescribed(:, :)
      !> Largest nodal force, moment and current of any cell: the reference of convergence
      real(dp) :: reference(n_fields) = 0
      !> How large the unknowns are (n_slots, n_nodes) [m, -, V]: the node's position, 1 for the entries of its
      !> rotation, and the largest potential of any node, because no node's own zero of potential is more than a
      !> convention; now or when the increment began, of which potentials that vanish keep the round-off
      real(dp), allocatable :: magnitude(:, :)
      !> What a relative change of these in every part of the model makes at most of the forces (n_slots, n_nodes): the
      !> sum of `|K| |q|` over the cells at the node. Times epsilon it is the round-off of the residual there
      real(dp), allocatable :: sensitivity(:, :)
   end type forces_t

contains

   !> No cell has added anything yet to the equations of a group and those after it.
   subroutine clear_forces(processes, first_group, x, value, change, forces)
      class(communicator_t), intent(in) :: processes
      !> One of the groups of litz_fields
      integer, intent(in) :: first_group
      !> Positions (3, n_nodes) [m], values of all unknowns (n_slots, n_nodes), and their change since the increment
      !> began
      real(dp), intent(in) :: x(:, :), value(:, :), change(:, :)
      type(forces_t), intent(inout) :: forces
      integer :: field, first, n_nodes

      n_nodes = size(x, 2)
      if (.not. allocated(forces%internal)) then
         allocate (forces%internal(n_slots, n_nodes), forces%iteration(n_slots, n_nodes), &
            forces%prescribed(n_slots, n_nodes), forces%magnitude(n_slots, n_nodes), &
            forces%sensitivity(n_slots, n_nodes))
      end if
      first = first_slot_of_group(first_group)
      forces%internal(first:, :) = 0
      forces%iteration(first:, :) = 0
      forces%prescribed(first:, :) = 0
      forces%sensitivity(first:, :) = 0
      where (fields%group >= first_group) forces%reference = 0
      do field = 1, n_fields
         associate (magnitude => forces%magnitude(first_slot(field):last_slot(field), :))
            if (field == field_displacement) then
               magnitude = spread(maxval(abs(x), 1), 1, size(magnitude, 1))
            else if (fields(field)%is_rotation) then
               magnitude = 1
            else
               associate (now => value(first_slot(field):last_slot(field), :), &
                  since => change(first_slot(field):last_slot(field), :))
                  magnitude = processes%largest(max(maxval(abs(now)), maxval(abs(now - since))))
               end associate
            end if
         end associate
      end do
   end subroutine clear_forces

   !> Add cells: `k` times what is prescribed, how far round-off reaches, and the tangent; with `r` their forces, too.
   subroutine scatter(equations, nodes, rows, columns, k, increment, matrix, forces, r)
      type(equations_t), intent(in) :: equations
      !> (nodes of a cell, cells)
      integer, intent(in) :: nodes(:, :)
      !> First and last slot of the equations and of the unknowns of each node (2)
      integer, intent(in) :: rows(2), columns(2)
      !> Tangents (slots of rows x nodes, slots of columns x nodes, cells)
      real(dp), contiguous, intent(in) :: k(:, :, :)
      !> Prescribed increments (n_slots, n_nodes)
      real(dp), intent(in) :: increment(:, :)
      !> Block of the group of the rows and the group of the columns
      type(csr_matrix_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces
      !> Forces (slots of rows x nodes, cells)
      real(dp), intent(in), optional :: r(:, :)
      real(dp) :: largest(n_fields), dq(size(k, 2)), magnitude(size(k, 2))
      integer :: n_rows, n_columns, cell, a, i, node

      n_rows = rows(2) - rows(1) + 1
      n_columns = columns(2) - columns(1) + 1
      largest = forces%reference
      !$omp parallel private(cell, a, i, node, dq, magnitude) reduction(max: largest) &
      !$omp& if (size(nodes, 2) >= worth_threads)
      do cell = 1, size(nodes, 2)
         do a = 1, size(nodes, 1)
            magnitude((a - 1)*n_columns + 1:a*n_columns) = forces%magnitude(columns(1):columns(2), nodes(a, cell))
            dq((a - 1)*n_columns + 1:a*n_columns) = increment(columns(1):columns(2), nodes(a, cell))
         end do
         do a = 1, size(nodes, 1)
            node = nodes(a, cell)
            if (.not. owned(node)) cycle
            associate (k_a => k((a - 1)*n_rows + 1:a*n_rows, :, cell))
               if (present(r)) then
                  do i = 1, n_rows
                     associate (force => r((a - 1)*n_rows + i, cell), slot => rows(1) - 1 + i)
                        forces%internal(slot, node) = forces%internal(slot, node) + force
                        largest(field_of_slot(slot)) = max(largest(field_of_slot(slot)), abs(force))
                     end associate
                  end do
               end if
               if (any(abs(dq) > 0)) forces%prescribed(rows(1):rows(2), node) = &
                  forces%prescribed(rows(1):rows(2), node) + matmul(k_a, dq)
            end associate
            call add_sensitivity(size(k, 1), size(k, 2), k(:, :, cell), (a - 1)*n_rows, magnitude, &
               forces%sensitivity(rows(1):rows(2), node))
            call scatter_rows(equations, a, nodes(:, cell), rows, columns, k(:, :, cell), matrix)
         end do
      end do
      !$omp end parallel
      forces%reference = largest
   end subroutine scatter

   !> Add the tangent of one cell and nothing else.
   pure subroutine scatter_tangent(equations, nodes, rows, columns, k, matrix)
      type(equations_t), intent(in) :: equations
      !> Nodes of the cell (nodes)
      integer, intent(in) :: nodes(:)
      !> First and last slot of the equations and of the unknowns of each node (2)
      integer, intent(in) :: rows(2), columns(2)
      !> (slots of rows x nodes, slots of columns x nodes)
      real(dp), intent(in) :: k(:, :)
      !> Block of the group of the rows and the group of the columns
      type(csr_matrix_t), intent(inout) :: matrix
      integer :: a

      do a = 1, size(nodes)
         call scatter_rows(equations, a, nodes, rows, columns, k, matrix)
      end do
   end subroutine scatter_tangent

   !> Add `|K| |q|` of the rows of a node of a cell.
   pure subroutine add_sensitivity(n_rows, n_columns, k, before, magnitude, sensitivity)
      !> Size of the tangent of the cell
      integer, intent(in) :: n_rows, n_columns
      !> Tangent of the cell
      real(dp), intent(in) :: k(n_rows, n_columns)
      !> How many of its rows belong to nodes before this one
      integer, intent(in) :: before
      !> How large the unknowns of the cell are (n_columns)
      real(dp), intent(in) :: magnitude(n_columns)
      !> Of the rows of the node (rows)
      real(dp), intent(inout) :: sensitivity(:)
      integer :: i, column

      do column = 1, n_columns
         do i = 1, size(sensitivity)
            sensitivity(i) = sensitivity(i) + abs(k(before + i, column))*magnitude(column)
         end do
      end do
   end subroutine add_sensitivity

   !> Add the rows of node `a` of a cell to the matrix.
   pure subroutine scatter_rows(equations, a, nodes, rows, columns, k, matrix)
      type(equations_t), intent(in) :: equations
      !> Place of the node in the cell, and the nodes of the cell (nodes)
      integer, intent(in) :: a, nodes(:)
      !> First and last slot of the equations and of the unknowns of each node (2)
      integer, intent(in) :: rows(2), columns(2)
      !> Tangent of the cell (slots of rows x nodes, slots of columns x nodes)
      real(dp), intent(in) :: k(:, :)
      type(csr_matrix_t), intent(inout) :: matrix
      integer :: b, i, j, row, position, offset, group, n_columns, k_row, k_column
      logical :: all_free

      if (all(equations%number(rows(1):rows(2), nodes(a)) == 0)) return
      group = fields(field_of_slot(columns(1)))%group
      n_columns = columns(2) - columns(1) + 1
      do b = 1, size(nodes)
         if (equations%n_free(group, nodes(b)) == 0) cycle
         all_free = all(equations%number(columns(1):columns(2), nodes(b)) > 0)
         offset = equations%offset(group, block_offset(equations, nodes(a), nodes(b))) &
            + count(equations%number(first_slot_of_group(group):columns(1) - 1, nodes(b)) > 0)
         k_row = (a - 1)*(rows(2) - rows(1) + 1)
         do i = rows(1), rows(2)
            k_row = k_row + 1
            row = equations%number(i, nodes(a))
            if (row == 0) cycle
            position = matrix%row_start(row) + offset
            k_column = (b - 1)*n_columns
            if (all_free) then
               do j = 1, n_columns
                  matrix%value(position + j - 1) = matrix%value(position + j - 1) + k(k_row, k_column + j)
               end do
               cycle
            end if
            do j = columns(1), columns(2)
               k_column = k_column + 1
               if (equations%number(j, nodes(b)) == 0) cycle
               matrix%value(position) = matrix%value(position) + k(k_row, k_column)
               position = position + 1
            end do
         end do
      end do
   end subroutine scatter_rows

end module litz_scatter
