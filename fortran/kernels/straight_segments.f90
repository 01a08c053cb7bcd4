!> Closest points of two straight segments.
module litz_straight_segments
   use litz_kinds, only: dp
   implicit none
   private
   public :: segment_distance, closest_on_chords

contains

   !> Least distance of two straight pieces, also where these are parallel or have no length [m].
   pure real(dp) function segment_distance(x) result(distance)
      !> Ends (3, 4) [m]: two of the one piece, two of the other
      real(dp), intent(in) :: x(3, 4)
      real(dp) :: xi(2)

      xi = closest_on_chords(x)
      distance = norm2((1 - xi(1))/2*x(:, 1) + (1 + xi(1))/2*x(:, 2) - (1 - xi(2))/2*x(:, 3) - (1 + xi(2))/2*x(:, 4))
   end function segment_distance

   !> Closest points of the two straight chords, also where these are parallel or have no length.
   !>
   !> Source: the minimum of a convex quadratic over a square: the unrestricted one when it lies inside, else the best
   !> of the four edges.
   pure function closest_on_chords(x) result(xi)
      !> Nodal positions (3, 4) [m]
      real(dp), intent(in) :: x(3, 4)
      !> Places (barred, unbarred) in [-1, 1]
      real(dp) :: xi(2)
      real(dp) :: w(3), c_bar(3), c(3), aa, ab, bb, wa, wb, determinant, edge(2), f, best
      integer :: side

      c_bar = (x(:, 2) - x(:, 1))/2
      c = (x(:, 4) - x(:, 3))/2
      w = (x(:, 1) + x(:, 2) - x(:, 3) - x(:, 4))/2
      aa = dot_product(c_bar, c_bar)
      bb = dot_product(c, c)
      ab = dot_product(c_bar, c)
      wa = dot_product(w, c_bar)
      wb = dot_product(w, c)
      determinant = aa*bb - ab**2
      if (determinant > 1.0e-12_dp*aa*bb) then
         xi = [(ab*wb - bb*wa)/determinant, (aa*wb - ab*wa)/determinant]
         if (all(abs(xi) <= 1)) return
      end if
      best = huge(best)
      xi = 0
      do side = 1, 4
         edge = merge(-1.0_dp, 1.0_dp, mod(side, 2) == 0)
         if (side <= 2) then
            edge(2) = nearest_on_line(bb, wb + ab*edge(1))
         else
            edge(1) = nearest_on_line(aa, ab*edge(2) - wa)
         end if
         f = dot_product(w + edge(1)*c_bar - edge(2)*c, w + edge(1)*c_bar - edge(2)*c)
         if (f < best) then
            best = f
            xi = edge
         end if
      end do
   end function closest_on_chords

   pure real(dp) function nearest_on_line(square, projection) result(xi)
      !> Square of half the chord [m^2]
      real(dp), intent(in) :: square
      !> Vector from the middle of the chord to the other point, times half the chord [m^2]
      real(dp), intent(in) :: projection

      xi = 0
      if (square > 0) xi = max(-1.0_dp, min(1.0_dp, projection/square))
   end function nearest_on_line

end module litz_straight_segments
