!> Which pairs of elements may touch: the candidates of the broad phase.
module litz_contact_candidates
   use litz_kinds, only: dp
   use litz_axis, only: axis_sagitta
   use litz_contact_joints, only: are_joined
   use litz_contact_points, only: contact_set_t
   use litz_contact_search, only: near_segments
   use litz_contact_tangents, only: axis_of_element
   use litz_element_library, only: elements_t
   use litz_joint_radii, only: largest_radius
   use litz_line_places, only: prepare_line_places
   use litz_errors, only: error_t, fail, exit_memory
   use litz_model, only: model_t
   use litz_parallel, only: worth_threads
   use litz_text, only: to_text
   use litz_wires, only: wires_t
   implicit none
   private
   public :: prepare_contact, find_candidates, candidates_hold, find_contact_pair, skin

   !> An axis may bend by this part of its length before candidates are collected again
   real(dp), parameter :: bending = 0.05_dp
   !> Surface distance up to which an element pair is a candidate, in mean radii of the two
   real(dp), parameter :: skin = 1.0_dp
   !> Pairs of elements at most: four nodes of each are counted in default integers, beside two of each element
   integer, parameter :: max_candidates = 2**29 - 2**24

contains

   !> Which elements the contact pairs name; no candidates and no points yet.
   subroutine prepare_contact(model, wires, elements, contact)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(out) :: contact
      integer :: p, e

      allocate (contact%points(0), contact%converged(0), contact%candidates(3, 0), contact%joined(3, 0))
      allocate (contact%coupled(0))
      allocate (contact%line_points(0), contact%converged_line_points(0))
      allocate (contact%clearance(size(model%contact_pairs)), source=0.0_dp)
      contact%converged_clearance = contact%clearance
      contact%overlap = contact%clearance
      allocate (contact%places%xi(0))
      call contact%near%forget(0)
      contact%present = size(model%contact_pairs) > 0
      if (.not. contact%present) return
      allocate (contact%in_bar(model%n_elements, size(model%contact_pairs)), source=.false.)
      allocate (contact%in_set, source=contact%in_bar)
      do p = 1, size(model%contact_pairs)
         associate (pair => model%contact_pairs(p))
            contact%in_bar(model%element_sets(pair%set_bar)%members, p) = .true.
            contact%in_set(model%element_sets(pair%set)%members, p) = .true.
         end associate
      end do
      allocate (contact%wire_in_bar(wires%n_wires, size(model%contact_pairs)), source=.false.)
      allocate (contact%wire_in_set, source=contact%wire_in_bar)
      do e = 1, model%n_elements
         associate (wire => wires%wire(e))
            contact%wire_in_bar(wire, :) = contact%wire_in_bar(wire, :) .or. contact%in_bar(e, :)
            contact%wire_in_set(wire, :) = contact%wire_in_set(wire, :) .or. contact%in_set(e, :)
         end associate
      end do
      contact%members = pack([(e, e=1, model%n_elements)], any(contact%in_bar .or. contact%in_set, 2))
      call prepare_line_places(wires, elements%length, minval(elements%radius(contact%members)), contact%places)
      allocate (contact%valid_sagitta(model%n_elements), source=0.0_dp)
      allocate (contact%valid_motion(model%n_nodes), source=huge(1.0_dp))
      do e = 1, model%n_elements
         if (.not. any(contact%in_bar(e, :) .or. contact%in_set(e, :))) cycle
         associate (nodes => model%connectivity(:, e))
            contact%valid_motion(nodes) = min(contact%valid_motion(nodes), skin*elements%radius(e)/2)
         end associate
      end do
   end subroutine prepare_contact

   !> Collect the element pairs that are near in the present positions, or were passed since the increment began; how
   !> wires turn has been measured.
   subroutine find_candidates(model, wires, elements, x_start, rotation_start, x, rotation, contact, changed, error)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes) when the increment began, and now
      real(dp), intent(in) :: x_start(:, :), rotation_start(:, :, :), x(:, :), rotation(:, :, :)
      type(contact_set_t), intent(inout) :: contact
      !> The candidates are not those of the last call
      logical, intent(out) :: changed
      !> There are more than can be counted
      type(error_t), allocatable, intent(out) :: error
      integer, allocatable :: pairs(:, :), found(:, :)
      real(dp), allocatable :: reach(:)
      logical :: too_many
      integer :: i

      changed = .false.
      call set_reach(model, wires, elements, x_start, rotation_start, x, rotation, contact, reach)
      associate (first => model%connectivity(1, contact%members), second => model%connectivity(2, contact%members))
         call near_segments(x(:, first), x(:, second), reach, max_candidates, pairs, too_many)
      end associate
      if (too_many) then
         error = fail(exit_memory, 'contact search: of '//to_text(size(contact%members))//' elements more than '// &
            to_text(max_candidates)//' pairs lie within a radius of each other, which is more than can be'// &
            ' counted; name fewer wires in *CONTACT PAIR, or make the model smaller')
         return
      end if
      allocate (found(3, size(pairs, 2)))
      !$omp parallel do schedule(static) if (size(pairs, 2) >= worth_threads)
      do i = 1, size(pairs, 2)
         call assign_roles(model, wires, elements, contact, contact%members(pairs(1, i)), &
            contact%members(pairs(2, i)), found(1:2, i), found(3, i))
      end do
      !$omp end parallel do
      contact%x_collected = x
      call keep_candidates(found, contact, changed)
   end subroutine find_candidates

   !> How far from its chord each element may touch others, and how far its axis may bend until candidates are
   !> collected again.
   subroutine set_reach(model, wires, elements, x_start, rotation_start, x, rotation, contact, reach)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes) when the increment began, and now
      real(dp), intent(in) :: x_start(:, :), rotation_start(:, :, :), x(:, :), rotation(:, :, :)
      type(contact_set_t), intent(inout) :: contact
      !> Of the elements that contact pairs name (n_members) [m]
      real(dp), allocatable, intent(out) :: reach(:)
      real(dp) :: p(3, 0:3)
      integer :: i

      allocate (reach(size(contact%members)))
      do i = 1, size(reach)
         associate (e => contact%members(i), node => model%connectivity(:, contact%members(i)))
            p = axis_of_element(model, wires, elements, e, x, rotation)
            contact%valid_sagitta(e) = axis_sagitta(p) + bending*elements%length(e)
            ! what the axis may leave its chord by, what its nodes and its bow have moved since the increment began,
            ! and half of the overlap it then had count as thickness
            reach(i) = (1 + skin/2)*largest_radius(wires, elements, e) + contact%depth/2 + contact%valid_sagitta(e) &
               + sqrt(maxval(sum((x(:, node) - x_start(:, node))**2, 1))) &
               + axis_sagitta(p - axis_of_element(model, wires, elements, e, x_start, rotation_start))
         end associate
      end do
   end subroutine set_reach

   !> Sort pairs of elements into candidates and joined ones.
   subroutine keep_candidates(found, contact, changed)
      !> Roles and contact pair of each pair, as `assign_roles` has them (3, n); out: candidates first
      integer, intent(inout) :: found(:, :)
      type(contact_set_t), intent(inout) :: contact
      !> The candidates are not those of the last call
      logical, intent(out) :: changed
      integer :: i, n_found

      contact%joined = abs(reshape(pack(found, spread(found(3, :) < 0, 1, 3)), [3, count(found(3, :) < 0)]))
      n_found = 0
      do i = 1, size(found, 2)
         if (found(3, i) <= 0) cycle
         n_found = n_found + 1
         found(:, n_found) = found(:, i)
      end do
      changed = size(contact%candidates, 2) /= n_found
      if (.not. changed) changed = any(contact%candidates /= found(:, :n_found))
      if (.not. changed) return
      contact%candidates = found(:, :n_found)
      contact%coupled = spread(.false., 1, n_found)
      call contact%near%forget(n_found)
   end subroutine keep_candidates

   !> The candidates are still all that may touch: nothing has moved or bent too far since they were collected, and no
   !> wire has turned so far that it comes back to itself.
   pure logical function candidates_hold(model, wires, elements, contact, x, rotation) result(hold)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      integer :: i

      hold = allocated(contact%x_collected)
      if (.not. hold) return
      hold = all(norm2(x - contact%x_collected, 1) < contact%valid_motion)
      do i = 1, size(contact%members)
         if (.not. hold) return
         associate (e => contact%members(i))
            hold = axis_sagitta(axis_of_element(model, wires, elements, e, x, rotation)) < contact%valid_sagitta(e)
         end associate
      end do
      do i = 1, size(contact%joined, 2)
         if (.not. hold) return
         associate (pair => contact%joined(1:2, i))
            if (wires%wire(pair(1)) == wires%wire(pair(2))) hold = are_joined(model, wires, elements, contact%turning, &
               pair(1), pair(2))
         end associate
      end do
   end function candidates_hold

   !> Which element is the barred one, and by which contact pair they may touch; 0: none; negative: they would, but are
   !> joined.
   pure subroutine assign_roles(model, wires, elements, contact, a, b, roles, pair)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      !> Two elements
      integer, intent(in) :: a, b
      !> The barred and the unbarred element (2), and the contact pair
      integer, intent(out) :: roles(2), pair

      call find_contact_pair(model, wires, contact, a, b, roles, pair)
      if (pair == 0) return
      if (are_joined(model, wires, elements, contact%turning, a, b)) pair = -pair
   end subroutine assign_roles

   !> The last contact pair that names both elements, and which of them is the barred one; 0: none.
   pure subroutine find_contact_pair(model, wires, contact, a, b, roles, pair)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(contact_set_t), intent(in) :: contact
      !> Two elements
      integer, intent(in) :: a, b
      !> The barred and the unbarred element (2), and the contact pair
      integer, intent(out) :: roles(2), pair
      logical :: forward, backward

      roles = 0
      do pair = size(model%contact_pairs), 1, -1
         forward = contact%in_bar(a, pair) .and. contact%in_set(b, pair)
         backward = contact%in_bar(b, pair) .and. contact%in_set(a, pair)
         if (.not. (forward .or. backward)) cycle
         if (wires%wire(a) /= wires%wire(b)) then
            forward = is_barred(wires%wire(a), wires%wire(b))
         else if (forward .and. backward) then
            forward = wires%arc(a) < wires%arc(b)
         end if
         roles = merge([a, b], [b, a], forward)
         return
      end do
      pair = 0

   contains

      !> The first of two wires is the barred one, by the last contact pair that names elements of both: the same for
      !> all their elements, so that the roles outlive a hand-over. Where it names both orders their numbers decide.
      pure logical function is_barred(wire, other)
         !> Two wires
         integer, intent(in) :: wire, other
         integer :: p
         logical :: is_backward

         do p = size(model%contact_pairs), 1, -1
            is_barred = contact%wire_in_bar(wire, p) .and. contact%wire_in_set(other, p)
            is_backward = contact%wire_in_bar(other, p) .and. contact%wire_in_set(wire, p)
            if (is_barred .and. is_backward) is_barred = wire < other
            if (is_barred .or. is_backward) return
         end do
      end function is_barred

   end subroutine find_contact_pair

end module litz_contact_candidates
