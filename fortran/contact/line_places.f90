!> Places on the wires at which contact along lines is felt: material points.
!>
!> They divide the elements evenly into parts that are short beside the radius of the thinnest wire, so that every
!> overlap that is not the matter of a crossing is resolved, however long the elements are. A place at a node belongs to
!> both of its elements and is one of them only; the end of a wire has one. Source: theory section 10.
module litz_line_places
   use litz_kinds, only: dp
   use litz_wires, only: wires_t
   implicit none
   private
   public :: line_places_t, prepare_line_places, place_at, spacing_of_places, resolved_by_places, resolved_at_ends

   !> Evenly spaced places resolve an overlap as those of Lobatto's rule at this part of their distance do
   real(dp), parameter :: resolution = 0.65_dp
   !> Longest part of an element, in radii; the fewest and the most parts of an element
   real(dp), parameter :: longest_part = 0.4_dp
   !> A multiple of that stays one whatever round-off a rotation of the model leaves
   real(dp), parameter :: round_off = 1.0e-9_dp
   integer, parameter :: fewest_parts = 2, most_parts = 1000

   type :: line_places_t
      !> Element of each place, its place in it, and the reference length for which it stands (n) [-, m]
      integer, allocatable :: element(:)
      real(dp), allocatable :: xi(:), length(:)
      !> Parts of each element; its first place, those within it first; and its last one (n_elements)
      integer, allocatable :: n_parts(:), first(:), last(:)
      !> Those at the ends of each element, which may be of a neighbour (2, n_elements)
      integer, allocatable :: at_end(:, :)
   end type line_places_t

contains

   subroutine prepare_line_places(wires, length, thinnest, places)
      type(wires_t), intent(in) :: wires
      !> Reference lengths of the elements (n_elements) [m]
      real(dp), intent(in) :: length(:)
      !> Least radius of the wires that may touch [m]; 0: none may
      real(dp), intent(in) :: thinnest
      type(line_places_t), intent(out) :: places
      integer :: e, n, next

      n = size(length)
      allocate (places%n_parts(n), source=fewest_parts)
      if (thinnest > 0) places%n_parts = max(fewest_parts, ceiling(min((1 - round_off)*length &
         /(longest_part*thinnest), real(most_parts, dp))))
      allocate (places%first(n), places%last(n))
      allocate (places%at_end(2, n), source=0)
      next = sum(places%n_parts) + n
      allocate (places%element(next), places%xi(next), places%length(next))
      next = 0
      do e = 1, n
         call add_places(wires, length, e, places, next)
      end do
      places%element = places%element(:next)
      places%xi = places%xi(:next)
      places%length = places%length(:next)
   end subroutine prepare_line_places

   !> The places of an element: within it, and at those of its ends that are its own.
   subroutine add_places(wires, length, e, places, next)
      type(wires_t), intent(in) :: wires
      !> (n_elements) [m]
      real(dp), intent(in) :: length(:)
      !> Element
      integer, intent(in) :: e
      type(line_places_t), intent(inout) :: places
      !> The last place so far
      integer, intent(inout) :: next
      integer :: i, side

      places%first(e) = next + 1
      associate (n => places%n_parts(e))
         do i = 1, n - 1
            call add(-1 + 2*real(i, dp)/n, length(e)/n)
         end do
      end associate
      do side = 1, 2
         associate (other => wires%next(side, e))
            ! the first element along a wire has both of its ends, any other one the end that lies further on
            if (other == 0) then
               call add(2.0_dp*side - 3, end_length(e))
               places%at_end(side, e) = next
            else if ((2*side - 3)*wires%direction(e) > 0) then
               call add(2.0_dp*side - 3, end_length(e) + end_length(other))
               places%at_end(side, e) = next
               places%at_end(merge(3 - side, side, wires%direction(e) == wires%direction(other)), other) = next
            end if
         end associate
      end do
      places%last(e) = next

   contains

      subroutine add(xi, weight)
         !> Place in the element, and the length for which it stands [m]
         real(dp), intent(in) :: xi, weight

         next = next + 1
         places%element(next) = e
         places%xi(next) = xi
         places%length(next) = weight
      end subroutine add

      !> What an end of an element stands for of it [m].
      pure real(dp) function end_length(element)
         !> Its number
         integer, intent(in) :: element

         end_length = 0.5_dp*length(element)/places%n_parts(element)
      end function end_length

   end subroutine add_places

   !> A place by its number along an element, from 0 at its first end to `n_parts` at its second one.
   pure integer function place_at(places, e, i) result(place)
      type(line_places_t), intent(in) :: places
      !> Element
      integer, intent(in) :: e
      !> Number
      integer, intent(in) :: i

      if (i <= 0) then
         place = places%at_end(1, e)
      else if (i >= places%n_parts(e)) then
         place = places%at_end(2, e)
      else
         place = places%first(e) + i - 1
      end if
   end function place_at

   !> Distance of neighbouring places on two elements, the greater one [m].
   pure real(dp) function spacing_of_places(places, pair, length)
      type(line_places_t), intent(in) :: places
      !> Two elements (2)
      integer, intent(in) :: pair(2)
      !> Their reference lengths (2) [m]
      real(dp), intent(in) :: length(2)

      spacing_of_places = maxval(length/places%n_parts(pair))
   end function spacing_of_places

   !> Spacing of Lobatto's rule that tells how long an overlap places carry [m].
   pure real(dp) function resolved_by_places(places, pair, length) result(spacing)
      type(line_places_t), intent(in) :: places
      !> Two elements (2)
      integer, intent(in) :: pair(2)
      !> Their reference lengths (2) [m]
      real(dp), intent(in) :: length(2)

      spacing = resolution*spacing_of_places(places, pair, length)
   end function resolved_by_places

   !> The same of overlaps that ends or joints cut: as with the longest parts of elements on any mesh, and whatever
   !> other wires there are, as the spot of a round end is none of a line.
   pure real(dp) function resolved_at_ends(places, pair, length, radius) result(spacing)
      type(line_places_t), intent(in) :: places
      !> Two elements (2)
      integer, intent(in) :: pair(2)
      !> Their reference lengths and radii (2) [m]
      real(dp), intent(in) :: length(2), radius(2)

      spacing = max(resolved_by_places(places, pair, length), resolution*longest_part*minval(radius))
   end function resolved_at_ends

end module litz_line_places
