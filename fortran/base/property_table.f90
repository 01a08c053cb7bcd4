!> A property over temperature, given by a table: linear between its pairs, constant outside.
!>
!> A table has the shape (2, n): temperatures, ascending, and values.
module litz_property_table
   use litz_kinds, only: dp
   implicit none
   private
   public :: property_at, property_integral

contains

   !> Value and slope; at a pair the slope is that above it.
   pure subroutine property_at(table, temperature, value, slope)
      !> (2, n)
      real(dp), intent(in) :: table(:, :)
      !> [K]
      real(dp), intent(in) :: temperature
      !> Value, and its derivative by the temperature
      real(dp), intent(out) :: value, slope
      integer :: i, n

      n = size(table, 2)
      i = count(table(1, :) <= temperature)
      slope = 0
      value = table(2, max(i, 1))
      if (i == 0 .or. i == n) return
      slope = (table(2, i + 1) - table(2, i))/(table(1, i + 1) - table(1, i))
      value = table(2, i) + slope*(temperature - table(1, i))
   end subroutine property_at

   !> Integral of the property over the temperature. It vanishes with the interval, without a cancellation.
   pure real(dp) function property_integral(table, from, to) result(integral)
      !> (2, n)
      real(dp), intent(in) :: table(:, :)
      !> Limits [K], in any order
      real(dp), intent(in) :: from, to
      real(dp) :: low, high, a, b, value, slope
      integer :: i, n

      n = size(table, 2)
      low = min(from, to)
      high = max(from, to)
      integral = table(2, 1)*max(min(high, table(1, 1)) - low, 0.0_dp) &
         + table(2, n)*max(high - max(low, table(1, n)), 0.0_dp)
      do i = 1, n - 1
         a = max(low, table(1, i))
         b = min(high, table(1, i + 1))
         if (.not. b > a) cycle
         call property_at(table, (a + b)/2, value, slope)
         integral = integral + value*(b - a)
      end do
      if (to < from) integral = -integral
   end function property_integral

end module litz_property_table
