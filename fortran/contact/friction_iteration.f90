!> The traction of a contact as an independent variable of the iteration, as the normal force is (theory section 9).
!>
!> The return map alone can send an iteration to and fro for ever: from slip one way, with the constant force of slip,
!> to slip the other way, past a stick zone that is a thousand times smaller than the step. So the last linear step
!> predicts the trial traction, by which the contact sticks or slips in the next iteration, and the traction about which
!> a slip is linearised. While a slip turns back, the two are of opposite directions, and the tangent resists along
!> the slip, too: softly, as its limit over the trial traction is small; a stick would move the rest of the model.
!>
!> Source: theory (9.1); S. Hueeber, G. Stadler, B. I. Wohlmuth, SIAM J. Sci. Comput. 30 (2008) 572-596.
module litz_friction_iteration
   use litz_kinds, only: dp
   use litz_contact_kinematics, only: n_motions
   use litz_friction_law, only: cut_to, friction_none, friction_stick, friction_slip
   implicit none
   private
   public :: friction_iteration_t, predict_friction, forget_friction, place_touch

   type :: friction_iteration_t
      !> Status that the iteration supposes; `friction_none`: nothing yet
      integer :: status = friction_none
      !> Predicted traction: that of the geometric stiffness, and of the tangent of a slip (2) [N]
      real(dp) :: mixed_traction(2) = 0
      !> Trial traction of this iteration (2) [N] and how it changes with the unknowns of the contact (24, 2)
      real(dp) :: trial(2) = 0, dtrial(n_motions, 2) = 0
      !> Limit of friction that this iteration supposes [N], and how it changes (24)
      real(dp) :: limit = 0, dlimit(n_motions) = 0
      !> How the residual changes with the limit (24); it does so where the contact slips
      real(dp) :: along(n_motions) = 0
      !> What the supposed status and the law of the present place differ by (24) [N, N m]
      real(dp) :: difference(n_motions) = 0
      !> The contact was open when the increment began and has been closed since
      logical :: touched = .false.
      !> Arc lengths of the places along the barred and the unbarred wire (2) [m] and the normal (3) when the increment
      !> began, and the part of the slip since then that follows the first touch
      real(dp) :: arc_before(2) = 0, normal_before(3) = 0, part = 1
      !> The first direction of the slip is between the one wire and the reverse of the other
      logical :: reverses = .false.
   end type friction_iteration_t

contains

   !> A contact that the iteration has opened supposes nothing when it closes again; where it first closed stays.
   pure subroutine forget_friction(iteration)
      type(friction_iteration_t), intent(inout) :: iteration

      iteration%difference = 0
      if (iteration%status == friction_none) return
      iteration = friction_iteration_t(touched=iteration%touched, arc_before=iteration%arc_before, &
         normal_before=iteration%normal_before, part=iteration%part, reverses=iteration%reverses)
   end subroutine forget_friction

   !> Where a contact was when the increment began in which it closes: of the slip since then it has the part after the
   !> touch.
   !>
   !> Asked when the iteration first finds it closed, so that nothing has held the overlap back yet: gap and places of a
   !> motion in proportion go straight from their start to here, and the gap is zero after `g_0/(g_0 - g)` of the way.
   !> The touch is then kept, and the equations of the increment with it.
   pure subroutine place_touch(gap_start, gap, arc, normal, iteration)
      !> Gap when the increment began, and now, below zero [m]
      real(dp), intent(in) :: gap_start, gap
      !> Arc lengths of the places (2) [m] and normal (3) when the increment began
      real(dp), intent(in) :: arc(2), normal(3)
      type(friction_iteration_t), intent(inout) :: iteration

      iteration%touched = .true.
      iteration%arc_before = arc
      iteration%normal_before = normal
      iteration%part = closed_share(gap_start, gap)
   end subroutine place_touch

   !> The part of a motion in proportion for which a contact is closed.
   pure real(dp) function closed_share(gap_start, gap)
      !> As in `place_touch`
      real(dp), intent(in) :: gap_start, gap

      closed_share = 1
      if (gap_start > 0) closed_share = gap/(gap - gap_start)
   end function closed_share

   !> Status and traction of the next iteration, after a linear step `dq` of the contact's 24 unknowns.
   pure subroutine predict_friction(dq, iteration)
      !> Motion of the four nodes (24) [m, rad]
      real(dp), intent(in) :: dq(n_motions)
      type(friction_iteration_t), intent(inout) :: iteration
      real(dp) :: trial(2), limit

      if (iteration%status == friction_none) return
      trial = iteration%trial + matmul(dq, iteration%dtrial)
      limit = max(0.0_dp, iteration%limit + dot_product(iteration%dlimit, dq))
      iteration%mixed_traction = cut_to(limit, predicted_traction(trial, limit, iteration))
      iteration%status = merge(friction_stick, friction_slip, norm2(trial) <= limit)
   end subroutine predict_friction

   !> Traction after the linear step: of a contact that slips that of the tangent (9.1).
   pure function predicted_traction(trial, limit, iteration) result(traction)
      !> Trial traction (2) and limit after the step [N]
      real(dp), intent(in) :: trial(2), limit
      type(friction_iteration_t), intent(in) :: iteration
      real(dp) :: traction(2), direction(2), change(2)

      traction = trial
      if (iteration%status == friction_stick .or. .not. norm2(iteration%trial) > 0) return
      direction = iteration%trial/norm2(iteration%trial)
      change = (trial - iteration%trial)/norm2(iteration%trial)
      traction = limit*direction + iteration%limit*change &
         - cut_to(iteration%limit, iteration%mixed_traction)*dot_product(direction, change)
   end function predicted_traction

end module litz_friction_iteration
