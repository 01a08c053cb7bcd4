!> The number of threads of the BLAS; this build has one that offers no control over it.
module litz_blas_threads
   implicit none
   private
   public :: set_blas_threads, default_blas_threads, reserve_blas_memory, blas_name

contains

   !> Without effect.
   subroutine set_blas_threads(threads)
      !> Number of threads that is wanted
      integer, intent(in) :: threads

      associate (unused => threads)
      end associate
   end subroutine set_blas_threads

   !> Without effect.
   subroutine default_blas_threads()
   end subroutine default_blas_threads

   !> Always .true.: nothing is known about this BLAS.
   pure logical function reserve_blas_memory() result(ok)
      ok = .true.
   end function reserve_blas_memory

   !> For `litz --version`.
   pure function blas_name() result(name)
      character(len=:), allocatable :: name

      name = 'BLAS of the system'
   end function blas_name

end module litz_blas_threads
