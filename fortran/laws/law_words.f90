!> What every law of a contact has: its name, its meaning and its data, as decks, their reference and Python know them.
module litz_law_words
   use litz_kinds, only: dp
   implicit none
   private
   public :: law_words_t, law_field_t, max_fields, film_meaning

   !> Most numbers on a data line of a law
   integer, parameter :: max_fields = 4

   !> Of the number sigma_f of all laws of spots that have one
   character(len=*), parameter :: film_meaning = 'film resistance times area, of both faces together; of a coating'// &
      ' its resistivity times its thickness'

   !> A number of the data, always positive where it is given.
   type :: law_field_t
      character(len=16) :: name = ''
      character(len=12) :: unit = ''
      character(len=160) :: meaning = ''
      !> It may be left out: then it is 0
      logical :: is_optional = .false.
      !> It is 1 or more
      logical :: is_count = .false.
      !> It is no number of the data line, but a parameter of the card; these come last
      logical :: is_parameter = .false.
      !> A parameter may stand in its place
      logical :: has_substitute = .false.
   end type law_field_t

   type :: law_words_t
      !> Place in the table of its family; 0: no law
      integer :: number = 0
      !> In decks, and in lower case in Python
      character(len=16) :: name = ''
      !> The end of `NAME: ...` in the deck reference
      character(len=100) :: meaning = ''
      !> The numbers on a data line and those of parameters; those without a name are not used
      type(law_field_t) :: fields(max_fields)
      !> Its data are a table: any number of lines, their first numbers ascending
      logical :: has_table = .false.
      !> It acts on the Hertz ellipse of the contact
      logical :: uses_ellipse = .false.
      !> Of a spot: at a given force it depends on Young's moduli
      logical :: is_elastic = .false.
      !> The numbers of its data line, and those of its table (n_fields, n_lines), which only a law that has one has
      real(dp) :: data(max_fields) = 0
      real(dp), allocatable :: table(:, :)
   contains
      procedure :: n_fields
      procedure :: n_numbers
      procedure :: n_needed
      procedure :: exists
      procedure :: take
   end type law_words_t

contains

   !> Numbers on a data line.
   pure integer function n_fields(self)
      class(law_words_t), intent(in) :: self

      n_fields = count(len_trim(self%fields%name) > 0 .and. .not. self%fields%is_parameter)
   end function n_fields

   !> These, and those of parameters.
   pure integer function n_numbers(self)
      class(law_words_t), intent(in) :: self

      n_numbers = count(len_trim(self%fields%name) > 0)
   end function n_numbers

   !> Those on a data line that must be given there where no parameter stands in their place; the others follow them.
   pure integer function n_needed(self)
      class(law_words_t), intent(in) :: self

      n_needed = self%n_fields() - count(self%fields%is_optional .and. .not. self%fields%is_parameter)
   end function n_needed

   !> .false. beyond the last law of a family.
   pure logical function exists(self)
      class(law_words_t), intent(in) :: self

      exists = len_trim(self%name) > 0
   end function exists

   !> Take over the data; numbers beyond those that the law has are not used.
   pure subroutine take(self, numbers)
      class(law_words_t), intent(inout) :: self
      !> Line after line (n)
      real(dp), intent(in) :: numbers(:)
      integer :: n

      n = self%n_fields()
      if (self%has_table) then
         self%table = reshape(numbers, [n, size(numbers)/n])
      else
         n = min(n, size(numbers))
         self%data(:n) = numbers(:n)
      end if
   end subroutine take

end module litz_law_words
