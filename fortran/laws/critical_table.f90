!> Critical current density given over temperature and flux density: linear in both between the lines of a table,
!> constant outside.
module litz_critical_table
   use litz_kinds, only: dp
   use litz_critical_density, only: critical_density_t
   implicit none
   private
   public :: table_density

contains

   !> Bilinear in the cell of the table; where it ends the slope across its edge is zero.
   pure type(critical_density_t) function table_density(temperatures, fields, densities, temperature, field) &
      result(critical)
      !> Ascending (n_t) [K], ascending (n_b) [T], values (n_t, n_b) [A/m^2]
      real(dp), intent(in) :: temperatures(:), fields(:), densities(:, :)
      !> [K], [T]
      real(dp), intent(in) :: temperature, field
      real(dp) :: along_t(2), along_b(2), slope_t(2), slope_b(2)
      integer :: at_t(2), at_b(2)

      call weights(temperatures, temperature, at_t, along_t, slope_t)
      call weights(fields, field, at_b, along_b, slope_b)
      associate (corners => densities(at_t, at_b))
         critical%value = dot_product(along_t, matmul(corners, along_b))
         critical%by_temperature = dot_product(slope_t, matmul(corners, along_b))
         critical%by_field = dot_product(along_t, matmul(corners, slope_b))
      end associate
   end function table_density

   !> The two values that a place is between, their weights, and the derivatives of these by the place.
   pure subroutine weights(values, place, at, weight, slope)
      !> Ascending (n), and a place among them
      real(dp), intent(in) :: values(:), place
      !> Numbers of the values (2)
      integer, intent(out) :: at(2)
      !> (2)
      real(dp), intent(out) :: weight(2), slope(2)
      integer :: i

      i = count(values <= place)
      at = [max(i, 1), min(i + 1, size(values))]
      weight = [1, 0]
      slope = 0
      if (i == 0 .or. i == size(values)) return
      slope = [-1, 1]/(values(i + 1) - values(i))
      weight(2) = (place - values(i))*slope(2)
      weight(1) = 1 - weight(2)
   end subroutine weights

end module litz_critical_table
