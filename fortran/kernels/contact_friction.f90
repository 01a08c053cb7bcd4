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
!> Tangent: that of litz_closest_point_motion. No term is left out.
module litz_contact_friction
   use litz_kinds, only: dp, pi
   use litz_closest_point_motion, only: axis_point_t, axis_point, tangent_of_closest_points
   use litz_contact_kinematics, only: contact_kinematics_t
   use litz_friction_law, only: friction_law_t
   implicit none
   private
   public :: slip_t, slip_kinematics, friction_residual, friction_tangent

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

end module litz_contact_friction
