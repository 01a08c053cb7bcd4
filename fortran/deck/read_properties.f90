!> *MATERIAL, *BEAM SECTION and *AMPLITUDE with what belongs to them.
module litz_read_properties
   use litz_kinds, only: dp, pi
   use litz_critical_law, only: superconductor_t
   use litz_text, only: to_text
   use litz_deck, only: token_t
   use litz_model, only: model_t, section_t, shear_given, shear_round, shear_unreduced
   use litz_section_stiffness, only: shear_stiffness
   use litz_reader, only: reader_t, definitions_t, fail_at, parameter_of, choice_of, has_flag, keyword_of, &
      real_parameter, n_cards_of
   use litz_data_lines, only: read_line
   use litz_definitions, only: add_definition, find_definition
   use litz_rotations, only: cross
   use litz_read_superconductor, only: read_superconductor
   use litz_sets, only: find_set
   implicit none
   private
   public :: read_materials, read_sections, read_amplitudes, report_unused

   !> Sine of the angle below which an axis counts as parallel to an element
   real(dp), parameter :: parallel = 1.0e-4_dp

contains

   subroutine read_materials(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      real(dp), allocatable :: table(:, :)
      type(superconductor_t) :: superconductor
      integer :: card, material, i
      logical :: ok

      allocate (model%materials(n_cards_of(self, 'MATERIAL')))
      material = 0
      do card = 1, self%deck%n_cards
         select case (keyword_of(self, card))
         case ('MATERIAL')
            call add_named(self, self%materials, 'material', card, material)
            if (material > 0) model%materials(material)%name = self%materials%names%name(material)
         case ('ELASTIC')
            call read_property(self, card, 2, table, ok)
            if (material == 0) cycle
            associate (this => model%materials(material))
               if (this%young > 0) call fail_at(self, self%deck%cards(card)%name, &
                  'the material '//this%name//' has two *ELASTIC')
               ! wrong values were reported; the material then counts as complete
               this%young = table(2, 1)
               this%poisson = table(3, 1)
               if (size(table, 2) > 1) this%elastic_table = table
            end associate
         case ('ELECTRICAL CONDUCTIVITY')
            call read_property(self, card, 1, table, ok)
            if (material == 0) cycle
            associate (this => model%materials(material))
               if (this%conductivity > 0) call fail_at(self, self%deck%cards(card)%name, &
                  'the material '//this%name//' has two *ELECTRICAL CONDUCTIVITY')
               this%conductivity = table(2, 1)
               table(2, :) = 1/table(2, :)
               this%resistivity = table
            end associate
         case ('EXPANSION')
            call read_property(self, card, 1, table, ok)
            if (material == 0) cycle
            associate (this => model%materials(material))
               if (allocated(this%expansion_table)) call fail_at(self, self%deck%cards(card)%name, &
                  'the material '//this%name//' has two *EXPANSION')
               this%expansion_table = table
               this%expansion_zero = real_parameter(self, card, 'ZERO', 0.0_dp)
            end associate
         case ('CONDUCTIVITY')
            call read_property(self, card, 1, table, ok)
            if (material == 0) cycle
            associate (this => model%materials(material))
               if (allocated(this%heat_conductivity)) call fail_at(self, self%deck%cards(card)%name, &
                  'the material '//this%name//' has two *CONDUCTIVITY')
               this%heat_conductivity = table
            end associate
         case ('DENSITY', 'SPECIFIC HEAT', 'LATENT HEAT')
            call read_storage(self, model, card, material)
         case ('SUPERCONDUCTOR')
            call read_superconductor(self, card, superconductor)
            if (material == 0) cycle
            associate (this => model%materials(material))
               if (allocated(this%superconductor)) call fail_at(self, self%deck%cards(card)%name, &
                  'the material '//this%name//' has two *SUPERCONDUCTOR')
               this%superconductor = superconductor
            end associate
         case ('JOULE HEAT FRACTION')
            call read_only_line(self, card, ok)
            if (.not. ok .or. material == 0) cycle
            model%materials(material)%joule_fraction = self%values%real(1)
            if (self%values%real(1) > 1) call fail_at(self, self%values%token(1), &
               'the part of the electric power that becomes heat cannot be more than 1; found '// &
               to_text(self%values%real(1)))
         end select
      end do
      model%materials = model%materials(:self%materials%names%n)
      do i = 1, size(model%materials)
         if (allocated(model%materials(i)%superconductor) .and. .not. model%materials(i)%conductivity > 0) &
            call fail_at(self, self%materials%token(i), 'the material '//model%materials(i)%name// &
            ' has *SUPERCONDUCTOR, but no *ELECTRICAL CONDUCTIVITY of the metal around it')
         if (model%materials(i)%young > 0) cycle
         call fail_at(self, self%materials%token(i), 'the material '//model%materials(i)%name//' has no *ELASTIC')
      end do
   end subroutine read_materials

   !> What says how much heat a material stores.
   subroutine read_storage(self, model, card, material)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      !> Index of the card, and of the material (0: in error)
      integer, intent(in) :: card, material
      real(dp), allocatable :: table(:, :)
      logical :: ok, twice

      select case (keyword_of(self, card))
      case ('DENSITY')
         call read_only_line(self, card, ok)
         table = reshape([merge(self%values%real(1), 1.0_dp, ok)], [1, 1])
      case ('SPECIFIC HEAT')
         call read_property(self, card, 1, table, ok)
      case ('LATENT HEAT')
         call read_latent_heat(self, card, table)
      end select
      if (material == 0) return
      associate (this => model%materials(material))
         select case (keyword_of(self, card))
         case ('DENSITY')
            twice = this%density > 0
            this%density = table(1, 1)
         case ('SPECIFIC HEAT')
            twice = allocated(this%specific_heat)
            this%specific_heat = table
         case default
            twice = allocated(this%latent_heat)
            this%latent_heat = table
         end select
         if (twice) call fail_at(self, self%deck%cards(card)%name, 'the material '//this%name//' has two *'// &
            keyword_of(self, card))
      end associate
   end subroutine read_storage

   !> Heats, and the temperatures between which each is taken up (3, n); ascending.
   subroutine read_latent_heat(self, card, table)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> Heats [J/kg], solidus and liquidus temperatures [K] (3, n)
      real(dp), allocatable, intent(out) :: table(:, :)
      integer :: line
      logical :: ok
      real(dp) :: last

      allocate (table(3, 0))
      do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
         call read_line(self, card, line, ok)
         if (.not. ok) cycle
         associate (values => self%values%real)
            last = -huge(last)
            if (size(table, 2) > 0) last = table(3, size(table, 2))
            if (values(3) <= values(2)) then
               call fail_at(self, self%values%token(3), 'the liquidus must be above the solidus; '// &
                  to_text(values(3))//' follows '//to_text(values(2)))
            else if (values(2) < last) then
               call fail_at(self, self%values%token(2), 'changes of phase must ascend; '//to_text(values(2))// &
                  ' is below the liquidus of the one before, '//to_text(last))
            else
               table = reshape([table, values(:3)], [3, size(table, 2) + 1])
            end if
         end associate
      end do
   end subroutine read_latent_heat

   !> Properties over temperature, on lines of their values and the temperature.
   subroutine read_property(self, card, n_values, table, ok)
      type(reader_t), intent(inout) :: self
      !> Index of the card, and values before the temperature
      integer, intent(in) :: card, n_values
      !> Temperatures and values (1 + n_values, n), one line at least
      real(dp), allocatable, intent(out) :: table(:, :)
      !> .false.: something was reported; the table is then one that does no harm
      logical, intent(out) :: ok
      integer :: line
      logical :: line_ok

      ok = .true.
      allocate (table(1 + n_values, 0))
      associate (this => self%deck%cards(card), values => self%values, at => n_values + 1)
         do line = this%first_data, this%last_data
            call read_line(self, card, line, line_ok)
            ok = ok .and. line_ok
            if (.not. line_ok) cycle
            if (.not. values%given(at) .and. this%last_data > this%first_data) then
               if (ok) call fail_at(self, values%token(at), 'a temperature is missing: every line of a table has one')
               ok = .false.
            else if (size(table, 2) > 0) then
               if (values%real(at) <= table(1, size(table, 2))) then
                  call fail_at(self, values%token(at), 'the temperatures of *'//keyword_of(self, card)// &
                     ' must ascend; '//to_text(values%real(at))//' follows '//to_text(table(1, size(table, 2))))
                  ok = .false.
               end if
            end if
            table = reshape([table, values%real(at), values%real(:n_values)], [at, size(table, 2) + 1])
         end do
      end associate
      ok = ok .and. size(table, 2) > 0
      if (.not. ok) table = reshape([0.0_dp, 1.0_dp, spread(0.0_dp, 1, n_values - 1)], [1 + n_values, 1])
   end subroutine read_property

   !> The name a card defines; 0 where it has none or it exists already.
   subroutine add_named(self, definitions, what, card, index)
      type(reader_t), intent(inout) :: self
      type(definitions_t), intent(inout) :: definitions
      !> What is defined, as messages name it
      character(len=*), intent(in) :: what
      !> Index of the card
      integer, intent(in) :: card
      !> Index of the definition
      integer, intent(out) :: index
      type(token_t) :: token

      index = 0
      token = parameter_of(self, card, 'NAME')
      if (token%last >= token%first) call add_definition(self, definitions, what, token, index)
   end subroutine add_named

   !> The first data line of a card; `ok` is .false. when there is none.
   subroutine read_only_line(self, card, ok)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> .false.: there is no line, or something about it was reported
      logical, intent(out) :: ok

      ok = self%deck%cards(card)%last_data >= self%deck%cards(card)%first_data
      if (ok) call read_line(self, card, self%deck%cards(card)%first_data, ok)
   end subroutine read_only_line

   !> Sections, and the section of every element.
   subroutine read_sections(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      !> Line of the *BEAM SECTION of each section
      integer, allocatable :: section_line(:)
      integer :: card, n
      logical :: ok

      allocate (model%sections(n_cards_of(self, 'BEAM SECTION')), section_line(n_cards_of(self, 'BEAM SECTION')))
      allocate (model%element_section(model%n_elements), source=0)
      n = 0
      do card = 1, self%deck%n_cards
         select case (keyword_of(self, card))
         case ('BEAM SECTION')
            n = n + 1
            section_line(n) = self%deck%cards(card)%name%line
            call read_section(self, model, card, model%sections(n))
            call assign_section(self, model, card, n, section_line)
         case ('TRANSVERSE SHEAR STIFFNESS')
            call read_only_line(self, card, ok)
            if (.not. ok .or. n == 0) cycle
            model%sections(n)%ga2 = self%values%real(1)
            model%sections(n)%ga3 = self%values%real(2)
            model%sections(n)%shear = shear_given
         end select
      end do
      call report_bare_elements(self, model)
   end subroutine read_sections

   subroutine read_section(self, model, card, section)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card
      integer, intent(in) :: card
      type(section_t), intent(inout) :: section
      type(token_t) :: name
      logical :: ok

      section%element_set = ''
      call find_definition(self, self%materials, 'material', parameter_of(self, card, 'MATERIAL'), section%material)
      section%current_length = choice_of(self, card, 'CONDUCTION') == 'CURRENTLENGTH'
      call read_only_line(self, card, ok)
      if (ok .and. section%material > 0) then
         associate (material => model%materials(section%material))
            select case (choice_of(self, card, 'SECTION'))
            case ('CIRC')
               call set_circular(section, self%values%real(1), material%young, material%poisson)
            case ('GENERAL')
               call set_general(section, self%values%real(1:5), material%young, material%poisson)
            end select
         end associate
      end if
      section%contact_radius = real_parameter(self, card, 'CONTACT RADIUS', section%contact_radius)
      ! a wrong radius was reported; here it only must not look like none
      if (has_flag(self, card, 'CONTACT RADIUS') .and. .not. section%contact_radius > 0) section%contact_radius = 1
      name = parameter_of(self, card, 'ELSET')
      if (name%last < name%first) self%missed_section = .true.
   end subroutine read_section

   !> Solid round wire.
   pure subroutine set_circular(section, radius, young, poisson)
      type(section_t), intent(inout) :: section
      !> Radius of the wire [m]
      real(dp), intent(in) :: radius
      !> Young's modulus [Pa]
      real(dp), intent(in) :: young
      !> Poisson's ratio [-]
      real(dp), intent(in) :: poisson

      section%contact_radius = radius
      section%area = pi*radius**2
      section%i2 = pi*radius**4/4
      section%i3 = section%i2
      section%j = pi*radius**4/2
      section%shear = shear_round
      section%ga2 = shear_stiffness(section, young, poisson)
      section%ga3 = section%ga2
   end subroutine set_circular

   !> Section of given stiffnesses; shear is not reduced.
   pure subroutine set_general(section, data, young, poisson)
      type(section_t), intent(inout) :: section
      !> A [m^2], I11, I12, I22, J [m^4]
      real(dp), intent(in) :: data(5)
      !> Young's modulus [Pa]
      real(dp), intent(in) :: young
      !> Poisson's ratio [-]
      real(dp), intent(in) :: poisson

      section%area = data(1)
      section%i2 = data(2)
      section%i3 = data(4)
      section%j = data(5)
      section%shear = shear_unreduced
      section%ga2 = shear_stiffness(section, young, poisson)
      section%ga3 = section%ga2
   end subroutine set_general

   !> Give the section to the elements of its set, and check its axis n1 against them.
   subroutine assign_section(self, model, card, section, section_line)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      !> Index of the card
      integer, intent(in) :: card
      !> Index of the section
      integer, intent(in) :: section
      !> Line of the deck that defines each section (sections)
      integer, intent(in) :: section_line(:)
      integer :: set, i, n_twice
      logical :: ok

      call find_set(self, 'element', self%element_sets, parameter_of(self, card, 'ELSET'), set)
      if (set == 0) then
         self%missed_section = .true.
         return
      end if
      n_twice = 0
      model%sections(section)%element_set = model%element_sets(set)%name
      associate (members => model%element_sets(set)%members, this => self%deck%cards(card))
         do i = 1, size(members)
            associate (old => model%element_section(members(i)))
               if (old > 0) then
                  n_twice = n_twice + 1
                  if (n_twice == 1) call fail_at(self, parameter_of(self, card, 'ELSET'), 'element '// &
                     to_text(model%element_id(members(i)))//' has two sections; the first one is in '// &
                     self%deck%place(section_line(old)))
               end if
               old = section
            end associate
         end do
         if (this%last_data <= this%first_data) return
         call read_line(self, card, this%first_data + 1, ok)
         if (ok) call check_axis(self, model, members, this%first_data + 1, model%sections(section)%n1)
      end associate
   end subroutine assign_section

   !> n1 must not be parallel to any element of the section.
   subroutine check_axis(self, model, members, line, n1)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Indices of the elements (n)
      integer, intent(in) :: members(:)
      !> Index of the line that gives n1
      integer, intent(in) :: line
      !> First section axis, of any length
      real(dp), intent(out) :: n1(3)
      real(dp) :: chord(3)
      integer :: i

      n1 = self%values%real(1:3)
      if (.not. norm2(n1) > 0) then
         call fail_at(self, self%deck%line_token(line), 'the first section axis n1 is zero; give a direction')
         return
      end if
      do i = 1, size(members)
         associate (node => model%connectivity(:, members(i)))
            if (any(node == 0)) cycle
            chord = model%x(:, node(2)) - model%x(:, node(1))
         end associate
         ! elements without length were reported
         if (.not. norm2(chord) > 0) cycle
         if (norm2(cross(chord/norm2(chord), n1/norm2(n1))) > parallel) cycle
         call fail_at(self, self%deck%line_token(line), 'the first section axis n1 is parallel to element '// &
            to_text(model%element_id(members(i)))//'; it must be across the wire')
         return
      end do
   end subroutine check_axis

   !> Elements that no section names: one error for all of them.
   subroutine report_bare_elements(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      character(len=:), allocatable :: others
      integer :: n, first

      if (self%missed_section) return
      n = count(model%element_section == 0)
      if (n == 0) return
      first = findloc(model%element_section, 0, 1)
      others = ''
      if (n > 1) others = ', nor have '//to_text(n - 1)//' others'
      call fail_at(self, self%deck%line_token(self%element_line(first)), 'element '// &
         to_text(model%element_id(first))// &
         ' has no *BEAM SECTION'//others)
   end subroutine report_bare_elements

   subroutine read_amplitudes(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      integer :: card, amplitude

      allocate (model%amplitudes(n_cards_of(self, 'AMPLITUDE')))
      do card = 1, self%deck%n_cards
         if (keyword_of(self, card) /= 'AMPLITUDE') cycle
         call add_named(self, self%amplitudes, 'amplitude', card, amplitude)
         if (amplitude == 0) cycle
         model%amplitudes(amplitude)%name = self%amplitudes%names%name(amplitude)
         model%amplitudes(amplitude)%total_time = choice_of(self, card, 'TIME') == 'TOTALTIME'
         call read_points(self, card, model%amplitudes(amplitude)%time, model%amplitudes(amplitude)%factor)
      end do
      model%amplitudes = model%amplitudes(:self%amplitudes%names%n)
   end subroutine read_amplitudes

   !> The pairs of all data lines, with ascending times.
   subroutine read_points(self, card, time, factor)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> Times (n) [s], ascending
      real(dp), allocatable, intent(out) :: time(:)
      !> Factors at these times (n)
      real(dp), allocatable, intent(out) :: factor(:)
      integer :: line, i, n
      logical :: ok

      associate (this => self%deck%cards(card))
         allocate (time(4*max(1, this%last_data - this%first_data + 1)), factor(4*max(1, &
            this%last_data - this%first_data + 1)))
         n = 0
         do line = this%first_data, this%last_data
            call read_line(self, card, line, ok)
            if (.not. ok) cycle
            do i = 1, self%values%n - 1, 2
               if (n > 0) then
                  if (self%values%real(i) <= time(n)) call fail_at(self, self%values%token(i), &
                     'the times of an amplitude must ascend; '//to_text(self%values%real(i))//' follows '// &
                     to_text(time(n)))
               end if
               n = n + 1
               time(n) = self%values%real(i)
               factor(n) = self%values%real(i + 1)
            end do
         end do
      end associate
      time = time(:n)
      factor = factor(:n)
   end subroutine read_points

   !> A definition that nothing refers to is most often a misspelled reference.
   subroutine report_unused(self, definitions, what)
      type(reader_t), intent(inout) :: self
      type(definitions_t), intent(in) :: definitions
      !> What is defined, as messages name it
      character(len=*), intent(in) :: what
      integer :: i

      if (definitions%missed) return
      do i = 1, definitions%names%n
         if (definitions%used(i)) cycle
         call fail_at(self, definitions%token(i), 'the '//what//' '//definitions%names%name(i)// &
            ' is defined but never used; use it or remove it')
      end do
   end subroutine report_unused

end module litz_read_properties
