!> Checks of every card against the keyword table: the keyword itself, its place in the deck, its parameters, and the
!> number of its data lines. What the values mean is left to the readers.
module litz_card_checks
   use litz_kinds, only: dp
   use litz_text, only: squeezed, to_text, join_words, nearest_word, word_length
   use litz_deck, only: token_t
   use litz_keywords, only: parameter_spec_t, data_spec_t, unknown_keyword_message, keyword_meant, place_model, &
      place_step, place_begins_step, kind_flag, kind_choice
   use litz_foreign_words, only: advice_about, role_of, role_data, role_idle, role_join, role_mesh
   use litz_reader, only: reader_t, fail_at, warn_of_idle, applies, has_choice
   use litz_value_checks, only: check_value
   implicit none
   private
   public :: check_cards

contains

   !> Fill `spec` and `step` of the reader, and report what is wrong about keywords and parameters.
   subroutine check_cards(self)
      type(reader_t), intent(inout) :: self
      integer :: card
      !> Name of the keyword that later ones may belong to
      character(len=:), allocatable :: parent
      logical :: is_sound

      associate (n => self%deck%n_cards)
         allocate (self%spec(n), self%step(n), source=0)
         allocate (self%told(n), self%is_idle(n), source=.false.)
         do card = 1, n
            self%spec(card) = self%table%find(self%deck%text(self%deck%cards(card)%name))
            if (self%spec(card) > 0) cycle
            if (is_told_before(self, card)) cycle
            self%is_idle(card) = role_of(self%deck%text(self%deck%cards(card)%name)) == role_idle
            call unknown_keyword(self, card)
         end do
         call check_steps(self)
         self%broken_keywords = any(self%spec == 0 .and. self%step == 0 .and. .not. self%is_idle)
         parent = ''
         do card = 1, n
            if (self%spec(card) == 0) cycle
            call check_parent(self, card, parent)
            call check_parameters(self, card, is_sound)
            if (is_sound) call check_data_lines(self, card)
         end do
      end associate
   end subroutine check_cards

   !> A card that says which motions the coupling before it joins, which litz lacks as a whole.
   logical function is_told_before(self, card)
      type(reader_t), intent(in) :: self
      !> Index of the card
      integer, intent(in) :: card

      is_told_before = .false.
      if (card == 1) return
      associate (cards => self%deck%cards)
         is_told_before = squeezed(self%deck%text(cards(card - 1)%name)) == 'COUPLING' .and. &
            any(squeezed(self%deck%text(cards(card)%name)) == [character(len=12) :: 'KINEMATIC', 'DISTRIBUTING'])
      end associate
   end function is_told_before

   !> One that litz lacks: an error, unless it changes no result.
   subroutine unknown_keyword(self, card)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      character(len=:), allocatable :: word, message
      type(token_t) :: token

      token = self%deck%cards(card)%name
      word = self%deck%text(token)
      message = unknown_keyword_message(self%table, word, self%deck%shown(token))
      token%first = token%first - 1
      if (self%is_idle(card)) then
         call warn_of_idle(self, card, token, message)
      else
         call fail_at(self, token, message)
         call note_lost_mesh(self, word)
      end if
   end subroutine unknown_keyword

   !> What an unknown keyword was to give is not told to be missing: nodes, elements, what moves nodes of no element.
   pure subroutine note_lost_mesh(self, word)
      type(reader_t), intent(inout) :: self
      !> The keyword as the user wrote it
      character(len=*), intent(in) :: word
      character(len=:), allocatable :: meant

      if (role_of(word) == role_mesh) then
         self%broken_nodes = .true.
         self%broken_elements = .true.
      else if (role_of(word) == role_join) then
         self%broken_bodies = .true.
      else if (len(advice_about(word)) == 0) then
         meant = keyword_meant(self%table, word)
         self%broken_nodes = self%broken_nodes .or. meant == 'NODE'
         self%broken_elements = self%broken_elements .or. any(meant == [character(len=7) :: 'NODE', 'ELEMENT'])
      end if
   end subroutine note_lost_mesh

   !> Model part first, then steps, each from *STEP to *END STEP. Cards out of place are not read further.
   subroutine check_steps(self)
      type(reader_t), intent(inout) :: self
      integer :: card, step_card
      logical :: in_step

      in_step = .false.
      step_card = 0
      do card = 1, self%deck%n_cards
         if (in_step) self%step(card) = self%n_steps
         if (self%spec(card) == 0) cycle
         associate (keyword => self%table%keywords(self%spec(card)))
            select case (keyword%place)
            case (place_begins_step)
               if (in_step) call fail_at(self, self%deck%cards(card)%name, '*STEP within the step that begins in '// &
                  self%deck%place(self%deck%cards(step_card)%name%line)//'; *END STEP is missing')
               in_step = .true.
               step_card = card
               self%n_steps = self%n_steps + 1
               self%step(card) = self%n_steps
            case (place_step)
               if (.not. in_step) then
                  call fail_at(self, self%deck%cards(card)%name, '*'//trim(keyword%name)// &
                     ' belongs in a step, between *STEP and *END STEP')
                  self%spec(card) = 0
               end if
               if (keyword%name == 'END STEP') in_step = .false.
            case (place_model)
               if (self%n_steps > 0) then
                  call fail_at(self, self%deck%cards(card)%name, '*'//trim(keyword%name)// &
                     ' belongs in the model part, before the first *STEP')
                  self%spec(card) = 0
               end if
            case default
               if (self%n_steps > 0 .and. .not. in_step) then
                  call fail_at(self, self%deck%cards(card)%name, '*'//trim(keyword%name)// &
                     ' is between two steps; it belongs in the model part or in a step')
                  self%spec(card) = 0
               end if
            end select
         end associate
      end do
      if (in_step) call fail_at(self, self%deck%cards(step_card)%name, '*END STEP of this step is missing')
      if (self%n_steps == 0 .and. self%deck%n_lines > 0) call fail_at(self, &
         self%deck%end_of_line(self%deck%n_lines), 'the deck ends without any *STEP, so there is nothing to run')
   end subroutine check_steps

   !> Keywords such as *ELASTIC must stand in the group of the keyword they belong to.
   subroutine check_parent(self, card, parent)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> In: the keyword whose group the card stands in, empty at the beginning. Out: that of the next card
      character(len=:), allocatable, intent(inout) :: parent

      associate (keyword => self%table%keywords(self%spec(card)))
         if (len_trim(keyword%after) == 0) then
            parent = trim(keyword%name)
            if (len_trim(keyword%counts_as) > 0) parent = trim(keyword%counts_as)
         else if (parent /= trim(keyword%after)) then
            call fail_at(self, self%deck%cards(card)%name, '*'//trim(keyword%name)//' must follow the *'// &
               trim(keyword%after)//' it belongs to, before any other keyword')
            self%spec(card) = 0
         end if
      end associate
   end subroutine check_parent

   subroutine check_parameters(self, card, is_sound)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> .false.: a parameter or a choice is none that litz has, so that it is not known what else the card should have
      logical, intent(out) :: is_sound
      integer :: i, j, index
      integer, allocatable :: seen(:)

      is_sound = .true.
      if (self%spec(card) == 0) return
      associate (keyword => self%table%keywords(self%spec(card)), given => self%deck%cards(card)%parameters)
         allocate (seen(size(keyword%parameters)), source=0)
         do i = 1, size(given)
            index = keyword%find_parameter(self%deck%text(given(i)%name))
            if (index == 0) then
               call unknown_parameter(self, card, given(i)%name, is_sound)
            else if (seen(index) > 0) then
               call fail_at(self, given(i)%name, 'the parameter '//trim(keyword%parameters(index)%name)// &
                  ' is given twice')
            else
               seen(index) = i
               call check_parameter(self, card, i, keyword%parameters(index), is_sound)
            end if
         end do
         if (.not. is_sound) return
         do j = 1, size(seen)
            if (seen(j) > 0 .or. .not. keyword%parameters(j)%required) cycle
            call fail_at(self, self%deck%cards(card)%name, '*'//trim(keyword%name)//' needs the parameter '// &
               describe_parameter(keyword%parameters(j)))
         end do
      end associate
   end subroutine check_parameters

   subroutine unknown_parameter(self, card, token, is_sound)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(token_t), intent(in) :: token
      !> Becomes .false. unless the parameter is ignored
      logical, intent(inout) :: is_sound
      character(len=word_length), allocatable :: names(:)
      character(len=:), allocatable :: message, nearest, advice
      integer :: i

      associate (keyword => self%table%keywords(self%spec(card)))
         allocate (names(size(keyword%parameters)))
         do i = 1, size(names)
            names(i) = keyword%parameters(i)%name
         end do
         message = 'unknown parameter '//self%deck%shown(token)//' of *'//trim(keyword%name)
         nearest = nearest_word(squeezed(self%deck%text(token)), names)
         advice = advice_about(keyword%name, self%deck%text(token))
         if (role_of(keyword%name, self%deck%text(token)) == role_idle) then
            call warn_of_idle(self, card, token, message//': '//advice//'; ignored')
            return
         else if (len(advice) > 0) then
            message = message//': '//advice
            if (size(names) > 0) message = message//'; allowed: '//join_words(names, 'and')
         else if (len(nearest) > 0) then
            message = message//'; did you mean '//nearest//'?'
         else if (size(names) == 0) then
            message = message//', which has no parameters'
         else
            message = message//'; allowed: '//join_words(names, 'and')
         end if
      end associate
      call fail_at(self, token, message)
      select case (role_of(trim(self%table%keywords(self%spec(card))%name), self%deck%text(token)))
      case (role_mesh)
         self%broken_nodes = .true.
         self%broken_elements = .true.
      case (role_data)
         ! they are not what they would be without it
         self%deck%cards(card)%last_data = self%deck%cards(card)%first_data - 1
      end select
      is_sound = .false.
   end subroutine unknown_parameter

   !> Value there or not, and of the right kind.
   subroutine check_parameter(self, card, i, spec, is_sound)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> Index into the parameters of the card
      integer, intent(in) :: i
      type(parameter_spec_t), intent(in) :: spec
      !> Becomes .false. where the value is no choice
      logical, intent(inout) :: is_sound
      integer :: whole
      real(dp) :: real_value
      logical :: ok

      associate (given => self%deck%cards(card)%parameters(i))
         if (spec%kind == kind_flag) then
            if (given%has_value) call fail_at(self, given%value, 'the parameter '//trim(spec%name)//' takes no value')
         else if (.not. given%has_value .and. spec%value_optional) then
            return
         else if (.not. given%has_value .or. given%value%last < given%value%first) then
            call fail_at(self, given%name, 'the parameter '//trim(spec%name)//' needs a value: '// &
               describe_parameter(spec))
         else
            call check_value(self, given%value, spec%kind, spec%limit, spec%choices, 'the parameter '// &
               trim(spec%name), &
               whole, real_value, ok)
            if (spec%kind == kind_choice) is_sound = is_sound .and. ok
         end if
      end associate
   end subroutine check_parameter

   !> `NAME=...` as the user should write it.
   pure function describe_parameter(spec) result(words)
      type(parameter_spec_t), intent(in) :: spec
      character(len=:), allocatable :: words

      words = trim(spec%name)//'='
      if (spec%kind == kind_choice) then
         words = words//trim(spec%choices)
      else
         words = words//'... ('//trim(spec%help)//')'
      end if
   end function describe_parameter

   !> Too few lines, or more than the keyword takes.
   subroutine check_data_lines(self, card)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      integer :: i, n, needed, most
      logical :: unlimited

      if (self%spec(card) == 0) return
      needed = 0
      most = 0
      unlimited = .false.
      associate (keyword => self%table%keywords(self%spec(card)), this => self%deck%cards(card))
         n = this%last_data - this%first_data + 1
         do i = 1, size(keyword%data)
            if (.not. applies(self, card, keyword%data(i))) cycle
            if (is_needed(keyword%data(i))) needed = max(needed, keyword%data(i)%first)
            most = max(most, keyword%data(i)%last)
            unlimited = unlimited .or. keyword%data(i)%last == 0
         end do
         if (n < needed) then
            call fail_at(self, this%name, 'a data line is missing: *'//trim(keyword%name)//' needs at least '// &
               to_text(needed))
         else if (n > most .and. .not. unlimited) then
            call fail_at(self, self%deck%line_token(this%first_data + most), 'more data lines than *'// &
               trim(keyword%name)//' takes, which is '//to_text(most))
            this%last_data = this%first_data + most - 1
         end if
      end associate

   contains

      pure logical function is_needed(form)
         type(data_spec_t), intent(in) :: form

         is_needed = form%required
         if (is_needed .and. len_trim(form%optional_with) > 0) is_needed = .not. has_choice(self, card, &
            form%optional_with)
      end function is_needed

   end subroutine check_data_lines

end module litz_card_checks
