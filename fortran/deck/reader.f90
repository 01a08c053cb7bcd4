!> What all parts of the deck reader share: the deck, the errors found so far, names and numbers already known, and
!> the values of one data line after another, checked against the keyword table.
module litz_reader
   use litz_kinds, only: dp
   use litz_errors, only: error_list_t
   use litz_text, only: upper, squeezed, to_text, words_of, join_words, nearest_word, word_length
   use litz_numbers, only: parse_integer, parse_real, number_ok, number_not_one, number_not_finite, number_too_large
   use litz_lookup, only: id_map_t, name_map_t
   use litz_deck, only: deck_t, token_t, no_token
   use litz_foreign_words, only: advice_about
   use litz_keywords, only: keyword_table_t, parameter_spec_t, data_spec_t, field_spec_t, kind_flag, kind_integer, &
      kind_real, &
      kind_choice, kind_name, kind_item, kind_text, limit_positive, limit_words, within_limit, largest_number
   use litz_model, only: name_length
   implicit none
   private
   public :: reader_t, values_t, set_builder_t, definitions_t
   public :: fail_at, read_line, applies, has_choice, names_hint, name_of, parameter_of, has_flag, choice_of, &
      real_parameter, integer_parameter, keyword_of, n_cards_of, check_value, find_definition, add_definition, &
      advice_about_value, behind_semicolon

   !> After this many errors no more hints are searched for
   integer, parameter :: most_hints = 100

   !> The values of one data line. Entries beyond `n`, and those that are not `given`, are 0.
   type :: values_t
      integer :: n = 0
      type(token_t), allocatable :: token(:)
      logical, allocatable :: given(:)
      !> Numbers; a choice is the number of its word
      integer, allocatable :: whole(:)
      real(dp), allocatable :: real(:)
   end type values_t

   !> Sets while they grow.
   type :: set_builder_t
      type(name_map_t) :: names
      !> First entry of each set, 0: none
      integer, allocatable :: head(:)
      !> Members of all sets in the order of reading, and the next entry of the same set
      integer, allocatable :: member(:), next(:)
      integer :: n = 0
      !> A set that each node or element is a member of; the one being filled, for all its members. 0: none
      integer, allocatable :: put_into(:)
      !> There was no memory for all members
      logical :: is_full = .false.
   end type set_builder_t

   !> Names of materials, amplitudes or interactions, with the line of each and whether anything refers to it.
   type :: definitions_t
      type(name_map_t) :: names
      type(token_t), allocatable :: token(:)
      logical, allocatable :: used(:)
      !> Something referred to a name that does not exist; then what seems unused may only be misspelled
      logical :: missed = .false.
   end type definitions_t

   type :: reader_t
      type(deck_t) :: deck
      type(error_list_t) :: errors
      type(keyword_table_t) :: table
      !> Index into the table (n_cards), 0: not to be read; number of the step (n_cards), 0: model part
      integer, allocatable :: spec(:), step(:)
      integer :: n_steps = 0
      type(id_map_t) :: nodes, elements
      !> Line of the deck that defines each node and element
      integer, allocatable :: node_line(:), element_line(:)
      !> The position of the node could be read
      logical, allocatable :: node_ok(:)
      !> A mesh file could not be read: nothing more can be said about the deck
      logical :: missed_mesh = .false.
      !> Some line of a node or element could not be read, so that what is missing in the mesh is no news
      logical :: broken_nodes = .false., broken_elements = .false.
      type(set_builder_t) :: node_sets, element_sets
      type(definitions_t) :: materials, amplitudes, interactions
      !> Some *BEAM SECTION names no set that exists, so that elements without section are no news
      logical :: missed_section = .false.
      !> Values of the data line read last
      type(values_t) :: values
      !> The form of data line read last: card, and index into the data lines of its keyword
      integer :: form_card = 0, form = 0
      !> Data lines of the deck that have been read (n_lines)
      logical, allocatable :: line_read(:)
   end type reader_t

contains

   !> Record an error that points at a token.
   subroutine fail_at(self, token, message)
      type(reader_t), intent(inout) :: self
      type(token_t), intent(in) :: token
      character(len=*), intent(in) :: message

      if (self%errors%is_full()) then
         call self%errors%skip()
      else
         call self%errors%add(self%deck%error_at(token, message))
      end if
   end subroutine fail_at

   !> The keyword of a card as the table has it.
   pure function keyword_of(self, card) result(keyword)
      type(reader_t), intent(in) :: self
      integer, intent(in) :: card
      character(len=:), allocatable :: keyword

      keyword = ''
      if (self%spec(card) > 0) keyword = trim(self%table%keywords(self%spec(card))%name)
   end function keyword_of

   !> How many cards have this keyword.
   pure integer function n_cards_of(self, keyword) result(n)
      type(reader_t), intent(in) :: self
      character(len=*), intent(in) :: keyword
      integer :: card

      n = 0
      do card = 1, self%deck%n_cards
         if (keyword_of(self, card) == keyword) n = n + 1
      end do
   end function n_cards_of

   !> A name as it is stored and compared: capitals.
   pure function name_of(self, token) result(name)
      type(reader_t), intent(in) :: self
      type(token_t), intent(in) :: token
      character(len=:), allocatable :: name

      name = upper(self%deck%text(token))
   end function name_of

   ! Parameters. What was wrong about them has been reported by litz_card_checks.

   !> The value of a parameter; `no_token` when the card does not have it.
   pure type(token_t) function parameter_of(self, card, name) result(token)
      type(reader_t), intent(in) :: self
      integer, intent(in) :: card
      character(len=*), intent(in) :: name
      integer :: i

      token = no_token
      associate (parameters => self%deck%cards(card)%parameters)
         do i = 1, size(parameters)
            if (squeezed(self%deck%text(parameters(i)%name)) /= squeezed(name)) cycle
            token = parameters(i)%name
            if (parameters(i)%has_value) token = parameters(i)%value
         end do
      end associate
   end function parameter_of

   pure logical function has_flag(self, card, name)
      type(reader_t), intent(in) :: self
      integer, intent(in) :: card
      character(len=*), intent(in) :: name
      type(token_t) :: token

      token = parameter_of(self, card, name)
      has_flag = token%line > 0
   end function has_flag

   !> The word chosen, without blanks; the default when there is none or a wrong one.
   pure function choice_of(self, card, name) result(word)
      type(reader_t), intent(in) :: self
      integer, intent(in) :: card
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: word
      character(len=word_length), allocatable :: words(:)
      type(token_t) :: token
      integer :: i

      associate (keyword => self%table%keywords(self%spec(card)))
         associate (parameter => keyword%parameters(keyword%find_parameter(name)))
            token = parameter_of(self, card, name)
            if (parameter%kind == kind_flag) then
               word = trim(merge('YES', 'NO ', token%line > 0))
               return
            end if
            if (token%line > 0) then
               word = squeezed(self%deck%text(token))
               allocate (words, source=words_of(parameter%choices))
               do i = 1, size(words)
                  if (squeezed(trim(words(i))) == word) return
               end do
            end if
            word = squeezed(trim(parameter%default))
         end associate
      end associate
   end function choice_of

   pure real(dp) function real_parameter(self, card, name, default) result(value)
      type(reader_t), intent(in) :: self
      integer, intent(in) :: card
      character(len=*), intent(in) :: name
      real(dp), intent(in) :: default
      real(dp) :: number
      integer :: status

      value = default
      call parse_real(self%deck%text(parameter_of(self, card, name)), number, status)
      if (status == number_ok) value = number
   end function real_parameter

   !> All whole numbers among the parameters are at least 1.
   pure integer function integer_parameter(self, card, name, default) result(value)
      type(reader_t), intent(in) :: self
      integer, intent(in) :: card
      character(len=*), intent(in) :: name
      integer, intent(in) :: default
      integer :: status, number

      value = default
      call parse_integer(self%deck%text(parameter_of(self, card, name)), number, status)
      if (status == number_ok .and. number > 0) value = number
   end function integer_parameter

   ! Data lines.

   !> Read and check the values of a data line; whatever is wrong is reported.
   subroutine read_line(self, card, line, ok)
      type(reader_t), intent(inout) :: self
      integer, intent(in) :: card
      !> Index into the lines of the deck
      integer, intent(in) :: line
      !> .false.: something was reported; values that were not understood are not `given`
      logical, intent(out) :: ok
      integer :: i, n_fields, n_allowed
      logical :: value_ok

      call find_form(self, card, line)
      call self%deck%split(line, self%values%token, self%values%n)
      call prepare_values(self%values, self%deck%end_of_line(line))
      self%line_read(line) = .true.
      ok = self%form > 0
      if (.not. ok) return
      associate (form => self%table%keywords(self%spec(card))%data(self%form), n => self%values%n)
         n_fields = size(form%fields)
         if (form%fields(1)%kind == kind_text) return
         n_allowed = n_fields*form%repeats
         if (n > n_allowed .and. n_allowed > 0) then
            call fail_at(self, self%values%token(n_allowed + 1), 'too many values: *'//keyword_of(self, card)// &
               ' takes '//to_text(n_allowed)// &
               ' on this line: '//form_words(form)//behind_semicolon(advice_about(keyword_of(self, card), value='+')))
            ok = .false.
            n = n_allowed
         end if
         do i = 1, n
            call read_value(self, form%fields(mod(i - 1, n_fields) + 1), i, value_ok)
            ok = ok .and. value_ok
         end do
         if (mod(n, n_fields) /= 0 .or. n == 0) call check_missing(self, form, line, ok)
      end associate
   end subroutine read_line

   !> The form that the table gives for this line of the card.
   pure subroutine find_form(self, card, line)
      type(reader_t), intent(inout) :: self
      integer, intent(in) :: card, line
      integer :: ordinal, i

      associate (keyword => self%table%keywords(self%spec(card)))
         if (self%form_card == card .and. self%form > 0) then
            if (keyword%data(self%form)%last == 0) return
         end if
         ordinal = line - self%deck%cards(card)%first_data + 1
         self%form_card = card
         self%form = 0
         do i = 1, size(keyword%data)
            associate (form => keyword%data(i))
               if (ordinal < form%first .or. (form%last > 0 .and. ordinal > form%last)) cycle
               if (.not. applies(self, card, form)) cycle
               self%form = i
               return
            end associate
         end do
      end associate
   end subroutine find_form

   !> .true. when the parameters of the card ask for this form of data line.
   pure logical function applies(self, card, form)
      type(reader_t), intent(in) :: self
      integer, intent(in) :: card
      type(data_spec_t), intent(in) :: form

      applies = len_trim(form%when) == 0
      if (.not. applies) applies = has_choice(self, card, form%when)
   end function applies

   !> .true. when the card has a parameter with this value, or its default is the value.
   pure logical function has_choice(self, card, choice)
      type(reader_t), intent(in) :: self
      integer, intent(in) :: card
      !> `PARAMETER=VALUE`
      character(len=*), intent(in) :: choice
      integer :: equals

      equals = index(choice, '=')
      has_choice = choice_of(self, card, choice(:equals - 1)) == squeezed(trim(choice(equals + 1:)))
   end function has_choice

   pure subroutine prepare_values(values, line_end)
      type(values_t), intent(inout) :: values
      !> Where values that are left out would be
      type(token_t), intent(in) :: line_end
      integer :: n

      n = size(values%token)
      if (allocated(values%real)) then
         if (size(values%real) < n) deallocate (values%real, values%whole, values%given)
      end if
      if (.not. allocated(values%real)) allocate (values%real(n), values%whole(n), values%given(n))
      n = min(n, max(values%n, 16))
      values%real(:n) = 0
      values%whole(:n) = 0
      values%given(:n) = .false.
      values%token(values%n + 1:n) = line_end
   end subroutine prepare_values

   !> Take one value; an empty one is complained about when it is needed.
   subroutine read_value(self, field, i, ok)
      type(reader_t), intent(inout) :: self
      type(field_spec_t), intent(in) :: field
      integer, intent(in) :: i
      logical, intent(out) :: ok
      integer :: whole
      real(dp) :: real_value

      associate (token => self%values%token(i))
         ok = .true.
         if (token%last < token%first) then
            if (field%required) then
               call fail_at(self, token, 'value '//to_text(i)//', '//field_words(field)//', is missing')
               ok = .false.
            end if
            return
         end if
         call take_number(self%deck%sources(self%deck%lines(token%line)%source)%text(token%first:token%last), field, &
            whole, real_value, ok)
         if (.not. ok) call check_value(self, token, field%kind, field%limit, field%choices, 'value '//to_text(i)// &
            ', '//field_words(field)//',', whole, real_value, ok)
         self%values%whole(i) = whole
         self%values%real(i) = real_value
         self%values%given(i) = ok
      end associate
   end subroutine read_value

   !> A number that is as it should be, by the shortest way: a deck may have millions of them.
   pure subroutine take_number(text, field, whole, real_value, ok)
      character(len=*), intent(in) :: text
      type(field_spec_t), intent(in) :: field
      integer, intent(out) :: whole
      real(dp), intent(out) :: real_value
      !> .false.: not a number, or one with something wrong about it
      logical, intent(out) :: ok
      integer :: status

      whole = 0
      real_value = 0
      status = number_not_one
      if (field%kind == kind_integer) then
         call parse_integer(text, whole, status)
         real_value = real(whole, dp)
      else if (field%kind == kind_real) then
         call parse_real(text, real_value, status)
      end if
      ok = status == number_ok
      if (ok) ok = within_limit(real_value, field%limit)
   end subroutine take_number

   !> Understand a value, of a data line or a parameter, or say what is wrong about it.
   subroutine check_value(self, token, kind, limit, choices, what, whole, real_value, ok)
      type(reader_t), intent(inout) :: self
      type(token_t), intent(in) :: token
      integer, intent(in) :: kind, limit
      character(len=*), intent(in) :: choices
      !> Subject of the message, with its comma where it ends in a relative clause
      character(len=*), intent(in) :: what
      integer, intent(out) :: whole
      real(dp), intent(out) :: real_value
      logical, intent(out) :: ok
      integer :: status

      whole = 0
      real_value = 0
      ok = .true.
      associate (text => self%deck%sources(self%deck%lines(token%line)%source)%text(token%first:token%last))
         select case (kind)
         case (kind_integer)
            call parse_integer(text, whole, status)
            real_value = real(whole, dp)
            call check_number('a whole number')
         case (kind_real)
            call parse_real(text, real_value, status)
            call check_number('a number')
         case (kind_choice)
            call check_choice(self, token, choices, what, whole, ok)
         case (kind_name, kind_item)
            if (len(text) > name_length) then
               call fail_at(self, token, what//' is longer than '//to_text(name_length)//' characters')
               ok = .false.
            end if
            if (kind == kind_item) call parse_integer(text, whole, status)
         end select
      end associate

   contains

      subroutine check_number(noun)
         character(len=*), intent(in) :: noun

         ok = .false.
         select case (status)
         case (number_ok)
            ok = within_limit(real_value, limit)
            if (ok) return
            if (abs(real_value) > largest_number) then
               call fail_at(self, token, what//' is too large; litz takes numbers up to 1e60; found '// &
                  self%deck%shown(token))
            else if (limit == limit_positive .and. real_value > 0) then
               call fail_at(self, token, what//' is too small; it must be at least 1e-60; found '// &
                  self%deck%shown(token))
            else
               call fail_at(self, token, what//' is '//self%deck%shown(token)//'; it must be '//limit_words(limit))
            end if
         case (number_not_one)
            call fail_at(self, token, what//' must be '//noun//'; found '//self%deck%shown(token)// &
               hint_about_blanks(trim(self%deck%text(token))))
         case (number_not_finite)
            call fail_at(self, token, what//' must be a finite number; found '//self%deck%shown(token))
         case (number_too_large)
            call fail_at(self, token, what//' is too large for this program; found '//self%deck%shown(token))
         case default
            call fail_at(self, token, what//' is too small to be told from 0; found '//self%deck%shown(token))
         end select
      end subroutine check_number

   end subroutine check_value

   subroutine check_choice(self, token, choices, what, chosen, ok)
      type(reader_t), intent(inout) :: self
      type(token_t), intent(in) :: token
      character(len=*), intent(in) :: choices, what
      !> Number of the word
      integer, intent(out) :: chosen
      logical, intent(out) :: ok
      character(len=word_length), allocatable :: words(:)
      character(len=:), allocatable :: word, nearest, advice

      allocate (words, source=words_of(choices))
      word = squeezed(self%deck%text(token))
      ok = .true.
      do chosen = 1, size(words)
         if (squeezed(trim(words(chosen))) == word) return
      end do
      chosen = 0
      ok = .false.
      nearest = nearest_word(word, words)
      if (len(nearest) > 0) nearest = 'did you mean '//nearest//'?'
      advice = advice_about_value(self, token)
      if (len(advice) == 0) advice = nearest
      call fail_at(self, token, what//' must be '//join_words(words, 'or')//'; found '//self%deck%shown(token)// &
         behind_semicolon(advice))
   end subroutine check_choice

   !> What to write in place of a value of Abaqus or CalculiX that litz does not have; empty when it is none.
   function advice_about_value(self, token) result(advice)
      type(reader_t), intent(in) :: self
      type(token_t), intent(in) :: token
      character(len=:), allocatable :: advice
      integer :: card, i

      card = card_of(self, token%line)
      advice = ''
      if (card == 0) return
      associate (this => self%deck%cards(card))
         do i = 1, size(this%parameters)
            if (this%parameters(i)%value%line /= token%line .or. this%parameters(i)%value%first /= token%first) cycle
            advice = advice_about(self%deck%text(this%name), self%deck%text(this%parameters(i)%name), &
               self%deck%text(token))
            return
         end do
         advice = advice_about(self%deck%text(this%name), value=self%deck%text(token))
      end associate
   end function advice_about_value

   !> The card that a line belongs to; 0 when the line is before the first one.
   pure integer function card_of(self, line)
      type(reader_t), intent(in) :: self
      integer, intent(in) :: line
      integer :: beyond, middle

      card_of = 0
      beyond = self%deck%n_cards + 1
      do while (beyond - card_of > 1)
         middle = (card_of + beyond)/2
         if (self%deck%cards(middle)%name%line <= line) then
            card_of = middle
         else
            beyond = middle
         end if
      end do
   end function card_of

   pure function behind_semicolon(advice) result(text)
      character(len=*), intent(in) :: advice
      character(len=:), allocatable :: text

      text = ''
      if (len(advice) > 0) text = '; '//advice
   end function behind_semicolon

   !> Complain about required values behind the last one.
   subroutine check_missing(self, form, line, ok)
      type(reader_t), intent(inout) :: self
      type(data_spec_t), intent(in) :: form
      integer, intent(in) :: line
      logical, intent(inout) :: ok
      integer :: i

      do i = mod(self%values%n, size(form%fields)) + 1, size(form%fields)
         if (.not. form%fields(i)%required) cycle
         call fail_at(self, self%deck%end_of_line(line), 'value '//to_text(self%values%n + i - &
            mod(self%values%n, size(form%fields)))//', '//field_words(form%fields(i))// &
            ', is missing; the line holds '// &
            form_words(form)//comma_hint())
         ok = .false.
         return
      end do

   contains

      !> Blanks within the last value: where commas should be?
      function comma_hint() result(hint)
         character(len=:), allocatable :: hint

         hint = ''
         if (self%values%n == 0) return
         associate (token => self%values%token(self%values%n))
            if (token%last >= token%first) hint = hint_about_blanks(trim(self%deck%text(token)))
         end associate
      end function comma_hint

   end subroutine check_missing

   !> For a value with something in it that separates values elsewhere.
   pure function hint_about_blanks(text) result(hint)
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: hint

      hint = ''
      if (index(text, '**') > 0 .or. scan(text, '#!') > 0) then
         hint = ' (a comment has a line of its own, which begins with **)'
      else if (scan(text, ' ;'//achar(9)) > 0) then
         hint = ' (values are separated by commas)'
      end if
   end function hint_about_blanks

   pure function field_words(field) result(words)
      type(field_spec_t), intent(in) :: field
      character(len=:), allocatable :: words

      words = trim(field%name)
      if (len_trim(field%help) > 0 .and. index(field%help, ';') == 0) words = words//' ('//trim(field%help)//')'
   end function field_words

   pure function form_words(form) result(words)
      type(data_spec_t), intent(in) :: form
      character(len=:), allocatable :: words
      integer :: i

      words = ''
      do i = 1, size(form%fields)
         if (i > 1) words = words//', '
         words = words//trim(form%fields(i)%name)
      end do
      if (form%repeats /= 1) words = words//', '//words//', ...'
   end function form_words

   ! Definitions by name.

   !> A new name of a material, amplitude or interaction; `index` is 0 when it is there already.
   subroutine add_definition(self, definitions, what, token, index)
      type(reader_t), intent(inout) :: self
      type(definitions_t), intent(inout) :: definitions
      character(len=*), intent(in) :: what
      !> The name
      type(token_t), intent(in) :: token
      integer, intent(out) :: index
      integer :: before

      call make_room(definitions)
      before = definitions%names%n
      call definitions%names%put(name_of(self, token), index)
      if (definitions%names%n > before) then
         definitions%token(index) = token
         definitions%used(index) = .false.
      else
         call fail_at(self, token, 'the '//what//' '//self%deck%shown(token)//' is defined twice; first in '// &
            self%deck%place(definitions%token(index)%line))
         index = 0
      end if
   end subroutine add_definition

   !> Room for one more definition.
   pure subroutine make_room(definitions)
      type(definitions_t), intent(inout) :: definitions
      type(token_t), allocatable :: token(:)
      logical, allocatable :: used(:)

      if (.not. allocated(definitions%token)) allocate (definitions%token(16), definitions%used(16))
      associate (n => definitions%names%n)
         if (n < size(definitions%token)) return
         allocate (token(2*n), used(2*n))
         token(:n) = definitions%token
         used(:n) = definitions%used
      end associate
      call move_alloc(token, definitions%token)
      call move_alloc(used, definitions%used)
   end subroutine make_room

   !> Look a name up and mark it as used; 0 and an error when it does not exist.
   subroutine find_definition(self, definitions, what, token, index)
      type(reader_t), intent(inout) :: self
      type(definitions_t), intent(inout) :: definitions
      character(len=*), intent(in) :: what
      type(token_t), intent(in) :: token
      integer, intent(out) :: index

      index = definitions%names%get(name_of(self, token))
      if (index > 0) then
         definitions%used(index) = .true.
      else
         definitions%missed = .true.
         if (token%last < token%first) return
         call fail_at(self, token, 'there is no '//what//' '//self%deck%shown(token)// &
            names_hint(self, definitions%names, token))
      end if
   end subroutine find_definition

   !> What else the user may have meant.
   pure function names_hint(self, names, token) result(hint)
      type(reader_t), intent(in) :: self
      type(name_map_t), intent(in) :: names
      type(token_t), intent(in) :: token
      character(len=:), allocatable :: hint

      hint = ''
      if (self%errors%count < most_hints) hint = names%hint(name_of(self, token))
   end function names_hint

end module litz_reader
