!> Contacts that have left the part of a wire that a contact pair names.
!>
!> Where only a part of a wire is named, a contact that slides beyond it has no successor, and its wires would spring
!> through each other. A contact of the last converged state that is gone, while its wires overlap outside the named
!> part where they did not in the reference configuration, has gone that way.
module litz_departed_contacts
   use litz_kinds, only: dp
   use litz_axis, only: axis_polynomial, axis_sagitta
   use litz_contact_findings, only: finding_t, worse_of, finding_departed
   use litz_contact_pairs, only: are_joined, find_contact_pair
   use litz_contact_points, only: contact_set_t, pair_geometry
   use litz_element_library, only: elements_t
   use litz_model, only: model_t, axis_hermite
   use litz_straight_segments, only: segment_distance
   use litz_rotations, only: identity3
   use litz_wires, only: wires_t
   implicit none
   private
   public :: find_departed_contacts, surely_overlap

contains

   !> The worst of the contacts that have left; `finding_none`: there is none.
   function find_departed_contacts(model, wires, elements, contact, x, rotation) result(worst)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the points of this state, and those of the last converged one
      type(contact_set_t), intent(in) :: contact
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(finding_t) :: worst
      logical :: has_successor(0:contact%last_id)
      integer :: k

      has_successor = .false.
      has_successor(contact%points%id) = .true.
      do k = 1, size(contact%converged)
         associate (point => contact%converged(k))
            if (point%gap < 0 .and. .not. has_successor(point%id)) call follow(wires%wire(point%element_bar), &
               wires%wire(point%element), point%pair)
         end associate
      end do

   contains

      !> Look at all elements of two wires, if their contact pair leaves some of them out.
      subroutine follow(wire_bar, wire, pair)
         integer, intent(in) :: wire_bar, wire, pair
         integer :: i, j

         associate (a => wires%element(wires%first(wire_bar):wires%first(wire_bar + 1) - 1), &
            b => wires%element(wires%first(wire):wires%first(wire + 1) - 1))
            if (all(contact%in_bar(a, pair)) .and. all(contact%in_set(b, pair))) return
            do i = 1, size(a)
               do j = 1, size(b)
                  call look_at(a(i), b(j))
               end do
            end do
         end associate
      end subroutine follow

      subroutine look_at(a, b)
         integer, intent(in) :: a, b
         real(dp) :: overlap
         integer :: roles(2), pair

         call find_contact_pair(model, wires, contact, a, b, roles, pair)
         if (pair > 0) return
         overlap = surely_overlap(model, wires, elements, a, b, x, rotation)
         if (overlap <= 0) return
         if (are_joined(model, wires, elements, a, b)) return
         if (surely_overlap(model, wires, elements, a, b, model%x, spread(identity3, 3, model%n_nodes)) > 0) return
         worst = worse_of(worst, finding_t(finding_departed, [a, b], overlap))
      end subroutine look_at

   end function find_departed_contacts

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
