!> Whether a path leads to a file that can be read: pipes, directories and devices are refused with a reason.
!>
!> A pipe that nobody writes to would be waited for without end; and the results take their names, included files their
!> place, from that of the deck.
module litz_path_kind
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
   implicit none
   private
   public :: why_not_read

   integer(c_int), parameter :: kind_directory = 2, kind_pipe = 3, kind_other = 4

   interface
      !> One of the kinds above, or less: a regular file, or nothing
      integer(c_int) function c_path_kind(path) bind(c, name='litz_kind_of_path')
         import :: c_char, c_int
         implicit none
         !> Ended by a null character
         character(kind=c_char), intent(in) :: path(*)
      end function c_path_kind
   end interface

contains

   !> Why what is there is not read, as the end of a sentence; empty for a regular file, and where there is nothing.
   function why_not_read(path) result(reason)
      !> Any path; blanks at its end do not count
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: reason
      character(len=*), parameter :: advice = ', not a regular file; write its content to a file and name that'

      select case (c_path_kind(trim(path)//c_null_char))
      case (kind_directory)
         reason = 'it is a directory'
      case (kind_pipe)
         reason = 'it is a pipe'//advice
      case (kind_other)
         reason = 'it is a device or a socket'//advice
      case default
         reason = ''
      end select
   end function why_not_read

end module litz_path_kind
