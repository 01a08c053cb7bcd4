!> The keywords of cross-sections.
module litz_section_keywords
   use litz_keywords, only: keyword_t, keyword_table_t, field_spec_t, place_model, limit_positive, limit_none
   use litz_keyword_builders, only: begin, finish, real_field, choice, name, number
   implicit none
   private
   public :: add_sections

contains

   !> Cross-sections, with the dimensions of Abaqus in its order.
   pure subroutine add_sections(table)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t) :: k
      character(len=*), parameter :: shapes = 'CIRC|GENERAL|RECT|BOX|PIPE|I|L'

      call begin(k, 'BEAM SECTION', place_model, &
         'Cross-section and material of all elements of a set. Every element has'// &
         ' exactly one. CIRC: solid round wire. GENERAL: given'// &
         ' stiffnesses, shear factor 1. RECT, BOX, PIPE, I and L: litz computes the stiffnesses of the shape'// &
         ' (torsion by'// &
         ' the series of St Venant, by Bredt, or summed over thin walls; shear factors of Cowper, those of an L'// &
         ' and of a'// &
         ' BOX of unlike walls from the energy of their shear flow); an I has two flanges that are alike.'// &
         ' The node is in the middle of a BOX, at l of an I, and where the mean lines of the legs of an L meet,'// &
         ' which go'// &
         ' from there along n1 and n2. Axial forces act at the centroid, shear forces at the shear centre: where'// &
         ' these'// &
         ' are beside the node, forces on the node bend and twist. Their first axis n1 is (0, 0, -1) without the'// &
         ' second'// &
         ' data line.')
      call k%add(name('ELSET', 'the elements', required=.true.))
      call k%add(name('MATERIAL', 'their material', required=.true.))
      call k%add(choice('SECTION', shapes, 'shape of the cross-section', required=.true.))
      call add_section_data(k)
      call finish(table, k)

      call begin(k, 'BEAM GENERAL SECTION', place_model, 'As *BEAM SECTION, with the elasticity of a MATERIAL, or'// &
         ' that of its third data line, which the first axis must then precede; a blank line stands for (0, 0, -1).')
      call k%add(name('ELSET', 'the elements', required=.true.))
      call k%add(name('MATERIAL', 'their material; without it, the third data line has the elasticity'))
      call k%add(choice('SECTION', shapes, 'shape of the cross-section', default='GENERAL'))
      call k%add(number('DENSITY', 'mass per volume [kg/m^3], where there is no MATERIAL', limit_positive))
      call add_section_data(k)
      call k%add_data([real_field('E', 'Pa', 'Young''s modulus', limit_positive), &
         real_field('G', 'Pa', 'shear modulus', limit_positive)], first=3, required=.false.)
      k%counts_as = 'BEAM SECTION'
      call finish(table, k)
   end subroutine add_sections

   pure subroutine add_section_data(k)
      type(keyword_t), intent(inout) :: k
      type(field_spec_t) :: general(7)

      call k%add(number('CONTACT RADIUS', &
         'radius of the round contact surface [m]; CIRC: the radius when'// &
         ' left out; other shapes: needed for elements in a contact pair', limit_positive))
      call k%add(number('OFFSET1', 'place of the nodes along n1 from the middle of the section, in its sides, as in'// &
         ' CalculiX: 0.5 is the side of n1, and the section lies on the other side of the nodes. CONTACT RADIUS is'// &
         ' around the nodes', limit_none))
      call k%add(number('OFFSET2', 'the same along n2', limit_none))
      call k%add(choice('CONDUCTION', 'REFERENCE LENGTH|CURRENT LENGTH', &
         'length used for the resistance of an element (litz extension)', default='REFERENCE LENGTH'))
      call k%add(number('STIFFNESS', 'factor of the stiffnesses of the beams; contacts, currents, heat and weight'// &
         ' do not have it (litz extension)', limit_positive, '1'))
      call k%add_data([real_field('radius', 'm', 'radius of the wire', limit_positive)], when='SECTION=CIRC')
      general = [real_field('A', 'm^2', 'area', limit_positive), &
         real_field('I11', 'm^4', 'second moment for bending about the first axis n1', limit_positive), &
         real_field('I12', 'm^4', 'product of inertia, the integral of x1 x2; 0: n1 and n2 are principal axes'), &
         real_field('I22', 'm^4', 'second moment for bending about the second axis n2', limit_positive), &
         real_field('J', 'm^4', 'torsion constant', limit_positive), &
         real_field('Gamma0', 'm^4', 'warping constants of Abaqus: 0', required=.false.), &
         real_field('GammaW', 'm^6', 'the other one', required=.false.)]
      call k%add_data(general, when='SECTION=GENERAL')
      call k%add_data([length('a', 'side along n1'), real_field('b', 'm', 'side along n2; a when left out', &
         limit_positive, required=.false.)], when='SECTION=RECT')
      call k%add_data([length('a', 'outer side along n1'), length('b', 'outer side along n2'), &
         length('t1', 'wall on the side of n1'), length('t2', 'wall on the side of n2'), &
         length('t3', 'wall opposite to t1'), length('t4', 'wall opposite to t2')], &
         when='SECTION=BOX')
      call k%add_data([length('r', 'outer radius'), length('t', 'thickness of the wall')], when='SECTION=PIPE')
      call k%add_data([length('l', 'distance of the node from the lower side'), length('h', 'height along n2'), &
         length('b1', 'width of the lower flange'), length('b2', 'width of the upper flange, b1'), &
         length('t1', 'thickness of the lower flange'), length('t2', 'thickness of the upper flange, t1'), &
         length('t3', 'thickness of the web')], when='SECTION=I')
      call k%add_data([length('a', 'outer length of the leg along n1'), &
         length('b', 'outer length of the leg along n2'), length('t1', 'thickness of the leg along n1'), &
         length('t2', 'thickness of the leg along n2')], when='SECTION=L')
      call k%add_data([real_field('n1x', '-', 'direction of the first axis n1; CIRC and GENERAL: chosen by litz'// &
         ' without'// &
         ' this line'), real_field('n1y', '-', 'its second component'), real_field('n1z', '-', &
         'its third component')], first=2, required=.false.)
   end subroutine add_section_data

   !> A length that is greater than 0.
   pure type(field_spec_t) function length(name, help)
      !> Name in the reference and in messages, and what it means
      character(len=*), intent(in) :: name, help

      length = real_field(name, 'm', help, limit_positive)
   end function length

end module litz_section_keywords
