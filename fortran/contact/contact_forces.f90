!> Forces and currents of the contacts, and their part of the system.
module litz_contact_forces
   use litz_kinds, only: dp
   use litz_bent_contacts, only: resists_bending
   use litz_contact_bending, only: contact_bending
   use litz_contact_kinematics, only: n_motions
   use litz_contact_blocks, only: contact_blocks, electric_blocks, contact_force_t, spot_in_circuit_t
   use litz_contact_electricity, only: contact_electricity_t
   use litz_contact_mechanics, only: contact_mechanics, form_hessian
   use litz_contact_spots, only: find_spot, keep_current
   use litz_contact_points, only: contact_set_t, contact_point_t, pair_geometry, clearance_of
   use litz_domain, only: domain_t
   use litz_element_library, only: elements_t, along_element, material_at, material_place_t
   use litz_errors, only: error_t
   use litz_fields, only: field_temperature, motion_slots, potential_slots
   use litz_friction_forces, only: find_friction, clear_friction, increment_start_t
   use litz_law_input, only: wire_pair_t
   use litz_lens_growth, only: lacks_torque
   use litz_model, only: model_t
   use litz_mutual_resistances, only: mutual_resistances_t, both_of
   use litz_normal_forces, only: wires_of, is_lens, law_of_spot
   use litz_normal_law, only: normal_law_t
   use litz_parallel, only: worth_threads
   use litz_ploughing, only: coefficient_of_friction
   use litz_refused_contacts, only: refuse_bad_data
   use litz_scatter, only: forces_t, chunk
   use litz_shared_conductors, only: shared_conductors_t, collect_shared
   use litz_sliding_forces, only: find_sliding
   use litz_spots_beside_spots, only: collect_spots, spots_t
   use litz_strips_of_wires, only: collect_strips
   use litz_timing, only: phase_contact, phase_assembly
   use litz_turning_forces, only: find_turning
   use litz_wires, only: wires_t
   implicit none
   private
   public :: assemble_contacts, share_currents, set_current, conductors_of, conducts_apart, enters_system

contains

   !> Add all points to the system: mechanics, and where a current can cross, the paper's electric blocks.
   subroutine assemble_contacts(domain, contact, points, error)
      type(domain_t), intent(inout) :: domain
      !> What is left of interference
      type(contact_set_t), intent(in) :: contact
      type(contact_point_t), intent(inout) :: points(:)
      !> Data that a law cannot take
      type(error_t), allocatable, intent(out) :: error
      real(dp), allocatable :: k(:, :, :), r(:, :), k_ee(:, :, :), r_e(:, :), k_me(:, :, :)
      integer, allocatable :: touching(:), nodes(:, :)
      integer :: first, n, i

      touching = pack([(i, i=1, size(points))], enters_system(points))
      n = min(chunk, size(touching))
      allocate (k(n_motions, n_motions, n), r(n_motions, n), k_ee(4, 4, n), r_e(4, n), k_me(4, n_motions, n))
      allocate (nodes(4, n))
      if (.not. domain%motions_stand) call clear_friction(domain%model, points)
      call clear_flows(points)
      do first = 1, size(touching), chunk
         n = min(chunk, size(touching) - first + 1)
         associate (members => touching(first:first + n - 1))
            !$omp parallel do schedule(static) if (n >= worth_threads)
            do i = 1, n
               call evaluate(points(members(i)), nodes(:, i), k(:, :, i), r(:, i), k_ee(:, :, i), r_e(:, i), &
                  k_me(:, :, i))
            end do
            !$omp end parallel do
            call domain%timing%lap(phase_contact)
            if (.not. domain%motions_stand) call add_motions(domain, points, members, nodes(:, :n), k(:, :, :n), &
               r(:, :n))
            if (any(points(members)%conductance > 0)) then
               call domain%add_cells(nodes(:, :n), potential_slots, potential_slots, k_ee(:, :, :n), r_e(:, :n))
               call domain%add_cells(nodes(:, :n), potential_slots, motion_slots, k_me(:, :, :n))
            end if
            call domain%timing%lap(phase_assembly)
         end associate
      end do
      call refuse_bad_data(domain%model, points, error)
      call domain%timing%lap(phase_contact)

   contains

      subroutine evaluate(point, nodes_p, k_p, r_p, k_ee_p, r_e_p, k_me_p)
         type(contact_point_t), intent(inout) :: point
         !> Nodes of both elements (4)
         integer, intent(out) :: nodes_p(4)
         !> Tangent and residual of the motions (24, 24), (24)
         real(dp), intent(out) :: k_p(n_motions, n_motions), r_p(n_motions)
         !> Tangent and currents of the voltages (4, 4), (4), tangent of the currents by the motions (4, 24)
         real(dp), intent(out) :: k_ee_p(4, 4), r_e_p(4), k_me_p(4, n_motions)
         real(dp) :: x(3, 4), t(3, 4), length(2), k_friction(n_motions, n_motions), k_slide(n_motions, n_motions)
         real(dp), dimension(n_motions) :: r_friction, r_slide, r_turning, dforce
         real(dp) :: k_turning(n_motions, n_motions)
         type(wire_pair_t) :: pair
         type(spot_in_circuit_t) :: circuit
         type(contact_electricity_t) :: electricity
         logical :: conducts

         associate (model => domain%model, wires => domain%wires, elements => domain%elements, &
            iterate => domain%iterate, law => domain%model%interactions( &
            domain%model%contact_pairs(point%pair)%interaction))
            nodes_p = [model%connectivity(:, point%element_bar), model%connectivity(:, point%element)]
            call pair_geometry(model, wires, elements, point%element_bar, point%element, iterate%x, iterate%rotation, &
               x, t, length)
            pair = wires_of(model, elements, point)
            call find_sliding(wires, elements, law%axis, x, t, length, point, k_slide, r_slide, dforce)
            if (.not. domain%motions_stand) call find_turning(law%axis, x, t, length, point, k_turning, r_turning)
            if (.not. domain%motions_stand .and. coefficient_of_friction(law, point) > 0 &
               .and. (point%active .or. point%closed)) then
               call find_friction(law, wires, x, t, length, pair, increment_start(domain, contact, point, nodes_p), &
                  dforce + point%turning%dforce*point%kinematics%rows%dangle, point, k_friction, r_friction)
               k_slide = k_slide + k_friction
               r_slide = r_slide + r_friction
            end if
            conducts = (point%closed .or. conducts_apart(point)) .and. all(pair%resistivity > 0) .and. law%spot%exists()
            if (conducts) call find_spot(model, elements, law, wires, pair, x, t, length, point, circuit)
            if (conducts) circuit%dconductance = circuit%dconductance + spot_that_slides(law%normal, point, circuit, &
               dforce)
            associate (voltage => iterate%value(potential_slots(1), nodes_p), &
               force => contact_force_t(point%force, point%geometric_force, point%stiffness, point%turning%dforce, &
               law_of_spot(law%normal, point)))
               if (.not. (conducts .or. domain%motions_stand)) then
                  call contact_mechanics(point%kinematics, t, force%force, force%stiffness, force%geometric_force, &
                     form_hessian, k_p, r_p, force%dforce_dangle)
                  k_me_p = 0
                  k_ee_p = 0
                  r_e_p = 0
               else if (domain%motions_stand) then
                  call electric_blocks(point%kinematics, voltage, force, circuit, k_me_p, k_ee_p, r_e_p, electricity)
               else
                  call contact_blocks(point%kinematics, t, voltage, force, circuit, form_hessian, k_p, r_p, k_me_p, &
                     k_ee_p, r_e_p, electricity)
               end if
               if (.not. domain%motions_stand) then
                  k_p = k_p + k_slide + k_turning
                  r_p = r_p + r_slide + r_turning
                  if (point%closed .and. resists_bending(point)) call add_bending(law%axis, x, t, length, point, &
                     k_p, r_p)
               end if
               if (conducts) call keep_current(electricity, circuit, force%law%dforce_dgap, point)
            end associate
            if (model%has_field(field_temperature)) call keep_temperatures(elements, point)
         end associate
      end subroutine evaluate

   end subroutine assemble_contacts

   !> The force by which a contact resists to be bent otherwise.
   pure subroutine add_bending(axis, x, t, length, point, k, r)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> Nodal positions [m] and unit tangents (3, 4), barred element first; reference lengths (2) [m]
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      type(contact_point_t), intent(in) :: point
      !> Tangent (24, 24) and residual (24), added to
      real(dp), intent(inout) :: k(n_motions, n_motions), r(n_motions)
      real(dp) :: k_bending(n_motions, n_motions), r_bending(n_motions)

      call contact_bending(point%kinematics, x, t, length, axis, point%radius, point%bends_seen, &
         point%bends%by_curvature, k_bending, r_bending)
      k = k + k_bending
      r = r + r_bending
   end subroutine add_bending

   !> Forces and tangent of the motions of some contacts.
   subroutine add_motions(domain, points, members, nodes, k, r)
      type(domain_t), intent(inout) :: domain
      type(contact_point_t), intent(in) :: points(:)
      !> Which of them (contacts), and the nodes of both elements of each (4, contacts)
      integer, intent(in) :: members(:), nodes(:, :)
      !> Tangents (24, 24, contacts) and residuals (24, contacts)
      real(dp), contiguous, intent(in) :: k(:, :, :), r(:, :)
      integer :: i

      do i = 1, size(members)
         associate (point => points(members(i)))
            if (allocated(point%friction_iteration)) then
               if (point%friction_iteration%limit > 0) call domain%take_friction()
            end if
            if (abs(point%turning%growth) > 0) call domain%lose_symmetry()
            call add_iteration_force(point, nodes(:, i), domain%forces)
            call add_supposed_force(point, nodes(:, i), domain%forces)
         end associate
      end do
      call domain%add_cells(nodes, motion_slots, motion_slots, k, r)
      do i = 1, size(members)
         associate (point => points(members(i)))
            if (allocated(point%friction_iteration)) call domain%add_slip_coupling(nodes(:, i), &
               point%friction_iteration%along, point%friction_iteration%dlimit)
         end associate
      end do
   end subroutine add_motions

   !> What friction asks of the state in which the increment began.
   pure type(increment_start_t) function increment_start(domain, contact, point, nodes_p) result(before)
      type(domain_t), intent(in) :: domain
      type(contact_set_t), intent(in) :: contact
      type(contact_point_t), intent(in) :: point
      !> Nodes of both elements (4)
      integer, intent(in) :: nodes_p(4)
      real(dp) :: length(2)
      integer :: a

      associate (iterate => domain%iterate, start => domain%state%rotation)
         before%dq = reshape(iterate%change(motion_slots(1):motion_slots(2), nodes_p), [n_motions])
         before%closing = clearance_of(point%fit, contact%converged_clearance(point%pair)) &
            - clearance_of(point%fit, contact%clearance(point%pair))
         before%goes_on = domain%state%increment > 0
         call pair_geometry(domain%model, domain%wires, domain%elements, point%element_bar, point%element, &
            iterate%x_start, start, before%x, before%t, length)
         do a = 1, size(nodes_p)
            before%turned(:, :, a) = matmul(iterate%rotation(:, :, nodes_p(a)), transpose(start(:, :, nodes_p(a))))
         end do
      end associate
   end function increment_start

   !> A place of a line that does not touch itself conducts where a part of its cell touches.
   elemental logical function conducts_apart(point)
      type(contact_point_t), intent(in) :: point

      conducts_apart = point%cell_touches .and. point%weight > 0
   end function conducts_apart

   !> It has a force, or a current can pass.
   elemental logical function enters_system(point)
      type(contact_point_t), intent(in) :: point

      enters_system = point%active .or. point%closed .or. conducts_apart(point) .or. lacks_torque(point)
   end function enters_system

   !> How the conductance of a spot changes as the contact slides next to an end (24) [S]: by its force; that of a
   !> place of a line by the length; of a lens the ends keep what they have within an iteration.
   pure function spot_that_slides(law, point, circuit, dforce) result(row)
      type(normal_law_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point
      type(spot_in_circuit_t), intent(in) :: circuit
      !> How the force changes (24)
      real(dp), intent(in) :: dforce(n_motions)
      real(dp) :: row(n_motions)

      row = 0
      if (point%line_place > 0 .and. point%force > 0) then
         row = circuit%spot%conductance/point%force*dforce
      else if (.not. is_lens(law, point)) then
         row = circuit%spot%dconductance_dforce*circuit%follows*dforce
      end if
   end function spot_that_slides

   !> Arms of rigid bodies turn the forces of this iteration, not those of the law.
   pure subroutine add_supposed_force(point, nodes_p, forces)
      type(contact_point_t), intent(in) :: point
      !> Nodes of both elements (4)
      integer, intent(in) :: nodes_p(4)
      type(forces_t), intent(inout) :: forces
      real(dp) :: difference(n_motions)
      integer :: a, first

      if (.not. allocated(forces%supposed)) return
      difference = (point%force - point%geometric_force)*point%kinematics%dgap &
         + (point%turning%denergy - point%torque)*point%kinematics%rows%dangle
      do a = 1, size(nodes_p)
         first = (a - 1)*(n_motions/size(nodes_p)) + 1
         associate (supposed => forces%supposed(:, nodes_p(a)))
            supposed = supposed + difference(first:first + size(supposed) - 1)
         end associate
      end do
   end subroutine add_supposed_force

   !> The row of the gap is linear in the force: what this iteration linearises about differs from the law's.
   subroutine add_iteration_force(point, nodes_p, forces)
      type(contact_point_t), intent(in) :: point
      !> Nodes of both elements (4)
      integer, intent(in) :: nodes_p(4)
      type(forces_t), intent(inout) :: forces
      real(dp) :: difference(n_motions)
      integer :: a

      difference = 0
      if (allocated(point%friction_iteration)) difference = point%friction_iteration%difference
      difference = difference - (point%iteration_force - point%force)*point%kinematics%dgap &
         + (point%iteration_torque - point%torque)*point%kinematics%rows%dangle
      associate (iteration => forces%iteration(motion_slots(1):motion_slots(2), :))
         do a = 1, size(nodes_p)
            iteration(:, nodes_p(a)) = iteration(:, nodes_p(a)) &
               + difference((a - 1)*size(iteration, 1) + 1:a*size(iteration, 1))
         end do
      end associate
   end subroutine add_iteration_force

   !> Where contacts share elements their currents depend on each other: what that changes (theory section 7).
   subroutine share_currents(model, wires, elements, potential, contact, forces)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Of the nodes (n_nodes) [V]
      real(dp), intent(in) :: potential(:)
      type(contact_set_t), intent(inout) :: contact
      type(forces_t), intent(inout) :: forces
      integer, allocatable :: points(:), line_points(:)
      real(dp), allocatable, dimension(:) :: current, voltage, of_others
      real(dp), allocatable :: rise(:, :)
      integer :: k, n

      allocate (points, source=in_circuit(model, contact%points))
      allocate (line_points, source=pack([(k, k=1, size(contact%line_points))], contact%line_points%conductance > 0))
      n = size(points)
      call conductors_of(model, wires, elements, contact, points, line_points, contact%shared)
      if (.not. contact%shared%present) return
      voltage = contact%shared%voltages(potential)
      allocate (current(size(voltage)), rise(2, size(voltage)), of_others(size(voltage)))
      call contact%shared%currents(voltage, current, rise, of_others)
      call contact%shared%add_beyond(voltage, current, forces%internal(potential_slots(1), :))
      do k = 1, n
         call set_current(current(k), rise(:, k), of_others(k), contact%points(points(k)))
      end do
      do k = 1, size(line_points)
         call set_current(current(n + k), rise(:, n + k), of_others(n + k), contact%line_points(line_points(k)))
      end do
   end subroutine share_currents

   !> Contacts that carry currents, and what these do to each other.
   subroutine conductors_of(model, wires, elements, contact, points, line_points, shared)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      !> Which of the crossings (n) and of the points of lines (m)
      integer, intent(in) :: points(:), line_points(:)
      type(shared_conductors_t), intent(out) :: shared
      integer, allocatable :: pairs(:, :), nodes(:, :)
      real(dp), allocatable :: conductance(:), xi(:, :), normal(:, :)
      type(mutual_resistances_t) :: strips, spots
      logical, allocatable :: is_line(:)
      integer :: k, n

      n = size(points)
      associate (a => contact%points, b => contact%line_points)
         pairs = reshape([elements_by_point(a, points), elements_by_point(b, line_points)], [2, n + size(line_points)])
         nodes = reshape([(model%connectivity(:, pairs(1, k)), model%connectivity(:, pairs(2, k)), &
            k=1, size(pairs, 2))], [4, size(pairs, 2)])
         conductance = [a(points)%conductance, b(line_points)%conductance]
         xi = reshape([places_by_point(a, points), places_by_point(b, line_points)], shape(pairs))
         normal = reshape([(a(points(k))%kinematics%normal, k=1, n), (b(line_points(k))%kinematics%normal, k=1, &
            size(line_points))], [3, size(pairs, 2)])
         is_line = [(k > n, k=1, size(pairs, 2))]
         call collect_strips(model, wires, elements, contact%places, pairs, xi, normal, is_line, &
            reshape([constrictions_by_point(model, elements, a, points), &
            constrictions_by_point(model, elements, b, line_points)], shape(pairs)), strips)
         call collect_spots(model, wires, elements, spots_t(pairs, xi, normal, reshape([axes_by_point(a, points), &
            axes_by_point(b, line_points)], [3, 2, size(pairs, 2)]), 1/conductance, is_line, &
            feels_others(model, [a(points)%pair, b(line_points)%pair])), spots)
         call collect_shared(pairs, nodes, xi, reshape([resistances_by_point(a, points), &
            resistances_by_point(b, line_points)], shape(pairs)), 1/conductance, both_of(strips, spots), shared)
      end associate
   end subroutine conductors_of

   !> Points whose current meets a resistance within an element, or feels that of other points.
   pure function in_circuit(model, points) result(members)
      type(model_t), intent(in) :: model
      type(contact_point_t), intent(in) :: points(:)
      integer, allocatable :: members(:)
      integer :: i

      allocate (members, source=pack([(i, i=1, size(points))], [(points(i)%conductance > 0 .and. &
         (any(points(i)%series_resistance > 0) .or. feels_others(model, points(i)%pair)), i=1, size(points))]))
   end function in_circuit

   !> The spot law of a contact pair asks for what spots beside a spot add.
   elemental logical function feels_others(model, pair)
      type(model_t), intent(in) :: model
      !> Number of the pair
      integer, intent(in) :: pair

      feels_others = model%interactions(model%contact_pairs(pair)%interaction)%mutual_resistance
   end function feels_others

   !> Elements, places in them, and resistances of the elements, barred before unbarred, point after point.
   pure function elements_by_point(points, members) result(elements)
      type(contact_point_t), intent(in) :: points(:)
      !> Which of them (n)
      integer, intent(in) :: members(:)
      integer :: elements(2*size(members)), i

      elements = [(points(members(i))%element_bar, points(members(i))%element, i=1, size(members))]
   end function elements_by_point

   pure function axes_by_point(points, members) result(axes)
      type(contact_point_t), intent(in) :: points(:)
      !> Which of them (n)
      integer, intent(in) :: members(:)
      real(dp) :: axes(6*size(members))
      integer :: i

      axes = [(points(members(i))%kinematics%point_bar, points(members(i))%kinematics%point, i=1, size(members))]
   end function axes_by_point

   pure function places_by_point(points, members) result(xi)
      type(contact_point_t), intent(in) :: points(:)
      !> Which of them (n)
      integer, intent(in) :: members(:)
      real(dp) :: xi(2*size(members))
      integer :: i

      xi = [(points(members(i))%xi_bar, points(members(i))%xi, i=1, size(members))]
   end function places_by_point

   pure function resistances_by_point(points, members) result(resistance)
      type(contact_point_t), intent(in) :: points(:)
      !> Which of them (n)
      integer, intent(in) :: members(:)
      real(dp) :: resistance(2*size(members))
      integer :: i

      resistance = [(points(members(i))%series_resistance, i=1, size(members))]
   end function resistances_by_point

   !> Resistances of the constrictions over the resistivities [1/m]; a resistance that is given is all constriction.
   pure function constrictions_by_point(model, elements, points, members) result(constrictions)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: points(:)
      !> Which of them (n)
      integer, intent(in) :: members(:)
      real(dp) :: constrictions(2, size(members))
      type(material_place_t) :: metals(2)
      integer :: i

      do i = 1, size(members)
         associate (point => points(members(i)))
            constrictions(:, i) = point%constriction
            if (point%constriction(1) > 0) cycle
            metals(1) = material_at(model, elements, point%element_bar, point%xi_bar)
            metals(2) = material_at(model, elements, point%element, point%xi)
            constrictions(:, i) = 1/(point%conductance*sum(metals%resistivity))
         end associate
      end do
   end function constrictions_by_point

   !> The current of a point with a conductance, and what follows from it.
   pure subroutine set_current(current, rise, of_others, point)
      !> [A], and rise of the potential above the linear one in either element (2) [V], barred first
      real(dp), intent(in) :: current, rise(2)
      !> What other contacts on its wires add to its voltage [V]
      real(dp), intent(in) :: of_others
      type(contact_point_t), intent(inout) :: point

      point%current = current
      point%voltage_gap = current/point%conductance
      point%heat_of_others = current*of_others
      point%heat_inside = current*[-rise(1), rise(2)]
   end subroutine set_current

   !> Temperatures linear between the nodes; where temperatures are solved for, those of the heat through the contact
   !> take their place.
   pure subroutine keep_temperatures(elements, point)
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(inout) :: point

      point%temperature_bar = along_element(elements%temperature(:, point%element_bar), point%xi_bar)
      point%temperature = along_element(elements%temperature(:, point%element), point%xi)
      point%temperature_max = max(point%temperature_bar, point%temperature)
   end subroutine keep_temperatures

   elemental subroutine clear_flows(point)
      type(contact_point_t), intent(inout) :: point

      point%new_spot = .false.
      point%conductance = 0
      point%constriction = 0
      point%current = 0
      point%voltage_gap = 0
      point%series_resistance = 0
      point%heat_inside = 0
      point%heat_of_others = 0
      point%temperature_bar = 0
      point%temperature = 0
      point%temperature_max = 0
      point%heat_bar = 0
      point%heat = 0
      point%semi_major = 0
      point%semi_minor = 0
   end subroutine clear_flows

end module litz_contact_forces
