!> B31: two-node, geometrically exact, shear-flexible beam with one integration point.
!>
!> Strains `e = (gamma, psi/L0)` minus those of the stress-free state: axial, two shears, twist, two curvatures.
!> Energy `Pi = (L0/2) e.C e`, `C = diag(EA, GA2, GA3, GJ, EI2, EI3)`.
!>
!> Source: J. C. Simo, Comput. Methods Appl. Mech. Eng. 49 (1985) 55-70 (strains); strain measures by the relative
!> rotation of the nodes as in M. A. Crisfield and G. Jelenic, Proc. R. Soc. A 455 (1999) 1125-1147.
module litz_beam_b31
   use litz_kinds, only: dp
   use litz_beam_kinematics, only: chord_rotation, chord_rotation_residual, chord_rotation_rows, chord_rotation_t, &
      chord_rotation_tangent, diagonal, reference_length
   implicit none
   private
   public :: beam_b31, beam_b31_reference, beam_b31_rigidities

contains

   !> Length and strains of the stress-free state, which may be curved and twisted.
   pure subroutine beam_b31_reference(x0, triads0, length, strain0)
      !> Nodal positions (3, node) [m]
      real(dp), intent(in) :: x0(3, 2)
      !> Nodal triads (3, axis, node), axes: tangent, first, second section axis
      real(dp), intent(in) :: triads0(3, 3, 2)
      !> Length of the axis [m]
      real(dp), intent(out) :: length
      !> Strains (6) [-, 1/m]
      real(dp), intent(out) :: strain0(6)

      length = reference_length(x0, triads0)
      strain0 = strains(chord_rotation(x0, triads0, length))
   end subroutine beam_b31_reference

   !> What multiplies the strains in the section forces: the stiffness itself.
   pure function beam_b31_rigidities(stiffness, length) result(c)
      !> EA, GA2, GA3, GJ, EI2, EI3 (6) [N, N m^2]
      real(dp), intent(in) :: stiffness(6)
      !> Reference length [m]; of no influence here, kept for one interface of all beams
      real(dp), intent(in) :: length
      !> Rigidities (6), in the order of the strains
      real(dp) :: c(6)

      associate (not_needed => length)
      end associate
      c = stiffness
   end function beam_b31_rigidities

   !> Residual, tangent, energy and section forces of an element.
   pure subroutine beam_b31(x, triads, length, strain0, stiffness, k, r, energy, section_forces, strain, b, sigma)
      !> Nodal positions (3, node) [m]
      real(dp), intent(in) :: x(3, 2)
      !> Nodal triads (3, axis, node), axes: tangent, first, second section axis
      real(dp), intent(in) :: triads(3, 3, 2)
      !> Reference length [m] and strains of the stress-free state (6), from `beam_b31_reference`
      real(dp), intent(in) :: length, strain0(6)
      !> EA, GA2, GA3, GJ, EI2, EI3 (6) [N, N m^2]; index 2: bending about the first section axis
      real(dp), intent(in) :: stiffness(6)
      !> Tangent in the Hessian form (12, 12) [N/m, N, N m]; symmetric
      real(dp), intent(out) :: k(12, 12)
      !> Internal forces and moments (12) [N, N m]
      real(dp), intent(out) :: r(12)
      !> Strain energy [J]
      real(dp), intent(out) :: energy
      !> N, Q2, Q3, T, M2, M3 (6) [N, N m]; tension positive
      real(dp), intent(out) :: section_forces(6)
      !> Strains against the stress-free state (6) [-, 1/m]
      real(dp), intent(out) :: strain(6)
      !> Derivatives of the strains by displacements and spins (6, 12)
      real(dp), intent(out) :: b(6, 12)
      !> Section forces that the geometric part of `k` takes instead of those of the strains (6) [N, N m]
      real(dp), intent(in), optional :: sigma(6)
      type(chord_rotation_t) :: q
      real(dp) :: s(6)

      q = chord_rotation(x, triads, length)
      strain = strains(q) - strain0
      section_forces = stiffness*strain
      energy = length/2*dot_product(section_forces, strain)

      b = chord_rotation_rows(q)
      b(4:6, :) = b(4:6, :)/length
      r = chord_rotation_residual(q, length*section_forces(1:3), section_forces(4:6))

      s = section_forces
      if (present(sigma)) s = sigma
      k = chord_rotation_tangent(q, length*s(1:3), s(4:6), &
         length*diagonal(stiffness(1:3)), diagonal(stiffness(4:6))/length)
   end subroutine beam_b31

   pure function strains(q) result(e)
      type(chord_rotation_t), intent(in) :: q
      real(dp) :: e(6)

      e(1:3) = q%gamma
      e(4:6) = q%psi/q%length
   end function strains

end module litz_beam_b31
