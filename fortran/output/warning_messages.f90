!> Warnings as the user meets them while a run goes on: on standard error, also of a quiet run.
module litz_warning_messages
   use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
   use litz_run_warnings, only: run_warnings_t
   implicit none
   private
   public :: has_new_warnings, print_new_warnings, print_warning_count

   !> Messages of one kind on standard error: a mat may have thousands of contacts that are alike
   integer, parameter :: max_messages = 10

contains

   !> Some were not told to the user yet.
   pure logical function has_new_warnings(warnings)
      type(run_warnings_t), intent(in) :: warnings

      has_new_warnings = warnings%n_shown < warnings%n
   end function has_new_warnings

   !> Those that are new go to the user.
   subroutine print_new_warnings(warnings)
      type(run_warnings_t), intent(inout) :: warnings
      integer :: i

      if (.not. has_new_warnings(warnings)) return
      flush (output_unit)
      do i = warnings%n_shown + 1, warnings%n
         call print_warning(warnings, i)
      end do
      flush (error_unit)
      warnings%n_shown = warnings%n
   end subroutine print_new_warnings

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
            write (error_unit, '(3a)') 'warning: further warnings of kind ', trim(item%kind), ' are not shown here'
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
