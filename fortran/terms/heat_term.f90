!> Conduction of heat along the wires, and the heat of the currents in them, in steps that solve for temperatures.
!>
!> What the currents are is the matter of the conductor term; this one adds how temperatures change them.
!> Source: theory section 13.
module litz_heat_term
   use litz_kinds, only: dp, pi
   use litz_conductor_heat, only: conductor_heat, heated_wire_t, heat_flows_t
   use litz_domain, only: domain_t, element_flow_t
   use litz_errors, only: error_t
   use litz_fields, only: field_temperature, group_transport, motion_slots, potential_slots, temperature_slots
   use litz_loading, only: heat_at
   use litz_model, only: model_t, step_t, element_heat_t
   use litz_parallel, only: worth_threads
   use litz_property_table, only: property_at
   use litz_scatter, only: chunk
   use litz_term, only: term_t
   use litz_text, only: to_text
   implicit none
   private
   public :: heat_term_t, new_heat_term

   !> Of each node: potential and temperature
   integer, parameter :: both_slots(2) = [potential_slots(1), temperature_slots(2)]

   type, extends(term_t) :: heat_term_t
      !> Elements that conduct heat
      integer, allocatable :: conducting(:)
      !> Mean flow from the first to the second node, and heat of currents and sources (n_elements) [W]
      real(dp), allocatable :: flow(:), made(:)
      !> What passes through films (n_elements) [W]
      real(dp), allocatable :: through_film(:)
      !> Sources and films at the end of the increment (n_elements)
      type(element_heat_t), allocatable :: given(:)
   contains
      procedure :: apply_load
      procedure :: hold
      procedure :: request_slots
      procedure :: evaluate
      procedure :: refusal
      procedure :: rejection
      procedure :: link
      procedure :: accept
   end type heat_term_t

contains

   pure type(heat_term_t) function new_heat_term(model) result(heat)
      type(model_t), intent(in) :: model
      integer :: e

      allocate (heat%conducting(0))
      do e = 1, model%n_elements
         associate (material => model%materials(model%sections(model%element_section(e))%material))
            if (allocated(material%heat_conductivity)) heat%conducting = [heat%conducting, e]
         end associate
      end do
      allocate (heat%flow(model%n_elements), heat%made(model%n_elements), heat%through_film(model%n_elements), &
         source=0.0_dp)
      allocate (heat%given(model%n_elements))
   end function new_heat_term

   subroutine request_slots(self, domain, exists)
      class(heat_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> (n_slots, n_nodes)
      logical, intent(inout) :: exists(:, :)

      if (domain%loading%solves(field_temperature)) then
         call domain%mark_nodes(self%conducting, exists(temperature_slots(1), :))
      end if
   end subroutine request_slots

   subroutine apply_load(self, domain, step, step_time, increment)
      class(heat_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      type(step_t), intent(in) :: step
      !> Time of the step at the end of the increment, and the increment [s]
      real(dp), intent(in) :: step_time, increment

      self%given = heat_at(domain%model, step, step_time, domain%state%time - domain%state%step_time)
      domain%film = self%given%film*2*pi*domain%model%sections(domain%model%element_section)%contact_radius
      domain%sink = self%given%sink
   end subroutine apply_load

   !> What a film cools has a temperature.
   subroutine hold(self, domain, field, held)
      class(heat_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> One of the fields of litz_fields
      integer, intent(in) :: field
      !> (n_nodes)
      logical, intent(inout) :: held(:)

      if (field == field_temperature) call domain%mark_nodes(pack(self%conducting, &
         self%given(self%conducting)%film > 0), held)
   end subroutine hold

   subroutine evaluate(self, domain, error)
      class(heat_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Never
      type(error_t), allocatable, intent(out) :: error
      real(dp), allocatable :: k(:, :, :), r(:, :), by_motion(:, :, :)
      integer :: first, n, i

      if (.not. domain%loading%solves(field_temperature)) return
      domain%matrix%symmetric(group_transport) = .false.
      if (.not. allocated(domain%element_heat)) allocate (domain%element_heat(domain%model%n_elements), source=0.0_dp)
      n = min(chunk, size(self%conducting))
      allocate (k(4, 4, n), r(4, n), by_motion(2, 12, n))
      do first = 1, size(self%conducting), chunk
         n = min(chunk, size(self%conducting) - first + 1)
         associate (members => self%conducting(first:first + n - 1))
            !$omp parallel do schedule(static) if (n >= worth_threads)
            do i = 1, n
               call evaluate_element(self, domain, members(i), k(:, :, i), r(:, i), by_motion(:, :, i))
            end do
            !$omp end parallel do
            call domain%add_cells(domain%model%connectivity(:, members), temperature_slots, both_slots, k(3:4, :, :n), &
               r(3:4, :n))
            call domain%add_cells(domain%model%connectivity(:, members), potential_slots, temperature_slots, &
               k(1:2, [2, 4], :n))
            if (domain%coupled_step .and. any(domain%superconductors%place(members) > 0)) call domain%add_cells( &
               domain%model%connectivity(:, members), temperature_slots, motion_slots, by_motion(:, :, :n))
         end associate
      end do
      domain%element_heat = self%made
   end subroutine evaluate

   !> Of an element, unknowns node by node: potential, temperature; equations: both currents, both heat flows.
   subroutine evaluate_element(self, domain, e, k, r, by_motion)
      class(heat_term_t), intent(inout) :: self
      type(domain_t), intent(in) :: domain
      !> Element
      integer, intent(in) :: e
      !> (4, 4) and (4)
      real(dp), intent(out) :: k(4, 4), r(4)
      !> Derivatives of both heat flows by what motions do to the current in superconducting filaments (2, 12) [W/m, W]
      real(dp), intent(out) :: by_motion(2, 12)
      type(heated_wire_t) :: wire
      type(heat_flows_t) :: flows
      type(element_flow_t) :: flow

      associate (model => domain%model, node => domain%model%connectivity(:, e), value => domain%iterate%value)
         associate (section => model%sections(model%element_section(e)))
            associate (material => model%materials(section%material))
               wire%length = domain%conduction_length(e)
               wire%area = section%area
               call domain%resistivity(e, wire%resistivity, wire%dresistivity)
               wire%has_current = domain%superconductors%place(e) > 0
               if (wire%has_current) then
                  flow = domain%flow_in(e)
                  wire%current = flow%current
                  wire%own = flow%own
                  wire%by_voltage = flow%by_voltage
                  wire%by_temperature = flow%by_temperature
               end if
               call property_at(material%heat_conductivity, domain%mean_temperature(e), wire%conductivity, &
                  wire%dconductivity)
               wire%heat_fraction = material%joule_fraction
               wire%source = self%given(e)%source*section%area*wire%length
               wire%film = domain%film(e)
               wire%sink = self%given(e)%sink
            end associate
         end associate
         call conductor_heat(wire, value(potential_slots(1), node), value(temperature_slots(1), node), k, r, flows)
      end associate
      k = k(:, [1, 3, 2, 4])
      by_motion = spread(-wire%heat_fraction*flows%nodal_share/2*flow%voltage*flow%by_motion, 1, 2)
      self%flow(e) = (r(3) - r(4))/2
      self%made(e) = flows%joule_heat + wire%source
      self%through_film(e) = flows%to_surroundings
   end subroutine evaluate_element

   !> No temperature is below absolute zero: a root of the equations that means nothing.
   function refusal(self, domain) result(reason)
      class(heat_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      character(len=:), allocatable :: reason
      integer :: node

      reason = ''
      if (.not. domain%loading%solves(field_temperature) .or. size(self%conducting) == 0) return
      associate (temperature => domain%iterate%value(temperature_slots(1), :), zero => domain%model%absolute_zero)
         node = minloc(temperature, 1, domain%equations%number(temperature_slots(1), :) > 0 &
            .or. domain%loading%fixed(temperature_slots(1), :))
         if (node == 0) return
         if (temperature(node) < zero) reason = 'the temperature of node '//to_text(domain%model%node_id(node))// &
            ' would be '//to_text(temperature(node))//', below absolute zero, '//to_text(zero)// &
            ' (*PHYSICAL CONSTANTS, ABSOLUTE ZERO=)'
      end associate
   end function refusal

   !> Above the table of the resistivity, which is constant there, temperatures would be steady that in truth run away.
   function rejection(self, domain) result(reason)
      class(heat_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      character(len=:), allocatable :: reason
      real(dp) :: beyond, most
      integer :: i, worst

      reason = ''
      if (.not. domain%loading%solves(field_temperature)) return
      most = 0
      do i = 1, size(self%conducting)
         associate (e => self%conducting(i))
            associate (material => domain%model%materials(domain%model%sections( &
               domain%model%element_section(e))%material))
               if (.not. material%conductivity > 0) cycle
               if (size(material%resistivity, 2) == 1) cycle
               beyond = hottest_end(domain, e) - material%resistivity(1, size(material%resistivity, 2))
            end associate
            if (beyond <= most) cycle
            most = beyond
            worst = e
         end associate
      end do
      if (.not. most > 0) return
      reason = 'the temperature in element '//to_text(domain%model%element_id(worst))//' would be '// &
         to_text(hottest_end(domain, worst))//domain%model%units%after('K')// &
         ', where the table of *ELECTRICAL CONDUCTIVITY ends at '//to_text(hottest_end(domain, worst) - most)
   end function rejection

   !> Temperature of the hotter node of an element [K].
   pure real(dp) function hottest_end(domain, e)
      type(domain_t), intent(in) :: domain
      !> Element
      integer, intent(in) :: e

      hottest_end = maxval(domain%iterate%value(temperature_slots(1), domain%model%connectivity(:, e)))
   end function hottest_end

   subroutine link(self, domain, field, pairs)
      class(heat_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> One of the fields of litz_fields
      integer, intent(in) :: field
      !> Nodes of the elements that conduct heat (2, pairs)
      integer, allocatable, intent(out) :: pairs(:, :)

      allocate (pairs(2, merge(size(self%conducting), 0, field == field_temperature)))
      if (size(pairs) > 0) pairs = domain%model%connectivity(:, self%conducting)
   end subroutine link

   subroutine accept(self, domain)
      class(heat_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain

      if (.not. domain%loading%solves(field_temperature)) then
         domain%state%heat_flux = 0
         domain%state%heat_made = 0
         return
      end if
      domain%state%heat_flux = self%flow/domain%model%sections(domain%model%element_section)%area
      domain%state%heat_made = self%made
      domain%state%surface_heat = domain%state%surface_heat + self%through_film
   end subroutine accept

end module litz_heat_term
