!> The arrays of a restart file: written or read, one after the other, by the same calls.
!>
!> Each array is a dataset to which each written increment adds rows; of these there is a checksum.
module litz_restart_arrays
   use litz_kinds, only: dp, int64
   use litz_checksum, only: checksum
   use litz_errors, only: error_t, fail, exit_files
   use litz_hdf5_attributes, only: hdf5_write_attribute
   use litz_hdf5_files, only: hid_t
   use litz_hdf5_rows, only: hdf5_rows_t, hdf5_real, hdf5_integer
   use litz_hdf5_rows_reader, only: read_attribute_text, read_real_rows, read_integer_rows
   use litz_quantities, only: quantity_t
   implicit none
   private
   public :: restart_arrays_t, creating, writing, reading

   !> What is done with the arrays
   integer, parameter :: creating = 1, writing = 2, reading = 3
   integer, parameter :: max_datasets = 100

   type :: restart_arrays_t
      integer(hid_t) :: file = -1
      integer :: mode = creating
      !> Number of datasets, and the one that was exchanged last
      integer :: n_datasets = 0, next = 0
      type(hdf5_rows_t) :: rows(max_datasets)
      !> Where the rows of the increment that is read begin and end
      integer(int64) :: first_row(max_datasets) = 0, end_row(max_datasets) = 0
      !> Of the rows of the increment that is written or read
      integer(int64) :: row_checksum(max_datasets) = 0
      !> What was read has as many nodes and elements as the model
      logical :: fits_mesh = .true.
      !> Rows of the arrays that are not there yet: a guide for the layout
      integer :: usual_rows = 1
   contains
      procedure, private :: reals, scalars, rotations, integers, logicals
      generic :: array => reals, scalars, rotations, integers, logicals
      procedure :: columns
   end type restart_arrays_t

contains

   !> Rows of real numbers: (components, rows).
   subroutine reals(self, name, values, error, components)
      class(restart_arrays_t), intent(inout) :: self
      !> Name of the dataset
      character(len=*), intent(in) :: name
      !> (components, rows)
      real(dp), allocatable, intent(inout) :: values(:, :)
      type(error_t), allocatable, intent(inout) :: error
      !> Numbers in a row, where the array may not be allocated yet
      integer, intent(in), optional :: components
      integer :: n

      self%next = self%next + 1
      if (allocated(error)) return
      if (present(components)) n = components
      if (allocated(values)) n = size(values, 1)
      associate (i => self%next)
         select case (self%mode)
         case (creating)
            call self%rows(i)%create(self%file, name, n, hdf5_real, expected_rows(), error)
         case (writing)
            self%row_checksum(i) = 0
            if (.not. allocated(values)) return
            call self%rows(i)%append(values, error)
            self%row_checksum(i) = checksum(values)
         case (reading)
            call read_real_rows(self%file, name, n, self%first_row(i), self%end_row(i) - self%first_row(i), values, &
               error)
            if (.not. allocated(error)) call verify(self, name, checksum(values), size(values), error)
         end select
      end associate

   contains

      pure integer function expected_rows()
         expected_rows = self%usual_rows
         if (allocated(values)) expected_rows = size(values, 2)
      end function expected_rows

   end subroutine reals

   !> What is read must be what was written, where anything was.
   subroutine verify(self, name, found, n_numbers, error)
      class(restart_arrays_t), intent(in) :: self
      !> Name of the dataset
      character(len=*), intent(in) :: name
      !> Checksum of what was read
      integer(int64), intent(in) :: found
      !> How many numbers were read
      integer, intent(in) :: n_numbers
      type(error_t), allocatable, intent(inout) :: error

      if (found == self%row_checksum(self%next)) return
      if (n_numbers == 0 .and. self%row_checksum(self%next) == 0) return
      error = fail(exit_files, 'its dataset '//name//' is not what was written: the file is damaged')
   end subroutine verify

   !> A number per row.
   subroutine scalars(self, name, values, error)
      class(restart_arrays_t), intent(inout) :: self
      !> Name of the dataset
      character(len=*), intent(in) :: name
      !> (rows)
      real(dp), allocatable, intent(inout) :: values(:)
      type(error_t), allocatable, intent(inout) :: error
      real(dp), allocatable :: rows(:, :)

      rows = reshape(values, [1, size(values)])
      call self%reals(name, rows, error)
      if (.not. allocated(error) .and. self%mode == reading) values = rows(1, :)
   end subroutine scalars

   !> A matrix per row.
   subroutine rotations(self, name, values, error)
      class(restart_arrays_t), intent(inout) :: self
      !> Name of the dataset
      character(len=*), intent(in) :: name
      !> (3, 3, rows)
      real(dp), allocatable, intent(inout) :: values(:, :, :)
      type(error_t), allocatable, intent(inout) :: error
      real(dp), allocatable :: rows(:, :)

      rows = reshape(values, [9, size(values, 3)])
      call self%reals(name, rows, error)
      if (.not. allocated(error) .and. self%mode == reading) values = reshape(rows, [3, 3, size(rows, 2)])
   end subroutine rotations

   !> Rows of whole numbers: (components, rows).
   subroutine integers(self, name, values, components, error)
      class(restart_arrays_t), intent(inout) :: self
      !> Name of the dataset
      character(len=*), intent(in) :: name
      !> (components, rows)
      integer, allocatable, intent(inout) :: values(:, :)
      !> Numbers in a row
      integer, intent(in) :: components
      type(error_t), allocatable, intent(inout) :: error
      integer(int64), allocatable :: rows(:, :)

      self%next = self%next + 1
      if (allocated(error)) return
      associate (i => self%next)
         select case (self%mode)
         case (creating)
            call self%rows(i)%create(self%file, name, components, hdf5_integer, size(values, 2), error)
         case (writing)
            rows = int(values, int64)
            call self%rows(i)%append(rows, error)
            self%row_checksum(i) = checksum(rows)
         case (reading)
            call read_integer_rows(self%file, name, components, self%first_row(i), &
               self%end_row(i) - self%first_row(i), rows, error)
            if (.not. allocated(error)) call verify(self, name, checksum(rows), size(rows), error)
            if (.not. allocated(error)) values = int(rows)
         end select
      end associate
   end subroutine integers

   !> Rows of truth values: (components, rows).
   subroutine logicals(self, name, values, components, error)
      class(restart_arrays_t), intent(inout) :: self
      !> Name of the dataset
      character(len=*), intent(in) :: name
      !> (components, rows)
      logical, allocatable, intent(inout) :: values(:, :)
      !> Truth values in a row
      integer, intent(in) :: components
      type(error_t), allocatable, intent(inout) :: error
      integer, allocatable :: numbers(:, :)

      allocate (numbers(components, 0))
      if (allocated(values)) numbers = merge(1, 0, values)
      call self%integers(name, numbers, components, error)
      if (.not. allocated(error) .and. self%mode == reading) values = numbers /= 0
   end subroutine logicals

   !> Names of the columns of a dataset, as an attribute; other names belong to another version of litz.
   subroutine columns(self, name, quantities, of_integers, error)
      class(restart_arrays_t), intent(inout) :: self
      !> Name of the dataset, which is the last one that was exchanged
      character(len=*), intent(in) :: name
      type(quantity_t), intent(in) :: quantities(:)
      !> The columns are those of the integers, not of the reals
      logical, intent(in) :: of_integers
      type(error_t), allocatable, intent(inout) :: error
      character(len=:), allocatable :: text, found
      integer :: i

      text = ''
      do i = 1, size(quantities)
         if (quantities(i)%is_integer .eqv. of_integers) text = text//quantities(i)%columns(' ', with_units=.false.)
      end do
      text = trim(adjustl(text))
      if (self%mode == creating) call hdf5_write_attribute(self%rows(self%next)%dataset, 'columns', text, error)
      if (self%mode == reading) then
         call read_attribute_text(self%file, name, 'columns', found, error)
         if (allocated(error)) return
         if (found /= text) error = fail(exit_files, 'another version of litz wrote it')
      end if
   end subroutine columns

end module litz_restart_arrays
