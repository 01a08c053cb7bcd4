!> Interpolation of an element's axis between its two nodes, straight or cubic.
!>
!> Source: theory section 3. `x(xi) = h(1) x1 + h(2) t1 + h(3) x2 + h(4) t2`, in the order in which the unknowns of
!> the nodes stand; a straight axis has `h(2) = h(4) = 0`.
module litz_axis
   use litz_kinds, only: dp
   use litz_laws, only: axis_hermite
   implicit none
   private
   public :: axis_shape, axis_polynomial

contains

   !> Weights of positions and tangents, and their derivatives with respect to xi.
   pure subroutine axis_shape(axis, length, xi, h, h1, h2)
      !> `axis_linear` or `axis_hermite` of litz_laws
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

   !> The same curve in powers of xi: `x(xi) = p0 + p1 xi + p2 xi^2 + p3 xi^3`.
   pure function axis_polynomial(axis, length, x, t) result(p)
      !> `axis_linear` or `axis_hermite` of litz_laws
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

end module litz_axis
