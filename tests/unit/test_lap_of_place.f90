!> The force along the wires of a place in a short lap: against differences of its energy as the lap changes.
program test_lap_of_place
   use litz_kinds, only: dp
   use litz_lap_of_place, only: lap_of_place_t, lap_force_t, force_along_lap
   use litz_law_input, only: wire_pair_t
   use litz_line_law, only: line_wires_t, line_wires, line_force_t, line_force
   use litz_round_end, only: end_force_t
   implicit none

   real(dp), parameter :: overlap = 3.0e-6_dp
   !> Length for which the place stands, and how far the lap changes [m]
   real(dp), parameter :: weight = 1.0e-4_dp, step = 1.0e-7_dp
   type(wire_pair_t) :: wires
   type(line_wires_t) :: parallel
   type(lap_of_place_t) :: lap
   integer :: failures = 0

   wires%radius = [1.0e-3_dp, 0.7e-3_dp]
   wires%young = [120.0e9_dp, 70.0e9_dp]
   wires%poisson = [0.34_dp, 0.3_dp]
   wires%resistivity = [1.7e-8_dp, 2.8e-8_dp]
   parallel = line_wires(wires, 0.0_dp)
   lap%dweight = 0.7_dp
   lap%d2weight = 2.0e3_dp
   lap%of_course = 0.02_dp
   lap%dof_course = 300
   lap%strip_bound = (6.0e-3_dp)**(-2)
   lap%dstrip_bound = -2.0e3_dp*lap%strip_bound
   call the_force_is_that_of_the_energy()
   if (failures > 0) error stop 1

contains

   subroutine the_force_is_that_of_the_energy()
      type(lap_force_t) :: along
      type(line_force_t) :: law
      real(dp) :: expected(3), h

      law = line_force(line_at(0.0_dp), overlap, 0.0_dp)
      along = force_along_lap(lap, line_at(0.0_dp), weight, law, end_force_t())
      h = 1.0e-3_dp*overlap
      expected(1) = (energy(step, overlap) - energy(-step, overlap))/(2*step)
      expected(2) = (energy(step, overlap + h) - energy(-step, overlap + h) - energy(step, overlap - h) &
         + energy(-step, overlap - h))/(4*step*h)
      expected(3) = (energy(step, overlap) - 2*energy(0.0_dp, overlap) + energy(-step, overlap))/step**2
      call check('force', along%force/expected(1), 1.0e-7_dp)
      call check('force by overlap', along%by_overlap/expected(2), 1.0e-5_dp)
      call check('stiffness', along%stiffness/expected(3), 1.0e-5_dp)
   end subroutine the_force_is_that_of_the_energy

   !> Of the place, as the lap has changed by a length [J].
   real(dp) function energy(way, at)
      !> The length, and the overlap [m]
      real(dp), intent(in) :: way, at
      type(line_force_t) :: law

      law = line_force(line_at(way), at, 0.0_dp)
      energy = (weight + (lap%dweight + lap%d2weight*way/2)*way)*law%energy + (lap%of_course + lap%dof_course*way/2)*way
   end function energy

   !> The far field as the lap has changed by a length.
   type(line_wires_t) function line_at(way) result(line)
      !> [m]
      real(dp), intent(in) :: way

      line = parallel
      line%section = parallel%section + lap%strip_bound + lap%dstrip_bound*way
   end function line_at

   subroutine check(name, ratio, tolerance)
      character(len=*), intent(in) :: name
      real(dp), intent(in) :: ratio, tolerance

      if (abs(ratio - 1) <= tolerance) return
      failures = failures + 1
      write (*, '(a, es24.16)') 'failed: '//name, ratio
   end subroutine check

end program test_lap_of_place
