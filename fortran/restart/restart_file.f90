!> Converged increments from which a run can go on, bit for bit as if it had never stopped: `STEM.restart.h5`.
!>
!> Each written increment adds rows to every dataset; `row_ends` says where they end, `checksums` what they held. The
!> attribute `n_increments` is written last, after everything else has reached the disk: a file that a killed run leaves
!> is whole up to there.
module litz_restart_file
   use litz_kinds, only: dp, int64
   use litz_errors, only: error_t, fail, exit_files, exit_input
   use litz_hdf5_attributes, only: hdf5_write_attribute
   use litz_hdf5_files, only: hdf5_start, hdf5_create_file, hdf5_flush, hdf5_publish_file, hdf5_close_file, &
      hdf5_discard_file
   use litz_hdf5_input, only: hdf5_open_file, hdf5_close_input
   use litz_hdf5_rows, only: hdf5_rows_t, hdf5_integer
   use litz_hdf5_rows_reader, only: read_attribute_integer, read_integer_rows
   use litz_model, only: step_t
   use litz_problem, only: problem_t
   use litz_restart_arrays, only: restart_arrays_t, creating, writing, reading
   use litz_restart_content, only: exchange_all
   use litz_restart_model, only: write_model_record, check_model_record
   use litz_step_control, only: course_t
   use litz_text, only: to_text
   use litz_version, only: version
   implicit none
   private
   public :: restart_file_t, read_restart, wants_restart

   integer, parameter :: format_version = 40

   type, extends(restart_arrays_t) :: restart_file_t
      private
      !> Where the rows of each written increment end in each dataset, and their checksums
      type(hdf5_rows_t) :: row_ends, checksums
      integer :: n_increments = 0
      !> The file has its name, and a whole increment
      logical :: is_published = .false.
   contains
      procedure :: open => restart_open
      procedure :: write => restart_write
      procedure :: close => restart_close
   end type restart_file_t

contains

   !> At every n-th increment of a step and at its last, where the deck asks for it.
   pure logical function wants_restart(step, increment, ends_step)
      type(step_t), intent(in) :: step
      !> Number of the increment in its step
      integer, intent(in) :: increment
      !> It is the last one
      logical, intent(in) :: ends_step

      wants_restart = .false.
      if (step%restart_frequency == 0) return
      wants_restart = mod(increment, step%restart_frequency) == 0 .or. ends_step
   end function wants_restart

   !> Begins the file.
   subroutine restart_open(self, path, problem, error)
      class(restart_file_t), intent(inout) :: self
      !> Of the file
      character(len=*), intent(in) :: path
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable, intent(inout) :: error
      type(course_t) :: course

      if (allocated(error)) return
      call hdf5_start(error)
      call hdf5_create_file(path, sum(problem%model%steps%max_increments), self%file, error)
      call hdf5_write_attribute(self%file, 'format_version', format_version, error)
      call hdf5_write_attribute(self%file, 'version', version, error)
      call hdf5_write_attribute(self%file, 'n_increments', 0, error)
      self%mode = creating
      self%usual_rows = problem%model%n_nodes
      call exchange_all(self%restart_arrays_t, problem, course, error)
      self%n_datasets = self%next
      call self%row_ends%create(self%file, 'row_ends', self%n_datasets, hdf5_integer, 1, error)
      call self%checksums%create(self%file, 'checksums', self%n_datasets, hdf5_integer, 1, error)
      call write_model_record(self%file, problem%model, error)
   end subroutine restart_open

   !> Adds the converged increment.
   subroutine restart_write(self, problem, course, error)
      class(restart_file_t), intent(inout) :: self
      !> Only read, although `exchange_all` could also set it
      type(problem_t), intent(inout) :: problem
      type(course_t), intent(inout) :: course
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error)) return
      self%mode = writing
      call exchange_all(self%restart_arrays_t, problem, course, error)
      call self%row_ends%append(reshape(self%rows(:self%n_datasets)%n_rows, [self%n_datasets, 1]), error)
      call self%checksums%append(reshape(self%row_checksum(:self%n_datasets), [self%n_datasets, 1]), error)
      call hdf5_flush(self%file, error)
      if (allocated(error)) return
      self%n_increments = self%n_increments + 1
      call hdf5_write_attribute(self%file, 'n_increments', self%n_increments, error)
      call hdf5_flush(self%file, error)
      if (self%n_increments == 1) call hdf5_publish_file(self%file, error)
      self%is_published = self%is_published .or. .not. allocated(error)
   end subroutine restart_write

   !> Close the file; without any increment it is discarded.
   subroutine restart_close(self, error)
      class(restart_file_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error

      if (.not. self%is_published) call hdf5_discard_file(self%file)
      call hdf5_close_file(self%file, error)
   end subroutine restart_close

   !> Sets the problem and its course to what they were at a written increment.
   subroutine read_restart(path, step, increment, problem, course, error)
      !> Of the file
      character(len=*), intent(in) :: path
      !> Step and increment in it; 0, 0: the last one in the file
      integer, intent(in) :: step, increment
      type(problem_t), intent(inout) :: problem
      type(course_t), intent(out) :: course
      type(error_t), allocatable, intent(inout) :: error
      type(restart_file_t) :: self
      integer :: found

      if (allocated(error)) return
      call hdf5_open_file(path, self%file, error)
      call read_attribute_integer(self%file, '.', 'format_version', found, error)
      if (.not. allocated(error) .and. found /= format_version) error = fail(exit_files, &
         'another version of litz wrote it, in format '//to_text(found)//' (this one reads format '// &
         to_text(format_version)//'); run the deck from its beginning')
      call read_attribute_integer(self%file, '.', 'n_increments', self%n_increments, error)
      call find_increment(self, step, increment, found, error)
      if (.not. allocated(error)) then
         self%mode = creating
         call count_datasets(self, problem)
         call read_row_ends(self, found, error)
         self%mode = reading
         call exchange_all(self%restart_arrays_t, problem, course, error)
      end if
      if (.not. allocated(error)) call check_course(problem, error)
      if (.not. allocated(error)) call check_model_record(self%file, problem%model, problem%state%step, error)
      if (.not. (allocated(error) .or. self%fits_mesh)) error = fail(exit_files, &
         'it has other numbers of nodes or elements than its own model: the file is damaged')
      call hdf5_close_input(self%file)
      if (allocated(error)) error%message = 'cannot continue from "'//path//'": '//error%message
   end subroutine read_restart

   !> Place of an increment among those written.
   subroutine find_increment(self, step, increment, found, error)
      type(restart_file_t), intent(inout) :: self
      !> Step and increment in it; 0, 0: the last one in the file
      integer, intent(in) :: step, increment
      !> Place of it
      integer, intent(out) :: found
      type(error_t), allocatable, intent(inout) :: error
      integer(int64), allocatable :: steps(:, :)
      character(len=:), allocatable :: there
      integer :: i

      found = self%n_increments
      if (allocated(error)) return
      if (self%n_increments == 0) then
         error = fail(exit_files, 'no increment has been written to it')
         return
      end if
      if (step == 0) return
      call read_integer_rows(self%file, 'increment', 2, 0_int64, int(self%n_increments, int64), steps, error)
      if (allocated(error)) return
      there = ''
      do found = 1, self%n_increments
         if (all(steps(:, found) == [step, increment])) return
      end do
      do i = max(1, self%n_increments - 9), self%n_increments
         there = there//' '//to_text(int(steps(1, i)))//':'//to_text(int(steps(2, i)))
      end do
      if (self%n_increments > 10) there = ' ...'//there
      error = fail(exit_input, 'it has no increment '//to_text(step)//':'//to_text(increment)//'; it has'//there)
   end subroutine find_increment

   !> Set the number of datasets, without any file.
   subroutine count_datasets(self, problem)
      type(restart_file_t), intent(inout) :: self
      type(problem_t), intent(inout) :: problem
      type(course_t) :: course
      !> Nothing is created once an error is there
      type(error_t), allocatable :: stop_here

      stop_here = fail(exit_files, '')
      call exchange_all(self%restart_arrays_t, problem, course, stop_here)
      self%n_datasets = self%next
   end subroutine count_datasets

   !> Where the rows of an increment begin and end in each dataset, and their checksums.
   subroutine read_row_ends(self, found, error)
      type(restart_file_t), intent(inout) :: self
      !> Place of the increment among those written
      integer, intent(in) :: found
      type(error_t), allocatable, intent(inout) :: error
      integer(int64), allocatable :: ends(:, :), sums(:, :)

      call read_integer_rows(self%file, 'row_ends', self%n_datasets, 0_int64, int(found, int64), ends, error)
      call read_integer_rows(self%file, 'checksums', self%n_datasets, found - 1_int64, 1_int64, sums, error)
      if (allocated(error)) return
      self%row_checksum(:self%n_datasets) = sums(:, 1)
      self%end_row(:self%n_datasets) = ends(:, found)
      if (found > 1) self%first_row(:self%n_datasets) = ends(:, found - 1)
   end subroutine read_row_ends

   !> The increment must be one that this deck can have reached.
   subroutine check_course(problem, error)
      type(problem_t), intent(in) :: problem
      type(error_t), allocatable, intent(inout) :: error

      if (problem%state%step <= size(problem%model%steps)) return
      error = fail(exit_input, 'it stands in step '//to_text(problem%state%step)//', but the deck has '// &
         to_text(size(problem%model%steps)))
   end subroutine check_course

end module litz_restart_file
