!> The keywords that describe the model: mesh, materials, sections and amplitudes.
module litz_model_keywords
   use litz_element_types, only: element_type_choices, describe_element_types, list_element_types, &
      foreign_types
   use litz_fields, only: field_potential, field_temperature, dof_range, n_fields
   use litz_keywords, only: keyword_t, keyword_table_t, field_spec_t, place_model, place_both, limit_none, &
      limit_positive, limit_not_negative, limit_poisson
   use litz_keyword_builders, only: begin, finish, integer_field, real_field, dofs_of, name_field, item_field, &
      text_field, flag, choice, name, item, number, file
   use litz_section_keywords, only: add_sections
   use litz_superconductor_keywords, only: add_superconductor
   implicit none
   private
   public :: add_general, add_mesh, add_constraints, add_initial_values, add_properties

contains

   pure subroutine add_general(table)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t) :: k

      call begin(k, 'HEADING', place_model, 'A title of one or more lines; it is copied to the result files.')
      call k%add_data([text_field('text', 'any text')], required=.false., last=0)
      call finish(table, k)

      call begin(k, 'UNITS', place_model, &
         'Labels for the units of the deck, for table headings, result files, pictures and messages (litz'// &
         ' extension). A deck without it has no units there. Nothing is converted; the units must be consistent'// &
         ' (the unit of moments is force times length, that of resistance voltage over current).')
      call k%add(choice('SYSTEM', 'SI', 'labels of SI, apart from those that are given; default SI'))
      call k%add(name('LENGTH', 'label of the unit of length, such as mm; default m'))
      call k%add(name('FORCE', 'label of the unit of force; default N'))
      call k%add(name('TIME', 'label of the unit of time; default s'))
      call k%add(name('CURRENT', 'label of the unit of current; default A'))
      call k%add(name('VOLTAGE', 'label of the unit of voltage; default V'))
      call k%add(name('TEMPERATURE', 'label of the unit of temperature; default K'))
      call finish(table, k)

      call begin(k, 'PHYSICAL CONSTANTS', place_model, 'Constants in the units of the deck.')
      call k%add(number('ABSOLUTE ZERO', 'absolute zero of the temperature scale, such as -273.15; *RADIATE and'// &
         ' *GAP CONDUCTANCE, LAW=METAL need it; elsewhere 0 when left out', &
         limit_none))
      call k%add(number('STEFAN BOLTZMANN', 'Stefan-Boltzmann constant, 5.670374e-8 in SI units; *RADIATE needs it', &
         limit_positive))
      call finish(table, k)

      call begin(k, 'INCLUDE', place_both, &
         'Inserts another file at this line. A path that does not begin with /'// &
         ' is relative to the directory of the file that contains the line. Data lines may be in a separate file.')
      call k%add(file('INPUT', 'the file to read'))
      call finish(table, k)
   end subroutine add_general

   pure subroutine add_mesh(table)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t) :: k
      integer :: i

      call begin(k, 'NODE', place_model, 'Nodes. Numbers may have gaps and come in any order.')
      call k%add(name('NSET', 'node set that these nodes are added to'))
      call k%add_data([integer_field('id', 'number of the node', limit_positive), real_field('x', 'm', 'position'), &
         real_field('y', 'm', 'position'), real_field('z', 'm', 'position')], last=0)
      call finish(table, k)

      call begin(k, 'ELEMENT', place_model, 'Straight beam elements of two nodes.'// &
         describe_element_types()//' B31R and B31H: taken as B31. B33H: as B33. B32, B32R and B32H: two B31 each,'// &
         ' from the first node to the middle one and on to the last; the second one has a number above all others,'// &
         ' and is in all sets and loads of the first. Elements of a material with conductivity conduct.')
      call k%add(choice('TYPE', element_type_choices(), 'kind of beam', required=.true.))
      call k%add(name('ELSET', 'element set that these elements are added to'))
      do i = 1, size(foreign_types)
         if (foreign_types(i)%has_middle) call k%add_data([number_of('element'), node('n1', 'first node'), &
            node('n2', 'middle node'), node('n3', 'last node')], when='TYPE='//trim(foreign_types(i)%name), last=0)
      end do
      call k%add_data([number_of('element'), node('n1', 'first node'), node('n2', 'second node')], last=0)
      call finish(table, k)

      call begin(k, 'MESH', place_model, 'Nodes, elements and sets from an HDF5 file, as if given here by'// &
         ' *NODE, *ELEMENT, *NSET and *ELSET (litz extension); read twice as fast as text.'// &
         ' Datasets: /nodes/id (n), /nodes/position (n, 3); /elements/TYPE/id (m) and /elements/TYPE/nodes'// &
         ' (m, 2) with the numbers of the nodes, for TYPE '//list_element_types()//'; /node_sets/NAME and'// &
         ' /element_sets/NAME with the numbers of the members. A path that does not begin with / is relative to the'// &
         ' directory of the deck.')
      call k%add(file('INPUT', 'the HDF5 file'))
      call finish(table, k)

      call begin(k, 'NSET', place_model, &
         'Defines a node set, or adds members to it. A set must be defined before it is used in'// &
         ' another set.')
      call k%add(name('NSET', 'name of the set', required=.true.))
      call k%add(name('ELSET', 'an element set, all nodes of which are members'))
      call add_set_flags(k)
      call add_set_data(k, 'node')
      call finish(table, k)

      call begin(k, 'ELSET', place_model, 'Defines an element set, or adds members to it.')
      call k%add(name('ELSET', 'name of the set', required=.true.))
      call add_set_flags(k)
      call add_set_data(k, 'element')
      call finish(table, k)

   contains

      pure type(field_spec_t) function number_of(what)
         !> What has the number
         character(len=*), intent(in) :: what

         number_of = integer_field('id', 'number of the '//what, limit_positive)
      end function number_of

      pure type(field_spec_t) function node(name, help)
         !> Name in the reference, and what it means
         character(len=*), intent(in) :: name, help

         node = integer_field(name, help, limit_positive)
      end function node

   end subroutine add_mesh

   pure subroutine add_constraints(table)
      type(keyword_table_t), intent(inout) :: table
      character(len=2), parameter :: coordinates(6) = ['xa', 'ya', 'za', 'xb', 'yb', 'zb']
      type(keyword_t) :: k
      integer :: i

      call begin(k, 'RIGID BODY', place_model, 'Nodes that move with a reference node as one rigid body, by'// &
         ' rotations of any size. Its displacements and rotations can be prescribed and loaded; forces on the'// &
         ' other nodes act on it, with their moments. The reference node may belong to no element. A node moves'// &
         ' with one rigid body at most. Potentials are not affected.')
      call k%add(item('REF NODE', 'the reference node; a set must contain only this node'))
      call k%add(name('TIE NSET', 'node set whose displacements and rotations follow'))
      call k%add(name('PIN NSET', 'node set whose displacements follow; its rotations are free'))
      call k%add(name('NSET', 'the same as TIE NSET, as in CalculiX'))
      call finish(table, k)

      call begin(k, 'EQUATION', place_model, 'Linear equations between degrees of freedom: the sum of coefficient'// &
         ' times value is zero. Each begins with the number of its terms, alone on a line; the terms follow, up to'// &
         ' five on a line. The first term is eliminated: it can be loaded, but not prescribed, and is in no other'// &
         ' equation. Node sets stand for an equation for each of their nodes, in the order of the numbers of these;'// &
         ' all sets of an equation have the same number of nodes. A node may belong to no element: it then takes'// &
         ' part in equations alone, and can be prescribed and loaded. Rotations are those about the fixed axes in'// &
         ' each increment: with coefficients 1 and -1 for all three two nodes turn alike, by any angle.')
      call k%add_data([integer_field('terms', 'number of terms of the first equation', limit_positive)], last=1)
      call k%add_data([item_field('node', 'number of a node or name of a node set; alone on a line: the number of'// &
         ' terms of the next equation'), &
         dofs_of([(i, i=1, n_fields)], integer_field('dof', 'degree of freedom', limit_positive, required=.false.)), &
         real_field('coefficient', '', 'its coefficient', required=.false.)], first=2, last=0, repeats=5)
      call finish(table, k)

      call begin(k, 'TRANSFORM', place_model, 'Local axes of nodes: *BOUNDARY, *CLOAD and *EQUATION refer to these'// &
         ' in degrees of freedom 1 to 6. They stay as they are when nodes move. R: axis 1 points from the origin to'// &
         ' a, and b lies in the plane of axes 1 and 2. C: axis 1 is radial, 2 tangential, and 3 along the axis,'// &
         ' from a to b. S: axis 1 is radial from a, 2 along the circle of latitude, and 3 along the meridian,'// &
         ' towards the pole on the side of b. Results are along the global axes, as with GLOBAL=YES'// &
         ' of Abaqus and CalculiX.')
      call k%add(name('NSET', 'the nodes', required=.true.))
      call k%add(choice('TYPE', 'R|C|S', 'rectangular, cylindrical or spherical', default='R'))
      call k%add_data([(real_field(coordinates(i), 'm', 'point a', required=.false.), i=1, 3), &
         (real_field(coordinates(i), 'm', 'point b', required=.false.), i=4, 6)])
      call finish(table, k)
   end subroutine add_constraints

   pure subroutine add_initial_values(table)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t) :: k

      call begin(k, 'INITIAL CONDITIONS', place_model, 'Temperatures before the first step; 0 at nodes that no line'// &
         ' names.')
      call k%add(choice('TYPE', 'TEMPERATURE', 'what is given', required=.true.))
      call k%add_data([item_field('node', 'number of a node or name of a node set'), &
         real_field('value', 'K', 'temperature')], last=0)
      call finish(table, k)
   end subroutine add_initial_values

   pure subroutine add_set_flags(k)
      type(keyword_t), intent(inout) :: k

      call k%add(flag('GENERATE', 'data lines are ranges: first, last, step'))
      call k%add(flag('INTERNAL', 'accepted: Abaqus/CAE marks sets of its own by it'))
   end subroutine add_set_flags

   pure subroutine add_set_data(k, what)
      type(keyword_t), intent(inout) :: k
      !> Kind of the members: `node` or `element`
      character(len=*), intent(in) :: what

      call k%add_data([item_field(what, 'number of a '//what//', or name of another set; any number of them')], &
         when='GENERATE=NO', last=0, repeats=0, optional_with=merge('ELSET', '     ', what == 'node'))
      call k%add_data([integer_field('first', 'first '//what, limit_positive), &
         integer_field('last', 'last '//what, limit_positive), &
         integer_field('step', 'step of the numbers, 1 when left out; numbers that do not exist are skipped', &
         limit_positive, required=.false.)], when='GENERATE=YES', last=0)
   end subroutine add_set_data

   !> How much heat a material stores.
   pure subroutine add_storage(table, of_temperature)
      type(keyword_table_t), intent(inout) :: table
      type(field_spec_t), intent(in) :: of_temperature
      type(keyword_t) :: k

      call begin(k, 'DENSITY', place_model, 'Mass per volume, for the heat that wires store in steps over time.', &
         after='MATERIAL')
      call k%add_data([real_field('rho', 'kg/m^3', 'density', limit_positive)])
      call finish(table, k)

      call begin(k, 'SPECIFIC HEAT', place_model, 'Heat that a wire stores per mass and kelvin, in steps over time.', &
         after='MATERIAL')
      call k%add_data([real_field('c', 'J/(kg K)', 'specific heat', limit_positive), of_temperature], last=0)
      call finish(table, k)

      call begin(k, 'LATENT HEAT', place_model, 'Heat of changes of phase, taken up evenly between solidus and'// &
         ' liquidus, in addition to the specific heat.', after='MATERIAL')
      call k%add_data([real_field('l', 'J/kg', 'latent heat', limit_positive), &
         real_field('Ts', 'K', 'solidus temperature'), real_field('Tl', 'K', 'liquidus temperature')], last=0)
      call finish(table, k)
   end subroutine add_storage

   pure subroutine add_properties(table)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t) :: k
      type(field_spec_t) :: of_temperature, from_node(2)

      of_temperature = real_field('T', 'K', 'temperature; ascending. Linear between two lines, constant outside the'// &
         ' table', required=.false.)
      call begin(k, 'MATERIAL', place_model, 'Begins a material; *ELASTIC, *EXPANSION, *ELECTRICAL CONDUCTIVITY,'// &
         ' *SUPERCONDUCTOR, *CONDUCTIVITY, *JOULE HEAT FRACTION, *DENSITY, *SPECIFIC HEAT and *LATENT HEAT follow'// &
         ' it.')
      call k%add(name('NAME', 'name of the material', required=.true.))
      call finish(table, k)

      call begin(k, 'ELASTIC', place_model, 'Linear elastic, isotropic.', after='MATERIAL')
      call k%add(choice('TYPE', 'ISOTROPIC|ISO', 'kind of elasticity', default='ISOTROPIC'))
      call k%add_data([real_field('E', 'Pa', 'Young''s modulus', limit_positive), &
         real_field('nu', '-', 'Poisson''s ratio', limit_poisson), of_temperature], last=0)
      call finish(table, k)

      call begin(k, 'EXPANSION', place_model, 'Thermal expansion of wires: the strain along their axis, and of'// &
         ' their contact radius, is alpha(T) (T - ZERO) less that at the initial temperature.', &
         after='MATERIAL')
      call k%add(choice('TYPE', 'ISO', 'kind of expansion', default='ISO'))
      call k%add(number('ZERO', 'temperature to which alpha refers', limit_none, '0'))
      call k%add_data([real_field('alpha', '1/K', 'secant coefficient of thermal expansion'), of_temperature], last=0)
      call finish(table, k)

      call begin(k, 'ELECTRICAL CONDUCTIVITY', place_model, &
         'Makes the elements of this material conductors: their nodes'// &
         ' have a potential, degree of freedom '//dof_range(field_potential)//'. Without it a wire is an insulator.', &
         after='MATERIAL')
      call k%add_data([real_field('sigma', 'S/m', 'electrical conductivity', limit_positive), &
         real_field('T', 'K', 'temperature; ascending. Between two lines it is 1/sigma that is linear; outside the'// &
         ' table it is constant', required=.false.)], last=0)
      call finish(table, k)

      call begin(k, 'CONDUCTIVITY', place_model, &
         'Makes the elements of this material conduct heat: in steps that solve for temperatures, their nodes have'// &
         ' one, degree of freedom '//dof_range(field_temperature)//'.', after='MATERIAL')
      call k%add(choice('TYPE', 'ISO', 'kind of conductivity', default='ISO'))
      call k%add_data([real_field('lambda', 'W/(m K)', 'heat conductivity', limit_positive), &
         of_temperature], last=0)
      call finish(table, k)

      call begin(k, 'JOULE HEAT FRACTION', place_model, 'Part of the electric power in elements of this material'// &
         ' that becomes heat; 1 without this keyword.', after='MATERIAL')
      call k%add_data([real_field('fraction', '-', 'from 0 to 1', limit_not_negative)])
      call finish(table, k)

      call add_superconductor(table)
      call add_storage(table, of_temperature)
      call add_sections(table)
      call begin(k, 'TRANSVERSE SHEAR STIFFNESS', place_model, &
         'Shear stiffnesses of B31 elements, replacing those of the section, in the order of Abaqus: that along the'// &
         ' second axis comes first. One that is 0 or left out is like the other, with the word SCF that of the'// &
         ' section.', after='BEAM SECTION')
      call k%add_data([real_field('K23', 'N', 'for shear along n2', limit_not_negative, required=.false.), &
         real_field('K13', 'N', 'for shear along n1', limit_not_negative, required=.false.), &
         name_field('SCF', 'accepted: the slenderness compensation factor of Abaqus, a number or the word SCF;'// &
         ' slender elements of litz do not lock, and none softens their shear', required=.false.)])
      call finish(table, k)

      from_node = [real_field('x1', 'm', 'from the node along n1'), real_field('x2', 'm', 'along n2')]
      call begin(k, 'CENTROID', place_model, 'Centroid of a GENERAL section, where axial forces act; at the node'// &
         ' without it.', after='BEAM SECTION')
      call k%add_data(from_node)
      call finish(table, k)
      call begin(k, 'SHEAR CENTER', place_model, 'Shear centre of a GENERAL section, about which it twists; at'// &
         ' the node'// &
         ' without it.', after='BEAM SECTION')
      call k%add_data(from_node)
      call finish(table, k)

      call begin(k, 'AMPLITUDE', place_both, 'A factor over time, linear between the points and constant beyond them.')
      call k%add(name('NAME', 'name of the amplitude', required=.true.))
      call k%add(choice('TIME', 'STEP TIME|TOTAL TIME', 'origin of the times', default='STEP TIME'))
      call k%add_data([real_field('t', 's', 'time; ascending'), real_field('a', '-', 'factor at that time')], &
         last=0, repeats=4)
      call finish(table, k)
   end subroutine add_properties

end module litz_model_keywords
