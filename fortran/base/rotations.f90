!> Finite rotations in three dimensions.
!>
!> Convention of the whole program: a rotation is updated from the left, `R <- exp(delta) R`, with `delta` a rotation
!> vector in global axes [rad]. A spin `dtheta` is the infinitesimal `delta`. This is the one place that updates
!> rotations.
module litz_rotations
   use litz_kinds, only: dp, pi
   implicit none
   private
   public :: cross, skew, identity3, rotation_exp, rotation_log, nearest_rotation_vector
   public :: spin_tangent, spin_tangent_transpose_derivative

   real(dp), parameter :: identity3(3, 3) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp, &
      0.0_dp, 0.0_dp, 1.0_dp], [3, 3])
   !> Below this angle [rad] the trigonometric coefficients come from their Taylor series
   real(dp), parameter :: small_angle = 0.3_dp
   !> Below this angle [rad] round-off decides what the axis of a rotation matrix is
   real(dp), parameter :: no_axis = 1.0e-12_dp

contains

   pure function cross(a, b) result(c)
      !> The factors, in their order
      real(dp), intent(in) :: a(3), b(3)
      real(dp) :: c(3)

      c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
   end function cross

   !> The matrix `a^` with `a^ b = a x b`.
   pure function skew(a) result(s)
      !> Axial vector of the matrix
      real(dp), intent(in) :: a(3)
      real(dp) :: s(3, 3)

      s(:, 1) = [0.0_dp, a(3), -a(2)]
      s(:, 2) = [-a(3), 0.0_dp, a(1)]
      s(:, 3) = [a(2), -a(1), 0.0_dp]
   end function skew

   pure function outer(a, b) result(c)
      !> The factors: `a` gives the rows, `b` the columns
      real(dp), intent(in) :: a(3), b(3)
      real(dp) :: c(3, 3)

      c(:, 1) = a*b(1)
      c(:, 2) = a*b(2)
      c(:, 3) = a*b(3)
   end function outer

   !> Coefficients of `exp(v) = 1 + c1 v^ + c2 v^ v^` and `T(v) = 1 + c2 v^ + c3 v^ v^`, with their derivatives
   !> divided by the angle: `d_i = (dc_i/dangle)/angle`.
   !>
   !> `c1 = sin a/a`, `c2 = (1 - cos a)/a^2`, `c3 = (a - sin a)/a^3`.
   pure subroutine rotation_coefficients(angle, c1, c2, c3, d2, d3)
      !> Length of the rotation vector [rad], not negative
      real(dp), intent(in) :: angle
      !> The coefficients of `exp` and `T`
      real(dp), intent(out) :: c1, c2, c3
      !> Derivatives of `c2` and `c3` with respect to the angle, divided by it [1/rad^2]
      real(dp), intent(out) :: d2, d3
      real(dp) :: q

      q = angle*angle
      if (angle < small_angle) then
         c1 = 1 - q/6*(1 - q/20*(1 - q/42*(1 - q/72*(1 - q/110))))
         c2 = (1 - q/12*(1 - q/30*(1 - q/56*(1 - q/90*(1 - q/132)))))/2
         c3 = (1 - q/20*(1 - q/42*(1 - q/72*(1 - q/110*(1 - q/156)))))/6
         d2 = -(1 - q/15*(1 - 3*q/112*(1 - 2*q/135*(1 - 5*q/528*(1 - 6*q/910)))))/12
         d3 = -(1 - q/21*(1 - q/48*(1 - 2*q/165*(1 - 5*q/624*(1 - 6*q/1050)))))/60
      else
         c1 = sin(angle)/angle
         c2 = (1 - cos(angle))/q
         c3 = (1 - c1)/q
         d2 = (c1 - 2*c2)/q
         d3 = (c2 - 3*c3)/q
      end if
   end subroutine rotation_coefficients

   !> Rotation matrix of a rotation vector [rad]. Source: Euler-Rodrigues formula.
   pure function rotation_exp(v) result(r)
      !> Rotation vector [rad] in global axes
      real(dp), intent(in) :: v(3)
      real(dp) :: r(3, 3)
      real(dp) :: c1, c2, c3, d2, d3

      call rotation_coefficients(norm2(v), c1, c2, c3, d2, d3)
      r = c1*skew(v) + c2*outer(v, v)
      r(1, 1) = r(1, 1) + 1 - c2*(v(2)**2 + v(3)**2) - c2*v(1)**2
      r(2, 2) = r(2, 2) + 1 - c2*(v(1)**2 + v(3)**2) - c2*v(2)**2
      r(3, 3) = r(3, 3) + 1 - c2*(v(1)**2 + v(2)**2) - c2*v(3)**2
   end function rotation_exp

   !> The rotation vector of a matrix that is nearest to a given one, so that it goes on past pi.
   pure function nearest_rotation_vector(rotation, reference) result(vector)
      !> Rotation matrix
      real(dp), intent(in) :: rotation(3, 3)
      !> Rotation vector [rad] to be near to, such as that of the step before
      real(dp), intent(in) :: reference(3)
      real(dp) :: vector(3)
      real(dp) :: angle, axis(3)

      vector = rotation_log(rotation)
      angle = norm2(vector)
      if (angle > no_axis) then
         axis = vector/angle
      else if (norm2(reference) > pi) then
         axis = reference/norm2(reference)
      else
         return
      end if
      vector = (angle + 2*pi*anint((dot_product(axis, reference) - angle)/(2*pi)))*axis
   end function nearest_rotation_vector

   !> Rotation vector [rad] of a rotation matrix, with an angle in [0, pi].
   !>
   !> Goes through the unit quaternion of largest component (Spurrier's choice), so that it is accurate to round-off
   !> for every angle.
   pure function rotation_log(r) result(v)
      !> Rotation matrix: orthogonal, with determinant 1
      real(dp), intent(in) :: r(3, 3)
      real(dp) :: v(3)
      real(dp) :: trace, q0, q(3), length
      integer :: i, j, k

      trace = r(1, 1) + r(2, 2) + r(3, 3)
      i = maxloc([r(1, 1), r(2, 2), r(3, 3)], 1)
      if (trace >= r(i, i)) then
         q0 = 0.5_dp*sqrt(1 + trace)
         q = [r(3, 2) - r(2, 3), r(1, 3) - r(3, 1), r(2, 1) - r(1, 2)]/(4*q0)
      else
         j = mod(i, 3) + 1
         k = mod(j, 3) + 1
         q(i) = sqrt(0.5_dp*r(i, i) + 0.25_dp*(1 - trace))
         q0 = (r(k, j) - r(j, k))/(4*q(i))
         q(j) = (r(j, i) + r(i, j))/(4*q(i))
         q(k) = (r(k, i) + r(i, k))/(4*q(i))
      end if
      if (q0 < 0) then
         q0 = -q0
         q = -q
      end if
      length = norm2(q)
      if (length > 0) then
         v = 2*atan2(length, q0)/length*q
      else
         v = 0
      end if
   end function rotation_log

   !> `T(v)`: the spin that belongs to an additive change of a rotation vector, `dtheta = T(v) dv`.
   !>
   !> Source: `d exp(v) = (T(v) dv)^ exp(v)`, with `T = 1 + c2 v^ + c3 v^ v^`.
   pure function spin_tangent(v) result(t)
      !> Rotation vector [rad]
      real(dp), intent(in) :: v(3)
      real(dp) :: t(3, 3)
      real(dp) :: c1, c2, c3, d2, d3

      call rotation_coefficients(norm2(v), c1, c2, c3, d2, d3)
      t = (1 - c3*dot_product(v, v))*identity3 + c2*skew(v) + c3*outer(v, v)
   end function spin_tangent

   !> `d(T(v)^T m)/dv` at fixed `m`: what an additive rotation vector adds to the tangent of a moment `m`.
   !>
   !> At `v = 0` this is `m^/2`, which turns the spin form of a tangent into the symmetric Hessian of an energy.
   pure function spin_tangent_transpose_derivative(v, m) result(d)
      !> Rotation vector [rad]
      real(dp), intent(in) :: v(3)
      !> Moment [N m] that is held fixed
      real(dp), intent(in) :: m(3)
      real(dp) :: d(3, 3)
      real(dp) :: c1, c2, c3, d2, d3, vxm(3)

      call rotation_coefficients(norm2(v), c1, c2, c3, d2, d3)
      vxm = cross(v, m)
      ! T^T m = m - c2 v x m + c3 (v (v.m) - m (v.v))
      d = c2*skew(m) - d2*outer(vxm, v) + d3*outer(cross(v, vxm), v) &
         + c3*(dot_product(v, m)*identity3 + outer(v, m) - 2*outer(m, v))
   end function spin_tangent_transpose_derivative

end module litz_rotations
