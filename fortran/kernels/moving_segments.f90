!> When two straight pieces that move meet.
!>
!> Conservative advancement: at a distance d, and while no two points of the pieces approach each other faster than v,
!> nothing can happen for a time d/v. No root of a polynomial is asked for, so that parallel and coplanar pieces and
!> their ends are no special cases. Source: B. Mirtich, Impulse-based dynamic simulation of rigid body systems, 1996.
module litz_moving_segments
   use litz_kinds, only: dp
   use litz_straight_segments, only: segment_distance
   implicit none
   private
   public :: meeting_time, never, largest_relative_motion

   !> What stands for a time at which nothing happens
   real(dp), parameter :: never = 2.0_dp

contains

   !> Time from 0 to 1 at which two straight pieces, whose ends move uniformly, are first seen nearer than `limit`;
   !> `never`: they stay farther apart than half of it.
   pure real(dp) function meeting_time(x_start, x_end, limit) result(time)
      !> Ends of the one and of the other piece at the times 0 and 1 (3, 4) [m]
      real(dp), intent(in) :: x_start(3, 4), x_end(3, 4)
      !> Greater than 0 [m]
      real(dp), intent(in) :: limit
      real(dp) :: speed, distance

      speed = largest_relative_motion(x_start, x_end)
      time = 0
      do
         distance = segment_distance((1 - time)*x_start + time*x_end)
         if (distance < limit) return
         if (distance - limit/2 >= (1 - time)*speed) exit
         time = time + (distance - limit/2)/speed
      end do
      time = never
   end function meeting_time

   !> No point of the one piece moves by more than this relative to any point of the other [m].
   pure real(dp) function largest_relative_motion(x_start, x_end) result(motion)
      !> Ends of the one and of the other piece before and after (3, 4) [m]
      real(dp), intent(in) :: x_start(3, 4), x_end(3, 4)
      real(dp) :: move(3, 4)
      integer :: i, j

      move = x_end - x_start
      motion = 0
      do i = 1, 2
         do j = 3, 4
            motion = max(motion, norm2(move(:, i) - move(:, j)))
         end do
      end do
   end function largest_relative_motion

end module litz_moving_segments
