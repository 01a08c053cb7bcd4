!> Work of forces on the closest points of two axes: its exact tangent over the 24 mechanical unknowns.
!>
!> The closest points fulfil `f = [-x'.w; xb'.w] = 0`, so that `X = dxi/dp = -M^-1 f_p`, and forces `tau` on
!> (xi, xib) have the residual `R = X^T tau = f_p^T mu` with `mu = -M^-1 tau`. With `Phi = mu . f`:
!> `K = Phi_pp + Phi_pxi X + X^T Phi_xip + X^T Phi_xixi X + X^T dtau`.
module litz_closest_point_motion
   use litz_kinds, only: dp
   use litz_axis, only: axis_shape, axis_third_derivative, on_axis, axis_row
   use litz_contact_kinematics, only: contact_kinematics_t
   use litz_rotations, only: identity3
   implicit none
   private
   public :: axis_point_t, axis_point, tangent_of_closest_points, add_turning_tangent

   !> Weights and derivatives of one axis at its closest point, 0th to 3rd.
   type :: axis_point_t
      real(dp) :: h(4, 0:3) = 0
      !> x, x', x'', x''' [m]
      real(dp) :: x(3, 0:3) = 0
   end type axis_point_t

contains

   !> `K = d(tau^T X)/dp` for given `tau` and `dtau`.
   pure function tangent_of_closest_points(kinematics, a, b, t, tau, dtau) result(k)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Unbarred and barred axis at the closest points
      type(axis_point_t), intent(in) :: a, b
      !> Unit tangents of the nodes (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: t(3, 4)
      !> Forces on (xi, xib) [N m], and their derivatives (24, 2)
      real(dp), intent(in) :: tau(2), dtau(24, 2)
      real(dp) :: k(24, 24)
      real(dp) :: mu(2), w(3), left(24, 10), right(24, 10), moves(24, 2), phi_p_xi(24, 2), phi_xi_xi(2, 2)
      integer :: i

      w = kinematics%distance*kinematics%normal
      mu = -matmul(kinematics%between_q, tau)                                             ! mu = -M^-1 tau
      moves(:, 1) = kinematics%rows%dxi
      moves(:, 2) = kinematics%rows%dxi_bar
      call second_derivatives(a, b, t, w, mu, left, right, phi_p_xi, phi_xi_xi)
      left(:, 7:8) = phi_p_xi
      right(:, 7:8) = moves
      left(:, 9:10) = moves
      right(:, 9:10) = phi_p_xi + matmul(moves, phi_xi_xi) + dtau
      k = matmul(left, transpose(right))
      do i = 1, 2
         ! the force that Phi has on the nodal tangents: of the barred, then of the unbarred wire
         call add_turning_tangent(t(:, i), mu(2)*b%h(2*i, 1)*w + b%h(2*i, 0)*(mu(2)*b%x(:, 1) - mu(1)*a%x(:, 1)), &
            6*i - 2, k)
         call add_turning_tangent(t(:, 2 + i), -mu(1)*a%h(2*i, 1)*w + a%h(2*i, 0)*(mu(1)*a%x(:, 1) - mu(2)*b%x(:, 1)), &
            12 + 6*i - 2, k)
      end do
   end function tangent_of_closest_points

   pure type(axis_point_t) function axis_point(axis, length, xi, x, t) result(point)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> Reference length [m]
      real(dp), intent(in) :: length
      !> Place in the element
      real(dp), intent(in) :: xi
      !> Nodal positions (3, 2) [m]
      real(dp), intent(in) :: x(3, 2)
      !> Unit tangents of the nodes (3, 2)
      real(dp), intent(in) :: t(3, 2)
      integer :: order

      call axis_shape(axis, length, xi, point%h(:, 0), point%h(:, 1), point%h(:, 2))
      point%h(:, 3) = axis_third_derivative(axis, length)
      do order = 0, 3
         point%x(:, order) = on_axis(point%h(:, order), x, t)
      end do
   end function axis_point

   !> Second derivatives of `Phi = -mu1 x'.w + mu2 xb'.w` over positions and tangents `p` and the places (xi, xib).
   pure subroutine second_derivatives(a, b, t, w, mu, left, right, phi_p_xi, phi_xi_xi)
      type(axis_point_t), intent(in) :: a, b
      !> Unit tangents of the nodes (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: t(3, 4)
      !> Vector from the unbarred to the barred closest point [m]
      real(dp), intent(in) :: w(3)
      !> Factors of the two conditions, `-M^-1 tau` [N/m]
      real(dp), intent(in) :: mu(2)
      !> Columns 1 to 6: `Phi_pp = left right^T` = Z^T S + S^T Z with `Z = -mu1 S1 + mu2 Sb1`
      real(dp), intent(inout) :: left(24, 10), right(24, 10)
      !> Mixed derivatives, over `p` (24) and (xi, xib)
      real(dp), intent(out) :: phi_p_xi(24, 2)
      !> Derivatives over (xi, xib) twice [N m]
      real(dp), intent(out) :: phi_xi_xi(2, 2)
      real(dp) :: across
      integer :: i

      do i = 1, 3
         left(:, i) = [axis_row(b%h(:, 1), t(:, 1:2), mu(2)*identity3(:, i)), &
            axis_row(a%h(:, 1), t(:, 3:4), -mu(1)*identity3(:, i))]                       ! Z
         right(:, i) = [axis_row(b%h(:, 0), t(:, 1:2), identity3(:, i)), &
            axis_row(a%h(:, 0), t(:, 3:4), -identity3(:, i))]                             ! S
      end do
      left(:, 4:6) = right(:, 1:3)
      right(:, 4:6) = left(:, 1:3)

      phi_p_xi(1:12, 1) = -mu(1)*axis_row(b%h(:, 0), t(:, 1:2), a%x(:, 2)) &
         - mu(2)*axis_row(b%h(:, 1), t(:, 1:2), a%x(:, 1))
      phi_p_xi(13:24, 1) = mu(1)*(axis_row(a%h(:, 0), t(:, 3:4), a%x(:, 2)) &
         + 2*axis_row(a%h(:, 1), t(:, 3:4), a%x(:, 1)) - axis_row(a%h(:, 2), t(:, 3:4), w)) &
         - mu(2)*axis_row(a%h(:, 1), t(:, 3:4), b%x(:, 1))
      phi_p_xi(1:12, 2) = mu(2)*(axis_row(b%h(:, 0), t(:, 1:2), b%x(:, 2)) &
         + 2*axis_row(b%h(:, 1), t(:, 1:2), b%x(:, 1)) + axis_row(b%h(:, 2), t(:, 1:2), w)) &
         - mu(1)*axis_row(b%h(:, 1), t(:, 1:2), a%x(:, 1))
      phi_p_xi(13:24, 2) = -mu(2)*axis_row(a%h(:, 0), t(:, 3:4), b%x(:, 2)) &
         - mu(1)*axis_row(a%h(:, 1), t(:, 3:4), b%x(:, 1))

      across = -mu(1)*dot_product(a%x(:, 2), b%x(:, 1)) - mu(2)*dot_product(a%x(:, 1), b%x(:, 2))
      phi_xi_xi(1, 1) = mu(1)*(3*dot_product(a%x(:, 1), a%x(:, 2)) - dot_product(a%x(:, 3), w)) &
         - mu(2)*dot_product(a%x(:, 2), b%x(:, 1))
      phi_xi_xi(2, 2) = mu(2)*(3*dot_product(b%x(:, 1), b%x(:, 2)) + dot_product(b%x(:, 3), w)) &
         - mu(1)*dot_product(a%x(:, 1), b%x(:, 2))
      phi_xi_xi(1, 2) = across
      phi_xi_xi(2, 1) = across
   end subroutine second_derivatives

   !> A nodal tangent turns with its node while the force on it stays: `t f^T - (t.f) 1` (theory section 3).
   pure subroutine add_turning_tangent(t, f, first, k)
      !> Unit tangent of the node
      real(dp), intent(in) :: t(3)
      !> Generalised force on it [N m]
      real(dp), intent(in) :: f(3)
      !> First rotation unknown of the node
      integer, intent(in) :: first
      !> Tangent (24, 24), added to
      real(dp), intent(inout) :: k(24, 24)
      integer :: j

      do j = 1, 3
         k(first:first + 2, first + j - 1) = k(first:first + 2, first + j - 1) + t*f(j) &
            - dot_product(t, f)*identity3(:, j)
      end do
   end subroutine add_turning_tangent

end module litz_closest_point_motion
