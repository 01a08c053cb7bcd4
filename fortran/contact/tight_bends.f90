!> Bends that are tighter than their wire is thick: their inner side folds into itself, which is no contact.
!>
!> Where the radius of curvature is nowhere below that of the wire, two places half the circumference of a circle of
!> this radius apart are at least a diameter from each other (Schur), as are those further apart between which the wire
!> turns by less than `pi`. Source: theory section 4.
module litz_tight_bends
   use litz_kinds, only: dp, pi
   use litz_contact_findings, only: finding_t, worse_of, finding_tight
   use litz_contact_joints, only: walk_along
   use litz_contact_points, only: contact_set_t, pair_geometry, axis_of_pair
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_text, only: to_text
   use litz_tube_overlaps, only: tube_overlap_t, overlap_at, overlap_of_reference
   use litz_wire_turning, only: wire_turning_t
   use litz_wires, only: wires_t
   implicit none
   private
   public :: inspect_bends, describe_tight_bends

   !> A wire that turns by less [rad] along half a circle of its radius leaves the ends a diameter from each other:
   !> `L cos(K/2) = 2 r`, `L = pi r`
   real(dp), parameter :: harmless = 2*acos(2/pi)
   !> Distance of neighbouring places that are looked at, in radii
   real(dp), parameter :: stride = 0.5_dp
   integer, parameter :: max_places = 64

contains

   !> The worst bend whose sides overlap by more than a part of the radius; `finding_none`: there is none.
   function inspect_bends(model, wires, elements, contact, x, rotation, allowed) result(worst)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      !> Overlap over the radius that is allowed
      real(dp), intent(in) :: allowed
      type(finding_t) :: worst
      integer :: i, pair

      do i = 1, size(contact%members)
         pair = pair_with_itself(wires, contact, contact%members(i))
         if (pair == 0) cycle
         if (model%interactions(model%contact_pairs(pair)%interaction)%unlimited_penetration) cycle
         call inspect_bend(model, wires, elements, contact%turning, contact%members(i), pair, x, rotation, allowed, &
            worst)
      end do
   end function inspect_bends

   !> How many elements are bent more tightly than their wires are thick, with an example; empty: none.
   function describe_tight_bends(model, wires, elements, contact) result(text)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      character(len=:), allocatable :: text
      real(dp) :: tightest, curvature
      integer :: i, n, example

      n = 0
      tightest = 1
      example = 0
      do i = 1, size(contact%members)
         associate (e => contact%members(i))
            if (pair_with_itself(wires, contact, e) == 0) cycle
            curvature = contact%turning%own(e)*elements%radius(e)/elements%length(e)
            if (curvature > 1) n = n + 1
            if (.not. curvature > tightest) cycle
            tightest = curvature
            example = e
         end associate
      end do
      text = ''
      if (n > 0) text = 'wires that may touch themselves are bent more tightly than they are thick in '//to_text(n)// &
         ' elements, such as '//to_text(model%element_id(example))//', where the radius of curvature is '// &
         to_text(100/tightest)//' % of the radius of the wire; the fold on the inner side is not modelled'
   end function describe_tight_bends

   !> The last contact pair that names the wire of an element on both sides; 0: none.
   pure integer function pair_with_itself(wires, contact, e) result(pair)
      type(wires_t), intent(in) :: wires
      type(contact_set_t), intent(in) :: contact
      !> Element
      integer, intent(in) :: e

      do pair = size(contact%wire_in_bar, 2), 1, -1
         if (contact%wire_in_bar(wires%wire(e), pair) .and. contact%wire_in_set(wires%wire(e), pair)) return
      end do
   end function pair_with_itself

   !> Places around one element.
   subroutine inspect_bend(model, wires, elements, turning, e, pair, x, rotation, allowed, worst)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(wire_turning_t), intent(in) :: turning
      !> Element, and contact pair of its wire with itself
      integer, intent(in) :: e, pair
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      !> Overlap over the radius that is allowed
      real(dp), intent(in) :: allowed
      type(finding_t), intent(inout) :: worst
      type(tube_overlap_t) :: overlap, overlap0
      real(dp) :: quarter, from, place(2), xe(3, 4), t(3, 4), length(2)
      integer :: i, n, legs(2)

      quarter = pi/2*elements%radius(e)
      n = max(1, min(max_places, ceiling(elements%length(e)/(stride*elements%radius(e)))))
      do i = 1, n
         from = (i - 0.5_dp)/n*elements%length(e)
         call walk_along(wires, elements, e, 1, from + quarter, legs(1), place(1))
         call walk_along(wires, elements, e, 2, elements%length(e) - from + quarter, legs(2), place(2))
         if (any(legs == 0)) cycle
         if (wires%circumference(wires%wire(e)) <= 0 .and. turning%along(wires, legs(1), legs(2)) < harmless) cycle
         call pair_geometry(model, wires, elements, legs(1), legs(2), x, rotation, xe, t, length)
         overlap = overlap_at(axis_of_pair(model, pair), elements%radius(legs), xe, t, length, place)
         if (overlap%depth <= allowed) cycle
         overlap0 = overlap_of_reference(model, wires, elements, [legs, pair], place)
         if (.not. overlap0%depth > 0) worst = worse_of(worst, finding_t(finding_tight, legs, overlap%depth))
      end do
   end subroutine inspect_bend

end module litz_tight_bends
