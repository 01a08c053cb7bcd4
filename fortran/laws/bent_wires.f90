!> Wires that are bent where they cross, as straight ones whose surfaces part as theirs do.
!>
!> At a crossing the surface of a bent wire has the curvature `c = k/(1 + k r)` along its axis, with the curvature k of
!> that away from the other wire. Contact by Hertz depends on the sum and the product of the principal curvatures of the
!> gap, which are those of straight wires of the radii r/m that cross at the angle with the sine s; where s would be
!> above 1, those of two wires of the radius 2/(m (1/r + 1/rb)).
!>
!> Source: theory (10.14a).
module litz_bent_wires
   use litz_kinds, only: dp
   implicit none
   private
   public :: bends_t, bent_crossing_t, bent_crossing

   !> Wires that are bent about each other more than this, in 1/r, count as bent by it
   real(dp), parameter :: most_about = 0.25_dp
   !> The square of the sine over that of straight wires is at least this; from twice as much on it is as it is
   real(dp), parameter :: least_part = 0.01_dp
   !> Below this cosine the angle of the straight wires is a right one
   real(dp), parameter :: no_cosine = 1.0e-6_dp
   !> Square of a cosine that is no more than the round-off of straight wires at right angles
   real(dp), parameter :: round_off = 1.0e-9_dp

   !> Of a contact; within an iteration it stays.
   type :: bends_t
      logical :: are_known = .false.
      !> The law takes two wires of the same radius
      logical :: as_equal = .false.
      !> Curvatures of the axes away from each other that the law of the contact sees (2) [1/m], the mean curvature of
      !> the gap over that of straight wires, and how the energy changes with the curvatures (2) [J m]
      real(dp) :: curvature(2) = 0, ratio = 1, by_curvature(2) = 0
      !> Curvatures by which the length of the overlap is told (2) [1/m]: at kinks and of every law, too
      real(dp) :: of_axes(2) = 0
   end type bends_t

   type :: bent_crossing_t
      !> As round a contact as no straight wires of these radii have: those of the radius of a wire of the same mean
      !> curvature do, `2/(1/r + 1/rb)`
      logical :: as_equal = .false.
      !> Mean curvature of the gap over that of straight wires, m, and the sine s
      real(dp) :: ratio = 1, sine = 0
      !> First and second derivative by the angle of the axes, of the angle with this sine, which is at most a right one
      real(dp) :: slope = 1, curvature = 0
      !> Derivatives of both by the curvatures of the two axes (2) [m]
      real(dp) :: dratio(2) = 0, dsine(2) = 0
   end type bent_crossing_t

contains

   !> The straight wires that stand for two bent ones.
   pure type(bent_crossing_t) function bent_crossing(radius, curvature, angle) result(straight)
      !> Radii (2) [m], and curvatures of the axes away from each other (2) [1/m]
      real(dp), intent(in) :: radius(2), curvature(2)
      !> Between the axes [rad]
      real(dp), intent(in) :: angle
      real(dp) :: c(2), dc(2), bend(2), mean, alpha, beta, part, second, cosine, square_of_cosine, of_equal

      bend = max(curvature*radius, -most_about)
      c = bend/((1 + bend)*radius)
      dc = merge(1/(1 + bend)**2, 0.0_dp, curvature*radius > -most_about)
      mean = product(radius)/sum(radius)
      associate (m => straight%ratio, s => straight%sine)
         m = 1 + mean*sum(c)
         straight%dratio = mean*dc
         ! s^2 = (alpha + beta sin^2(psi))/m^2
         alpha = sum(radius)*sum(c)
         beta = product(1 - c*radius)
         part = 1
         if (sin(angle) > 0) part = (alpha/sin(angle)**2 + beta)/m**2
         s = sin(angle)*sqrt(floored(part))
         ! of m^2 - alpha - beta, without loss of digits
         square_of_cosine = ((radius(1) - radius(2))*(c(1)*radius(2) - c(2)*radius(1))/sum(radius) + (mean*sum(c))**2 &
            - product(c*radius) + beta*cos(angle)**2)/m**2
         if (s > 0) straight%dsine = slope_of_floored(part)*((sum(radius) - radius*(1 - c([2, 1]) &
            *radius([2, 1]))*sin(angle)**2)*dc/m**2 - 2*part*sin(angle)**2/m*straight%dratio)/(2*s)
         ! d(s^2)/d(sin^2(psi)), and twice its derivative by psi
         second = 0
         beta = beta/m**2
         if (part < 2*least_part) then
            square_of_cosine = 1 - s**2
            if (part > 0) second = (beta - part)**2*cos(angle)**2/least_part
            beta = floored(part) + slope_of_floored(part)*(beta - part)
         end if
         straight%slope = 0
         if (.not. s > 0) return
         if (square_of_cosine < -round_off) then
            straight%as_equal = .true.
            ! B - A = (A + B) cos(theta) of straight wires of the same radius, and of others
            of_equal = 4*product(radius)/sum(radius)**2
            s = sqrt(of_equal)*s
            straight%dsine = sqrt(of_equal)*straight%dsine
            beta = of_equal*beta
            square_of_cosine = max(0.0_dp, 1 - of_equal + of_equal*square_of_cosine)
         end if
         s = min(1.0_dp, s)
         cosine = sqrt(max(0.0_dp, square_of_cosine))
         ! cos(theta) theta' = s', and again
         if (cosine > no_cosine) then
            straight%slope = beta*sin(angle)*cos(angle)/(s*cosine)
            straight%curvature = (beta*cos(2*angle) + second - straight%slope**2*(1 - 2*s**2))/(s*cosine)
         else
            straight%slope = sign(sqrt(beta), cos(angle))
         end if
      end associate
   end function bent_crossing

   !> The square of a sine over that of straight wires, but never below the least: `u`, from `2 a` down `a + u^2/(4 a)`,
   !> from 0 down `a`.
   pure real(dp) function floored(part)
      !> u, of any sign [-]
      real(dp), intent(in) :: part

      floored = part
      if (part < 2*least_part) floored = least_part + max(0.0_dp, part)**2/(4*least_part)
   end function floored

   pure real(dp) function slope_of_floored(part)
      !> u [-]
      real(dp), intent(in) :: part

      slope_of_floored = max(0.0_dp, min(1.0_dp, part/(2*least_part)))
   end function slope_of_floored

end module litz_bent_wires
