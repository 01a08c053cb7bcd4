! Finite rotations for Python; the contracts are in fortran/base/rotations.f90.
module f2py_rotations
   use iso_c_binding, only: c_double
   use litz_rotations, only: core_exp => rotation_exp, core_log => rotation_log
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

end module f2py_rotations
