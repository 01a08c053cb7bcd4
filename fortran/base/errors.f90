!> Errors as values: what went wrong, where it stands in the user's deck, and the exit code it leads to.
!>
!> Nothing below the main program prints or stops. A procedure that can fail passes back an `error_t`, or adds
!> to an `error_list_t` where reading on shows the user all errors of one pass.
module litz_errors
   implicit none
   private
   public :: error_t, error_list_t, fail
   public :: exit_success, exit_input, exit_not_converged, exit_solver, exit_files, exit_internal, exit_memory

   !> Most errors that a list keeps, and most that it shows
   integer, parameter :: max_kept = 200, max_shown = 50

   integer, parameter :: exit_success = 0
   integer, parameter :: exit_input = 1
   integer, parameter :: exit_not_converged = 2
   integer, parameter :: exit_solver = 3
   integer, parameter :: exit_files = 4
   integer, parameter :: exit_internal = 5
   integer, parameter :: exit_memory = 6

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
      !> Where the caret goes in `card` when that is only a part of a long line; 0: at `column`
      integer :: caret = 0
      !> How the file came to be read: a line `included from file:line` per level, or empty
      character(len=:), allocatable :: origin
      !> Worth a look, but no reason to stop
      logical :: is_warning = .false.
      !> Code word of a warning, and the user's number of the element that it is about (0: none)
      character(len=32) :: kind = ''
      integer :: element = 0
      !> Place in the order of reading, by which a list of errors is sorted
      integer :: order = 0
   contains
      procedure :: text => error_text
   end type error_t

   !> Errors beyond the first 200 are counted only, so that a hopeless file costs neither memory nor time.
   type :: error_list_t
      integer :: count = 0
      integer :: not_kept = 0
      type(error_t), allocatable :: items(:)
   contains
      procedure :: add => error_list_add
      procedure :: is_full => error_list_is_full
      procedure :: skip => error_list_skip
      procedure :: sort => error_list_sort
      procedure :: text => error_list_text
   end type error_list_t

contains

   !> An error without a place in a deck.
   pure function fail(code, message) result(error)
      !> The exit code that the error leads to, one of `exit_...`
      integer, intent(in) :: code
      !> What was found and what is allowed, as a sentence without a full stop
      character(len=*), intent(in) :: message
      type(error_t) :: error

      error%code = code
      error%message = message
   end function fail

   pure subroutine error_list_add(self, error)
      class(error_list_t), intent(inout) :: self
      type(error_t), intent(in) :: error
      type(error_t), allocatable :: grown(:)

      if (is_told(self, error)) return
      if (self%is_full()) then
         call self%skip()
         return
      end if
      if (.not. allocated(self%items)) allocate (self%items(8))
      if (self%count == size(self%items)) then
         allocate (grown(2*self%count))
         grown(:self%count) = self%items
         call move_alloc(grown, self%items)
      end if
      self%count = self%count + 1
      self%items(self%count) = error
   end subroutine error_list_add

   !> The same has been said of the same place: lines of a part are read once for each of its instances.
   pure logical function is_told(self, error)
      type(error_list_t), intent(in) :: self
      type(error_t), intent(in) :: error
      integer :: i

      is_told = .false.
      if (.not. allocated(error%file)) return
      do i = 1, self%count
         associate (item => self%items(i))
            if (item%line /= error%line .or. item%column /= error%column .or. item%message /= error%message) cycle
            if (.not. allocated(item%file)) cycle
            is_told = item%file == error%file
            if (is_told) return
         end associate
      end do
   end function is_told

   pure logical function error_list_is_full(self)
      class(error_list_t), intent(in) :: self

      error_list_is_full = self%count == max_kept
   end function error_list_is_full

   !> Count an error that a full list would not keep.
   pure subroutine error_list_skip(self)
      class(error_list_t), intent(inout) :: self

      self%not_kept = self%not_kept + 1
   end subroutine error_list_skip

   !> In the order of reading; errors of the same line stay as they were found.
   pure subroutine error_list_sort(self)
      class(error_list_t), intent(inout) :: self
      type(error_t) :: item
      integer :: i, j

      do i = 2, self%count
         item = self%items(i)
         do j = i - 1, 1, -1
            if (self%items(j)%order <= item%order) exit
            self%items(j + 1) = self%items(j)
         end do
         self%items(j + 1) = item
      end do
   end subroutine error_list_sort

   !> The message as the user sees it: the text, `file:line:column`, the line itself and a caret below.
   pure function error_text(self) result(text)
      class(error_t), intent(in) :: self
      character(len=:), allocatable :: text
      character(len=12) :: number, margin
      character(len=1), parameter :: nl = new_line('a')
      integer :: digits, caret

      text = trim(merge('warning', 'error  ', self%is_warning))//': '//self%message//nl
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
      if (allocated(self%origin)) text = text//self%origin
      if (.not. allocated(self%card)) return
      write (number, '(i0)') self%line
      text = text//margin(:digits)//' |'//nl//trim(number)//' | '//self%card//nl
      if (self%column > 0) then
         caret = merge(self%caret, self%column, self%caret > 0)
         text = text//margin(:digits)//' | '//repeat(' ', caret - 1)//repeat('^', max(1, self%width))//nl
      end if
   end function error_text

   pure function error_list_text(self) result(text)
      class(error_list_t), intent(in) :: self
      character(len=:), allocatable :: text
      character(len=12) :: number
      integer :: i, not_shown

      text = ''
      do i = 1, min(self%count, max_shown)
         text = text//self%items(i)%text()
      end do
      not_shown = self%count - min(self%count, max_shown) + self%not_kept
      if (not_shown > 0) then
         write (number, '(i0)') not_shown
         text = text//'and '//trim(number)//' more errors'//new_line('a')
      end if
   end function error_list_text

end module litz_errors
