!> What can be said about a model without solving anything.
module litz_check
   use litz_errors, only: error_t
   use litz_increment_warnings, only: add_start_warnings
   use litz_initial_contacts, only: find_initial_overlap
   use litz_kinds, only: pi
   use litz_model_checks, only: conductors_by_contact
   use litz_model, only: model_t
   use litz_problem, only: problem_t, prepare_problem
   use litz_run_warnings, only: run_warnings_t
   use litz_text, only: plural
   implicit none
   private
   public :: check_model

contains

   !> Its wires, and the crossings at the start.
   subroutine check_model(model, report, warnings, error)
      type(model_t), intent(in) :: model
      !> Lines that describe the wires and their crossings
      character(len=:), allocatable, intent(out) :: report
      type(run_warnings_t), intent(out) :: warnings
      type(error_t), allocatable, intent(out) :: error
      type(problem_t) :: problem
      character(len=200) :: line
      integer :: i

      report = ''
      call prepare_problem(model, problem)
      call find_initial_overlap(problem, error)
      if (allocated(error)) return
      write (line, '(a, i0)') 'wires (chains of elements): ', problem%wires%n_wires
      report = trim(line)//new_line('a')//conductors_by_contact(model)
      if (.not. problem%contact%present) return
      report = report//'contact search: '//plural(size(problem%contact%candidates, 2), 'pair')// &
         ' of elements nearby, '//plural(size(problem%contact%points), 'crossing')//' within reach'//new_line('a')
      call add_start_warnings(problem)
      warnings = problem%warnings
      do i = 1, min(20, size(problem%contact%points))
         associate (point => problem%contact%points(i))
            write (line, '(a, i0, a, i0, a, f6.2, a, es11.3, a)') '  elements ', model%element_id(point%element_bar), &
               ' and ', model%element_id(point%element), ': crossing angle ', &
               min(point%kinematics%angle, pi - point%kinematics%angle)*180/pi, ' degrees, gap ', point%gap, &
               model%units%after('m')
            report = report//trim(line)//new_line('a')
         end associate
      end do
   end subroutine check_model

end module litz_check
