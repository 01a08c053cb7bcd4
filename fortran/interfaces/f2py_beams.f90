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
   private :: least_elements

   !> Fewer elements are not shared among threads
   integer, parameter :: least_elements = 200
contains

   subroutine beam_b31(n, x, triads, x0, triads0, stiffness, stress_free_strain, sigma, given_sigma, spin, n_k, n_b, &
         k, r, energy, section_forces, strain, b, length)
      !f2py threadsafe
      !> Number of elements
      integer(c_int), intent(in) :: n
      !> Present positions of the nodes (3, 2, n) [m]
      real(c_double), intent(in) :: x(3, 2, n)
      !> Present triads of the nodes (3, 3, 2, n): columns tangent, first, second section axis
      real(c_double), intent(in) :: triads(3, 3, 2, n)
      !> Stress-free positions of the nodes (3, 2, n) [m]
      real(c_double), intent(in) :: x0(3, 2, n)
      !> Stress-free triads of the nodes (3, 3, 2, n)
      real(c_double), intent(in) :: triads0(3, 3, 2, n)
      !> EA, GA2, GA3 [N], GJ, EI2, EI3 [N m^2] (6, n)
      real(c_double), intent(in) :: stiffness(6, n)
      !> Axial strains of the stress-free state, as from temperature (n)
      real(c_double), intent(in) :: stress_free_strain(n)
      !> Section forces (6, n) [N, N m] for the geometric part of the tangent
      real(c_double), intent(in) :: sigma(6, n)
      !> .true.: `sigma` counts; .false.: those of the present state do
      logical, intent(in) :: given_sigma
      !> .true.: tangent in the spin form; .false.: in the Hessian form
      logical, intent(in) :: spin
      !> Number of tangents, and of derivatives of the strains: n, or 0 where they are not wanted
      integer(c_int), intent(in) :: n_k, n_b
      !> Tangents (12, 12, n_k) [N/m, N, N m]
      real(c_double), intent(out) :: k(12, 12, n_k)
      !> Residuals (12, n) [N, N m]
      real(c_double), intent(out) :: r(12, n)
      !> Elastic energies (n) [J]
      real(c_double), intent(out) :: energy(n)
      !> N, Q2, Q3 [N], T, M2, M3 [N m] (6, n)
      real(c_double), intent(out) :: section_forces(6, n)
      !> Strains that belong to the section forces (6, n) [-, 1/m]
      real(c_double), intent(out) :: strain(6, n)
      !> Derivatives of the strains with respect to the unknowns (6, 12, n_b)
      real(c_double), intent(out) :: b(6, 12, n_b)
      !> Reference lengths (n) [m]
      real(c_double), intent(out) :: length(n)
      real(c_double) :: strain0(6), tangent(12, 12), dstrain(6, 12)
      integer :: i

      !$omp parallel do schedule(static) private(strain0, tangent, dstrain) if (n >= least_elements)
      do i = 1, n
         call b31_reference(x0(:, :, i), triads0(:, :, :, i), length(i), strain0)
         strain0(1) = strain0(1) + stress_free_strain(i)
         if (given_sigma) then
            call b31(x(:, :, i), triads(:, :, :, i), length(i), strain0, stiffness(:, i), tangent, r(:, i), energy(i), &
               section_forces(:, i), strain(:, i), dstrain, sigma(:, i))
         else
            call b31(x(:, :, i), triads(:, :, :, i), length(i), strain0, stiffness(:, i), tangent, r(:, i), energy(i), &
               section_forces(:, i), strain(:, i), dstrain)
         end if
         if (spin) call hessian_to_spin(tangent, r(:, i), [4, 10])
         if (i <= n_k) k(:, :, i) = tangent
         if (i <= n_b) b(:, :, i) = dstrain
      end do
   end subroutine beam_b31

   subroutine beam_b33(n, x, triads, x0, triads0, stiffness, stress_free_strain, sigma, given_sigma, spin, n_k, n_b, &
         k, r, energy, section_forces, strain, b, length)
      !f2py threadsafe
      !> Number of elements
      integer(c_int), intent(in) :: n
      !> Present positions of the nodes (3, 2, n) [m]
      real(c_double), intent(in) :: x(3, 2, n)
      !> Present triads of the nodes (3, 3, 2, n): columns tangent, first, second section axis
      real(c_double), intent(in) :: triads(3, 3, 2, n)
      !> Stress-free positions of the nodes (3, 2, n) [m]
      real(c_double), intent(in) :: x0(3, 2, n)
      !> Stress-free triads of the nodes (3, 3, 2, n)
      real(c_double), intent(in) :: triads0(3, 3, 2, n)
      !> EA, GA2, GA3 [N], GJ, EI2, EI3 [N m^2] (6, n)
      real(c_double), intent(in) :: stiffness(6, n)
      !> Axial strains of the stress-free state, as from temperature (n)
      real(c_double), intent(in) :: stress_free_strain(n)
      !> Section forces (6, n) [N, N m] for the geometric part of the tangent
      real(c_double), intent(in) :: sigma(6, n)
      !> .true.: `sigma` counts; .false.: those of the present state do
      logical, intent(in) :: given_sigma
      !> .true.: tangent in the spin form; .false.: in the Hessian form
      logical, intent(in) :: spin
      !> Number of tangents, and of derivatives of the strains: n, or 0 where they are not wanted
      integer(c_int), intent(in) :: n_k, n_b
      !> Tangents (12, 12, n_k) [N/m, N, N m]
      real(c_double), intent(out) :: k(12, 12, n_k)
      !> Residuals (12, n) [N, N m]
      real(c_double), intent(out) :: r(12, n)
      !> Elastic energies (n) [J]
      real(c_double), intent(out) :: energy(n)
      !> N, Q2, Q3 [N], T, M2, M3 [N m] (6, n)
      real(c_double), intent(out) :: section_forces(6, n)
      !> Strains that belong to the section forces (6, n) [-, 1/m]
      real(c_double), intent(out) :: strain(6, n)
      !> Derivatives of the strains with respect to the unknowns (6, 12, n_b)
      real(c_double), intent(out) :: b(6, 12, n_b)
      !> Reference lengths (n) [m]
      real(c_double), intent(out) :: length(n)
      real(c_double) :: strain0(6), tangent(12, 12), dstrain(6, 12)
      integer :: i

      !$omp parallel do schedule(static) private(strain0, tangent, dstrain) if (n >= least_elements)
      do i = 1, n
         call b33_reference(x0(:, :, i), triads0(:, :, :, i), length(i), strain0)
         strain0(1) = strain0(1) + stress_free_strain(i)
         if (given_sigma) then
            call b33(x(:, :, i), triads(:, :, :, i), length(i), strain0, stiffness(:, i), tangent, r(:, i), energy(i), &
               section_forces(:, i), strain(:, i), dstrain, sigma(:, i))
         else
            call b33(x(:, :, i), triads(:, :, :, i), length(i), strain0, stiffness(:, i), tangent, r(:, i), energy(i), &
               section_forces(:, i), strain(:, i), dstrain)
         end if
         if (spin) call hessian_to_spin(tangent, r(:, i), [4, 10])
         if (i <= n_k) k(:, :, i) = tangent
         if (i <= n_b) b(:, :, i) = dstrain
      end do
   end subroutine beam_b33

   subroutine forces_by_temperature(n, length, rigidity, drigidity, strain, dstress_free, b, dr)
      !> Number of elements
      integer(c_int), intent(in) :: n
      !> Reference lengths (n) [m]
      real(c_double), intent(in) :: length(n)
      !> What multiplies the strains in the section forces (6, n)
      real(c_double), intent(in) :: rigidity(6, n)
      !> Its derivative by the temperature (6, n)
      real(c_double), intent(in) :: drigidity(6, n)
      !> Strains against the stress-free state (6, n)
      real(c_double), intent(in) :: strain(6, n)
      !> Derivatives of the axial strain of the stress-free state by the temperature (n) [1/K]
      real(c_double), intent(in) :: dstress_free(n)
      !> Derivatives of the strains by displacements and spins (6, 12, n)
      real(c_double), intent(in) :: b(6, 12, n)
      !> Derivatives of the internal forces [N/K, N m/K] (12, n)
      real(c_double), intent(out) :: dr(12, n)
      integer :: i

      do i = 1, n
         dr(:, i) = core_forces_by_temperature(length(i), rigidity(:, i), drigidity(:, i), strain(:, i), &
            dstress_free(i), b(:, :, i))
      end do
   end subroutine forces_by_temperature

   subroutine conductor(n, x, v, length, area, resistivity, current_length, k, r, k_me, current, heat)
      !> Number of elements
      integer(c_int), intent(in) :: n
      !> Present positions of the nodes (3, 2, n) [m]
      real(c_double), intent(in) :: x(3, 2, n)
      !> Voltages of the nodes (2, n) [V]
      real(c_double), intent(in) :: v(2, n)
      !> Reference lengths (n) [m]
      real(c_double), intent(in) :: length(n)
      !> Cross-sections (n) [m^2]
      real(c_double), intent(in) :: area(n)
      !> Resistivities (n) [ohm m]
      real(c_double), intent(in) :: resistivity(n)
      !> .true.: conduction over the present length
      logical, intent(in) :: current_length
      !> Derivatives of the residuals with respect to the voltages (2, 2, n) [S]
      real(c_double), intent(out) :: k(2, 2, n)
      !> Currents that leave the nodes (2, n) [A]
      real(c_double), intent(out) :: r(2, n)
      !> Derivatives of the residuals with respect to the positions (2, 6, n) [A/m]
      real(c_double), intent(out) :: k_me(2, 6, n)
      !> Currents from node 1 to node 2 (n) [A]
      real(c_double), intent(out) :: current(n)
      !> Joule heat (n) [W]
      real(c_double), intent(out) :: heat(n)
      integer :: i

      do i = 1, n
         call core_conductor(x(:, :, i), v(:, i), length(i), area(i), resistivity(i), current_length, k(:, :, i), &
            r(:, i), k_me(:, :, i), current(i), heat(i))
      end do
   end subroutine conductor

   subroutine potential_rise(n_contacts, n, scale, xi, current, rise)
      !> Number of contacts on an element, and of elements
      integer(c_int), intent(in) :: n_contacts, n
      !> Resistivities times length over 4 areas (n) [ohm]
      real(c_double), intent(in) :: scale(n)
      !> Places of the contacts (n_contacts, n)
      real(c_double), intent(in) :: xi(n_contacts, n)
      !> Currents that enter there (n_contacts, n) [A]
      real(c_double), intent(in) :: current(n_contacts, n)
      !> Rise of the potential above the linear one at each contact (n_contacts, n) [V]
      real(c_double), intent(out) :: rise(n_contacts, n)
      integer :: i

      do i = 1, n
         call core_potential_rise(scale(i), 0.0_c_double, xi(:, i), current(:, i), rise(:, i))
      end do
   end subroutine potential_rise

end module f2py_beams
