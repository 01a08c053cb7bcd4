!> Critical current density of Nb3Sn over temperature, flux density and strain.
!>
!>     jc = C/B s (1 - t^1.52) (1 - t^2) b^p (1 - b)^q,   t = T/(Tc0 s^(1/3)),   b = B/(Bc20 s (1 - t^1.52))       (1)
!>     s = 1 + [Ca1 (sqrt(esh^2 + e0^2) - sqrt((e - esh)^2 + e0^2)) - Ca2 e]/(1 - Ca1 e0)                           (2)
!>     esh = Ca2 e0/sqrt(Ca1^2 - Ca2^2),   e = strain - em                                                          (3)
!>
!> Source: L. Bottura, B. Bordini, Jc(B,T,epsilon) parameterization for the ITER Nb3Sn production, IEEE Trans. Appl.
!> Supercond. 19 (2009) 1521-1524 (the ITER-2008 parametrization).
module litz_critical_nb3sn
   use litz_kinds, only: dp
   use litz_critical_density, only: critical_density_t, least_field
   implicit none
   private
   public :: nb3sn_density, n_nb3sn

   !> C [A T/m^2], Bc20 [T], Tc0 [K], p, q, Ca1, Ca2, e0, em
   integer, parameter :: n_nb3sn = 9
   real(dp), parameter :: exponent = 1.52_dp

contains

   !> Source: (1).
   pure type(critical_density_t) function nb3sn_density(parameters, temperature, field, strain) result(critical)
      !> (n_nb3sn)
      real(dp), intent(in) :: parameters(:)
      !> [K], [T], [-]
      real(dp), intent(in) :: temperature, field, strain
      real(dp) :: s, ds, t, t_by_strain, u, w, b, flux, by_t, by_b

      associate (c => parameters(1), bc20 => parameters(2), tc0 => parameters(3), p => parameters(4), &
         q => parameters(5))
         call strain_function(parameters(6:9), strain, s, ds)
         if (.not. s > 0) return
         ! iterates may be below absolute zero
         t = max(temperature, 0.0_dp)/(tc0*s**(1/3.0_dp))
         if (t >= 1) return
         u = 1 - t**exponent
         w = 1 - t**2
         flux = max(field, least_field*bc20)
         b = flux/(bc20*s*u)
         if (b >= 1) return
         critical%value = c/flux*s*u*w*b**p*(1 - b)**q
         ! logarithmic derivatives by t at a given b, and by b
         by_t = -exponent*t**(exponent - 1)/u - 2*t/w
         by_b = p/b - q/(1 - b)
         by_t = by_t + by_b*b*exponent*t**(exponent - 1)/u
         t_by_strain = -t*ds/(3*s)
         critical%by_temperature = critical%value*by_t/(tc0*s**(1/3.0_dp))
         critical%by_strain = critical%value*(ds/s*(1 - by_b*b) + by_t*t_by_strain)
         if (field > flux*(1 - epsilon(1.0_dp))) critical%by_field = critical%value*(by_b*b - 1)/flux
      end associate
   end function nb3sn_density

   !> Source: (2), (3).
   pure subroutine strain_function(parameters, strain, s, ds)
      !> Ca1, Ca2, e0, em
      real(dp), intent(in) :: parameters(4)
      !> Axial strain [-]
      real(dp), intent(in) :: strain
      !> s, and its derivative by the strain
      real(dp), intent(out) :: s, ds
      real(dp) :: shift, intrinsic_strain

      associate (ca1 => parameters(1), ca2 => parameters(2), e0 => parameters(3), em => parameters(4))
         shift = ca2*e0/sqrt(ca1**2 - ca2**2)
         intrinsic_strain = strain - em
         s = 1 + (ca1*(hypot(shift, e0) - hypot(intrinsic_strain - shift, e0)) - ca2*intrinsic_strain)/(1 - ca1*e0)
         ds = -(ca1*(intrinsic_strain - shift)/hypot(intrinsic_strain - shift, e0) + ca2)/(1 - ca1*e0)
      end associate
   end subroutine strain_function

end module litz_critical_nb3sn
