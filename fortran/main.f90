!> The program: arguments, call, exit code. The only place that prints errors and stops.
program litz
   use, intrinsic :: iso_fortran_env, only: output_unit, error_unit, compiler_version
   use, intrinsic :: iso_c_binding, only: c_int, c_intptr_t, c_funptr, c_null_funptr
   use hdf5, only: h5open_f, h5get_libversion_f
   use litz_blas_threads, only: blas_name, reserve_blas_memory
   use litz_check, only: check_model
   use litz_command_line, only: command_t, read_command, help_text, action_run, action_check, action_keywords, &
      action_version
   use litz_deck_reader, only: read_deck
   use litz_errors, only: error_t, error_list_t, fail, exit_success, exit_input, exit_memory
   use litz_keyword_json, only: keyword_json
   use litz_keyword_reference, only: keyword_list, keyword_page, keyword_markdown
   use litz_keyword_table, only: keyword_table
   use litz_keywords, only: keyword_table_t, unknown_keyword_message
   use litz_model, only: model_t
   use litz_model_summary, only: model_summary
   use litz_numbers, only: parse_integer, number_ok
   use litz_output_files, only: make_directory
   use litz_processes, only: begin_processes, end_processes, usual_solver
   use litz_run, only: run_options_t, run_model
   use litz_run_warnings, only: run_warnings_t
   use litz_size_check, only: check_size
   use litz_solver_factory, only: available_solvers, solver_libraries
   use litz_solver_names, only: solver_default
   use litz_timing, only: phase_reading
   use litz_text, only: shown
   use litz_version, only: version
   implicit none
   !> Columns of a terminal that does not state its own, and of the narrowest one that lines are broken for
   integer, parameter :: default_width = 100, min_width = 40
   type(command_t) :: command
   type(error_t), allocatable :: error

   interface
      !> May start the program again: first of all
      subroutine set_process_environment() bind(c, name='litz_set_process_environment')
         implicit none
      end subroutine set_process_environment
      subroutine watch_memory() bind(c, name='litz_watch_memory')
         implicit none
      end subroutine watch_memory
   end interface

   call set_process_environment()
   call begin_processes()
   call ignore_file_size_signal()
   call watch_memory()
   call read_command(command, error)
   if (allocated(error)) call end_with(error)
   select case (command%action)
   case (action_run)
      call run(command)
   case (action_check)
      call check(command)
   case (action_keywords)
      call print_keywords(command)
   case (action_version)
      call print_version()
   case default
      call print_text(help_text(command%argument))
   end select
   call end_processes()

contains

   !> A file that grows beyond the user's limit is then a write that fails, with a message, like that on a full disk.
   subroutine ignore_file_size_signal()
      interface
         type(c_funptr) function c_signal(number, handler) bind(c, name='signal')
            import :: c_int, c_funptr
            implicit none
            !> Number of the signal
            integer(c_int), value :: number
            type(c_funptr), value :: handler
         end function c_signal
      end interface
      !> SIGXFSZ and SIG_IGN of Linux and the BSDs
      integer(c_int), parameter :: file_size_signal = 25
      integer(c_intptr_t), parameter :: ignore = 1
      type(c_funptr) :: old

      old = c_signal(file_size_signal, transfer(ignore, c_null_funptr))
   end subroutine ignore_file_size_signal

   subroutine run(command)
      type(command_t), intent(in) :: command
      type(model_t) :: model
      type(run_options_t) :: options
      type(error_t), allocatable :: error

      call options%timing%start()
      call read_model(command%argument, model, options%deck_warnings)
      call options%timing%lap(phase_reading)
      call check_size(model, error)
      if (allocated(error)) call end_with(error)
      call make_directory(command%output_directory, error)
      if (allocated(error)) call end_with(error)
      options%deck_path = command%argument
      options%output_directory = command%output_directory
      options%solver = merge(command%solver, usual_solver, command%solver /= solver_default)
      options%threads = command%threads
      options%restart_path = command%restart_path
      options%restart_step = command%restart_step
      options%restart_increment = command%restart_increment
      options%quiet = command%quiet
      options%print_timing = command%timing
      call run_model(model, options, error)
      if (allocated(error)) call end_with(error)
   end subroutine run

   subroutine check(command)
      type(command_t), intent(in) :: command
      type(model_t) :: model
      type(error_t), allocatable :: error
      type(error_list_t) :: deck_warnings
      type(run_warnings_t) :: warnings
      character(len=:), allocatable :: report
      integer :: i

      call read_model(command%argument, model, deck_warnings)
      call print_text(model_summary(model))
      call check_model(model, report, warnings, error)
      if (allocated(report)) call print_text(report)
      do i = 1, warnings%n
         call print_error_text('warning: '//warnings%items(i)%message//new_line('a'))
      end do
      if (allocated(error)) call end_with(error)
   end subroutine check

   !> The model of a deck. Warnings are printed; errors end the program.
   subroutine read_model(path, model, warnings)
      !> The deck file, as the user wrote it
      character(len=*), intent(in) :: path
      type(model_t), intent(out) :: model
      type(error_list_t), intent(out) :: warnings
      type(error_list_t) :: errors

      if (.not. reserve_blas_memory()) call end_with(fail(exit_memory, 'not enough memory: the linear algebra needs'// &
         ' another 140 MB of addresses (see ulimit -v)'))
      call read_deck(path, model, errors, warnings)
      call print_error_text(warnings%text())
      if (errors%count == 0) return
      call print_error_text(errors%text())
      call stop_with(errors%items(1)%code)
   end subroutine read_model

   subroutine print_keywords(command)
      type(command_t), intent(in) :: command
      type(keyword_table_t) :: table
      integer :: index

      table = keyword_table()
      if (command%markdown) then
         call print_text(keyword_markdown(table))
      else if (command%json) then
         call print_text(keyword_json(table))
      else if (len(command%argument) == 0) then
         call print_text(keyword_list(table, terminal_width()))
      else
         index = table%find(command%argument)
         if (index == 0) then
            call end_with(fail(exit_input, unknown_keyword_message(table, command%argument, shown(command%argument))))
         end if
         call print_text(keyword_page(table%keywords(index), terminal_width()))
      end if
   end subroutine print_keywords

   !> Columns of the terminal, which shells and the Python package state in `COLUMNS`.
   integer function terminal_width() result(width)
      character(len=20) :: columns
      integer :: status

      call get_environment_variable('COLUMNS', columns)
      call parse_integer(trim(columns), width, status)
      if (status /= number_ok) width = default_width
      width = max(width, min_width)
   end function terminal_width

   subroutine print_version()
      integer :: major, minor, release, status

      call h5open_f(status)
      call h5get_libversion_f(major, minor, release, status)
      write (output_unit, '(2a)') 'litz ', version
      write (output_unit, '(2a)') 'compiler: ', compiler_version()
      write (output_unit, '(a, i0, 2(".", i0))') 'HDF5: ', major, minor, release
      write (output_unit, '(2a)') 'BLAS: ', blas_name()
      write (output_unit, '(2a)') 'solver libraries: ', solver_libraries()
      write (output_unit, '(2a)') 'solvers: ', available_solvers()
   end subroutine print_version

   subroutine print_text(text)
      !> Lines, each ended by a new-line character
      character(len=*), intent(in) :: text

      write (output_unit, '(a)', advance='no') text
   end subroutine print_text

   subroutine print_error_text(text)
      !> Whole lines, each with its end; may be empty
      character(len=*), intent(in) :: text

      flush (output_unit)
      write (error_unit, '(a)', advance='no') text
   end subroutine print_error_text

   !> Print an error and end with its exit code.
   subroutine end_with(error)
      type(error_t), intent(in) :: error

      call print_error_text(error%text())
      call stop_with(error%code)
   end subroutine end_with

   subroutine stop_with(code)
      !> One of the exit codes of litz_errors; `exit_success` returns
      integer, intent(in) :: code

      interface
         subroutine c_exit(status) bind(c, name='exit')
            import :: c_int
            implicit none
            !> Exit code of the process
            integer(c_int), value :: status
         end subroutine c_exit
         subroutine c_exit_at_once(status) bind(c, name='_exit')
            use, intrinsic :: iso_c_binding, only: c_int
            implicit none
            !> Exit code of the process
            integer(c_int), value :: status
         end subroutine c_exit_at_once
      end interface

      if (code == exit_success) return
      flush (output_unit)
      flush (error_unit)
      ! without memory OpenBLAS's threads, which are ended before the program, wait for it for ever
      if (code == exit_memory) call c_exit_at_once(code)
      call end_processes()
      call c_exit(code)
   end subroutine stop_with

end program litz
