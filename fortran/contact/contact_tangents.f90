!> The tangents at the nodes with which the axis of an element touches others: those of its centre line.
!>
!> A node carries the normal of the section there. In an element without shear it is the tangent of the centre line; in
!> a shear-flexible one the centre line is turned against it by the shear angle, which is constant in the element. A
!> node has the mean of its two elements, so that the axis has no kink there.
!>
!> The angle is that of a state in balance: while the iteration goes there the tangents turn with their nodes, like
!> those of elements without shear. So the gap depends on the unknowns of two elements only, and its derivatives are
!> exact. Where the iteration has converged the angle is updated, and it continues until the forces balance with it.
!>
!> Source: theory section 3.
module litz_contact_tangents
   use litz_kinds, only: dp
   use litz_axis, only: axis_polynomial
   use litz_axis_choices, only: axis_hermite
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_wires, only: wires_t
   implicit none
   private
   public :: follow_centre_line, axis_of_element

contains

   !> Set `wires%contact_tangents0` by a state in balance.
   pure subroutine follow_centre_line(model, elements, x, rotation, wires)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations from the reference (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(wires_t), intent(inout) :: wires
      integer :: e, side

      if (.not. any(elements%shear_flexible)) return
      do e = 1, model%n_elements
         do side = 1, 2
            wires%contact_tangents0(:, side, e) = centre_line_tangent(model, wires, elements, e, side, x, rotation)
         end do
      end do
   end subroutine follow_centre_line

   !> The axis of an element in powers of xi (3, 0:3) [m].
   pure function axis_of_element(model, wires, elements, e, x, rotation) result(p)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      real(dp) :: p(3, 0:3), t(3, 2)
      integer :: side

      do side = 1, 2
         t(:, side) = matmul(rotation(:, :, model%connectivity(side, e)), wires%contact_tangents0(:, side, e))
      end do
      p = axis_polynomial(axis_hermite, elements%length(e), x(:, model%connectivity(:, e)), t)
   end function axis_of_element

   !> Unit tangent of the centre line at one end of an element, turned back by the rotation of the node.
   pure function centre_line_tangent(model, wires, elements, e, side, x, rotation) result(tangent)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Element, and 1 or 2: its first or second node
      integer, intent(in) :: e, side
      !> Positions (3, n_nodes) [m] and rotations from the reference (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      real(dp) :: tangent(3), shear(3)
      integer :: other

      associate (turned => rotation(:, :, model%connectivity(side, e)))
         shear = shear_since_reference(model, wires, elements, e, x, rotation, turned)
         other = wires%next(side, e)
         if (other /= 0) then
            shear = (shear + wires%direction(e)*wires%direction(other) &
               *shear_since_reference(model, wires, elements, other, x, rotation, turned))/2
         end if
      end associate
      tangent = wires%triads0(:, 1, side, e) + shear
      tangent = tangent/norm2(tangent)
   end function centre_line_tangent

   !> By how much the chord of an element has turned against the normals of its sections since the reference, where a
   !> curved wire has tangents that need not agree with its chords; as seen in a section that has turned by `turned`.
   !> Zero in an element without shear.
   pure function shear_since_reference(model, wires, elements, e, x, rotation, turned) result(shear)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      !> Positions (3, n_nodes) [m] and rotations from the reference (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      !> Rotation from the reference (3, 3)
      real(dp), intent(in) :: turned(3, 3)
      real(dp) :: shear(3), normals0(3, 2), normals(3, 2)
      integer :: side

      shear = 0
      if (.not. elements%shear_flexible(e)) return
      normals0 = wires%triads0(:, 1, :, e)
      associate (node => model%connectivity(:, e))
         do side = 1, 2
            normals(:, side) = matmul(rotation(:, :, node(side)), normals0(:, side))
         end do
         shear = matmul(transpose(turned), shear_vector(x(:, node), normals, elements%length(e))) &
            - shear_vector(model%x(:, node), normals0, elements%length(e))
      end associate
   end function shear_since_reference

   !> Part of the chord per length that is perpendicular to the mean of the normals.
   pure function shear_vector(ends, normals, length) result(shear)
      !> Positions [m] and unit normals of the sections at the two nodes (3, 2)
      real(dp), intent(in) :: ends(3, 2), normals(3, 2)
      !> Reference length [m]
      real(dp), intent(in) :: length
      real(dp) :: shear(3), mean(3)

      mean = sum(normals, 2)/2
      shear = (ends(:, 2) - ends(:, 1))/length
      shear = shear - mean*(dot_product(mean, shear)/max(dot_product(mean, mean), tiny(1.0_dp)))
   end function shear_vector

end module litz_contact_tangents
