!> What the user asks the program to do.
module litz_command_line
   use litz_errors, only: error_t, fail, exit_input
   use litz_numbers, only: parse_integer, number_ok
   use litz_solver_names, only: solver_keyword
   use litz_text, only: upper, shown, join_words, nearest_word, word_length
   implicit none
   private
   public :: command_t, read_command, help_text
   public :: action_run, action_check, action_keywords, action_version, action_help

   integer, parameter :: action_help = 0, action_run = 1, action_check = 2, action_keywords = 3, action_version = 4

   character(len=word_length), parameter :: commands(*) = [character(len=word_length) :: 'run', 'check', 'keywords', &
      'help', '--help', '--version']
   !> Those of the Python package, which its own `litz` takes; here they are for messages
   character(len=word_length), parameter :: python_commands(*) = [character(len=word_length) :: 'summary', 'table', &
      'plot', 'report', 'view', 'new', 'convert', 'export', 'network']
   character(len=word_length), parameter :: run_options(*) = [character(len=word_length) :: '-o', '--output', &
      '--solver', &
      '--threads', '--restart', '--quiet', '--timing']
   character(len=word_length), parameter :: keywords_options(*) = [character(len=word_length) :: '--markdown', &
      '--json']
   character(len=word_length), parameter :: no_options(0) = [character(len=word_length) ::]

   character(len=word_length), parameter :: commands_with_help(*) = [character(len=word_length) :: 'run', 'check', &
      'keywords']

   type :: command_t
      integer :: action = action_help
      !> Deck, keyword, or command that help is about
      character(len=:), allocatable :: argument
      !> Directory for result files
      character(len=:), allocatable :: output_directory
      !> 0: as the deck says
      integer :: solver = 0
      !> 0: as OpenMP says
      integer :: threads = 0
      !> Restart file, empty: none; step and increment to go on from, 0: the last one in the file
      character(len=:), allocatable :: restart_path
      integer :: restart_step = 0, restart_increment = 0
      logical :: quiet = .false., timing = .false., markdown = .false., json = .false.
   end type command_t

contains

   !> Understand the arguments of the program.
   subroutine read_command(command, error)
      type(command_t), intent(out) :: command
      type(error_t), allocatable, intent(out) :: error
      character(len=:), allocatable :: word
      integer :: next
      logical :: found

      command%argument = ''
      command%output_directory = '.'
      command%restart_path = ''
      if (command_argument_count() == 0) return
      next = 1
      word = argument(next)
      next = next + 1
      if (any(commands_with_help == word)) then
         call look_for_help(found)
         if (found) then
            command%argument = word
            return
         end if
      end if
      select case (word)
      case ('run')
         command%action = action_run
         call read_rest(command, next, run_options, 'run', error)
      case ('check')
         command%action = action_check
         call read_rest(command, next, no_options, 'check', error)
      case ('keywords')
         command%action = action_keywords
         call read_keyword(command, next, error)
      case ('--version', '-V')
         command%action = action_version
         call read_rest(command, next, no_options, word, error)
      case ('help', '--help', '-h')
         command%action = action_help
         if (command_argument_count() > 1) then
            command%argument = argument(2)
            if (.not. any(commands_with_help == command%argument)) error = unknown_command(command%argument)
         end if
      case default
         error = unknown_command(word)
      end select
      if (allocated(error)) return
      if ((command%action == action_run .or. command%action == action_check) .and. len(command%argument) == 0) then
         error = fail(exit_input, 'litz '//word//' needs a deck: litz '//word//' deck.inp')
      end if
   end subroutine read_command

   !> Is there a --help behind the command?
   subroutine look_for_help(found)
      !> .true.: some word behind the command asks for help
      logical, intent(out) :: found
      character(len=:), allocatable :: word
      integer :: i

      found = .false.
      do i = 2, command_argument_count()
         word = argument(i)
         if (word == '--help' .or. word == '-h') found = .true.
      end do
   end subroutine look_for_help

   function argument(i) result(word)
      !> Number of the word on the command line
      integer, intent(in) :: i
      character(len=:), allocatable :: word
      integer :: length

      call get_command_argument(i, length=length)
      allocate (character(len=length) :: word)
      if (length > 0) call get_command_argument(i, word)
   end function argument

   function unknown_command(word) result(error)
      !> The first word, as the user wrote it
      character(len=*), intent(in) :: word
      type(error_t) :: error
      character(len=:), allocatable :: message, nearest

      if (any(python_commands == word)) then
         error = fail(exit_input, 'litz '//word//' is a command of the Python package of litz, which is not'// &
            ' part of this program')
         return
      end if
      message = 'unknown command '//shown(word)
      nearest = nearest_word(word, [commands, python_commands])
      if (len(nearest) > 0) then
         message = message//'; did you mean litz '//nearest//'? The commands are '
      else if (index(word, '.inp') > 0) then
         message = message//'; did you mean litz run '//word//'? The commands are '
      else
         message = message//'; the commands are '
      end if
      message = message//join_words(commands, 'and')//'; those of the Python package are '// &
         join_words(python_commands, 'and')
      error = fail(exit_input, message)
   end function unknown_command

   !> Options and the one argument that is not an option.
   subroutine read_rest(command, next, allowed, name, error)
      type(command_t), intent(inout) :: command
      !> First argument to read
      integer, intent(inout) :: next
      !> Options that the command takes (n)
      character(len=*), intent(in) :: allowed(:)
      !> Of the command, for messages
      character(len=*), intent(in) :: name
      type(error_t), allocatable, intent(out) :: error
      character(len=:), allocatable :: word

      do while (next <= command_argument_count() .and. .not. allocated(error))
         word = argument(next)
         next = next + 1
         if (index(word, '-') == 1 .and. len(word) > 1) then
            call read_option(command, word, next, allowed, name, error)
         else if (len(command%argument) == 0 .and. command%action /= action_version) then
            command%argument = word
         else
            error = fail(exit_input, 'litz '//name//': unexpected argument '//shown(word))
         end if
      end do
   end subroutine read_rest

   !> `--option value` or `--option=value`
   subroutine read_option(command, word, next, allowed, name, error)
      type(command_t), intent(inout) :: command
      !> The word of the command line that begins with `-`
      character(len=*), intent(in) :: word
      !> Number of the next word of the command line; moved past the value of an option
      integer, intent(inout) :: next
      !> Options that the command takes (n)
      character(len=*), intent(in) :: allowed(:)
      !> Name of the command, for messages
      character(len=*), intent(in) :: name
      type(error_t), allocatable, intent(out) :: error
      character(len=:), allocatable :: option, value
      integer :: equals

      equals = index(word, '=')
      option = word
      if (equals > 0) option = word(:equals - 1)
      if (.not. any(allowed == option)) then
         error = unknown_option(option, allowed, name)
         return
      end if
      select case (option)
      case ('--quiet', '--timing', '--markdown', '--json')
         if (equals > 0) error = fail(exit_input, 'the option '//option//' takes no value')
         command%quiet = command%quiet .or. option == '--quiet'
         command%timing = command%timing .or. option == '--timing'
         command%markdown = command%markdown .or. option == '--markdown'
         command%json = command%json .or. option == '--json'
         return
      end select
      if (equals > 0) then
         value = word(equals + 1:)
      else if (next <= command_argument_count()) then
         value = argument(next)
         next = next + 1
      else
         value = ''
      end if
      if (len(value) == 0) then
         error = fail(exit_input, 'the option '//option//' needs a value')
         return
      end if
      select case (option)
      case ('-o', '--output')
         command%output_directory = value
      case ('--solver')
         call read_solver(value, command%solver, error)
      case ('--threads')
         call read_threads(value, command%threads, error)
      case ('--restart')
         call read_restart(command, value)
      end select
   end subroutine read_option

   function unknown_option(option, allowed, name) result(error)
      !> As the user wrote it, without a value
      character(len=*), intent(in) :: option
      !> Options that the command takes (n)
      character(len=*), intent(in) :: allowed(:)
      !> Name of the command, for messages
      character(len=*), intent(in) :: name
      type(error_t) :: error
      character(len=:), allocatable :: message, nearest

      message = 'unknown option '//shown(option)//' of litz '//name
      nearest = nearest_word(option, allowed)
      if (len(nearest) > 0) then
         message = message//'; did you mean '//nearest//'?'
      else if (size(allowed) == 0) then
         message = message//', which has no options'
      else
         message = message//'; there is '//join_words(allowed, 'and')
      end if
      error = fail(exit_input, message)
   end function unknown_option

   subroutine read_solver(value, solver, error)
      !> Name of the solver as the user wrote it
      character(len=*), intent(in) :: value
      !> A constant of litz_solver_names
      integer, intent(out) :: solver
      type(error_t), allocatable, intent(out) :: error
      character(len=:), allocatable :: nearest

      do solver = 1, size(solver_keyword)
         if (solver_keyword(solver) == upper(value)) return
      end do
      solver = 0
      nearest = nearest_word(value, solver_keyword)
      if (len(nearest) > 0) nearest = '; did you mean '//nearest//'?'
      error = fail(exit_input, 'unknown solver '//shown(value)//'; there is '//join_words(solver_keyword, 'and')// &
         nearest)
   end subroutine read_solver

   subroutine read_threads(value, threads, error)
      !> Number as the user wrote it
      character(len=*), intent(in) :: value
      !> Number of threads, at least 1; 0 after an error
      integer, intent(out) :: threads
      type(error_t), allocatable, intent(out) :: error
      integer :: status

      call parse_integer(value, threads, status)
      if (status /= number_ok .or. threads < 1) then
         threads = 0
         error = fail(exit_input, 'the number of threads must be a whole number of at least 1; found '//shown(value))
      end if
   end subroutine read_threads

   !> `FILE` or `FILE:step:increment`
   subroutine read_restart(command, value)
      type(command_t), intent(inout) :: command
      !> As the user wrote it
      character(len=*), intent(in) :: value
      integer :: first, second, step, increment, status(2)

      command%restart_path = value
      second = index(value, ':', back=.true.)
      if (second == 0) return
      first = index(value(:second - 1), ':', back=.true.)
      if (first < 2) return
      call parse_integer(value(first + 1:second - 1), step, status(1))
      call parse_integer(value(second + 1:), increment, status(2))
      ! a name may hold colons itself
      if (any(status /= number_ok)) return
      if (step < 1 .or. increment < 1) return
      command%restart_path = value(:first - 1)
      command%restart_step = step
      command%restart_increment = increment
   end subroutine read_restart

   !> `litz keywords`, with a keyword that may be several words and may begin with an asterisk.
   subroutine read_keyword(command, next, error)
      type(command_t), intent(inout) :: command
      !> Number of the next word of the command line; behind the last one at the end
      integer, intent(inout) :: next
      type(error_t), allocatable, intent(out) :: error
      character(len=:), allocatable :: word

      do while (next <= command_argument_count() .and. .not. allocated(error))
         word = argument(next)
         next = next + 1
         if (index(word, '-') == 1) then
            call read_option(command, word, next, keywords_options, 'keywords', error)
         else
            if (index(word, '*') == 1) word = word(2:)
            command%argument = command%argument//word
         end if
      end do
   end subroutine read_keyword

   !> About one command, or about all when it is empty.
   pure function help_text(command) result(text)
      !> Name of the command, or empty
      character(len=*), intent(in) :: command
      character(len=:), allocatable :: text
      character(len=1), parameter :: nl = new_line('a')

      text = 'litz - beams and wires in electro-mechanical contact'//nl//nl
      if (command == '' .or. command == 'run') text = text// &
         '  litz run DECK.inp [-o DIR] [--solver S] [--threads N] [--quiet] [--timing]'//nl// &
         '           [--restart FILE[:STEP:INCREMENT]]'//nl// &
         '      run all steps; result files go to DIR, which is created if necessary,'//nl// &
         '      or to the current directory; S is BLOCK, UMFPACK, MUMPS or SKYLINE;'//nl// &
         '      --restart continues from an increment saved by *RESTART, WRITE: the last one,'//nl// &
         '      or the one given;'//nl// &
         '      --timing prints a breakdown of time and memory at the end'//nl
      if (command == '' .or. command == 'check') text = text// &
         '  litz check DECK.inp'//nl// &
         '      read and check the deck, print the model, search for contacts, stop'//nl
      if (command == '' .or. command == 'keywords') text = text// &
         '  litz keywords [NAME | --markdown | --json]'//nl// &
         '      keywords of decks: a list, one keyword, the whole reference, or all as JSON;'//nl// &
         '      for a keyword of Abaqus or CalculiX that litz does not have: what to use instead'//nl
      if (command == '') text = text// &
         '  litz --version'//nl// &
         '      version, compiler, libraries'//nl// &
         '  litz COMMAND --help'//nl// &
         '      help on one command'//nl
      if (command /= 'keywords') text = text//nl// &
         'Exit codes: 0 every step finished, 1 input, 2 not converged, 3 linear solver, 4 files, 5 internal,'// &
         ' 6 memory.'//nl
   end function help_text

end module litz_command_line
