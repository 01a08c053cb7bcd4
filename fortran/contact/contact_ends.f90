!> Where the round end of a wire, or the round joint of a kink, is nearest to another wire.
!>
!> A wire is a tube with round ends and joints. Its distance to another one has a local minimum at a node if it grows
!> along each of the elements that lead away from there. The other wire is met in between (a foot), or at an end or a
!> joint of its own. With straight axes every node is a joint.
module litz_contact_ends
   use litz_kinds, only: dp
   use litz_axis, only: axis_polynomial
   use litz_contact_candidates, only: find_contact_pair
   use litz_contact_joints, only: are_joined
   use litz_contact_points, only: contact_set_t, pair_geometry, axis_of_pair, away_from
   use litz_element_library, only: elements_t
   use litz_line_foot, only: line_foot, foot_inside, foot_at_end
   use litz_model, only: model_t, axis_hermite
   use litz_wires, only: wires_t
   implicit none
   private
   public :: minimum_t, add_ends, is_end, max_ends

   !> Minima at the ends of one pair of elements: each of its four ends over the other element, or over one of its ends
   integer, parameter :: max_ends = 4
   !> Cosine between the line to the other wire and an axis that counts as zero
   real(dp), parameter :: flat = 1.0e-12_dp

   !> Where two elements are nearest to each other.
   type :: minimum_t
      !> Places in the barred and the unbarred element (2), and which of them are ends or joints
      real(dp) :: xi(2) = 0
      logical :: held(2) = .false.
   end type minimum_t

contains

   !> A node of an element is a round end, or a round joint, of its axis.
   pure logical function is_end(wires, axis, e, side)
      type(wires_t), intent(in) :: wires
      !> `axis_linear` or `axis_hermite`, element, and its first or second node
      integer, intent(in) :: axis, e, side

      is_end = axis /= axis_hermite .or. wires%next(side, e) == 0
   end function is_end

   !> Add the minima of a candidate that lie at ends or joints.
   pure subroutine add_ends(model, wires, elements, contact, candidate, x, rotation, minima, n)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      !> Barred element, unbarred element, contact pair (3)
      integer, intent(in) :: candidate(3)
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(minimum_t), intent(inout) :: minima(:)
      !> How many there are
      integer, intent(inout) :: n
      real(dp) :: xe(3, 4), t(3, 4), length(2), p(3, 0:3)
      type(minimum_t) :: found
      logical :: is_minimum
      integer :: axis, own, end_side, side

      axis = axis_of_pair(model, candidate(3))
      if (.not. any([((is_end(wires, axis, candidate(own), side), side=1, 2), own=1, 2)])) return
      call pair_geometry(model, wires, elements, candidate(1), candidate(2), x, rotation, xe, t, length)
      do own = 1, 2
         associate (other => 3 - own, of_other => 2*(3 - own) - 1)
            p = axis_polynomial(axis, length(other), xe(:, of_other:of_other + 1), t(:, of_other:of_other + 1))
            do end_side = 1, 2
               if (.not. is_end(wires, axis, candidate(own), end_side)) cycle
               call inspect_end(own, end_side, other, found, is_minimum)
               if (.not. is_minimum) cycle
               n = n + 1
               minima(n) = found
            end do
         end associate
      end do

   contains

      !> Whether there is a minimum between an end of one element and the other element.
      pure subroutine inspect_end(own, end_side, other, found, is_minimum)
         !> 1: barred, 2: unbarred; which of its ends; and the other element
         integer, intent(in) :: own, end_side, other
         type(minimum_t), intent(out) :: found
         !> The distance grows from there on
         logical, intent(out) :: is_minimum
         real(dp) :: xi, quality
         integer :: status, node, foot_side

         is_minimum = .false.
         node = model%connectivity(end_side, candidate(own))
         call line_foot(p, x(:, node), [is_end(wires, axis, candidate(other), 1), &
            is_end(wires, axis, candidate(other), 2)], xi, quality, status)
         found%xi(own) = 2*end_side - 3
         found%xi(other) = xi
         found%held(own) = .true.
         found%held(other) = status == foot_at_end
         if (.not. (status == foot_inside .or. found%held(other))) return
         ! where end meets end, the unbarred one has the minimum
         if (all(found%held) .and. own == 1) return
         is_minimum = grows_from(node, candidate(other), foot_of(p, xi) - x(:, node), own)
         if (.not. (is_minimum .and. found%held(other))) return
         foot_side = merge(1, 2, xi < 0)
         is_minimum = grows_from(model%connectivity(foot_side, candidate(other)), candidate(own), &
            x(:, node) - foot_of(p, xi), other)
      end subroutine inspect_end

      !> The distance grows along all elements at a node, and this element is the first of them that may touch the other
      !> one.
      pure logical function grows_from(node, other_element, line, own)
         !> A node; element on the other side
         integer, intent(in) :: node, other_element
         !> From the node to the other wire (3) [m]
         real(dp), intent(in) :: line(3)
         !> 1, 2: the node is one of the barred, of the unbarred element
         integer, intent(in) :: own
         integer :: i, e, roles(2), pair

         grows_from = .true.
         do i = wires%first_at_node(node), wires%first_at_node(node + 1) - 1
            e = abs(wires%at_node(i))
            grows_from = dot_product(line, away_from(model, wires, axis, e, merge(1, 2, wires%at_node(i) < 0), x, &
               rotation)) <= flat*norm2(line)
            if (.not. grows_from) return
            if (e >= candidate(own)) cycle
            call find_contact_pair(model, wires, contact, e, other_element, roles, pair)
            grows_from = pair == 0
            if (pair > 0) grows_from = are_joined(model, wires, elements, contact%turning, e, other_element)
            if (.not. grows_from) return
         end do
      end function grows_from

   end subroutine add_ends

   !> Point of an axis (3) [m].
   pure function foot_of(p, xi) result(point)
      !> Axis in powers of xi (3, 0:3) [m], and the place
      real(dp), intent(in) :: p(3, 0:3), xi
      real(dp) :: point(3)

      point = p(:, 0) + xi*(p(:, 1) + xi*(p(:, 2) + xi*p(:, 3)))
   end function foot_of

end module litz_contact_ends
