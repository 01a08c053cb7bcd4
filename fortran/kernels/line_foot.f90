!> The foot of a given point on the axis of an element.
!>
!> Source: theory section 10: `w . xb' = 0`, `w = xb - x`, solved as a minimum of the distance over the element and its
!> continuation, by Newton's method with a positive definite matrix and a decreasing distance. Unlike the closest points
!> of two axes, the foot is as well known on parallel axes as on crossed ones.
module litz_line_foot
   use litz_kinds, only: dp
   use litz_closest_points, only: search_limit, end_tolerance
   implicit none
   private
   public :: line_foot, least_quality
   public :: foot_inside, foot_at_end, foot_beyond, foot_too_curved, foot_not_converged

   !> Within the element, to `end_tolerance` of litz_closest_points
   integer, parameter :: foot_inside = 0
   !> The distance still falls where the axis ends: the foot stays at that end, `|xi_bar| = 1`
   integer, parameter :: foot_at_end = 1
   !> Beyond a node at which the wire goes on, in a neighbouring element; `xi_bar` is on that side
   integer, parameter :: foot_beyond = 2
   !> The axis is curved about the point so much that the foot is hardly a minimum: see `least_quality`
   integer, parameter :: foot_too_curved = -1
   !> Coincident nodes or numbers that are not finite
   integer, parameter :: foot_not_converged = -2

   !> Least `q = M/|xb'|^2 = 1 - d kappa_n`, the share by which the curvature of the axis lets the foot lag
   real(dp), parameter :: least_quality = 0.25_dp

   !> As in litz_closest_points: Newton stops at the first step length, trusts steps below the second, takes none
   !> beyond the third
   real(dp), parameter :: step_tolerance = 1.0e-9_dp, trusted_step = 1.0e-3_dp, largest_step = 0.5_dp
   integer, parameter :: max_iterations = 60, max_halvings = 30
   !> Places from which the nearest is the start
   integer, parameter :: n_grid = 9

   !> Half the squared distance at a place, and its derivatives.
   type :: foot_t
      real(dp) :: xi = 0
      !> [m^2]: f = w.w/2, df/dxi = w.xb', M = d2f/dxi2, |xb'|^2
      real(dp) :: f = 0, slope = 0, curvature = 0, square = 0
   end type foot_t

contains

   !> The foot on one element.
   pure subroutine line_foot(p_bar, point, ends, xi_bar, quality, status, start)
      !> Axis in powers of xi (3, 0:3) [m], from `axis_polynomial`
      real(dp), intent(in) :: p_bar(3, 0:3)
      !> The point (3) [m], from the same origin
      real(dp), intent(in) :: point(3)
      !> Whether the axis ends at its first and at its second node
      logical, intent(in) :: ends(2)
      !> Place in the element
      real(dp), intent(out) :: xi_bar
      !> q
      real(dp), intent(out) :: quality
      !> One of the constants above
      integer, intent(out) :: status
      !> Place of an earlier solution; without it the nearest of some places along the element
      real(dp), intent(in), optional :: start
      type(foot_t) :: foot
      real(dp) :: low, high
      logical :: converged

      low = merge(-1.0_dp, -search_limit, ends(1))
      high = merge(1.0_dp, search_limit, ends(2))
      if (present(start)) then
         foot = evaluate(p_bar, point, max(low, min(high, start)))
      else
         foot = nearest_on_grid(p_bar, point)
      end if
      call minimise(p_bar, point, low, high, foot, converged)
      xi_bar = foot%xi
      quality = 0
      if (foot%square > 0) quality = foot%curvature/foot%square
      status = status_of(foot, ends, quality, converged)
   end subroutine line_foot

   pure integer function status_of(foot, ends, quality, converged) result(status)
      type(foot_t), intent(in) :: foot
      !> Whether the axis ends at its nodes (2)
      logical, intent(in) :: ends(2)
      !> q
      real(dp), intent(in) :: quality
      !> Newton's method has come to its end
      logical, intent(in) :: converged
      real(dp) :: outwards
      logical :: at_end

      status = foot_not_converged
      if (.not. (foot%square > 0 .and. foot%f < huge(foot%f))) return
      ! how far the foot would go on, were it not held
      outwards = -sign(1.0_dp, foot%xi)*foot%slope/(max(quality, least_quality)*foot%square)
      at_end = ends(merge(2, 1, foot%xi > 0)) .and. abs(foot%xi) >= 1 .and. outwards > end_tolerance
      if (at_end) then
         status = foot_at_end
      else if (abs(foot%xi) > 1 + end_tolerance) then
         status = foot_beyond
      else if (.not. quality > least_quality) then
         status = foot_too_curved
      else
         status = merge(foot_inside, foot_not_converged, converged)
      end if
   end function status_of

   pure type(foot_t) function nearest_on_grid(p_bar, point) result(nearest)
      !> Axis in powers of xi (3, 0:3) [m]
      real(dp), intent(in) :: p_bar(3, 0:3)
      !> The point (3) [m]
      real(dp), intent(in) :: point(3)
      type(foot_t) :: foot
      integer :: i

      nearest = evaluate(p_bar, point, -1.0_dp)
      do i = 2, n_grid
         foot = evaluate(p_bar, point, -1 + 2*real(i - 1, dp)/(n_grid - 1))
         if (foot%f < nearest%f) nearest = foot
      end do
   end function nearest_on_grid

   pure type(foot_t) function evaluate(p_bar, point, xi) result(foot)
      !> Axis in powers of xi (3, 0:3) [m]
      real(dp), intent(in) :: p_bar(3, 0:3)
      !> The point (3) [m]
      real(dp), intent(in) :: point(3)
      !> Place in the element
      real(dp), intent(in) :: xi
      real(dp) :: w(3), xb1(3), xb2(3)

      w = (p_bar(:, 0) - point) + xi*(p_bar(:, 1) + xi*(p_bar(:, 2) + xi*p_bar(:, 3)))
      xb1 = p_bar(:, 1) + xi*(2*p_bar(:, 2) + xi*3*p_bar(:, 3))
      xb2 = 2*p_bar(:, 2) + xi*6*p_bar(:, 3)
      foot%xi = xi
      foot%f = dot_product(w, w)/2
      foot%slope = dot_product(w, xb1)
      foot%square = dot_product(xb1, xb1)
      foot%curvature = foot%square + dot_product(w, xb2)                                   ! M
   end function evaluate

   !> A minimum of `f` in `[low, high]`, going down from `foot`.
   pure subroutine minimise(p_bar, point, low, high, foot, converged)
      !> Axis in powers of xi (3, 0:3) [m]
      real(dp), intent(in) :: p_bar(3, 0:3)
      !> The point (3) [m]
      real(dp), intent(in) :: point(3)
      !> Bounds of the place
      real(dp), intent(in) :: low, high
      type(foot_t), intent(inout) :: foot
      !> The last step was as small as it must be
      logical, intent(out) :: converged
      type(foot_t) :: trial
      real(dp) :: step
      integer :: iteration, halving

      converged = .false.
      do iteration = 1, max_iterations
         if (.not. (foot%square > 0 .and. foot%f < huge(foot%f))) return
         step = -foot%slope/max(foot%curvature, least_quality*foot%square)
         step = max(-largest_step, min(largest_step, step))
         step = max(low, min(high, foot%xi + step)) - foot%xi
         trial = evaluate(p_bar, point, foot%xi + step)
         if (abs(step) > trusted_step) then
            do halving = 1, max_halvings
               if (trial%f <= foot%f + 1.0e-4_dp*foot%slope*step) exit
               step = step/2
               trial = evaluate(p_bar, point, foot%xi + step)
            end do
         end if
         foot = trial
         converged = abs(step) <= step_tolerance
         if (converged) return
      end do
   end subroutine minimise

end module litz_line_foot
