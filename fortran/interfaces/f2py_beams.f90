! Beams and conductor for Python; the contracts are in fortran/kernels/beam_b31.f90, beam_b33.f90, conductor.f90 and
! potential_rise.f90.
! Stress-free state and current state go in together; `spin` asks for the spin form of the tangent, `given_sigma` says
! whether `sigma` counts.
module f2py_beams
   use iso_c_binding, only: c_double, c_int
   use litz_beam_b31, only: b31 => beam_b31, b31_reference => beam_b31_reference
   use litz_beam_b33, only: b33 => beam_b33, b33_reference => beam_b33_reference
   use litz_conductor, only: core_conductor => conductor
   use litz_potential_rise, only: core_potential_rise => potential_rise
   use litz_rotation_forms, only: hessian_to_spin
   implicit none
contains

   subroutine beam_b31(x, triads, x0, triads0, stiffness, sigma, given_sigma, spin, &
         k, r, energy, section_forces, strain, b, length)
      real(c_double), intent(in) :: x(3, 2), triads(3, 3, 2), x0(3, 2), triads0(3, 3, 2), stiffness(6), sigma(6)
      logical, intent(in) :: given_sigma, spin
      real(c_double), intent(out) :: k(12, 12), r(12), energy, section_forces(6), strain(6), b(6, 12), length
      real(c_double) :: strain0(6)

      call b31_reference(x0, triads0, length, strain0)
      if (given_sigma) then
         call b31(x, triads, length, strain0, stiffness, k, r, energy, section_forces, strain, b, sigma)
      else
         call b31(x, triads, length, strain0, stiffness, k, r, energy, section_forces, strain, b)
      end if
      if (spin) call hessian_to_spin(k, r, [4, 10])
   end subroutine beam_b31

   subroutine beam_b33(x, triads, x0, triads0, stiffness, sigma, given_sigma, spin, &
         k, r, energy, section_forces, strain, b, length)
      real(c_double), intent(in) :: x(3, 2), triads(3, 3, 2), x0(3, 2), triads0(3, 3, 2), stiffness(6), sigma(6)
      logical, intent(in) :: given_sigma, spin
      real(c_double), intent(out) :: k(12, 12), r(12), energy, section_forces(6), strain(6), b(6, 12), length
      real(c_double) :: strain0(6)

      call b33_reference(x0, triads0, length, strain0)
      if (given_sigma) then
         call b33(x, triads, length, strain0, stiffness, k, r, energy, section_forces, strain, b, sigma)
      else
         call b33(x, triads, length, strain0, stiffness, k, r, energy, section_forces, strain, b)
      end if
      if (spin) call hessian_to_spin(k, r, [4, 10])
   end subroutine beam_b33

   subroutine conductor(x, v, length, area, resistivity, current_length, k, r, k_me, current, heat)
      real(c_double), intent(in) :: x(3, 2), v(2), length, area, resistivity
      logical, intent(in) :: current_length
      real(c_double), intent(out) :: k(2, 2), r(2), k_me(2, 6), current, heat

      call core_conductor(x, v, length, area, resistivity, current_length, k, r, k_me, current, heat)
   end subroutine conductor

   subroutine potential_rise(n, scale, xi, current, rise)
      integer(c_int), intent(in) :: n
      real(c_double), intent(in) :: scale, xi(n), current(n)
      real(c_double), intent(out) :: rise(n)

      call core_potential_rise(scale, xi, current, rise)
   end subroutine potential_rise

end module f2py_beams
