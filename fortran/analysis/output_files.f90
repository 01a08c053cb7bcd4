!> Text files and directories of the results. What cannot be written is an error in words, never a stop.
!>
!> Every procedure passes `error` through and does nothing more once it is allocated.
module litz_output_files
   use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
   use litz_errors, only: error_t, fail, exit_files
   implicit none
   private
   public :: text_file_t, make_directory, check_writable

   !> A text file that is written line by line.
   type :: text_file_t
      character(len=:), allocatable :: path
      integer, private :: unit = 0
      logical, private :: is_open = .false.
   contains
      procedure :: create => text_file_create
      procedure :: write_line => text_file_write_line
      procedure :: flush => text_file_flush
      procedure :: close => text_file_close
   end type text_file_t

   interface
      !> POSIX mkdir; Fortran has no procedure for it
      integer(c_int) function c_mkdir(path, mode) bind(c, name='mkdir')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), value :: mode
      end function c_mkdir
   end interface

contains

   !> Makes a directory and its parents where they do not exist yet.
   subroutine make_directory(path, error)
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error
      integer, parameter :: mode = int(o'777')
      integer :: i
      integer(c_int) :: status
      logical :: there

      if (allocated(error)) return
      ! a part that is there already makes mkdir fail, which is no error; what counts is the whole in the end
      do i = 2, len_trim(path)
         if (path(i:i) == '/') status = c_mkdir(path(:i - 1)//c_null_char, mode)
      end do
      status = c_mkdir(trim(path)//c_null_char, mode)
      inquire (file=trim(path)//'/.', exist=there)
      if (.not. there) then
         error = fail(exit_files, 'the output directory "'//trim(path)//'" does not exist and cannot be made: '// &
            'a file has that name, or you may not write there')
      end if
   end subroutine make_directory

   !> Reports a file that could not be written, and leaves it as it is.
   subroutine check_writable(path, error)
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error
      logical :: was_there
      integer :: unit, status
      character(len=256) :: reason

      if (allocated(error)) return
      inquire (file=path, exist=was_there)
      open (newunit=unit, file=path, status='unknown', action='readwrite', position='append', &
         iostat=status, iomsg=reason)
      if (status /= 0) then
         error = cannot_write(path, reason)
      else if (was_there) then
         close (unit)
      else
         close (unit, status='delete')
      end if
   end subroutine check_writable

   !> Begins the file anew; what it held is lost.
   subroutine text_file_create(self, path, error)
      class(text_file_t), intent(inout) :: self
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error
      integer :: status
      character(len=256) :: reason

      if (allocated(error)) return
      self%path = path
      open (newunit=self%unit, file=path, status='replace', action='write', iostat=status, iomsg=reason)
      self%is_open = status == 0
      if (status /= 0) error = cannot_write(path, reason)
   end subroutine text_file_create

   subroutine text_file_write_line(self, line, error)
      class(text_file_t), intent(in) :: self
      character(len=*), intent(in) :: line
      type(error_t), allocatable, intent(inout) :: error
      integer :: status
      character(len=256) :: reason

      if (allocated(error)) return
      write (self%unit, '(a)', iostat=status, iomsg=reason) line
      if (status /= 0) error = cannot_write(self%path, reason)
   end subroutine text_file_write_line

   !> Brings the lines written so far to the disk, for readers that look on, and in case the run is killed.
   subroutine text_file_flush(self, error)
      class(text_file_t), intent(in) :: self
      type(error_t), allocatable, intent(inout) :: error
      integer :: status
      character(len=256) :: reason

      if (allocated(error)) return
      flush (self%unit, iostat=status, iomsg=reason)
      if (status /= 0) error = cannot_write(self%path, reason)
   end subroutine text_file_flush

   !> Closes the file, also after an error.
   subroutine text_file_close(self, error)
      class(text_file_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error
      integer :: status
      character(len=256) :: reason

      if (.not. self%is_open) return
      close (self%unit, iostat=status, iomsg=reason)
      self%is_open = .false.
      if (status /= 0 .and. .not. allocated(error)) error = cannot_write(self%path, reason)
   end subroutine text_file_close

   pure function cannot_write(path, reason) result(error)
      character(len=*), intent(in) :: path, reason
      type(error_t) :: error

      error = fail(exit_files, 'cannot write "'//path//'": '//trim(reason))
   end function cannot_write

end module litz_output_files
