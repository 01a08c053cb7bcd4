!> The torque with which two wires that cross resist to be turned against each other, of a run.
!>
!> The law sees the angle `theta(psi)` of straight wires, which where wires are curved about each other is not that of
!> the axes; where ends or joints cut the contact it stays within an iteration, and there is no torque.
!>
!> Source: theory (5.1a).
module litz_turning_forces
   use litz_kinds, only: dp
   use litz_contact_kinematics, only: contact_kinematics_t, fix_angle, n_motions
   use litz_contact_lens, only: angle_of_law
   use litz_contact_mechanics, only: form_hessian
   use litz_contact_points, only: contact_point_t
   use litz_contact_turning, only: contact_turning, turning_t
   use litz_cut_lens, only: is_cut
   use litz_lens_growth, only: lacks_torque, settled_turning
   use litz_normal_law, only: force_of_gap_t
   implicit none
   private
   public :: find_turning

contains

   !> Residual and tangent of the torque. As the force, so the iteration linearises it about the force that the last one
   !> predicted: the angle changes the overlap at that force by `-F_psi/k`, and the force the torque by `F_psi/k`.
   pure subroutine find_turning(axis, x, t, length, point, k, r)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> Nodal positions [m] and unit tangents (3, 4), barred element first; reference lengths (2) [m]
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      !> With its law at the present gap and at the mixed force; out: with both torques and `turning`
      type(contact_point_t), intent(inout) :: point
      !> Tangent (24, 24) and residual (24)
      real(dp), intent(out) :: k(n_motions, n_motions), r(n_motions)
      type(turning_t) :: law
      real(dp) :: unused(n_motions), slope

      k = 0
      r = 0
      point%turning = turning_t()
      point%torque = 0
      point%iteration_torque = 0
      if (point%line_place > 0 .or. any(point%held) .or. is_cut(point%lens)) return
      law = turning_of(point, point%at_gap)
      point%torque = law%denergy
      r = point%torque*point%kinematics%rows%dangle
      slope = 0
      associate (turning => point%turning)
         if (point%active .and. point%stiffness > 0) then
            turning = turning_of(point, point%at_mixed)
            slope = (turning%dforce + turning%growth)/point%stiffness
         end if
         ! at first touch no force is known yet
         if (.not. point%geometric_force > 0) turning = turning_t(0.0_dp, turning%dforce*slope, turning%dforce, &
            turning%growth)
         point%iteration_torque = turning%denergy + slope*(point%iteration_force - point%mixed_force)
         if (any(abs([turning%denergy, turning%d2energy, turning%dforce]) > 0)) call contact_turning( &
            point%kinematics, x, t, length, axis, turning, form_hessian, k, unused)
      end associate
      if (lacks_torque(point)) call add_settled(axis, x, t, length, point, k, r)
   end subroutine find_turning

   !> What the torques of a crossing and of its places lack stays within an iteration, and so do the places on which it
   !> acts: those of a long lens go far along the wires as they turn a little.
   pure subroutine add_settled(axis, x, t, length, point, k, r)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> Nodal positions [m] and unit tangents (3, 4), barred element first; reference lengths (2) [m]
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      type(contact_point_t), intent(in) :: point
      !> Tangent (24, 24) and residual (24), added to
      real(dp), intent(inout) :: k(n_motions, n_motions), r(n_motions)
      type(contact_kinematics_t) :: fixed
      real(dp) :: k_settled(n_motions, n_motions), r_settled(n_motions)

      fixed = point%kinematics
      call fix_angle(x, t, length, axis, point%angle_at, 1.0_dp, fixed)
      call contact_turning(fixed, x, t, length, axis, settled_turning(point, fixed%angle), form_hessian, k_settled, &
         r_settled)
      k = k + k_settled
      r = r + r_settled
   end subroutine add_settled

   !> Derivatives of its energy by the angle of the axes.
   pure type(turning_t) function turning_of(point, law) result(turning)
      type(contact_point_t), intent(in) :: point
      type(force_of_gap_t), intent(in) :: law
      real(dp) :: slope, curvature

      call angle_of_law(point, slope, curvature)
      turning%denergy = law%denergy_dangle*slope
      turning%d2energy = law%d2energy_dangle2*slope**2 + law%denergy_dangle*curvature
      turning%dforce = law%dforce_dangle*slope
      turning%growth = law%growth*slope
   end function turning_of

end module litz_turning_forces
