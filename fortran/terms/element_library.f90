!> The one place that knows which kernel belongs to which element type.
module litz_element_library
   use litz_kinds, only: dp
   use litz_beam_axes, only: beam_axes_t, beam_axes_of, axis_of_beam, forces_at_nodes, forces_of_axis, add_eccentricity
   use litz_beam_b31, only: beam_b31, beam_b31_reference, beam_b31_rigidities
   use litz_beam_b33, only: beam_b33, beam_b33_reference, beam_b33_rigidities
   use litz_element_types, only: element_types, element_b31, element_b33
   use litz_fields, only: field_temperature
   use litz_material_properties, only: has_thermal_mechanics, has_thermal_resistivity, elasticity_at, &
      elasticity_slope, thermal_strain, thermal_strain_slope
   use litz_model, only: model_t
   use litz_property_table, only: property_at
   use litz_section_stiffness, only: section_stiffness, section_stiffness_slope
   use litz_wires, only: wires_t
   implicit none
   private
   public :: along_element
   public :: elements_t, heated_beam_t, prepare_elements, heat_elements, beam_at_temperature, beam_by_temperature, &
      end_swelling, radius_by_temperature, modulus_by_temperature, material_at, material_place_t, evaluate_beam

   !> What stays the same for each element during a run, but for what depends on its temperature.
   type :: elements_t
      !> Reference lengths (n_elements) [m]
      real(dp), allocatable :: length(:)
      !> Strains of the stress-free reference along the axis of the kernel (6, n_elements)
      real(dp), allocatable :: strain0(:, :)
      !> Where centroid and shear centre are (n_elements)
      type(beam_axes_t), allocatable :: axes(:)
      !> EA, GA2, GA3, GJ, EI2, EI3 (6, n_elements) [N, N m^2]
      real(dp), allocatable :: stiffness(:, :)
      !> Section forces per strain of the element's own strain measures (6, n_elements)
      real(dp), allocatable :: rigidity(:, :)
      !> Elements whose mechanics depends on the temperature (n), and the temperatures of the nodes of each before the
      !> first step (2, n) [K]
      integer, allocatable :: heated(:)
      real(dp), allocatable :: initial_temperature(:, :)
      !> Strains of the stress-free state from temperature, and what the expansion of the material is multiplied by for
      !> them: how they grow as the nodes move apart and their triads stay (6, n_elements)
      real(dp), allocatable :: thermal_strain(:, :), growth(:, :)
      !> Resistivity at mid length (n_elements) [ohm m]; 0 where there is no electric field
      real(dp), allocatable :: resistivity(:)
      !> Elements with superconducting filaments (n_elements)
      logical, allocatable :: superconducting(:)
      !> Elements whose resistivity depends on the temperature (n)
      integer, allocatable :: thermal_resistors(:)
      !> Present temperatures of the nodes of each element, where some element depends on them, and those that its
      !> mechanics sees (2, n_elements) [K]
      real(dp), allocatable :: temperature(:, :), mechanical_temperature(:, :)
      !> Area, and contact radius at mid length (n_elements) [m^2, m]
      real(dp), allocatable :: area(:), radius(:)
      !> How much larger the contact radius is at the second node than at mid length, linear in between (n_elements) [m]
      real(dp), allocatable :: taper(:)
      !> The centre line may be turned against the normals of the sections (n_elements)
      logical, allocatable :: shear_flexible(:)
   end type elements_t

   !> What depends on the temperature in the mechanics of an element.
   type :: heated_beam_t
      !> As in `elements_t` (6)
      real(dp) :: stiffness(6) = 0, rigidity(6) = 0, thermal_strain(6) = 0
   end type heated_beam_t

   !> The material at a place of a wire.
   type :: material_place_t
      !> E [Pa], nu [-] and rho [ohm m]; 0: no electric field
      real(dp) :: young = 0, poisson = 0, resistivity = 0
      !> Derivative of rho by the temperature, and of the temperature by the place xi [ohm m/K, K]
      real(dp) :: dresistivity = 0, dtemperature = 0
   end type material_place_t

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
      real(dp) :: x0(3, 2), triads0(3, 3, 2)
      integer :: e, n

      n = model%n_elements
      allocate (elements%axes(n), elements%length(n), elements%strain0(6, n), elements%stiffness(6, n), &
         elements%rigidity(6, n), elements%resistivity(n), elements%area(n), elements%radius(n), &
         elements%shear_flexible(n), elements%growth(6, n))
      allocate (elements%thermal_strain(6, n), source=0.0_dp)
      allocate (elements%taper(n), source=0.0_dp)
      do e = 1, n
         associate (section => model%sections(model%element_section(e)))
            associate (material => model%materials(section%material))
               elements%stiffness(:, e) = section_stiffness(section, material%young, material%poisson)
               elements%resistivity(e) = 0
               if (material%conductivity > 0) elements%resistivity(e) = 1/material%conductivity
            end associate
            elements%area(e) = section%area
            elements%radius(e) = section%contact_radius
            elements%shear_flexible(e) = element_types(model%element_type(e))%shear_flexible
            beam = beam_of(model%element_type(e))
            elements%axes(e) = beam_axes_of(section)
            x0 = model%x(:, model%connectivity(:, e))
            triads0 = wires%triads0(:, :, :, e)
            call axis_of_beam(elements%axes(e), x0, triads0)
            call beam%reference(x0, triads0, elements%length(e), elements%strain0(:, e))
            elements%rigidity(:, e) = beam%rigidities(elements%stiffness(:, e), elements%length(e))
            elements%growth(:, e) = growth_of(beam, elements, e, x0, triads0, model%x(:, model%connectivity(2, e)) &
               - model%x(:, model%connectivity(1, e)))
         end associate
      end do
      elements%superconducting = [(allocated(model%materials(model%sections(model%element_section(e))%material) &
         %superconductor), e=1, n)]
      elements%heated = pack([(e, e=1, n)], [(has_thermal_mechanics(model%materials(model%sections( &
         model%element_section(e))%material)), e=1, n)])
      allocate (elements%initial_temperature(2, size(elements%heated)))
      elements%thermal_resistors = pack([(e, e=1, n)], [(has_thermal_resistivity(model%materials(model%sections( &
         model%element_section(e))%material)), e=1, n)])
      allocate (elements%temperature(2, n), elements%mechanical_temperature(2, n), source=0.0_dp)
   end subroutine prepare_elements

   !> How the strains of the stress-free state grow with the distances of a body that grows alike everywhere: those of
   !> its nodes. Where the axis lies on rigid arms, its length is another one.
   pure function growth_of(beam, elements, e, x, triads, chord) result(growth)
      type(beam_t), intent(in) :: beam
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      !> Axis of the kernel in the stress-free state: its ends (3, 2) [m], and their triads (3, 3, 2)
      real(dp), intent(in) :: x(3, 2), triads(3, 3, 2)
      !> From the first node to the second (3) [m]
      real(dp), intent(in) :: chord(3)
      real(dp) :: growth(6)
      real(dp) :: k(12, 12), r(12), energy, section_forces(6), strain(6), b(6, 12)

      call beam%evaluate(x, triads, elements%length(e), elements%strain0(:, e), elements%stiffness(:, e), k, r, &
         energy, section_forces, strain, b)
      growth = matmul(b(:, 7:9), chord)
   end function growth_of

   !> Properties at the present temperatures; the mechanics is that of the last motions where these are held.
   subroutine heat_elements(model, temperature, mechanical_temperature, elements)
      type(model_t), intent(in) :: model
      !> Present ones, and those that the mechanics sees (n_nodes) [K]
      real(dp), intent(in) :: temperature(:), mechanical_temperature(:)
      type(elements_t), intent(inout) :: elements
      type(heated_beam_t) :: beam
      real(dp) :: mean, swelling(2), slope
      integer :: i

      if (size(elements%heated) + size(elements%thermal_resistors) == 0 &
         .and. .not. model%has_field(field_temperature)) return
      elements%temperature = by_element(temperature)
      elements%mechanical_temperature = by_element(mechanical_temperature)
      do i = 1, size(elements%thermal_resistors)
         associate (e => elements%thermal_resistors(i))
            call property_at(model%materials(model%sections(model%element_section(e))%material)%resistivity, &
               sum(elements%temperature(:, e))/2, elements%resistivity(e), slope)
         end associate
      end do
      do i = 1, size(elements%heated)
         associate (e => elements%heated(i))
            mean = sum(elements%mechanical_temperature(:, e))/2
            beam = beam_at_temperature(model, elements, i, mean)
            elements%stiffness(:, e) = beam%stiffness
            elements%rigidity(:, e) = beam%rigidity
            elements%thermal_strain(:, e) = beam%thermal_strain
            associate (section => model%sections(model%element_section(e)))
               swelling = end_swelling(model, elements, i, mechanical_temperature)
               elements%radius(e) = section%contact_radius + sum(swelling)/2
               elements%taper(e) = (swelling(2) - swelling(1))/2
            end associate
         end associate
      end do

   contains

      pure function by_element(nodal) result(values)
         !> (n_nodes)
         real(dp), intent(in) :: nodal(:)
         real(dp) :: values(2, model%n_elements)

         values = reshape(nodal(reshape(model%connectivity, [size(model%connectivity)])), shape(values))
      end function by_element

   end subroutine heat_elements

   !> The material of a wire at a place of it: its resistivity at the present temperature there, its elasticity at the
   !> one that the mechanics sees.
   pure type(material_place_t) function material_at(model, elements, e, xi, temperature) result(there)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      !> Place in [-1, 1]
      real(dp), intent(in) :: xi
      !> Of the nodes, instead of both (n_nodes) [K]
      real(dp), intent(in), optional :: temperature(:)
      real(dp) :: elasticity(2), t(2), t_mechanical(2)

      t = elements%temperature(:, e)
      t_mechanical = elements%mechanical_temperature(:, e)
      if (present(temperature)) then
         t = temperature(model%connectivity(:, e))
         t_mechanical = t
      end if
      associate (material => model%materials(model%sections(model%element_section(e))%material))
         elasticity = elasticity_at(material, along_element(t_mechanical, xi))
         there%young = elasticity(1)
         there%poisson = elasticity(2)
         there%dtemperature = (t(2) - t(1))/2
         there%resistivity = elements%resistivity(e)
         if (has_thermal_resistivity(material)) call property_at(material%resistivity, along_element(t, xi), &
            there%resistivity, there%dresistivity)
      end associate
   end function material_at

   !> A value at a place of an element, linear between its nodes.
   pure real(dp) function along_element(ends, xi)
      !> Values at both nodes (2), and place in [-1, 1]
      real(dp), intent(in) :: ends(2), xi

      along_element = ((1 - xi)*ends(1) + (1 + xi)*ends(2))/2
   end function along_element

   !> What temperature adds to the contact radius at both nodes [m].
   pure function end_swelling(model, elements, i, temperature) result(swelling)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> Place among `elements%heated`
      integer, intent(in) :: i
      !> (n_nodes) [K]
      real(dp), intent(in) :: temperature(:)
      real(dp) :: swelling(2)
      integer :: k

      associate (e => elements%heated(i))
         associate (section => model%sections(model%element_section(e)), nodes => model%connectivity(:, e))
            swelling = [(section%contact_radius*thermal_strain(model%materials(section%material), &
               temperature(nodes(k)), elements%initial_temperature(k, i)), k=1, 2)]
         end associate
      end associate
   end function end_swelling

   !> The mechanics of an element at a temperature.
   pure type(heated_beam_t) function beam_at_temperature(model, elements, i, temperature) result(heated)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> Place among `elements%heated`
      integer, intent(in) :: i
      !> Mean of its nodes [K]
      real(dp), intent(in) :: temperature
      type(beam_t) :: beam
      real(dp) :: elasticity(2)

      associate (e => elements%heated(i))
         associate (section => model%sections(model%element_section(e)))
            elasticity = elasticity_at(model%materials(section%material), temperature)
            heated%stiffness = section_stiffness(section, elasticity(1), elasticity(2))
            heated%thermal_strain = elements%growth(:, e)*thermal_strain(model%materials(section%material), &
               temperature, sum(elements%initial_temperature(:, i))/2)
         end associate
         beam = beam_of(model%element_type(e))
         heated%rigidity = beam%rigidities(heated%stiffness, elements%length(e))
      end associate
   end function beam_at_temperature

   !> How the mechanics of an element changes with the mean temperature of its nodes [1/K].
   pure type(heated_beam_t) function beam_by_temperature(model, elements, e) result(slope)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      type(beam_t) :: beam
      real(dp) :: elasticity(2), change(2), mean

      mean = sum(elements%mechanical_temperature(:, e))/2
      associate (section => model%sections(model%element_section(e)))
         associate (material => model%materials(section%material))
            elasticity = elasticity_at(material, mean)
            change = elasticity_slope(material, mean)
            slope%stiffness = section_stiffness_slope(section, elasticity(1), elasticity(2), change(1), change(2))
            slope%thermal_strain = elements%growth(:, e)*thermal_strain_slope(material, mean)
         end associate
      end associate
      ! linear in the stiffnesses
      beam = beam_of(model%element_type(e))
      slope%rigidity = beam%rigidities(slope%stiffness, elements%length(e))
   end function beam_by_temperature

   !> How the contact radius at a place of an element changes with the temperatures of its nodes (2) [m/K].
   pure function radius_by_temperature(model, elements, e, xi) result(slope)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      !> Place in [-1, 1]
      real(dp), intent(in) :: xi
      real(dp) :: slope(2)
      integer :: k

      associate (section => model%sections(model%element_section(e)))
         slope = section%contact_radius*[1 - xi, 1 + xi]/2*[(thermal_strain_slope(model%materials(section%material), &
            elements%mechanical_temperature(k, e)), k=1, 2)]
      end associate
   end function radius_by_temperature

   !> How `(1 - nu^2)/E` at a place of an element changes with the temperatures of its nodes (2) [1/(Pa K)].
   pure function modulus_by_temperature(model, elements, e, xi) result(slope)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      !> Place in [-1, 1]
      real(dp), intent(in) :: xi
      real(dp) :: slope(2), elasticity(2), change(2), temperature

      temperature = along_element(elements%mechanical_temperature(:, e), xi)
      associate (material => model%materials(model%sections(model%element_section(e))%material))
         elasticity = elasticity_at(material, temperature)
         change = elasticity_slope(material, temperature)
      end associate
      associate (young => elasticity(1), poisson => elasticity(2))
         slope = -(2*poisson*change(2) + (1 - poisson**2)*change(1)/young)/young*[1 - xi, 1 + xi]/2
      end associate
   end function modulus_by_temperature

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
      if (elements%axes(e)%plain) then
         call beam%evaluate(x, triads, elements%length(e), stress_free(elements, e), elements%stiffness(:, e), k, r, &
            energy, section_forces, strain, b, sigma)
      else
         call evaluate_beside(beam, elements, e, x, triads, sigma, k, r, energy, section_forces, strain, b)
      end if
   end subroutine evaluate_beam

   !> The kernel along the line of shear centres, strains along that of centroids.
   pure subroutine evaluate_beside(beam, elements, e, x, triads, sigma, k, r, energy, section_forces, strain, b)
      type(beam_t), intent(in) :: beam
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      !> As in `evaluate_beam`: those of the nodes
      real(dp), intent(in) :: x(3, 2), triads(3, 3, 2)
      !> Section forces of the geometric stiffness (6) [N, N m]
      real(dp), intent(in), optional :: sigma(6)
      !> Tangent (12, 12), residual (12) [N, N m], and strain energy [J], of the nodes
      real(dp), intent(out) :: k(12, 12), r(12), energy
      !> As in `evaluate_beam`, at the centres of the section and along its principal axes
      real(dp), intent(out) :: section_forces(6), strain(6), b(6, 12)
      real(dp) :: x_axis(3, 2), triads_axis(3, 3, 2), s(6), force(6, 2)

      x_axis = x
      triads_axis = triads
      associate (axes => elements%axes(e), length => elements%length(e), rigidity => elements%rigidity(:, e), &
         stiffness => elements%stiffness(:, e))
         call axis_of_beam(axes, x_axis, triads_axis)
         if (present(sigma)) then
            s = sigma
         else
            call beam%evaluate(x_axis, triads_axis, length, stress_free(elements, e), stiffness, k, r, energy, &
               section_forces, strain, b)
            call add_eccentricity(axes, length, rigidity(1), k, r, energy, section_forces, strain, b)
            s = section_forces
         end if
         call beam%evaluate(x_axis, triads_axis, length, stress_free(elements, e), stiffness, k, r, energy, &
            section_forces, strain, b, forces_of_axis(axes, s))
         call add_eccentricity(axes, length, rigidity(1), k, r, energy, section_forces, strain, b)
         force = reshape(length*matmul(s, b), [6, 2])
         call forces_at_nodes(axes, triads, force(1:3, :), k, r, b)
      end associate
   end subroutine evaluate_beside

   !> Strains of the stress-free state at the present temperature (6).
   pure function stress_free(elements, e) result(strain)
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      real(dp) :: strain(6)

      strain = elements%strain0(:, e) + elements%thermal_strain(:, e)
   end function stress_free

end module litz_element_library
