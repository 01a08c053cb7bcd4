!> Overlaps near a joint of two wires, where elements have no contact: of those that are joined, or next to joined ones.
!>
!> Along one wire the bends are looked at instead (litz_tight_bends).
module litz_joint_overlaps
   use litz_kinds, only: dp
   use litz_contact_findings, only: finding_t, worse_of, finding_joined
   use litz_contact_joints, only: are_joined, walk_along, joined_radii
   use litz_contact_points, only: pair_geometry, axis_of_pair
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_tube_overlaps, only: tube_overlap_t, overlap_at, overlap_of_reference, unseen_overlap
   use litz_wire_turning, only: wire_turning_t
   use litz_wires, only: wires_t
   implicit none
   private
   public :: inspect_legs, leads_to_joint

contains

   !> Two elements of different wires that share a node, where these fold up: do they overlap where joined elements end
   !> to be without contact, and did not in the reference configuration?
   subroutine inspect_legs(model, wires, elements, candidate, x, rotation, finding)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Barred element, unbarred element, contact pair (3)
      integer, intent(in) :: candidate(3)
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(finding_t), intent(inout) :: finding
      type(tube_overlap_t) :: overlap, overlap0
      real(dp) :: xe(3, 4), t(3, 4), length(2), place(2), apart
      integer :: i, j, leg(3)

      if (wires%wire(candidate(1)) == wires%wire(candidate(2))) return
      leg(3) = candidate(3)
      apart = joined_radii*maxval(elements%radius(candidate(1:2)))
      do i = 1, 2
         do j = 1, 2
            if (model%connectivity(i, candidate(1)) /= model%connectivity(j, candidate(2))) cycle
            call walk_along(wires, elements, candidate(1), i, apart/2, leg(1), place(1))
            call walk_along(wires, elements, candidate(2), j, apart/2, leg(2), place(2))
            if (any(leg == 0)) cycle
            call pair_geometry(model, wires, elements, leg(1), leg(2), x, rotation, xe, t, length)
            overlap = overlap_at(axis_of_pair(model, leg(3)), elements%radius(leg(1:2)), xe, t, length, place)
            if (overlap%depth < unseen_overlap) cycle
            overlap0 = overlap_of_reference(model, wires, elements, leg, place)
            if (overlap0%depth > 0) cycle
            finding = worse_of(finding, finding_t(finding_joined, leg(1:2), overlap%depth))
         end do
      end do
   end subroutine inspect_legs

   !> One of two elements of different wires, or the one beyond its end, is joined to the other one or to that beyond
   !> its end.
   pure logical function leads_to_joint(model, wires, elements, turning, pair, beyond)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(wire_turning_t), intent(in) :: turning
      !> Two elements; elements beyond their ends, 0: none (2)
      integer, intent(in) :: pair(2), beyond(2)
      integer :: next(2)

      leads_to_joint = .false.
      if (wires%wire(pair(1)) == wires%wire(pair(2))) return
      next = merge(beyond, pair, beyond > 0)
      leads_to_joint = are_joined(model, wires, elements, turning, next(1), next(2)) .and. &
         .not. are_joined(model, wires, elements, turning, pair(1), pair(2))
   end function leads_to_joint

end module litz_joint_overlaps
