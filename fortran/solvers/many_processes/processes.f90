!> The processes of the program under MPI: the first one does everything, the others take part in its factorisations.
module litz_processes
   use litz_communicator, only: communicator_t, one_process_t
   use litz_solver_names, only: solver_mumps
   implicit none
   private
   public :: begin_processes, end_processes, find_holders, usual_solver

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

contains

   !> The processes that hold the model: the first one alone, as the others know nothing of it.
   subroutine find_holders(holders)
      class(communicator_t), allocatable, intent(out) :: holders

      allocate (one_process_t :: holders)
   end subroutine find_holders

end module litz_processes
