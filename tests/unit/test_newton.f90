!> The iteration of one increment: two wires pressed together, with a current from one to the other.
module iteration_recorder
   use litz_errors, only: error_t
   use litz_fields, only: n_fields
   use litz_kinds, only: dp
   use litz_problem, only: problem_t
   use litz_reports, only: iteration_report_t
   use silent_observer, only: silent_t
   implicit none
   private
   public :: recorder_t

   !> Keeps the residuals of the iterations, and ends the run if it is told to.
   type, extends(silent_t) :: recorder_t
      !> (n_fields, iterations)
      real(dp), allocatable :: residual(:, :)
      logical :: disk_is_full = .false.
   contains
      procedure :: iteration_done
   end type recorder_t

contains

   subroutine iteration_done(self, problem, report, error)
      class(recorder_t), intent(inout) :: self
      type(problem_t), intent(in) :: problem
      type(iteration_report_t), intent(in) :: report
      type(error_t), allocatable, intent(inout) :: error

      if (.not. allocated(self%residual)) allocate (self%residual(n_fields, 0))
      self%residual = reshape([self%residual, report%residual], [n_fields, size(self%residual, 2) + 1])
      if (self%disk_is_full) error = error_t(message='the disk is full')
   end subroutine iteration_done

end module iteration_recorder

program test_newton
   use iteration_recorder, only: recorder_t
   use litz_deck_reader, only: read_deck
   use litz_errors, only: error_t, error_list_t
   use litz_fields, only: field_displacement, field_potential, first_slot
   use litz_initial_contacts, only: find_initial_overlap
   use litz_kinds, only: dp
   use litz_loading, only: load_targets
   use litz_model, only: model_t
   use litz_newton, only: solve_increment
   use litz_outcome, only: outcome_t, cause_iterations, cause_singular
   use litz_problem, only: problem_t, prepare_problem
   use litz_reports, only: iteration_report_t
   use litz_steps, only: begin_step
   implicit none

   character(len=*), parameter :: nl = new_line('a')
   character(len=*), parameter :: clamps = '1, 1, 6'//nl//'4, 1, 6'//nl//'11, 1, 2'//nl//'11, 4, 6'//nl// &
      '14, 1, 2'//nl//'14, 4, 6'//nl//'11, 3, 3, -4e-4'//nl// &
      '14, 3, 3, -4e-4'//nl//'1, 9, 9, 0.001'//nl//'11, 9, 9, 0'//nl
   character(len=*), parameter :: potentials_0 = '1, 9, 9, 0'//nl//'11, 9, 9, 0'//nl
   integer :: failures = 0

   call short_steps_lead_nowhere()
   call the_iteration_converges_quadratically()
   call both_couplings_find_the_same_potentials()
   call a_model_at_rest_needs_no_iteration()
   call an_increment_that_is_given_up_leaves_the_state_alone()
   call a_part_that_nothing_holds_is_a_singular_matrix()
   call the_observer_can_end_the_iteration()
   if (failures > 0) error stop 1

contains

   !> Five linear steps of which less than a tenth was taken are enough; longer ones are no sign of anything.
   subroutine short_steps_lead_nowhere()
      type(outcome_t) :: outcome
      integer :: i

      do i = 1, 4
         call outcome%note_fraction(0.05_dp)
         call outcome%note_fraction(0.2_dp)
      end do
      call check(.not. outcome%leads_nowhere(), 'four short steps do not end an increment')
      call outcome%note_fraction(0.05_dp)
      call check(outcome%leads_nowhere(), 'the fifth one does')
   end subroutine short_steps_lead_nowhere

   !> The last residuals, over the forces on the wires, are each the square of the one before or less.
   subroutine the_iteration_converges_quadratically()
      type(problem_t) :: problem
      type(outcome_t) :: outcome
      type(recorder_t) :: recorder
      type(error_t), allocatable :: error
      real(dp), parameter :: force = 2
      integer :: k, n

      call start(deck_of(clamps, '', '-1.'), problem)
      call solve_increment(problem, problem%model%steps(1), iteration_report_t(), recorder, outcome, error)
      call stop_on(error)
      call check(outcome%converged, 'the increment converges')
      associate (r => recorder%residual(field_displacement, :)/force)
         n = size(r)
         call check(n >= 4 .and. n <= 8, 'in a few iterations')
         call check(r(n) < 1.0e-8_dp, 'to the tolerance')
         do k = n - 1, n
            call check(r(k) <= max(r(k - 1)**1.8_dp, 1.0e-10_dp), 'quadratically, down to round-off')
         end do
      end associate
   end subroutine the_iteration_converges_quadratically

   !> Potentials that follow the displacements, and those of one Newton step for all.
   subroutine both_couplings_find_the_same_potentials()
      type(problem_t) :: updated, monolithic
      type(outcome_t) :: outcome
      type(recorder_t) :: recorder
      type(error_t), allocatable :: error

      call start(deck_of(clamps, '*SOLVER, NAME=BLOCK, COUPLING=UPDATED'//nl, '-1.'), updated)
      call solve_increment(updated, updated%model%steps(1), iteration_report_t(), recorder, outcome, error)
      call check(outcome%converged, 'potentials are updated')
      call start(deck_of(clamps, '*SOLVER, NAME=BLOCK, COUPLING=MONOLITHIC'//nl, '-1.'), monolithic)
      call solve_increment(monolithic, monolithic%model%steps(1), iteration_report_t(), recorder, outcome, error)
      call check(outcome%converged, 'potentials are part of the Newton step')
      associate (slot => first_slot(field_potential))
         call check(maxval(abs(updated%iterate%value(slot, :) - monolithic%iterate%value(slot, :))) < 1.0e-11_dp, &
            'they are the same')
         call check(maxval(updated%iterate%value(slot, :)) - minval(updated%iterate%value(slot, :)) > 0.9e-3_dp, &
            'there is a voltage')
      end associate
   end subroutine both_couplings_find_the_same_potentials

   subroutine a_model_at_rest_needs_no_iteration()
      type(problem_t) :: problem
      type(outcome_t) :: outcome
      type(recorder_t) :: recorder
      type(error_t), allocatable :: error

      call start(deck_of('1, 1, 6'//nl//'4, 1, 6'//nl//'11, 1, 6'//nl//'14, 1, 6'//nl//potentials_0, '', '0.'), problem)
      call solve_increment(problem, problem%model%steps(1), iteration_report_t(), recorder, outcome, error)
      call check(outcome%converged .and. outcome%iterations == 0, 'equilibrium is seen before the first solve')
   end subroutine a_model_at_rest_needs_no_iteration

   subroutine an_increment_that_is_given_up_leaves_the_state_alone()
      type(problem_t) :: problem
      type(outcome_t) :: outcome
      type(recorder_t) :: recorder
      type(error_t), allocatable :: error

      call start(deck_of(clamps, '*CONTROLS, PARAMETERS=TIME INCREMENTATION'//nl//', , , 2, 1, 1'//nl, '-1.'), problem)
      call solve_increment(problem, problem%model%steps(1), iteration_report_t(), recorder, outcome, error)
      call check(.not. outcome%converged .and. outcome%cause == cause_iterations, 'too few iterations are allowed')
      call check(index(outcome%reason, 'residual') > 0, 'the reason names the residual')
      call check(.not. any(abs(problem%state%value) > 0) .and. .not. any(problem%contact%converged%closed), &
         'the state is that of the start')
   end subroutine an_increment_that_is_given_up_leaves_the_state_alone

   !> The upper wire has no support.
   subroutine a_part_that_nothing_holds_is_a_singular_matrix()
      type(problem_t) :: problem
      type(outcome_t) :: outcome
      type(recorder_t) :: recorder
      type(error_t), allocatable :: error

      call start(deck_of('1, 1, 6'//nl//'4, 1, 6'//nl//potentials_0, '', '-1.'), problem)
      call solve_increment(problem, problem%model%steps(1), iteration_report_t(), recorder, outcome, error)
      call check(.not. allocated(error) .and. outcome%cause == cause_singular, 'a loose wire has no stiffness')
   end subroutine a_part_that_nothing_holds_is_a_singular_matrix

   subroutine the_observer_can_end_the_iteration()
      type(problem_t) :: problem
      type(outcome_t) :: outcome
      type(recorder_t) :: recorder
      type(error_t), allocatable :: error

      call start(deck_of(clamps, '', '-1.'), problem)
      recorder%disk_is_full = .true.
      call solve_increment(problem, problem%model%steps(1), iteration_report_t(), recorder, outcome, error)
      call check(allocated(error) .and. size(recorder%residual, 2) == 1, 'what the observer reports ends it at once')
   end subroutine the_observer_can_end_the_iteration

   !> Two wires that nearly touch where they cross, and a force on a node of each.
   function deck_of(supports, controls, load) result(deck)
      character(len=*), intent(in) :: supports, controls, load
      character(len=:), allocatable :: deck

      deck = '*NODE'//nl//'1, -0.03, 0, 0'//nl//'2, -0.012, 0, 0'//nl//'3, 0.009, 0.001, 0'//nl//'4, 0.03, 0, 0'//nl// &
         '11, 0.003, -0.03, 0.0019'//nl//'12, 0, -0.008, 0.0019'//nl//'13, 0, 0.011, 0.0019'//nl// &
         '14, -0.001, 0.03, 0.0019'//nl// &
         '*ELEMENT, TYPE=B33, ELSET=A'//nl//'1, 1, 2'//nl//'2, 2, 3'//nl//'3, 3, 4'//nl// &
         '*ELEMENT, TYPE=B33, ELSET=B'//nl//'11, 11, 12'//nl//'12, 12, 13'//nl//'13, 13, 14'//nl// &
         '*MATERIAL, NAME=M'//nl//'*ELASTIC'//nl//'1.1e11, 0.3'//nl//'*ELECTRICAL CONDUCTIVITY'//nl//'5e7'//nl// &
         '*BEAM SECTION, ELSET=A, MATERIAL=M, SECTION=CIRC'//nl//'1e-3'//nl// &
         '*BEAM SECTION, ELSET=B, MATERIAL=M, SECTION=CIRC'//nl//'0.8e-3'//nl// &
         '*SURFACE INTERACTION, NAME=T'//nl//'*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ'//nl// &
         '*CONTACT PAIR, INTERACTION=T'//nl//'A, B'//nl// &
         '*STEP'//nl//'*STATIC'//nl//'1., 1.'//nl//controls//'*BOUNDARY'//nl//supports// &
         '*CLOAD'//nl//'2, 2, '//load//nl//'13, 1, '//load//nl//'*END STEP'//nl
   end function deck_of

   !> The first increment of the deck, of the whole step, is about to be solved.
   subroutine start(deck, problem)
      character(len=*), intent(in) :: deck
      type(problem_t), intent(inout) :: problem
      type(model_t) :: model
      type(error_list_t) :: errors, warnings
      type(error_t), allocatable :: error
      integer :: unit, i

      open (newunit=unit, file='newton.inp', action='write', status='replace')
      write (unit, '(a)') deck
      close (unit)
      call read_deck('newton.inp', model, errors, warnings)
      if (errors%count > 0) then
         print '(a)', errors%text()
         error stop 1
      end if
      call prepare_problem(model, problem)
      call find_initial_overlap(problem, error)
      call stop_on(error)
      call begin_step(problem, problem%model%steps(1), 0, error)
      call stop_on(error)
      call load_targets(problem%model, problem%model%steps(1), 1.0_dp, 1.0_dp, problem%loading)
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%apply_load(problem%domain_t, problem%model%steps(1), 1.0_dp, 1.0_dp)
      end do
   end subroutine start

   subroutine stop_on(error)
      type(error_t), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      print '(a)', error%message
      error stop 1
   end subroutine stop_on

   subroutine check(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what

      if (holds) return
      failures = failures + 1
      print '(2a)', 'FAILED: ', what
   end subroutine check

end program test_newton
