!> The tangent of heat and temperatures of all contacts together, by its products.
!>
!> Differences of the equation of litz_heat_of_contacts and of that of the currents (litz_shared_conductors), with all
!> properties that follow the temperatures. Source: theory sections 7 and 13.
module litz_contact_heat_tangent
   use litz_heat_of_contacts, only: contact_heat_t, bulk_map_t, followed, solve_bulks, inverse_of_own
   use litz_heated_elements, only: n_parts, currents_along, place_heat, add_at_nodes, rise_by
   use litz_kinds, only: dp
   use litz_spot_heat, only: by_heat, by_temperature, by_path
   implicit none
   private
   public :: own_tangent, multiply_heat

   !> What a change of nodal values makes of the contacts, before the temperatures of their bulks follow.
   type :: change_t
      !> Currents in all, and what temperatures make of them (contacts) [A]
      real(dp), allocatable :: current(:), by_temperature(:)
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
      real(dp) :: by_current(2), by_node(2, 4), row(4)
      integer :: a

      associate (contact => self%contacts(i), dheat => self%spots(i)%dheat, n => self%contacts(i)%part)
         do a = 1, 4
            by_node(:, a) = n(a)*inverse_of_own(self, i, dheat(:, by_temperature(merge(1, 2, a <= 2))))
         end do
         k_tt = reshape([(-n(:2)*by_node(1, a), -n(3:)*by_node(2, a), a=1, 4)], [4, 4])
         k_te = 0
         k_et = 0
         if (i > size(self%conductors%resistance)) return
         by_current = 2*self%current(i)*inverse_of_own(self, i, matmul(dheat(:, by_heat), &
            [contact%resistance(1), contact%film_resistance, contact%resistance(2)]))
         associate (n_v => self%conductors%n_v(:, i), diagonal => self%conductors%diagonal(i))
            k_te = reshape([(-n(:2)*by_current(1)*n_v(a), -n(3:)*by_current(2)*n_v(a), a=1, 4)], [4, 4])/diagonal
            row = -self%current(i)*contact%dseries([1, 1, 2, 2])*n/diagonal
            k_et = spread(n_v, 2, 4)*spread(row, 1, 4)
         end associate
      end associate
   end subroutine own_tangent

   !> The whole tangent times values, beyond what the matrix of the currents has: heat and currents that leave the
   !> nodes.
   subroutine multiply_heat(self, potential, temperature, heat, current)
      type(contact_heat_t), target, intent(in) :: self
      !> Changes at the nodes (n_nodes) [V], [K]
      real(dp), intent(in) :: potential(:), temperature(:)
      !> (n_nodes) [W]; by temperatures alone (n_nodes) [A]
      real(dp), intent(inout) :: heat(:), current(:)
      type(change_t) :: change
      type(bulk_map_t) :: map
      real(dp), dimension(2, size(self%contacts)) :: dbulk

      map%heat => self
      call change_currents(self, potential, temperature, change)
      call change_heats(self, potential, temperature, change)
      call solve_bulks(map, change%base + rise_by(self%elements, self%ends, change%heat + change%between), dbulk)
      call add_entering(self, change%heat + followed(self, dbulk) + change%between, change%at_nodes, heat)
      ! at fixed potentials
      call self%conductors%add_beyond(0*change%by_temperature, change%by_temperature, current)
   end subroutine multiply_heat

   !> `(R + A) dI = N_V dV - dR I - dA I`
   subroutine change_currents(self, potential, temperature, change)
      type(contact_heat_t), intent(in) :: self
      !> Changes at the nodes (n_nodes) [V], [K]
      real(dp), intent(in) :: potential(:), temperature(:)
      type(change_t), intent(inout) :: change
      real(dp), dimension(size(self%conductors%resistance)) :: voltage, unused
      real(dp) :: rise(2, size(self%conductors%resistance)), warmer(2)
      integer :: i, n

      n = size(self%conductors%resistance)
      allocate (change%current(size(self%contacts)), change%by_temperature(n), source=0.0_dp)
      if (n == 0) return
      do i = 1, n
         warmer = mean_change(self, i, temperature)*self%elements(self%ends%place_of(:, i))%dresistivity
         voltage(i) = -self%current(i)*dot_product(self%contacts(i)%dseries, change_at(self, i, temperature)) &
            + self%potential_rise(1, i)*warmer(1) - self%potential_rise(2, i)*warmer(2)
      end do
      call self%conductors%currents(voltage, change%by_temperature, rise, unused)
      call self%conductors%currents(self%conductors%voltages(potential), change%current(:n), rise, unused)
      change%current(:n) = change%current(:n) + change%by_temperature
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
   subroutine change_heats(self, potential, temperature, change)
      type(contact_heat_t), intent(in) :: self
      !> Changes at the nodes (n_nodes) [V], [K]
      real(dp), intent(in) :: potential(:), temperature(:)
      type(change_t), intent(inout) :: change
      real(dp) :: at(2), made(3), of_strips(size(self%contacts)), even(size(self%elements))
      integer :: i, k, n

      n = size(self%conductors%resistance)
      of_strips = 0
      if (n > 0) of_strips(:n) = self%conductors%strips%voltages(change%current(:n))
      allocate (change%heat(2, size(self%contacts)), change%between(2, size(self%contacts)), &
         change%base(2, size(self%contacts)), change%at_nodes(2, size(self%elements)), source=0.0_dp)
      do k = 1, size(self%elements)
         call change_element(self, k, potential, temperature, change, even(k))
      end do
      do i = 1, size(self%contacts)
         at = change_at(self, i, temperature)
         associate (contact => self%contacts(i), current => self%current(i), place => self%ends%place_of(:, i))
            made = 2*current*change%current(i)*[contact%resistance(1), contact%film_resistance, contact%resistance(2)]
            made([1, 3]) = made([1, 3]) + current**2*matmul(contact%dresistance, at)
            change%heat(:, i) = matmul(self%spots(i)%dheat(:, by_heat), made) &
               + matmul(self%spots(i)%dheat(:, by_path), matmul(contact%dpath, at)) &
               + (change%current(i)*self%of_strips(i) + current*of_strips(i))/2
            change%base(:, i) = at - self%elements(place)%dconductivity*mean_change(self, i, temperature) &
               *self%rise(:, i) + self%elements(place)%heat_series*(1 - contact%xi**2)/2*even(place)
         end associate
      end do
   end subroutine change_heats

   !> Heat that the currents make in an element: evenly, and beyond that between its contacts.
   subroutine change_element(self, k, potential, temperature, change, even_heat)
      type(contact_heat_t), intent(in) :: self
      !> Number among the elements with contacts
      integer, intent(in) :: k
      !> Changes at the nodes (n_nodes) [V], [K]
      real(dp), intent(in) :: potential(:), temperature(:)
      type(change_t), intent(inout) :: change
      !> [W]
      real(dp), intent(out) :: even_heat
      real(dp), dimension(n_parts(self%ends, k)) :: length, along, dalong, dmade
      real(dp) :: even, deven, dresistance

      even_heat = 0
      associate (element => self%elements(k))
         if (.not. element%resistance > 0) return
         even = self%drop(k)/element%resistance
         dresistance = element%dresistivity*sum(temperature(element%nodes))/2
         deven = (potential(element%nodes(1)) - potential(element%nodes(2)))/element%resistance - even*dresistance
         call currents_along(self%ends, k, even, self%current, length, along)
         call currents_along(self%ends, k, deven, change%current, length, dalong)
         dmade = element%heat_fraction*2*element%series*length*(2*(along*dalong - even*deven) &
            + (along**2 - even**2)*dresistance)
         even_heat = element%heat_fraction*element%resistance*(2*even*deven + even**2*dresistance)
      end associate
      call place_heat(self%ends, k, dmade, change%between, change%at_nodes(:, k))
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
