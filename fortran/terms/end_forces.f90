!> Section forces of an element at its nodes, from the forces that it and what acts on its length put on them.
!>
!> The sum of these over beam and loads is what the rest of the wire feels there: so bending moments at a node are those
!> of statics whatever the element, and the same from both sides where nothing acts on the node itself.
module litz_end_forces
   use litz_kinds, only: dp
   use litz_beam_axes, only: at_section_centres
   use litz_domain, only: domain_t
   implicit none
   private
   public :: forces_at_ends, nodal_state

contains

   !> `-R1^T f1, -R1^T m1, R2^T f2, R2^T m2` in the sections of the nodes; the moments at the centres of the section.
   pure function forces_at_ends(domain, element, force) result(ends)
      type(domain_t), intent(in) :: domain
      !> Index of the element
      integer, intent(in) :: element
      !> Internal forces and moments on its nodes (12) [N, N m]
      real(dp), intent(in) :: force(12)
      !> N, Q2, Q3, T, M2, M3 at the first node, then at the second (12) [N, N m]
      real(dp) :: ends(12)
      real(dp) :: x(3, 2), triads(3, 3, 2)

      call nodal_state(domain, element, x, triads)
      ends(1:3) = -matmul(force(1:3), triads(:, :, 1))
      ends(4:6) = -matmul(force(4:6), triads(:, :, 1))
      ends(7:9) = matmul(force(7:9), triads(:, :, 2))
      ends(10:12) = matmul(force(10:12), triads(:, :, 2))
      associate (axes => domain%elements%axes(element))
         if (axes%plain) return
         ends(1:6) = at_section_centres(axes, ends(1:6))
         ends(7:12) = at_section_centres(axes, ends(7:12))
      end associate
   end function forces_at_ends

   !> Positions and triads of the nodes of an element at the present iterate.
   pure subroutine nodal_state(domain, element, x, triads)
      type(domain_t), intent(in) :: domain
      !> Index of the element
      integer, intent(in) :: element
      !> Positions (3, node) [m], and triads (3, axis, node): tangent, first, second section axis
      real(dp), intent(out) :: x(3, 2), triads(3, 3, 2)
      integer :: side

      associate (node => domain%model%connectivity(:, element))
         do side = 1, 2
            x(:, side) = domain%iterate%x(:, node(side))
            triads(:, :, side) = matmul(domain%iterate%rotation(:, :, node(side)), &
               domain%wires%triads0(:, :, side, element))
         end do
      end associate
   end subroutine nodal_state

end module litz_end_forces
