!> The solver that factors the whole unsymmetric matrix with UMFPACK.
module litz_umfpack
   use litz_sparse_factor, only: sparse_factor_t
   use litz_umfpack_factor, only: umfpack_factor_t
   use litz_monolithic, only: monolithic_solver_t
   implicit none
   private
   public :: umfpack_solver_t

   type, extends(monolithic_solver_t) :: umfpack_solver_t
   contains
      procedure, nopass :: new_factor => new_umfpack_factor
      procedure, nopass :: name => umfpack_name
   end type umfpack_solver_t

contains

   subroutine new_umfpack_factor(factor)
      class(sparse_factor_t), allocatable, intent(out) :: factor

      allocate (umfpack_factor_t :: factor)
   end subroutine new_umfpack_factor

   function umfpack_name() result(name)
      character(len=:), allocatable :: name

      name = 'UMFPACK'
   end function umfpack_name

end module litz_umfpack
