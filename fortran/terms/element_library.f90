!> The one place that knows which kernel belongs to which element type.
module litz_element_library
   use litz_kinds, only: dp
   use litz_beam_b31, only: beam_b31, beam_b31_reference, beam_b31_rigidities
   use litz_beam_b33, only: beam_b33, beam_b33_reference, beam_b33_rigidities
   use litz_model, only: model_t, element_b31, element_b33
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

contains

   subroutine prepare_elements(model, wires, elements)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(out) :: elements
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
            select case (model%element_type(e))
            case (element_b31)
               elements%shear_flexible(e) = .true.
               call beam_b31_reference(x0, wires%triads0(:, :, :, e), elements%length(e), elements%strain0(:, e))
               elements%rigidity(:, e) = beam_b31_rigidities(elements%stiffness(:, e), elements%length(e))
            case (element_b33)
               elements%shear_flexible(e) = .false.
               call beam_b33_reference(x0, wires%triads0(:, :, :, e), elements%length(e), elements%strain0(:, e))
               elements%rigidity(:, e) = beam_b33_rigidities(elements%stiffness(:, e), elements%length(e))
            end select
         end associate
      end do
   end subroutine prepare_elements

   !> Tangent (Hessian form) and residual of one beam; arguments as in the kernels.
   pure subroutine evaluate_beam(element_type, elements, e, x, triads, sigma, k, r, energy, section_forces, strain, b)
      !> One of the element types of the model
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

      associate (length => elements%length(e), strain0 => elements%strain0(:, e), stiffness => elements%stiffness(:, e))
         select case (element_type)
         case (element_b31)
            call beam_b31(x, triads, length, strain0, stiffness, k, r, energy, section_forces, strain, b, sigma)
         case (element_b33)
            call beam_b33(x, triads, length, strain0, stiffness, k, r, energy, section_forces, strain, b, sigma)
         end select
      end associate
   end subroutine evaluate_beam

end module litz_element_library
