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
      real(c_double), intent(in) :: v(3)
      real(c_double), intent(out) :: r(3, 3)
      r = core_exp(v)
   end subroutine rotation_exp

   subroutine rotation_log(r, v)
      real(c_double), intent(in) :: r(3, 3)
      real(c_double), intent(out) :: v(3)
      v = core_log(r)
   end subroutine rotation_log

   subroutine spin_tangent(v, t)
      real(c_double), intent(in) :: v(3)
      real(c_double), intent(out) :: t(3, 3)
      t = core_tangent(v)
   end subroutine spin_tangent

   subroutine spin_tangent_transpose_derivative(v, m, d)
      real(c_double), intent(in) :: v(3), m(3)
      real(c_double), intent(out) :: d(3, 3)
      d = core_derivative(v, m)
   end subroutine spin_tangent_transpose_derivative

   subroutine hessian_to_spin(n, nodes, k, r, first, k_spin)
      integer(c_int), intent(in) :: n, nodes
      real(c_double), intent(in) :: k(n, n), r(n)
      integer(c_int), intent(in) :: first(nodes)
      real(c_double), intent(out) :: k_spin(n, n)
      k_spin = k
      call core_h2s(k_spin, r, first)
   end subroutine hessian_to_spin

   subroutine spin_to_hessian(n, nodes, k, r, first, k_hessian)
      integer(c_int), intent(in) :: n, nodes
      real(c_double), intent(in) :: k(n, n), r(n)
      integer(c_int), intent(in) :: first(nodes)
      real(c_double), intent(out) :: k_hessian(n, n)
      k_hessian = k
      call core_s2h(k_hessian, r, first)
   end subroutine spin_to_hessian

   subroutine spin_to_rotation_vectors(n, nodes, k, r, phi, first, k_phi, r_phi)
      integer(c_int), intent(in) :: n, nodes
      real(c_double), intent(in) :: k(n, n), r(n), phi(3, nodes)
      integer(c_int), intent(in) :: first(nodes)
      real(c_double), intent(out) :: k_phi(n, n), r_phi(n)
      k_phi = k
      r_phi = r
      call core_s2v(k_phi, r_phi, phi, first)
   end subroutine spin_to_rotation_vectors

end module f2py_rotations
