!> Datasets of an HDF5 file that grow by rows.
!>
!> Every procedure passes `error` through and does nothing once it is allocated, so that a sequence of calls needs
!> one check at its end.
module litz_hdf5_rows
   use, intrinsic :: iso_c_binding, only: c_loc, c_ptr
   use hdf5, only: hid_t, hsize_t, h5pcreate_f, h5pclose_f, h5pset_chunk_f, h5pset_alloc_time_f, &
      h5pset_fill_time_f, h5screate_simple_f, h5sclose_f, h5sselect_hyperslab_f, h5dcreate_f, h5dwrite_f, &
      h5dset_extent_f, h5dget_space_f, h5kind_to_type, H5P_DATASET_CREATE_F, H5D_ALLOC_TIME_EARLY_F, &
      H5D_FILL_TIME_NEVER_F, H5S_SELECT_SET_F, H5S_UNLIMITED_F, H5_INTEGER_KIND, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, &
      H5T_STD_I64LE, H5T_STD_U8LE
   use litz_kinds, only: dp, int64
   use litz_errors, only: error_t
   use litz_hdf5_files, only: file_name, cannot_write
   implicit none
   private
   public :: hdf5_rows_t, hdf5_real, hdf5_integer, hdf5_byte

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

contains

   !> An empty dataset.
   subroutine rows_create(self, parent, name, components, storage, expected_rows, error)
      class(hdf5_rows_t), intent(inout) :: self
      !> Identifier of the file or group that it is made in
      integer(hid_t), intent(in) :: parent
      !> Name of the dataset
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
      if (status /= 0) error = cannot_write(file_name(parent), 'error at the dataset "'//name//'"')
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
      !> The one number of the row
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
      !> Identifier of the type in memory
      integer(hid_t), intent(in) :: memory_type
      type(c_ptr), intent(in) :: buffer
      !> Number of rows in the buffer
      integer, intent(in) :: n_new
      type(error_t), allocatable, intent(inout) :: error
      integer(hsize_t) :: total(2)
      integer :: status

      total = [int(self%components, hsize_t), int(self%n_rows + n_new, hsize_t)]
      call h5dset_extent_f(self%dataset, total(merge(2, 1, self%components == 1):), status)
      if (status /= 0) then
         error = cannot_write(file_name(self%dataset), 'error at the dataset "'//self%name//'"')
         return
      end if
      call write_buffer(self, memory_type, buffer, self%n_rows, n_new, error)
      self%n_rows = self%n_rows + n_new
   end subroutine append_buffer

   !> Writes rows that have their place already.
   subroutine write_buffer(self, memory_type, buffer, n_before, n_rows, error)
      class(hdf5_rows_t), intent(in) :: self
      !> Identifier of the type in memory
      integer(hid_t), intent(in) :: memory_type
      type(c_ptr), intent(in) :: buffer
      !> Number of rows to be passed over
      integer(int64), intent(in) :: n_before
      !> Number of rows to write
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
         error = cannot_write(file_name(self%dataset), 'error at the dataset "'//self%name//'"')
         return
      end if
      call h5sselect_hyperslab_f(file_space, H5S_SELECT_SET_F, start(first:), count(first:), status)
      call h5screate_simple_f(rank, count(first:), memory_space, status)
      call h5dwrite_f(self%dataset, memory_type, buffer, status, memory_space, file_space)
      if (status /= 0) error = cannot_write(file_name(self%dataset), 'error at the dataset "'//self%name//'"')
      call h5sclose_f(memory_space, ignored)
      call h5sclose_f(file_space, ignored)
   end subroutine write_buffer

   integer(hid_t) function stored_type(storage)
      !> `hdf5_real`, `hdf5_integer` or `hdf5_byte`
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

end module litz_hdf5_rows
