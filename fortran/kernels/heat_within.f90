!> How the temperature within an element follows heat that enters it, between nodes that stay.
!>
!> The rise in the middle by a constant heat is that of a steady state times
!>
!>     1 - sum 8/(pi k)^2 exp(-k^2 t/tau),   k = 1, 3, 5, ...,   tau = L^2/(pi^2 kappa)                              (1)
!>
!> The first term, the slow part, is taken as it is; all others as one, the fast part, with a time constant by which the
!> sum is within 0.025 of (1) at all times. Backward Euler over an increment. Source: theory section 13.
module litz_heat_within
   use litz_kinds, only: dp, pi
   implicit none
   private
   public :: part_reached, slow_and_fast

   !> What the slow and the fast part have of the rise
   real(dp), parameter :: slow_and_fast(2) = [8/pi**2, 1 - 8/pi**2]
   !> tau over their time constants
   real(dp), parameter :: speed(2) = [1.0_dp, 25.0_dp]

contains

   !> Parts of a steady state that an increment reaches, slow and fast (2).
   pure function part_reached(slowness) result(reached)
      !> tau over the increment
      real(dp), intent(in) :: slowness
      real(dp) :: reached(2)

      reached = speed/(speed + slowness)
   end function part_reached

end module litz_heat_within
