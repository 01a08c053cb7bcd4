!> Unsymmetric linear equations whose matrix is known by its products: GMRES with a preconditioner.
!>
!> The preconditioner acts from the right, so that what is measured is the true residual, and may change from step to
!> step. Sources: Y. Saad, M. H. Schultz, SIAM J. Sci. Stat. Comput. 7 (1986) 856; Y. Saad, SIAM J. Sci. Comput. 14
!> (1993) 461.
module litz_gmres
   use litz_kinds, only: dp
   implicit none
   private
   public :: linear_map_t, gmres

   !> Vectors that are kept before it starts again from where it is
   integer, parameter :: max_vectors = 40

   !> A matrix and its preconditioner.
   type, abstract :: linear_map_t
   contains
      procedure(linear_map), deferred :: apply
      procedure(linear_map), deferred :: precondition
   end type linear_map_t

   abstract interface
      subroutine linear_map(self, x, y)
         import :: linear_map_t, dp
         implicit none
         class(linear_map_t), intent(inout) :: self
         !> (n)
         real(dp), intent(in) :: x(:)
         !> (n)
         real(dp), intent(out) :: y(:)
      end subroutine linear_map
   end interface

contains

   !> Solve `K x = b` from `x = 0`, to a residual of `tolerance` times that of the start, or as near as `max_steps`
   !> come.
   subroutine gmres(map, b, tolerance, max_steps, x, converged)
      class(linear_map_t), intent(inout) :: map
      !> (n)
      real(dp), intent(in) :: b(:)
      !> Of the norm of the residual
      real(dp), intent(in) :: tolerance
      !> Products with the matrix at most
      integer, intent(in) :: max_steps
      !> (n)
      real(dp), intent(out) :: x(:)
      !> It has come there
      logical, intent(out), optional :: converged
      real(dp) :: left(size(b)), allowed
      integer :: done

      x = 0
      left = b
      allowed = tolerance*norm2(b)
      done = 0
      do while (norm2(left) > allowed .and. done < max_steps)
         call grow(map, left, allowed, min(max_vectors, max_steps - done), x, done)
         call map%apply(x, left)
         left = b - left
      end do
      if (present(converged)) converged = norm2(left) <= allowed
   end subroutine gmres

   !> Add to `x` the best correction in the Krylov space of the residual.
   subroutine grow(map, left, allowed, n_vectors, x, done)
      class(linear_map_t), intent(inout) :: map
      !> Residual of `x` (n), and the norm at which to stop
      real(dp), intent(in) :: left(:), allowed
      !> Vectors at most
      integer, intent(in) :: n_vectors
      !> (n)
      real(dp), intent(inout) :: x(:)
      !> Products with the matrix so far
      integer, intent(inout) :: done
      real(dp), allocatable :: v(:, :), z(:, :)
      real(dp) :: h(n_vectors + 1, n_vectors), g(n_vectors + 1), cosine(n_vectors), sine(n_vectors), radius
      integer :: i, k, n

      allocate (v(size(left), n_vectors + 1), z(size(left), n_vectors))
      h = 0
      g = 0
      g(1) = norm2(left)
      v(:, 1) = left/g(1)
      n = 0
      do k = 1, n_vectors
         call map%precondition(v(:, k), z(:, k))
         call map%apply(z(:, k), v(:, k + 1))
         done = done + 1
         do i = 1, k
            h(i, k) = dot_product(v(:, i), v(:, k + 1))
            v(:, k + 1) = v(:, k + 1) - h(i, k)*v(:, i)
         end do
         h(k + 1, k) = norm2(v(:, k + 1))
         if (h(k + 1, k) > 0) v(:, k + 1) = v(:, k + 1)/h(k + 1, k)
         do i = 1, k - 1
            h(i:i + 1, k) = turned(cosine(i), sine(i), h(i:i + 1, k))
         end do
         radius = norm2(h(k:k + 1, k))
         if (.not. radius > 0) exit
         n = k
         cosine(k) = h(k, k)/radius
         sine(k) = h(k + 1, k)/radius
         h(k:k + 1, k) = [radius, 0.0_dp]
         g(k:k + 1) = turned(cosine(k), sine(k), g(k:k + 1))
         if (.not. abs(g(k + 1)) > allowed) exit
      end do
      do i = n, 1, -1
         g(i) = (g(i) - dot_product(h(i, i + 1:n), g(i + 1:n)))/h(i, i)
      end do
      x = x + matmul(z(:, :n), g(:n))
   end subroutine grow

   !> A plane rotation.
   pure function turned(cosine, sine, pair)
      !> Of its angle
      real(dp), intent(in) :: cosine, sine
      !> (2)
      real(dp), intent(in) :: pair(2)
      real(dp) :: turned(2)

      turned = [cosine*pair(1) + sine*pair(2), cosine*pair(2) - sine*pair(1)]
   end function turned

end module litz_gmres
