! Superconducting wires for Python; the contracts are in fortran/laws/critical_law.f90 and parallel_law.f90 and in
! fortran/kernels/superconductor.f90.
module f2py_superconductor
   use iso_c_binding, only: c_double, c_int
   use litz_critical_density, only: critical_density_t
   use litz_critical_nb3sn, only: nb3sn_density
   use litz_critical_nbti, only: nbti_density
   use litz_critical_table, only: table_density
   use litz_parallel_law, only: parallel_law_t, parallel_field_t, field_of_current
   use litz_superconductor, only: core_superconductor => superconductor, superconductor_flow_t, superconductor_wire_t
   implicit none
contains

   ! values and derivatives by temperature, flux density and strain
   subroutine nb3sn(n, temperature, flux_density, strain, parameters, critical)
      !> Number of places
      integer(c_int), intent(in) :: n
      !> (n) [K]
      real(c_double), intent(in) :: temperature(n)
      !> (n) [T]
      real(c_double), intent(in) :: flux_density(n)
      !> Axial strains (n)
      real(c_double), intent(in) :: strain(n)
      !> C, Bc20, Tc0, p, q, Ca1, Ca2, e0, em (9, n)
      real(c_double), intent(in) :: parameters(9, n)
      !> (4, n)
      real(c_double), intent(out) :: critical(4, n)
      type(critical_density_t) :: found
      integer :: i

      do i = 1, n
         found = nb3sn_density(parameters(:, i), temperature(i), flux_density(i), strain(i))
         critical(:, i) = [found%value, found%by_temperature, found%by_field, found%by_strain]
      end do
   end subroutine nb3sn

   subroutine nbti(n, temperature, flux_density, parameters, critical)
      !> Number of places
      integer(c_int), intent(in) :: n
      !> (n) [K]
      real(c_double), intent(in) :: temperature(n)
      !> (n) [T]
      real(c_double), intent(in) :: flux_density(n)
      !> jref, C0, Bc20, Tc0, alpha, beta, gamma (7, n)
      real(c_double), intent(in) :: parameters(7, n)
      !> As of nb3sn (4, n)
      real(c_double), intent(out) :: critical(4, n)
      type(critical_density_t) :: found
      integer :: i

      do i = 1, n
         found = nbti_density(parameters(:, i), temperature(i), flux_density(i))
         critical(:, i) = [found%value, found%by_temperature, found%by_field, found%by_strain]
      end do
   end subroutine nbti

   subroutine critical_table(n, n_t, n_b, temperature, flux_density, temperatures, flux_densities, densities, critical)
      !> Number of places; of temperatures and of flux densities of the table
      integer(c_int), intent(in) :: n, n_t, n_b
      !> (n) [K]
      real(c_double), intent(in) :: temperature(n)
      !> (n) [T]
      real(c_double), intent(in) :: flux_density(n)
      !> Ascending [K]
      real(c_double), intent(in) :: temperatures(n_t)
      !> Ascending [T]
      real(c_double), intent(in) :: flux_densities(n_b)
      !> [A/m^2]
      real(c_double), intent(in) :: densities(n_t, n_b)
      !> As of nb3sn (4, n)
      real(c_double), intent(out) :: critical(4, n)
      type(critical_density_t) :: found
      integer :: i

      do i = 1, n
         found = table_density(temperatures, flux_densities, densities, temperature(i), flux_density(i))
         critical(:, i) = [found%value, found%by_temperature, found%by_field, found%by_strain]
      end do
   end subroutine critical_table

   ! values and derivatives by current density, conductivity and critical current density
   subroutine parallel_field(n, current, law, field)
      !> Number of currents
      integer(c_int), intent(in) :: n
      !> J (n) [A/m^2]
      real(c_double), intent(in) :: current(n)
      !> Conductivity, critical current density, criterion, exponent (4, n)
      real(c_double), intent(in) :: law(4, n)
      !> (4, n)
      real(c_double), intent(out) :: field(4, n)
      type(parallel_field_t) :: found
      integer :: i

      do i = 1, n
         found = field_of_current(parallel_law_t(law(1, i), law(2, i), law(3, i), law(4, i)), current(i))
         field(:, i) = [found%value, found%by_current, found%by_conductivity, found%by_critical]
      end do
   end subroutine parallel_field

   ! current at the potentials, its derivative by the voltage, electric field and voltage of the present current
   subroutine superconductor(n, current, potential, length, area, resistivity, law, flow)
      !> Number of elements
      integer(c_int), intent(in) :: n
      !> I (n) [A]
      real(c_double), intent(in) :: current(n)
      !> Of the nodes (2, n) [V]
      real(c_double), intent(in) :: potential(2, n)
      !> (n) [m]
      real(c_double), intent(in) :: length(n)
      !> (n) [m^2]
      real(c_double), intent(in) :: area(n)
      !> Of the metal (n) [ohm m]
      real(c_double), intent(in) :: resistivity(n)
      !> As of parallel_field (4, n)
      real(c_double), intent(in) :: law(4, n)
      !> (4, n)
      real(c_double), intent(out) :: flow(4, n)
      type(superconductor_flow_t) :: found
      integer :: i

      do i = 1, n
         found = core_superconductor(superconductor_wire_t(length(i), area(i), resistivity(i), &
            parallel_law_t(law(1, i), law(2, i), law(3, i), law(4, i))), current(i), &
            potential(1, i) - potential(2, i), 0.0_c_double)
         flow(:, i) = [found%current, found%by_voltage, found%field, found%drop]
      end do
   end subroutine superconductor

end module f2py_superconductor
