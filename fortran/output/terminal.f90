!> The lines of a run on the terminal.
module litz_terminal
   use, intrinsic :: iso_fortran_env, only: output_unit
   use litz_available_memory, only: memory_text
   use litz_model, only: model_t, request_contact
   use litz_model_summary, only: displacements_line
   use litz_problem, only: problem_t
   use litz_reports, only: increment_report_t
   use litz_text, only: plural
   use litz_timing, only: peak_memory
   implicit none
   private
   public :: print_header, print_increment, print_contacts, print_end

contains

   !> What the run is called, and the columns of its increments.
   subroutine print_header(model)
      type(model_t), intent(in) :: model

      if (allocated(model%heading)) write (output_unit, '(a)') trim(model%heading)
      write (output_unit, '(a)', advance='no') displacements_line(model)
      write (output_unit, '(a)') model%units%in_header( &
         ' step   inc  att iters     time [s]  increment [s]  contacts  sum of F [N]')
   end subroutine print_header

   !> A line for an increment that was accepted or cut.
   subroutine print_increment(report)
      type(increment_report_t), intent(in) :: report
      character(len=160) :: line

      write (line, '(i5, i6, i5, i6, 2es13.5, i10, es13.5)') report%step, report%increment, report%attempts, &
         report%iterations, report%time, report%time_increment, report%contacts, report%contact_force
      write (output_unit, '(a)') trim(trim(line)//'  '//report%remark)
   end subroutine print_increment

   !> The lines that *CONTACT PRINT asks for.
   subroutine print_contacts(problem)
      type(problem_t), intent(in) :: problem
      integer :: i

      if (.not. any(problem%model%steps(problem%state%step)%requests%kind == request_contact)) return
      do i = 1, size(problem%state%contacts)
         associate (contact => problem%state%contacts(i), id => problem%model%element_id, &
            units => problem%model%units)
            write (output_unit, '(6x, a, i0, a, i0, a, i0, a, es11.4, a, es11.4, a, es11.4, a, es11.4, a)') &
               'contact ', contact%id, ' (elements ', id(contact%element_bar), ', ', id(contact%element), &
               '): gap ', contact%gap, units%after('m')//', force ', contact%force, &
               units%after('N')//', resistance ', contact%resistance, &
               units%after('ohm')//', current ', contact%current, units%after('A')
         end associate
      end do
   end subroutine print_contacts

   !> The last line of a run that came to its end.
   subroutine print_end(problem, base)
      type(problem_t), intent(in) :: problem
      !> Directory and stem of the results
      character(len=*), intent(in) :: base
      character(len=12) :: seconds

      write (seconds, '(f12.2)') problem%timing%total()
      write (output_unit, '(a)') 'finished: '//plural(problem%n_increments, 'increment')//', '// &
         plural(problem%n_iterations, 'iteration')//', '//trim(adjustl(seconds))//' s, at most '// &
         memory_text(peak_memory())//' of memory; results in '//base//'.*'
   end subroutine print_end

end module litz_terminal
