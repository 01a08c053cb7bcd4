!> Numbering of the free unknowns and the sparse pattern they make.
!>
!> The free unknowns of a node are numbered one after the other, and all rows of a node have the same columns. So a
!> node pair is found by one offset within its rows, and an element or a contact scatters whole node blocks.
module litz_equations
   use litz_kinds, only: dp, int64
   use litz_errors, only: error_t
   use litz_linear_solver, only: csr_matrix_t, system_matrix_t
   use litz_sparse_pattern, only: pattern_from_cliques, check_entries
   implicit none
   private
   public :: equations_t, number_equations, build_system, block_offset

   type :: equations_t
      integer :: n_mechanical = 0, n_electric = 0
      !> Equation of each mechanical unknown (6, n_nodes) and of each potential (n_nodes); 0: prescribed or absent
      integer, allocatable :: mechanical(:, :), electric(:)
      !> Free mechanical unknowns of each node (n_nodes)
      integer, allocatable :: n_free(:)
      !> Neighbours of each node, itself included, ascending
      type(csr_matrix_t) :: nodes
      !> Position within a row of `mm`, `me`, `ee` where the block of a neighbour begins (entries of `nodes`)
      integer, allocatable :: offset_mechanical(:), offset_electric(:)
   end type equations_t

contains

   pure subroutine number_equations(fixed, has_rotation, has_potential, equations)
      !> Prescribed unknowns (7, n_nodes)
      logical, intent(in) :: fixed(:, :)
      !> Nodes that belong to a beam, and to a conductor (n_nodes)
      logical, intent(in) :: has_rotation(:), has_potential(:)
      type(equations_t), intent(inout) :: equations
      integer :: node, i, n

      n = size(fixed, 2)
      if (allocated(equations%mechanical)) deallocate (equations%mechanical, equations%electric, equations%n_free)
      allocate (equations%mechanical(6, n), equations%electric(n), equations%n_free(n), source=0)
      equations%n_mechanical = 0
      equations%n_electric = 0
      do node = 1, n
         do i = 1, 6
            if (fixed(i, node) .or. .not. has_rotation(node)) cycle
            equations%n_mechanical = equations%n_mechanical + 1
            equations%mechanical(i, node) = equations%n_mechanical
            equations%n_free(node) = equations%n_free(node) + 1
         end do
         if (fixed(7, node) .or. .not. has_potential(node)) cycle
         equations%n_electric = equations%n_electric + 1
         equations%electric(node) = equations%n_electric
      end do
   end subroutine number_equations

   !> Patterns of the three blocks from the groups of nodes that share an element or may share a contact.
   subroutine build_system(clique_start, clique_nodes, equations, matrix, error)
      !> (n + 1) and members: nodes of group i are `clique_nodes(clique_start(i):clique_start(i + 1) - 1)`
      integer, intent(in) :: clique_start(:), clique_nodes(:)
      type(equations_t), intent(inout) :: equations
      type(system_matrix_t), intent(inout) :: matrix
      !> There are more entries than can be counted
      type(error_t), allocatable, intent(out) :: error
      integer(int64) :: entries
      integer :: n, node

      n = size(equations%n_free)
      call pattern_from_cliques(n, clique_start, clique_nodes, equations%nodes, entries)
      ! each node brings one equation at least
      call check_entries(n, entries, error)
      if (allocated(error)) return
      entries = 0
      do node = 1, n
         associate (first => equations%nodes%row_start(node), last => equations%nodes%row_start(node + 1) - 1)
            entries = entries &
               + int(equations%n_free(node), int64)*sum(equations%n_free(equations%nodes%column(first:last)))
         end associate
      end do
      call check_entries(equations%n_mechanical, entries, error)
      if (allocated(error)) return
      call place_blocks(equations)
      call expand(equations, .true., .true., matrix%mm)
      call expand(equations, .false., .true., matrix%me)
      call expand(equations, .false., .false., matrix%ee)
   end subroutine build_system

   pure subroutine place_blocks(equations)
      type(equations_t), intent(inout) :: equations
      integer :: node, k, m, e

      if (allocated(equations%offset_mechanical)) deallocate (equations%offset_mechanical, equations%offset_electric)
      allocate (equations%offset_mechanical(size(equations%nodes%column)))
      allocate (equations%offset_electric(size(equations%nodes%column)))
      do node = 1, equations%nodes%n_rows
         m = 0
         e = 0
         do k = equations%nodes%row_start(node), equations%nodes%row_start(node + 1) - 1
            equations%offset_mechanical(k) = m
            equations%offset_electric(k) = e
            m = m + equations%n_free(equations%nodes%column(k))
            if (equations%electric(equations%nodes%column(k)) > 0) e = e + 1
         end do
      end do
   end subroutine place_blocks

   !> One block of the system: mechanical or electric rows, mechanical or electric columns.
   pure subroutine expand(equations, mechanical_rows, mechanical_columns, matrix)
      type(equations_t), intent(in) :: equations
      logical, intent(in) :: mechanical_rows, mechanical_columns
      type(csr_matrix_t), intent(inout) :: matrix
      integer, allocatable :: width(:), rows_of_node(:)
      integer :: node, k, row, i, position, neighbour

      matrix%n_rows = merge(equations%n_mechanical, equations%n_electric, mechanical_rows)
      matrix%n_columns = merge(equations%n_mechanical, equations%n_electric, mechanical_columns)
      allocate (width, source=merge(equations%n_free, merge(1, 0, equations%electric > 0), mechanical_columns))
      allocate (rows_of_node, source=merge(equations%n_free, merge(1, 0, equations%electric > 0), mechanical_rows))
      if (allocated(matrix%row_start)) deallocate (matrix%row_start, matrix%column, matrix%value)
      allocate (matrix%row_start(matrix%n_rows + 1))
      row = 0
      position = 1
      do node = 1, size(width)
         do i = 1, rows_of_node(node)
            row = row + 1
            matrix%row_start(row) = position
            do k = equations%nodes%row_start(node), equations%nodes%row_start(node + 1) - 1
               position = position + width(equations%nodes%column(k))
            end do
         end do
      end do
      matrix%row_start(matrix%n_rows + 1) = position
      allocate (matrix%column(position - 1))
      allocate (matrix%value(position - 1), source=0.0_dp)
      position = 1
      do node = 1, size(width)
         do row = 1, rows_of_node(node)
            do k = equations%nodes%row_start(node), equations%nodes%row_start(node + 1) - 1
               neighbour = equations%nodes%column(k)
               if (mechanical_columns) then
                  do i = 1, 6
                     if (equations%mechanical(i, neighbour) == 0) cycle
                     matrix%column(position) = equations%mechanical(i, neighbour)
                     position = position + 1
                  end do
               else if (equations%electric(neighbour) > 0) then
                  matrix%column(position) = equations%electric(neighbour)
                  position = position + 1
               end if
            end do
         end do
      end do
   end subroutine expand

   !> Entry of the node graph that holds the neighbour; the offsets are stored there.
   pure integer function block_offset(equations, node, neighbour) result(entry)
      type(equations_t), intent(in) :: equations
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
