!> Contacts of wires at points, as one of the terms of the equations.
module litz_contact_term
   use litz_kinds, only: dp
   use litz_bent_contacts, only: follow_bends
   use litz_contact_candidates, only: find_candidates, candidates_hold
   use litz_contact_capture, only: capture_contacts
   use litz_contact_crossings, only: locate_points
   use litz_contact_energies, only: add_contact_energies, work_of_swelling, work_of_softening
   use litz_contact_forces, only: assemble_contacts, share_currents
   use litz_contact_points, only: contact_set_t, contact_point_t
   use litz_contact_descent, only: descent_fraction
   use litz_coupled_pairs, only: couple_pairs, nodes_of_coupled
   use litz_contact_step, only: contact_fraction => bearable_fraction, predict_contacts, &
      suppose_contacts, n_changed
   use litz_contact_tangents, only: follow_centre_line
   use litz_contact_temperatures, only: find_temperature_slopes, add_temperatures
   use litz_domain, only: domain_t
   use litz_errors, only: error_t
   use litz_fields, only: field_displacement, field_rotation, field_potential, first_slot, last_slot, group_transport, &
      potential_slots
   use litz_hot_places, only: melted
   use litz_line_points, only: locate_line_points, add_line_points, give_rows
   use litz_line_shares, only: share_crossings, renew_shares
   use litz_model, only: step_t
   use litz_normal_forces, only: apply_normal_law
   use litz_dents, only: follow_dents, find_left_dents, keep_left_dents, work_of_slides
   use litz_refused_contacts, only: refused_contact
   use litz_settled_dents, only: settle_dents, remember_energies
   use litz_spot_memory, only: follow_spots
   use litz_state, only: energies_t
   use litz_term, only: term_t, status_t, max_anticipations, nearly_balanced
   use litz_timing, only: phase_search, phase_contact, phase_update
   use litz_wire_turning, only: measure_turning
   implicit none
   private
   public :: contact_term_t

   !> How often an increment settles what is carried along lines at most where forces balance, and the change of a share
   !> that is left alone each time
   integer, parameter :: max_settlings = 2
   real(dp), parameter :: settled_change(max_settlings) = [0.02_dp, 0.1_dp]
   !> Overlaps are known when no linear step has missed one by more than this part of the largest, and forces nearly
   !> balance: the next step then changes them by its square
   real(dp), parameter :: missed_overlap = 0.02_dp
   !> Part of the contacts that a step may close and open without being taken anew
   real(dp), parameter :: few_contacts = 0.01_dp

   type, extends(term_t) :: contact_term_t
      !> The set of contacts, which the checks of a converged state, restart files and results read, too
      type(contact_set_t), pointer :: contact => null()
   contains
      procedure :: connect
      procedure :: apply_load
      procedure :: start
      procedure :: locate
      procedure :: evaluate
      procedure :: refusal
      procedure :: exceeded_limit
      procedure :: count_status
      procedure :: link
      procedure :: has_mutual_tangent
      procedure :: add_mutual_tangent
      procedure :: foresee
      procedure :: suppose
      procedure :: bearable_fraction
      procedure :: predict
      procedure :: anticipate
      procedure :: settle
      procedure :: add_energies
      procedure :: accept
   end type contact_term_t

contains

   subroutine connect(self, domain, nodes)
      class(contact_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> Nodes of each pair of elements that touch, or may soon (4, n)
      integer, allocatable, intent(out) :: nodes(:, :)

      nodes = nodes_of_coupled(self%contact, domain%model%connectivity)
   end subroutine connect

   !> Interference is resolved in the first step, in proportion to its time.
   subroutine apply_load(self, domain, step, step_time, increment)
      class(contact_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      type(step_t), intent(in) :: step
      !> Time of the step at the end of the increment, and the increment [s]
      real(dp), intent(in) :: step_time, increment

      self%contact%clearance = 0
      if (domain%state%step <= 1) self%contact%clearance = self%contact%overlap*max(0.0_dp, 1 - step_time/step%total)
   end subroutine apply_load

   !> Contacts forget the predictions of the last iteration.
   subroutine start(self, domain)
      class(contact_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain

      associate (contact => self%contact)
         contact%points = contact%converged
         contact%line_points = contact%converged_line_points
         call forget_predictions(contact%points)
         call forget_predictions(contact%line_points)
         contact%n_settled = 0
         contact%n_anticipated = 0
         contact%shares_wait = .false.
         call follow_centre_line(domain%model, domain%elements, domain%iterate%x, domain%iterate%rotation, &
            domain%wires)
         call measure_turning(domain%model, domain%wires, domain%elements, domain%iterate%x, domain%iterate%rotation, &
            contact%turning_at_start)
         contact%depth = domain%processes%largest(max(0.0_dp, maxval(-contact%points%kinematics%gap), &
            maxval(-contact%line_points%kinematics%gap)))
      end associate
   end subroutine start

   elemental subroutine forget_predictions(point)
      type(contact_point_t), intent(inout) :: point

      point%predicted = .false.
      point%mixed_force = point%force
      if (allocated(point%friction_iteration)) deallocate (point%friction_iteration)
   end subroutine forget_predictions

   !> A converged state needs nothing that only the iteration does.
   elemental subroutine forget_iteration(point)
      type(contact_point_t), intent(inout) :: point

      if (allocated(point%kinematics%rows)) deallocate (point%kinematics%rows)
      if (allocated(point%dconductance)) deallocate (point%dconductance)
      if (allocated(point%dfriction_work)) deallocate (point%dfriction_work)
      if (allocated(point%friction_iteration)) deallocate (point%friction_iteration)
   end subroutine forget_iteration

   !> Where wires cross, and with which force; new candidates when a node has moved too far since they were collected.
   subroutine locate(self, domain, error)
      class(contact_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> There are more candidates than can be counted
      type(error_t), allocatable, intent(out) :: error
      logical :: changed

      associate (contact => self%contact, model => domain%model, wires => domain%wires, elements => domain%elements, &
         iterate => domain%iterate, rotation_start => domain%state%rotation)
         call domain%timing%lap(phase_update)
         call measure_turning(model, wires, elements, iterate%x, iterate%rotation, contact%turning, &
            contact%turning_at_start)
         if (.not. candidates_hold(model, wires, elements, contact, iterate%x, iterate%rotation)) then
            call find_candidates(model, wires, elements, iterate%x_start, rotation_start, iterate%x, &
               iterate%rotation, contact, changed, error)
            domain%pattern_changed = domain%pattern_changed .or. changed
         end if
         if (allocated(error)) return
         call domain%timing%lap(phase_search)
         call locate_points(model, wires, elements, iterate%x_start, rotation_start, iterate%x, iterate%rotation, &
            contact)
         call locate_line_points(model, wires, elements, iterate%x_start, rotation_start, iterate%x, iterate%rotation, &
            contact)
         call share_crossings(model, wires, elements, contact)
         call find_left_dents(model, wires, elements, contact%left_dents, contact%points)
         call find_left_dents(model, wires, elements, contact%left_dents, contact%line_points)
         call press(domain, contact)
      end associate
   end subroutine locate

   !> Forces and stiffnesses of all points; pairs of elements that press are coupled.
   subroutine press(domain, contact)
      type(domain_t), intent(inout) :: domain
      type(contact_set_t), intent(inout) :: contact
      logical :: has_grown

      call apply_normal_law(domain%model, domain%elements, contact%points)
      call apply_normal_law(domain%model, domain%elements, contact%line_points)
      call couple_pairs(contact, has_grown)
      domain%pattern_changed = domain%pattern_changed .or. has_grown
      call domain%timing%lap(phase_contact)
   end subroutine press

   subroutine evaluate(self, domain, error)
      class(contact_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Data that a law cannot take
      type(error_t), allocatable, intent(out) :: error

      if (.not. domain%motions_stand) then
         call find_temperature_slopes(domain, self%contact%points)
         call find_temperature_slopes(domain, self%contact%line_points)
      end if
      call assemble_contacts(domain, self%contact, self%contact%points, error)
      if (allocated(error)) return
      call assemble_contacts(domain, self%contact, self%contact%line_points, error)
      if (allocated(error)) return
      call add_temperatures(domain, self%contact%points)
      call add_temperatures(domain, self%contact%line_points)
      call share_currents(domain%model, domain%wires, domain%elements, domain%iterate%value(potential_slots(1), :), &
         self%contact, domain%forces)
      call domain%timing%lap(phase_contact)
   end subroutine evaluate

   function refusal(self, domain) result(reason)
      class(contact_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      character(len=:), allocatable :: reason

      reason = refused_contact(domain%model, self%contact%points)
      if (len(reason) == 0) reason = refused_contact(domain%model, self%contact%line_points)
   end function refusal

   !> Metal in a spot has melted: what then happens is not modelled.
   function exceeded_limit(self, domain) result(reason)
      class(contact_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      character(len=:), allocatable :: reason

      reason = melted(domain, self%contact%points)
      if (len(reason) == 0) reason = melted(domain, self%contact%line_points)
   end function exceeded_limit

   subroutine count_status(self, status)
      class(contact_term_t), intent(in) :: self
      type(status_t), intent(inout) :: status

      call count_points(self%contact%points, status)
      call count_points(self%contact%line_points, status)
   end subroutine count_status

   pure subroutine count_points(points, status)
      type(contact_point_t), intent(in) :: points(:)
      type(status_t), intent(inout) :: status
      integer :: i

      do i = 1, size(points)
         associate (point => points(i))
            if (point%closed) status%active = status%active + 1
            status%force = status%force + point%force
            ! which points of a line are closed follows from their gaps alone
            if (point%line_place == 0 .and. point%weight > 0 .and. point%predicted) then
               ! one that is let go because it would pull, with its overlap, is as predicted
               if (point%closed .and. point%predicted_gap > -point%dent_depth) status%new = status%new + 1
               if (.not. point%closed .and. point%predicted_gap < -point%dent_depth) status%lost = status%lost + 1
            end if
            status%penetration = max(status%penetration, -point%gap)
         end associate
      end do
   end subroutine count_points

   !> A spot joins the conductors of its wires.
   subroutine link(self, domain, field, pairs)
      class(contact_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> One of the fields of litz_fields
      integer, intent(in) :: field
      !> A node of either wire (2, pairs)
      integer, allocatable, intent(out) :: pairs(:, :)
      allocate (pairs(2, 0))
      if (field /= field_potential) return
      call link_points(self%contact%points)
      call link_points(self%contact%line_points)

   contains

      subroutine link_points(points)
         type(contact_point_t), intent(in) :: points(:)
         integer, allocatable :: conducting(:)
         integer :: i

         conducting = pack([(i, i=1, size(points))], points%conductance > 0)
         associate (connectivity => domain%model%connectivity)
            pairs = reshape([pairs, (connectivity(1, points(conducting(i))%element_bar), &
               connectivity(1, points(conducting(i))%element), i=1, size(conducting))], &
               [2, size(pairs, 2) + size(conducting)])
         end associate
      end subroutine link_points

   end subroutine link

   !> Contacts on the same element: their currents depend on each other.
   logical function has_mutual_tangent(self, group)
      class(contact_term_t), intent(in) :: self
      !> One of the groups of litz_fields
      integer, intent(in) :: group

      has_mutual_tangent = group == group_transport .and. self%contact%shared%present
   end function has_mutual_tangent

   subroutine add_mutual_tangent(self, group, accuracy, value, force)
      class(contact_term_t), intent(in) :: self
      !> One of the groups of litz_fields
      integer, intent(in) :: group
      !> Of what is solved for within, relative
      real(dp), intent(in) :: accuracy
      !> (n_slots, n_nodes)
      real(dp), intent(in) :: value(:, :)
      !> (n_slots, n_nodes)
      real(dp), intent(inout) :: force(:, :)

      if (.not. self%has_mutual_tangent(group)) return
      call self%contact%shared%add_product(value(potential_slots(1), :), accuracy, force(potential_slots(1), :))
   end subroutine add_mutual_tangent

   !> Wires side by side that come together have points before they touch.
   subroutine foresee(self, domain, correction)
      class(contact_term_t), intent(inout) :: self
      type(domain_t), intent(in) :: domain
      !> Linear step of the unknowns (n_slots, n_nodes)
      real(dp), intent(in) :: correction(:, :)
      integer :: n_before

      associate (contact => self%contact, iterate => domain%iterate)
         call add_line_points(domain%model, domain%wires, domain%elements, iterate%x_start, domain%state%rotation, &
            iterate%x, iterate%rotation, correction(first_slot(field_displacement):last_slot(field_displacement), :), &
            correction(first_slot(field_rotation):last_slot(field_rotation), :), contact, n_before)
         call apply_normal_law(domain%model, domain%elements, contact%line_points(n_before + 1:))
      end associate
   end subroutine foresee

   !> Contacts that the step closes resist it, and those that it opens do not.
   subroutine suppose(self, domain, correction, has_changed)
      class(contact_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Linear step of the unknowns (n_slots, n_nodes)
      real(dp), intent(in) :: correction(:, :)
      !> Forces and tangent are to be assembled again
      logical, intent(inout) :: has_changed
      real(dp) :: changed, active

      associate (contact => self%contact, model => domain%model, elements => domain%elements)
         call self%foresee(domain, correction)
         changed = n_changed(model, correction, contact%points) + n_changed(model, correction, contact%line_points)
         active = count(contact%points%active) + count(contact%line_points%active)
         if (.not. domain%processes%sum(changed - few_contacts*active) > 0) return
         has_changed = .true.
         call suppose_contacts(model, correction, contact%points)
         call suppose_contacts(model, correction, contact%line_points)
         call give_rows(model, domain%wires, elements, domain%iterate%x, domain%iterate%rotation, contact%line_points)
         call press(domain, contact)
      end associate
   end subroutine suppose

   real(dp) function bearable_fraction(self, domain, step, correction)
      class(contact_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      type(step_t), intent(in) :: step
      !> Linear step of the unknowns (n_slots, n_nodes)
      real(dp), intent(in) :: correction(:, :)

      bearable_fraction = min(contact_fraction(domain%model, domain%elements, self%contact%points, correction), &
         contact_fraction(domain%model, domain%elements, self%contact%line_points, correction), &
         descent_fraction(domain%processes, domain%model, self%contact%line_points, domain%loading%load &
         - domain%forces%internal - domain%forces%iteration, correction))
   end function bearable_fraction

   subroutine predict(self, domain, eta, correction)
      class(contact_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Fraction of the step that is taken, and the step (n_slots, n_nodes)
      real(dp), intent(in) :: eta, correction(:, :)

      call predict_contacts(domain%model, eta, correction, self%contact%points)
      call predict_contacts(domain%model, eta, correction, self%contact%line_points)
   end subroutine predict

   !> The overlaps are known well enough for the shares, and where axes have sheared, for where they are.
   subroutine anticipate(self, domain, residual, has_moved)
      class(contact_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Largest force that is left over at any node [N]
      real(dp), intent(in) :: residual
      !> The forces must be evaluated again
      logical, intent(inout) :: has_moved
      real(dp) :: largest(3)

      associate (points => self%contact%points, line_points => self%contact%line_points)
         ! force, overlap, and what the last step has missed of it
         largest = domain%processes%largest([max(0.0_dp, maxval(points%force), maxval(line_points%force)), &
            max(0.0_dp, maxval(-points%gap), maxval(-line_points%gap)), &
            max(0.0_dp, maxval(missed_by(points)), maxval(missed_by(line_points)))])
         if (residual > nearly_balanced*largest(1) .or. largest(3) > missed_overlap*largest(2)) return
         if (self%contact%n_anticipated >= max_anticipations) return
         self%contact%n_anticipated = self%contact%n_anticipated + 1
         ! where forces balance, all of these count as one
         self%contact%n_settled = 0
         call self%settle(domain, has_moved)
         self%contact%n_settled = 1
      end associate
   end subroutine anticipate

   !> By how much the last linear step has missed the gap of a contact [m].
   elemental real(dp) function missed_by(point)
      type(contact_point_t), intent(in) :: point

      missed_by = 0
      if (point%closed) missed_by = merge(abs(point%gap - point%predicted_gap), huge(missed_by), point%predicted)
   end function missed_by

   !> The axes have sheared since the increment began: contact is to balance where they are now.
   subroutine settle(self, domain, has_moved)
      class(contact_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> The forces must be evaluated again
      logical, intent(inout) :: has_moved

      call settle_shares(domain, self%contact, has_moved)
      if (.not. any(domain%elements%shear_flexible)) return
      call follow_centre_line(domain%model, domain%elements, domain%iterate%x, domain%iterate%rotation, domain%wires)
      has_moved = .true.
   end subroutine settle

   !> What is carried along lines and what at crossings is settled for the present lengths of contact, a few times at
   !> most: what then is left of a change is a matter of quadrature. Shares and forces belong together: where a change
   !> is too small for another iteration, the shares of the increment stay, too, and the next one begins with the new
   !> ones.
   subroutine settle_shares(domain, contact, has_moved)
      type(domain_t), intent(in) :: domain
      type(contact_set_t), intent(inout) :: contact
      !> The forces must be evaluated again
      logical, intent(inout) :: has_moved
      type(contact_point_t), allocatable :: points(:), line_points(:)
      real(dp) :: largest_change

      if (contact%n_settled >= max_settlings) return
      points = contact%points
      line_points = contact%line_points
      call renew_shares(domain%model, domain%wires, domain%elements, domain%iterate%x, domain%iterate%rotation, &
         contact, largest_change)
      if (domain%processes%largest(largest_change) > settled_change(contact%n_settled + 1)) then
         has_moved = .true.
         contact%n_settled = contact%n_settled + 1
      else
         call move_alloc(points, contact%points)
         call move_alloc(line_points, contact%line_points)
         contact%shares_wait = .true.
      end if
   end subroutine settle_shares

   subroutine add_energies(self, domain, energies)
      class(contact_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      type(energies_t), intent(inout) :: energies

      associate (contact => self%contact)
         call settle_dents(domain%model, domain%elements, contact%converged, contact%points)
         call settle_dents(domain%model, domain%elements, contact%converged_line_points, contact%line_points)
         call add_contact_energies(contact, contact%converged, contact%points, energies)
         call add_contact_energies(contact, contact%converged_line_points, contact%line_points, energies)
         energies%yielding = energies%yielding - work_of_slides(domain%model, domain%wires, domain%elements, &
            contact%points)
         associate (before => domain%state%mechanical_temperature, now => domain%mechanical_temperature())
            energies%thermal = energies%thermal + work_of_swelling(domain%model, domain%elements, before, now, &
               contact%converged, contact%points) + work_of_swelling(domain%model, domain%elements, before, now, &
               contact%converged_line_points, contact%line_points) + work_of_softening(domain%model, domain%elements, &
               before, contact%converged, contact%points) + work_of_softening(domain%model, domain%elements, before, &
               contact%converged_line_points, contact%line_points)
         end associate
      end associate
   end subroutine add_energies

   subroutine accept(self, domain)
      class(contact_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      real(dp) :: unused_change

      associate (contact => self%contact)
         call follow_spots(domain%model, domain%wires, domain%elements, contact%points)
         call follow_spots(domain%model, domain%wires, domain%elements, contact%line_points)
         call follow_dents(domain%model, domain%wires, domain%elements, contact%points)
         call follow_dents(domain%model, domain%wires, domain%elements, contact%line_points)
         call capture_contacts(domain%model, domain%elements, contact, domain%state)
         call remember_energies(contact%points)
         call remember_energies(contact%line_points)
         if (contact%shares_wait) then
            call renew_shares(domain%model, domain%wires, domain%elements, domain%iterate%x, domain%iterate%rotation, &
               contact, unused_change)
            contact%shares_wait = .false.
         end if
         call follow_bends(domain%model, domain%wires, domain%elements, domain%iterate%x, domain%iterate%rotation, &
            contact%points)
         call keep_left_dents(domain%wires, contact)
         contact%converged = contact%points
         contact%converged_line_points = contact%line_points
         call forget_iteration(contact%converged)
         call forget_iteration(contact%converged_line_points)
      end associate
   end subroutine accept

end module litz_contact_term
