!> The processes of the program: this one.
module litz_processes
   use litz_solver_names, only: solver_default
   implicit none
   private
   public :: begin_processes, end_processes, usual_solver

   !> Solver where the command line names none; `solver_default`: that of the deck
   integer, parameter :: usual_solver = solver_default

contains

   !> Nothing to do.
   subroutine begin_processes()
   end subroutine begin_processes

   !> Nothing to do.
   subroutine end_processes()
   end subroutine end_processes

end module litz_processes
