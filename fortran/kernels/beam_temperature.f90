!> How the internal forces of a beam change with its temperature, where nothing moves.
!>
!>     R = L0 B^T C e,   dR/dT = L0 B^T (C' e - C e_T')                                                          (1)
!>
!> with the strains `e` against the stress-free state, whose axial strain is `e_T`. Source: theory section 14.
module litz_beam_temperature
   use litz_kinds, only: dp
   implicit none
   private
   public :: forces_by_temperature

contains

   !> Source: (1).
   pure function forces_by_temperature(length, rigidity, drigidity, strain, dstress_free, b) result(dr)
      !> Reference length [m]
      real(dp), intent(in) :: length
      !> What multiplies the strains in the section forces, and its derivative by the temperature (6)
      real(dp), intent(in) :: rigidity(6), drigidity(6)
      !> Strains against the stress-free state (6)
      real(dp), intent(in) :: strain(6)
      !> Derivative of the axial strain of the stress-free state by the temperature [1/K]
      real(dp), intent(in) :: dstress_free
      !> Derivatives of the strains by displacements and spins (6, 12)
      real(dp), intent(in) :: b(6, 12)
      !> [N/K, N m/K]
      real(dp) :: dr(12)
      real(dp) :: dsection_forces(6)

      dsection_forces = drigidity*strain
      dsection_forces(1) = dsection_forces(1) - rigidity(1)*dstress_free
      dr = length*matmul(dsection_forces, b)                                                                  ! (1)
   end function forces_by_temperature

end module litz_beam_temperature
