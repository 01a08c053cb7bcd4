!> What finds contacts that were lost: pieces that meet on their way, all local minima of a distance, sides of
!> crossings.
program test_lost_contacts
   use litz_kinds, only: dp, pi
   use litz_closest_points, only: local_minima, max_minima
   use litz_contact_kinematics, only: contact_kinematics_t, contact_kinematics, kinematics_ok
   use litz_contact_side, only: crossing_t, crossing_of, have_passed, have_kept
   use litz_axis_choices, only: axis_linear, axis_hermite
   use litz_moving_segments, only: meeting_time, never
   use litz_rotations, only: rotation_exp
   use litz_straight_segments, only: segment_distance
   implicit none

   integer :: failures = 0

   call start_random_numbers()
   call the_distance_of_segments_is_the_least_of_all_their_points()
   call segments_meet_when_sampled_motion_says_so()
   call parallel_segments_that_swap_sides_meet()
   call segments_that_pass_by_each_other_do_not_meet()
   call an_arc_that_crosses_a_line_twice_has_two_minima()
   call no_minimum_of_random_elements_is_overlooked()
   call rigid_motions_keep_the_side()
   call axes_that_pass_change_the_side()
   call wires_that_turn_through_the_parallel_keep_the_side()
   call an_unknown_start_decides_nothing()
   if (failures > 0) error stop 1

contains

   subroutine the_distance_of_segments_is_the_least_of_all_their_points()
      real(dp) :: x(3, 4)
      integer :: attempt

      do attempt = 1, 200
         call random_number(x)
         if (mod(attempt, 4) == 0) x(:, 4) = x(:, 3) + 0.7_dp*(x(:, 2) - x(:, 1))
         call check(abs(segment_distance(x) - sampled_distance(x, 300)) < 4.0e-3_dp, 'distance of two segments')
      end do
   end subroutine the_distance_of_segments_is_the_least_of_all_their_points

   !> Against 400 instants: a meeting that is reported is one, and none nearer than half the limit is overlooked.
   subroutine segments_meet_when_sampled_motion_says_so()
      real(dp), parameter :: limit = 0.05_dp
      real(dp) :: x_start(3, 4), x_end(3, 4), time, least
      integer :: attempt, i, n_meetings

      n_meetings = 0
      do attempt = 1, 500
         call random_number(x_start)
         call random_number(x_end)
         time = meeting_time(x_start, x_end, limit)
         if (time < never) then
            n_meetings = n_meetings + 1
            call check(time >= 0 .and. time <= 1, 'a meeting lies within the motion')
            call check(segment_distance((1 - time)*x_start + time*x_end) < limit, 'they are near when they meet')
         else
            least = huge(1.0_dp)
            do i = 0, 400
               least = min(least, segment_distance((1 - i/400.0_dp)*x_start + i/400.0_dp*x_end))
            end do
            call check(least > limit/2, 'no meeting is overlooked')
         end if
      end do
      call check(n_meetings > 50 .and. n_meetings < 450, 'some of the random motions meet, others do not')
   end subroutine segments_meet_when_sampled_motion_says_so

   subroutine parallel_segments_that_swap_sides_meet()
      real(dp) :: x_start(3, 4), x_end(3, 4)

      x_start = real(reshape([0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 0.2, 0.0, 0.0, 1.2, 0.0, 0.0], [3, 4]), dp)
      x_end = x_start
      x_end(3, 1:2) = -1
      call check(abs(meeting_time(x_start, x_end, 0.1_dp) - 0.5_dp) < 0.051_dp, 'parallel segments meet half way')
   end subroutine parallel_segments_that_swap_sides_meet

   !> One that goes round the end of the other.
   subroutine segments_that_pass_by_each_other_do_not_meet()
      real(dp) :: x_start(3, 4), x_end(3, 4)

      x_start = real(reshape([0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 1.2, -1.0, 0.0, 1.2, 1.0, 0.0], [3, 4]), dp)
      x_end = x_start
      x_end(3, 1:2) = -1
      call check(meeting_time(x_start, x_end, 0.1_dp) >= never, 'a gap of 0.2 at the end is no meeting')
   end subroutine segments_that_pass_by_each_other_do_not_meet

   !> An element bent by 46 degrees over a straight one that cuts its bow.
   subroutine an_arc_that_crosses_a_line_twice_has_two_minima()
      real(dp), parameter :: half = 23*pi/180
      real(dp) :: x(3, 4), t(3, 4), places(2, max_minima)
      integer :: n

      x(:, 1) = [-sin(half), cos(half), 0.01_dp]
      x(:, 2) = [sin(half), cos(half), 0.01_dp]
      t(:, 1) = [cos(half), sin(half), 0.0_dp]
      t(:, 2) = [cos(half), -sin(half), 0.0_dp]
      x(:, 3) = [-0.5_dp, 0.97_dp, 0.0_dp]
      x(:, 4) = [0.5_dp, 0.97_dp, 0.0_dp]
      t(:, 3) = [1.0_dp, 0.0_dp, 0.0_dp]
      t(:, 4) = t(:, 3)
      call local_minima(x, t, [2*half, 1.0_dp], axis_hermite, places, n)
      call check(n == 2, 'two minima')
      if (n /= 2) return
      call check(abs(sum(places(1, :2))) < 1.0e-6_dp, 'they lie opposite to each other on the arc')
      ! the circle is at the height of the line at cos(angle) = 0.97; the cubic leaves it by arc^4/384, over its slope
      ! there
      call check(all(abs(abs(places(1, :2))*half - acos(0.97_dp)) < (2*half)**4/384/0.24_dp), &
         'where the circle crosses the line')
   end subroutine an_arc_that_crosses_a_line_twice_has_two_minima

   !> The least distance on a fine grid is never below the best minimum.
   subroutine no_minimum_of_random_elements_is_overlooked()
      real(dp) :: x(3, 4), t(3, 4), places(2, max_minima), least
      integer :: attempt, n, i

      do attempt = 1, 100
         call random_number(x)
         call random_number(t)
         t = 2*t - 1
         do i = 1, 4
            t(:, i) = t(:, i)/norm2(t(:, i))
         end do
         call local_minima(x, t, [1.0_dp, 1.0_dp], axis_hermite, places, n)
         call check(n >= 1, 'there is a minimum')
         least = huge(1.0_dp)
         do i = 1, n
            least = min(least, distance_at(x, t, places(:, i)))
         end do
         call check(least <= sampled_axes(x, t) + 1.0e-9_dp, 'the least distance is among the minima')
      end do
   end subroutine no_minimum_of_random_elements_is_overlooked

   subroutine rigid_motions_keep_the_side()
      type(crossing_t) :: before, now
      real(dp) :: x(3, 4), turn(3, 3), angle(3)
      integer :: attempt

      do attempt = 1, 50
         x = crossed_at(1.0_dp, 0.2_dp)
         before = crossing(x)
         call random_number(angle)
         turn = rotation_exp(angle - 0.5_dp)
         now = crossing(matmul(turn, x))
         call check(.not. have_passed(before, now), 'a rotation of all is no passage')
         call check(have_kept(before, now), 'after a small turn that is beyond doubt')
      end do
   end subroutine rigid_motions_keep_the_side

   subroutine axes_that_pass_change_the_side()
      integer :: degrees

      do degrees = 2, 178, 4
         call check(have_passed(crossing(crossed_at(degrees*pi/180, 0.2_dp)), &
            crossing(crossed_at(degrees*pi/180, -0.2_dp))), 'axes that have passed are seen at all angles')
      end do
   end subroutine axes_that_pass_change_the_side

   subroutine wires_that_turn_through_the_parallel_keep_the_side()
      call check(.not. have_passed(crossing(crossed_at(0.2_dp, 0.2_dp)), crossing(crossed_at(-0.2_dp, 0.2_dp))), &
         'a turn through the parallel is no passage')
      call check(have_passed(crossing(crossed_at(0.2_dp, 0.2_dp)), crossing(crossed_at(-0.2_dp, -0.2_dp))), &
         'a turn with a passage is one')
   end subroutine wires_that_turn_through_the_parallel_keep_the_side

   subroutine an_unknown_start_decides_nothing()
      type(crossing_t) :: unknown

      call check(.not. have_passed(unknown, crossing(crossed_at(1.0_dp, -0.2_dp))), 'no passage without a start')
      call check(.not. have_kept(unknown, crossing(crossed_at(1.0_dp, 0.2_dp))), 'nothing kept without a start')
   end subroutine an_unknown_start_decides_nothing

   !> Two straight elements through the origin under an angle [rad], the barred one at a height.
   pure function crossed_at(angle, height) result(x)
      real(dp), intent(in) :: angle, height
      real(dp) :: x(3, 4)

      x(:, 1) = [-cos(angle), -sin(angle), height]
      x(:, 2) = [cos(angle), sin(angle), height]
      x(:, 3) = [-1.0_dp, 0.0_dp, 0.0_dp]
      x(:, 4) = [1.0_dp, 0.0_dp, 0.0_dp]
   end function crossed_at

   type(crossing_t) function crossing(x)
      real(dp), intent(in) :: x(3, 4)
      type(contact_kinematics_t) :: kinematics
      real(dp) :: t(3, 4)
      integer :: info

      t(:, 1:2) = spread((x(:, 2) - x(:, 1))/2, 2, 2)
      t(:, 3:4) = spread((x(:, 4) - x(:, 3))/2, 2, 2)
      call contact_kinematics(x, t, [2.0_dp, 2.0_dp], axis_linear, [0.1_dp, 0.1_dp], 0.0_dp, 0.0_dp, 0, kinematics, &
         info)
      call check(info == kinematics_ok, 'the elements cross')
      crossing = crossing_of(kinematics, [1, 1], [0.0_dp, 0.0_dp], .false.)
   end function crossing

   !> Least distance of the points of two segments.
   pure real(dp) function sampled_distance(x, n) result(least)
      real(dp), intent(in) :: x(3, 4)
      integer, intent(in) :: n
      real(dp) :: a(3), b(3)
      integer :: i, j

      least = huge(1.0_dp)
      do i = 0, n
         a = x(:, 1) + real(i, dp)/n*(x(:, 2) - x(:, 1))
         do j = 0, n
            b = x(:, 3) + real(j, dp)/n*(x(:, 4) - x(:, 3))
            least = min(least, norm2(a - b))
         end do
      end do
   end function sampled_distance

   !> Least distance of the points of two cubic elements of unit length.
   pure real(dp) function sampled_axes(x, t) result(least)
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      integer :: i, j

      least = huge(1.0_dp)
      do i = -60, 60
         do j = -60, 60
            least = min(least, distance_at(x, t, [i/60.0_dp, j/60.0_dp]))
         end do
      end do
   end function sampled_axes

   pure real(dp) function distance_at(x, t, place) result(distance)
      real(dp), intent(in) :: x(3, 4), t(3, 4), place(2)

      distance = norm2(hermite(x(:, 1:2), t(:, 1:2), place(1)) - hermite(x(:, 3:4), t(:, 3:4), place(2)))
   end function distance_at

   !> Cubic through two points with given slopes over a unit length.
   pure function hermite(x, t, xi) result(point)
      real(dp), intent(in) :: x(3, 2), t(3, 2), xi
      real(dp) :: point(3), s

      s = (1 + xi)/2
      point = (1 + 2*s)*(1 - s)**2*x(:, 1) + s*(1 - s)**2*t(:, 1) + s**2*(3 - 2*s)*x(:, 2) + s**2*(s - 1)*t(:, 2)
   end function hermite

   subroutine start_random_numbers()
      integer :: n

      call random_seed(size=n)
      call random_seed(put=spread(20260, 1, n))
   end subroutine start_random_numbers

   subroutine check(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what

      if (holds) return
      failures = failures + 1
      if (failures <= 20) print '(2a)', 'FAILED: ', what
   end subroutine check

end program test_lost_contacts
