!> Converged increments from which a run can go on, bit for bit as if it had never stopped: `STEM.restart.h5`.
!>
!> Each written increment adds rows to every dataset; `row_ends` says where they end, `checksums` what they held. The
!> attribute `n_increments` is written last, after everything else has reached the disk: a file that a killed run leaves
!> is whole up to there.
module litz_restart_file
   use litz_kinds, only: dp, int64
   use litz_checksum, only: checksum
   use litz_contact_points, only: contact_point_t
   use litz_errors, only: error_t, fail, exit_files, exit_input
   use litz_fields, only: n_slots
   use litz_hdf5_files, only: hid_t, hdf5_start, hdf5_create_file, hdf5_flush, hdf5_publish_file, &
      hdf5_close_file, hdf5_discard_file
   use litz_hdf5_attributes, only: hdf5_write_attribute
   use litz_hdf5_rows, only: hdf5_rows_t, hdf5_real, hdf5_integer
   use litz_hdf5_input, only: hdf5_open_file, hdf5_close_input
   use litz_hdf5_rows_reader, only: read_attribute_integer, read_attribute_text, read_real_rows, read_integer_rows
   use litz_model, only: step_t
   use litz_quantities, only: quantity_t, quantity_table_t
   use litz_restart_model, only: write_model_record, check_model_record
   use litz_run_warnings, only: run_warnings_t
   use litz_restart_points, only: point_table, points_of_table
   use litz_result_quantities, only: wire_quantity_t, list_wire_quantities, contact_table, contacts_of_table
   use litz_state, only: state_t, contact_t, energies_t
   use litz_step_control, only: course_t
   use litz_problem, only: problem_t
   use litz_text, only: to_text
   use litz_version, only: version
   implicit none
   private
   public :: restart_file_t, read_restart, wants_restart

   integer, parameter :: format_version = 4
   integer, parameter :: creating = 1, writing = 2, reading = 3
   integer, parameter :: most_datasets = 100

   type :: restart_file_t
      private
      integer(hid_t) :: file = -1
      integer :: mode = creating
      !> Number of datasets, and the one that comes next in the order of `exchange_all`
      integer :: n_datasets = 0, next = 0
      type(hdf5_rows_t) :: rows(most_datasets), row_ends, checksums
      !> Where the rows of the increment that is read begin and end
      integer(int64) :: first_row(most_datasets) = 0, end_row(most_datasets) = 0
      !> Of the rows of the increment that is written or read
      integer(int64) :: row_checksum(most_datasets) = 0
      integer :: n_increments = 0
      !> The file has its name, and a whole increment
      logical :: is_published = .false.
      !> What was read has as many nodes and elements as the model
      logical :: fits_mesh = .true.
      !> Rows of the arrays that are not there yet: a guide for the layout
      integer :: usual_rows = 1
   contains
      procedure :: open => restart_open
      procedure :: write => restart_write
      procedure :: close => restart_close
      procedure, private :: reals, scalars, rotations, integers, logicals
      generic, private :: array => reals, scalars, rotations, integers, logicals
   end type restart_file_t

contains

   !> At every n-th increment of a step and at its last, where the deck asks for it.
   pure logical function wants_restart(step, increment, step_time)
      type(step_t), intent(in) :: step
      integer, intent(in) :: increment
      real(dp), intent(in) :: step_time
      real(dp), parameter :: round_off = 1.0e-9_dp

      wants_restart = .false.
      if (step%restart_frequency == 0) return
      wants_restart = mod(increment, step%restart_frequency) == 0 .or. step_time >= step%total*(1 - round_off)
   end function wants_restart

   !> Begins the file.
   subroutine restart_open(self, path, problem, error)
      class(restart_file_t), intent(inout) :: self
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
      call exchange_all(self, problem, course, error)
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
      call exchange_all(self, problem, course, error)
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

   subroutine restart_close(self, error)
      class(restart_file_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error

      if (.not. self%is_published) call hdf5_discard_file(self%file)
      call hdf5_close_file(self%file, error)
   end subroutine restart_close

   !> Sets the problem and its course to what they were at a written increment.
   subroutine read_restart(path, step, increment, problem, course, error)
      character(len=*), intent(in) :: path
      !> 0, 0: the last one in the file
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
         ! the number of datasets, without any file
         call count_datasets(self, problem)
         call read_row_ends(self, found, error)
         self%mode = reading
         call exchange_all(self, problem, course, error)
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
      integer, intent(in) :: step, increment
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

   subroutine count_datasets(self, problem)
      type(restart_file_t), intent(inout) :: self
      type(problem_t), intent(inout) :: problem
      type(course_t) :: course
      !> Nothing is created once an error is there
      type(error_t), allocatable :: stop_here

      stop_here = fail(exit_files, '')
      call exchange_all(self, problem, course, stop_here)
      self%n_datasets = self%next
   end subroutine count_datasets

   subroutine read_row_ends(self, found, error)
      type(restart_file_t), intent(inout) :: self
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

   !> Everything that the next increment depends on; a line for each array, the same for all that is done with it.
   subroutine exchange_all(self, problem, course, error)
      type(restart_file_t), intent(inout) :: self
      type(problem_t), intent(inout) :: problem
      type(course_t), intent(inout) :: course
      type(error_t), allocatable, intent(inout) :: error

      self%next = 0
      call exchange_course(self, problem, course, error)
      associate (state => problem%state, loading => problem%loading, contact => problem%contact)
         call exchange_wires(self, state, error)
         call self%array('rotation_matrix', state%rotation, error)
         call self%array('loading_fixed', loading%fixed, n_slots, error)
         call self%array('loading_start_value', loading%start_value, error, n_slots)
         call self%array('loading_start_load', loading%start_load, error, n_slots)
         call self%array('loading_value', loading%value, error, n_slots)
         call self%array('loading_load', loading%load, error, n_slots)
         call self%array('loading_converged_value', loading%converged_value, error, n_slots)
         call self%array('candidates', contact%candidates, 3, error)
         call self%array('positions_at_search', contact%x_collected, error, 3)
         if (.not. (allocated(error) .or. contact%present) .and. self%mode == reading) deallocate (contact%x_collected)
         call exchange_contacts(self, contact%converged, state%contacts, error)
      end associate
      call exchange_warnings(self, problem%warnings, error)
   end subroutine exchange_all

   !> What results show of nodes and elements.
   subroutine exchange_wires(self, state, error)
      type(restart_file_t), intent(inout) :: self
      type(state_t), intent(inout), target :: state
      type(error_t), allocatable, intent(inout) :: error
      type(wire_quantity_t), allocatable :: list(:)
      real(dp), allocatable :: values(:, :)
      integer :: i

      call list_wire_quantities(state, list)
      do i = 1, size(list)
         values = list(i)%values
         call self%array(trim(list(i)%name), values, error)
         if (allocated(error) .or. self%mode /= reading) cycle
         ! a file of another mesh is refused once its step is known, too
         self%fits_mesh = self%fits_mesh .and. size(values, 2) == size(list(i)%values, 2)
         if (self%fits_mesh) list(i)%values = values
      end do
   end subroutine exchange_wires

   subroutine exchange_course(self, problem, course, error)
      type(restart_file_t), intent(inout) :: self
      type(problem_t), intent(inout) :: problem
      type(course_t), intent(inout) :: course
      type(error_t), allocatable, intent(inout) :: error
      integer, allocatable :: numbers(:, :)
      real(dp), allocatable :: reals(:), energies(:)

      associate (state => problem%state, contact => problem%contact, control => course%control)
         numbers = reshape([state%step, state%increment], [2, 1])
         call self%array('increment', numbers, 2, error)
         if (.not. allocated(error)) then
            state%step = numbers(1, 1)
            state%increment = numbers(2, 1)
         end if
         numbers = reshape([state%iterations, control%quick, contact%last_id], [3, 1])
         call self%array('counts', numbers, 3, error)
         reals = [state%time, state%step_time, state%time_increment, course%start_time, control%wanted, state%audit]
         call self%array('times', reals, error)
         energies = [state%energies%work, state%energies%strain, state%energies%contact, state%energies%friction, &
            state%energies%stabilization]
         call self%array('energies', energies, error)
         call self%array('clearance', contact%clearance, error)
         if (allocated(error) .or. self%mode /= reading) return
         state%iterations = numbers(1, 1)
         control%quick = numbers(2, 1)
         contact%last_id = numbers(3, 1)
         state%time = reals(1)
         state%step_time = reals(2)
         state%time_increment = reals(3)
         course%start_time = reals(4)
         control%wanted = reals(5)
         state%audit = reals(6:)
         state%energies = energies_t(energies(1), energies(2), energies(3), energies(4), energies(5))
         contact%converged_clearance = contact%clearance
      end associate
   end subroutine exchange_course

   !> The warnings so far, as numbers of the characters of their text.
   subroutine exchange_warnings(self, warnings, error)
      type(restart_file_t), intent(inout) :: self
      type(run_warnings_t), intent(inout) :: warnings
      type(error_t), allocatable, intent(inout) :: error
      integer, allocatable :: numbers(:, :)
      logical :: ok

      allocate (numbers, source=warnings%to_numbers())
      call self%array('warnings', numbers, 1, error)
      if (allocated(error) .or. self%mode /= reading) return
      call warnings%from_numbers(numbers, ok)
      if (.not. ok) error = fail(exit_files, 'its dataset warnings is not what was written: the file is damaged')
   end subroutine exchange_warnings

   !> What the next increment needs of the crossings, and what results show of the contacts.
   subroutine exchange_contacts(self, points, contacts, error)
      type(restart_file_t), intent(inout) :: self
      type(contact_point_t), allocatable, intent(inout) :: points(:)
      type(contact_t), allocatable, intent(inout) :: contacts(:)
      type(error_t), allocatable, intent(inout) :: error
      type(quantity_table_t) :: point_rows, contact_rows

      point_rows = point_table(points)
      contact_rows = contact_table(contacts)
      call exchange_table(self, 'points', point_rows, error)
      call exchange_table(self, 'contacts', contact_rows, error)
      if (allocated(error) .or. self%mode /= reading) return
      call points_of_table(point_rows, points)
      call contacts_of_table(contact_rows, contacts)
   end subroutine exchange_contacts

   !> A table as two datasets, whose columns have names.
   subroutine exchange_table(self, name, table, error)
      type(restart_file_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      type(quantity_table_t), intent(inout) :: table
      type(error_t), allocatable, intent(inout) :: error

      call self%array(name//'_reals', table%reals, error)
      call exchange_columns(self, name//'_reals', table%quantities, .false., error)
      call self%array(name//'_integers', table%integers, size(table%integers, 1), error)
      call exchange_columns(self, name//'_integers', table%quantities, .true., error)
   end subroutine exchange_table

   !> Names of the columns of a dataset, as an attribute; other names belong to another version of litz.
   subroutine exchange_columns(self, name, quantities, of_integers, error)
      type(restart_file_t), intent(inout) :: self
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
   end subroutine exchange_columns

   !> Rows of real numbers: (components, rows).
   subroutine reals(self, name, values, error, components)
      class(restart_file_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(dp), allocatable, intent(inout) :: values(:, :)
      type(error_t), allocatable, intent(inout) :: error
      !> Where the array may not be allocated yet
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
      class(restart_file_t), intent(in) :: self
      character(len=*), intent(in) :: name
      !> Checksum of what was read, and how many numbers that are
      integer(int64), intent(in) :: found
      integer, intent(in) :: n_numbers
      type(error_t), allocatable, intent(inout) :: error

      if (found == self%row_checksum(self%next)) return
      if (n_numbers == 0 .and. self%row_checksum(self%next) == 0) return
      error = fail(exit_files, 'its dataset '//name//' is not what was written: the file is damaged')
   end subroutine verify

   !> A number per row.
   subroutine scalars(self, name, values, error)
      class(restart_file_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      real(dp), allocatable, intent(inout) :: values(:)
      type(error_t), allocatable, intent(inout) :: error
      real(dp), allocatable :: rows(:, :)

      rows = reshape(values, [1, size(values)])
      call self%reals(name, rows, error)
      if (.not. allocated(error) .and. self%mode == reading) values = rows(1, :)
   end subroutine scalars

   !> A matrix per row.
   subroutine rotations(self, name, values, error)
      class(restart_file_t), intent(inout) :: self
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
      class(restart_file_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      integer, allocatable, intent(inout) :: values(:, :)
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

   !> Rows of truths: (components, rows).
   subroutine logicals(self, name, values, components, error)
      class(restart_file_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      logical, allocatable, intent(inout) :: values(:, :)
      integer, intent(in) :: components
      type(error_t), allocatable, intent(inout) :: error
      integer, allocatable :: numbers(:, :)

      allocate (numbers(components, 0))
      if (allocated(values)) numbers = merge(1, 0, values)
      call self%integers(name, numbers, components, error)
      if (.not. allocated(error) .and. self%mode == reading) values = numbers /= 0
   end subroutine logicals

end module litz_restart_file
