!> Strips side by side on one wire: the current of each raises the potential at the others.
!>
!> Source: theory section 10. Contacts along lines press into a wire where others do, in the same section of it. A
!> current `i` per length at the angle theta round the wire raises the potential of a strip above the mean of the
!> section by `(rho/pi) (1/8 - ln(2 sin(theta/2))) i`. The current of a point is spread over the two places of the wire
!> next to it, so that points of both passes come together.
!>
!> Strips of real wires resist more than what all others in their section add. Conductances that are given may be larger
!> than those of any strip: what is added in a section is then less in all of its pairs, so that the section by itself,
!> and with it all contacts together, takes up heat whatever the currents.
module litz_strips_of_wires
   use litz_kinds, only: dp, pi
   use litz_element_library, only: elements_t, material_at, material_place_t
   use litz_line_places, only: line_places_t, place_at
   use litz_model, only: model_t
   use litz_mutual_resistances, only: mutual_resistances_t
   use litz_symmetric_matrices, only: dsyev
   use litz_wires, only: wires_t
   implicit none
   private
   public :: collect_strips

   !> A contact at a place of one of its wires.
   type :: part_t
      !> Contact, and which of its wires it is (1: barred); the other wire
      integer :: contact = 0, side = 0, other = 0
      !> Part of the current that is there
      real(dp) :: share = 0
      !> Resistance of its constriction in this wire over the resistivity [1/m]; 0: nothing passes
      real(dp) :: own = 0
      !> The part before it at the same place; 0: none
      integer :: before = 0
   end type part_t

   !> Directions round a wire that are nearer to each other are one strip
   real(dp), parameter :: least_distance = 0.1_dp
   !> What all strips of a section add is at most this part of what they resist by themselves. Strips no wider than half
   !> a radius add up to 0.53 of it, where six wires lie round one of their own radius.
   real(dp), parameter :: most_of_own = 0.7_dp

contains

   subroutine collect_strips(model, wires, elements, places, pairs, xi, normal, is_line, own, strips)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(line_places_t), intent(in) :: places
      !> Elements of each contact, barred first (2, n)
      integer, intent(in) :: pairs(:, :)
      !> Places in them (2, n); from the unbarred to the barred wire (3, n)
      real(dp), intent(in) :: xi(:, :), normal(:, :)
      !> The contact is a point of a line (n)
      logical, intent(in) :: is_line(:)
      !> Resistances of the constrictions of each contact over the resistivity (2, n) [1/m]; 0: nothing passes
      real(dp), intent(in) :: own(:, :)
      type(mutual_resistances_t), intent(out) :: strips
      type(part_t), allocatable :: parts(:)
      integer, allocatable :: last(:)
      integer :: n_parts, i, side, n, place, a, b, pass, before

      allocate (parts(4*count(is_line)))
      allocate (last(size(places%xi)), source=0)
      n_parts = 0
      do i = 1, size(is_line)
         if (.not. is_line(i)) cycle
         do side = 1, 2
            call add_parts(pairs(side, i), xi(side, i), part_t(i, side, wires%wire(pairs(3 - side, i)), &
               own=own(side, i)))
         end do
      end do
      do pass = 1, 2
         n = 0
         do place = 1, size(last)
            before = n
            a = last(place)
            do while (a > 0)
               b = parts(a)%before
               do while (b > 0)
                  if (parts(a)%other /= parts(b)%other) call add_pair(parts(a), parts(b), place)
                  b = parts(b)%before
               end do
               a = parts(a)%before
            end do
            if (pass == 2 .and. n > before) call limit_section(parts, last(place), before, strips)
         end do
         if (pass == 1) allocate (strips%contacts(2, n), strips%sides(2, n), strips%resistance(n), &
            strips%shape(n), strips%nodes(4, n), strips%by_temperature(4, n))
      end do
      strips%is_spot = spread(.false., 1, n)

   contains

      !> Spread a point over the places next to it.
      subroutine add_parts(e, xi, part)
         !> Element
         integer, intent(in) :: e
         !> Place in it
         real(dp), intent(in) :: xi
         type(part_t), intent(in) :: part
         real(dp) :: u
         integer :: k

         u = (1 + max(-1.0_dp, min(1.0_dp, xi)))/2*places%n_parts(e)
         k = min(int(u), places%n_parts(e) - 1)
         call add_part(place_at(places, e, k), k + 1 - u, part)
         call add_part(place_at(places, e, k + 1), u - k, part)
      end subroutine add_parts

      subroutine add_part(place, share, part)
         !> Its number
         integer, intent(in) :: place
         !> Of the current
         real(dp), intent(in) :: share
         type(part_t), intent(in) :: part

         if (.not. share > 0) return
         n_parts = n_parts + 1
         parts(n_parts) = part
         parts(n_parts)%share = share
         parts(n_parts)%before = last(place)
         last(place) = n_parts
      end subroutine add_part

      !> Two strips at a place of a wire.
      subroutine add_pair(a, b, place)
         type(part_t), intent(in) :: a, b
         !> Its number
         integer, intent(in) :: place
         type(material_place_t) :: there
         real(dp) :: apart

         n = n + 1
         if (pass == 1) return
         ! from the axis to the strip; the chord between both is 2 sin(theta/2)
         apart = norm2((2*a%side - 3)*normal(:, a%contact) - (2*b%side - 3)*normal(:, b%contact))
         there = material_at(model, elements, places%element(place), places%xi(place))
         strips%contacts(:, n) = [a%contact, b%contact]
         strips%sides(:, n) = [a%side, b%side]
         strips%shape(n) = a%share*b%share/places%length(place)/pi*(0.125_dp - log(max(apart, least_distance)))
         ! the current leaves the barred wire and enters the unbarred one
         associate (shape => (2*a%side - 3)*(2*b%side - 3)*strips%shape(n), xi => places%xi(place))
            strips%resistance(n) = shape*there%resistivity
            strips%nodes(:, n) = [model%connectivity(:, places%element(place)), &
               model%connectivity(:, places%element(place))]
            strips%by_temperature(:, n) = shape*there%dresistivity*[1 - xi, 1 + xi, 0.0_dp, 0.0_dp]/2
         end associate
      end subroutine add_pair

   end subroutine collect_strips

   !> What the strips of a section add to each other is at most a part of what they resist: the forms of both, for any
   !> currents of the parts that enter there.
   subroutine limit_section(parts, last, before, strips)
      !> Of all places
      type(part_t), intent(in) :: parts(:)
      !> The last part at this place, and how many pairs are before those of this place
      integer, intent(in) :: last, before
      type(mutual_resistances_t), intent(inout) :: strips
      integer, allocatable :: members(:)
      real(dp), allocatable :: added(:, :), eigenvalues(:), work(:)
      real(dp) :: own, limit
      integer :: i, j, k, info

      allocate (members(0))
      i = last
      do while (i > 0)
         members = [members, i]
         i = parts(i)%before
      end do
      allocate (added(size(members), size(members)), source=0.0_dp)
      k = before
      do i = 1, size(members)
         do j = i + 1, size(members)
            associate (a => parts(members(i)), b => parts(members(j)))
               if (a%other == b%other) cycle
               k = k + 1
               own = sqrt(a%share*a%own*b%share*b%own)
               if (own > 0) added(i, j) = strips%shape(k)/own
            end associate
            added(j, i) = added(i, j)
         end do
      end do
      ! no eigenvalue is larger than the largest sum of a row
      if (.not. maxval(sum(abs(added), 1)) > most_of_own) return
      allocate (eigenvalues(size(members)), work(3*size(members)))
      call dsyev('N', 'U', size(members), added, size(members), eigenvalues, work, size(work), info)
      ! without a diagonal, so that the lowest eigenvalue is negative
      limit = most_of_own/max(most_of_own, -eigenvalues(1))
      strips%shape(before + 1:k) = limit*strips%shape(before + 1:k)
      strips%resistance(before + 1:k) = limit*strips%resistance(before + 1:k)
      strips%by_temperature(:, before + 1:k) = limit*strips%by_temperature(:, before + 1:k)
   end subroutine limit_section

end module litz_strips_of_wires
