!> Numeric kinds and mathematical constants shared by every module.
module litz_kinds
   use, intrinsic :: iso_fortran_env, only: real32, real64, int64
   implicit none
   private
   public :: dp, sp, int64, pi

   !> Working precision of all physics
   integer, parameter :: dp = real64
   !> Half the memory, for what is rough anyway
   integer, parameter :: sp = real32
   real(dp), parameter :: pi = acos(-1.0_dp)
end module litz_kinds
