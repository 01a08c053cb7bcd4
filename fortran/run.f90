!> A run from the resolved model to the closed result files.
module litz_run
   use, intrinsic :: iso_fortran_env, only: output_unit
   use litz_communicator, only: communicator_t
   use litz_errors, only: error_t, error_list_t
   use litz_increment_warnings, only: add_deck_warnings, add_start_warnings
   use litz_initial_contacts, only: find_initial_overlap
   use litz_model, only: model_t
   use litz_problem, only: problem_t, prepare_problem
   use litz_processes, only: find_holders
   use litz_restart_file, only: read_restart
   use litz_run_output, only: run_output_t
   use litz_step_control, only: course_t
   use litz_steps, only: run_step
   use litz_timing, only: timing_t, phase_preparation, phase_search, phase_output
!$ use omp_lib, only: omp_set_num_threads
   implicit none
   private
   public :: run_options_t, run_model

   type :: run_options_t
      character(len=:), allocatable :: deck_path
      !> Empty: the current directory
      character(len=:), allocatable :: output_directory
      !> One of the solver constants of the model; 0: as the deck says
      integer :: solver = 0
      !> 0: as the environment says
      integer :: threads = 0
      !> Restart file to go on from, empty: none; step and increment in it, 0: the last one
      character(len=:), allocatable :: restart_path
      integer :: restart_step = 0, restart_increment = 0
      !> No progress on the terminal
      logical :: quiet = .false.
      !> Print where time and memory went
      logical :: print_timing = .false.
      !> What reading the deck has warned of
      type(error_list_t) :: deck_warnings
      !> Running since the program began
      type(timing_t) :: timing
   end type run_options_t

contains

   !> Run all steps.
   subroutine run_model(model, options, error)
      type(model_t), intent(in) :: model
      type(run_options_t), intent(in) :: options
      type(error_t), allocatable, intent(out) :: error
      type(problem_t) :: problem
      type(run_output_t) :: output
      type(course_t) :: course
      logical :: continued
      integer :: i

!$    if (options%threads > 0) call omp_set_num_threads(options%threads)
      output%base = result_base(options)
      output%quiet = options%quiet
      call prepare(model, options, problem, error)
      if (allocated(error)) return
      continued = len(options%restart_path) > 0
      if (continued) then
         call output%check_continued(options%restart_path, error)
         call read_restart(options%restart_path, options%restart_step, options%restart_increment, problem, course, &
            error)
         if (allocated(error)) return
      end if
      call add_deck_warnings(options%deck_warnings, problem%warnings)
      if (.not. continued) call add_start_warnings(problem)
      call output%open(problem, error)
      if (allocated(error)) return
      call output%start(problem, error)
      call problem%timing%lap(phase_output)
      do i = max(1, problem%state%step), size(model%steps)
         if (allocated(error)) exit
         call run_step(problem, i, options%solver, continued, course, output, error)
         continued = .false.
      end do
      call output%close(problem, error)
      call problem%timing%lap(phase_output)
      if (options%print_timing) write (output_unit, '(a)', advance='no') problem%timing%table(problem%n_iterations)
      call output%end(problem, .not. allocated(error))
   end subroutine run_model

   !> The undeformed model, and the crossings of its wires.
   subroutine prepare(model, options, problem, error)
      type(model_t), intent(in) :: model
      type(run_options_t), intent(in) :: options
      type(problem_t), intent(out) :: problem
      type(error_t), allocatable, intent(out) :: error
      class(communicator_t), allocatable :: holders

      call find_holders(holders)
      call prepare_problem(model, problem, holders)
      problem%timing = options%timing
      call problem%timing%lap(phase_preparation)
      call find_initial_overlap(problem, error)
      if (allocated(error)) return
      call problem%timing%lap(phase_search)
   end subroutine prepare

   !> Directory and stem that the result files share.
   pure function result_base(options) result(base)
      type(run_options_t), intent(in) :: options
      character(len=:), allocatable :: base

      base = deck_stem(options%deck_path)
      if (len_trim(options%output_directory) > 0) base = trim(options%output_directory)//'/'//base
   end function result_base

   !> File name without directory and ending.
   pure function deck_stem(path) result(stem)
      !> The deck file
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: stem
      integer :: dot

      stem = path(index(path, '/', back=.true.) + 1:)
      dot = index(stem, '.', back=.true.)
      if (dot > 1) stem = stem(:dot - 1)
   end function deck_stem

end module litz_run
