!> What all parts of the deck reader share: the deck, the errors found so far, names and numbers already known, and
!> the parameters of the cards.
module litz_reader
   use litz_kinds, only: dp
   use litz_errors, only: error_t, error_list_t
   use litz_text, only: upper, squeezed, words_of, word_length
   use litz_numbers, only: parse_integer, parse_real, number_ok
   use litz_lookup, only: id_map_t, name_map_t
   use litz_deck, only: deck_t, token_t, no_token
   use litz_keywords, only: keyword_table_t, data_spec_t, kind_flag, within_limit
   implicit none
   private
   public :: reader_t, values_t, set_builder_t, definitions_t
   public :: fail_at, warn_at, warn_of_idle, applies, has_choice, names_hint, name_of, parameter_of, has_flag, &
      choice_of, deck_gives, real_parameter, integer_parameter, keyword_of, n_cards_of, may_be_defined, may_be_used, &
      halves_of

   !> After this many errors no more hints are searched for
   integer, parameter :: max_hints = 100

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
      !> There was no memory for all members; the name of some set is a whole number
      logical :: is_full = .false., has_numbers = .false.
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
      type(error_list_t) :: errors, warnings
      !> The card has a keyword that litz lacks, but that changes no result (n_cards)
      logical, allocatable :: is_idle(:)
      !> Something that the card says, and that changes no result, was ignored with a warning (n_cards)
      logical, allocatable :: told(:)
      type(keyword_table_t) :: table
      !> Index into the table (n_cards), 0: not to be read; number of the step (n_cards), 0: model part
      integer, allocatable :: spec(:), step(:)
      integer :: n_steps = 0
      type(id_map_t) :: nodes, elements
      !> Line of the deck that defines each node and element
      integer, allocatable :: node_line(:), element_line(:)
      !> The next element is the second half of this one, which has a node in the middle (n_elements)
      logical, allocatable :: has_half(:)
      !> The position of the node could be read
      logical, allocatable :: node_ok(:)
      !> A mesh file could not be read: all else that is wrong may be a follow-up error
      logical :: missed_mesh = .false.
      !> Some line of a node or element could not be read: what is missing in the mesh is a follow-up error
      logical :: broken_nodes = .false., broken_elements = .false.
      !> Some keyword of the model part is none: what a material lacks may be a follow-up error
      logical :: broken_keywords = .false.
      !> Some rigid body could not be read: a node without elements may be its reference node
      logical :: broken_bodies = .false.
      !> Some equation could not be read: a node without elements may be in it
      logical :: broken_equations = .false.
      type(set_builder_t) :: node_sets, element_sets
      !> Kinds and names of those that are named but not defined
      type(name_map_t) :: missing_sets
      type(definitions_t) :: materials, amplitudes, interactions, surfaces
      !> Some *BEAM SECTION names no set that exists: elements without section are follow-up errors
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
      !> What was found and what is allowed
      character(len=*), intent(in) :: message

      if (self%errors%is_full()) then
         call self%errors%skip()
      else
         call self%errors%add(self%deck%error_at(token, message))
      end if
   end subroutine fail_at

   !> Record a warning that points at a token.
   subroutine warn_at(self, token, kind, message)
      type(reader_t), intent(inout) :: self
      type(token_t), intent(in) :: token
      !> The code word
      character(len=*), intent(in) :: kind
      !> What was found, and what litz makes of it
      character(len=*), intent(in) :: message
      type(error_t) :: warning

      if (self%warnings%is_full()) then
         call self%warnings%skip()
         return
      end if
      warning = self%deck%error_at(token, message)
      warning%is_warning = .true.
      warning%kind = kind
      call self%warnings%add(warning)
   end subroutine warn_at

   !> Record that something that a card says is ignored, as it changes no result: once for each card.
   subroutine warn_of_idle(self, card, token, message)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(token_t), intent(in) :: token
      !> What was found, what to do, and that it is ignored
      character(len=*), intent(in) :: message

      if (.not. self%told(card)) call warn_at(self, token, 'ignored', message)
      self%told(card) = .true.
   end subroutine warn_of_idle

   !> The keyword of a card as the table has it.
   pure function keyword_of(self, card) result(keyword)
      type(reader_t), intent(in) :: self
      !> Index of the card
      integer, intent(in) :: card
      character(len=:), allocatable :: keyword

      keyword = ''
      if (self%spec(card) > 0) keyword = trim(self%table%keywords(self%spec(card))%name)
   end function keyword_of

   !> How many cards have this keyword.
   pure integer function n_cards_of(self, keyword) result(n)
      type(reader_t), intent(in) :: self
      !> The keyword as the table has it
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
      !> Index of the card
      integer, intent(in) :: card
      !> The parameter as the table has it
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

   !> Some card of the deck with this keyword gives the parameter.
   pure logical function deck_gives(self, keyword, name)
      type(reader_t), intent(in) :: self
      !> In capitals
      character(len=*), intent(in) :: keyword, name
      type(token_t) :: token
      integer :: i

      deck_gives = .false.
      do i = 1, self%deck%n_cards
         if (keyword_of(self, i) /= keyword) cycle
         token = parameter_of(self, i, name)
         deck_gives = deck_gives .or. token%last >= token%first
      end do
   end function deck_gives

   !> A keyword that nobody knows may have been meant to define this name: it has been reported, and that is enough.
   pure logical function may_be_defined(self, parameter, token)
      type(reader_t), intent(in) :: self
      !> The parameter with which keywords of the kind define names: `NSET`, `ELSET`, `NAME`
      character(len=*), intent(in) :: parameter
      !> The name where it is used
      type(token_t), intent(in) :: token
      type(token_t) :: defined
      integer :: card

      may_be_defined = .false.
      do card = 1, self%deck%n_cards
         if (self%spec(card) > 0 .or. self%is_idle(card)) cycle
         defined = parameter_of(self, card, parameter)
         if (defined%line == 0) cycle
         if (name_of(self, defined) == name_of(self, token)) may_be_defined = .true.
      end do
   end function may_be_defined

   !> A keyword that litz does not know has been reported: that nothing else uses the name that it gives is no news.
   pure logical function may_be_used(self, name)
      type(reader_t), intent(in) :: self
      !> A definition, in capitals
      character(len=*), intent(in) :: name
      type(token_t), allocatable :: values(:)
      integer :: card, i, n

      may_be_used = .false.
      do card = 1, self%deck%n_cards
         if (self%spec(card) > 0) cycle
         associate (this => self%deck%cards(card))
            do i = 1, size(this%parameters)
               if (this%parameters(i)%has_value) may_be_used = may_be_used .or. &
                  name_of(self, this%parameters(i)%value) == name
            end do
            if (this%last_data < this%first_data) cycle
            ! as a contact pair names a surface
            call self%deck%split(this%first_data, values, n)
            do i = 1, n
               may_be_used = may_be_used .or. name_of(self, values(i)) == name
            end do
         end associate
      end do
   end function may_be_used

   !> An element of the deck, with its second half where it has one.
   pure function halves_of(self, element) result(elements)
      type(reader_t), intent(in) :: self
      !> Index of the element
      integer, intent(in) :: element
      integer, allocatable :: elements(:)

      elements = [element]
      if (self%has_half(element)) elements = [element, element + 1]
   end function halves_of

   pure logical function has_flag(self, card, name)
      type(reader_t), intent(in) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> The parameter as the table has it
      character(len=*), intent(in) :: name
      type(token_t) :: token

      token = parameter_of(self, card, name)
      has_flag = token%line > 0
   end function has_flag

   !> The word chosen, without blanks; the default when there is none or a wrong one.
   pure function choice_of(self, card, name) result(word)
      type(reader_t), intent(in) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> The parameter as the table has it
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
      !> Index of the card
      integer, intent(in) :: card
      !> The parameter as the table has it
      character(len=*), intent(in) :: name
      !> What holds without the parameter
      real(dp), intent(in) :: default
      real(dp) :: number
      integer :: status

      value = default
      call parse_real(self%deck%text(parameter_of(self, card, name)), number, status)
      if (status == number_ok) value = number
   end function real_parameter

   !> A whole number; one beyond its limit was reported.
   pure integer function integer_parameter(self, card, name, default) result(value)
      type(reader_t), intent(in) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> The parameter as the table has it
      character(len=*), intent(in) :: name
      !> What holds without the parameter
      integer, intent(in) :: default
      integer :: status, number

      value = default
      call parse_integer(self%deck%text(parameter_of(self, card, name)), number, status)
      if (status /= number_ok) return
      associate (keyword => self%table%keywords(self%spec(card)))
         if (within_limit(real(number, dp), keyword%parameters(keyword%find_parameter(name))%limit)) value = number
      end associate
   end function integer_parameter

   ! Data lines.

   !> .true. when the parameters of the card ask for this form of data line.
   pure logical function applies(self, card, form)
      type(reader_t), intent(in) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(data_spec_t), intent(in) :: form

      applies = len_trim(form%when) == 0
      if (.not. applies) applies = has_choice(self, card, form%when)
   end function applies

   !> .true. when the card has a parameter with this value, or its default is the value.
   pure logical function has_choice(self, card, choice)
      type(reader_t), intent(in) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> `PARAMETER=VALUE`, or a parameter that may have any value
      character(len=*), intent(in) :: choice
      integer :: equals

      equals = index(choice, '=')
      if (equals == 0) then
         has_choice = has_flag(self, card, trim(choice))
         return
      end if
      has_choice = choice_of(self, card, choice(:equals - 1)) == squeezed(trim(choice(equals + 1:)))
   end function has_choice

   ! Definitions by name.

   !> What else the user may have meant.
   pure function names_hint(self, names, token, others) result(hint)
      type(reader_t), intent(in) :: self
      type(name_map_t), intent(in) :: names
      type(token_t), intent(in) :: token
      !> Names of another kind that are allowed, too
      type(name_map_t), intent(in), optional :: others
      character(len=:), allocatable :: hint

      hint = ''
      if (self%errors%count < max_hints) hint = names%hint(name_of(self, token), others)
   end function names_hint

end module litz_reader
