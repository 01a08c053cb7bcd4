!> How far to go along a step: a spring of 1 N/m is pulled by 1 N towards a stop at which a point of a line waits.
!>
!> The step of the iteration, which does not know of the stop, is 1 m. The energy along it is
!> `u^2/2 - u + k max(u - gap, 0)^2/2` with the stiffness k of the point; where it is least is in closed form.
program test_contact_descent
   use litz_communicator, only: one_process_t
   use litz_contact_descent, only: descent_fraction
   use litz_contact_points, only: contact_point_t
   use litz_deck_reader, only: read_deck
   use litz_errors, only: error_list_t
   use litz_fields, only: n_slots
   use litz_kinds, only: dp
   use litz_model, only: model_t
   implicit none

   character(len=*), parameter :: nl = new_line('a')
   !> Penalty of the line [N/m^2]; the points stand for k over it
   real(dp), parameter :: penalty = 3.0_dp
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
   if (failures > 0) error stop 1

contains

   !> Along the step of 1 m of the first node upwards.
   real(dp) function fraction_of(points, pull)
      type(contact_point_t), intent(in) :: points(:)
      !> Residual there [N]
      real(dp), intent(in), optional :: pull
      real(dp) :: residual(n_slots, 4), step(n_slots, 4)

      residual = 0
      step = 0
      residual(3, 1) = 1
      if (present(pull)) residual(3, 1) = pull
      step(3, 1) = 1
      ! rotations and potentials have no part in it
      step(7:, 2) = 5
      residual(7:, 2) = 7
      fraction_of = descent_fraction(one_process_t(), model, points, residual, step)
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
