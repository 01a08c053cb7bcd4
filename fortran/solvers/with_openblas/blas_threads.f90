!> The number of threads of the BLAS, OpenBLAS here.
module litz_blas_threads
   use, intrinsic :: iso_c_binding, only: c_int, c_char, c_ptr, c_null_char, c_f_pointer
   implicit none
   private
   public :: set_blas_threads, default_blas_threads, blas_name

   !> Somebody has chosen the number of threads
   logical, save :: chosen = .false.

   interface
      subroutine openblas_set_num_threads(threads) bind(c)
         import :: c_int
         integer(c_int), value :: threads
      end subroutine openblas_set_num_threads
      type(c_ptr) function openblas_get_config() bind(c)
         import :: c_ptr
      end function openblas_get_config
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

   !> For `litz --version`: name, version and build of the library.
   function blas_name() result(name)
      character(len=:), allocatable :: name
      integer, parameter :: longest = 200
      character(kind=c_char), pointer :: config(:)
      integer :: i

      call c_f_pointer(openblas_get_config(), config, [longest])
      name = ''
      do i = 1, longest
         if (config(i) == c_null_char) exit
         name = name//config(i)
      end do
      name = trim(name)
   end function blas_name

end module litz_blas_threads
