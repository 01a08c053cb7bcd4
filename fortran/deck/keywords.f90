!> How a keyword is described: its parameters, its data lines, its place in the deck, and what it means.
!>
!> The descriptions themselves are the table of litz_keyword_table. They drive the checks of the reader, the hints
!> after a misspelling, and the reference of the deck.
module litz_keywords
   use litz_fields, only: n_fields
   use litz_kinds, only: dp
   use litz_foreign_words, only: foreign_keyword, advice_about, role_of, role_idle
   use litz_text, only: squeezed, nearest_word, word_length
   implicit none
   private
   public :: keyword_t, parameter_spec_t, data_spec_t, field_spec_t, keyword_table_t
   public :: place_model, place_step, place_both, place_begins_step
   public :: kind_flag, kind_integer, kind_real, kind_choice, kind_name, kind_item, kind_file, kind_text
   public :: limit_none, limit_positive, limit_not_negative, limit_poisson, limit_unused, limit_one
   public :: describe_limit
   public :: unknown_keyword_message, keyword_meant, within_limit, largest_number, smallest_positive

   !> Where a keyword may stand
   integer, parameter :: place_model = 1, place_step = 2, place_both = 3, place_begins_step = 4

   !> What a value is. `kind_item`: the number of a node or element, or the name of a set; `kind_text`: a free line
   integer, parameter :: kind_flag = 1, kind_integer = 2, kind_real = 3, kind_choice = 4, kind_name = 5, &
      kind_item = 6, &
      kind_file = 7, kind_text = 8

   !> What a number must satisfy. `limit_unused`: the place must stay empty; `limit_one`: one or more
   integer, parameter :: limit_none = 0, limit_positive = 1, limit_not_negative = 2, limit_poisson = 3, &
      limit_unused = 5, limit_one = 6

   !> Numbers of a deck beyond these mean nothing in any unit, and what is computed from them would overflow
   real(dp), parameter :: largest_number = 1.0e60_dp, smallest_positive = 1.0e-60_dp

   !> More than any help text has. Allocatable texts would leak: gfortran does not free them in array constructors.
   integer, parameter :: help_length = 1000

   type :: parameter_spec_t
      character(len=24) :: name = ''
      integer :: kind = kind_flag
      !> `kind_choice`: the words allowed, separated by bars
      character(len=120) :: choices = ''
      logical :: required = .false.
      !> `kind_choice`, `kind_real`: the word alone, without a value, is allowed
      logical :: value_optional = .false.
      integer :: limit = limit_none
      character(len=24) :: default = ''
      character(len=help_length) :: help = ''
   end type parameter_spec_t

   !> One value of a data line.
   type :: field_spec_t
      character(len=16) :: name = ''
      integer :: kind = kind_real
      character(len=24) :: unit = ''
      integer :: limit = limit_none
      character(len=120) :: choices = ''
      logical :: required = .true.
      character(len=help_length) :: help = ''
      !> The value is a degree of freedom of one of these fields; none: it is something else
      logical :: dofs_of(n_fields) = .false.
   end type field_spec_t

   !> One or several data lines of the same form.
   type :: data_spec_t
      !> `PARAMETER=VALUE` under which the form holds, or empty
      character(len=48) :: when = ''
      !> First and last line of this form; last 0: any number
      integer :: first = 1, last = 1
      !> The first of these lines must be there
      logical :: required = .true.
      !> `PARAMETER=VALUE`, or a parameter with any value, with which it need not, or empty
      character(len=48) :: optional_with = ''
      !> How often the fields may repeat on a line; 0: any number of times
      integer :: repeats = 1
      type(field_spec_t), allocatable :: fields(:)
   end type data_spec_t

   type :: keyword_t
      character(len=32) :: name = ''
      integer :: place = place_model
      !> The keyword it belongs to and must follow, or empty
      character(len=32) :: after = ''
      !> The keyword that it stands for to those that belong to that one, or empty
      character(len=32) :: counts_as = ''
      type(parameter_spec_t), allocatable :: parameters(:)
      type(data_spec_t), allocatable :: data(:)
      character(len=help_length) :: help = ''
   contains
      procedure :: find_parameter => keyword_find_parameter
      procedure :: add => keyword_add_parameter
      procedure :: add_data => keyword_add_data
   end type keyword_t

   type :: keyword_table_t
      integer :: n = 0
      type(keyword_t), allocatable :: keywords(:)
   contains
      procedure :: find => table_find
      procedure :: names => table_names
   end type keyword_table_t

contains

   !> Index of a keyword, however it is written; 0 when it is not in the table.
   pure integer function table_find(self, name) result(index)
      class(keyword_table_t), intent(in) :: self
      !> The keyword without its asterisk, in any case
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: wanted

      wanted = squeezed(name)
      do index = 1, self%n
         if (squeezed(trim(self%keywords(index)%name)) == wanted) return
      end do
      index = 0
   end function table_find

   pure function table_names(self) result(names)
      class(keyword_table_t), intent(in) :: self
      character(len=word_length), allocatable :: names(:)
      integer :: i

      allocate (names(self%n))
      do i = 1, self%n
         names(i) = self%keywords(i)%name
      end do
   end function table_names

   !> What to say about a keyword that is not in the table.
   pure function unknown_keyword_message(table, name, shown) result(message)
      type(keyword_table_t), intent(in) :: table
      !> The keyword as the user wrote it
      character(len=*), intent(in) :: name
      !> The same as the message shows it
      character(len=*), intent(in) :: shown
      character(len=:), allocatable :: message
      character(len=:), allocatable :: nearest

      message = advice_about(name)
      if (len(message) > 0) then
         message = 'litz has no *'//foreign_keyword(name)//': '//message
         if (role_of(name) == role_idle) message = message//'; ignored'
         return
      end if
      message = 'unknown keyword '//shown
      nearest = keyword_meant(table, name)
      if (len(nearest) == 0) then
         message = message//'; `litz keywords` lists all'
      else if (index(name, '=') > 0) then
         message = message//'; a comma is missing after *'//nearest
      else
         message = message//'; did you mean *'//nearest//'?'
      end if
   end function unknown_keyword_message

   !> The keyword that was probably meant; empty when none is near.
   pure function keyword_meant(table, name) result(keyword)
      type(keyword_table_t), intent(in) :: table
      !> As the user wrote it
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: keyword

      if (index(name, '=') > 0) then
         keyword = keyword_before_blank(table, name)
      else
         keyword = nearest_word(squeezed(name), table%names())
      end if
   end function keyword_meant

   !> The longest keyword with which a name begins, followed by a blank; empty when there is none.
   pure function keyword_before_blank(table, name) result(keyword)
      type(keyword_table_t), intent(in) :: table
      !> As the user wrote it
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: keyword
      integer :: i, known

      keyword = ''
      do i = 2, len(name)
         if (name(i:i) /= ' ' .and. name(i:i) /= achar(9)) cycle
         known = table%find(name(:i - 1))
         if (known > 0) keyword = trim(table%keywords(known)%name)
      end do
   end function keyword_before_blank

   !> Index of a parameter, however it is written; 0 when there is none.
   pure integer function keyword_find_parameter(self, name) result(index)
      class(keyword_t), intent(in) :: self
      !> The parameter, in any case
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: wanted

      wanted = squeezed(name)
      do index = 1, size(self%parameters)
         if (squeezed(trim(self%parameters(index)%name)) == wanted) return
      end do
      index = 0
   end function keyword_find_parameter

   pure subroutine keyword_add_parameter(self, parameter)
      class(keyword_t), intent(inout) :: self
      type(parameter_spec_t), intent(in) :: parameter

      self%parameters = [self%parameters, parameter]
   end subroutine keyword_add_parameter

   pure subroutine keyword_add_data(self, fields, when, first, last, required, repeats, optional_with)
      class(keyword_t), intent(inout) :: self
      type(field_spec_t), intent(in) :: fields(:)
      !> `PARAMETER=VALUE`: lines of this form are there only then; absent: always
      character(len=*), intent(in), optional :: when
      !> `PARAMETER=VALUE`, or a parameter with any value: the lines may be left out then
      character(len=*), intent(in), optional :: optional_with
      !> First and last of the data lines that have this form; `last` 0: any number of lines
      integer, intent(in), optional :: first, last
      !> .true.: the line must be there
      logical, intent(in), optional :: required
      !> How many times the fields may follow each other on a line; 0: any number of times
      integer, intent(in), optional :: repeats
      type(data_spec_t) :: spec
      type(data_spec_t), allocatable :: grown(:)
      integer :: i, n

      if (present(when)) spec%when = when
      if (present(first)) spec%first = first
      spec%last = spec%first
      if (present(last)) spec%last = last
      if (present(required)) spec%required = required
      if (present(optional_with)) spec%optional_with = optional_with
      if (present(repeats)) spec%repeats = repeats
      spec%fields = fields
      n = size(self%data)
      allocate (grown(n + 1))
      do i = 1, n
         grown(i) = self%data(i)
      end do
      grown(n + 1) = spec
      call move_alloc(grown, self%data)
   end subroutine keyword_add_data

   pure logical function within_limit(value, limit)
      !> The number
      real(dp), intent(in) :: value
      !> What the number must satisfy, one of `limit_...`
      integer, intent(in) :: limit

      within_limit = abs(value) <= largest_number
      select case (limit)
      case (limit_positive)
         within_limit = within_limit .and. value >= smallest_positive
      case (limit_not_negative)
         within_limit = within_limit .and. value >= 0
      case (limit_poisson)
         within_limit = value > -1 .and. value < 0.5_dp
      case (limit_one)
         within_limit = within_limit .and. value >= 1
      case (limit_unused)
         within_limit = .false.
      end select
   end function within_limit

   pure function describe_limit(limit) result(words)
      !> One of `limit_...`
      integer, intent(in) :: limit
      character(len=:), allocatable :: words

      select case (limit)
      case (limit_positive)
         words = 'greater than 0'
      case (limit_not_negative)
         words = '0 or greater'
      case (limit_poisson)
         words = 'between -1 and 0.5'
      case (limit_one)
         words = '1 or greater'
      case (limit_unused)
         words = 'left empty, litz does not use it'
      case default
         words = ''
      end select
   end function describe_limit

   ! Short constructors, so that the table reads like a table.

end module litz_keywords
