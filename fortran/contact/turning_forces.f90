!> The torque with which two wires that cross resist to be turned against each other, of a run.
!>
!> The law sees the angle `theta(psi)` of straight wires, which next to long lenses is not wholly that of the
!> axes; where ends or joints cut the contact it stays within an iteration, and there is no torque.
!>
!> Source: theory (5.1a).
module litz_turning_forces
   use litz_kinds, only: dp
   use litz_contact_kinematics, only: n_motions
   use litz_contact_mechanics, only: form_hessian
   use litz_contact_points, only: contact_point_t
   use litz_contact_turning, only: contact_turning, turning_t
   use litz_cut_lens, only: is_cut
   implicit none
   private
   public :: find_turning

   !> Below this cosine the angle of the law is a right one, which nothing changes
   real(dp), parameter :: smallest_cosine = 1.0e-6_dp

contains

   !> Residual and tangent of the torque, and how the force changes with the angle of the axes.
   pure subroutine find_turning(axis, x, t, length, point, k, r, dforce_dangle)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> Nodal positions [m] and unit tangents (3, 4), barred element first; reference lengths (2) [m]
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      !> With its law at the present gap; out: with `torque_beyond`
      type(contact_point_t), intent(inout) :: point
      !> Tangent (24, 24) and residual (24)
      real(dp), intent(out) :: k(n_motions, n_motions), r(n_motions)
      !> [N/rad]
      real(dp), intent(out) :: dforce_dangle
      type(turning_t) :: turning
      real(dp) :: kept

      k = 0
      r = 0
      dforce_dangle = 0
      point%torque_beyond = 0
      if (point%line_place > 0 .or. any(point%held) .or. is_cut(point%lens) .or. .not. point%force > 0) return
      turning = turning_of(point)
      if (.not. (abs(turning%denergy) > 0 .or. abs(turning%d2energy) > 0)) return
      ! an iteration follows the torque of the force that it supposes, as it follows that force
      kept = min(1.0_dp, point%geometric_force/point%force)
      dforce_dangle = kept*turning%dforce
      call contact_turning(point%kinematics, x, t, length, axis, turning_t(kept*turning%denergy, &
         kept*turning%d2energy, dforce_dangle), form_hessian, k, r)
      r = turning%denergy*point%kinematics%dangle
      point%torque_beyond = (1 - kept)*turning%denergy
   end subroutine find_turning

   !> Derivatives of its energy by the angle of the axes.
   pure type(turning_t) function turning_of(point) result(turning)
      type(contact_point_t), intent(in) :: point
      real(dp) :: slope, curvature, cosine, kept

      slope = 1
      curvature = 0
      kept = 1 - point%lens_share
      if (point%lens_share > 0) then
         ! sin(theta) = (1 - share) sin(psi) + share sin(theta_lens)
         cosine = cos(point%law_angle)
         if (.not. cosine > smallest_cosine) return
         slope = kept*point%kinematics%cos_angle/cosine
         curvature = (sin(point%law_angle)*slope**2 - kept*sin(point%kinematics%angle))/cosine
      end if
      associate (law => point%at_gap)
         turning%denergy = law%denergy_dangle*slope
         turning%d2energy = law%d2energy_dangle2*slope**2 + law%denergy_dangle*curvature
         turning%dforce = law%dforce_dangle*slope
      end associate
   end function turning_of

end module litz_turning_forces
