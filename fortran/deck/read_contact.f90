!> *SURFACE INTERACTION and *CONTACT PAIR with what belongs to them.
module litz_read_contact
   use litz_kinds, only: dp
   use litz_text, only: to_text
   use litz_deck, only: token_t
   use litz_axis_choices, only: axis_linear
   use litz_check_over_temperature, only: check_over_temperature
   use litz_heat_law, only: heat_law, heat_metal_law
   use litz_law_words, only: law_words_t
   use litz_model, only: model_t, interaction_t, contact_pair_t
   use litz_normal_law, only: normal_law_t
   use litz_normal_laws, only: normal_law, default_normal_law
   use litz_normal_yielding, only: normal_yielding
   use litz_reader, only: reader_t, fail_at, parameter_of, choice_of, real_parameter, has_flag, keyword_of, &
      n_cards_of, deck_gives
   use litz_spot_law, only: spot_law_t
   use litz_spot_laws, only: spot_law
   use litz_stick_laws, only: stick_laws, stick_mindlin
   use litz_data_lines, only: read_line, describe_form
   use litz_definitions, only: add_definition, find_definition
   use litz_line_contact, only: line_obstacle
   use litz_read_surfaces, only: names_surface, read_surface_pair
   use litz_sets, only: find_set
   use litz_yielding_spot, only: largest_onset
   implicit none
   private
   public :: read_interactions, read_contact_pairs

contains

   subroutine read_interactions(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      type(token_t) :: token
      integer :: card, index
      integer, allocatable :: spot_card(:)
      logical :: has_behavior, has_friction

      allocate (model%interactions(n_cards_of(self, 'SURFACE INTERACTION')))
      allocate (spot_card(size(model%interactions)), source=0)
      index = 0
      has_behavior = .false.
      has_friction = .false.
      do card = 1, self%deck%n_cards
         select case (keyword_of(self, card))
         case ('SURFACE INTERACTION')
            index = 0
            has_behavior = .false.
            has_friction = .false.
            token = parameter_of(self, card, 'NAME')
            if (token%last >= token%first) call add_definition(self, self%interactions, 'surface interaction', token, &
               index)
            if (index == 0) cycle
            model%interactions(index)%name = self%interactions%names%name(index)
            model%interactions(index)%normal = normal_law(default_normal_law)
            if (choice_of(self, card, 'AXIS') == 'LINEAR') model%interactions(index)%axis = axis_linear
         case ('SURFACE BEHAVIOR')
            if (has_behavior) call fail_at(self, self%deck%cards(card)%name, &
               'this surface interaction has two *SURFACE BEHAVIOR')
            has_behavior = .true.
            if (index > 0) call read_behavior(self, card, model%interactions(index))
         case ('FRICTION')
            if (has_friction) call fail_at(self, self%deck%cards(card)%name, &
               'this surface interaction has two *FRICTION')
            has_friction = .true.
            if (index > 0) call read_friction(self, card, model%interactions(index))
         case ('GAP ELECTRICAL CONDUCTANCE')
            if (index == 0) cycle
            if (model%interactions(index)%spot%exists()) call fail_at(self, self%deck%cards(card)%name, &
               'this surface interaction has two *GAP ELECTRICAL CONDUCTANCE')
            call read_spot_law(self, card, model%interactions(index))
            spot_card(index) = card
         case ('GAP CONDUCTANCE')
            if (index == 0) cycle
            if (model%interactions(index)%heat%exists()) call fail_at(self, self%deck%cards(card)%name, &
               'this surface interaction has two *GAP CONDUCTANCE')
            call read_heat_law(self, card, model%interactions(index))
         case ('GAP HEAT GENERATION')
            if (index > 0 .and. has_data(self, card)) call read_friction_heat(self, card, model%interactions(index))
         end select
      end do
      model%interactions = model%interactions(:self%interactions%names%n)
      do index = 1, size(model%interactions)
         if (spot_card(index) == 0) cycle
         call check_spot(self, spot_card(index), model%interactions(index))
         call check_supertemperature(self, spot_card(index), model%interactions(index))
      end do
   end subroutine read_interactions

   !> The spot of wires that yield is that of their force.
   subroutine check_spot(self, card, interaction)
      type(reader_t), intent(inout) :: self
      !> Of the law of the spot
      integer, intent(in) :: card
      type(interaction_t), intent(in) :: interaction

      ! a law that decks do not have has been reported
      if (.not. interaction%normal%yields() .or. .not. interaction%spot%exists()) return
      if (interaction%spot%is_of_mechanics .or. interaction%spot%can_be_per_length) return
      call fail_at(self, parameter_of(self, card, 'LAW'), 'LAW='//trim(interaction%spot%name)// &
         ' makes a spot of its own; with YIELD spots follow the force of wires that yield: LAW=HERTZ, LAW=FILM or'// &
         ' LAW=SHARVIN (CONSTANT and TABLE give the resistance)')
   end subroutine check_spot

   !> A spot that its current warms has a resistance and heat conductance that follow from its size, in some step.
   subroutine check_supertemperature(self, card, interaction)
      type(reader_t), intent(inout) :: self
      !> Of the law of the spot
      integer, intent(in) :: card
      type(interaction_t), intent(in) :: interaction

      if (.not. interaction%supertemperature .or. .not. interaction%spot%exists()) return
      if (interaction%spot%can_be_per_length) call fail_at(self, parameter_of(self, card, 'SUPERTEMPERATURE'), &
         'LAW='//trim(interaction%spot%name)//' gives the resistance, whatever the temperatures in the spot:'// &
         ' SUPERTEMPERATURE is for the laws that know its size')
      if (interaction%heat%is_given()) call fail_at(self, parameter_of(self, card, 'SUPERTEMPERATURE'), &
         'how warm a spot gets follows from its heat conductivity, which LAW='//trim(interaction%heat%name)// &
         ' of *GAP CONDUCTANCE does not say: take LAW=CONDUCTIVITY or LAW=METAL there')
      if (n_cards_of(self, 'COUPLED THERMAL-ELECTRICAL') + n_cards_of(self, 'COUPLED TEMPERATURE-DISPLACEMENT') &
         == 0) call fail_at(self, parameter_of(self, card, 'SUPERTEMPERATURE'), &
         'SUPERTEMPERATURE acts in steps that solve for temperatures, and there is none: *COUPLED'// &
         ' THERMAL-ELECTRICAL or *COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL')
   end subroutine check_supertemperature

   subroutine read_behavior(self, card, interaction)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(interaction_t), intent(inout) :: interaction

      interaction%normal = normal_law(choice_of(self, card, 'PRESSURE-OVERCLOSURE'))
      ! without a word that the table has, which has been reported
      if (.not. interaction%normal%exists()) interaction%normal = normal_law(default_normal_law)
      call read_yielding(self, card, interaction%normal)
      interaction%unlimited_penetration = choice_of(self, card, 'PENETRATION') == 'UNLIMITED'
      call read_law_data(self, card, interaction%normal)
   end subroutine read_behavior

   !> YIELD and HARDNESS of wires whose spots yield.
   subroutine read_yielding(self, card, law)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(normal_law_t), intent(inout) :: law
      real(dp) :: yield_stress, hardness, onset

      yield_stress = real_parameter(self, card, 'YIELD', 0.0_dp)
      hardness = real_parameter(self, card, 'HARDNESS', 0.0_dp)
      if (.not. yield_stress > 0) then
         if (hardness > 0) call fail_at(self, parameter_of(self, card, 'HARDNESS'), &
            'HARDNESS is for wires that yield: give YIELD, too')
         return
      end if
      if (.not. law%is_elastic_line) then
         call fail_at(self, parameter_of(self, card, 'YIELD'), 'YIELD is for PRESSURE-OVERCLOSURE=HERTZ')
         return
      end if
      onset = largest_onset(yield_stress)
      if (hardness > 0 .and. hardness <= onset) then
         call fail_at(self, parameter_of(self, card, 'HARDNESS'), 'a hardness of '//to_text(hardness)// &
            ' is not above the pressure at which the metal of crossed wires begins to yield, up to '//to_text(onset))
         return
      end if
      law = normal_yielding(yield_stress, hardness)
   end subroutine read_yielding

   subroutine read_friction(self, card, interaction)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(interaction_t), intent(inout) :: interaction
      logical :: ok
      integer :: i

      do i = 1, size(stick_laws)
         if (len_trim(stick_laws(i)%parameter) == 0) cycle
         if (.not. has_flag(self, card, trim(stick_laws(i)%parameter))) cycle
         if (interaction%stick_law /= stick_mindlin) call fail_at(self, self%deck%cards(card)%name, &
            '*FRICTION takes '//trim(stick_laws(interaction%stick_law)%parameter)//' or '// &
            trim(stick_laws(i)%parameter)//', not both')
         interaction%stick_law = i
         interaction%stick_value = real_parameter(self, card, trim(stick_laws(i)%parameter), 1.0_dp)
      end do
      if (.not. has_data(self, card)) return
      call read_line(self, card, self%deck%cards(card)%first_data, ok)
      if (ok) interaction%friction = self%values%real(1)
   end subroutine read_friction

   pure logical function has_data(self, card)
      type(reader_t), intent(in) :: self
      !> Index of the card
      integer, intent(in) :: card

      has_data = self%deck%cards(card)%last_data >= self%deck%cards(card)%first_data
   end function has_data

   subroutine read_spot_law(self, card, interaction)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(interaction_t), intent(inout) :: interaction

      interaction%voltage_correction = choice_of(self, card, 'VOLTAGE') == 'CORRECTED'
      interaction%spot_memory = choice_of(self, card, 'SPOT') == 'LARGESTFORCE'
      interaction%mutual_resistance = choice_of(self, card, 'MUTUAL RESISTANCE') == 'YES'
      interaction%supertemperature = choice_of(self, card, 'SUPERTEMPERATURE') == 'YES'
      interaction%spot = spot_law(choice_of(self, card, 'LAW'))
      interaction%spot%is_per_length = choice_of(self, card, 'PER') == 'LENGTH'
      if (interaction%spot%is_per_length .and. .not. interaction%spot%can_be_per_length) then
         call fail_at(self, parameter_of(self, card, 'PER'), 'PER=LENGTH is for LAW=CONSTANT and LAW=TABLE;'// &
            ' the other laws serve contact along lines as they are, but for PAPER')
         interaction%spot%is_per_length = .false.
      end if
      call read_law_data(self, card, interaction%spot)
      call read_free_path(self, card, interaction%spot)
   end subroutine read_spot_law

   !> The mean free path of the electrons, or its product with the resistivity.
   subroutine read_free_path(self, card, law)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(spot_law_t), intent(inout) :: law
      type(token_t) :: token

      token = parameter_of(self, card, 'MEAN FREE PATH')
      associate (is_given => token%last >= token%first)
         if (law%free_path_number == 0) then
            if (is_given .and. law%exists()) call fail_at(self, token, 'MEAN FREE PATH is for LAW=SHARVIN, which is'// &
               ' that of HERTZ or FILM for spots that are not large against it; LAW='//trim(law%name)//' has none')
            return
         end if
         law%data(law%free_path_number) = real_parameter(self, card, 'MEAN FREE PATH', 0.0_dp)
         if (is_given .and. law%data(law%path_number) > 0) call fail_at(self, token, 'LAW='//trim(law%name)// &
            ' takes MEAN FREE PATH or rho_l, its product with the resistivity, not both: leave rho_l blank')
         if (.not. is_given .and. .not. law%data(law%path_number) > 0) call fail_at(self, &
            self%deck%cards(card)%name, 'LAW='//trim(law%name)//' needs MEAN FREE PATH or, on its data line, rho_l,'// &
            ' the product of resistivity and mean free path')
      end associate
   end subroutine read_free_path

   subroutine read_heat_law(self, card, interaction)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(interaction_t), intent(inout) :: interaction

      type(token_t) :: softening, melting
      real(dp) :: of_friction(2)

      of_friction = [interaction%heat%friction_fraction, interaction%heat%surface_share]
      interaction%heat = heat_law(choice_of(self, card, 'LAW'))
      interaction%heat%friction_fraction = of_friction(1)
      interaction%heat%surface_share = of_friction(2)
      interaction%heat%is_per_length = choice_of(self, card, 'PER') == 'LENGTH'
      if (interaction%heat%is_per_length .and. .not. interaction%heat%is_given()) then
         call fail_at(self, parameter_of(self, card, 'PER'), 'PER=LENGTH is for LAW=CONSTANT and LAW=TABLE;'// &
            ' the other laws serve contact along lines as they are')
         interaction%heat%is_per_length = .false.
      end if
      interaction%heat%film = real_parameter(self, card, 'FILM', 0.0_dp)
      if (interaction%heat%film > 0 .and. interaction%heat%is_given()) call fail_at(self, parameter_of(self, card, &
         'FILM'), 'FILM= is for LAW=CONDUCTIVITY and LAW=METAL; a conductance that is given has all in it')
      softening = parameter_of(self, card, 'TSOFT')
      melting = parameter_of(self, card, 'TMELT')
      interaction%heat%has_softening = softening%last >= softening%first
      interaction%heat%has_melting = melting%last >= melting%first
      interaction%heat%softening = real_parameter(self, card, 'TSOFT', 0.0_dp)
      interaction%heat%melting = real_parameter(self, card, 'TMELT', 0.0_dp)
      interaction%heat%may_melt = choice_of(self, card, 'MELTING') == 'WARN'
      interaction%heat%lorenz = real_parameter(self, card, 'LORENZ', 0.0_dp)
      if (interaction%heat%number /= heat_metal_law) then
         if (interaction%heat%lorenz > 0) call fail_at(self, parameter_of(self, card, 'LORENZ'), &
            'LORENZ= is for LAW=METAL')
      else if (.not. deck_gives(self, 'PHYSICAL CONSTANTS', 'ABSOLUTE ZERO')) then
         call fail_at(self, self%deck%cards(card)%name, 'LAW=METAL needs temperatures from absolute zero: give it'// &
            ' by *PHYSICAL CONSTANTS, ABSOLUTE ZERO=0 (kelvin) or -273.15 (Celsius)')
      end if
      call read_law_data(self, card, interaction%heat)

   end subroutine read_heat_law

   subroutine read_friction_heat(self, card, interaction)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(interaction_t), intent(inout) :: interaction
      logical :: ok

      call read_line(self, card, self%deck%cards(card)%first_data, ok)
      if (.not. ok) return
      interaction%heat%friction_fraction = self%values%real(1)
      if (self%values%real(1) > 1) call fail_at(self, self%values%token(1), &
         'friction turns a part of its work to heat, from 0 to 1, not '//to_text(self%values%real(1)))
      if (.not. self%values%given(2)) return
      interaction%heat%surface_share = self%values%real(2)
      if (self%values%real(2) > 1) call fail_at(self, self%values%token(2), &
         'a part of the heat enters the wire, from 0 to 1, not '//to_text(self%values%real(2)))
   end subroutine read_friction_heat

   !> The data line of a law, or its table.
   subroutine read_law_data(self, card, law)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      class(law_words_t), intent(inout) :: law
      real(dp), allocatable :: rows(:, :)
      integer :: line, last, n
      logical :: ok

      if (law%n_fields() == 0) return
      associate (this => self%deck%cards(card))
         allocate (rows(law%n_fields(), max(0, this%last_data - this%first_data + 1)))
         last = this%last_data
         if (.not. law%has_table) last = min(last, this%first_data)
         n = 0
         do line = this%first_data, last
            call read_line(self, card, line, ok)
            if (.not. ok) cycle
            if (n > 0) then
               if (self%values%real(1) <= rows(1, n)) call fail_at(self, self%values%token(1), &
                  'the forces of the table must ascend; '//to_text(self%values%real(1))//' follows '// &
                  to_text(rows(1, n)))
            end if
            n = n + 1
            rows(:, n) = self%values%real(:size(rows, 1))
            if (.not. any(abs(rows(:, n)) > 0)) call fail_at(self, self%values%token(1), &
               'the line has none of the numbers of '//trim(law%name)//': it holds '// &
               describe_form(self%table%keywords(self%spec(card))%data(self%form)))
         end do
      end associate
      if (n > 0 .or. law%has_table) call law%take(reshape(rows(:, :n), [n*size(rows, 1)]))
   end subroutine read_law_data

   !> A law per length alone serves contacts of any length, which the rest of the interaction has to.
   subroutine check_lines(self, card, model, pair)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(model_t), intent(in) :: model
      type(contact_pair_t), intent(in) :: pair

      if (pair%interaction == 0) return
      associate (law => model%interactions(pair%interaction))
         if (len(line_obstacle(law)) == 0) return
         if (law%normal%is_per_length_only()) call fail_at(self, self%deck%cards(card)%name, 'surface interaction '// &
            law%name//' has a stiffness per length alone, which is not possible with '// &
            line_obstacle(law)//': give the penalty at crossings [N/m], too')
         if (law%spot%is_per_length) call fail_at(self, self%deck%cards(card)%name, 'surface interaction '//law%name// &
            ' has a resistance per length (PER=LENGTH), which is not possible with '// &
            line_obstacle(law))
      end associate
   end subroutine check_lines

   !> Of two wires neither takes more of the heat of their friction than the other.
   subroutine check_friction_heat(self, card, model, pair)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(model_t), intent(in) :: model
      type(contact_pair_t), intent(in) :: pair

      if (pair%interaction == 0) return
      associate (law => model%interactions(pair%interaction))
         if (abs(law%heat%surface_share - 0.5_dp) > epsilon(1.0_dp)) call fail_at(self, self%deck%cards(card)%name, &
            'the heat of friction enters both wires half and half: f of *GAP HEAT GENERATION of surface'// &
            ' interaction '//law%name//' is 0.5, not '//to_text(law%heat%surface_share)// &
            ', which is for rigid surfaces')
      end associate
   end subroutine check_friction_heat

   subroutine read_contact_pairs(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      type(contact_pair_t), allocatable :: grown(:)
      type(contact_pair_t) :: pair
      integer :: card
      logical :: ok

      allocate (model%contact_pairs(0))
      do card = 1, self%deck%n_cards
         if (keyword_of(self, card) /= 'CONTACT PAIR') cycle
         pair = contact_pair_t()
         call find_definition(self, self%interactions, 'surface interaction', parameter_of(self, card, 'INTERACTION'), &
            pair%interaction)
         pair%interference_fit = has_flag(self, card, 'INTERFERENCE FIT')
         ok = has_data(self, card)
         if (ok) call read_line(self, card, self%deck%cards(card)%first_data, ok)
         ! what an unreadable pair names is not told to be of no use
         self%surfaces%missed = self%surfaces%missed .or. .not. ok
         if (.not. ok) cycle
         if (names_surface(self)) then
            call read_surface_pair(self, card, pair%interaction, model)
            cycle
         end if
         call find_set(self, 'element', self%element_sets, self%values%token(1), pair%set_bar)
         pair%set = pair%set_bar
         if (self%values%n > 1) call find_set(self, 'element', self%element_sets, self%values%token(2), pair%set, &
            or_surface=self%surfaces%names%n > 0)
         if (pair%set_bar == 0 .or. pair%set == 0) then
            self%surfaces%missed = .true.
            cycle
         end if
         call check_lines(self, card, model, pair)
         call check_friction_heat(self, card, model, pair)
         pair%line = self%deck%lines(self%deck%cards(card)%first_data)%number
         pair%file = self%deck%sources(self%deck%lines(self%deck%cards(card)%first_data)%source)%path
         call check_pair(self, model, pair)
         allocate (grown(size(model%contact_pairs) + 1))
         grown(:size(model%contact_pairs)) = model%contact_pairs
         grown(size(grown)) = pair
         call move_alloc(grown, model%contact_pairs)
      end do
   end subroutine read_contact_pairs

   !> Not the same pair twice, a radius for every element, and no properties over temperature where laws cannot have
   !> them.
   subroutine check_pair(self, model, pair)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(contact_pair_t), intent(in) :: pair
      integer :: i, k, sets(2)
      logical :: ok

      do i = 1, size(model%contact_pairs)
         associate (other => model%contact_pairs(i))
            if (.not. ((other%set_bar == pair%set_bar .and. other%set == pair%set) .or. &
               (other%set_bar == pair%set .and. other%set == pair%set_bar))) cycle
            call fail_at(self, self%values%token(1), 'this contact pair is given twice; first in '//other%file//':'// &
               to_text(other%line))
            exit
         end associate
      end do
      sets = [pair%set_bar, pair%set]
      do k = 1, merge(1, 2, pair%set == pair%set_bar)
         associate (members => model%element_sets(sets(k))%members)
            do i = 1, size(members)
               if (model%element_section(members(i)) == 0) cycle
               call check_over_temperature(self, model, pair%interaction, members(i), self%values%token(k), ok)
               if (.not. ok) exit
               associate (section => model%sections(model%element_section(members(i))))
                  if (section%contact_radius > 0 .or. .not. section%area > 0) cycle
                  call fail_at(self, self%values%token(k), 'element '//to_text(model%element_id(members(i)))// &
                     ' can touch others here, but its *BEAM SECTION of '//section%element_set//' has no CONTACT RADIUS')
                  exit
               end associate
            end do
         end associate
      end do
   end subroutine check_pair

end module litz_read_contact
