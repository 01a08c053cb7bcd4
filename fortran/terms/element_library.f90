!> The one place that knows which kernel belongs to which element type.
module litz_element_library
   use litz_kinds, only: dp
   use litz_beam_b31, only: beam_b31, beam_b31_reference, beam_b31_rigidities
   use litz_beam_b33, only: beam_b33, beam_b33_reference, beam_b33_rigidities
   use litz_element_types, only: element_types, element_b31, element_b33
   use litz_model, only: model_t
   use litz_wires, only: wires_t
   implicit none
   private
   public :: elements_t, prepare_elements, evaluate_beam

   !> What stays the same for each element during a run.
   type :: elements_t
      !> Reference lengths (n_elements) [m]
      real(dp), allocatable :: length(:)
      !> Strains of the stress-free reference (6, n_elements)
      real(dp), allocatable :: strain0(:, :)
      !> EA, GA2, GA3, GJ, EI2, EI3 (6, n_elements) [N, N m^2]
      real(dp), allocatable :: stiffness(:, :)
      !> Section forces per strain of the element's own strain measures (6, n_elements)
      real(dp), allocatable :: rigidity(:, :)
      !> Resistivity (n_elements) [ohm m]; 0 where there is no electric field
      real(dp), allocatable :: resistivity(:)
      !> Area and contact radius (n_elements) [m^2, m]
      real(dp), allocatable :: area(:), radius(:)
      !> The centre line may be turned against the normals of the sections (n_elements)
      logical, allocatable :: shear_flexible(:)
   end type elements_t

   !> The procedures of a kernel.
   type :: beam_t
      procedure(beam_reference), pointer, nopass :: reference => null()
      procedure(beam_rigidities), pointer, nopass :: rigidities => null()
      procedure(beam_forces), pointer, nopass :: evaluate => null()
   end type beam_t

   abstract interface
      !> Length and strains of the stress-free state.
      pure subroutine beam_reference(x0, triads0, length, strain0)
         import :: dp
         implicit none
         !> Nodal positions (3, node) [m], and triads (3, axis, node): tangent, first, second section axis
         real(dp), intent(in) :: x0(3, 2), triads0(3, 3, 2)
         !> Length of the axis [m], and strains (6)
         real(dp), intent(out) :: length, strain0(6)
      end subroutine beam_reference

      !> What multiplies the strains in the section forces.
      pure function beam_rigidities(stiffness, length) result(c)
         import :: dp
         implicit none
         !> EA, GA2, GA3, GJ, EI2, EI3 (6) [N, N m^2], and reference length [m]
         real(dp), intent(in) :: stiffness(6), length
         !> Rigidities (6), in the order of the strains
         real(dp) :: c(6)
      end function beam_rigidities

      !> Residual, tangent, energy and section forces.
      pure subroutine beam_forces(x, triads, length, strain0, stiffness, k, r, energy, section_forces, strain, b, sigma)
         import :: dp
         implicit none
         !> Nodal positions (3, node) [m], and triads (3, axis, node): tangent, first, second section axis
         real(dp), intent(in) :: x(3, 2), triads(3, 3, 2)
         !> Reference length [m], and strains of the stress-free state (6)
         real(dp), intent(in) :: length, strain0(6)
         !> EA, GA2, GA3, GJ, EI2, EI3 (6) [N, N m^2]
         real(dp), intent(in) :: stiffness(6)
         !> Tangent in the Hessian form (12, 12), residual (12) [N, N m], and strain energy [J]
         real(dp), intent(out) :: k(12, 12), r(12), energy
         !> N, Q2, Q3, T, M2, M3 (6) [N, N m]; strains against the stress-free state (6), and their derivatives by
         !> displacements and spins (6, 12)
         real(dp), intent(out) :: section_forces(6), strain(6), b(6, 12)
         !> Section forces that the geometric part of `k` takes instead of those of the strains (6) [N, N m]
         real(dp), intent(in), optional :: sigma(6)
      end subroutine beam_forces
   end interface

contains

   !> The kernel of a type. A new one is registered here.
   pure type(beam_t) function beam_of(element_type) result(beam)
      !> One of `element_types`
      integer, intent(in) :: element_type

      select case (element_type)
      case (element_b31)
         beam = beam_t(beam_b31_reference, beam_b31_rigidities, beam_b31)
      case (element_b33)
         beam = beam_t(beam_b33_reference, beam_b33_rigidities, beam_b33)
      end select
   end function beam_of

   subroutine prepare_elements(model, wires, elements)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(out) :: elements
      type(beam_t) :: beam
      integer :: e, n

      n = model%n_elements
      allocate (elements%length(n), elements%strain0(6, n), elements%stiffness(6, n), elements%rigidity(6, n), &
         elements%resistivity(n), elements%area(n), elements%radius(n), elements%shear_flexible(n))
      do e = 1, n
         associate (section => model%sections(model%element_section(e)), x0 => model%x(:, model%connectivity(:, e)))
            associate (material => model%materials(section%material))
               elements%stiffness(:, e) = [material%young*section%area, section%ga2, section%ga3, &
                  material%young/(2*(1 + material%poisson))*section%j, material%young*section%i2, &
                  material%young*section%i3]
               elements%resistivity(e) = 0
               if (material%conductivity > 0) elements%resistivity(e) = 1/material%conductivity
            end associate
            elements%area(e) = section%area
            elements%radius(e) = section%contact_radius
            elements%shear_flexible(e) = element_types(model%element_type(e))%shear_flexible
            beam = beam_of(model%element_type(e))
            call beam%reference(x0, wires%triads0(:, :, :, e), elements%length(e), elements%strain0(:, e))
            elements%rigidity(:, e) = beam%rigidities(elements%stiffness(:, e), elements%length(e))
         end associate
      end do
   end subroutine prepare_elements

   !> Tangent (Hessian form) and residual of one beam; arguments as in the kernels.
   pure subroutine evaluate_beam(element_type, elements, e, x, triads, sigma, k, r, energy, section_forces, strain, b)
      !> One of `element_types`
      integer, intent(in) :: element_type
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      !> Nodal positions (3, 2) [m] and triads of the sections (3, 3, 2)
      real(dp), intent(in) :: x(3, 2), triads(3, 3, 2)
      !> Section forces of the geometric stiffness (6): the independent ones of the mixed iteration
      real(dp), intent(in), optional :: sigma(6)
      !> Tangent (12, 12), residual (12) [N, N m], and strain energy [J]
      real(dp), intent(out) :: k(12, 12), r(12), energy
      !> Section forces (6) [N, N m], strains (6) [1, 1/m], and their derivatives by the displacements (6, 12)
      real(dp), intent(out) :: section_forces(6), strain(6), b(6, 12)
      type(beam_t) :: beam

      beam = beam_of(element_type)
      associate (length => elements%length(e), strain0 => elements%strain0(:, e), stiffness => elements%stiffness(:, e))
         call beam%evaluate(x, triads, length, strain0, stiffness, k, r, energy, section_forces, strain, b, sigma)
      end associate
   end subroutine evaluate_beam

end module litz_element_library
