!> How far to go along a step, and which contacts it closes.
!>
!> A spring of 1 N/m is pulled by 1 N towards a stop at which a point of a line waits. The step of the iteration, which
!> does not know of the stop, is 1 m. The energy along it is `u^2/2 - u + k max(u - gap, 0)^2/2` with the stiffness k of
!> the point; where it is least is in closed form. Crossings of wires of 1 mm radius bear a part of the same step.
program test_contact_descent
   use litz_communicator, only: one_process_t
   use litz_contact_descent, only: descent_fraction
   use litz_contact_points, only: contact_point_t
   use litz_contact_step, only: bearable_fraction, n_changed, predict_contacts, suppose_contacts
   use litz_deck_reader, only: read_deck
   use litz_element_library, only: elements_t
   use litz_errors, only: error_list_t
   use litz_fields, only: n_slots
   use litz_kinds, only: dp
   use litz_model, only: model_t
   implicit none

   character(len=*), parameter :: nl = new_line('a')
   !> Penalty of the line [N/m^2]; the points stand for k over it
   real(dp), parameter :: penalty = 3.0_dp
   !> Of the wires [m]
   real(dp), parameter :: radius = 1.0e-3_dp
   type(model_t) :: model
   integer :: failures = 0

   call prepare()
   call check(near(fraction_of([contact_point_t ::]), 1.0_dp), 'without points')
   ! k (1 - gap) = 0.25 is less than half of the slope at the start, 1
   call check(near(fraction_of([at(0.5_dp, 0.5_dp)]), 1.0_dp), 'a soft stop is left to the next iteration')
   ! u - 1 + 9 (u - 0.5) = 0
   call check(near(fraction_of([at(0.5_dp, 9.0_dp)]), 0.55_dp), 'before a stop')
   ! u - 1 + 4 (u - 0.3) + 5 (u - 0.2) = 0
   call check(near(fraction_of([at(0.3_dp, 4.0_dp), at(0.2_dp, 5.0_dp)]), 0.32_dp), 'before two stops')
   call check(near(fraction_of([at(0.0_dp, 1.0e9_dp)]), 1.0e-3_dp), 'a little way is always gone')
   call check(near(fraction_of([known(-0.5_dp, 9.0_dp)]), 1.0_dp), 'of a closed point the iteration knows')
   call check(near(fraction_of([weightless(0.5_dp)]), 1.0_dp), 'a point that carries nothing')
   call check(near(fraction_of([at(0.5_dp, 9.0_dp)], pull=-1.0_dp), 1.0_dp), 'uphill nothing is decided')
   call check(near(fraction_of([predicted(0.5_dp, 9.0_dp)]), 0.55_dp), 'the prediction is where the step has started')
   call check(near(1e3_dp*bearable(crossing(radius)), 2.5_dp), 'a crossing gets no deeper than 1.5 radii')
   call check(near(1e3_dp*bearable(crossing(-radius)), 1e3_dp), 'one that is deep already is not held back')
   call check(near(1e3_dp*bearable(opening(-0.1_dp*radius)), 0.5_dp), 'one that opens goes no farther than half of one')
   call check(n_changed(model, upwards(), [crossing(0.5_dp), crossing(2.0_dp)]) == 1, 'the step closes one of two')
   call check(n_changed(model, upwards(), [pressed(-0.5_dp, 0.0_dp)]) == 0, 'the step presses what presses')
   call check(n_changed(model, upwards(), [pressed(-0.5_dp, -9.0_dp)]) == 1, 'what would have to pull opens')
   call check(n_changed(model, upwards(), [at(0.5_dp, 9.0_dp), weightless(0.5_dp)]) == 1, 'the step closes a place')
   call suppositions_are_predictions_of_the_whole_step()
   if (failures > 0) error stop 1

contains

   !> Part of the step that a crossing bears.
   real(dp) function bearable(point)
      type(contact_point_t), intent(in) :: point
      type(elements_t) :: elements

      elements%radius = [radius, radius]
      bearable = bearable_fraction(model, elements, [point], upwards())
   end function bearable

   !> The step of 1 m of the first node upwards (n_slots, n_nodes).
   pure function upwards() result(step)
      real(dp) :: step(n_slots, 4)

      step = 0
      step(3, 1) = 1
      ! rotations and potentials have no part in it
      step(7:, 2) = 5
   end function upwards

   !> An open crossing that the step closes.
   pure type(contact_point_t) function crossing(gap) result(point)
      real(dp), intent(in) :: gap

      point = at(gap, penalty)
      point%line_place = 0
      point%kinematics%distance = 2*radius
   end function crossing

   !> A closed crossing that the step opens.
   pure type(contact_point_t) function opening(gap) result(point)
      real(dp), intent(in) :: gap

      point = crossing(gap)
      point%kinematics%dgap(15) = 1
   end function opening

   !> A crossing that the iteration supposes to press, by a force that changes with the gap.
   pure type(contact_point_t) function pressed(gap, stiffness) result(point)
      real(dp), intent(in) :: gap, stiffness

      point = crossing(gap)
      point%active = .true.
      point%mixed_force = 1
      point%iteration_force = 1
      point%stiffness = stiffness
      allocate (point%kinematics%rows)
   end function pressed

   !> Gap and force of a crossing are those after the step, whether it is taken or only supposed.
   subroutine suppositions_are_predictions_of_the_whole_step()
      type(contact_point_t) :: taken(2), supposed(2)

      taken = [pressed(-0.5_dp, 3.0_dp), crossing(0.25_dp)]
      supposed = taken
      call predict_contacts(model, 1.0_dp, upwards(), taken)
      call suppose_contacts(model, upwards(), supposed)
      call check(all(near(supposed%predicted_gap, [-1.5_dp, -0.75_dp])), 'gaps after the step are supposed')
      call check(all(near(supposed%mixed_force, [4.0_dp, 0.0_dp])), 'and forces, where there is one')
      call check(all(supposed%predicted) .and. all(near(supposed%predicted_gap, taken%predicted_gap)) .and. &
         all(near(supposed%mixed_force, taken%mixed_force)), 'as if the step had been taken')
   end subroutine suppositions_are_predictions_of_the_whole_step

   !> Along the step of 1 m of the first node upwards.
   real(dp) function fraction_of(points, pull)
      type(contact_point_t), intent(in) :: points(:)
      !> Residual there [N]
      real(dp), intent(in), optional :: pull
      real(dp) :: residual(n_slots, 4)

      residual = 0
      residual(3, 1) = 1
      if (present(pull)) residual(3, 1) = pull
      residual(7:, 2) = 7
      fraction_of = descent_fraction(one_process_t(), model, points, residual, upwards())
   end function fraction_of

   !> An open point whose gap falls as the first node of the unbarred element goes up.
   pure type(contact_point_t) function at(gap, stiffness) result(point)
      real(dp), intent(in) :: gap, stiffness

      point%pair = 1
      point%element_bar = 2
      point%element = 1
      point%line_place = 1
      point%gap = gap
      point%weight = stiffness/penalty
      point%kinematics%dgap = 0
      point%kinematics%dgap(15) = -1
   end function at

   !> A point that the iteration has linearised as closed.
   pure type(contact_point_t) function known(gap, stiffness) result(point)
      real(dp), intent(in) :: gap, stiffness

      point = at(gap, stiffness)
      point%mixed_force = -stiffness*gap
      point%stiffness = stiffness
   end function known

   !> A point whose gap has changed since the prediction, besides what is linear.
   pure type(contact_point_t) function predicted(gap, stiffness) result(point)
      real(dp), intent(in) :: gap, stiffness

      point = at(gap, stiffness)
      point%predicted = .true.
      point%predicted_gap = gap
   end function predicted

   pure type(contact_point_t) function weightless(gap) result(point)
      real(dp), intent(in) :: gap

      point = at(gap, 0.0_dp)
   end function weightless

   !> Two elements of two nodes each, and a penalty per length between them.
   subroutine prepare()
      type(error_list_t) :: errors, warnings
      integer :: unit

      open (newunit=unit, file='contact_descent.inp', action='write', status='replace')
      write (unit, '(a)') '*NODE'//nl//'1, 0, 0, 0'//nl//'2, 1, 0, 0'//nl//'3, 0, 0, 1'//nl//'4, 1, 0, 1'//nl// &
         '*ELEMENT, TYPE=B33, ELSET=A'//nl//'1, 1, 2'//nl//'*ELEMENT, TYPE=B33, ELSET=B'//nl//'2, 3, 4'//nl// &
         '*ELSET, ELSET=ALL'//nl//'A, B'//nl//'*MATERIAL, NAME=M'//nl//'*ELASTIC'//nl//'1e11, 0.3'//nl// &
         '*BEAM SECTION, ELSET=ALL, MATERIAL=M, SECTION=CIRC'//nl//'1e-3'//nl// &
         '*SURFACE INTERACTION, NAME=T'//nl//'*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR'//nl//', 3.0'//nl// &
         '*CONTACT PAIR, INTERACTION=T'//nl//'A, B'//nl// &
         '*STEP'//nl//'*STATIC'//nl//'1., 1.'//nl//'*BOUNDARY'//nl//'1, 1, 6'//nl//'3, 1, 6'//nl//'*END STEP'
      close (unit)
      call read_deck('contact_descent.inp', model, errors, warnings)
      if (errors%count == 0) return
      print '(a)', errors%text()
      error stop 1
   end subroutine prepare

   !> The fraction is sought to 1e-6.
   elemental logical function near(a, b)
      real(dp), intent(in) :: a, b

      near = abs(a - b) <= 2.0e-6_dp
   end function near

   subroutine check(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what

      if (holds) return
      failures = failures + 1
      print '(2a)', 'FAILED: ', what
   end subroutine check

end program test_contact_descent
