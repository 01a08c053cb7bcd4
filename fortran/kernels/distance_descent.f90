!> A minimum of the distance of two curved axes, going down from a given place.
!>
!> Source: theory section 4: `f = w.w/2` by Newton's method with a step limit, a decreasing `f` and a positive definite
!> matrix, so that it ends in a minimum and never in a saddle or a maximum.
module litz_distance_descent
   use litz_kinds, only: dp
   implicit none
   private
   public :: point_t, minimise, scaled, lowest_eigenvalue, smallest_eigenvalue

   !> Newton stops at this change of xi, because the next one is of the order of its square
   real(dp), parameter :: step_tolerance = 1.0e-9_dp
   !> Newton steps below this are taken without looking at `f`, which round-off hides
   real(dp), parameter :: trusted_step = 1.0e-3_dp
   real(dp), parameter :: largest_step = 0.5_dp
   !> Smallest eigenvalue of the Newton matrix, scaled to the lengths of the tangents, that counts as positive
   real(dp), parameter :: smallest_eigenvalue = 1.0e-10_dp
   integer, parameter :: max_iterations = 60, max_halvings = 30

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

   !> `f`, its gradient and its matrix of second derivatives with respect to (xi_bar, xi).
   pure type(point_t) function evaluate(p_bar, p, xi) result(point)
      !> Axes in powers of xi (3, 0:3) [m]
      real(dp), intent(in) :: p_bar(3, 0:3), p(3, 0:3)
      !> Places (barred, unbarred)
      real(dp), intent(in) :: xi(2)
      real(dp) :: w(3), xb1(3), xb2(3), x1(3), x2(3)

      w = (p_bar(:, 0) - p(:, 0)) + xi(1)*(p_bar(:, 1) + xi(1)*(p_bar(:, 2) + xi(1)*p_bar(:, 3))) &
         - xi(2)*(p(:, 1) + xi(2)*(p(:, 2) + xi(2)*p(:, 3)))
      xb1 = p_bar(:, 1) + xi(1)*(2*p_bar(:, 2) + xi(1)*3*p_bar(:, 3))
      x1 = p(:, 1) + xi(2)*(2*p(:, 2) + xi(2)*3*p(:, 3))
      xb2 = 2*p_bar(:, 2) + xi(1)*6*p_bar(:, 3)
      x2 = 2*p(:, 2) + xi(2)*6*p(:, 3)

      point%xi = xi
      point%f = dot_product(w, w)/2
      point%gradient = [dot_product(w, xb1), -dot_product(w, x1)]
      point%square = [dot_product(xb1, xb1), dot_product(x1, x1)]
      point%matrix(1, 1) = point%square(1) + dot_product(w, xb2)
      point%matrix(2, 2) = point%square(2) - dot_product(w, x2)
      point%matrix(1, 2) = -dot_product(xb1, x1)
      point%matrix(2, 1) = point%matrix(1, 2)
   end function evaluate

   !> Sine of the angle between the tangents at a point.
   pure real(dp) function sine_at(p_bar, p, point) result(sine)
      !> Axes in powers of xi (3, 0:3) [m]
      real(dp), intent(in) :: p_bar(3, 0:3), p(3, 0:3)
      type(point_t), intent(in) :: point
      real(dp) :: xb1(3), x1(3), normal(3)

      associate (xi => point%xi)
         xb1 = p_bar(:, 1) + xi(1)*(2*p_bar(:, 2) + xi(1)*3*p_bar(:, 3))
         x1 = p(:, 1) + xi(2)*(2*p(:, 2) + xi(2)*3*p(:, 3))
      end associate
      normal = [x1(2)*xb1(3) - x1(3)*xb1(2), x1(3)*xb1(1) - x1(1)*xb1(3), x1(1)*xb1(2) - x1(2)*xb1(1)]
      sine = sqrt(dot_product(normal, normal)/max(product(point%square), tiny(1.0_dp)))
   end function sine_at

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
         if (.not. (minval(point%square) > 0 .and. point%f < huge(1.0_dp))) exit
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
            exit
         end if
      end do
      point%sine = sine_at(p_bar, p, point)
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

end module litz_distance_descent
