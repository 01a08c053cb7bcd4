!> Heat that a wire radiates from its side, half of it from either node.
!>
!>     R = eps sigma P l/2 ((T - T0)^4 - (Ts - T0)^4)                                                               (1)
!>
!> at each node, with the absolute zero `T0` of the temperature scale. Lumped, so that no temperature leaves the range
!> of those around it on any mesh. Source: Stefan-Boltzmann; theory section 13.
module litz_wire_surface
   use litz_kinds, only: dp
   implicit none
   private
   public :: wire_radiation

contains

   !> Residual of the two nodes, and the diagonal of its tangent.
   pure subroutine wire_radiation(temperature, coefficient, surroundings, absolute_zero, k, r, info)
      !> Of the nodes (2) [K]
      real(dp), intent(in) :: temperature(2)
      !> eps sigma P l [W/K^4]; temperature of the surroundings, and absolute zero [K]
      real(dp), intent(in) :: coefficient, surroundings, absolute_zero
      !> Derivatives of `r` by the temperatures (2) [W/K]
      real(dp), intent(out) :: k(2)
      !> Heat that leaves the nodes (2) [W]
      real(dp), intent(out) :: r(2)
      !> 0, or -1: a temperature below absolute zero
      integer, intent(out) :: info
      real(dp), dimension(2) :: t
      real(dp) :: s

      k = 0
      r = 0
      info = -1
      t = temperature - absolute_zero
      s = surroundings - absolute_zero
      if (.not. (all(t >= 0) .and. s >= 0)) return
      info = 0
      r = coefficient/2*(t**2 + s**2)*(t + s)*(temperature - surroundings)                                   ! (1)
      k = 2*coefficient*t**3
   end subroutine wire_radiation

end module litz_wire_surface
