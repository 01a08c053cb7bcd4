!> The forms in which the tangent of rotational unknowns can be written, and the passage from one to another.
!>
!> A residual `r` holds, in its rotation rows, moments that are conjugate to spins. Its tangent `k` has a
!> - *spin form*: derivative with respect to spins; unsymmetric off equilibrium even when `r` is a gradient;
!> - *Hessian form*: derivative with respect to the rotation vector of an increment, at zero increment; symmetric when
!>   `r` is a gradient, with the same `r`;
!> - form in *rotation vectors*: derivative with respect to `phi`, where `R = exp(phi) R_start`, for any `phi`; rows and
!>   columns, and so `r`, belong to additive changes of `phi`.
!>
!> A node's three rotation unknowns stand together. `first(i)` says where those of node `i` begin; all other rows and
!> columns may mean anything (displacements, voltages).
module litz_rotation_forms
   use litz_kinds, only: dp
   use litz_rotations, only: skew, spin_tangent, spin_tangent_transpose_derivative
   implicit none
   private
   public :: hessian_to_spin, spin_to_hessian, spin_to_rotation_vectors, residual_to_rotation_vectors

contains

   !> Hessian form to spin form.
   !>
   !> Source: `K_spin = K_hessian - m^/2` at each node, `m` its moment; the derivative of `T(phi)^T m` at `phi = 0`.
   pure subroutine hessian_to_spin(k, r, first)
      !> Tangent (n, n)
      real(dp), intent(inout) :: k(:, :)
      !> Residual (n); the same in both forms
      real(dp), intent(in) :: r(:)
      !> Position of the first rotation unknown of each node (number of nodes)
      integer, intent(in) :: first(:)

      call add_moment_terms(-0.5_dp, k, r, first)
   end subroutine hessian_to_spin

   !> Spin form to Hessian form: the inverse of `hessian_to_spin`, with the same arguments.
   pure subroutine spin_to_hessian(k, r, first)
      !> Tangent (n, n)
      real(dp), intent(inout) :: k(:, :)
      !> Residual (n); the same in both forms
      real(dp), intent(in) :: r(:)
      !> Position of the first rotation unknown of each node (number of nodes)
      integer, intent(in) :: first(:)

      call add_moment_terms(0.5_dp, k, r, first)
   end subroutine spin_to_hessian

   pure subroutine add_moment_terms(factor, k, r, first)
      !> -1/2 from the Hessian to spins, +1/2 back
      real(dp), intent(in) :: factor
      !> Tangent (n, n) [N, m, rad]
      real(dp), intent(inout) :: k(:, :)
      !> Residual (n); its moments are used
      real(dp), intent(in) :: r(:)
      !> First rotation of each node among the unknowns (nodes)
      integer, intent(in) :: first(:)
      integer :: node, i, j

      do node = 1, size(first)
         i = first(node)
         j = i + 2
         k(i:j, i:j) = k(i:j, i:j) + factor*skew(r(i:j))
      end do
   end subroutine add_moment_terms

   !> Spin form to the form in rotation vectors, residual included.
   !>
   !> Source: `dtheta = T(phi) dphi`, so `r_phi = T^T r` and `K_phi = T^T K_spin T + d(T^T m)/dphi`, the last term with
   !> the moment `m` held fixed. Rotation rows and columns are transformed in full, with their coupling to all other
   !> unknowns.
   pure subroutine spin_to_rotation_vectors(k, r, phi, first)
      !> Tangent (n, n)
      real(dp), intent(inout) :: k(:, :)
      !> Residual (n): moments conjugate to spins in, conjugate to `phi` out
      real(dp), intent(inout) :: r(:)
      !> Rotation vector of each node (3, number of nodes) [rad]
      real(dp), intent(in) :: phi(:, :)
      !> Position of the first rotation unknown of each node (number of nodes)
      integer, intent(in) :: first(:)
      real(dp) :: t(3, 3)
      integer :: node, i, j

      do node = 1, size(first)
         i = first(node)
         j = i + 2
         t = spin_tangent(phi(:, node))
         k(:, i:j) = matmul(k(:, i:j), t)
         k(i:j, :) = matmul(transpose(t), k(i:j, :))
         k(i:j, i:j) = k(i:j, i:j) + spin_tangent_transpose_derivative(phi(:, node), r(i:j))
         r(i:j) = matmul(r(i:j), t)
      end do
   end subroutine spin_to_rotation_vectors

   !> The residual alone: `r_phi = T^T r`.
   pure subroutine residual_to_rotation_vectors(r, phi, first)
      !> Residual (n): moments conjugate to spins in, conjugate to `phi` out
      real(dp), intent(inout) :: r(:)
      !> Rotation vector of each node (3, number of nodes) [rad]
      real(dp), intent(in) :: phi(:, :)
      !> Position of the first rotation unknown of each node (number of nodes)
      integer, intent(in) :: first(:)
      integer :: node, i, j

      do node = 1, size(first)
         i = first(node)
         j = i + 2
         r(i:j) = matmul(r(i:j), spin_tangent(phi(:, node)))
      end do
   end subroutine residual_to_rotation_vectors

end module litz_rotation_forms
