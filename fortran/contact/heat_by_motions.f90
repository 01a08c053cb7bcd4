!> What motions do to currents and heats of contacts, and to these the temperatures that the mechanics sees: by the
!> places, by the spots.
!>
!> Changes at given potentials and temperatures of the bulks; what follows these is a matter of
!> litz_contact_heat_tangent. What spots and strips beside each other do to each other stays. Source: theory section 13.
module litz_heat_by_motions
   use litz_contact_kinematics, only: n_motions
   use litz_fields, only: motion_slots, temperature_slots
   use litz_heat_of_contacts, only: contact_heat_t
   use litz_heated_contacts, only: left_of_settled
   use litz_heated_elements, only: heated_element_t, moved_rise_by
   use litz_kinds, only: dp
   implicit none
   private
   public :: moved_t, move_contacts, voltage_by_motions, heat_by_motions, bulk_by_motions, add_moved_currents, &
      add_moved_heats

   !> Changes of the contacts.
   type :: moved_t
      !> Places (2, contacts)
      real(dp), allocatable :: place(:, :)
      !> Logarithms of the shape of the constrictions and of the heat conductance, and resistance as the matrix has it
      !> (contacts) [ohm]
      real(dp), allocatable :: shape(:), heat_conductance(:), resistance(:)
      !> Work of friction (contacts) [J]
      real(dp), allocatable :: friction_work(:)
   end type moved_t

contains

   subroutine move_contacts(self, value, moved)
      type(contact_heat_t), intent(in) :: self
      !> Changes at the nodes (n_slots, n_nodes)
      real(dp), intent(in) :: value(:, :)
      type(moved_t), intent(out) :: moved
      real(dp) :: dq(n_motions), warmer(4)
      integer :: i

      associate (n => size(self%rows))
         allocate (moved%place(2, n), moved%shape(n), moved%heat_conductance(n), moved%resistance(n), &
            moved%friction_work(n))
      end associate
      do i = 1, size(self%rows)
         associate (rows => self%rows(i), nodes => self%contacts(i)%nodes)
            dq = reshape(value(motion_slots(1):motion_slots(2), nodes), [n_motions])
            warmer = value(temperature_slots(1), nodes)
            moved%place(:, i) = matmul(dq, rows%place)
            moved%resistance(i) = dot_product(rows%resistance, dq)
            moved%shape(i) = dot_product(rows%shape, [dq, warmer])
            moved%heat_conductance(i) = dot_product(rows%heat_conductance, [dq, warmer])
            moved%friction_work(i) = dot_product(rows%friction_work, [dq, warmer])
         end associate
      end do
   end subroutine move_contacts

   !> Voltage that the place of a contact gains as it moves along the potentials of the nodes [V].
   pure real(dp) function voltage_along(self, i, place) result(voltage)
      type(contact_heat_t), intent(in) :: self
      !> Contact
      integer, intent(in) :: i
      !> By how much it moves (2)
      real(dp), intent(in) :: place(2)

      ! the drops are those from the first to the second node
      associate (drop => self%drop(self%ends%place_of(:, i)))
         voltage = (drop(2)*place(2) - drop(1)*place(1))/2
      end associate
   end function voltage_along

   !> What the currents have to balance: `dN_V V - dR I - dA I` (contacts with a current) [V].
   function voltage_by_motions(self, moved) result(voltage)
      type(contact_heat_t), intent(in) :: self
      type(moved_t), intent(in) :: moved
      real(dp) :: voltage(size(self%conductors%resistance))
      real(dp) :: entering(2, size(self%contacts)), rise(2, size(self%contacts))
      type(heated_element_t) :: conducting(size(self%elements))
      integer :: i

      ! the current leaves the barred wire; elements conduct it as heat
      entering = 0
      entering(1, :size(voltage)) = -self%current(:size(voltage))
      entering(2, :size(voltage)) = self%current(:size(voltage))
      conducting%heat_series = self%elements%series
      rise = moved_rise_by(conducting, self%ends, entering, moved%place)
      do i = 1, size(voltage)
         associate (contact => self%contacts(i))
            voltage(i) = voltage_along(self, i, moved%place(:, i)) + rise(1, i) - rise(2, i) &
               - self%current(i)*moved%shape(i)*(sum(contact%resistance) + 2*contact%film_resistance)
         end associate
      end do
   end function voltage_by_motions

   !> Change of the heats of a contact at fixed bulks and currents (2) [W].
   pure function heat_by_motions(self, i, moved) result(heat)
      type(contact_heat_t), intent(in) :: self
      !> Contact
      integer, intent(in) :: i
      type(moved_t), intent(in) :: moved
      real(dp) :: heat(2)

      associate (spot => self%spots(i))
         heat = spot%by_shape*moved%shape(i) + spot%by_heat_conductance*moved%heat_conductance(i) &
            + self%contacts(i)%of_work/2*moved%friction_work(i)
      end associate
   end function heat_by_motions

   !> Change of the temperatures of the bulks at fixed heats (2, contacts) [K].
   function bulk_by_motions(self, moved) result(bulk)
      type(contact_heat_t), intent(in) :: self
      type(moved_t), intent(in) :: moved
      real(dp) :: bulk(2, size(self%contacts)), by_place
      integer :: i, side

      bulk = moved_rise_by(self%elements, self%ends, self%heat + self%between, moved%place)
      do i = 1, size(self%contacts)
         associate (contact => self%contacts(i))
            do side = 1, 2
               associate (element => self%elements(self%ends%place_of(side, i)), &
                  t => self%temperature(2*side - 1:2*side, i))
                  by_place = dot_product(contact%dpart(2*side - 1:2*side), t - contact%sink(side)) &
                     + contact%deven(side)*element%heat_series*element%even_heat &
                     + contact%down(side)*element%steady_heat_series*left_of_settled(contact, side)
                  bulk(side, i) = bulk(side, i) + moved%place(side, i)*by_place
               end associate
            end do
         end associate
      end do
   end function bulk_by_motions

   !> Currents that enter at other places, less what the matrix has of motions, where each contact is by itself.
   subroutine add_moved_currents(self, moved, leaving)
      type(contact_heat_t), intent(in) :: self
      type(moved_t), intent(in) :: moved
      !> (n_nodes) [A]
      real(dp), intent(inout) :: leaving(:)
      real(dp) :: alone, dalone, n_v(4)
      integer :: i

      do i = 1, size(self%voltage)
         associate (contact => self%contacts(i), nodes => self%contacts(i)%nodes, diagonal => &
            self%linear_conductors%diagonal(i), place => moved%place(:, i))
            n_v = [-place(1), place(1), place(2), -place(2)]/2                              ! dN_V
            alone = self%voltage(i)/diagonal
            dalone = (voltage_along(self, i, place) - alone*(moved%resistance(i) &
               - 2*sum(contact%series*contact%xi*place)))/diagonal
            leaving(nodes) = leaving(nodes) + (self%current(i) - alone)*n_v - dalone*self%conductors%n_v(:, i)
         end associate
      end do
   end subroutine add_moved_currents

   !> Heats that enter at other places, as heat that leaves the nodes is positive.
   pure subroutine add_moved_heats(self, moved, leaving)
      type(contact_heat_t), intent(in) :: self
      type(moved_t), intent(in) :: moved
      !> (n_nodes) [W]
      real(dp), intent(inout) :: leaving(:)
      integer :: i

      do i = 1, size(self%contacts)
         associate (contact => self%contacts(i), nodes => self%contacts(i)%nodes, place => moved%place(:, i), &
            heat => self%heat(:, i) + self%between(:, i))
            leaving(nodes) = leaving(nodes) - contact%dpart*place([1, 1, 2, 2])*(heat([1, 1, 2, 2]) &
               + contact%friction_beyond/2) - contact%part*contact%beyond_of_work/2*moved%friction_work(i)
         end associate
      end do
   end subroutine add_moved_heats

end module litz_heat_by_motions
