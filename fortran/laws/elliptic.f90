!> Complete elliptic integrals, accurate to round-off over the whole range, without a cancellation at either end.
!>
!> With the parameter `m = k^2` and `Delta = sqrt(1 - m sin^2 t)`, all integrals from 0 to pi/2:
!> `K = int 1/Delta`, `E = int Delta`, `B = int cos^2/Delta`, `D = int sin^2/Delta`, `C = int sin^2 cos^2/Delta^3`.
!> They are related by `K = B + D`, `E = B + m1 D`, `m C = D - B`, and `m1 = 1 - m` is the complementary parameter.
!> Differences such as `K - E = m D` and `E - m1 K = m B`, which a slender or a nearly round contact spot needs, are
!> so at hand without being formed as differences.
!>
!> Source: the arithmetic-geometric mean (Gauss), and Legendre's relation `E K' + E' K - K K' = pi/2` for large `m`.
module litz_elliptic
   use litz_kinds, only: dp, pi
   implicit none
   private
   public :: elliptic_t, elliptic_integrals, elliptic_integrals_complementary

   type :: elliptic_t
      !> Parameter and complementary parameter
      real(dp) :: m = 0, m1 = 1
      !> The integrals of the header
      real(dp) :: k = pi/2, e = pi/2, b = pi/4, d = pi/4, c = pi/16
      !> dK/dm (infinite at m = 1) and dE/dm
      real(dp) :: dk_dm = pi/8, de_dm = -pi/8
   end type elliptic_t

contains

   !> The integrals at the parameter `m` in [0, 1).
   pure type(elliptic_t) function elliptic_integrals(m) result(f)
      !> Parameter m = k^2
      real(dp), intent(in) :: m

      f = integrals(m, 1 - m)
   end function elliptic_integrals

   !> The integrals at the complementary parameter `m1 = 1 - m` in (0, 1]: exact also where `m` rounds to 1.
   pure type(elliptic_t) function elliptic_integrals_complementary(m1) result(f)
      !> Complementary parameter
      real(dp), intent(in) :: m1

      f = integrals(1 - m1, m1)
   end function elliptic_integrals_complementary

   pure type(elliptic_t) function integrals(m, m1) result(f)
      !> Parameter, in [0, 1)
      real(dp), intent(in) :: m
      !> Complementary parameter `1 - m`, known without cancellation
      real(dp), intent(in) :: m1
      real(dp) :: mean, sigma, tau, mean_1, sigma_1, tau_1

      f%m = m
      f%m1 = m1
      call arithmetic_geometric_mean(m, sqrt(m1), mean, sigma, tau)
      f%k = pi/(2*mean)
      f%d = f%k*sigma
      if (m <= 0.5_dp) then
         f%b = f%k*(1 - sigma)
         f%c = f%k*tau
      else
         ! Legendre's relation, solved for E = pi/(2 K') + K (K' - E')/K'
         call arithmetic_geometric_mean(m1, sqrt(m), mean_1, sigma_1, tau_1)
         f%b = (mean_1 - f%k*m1*(1 - sigma_1))/m
         f%c = (f%d - f%b)/m
      end if
      f%e = f%b + m1*f%d
      f%dk_dm = f%b/(2*m1)
      f%de_dm = -f%d/2
   end function integrals

   !> Limit of `a <- (a+b)/2, b <- sqrt(a b)` from `a = 1`, `b = k1`, and the sums over its differences.
   !>
   !> With `c_0^2 = m` and `c_{n+1} = (a_n - b_n)/2 = c_n^2/(4 a_{n+1})`: `sigma = sum 2^(n-1) c_n^2/m` over n >= 0 is
   !> `D/K`, and `tau = (2 sigma - 1)/m` is `C/K`. All terms are positive, so nothing cancels.
   pure subroutine arithmetic_geometric_mean(m, k1, mean, sigma, tau)
      !> Parameter, in [0, 1]
      real(dp), intent(in) :: m
      !> Complementary modulus `sqrt(1 - m)`, positive
      real(dp), intent(in) :: k1
      !> The limit
      real(dp), intent(out) :: mean
      !> `D/K`
      real(dp), intent(out) :: sigma
      !> `C/K`
      real(dp), intent(out) :: tau
      real(dp) :: a, b, c, power, geometric
      integer :: n

      a = (1 + k1)/2
      b = sqrt(k1)
      ! c is c_n/m, from the first step on
      c = 1/(4*a)
      power = 1
      tau = 2*power*c*c
      do n = 1, 12
         if (m*c <= epsilon(1.0_dp)*1.0e-8_dp*a) exit
         geometric = sqrt(a*b)
         a = (a + b)/2
         b = geometric
         c = m*c*c/(4*a)
         power = 2*power
         tau = tau + 2*power*c*c
      end do
      mean = a
      sigma = (1 + m*tau)/2
   end subroutine arithmetic_geometric_mean

end module litz_elliptic
