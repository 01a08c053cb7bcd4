!> A model as the terms see it: what stays the same, the unknowns, and the system of equations that the terms fill.
module litz_domain
   use litz_kinds, only: dp
   use litz_communicator, only: communicator_t
   use litz_conductor, only: conductor
   use litz_conductor_heat, only: heated_wire_t, nodal_share, film_number
   use litz_constrained_cells, only: scatter_constrained
   use litz_dependent_cells, only: scatter_dependent
   use litz_element_library, only: elements_t
   use litz_equations, only: equations_t, system_t
   use litz_fields, only: n_groups, fields, field_displacement, field_of_slot, &
      group_mechanical, motion_slots, potential_slots, rotation_slots, temperature_slots
   use litz_iterate, only: iterate_t
   use litz_loading, only: loading_t
   use litz_model, only: model_t
   use litz_property_table, only: property_at
   use litz_rubbing, only: rubbing_t
   use litz_scatter, only: forces_t, clear_forces, scatter, scatter_tangent
   use litz_state, only: state_t
   use litz_superconductors, only: superconductors_t, superconducting_state_t
   use litz_timing, only: timing_t
   use litz_wires, only: wires_t
   implicit none
   private
   public :: domain_t, element_flow_t

   !> Potentials are uncertain by this part of the largest one
   real(dp), parameter :: uncertainty = 8*epsilon(1.0_dp)

   !> What flows in a conducting element, and how that changes.
   type :: element_flow_t
      !> From the first to the second node [A], and V1 - V2 [V]
      real(dp) :: current = 0, voltage = 0
      !> The current that the iterate has, where it is an unknown of its own: that above is linear about it [A]
      real(dp) :: own = 0
      !> Derivatives of the current by V1 - V2 [S], by the temperature of either node [A/K], where temperatures are
      !> unknowns, and by the motions (12) [A/m, A]
      real(dp) :: by_voltage = 0, by_temperature = 0, by_motion(12) = 0
   end type element_flow_t

   type :: domain_t
      !> Those that hold the model; the arrays here are what this one has of it
      class(communicator_t), allocatable :: processes
      type(model_t) :: model
      type(wires_t) :: wires
      type(elements_t) :: elements
      type(loading_t) :: loading
      !> The last converged state
      type(state_t) :: state
      type(iterate_t) :: iterate
      type(equations_t) :: equations
      type(system_t) :: matrix
      type(forces_t) :: forces
      !> Heat that enters each element evenly at this iterate, of currents and sources (n_elements) [W]
      real(dp), allocatable :: element_heat(:)
      !> Films of the elements: heat per length and kelvin, and temperature of the surroundings, at the end of the
      !> increment (n_elements) [W/(m K)], [K]
      real(dp), allocatable :: film(:), sink(:)
      !> Of the last two changes of the enthalpy in its rate over time, and of the works of friction in theirs: backward
      !> Euler, or BDF2; and nodes that have backward Euler in any case, as their temperatures are prescribed, or joined
      !> with such by equations (n_nodes)
      real(dp) :: heat_weights(2) = [1.0_dp, 0.0_dp]
      logical, allocatable :: is_led(:)
      !> Elements with superconducting filaments
      type(superconductors_t) :: superconductors
      !> Friction on rigid surfaces, by the motions that were evaluated last
      type(rubbing_t), allocatable :: surface_rubbing(:)
      !> Forces and tangent of the motions stay as they were evaluated last, as nothing that they depend on has changed:
      !> only rows of the groups after them are cleared and added
      logical :: motions_stand = .false.
      !> Motions and temperatures are in one Newton step: what temperatures do to motions, and motions to heat, is part
      !> of the tangent
      logical :: coupled_step = .false.
      !> The pattern must be built and analysed before the next solve
      logical :: pattern_changed = .true.
      type(timing_t) :: timing
   contains
      procedure :: clear_system
      procedure :: add_cells
      procedure :: add_turning
      procedure :: add_slip_coupling
      procedure :: take_friction
      procedure :: lose_symmetry
      procedure :: mark_nodes
      procedure :: conduction_length
      procedure :: mean_temperature
      procedure :: heat_weights_at
      procedure :: least_capacity
      procedure :: fastest_warming
      procedure :: mechanical_temperature
      procedure :: resistivity
      procedure :: share_of_nodes
      procedure :: film_between_nodes
      procedure :: note_metal
      procedure :: flow_in
      procedure :: find_superconducting_flows
   end type domain_t

contains

   !> Set the marks of all nodes of some elements.
   pure subroutine mark_nodes(self, elements, marked)
      class(domain_t), intent(in) :: self
      !> Indices of the elements (n)
      integer, intent(in) :: elements(:)
      !> (n_nodes)
      logical, intent(inout) :: marked(:)
      integer :: i

      do i = 1, size(elements)
         marked(self%model%connectivity(:, elements(i))) = .true.
      end do
   end subroutine mark_nodes

   !> Length over which an element conducts, its reference length or the distance of its nodes [m].
   pure real(dp) function conduction_length(self, element) result(length)
      class(domain_t), intent(in) :: self
      !> Index of the element
      integer, intent(in) :: element

      length = self%elements%length(element)
      associate (node => self%model%connectivity(:, element))
         if (.not. self%model%sections(self%model%element_section(element))%current_length) return
         length = norm2(self%iterate%x(:, node(2)) - self%iterate%x(:, node(1)))
      end associate
   end function conduction_length

   !> Of an element, half-way between its nodes [K].
   pure real(dp) function mean_temperature(self, element)
      class(domain_t), intent(in) :: self
      !> Index of the element
      integer, intent(in) :: element

      mean_temperature = sum(self%iterate%value(temperature_slots(1), self%model%connectivity(:, element)))/2
   end function mean_temperature

   !> Weights of a node in steps over time.
   pure function heat_weights_at(self, node) result(weights)
      class(domain_t), intent(in) :: self
      !> Index of the node
      integer, intent(in) :: node
      real(dp) :: weights(2)

      weights = self%heat_weights
      if (self%is_led(node)) weights = [1, 0]
   end function heat_weights_at

   !> Heat that half an element takes up per kelvin [J/K].
   pure real(dp) function least_capacity(self, element) result(capacity)
      class(domain_t), intent(in) :: self
      !> Index of the element
      integer, intent(in) :: element
      real(dp) :: specific_heat, slope

      capacity = 0
      associate (section => self%model%sections(self%model%element_section(element)))
         associate (material => self%model%materials(section%material))
            if (.not. allocated(material%specific_heat)) return
            call property_at(material%specific_heat, self%mean_temperature(element), specific_heat, slope)
            capacity = material%density*section%area*self%elements%length(element)/2*specific_heat
         end associate
      end associate
   end function least_capacity

   !> By which any temperature changes in this increment or changed in the last one [K/s].
   real(dp) function fastest_warming(self, increment) result(rate)
      class(domain_t), intent(in) :: self
      !> This one [s]
      real(dp), intent(in) :: increment

      associate (now => self%iterate%value(temperature_slots(1), :), state => self%state)
         rate = self%processes%largest(max(maxval(abs(now - state%value(temperature_slots(1), :)))/increment, &
            maxval(abs(state%value(temperature_slots(1), :) - state%temperature_before))/state%time_increment))
      end associate
   end function fastest_warming

   !> Temperatures that strains, radii, gaps and elasticities see: those of the iterate when motions began to take their
   !> turn, or where motions are held those of the last increment that solved for motions (n_nodes) [K]. Their lag then
   !> goes to zero over the next step.
   pure function mechanical_temperature(self) result(temperature)
      class(domain_t), intent(in) :: self
      real(dp) :: temperature(self%model%n_nodes)

      associate (before => self%state%mechanical_temperature, lag => self%state%value(temperature_slots(1), :) &
         - self%state%mechanical_temperature)
         temperature = merge(self%iterate%mechanical_temperature - self%loading%lag_left()*lag, before, &
            self%loading%solves(field_displacement))
      end associate
   end function mechanical_temperature

   !> The part of heat that enters an element evenly which comes to its nodes: its film takes the rest between them.
   pure subroutine share_of_nodes(self, element, share, dshare)
      class(domain_t), intent(in) :: self
      !> Index of the element
      integer, intent(in) :: element
      !> The part, and its derivative by the temperature of either node [1/K]
      real(dp), intent(out) :: share, dshare

      share = 1
      dshare = 0
      if (.not. (self%film(element) > 0 .and. conducts_heat(self, element))) return
      call nodal_share(cooled_wire(self, element), share, dshare)
   end subroutine share_of_nodes

   !> w^2 of (13.3) of an element with a film; 0: it has none.
   pure real(dp) function film_between_nodes(self, element) result(w2)
      class(domain_t), intent(in) :: self
      !> Index of the element
      integer, intent(in) :: element

      w2 = 0
      if (self%film(element) > 0 .and. conducts_heat(self, element)) w2 = film_number(cooled_wire(self, element))
   end function film_between_nodes

   pure logical function conducts_heat(self, element)
      class(domain_t), intent(in) :: self
      !> Index of the element
      integer, intent(in) :: element

      associate (model => self%model)
         conducts_heat = allocated(model%materials(model%sections(model%element_section(element))%material) &
            %heat_conductivity)
      end associate
   end function conducts_heat

   !> An element with its film.
   pure type(heated_wire_t) function cooled_wire(self, element) result(wire)
      class(domain_t), intent(in) :: self
      !> Index of the element
      integer, intent(in) :: element

      associate (section => self%model%sections(self%model%element_section(element)))
         associate (material => self%model%materials(section%material))
            wire%length = self%conduction_length(element)
            wire%area = section%area
            wire%film = self%film(element)
            call property_at(material%heat_conductivity, self%mean_temperature(element), wire%conductivity, &
               wire%dconductivity)
         end associate
      end associate
   end function cooled_wire

   !> Of a conducting element at its mean temperature.
   pure subroutine resistivity(self, element, rho, drho)
      class(domain_t), intent(in) :: self
      !> Index of the element
      integer, intent(in) :: element
      !> [ohm m], and its derivative by the temperature [ohm m/K]; 0: the element does not conduct
      real(dp), intent(out) :: rho, drho

      rho = 0
      drho = 0
      associate (material => self%model%materials(self%model%sections(self%model%element_section(element))%material))
         if (material%conductivity > 0) call property_at(material%resistivity, &
            self%mean_temperature(element), rho, drho)
      end associate
   end subroutine resistivity

   !> Resistivity and resistance of the metal of each element at the present iterate, for the results.
   pure subroutine note_metal(self)
      class(domain_t), intent(inout) :: self
      real(dp) :: rho, drho, area
      integer :: e

      do e = 1, self%model%n_elements
         call self%resistivity(e, rho, drho)
         area = self%elements%area(e)
         associate (material => self%model%materials(self%model%sections(self%model%element_section(e))%material))
            if (allocated(material%superconductor)) area = area*(1 - material%superconductor%fraction)
         end associate
         self%state%metal(:, e) = rho*[1.0_dp, self%conduction_length(e)/area]
      end do
   end subroutine note_metal

   !> The current in a conducting element at the present iterate, to first order.
   pure type(element_flow_t) function flow_in(self, element) result(flow)
      class(domain_t), intent(in) :: self
      !> Index of the element
      integer, intent(in) :: element
      real(dp) :: k(2, 2), r(2), k_me(2, 6), rho, drho, heat

      associate (i => self%superconductors%place(element), node => self%model%connectivity(:, element))
         if (i > 0) then
            associate (there => self%superconductors)
               flow = element_flow_t(there%flows(i)%current, there%voltage(i), there%current(i), &
                  there%flows(i)%by_voltage, there%by_temperature(i), there%by_motion(:, i))
            end associate
            return
         end if
         flow%voltage = self%iterate%value(potential_slots(1), node(1)) &
            - self%iterate%value(potential_slots(1), node(2))
         call self%resistivity(element, rho, drho)
         if (.not. rho > 0) return
         call conductor(self%iterate%x(:, node), self%iterate%value(potential_slots(1), node), &
            self%elements%length(element), self%elements%area(element), rho, &
            self%model%sections(self%model%element_section(element))%current_length, k, r, k_me, flow%current, heat)
         flow%own = flow%current
         flow%by_voltage = k(1, 1)
         flow%by_temperature = -flow%current*drho/(2*rho)
         flow%by_motion(1:3) = k_me(1, 1:3)
         flow%by_motion(7:9) = k_me(1, 4:6)
      end associate
   end function flow_in

   !> What flows in the elements with superconducting filaments, at the present iterate.
   subroutine find_superconducting_flows(self)
      class(domain_t), intent(inout) :: self
      type(superconducting_state_t) :: now
      real(dp) :: along(3)
      integer :: i

      do i = 1, size(self%superconductors%members)
         associate (e => self%superconductors%members(i))
            associate (node => self%model%connectivity(:, e), v => self%iterate%value(potential_slots(1), :))
               now%x = self%iterate%x(:, node)
               now%length = self%conduction_length(e)
               along = 0
               if (self%model%sections(self%model%element_section(e))%current_length) along = &
                  (now%x(:, 2) - now%x(:, 1))/now%length
               now%length_by_motion = [-along, along]
               now%area = self%elements%area(e)
               call self%resistivity(e, now%resistivity, now%dresistivity)
               now%temperature = self%mean_temperature(e) - self%model%absolute_zero
               now%voltage = v(node(1)) - v(node(2))
               now%is_led = all(self%loading%fixed(potential_slots(1), node))
               now%round_off = uncertainty*self%forces%magnitude(potential_slots(1), node(1))
            end associate
         end associate
         call self%superconductors%evaluate(self%model, i, now)
      end do
   end subroutine find_superconducting_flows

   !> Nothing has been added yet.
   subroutine clear_system(self)
      class(domain_t), intent(inout) :: self
      integer :: row_group, column_group, first_group

      first_group = merge(group_mechanical + 1, 1, self%motions_stand)
      do column_group = 1, n_groups
         do row_group = first_group, n_groups
            if (self%matrix%has_block(row_group, column_group)) self%matrix%block(row_group, column_group)%value = 0
         end do
      end do
      self%matrix%symmetric(first_group:) = .true.
      if (.not. self%motions_stand) then
         self%matrix%unsymmetric_by_friction = .false.
         if (allocated(self%matrix%slip_coupling%value)) deallocate (self%matrix%slip_coupling%value)
      end if
      call clear_forces(self%processes, first_group, self%iterate%x, self%iterate%value, self%iterate%change, &
         self%forces)
   end subroutine clear_system

   !> Add cells to the system: their tangents, and with `r` their forces.
   subroutine add_cells(self, nodes, rows, columns, k, r)
      class(domain_t), intent(inout) :: self
      !> (nodes of a cell, cells)
      integer, intent(in) :: nodes(:, :)
      !> First and last slot of the equations and of the unknowns of each node (2), each of one group of fields
      integer, intent(in) :: rows(2), columns(2)
      !> Tangents (slots of rows x nodes, slots of columns x nodes, cells)
      real(dp), contiguous, intent(in) :: k(:, :, :)
      !> Internal forces (slots of rows x nodes, cells)
      real(dp), intent(in), optional :: r(:, :)
      integer :: cell

      associate (row_group => fields(field_of_slot(rows(1)))%group, &
         column_group => fields(field_of_slot(columns(1)))%group)
         if (self%motions_stand .and. row_group == group_mechanical) return
         call scatter(self%equations, nodes, rows, columns, k, self%iterate%prescribed, &
            self%matrix%block(row_group, column_group), self%forces, r)
         if (size(self%iterate%bodies%dependents) > 0) call scatter_dependent(self%equations, self%iterate%bodies, &
            self%iterate%constraints, self%iterate%x, nodes, rows, columns, k, &
            self%matrix%block(row_group, column_group))
         if (self%iterate%constraints%n == 0) return
         do cell = 1, size(nodes, 2)
            call scatter_constrained(self%equations, self%iterate%constraints, nodes(:, cell), rows, columns, &
               k(:, :, cell), self%matrix%block(row_group, column_group))
         end do
      end associate
   end subroutine add_cells

   !> Add the tangent of the rotations of a node that moves with no rigid body, and nothing else.
   subroutine add_turning(self, node, k)
      class(domain_t), intent(inout) :: self
      !> Node
      integer, intent(in) :: node
      !> [N m]
      real(dp), intent(in) :: k(3, 3)

      associate (block => self%matrix%block(group_mechanical, group_mechanical))
         call scatter_tangent(self%equations, [node], rotation_slots, rotation_slots, k, block)
         if (self%iterate%constraints%n > 0) call scatter_constrained(self%equations, self%iterate%constraints, &
            [node], rotation_slots, rotation_slots, k, block)
      end associate
   end subroutine add_turning

   !> Note that friction makes the tangent of the motions unsymmetric.
   subroutine take_friction(self)
      class(domain_t), intent(inout) :: self

      if (self%matrix%symmetric(group_mechanical)) self%matrix%unsymmetric_by_friction = .true.
      self%matrix%symmetric(group_mechanical) = .false.
   end subroutine take_friction

   !> Note that something else does, whether there is friction or not.
   subroutine lose_symmetry(self)
      class(domain_t), intent(inout) :: self

      self%matrix%unsymmetric_by_friction = .false.
      self%matrix%symmetric(group_mechanical) = .false.
   end subroutine lose_symmetry

   !> Note what a contact that slips adds to the tangent, which its cell has in it.
   subroutine add_slip_coupling(self, nodes, along, dlimit)
      class(domain_t), intent(inout) :: self
      !> Nodes of the contact (n)
      integer, intent(in) :: nodes(:)
      !> How its forces change with the limit of friction, and that with its motions (6 n)
      real(dp), intent(in) :: along(:), dlimit(:)
      real(dp) :: k(size(along), size(dlimit), 1)

      if (.not. any(abs(along) > 0)) return
      associate (coupling => self%matrix%slip_coupling, block => self%matrix%block(group_mechanical, group_mechanical))
         if (.not. allocated(coupling%value)) then
            self%matrix%slip_coupling%row_start = block%row_start
            allocate (self%matrix%slip_coupling%value(size(block%value)), source=0.0_dp)
         end if
         k(:, :, 1) = spread(along, 2, size(dlimit))*spread(dlimit, 1, size(along))
         call scatter_tangent(self%equations, nodes, motion_slots, motion_slots, k(:, :, 1), coupling)
         if (self%iterate%constraints%n > 0) call scatter_constrained(self%equations, self%iterate%constraints, nodes, &
            motion_slots, motion_slots, k(:, :, 1), coupling)
         if (size(self%iterate%bodies%dependents) > 0) call scatter_dependent(self%equations, self%iterate%bodies, &
            self%iterate%constraints, self%iterate%x, reshape(nodes, [size(nodes), 1]), motion_slots, &
            motion_slots, k, coupling)
      end associate
   end subroutine add_slip_coupling

end module litz_domain
