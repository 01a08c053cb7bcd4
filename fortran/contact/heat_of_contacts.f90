!> Heat and temperatures of all contacts together, where several of them may share elements.
!>
!> The heats `q` that enter a wire at its contacts raise its temperature there above the linear one as currents raise
!> its potential, by the matrix `A` of heat; what a current makes in the wire between its contacts does so, too. The
!> spots give the heats from the temperatures of the bulks,
!>
!>     tau = N T + a + A (q(tau) + v) + M q(tau)                                                                    (1)
!>
!> with the heat `v` that the parts of an element between contacts make beyond that of the element without them, half
!> of it at either end of a part, and the rise `a` by what the element makes evenly; M is what strips and spots beside
!> each other on a wire do to each other, above the mean of its section. Exact at the contacts for constant
!> properties. What the spots resist follows tau, and with it the currents, q and v. Source: theory sections 7 and 13.
module litz_heat_of_contacts
   use litz_element_ends, only: element_ends_t, collect_ends
   use litz_gmres, only: linear_map_t, gmres
   use litz_heated_contacts, only: heated_contact_t, contact_rows_t, left_of_settled
   use litz_heated_elements, only: heated_element_t, n_parts, heat_of_parts, change_of_parts, &
      place_heat, rise_by
   use litz_hot_spot, only: hot_spot_t, hot_spot, hot_ok, by_volt
   use litz_kinds, only: dp
   use litz_mutual_resistances, only: mutual_resistances_t
   use litz_passed_spots, only: passed_spot_t, cold_spot, warmed_spot
   use litz_shared_conductors, only: shared_conductors_t
   use litz_spot_metal, only: spot_metal_t
   use litz_two_equations, only: solved
   implicit none
   private
   public :: contact_heat_t, bulk_map_t, followed_t, collect_heat, follow, change_between, solve_bulks, &
      inverse_of_own, rise_of

   !> Newton's method for (1) stops at this change over the largest temperature, from absolute zero; steps at most
   real(dp), parameter :: accurate = 1.0e-13_dp
   integer, parameter :: max_iterations = 50
   !> Residual of its linear equations, over that change and over that of their start, at least and at most; products
   !> with their matrix at most
   real(dp), parameter :: part_of_change = 0.01_dp, linear_accuracy = 1.0e-14_dp, least_accuracy = 1.0e-4_dp
   integer, parameter :: max_products = 400
   !> A temperature of a bulk that would fall below absolute zero keeps this part of itself
   real(dp), parameter :: least_part = 0.1_dp

   real(dp), parameter :: unit(2, 2) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], [2, 2])

   type :: contact_heat_t
      !> Those that carry a current come first
      type(heated_contact_t), allocatable :: contacts(:)
      type(heated_element_t), allocatable :: elements(:)
      type(element_ends_t) :: ends
      !> The first of the contacts: at the temperatures of their places, with what a change of the current meets in
      !> spots that it warms; and at those that are linear between the nodes
      type(shared_conductors_t) :: conductors, linear_conductors
      !> Those of the model
      type(spot_metal_t), allocatable :: metals(:)
      !> Resistances of spots change with the temperatures
      logical :: resistances_follow = .false.
      !> Absolute zero on the scale of the temperatures [K]
      real(dp) :: zero = 0
      !> Currents [A] (contacts), what others add to their voltages in either wire, and rises of the potential
      !> (2, contacts) [V]
      real(dp), allocatable :: current(:), of_others(:, :), potential_rise(:, :)
      !> Temperatures of the bulks, and what of them is above the linear ones (2, contacts) [K]
      real(dp), allocatable :: bulk(:, :), rise(:, :)
      !> M times the heat conductivities, and what it makes of the heats (2, contacts) [K]
      type(mutual_resistances_t) :: beside
      real(dp), allocatable :: rise_beside(:, :)
      !> Heats that enter the wires at the contacts: through the spots, and v (2, contacts) [W]
      real(dp), allocatable :: heat(:, :), between(:, :)
      !> v at both nodes of each element (2, elements), and all v of an element (elements) [W]
      real(dp), allocatable :: at_nodes(:, :), between_contacts(:)
      type(passed_spot_t), allocatable :: spots(:)
      !> Of contacts with a current: spots that it warms, their voltages [V], and resistances of all [ohm] (contacts)
      type(hot_spot_t), allocatable :: hot_spots(:)
      real(dp), allocatable :: spot_voltage(:), resistance(:)
      !> How the contacts change with motions and with temperatures that the mechanics sees (contacts); not allocated:
      !> these are not in the same Newton step
      type(contact_rows_t), allocatable :: rows(:)
      !> Between the wires at the contacts with a current, linear between the nodes (n) [V]
      real(dp), allocatable :: voltage(:)
      !> Of the nodes of each contact (4, contacts) [K]
      real(dp), allocatable :: temperature(:, :)
      !> Voltages of the nodes of each element: first minus second (elements) [V]
      real(dp), allocatable :: drop(:)
      !> (1) has a solution
      logical :: is_solved = .true.
      !> Of the heats of a contact by its own bulks, and by them with its own current (2, 2, contacts) [W/K]
      real(dp), allocatable :: slope(:, :, :)
   contains
      procedure :: solve
   end type contact_heat_t

   !> What follows a change of the temperatures of the bulks where those of the nodes, and their potentials, stay.
   type :: followed_t
      !> Currents (contacts) [A]
      real(dp), allocatable :: current(:)
      !> Heats through the spots, and v (2, contacts) [W]; v at both nodes (2, elements) [W]
      real(dp), allocatable :: heat(:, :), between(:, :), at_nodes(:, :)
   end type followed_t

   !> `1 - A d(q + v)/dtau` of (1).
   type, extends(linear_map_t) :: bulk_map_t
      type(contact_heat_t), pointer :: heat => null()
      !> Of the currents that follow
      real(dp) :: accuracy = 0
   contains
      procedure :: apply => apply_bulk_map
      procedure :: precondition => precondition_bulk_map
   end type bulk_map_t

contains

   subroutine collect_heat(contacts, conductors, metals, zero, heat)
      !> Those that carry a current first
      type(heated_contact_t), intent(in) :: contacts(:)
      !> Of these
      type(shared_conductors_t), intent(in) :: conductors
      !> Those of the model
      type(spot_metal_t), intent(in) :: metals(:)
      !> Absolute zero on the scale of the temperatures [K]
      real(dp), intent(in) :: zero
      !> The caller fills in `elements`, in the order of `ends`
      type(contact_heat_t), intent(out) :: heat
      integer :: i

      heat%contacts = contacts
      heat%conductors = conductors
      heat%linear_conductors = conductors
      heat%metals = metals
      heat%resistance = conductors%resistance
      allocate (heat%hot_spots(size(heat%resistance)))
      heat%zero = zero
      heat%resistances_follow = any([((any(contacts(i)%follows) .or. contacts(i)%is_hot) .and. &
         contacts(i)%conductance > 0 .and. .not. contacts(i)%is_given, i=1, size(contacts))])
      call collect_ends(reshape([(contacts(i)%element, i=1, size(contacts))], [2, size(contacts)]), &
         reshape([(contacts(i)%xi, i=1, size(contacts))], [2, size(contacts)]), heat%ends)
      allocate (heat%elements(size(heat%ends%element)))
   end subroutine collect_heat

   !> Currents, heats and temperatures at the values of an iterate.
   subroutine solve(self, potential, temperature)
      class(contact_heat_t), target, intent(inout) :: self
      !> Of the nodes (n_nodes) [V], [K]
      real(dp), intent(in) :: potential(:), temperature(:)
      integer :: n, i

      n = size(self%contacts)
      allocate (self%current(n), self%of_others(2, n), self%potential_rise(2, n), source=0.0_dp)
      allocate (self%between(2, n), self%at_nodes(2, size(self%elements)), self%between_contacts(size(self%elements)), &
         self%slope(2, 2, n), source=0.0_dp)
      allocate (self%drop, source=[(potential(self%elements(i)%nodes(1)) - potential(self%elements(i)%nodes(2)), &
         i=1, size(self%elements))])
      self%voltage = self%conductors%voltages(potential)
      self%temperature = reshape([(temperature(self%contacts(i)%nodes), i=1, n)], [4, n])
      call find_bulks(self, self%voltage, temperature)
   end subroutine solve

   !> All that belongs to the present temperatures of the bulks.
   subroutine find_state(self, voltage, is_first)
      class(contact_heat_t), intent(inout) :: self
      !> Between the wires at the contacts with a current, linear between the nodes (n) [V]
      real(dp), intent(in) :: voltage(:)
      !> The currents are not known yet
      logical, intent(in) :: is_first
      integer :: i, n

      do i = 1, size(self%contacts)
         call self%contacts(i)%warm(self%metals, self%bulk(:, i), self%zero)
      end do
      if (is_first .or. self%resistances_follow) then
         n = size(voltage)
         if (n > 0) then
            call find_currents(self, voltage, is_first)
            self%of_others(:, :n) = self%conductors%mutual%voltages_in_wires(self%current(:n))
         end if
         do i = 1, size(self%elements)
            if (self%elements(i)%series > 0) call find_heat_in_element(self, i)
         end do
      end if
      call find_heats(self)
   end subroutine find_state

   !> Currents through the spots at the temperatures of the bulks; those of spots that they warm by Newton's method.
   subroutine find_currents(self, voltage, is_first)
      class(contact_heat_t), intent(inout) :: self
      !> Between the wires at the contacts with a current, linear between the nodes (n) [V]
      real(dp), intent(in) :: voltage(:)
      !> The currents are not known yet
      logical, intent(in) :: is_first
      real(dp), dimension(size(voltage)) :: resistance, source, step, unused
      logical :: is_hot(size(voltage))
      integer :: i, n, iteration

      n = size(voltage)
      is_hot = self%contacts(:n)%is_hot
      if (self%resistances_follow) then
         resistance = [(self%contacts(i)%series_resistance(), i=1, n)]
         call take(resistance)
      end if
      self%resistance = self%conductors%resistance
      if (is_first .or. .not. any(is_hot)) call self%conductors%currents(voltage, self%current(:n), &
         self%potential_rise(:, :n), unused)
      if (is_first) self%spot_voltage = self%resistance*self%current(:n)
      if (.not. any(is_hot)) return
      do iteration = 1, max_iterations
         source = voltage
         do i = 1, n
            if (.not. is_hot(i)) cycle
            call find_hot_spot(self, i, resistance(i))
            if (.not. self%is_solved) return
            source(i) = source(i) - (self%spot_voltage(i) - resistance(i)*self%hot_spots(i)%current)
         end do
         call take(resistance)
         call self%conductors%currents(source, self%current(:n), self%potential_rise(:, :n), unused)
         step = 0
         where (is_hot) step = resistance*(self%current(:n) - self%hot_spots%current)
         self%spot_voltage = self%spot_voltage + step
         if (.not. maxval(abs(step)) > accurate*maxval(abs(voltage))) exit
      end do
      self%is_solved = iteration <= max_iterations
      where (is_hot) self%resistance = 1/self%hot_spots%conductance

   contains

      subroutine take(resistance)
         !> (n) [ohm]
         real(dp), intent(in) :: resistance(:)

         self%conductors%resistance = resistance
         self%conductors%diagonal = self%linear_conductors%diagonal + (resistance - self%linear_conductors%resistance)
      end subroutine take

   end subroutine find_currents

   !> A spot that its current warms, at its voltage; one in which more current goes with less voltage is not solved.
   subroutine find_hot_spot(self, i, resistance)
      class(contact_heat_t), intent(inout) :: self
      !> Contact
      integer, intent(in) :: i
      !> dV/dI [ohm]
      real(dp), intent(inout) :: resistance
      integer :: info

      associate (contact => self%contacts(i), spot => self%hot_spots(i))
         call hot_spot(contact%constrictions, self%metals(contact%material), self%spot_voltage(i), self%bulk(:, i), &
            spot, info)
         self%is_solved = info == hot_ok .and. spot%dcurrent(by_volt) > 0
         if (self%is_solved) resistance = 1/spot%dcurrent(by_volt)
      end associate
   end subroutine find_hot_spot

   subroutine find_heat_in_element(self, k)
      class(contact_heat_t), intent(inout) :: self
      !> Number among the elements with contacts
      integer, intent(in) :: k
      real(dp) :: made(n_parts(self%ends, k))

      made = heat_of_parts(self%elements(k), self%ends, k, self%drop(k), self%current)
      call place_heat(self%ends, k, made, self%between, self%at_nodes(:, k))
      self%between_contacts(k) = sum(made)
   end subroutine find_heat_in_element

   !> Solve (1) by Newton's method.
   subroutine find_bulks(self, voltage, temperature)
      class(contact_heat_t), target, intent(inout) :: self
      !> Between the wires at the contacts with a current, linear between the nodes (n) [V], and temperatures of the
      !> nodes (n_nodes) [K]
      real(dp), intent(in) :: voltage(:), temperature(:)
      real(dp), dimension(2, size(self%contacts)) :: linear, base, left, step
      type(bulk_map_t) :: map
      type(followed_t) :: followed
      real(dp) :: enough
      integer :: i, side, iteration

      map%heat => self
      do i = 1, size(self%contacts)
         associate (contact => self%contacts(i))
            do side = 1, 2
               linear(side, i) = contact%linear_temperature(side, temperature(contact%nodes(2*side - 1:2*side)))
               associate (element => self%elements(self%ends%place_of(side, i)))
                  base(side, i) = linear(side, i) + contact%even(side)*element%heat_series*element%even_heat &
                     + contact%own(side)*element%steady_heat_series*left_of_settled(contact, side)
               end associate
            end do
         end associate
      end do
      allocate (self%spots(size(self%contacts)), self%heat(2, size(self%contacts)))
      self%bulk = base
      self%is_solved = .true.
      do iteration = 1, max_iterations
         call find_state(self, voltage, iteration == 1)
         if (.not. self%is_solved) return
         left = base + rise_of(self, self%heat, self%between) - self%bulk
         enough = accurate*maxval(abs(self%bulk - self%zero))
         call solve_bulks(map, left, max(linear_accuracy, min(least_accuracy, part_of_change*enough &
            /max(norm2(left), tiny(left)))), step)
         if (.not. maxval(abs(step)) > enough) exit
         call add_step(step)
      end do
      self%is_solved = iteration <= max_iterations .and. maxval(abs(step)) <= huge(1.0_dp)
      ! the heat that belongs to the last step, which is lost in the round-off of temperatures where spots conduct well
      call follow(self, step, least_accuracy, followed)
      self%heat = self%heat + followed%heat
      self%rise_beside = rise_of(self, self%heat, 0*self%heat, within=.false.)
      self%rise = self%bulk - linear - self%rise_beside

   contains

      !> In metals no temperature falls below absolute zero.
      subroutine add_step(step)
         !> (2, contacts) [K]
         real(dp), intent(in) :: step(:, :)
         integer :: i

         do i = 1, size(self%contacts)
            associate (bulk => self%bulk(:, i))
               where (self%contacts(i)%path%is_metal)
                  bulk = max(bulk + step(:, i), self%zero + least_part*(bulk - self%zero))
               else where
                  bulk = bulk + step(:, i)
               end where
            end associate
         end do
      end subroutine add_step

   end subroutine find_bulks

   !> Heats through the spots at the temperatures of the bulks. What others add to their voltages heats the wire in
   !> which they do, friction both wires half and half.
   subroutine find_heats(self)
      class(contact_heat_t), intent(inout) :: self
      logical :: ok
      integer :: i

      do i = 1, size(self%contacts)
         associate (contact => self%contacts(i), spot => self%spots(i))
            spot = passed_spot_t(hottest=maxval(self%bulk(:, i)) - self%zero)
            if (contact%is_hot) then
               spot = warmed_spot(self%hot_spots(i), self%zero)
            else if (contact%is_passed) then
               call cold_spot(contact, self%bulk(:, i) - self%zero, self%current(i), spot, ok)
               self%is_solved = self%is_solved .and. ok
            end if
            self%heat(:, i) = spot%heat + self%current(i)*self%of_others(:, i) + contact%friction_heat/2
            self%slope(:, :, i) = by_own_bulk(self, i)
         end associate
      end do
   end subroutine find_heats

   !> `(1 - A dq/dtau) x = b`
   subroutine solve_bulks(map, b, accuracy, x)
      type(bulk_map_t), intent(inout) :: map
      !> (2, contacts) [K]
      real(dp), intent(in) :: b(:, :)
      !> Residual over that of the start
      real(dp), intent(in) :: accuracy
      !> (2, contacts) [K]
      real(dp), intent(out) :: x(:, :)
      real(dp) :: solution(size(b))

      map%accuracy = accuracy
      call gmres(map, reshape(b, [size(b)]), accuracy, max_products, solution)
      x = reshape(solution, shape(x))
   end subroutine solve_bulks

   subroutine apply_bulk_map(self, x, y)
      class(bulk_map_t), intent(inout) :: self
      !> (2*contacts) [K]
      real(dp), intent(in) :: x(:)
      !> (2*contacts) [K]
      real(dp), intent(out) :: y(:)

      type(followed_t) :: followed

      call follow(self%heat, reshape(x, [2, size(x)/2]), self%accuracy, followed)
      y = x - reshape(rise_of(self%heat, followed%heat, followed%between), [size(x)])
   end subroutine apply_bulk_map

   !> Each contact by itself: `1 - D dq/dtau` with the diagonal `D` of `A`.
   subroutine precondition_bulk_map(self, x, y)
      class(bulk_map_t), intent(inout) :: self
      !> (2*contacts) [K]
      real(dp), intent(in) :: x(:)
      !> (2*contacts) [K]
      real(dp), intent(out) :: y(:)
      integer :: i

      do i = 1, size(self%heat%contacts)
         y(2*i - 1:2*i) = solved(unit - spread(own_rise(self%heat, i), 2, 2)*self%heat%slope(:, :, i), x(2*i - 1:2*i))
      end do
   end subroutine precondition_bulk_map

   !> How the heats of a contact change with its own bulks, and by them with its own current (2, 2) [W/K].
   pure function by_own_bulk(self, i) result(slope)
      type(contact_heat_t), intent(in) :: self
      !> Contact
      integer, intent(in) :: i
      real(dp) :: slope(2, 2)

      associate (spot => self%spots(i))
         slope = spot%by_bulk
         if (i <= size(self%conductors%diagonal)) slope = slope - spread(spot%by_current, 2, 2) &
            *spread(spot%dvoltage, 1, 2)/self%conductors%diagonal(i)
      end associate
   end function by_own_bulk

   !> What follows a change of the bulks at given nodal values.
   subroutine follow(self, dbulk, accuracy, followed)
      type(contact_heat_t), intent(in) :: self
      !> (2, contacts) [K]
      real(dp), intent(in) :: dbulk(:, :)
      !> Of the currents, relative
      real(dp), intent(in) :: accuracy
      type(followed_t), intent(out) :: followed
      real(dp), dimension(size(self%conductors%resistance)) :: voltage, unused
      real(dp) :: rise(2, size(voltage)), of_others(2, size(self%contacts))
      integer :: i, k, n

      n = size(voltage)
      allocate (followed%current(size(self%contacts)), source=0.0_dp)
      allocate (followed%heat(2, size(self%contacts)), followed%between(2, size(self%contacts)), &
         followed%at_nodes(2, size(self%elements)), source=0.0_dp)
      of_others = 0
      if (self%resistances_follow) then
         voltage = [(-dot_product(self%spots(i)%dvoltage, dbulk(:, i)), i=1, n)]
         call self%conductors%currents(voltage, followed%current(:n), rise, unused, accuracy)
         of_others(:, :n) = self%conductors%mutual%voltages_in_wires(followed%current(:n))
         do k = 1, size(self%elements)
            if (self%elements(k)%resistance > 0) call change_between(self, k, 0.0_dp, 0.0_dp, followed%current, &
               followed%between, followed%at_nodes(:, k))
         end do
      end if
      do i = 1, size(self%contacts)
         associate (spot => self%spots(i))
            followed%heat(:, i) = spot%by_current*followed%current(i) + matmul(spot%by_bulk, dbulk(:, i)) &
               + followed%current(i)*self%of_others(:, i) + self%current(i)*of_others(:, i)
         end associate
      end do
   end subroutine follow

   !> How what the parts of an element make beyond that of the element without contacts changes with the currents.
   subroutine change_between(self, k, deven, dresistance, dcurrent, between, at_nodes, dplace)
      type(contact_heat_t), intent(in) :: self
      !> Number among the elements with contacts
      integer, intent(in) :: k
      !> Changes of the current without contacts [A], of ln(rho), and of the currents of the contacts (contacts) [A]
      real(dp), intent(in) :: deven, dresistance, dcurrent(:)
      !> Changes of v: (2, contacts), set at those of this element, and (2) [W]
      real(dp), intent(inout) :: between(:, :), at_nodes(2)
      !> How the places move (2, contacts); absent: they stay
      real(dp), intent(in), optional :: dplace(:, :)
      real(dp) :: dmade(n_parts(self%ends, k))

      dmade = change_of_parts(self%elements(k), self%ends, k, self%drop(k), self%current, deven, dresistance, &
         dcurrent, dplace)
      call place_heat(self%ends, k, dmade, between, at_nodes)
   end subroutine change_between

   !> `A (q + v) + M q`: how heats raise the temperatures at the contacts (2, contacts) [K].
   function rise_of(self, heat, between, within) result(rise)
      type(contact_heat_t), intent(in) :: self
      !> q, v (2, contacts) [W]
      real(dp), intent(in) :: heat(:, :), between(:, :)
      !> With what the heats do within elements; absent: with that
      logical, intent(in), optional :: within
      real(dp) :: rise(2, size(heat, 2)), beside(2, size(heat, 2))
      logical :: has_all
      integer :: i

      has_all = .true.
      if (present(within)) has_all = within
      rise = 0
      if (has_all) rise = rise_by(self%elements, self%ends, heat + between)
      if (size(self%beside%shape) == 0) return
      beside = self%beside%rises(heat)
      do i = 1, size(heat, 2)
         rise(:, i) = rise(:, i) + beside(:, i)/self%elements(self%ends%place_of(:, i))%conductivity
      end do
   end function rise_of

   !> What heat that enters at a contact does to the temperature there by itself: diagonal of A (2) [K/W].
   pure function own_rise(self, i) result(rise)
      type(contact_heat_t), intent(in) :: self
      !> Contact
      integer, intent(in) :: i
      real(dp) :: rise(2)

      rise = self%elements(self%ends%place_of(:, i))%heat_series*self%contacts(i)%own
   end function own_rise

   !> `(1 - dq/dtau D)^-1` times heats of a contact: what they become as its own bulks follow (2) [W].
   pure function inverse_of_own(self, i, heat) result(found)
      type(contact_heat_t), intent(in) :: self
      !> Contact
      integer, intent(in) :: i
      !> To the barred and to the unbarred wire [W]
      real(dp), intent(in) :: heat(2)
      real(dp) :: found(2)

      found = solved(unit - spread(own_rise(self, i), 1, 2)*self%slope(:, :, i), heat)
   end function inverse_of_own

end module litz_heat_of_contacts
