!> What a run asks of the laws of a contact: the straight line of an iteration, the memory of the spot, and what happens
!> where a law cannot be evaluated.
program test_contact_laws
   use litz_kinds, only: dp, pi
   use litz_contact_history, only: contact_history_t, force_of_spot
   use litz_contact_points, only: contact_set_t, law_bad_data
   use litz_element_library, only: elements_t
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok
   use litz_law_input, only: earlier_dent_t, wire_pair_t
   use litz_model, only: model_t
   use litz_normal_forces, only: apply_normal_law
   use litz_normal_law, only: normal_law_t, force_of_gap_t, force_at_gap, linearise, find_stiffer_penalty
   use litz_normal_laws, only: normal_law
   use litz_normal_yielding, only: normal_yielding
   use litz_refused_contacts, only: refused_contact
   use litz_spot_law, only: contact_spot_t, contact_spot, spot_law_t, spot_ok, spot_bad_data, spot_unknown_law
   use litz_spot_laws, only: spot_law
   implicit none
   real(dp), parameter :: penalty = 2.0e6_dp, first_overlap = 1.0e-6_dp
   type(wire_pair_t) :: pair
   type(hertz_ellipse_t) :: ellipse
   integer :: info, failures

   failures = 0
   pair = wire_pair_t([1.0e-3_dp, 0.5e-3_dp], [120.0e9_dp, 70.0e9_dp], [0.34_dp, 0.2_dp], [1.7e-8_dp, 2.0e-8_dp])
   call hertz_ellipse(pair%radius, pair%young, pair%poisson, 1.0_dp, ellipse, info)
   call expect(info == hertz_ok, 'there is an ellipse')
   call test_a_penalty_is_its_own_straight_line()
   call test_a_curved_law_is_linearised_about_the_predicted_force()
   call test_the_line_of_a_first_touch_goes_through_the_touch()
   call test_the_penalty_that_holds()
   call test_a_kept_spot_has_the_largest_force()
   call test_the_torque_of_wires_that_yield_is_that_of_their_energy()
   call test_a_spot_law_says_what_it_cannot_do()
   call test_parallel_wires_refuse_the_increment()
   if (failures > 0) error stop 1

contains

   subroutine expect(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what

      if (holds) return
      print '(a)', 'not so: '//what
      failures = failures + 1
   end subroutine expect

   pure elemental logical function near(a, b)
      real(dp), intent(in) :: a, b

      near = abs(a - b) <= 1.0e-13_dp*max(abs(a), abs(b))
   end function near

   subroutine test_a_penalty_is_its_own_straight_line()
      type(force_of_gap_t) :: at_mixed
      real(dp) :: mixed_force, stiffness, force, gap

      mixed_force = 5
      gap = 3.0e-6_dp
      call linearise(normal_law('LINEAR', [penalty]), gap, first_overlap, pair, ellipse, mixed_force, stiffness, &
         force, at_mixed, earlier_dent_t(), 0.0_dp)
      call expect(near(stiffness, penalty) .and. near(force, -penalty*gap), 'the line goes on beyond the touch')
      call expect(near(mixed_force, 5.0_dp), 'the predicted force stays')
   end subroutine test_a_penalty_is_its_own_straight_line

   !> The line meets the law at the predicted force and has its slope there.
   subroutine test_a_curved_law_is_linearised_about_the_predicted_force()
      type(force_of_gap_t) :: touch, at_mixed
      real(dp) :: mixed_force, stiffness, force
      real(dp), parameter :: overlap = 4.0e-6_dp, gap = -7.0e-6_dp

      touch = force_at_gap(normal_law('HERTZ'), -overlap, pair, ellipse)
      mixed_force = touch%force
      call linearise(normal_law('HERTZ'), gap, first_overlap, pair, ellipse, mixed_force, stiffness, force, &
            at_mixed, earlier_dent_t(), 0.0_dp)
      call expect(near(stiffness, -touch%dforce_dgap), 'slope of the law')
      call expect(near(force, touch%force + touch%dforce_dgap*(gap + overlap)), 'tangent of the law')
      call expect(near(at_mixed%denergy_dangle, touch%denergy_dangle), 'torque of the predicted force')
   end subroutine test_a_curved_law_is_linearised_about_the_predicted_force

   !> Hertz: F ~ overlap^1.5, whose tangent would pull from a third of the overlap on.
   subroutine test_the_line_of_a_first_touch_goes_through_the_touch()
      type(normal_law_t) :: law
      type(force_of_gap_t) :: expected, at_mixed
      real(dp), parameter :: gaps(3) = [-3.0e-6_dp, 2.0e-6_dp, -0.2e-6_dp]
      real(dp), parameter :: taken(3) = [-first_overlap, -first_overlap, -0.2e-6_dp]
      real(dp) :: mixed_force, stiffness, force
      integer :: i

      law = normal_law('HERTZ')
      do i = 1, size(gaps)
         mixed_force = 0
         call linearise(law, gaps(i), first_overlap, pair, ellipse, mixed_force, stiffness, force, &
            at_mixed, earlier_dent_t(), 0.0_dp)
         expected = force_at_gap(law, taken(i), pair, ellipse)
         call expect(near(mixed_force, expected%force), 'force of the first overlap, or of a smaller one')
         call expect(near(stiffness, -expected%dforce_dgap/1.5_dp), 'the secant, two thirds of the slope')
         call expect(near(force, -stiffness*gaps(i)), 'no force where the wires touch')
      end do
   end subroutine test_the_line_of_a_first_touch_goes_through_the_touch

   subroutine test_the_penalty_that_holds()
      real(dp) :: stiffer
      character(len=8) :: unit

      call find_stiffer_penalty(normal_law('LINEAR', [penalty]), 8.0_dp, 4.0e-6_dp, 2.0e-6_dp, .false., stiffer, unit)
      call expect(near(stiffer, 4.0e6_dp) .and. unit == 'N/m', 'F/overlap')
      call find_stiffer_penalty(normal_law('LINEAR', [0.0_dp, 1.0e9_dp]), 8.0_dp, 4.0e-6_dp, 1.0e-6_dp, .true., &
         stiffer, unit)
      call expect(near(stiffer, 4.0e9_dp) .and. unit == 'N/m^2', 'along a line in proportion to the overlap')
      call find_stiffer_penalty(normal_law('LINEAR', [0.0_dp, 1.0e9_dp]), 8.0_dp, 4.0e-6_dp, 1.0e-6_dp, .false., &
         stiffer, unit)
      call expect(near(stiffer, 8.0e9_dp) .and. unit == 'N/m^2', 'and to its length, where wires cross')
      call find_stiffer_penalty(normal_law('HERTZ'), 8.0_dp, 4.0e-6_dp, 2.0e-6_dp, .false., stiffer, unit)
      call expect(.not. stiffer > 0, 'HERTZ has none')
   end subroutine test_the_penalty_that_holds

   subroutine test_a_kept_spot_has_the_largest_force()
      type(contact_history_t) :: history
      real(dp) :: force, slope

      history%largest_force = 3
      history%spot_shape%uncut_force = 6
      call force_of_spot(.true., history, 2.0_dp, 4.0_dp, .false., force, slope)
      call expect(near(force, 3.0_dp) .and. .not. abs(slope) > 0, 'the spot stays as it was')
      call force_of_spot(.true., history, 4.0_dp, 8.0_dp, .false., force, slope)
      call expect(near(force, 4.0_dp) .and. near(slope, 1.0_dp), 'a larger force makes it larger')
      call force_of_spot(.true., history, 2.0_dp, 4.0_dp, .true., force, slope)
      call expect(near(force, 2.0_dp) .and. near(slope, 1.0_dp), 'a slip makes a new one')
      call force_of_spot(.false., history, 2.0_dp, 4.0_dp, .false., force, slope)
      call expect(near(force, 2.0_dp) .and. near(slope, 1.0_dp), 'it is not kept unless that is asked for')
   end subroutine test_a_kept_spot_has_the_largest_force

   !> At fixed overlap and largest force, on loading, at the top and on the way back.
   subroutine test_the_torque_of_wires_that_yield_is_that_of_their_energy()
      real(dp), parameter :: angle = 0.9_dp, turn = 1.0e-5_dp, overlap = 2.0e-6_dp
      real(dp), parameter :: part(3) = [0.8_dp, 0.9_dp, 0.99_dp]
      type(normal_law_t) :: law
      type(force_of_gap_t) :: found, sides(2)
      type(hertz_ellipse_t) :: turned
      real(dp) :: largest
      integer :: i, k, info

      law = normal_yielding(1.0e8_dp, 4.0e8_dp)
      call hertz_ellipse(pair%radius, pair%young, pair%poisson, angle, turned, info)
      found = force_at_gap(law, -overlap, pair, turned)
      largest = found%force
      do i = 1, size(part)
         do k = 1, 2
            call hertz_ellipse(pair%radius, pair%young, pair%poisson, angle + (2*k - 3)*turn, turned, info)
            sides(k) = force_at_gap(law, -part(i)*overlap, pair, turned, earlier_dent_t(largest))
         end do
         call hertz_ellipse(pair%radius, pair%young, pair%poisson, angle, turned, info)
         found = force_at_gap(law, -part(i)*overlap, pair, turned, earlier_dent_t(largest))
         call expect(abs((sides(2)%energy - sides(1)%energy)/(2*turn) - found%denergy_dangle) < &
            1.0e-7_dp*found%energy, 'torque on the way back')
      end do
      ! loading: nothing is dissipated by turning, so that the torque is that of the dent as it is
      found = force_at_gap(law, -overlap, pair, turned)
      do k = 1, 2
         call hertz_ellipse(pair%radius, pair%young, pair%poisson, angle + (2*k - 3)*turn, turned, info)
         sides(k) = force_at_gap(law, -0.9999_dp*overlap, pair, turned, earlier_dent_t(largest))
      end do
      call expect(abs((sides(2)%energy - sides(1)%energy)/(2*turn) - found%denergy_dangle) < &
         2.0e-3_dp*abs(found%denergy_dangle), 'torque of the loading')
   end subroutine test_the_torque_of_wires_that_yield_is_that_of_their_energy

   subroutine test_a_spot_law_says_what_it_cannot_do()
      type(contact_spot_t) :: spot
      type(spot_law_t) :: law
      integer :: status

      call contact_spot(spot_law('TABLE'), 1.0_dp, pair, ellipse, spot, status)
      call expect(status == spot_bad_data, 'a table that was never given')
      law = spot_law('TABLE', [2.0_dp, 1.0_dp, 1.0_dp, 3.0_dp])
      call contact_spot(law, 1.0_dp, pair, ellipse, spot, status)
      call expect(status == spot_bad_data, 'forces that do not ascend')
      call contact_spot(spot_law(99), 1.0_dp, pair, ellipse, spot, status)
      call expect(status == spot_unknown_law, 'a number without a law')
      law = spot_law('NONESUCH')
      call expect(.not. law%exists() .and. law%number == 0, 'a name without a law')
      call contact_spot(law, 1.0_dp, pair, ellipse, spot, status)
      call expect(status == spot_ok .and. .not. spot%conductance > 0, 'no law, no current')
   end subroutine test_a_spot_law_says_what_it_cannot_do

   !> The axes can only become parallel on the way of an iteration: it ends there, in words.
   subroutine test_parallel_wires_refuse_the_increment()
      type(model_t) :: model
      type(elements_t) :: elements
      type(contact_set_t) :: contact
      character(len=:), allocatable :: words

      call make_two_wires(model, elements)
      allocate (contact%points(1))
      contact%points(1)%element_bar = 1
      contact%points(1)%element = 2
      contact%points(1)%pair = 1
      contact%points(1)%gap = -1.0e-6_dp
      contact%points(1)%law_angle = pi/3
      call apply_normal_law(model, elements, contact%points)
      call expect(contact%points(1)%force > 0 .and. len(refused_contact(model, contact%points)) == 0, &
         'wires that cross')
      contact%points(1)%law_angle = 0
      call apply_normal_law(model, elements, contact%points)
      words = refused_contact(model, contact%points)
      call expect(index(words, 'wires have become parallel where they touch (elements 11 and 12)') == 1, words)
      contact%points(1)%law_status = law_bad_data
      call expect(len(refused_contact(model, contact%points)) == 0, 'bad data are no reason for a smaller increment')
   end subroutine test_parallel_wires_refuse_the_increment

   subroutine make_two_wires(model, elements)
      type(model_t), intent(out) :: model
      type(elements_t), intent(out) :: elements

      allocate (model%materials(1), model%sections(1), model%interactions(1), model%contact_pairs(1))
      model%materials(1)%young = 120.0e9_dp
      model%materials(1)%poisson = 0.34_dp
      model%sections(1)%material = 1
      model%sections(1)%contact_radius = 1.0e-3_dp
      model%element_section = [1, 1]
      model%element_id = [11, 12]
      model%interactions(1)%normal = normal_law('HERTZ')
      model%contact_pairs(1)%interaction = 1
      elements%radius = [1.0e-3_dp, 1.0e-3_dp]
      elements%resistivity = [1.7e-8_dp, 1.7e-8_dp]
      elements%length = [1.0e-2_dp, 1.0e-2_dp]
      elements%area = [3.0e-6_dp, 3.0e-6_dp]
      elements%superconducting = [.false., .false.]
      allocate (elements%temperature(2, 2), elements%mechanical_temperature(2, 2), source=0.0_dp)
   end subroutine make_two_wires

end program test_contact_laws
