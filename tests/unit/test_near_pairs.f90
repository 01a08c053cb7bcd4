!> What two elements are apart at least, carried along with their motion.
program test_near_pairs
   use litz_kinds, only: dp
   use litz_axis, only: axis_polynomial
   use litz_axis_choices, only: axis_hermite
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_near_pairs, only: near_pairs_t
   use litz_rotations, only: rotation_exp, cross
   use litz_wires, only: wires_t
   implicit none

   integer, parameter :: candidates(3, 1) = reshape([1, 2, 1], [3, 1])
   integer :: failures = 0

   call random_seed(put=spread(4711, 1, 64))
   call elements_are_never_nearer_than_what_is_known_of_them()
   call a_common_motion_brings_nothing_together()
   call a_step_that_brings_elements_together_is_foreseen()
   call a_pair_with_points_is_not_foreseen()
   if (failures > 0) error stop 1

contains

   subroutine elements_are_never_nearer_than_what_is_known_of_them()
      type(model_t) :: model
      type(wires_t) :: wires
      type(elements_t) :: elements
      type(near_pairs_t) :: near
      real(dp) :: x(3, 4), rotation(3, 3, 4), motion(3, 4), spin(3, 4)
      integer :: attempt, step, a, n_useful

      n_useful = 0
      do attempt = 1, 50
         call set_up(model, wires, elements, x, rotation)
         call near%forget(1)
         call near%follow(model, wires, elements, candidates, x, rotation)
         near%clear = least_distance(x, tangents_of(wires, rotation))
         do step = 1, 10
            call random_number(motion)
            call random_number(spin)
            x = x + 0.02_dp*(motion - 0.5_dp)
            do a = 1, 4
               rotation(:, :, a) = matmul(rotation_exp(0.04_dp*(spin(:, a) - 0.5_dp)), rotation(:, :, a))
            end do
            call near%follow(model, wires, elements, candidates, x, rotation)
            call check(near%clear(1) <= least_distance(x, tangents_of(wires, rotation)), 'a bound from below')
         end do
         if (near%clear(1) > 0) n_useful = n_useful + 1
      end do
      call check(n_useful > 25, 'small motions leave most pairs clear')
   end subroutine elements_are_never_nearer_than_what_is_known_of_them

   subroutine a_common_motion_brings_nothing_together()
      type(model_t) :: model
      type(wires_t) :: wires
      type(elements_t) :: elements
      type(near_pairs_t) :: near
      real(dp) :: x(3, 4), rotation(3, 3, 4)

      call set_up(model, wires, elements, x, rotation)
      call near%forget(1)
      call near%follow(model, wires, elements, candidates, x, rotation)
      near%clear = 0.3_dp
      call near%follow(model, wires, elements, candidates, x + 5, rotation)
      call check(abs(near%clear(1) - 0.3_dp) < 1.0e-14_dp, 'both have moved alike')
   end subroutine a_common_motion_brings_nothing_together

   !> The axes of the linear step: nodes and tangents move in proportion.
   subroutine a_step_that_brings_elements_together_is_foreseen()
      type(model_t) :: model
      type(wires_t) :: wires
      type(elements_t) :: elements
      type(near_pairs_t) :: near
      real(dp) :: x(3, 4), rotation(3, 3, 4), motion(3, 4), spin(3, 4), t(3, 4)
      logical :: comes(1)
      integer :: attempt, a, n_foreseen
      real(dp), parameter :: thickness = 0.4_dp

      n_foreseen = 0
      do attempt = 1, 300
         call set_up(model, wires, elements, x, rotation)
         t = tangents_of(wires, rotation)
         call near%forget(1)
         near%clear = least_distance(x, t) - thickness
         call random_number(motion)
         call random_number(spin)
         ! from small steps to large ones
         motion = attempt/600.0_dp*(motion - 0.5_dp)
         spin = attempt/600.0_dp*(spin - 0.5_dp)
         comes = near%come_near(model, elements, candidates, motion, spin)
         if (comes(1)) n_foreseen = n_foreseen + 1
         do a = 1, 4
            t(:, a) = t(:, a) + cross(spin(:, a), t(:, a))
         end do
         if (least_distance(x + motion, t) < thickness) call check(comes(1), 'the step is foreseen')
      end do
      call check(n_foreseen > 30 .and. n_foreseen < 270, 'some steps bring elements together, others do not')
   end subroutine a_step_that_brings_elements_together_is_foreseen

   subroutine a_pair_with_points_is_not_foreseen()
      type(model_t) :: model
      type(wires_t) :: wires
      type(elements_t) :: elements
      type(near_pairs_t) :: near
      real(dp) :: x(3, 4), rotation(3, 3, 4)
      logical :: comes(1)

      call set_up(model, wires, elements, x, rotation)
      call near%forget(1)
      near%has_points = .true.
      comes = near%come_near(model, elements, candidates, x, x)
      call check(.not. comes(1), 'it has its points already')
   end subroutine a_pair_with_points_is_not_foreseen

   !> Two bent elements of length 1, some 0.6 apart.
   subroutine set_up(model, wires, elements, x, rotation)
      type(model_t), intent(out) :: model
      type(wires_t), intent(out) :: wires
      type(elements_t), intent(out) :: elements
      !> Nodes (3, 4), rotations (3, 3, 4)
      real(dp), intent(out) :: x(3, 4), rotation(3, 3, 4)
      real(dp) :: t(3, 4)
      integer :: a

      model%n_elements = 2
      model%n_nodes = 4
      model%connectivity = reshape([1, 2, 3, 4], [2, 2])
      elements%length = [1.0_dp, 1.0_dp]
      call random_number(x)
      x = 0.2_dp*x
      x(1, [2, 4]) = x(1, [2, 4]) + 1
      x(3, 3:4) = x(3, 3:4) + 0.6_dp
      call random_number(t)
      t = 0.4_dp*(t - 0.5_dp)
      t(1, :) = 1
      do a = 1, 4
         t(:, a) = t(:, a)/norm2(t(:, a))
         rotation(:, :, a) = rotation_exp([0.0_dp, 0.0_dp, 0.0_dp])
      end do
      wires%contact_tangents0 = reshape(t, [3, 2, 2])
   end subroutine set_up

   function tangents_of(wires, rotation) result(t)
      type(wires_t), intent(in) :: wires
      real(dp), intent(in) :: rotation(3, 3, 4)
      real(dp) :: t(3, 4)
      integer :: a

      do a = 1, 4
         t(:, a) = matmul(rotation(:, :, a), wires%contact_tangents0(:, 2 - mod(a, 2), (a + 1)/2))
      end do
   end function tangents_of

   !> Of the two axes, sampled.
   real(dp) function least_distance(x, t) result(least)
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      real(dp) :: p(3, 0:3, 2), point(3, 2), xi(2)
      integer, parameter :: n = 60
      integer :: i, j

      p(:, :, 1) = axis_polynomial(axis_hermite, 1.0_dp, x(:, 1:2), t(:, 1:2))
      p(:, :, 2) = axis_polynomial(axis_hermite, 1.0_dp, x(:, 3:4), t(:, 3:4))
      least = huge(least)
      do i = 0, n
         do j = 0, n
            xi = -1 + 2*[i, j]/real(n, dp)
            point(:, 1) = p(:, 0, 1) + xi(1)*(p(:, 1, 1) + xi(1)*(p(:, 2, 1) + xi(1)*p(:, 3, 1)))
            point(:, 2) = p(:, 0, 2) + xi(2)*(p(:, 1, 2) + xi(2)*(p(:, 2, 2) + xi(2)*p(:, 3, 2)))
            least = min(least, norm2(point(:, 1) - point(:, 2)))
         end do
      end do
   end function least_distance

   subroutine check(condition, what)
      logical, intent(in) :: condition
      character(len=*), intent(in) :: what

      if (condition) return
      failures = failures + 1
      print '(a)', 'FAILED: '//what
   end subroutine check

end program test_near_pairs
