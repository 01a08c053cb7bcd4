!> Friction at one contact: residual and exact tangent over the 24 mechanical unknowns.
!>
!> The closest points move along the wires by the arc lengths `ds` and `dsb`; the barred wire slips over the other one
!> by `t ds - tb dsb`, a vector in the plane of the two tangents. It is measured in the frame
!> `e1 = (t + tb)/|t + tb|`, `e2 = (t - tb)/|t - tb|`, which is orthonormal at any crossing angle `psi` and turns with
!> the wires: `D1 = cos(psi/2) (ds - dsb)`, `D2 = sin(psi/2) (ds + dsb)`. So friction is isotropic in that plane, and a
!> motion of the whole model changes nothing. A wire that turns about its own axis does not slip in this measure.
!>
!> With the traction `T(D)` of litz_friction_law the residual is the work of `T` in a virtual slip, `R = tau^T dxi/dp`,
!> with the forces on (xi, xib) `tau = [(T1 c + T2 s) L/2; (-T1 c + T2 s) Lb/2]`, `c = cos(psi/2)`, `s = sin(psi/2)`.
!>
!> Source: slip of the closest points as in G. Zavarise, P. Wriggers, Int. J. Numer. Methods Eng. 49 (2000) 977-1006,
!> and P. Litewka, P. Wriggers, Comput. Mech. 28 (2002) 26-39. They let each wire have a friction law of its own along
!> its tangent, which is not isotropic where the wires are not perpendicular; here one law holds for the vector.
!>
!> Tangent: the closest points fulfil `f = [-x'.w; xb'.w] = 0`, so that `dxi/dp = -M^-1 f_p` and `R = f_p^T mu` with
!> `mu = -M^-1 tau`. With `Phi = mu . f` and `X = dxi/dp`:
!> `K = Phi_pp + Phi_pxi X + X^T Phi_xip + X^T Phi_xixi X + X^T dtau`. No term is left out.
module litz_contact_friction
   use litz_kinds, only: dp, pi
   use litz_axis, only: axis_shape, axis_third_derivative, on_axis, axis_row
   use litz_contact_kinematics, only: contact_kinematics_t
   use litz_friction_law, only: friction_law_t
   use litz_rotations, only: identity3
   implicit none
   private
   public :: slip_t, slip_kinematics, friction_residual, friction_tangent, add_turning_tangent

   !> Weights and derivatives of one axis at its closest point, 0th to 3rd.
   type :: axis_point_t
      real(dp) :: h(4, 0:3) = 0
      !> x, x', x'', x''' [m]
      real(dp) :: x(3, 0:3) = 0
   end type axis_point_t

   !> The slip of a contact, and how it changes with the 24 mechanical unknowns.
   type :: slip_t
      !> D1, D2 [m]; derivatives (24, 2)
      real(dp) :: slip(2) = 0, dslip(24, 2) = 0
      !> Frame (e1, e2) in space (3, 2)
      real(dp) :: frame(3, 2) = 0
      !> cos(psi/2), sin(psi/2) and derivatives of psi
      real(dp), private :: c = 0, s = 0, dpsi(24) = 0
      !> Arc length over xi, barred and unbarred [m]
      real(dp), private :: half(2) = 0
      !> Unbarred and barred axis
      type(axis_point_t), private :: a, b
   end type slip_t

contains

   !> Slip since the increment began.
   pure function slip_kinematics(kinematics, x, t, length, axis, direction, moved) result(slip)
      !> Of the present closest points
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> +1 or -1: whether xi runs along the wire or against it (2). The frame belongs to the wires, so that it stays
      !> when the contact goes on in the next elements
      integer, intent(in) :: direction(2)
      !> Arc lengths by which the closest points have moved along the wires since the increment began (2) [m]
      real(dp), intent(in) :: moved(2)
      type(slip_t) :: slip
      real(dp) :: psi, arcs(24, 2), e(3), eb(3)

      psi = kinematics%angle
      slip%dpsi = kinematics%dangle
      if (product(direction) < 0) then
         psi = pi - psi
         slip%dpsi = -slip%dpsi
      end if
      slip%half = direction*length/2                                                      ! ds = half dxi
      arcs(:, 1) = slip%half(1)*kinematics%dxi_bar
      arcs(:, 2) = slip%half(2)*kinematics%dxi
      slip%c = cos(psi/2)
      slip%s = sin(psi/2)
      associate (c => slip%c, s => slip%s)
         slip%slip = [c*(moved(2) - moved(1)), s*(moved(2) + moved(1))]                   ! D1, D2
         slip%dslip(:, 1) = c*(arcs(:, 2) - arcs(:, 1)) - s*(moved(2) - moved(1))/2*slip%dpsi
         slip%dslip(:, 2) = s*(arcs(:, 2) + arcs(:, 1)) + c*(moved(2) + moved(1))/2*slip%dpsi
      end associate
      slip%a = axis_point(axis, length(2), kinematics%xi, x(:, 3:4), t(:, 3:4))
      slip%b = axis_point(axis, length(1), kinematics%xi_bar, x(:, 1:2), t(:, 1:2))
      e = direction(2)*slip%a%x(:, 1)/norm2(slip%a%x(:, 1))
      eb = direction(1)*slip%b%x(:, 1)/norm2(slip%b%x(:, 1))
      slip%frame(:, 1) = (e + eb)/(2*slip%c)
      slip%frame(:, 2) = (e - eb)/(2*slip%s)
   end function slip_kinematics

   !> `R = X^T tau`.
   pure function friction_residual(kinematics, slip, traction) result(r)
      type(contact_kinematics_t), intent(in) :: kinematics
      type(slip_t), intent(in) :: slip
      !> T1, T2 [N]
      real(dp), intent(in) :: traction(2)
      real(dp) :: r(24), tau(2)

      tau = forces_on_places(slip, traction)
      r = tau(1)*kinematics%dxi + tau(2)*kinematics%dxi_bar
   end function friction_residual

   !> Forces on (xi, xib) [N m].
   pure function forces_on_places(slip, traction) result(tau)
      type(slip_t), intent(in) :: slip
      !> Tangential force [N] along the two directions of the slip
      real(dp), intent(in) :: traction(2)
      real(dp) :: tau(2)

      tau = slip%half([2, 1])*[traction(1)*slip%c + traction(2)*slip%s, -traction(1)*slip%c + traction(2)*slip%s]
   end function forces_on_places

   !> Tangent with respect to spins.
   pure function friction_tangent(kinematics, slip, t, law, dforce, geometric_traction) result(k)
      type(contact_kinematics_t), intent(in) :: kinematics
      type(slip_t), intent(in) :: slip
      !> Nodal unit tangents (3, 4)
      real(dp), intent(in) :: t(3, 4)
      type(friction_law_t), intent(in) :: law
      !> How the normal force changes (24)
      real(dp), intent(in) :: dforce(24)
      !> Traction in the geometric part [N]: `law%traction` for the exact tangent; a mixed iteration has its own
      real(dp), intent(in) :: geometric_traction(2)
      real(dp) :: k(24, 24)
      real(dp) :: dtraction(24, 2), dtau(24, 2)
      integer :: i

      do i = 1, 2
         dtraction(:, i) = matmul(slip%dslip, law%dtraction_dslip(i, :)) + law%dtraction_dforce(i)*dforce
      end do
      associate (c => slip%c, s => slip%s, traction => geometric_traction, half => slip%half)
         dtau(:, 1) = half(2)*(c*dtraction(:, 1) + s*dtraction(:, 2) + (-s*traction(1) + c*traction(2))/2*slip%dpsi)
         dtau(:, 2) = half(1)*(-c*dtraction(:, 1) + s*dtraction(:, 2) + (s*traction(1) + c*traction(2))/2*slip%dpsi)
      end associate
      k = tangent_of_closest_points(kinematics, slip%a, slip%b, t, forces_on_places(slip, geometric_traction), dtau)
   end function friction_tangent

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
      moves(:, 1) = kinematics%dxi
      moves(:, 2) = kinematics%dxi_bar
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

end module litz_contact_friction
