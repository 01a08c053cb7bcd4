!> The values of one data line after another, read and checked against the keyword table.
module litz_data_lines
   use litz_kinds, only: dp
   use litz_text, only: to_text
   use litz_numbers, only: parse_integer, parse_real, number_ok, number_not_one
   use litz_foreign_words, only: advice_about_more
   use litz_keywords, only: data_spec_t, field_spec_t, kind_integer, kind_real, kind_text, within_limit
   use litz_deck, only: token_t
   use litz_reader, only: reader_t, values_t, fail_at, applies, keyword_of
   use litz_value_checks, only: check_value, behind_semicolon, hint_about_blanks
   implicit none
   private
   public :: read_line, read_only_line, describe_form

contains

   !> Read and check the values of a data line; all errors are reported.
   subroutine read_line(self, card, line, ok)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> Index into the lines of the deck
      integer, intent(in) :: line
      !> .false.: something was reported; values that were not understood are not `given`
      logical, intent(out) :: ok
      integer :: i, n_fields, n_allowed
      logical :: value_ok, has_more

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
         has_more = n > n_allowed .and. n_allowed > 0
         if (has_more) n = n_allowed
         do i = 1, n
            call read_value(self, form%fields(mod(i - 1, n_fields) + 1), i, value_ok)
            ok = ok .and. value_ok
         end do
         ! of a value that is none of these there may be more
         if (has_more .and. ok) call fail_at(self, self%values%token(n_allowed + 1), 'too many values: *'// &
            keyword_of(self, card)//' takes '//to_text(n_allowed)//' on this line: '//describe_form(form)// &
            behind_semicolon(advice_about_more(keyword_of(self, card), form%when)))
         ok = ok .and. .not. has_more
         if (mod(n, n_fields) /= 0 .or. n == 0) call check_missing(self, form, line, ok)
      end associate
   end subroutine read_line

   !> The first data line of a card; `ok` is .false. when there is none.
   subroutine read_only_line(self, card, ok)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> .false.: there is no line, or something about it was reported
      logical, intent(out) :: ok

      ok = self%deck%cards(card)%last_data >= self%deck%cards(card)%first_data
      if (ok) call read_line(self, card, self%deck%cards(card)%first_data, ok)
   end subroutine read_only_line

   !> The form that the table gives for this line of the card.
   pure subroutine find_form(self, card, line)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> Index into the lines of the deck
      integer, intent(in) :: line
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

   !> Take one value; an empty one is an error when it is required.
   subroutine read_value(self, field, i, ok)
      type(reader_t), intent(inout) :: self
      type(field_spec_t), intent(in) :: field
      !> Place of the value on the line
      integer, intent(in) :: i
      !> .false.: an error was reported
      logical, intent(out) :: ok
      integer :: whole
      real(dp) :: real_value

      associate (token => self%values%token(i))
         ok = .true.
         if (token%last < token%first) then
            if (field%required) then
               call fail_at(self, token, 'value '//to_text(i)//', '//describe_field(field)//', is missing')
               ok = .false.
            end if
            return
         end if
         call take_number(self%deck%sources(self%deck%lines(token%line)%source)%text(token%first:token%last), field, &
            whole, real_value, ok)
         if (.not. ok) call check_value(self, token, field%kind, field%limit, field%choices, 'value '//to_text(i)// &
            ', '//describe_field(field)//',', whole, real_value, ok)
         self%values%whole(i) = whole
         self%values%real(i) = real_value
         self%values%given(i) = ok
      end associate
   end subroutine read_value

   !> A valid number, by the shortest way: a deck may have millions of them.
   pure subroutine take_number(text, field, whole, real_value, ok)
      !> The value, without blanks around it
      character(len=*), intent(in) :: text
      type(field_spec_t), intent(in) :: field
      !> `kind_integer`: the number; else 0
      integer, intent(out) :: whole
      !> The number, a whole one too; 0 where there is none
      real(dp), intent(out) :: real_value
      !> .false.: not a number, or not an allowed one
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

   !> Report a required value that is missing behind the last one.
   subroutine check_missing(self, form, line, ok)
      type(reader_t), intent(inout) :: self
      type(data_spec_t), intent(in) :: form
      !> Index into the lines of the deck
      integer, intent(in) :: line
      !> Becomes .false. where an error is reported
      logical, intent(inout) :: ok
      integer :: i

      do i = mod(self%values%n, size(form%fields)) + 1, size(form%fields)
         if (.not. form%fields(i)%required) cycle
         call fail_at(self, self%deck%end_of_line(line), 'value '//to_text(self%values%n + i - &
            mod(self%values%n, size(form%fields)))//', '//describe_field(form%fields(i))// &
            ', is missing; the line holds '// &
            describe_form(form)//comma_hint())
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

   pure function describe_field(field) result(words)
      type(field_spec_t), intent(in) :: field
      character(len=:), allocatable :: words

      words = trim(field%name)
      if (len_trim(field%help) > 0 .and. index(field%help, ';') == 0) words = words//' ('//trim(field%help)//')'
   end function describe_field

   !> The names of its values.
   pure function describe_form(form) result(words)
      type(data_spec_t), intent(in) :: form
      character(len=:), allocatable :: words
      integer :: i

      words = ''
      do i = 1, size(form%fields)
         if (i > 1) words = words//', '
         words = words//trim(form%fields(i)%name)
      end do
      if (form%repeats /= 1) words = words//', '//words//', ...'
   end function describe_form

end module litz_data_lines
