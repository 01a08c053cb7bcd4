!> The processes of the program: this one.
module litz_processes
   use litz_communicator, only: communicator_t, one_process_t
   use litz_solver_names, only: solver_default
   implicit none
   private
   public :: begin_processes, end_processes, find_holders, usual_solver

   !> Solver where the command line names none; `solver_default`: that of the deck
   integer, parameter :: usual_solver = solver_default

contains

   !> Nothing to do.
   subroutine begin_processes()
   end subroutine begin_processes

   !> Nothing to do.
   subroutine end_processes()
   end subroutine end_processes

   !> The processes that hold the model.
   subroutine find_holders(holders)
      class(communicator_t), allocatable, intent(out) :: holders

      allocate (one_process_t :: holders)
   end subroutine find_holders

end module litz_processes
