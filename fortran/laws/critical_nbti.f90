!> Critical current density of Nb-Ti over temperature and flux density.
!>
!>     jc = jref C0/B b^alpha (1 - b)^beta (1 - t^1.7)^gamma,   t = T/Tc0,   b = B/(Bc20 (1 - t^1.7))               (1)
!>
!> Source: L. Bottura, A practical fit for the critical surface of NbTi, IEEE Trans. Appl. Supercond. 10 (2000)
!> 1054-1057. `jref` is that at 4.2 K and 5 T.
module litz_critical_nbti
   use litz_kinds, only: dp
   use litz_critical_density, only: critical_density_t, least_field
   implicit none
   private
   public :: nbti_density, n_nbti

   !> jref [A/m^2], C0 [T], Bc20 [T], Tc0 [K], alpha, beta, gamma
   integer, parameter :: n_nbti = 7
   real(dp), parameter :: exponent = 1.7_dp

contains

   !> Source: (1).
   pure type(critical_density_t) function nbti_density(parameters, temperature, field) result(critical)
      !> (n_nbti)
      real(dp), intent(in) :: parameters(:)
      !> [K], [T]
      real(dp), intent(in) :: temperature, field
      real(dp) :: t, u, du, b, flux, by_b

      associate (jref => parameters(1), c0 => parameters(2), bc20 => parameters(3), tc0 => parameters(4), &
         alpha => parameters(5), beta => parameters(6), gamma => parameters(7))
         ! iterates may be below absolute zero
         t = max(temperature, 0.0_dp)/tc0
         if (t >= 1) return
         u = 1 - t**exponent
         flux = max(field, least_field*bc20)
         b = flux/(bc20*u)
         if (b >= 1) return
         critical%value = jref*c0/flux*b**alpha*(1 - b)**beta*u**gamma
         ! logarithmic derivative by b
         by_b = alpha/b - beta/(1 - b)
         du = -exponent*t**(exponent - 1)/tc0
         critical%by_temperature = critical%value*(gamma - by_b*b)*du/u
         if (field > flux*(1 - epsilon(1.0_dp))) critical%by_field = critical%value*(by_b*b - 1)/flux
      end associate
   end function nbti_density

end module litz_critical_nbti
