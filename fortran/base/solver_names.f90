!> The linear solvers a deck or the command line can ask for.
module litz_solver_names
   implicit none
   private
   public :: solver_default, solver_block, solver_umfpack, solver_skyline, solver_mumps
   public :: solver_keyword, solves_by_blocks

   !> `solver_default`: nobody chose; the best the program was built with
   integer, parameter :: solver_default = 0, solver_block = 1, solver_umfpack = 2, solver_skyline = 3, &
      solver_mumps = 4

   !> What the user writes for each of them, in the order of the constants above without the first
   character(len=7), parameter :: solver_keyword(4) = ['BLOCK  ', 'UMFPACK', 'SKYLINE', 'MUMPS  ']

contains

   !> Every group of fields has a matrix of its own, so that symmetric ones are factored as such.
   elemental logical function solves_by_blocks(kind)
      !> A constant of this module, not `solver_default`
      integer, intent(in) :: kind

      solves_by_blocks = kind == solver_block .or. kind == solver_mumps
   end function solves_by_blocks

end module litz_solver_names
