!> The table of the normal laws. A new one is a file beside this one, and a line in `normal_law_of_number`.
module litz_normal_laws
   use litz_kinds, only: dp
   use litz_law_words, only: law_words_t
   use litz_normal_law, only: normal_law_t
   use litz_normal_linear, only: normal_linear
   use litz_normal_hertz, only: normal_hertz
   implicit none
   private
   public :: normal_law, all_normal_laws, default_normal_law

   !> The law of a surface interaction that names none
   character(len=*), parameter :: default_normal_law = 'HERTZ'

   interface normal_law
      procedure :: normal_law_of_number, normal_law_of_name
   end interface normal_law

contains

   !> The law of this number with its data; without a name and procedures where there is none.
   pure function normal_law_of_number(number, data) result(law)
      !> Place in the table
      integer, intent(in) :: number
      !> Its numbers, line after line (n); absent: it has none
      real(dp), intent(in), optional :: data(:)
      type(normal_law_t) :: law

      select case (number)
      case (1); law = normal_linear()
      case (2); law = normal_hertz()
      end select
      law%number = number
      if (present(data)) call law%take(data)
   end function normal_law_of_number

   !> The law of this name with its data; without a name and procedures where there is none.
   pure function normal_law_of_name(name, data) result(law)
      !> In capitals
      character(len=*), intent(in) :: name
      !> Its numbers, line after line (n); absent: it has none
      real(dp), intent(in), optional :: data(:)
      type(normal_law_t) :: law
      type(law_words_t), allocatable :: laws(:)
      integer :: number

      allocate (laws, source=all_normal_laws())
      do number = 1, size(laws)
         if (laws(number)%name == name) law = normal_law(number, data)
      end do
   end function normal_law_of_name

   !> What decks, their reference and Python know of all laws, each at the place of its number.
   pure function all_normal_laws() result(laws)
      type(law_words_t), allocatable :: laws(:)
      type(normal_law_t) :: law
      integer :: i, n

      n = 0
      law = normal_law(1)
      do while (law%exists())
         n = n + 1
         law = normal_law(n + 1)
      end do
      allocate (laws(n))
      do i = 1, n
         law = normal_law(i)
         laws(i) = law%law_words_t
      end do
   end function all_normal_laws

end module litz_normal_laws
