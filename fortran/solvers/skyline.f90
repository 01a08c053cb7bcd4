!> The solver that needs no library: the whole unsymmetric matrix within its profile.
module litz_skyline
   use litz_kinds, only: int64
   use litz_sparse_factor, only: sparse_factor_t
   use litz_skyline_factor, only: skyline_factor_t
   use litz_monolithic, only: monolithic_solver_t
   implicit none
   private
   public :: skyline_solver_t

   type, extends(monolithic_solver_t) :: skyline_solver_t
   contains
      procedure, nopass :: new_factor => new_skyline_factor
      procedure, nopass :: name => skyline_name
   end type skyline_solver_t

contains

   subroutine new_skyline_factor(factor)
      class(sparse_factor_t), allocatable, intent(out) :: factor

      allocate (skyline_factor_t :: factor)
   end subroutine new_skyline_factor

   function skyline_name() result(name)
      character(len=:), allocatable :: name

      name = 'skyline'
   end function skyline_name

end module litz_skyline
