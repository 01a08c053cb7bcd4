!> Two-node conductor of electricity and heat, with a film on its side.
!>
!> Potential and temperature are unknown; `T_m` is the mean of the nodal temperatures, `dV = V1 - V2`:
!>
!>     G = A/(rho(T_m) l),  I = G dV,  R_V = I [1, -1]                                                              (1)
!>     R_T = lambda(T_m) A/(l t) (T1 - T2) [1, -1] + h P l t/4 (T1 + T2 - 2 Ts) [1, 1] - eta I dV t/2 [1, 1]       (2)
!>     t = tanh(w)/w,  w^2 = h P l^2/(4 lambda A)
!>
!> Other heat that enters evenly is like that of the current. Without a film `t = 1`. (2) is exact at the nodes for
!> constant properties: it is `sqrt(h P lambda A) [coth 2w, -1/sinh 2w]` with the heat `I dV` evenly along the element,
!> of which the film takes a part between the nodes. Heat is `I dV`, so that it sums up to the electric power to round-
!> off.
!> Source: theory section 13.
module litz_conductor_heat
   use litz_kinds, only: dp
   implicit none
   private
   public :: heated_wire_t, conductor_heat, heat_flows_t, nodal_share, film_number

   !> An element, its material at the mean temperature, and its film.
   type :: heated_wire_t
      !> Reference length [m] and cross-section [m^2]
      real(dp) :: length = 0, area = 0
      !> rho [ohm m], and its derivative by the temperature [ohm m/K]; 0: an insulator
      real(dp) :: resistivity = 0, dresistivity = 0
      !> The current is given to first order, in place of the resistivity: the current [A], its derivatives by V1 - V2
      !> [S] and by the temperature of either node [A/K]
      logical :: has_current = .false.
      real(dp) :: current = 0, by_voltage = 0, by_temperature = 0
      !> With has_current: the current of the iterate, an unknown by itself, with which a change of the voltage makes
      !> heat [A]
      real(dp) :: own = 0
      !> lambda [W/(m K)] and its derivative [W/(m K^2)]
      real(dp) :: conductivity = 0, dconductivity = 0
      !> eta: part of the electric power that becomes heat
      real(dp) :: heat_fraction = 1
      !> Other heat that enters evenly along the element [W]
      real(dp) :: source = 0
      !> h P [W/(m K)], and temperature of the surroundings Ts [K]
      real(dp) :: film = 0, sink = 0
   end type heated_wire_t

   !> What flows in an element.
   type :: heat_flows_t
      !> Current from the first to the second node [A], and Joule heat eta I dV [W]
      real(dp) :: current = 0, joule_heat = 0
      !> Through the film [W]
      real(dp) :: to_surroundings = 0
      !> t
      real(dp) :: nodal_share = 1
   end type heat_flows_t

   !> Below this `w^2` the slope of t comes from its series
   real(dp), parameter :: small = 1.0e-3_dp

contains

   !> Residual and tangent over `V1, V2, T1, T2`.
   pure subroutine conductor_heat(wire, v, temperature, k, r, flows)
      type(heated_wire_t), intent(in) :: wire
      !> Of the nodes (2) [V], (2) [K]
      real(dp), intent(in) :: v(2), temperature(2)
      !> (4, 4) [S, A/K, A, W/K]
      real(dp), intent(out) :: k(4, 4)
      !> Currents and heat that leave the nodes (4) [A, W]
      real(dp), intent(out) :: r(4)
      type(heat_flows_t), intent(out) :: flows
      real(dp) :: g, by_temperature, dv, t, dt, along, dalong, across, dacross, made, source, dsource(4), excess, drop
      real(dp) :: driven                                              ! with which a change of the voltage makes heat

      dv = v(1) - v(2)
      drop = temperature(1) - temperature(2)
      excess = temperature(1) - wire%sink + (temperature(2) - wire%sink)
      g = 0
      by_temperature = 0                                                         ! of either node
      flows%current = 0
      driven = 0
      if (wire%has_current) then
         flows%current = wire%current
         g = wire%by_voltage
         by_temperature = wire%by_temperature
         driven = wire%own
      else if (wire%resistivity > 0) then
         g = wire%area/(wire%resistivity*wire%length)
         flows%current = g*dv                                                                              ! (1)
         by_temperature = -flows%current*wire%dresistivity/(2*wire%resistivity)
         driven = flows%current
      end if
      flows%joule_heat = wire%heat_fraction*flows%current*dv

      call nodal_share(wire, t, dt)
      along = wire%conductivity*wire%area/(wire%length*t)
      dalong = along*(wire%dconductivity/(2*wire%conductivity) - dt/t)
      across = wire%film*wire%length/4*t
      dacross = wire%film*wire%length/4*dt
      made = flows%joule_heat + wire%source
      source = made*t/2
      dsource = [wire%heat_fraction*t*(driven + g*dv)/2*[1, -1], &
         (wire%heat_fraction*by_temperature*dv*t + made*dt)/2*[1, 1]]

      r = [flows%current*[1, -1], along*drop*[1, -1] + across*excess - source]                             ! (1), (2)
      k(1, :) = [g*[1, -1], by_temperature*[1, 1]]
      k(2, :) = -k(1, :)
      k(3, :) = [0.0_dp, 0.0_dp, along + dalong*drop, -along + dalong*drop]
      k(4, :) = -k(3, :)
      k(3:4, 3:4) = k(3:4, 3:4) + across + dacross*excess
      k(3:4, :) = k(3:4, :) - spread(dsource, 1, 2)
      flows%nodal_share = t
      flows%to_surroundings = 2*across*excess + made*(1 - t)
   end subroutine conductor_heat

   !> `t`: the part of what is evenly made or stored in an element that comes to its nodes; the film takes the rest.
   pure subroutine nodal_share(wire, t, dt)
      type(heated_wire_t), intent(in) :: wire
      !> t, and its derivative by either nodal temperature [1/K]
      real(dp), intent(out) :: t, dt
      real(dp) :: w2

      w2 = film_number(wire)
      call film_share(w2, t, dt)
      dt = -dt*w2*wire%dconductivity/(2*wire%conductivity)
   end subroutine nodal_share

   !> w^2 of (3)
   pure real(dp) function film_number(wire)
      type(heated_wire_t), intent(in) :: wire

      film_number = wire%film*wire%length/(4*wire%conductivity)*(wire%length/wire%area)
   end function film_number

   !> `t = tanh(w)/w` over `w^2`, and its derivative.
   pure subroutine film_share(w2, t, dt)
      !> w^2
      real(dp), intent(in) :: w2
      !> t, dt/d(w^2)
      real(dp), intent(out) :: t, dt

      if (w2 < small) then
         t = 1 - w2*(1/3.0_dp - w2*(2/15.0_dp - w2*(17/315.0_dp - w2*(62/2835.0_dp - w2*1382/155925.0_dp))))
         dt = -1/3.0_dp + w2*(4/15.0_dp - w2*(17/105.0_dp - w2*(248/2835.0_dp - w2*1382/31185.0_dp)))
      else
         t = tanh(sqrt(w2))/sqrt(w2)
         dt = (1 - w2*t**2 - t)/(2*w2)
      end if
   end subroutine film_share

end module litz_conductor_heat
