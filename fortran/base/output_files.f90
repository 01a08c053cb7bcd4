!> Text files and directories of the results. What cannot be written is an error in words, never a stop.
!>
!> Every procedure passes `error` through and does nothing more once it is allocated. The files are those of C, because
!> the library of gfortran does not tell when a disk is full: neither `write` nor `flush` nor `close` then has an error.
module litz_output_files
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_int, c_null_char, c_null_ptr, c_ptr
   use litz_errors, only: error_t, fail, exit_files
   implicit none
   private
   public :: text_file_t, make_directory, check_writable, same_file, remove_file, publish_file, unpublished

   !> A file has this ending until it holds something worth keeping: whatever happens before, an older file stays whole
   character(len=*), parameter :: unpublished = '.part'
   character(len=*), parameter :: refused = 'the operating system refused; is the disk full?'

   !> A text file that is written line by line, beside the one of its path until it is published.
   type :: text_file_t
      character(len=:), allocatable :: path
      logical, private :: is_published = .false.
      type(c_ptr), private :: file = c_null_ptr
   contains
      procedure :: create => text_file_create
      procedure :: write_line => text_file_write_line
      procedure :: flush => text_file_flush
      procedure :: publish => text_file_publish
      procedure :: close => text_file_close
   end type text_file_t

   interface
      !> POSIX mkdir; Fortran has no procedure for it
      integer(c_int) function c_mkdir(path, mode) bind(c, name='mkdir')
         import :: c_char, c_int
         implicit none
         !> Ended by a null character
         character(kind=c_char), intent(in) :: path(*)
         !> Permissions, from which the system takes those of its mask
         integer(c_int), value :: mode
      end function c_mkdir

      !> A null pointer when there is no such file
      type(c_ptr) function c_realpath(path, resolved) bind(c, name='realpath')
         import :: c_char, c_ptr
         implicit none
         !> Ended by a null character
         character(kind=c_char), intent(in) :: path(*)
         !> Path without symbolic links and dots (4097), ended by a null character
         character(kind=c_char), intent(out) :: resolved(*)
      end function c_realpath

      type(c_ptr) function c_fopen(path, mode) bind(c, name='fopen')
         import :: c_char, c_ptr
         implicit none
         !> Ended by a null character
         character(kind=c_char), intent(in) :: path(*)
         !> `w`, ended by a null character
         character(kind=c_char), intent(in) :: mode(*)
      end function c_fopen

      !> Negative when it fails
      integer(c_int) function c_fputs(text, file) bind(c, name='fputs')
         import :: c_char, c_int, c_ptr
         implicit none
         !> Ended by a null character
         character(kind=c_char), intent(in) :: text(*)
         type(c_ptr), value :: file
      end function c_fputs

      !> Not 0 when it fails
      integer(c_int) function c_fflush(file) bind(c, name='fflush')
         import :: c_int, c_ptr
         implicit none
         type(c_ptr), value :: file
      end function c_fflush

      !> Not 0 when it fails
      integer(c_int) function c_fclose(file) bind(c, name='fclose')
         import :: c_int, c_ptr
         implicit none
         type(c_ptr), value :: file
      end function c_fclose

      !> Not 0 when it fails
      integer(c_int) function c_rename(old, new) bind(c, name='rename')
         import :: c_char, c_int
         implicit none
         !> Both ended by a null character
         character(kind=c_char), intent(in) :: old(*), new(*)
      end function c_rename
   end interface

contains

   !> Makes a directory and its parents where they do not exist yet.
   subroutine make_directory(path, error)
      !> The directory; blanks at its end do not count
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
      !> The file as the user knows it
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error
      logical :: was_there
      integer :: unit, status
      character(len=:), allocatable :: tried
      character(len=256) :: reason

      if (allocated(error)) return
      inquire (file=path, exist=was_there)
      tried = path
      ! a run that is killed here must not leave an empty file in the place of a result
      if (.not. was_there) tried = path//unpublished
      open (newunit=unit, file=tried, status='unknown', action='readwrite', position='append', &
         iostat=status, iomsg=reason)
      if (status /= 0) then
         error = cannot_write(path, reason)
      else if (was_there) then
         close (unit)
      else
         close (unit, status='delete')
      end if
   end subroutine check_writable

   !> Removes a file of an earlier run, if there is one.
   subroutine remove_file(path, error)
      !> The file as the user knows it
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error
      logical :: there
      integer :: unit, status
      character(len=256) :: reason

      if (allocated(error)) return
      inquire (file=path, exist=there)
      if (.not. there) return
      open (newunit=unit, file=path, status='old', iostat=status, iomsg=reason)
      if (status == 0) close (unit, status='delete', iostat=status, iomsg=reason)
      if (status /= 0) error = cannot_write(path, reason)
   end subroutine remove_file

   !> Puts what was written for a path in the place of an older file, in one step.
   subroutine publish_file(path, place, error)
      !> The path that it was written for, and the one that it gets
      character(len=*), intent(in) :: path, place
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error)) return
      if (c_rename(path//unpublished//c_null_char, place//c_null_char) /= 0) then
         error = cannot_write(place, 'the operating system refused to rename "'//path//unpublished//'"')
      end if
   end subroutine publish_file

   !> Two paths lead to one file, which exists.
   logical function same_file(a, b)
      !> Two paths
      character(len=*), intent(in) :: a, b
      integer, parameter :: longest_path = 4096
      character(kind=c_char) :: real_a(longest_path + 1), real_b(longest_path + 1)

      real_a = c_null_char
      real_b = c_null_char
      same_file = c_associated(c_realpath(a//c_null_char, real_a))
      if (same_file) same_file = c_associated(c_realpath(b//c_null_char, real_b))
      if (same_file) same_file = all(real_a == real_b)
   end function same_file

   !> Begins the file anew; an older one stays until this one is published.
   subroutine text_file_create(self, path, error)
      class(text_file_t), intent(inout) :: self
      !> Where the file will be once it is published
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error)) return
      self%path = path
      self%is_published = .false.
      self%file = c_fopen(path//unpublished//c_null_char, 'w'//c_null_char)
      if (.not. c_associated(self%file)) error = cannot_write(path, refused)
   end subroutine text_file_create

   subroutine text_file_write_line(self, line, error)
      class(text_file_t), intent(in) :: self
      !> The line without its end
      character(len=*), intent(in) :: line
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error)) return
      if (c_fputs(line//new_line('a')//c_null_char, self%file) < 0) error = cannot_write(self%path, refused)
   end subroutine text_file_write_line

   !> Brings the lines written so far to the disk, for readers that look on, and in case the run is killed.
   subroutine text_file_flush(self, error)
      class(text_file_t), intent(in) :: self
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error)) return
      if (c_fflush(self%file) /= 0) error = cannot_write(self%path, refused)
   end subroutine text_file_flush

   !> Gives the file its name, in the place of an older one. It stays open.
   subroutine text_file_publish(self, error, place)
      class(text_file_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error
      !> Another path than the one it was created with
      character(len=*), intent(in), optional :: place
      character(len=:), allocatable :: path

      if (allocated(error)) return
      path = self%path
      if (present(place)) self%path = place
      call publish_file(path, self%path, error)
      self%is_published = .not. allocated(error)
   end subroutine text_file_publish

   !> Closes the file, also after an error; one that was not published is removed.
   subroutine text_file_close(self, error)
      class(text_file_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error
      type(error_t), allocatable :: ignored
      integer(c_int) :: status

      if (.not. c_associated(self%file)) return
      status = c_fclose(self%file)
      self%file = c_null_ptr
      if (.not. self%is_published) then
         call remove_file(self%path//unpublished, ignored)
      else if (status /= 0 .and. .not. allocated(error)) then
         error = cannot_write(self%path, refused)
      end if
   end subroutine text_file_close

   pure function cannot_write(path, reason) result(error)
      !> The file as the user knows it
      character(len=*), intent(in) :: path
      !> Why, as the system says it; blanks at its end do not count
      character(len=*), intent(in) :: reason
      type(error_t) :: error

      error = fail(exit_files, 'cannot write "'//path//'": '//trim(reason))
   end function cannot_write

end module litz_output_files
