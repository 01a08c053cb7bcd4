!> Rows of the datasets that `litz_hdf5_rows` writes, read back: a range of them, so that a long file costs no more
!> than what is wanted of it.
!>
!> Every procedure passes `error` through and does nothing once it is allocated. Messages begin with what is wrong; the
!> caller names the file.
module litz_hdf5_rows_reader
   use, intrinsic :: iso_c_binding, only: c_char, c_loc, c_ptr
   use hdf5, only: hid_t, hsize_t, size_t, h5aopen_by_name_f, h5aread_f, h5aclose_f, h5aget_type_f, h5aget_space_f, &
      h5tget_size_f, h5tget_class_f, h5tis_variable_str_f, h5tclose_f, h5oopen_f, h5oclose_f, h5iget_type_f, &
      h5dread_f, h5dget_space_f, h5sget_simple_extent_ndims_f, h5sget_simple_extent_dims_f, &
      h5sget_simple_extent_npoints_f, h5sselect_hyperslab_f, h5screate_simple_f, h5sclose_f, h5kind_to_type, &
      H5I_DATASET_F, H5S_SELECT_SET_F, H5_INTEGER_KIND, H5T_NATIVE_DOUBLE, H5T_STRING_F
   use litz_kinds, only: dp, int64
   use litz_errors, only: error_t, fail, exit_files
   implicit none
   private
   public :: read_attribute_integer, read_attribute_text, read_real_rows, read_integer_rows

   !> No attribute of a restart file comes near
   integer(size_t), parameter :: longest_text = 100000

contains

   !> The attribute has one value, not an array of them.
   logical function is_single(attribute)
      !> Identifier of the open attribute
      integer(hid_t), intent(in) :: attribute
      integer(hid_t) :: space
      integer(hsize_t) :: n
      integer :: status, ignored

      n = 0
      call h5aget_space_f(attribute, space, status)
      if (status == 0) call h5sget_simple_extent_npoints_f(space, n, status)
      call h5sclose_f(space, ignored)
      is_single = status == 0 .and. n == 1
   end function is_single

   subroutine read_attribute_integer(file, object, name, value, error)
      !> Identifier of the open file
      integer(hid_t), intent(in) :: file
      !> Path of the group or dataset that has the attribute
      character(len=*), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> Its value; 0 after an error
      integer, intent(out) :: value
      type(error_t), allocatable, intent(inout) :: error
      integer(int64), target :: buffer
      type(c_ptr) :: address
      integer(hid_t) :: attribute
      integer :: status, ignored

      value = 0
      if (allocated(error)) return
      buffer = 0
      call h5aopen_by_name_f(file, object, name, attribute, status)
      if (status == 0) then
         address = c_loc(buffer)
         if (.not. is_single(attribute)) then
            status = -1
         else
            call h5aread_f(attribute, h5kind_to_type(int64, H5_INTEGER_KIND), address, status)
         end if
         call h5aclose_f(attribute, ignored)
      end if
      if (status == 0 .and. abs(buffer) <= huge(value)) then
         value = int(buffer)
      else
         error = missing(object//' '//name)
      end if
   end subroutine read_attribute_integer

   subroutine read_attribute_text(file, object, name, text, error)
      !> Identifier of the open file
      integer(hid_t), intent(in) :: file
      !> Path of the group or dataset that has the attribute
      character(len=*), intent(in) :: object
      !> Name of the attribute
      character(len=*), intent(in) :: name
      !> Its value; empty after an error
      character(len=:), allocatable, intent(out) :: text
      type(error_t), allocatable, intent(inout) :: error
      character(kind=c_char), allocatable, target :: buffer(:)
      type(c_ptr) :: address
      integer(hid_t) :: attribute, type
      integer(size_t) :: length
      logical :: is_variable, fits
      integer :: class, status, ignored, i

      text = ''
      if (allocated(error)) return
      call h5aopen_by_name_f(file, object, name, attribute, status)
      if (status /= 0) then
         error = missing(object//' '//name)
         return
      end if
      call h5aget_type_f(attribute, type, status)
      call h5tget_class_f(type, class, ignored)
      call h5tget_size_f(type, length, ignored)
      call h5tis_variable_str_f(type, is_variable, ignored)
      fits = is_single(attribute)
      if (class /= H5T_STRING_F .or. is_variable .or. length > longest_text .or. .not. fits) then
         status = -1
         length = 0
      end if
      allocate (buffer(length))
      address = c_loc(buffer)
      if (status == 0) call h5aread_f(attribute, type, address, status)
      call h5tclose_f(type, ignored)
      call h5aclose_f(attribute, ignored)
      if (status /= 0) then
         error = missing(object//' '//name)
         return
      end if
      text = repeat(' ', int(length))
      do i = 1, int(length)
         text(i:i) = buffer(i)
      end do
      text = text(:verify(text, achar(0), back=.true.))
   end subroutine read_attribute_text

   subroutine read_real_rows(file, name, components, first, count, values, error)
      !> Identifier of the open file
      integer(hid_t), intent(in) :: file
      !> Path of the dataset in the file
      character(len=*), intent(in) :: name
      !> Numbers in a row
      integer, intent(in) :: components
      !> Rows to be passed over, and rows to read
      integer(int64), intent(in) :: first, count
      !> (components, count)
      real(dp), allocatable, intent(out) :: values(:, :)
      type(error_t), allocatable, intent(inout) :: error
      real(dp), allocatable, target :: buffer(:, :)
      integer(hid_t) :: dataset, space

      call open_rows(file, name, components, first, count, dataset, space, error)
      if (allocated(error)) return
      allocate (buffer(components, count))
      call read_buffer(dataset, space, name, components, first, count, H5T_NATIVE_DOUBLE, c_loc(buffer), error)
      call move_alloc(buffer, values)
   end subroutine read_real_rows

   subroutine read_integer_rows(file, name, components, first, count, values, error)
      !> Identifier of the open file
      integer(hid_t), intent(in) :: file
      !> Path of the dataset in the file
      character(len=*), intent(in) :: name
      !> Numbers in a row
      integer, intent(in) :: components
      !> Rows to be passed over, and rows to read
      integer(int64), intent(in) :: first, count
      !> (components, count)
      integer(int64), allocatable, intent(out) :: values(:, :)
      type(error_t), allocatable, intent(inout) :: error
      integer(int64), allocatable, target :: buffer(:, :)
      integer(hid_t) :: dataset, space

      call open_rows(file, name, components, first, count, dataset, space, error)
      if (allocated(error)) return
      allocate (buffer(components, count))
      call read_buffer(dataset, space, name, components, first, count, h5kind_to_type(int64, H5_INTEGER_KIND), &
         c_loc(buffer), error)
      call move_alloc(buffer, values)
   end subroutine read_integer_rows

   !> A dataset that has the rows, before room is made for them.
   subroutine open_rows(file, name, components, first, count, dataset, space, error)
      !> Identifier of the open file
      integer(hid_t), intent(in) :: file
      !> Path of the dataset in the file
      character(len=*), intent(in) :: name
      !> Numbers in a row
      integer, intent(in) :: components
      !> Number of rows to be passed over
      integer(int64), intent(in) :: first
      !> Number of rows to read
      integer(int64), intent(in) :: count
      !> Identifiers of the dataset and of its extent; both open, unless there is an error
      integer(hid_t), intent(out) :: dataset, space
      type(error_t), allocatable, intent(inout) :: error
      integer(hsize_t) :: extent(2), largest(2)
      integer :: kind, rank, n_dimensions, from, status, ignored

      dataset = -1
      space = -1
      if (allocated(error)) return
      call h5oopen_f(file, name, dataset, status)
      if (status /= 0) then
         error = missing(name)
         return
      end if
      call h5iget_type_f(dataset, kind, status)
      rank = merge(1, 2, components == 1)
      from = 3 - rank
      extent = components
      n_dimensions = 0
      if (kind == H5I_DATASET_F) then
         call h5dget_space_f(dataset, space, status)
         call h5sget_simple_extent_ndims_f(space, n_dimensions, status)
         if (n_dimensions == rank) call h5sget_simple_extent_dims_f(space, extent(from:), largest(from:), ignored)
      end if
      if (n_dimensions == rank .and. extent(1) == components .and. first >= 0 .and. count >= 0) then
         if (first <= extent(2) .and. count <= extent(2) - first) return
      end if
      error = fail(exit_files, 'its dataset '//name//' does not have the expected rows')
      if (space >= 0) call h5sclose_f(space, ignored)
      call h5oclose_f(dataset, ignored)
   end subroutine open_rows

   !> Reads the rows, and closes the dataset.
   subroutine read_buffer(dataset, space, name, components, first, count, memory_type, buffer, error)
      !> Identifiers of the dataset and of its extent, both closed in the end
      integer(hid_t), intent(in) :: dataset, space
      !> Identifier of the type in memory
      integer(hid_t), intent(in) :: memory_type
      !> Path of the dataset in the file
      character(len=*), intent(in) :: name
      !> Numbers in a row
      integer, intent(in) :: components
      !> Number of rows to be passed over
      integer(int64), intent(in) :: first
      !> Number of rows to read
      integer(int64), intent(in) :: count
      type(c_ptr), intent(in) :: buffer
      type(error_t), allocatable, intent(inout) :: error
      type(c_ptr) :: address
      integer(hid_t) :: memory_space
      integer(hsize_t) :: start(2), range(2)
      integer :: rank, from, status, ignored

      if (count > 0) then
         rank = merge(1, 2, components == 1)
         from = 3 - rank
         start = [0_hsize_t, int(first, hsize_t)]
         range = [int(components, hsize_t), int(count, hsize_t)]
         call h5sselect_hyperslab_f(space, H5S_SELECT_SET_F, start(from:), range(from:), status)
         call h5screate_simple_f(rank, range(from:), memory_space, status)
         address = buffer
         call h5dread_f(dataset, memory_type, address, status, memory_space, space)
         call h5sclose_f(memory_space, ignored)
         if (status /= 0) error = fail(exit_files, 'its dataset '//name//' cannot be read: the file is damaged')
      end if
      call h5sclose_f(space, ignored)
      call h5oclose_f(dataset, ignored)
   end subroutine read_buffer

   pure function missing(what) result(error)
      !> What is missing: a dataset or an attribute
      character(len=*), intent(in) :: what
      type(error_t) :: error

      error = fail(exit_files, 'it has no '//what//': it is not a restart file of this version of litz')
   end function missing

end module litz_hdf5_rows_reader
