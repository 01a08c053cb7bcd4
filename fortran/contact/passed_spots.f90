!> Heat that passes through the spot of one contact, and how it changes with its current and the wires' temperatures.
!>
!> Source: theory section 13.
module litz_passed_spots
   use litz_heated_contacts, only: heated_contact_t
   use litz_hot_spot, only: hot_spot_t, by_volt, by_both
   use litz_kinds, only: dp
   use litz_spot_heat, only: spot_heat_t, spot_heat, heat_ok, by_heat, by_temperature, by_path
   implicit none
   private
   public :: passed_spot_t, cold_spot, warmed_spot

   type :: passed_spot_t
      !> To the wires (2) [W], and highest temperature from absolute zero [K]
      real(dp) :: heat(2) = 0, hottest = 0
      !> How the heats change with the temperatures of the wires at fixed current (2, 2) [W/K], and with the current (2)
      !> [W/A]; how the voltage does with the temperatures at fixed current (2) [V/K]
      real(dp) :: by_bulk(2, 2) = 0, by_current(2) = 0, dvoltage(2) = 0
      !> How the heats change at fixed current and bulks with the logarithms of the shape of the constrictions, to which
      !> their resistances are proportional, and of the heat conductance (2) [W]
      real(dp) :: by_shape(2) = 0, by_heat_conductance(2) = 0
   end type passed_spot_t

contains

   !> With the properties at the temperatures of the wires.
   pure subroutine cold_spot(contact, temperature, current, spot, ok)
      type(heated_contact_t), intent(in) :: contact
      !> Of the wires at the contact, from absolute zero (2) [K]; current [A]
      real(dp), intent(in) :: temperature(2), current
      type(passed_spot_t), intent(out) :: spot
      !> There is one
      logical, intent(out) :: ok
      type(spot_heat_t) :: found
      real(dp) :: ohm(3), dohm(3, 2)
      integer :: info

      ohm = [contact%resistance(1), contact%film_resistance, contact%resistance(2)]
      dohm = 0
      dohm([1, 3], :) = contact%dresistance
      call spot_heat(contact%path, temperature, current**2*ohm, found, info)
      ok = info == heat_ok
      spot%heat = found%heat
      spot%hottest = found%hottest
      associate (dheat => found%dheat)
         spot%by_current = matmul(dheat(:, by_heat), 2*current*ohm)
         spot%by_bulk = dheat(:, by_temperature) + matmul(dheat(:, by_path), contact%dpath) &
            + matmul(dheat(:, by_heat), current**2*dohm)
         spot%by_shape = matmul(dheat(:, by_heat), current**2*[1, 2, 1]*ohm)
         spot%by_heat_conductance = sum(dheat(:, by_path), 2)
      end associate
      spot%dvoltage = current*contact%dseries
   end subroutine cold_spot

   !> One that its current warms, whose derivatives are those at fixed voltage.
   pure type(passed_spot_t) function warmed_spot(hot, zero) result(spot)
      type(hot_spot_t), intent(in) :: hot
      !> Absolute zero on the scale of the temperatures [K]
      real(dp), intent(in) :: zero

      spot%heat = hot%heat
      spot%hottest = maxval(hot%hottest) - zero
      spot%by_current = hot%dheat(:, by_volt)/hot%dcurrent(by_volt)
      spot%by_bulk = hot%dheat(:, by_both) - spread(spot%by_current, 2, 2)*spread(hot%dcurrent(by_both), 1, 2)
      spot%dvoltage = -hot%dcurrent(by_both)/hot%dcurrent(by_volt)
      ! heats over the size of the spot are functions of the current over it
      spot%by_shape = hot%current*spot%by_current - hot%heat
   end function warmed_spot

end module litz_passed_spots
