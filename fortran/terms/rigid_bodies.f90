!> Rigid bodies: dependent nodes, which move with a reference node.
!>
!> Displacements of dependent nodes are no unknowns, nor are rotations of tied ones: `x = x_r + R_r (X - X_r)`,
!> `R = R_r`. Source: theory section 11.
module litz_rigid_bodies
   use litz_kinds, only: dp
   use litz_fields, only: first_slot, last_slot, field_displacement, field_rotation, motion_slots
   use litz_model, only: model_t
   use litz_positions, only: agree
   use litz_rotations, only: cross, identity3, skew
   implicit none
   private
   public :: rigid_bodies_t, new_rigid_bodies

   integer, parameter :: u_1 = first_slot(field_displacement), u_3 = last_slot(field_displacement)
   integer, parameter :: r_1 = first_slot(field_rotation), r_3 = last_slot(field_rotation)

   type :: rigid_bodies_t
      !> All dependent nodes
      integer, allocatable :: dependents(:)
      !> Node that each node moves with (n_nodes); 0: none
      integer, allocatable :: reference(:)
      !> Its rotation is that of the reference node, too (n_nodes)
      logical, allocatable :: tied(:)
   contains
      procedure :: last_slot_of
      procedure :: place
      procedure :: carry
      procedure :: jacobian
      procedure :: extend_cliques
   end type rigid_bodies_t

contains

   !> Those of a model.
   pure type(rigid_bodies_t) function new_rigid_bodies(model) result(bodies)
      type(model_t), intent(in) :: model
      integer :: i

      allocate (bodies%dependents(0))
      allocate (bodies%reference(model%n_nodes), source=0)
      allocate (bodies%tied(model%n_nodes), source=.false.)
      do i = 1, size(model%rigid_bodies)
         associate (body => model%rigid_bodies(i))
            bodies%dependents = [bodies%dependents, body%tied, body%pinned]
            bodies%reference([body%tied, body%pinned]) = body%reference_node
            bodies%tied(body%tied) = .true.
         end associate
      end do
   end function new_rigid_bodies

   !> The last slot of a dependent node that is no unknown; all slots of motion before it are none either.
   pure integer function last_slot_of(self, node) result(slot)
      class(rigid_bodies_t), intent(in) :: self
      !> One of the dependent nodes
      integer, intent(in) :: node

      slot = merge(r_3, u_3, self%tied(node))
   end function last_slot_of

   !> Put all dependent nodes where their reference nodes take them: exactly, whatever the way there.
   pure subroutine place(self, x_reference, start, x, rotation, value, change)
      class(rigid_bodies_t), intent(in) :: self
      !> Positions in the reference configuration (3, n_nodes) [m]
      real(dp), intent(in) :: x_reference(:, :)
      !> Values of all unknowns when the increment began (n_slots, n_nodes)
      real(dp), intent(in) :: start(:, :)
      !> Positions (3, n_nodes) [m] and rotations from the reference configuration (3, 3, n_nodes)
      real(dp), intent(inout) :: x(:, :), rotation(:, :, :)
      !> Values of all unknowns, and their change since the increment began (n_slots, n_nodes)
      real(dp), intent(inout) :: value(:, :), change(:, :)
      real(dp) :: arm(3)
      integer :: i

      do i = 1, size(self%dependents)
         associate (node => self%dependents(i), r => self%reference(self%dependents(i)))
            arm = x_reference(:, node) - x_reference(:, r)
            x(:, node) = x(:, r) + matmul(rotation(:, :, r), arm)
            value(u_1:u_3, node) = value(u_1:u_3, r) + matmul(rotation(:, :, r) - identity3, arm)
            call agree(x_reference(:, node), x(:, node), value(u_1:u_3, node))
            change(u_1:u_3, node) = value(u_1:u_3, node) - start(u_1:u_3, node)
            if (.not. self%tied(node)) cycle
            rotation(:, :, node) = rotation(:, :, r)
            value(r_1:r_3, node) = value(r_1:r_3, r)
            change(r_1:r_3, node) = change(r_1:r_3, r)
         end associate
      end do
   end subroutine place

   !> Small motions of dependent nodes, from those of their reference nodes.
   pure subroutine carry(self, x, motion)
      class(rigid_bodies_t), intent(in) :: self
      !> Present positions (3, n_nodes) [m]
      real(dp), intent(in) :: x(:, :)
      !> Displacements and spins (n_slots, n_nodes) [m, rad]
      real(dp), intent(inout) :: motion(:, :)
      integer :: i

      do i = 1, size(self%dependents)
         associate (node => self%dependents(i), r => self%reference(self%dependents(i)))
            motion(u_1:u_3, node) = motion(u_1:u_3, r) + cross(motion(r_1:r_3, r), x(:, node) - x(:, r))
            if (self%tied(node)) motion(r_1:r_3, node) = motion(r_1:r_3, r)
         end associate
      end do
   end subroutine carry

   !> `J` in `dq = J dq_r`: motion of a dependent node from that of its reference node; its free rotations have no rows.
   pure function jacobian(self, x, node) result(j)
      class(rigid_bodies_t), intent(in) :: self
      !> Present positions (3, n_nodes) [m]
      real(dp), intent(in) :: x(:, :)
      !> One of the dependent nodes
      integer, intent(in) :: node
      real(dp) :: j(motion_slots(2), motion_slots(2))

      j = 0
      j(u_1:u_3, u_1:u_3) = identity3
      j(u_1:u_3, r_1:r_3) = -skew(x(:, node) - x(:, self%reference(node)))
      if (self%tied(node)) j(r_1:r_3, r_1:r_3) = identity3
   end function jacobian

   !> What ties dependent nodes to others ties their reference nodes to them, too.
   pure subroutine extend_cliques(self, start, members)
      class(rigid_bodies_t), intent(in) :: self
      !> Where each group of nodes begins among the members, and one more (n_groups + 1); nodes of all groups
      integer, allocatable, intent(inout) :: start(:), members(:)
      integer, allocatable :: longer_start(:), longer(:)
      integer :: i, n

      allocate (longer_start(size(start)), longer(size(members) + count(self%reference(members) > 0)))
      n = 0
      do i = 1, size(start) - 1
         longer_start(i) = n + 1
         associate (nodes => members(start(i):start(i + 1) - 1))
            longer(n + 1:n + size(nodes)) = nodes
            n = n + size(nodes)
            associate (references => pack(self%reference(nodes), self%reference(nodes) > 0))
               longer(n + 1:n + size(references)) = references
               n = n + size(references)
            end associate
         end associate
      end do
      longer_start(size(start)) = n + 1
      call move_alloc(longer_start, start)
      call move_alloc(longer, members)
   end subroutine extend_cliques

end module litz_rigid_bodies
