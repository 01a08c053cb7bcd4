!> The warnings of a run in its result file: the group `warnings`.
!>
!> What an entry is stands in `text` from its first increment on, a line of kind, unit and message between tabulators.
!> Its counts and values, in `integers` and `reals`, are written over as it comes again. The attribute `n_warnings` is
!> written last, after everything else has reached the disk: a file that a killed run leaves is whole up to there.
module litz_warning_rows
   use litz_kinds, only: dp, int64
   use litz_errors, only: error_t
   use litz_growing_text, only: growing_text_t
   use litz_hdf5_files, only: hid_t, hdf5_create_group, hdf5_flush
   use litz_hdf5_attributes, only: hdf5_write_attribute
   use litz_hdf5_rows, only: hdf5_rows_t, hdf5_real, hdf5_integer, hdf5_byte
   use litz_run_warnings, only: run_warnings_t
   implicit none
   private
   public :: warning_rows_t

   integer, parameter :: n_integers = 8, n_reals = 3
   !> Letters of most lists of warnings, which take no more than this of the file where there are none
   integer, parameter :: usual_text = 16384

   type :: warning_rows_t
      integer(hid_t), private :: file = -1, group = -1
      type(hdf5_rows_t), private :: text, integers, reals
      integer, private :: n = 0
   contains
      procedure :: create => rows_create
      procedure :: write => rows_write
   end type warning_rows_t

contains

   !> An empty list.
   subroutine rows_create(self, file, parent, error)
      class(warning_rows_t), intent(inout) :: self
      !> Both of the result file
      integer(hid_t), intent(in) :: file, parent
      type(error_t), allocatable, intent(inout) :: error

      self%file = file
      self%n = 0
      call hdf5_create_group(parent, 'warnings', self%group, error)
      call hdf5_write_attribute(self%group, 'n_warnings', 0, error)
      call self%text%create(self%group, 'text', 1, hdf5_byte, usual_text, error)
      call hdf5_write_attribute(self%text%dataset, 'columns', 'kind unit message', error)
      call self%integers%create(self%group, 'integers', n_integers, hdf5_integer, 1, error)
      call hdf5_write_attribute(self%integers%dataset, 'columns', 'element_1 element_2 first_step first_increment'// &
         ' last_step last_increment count is_rest', error)
      call self%reals%create(self%group, 'reals', n_reals, hdf5_real, 1, error)
      call hdf5_write_attribute(self%reals%dataset, 'columns', 'first_time last_time worst', error)
   end subroutine rows_create

   !> Brings the list up to date. New entries go to the disk; counts go there with the next increment of the file.
   subroutine rows_write(self, warnings, error)
      class(warning_rows_t), intent(inout) :: self
      type(run_warnings_t), intent(in) :: warnings
      type(error_t), allocatable, intent(inout) :: error
      integer(int64) :: integers(n_integers, warnings%n)
      real(dp) :: reals(n_reals, warnings%n)
      integer :: i

      if (allocated(error) .or. warnings%n == 0) return
      do i = 1, warnings%n
         associate (item => warnings%items(i))
            integers(:, i) = [item%elements, item%first, item%last, item%count, merge(1, 0, item%is_rest)]
            reals(:, i) = [item%first_time, item%last_time, item%worst]
         end associate
      end do
      call self%integers%overwrite(integers(:, :self%n), error)
      call self%reals%overwrite(reals(:, :self%n), error)
      if (warnings%n == self%n) return
      call self%integers%append(integers(:, self%n + 1:), error)
      call self%reals%append(reals(:, self%n + 1:), error)
      call self%text%append(new_text(self%n, warnings), error)
      call hdf5_flush(self%file, error)
      self%n = warnings%n
      call hdf5_write_attribute(self%group, 'n_warnings', self%n, error)
      call hdf5_flush(self%file, error)
   end subroutine rows_write

   !> The lines of the entries after the first `n`, as numbers of characters (1, characters).
   pure function new_text(n, warnings) result(numbers)
      !> Entries that are in the file already
      integer, intent(in) :: n
      type(run_warnings_t), intent(in) :: warnings
      integer(int64), allocatable :: numbers(:, :)
      type(growing_text_t) :: lines
      integer :: i

      do i = n + 1, warnings%n
         call lines%append(warnings%items(i)%record())
      end do
      allocate (numbers, source=int(lines%codes(), int64))
   end function new_text

end module litz_warning_rows
