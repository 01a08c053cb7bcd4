!> The quantities that results hold, one line each: name, unit, meaning, and where the values are.
!>
!> Fields of the result files, columns of the ledger and of the history, the names that decks may ask for, the check for
!> values that are not numbers, and restart files follow these lists.
module litz_result_quantities
   use litz_fields, only: fields, n_fields, n_groups, field_potential, field_temperature, first_slot
   use litz_kinds, only: dp
   use litz_model, only: model_t, has_element_loads, has_superconductors
   use litz_quantities, only: quantity_t, quantity_table_t, on_points, on_cells
   use litz_state, only: state_t, contact_t, surface_contact_t
   implicit none
   private
   public :: wire_quantity_t, choose_results, list_wire_quantities, requested_names, described_requests, &
      asks_for_sections
   public :: contact_table, contacts_of_table, surface_contact_table, surface_contacts_of_table

   !> A quantity of nodes or elements.
   type, extends(quantity_t) :: wire_quantity_t
      !> What decks ask for it by, some together; empty: it is in the result file alone
      character(len=8) :: request = ''
      !> Name of its column in the history; the components of a vector are counted
      character(len=8) :: column = ''
      !> Its total over a set is the sum; otherwise it is the mean
      logical :: is_sum = .false.
      !> (components, nodes or elements); null where the state has no such values yet
      real(dp), pointer :: values(:, :) => null()
   end type wire_quantity_t

   interface add
      module procedure add_rows, add_scalar
   end interface add

contains

   !> Which results the steps of a model have.
   pure subroutine choose_results(model, state)
      type(model_t), intent(in) :: model
      type(state_t), intent(inout) :: state

      state%has_field = model%has_field
      state%has_line_loads = has_element_loads(model)
      state%has_section_results = .false.
      if (allocated(model%steps)) state%has_section_results = any(model%steps%has_section_results)
      state%has_superconductors = has_superconductors(model)
   end subroutine choose_results

   !> What results hold of nodes and elements, with the values of this state.
   subroutine list_wire_quantities(state, list)
      !> The values are its own: setting them sets it
      type(state_t), intent(in), target :: state
      type(wire_quantity_t), allocatable, intent(out) :: list(:)

      allocate (list(0))
      call list_unknowns(state, list)
      call add(list, on_cells, 'axial_force', 'N', 'axial force N, tension positive', &
         state%section_forces, 1, 1, 'SF', 'N')
      call add(list, on_cells, 'shear_force_2', 'N', 'shear force Q2 along the first section axis', &
         state%section_forces, 2, 1, 'SF', 'Q2')
      call add(list, on_cells, 'shear_force_3', 'N', 'shear force Q3 along the second section axis', &
         state%section_forces, 3, 1, 'SF', 'Q3')
      call add(list, on_cells, 'torsion_moment', 'N m', 'torsion moment T', state%section_forces, 4, 1, 'SF', 'T')
      call add(list, on_cells, 'bending_moment_2', 'N m', 'bending moment M2 about the first section axis', &
         state%section_forces, 5, 1, 'SF', 'M2')
      call add(list, on_cells, 'bending_moment_3', 'N m', 'bending moment M3 about the second section axis', &
         state%section_forces, 6, 1, 'SF', 'M3')
      call add(list, on_cells, 'element_current', 'A', 'current from the first to the second node', &
         state%element_current, 'EPG', 'current')
      call add(list, on_cells, 'current_density', 'A/m^2', &
         'current per area of the cross-section, from the first to the second node', state%current_density)
      call add(list, on_cells, 'joule_heat', 'W', 'electric power in the element, which heats it (*JOULE HEAT'// &
         ' FRACTION)', state%joule_heat, 'JOULE', is_sum=.true.)
      if (state%has_field(field_potential)) then
         call add(list, on_points, 'has_potential', '1', '1: a conducting path leads to a prescribed potential;'// &
            ' 0: none, and the potential means nothing', state%has_potential)
         call add(list, on_cells, 'resistivity', 'ohm m', 'resistivity of the metal at its temperature; 0: it does'// &
            ' not conduct', state%metal, 1, 1)
         call add(list, on_cells, 'element_resistance', 'ohm', 'resistance of the metal from node to node; 0: the'// &
            ' element does not conduct', state%metal, 2, 1)
      end if
      if (state%has_superconductors) then
         call add(list, on_cells, 'electric_field', 'V/m', 'electric field along a wire with superconducting'// &
            ' filaments', state%superconductors, 1, 1, 'SC', 'EFIELD')
         call add(list, on_cells, 'critical_current', 'A', 'critical current of the filaments at the temperature,'// &
            ' flux density and strain of the element', state%superconductors, 2, 1, 'SC', 'IC')
         call add(list, on_cells, 'critical_fraction', '1', 'current over the critical one, 1e9 at most', &
            state%superconductors, 3, 1, 'SC', 'IFRAC')
         call add(list, on_cells, 'joule_heat_per_length', 'W/m', 'heat from the current per length of a wire with'// &
            ' superconducting filaments', state%superconductors, 4, 1, 'SC', 'JLENGTH')
      end if
      if (state%has_section_results) call list_section_results(state, list)
      if (state%has_line_loads) call add(list, on_cells, 'line_load', 'N/m', &
         'force per reference length of *DLOAD and *LORENTZ', state%line_load, 1, 3, 'DLOAD')
      if (.not. state%has_field(field_temperature)) return
      call add(list, on_cells, 'heat_flux', 'W/m^2', &
         'heat flow along the wire per area of the cross-section, from the first to the second node', state%heat_flux, &
         'HFL')
      call add(list, on_cells, 'surface_heat', 'W', &
         'heat that leaves the side of the element, by films and radiation', &
         state%surface_heat, 'QSIDE', is_sum=.true.)
      call add(list, on_cells, 'stored_heat', 'W', &
         'heat that the element takes up in a step over time, also by melting', state%heat_stored, 'QSTORE', &
         is_sum=.true.)
   end subroutine list_wire_quantities

   !> What is made of the section forces, where a step asks for it.
   subroutine list_section_results(state, list)
      type(state_t), intent(in), target :: state
      type(wire_quantity_t), allocatable, intent(inout) :: list(:)

      call add(list, on_cells, 'end_force_1', 'N', 'N, Q2, Q3 at the first node', state%section_ends, 1, 3, 'SFN', &
         'SFI')
      call add(list, on_cells, 'end_moment_1', 'N m', 'T, M2, M3 at the first node', state%section_ends, 4, 3, 'SFN', &
         'SMI')
      call add(list, on_cells, 'end_force_2', 'N', 'N, Q2, Q3 at the second node', state%section_ends, 7, 3, 'SFN', &
         'SFJ')
      call add(list, on_cells, 'end_moment_2', 'N m', 'T, M2, M3 at the second node', state%section_ends, 10, 3, &
         'SFN', 'SMJ')
      call add(list, on_cells, 'axial_strain', '1', 'axial strain at mid length, without that of temperature', &
         state%section_strains, 1, 1, 'SE', 'SE1')
      call add(list, on_cells, 'twist', '1/m', 'change of the twist', state%section_strains, 2, 1, 'SK', 'SK1')
      call add(list, on_cells, 'curvature_2', '1/m', 'change of the curvature about the first section axis, at mid'// &
         ' length', state%section_strains, 3, 1, 'SK', 'SK2')
      call add(list, on_cells, 'curvature_3', '1/m', 'change of the curvature about the second section axis, at mid'// &
         ' length', state%section_strains, 4, 1, 'SK', 'SK3')
      call add(list, on_cells, 'strain_max', '1', 'largest axial strain of a fibre, at either node or mid length', &
         state%section_strains, 5, 1, 'E11', 'E11MAX')
      call add(list, on_cells, 'strain_min', '1', 'smallest axial strain of a fibre', state%section_strains, 6, 1, &
         'E11', 'E11MIN')
      call add(list, on_cells, 'stress_max', 'Pa', 'largest axial stress of a fibre, at either node or mid length', &
         state%section_strains, 7, 1, 'S11', 'S11MAX')
      call add(list, on_cells, 'stress_min', 'Pa', 'smallest axial stress of a fibre', state%section_strains, 8, 1, &
         'S11', 'S11MIN')
   end subroutine list_section_results

   !> A word by which decks ask for these.
   pure logical function asks_for_sections(request)
      !> Such as `SFN`
      character(len=*), intent(in) :: request

      asks_for_sections = any(request == [character(len=8) :: 'SFN', 'SE', 'SK', 'E11', 'S11'])
   end function asks_for_sections

   !> Values, reactions and loads of the fields of the model, group by group.
   subroutine list_unknowns(state, list)
      type(state_t), intent(in), target :: state
      type(wire_quantity_t), allocatable, intent(inout) :: list(:)
      character(len=:), allocatable :: text
      logical :: shown(n_fields)
      integer :: group, f

      do group = 1, n_groups
         shown = state%has_field .and. fields%group == group
         do f = 1, n_fields
            if (shown(f)) call add(list, on_points, trim(fields(f)%name), trim(fields(f)%unit), &
               trim(fields(f)%meaning), state%value, first_slot(f), fields(f)%n_components, fields(f)%value_word)
         end do
         do f = 1, n_fields
            if (.not. shown(f)) cycle
            text = trim(fields(f)%flux_in_words)//' of the supports on the structure, applied loads not included'
            if (fields(f)%is_level) text = trim(fields(f)%flux_in_words)//' that enters where the '// &
               trim(fields(f)%name)//' is prescribed'
            call add(list, on_points, 'reaction_'//trim(fields(f)%flux), trim(fields(f)%flux_unit), text, &
               state%reaction, first_slot(f), fields(f)%n_components, fields(f)%reaction_word, is_sum=.true.)
         end do
         do f = 1, n_fields
            if (.not. shown(f)) cycle
            text = 'applied '//trim(fields(f)%flux_in_words)
            if (fields(f)%is_level) text = text//', positive into the body'
            call add(list, on_points, 'applied_'//trim(fields(f)%flux), trim(fields(f)%flux_unit), text, &
               state%load, first_slot(f), fields(f)%n_components, fields(f)%load_word, is_sum=.true.)
         end do
      end do
   end subroutine list_unknowns

   !> What results and the restart file hold of a contact.
   pure subroutine list_contact_quantities(table, c)
      type(quantity_table_t), intent(inout) :: table
      type(contact_t), intent(inout) :: c

      call table%field('id', c%id, '1', 'number of the contact, constant while it exists')
      call table%field('element_1', c%element_bar, '1', 'first element (barred), number in the deck', &
         is_element=.true.)
      call table%field('element_2', c%element, '1', 'second element (unbarred), number in the deck', &
         is_element=.true.)
      call table%field('pair', c%pair)
      call table%field('xi_1', c%xi_bar, '1', 'position in the first element, -1 to 1')
      call table%field('xi_2', c%xi, '1', 'position in the second element, -1 to 1')
      call table%field('angle', c%angle, 'rad', 'angle between the axes')
      call table%field('gap', c%gap, 'm', &
         'gap between the surfaces and what is left of an interference fit, negative in contact')
      call table%field('force', c%force, 'N', 'contact force, pushing the wires apart')
      call table%field('length', c%length, 'm', 'length that a point of a line contact stands for; 0 where wires cross')
      call table%field('spacing', c%spacing, 'm', &
         'distance of neighbouring points of a line contact along the second wire; 0 where wires cross')
      call table%field('end_force', c%end_force, 'N', &
         'of the force of a point of a line contact: that of the round end of the second wire')
      call table%field('end_current', c%end_current, 'A', &
         'of its current: what passes through the spot of that round end')
      call table%field('normal', c%normal, '1', 'unit normal from the unbarred to the barred wire')
      call table%field('point_1', c%point_bar, 'm', 'point of the first axis')
      call table%field('point_2', c%point, 'm', 'point of the second axis')
      call table%field('semi_major', c%semi_major, 'm', 'longer semi-axis of the spot')
      call table%field('semi_minor', c%semi_minor, 'm', 'shorter semi-axis of the spot')
      call table%field('pressure', c%pressure, 'Pa', &
         'largest pressure under this force: of elastic wires (Hertz), or of wires that yield (YIELD)')
      call table%field('largest_force', c%largest_force, 'N', 'of wires that yield: force that has made the'// &
         ' dent, less as the contact has slid off it')
      call table%field('dent', c%dent, 'm', 'of wires that yield: overlap that remains when the contact opens')
      call table%field('largest_semi_major', c%largest_semi_major, 'm', 'of wires that yield: longer semi-axis of'// &
         ' the spot under the largest force')
      call table%field('yield_dissipation', c%yield_dissipation, 'J', 'work that yielding has dissipated')
      call table%field('resistance', c%resistance, 'ohm', 'contact resistance, infinite where no current can pass', &
         may_be_infinite=.true.)
      call table%field('current', c%current, 'A', 'current from the barred to the unbarred wire')
      call table%field('voltage_gap', c%voltage_gap, 'V', 'potential of the barred minus the unbarred wire')
      call table%field('joule_heat', c%joule_heat, 'W', 'heat in the spot')
      call table%field('temperature_1', c%temperature_bar, 'K', 'temperature of the first wire at the contact;'// &
         ' 0 where the model has no temperatures')
      call table%field('temperature_2', c%temperature, 'K', 'temperature of the second wire at the contact')
      call table%field('temperature_max', c%temperature_max, 'K', 'highest temperature in the spot')
      call table%field('heat_1', c%heat_bar, 'W', 'heat that the contact gives to the first wire')
      call table%field('heat_2', c%heat, 'W', 'heat that the contact gives to the second wire')
      call table%field('traction', c%traction, 'N', 'friction force on the barred wire')
      call table%field('slip_path', c%slip_path, 'm', 'path of the slip since the contact closed')
      call table%field('dissipation', c%dissipation, 'J', 'frictional heat since the contact closed')
      call table%field('friction', c%friction_status, '1', '0 none, 1 stick, 2 slip', words='none|stick|slip')
   end subroutine list_contact_quantities

   !> What results hold of a contact with a rigid surface.
   pure subroutine list_surface_quantities(table, c)
      type(quantity_table_t), intent(inout) :: table
      type(surface_contact_t), intent(inout) :: c

      call table%field('element', c%element, '1', 'element, number in the deck', is_element=.true.)
      call table%field('xi', c%xi, '1', 'centre of the force in the element, -1 to 1')
      call table%field('length', c%length, 'm', 'length of the element that touches')
      call table%field('gap', c%gap, 'm', 'smallest gap between wire and surface, negative in contact')
      call table%field('force', c%force, 'N', 'contact force, pushing the wire off the surface')
      call table%field('largest_force', c%largest_force, 'N', 'of wires that yield: largest force so far')
      call table%field('dent', c%dent, 'm', 'of wires that yield: overlap that remains where the dent is deepest')
      call table%field('yield_dissipation', c%yield_dissipation, 'J', 'work that yielding has dissipated')
      call table%field('normal', c%normal, '1', 'unit normal from the surface to the wire')
      call table%field('point', c%point, 'm', 'point of the axis at the centre of the force')
      call table%field('traction', c%traction, 'N', 'friction force on the wire')
      call table%field('surface_force', c%surface_force, 'N', 'force on the surface, with friction')
      call table%field('surface_moment', c%surface_moment, 'N m', &
         'moment on the surface about its reference node, or about the origin where it is fixed in space')
      call table%field('conductance', c%conductance, 'S', 'electrical conductance of the contact')
      call table%field('current', c%current, 'A', 'current from the wire into the surface')
      call table%field('joule_heat', c%joule_heat, 'W', 'heat of the current in the contact')
      call table%field('heat', c%heat, 'W', 'heat flow from the contact into the wire')
      call table%field('heat_of_surface', c%heat_of_surface, 'W', 'heat flow from the contact into the surface')
      call table%field('slip_path', c%slip_path, 'm', 'path of the slip since the contact closed')
      call table%field('dissipation', c%dissipation, 'J', 'frictional heat since the contact closed')
      call table%field('friction', c%friction_status, '1', '0 none, 1 stick, 2 slip', words='none|stick|slip')
      call table%field('pair', c%pair)
   end subroutine list_surface_quantities

   !> The contacts with rigid surfaces as rows of numbers, with the descriptions of the columns.
   pure function surface_contact_table(contacts) result(table)
      type(surface_contact_t), intent(in) :: contacts(:)
      type(quantity_table_t) :: table
      type(surface_contact_t) :: contact
      integer :: i

      call list_surface_quantities(table, contact)
      call table%begin_storing(size(contacts))
      do i = 1, size(contacts)
         contact = contacts(i)
         call table%next_row()
         call list_surface_quantities(table, contact)
      end do
   end function surface_contact_table

   !> The contacts with rigid surfaces that a table was made of.
   pure subroutine surface_contacts_of_table(table, contacts)
      type(quantity_table_t), intent(inout) :: table
      type(surface_contact_t), allocatable, intent(out) :: contacts(:)
      integer :: i

      call table%begin_restoring()
      allocate (contacts(size(table%reals, 2)))
      do i = 1, size(contacts)
         call table%next_row()
         call list_surface_quantities(table, contacts(i))
      end do
   end subroutine surface_contacts_of_table

   !> The contacts as rows of numbers, with the descriptions of the columns.
   pure function contact_table(contacts) result(table)
      type(contact_t), intent(in) :: contacts(:)
      type(quantity_table_t) :: table
      type(contact_t) :: contact
      integer :: i

      call list_contact_quantities(table, contact)
      call table%begin_storing(size(contacts))
      do i = 1, size(contacts)
         contact = contacts(i)
         call table%next_row()
         call list_contact_quantities(table, contact)
      end do
   end function contact_table

   !> The contacts that a table was made of.
   pure subroutine contacts_of_table(table, contacts)
      type(quantity_table_t), intent(inout) :: table
      type(contact_t), allocatable, intent(out) :: contacts(:)
      integer :: i

      call table%begin_restoring()
      allocate (contacts(size(table%reals, 2)))
      do i = 1, size(contacts)
         call table%next_row()
         call list_contact_quantities(table, contacts(i))
      end do
   end subroutine contacts_of_table

   !> What decks may ask for, with bars between: `U|UR|...`.
   function requested_names(place, means_only) result(names)
      !> `on_points` or `on_cells`
      integer, intent(in) :: place
      !> Leave out those whose totals are sums
      logical, intent(in), optional :: means_only
      character(len=:), allocatable :: names
      type(state_t) :: nothing
      type(wire_quantity_t), allocatable :: list(:)
      logical :: sums_too
      integer :: i

      sums_too = .true.
      if (present(means_only)) sums_too = .not. means_only
      call list_wire_quantities(nothing, list)
      names = ''
      do i = 1, size(list)
         if (list(i)%place /= place .or. list(i)%request == '' .or. (list(i)%is_sum .and. .not. sums_too)) cycle
         if (index(names//'|', '|'//trim(list(i)%request)//'|') == 0) names = names//'|'//trim(list(i)%request)
      end do
      names = names(2:)
   end function requested_names

   !> What decks may ask for, in words: `U: displacement; UR: rotation; ...`.
   function described_requests(place) result(text)
      !> `on_points` or `on_cells`
      integer, intent(in) :: place
      character(len=:), allocatable :: text
      type(state_t) :: nothing
      type(wire_quantity_t), allocatable :: list(:)
      character(len=:), allocatable :: last
      integer :: i

      call list_wire_quantities(nothing, list)
      text = ''
      last = ''
      do i = 1, size(list)
         if (list(i)%place /= place .or. list(i)%request == '') cycle
         if (list(i)%request == last) then
            text = text//', '//in_words(list(i)%name)
         else
            text = text//'; '//trim(list(i)%request)//': '//in_words(list(i)%name)
         end if
         last = trim(list(i)%request)
      end do
      text = text(3:)
   end function described_requests

   !> `shear force 2` for `shear_force_2`
   pure function in_words(name) result(words)
      !> Of a quantity
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: words
      integer :: i

      words = trim(name)
      do i = 1, len(words)
         if (words(i:i) == '_') words(i:i) = ' '
      end do
   end function in_words

   !> Some rows of an array over nodes or elements.
   subroutine add_rows(list, place, name, unit, text, values, first, components, request, column, is_sum)
      type(wire_quantity_t), allocatable, intent(inout) :: list(:)
      !> As in `wire_quantity_t`; `first`: the first of the rows
      integer, intent(in) :: place, first, components
      !> As in `wire_quantity_t`
      character(len=*), intent(in) :: name, unit, text
      !> (rows, nodes or elements); not there where the state has none
      real(dp), intent(in), optional, target :: values(:, :)
      !> As in `wire_quantity_t`
      character(len=*), intent(in), optional :: request, column
      !> As in `wire_quantity_t`
      logical, intent(in), optional :: is_sum
      type(wire_quantity_t) :: item

      item%place = place
      item%name = name
      item%unit = unit
      item%text = text
      item%components = components
      if (present(request)) item%request = request
      item%column = item%request
      if (present(column)) item%column = column
      if (present(is_sum)) item%is_sum = is_sum
      if (present(values)) item%values => values(first:first + components - 1, :)
      list = [list, item]
   end subroutine add_rows

   !> A value per node or element.
   subroutine add_scalar(list, place, name, unit, text, values, request, column, is_sum)
      type(wire_quantity_t), allocatable, intent(inout) :: list(:)
      !> As in `wire_quantity_t`
      integer, intent(in) :: place
      !> As in `wire_quantity_t`
      character(len=*), intent(in) :: name, unit, text
      !> (nodes or elements); not there where the state has none
      real(dp), intent(in), optional, target :: values(:)
      !> As in `wire_quantity_t`
      character(len=*), intent(in), optional :: request, column
      !> As in `wire_quantity_t`
      logical, intent(in), optional :: is_sum

      call add_rows(list, place, name, unit, text, first=1, components=1, request=request, column=column, is_sum=is_sum)
      if (present(values)) list(size(list))%values(1:1, 1:size(values)) => values
   end subroutine add_scalar

end module litz_result_quantities
