!> Why an increment could not be solved: where the iteration stood, and which setting of the deck helps.
module litz_diagnosis
   use litz_contact_points, only: contact_point_t
   use litz_convergence, only: group_converged
   use litz_kinds, only: dp
   use litz_fields, only: fields, field_temperature, group_transport, field_of_slot, first_slot
   use litz_errors, only: error_t, fail, exit_not_converged
   use litz_model, only: step_t, procedure_of
   use litz_outcome, only: outcome_t, cause_iterations, cause_not_finite, cause_singular, cause_lost_contact, &
      cause_turned_ends, cause_fed_part, cause_no_solution, cause_failed_law
   use litz_problem, only: problem_t
   use litz_text, only: to_text
   implicit none
   private
   public :: not_converged

   !> An increment of less than this part of the first one has come from cut-backs before
   real(dp), parameter :: cut_often = 0.1_dp

contains

   !> The error that ends the run. The problem holds the iterate that was given up.
   function not_converged(problem, step, outcome, step_time, increment, attempts) result(error)
      type(problem_t), intent(in) :: problem
      type(step_t), intent(in) :: step
      type(outcome_t), intent(in) :: outcome
      !> Last converged step time, and the increment from there that failed [s]
      real(dp), intent(in) :: step_time, increment
      !> Attempts at this increment
      integer, intent(in) :: attempts
      type(error_t) :: error
      character(len=:), allocatable :: failure, contact

      failure = ' did not converge from step time '
      contact = describe_worst_contact(problem)
      if (outcome%cause == cause_lost_contact .or. outcome%cause == cause_turned_ends) then
         failure = ' converged to an invalid state from step time '
         contact = ''
      end if
      error = fail(exit_not_converged, 'step '//to_text(outcome%last%step)//', increment '// &
         to_text(outcome%last%increment)//failure//to_text(step_time)// &
         ' with an increment of '//to_text(increment)//': '//outcome%reason//'. '//contact// &
         describe_cause(problem, step, outcome, attempts > 1 .or. increment < cut_often*step%first)// &
         describe_limit(step, outcome, attempts))
   end function not_converged

   !> The contact whose force the iteration was least sure of; empty: there is none.
   function describe_worst_contact(problem) result(text)
      type(problem_t), intent(in) :: problem
      character(len=:), allocatable :: text
      type(contact_point_t), allocatable :: points(:)
      integer :: i

      text = ''
      allocate (points, source=[problem%contact%points, problem%contact%line_points])
      if (.not. any(points%active .or. points%closed)) return
      i = maxloc(abs(points%iteration_force - points%force), 1, points%active .or. points%closed)
      text = 'The contact that has converged least is that of elements '// &
         to_text(problem%model%element_id(points(i)%element_bar))//' and '// &
         to_text(problem%model%element_id(points(i)%element))//' (gap '//to_text(points(i)%gap)// &
         problem%model%units%after('m')//', force '//to_text(points(i)%force)// &
         problem%model%units%after('N')//'). '
   end function describe_worst_contact

   !> What the iteration failed of, and what helps.
   function describe_cause(problem, step, outcome, was_cut) result(text)
      type(problem_t), intent(in) :: problem
      type(step_t), intent(in) :: step
      type(outcome_t), intent(in) :: outcome
      !> Smaller increments have been tried
      logical, intent(in) :: was_cut
      character(len=:), allocatable :: text

      text = ''
      if (step%solves(field_temperature) .and. .not. step%transient .and. any(outcome%cause == [cause_iterations, &
         cause_failed_law, cause_no_solution]) .and. .not. (outcome%cause == cause_iterations .and. &
         group_converged(outcome%last, group_transport))) then
         text = describe_heat(problem)
         return
      end if
      select case (outcome%cause)
      case (cause_lost_contact)
         text = outcome%finding%advice(problem%model, procedure_of(step))
      case (cause_fed_part)
         text = 'Let the wires touch before it is fed, in a step of its own, or prescribe a value there (*BOUNDARY). '
      case (cause_turned_ends)
         text = 'Use shorter elements there, each of which bends and twists less. '
      case (cause_singular)
         text = describe_free_unknown(problem)//'Something can move freely, or a voltage is not determined: add'// &
            ' supports (*BOUNDARY), damp what only contacts hold (*CONTROLS, PARAMETERS=STABILIZE), or let it'// &
            ' overlap a little at the start, as a contact that just touches holds nothing. '
      case (cause_not_finite)
         text = 'Begin with a smaller increment (first value of '//procedure_of(step)//'). '
      case (cause_iterations)
         if (outcome%passed_critical) then
            text = 'The stiffness has negative pivots, the model is beyond a critical load: prescribe a'// &
               ' displacement (*BOUNDARY) instead of the load, or damp the snap (*CONTROLS, PARAMETERS=STABILIZE). '
         else if (outcome%last%contacts_new + outcome%last%contacts_lost > 0) then
            text = to_text(outcome%last%contacts_new)//' contacts closed and '// &
               to_text(outcome%last%contacts_lost)//' opened in the last iteration: they need smaller increments. '
         else if (was_cut) then
            text = 'Smaller increments did not help: where wires are about to snap or to slip off each other,'// &
               ' damp that (*CONTROLS, PARAMETERS=STABILIZE), or add friction (*FRICTION). '
         else if (still_converges(outcome)) then
            text = 'It was still converging: allow more iterations (I_C of *CONTROLS, PARAMETERS=TIME'// &
               ' INCREMENTATION, now '//to_text(step%controls%i_c)//'). '
         end if
      end select
   end function describe_cause

   !> What currents wires can carry for good.
   function describe_heat(problem) result(text)
      type(problem_t), intent(in) :: problem
      character(len=:), allocatable :: text
      integer :: e

      text = 'There may be no steady temperature above this load. '
      e = maxloc(abs(problem%state%element_current), 1)
      if (e == 0) return
      if (.not. abs(problem%state%element_current(e)) > 0) return
      text = 'There may be no steady temperature above I = '//to_text(abs(problem%state%element_current(e)))// &
         problem%model%units%after('A')//', the largest current that was steady, in element '// &
         to_text(problem%model%element_id(e))//'. '
   end function describe_heat

   !> The worst residual of the last iteration is less than half of what it was before.
   pure logical function still_converges(outcome)
      type(outcome_t), intent(in) :: outcome

      still_converges = ratio(outcome%last%residual, outcome%last%allowed) &
         < ratio(outcome%before%residual, outcome%before%allowed)/2

   contains

      pure real(dp) function ratio(residual, allowed)
         !> Residual and the one that is allowed, of each field (n_fields) [N, N m, A]
         real(dp), intent(in) :: residual(:), allowed(:)

         ratio = maxval(residual/max(allowed, tiny(1.0_dp)))
      end function ratio

   end function still_converges

   !> The node at which the linear solver gave up; empty: it does not know.
   function describe_free_unknown(problem) result(text)
      type(problem_t), intent(in) :: problem
      character(len=:), allocatable :: text
      character(len=*), parameter :: axes(3) = ['x', 'y', 'z']
      character(len=:), allocatable :: unknown
      integer :: at(2)

      text = ''
      associate (number => problem%equations%number, scheme => problem%scheme)
         if (scheme%failed_group == 0) return
         at = findloc(number, scheme%failed_equation, mask=spread(fields(field_of_slot)%group == scheme%failed_group, &
            2, size(number, 2)))
      end associate
      if (any(at == 0)) return
      associate (field => fields(field_of_slot(at(1))), component => at(1) - first_slot(field_of_slot(at(1))) + 1)
         unknown = trim(field%name)
         if (field%n_components == 3) unknown = unknown//trim(merge(' about', ' along', field%is_rotation))//' ' &
            //axes(component)
      end associate
      text = 'The equation is that of the '//unknown//' of node '//to_text(problem%model%node_id(at(2)))//'. '
   end function describe_free_unknown

   !> Why the increment was not cut once more.
   pure function describe_limit(step, outcome, attempts) result(text)
      type(step_t), intent(in) :: step
      type(outcome_t), intent(in) :: outcome
      !> Attempts at this increment
      integer, intent(in) :: attempts
      character(len=:), allocatable :: text

      if ((outcome%cause == cause_fed_part .and. outcome%fed_at_start) .or. &
         (outcome%cause == cause_lost_contact .and. outcome%finding%is_final)) then
         text = 'Smaller increments would not help.'
      else if (step%direct .and. step%transient) then
         text = 'Increments over time are not cut back without DELTMX= or ERROR=.'
      else if (step%direct) then
         text = 'Increments of *STATIC, DIRECT are not cut back: remove DIRECT.'
      else if (outcome%cause == cause_lost_contact .or. outcome%cause == cause_turned_ends) then
         text = 'Smaller increments did not help.'
      else if (attempts > step%controls%i_a) then
         text = 'The maximum number of cut-backs is reached (I_A of *CONTROLS, PARAMETERS=TIME INCREMENTATION, now '// &
            to_text(step%controls%i_a)//').'
      else
         text = 'The next smaller increment is below the smallest allowed (third value of '//procedure_of(step)// &
            ', now '//to_text(step%smallest)//').'
      end if
   end function describe_limit

end module litz_diagnosis
