!> Tangents of cells whose unknowns linear equations eliminate, in the unknowns of these equations.
!>
!> With `q = C q'` a cell of tangent `K` gives `C^T K C`: its rows and columns of eliminated unknowns have no equations,
!> those of the others in their equations are those of a larger cell. Source: theory section 17.
module litz_constrained_cells
   use litz_kinds, only: dp
   use litz_equations, only: equations_t
   use litz_fields, only: motion_slots
   use litz_linear_constraints, only: linear_constraints_t
   use litz_linear_solver, only: csr_matrix_t
   use litz_scatter, only: scatter_tangent
   implicit none
   private
   public :: all_slots, scatter_constrained

contains

   !> Add what a cell with eliminated unknowns gives to the rows and columns of others; its own rows and columns have
   !> been added.
   subroutine scatter_constrained(equations, constraints, nodes, rows, columns, k, matrix)
      type(equations_t), intent(in) :: equations
      type(linear_constraints_t), intent(in) :: constraints
      !> Nodes of the cell (nodes)
      integer, intent(in) :: nodes(:)
      !> First and last slot of the equations and of the unknowns of each node (2)
      integer, intent(in) :: rows(2), columns(2)
      !> Tangent (slots of rows x nodes, slots of columns x nodes)
      real(dp), intent(in) :: k(:, :)
      !> Block of the group of the rows and the group of the columns
      type(csr_matrix_t), intent(inout) :: matrix
      real(dp), allocatable :: larger(:, :)
      integer, allocatable :: all_nodes(:)
      integer :: n_rows, n_columns

      if (.not. any(constraints%has_any(nodes))) return
      all_nodes = [nodes, masters(rows), masters(columns)]
      if (size(all_nodes) == size(nodes)) return
      larger = matmul(transpose(chain(rows)), matmul(k, chain(columns)))
      n_rows = size(nodes)*width_of(rows)
      n_columns = size(nodes)*width_of(columns)
      larger(:n_rows, :n_columns) = 0
      call scatter_tangent(equations, all_nodes, all_slots(rows), all_slots(columns), larger, matrix)

   contains

      !> Nodes of the terms of all equations that eliminate some of these slots.
      pure function masters(slots) result(found)
         !> First and last slot (2)
         integer, intent(in) :: slots(2)
         integer, allocatable :: found(:)
         integer :: a, slot

         allocate (found(0))
         do a = 1, size(nodes)
            if (.not. constraints%has_any(nodes(a))) cycle
            do slot = slots(1), slots(2)
               associate (i => constraints%of(slot, nodes(a)))
                  if (i > 0) found = [found, constraints%master_node(constraints%start(i):constraints%start(i + 1) - 1)]
               end associate
            end do
         end do
      end function masters

      !> `C`: unknowns of the nodes of the cell, from those of the larger one.
      pure function chain(slots) result(c)
         !> First and last slot of each node (2)
         integer, intent(in) :: slots(2)
         !> (slots x nodes, slots of the larger cell x its nodes)
         real(dp), allocatable :: c(:, :)
         integer :: wide(2), n, width, a, slot, place, term

         wide = all_slots(slots)
         n = slots(2) - slots(1) + 1
         width = wide(2) - wide(1) + 1
         allocate (c(n*size(nodes), width*size(all_nodes)), source=0.0_dp)
         do a = 1, size(nodes)
            do slot = slots(1), slots(2)
               associate (row => (a - 1)*n + slot - slots(1) + 1, i => constraints%of(slot, nodes(a)))
                  c(row, (a - 1)*width + slot - wide(1) + 1) = 1
                  if (i == 0) cycle
                  do term = constraints%start(i), constraints%start(i + 1) - 1
                     place = size(nodes) + findloc(all_nodes(size(nodes) + 1:), constraints%master_node(term), 1)
                     associate (column => (place - 1)*width + constraints%master_slot(term) - wide(1) + 1)
                        c(row, column) = c(row, column) + constraints%weight(term)
                     end associate
                  end do
               end associate
            end do
         end do
      end function chain

   end subroutine scatter_constrained

   !> Slots of the nodes that motions depend on: equations may have all motions in them, and a displacement takes the
   !> rotations of a reference node along.
   pure function all_slots(slots) result(wide)
      !> First and last slot (2)
      integer, intent(in) :: slots(2)
      integer :: wide(2)

      wide = slots
      if (slots(2) <= motion_slots(2)) wide = motion_slots
   end function all_slots

   pure integer function width_of(slots) result(width)
      !> First and last slot (2)
      integer, intent(in) :: slots(2)
      integer :: wide(2)

      wide = all_slots(slots)
      width = wide(2) - wide(1) + 1
   end function width_of

end module litz_constrained_cells
