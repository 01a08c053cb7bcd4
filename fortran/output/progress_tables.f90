!> The tables of a run's progress: `.cvg`, a line per iteration, and `.sta`, a line per increment.
!>
!> The first line names the columns, with units in brackets; blanks separate the columns, the remark comes last.
module litz_progress_tables
   use litz_kinds, only: dp
   use litz_errors, only: error_t
   use litz_model, only: model_t
   use litz_fields, only: n_fields
   use litz_reports, only: iteration_report_t, increment_report_t
   implicit none
   private
   public :: iteration_header, iteration_line, increment_header, increment_line

contains

   pure function iteration_header() result(line)
      character(len=:), allocatable :: line
      character(len=512) :: buffer

      write (buffer, '(a5, 3a10, 3(a13, a17), 3(a17, a10), a8, 2a6, a16, a12)') &
         'step', 'increment', 'attempt', 'iteration', 'force[N]', 'force_allowed', 'moment[Nm]', 'moment_allowed', &
         'current[A]', 'current_allowed', 'displacement[m]', 'node_u', 'rotation[rad]', 'node_phi', &
         'potential[V]', 'node_V', 'active', 'new', 'lost', 'penetration[m]', 'factor_age'
      line = trim(buffer)
   end function iteration_header

   pure function iteration_line(model, report) result(line)
      type(model_t), intent(in) :: model
      type(iteration_report_t), intent(in) :: report
      character(len=:), allocatable :: line
      character(len=512) :: buffer
      integer :: i

      write (buffer, '(i5, 3i10, 3(es13.3e3, es17.3e3), 3(es17.3e3, i10), i8, 2i6, es16.3e3, i12)') &
         report%step, report%increment, report%attempt, report%iteration, &
         (report%residual(i), report%allowed(i), i=1, n_fields), &
         (report%correction(i), user_id(model, report%correction_node(i)), i=1, n_fields), &
         report%contacts_active, report%contacts_new, report%contacts_lost, report%penetration, &
         report%factor_age
      line = trim(buffer)
   end function iteration_line

   pure function increment_header() result(line)
      character(len=:), allocatable :: line
      character(len=512) :: buffer

      write (buffer, '(a5, a10, a9, a11, 2a15, a19, 3a13, a16, a10, 5a18, 2x, a)') &
         'step', 'increment', 'attempts', 'iterations', 'time[s]', 'step_time[s]', 'time_increment[s]', &
         'force[N]', 'moment[Nm]', 'current[A]', 'negative_pivots', 'contacts', 'force_balance', 'moment_balance', &
         'current_balance', 'power_balance', 'penetration_ratio', 'remark'
      line = trim(buffer)
   end function increment_header

   pure function increment_line(report) result(line)
      type(increment_report_t), intent(in) :: report
      character(len=:), allocatable :: line, remark
      character(len=512) :: buffer

      write (buffer, '(i5, i10, i9, i11, 2es15.7, es19.7, 3es13.3e3, i16, i10, 5es18.2e3)') &
         report%step, report%increment, report%attempts, report%iterations, &
         report%time, report%step_time, report%time_increment, report%residual, report%negative_pivots, &
         report%contacts, report%audit
      line = trim(buffer)
      remark = ''
      if (allocated(report%remark)) remark = report%remark
      if (report%at_round_off) then
         if (len(remark) > 0) remark = remark//'; '
         remark = remark//'accepted at the limit of round-off'
      end if
      line = trim(line//'  '//remark)
   end function increment_line

   pure integer function user_id(model, node)
      type(model_t), intent(in) :: model
      !> Internal index; 0: none
      integer, intent(in) :: node

      user_id = 0
      if (node > 0) user_id = model%node_id(node)
   end function user_id

end module litz_progress_tables
