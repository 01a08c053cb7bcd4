!> Interpolation of an element's axis between its two nodes, straight or cubic.
!>
!> Source: theory section 3. `x(xi) = h(1) x1 + h(2) t1 + h(3) x2 + h(4) t2`, in the order in which the unknowns of
!> the nodes stand; a straight axis has `h(2) = h(4) = 0`.
module litz_axis
   use litz_kinds, only: dp
   use litz_axis_choices, only: axis_hermite
   use litz_rotations, only: cross
   implicit none
   private
   public :: axis_shape, axis_third_derivative, axis_polynomial, axis_sagitta, axis_turning, on_axis, axis_row

contains

   !> Weights of positions and tangents, and their derivatives with respect to xi.
   pure subroutine axis_shape(axis, length, xi, h, h1, h2)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer, intent(in) :: axis
      !> Reference length L0 [m]
      real(dp), intent(in) :: length
      !> Place in the element; the element itself is [-1, 1]
      real(dp), intent(in) :: xi
      !> Weights of x1 [-], t1 [m], x2 [-], t2 [m]; first and second derivatives
      real(dp), intent(out) :: h(4), h1(4), h2(4)
      real(dp) :: s

      if (axis == axis_hermite) then
         s = length/2
         h = [(2 - 3*xi + xi**3)/4, s*(1 - xi - xi**2 + xi**3)/4, &
            (2 + 3*xi - xi**3)/4, s*(-1 - xi + xi**2 + xi**3)/4]
         h1 = [(-3 + 3*xi**2)/4, s*(-1 - 2*xi + 3*xi**2)/4, (3 - 3*xi**2)/4, s*(-1 + 2*xi + 3*xi**2)/4]
         h2 = [1.5_dp*xi, s*(-1 + 3*xi)/2, -1.5_dp*xi, s*(1 + 3*xi)/2]
      else
         h = [(1 - xi)/2, 0.0_dp, (1 + xi)/2, 0.0_dp]
         h1 = [-0.5_dp, 0.0_dp, 0.5_dp, 0.0_dp]
         h2 = 0
      end if
   end subroutine axis_shape

   !> Third derivatives of the weights, the same everywhere in the element.
   pure function axis_third_derivative(axis, length) result(h3)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer, intent(in) :: axis
      !> Reference length L0 [m]
      real(dp), intent(in) :: length
      real(dp) :: h3(4)

      h3 = 0
      if (axis == axis_hermite) h3 = [1.5_dp, 0.75_dp*length, -1.5_dp, 0.75_dp*length]
   end function axis_third_derivative

   !> Position, or a derivative of it, with the weights of x1, t1, x2, t2.
   pure function on_axis(weight, x, t) result(point)
      !> Weights (4); positions [m] and unit tangents of the two nodes (3, 2)
      real(dp), intent(in) :: weight(4), x(3, 2), t(3, 2)
      real(dp) :: point(3)

      point = weight(1)*x(:, 1) + weight(2)*t(:, 1) + weight(3)*x(:, 2) + weight(4)*t(:, 2)
   end function on_axis

   !> How the product of a fixed vector `v` with `on_axis` changes with the displacements and spins of the two nodes:
   !> a row over 12 unknowns. A nodal tangent turns with its node, `delta t = dtheta x t`, so that
   !> `v . delta t = (t x v) . dtheta`.
   pure function axis_row(weight, t, v) result(r)
      !> Weights (4), unit tangents of the two nodes (3, 2), and the vector (3)
      real(dp), intent(in) :: weight(4), t(3, 2), v(3)
      real(dp) :: r(12)

      r(1:3) = weight(1)*v
      r(4:6) = weight(2)*cross(t(:, 1), v)
      r(7:9) = weight(3)*v
      r(10:12) = weight(4)*cross(t(:, 2), v)
   end function axis_row

   !> The same curve in powers of xi: `x(xi) = p0 + p1 xi + p2 xi^2 + p3 xi^3`.
   pure function axis_polynomial(axis, length, x, t) result(p)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer, intent(in) :: axis
      !> Reference length L0 [m]
      real(dp), intent(in) :: length
      !> Positions [m] and unit tangents of the two nodes (3, 2)
      real(dp), intent(in) :: x(3, 2), t(3, 2)
      !> Coefficients (3, 0:3) [m]
      real(dp) :: p(3, 0:3)
      real(dp) :: chord(3)

      chord = (x(:, 2) - x(:, 1))/2
      p(:, 0) = (x(:, 1) + x(:, 2))/2
      p(:, 1) = chord
      p(:, 2:3) = 0
      if (axis == axis_hermite) then
         p(:, 2) = length*(t(:, 2) - t(:, 1))/8
         p(:, 3) = (length*(t(:, 1) + t(:, 2))/2 - 2*chord)/4
         p(:, 0) = p(:, 0) - p(:, 2)
         p(:, 1) = p(:, 1) - p(:, 3)
      end if
   end function axis_polynomial

   !> How far an axis can leave its chord [m]: `p2 (xi^2 - 1) + p3 (xi^3 - xi)`.
   pure real(dp) function axis_sagitta(p) result(sagitta)
      !> Axis in powers of xi (3, 0:3) [m]
      real(dp), intent(in) :: p(3, 0:3)

      sagitta = norm2(p(:, 2)) + 2/(3*sqrt(3.0_dp))*norm2(p(:, 3))
   end function axis_sagitta

   !> By what angle the tangent turns along an axis [rad], at most: the sum of all turns, to whichever side.
   !>
   !> The derivative of a cubic is a Bezier curve of three vectors, and its direction turns by no more than those of
   !> these vectors, one after the other. The chord lies between them, so that the polygon of chords turns by no more.
   pure real(dp) function axis_turning(p) result(turning)
      !> Axis in powers of xi (3, 0:3) [m]
      real(dp), intent(in) :: p(3, 0:3)
      real(dp), dimension(3) :: first, middle, last

      first = p(:, 1) - 2*p(:, 2) + 3*p(:, 3)
      middle = p(:, 1) - 3*p(:, 3)
      last = p(:, 1) + 2*p(:, 2) + 3*p(:, 3)
      turning = max(angle_between(first, middle) + angle_between(middle, last), angle_between(first, last))
   end function axis_turning

   pure real(dp) function angle_between(a, b) result(angle)
      !> Two vectors (3)
      real(dp), intent(in) :: a(3), b(3)

      angle = atan2(norm2(cross(a, b)), dot_product(a, b))
   end function angle_between

end module litz_axis
