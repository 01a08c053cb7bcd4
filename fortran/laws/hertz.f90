!> The exact elliptic Hertz contact of two round wires that cross at an angle: the part that depends on geometry and
!> elasticity only, shared by the contact-spot laws and the normal law.
!>
!> Source: theory section 6, `HERTZ`. For a force `F`: semi-major axis `a = ca F^(1/3)`, semi-minor axis
!> `b = ratio a`, approach `delta = cd F^(2/3)`.
module litz_hertz
   use litz_kinds, only: dp, pi
   use litz_elliptic, only: elliptic_t, elliptic_integrals_complementary
   implicit none
   private
   public :: hertz_ellipse_t, hertz_ellipse, hertz_near_ends, effective_modulus
   public :: hertz_ok, hertz_parallel

   integer, parameter :: hertz_ok = 0
   !> The axes are parallel: the spot would be infinitely long
   integer, parameter :: hertz_parallel = -1

   type :: hertz_ellipse_t
      !> b/a in (0, 1]
      real(dp) :: ratio = 1
      !> ca [m N^(-1/3)] and cd [m N^(-2/3)]
      real(dp) :: semi_major = 0, approach = 0
      !> E* [Pa], and angle between the axes [rad]
      real(dp) :: modulus = 0, angle = 0
      !> Derivatives with respect to the angle, per radian: of cd, and of log(a b). Both are smooth and vanish at 90
      !> degrees, where a and b of equal wires change places and have no derivative of their own.
      real(dp) :: dapproach_dangle = 0, dlog_area_dangle = 0
      !> Second derivative of cd, per radian^2
      real(dp) :: d2approach_dangle2 = 0
      !> The same of log(b/a); 0 at 90 degrees, where equal wires have none
      real(dp) :: dlog_ratio_dangle = 0
   end type hertz_ellipse_t

   !> Newton on the ratio equation stops at this change of log(b/a); it converges quadratically, so that the error left
   !> is of the order of its square
   real(dp), parameter :: ratio_tolerance = 1.0e-9_dp
   integer, parameter :: max_iterations = 20

contains

   !> `1/E* = (1-nu^2)/E + (1-nub^2)/Eb`.
   pure real(dp) function effective_modulus(young, poisson) result(modulus)
      !> Young's moduli (2) [Pa] and Poisson's ratios (2) [-]: barred, unbarred
      real(dp), intent(in) :: young(2), poisson(2)

      modulus = 1/((1 - poisson(1)**2)/young(1) + (1 - poisson(2)**2)/young(2))
   end function effective_modulus

   !> Ratio and coefficients of the ellipse, and their derivatives with respect to the angle.
   pure subroutine hertz_ellipse(radius, young, poisson, angle, ellipse, info, is_round)
      !> Wire radii (2) [m]: barred, unbarred
      real(dp), intent(in) :: radius(2)
      !> Young's moduli (2) [Pa] and Poisson's ratios (2) [-]: barred, unbarred
      real(dp), intent(in) :: young(2), poisson(2)
      !> Angle between the tangents [rad], in (0, pi)
      real(dp), intent(in) :: angle
      type(hertz_ellipse_t), intent(out) :: ellipse
      !> `hertz_ok` or `hertz_parallel`
      integer, intent(out) :: info
      !> Which wires touch with their round ends (2); absent: none
      logical, intent(in), optional :: is_round(2)
      type(elliptic_t) :: f
      real(dp) :: mean_curvature, product, q, c, dc_dangle, a_curvature, log_slope, dratio_dc, dlog_major_dc, ca
      real(dp) :: dapproach_dc, d2approach_dc2

      info = hertz_parallel
      if (present(is_round)) then
         call curvatures_of_ends(radius, angle, is_round, mean_curvature, product, q, c)
      else
         ! c = (B-A)/(A+B) and q = 1 - c^2 = 4 A B/(A+B)^2, each without a cancellation
         product = 4*radius(1)*radius(2)/sum(radius)**2
         q = product*sin(angle)**2
         c = sqrt(((radius(1) - radius(2))/sum(radius))**2 + product*cos(angle)**2)
         mean_curvature = (1/radius(1) + 1/radius(2))/2                                                    ! A + B
      end if
      if (.not. q > tiny(q)) return
      info = hertz_ok
      ellipse%angle = angle
      a_curvature = mean_curvature*q/(2*(1 + c))                                                           ! A
      ellipse%modulus = effective_modulus(young, poisson)

      call solve_ratio(q, c, ellipse%ratio, log_slope, f)
      ca = (3*f%d/(2*pi*a_curvature*ellipse%modulus))**(1.0_dp/3)               ! a^3 = 3F(K-E)/(2 pi m A E*)
      ellipse%semi_major = ca
      ellipse%approach = 3*f%k/(2*pi*ca*ellipse%modulus)                        ! delta = 3F K/(2 pi a E*)

      dratio_dc = -2/(q*log_slope)                                              ! d log(b/a)/dc
      dlog_major_dc = ((f%c/f%d - 1)*dratio_dc + 1/(1 - c))/3                   ! d log(a)/dc
      ! The complementary energy (3/5) F delta is stationary in the ellipse, so only the curvatures vary:
      ! (3/5) F d(delta) = F <x^2> dA + F <y^2> dB, with the mean squares a^2/5 and b^2/5 of Hertz's pressure
      dapproach_dc = -mean_curvature*ca**2*f%m/6
      d2approach_dc2 = -mean_curvature*ca**2*(f%m*dlog_major_dc - f%m1*dratio_dc)/3
      ! c = 0 needs equal wires at 90 degrees, where everything that is returned is stationary
      ellipse%d2approach_dangle2 = d2approach_dc2*product
      if (c <= 0) return
      dc_dangle = -product*sin(angle)*cos(angle)/c
      ellipse%dlog_area_dangle = (2*dlog_major_dc + dratio_dc)*dc_dangle
      ellipse%dlog_ratio_dangle = dratio_dc*dc_dangle
      ellipse%dapproach_dangle = dapproach_dc*dc_dangle
      ! c^2 is linear in cos(2 angle): c'^2 + c c'' = -product cos(2 angle)
      ellipse%d2approach_dangle2 = d2approach_dc2*dc_dangle**2 &
         - dapproach_dc/c*(product*cos(2*angle) + dc_dangle**2)
   end subroutine hertz_ellipse

   !> Mean and difference of the curvatures of two wires that may touch with their round ends, by K. L. Johnson, Contact
   !> Mechanics, (4.4): each has `1/r` across and, where it is round, along its axis; `D` is the difference of the two.
   pure subroutine curvatures_of_ends(radius, angle, is_round, mean_curvature, product, q, c)
      !> Radii (2) [m] and angle [rad]
      real(dp), intent(in) :: radius(2), angle
      !> (2)
      logical, intent(in) :: is_round(2)
      !> A + B [1/m]; D1 D2/(A + B)^2; 4 A B/(A + B)^2 and (B - A)/(A + B), each without a cancellation
      real(dp), intent(out) :: mean_curvature, product, q, c
      real(dp) :: difference(2), along(2)

      along = merge(1/radius, 0.0_dp, is_round)
      difference = merge(0.0_dp, 1/radius, is_round)
      mean_curvature = sum(difference + 2*along)/2
      product = difference(1)*difference(2)/mean_curvature**2
      q = sum(along)*sum(difference + along)/mean_curvature**2 + product*sin(angle)**2
      c = sqrt(((difference(1) - difference(2))/(2*mean_curvature))**2 + product*cos(angle)**2)
   end subroutine curvatures_of_ends

   !> Where the ends of wires have a part of the force: the ellipse with that force at any overlap, whose ratio is the
   !> mean of those of cylinders and ends, and which has the axis that goes with both.
   pure subroutine hertz_near_ends(radius, young, poisson, angle, force_part, ellipse, info)
      !> As in `hertz_ellipse`
      real(dp), intent(in) :: radius(2), young(2), poisson(2), angle
      !> Parts of the forces that cylinders (index 1) and ends (2) would have alone, barred before unbarred wire (2, 2)
      real(dp), intent(in) :: force_part(2, 2)
      type(hertz_ellipse_t), intent(out) :: ellipse
      !> `hertz_ok` or `hertz_parallel`
      integer, intent(out) :: info
      type(hertz_ellipse_t) :: one
      type(elliptic_t) :: f
      logical :: is_round(2)
      real(dp) :: part, force, log_ratio, dforce, dratio
      integer :: i, j

      force = 0
      log_ratio = 0
      dforce = 0
      dratio = 0
      do j = 1, 2
         do i = 1, 2
            is_round = [i, j] == 2
            part = force_part(i, j)
            if (.not. abs(part) > 0) cycle
            call hertz_ellipse(radius, young, poisson, angle, one, info, is_round)
            if (info /= hertz_ok) return
            part = part/one%approach**1.5_dp                                    ! F = (delta/cd)^(3/2)
            force = force + part
            log_ratio = log_ratio + part*log(one%ratio)
            dforce = dforce - 1.5_dp*part*one%dapproach_dangle/one%approach
            dratio = dratio + part*(one%dlog_ratio_dangle &
               - 1.5_dp*one%dapproach_dangle/one%approach*log(one%ratio))
         end do
      end do
      info = hertz_parallel
      if (.not. force > 0) return
      info = hertz_ok
      ellipse%modulus = effective_modulus(young, poisson)
      ellipse%approach = force**(-2.0_dp/3)
      ellipse%dapproach_dangle = -2*ellipse%approach/(3*force)*dforce
      log_ratio = log_ratio/force
      dratio = dratio/force - log_ratio*dforce/force
      ellipse%ratio = exp(log_ratio)
      f = elliptic_integrals_complementary(ellipse%ratio**2)
      ellipse%semi_major = 3*f%k/(2*pi*ellipse%approach*ellipse%modulus)        ! delta = 3F K/(2 pi a E*)
      ellipse%dlog_ratio_dangle = dratio
      ! d log(K)/d log(b/a) = -B/K
      ellipse%dlog_area_dangle = dratio - 2*(f%b/f%k*dratio + ellipse%dapproach_dangle/ellipse%approach)
   end subroutine hertz_near_ends

   !> The ratio `b/a` from `B/A = (E - m1 K)/(m1 (K - E))`, with `m1 = (b/a)^2`.
   !>
   !> In logarithms, `log(A/B) = log(m1 D/B)` is an increasing, concave and almost straight function of `log(b/a)`: its
   !> slope `1 + C/D + m1 C/B` falls from 2 for a line to 3/2 for a circle. Newton's method therefore never passes the
   !> solution after its first step and needs no other safeguard.
   pure subroutine solve_ratio(q, c, ratio, slope, f)
      !> `4 A B/(A+B)^2` and `(B-A)/(A+B)`
      real(dp), intent(in) :: q, c
      !> b/a
      real(dp), intent(out) :: ratio
      !> d log(A/B)/d log(b/a), and the integrals, at the solution
      real(dp), intent(out) :: slope
      type(elliptic_t), intent(out) :: f
      real(dp) :: target_value, s, step
      integer :: iteration

      target_value = log(q) - 2*log(1 + c)                                      ! log(A/B) = log(q/(1+c)^2)
      s = start_of_ratio(target_value)
      do iteration = 1, max_iterations
         f = elliptic_integrals_complementary(exp(2*s))
         slope = 1 + f%c/f%d + f%m1*f%c/f%b
         step = (target_value - log(f%m1*f%d/f%b))/slope
         s = min(s + step, 0.0_dp)
         if (abs(step) <= ratio_tolerance) exit
      end do
      ratio = exp(s)
      f = elliptic_integrals_complementary(ratio**2)
      slope = 1 + f%c/f%d + f%m1*f%c/f%b
   end subroutine solve_ratio

   !> `A/B = (b/a)^(3/2)` of a nearly round spot, or the asymptote `(b/a)^2 (log(4 a/b) - 1)` of a slender one, solved
   !> roughly.
   pure real(dp) function start_of_ratio(target_value) result(s)
      !> log(A/B), not positive
      real(dp), intent(in) :: target_value

      s = 2*target_value/3
      if (s < -1) s = (target_value - log(log(4.0_dp) - s - 1))/2
   end function start_of_ratio

end module litz_hertz
