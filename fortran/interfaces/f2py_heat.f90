! Kernels of heat for Python; the contracts are in fortran/laws/spot_heat.f90 and hot_spot.f90, and in
! fortran/kernels/conductor_heat.f90, wire_surface.f90 and heat_capacity.f90.
module f2py_heat
   use iso_c_binding, only: c_double, c_int
   use litz_conductor_heat, only: core_conductor_heat => conductor_heat, heated_wire_t, heat_flows_t
   use litz_heat_capacity, only: core_heat_capacity => heat_capacity, latent_heat_t
   use litz_hot_spot, only: core_hot_spot => hot_spot, constrictions_t, hot_spot_t
   use litz_property_table, only: property_at
   use litz_spot_heat, only: core_hot_conductance => hot_conductance, spot_heat_of_voltage, spot_heat_t, spot_wires_t
   use litz_spot_metal, only: spot_metal_t
   use litz_wire_surface, only: core_wire_radiation => wire_radiation
   implicit none
contains

   ! derivatives by V, G, T_1, T_2
   subroutine spot_heat(voltage, conductance, temperature, resistivity, lorenz, heat_conductance, film_resistance, &
      film, heat, hottest, dheat, dhottest, info)
      !> V [V]
      real(c_double), intent(in) :: voltage
      !> G [S]
      real(c_double), intent(in) :: conductance
      !> Of the bulks (2) [K]
      real(c_double), intent(in) :: temperature(2)
      !> Of the wires (2) [ohm m]; only their ratio counts
      real(c_double), intent(in) :: resistivity(2)
      !> Lorenz numbers (2) [V^2/K^2]; 0: the heat conductance counts
      real(c_double), intent(in) :: lorenz(2)
      !> Of the constrictions (2) [W/K]
      real(c_double), intent(in) :: heat_conductance(2)
      !> Of the film [ohm]
      real(c_double), intent(in) :: film_resistance
      !> Resistance of the film to heat [K/W]
      real(c_double), intent(in) :: film
      !> To the bulks (2) [W]
      real(c_double), intent(out) :: heat(2)
      !> Hottest temperature [K]
      real(c_double), intent(out) :: hottest
      !> Derivatives of the heats (2, 4)
      real(c_double), intent(out) :: dheat(2, 4)
      !> Derivatives of the hottest temperature (4)
      real(c_double), intent(out) :: dhottest(4)
      !> 0, or not: data that are not allowed
      integer(c_int), intent(out) :: info
      type(spot_heat_t) :: found

      call spot_heat_of_voltage(spot_wires_t(resistivity, lorenz, heat_conductance, film_resistance, film), voltage, &
         conductance, temperature, found, info)
      heat = found%heat
      hottest = found%hottest
      dheat = found%dheat(:, :4)
      dhottest = found%dhottest(:4)
   end subroutine spot_heat

   subroutine hot_conductance(voltage, temperature, lorenz, ratio, dratio)
      !> V [V]
      real(c_double), intent(in) :: voltage
      !> Of the bulks (2) [K]
      real(c_double), intent(in) :: temperature(2)
      !> Lorenz number [V^2/K^2]
      real(c_double), intent(in) :: lorenz
      !> Hot over cold conductance
      real(c_double), intent(out) :: ratio
      !> Its derivatives by V, T_1, T_2 (3)
      real(c_double), intent(out) :: dratio(3)

      call core_hot_conductance(voltage, temperature, lorenz, ratio, dratio)
   end subroutine hot_conductance

   ! derivatives by V, T_1, T_2
   subroutine hot_spot(n_rho_1, n_rho_2, n_lambda_1, n_lambda_2, voltage, temperature, shape, resistivity_1, &
      resistivity_2, conductivity_1, conductivity_2, is_metal, lorenz, film_resistance, film, current, heat, hottest, &
      dcurrent, dheat, dhottest, info)
      !> Numbers of pairs of the tables
      integer(c_int), intent(in) :: n_rho_1
      !> Numbers of pairs of the tables
      integer(c_int), intent(in) :: n_rho_2
      !> Numbers of pairs of the tables
      integer(c_int), intent(in) :: n_lambda_1
      !> Numbers of pairs of the tables
      integer(c_int), intent(in) :: n_lambda_2
      !> V [V]
      real(c_double), intent(in) :: voltage
      !> Of the bulks (2) [K]
      real(c_double), intent(in) :: temperature(2)
      !> Of either constriction [1/m]
      real(c_double), intent(in) :: shape
      !> Temperatures and rho of wire 1 (2, n_rho_1) [K, ohm m]
      real(c_double), intent(in) :: resistivity_1(2, n_rho_1)
      !> Temperatures and rho of wire 2 (2, n_rho_2) [K, ohm m]
      real(c_double), intent(in) :: resistivity_2(2, n_rho_2)
      !> Temperatures and lambda of wire 1 (2, n_lambda_1) [K, W/(m K)]
      real(c_double), intent(in) :: conductivity_1(2, n_lambda_1)
      !> Temperatures and lambda of wire 2 (2, n_lambda_2) [K, W/(m K)]
      real(c_double), intent(in) :: conductivity_2(2, n_lambda_2)
      !> Wiedemann-Franz metals, or not: 0
      integer(c_int), intent(in) :: is_metal
      !> Lorenz number [V^2/K^2]; 0: that of the tables at the bulks
      real(c_double), intent(in) :: lorenz
      !> Of the film [ohm]
      real(c_double), intent(in) :: film_resistance
      !> Resistance of the film to heat [K/W]
      real(c_double), intent(in) :: film
      !> [A]
      real(c_double), intent(out) :: current
      !> To the bulks (2) [W]
      real(c_double), intent(out) :: heat(2)
      !> Hottest temperatures in the constrictions (2) [K]
      real(c_double), intent(out) :: hottest(2)
      !> Derivatives of the current (3)
      real(c_double), intent(out) :: dcurrent(3)
      !> Derivatives of the heats (2, 3)
      real(c_double), intent(out) :: dheat(2, 3)
      !> Derivatives of the hottest temperatures (2, 3)
      real(c_double), intent(out) :: dhottest(2, 3)
      !> 0, or not: data that are not allowed, no solution
      integer(c_int), intent(out) :: info
      type(spot_metal_t) :: metals(2)
      type(hot_spot_t) :: found

      metals(1) = spot_metal_t(resistivity_1, conductivity_1)
      metals(2) = spot_metal_t(resistivity_2, conductivity_2)
      call core_hot_spot(constrictions_t(shape, film_resistance, film, is_metal /= 0, lorenz), metals, voltage, &
         temperature, found, info)
      current = found%current
      heat = found%heat
      hottest = found%hottest
      dcurrent = found%dcurrent
      dheat = found%dheat
      dhottest = found%dhottest
   end subroutine hot_spot

   ! flows: current, Joule heat, heat to the surroundings
   subroutine conductor_heat(n_rho, n_lambda, v, temperature, length, area, resistivity, conductivity, heat_fraction, &
      film, sink, k, r, flows)
      !> Numbers of pairs of the tables
      integer(c_int), intent(in) :: n_rho
      !> Numbers of pairs of the tables
      integer(c_int), intent(in) :: n_lambda
      !> Of the nodes (2) [V]
      real(c_double), intent(in) :: v(2)
      !> Of the nodes (2) [K]
      real(c_double), intent(in) :: temperature(2)
      !> Reference length [m]
      real(c_double), intent(in) :: length
      !> Cross-section [m^2]
      real(c_double), intent(in) :: area
      !> Temperatures and rho (2, n_rho) [K, ohm m]
      real(c_double), intent(in) :: resistivity(2, n_rho)
      !> Temperatures and lambda (2, n_lambda) [K, W/(m K)]
      real(c_double), intent(in) :: conductivity(2, n_lambda)
      !> eta
      real(c_double), intent(in) :: heat_fraction
      !> h P [W/(m K)]
      real(c_double), intent(in) :: film
      !> Temperature of the surroundings [K]
      real(c_double), intent(in) :: sink
      !> (4, 4), over V1, V2, T1, T2 [S, A/K, A, W/K]
      real(c_double), intent(out) :: k(4, 4)
      !> (4) [A, W]
      real(c_double), intent(out) :: r(4)
      !> Current [A], Joule heat [W], heat to the surroundings [W] (3)
      real(c_double), intent(out) :: flows(3)
      type(heated_wire_t) :: wire
      type(heat_flows_t) :: found

      wire%length = length
      wire%area = area
      call property_at(resistivity, sum(temperature)/2, wire%resistivity, wire%dresistivity)
      call property_at(conductivity, sum(temperature)/2, wire%conductivity, wire%dconductivity)
      wire%heat_fraction = heat_fraction
      wire%film = film
      wire%sink = sink
      call core_conductor_heat(wire, v, temperature, k, r, found)
      flows = [found%current, found%joule_heat, found%to_surroundings]
   end subroutine conductor_heat

   subroutine wire_radiation(temperature, coefficient, surroundings, absolute_zero, k, r, info)
      !> Of the nodes (2) [K]
      real(c_double), intent(in) :: temperature(2)
      !> eps sigma P l [W/K^4]
      real(c_double), intent(in) :: coefficient
      !> Temperature of the surroundings [K]
      real(c_double), intent(in) :: surroundings
      !> Of the temperature scale [K]
      real(c_double), intent(in) :: absolute_zero
      !> Derivatives of `r` (2) [W/K]
      real(c_double), intent(out) :: k(2)
      !> Heat that leaves the nodes (2) [W]
      real(c_double), intent(out) :: r(2)
      !> 0, or not: a temperature below absolute zero
      integer(c_int), intent(out) :: info

      call core_wire_radiation(temperature, coefficient, surroundings, absolute_zero, k, r, info)
   end subroutine wire_radiation

   subroutine heat_capacity(n, n_latent, temperature, before, mass_per_time, specific_heat, latent, k, r)
      !> Number of pairs of the table
      integer(c_int), intent(in) :: n
      !> Number of latent heats
      integer(c_int), intent(in) :: n_latent
      !> Of the nodes (2) [K]
      real(c_double), intent(in) :: temperature(2)
      !> At the start of the increment (2) [K]
      real(c_double), intent(in) :: before(2)
      !> Mass over time increment [kg/s]
      real(c_double), intent(in) :: mass_per_time
      !> Temperatures and c (2, n) [K, J/(kg K)]
      real(c_double), intent(in) :: specific_heat(2, n)
      !> Latent heats, solidus and liquidus (3, n_latent) [J/kg, K, K]
      real(c_double), intent(in) :: latent(3, n_latent)
      !> Derivatives of `r` (2) [W/K]
      real(c_double), intent(out) :: k(2)
      !> Heat that the nodes take up (2) [W]
      real(c_double), intent(out) :: r(2)
      integer :: i

      call core_heat_capacity(temperature, before, before, [1.0_c_double, 0.0_c_double], mass_per_time, specific_heat, &
         [(latent_heat_t(latent(1, i), latent(2, i), latent(3, i)), i=1, n_latent)], k, r)
   end subroutine heat_capacity

end module f2py_heat
