!> Material data over temperature: linear between the lines of a table, constant beyond its ends.
!>
!> Source: Abaqus's rule for data over temperature.
module litz_temperature_tables
   use litz_kinds, only: dp
   implicit none
   private
   public :: table_values

contains

   !> The values at a temperature.
   pure function table_values(table, temperature) result(values)
      !> Temperature [K], ascending, and values at it (1 + values, lines)
      real(dp), intent(in) :: table(:, :)
      !> [K]
      real(dp), intent(in) :: temperature
      real(dp) :: values(size(table, 1) - 1)
      integer :: line

      line = line_below(table, temperature)
      if (line == 0) then
         values = table(2:, 1)
      else if (line == size(table, 2)) then
         values = table(2:, line)
      else
         values = table(2:, line) + table_slopes(table, temperature)*(temperature - table(1, line))
      end if
   end function table_values

   !> Their derivatives by the temperature; at a line of the table those above it.
   pure function table_slopes(table, temperature) result(slopes)
      !> As of `table_values` (1 + values, lines)
      real(dp), intent(in) :: table(:, :)
      !> [K]
      real(dp), intent(in) :: temperature
      real(dp) :: slopes(size(table, 1) - 1)
      integer :: line

      slopes = 0
      line = line_below(table, temperature)
      if (line == 0 .or. line == size(table, 2)) return
      slopes = (table(2:, line + 1) - table(2:, line))/(table(1, line + 1) - table(1, line))
   end function table_slopes

   !> The last line whose temperature is not above this one; 0: there is none.
   pure integer function line_below(table, temperature) result(line)
      !> As of `table_values` (1 + values, lines)
      real(dp), intent(in) :: table(:, :)
      !> [K]
      real(dp), intent(in) :: temperature

      line = count(table(1, :) <= temperature)
   end function line_below

end module litz_temperature_tables
