!> Eigenvalues of symmetric matrices.
module litz_symmetric_matrices
   use litz_kinds, only: dp
   implicit none
   private
   public :: dsyev

   interface
      !> LAPACK: eigenvalues and eigenvectors of a real symmetric matrix
      pure subroutine dsyev(jobz, uplo, n, a, lda, w, work, lwork, info)
         import :: dp
         implicit none
         !> `V`: eigenvectors too, `N`: eigenvalues alone
         character(len=1), intent(in) :: jobz
         !> `U`: the upper triangle of `a` is given
         character(len=1), intent(in) :: uplo
         !> Order of the matrix
         integer, intent(in) :: n
         !> Leading dimension of `a`
         integer, intent(in) :: lda
         !> Size of `work`, at least 3 n - 1
         integer, intent(in) :: lwork
         !> In: the matrix (lda, n). Out: its eigenvectors as columns
         real(dp), intent(inout) :: a(lda, *)
         !> Eigenvalues (n), ascending
         real(dp), intent(out) :: w(*)
         !> Room for the computation (lwork)
         real(dp), intent(out) :: work(*)
         !> 0: all is well
         integer, intent(out) :: info
      end subroutine dsyev
   end interface

end module litz_symmetric_matrices
