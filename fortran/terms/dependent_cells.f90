!> Tangents of cells at dependent nodes of rigid bodies, in the unknowns of their reference nodes.
!>
!> With `q = C q_r` a cell of tangent `K` gives `C^T K C`. Its rows and columns at dependent nodes have no
!> equations, those at reference nodes are those of a larger cell. Source: theory section 11.
module litz_dependent_cells
   use litz_kinds, only: dp
   use litz_constrained_cells, only: all_slots, scatter_constrained
   use litz_equations, only: equations_t
   use litz_fields, only: motion_slots
   use litz_linear_constraints, only: linear_constraints_t
   use litz_linear_solver, only: csr_matrix_t
   use litz_rigid_bodies, only: rigid_bodies_t
   use litz_scatter, only: scatter_tangent
   implicit none
   private
   public :: scatter_dependent

contains

   !> Add what cells with dependent nodes give to the rows and columns of reference nodes.
   subroutine scatter_dependent(equations, bodies, constraints, x, nodes, rows, columns, k, matrix)
      type(equations_t), intent(in) :: equations
      type(rigid_bodies_t), intent(in) :: bodies
      !> Which unknowns of reference nodes are eliminated
      type(linear_constraints_t), intent(in) :: constraints
      !> Present positions (3, n_nodes) [m]
      real(dp), intent(in) :: x(:, :)
      !> (nodes of a cell, cells)
      integer, intent(in) :: nodes(:, :)
      !> First and last slot of the equations and of the unknowns of each node (2)
      integer, intent(in) :: rows(2), columns(2)
      !> Tangents (slots of rows x nodes, slots of columns x nodes, cells)
      real(dp), intent(in) :: k(:, :, :)
      !> Block of the group of the rows and the group of the columns
      type(csr_matrix_t), intent(inout) :: matrix
      integer :: cell

      do cell = 1, size(nodes, 2)
         if (.not. any(bodies%reference(nodes(:, cell)) > 0)) cycle
         call scatter_one(equations, bodies, constraints, x, nodes(:, cell), rows, columns, k(:, :, cell), matrix)
      end do
   end subroutine scatter_dependent

   !> The nodes of the larger cell are those of the cell and then, for each, its reference node; a node without one
   !> stands in its place, with nothing in its rows and columns.
   subroutine scatter_one(equations, bodies, constraints, x, nodes, rows, columns, k, matrix)
      type(equations_t), intent(in) :: equations
      type(rigid_bodies_t), intent(in) :: bodies
      type(linear_constraints_t), intent(in) :: constraints
      !> Present positions (3, n_nodes) [m]
      real(dp), intent(in) :: x(:, :)
      !> Nodes of the cell (nodes)
      integer, intent(in) :: nodes(:)
      !> First and last slot of the equations and of the unknowns of each node (2)
      integer, intent(in) :: rows(2), columns(2)
      !> Tangent (slots of rows x nodes, slots of columns x nodes)
      real(dp), intent(in) :: k(:, :)
      type(csr_matrix_t), intent(inout) :: matrix
      real(dp), allocatable :: larger(:, :)

      larger = matmul(transpose(chain(bodies, x, nodes, rows)), matmul(k, chain(bodies, x, nodes, columns)))
      ! the cell itself has been added
      larger(:size(larger, 1)/2, :size(larger, 2)/2) = 0
      associate (reference => bodies%reference(nodes))
         associate (all_nodes => [nodes, merge(reference, nodes, reference > 0)])
            call scatter_tangent(equations, all_nodes, all_slots(rows), all_slots(columns), larger, matrix)
            call scatter_constrained(equations, constraints, all_nodes, all_slots(rows), all_slots(columns), larger, &
               matrix)
         end associate
      end associate
   end subroutine scatter_one

   !> `C`: unknowns of the nodes of a cell, from those of the larger cell.
   pure function chain(bodies, x, nodes, slots) result(c)
      type(rigid_bodies_t), intent(in) :: bodies
      !> Present positions (3, n_nodes) [m]
      real(dp), intent(in) :: x(:, :)
      !> Nodes of the cell (nodes)
      integer, intent(in) :: nodes(:)
      !> First and last slot of each node (2)
      integer, intent(in) :: slots(2)
      !> (slots x nodes, slots of the larger cell x 2 nodes)
      real(dp), allocatable :: c(:, :)
      real(dp) :: j(motion_slots(2), motion_slots(2))
      integer :: wide(2), n, width, a, i

      wide = all_slots(slots)
      n = slots(2) - slots(1) + 1
      width = wide(2) - wide(1) + 1
      allocate (c(n*size(nodes), 2*width*size(nodes)), source=0.0_dp)
      do a = 1, size(nodes)
         do i = 1, n
            c((a - 1)*n + i, (a - 1)*width + slots(1) - wide(1) + i) = 1
         end do
         if (bodies%reference(nodes(a)) == 0 .or. .not. is_motion(slots)) cycle
         j = bodies%jacobian(x, nodes(a))
         c((a - 1)*n + 1:a*n, (size(nodes) + a - 1)*width + 1:(size(nodes) + a)*width) = j(slots(1):slots(2), :)
      end do
   end function chain

   pure logical function is_motion(slots)
      !> First and last slot, both of one group of fields (2)
      integer, intent(in) :: slots(2)

      is_motion = slots(2) <= motion_slots(2)
   end function is_motion

end module litz_dependent_cells
