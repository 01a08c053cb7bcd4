!> Where wires cross: a point for each candidate whose axes are nearest to each other within both elements.
!>
!> A crossing belongs to the pair of wires, not of elements, so that points take over the memory of those before them
!> (litz_contact_matching). On which side of each other the two wires are is a fact of the last converged state
!> (litz_contact_side): an iterate that has pushed the axes through each other has a gap below minus both radii.
module litz_contact_crossings
   use litz_kinds, only: dp
   use litz_closest_points, only: closest_points, end_tolerance, closest_inside, closest_beyond, closest_not_unique
   use litz_contact_candidates, only: skin
   use litz_contact_kinematics, only: contact_kinematics, kinematics_ok
   use litz_contact_matching, only: match_points, slides_of
   use litz_contact_points, only: contact_point_t, contact_set_t, points_by_wire_t, pair_geometry, axis_of_pair, &
      arc_at, crossing_at, clearance_of, chain_by_wire
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
      real(dp), allocatable :: xi(:, :)
      !> The points of the last call, and of the last converged state, that the present ones continue; 0: none
      integer, allocatable :: origin(:), converged(:)
      integer, allocatable :: status(:)
      integer :: i, n

      n = size(contact%candidates, 2)
      allocate (xi(2, n), status(n))
      !$omp parallel do schedule(dynamic, 64) if (n >= worth_threads)
      do i = 1, n
         call find_closest(model, wires, elements, contact%candidates(:, i), contact%depth, x_start, x, rotation, &
            xi(:, i), status(i))
      end do
      !$omp end parallel do
      call move_alloc(contact%points, old)
      call collect_points(wires, elements, contact%candidates, xi, status == closest_inside, points)
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
   pure subroutine find_closest(model, wires, elements, candidate, depth, x_start, x, rotation, xi, status)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Barred element, unbarred element, contact pair (3)
      integer, intent(in) :: candidate(3)
      !> Largest overlap when the increment began [m]
      real(dp), intent(in) :: depth
      !> Positions (3, n_nodes) when the increment began, and now [m]; rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x_start(:, :), x(:, :), rotation(:, :, :)
      !> Places in the barred and the unbarred element (2)
      real(dp), intent(out) :: xi(2)
      !> One of `closest_...`
      integer, intent(out) :: status
      real(dp) :: xe(3, 4), t(3, 4), length(2), distance

      associate (eb => candidate(1), e => candidate(2))
         call pair_geometry(model, wires, elements, eb, e, x, rotation, xe, t, length)
         distance = norm2(sum(xe(:, 1:2), 2) - sum(xe(:, 3:4), 2))/2 - sum(length) &
            - (1 + skin/2)*(elements%radius(eb) + elements%radius(e))
         ! wires that have passed each other are apart again
         if (distance > 0) distance = distance - depth - relative_motion(model, x_start, x, eb, e)
         if (distance > 0) then
            xi = 0
            status = closest_beyond
            return
         end if
         call closest_points(xe, t, length, axis_of_pair(model, candidate(3)), xi(1), xi(2), status)
         if (status == closest_not_unique .and. all(abs(xi) <= 1 + end_tolerance)) status = closest_inside
      end associate
   end subroutine find_closest

   !> Points without memory for the candidates that cross.
   pure subroutine collect_points(wires, elements, candidates, xi, is_inside, points)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Barred element, unbarred element, contact pair (3, n_candidates)
      integer, intent(in) :: candidates(:, :)
      !> Places in the barred and the unbarred element (2, n_candidates)
      real(dp), intent(in) :: xi(:, :)
      !> Both places are within their elements (n_candidates)
      logical, intent(in) :: is_inside(:)
      type(contact_point_t), allocatable, intent(out) :: points(:)
      logical :: keep(size(is_inside))
      integer :: k, m

      keep = are_new(wires, elements, candidates, xi, is_inside)
      allocate (points(count(keep)))
      m = 0
      do k = 1, size(keep)
         if (.not. keep(k)) cycle
         m = m + 1
         points(m)%candidate = k
         points(m)%element_bar = candidates(1, k)
         points(m)%element = candidates(2, k)
         points(m)%pair = candidates(3, k)
         points(m)%xi_bar = xi(1, k)
         points(m)%xi = xi(2, k)
         points(m)%arc_bar = arc_at(wires, elements, candidates(1, k), xi(1, k))
         points(m)%arc = arc_at(wires, elements, candidates(2, k), xi(2, k))
      end do
   end subroutine collect_points

   !> Candidates that cross, each crossing once (n_candidates): one at a node may be found by both elements there, and
   !> the first one keeps it.
   pure function are_new(wires, elements, candidates, xi, is_inside) result(keep)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Barred element, unbarred element, contact pair (3, n_candidates)
      integer, intent(in) :: candidates(:, :)
      !> Places in the barred and the unbarred element (2, n_candidates)
      real(dp), intent(in) :: xi(:, :)
      !> Both places are within their elements (n_candidates)
      logical, intent(in) :: is_inside(:)
      logical :: keep(size(is_inside))
      !> The last candidate at a node that each barred wire has so far, and the one before each of them
      integer :: last_at_node(wires%n_wires), before(size(is_inside))
      integer :: k

      last_at_node = 0
      before = 0
      keep = is_inside
      do k = 1, size(keep)
         if (.not. keep(k) .or. all(abs(xi(:, k)) < 1 - near_node)) cycle
         associate (last => last_at_node(wires%wire(candidates(1, k))))
            keep(k) = .not. is_found_before(wires, elements, candidates, xi, k, last, before)
            before(k) = last
            last = k
         end associate
      end do
   end function are_new

   !> Whether one of the candidates before this one crosses at the same place of both wires.
   pure logical function is_found_before(wires, elements, candidates, xi, k, last, before) result(found)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Barred element, unbarred element, contact pair (3, n_candidates)
      integer, intent(in) :: candidates(:, :)
      !> Places in the barred and the unbarred element (2, n_candidates)
      real(dp), intent(in) :: xi(:, :)
      !> A candidate, the last one at a node of the same barred wire, and the one before each of those (n_candidates)
      integer, intent(in) :: k, last, before(:)
      integer :: other, j
      real(dp) :: distance

      found = .false.
      other = last
      do while (other > 0)
         do j = 1, 2
            associate (e => candidates(j, k), e_other => candidates(j, other))
               if (wires%wire(e) /= wires%wire(e_other)) exit
               distance = abs(arc_from_to(arc_at(wires, elements, e, xi(j, k)), &
                  arc_at(wires, elements, e_other, xi(j, other)), wires%circumference(wires%wire(e))))
               if (distance > near_node*elements%length(e)) exit
            end associate
         end do
         found = j > 2
         if (found) return
         other = before(other)
      end do
   end function is_found_before

   !> What a point takes over: the predictions of the last iterate, and the identity and the memory of the last
   !> converged state.
   pure subroutine inherit(old, from, converged, from_converged, point)
      !> Points of the last iterate, and of the last converged state
      type(contact_point_t), intent(in) :: old(:), converged(:)
      !> Those that the point continues; 0: none
      integer, intent(in) :: from, from_converged
      type(contact_point_t), intent(inout) :: point

      if (from > 0) then
         point%predicted = old(from)%predicted
         point%predicted_gap = old(from)%predicted_gap
         point%mixed_force = old(from)%mixed_force
         point%friction_iteration = old(from)%friction_iteration
      end if
      if (from_converged > 0) then
         point%id = converged(from_converged)%id
         point%history = converged(from_converged)%history
         point%fit = converged(from_converged)%fit
      end if
   end subroutine inherit

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
