!> What a film does with heat that enters an element between its nodes: the solution of the fin.
!>
!> With `w` of (13.3) heat that enters at the place xi comes to the nodes in the parts
!> `sinh(w (1 -+ xi))/sinh(2 w)`, by which the temperatures of the nodes make that of the place. Powers of `w^2`, in
!> which nothing cancels: `S(y) = sinh(sqrt(y))/sqrt(y)`. Source: theory section 13.
module litz_fin
   use litz_kinds, only: dp
   implicit none
   private
   public :: fin_parts, fin_growth, fin_even

   !> Beyond this w^2 nothing reaches the nodes any more, and exponentials leave the range of numbers
   real(dp), parameter :: largest = 1.0e5_dp
   !> Below this S comes from its series
   real(dp), parameter :: small = 1.0e-2_dp

contains

   !> Parts of both nodes at a place.
   pure subroutine fin_parts(w2, xi, part, dpart)
      !> w^2, and the place in [-1, 1]
      real(dp), intent(in) :: w2, xi
      !> (2), and their derivatives by the place (2)
      real(dp), intent(out) :: part(2), dpart(2)
      real(dp) :: w2_finite
      integer :: i

      w2_finite = min(w2, largest)
      do i = 1, 2
         associate (from_other => 1 + (2*i - 3)*xi)
            part(i) = from_other/2*over_root(w2_finite*from_other**2)/over_root(4*w2_finite)
            dpart(i) = (2*i - 3)*cosh(sqrt(w2_finite)*from_other)/(2*over_root(4*w2_finite))
         end associate
      end do
   end subroutine fin_parts

   !> With these parts, each twice, in place of `1 -+ xi` the rise within an element is that without a film times this.
   pure real(dp) function fin_growth(w2)
      !> w^2
      real(dp), intent(in) :: w2

      fin_growth = over_root(4*min(w2, largest))
   end function fin_growth

   !> What heat that enters evenly does at a place: `(1 - xi^2)/2` without a film, and its derivative by the place.
   pure subroutine fin_even(w2, xi, even, deven)
      !> w^2, and the place in [-1, 1]
      real(dp), intent(in) :: w2, xi
      !> Times s and the heat it is the rise there; and its derivative
      real(dp), intent(out) :: even, deven
      real(dp) :: w2_finite

      w2_finite = min(w2, largest)
      even = (1 - xi**2)/2*over_root(w2_finite*(1 + xi)**2/4)*over_root(w2_finite*(1 - xi)**2/4)/cosh(sqrt(w2_finite))
      deven = -xi*over_root(w2_finite*xi**2)/cosh(sqrt(w2_finite))
   end subroutine fin_even

   !> S
   pure real(dp) function over_root(y)
      !> Not negative
      real(dp), intent(in) :: y

      if (y < small) then
         over_root = 1 + y/6*(1 + y/20*(1 + y/42*(1 + y/72)))
      else
         over_root = sinh(sqrt(y))/sqrt(y)
      end if
   end function over_root

end module litz_fin
