!> The closest points of two curved axes.
!>
!> Source: theory section 4: `w . x' = 0`, `w . xb' = 0`, `w = xb - x`, solved as the minimum of `f = w.w/2` by Newton's
!> method with a step limit, a decreasing `f` and a positive definite matrix, so that it ends in a minimum and never in
!> a saddle or a maximum. It starts from the closest points of the two chords. Where the axes are curved so much that
!> there may be several minima, a grid over both elements finds the others.
module litz_closest_points
   use litz_kinds, only: dp
   use litz_axis, only: axis_polynomial
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

   !> Newton stops at this change of xi, because the next one is of the order of its square
   real(dp), parameter :: step_tolerance = 1.0e-9_dp
   !> Newton steps below this are taken without looking at `f`, which round-off hides
   real(dp), parameter :: trusted_step = 1.0e-3_dp
   real(dp), parameter :: largest_step = 0.5_dp
   !> Smallest eigenvalue of the Newton matrix, scaled to the lengths of the tangents, that counts as positive
   real(dp), parameter :: smallest_eigenvalue = 1.0e-10_dp
   integer, parameter :: max_iterations = 60, max_halvings = 30
   !> Grid points along each axis in the search for other minima
   integer, parameter :: n_grid = 17
   !> Local minima of one pair of elements that are kept
   integer, parameter :: max_minima = 16
   !> Places nearer to each other than this, in units of xi, are one minimum
   real(dp), parameter :: same_place = 1.0e-6_dp

   !> One point of the search: where, how far, gradient and matrix.
   type :: point_t
      !> In the order barred, unbarred
      real(dp) :: xi(2) = 0
      real(dp) :: f = 0, gradient(2) = 0, matrix(2, 2) = 0
      !> Squared lengths of the two tangents, and the sine between them
      real(dp) :: square(2) = 0, sine = 0
      logical :: converged = .false.
   end type point_t

contains

   !> Closest points of two elements.
   pure subroutine closest_points(x, t, length, axis, xi_bar, xi, status, start)
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
      real(dp) :: p(3, 0:3), p_bar(3, 0:3), relative(3, 4)
      type(point_t) :: point
      logical :: unique
      integer :: i

      ! measured from one node, so that the points do not suffer from far-away origins
      do i = 1, 4
         relative(:, i) = x(:, i) - x(:, 3)
      end do
      p_bar = axis_polynomial(axis, length(1), relative(:, 1:2), t(:, 1:2))
      p = axis_polynomial(axis, length(2), relative(:, 3:4), t(:, 3:4))

      unique = .true.
      if (present(start)) then
         call minimise(p_bar, p, max(-search_limit, min(search_limit, start)), search_limit, point)
      else
         call minimise(p_bar, p, closest_on_chords(x), 1.0_dp, point)
         if (.not. is_convex(p_bar, p)) call search_grid(p_bar, p, point, unique)
         if (any(abs(point%xi) >= 1)) call minimise(p_bar, p, point%xi, search_limit, point)
      end if
      xi_bar = point%xi(1)
      xi = point%xi(2)
      status = status_of(point, unique)
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
      real(dp) :: p(3, 0:3), p_bar(3, 0:3), relative(3, 4), f(0:n_grid + 1, 0:n_grid + 1)
      integer :: i, j

      do i = 1, 4
         relative(:, i) = x(:, i) - x(:, 3)
      end do
      p_bar = axis_polynomial(axis, length(1), relative(:, 1:2), t(:, 1:2))
      p = axis_polynomial(axis, length(2), relative(:, 3:4), t(:, 3:4))
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
      integer :: k

      call minimise(p_bar, p, start, 1.0_dp, point)
      if (.not. point%converged .or. n == max_minima) return
      do k = 1, n
         if (maxval(abs(point%xi - places(:, k))) < same_place) return
      end do
      n = n + 1
      places(:, n) = point%xi
   end subroutine add_minimum

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

   !> `f`, its gradient and its matrix of second derivatives with respect to (xi_bar, xi).
   pure type(point_t) function evaluate(p_bar, p, xi) result(point)
      !> Axes in powers of xi (3, 0:3) [m]
      real(dp), intent(in) :: p_bar(3, 0:3), p(3, 0:3)
      !> Places (barred, unbarred)
      real(dp), intent(in) :: xi(2)
      real(dp) :: w(3), xb1(3), xb2(3), x1(3), x2(3), normal(3)

      w = (p_bar(:, 0) - p(:, 0)) + xi(1)*(p_bar(:, 1) + xi(1)*(p_bar(:, 2) + xi(1)*p_bar(:, 3))) &
         - xi(2)*(p(:, 1) + xi(2)*(p(:, 2) + xi(2)*p(:, 3)))
      xb1 = p_bar(:, 1) + xi(1)*(2*p_bar(:, 2) + xi(1)*3*p_bar(:, 3))
      x1 = p(:, 1) + xi(2)*(2*p(:, 2) + xi(2)*3*p(:, 3))
      xb2 = 2*p_bar(:, 2) + xi(1)*6*p_bar(:, 3)
      x2 = 2*p(:, 2) + xi(2)*6*p(:, 3)
      normal = [x1(2)*xb1(3) - x1(3)*xb1(2), x1(3)*xb1(1) - x1(1)*xb1(3), x1(1)*xb1(2) - x1(2)*xb1(1)]

      point%xi = xi
      point%f = dot_product(w, w)/2
      point%gradient = [dot_product(w, xb1), -dot_product(w, x1)]
      point%square = [dot_product(xb1, xb1), dot_product(x1, x1)]
      point%matrix(1, 1) = point%square(1) + dot_product(w, xb2)
      point%matrix(2, 2) = point%square(2) - dot_product(w, x2)
      point%matrix(1, 2) = -dot_product(xb1, x1)
      point%matrix(2, 1) = point%matrix(1, 2)
      point%sine = sqrt(dot_product(normal, normal)/max(product(point%square), tiny(1.0_dp)))
   end function evaluate

   !> A minimum of `f` in the box `|xi| <= limit`, going down from `start`.
   pure subroutine minimise(p_bar, p, start, limit, point)
      !> Axes in powers of xi (3, 0:3) [m]: barred, unbarred
      real(dp), intent(in) :: p_bar(3, 0:3), p(3, 0:3)
      !> Places (barred, unbarred) within the box
      real(dp), intent(in) :: start(2)
      !> Half the width of the box: 1 for the elements, more for their continuations
      real(dp), intent(in) :: limit
      type(point_t), intent(out) :: point
      type(point_t) :: trial
      real(dp) :: step(2)
      logical :: is_newton
      integer :: iteration, halving

      point = evaluate(p_bar, p, start)
      do iteration = 1, max_iterations
         if (.not. (minval(point%square) > 0 .and. point%f < huge(1.0_dp))) return
         call descent_step(point, limit, step, is_newton)
         step = step*min(1.0_dp, largest_step/max(maxval(abs(step)), tiny(1.0_dp)))
         call stop_at_border(limit, point%xi, step)
         trial = evaluate(p_bar, p, point%xi + step)
         if (.not. (is_newton .and. maxval(abs(step)) <= trusted_step)) then
            do halving = 1, max_halvings
               if (trial%f <= point%f + 1.0e-4_dp*dot_product(point%gradient, step)) exit
               step = step/2
               trial = evaluate(p_bar, p, point%xi + step)
            end do
         end if
         point = trial
         if (maxval(abs(step)) <= step_tolerance) then
            point%converged = .true.
            return
         end if
      end do
   end subroutine minimise

   !> Shortens a step that leaves the box so that it ends on the border.
   pure subroutine stop_at_border(limit, xi, step)
      !> Half the width of the box: 1 for the elements, more for their continuations
      real(dp), intent(in) :: limit
      !> Places (barred, unbarred) within the box
      real(dp), intent(in) :: xi(2)
      !> Step from there (barred, unbarred)
      real(dp), intent(inout) :: step(2)
      real(dp) :: border(2)
      integer :: i

      border = sign(limit, step)
      do i = 1, 2
         if (abs(xi(i) + step(i)) <= limit) cycle
         step = step*((border(i) - xi(i))/step(i))
         step(i) = border(i) - xi(i)
      end do
   end subroutine stop_at_border

   !> Newton's step, or one with a positive definite matrix in its place. A coordinate stays at the border of the box
   !> when `f` falls outwards there, or when the step would lead outwards.
   pure subroutine descent_step(point, limit, step, is_newton)
      type(point_t), intent(in) :: point
      !> Half the width of the box: 1 for the elements, more for their continuations
      real(dp), intent(in) :: limit
      !> Step (barred, unbarred) in xi
      real(dp), intent(out) :: step(2)
      !> .true.: exactly Newton's step in all free coordinates
      logical, intent(out) :: is_newton
      real(dp) :: matrix(2, 2), g(2), root(2)
      logical :: at_border(2), fixed(2)

      matrix = scaled(point)
      root = sqrt(point%square)
      g = point%gradient/root
      at_border = abs(point%xi) >= limit
      fixed = at_border .and. point%xi*point%gradient <= 0
      if (.not. any(fixed)) then
         call step_in_both(matrix, g, minval(root), step, is_newton)
         fixed = at_border .and. point%xi*step > 0
      end if
      if (any(fixed)) call step_in_one(matrix, g, root, fixed, step, is_newton)
      step = step/root
   end subroutine descent_step

   pure subroutine step_in_both(matrix, g, scale, step, is_newton)
      !> Scaled matrix (2, 2) and gradient (2) [m]
      real(dp), intent(in) :: matrix(2, 2), g(2)
      !> Length of the shorter tangent [m]
      real(dp), intent(in) :: scale
      !> Step (2) [m]
      real(dp), intent(out) :: step(2)
      !> .true.: exactly Newton's step
      logical, intent(out) :: is_newton
      real(dp) :: lowest, shift, a11, a22, direction(2)

      lowest = lowest_eigenvalue(matrix)
      is_newton = lowest > smallest_eigenvalue
      ! shifted so that the lowest eigenvalue becomes 0.1, a step of moderate length along its direction
      shift = merge(0.0_dp, 0.1_dp - lowest, is_newton)
      a11 = matrix(1, 1) + shift
      a22 = matrix(2, 2) + shift
      step = -[a22*g(1) - matrix(1, 2)*g(2), a11*g(2) - matrix(1, 2)*g(1)]/(a11*a22 - matrix(1, 2)**2)
      if (lowest >= -smallest_eigenvalue) return
      ! away from a saddle or a maximum, where the gradient vanishes, along the direction of negative curvature
      direction = [matrix(1, 2), lowest - matrix(1, 1)]
      if (matrix(1, 1) < matrix(2, 2)) direction = [lowest - matrix(2, 2), matrix(1, 2)]
      if (.not. norm2(direction) > 0) direction = [1.0_dp, 1.0_dp]
      step = step - sign(0.1_dp*scale/norm2(direction), dot_product(direction, g))*direction
   end subroutine step_in_both

   pure subroutine step_in_one(matrix, g, root, fixed, step, is_newton)
      !> Scaled matrix (2, 2), gradient (2) [m] and lengths of the tangents (2) [m]
      real(dp), intent(in) :: matrix(2, 2), g(2), root(2)
      !> Which coordinates stay (2)
      logical, intent(in) :: fixed(2)
      !> Step (2) [m]
      real(dp), intent(out) :: step(2)
      !> .true.: exactly Newton's step
      logical, intent(out) :: is_newton
      integer :: i

      step = 0
      is_newton = .true.
      do i = 1, 2
         if (fixed(i)) cycle
         is_newton = matrix(i, i) > smallest_eigenvalue
         if (is_newton) then
            step(i) = -g(i)/matrix(i, i)
         else
            step(i) = -g(i)
            if (matrix(i, i) < -smallest_eigenvalue) step(i) = step(i) - sign(0.1_dp*root(i), g(i))
         end if
      end do
   end subroutine step_in_one

   !> The matrix for coordinates that measure arc length: free of units and of the lengths of the elements.
   pure function scaled(point) result(matrix)
      type(point_t), intent(in) :: point
      real(dp) :: matrix(2, 2)

      matrix(1, 1) = point%matrix(1, 1)/point%square(1)
      matrix(2, 2) = point%matrix(2, 2)/point%square(2)
      matrix(1, 2) = point%matrix(1, 2)/sqrt(product(point%square))
      matrix(2, 1) = matrix(1, 2)
   end function scaled

   pure real(dp) function lowest_eigenvalue(matrix) result(lowest)
      !> Symmetric (2, 2)
      real(dp), intent(in) :: matrix(2, 2)

      lowest = (matrix(1, 1) + matrix(2, 2))/2 - hypot((matrix(1, 1) - matrix(2, 2))/2, matrix(1, 2))
   end function lowest_eigenvalue

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
   pure subroutine search_grid(p_bar, p, best, unique)
      !> Axes in powers of xi (3, 0:3) [m]: barred, unbarred
      real(dp), intent(in) :: p_bar(3, 0:3), p(3, 0:3)
      !> In: a minimum already found. Out: the best one
      type(point_t), intent(inout) :: best
      !> .false.: two separate minima inside are equally close
      logical, intent(out) :: unique
      real(dp) :: f(0:n_grid + 1, 0:n_grid + 1)
      type(point_t) :: point
      integer :: i, j

      unique = .true.
      f = grid_distances(p_bar, p)
      do j = 1, n_grid
         do i = 1, n_grid
            if (.not. is_grid_minimum(f, i, j)) cycle
            call minimise(p_bar, p, [grid_xi(i), grid_xi(j)], 1.0_dp, point)
            if (.not. point%converged) cycle
            if (maxval(abs(point%xi - best%xi)) < same_place) cycle
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

   !> Squared distances at the places of a grid, with a rim of huge ones.
   pure function grid_distances(p_bar, p) result(f)
      !> Axes in powers of xi (3, 0:3) [m]: barred, unbarred
      real(dp), intent(in) :: p_bar(3, 0:3), p(3, 0:3)
      real(dp) :: f(0:n_grid + 1, 0:n_grid + 1)
      integer :: i, j

      f = huge(1.0_dp)
      do j = 1, n_grid
         do i = 1, n_grid
            f(i, j) = squared_distance(p_bar, p, grid_xi(i), grid_xi(j))
         end do
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

   pure real(dp) function squared_distance(p_bar, p, xi_bar, xi) result(f)
      !> Axes in powers of xi (3, 0:3) [m]: barred, unbarred
      real(dp), intent(in) :: p_bar(3, 0:3), p(3, 0:3)
      !> Places in the barred and the unbarred element
      real(dp), intent(in) :: xi_bar, xi
      real(dp) :: w(3)

      w = (p_bar(:, 0) - p(:, 0)) + xi_bar*(p_bar(:, 1) + xi_bar*(p_bar(:, 2) + xi_bar*p_bar(:, 3))) &
         - xi*(p(:, 1) + xi*(p(:, 2) + xi*p(:, 3)))
      f = dot_product(w, w)
   end function squared_distance

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
