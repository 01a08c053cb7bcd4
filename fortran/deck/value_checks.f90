!> What a value of a data line or a parameter must be, and what is said when it is something else.
module litz_value_checks
   use litz_kinds, only: dp
   use litz_text, only: squeezed, to_text, words_of, join_words, nearest_word, word_length
   use litz_numbers, only: parse_integer, parse_real, number_ok, number_not_one, number_not_finite, number_too_large
   use litz_foreign_words, only: advice_about, role_of, role_idle
   use litz_keywords, only: kind_integer, kind_real, kind_choice, kind_name, kind_item, limit_positive, &
      describe_limit, within_limit, largest_number
   use litz_model, only: name_length
   use litz_deck, only: token_t
   use litz_reader, only: reader_t, fail_at, warn_of_idle
   implicit none
   private
   public :: check_value, advice_about_value, behind_semicolon, hint_about_blanks

contains

   !> Understand a value, of a data line or a parameter, or say what is wrong about it.
   subroutine check_value(self, token, kind, limit, choices, what, whole, real_value, ok)
      type(reader_t), intent(inout) :: self
      type(token_t), intent(in) :: token
      !> What the value is, one of `kind_...`
      integer, intent(in) :: kind
      !> What a number must satisfy, one of `limit_...`
      integer, intent(in) :: limit
      !> `kind_choice`: the words allowed, separated by bars
      character(len=*), intent(in) :: choices
      !> Subject of the message, with its comma where it ends in a relative clause
      character(len=*), intent(in) :: what
      !> A whole number, the number of a node or element, or that of the chosen word; else 0
      integer, intent(out) :: whole
      !> A number; else 0
      real(dp), intent(out) :: real_value
      !> .false.: an error was reported
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
         !> What is wanted, as the end of a sentence
         character(len=*), intent(in) :: noun

         ok = .false.
         select case (status)
         case (number_ok)
            ok = within_limit(real_value, limit)
            if (ok) return
            if (abs(real_value) > largest_number) then
               call fail_at(self, token, what//' is too large; litz accepts numbers up to 1e60; found '// &
                  self%deck%shown(token))
            else if (limit == limit_positive .and. real_value > 0) then
               call fail_at(self, token, what//' is too small; it must be at least 1e-60; found '// &
                  self%deck%shown(token))
            else
               call fail_at(self, token, what//' is '//self%deck%shown(token)//'; it must be '//describe_limit(limit))
            end if
         case (number_not_one)
            call fail_at(self, token, what//' must be '//noun//'; found '//self%deck%shown(token)// &
               hint_about_blanks(trim(self%deck%text(token))))
         case (number_not_finite)
            call fail_at(self, token, what//' must be a finite number; found '//self%deck%shown(token))
         case (number_too_large)
            call fail_at(self, token, what//' is too large for this program; found '//self%deck%shown(token))
         case default
            call fail_at(self, token, what//' is too small to be distinguished from 0; found '//self%deck%shown(token))
         end select
      end subroutine check_number

   end subroutine check_value

   subroutine check_choice(self, token, choices, what, chosen, ok)
      type(reader_t), intent(inout) :: self
      type(token_t), intent(in) :: token
      !> `kind_choice`: the words allowed, separated by bars
      character(len=*), intent(in) :: choices
      !> Subject of the message, with its comma where it ends in a relative clause
      character(len=*), intent(in) :: what
      !> Number of the word; 0 after an error
      integer, intent(out) :: chosen
      !> .false.: an error was reported, or that the value is ignored
      logical, intent(out) :: ok
      character(len=word_length), allocatable :: words(:)
      character(len=:), allocatable :: word, nearest, advice, message
      integer :: role

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
      call look_up_value(self, token, advice, role)
      if (len(advice) == 0) advice = nearest
      message = what//' must be '//join_words(words, 'or')//'; found '//self%deck%shown(token)//behind_semicolon(advice)
      if (role == role_idle) then
         call warn_of_idle(self, card_of(self, token%line), token, message//'; ignored')
      else
         call fail_at(self, token, message)
      end if
   end subroutine check_choice

   !> What to write in place of a value of Abaqus or CalculiX that litz does not have; empty when it is none.
   function advice_about_value(self, token) result(advice)
      type(reader_t), intent(in) :: self
      type(token_t), intent(in) :: token
      character(len=:), allocatable :: advice
      integer :: role

      call look_up_value(self, token, advice, role)
   end function advice_about_value

   !> What is known about a value of Abaqus or CalculiX that litz does not have.
   subroutine look_up_value(self, token, advice, role)
      type(reader_t), intent(in) :: self
      type(token_t), intent(in) :: token
      !> What to write in its place; empty when nothing is known
      character(len=:), allocatable, intent(out) :: advice
      !> What it is about, one of `role_...`
      integer, intent(out) :: role
      character(len=:), allocatable :: keyword, value
      integer :: card, i

      card = card_of(self, token%line)
      advice = ''
      role = 0
      if (card == 0) return
      value = self%deck%text(token)
      associate (this => self%deck%cards(card))
         keyword = self%deck%text(this%name)
         do i = 1, size(this%parameters)
            if (this%parameters(i)%value%line /= token%line .or. this%parameters(i)%value%first /= token%first) cycle
            advice = advice_about(keyword, self%deck%text(this%parameters(i)%name), value)
            role = role_of(keyword, self%deck%text(this%parameters(i)%name), value)
            return
         end do
         advice = advice_about(keyword, value=value)
         role = role_of(keyword, value=value)
      end associate
   end subroutine look_up_value

   !> The card that a line belongs to; 0 when the line is before the first one.
   pure integer function card_of(self, line)
      type(reader_t), intent(in) :: self
      !> Index into the lines of the deck
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
      !> A clause; may be empty
      character(len=*), intent(in) :: advice
      character(len=:), allocatable :: text

      text = ''
      if (len(advice) > 0) text = '; '//advice
   end function behind_semicolon

   !> For a value with something in it that separates values elsewhere.
   pure function hint_about_blanks(text) result(hint)
      !> The value as the user wrote it
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: hint

      hint = ''
      if (index(text, '**') > 0 .or. scan(text, '#!') > 0) then
         hint = ' (a comment has a line of its own, which begins with **)'
      else if (scan(text, ' ;'//achar(9)) > 0) then
         hint = ' (values are separated by commas)'
      end if
   end function hint_about_blanks

end module litz_value_checks
