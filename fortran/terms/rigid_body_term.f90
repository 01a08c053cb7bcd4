!> Rigid bodies: forces on dependent nodes act on their reference nodes instead.
!>
!> A force `f` on an arm `a` has the moment `a x f`, which changes as the arm turns: the Hessian of its potential for
!> incremental rotation vectors is `(a f^T + f a^T)/2 - (a . f) 1`. Like the geometric stiffness of beams, it is that of
!> the section forces which the iteration supposes. This term comes after those that make forces on dependent nodes, and
!> before the one that takes moments off the Hessian. Source: theory section 11.
module litz_rigid_body_term
   use litz_kinds, only: dp
   use litz_domain, only: domain_t
   use litz_errors, only: error_t
   use litz_fields, only: first_slot, last_slot, field_displacement, motion_slots, rotation_slots
   use litz_rotations, only: identity3
   use litz_term, only: term_t
   implicit none
   private
   public :: rigid_body_term_t

   type, extends(term_t) :: rigid_body_term_t
   contains
      procedure :: request_slots
      procedure :: evaluate
   end type rigid_body_term_t

contains

   !> The unknowns are those of the reference node.
   subroutine request_slots(self, domain, exists)
      class(rigid_body_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> (n_slots, n_nodes)
      logical, intent(inout) :: exists(:, :)
      integer :: i

      associate (bodies => domain%iterate%bodies)
         do i = 1, size(bodies%dependents)
            associate (node => bodies%dependents(i))
               exists(motion_slots(1):bodies%last_slot_of(node), node) = .false.
               exists(motion_slots(1):motion_slots(2), bodies%reference(node)) = .true.
            end associate
         end do
      end associate
   end subroutine request_slots

   subroutine evaluate(self, domain, error)
      class(rigid_body_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Never
      type(error_t), allocatable, intent(out) :: error
      integer :: i

      if (domain%motions_stand) return
      do i = 1, size(domain%iterate%bodies%dependents)
         call collect(domain, domain%iterate%bodies%dependents(i))
      end do
   end subroutine evaluate

   !> Move the forces on a dependent node to its reference node.
   subroutine collect(domain, node)
      type(domain_t), intent(inout) :: domain
      !> One of the dependent nodes
      integer, intent(in) :: node
      real(dp) :: j(motion_slots(2), motion_slots(2)), k(3, 3)

      associate (bodies => domain%iterate%bodies, forces => domain%forces, x => domain%iterate%x, &
         prescribed => domain%iterate%prescribed, first => rotation_slots(1), last => rotation_slots(2))
         associate (r => bodies%reference(node))
            j = bodies%jacobian(x, node)
            k = hessian_of_moment(x(:, node) - x(:, r), forces%supposed(:, node) &
               + forces%internal(first_slot(field_displacement):last_slot(field_displacement), node))
            call move(forces%internal, j)
            call move(forces%iteration, j)
            call move(forces%prescribed, j)
            call move(forces%sensitivity, abs(j))
            forces%prescribed(first:last, r) = forces%prescribed(first:last, r) + matmul(k, prescribed(first:last, r))
            call domain%add_turning(r, k)
         end associate
      end associate

   contains

      subroutine move(force, jacobian)
         !> (n_slots, n_nodes)
         real(dp), intent(inout) :: force(:, :)
         !> Of the motion of the node by that of its reference node (slots of motion, slots of motion)
         real(dp), intent(in) :: jacobian(:, :)

         associate (bodies => domain%iterate%bodies, own => force(motion_slots(1):motion_slots(2), node), &
            to => force(motion_slots(1):motion_slots(2), domain%iterate%bodies%reference(node)))
            to = to + matmul(transpose(jacobian), own)
            own(:bodies%last_slot_of(node)) = 0
         end associate
      end subroutine move

   end subroutine collect

   !> Second derivative of `f . exp(v) a` by the rotation vector `v` at zero.
   pure function hessian_of_moment(arm, force) result(k)
      !> `a` [m] and `f` [N]
      real(dp), intent(in) :: arm(3), force(3)
      real(dp) :: k(3, 3)

      k = (spread(arm, 2, 3)*spread(force, 1, 3) + spread(force, 2, 3)*spread(arm, 1, 3))/2 &
         - dot_product(arm, force)*identity3
   end function hessian_of_moment

end module litz_rigid_body_term
