!> How large the next increment of time is. Source: the rules and names of CalculiX's *CONTROLS.
module litz_step_control
   use litz_kinds, only: dp
   use litz_contact_findings, only: finding_t
   use litz_model, only: step_t
   implicit none
   private
   public :: step_control_t, course_t

   !> Increments that are given up because of the same two wires, one after the other: where they pass each other, and
   !> where they touch in a way that is not modelled
   integer, parameter :: max_passages = 12, max_unmodelled = 3
   !> Increments that are given up because the ends of an element are turned too far, one after the other
   integer, parameter :: max_turned = 3
   !> Part of the largest bearable increment that is taken next; Abaqus's D_t
   real(dp), parameter :: safety = 0.85_dp

   type :: step_control_t
      !> Increment wanted next
      real(dp) :: wanted = 0
      !> Quick increments in a row
      integer :: quick = 0
      !> Refusals of the same contact in a row, and the step time up to which they count
      integer :: refusals = 0
      real(dp) :: refused_time = 0
      type(finding_t) :: refused
      !> The same for elements whose ends are turned too far
      integer :: turned = 0
      real(dp) :: turned_time = 0
   contains
      procedure :: refuse, refuse_turned
      procedure :: start
      procedure :: propose
      procedure :: accept
      procedure :: cut
   end type step_control_t

   !> Where a run stands beside its state.
   type :: course_t
      type(step_control_t) :: control
      !> Total time at the start of the step [s]
      real(dp) :: start_time = 0
   end type course_t

contains

   pure subroutine start(self, step)
      class(step_control_t), intent(inout) :: self
      type(step_t), intent(in) :: step

      self%wanted = min(step%first, step%total)
      self%quick = 0
      self%refusals = 0
      self%turned = 0
   end subroutine start

   !> After an increment that has lost a contact; `.false.`: smaller ones have lost the same contact often enough, or
   !> come to the same.
   logical function refuse(self, finding, wire, step_time) result(possible)
      class(step_control_t), intent(inout) :: self
      type(finding_t), intent(in) :: finding
      !> Wire of each element (n_elements)
      integer, intent(in) :: wire(:)
      !> Step time at the end of the increment
      real(dp), intent(in) :: step_time

      if (self%refusals > 0 .and. finding%is_like(self%refused, wire)) then
         self%refusals = self%refusals + 1
      else
         self%refusals = 1
         self%refused_time = step_time
      end if
      self%refused = finding
      possible = .not. finding%is_final .and. &
         self%refusals <= merge(max_passages, max_unmodelled, finding%can_be_cut())
   end function refuse

   !> After an increment that has turned the ends of an element too far; `.false.`: smaller ones have done so often
   !> enough.
   logical function refuse_turned(self, step_time) result(possible)
      class(step_control_t), intent(inout) :: self
      !> Step time at the end of the increment
      real(dp), intent(in) :: step_time

      if (self%turned == 0) self%turned_time = step_time
      self%turned = self%turned + 1
      possible = self%turned <= max_turned
   end function refuse_turned

   !> The increment to try at a step time, not beyond the next break point, and without leaving a tiny one before it.
   pure real(dp) function propose(self, step_time, break_point) result(increment)
      class(step_control_t), intent(in) :: self
      !> Time since the step began, and next time in the step that no increment may pass over [s]
      real(dp), intent(in) :: step_time, break_point
      real(dp) :: left

      left = break_point - step_time
      increment = self%wanted
      if (increment > left*(1 - 1.0e-6_dp)) then
         increment = left
      else if (increment > left/2) then
         increment = left/2
      end if
   end function propose

   !> After a converged increment.
   pure subroutine accept(self, step, step_time, iterations, bearable)
      class(step_control_t), intent(inout) :: self
      type(step_t), intent(in) :: step
      !> At the end of the increment
      real(dp), intent(in) :: step_time
      !> Iterations that the increment took
      integer, intent(in) :: iterations
      !> Increment that would have been the largest bearable one [s]
      real(dp), intent(in) :: bearable

      if (step_time >= self%refused_time) self%refusals = 0
      if (step_time >= self%turned_time) self%turned = 0
      if (step%direct) return
      if (iterations <= step%controls%i_g) then
         self%quick = self%quick + 1
      else
         self%quick = 0
      end if
      if (iterations > step%controls%i_l) then
         self%wanted = self%wanted*step%controls%d_b
      else if (self%quick >= 2) then
         self%wanted = self%wanted*step%controls%d_d
      end if
      self%wanted = min(step%largest, max(step%smallest, min(self%wanted, safety*bearable)))
   end subroutine accept

   !> After a failed increment; `.false.`: it cannot get smaller.
   logical function cut(self, step, failed_increment, attempts, ratio) result(possible)
      class(step_control_t), intent(inout) :: self
      type(step_t), intent(in) :: step
      !> Size of the increment that failed [s]
      real(dp), intent(in) :: failed_increment
      !> Attempts at this increment so far
      integer, intent(in) :: attempts
      !> What the increment bore, over its size; 1: that is not why it has failed
      real(dp), intent(in) :: ratio

      self%quick = 0
      self%wanted = failed_increment*merge(safety*ratio, step%controls%d_f, ratio < 1)
      if (ratio < 1 .and. failed_increment > step%smallest) self%wanted = max(self%wanted, step%smallest)
      possible = .not. step%direct .and. attempts <= step%controls%i_a .and. self%wanted >= step%smallest
   end function cut

end module litz_step_control
