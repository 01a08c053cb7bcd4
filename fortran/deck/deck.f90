!> A deck as cards: keyword lines with their parameters, and the data lines that follow them. Every token knows its
!> file, line and column, through included files.
!>
!> The text of each file is kept as it was read; lines and tokens are ranges in it, and data lines are split only when
!> somebody reads them, so that decks of millions of lines cost little more than their text.
module litz_deck
   use litz_errors, only: error_t
   use litz_text, only: shown
   implicit none
   private
   public :: deck_t, source_t, line_t, token_t, parameter_t, card_t, no_token, append_line, append_card

   !> Longest part of a line that an error shows, and what of it stands before the caret
   integer, parameter :: window = 110, window_before = 50

   type :: source_t
      !> As messages name it
      character(len=:), allocatable :: path
      !> Without symbolic links, for finding circles of included files
      character(len=:), allocatable :: real_path
      character(len=:), allocatable :: text
      !> Source and line number of the *INCLUDE; 0: the deck itself
      integer :: parent = 0, parent_line = 0
   end type source_t

   !> A line that is neither blank nor a comment.
   type :: line_t
      integer :: source = 0
      !> Line number in its file
      integer :: number = 0
      !> Where it begins, and its first and last character that is not blank, in the text of the source
      integer :: start = 0, first = 1, last = 0
   end type line_t

   !> A piece of a line, without blanks and quotes around it.
   type :: token_t
      !> Index into the lines of the deck
      integer :: line = 0
      !> Range in the text of the source; empty: nothing between two commas
      integer :: first = 1, last = 0
   end type token_t

   type(token_t), parameter :: no_token = token_t()

   type :: parameter_t
      type(token_t) :: name, value
      logical :: has_value = .false.
   end type parameter_t

   type :: card_t
      !> The keyword without its asterisk
      type(token_t) :: name
      type(parameter_t), allocatable :: parameters(:)
      !> Data lines, as a range of the lines of the deck
      integer :: first_data = 1, last_data = 0
   end type card_t

   type :: deck_t
      type(source_t), allocatable :: sources(:)
      integer :: n_sources = 0
      type(line_t), allocatable :: lines(:)
      integer :: n_lines = 0
      type(card_t), allocatable :: cards(:)
      integer :: n_cards = 0
   contains
      procedure :: text => deck_text
      procedure :: shown => deck_shown
      procedure :: place => deck_place
      procedure :: line_token => deck_line_token
      procedure :: end_of_line => deck_end_of_line
      procedure :: error_at => deck_error_at
      procedure :: split => deck_split
   end type deck_t

contains

   pure function deck_text(self, token) result(text)
      class(deck_t), intent(in) :: self
      type(token_t), intent(in) :: token
      character(len=:), allocatable :: text

      text = ''
      if (token%line > 0) text = self%sources(self%lines(token%line)%source)%text(token%first:token%last)
   end function deck_text

   !> The token in quotes, fit for a message.
   pure function deck_shown(self, token) result(text)
      class(deck_t), intent(in) :: self
      type(token_t), intent(in) :: token
      character(len=:), allocatable :: text

      text = shown(self%text(token))
   end function deck_shown

   !> `file:line`
   pure function deck_place(self, line) result(text)
      class(deck_t), intent(in) :: self
      !> Index into the lines of the deck
      integer, intent(in) :: line
      character(len=:), allocatable :: text
      character(len=12) :: number

      write (number, '(i0)') self%lines(line)%number
      text = self%sources(self%lines(line)%source)%path//':'//trim(number)
   end function deck_place

   !> A whole line as one token.
   pure type(token_t) function deck_line_token(self, line) result(token)
      class(deck_t), intent(in) :: self
      !> Index into the lines of the deck
      integer, intent(in) :: line

      token = token_t(line, self%lines(line)%first, self%lines(line)%last)
   end function deck_line_token

   !> The place just behind a line, where something is missing.
   pure type(token_t) function deck_end_of_line(self, line) result(token)
      class(deck_t), intent(in) :: self
      !> Index into the lines of the deck
      integer, intent(in) :: line

      token = token_t(line, self%lines(line)%last + 1, self%lines(line)%last)
   end function deck_end_of_line

   !> An error that points at a token.
   pure type(error_t) function deck_error_at(self, token, message) result(error)
      class(deck_t), intent(in) :: self
      type(token_t), intent(in) :: token
      !> What was found and what is allowed
      character(len=*), intent(in) :: message
      character(len=12) :: number
      integer :: source, line_end, from, i

      error%message = message
      if (token%line == 0) return
      error%order = token%line
      associate (line => self%lines(token%line))
         source = line%source
         error%file = self%sources(source)%path
         error%line = line%number
         associate (text => self%sources(source)%text)
            error%column = 1 + characters(text(line%start:token%first - 1))
            error%width = max(1, characters(text(token%first:token%last)))
            ! a keyword line may end with trailing blanks that do not matter
            line_end = max(line%last, token%last)
            from = line%start
            if (line_end - from >= window) then
               from = max(from, token%first - window_before)
               line_end = min(line_end, from + window)
            end if
            do while (from > line%start .and. is_continuation(text(from:from)))
               from = from - 1
            end do
            error%card = printable(text(from:line_end))
            error%caret = 1 + characters(text(from:token%first - 1))
            error%width = min(error%width, max(1, characters(error%card) - error%caret + 1))
            if (from > line%start) then
               error%card = '...'//error%card
               error%caret = error%caret + 3
            end if
            if (line_end < max(line%last, token%last)) error%card = error%card//'...'
         end associate
      end associate
      if (self%sources(source)%parent > 0) error%origin = ''
      do i = 1, self%n_sources
         if (self%sources(source)%parent == 0) exit
         write (number, '(i0)') self%sources(source)%parent_line
         source = self%sources(source)%parent
         if (source == 0) exit
         error%origin = error%origin//'   included from '//self%sources(source)%path//':'//trim(number)//new_line('a')
      end do
   end function deck_error_at

   !> Number of characters of UTF-8 text.
   pure integer function characters(text)
      !> UTF-8
      character(len=*), intent(in) :: text
      integer :: i

      characters = 0
      do i = 1, len(text)
         if (.not. is_continuation(text(i:i))) characters = characters + 1
      end do
   end function characters

   !> Second or later byte of a UTF-8 character.
   pure logical function is_continuation(byte)
      !> One byte of UTF-8 text
      character(len=1), intent(in) :: byte

      is_continuation = iand(iachar(byte), 192) == 128
   end function is_continuation

   !> One column per character: tabs and control characters become blanks.
   pure function printable(text) result(line)
      !> UTF-8
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: line
      integer :: i

      line = text
      do i = 1, len(line)
         if (iachar(line(i:i)) < 32 .or. iachar(line(i:i)) == 127) line(i:i) = ' '
      end do
   end function printable

   !> Split a data line at its commas. Empty fields at the end do not count.
   pure subroutine deck_split(self, line, tokens, n)
      class(deck_t), intent(in) :: self
      !> Index into the lines of the deck
      integer, intent(in) :: line
      !> Grown where it is too short; the first `n` are set
      type(token_t), allocatable, intent(inout) :: tokens(:)
      !> Number of fields, those at the end that are empty left out
      integer, intent(out) :: n
      type(token_t), allocatable :: grown(:)
      integer :: i, first, last, n_all
      logical :: quoted

      if (.not. allocated(tokens)) allocate (tokens(16))
      n = 0
      n_all = 0
      quoted = .false.
      associate (range => self%lines(line), text => self%sources(self%lines(line)%source)%text)
         first = range%first
         do i = range%first, range%last + 1
            if (i <= range%last) then
               if (text(i:i) == '"') quoted = .not. quoted
               if (text(i:i) /= ',' .or. quoted) cycle
            end if
            if (n_all == size(tokens)) then
               allocate (grown(2*n_all))
               grown(:n_all) = tokens
               call move_alloc(grown, tokens)
            end if
            n_all = n_all + 1
            last = i - 1
            do while (first <= last)
               if (text(first:first) /= ' ' .and. text(first:first) /= achar(9)) exit
               first = first + 1
            end do
            do while (last >= first)
               if (text(last:last) /= ' ' .and. text(last:last) /= achar(9)) exit
               last = last - 1
            end do
            if (last > first) then
               if (text(first:first) == '"' .and. text(last:last) == '"') then
                  first = first + 1
                  last = last - 1
               end if
            end if
            tokens(n_all) = token_t(line, first, last)
            if (last >= first) n = n_all
            first = i + 1
         end do
      end associate
   end subroutine deck_split

   pure subroutine append_line(deck, line)
      type(deck_t), intent(inout) :: deck
      type(line_t), intent(in) :: line
      type(line_t), allocatable :: grown(:)

      if (deck%n_lines == size(deck%lines)) then
         allocate (grown(2*deck%n_lines))
         grown(:deck%n_lines) = deck%lines
         call move_alloc(grown, deck%lines)
      end if
      deck%n_lines = deck%n_lines + 1
      deck%lines(deck%n_lines) = line
   end subroutine append_line

   pure subroutine append_card(deck, card)
      type(deck_t), intent(inout) :: deck
      type(card_t), intent(inout) :: card
      type(card_t), allocatable :: grown(:)
      integer :: i

      if (deck%n_cards == size(deck%cards)) then
         allocate (grown(2*deck%n_cards))
         do i = 1, deck%n_cards
            call move_card(deck%cards(i), grown(i))
         end do
         call move_alloc(grown, deck%cards)
      end if
      deck%n_cards = deck%n_cards + 1
      call move_card(card, deck%cards(deck%n_cards))
   end subroutine append_card

   pure subroutine move_card(from, to)
      type(card_t), intent(inout) :: from, to

      to%name = from%name
      to%first_data = from%first_data
      to%last_data = from%last_data
      call move_alloc(from%parameters, to%parameters)
   end subroutine move_card

end module litz_deck
