!> Contacts of wires at points, as one of the terms of the equations.
module litz_contact_term
   use litz_kinds, only: dp
   use litz_contact_candidates, only: find_candidates, candidates_hold
   use litz_contact_capture, only: capture_contacts
   use litz_contact_crossings, only: locate_points
   use litz_contact_energies, only: add_contact_energies
   use litz_contact_forces, only: apply_normal_law, assemble_contacts, predict_contacts, refused_contact
   use litz_contact_points, only: contact_set_t
   use litz_contact_step, only: contact_fraction => bearable_fraction
   use litz_contact_tangents, only: follow_centre_line
   use litz_domain, only: domain_t
   use litz_errors, only: error_t
   use litz_fields, only: group_electric, potential_slots
   use litz_friction_iteration, only: friction_iteration_t
   use litz_model, only: step_t
   use litz_state, only: energies_t
   use litz_term, only: term_t, status_t
   use litz_timing, only: phase_search, phase_contact, phase_update
   implicit none
   private
   public :: contact_term_t

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
      procedure :: count_status
      procedure :: link
      procedure :: has_mutual_tangent
      procedure :: add_mutual_tangent
      procedure :: bearable_fraction
      procedure :: predict
      procedure :: settle
      procedure :: add_energies
      procedure :: accept
   end type contact_term_t

contains

   subroutine connect(self, domain, nodes)
      class(contact_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> Nodes of each pair of elements that may touch (4, candidates)
      integer, allocatable, intent(out) :: nodes(:, :)
      integer :: i

      associate (candidates => self%contact%candidates)
         allocate (nodes(4, size(candidates, 2)))
         do i = 1, size(candidates, 2)
            nodes(:, i) = reshape(domain%model%connectivity(:, candidates(1:2, i)), [4])
         end do
      end associate
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
         contact%points%predicted = .false.
         contact%points%mixed_force = contact%points%force
         contact%points%friction_iteration = friction_iteration_t()
         call follow_centre_line(domain%model, domain%elements, domain%iterate%x, domain%iterate%rotation, &
            domain%wires)
         contact%depth = max(0.0_dp, maxval(-contact%points%kinematics%gap))
      end associate
   end subroutine start

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
         if (.not. candidates_hold(model, wires, elements, contact, iterate%x, iterate%rotation)) then
            call find_candidates(model, wires, elements, iterate%x_start, rotation_start, iterate%x, &
               iterate%rotation, contact, changed, error)
            domain%pattern_changed = domain%pattern_changed .or. changed
         end if
         if (allocated(error)) return
         call domain%timing%lap(phase_search)
         call locate_points(model, wires, elements, iterate%x_start, rotation_start, iterate%x, iterate%rotation, &
            contact)
         call apply_normal_law(model, elements, contact)
         call domain%timing%lap(phase_contact)
      end associate
   end subroutine locate

   subroutine evaluate(self, domain, error)
      class(contact_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Data that a law cannot take
      type(error_t), allocatable, intent(out) :: error

      call assemble_contacts(domain, self%contact, error)
   end subroutine evaluate

   function refusal(self, domain) result(reason)
      class(contact_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      character(len=:), allocatable :: reason

      reason = refused_contact(domain%model, self%contact)
   end function refusal

   subroutine count_status(self, status)
      class(contact_term_t), intent(in) :: self
      type(status_t), intent(inout) :: status
      integer :: i

      do i = 1, size(self%contact%points)
         associate (point => self%contact%points(i))
            if (point%closed) status%active = status%active + 1
            if (point%predicted .and. (point%closed .neqv. point%predicted_gap < 0)) then
               if (point%closed) status%new = status%new + 1
               if (.not. point%closed) status%lost = status%lost + 1
            end if
            status%penetration = max(status%penetration, -point%gap)
         end associate
      end do
   end subroutine count_status

   !> A spot joins the conductors of its wires.
   subroutine link(self, domain, group, pairs)
      class(contact_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> One of the groups of litz_fields
      integer, intent(in) :: group
      !> A node of either wire (2, pairs)
      integer, allocatable, intent(out) :: pairs(:, :)
      integer, allocatable :: conducting(:)
      integer :: i

      associate (points => self%contact%points, connectivity => domain%model%connectivity)
         conducting = pack([(i, i=1, size(points))], points%conductance > 0 .and. group == group_electric)
         allocate (pairs(2, size(conducting)))
         do i = 1, size(conducting)
            pairs(:, i) = connectivity(1, [points(conducting(i))%element_bar, points(conducting(i))%element])
         end do
      end associate
   end subroutine link

   !> Contacts on the same element: their currents depend on each other.
   logical function has_mutual_tangent(self, group)
      class(contact_term_t), intent(in) :: self
      !> One of the groups of litz_fields
      integer, intent(in) :: group

      has_mutual_tangent = group == group_electric .and. self%contact%shared%present
   end function has_mutual_tangent

   subroutine add_mutual_tangent(self, group, value, force)
      class(contact_term_t), intent(in) :: self
      !> One of the groups of litz_fields
      integer, intent(in) :: group
      !> (n_slots, n_nodes)
      real(dp), intent(in) :: value(:, :)
      !> (n_slots, n_nodes)
      real(dp), intent(inout) :: force(:, :)

      if (.not. self%has_mutual_tangent(group)) return
      call self%contact%shared%add_product(value(potential_slots(1), :), force(potential_slots(1), :))
   end subroutine add_mutual_tangent

   real(dp) function bearable_fraction(self, domain, step, correction)
      class(contact_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      type(step_t), intent(in) :: step
      !> Linear step of the unknowns (n_slots, n_nodes)
      real(dp), intent(in) :: correction(:, :)

      bearable_fraction = contact_fraction(domain%model, domain%elements, self%contact, correction)
   end function bearable_fraction

   subroutine predict(self, domain, eta, correction)
      class(contact_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Fraction of the step that is taken, and the step (n_slots, n_nodes)
      real(dp), intent(in) :: eta, correction(:, :)

      call predict_contacts(domain%model, eta, correction, self%contact)
   end subroutine predict

   !> The axes have sheared since the increment began: contact is to balance where they are now.
   subroutine settle(self, domain, has_moved)
      class(contact_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> The forces must be evaluated again
      logical, intent(inout) :: has_moved

      if (.not. any(domain%elements%shear_flexible)) return
      call follow_centre_line(domain%model, domain%elements, domain%iterate%x, domain%iterate%rotation, domain%wires)
      has_moved = .true.
   end subroutine settle

   subroutine add_energies(self, domain, energies)
      class(contact_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      type(energies_t), intent(inout) :: energies

      call add_contact_energies(self%contact, energies)
   end subroutine add_energies

   subroutine accept(self, domain)
      class(contact_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain

      call capture_contacts(self%contact, domain%state)
   end subroutine accept

end module litz_contact_term
