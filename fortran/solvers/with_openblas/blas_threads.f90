!> The number of threads of the BLAS, OpenBLAS here.
module litz_blas_threads
   use, intrinsic :: iso_c_binding, only: c_int, c_char, c_ptr, c_null_char, c_f_pointer
   use litz_kinds, only: dp
   implicit none
   private
   public :: set_blas_threads, default_blas_threads, reserve_blas_memory, blas_name

   !> What OpenBLAS takes for the work of a thread is 128 MB of addresses and a little [bytes]
   integer, parameter :: blas_memory = 140000000

   !> Somebody has chosen the number of threads
   logical :: chosen = .false.

   interface
      subroutine openblas_set_num_threads(threads) bind(c)
         import :: c_int
         implicit none
         !> Number of threads, at least 1
         integer(c_int), value :: threads
      end subroutine openblas_set_num_threads
      subroutine dsymv(uplo, n, alpha, a, lda, x, incx, beta, y, incy)
         import :: dp
         implicit none
         !> Triangle of the matrix that is looked at: `U` or `L`
         character(len=1), intent(in) :: uplo
         !> Order of the matrix
         integer, intent(in) :: n
         !> Leading dimension of `a`
         integer, intent(in) :: lda
         !> Distance between the entries of `x` and `y` that are used
         integer, intent(in) :: incx, incy
         !> Factors of `A x` and of `y`
         real(dp), intent(in) :: alpha, beta
         !> Symmetric matrix (lda, n)
         real(dp), intent(in) :: a(lda, *)
         !> Vector (n)
         real(dp), intent(in) :: x(*)
         !> In: vector (n). Out: `alpha A x + beta y`
         real(dp), intent(inout) :: y(*)
      end subroutine dsymv
      type(c_ptr) function openblas_get_config() bind(c)
         import :: c_ptr
         implicit none
      end function openblas_get_config
   end interface

contains

   subroutine set_blas_threads(threads)
      !> Number of threads, at least 1
      integer, intent(in) :: threads

      chosen = .true.
      call openblas_set_num_threads(int(threads, c_int))
   end subroutine set_blas_threads

   !> One thread, unless another number was chosen: OpenBLAS left alone takes all cores, which slows the small fronts of
   !> sparse matrices down.
   subroutine default_blas_threads()
      if (.not. chosen) call openblas_set_num_threads(1_c_int)
   end subroutine default_blas_threads

   !> Have OpenBLAS take its memory now, while there is some: later it would try for ever. .false.: there is none.
   logical function reserve_blas_memory() result(ok)
      character(len=1), allocatable :: room(:)
      real(dp) :: a(1, 1), x(1), y(1)
      integer :: status

      allocate (room(blas_memory), stat=status)
      ok = status == 0
      if (.not. ok) return
      deallocate (room)
      a = 1
      x = 1
      y = 0
      call dsymv('U', 1, 1.0_dp, a, 1, x, 1, 0.0_dp, y, 1)
   end function reserve_blas_memory

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
