!> The lens of a crossing as a place in it sees it: against the lens of straight wires, and its derivatives against
!> differences.
program test_lens_at_place
   use litz_kinds, only: dp
   use litz_law_input, only: wire_pair_t
   use litz_lens_at_place, only: deepest_overlap_t, deepest_overlap, lens_at_place_t, lens_at_place, integral_at_place
   use litz_line_cell, only: line_cell_t
   use litz_lens_law, only: lens_t, lens_force, n_depths
   use litz_line_law, only: line_wires_t, line_wires
   implicit none

   !> Deepest overlap [m], and sine of the angle between the wires
   real(dp), parameter :: deepest = 2.0e-6_dp, sine = 0.1_dp
   !> Places along the lens, in half lengths; the last one does not touch
   real(dp), parameter :: places(*) = [0.0_dp, -0.4_dp, 0.9_dp, 1.2_dp]
   type(wire_pair_t) :: wires
   type(line_wires_t) :: line
   integer :: failures = 0, i

   wires%radius = [1.0e-3_dp, 0.7e-3_dp]
   wires%young = [120.0e9_dp, 70.0e9_dp]
   wires%poisson = [0.34_dp, 0.3_dp]
   wires%resistivity = [1.7e-8_dp, 2.8e-8_dp]
   line = line_wires(wires, asin(sine))
   do i = 1, size(places)
      call check_place(places(i), 0.0_dp)
   end do
   call check_place(0.4_dp, 3.0e10_dp)
   call what_was_deeper_stays()
   call the_integral_of_the_force()
   call nothing_where_there_is_no_lens()
   if (failures > 0) error stop 1

contains

   !> All places of a lens see the same one.
   subroutine check_place(u, penalty)
      !> Place along the lens [-], and eps_l [N/m^2]
      real(dp), intent(in) :: u, penalty
      type(lens_t) :: exact
      type(lens_at_place_t) :: lens, up, down
      real(dp) :: cell(3), step(3)
      integer :: k

      exact = lens_force(line, -deepest, sine, penalty)
      associate (a => exact%half_length)
         cell(3) = 2*deepest/a**2
         cell(2) = cell(3)*u*a
         cell(1) = deepest*(1 - u**2)
      end associate
      lens = at(cell, penalty)
      call check('half length', lens%half_length/exact%half_length, 1.0_dp, 1.0e-13_dp)
      call check('force', lens%force/exact%force, 1.0_dp, 1.0e-13_dp)
      do k = 1, 3
         step = 1.0e-4_dp*[deepest, cell(3)*exact%half_length, cell(3)]*unit(k)
         up = at(cell + step, penalty)
         down = at(cell - step, penalty)
         associate (h => 2*sum(step))
            call check('half length, derivative', lens%dhalf_length(k)*h/lens%half_length, &
               (up%half_length - down%half_length)/lens%half_length, 1.0e-11_dp)
            call check('force, derivative', lens%dforce(k)*h/lens%force, (up%force - down%force)/lens%force, 1.0e-10_dp)
         end associate
      end do
   end subroutine check_place

   !> The overlap of an earlier lens stays, and with it all that follows but for the course of the distance.
   subroutine what_was_deeper_stays()
      type(line_cell_t) :: cell
      type(deepest_overlap_t) :: now, made, known
      type(lens_at_place_t) :: lens

      cell = line_cell_t(overlap=deepest/4, slope=1.0e-3_dp, bend=2.0_dp)
      now = deepest_overlap(cell, 0.0_dp)
      made = deepest_overlap(cell, deepest)
      call check('deeper', made%value - now%value, deepest, 1.0e-20_dp)
      call check('the overlap counts', now%derivative(1), 1.0_dp, 0.0_dp)
      call check('the overlap does not count', made%derivative(1), 0.0_dp, 0.0_dp)
      known%value = made%value
      lens = lens_at_place(line, known, cell%bend, 0.0_dp)
      call check('known overlap', maxval(abs(lens%dforce(:2))), 0.0_dp, 0.0_dp)
      ! F goes with the length, which goes with the root of the curvature
      call check('known overlap, length', lens%dforce(3)*2*cell%bend/lens%force, -1.0_dp, 1.0e-13_dp)
   end subroutine what_was_deeper_stays

   !> The integral of the force per length is the force.
   subroutine the_integral_of_the_force()
      type(lens_at_place_t) :: lens
      real(dp) :: force, derivative(3)
      real(dp), parameter :: ones(n_depths) = 1

      lens = at([deepest/2, 1.0e-3_dp, 2.0_dp], 0.0_dp)
      call integral_at_place(lens, lens%along%force, ones, force, derivative)
      call check('integral', force/lens%force, 1.0_dp, 1.0e-14_dp)
      call check('integral, derivative', maxval(abs(derivative/lens%dforce - 1)), 0.0_dp, 1.0e-13_dp)
   end subroutine the_integral_of_the_force

   subroutine nothing_where_there_is_no_lens()
      type(lens_at_place_t) :: lens

      lens = at([-deepest, 0.0_dp, 1.0_dp], 0.0_dp)
      call check('no overlap', lens%force + lens%half_length, 0.0_dp, 0.0_dp)
      lens = at([deepest, 0.01_dp, -1.0_dp], 0.0_dp)
      call check('no end', lens%force + lens%half_length, 0.0_dp, 0.0_dp)
   end subroutine nothing_where_there_is_no_lens

   type(lens_at_place_t) function at(cell, penalty)
      !> Overlap [m], slope [-] and curvature [1/m] of the distance (3), and eps_l [N/m^2]
      real(dp), intent(in) :: cell(3), penalty

      at = lens_at_place(line, deepest_overlap(line_cell_t(overlap=cell(1), slope=cell(2), bend=cell(3)), 0.0_dp), &
         cell(3), penalty)
   end function at

   pure function unit(k)
      !> Component
      integer, intent(in) :: k
      real(dp) :: unit(3)

      unit = 0
      unit(k) = 1
   end function unit

   subroutine check(what, found, expected, tolerance)
      character(len=*), intent(in) :: what
      !> Values, and how far they may be apart
      real(dp), intent(in) :: found, expected, tolerance

      if (abs(found - expected) <= tolerance) return
      failures = failures + 1
      print '(a, 3es16.8)', 'failed: '//what, found, expected, found - expected
   end subroutine check

end program test_lens_at_place
