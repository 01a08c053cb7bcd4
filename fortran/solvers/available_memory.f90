!> How much memory the machine can still give.
module litz_available_memory
   use litz_kinds, only: int64
   implicit none
   private
   public :: available_memory, memory_text

contains

   !> [bytes] what Linux reports as available; the largest number where nothing is reported.
   integer(int64) function available_memory() result(bytes)
      character(len=80) :: line
      integer(int64) :: kilobytes
      integer :: unit, status

      bytes = huge(bytes)
      open (newunit=unit, file='/proc/meminfo', status='old', action='read', iostat=status)
      if (status /= 0) return
      do
         read (unit, '(a)', iostat=status) line
         if (status /= 0) exit
         if (index(line, 'MemAvailable:') /= 1) cycle
         read (line(14:), *, iostat=status) kilobytes
         if (status == 0) bytes = 1024*kilobytes
         exit
      end do
      close (unit)
   end function available_memory

   !> In the unit a reader likes: `3.8 GB`, `12.0 MB`.
   pure function memory_text(bytes) result(text)
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
