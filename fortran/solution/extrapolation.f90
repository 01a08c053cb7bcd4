!> A start of an increment that goes on as the one before: where its end would be if the motion went on in proportion.
!>
!> Contacts with friction then begin with the slip, and its direction, of the end of the increment, and not with one of
!> nothing, which an iteration turns contact by contact. Only there: contacts without a memory find their forces in
!> fewer iterations from the last state in balance.
module litz_extrapolation
   use litz_kinds, only: dp
   use litz_fields, only: motion_slots
   use litz_outcome, only: outcome_t
   use litz_problem, only: problem_t
   implicit none
   private
   public :: extrapolate, note_increment

   !> The load may go on by this many times that of the increment before
   real(dp), parameter :: largest_ratio = 3
   !> Deviation from proportion that is round-off
   real(dp), parameter :: in_proportion = 1.0e-9_dp
   !> Part of the closed contacts that were closed before, of an increment that is a guide to the next one
   real(dp), parameter :: least_steady = 0.9_dp
   !> Iterations of such an increment beyond I_G, at most
   integer, parameter :: beyond_quick = 2

contains

   !> Move the iterate on from the last converged state, in its first attempt.
   subroutine extrapolate(problem, attempt, prescribed)
      type(problem_t), intent(inout) :: problem
      !> 1: the increment has not been cut
      integer, intent(in) :: attempt
      !> Increments of what is prescribed (n_slots, n_nodes)
      real(dp), intent(in) :: prescribed(:, :)
      real(dp) :: ratio, dload(motion_slots(1):motion_slots(2), problem%model%n_nodes)
      logical :: goes_on
      integer :: i

      associate (last => problem%last_increment, iterate => problem%iterate, a => motion_slots(1), b => motion_slots(2))
         goes_on = last%is_guide .and. attempt == 1 .and. problem%state%increment > 0
         if (.not. goes_on) return
         dload = problem%loading%load(a:b, :) - last%load
         ratio = (sum(prescribed(a:b, :)*last%prescribed) + sum(dload*last%dload)) &
            /max(sum(last%prescribed**2) + sum(last%dload**2), tiny(ratio))
         goes_on = ratio > 0 .and. ratio <= largest_ratio .and. &
            all(abs(prescribed(a:b, :) - ratio*last%prescribed) <= in_proportion*maxval(abs(last%prescribed))) .and. &
            all(abs(dload - ratio*last%dload) <= in_proportion*maxval(abs(problem%loading%load(a:b, :))))
         if (.not. goes_on) return
         call iterate%move(problem%state, problem%model%x, &
            merge(prescribed(a:b, :), ratio*last%change, problem%loading%fixed(a:b, :)), a)
         iterate%prescribed(a:b, :) = 0
         iterate%is_extrapolated = .true.
      end associate
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%agree()
      end do
   end subroutine extrapolate

   !> What an increment that has converged tells of the next one.
   subroutine note_increment(problem, outcome, quick, prescribed)
      type(problem_t), intent(inout) :: problem
      type(outcome_t), intent(in) :: outcome
      !> I_G
      integer, intent(in) :: quick
      !> Increments of what was prescribed (n_slots, n_nodes)
      real(dp), intent(in) :: prescribed(:, :)
      integer :: closed, steady

      associate (last => problem%last_increment, contact => problem%contact, a => motion_slots(1), b => motion_slots(2))
         last%is_guide = .false.
         if (.not. has_friction(problem) .or. size(problem%elements%heated) > 0) return
         if (.not. allocated(last%load)) last%load = 0*problem%loading%load(a:b, :)
         last%dload = problem%loading%load(a:b, :) - last%load
         last%load = problem%loading%load(a:b, :)
         last%prescribed = prescribed(a:b, :)
         last%change = problem%iterate%change(a:b, :)
         closed = count(contact%points%closed) + count(contact%line_points%closed)
         steady = count(contact%points%closed .and. contact%points%history%closed) &
            + count(contact%line_points%closed .and. contact%line_points%history%closed)
         last%is_guide = closed > 0 .and. steady >= least_steady*closed .and. outcome%last%attempt == 1 .and. &
            outcome%effort() <= quick + beyond_quick
      end associate
   end subroutine note_increment

   !> Some contact pair has friction.
   pure logical function has_friction(problem)
      type(problem_t), intent(in) :: problem
      integer :: i

      associate (model => problem%model)
         has_friction = any([(model%interactions(model%contact_pairs(i)%interaction)%friction > 0, &
            i=1, size(model%contact_pairs))])
      end associate
   end function has_friction

end module litz_extrapolation
