!> The keywords of contact: laws, pairs, and the rigid surfaces that wires can touch.
module litz_contact_keywords
   use litz_keywords, only: keyword_t, keyword_table_t, field_spec_t, place_model, limit_none, limit_positive, &
      limit_not_negative, limit_one
   use litz_keyword_builders, only: begin, finish, real_field, name_field, flag, choice, name, number, count_of
   use litz_law_words, only: law_words_t
   use litz_normal_laws, only: all_normal_laws
   use litz_heat_law, only: all_heat_laws
   use litz_spot_laws, only: all_spot_laws
   use litz_stick_laws, only: stick_laws
   implicit none
   private
   public :: add_contact

   character(len=1), parameter :: axis_names(3) = ['x', 'y', 'z']

contains

   pure subroutine add_contact(table)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t) :: k
      integer :: i

      call begin(k, 'SURFACE INTERACTION', place_model, 'Begins the contact laws of a pair; *SURFACE BEHAVIOR and'// &
         ' *GAP ELECTRICAL CONDUCTANCE follow it.')
      call k%add(name('NAME', 'name of the interaction', required=.true.))
      call k%add(choice('AXIS', 'HERMITE|LINEAR', 'interpolation of the wire axes for contact (litz extension);'// &
         ' LINEAR has a kink at each node of a bent wire', &
         default='HERMITE'))
      call k%add_data([real_field('thickness', 'm', 'accepted: Abaqus asks for it in two dimensions', limit_positive, &
         required=.false.)], required=.false.)
      call finish(table, k)

      call begin(k, 'SURFACE BEHAVIOR', place_model, 'Contact force over penetration.'// &
         meanings_of(all_normal_laws()), after='SURFACE INTERACTION')
      call k%add(choice('PRESSURE-OVERCLOSURE', names_of(all_normal_laws()), 'the law', required=.true.))
      call k%add(choice('PENETRATION', 'LIMITED|UNLIMITED', &
         'UNLIMITED: deep penetration is not an error, for deliberately soft penalties (litz extension)', &
         default='LIMITED'))
      call k%add(number('YIELD', 'yield stress Y of the softer metal [Pa]: wires that follow HERTZ yield where they'// &
         ' cross, at ends and kinks, along lines and on rigid surfaces, and keep the dent of the largest force'// &
         ' (litz extension)', limit_positive))
      call k%add(number('HARDNESS', 'hardness H, the mean pressure of the spot of crossed wires that has wholly'// &
         ' yielded [Pa]; without it 2.8 Y (litz extension)', limit_positive))
      call add_law_data(k, 'PRESSURE-OVERCLOSURE', all_normal_laws())
      call finish(table, k)

      call begin(k, 'FRICTION', place_model, &
         'Coulomb friction, isotropic in the plane of contact. It resists the slip of the surfaces of the wires, so'// &
         ' that wires roll on each other, and each gets the moment about its axis. Before'// &
         ' slip, a contact deforms elastically: with Mindlin''s tangential stiffness, 2(1-nu)/(2-nu) of the'// &
         ' normal stiffness for equal materials, or as given by one of the parameters. Without this keyword the'// &
         ' wires slide freely. In the increment in which a contact closes, friction acts from the point of closing.', &
         after='SURFACE INTERACTION')
      do i = 1, size(stick_laws)
         if (len_trim(stick_laws(i)%parameter) > 0) call k%add(number(trim(stick_laws(i)%parameter), &
            trim(stick_laws(i)%meaning), limit_positive))
      end do
      call k%add_data([real_field('mu', '-', 'coefficient of friction', limit_not_negative)])
      call finish(table, k)

      call begin(k, 'GAP ELECTRICAL CONDUCTANCE', place_model, 'Resistance of the contact spot.'// &
         meanings_of(all_spot_laws())//' Without this keyword no current flows through the contact. On rigid'// &
         ' surfaces it is CONSTANT or TABLE with PER=LENGTH.', after='SURFACE INTERACTION')
      call k%add(choice('LAW', names_of(all_spot_laws()), 'the law of the spot (litz extension)', required=.true.))
      call k%add(choice('VOLTAGE', 'CORRECTED|LINEAR', &
         'CORRECTED adds the resistance neglected by the linear voltage within an'// &
         ' element', default='CORRECTED'))
      call k%add(choice('MUTUAL RESISTANCE', 'NO|YES', &
         'YES: contacts that are near each other on one wire, within three of its radii along it and not across a'// &
         ' kink (20 degrees or more at a node), raise each other''s potential (litz extension)', default='NO'))
      call k%add(choice('SUPERTEMPERATURE', 'NO|YES', &
         'YES: a spot that its current warms resists more, by the tables of its wires over the temperature, in'// &
         ' steps that solve for temperatures; NO: its resistance is that at the temperatures of its wires'// &
         ' (litz extension)', default='NO'))
      call k%add(choice('SPOT', 'PRESENT FORCE|LARGEST FORCE', &
         'LARGEST FORCE: the spot keeps the size of the largest force since the contact closed or slipped (without'// &
         ' friction: moved by more than the spot) (litz extension)', default='PRESENT FORCE'))
      call k%add(choice('PER', 'SPOT|LENGTH', &
         'LENGTH: the resistance of CONSTANT and TABLE is per length [ohm m], the force of TABLE per length [N/m],'// &
         ' of wires that touch along lines and on rigid surfaces, and of wires that cross over the length along'// &
         ' which they overlap, so that a wire that turns goes from point to line without a step (litz extension)', &
         default='SPOT'))
      call add_law_parameters(k, all_spot_laws())
      call add_law_data(k, 'LAW', all_spot_laws())
      call finish(table, k)

      call add_heat_of_contacts(table)
      call add_surface(table)

      call begin(k, 'CONTACT PAIR', place_model, &
         'Wires that may touch. All crossings between the two sets are searched; with one set, those within it,'// &
         ' also of a wire with itself. With the name of a rigid surface in place of the second set: wires that may'// &
         ' touch this surface; current and heat pass to its reference node by laws with PER=LENGTH. Where several'// &
         ' pairs name the same wires, or the same wire and surface, the last one in the deck holds.')
      call k%add(name('INTERACTION', 'the laws of the contact', required=.true.))
      call k%add(flag('INTERFERENCE FIT', &
         'overlaps at the start are intended; they are resolved linearly over the first step'))
      call k%add_data([name_field('ELSET_A', 'first element set'), name_field('ELSET_B', 'second element set, or'// &
         ' rigid surface', required=.false.)])
      call finish(table, k)
   end subroutine add_contact

   pure subroutine add_heat_of_contacts(table)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t) :: k

      call begin(k, 'GAP CONDUCTANCE', place_model, 'Heat through the contact, in steps that solve for temperatures'// &
         ', between wires with *CONDUCTIVITY. The heat of the current in a spot enters both wires, half and half in'// &
         ' a symmetric contact.'//meanings_of(all_heat_laws())// &
         ' Without this keyword heat passes by CONDUCTIVITY where a current can, and nowhere else. On rigid'// &
         ' surfaces it is CONSTANT or TABLE with PER=LENGTH, and without it no heat passes.', &
         after='SURFACE INTERACTION')
      call k%add(choice('LAW', names_of(all_heat_laws()), 'the law (litz extension)', required=.true.))
      call k%add(choice('PER', 'SPOT|LENGTH', &
         'LENGTH: the heat conductance of CONSTANT and TABLE is per length [W/(m K)], the force of TABLE per length'// &
         ' [N/m], of wires that touch along lines and on rigid surfaces, and of wires that cross over the length'// &
         ' along which they overlap (litz extension)', default='SPOT'))
      call k%add(number('LORENZ', 'Lorenz number L of METAL [V^2/K^2]; without it that of each wire, lambda rho/T'// &
         ' at the contact', limit_positive))
      call k%add(number('FILM', 'resistance to heat of a film in the spot, times area [K m^2/W], of CONDUCTIVITY'// &
         ' and METAL: an oxide, or enamel, over the spot that the mechanics has (litz extension)', limit_positive))
      call k%add(number('TSOFT', 'temperature at which the metal softens: a warning (hot_spot) where the hottest'// &
         ' place of a spot is above it, by its voltage in steps that do not solve for temperatures, too', limit_none))
      call k%add(number('TMELT', 'temperature at which it melts: no spot is hotter in any step', limit_none))
      call k%add(choice('MELTING', 'END|WARN', 'WARN: spots hotter than TMELT are a warning, too (litz extension)', &
         default='END'))
      call add_law_data(k, 'LAW', all_heat_laws())
      call finish(table, k)

      call begin(k, 'GAP HEAT GENERATION', place_model, 'Heat of friction, in steps that solve for motions and'// &
         ' temperatures over time. It enters both wires half and half, where wires with *CONDUCTIVITY touch each'// &
         ' other; of that on a rigid surface a part f enters the wire, the rest the surface.'// &
         ' Without this keyword all of the work of friction becomes heat.', after='SURFACE INTERACTION')
      call k%add_data([real_field('eta', '-', 'part of the work of friction that becomes heat, from 0 to 1', &
         limit_not_negative), &
         real_field('f', '-', 'part of the heat that enters the wire, from 0 to 1; of two wires only 0.5, the'// &
         ' default', limit_not_negative, required=.false.)])
      call finish(table, k)
   end subroutine add_heat_of_contacts

   pure subroutine add_surface(table)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t) :: k
      type(field_spec_t) :: place(3), direction(3)
      integer :: i

      call begin(k, 'RIGID SURFACE', place_model, 'A rigid surface that wires can touch: press plates,'// &
         ' drums, jackets. PLANE: the wires are on the side of its normal. CYLINDER: they touch it from outside.'// &
         ' BORE: they touch it from inside. All are endless.')
      call k%add(name('NAME', 'name of the surface, for *CONTACT PAIR', required=.true.))
      call k%add(choice('TYPE', 'PLANE|CYLINDER|BORE', 'its shape (litz extension)', required=.true.))
      call k%add(count_of('REF NODE', 'node with which the surface moves and turns, and on which the forces of the'// &
         ' contacts act; its potential (9) and temperature (11) are those of the surface where current or heat'// &
         ' passes to it; without it the surface is fixed in space', ''))
      call k%add(name('RADIUS AMPLITUDE', '*AMPLITUDE with TIME=TOTAL TIME that multiplies the radius: a jacket'// &
         ' that shrinks, a mandrel that grows; of a cylinder or a bore; without it the radius stays. Where a step'// &
         ' holds motions it stays, too, and the next one that does not takes up the rest over its time'))
      place = [(real_field(axis_names(i), 'm', 'a point of the plane or of the axis'), i=1, 3)]
      direction = [(real_field('d'//axis_names(i), '-', 'normal of the plane, towards the wires; or direction of'// &
         ' the axis'), i=1, 3)]
      call k%add_data([place, direction], when='TYPE=PLANE')
      do i = 1, 2
         call k%add_data([place, direction, real_field('radius', 'm', 'radius of the surface', limit_positive)], &
            when=trim(merge('TYPE=CYLINDER', 'TYPE=BORE    ', i == 1)))
      end do
      call finish(table, k)
   end subroutine add_surface

   !> `A|B|C`
   pure function names_of(laws) result(names)
      type(law_words_t), intent(in) :: laws(:)
      character(len=:), allocatable :: names
      integer :: i

      names = trim(laws(1)%name)
      do i = 2, size(laws)
         names = names//'|'//trim(laws(i)%name)
      end do
   end function names_of

   !> A sentence for each law.
   pure function meanings_of(laws) result(text)
      type(law_words_t), intent(in) :: laws(:)
      character(len=:), allocatable :: text
      integer :: i

      text = ''
      do i = 1, size(laws)
         text = text//' '//trim(laws(i)%name)//': '//trim(laws(i)%meaning)//'.'
      end do
   end function meanings_of

   !> The numbers that are parameters of the card.
   pure subroutine add_law_parameters(k, laws)
      type(keyword_t), intent(inout) :: k
      type(law_words_t), intent(in) :: laws(:)
      integer :: i, j

      do i = 1, size(laws)
         do j = laws(i)%n_fields() + 1, laws(i)%n_numbers()
            associate (field => laws(i)%fields(j))
               call k%add(number(trim(field%name), trim(field%meaning)//' (litz extension)', limit_positive))
            end associate
         end do
      end do
   end subroutine add_law_parameters

   !> The data lines of each law that has some.
   pure subroutine add_law_data(k, parameter, laws)
      type(keyword_t), intent(inout) :: k
      !> Which parameter chooses the law
      character(len=*), intent(in) :: parameter
      type(law_words_t), intent(in) :: laws(:)
      type(field_spec_t), allocatable :: fields(:)
      integer :: i, j

      do i = 1, size(laws)
         if (laws(i)%n_fields() == 0) cycle
         allocate (fields(laws(i)%n_fields()))
         do j = 1, size(fields)
            associate (field => laws(i)%fields(j))
               fields(j) = real_field(trim(field%name), trim(field%unit), trim(field%meaning), &
                  merge(limit_one, limit_positive, field%is_count), required=.not. (field%is_optional .or. &
                  field%has_substitute))
            end associate
         end do
         call k%add_data(fields, when=parameter//'='//trim(laws(i)%name), last=merge(0, 1, laws(i)%has_table), &
            required=.not. any(laws(i)%fields%has_substitute))
         deallocate (fields)
      end do
   end subroutine add_law_data

end module litz_contact_keywords
