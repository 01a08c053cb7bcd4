!> The few things litz asks of HDF5, each in one call: files, groups, attributes, and datasets that grow by rows.
!>
!> Every procedure passes `error` through and does nothing once it is allocated, so that a sequence of calls needs
!> one check at its end.
module litz_hdf5_helpers
   use, intrinsic :: iso_c_binding, only: c_char, c_f_pointer, c_int, c_int64_t, c_loc, c_null_char, c_ptr
   use hdf5, only: hid_t, hsize_t, size_t, h5fcreate_f, h5fflush_f, h5fclose_f, h5fget_name_f, &
      h5fget_filesize_f, h5gcreate_f, h5pcreate_f, h5pclose_f, h5pset_chunk_f, h5pset_alloc_time_f, &
      h5pset_fill_time_f, h5pset_fclose_degree_f, h5pset_istore_k_f, h5screate_f, h5screate_simple_f, &
      h5sclose_f, h5sselect_hyperslab_f, h5acreate_f, h5aopen_f, h5awrite_f, h5aclose_f, h5aexists_f, &
      h5dcreate_f, h5dwrite_f, h5dclose_f, h5dset_extent_f, h5dget_space_f, h5tcopy_f, h5tclose_f, &
      h5tset_size_f, h5tset_strpad_f, h5tset_cset_f, h5kind_to_type, H5F_ACC_TRUNC_F, H5F_SCOPE_GLOBAL_F, &
      H5F_CLOSE_STRONG_F, H5P_DEFAULT_F, H5P_FILE_ACCESS_F, H5P_FILE_CREATE_F, H5P_DATASET_CREATE_F, &
      H5D_ALLOC_TIME_EARLY_F, H5D_FILL_TIME_NEVER_F, H5S_SCALAR_F, H5S_SELECT_SET_F, H5S_UNLIMITED_F, &
      H5_INTEGER_KIND, H5T_NATIVE_CHARACTER, H5T_STR_NULLPAD_F, H5T_CSET_UTF8_F, H5T_NATIVE_DOUBLE, &
      H5T_IEEE_F64LE, H5T_STD_I64LE, H5T_STD_U8LE
   use litz_kinds, only: dp, int64
   use litz_errors, only: error_t, fail, exit_files
   use litz_hdf5_library, only: hdf5_start
   use litz_output_files, only: publish_file, unpublished
   implicit none
   private
   public :: hid_t, hdf5_rows_t
   public :: hdf5_real, hdf5_integer, hdf5_byte
   public :: hdf5_start, hdf5_create_file, hdf5_create_group, hdf5_flush, hdf5_publish_file, hdf5_close_file, &
      hdf5_discard_file
   public :: hdf5_write_attribute, hdf5_write_text

   !> How the numbers of a dataset are stored: 64-bit floating point, 64-bit integer, unsigned byte
   integer, parameter :: hdf5_real = 1, hdf5_integer = 2, hdf5_byte = 3

   !> A dataset that grows by rows of `components` numbers; rank 1 for one component, else rank 2.
   type :: hdf5_rows_t
      character(len=:), allocatable :: name
      integer :: components = 1
      !> Rows written so far
      integer(int64) :: n_rows = 0
      integer(hid_t) :: dataset = -1
   contains
      procedure :: create => rows_create
      procedure, private :: append_real => rows_append_real
      procedure, private :: append_integer => rows_append_integer
      procedure, private :: append_scalar => rows_append_scalar
      generic :: append => append_real, append_integer, append_scalar
      procedure, private :: overwrite_real => rows_overwrite_real
      procedure, private :: overwrite_integer => rows_overwrite_integer
      generic :: overwrite => overwrite_real, overwrite_integer
   end type hdf5_rows_t

   !> Writes an attribute, a new one or over the old value.
   interface hdf5_write_attribute
      procedure :: write_attribute_text
      procedure :: write_attribute_integers
      procedure :: write_attribute_integer
   end interface hdf5_write_attribute

   interface
      !> Address of the descriptor of an open file
      integer(c_int) function c_get_handle(file, access, handle) bind(c, name='H5Fget_vfd_handle')
         import :: c_int, c_int64_t, c_ptr
         implicit none
         integer(c_int64_t), value :: file, access
         type(c_ptr), intent(out) :: handle
      end function c_get_handle

      !> Not 0 when it fails
      integer(c_int) function c_ftruncate(descriptor, length) bind(c, name='ftruncate')
         import :: c_int, c_int64_t
         implicit none
         integer(c_int), value :: descriptor
         integer(c_int64_t), value :: length
      end function c_ftruncate

      integer(c_int) function c_unlink(path) bind(c, name='unlink')
         import :: c_char, c_int
         implicit none
         character(kind=c_char), intent(in) :: path(*)
      end function c_unlink
   end interface

contains

   !> Begins a file anew, beside the one of that path until `hdf5_publish_file` puts it there.
   subroutine hdf5_create_file(path, expected_chunks, file, error)
      character(len=*), intent(in) :: path
      !> Number of chunks that its largest dataset may come to have
      integer, intent(in) :: expected_chunks
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
      integer(hid_t), intent(in) :: parent
      character(len=*), intent(in) :: name
      integer(hid_t), intent(out) :: group
      type(error_t), allocatable, intent(inout) :: error
      integer :: status

      group = -1
      if (allocated(error)) return
      call h5gcreate_f(parent, name, group, status)
      if (status /= 0) error = cannot_write(file_name(parent), 'it fails at the group "'//name//'"')
   end subroutine hdf5_create_group

   !> Brings everything written so far to the disk.
   subroutine hdf5_flush(file, error)
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
      integer(hid_t), intent(in) :: file
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: path

      if (allocated(error)) return
      path = file_name(file)
      call publish_file(path, path, error)
   end subroutine hdf5_publish_file

   !> Closes a file that was not published, and removes it.
   subroutine hdf5_discard_file(file)
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

   subroutine write_attribute_text(object, name, text, error)
      integer(hid_t), intent(in) :: object
      character(len=*), intent(in) :: name, text
      type(error_t), allocatable, intent(inout) :: error
      character(kind=c_char), target :: buffer(max(1, len(text)))
      integer(hid_t) :: type
      integer :: ignored

      if (allocated(error)) return
      call text_to_buffer(text, buffer)
      call make_text_type(len(text), type)
      call write_attribute(object, name, type, type, [integer(hsize_t) ::], c_loc(buffer), error)
      call h5tclose_f(type, ignored)
   end subroutine write_attribute_text

   subroutine write_attribute_integer(object, name, value, error)
      integer(hid_t), intent(in) :: object
      character(len=*), intent(in) :: name
      integer, intent(in) :: value
      type(error_t), allocatable, intent(inout) :: error
      integer(int64), target :: buffer

      buffer = value
      call write_attribute(object, name, H5T_STD_I64LE, h5kind_to_type(int64, H5_INTEGER_KIND), [integer(hsize_t) ::], &
         c_loc(buffer), error)
   end subroutine write_attribute_integer

   subroutine write_attribute_integers(object, name, values, error)
      integer(hid_t), intent(in) :: object
      character(len=*), intent(in) :: name
      integer, intent(in) :: values(:)
      type(error_t), allocatable, intent(inout) :: error
      integer(int64), target :: buffer(size(values))

      buffer = values
      call write_attribute(object, name, H5T_STD_I64LE, h5kind_to_type(int64, H5_INTEGER_KIND), &
         [size(values, kind=hsize_t)], c_loc(buffer), error)
   end subroutine write_attribute_integers

   !> A text as a dataset of one string.
   subroutine hdf5_write_text(parent, name, text, error)
      integer(hid_t), intent(in) :: parent
      character(len=*), intent(in) :: name, text
      type(error_t), allocatable, intent(inout) :: error
      character(kind=c_char), allocatable, target :: buffer(:)
      integer(hid_t) :: type, space, dataset
      integer :: status, ignored

      if (allocated(error)) return
      ! on the heap: a deck may have a million lines
      allocate (buffer(max(1, len(text))))
      call text_to_buffer(text, buffer)
      call make_text_type(len(text), type)
      call h5screate_f(H5S_SCALAR_F, space, status)
      call h5dcreate_f(parent, name, type, space, dataset, status)
      if (status == 0) call h5dwrite_f(dataset, type, c_loc(buffer), status)
      if (status /= 0) error = cannot_write(file_name(parent), 'it fails at the dataset "'//name//'"')
      call h5dclose_f(dataset, ignored)
      call h5sclose_f(space, ignored)
      call h5tclose_f(type, ignored)
   end subroutine hdf5_write_text

   !> An empty dataset.
   subroutine rows_create(self, parent, name, components, storage, expected_rows, error)
      class(hdf5_rows_t), intent(inout) :: self
      integer(hid_t), intent(in) :: parent
      character(len=*), intent(in) :: name
      !> Numbers in a row
      integer, intent(in) :: components
      !> `hdf5_real`, `hdf5_integer` or `hdf5_byte`
      integer, intent(in) :: storage
      !> Rows that usually come at once: the guide for the chunk size
      integer, intent(in) :: expected_rows
      type(error_t), allocatable, intent(inout) :: error
      integer, parameter :: smallest_chunk = 256, largest_chunk = 32768
      integer(hsize_t) :: now(2), largest(2), chunk(2)
      integer(hid_t) :: space, creation
      integer :: rank, status, ignored

      if (allocated(error)) return
      self%name = name
      self%components = components
      self%n_rows = 0
      rank = merge(1, 2, components == 1)
      now = [int(components, hsize_t), 0_hsize_t]
      largest = [int(components, hsize_t), H5S_UNLIMITED_F]
      chunk = [components, min(max(expected_rows, smallest_chunk), largest_chunk)]
      ! Fortran counts dimensions from the other end: rows last here are rows first in the file
      call h5screate_simple_f(rank, now(3 - rank:), space, status, largest(3 - rank:))
      call h5pcreate_f(H5P_DATASET_CREATE_F, creation, status)
      call h5pset_chunk_f(creation, rank, chunk(3 - rank:), status)
      ! rows have their place in the file before they are written: `extend_file` goes by that
      call h5pset_alloc_time_f(creation, H5D_ALLOC_TIME_EARLY_F, status)
      call h5pset_fill_time_f(creation, H5D_FILL_TIME_NEVER_F, status)
      call h5dcreate_f(parent, name, stored_type(storage), space, self%dataset, status, creation)
      if (status /= 0) error = cannot_write(file_name(parent), 'it fails at the dataset "'//name//'"')
      call h5pclose_f(creation, ignored)
      call h5sclose_f(space, ignored)
   end subroutine rows_create

   subroutine rows_append_real(self, values, error)
      class(hdf5_rows_t), intent(inout) :: self
      !> (components, rows)
      real(dp), intent(in) :: values(:, :)
      type(error_t), allocatable, intent(inout) :: error
      real(dp), allocatable, target :: buffer(:, :)

      if (allocated(error) .or. size(values, 2) == 0) return
      allocate (buffer, source=values)
      call append_buffer(self, H5T_NATIVE_DOUBLE, c_loc(buffer), size(values, 2), error)
   end subroutine rows_append_real

   subroutine rows_append_integer(self, values, error)
      class(hdf5_rows_t), intent(inout) :: self
      !> (components, rows)
      integer(int64), intent(in) :: values(:, :)
      type(error_t), allocatable, intent(inout) :: error
      integer(int64), allocatable, target :: buffer(:, :)

      if (allocated(error) .or. size(values, 2) == 0) return
      allocate (buffer, source=values)
      call append_buffer(self, h5kind_to_type(int64, H5_INTEGER_KIND), c_loc(buffer), size(values, 2), error)
   end subroutine rows_append_integer

   !> One row of one integer.
   subroutine rows_append_scalar(self, value, error)
      class(hdf5_rows_t), intent(inout) :: self
      integer(int64), intent(in) :: value
      type(error_t), allocatable, intent(inout) :: error

      call self%append(reshape([value], [1, 1]), error)
   end subroutine rows_append_scalar

   !> The first rows anew.
   subroutine rows_overwrite_real(self, values, error)
      class(hdf5_rows_t), intent(in) :: self
      !> (components, rows), no more rows than there are
      real(dp), intent(in) :: values(:, :)
      type(error_t), allocatable, intent(inout) :: error
      real(dp), allocatable, target :: buffer(:, :)

      if (allocated(error) .or. size(values, 2) == 0) return
      allocate (buffer, source=values)
      call write_buffer(self, H5T_NATIVE_DOUBLE, c_loc(buffer), 0_int64, size(values, 2), error)
   end subroutine rows_overwrite_real

   subroutine rows_overwrite_integer(self, values, error)
      class(hdf5_rows_t), intent(in) :: self
      !> (components, rows), no more rows than there are
      integer(int64), intent(in) :: values(:, :)
      type(error_t), allocatable, intent(inout) :: error
      integer(int64), allocatable, target :: buffer(:, :)

      if (allocated(error) .or. size(values, 2) == 0) return
      allocate (buffer, source=values)
      call write_buffer(self, h5kind_to_type(int64, H5_INTEGER_KIND), c_loc(buffer), 0_int64, size(values, 2), error)
   end subroutine rows_overwrite_integer

   subroutine append_buffer(self, memory_type, buffer, n_new, error)
      class(hdf5_rows_t), intent(inout) :: self
      integer(hid_t), intent(in) :: memory_type
      type(c_ptr), intent(in) :: buffer
      integer, intent(in) :: n_new
      type(error_t), allocatable, intent(inout) :: error
      integer(hsize_t) :: total(2)
      integer :: status

      total = [int(self%components, hsize_t), int(self%n_rows + n_new, hsize_t)]
      call h5dset_extent_f(self%dataset, total(merge(2, 1, self%components == 1):), status)
      if (status /= 0) then
         error = cannot_write(file_name(self%dataset), 'it fails at the dataset "'//self%name//'"')
         return
      end if
      call write_buffer(self, memory_type, buffer, self%n_rows, n_new, error)
      self%n_rows = self%n_rows + n_new
   end subroutine append_buffer

   !> Writes rows that have their place already.
   subroutine write_buffer(self, memory_type, buffer, n_before, n_rows, error)
      class(hdf5_rows_t), intent(in) :: self
      integer(hid_t), intent(in) :: memory_type
      type(c_ptr), intent(in) :: buffer
      !> Rows to be passed over, and rows to write
      integer(int64), intent(in) :: n_before
      integer, intent(in) :: n_rows
      type(error_t), allocatable, intent(inout) :: error
      integer(hsize_t) :: start(2), count(2)
      integer(hid_t) :: file_space, memory_space
      integer :: rank, first, status, ignored

      rank = merge(1, 2, self%components == 1)
      first = 3 - rank
      start = [0_hsize_t, int(n_before, hsize_t)]
      count = [self%components, n_rows]
      call h5dget_space_f(self%dataset, file_space, status)
      if (status /= 0) then
         error = cannot_write(file_name(self%dataset), 'it fails at the dataset "'//self%name//'"')
         return
      end if
      call h5sselect_hyperslab_f(file_space, H5S_SELECT_SET_F, start(first:), count(first:), status)
      call h5screate_simple_f(rank, count(first:), memory_space, status)
      call h5dwrite_f(self%dataset, memory_type, buffer, status, memory_space, file_space)
      if (status /= 0) error = cannot_write(file_name(self%dataset), 'it fails at the dataset "'//self%name//'"')
      call h5sclose_f(memory_space, ignored)
      call h5sclose_f(file_space, ignored)
   end subroutine write_buffer

   subroutine write_attribute(object, name, file_type, memory_type, extent, buffer, error)
      integer(hid_t), intent(in) :: object
      character(len=*), intent(in) :: name
      integer(hid_t), intent(in) :: file_type, memory_type
      !> Empty for a scalar
      integer(hsize_t), intent(in) :: extent(:)
      type(c_ptr), intent(in) :: buffer
      type(error_t), allocatable, intent(inout) :: error
      integer(hid_t) :: attribute, space
      logical :: there
      integer :: status, ignored

      if (allocated(error)) return
      call h5aexists_f(object, name, there, status)
      if (there) then
         call h5aopen_f(object, name, attribute, status)
      else
         if (size(extent) == 0) then
            call h5screate_f(H5S_SCALAR_F, space, status)
         else
            call h5screate_simple_f(1, extent, space, status)
         end if
         call h5acreate_f(object, name, file_type, space, attribute, status)
         call h5sclose_f(space, ignored)
      end if
      if (status == 0) call h5awrite_f(attribute, memory_type, buffer, status)
      if (status /= 0) error = cannot_write(file_name(object), 'it fails at the attribute "'//name//'"')
      call h5aclose_f(attribute, ignored)
   end subroutine write_attribute

   !> Null-padded, exactly as long as the text: VTK refuses strings that are padded with blanks, HDF5 those of length 0.
   subroutine make_text_type(length, type)
      integer, intent(in) :: length
      integer(hid_t), intent(out) :: type
      integer :: status

      call h5tcopy_f(H5T_NATIVE_CHARACTER, type, status)
      call h5tset_size_f(type, int(max(1, length), size_t), status)
      call h5tset_strpad_f(type, H5T_STR_NULLPAD_F, status)
      call h5tset_cset_f(type, H5T_CSET_UTF8_F, status)
   end subroutine make_text_type

   pure subroutine text_to_buffer(text, buffer)
      character(len=*), intent(in) :: text
      character(kind=c_char), intent(out) :: buffer(:)
      integer :: i

      buffer = c_null_char
      do i = 1, len(text)
         buffer(i) = text(i:i)
      end do
   end subroutine text_to_buffer

   integer(hid_t) function stored_type(storage)
      integer, intent(in) :: storage

      select case (storage)
      case (hdf5_real)
         stored_type = H5T_IEEE_F64LE
      case (hdf5_byte)
         stored_type = H5T_STD_U8LE
      case default
         stored_type = H5T_STD_I64LE
      end select
   end function stored_type

   !> Path of the file that an object is in, as the user knows it.
   function file_name(object) result(name)
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
      character(len=*), intent(in) :: path, what
      type(error_t) :: error

      error = fail(exit_files, 'cannot write "'//path//'": HDF5 says that '//what//'; is the disk full?')
   end function cannot_write

end module litz_hdf5_helpers
