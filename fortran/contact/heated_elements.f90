!> What heat and currents that enter an element between its nodes do in it.
!>
!> A current is the same between two contacts; half of the heat that it makes there enters at either of them, which is
!> exact for the temperatures at the contacts. Source: theory sections 7 and 13.
module litz_heated_elements
   use litz_element_ends, only: element_ends_t, rise_at_ends
   use litz_kinds, only: dp
   use litz_potential_rise, only: moved_rise
   implicit none
   private
   public :: heated_element_t, n_parts, heat_of_parts, change_of_parts, place_heat, add_at_nodes, rise_by, moved_rise_by

   !> An element on which contacts are.
   type :: heated_element_t
      integer :: nodes(2) = 0
      !> Resistance from node to node [ohm]; 0: no current
      real(dp) :: resistance = 0
      !> rho L0/(4 A) [ohm] and L0/(4 lambda A) [K/W]; 0: what enters within it does so as at its nodes. Over time the
      !> latter is the part that the increment reaches, of that of a steady state
      real(dp) :: series = 0, heat_series = 0, steady_heat_series = 0
      !> Derivatives of ln(rho) and ln(lambda) by the mean temperature [1/K]
      real(dp) :: dresistivity = 0, dconductivity = 0
      !> lambda [W/(m K)]
      real(dp) :: conductivity = 0
      !> w^2 of (13.3): its film takes a part of what enters between the nodes
      real(dp) :: film = 0
      !> Of superconducting filaments: derivatives of the heat by V1 - V2 [A] and by the temperature of either node
      !> [W/K]
      real(dp) :: heat_by_voltage = 0, heat_by_temperature = 0
      !> Part of the electric power that becomes heat, and all heat that enters it evenly [W]
      real(dp) :: heat_fraction = 1, even_heat = 0
   end type heated_element_t

contains

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

   !> How these change as the places of the contacts move.
   pure subroutine move_parts(ends, k, current, dplace, dlength, dalong)
      type(element_ends_t), intent(in) :: ends
      !> Number among the elements with contacts
      integer, intent(in) :: k
      !> As of `currents_along` [A], and how the places move (2, contacts)
      real(dp), intent(in) :: current(:), dplace(:, :)
      !> Of the parts: changes of their lengths in xi (parts)
      real(dp), intent(out) :: dlength(:)
      !> Changes of their currents, to which is added (parts) [A]
      real(dp), intent(inout) :: dalong(:)
      real(dp), dimension(size(dlength) - 1) :: dxi, entering
      integer :: i

      associate (first => ends%first(k), last => ends%first(k + 1) - 1)
         dxi = [(dplace(ends%side(i), ends%contact(i)), i=first, last)]
         entering = merge(-1, 1, ends%side(first:last) == 1)*current(ends%contact(first:last))
      end associate
      dlength = [dxi, 0.0_dp] - [0.0_dp, dxi]
      dalong = dalong + sum(dxi*entering)/2
   end subroutine move_parts

   !> What the parts of an element between its contacts make beyond that of the element without them (parts) [W].
   pure function heat_of_parts(element, ends, k, drop, current) result(made)
      type(heated_element_t), intent(in) :: element
      type(element_ends_t), intent(in) :: ends
      !> Number among the elements with contacts
      integer, intent(in) :: k
      !> Voltage between the nodes [V], and currents of the contacts (contacts) [A]
      real(dp), intent(in) :: drop, current(:)
      real(dp), dimension(n_parts(ends, k)) :: made, length, along
      real(dp) :: even

      even = drop/element%resistance
      call currents_along(ends, k, even, current, length, along)
      made = element%heat_fraction*2*element%series*length*(along**2 - even**2)
   end function heat_of_parts

   !> How this changes with the currents (parts) [W].
   pure function change_of_parts(element, ends, k, drop, current, deven, dresistance, dcurrent, dplace) result(dmade)
      type(heated_element_t), intent(in) :: element
      type(element_ends_t), intent(in) :: ends
      !> Number among the elements with contacts
      integer, intent(in) :: k
      !> Voltage between the nodes [V], and currents of the contacts (contacts) [A]
      real(dp), intent(in) :: drop, current(:)
      !> Changes of the current without contacts [A], of ln(rho), and of the currents of the contacts (contacts) [A]
      real(dp), intent(in) :: deven, dresistance, dcurrent(:)
      !> How the places move (2, contacts); absent: they stay
      real(dp), intent(in), optional :: dplace(:, :)
      real(dp), dimension(n_parts(ends, k)) :: dmade, length, along, dlength, dalong
      real(dp) :: even

      even = drop/element%resistance
      call currents_along(ends, k, even, current, length, along)
      call currents_along(ends, k, deven, dcurrent, length, dalong)
      dlength = 0
      if (present(dplace)) call move_parts(ends, k, current, dplace, dlength, dalong)
      dmade = element%heat_fraction*2*element%series*(length*(2*(along*dalong - even*deven) &
         + (along**2 - even**2)*dresistance) + dlength*(along**2 - even**2))
   end function change_of_parts

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

   !> `A q`: how heat that enters at the contacts raises the temperatures there (2, contacts) [K].
   function rise_by(elements, ends, heat) result(rise)
      !> Those on which contacts are (elements)
      type(heated_element_t), intent(in) :: elements(:)
      type(element_ends_t), intent(in) :: ends
      !> (2, contacts) [W]
      real(dp), intent(in) :: heat(:, :)
      real(dp) :: rise(2, size(heat, 2))
      integer :: i

      call rise_at_ends(ends, elements%heat_series, [(heat(ends%side(i), ends%contact(i)), i=1, size(ends%xi))], rise, &
         elements%film)
   end function rise_by

   !> Heat that enters elements at their nodes, as heat that leaves these is positive.
   pure subroutine add_at_nodes(elements, at_nodes, leaving)
      !> (elements)
      type(heated_element_t), intent(in) :: elements(:)
      !> At both nodes of each (2, elements) [W]
      real(dp), intent(in) :: at_nodes(:, :)
      !> (n_nodes) [W]
      real(dp), intent(inout) :: leaving(:)
      integer :: k

      do k = 1, size(elements)
         associate (nodes => elements(k)%nodes)
            leaving(nodes) = leaving(nodes) - at_nodes(:, k)
         end associate
      end do
   end subroutine add_at_nodes

   !> How the rise changes as the places of the contacts move (2, contacts) [K].
   pure function moved_rise_by(elements, ends, heat, dplace) result(rise)
      !> Those on which contacts are (elements)
      type(heated_element_t), intent(in) :: elements(:)
      type(element_ends_t), intent(in) :: ends
      !> (2, contacts) [W], and how the places move (2, contacts)
      real(dp), intent(in) :: heat(:, :), dplace(:, :)
      real(dp) :: rise(2, size(heat, 2))
      integer :: k

      rise = 0
      do k = 1, size(elements)
         call move_rise(elements(k)%heat_series, elements(k)%film, ends, k, heat, dplace, rise)
      end do
   end function moved_rise_by

   !> The same in one element.
   pure subroutine move_rise(scale, film, ends, k, entering, dplace, rise)
      !> L0/(4 lambda A) of the element [K/W], and w^2 of its film
      real(dp), intent(in) :: scale, film
      type(element_ends_t), intent(in) :: ends
      !> Number among the elements with contacts
      integer, intent(in) :: k
      !> What enters at the contacts (2, contacts) [W], and how the places move (2, contacts)
      real(dp), intent(in) :: entering(:, :), dplace(:, :)
      !> (2, contacts) [K]; set at the contacts of this element, on its side
      real(dp), intent(inout) :: rise(:, :)
      real(dp), dimension(ends%first(k + 1) - ends%first(k)) :: above
      integer :: i

      associate (first => ends%first(k), last => ends%first(k + 1) - 1)
         call moved_rise(scale, film, ends%xi(first:last), [(dplace(ends%side(i), ends%contact(i)), i=first, last)], &
            [(entering(ends%side(i), ends%contact(i)), i=first, last)], above)
         do i = first, last
            rise(ends%side(i), ends%contact(i)) = above(i - first + 1)
         end do
      end associate
   end subroutine move_rise

end module litz_heated_elements
