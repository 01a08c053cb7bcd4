!> The round end of a wire beside a line: against Hertz, and its derivatives against differences of its energy.
program test_round_end
   use litz_kinds, only: dp
   use litz_hertz, only: hertz_ellipse_t
   use litz_law_input, only: wire_pair_t
   use litz_round_end, only: round_end_t, end_force_t, force_of_end, ellipse_of_end
   implicit none

   real(dp), parameter :: overlap = 3.0e-6_dp
   !> How far the other wire goes on, in sqrt(2 d delta)
   real(dp), parameter :: beyond(*) = [0.1_dp, 0.45_dp, 0.9_dp, 1.3_dp]
   type(wire_pair_t) :: wires
   type(hertz_ellipse_t) :: ellipse
   type(round_end_t) :: round
   integer :: failures = 0, i

   wires%radius = [1.0e-3_dp, 0.7e-3_dp]
   wires%young = [120.0e9_dp, 70.0e9_dp]
   wires%poisson = [0.34_dp, 0.3_dp]
   ellipse = ellipse_of_end(wires, 0.2_dp)
   round = round_end_t(share=0.4_dp, hertz=ellipse%approach**(-1.5_dp), distance=sum(wires%radius))
   call the_force_is_that_of_hertz()
   do i = 1, size(beyond)
      call derivatives_are_differences(beyond(i))
   end do
   call nothing_where_both_wires_end()
   if (failures > 0) error stop 1

contains

   subroutine the_force_is_that_of_hertz()
      type(end_force_t) :: at

      at = force_of_end(round, overlap)
      ! delta = cd F^(2/3)
      call check('approach', ellipse%approach*(at%force/round%share)**(2.0_dp/3)/overlap, 1.0_dp, 1.0e-14_dp)
      call check('energy', at%energy/(0.4_dp*at%force*overlap), 1.0_dp, 1.0e-14_dp)
      call check('part', at%part, round%share, 1.0e-14_dp)
   end subroutine the_force_is_that_of_hertz

   subroutine derivatives_are_differences(u)
      !> How far the other wire goes on, in sqrt(2 d delta)
      real(dp), intent(in) :: u
      type(end_force_t) :: at, up, down
      real(dp) :: reach, h

      reach = sqrt(2*round%distance*overlap)
      round%beyond = u*reach
      at = force_of_end(round, overlap)
      h = 1.0e-4_dp*overlap
      up = force_of_end(round, overlap + h)
      down = force_of_end(round, overlap - h)
      call check('force', at%force, (up%energy - down%energy)/(2*h), 1.0e-7_dp*at%force)
      call check('stiffness', at%stiffness, (up%force - down%force)/(2*h), 1.0e-7_dp*at%stiffness)
      call check('change of the stiffness', at%dstiffness, (up%stiffness - down%stiffness)/(2*h), &
         1.0e-6_dp*at%stiffness/overlap)
      call check('force along by overlap', at%along_by_overlap, (up%along - down%along)/(2*h), 1.0e-7_dp*at%stiffness)
      call check('part by overlap', at%dpart, (up%part - down%part)/(2*h), 1.0e-7_dp/overlap)
      h = 1.0e-4_dp*reach
      round%beyond = u*reach + h
      up = force_of_end(round, overlap)
      round%beyond = u*reach - h
      down = force_of_end(round, overlap)
      call check('force along', at%along, (up%energy - down%energy)/(2*h), 1.0e-7_dp*at%force)
      call check('stiffness along', at%along_stiffness, (up%along - down%along)/(2*h), 1.0e-7_dp*at%stiffness)
   end subroutine derivatives_are_differences

   subroutine nothing_where_both_wires_end()
      type(end_force_t) :: at

      round%beyond = 0
      at = force_of_end(round, overlap)
      call check('force of wires that end together', at%force, 0.0_dp, 0.0_dp)
      call check('force along wires that end together', at%along, 0.0_dp, 0.0_dp)
   end subroutine nothing_where_both_wires_end

   subroutine check(name, actual, expected, tolerance)
      character(len=*), intent(in) :: name
      real(dp), intent(in) :: actual, expected, tolerance

      if (abs(actual - expected) <= tolerance) return
      failures = failures + 1
      write (*, '(a, 2es24.16)') 'failed: '//name, actual, expected
   end subroutine check

end program test_round_end
