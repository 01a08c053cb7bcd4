!> The linear solvers a deck or the command line can ask for.
module litz_solver_names
   implicit none
   private
   public :: solver_default, solver_block, solver_umfpack, solver_skyline, solver_keyword

   !> `solver_default`: nobody chose; the best the program was built with
   integer, parameter :: solver_default = 0, solver_block = 1, solver_umfpack = 2, solver_skyline = 3

   !> What the user writes for each of them, in the order of the constants above without the first
   character(len=7), parameter :: solver_keyword(3) = ['BLOCK  ', 'UMFPACK', 'SKYLINE']
end module litz_solver_names
