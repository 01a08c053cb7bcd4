!> Warnings as the user meets them while a run goes on: on standard error, also of a quiet run, and in its files.
module litz_warning_messages
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use litz_errors, only: error_t
   use litz_newton, only: problem_t
   use litz_results, only: results_t
   use litz_run_warnings, only: run_warnings_t
   implicit none
   private
   public :: issue_warnings, print_warning_count

   !> Messages of one kind on standard error: a mat may have thousands of contacts that are alike
   integer, parameter :: max_messages = 10

contains

   !> What is new goes to the user and into the files.
   subroutine issue_warnings(problem, results, error)
      type(problem_t), intent(inout) :: problem
      type(results_t), intent(inout) :: results
      type(error_t), allocatable, intent(inout) :: error
      integer :: i

      call results%write_warnings(problem%warnings, error)
      if (problem%warnings%n_shown == problem%warnings%n) return
      call problem%progress%clear
      flush (output_unit)
      do i = problem%warnings%n_shown + 1, problem%warnings%n
         call print_warning(problem%warnings, i)
      end do
      flush (error_unit)
      problem%warnings%n_shown = problem%warnings%n
   end subroutine issue_warnings

   subroutine print_warning(warnings, i)
      type(run_warnings_t), intent(in) :: warnings
      !> The entry
      integer, intent(in) :: i
      integer :: n_before

      associate (item => warnings%items(i))
         n_before = count(warnings%items(:i - 1)%kind == item%kind)
         if (n_before < max_messages) then
            write (error_unit, '(2a)') 'warning: ', item%message
         else if (n_before == max_messages) then
            write (error_unit, '(3a)') 'warning: more of the kind ', trim(item%kind), ' are not shown here'
         end if
      end associate
   end subroutine print_warning

   !> The last line about warnings, where there are any.
   subroutine print_warning_count(warnings, path)
      type(run_warnings_t), intent(in) :: warnings
      !> The file that has them all
      character(len=*), intent(in) :: path

      if (warnings%n == 0) return
      flush (output_unit)
      write (error_unit, '(3a)') warnings%counts(), '; see ', path
   end subroutine print_warning_count

end module litz_warning_messages
