!> The part of a cell that touches: integrals over it against closed forms, and their derivatives against differences.
program test_line_cell
   use litz_kinds, only: dp
   use litz_line_cell, only: line_cell_t, cell_samples_t, cell_samples, cell_integral, touching_length, n_of_cell
   implicit none

   !> Overlap at the place, slope and curvature of the distance, and what the ends and the extreme do in the cell
   type :: case_t
      character(len=40) :: name
      real(dp) :: overlap, slope, bend
   end type case_t
   !> Of a cell from -0.6 to 1
   type(case_t), parameter :: cases(*) = [ &
      case_t('even', 1.0_dp, 0.0_dp, 0.0_dp), &
      case_t('ends ahead', 0.5_dp, 1.0_dp, 0.0_dp), &
      case_t('ends behind', 0.2_dp, -1.0_dp, 0.0_dp), &
      case_t('open at the place', -0.2_dp, 1.0_dp, 0.0_dp), &
      case_t('a lens that reaches beyond', 2.0_dp, -0.2_dp, 1.0_dp), &
      case_t('a lens that ends ahead', 0.3_dp, 0.1_dp, 1.0_dp), &
      case_t('a lens within', 0.05_dp, -0.1_dp, 1.5_dp), &
      case_t('a lens with its middle beyond', 0.1_dp, -2.0_dp, 1.5_dp), &
      case_t('a gap within', -0.02_dp, 0.1_dp, -1.0_dp), &
      case_t('shallow in the middle', 0.2_dp, -0.1_dp, -1.0_dp), &
      case_t('apart', -1.0_dp, 0.1_dp, 0.3_dp)]
   real(dp), parameter :: reach(2) = [0.6_dp, 1.0_dp]
   integer :: failures = 0, i

   do i = 1, size(cases)
      call check_case(cases(i))
   end do
   call the_integral_is_continuous()
   if (failures > 0) error stop 1

contains

   subroutine check_case(c)
      type(case_t), intent(in) :: c
      type(line_cell_t) :: cell

      cell = line_cell_t(reach, c%overlap, c%slope, c%bend)
      call check(trim(c%name)//': length', touching_length(cell), summed(cell, one), 1.0e-6_dp)
      ! polynomials are exact: this is the force of a penalty
      call check(trim(c%name)//': overlap', integral_of(cell, linear), summed(cell, linear), 1.0e-6_dp)
      ! conductance through a film, and of clean metal: a step but for a logarithm
      call check(trim(c%name)//': root', integral_of(cell, root), summed(cell, root), 2.0e-3_dp)
      call check(trim(c%name)//': logarithm', integral_of(cell, metal), summed(cell, metal), 1.0e-3_dp)
      call check_derivatives(trim(c%name), cell)
   end subroutine check_case

   !> As the end of the contact and the deepest place pass through the cell and its ends.
   subroutine the_integral_is_continuous()
      integer, parameter :: steps = 40000
      real(dp) :: before, now, largest
      integer :: k

      largest = 0
      before = integral_of(line_cell_t(reach, 0.1_dp, -2.0_dp, 1.0_dp), metal)
      do k = 1, steps
         now = integral_of(line_cell_t(reach, 0.1_dp, -2 + 4*real(k, dp)/steps, 1.0_dp), metal)
         largest = max(largest, abs(now - before))
         before = now
      end do
      ! an end of the contact at s moves by s/sqrt(t^2 + 2 k delta) <= 2.3 times the step of the slope, 1e-4; there is
      ! no other jump
      call check('continuous', largest, 0.0_dp, 2.3e-4_dp*metal(1.0_dp))
   end subroutine the_integral_is_continuous

   pure real(dp) function one(overlap)
      !> [m]
      real(dp), intent(in) :: overlap

      one = merge(1.0_dp, 0.0_dp, overlap > 0)
   end function one

   pure real(dp) function linear(overlap)
      !> [m]
      real(dp), intent(in) :: overlap

      linear = max(overlap, 0.0_dp)
   end function linear

   pure real(dp) function root(overlap)
      !> [m]
      real(dp), intent(in) :: overlap

      root = sqrt(max(overlap, 0.0_dp))
   end function root

   pure real(dp) function metal(overlap)
      !> [m]
      real(dp), intent(in) :: overlap

      metal = 0
      if (overlap > 0) metal = 1/(10 - log(overlap + 1.0e-4_dp))
   end function metal

   real(dp) function integral_of(cell, value) result(integral)
      type(line_cell_t), intent(in) :: cell
      interface
         pure real(dp) function value(overlap)
            import :: dp
            implicit none
            real(dp), intent(in) :: overlap
         end function value
      end interface
      type(cell_samples_t) :: samples
      integer :: k

      samples = cell_samples(cell)
      integral = sum([(samples%weight(k)*value(samples%overlap(k)), k=1, samples%n)])
   end function integral_of

   !> The same with many even parts.
   real(dp) function summed(cell, value)
      type(line_cell_t), intent(in) :: cell
      interface
         pure real(dp) function value(overlap)
            import :: dp
            implicit none
            real(dp), intent(in) :: overlap
         end function value
      end interface
      integer, parameter :: parts = 4000000
      real(dp) :: s
      integer :: k

      summed = 0
      do k = 1, parts
         s = -cell%reach(1) + sum(cell%reach)*(k - 0.5_dp)/parts
         summed = summed + value(cell%overlap - (cell%slope + cell%bend*s/2)*s)
      end do
      summed = summed*sum(cell%reach)/parts
   end function summed

   !> By overlap, slope and curvature.
   subroutine check_derivatives(name, cell)
      character(len=*), intent(in) :: name
      type(line_cell_t), intent(in) :: cell
      real(dp), parameter :: h = 1.0e-5_dp
      type(cell_samples_t) :: samples
      real(dp) :: integral, derivative(n_of_cell), difference
      integer :: k

      samples = cell_samples(cell)
      associate (d => samples%overlap(:samples%n))
         call cell_integral(samples, metal_of(d), metal_of(d)**2/(d + 1.0e-4_dp), integral, derivative)
      end associate
      call check(name//': integral', integral, integral_of(cell, metal), 1.0e-14_dp)
      do k = 1, n_of_cell
         difference = (integral_of(moved(cell, k, h), metal) - integral_of(moved(cell, k, -h), metal))/(2*h)
         call check(name//': derivative', derivative(k), difference, 1.0e-6_dp)
      end do
   end subroutine check_derivatives

   function metal_of(overlap) result(values)
      !> (n) [m]
      real(dp), intent(in) :: overlap(:)
      real(dp) :: values(size(overlap))
      integer :: k

      values = [(metal(overlap(k)), k=1, size(overlap))]
   end function metal_of

   type(line_cell_t) function moved(cell, k, by)
      type(line_cell_t), intent(in) :: cell
      !> Overlap, slope or curvature
      integer, intent(in) :: k
      !> [m, -, 1/m]
      real(dp), intent(in) :: by

      moved = cell
      if (k == 1) moved%overlap = cell%overlap + by
      if (k == 2) moved%slope = cell%slope + by
      if (k == 3) moved%bend = cell%bend + by
   end function moved

   subroutine check(what, found, expected, tolerance)
      character(len=*), intent(in) :: what
      !> Values, and how far they may be apart: relative to one length of the cell
      real(dp), intent(in) :: found, expected, tolerance

      if (abs(found - expected) <= tolerance) return
      failures = failures + 1
      print '(a, 3es16.8)', 'failed: '//what, found, expected, found - expected
   end subroutine check

end program test_line_cell
