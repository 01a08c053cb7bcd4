!> Residual and tangent of one contact, composed of what its force and its spot make of them.
!>
!> Runs, Python and user elements all call this procedure. Source: the paper's blocks `K = [K_mm 0; K_me K_ee]`,
!> `R = [R_m; R_e]`; theory sections 5 and 9.
module litz_contact_blocks
   use litz_kinds, only: dp
   use litz_contact_electricity, only: contact_electricity_t, current_of_spot, coupling_tangent
   use litz_contact_kinematics, only: contact_kinematics_t
   use litz_contact_mechanics, only: contact_mechanics, mechanical_residual
   use litz_normal_law, only: force_of_gap_t
   use litz_spot_law, only: contact_spot_t
   implicit none
   private
   public :: contact_blocks, residual_blocks, electric_blocks, contact_force_t, spot_in_circuit_t

   !> The normal force as the residual and the tangent take it. An exact tangent has that of the law in all places; a
   !> mixed iteration linearises about a force of its own.
   type :: contact_force_t
      !> Force of the residual, and that of the geometric tangent [N], pushing the wires apart
      real(dp) :: force = 0, geometric_force = 0
      !> -dF/dg [N/m]
      real(dp) :: stiffness = 0
      !> dF/dangle [N/rad] of the tangent, which makes it exact and unsymmetric; 0: it is left out. What it adds is
      !> smaller than the rest by the ratio of approach to element length
      real(dp) :: dforce_dangle = 0
      !> The law at the present gap: what the spot follows
      type(force_of_gap_t) :: law
   end type contact_force_t

   !> The spot and what is in series to it.
   type :: spot_in_circuit_t
      type(contact_spot_t) :: spot
      !> 1: the spot is that of the present force, 0: that of an earlier one
      real(dp) :: follows = 1
      !> s = rho L0/(4 A) (2) [ohm]: barred, unbarred; 0: the voltage is not corrected
      real(dp) :: series_resistance(2) = 0
      !> How the conductance changes with the 24 mechanical unknowns, not by force and angle: by what touches of a part
      !> of a line, as the contact slides next to an end [S/m, S/rad]
      real(dp) :: dconductance(24) = 0
      !> What of this goes with the gap [S/m], as it does where wires swell; and how the conductance changes with the
      !> logarithm of the force per length where nothing moves [S]
      real(dp) :: dconductance_dgap = 0, dconductance_dln_force = 0
   end type spot_in_circuit_t

contains

   !> All blocks of one contact.
   pure subroutine contact_blocks(kinematics, t, v, force, circuit, form, k_mm, r_m, k_me, k_ee, r_e, electricity)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Nodal unit tangents (3, 4) and voltages (4) [V]: barred 1, barred 2, 1, 2
      real(dp), intent(in) :: t(3, 4), v(4)
      type(contact_force_t), intent(in) :: force
      type(spot_in_circuit_t), intent(in) :: circuit
      !> `form_spin` or `form_hessian` of litz_contact_mechanics
      integer, intent(in) :: form
      !> Tangent (24, 24) and residual (24) of the mechanics
      real(dp), intent(out) :: k_mm(24, 24), r_m(24)
      !> Tangent of the currents that leave the nodes: by the motion (4, 24), by the voltages (4, 4); and these currents
      !> (4) [A]
      real(dp), intent(out) :: k_me(4, 24), k_ee(4, 4), r_e(4)
      type(contact_electricity_t), intent(out) :: electricity

      call contact_mechanics(kinematics, t, force%force, force%stiffness, force%geometric_force, form, k_mm, r_m, &
         force%dforce_dangle)
      call electric_blocks(kinematics, v, force, circuit, k_me, k_ee, r_e, electricity)
   end subroutine contact_blocks

   !> The residual alone.
   pure subroutine residual_blocks(kinematics, v, force, circuit, r_m, r_e, electricity)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Nodal voltages (4) [V]: barred 1, barred 2, 1, 2
      real(dp), intent(in) :: v(4)
      type(contact_force_t), intent(in) :: force
      type(spot_in_circuit_t), intent(in) :: circuit
      !> Residual of the mechanics (24), and currents that leave the nodes (4) [A]
      real(dp), intent(out) :: r_m(24), r_e(4)
      type(contact_electricity_t), intent(out) :: electricity

      r_m = mechanical_residual(kinematics, force%force)
      call current_of_spot(kinematics, v, force%law, circuit%spot, circuit%follows, circuit%series_resistance, &
         circuit%dconductance, electricity)
      r_e = electricity%r_e
   end subroutine residual_blocks

   !> The rows of the currents.
   pure subroutine electric_blocks(kinematics, v, force, circuit, k_me, k_ee, r_e, electricity)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Nodal voltages (4) [V]: barred 1, barred 2, 1, 2
      real(dp), intent(in) :: v(4)
      type(contact_force_t), intent(in) :: force
      type(spot_in_circuit_t), intent(in) :: circuit
      !> As of `contact_blocks`
      real(dp), intent(out) :: k_me(4, 24), k_ee(4, 4), r_e(4)
      type(contact_electricity_t), intent(out) :: electricity

      call current_of_spot(kinematics, v, force%law, circuit%spot, circuit%follows, circuit%series_resistance, &
         circuit%dconductance, electricity)
      k_me = coupling_tangent(electricity, kinematics)
      k_ee = electricity%k_ee
      r_e = electricity%r_e
   end subroutine electric_blocks

end module litz_contact_blocks
