!> Heat and temperatures of all contacts together, where several of them may share elements.
!>
!> The heats `q` that enter a wire at its contacts raise its temperature there above the linear one as currents raise
!> its potential, by the matrix `A` of heat; what a current makes in the wire between its contacts does so, too. The
!> spots give the heats from the temperatures of the bulks,
!>
!>     tau = N T + a + A (q(tau) + v)                                                                               (1)
!>
!> with the heat `v` that the parts of an element between contacts make beyond that of the element without them, half
!> of it at either end of a part, and the rise `a` by what the element makes evenly. Exact at the contacts for constant
!> properties. Source: theory sections 7 and 13.
module litz_heat_of_contacts
   use litz_element_ends, only: element_ends_t, collect_ends
   use litz_gmres, only: linear_map_t, gmres
   use litz_heated_contacts, only: heated_contact_t
   use litz_kinds, only: dp
   use litz_parallel, only: worth_threads
   use litz_potential_rise, only: potential_rise
   use litz_shared_conductors, only: shared_conductors_t
   use litz_spot_heat, only: spot_heat_t, spot_heat, heat_ok, by_heat, by_temperature, by_path
   implicit none
   private
   public :: contact_heat_t, heated_element_t, collect_heat

   !> Newton's method for (1) stops at this change over the largest temperature, from absolute zero; steps at most
   real(dp), parameter :: accurate = 1.0e-13_dp
   integer, parameter :: max_iterations = 50
   !> Residual of its linear equations, and products with their matrix at most
   real(dp), parameter :: linear_accuracy = 1.0e-14_dp
   integer, parameter :: max_products = 400
   !> A temperature of a bulk that would fall below absolute zero keeps this part of itself
   real(dp), parameter :: least_part = 0.1_dp

   real(dp), parameter :: unit(2, 2) = reshape([1.0_dp, 0.0_dp, 0.0_dp, 1.0_dp], [2, 2])

   !> An element on which contacts are.
   type :: heated_element_t
      integer :: nodes(2) = 0
      !> Resistance from node to node [ohm]; 0: no current
      real(dp) :: resistance = 0
      !> rho L0/(4 A) [ohm] and L0/(4 lambda A) [K/W]; 0: what enters within it does so as at its nodes
      real(dp) :: series = 0, heat_series = 0
      !> Derivatives of ln(rho) and ln(lambda) by the mean temperature [1/K]
      real(dp) :: dresistivity = 0, dconductivity = 0
      !> Part of the electric power that becomes heat, and all heat that enters it evenly [W]
      real(dp) :: heat_fraction = 1, even_heat = 0
   end type heated_element_t

   type :: contact_heat_t
      !> Those that carry a current come first
      type(heated_contact_t), allocatable :: contacts(:)
      type(heated_element_t), allocatable :: elements(:)
      type(element_ends_t) :: ends
      !> The first of the contacts
      type(shared_conductors_t) :: conductors
      !> Absolute zero on the scale of the temperatures [K]
      real(dp) :: zero = 0
      !> Currents [A], what strips add to their voltages [V] (contacts), and rises of the potential (2, contacts) [V]
      real(dp), allocatable :: current(:), of_strips(:), potential_rise(:, :)
      !> Temperatures of the bulks, and what of them is above the linear ones (2, contacts) [K]
      real(dp), allocatable :: bulk(:, :), rise(:, :)
      !> Heats that enter the wires at the contacts: through the spots, and v (2, contacts) [W]
      real(dp), allocatable :: heat(:, :), between(:, :)
      !> v at both nodes of each element (2, elements), and all v of an element (elements) [W]
      real(dp), allocatable :: at_nodes(:, :), between_contacts(:)
      type(spot_heat_t), allocatable :: spots(:)
      !> Voltages of the nodes of each element: first minus second (elements) [V]
      real(dp), allocatable :: drop(:)
      !> (1) has a solution
      logical :: is_solved = .true.
   contains
      procedure :: solve
      procedure :: own_tangent
      procedure :: multiply
   end type contact_heat_t

   !> `1 - A dq/dtau` of (1).
   type, extends(linear_map_t) :: bulk_map_t
      type(contact_heat_t), pointer :: heat => null()
   contains
      procedure :: apply => apply_bulk_map
      procedure :: precondition => precondition_bulk_map
   end type bulk_map_t

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

   subroutine collect_heat(contacts, conductors, zero, heat)
      !> Those that carry a current first
      type(heated_contact_t), intent(in) :: contacts(:)
      !> Of these
      type(shared_conductors_t), intent(in) :: conductors
      !> Absolute zero on the scale of the temperatures [K]
      real(dp), intent(in) :: zero
      !> The caller fills in `elements`, in the order of `ends`
      type(contact_heat_t), intent(out) :: heat
      integer :: i

      heat%contacts = contacts
      heat%conductors = conductors
      heat%zero = zero
      call collect_ends(reshape([(contacts(i)%element, i=1, size(contacts))], [2, size(contacts)]), &
         reshape([(contacts(i)%xi, i=1, size(contacts))], [2, size(contacts)]), heat%ends)
      allocate (heat%elements(size(heat%ends%element)))
   end subroutine collect_heat

   !> Currents, heats and temperatures at the values of an iterate.
   subroutine solve(self, potential, temperature)
      class(contact_heat_t), target, intent(inout) :: self
      !> Of the nodes (n_nodes) [V], [K]
      real(dp), intent(in) :: potential(:), temperature(:)
      integer :: n, n_conducting, i

      n = size(self%contacts)
      n_conducting = size(self%conductors%resistance)
      allocate (self%current(n), self%of_strips(n), self%potential_rise(2, n), source=0.0_dp)
      if (n_conducting > 0) call self%conductors%currents(self%conductors%voltages(potential), &
         self%current(:n_conducting), self%potential_rise(:, :n_conducting), self%of_strips(:n_conducting))
      allocate (self%drop, source=[(potential(self%elements(i)%nodes(1)) - potential(self%elements(i)%nodes(2)), &
         i=1, size(self%elements))])
      call find_heat_between(self)
      call find_bulks(self, temperature)
   end subroutine solve

   !> What the currents make in the elements beyond what they would make without contacts.
   subroutine find_heat_between(self)
      class(contact_heat_t), intent(inout) :: self
      integer :: k

      allocate (self%between(2, size(self%contacts)), self%at_nodes(2, size(self%elements)), &
         self%between_contacts(size(self%elements)), source=0.0_dp)
      do k = 1, size(self%elements)
         if (self%elements(k)%series > 0) call find_heat_in_element(self, k)
      end do
   end subroutine find_heat_between

   subroutine find_heat_in_element(self, k)
      class(contact_heat_t), intent(inout) :: self
      !> Number among the elements with contacts
      integer, intent(in) :: k
      real(dp), dimension(n_parts(self%ends, k)) :: length, along, made
      real(dp) :: even

      associate (element => self%elements(k))
         even = self%drop(k)/element%resistance
         call currents_along(self%ends, k, even, self%current, length, along)
         made = element%heat_fraction*2*element%series*length*(along**2 - even**2)
      end associate
      call place_heat(self%ends, k, made, self%between, self%at_nodes(:, k))
      self%between_contacts(k) = sum(made)
   end subroutine find_heat_in_element

   !> Parts of an element between its contacts.
   pure integer function n_parts(ends, k)
      type(element_ends_t), intent(in) :: ends
      !> Number among the elements with contacts
      integer, intent(in) :: k

      n_parts = ends%first(k + 1) - ends%first(k) + 1
   end function n_parts

   !> Currents towards the second node in the parts of an element between its contacts; linear in its arguments.
   pure subroutine currents_along(ends, k, even, current, length, along)
      type(element_ends_t), intent(in) :: ends
      !> Number among the elements with contacts
      integer, intent(in) :: k
      !> Current in the element without contacts, and those of the contacts, from the barred to the unbarred wire
      !> (contacts) [A]
      real(dp), intent(in) :: even, current(:)
      !> Of the parts: length in xi, and current (parts) [A]
      real(dp), intent(out) :: length(:), along(:)
      real(dp), dimension(size(along) - 1) :: xi, entering
      integer :: part

      associate (first => ends%first(k), last => ends%first(k + 1) - 1)
         xi = ends%xi(first:last)
         entering = merge(-1, 1, ends%side(first:last) == 1)*current(ends%contact(first:last))
      end associate
      length = [xi, 1.0_dp] - [-1.0_dp, xi]
      along(1) = even - sum((1 - xi)*entering)/2
      do part = 2, size(along)
         along(part) = along(part - 1) + entering(part - 1)
      end do
   end subroutine currents_along

   !> Half of what a part of an element makes enters at either end of it.
   pure subroutine place_heat(ends, k, made, at_contacts, at_nodes)
      type(element_ends_t), intent(in) :: ends
      !> Number among the elements with contacts
      integer, intent(in) :: k
      !> In the parts between the contacts (parts) [W]
      real(dp), intent(in) :: made(:)
      !> (2, contacts), set at the contacts of this element, on its side; and at its nodes (2) [W]
      real(dp), intent(inout) :: at_contacts(:, :), at_nodes(2)
      integer :: i, part

      part = 1
      do i = ends%first(k), ends%first(k + 1) - 1
         at_contacts(ends%side(i), ends%contact(i)) = (made(part) + made(part + 1))/2
         part = part + 1
      end do
      at_nodes = [made(1), made(size(made))]/2
   end subroutine place_heat

   !> Solve (1) by Newton's method.
   subroutine find_bulks(self, temperature)
      class(contact_heat_t), target, intent(inout) :: self
      !> Of the nodes (n_nodes) [K]
      real(dp), intent(in) :: temperature(:)
      real(dp), dimension(2, size(self%contacts)) :: linear, base, left, step
      type(bulk_map_t) :: map
      integer :: i, side, iteration

      map%heat => self
      do i = 1, size(self%contacts)
         associate (contact => self%contacts(i))
            do side = 1, 2
               linear(side, i) = dot_product(contact%part(2*side - 1:2*side), &
                  temperature(contact%nodes(2*side - 1:2*side)))
               associate (element => self%elements(self%ends%place_of(side, i)))
                  base(side, i) = linear(side, i) + element%heat_series*(1 - contact%xi(side)**2)/2*element%even_heat
               end associate
            end do
         end associate
      end do
      base = base + rise_by(self, self%between)
      allocate (self%spots(size(self%contacts)), self%heat(2, size(self%contacts)))
      self%bulk = base
      self%is_solved = .true.
      do iteration = 1, max_iterations
         call find_heats(self)
         if (.not. self%is_solved) return
         left = base + rise_by(self, self%heat) - self%bulk
         call solve_bulks(map, left, step)
         call add_step(step)
         if (.not. maxval(abs(step)) > accurate*maxval(abs(self%bulk - self%zero))) exit
      end do
      self%is_solved = iteration <= max_iterations .and. maxval(abs(step)) <= huge(1.0_dp)
      call find_heats(self)
      self%rise = self%bulk - linear

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
               elsewhere
                  bulk = bulk + step(:, i)
               end where
            end associate
         end do
      end subroutine add_step

   end subroutine find_bulks

   !> Heats through the spots at the temperatures of the bulks; what strips make beside them, and friction, enters both
   !> wires half and half.
   subroutine find_heats(self)
      class(contact_heat_t), intent(inout) :: self
      integer :: i, info

      do i = 1, size(self%contacts)
         associate (contact => self%contacts(i), current => self%current(i))
            if (.not. contact%is_passed) then
               self%spots(i) = spot_heat_t(hottest=maxval(self%bulk(:, i)) - self%zero)
               self%heat(:, i) = contact%friction_heat/2
               cycle
            end if
            call spot_heat(contact%path, self%bulk(:, i) - self%zero, current**2*[contact%resistance(1), &
               contact%film_resistance, contact%resistance(2)], self%spots(i), info)
            if (info /= heat_ok) self%is_solved = .false.
            self%heat(:, i) = self%spots(i)%heat + (current*self%of_strips(i) + contact%friction_heat)/2
         end associate
      end do
   end subroutine find_heats

   !> `A q`: how heat that enters at the contacts raises the temperatures there (2, contacts) [K].
   function rise_by(self, heat) result(rise)
      type(contact_heat_t), intent(in) :: self
      !> (2, contacts) [W]
      real(dp), intent(in) :: heat(:, :)
      real(dp) :: rise(2, size(self%contacts))
      integer :: k

      rise = 0
      !$omp parallel do schedule(static) if (size(self%elements) >= worth_threads)
      do k = 1, size(self%elements)
         call set_rise(self, k, heat, rise)
      end do
      !$omp end parallel do
   end function rise_by

   !> The same in one element.
   pure subroutine set_rise(self, k, heat, rise)
      type(contact_heat_t), intent(in) :: self
      !> Number among the elements with contacts
      integer, intent(in) :: k
      !> (2, contacts) [W]
      real(dp), intent(in) :: heat(:, :)
      !> (2, contacts) [K]; set at the contacts of this element, on its side
      real(dp), intent(inout) :: rise(:, :)
      real(dp), dimension(self%ends%first(k + 1) - self%ends%first(k)) :: entering, above
      integer :: i

      associate (ends => self%ends, first => self%ends%first(k), last => self%ends%first(k + 1) - 1)
         entering = [(heat(ends%side(i), ends%contact(i)), i=first, last)]
         call potential_rise(self%elements(k)%heat_series, ends%xi(first:last), entering, above)
         do i = first, last
            rise(ends%side(i), ends%contact(i)) = above(i - first + 1)
         end do
      end associate
   end subroutine set_rise

   !> `(1 - A dq/dtau) x = b`
   subroutine solve_bulks(map, b, x)
      type(bulk_map_t), intent(inout) :: map
      !> (2, contacts) [K]
      real(dp), intent(in) :: b(:, :)
      real(dp), intent(out) :: x(:, :)
      real(dp) :: solution(size(b))

      call gmres(map, reshape(b, [size(b)]), linear_accuracy, max_products, solution)
      x = reshape(solution, shape(x))
   end subroutine solve_bulks

   subroutine apply_bulk_map(self, x, y)
      class(bulk_map_t), intent(inout) :: self
      !> (2*contacts) [K]
      real(dp), intent(in) :: x(:)
      real(dp), intent(out) :: y(:)

      associate (shaped => reshape(x, [2, size(x)/2]))
         y = x - reshape(rise_by(self%heat, followed(self%heat, shaped)), [size(x)])
      end associate
   end subroutine apply_bulk_map

   !> Each contact by itself: `1 - D dq/dtau` with the diagonal `D` of `A`.
   subroutine precondition_bulk_map(self, x, y)
      class(bulk_map_t), intent(inout) :: self
      !> (2*contacts) [K]
      real(dp), intent(in) :: x(:)
      real(dp), intent(out) :: y(:)
      integer :: i

      do i = 1, size(self%heat%contacts)
         associate (dheat => self%heat%spots(i)%dheat(:, by_temperature))
            y(2*i - 1:2*i) = solved(unit - spread(own_rise(self%heat, i), 2, 2)*dheat, x(2*i - 1:2*i))
         end associate
      end do
   end subroutine precondition_bulk_map

   !> dq = dq/dtau dtau (2, contacts) [W].
   pure function followed(self, dbulk) result(dheat)
      type(contact_heat_t), intent(in) :: self
      !> (2, contacts) [K]
      real(dp), intent(in) :: dbulk(:, :)
      real(dp) :: dheat(2, size(dbulk, 2))
      integer :: i

      do i = 1, size(dbulk, 2)
         dheat(:, i) = matmul(self%spots(i)%dheat(:, by_temperature), dbulk(:, i))
      end do
   end function followed

   !> What heat that enters at a contact does to the temperature there by itself: diagonal of A (2) [K/W].
   pure function own_rise(self, i) result(rise)
      type(contact_heat_t), intent(in) :: self
      !> Contact
      integer, intent(in) :: i
      real(dp) :: rise(2)

      rise = self%elements(self%ends%place_of(:, i))%heat_series*(1 - self%contacts(i)%xi**2)
   end function own_rise

   !> Solution of two equations (2).
   pure function solved(k, b) result(x)
      real(dp), intent(in) :: k(2, 2), b(2)
      real(dp) :: x(2)

      x = [k(2, 2)*b(1) - k(1, 2)*b(2), k(1, 1)*b(2) - k(2, 1)*b(1)]/(k(1, 1)*k(2, 2) - k(1, 2)*k(2, 1))
   end function solved

   !> Heat that enters the nodes, as heat that leaves them is positive.
   pure subroutine add_entering(self, heat, at_nodes, leaving)
      type(contact_heat_t), intent(in) :: self
      !> At the contacts (2, contacts), and beyond it at both nodes (2, elements) [W]
      real(dp), intent(in) :: heat(:, :), at_nodes(:, :)
      !> (n_nodes) [W]
      real(dp), intent(inout) :: leaving(:)
      integer :: i, k

      do i = 1, size(self%contacts)
         associate (nodes => self%contacts(i)%nodes, n => self%contacts(i)%part)
            leaving(nodes(:2)) = leaving(nodes(:2)) - n(:2)*heat(1, i)
            leaving(nodes(3:)) = leaving(nodes(3:)) - n(3:)*heat(2, i)
         end associate
      end do
      do k = 1, size(self%elements)
         associate (nodes => self%elements(k)%nodes)
            leaving(nodes) = leaving(nodes) - at_nodes(:, k)
         end associate
      end do
   end subroutine add_entering

   !> What a contact by itself does to its own nodes, at fixed conductances but for their temperatures: the part of the
   !> tangent that the matrix holds.
   pure subroutine own_tangent(self, i, k_te, k_tt, k_et)
      class(contact_heat_t), intent(in) :: self
      !> Contact
      integer, intent(in) :: i
      !> Heat that leaves the nodes by their potentials and by their temperatures, and currents that leave them by their
      !> temperatures (4, 4) [A, W/K, A/K]
      real(dp), intent(out) :: k_te(4, 4), k_tt(4, 4), k_et(4, 4)
      real(dp) :: by_current(2), by_node(2, 4), row(4)
      integer :: a

      associate (contact => self%contacts(i), dheat => self%spots(i)%dheat, n => self%contacts(i)%part)
         do a = 1, 4
            by_node(:, a) = n(a)*solved(unit - spread(own_rise(self, i), 1, 2)*dheat(:, by_temperature), &
               dheat(:, by_temperature(merge(1, 2, a <= 2))))
         end do
         k_tt = reshape([(-n(:2)*by_node(1, a), -n(3:)*by_node(2, a), a=1, 4)], [4, 4])
         k_te = 0
         k_et = 0
         if (i > size(self%conductors%resistance)) return
         by_current = 2*self%current(i)*solved(unit - spread(own_rise(self, i), 1, 2)*dheat(:, by_temperature), &
            matmul(dheat(:, by_heat), [contact%resistance(1), contact%film_resistance, contact%resistance(2)]))
         associate (n_v => self%conductors%n_v(:, i), diagonal => self%conductors%diagonal(i))
            k_te = reshape([(-n(:2)*by_current(1)*n_v(a), -n(3:)*by_current(2)*n_v(a), a=1, 4)], [4, 4])/diagonal
            row = -self%current(i)*contact%dseries([1, 1, 2, 2])*n/diagonal
            k_et = spread(n_v, 2, 4)*spread(row, 1, 4)
         end associate
      end associate
   end subroutine own_tangent

   !> The whole tangent times values, beyond what the matrix of the currents has: heat and currents that leave the nodes.
   subroutine multiply(self, potential, temperature, heat, current)
      class(contact_heat_t), target, intent(in) :: self
      !> Changes at the nodes (n_nodes) [V], [K]
      real(dp), intent(in) :: potential(:), temperature(:)
      !> (n_nodes) [W]; by temperatures alone (n_nodes) [A]
      real(dp), intent(inout) :: heat(:), current(:)
      type(change_t) :: change
      type(bulk_map_t) :: map
      real(dp), dimension(2, size(self%contacts)) :: dbulk
      integer :: i, a

      map%heat => self
      call change_currents(self, potential, temperature, change)
      call change_heats(self, potential, temperature, change)
      call solve_bulks(map, change%base + rise_by(self, change%heat + change%between), dbulk)
      call add_entering(self, change%heat + followed(self, dbulk) + change%between, change%at_nodes, heat)
      do i = 1, size(self%conductors%resistance)
         do a = 1, 4
            associate (node => self%conductors%nodes(a, i))
               current(node) = current(node) + self%conductors%n_v(a, i)*change%by_temperature(i)
            end associate
         end do
      end do
   end subroutine multiply

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

end module litz_heat_of_contacts
