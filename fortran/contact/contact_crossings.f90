!> Where wires touch at points: a point for each candidate whose axes are nearest to each other within both elements, or
!> at an end or a kink of one of them (litz_contact_ends).
!>
!> A crossing belongs to the pair of wires, not of elements, so that points take over the memory of those before them
!> (litz_contact_matching). On which side of each other the two wires are is a fact of the last converged state
!> (litz_contact_side): an iterate that has pushed the axes through each other has a gap below minus both radii.
module litz_contact_crossings
   use litz_kinds, only: dp
   use litz_axis, only: axis_polynomial, axis_sagitta, axis_shape, on_axis
   use litz_bent_contacts, only: see_bends
   use litz_closest_points, only: closest_points, max_minima, closest_inside, closest_beyond, closest_not_unique, &
      closest_parallel
   use litz_contact_candidates, only: skin
   use litz_contact_ends, only: minimum_t, add_ends, max_ends
   use litz_contact_kinematics, only: contact_kinematics, fix_angle, kinematics_ok
   use litz_contact_legs, only: measure_legs
   use litz_contact_lens, only: is_at_cut_end
   use litz_contact_matching, only: match_points, slides_of
   use litz_contact_points, only: contact_point_t, contact_set_t, points_by_wire_t, pair_geometry, axis_of_pair, &
      away_from, arc_at, crossing_at, clearance_of, add_taper, chain_by_wire, inherit
   use litz_contact_side, only: have_passed
   use litz_element_library, only: elements_t
   use litz_end_kinematics, only: end_kinematics
   use litz_joint_radii, only: add_balls, largest_radius
   use litz_model, only: model_t, axis_hermite
   use litz_parallel, only: worth_threads
   use litz_settled_angles, only: holds_angle, settle_angle
   use litz_start_crossings, only: crossing_at_start, relative_motion
   use litz_straight_segments, only: segment_distance
   use litz_wires, only: wires_t, arc_from_to
   implicit none
   private
   public :: locate_points

   !> A point this near to an end of its element, in units of xi, may be found again in the next element
   real(dp), parameter :: near_node = 1.0e-6_dp
   !> The curvature of the axes has a jump at a node, and by it two elements find one place at different distances from
   !> there. One that is beyond the end of its element is that of the next element up to here
   real(dp), parameter :: near_jump = 1.0e-3_dp
   !> Further places at which one pair of elements may touch
   integer, parameter :: max_others = 3

   !> Where the elements of a candidate are nearest to each other, the nearest place of both axes first.
   type :: minima_t
      type(minimum_t) :: at(1 + max_others + max_ends)
      integer :: n = 0
   end type minima_t

   !> A minimum of a candidate, of which there may be several at one place.
   type :: found_t
      integer :: candidate = 0
      !> Elements, and places in them
      integer :: element_bar = 0, element = 0
      real(dp) :: xi_bar = 0, xi = 0
      !> At a round end or joint of the barred, of the unbarred wire
      logical :: held(2) = .false.
   end type found_t

contains

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
      type(contact_point_t), allocatable :: old(:), points(:)
      type(points_by_wire_t) :: converged_by_wire
      !> Of each candidate
      type(minima_t), allocatable :: minima(:)
      !> The points of the last call, and of the last converged state, that the present ones continue; 0: none
      integer, allocatable :: origin(:), converged(:)
      integer :: i, n

      n = size(contact%candidates, 2)
      allocate (minima(n))
      !$omp parallel do schedule(dynamic, 64) if (n >= worth_threads)
      do i = 1, n
         call find_closest(model, wires, elements, contact, contact%candidates(:, i), x_start, x, rotation, minima(i))
      end do
      !$omp end parallel do
      call move_alloc(contact%points, old)
      call collect_points(model, wires, elements, contact%candidates, minima, points)
      call match_points(wires, elements, old, points, origin)
      call match_points(wires, elements, contact%converged, points, converged, &
         slides_of(model, wires, elements, contact%converged, x_start, x))
      points%predecessor = converged
      converged_by_wire = chain_by_wire(wires, contact%converged)
      !$omp parallel do schedule(static) if (size(points) >= worth_threads)
      do i = 1, size(points)
         call inherit(old, origin(i), contact%converged, converged(i), points(i))
         call set_geometry(model, wires, elements, contact, converged_by_wire, converged(i), x_start, rotation_start, &
            x, rotation, points(i))
      end do
      !$omp end parallel do
      if (.not. all(points%regular)) points = pack(points, points%regular)
      call move_alloc(points, contact%points)
   end subroutine locate_points

   !> Where the axes of a candidate are nearest to each other.
   pure subroutine find_closest(model, wires, elements, contact, candidate, x_start, x, rotation, minima)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the largest overlap when the increment began
      type(contact_set_t), intent(in) :: contact
      !> Barred element, unbarred element, contact pair (3)
      integer, intent(in) :: candidate(3)
      !> Positions (3, n_nodes) when the increment began, and now [m]; rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x_start(:, :), x(:, :), rotation(:, :, :)
      type(minima_t), intent(out) :: minima
      real(dp) :: xe(3, 4), t(3, 4), length(2), distance, nearest(2), others(2, max_minima)
      integer :: status, i, n_others

      associate (eb => candidate(1), e => candidate(2))
         call pair_geometry(model, wires, elements, eb, e, x, rotation, xe, t, length)
         distance = least_distance(axis_of_pair(model, candidate(3)), xe, t, length) &
            - (1 + skin/2)*(largest_radius(wires, elements, eb) + largest_radius(wires, elements, e))
         ! wires that have passed each other are apart again
         if (distance > 0) distance = distance - contact%depth - relative_motion(model, x_start, x, eb, e)
         if (distance > 0) return
         call closest_points(xe, t, length, axis_of_pair(model, candidate(3)), nearest(1), nearest(2), status, &
            others=others, n_others=n_others)
         ! both elements at a node find a point there, and the first one has it: it does not go from one to the other
         ! as the iteration moves it by round-off
         if (any(status == [closest_inside, closest_beyond, closest_not_unique, closest_parallel]) .and. &
            all(abs(nearest) <= 1 + near_node)) minima%n = 1
         minima%at(1)%xi = nearest
         do i = 1, min(n_others, max_others)
            minima%n = minima%n + 1
            minima%at(minima%n)%xi = others(:, i)
         end do
      end associate
      call add_ends(model, wires, elements, contact, candidate, x, rotation, minima%at, minima%n)
   end subroutine find_closest

   !> Lower bound of the distance of two axes [m].
   pure real(dp) function least_distance(axis, x, t, length) result(distance)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> Nodal positions [m] and unit tangents (3, 4), reference lengths (2) [m]: barred first
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      integer :: side

      ! what a look at the middles of both can tell
      distance = norm2(sum(x(:, 1:2), 2) - sum(x(:, 3:4), 2))/2 - sum(length)
      if (distance > 0) return
      distance = segment_distance(x)
      do side = 1, 2
         distance = distance - axis_sagitta(axis_polynomial(axis, length(side), x(:, 2*side - 1:2*side), &
            t(:, 2*side - 1:2*side)))
      end do
   end function least_distance

   !> Points without memory for the candidates that touch.
   pure subroutine collect_points(model, wires, elements, candidates, minima, points)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Barred element, unbarred element, contact pair (3, n_candidates)
      integer, intent(in) :: candidates(:, :)
      !> (n_candidates)
      type(minima_t), intent(in) :: minima(:)
      type(contact_point_t), allocatable, intent(out) :: points(:)
      type(found_t), allocatable :: found(:)
      integer :: k, i, m

      allocate (found(sum(minima%n)))
      m = 0
      do k = 1, size(minima)
         do i = 1, minima(k)%n
            m = m + 1
            associate (minimum => minima(k)%at(i))
               found(m) = found_t(k, candidates(1, k), candidates(2, k), minimum%xi(1), minimum%xi(2), minimum%held)
            end associate
         end do
      end do
      found = pack(found, are_new(model, wires, elements, found))
      allocate (points(size(found)))
      do i = 1, size(found)
         associate (point => points(i), place => found(i))
            point%candidate = place%candidate
            point%element_bar = place%element_bar
            point%element = place%element
            point%pair = candidates(3, place%candidate)
            point%xi_bar = place%xi_bar
            point%xi = place%xi
            point%held = place%held
            point%arc_bar = arc_at(wires, elements, place%element_bar, place%xi_bar)
            point%arc = arc_at(wires, elements, place%element, place%xi)
         end associate
      end do
   end subroutine collect_points

   !> Each contact once (n_points): one at a node may be found by all elements there, and the first one keeps it, of
   !> those that have found an end or a joint if any has.
   pure function are_new(model, wires, elements, points) result(keep)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(found_t), intent(in) :: points(:)
      logical :: keep(size(points))
      !> The last point so far at each node of a barred wire, and behind these elsewhere on each barred wire, and the
      !> one before each point
      integer :: last_at(model%n_nodes + wires%n_wires), before(size(points))
      integer :: k, place, earlier

      last_at = 0
      before = 0
      keep = .true.
      do k = 1, size(points)
         if (all(abs([points(k)%xi_bar, points(k)%xi]) < 1 - near_jump)) cycle
         place = chain_at(points(k)%element_bar, points(k)%xi_bar, near_jump)
         earlier = found_at(points(k)%element_bar, points(k)%xi_bar)
         ! where the arc lengths of a closed wire begin, its elements change their roles
         if (earlier == 0 .and. wires%wire(points(k)%element) == wires%wire(points(k)%element_bar)) earlier = &
            found_at(points(k)%element, points(k)%xi)
         if (earlier > 0) then
            ! an end or a joint is one, whichever element has the nearest place there
            keep(k) = keep(earlier) .and. any(points(k)%held .and. .not. points(earlier)%held)
            if (.not. keep(k)) cycle
            keep(earlier) = .false.
         end if
         before(k) = last_at(place)
         last_at(place) = k
      end do

   contains

      !> The last point before this one at the same place of both wires, one of which is here; 0: none.
      pure integer function found_at(e, xi)
         !> Element
         integer, intent(in) :: e
         !> Place in it
         real(dp), intent(in) :: xi
         integer :: chain(2)

         ! the same place may be in another chain by round-off
         chain = [chain_at(e, xi, near_jump/2), chain_at(e, xi, 2*near_jump)]
         found_at = found_before(model, wires, elements, points, k, last_at(chain(1)), before)
         if (found_at == 0 .and. chain(2) /= chain(1)) found_at = found_before(model, wires, elements, points, k, &
            last_at(chain(2)), before)
      end function found_at

      !> The chain of points at a place of a barred wire: of its node, or of the wire.
      pure integer function chain_at(e, xi, near)
         !> Element
         integer, intent(in) :: e
         !> Place in it, and how far from a node it still is at it
         real(dp), intent(in) :: xi, near

         chain_at = node_at(model, e, xi, near)
         if (chain_at == 0) chain_at = model%n_nodes + wires%wire(e)
      end function chain_at

   end function are_new

   !> Node at a place of an element; 0: it lies between.
   pure integer function node_at(model, e, xi, near) result(node)
      type(model_t), intent(in) :: model
      !> Element
      integer, intent(in) :: e
      !> Place in it, and how far from a node it still is at it
      real(dp), intent(in) :: xi, near

      node = 0
      if (abs(xi) >= 1 - near) node = model%connectivity(merge(1, 2, xi < 0), e)
   end function node_at

   !> The last one of the points before this one that is at the same place of both wires; 0: none.
   pure integer function found_before(model, wires, elements, points, k, last, before) result(other)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(found_t), intent(in) :: points(:)
      !> A point, the last one there, and the one before each point (n_points)
      integer, intent(in) :: k, last, before(:)
      real(dp) :: near
      logical :: found

      other = last
      do while (other > 0)
         associate (point => points(k), earlier => points(other))
            near = near_node
            if (any(abs([point%xi_bar, point%xi, earlier%xi_bar, earlier%xi]) > 1)) near = near_jump
            found = is_same(point%element_bar, point%xi_bar, earlier%element_bar, earlier%xi_bar) .and. &
               is_same(point%element, point%xi, earlier%element, earlier%xi)
            if (.not. found .and. wires%wire(point%element) == wires%wire(point%element_bar)) found = &
               is_same(point%element_bar, point%xi_bar, earlier%element, earlier%xi) .and. &
               is_same(point%element, point%xi, earlier%element_bar, earlier%xi_bar)
         end associate
         if (found) return
         other = before(other)
      end do

   contains

      !> The same node, or the same place of one wire.
      pure logical function is_same(e, xi, e_other, xi_other)
         !> Elements
         integer, intent(in) :: e, e_other
         !> Places in them
         real(dp), intent(in) :: xi, xi_other
         integer :: node

         node = node_at(model, e, xi, near)
         is_same = node > 0 .and. node == node_at(model, e_other, xi_other, near)
         if (is_same .or. wires%wire(e) /= wires%wire(e_other)) return
         is_same = abs(arc_from_to(arc_at(wires, elements, e, xi), arc_at(wires, elements, e_other, xi_other), &
            wires%circumference(wires%wire(e)))) <= near*elements%length(e)
      end function is_same

   end function found_before

   !> Kinematics and gap of a point, on the side that its wires had in the last converged state.
   pure subroutine set_geometry(model, wires, elements, contact, converged_by_wire, from_converged, x_start, &
      rotation_start, x, rotation, point)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the points of the last converged state, and these by their barred wires
      type(contact_set_t), intent(in) :: contact
      type(points_by_wire_t), intent(in) :: converged_by_wire
      !> The converged point that this one continues; 0: none
      integer, intent(in) :: from_converged
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes) when the increment began, and now
      real(dp), intent(in) :: x_start(:, :), rotation_start(:, :, :), x(:, :), rotation(:, :, :)
      type(contact_point_t), intent(inout) :: point
      real(dp) :: xe(3, 4), t(3, 4), length(2)
      integer :: axis, info
      logical :: places_stay

      axis = axis_of_pair(model, point%pair)
      associate (eb => point%element_bar, e => point%element, kinematics => point%kinematics)
         call pair_geometry(model, wires, elements, eb, e, x, rotation, xe, t, length)
         if (any(point%held)) then
            call end_kinematics(xe, t, length, axis, elements%radius([eb, e]), point%xi_bar, point%xi, point%held, &
               point%normal_before, kinematics, info)
            if (from_converged > 0) point%start = crossing_at(wires, contact%converged(from_converged))
         else
            call contact_kinematics(xe, t, length, axis, elements%radius([eb, e]), point%xi_bar, point%xi, 0, &
               kinematics, info)
         end if
         if (info == kinematics_ok .and. .not. any(point%held)) then
            point%start = crossing_at_start(model, wires, elements, contact, converged_by_wire, x_start, &
               rotation_start, relative_motion(model, x_start, x, eb, e), point, from_converged)
            if (have_passed(point%start, crossing_at(wires, point))) call contact_kinematics(xe, t, length, axis, &
               elements%radius([eb, e]), point%xi_bar, point%xi, -kinematics%side, kinematics, info)
         end if
         places_stay = holds_angle(point)
         if (.not. places_stay) call settle_angle(point)
         if (info == kinematics_ok .and. point%fixed_share > 0 .and. .not. any(point%held)) call fix_angle(xe, t, &
            length, axis, point%angle_at, point%fixed_share, kinematics)
         if (info == kinematics_ok) call set_tangents(model, wires, elements, axis, x, rotation, xe, t, length, point)
         point%regular = info == kinematics_ok
         call add_taper(elements%taper([eb, e]), kinematics)
         call add_balls(wires, elements, point)
         point%gap = kinematics%gap + clearance_of(point%fit, contact%clearance(point%pair))
      end associate
      if (point%regular) call see_bends(model, wires, elements, x, rotation, model%interactions(model%contact_pairs( &
         point%pair)%interaction)%normal, (point%bends%are_known), places_stay, point)
      if (point%regular) call measure_legs(model, wires, elements, axis, x, rotation, point)
   end subroutine set_geometry

   !> Tangents of the axes where they move along their wires, and where they are held at free ends.
   pure subroutine set_tangents(model, wires, elements, axis, x, rotation, xe, t, length, point)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      !> Nodal positions [m] and unit tangents (3, 4), reference lengths (2) [m]: barred first
      real(dp), intent(in) :: xe(3, 4), t(3, 4), length(2)
      type(contact_point_t), intent(inout) :: point
      real(dp) :: h(4), h1(4), h2(4), xi(2)
      integer :: i, pair(2)

      xi = [point%xi_bar, point%xi]
      pair = [point%element_bar, point%element]
      do i = 1, 2
         if (.not. point%held(i)) then
            call axis_shape(axis, length(i), xi(i), h, h1, h2)
            point%tangent(:, i) = on_axis(h1, xe(:, 2*i - 1:2*i), t(:, 2*i - 1:2*i))
            cycle
         end if
         point%at_end(i) = is_at_cut_end(wires, elements, pair(i), merge(point%arc_bar, point%arc, i == 1), &
            minval(elements%radius(pair)))
         if (point%at_end(i)) point%tangent(:, i) = inward_tangent(pair(i), xi(i))
      end do

   contains

      !> From an end of an element into it (3): along its axis, or along the way to its other node over its length.
      pure function inward_tangent(e, end) result(tangent)
         !> Element
         integer, intent(in) :: e
         !> -1 or 1
         real(dp), intent(in) :: end
         real(dp) :: tangent(3)

         tangent = away_from(model, wires, axis, e, merge(1, 2, end < 0), x, rotation)
         if (axis == axis_hermite) return
         associate (node => model%connectivity(:, e))
            tangent = tangent*norm2(x(:, node(2)) - x(:, node(1)))/elements%length(e)
         end associate
      end function inward_tangent

   end subroutine set_tangents

end module litz_contact_crossings
