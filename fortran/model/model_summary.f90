!> A summary of the resolved model, for `litz check`.
module litz_model_summary
   use litz_element_loads, only: load_label, n_load_kinds
   use litz_element_types, only: element_types
   use litz_fields, only: fields, field_of_dof, max_dof, field_displacement, field_temperature
   use litz_growing_text, only: growing_text_t
   use litz_kinds, only: dp, pi
   use litz_axis_choices, only: axis_hermite
   use litz_normal_law, only: normal_law_t
   use litz_law_words, only: law_words_t
   use litz_stick_laws, only: stick_laws
   use litz_model, only: model_t, step_t, interaction_t, output_request_t, named_set_t, nodal_value_t, &
      n_nodes_of_deck, &
      element_heat_t, &
      coupling_default, coupling_monolithic, coupling_full, request_node, request_element, request_contact, &
      request_energy
   use litz_parts, only: parts_t, find_parts
   use litz_solver_names, only: solver_default, solver_keyword
   use litz_text, only: to_text, plural, lower
   use litz_unit_labels, only: unit_labels_t
   implicit none
   private
   public :: model_summary, displacements_line

   character(len=1), parameter :: nl = new_line('a')
   !> Most sets that are listed one by one
   integer, parameter :: max_sets = 40

contains

   pure function model_summary(model) result(text)
      type(model_t), intent(in) :: model
      character(len=:), allocatable :: text
      type(growing_text_t) :: summary
      type(parts_t) :: parts
      logical, allocatable :: included(:)
      integer :: i

      allocate (included(model%n_elements), source=.true.)
      call find_parts(model, included, parts)
      if (len(model%heading) > 0) call summary%append(model%heading//nl)
      call summary%append(plural(n_nodes_of_deck(model), 'node')//', '//plural(model%n_elements, 'element')//' ('// &
         counted_types(model%element_type)//'), '//plural(parts%n, 'connected part')//nl)
      do i = 1, size(model%materials)
         call summary%append(material_line(i))
      end do
      do i = 1, size(model%sections)
         call summary%append(section_lines(model, i))
      end do
      call summary%append(set_lines('node set', model%node_sets)//set_lines('element set', model%element_sets))
      do i = 1, size(model%rigid_bodies)
         associate (this => model%rigid_bodies(i))
            call summary%append('rigid body of reference node '//to_text(model%node_id(this%reference_node))//': '// &
               plural(size(this%tied), 'node')//' tied, '//to_text(size(this%pinned))//' pinned'//nl)
         end associate
      end do
      if (size(model%local_axes) > 0) call summary%append('supports, loads or equations along local axes at '// &
         plural(size(model%local_axes), 'node')//nl)
      if (size(model%initial) > 0) call summary%append('before the first step'//nl//value_lines(model%initial, 'given'))
      do i = 1, size(model%amplitudes)
         associate (this => model%amplitudes(i))
            call summary%append('amplitude '//this%name//': '//plural(size(this%time), 'point')//', '// &
               trim(merge('total time', 'step time ', this%total_time))//nl)
         end associate
      end do
      do i = 1, size(model%contact_pairs)
         call summary%append(pair_line(model, i))
      end do
      do i = 1, size(model%surface_pairs)
         call summary%append(surface_pair_line(model, i))
      end do
      call summary%append(displacements_line(model))
      do i = 1, size(model%steps)
         call summary%append(step_lines(model, i))
      end do
      text = summary%text()

   contains

      pure function material_line(m) result(line)
         !> Index of the material
         integer, intent(in) :: m
         character(len=:), allocatable :: line

         associate (this => model%materials(m))
            line = 'material '//this%name//': E = '//to_text(this%young)//model%units%after('Pa')// &
               ', nu = '//to_text(this%poisson)
            if (allocated(this%elastic_table)) line = line//' at '//to_text(this%elastic_table(1, 1))// &
               model%units%after('K')//', over '//plural(size(this%elastic_table, 2), 'temperature')
            if (allocated(this%expansion_table)) line = line//', alpha = '//to_text(this%expansion_table(2, 1))// &
               model%units%after('1/K')
            if (this%conductivity > 0) then
               line = line//', sigma = '//to_text(this%conductivity)//model%units%after('S/m')// &
                  of_table(size(this%resistivity, 2), this%resistivity(1, 1))
            else
               line = line//', insulator'
            end if
            if (allocated(this%superconductor)) line = line//', superconductor in '// &
               to_text(100*this%superconductor%fraction)//' %, n = '//to_text(this%superconductor%exponent)
            if (allocated(this%heat_conductivity)) line = line//', lambda = '// &
               to_text(this%heat_conductivity(2, 1))//model%units%after('W/(m K)')// &
               of_table(size(this%heat_conductivity, 2), this%heat_conductivity(1, 1))
            if (this%density > 0 .and. allocated(this%specific_heat)) line = line//', rho c = '// &
               to_text(this%density*this%specific_heat(2, 1))//model%units%after('J/(m^3 K)')// &
               of_table(size(this%specific_heat, 2), this%specific_heat(1, 1))
            line = line//nl
         end associate
      end function material_line

      !> At which temperature a table begins; nothing of a single value.
      pure function of_table(n, temperature) result(words)
         !> Pairs of the table
         integer, intent(in) :: n
         !> The first [K]
         real(dp), intent(in) :: temperature
         character(len=:), allocatable :: words

         words = ''
         if (n > 1) words = ' at '//to_text(temperature)//model%units%after('K')//' ('//to_text(n)// &
            ' temperatures)'
      end function of_table

   end function model_summary

   !> How many elements there are of each type: `2 B31, 1 B33`.
   pure function counted_types(types) result(text)
      !> Rows of `element_types` (n_elements)
      integer, intent(in) :: types(:)
      character(len=:), allocatable :: text
      integer :: i

      text = ''
      do i = 1, size(element_types)
         text = text//', '//to_text(count(types == i))//' '//trim(element_types(i)%name)
      end do
      text = text(3:)
   end function counted_types

   pure function section_lines(model, s) result(text)
      type(model_t), intent(in) :: model
      !> Index of the section
      integer, intent(in) :: s
      character(len=:), allocatable :: text

      associate (this => model%sections(s))
         text = 'section of '//this%element_set//' ('//plural(count(model%element_section == s), 'element')//', '// &
            model%materials(this%material)%name//'): A = '//with_unit(this%area, 'm^2')//', I2 = '// &
            with_unit(this%i2, 'm^4')//', I3 = '//with_unit(this%i3, 'm^4')//', J = '//with_unit(this%j, 'm^4')// &
            ', GA2 = '//with_unit(this%ga2, 'N')//', GA3 = '//with_unit(this%ga3, 'N')
         if (abs(this%stiffness - 1) > 0) text = text//', stiffnesses times '//to_text(this%stiffness)
         if (abs(this%turn) > 0) text = text//', principal axes turned by '//to_text(this%turn*180/pi)// &
            ' degrees from n1'
         if (any(abs([this%shear_centre, this%centroid]) > 0)) text = text//', centroid '// &
            place(this%shear_centre + this%centroid)//' and shear centre '//place(this%shear_centre)//' from the node'
         if (this%contact_radius > 0) text = text//', contact radius '//with_unit(this%contact_radius, 'm')
         if (norm2(this%n1) > 0) text = text//', n1 = ('//to_text(this%n1(1))//', '//to_text(this%n1(2))//', '// &
            to_text(this%n1(3))//')'
         if (this%current_length) text = text//', conduction over the current length'
      end associate
      text = text//nl

   contains

      pure function with_unit(value, unit) result(words)
         !> In the unit of the deck
         real(dp), intent(in) :: value
         !> That unit in SI
         character(len=*), intent(in) :: unit
         character(len=:), allocatable :: words

         words = to_text(value)//model%units%after(unit)
      end function with_unit

      pure function place(y) result(words)
         !> Along n1 and n2 (2) [m]
         real(dp), intent(in) :: y(2)
         character(len=:), allocatable :: words

         words = '('//to_text(y(1))//', '//to_text(y(2))//')'//model%units%after('m')
      end function place

   end function section_lines

   pure function set_lines(what, sets) result(text)
      !> What the sets are called in the singular, such as `node set`
      character(len=*), intent(in) :: what
      type(named_set_t), intent(in) :: sets(:)
      character(len=:), allocatable :: text
      integer :: i

      text = ''
      do i = 1, min(size(sets), max_sets)
         text = text//what//' '//sets(i)%name//': '//plural(size(sets(i)%members), 'member')//nl
      end do
      if (size(sets) > max_sets) text = text//'and '//to_text(size(sets) - max_sets)//' more '//what//'s'//nl
   end function set_lines

   pure function pair_line(model, p) result(line)
      type(model_t), intent(in) :: model
      !> Index of the contact pair
      integer, intent(in) :: p
      character(len=:), allocatable :: line

      associate (pair => model%contact_pairs(p))
         line = 'contact pair '//model%element_sets(pair%set_bar)%name
         if (pair%set == pair%set_bar) then
            line = line//' within itself: '
         else
            line = line//' with '//model%element_sets(pair%set)%name//': '
         end if
         line = line//describe_interaction(model%interactions(pair%interaction), model%units, between_wires=.true.)
         if (pair%interference_fit) line = line//', interference fit'
      end associate
      line = line//nl
   end function pair_line

   pure function surface_pair_line(model, p) result(line)
      type(model_t), intent(in) :: model
      !> Index of the pair
      integer, intent(in) :: p
      character(len=:), allocatable :: line

      associate (pair => model%surface_pairs(p))
         line = 'contact pair '//model%element_sets(pair%set)%name//' with the rigid surface '// &
            model%surfaces(pair%surface)%name//': '// &
            describe_interaction(model%interactions(pair%interaction), model%units, between_wires=.false.)//nl
      end associate
   end function surface_pair_line

   pure function describe_interaction(interaction, units, between_wires) result(words)
      type(interaction_t), intent(in) :: interaction
      type(unit_labels_t), intent(in) :: units
      !> Of a pair of wires: a rigid surface has one potential, which nothing corrects
      logical, intent(in) :: between_wires
      character(len=:), allocatable :: words

      words = interaction%name//', '//trim(merge('Hermite', 'linear ', interaction%axis == axis_hermite))//' axis, '
      words = words//trim(interaction%normal%summary)//describe_normal_data(interaction%normal, units)
      if (interaction%normal%yields()) words = words//', yield stress '// &
         describe_value(interaction%normal%yield_stress, 'Pa', units)
      if (interaction%normal%hardness > 0) words = words//', hardness '// &
         describe_value(interaction%normal%hardness, 'Pa', units)
      if (interaction%friction > 0) words = words//describe_friction(interaction, units)
      if (interaction%unlimited_penetration) words = words//', unlimited penetration'
      if (interaction%spot%exists()) then
         words = words//', spot '//trim(interaction%spot%name)//describe_spot_data( &
            interaction%spot, interaction%spot%is_per_length, units)
         if (interaction%spot_memory) words = words//' of the largest force'
         if (between_wires) words = words//describe_transfer(interaction)
      else
         words = words//', no current'
      end if
      if (interaction%heat%exists()) words = words//', heat '//trim(interaction%heat%name)// &
         describe_spot_data(interaction%heat, interaction%heat%is_per_length, units)
   end function describe_interaction

   !> What happens where current passes from wire to wire.
   pure function describe_transfer(interaction) result(words)
      type(interaction_t), intent(in) :: interaction
      character(len=:), allocatable :: words

      words = ', '//trim(merge('corrected', 'linear   ', interaction%voltage_correction))//' voltage'
      if (interaction%mutual_resistance) words = words//', mutual resistances'
      if (interaction%supertemperature) words = words//', warmed by its current'
   end function describe_transfer

   !> `name value unit` of each number of a normal law.
   pure function describe_normal_data(law, units) result(words)
      type(normal_law_t), intent(in) :: law
      type(unit_labels_t), intent(in) :: units
      character(len=:), allocatable :: words
      integer :: i

      words = ''
      do i = 1, law%n_fields()
         associate (field => law%fields(i))
            if (.not. law%data(i) > 0) cycle
            if (len_trim(law%summary) > 0 .or. len(words) > 0) words = words//' '
            words = words//trim(field%name)//' '//describe_value(law%data(i), field%unit, units)
         end associate
      end do
   end function describe_normal_data

   !> ` with name = value unit` for each number of a spot law, or how many points its table has.
   pure function describe_spot_data(law, per_length, units) result(words)
      class(law_words_t), intent(in) :: law
      !> PER=LENGTH
      logical, intent(in) :: per_length
      type(unit_labels_t), intent(in) :: units
      character(len=:), allocatable :: words, unit
      integer :: i

      words = ''
      if (law%has_table) then
         words = ' of '//plural(size(law%table, 2), 'point')
         if (per_length) words = words//' per length'
         return
      end if
      do i = 1, law%n_numbers()
         if (.not. law%data(i) > 0) cycle
         associate (field => law%fields(i))
            words = words//trim(merge(' with', ' and ', len(words) == 0))//' '
            unit = trim(field%unit)
            ! a resistance times length, and a heat conductance per length
            if (per_length .and. unit == 'ohm') unit = 'ohm m'
            if (per_length .and. unit == 'W/K') unit = 'W/(m K)'
            words = words//trim(field%name)//' = '//describe_value(law%data(i), unit, units)
         end associate
      end do
   end function describe_spot_data

   pure function describe_value(value, unit, units) result(words)
      !> A number in the unit
      real(dp), intent(in) :: value
      !> In SI; `-`: none
      character(len=*), intent(in) :: unit
      type(unit_labels_t), intent(in) :: units
      character(len=:), allocatable :: words

      words = to_text(value)
      if (unit /= '-') words = words//units%after(trim(unit))
   end function describe_value

   pure function describe_friction(interaction, units) result(words)
      type(interaction_t), intent(in) :: interaction
      type(unit_labels_t), intent(in) :: units
      character(len=:), allocatable :: words

      words = ', friction '//to_text(interaction%friction)
      associate (law => stick_laws(interaction%stick_law))
         if (len_trim(law%parameter) > 0) words = words//' with '//lower(trim(law%parameter))//' '// &
            to_text(interaction%stick_value)//units%after(trim(law%unit))
      end associate
   end function describe_friction

   !> Which elements have heat on their length.
   pure function heat_line(heat) result(line)
      !> (n_elements)
      type(element_heat_t), intent(in) :: heat(:)
      character(len=:), allocatable :: line

      line = ''
      if (any(abs(heat%source) > 0)) line = line//', heat sources in '//plural(count(abs(heat%source) > 0), 'element')
      if (any(heat%film > 0)) line = line//', films on '//plural(count(heat%film > 0), 'element')
      if (any(heat%emissivity > 0)) line = line//', radiation from '//plural(count(heat%emissivity > 0), 'element')
      if (len(line) > 0) line = '  '//line(3:)//nl
   end function heat_line

   !> How many elements each kind of force acts on.
   pure function element_load_lines(step) result(text)
      type(step_t), intent(in) :: step
      character(len=:), allocatable :: text
      integer :: kind, n, i

      text = ''
      do kind = 1, n_load_kinds
         n = count([(step%element_loads(i)%kind == kind .and. any(abs(step%element_loads(i)%value) > 0), &
            i=1, size(step%element_loads))])
         if (n > 0) text = text//'  loads '//load_label(kind)//' on '//plural(n, 'element')//nl
      end do
   end function element_load_lines

   pure function step_lines(model, s) result(text)
      type(model_t), intent(in) :: model
      !> Number of the step
      integer, intent(in) :: s
      character(len=:), allocatable :: text
      integer :: i

      associate (step => model%steps(s))
         text = 'step '//to_text(s)
         if (len(step%title) > 0) text = text//' ('//step%title//')'
         if (step%solves(field_temperature)) text = text// &
            trim(merge(': motions,', ':         ', step%solves(field_displacement)))//' currents and temperatures'// &
            trim(merge(' over time', '          ', step%transient))
         text = text//': time '//to_text(step%total)//model%units%after('s')//', '
         if (step%direct) then
            text = text//'increments of '//to_text(step%first)//model%units%after('s')
         else
            text = text//'increments first '//to_text(step%first)//', smallest '//to_text(step%smallest)// &
               ', largest '// &
               to_text(step%largest)//model%units%after('s')
         end if
         text = text//', at most '//to_text(step%max_increments)//describe_solver(step)//nl
         text = text//value_lines(pack(step%boundary, .not. step%boundary%stays), &
            'prescribed')//fixed_line(step%boundary)//value_lines(step%load, 'loads')// &
            value_lines(step%predefined, 'given')
         text = text//element_load_lines(step)
         if (step%solves(field_temperature)) text = text//heat_line(step%heat)
         do i = 1, size(step%requests)
            text = text//request_line(model, step%requests(i))
         end do
      end associate
   end function step_lines

   !> How many degrees of freedom stay what they are when the step begins.
   pure function fixed_line(boundary) result(line)
      type(nodal_value_t), intent(in) :: boundary(:)
      character(len=:), allocatable :: line

      line = ''
      if (any(boundary%stays)) line = '  prescribed to stay as they are: '//to_text(count(boundary%stays))// &
         ' degrees of freedom'//nl
   end function fixed_line

   !> A line for decks with a step that does not say NLGEOM, whose displacements are small in Abaqus and CalculiX; else
   !> empty.
   pure function displacements_line(model) result(line)
      type(model_t), intent(in) :: model
      character(len=:), allocatable :: line
      integer :: i

      line = ''
      do i = 1, size(model%steps)
         if (model%steps(i)%nlgeom .or. .not. model%steps(i)%solves(field_displacement)) cycle
         line = 'displacements are large in every step, with or without NLGEOM'//nl
         return
      end do
   end function displacements_line

   pure function describe_solver(step) result(words)
      type(step_t), intent(in) :: step
      character(len=:), allocatable :: words

      words = ''
      if (step%solver /= solver_default) words = ', solver '//trim(solver_keyword(step%solver))
      if (step%reform_kernel > 0) words = words//', modified Newton, at most '//to_text(step%reform_kernel)// &
         ' iterations with a kept factor'
      if (step%coupling /= coupling_default) words = words//', coupling '// &
         trim(coupling_words(step%coupling))
   end function describe_solver

   pure function coupling_words(coupling) result(words)
      !> As a deck asks for it
      integer, intent(in) :: coupling
      character(len=10) :: words

      words = 'updated'
      if (coupling == coupling_monolithic) words = 'monolithic'
      if (coupling == coupling_full) words = 'full'
   end function coupling_words

   !> How many values for each degree of freedom, and their range.
   pure function value_lines(items, kind) result(text)
      type(nodal_value_t), intent(in) :: items(:)
      !> What they are: `prescribed`, `loads` or `given`
      character(len=*), intent(in) :: kind
      character(len=:), allocatable :: text, what
      integer :: dof, n, i
      real(dp) :: lowest, highest

      text = ''
      do dof = 1, max_dof
         n = 0
         lowest = huge(lowest)
         highest = -huge(highest)
         do i = 1, size(items)
            if (items(i)%dof /= dof) cycle
            n = n + 1
            lowest = min(lowest, items(i)%value)
            highest = max(highest, items(i)%value)
         end do
         if (n == 0) cycle
         what = kind
         associate (field => fields(field_of_dof(dof)))
            if (kind == 'loads' .and. field%is_level) what = trim(field%flux_in_words)//'s'
         end associate
         text = text//'  '//what//' at degree of freedom '//to_text(dof)//': '//plural(n, 'node')//', '//to_text(lowest)
         if (highest > lowest) text = text//' to '//to_text(highest)
         text = text//nl
      end do
   end function value_lines

   pure function request_line(model, request) result(line)
      type(model_t), intent(in) :: model
      type(output_request_t), intent(in) :: request
      character(len=:), allocatable :: line
      integer :: i

      select case (request%kind)
      case (request_node)
         line = '  output of node set '//model%node_sets(request%set)%name//':'
      case (request_element)
         line = '  output of element set '//model%element_sets(request%set)%name//':'
      case (request_energy)
         line = '  output of energies'
      case (request_contact)
         line = '  output of contacts in the terminal'
      case default
         line = '  output between electrodes '//model%node_sets(request%set)%name//' and '// &
            model%node_sets(request%set_2)%name
      end select
      do i = 1, size(request%quantities)
         line = line//' '//trim(request%quantities(i))
      end do
      if (request%totals) line = line//' (sums)'
      line = line//nl
   end function request_line

end module litz_model_summary
