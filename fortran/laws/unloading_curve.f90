!> How a spot of metal that has yielded opens: the half-space under a pressure between Hertz's and an even one, as a
!> superposition of flat punches.
!>
!> Source: theory (15.5) to (15.8). All is in parts of what the largest force has made; `lambda` are the half axes of
!> what is left of the spot, `s = sqrt(1 - lambda^2)`, and `phi` says how even the pressure was.
module litz_unloading_curve
   use litz_kinds, only: dp, pi
   implicit none
   private
   public :: unloaded_depth, opening_of_rise, opening_of_force, relative_unloading, returned_parts, segment

   !> Below this lambda the area of the segment comes from its series, whose terms fall with lambda^2
   real(dp), parameter :: small_opening = 0.3_dp
   integer, parameter :: max_terms = 20
   !> Newton stops at this relative change of the overlap; the error left is of the order of its square
   real(dp), parameter :: step_tolerance = 1.0e-9_dp
   integer, parameter :: max_iterations = 20

contains

   !> `(delta_m - delta) E* a_e/F_m` at `s = sqrt(1 - lambda^2)` (15.5).
   pure real(dp) function unloaded_depth(phi, s) result(drop)
      !> phi and s [-]
      real(dp), intent(in) :: phi, s

      drop = (0.75_dp*(1 - phi)*s + 2*phi/pi)*s
   end function unloaded_depth

   !> lambda and s from the distances to both ends of the branch, the smaller of which counts.
   pure subroutine opening_of_rise(phi, rise, drop, lambda, s)
      !> phi; (delta - delta_res) E* a_e/F_m, and the same of delta_m - delta
      real(dp), intent(in) :: phi, rise, drop
      !> [-]
      real(dp), intent(out) :: lambda, s
      real(dp) :: q, t

      q = 2*phi/pi
      if (drop < rise) then
         s = min(2*drop/(q + sqrt(q**2 + 3*(1 - phi)*drop)), 1.0_dp)
         t = 1 - s
      else
         associate (b => 1.5_dp*(1 - phi) + q)
            t = 2*rise/(b + sqrt(max(b**2 - 3*(1 - phi)*rise, 0.0_dp)))
         end associate
         s = 1 - t
      end if
      lambda = sqrt(t*(1 + s))
   end subroutine opening_of_rise

   !> lambda and s at F/F_m on the way back.
   !>
   !> `(F/F_m)^(2/3)` is an increasing, concave and almost straight function of the overlap beyond the dent, straight
   !> where the pressure is that of Hertz: Newton's method never passes the solution after its first step and needs no
   !> safeguard.
   pure subroutine opening_of_force(phi, share, lambda, s)
      !> phi, and F/F_m
      real(dp), intent(in) :: phi, share
      !> [-]
      real(dp), intent(out) :: lambda, s
      real(dp) :: whole, rise, target_value, value, step
      integer :: iteration

      lambda = 0
      s = 1
      if (.not. share > 0) return
      whole = unloaded_depth(phi, 1.0_dp)
      target_value = share**(2.0_dp/3)
      rise = whole*target_value
      do iteration = 1, max_iterations
         call opening_of_rise(phi, rise, whole - rise, lambda, s)
         value = relative_unloading(phi, lambda, s)
         ! d(F/F_m)/d(rise) = 2 lambda
         step = (target_value*value**(1.0_dp/3) - value)*1.5_dp/(2*lambda)
         rise = min(rise + step, whole)
         if (abs(step) <= step_tolerance*rise) exit
      end do
      call opening_of_rise(phi, rise, whole - rise, lambda, s)
   end subroutine opening_of_force

   !> F/F_m on the way back (15.6).
   pure real(dp) function relative_unloading(phi, lambda, s) result(share)
      !> phi, lambda and sqrt(1 - lambda^2) [-]
      real(dp), intent(in) :: phi, lambda, s

      share = (1 - phi)*lambda**3 + 2*phi/pi*segment(lambda, s)
   end function relative_unloading

   !> What comes back of Hertz's pressure, of it with an even one, and of the even one alone (15.8).
   pure function returned_parts(lambda, s) result(parts)
      !> lambda and sqrt(1 - lambda^2) [-]
      real(dp), intent(in) :: lambda, s
      real(dp) :: parts(3), area

      area = segment(lambda, s)
      parts = [0.6_dp*lambda**5, (3*area*(lambda**2 - 0.25_dp) + lambda**3*s/2)/pi, &
         8*(2*lambda**3/3 - area*s)/pi**2]
   end function returned_parts

   !> `asin(lambda) - lambda sqrt(1 - lambda^2)`, which is `2 lambda^3/3` and more: the integral of
   !> `2 lambda^2/sqrt(1 - lambda^2)`.
   pure real(dp) function segment(lambda, s)
      !> lambda and sqrt(1 - lambda^2) [-]
      real(dp), intent(in) :: lambda, s
      real(dp) :: term
      integer :: n

      if (lambda >= small_opening) then
         segment = atan2(lambda, s) - lambda*s
         return
      end if
      term = 2*lambda**3
      segment = term/3
      do n = 1, max_terms
         term = term*lambda**2*(2*n - 1)/(2*n)
         segment = segment + term/(2*n + 3)
      end do
   end function segment

end module litz_unloading_curve
