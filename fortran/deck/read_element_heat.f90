!> *DFLUX, *FILM and *RADIATE: heat that enters and leaves wires on their length.
module litz_read_element_heat
   use litz_kinds, only: dp
   use litz_data_lines, only: read_line
   use litz_definitions, only: find_definition
   use litz_deck, only: token_t
   use litz_model, only: model_t, element_heat_t, leave_step
   use litz_reader, only: reader_t, fail_at, parameter_of, choice_of, keyword_of, deck_gives
   use litz_sets, only: elements_of, find_item
   use litz_text, only: to_text
   implicit none
   private
   public :: heat_cards_t, begin_heat, read_element_heat

   !> The cards of one step.
   type :: heat_cards_t
      !> Line of the deck that has set a value last (n_elements), 0: none in this step; *DFLUX, *FILM, *RADIATE
      integer, allocatable :: line(:, :)
      !> OP of the cards: 0 none yet, 1 MOD, 2 NEW
      integer :: op(3) = 0
   end type heat_cards_t

   character(len=8), parameter :: keywords(3) = [character(len=8) :: 'DFLUX', 'FILM', 'RADIATE']

contains

   !> A step keeps what earlier ones have given; what has followed an amplitude in step time, the value of their end.
   pure subroutine begin_heat(model, step, cards)
      type(model_t), intent(inout) :: model
      !> Number of the step
      integer, intent(in) :: step
      type(heat_cards_t), intent(out) :: cards
      integer :: i

      allocate (cards%line(model%n_elements, 3), source=0)
      allocate (model%steps(step)%heat(model%n_elements))
      if (step == 1) return
      associate (heat => model%steps(step)%heat)
         heat = model%steps(step - 1)%heat
         do i = 1, size(heat)
            call settle(heat(i)%source, heat(i)%source_amplitude)
            call settle(heat(i)%film, heat(i)%film_amplitude)
            call settle(heat(i)%sink, heat(i)%sink_amplitude)
            call settle(heat(i)%surroundings, heat(i)%surroundings_amplitude)
         end do
         heat%source_before = heat%source
         heat%before_amplitude = heat%source_amplitude
      end associate

   contains

      pure subroutine settle(value, amplitude)
         !> In the unit of the deck
         real(dp), intent(inout) :: value
         !> Index of what it has followed; 0: none, from now on
         integer, intent(inout) :: amplitude
         real(dp) :: factor

         call leave_step(model, model%steps(step - 1)%total, amplitude, factor)
         value = factor*value
      end subroutine settle

   end subroutine begin_heat

   subroutine read_element_heat(self, model, card, heat, cards)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card
      integer, intent(in) :: card
      !> Of the step (n_elements)
      type(element_heat_t), intent(inout) :: heat(:)
      type(heat_cards_t), intent(inout) :: cards
      integer :: kind, line, element, set, amplitude(2)
      logical :: ok

      kind = findloc(keywords == keyword_of(self, card), .true., 1)
      if (kind == 3 .and. .not. model%stefan_boltzmann > 0) then
         call fail_at(self, self%deck%cards(card)%name, '*RADIATE needs the Stefan-Boltzmann constant in the units'// &
            ' of the deck: *PHYSICAL CONSTANTS, STEFAN BOLTZMANN=5.670374e-8')
      else if (kind == 3 .and. .not. deck_gives(self, 'PHYSICAL CONSTANTS', 'ABSOLUTE ZERO')) then
         call fail_at(self, self%deck%cards(card)%name, '*RADIATE needs temperatures from absolute zero: give it'// &
            ' by *PHYSICAL CONSTANTS, ABSOLUTE ZERO=0 (kelvin) or -273.15 (Celsius)')
      end if
      call apply_op(self, card, kind, heat, cards)
      call find_amplitudes(self, model, card, amplitude)
      do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
         call read_line(self, card, line, ok)
         if (.not. ok) cycle
         call find_item(self, 'element', self%element_sets, self%elements, 1, element, set)
         call set_heat(self, model, elements_of(self, model, element, set), kind, line, amplitude, heat, cards)
      end do
   end subroutine read_element_heat

   !> What the values of a card follow: the first one, and the coefficient of a film.
   subroutine find_amplitudes(self, model, card, amplitude)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card
      integer, intent(in) :: card
      !> Indices of amplitudes; 0: none
      integer, intent(out) :: amplitude(2)
      character(len=14), parameter :: parameters(2) = [character(len=14) :: 'AMPLITUDE', 'FILM AMPLITUDE']
      type(token_t) :: token
      integer :: i

      amplitude = 0
      do i = 1, merge(2, 1, keyword_of(self, card) == 'FILM')
         token = parameter_of(self, card, trim(parameters(i)))
         if (token%line > 0) call find_definition(self, self%amplitudes, 'amplitude', token, amplitude(i))
      end do
      if (amplitude(2) == 0) return
      if (any(model%amplitudes(amplitude(2))%factor < 0)) call fail_at(self, token, &
         'a heat transfer coefficient is not negative; the amplitude '//model%amplitudes(amplitude(2))%name// &
         ' has a factor of '//to_text(minval(model%amplitudes(amplitude(2))%factor)))
   end subroutine find_amplitudes

   !> OP=NEW removes what earlier steps left; within a step all cards must agree.
   subroutine apply_op(self, card, kind, heat, cards)
      type(reader_t), intent(inout) :: self
      !> Index of the card, and place of its keyword in `keywords`
      integer, intent(in) :: card, kind
      !> (n_elements)
      type(element_heat_t), intent(inout) :: heat(:)
      type(heat_cards_t), intent(inout) :: cards
      type(token_t) :: token
      integer :: op

      op = merge(2, 1, choice_of(self, card, 'OP') == 'NEW')
      if (all(cards%op(kind) /= [0, op])) then
         token = parameter_of(self, card, 'OP')
         if (token%line == 0) token = self%deck%cards(card)%name
         call fail_at(self, token, 'all *'//trim(keywords(kind))//' of a step must have the same OP')
      else if (op == 2 .and. cards%op(kind) == 0) then
         select case (kind)
         case (1)
            heat%source = 0
            heat%source_amplitude = 0
         case (2)
            heat%film = 0
         case (3)
            heat%emissivity = 0
         end select
      end if
      cards%op(kind) = op
   end subroutine apply_op

   !> What the line read last says of some elements.
   subroutine set_heat(self, model, elements, kind, line, amplitude, heat, cards)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Indices of elements (n), place in `keywords`, and line of the deck
      integer, intent(in) :: elements(:), kind, line
      !> What its values follow (2); 0: nothing
      integer, intent(in) :: amplitude(2)
      !> (n_elements)
      type(element_heat_t), intent(inout) :: heat(:)
      type(heat_cards_t), intent(inout) :: cards
      character(len=:), allocatable :: what
      integer :: i

      what = ''
      do i = 1, size(elements)
         associate (e => elements(i), values => self%values)
            if (cards%line(e, kind) > 0 .and. kind > 1) then
               what = 'has another *'//trim(keywords(kind))//' in '//self%deck%place(cards%line(e, kind))
            else if (cards%line(e, kind) > 0 .and. heat(e)%source_amplitude /= amplitude(1)) then
               what = 'has sources of different amplitudes; the other is in '//self%deck%place(cards%line(e, kind))
            else if (.not. self%broken_keywords) then
               what = reason_against(model, e, kind)
            end if
            if (len(what) > 0) then
               call fail_at(self, values%token(1), 'element '//to_text(model%element_id(e))//' '//what)
               return
            end if
            select case (kind)
            case (1)
               ! lines of a step add up
               heat(e)%source = merge(heat(e)%source, 0.0_dp, cards%line(e, kind) > 0) + values%real(3)
               heat(e)%source_amplitude = amplitude(1)
            case (2)
               heat(e)%sink = values%real(3)
               heat(e)%film = values%real(4)
               heat(e)%sink_amplitude = amplitude(1)
               heat(e)%film_amplitude = amplitude(2)
            case (3)
               heat(e)%surroundings = values%real(3)
               heat(e)%surroundings_amplitude = amplitude(1)
               heat(e)%emissivity = values%real(4)
               if (values%real(4) > 1) call fail_at(self, values%token(4), &
                  'an emissivity is not larger than 1; found '//to_text(values%real(4)))
               if (lowest_surroundings(model, heat(e)) < model%absolute_zero) call fail_at(self, values%token(3), &
                  'surroundings are not below absolute zero, '//to_text(model%absolute_zero)// &
                  ' (*PHYSICAL CONSTANTS, ABSOLUTE ZERO=); found '//to_text(lowest_surroundings(model, heat(e))))
            end select
            cards%line(e, kind) = line
         end associate
      end do
   end subroutine set_heat

   !> What an element radiates to has this temperature at least [K].
   pure real(dp) function lowest_surroundings(model, heat) result(lowest)
      type(model_t), intent(in) :: model
      type(element_heat_t), intent(in) :: heat

      lowest = heat%surroundings
      if (heat%surroundings_amplitude > 0) lowest = minval(heat%surroundings &
         *model%amplitudes(heat%surroundings_amplitude)%factor)
   end function lowest_surroundings

   !> Why an element cannot have such heat; empty: it can. Sections and materials in error are passed over.
   function reason_against(model, e, kind) result(words)
      type(model_t), intent(in) :: model
      !> Index of the element, and place in `keywords`
      integer, intent(in) :: e, kind
      character(len=:), allocatable :: words

      words = ''
      if (model%element_section(e) == 0) return
      associate (section => model%sections(model%element_section(e)))
         if (section%material == 0) return
         if (.not. allocated(model%materials(section%material)%heat_conductivity)) then
            words = 'conducts no heat: its material '//model%materials(section%material)%name//' has no *CONDUCTIVITY'
         else if (kind > 1 .and. .not. section%contact_radius > 0) then
            words = 'has no side: its section has no radius (CONTACT RADIUS of *BEAM SECTION)'
         end if
      end associate
   end function reason_against

end module litz_read_element_heat
