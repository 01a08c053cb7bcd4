! Superconducting wires for Python; the contracts are in fortran/laws/critical_law.f90 and parallel_law.f90 and in
! fortran/kernels/superconductor.f90.
module f2py_superconductor
   use iso_c_binding, only: c_double, c_int
   use litz_critical_density, only: critical_density_t
   use litz_critical_nb3sn, only: nb3sn_density
   use litz_critical_nbti, only: nbti_density
   use litz_critical_table, only: table_density
   use litz_parallel_law, only: parallel_law_t, parallel_field_t, field_of_current
   use litz_superconductor, only: core_superconductor => superconductor, superconductor_flow_t, &
      superconductor_wire_t, core_moved_current => moved_current
   implicit none
contains

   ! value and derivatives by temperature, flux density and strain
   subroutine nb3sn(parameters, temperature, flux_density, strain, critical)
      !> C, Bc20, Tc0, p, q, Ca1, Ca2, e0, em (9)
      real(c_double), intent(in) :: parameters(9)
      !> [K]
      real(c_double), intent(in) :: temperature
      !> [T]
      real(c_double), intent(in) :: flux_density
      !> Axial strain
      real(c_double), intent(in) :: strain
      !> (4)
      real(c_double), intent(out) :: critical(4)
      type(critical_density_t) :: found

      found = nb3sn_density(parameters, temperature, flux_density, strain)
      critical = [found%value, found%by_temperature, found%by_field, found%by_strain]
   end subroutine nb3sn

   subroutine nbti(parameters, temperature, flux_density, critical)
      !> jref, C0, Bc20, Tc0, alpha, beta, gamma (7)
      real(c_double), intent(in) :: parameters(7)
      !> [K]
      real(c_double), intent(in) :: temperature
      !> [T]
      real(c_double), intent(in) :: flux_density
      !> As of nb3sn (4)
      real(c_double), intent(out) :: critical(4)
      type(critical_density_t) :: found

      found = nbti_density(parameters, temperature, flux_density)
      critical = [found%value, found%by_temperature, found%by_field, found%by_strain]
   end subroutine nbti

   subroutine critical_table(n_t, n_b, temperatures, flux_densities, densities, temperature, flux_density, critical)
      !> Temperatures of the table
      integer(c_int), intent(in) :: n_t
      !> Flux densities of the table
      integer(c_int), intent(in) :: n_b
      !> Ascending [K]
      real(c_double), intent(in) :: temperatures(n_t)
      !> Ascending [T]
      real(c_double), intent(in) :: flux_densities(n_b)
      !> [A/m^2]
      real(c_double), intent(in) :: densities(n_t, n_b)
      !> [K]
      real(c_double), intent(in) :: temperature
      !> [T]
      real(c_double), intent(in) :: flux_density
      !> As of nb3sn (4)
      real(c_double), intent(out) :: critical(4)
      type(critical_density_t) :: found

      found = table_density(temperatures, flux_densities, densities, temperature, flux_density)
      critical = [found%value, found%by_temperature, found%by_field, found%by_strain]
   end subroutine critical_table

   ! value and derivatives by current density, conductivity and critical current density
   subroutine parallel_field(law, current, field)
      !> Conductivity, critical current density, criterion, exponent (4)
      real(c_double), intent(in) :: law(4)
      !> J [A/m^2]
      real(c_double), intent(in) :: current
      !> (4)
      real(c_double), intent(out) :: field(4)
      type(parallel_field_t) :: found

      found = field_of_current(parallel_law_t(law(1), law(2), law(3), law(4)), current)
      field = [found%value, found%by_current, found%by_conductivity, found%by_critical]
   end subroutine parallel_field

   ! current at the potentials, its derivatives by voltage, length, resistivity, conductivity and critical current
   ! density, electric field and voltage of the present current
   subroutine superconductor(length, area, resistivity, law, current, voltage, flow)
      !> [m]
      real(c_double), intent(in) :: length
      !> [m^2]
      real(c_double), intent(in) :: area
      !> Of the metal [ohm m]
      real(c_double), intent(in) :: resistivity
      !> As of parallel_field (4)
      real(c_double), intent(in) :: law(4)
      !> I [A]
      real(c_double), intent(in) :: current
      !> V1 - V2 [V]
      real(c_double), intent(in) :: voltage
      !> (8)
      real(c_double), intent(out) :: flow(8)
      type(superconductor_flow_t) :: found

      found = core_superconductor(superconductor_wire_t(length, area, resistivity, parallel_law_t(law(1), law(2), &
         law(3), law(4))), current, voltage, 0.0_c_double)
      flow = [found%current, found%by_voltage, found%by_length, found%by_resistivity, found%by_conductivity, &
         found%by_critical, found%field, found%drop]
   end subroutine superconductor

   subroutine moved_current(length, area, resistivity, law, current, linear, drop, voltage, moved)
      !> [m]
      real(c_double), intent(in) :: length
      !> [m^2]
      real(c_double), intent(in) :: area
      !> Of the metal [ohm m]
      real(c_double), intent(in) :: resistivity
      !> As of parallel_field (4)
      real(c_double), intent(in) :: law(4)
      !> I [A]
      real(c_double), intent(in) :: current
      !> I* at the new potentials [A]
      real(c_double), intent(in) :: linear
      !> U(I) [V]
      real(c_double), intent(in) :: drop
      !> V1 - V2 at the new potentials [V]
      real(c_double), intent(in) :: voltage
      !> [A]
      real(c_double), intent(out) :: moved

      moved = core_moved_current(superconductor_wire_t(length, area, resistivity, parallel_law_t(law(1), law(2), &
         law(3), law(4))), current, linear, drop, voltage)
   end subroutine moved_current

end module f2py_superconductor
