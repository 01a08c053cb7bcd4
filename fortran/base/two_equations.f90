!> Two linear equations.
module litz_two_equations
   use litz_kinds, only: dp
   implicit none
   private
   public :: solved

contains

   !> Solution of two equations (2).
   pure function solved(k, b) result(x)
      !> Matrix and right-hand side
      real(dp), intent(in) :: k(2, 2), b(2)
      real(dp) :: x(2)

      x = [k(2, 2)*b(1) - k(1, 2)*b(2), k(1, 1)*b(2) - k(2, 1)*b(1)]/(k(1, 1)*k(2, 2) - k(1, 2)*k(2, 1))
   end function solved

end module litz_two_equations
