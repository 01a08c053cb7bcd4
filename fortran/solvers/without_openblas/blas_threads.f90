!> The number of threads of the BLAS; this build has one that offers no control over it.
module litz_blas_threads
   implicit none
   private
   public :: set_blas_threads, default_blas_threads

contains

   !> Without effect.
   subroutine set_blas_threads(threads)
      integer, intent(in) :: threads

      associate (unused => threads)
      end associate
   end subroutine set_blas_threads

   !> Without effect.
   subroutine default_blas_threads()
   end subroutine default_blas_threads

end module litz_blas_threads
