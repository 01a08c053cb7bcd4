!> TABLE: resistance over force, without a spot.
module litz_spot_table
   use litz_kinds, only: dp
   use litz_law_input, only: law_input_t
   use litz_law_words, only: law_field_t
   use litz_spot_law, only: spot_law_t, contact_spot_t, spot_ok, spot_bad_data
   implicit none
   private
   public :: spot_table, table_resistance_at

contains

   pure function spot_table() result(law)
      type(spot_law_t) :: law

      law%name = 'TABLE'
      law%meaning = 'resistance over force'
      law%has_table = .true.
      law%fields(1) = law_field_t('F', 'N', 'contact force; ascending')
      law%fields(2) = law_field_t('R', 'ohm', 'resistance of a contact at that force; outside the table the power'// &
         ' law of its first, or last, two pairs goes on, with a warning (outside_table)')
      law%can_be_per_length = .true.
      law%spot_of_force => table_spot
   end function spot_table

   pure subroutine table_spot(given, spot, info)
      type(law_input_t), intent(in) :: given
      type(contact_spot_t), intent(out) :: spot
      !> `spot_ok` or `spot_bad_data`
      integer, intent(out) :: info
      real(dp) :: resistance, slope

      info = spot_bad_data
      if (.not. allocated(given%table)) return
      call table_resistance_at(given%force, given%table(1, :), given%table(2, :), resistance, slope, info)
      if (info /= spot_ok) return
      spot%conductance = 1/resistance
      spot%dconductance_dforce = -slope/resistance**2
   end subroutine table_spot

   !> `R_c(F)` through the pairs of a table: smooth, and monotone wherever the table is.
   !>
   !> Piecewise cubic in `log R` over `log F` (power laws are straight there and reproduced exactly) with the slopes of
   !> Fritsch and Butland. Below the first and above the last pair the power law of the end slope continues, so that
   !> the resistance of a falling table grows without bound as the contact opens. One pair alone: constant.
   pure subroutine table_resistance_at(force, table_force, table_resistance, resistance, slope, info)
      !> F [N], positive
      real(dp), intent(in) :: force
      !> Forces (n) [N], ascending, and resistances (n) [ohm]
      real(dp), intent(in) :: table_force(:), table_resistance(:)
      !> R_c [ohm] and dR_c/dF [ohm/N]
      real(dp), intent(out) :: resistance, slope
      !> `spot_ok` or `spot_bad_data`
      integer, intent(out) :: info
      real(dp) :: x, h, s, d(2), y(2), value, derivative
      integer :: n, i

      resistance = 0
      slope = 0
      info = spot_bad_data
      n = size(table_force)
      if (n < 1 .or. size(table_resistance) /= n) return
      if (.not. (all(table_force > 0) .and. all(table_resistance > 0))) return
      if (any(table_force(2:) <= table_force(:n - 1))) return
      info = spot_ok
      if (n == 1) then
         resistance = table_resistance(1)
         return
      end if

      x = log(force)
      i = min(max(count(table_force <= force), 1), n - 1)
      h = log(table_force(i + 1)/table_force(i))
      s = (x - log(table_force(i)))/h
      y = log(table_resistance(i:i + 1))
      d = [table_slope(i, table_force, table_resistance), table_slope(i + 1, table_force, table_resistance)]
      if (s <= 0) then
         value = y(1) + d(1)*h*s
         derivative = d(1)
      else if (s >= 1) then
         value = y(2) + d(2)*h*(s - 1)
         derivative = d(2)
      else
         value = y(1)*(1 + 2*s)*(1 - s)**2 + y(2)*s**2*(3 - 2*s) + h*s*(1 - s)*(d(1)*(1 - s) - d(2)*s)
         derivative = 6*s*(1 - s)*(y(2) - y(1))/h + d(1)*(1 - s)*(1 - 3*s) + d(2)*s*(3*s - 2)
      end if
      resistance = exp(value)
      slope = derivative*resistance/force
   end subroutine table_resistance_at

   !> Slope of `log R` over `log F` at pair `i`.
   !>
   !> Source: F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300: the weighted harmonic mean of the two
   !> neighbouring slopes, 0 where they differ in sign; at an end that of the only neighbour.
   pure real(dp) function table_slope(i, table_force, table_resistance) result(slope)
      !> Number of the pair
      integer, intent(in) :: i
      !> Forces (n) [N], ascending
      real(dp), intent(in) :: table_force(:)
      !> Resistances (n) [ohm]
      real(dp), intent(in) :: table_resistance(:)
      real(dp) :: h(2), s(2), weight
      integer :: j, n

      n = size(table_force)
      do j = max(i - 1, 1), min(i, n - 1)
         h(j - i + 2) = log(table_force(j + 1)/table_force(j))
         s(j - i + 2) = log(table_resistance(j + 1)/table_resistance(j))/h(j - i + 2)
      end do
      if (i == 1) then
         slope = s(2)
      else if (i == n) then
         slope = s(1)
      else if (s(1)*s(2) > 0) then
         weight = (h(1) + 2*h(2))/(3*(h(1) + h(2)))
         slope = s(1)*s(2)/(weight*s(2) + (1 - weight)*s(1))
      else
         slope = 0
      end if
   end function table_slope

end module litz_spot_table
