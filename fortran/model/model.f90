!> What a deck describes, resolved: indices instead of names and ids, every default filled in, nothing left to check.
!>
!> Node and element indices run from 1 without gaps; `node_id` and `element_id` hold the user's numbers.
module litz_model
   use litz_kinds, only: dp
   use litz_critical_law, only: superconductor_t
   use litz_element_loads, only: element_load_t
   use litz_fields, only: fields, n_fields, field_potential, field_temperature, group_transport
   use litz_heat_law, only: heat_law_t
   use litz_unit_labels, only: unit_labels_t
   use litz_axis_choices, only: axis_linear, axis_hermite
   use litz_normal_law, only: normal_law_t
   use litz_spot_law, only: spot_law_t
   use litz_stick_laws, only: stick_mindlin
   use litz_surface_choices, only: surface_plane
   use litz_solver_names, only: solver_default, solver_block, solver_umfpack, solver_skyline, solver_mumps
   implicit none
   private
   public :: name_length
   public :: model_t, material_t, section_t, named_set_t, amplitude_t, interaction_t, contact_pair_t
   public :: rigid_body_surface_t, surface_pair_t
   public :: step_t, nodal_value_t, element_heat_t, output_request_t, controls_t, rigid_body_t, equation_t, local_axes_t
   public :: axis_linear, axis_hermite
   public :: solver_default, solver_block, solver_umfpack, solver_skyline, solver_mumps
   public :: coupling_default, coupling_monolithic, coupling_updated, coupling_swept, coupling_full
   public :: request_node, request_element, request_contact, request_electrode, request_energy
   public :: shear_given, shear_round, shear_by_factors
   public :: dof_potential, dof_temperature, factor_at, leave_step, radius_at, radius_course, ramp_at
   public :: has_element_loads, has_superconductors, n_nodes_of_deck
   public :: solved_by_static, solved_by_heat, solved_by_all, procedure_of

   !> Longest name of a set, material, ... (longer ones are refused)
   integer, parameter :: name_length = 80

   !> Abaqus's number of the electric potential among the degrees of freedom of a node (1-3 u, 4-6 rotation)
   integer, parameter :: dof_potential = fields(field_potential)%first_dof
   integer, parameter :: dof_temperature = fields(field_temperature)%first_dof

   !> Shear stiffness: given, of a round wire, of the whole area
   integer, parameter :: shear_given = 0, shear_round = 1, shear_by_factors = 2

   !> Groups of fields in one Newton step; each after those that it depends on; or one after the other again and again,
   !> because they act back on those before them
   integer, parameter :: coupling_default = 0, coupling_monolithic = 1, coupling_updated = 2, &
      coupling_swept = 3, coupling_full = 4

   integer, parameter :: request_node = 1, request_element = 2, request_contact = 3, request_electrode = 4, &
      request_energy = 5

   !> What *STATIC, *COUPLED THERMAL-ELECTRICAL and *COUPLED TEMPERATURE-DISPLACEMENT solve for (n_fields)
   logical, parameter :: solved_by_static(n_fields) = .not. fields%is_optional
   logical, parameter :: solved_by_heat(n_fields) = fields%group == group_transport
   logical, parameter :: solved_by_all(n_fields) = .true.

   type :: named_set_t
      character(len=:), allocatable :: name
      !> Internal indices, ascending, without repetition
      integer, allocatable :: members(:)
   end type named_set_t

   type :: material_t
      character(len=:), allocatable :: name
      !> Young's modulus [Pa] and Poisson's ratio [-]
      real(dp) :: young = 0, poisson = 0
      !> Electrical conductivity [S/m], the first one of a table; 0: no electric field in elements of this material
      real(dp) :: conductivity = 0
      !> Over temperature, where there is more than one line: temperature [K], E [Pa] and nu (3, lines); the numbers
      !> above are those of the first line
      real(dp), allocatable :: elastic_table(:, :)
      !> Temperature [K] and secant coefficient of expansion [1/K] (2, lines); not there: no expansion
      real(dp), allocatable :: expansion_table(:, :)
      !> Temperature to which these coefficients refer [K]
      real(dp) :: expansion_zero = 0
      !> Temperatures [K], ascending, and resistivities [ohm m] (2, n)
      real(dp), allocatable :: resistivity(:, :)
      !> Temperatures [K], ascending, and heat conductivities [W/(m K)] (2, n); not there: no heat flows
      real(dp), allocatable :: heat_conductivity(:, :)
      !> Part of the electric power that becomes heat; mass per volume [kg/m^3], 0: not given
      real(dp) :: joule_fraction = 1, density = 0
      !> Temperatures [K], ascending, and specific heats [J/(kg K)] (2, n); not there: no heat is stored
      real(dp), allocatable :: specific_heat(:, :)
      !> Heat of changes of phase [J/kg], and the temperatures between which it is taken up [K] (3, n); not there: none
      real(dp), allocatable :: latent_heat(:, :)
      !> Filaments that superconduct; not there: none
      type(superconductor_t), allocatable :: superconductor
   end type material_t

   type :: section_t
      character(len=:), allocatable :: element_set
      !> Index into `materials`
      integer :: material = 0
      !> Radius of the round wire that touches others [m]
      real(dp) :: contact_radius = 0
      !> Cross-section area [m^2]; second moments about the principal axes and torsion constant [m^4]
      real(dp) :: area = 0, i2 = 0, i3 = 0, j = 0
      !> Angle from the first section axis to the first principal axis [rad]
      real(dp) :: turn = 0
      !> Shear centre from the node, and centroid from the shear centre, along the section axes (2) [m]
      real(dp) :: shear_centre(2) = 0, centroid(2) = 0
      !> Shear stiffnesses along the first and second principal axis [N] (used by B31), with the elasticity of the first
      !> line of *ELASTIC
      real(dp) :: ga2 = 0, ga3 = 0
      !> How these follow from the elasticity: one of `shear_...`
      integer :: shear = shear_given
      !> `shear_by_factors`: shear stiffness over G A, along the first and the second axis
      real(dp) :: shear_factor(2) = 1
      !> Factor of the stiffnesses of its beams; nothing else has it
      real(dp) :: stiffness = 1
      !> Its corners along the section axes from the centroid (2, n), where it has some, and its outer radius where
      !> it is round [m]; 0: not known
      real(dp), allocatable :: corners(:, :)
      real(dp) :: outer_radius = 0
      !> Approximate direction of the first section axis; 0 0 0: chosen by the program
      real(dp) :: n1(3) = 0
      !> Conduction along the current instead of the reference length
      logical :: current_length = .false.
   end type section_t

   !> Piecewise linear function of time; constant beyond its ends.
   type :: amplitude_t
      character(len=:), allocatable :: name
      real(dp), allocatable :: time(:), factor(:)
      !> .true.: total time, .false.: step time
      logical :: total_time = .false.
   end type amplitude_t

   type :: interaction_t
      character(len=:), allocatable :: name
      type(normal_law_t) :: normal
      !> .true.: penetration beyond the axes is accepted (soft penalties on purpose)
      logical :: unlimited_penetration = .false.
      !> Coefficient of friction; how stiff a contact sticks (place in `stick_laws`), and the number that belongs to it
      real(dp) :: friction = 0
      integer :: stick_law = stick_mindlin
      real(dp) :: stick_value = 0
      !> Number 0: no current crosses
      type(spot_law_t) :: spot
      type(heat_law_t) :: heat
      !> Interpolation of the axis that touches
      integer :: axis = axis_hermite
      !> Add the resistance that the linear voltage inside an element misses, theory section 7
      logical :: voltage_correction = .true.
      !> The spot stays as large as it has been since the contact closed or slipped
      logical :: spot_memory = .false.
      !> Spots near each other on one wire raise each other's potential
      logical :: mutual_resistance = .false.
      !> What the current heats in a spot raises its resistance, in steps that solve for temperatures
      logical :: supertemperature = .false.
   end type interaction_t

   type :: contact_pair_t
      !> Indices into `interactions` and `element_sets`; equal sets: contact within the set
      integer :: interaction = 0, set_bar = 0, set = 0
      !> Overlap in the reference configuration is meant
      logical :: interference_fit = .false.
      !> Where the pair stands in the deck, for messages
      character(len=:), allocatable :: file
      integer :: line = 0
   end type contact_pair_t

   !> Nodes that move with a reference node.
   type :: rigid_body_t
      integer :: reference_node = 0
      !> Nodes whose displacements and rotations follow it, and those whose displacements alone do; ascending
      integer, allocatable :: tied(:), pinned(:)
      !> Where it stands in the deck, for messages
      character(len=:), allocatable :: file
      integer :: line = 0
   end type rigid_body_t

   !> `sum of coefficient times degree of freedom = 0`, which eliminates the first of them.
   type :: equation_t
      !> Of each term: node, degree of freedom in Abaqus's numbers, and coefficient (terms)
      integer, allocatable :: node(:), dof(:)
      real(dp), allocatable :: coefficient(:)
      !> Where it stands in the deck, for messages
      character(len=:), allocatable :: file
      integer :: line = 0
   end type equation_t

   !> Axes of *TRANSFORM at a node. Its motions along them are those of a node of no element, which stands behind the
   !> nodes of the deck in the order of these axes, with the number and at the place of the node.
   type :: local_axes_t
      integer :: node = 0
      !> The first of its degrees of freedom that the axes are for: those before it move with a rigid body
      integer :: first_dof = 1
      !> Unit vectors, as columns
      real(dp) :: axes(3, 3) = 0
   end type local_axes_t

   !> A rigid surface in the reference configuration.
   type :: rigid_body_surface_t
      character(len=:), allocatable :: name
      !> One of litz_surface_choices
      integer :: shape = surface_plane
      !> A point of the plane or of the axis [m]; unit normal towards the wires, or unit vector along the axis
      real(dp) :: point(3) = 0, direction(3) = 0
      !> Of a cylinder or bore [m], and index of the amplitude over total time that multiplies it; 0: none
      real(dp) :: radius = 0
      integer :: radius_amplitude = 0
      !> The node that it moves with; 0: it is fixed in space
      integer :: node = 0
   end type rigid_body_surface_t

   !> Wires that may touch a rigid surface.
   type :: surface_pair_t
      !> Indices into `interactions`, `element_sets` and `surfaces`
      integer :: interaction = 0, set = 0, surface = 0
      !> Where the pair stands in the deck, for messages
      character(len=:), allocatable :: file
      integer :: line = 0
   end type surface_pair_t

   !> A prescribed value or a load at one degree of freedom of one node.
   type :: nodal_value_t
      integer :: node = 0
      !> In Abaqus's numbers, see litz_fields
      integer :: dof = 0
      real(dp) :: value = 0
      !> Index into `amplitudes`; 0: ramp over the step
      integer :: amplitude = 0
      !> Prescribed to stay what it is when the step begins, whatever the value
      logical :: stays = .false.
   end type nodal_value_t

   !> Heat that enters and leaves an element on its length.
   type :: element_heat_t
      !> *DFLUX: heat per volume [W/m^3], and what it was before the step
      real(dp) :: source = 0, source_before = 0
      !> *FILM: heat transfer coefficient [W/(m^2 K)], 0: none; temperature of the surroundings [K]
      real(dp) :: film = 0, sink = 0
      !> *RADIATE: emissivity, 0: none; temperature of the surroundings [K]
      real(dp) :: emissivity = 0, surroundings = 0
      !> What they follow, indices into `amplitudes`; 0: a source ramps over the step, the others are there at once
      integer :: source_amplitude = 0, before_amplitude = 0, film_amplitude = 0, sink_amplitude = 0, &
         surroundings_amplitude = 0
   end type element_heat_t

   !> A line of *NODE PRINT, *EL PRINT, *CONTACT PRINT or *ELECTRODE PRINT.
   type :: output_request_t
      integer :: kind = request_node
      !> Set the request is for (index into node or element sets); electrodes: the positive one
      integer :: set = 0
      !> Electrodes: the negative one
      integer :: set_2 = 0
      !> Names of the quantities, such as U, RF, CF, EPOT, RCURR
      character(len=8), allocatable :: quantities(:)
      !> .true.: the sum over the set is wanted, not every member
      logical :: totals = .false.
   end type output_request_t

   !> *CONTROLS, with the names and meanings of CalculiX.
   type :: controls_t
      !> Largest residual relative to the reference flux of the field
      real(dp) :: r_n = 1.0e-8_dp
      !> Largest correction relative to the increment of the field; 0: not asked
      real(dp) :: c_n = 0.0_dp
      !> Most iterations in an increment before it is cut, without those that only open and close contacts
      integer :: i_c = 16
      !> More iterations than this shrink the next increment
      integer :: i_l = 10
      !> Two increments with at most this many let it grow
      integer :: i_g = 6
      !> Factors of the increment: after a failed one, after a slow one, after quick ones
      real(dp) :: d_f = 0.25_dp, d_b = 0.75_dp, d_d = 1.5_dp
      !> Most cut-backs of one increment
      integer :: i_a = 8
      !> Damping of all free motion, over the least stiffness of an element; 0: none
      real(dp) :: stabilize = 0
      !> Largest nodal rotation in one iteration [rad]
      real(dp) :: rotation_cap = 0.6_dp
   end type controls_t

   type :: step_t
      character(len=:), allocatable :: title
      !> Fields that are solved for; motions that are not are held, temperatures are given (n_fields)
      logical :: solves(n_fields) = solved_by_static
      !> Fields that it or an earlier step solves for (n_fields)
      logical :: has_solved(n_fields) = solved_by_static
      !> Wires store heat: the step is one over time
      logical :: transient = .false.
      !> Of a temperature in an increment: its change and its error [K]; 0: no limit
      real(dp) :: largest_change = 0, largest_error = 0
      !> The step ends as soon as no temperature changes faster [K/s]; 0: at its time
      real(dp) :: steady_rate = 0
      !> The deck says that displacements are large, as they are in every step
      logical :: nlgeom = .false.
      integer :: max_increments = 100
      !> First, total, smallest and largest increment of time
      real(dp) :: first = 1, total = 1, smallest = 1.0e-5_dp, largest = 1
      !> Increments of fixed size
      logical :: direct = .false.
      !> Prescribed values and loads as they stand in this step, all earlier ones carried over
      type(nodal_value_t), allocatable :: boundary(:), load(:)
      !> Given values of what is not an unknown, such as temperatures, as they stand in this step
      type(nodal_value_t), allocatable :: predefined(:)
      !> Those that the step before has and this one no longer names; not allocated: none
      type(nodal_value_t), allocatable :: let_go(:)
      !> On the length of each element (n_elements), carried over as well
      type(element_heat_t), allocatable :: heat(:)
      !> Forces on the length of elements, carried over as well; those that end in this step are zero
      type(element_load_t), allocatable :: element_loads(:)
      !> Carried over, as Abaqus does, unless the step asks anew
      type(output_request_t), allocatable :: requests(:)
      !> Results hold section forces at nodes, strains and stresses, for which the step asks
      logical :: has_section_results = .false.
      !> Fields, contacts are written at every n-th increment, and at the last of the step; 0 (of contacts): at none
      integer :: output_frequency = 1, contact_frequency = 1
      !> A run can go on from every n-th increment, and from the last of the step; 0: from none
      integer :: restart_frequency = 0
      type(controls_t) :: controls
      integer :: solver = solver_default, coupling = coupling_default
      !> Most iterations that may keep a factor of the tangent; 0: none (full Newton)
      integer :: reform_kernel = 0
   end type step_t

   type :: model_t
      !> Some value of the field is given or asked for (n_fields); always for those that are not optional
      logical :: has_field(n_fields) = .not. fields%is_optional
      character(len=:), allocatable :: heading
      !> The deck as it was read, all included files in place
      character(len=:), allocatable :: deck_text
      !> What the units of the numbers are called
      type(unit_labels_t) :: units
      !> Of the temperature scale [K]
      real(dp) :: absolute_zero = 0
      !> [W/(m^2 K^4)]; 0: not given
      real(dp) :: stefan_boltzmann = 0
      !> Nodes of the deck, and behind them those that stand for motions along local axes
      integer :: n_nodes = 0, n_elements = 0
      integer, allocatable :: node_id(:)
      !> Reference positions (3, n_nodes) [m]
      real(dp), allocatable :: x(:, :)
      integer, allocatable :: element_id(:)
      !> Rows of `element_types` (n_elements)
      integer, allocatable :: element_type(:)
      !> Node indices (2, n_elements)
      integer, allocatable :: connectivity(:, :)
      !> Index into `sections` (n_elements)
      integer, allocatable :: element_section(:)
      type(named_set_t), allocatable :: node_sets(:), element_sets(:)
      type(rigid_body_t), allocatable :: rigid_bodies(:)
      type(equation_t), allocatable :: equations(:)
      type(local_axes_t), allocatable :: local_axes(:)
      type(material_t), allocatable :: materials(:)
      type(section_t), allocatable :: sections(:)
      type(amplitude_t), allocatable :: amplitudes(:)
      type(interaction_t), allocatable :: interactions(:)
      type(contact_pair_t), allocatable :: contact_pairs(:)
      type(rigid_body_surface_t), allocatable :: surfaces(:)
      type(surface_pair_t), allocatable :: surface_pairs(:)
      !> Values before the first step, those that are not zero; amplitudes mean nothing here
      type(nodal_value_t), allocatable :: initial(:)
      type(step_t), allocatable :: steps(:)
   end type model_t

contains

   !> Some step has forces on the length of elements.
   pure logical function has_element_loads(model)
      type(model_t), intent(in) :: model
      integer :: i

      has_element_loads = .false.
      if (.not. allocated(model%steps)) return
      do i = 1, size(model%steps)
         if (.not. allocated(model%steps(i)%element_loads)) cycle
         has_element_loads = has_element_loads .or. size(model%steps(i)%element_loads) > 0
      end do
   end function has_element_loads

   !> Some wire has superconducting filaments.
   pure logical function has_superconductors(model)
      type(model_t), intent(in) :: model
      integer :: i

      has_superconductors = any([(allocated(model%materials(model%sections(i)%material)%superconductor), &
         i=1, size(model%sections))])
   end function has_superconductors

   !> Nodes that the deck has.
   pure integer function n_nodes_of_deck(model) result(n)
      type(model_t), intent(in) :: model

      n = model%n_nodes
      if (allocated(model%local_axes)) n = n - size(model%local_axes)
   end function n_nodes_of_deck

   !> The keyword that says what a step solves for, with its star.
   pure function procedure_of(step) result(keyword)
      type(step_t), intent(in) :: step
      character(len=:), allocatable :: keyword

      if (all(step%solves .eqv. solved_by_heat)) then
         keyword = '*COUPLED THERMAL-ELECTRICAL'
      else if (all(step%solves .eqv. solved_by_static)) then
         keyword = '*STATIC'
      else
         keyword = '*COUPLED TEMPERATURE-DISPLACEMENT'
      end if
   end function procedure_of

   !> The part of a change over a step that is reached: it grows evenly, or is there at once in a step over time.
   pure real(dp) function ramp_at(step, step_time) result(ramp)
      type(step_t), intent(in) :: step
      !> Time since the step began [s]
      real(dp), intent(in) :: step_time

      ramp = merge(1.0_dp, step_time/step%total, step%transient)
   end function ramp_at

   !> The factor of a value that may follow an amplitude.
   pure real(dp) function factor_at(model, amplitude, step_time, total_time) result(factor)
      type(model_t), intent(in) :: model
      !> Index of the amplitude; 0: none
      integer, intent(in) :: amplitude
      !> Time since the step began, and since the analysis began [s]
      real(dp), intent(in) :: step_time, total_time

      factor = 1
      if (amplitude == 0) return
      associate (this => model%amplitudes(amplitude))
         factor = amplitude_factor(this, merge(total_time, step_time, this%total_time))
      end associate
   end function factor_at

   !> What a value that may follow an amplitude becomes as its step ends: one in step time stays what it is then, and
   !> follows none from then on; one in total time goes on. Source: Abaqus on conditions that a step does not name.
   pure subroutine leave_step(model, total, amplitude, factor)
      type(model_t), intent(in) :: model
      !> Time of the step [s]
      real(dp), intent(in) :: total
      !> Index of the amplitude; 0: none
      integer, intent(inout) :: amplitude
      !> By which the value changes
      real(dp), intent(out) :: factor

      factor = 1
      if (amplitude == 0) return
      associate (this => model%amplitudes(amplitude))
         if (this%total_time .or. size(this%time) == 0) return
         factor = amplitude_factor(this, total)
      end associate
      amplitude = 0
   end subroutine leave_step

   !> Radius of a rigid surface [m].
   pure real(dp) function radius_at(model, surface, total_time)
      type(model_t), intent(in) :: model
      !> Index of the surface
      integer, intent(in) :: surface
      !> Since the analysis began [s]
      real(dp), intent(in) :: total_time

      associate (this => model%surfaces(surface))
         radius_at = this%radius*factor_at(model, this%radius_amplitude, 0.0_dp, total_time)
      end associate
   end function radius_at

   !> Times and radii between which the radius of a rigid surface changes linearly (2, n) [s], [m]; one if it stays.
   pure function radius_course(model, surface) result(course)
      type(model_t), intent(in) :: model
      !> Index of the surface
      integer, intent(in) :: surface
      real(dp), allocatable :: course(:, :), times(:)
      integer :: i

      associate (amplitude => model%surfaces(surface)%radius_amplitude)
         if (amplitude > 0) then
            allocate (times, source=model%amplitudes(amplitude)%time)
         else
            allocate (times(1), source=0.0_dp)
         end if
      end associate
      allocate (course(2, size(times)))
      do i = 1, size(times)
         course(:, i) = [times(i), radius_at(model, surface, times(i))]
      end do
   end function radius_course

   !> Piecewise linear value of an amplitude, constant beyond its ends.
   pure real(dp) function amplitude_factor(amplitude, time) result(factor)
      type(amplitude_t), intent(in) :: amplitude
      !> Time [s], of the step or of the whole run as the amplitude has it
      real(dp), intent(in) :: time
      integer :: i

      associate (t => amplitude%time, a => amplitude%factor)
         i = count(t <= time)
         if (i == 0) then
            factor = a(1)
         else if (i == size(t)) then
            factor = a(i)
         else
            factor = a(i) + (a(i + 1) - a(i))*(time - t(i))/(t(i + 1) - t(i))
         end if
      end associate
   end function amplitude_factor

end module litz_model
