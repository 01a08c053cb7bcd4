!> Friction of one crossing: stiffness of the stick, and the kernel with the memory of the crossing.
module litz_friction_forces
   use litz_kinds, only: dp
   use litz_contact_kinematics, only: n_motions
   use litz_contact_friction, only: slip_t, slip_kinematics, friction_residual, friction_tangent
   use litz_contact_points, only: contact_point_t
   use litz_friction_iteration, only: place_touch
   use litz_friction_law, only: friction_law_t, friction_start_t, friction_law, friction_none, friction_stick
   use litz_law_input, only: wire_pair_t
   use litz_model, only: interaction_t
   use litz_normal_law, only: overlap_at_force
   use litz_rotation_forms, only: spin_to_hessian
   use litz_stick_laws, only: stick_stiffness_at
   use litz_wires, only: wires_t, arc_from_to
   implicit none
   private
   public :: find_friction

contains

   !> Residual and tangent of the traction of a contact.
   pure subroutine find_friction(law, wires, x, t, length, pair, dq, closing, point, k, r)
      type(interaction_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      !> Nodal positions [m] and unit tangents (3, 4), reference lengths (2) [m]: barred first
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      type(wire_pair_t), intent(in) :: pair
      !> Displacements and rotations of the four nodes since the increment began (24) [m, rad], and what the clearance
      !> of an interference has closed the gap by [m]
      real(dp), intent(in) :: dq(n_motions), closing
      !> Gets the traction, and what the iteration supposes of it
      type(contact_point_t), intent(inout) :: point
      !> Tangent (24, 24), in Hessian form, and residual (24)
      real(dp), intent(out) :: k(n_motions, n_motions), r(n_motions)
      type(slip_t) :: slip
      type(friction_law_t) :: supposed
      type(friction_start_t) :: start
      real(dp) :: force, dforce(n_motions), stiffness, dstiffness_dforce, r_supposed(n_motions)
      integer :: elements(2)

      elements = [point%element_bar, point%element]
      if (.not. (point%history%closed .or. point%friction_iteration%touched)) then
         call find_touch(wires%direction(elements)*length/2, dq, closing, point)
      end if
      slip = slip_kinematics(point%kinematics, x, t, length, law%axis, wires%direction(elements), &
         arc_from_to(start_of_slip(point), [point%arc_bar, point%arc], wires%circumference(wires%wire(elements))))
      start = start_of_friction(law, pair, point)
      k = 0
      r = 0
      if (point%closed) then
         call stick(law, pair, point%force, point, stiffness, dstiffness_dforce)
         point%friction = friction_law(law%friction, point%force, stiffness, dstiffness_dforce, start, slip%slip)
         point%traction = -matmul(slip%frame, point%friction%traction)
         r = friction_residual(point%kinematics, slip, point%friction%traction)
         if (.not. point%history%closed) call grow_with_force(dot_product(r, dq), point%friction)
      end if

      if (point%friction_iteration%status == friction_none) call suppose(point)
      associate (iteration => point%friction_iteration)
         iteration%difference = -r
         iteration%limit = 0
         iteration%dtrial = 0
         if (.not. point%active) return
         force = max(0.0_dp, point%iteration_force)
         dforce = -point%stiffness*point%kinematics%dgap
         if (.not. force > 0) return
         call stick(law, pair, force, point, stiffness, dstiffness_dforce)
         supposed = friction_law(law%friction, force, stiffness, dstiffness_dforce, start, slip%slip, iteration%status)
         r_supposed = friction_residual(point%kinematics, slip, supposed%traction)
         k = friction_tangent(point%kinematics, slip, t, supposed, dforce, iteration%mixed_traction)
         call spin_to_hessian(k, r_supposed, [4, 10, 16, 22])
         iteration%difference = r_supposed - r
         iteration%trial = supposed%trial
         iteration%dtrial = stiffness*slip%dslip
         iteration%limit = law%friction*force
         iteration%dlimit = law%friction*dforce
      end associate
   end subroutine find_friction

   !> What the iteration supposes of a contact at first: it sticks when it was closed before, or else does what it would
   !> do here. A stick far beyond the limit would throw open again a contact that closes with a small force.
   pure subroutine suppose(point)
      type(contact_point_t), intent(inout) :: point

      associate (iteration => point%friction_iteration)
         iteration%status = friction_stick
         if (point%predicted .or. .not. point%history%closed) then
            if (point%closed) iteration%status = point%friction%status
         else
            iteration%mixed_traction = point%history%traction
         end if
      end associate
   end subroutine suppose

   !> Place at which a contact that was open when the increment began has closed.
   pure subroutine find_touch(arc_over_xi, dq, closing, point)
      !> How arc lengths along the wires change with xi, barred and unbarred (2) [m]
      real(dp), intent(in) :: arc_over_xi(2)
      !> As in `find_friction`
      real(dp), intent(in) :: dq(n_motions), closing
      type(contact_point_t), intent(inout) :: point
      real(dp) :: gap, gap_start

      gap_start = point%gap - dot_product(point%kinematics%dgap, dq) + closing
      gap = point%gap
      if (point%predicted) gap = min(gap, point%predicted_gap)
      call place_touch(gap_start, gap, [point%arc_bar, point%arc], arc_over_xi* &
         [dot_product(point%kinematics%dxi_bar, dq), dot_product(point%kinematics%dxi, dq)], point%friction_iteration)
   end subroutine find_touch

   !> Arc lengths from which a contact slips in this increment (2) [m].
   pure function start_of_slip(point) result(arc)
      type(contact_point_t), intent(in) :: point
      real(dp) :: arc(2)

      arc = point%friction_iteration%touch
      if (point%history%closed) arc = point%history%arc
   end function start_of_slip

   !> The contact when the increment began, with the stiffness that its force of then has in the present geometry.
   pure type(friction_start_t) function start_of_friction(law, pair, point) result(start)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      real(dp) :: dstiffness_dforce

      if (.not. point%history%closed) return
      start%traction = point%history%traction
      start%force = point%history%force
      start%elastic_energy = point%history%elastic_energy
      call stick(law, pair, start%force, point, start%stiffness, dstiffness_dforce)
   end function start_of_friction

   !> Work where the normal force has grown from nothing, in proportion to the slip since the contact closed: none on
   !> the way before.
   pure subroutine grow_with_force(work, friction)
      !> Of the present traction in the motion since the increment began [J]
      real(dp), intent(in) :: work
      type(friction_law_t), intent(inout) :: friction

      friction%work_beyond_mean = friction%elastic_work + friction%dissipation - work/2
   end subroutine grow_with_force

   !> Tangential stiffness of a contact that sticks, and how it changes with the normal force.
   pure subroutine stick(law, pair, force, point, stiffness, dstiffness_dforce)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> Normal force, greater than 0 [N]
      real(dp), intent(in) :: force
      type(contact_point_t), intent(in) :: point
      !> [N/m], [1/m]
      real(dp), intent(out) :: stiffness, dstiffness_dforce

      call stick_stiffness_at(law%stick_law, law%stick_value, law%friction, force, &
         overlap_at_force(law%normal, force, pair, point%ellipse), pair, stiffness, dstiffness_dforce)
   end subroutine stick

end module litz_friction_forces
