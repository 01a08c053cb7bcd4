!> From files to cards: comments, continued keyword lines, parameters, and *INCLUDE wherever it stands.
!>
!> Abaqus's rules: `**` begins a comment, a keyword line that ends with a comma goes on in the next line, blanks and
!> case do not matter, `"..."` keeps blanks and commas together.
module litz_deck_scanner
   use litz_kinds, only: int64
   use litz_errors, only: error_t, error_list_t, exit_files
   use litz_deck, only: deck_t, source_t, line_t, token_t, parameter_t, card_t, no_token, append_line, append_card
   use litz_deck_copy, only: deck_copy_t
   use litz_numbers, only: parse_integer, number_ok
   use litz_source_files, only: read_file, real_path, relative_to
   use litz_text, only: squeezed, shown, to_text
   implicit none
   private
   public :: scan_deck

   !> Most files in one chain of includes, and most in all
   integer, parameter :: max_include_depth = 100, max_includes = 10000
   !> Positions in a text are default integers
   integer(int64), parameter :: largest_text = 2000000000_int64
   character(len=1), parameter :: newline = achar(10), return_character = achar(13), tab = achar(9)
   !> What some editors write before UTF-8 text
   character(len=3), parameter :: byte_order_mark = char(239)//char(187)//char(191)

   !> Comments of decks that are written from those of users: the file and the lines that messages name
   character(len=*), parameter :: deck_mark = '**litz deck ', line_mark = '**litz line '

   type :: scanner_t
      integer(int64) :: total_length = 0
      !> Position in the source being read, and the number of the line there
      integer :: position = 1, number = 0
      type(deck_copy_t) :: copy
      !> Data before the first keyword have been reported
      logical :: told_stray_data = .false.
      !> A blank line is before the last one
      logical :: is_behind_blank = .false.
   end type scanner_t

contains

   !> Read a deck with all it includes. Errors of form go to `errors`; what can be read is read.
   subroutine scan_deck(path, deck, whole_text, errors)
      !> The deck file, as the user wrote it
      character(len=*), intent(in) :: path
      type(deck_t), intent(out) :: deck
      !> The deck in one text, included files in place of their *INCLUDE lines
      character(len=:), allocatable, intent(out) :: whole_text
      type(error_list_t), intent(inout) :: errors
      type(scanner_t) :: scanner
      type(error_t), allocatable :: error

      allocate (deck%sources(4), deck%lines(1024), deck%cards(64))
      call open_source(deck, scanner, path, 0, 0, error)
      if (allocated(error)) then
         error%message = 'the deck '//error%message
         error%code = exit_files
         call errors%add(error)
         whole_text = ''
         return
      end if
      call scan_source(deck, scanner, deck%n_sources, errors)
      call scanner%copy%text_of(deck, whole_text)
   end subroutine scan_deck

   !> Read a whole file into a new source.
   subroutine open_source(deck, scanner, path, parent, parent_line, error)
      type(deck_t), intent(inout) :: deck
      type(scanner_t), intent(inout) :: scanner
      !> The file, as messages name it
      character(len=*), intent(in) :: path
      !> Index of the source that includes it; 0: none
      integer, intent(in) :: parent
      !> Line number of the *INCLUDE in that source; 0: none
      integer, intent(in) :: parent_line
      type(error_t), allocatable, intent(out) :: error
      type(source_t), allocatable :: grown(:)
      character(len=:), allocatable :: text
      integer :: i

      call read_file(path, largest_text - scanner%total_length, text, error)
      if (allocated(error)) return
      if (deck%n_sources == size(deck%sources)) then
         allocate (grown(2*deck%n_sources))
         do i = 1, deck%n_sources
            grown(i)%path = deck%sources(i)%path
            grown(i)%real_path = deck%sources(i)%real_path
            call move_alloc(deck%sources(i)%text, grown(i)%text)
            grown(i)%parent = deck%sources(i)%parent
            grown(i)%parent_line = deck%sources(i)%parent_line
         end do
         call move_alloc(grown, deck%sources)
      end if
      deck%n_sources = deck%n_sources + 1
      scanner%total_length = scanner%total_length + len(text)
      associate (source => deck%sources(deck%n_sources))
         source%path = path_shown(path, text)
         source%real_path = real_path(path)
         call move_alloc(text, source%text)
         source%parent = parent
         source%parent_line = parent_line
      end associate
   end subroutine open_source

   !> The lines of one source, in order; an included file is read where it stands.
   recursive subroutine scan_source(deck, scanner, source, errors)
      type(deck_t), intent(inout) :: deck
      type(scanner_t), intent(inout) :: scanner
      !> By value: the number of sources, often passed here, grows
      integer, value :: source
      type(error_list_t), intent(inout) :: errors
      type(card_t) :: card
      type(line_t) :: line
      integer :: copied_to, keyword_start, saved_position, saved_number, n_lines
      logical :: found

      scanner%position = 1
      scanner%number = 0
      copied_to = 0
      do
         call next_line(deck, scanner, source, line, found)
         if (.not. found) exit
         keyword_start = line%start
         n_lines = deck%n_lines
         call append_line(deck, line)
         if (deck%sources(source)%text(line%first:line%first) /= '*') then
            call add_data_line(deck, scanner, errors)
            cycle
         end if
         call read_card(deck, scanner, source, card, errors)
         if (squeezed(deck%text(card%name)) /= 'INCLUDE') then
            call append_card(deck, card)
            cycle
         end if
         call scanner%copy%append_range(source, copied_to + 1, keyword_start - 1)
         saved_position = scanner%position
         saved_number = scanner%number
         call include_file(deck, scanner, source, card, n_lines, errors)
         scanner%position = saved_position
         scanner%number = saved_number
         copied_to = saved_position - 1
      end do
      call scanner%copy%append_range(source, copied_to + 1, len(deck%sources(source)%text))
   end subroutine scan_source

   !> The next line that is neither blank nor a comment.
   subroutine next_line(deck, scanner, source, line, found)
      type(deck_t), intent(in) :: deck
      type(scanner_t), intent(inout) :: scanner
      !> Index of the source
      integer, intent(in) :: source
      type(line_t), intent(out) :: line
      !> .false.: the source is at its end
      logical, intent(out) :: found
      integer :: length, line_end

      scanner%is_behind_blank = .false.
      associate (text => deck%sources(source)%text)
         length = len(text)
         if (scanner%position == 1 .and. starts_with_mark(text)) scanner%position = 4
         do while (scanner%position <= length)
            line_end = index(text(scanner%position:), newline) + scanner%position - 2
            if (line_end < scanner%position - 1) line_end = length
            scanner%number = scanner%number + 1
            line = line_t(source, scanner%number, scanner%position, scanner%position, line_end)
            scanner%position = line_end + 2
            call trim_line(text, line)
            if (line%first > line%last) then
               scanner%is_behind_blank = .true.
               cycle
            end if
            if (line%first < line%last) then
               if (text(line%first:line%first + 1) == '**') then
                  call note_line(text(line%first:line%last), scanner%number)
                  cycle
               end if
            end if
            found = .true.
            return
         end do
      end associate
      found = .false.
   end subroutine next_line

   !> A comment that says which line of the deck of a user follows, where another program has written this one from it.
   pure subroutine note_line(comment, number)
      !> From its asterisks on
      character(len=*), intent(in) :: comment
      !> Of the line before the next one
      integer, intent(inout) :: number
      integer :: next, status

      if (index(comment, line_mark) /= 1) return
      call parse_integer(comment(len(line_mark) + 1:), next, status)
      if (status == number_ok) number = next - 1
   end subroutine note_line

   !> The path that messages name: the file, or what it says that it was made from.
   pure function path_shown(path, text) result(shown)
      !> The file
      character(len=*), intent(in) :: path
      !> Its text
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: shown

      shown = path
      if (index(text(:min(len(text), len(deck_mark))), deck_mark) /= 1) return
      shown = text(len(deck_mark) + 1:index(text, newline) - 1)
   end function path_shown

   pure logical function starts_with_mark(text)
      !> Whole text of a source
      character(len=*), intent(in) :: text

      starts_with_mark = .false.
      if (len(text) >= 3) starts_with_mark = text(:3) == byte_order_mark
   end function starts_with_mark

   pure subroutine trim_line(text, line)
      !> Text of the source that the line is in
      character(len=*), intent(in) :: text
      type(line_t), intent(inout) :: line

      do while (line%first <= line%last)
         if (.not. is_blank(text(line%first:line%first))) exit
         line%first = line%first + 1
      end do
      do while (line%last >= line%first)
         if (.not. is_blank(text(line%last:line%last))) exit
         line%last = line%last - 1
      end do
   end subroutine trim_line

   pure logical function is_blank(character)
      !> The character to be judged
      character(len=1), intent(in) :: character

      is_blank = character == ' ' .or. character == tab .or. character == return_character
   end function is_blank

   !> The last line is data: of the last card, or of none.
   subroutine add_data_line(deck, scanner, errors)
      type(deck_t), intent(inout) :: deck
      type(scanner_t), intent(inout) :: scanner
      type(error_list_t), intent(inout) :: errors

      if (deck%n_cards > 0) then
         if (scanner%is_behind_blank) call keep_blank_axis(deck)
         deck%cards(deck%n_cards)%last_data = deck%n_lines
      else if (.not. scanner%told_stray_data) then
         scanner%told_stray_data = .true.
         call errors%add(deck%error_at(deck%line_token(deck%n_lines), &
            'data before the first keyword; '//advice(deck%text(deck%line_token(deck%n_lines)))))
      end if

   contains

      !> What the line may have been meant for.
      pure function advice(line)
         !> The first line of the deck that is neither blank nor a comment
         character(len=*), intent(in) :: line
         character(len=:), allocatable :: advice

         advice = 'a deck begins with a keyword line such as *HEADING'
         if (scan(line(:min(1, len(line))), '#!$/') == 1) then
            advice = 'a comment begins with **'
         else if (index(line, achar(0)) > 0) then
            advice = 'this file is not plain text (UTF-8): it may be UTF-16, or no deck'
         end if
      end function advice

   end subroutine add_data_line

   !> The last line is data behind a blank line: in Abaqus, that is the first axis of a section which is left out where
   !> the moduli follow.
   subroutine keep_blank_axis(deck)
      type(deck_t), intent(inout) :: deck
      type(line_t) :: moduli

      associate (card => deck%cards(deck%n_cards))
         if (card%last_data /= card%first_data .or. squeezed(deck%text(card%name)) /= 'BEAMGENERALSECTION') return
      end associate
      moduli = deck%lines(deck%n_lines)
      associate (blank => deck%lines(deck%n_lines))
         blank%number = moduli%number - 1
         blank%last = blank%first - 1
      end associate
      call append_line(deck, moduli)
   end subroutine keep_blank_axis

   !> The keyword and its parameters, from the last line on and over its continuations.
   subroutine read_card(deck, scanner, source, card, errors)
      type(deck_t), intent(inout) :: deck
      type(scanner_t), intent(inout) :: scanner
      !> Index of the source
      integer, intent(in) :: source
      type(card_t), intent(out) :: card
      type(error_list_t), intent(inout) :: errors
      type(token_t), allocatable :: fields(:)
      type(scanner_t) :: ahead
      type(line_t) :: line
      type(parameter_t), allocatable :: parameters(:)
      integer :: i, n, n_parameters, first_field
      logical :: found

      allocate (parameters(8))
      n_parameters = 0
      call split_keyword_line(deck, deck%n_lines, fields, n, errors)
      card%name = fields(1)
      card%name%first = card%name%first + 1
      do while (card%name%first <= card%name%last)
         if (.not. is_blank(deck%sources(source)%text(card%name%first:card%name%first))) exit
         card%name%first = card%name%first + 1
      end do
      first_field = 2
      do
         do i = first_field, n
            if (fields(i)%last >= fields(i)%first) call append_parameter(deck, parameters, n_parameters, fields(i))
         end do
         line = deck%lines(deck%n_lines)
         if (deck%sources(source)%text(line%last:line%last) /= ',') exit
         ahead%position = scanner%position
         ahead%number = scanner%number
         call next_line(deck, ahead, source, line, found)
         if (found) found = deck%sources(source)%text(line%first:line%first) /= '*'
         if (.not. found) then
            call errors%add(deck%error_at(token_t(deck%n_lines, deck%lines(deck%n_lines)%last, &
               deck%lines(deck%n_lines)%last), 'the keyword line ends with a comma, but no line continues it'))
            exit
         end if
         scanner%position = ahead%position
         scanner%number = ahead%number
         call append_line(deck, line)
         call split_keyword_line(deck, deck%n_lines, fields, n, errors)
         first_field = 1
      end do
      card%parameters = parameters(:n_parameters)
      card%first_data = deck%n_lines + 1
      card%last_data = deck%n_lines
   end subroutine read_card

   !> Split at commas; a quote that is not closed is an error.
   subroutine split_keyword_line(deck, line, fields, n, errors)
      type(deck_t), intent(in) :: deck
      !> Index into the lines of the deck
      integer, intent(in) :: line
      type(token_t), allocatable, intent(inout) :: fields(:)
      !> Number of fields
      integer, intent(out) :: n
      type(error_list_t), intent(inout) :: errors
      integer :: i, quote, n_quotes

      call deck%split(line, fields, n)
      n_quotes = 0
      quote = 0
      associate (range => deck%lines(line), text => deck%sources(deck%lines(line)%source)%text)
         do i = range%first, range%last
            if (text(i:i) /= '"') cycle
            n_quotes = n_quotes + 1
            quote = i
         end do
      end associate
      if (mod(n_quotes, 2) == 1) then
         call errors%add(deck%error_at(token_t(line, quote, quote), 'this quotation mark is never closed'))
      end if
   end subroutine split_keyword_line

   !> `NAME`, `NAME=value` or `NAME="value"`
   pure subroutine append_parameter(deck, parameters, n, field)
      type(deck_t), intent(in) :: deck
      type(parameter_t), allocatable, intent(inout) :: parameters(:)
      !> Number of those that are set
      integer, intent(inout) :: n
      type(token_t), intent(in) :: field
      type(parameter_t), allocatable :: grown(:)
      type(parameter_t) :: parameter
      type(line_t) :: range
      integer :: equals

      associate (text => deck%sources(deck%lines(field%line)%source)%text)
         equals = index(text(field%first:field%last), '=')
         parameter%name = field
         parameter%has_value = equals > 0
         if (parameter%has_value) then
            equals = equals + field%first - 1
            range%first = field%first
            range%last = equals - 1
            call trim_line(text, range)
            parameter%name = token_t(field%line, range%first, range%last)
            range%first = equals + 1
            range%last = field%last
            call trim_line(text, range)
            if (range%last > range%first) then
               if (text(range%first:range%first) == '"' .and. text(range%last:range%last) == '"') then
                  range%first = range%first + 1
                  range%last = range%last - 1
               end if
            end if
            parameter%value = token_t(field%line, range%first, range%last)
         end if
      end associate
      if (n == size(parameters)) then
         allocate (grown(2*n))
         grown(:n) = parameters
         call move_alloc(grown, parameters)
      end if
      n = n + 1
      parameters(n) = parameter
   end subroutine append_parameter

   !> Read what an *INCLUDE names, in place of the line.
   recursive subroutine include_file(deck, scanner, source, card, n_lines, errors)
      type(deck_t), intent(inout) :: deck
      type(scanner_t), intent(inout) :: scanner
      !> Index of the source
      integer, intent(in) :: source
      type(card_t), intent(in) :: card
      !> Number of lines of the deck before the *INCLUDE, which is taken out again
      integer, intent(in) :: n_lines
      type(error_list_t), intent(inout) :: errors
      type(token_t) :: name
      type(error_t), allocatable :: error
      character(len=:), allocatable :: path
      integer :: parent_line

      parent_line = deck%lines(card%name%line)%number
      call included_name(deck, card, name, errors)
      if (name%line > 0) then
         path = relative_to(deck%sources(source)%path, deck%text(name))
         call check_chain(deck, source, name, path, errors, error)
         if (.not. allocated(error)) then
            call open_source(deck, scanner, path, source, parent_line, error)
            if (allocated(error)) call errors%add(deck%error_at(name, 'the included '//error%message))
         end if
      end if
      deck%n_lines = n_lines
      if (name%line == 0 .or. allocated(error)) return
      call scanner%copy%append_words('** included: '//path//newline)
      call scan_source(deck, scanner, deck%n_sources, errors)
      call scanner%copy%append_words(newline)
   end subroutine include_file

   !> The value of INPUT=, or `no_token` after an error.
   subroutine included_name(deck, card, name, errors)
      type(deck_t), intent(in) :: deck
      type(card_t), intent(in) :: card
      type(token_t), intent(out) :: name
      type(error_list_t), intent(inout) :: errors
      integer :: i

      name = no_token
      do i = 1, size(card%parameters)
         associate (parameter => card%parameters(i))
            if (squeezed(deck%text(parameter%name)) /= 'INPUT') then
               call errors%add(deck%error_at(parameter%name, 'unknown parameter '//deck%shown(parameter%name)// &
                  ' of *INCLUDE; allowed: INPUT'))
            else if (parameter%value%last >= parameter%value%first .and. parameter%has_value) then
               name = parameter%value
            end if
         end associate
      end do
      if (name%line == 0) call errors%add(deck%error_at(card%name, '*INCLUDE needs INPUT=file'))
   end subroutine included_name

   !> Refuse circles, chains that are too deep, and too many files.
   subroutine check_chain(deck, source, name, path, errors, error)
      type(deck_t), intent(in) :: deck
      !> Index of the source that has the *INCLUDE
      integer, intent(in) :: source
      type(token_t), intent(in) :: name
      !> The file that it names
      character(len=*), intent(in) :: path
      type(error_list_t), intent(inout) :: errors
      type(error_t), allocatable, intent(out) :: error
      character(len=:), allocatable :: resolved
      integer :: ancestor, depth

      resolved = real_path(path)
      ancestor = source
      depth = 1
      do while (ancestor > 0)
         if (deck%sources(ancestor)%real_path == resolved) then
            error = deck%error_at(name, 'the file '//shown(path)//' includes itself, directly or through others')
            exit
         end if
         depth = depth + 1
         ancestor = deck%sources(ancestor)%parent
      end do
      if (depth > max_include_depth) error = deck%error_at(name, 'included files are nested more than '// &
         to_text(max_include_depth)//' deep')
      if (deck%n_sources >= max_includes) error = deck%error_at(name, 'more than '//to_text(max_includes)// &
         ' files are included')
      if (allocated(error)) call errors%add(error)
   end subroutine check_chain

end module litz_deck_scanner
