!> Friction of one crossing: stiffness of the stick, and the kernel with the memory of the crossing.
module litz_friction_forces
   use litz_kinds, only: dp
   use litz_contact_friction, only: slip_t, slip_kinematics, friction_residual, friction_tangent
   use litz_contact_history, only: moved_arcs
   use litz_contact_points, only: contact_point_t
   use litz_friction_iteration, only: friction_iteration_t
   use litz_friction_law, only: friction_law_t, friction_law, mindlin_ratio
   use litz_hertz, only: hertz_ellipse_t
   use litz_model, only: interaction_t, normal_hertz, stick_elastic_slip, stick_stiffness
   use litz_normal_law, only: hertz_approach_of_ellipse
   use litz_rotation_forms, only: spin_to_hessian
   use litz_wires, only: wires_t
   implicit none
   private
   public :: has_friction, add_friction

contains

   !> A contact grips from the increment after the one in which it closes: for how much of that one it was closed, and
   !> so how far it has slipped, is not known.
   pure logical function has_friction(law, point)
      type(interaction_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point

      has_friction = law%friction > 0 .and. point%history%closed
   end function has_friction

   !> Add the traction to the residual and the tangent of a contact.
   pure subroutine add_friction(law, wires, x, t, length, young, poisson, point, k, r)
      type(interaction_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      !> Nodal positions [m] and unit tangents (3, 4), reference lengths (2) [m]: barred first
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      !> Young's moduli (2) [Pa], Poisson's ratios (2) [-]
      real(dp), intent(in) :: young(2), poisson(2)
      !> Gets the traction, and what the iteration supposes of it
      type(contact_point_t), intent(inout) :: point
      !> Tangent (24, 24), in Hessian form, and residual (24)
      real(dp), intent(inout) :: k(24, 24), r(24)
      type(slip_t) :: slip
      type(friction_law_t) :: supposed
      real(dp) :: force, dforce(24), stiffness, dstiffness_dforce, k_friction(24, 24), r_friction(24), residual(24)
      integer :: elements(2)

      elements = [point%element_bar, point%element]
      slip = slip_kinematics(point%kinematics, x, t, length, law%axis, wires%direction(elements), &
         moved_arcs(point%history, [point%arc_bar, point%arc], wires%circumference(wires%wire(elements))))
      residual = 0
      if (point%closed) then
         call stick(law, young, poisson, point%force, point%ellipse, stiffness, dstiffness_dforce)
         point%friction = friction_law(law%friction, point%force, stiffness, dstiffness_dforce, &
            point%history%traction, slip%slip)
         point%traction_on_bar = -matmul(slip%frame, point%friction%traction)
         residual = friction_residual(point%kinematics, slip, point%friction%traction)
         r = r + residual
      end if

      associate (iteration => point%friction_iteration)
         if (.not. point%predicted) iteration = friction_iteration_t(mixed_traction=point%history%traction)
         iteration%difference = -residual
         iteration%limit = 0
         iteration%dtrial = 0
         if (.not. point%active) return
         force = max(0.0_dp, point%iteration_force)
         dforce = -point%stiffness*point%kinematics%dgap
         if (.not. force > 0) return
         call stick(law, young, poisson, force, point%ellipse, stiffness, dstiffness_dforce)
         supposed = friction_law(law%friction, force, stiffness, dstiffness_dforce, point%history%traction, slip%slip, &
            iteration%status)
         r_friction = friction_residual(point%kinematics, slip, supposed%traction)
         k_friction = friction_tangent(point%kinematics, slip, t, supposed, dforce, iteration%mixed_traction)
         call spin_to_hessian(k_friction, r_friction, [4, 10, 16, 22])
         k = k + k_friction
         iteration%difference = r_friction - residual
         iteration%trial = point%history%traction + stiffness*slip%slip
         iteration%dtrial = stiffness*slip%dslip
         iteration%limit = law%friction*force
         iteration%dlimit = law%friction*dforce
      end associate
   end subroutine add_friction

   !> Tangential stiffness of a contact that sticks, and how it changes with the normal force.
   pure subroutine stick(law, young, poisson, force, ellipse, stiffness, dstiffness_dforce)
      type(interaction_t), intent(in) :: law
      !> Normal force, greater than 0 [N]
      real(dp), intent(in) :: young(2), poisson(2), force
      type(hertz_ellipse_t), intent(in) :: ellipse
      !> [N/m], [1/m]
      real(dp), intent(out) :: stiffness, dstiffness_dforce
      real(dp) :: delta, ddelta_dforce

      select case (law%stick_law)
      case (stick_elastic_slip)
         dstiffness_dforce = law%friction/law%stick_value
         stiffness = dstiffness_dforce*force
      case (stick_stiffness)
         stiffness = law%stick_value
         dstiffness_dforce = 0
      case default
         stiffness = law%penalty
         dstiffness_dforce = 0
         if (law%normal_law == normal_hertz) then
            call hertz_approach_of_ellipse(force, ellipse, delta, ddelta_dforce)
            stiffness = 1/ddelta_dforce
            dstiffness_dforce = stiffness/(3*force)                                       ! it goes with F^(1/3)
         end if
         stiffness = mindlin_ratio(young, poisson)*stiffness
         dstiffness_dforce = mindlin_ratio(young, poisson)*dstiffness_dforce
      end select
   end subroutine stick

end module litz_friction_forces
