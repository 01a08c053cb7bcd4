! Kernels of heat for Python, of many spots or elements at once; the contracts are in fortran/laws/spot_heat.f90 and
! hot_spot.f90, and in fortran/kernels/conductor_heat.f90, wire_surface.f90 and heat_capacity.f90.
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
   subroutine spot_heat(n, voltage, conductance, temperature, resistivity, lorenz, heat_conductance, film_resistance, &
      film, heat, hottest, dheat, dhottest, info)
      !f2py threadsafe
      !> Number of spots
      integer(c_int), intent(in) :: n
      !> V (n) [V]
      real(c_double), intent(in) :: voltage(n)
      !> G (n) [S]
      real(c_double), intent(in) :: conductance(n)
      !> Of the bulks (2, n) [K]
      real(c_double), intent(in) :: temperature(2, n)
      !> Of the wires (2, n) [ohm m]; only their ratio counts
      real(c_double), intent(in) :: resistivity(2, n)
      !> Lorenz numbers (2, n) [V^2/K^2]; 0: the heat conductance counts
      real(c_double), intent(in) :: lorenz(2, n)
      !> Of the constrictions (2, n) [W/K]
      real(c_double), intent(in) :: heat_conductance(2, n)
      !> Of the films (n) [ohm]
      real(c_double), intent(in) :: film_resistance(n)
      !> Resistances of the films to heat (n) [K/W]
      real(c_double), intent(in) :: film(n)
      !> To the bulks (2, n) [W]
      real(c_double), intent(out) :: heat(2, n)
      !> Hottest temperatures (n) [K]
      real(c_double), intent(out) :: hottest(n)
      !> Derivatives of the heats (2, 4, n)
      real(c_double), intent(out) :: dheat(2, 4, n)
      !> Derivatives of the hottest temperatures (4, n)
      real(c_double), intent(out) :: dhottest(4, n)
      !> 0, or not: data that are not allowed (n)
      integer(c_int), intent(out) :: info(n)
      type(spot_heat_t) :: found
      integer :: i

      do i = 1, n
         call spot_heat_of_voltage(spot_wires_t(resistivity(:, i), lorenz(:, i), heat_conductance(:, i), &
            film_resistance(i), film(i)), voltage(i), conductance(i), temperature(:, i), found, info(i))
         heat(:, i) = found%heat
         hottest(i) = found%hottest
         dheat(:, :, i) = found%dheat(:, :4)
         dhottest(:, i) = found%dhottest(:4)
      end do
   end subroutine spot_heat

   subroutine hot_conductance(n, voltage, temperature, lorenz, ratio, dratio)
      !> Number of spots
      integer(c_int), intent(in) :: n
      !> V (n) [V]
      real(c_double), intent(in) :: voltage(n)
      !> Of the bulks (2, n) [K]
      real(c_double), intent(in) :: temperature(2, n)
      !> Lorenz numbers (n) [V^2/K^2]
      real(c_double), intent(in) :: lorenz(n)
      !> Hot over cold conductance (n)
      real(c_double), intent(out) :: ratio(n)
      !> Its derivatives by V, T_1, T_2 (3, n)
      real(c_double), intent(out) :: dratio(3, n)
      integer :: i

      do i = 1, n
         call core_hot_conductance(voltage(i), temperature(:, i), lorenz(i), ratio(i), dratio(:, i))
      end do
   end subroutine hot_conductance

   ! derivatives by V, T_1, T_2
   subroutine hot_spot(n, n_sets, n_rho_1, n_rho_2, n_lambda_1, n_lambda_2, voltage, temperature, shape, lorenz, &
      film_resistance, film, resistivity_1, resistivity_2, conductivity_1, conductivity_2, is_metal, current, heat, &
      hottest, dcurrent, dheat, dhottest, info)
      !f2py threadsafe
      !> Number of spots; of sets of tables: n, or 1 for all
      integer(c_int), intent(in) :: n, n_sets
      !> Numbers of pairs of the tables
      integer(c_int), intent(in) :: n_rho_1
      !> Numbers of pairs of the tables
      integer(c_int), intent(in) :: n_rho_2
      !> Numbers of pairs of the tables
      integer(c_int), intent(in) :: n_lambda_1
      !> Numbers of pairs of the tables
      integer(c_int), intent(in) :: n_lambda_2
      !> V (n) [V]
      real(c_double), intent(in) :: voltage(n)
      !> Of the bulks (2, n) [K]
      real(c_double), intent(in) :: temperature(2, n)
      !> Of either constriction (n) [1/m]
      real(c_double), intent(in) :: shape(n)
      !> Lorenz numbers (n) [V^2/K^2]; 0: that of the tables at the bulks
      real(c_double), intent(in) :: lorenz(n)
      !> Of the films (n) [ohm]
      real(c_double), intent(in) :: film_resistance(n)
      !> Resistances of the films to heat (n) [K/W]
      real(c_double), intent(in) :: film(n)
      !> Temperatures and rho of wire 1 (2, n_rho_1, n_sets) [K, ohm m]
      real(c_double), intent(in) :: resistivity_1(2, n_rho_1, n_sets)
      !> Temperatures and rho of wire 2 (2, n_rho_2, n_sets) [K, ohm m]
      real(c_double), intent(in) :: resistivity_2(2, n_rho_2, n_sets)
      !> Temperatures and lambda of wire 1 (2, n_lambda_1, n_sets) [K, W/(m K)]
      real(c_double), intent(in) :: conductivity_1(2, n_lambda_1, n_sets)
      !> Temperatures and lambda of wire 2 (2, n_lambda_2, n_sets) [K, W/(m K)]
      real(c_double), intent(in) :: conductivity_2(2, n_lambda_2, n_sets)
      !> Wiedemann-Franz metals, or not: 0
      integer(c_int), intent(in) :: is_metal
      !> [A] (n)
      real(c_double), intent(out) :: current(n)
      !> To the bulks (2, n) [W]
      real(c_double), intent(out) :: heat(2, n)
      !> Hottest temperatures in the constrictions (2, n) [K]
      real(c_double), intent(out) :: hottest(2, n)
      !> Derivatives of the currents (3, n)
      real(c_double), intent(out) :: dcurrent(3, n)
      !> Derivatives of the heats (2, 3, n)
      real(c_double), intent(out) :: dheat(2, 3, n)
      !> Derivatives of the hottest temperatures (2, 3, n)
      real(c_double), intent(out) :: dhottest(2, 3, n)
      !> 0, or not: data that are not allowed, no solution (n)
      integer(c_int), intent(out) :: info(n)
      type(spot_metal_t) :: metals(2)
      type(hot_spot_t) :: found
      integer :: i

      do i = 1, n
         if (i <= n_sets) then
            metals(1) = spot_metal_t(resistivity_1(:, :, i), conductivity_1(:, :, i))
            metals(2) = spot_metal_t(resistivity_2(:, :, i), conductivity_2(:, :, i))
         end if
         call core_hot_spot(constrictions_t([shape(i), shape(i)], film_resistance(i), film(i), is_metal /= 0, &
            lorenz(i)), metals, voltage(i), temperature(:, i), found, info(i))
         current(i) = found%current
         heat(:, i) = found%heat
         hottest(:, i) = found%hottest
         dcurrent(:, i) = found%dcurrent
         dheat(:, :, i) = found%dheat
         dhottest(:, :, i) = found%dhottest
      end do
   end subroutine hot_spot

   ! flows: current, Joule heat, heat to the surroundings
   subroutine conductor_heat(n, n_sets, n_rho, n_lambda, v, temperature, length, area, heat_fraction, film, sink, &
      resistivity, conductivity, k, r, flows)
      !> Number of elements; of sets of tables: n, or 1 for all
      integer(c_int), intent(in) :: n, n_sets
      !> Numbers of pairs of the tables
      integer(c_int), intent(in) :: n_rho
      !> Numbers of pairs of the tables
      integer(c_int), intent(in) :: n_lambda
      !> Of the nodes (2, n) [V]
      real(c_double), intent(in) :: v(2, n)
      !> Of the nodes (2, n) [K]
      real(c_double), intent(in) :: temperature(2, n)
      !> Reference lengths (n) [m]
      real(c_double), intent(in) :: length(n)
      !> Cross-sections (n) [m^2]
      real(c_double), intent(in) :: area(n)
      !> eta (n)
      real(c_double), intent(in) :: heat_fraction(n)
      !> h P (n) [W/(m K)]
      real(c_double), intent(in) :: film(n)
      !> Temperatures of the surroundings (n) [K]
      real(c_double), intent(in) :: sink(n)
      !> Temperatures and rho (2, n_rho, n_sets) [K, ohm m]
      real(c_double), intent(in) :: resistivity(2, n_rho, n_sets)
      !> Temperatures and lambda (2, n_lambda, n_sets) [K, W/(m K)]
      real(c_double), intent(in) :: conductivity(2, n_lambda, n_sets)
      !> (4, 4, n), over V1, V2, T1, T2 [S, A/K, A, W/K]
      real(c_double), intent(out) :: k(4, 4, n)
      !> (4, n) [A, W]
      real(c_double), intent(out) :: r(4, n)
      !> Current [A], Joule heat [W], heat to the surroundings [W] (3, n)
      real(c_double), intent(out) :: flows(3, n)
      type(heated_wire_t) :: wire
      type(heat_flows_t) :: found
      integer :: i, set

      do i = 1, n
         set = min(i, n_sets)
         wire%length = length(i)
         wire%area = area(i)
         call property_at(resistivity(:, :, set), sum(temperature(:, i))/2, wire%resistivity, wire%dresistivity)
         call property_at(conductivity(:, :, set), sum(temperature(:, i))/2, wire%conductivity, wire%dconductivity)
         wire%heat_fraction = heat_fraction(i)
         wire%film = film(i)
         wire%sink = sink(i)
         call core_conductor_heat(wire, v(:, i), temperature(:, i), k(:, :, i), r(:, i), found)
         flows(:, i) = [found%current, found%joule_heat, found%to_surroundings]
      end do
   end subroutine conductor_heat

   subroutine wire_radiation(n, temperature, coefficient, surroundings, absolute_zero, k, r, info)
      !> Number of elements
      integer(c_int), intent(in) :: n
      !> Of the nodes (2, n) [K]
      real(c_double), intent(in) :: temperature(2, n)
      !> eps sigma P l (n) [W/K^4]
      real(c_double), intent(in) :: coefficient(n)
      !> Temperatures of the surroundings (n) [K]
      real(c_double), intent(in) :: surroundings(n)
      !> Of the temperature scale (n) [K]
      real(c_double), intent(in) :: absolute_zero(n)
      !> Tangents (2, 2, n) [W/K]
      real(c_double), intent(out) :: k(2, 2, n)
      !> Heat that leaves the nodes (2, n) [W]
      real(c_double), intent(out) :: r(2, n)
      !> 0, or not: a temperature below absolute zero (n)
      integer(c_int), intent(out) :: info(n)
      real(c_double) :: slope(2)
      integer :: i

      k = 0
      do i = 1, n
         call core_wire_radiation(temperature(:, i), coefficient(i), surroundings(i), absolute_zero(i), slope, &
            r(:, i), info(i))
         k(1, 1, i) = slope(1)
         k(2, 2, i) = slope(2)
      end do
   end subroutine wire_radiation

   subroutine heat_capacity(n, n_sets, n_pairs, n_latent, temperature, before, mass_per_time, specific_heat, latent, &
      k, r)
      !> Number of elements; of sets of tables: n, or 1 for all
      integer(c_int), intent(in) :: n, n_sets
      !> Number of pairs of the table
      integer(c_int), intent(in) :: n_pairs
      !> Number of latent heats
      integer(c_int), intent(in) :: n_latent
      !> Of the nodes (2, n) [K]
      real(c_double), intent(in) :: temperature(2, n)
      !> At the start of the increment (2, n) [K]
      real(c_double), intent(in) :: before(2, n)
      !> Mass over time increment (n) [kg/s]
      real(c_double), intent(in) :: mass_per_time(n)
      !> Temperatures and c (2, n_pairs, n_sets) [K, J/(kg K)]
      real(c_double), intent(in) :: specific_heat(2, n_pairs, n_sets)
      !> Latent heats, solidus and liquidus (3, n_latent, n_sets) [J/kg, K, K]
      real(c_double), intent(in) :: latent(3, n_latent, n_sets)
      !> Tangents (2, 2, n) [W/K]
      real(c_double), intent(out) :: k(2, 2, n)
      !> Heat that the nodes take up (2, n) [W]
      real(c_double), intent(out) :: r(2, n)
      real(c_double) :: slope(2)
      integer :: i, j, set

      k = 0
      do i = 1, n
         set = min(i, n_sets)
         call core_heat_capacity(temperature(:, i), before(:, i), before(:, i), &
            spread([1.0_c_double, 0.0_c_double], 2, 2), mass_per_time(i), specific_heat(:, :, set), &
            [(latent_heat_t(latent(1, j, set), latent(2, j, set), latent(3, j, set)), j=1, n_latent)], slope, r(:, i))
         k(1, 1, i) = slope(1)
         k(2, 2, i) = slope(2)
      end do
   end subroutine heat_capacity

end module f2py_heat
