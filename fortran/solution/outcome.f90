!> What has become of an increment: its iterations, the turns of a sweep, and why it was given up.
module litz_outcome
   use litz_kinds, only: dp
   use litz_contact_findings, only: finding_t
   use litz_convergence, only: part_of_allowed
   use litz_fields, only: group_mechanical, group_transport
   use litz_reports, only: iteration_report_t
   implicit none
   private
   public :: outcome_t
   public :: cause_iterations, cause_not_finite, cause_singular, cause_lost_contact, cause_turned_ends, &
      cause_fed_part, cause_no_solution, cause_failed_law, cause_large_change, cause_exceeded_limit

   !> Why an increment is given up
   integer, parameter :: cause_iterations = 1, cause_not_finite = 2, cause_singular = 3, cause_lost_contact = 4, &
      cause_turned_ends = 5, cause_failed_law = 6, cause_fed_part = 7, cause_no_solution = 8, &
      cause_large_change = 9, cause_exceeded_limit = 10

   type :: outcome_t
      logical :: converged = .false.
      !> All of them, and those with a tangent of their own
      integer :: iterations = 0, factorisations = 0
      !> The last one was solved with the tangent of an earlier one
      logical :: kept_tangent = .false.
      !> The latter until the forces first balanced: what terms then bring up to date says nothing about the
      !> size of the increment
      integer :: to_balance = 0
      !> Linear steps of which next to nothing could be taken
      integer, private :: short_steps = 0
      !> The group whose turn it is, iterations since its turn began, most of them in a turn, and how often groups that
      !> act back on the first ones have had theirs
      integer :: in_turn = 1, counted = 0, longest_turn = 0, sweeps = 0
      !> The largest residual of the motions in their turn over the allowed one
      real(dp) :: largest_part = 0
      !> The same of potentials and temperatures in the increment, from the second iteration on; and the last iteration
      !> has left them far more than that
      real(dp), private :: largest_of_transport = 0
      logical :: is_astray = .false.
      !> Why it was given up, for the user
      character(len=:), allocatable :: reason
      !> One of the causes above; 0: it was not
      integer :: cause = 0
      !> What is wrong with its contacts
      type(finding_t) :: finding
      !> The last iteration and the one before
      type(iteration_report_t) :: last, before
      !> The tolerance that ended the iteration was that of round-off in one of the fields
      logical :: at_round_off = .false.
      !> Negative pivots of the last factorisation; -1: not known, or none was made
      integer :: negative_pivots = -1
      !> The same of the state in which the increment began; -1 also: its tangent was not factored
      integer :: negative_pivots_at_start = -1
      !> The last factorisation was that of the state in which the increment began
      logical :: only_start_factored = .false.
      !> Some factorisation of this attempt had negative pivots
      logical :: passed_critical = .false.
      !> A flux was fed into a part that floated when the increment began: no smaller one would connect it
      logical :: fed_at_start = .false.
   contains
      procedure :: effort
      procedure :: end_turn
      procedure :: motions_have_come_far
      procedure :: note_residual
      procedure :: note_fraction
      procedure :: leads_nowhere
   end type outcome_t

   !> A short step, and how many of them there are at most on the way to balance: an iteration that has thrown wires far
   !> off or into each other does not come back by such, and a smaller increment is cheaper
   real(dp), parameter :: short_step = 0.1_dp
   integer, parameter :: max_short_steps = 4

   !> The turn of the motions in a sweep ends before they balance when no more than this part of their residual is left:
   !> the temperatures change it by more
   real(dp), parameter :: part_left = 0.01_dp

   !> Residuals of potentials and temperatures over the largest ones before, from where a step has led these astray
   real(dp), parameter :: astray = 5

contains

   !> How many iterations the size of the increment has cost.
   pure integer function effort(self)
      class(outcome_t), intent(in) :: self

      effort = merge(min(self%to_balance, self%factorisations), self%factorisations, self%to_balance > 0)
      if (self%sweeps > 0) effort = max(self%longest_turn, self%counted, self%sweeps)
   end function effort

   pure subroutine end_turn(self, next)
      class(outcome_t), intent(inout) :: self
      !> The group whose turn it is now
      integer, intent(in) :: next

      self%longest_turn = max(self%longest_turn, self%counted)
      self%counted = 0
      if (next > 1) self%sweeps = self%sweeps + 1
      self%in_turn = next
      self%largest_part = 0
   end subroutine end_turn

   !> The residuals at the beginning of an iteration of the motions, whose turn it is.
   pure subroutine note_residual(self)
      class(outcome_t), intent(inout) :: self

      real(dp) :: part

      self%largest_part = max(self%largest_part, part_of_allowed(self%last, group_mechanical))
      if (self%iterations == 0) return
      part = part_of_allowed(self%last, group_transport)
      self%is_astray = self%iterations > 1 .and. part > astray*max(1.0_dp, self%largest_of_transport)
      self%largest_of_transport = max(self%largest_of_transport, part)
   end subroutine note_residual

   !> The part of a linear step that was taken.
   pure subroutine note_fraction(self, eta)
      class(outcome_t), intent(inout) :: self
      !> At most 1
      real(dp), intent(in) :: eta

      if (eta < short_step) self%short_steps = self%short_steps + 1
   end subroutine note_fraction

   pure logical function leads_nowhere(self)
      class(outcome_t), intent(in) :: self

      leads_nowhere = self%short_steps > max_short_steps
   end function leads_nowhere

   !> The residuals of the motions are a small part of the largest ones of their turn.
   pure logical function motions_have_come_far(self)
      class(outcome_t), intent(in) :: self

      motions_have_come_far = part_of_allowed(self%last, group_mechanical) <= part_left*self%largest_part
   end function motions_have_come_far

end module litz_outcome
