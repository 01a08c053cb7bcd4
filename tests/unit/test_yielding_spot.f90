!> The law of wires that yield: what it refuses, its limits, and that each of its branches inverts to round-off.
program test_yielding_spot
   use litz_kinds, only: dp
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_near_ends, hertz_ok
   use litz_yielding_spot, only: yielding_t, yielding_crossing, dent_t, dent_of_force, yielding_state_t, &
      state_at_overlap, state_at_force, onset_factor, yielding_ok, yielding_bad_data, yielding_too_soft
   implicit none
   real(dp), parameter :: radius(2) = [1.0e-3_dp, 0.4e-3_dp], young(2) = [120.0e9_dp, 70.0e9_dp]
   real(dp), parameter :: poisson(2) = [0.34_dp, 0.33_dp], yield_stress(2) = 100.0e6_dp
   type(hertz_ellipse_t) :: ellipse
   integer :: info, failures

   failures = 0
   call hertz_ellipse(radius, young, poisson, 0.7_dp, ellipse, info)
   call expect(info == hertz_ok, 'there is an ellipse')
   call test_bad_data()
   call test_elastic_below_the_onset()
   call test_inverse()
   call test_an_open_contact_keeps_its_dent()
   call test_near_the_end_of_a_wire()
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

      near = abs(a - b) <= 1.0e-12_dp*max(abs(a), abs(b))
   end function near

   integer function info_of(stress, hardness)
      real(dp), intent(in) :: stress(2), hardness
      type(yielding_t) :: law

      call yielding_crossing(ellipse, poisson, stress, hardness, law, info_of)
   end function info_of

   subroutine test_bad_data()
      real(dp) :: limit

      limit = onset_factor(0.33_dp, ellipse%ratio)*100.0e6_dp
      call expect(info_of(yield_stress, 0.0_dp) == yielding_ok, 'the hardness may be left out')
      call expect(info_of([100.0e6_dp, 0.0_dp], 0.0_dp) == yielding_bad_data, 'a yield stress of 0 is none')
      call expect(info_of(yield_stress, -1.0_dp) == yielding_bad_data, 'a hardness is not negative')
      call expect(info_of(yield_stress, limit) == yielding_too_soft, 'the hardness is above the onset')
      call expect(info_of(yield_stress, limit*(1 + 1.0e-12_dp)) == yielding_ok, 'just above is enough')
   end subroutine test_bad_data

   subroutine test_elastic_below_the_onset()
      type(yielding_t) :: law
      type(yielding_state_t) :: state
      real(dp) :: force

      call yielding_crossing(ellipse, poisson, yield_stress, 0.0_dp, law, info)
      force = 0.99_dp*law%force
      state = state_at_overlap(law, dent_of_force(law, force), ellipse%approach*(force/2)**(2.0_dp/3))
      call expect(near(state%force, force/2), 'back on the curve of Hertz')
      call expect(.not. state%dissipation > 0, 'nothing is dissipated')
      call expect(.not. state%loads, 'the force has been larger')
   end subroutine test_elastic_below_the_onset

   subroutine test_inverse()
      real(dp), parameter :: hardnesses(3) = [200.0e6_dp, 280.0e6_dp, 900.0e6_dp]
      real(dp), parameter :: multiples(4) = [1.001_dp, 3.0_dp, 200.0_dp, 1.0e5_dp]
      real(dp), parameter :: shares(7) = [1.0e-9_dp, 1.0e-3_dp, 0.2_dp, 0.7_dp, 0.999_dp, 1.0_dp, 4.0_dp]
      type(yielding_t) :: law
      type(dent_t) :: dent
      type(yielding_state_t) :: given, back
      real(dp) :: noise
      integer :: i, j, k

      do i = 1, size(hardnesses)
         call yielding_crossing(ellipse, poisson, yield_stress, hardnesses(i), law, info)
         do j = 1, size(multiples)
            dent = dent_of_force(law, multiples(j)*law%force)
            do k = 1, size(shares)
               given = state_at_force(law, dent, shares(k)*dent%force)
               back = state_at_overlap(law, dent, given%overlap)
               noise = 4*epsilon(noise)*given%overlap*given%stiffness
               call expect(abs(back%force - given%force) <= noise + 1.0e-13_dp*given%force, 'the force comes back')
               call expect(given%loads .eqv. shares(k) >= 1, 'from the largest force on it loads')
            end do
         end do
      end do
   end subroutine test_inverse

   subroutine test_an_open_contact_keeps_its_dent()
      type(yielding_t) :: law
      type(dent_t) :: dent
      type(yielding_state_t) :: state

      call yielding_crossing(ellipse, poisson, yield_stress, 0.0_dp, law, info)
      dent = dent_of_force(law, 50*law%force)
      call expect(dent%depth > 0 .and. dent%depth < dent%overlap, 'there is a dent')
      state = state_at_overlap(law, dent, dent%depth*(1 - 1.0e-9_dp))
      call expect(.not. state%force > 0 .and. .not. state%stiffness > 0, 'no force over the dent')
      call expect(near(state%dissipation, dent%work - dent%energy), 'what has been dissipated stays so')
      state = state_at_force(law, dent, 0.0_dp)
      call expect(near(state%overlap, dent%depth), 'without a force the wires lie in the dent')
      state = state_at_overlap(law, dent, -1.0e-6_dp)
      call expect(.not. state%force > 0 .and. .not. state%loads, 'nor is there one over a gap')
      state = state_at_overlap(law, dent_of_force(law, 0.0_dp), 0.0_dp)
      call expect(.not. state%force > 0, 'nor where wires just touch')
   end subroutine test_an_open_contact_keeps_its_dent

   !> The law needs the ellipse only: a hemisphere on a wire yields as the ellipse that it makes.
   subroutine test_near_the_end_of_a_wire()
      type(hertz_ellipse_t) :: of_end
      type(yielding_t) :: law
      real(dp), parameter :: only_the_first(2, 2) = reshape([0, 1, 0, 0], [2, 2])

      call hertz_near_ends(radius, young, poisson, 0.7_dp, only_the_first, of_end, info)
      call expect(info == hertz_ok, 'there is an ellipse at an end')
      call yielding_crossing(of_end, poisson, yield_stress, 0.0_dp, law, info)
      call expect(info == yielding_ok, 'it yields')
      call expect(near(3*law%force, 2*law%yield_pressure*law%area), 'at the pressure of the onset')
   end subroutine test_near_the_end_of_a_wire

end program test_yielding_spot
