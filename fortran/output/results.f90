!> All files of a run, behind one type: open, a call per iteration and per increment, close.
!>
!>     STEM.vtkhdf              fields over wires            STEM_history.csv   what the deck asked for, over time
!>     STEM_contacts.vtkhdf     the contacts as points       STEM.sta           a line per increment
!>     STEM_contacts.csv        the contacts as a table      STEM.cvg           a line per iteration
!>     STEM_surfaces.csv        those with rigid surfaces, where the model has some
!>
!> and where the run had to give up, the last iterate as STEM_unconverged with the endings of fields and contacts.
!>
!> Files of an earlier run stay as they are until this one has its first complete increment, and are then replaced
!> together. Of each increment the fields are written first, then the tables, at last its line in the .sta file: an
!> increment that has this line is whole in all files, whenever the run is killed. A run that ends before its first
!> increment leaves the older files alone, and its own tables as STEM_unconverged.sta and .cvg.
module litz_results
   use litz_kinds, only: dp
   use litz_communicator, only: communicator_t
   use litz_errors, only: error_t, exit_files
   use litz_model, only: model_t
   use litz_state, only: state_t
   use litz_output_files, only: text_file_t, check_writable, remove_file
   use litz_run_warnings, only: run_warnings_t
   use litz_wire_results, only: wire_results_t
   use litz_contact_ledger, only: contact_ledger_t
   use litz_history, only: history_t
   use litz_progress_tables, only: iteration_header, iteration_line, increment_header, increment_line
   use litz_reports, only: iteration_report_t, increment_report_t
   use litz_surface_ledger, only: surface_ledger_t
   implicit none
   private
   public :: results_t

   character(len=*), parameter :: endings(6) = [character(len=16) :: '.vtkhdf', '_contacts.vtkhdf', '_contacts.csv', &
      '_history.csv', '.sta', '.cvg']

   !> What an iterate has of them, and a run that leaves older results alone
   character(len=*), parameter :: unconverged = '_unconverged'
   character(len=*), parameter :: unconverged_endings(6) = [character(len=16) :: '.vtkhdf', '_contacts.vtkhdf', &
      '_contacts.csv', '_surfaces.csv', '.sta', '.cvg']

   type :: results_t
      type(wire_results_t), private :: wires
      type(contact_ledger_t), private :: ledger
      type(surface_ledger_t), private :: surfaces
      type(history_t), private :: history
      !> Directory and stem
      character(len=:), allocatable, private :: base
      !> The iterate at which the run gave up
      type(wire_results_t), private :: unconverged_wires
      type(contact_ledger_t), private :: unconverged_ledger
      type(surface_ledger_t), private :: unconverged_surfaces
      type(text_file_t), private :: history_file, status_file, convergence_file
      !> There are results of an earlier run, and these are not yet in their place
      logical, private :: over_older = .false.
      logical, private :: is_published = .false., iterate_written = .false.
      !> Warnings that the .sta file has
      integer, private :: n_warnings = 0
      !> Something beyond the start of the run is in the files
      logical, private :: has_increment = .false.
   contains
      procedure :: open => results_open
      procedure :: write_iteration => results_write_iteration
      procedure :: write_status => results_write_status
      procedure :: write_warnings => results_write_warnings
      procedure :: list_warnings => results_list_warnings
      procedure :: write_increment => results_write_increment
      procedure :: begin_unconverged => results_begin_unconverged
      procedure :: write_unconverged => results_write_unconverged
      procedure :: leaves_older => results_leaves_older
      procedure :: close => results_close
   end type results_t

contains

   !> Begins all files.
   subroutine results_open(self, processes, model, base, state, error)
      class(results_t), intent(inout) :: self
      !> Those that hold the model
      class(communicator_t), intent(in) :: processes
      type(model_t), intent(in) :: model
      !> Directory, which exists, and stem of all files
      character(len=*), intent(in) :: base
      !> Where the run starts
      type(state_t), intent(in) :: state
      type(error_t), allocatable, intent(out) :: error
      type(error_t), allocatable :: ignored
      logical :: there
      integer :: i

      self%base = base
      do i = 1, size(endings)
         inquire (file=base//trim(endings(i)), exist=there)
         self%over_older = self%over_older .or. there
         call check_writable(base//trim(endings(i)), error)
      end do
      call self%history%build(processes, model, error)
      call self%wires%open(model, base//'.vtkhdf', error)
      call self%ledger%open(model, state, base//'_contacts.csv', base//'_contacts.vtkhdf', error)
      call self%surfaces%open(model, base//'_surfaces.csv', error)
      call begin_table(self%history_file, base//'_history.csv', model%units%in_header(self%history%header()), error)
      call begin_table(self%status_file, base//'.sta', model%units%in_header(increment_header(model)), error)
      call begin_table(self%convergence_file, base//'.cvg', model%units%in_header(iteration_header(model)), error)
      if (allocated(error)) call close_files(self, .false., ignored)
   end subroutine results_open

   subroutine begin_table(file, path, header, error)
      type(text_file_t), intent(inout) :: file
      !> Of the file, and its first line
      character(len=*), intent(in) :: path, header
      type(error_t), allocatable, intent(inout) :: error

      call file%create(path, error)
      call file%write_line(header, error)
      call file%flush(error)
   end subroutine begin_table

   !> A line of the .cvg file.
   subroutine results_write_iteration(self, model, report, error)
      class(results_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(iteration_report_t), intent(in) :: report
      type(error_t), allocatable, intent(out) :: error

      call self%convergence_file%write_line(iteration_line(model, report), error)
      call self%convergence_file%flush(error)
   end subroutine results_write_iteration

   !> A line of the .sta file. That of an increment comes after all else about it, so that what has a line is whole.
   subroutine results_write_status(self, model, report, error)
      class(results_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(increment_report_t), intent(in) :: report
      type(error_t), allocatable, intent(out) :: error

      call self%status_file%write_line(increment_line(model, report), error)
      call self%status_file%flush(error)
      if (self%has_increment .and. .not. self%is_published) call publish(self, error)
   end subroutine results_write_status

   !> Brings the list of warnings up to date: a comment in the .sta file for each new one, and all in the result file.
   subroutine results_write_warnings(self, warnings, error)
      class(results_t), intent(inout) :: self
      type(run_warnings_t), intent(in) :: warnings
      type(error_t), allocatable, intent(inout) :: error
      integer :: i

      do i = self%n_warnings + 1, warnings%n
         call self%status_file%write_line('# warning: '//warnings%items(i)%message, error)
      end do
      if (warnings%n > self%n_warnings) call self%status_file%flush(error)
      self%n_warnings = warnings%n
      call self%wires%write_warnings(warnings, error)
   end subroutine results_write_warnings

   !> The whole list at the end of the run, with how often each warning has come, also after an error. Files that could
   !> not be written are left as they are.
   subroutine results_list_warnings(self, warnings, run_error)
      class(results_t), intent(inout) :: self
      type(run_warnings_t), intent(in) :: warnings
      !> What has ended the run
      type(error_t), allocatable, intent(in) :: run_error
      type(error_t), allocatable :: error
      integer :: i

      if (warnings%n == 0) return
      if (allocated(run_error)) then
         if (run_error%code == exit_files) return
      end if
      call self%status_file%write_line('# '//warnings%counts(), error)
      do i = 1, warnings%n
         call self%status_file%write_line('# '//trim(warnings%items(i)%kind)//': '//warnings%items(i)%text(), error)
      end do
      call self%wires%write_warnings(warnings, error)
   end subroutine results_list_warnings

   !> History and contacts with rigid surfaces of a converged increment; fields and contact ledger as often as the step
   !> wants them, the contacts as points where it wants both.
   subroutine results_write_increment(self, model, state, at_start, error)
      class(results_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(state_t), intent(in) :: state
      !> It is what the run starts from
      logical, intent(in) :: at_start
      type(error_t), allocatable, intent(out) :: error
      logical :: with_fields, with_contacts

      with_fields = at_start
      with_contacts = at_start
      ! before the first step there is none to ask
      if (.not. at_start) then
         with_fields = is_due(state, model%steps(state%step)%output_frequency)
         with_contacts = is_due(state, model%steps(state%step)%contact_frequency)
      end if
      if (with_fields) then
         if (with_contacts) call self%ledger%write_points(model, state, error)
         call self%wires%write(model, state, error)
      end if
      ! tables are never ahead of the fields
      if (with_contacts) then
         call self%wires%note_contacts(state, error)
         call self%ledger%write_table(model, state, error)
      end if
      call self%surfaces%write(model, state, error)
      call self%history_file%write_line(self%history%line(state), error)
      call self%history_file%flush(error)
      self%has_increment = .not. (at_start .or. allocated(error))
   end subroutine results_write_increment

   !> Puts all files in the place of older ones.
   subroutine publish(self, error)
      class(results_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error

      if (.not. self%iterate_written) call remove_iterate(self, error)
      ! a run that is killed between the files must not leave new tables beside older fields
      call remove_file(self%base//'.vtkhdf', error)
      call self%ledger%publish(error)
      call self%surfaces%publish(error)
      call self%history_file%publish(error)
      call self%status_file%publish(error)
      call self%convergence_file%publish(error)
      ! the file that readers open comes last: where it is, the others are
      call self%wires%publish(error)
      self%is_published = .not. allocated(error)
   end subroutine publish

   !> Removes what an earlier run has left that gave up.
   subroutine remove_iterate(self, error)
      class(results_t), intent(in) :: self
      type(error_t), allocatable, intent(inout) :: error
      integer :: i

      do i = 1, size(unconverged_endings)
         call remove_file(self%base//unconverged//trim(unconverged_endings(i)), error)
      end do
   end subroutine remove_iterate

   !> Begins the files of the iterate at which the run gives up.
   subroutine results_begin_unconverged(self, model, state, error)
      class(results_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> With the contacts of the last converged state: what is new or moved is so beside them
      type(state_t), intent(in) :: state
      type(error_t), allocatable, intent(inout) :: error

      call self%unconverged_wires%open(model, self%base//unconverged//'.vtkhdf', error)
      call self%unconverged_ledger%open(model, state, self%base//unconverged//'_contacts.csv', &
         self%base//unconverged//'_contacts.vtkhdf', error)
      call self%unconverged_surfaces%open(model, self%base//unconverged//'_surfaces.csv', error)
   end subroutine results_begin_unconverged

   !> Writes the iterate, and closes its files.
   subroutine results_write_unconverged(self, model, state, warnings, error)
      class(results_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(state_t), intent(in) :: state
      !> Of the increments before
      type(run_warnings_t), intent(in) :: warnings
      type(error_t), allocatable, intent(inout) :: error

      call self%unconverged_wires%write_warnings(warnings, error)
      call self%unconverged_ledger%write_table(model, state, error)
      if (.not. allocated(error)) call self%unconverged_ledger%write_points(model, state, error)
      if (.not. allocated(error)) call self%unconverged_wires%write(model, state, error)
      call self%unconverged_wires%note_contacts(state, error)
      call self%unconverged_surfaces%write(model, state, error)
      call self%unconverged_ledger%publish(error)
      call self%unconverged_surfaces%publish(error)
      call self%unconverged_wires%publish(error)
      self%iterate_written = .not. allocated(error)
      call self%unconverged_ledger%close(.false., error)
      call self%unconverged_surfaces%close(error)
      call self%unconverged_wires%close(.false., error)
   end subroutine results_write_unconverged

   !> Every n-th increment of a step, and its last.
   pure logical function is_due(state, frequency)
      type(state_t), intent(in) :: state
      !> n; 0: none
      integer, intent(in) :: frequency

      is_due = .false.
      if (frequency > 0) is_due = mod(state%increment, frequency) == 0 .or. state%ends_step
   end function is_due

   !> The run has ended before its first increment, and the results of an earlier one are still there.
   pure logical function results_leaves_older(self)
      class(results_t), intent(in) :: self

      results_leaves_older = self%over_older .and. .not. self%is_published
   end function results_leaves_older

   !> Closes all files, also after an error; the result files note whether the run came to its end.
   subroutine results_close(self, finished, error)
      class(results_t), intent(inout) :: self
      !> The run came to its end
      logical, intent(in) :: finished
      !> That of the run, or the first one of closing
      type(error_t), allocatable, intent(inout) :: error
      type(error_t), allocatable :: publish_error

      if (.not. self%is_published) then
         if (finished .or. .not. self%over_older) then
            call publish(self, publish_error)
         else
            if (.not. self%iterate_written) call remove_iterate(self, publish_error)
            call self%status_file%publish(publish_error, self%base//unconverged//'.sta')
            call self%convergence_file%publish(publish_error, self%base//unconverged//'.cvg')
         end if
      end if
      if (allocated(publish_error) .and. .not. allocated(error)) call move_alloc(publish_error, error)
      call close_files(self, finished, error)
   end subroutine results_close

   subroutine close_files(self, finished, error)
      class(results_t), intent(inout) :: self
      !> The run came to its end
      logical, intent(in) :: finished
      type(error_t), allocatable, intent(inout) :: error

      call self%history_file%close(error)
      call self%status_file%close(error)
      call self%convergence_file%close(error)
      call self%ledger%close(finished, error)
      call self%surfaces%close(error)
      call self%wires%close(finished, error)
   end subroutine close_files

end module litz_results
