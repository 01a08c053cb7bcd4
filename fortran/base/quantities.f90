!> Named quantities, and tables of them.
!>
!> A procedure that names the components of a type, `call table%field('gap', contact%gap, 'm', 'gap between ...')`, one
!> line for each, serves all that is done with them: it describes the columns, stores a row, or sets the components
!> from a row.
module litz_quantities
   use litz_kinds, only: dp
   use litz_text, only: words_of, word_length
   implicit none
   private
   public :: quantity_t, quantity_table_t
   public :: on_points, on_cells
   public :: name_length

   integer, parameter :: on_points = 1, on_cells = 2
   integer, parameter :: name_length = 32
   integer, parameter :: describing = 1, storing = 2, restoring = 3
   character(len=1), parameter :: axes(3) = ['x', 'y', 'z']

   !> What a name stands for, in result files and in messages.
   type :: quantity_t
      character(len=name_length) :: name = ''
      !> Unit in SI; empty: the next increment needs the quantity, but no result shows it
      character(len=12) :: unit = ''
      character(len=120) :: text = ''
      !> `on_points` or `on_cells` of the result file
      integer :: place = on_points
      !> 1 or 3 numbers
      integer :: components = 1
      logical :: is_integer = .false.
      !> The integer is the index of an element: results have its number in the deck
      logical :: is_element = .false.
      !> What tables of text have instead of the integers 0, 1, ..., with bars between the words
      character(len=32) :: words = ''
      !> Infinity is a value, and no sign of a mistake
      logical :: may_be_infinite = .false.
      !> Its first number in a row of reals or of integers
      integer :: first = 0
   contains
      procedure :: columns
      procedure :: word
      procedure :: is_result
      procedure :: last
   end type quantity_t

   !> Rows of numbers, whose columns are quantities.
   type :: quantity_table_t
      type(quantity_t), allocatable :: quantities(:)
      !> (numbers of a row, rows)
      real(dp), allocatable :: reals(:, :)
      integer, allocatable :: integers(:, :)
      !> What `field` does, the row it is at, and the numbers of the row so far
      integer, private :: mode = describing, row = 0, n_reals = 0, n_integers = 0
   contains
      procedure :: begin_storing
      procedure :: begin_restoring
      procedure :: next_row
      procedure, private :: real_field, vector_field, integer_field, logical_field
      generic :: field => real_field, vector_field, integer_field, logical_field
      procedure, private :: describe
   end type quantity_table_t

contains

   !> Names of the columns that hold it: `,gap`, or `,normal_x,normal_y,normal_z`.
   pure function columns(self, before, with_units) result(text)
      class(quantity_t), intent(in) :: self
      !> What stands before each
      character(len=1), intent(in) :: before
      !> `,gap [m]`
      logical, intent(in) :: with_units
      character(len=:), allocatable :: text
      integer :: i

      text = ''
      do i = 1, self%components
         text = text//before//trim(self%name)
         if (self%components > 1) text = text//'_'//axes(i)
         if (with_units .and. self%unit /= '1') text = text//' ['//trim(self%unit)//']'
      end do
   end function columns

   !> What a table of text has instead of a number.
   pure function word(self, number)
      class(quantity_t), intent(in) :: self
      !> From 0
      integer, intent(in) :: number
      character(len=:), allocatable :: word
      character(len=word_length), allocatable :: words(:)

      allocate (words, source=words_of(self%words))
      word = trim(words(number + 1))
   end function word

   pure logical function is_result(self)
      class(quantity_t), intent(in) :: self

      is_result = len_trim(self%unit) > 0
   end function is_result

   !> Its last number in a row.
   pure integer function last(self)
      class(quantity_t), intent(in) :: self

      last = self%first + self%components - 1
   end function last

   !> Once all columns are described: makes room for rows that are to be stored.
   pure subroutine begin_storing(self, n_rows)
      class(quantity_table_t), intent(inout) :: self
      !> Number of rows
      integer, intent(in) :: n_rows

      allocate (self%reals(self%n_reals, n_rows), self%integers(self%n_integers, n_rows))
      self%mode = storing
      self%row = 0
   end subroutine begin_storing

   !> Rows that are there are now given back.
   pure subroutine begin_restoring(self)
      class(quantity_table_t), intent(inout) :: self

      self%mode = restoring
      self%row = 0
   end subroutine begin_restoring

   pure subroutine next_row(self)
      class(quantity_table_t), intent(inout) :: self

      self%row = self%row + 1
      self%n_reals = 0
      self%n_integers = 0
   end subroutine next_row

   pure subroutine real_field(self, name, value, unit, text, may_be_infinite)
      class(quantity_table_t), intent(inout) :: self
      !> Of the quantity
      character(len=*), intent(in) :: name
      !> Stored, or set from the row
      real(dp), intent(inout) :: value
      !> As in `quantity_t`
      character(len=*), intent(in), optional :: unit, text
      !> As in `quantity_t`
      logical, intent(in), optional :: may_be_infinite

      self%n_reals = self%n_reals + 1
      select case (self%mode)
      case (describing)
         call self%describe(name, self%n_reals, 1, unit, text)
         if (present(may_be_infinite)) self%quantities(size(self%quantities))%may_be_infinite = may_be_infinite
      case (storing)
         self%reals(self%n_reals, self%row) = value
      case (restoring)
         value = self%reals(self%n_reals, self%row)
      end select
   end subroutine real_field

   pure subroutine vector_field(self, name, values, unit, text)
      class(quantity_table_t), intent(inout) :: self
      !> Of the quantity
      character(len=*), intent(in) :: name
      !> Stored, or set from the row
      real(dp), intent(inout) :: values(3)
      !> As in `quantity_t`
      character(len=*), intent(in), optional :: unit, text

      associate (first => self%n_reals + 1, last => self%n_reals + 3)
         select case (self%mode)
         case (describing)
            call self%describe(name, first, 3, unit, text)
         case (storing)
            self%reals(first:last, self%row) = values
         case (restoring)
            values = self%reals(first:last, self%row)
         end select
      end associate
      self%n_reals = self%n_reals + 3
   end subroutine vector_field

   pure subroutine integer_field(self, name, value, unit, text, is_element, words)
      class(quantity_table_t), intent(inout) :: self
      !> Of the quantity
      character(len=*), intent(in) :: name
      !> Stored, or set from the row
      integer, intent(inout) :: value
      !> As in `quantity_t`
      character(len=*), intent(in), optional :: unit, text, words
      !> As in `quantity_t`
      logical, intent(in), optional :: is_element

      self%n_integers = self%n_integers + 1
      select case (self%mode)
      case (describing)
         call self%describe(name, self%n_integers, 1, unit, text)
         associate (quantity => self%quantities(size(self%quantities)))
            quantity%is_integer = .true.
            if (present(is_element)) quantity%is_element = is_element
            if (present(words)) quantity%words = words
         end associate
      case (storing)
         self%integers(self%n_integers, self%row) = value
      case (restoring)
         value = self%integers(self%n_integers, self%row)
      end select
   end subroutine integer_field

   pure subroutine logical_field(self, name, value)
      class(quantity_table_t), intent(inout) :: self
      !> Of the quantity
      character(len=*), intent(in) :: name
      !> Stored, or set from the row
      logical, intent(inout) :: value
      integer :: number

      number = merge(1, 0, value)
      call self%integer_field(name, number)
      value = number /= 0
   end subroutine logical_field

   pure subroutine describe(self, name, first, components, unit, text)
      class(quantity_table_t), intent(inout) :: self
      !> Of the quantity
      character(len=*), intent(in) :: name
      !> As in `quantity_t`
      integer, intent(in) :: first, components
      !> As in `quantity_t`
      character(len=*), intent(in), optional :: unit, text
      type(quantity_t) :: quantity

      quantity%name = name
      quantity%first = first
      quantity%components = components
      if (present(unit)) quantity%unit = unit
      if (present(text)) quantity%text = text
      if (.not. allocated(self%quantities)) allocate (self%quantities(0))
      self%quantities = [self%quantities, quantity]
   end subroutine describe

end module litz_quantities
