!> Spots near each other on one wire: the current of each raises the potential at the others.
!>
!> Source: theory section 10, and J. A. Greenwood, Br. J. Appl. Phys. 17 (1966) 1621-1632: `rho I/(2 pi s)` at a
!> distance s that is small compared with the wire; farther away what the wire leaves of it above the mean of the
!> section, which conductors have.
module litz_spots_beside_spots
   use litz_kinds, only: dp
   use litz_element_library, only: elements_t, material_at, material_place_t
   use litz_model, only: model_t
   use litz_mutual_resistances, only: mutual_resistances_t
   use litz_spot_on_wire, only: potential_beside_spot, reach_of_spot
   use litz_wires, only: wires_t
   implicit none
   private
   public :: spot_t, collect_spots

   !> A contact on one of its wires.
   type :: spot_t
      !> Contact, and which of its wires it is (1: barred); element, and place in it
      integer :: contact = 0, side = 0, element = 0
      real(dp) :: xi = 0
      !> Arc length along the wire [m]; from the unbarred to the barred wire
      real(dp) :: arc = 0, normal(3) = 0
      !> Element of the other wire
      integer :: other = 0
      logical :: is_line = .false.
      !> Of the contact [ohm]
      real(dp) :: resistance = 0
   end type spot_t

contains

   !> Pairs of spots that are within reach of each other.
   subroutine collect_spots(model, wires, elements, spots, mutual)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Those that feel each other (n)
      type(spot_t), intent(in) :: spots(:)
      type(mutual_resistances_t), intent(out) :: mutual
      integer, allocatable :: first(:), members(:)
      integer :: n, wire, i, j, pass

      call list_by_wire(wires, spots, first, members)
      do pass = 1, 2
         n = 0
         do wire = 1, wires%n_wires
            do i = first(wire), first(wire + 1) - 1
               do j = first(wire), i - 1
                  associate (a => spots(members(i)), b => spots(members(j)))
                     if (are_near(wires, elements, a, b)) call add_pair(a, b)
                  end associate
               end do
            end do
         end do
         if (pass == 1) allocate (mutual%contacts(2, n), mutual%resistance(n))
      end do

   contains

      subroutine add_pair(a, b)
         type(spot_t), intent(in) :: a, b

         n = n + 1
         if (pass == 1) return
         mutual%contacts(:, n) = [a%contact, b%contact]
         mutual%resistance(n) = resistance_between(model, wires, elements, a, b)
      end subroutine add_pair

   end subroutine collect_spots

   !> The spots of each wire: `members(first(w):first(w + 1) - 1)`.
   pure subroutine list_by_wire(wires, spots, first, members)
      type(wires_t), intent(in) :: wires
      type(spot_t), intent(in) :: spots(:)
      !> (n_wires + 1), (spots)
      integer, allocatable, intent(out) :: first(:), members(:)
      integer :: next(wires%n_wires + 1), i

      allocate (first(wires%n_wires + 1), source=0)
      allocate (members(size(spots)))
      do i = 1, size(spots)
         associate (count => first(wires%wire(spots(i)%element) + 1))
            count = count + 1
         end associate
      end do
      first(1) = 1
      do i = 1, wires%n_wires
         first(i + 1) = first(i) + first(i + 1)
      end do
      next = first
      do i = 1, size(spots)
         associate (place => next(wires%wire(spots(i)%element)))
            members(place) = i
            place = place + 1
         end associate
      end do
   end subroutine list_by_wire

   !> Two spots of a wire are within reach. Strips beside each other are not spots, nor is a line a spot beside that of
   !> its own two wires.
   pure logical function are_near(wires, elements, a, b)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(spot_t), intent(in) :: a, b

      are_near = .false.
      if (a%contact == b%contact .or. (a%is_line .and. b%is_line)) return
      if (a%is_line .or. b%is_line) then
         if (wires%wire(a%other) == wires%wire(b%other)) return
      end if
      are_near = wires%arc_between(wires%wire(a%element), a%arc, b%arc) < reach_of_spot*elements%radius(a%element)
   end function are_near

   !> What a current through one spot adds to the voltage of the other one [ohm].
   pure real(dp) function resistance_between(model, wires, elements, a, b) result(resistance)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(spot_t), intent(in) :: a, b
      type(material_place_t) :: here, there
      real(dp) :: radius, resistivity, sense

      here = material_at(model, elements, a%element, a%xi)
      there = material_at(model, elements, b%element, b%xi)
      resistivity = (here%resistivity + there%resistivity)/2
      radius = elements%radius(a%element)
      ! the current leaves the barred wire and enters the unbarred one; normals point from the axis for one of both
      sense = real((2*a%side - 3)*(2*b%side - 3), dp)
      ! discs as large as their resistances, rho/(4 a) on either side, do not overlap
      resistance = sense*resistivity/radius*potential_beside_spot(sense*dot_product(a%normal, b%normal), &
         wires%arc_between(wires%wire(a%element), a%arc, b%arc)/radius, &
         resistivity/2*(1/a%resistance + 1/b%resistance)/radius)
      ! a resistance that is given may be below that of any spot on such a wire: (R + A) stays positive definite
      resistance = resistance*min(1.0_dp, sqrt(a%resistance*b%resistance)*radius/resistivity)
   end function resistance_between

end module litz_spots_beside_spots
