!> The table of the contact-spot laws. A new one is a file beside this one, and a line in `spot_law_of_number`.
module litz_spot_laws
   use litz_kinds, only: dp
   use litz_law_words, only: law_words_t
   use litz_spot_law, only: spot_law_t
   use litz_spot_paper, only: spot_paper
   use litz_spot_hertz, only: spot_hertz
   use litz_spot_plastic, only: spot_plastic
   use litz_spot_film, only: spot_film
   use litz_spot_constant, only: spot_constant
   use litz_spot_table, only: spot_table
   use litz_spot_sharvin, only: spot_sharvin
   use litz_spot_cluster, only: spot_cluster
   implicit none
   private
   public :: spot_law, all_spot_laws

   interface spot_law
      procedure :: spot_law_of_number, spot_law_of_name
   end interface spot_law

contains

   !> The law of this number with its data; without a name and procedures where there is none.
   pure function spot_law_of_number(number, data) result(law)
      !> Place in the table
      integer, intent(in) :: number
      !> Its numbers, line after line (n); absent: it has none
      real(dp), intent(in), optional :: data(:)
      type(spot_law_t) :: law

      select case (number)
      case (1); law = spot_paper()
      case (2); law = spot_hertz()
      case (3); law = spot_plastic()
      case (4); law = spot_film()
      case (5); law = spot_constant()
      case (6); law = spot_table()
      case (7); law = spot_sharvin()
      case (8); law = spot_cluster()
      end select
      law%number = number
      if (present(data)) call law%take(data)
   end function spot_law_of_number

   !> The law of this name with its data; without a name and procedures where there is none.
   pure function spot_law_of_name(name, data) result(law)
      !> In capitals
      character(len=*), intent(in) :: name
      !> Its numbers, line after line (n); absent: it has none
      real(dp), intent(in), optional :: data(:)
      type(spot_law_t) :: law
      type(law_words_t), allocatable :: laws(:)
      integer :: number

      allocate (laws, source=all_spot_laws())
      do number = 1, size(laws)
         if (laws(number)%name == name) law = spot_law(number, data)
      end do
   end function spot_law_of_name

   !> What decks, their reference and Python know of all laws, each at the place of its number.
   pure function all_spot_laws() result(laws)
      type(law_words_t), allocatable :: laws(:)
      type(spot_law_t) :: law
      integer :: i, n

      n = 0
      law = spot_law(1)
      do while (law%exists())
         n = n + 1
         law = spot_law(n + 1)
      end do
      allocate (laws(n))
      do i = 1, n
         law = spot_law(i)
         laws(i) = law%law_words_t
      end do
   end function all_spot_laws

end module litz_spot_laws
