!> What the analysis knows at one instant: the fields over nodes and elements, and the contacts.
module litz_state
   use litz_fields, only: n_fields
   use litz_kinds, only: dp
   implicit none
   private
   public :: state_t, contact_t, surface_contact_t, energies_t

   !> One point contact. "Barred" is the first of its two elements; the normal points from the unbarred to the barred.
   !> What results say of it is listed in litz_result_quantities.
   type :: contact_t
      !> Stays the same while the contact lives, also when it slides to another element
      integer :: id = 0
      !> Internal element indices, barred and unbarred, and the position in each, in [-1, 1]
      integer :: element_bar = 0, element = 0
      real(dp) :: xi_bar = 0, xi = 0
      !> Index into the model's contact pairs
      integer :: pair = 0
      !> Angle between the axes [rad]
      real(dp) :: angle = 0
      !> Gap between the surfaces [m], negative in contact
      real(dp) :: gap = 0
      !> Unit normal, and the axis points of the barred and the unbarred wire [m]
      real(dp) :: normal(3) = 0, point_bar(3) = 0, point(3) = 0
      !> Contact force [N], pushing the wires apart, and its derivative by the overlap [N/m]
      real(dp) :: force = 0, stiffness = 0
      !> `friction_...` of litz_friction_law: none, stick or slip
      integer :: friction_status = 0
      !> What the barred wire feels of friction (3) [N]
      real(dp) :: traction(3) = 0
      !> Path of the slip [m] and heat of friction [J] since the contact closed
      real(dp) :: slip_path = 0, dissipation = 0
      !> Semi-axes of the spot [m]
      real(dp) :: semi_major = 0, semi_minor = 0
      !> Largest pressure [Pa], of wires that do not yield between elastic ones
      real(dp) :: pressure = 0
      !> Of wires that yield: largest force that the contact feels [N], overlap beyond which it touches in the dent of
      !> that force [m], longer semi-axis of the spot then [m], and what yielding has dissipated [J]
      real(dp) :: largest_force = 0, dent = 0, largest_semi_major = 0, yield_dissipation = 0
      !> Radius of a circle of the area of that spot, over the radius of the thinner wire; and which part of the width
      !> of its dent the contact has slid up in the increment [-]
      real(dp) :: spot_share = 0, climbed = 0
      !> Contact resistance [ohm], infinite where no current can pass; current from barred to unbarred [A],
      !> its voltage [V]
      real(dp) :: resistance = 0, current = 0, voltage_gap = 0
      !> Reciprocal of the resistance [S]
      real(dp) :: conductance = 0
      !> Heat in the spot [W]
      real(dp) :: joule_heat = 0
      !> Temperatures of the wires at the contact, and the highest one in the spot [K]
      real(dp) :: temperature_bar = 0, temperature = 0, temperature_max = 0
      !> Heat that the contact gives to either wire [W]
      real(dp) :: heat_bar = 0, heat = 0
      !> Length of the wires for which a point of a line contact stands [m]; 0: the wires cross
      real(dp) :: length = 0
      !> Distance of neighbouring places there, along the unbarred wire [m]; 0: the wires cross
      real(dp) :: spacing = 0
      !> What of the force [N] and of the current [A] of such a point is that of the round end of the unbarred wire
      real(dp) :: end_force = 0, end_current = 0
   end type contact_t

   !> The contact of one element with a rigid surface.
   type :: surface_contact_t
      !> Index of the pair of the model, and element
      integer :: pair = 0, element = 0
      !> Centre of the force in the element, in [-1, 1]
      real(dp) :: xi = 0
      !> Length of the wire that touches [m], and smallest gap between the surfaces [m], negative
      real(dp) :: length = 0, gap = 0
      !> Contact force, the sum of its magnitudes along the element [N]
      real(dp) :: force = 0
      !> Of wires that yield: largest force so far [N], overlap that remains where the dent is deepest [m], and what
      !> yielding has dissipated [J]
      real(dp) :: largest_force = 0, dent = 0, yield_dissipation = 0
      !> Unit normal from the surface to the wire there, and the point of the axis at the centre of the force [m]
      real(dp) :: normal(3) = 0, point(3) = 0
      !> What the wire feels of friction (3) [N]; `friction_...` of litz_friction_law
      real(dp) :: traction(3) = 0
      integer :: friction_status = 0
      !> Path of the slip [m] and heat of friction [J] since the contact closed
      real(dp) :: slip_path = 0, dissipation = 0
      !> What the surface feels, with friction: force (3) [N], and moment about its reference node, or about the origin
      !> where it is fixed in space (3) [N m]
      real(dp) :: surface_force(3) = 0, surface_moment(3) = 0
      !> Conductance [S], current into the surface, and what of it comes from either node of the element (2) [A]
      real(dp) :: conductance = 0, current = 0, current_of_nodes(2) = 0
      !> Of the current through the contact, and heat that the contact gives to the wire, and to the surface [W]
      real(dp) :: joule_heat = 0, heat = 0, heat_of_surface = 0
   end type surface_contact_t

   !> Energies since the beginning [J]
   type :: energies_t
      !> Done by supports, loads and the resolving of interference
      real(dp) :: work = 0
      !> In the beams; in the contacts, normal and tangential
      real(dp) :: strain = 0, contact = 0
      !> Made heat by friction
      real(dp) :: friction = 0
      !> Dissipated by spots that yield
      real(dp) :: yielding = 0
      !> Taken by the damping of *CONTROLS, PARAMETERS=STABILIZE
      real(dp) :: stabilization = 0
      !> Done by changes of temperature: the change of elastic energy where nothing moves
      real(dp) :: thermal = 0
   end type energies_t

   type :: state_t
      !> Fields that the model has (n_fields); results show no others
      logical :: has_field(n_fields) = .true.
      integer :: step = 0, increment = 0, iterations = 0
      !> Total time, time in the step, last increment of time
      real(dp) :: time = 0, step_time = 0, time_increment = 0
      !> The increment before the last one [s]
      real(dp) :: time_increment_before = 0
      !> The last increment is that of its step
      logical :: ends_step = .false.
      !> Values of all fields (n_slots, n_nodes) [m, rad, V, K], those of rotations as rotation vectors; 0 where there
      !> is no such value
      real(dp), allocatable :: value(:, :)
      !> Rotation matrices of the nodes from the reference (3, 3, n_nodes)
      real(dp), allocatable :: rotation(:, :, :)
      !> Reactions of supports (n_slots, n_nodes) [N, N m, A, W]: what the support does to the structure, or lets into
      !> it; loads not included
      real(dp), allocatable :: reaction(:, :)
      !> Applied forces, moments, currents and heat flows (n_slots, n_nodes) [N, N m, A, W]
      real(dp), allocatable :: load(:, :)
      !> N, Q2, Q3, T, M2, M3 (6, n_elements) [N, N m]
      real(dp), allocatable :: section_forces(:, :)
      !> Current from first to second node (n_elements) [A], heat (n_elements) [W]
      real(dp), allocatable :: element_current(:), joule_heat(:)
      !> Heat flow along the wire per area of the cross-section, from the first to the second node (n_elements) [W/m^2],
      !> heat of currents and sources in the element, and heat that leaves its side (n_elements) [W]
      real(dp), allocatable :: heat_flux(:), heat_made(:), surface_heat(:)
      !> 1: a path leads from the node to a prescribed potential; 0: none (n_nodes)
      real(dp), allocatable :: has_potential(:)
      !> What the elements take up of the heat (n_elements) [W], and the temperatures when the last increment and the
      !> one before it began (n_nodes) [K]
      real(dp), allocatable :: heat_stored(:), temperature_before(:), temperature_earlier(:)
      !> Temperatures that the mechanics sees: those of the last increment that solved for motions (n_nodes) [K]
      real(dp), allocatable :: mechanical_temperature(:)
      !> Some step has forces on the length of elements; the mean force per reference length of each (3, n_elements)
      !> [N/m]
      logical :: has_line_loads = .true.
      real(dp), allocatable :: line_load(:, :)
      !> Some step asks for section forces at the nodes, or for strains: N, Q2, Q3, T, M2, M3 of each element at its
      !> first node and at its second (12, n_elements) [N, N m]; axial strain, twist, both curvatures at mid length,
      !> largest and smallest axial strain and stress of any fibre (8, n_elements) [-, 1/m, Pa]
      logical :: has_section_results = .true.
      real(dp), allocatable :: section_ends(:, :), section_strains(:, :)
      !> Some material has superconducting filaments: electric field [V/m], critical current [A], current over the
      !> critical one, and heat per length [W/m] of each element (4, n_elements); 0 in others
      logical :: has_superconductors = .true.
      real(dp), allocatable :: superconductors(:, :)
      !> Current per area of the cross-section (n_elements) [A/m^2]
      real(dp), allocatable :: current_density(:)
      !> Of the metal of each element: resistivity [ohm m], and resistance from node to node [ohm] (2, n_elements); 0
      !> where it does not conduct
      real(dp), allocatable :: metal(:, :)
      !> Forces on the nodes from what is neither in the model nor a support or load: damping (n_slots, n_nodes)
      !> [N, N m]; a term adds its own when the increment is accepted
      real(dp), allocatable :: outer_force(:, :)
      !> What resists the nodes of these, by *CONTROLS, PARAMETERS=STABILIZE (n_slots, n_nodes) [N, N m]
      real(dp), allocatable :: damping(:, :)
      !> Worst figures of the audit: balance of forces, of moments, of currents, of power; overlap over radius [-]
      real(dp) :: audit(5) = 0
      type(energies_t) :: energies
      !> Active contacts
      type(contact_t), allocatable :: contacts(:)
      type(surface_contact_t), allocatable :: surface_contacts(:)
      !> Radii of the rigid surfaces as wires meet them: where motions are held they stay (n_surfaces) [m]
      real(dp), allocatable :: surface_radius(:)
      !> What elements on rigid surfaces remember of friction: numbers that litz_surface_term knows (numbers, cells)
      real(dp), allocatable :: surface_memory(:, :)
      !> What they remember of their dents, where some yield: numbers that litz_surface_dents knows (numbers, cells)
      real(dp), allocatable :: surface_dents(:, :)
   end type state_t

end module litz_state
