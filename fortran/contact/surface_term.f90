!> Contacts of wires with rigid surfaces, as one of the terms of the equations.
!>
!> The far field of a lens is that of a state in balance: while the iteration goes there it stays, so that forces are
!> the gradient of an energy; where it has converged the far field is updated, and it continues until the forces balance
!> with it. Source: theory section 12.
module litz_surface_term
   use litz_kinds, only: dp
   use litz_contact_tangents, only: follow_centre_line
   use litz_domain, only: domain_t
   use litz_errors, only: error_t
   use litz_contact_energies, only: work_on_surfaces, softening_on_surfaces
   use litz_element_library, only: material_at
   use litz_fields, only: motion_slots
   use litz_contact_kinematics, only: n_motions
   use litz_friction_iteration, only: friction_iteration_t, predict_friction, forget_friction
   use litz_friction_law, only: friction_law_t
   use litz_line_law, only: line_wires_t
   use litz_model, only: step_t
   use litz_rigid_line, only: relative_curvature_t, same_law
   use litz_rigid_surface, only: rigid_surface_t
   use litz_state, only: energies_t
   use litz_surface_cells, only: surface_cell_t, wire_axis_t, survey_cell, curvature_of_cell, law_of_cell, take_law, &
      contact_of_cell, centre_of_force
   use litz_surface_ends, only: find_ends, update_ends
   use litz_surface_findings, only: most_turn
   use litz_surface_flows, only: request_flow_slots, add_flows, link_flows, note_flows
   use litz_surface_forces, only: press_cell, energies_of_cell, cell_forces, predicted_force
   use litz_surface_friction, only: stick_stiffness_of
   use litz_surface_memory, only: recall_memory, keep_memory
   use litz_surface_poses, only: present_surface, element_axis, surface_node, surface_turn, work_of_radii
   use litz_surface_rubbing, only: rubbing_turn, touched_t, sticking_of, rub, find_friction_work, rubbing_of_cells
   use litz_surface_swelling, only: add_swelling
   use litz_term, only: term_t, status_t, max_anticipations, nearly_balanced
   use litz_text, only: to_text
   use litz_timing, only: phase_contact, phase_update
   implicit none
   private
   public :: surface_term_t, new_surface_term

   !> Gap over the radius within which a wire has the law of its place
   real(dp), parameter :: reach = 1
   !> Relative change of the logarithm of the far field that is worth another iteration, and updates at most
   real(dp), parameter :: settled = 1.0e-4_dp
   integer, parameter :: most_updates = 4
   !> Relative change of the stiffness of a stick that is worth it
   real(dp), parameter :: stick_tolerance = 0.01_dp
   !> Turn of a surface with friction in an increment, whose chord is 0.3 % short [rad]
   real(dp), parameter :: most_turn_with_friction = 0.25_dp

   type, extends(term_t) :: surface_term_t
      type(surface_cell_t), allocatable :: cells(:)
      !> How often laws have been updated in this increment
      integer :: updates = 0, anticipations = 0
      !> Forces of surfaces that are fixed in space on the nodes (6, n_nodes) [N, N m]
      real(dp), allocatable :: outer(:, :)
      type(touched_t), allocatable :: touched(:)
   contains
      procedure :: request_slots
      procedure :: connect
      procedure :: start
      procedure :: evaluate
      procedure :: count_status
      procedure :: link
      procedure :: predict
      procedure :: anticipate
      procedure :: settle
      procedure :: add_energies
      procedure :: bearable_increment
      procedure :: accept
   end type surface_term_t

contains

   !> A cell for each element that may touch a surface, by the laws of the last contact pair that names both.
   pure type(surface_term_t) function new_surface_term(domain) result(term)
      type(domain_t), intent(in) :: domain
      integer :: last_pair(domain%model%n_elements), pair, i
      integer, allocatable :: mine(:)

      allocate (term%cells(0))
      associate (pairs => domain%model%surface_pairs)
         do pair = 1, size(pairs)
            last_pair = 0
            do i = 1, size(pairs)
               if (pairs(i)%surface /= pairs(pair)%surface) cycle
               last_pair(domain%model%element_sets(pairs(i)%set)%members) = i
            end do
            associate (members => domain%model%element_sets(pairs(pair)%set)%members)
               mine = pack(members, last_pair(members) == pair)
            end associate
            term%cells = [term%cells, (surface_cell_t(element=mine(i), pair=pair), i=1, size(mine))]
            do i = size(term%cells) - size(mine) + 1, size(term%cells)
               call find_ends(domain%wires, domain%elements%radius, &
                  domain%model%connectivity(:, term%cells(i)%element), last_pair > 0, term%cells(i))
            end do
         end do
      end associate
   end function new_surface_term

   !> A surface that moves has all motions of its node.
   subroutine request_slots(self, domain, exists)
      class(surface_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> (n_slots, n_nodes)
      logical, intent(inout) :: exists(:, :)
      integer :: i

      do i = 1, size(domain%model%surfaces)
         associate (node => domain%model%surfaces(i)%node)
            if (node > 0) exists(motion_slots(1):motion_slots(2), node) = .true.
         end associate
      end do
      call request_flow_slots(domain, exists)
   end subroutine request_slots

   subroutine connect(self, domain, nodes)
      class(surface_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> Nodes of each element and of the surface that it may touch (3, cells)
      integer, allocatable, intent(out) :: nodes(:, :)
      integer :: i, n

      allocate (nodes(3, size(self%cells)))
      n = 0
      do i = 1, size(self%cells)
         if (surface_node(domain, self%cells(i)) == 0) cycle
         n = n + 1
         nodes(:, n) = [domain%model%connectivity(:, self%cells(i)%element), surface_node(domain, self%cells(i))]
      end do
      nodes = nodes(:, :n)
   end subroutine connect

   !> What does not change in the iteration is that of the last converged state.
   subroutine start(self, domain)
      class(surface_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      logical :: has_changed

      if (size(self%cells) == 0) return
      call follow_centre_line(domain%model, domain%elements, domain%iterate%x, domain%iterate%rotation, domain%wires)
      call recall_memory(domain, self%cells)
      call survey(self, domain)
      call update_laws(self, domain, 0.0_dp, has_changed)
      self%updates = 0
      self%anticipations = 0
      call press(self, domain)
      call remember(self, domain)
      self%cells%predicted = -1
   end subroutine start

   !> Friction acts where the force was in the last converged state.
   subroutine remember(self, domain)
      class(surface_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      integer :: i

      do i = 1, size(self%cells)
         associate (cell => self%cells(i))
            cell%has_place = cell%memory%closed .and. cell%force > 0
            cell%part = 1
            cell%iteration = friction_iteration_t()
            if (.not. cell%has_place) cycle
            cell%xi = centre_of_force(cell)
            cell%stick_stiffness = stick_stiffness_of(sticking_of(domain, cell), cell)
         end associate
      end do
      self%touched = [(touched_t(self%cells(i)%element, self%cells(i)%pair), i=1, size(self%cells))]
      self%touched = pack(self%touched, self%cells%has_place)
      call keep_friction(self, domain)
   end subroutine remember

   !> What friction has done in this increment, for those who take its heat.
   subroutine keep_friction(self, domain)
      class(surface_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      integer :: i

      do i = 1, size(self%cells)
         call find_friction_work(domain, self%cells(i))
      end do
      domain%surface_rubbing = rubbing_of_cells(domain, self%cells)
   end subroutine keep_friction

   !> Forces of the overlaps that were surveyed.
   subroutine press(self, domain)
      class(surface_term_t), intent(inout) :: self
      type(domain_t), intent(in) :: domain
      integer :: i

      !$omp parallel do schedule(dynamic)
      do i = 1, size(self%cells)
         call press_one(domain, self%cells(i))
      end do
      !$omp end parallel do
   end subroutine press

   !> Forces of a cell.
   subroutine press_one(domain, cell)
      type(domain_t), intent(in) :: domain
      type(surface_cell_t), intent(inout) :: cell

      associate (law => domain%model%interactions(domain%model%surface_pairs(cell%pair)%interaction)%normal)
         call press_cell(present_surface(domain, cell%pair), element_axis(domain, cell%element, cell%pair), &
            law%line_penalty(), cell)
      end associate
      cell%friction = friction_law_t()
      cell%dfriction_work = 0
      cell%traction = 0
      if (.not. cell%force > 0) call forget_friction(cell%iteration)
   end subroutine press_one

   !> Find the overlaps of the present iterate.
   subroutine survey(self, domain)
      class(surface_term_t), intent(inout) :: self
      type(domain_t), intent(in) :: domain
      type(wire_axis_t) :: axis
      integer :: i

      do i = 1, size(self%cells)
         associate (cell => self%cells(i))
            axis = element_axis(domain, cell%element, cell%pair)
            call survey_cell(present_surface(domain, cell%pair), axis, reach*axis%radius, cell)
         end associate
      end do
   end subroutine survey

   !> Laws of what was surveyed.
   subroutine update_laws(self, domain, tolerance, has_changed)
      class(surface_term_t), intent(inout) :: self
      type(domain_t), intent(in) :: domain
      !> Relative changes up to this are left alone; 0: none is
      real(dp), intent(in) :: tolerance
      !> Something was updated
      logical, intent(out) :: has_changed
      type(line_wires_t) :: law
      type(relative_curvature_t) :: curvature
      type(rigid_surface_t) :: surface
      type(wire_axis_t) :: axis
      integer :: i

      has_changed = .false.
      do i = 1, size(self%cells)
         associate (cell => self%cells(i), model => domain%model)
            axis = element_axis(domain, cell%element, cell%pair)
            surface = present_surface(domain, cell%pair)
            curvature = curvature_of_cell(surface, axis, cell%overlap%nearest, maxval(cell%dents%deepest))
            associate (there => material_at(model, domain%elements, cell%element, cell%overlap%nearest), &
               normal => model%interactions(model%surface_pairs(cell%pair)%interaction)%normal)
               law = law_of_cell(axis, there%young, there%poisson, curvature)
               if (any(cell%has_end)) call update_ends(domain, surface, axis, tolerance, cell, &
                  has_changed)
               call update_stick(cell)
               if (tolerance > 0 .and. same_law(cell%law, law, -cell%overlap%gap, tolerance)) cycle
               call take_law(normal, law, there%young, there%poisson, curvature, cell)
            end associate
            has_changed = has_changed .or. cell%overlap%n > 0
         end associate
      end do

   contains

      !> The stiffness of the stick follows the force likewise.
      subroutine update_stick(cell)
         type(surface_cell_t), intent(inout) :: cell
         real(dp) :: stiffness

         if (.not. (tolerance > 0 .and. cell%has_place .and. cell%force > 0)) return
         stiffness = stick_stiffness_of(sticking_of(domain, cell), cell)
         if (abs(stiffness - cell%stick_stiffness) <= stick_tolerance*stiffness) return
         cell%stick_stiffness = stiffness
         has_changed = .true.
      end subroutine update_stick

   end subroutine update_laws

   subroutine evaluate(self, domain, error)
      class(surface_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Never
      type(error_t), allocatable, intent(out) :: error
      integer, allocatable :: closed(:)
      integer :: i

      if (size(self%cells) == 0) return
      if (domain%motions_stand) then
         call add_flows(domain, self%cells)
         return
      end if
      call domain%timing%lap(phase_update)
      call survey(self, domain)
      self%outer = spread([0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp], 2, domain%model%n_nodes)
      call press(self, domain)
      closed = pack([(i, i=1, size(self%cells))], self%cells%force > 0)
      call add_closed(self, domain, pack(closed, [(surface_node(domain, self%cells(closed(i))) == 0, &
         i=1, size(closed))]), 2)
      call add_closed(self, domain, pack(closed, [(surface_node(domain, self%cells(closed(i))) > 0, &
         i=1, size(closed))]), 3)
      call keep_friction(self, domain)
      call add_flows(domain, self%cells)
      call domain%timing%lap(phase_contact)
   end subroutine evaluate

   !> Add the forces of cells to the system.
   subroutine add_closed(self, domain, cells, n_of_cell)
      class(surface_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Their indices (n)
      integer, intent(in) :: cells(:)
      !> 2: of surfaces that are fixed in space, 3: of others
      integer, intent(in) :: n_of_cell
      real(dp) :: k(18, 18, size(cells)), r(18, size(cells))
      integer :: nodes(n_of_cell, size(cells)), i

      if (size(cells) == 0) return
      do i = 1, size(cells)
         associate (cell => self%cells(cells(i)))
            nodes(:2, i) = domain%model%connectivity(:, cell%element)
            if (n_of_cell > 2) nodes(3, i) = surface_node(domain, cell)
            call cell_forces(present_surface(domain, cell%pair), element_axis(domain, cell%element, cell%pair), cell, &
               k(:, :, i), r(:, i))
            call rub(domain, self%touched, cell, k(:, :, i), r(:, i))
            cell%on_surface = -r(13:18, i)
            if (n_of_cell == 2) self%outer(:, nodes(:, i)) = self%outer(:, nodes(:, i)) - reshape(r(:12, i), [6, 2])
         end associate
      end do
      call domain%add_cells(nodes, motion_slots, motion_slots, k(:6*n_of_cell, :6*n_of_cell, :), r(:6*n_of_cell, :))
      call add_swelling(domain, self%cells(cells), nodes)
   end subroutine add_closed

   subroutine count_status(self, status)
      class(surface_term_t), intent(in) :: self
      type(status_t), intent(inout) :: status

      associate (cells => self%cells)
         status%active = status%active + count(cells%force > 0)
         status%force = status%force + sum(cells%force)
         status%penetration = max(status%penetration, maxval(-cells%overlap%gap))
      end associate
   end subroutine count_status

   subroutine link(self, domain, field, pairs)
      class(surface_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> One of the fields of litz_fields
      integer, intent(in) :: field
      !> A node of a wire and that of the surface (2, pairs)
      integer, allocatable, intent(out) :: pairs(:, :)

      pairs = link_flows(domain, self%cells, field)
   end subroutine link

   subroutine predict(self, domain, eta, correction)
      class(surface_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Fraction of the step that is taken, and the step (n_slots, n_nodes)
      real(dp), intent(in) :: eta, correction(:, :)
      real(dp) :: step(18)
      integer :: i

      do i = 1, size(self%cells)
         associate (cell => self%cells(i), node => surface_node(domain, self%cells(i)))
            step = 0
            step(:12) = reshape(correction(motion_slots(1):motion_slots(2), &
               domain%model%connectivity(:, cell%element)), [12])
            if (node > 0) step(13:) = correction(motion_slots(1):motion_slots(2), node)
            cell%predicted = predicted_force(cell, eta*step)
            call predict_friction(eta*[step, spread(0.0_dp, 1, n_motions - 18)], cell%iteration)
         end associate
      end do
   end subroutine predict

   !> Forces are known well enough for the far field that goes with them.
   subroutine anticipate(self, domain, residual, has_moved)
      class(surface_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Largest force that is left over at any node [N]
      real(dp), intent(in) :: residual
      !> The forces must be evaluated again
      logical, intent(inout) :: has_moved
      real(dp) :: largest(2)

      if (.not. domain%processes%any(size(self%cells) > 0) .or. self%anticipations >= max_anticipations) return
      ! nothing has been predicted yet
      if (domain%processes%any(any(self%cells%predicted < 0))) return
      ! what is missed, and the force
      largest = domain%processes%largest([maxval(abs(self%cells%force - self%cells%predicted)), &
         maxval(self%cells%force)])
      if (max(residual, largest(1)) > nearly_balanced*largest(2)) return
      self%anticipations = self%anticipations + 1
      call self%settle(domain, has_moved)
      ! where forces balance, updates count anew
      self%updates = 0
   end subroutine anticipate

   !> The lenses have changed since the increment began: the forces are to balance with what they are now.
   subroutine settle(self, domain, has_moved)
      class(surface_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> The forces must be evaluated again
      logical, intent(inout) :: has_moved
      logical :: has_changed

      if (.not. domain%processes%any(size(self%cells) > 0)) return
      if (any(domain%elements%shear_flexible)) then
         call follow_centre_line(domain%model, domain%elements, domain%iterate%x, domain%iterate%rotation, domain%wires)
         call survey(self, domain)
         has_moved = .true.
      end if
      has_changed = .false.
      if (self%updates < most_updates) call update_laws(self, domain, settled, has_changed)
      has_changed = domain%processes%any(has_changed)
      if (has_changed) self%updates = self%updates + 1
      has_moved = has_moved .or. has_changed
   end subroutine settle

   subroutine add_energies(self, domain, energies)
      class(surface_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      type(energies_t), intent(inout) :: energies
      logical :: is_elastic(size(self%cells))
      real(dp) :: held(2, size(self%cells))
      integer :: i

      do i = 1, size(self%cells)
         held(:, i) = energies_of_cell(self%cells(i))
      end do
      associate (cells => self%cells, model => domain%model)
         is_elastic = [(.not. model%interactions(model%surface_pairs(cells(i)%pair)%interaction)%normal%line_penalty() &
            > 0, i=1, size(cells))]
         energies%contact = energies%contact + sum(held(1, :)) + sum(cells%memory%start%elastic_energy &
            + cells%friction%elastic_work, mask=cells%force > 0)
         energies%work = energies%work + sum(cells%friction%work_beyond_mean) + work_of_radii(domain, self%cells)
         energies%friction = energies%friction + sum(cells%friction_work)
         energies%yielding = energies%yielding + sum(held(2, :))
         energies%thermal = energies%thermal + work_on_surfaces(domain%model, domain%elements, &
            domain%state%mechanical_temperature, domain%mechanical_temperature(), cells%element, &
            (cells%force + merge(cells%memory%start%force, 0.0_dp, cells%memory%closed))/2)
         energies%thermal = energies%thermal + softening_on_surfaces(domain%model, domain%elements, &
            domain%state%mechanical_temperature, pack(cells%element, is_elastic), &
            pack(cells%overlap%nearest, is_elastic), pack(cells%memory%energy, is_elastic), &
            pack(held(1, :), is_elastic))
      end associate
   end subroutine add_energies

   !> Surfaces turn by a right angle at most, and those that rub wires by 0.25 rad, as slip is that of the chord.
   subroutine bearable_increment(self, domain, step, ratio, reason)
      class(surface_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      type(step_t), intent(in) :: step
      !> Over the one that has converged
      real(dp), intent(out) :: ratio
      !> Why no larger one is, for messages
      character(len=:), allocatable, intent(out) :: reason
      integer :: i

      reason = 'a rigid surface with friction turns by more than '//to_text(most_turn_with_friction)//' rad'
      ratio = 1/max(rubbing_turn(domain, self%cells)/most_turn_with_friction, maxval([(surface_turn(domain, i), &
         i=1, size(domain%model%surfaces))])/most_turn, 1/huge(ratio))
   end subroutine bearable_increment

   !> Contacts for the results; surfaces that are fixed in space push from outside.
   subroutine accept(self, domain)
      class(surface_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      integer, allocatable :: closed(:)
      integer :: i

      if (size(self%cells) == 0) return
      call keep_memory(domain, self%cells)
      closed = pack([(i, i=1, size(self%cells))], self%cells%force > 0)
      domain%state%surface_contacts = [(contact_of_cell(present_surface(domain, self%cells(closed(i))%pair), &
         element_axis(domain, self%cells(closed(i))%element, self%cells(closed(i))%pair), self%cells(closed(i))), &
         i=1, size(closed))]
      do i = 1, size(closed)
         call note_flows(domain, self%cells(closed(i)), domain%state%surface_contacts(i))
      end do
      associate (outer => domain%state%outer_force(motion_slots(1):motion_slots(2), :))
         outer = outer + self%outer
      end associate
   end subroutine accept

end module litz_surface_term
