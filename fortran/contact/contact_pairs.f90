!> Which crossings there are: candidates from the broad phase, points from the closest points of the curves.
!>
!> A crossing belongs to the pair of wires, not of elements: when it slides over a node, the point of the next
!> element takes over its memory. On which side of each other the two wires are is a fact of the last converged state
!> (litz_contact_side): an iterate that has pushed the axes through each other has a gap below minus both radii.
module litz_contact_pairs
   use litz_kinds, only: dp
   use litz_axis, only: axis_polynomial, axis_sagitta
   use litz_closest_points, only: closest_points, end_tolerance, search_limit, closest_inside, closest_beyond, &
      closest_not_unique, closest_parallel, closest_not_converged
   use litz_contact_kinematics, only: contact_kinematics, kinematics_ok
   use litz_contact_matching, only: match_points, slides_of
   use litz_contact_points, only: contact_point_t, contact_set_t, pair_geometry, chain_by_wire, &
      clearance_of
   use litz_contact_search, only: near_segments
   use litz_contact_side, only: crossing_t, crossing_of, have_passed
   use litz_element_library, only: elements_t
   use litz_errors, only: error_t, fail, exit_memory
   use litz_model, only: model_t, axis_hermite
   use litz_parallel, only: worth_threads
   use litz_wires, only: wires_t, arc_from_to
   implicit none
   private
   public :: prepare_contact, find_candidates, candidates_hold, locate_points
   public :: are_joined, find_contact_pair, self_contact_distance

   !> Elements of one wire nearer along it than this many contact radii do not touch each other
   real(dp), parameter :: self_contact_distance = 8.0_dp
   !> A point this near to an end of its element, in units of xi, may be found again in the next element
   real(dp), parameter :: near_node = 1.0e-6_dp
   !> An axis may bend by this part of its length before candidates are collected anew
   real(dp), parameter :: bending = 0.05_dp
   !> Surface distance up to which an element pair is a candidate, in mean radii of the two
   real(dp), parameter :: skin = 1.0_dp
   !> Pairs of elements at most: four nodes of each are counted in default integers, beside two of each element
   integer, parameter :: max_candidates = 2**29 - 2**24
contains

   subroutine prepare_contact(model, elements, contact)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(out) :: contact
      integer :: p, e

      allocate (contact%points(0), contact%converged(0), contact%candidates(3, 0), contact%joined(3, 0))
      allocate (contact%clearance(size(model%contact_pairs)), source=0.0_dp)
      contact%converged_clearance = contact%clearance
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
      contact%members = pack([(e, e=1, model%n_elements)], any(contact%in_bar .or. contact%in_set, 2))
      allocate (contact%valid_sagitta(model%n_elements), source=0.0_dp)
      allocate (contact%valid_motion(model%n_nodes), source=huge(1.0_dp))
      do e = 1, model%n_elements
         if (.not. any(contact%in_bar(e, :) .or. contact%in_set(e, :))) cycle
         associate (nodes => model%connectivity(:, e))
            contact%valid_motion(nodes) = min(contact%valid_motion(nodes), skin*elements%radius(e)/2)
         end associate
      end do
   end subroutine prepare_contact

   !> Collect the element pairs that are near in the present positions, or were passed since the increment began.
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
      real(dp) :: p(3, 0:3)
      integer :: i, n_found
      logical :: too_many
      character(len=80) :: text

      changed = .false.
      associate (member => contact%members)
         allocate (reach(size(member)))
         do i = 1, size(member)
            associate (e => member(i), node => model%connectivity(:, member(i)))
               p = axis_of_element(model, wires, elements, e, x, rotation)
               contact%valid_sagitta(e) = axis_sagitta(p) + bending*elements%length(e)
               ! what the axis may leave its chord by, what its nodes and its bow have moved since the increment began,
               ! and half of the overlap it then had count as thickness
               reach(i) = (1 + skin/2)*elements%radius(e) + contact%depth/2 + contact%valid_sagitta(e) &
                  + sqrt(maxval(sum((x(:, node) - x_start(:, node))**2, 1))) &
                  + axis_sagitta(p - axis_of_element(model, wires, elements, e, x_start, rotation_start))
            end associate
         end do
         associate (first => model%connectivity(1, member), second => model%connectivity(2, member))
            call near_segments(x(:, first), x(:, second), reach, max_candidates, pairs, too_many)
         end associate
      end associate
      if (too_many) then
         write (text, '(a, i0, a, i0, a)') 'contact search: of ', size(contact%members), ' elements more than ', &
            max_candidates, ' pairs'
         error = fail(exit_memory, trim(text)//' lie within a radius of each other, which is more than can be'// &
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
      contact%joined = abs(reshape(pack(found, spread(found(3, :) < 0, 1, 3)), [3, count(found(3, :) < 0)]))
      n_found = 0
      do i = 1, size(found, 2)
         if (found(3, i) <= 0) cycle
         n_found = n_found + 1
         found(:, n_found) = found(:, i)
      end do
      contact%x_collected = x
      changed = size(contact%candidates, 2) /= n_found
      if (.not. changed) changed = any(contact%candidates /= found(:, :n_found))
      if (changed) contact%candidates = found(:, :n_found)
   end subroutine find_candidates

   !> The axis of an element in powers of xi (3, 0:3) [m].
   pure function axis_of_element(model, wires, elements, e, x, rotation) result(p)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      integer, intent(in) :: e
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      real(dp) :: p(3, 0:3), t(3, 2)
      integer :: side

      do side = 1, 2
         t(:, side) = matmul(rotation(:, :, model%connectivity(side, e)), wires%contact_tangents0(:, side, e))
      end do
      p = axis_polynomial(axis_hermite, elements%length(e), x(:, model%connectivity(:, e)), t)
   end function axis_of_element

   !> The candidates are still all that may touch: nothing has moved or bent too far since they were collected.
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
   end function candidates_hold

   !> Which element is the barred one, and by which contact pair they may touch; 0: none; negative: they would, but are
   !> joined.
   pure subroutine assign_roles(model, wires, elements, contact, a, b, roles, pair)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      integer, intent(in) :: a, b
      integer, intent(out) :: roles(2), pair

      call find_contact_pair(model, wires, contact, a, b, roles, pair)
      if (pair == 0) return
      if (are_joined(model, wires, elements, a, b)) pair = -pair
   end subroutine assign_roles

   !> Two elements are near to each other along their wire, or joined by a short path.
   pure logical function are_joined(model, wires, elements, a, b)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      integer, intent(in) :: a, b
      real(dp) :: separation, radius

      are_joined = .true.
      if (any(model%connectivity(:, a) == model%connectivity(1, b)) .or. &
         any(model%connectivity(:, a) == model%connectivity(2, b))) return
      radius = max(elements%radius(a), elements%radius(b))
      if (wires%wire(a) == wires%wire(b)) then
         separation = wires%arc_between(wires%wire(a), wires%arc(a), wires%arc(b)) &
            - (elements%length(a) + elements%length(b))/2
         if (separation < self_contact_distance*radius) return
      else if (wires%is_joined(wires%wire(a)) .and. wires%is_joined(wires%wire(b))) then
         if (joined_within(1) .or. joined_within(2)) return
      end if
      are_joined = .false.

   contains

      !> A short path along elements that share nodes leads from this end of the one element to the other element.
      pure logical function joined_within(side)
         integer, intent(in) :: side

         joined_within = leads_to(b, model%connectivity(side, a), a, self_contact_distance*radius, model, wires, &
            elements)
      end function joined_within

   end function are_joined

   !> The last contact pair that names both elements, and which of them is the barred one; 0: none.
   pure subroutine find_contact_pair(model, wires, contact, a, b, roles, pair)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(contact_set_t), intent(in) :: contact
      integer, intent(in) :: a, b
      integer, intent(out) :: roles(2), pair
      logical :: forward, backward

      roles = 0
      do pair = size(model%contact_pairs), 1, -1
         forward = contact%in_bar(a, pair) .and. contact%in_set(b, pair)
         backward = contact%in_bar(b, pair) .and. contact%in_set(a, pair)
         if (.not. (forward .or. backward)) cycle
         ! within one set the wire decides, so that the roles outlive a hand-over
         if (forward .and. backward) then
            forward = wires%wire(a) < wires%wire(b) .or. &
               (wires%wire(a) == wires%wire(b) .and. wires%arc(a) < wires%arc(b))
         end if
         roles = merge([a, b], [b, a], forward)
         return
      end do
      pair = 0
   end subroutine find_contact_pair

   !> Whether a path from a node, not back into the element it is reached by, leads to an element before its length is
   !> used up.
   pure recursive logical function leads_to(goal, node, from, length, model, wires, elements) result(leads)
      integer, intent(in) :: goal, node, from
      !> Length that is left [m]
      real(dp), intent(in) :: length
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      integer :: i, e

      leads = .false.
      do i = wires%first_at_node(node), wires%first_at_node(node + 1) - 1
         e = abs(wires%at_node(i))
         if (e == from) cycle
         leads = e == goal
         if (.not. leads .and. elements%length(e) < length) leads = leads_to(goal, &
            model%connectivity(merge(2, 1, wires%at_node(i) < 0), e), e, length - elements%length(e), model, wires, &
            elements)
         if (leads) return
      end do
   end function leads_to

   !> Find the crossings in the present configuration; points carry on the memory of those of the last call.
   !>
   !> Crossings with a gap beyond the skin are left out, if they were not passed in this increment or before.
   subroutine locate_points(model, wires, elements, x_start, rotation_start, x, rotation, contact)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes) when the increment began, and now
      real(dp), intent(in) :: x_start(:, :), rotation_start(:, :, :), x(:, :), rotation(:, :, :)
      type(contact_set_t), intent(inout) :: contact
      type(contact_point_t), allocatable :: old(:)
      real(dp), allocatable :: xi(:, :)
      !> The points of the last call, and of the last converged state, that the present ones continue; 0: none
      integer, allocatable :: origin(:), converged(:)
      !> The last converged points of each barred wire, as chains
      integer, allocatable :: first_converged(:), next_converged(:)
      integer, allocatable :: status(:)
      integer :: c, n

      n = size(contact%candidates, 2)
      allocate (xi(2, n), status(n))
      !$omp parallel do schedule(dynamic, 64) if (n >= worth_threads)
      do c = 1, n
         call closest(c, xi(:, c), status(c))
      end do
      !$omp end parallel do
      call move_alloc(contact%points, old)
      call collect
      call match_points(wires, elements, old, contact%points, origin)
      call match_points(wires, elements, contact%converged, contact%points, converged, &
         slides_of(model, wires, elements, contact%converged, x_start, x))
      contact%points%predecessor = converged
      call chain_by_wire(wires, contact%converged, first_converged, next_converged)
      !$omp parallel do schedule(static) if (size(contact%points) >= worth_threads)
      do c = 1, size(contact%points)
         call inherit(contact%points(c), origin(c), converged(c))
      end do
      !$omp end parallel do
      if (.not. all(contact%points%regular)) contact%points = pack(contact%points, contact%points%regular)

   contains

      subroutine closest(c, xi_c, status_c)
         integer, intent(in) :: c
         real(dp), intent(out) :: xi_c(2)
         integer, intent(out) :: status_c
         real(dp) :: xe(3, 4), t(3, 4), length(2), distance

         associate (eb => contact%candidates(1, c), e => contact%candidates(2, c), &
            axis => model%interactions(model%contact_pairs(contact%candidates(3, c))%interaction)%axis)
            call pair_geometry(model, wires, elements, eb, e, x, rotation, xe, t, length)
            distance = norm2(sum(xe(:, 1:2), 2) - sum(xe(:, 3:4), 2))/2 - sum(length) &
               - (1 + skin/2)*(elements%radius(eb) + elements%radius(e))
            ! wires that have passed each other are apart again
            if (distance > 0) distance = distance - contact%depth - relative_motion(eb, e)
            if (distance > 0) then
               xi_c = 0
               status_c = closest_beyond
               return
            end if
            call closest_points(xe, t, length, axis, xi_c(1), xi_c(2), status_c)
            if (status_c == closest_not_unique .and. all(abs(xi_c) <= 1 + end_tolerance)) status_c = closest_inside
         end associate
      end subroutine closest

      !> Bound on how far two elements have moved past each other since the increment began.
      pure real(dp) function relative_motion(eb, e) result(motion)
         integer, intent(in) :: eb, e
         real(dp) :: difference(3)
         integer :: a, b

         motion = 0
         do a = 1, 2
            do b = 1, 2
               associate (node_bar => model%connectivity(a, eb), node => model%connectivity(b, e))
                  difference = x(:, node_bar) - x_start(:, node_bar) - x(:, node) + x_start(:, node)
               end associate
               motion = max(motion, norm2(difference))
            end do
         end do
      end function relative_motion

      subroutine collect
         logical, allocatable :: keep(:)
         !> The last point on a node that each barred wire has so far, and the one before each of them
         integer, allocatable :: last_on_node(:), before(:)
         integer :: k, m

         allocate (keep(n))
         allocate (last_on_node(wires%n_wires), before(n), source=0)
         do k = 1, n
            keep(k) = status(k) == closest_inside
            if (.not. keep(k) .or. all(abs(xi(:, k)) < 1 - near_node)) cycle
            associate (last => last_on_node(wires%wire(contact%candidates(1, k))))
               keep(k) = .not. claimed_before(k, last, before)
               before(k) = last
               last = k
            end associate
         end do
         allocate (contact%points(count(keep)))
         m = 0
         do k = 1, n
            if (.not. keep(k)) cycle
            m = m + 1
            associate (point => contact%points(m))
               point%candidate = k
               point%element_bar = contact%candidates(1, k)
               point%element = contact%candidates(2, k)
               point%pair = contact%candidates(3, k)
               point%xi_bar = xi(1, k)
               point%xi = xi(2, k)
               point%arc_bar = arc_at(point%element_bar, point%xi_bar)
               point%arc = arc_at(point%element, point%xi)
            end associate
         end do
      end subroutine collect

      !> A point on a node may be found by both elements there: the first one keeps it.
      logical function claimed_before(k, last, before)
         !> A candidate, the last point on a node of the same barred wire, and the one before each of those
         integer, intent(in) :: k, last, before(:)
         integer :: other, j
         real(dp) :: distance

         claimed_before = .false.
         other = last
         do while (other > 0)
            do j = 1, 2
               associate (e => contact%candidates(j, k), e_other => contact%candidates(j, other))
                  if (wires%wire(e) /= wires%wire(e_other)) exit
                  distance = abs(arc_from_to(arc_at(e, xi(j, k)), arc_at(e_other, xi(j, other)), &
                     wires%circumference(wires%wire(e))))
                  if (distance > near_node*elements%length(e)) exit
               end associate
            end do
            claimed_before = j > 2
            if (claimed_before) return
            other = before(other)
         end do
      end function claimed_before

      pure real(dp) function arc_at(e, xi_e)
         integer, intent(in) :: e
         real(dp), intent(in) :: xi_e

         arc_at = wires%arc(e) + wires%direction(e)*xi_e*elements%length(e)/2
      end function arc_at

      !> What a point takes over: of the last iterate the predictions, of the last converged state its identity, its
      !> memory, and on which side of each other the wires are.
      subroutine inherit(point, from, from_converged)
         type(contact_point_t), intent(inout) :: point
         integer, intent(in) :: from, from_converged
         real(dp) :: xe(3, 4), t(3, 4), length(2)
         integer :: info

         if (from > 0) then
            point%predicted = old(from)%predicted
            point%predicted_gap = old(from)%predicted_gap
            point%mixed_force = old(from)%mixed_force
            point%friction_iteration = old(from)%friction_iteration
         end if
         if (from_converged > 0) then
            point%id = contact%converged(from_converged)%id
            point%history = contact%converged(from_converged)%history
            point%fit = contact%converged(from_converged)%fit
         end if
         associate (eb => point%element_bar, e => point%element, kinematics => point%kinematics, &
            axis => model%interactions(model%contact_pairs(point%pair)%interaction)%axis)
            call pair_geometry(model, wires, elements, eb, e, x, rotation, xe, t, length)
            call contact_kinematics(xe, t, length, axis, elements%radius([eb, e]), point%xi_bar, point%xi, 0, &
               kinematics, info)
            if (info == kinematics_ok) then
               point%start = crossing_at_start(point, from_converged)
               if (have_passed(point%start, crossing(point))) call contact_kinematics(xe, t, length, axis, &
                  elements%radius([eb, e]), point%xi_bar, point%xi, -kinematics%side, kinematics, info)
            end if
            point%regular = info == kinematics_ok
            point%gap = kinematics%gap + clearance_of(point%fit, contact%clearance(point%pair))
         end associate
      end subroutine inherit

      pure type(crossing_t) function crossing(point)
         type(contact_point_t), intent(in) :: point

         crossing = crossing_of(point%kinematics, wires%direction([point%element_bar, point%element]), &
            [point%arc_bar, point%arc])
      end function crossing

      !> The crossing of the same two wires when the increment began: the converged point that this one continues, or
      !> the nearest along the wires, or one that was too far open to be a point.
      type(crossing_t) function crossing_at_start(point, from_converged) result(start)
         type(contact_point_t), intent(in) :: point
         !> The converged point that it continues; 0: none
         integer, intent(in) :: from_converged
         integer :: k

         k = from_converged
         if (k == 0) k = nearest_converged(point)
         if (k > 0) then
            start = crossing(contact%converged(k))
         else if (point%kinematics%distance <= relative_motion(point%element_bar, point%element) + contact%depth &
            + sum(elements%radius([point%element_bar, point%element]))/2) then
            ! only axes that have moved so far can have passed each other
            start = crossing_in_start_geometry(point)
         end if
      end function crossing_at_start

      !> The converged point of the same two wires that is nearest along them; 0: none that can have slid here.
      pure integer function nearest_converged(point) result(nearest)
         type(contact_point_t), intent(in) :: point
         real(dp) :: distance, least
         integer :: k

         nearest = 0
         least = 2*relative_motion(point%element_bar, point%element) &
            + sum(elements%length([point%element_bar, point%element]))
         k = first_converged(wires%wire(point%element_bar))
         do while (k > 0)
            associate (other => contact%converged(k))
               if (wires%wire(other%element) == wires%wire(point%element)) then
                  distance = max(wires%arc_between(wires%wire(point%element_bar), other%arc_bar, point%arc_bar), &
                     wires%arc_between(wires%wire(point%element), other%arc, point%arc))
                  if (distance < least) then
                     least = distance
                     nearest = k
                  end if
               end if
            end associate
            k = next_converged(k)
         end do
      end function nearest_converged

      !> The crossing of these elements when the increment began, or of others of the same two wires that can have slid
      !> here. A wire that touches itself is asked about these two elements only.
      type(crossing_t) function crossing_in_start_geometry(point) result(start)
         type(contact_point_t), intent(in) :: point
         integer, allocatable :: near_bar(:), near(:)
         real(dp) :: motion
         integer :: i, j

         associate (eb => point%element_bar, e => point%element)
            start = crossing_of_elements(point, eb, e, search_limit)
            if (start%known .or. wires%wire(eb) == wires%wire(e)) return
            motion = relative_motion(eb, e)
            near_bar = elements_along(eb, motion)
            near = elements_along(e, motion)
            do i = 1, size(near_bar)
               do j = 1, size(near)
                  if (centre_distance(near_bar(i), near(j)) > elements%length(near_bar(i)) &
                     + elements%length(near(j)) + motion + sum(elements%radius([eb, e]))) cycle
                  start = crossing_of_elements(point, near_bar(i), near(j), 1 + end_tolerance)
                  if (start%known) return
               end do
            end do
         end associate
      end function crossing_in_start_geometry

      !> The crossing of two elements when the increment began, unknown if not within `|xi| < limit`.
      type(crossing_t) function crossing_of_elements(point, eb, e, limit) result(start)
         type(contact_point_t), intent(in) :: point
         integer, intent(in) :: eb, e
         real(dp), intent(in) :: limit
         type(contact_point_t) :: other
         real(dp) :: xe(3, 4), t(3, 4), length(2)
         integer :: info

         other%element_bar = eb
         other%element = e
         associate (axis => model%interactions(model%contact_pairs(point%pair)%interaction)%axis)
            call pair_geometry(model, wires, elements, eb, e, x_start, rotation_start, xe, t, length)
            call closest_points(xe, t, length, axis, other%xi_bar, other%xi, info)
            if (info == closest_parallel .or. info == closest_not_converged) return
            if (any(abs([other%xi_bar, other%xi]) >= limit)) return
            call contact_kinematics(xe, t, length, axis, elements%radius([eb, e]), other%xi_bar, other%xi, 0, &
               other%kinematics, info)
         end associate
         if (info /= kinematics_ok) return
         other%arc_bar = arc_at(eb, other%xi_bar)
         other%arc = arc_at(e, other%xi)
         start = crossing(other)
      end function crossing_of_elements

      !> Elements of the same wire that begin within a distance along it, this one included.
      pure function elements_along(e, distance) result(near)
         integer, intent(in) :: e
         real(dp), intent(in) :: distance
         integer, allocatable :: near(:)
         integer :: i

         associate (w => wires%wire(e))
            near = wires%element(wires%first(w):wires%first(w + 1) - 1)
            near = pack(near, [(wires%arc_between(w, wires%arc(e), wires%arc(near(i))) &
               - (elements%length(e) + elements%length(near(i)))/2 <= distance, i=1, size(near))])
         end associate
      end function elements_along

      !> Distance of the middles of two elements when the increment began.
      pure real(dp) function centre_distance(eb, e) result(distance)
         integer, intent(in) :: eb, e

         distance = norm2( &
            sum(x_start(:, model%connectivity(:, eb)), 2) - sum(x_start(:, model%connectivity(:, e)), 2))/2
      end function centre_distance

   end subroutine locate_points

end module litz_contact_pairs
