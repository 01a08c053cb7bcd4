!> Heat that wires store, in steps over time: half of that of an element at either node, but for what a film exchanges
!> between them.
!>
!> Backward Euler in the first increment of a step, before which loads and surroundings may have jumped, and BDF2 with
!> increments of any size after it. Where a temperature is prescribed backward Euler goes on: what is stored there is no
!> part of the equations of the others, and BDF2 would take back half of the heat of a jump. Source: theory section 13.
module litz_capacity_term
   use litz_kinds, only: dp
   use litz_domain, only: domain_t
   use litz_errors, only: error_t
   use litz_fields, only: field_temperature, temperature_slots
   use litz_heat_capacity, only: latent_heat_t, heat_capacity, bdf2_weights, bdf2_error, euler_error
   use litz_model, only: model_t, step_t
   use litz_stored_heat, only: storing_elements, latent_heats, changes_by_heat
   use litz_term, only: term_t
   use litz_text, only: to_text
   implicit none
   private
   public :: capacity_term_t, new_capacity_term

   !> An increment may be larger than the one before it by this factor at most for BDF2, which is stable below
   !> 1 + sqrt(2)
   real(dp), parameter :: largest_growth = 2.4_dp

   !> An increment is the smallest one to this part of itself
   real(dp), parameter :: tight = 1.0e-6_dp

   integer, parameter :: slot = temperature_slots(1)

   !> Changes of phase of a material.
   type :: phases_t
      type(latent_heat_t), allocatable :: latent(:)
   end type phases_t

   type, extends(term_t) :: capacity_term_t
      !> Elements that store heat
      integer, allocatable :: elements(:)
      !> Of each material
      type(phases_t), allocatable :: phases(:)
      !> The step is one over time
      logical :: is_at_work = .false.
      !> [s]
      real(dp) :: increment = 1
      !> Temperatures when the increment began (n_nodes) [K]
      real(dp), allocatable :: at_start(:)
      !> What the elements take up, and what of it their films take between the nodes (n_elements) [W]
      real(dp), allocatable :: stored(:), between(:)
   contains
      procedure :: apply_load
      procedure :: start
      procedure :: hold
      procedure :: evaluate
      procedure :: shorten
      procedure :: bearable_increment
      procedure :: accept
   end type capacity_term_t

contains

   pure type(capacity_term_t) function new_capacity_term(model) result(capacity)
      type(model_t), intent(in) :: model
      integer :: material

      allocate (capacity%elements, source=storing_elements(model))
      allocate (capacity%stored(model%n_elements), capacity%between(model%n_elements), source=0.0_dp)
      allocate (capacity%phases(size(model%materials)))
      do material = 1, size(model%materials)
         capacity%phases(material)%latent = latent_heats(model, material)
      end do
   end function new_capacity_term

   subroutine apply_load(self, domain, step, step_time, increment)
      class(capacity_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      type(step_t), intent(in) :: step
      !> Time of the step at the end of the increment, and the increment [s]
      real(dp), intent(in) :: step_time, increment

      self%is_at_work = step%transient
      self%increment = increment
      if (step%transient) domain%is_led = led_nodes(domain)
      domain%heat_weights = [1, 0]
      associate (before => domain%state%time_increment)
         if (domain%state%step_time > 0 .and. increment <= largest_growth*before) then
            domain%heat_weights = bdf2_weights(increment/before)
         end if
      end associate
   end subroutine apply_load

   !> Nodes whose temperatures are prescribed, or joined with such by equations: all of these jump at once.
   pure function led_nodes(domain) result(led)
      type(domain_t), intent(in) :: domain
      logical :: led(domain%model%n_nodes)
      integer :: i, n

      led = domain%loading%fixed(slot, :)
      associate (constraints => domain%iterate%constraints)
         do
            n = count(led)
            do i = 1, constraints%n
               if (constraints%slot(i) /= slot) cycle
               associate (masters => constraints%master_node(constraints%start(i):constraints%start(i + 1) - 1))
                  if (led(constraints%node(i)) .or. any(led(masters))) led([constraints%node(i), masters]) = .true.
               end associate
            end do
            if (count(led) == n) exit
         end do
      end associate
   end function led_nodes

   subroutine start(self, domain)
      class(capacity_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain

      self%at_start = domain%state%value(slot, :)
   end subroutine start

   !> What stores heat has a temperature.
   subroutine hold(self, domain, field, held)
      class(capacity_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> One of the fields of litz_fields
      integer, intent(in) :: field
      !> (n_nodes)
      logical, intent(inout) :: held(:)

      if (field == field_temperature .and. self%is_at_work) call domain%mark_nodes(self%elements, held)
   end subroutine hold

   subroutine evaluate(self, domain, error)
      class(capacity_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Never
      type(error_t), allocatable, intent(out) :: error
      real(dp), allocatable :: k(:, :, :), r(:, :)
      integer :: i

      self%stored = 0
      self%between = 0
      if (.not. self%is_at_work .or. size(self%elements) == 0) return
      allocate (k(2, 2, size(self%elements)), r(2, size(self%elements)), source=0.0_dp)
      do i = 1, size(self%elements)
         call evaluate_element(self, domain, self%elements(i), k(:, :, i), r(:, i))
      end do
      call domain%add_cells(domain%model%connectivity(:, self%elements), temperature_slots, temperature_slots, k, r)
   end subroutine evaluate

   !> What an element takes up at its nodes: all of it without a film, else as of a source in it.
   pure subroutine evaluate_element(self, domain, e, k, r)
      class(capacity_term_t), intent(inout) :: self
      type(domain_t), intent(in) :: domain
      !> Element
      integer, intent(in) :: e
      !> (2, 2) [W/K], (2) [W]
      real(dp), intent(out) :: k(2, 2), r(2)
      real(dp) :: weights(2, 2), slope(2), share, dshare
      integer :: i

      associate (section => domain%model%sections(domain%model%element_section(e)), &
         node => domain%model%connectivity(:, e), state => domain%state)
         weights = reshape([(domain%heat_weights_at(node(i)), i=1, 2)], [2, 2])
         associate (material => domain%model%materials(section%material))
            call heat_capacity(domain%iterate%value(slot, node), state%value(slot, node), &
               state%temperature_before(node), weights, &
               material%density*section%area*domain%elements%length(e)/self%increment, material%specific_heat, &
               self%phases(section%material)%latent, slope, r)
         end associate
      end associate
      call domain%share_of_nodes(e, share, dshare)
      self%stored(e) = sum(r)
      self%between(e) = -(1 - share)*sum(r)
      k = dshare*spread(r, 2, 2)
      k(1, 1) = k(1, 1) + share*slope(1)
      k(2, 2) = k(2, 2) + share*slope(2)
      r = share*r
   end subroutine evaluate_element

   !> No temperature passes a solidus or liquidus in one iteration: the slope of the enthalpy is another one behind it.
   subroutine shorten(self, domain, correction)
      class(capacity_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> (n_slots, n_nodes)
      real(dp), intent(inout) :: correction(:, :)
      integer :: i, side, k
      real(dp) :: below

      if (.not. self%is_at_work) return
      do i = 1, size(self%elements)
         associate (section => domain%model%sections(domain%model%element_section(self%elements(i))))
            if (.not. allocated(domain%model%materials(section%material)%latent_heat)) cycle
            associate (kinks => domain%model%materials(section%material)%latent_heat(2:, :))
               do side = 1, 2
                  associate (node => domain%model%connectivity(side, self%elements(i)))
                     associate (t => domain%iterate%value(slot, node), dt => correction(slot, node))
                        do k = 1, size(kinks)
                           associate (kink => kinks(merge(1, 2, mod(k, 2) == 1), (k + 1)/2))
                              below = kink - 8*spacing(max(abs(kink), abs(t)))
                              if (t < kink .and. t + dt > kink) dt = kink - t
                              if (t >= kink .and. t + dt < kink) dt = max(dt, below - t)
                           end associate
                        end do
                     end associate
                  end associate
               end do
            end associate
         end associate
      end do
   end subroutine shorten

   !> Free temperatures do not change by more than DELTMX, and have no more than ERROR in an increment; with the
   !> smallest one that is allowed what sets in at once may have more, and the ratio is 1.
   subroutine bearable_increment(self, domain, step, ratio, reason)
      class(capacity_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      type(step_t), intent(in) :: step
      !> Over the one that has converged
      real(dp), intent(out) :: ratio
      !> Why no larger one is, for messages
      character(len=:), allocatable, intent(out) :: reason
      real(dp) :: change

      ratio = huge(ratio)
      reason = 'a temperature has an error of more than ERROR='//to_text(step%largest_error)
      if (.not. self%is_at_work) return
      associate (is_free => domain%equations%number(slot, :) > 0)
         change = maxval(abs(domain%iterate%change(slot, :)), is_free)
         if (step%largest_change > 0 .and. change > step%largest_change/huge(ratio)) ratio = step%largest_change/change
         if (ratio < 1) reason = 'a temperature changes by more than DELTMX='//to_text(step%largest_change)
         if (step%largest_error > 0 .and. .not. ratio < 1) then
            ratio = min(ratio, ratio_of_errors(self, domain, step%largest_error, is_free))
            if (self%increment <= step%smallest*(1 + tight)) ratio = max(ratio, 1.0_dp)
         end if
      end associate
   end subroutine bearable_increment

   !> The increment that would have the allowed error, over that which has converged. Nothing is known of the error of
   !> the first one of a step; that of the second is taken as what backward Euler would have had. Temperatures are those
   !> of the stored heat: an error of it while a wire melts is one of its temperature when it has melted.
   pure real(dp) function ratio_of_errors(self, domain, allowed, is_free) result(ratio)
      class(capacity_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> [K]
      real(dp), intent(in) :: allowed
      !> Temperatures that are unknowns (n_nodes)
      logical, intent(in) :: is_free(:)
      real(dp) :: error(size(is_free)), change(size(is_free), 3), order

      ratio = huge(ratio)
      if (domain%state%increment == 0) return
      associate (state => domain%state)
         change = changes_by_heat(domain%model, domain%elements%length, reshape([domain%iterate%value(slot, :), &
            state%value(slot, :), state%temperature_before, state%temperature_earlier], [size(is_free), 4]))
         if (state%increment == 1 .or. .not. domain%heat_weights(2) > 0) then
            order = 2
            error = euler_error(change(:, 1), change(:, 2), self%increment, state%time_increment)
         else
            order = 3
            error = bdf2_error(change(:, 1), change(:, 2), change(:, 3), self%increment, state%time_increment, &
               state%time_increment_before)
         end if
      end associate
      ratio = (allowed/max(maxval(abs(error), is_free), tiny(ratio)))**(1/order)
   end function ratio_of_errors

   subroutine accept(self, domain)
      class(capacity_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain

      domain%state%heat_stored = self%stored
      domain%state%surface_heat = domain%state%surface_heat + self%between
      domain%state%temperature_earlier = domain%state%temperature_before
      domain%state%temperature_before = self%at_start
   end subroutine accept

end module litz_capacity_term
