! Finite rotations for Python; the contracts are in fortran/base/rotations.f90 and fortran/kernels/rotation_forms.f90.
module f2py_rotations
   use iso_c_binding, only: c_double, c_int
   use litz_rotations, only: core_exp => rotation_exp, core_log => rotation_log, core_tangent => spin_tangent, &
      core_derivative => spin_tangent_transpose_derivative
   use litz_rotation_forms, only: core_h2s => hessian_to_spin, core_s2h => spin_to_hessian, &
      core_s2v => spin_to_rotation_vectors
   implicit none
contains

   subroutine rotation_exp(v, r)
      !> Rotation vector [rad]
      real(c_double), intent(in) :: v(3)
      !> Rotation matrix
      real(c_double), intent(out) :: r(3, 3)
      r = core_exp(v)
   end subroutine rotation_exp

   subroutine rotation_log(r, v)
      !> Rotation matrix
      real(c_double), intent(in) :: r(3, 3)
      !> Rotation vector [rad], of a length in [0, pi]
      real(c_double), intent(out) :: v(3)
      v = core_log(r)
   end subroutine rotation_log

   subroutine spin_tangent(v, t)
      !> Rotation vector [rad]
      real(c_double), intent(in) :: v(3)
      !> Spin over an additive change of `v` (3, 3)
      real(c_double), intent(out) :: t(3, 3)
      t = core_tangent(v)
   end subroutine spin_tangent

   subroutine spin_tangent_transpose_derivative(v, m, d)
      !> Rotation vector [rad]
      real(c_double), intent(in) :: v(3)
      !> Moment [N m] that is held fixed
      real(c_double), intent(in) :: m(3)
      !> Derivative of `T(v)^T m` with respect to `v` (3, 3) [N m]
      real(c_double), intent(out) :: d(3, 3)
      d = core_derivative(v, m)
   end subroutine spin_tangent_transpose_derivative

   subroutine hessian_to_spin(n, nodes, k, r, first, k_spin)
      !> Number of unknowns
      integer(c_int), intent(in) :: n
      !> Number of nodes
      integer(c_int), intent(in) :: nodes
      !> Tangent (n, n) in the Hessian form
      real(c_double), intent(in) :: k(n, n)
      !> Residual (n)
      real(c_double), intent(in) :: r(n)
      !> First rotation of each node among the unknowns (nodes), from 1
      integer(c_int), intent(in) :: first(nodes)
      !> Tangent (n, n) in the spin form
      real(c_double), intent(out) :: k_spin(n, n)
      k_spin = k
      call core_h2s(k_spin, r, first)
   end subroutine hessian_to_spin

   subroutine spin_to_hessian(n, nodes, k, r, first, k_hessian)
      !> Number of unknowns
      integer(c_int), intent(in) :: n
      !> Number of nodes
      integer(c_int), intent(in) :: nodes
      !> Tangent (n, n) in the spin form
      real(c_double), intent(in) :: k(n, n)
      !> Residual (n)
      real(c_double), intent(in) :: r(n)
      !> First rotation of each node among the unknowns (nodes), from 1
      integer(c_int), intent(in) :: first(nodes)
      !> Tangent (n, n) in the Hessian form
      real(c_double), intent(out) :: k_hessian(n, n)
      k_hessian = k
      call core_s2h(k_hessian, r, first)
   end subroutine spin_to_hessian

   subroutine spin_to_rotation_vectors(n, nodes, k, r, phi, first, k_phi, r_phi)
      !> Number of unknowns
      integer(c_int), intent(in) :: n
      !> Number of nodes
      integer(c_int), intent(in) :: nodes
      !> Tangent (n, n) over spins
      real(c_double), intent(in) :: k(n, n)
      !> Residual (n)
      real(c_double), intent(in) :: r(n)
      !> Rotation vectors of the nodes (3, nodes) [rad]
      real(c_double), intent(in) :: phi(3, nodes)
      !> First rotation of each node among the unknowns (nodes), from 1
      integer(c_int), intent(in) :: first(nodes)
      !> Tangent (n, n) over rotation vectors
      real(c_double), intent(out) :: k_phi(n, n)
      !> Residual (n) that belongs to rotation vectors
      real(c_double), intent(out) :: r_phi(n)
      k_phi = k
      r_phi = r
      call core_s2v(k_phi, r_phi, phi, first)
   end subroutine spin_to_rotation_vectors

end module f2py_rotations
