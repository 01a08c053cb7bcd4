!> What an element of metal that yields remembers of a rigid surface.
!>
!> Source: theory section 15. Metal remembers its largest overlap at places that are evenly spread over the part of the
!> element that has touched; it is negative where wire and surface have only been near each other. The force per length
!> that it has made, and the dent, are those of the law at this overlap. The places stay where they are in an increment:
!> each stands for the same length of the wire.
module litz_surface_dents
   use litz_kinds, only: dp
   use litz_rigid_surface, only: rigid_surface_t
   use litz_surface_overlap, only: surface_overlap_t, gap_at
   use litz_yielding_line, only: yielding_line_t, line_dent_t, line_dent, line_state_t, line_state_at_overlap
   use litz_yielding_spot, only: yielding_t, dent_t, dent_of_force, yielding_state_t, state_at_overlap
   implicit none
   private
   public :: surface_dents_t, yielding_element_t, n_places, n_of_dents, numbers_of_dents, dents_of_numbers
   public :: has_places, place_of, find_dents, dent_of_end, depth_of_dents, dents_after

   !> Places of the memory
   integer, parameter :: n_places = 40
   !> What the memory has beyond the part that has touched, in lengths of that part: a contact that grows steadily takes
   !> other places rarely
   real(dp), parameter :: margin = 0.1_dp
   !> Numbers of the memory
   integer, parameter :: n_of_dents = n_places + 6

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
      !> Dents at the places of the memory (n_places), once they are known
      type(line_dent_t), allocatable :: dent(:)
   end type yielding_element_t

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

   !> The element has a memory.
   pure logical function has_places(dents)
      type(surface_dents_t), intent(in) :: dents

      has_places = dents%last > dents%first
   end function has_places

   !> A place of the memory in the element.
   elemental real(dp) function place_of(dents, i) result(xi)
      type(surface_dents_t), intent(in) :: dents
      !> Its number
      integer, intent(in) :: i

      xi = dents%first + (dents%last - dents%first)*(i - 0.5_dp)/n_places
   end function place_of

   !> The dents of law and memory; they take long enough to be found where they are needed only.
   pure subroutine find_dents(dents, law)
      type(surface_dents_t), intent(in) :: dents
      type(yielding_element_t), intent(inout) :: law
      type(line_state_t) :: made
      integer :: i

      if (allocated(law%dent)) return
      allocate (law%dent(n_places))
      do i = 1, n_places
         if (.not. dents%deepest(i) > 0) cycle
         made = line_state_at_overlap(law%strip, line_dent_t(), dents%deepest(i))
         law%dent(i) = line_dent(law%strip, made%force)
      end do
   end subroutine find_dents

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
   pure real(dp) function depth_of_dents(dents, law, at_end) result(depth)
      type(surface_dents_t), intent(in) :: dents
      !> With its dents
      type(yielding_element_t), intent(in) :: law
      !> Its first and its second end carry something (2)
      logical, intent(in) :: at_end(2)
      type(dent_t) :: dent
      integer :: end

      depth = maxval(law%dent%depth)
      do end = 1, 2
         if (.not. at_end(end)) cycle
         dent = dent_of_end(dents, law, end)
         depth = max(depth, dent%depth)
      end do
   end function depth_of_dents

   !> The memory after an increment that has converged.
   pure type(surface_dents_t) function dents_after(before, surface, p, radius, overlap) result(dents)
      type(surface_dents_t), intent(in) :: before
      type(rigid_surface_t), intent(in) :: surface
      !> Axis in powers of xi (3, 0:3) [m], and radius [m]
      real(dp), intent(in) :: p(3, 0:3), radius
      type(surface_overlap_t), intent(in) :: overlap
      real(dp) :: gap, unused_slope
      integer :: i

      dents = before
      if (overlap%n == 0) return
      associate (from => overlap%first(1), to => overlap%last(overlap%n))
         if (.not. has_places(before)) then
            dents%first = max(-1.0_dp, from - margin*(to - from))
            dents%last = min(1.0_dp, to + margin*(to - from))
         else
            if (from < before%first) dents%first = max(-1.0_dp, from - margin*(before%last - from))
            if (to > before%last) dents%last = min(1.0_dp, to + margin*(to - dents%first))
         end if
      end associate
      if (abs(dents%first - before%first) + abs(dents%last - before%last) > 0) then
         dents%deepest = at_places(before, place_of(dents, [(i, i=1, n_places)]))
      end if
      do i = 1, n_places
         call gap_at(surface, p, radius, place_of(dents, i), gap, unused_slope)
         dents%deepest(i) = max(-gap, dents%deepest(i))
      end do
      do i = 1, 2
         call gap_at(surface, p, radius, 2.0_dp*i - 3, gap, unused_slope)
         dents%end_deepest(i) = max(-gap, before%end_deepest(i))
      end do
   end function dents_after

   !> The largest overlap at other places, by Lagrange's cubics [m]; what has not been near the surface has none.
   elemental real(dp) function at_places(dents, xi) result(deepest)
      type(surface_dents_t), intent(in) :: dents
      !> In the element
      real(dp), intent(in) :: xi
      real(dp) :: t
      integer :: i

      deepest = -huge(deepest)
      if (.not. has_places(dents) .or. xi < dents%first .or. xi > dents%last) return
      t = (xi - dents%first)/(dents%last - dents%first)*n_places - 0.5_dp
      i = min(max(int(t), 1), n_places - 3)
      t = t - (i - 1)
      associate (values => dents%deepest)
         deepest = ((t - 1)*((t - 2)*(t*values(i + 3) - (t - 3)*values(i))) &
            + 3*t*((t - 3)*((t - 2)*values(i + 1) - (t - 1)*values(i + 2))))/6
      end associate
   end function at_places

end module litz_surface_dents
