!> The lock on the results of a run: two runs that would write the same files do not run at the same time.
!>
!> It is a file beside the results that is locked by the kernel, and so never left locked by a run that was killed.
module litz_result_lock
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
   use litz_errors, only: error_t, fail, exit_files
   use litz_output_files, only: unpublished
   implicit none
   private
   public :: lock_results, unlock_results

   integer(c_int), parameter :: lock_is_taken = 0, lock_is_held_by_another = 1, lock_file_fails = 2

   interface
      !> One of the constants above, or another: this file system has no locks
      integer(c_int) function c_take_lock(path, words, n) bind(c, name='litz_take_result_lock')
         import :: c_char, c_int
         implicit none
         !> Ends in a null character (n)
         character(kind=c_char), intent(in) :: path(*)
         !> Letters that `words` can take
         integer(c_int), value :: n
         !> Who holds the lock, or why there is none (n)
         character(kind=c_char), intent(out) :: words(n)
      end function c_take_lock

      subroutine c_release_lock() bind(c, name='litz_release_result_lock')
         implicit none
      end subroutine c_release_lock
   end interface

contains

   !> Locks the results, or says which process writes them.
   subroutine lock_results(base, warning, error)
      !> Directory and stem that the result files share
      character(len=*), intent(in) :: base
      !> Empty, or why the run goes on without a lock
      character(len=:), allocatable, intent(out) :: warning
      type(error_t), allocatable, intent(inout) :: error
      integer(c_int), parameter :: longest = 400
      character(kind=c_char) :: buffer(longest)
      character(len=longest) :: words
      integer(c_int) :: status
      integer :: i

      warning = ''
      if (allocated(error)) return
      buffer = c_null_char
      status = c_take_lock(base//'.lock'//unpublished//c_null_char, buffer, longest)
      words = ''
      do i = 1, findloc(buffer, c_null_char, 1) - 1
         words(i:i) = buffer(i)
      end do
      select case (status)
      case (lock_is_taken)
         return
      case (lock_is_held_by_another)
         error = fail(exit_files, 'another run is writing the results '//base//'.* ('//trim(words)//'); wait until'// &
            ' it has ended, or choose another directory with -o')
      case (lock_file_fails)
         error = fail(exit_files, 'cannot write "'//base//'.lock'//unpublished//'": '//trim(words))
      case default
         warning = 'warning: the results '//base//'.* cannot be locked here ('//trim(words)//'): do not run another'// &
            ' deck of this name into the same directory meanwhile'
      end select
   end subroutine lock_results

   !> Lets other runs write the results; the last thing a run does with them. Nothing happens when there is no lock.
   subroutine unlock_results()
      call c_release_lock()
   end subroutine unlock_results

end module litz_result_lock
