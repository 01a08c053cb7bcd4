!> How much memory the machine can still give.
module litz_available_memory
   use litz_kinds, only: int64
   implicit none
   private
   public :: available_memory, memory_text

contains

   !> [bytes] what Linux reports as available, within the limits of this process and of its control group; the largest
   !> number where nothing is reported.
   integer(int64) function available_memory() result(bytes)
      integer(int64) :: limit

      bytes = number_behind('/proc/meminfo', 'MemAvailable:', 1024)
      limit = number_behind('/proc/self/limits', 'Max address space', 1)
      if (limit < huge(limit)) bytes = min(bytes, limit - number_behind('/proc/self/status', 'VmSize:', 1024))
      limit = number_behind('/sys/fs/cgroup/memory.max', '', 1)
      if (limit < huge(limit)) bytes = min(bytes, limit - number_behind('/sys/fs/cgroup/memory.current', '', 1))
      bytes = max(0_int64, bytes)
   end function available_memory

   !> The number behind a word at the beginning of a line, in bytes; the largest number when there is none.
   integer(int64) function number_behind(file, word, unit_of_file) result(bytes)
      !> Path of a file of the system
      character(len=*), intent(in) :: file
      !> What its line begins with
      character(len=*), intent(in) :: word
      !> [bytes]
      integer, intent(in) :: unit_of_file
      character(len=200) :: line
      integer(int64) :: number
      integer :: unit, status

      bytes = huge(bytes)
      open (newunit=unit, file=file, status='old', action='read', iostat=status)
      if (status /= 0) return
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         if (index(line, word) /= 1) cycle
         read (line(len(word) + 1:), *, iostat=status) number
         if (status == 0 .and. number < huge(number)/unit_of_file) bytes = unit_of_file*number
         exit
      end do
      close (unit)
   end function number_behind

   !> In the unit a reader likes: `3.8 GB`, `12.0 MB`.
   pure function memory_text(bytes) result(text)
      !> Amount of memory [bytes]
      integer(int64), intent(in) :: bytes
      character(len=:), allocatable :: text
      character(len=24) :: number

      if (bytes >= 10_int64**9) then
         write (number, '(f0.1, a)') real(bytes)*1.0e-9, ' GB'
      else
         write (number, '(f0.3, a)') real(bytes)*1.0e-6, ' MB'
      end if
      text = trim(adjustl(number))
      if (text(1:1) == '.') text = '0'//text
   end function memory_text

end module litz_available_memory
