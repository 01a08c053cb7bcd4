!> The number of threads of the BLAS, OpenBLAS here.
module litz_blas_threads
   use, intrinsic :: iso_c_binding, only: c_int
   implicit none
   private
   public :: set_blas_threads, default_blas_threads

   !> Somebody has chosen the number of threads
   logical, save :: chosen = .false.

   interface
      subroutine openblas_set_num_threads(threads) bind(c)
         import :: c_int
         integer(c_int), value :: threads
      end subroutine openblas_set_num_threads
   end interface

contains

   subroutine set_blas_threads(threads)
      integer, intent(in) :: threads

      chosen = .true.
      call openblas_set_num_threads(int(threads, c_int))
   end subroutine set_blas_threads

   !> One thread, unless another number was chosen: OpenBLAS left alone takes all cores, which slows the small fronts of
   !> sparse matrices down.
   subroutine default_blas_threads()
      if (.not. chosen) call openblas_set_num_threads(1_c_int)
   end subroutine default_blas_threads

end module litz_blas_threads
