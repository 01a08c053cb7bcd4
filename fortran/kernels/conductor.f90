!> Two-node conductor of constant cross-section with linear voltage.
!>
!>     I = (A/(rho l)) (V1 - V2),   R = (A/(rho l)) [1 -1; -1 1] V                                               (1)
!>
!> `l` is the reference length (small strains) or, as an option, the current distance of the nodes; the area stays.
module litz_conductor
   use litz_kinds, only: dp
   implicit none
   private
   public :: conductor

contains

   !> Residual, tangent, current and heat of a conductor. Source: (1); the heat is `I (V1 - V2)`.
   pure subroutine conductor(x, v, length, area, resistivity, current_length, k, r, k_me, current, heat)
      !> Nodal positions (3, node) [m]
      real(dp), intent(in) :: x(3, 2)
      !> Nodal potentials (2) [V]
      real(dp), intent(in) :: v(2)
      !> Reference length [m], cross-section [m^2], resistivity [ohm m]
      real(dp), intent(in) :: length, area, resistivity
      !> Whether the length is the current distance of the nodes
      logical, intent(in) :: current_length
      !> Derivative of `r` by the potentials (2, 2) [1/ohm]; symmetric
      real(dp), intent(out) :: k(2, 2)
      !> Currents leaving the nodes (2) [A]
      real(dp), intent(out) :: r(2)
      !> Derivative of `r` by the positions, node 1 then node 2 (2, 6) [A/m]; zero with the reference length
      real(dp), intent(out) :: k_me(2, 6)
      !> Current from the first to the second node [A] and heat [W]
      real(dp), intent(out) :: current, heat
      real(dp) :: l, conductance, current_by_l(3)

      l = length
      if (current_length) l = norm2(x(:, 2) - x(:, 1))
      conductance = area/(resistivity*l)
      current = conductance*(v(1) - v(2))                                                                     ! (1)
      heat = current*(v(1) - v(2))
      r = [current, -current]
      k = conductance*reshape([1.0_dp, -1.0_dp, -1.0_dp, 1.0_dp], [2, 2])

      k_me = 0
      if (current_length) then
         current_by_l = -current/l*(x(:, 2) - x(:, 1))/l
         k_me(1, :) = [-current_by_l, current_by_l]
         k_me(2, :) = -k_me(1, :)
      end if
   end subroutine conductor

end module litz_conductor
