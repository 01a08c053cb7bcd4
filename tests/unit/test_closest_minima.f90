!> Two elements that cross more than once have a place for each crossing.
program test_closest_minima
   use litz_axis_choices, only: axis_hermite
   use litz_closest_points, only: closest_points, closest_inside, closest_not_unique, max_minima
   use litz_kinds, only: dp, pi
   implicit none

   real(dp), parameter :: length(2) = [0.02_dp, 0.02_dp], height = 1.5e-3_dp
   integer :: failures = 0

   call a_bow_crosses_a_straight_wire_twice()
   call straight_wires_cross_once()
   if (failures > 0) error stop 1

contains

   !> The axis of the bow is y = -1 mm + (L/4) sin(a) (1 - xi^2): it passes over y = 0 at two places.
   subroutine a_bow_crosses_a_straight_wire_twice()
      real(dp), parameter :: angle = 23*pi/180
      real(dp) :: x(3, 4), t(3, 4), xi_bar, xi, others(2, max_minima), exact
      integer :: status, n

      x = reshape([-0.01_dp, -1.0e-3_dp, height, 0.01_dp, -1.0e-3_dp, height, -0.01_dp, 0.0_dp, 0.0_dp, &
         0.01_dp, 0.0_dp, 0.0_dp], [3, 4])
      t = reshape([cos(angle), sin(angle), 0.0_dp, cos(angle), -sin(angle), 0.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, &
         1.0_dp, 0.0_dp, 0.0_dp], [3, 4])
      call closest_points(x, t, length, axis_hermite, xi_bar, xi, status, others=others, n_others=n)
      exact = sqrt(1 - 1.0e-3_dp/(length(1)/4*sin(angle)))
      call check(status == closest_not_unique, 'both are as near')
      call check(n == 1, 'one more crossing')
      call check(abs(abs(xi_bar) - exact) < 1.0e-9_dp, 'where the bow passes over the wire')
      call check(abs(xi_bar + others(1, 1)) < 1.0e-9_dp .and. abs(xi + others(2, 1)) < 1.0e-9_dp, &
         'the other place is the mirror image')
   end subroutine a_bow_crosses_a_straight_wire_twice

   subroutine straight_wires_cross_once()
      real(dp) :: x(3, 4), t(3, 4), xi_bar, xi, others(2, max_minima)
      integer :: status, n

      x = reshape([-0.01_dp, -1.0e-3_dp, height, 0.01_dp, 1.0e-3_dp, height, -0.01_dp, 0.0_dp, 0.0_dp, &
         0.01_dp, 0.0_dp, 0.0_dp], [3, 4])
      t(:, 1) = (x(:, 2) - x(:, 1))/norm2(x(:, 2) - x(:, 1))
      t(:, 2) = t(:, 1)
      t(:, 3) = [1.0_dp, 0.0_dp, 0.0_dp]
      t(:, 4) = t(:, 3)
      call closest_points(x, t, length, axis_hermite, xi_bar, xi, status, others=others, n_others=n)
      call check(status == closest_inside .and. n == 0, 'a single crossing')
      call check(abs(xi_bar) < 1.0e-9_dp .and. abs(xi) < 1.0e-9_dp, 'in the middle')
   end subroutine straight_wires_cross_once

   subroutine check(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what

      if (holds) return
      failures = failures + 1
      print '(2a)', 'FAILED: ', what
   end subroutine check

end program test_closest_minima
