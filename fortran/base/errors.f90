!> Errors as values: what went wrong, where it stands in the user's deck, and the exit code it leads to.
!>
!> Nothing below the main program prints or stops. A procedure that can fail passes back an `error_t`, or adds
!> to an `error_list_t` where reading on shows the user all errors of one pass.
module litz_errors
   implicit none
   private
   public :: error_t, error_list_t, fail
   public :: exit_success, exit_input, exit_not_converged, exit_solver, exit_files, exit_internal

   integer, parameter :: exit_success = 0
   integer, parameter :: exit_input = 1
   integer, parameter :: exit_not_converged = 2
   integer, parameter :: exit_solver = 3
   integer, parameter :: exit_files = 4
   integer, parameter :: exit_internal = 5

   type :: error_t
      !> One of the exit codes above
      integer :: code = exit_input
      !> What was found and what is allowed
      character(len=:), allocatable :: message
      !> Deck file; not allocated when the error has no place in a deck
      character(len=:), allocatable :: file
      !> The offending line as it stands in the file
      character(len=:), allocatable :: card
      integer :: line = 0
      !> First column and number of columns that the caret marks
      integer :: column = 0
      integer :: width = 1
   contains
      procedure :: text => error_text
   end type error_t

   type :: error_list_t
      integer :: count = 0
      type(error_t), allocatable :: items(:)
   contains
      procedure :: add => error_list_add
      procedure :: text => error_list_text
   end type error_list_t

contains

   !> An error without a place in a deck.
   pure function fail(code, message) result(error)
      integer, intent(in) :: code
      character(len=*), intent(in) :: message
      type(error_t) :: error

      error%code = code
      error%message = message
   end function fail

   pure subroutine error_list_add(self, error)
      class(error_list_t), intent(inout) :: self
      type(error_t), intent(in) :: error
      type(error_t), allocatable :: grown(:)

      if (.not. allocated(self%items)) allocate (self%items(8))
      if (self%count == size(self%items)) then
         allocate (grown(2*self%count))
         grown(:self%count) = self%items
         call move_alloc(grown, self%items)
      end if
      self%count = self%count + 1
      self%items(self%count) = error
   end subroutine error_list_add

   !> The message as the user sees it: the text, `file:line:column`, the line itself and a caret below.
   pure function error_text(self) result(text)
      class(error_t), intent(in) :: self
      character(len=:), allocatable :: text
      character(len=12) :: number, margin
      character(len=1), parameter :: nl = new_line('a')
      integer :: digits

      text = 'error: '//self%message//nl
      if (.not. allocated(self%file)) return
      write (number, '(i0)') self%line
      digits = len_trim(number)
      margin = ' '
      text = text//margin(:digits)//'--> '//self%file//':'//trim(number)
      if (self%column > 0) then
         write (number, '(i0)') self%column
         text = text//':'//trim(number)
      end if
      text = text//nl
      if (.not. allocated(self%card)) return
      write (number, '(i0)') self%line
      text = text//margin(:digits)//' |'//nl//trim(number)//' | '//self%card//nl
      if (self%column > 0) then
         text = text//margin(:digits)//' | '//repeat(' ', self%column - 1)//repeat('^', max(1, self%width))//nl
      end if
   end function error_text

   pure function error_list_text(self) result(text)
      class(error_list_t), intent(in) :: self
      character(len=:), allocatable :: text
      integer :: i

      text = ''
      do i = 1, self%count
         text = text//self%items(i)%text()
      end do
   end function error_list_text

end module litz_errors
