!> The tables of a run's progress: `.cvg`, a line per iteration, and `.sta`, a line per increment.
!>
!> The first line names the columns, with units in brackets; blanks separate the columns, the remark comes last.
module litz_progress_tables
   use litz_kinds, only: dp
   use litz_errors, only: error_t
   use litz_model, only: model_t
   use litz_fields, only: fields, n_fields
   use litz_reports, only: iteration_report_t, increment_report_t
   use litz_text, only: to_text
   implicit none
   private
   public :: iteration_header, iteration_line, increment_header, increment_line

   !> Widths of columns of each field
   integer, parameter :: allowed_width = 17, node_width = 10

contains

   pure function iteration_header(model) result(line)
      type(model_t), intent(in) :: model
      character(len=:), allocatable :: line
      character(len=512) :: buffer
      integer :: i

      write (buffer, '(a5, 3a10)') 'step', 'increment', 'attempt', 'iteration'
      line = trim(buffer)
      do i = 1, n_fields
         if (.not. model%has_field(i)) cycle
         line = line//flux_cell(i)//cell(trim(fields(i)%flux)//'_allowed', allowed_width)
      end do
      do i = 1, n_fields
         if (.not. model%has_field(i)) cycle
         line = line//correction_cell(i)//cell('node_'//trim(fields(i)%symbol), node_width)
      end do
      write (buffer, '(a8, 2a6, a16, a12)') 'active', 'new', 'lost', 'penetration[m]', 'factor_age'
      line = line//trim(buffer)
   end function iteration_header

   pure function iteration_line(model, report) result(line)
      type(model_t), intent(in) :: model
      type(iteration_report_t), intent(in) :: report
      character(len=:), allocatable :: line
      character(len=512) :: buffer
      integer :: i

      write (buffer, '(i5, 3i10)') report%step, report%increment, report%attempt, report%iteration
      line = trim(buffer)
      do i = 1, n_fields
         if (.not. model%has_field(i)) cycle
         line = line//cell(number(report%residual(i)), len(flux_cell(i)))// &
            cell(number(report%allowed(i)), allowed_width)
      end do
      do i = 1, n_fields
         if (.not. model%has_field(i)) cycle
         line = line//cell(number(report%correction(i)), len(correction_cell(i)))// &
            cell(to_text(report%correction_node(i)), node_width)
      end do
      write (buffer, '(i8, 2i6, es16.3e3, i12)') report%contacts_active, report%contacts_new, report%contacts_lost, &
         report%penetration, report%factor_age
      line = line//trim(buffer)
   end function iteration_line

   !> The head of a column of residuals: `force[N]`.
   pure function flux_cell(field) result(text)
      !> One of litz_fields
      integer, intent(in) :: field
      character(len=:), allocatable :: text

      text = heading(fields(field)%flux, fields(field)%flux_unit, 13)
   end function flux_cell

   !> The head of a column of corrections: `displacement[m]`.
   pure function correction_cell(field) result(text)
      !> One of litz_fields
      integer, intent(in) :: field
      character(len=:), allocatable :: text

      text = heading(fields(field)%name, fields(field)%unit, 17)
   end function correction_cell

   pure function heading(name, unit, width) result(text)
      !> Of what, and its unit
      character(len=*), intent(in) :: name, unit
      !> Of the column, unless the head is longer
      integer, intent(in) :: width
      character(len=:), allocatable :: text
      integer :: i

      text = trim(name)//'['
      do i = 1, len_trim(unit)
         if (unit(i:i) /= ' ') text = text//unit(i:i)
      end do
      text = text//']'
      text = cell(text, max(width, len(text) + 2))
   end function heading

   !> A text at the right end of its column.
   pure function cell(text, width) result(padded)
      !> Head or number
      character(len=*), intent(in) :: text
      !> Of the column
      integer, intent(in) :: width
      character(len=:), allocatable :: padded

      padded = repeat(' ', max(0, width - len(text)))//text
   end function cell

   pure function number(value) result(text)
      !> Any number
      real(dp), intent(in) :: value
      character(len=:), allocatable :: text
      character(len=13) :: buffer

      write (buffer, '(es13.3e3)') value
      text = trim(adjustl(buffer))
   end function number

   pure function increment_header(model) result(line)
      type(model_t), intent(in) :: model
      character(len=:), allocatable :: line
      character(len=512) :: buffer
      integer :: i

      write (buffer, '(a5, a10, a9, a11, 2a15, a19)') 'step', 'increment', 'attempts', 'iterations', 'time[s]', &
         'step_time[s]', 'time_increment[s]'
      line = trim(buffer)
      do i = 1, n_fields
         if (.not. model%has_field(i)) cycle
         line = line//flux_cell(i)
      end do
      write (buffer, '(a16, a10, 5a18, 2x, a)') 'negative_pivots', 'contacts', 'force_balance', 'moment_balance', &
         'current_balance', 'power_balance', 'penetration_ratio', 'remark'
      line = line//trim(buffer)
   end function increment_header

   pure function increment_line(model, report) result(line)
      type(model_t), intent(in) :: model
      type(increment_report_t), intent(in) :: report
      character(len=:), allocatable :: line, remark
      character(len=512) :: buffer
      integer :: i

      write (buffer, '(i5, i10, i9, i11, 2es15.7, es19.7)') report%step, report%increment, report%attempts, &
         report%iterations, report%time, report%step_time, report%time_increment
      line = trim(buffer)
      do i = 1, n_fields
         if (.not. model%has_field(i)) cycle
         line = line//cell(number(report%residual(i)), len(flux_cell(i)))
      end do
      write (buffer, '(i16, i10, 5es18.2e3)') report%negative_pivots, report%contacts, report%audit
      line = line//trim(buffer)
      remark = ''
      if (allocated(report%remark)) remark = report%remark
      if (report%at_round_off) then
         if (len(remark) > 0) remark = remark//'; '
         remark = remark//'accepted at the limit of round-off'
      end if
      line = trim(line//'  '//remark)
   end function increment_line

end module litz_progress_tables
