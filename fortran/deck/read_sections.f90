!> *BEAM SECTION and *BEAM GENERAL SECTION: shape, material and first axis of cross-sections.
module litz_read_sections
   use litz_kinds, only: dp, pi
   use litz_numbers, only: parse_real, number_ok
   use litz_text, only: to_text
   use litz_deck, only: token_t
   use litz_model, only: model_t, section_t, material_t, shear_given, shear_round, shear_by_factors
   use litz_section_shapes, only: section_shape_t, round_wire, rectangle, box, unlike_box, pipe, i_section, l_section, &
      turn_to_principal_axes
   use litz_section_stiffness, only: shear_stiffness
   use litz_reader, only: reader_t, fail_at, parameter_of, choice_of, has_flag, keyword_of, real_parameter, &
      n_cards_of, name_of
   use litz_section_checks, only: check_second_moments, check_warping, check_walls, check_flanges, check_legs, is_same
   use litz_data_lines, only: read_line, read_only_line
   use litz_definitions, only: find_definition
   use litz_rotations, only: cross
   use litz_sets, only: find_set
   implicit none
   private
   public :: read_sections

   !> Sine of the angle below which an axis counts as parallel to an element
   real(dp), parameter :: parallel = 1.0e-4_dp
   !> First axis of sections that are not round, where the deck gives none: as in Abaqus and CalculiX
   real(dp), parameter :: default_axis(3) = [0.0_dp, 0.0_dp, -1.0_dp]

contains

   !> Sections, and the section of every element.
   subroutine read_sections(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      !> Line of the *BEAM SECTION of each section
      integer, allocatable :: section_line(:)
      integer :: card, section_card, n
      logical :: ok

      n = n_cards_of(self, 'BEAM SECTION') + n_cards_of(self, 'BEAM GENERAL SECTION')
      allocate (model%sections(n), section_line(n))
      allocate (model%element_section(model%n_elements), source=0)
      n = 0
      do card = 1, self%deck%n_cards
         select case (keyword_of(self, card))
         case ('BEAM SECTION', 'BEAM GENERAL SECTION')
            n = n + 1
            section_card = card
            section_line(n) = self%deck%cards(card)%name%line
            call read_section(self, model, card, model%sections(n))
            call assign_section(self, model, card, n, section_line)
         case ('TRANSVERSE SHEAR STIFFNESS')
            call read_only_line(self, card, ok)
            if (ok .and. n > 0) call set_given_shear(self, card, model%sections(n))
         case ('CENTROID', 'SHEAR CENTER')
            call read_only_line(self, card, ok)
            if (ok .and. n > 0) call set_centre(self, card, section_card, model%sections(n))
         end select
      end do
      call report_bare_elements(self, model)
   end subroutine read_sections

   subroutine read_section(self, model, card, section)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      !> Index of the card
      integer, intent(in) :: card
      type(section_t), intent(inout) :: section
      type(token_t) :: name
      logical :: ok

      section%element_set = ''
      name = parameter_of(self, card, 'ELSET')
      if (name%last < name%first) self%missed_section = .true.
      section%current_length = choice_of(self, card, 'CONDUCTION') == 'CURRENTLENGTH'
      if (.not. needs_moduli(self, card)) then
         call find_definition(self, self%materials, 'material', parameter_of(self, card, 'MATERIAL'), section%material)
         associate (this => self%deck%cards(card))
            if (this%last_data > this%first_data + 1) call fail_at(self, self%deck%line_token(this%first_data + 2), &
               'a section has a MATERIAL, or E and G on its third line, not both')
         end associate
      else
         call read_moduli(self, model, card, section%material)
      end if
      call read_only_line(self, card, ok)
      if (ok .and. section%material > 0) then
         associate (material => model%materials(section%material))
            call set_shape(self, choice_of(self, card, 'SECTION'), material%poisson, section, ok)
            if (ok) call set_shear(section, material%young, material%poisson)
            if (ok) call set_offset(self, card, section)
         end associate
      end if
      section%stiffness = real_parameter(self, card, 'STIFFNESS', 1.0_dp)
      section%contact_radius = real_parameter(self, card, 'CONTACT RADIUS', section%contact_radius)
      ! a wrong radius or factor was reported; here it only must not look like none
      if (has_flag(self, card, 'CONTACT RADIUS') .and. .not. section%contact_radius > 0) section%contact_radius = 1
      if (.not. section%stiffness > 0) section%stiffness = 1
   end subroutine read_section

   !> What the data line says of the cross-section, in the order of the dimensions of Abaqus.
   subroutine set_shape(self, word, poisson, section, ok)
      type(reader_t), intent(inout) :: self
      !> Value of SECTION
      character(len=*), intent(in) :: word
      !> Poisson's ratio [-]
      real(dp), intent(in) :: poisson
      type(section_t), intent(inout) :: section
      !> .false.: something was reported
      logical, intent(out) :: ok
      type(section_shape_t) :: shape

      ok = .true.
      section%shear = shear_by_factors
      associate (given => self%values%real)
         select case (word)
         case ('CIRC')
            shape = round_wire(given(1), poisson)
            section%shear = shear_round
            section%contact_radius = given(1)
         case ('GENERAL')
            shape%area = given(1)
            shape%j = given(5)
            call check_second_moments(self, ok)
            if (ok) call check_warping(self, ok)
            if (ok) call turn_to_principal_axes(shape, given(2:4))
         case ('RECT')
            shape = rectangle(given(1), merge(given(2), given(1), self%values%given(2)), poisson)
         case ('BOX')
            call check_walls(self, ok)
            if (ok .and. is_same(given(3), given(5)) .and. is_same(given(4), given(6))) then
               shape = box(given(1), given(2), given(3), given(4), poisson)
            else if (ok) then
               shape = unlike_box(given(1), given(2), given(3:6))
            end if
         case ('PIPE')
            ok = given(2) <= given(1)
            if (.not. ok) call fail_at(self, self%values%token(2), 'the wall of a pipe is at most as thick as its'// &
               ' outer radius, '//to_text(given(1))//'; found '//to_text(given(2)))
            if (ok) shape = pipe(given(1), given(2), poisson)
         case ('I')
            call check_flanges(self, ok)
            if (ok) shape = i_section(given(2), given(3), given(5), given(7), poisson)
            if (ok .and. .not. is_same(2*given(1), given(2))) shape%shear_centre(2) = given(2)/2 - given(1)
         case ('L')
            call check_legs(self, ok)
            if (ok) shape = l_section(given(1), given(2), given(3), given(4))
         end select
      end associate
      if (.not. ok) shape = section_shape_t(1.0_dp, 1.0_dp, 1.0_dp, 1.0_dp)
      section%area = shape%area
      section%i2 = shape%i11
      section%i3 = shape%i22
      section%j = shape%j
      section%shear_factor = shape%shear_factor
      section%turn = shape%turn
      section%shear_centre = shape%shear_centre
      section%centroid = shape%centroid
      if (allocated(shape%corners)) section%corners = shape%corners
      section%outer_radius = shape%radius
      ! as in Abaqus, where no axis is given; the axes of round sections are of no consequence
      if (allocated(shape%corners)) section%n1 = default_axis
   end subroutine set_shape

   !> Shear stiffnesses that the deck gives, along n2 and n1, in place of those of the section.
   !> Source: Abaqus, *TRANSVERSE SHEAR STIFFNESS: K23, K13, slenderness compensation factor.
   subroutine set_given_shear(self, card, section)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(section_t), intent(inout) :: section
      real(dp) :: along_n2, along_n1, factor
      integer :: status

      along_n2 = self%values%real(1)
      along_n1 = self%values%real(2)
      if (name_of(self, self%values%token(3)) /= 'SCF') then
         call parse_real(self%deck%text(self%values%token(3)), factor, status)
         if (self%values%given(3) .and. (status /= number_ok .or. factor < 0)) then
            call fail_at(self, self%values%token(3), 'SCF must be a number, 0 or greater, or the word SCF; found '// &
               self%deck%shown(self%values%token(3)))
            return
         end if
         if (.not. max(along_n1, along_n2) > 0) then
            call fail_at(self, self%deck%line_token(self%deck%cards(card)%first_data), 'a shear stiffness is'// &
               ' missing: K23, for shear along n2, or K13, for shear along n1')
            return
         end if
         if (.not. along_n1 > 0) along_n1 = along_n2
         if (.not. along_n2 > 0) along_n2 = along_n1
      end if
      if (.not. max(along_n1, along_n2) > 0) return
      if (abs(section%turn) > 0) then
         call fail_at(self, self%deck%cards(card)%name, 'shear stiffnesses along n1 and n2 are given where these'// &
            ' are principal axes of the section; here they are turned by '//to_text(section%turn*180/pi)//' degrees')
         return
      end if
      if (along_n1 > 0) section%ga2 = along_n1
      if (along_n2 > 0) section%ga3 = along_n2
      section%shear = shear_given
   end subroutine set_given_shear

   !> Centroid or shear centre of a GENERAL section, from the node along n1 and n2.
   subroutine set_centre(self, card, section_card, section)
      type(reader_t), intent(inout) :: self
      !> Index of the card, and of the card of the section
      integer, intent(in) :: card, section_card
      type(section_t), intent(inout) :: section
      real(dp) :: centroid(2)

      associate (this => self%deck%cards(card))
         if (choice_of(self, section_card, 'SECTION') /= 'GENERAL') then
            call fail_at(self, this%name, '*'//keyword_of(self, card)//' is for SECTION=GENERAL: other sections'// &
               ' have'// &
               ' theirs from their shape')
         else if (.not. norm2(section%n1) > 0) then
            call fail_at(self, this%name, '*'//keyword_of(self, card)//' is along the section axes: give the'// &
               ' first one'// &
               ' in the second data line of the section')
         else if (keyword_of(self, card) == 'CENTROID') then
            section%centroid = self%values%real(1:2) - section%shear_centre
         else
            centroid = section%shear_centre + section%centroid
            section%shear_centre = self%values%real(1:2)
            section%centroid = centroid - section%shear_centre
         end if
      end associate
   end subroutine set_centre

   !> A section beside its nodes, by OFFSET1 and OFFSET2 of CalculiX: the node is that many sides from the middle.
   subroutine set_offset(self, card, section)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(section_t), intent(inout) :: section
      real(dp) :: offset(2), side(2)

      offset = [real_parameter(self, card, 'OFFSET1', 0.0_dp), real_parameter(self, card, 'OFFSET2', 0.0_dp)]
      if (.not. any(abs(offset) > 0)) return
      side = 2*section%outer_radius
      if (allocated(section%corners)) side = maxval(section%corners, 2) - minval(section%corners, 2)
      if (.not. all(side > 0)) then
         call fail_at(self, self%deck%cards(card)%name, 'OFFSET1 and OFFSET2 count sides of the section, and'// &
            ' GENERAL'// &
            ' has none')
         return
      end if
      section%shear_centre = section%shear_centre - offset*side
      ! what touches is not around the nodes
      section%contact_radius = 0
      ! the direction in which it lies must be known
      if (.not. norm2(section%n1) > 0) section%n1 = default_axis
   end subroutine set_offset

   subroutine set_shear(section, young, poisson)
      type(section_t), intent(inout) :: section
      !> Young's modulus [Pa] and Poisson's ratio
      real(dp), intent(in) :: young, poisson
      real(dp) :: shear(2)

      shear = shear_stiffness(section, young, poisson)
      section%ga2 = shear(1)
      section%ga3 = shear(2)
   end subroutine set_shear

   !> Whether E and G are on the third data line, as there is no material.
   pure logical function needs_moduli(self, card)
      type(reader_t), intent(in) :: self
      !> Index of the card
      integer, intent(in) :: card

      needs_moduli = keyword_of(self, card) /= 'BEAM SECTION' .and. .not. has_flag(self, card, 'MATERIAL')
   end function needs_moduli

   !> The elasticity of a *BEAM GENERAL SECTION without a material: E and G on its third line make one.
   subroutine read_moduli(self, model, card, material)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      !> Index of the card
      integer, intent(in) :: card
      !> Index of the new material; 0 after an error
      integer, intent(out) :: material
      type(token_t) :: name
      type(material_t) :: new
      logical :: ok

      material = 0
      associate (this => self%deck%cards(card))
         if (this%last_data < this%first_data + 2) then
            call fail_at(self, this%name, '*BEAM GENERAL SECTION needs a MATERIAL, or three data lines:'// &
               ' dimensions, the first axis n1 or a blank line, and E, G')
            ! two values are E and G, which belong on the third line
            call self%deck%split(this%last_data, self%values%token, self%values%n)
            self%line_read(this%first_data:this%last_data) = self%line_read(this%first_data:this%last_data) &
               .or. self%values%n <= 2
            return
         end if
         call read_line(self, card, this%first_data + 2, ok)
      end associate
      if (.not. ok) return
      name = parameter_of(self, card, 'ELSET')
      new%name = 'OF '//name_of(self, name)
      new%young = self%values%real(1)
      new%poisson = new%young/(2*self%values%real(2)) - 1
      new%density = real_parameter(self, card, 'DENSITY', 0.0_dp)
      if (new%poisson <= -1 .or. new%poisson >= 0.5_dp) then
         call fail_at(self, self%values%token(2), 'E and G are those of no isotropic material: E/(2 G) - 1,'// &
            ' Poisson''s'// &
            ' ratio, is '//to_text(new%poisson)//'; it must be between -1 and 0.5')
         return
      end if
      call append_material(model, new)
      material = size(model%materials)
   end subroutine read_moduli

   pure subroutine append_material(model, new)
      type(model_t), intent(inout) :: model
      type(material_t), intent(in) :: new
      type(material_t), allocatable :: grown(:)
      integer :: i, n

      n = size(model%materials)
      allocate (grown(n + 1))
      do i = 1, n
         grown(i) = model%materials(i)
      end do
      grown(n + 1) = new
      call move_alloc(grown, model%materials)
   end subroutine append_material

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
      integer :: set, i, n_twice, line
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
         ok = .true.
         line = this%name%line
         if (this%last_data == this%first_data + 1 .and. needs_moduli(self, card)) then
            ! two values are E and G, of which it was told that they belong on the third line
            call self%deck%split(this%last_data, self%values%token, self%values%n)
            ok = self%values%n > 2
         end if
         if (ok .and. this%last_data > this%first_data) then
            line = this%first_data + 1
            call read_axis(self, card, line, model%sections(section)%n1, ok)
         end if
         if (ok .and. norm2(model%sections(section)%n1) > 0) call check_axis(self, model, card, members, line, &
            model%sections(section)%n1)
      end associate
   end subroutine assign_section

   !> The second data line; without any value it stands for the axis that Abaqus takes.
   subroutine read_axis(self, card, line, n1, ok)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> Index into the lines of the deck
      integer, intent(in) :: line
      !> First section axis, of any length
      real(dp), intent(inout) :: n1(3)
      !> .false.: something was reported
      logical, intent(out) :: ok

      call self%deck%split(line, self%values%token, self%values%n)
      ok = .true.
      if (self%values%n == 0) then
         self%line_read(line) = .true.
         n1 = default_axis
         return
      end if
      call read_line(self, card, line, ok)
      if (ok) n1 = self%values%real(1:3)
      if (ok .and. .not. norm2(n1) > 0) then
         ok = .false.
         call fail_at(self, self%deck%line_token(line), 'the first section axis n1 is zero; give a direction')
      end if
   end subroutine read_axis

   !> n1 must not be parallel to any element of the section.
   subroutine check_axis(self, model, card, members, line, n1)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card
      integer, intent(in) :: card
      !> Indices of the elements (n)
      integer, intent(in) :: members(:)
      !> Index of the line that gives n1, or of the section where that is the default
      integer, intent(in) :: line
      !> First section axis, of any length
      real(dp), intent(in) :: n1(3)
      real(dp) :: chord(3)
      character(len=:), allocatable :: default_words
      integer :: i

      default_words = ''
      if (line < self%deck%cards(card)%first_data) default_words = '(0, 0, -1 without a second data line) '
      do i = 1, size(members)
         associate (node => model%connectivity(:, members(i)))
            if (any(node == 0)) cycle
            chord = model%x(:, node(2)) - model%x(:, node(1))
         end associate
         ! elements without length were reported
         if (.not. norm2(chord) > 0) cycle
         if (norm2(cross(chord/norm2(chord), n1/norm2(n1))) > parallel) cycle
         call fail_at(self, self%deck%line_token(line), 'the first section axis n1 '//default_words// &
            'is parallel to'// &
            ' element '//to_text(model%element_id(members(i)))//'; it must be across the wire')
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

end module litz_read_sections
