!> The labels of the units that a deck is in. litz computes with numbers of one consistent system and converts nothing;
!> labels stand in the heads of tables, in result files and in messages. A deck that does not say what its units are has
!> none there.
module litz_unit_labels
   implicit none
   private
   public :: unit_labels_t

   !> Longest label
   integer, parameter, public :: unit_length = 12

   !> Blank: the deck does not name its units
   type :: unit_labels_t
      character(len=unit_length) :: length = '', force = '', time = '', current = '', voltage = '', temperature = ''
   contains
      procedure :: are_named
      procedure :: label
      procedure :: after
      procedure :: in_header
   end type unit_labels_t

   !> Those of a deck in SI, and of quantities that a deck with other labels does not name
   type(unit_labels_t), parameter, public :: si_labels = unit_labels_t('m', 'N', 's', 'A', 'V', 'K')
   !> Units of any system: of angles, and of numbers
   character(len=3), parameter :: always(3) = [character(len=3) :: 'rad', '1', '-']

contains

   pure logical function are_named(self)
      class(unit_labels_t), intent(in) :: self

      are_named = len_trim(self%length) > 0
   end function are_named

   !> What follows a number: a blank and its label, or nothing.
   pure function after(self, unit) result(text)
      class(unit_labels_t), intent(in) :: self
      !> Unit in SI
      character(len=*), intent(in) :: unit
      character(len=:), allocatable :: text

      text = self%label(unit)
      if (len(text) > 0) text = ' '//text
   end function after

   !> The label of a unit that is written in SI: `N m` is `mN mm` where the labels are mN and mm; empty without labels.
   pure function label(self, unit) result(text)
      class(unit_labels_t), intent(in) :: self
      !> Unit in SI, symbols joined by blanks, `/`, `^` and digits: `N m`, `A/mm^2`
      character(len=*), intent(in) :: unit
      character(len=:), allocatable :: text
      integer :: first, i

      text = ''
      if (any(unit == always)) text = trim(unit)
      if (len(text) > 0 .or. .not. self%are_named()) return
      first = 1
      do i = 1, len(unit) + 1
         if (i <= len(unit)) then
            if (is_letter(unit(i:i))) cycle
         end if
         text = text//symbol(self, unit(first:i - 1))
         if (i <= len(unit)) text = text//unit(i:i)
         first = i + 1
      end do
   end function label

   pure logical function is_letter(character)
      !> The character to be judged
      character(len=1), intent(in) :: character

      is_letter = (character >= 'a' .and. character <= 'z') .or. (character >= 'A' .and. character <= 'Z')
   end function is_letter

   !> The label of one symbol; of a derived one the product that it stands for, unless its factors are SI.
   pure function symbol(self, si) result(text)
      type(unit_labels_t), intent(in) :: self
      !> Symbol of one SI unit, or any other word, which stays as it is
      character(len=*), intent(in) :: si
      character(len=:), allocatable :: text
      logical :: mechanical, electrical

      mechanical = self%length == 'm' .and. self%force == 'N'
      electrical = self%current == 'A' .and. self%voltage == 'V'
      text = si
      select case (si)
      case ('m')
         text = trim(self%length)
      case ('N')
         text = trim(self%force)
      case ('s')
         text = trim(self%time)
      case ('A')
         text = trim(self%current)
      case ('V')
         text = trim(self%voltage)
      case ('K')
         text = trim(self%temperature)
      case ('Nm')
         text = trim(self%force)//trim(self%length)
      case ('J')
         if (.not. mechanical) text = trim(self%force)//' '//trim(self%length)
      case ('Pa')
         if (.not. mechanical) text = trim(self%force)//'/'//trim(self%length)//'^2'
      case ('S')
         if (.not. electrical) text = trim(self%current)//'/'//trim(self%voltage)
      case ('ohm')
         if (.not. electrical) text = trim(self%voltage)//'/'//trim(self%current)
      case ('W')
         if (.not. electrical) text = trim(self%voltage)//' '//trim(self%current)
      end select
   end function symbol

   !> The head of a table with the labels between its brackets, or without brackets where there is none. Blanks before a
   !> name give way to a longer label and fill up for a shorter one, so that columns keep their place.
   pure function in_header(self, header) result(text)
      class(unit_labels_t), intent(in) :: self
      !> Heads of columns, with units in SI between brackets
      character(len=*), intent(in) :: header
      character(len=:), allocatable :: text, new
      integer :: at, left, right, cell, grown

      text = ''
      at = 1
      do
         left = index(header(at:), '[') + at - 1
         if (left < at) exit
         right = index(header(left:), ']') + left - 1
         if (right < left) exit
         new = self%label(header(left + 1:right - 1))
         grown = -len(text)
         text = text//header(at:left - 1)
         if (len(new) > 0) then
            text = text//'['//new//']'
         else
            text = trim(text)
         end if
         grown = grown + len(text) - (right - at + 1)
         cell = index(text(:len(text) - len(new)), '  ', back=.true.)
         if (cell > 0 .and. grown < 0) text = text(:cell)//repeat(' ', -grown)//text(cell + 1:)
         if (cell > grown .and. grown > 0) then
            if (len_trim(text(cell - grown:cell)) == 0) text = text(:cell - grown)//text(cell + 1:)
         end if
         at = right + 1
      end do
      text = text//header(at:)
   end function in_header

end module litz_unit_labels
