!> The record of the model in a restart file, as text in whole numbers: eight characters each, behind the number of
!> characters and their checksum.
module litz_restart_model
   use litz_kinds, only: int64
   use litz_checksum, only: checksum
   use litz_errors, only: error_t, fail, exit_files, exit_input
   use litz_hdf5_files, only: hid_t
   use litz_hdf5_rows, only: hdf5_rows_t, hdf5_integer
   use litz_hdf5_rows_reader, only: read_integer_rows
   use litz_model, only: model_t
   use litz_model_record, only: model_record
   use litz_record_differences, only: record_differences
   implicit none
   private
   public :: write_model_record, check_model_record

   character(len=*), parameter :: dataset = 'model_record'
   integer, parameter :: per_number = 8

contains

   subroutine write_model_record(file, model, error)
      !> Open file
      integer(hid_t), intent(in) :: file
      type(model_t), intent(in) :: model
      type(error_t), allocatable, intent(inout) :: error
      type(hdf5_rows_t) :: rows
      integer(int64), allocatable :: numbers(:, :)
      character(len=:), allocatable :: text

      text = model_record(model)
      numbers = packed(text)
      call rows%create(file, dataset, 1, hdf5_integer, size(numbers, 2) + 2, error)
      call rows%append(int(len(text), int64), error)
      call rows%append(checksum(numbers), error)
      call rows%append(numbers, error)
   end subroutine write_model_record

   !> An error that names what has changed, if the model is not what it was when the file was written.
   subroutine check_model_record(file, model, step, error)
      !> Open file
      integer(hid_t), intent(in) :: file
      type(model_t), intent(in) :: model
      !> The step that is continued: later ones may be others
      integer, intent(in) :: step
      type(error_t), allocatable, intent(inout) :: error
      integer(int64), allocatable :: head(:, :), numbers(:, :)
      character(len=:), allocatable :: differences

      call read_integer_rows(file, dataset, 1, 0_int64, 2_int64, head, error)
      if (allocated(error)) return
      ! no text, and no sum that could overflow, where the length is damaged
      call read_integer_rows(file, dataset, 1, 2_int64, max(-1_int64, head(1, 1) - 1)/per_number + 1, numbers, error)
      if (allocated(error)) return
      if (checksum(numbers) /= head(1, 2)) then
         error = fail(exit_files, 'its dataset '//dataset//' is not what was written: the file is damaged')
         return
      end if
      differences = record_differences(unpacked(numbers, int(head(1, 1))), model_record(model), step)
      if (len(differences) == 0) return
      error = fail(exit_input, 'the deck differs from that of the run that wrote it: '//differences// &
         '. Only later steps, output, controls and the solver may change')
   end subroutine check_model_record

   pure function packed(text) result(numbers)
      !> Any text
      character(len=*), intent(in) :: text
      !> (1, rows)
      integer(int64), allocatable :: numbers(:, :)
      integer :: i, row

      allocate (numbers(1, (len(text) - 1)/per_number + 1), source=0_int64)
      do i = 1, len(text)
         row = (i - 1)/per_number + 1
         numbers(1, row) = ior(numbers(1, row), ishft(int(iachar(text(i:i)), int64), 8*modulo(i - 1, per_number)))
      end do
   end function packed

   pure function unpacked(numbers, length) result(text)
      !> (1, rows)
      integer(int64), intent(in) :: numbers(:, :)
      !> Number of characters
      integer, intent(in) :: length
      character(len=:), allocatable :: text
      integer(int64) :: shifted
      integer :: i

      allocate (character(len=length) :: text)
      do i = 1, length
         shifted = ishft(numbers(1, (i - 1)/per_number + 1), -8*modulo(i - 1, per_number))
         text(i:i) = achar(int(iand(shifted, 255_int64)))
      end do
   end function unpacked

end module litz_restart_model
