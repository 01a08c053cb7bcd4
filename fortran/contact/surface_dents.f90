!> What an element of metal that yields remembers of a rigid surface, and where it presses on it.
!>
!> Source: theory section 15. Metal remembers its largest overlap. It is kept at places that are evenly spread over the
!> part of the element that has touched, and is a cubic between them; it is negative where wire and surface have only
!> been near each other. The force per length that it has made, and the dent, are those of the law at this overlap.
module litz_surface_dents
   use litz_kinds, only: dp
   use litz_rigid_surface, only: rigid_surface_t
   use litz_surface_overlap, only: surface_overlap_t, gap_at
   use litz_yielding_line, only: yielding_line_t, line_dent_t, line_dent, line_state_t, line_state_at_force, &
      line_state_at_overlap
   use litz_yielding_spot, only: yielding_t, dent_t, dent_of_force, yielding_state_t, state_at_overlap
   implicit none
   private
   public :: surface_dents_t, yielding_element_t, n_of_dents, numbers_of_dents, dents_of_numbers
   public :: find_depths, dent_at, dent_of_end, depth_of_dents, dents_after, pressing_pieces

   !> Places of the memory
   integer, parameter :: n_places = 33
   !> What the memory has beyond the part that has touched, in lengths of that part: a contact that grows steadily takes
   !> other places rarely
   real(dp), parameter :: margin = 0.1_dp
   !> Numbers of the memory
   integer, parameter :: n_of_dents = n_places + 6
   !> Places at which a part that overlaps is looked at, and halvings of their distance
   integer, parameter :: n_grid = 33, n_halvings = 45
   !> Part of the deepest overlap by which the present one differs from the largest one, where it does
   real(dp), parameter :: same = 1.0e-6_dp
   !> Overlaps beyond which the law is another one: where wire and surface part, the largest so far, and that at which
   !> metal yields or has yielded
   integer, parameter :: of_dent = 1, of_largest = 2, of_onset = 3, n_levels = 3

   !> All 0: the element has not touched.
   type :: surface_dents_t
      !> Part of the element with a memory; it is empty where both are the same
      real(dp) :: first = 0, last = 0
      !> Largest overlap at its places (n_places), and of the round ends (2) [m]
      real(dp) :: deepest(n_places) = 0, end_deepest(2) = 0
      !> Largest force of all so far [N], and work that yielding has dissipated [J]
      real(dp) :: largest_force = 0, dissipation = 0
   end type surface_dents_t

   !> The laws of an element that yields, with its present memory.
   type :: yielding_element_t
      !> .false.: it is elastic
      logical :: yields = .false.
      type(yielding_line_t) :: strip
      type(yielding_t) :: ends(2)
      !> Overlap beyond which metal yields along the wire [m]
      real(dp) :: onset = 0
      !> Overlap at which wire and surface part, at the places of the memory (n_places) [m], once it is known
      real(dp) :: depth(n_places) = 0
      logical :: has_depths = .false.
   end type yielding_element_t

   !> Where a part of an element is looked at.
   type :: sight_t
      type(rigid_surface_t) :: surface
      !> Axis in powers of xi (3, 0:3) [m], and radius [m]
      real(dp) :: p(3, 0:3) = 0, radius = 0
      type(surface_dents_t) :: dents
      !> Those of `yielding_element_t`
      real(dp) :: depth(n_places) = 0, onset = 0
   end type sight_t

contains

   !> The memory as numbers.
   pure function numbers_of_dents(dents) result(numbers)
      type(surface_dents_t), intent(in) :: dents
      real(dp) :: numbers(n_of_dents)

      numbers = [dents%first, dents%last, dents%deepest, dents%end_deepest, dents%largest_force, dents%dissipation]
   end function numbers_of_dents

   !> The memory that numbers were made of.
   pure type(surface_dents_t) function dents_of_numbers(numbers) result(dents)
      !> (n_of_dents)
      real(dp), intent(in) :: numbers(:)

      dents%first = numbers(1)
      dents%last = numbers(2)
      dents%deepest = numbers(3:n_places + 2)
      dents%end_deepest = numbers(n_places + 3:n_places + 4)
      dents%largest_force = numbers(n_places + 5)
      dents%dissipation = numbers(n_places + 6)
   end function dents_of_numbers

   !> What depends on law and memory alone; it takes long enough to be found where it is needed only.
   pure subroutine find_depths(dents, law)
      type(surface_dents_t), intent(in) :: dents
      type(yielding_element_t), intent(inout) :: law
      type(line_state_t) :: state
      type(line_dent_t) :: dent
      integer :: i

      if (law%has_depths) return
      law%has_depths = .true.
      state = line_state_at_force(law%strip, line_dent_t(), law%strip%onset)
      law%onset = state%overlap
      do i = 1, n_places
         dent = dent_of_overlap(law, dents%deepest(i))
         law%depth(i) = dent%depth
      end do
   end subroutine find_depths

   !> The dent of the largest overlap.
   pure type(line_dent_t) function dent_of_overlap(law, deepest) result(dent)
      type(yielding_element_t), intent(in) :: law
      !> [m]
      real(dp), intent(in) :: deepest
      type(line_state_t) :: made

      if (.not. deepest > law%onset) return
      made = line_state_at_overlap(law%strip, line_dent_t(), deepest)
      dent = line_dent(law%strip, made%force)
   end function dent_of_overlap

   !> The dent at a place of the element.
   pure type(line_dent_t) function dent_at(dents, law, xi) result(dent)
      type(surface_dents_t), intent(in) :: dents
      type(yielding_element_t), intent(in) :: law
      !> In the element
      real(dp), intent(in) :: xi

      dent = dent_of_overlap(law, at_place(dents, dents%deepest, xi))
   end function dent_at

   !> The dent of a round end.
   pure type(dent_t) function dent_of_end(dents, law, end) result(dent)
      type(surface_dents_t), intent(in) :: dents
      type(yielding_element_t), intent(in) :: law
      !> 1 or 2
      integer, intent(in) :: end
      type(yielding_state_t) :: made

      if (.not. dents%end_deepest(end) > 0) return
      made = state_at_overlap(law%ends(end), dent_t(), dents%end_deepest(end))
      dent = dent_of_force(law%ends(end), made%force)
   end function dent_of_end

   !> The deepest dent of all [m].
   pure real(dp) function depth_of_dents(dents, law, has_end) result(depth)
      type(surface_dents_t), intent(in) :: dents
      type(yielding_element_t), intent(in) :: law
      !> (2)
      logical, intent(in) :: has_end(2)
      type(dent_t) :: dent
      integer :: end

      depth = maxval(law%depth)
      do end = 1, 2
         if (.not. has_end(end)) cycle
         dent = dent_of_end(dents, law, end)
         depth = max(depth, dent%depth)
      end do
   end function depth_of_dents

   !> A quantity of the places, between them; 0 beyond them, and where it is negative.
   pure real(dp) function at_place(dents, values, xi) result(value)
      type(surface_dents_t), intent(in) :: dents
      !> (n_places), and where it is asked for
      real(dp), intent(in) :: values(:), xi
      real(dp) :: t
      integer :: i

      value = 0
      if (xi < dents%first .or. xi > dents%last .or. .not. dents%last > dents%first) return
      t = (xi - dents%first)/(dents%last - dents%first)*(n_places - 1)
      ! Lagrange's cubic through the four places about it
      i = min(max(int(t), 1), n_places - 3)
      t = t - (i - 1)
      value = ((t - 1)*((t - 2)*(t*values(i + 3) - (t - 3)*values(i))) &
         + 3*t*((t - 3)*((t - 2)*values(i + 1) - (t - 1)*values(i + 2))))/6
      value = max(value, 0.0_dp)
   end function at_place

   !> The memory after an increment that has converged.
   pure type(surface_dents_t) function dents_after(before, surface, p, radius, overlap) result(dents)
      type(surface_dents_t), intent(in) :: before
      type(rigid_surface_t), intent(in) :: surface
      !> Axis in powers of xi (3, 0:3) [m], and radius [m]
      real(dp), intent(in) :: p(3, 0:3), radius
      type(surface_overlap_t), intent(in) :: overlap
      real(dp) :: xi, gap, unused_slope
      integer :: i

      dents = before
      if (overlap%n == 0) return
      associate (from => overlap%first(1), to => overlap%last(overlap%n))
         if (.not. before%last > before%first) then
            dents%first = max(-1.0_dp, from - margin*(to - from))
            dents%last = min(1.0_dp, to + margin*(to - from))
         else
            if (from < before%first) dents%first = max(-1.0_dp, from - margin*(before%last - from))
            if (to > before%last) dents%last = min(1.0_dp, to + margin*(to - dents%first))
         end if
      end associate
      do i = 1, n_places
         xi = dents%first + (dents%last - dents%first)*real(i - 1, dp)/(n_places - 1)
         call gap_at(surface, p, radius, xi, gap, unused_slope)
         dents%deepest(i) = -gap
         if (abs(dents%first - before%first) + abs(dents%last - before%last) > 0) then
            dents%deepest(i) = max(-gap, at_place(before, before%deepest, xi))
         else
            dents%deepest(i) = max(-gap, before%deepest(i))
         end if
      end do
      do i = 1, 2
         call gap_at(surface, p, radius, 2.0_dp*i - 3, gap, unused_slope)
         dents%end_deepest(i) = max(-gap, before%end_deepest(i))
      end do
   end function dents_after

   !> The pieces of the parts that overlap in which the wire presses, from end to end (2, n): the force changes smoothly
   !> along each.
   function pressing_pieces(overlap, surface, p, radius, dents, law) result(pieces)
      type(surface_overlap_t), intent(in) :: overlap
      type(rigid_surface_t), intent(in) :: surface
      !> Axis in powers of xi (3, 0:3) [m], and radius [m]
      real(dp), intent(in) :: p(3, 0:3), radius
      type(surface_dents_t), intent(in) :: dents
      type(yielding_element_t), intent(in) :: law
      real(dp), allocatable :: pieces(:, :), edges(:)
      type(sight_t) :: sight
      integer :: part, i

      allocate (pieces(2, 0))
      sight = sight_t(surface, p, radius, dents, law%depth, law%onset)
      do part = 1, overlap%n
         edges = [overlap%first(part), overlap%last(part)]
         if (max(-overlap%gap, maxval(dents%deepest)) > law%onset) edges = divided(sight, edges)
         do i = 2, size(edges)
            associate (middle => (edges(i - 1) + edges(i))/2)
               if (.not. excess(sight, middle, of_dent) > 0) cycle
            end associate
            pieces = reshape([pieces, edges(i - 1:i)], [2, size(pieces, 2) + 1])
         end do
      end do
   end function pressing_pieces

   !> Ends of a part, and where the law changes in between.
   function divided(sight, part) result(edges)
      type(sight_t), intent(in) :: sight
      !> First and last place (2)
      real(dp), intent(in) :: part(2)
      real(dp), allocatable :: edges(:)
      real(dp) :: place(n_grid), value(n_grid), vertex
      integer :: level, i

      place = [(part(1) + (part(2) - part(1))*real(i - 1, dp)/(n_grid - 1), i=1, n_grid)]
      edges = part
      do level = n_levels, 1, -1
         value = [(excess(sight, place(i), level), i=1, n_grid)]
         call add_changes(merge(same*maxval(abs(sight%dents%deepest)), 0.0_dp, level == of_largest))
      end do
      ! what presses, or does not, between two places only
      do i = 2, n_grid - 1
         if (.not. turns(value(i - 1:i + 1))) cycle
         associate (step => place(2) - place(1), bend => value(i - 1) - 2*value(i) + value(i + 1))
            vertex = place(i) - step*(value(i + 1) - value(i - 1))/(2*bend)
         end associate
         if (excess(sight, vertex, of_dent)*value(i) >= 0) cycle
         edges = [edges, change(sight, of_dent, place(i - 1), vertex), change(sight, of_dent, vertex, place(i + 1))]
      end do
      call put_in_order(edges)

   contains

      !> Changes of sign from place to place.
      subroutine add_changes(band)
         !> Values that are as good as 0 [m]
         real(dp), intent(in) :: band
         integer :: k, before

         before = 0
         do k = 1, n_grid
            if (abs(value(k)) <= band) cycle
            if (before > 0) then
               if (value(k)*value(before) < 0) edges = [edges, change(sight, level, place(before), place(k))]
            end if
            before = k
         end do
      end subroutine add_changes

   end function divided

   !> Ascending, by insertion: there are few.
   pure subroutine put_in_order(values)
      !> (n)
      real(dp), intent(inout) :: values(:)
      integer :: i, k

      do i = 2, size(values)
         k = count(values(:i - 1) <= values(i))
         values(k + 1:i) = [values(i), values(k + 1:i - 1)]
      end do
   end subroutine put_in_order

   !> Three values of one sign of which the middle one is nearest to 0.
   pure logical function turns(values)
      !> (3)
      real(dp), intent(in) :: values(:)

      turns = all(values > 0) .or. all(values < 0)
      turns = turns .and. abs(values(2)) <= min(abs(values(1)), abs(values(3))) .and. &
         abs(values(1) - 2*values(2) + values(3)) > 0
   end function turns

   !> Overlap at a place beyond a level [m].
   pure real(dp) function excess(sight, xi, level)
      type(sight_t), intent(in) :: sight
      !> In the element
      real(dp), intent(in) :: xi
      !> Of the constants above
      integer, intent(in) :: level
      real(dp) :: gap, unused_slope

      call gap_at(sight%surface, sight%p, sight%radius, xi, gap, unused_slope)
      select case (level)
      case (of_dent)
         excess = -gap - at_place(sight%dents, sight%depth, xi)
      case (of_largest)
         excess = -gap - at_place(sight%dents, sight%dents%deepest, xi)
      case default
         excess = max(-gap, at_place(sight%dents, sight%dents%deepest, xi)) - sight%onset
      end select
   end function excess

   !> Where the excess changes its sign between two places.
   pure real(dp) function change(sight, level, from, to) result(xi)
      type(sight_t), intent(in) :: sight
      !> Of the constants above
      integer, intent(in) :: level
      !> Two places at which it has unlike signs
      real(dp), intent(in) :: from, to
      real(dp) :: low, high
      logical :: is_positive
      integer :: i

      low = from
      high = to
      is_positive = excess(sight, from, level) > 0
      do i = 1, n_halvings
         xi = (low + high)/2
         if ((excess(sight, xi, level) > 0) .eqv. is_positive) then
            low = xi
         else
            high = xi
         end if
      end do
   end function change

end module litz_surface_dents
