!> Heat that a wire stores over a time increment, half of it at either node.
!>
!>     R = C/2 (H(T) - H(T_before))/dt,   H(T) = int c dT + l (T - Ts)/(Tl - Ts)                                     (1)
!>
!> at each node, with the mass `C` of the element and the latent heat `l` between solidus `Ts` and liquidus `Tl`. The
!> difference of enthalpies conserves energy whatever the increment, also where it steps over a latent heat. Lumped:
!> consistent capacities let the temperature next to a jump leave the range of those around it.
!>
!> With the increment before, of `dt/w`, the rate is of second order (BDF2):
!>
!>     R = C/2 (a (H(T) - H(T_before)) - b (H(T_before) - H(T_before_that)))/dt,                                     (2)
!>     a = (1 + 2w)/(1 + w),  b = w^2/(1 + w)
!>
!> The error that an increment adds follows from what the temperatures before it predict: with the extrapolation T_p
!> from three of them and the increments h, h1, h2,
!>
!>     T - T(t) = (T - T_p) (h/a)/(h/a + h + h1 + h2)                                                                (3)
!>
!> and for backward Euler, with the line T_p through two of them,
!>
!>     T - T(t) = (T - T_p) h/(2h + h1)                                                                              (4)
!>
!> In both h1 and h2 are no longer than h: of what sets in behind long increments, these know nothing.
!>
!> Source: theory section 13.
module litz_heat_capacity
   use litz_kinds, only: dp
   use litz_property_table, only: property_at, property_integral
   implicit none
   private
   public :: latent_heat_t, heat_capacity, enthalpy_difference, bdf2_weights, bdf2_error, euler_error

   !> Heat of a change of phase.
   type :: latent_heat_t
      !> l [J/kg], and temperatures between which it is taken up [K]
      real(dp) :: heat = 0, solidus = 0, liquidus = 1
   end type latent_heat_t

contains

   !> Residual of the two nodes, and the diagonal of its tangent. Backward Euler, or BDF2 with its weights.
   pure subroutine heat_capacity(temperature, before, earlier, weights, mass_per_time, specific_heat, latent, k, r)
      !> Of the nodes, now, at the start of the increment and at that of the one before it (2) [K]
      real(dp), intent(in) :: temperature(2), before(2), earlier(2)
      !> `a` and `b` of either node (2, 2); 1 and 0: backward Euler, for which `earlier` is nothing
      real(dp), intent(in) :: weights(2, 2)
      !> Mass of the element over the time increment [kg/s]
      real(dp), intent(in) :: mass_per_time
      !> Temperatures [K] and specific heats [J/(kg K)] (2, n)
      real(dp), intent(in) :: specific_heat(:, :)
      !> Those of the material (:); empty: none
      type(latent_heat_t), intent(in) :: latent(:)
      !> Derivatives of `r` by the temperatures (2) [W/K]
      real(dp), intent(out) :: k(2)
      !> Heat that the nodes take up (2) [W]
      real(dp), intent(out) :: r(2)
      real(dp) :: difference, slope, unused
      integer :: i

      do i = 1, 2
         call enthalpy_difference(temperature(i), before(i), specific_heat, latent, difference, slope)
         r(i) = weights(1, i)*(mass_per_time/2)*difference                                                ! (1), (2)
         k(i) = weights(1, i)*(mass_per_time/2)*slope
         if (.not. weights(2, i) > 0) cycle
         call enthalpy_difference(before(i), earlier(i), specific_heat, latent, difference, unused)
         r(i) = r(i) - weights(2, i)*(mass_per_time/2)*difference
      end do
   end subroutine heat_capacity

   !> `a` and `b`. Source: (2).
   pure function bdf2_weights(ratio) result(weights)
      !> w: the increment over the one before
      real(dp), intent(in) :: ratio
      real(dp) :: weights(2)

      weights = [1 + 2*ratio, ratio**2]/(1 + ratio)
   end function bdf2_weights

   !> What an increment of BDF2 adds to the error of a temperature [K]. Source: (3), to which the third derivative over
   !> time contributes alone.
   elemental real(dp) function bdf2_error(change, before, earlier, h, h1, h2) result(error)
      !> Of the temperature in the increment and in the two before it [K]
      real(dp), intent(in) :: change, before, earlier
      !> The increment, and the two before it [s]
      real(dp), intent(in) :: h, h1, h2
      real(dp) :: slope, curvature, weights(2)

      slope = before/h1
      curvature = (slope - earlier/h2)/(h1 + h2)
      weights = bdf2_weights(h/h1)
      error = (change - h*slope - h*(h + h1)*curvature)*(h/weights(1))/(h/weights(1) + h + min(h, h1) + min(h, h2))
   end function bdf2_error

   !> The same of backward Euler. Source: (4).
   elemental real(dp) function euler_error(change, before, h, h1) result(error)
      !> Of the temperature in the increment and in the one before it [K]
      real(dp), intent(in) :: change, before
      !> The increment, and the one before it [s]
      real(dp), intent(in) :: h, h1

      error = (change - h*before/h1)*h/(2*h + min(h, h1))
   end function euler_error

   !> `H(T) - H(T_before)` and its slope over T.
   pure subroutine enthalpy_difference(temperature, before, specific_heat, latent, difference, slope)
      !> T, T_before [K]
      real(dp), intent(in) :: temperature, before
      !> Temperatures [K] and specific heats [J/(kg K)] (2, n)
      real(dp), intent(in) :: specific_heat(:, :)
      !> Those of the material (:); empty: none
      type(latent_heat_t), intent(in) :: latent(:)
      !> [J/kg], [J/(kg K)]
      real(dp), intent(out) :: difference, slope
      real(dp) :: per_kelvin, value
      integer :: i

      call property_at(specific_heat, temperature, value, slope)
      slope = value
      difference = property_integral(specific_heat, before, temperature)
      do i = 1, size(latent)
         associate (solidus => latent(i)%solidus, liquidus => latent(i)%liquidus)
            per_kelvin = latent(i)%heat/(liquidus - solidus)
            difference = difference + per_kelvin*(min(max(temperature, solidus), liquidus) &
               - min(max(before, solidus), liquidus))
            if (temperature >= solidus .and. temperature < liquidus) slope = slope + per_kelvin
         end associate
      end do
   end subroutine enthalpy_difference

end module litz_heat_capacity
