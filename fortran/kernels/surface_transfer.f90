!> Current and heat from an element into a surface that has one potential and one temperature.
!>
!> Unknowns and equations stand node by node, potential before temperature: both nodes of the element, and the reference
!> node of the surface. Along the element both are linear. The heat of the current enters wire and surface, half and
!> half.
!> Source: theory section 12.
module litz_surface_transfer
   use litz_kinds, only: dp
   implicit none
   private
   public :: surface_transfer, n_transfer

   !> Unknowns
   integer, parameter :: n_transfer = 6

contains

   !> Currents and heat flows that leave the nodes, and their derivatives.
   pure subroutine surface_transfer(xi, conductance, potential, temperature, k, r, by_conductance, &
      by_place, joule_heat)
      !> Places in the element, and conductances there, of electricity and of heat (n, 2) [S, W/K]
      real(dp), intent(in) :: xi(:), conductance(:, :)
      !> Of the nodes (3) [V], [K]
      real(dp), intent(in) :: potential(3), temperature(3)
      !> Tangent (6, 6), and currents and heat flows that leave the nodes (6) [A, W]
      real(dp), intent(out) :: k(n_transfer, n_transfer), r(n_transfer)
      !> Derivatives of these by the conductances of each place (6, n, 2) [V, V^2; K]
      real(dp), intent(out) :: by_conductance(:, :, :)
      !> And by the places, at the same conductances (6, n) [A, W]
      real(dp), intent(out) :: by_place(:, :)
      !> Of the current through the contact [W]
      real(dp), intent(out) :: joule_heat
      real(dp) :: b(3), drop, fall, ddrop, dfall
      real(dp), parameter :: db(3) = [-0.5_dp, 0.5_dp, 0.0_dp]
      integer :: i

      k = 0
      r = 0
      by_conductance = 0
      joule_heat = 0
      do i = 1, size(xi)
         b = [(1 - xi(i))/2, (1 + xi(i))/2, -1.0_dp]
         drop = dot_product(b, potential)
         fall = dot_product(b, temperature)
         ddrop = dot_product(db, potential)
         dfall = dot_product(db, temperature)
         associate (of_current => by_conductance(:, i, 1), of_heat => by_conductance(:, i, 2), &
            g => conductance(i, 1), h => conductance(i, 2))
            of_current(1::2) = drop*b                                     ! I = G (N V - V_s)
            of_current(2::2) = -drop**2/2*abs(b)                          ! G (N V - V_s)^2, half and half
            of_heat(2::2) = fall*b                                        ! Q = H (N T - T_s)
            r = r + g*of_current + h*of_heat
            joule_heat = joule_heat + g*drop**2
            by_place(1::2, i) = g*(ddrop*b + drop*db)
            by_place(2::2, i) = h*(dfall*b + fall*db) - g*drop*(ddrop*abs(b) + drop*db/2)
            k(1::2, 1::2) = k(1::2, 1::2) + g*outer(b, b)
            k(2::2, 1::2) = k(2::2, 1::2) - g*drop*outer(abs(b), b)
            k(2::2, 2::2) = k(2::2, 2::2) + h*outer(b, b)
         end associate
      end do
   end subroutine surface_transfer

   pure function outer(a, b)
      !> (3), (3)
      real(dp), intent(in) :: a(3), b(3)
      real(dp) :: outer(3, 3)

      outer = spread(a, 2, 3)*spread(b, 1, 3)
   end function outer

end module litz_surface_transfer
