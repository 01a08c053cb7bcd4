!> This build has no MUMPS.
module litz_mumps
   use litz_sparse_factor, only: sparse_factor_t
   implicit none
   private
   public :: has_mumps, create_mumps_factor, mumps_version

   !> This build has MUMPS
   logical, parameter :: has_mumps = .false.

contains

   !> Leaves the factor not allocated.
   subroutine create_mumps_factor(symmetric, factor)
      !> The matrices are symmetric
      logical, intent(in) :: symmetric
      class(sparse_factor_t), allocatable, intent(out) :: factor

      associate (unused => symmetric)
      end associate
   end subroutine create_mumps_factor

   !> For `litz --version`.
   pure function mumps_version() result(text)
      character(len=:), allocatable :: text

      text = 'no MUMPS'
   end function mumps_version

end module litz_mumps
