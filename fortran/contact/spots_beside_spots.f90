!> Spots near each other on one wire: the current of each raises the potential at the others.
!>
!> Source: theory section 10, and J. A. Greenwood, Br. J. Appl. Phys. 17 (1966) 1621-1632: `rho I/(2 pi s)` at a
!> distance s that is small compared with the wire; farther away what the wire leaves of it above the mean of the
!> section, which conductors have.
module litz_spots_beside_spots
   use litz_kinds, only: dp
   use litz_contact_points, only: arc_at
   use litz_element_library, only: elements_t, material_at, material_place_t
   use litz_model, only: model_t
   use litz_mutual_resistances, only: mutual_resistances_t
   use litz_spot_on_wire, only: potential_beside_spot, reach_of_spot
   use litz_wires, only: wires_t
   implicit none
   private
   public :: collect_spots

   !> A contact on one of its wires.
   type :: spot_t
      !> Contact, and which of its wires it is (1: barred); elements of this wire and of the other one
      integer :: contact = 0, side = 0, element = 0, other = 0
      !> Place in the element, and arc length along the wire [m]
      real(dp) :: xi = 0, arc = 0
      !> The spot before it on the same wire; 0: none
      integer :: before = 0
   end type spot_t

contains

   !> Pairs of contacts that are within reach of each other on a wire.
   subroutine collect_spots(model, wires, elements, pairs, xi, normal, resistance, is_line, feels_others, mutual)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Elements of each contact, barred first (2, n)
      integer, intent(in) :: pairs(:, :)
      !> Places in them (2, n); from the unbarred to the barred wire (3, n); of the spots (n) [ohm]
      real(dp), intent(in) :: xi(:, :), normal(:, :), resistance(:)
      !> The contact is a point of a line; its law asks for what others add (n)
      logical, intent(in) :: is_line(:), feels_others(:)
      type(mutual_resistances_t), intent(out) :: mutual
      type(spot_t), allocatable :: spots(:)
      integer :: last(wires%n_wires), n, i, side, k, pass

      allocate (spots(2*count(feels_others)))
      last = 0
      k = 0
      do i = 1, size(feels_others)
         if (.not. feels_others(i)) cycle
         do side = 1, 2
            k = k + 1
            associate (e => pairs(side, i), newest => last(wires%wire(pairs(side, i))))
               spots(k) = spot_t(i, side, e, pairs(3 - side, i), xi(side, i), &
                  arc_at(wires, elements, e, xi(side, i)), newest)
               newest = k
            end associate
         end do
      end do
      do pass = 1, 2
         n = 0
         do k = 1, size(spots)
            i = spots(k)%before
            do while (i > 0)
               if (are_near(spots(k), spots(i))) call add_pair(spots(k), spots(i))
               i = spots(i)%before
            end do
         end do
         if (pass == 1) allocate (mutual%contacts(2, n), mutual%resistance(n))
      end do

   contains

      !> Two spots of a wire are within reach. Strips beside each other are not spots, nor is a line a spot beside that
      !> of its own two wires.
      logical function are_near(a, b)
         type(spot_t), intent(in) :: a, b

         are_near = .false.
         if (a%contact == b%contact .or. all(is_line([a%contact, b%contact]))) return
         if (any(is_line([a%contact, b%contact])) .and. wires%wire(a%other) == wires%wire(b%other)) return
         are_near = wires%arc_between(wires%wire(a%element), a%arc, b%arc) < reach_of_spot*elements%radius(a%element)
      end function are_near

      subroutine add_pair(a, b)
         type(spot_t), intent(in) :: a, b

         n = n + 1
         if (pass == 1) return
         mutual%contacts(:, n) = [a%contact, b%contact]
         mutual%resistance(n) = resistance_between(model, wires, elements, a, b, &
            dot_product(normal(:, a%contact), normal(:, b%contact)), resistance([a%contact, b%contact]))
      end subroutine add_pair

   end subroutine collect_spots

   !> What a current through one spot adds to the voltage of the other one [ohm].
   pure real(dp) function resistance_between(model, wires, elements, a, b, cosine, alone) result(resistance)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(spot_t), intent(in) :: a, b
      !> Of the angle between their normals, and resistance of either (2) [ohm]
      real(dp), intent(in) :: cosine, alone(2)
      type(material_place_t) :: here, there
      real(dp) :: radius, resistivity, sense

      here = material_at(model, elements, a%element, a%xi)
      there = material_at(model, elements, b%element, b%xi)
      resistivity = (here%resistivity + there%resistivity)/2
      radius = elements%radius(a%element)
      ! the current leaves the barred wire and enters the unbarred one; normals point from the axis for one of both
      sense = real((2*a%side - 3)*(2*b%side - 3), dp)
      ! discs as large as their resistances, rho/(4 a) on either side, do not overlap
      resistance = sense*resistivity/radius*potential_beside_spot(sense*cosine, wires%arc_between( &
         wires%wire(a%element), a%arc, b%arc)/radius, resistivity/2*sum(1/alone)/radius)
      ! a resistance that is given may be below that of any spot on such a wire: (R + A) stays positive definite
      resistance = resistance*min(1.0_dp, sqrt(product(alone))*radius/resistivity)
   end function resistance_between

end module litz_spots_beside_spots
