!> Arrays and names from an HDF5 file, each in one call.
!>
!> Every procedure passes `error` through and does nothing once it is allocated. Messages name the dataset, say what is
!> wrong about it and what it should be; the caller names the file.
module litz_hdf5_input
   use, intrinsic :: iso_c_binding, only: c_loc, c_ptr
   use hdf5, only: hid_t, hsize_t, h5fis_hdf5_f, h5fopen_f, h5fclose_f, &
      h5gn_members_f, h5gget_obj_info_idx_f, h5lexists_f, h5oopen_f, h5oclose_f, h5iget_type_f, &
      h5dget_space_f, h5dget_type_f, h5dget_storage_size_f, h5dread_f, h5sclose_f, h5sget_simple_extent_ndims_f, &
      h5sget_simple_extent_dims_f, h5tget_class_f, h5tclose_f, h5kind_to_type, &
      H5F_ACC_RDONLY_F, H5I_DATASET_F, H5T_INTEGER_F, H5T_FLOAT_F, H5T_NATIVE_DOUBLE, &
      H5_INTEGER_KIND
   use litz_errors, only: error_t, fail, exit_input, exit_files
   use litz_hdf5_library, only: hdf5_start
   use litz_kinds, only: dp, int64
   use litz_path_kind, only: why_not_read
   use litz_text, only: to_text
   implicit none
   private
   public :: hid_t, longest_name
   public :: hdf5_open_file, hdf5_close_input, hdf5_has, hdf5_names, hdf5_read_integers, hdf5_read_reals

   !> Longest name of a member of a group
   integer, parameter :: longest_name = 512
   !> Members of a group; more come only from damaged files
   integer, parameter :: max_names = 1000000
   !> Rows of up to three components are counted in default integers
   integer, parameter :: largest_rows = 500000000

contains

   !> Opens a file for reading.
   subroutine hdf5_open_file(path, file, error)
      !> Name of the file
      character(len=*), intent(in) :: path
      !> Identifier of the open file; -1 where it could not be opened
      integer(hid_t), intent(out) :: file
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: reason
      logical :: there
      integer :: status

      file = -1
      call hdf5_start(error)
      if (allocated(error)) return
      inquire (file=path, exist=there)
      if (.not. there) then
         error = fail(exit_files, 'does not exist')
         return
      end if
      reason = why_not_read(path)
      if (len(reason) > 0) then
         error = fail(exit_files, 'cannot be read: '//reason)
         return
      end if
      call h5fis_hdf5_f(path, there, status)
      if (status /= 0 .or. .not. there) then
         error = fail(exit_files, 'is not an HDF5 file')
         return
      end if
      call h5fopen_f(path, H5F_ACC_RDONLY_F, file, status)
      if (status /= 0) error = fail(exit_files, 'cannot be read: it is damaged or not permitted')
   end subroutine hdf5_open_file

   subroutine hdf5_close_input(file)
      !> In: identifier, or -1 for a file that is not open. Out: -1
      integer(hid_t), intent(inout) :: file
      integer :: ignored

      if (file >= 0) call h5fclose_f(file, ignored)
      file = -1
   end subroutine hdf5_close_input

   !> There is a group or dataset of this path in the file.
   logical function hdf5_has(file, path)
      !> Identifier of the open file
      integer(hid_t), intent(in) :: file
      !> `a/b/c`
      character(len=*), intent(in) :: path
      integer :: status, slash

      hdf5_has = path == '/'
      if (hdf5_has) return
      ! HDF5 answers for the last name only, and fails where a name before it is missing
      slash = index(path, '/')
      do while (slash > 0)
         call h5lexists_f(file, path(:slash - 1), hdf5_has, status)
         if (status /= 0 .or. .not. hdf5_has) return
         if (index(path(slash + 1:), '/') == 0) exit
         slash = slash + index(path(slash + 1:), '/')
      end do
      call h5lexists_f(file, path, hdf5_has, status)
      hdf5_has = hdf5_has .and. status == 0
   end function hdf5_has

   !> Names of the members of a group; none when there is no such group.
   subroutine hdf5_names(file, path, names, error)
      !> Identifier of the open file
      integer(hid_t), intent(in) :: file
      !> Path of the group
      character(len=*), intent(in) :: path
      !> Names (n) in the order of the file's index
      character(len=longest_name), allocatable, intent(out) :: names(:)
      type(error_t), allocatable, intent(inout) :: error
      character(len=longest_name) :: name
      integer :: n, i, kind, status

      n = 0
      if (.not. allocated(error)) then
         if (hdf5_has(file, path)) then
            call h5gn_members_f(file, path, n, status)
            if (status /= 0) then
               error = fail(exit_input, path//' must be a group')
            else if (n > max_names) then
               error = fail(exit_input, path//' has more than '//to_text(max_names)//' members')
            end if
         end if
      end if
      if (allocated(error)) n = 0
      allocate (names(n))
      do i = 1, n
         name = ''
         call h5gget_obj_info_idx_f(file, path, i - 1, name, kind, status)
         names(i) = name
         if (status /= 0) error = fail(exit_input, 'a name in the group '//path//' cannot be read')
      end do
   end subroutine hdf5_names

   !> A dataset of whole numbers, (rows) in the file or (rows, columns) for more than one column.
   subroutine hdf5_read_integers(file, path, columns, values, error)
      !> Identifier of the open file
      integer(hid_t), intent(in) :: file
      !> Place in the file, `a/b/c`
      character(len=*), intent(in) :: path
      !> Number of columns that the dataset must have
      integer, intent(in) :: columns
      !> The numbers (columns, rows); not allocated after an error
      integer, allocatable, intent(out) :: values(:, :)
      type(error_t), allocatable, intent(inout) :: error
      integer(int64), allocatable, target :: buffer(:, :)
      type(c_ptr) :: address
      integer(hid_t) :: dataset
      integer :: rows, status

      call open_dataset(file, path, columns, [H5T_INTEGER_F], 'whole numbers', dataset, rows, error)
      if (allocated(error)) return
      allocate (buffer(columns, rows))
      address = c_loc(buffer)
      if (rows > 0) then
         call h5dread_f(dataset, h5kind_to_type(int64, H5_INTEGER_KIND), address, status)
         if (status /= 0) error = fail(exit_files, path//' cannot be read: the file is damaged')
      end if
      call h5oclose_f(dataset, status)
      if (allocated(error)) return
      if (any(buffer > huge(rows) .or. buffer < -huge(rows))) then
         error = fail(exit_input, path//' has a number above '//to_text(huge(rows))//', the largest that litz takes')
         return
      end if
      allocate (values(columns, rows))
      values = int(buffer)
   end subroutine hdf5_read_integers

   !> A dataset of real or whole numbers, (rows) in the file or (rows, columns) for more than one column.
   subroutine hdf5_read_reals(file, path, columns, values, error)
      !> Identifier of the open file
      integer(hid_t), intent(in) :: file
      !> Place in the file, `a/b/c`
      character(len=*), intent(in) :: path
      !> Number of columns that the dataset must have
      integer, intent(in) :: columns
      !> The numbers (columns, rows); not allocated after an error
      real(dp), allocatable, intent(out) :: values(:, :)
      type(error_t), allocatable, intent(inout) :: error
      real(dp), allocatable, target :: buffer(:, :)
      type(c_ptr) :: address
      integer(hid_t) :: dataset
      integer :: rows, status

      call open_dataset(file, path, columns, [H5T_FLOAT_F, H5T_INTEGER_F], 'numbers', dataset, rows, error)
      if (allocated(error)) return
      allocate (buffer(columns, rows))
      address = c_loc(buffer)
      if (rows > 0) then
         call h5dread_f(dataset, H5T_NATIVE_DOUBLE, address, status)
         if (status /= 0) error = fail(exit_files, path//' cannot be read: the file is damaged')
      end if
      call h5oclose_f(dataset, status)
      if (.not. allocated(error)) call move_alloc(buffer, values)
   end subroutine hdf5_read_reals

   !> A dataset whose type and shape are what they should be.
   subroutine open_dataset(file, path, columns, classes, noun, dataset, rows, error)
      !> Identifier of the open file
      integer(hid_t), intent(in) :: file
      !> Place in the file, `a/b/c`
      character(len=*), intent(in) :: path
      !> Number of columns that the dataset must have
      integer, intent(in) :: columns
      !> HDF5 classes of number types (n) that are accepted
      integer, intent(in) :: classes(:)
      !> What the numbers are called in a message
      character(len=*), intent(in) :: noun
      !> Identifier of the dataset, which the caller closes; closed already after an error
      integer(hid_t), intent(out) :: dataset
      !> Number of rows; 0 after an error
      integer, intent(out) :: rows
      type(error_t), allocatable, intent(inout) :: error
      integer(hid_t) :: type
      integer(hsize_t), allocatable :: extent(:)
      integer :: kind, class, status

      dataset = -1
      rows = 0
      if (allocated(error)) return
      if (.not. hdf5_has(file, path)) then
         error = fail(exit_input, 'has no dataset '//path)
         return
      end if
      call h5oopen_f(file, path, dataset, status)
      if (status /= 0) then
         error = fail(exit_files, path//' cannot be opened: the file is damaged, or a broken link')
         return
      end if
      call h5iget_type_f(dataset, kind, status)
      if (kind /= H5I_DATASET_F) then
         error = fail(exit_input, path//' must be a dataset')
         call h5oclose_f(dataset, status)
         return
      end if
      call h5dget_type_f(dataset, type, status)
      call h5tget_class_f(type, class, status)
      call h5tclose_f(type, status)
      call find_extent(dataset, extent)
      if (.not. any(class == classes)) then
         error = fail(exit_input, path//' must hold '//noun)
      else if (.not. has_shape(extent, columns)) then
         error = fail(exit_input, path//' has the shape '//describe_shape(extent)//'; it must be '// &
            describe_wanted_shape(columns))
      else if (extent(size(extent)) > largest_rows) then
         error = fail(exit_input, path//' has more rows than litz takes')
      else if (.not. is_written(dataset, extent)) then
         error = fail(exit_files, path//' has the shape '//describe_shape(extent)// &
            ', but hardly any data: it was not written')
      else
         rows = int(extent(size(extent)))
         return
      end if
      call h5oclose_f(dataset, status)
   end subroutine open_dataset

   !> Dimensions in Fortran's order: rows last.
   subroutine find_extent(dataset, extent)
      !> Identifier of the open dataset
      integer(hid_t), intent(in) :: dataset
      !> Dimensions (rank), rows last
      integer(hsize_t), allocatable, intent(out) :: extent(:)
      integer(hsize_t), allocatable :: largest(:)
      integer(hid_t) :: space
      integer :: rank, status

      call h5dget_space_f(dataset, space, status)
      call h5sget_simple_extent_ndims_f(space, rank, status)
      allocate (extent(max(0, rank)), largest(max(0, rank)))
      if (rank > 0) call h5sget_simple_extent_dims_f(space, extent, largest, status)
      call h5sclose_f(space, status)
   end subroutine find_extent

   !> There are data for all rows. Without that, a small file could ask for all of the memory.
   logical function is_written(dataset, extent)
      !> Identifier of the open dataset
      integer(hid_t), intent(in) :: dataset
      !> Dimensions (rank), rows last
      integer(hsize_t), intent(in) :: extent(:)
      !> A byte of data holds no more numbers, however they are compressed: more than deflate can reach
      integer(hsize_t), parameter :: max_numbers = 2000
      integer(hsize_t) :: stored
      integer :: status

      call h5dget_storage_size_f(dataset, stored, status)
      is_written = status == 0 .and. product(extent)/max_numbers <= stored
   end function is_written

   pure logical function has_shape(extent, columns)
      !> Dimensions (rank), rows last
      integer(hsize_t), intent(in) :: extent(:)
      !> Number of columns that the dataset must have
      integer, intent(in) :: columns

      has_shape = size(extent) == merge(1, 2, columns == 1)
      if (has_shape .and. columns > 1) has_shape = extent(1) == columns
   end function has_shape

   !> As h5py and h5dump show it: rows first.
   pure function describe_shape(extent) result(words)
      !> Dimensions (rank), rows last
      integer(hsize_t), intent(in) :: extent(:)
      character(len=:), allocatable :: words
      character(len=20) :: number
      integer :: i

      words = '('
      do i = size(extent), 1, -1
         write (number, '(i0)') extent(i)
         words = words//trim(number)
         if (i > 1) words = words//', '
      end do
      words = words//')'
   end function describe_shape

   pure function describe_wanted_shape(columns) result(words)
      !> Number of columns that the dataset must have
      integer, intent(in) :: columns
      character(len=:), allocatable :: words

      words = '(n)'
      if (columns > 1) words = '(n, '//to_text(columns)//')'
   end function describe_wanted_shape

end module litz_hdf5_input
