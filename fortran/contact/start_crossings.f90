!> The crossings of wires when the increment began: they say on which side of each other the wires are.
module litz_start_crossings
   use litz_kinds, only: dp
   use litz_closest_points, only: closest_points, end_tolerance, search_limit, closest_parallel, closest_not_converged
   use litz_contact_kinematics, only: contact_kinematics, kinematics_ok
   use litz_contact_points, only: contact_point_t, contact_set_t, points_by_wire_t, pair_geometry, axis_of_pair, &
      arc_at, crossing_at
   use litz_contact_side, only: crossing_t
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_wires, only: wires_t
   implicit none
   private
   public :: crossing_at_start, relative_motion

contains

   !> The crossing of the same two wires when the increment began: the converged point that this one continues, or the
   !> nearest along the wires, or one that was too far open to be a point.
   pure type(crossing_t) function crossing_at_start(model, wires, elements, contact, converged_by_wire, x_start, &
      rotation_start, motion, point, continued) result(start)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the points of the last converged state
      type(contact_set_t), intent(in) :: contact
      type(points_by_wire_t), intent(in) :: converged_by_wire
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes) when the increment began
      real(dp), intent(in) :: x_start(:, :), rotation_start(:, :, :)
      !> `relative_motion` of the elements of the point [m]
      real(dp), intent(in) :: motion
      type(contact_point_t), intent(in) :: point
      !> The converged point that it continues; 0: none
      integer, intent(in) :: continued
      integer :: k

      k = continued
      if (k == 0) k = nearest_converged(wires, elements, contact%converged, converged_by_wire, motion, point)
      if (k > 0) then
         start = crossing_at(wires, contact%converged(k))
      else if (point%kinematics%distance <= motion + contact%depth &
         + sum(elements%radius([point%element_bar, point%element]))/2) then
         ! only axes that have moved so far can have passed each other
         start = crossing_in_start_geometry(model, wires, elements, x_start, rotation_start, motion, point)
      end if
   end function crossing_at_start

   !> Bound on how far two elements have moved past each other since the increment began [m].
   pure real(dp) function relative_motion(model, x_start, x, eb, e) result(motion)
      type(model_t), intent(in) :: model
      !> Positions (3, n_nodes) when the increment began, and now [m]
      real(dp), intent(in) :: x_start(:, :), x(:, :)
      !> Two elements
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

   !> The converged point of the same two wires that is nearest along them; 0: none that can have slid here.
   pure integer function nearest_converged(wires, elements, converged, by_wire, motion, point) result(nearest)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Points of the last converged state, and these by their barred wires
      type(contact_point_t), intent(in) :: converged(:)
      type(points_by_wire_t), intent(in) :: by_wire
      !> `relative_motion` of the elements of the point [m]
      real(dp), intent(in) :: motion
      type(contact_point_t), intent(in) :: point
      real(dp) :: distance, least
      integer :: k

      nearest = 0
      least = 2*motion + sum(elements%length([point%element_bar, point%element]))
      k = by_wire%first(wires%wire(point%element_bar))
      do while (k > 0)
         associate (other => converged(k))
            if (wires%wire(other%element) == wires%wire(point%element)) then
               distance = max(wires%arc_between(wires%wire(point%element_bar), other%arc_bar, point%arc_bar), &
                  wires%arc_between(wires%wire(point%element), other%arc, point%arc))
               if (distance < least) then
                  least = distance
                  nearest = k
               end if
            end if
         end associate
         k = by_wire%next(k)
      end do
   end function nearest_converged

   !> The crossing of these elements when the increment began, or of others of the same two wires that can have slid
   !> here. A wire that touches itself is asked about these two elements only.
   pure type(crossing_t) function crossing_in_start_geometry(model, wires, elements, x_start, rotation_start, motion, &
      point) result(start)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes) when the increment began
      real(dp), intent(in) :: x_start(:, :), rotation_start(:, :, :)
      !> `relative_motion` of the elements of the point [m]
      real(dp), intent(in) :: motion
      type(contact_point_t), intent(in) :: point
      integer, allocatable :: near_bar(:), near(:)
      integer :: i, j, axis

      axis = axis_of_pair(model, point%pair)
      associate (eb => point%element_bar, e => point%element)
         start = crossing_of_elements(model, wires, elements, x_start, rotation_start, axis, eb, e, search_limit)
         if (start%known .or. wires%wire(eb) == wires%wire(e)) return
         near_bar = elements_along(wires, elements, eb, motion)
         near = elements_along(wires, elements, e, motion)
         do i = 1, size(near_bar)
            do j = 1, size(near)
               if (centre_distance(model, x_start, near_bar(i), near(j)) > elements%length(near_bar(i)) &
                  + elements%length(near(j)) + motion + sum(elements%radius([eb, e]))) cycle
               start = crossing_of_elements(model, wires, elements, x_start, rotation_start, axis, near_bar(i), &
                  near(j), 1 + end_tolerance)
               if (start%known) return
            end do
         end do
      end associate
   end function crossing_in_start_geometry

   !> The crossing of two elements, unknown if not within `|xi| < limit`.
   pure type(crossing_t) function crossing_of_elements(model, wires, elements, x, rotation, axis, eb, e, limit) &
      result(crossing)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      !> Axis that the law sees, barred and unbarred element
      integer, intent(in) :: axis, eb, e
      !> Largest magnitude of the places
      real(dp), intent(in) :: limit
      type(contact_point_t) :: point
      real(dp) :: xe(3, 4), t(3, 4), length(2)
      integer :: info

      point%element_bar = eb
      point%element = e
      call pair_geometry(model, wires, elements, eb, e, x, rotation, xe, t, length)
      call closest_points(xe, t, length, axis, point%xi_bar, point%xi, info)
      if (info == closest_parallel .or. info == closest_not_converged) return
      if (any(abs([point%xi_bar, point%xi]) >= limit)) return
      call contact_kinematics(xe, t, length, axis, elements%radius([eb, e]), point%xi_bar, point%xi, 0, &
         point%kinematics, info)
      if (info /= kinematics_ok) return
      point%arc_bar = arc_at(wires, elements, eb, point%xi_bar)
      point%arc = arc_at(wires, elements, e, point%xi)
      crossing = crossing_at(wires, point)
   end function crossing_of_elements

   !> Elements of the same wire that begin within a distance along it, this one included.
   pure function elements_along(wires, elements, e, distance) result(near)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      !> [m]
      real(dp), intent(in) :: distance
      integer, allocatable :: near(:)
      integer :: i

      associate (w => wires%wire(e))
         near = wires%element(wires%first(w):wires%first(w + 1) - 1)
         near = pack(near, [(wires%arc_between(w, wires%arc(e), wires%arc(near(i))) &
            - (elements%length(e) + elements%length(near(i)))/2 <= distance, i=1, size(near))])
      end associate
   end function elements_along

   !> Distance of the middles of two elements [m].
   pure real(dp) function centre_distance(model, x, eb, e) result(distance)
      type(model_t), intent(in) :: model
      !> Positions (3, n_nodes) [m]
      real(dp), intent(in) :: x(:, :)
      !> Two elements
      integer, intent(in) :: eb, e

      distance = norm2(sum(x(:, model%connectivity(:, eb)), 2) - sum(x(:, model%connectivity(:, e)), 2))/2
   end function centre_distance

end module litz_start_crossings
