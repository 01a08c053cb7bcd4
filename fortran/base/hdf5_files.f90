!> HDF5 files and their groups: begun beside an older file, brought to the disk, put in its place.
!>
!> Every procedure passes `error` through and does nothing once it is allocated, so that a sequence of calls needs
!> one check at its end.
module litz_hdf5_files
   use, intrinsic :: iso_c_binding, only: c_char, c_f_pointer, c_int, c_int64_t, c_null_char, c_ptr
   use hdf5, only: hid_t, hsize_t, size_t, h5fcreate_f, h5fflush_f, h5fclose_f, h5fget_name_f, h5fget_filesize_f, &
      h5gcreate_f, h5pcreate_f, h5pclose_f, h5pset_fclose_degree_f, h5pset_istore_k_f, H5F_ACC_TRUNC_F, &
      H5F_SCOPE_GLOBAL_F, H5F_CLOSE_STRONG_F, H5P_DEFAULT_F, H5P_FILE_ACCESS_F, H5P_FILE_CREATE_F
   use litz_errors, only: error_t, fail, exit_files
   use litz_hdf5_library, only: hdf5_start
   use litz_output_files, only: publish_file, unpublished
   implicit none
   private
   public :: hid_t, hdf5_start, hdf5_create_file, hdf5_create_group, hdf5_flush, hdf5_publish_file, hdf5_close_file, &
      hdf5_discard_file, file_name, cannot_write

   interface
      !> Address of the descriptor of an open file
      integer(c_int) function c_get_handle(file, access, handle) bind(c, name='H5Fget_vfd_handle')
         import :: c_int, c_int64_t, c_ptr
         implicit none
         !> Identifier of the open file
         integer(c_int64_t), value :: file
         !> Identifier of a list of access properties
         integer(c_int64_t), value :: access
         type(c_ptr), intent(out) :: handle
      end function c_get_handle

      !> Not 0 when it fails
      integer(c_int) function c_ftruncate(descriptor, length) bind(c, name='ftruncate')
         import :: c_int, c_int64_t
         implicit none
         !> Descriptor of the open file
         integer(c_int), value :: descriptor
         !> Size that the file gets [bytes]
         integer(c_int64_t), value :: length
      end function c_ftruncate

      integer(c_int) function c_unlink(path) bind(c, name='unlink')
         import :: c_char, c_int
         implicit none
         !> Ended by a null character
         character(kind=c_char), intent(in) :: path(*)
      end function c_unlink
   end interface

contains

   !> Begins a file anew, beside the one of that path until `hdf5_publish_file` puts it there.
   subroutine hdf5_create_file(path, expected_chunks, file, error)
      !> Where the file will be once it is published
      character(len=*), intent(in) :: path
      !> Number of chunks that its largest dataset may come to have
      integer, intent(in) :: expected_chunks
      !> Identifier of the open file; -1 after an error
      integer(hid_t), intent(out) :: file
      type(error_t), allocatable, intent(inout) :: error
      !> Half the places in a node of the index of chunks: HDF5's default, and what costs a megabyte in some 30 datasets
      integer, parameter :: fewest = 32, most = 512
      integer(hid_t) :: access, creation
      integer :: status, ignored

      file = -1
      if (allocated(error)) return
      call h5pcreate_f(H5P_FILE_ACCESS_F, access, status)
      ! closing the file closes its groups and datasets
      if (status == 0) call h5pset_fclose_degree_f(access, H5F_CLOSE_STRONG_F, status)
      call h5pcreate_f(H5P_FILE_CREATE_F, creation, ignored)
      ! an index that need not split: between the writes of a split nothing of the file could be read
      if (status == 0) call h5pset_istore_k_f(creation, min(most, max(fewest, expected_chunks/2 + 1)), status)
      if (status == 0) call h5fcreate_f(path//unpublished, H5F_ACC_TRUNC_F, file, status, creation, access)
      if (status /= 0) error = cannot_write(path, 'it cannot be created')
      call h5pclose_f(access, ignored)
      call h5pclose_f(creation, ignored)
   end subroutine hdf5_create_file

   subroutine hdf5_create_group(parent, name, group, error)
      !> Identifier of the file or group that it is made in
      integer(hid_t), intent(in) :: parent
      !> Name within the parent
      character(len=*), intent(in) :: name
      !> Identifier of the open group; -1 after an error
      integer(hid_t), intent(out) :: group
      type(error_t), allocatable, intent(inout) :: error
      integer :: status

      group = -1
      if (allocated(error)) return
      call h5gcreate_f(parent, name, group, status)
      if (status /= 0) error = cannot_write(file_name(parent), 'error at the group "'//name//'"')
   end subroutine hdf5_create_group

   !> Brings everything written so far to the disk.
   subroutine hdf5_flush(file, error)
      !> Identifier of the open file
      integer(hid_t), intent(in) :: file
      type(error_t), allocatable, intent(inout) :: error
      integer :: status

      if (allocated(error)) return
      call extend_file(file, status)
      if (status == 0) call h5fflush_f(file, H5F_SCOPE_GLOBAL_F, status)
      if (status /= 0) error = cannot_write(file_name(file), 'the data do not reach the disk')
   end subroutine hdf5_flush

   !> Gives the file the size that HDF5 is about to note in it. HDF5 itself does that last, and a file that is shorter
   !> than it says cannot be opened.
   subroutine extend_file(file, status)
      !> Identifier of the open file
      integer(hid_t), intent(in) :: file
      !> Not 0: the system refuses
      integer, intent(out) :: status
      type(c_ptr) :: handle
      integer(c_int), pointer :: descriptor
      integer(hsize_t) :: bytes

      call h5fget_filesize_f(file, bytes, status)
      if (status == 0) status = c_get_handle(int(file, c_int64_t), int(H5P_DEFAULT_F, c_int64_t), handle)
      if (status /= 0) return
      call c_f_pointer(handle, descriptor)
      status = c_ftruncate(descriptor, int(bytes, c_int64_t))
   end subroutine extend_file

   !> Puts a file that was created in the place of an older one.
   subroutine hdf5_publish_file(file, error)
      !> Identifier of the open file
      integer(hid_t), intent(in) :: file
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: path

      if (allocated(error)) return
      path = file_name(file)
      call publish_file(path, path, error)
   end subroutine hdf5_publish_file

   !> Closes a file that was not published, and removes it.
   subroutine hdf5_discard_file(file)
      !> In: identifier, or -1 for a file that is not open. Out: -1
      integer(hid_t), intent(inout) :: file
      character(len=:), allocatable :: path
      integer(c_int) :: status

      if (file < 0) return
      path = file_name(file)
      call h5fclose_f(file, status)
      file = -1
      status = c_unlink(path//unpublished//c_null_char)
   end subroutine hdf5_discard_file

   !> Closes the file, also after an error. Where something could not be written it is left as it is, like one of a run
   !> that was killed: on closing, HDF5 would note a size that the file has not got, and nobody could open it any more.
   subroutine hdf5_close_file(file, error)
      !> In: identifier, or -1 for a file that is not open. Out: -1
      integer(hid_t), intent(inout) :: file
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: path
      integer :: status

      if (file < 0) return
      if (allocated(error)) then
         if (error%code == exit_files) then
            file = -1
            return
         end if
      end if
      path = file_name(file)
      call h5fclose_f(file, status)
      file = -1
      if (status /= 0 .and. .not. allocated(error)) then
         error = cannot_write(path, 'it cannot be closed properly')
      end if
   end subroutine hdf5_close_file

   !> Path of the file that an object is in, as the user knows it.
   function file_name(object) result(name)
      !> Identifier of a file, or of a group or dataset in it
      integer(hid_t), intent(in) :: object
      character(len=:), allocatable :: name
      character(len=4096) :: buffer
      integer(size_t) :: length
      integer :: status

      buffer = ''
      call h5fget_name_f(object, buffer, length, status)
      name = trim(buffer)
      if (len(name) <= len(unpublished)) return
      if (name(len(name) - len(unpublished) + 1:) == unpublished) name = name(:len(name) - len(unpublished))
   end function file_name

   pure function cannot_write(path, what) result(error)
      !> The file as the user knows it
      character(len=*), intent(in) :: path
      !> What failed, as a clause
      character(len=*), intent(in) :: what
      type(error_t) :: error

      error = fail(exit_files, 'cannot write "'//path//'": HDF5 says that '//what//'; is the disk full?')
   end function cannot_write

end module litz_hdf5_files
