!> Which crossings there are: candidates from the broad phase, points from the closest points of the curves.
!>
!> A crossing belongs to the pair of wires, not of elements: when it slides over a node, the point of the next
!> element takes over its memory. The memory includes the normal, by which the gap keeps its sign when a step has
!> pushed the axes through each other: they have passed if the line between them has turned round. Only axes that have
!> moved far enough for that are asked; for all others the gap is what it is now.
module litz_contact_pairs
   use litz_kinds, only: dp, int64
   use litz_closest_points, only: closest_points, end_tolerance, search_limit, closest_inside, closest_beyond, &
      closest_not_unique, closest_parallel, closest_not_converged
   use litz_contact_history, only: contact_history_t
   use litz_contact_kinematics, only: contact_kinematics_t, contact_kinematics, kinematics_ok
   use litz_contact_search, only: near_segments
   use litz_element_library, only: elements_t
   use litz_errors, only: error_t, fail, exit_memory
   use litz_friction_iteration, only: friction_iteration_t
   use litz_friction_law, only: friction_law_t
   use litz_hertz, only: hertz_ellipse_t
   use litz_shared_conductors, only: shared_conductors_t
   use litz_model, only: model_t, axis_hermite
   use litz_parallel, only: worth_threads
   use litz_wires, only: wires_t, arc_from_to
   implicit none
   private
   public :: contact_point_t, contact_set_t
   public :: prepare_contact, find_candidates, locate_points, pair_geometry

   !> Elements of one wire nearer along it than this many contact radii do not touch each other
   real(dp), parameter :: self_contact_distance = 8.0_dp
   !> A point this near to an end of its element, in units of xi, may be found again in the next element
   real(dp), parameter :: near_node = 1.0e-6_dp
   !> Surface distance up to which an element pair is a candidate, in mean radii of the two
   real(dp), parameter :: skin = 1.0_dp
   !> Pairs of elements at most: four nodes of each are counted in default integers, beside two of each element
   integer, parameter :: most_candidates = 2**29 - 2**24
   !> Axes have passed each other if the cosine between the normals before and now is below this: turned by 120 degrees
   real(dp), parameter :: turned_round = -0.5_dp

   !> A crossing of two wires, open or closed.
   type :: contact_point_t
      integer :: id = 0
      !> Elements (barred first), positions in them, and the model's contact pair
      integer :: element_bar = 0, element = 0, pair = 0
      real(dp) :: xi_bar = 0, xi = 0
      !> Arc lengths along the two wires [m]
      real(dp) :: arc_bar = 0, arc = 0
      type(contact_kinematics_t) :: kinematics
      !> .false.: the axes are nearly parallel there, or touch along a line
      logical :: regular = .true.
      !> Hertz ellipse at the present angle, where a law needs it
      type(hertz_ellipse_t) :: ellipse
      !> The last iteration predicted the gap and the force of this point [m, N]
      logical :: predicted = .false.
      real(dp) :: predicted_gap = 0, mixed_force = 0
      !> Gap that the law sees: of the geometry, plus what is left of an interference fit [m]
      real(dp) :: gap = 0
      !> In contact as the iteration takes it (prediction) and as it is
      logical :: active = .false., closed = .false.
      !> Law at the present gap [N, N/m], and the force that this iteration linearises about
      real(dp) :: force = 0, stiffness = 0, iteration_force = 0
      !> Force of the geometric stiffness [N]; zero at first touch, where no force is known yet
      real(dp) :: geometric_force = 0
      !> Memory of the converged state: from when the increment began until it has converged
      type(contact_history_t) :: history
      !> Traction at the present place; as the barred wire feels it [N]
      type(friction_law_t) :: friction
      real(dp) :: traction_on_bar(3) = 0
      type(friction_iteration_t) :: friction_iteration
      !> Spot [m], conductance [S], current [A], voltage across the spot [V]
      real(dp) :: semi_major = 0, semi_minor = 0, conductance = 0, current = 0, voltage_gap = 0
      !> rho L0/(4 A) of both elements, 0 where the voltage is not corrected [ohm], and heat in them that the linear
      !> voltage misses [W] (theory section 7)
      real(dp) :: series_resistance(2) = 0, heat_inside(2) = 0
   end type contact_point_t

   type :: contact_set_t
      logical :: present = .false.
      !> Element belongs to the barred / the unbarred set of each contact pair (n_elements, n_pairs)
      logical, allocatable :: in_bar(:, :), in_set(:, :)
      !> Barred element, unbarred element, contact pair (3, n_candidates); sorted by the smaller, then the larger one
      integer, allocatable :: candidates(:, :)
      !> Positions of the nodes when the candidates were collected (3, n_nodes)
      real(dp), allocatable :: x_collected(:, :)
      !> Candidates hold while no node has moved by this much since they were collected (n_nodes) [m]
      real(dp), allocatable :: valid_motion(:)
      !> Elements with several contacts that carry a current
      type(shared_conductors_t) :: shared
      !> Largest overlap when the increment began [m]
      real(dp) :: depth = 0
      type(contact_point_t), allocatable :: points(:)
      !> The points of the last converged state
      type(contact_point_t), allocatable :: converged(:)
      !> Candidates that overlap although their axes run parallel: point contact cannot describe them
      integer :: n_parallel = 0
      integer :: last_id = 0
      !> Clearance that stands for the interference left at this time, one per contact pair [m]
      real(dp), allocatable :: clearance(:)
      !> The same in the last converged state
      real(dp), allocatable :: converged_clearance(:)
   end type contact_set_t

contains

   subroutine prepare_contact(model, elements, contact)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(out) :: contact
      integer :: p, e

      allocate (contact%points(0), contact%converged(0), contact%candidates(3, 0))
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
      allocate (contact%valid_motion(model%n_nodes), source=huge(1.0_dp))
      do e = 1, model%n_elements
         if (.not. any(contact%in_bar(e, :) .or. contact%in_set(e, :))) cycle
         associate (nodes => model%connectivity(:, e))
            contact%valid_motion(nodes) = min(contact%valid_motion(nodes), skin*elements%radius(e)/2)
         end associate
      end do
   end subroutine prepare_contact

   !> Collect the element pairs that are near in the present positions, or were passed since the increment began.
   subroutine find_candidates(model, wires, elements, x_start, x, contact, changed, error)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions at the start of the increment and now (3, n_nodes) [m]
      real(dp), intent(in) :: x_start(:, :), x(:, :)
      type(contact_set_t), intent(inout) :: contact
      !> The candidates are not those of the last call
      logical, intent(out) :: changed
      !> There are more than can be counted
      type(error_t), allocatable, intent(out) :: error
      integer, allocatable :: member(:), pairs(:, :), found(:, :)
      real(dp), allocatable :: reach(:)
      integer :: i, e, n_found
      logical :: too_many
      character(len=80) :: text

      changed = .false.
      member = pack([(e, e=1, model%n_elements)], any(contact%in_bar .or. contact%in_set, 2))
      allocate (reach(size(member)))
      do i = 1, size(member)
         associate (e => member(i), node => model%connectivity(:, member(i)))
            ! what the axis may leave its chord by, what it has moved since the increment began, and half of the overlap
            ! it then had count as thickness
            reach(i) = (1 + skin/2)*elements%radius(e) + contact%depth/2 &
               + elements%length(e)*sagitta_bound(wires, e) + sqrt(maxval(sum((x(:, node) - x_start(:, node))**2, 1)))
         end associate
      end do
      associate (first => model%connectivity(1, member), second => model%connectivity(2, member))
         call near_segments(x(:, first), x(:, second), reach, most_candidates, pairs, too_many)
      end associate
      if (too_many) then
         write (text, '(a, i0, a, i0, a)') 'contact search: of ', size(member), ' elements more than ', &
            most_candidates, ' pairs'
         error = fail(exit_memory, trim(text)//' lie within a radius of each other, which is more than can be'// &
            ' counted; name fewer wires in *CONTACT PAIR, or make the model smaller')
         return
      end if
      allocate (found(3, size(pairs, 2)))
      !$omp parallel do schedule(static) if (size(pairs, 2) >= worth_threads)
      do i = 1, size(pairs, 2)
         call assign_roles(model, wires, elements, contact, member(pairs(1, i)), member(pairs(2, i)), found(1:2, i), &
            found(3, i))
      end do
      !$omp end parallel do
      n_found = 0
      do i = 1, size(found, 2)
         if (found(3, i) == 0) cycle
         n_found = n_found + 1
         found(:, n_found) = found(:, i)
      end do
      contact%x_collected = x
      changed = size(contact%candidates, 2) /= n_found
      if (.not. changed) changed = any(contact%candidates /= found(:, :n_found))
      if (changed) contact%candidates = found(:, :n_found)
   end subroutine find_candidates

   !> How far the axis of an element may leave its chord, as a fraction of its length.
   pure real(dp) function sagitta_bound(wires, e) result(bound)
      type(wires_t), intent(in) :: wires
      integer, intent(in) :: e

      associate (axes => wires%triads0(:, :, :, e))
         ! twice the reference sagitta of an arc with these end tangents, and room for bending in the increment
         bound = 0.05_dp + acos(min(1.0_dp, max(-1.0_dp, dot_product(axes(:, 1, 1), axes(:, 1, 2)))))/4
      end associate
   end function sagitta_bound

   !> Which element is the barred one, and by which contact pair they may touch (the last one that names both); 0: none.
   pure subroutine assign_roles(model, wires, elements, contact, a, b, roles, pair)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      integer, intent(in) :: a, b
      integer, intent(out) :: roles(2), pair
      real(dp) :: separation
      logical :: forward, backward

      roles = 0
      pair = 0
      if (any(model%connectivity(:, a) == model%connectivity(1, b)) .or. &
         any(model%connectivity(:, a) == model%connectivity(2, b))) return
      if (wires%wire(a) == wires%wire(b)) then
         separation = abs(arc_from_to(wires%arc(a), wires%arc(b), wires%circumference(wires%wire(a))))
         separation = separation - (elements%length(a) + elements%length(b))/2
         if (separation < self_contact_distance*max(elements%radius(a), elements%radius(b))) return
      end if
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
   end subroutine assign_roles

   !> Find the crossings in the present configuration; points carry on the memory of those of the last call.
   !>
   !> Crossings with a gap beyond the skin are left out, if they were not passed in this increment or before.
   subroutine locate_points(model, wires, elements, x_start, x, rotation, contact)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      real(dp), intent(in) :: x_start(:, :), x(:, :), rotation(:, :, :)
      type(contact_set_t), intent(inout) :: contact
      type(contact_point_t), allocatable :: old(:)
      real(dp), allocatable :: xi(:, :)
      integer, allocatable :: status(:), origin(:)
      integer :: c, n

      n = size(contact%candidates, 2)
      allocate (xi(2, n), status(n))
      !$omp parallel do schedule(dynamic, 64) if (n >= worth_threads)
      do c = 1, n
         call closest(c, xi(:, c), status(c))
      end do
      !$omp end parallel do
      contact%n_parallel = count(status == closest_parallel)
      call move_alloc(contact%points, old)
      call collect
      call match_points(wires, elements, old, contact%points, origin)
      !$omp parallel do schedule(static) if (size(contact%points) >= worth_threads)
      do c = 1, size(contact%points)
         call inherit(contact%points(c), origin(c))
      end do
      !$omp end parallel do
      call recall_history(wires, elements, contact)
      contact%n_parallel = contact%n_parallel + count(.not. contact%points%regular .and. contact%points%gap < 0)
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
            if (status_c == closest_parallel) then
               distance = norm2(on_chord(xe(:, 1:2), xi_c(1)) - on_chord(xe(:, 3:4), xi_c(2)))
               if (distance > elements%radius(eb) + elements%radius(e)) status_c = closest_beyond
            end if
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

      pure function on_chord(ends, xi_e) result(point)
         real(dp), intent(in) :: ends(3, 2), xi_e
         real(dp) :: point(3)

         point = (1 - xi_e)/2*ends(:, 1) + (1 + xi_e)/2*ends(:, 2)
      end function on_chord

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

      subroutine inherit(point, from)
         type(contact_point_t), intent(inout) :: point
         integer, intent(in) :: from
         real(dp) :: xe(3, 4), t(3, 4), length(2), normal_before(3)
         integer :: info

         normal_before = 0
         if (from > 0) then
            point%id = old(from)%id
            point%predicted = old(from)%predicted
            point%predicted_gap = old(from)%predicted_gap
            point%mixed_force = old(from)%mixed_force
            point%friction_iteration = old(from)%friction_iteration
            normal_before = old(from)%kinematics%normal
         end if
         associate (eb => point%element_bar, e => point%element, kinematics => point%kinematics, &
            axis => model%interactions(model%contact_pairs(point%pair)%interaction)%axis)
            call pair_geometry(model, wires, elements, eb, e, x, rotation, xe, t, length)
            call contact_kinematics(xe, t, length, axis, elements%radius([eb, e]), point%xi_bar, point%xi, 0, &
               kinematics, info)
            if (may_have_passed(eb, e, kinematics%distance)) then
               if (from == 0) normal_before = normal_at_start(eb, e, axis)
               if (dot_product(normal_before, kinematics%normal) < turned_round) then
                  call contact_kinematics(xe, t, length, axis, elements%radius([eb, e]), point%xi_bar, point%xi, &
                     -kinematics%side, kinematics, info)
               end if
            end if
            point%regular = info == kinematics_ok
            point%gap = kinematics%gap + contact%clearance(point%pair)
         end associate
      end subroutine inherit

      !> Whether two axes at this distance may lie on the wrong side of each other: they have moved that far since the
      !> increment began, or had been there before. Axes that bend move by a little more than their nodes.
      pure logical function may_have_passed(eb, e, distance)
         integer, intent(in) :: eb, e
         real(dp), intent(in) :: distance

         may_have_passed = distance <= relative_motion(eb, e) + contact%depth + sum(elements%radius([eb, e]))/2
      end function may_have_passed

      !> Direction from the unbarred to the barred wire at a crossing without memory when the increment began, be it in
      !> other elements of the same two wires; 0 if it was not one then. A wire that touches itself is asked about these
      !> two elements only.
      function normal_at_start(eb, e, axis) result(normal)
         integer, intent(in) :: eb, e, axis
         real(dp) :: normal(3)
         real(dp) :: motion
         integer :: i, j, near_bar(2), near(2)

         motion = relative_motion(eb, e)
         normal = normal_of_elements(eb, e, axis, search_limit)
         if (any(abs(normal) > 0) .or. wires%wire(eb) == wires%wire(e)) return
         near_bar = elements_along(eb, motion)
         near = elements_along(e, motion)
         do i = near_bar(1), near_bar(2)
            do j = near(1), near(2)
               associate (other_bar => wires%element(i), other => wires%element(j))
                  if (centre_distance(other_bar, other) > elements%length(other_bar) + elements%length(other) + motion &
                     + elements%radius(eb) + elements%radius(e)) cycle
                  normal = normal_of_elements(other_bar, other, axis, 1 + end_tolerance)
                  if (any(abs(normal) > 0)) return
               end associate
            end do
         end do
      end function normal_at_start

      !> First and last element of the same wire, in the order of `wires%element`, that lie within a distance along it.
      pure function elements_along(e, distance) result(range)
         integer, intent(in) :: e
         real(dp), intent(in) :: distance
         integer :: range(2)

         range = wires%place(e)
         associate (w => wires%wire(e))
            do while (range(1) > wires%first(w))
               if (arc_between(e, wires%element(range(1) - 1)) > distance) exit
               range(1) = range(1) - 1
            end do
            do while (range(2) < wires%first(w + 1) - 1)
               if (arc_between(e, wires%element(range(2) + 1)) > distance) exit
               range(2) = range(2) + 1
            end do
         end associate
      end function elements_along

      !> Length of wire between the nearest ends of two of its elements.
      pure real(dp) function arc_between(a, b)
         integer, intent(in) :: a, b

         arc_between = abs(wires%arc(a) - wires%arc(b)) - (elements%length(a) + elements%length(b))/2
      end function arc_between

      !> Distance of the middles of two elements when the increment began.
      pure real(dp) function centre_distance(eb, e) result(distance)
         integer, intent(in) :: eb, e

         distance = norm2( &
            sum(x_start(:, model%connectivity(:, eb)), 2) - sum(x_start(:, model%connectivity(:, e)), 2))/2
      end function centre_distance

      !> Unit vector between the closest points of two elements when the increment began; 0 if not within
      !> `|xi| < limit`.
      function normal_of_elements(eb, e, axis, limit) result(normal)
         integer, intent(in) :: eb, e, axis
         real(dp), intent(in) :: limit
         real(dp) :: normal(3)
         real(dp) :: xe(3, 4), t(3, 4), length(2), xi_start(2), w(3)
         integer :: status_start

         normal = 0
         call pair_geometry(model, wires, elements, eb, e, x_start, rotation, xe, t, length)
         t(:, 1:2) = spread(xe(:, 2) - xe(:, 1), 2, 2)/norm2(xe(:, 2) - xe(:, 1))
         t(:, 3:4) = spread(xe(:, 4) - xe(:, 3), 2, 2)/norm2(xe(:, 4) - xe(:, 3))
         call closest_points(xe, t, length, axis, xi_start(1), xi_start(2), status_start)
         if (status_start == closest_parallel .or. status_start == closest_not_converged) return
         if (any(abs(xi_start) >= limit)) return
         w = on_chord(xe(:, 1:2), xi_start(1)) - on_chord(xe(:, 3:4), xi_start(2))
         if (norm2(w) > 0) normal = w/norm2(w)
      end function normal_of_elements

   end subroutine locate_points

   !> Each point remembers what it was in the converged state, whatever the iteration has been through since.
   subroutine recall_history(wires, elements, contact)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(inout) :: contact
      integer, allocatable :: origin(:)
      integer :: i

      if (.not. any(contact%converged%history%closed)) return
      call match_points(wires, elements, contact%converged, contact%points, origin)
      do i = 1, size(contact%points)
         if (origin(i) > 0) contact%points(i)%history = contact%converged(origin(i))%history
      end do
   end subroutine recall_history

   !> Nodal positions and tangents, barred element first, as the kernels want them.
   pure subroutine pair_geometry(model, wires, elements, eb, e, x, rotation, xe, t, length)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      integer, intent(in) :: eb, e
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      real(dp), intent(out) :: xe(3, 4), t(3, 4), length(2)
      integer :: side

      do side = 1, 2
         associate (node_bar => model%connectivity(side, eb), node => model%connectivity(side, e))
            xe(:, side) = x(:, node_bar)
            xe(:, 2 + side) = x(:, node)
            t(:, side) = matmul(rotation(:, :, node_bar), wires%triads0(:, 1, side, eb))
            t(:, 2 + side) = matmul(rotation(:, :, node), wires%triads0(:, 1, side, e))
         end associate
      end do
      length = elements%length([eb, e])
   end subroutine pair_geometry

   !> For each point the one of the last call that it continues; 0: none.
   !>
   !> First by the pair of elements; what is left by the nearest place on the same two wires (a hand-over).
   subroutine match_points(wires, elements, old, points, origin)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: old(:), points(:)
      integer, allocatable, intent(out) :: origin(:)
      logical :: taken(size(old))
      !> The points that are left of each barred wire, as a chain
      integer :: first_left(wires%n_wires), next_left(size(old))
      integer(int64) :: key
      integer :: i, j
      real(dp) :: distance, nearest

      allocate (origin(size(points)), source=0)
      taken = .false.
      j = 1
      do i = 1, size(points)
         key = pair_key(points(i))
         do while (j <= size(old))
            if (pair_key(old(j)) >= key) exit
            j = j + 1
         end do
         if (j > size(old)) exit
         if (pair_key(old(j)) == key) then
            origin(i) = j
            taken(j) = .true.
         end if
      end do
      if (all(taken)) return
      first_left = 0
      do j = size(old), 1, -1
         if (taken(j)) cycle
         associate (first => first_left(wires%wire(old(j)%element_bar)))
            next_left(j) = first
            first = j
         end associate
      end do
      do i = 1, size(points)
         if (origin(i) /= 0) cycle
         nearest = elements%length(points(i)%element_bar) + elements%length(points(i)%element)
         j = first_left(wires%wire(points(i)%element_bar))
         do while (j > 0)
            if (.not. taken(j) .and. wires%wire(old(j)%element) == wires%wire(points(i)%element)) then
               distance = sum(abs(arc_from_to([old(j)%arc_bar, old(j)%arc], [points(i)%arc_bar, points(i)%arc], &
                  wires%circumference(wires%wire([points(i)%element_bar, points(i)%element])))))
               if (distance < nearest) then
                  nearest = distance
                  origin(i) = j
               end if
            end if
            j = next_left(j)
         end do
         if (origin(i) > 0) taken(origin(i)) = .true.
      end do

   contains

      pure integer(int64) function pair_key(point)
         type(contact_point_t), intent(in) :: point

         pair_key = int(min(point%element_bar, point%element), int64)*size(wires%wire) &
            + max(point%element_bar, point%element)
      end function pair_key

   end subroutine match_points

end module litz_contact_pairs
