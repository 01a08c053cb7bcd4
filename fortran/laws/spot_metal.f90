!> The metal of a constriction in which potential and temperature are functions of each other.
!>
!>     Theta(T) = int_{T_bulk}^T lambda rho dT                                                                       (1)
!>
!> with `lambda rho = L T` of a Wiedemann-Franz metal, or the product of both tables.
!> Source: theory section 13; F. Kohlrausch, Ann. Phys. 306 (1900) 132.
module litz_spot_metal
   use litz_kinds, only: dp
   use litz_property_table, only: property_at
   implicit none
   private
   public :: spot_metal_t, rise_above_bulk, theta_between, kinks_of

   !> A Wiedemann-Franz metal keeps this part of its temperature where less than absolute zero is asked for
   real(dp), parameter :: least_part = 0.1_dp
   integer, parameter :: max_iterations = 60

   type :: spot_metal_t
      !> Temperatures and rho, temperatures and lambda (2, n) [K, ohm m], [K, W/(m K)]
      real(dp), allocatable :: resistivity(:, :), heat_conductivity(:, :)
   end type spot_metal_t

contains

   !> The temperature at which (1) has a value, above that of the bulk and without a cancellation.
   pure subroutine rise_above_bulk(metal, lorenz, bulk, theta, rise, slope, by_bulk)
      type(spot_metal_t), intent(in) :: metal
      !> L [V^2/K^2] of a Wiedemann-Franz metal, whose temperatures are those from absolute zero; 0: by the tables
      real(dp), intent(in) :: lorenz
      !> T_bulk [K], and (1) [V^2]
      real(dp), intent(in) :: bulk, theta
      !> T - T_bulk [K], and the derivatives of T by (1) [K/V^2] and by T_bulk
      real(dp), intent(out) :: rise, slope, by_bulk
      real(dp) :: square, kappa(2)

      if (lorenz > 0) then
         square = max(bulk**2 + 2*theta/lorenz, (least_part*bulk)**2)
         rise = (square - bulk**2)/(bulk + sqrt(square))
         if (square > (least_part*bulk)**2) rise = 2*theta/lorenz/(bulk + sqrt(square))
         kappa = lorenz*[bulk, bulk + rise]
      else
         rise = rise_by_tables(metal, bulk, theta)
         kappa = [product_at(metal, bulk), product_at(metal, bulk + rise)]
      end if
      slope = 1/kappa(2)
      by_bulk = kappa(1)/kappa(2)
   end subroutine rise_above_bulk

   !> lambda rho [V^2/K].
   pure real(dp) function product_at(metal, temperature) result(product)
      type(spot_metal_t), intent(in) :: metal
      !> [K]
      real(dp), intent(in) :: temperature
      real(dp) :: rho, lambda, slope

      call property_at(metal%resistivity, temperature, rho, slope)
      call property_at(metal%heat_conductivity, temperature, lambda, slope)
      product = rho*lambda
   end function product_at

   !> (1) [V^2].
   pure real(dp) function theta_between(metal, lorenz, bulk, temperature) result(theta)
      type(spot_metal_t), intent(in) :: metal
      !> L of a Wiedemann-Franz metal [V^2/K^2], or 0
      real(dp), intent(in) :: lorenz
      !> T_bulk and T [K]
      real(dp), intent(in) :: bulk, temperature
      real(dp) :: at, limit

      if (lorenz > 0) then
         theta = lorenz*(temperature - bulk)*(temperature + bulk)/2
         return
      end if
      theta = 0
      at = bulk
      do while (abs(temperature - at) > 0)
         limit = next_pair(metal, at, temperature > at)
         if ((limit - temperature)*(temperature - at) > 0) limit = temperature
         theta = theta + cubic(coefficients(metal, at, limit), limit - at)
         at = limit
      end do
   end function theta_between

   !> Walk from pair to pair of the tables; between them (1) is a cubic.
   pure real(dp) function rise_by_tables(metal, bulk, theta) result(rise)
      type(spot_metal_t), intent(in) :: metal
      !> [K], [V^2]
      real(dp), intent(in) :: bulk, theta
      real(dp) :: at, limit, left, whole, a(3)

      rise = 0
      at = bulk
      left = theta
      do while (abs(left) > 0)
         limit = next_pair(metal, at, left > 0)
         a = coefficients(metal, at, limit)
         if (abs(limit) < huge(limit)) then
            whole = cubic(a, limit - at)
            if (abs(left) > abs(whole)) then
               left = left - whole
               rise = rise + (limit - at)
               at = limit
               cycle
            end if
            rise = rise + root_of_cubic(a, left, limit - at)
         else
            rise = rise + left/a(1)
         end if
         exit
      end do
   end function rise_by_tables

   !> The next temperature of either table in this direction; huge: there is none [K].
   pure real(dp) function next_pair(metal, temperature, upwards) result(next)
      type(spot_metal_t), intent(in) :: metal
      !> [K]
      real(dp), intent(in) :: temperature
      !> Above it, else below
      logical, intent(in) :: upwards

      associate (a => metal%resistivity(1, :), b => metal%heat_conductivity(1, :))
         if (upwards) then
            next = min(minval(a, a > temperature), minval(b, b > temperature))
         else
            next = max(maxval(a, a < temperature), maxval(b, b < temperature))
         end if
      end associate
   end function next_pair

   !> Of `lambda rho` over the distance from one end of an interval within which both are linear (3).
   pure function coefficients(metal, at, limit) result(a)
      type(spot_metal_t), intent(in) :: metal
      !> Ends of the interval [K]
      real(dp), intent(in) :: at, limit
      real(dp) :: a(3), rho, lambda, drho, dlambda, middle

      if (abs(limit) < huge(limit)) then
         middle = (at + limit)/2
      else
         middle = at + sign(max(1.0_dp, abs(at)), limit)
      end if
      call property_at(metal%resistivity, middle, rho, drho)
      call property_at(metal%heat_conductivity, middle, lambda, dlambda)
      rho = rho + drho*(at - middle)
      lambda = lambda + dlambda*(at - middle)
      a = [lambda*rho, lambda*drho + dlambda*rho, dlambda*drho]
   end function coefficients

   !> Integral of the quadratic from 0 to d.
   pure real(dp) function cubic(a, d)
      !> (3), and upper limit
      real(dp), intent(in) :: a(3), d

      cubic = d*(a(1) + d*(a(2)/2 + d*a(3)/3))
   end function cubic

   !> Where the cubic, which grows from 0 to the limit, has a value: Newton's method within what encloses the root.
   pure real(dp) function root_of_cubic(a, value, limit) result(d)
      !> (3); value; the root is between 0 and the limit, of either sign
      real(dp), intent(in) :: a(3), value, limit
      real(dp) :: inner, outer, left, step
      integer :: iteration

      inner = 0
      outer = limit
      d = limit*(value/cubic(a, limit))
      do iteration = 1, max_iterations
         left = value - cubic(a, d)
         if (left*sign(1.0_dp, limit) > 0) then
            inner = d
         else
            outer = d
         end if
         step = left/(a(1) + d*(a(2) + d*a(3)))
         if (.not. (d + step - inner)*(outer - d - step) >= 0) step = (inner + outer)/2 - d
         d = d + step
         if (abs(step) <= epsilon(d)*abs(d)) exit
      end do
   end function root_of_cubic

   !> Temperatures at which rho, or the product with lambda, has a kink.
   pure function kinks_of(metal, lorenz) result(kinks)
      type(spot_metal_t), intent(in) :: metal
      !> L of a Wiedemann-Franz metal [V^2/K^2], or 0
      real(dp), intent(in) :: lorenz
      real(dp), allocatable :: kinks(:)

      kinks = metal%resistivity(1, :)
      if (.not. lorenz > 0) kinks = [kinks, metal%heat_conductivity(1, :)]
   end function kinks_of

end module litz_spot_metal
