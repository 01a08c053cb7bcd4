!> The law of crossed wires that yield per length of the lens in which they overlap.
!>
!> Source: theory section 15. What a crossing has at the overlap `delta` of its deepest place is the integral over the
!> lens, `sqrt(2 d)/s int_0^delta q(z)/sqrt(delta - z) dz`, of what its places have at theirs. Abel's inversion finds
!> `q`: of the force, of the stiffness of the metal around, which stays elastic, and of the area of the spot. Below the
!> onset the first goes with `zeta = z/delta_Y`, the second is even, the third goes with the root of `zeta`; beyond, all
!> are integrals of slopes of the crossing over `omega = zeta cos^2 theta`.
module litz_yielding_profile
   use litz_kinds, only: dp, pi
   use litz_yielding_spot, only: yielding_t
   implicit none
   private
   public :: profile_t, profile_at, profile_of_force

   !> Newton stops at this relative change; the error left is of the order of its square
   real(dp), parameter :: step_tolerance = 1.0e-9_dp
   integer, parameter :: max_iterations = 60
   !> Gauss points in (-1, 1) and their weights, the positive half of them
   integer, parameter :: n_half = 8
   real(dp), parameter :: half_places(n_half) = [0.09501250983763744_dp, 0.28160355077925892_dp, &
      0.45801677765722737_dp, 0.61787624440264377_dp, 0.75540440835500300_dp, 0.86563120238783176_dp, &
      0.94457502307323260_dp, 0.98940093499164994_dp]
   real(dp), parameter :: half_weights(n_half) = [0.18945061045506864_dp, 0.18260341504492364_dp, &
      0.16915651939500265_dp, 0.14959598881657671_dp, 0.12462897125553407_dp, 0.09515851168249261_dp, &
      0.06225352393864746_dp, 0.02715245941175418_dp]
   real(dp), parameter :: places(2*n_half) = [-half_places, half_places]
   real(dp), parameter :: weights(2*n_half) = [half_weights, half_weights]

   !> At a place; the derivatives are those by `zeta`.
   type :: profile_t
      !> Overlap over that at which the crossing begins to yield
      real(dp) :: zeta = 0
      !> Force per length over that of an elastic lens at the onset
      real(dp) :: force = 0, dforce = 1
      !> Stiffness of the metal around over that of an elastic lens
      real(dp) :: elastic = 1, delastic = 0
      !> Width of the spot over that at the onset
      real(dp) :: width = 0, dwidth = 0
   end type profile_t

   !> Slopes of the crossing at an overlap `omega`, all of them over those at the onset: of the force, of the root of
   !> the area and of the area, each with its own slope.
   type :: slopes_t
      real(dp) :: force = 0, dforce = 0, root = 0, droot = 0, area = 0, darea = 0
   end type slopes_t

contains

   !> The place that has this force per length. As the force is concave over the overlap, Newton's method comes to it
   !> from below, from its second place on.
   pure type(profile_t) function profile_of_force(law, force) result(profile)
      type(yielding_t), intent(in) :: law
      !> Over that of an elastic lens at the onset, positive
      real(dp), intent(in) :: force
      real(dp) :: zeta, step
      integer :: i

      ! f goes with zeta up to the onset, and about with zeta^(5/6) beyond
      zeta = max(force, force**1.2_dp)
      do i = 1, max_iterations
         profile = profile_at(law, zeta)
         step = (force - profile%force)/profile%dforce
         zeta = zeta + step
         if (abs(step) <= step_tolerance*zeta) exit
      end do
      profile = profile_at(law, zeta)
      profile%force = force
   end function profile_of_force

   !> The place at an overlap (15.19), (15.20).
   pure type(profile_t) function profile_at(law, zeta) result(profile)
      type(yielding_t), intent(in) :: law
      !> Positive
      real(dp), intent(in) :: zeta
      real(dp) :: onset, plastic, root, angle
      type(slopes_t) :: mean

      root = sqrt(zeta)
      profile%zeta = zeta
      onset = 0
      if (zeta > 1) onset = acos(1/root)
      plastic = 0
      if (zeta > law%steepness**3) plastic = acos(law%steepness**1.5_dp/root)
      ! the part of the integrals in which the crossing is elastic
      angle = pi/2 - onset
      mean%force = 0.75_dp*root*(angle - sin(onset)*cos(onset))
      mean%dforce = 0.375_dp/root*(angle - sin(onset)*cos(onset))
      mean%root = angle/(2*root)
      mean%droot = -angle/(4*root*zeta)
      mean%area = 1 - sin(onset)
      if (onset > plastic) call add_part(law, zeta, plastic, onset, mean)
      if (plastic > 0) call add_part(law, zeta, 0.0_dp, plastic, mean)

      profile%force = 8*root/(3*pi)*mean%force
      profile%dforce = profile%force/(2*zeta) + 8*root/(3*pi)*mean%dforce
      profile%elastic = 4*root/pi*mean%root
      profile%delastic = profile%elastic/(2*zeta) + 4*root/pi*mean%droot
      profile%width = root*mean%area
      profile%dwidth = profile%width/(2*zeta) + root*mean%darea
   end function profile_at

   !> Integrals over `sin theta`, those of the second slopes times `cos^2 theta`.
   pure subroutine add_part(law, zeta, from, to, mean)
      type(yielding_t), intent(in) :: law
      !> Overlap, and bounds of theta [rad]
      real(dp), intent(in) :: zeta, from, to
      type(slopes_t), intent(inout) :: mean
      type(slopes_t) :: at
      real(dp) :: c, weight
      integer :: i

      do i = 1, size(places)
         c = cos((from + to)/2 + (to - from)/2*places(i))
         weight = (to - from)/2*weights(i)*c
         at = slopes_at(law, zeta*c**2)
         mean%force = mean%force + weight*at%force
         mean%root = mean%root + weight*at%root
         mean%area = mean%area + weight*at%area
         mean%dforce = mean%dforce + weight*c**2*at%dforce
         mean%droot = mean%droot + weight*c**2*at%droot
         mean%darea = mean%darea + weight*c**2*at%darea
      end do
   end subroutine add_part

   !> Slopes of (15.2) and (15.3) beyond the onset.
   pure type(slopes_t) function slopes_at(law, omega) result(slopes)
      type(yielding_t), intent(in) :: law
      !> delta/delta_Y, at least 1
      real(dp), intent(in) :: omega
      real(dp) :: force, middle, root, power, area, n

      associate (h => law%steepness, s => law%exponent)
         n = 1 - s
         middle = min(omega, h**3)
         root = middle**(1.0_dp/3)
         slopes%force = 1.5_dp*root
         if (omega <= h**3) slopes%dforce = slopes%force/(3*omega)
         force = 1 + 1.125_dp*(middle*root - 1)
         power = force**(-s)
         area = 1 + 2*(power*force - 1)/(3*n)
         slopes%area = 2*power*slopes%force/3
         if (omega <= h**3) then
            slopes%darea = 2*power/3*(slopes%dforce - s*slopes%force**2/force)
         else
            area = area + slopes%area*(omega - h**3)
         end if
      end associate
      slopes%root = slopes%area/(2*sqrt(area))
      slopes%droot = slopes%darea/(2*sqrt(area)) - slopes%area**2/(4*area*sqrt(area))
   end function slopes_at

end module litz_yielding_profile
