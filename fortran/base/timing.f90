!> Where the time of a run goes: one clock whose laps are charged to phases, so that the phases add up to the whole.
module litz_timing
   use litz_kinds, only: dp, int64
   implicit none
   private
   public :: timing_t, peak_memory
   public :: phase_reading, phase_preparation, phase_search, phase_elements, phase_contact, phase_assembly, &
      phase_analyse, phase_factor, phase_solve, phase_update, phase_check, phase_output

   integer, parameter :: phase_reading = 1, phase_preparation = 2, phase_search = 3, phase_elements = 4, &
      phase_contact = 5, phase_assembly = 6, phase_analyse = 7, phase_factor = 8, phase_solve = 9, &
      phase_update = 10, phase_check = 11, phase_output = 12

   integer, parameter :: n_phases = 12
   character(len=*), parameter :: phase_name(n_phases) = [character(len=12) :: 'reading', 'preparation', 'search', &
      'elements', 'contact', 'assembly', 'analyse', 'factor', 'solve', 'update', 'check', 'output']

   type :: timing_t
      !> Wall-clock time of each phase [s], and how often a lap was charged to it
      real(dp), private :: seconds(n_phases) = 0
      integer, private :: laps(n_phases) = 0
      integer(int64), private :: last = 0
   contains
      procedure :: start => timing_start
      procedure :: lap => timing_lap
      procedure :: total => timing_total
      procedure :: table => timing_table
   end type timing_t

contains

   subroutine timing_start(self)
      class(timing_t), intent(inout) :: self

      call system_clock(self%last)
   end subroutine timing_start

   !> Charge the time since the last lap to a phase.
   subroutine timing_lap(self, phase)
      class(timing_t), intent(inout) :: self
      !> One of `phase_...`
      integer, intent(in) :: phase
      integer(int64) :: now, rate

      call system_clock(now, rate)
      self%seconds(phase) = self%seconds(phase) + real(now - self%last, dp)/rate
      self%laps(phase) = self%laps(phase) + 1
      self%last = now
   end subroutine timing_lap

   !> All laps [s]
   pure real(dp) function timing_total(self)
      class(timing_t), intent(in) :: self

      timing_total = sum(self%seconds)
   end function timing_total

   !> A line per phase: seconds, share of the whole, seconds per iteration.
   pure function timing_table(self, n_iterations) result(table)
      class(timing_t), intent(in) :: self
      !> Number of Newton iterations of the run; 0 counts as 1
      integer, intent(in) :: n_iterations
      character(len=:), allocatable :: table
      character(len=80) :: line
      integer :: i

      table = 'phase          seconds   share   per iteration [s]'//new_line('a')
      do i = 1, n_phases
         write (line, '(a12, f10.3, f7.1, a, es14.3)') phase_name(i), self%seconds(i), &
            100*self%seconds(i)/max(self%total(), tiny(1.0_dp)), ' %', self%seconds(i)/max(1, n_iterations)
         table = table//trim(line)//new_line('a')
      end do
      write (line, '(a12, f10.3)') 'total       ', self%total()
      table = table//trim(line)//new_line('a')
   end function timing_table

   !> Most memory the process has had so far [bytes]; 0 where the system does not report it.
   integer(int64) function peak_memory() result(bytes)
      character(len=80) :: line
      integer(int64) :: kilobytes
      integer :: unit, status

      bytes = 0
      open (newunit=unit, file='/proc/self/status', status='old', action='read', iostat=status)
      if (status /= 0) return
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         if (index(line, 'VmHWM:') /= 1) cycle
         read (line(7:), *, iostat=status) kilobytes
         if (status == 0) bytes = 1024*kilobytes
         exit
      end do
      close (unit)
   end function peak_memory

end module litz_timing
