!> The labels of the units that a deck is in. litz computes with numbers of one consistent system and converts nothing;
!> labels stand in the heads of tables, in result files and in messages.
module litz_unit_labels
   implicit none
   private
   public :: unit_labels_t

   !> Longest label
   integer, parameter, public :: unit_length = 12

   type :: unit_labels_t
      character(len=unit_length) :: length = 'm', force = 'N', time = 's', current = 'A', voltage = 'V', &
         temperature = 'K'
   contains
      procedure :: label
      procedure :: in_header
   end type unit_labels_t

contains

   !> The label of a unit that is written in SI: `N m` is `mN mm` where the labels are mN and mm.
   pure function label(self, unit) result(text)
      class(unit_labels_t), intent(in) :: self
      !> Unit in SI, symbols joined by blanks, `/`, `^` and digits: `N m`, `A/mm^2`
      character(len=*), intent(in) :: unit
      character(len=:), allocatable :: text
      integer :: first, i

      text = ''
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

   !> The head of a table with the labels between its brackets. Blanks before a name give way to a longer label, so that
   !> columns keep their place.
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
         text = text//header(at:left)
         grown = len(new) - (right - left - 1)
         cell = index(text, '  ', back=.true.)
         if (cell > grown .and. grown > 0) then
            if (len_trim(text(cell - grown:cell)) == 0) text = text(:cell - grown)//text(cell + 1:)
         end if
         text = text//new//']'
         at = right + 1
      end do
      text = text//header(at:)
   end function in_header

end module litz_unit_labels
