!> The closest points of two curved axes.
!>
!> Source: theory section 4: `w . x' = 0`, `w . xb' = 0`, `w = xb - x`, solved as the minimum of `f = w.w/2` by Newton's
!> method with a step limit, a decreasing `f` and a positive definite matrix, so that it ends in a minimum and never in
!> a saddle or a maximum. It starts from the closest points of the two chords. Where the axes are curved so much that
!> there may be several minima, a grid over both elements finds the others.
module litz_closest_points
   use litz_kinds, only: dp
   use litz_axis, only: axis_polynomial
   use litz_distance_descent, only: point_t, minimise, scaled, lowest_eigenvalue, smallest_eigenvalue
   use litz_straight_segments, only: closest_on_chords
   implicit none
   private
   public :: closest_points, local_minima
   public :: parallel_sine, end_tolerance, search_limit, max_minima
   public :: closest_inside, closest_beyond, closest_parallel, closest_not_unique, closest_not_converged

   !> Both points lie within their elements, to `end_tolerance`
   integer, parameter :: closest_inside = 0
   !> The closest points of the two axes, each continued as the same cubic up to `|xi| = search_limit`, lie beyond an
   !> end; a value at that limit is where the search stopped
   integer, parameter :: closest_beyond = 1
   !> The tangents there enclose an angle with a sine below `parallel_sine`; the points given are at the least distance
   integer, parameter :: closest_parallel = -1
   !> Another pair of points is as close, or the distance is stationary along a line; the points given are one choice
   integer, parameter :: closest_not_unique = -2
   !> Coincident nodes or numbers that are not finite; the points given are the last ones
   integer, parameter :: closest_not_converged = -3

   !> About 0.06 degree: the points are known to about epsilon/sine^2, six digits worse than at 90 degrees
   real(dp), parameter :: parallel_sine = 1.0e-3_dp
   !> A point this little beyond an end still counts as inside, so that none is lost to round-off between two elements
   real(dp), parameter :: end_tolerance = 1.0e-10_dp
   real(dp), parameter :: search_limit = 1.5_dp

   !> Grid points along each axis in the search for other minima
   integer, parameter :: n_grid = 17
   !> Local minima of one pair of elements that are kept
   integer, parameter :: max_minima = 16
   !> Places nearer to each other than this, in units of xi, are one minimum
   real(dp), parameter :: same_place = 1.0e-6_dp
   !> Slope of `f` over the squared tangent with which it falls for longer than `end_tolerance`, whatever the curvature
   real(dp), parameter :: clearly_beyond = 1.0e-6_dp

contains

   !> Closest points of two elements.
   pure subroutine closest_points(x, t, length, axis, xi_bar, xi, status, start, others, n_others)
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer, intent(in) :: axis
      !> Places in the barred and the unbarred element
      real(dp), intent(out) :: xi_bar, xi
      !> One of the constants above
      integer, intent(out) :: status
      !> Places (barred, unbarred) of an earlier solution: the minimum next to it is the one wanted
      real(dp), intent(in), optional :: start(2)
      !> Places (barred, unbarred) of further minima within both elements
      real(dp), intent(out), optional :: others(2, max_minima)
      !> Their number; given together with them
      integer, intent(out), optional :: n_others
      real(dp) :: p(3, 0:3), p_bar(3, 0:3), found(2, max_minima)
      type(point_t) :: point
      logical :: unique
      integer :: i, n_found

      call set_axes(x, t, length, axis, p_bar, p)

      unique = .true.
      n_found = 0
      if (present(start)) then
         call minimise(p_bar, p, max(-search_limit, min(search_limit, start)), search_limit, point)
      else
         call minimise(p_bar, p, closest_on_chords(x), 1.0_dp, point)
         if (.not. is_convex(p_bar, p)) call search_grid(p_bar, p, point, unique, found, n_found)
         if (any(abs(point%xi) >= 1)) call minimise(p_bar, p, point%xi, search_limit, point)
      end if
      xi_bar = point%xi(1)
      xi = point%xi(2)
      status = status_of(point, unique)
      if (.not. present(others)) return
      others = found
      n_others = 0
      do i = 1, n_found
         if (maxval(abs(found(:, i) - point%xi)) < same_place) cycle
         n_others = n_others + 1
         others(:, n_others) = found(:, i)
      end do
   end subroutine closest_points

   !> All local minima of the distance of two elements, those at their ends included.
   !>
   !> Where the distance is stationary along a line (parallel axes) one place of it is given.
   pure subroutine local_minima(x, t, length, axis, places, n)
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer, intent(in) :: axis
      !> Places (barred, unbarred) in [-1, 1] of the first `n` minima
      real(dp), intent(out) :: places(2, max_minima)
      !> Number of minima
      integer, intent(out) :: n
      real(dp) :: p(3, 0:3), p_bar(3, 0:3), f(0:n_grid + 1, 0:n_grid + 1)
      integer :: i, j

      call set_axes(x, t, length, axis, p_bar, p)
      n = 0
      places = 0
      call add_minimum(p_bar, p, closest_on_chords(x), places, n)
      if (is_convex(p_bar, p)) return
      f = grid_distances(p_bar, p)
      do j = 1, n_grid
         do i = 1, n_grid
            if (is_grid_minimum(f, i, j)) call add_minimum(p_bar, p, [grid_xi(i), grid_xi(j)], places, n)
         end do
      end do
   end subroutine local_minima

   !> Both axes in powers of xi, measured from one node so that the points do not suffer from far-away origins.
   pure subroutine set_axes(x, t, length, axis, p_bar, p)
      !> As in `closest_points`
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      !> As there
      integer, intent(in) :: axis
      !> Axes in powers of xi (3, 0:3) [m]: barred, unbarred
      real(dp), intent(out) :: p_bar(3, 0:3), p(3, 0:3)

      p_bar = axis_polynomial(axis, length(1), x(:, 1:2) - spread(x(:, 3), 2, 2), t(:, 1:2))
      p = axis_polynomial(axis, length(2), x(:, 3:4) - spread(x(:, 3), 2, 2), t(:, 3:4))
   end subroutine set_axes

   !> The minimum below `start`, unless it is known already.
   pure subroutine add_minimum(p_bar, p, start, places, n)
      !> Axes in powers of xi (3, 0:3) [m]: barred, unbarred
      real(dp), intent(in) :: p_bar(3, 0:3), p(3, 0:3)
      !> Places (barred, unbarred) from which the minimum is looked for
      real(dp), intent(in) :: start(2)
      !> Places (barred, unbarred) of the minima that are known
      real(dp), intent(inout) :: places(2, max_minima)
      !> Number of minima that are known
      integer, intent(inout) :: n
      type(point_t) :: point

      call minimise(p_bar, p, start, 1.0_dp, point)
      if (point%converged) call add_place(point%xi, places, n)
   end subroutine add_minimum

   !> Add a place to a list, unless it is there already or the list is full.
   pure subroutine add_place(xi, places, n)
      !> Place (barred, unbarred)
      real(dp), intent(in) :: xi(2)
      !> Places in the list
      real(dp), intent(inout) :: places(2, max_minima)
      !> Their number
      integer, intent(inout) :: n

      if (n == max_minima) return
      if (any(maxval(abs(places(:, :n) - spread(xi, 2, n)), 1) < same_place)) return
      n = n + 1
      places(:, n) = xi
   end subroutine add_place

   pure integer function status_of(point, unique) result(status)
      type(point_t), intent(in) :: point
      !> .false.: there is another minimum at the same distance
      logical, intent(in) :: unique

      if (.not. point%converged) then
         status = closest_not_converged
      else if (.not. point%sine > parallel_sine) then
         status = closest_parallel
      else if (any(abs(point%xi) > 1 + end_tolerance)) then
         status = closest_beyond
      else if (.not. unique .or. .not. lowest_eigenvalue(scaled(point)) > smallest_eigenvalue) then
         status = closest_not_unique
      else
         status = closest_inside
      end if
   end function status_of

   !> Whether `f` is certainly convex over both elements, by bounds on the tangents and curvatures of the two axes: then
   !> it has one minimum there. Straight axes always are.
   pure logical function is_convex(p_bar, p) result(convex)
      !> Axes in powers of xi (3, 0:3) [m]: barred, unbarred
      real(dp), intent(in) :: p_bar(3, 0:3), p(3, 0:3)
      real(dp) :: reach, tangent(2), bend(2), curvature(2), diagonal(2), mixed

      tangent = [norm2(p_bar(:, 1)), norm2(p(:, 1))]
      bend = [2*norm2(p_bar(:, 2)) + 3*norm2(p_bar(:, 3)), 2*norm2(p(:, 2)) + 3*norm2(p(:, 3))]
      curvature = [2*norm2(p_bar(:, 2)) + 6*norm2(p_bar(:, 3)), 2*norm2(p(:, 2)) + 6*norm2(p(:, 3))]
      convex = .not. any(curvature > 0)
      if (convex) return
      reach = norm2(p_bar(:, 0) - p(:, 0)) + sum(tangent + bend)
      diagonal = max(tangent - bend, 0.0_dp)**2 - reach*curvature
      mixed = abs(dot_product(p_bar(:, 1), p(:, 1))) + bend(1)*tangent(2) + bend(2)*tangent(1) + product(bend)
      convex = all(diagonal > 0) .and. diagonal(1)*diagonal(2) > mixed**2
   end function is_convex

   !> Goes down from every local minimum of a grid and keeps the closest point found, one inside before one at an end.
   pure subroutine search_grid(p_bar, p, best, unique, found, n_found)
      !> Axes in powers of xi (3, 0:3) [m]: barred, unbarred
      real(dp), intent(in) :: p_bar(3, 0:3), p(3, 0:3)
      !> In: a minimum already found. Out: the best one
      type(point_t), intent(inout) :: best
      !> .false.: two separate minima inside are equally close
      logical, intent(out) :: unique
      !> Places (barred, unbarred) of all minima within both elements
      real(dp), intent(out) :: found(2, max_minima)
      !> Their number
      integer, intent(out) :: n_found
      real(dp) :: f(0:n_grid + 1, 0:n_grid + 1)
      type(point_t) :: point
      integer :: i, j

      unique = .true.
      n_found = 0
      if (best%converged) call note_minimum(p_bar, p, best, found, n_found)
      f = grid_distances(p_bar, p)
      do j = 1, n_grid
         do i = 1, n_grid
            if (.not. is_grid_minimum(f, i, j)) cycle
            call minimise(p_bar, p, [grid_xi(i), grid_xi(j)], 1.0_dp, point)
            if (.not. point%converged) cycle
            if (maxval(abs(point%xi - best%xi)) < same_place) cycle
            call note_minimum(p_bar, p, point, found, n_found)
            if (is_inside(point) .and. is_inside(best)) then
               if (abs(point%f - best%f) <= 1.0e-10_dp*(point%f + best%f)) unique = .false.
            end if
            if (is_better(point, best)) then
               if (point%f < best%f*(1 - 1.0e-9_dp) .or. .not. is_inside(best)) unique = .true.
               best = point
            end if
         end do
      end do
   end subroutine search_grid

   !> Add a minimum to those within both elements, unless it is one of them or lies beyond an end.
   pure subroutine note_minimum(p_bar, p, minimum, found, n_found)
      !> Axes in powers of xi (3, 0:3) [m]: barred, unbarred
      real(dp), intent(in) :: p_bar(3, 0:3), p(3, 0:3)
      !> With both places in [-1, 1]
      type(point_t), intent(in) :: minimum
      !> Places (barred, unbarred)
      real(dp), intent(inout) :: found(2, max_minima)
      !> Their number
      integer, intent(inout) :: n_found
      type(point_t) :: point

      if (surely_leads_beyond(minimum)) return
      point = minimum
      if (any(abs(point%xi) >= 1)) call minimise(p_bar, p, minimum%xi, search_limit, point)
      if (point%converged .and. all(abs(point%xi) <= 1 + end_tolerance)) call add_place(point%xi, found, n_found)
   end subroutine note_minimum

   !> At the end of an element the distance falls on beyond it, so steeply that no minimum is within its tolerance.
   pure logical function surely_leads_beyond(point) result(beyond)
      type(point_t), intent(in) :: point
      integer :: i

      beyond = .false.
      do i = 1, 2
         if (abs(point%xi(i)) < 1) cycle
         beyond = beyond .or. -sign(1.0_dp, point%xi(i))*point%gradient(i) > clearly_beyond*point%square(i)
      end do
   end function surely_leads_beyond

   !> Squared distances at the places of a grid, with a rim of huge ones.
   pure function grid_distances(p_bar, p) result(f)
      !> Axes in powers of xi (3, 0:3) [m]: barred, unbarred
      real(dp), intent(in) :: p_bar(3, 0:3), p(3, 0:3)
      real(dp) :: f(0:n_grid + 1, 0:n_grid + 1)
      !> Places of the grid on both axes, component after component
      real(dp) :: x_bar(n_grid, 3), x(3)
      integer :: i, j

      do i = 1, n_grid
         associate (xi => grid_xi(i))
            x_bar(i, :) = (p_bar(:, 0) - p(:, 0)) + xi*(p_bar(:, 1) + xi*(p_bar(:, 2) + xi*p_bar(:, 3)))
         end associate
      end do
      f = huge(1.0_dp)
      do j = 1, n_grid
         associate (xi => grid_xi(j))
            x = xi*(p(:, 1) + xi*(p(:, 2) + xi*p(:, 3)))
         end associate
         f(1:n_grid, j) = (x_bar(:, 1) - x(1))**2 + (x_bar(:, 2) - x(2))**2 + (x_bar(:, 3) - x(3))**2
      end do
   end function grid_distances

   !> No neighbour along the axes is lower; valleys that run across the grid hide a minimum from the diagonal ones.
   pure logical function is_grid_minimum(f, i, j)
      !> Squared distances on the grid with its rim (0:n_grid + 1, 0:n_grid + 1) [m^2]
      real(dp), intent(in) :: f(0:, 0:)
      !> Grid point: along the barred, along the unbarred axis
      integer, intent(in) :: i, j

      is_grid_minimum = f(i, j) <= min(f(i - 1, j), f(i + 1, j), f(i, j - 1), f(i, j + 1))
   end function is_grid_minimum

   pure real(dp) function grid_xi(i) result(xi)
      !> Number of the grid point along an axis, 1 to `n_grid`
      integer, intent(in) :: i

      xi = -1 + 2*real(i - 1, dp)/(n_grid - 1)
   end function grid_xi

   pure logical function is_inside(point) result(inside)
      type(point_t), intent(in) :: point

      inside = point%converged .and. all(abs(point%xi) < 1)
   end function is_inside

   pure logical function is_better(point, best) result(better)
      type(point_t), intent(in) :: point, best

      if (is_inside(point) .neqv. is_inside(best)) then
         better = is_inside(point)
      else
         better = point%f < best%f .or. .not. best%converged
      end if
   end function is_better

end module litz_closest_points
