!> *RIGID SURFACE, and the pairs of *CONTACT PAIR that name one.
module litz_read_surfaces
   use litz_kinds, only: dp
   use litz_text, only: to_text
   use litz_check_over_temperature, only: check_over_temperature
   use litz_conduction, only: surface_obstacle
   use litz_deck, only: token_t
   use litz_data_lines, only: read_line
   use litz_definitions, only: add_definition, find_definition
   use litz_model, only: model_t, rigid_body_surface_t, surface_pair_t, radius_at
   use litz_reader, only: reader_t, fail_at, parameter_of, choice_of, has_flag, keyword_of, n_cards_of, &
      integer_parameter, name_of
   use litz_sets, only: find_set
   use litz_surface_choices, only: surface_plane, surface_cylinder, surface_bore
   implicit none
   private
   public :: read_surfaces, names_surface, read_surface_pair

contains

   subroutine read_surfaces(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      type(token_t) :: token
      integer :: card, index

      allocate (model%surfaces(n_cards_of(self, 'RIGID SURFACE')), model%surface_pairs(0))
      do card = 1, self%deck%n_cards
         if (keyword_of(self, card) /= 'RIGID SURFACE') cycle
         token = parameter_of(self, card, 'NAME')
         index = 0
         if (token%last >= token%first) call add_definition(self, self%surfaces, 'rigid surface', token, index)
         if (index == 0) cycle
         model%surfaces(index)%name = self%surfaces%names%name(index)
         if (self%element_sets%names%get(name_of(self, token)) > 0) call fail_at(self, token, &
            'there is an element set of the name '//self%deck%shown(token)//', too: *CONTACT PAIR could mean either')
         call read_surface(self, card, model, model%surfaces(index))
      end do
      model%surfaces = model%surfaces(:self%surfaces%names%n)
   end subroutine read_surfaces

   subroutine read_surface(self, card, model, surface)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(model_t), intent(in) :: model
      type(rigid_body_surface_t), intent(inout) :: surface
      type(token_t) :: token
      logical :: ok

      select case (choice_of(self, card, 'TYPE'))
      case ('CYLINDER')
         surface%shape = surface_cylinder
      case ('BORE')
         surface%shape = surface_bore
      case default
         surface%shape = surface_plane
      end select
      token = parameter_of(self, card, 'REF NODE')
      if (token%last >= token%first) then
         surface%node = self%nodes%get(integer_parameter(self, card, 'REF NODE', 0))
         if (surface%node == 0) call fail_at(self, token, 'there is no node '//self%deck%shown(token))
      end if
      associate (this => self%deck%cards(card))
         if (this%last_data < this%first_data) return
         call read_line(self, card, this%first_data, ok)
      end associate
      if (.not. ok) return
      surface%point = self%values%real(1:3)
      surface%direction = self%values%real(4:6)
      if (surface%shape /= surface_plane) surface%radius = self%values%real(7)
      call read_radius_amplitude(self, card, model, surface)
      if (norm2(surface%direction) > 0) then
         surface%direction = surface%direction/norm2(surface%direction)
      else
         call fail_at(self, self%values%token(4), 'the direction of a surface cannot be 0 0 0')
      end if
   end subroutine read_surface

   !> What the radius follows: an amplitude over total time, positive everywhere.
   subroutine read_radius_amplitude(self, card, model, surface)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(model_t), intent(in) :: model
      type(rigid_body_surface_t), intent(inout) :: surface
      type(token_t) :: token

      token = parameter_of(self, card, 'RADIUS AMPLITUDE')
      if (token%last < token%first) return
      if (surface%shape == surface_plane) then
         call fail_at(self, token, 'a plane has no radius; its reference node moves it')
         return
      end if
      call find_definition(self, self%amplitudes, 'amplitude', token, surface%radius_amplitude)
      if (surface%radius_amplitude == 0) return
      associate (amplitude => model%amplitudes(surface%radius_amplitude))
         if (.not. amplitude%total_time) call fail_at(self, token, 'a radius goes on from step to step: the'// &
            ' amplitude '//amplitude%name//' needs TIME=TOTAL TIME')
         if (any(.not. amplitude%factor > 0)) call fail_at(self, token, 'the factors of the amplitude '// &
            amplitude%name//' must be positive for a radius')
      end associate
   end subroutine read_radius_amplitude

   !> The second name on the data line of a *CONTACT PAIR is that of a surface.
   logical function names_surface(self)
      type(reader_t), intent(in) :: self

      names_surface = self%values%n > 1
      if (names_surface) names_surface = self%surfaces%names%get(name_of(self, self%values%token(2))) > 0
   end function names_surface

   !> A pair of wires and a surface, whose data line has been read.
   subroutine read_surface_pair(self, card, interaction, model)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> Index into the interactions; 0 after an error
      integer, intent(in) :: interaction
      type(model_t), intent(inout) :: model
      type(surface_pair_t) :: pair

      pair%interaction = interaction
      call find_definition(self, self%surfaces, 'rigid surface', self%values%token(2), pair%surface)
      call find_set(self, 'element', self%element_sets, self%values%token(1), pair%set)
      if (pair%set == 0) return
      associate (line => self%deck%lines(self%deck%cards(card)%first_data))
         pair%line = line%number
         pair%file = self%deck%sources(line%source)%path
      end associate
      if (has_flag(self, card, 'INTERFERENCE FIT')) call fail_at(self, self%deck%cards(card)%name, &
         'INTERFERENCE FIT is for wires; move a rigid surface against the wires by its reference node')
      call check_members(self, model, pair)
      call check_laws(self, model, pair)
      call check_conduction(self, model, pair)
      model%surface_pairs = [model%surface_pairs, pair]
   end subroutine read_surface_pair

   !> Each wire has a radius, fits into a bore, is in one pair with a surface only, and yields at one elasticity.
   subroutine check_members(self, model, pair)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(surface_pair_t), intent(in) :: pair
      integer :: i
      logical :: ok

      do i = 1, size(model%surface_pairs)
         associate (other => model%surface_pairs(i))
            if (other%set == pair%set .and. other%surface == pair%surface) call fail_at(self, &
               self%values%token(1), 'this contact pair is given twice; first in '//other%file//':'// &
               to_text(other%line))
         end associate
      end do
      associate (members => model%element_sets(pair%set)%members, surface => model%surfaces(pair%surface))
         do i = 1, size(members)
            if (model%element_section(members(i)) == 0) cycle
            call check_over_temperature(self, model, pair%interaction, members(i), self%values%token(1), ok)
            if (.not. ok) return
            associate (section => model%sections(model%element_section(members(i))), &
               element => 'element '//to_text(model%element_id(members(i))))
               if (.not. section%contact_radius > 0 .and. section%area > 0) then
                  call fail_at(self, self%values%token(1), element//' can touch a surface here, but its'// &
                     ' *BEAM SECTION of '//section%element_set//' has no CONTACT RADIUS')
                  return
               else if (surface%shape == surface_bore .and. section%contact_radius >= radius_at(model, pair%surface, &
                  0.0_dp)) then
                  call fail_at(self, self%values%token(1), element//' does not fit into the bore '//surface%name)
                  return
               end if
            end associate
         end do
      end associate
   end subroutine check_members

   !> A wire touches a surface along a line.
   subroutine check_laws(self, model, pair)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(surface_pair_t), intent(in) :: pair

      if (pair%interaction == 0) return
      associate (this => model%interactions(pair%interaction))
         if (this%normal%serves_lines()) return
         if (this%normal%line_penalty_number > 0) then
            call fail_at(self, self%values%token(2), 'a wire touches a rigid surface along a line: the law '// &
               trim(this%normal%name)//' of '//this%name//' needs its second number, the force per length and'// &
               ' penetration')
         else
            call fail_at(self, self%values%token(2), 'a wire touches a rigid surface along a line; the law '// &
               this%normal%called()//' of '//this%name//' is one of crossings')
         end if
      end associate
   end subroutine check_laws

   !> Current and heat pass to a reference node, by conductances per length.
   subroutine check_conduction(self, model, pair)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(surface_pair_t), intent(in) :: pair

      if (pair%interaction == 0 .or. pair%surface == 0) return
      associate (law => model%interactions(pair%interaction), surface => model%surfaces(pair%surface))
         if (len(surface_obstacle(law)) > 0) then
            call fail_at(self, self%values%token(2), 'a wire touches a rigid surface along a line: surface'// &
               ' interaction '//law%name//' has '//surface_obstacle(law))
         else if ((law%spot%exists() .or. law%heat%exists()) .and. surface%node == 0) then
            call fail_at(self, self%values%token(2), 'surface interaction '//law%name//' passes '// &
               trim(merge('current', 'heat   ', law%spot%exists()))//' to the rigid surface '//surface%name// &
               ', which needs a reference node for it: REF NODE= of *RIGID SURFACE')
         end if
      end associate
   end subroutine check_conduction

end module litz_read_surfaces
