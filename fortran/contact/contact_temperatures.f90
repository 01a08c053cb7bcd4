!> What temperatures do to the forces of contacts, where motions and temperatures are in one Newton step.
!>
!> Wires swell, and the forces of elastic contacts go with `E*` of their places. What a swelling makes of the forces
!> along a wire at its ends, and softening of the stick of friction, is left out: smaller than the rest by the ratio of
!> approach to radius. Source: theory sections 13 and 14.
module litz_contact_temperatures
   use litz_kinds, only: dp
   use litz_contact_kinematics, only: n_motions
   use litz_contact_points, only: contact_point_t
   use litz_domain, only: domain_t
   use litz_element_library, only: radius_by_temperature, modulus_by_temperature
   use litz_fields, only: motion_slots, temperature_slots
   use litz_hertz, only: effective_modulus
   use litz_law_input, only: wire_pair_t
   use litz_model, only: interaction_t
   use litz_normal_forces, only: wires_of
   implicit none
   private
   public :: find_temperature_slopes, add_temperatures, stiffer_by_temperature, spot_by_temperature

contains

   !> How gap and force of each contact change with the temperatures of its nodes; none, where these are not in the same
   !> step as motions.
   subroutine find_temperature_slopes(domain, points)
      type(domain_t), intent(in) :: domain
      type(contact_point_t), intent(inout) :: points(:)
      integer :: i

      do i = 1, size(points)
         associate (point => points(i))
            point%dgap_dtemperature = 0
            point%dforce_dtemperature = 0
            if (.not. domain%coupled_step) cycle
            point%dgap_dtemperature = -[radius_by_temperature(domain%model, domain%elements, point%element_bar, &
               point%xi_bar), radius_by_temperature(domain%model, domain%elements, point%element, point%xi)]
            if (point%active) point%dforce_dtemperature = max(point%iteration_force, 0.0_dp) &
               *stiffer_by_temperature(domain, point)
         end associate
      end do
   end subroutine find_temperature_slopes

   !> How ln(E*) of the places of an elastic contact changes with the temperatures of its nodes (4) [1/K].
   pure function stiffer_by_temperature(domain, point) result(slope)
      type(domain_t), intent(in) :: domain
      type(contact_point_t), intent(in) :: point
      real(dp) :: slope(4)

      slope = 0
      associate (law => domain%model%interactions(domain%model%contact_pairs(point%pair)%interaction)%normal)
         if (law%is_straight .or. law%line_penalty() > 0) return
      end associate
      slope = modulus_slope(domain, point)
   end function stiffer_by_temperature

   !> The same, whatever the law [1/K].
   pure function modulus_slope(domain, point) result(slope)
      type(domain_t), intent(in) :: domain
      type(contact_point_t), intent(in) :: point
      real(dp) :: slope(4)
      type(wire_pair_t) :: pair

      pair = wires_of(domain%model, domain%elements, point)
      slope = -effective_modulus(pair%young, pair%poisson)*[modulus_by_temperature(domain%model, domain%elements, &
         point%element_bar, point%xi_bar), modulus_by_temperature(domain%model, domain%elements, point%element, &
         point%xi)]
   end function modulus_slope

   !> How a conductance that the force makes changes with the temperatures of nodes where nothing moves (4) [S/K]: by
   !> the swelling, by a force that goes with E*, and by a spot that E* makes smaller.
   pure function spot_by_temperature(domain, law, point, by_gap, by_ln_force) result(slope)
      type(domain_t), intent(in) :: domain
      !> With the law of the spot
      type(interaction_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point
      !> How it changes with the gap [S/m] and with ln(F) [S]
      real(dp), intent(in) :: by_gap, by_ln_force
      real(dp) :: slope(4)

      slope = by_gap*point%dgap_dtemperature + by_ln_force*stiffer_by_temperature(domain, point)
      if (law%spot%is_elastic) slope = slope - by_ln_force*modulus_slope(domain, point)
   end function spot_by_temperature

   !> The tangent of forces, torques and friction over the temperatures.
   subroutine add_temperatures(domain, points)
      type(domain_t), intent(inout) :: domain
      type(contact_point_t), intent(in) :: points(:)
      integer, allocatable :: touching(:), nodes(:, :)
      real(dp), allocatable :: k(:, :, :)
      integer :: i

      if (.not. domain%coupled_step) return
      touching = pack([(i, i=1, size(points))], points%active)
      allocate (k(n_motions, 4, size(touching)), nodes(4, size(touching)))
      do i = 1, size(touching)
         associate (point => points(touching(i)), model => domain%model)
            nodes(:, i) = [model%connectivity(:, point%element_bar), model%connectivity(:, point%element)]
            k(:, :, i) = forces_by_temperature(domain, point)
         end associate
      end do
      call domain%add_cells(nodes, motion_slots, temperature_slots, k)
   end subroutine add_temperatures

   !> `-F_T dg - F dg_T + M_T dangle`, and what a limit of friction that follows the force adds (24, 4) [N/K, N m/K].
   pure function forces_by_temperature(domain, point) result(k)
      type(domain_t), intent(in) :: domain
      type(contact_point_t), intent(in) :: point
      real(dp) :: k(n_motions, 4), dforce(4), dtorque(4), friction, rows(n_motions)

      associate (by_temperature => point%dgap_dtemperature)
         dforce = point%dforce_dtemperature - point%stiffness*by_temperature
         dtorque = point%torque*stiffer_by_temperature(domain, point) - point%turning%dforce*by_temperature
      end associate
      friction = domain%model%interactions(domain%model%contact_pairs(point%pair)%interaction)%friction
      rows = -point%kinematics%dgap
      if (allocated(point%friction_iteration)) rows = rows + friction*point%friction_iteration%along
      k = spread(rows, 2, 4)*spread(dforce, 1, n_motions) &
         + spread(point%kinematics%rows%dangle, 2, 4)*spread(dtorque, 1, n_motions)
      k(:, :2) = k(:, :2) + point%force*spread(point%kinematics%rows%dxi_bar, 2, 2) &
         *spread(taper_by_temperature(point%element_bar), 1, n_motions)
      k(:, 3:) = k(:, 3:) + point%force*spread(point%kinematics%rows%dxi, 2, 2) &
         *spread(taper_by_temperature(point%element), 1, n_motions)

   contains

      !> How the slope of the radius over xi changes with the temperatures of the nodes of an element (2) [m/K].
      pure function taper_by_temperature(e) result(slope)
         !> Element
         integer, intent(in) :: e
         real(dp) :: slope(2)

         slope = (radius_by_temperature(domain%model, domain%elements, e, 1.0_dp) &
            - radius_by_temperature(domain%model, domain%elements, e, -1.0_dp))/2
      end function taper_by_temperature

   end function forces_by_temperature

end module litz_contact_temperatures
