!> Curvature of the axes of wires that has no jump at nodes, as that of the elements has.
!>
!> At a node it is a mean of both elements by which straight stays straight, between nodes a cubic without a slope at
!> them. Source: theory section 10, at (10.14a).
module litz_axis_curvature
   use litz_kinds, only: dp
   use litz_axis, only: axis_shape, on_axis
   use litz_contact_bending, only: risen
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_wires, only: wires_t
   implicit none
   private
   public :: axis_curvature, curvature_at_nodes

contains

   !> At a place of an element (3) [1/m].
   pure function axis_curvature(model, wires, elements, axis, e, xi, x, rotation) result(curvature)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> `axis_linear` or `axis_hermite`, and the element
      integer, intent(in) :: axis, e
      !> -1 to 1
      real(dp), intent(in) :: xi
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      real(dp) :: curvature(3), at_nodes(3, 2), tangents(3, 2)

      at_nodes = curvature_at_nodes(model, wires, elements, axis, e, x, rotation)
      tangents = tangents_of(model, wires, e, rotation)
      associate (u => risen(xi))
         curvature = at_nodes(:, 1) + u*(at_nodes(:, 2) - at_nodes(:, 1))
         ! the mean of two vectors that an arc turns is shorter than they are
         curvature = curvature/norm2(tangents(:, 1) + u*(tangents(:, 2) - tangents(:, 1)))
      end associate
   end function axis_curvature

   !> At both nodes of an element (3, 2) [1/m].
   pure function curvature_at_nodes(model, wires, elements, axis, e, x, rotation) result(curvature)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> `axis_linear` or `axis_hermite`, and the element
      integer, intent(in) :: axis, e
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      real(dp) :: curvature(3, 2), there
      integer :: side, next

      do side = 1, 2
         next = wires%next(side, e)
         curvature(:, side) = own_curvature(model, wires, elements, axis, e, real(2*side - 3, dp), x, rotation)
         if (next == 0) cycle
         there = merge(-1.0_dp, 1.0_dp, model%connectivity(1, next) == model%connectivity(side, e))
         curvature(:, side) = mean_of(curvature(:, side), own_curvature(model, wires, elements, axis, next, there, x, &
            rotation))
      end do
   end function curvature_at_nodes

   !> Of the element itself (3) [1/m].
   pure function own_curvature(model, wires, elements, axis, e, xi, x, rotation) result(curvature)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> `axis_linear` or `axis_hermite`, and the element
      integer, intent(in) :: axis, e
      !> -1 to 1
      real(dp), intent(in) :: xi
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      real(dp) :: curvature(3), h(4), h1(4), h2(4), t(3, 2), x1(3)

      call axis_shape(axis, elements%length(e), xi, h, h1, h2)
      t = tangents_of(model, wires, e, rotation)
      associate (nodes => model%connectivity(:, e))
         x1 = on_axis(h1, x(:, nodes), t)
         curvature = on_axis(h2, x(:, nodes), t)
      end associate
      curvature = (curvature - x1*dot_product(x1, curvature)/dot_product(x1, x1))/dot_product(x1, x1)
   end function own_curvature

   !> Unit tangents at both nodes of an element (3, 2).
   pure function tangents_of(model, wires, e, rotation) result(t)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      !> Element
      integer, intent(in) :: e
      !> (3, 3, n_nodes)
      real(dp), intent(in) :: rotation(:, :, :)
      real(dp) :: t(3, 2)
      integer :: i

      do i = 1, 2
         t(:, i) = matmul(rotation(:, :, model%connectivity(i, e)), wires%contact_tangents0(:, i, e))
      end do
   end function tangents_of

   !> Of two vectors (3), weighted by the size of the other one: none where one of them is none, or they are opposite,
   !> so that what is straight stays so beside a bend.
   pure function mean_of(a, b) result(mean)
      !> (3)
      real(dp), intent(in) :: a(3), b(3)
      real(dp) :: mean(3), sizes(2)

      sizes = [norm2(a), norm2(b)]
      mean = (sizes(2)*a + sizes(1)*b)/max(sum(sizes), tiny(sizes))
   end function mean_of

end module litz_axis_curvature
