!> Spots near each other on one wire: the current of each raises the potential at the others.
!>
!> Source: theory section 10, and J. A. Greenwood, Br. J. Appl. Phys. 17 (1966) 1621-1632: `rho I/(2 pi s)` at a
!> distance s that is small compared with the wire; farther away what the wire leaves of it above the mean of the
!> section, which conductors have. A free end is a plane that nothing passes: the spots behind it are their mirror
!> images. Distances are those along the axis, so that in a bend the inner side counts as long as the outer one.
module litz_spots_beside_spots
   use litz_kinds, only: dp
   use litz_contact_points, only: arc_at
   use litz_element_library, only: elements_t, material_at, material_place_t
   use litz_model, only: model_t
   use litz_mutual_resistances, only: mutual_resistances_t
   use litz_spot_on_wire, only: potential_beside_spot, reach_of_spot
   use litz_wires, only: wires_t, arc_from_to
   implicit none
   private
   public :: collect_spots, spots_t

   !> Where a current passes between two wires.
   type :: spots_t
      !> Elements, barred first, and places in them (2, n)
      integer, allocatable :: elements(:, :)
      real(dp), allocatable :: xi(:, :)
      !> From the unbarred to the barred wire (3, n), and the points of both axes (3, 2, n) [m]
      real(dp), allocatable :: normal(:, :), axis(:, :, :)
      !> Of the spots (n) [ohm]
      real(dp), allocatable :: resistance(:)
      !> The contact is a point of a line; its law asks for what others add (n)
      logical, allocatable :: is_line(:), feels_others(:)
   end type spots_t

   !> A contact on one of its wires.
   type :: spot_t
      !> Contact, and which of its wires it is (1: barred); elements of this wire and of the other one
      integer :: contact = 0, side = 0, element = 0, other = 0
      !> Place in the element, and arc length along the wire [m]
      real(dp) :: xi = 0, arc = 0
      !> From the axis of this wire to the spot (3), and point of the axis (3) [m]
      real(dp) :: outward(3) = 0, axis(3) = 0
      !> The spot before it in the same element; 0: none
      integer :: before = 0
   end type spot_t

   !> The round end of a wire counts as a flat one of the same volume, which is as far beyond its node [radii]
   real(dp), parameter :: beyond_node = 2.0_dp/3
   !> Points of an axis that are nearer to each other [radii] have no direction
   real(dp), parameter :: same_place = 1.0e-6_dp

contains

   !> Pairs of contacts that are within reach of each other on a wire, each once; a contact beside its own image is one.
   subroutine collect_spots(model, wires, elements, contacts, mutual)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(spots_t), intent(in) :: contacts
      type(mutual_resistances_t), intent(out) :: mutual
      type(spot_t), allocatable :: spots(:)
      integer, allocatable :: last(:)
      real(dp), allocatable :: reach(:)
      integer :: n, pass, k

      call chain_spots(wires, elements, contacts, spots, last)
      allocate (reach(wires%n_wires), source=0.0_dp)
      if (size(spots) > 0) then
         do k = 1, size(wires%wire)
            reach(wires%wire(k)) = max(reach(wires%wire(k)), reach_of_spot*elements%radius(k))
         end do
      end if
      do pass = 1, 2
         n = 0
         do k = 1, size(spots)
            call add_image_of(spots(k))
            call add_pairs_in(spots(k)%element, spots(k)%before, spots(k))
            call add_pairs_beyond(spots(k))
         end do
         if (pass == 1) allocate (mutual%contacts(2, n), mutual%sides(2, n), mutual%resistance(n), &
            mutual%shape(n), mutual%nodes(4, n), mutual%by_temperature(4, n))
      end do
      mutual%is_spot = spread(.true., 1, n)

   contains

      !> Pairs with spots of the elements that follow along the wire, as far as the reach.
      subroutine add_pairs_beyond(a)
         type(spot_t), intent(in) :: a
         integer :: place, w
         real(dp) :: gap

         w = wires%wire(a%element)
         place = wires%place(a%element)
         gap = wires%arc(a%element) + elements%length(a%element)/2 - a%arc
         do while (gap < reach(w))
            place = place + 1
            if (place == wires%first(w + 1)) then
               if (.not. wires%circumference(w) > 0) exit
               place = wires%first(w)
            end if
            associate (e => wires%element(place))
               if (e == a%element) exit
               call add_pairs_in(e, last(e), a)
               gap = gap + elements%length(e)
            end associate
         end do
      end subroutine add_pairs_beyond

      !> Pairs with a chain of spots in one element.
      subroutine add_pairs_in(element, newest, a)
         !> Its number
         integer, intent(in) :: element
         !> The first of the chain; 0: there is none
         integer, intent(in) :: newest
         type(spot_t), intent(in) :: a
         integer :: i

         i = newest
         do while (i > 0)
            if (element == a%element .or. arc_from_to(a%arc, spots(i)%arc, &
               wires%circumference(wires%wire(element))) >= 0) then
               if (are_near(a, spots(i))) call add_pair(a, spots(i))
            end if
            i = spots(i)%before
         end do
      end subroutine add_pairs_in

      !> A spot near a free end of its wire.
      subroutine add_image_of(a)
         type(spot_t), intent(in) :: a

         if (contacts%is_line(a%contact)) return
         if (any(2*depth_below_ends(wires, elements, a) < reach_of_spot)) call add_pair(a, a)
      end subroutine add_image_of

      !> Two spots of a wire are within reach. Strips beside each other are not spots, nor is a line a spot beside that
      !> of its own two wires.
      logical function are_near(a, b)
         type(spot_t), intent(in) :: a, b

         are_near = .false.
         if (a%contact == b%contact .or. all(contacts%is_line([a%contact, b%contact]))) return
         if (any(contacts%is_line([a%contact, b%contact])) .and. wires%wire(a%other) == wires%wire(b%other)) return
         are_near = wires%arc_between(wires%wire(a%element), a%arc, b%arc) < reach_of_spot*elements%radius(a%element)
      end function are_near

      subroutine add_pair(a, b)
         type(spot_t), intent(in) :: a, b

         n = n + 1
         if (pass == 1) return
         mutual%contacts(:, n) = [a%contact, b%contact]
         mutual%sides(:, n) = [a%side, b%side]
         mutual%nodes(:, n) = [model%connectivity(:, a%element), model%connectivity(:, b%element)]
         call find_resistance(model, wires, elements, a, b, contacts%resistance([a%contact, b%contact]), &
            mutual%resistance(n), mutual%shape(n), mutual%by_temperature(:, n))
      end subroutine add_pair

   end subroutine collect_spots

   !> The spots of both wires, as chains of those in an element.
   subroutine chain_spots(wires, elements, contacts, spots, last)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(spots_t), intent(in) :: contacts
      type(spot_t), allocatable, intent(out) :: spots(:)
      !> The newest spot of each element; 0: there is none (n_elements)
      integer, allocatable, intent(out) :: last(:)
      integer :: i, side, k

      allocate (spots(2*count(contacts%feels_others)))
      allocate (last(size(wires%wire)), source=0)
      k = 0
      do i = 1, size(contacts%feels_others)
         if (.not. contacts%feels_others(i)) cycle
         do side = 1, 2
            k = k + 1
            associate (e => contacts%elements(side, i), xi => contacts%xi(side, i))
               spots(k) = spot_t(i, side, e, contacts%elements(3 - side, i), xi, arc_at(wires, elements, e, xi), &
                  (2*side - 3)*contacts%normal(:, i), contacts%axis(:, side, i), last(e))
               last(e) = k
            end associate
         end do
      end do
   end subroutine chain_spots

   !> What a current through one spot adds to the voltage of the other one [ohm]; half of that by which its own image
   !> adds to its own, which counts from both sides.
   pure subroutine find_resistance(model, wires, elements, a, b, alone, resistance, shape, by_temperature)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(spot_t), intent(in) :: a, b
      !> Resistance of either (2) [ohm]
      real(dp), intent(in) :: alone(2)
      !> [ohm], and over resistivity and current that enters [1/m]
      real(dp), intent(out) :: resistance, shape
      !> How the former changes with the temperatures of the nodes of both elements (4) [ohm/K]
      real(dp), intent(out) :: by_temperature(4)
      type(material_place_t) :: here, there
      real(dp) :: radius, resistivity, cosine, least, potential, image(2), part
      integer :: k

      here = material_at(model, elements, a%element, a%xi)
      there = material_at(model, elements, b%element, b%xi)
      resistivity = (here%resistivity + there%resistivity)/2
      radius = elements%radius(a%element)
      cosine = cosine_between(a, b, radius)
      ! discs as large as their resistances, rho/(4 a) on either side, do not overlap
      least = resistivity/2*sum(1/alone)/radius
      potential = 0
      if (a%contact /= b%contact) potential = potential_beside_spot(cosine, wires%arc_between( &
         wires%wire(a%element), a%arc, b%arc)/radius, least)
      image = depth_below_ends(wires, elements, a) + depth_below_ends(wires, elements, b)
      do k = 1, 2
         if (image(k) < reach_of_spot) potential = potential + potential_beside_spot(cosine, image(k), least)
      end do
      if (a%contact == b%contact) potential = potential/2
      ! a resistance that is given may be below that of any spot on such a wire: (R + A) stays positive definite
      part = min(1.0_dp, sqrt(product(alone))*radius/resistivity)
      shape = potential/radius*part
      ! the current leaves the barred wire and enters the unbarred one
      resistance = real((2*a%side - 3)*(2*b%side - 3), dp)*resistivity*shape
      by_temperature = 0
      if (part < 1) return
      by_temperature = resistance/resistivity/4*[here%dresistivity*[1 - a%xi, 1 + a%xi], &
         there%dresistivity*[1 - b%xi, 1 + b%xi]]
   end subroutine find_resistance

   !> Cosine of the angle round the wire between two spots. Along a bend a direction turns with the axis: on an arc of a
   !> circle it is mirrored at the plane across the middle of the chord.
   pure real(dp) function cosine_between(a, b, radius) result(cosine)
      type(spot_t), intent(in) :: a, b
      !> [m]
      real(dp), intent(in) :: radius
      real(dp) :: chord(3)

      cosine = dot_product(a%outward, b%outward)
      chord = b%axis - a%axis
      if (.not. norm2(chord) > same_place*radius) return
      chord = chord/norm2(chord)
      cosine = cosine - 2*dot_product(chord, a%outward)*dot_product(chord, b%outward)
   end function cosine_between

   !> Distances from the flat ends that stand for the round free ends of the wire (2) [radii].
   pure function depth_below_ends(wires, elements, a) result(depth)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(spot_t), intent(in) :: a
      real(dp) :: depth(2)

      depth = reach_of_spot
      associate (w => wires%wire(a%element))
         if (wires%circumference(w) > 0) return
         if (wires%is_free(1, w)) depth(1) = a%arc/elements%radius(a%element) + beyond_node
         associate (e => wires%element(wires%first(w + 1) - 1))
            if (wires%is_free(2, w)) depth(2) = (wires%arc(e) + elements%length(e)/2 - a%arc) &
               /elements%radius(a%element) + beyond_node
         end associate
      end associate
   end function depth_below_ends

end module litz_spots_beside_spots
