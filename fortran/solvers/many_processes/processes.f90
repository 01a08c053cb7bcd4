!> The processes of the program under MPI: the first one does everything, the others take part in its factorisations.
module litz_processes
   use litz_solver_names, only: solver_mumps
   implicit none
   private
   public :: begin_processes, end_processes, usual_solver

   !> Solver where the command line names none: the one for which there are other processes
   integer, parameter :: usual_solver = solver_mumps

   interface
      !> Returns in the first process only: the others serve until that has ended
      subroutine begin_processes() bind(c, name='litz_begin_processes')
         implicit none
      end subroutine begin_processes
      !> The others end, too. Further calls do nothing.
      subroutine end_processes() bind(c, name='litz_end_processes')
         implicit none
      end subroutine end_processes
   end interface

end module litz_processes
