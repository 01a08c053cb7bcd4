!> The analysis of a model from its first step to its last, and the checks that need the geometry.
module litz_analysis
   use litz_errors, only: error_t, fail, exit_internal
   use litz_model, only: model_t
   implicit none
   private
   public :: run_options_t, run_analysis, check_model

   !> What the command line asks for beyond the deck.
   type :: run_options_t
      !> The deck as the user named it; result files carry its stem
      character(len=:), allocatable :: deck_path
      !> Existing directory for the result files
      character(len=:), allocatable :: output_directory
      !> One of the solver constants of `litz_model`; 0: as the deck says
      integer :: solver = 0
      !> Number of threads; 0: the default of OpenMP
      integer :: threads = 0
      !> No progress in the terminal
      logical :: quiet = .false.
   end type run_options_t

contains

   !> Run all steps and write the result files.
   subroutine run_analysis(model, options, error)
      type(model_t), intent(in) :: model
      type(run_options_t), intent(in) :: options
      !> Carries the exit code; not allocated when every step has finished
      type(error_t), allocatable, intent(out) :: error

      error = fail(exit_internal, 'The analysis of "'//options%deck_path//'" is not part of this build')
      if (model%n_elements == 0) error = fail(exit_internal, 'The model has no elements')
   end subroutine run_analysis

   !> Search the contacts of the reference configuration once, and say what was found.
   subroutine check_model(model, report, error)
      type(model_t), intent(in) :: model
      !> Lines for the user, each ended by a new-line character
      character(len=:), allocatable, intent(out) :: report
      type(error_t), allocatable, intent(out) :: error

      report = ''
      if (model%n_elements == 0) error = fail(exit_internal, 'The model has no elements')
   end subroutine check_model

end module litz_analysis
