!> Does what `litz check` does for one deck after another without a new process for each.
!>
!> Without arguments: paths come line by line from the standard input. Each is answered by a line `CODE ERRORS
!> WARNINGS`, then by the model where it was accepted, then by a line with a full stop.
!> With a path as argument: this deck alone, again and again when a fuzzer asks for it.
program read_decks
   use, intrinsic :: iso_c_binding, only: c_int
   use, intrinsic :: iso_fortran_env, only: input_unit, output_unit
   use litz_check, only: check_model
   use litz_deck_reader, only: read_deck
   use litz_errors, only: error_t, error_list_t, exit_success
   use litz_model, only: model_t
   use litz_model_listing, only: print_model
   use litz_model_summary, only: model_summary
   use litz_run_warnings, only: run_warnings_t
   implicit none

   interface
      integer(c_int) function fuzz_again() bind(c)
         import :: c_int
         implicit none
      end function fuzz_again
   end interface

   character(len=4096) :: path
   type(model_t) :: model
   type(error_list_t) :: errors, warnings
   integer :: code, iostat

   if (command_argument_count() > 0) then
      call get_command_argument(1, path)
      do while (fuzz_again() /= 0)
         call check(trim(path), code)
      end do
      stop
   end if
   do
      read (input_unit, '(a)', iostat=iostat) path
      if (iostat /= 0) exit
      call check(trim(path), code)
      write (output_unit, '(i0, 2(1x, i0))') code, errors%count, warnings%count
      if (code == exit_success) call print_model(output_unit, model)
      write (output_unit, '(a)') '.'
      flush (output_unit)
   end do

contains

   !> All texts are made, as the program would print them.
   subroutine check(path, code)
      character(len=*), intent(in) :: path
      !> What the program would end with
      integer, intent(out) :: code
      type(error_t), allocatable :: error
      type(run_warnings_t) :: found
      character(len=:), allocatable :: report, text

      call read_deck(path, model, errors, warnings)
      text = warnings%text()//errors%text()
      code = exit_success
      if (errors%count > 0) then
         code = errors%items(1)%code
         return
      end if
      text = model_summary(model)
      call check_model(model, report, found, error)
      if (.not. allocated(error)) return
      text = error%text()
      code = error%code
   end subroutine check

end program read_decks
