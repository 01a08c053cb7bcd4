!> The types of beam elements: a row each, whose place is the type in the model.
!>
!> The values of *ELEMENT, TYPE=, mesh files and the summary of a model follow the rows; which kernel belongs to a type
!> says litz_element_library.
module litz_element_types
   use litz_text, only: join_words
   implicit none
   private
   public :: element_type_t, element_types, element_b31, element_b33
   public :: element_type_named, element_type_choices, describe_element_types, list_element_types
   public :: foreign_type_t, foreign_types, foreign_type_named

   type :: element_type_t
      !> In decks and mesh files, in capitals
      character(len=8) :: name
      !> For the user, after the name
      character(len=60) :: meaning
      !> The centre line may be turned against the normals of the sections
      logical :: shear_flexible
   end type element_type_t

   type(element_type_t), parameter :: element_types(*) = [ &
      element_type_t('B31', 'geometrically exact, shear flexible', .true.), &
      element_type_t('B33', 'Euler-Bernoulli, cubic, corotational', .false.)]
   integer, parameter :: element_b31 = 1, element_b33 = 2

   !> A beam of Abaqus or CalculiX that becomes one or two elements of litz.
   type :: foreign_type_t
      !> In decks, in capitals
      character(len=8) :: name
      !> Type of these elements
      integer :: element_type
      !> It has a node in the middle, which joins two elements
      logical :: has_middle
   end type foreign_type_t

   type(foreign_type_t), parameter :: foreign_types(*) = [ &
      foreign_type_t('B31R', element_b31, .false.), foreign_type_t('B31H', element_b31, .false.), &
      foreign_type_t('B33H', element_b33, .false.), foreign_type_t('B32', element_b31, .true.), &
      foreign_type_t('B32R', element_b31, .true.), foreign_type_t('B32H', element_b31, .true.)]

contains

   !> Foreign type of this name; one without a name: there is none.
   pure type(foreign_type_t) function foreign_type_named(name) result(found)
      !> In capitals
      character(len=*), intent(in) :: name
      integer :: i

      found = foreign_type_t('', 0, .false.)
      do i = 1, size(foreign_types)
         if (foreign_types(i)%name == name) found = foreign_types(i)
      end do
   end function foreign_type_named

   !> Type of this name; 0: there is none.
   pure integer function element_type_named(name) result(element_type)
      !> In capitals
      character(len=*), intent(in) :: name

      do element_type = size(element_types), 1, -1
         if (element_types(element_type)%name == name) return
      end do
   end function element_type_named

   !> All names that decks may have, separated by bars: `B31|B33|B31R|...`.
   pure function element_type_choices() result(names)
      character(len=:), allocatable :: names
      integer :: i

      names = trim(element_types(1)%name)
      do i = 2, size(element_types)
         names = names//'|'//trim(element_types(i)%name)
      end do
      do i = 1, size(foreign_types)
         names = names//'|'//trim(foreign_types(i)%name)
      end do
   end function element_type_choices

   !> The names in words: `B31 and B33`.
   pure function list_element_types() result(text)
      character(len=:), allocatable :: text

      text = join_words(element_types%name, 'and')
   end function list_element_types

   !> A sentence for each type.
   pure function describe_element_types() result(text)
      character(len=:), allocatable :: text
      integer :: i

      text = ''
      do i = 1, size(element_types)
         text = text//' '//trim(element_types(i)%name)//': '//trim(element_types(i)%meaning)//'.'
      end do
   end function describe_element_types

end module litz_element_types
