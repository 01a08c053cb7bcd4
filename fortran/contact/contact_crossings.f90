!> Where wires cross: a point for each candidate whose axes are nearest to each other within both elements.
!>
!> A crossing belongs to the pair of wires, not of elements, so that points take over the memory of those before them
!> (litz_contact_matching). On which side of each other the two wires are is a fact of the last converged state
!> (litz_contact_side): an iterate that has pushed the axes through each other has a gap below minus both radii.
module litz_contact_crossings
   use litz_kinds, only: dp
   use litz_closest_points, only: closest_points, end_tolerance, max_minima, closest_inside, closest_not_unique, &
      closest_parallel
   use litz_contact_candidates, only: skin
   use litz_contact_kinematics, only: contact_kinematics, kinematics_ok
   use litz_contact_matching, only: match_points, slides_of
   use litz_contact_points, only: contact_point_t, contact_set_t, points_by_wire_t, pair_geometry, axis_of_pair, &
      arc_at, crossing_at, clearance_of, chain_by_wire, inherit
   use litz_contact_side, only: have_passed
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_parallel, only: worth_threads
   use litz_start_crossings, only: crossing_at_start, relative_motion
   use litz_wires, only: wires_t, arc_from_to
   implicit none
   private
   public :: locate_points

   !> A point this near to an end of its element, in units of xi, may be found again in the next element
   real(dp), parameter :: near_node = 1.0e-6_dp
   !> Further places at which one pair of elements may touch
   integer, parameter :: max_others = 3

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
      !> Where each candidate crosses: the nearest place and others (2, 1 + max_others, n_candidates), and how many
      real(dp), allocatable :: xi(:, :, :)
      integer, allocatable :: n_minima(:)
      !> The points of the last call, and of the last converged state, that the present ones continue; 0: none
      integer, allocatable :: origin(:), converged(:)
      integer :: i, n

      n = size(contact%candidates, 2)
      allocate (xi(2, 1 + max_others, n), n_minima(n))
      !$omp parallel do schedule(dynamic, 64) if (n >= worth_threads)
      do i = 1, n
         call find_closest(model, wires, elements, contact%candidates(:, i), contact%depth, x_start, x, rotation, &
            xi(:, :, i), n_minima(i))
      end do
      !$omp end parallel do
      call move_alloc(contact%points, old)
      call collect_points(wires, elements, contact%candidates, xi, n_minima, points)
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

   !> Where the axes of a candidate are nearest to each other, the nearest place first.
   pure subroutine find_closest(model, wires, elements, candidate, depth, x_start, x, rotation, xi, n)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Barred element, unbarred element, contact pair (3)
      integer, intent(in) :: candidate(3)
      !> Largest overlap when the increment began [m]
      real(dp), intent(in) :: depth
      !> Positions (3, n_nodes) when the increment began, and now [m]; rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x_start(:, :), x(:, :), rotation(:, :, :)
      !> Places in the barred and the unbarred element (2, 1 + max_others)
      real(dp), intent(out) :: xi(:, :)
      !> How many there are within both elements
      integer, intent(out) :: n
      real(dp) :: xe(3, 4), t(3, 4), length(2), distance, others(2, max_minima)
      integer :: status, n_others

      associate (eb => candidate(1), e => candidate(2))
         call pair_geometry(model, wires, elements, eb, e, x, rotation, xe, t, length)
         distance = norm2(sum(xe(:, 1:2), 2) - sum(xe(:, 3:4), 2))/2 - sum(length) &
            - (1 + skin/2)*(elements%radius(eb) + elements%radius(e))
         ! wires that have passed each other are apart again
         if (distance > 0) distance = distance - depth - relative_motion(model, x_start, x, eb, e)
         n = 0
         if (distance > 0) return
         call closest_points(xe, t, length, axis_of_pair(model, candidate(3)), xi(1, 1), xi(2, 1), status, &
            others=others, n_others=n_others)
         if (any(status == [closest_inside, closest_not_unique, closest_parallel]) .and. &
            all(abs(xi(:, 1)) <= 1 + end_tolerance)) n = 1
         n_others = min(n_others, max_others)
         xi(:, n + 1:n + n_others) = others(:, :n_others)
         n = n + n_others
      end associate
   end subroutine find_closest

   !> Points without memory for the candidates that cross.
   pure subroutine collect_points(wires, elements, candidates, xi, n_minima, points)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Barred element, unbarred element, contact pair (3, n_candidates)
      integer, intent(in) :: candidates(:, :)
      !> Places in the barred and the unbarred element (2, 1 + max_others, n_candidates)
      real(dp), intent(in) :: xi(:, :, :)
      !> How many of these each candidate has (n_candidates)
      integer, intent(in) :: n_minima(:)
      type(contact_point_t), allocatable, intent(out) :: points(:)
      type(contact_point_t), allocatable :: all_points(:)
      logical, allocatable :: keep(:)
      integer :: k, i, m

      allocate (all_points(sum(n_minima)))
      m = 0
      do k = 1, size(n_minima)
         do i = 1, n_minima(k)
            m = m + 1
            all_points(m)%candidate = k
            all_points(m)%element_bar = candidates(1, k)
            all_points(m)%element = candidates(2, k)
            all_points(m)%pair = candidates(3, k)
            all_points(m)%xi_bar = xi(1, i, k)
            all_points(m)%xi = xi(2, i, k)
            all_points(m)%arc_bar = arc_at(wires, elements, candidates(1, k), xi(1, i, k))
            all_points(m)%arc = arc_at(wires, elements, candidates(2, k), xi(2, i, k))
         end do
      end do
      keep = are_new(wires, elements, all_points)
      allocate (points(count(keep)))
      m = 0
      do i = 1, size(keep)
         if (.not. keep(i)) cycle
         m = m + 1
         points(m) = all_points(i)
      end do
   end subroutine collect_points

   !> Each crossing once (n_points): one at a node may be found by both elements there, and the first one keeps it.
   pure function are_new(wires, elements, points) result(keep)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: points(:)
      logical :: keep(size(points))
      !> The last point at a node that each barred wire has so far, and the one before each of them
      integer :: last_at_node(wires%n_wires), before(size(points))
      integer :: k

      last_at_node = 0
      before = 0
      keep = .true.
      do k = 1, size(points)
         if (all(abs([points(k)%xi_bar, points(k)%xi]) < 1 - near_node)) cycle
         associate (last => last_at_node(wires%wire(points(k)%element_bar)))
            keep(k) = .not. is_found_before(wires, elements, points, k, last, before)
            before(k) = last
            last = k
         end associate
      end do
   end function are_new

   !> Whether one of the points before this one is at the same place of both wires.
   pure logical function is_found_before(wires, elements, points, k, last, before) result(found)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: points(:)
      !> A point, the last one at a node of the same barred wire, and the one before each of those (n_points)
      integer, intent(in) :: k, last, before(:)
      integer :: other

      found = .false.
      other = last
      do while (other > 0)
         associate (point => points(k), earlier => points(other))
            found = is_same(point%element_bar, point%arc_bar, earlier%element_bar, earlier%arc_bar) .and. &
               is_same(point%element, point%arc, earlier%element, earlier%arc)
         end associate
         if (found) return
         other = before(other)
      end do

   contains

      !> The same place of one wire.
      pure logical function is_same(e, arc, e_other, arc_other)
         !> Elements
         integer, intent(in) :: e, e_other
         !> Arc lengths there [m]
         real(dp), intent(in) :: arc, arc_other

         is_same = wires%wire(e) == wires%wire(e_other)
         if (is_same) is_same = abs(arc_from_to(arc, arc_other, wires%circumference(wires%wire(e)))) &
            <= near_node*elements%length(e)
      end function is_same

   end function is_found_before

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

      axis = axis_of_pair(model, point%pair)
      associate (eb => point%element_bar, e => point%element, kinematics => point%kinematics)
         call pair_geometry(model, wires, elements, eb, e, x, rotation, xe, t, length)
         call contact_kinematics(xe, t, length, axis, elements%radius([eb, e]), point%xi_bar, point%xi, 0, kinematics, &
            info)
         if (info == kinematics_ok) then
            point%start = crossing_at_start(model, wires, elements, contact, converged_by_wire, x_start, &
               rotation_start, relative_motion(model, x_start, x, eb, e), point, from_converged)
            if (have_passed(point%start, crossing_at(wires, point))) call contact_kinematics(xe, t, length, axis, &
               elements%radius([eb, e]), point%xi_bar, point%xi, -kinematics%side, kinematics, info)
         end if
         point%regular = info == kinematics_ok
         point%gap = kinematics%gap + clearance_of(point%fit, contact%clearance(point%pair))
      end associate
   end subroutine set_geometry

end module litz_contact_crossings
