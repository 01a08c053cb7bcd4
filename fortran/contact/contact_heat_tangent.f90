!> The tangent of heat and temperatures of all contacts together, by its products.
!>
!> Differences of the equation of litz_heat_of_contacts and of that of the currents (litz_shared_conductors), with all
!> properties that follow the temperatures. Source: theory sections 7 and 13.
module litz_contact_heat_tangent
   use litz_fields, only: potential_slots, temperature_slots
   use litz_heat_by_motions, only: moved_t, move_contacts, voltage_by_motions, heat_by_motions, bulk_by_motions, &
      add_moved_currents, add_moved_heats
   use litz_heat_of_contacts, only: contact_heat_t, bulk_map_t, followed_t, follow, change_between, solve_bulks, &
      inverse_of_own, rise_of
   use litz_heated_elements, only: add_at_nodes
   use litz_kinds, only: dp
   implicit none
   private
   public :: own_tangent, multiply_heat

   !> What a change of nodal values makes of the contacts, before the temperatures of their bulks follow, and their
   !> resistances with these.
   type :: change_t
      !> Currents (contacts) [A]
      real(dp), allocatable :: current(:)
      !> Heats through the spots at fixed bulks, v, and linear temperatures with the rise by even heat and by the heat
      !> conductivity (2, contacts) [W, W, K]
      real(dp), allocatable :: heat(:, :), between(:, :), base(:, :)
      !> v at both nodes (2, elements) [W]
      real(dp), allocatable :: at_nodes(:, :)
   end type change_t

contains

   !> What a contact by itself does to its own nodes, at fixed conductances but for their temperatures: the part of the
   !> tangent that the matrix holds.
   pure subroutine own_tangent(self, i, k_te, k_tt, k_et)
      type(contact_heat_t), intent(in) :: self
      !> Contact
      integer, intent(in) :: i
      !> Heat that leaves the nodes by their potentials and by their temperatures, and currents that leave them by their
      !> temperatures (4, 4) [A, W/K, A/K]
      real(dp), intent(out) :: k_te(4, 4), k_tt(4, 4), k_et(4, 4)
      real(dp) :: by_current(2), by_node(2, 4), bulk_by_node(2, 4)
      integer :: a, side

      associate (contact => self%contacts(i), n => self%contacts(i)%part)
         bulk_by_node = 0
         do a = 1, 4
            side = merge(1, 2, a <= 2)
            by_node(:, a) = n(a)*inverse_of_own(self, i, self%slope(:, side, i))
            bulk_by_node(side, a) = n(a)
            bulk_by_node(:, a) = bulk_by_node(:, a) + self%elements(self%ends%place_of(:, i))%heat_series &
               *contact%own*by_node(:, a)
         end do
         k_tt = reshape([(-n(:2)*by_node(1, a), -n(3:)*by_node(2, a), a=1, 4)], [4, 4])
         k_te = 0
         k_et = 0
         if (i > size(self%conductors%resistance)) return
         by_current = inverse_of_own(self, i, self%spots(i)%by_current)
         associate (n_v => self%conductors%n_v(:, i), diagonal => self%conductors%diagonal(i))
            k_te = reshape([(-n(:2)*by_current(1)*n_v(a), -n(3:)*by_current(2)*n_v(a), a=1, 4)], [4, 4])/diagonal
            k_et = -spread(n_v, 2, 4)*spread(matmul(self%spots(i)%dvoltage, bulk_by_node), 1, 4)/diagonal
         end associate
      end associate
   end subroutine own_tangent

   !> The whole tangent times values, beyond what the matrix of the currents has: heat and currents that leave the
   !> nodes. Motions take part where they are in the same Newton step.
   subroutine multiply_heat(self, value, accuracy, heat, current)
      type(contact_heat_t), target, intent(in) :: self
      !> Changes at the nodes (n_slots, n_nodes)
      real(dp), intent(in) :: value(:, :)
      !> Of currents and temperatures that are solved for, relative
      real(dp), intent(in) :: accuracy
      !> (n_nodes) [W], (n_nodes) [A]
      real(dp), intent(inout) :: heat(:), current(:)
      type(change_t) :: change
      type(followed_t) :: followed
      type(bulk_map_t) :: map
      type(moved_t), allocatable :: moved
      real(dp), dimension(2, size(self%contacts)) :: dbulk

      map%heat => self
      if (allocated(self%rows)) then
         allocate (moved)
         call move_contacts(self, value, moved)
      end if
      associate (potential => value(potential_slots(1), :), temperature => value(temperature_slots(1), :))
         call change_currents(self, potential, temperature, moved, accuracy, change)
         call change_heats(self, potential, temperature, moved, change)
      end associate
      call solve_bulks(map, change%base + rise_of(self, change%heat, change%between), accuracy, dbulk)
      call follow(self, dbulk, accuracy, followed)
      call add_entering(self, change%heat + followed%heat + change%between + followed%between, &
         change%at_nodes + followed%at_nodes, heat)
      call add_beyond_linear(self, value(potential_slots(1), :), change%current + followed%current, accuracy, &
         current)
      if (.not. allocated(moved)) return
      call add_moved_currents(self, moved, current)
      call add_moved_heats(self, moved, heat)
   end subroutine multiply_heat

   !> Currents that leave the nodes beyond those that the matrix of the currents has, which are at fixed resistances of
   !> temperatures that are linear between the nodes.
   subroutine add_beyond_linear(self, potential, dcurrent, accuracy, leaving)
      type(contact_heat_t), intent(in) :: self
      !> Changes at the nodes (n_nodes) [V], and of the currents (contacts) [A]
      real(dp), intent(in) :: potential(:), dcurrent(:)
      !> Of currents, relative
      real(dp), intent(in) :: accuracy
      !> (n_nodes) [A]
      real(dp), intent(inout) :: leaving(:)
      real(dp), dimension(size(self%conductors%resistance)) :: there, unused
      real(dp) :: rise(2, size(there))

      if (size(there) == 0) return
      call self%linear_conductors%currents(self%conductors%voltages(potential), there, rise, unused, accuracy)
      call self%conductors%add_beyond(0*there, dcurrent(:size(there)) - there, leaving)
   end subroutine add_beyond_linear

   !> `(R + A) dI = N_V dV - dA I`
   subroutine change_currents(self, potential, temperature, moved, accuracy, change)
      type(contact_heat_t), intent(in) :: self
      !> Changes at the nodes (n_nodes) [V], [K]
      real(dp), intent(in) :: potential(:), temperature(:)
      !> Not allocated: none moves
      type(moved_t), allocatable, intent(in) :: moved
      !> Of the currents, relative
      real(dp), intent(in) :: accuracy
      type(change_t), intent(inout) :: change
      real(dp), dimension(size(self%conductors%resistance)) :: voltage, unused
      real(dp) :: rise(2, size(self%conductors%resistance)), warmer(2)
      integer :: i, n

      n = size(self%conductors%resistance)
      allocate (change%current(size(self%contacts)), source=0.0_dp)
      if (n == 0) return
      voltage = self%conductors%voltages(potential)
      do i = 1, n
         warmer = mean_change(self, i, temperature)*self%elements(self%ends%place_of(:, i))%dresistivity
         voltage(i) = voltage(i) + self%potential_rise(1, i)*warmer(1) - self%potential_rise(2, i)*warmer(2)
      end do
      voltage = voltage - sum(self%conductors%mutual%warmed_voltages(self%current(:n), temperature), 1)
      if (allocated(moved)) voltage = voltage + voltage_by_motions(self, moved)
      call self%conductors%currents(voltage, change%current(:n), rise, unused, accuracy)
   end subroutine change_currents

   !> Change of the temperature at both places of a contact, linear between the nodes (2) [K].
   pure function change_at(self, i, temperature) result(change)
      type(contact_heat_t), intent(in) :: self
      !> Contact
      integer, intent(in) :: i
      !> At the nodes (n_nodes) [K]
      real(dp), intent(in) :: temperature(:)
      real(dp) :: change(2)

      associate (n => self%contacts(i)%part, t => temperature(self%contacts(i)%nodes))
         change = [dot_product(n(:2), t(:2)), dot_product(n(3:), t(3:))]
      end associate
   end function change_at

   !> The same of the mean temperatures of both elements (2) [K].
   pure function mean_change(self, i, temperature) result(change)
      type(contact_heat_t), intent(in) :: self
      !> Contact
      integer, intent(in) :: i
      !> At the nodes (n_nodes) [K]
      real(dp), intent(in) :: temperature(:)
      real(dp) :: change(2)

      associate (t => temperature(self%contacts(i)%nodes))
         change = [sum(t(:2)), sum(t(3:))]/2
      end associate
   end function mean_change

   !> Heats at fixed bulks, and what of the bulks does not come from the heat of contacts.
   subroutine change_heats(self, potential, temperature, moved, change)
      type(contact_heat_t), intent(in) :: self
      !> Changes at the nodes (n_nodes) [V], [K]
      real(dp), intent(in) :: potential(:), temperature(:)
      !> Not allocated: none moves
      type(moved_t), allocatable, intent(in) :: moved
      type(change_t), intent(inout) :: change
      real(dp) :: at(2), of_others(2, size(self%contacts)), even(size(self%elements))
      integer :: i, k, n

      n = size(self%conductors%resistance)
      of_others = 0
      if (n > 0) of_others(:, :n) = self%conductors%mutual%voltages_in_wires(change%current(:n)) &
         + self%conductors%mutual%warmed_voltages(self%current(:n), temperature)
      allocate (change%heat(2, size(self%contacts)), change%between(2, size(self%contacts)), &
         change%base(2, size(self%contacts)), change%at_nodes(2, size(self%elements)), source=0.0_dp)
      do k = 1, size(self%elements)
         call change_element(self, k, potential, temperature, moved, change, even(k))
      end do
      do i = 1, size(self%contacts)
         at = change_at(self, i, temperature)
         associate (contact => self%contacts(i), current => self%current(i), place => self%ends%place_of(:, i))
            change%heat(:, i) = self%spots(i)%by_current*change%current(i) &
               + change%current(i)*self%of_others(:, i) + current*of_others(:, i)
            change%base(:, i) = at - self%elements(place)%dconductivity*mean_change(self, i, temperature) &
               *(self%rise(:, i) + self%rise_beside(:, i)) + self%elements(place)%heat_series*contact%even*even(place)
            if (allocated(moved)) change%heat(:, i) = change%heat(:, i) + heat_by_motions(self, i, moved)
         end associate
      end do
      if (allocated(moved)) change%base = change%base + bulk_by_motions(self, moved)
   end subroutine change_heats

   !> Heat that the currents make in an element: evenly, and beyond that between its contacts.
   subroutine change_element(self, k, potential, temperature, moved, change, even_heat)
      type(contact_heat_t), intent(in) :: self
      !> Number among the elements with contacts
      integer, intent(in) :: k
      !> Changes at the nodes (n_nodes) [V], [K]
      real(dp), intent(in) :: potential(:), temperature(:)
      !> Not allocated: none moves
      type(moved_t), allocatable, intent(in) :: moved
      type(change_t), intent(inout) :: change
      !> [W]
      real(dp), intent(out) :: even_heat
      real(dp) :: even, deven, dresistance

      associate (element => self%elements(k))
         even_heat = element%heat_by_voltage*(potential(element%nodes(1)) - potential(element%nodes(2))) &
            + element%heat_by_temperature*sum(temperature(element%nodes))
         if (.not. element%resistance > 0) return
         even = self%drop(k)/element%resistance
         dresistance = element%dresistivity*sum(temperature(element%nodes))/2
         deven = (potential(element%nodes(1)) - potential(element%nodes(2)))/element%resistance - even*dresistance
         if (allocated(moved)) then
            call change_between(self, k, deven, dresistance, change%current, change%between, change%at_nodes(:, k), &
               moved%place)
         else
            call change_between(self, k, deven, dresistance, change%current, change%between, change%at_nodes(:, k))
         end if
         even_heat = element%heat_fraction*element%resistance*(2*even*deven + even**2*dresistance)
      end associate
   end subroutine change_element

   !> Heat that enters the nodes, as heat that leaves them is positive.
   pure subroutine add_entering(self, heat, at_nodes, leaving)
      type(contact_heat_t), intent(in) :: self
      !> At the contacts (2, contacts), and beyond it at both nodes (2, elements) [W]
      real(dp), intent(in) :: heat(:, :), at_nodes(:, :)
      !> (n_nodes) [W]
      real(dp), intent(inout) :: leaving(:)
      integer :: i

      do i = 1, size(self%contacts)
         associate (nodes => self%contacts(i)%nodes, n => self%contacts(i)%part)
            leaving(nodes(:2)) = leaving(nodes(:2)) - n(:2)*heat(1, i)
            leaving(nodes(3:)) = leaving(nodes(3:)) - n(3:)*heat(2, i)
         end associate
      end do
      call add_at_nodes(self%elements, at_nodes, leaving)
   end subroutine add_entering

end module litz_contact_heat_tangent
