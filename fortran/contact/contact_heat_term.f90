!> Heat through the contacts of wires, and that of the currents in them, in steps that solve for temperatures.
!>
!> Which contacts there are and what their spots conduct is the matter of the contact term.
!> Source: theory section 13.
module litz_contact_heat_term
   use litz_kinds, only: dp
   use litz_contact_forces, only: conductors_of, conducts_apart, set_current
   use litz_contact_points, only: contact_set_t, contact_point_t
   use litz_domain, only: domain_t, element_flow_t
   use litz_errors, only: error_t
   use litz_fields, only: field_temperature, group_transport, potential_slots, temperature_slots
   use litz_friction_heat, only: find_rubbing
   use litz_contact_heat_tangent, only: own_tangent, multiply_heat
   use litz_heat_beside_contacts, only: find_heat_beside, normals_of
   use litz_heat_of_contacts, only: contact_heat_t, collect_heat
   use litz_heated_contacts, only: heated_contact_t, heated_contact, can_pass_heat, conducting_metals
   use litz_heat_within, only: slow_and_fast
   use litz_heated_elements, only: heated_element_t, add_at_nodes
   use litz_hot_places, only: beyond_table, beyond_table_inside
   use litz_model, only: step_t
   use litz_property_table, only: property_at
   use litz_rows_of_contacts, only: contact_rows
   use litz_rubbing, only: rubbing_t, is_abrupt, add_heat_beyond
   use litz_settled_heats, only: settled_heat
   use litz_shared_conductors, only: shared_conductors_t
   use litz_spots_of_given_temperatures, only: find_hottest
   use litz_term, only: term_t
   implicit none
   private
   public :: contact_heat_term_t, new_contact_heat_term

   !> Of each node: potential and temperature
   integer, parameter :: both_slots(2) = [potential_slots(1), temperature_slots(2)]

   type, extends(term_t) :: contact_heat_term_t
      type(contact_set_t), pointer :: contact => null()
      !> Crossings and points of lines that pass heat, those that carry a current before the others: places in the set
      integer, allocatable, private :: points(:), line_points(:)
      !> How many of these carry a current
      integer, private :: n_points = 0, n_line_points = 0
      type(contact_heat_t), allocatable, private :: heat
      !> Tangents of the contacts by themselves: heat over potentials and temperatures of the nodes, currents over
      !> temperatures (4, 8, contacts) and (4, 4, contacts) [A, W/K, A/K]
      real(dp), allocatable, private :: k(:, :, :), k_et(:, :, :)
      !> By which the work of an increment is a power [1/s]; 0: time is a scale of loads
      real(dp), private :: rate = 0
      !> What friction gives to the elements beyond its work per time (n_elements) [W]
      real(dp), allocatable, private :: of_friction(:)
      !> What films take of the heat of contacts between the nodes (n_elements) [W]
      real(dp), allocatable, private :: through_film(:)
   contains
      procedure :: apply_load
      procedure :: evaluate
      procedure :: settle
      procedure :: refusal
      procedure :: rejection
      procedure :: link
      procedure :: has_mutual_tangent
      procedure :: add_mutual_tangent
      procedure :: accept
   end type contact_heat_term_t

contains

   type(contact_heat_term_t) function new_contact_heat_term(contact) result(term)
      type(contact_set_t), pointer, intent(in) :: contact

      term%contact => contact
   end function new_contact_heat_term

   subroutine apply_load(self, domain, step, step_time, increment)
      class(contact_heat_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      type(step_t), intent(in) :: step
      !> Time of the step at the end of the increment, and the increment [s]
      real(dp), intent(in) :: step_time, increment

      self%rate = 0
      if (step%transient) self%rate = 1/increment
   end subroutine apply_load

   subroutine evaluate(self, domain, error)
      class(contact_heat_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Never
      type(error_t), allocatable, intent(out) :: error
      integer :: i
      real(dp), allocatable :: r(:, :)
      integer, allocatable :: nodes(:, :)

      if (allocated(self%heat)) deallocate (self%heat)
      if (.not. domain%loading%solves(field_temperature)) then
         if (.not. domain%model%has_field(field_temperature)) return
         call find_hottest(domain, self%contact%points)
         call find_hottest(domain, self%contact%line_points)
         return
      end if
      call add_friction(self, domain)
      call find_contacts(self, domain)
      if (any(self%heat%contacts%is_cold)) then
         self%heat%is_solved = .false.
         return
      end if
      associate (value => domain%iterate%value)
         call self%heat%solve(value(potential_slots(1), :), value(temperature_slots(1), :))
      end associate
      if (size(self%heat%contacts) == 0) return
      domain%matrix%symmetric(group_transport) = .false.
      associate (contacts => self%heat%contacts)
         allocate (nodes, source=reshape([(contacts(i)%nodes, i=1, size(contacts))], [4, size(contacts)]))
         call find_own_tangents(self)
         allocate (r(4, size(contacts)))
         do i = 1, size(contacts)
            r(:, i) = -contacts(i)%part*(self%heat%heat([1, 1, 2, 2], i) + self%heat%between([1, 1, 2, 2], i))
            call lose_to_films(self, i)
         end do
      end associate
      call domain%add_cells(nodes, temperature_slots, both_slots, self%k, r)
      call domain%add_cells(nodes, potential_slots, temperature_slots, self%k_et)
      call add_currents(self, domain)
      ! what the parts of elements next to the nodes make beyond that of the elements without contacts
      call add_at_nodes(self%heat%elements, self%heat%at_nodes, domain%forces%internal(temperature_slots(1), :))
      call keep_heat(self)
   end subroutine evaluate

   !> What does not come to the nodes of a contact.
   subroutine lose_to_films(self, i)
      class(contact_heat_term_t), intent(inout) :: self
      !> Contact
      integer, intent(in) :: i
      integer :: side

      associate (contact => self%heat%contacts(i), entering => self%heat%heat(:, i) + self%heat%between(:, i))
         do side = 1, 2
            associate (lost => self%through_film(contact%element(side)))
               if (contact%film(side) > 0) lost = lost + (1 - sum(contact%part(2*side - 1:2*side)))*entering(side)
            end associate
         end do
      end associate
   end subroutine lose_to_films

   !> What the works of friction of the last two increments give to the nodes beyond the heat of the contacts.
   subroutine add_friction(self, domain)
      class(contact_heat_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      type(rubbing_t), allocatable :: rubbing(:)

      self%of_friction = spread(0.0_dp, 1, domain%model%n_elements)
      self%through_film = self%of_friction
      if (.not. (self%rate > 0 .and. domain%heat_weights(2) > 0)) return
      call find_rubbing(domain, self%contact, rubbing)
      ! the contacts have the rate of this increment
      call add_heat_beyond(rubbing, domain%model%connectivity, domain%is_led, domain%heat_weights, 1/self%rate, &
         domain%forces%internal(temperature_slots(1), :), self%of_friction, self%through_film)
   end subroutine add_friction

   !> The forces balance, so that friction is known: an increment in which it sets in or ends takes backward Euler.
   subroutine settle(self, domain, has_moved)
      class(contact_heat_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> The forces must be evaluated again
      logical, intent(inout) :: has_moved
      type(rubbing_t), allocatable :: rubbing(:)

      if (.not. (domain%loading%solves(field_temperature) .and. self%rate > 0 .and. domain%heat_weights(2) > 0)) return
      call find_rubbing(domain, self%contact, rubbing)
      associate (increment => 1/self%rate)
         if (.not. is_abrupt(domain%processes, rubbing, increment, domain%state%time_increment, &
            domain%fastest_warming(increment))) return
      end associate
      domain%heat_weights = [1, 0]
      has_moved = .true.
   end subroutine settle

   !> Those of the set that pass heat, and the elements that they are on.
   subroutine find_contacts(self, domain)
      class(contact_heat_term_t), intent(inout) :: self
      type(domain_t), intent(in) :: domain
      type(heated_contact_t), allocatable :: contacts(:)
      type(shared_conductors_t) :: conductors
      integer :: i, k, side

      call choose(self%contact%points, self%points, self%n_points)
      call choose(self%contact%line_points, self%line_points, self%n_line_points)
      associate (set => self%contact, a => self%points, b => self%line_points, n_a => self%n_points, &
         n_b => self%n_line_points)
         call conductors_of(domain%model, domain%wires, domain%elements, set, a(:n_a), b(:n_b), conductors)
         allocate (contacts, source=[(heated_contact(domain, set%points(a(i)), self%rate), i=1, n_a), &
            (heated_contact(domain, set%line_points(b(i)), self%rate), i=1, n_b), &
            (heated_contact(domain, set%points(a(i)), self%rate), i=n_a + 1, size(a)), &
            (heated_contact(domain, set%line_points(b(i)), self%rate), i=n_b + 1, size(b))])
      end associate
      allocate (self%heat)
      call collect_heat(contacts, conductors, conducting_metals(domain%model), domain%model%absolute_zero, self%heat)
      if (domain%coupled_step) call find_rows(self, domain)
      do k = 1, size(self%heat%elements)
         self%heat%elements(k) = heated_element(domain, self%heat%ends%element(k))
      end do
      do i = 1, size(contacts)
         do side = 1, 2
            associate (element => self%heat%elements(self%heat%ends%place_of(side, i)))
               element%series = max(element%series, contacts(i)%series(side))
               element%steady_heat_series = max(element%steady_heat_series, contacts(i)%heat_series(side))
               element%heat_series = element%steady_heat_series*sum(slow_and_fast*contacts(i)%reached(:, side))
            end associate
         end do
      end do
      associate (set => self%contact, a => self%points, b => self%line_points, n_a => self%n_points, &
         n_b => self%n_line_points)
         call find_heat_beside(domain, set%places, reshape([normals_of(set%points, a(:n_a)), &
            normals_of(set%line_points, b(:n_b)), normals_of(set%points, a(n_a + 1:)), &
            normals_of(set%line_points, b(n_b + 1:))], [3, size(contacts)]), [spread(.false., 1, n_a), &
            spread(.true., 1, n_b), spread(.false., 1, size(a) - n_a), spread(.true., 1, size(b) - n_b)], self%heat)
      end associate

   contains

      subroutine choose(points, chosen, n_conducting)
         type(contact_point_t), intent(in) :: points(:)
         !> Places in these, those with a current first (n)
         integer, allocatable, intent(out) :: chosen(:)
         !> How many have one
         integer, intent(out) :: n_conducting
         logical :: passes(size(points))
         integer :: j

         passes = [(points(j)%closed .or. conducts_apart(points(j)), j=1, size(points))]
         do j = 1, size(points)
            if (passes(j)) passes(j) = can_pass_heat(domain, points(j))
         end do
         n_conducting = count(passes .and. points%conductance > 0)
         chosen = [pack([(j, j=1, size(points))], passes .and. points%conductance > 0), &
            pack([(j, j=1, size(points))], passes .and. .not. points%conductance > 0)]
      end subroutine choose

   end subroutine find_contacts

   !> How the contacts change with motions and with temperatures that the mechanics sees.
   subroutine find_rows(self, domain)
      class(contact_heat_term_t), intent(inout) :: self
      type(domain_t), intent(in) :: domain
      integer :: i, number

      associate (heat => self%heat, set => self%contact)
         allocate (heat%rows(size(heat%contacts)))
         do i = 1, size(self%points)
            number = number_of_point(self, i)
            heat%rows(number) = contact_rows(domain, set%points(self%points(i)), heat%contacts(number))
         end do
         do i = 1, size(self%line_points)
            number = number_of_line_point(self, i)
            heat%rows(number) = contact_rows(domain, set%line_points(self%line_points(i)), heat%contacts(number))
         end do
      end associate
   end subroutine find_rows

   !> An element on which contacts are; what enters it within is a matter of their laws.
   type(heated_element_t) function heated_element(domain, e) result(element)
      type(domain_t), intent(in) :: domain
      !> Element
      integer, intent(in) :: e
      real(dp) :: value, slope
      type(element_flow_t) :: flow

      element%nodes = domain%model%connectivity(:, e)
      element%even_heat = domain%element_heat(e)
      element%film = domain%film_between_nodes(e)
      associate (material => domain%model%materials(domain%model%sections(domain%model%element_section(e))%material))
         element%heat_fraction = material%joule_fraction
         call property_at(material%heat_conductivity, domain%mean_temperature(e), value, slope)
         element%conductivity = value
         element%dconductivity = slope/value
         call domain%resistivity(e, value, slope)
         if (domain%elements%superconducting(e)) then
            flow = domain%flow_in(e)
            element%heat_by_voltage = material%joule_fraction*(flow%current + flow%by_voltage*flow%voltage)
            element%heat_by_temperature = material%joule_fraction*flow%by_temperature*flow%voltage
         else if (value > 0) then
            element%resistance = value*domain%conduction_length(e)/domain%elements%area(e)
            element%dresistivity = slope/value
         end if
      end associate
   end function heated_element

   !> What currents at the temperatures of the places differ from those at temperatures that are linear between nodes.
   subroutine add_currents(self, domain)
      class(contact_heat_term_t), intent(in) :: self
      type(domain_t), intent(inout) :: domain
      real(dp), dimension(size(self%heat%conductors%resistance)) :: voltage, current, unused
      real(dp) :: rise(2, size(voltage))

      if (.not. self%heat%resistances_follow) return
      voltage = self%heat%conductors%voltages(domain%iterate%value(potential_slots(1), :))
      call self%heat%linear_conductors%currents(voltage, current, rise, unused)
      call self%heat%conductors%add_beyond(0*voltage, self%heat%current(:size(voltage)) - current, &
         domain%forces%internal(potential_slots(1), :))
   end subroutine add_currents

   subroutine find_own_tangents(self)
      class(contact_heat_term_t), intent(inout) :: self
      real(dp) :: k_te(4, 4), k_tt(4, 4)
      integer :: i, n

      n = size(self%heat%contacts)
      if (allocated(self%k)) deallocate (self%k, self%k_et)
      allocate (self%k(4, 8, n), self%k_et(4, 4, n))
      do i = 1, n
         call own_tangent(self%heat, i, k_te, k_tt, self%k_et(:, :, i))
         self%k(:, 1::2, i) = k_te
         self%k(:, 2::2, i) = k_tt
      end do
   end subroutine find_own_tangents

   !> What results show.
   subroutine keep_heat(self)
      class(contact_heat_term_t), intent(inout) :: self
      integer :: i

      do i = 1, size(self%points)
         call keep(number_of_point(self, i), self%contact%points(self%points(i)))
      end do
      do i = 1, size(self%line_points)
         call keep(number_of_line_point(self, i), self%contact%line_points(self%line_points(i)))
      end do

   contains

      subroutine keep(number, point)
         !> Of the contact in `heat`
         integer, intent(in) :: number
         type(contact_point_t), intent(inout) :: point

         associate (heat => self%heat)
            point%temperature_bar = heat%bulk(1, number)
            point%temperature = heat%bulk(2, number)
            point%temperature_max = heat%spots(number)%hottest + heat%zero
            point%heat_bar = heat%heat(1, number)
            point%heat = heat%heat(2, number)
            if (.not. (heat%resistances_follow .and. number <= size(heat%conductors%resistance))) return
            point%conductance = 1/heat%resistance(number)
            call set_current(heat%current(number), heat%potential_rise(:, number), &
               sum(heat%of_others(:, number)), point)
         end associate
      end subroutine keep

   end subroutine keep_heat

   !> Number of a crossing that passes heat among all contacts that do: those with a current come first.
   pure integer function number_of_point(self, i) result(number)
      class(contact_heat_term_t), intent(in) :: self
      !> Place in `points`
      integer, intent(in) :: i

      number = merge(i, i + self%n_line_points, i <= self%n_points)
   end function number_of_point

   !> The same of a point of a line.
   pure integer function number_of_line_point(self, i) result(number)
      class(contact_heat_term_t), intent(in) :: self
      !> Place in `line_points`
      integer, intent(in) :: i

      number = i + merge(self%n_points, size(self%points), i <= self%n_line_points)
   end function number_of_line_point

   function refusal(self, domain) result(reason)
      class(contact_heat_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      character(len=:), allocatable :: reason

      reason = ''
      if (.not. allocated(self%heat)) return
      if (.not. self%heat%is_solved) reason = 'the temperatures of contact spots have no solution: a wire would be'// &
         ' at absolute zero or below, or heat far more than it can pass'
   end function refusal

   !> Metal at a spot is hotter than what is known of it.
   function rejection(self, domain) result(reason)
      class(contact_heat_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      character(len=:), allocatable :: reason

      reason = ''
      if (.not. allocated(self%heat)) return
      reason = beyond_table(domain, self%contact%points(self%points))
      if (len(reason) == 0) reason = beyond_table(domain, self%contact%line_points(self%line_points))
      if (len(reason) == 0) reason = beyond_table_inside(domain, self%heat)
   end function rejection

   subroutine link(self, domain, field, pairs)
      class(contact_heat_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> One of the fields of litz_fields
      integer, intent(in) :: field
      !> A node of either wire (2, pairs)
      integer, allocatable, intent(out) :: pairs(:, :)
      integer :: i

      allocate (pairs(2, 0))
      if (field /= field_temperature .or. .not. allocated(self%heat)) return
      associate (passing => pack([(i, i=1, size(self%heat%contacts))], self%heat%contacts%is_passed))
         pairs = reshape([(self%heat%contacts(passing(i))%nodes([1, 3]), i=1, size(passing))], [2, size(passing)])
      end associate
   end subroutine link

   !> Heats depend on each other within elements, and on all that the currents make there.
   logical function has_mutual_tangent(self, group)
      class(contact_heat_term_t), intent(in) :: self
      !> One of the groups of litz_fields
      integer, intent(in) :: group

      has_mutual_tangent = .false.
      if (group == group_transport .and. allocated(self%heat)) has_mutual_tangent = size(self%heat%contacts) > 0 &
         .and. .not. any(self%heat%contacts%is_cold)
   end function has_mutual_tangent

   !> The whole tangent less what the matrix has of it.
   subroutine add_mutual_tangent(self, group, accuracy, value, force)
      class(contact_heat_term_t), intent(in) :: self
      !> One of the groups of litz_fields
      integer, intent(in) :: group
      !> Of what is solved for within, relative
      real(dp), intent(in) :: accuracy
      !> (n_slots, n_nodes)
      real(dp), intent(in) :: value(:, :)
      !> (n_slots, n_nodes)
      real(dp), intent(inout) :: force(:, :)
      real(dp), dimension(size(value, 2)) :: heat, current
      integer :: i

      if (.not. self%has_mutual_tangent(group)) return
      heat = 0
      current = 0
      call multiply_heat(self%heat, value, accuracy, heat, current)
      do i = 1, size(self%heat%contacts)
         associate (nodes => self%heat%contacts(i)%nodes)
            heat(nodes(:2)) = heat(nodes(:2)) - own_heat(i, nodes, 1)
            heat(nodes(3:)) = heat(nodes(3:)) - own_heat(i, nodes, 3)
            current(nodes) = current(nodes) - matmul(self%k_et(:, :, i), value(temperature_slots(1), nodes))
         end associate
      end do
      force(temperature_slots(1), :) = force(temperature_slots(1), :) + heat
      force(potential_slots(1), :) = force(potential_slots(1), :) + current

   contains

      !> At two nodes of a contact by itself (2) [W].
      pure function own_heat(contact, nodes, first)
         !> Contact, its nodes (4), and the first of the two
         integer, intent(in) :: contact, nodes(4), first
         real(dp) :: own_heat(2)

         associate (k => self%k(first:first + 1, :, contact))
            own_heat = matmul(k(:, 1::2), value(potential_slots(1), nodes)) &
               + matmul(k(:, 2::2), value(temperature_slots(1), nodes))
         end associate
      end function own_heat

   end subroutine add_mutual_tangent

   !> What results show of temperatures and heats.
   subroutine accept(self, domain)
      class(contact_heat_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      integer :: k

      if (.not. allocated(self%heat)) return
      associate (state => domain%state, heat => self%heat)
         state%heat_made = state%heat_made + self%of_friction
         state%surface_heat = state%surface_heat + self%through_film
         ! an iterate that was given up
         if (.not. heat%is_solved) return
         do k = 1, size(heat%elements)
            associate (made => state%heat_made(heat%ends%element(k)))
               made = made + heat%between_contacts(k)
            end associate
         end do
      end associate
      call remember_heat(self)
   end subroutine accept

   !> What the temperatures within the elements have come to; the contact term has taken over the points before.
   subroutine remember_heat(self)
      class(contact_heat_term_t), intent(inout) :: self
      integer :: i

      associate (a => self%points, b => self%line_points, heat => self%heat, set => self%contact)
         do i = 1, size(a)
            set%points(a(i))%history%settled_heat = settled_heat(heat, number_of_point(self, i))
         end do
         do i = 1, size(b)
            set%line_points(b(i))%history%settled_heat = settled_heat(heat, number_of_line_point(self, i))
         end do
         set%converged(a)%history = set%points(a)%history
         set%converged_line_points(b)%history = set%line_points(b)%history
      end associate
   end subroutine remember_heat

end module litz_contact_heat_term
