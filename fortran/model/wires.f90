!> Wires: chains of elements, and the smooth reference directions along them.
!>
!> Two elements that meet at a node, alone and nearly straight on, continue one another: they share the tangent and
!> the section axes there, so that the Hermite axis has no kink and a contact can slide from one to the next.
module litz_wires
   use litz_kinds, only: dp, pi
   use litz_model, only: model_t
   use litz_rotations, only: cross
   implicit none
   private
   public :: corner_angle, wires_t, build_wires, measure_wires, arc_from_to

   !> A sharper angle between two elements [rad] is a corner, not a smooth wire (20 degrees, as in Abaqus)
   real(dp), parameter :: corner_angle = 20*pi/180

   type :: wires_t
      integer :: n_wires = 0
      !> Wire of each element (n_elements)
      integer, allocatable :: wire(:)
      !> Element that continues this one beyond its first and second node (2, n_elements); 0: the wire ends
      integer, allocatable :: next(:, :)
      !> +1: the element runs along its wire, -1: against it (n_elements)
      integer, allocatable :: direction(:)
      !> Elements in the order of the wires, and of the arc length along each (n_elements); those of wire w are
      !> `element(first(w):first(w + 1) - 1)`
      integer, allocatable :: element(:), first(:)
      !> Where each element stands in that order (n_elements)
      integer, allocatable :: place(:)
      !> Length around a closed wire [m] (n_wires); 0: the wire has two ends
      real(dp), allocatable :: circumference(:)
      !> Arc length along the wire at the middle of each element [m] (n_elements)
      real(dp), allocatable :: arc(:)
      !> Reference triads at both ends of each element, columns tangent, first and second section axis
      !> (3, 3, 2, n_elements)
      real(dp), allocatable :: triads0(:, :, :, :)
      !> Elements at node n, as +-element (- : its first node): `at_node(first_at_node(n):first_at_node(n + 1) - 1)`
      integer, allocatable :: at_node(:), first_at_node(:)
      !> The wire shares a node with another one (n_wires)
      logical, allocatable :: is_joined(:)
      !> Node where the wire begins, ends (2, n_wires), and whether nothing else is there
      integer, allocatable :: end_node(:, :)
      logical, allocatable :: is_free(:, :)
      !> Reference tangents at both ends of the axis that touches others (3, 2, n_elements), see litz_contact_tangents
      real(dp), allocatable :: contact_tangents0(:, :, :)
   contains
      procedure :: arc_between
   end type wires_t

contains

   subroutine build_wires(model, wires)
      type(model_t), intent(in) :: model
      type(wires_t), intent(out) :: wires
      real(dp), allocatable :: chord(:, :), length(:)
      integer :: e

      allocate (chord(3, model%n_elements), length(model%n_elements))
      do e = 1, model%n_elements
         associate (node => model%connectivity(:, e))
            chord(:, e) = model%x(:, node(2)) - model%x(:, node(1))
         end associate
         length(e) = norm2(chord(:, e))
         chord(:, e) = chord(:, e)/length(e)
      end do
      call list_elements_at_nodes(model, wires)
      call join_elements(model, chord, wires)
      call number_wires(model%n_elements, wires)
      call find_joints(model, wires)
      call find_ends(model, wires)
      call nodal_triads(model, chord, length, wires)
      allocate (wires%contact_tangents0, source=wires%triads0(:, 1, :, :))
   end subroutine build_wires

   pure subroutine list_elements_at_nodes(model, wires)
      type(model_t), intent(in) :: model
      type(wires_t), intent(inout) :: wires
      integer :: e, side, next(model%n_nodes + 1)

      allocate (wires%first_at_node(model%n_nodes + 1), wires%at_node(2*model%n_elements), source=0)
      do e = 1, model%n_elements
         associate (counts => wires%first_at_node, node => model%connectivity(:, e) + 1)
            counts(node(1)) = counts(node(1)) + 1
            counts(node(2)) = counts(node(2)) + 1
         end associate
      end do
      wires%first_at_node(1) = 1
      do e = 1, model%n_nodes
         wires%first_at_node(e + 1) = wires%first_at_node(e) + wires%first_at_node(e + 1)
      end do
      next = wires%first_at_node
      do e = 1, model%n_elements
         do side = 1, 2
            associate (place => next(model%connectivity(side, e)))
               wires%at_node(place) = merge(-e, e, side == 1)
               place = place + 1
            end associate
         end do
      end do
   end subroutine list_elements_at_nodes

   !> Which wires share nodes with others.
   pure subroutine find_joints(model, wires)
      type(model_t), intent(in) :: model
      type(wires_t), intent(inout) :: wires
      integer :: node

      allocate (wires%is_joined(wires%n_wires), source=.false.)
      do node = 1, model%n_nodes
         associate (here => wires%wire(abs(wires%at_node(wires%first_at_node(node):wires%first_at_node(node + 1) - 1))))
            if (size(here) > 1) then
               if (any(here /= here(1))) wires%is_joined(here) = .true.
            end if
         end associate
      end do
   end subroutine find_joints

   !> Where wires end, and which end freely.
   pure subroutine find_ends(model, wires)
      type(model_t), intent(in) :: model
      type(wires_t), intent(inout) :: wires
      integer :: w, k

      allocate (wires%end_node(2, wires%n_wires), wires%is_free(2, wires%n_wires))
      do w = 1, wires%n_wires
         do k = 1, 2
            associate (e => wires%element(merge(wires%first(w), wires%first(w + 1) - 1, k == 1)), &
               node => wires%end_node(k, w))
               node = model%connectivity(merge(k, 3 - k, wires%direction(e) > 0), e)
               wires%is_free(k, w) = wires%first_at_node(node + 1) - wires%first_at_node(node) == 1
            end associate
         end do
      end do
   end subroutine find_ends

   !> Two elements that meet at a node turn by less than a corner there.
   pure logical function lead_straight_on(chord, a, b)
      !> Direction of each element, of length 1 (3, elements)
      real(dp), intent(in) :: chord(:, :)
      !> The two, as +-element (- : at its first node)
      integer, intent(in) :: a, b

      ! directions into the node along one element and out of it along the other
      lead_straight_on = -sign(1, a)*sign(1, b)*dot_product(chord(:, abs(a)), chord(:, abs(b))) >= cos(corner_angle)
   end function lead_straight_on

   !> Which element continues which.
   pure subroutine join_elements(model, chord, wires)
      type(model_t), intent(in) :: model
      !> Direction of each element, of length 1 (3, elements)
      real(dp), intent(in) :: chord(:, :)
      type(wires_t), intent(inout) :: wires
      integer :: node, a, b

      allocate (wires%next(2, model%n_elements), source=0)
      do node = 1, model%n_nodes
         if (wires%first_at_node(node + 1) - wires%first_at_node(node) /= 2) cycle
         a = wires%at_node(wires%first_at_node(node))
         b = wires%at_node(wires%first_at_node(node) + 1)
         if (abs(a) == abs(b)) cycle
         if (.not. lead_straight_on(chord, a, b)) cycle
         wires%next(merge(1, 2, a < 0), abs(a)) = abs(b)
         wires%next(merge(1, 2, b < 0), abs(b)) = abs(a)
      end do
   end subroutine join_elements

   !> Walk each chain from one of its ends (from any element where it is closed).
   subroutine number_wires(n, wires)
      !> Number of elements
      integer, intent(in) :: n
      type(wires_t), intent(inout) :: wires
      integer :: e, pass, n_walked

      n_walked = 0
      allocate (wires%element(n), wires%place(n), wires%first(n + 1), source=0)
      allocate (wires%wire(n), wires%direction(n), source=0)
      do pass = 1, 2
         do e = 1, n
            if (wires%wire(e) /= 0) cycle
            if (pass == 1 .and. all(wires%next(:, e) /= 0)) cycle
            call walk(e)
         end do
      end do
      wires%first = [wires%first(:wires%n_wires), n + 1]

   contains

      subroutine walk(start)
         !> Index of the element to begin with
         integer, intent(in) :: start
         integer :: current, from, exit_side

         wires%n_wires = wires%n_wires + 1
         wires%first(wires%n_wires) = n_walked + 1
         current = start
         exit_side = merge(2, 1, wires%next(1, start) == 0 .or. wires%next(2, start) /= 0)
         do
            wires%wire(current) = wires%n_wires
            n_walked = n_walked + 1
            wires%element(n_walked) = current
            wires%place(current) = n_walked
            wires%direction(current) = merge(1, -1, exit_side == 2)
            from = current
            current = wires%next(exit_side, from)
            if (current == 0) exit
            if (wires%wire(current) /= 0) exit
            ! two elements joined at both ends form a ring: the side that is not the one just left stays free
            exit_side = merge(2, 1, entered_at_first(from, exit_side, current))
         end do
      end subroutine walk

      !> Whether going out of `from` by `side` leads into the first node of `to`.
      pure logical function entered_at_first(from, side, to)
         !> Indices of the two elements
         integer, intent(in) :: from
         !> Node of `from` that is left by, 1 or 2
         integer, intent(in) :: side
         !> Indices of the two elements
         integer, intent(in) :: to

         if (wires%next(1, to) == from .and. wires%next(2, to) == from) then
            entered_at_first = side == 2
         else
            entered_at_first = wires%next(1, to) == from
         end if
      end function entered_at_first

   end subroutine number_wires

   !> Arc lengths along the wires, from the lengths of their curved elements: a node has one, whichever element it is
   !> reached by.
   pure subroutine measure_wires(length, wires)
      !> Reference lengths (n_elements) [m]
      real(dp), intent(in) :: length(:)
      type(wires_t), intent(inout) :: wires
      real(dp) :: s
      integer :: w, i

      allocate (wires%arc(size(length)), wires%circumference(wires%n_wires), source=0.0_dp)
      do w = 1, wires%n_wires
         s = 0
         do i = wires%first(w), wires%first(w + 1) - 1
            associate (e => wires%element(i))
               wires%arc(e) = s + length(e)/2
               s = s + length(e)
            end associate
         end do
         if (all(wires%next(:, wires%element(wires%first(w))) /= 0)) wires%circumference(w) = s
      end do
   end subroutine measure_wires

   !> How far one place lies beyond another along a wire: around a closed wire the short way, be it over the node where
   !> its arc lengths begin.
   elemental real(dp) function arc_from_to(from, to, circumference) result(arc)
      !> Arc lengths of the two places, and length around the wire [m], 0: it has two ends
      real(dp), intent(in) :: from, to, circumference

      arc = to - from
      if (circumference > 0) arc = arc - circumference*anint(arc/circumference)
   end function arc_from_to

   !> Distance of two places along a wire, the short way around a closed one [m].
   elemental real(dp) function arc_between(self, wire, arc, other)
      class(wires_t), intent(in) :: self
      !> Index of the wire
      integer, intent(in) :: wire
      !> Arc lengths of the two places [m]
      real(dp), intent(in) :: arc, other

      arc_between = abs(arc_from_to(arc, other, self%circumference(wire)))
   end function arc_between

   !> Tangents at the nodes from a parabola through three neighbours (at the end of a wire: the circle that goes on),
   !> section axes perpendicular to them.
   pure subroutine nodal_triads(model, chord, length, wires)
      type(model_t), intent(in) :: model
      !> Direction of each element, of length 1 (3, elements)
      real(dp), intent(in) :: chord(:, :)
      !> Length of each element (elements) [m]
      real(dp), intent(in) :: length(:)
      type(wires_t), intent(inout) :: wires
      integer :: e, side, other, sense
      logical :: free(2)
      real(dp) :: tangent(3, 2), mean(3)

      allocate (wires%triads0(3, 3, 2, model%n_elements))
      do e = 1, model%n_elements
         do side = 1, 2
            other = wires%next(side, e)
            free(side) = other == 0
            tangent(:, side) = chord(:, e)
            if (free(side)) cycle
            sense = wires%direction(e)*wires%direction(other)
            mean = chord(:, e)*length(other) + sense*chord(:, other)*length(e)
            tangent(:, side) = mean/norm2(mean)
         end do
         do side = 1, 2
            if (free(side) .and. .not. free(3 - side)) then
               tangent(:, side) = 2*dot_product(tangent(:, 3 - side), chord(:, e))*chord(:, e) - tangent(:, 3 - side)
            end if
         end do
         do side = 1, 2
            associate (n1 => model%sections(model%element_section(e))%n1)
               wires%triads0(:, :, side, e) = triad(tangent(:, side), first_axis(n1, chord(:, e)))
            end associate
         end do
      end do
   end subroutine nodal_triads

   !> The direction asked for, or Abaqus's default (0, 0, -1), or (0, 1, 0) for an element nearly along z.
   pure function first_axis(n1, chord) result(axis)
      !> The direction asked for; zero: none
      real(dp), intent(in) :: n1(3)
      !> Direction of the element, of length 1
      real(dp), intent(in) :: chord(3)
      real(dp) :: axis(3)

      axis = n1
      if (any(abs(n1) > 0)) return
      axis = [0.0_dp, 0.0_dp, -1.0_dp]
      if (abs(chord(3)) > 0.9_dp) axis = [0.0_dp, 1.0_dp, 0.0_dp]
   end function first_axis

   !> Right-handed triad with the given tangent and a first axis as near as possible to `n1`.
   pure function triad(tangent, n1) result(axes)
      !> Of length 1
      real(dp), intent(in) :: tangent(3)
      !> Any direction but that of the tangent
      real(dp), intent(in) :: n1(3)
      real(dp) :: axes(3, 3), first(3)

      first = n1 - dot_product(n1, tangent)*tangent
      axes(:, 1) = tangent
      axes(:, 2) = first/norm2(first)
      axes(:, 3) = cross(axes(:, 1), axes(:, 2))
   end function triad

end module litz_wires
