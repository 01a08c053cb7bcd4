! Beams and conductor for Python; the contracts are in fortran/kernels/beam_b31.f90, beam_b33.f90, conductor.f90 and
! potential_rise.f90.
! Stress-free state and current state go in together; `spin` asks for the spin form of the tangent, `given_sigma` says
! whether `sigma` counts.
module f2py_beams
   use iso_c_binding, only: c_double, c_int
   use litz_beam_b31, only: b31 => beam_b31, b31_reference => beam_b31_reference
   use litz_beam_b33, only: b33 => beam_b33, b33_reference => beam_b33_reference
   use litz_beam_temperature, only: core_forces_by_temperature => forces_by_temperature
   use litz_conductor, only: core_conductor => conductor
   use litz_potential_rise, only: core_potential_rise => potential_rise
   use litz_rotation_forms, only: hessian_to_spin
   implicit none
contains

   subroutine beam_b31(x, triads, x0, triads0, stiffness, stress_free_strain, sigma, given_sigma, spin, &
         k, r, energy, section_forces, strain, b, length)
      !> Present positions of the nodes (3, 2) [m]
      real(c_double), intent(in) :: x(3, 2)
      !> Present triads of the nodes (3, 3, 2): columns tangent, first, second section axis
      real(c_double), intent(in) :: triads(3, 3, 2)
      !> Stress-free positions of the nodes (3, 2) [m]
      real(c_double), intent(in) :: x0(3, 2)
      !> Stress-free triads of the nodes (3, 3, 2)
      real(c_double), intent(in) :: triads0(3, 3, 2)
      !> EA, GA2, GA3 [N], GJ, EI2, EI3 [N m^2]
      real(c_double), intent(in) :: stiffness(6)
      !> Axial strain of the stress-free state, as from temperature
      real(c_double), intent(in) :: stress_free_strain
      !> Section forces (6) [N, N m] for the geometric part of the tangent
      real(c_double), intent(in) :: sigma(6)
      !> .true.: `sigma` counts; .false.: those of the present state do
      logical, intent(in) :: given_sigma
      !> .true.: tangent in the spin form; .false.: in the Hessian form
      logical, intent(in) :: spin
      !> Tangent (12, 12) [N/m, N, N m]
      real(c_double), intent(out) :: k(12, 12)
      !> Residual (12) [N, N m]
      real(c_double), intent(out) :: r(12)
      !> Elastic energy [J]
      real(c_double), intent(out) :: energy
      !> N, Q2, Q3 [N], T, M2, M3 [N m]
      real(c_double), intent(out) :: section_forces(6)
      !> Strains that belong to the section forces (6) [-, 1/m]
      real(c_double), intent(out) :: strain(6)
      !> Derivatives of the strains with respect to the unknowns (6, 12)
      real(c_double), intent(out) :: b(6, 12)
      !> Reference length [m]
      real(c_double), intent(out) :: length
      real(c_double) :: strain0(6)

      call b31_reference(x0, triads0, length, strain0)
      strain0(1) = strain0(1) + stress_free_strain
      if (given_sigma) then
         call b31(x, triads, length, strain0, stiffness, k, r, energy, section_forces, strain, b, sigma)
      else
         call b31(x, triads, length, strain0, stiffness, k, r, energy, section_forces, strain, b)
      end if
      if (spin) call hessian_to_spin(k, r, [4, 10])
   end subroutine beam_b31

   subroutine beam_b33(x, triads, x0, triads0, stiffness, stress_free_strain, sigma, given_sigma, spin, &
         k, r, energy, section_forces, strain, b, length)
      !> Present positions of the nodes (3, 2) [m]
      real(c_double), intent(in) :: x(3, 2)
      !> Present triads of the nodes (3, 3, 2): columns tangent, first, second section axis
      real(c_double), intent(in) :: triads(3, 3, 2)
      !> Stress-free positions of the nodes (3, 2) [m]
      real(c_double), intent(in) :: x0(3, 2)
      !> Stress-free triads of the nodes (3, 3, 2)
      real(c_double), intent(in) :: triads0(3, 3, 2)
      !> EA, GA2, GA3 [N], GJ, EI2, EI3 [N m^2]
      real(c_double), intent(in) :: stiffness(6)
      !> Axial strain of the stress-free state, as from temperature
      real(c_double), intent(in) :: stress_free_strain
      !> Section forces (6) [N, N m] for the geometric part of the tangent
      real(c_double), intent(in) :: sigma(6)
      !> .true.: `sigma` counts; .false.: those of the present state do
      logical, intent(in) :: given_sigma
      !> .true.: tangent in the spin form; .false.: in the Hessian form
      logical, intent(in) :: spin
      !> Tangent (12, 12) [N/m, N, N m]
      real(c_double), intent(out) :: k(12, 12)
      !> Residual (12) [N, N m]
      real(c_double), intent(out) :: r(12)
      !> Elastic energy [J]
      real(c_double), intent(out) :: energy
      !> N, Q2, Q3 [N], T, M2, M3 [N m]
      real(c_double), intent(out) :: section_forces(6)
      !> Strains that belong to the section forces (6) [-, 1/m]
      real(c_double), intent(out) :: strain(6)
      !> Derivatives of the strains with respect to the unknowns (6, 12)
      real(c_double), intent(out) :: b(6, 12)
      !> Reference length [m]
      real(c_double), intent(out) :: length
      real(c_double) :: strain0(6)

      call b33_reference(x0, triads0, length, strain0)
      strain0(1) = strain0(1) + stress_free_strain
      if (given_sigma) then
         call b33(x, triads, length, strain0, stiffness, k, r, energy, section_forces, strain, b, sigma)
      else
         call b33(x, triads, length, strain0, stiffness, k, r, energy, section_forces, strain, b)
      end if
      if (spin) call hessian_to_spin(k, r, [4, 10])
   end subroutine beam_b33

   subroutine forces_by_temperature(length, rigidity, drigidity, strain, dstress_free, b, dr)
      !> Reference length [m]
      real(c_double), intent(in) :: length
      !> What multiplies the strains in the section forces (6)
      real(c_double), intent(in) :: rigidity(6)
      !> Its derivative by the temperature (6)
      real(c_double), intent(in) :: drigidity(6)
      !> Strains against the stress-free state (6)
      real(c_double), intent(in) :: strain(6)
      !> Derivative of the axial strain of the stress-free state by the temperature [1/K]
      real(c_double), intent(in) :: dstress_free
      !> Derivatives of the strains by displacements and spins (6, 12)
      real(c_double), intent(in) :: b(6, 12)
      !> Derivatives of the internal forces [N/K, N m/K] (12)
      real(c_double), intent(out) :: dr(12)

      dr = core_forces_by_temperature(length, rigidity, drigidity, strain, dstress_free, b)
   end subroutine forces_by_temperature

   subroutine conductor(x, v, length, area, resistivity, current_length, k, r, k_me, current, heat)
      !> Present positions of the nodes (3, 2) [m]
      real(c_double), intent(in) :: x(3, 2)
      !> Voltages of the nodes (2) [V]
      real(c_double), intent(in) :: v(2)
      !> Reference length [m]
      real(c_double), intent(in) :: length
      !> Cross-section [m^2]
      real(c_double), intent(in) :: area
      !> Resistivity [ohm m]
      real(c_double), intent(in) :: resistivity
      !> .true.: conduction over the present length
      logical, intent(in) :: current_length
      !> Derivatives of the residual with respect to the voltages (2, 2) [S]
      real(c_double), intent(out) :: k(2, 2)
      !> Currents that leave the nodes (2) [A]
      real(c_double), intent(out) :: r(2)
      !> Derivatives of the residual with respect to the positions (2, 6) [A/m]
      real(c_double), intent(out) :: k_me(2, 6)
      !> Current from node 1 to node 2 [A]
      real(c_double), intent(out) :: current
      !> Joule heat [W]
      real(c_double), intent(out) :: heat

      call core_conductor(x, v, length, area, resistivity, current_length, k, r, k_me, current, heat)
   end subroutine conductor

   subroutine potential_rise(n, scale, xi, current, rise)
      !> Number of contacts on the element
      integer(c_int), intent(in) :: n
      !> Resistivity times length over 4 areas [ohm]
      real(c_double), intent(in) :: scale
      !> Places of the contacts (n)
      real(c_double), intent(in) :: xi(n)
      !> Currents that enter there (n) [A]
      real(c_double), intent(in) :: current(n)
      !> Rise of the potential above the linear one at each contact (n) [V]
      real(c_double), intent(out) :: rise(n)

      call core_potential_rise(scale, xi, current, rise)
   end subroutine potential_rise

end module f2py_beams
