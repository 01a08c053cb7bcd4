!> Potential that a current raises round the place where it enters a wire, above the mean of the sections.
!>
!> Source: theory section 10. A point source on an infinite cylinder: modes `J_m(j' r/R) cos(m theta) exp(-j' |z|/R)`,
!> of which the four slowest are here; the others, which the spot needs nearby, are one term that falls as
!> `exp(-3 s/R)`.
!> Numbers fitted to 10^4 modes, within 0.02 `rho I/R` at all distances from 0.06 R on (0.008 in the mean).
module litz_spot_on_wire
   use litz_kinds, only: dp, pi
   implicit none
   private
   public :: potential_beside_spot, reach_of_spot

   !> Distance along a wire beyond which nothing is left but 0.001 `rho I/R` [radii]
   real(dp), parameter :: reach_of_spot = 3
   !> Zeros j' of the derivatives of J_1, J_2, J_0, J_3: M. Abramowitz, I. Stegun (1964), table 9.5
   real(dp), parameter :: decay(4) = [1.841184_dp, 3.054237_dp, 3.831706_dp, 4.201189_dp]
   !> Parts of these modes, and of what is left
   real(dp), parameter :: part(4) = [0.1195_dp, 0.0424_dp, -0.0737_dp, 0.0157_dp], nearby = 0.3007_dp, &
      decay_nearby = 3

contains

   !> Potential beside a spot over `rho I/R` [-].
   pure real(dp) function potential_beside_spot(cosine, along, least) result(potential)
      !> Of the angle round the wire; distance along it, and least distance that counts [radii]
      real(dp), intent(in) :: cosine, along, least
      real(dp) :: round(4), distance

      distance = max(sqrt(2*(1 - min(1.0_dp, cosine)) + along**2), least)
      ! cos(m theta)
      round = [cosine, 2*cosine**2 - 1, 1.0_dp, (4*cosine**2 - 3)*cosine]
      potential = sum(part*round*exp(-decay*along)) &
         + (1/(2*pi*distance) + nearby)*exp(-decay_nearby*distance)
   end function potential_beside_spot

end module litz_spot_on_wire
