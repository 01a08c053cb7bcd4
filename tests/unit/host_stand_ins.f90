!> Stand-ins for what Abaqus and FEAP give to user elements: messages, the end of the program, the reading of lines.
module host_stand_ins
   use litz_kinds, only: dp
   implicit none
   private
   public :: start_host, n_stops, n_warnings, message, line_t, lines

   !> A line of FEAP's input: numbers
   type :: line_t
      real(dp), allocatable :: numbers(:)
   end type line_t

   !> How often the program would have ended, and how often a warning was given
   integer :: n_stops = 0, n_warnings = 0
   !> The last message
   character(len=350) :: message = ''
   !> Lines that are still to be read
   type(line_t), allocatable :: lines(:)

contains

   !> Nothing has been said yet.
   subroutine start_host()
      n_stops = 0
      n_warnings = 0
      message = ''
   end subroutine start_host

end module host_stand_ins

!> Abaqus: messages; with -3 it ends the analysis.
subroutine stdb_abqerr(lop, text, integers, reals, texts)
   use litz_kinds, only: dp
   use host_stand_ins, only: message, n_warnings
   implicit none
   !> 1: information, -1: warning, -2: error, -3: error and end
   integer, intent(in) :: lop
   !> With %I, %R, %S where the numbers and texts are to appear
   character(len=*), intent(in) :: text
   !> What appears
   integer, intent(in) :: integers(*)
   real(dp), intent(in) :: reals(*)
   character(len=8), intent(in) :: texts(*)
   integer :: place

   place = index(text, '%I')
   write (message, '(a, i0, a)') text(:place - 1), integers(1), text(place + 2:)
   if (reals(1) > 0 .or. texts(1) /= '') error stop 'nothing was to be printed'
   if (lop == -1) n_warnings = n_warnings + 1
end subroutine stdb_abqerr

!> Abaqus: the end of the analysis.
subroutine xit()
   use host_stand_ins, only: n_stops
   implicit none

   n_stops = n_stops + 1
end subroutine xit

!> FEAP: the end of the program.
subroutine plstop(eflag)
   use host_stand_ins, only: n_stops
   implicit none
   !> Whether a message is printed
   logical, intent(in) :: eflag

   if (eflag) n_stops = n_stops + 1
end subroutine plstop

!> FEAP: the numbers of the next line, with zeros for those that are missing; .true. where there is none.
logical function tinput(words, n_words, numbers, n_numbers)
   use litz_kinds, only: dp
   use host_stand_ins, only: line_t, lines
   implicit none
   !> Texts of the line (n_words)
   character(len=15), intent(inout) :: words(*)
   !> How many of these, and numbers
   integer, intent(in) :: n_words, n_numbers
   !> Numbers of the line (n_numbers)
   real(dp), intent(out) :: numbers(n_numbers)
   type(line_t), allocatable :: rest(:)
   integer :: n

   words(1) = ''
   numbers = 0
   tinput = n_words > 0 .or. size(lines) == 0
   if (size(lines) == 0) return
   n = min(n_numbers, size(lines(1)%numbers))
   numbers(:n) = lines(1)%numbers(:n)
   rest = lines(2:)
   call move_alloc(rest, lines)
end function tinput
