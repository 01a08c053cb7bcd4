!> One line on a terminal that is written over while a run goes on: increment, iteration, contacts, times.
!>
!> It appears where a person looks on, that is when the output is a terminal, and only in runs that last.
module litz_live_progress
   use, intrinsic :: iso_c_binding, only: c_int
   use, intrinsic :: iso_fortran_env, only: output_unit, int64
   use litz_kinds, only: dp
   use litz_reports, only: iteration_report_t
   implicit none
   private
   public :: live_progress_t

   !> Least time between two versions of the line, and before the first [s]
   real(dp), parameter :: pause = 0.5_dp
   integer, parameter :: width = 100

   type :: live_progress_t
      logical, private :: active = .false., shown = .false.
      integer(int64), private :: first = 0, last = 0, rate = 1
      !> Time of all steps, of those that were over when this run began, and of what is done of all [s]
      real(dp), private :: total = 0, begin = 0
      real(dp) :: done = 0
   contains
      procedure :: start => progress_start
      procedure :: show => progress_show
      procedure :: clear => progress_clear
   end type live_progress_t

   interface
      integer(c_int) function isatty(descriptor) bind(c, name='isatty')
         import :: c_int
         implicit none
         !> Of an open file; 1 is the standard output
         integer(c_int), value :: descriptor
      end function isatty
   end interface

contains

   subroutine progress_start(self, wanted, total, done)
      class(live_progress_t), intent(inout) :: self
      !> There is to be a line, if someone looks on
      logical, intent(in) :: wanted
      !> Time of all steps, and what an earlier run has done of it [s]
      real(dp), intent(in) :: total, done
      integer(c_int) :: on_terminal

      on_terminal = isatty(1_c_int)
      self%active = wanted .and. on_terminal /= 0
      self%total = total
      self%begin = done
      self%done = done
      call system_clock(self%first, self%rate)
      self%last = self%first
   end subroutine progress_start

   subroutine progress_show(self, report)
      class(live_progress_t), intent(inout) :: self
      type(iteration_report_t), intent(in) :: report
      integer(int64) :: now
      character(len=width) :: line
      character(len=24) :: left
      real(dp) :: elapsed, share

      if (.not. self%active) return
      call system_clock(now)
      if (real(now - self%last, dp) < pause*self%rate) return
      self%last = now
      elapsed = real(now - self%first, dp)/self%rate
      left = ''
      if (self%done > self%begin) then
         share = (self%total - self%done)/(self%done - self%begin)
         left = ', about '//trim(clock(elapsed*share))//' to go'
      end if
      write (line, '(a, i0, a, i0, a, i0, a, i0, a)') 'step ', report%step, ', increment ', report%increment, &
         ', iteration ', report%iteration, ', ', report%contacts_active, ' contacts, '//trim(clock(elapsed))//trim(left)
      write (output_unit, '(2a)', advance='no') achar(13), line
      flush (output_unit)
      self%shown = .true.
   end subroutine progress_show

   !> Make room for a line that stays.
   subroutine progress_clear(self)
      class(live_progress_t), intent(inout) :: self

      if (.not. self%shown) return
      write (output_unit, '(3a)', advance='no') achar(13), repeat(' ', width), achar(13)
      self%shown = .false.
   end subroutine progress_clear

   !> Hours, minutes and seconds.
   pure function clock(seconds) result(text)
      !> [s]
      real(dp), intent(in) :: seconds
      character(len=9) :: text
      integer :: whole

      whole = nint(min(seconds, 3599999.0_dp))
      write (text, '(i3, a, i2.2, a, i2.2)') whole/3600, ':', mod(whole/60, 60), ':', mod(whole, 60)
      text = adjustl(text)
   end function clock

end module litz_live_progress
