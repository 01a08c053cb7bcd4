!> Two-node conductor that has superconducting filaments: its current is an unknown of its own, and the law gives the
!> voltage that it needs.
!>
!>     U(I) = l [E(I/A) + rho_0 I/A]                                                                                 (1)
!>     I* = I + (V1 - V2 - U)/U'                                                                                     (2)
!>
!> `E(J)` is the law of filaments and metal in parallel, whose slope vanishes with the current: `rho_0`, a small part of
!> the resistivity of the metal, keeps the conductance `1/U'` finite. (2), linear in the potentials, is the current that
!> enters the balance of the nodes; with the solution of these equations `I` becomes `I*`. The voltage grows with a high
!> power of the current and would overflow where the current is far off, so the move has the bounds of `moved_current`.
!>
!> Source: theory section 18.
module litz_superconductor
   use litz_kinds, only: dp
   use litz_critical_law, only: superconductor_t, critical_density, critical_density_t
   use litz_parallel_law, only: parallel_law_t, parallel_field_t, field_of_current, current_of_field
   implicit none
   private
   public :: superconductor_flow_t, superconductor_wire_t, superconductor, current_at, moved_current, &
      wire_of_material, series_part, critical_density_t

   !> rho_0 over the resistivity of the metal
   real(dp), parameter :: series_part = 1.0e-9_dp
   !> Above this part of the critical current, more than the linear step is checked with the law
   real(dp), parameter :: beyond = 1.5_dp
   !> Newton's steps to a current, from above; each goes down by a part of 1/n at least until `rho_0` counts no more
   integer, parameter :: max_steps = 1000
   real(dp), parameter :: accurate = 8*epsilon(1.0_dp)

   !> An element, and its material at its temperature, flux density and strain.
   type :: superconductor_wire_t
      !> l [m], A [m^2]
      real(dp) :: length = 0, area = 0
      !> Of the metal by itself [ohm m]
      real(dp) :: resistivity = 0
      type(parallel_law_t) :: law
   end type superconductor_wire_t

   !> The current at given potentials, to first order.
   type :: superconductor_flow_t
      !> I* [A]
      real(dp) :: current = 0
      !> Derivatives of I* by V1 - V2 [S], by l [A/m], by the metal's resistivity [A/(ohm m)] at a given conductivity
      !> of the law, by that conductivity [A m/S] and by the critical current density [m^2]
      real(dp) :: by_voltage = 0, by_length = 0, by_resistivity = 0, by_conductivity = 0, by_critical = 0
      !> E(I/A) [V/m], and U(I) [V]
      real(dp) :: field = 0, drop = 0
   end type superconductor_flow_t

contains

   !> The law of an element, and its critical current density.
   pure subroutine wire_of_material(material, temperature, flux_density, strain, wire, critical)
      type(superconductor_t), intent(in) :: material
      !> From absolute zero [K], [T], axial strain of the beam [-]
      real(dp), intent(in) :: temperature, flux_density, strain
      !> Length, area and resistivity are given
      type(superconductor_wire_t), intent(inout) :: wire
      type(critical_density_t), intent(out) :: critical

      critical = critical_density(material, temperature, flux_density, material%strain + strain)
      wire%law = parallel_law_t((1 - material%fraction)/wire%resistivity, material%fraction*critical%value, &
         material%criterion, material%exponent)
   end subroutine wire_of_material

   !> Source: (1), (2).
   pure type(superconductor_flow_t) function superconductor(wire, current, voltage, round_off) result(flow)
      type(superconductor_wire_t), intent(in) :: wire
      !> I [A]
      real(dp), intent(in) :: current
      !> V1 - V2, and by how much it may be wrong [V]
      real(dp), intent(in) :: voltage, round_off
      type(parallel_field_t) :: field
      real(dp) :: density, series, excess

      density = current/wire%area
      series = series_part*wire%resistivity
      field = field_of_current(wire%law, density)
      flow%field = field%value
      flow%drop = wire%length*(field%value + series*density)
      flow%by_voltage = wire%area/(wire%length*(field%by_current + series))
      excess = voltage - flow%drop
      ! what cannot be told from round-off
      if (abs(excess) <= round_off) excess = 0
      flow%current = current + excess*flow%by_voltage
      flow%by_length = -flow%by_voltage*flow%drop/wire%length
      flow%by_resistivity = -flow%by_voltage*wire%length*series_part*density
      flow%by_conductivity = -flow%by_voltage*wire%length*field%by_conductivity
      flow%by_critical = -flow%by_voltage*wire%length*field%by_critical
   end function superconductor

   !> The current at a voltage: the inverse of (1), by Newton's method from the law without `rho_0`.
   pure real(dp) function current_at(wire, voltage) result(current)
      type(superconductor_wire_t), intent(in) :: wire
      !> V1 - V2 [V]
      real(dp), intent(in) :: voltage
      type(superconductor_flow_t) :: flow
      integer :: i

      ! U is convex and odd: the steps descend from there
      current = wire%area*current_of_field(wire%law, voltage/wire%length)
      do i = 1, max_steps
         flow = superconductor(wire, current, voltage, 0.0_dp)
         if (abs(flow%current - current) <= accurate*abs(current)) return
         current = flow%current
      end do
   end function current_at

   !> The current with which the next iteration begins.
   !>
   !> Where a source drives the current it is the linear step, which the balance of the nodes demands; where a voltage
   !> drives it, it is that of the law at this voltage. The latter bounds a step from below to far above the critical
   !> current, and replaces one that goes down to a voltage between zero and the present one.
   pure real(dp) function moved_current(wire, current, linear, drop, voltage) result(moved)
      type(superconductor_wire_t), intent(in) :: wire
      !> I; I* at the new potentials [A]
      real(dp), intent(in) :: current, linear
      !> U(I) [V]
      real(dp), intent(in) :: drop
      !> V1 - V2 at the new potentials [V]
      real(dp), intent(in) :: voltage
      real(dp) :: at_voltage, bound

      moved = linear
      at_voltage = wire%area*current_of_field(wire%law, voltage/wire%length)
      bound = max(beyond*wire%area*wire%law%critical, abs(current), abs(at_voltage))
      if (abs(linear) > bound) then
         moved = sign(bound, linear)
      else if (voltage*drop > 0 .and. abs(voltage) < abs(drop) .and. abs(linear) > abs(at_voltage) &
         .and. linear*current > 0 .and. abs(linear) < abs(current)) then
         moved = at_voltage
      end if
   end function moved_current

end module litz_superconductor
