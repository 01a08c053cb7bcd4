!> The force by which a contact resists to be bent otherwise: the derivative of curvatures; and its tangent.
program test_contact_bending
   use litz_axis, only: axis_shape, on_axis
   use litz_axis_choices, only: axis_hermite
   use litz_closest_points, only: closest_points, closest_inside
   use litz_contact_bending, only: bends_seen_t, contact_bending, risen
   use litz_contact_kinematics, only: contact_kinematics_t, contact_kinematics, kinematics_ok
   use litz_kinds, only: dp
   use litz_rotations, only: cross, rotation_exp
   implicit none

   !> Two wires bent about each other at 23 degrees, neither of them in a plane
   real(dp), parameter :: length(2) = [1.1_dp, 0.9_dp], radius(2) = [0.2_dp, 0.15_dp], step = 1.0e-6_dp
   real(dp), parameter :: by_curvature(2) = [0.7_dp, -0.4_dp]
   real(dp) :: x(3, 4), t(3, 4), k(24, 24), r(24)
   type(contact_kinematics_t) :: kinematics
   integer :: failures = 0

   call prepare()
   call the_force_is_the_derivative_of_the_curvatures()
   call forces_and_moments_are_in_balance()
   call the_tangent_is_the_symmetric_part_of_the_derivative()
   if (failures > 0) error stop 1

contains

   subroutine prepare()
      real(dp) :: along(3, 2)
      integer :: i

      along = reshape([1.0_dp, 0.0_dp, 0.0_dp, 0.92_dp, 0.39_dp, 0.0_dp], [3, 2])
      do i = 1, 2
         associate (first => 2*i - 1, side => merge(1.0_dp, -1.0_dp, i == 1))
            x(:, first) = -0.48_dp*length(i)*along(:, i) + [0.0_dp, 0.0_dp, 0.2_dp*side]
            x(:, first + 1) = 0.52_dp*length(i)*along(:, i) + [0.0_dp, 0.05_dp, 0.17_dp*side]
            t(:, first) = unit(along(:, i) + [0.0_dp, 0.05_dp*side, -0.09_dp*side])
            t(:, first + 1) = unit(along(:, i) + [0.02_dp, -0.03_dp, 0.06_dp*side])
         end associate
      end do
      kinematics = kinematics_of(x, t)
      call check(sin(kinematics%angle) > 0.3_dp .and. sin(kinematics%angle) < 0.5_dp, 'the angle is small')
   end subroutine prepare

   !> The law sees the curvature vector at a place that stays, and what it changes along the wires.
   subroutine the_force_is_the_derivative_of_the_curvatures()
      type(bends_seen_t) :: seen
      real(dp) :: differences(24), xc(3, 4), tc(3, 4), energy(-1:1)
      integer :: j, side, i

      seen%part = [0.9_dp, 0.6_dp]
      seen%place = [kinematics%xi_bar + 0.2_dp, kinematics%xi - 0.1_dp]
      seen%change = reshape([0.1_dp, 0.3_dp, -0.5_dp, 0.2_dp, 0.1_dp, 0.4_dp], [3, 2])
      call contact_bending(kinematics, x, t, length, axis_hermite, radius, seen, by_curvature, k, r)
      do j = 1, 24
         do side = -1, 1, 2
            call change(j, side*step, xc, tc)
            energy(side) = energy_at(xc, tc, seen)
         end do
         differences(j) = (energy(1) - energy(-1))/(2*step)
      end do
      call check(maxval(abs(r - differences)) < 1.0e-8_dp*maxval(abs(r)), 'the force is a derivative')
      call check(all([(maxval(abs(r(6*i - 5:6*i))) > 0, i=1, 4)]), 'all nodes have a force')
   end subroutine the_force_is_the_derivative_of_the_curvatures

   subroutine forces_and_moments_are_in_balance()
      type(bends_seen_t) :: seen
      real(dp) :: force(3), moment(3)
      integer :: a

      call contact_bending(kinematics, x, t, length, axis_hermite, radius, seen, by_curvature, k, r)
      force = 0
      moment = 0
      do a = 1, 4
         associate (f => r(6*a - 5:6*a - 3), m => r(6*a - 2:6*a))
            force = force + f
            moment = moment + m + cross(x(:, a), f)
         end associate
      end do
      call check(norm2(force) < 1.0e-12_dp*norm2(r), 'forces are in balance')
      call check(norm2(moment) < 1.0e-12_dp*norm2(r), 'moments are in balance')
   end subroutine forces_and_moments_are_in_balance

   subroutine the_tangent_is_the_symmetric_part_of_the_derivative()
      type(bends_seen_t) :: seen
      type(contact_kinematics_t) :: there
      real(dp) :: derivative(24, 24), xc(3, 4), tc(3, 4), sides(24, -1:1), unused(24, 24)
      integer :: j, side

      seen%place = [kinematics%xi_bar, kinematics%xi]
      seen%change = reshape([0.1_dp, 0.3_dp, -0.5_dp, 0.2_dp, 0.1_dp, 0.4_dp], [3, 2])
      do j = 1, 24
         do side = -1, 1, 2
            call change(j, side*step, xc, tc)
            there = kinematics_of(xc, tc)
            call contact_bending(there, xc, tc, length, axis_hermite, radius, seen, by_curvature, unused, &
               sides(:, side))
         end do
         derivative(:, j) = (sides(:, 1) - sides(:, -1))/(2*step)
      end do
      call contact_bending(kinematics, x, t, length, axis_hermite, radius, seen, by_curvature, k, r)
      call check(maxval(abs(k - transpose(k))) <= 0, 'the tangent is symmetric')
      call check(maxval(abs(k - (derivative + transpose(derivative))/2)) < 1.0e-5_dp*maxval(abs(k)), &
         'the tangent is a derivative')
      kinematics%angle = 0.6_dp
      call contact_bending(kinematics, x, t, length, axis_hermite, radius, seen, by_curvature, k, r)
      call check(.not. any(abs(k) > 0), 'there is none at large angles')
   end subroutine the_tangent_is_the_symmetric_part_of_the_derivative

   !> `sum Pi_kappa kappa` near the present state, of which the force is the derivative.
   real(dp) function energy_at(xc, tc, seen) result(energy)
      !> Nodal positions and unit tangents (3, 4)
      real(dp), intent(in) :: xc(3, 4), tc(3, 4)
      type(bends_seen_t), intent(in) :: seen
      type(contact_kinematics_t) :: there
      real(dp), dimension(4) :: h, h1, h2
      real(dp) :: xi(2), v(3)
      integer :: i

      there = kinematics_of(xc, tc)
      xi = [there%xi_bar, there%xi]
      energy = 0
      do i = 1, 2
         associate (first => 2*i - 1, last => 2*i, away => merge(1, -1, i == 1))
            call axis_shape(axis_hermite, length(i), seen%place(i), h, h1, h2)
            v = seen%part(i)*on_axis(h2, xc(:, first:last), tc(:, first:last))/(length(i)/2)**2
            v = v + seen%change(:, i)*(risen(xi(i)) - risen(seen%place(i)))
            energy = energy + by_curvature(i)*away*dot_product(there%normal, v)
         end associate
      end do
   end function energy_at

   !> The state with one unknown changed.
   subroutine change(j, by, xc, tc)
      integer, intent(in) :: j
      real(dp), intent(in) :: by
      real(dp), intent(out) :: xc(3, 4), tc(3, 4)
      real(dp) :: spin(3)
      integer :: node, i

      node = (j - 1)/6 + 1
      i = j - 6*(node - 1)
      xc = x
      tc = t
      if (i <= 3) then
         xc(i, node) = xc(i, node) + by
         return
      end if
      spin = 0
      spin(i - 3) = by
      tc(:, node) = matmul(rotation_exp(spin), t(:, node))
   end subroutine change

   type(contact_kinematics_t) function kinematics_of(xc, tc) result(found)
      !> Nodal positions and unit tangents (3, 4)
      real(dp), intent(in) :: xc(3, 4), tc(3, 4)
      real(dp) :: xi_bar, xi
      integer :: status, info

      call closest_points(xc, tc, length, axis_hermite, xi_bar, xi, status)
      call check(status == closest_inside, 'the wires cross')
      call contact_kinematics(xc, tc, length, axis_hermite, radius, xi_bar, xi, 0, found, info)
      call check(info == kinematics_ok, 'the contact is regular')
   end function kinematics_of

   pure function unit(v)
      !> (3)
      real(dp), intent(in) :: v(3)
      real(dp) :: unit(3)

      unit = v/norm2(v)
   end function unit

   subroutine check(ok, what)
      logical, intent(in) :: ok
      character(len=*), intent(in) :: what

      if (ok) return
      failures = failures + 1
      print '(2a)', 'failed: ', what
   end subroutine check

end program test_contact_bending
