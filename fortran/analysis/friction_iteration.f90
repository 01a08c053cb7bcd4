!> The traction of a contact as an independent variable of the iteration, as the normal force is (theory section 9).
!>
!> The return map alone can send an iteration to and fro for ever: from slip one way, with the constant force of slip,
!> to slip the other way, past a stick zone that is a thousand times smaller than the step. So the status of a contact
!> follows from the trial traction that the last linear step predicted: it sticks in the next iteration when that lies
!> in the cone, or when it points against the slip of this one, since a slip that turns back passes through stick.
module litz_friction_iteration
   use litz_kinds, only: dp
   use litz_friction_law, only: friction_stick, friction_slip
   implicit none
   private
   public :: friction_iteration_t, predict_friction

   type :: friction_iteration_t
      !> Status that the iteration supposes
      integer :: status = friction_stick
      !> Traction of the geometric stiffness (2) [N]
      real(dp) :: mixed_traction(2) = 0
      !> Trial traction of this iteration (2) [N] and how it changes with the unknowns of the contact (24, 2)
      real(dp) :: trial(2) = 0, dtrial(24, 2) = 0
      !> Limit of friction that this iteration supposes [N], and how it changes (24)
      real(dp) :: limit = 0, dlimit(24) = 0
      !> What the supposed status and the law of the present place differ by (24) [N, N m]
      real(dp) :: difference(24) = 0
   end type friction_iteration_t

contains

   !> Status and traction of the next iteration, after a linear step `dq` of the contact's 24 unknowns.
   pure subroutine predict_friction(dq, iteration)
      real(dp), intent(in) :: dq(24)
      type(friction_iteration_t), intent(inout) :: iteration
      real(dp) :: trial(2), limit
      logical :: turns_back

      trial = iteration%trial + matmul(dq, iteration%dtrial)
      limit = max(0.0_dp, iteration%limit + dot_product(iteration%dlimit, dq))
      turns_back = iteration%status == friction_slip .and. dot_product(trial, iteration%trial) < 0
      if (turns_back .or. norm2(trial) <= limit) then
         iteration%status = friction_stick
      else
         iteration%status = friction_slip
      end if
      iteration%mixed_traction = trial
      if (norm2(trial) > limit) iteration%mixed_traction = trial*limit/norm2(trial)
   end subroutine predict_friction

end module litz_friction_iteration
