!> Contacts that have left the part of a wire that a contact pair names.
!>
!> Where only a part of a wire is named, a contact that slides beyond it has no successor, and its wires would spring
!> through each other. A contact of the last converged state that is gone, while its wires overlap outside the named
!> part where they did not in the reference configuration, has gone that way.
module litz_departed_contacts
   use litz_kinds, only: dp
   use litz_axis, only: axis_polynomial, axis_sagitta
   use litz_contact_findings, only: finding_t, worse_of, finding_departed
   use litz_contact_candidates, only: find_contact_pair
   use litz_contact_joints, only: are_joined
   use litz_contact_points, only: contact_set_t, pair_geometry
   use litz_element_library, only: elements_t
   use litz_model, only: model_t, axis_hermite
   use litz_straight_segments, only: segment_distance
   use litz_rotations, only: identity3
   use litz_wires, only: wires_t
   implicit none
   private
   public :: find_departed_pairs, find_departed_contacts, find_departed_lines, surely_overlap

   !> Overlap over the smaller radius that is more than round-off
   real(dp), parameter :: unseen_overlap = 1.0e-6_dp

contains

   !> Pairs of elements of the wires of contacts that are gone, which no contact pair names.
   subroutine find_departed_pairs(model, wires, contact, pairs)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      !> With the points of this state, and those of the last converged one
      type(contact_set_t), intent(in) :: contact
      !> Elements of the barred and of the unbarred wire, and the contact pair of the contact that is gone (3, n)
      integer, allocatable, intent(out) :: pairs(:, :)
      logical :: has_successor(0:contact%last_id)
      integer :: k

      has_successor = .false.
      has_successor(contact%points%id) = .true.
      allocate (pairs(3, 0))
      do k = 1, size(contact%converged)
         associate (point => contact%converged(k))
            if (point%gap < 0 .and. .not. has_successor(point%id)) call add_pairs(wires%wire(point%element_bar), &
               wires%wire(point%element), point%pair)
         end associate
      end do

   contains

      !> Those of two wires, if their contact pair leaves elements of them out.
      subroutine add_pairs(wire_bar, wire, pair)
         !> Two wires, and a contact pair
         integer, intent(in) :: wire_bar, wire, pair
         integer :: new(3, wires%first(wire_bar + 1) - wires%first(wire_bar), wires%first(wire + 1) - wires%first(wire))
         integer :: i, j, roles(2), named_by
         logical :: unnamed(size(new, 2), size(new, 3))

         associate (a => wires%element(wires%first(wire_bar):wires%first(wire_bar + 1) - 1), &
            b => wires%element(wires%first(wire):wires%first(wire + 1) - 1))
            if (all(contact%in_bar(a, pair)) .and. all(contact%in_set(b, pair))) return
            do j = 1, size(b)
               do i = 1, size(a)
                  call find_contact_pair(model, wires, contact, a(i), b(j), roles, named_by)
                  unnamed(i, j) = named_by == 0
                  new(:, i, j) = [a(i), b(j), pair]
               end do
            end do
         end associate
         pairs = reshape([pairs, pack(new, spread(unnamed, 1, 3))], [3, size(pairs, 2) + count(unnamed)])
      end subroutine add_pairs

   end subroutine find_departed_pairs

   !> The worst of the contacts that have left; `finding_none`: there is none.
   function find_departed_contacts(model, wires, elements, contact, pairs, x, rotation) result(worst)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      !> Those of `find_departed_pairs` (3, n)
      integer, intent(in) :: pairs(:, :)
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(finding_t) :: worst
      real(dp) :: overlap
      integer :: i

      do i = 1, size(pairs, 2)
         associate (a => pairs(1, i), b => pairs(2, i))
            overlap = surely_overlap(model, wires, elements, a, b, x, rotation)
            if (overlap <= 0) cycle
            if (are_joined(model, wires, elements, contact%turning, a, b)) cycle
            if (surely_overlap(model, wires, elements, a, b, model%x, spread(identity3, 3, model%n_nodes)) > 0) cycle
            worst = worse_of(worst, finding_t(finding_departed, [a, b], overlap))
         end associate
      end do
   end function find_departed_contacts

   !> The worst contact along a line that goes on beyond the part of a wire that its contact pair names.
   function find_departed_lines(model, wires, elements, contact, x, rotation) result(worst)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(finding_t) :: worst
      integer :: i, side

      if (all_wires_are_whole()) return
      do i = 1, size(contact%line_points)
         associate (point => contact%line_points(i))
            if (.not. point%closed) cycle
            do side = 1, 2
               call inspect(wires%next(side, point%element), point%element_bar)
               call inspect(wires%next(side, point%element_bar), point%element)
            end do
         end associate
      end do

   contains

      !> No contact pair names a part of a wire only.
      pure logical function all_wires_are_whole()
         integer :: e

         all_wires_are_whole = .true.
         do e = 1, model%n_elements
            associate (wire => wires%wire(e))
               if (any((contact%wire_in_bar(wire, :) .and. .not. contact%in_bar(e, :)) .or. &
                  (contact%wire_in_set(wire, :) .and. .not. contact%in_set(e, :)))) all_wires_are_whole = .false.
            end associate
         end do
      end function all_wires_are_whole

      subroutine inspect(a, b)
         !> An element next to one in contact, 0: none, and the element that is touched
         integer, intent(in) :: a, b
         integer :: roles(2), named_by
         real(dp) :: overlap

         if (a == 0) return
         call find_contact_pair(model, wires, contact, a, b, roles, named_by)
         if (named_by > 0) return
         overlap = surely_overlap(model, wires, elements, a, b, x, rotation)
         if (overlap < unseen_overlap) return
         if (are_joined(model, wires, elements, contact%turning, a, b)) return
         worst = worse_of(worst, finding_t(finding_departed, [a, b], overlap))
      end subroutine inspect

   end function find_departed_lines

   !> Overlap of two elements over the smaller radius, but for what lies between their chords and their axes; negative:
   !> none, or none that is sure.
   real(dp) function surely_overlap(model, wires, elements, a, b, x, rotation) result(overlap)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Two elements
      integer, intent(in) :: a, b
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      real(dp) :: xe(3, 4), t(3, 4), length(2), in_doubt

      ! an element without a contact radius touches nothing
      overlap = -1
      if (.not. all(elements%radius([a, b]) > 0)) return
      call pair_geometry(model, wires, elements, a, b, x, rotation, xe, t, length)
      overlap = sum(elements%radius([a, b])) - segment_distance(xe)
      if (overlap > 0) then
         in_doubt = axis_sagitta(axis_polynomial(axis_hermite, length(1), xe(:, 1:2), t(:, 1:2))) &
            + axis_sagitta(axis_polynomial(axis_hermite, length(2), xe(:, 3:4), t(:, 3:4)))
         overlap = overlap - in_doubt
      end if
      overlap = overlap/minval(elements%radius([a, b]))
   end function surely_overlap

end module litz_departed_contacts
