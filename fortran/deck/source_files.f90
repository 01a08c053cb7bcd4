!> Files as the reader of decks sees them: whole texts, and paths that show whether two files are the same.
module litz_source_files
   use, intrinsic :: iso_c_binding, only: c_char, c_ptr, c_null_char, c_null_ptr, c_associated, c_size_t, c_f_pointer
   use litz_kinds, only: int64
   use litz_errors, only: error_t, fail, exit_files
   use litz_path_kind, only: why_not_read
   use litz_text, only: shown
   implicit none
   private
   public :: read_file, real_path, relative_to

   interface
      function c_realpath(path, resolved) bind(c, name='realpath') result(pointer)
         import :: c_char, c_ptr
         implicit none
         !> Ended by a null character
         character(kind=c_char), intent(in) :: path(*)
         type(c_ptr), value :: resolved
         type(c_ptr) :: pointer
      end function c_realpath
      pure integer(c_size_t) function c_strlen(string) bind(c, name='strlen')
         import :: c_ptr, c_size_t
         implicit none
         type(c_ptr), value, intent(in) :: string
      end function c_strlen
      subroutine c_free(pointer) bind(c, name='free')
         import :: c_ptr
         implicit none
         type(c_ptr), value :: pointer
      end subroutine c_free
   end interface

contains

   subroutine read_file(path, largest, text, error)
      !> The file, as messages name it
      character(len=*), intent(in) :: path
      !> Most bytes that may be read
      integer(int64), intent(in) :: largest
      !> All bytes of the file; not to be used after an error
      character(len=:), allocatable, intent(out) :: text
      type(error_t), allocatable, intent(out) :: error
      character(len=200) :: reason
      character(len=:), allocatable :: irregular
      integer(int64) :: length
      integer :: unit, iostat
      logical :: exists, longer_exists

      inquire (file=path, exist=exists)
      if (.not. exists) then
         inquire (file=path//'.inp', exist=longer_exists)
         if (longer_exists) then
            error = fail(exit_files, 'file '//shown(path)//' does not exist; did you mean '//shown(path//'.inp')//'?')
         else
            error = fail(exit_files, 'file '//shown(path)//' does not exist')
         end if
         return
      end if
      irregular = why_not_read(path)
      if (len(irregular) > 0) then
         error = fail(exit_files, 'file '//shown(path)//' cannot be read: '//irregular)
         return
      end if
      reason = 'it is not a readable file'
      open (newunit=unit, file=path, access='stream', form='unformatted', status='old', action='read', &
         iostat=iostat, iomsg=reason)
      if (iostat == 0) then
         inquire (unit=unit, size=length)
         if (length > largest) then
            reason = 'decks of more than 2 GB are not supported'
            iostat = 1
         else if (length < 0) then
            iostat = 1
         else
            allocate (character(len=int(length)) :: text)
            if (length > 0) read (unit, iostat=iostat, iomsg=reason) text
         end if
         close (unit)
      end if
      if (iostat /= 0) error = fail(exit_files, 'file '//shown(path)//' cannot be read: '//trim(reason))
   end subroutine read_file

   !> The path without symbolic links and dots, or as it is where the system does not know.
   function real_path(path) result(resolved)
      !> Any path, of a file that exists
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: resolved
      type(c_ptr) :: pointer
      character(kind=c_char), pointer :: characters(:)
      integer :: i

      resolved = path
      pointer = c_realpath(path//c_null_char, c_null_ptr)
      if (.not. c_associated(pointer)) return
      call c_f_pointer(pointer, characters, [c_strlen(pointer)])
      resolved = repeat(' ', size(characters))
      do i = 1, size(characters)
         resolved(i:i) = characters(i)
      end do
      call c_free(pointer)
   end function real_path

   !> A path relative to the directory of the file that names it.
   pure function relative_to(file, path) result(full)
      !> Path of the file that names the other
      character(len=*), intent(in) :: file
      !> As it stands there; absolute paths stay as they are
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: full

      full = path
      if (path(1:1) /= '/') full = file(:index(file, '/', back=.true.))//path
   end function relative_to

end module litz_source_files
