!> The crossings of each two wires, in order along them, so that those near a place are found without a look at all.
!>
!> Each crossing is there twice, along either of its wires; one at or near a joint along each of the wires that meet
!> there.
module litz_crossings_of_wires
   use litz_kinds, only: dp, pi
   use litz_contact_points, only: contact_point_t, leg_t, is_contact_of
   use litz_lens_law, only: smooth_step
   use litz_wires, only: wires_t
   implicit none
   private
   public :: crossings_of_wires_t, sort_crossings

   !> Distance of two lenses, in the sum of their half lengths, at which they begin to be one overlap, and at which they
   !> are: where distance goes in waves, with the lenses of their curvature at the deepest places, pi/2 as waves close
   !> altogether. At pi they overlap over a third of their length, and the force of a lens is within 3 % of theirs
   real(dp), parameter :: begin_to_touch = pi, one_overlap = pi/2
   !> The same of overlaps that begin at the ends of wires, of which one is bent over the other: their lengths are those
   !> up to where the wires part, so that what lies between them closes at 1
   real(dp), parameter :: ends_begin_to_touch = 1.25_dp, one_lap = 1
   !> Nearer than this they are two deepest places of one lens
   real(dp), parameter :: one_lens = 0.2_dp
   !> Part of the overlap of a crossing that makes it one with another one in full: of a third of its force
   real(dp), parameter :: as_deep = 0.5_dp

   type :: crossing_on_wire_t
      !> Wire, the other one, and the arc length along the first [m], by which they are in order; that along the other
      integer :: own = 0, other = 0
      real(dp) :: arc = 0, arc_other = 0
      !> Number of the crossing, and whether its barred wire is `other`
      integer :: crossing = 0
      logical :: is_turned = .false.
      !> At a joint, or beyond one: which of its legs lie on the barred and on the unbarred wire (2)
      integer :: legs(2) = 0
      !> The crossing is not on both wires, but near a joint beyond which its lens goes on along them
      logical :: is_beyond = .false.
   end type crossing_on_wire_t

   type :: crossings_of_wires_t
      type(crossing_on_wire_t), allocatable, private :: list(:)
   contains
      procedure :: find_nearest
      procedure :: mark_common_lenses
   end type crossings_of_wires_t

contains

   pure type(crossings_of_wires_t) function sort_crossings(wires, crossings) result(sorted)
      type(wires_t), intent(in) :: wires
      type(contact_point_t), intent(in) :: crossings(:)
      integer :: i, n, bar, unbarred

      allocate (sorted%list(2*sum([(n_entries(crossings(i)), i=1, size(crossings))])))
      n = 0
      do i = 1, size(crossings)
         if (.not. any(crossings(i)%held)) then
            call add(crossings(i)%element_bar, crossings(i)%element, crossings(i)%arc_bar, crossings(i)%arc, [0, 0], n)
            if (.not. allocated(crossings(i)%legs)) cycle
         end if
         associate (legs => crossings(i)%legs)
            do bar = 1, size(legs)
               do unbarred = 1, size(legs)
                  if (counts_on(crossings(i), legs(bar), legs(unbarred))) call add(legs(bar)%element, &
                     legs(unbarred)%element, legs(bar)%arc, legs(unbarred)%arc, [bar, unbarred], n)
               end do
            end do
         end associate
      end do
      call merge_sort(sorted%list)

   contains

      !> Along both wires.
      pure subroutine add(element_bar, element, arc_bar, arc, legs, n)
         !> Barred and unbarred element
         integer, intent(in) :: element_bar, element
         !> Arc lengths along their wires [m]
         real(dp), intent(in) :: arc_bar, arc
         !> Of the barred and the unbarred wire (2)
         integer, intent(in) :: legs(2)
         !> Entries so far
         integer, intent(inout) :: n
         logical :: is_beyond

         associate (wire_bar => wires%wire(element_bar), wire => wires%wire(element))
            is_beyond = any(legs > 0) .and. .not. any(crossings(i)%held)
            sorted%list(n + 1) = crossing_on_wire_t(wire_bar, wire, arc_bar, arc, i, .false., legs, is_beyond)
            sorted%list(n + 2) = crossing_on_wire_t(wire, wire_bar, arc, arc_bar, i, .true., legs, is_beyond)
         end associate
         n = n + 2
      end subroutine add

   end function sort_crossings

   !> Two legs are a pair of wires along which a crossing has an entry of its own: at a joint where it is, or beyond one
   !> that is near.
   elemental logical function counts_on(crossing, bar, leg)
      type(contact_point_t), intent(in) :: crossing
      !> Of the barred and of the unbarred wire
      type(leg_t), intent(in) :: bar, leg

      counts_on = is_contact_of(bar, leg)
      if (.not. any(crossing%held)) counts_on = bar%side == 1 .and. leg%side == 2 .and. .not. counts_on
   end function counts_on

   !> How many pairs of wires a crossing is one of.
   pure integer function n_entries(crossing)
      type(contact_point_t), intent(in) :: crossing
      integer :: i

      n_entries = merge(0, 1, any(crossing%held))
      if (.not. allocated(crossing%legs)) return
      do i = 1, size(crossing%legs)
         n_entries = n_entries + count(counts_on(crossing, crossing%legs(i), crossing%legs))
      end do
   end function n_entries

   !> Source: merge sort from the bottom up, O(n log n).
   pure subroutine merge_sort(list)
      type(crossing_on_wire_t), allocatable, intent(inout) :: list(:)
      type(crossing_on_wire_t), allocatable :: merged(:)
      integer :: width, first

      width = 1
      do while (width < size(list))
         allocate (merged(size(list)))
         do first = 1, size(list), 2*width
            associate (middle => min(first + width, size(list) + 1), end => min(first + 2*width, size(list) + 1))
               merged(first:end - 1) = merge_of(list(first:middle - 1), list(middle:end - 1))
            end associate
         end do
         call move_alloc(merged, list)
         width = 2*width
      end do
   end subroutine merge_sort

   pure function merge_of(a, b) result(merged)
      !> Each in order
      type(crossing_on_wire_t), intent(in) :: a(:), b(:)
      type(crossing_on_wire_t) :: merged(size(a) + size(b))
      integer :: i, j, k

      i = 1
      j = 1
      do k = 1, size(merged)
         if (comes_from_a()) then
            merged(k) = a(i)
            i = i + 1
         else
            merged(k) = b(j)
            j = j + 1
         end if
      end do

   contains

      pure logical function comes_from_a()
         comes_from_a = i <= size(a)
         if (i <= size(a) .and. j <= size(b)) comes_from_a = .not. is_before(b(j), a(i)%own, a(i)%other, a(i)%arc)
      end function comes_from_a

   end function merge_of

   pure logical function is_before(item, own, other, arc)
      type(crossing_on_wire_t), intent(in) :: item
      !> A wire and the other one
      integer, intent(in) :: own, other
      !> Arc length along the first [m]
      real(dp), intent(in) :: arc

      is_before = item%own < own
      if (item%own /= own) return
      is_before = item%other < other
      if (item%other /= other) return
      is_before = item%arc < arc
   end function is_before

   !> The first of the list that does not come before a place.
   pure integer function first_at(self, own, other, arc) result(first)
      class(crossings_of_wires_t), intent(in) :: self
      !> A wire and the other one
      integer, intent(in) :: own, other
      !> Arc length along the first [m]
      real(dp), intent(in) :: arc
      integer :: last, middle

      first = 1
      last = size(self%list) + 1
      do while (first < last)
         middle = (first + last)/2
         if (is_before(self%list(middle), own, other, arc)) then
            first = middle + 1
         else
            last = middle
         end if
      end do
   end function first_at

   !> The crossing of the same two wires that is nearest to a point of a line contact; 0: none within reach.
   pure subroutine find_nearest(self, wires, reach, reach_of_foot, point, nearest, least, legs)
      class(crossings_of_wires_t), intent(in) :: self
      type(wires_t), intent(in) :: wires
      !> Along the wire of the place, and along that of the foot [m]
      real(dp), intent(in) :: reach, reach_of_foot
      type(contact_point_t), intent(in) :: point
      !> Its number
      integer, intent(out) :: nearest
      !> Its distance along the wire of the place [m]
      real(dp), intent(out) :: least
      !> At or beyond a joint: its legs that are these wires, barred first (2)
      integer, intent(out) :: legs(2)
      real(dp) :: distance, beyond
      integer :: own, other, i
      logical :: is_turned

      nearest = 0
      legs = 0
      least = reach
      is_turned = .false.
      own = wires%wire(point%element)
      other = wires%wire(point%element_bar)
      ! round-off of arc lengths is no matter; around a closed wire all are looked at
      beyond = merge(huge(beyond), 1.001_dp*reach, wires%circumference(own) > 0)
      do i = first_at(self, own, other, point%arc - beyond), size(self%list)
         associate (item => self%list(i))
            if (item%own /= own .or. item%other /= other .or. item%arc > point%arc + beyond) exit
            distance = wires%arc_between(own, point%arc, item%arc)
            if (distance > least) cycle
            if (wires%arc_between(other, point%arc_bar, item%arc_other) > reach_of_foot) cycle
            ! of equally near ones the last of those whose barred wire is the other one, or else the last
            if (nearest > 0 .and. .not. distance < least) then
               if (item%is_turned .eqv. is_turned) then
                  if (item%crossing < nearest) cycle
               else if (is_turned) then
                  cycle
               end if
            end if
            least = distance
            nearest = item%crossing
            legs = item%legs
            is_turned = item%is_turned
         end associate
      end do
   end subroutine find_nearest

   !> Crossings of the same two wires whose lenses reach into each other become one overlap with ripples.
   pure subroutine mark_common_lenses(self, wires, half_length, crossings)
      class(crossings_of_wires_t), intent(in) :: self
      type(wires_t), intent(in) :: wires
      !> aW [m]; 0: no lens (n_crossings)
      real(dp), intent(in) :: half_length(:)
      type(contact_point_t), intent(inout) :: crossings(:)
      real(dp) :: together, apart, touch, longest, limits(2)
      integer :: i, k

      longest = maxval([0.0_dp, half_length])
      do i = 1, size(self%list)
         associate (a => self%list(i))
            if (a%is_turned .or. a%is_beyond .or. .not. half_length(a%crossing) > 0) cycle
            do k = i + 1, size(self%list)
               associate (b => self%list(k))
                  if (b%own /= a%own .or. b%other /= a%other) exit
                  if (wires%circumference(a%own) <= 0 .and. b%arc - a%arc > begin_to_touch*1.001_dp &
                     *(half_length(a%crossing) + longest)) exit
                  if (b%is_beyond) cycle
                  if (b%is_turned .or. b%crossing == a%crossing .or. .not. half_length(b%crossing) > 0) cycle
                  together = half_length(a%crossing) + half_length(b%crossing)
                  apart = max(wires%arc_between(a%own, a%arc, b%arc), wires%arc_between(a%other, a%arc_other, &
                     b%arc_other))
                  limits = merge([ends_begin_to_touch, one_lap], [begin_to_touch, one_overlap], &
                     any(crossings(a%crossing)%held) .and. any(crossings(b%crossing)%held))
                  touch = smooth_step((limits(1) - apart/together)/(limits(1) - limits(2))) &
                     *smooth_step(apart/(one_lens*together))
                  call add_ripple(crossings(b%crossing)%gap, touch, crossings(a%crossing))
                  call add_ripple(crossings(a%crossing)%gap, touch, crossings(b%crossing))
               end associate
            end do
         end associate
      end do
   end subroutine mark_common_lenses

   !> The lens of a crossing is the longer an overlap the more the next one touches it, as far as that is as deep.
   elemental subroutine add_ripple(gap_of_other, touch, crossing)
      !> Of the other crossing [m], and how much the two lenses touch, between 0 and 1
      real(dp), intent(in) :: gap_of_other, touch
      type(contact_point_t), intent(inout) :: crossing

      crossing%long_share = max(crossing%long_share, touch*smooth_step(gap_of_other/(as_deep*crossing%gap)))
   end subroutine add_ripple

end module litz_crossings_of_wires
