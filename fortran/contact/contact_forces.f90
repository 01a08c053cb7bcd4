!> Forces and currents of the crossings, and their part of the system.
!>
!> The contact force is an independent variable of the iteration (theory section 9): the law is linearised as
!> `delta(F)`, whether a point is active follows from the predicted gap and force, and the geometric stiffness takes the
!> independent force. The converged force is that of the law at the true gap.
module litz_contact_forces
   use litz_kinds, only: dp
   use litz_contact_kinematics, only: n_motions
   use litz_contact_blocks, only: contact_blocks, contact_force_t, spot_in_circuit_t
   use litz_contact_electricity, only: contact_electricity_t
   use litz_contact_mechanics, only: form_hessian
   use litz_contact_history, only: force_of_spot
   use litz_contact_points, only: contact_set_t, contact_point_t, pair_geometry, clearance_of, law_ok, law_parallel, &
      law_bad_data
   use litz_domain, only: domain_t
   use litz_element_library, only: elements_t
   use litz_errors, only: error_t, fail, exit_input
   use litz_fields, only: group_mechanical, motion_slots, potential_slots
   use litz_friction_forces, only: find_friction
   use litz_friction_iteration, only: predict_friction, forget_friction
   use litz_friction_law, only: friction_law_t, friction_slip
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok
   use litz_law_input, only: wire_pair_t
   use litz_model, only: model_t, interaction_t
   use litz_normal_law, only: force_of_gap_t, force_at_gap, linearise
   use litz_parallel, only: worth_threads
   use litz_scatter, only: forces_t, chunk
   use litz_shared_conductors, only: collect_shared
   use litz_spot_law, only: contact_spot_t, contact_spot, spot_ok
   use litz_text, only: to_text
   use litz_timing, only: phase_contact, phase_assembly
   use litz_wires, only: wires_t, arc_from_to
   implicit none
   private
   public :: apply_normal_law, assemble_contacts, predict_contacts, refused_contact

   !> At first touch the Hertz law is linearised about the force of an overlap of at most this fraction of the radius
   real(dp), parameter :: first_overlap = 1.0e-3_dp

contains

   !> Both wires of a point, barred first.
   pure type(wire_pair_t) function wires_of(model, elements, point) result(pair)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point
      integer :: i, both(2)

      both = [point%element_bar, point%element]
      do i = 1, 2
         associate (material => model%materials(model%sections(model%element_section(both(i)))%material))
            pair%young(i) = material%young
            pair%poisson(i) = material%poisson
         end associate
      end do
      pair%radius = elements%radius(both)
      pair%resistivity = elements%resistivity(both)
      if (model%interactions(model%contact_pairs(point%pair)%interaction)%voltage_correction) then
         pair%series_resistance = pair%resistivity*elements%length(both)/(4*elements%area(both))
      end if
   end function wires_of

   !> Force of every point at its present gap, and the force and stiffness this iteration linearises about.
   subroutine apply_normal_law(model, elements, contact)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(inout) :: contact
      integer :: i

      !$omp parallel do schedule(static) if (size(contact%points) >= worth_threads)
      do i = 1, size(contact%points)
         call evaluate(contact%points(i))
      end do
      !$omp end parallel do

   contains

      subroutine evaluate(point)
         type(contact_point_t), intent(inout) :: point
         type(wire_pair_t) :: pair

         point%closed = point%gap < 0
         point%active = merge(point%predicted_gap < 0, point%closed, point%predicted)
         point%at_gap = force_of_gap_t()
         point%law_status = law_ok
         point%force = 0
         point%stiffness = 0
         point%iteration_force = 0
         point%geometric_force = max(point%mixed_force, 0.0_dp)
         if (.not. point%active) point%mixed_force = 0
         if (.not. (point%active .or. point%closed)) return
         pair = wires_of(model, elements, point)
         associate (law => model%interactions(model%contact_pairs(point%pair)%interaction))
            if (law%normal%uses_ellipse .or. law%spot%uses_ellipse) call find_ellipse(pair, point)
            if (point%law_status /= law_ok) return
            point%at_gap = force_at_gap(law%normal, point%gap, pair, point%ellipse)
            point%force = point%at_gap%force
            if (point%active) call linearise(law%normal, point%gap, first_overlap*minval(pair%radius), pair, &
               point%ellipse, point%mixed_force, point%stiffness, point%iteration_force)
         end associate
      end subroutine evaluate

   end subroutine apply_normal_law

   pure subroutine find_ellipse(pair, point)
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(inout) :: point
      integer :: info

      call hertz_ellipse(pair%radius, pair%young, pair%poisson, point%kinematics%angle, point%ellipse, info)
      if (info /= hertz_ok) point%law_status = law_parallel
   end subroutine find_ellipse

   !> Why an iteration cannot go on with these contacts; empty where it can. A smaller increment may not come here.
   pure function refused_contact(model, contact) result(words)
      type(model_t), intent(in) :: model
      type(contact_set_t), intent(in) :: contact
      character(len=:), allocatable :: words
      integer :: i

      words = ''
      do i = 1, size(contact%points)
         if (contact%points(i)%law_status /= law_parallel) cycle
         words = 'wires have become parallel where they touch ('//elements_of(model, contact%points(i))// &
            '): the law of a contact at a point needs wires that cross'
         return
      end do
   end function refused_contact

   !> The first contact whose spot law does not take its data; no increment is small enough for that.
   subroutine refuse_bad_data(model, contact, error)
      type(model_t), intent(in) :: model
      type(contact_set_t), intent(in) :: contact
      type(error_t), allocatable, intent(out) :: error
      integer :: i

      do i = 1, size(contact%points)
         if (contact%points(i)%law_status /= law_bad_data) cycle
         associate (law => model%interactions(model%contact_pairs(contact%points(i)%pair)%interaction))
            error = fail(exit_input, 'surface interaction '//law%name//': the data of the spot law '// &
               trim(law%spot%name)//' are not what it needs ('//elements_of(model, contact%points(i))//')')
         end associate
         return
      end do
   end subroutine refuse_bad_data

   pure function elements_of(model, point) result(words)
      type(model_t), intent(in) :: model
      type(contact_point_t), intent(in) :: point
      character(len=:), allocatable :: words

      words = 'elements '//to_text(model%element_id(point%element_bar))//' and '// &
         to_text(model%element_id(point%element))
   end function elements_of

   !> Add all points to the system: mechanics, and where a current can cross, the paper's electric blocks.
   subroutine assemble_contacts(domain, contact, error)
      type(domain_t), intent(inout) :: domain
      type(contact_set_t), intent(inout) :: contact
      !> Data that a law cannot take
      type(error_t), allocatable, intent(out) :: error
      real(dp), allocatable :: k(:, :, :), r(:, :), k_ee(:, :, :), r_e(:, :), k_me(:, :, :)
      integer, allocatable :: touching(:), nodes(:, :)
      integer :: first, n, i

      touching = pack([(i, i=1, size(contact%points))], contact%points%active .or. contact%points%closed)
      n = min(chunk, size(touching))
      allocate (k(n_motions, n_motions, n), r(n_motions, n), k_ee(4, 4, n), r_e(4, n), k_me(4, n_motions, n))
      allocate (nodes(4, n))
      call clear_results(contact%points)
      do first = 1, size(touching), chunk
         n = min(chunk, size(touching) - first + 1)
         associate (points => touching(first:first + n - 1))
            !$omp parallel do schedule(static) if (n >= worth_threads)
            do i = 1, n
               call evaluate(contact%points(points(i)), nodes(:, i), k(:, :, i), r(:, i), k_ee(:, :, i), r_e(:, i), &
                  k_me(:, :, i))
            end do
            !$omp end parallel do
            if (any(contact%points(points)%friction_iteration%limit > 0)) then
               domain%matrix%symmetric(group_mechanical) = .false.
            end if
            do i = 1, n
               call add_iteration_force(contact%points(points(i)), nodes(:, i), domain%forces)
            end do
            call domain%timing%lap(phase_contact)
            call domain%add_cells(nodes(:, :n), motion_slots, motion_slots, k(:, :, :n), r(:, :n))
            if (any(contact%points(points)%conductance > 0)) then
               call domain%add_cells(nodes(:, :n), potential_slots, potential_slots, k_ee(:, :, :n), r_e(:, :n))
               call domain%add_cells(nodes(:, :n), potential_slots, motion_slots, k_me(:, :, :n))
            end if
            call domain%timing%lap(phase_assembly)
         end associate
      end do
      call refuse_bad_data(domain%model, contact, error)
      if (allocated(error)) return
      call share_currents(domain%model, domain%iterate%value(potential_slots(1), :), contact, domain%forces)
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
         real(dp) :: x(3, 4), t(3, 4), length(2)
         real(dp) :: k_friction(n_motions, n_motions), r_friction(n_motions)
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
            if (law%friction > 0) call find_friction(law, wires, x, t, length, pair, motion(nodes_p), &
               clearance_of(point%fit, contact%converged_clearance(point%pair)) &
               - clearance_of(point%fit, contact%clearance(point%pair)), point, k_friction, r_friction)
            conducts = point%closed .and. all(pair%resistivity > 0) .and. law%spot%exists()
            if (conducts) call find_spot(law, wires, pair, point, circuit)
            call contact_blocks(point%kinematics, t, iterate%value(potential_slots(1), nodes_p), &
               contact_force_t(point%force, point%geometric_force, point%stiffness, 0.0_dp, point%at_gap), circuit, &
               form_hessian, k_p, r_p, k_me_p, k_ee_p, r_e_p, electricity)
            if (law%friction > 0) then
               k_p = k_p + k_friction
               r_p = r_p + r_friction
            end if
            if (conducts) call keep_current(electricity, circuit, point)
         end associate
      end subroutine evaluate

      !> Displacements and rotations of nodes since the increment began.
      pure function motion(nodes_p) result(dq)
         !> Nodes of both elements (4)
         integer, intent(in) :: nodes_p(4)
         real(dp) :: dq(n_motions)

         dq = reshape(domain%iterate%change(motion_slots(1):motion_slots(2), nodes_p), [n_motions])
      end function motion

   end subroutine assemble_contacts

   !> The spot of a closed contact between conductors.
   subroutine find_spot(law, wires, pair, point, circuit)
      type(interaction_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(inout) :: point
      type(spot_in_circuit_t), intent(out) :: circuit
      real(dp) :: spot_force
      integer :: info

      if (law%spot_memory) point%new_spot = leaves_spot(law, wires, pair, point)
      call force_of_spot(law%spot_memory, point%history, point%force, point%new_spot, spot_force, circuit%follows)
      call contact_spot(law%spot, spot_force, pair, point%ellipse, circuit%spot, info)
      if (info /= spot_ok) point%law_status = law_bad_data
      circuit%series_resistance = pair%series_resistance
   end subroutine find_spot

   !> What results show of a current.
   pure subroutine keep_current(electricity, circuit, point)
      type(contact_electricity_t), intent(in) :: electricity
      type(spot_in_circuit_t), intent(in) :: circuit
      type(contact_point_t), intent(inout) :: point

      point%semi_major = circuit%spot%semi_major
      point%semi_minor = circuit%spot%semi_minor
      point%conductance = circuit%spot%conductance
      point%current = electricity%current
      point%voltage_gap = electricity%voltage_gap
      point%series_resistance = circuit%series_resistance
      point%heat_inside = point%current**2*circuit%series_resistance*(1 - [point%xi_bar, point%xi]**2)
   end subroutine keep_current

   !> The row of the gap is linear in the force: what this iteration linearises about differs from the law's.
   subroutine add_iteration_force(point, nodes_p, forces)
      type(contact_point_t), intent(in) :: point
      !> Nodes of both elements (4)
      integer, intent(in) :: nodes_p(4)
      type(forces_t), intent(inout) :: forces
      real(dp) :: difference(n_motions)
      integer :: a

      difference = point%friction_iteration%difference - (point%iteration_force - point%force)*point%kinematics%dgap
      associate (iteration => forces%iteration(motion_slots(1):motion_slots(2), :))
         do a = 1, size(nodes_p)
            iteration(:, nodes_p(a)) = iteration(:, nodes_p(a)) &
               + difference((a - 1)*size(iteration, 1) + 1:a*size(iteration, 1))
         end do
      end associate
   end subroutine add_iteration_force

   !> A contact that remembers its spot is no longer at it. With friction it has slipped; without, it has moved along
   !> one of its wires by more than the spot, which where the law has none is that of Hertz.
   pure logical function leaves_spot(law, wires, pair, point) result(leaves)
      type(interaction_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      type(contact_spot_t) :: spot
      real(dp) :: moved(2), size_of_spot
      integer :: info

      leaves = point%friction%status == friction_slip
      if (law%friction > 0 .or. .not. point%history%largest_force > 0) return
      moved = abs(arc_from_to(point%history%spot_arc, [point%arc_bar, point%arc], &
         wires%circumference(wires%wire([point%element_bar, point%element]))))
      call contact_spot(law%spot, point%history%largest_force, pair, point%ellipse, spot, info)
      size_of_spot = spot%semi_major
      if (info /= spot_ok .or. .not. size_of_spot > 0) size_of_spot = &
         ellipse_of(pair, point%kinematics%angle)*point%history%largest_force**(1.0_dp/3)
      leaves = maxval(moved) > size_of_spot
   end function leaves_spot

   !> Greater half axis of the Hertz ellipse of 1 N [m].
   pure real(dp) function ellipse_of(pair, angle) result(semi_major)
      type(wire_pair_t), intent(in) :: pair
      !> Between the axes [rad]
      real(dp), intent(in) :: angle
      type(hertz_ellipse_t) :: ellipse
      integer :: info

      semi_major = 0
      call hertz_ellipse(pair%radius, pair%young, pair%poisson, angle, ellipse, info)
      if (info == hertz_ok) semi_major = ellipse%semi_major
   end function ellipse_of

   !> Where contacts share elements their currents depend on each other: what that changes (theory section 7).
   subroutine share_currents(model, potential, contact, forces)
      type(model_t), intent(in) :: model
      !> Of the nodes (n_nodes) [V]
      real(dp), intent(in) :: potential(:)
      type(contact_set_t), intent(inout) :: contact
      type(forces_t), intent(inout) :: forces
      integer, allocatable :: together(:), pairs(:, :), nodes(:, :)
      real(dp), allocatable :: current(:), rise(:, :), voltage(:)
      integer :: i, k

      associate (points => contact%points)
         together = pack([(i, i=1, size(points))], [(points(i)%conductance > 0 .and. &
            any(points(i)%series_resistance > 0), i=1, size(points))])
         pairs = reshape([(points(together(k))%element_bar, points(together(k))%element, k=1, size(together))], &
            [2, size(together)])
         nodes = reshape([(model%connectivity(:, pairs(1, k)), model%connectivity(:, pairs(2, k)), &
            k=1, size(together))], [4, size(together)])
         call collect_shared(pairs, nodes, reshape([(points(together(k))%xi_bar, points(together(k))%xi, &
            k=1, size(together))], [2, size(together)]), reshape([(points(together(k))%series_resistance, &
            k=1, size(together))], [2, size(together)]), 1/points(together)%conductance, contact%shared)
         if (.not. contact%shared%present) return
         voltage = contact%shared%voltages(potential)
         allocate (current(size(together)), rise(2, size(together)))
         call contact%shared%currents(voltage, current, rise)
         call contact%shared%add_beyond(voltage, current, forces%internal(potential_slots(1), :))
         do k = 1, size(together)
            associate (point => points(together(k)))
               point%current = current(k)
               point%voltage_gap = current(k)/point%conductance
               point%heat_inside = current(k)*[-rise(1, k), rise(2, k)]
            end associate
         end do
      end associate
   end subroutine share_currents

   elemental subroutine clear_results(point)
      type(contact_point_t), intent(inout) :: point

      if (.not. (point%active .or. point%closed)) call forget_friction(point%friction_iteration)
      point%friction = friction_law_t()
      point%new_spot = .false.
      point%traction = 0
      point%conductance = 0
      point%current = 0
      point%voltage_gap = 0
      point%series_resistance = 0
      point%heat_inside = 0
      point%semi_major = 0
      point%semi_minor = 0
   end subroutine clear_results

   !> Take each point's force and gap along with the step `eta dq` of the unknowns.
   subroutine predict_contacts(model, eta, step, contact)
      type(model_t), intent(in) :: model
      !> Fraction of the step that is taken, and the step (n_slots, n_nodes)
      real(dp), intent(in) :: eta, step(:, :)
      type(contact_set_t), intent(inout) :: contact
      real(dp) :: dq(n_motions), dgap, force
      integer :: i, nodes(4)

      do i = 1, size(contact%points)
         associate (point => contact%points(i))
            nodes = [model%connectivity(:, point%element_bar), model%connectivity(:, point%element)]
            dq = reshape(step(motion_slots(1):motion_slots(2), nodes), [n_motions])
            dgap = dot_product(point%kinematics%dgap, dq)
            call predict_friction(eta*dq, point%friction_iteration)
            point%predicted = .true.
            point%predicted_gap = point%gap + eta*dgap
            if (.not. point%active) cycle
            force = (1 - eta)*point%mixed_force + eta*(point%iteration_force - point%stiffness*dgap)
            ! a contact that would have to pull opens, even if the linearised law leaves it an overlap
            if (force <= 0) point%predicted_gap = max(point%predicted_gap, 0.0_dp)
            point%mixed_force = max(force, 0.0_dp)
         end associate
      end do
   end subroutine predict_contacts

end module litz_contact_forces
