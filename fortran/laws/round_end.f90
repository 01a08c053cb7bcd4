!> The round end of a wire beside another one, along a line that ends there: half of its Hertz contact, which lies
!> beyond the end.
!>
!> The places along the line integrate the law per length up to the end. A hemisphere pressed into the other wire has an
!> elliptic spot about the end, of which one half is that of the line and the other one lies beyond. It fades where the
!> other wire ends as well, so that of wires that end together nothing is left. Source: theory (10.18b).
module litz_round_end
   use litz_kinds, only: dp
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok
   use litz_law_input, only: wire_pair_t
   implicit none
   private
   public :: round_end_t, end_force_t, force_of_end, ellipse_of_end

   type :: round_end_t
      !> Part of its Hertz contact that it has [-]; 0: the place is not at an end
      real(dp) :: share = 0
      !> Force of the whole Hertz contact over the overlap^(3/2) [N m^(-3/2)]; 0 where the law is another one
      real(dp) :: hertz = 0
      !> Distance of the axes [m]
      real(dp) :: distance = 0
      !> How far the other wire goes on beyond the end [m], and how that changes with the place on it [-]
      real(dp) :: beyond = huge(1.0_dp), dbeyond = 0
      !> At the present overlap [N], and what of the conductance of the place is that of its spot [-]
      real(dp) :: force = 0, share_of_conductance = 0
   end type round_end_t

   !> Energy [J], its derivatives by the overlap [N, N/m], and by how far the other wire goes on, first [N], mixed and
   !> second [N/m].
   type :: end_force_t
      real(dp) :: energy = 0, force = 0, stiffness = 0, along = 0, along_by_overlap = 0, along_stiffness = 0
      !> How the stiffness changes with the overlap [N/m^2]
      real(dp) :: dstiffness = 0
      !> The part of its Hertz contact that it has where the other wire ends [-], and how that changes with the overlap
      !> [1/m]
      real(dp) :: part = 0, dpart = 0
   end type end_force_t

contains

   !> `Pi = s (2/5) C delta^(5/2) S(u)`, `u = y/sqrt(2 d delta)` with the smooth step `S`.
   pure type(end_force_t) function force_of_end(round, overlap) result(at)
      type(round_end_t), intent(in) :: round
      !> delta [m]
      real(dp), intent(in) :: overlap
      real(dp) :: u, s, s1, s2, s3, factor

      if (.not. (overlap > 0 .and. round%hertz > 0)) return
      u = 1
      associate (reach => sqrt(2*round%distance*overlap))
         if (round%beyond < reach) u = max(0.0_dp, round%beyond)/reach
         s = u**2*(3 - 2*u)
         s1 = 6*u*(1 - u)
         s2 = merge(6 - 12*u, 0.0_dp, u < 1)
         s3 = merge(-12.0_dp, 0.0_dp, u < 1)
         factor = 0.4_dp*round%share*round%hertz*sqrt(overlap)
         at%part = round%share*s
         at%dpart = -round%share*s1*u/(2*overlap)
         at%energy = factor*overlap**2*s
         at%force = factor*overlap*(2.5_dp*s - u*s1/2)
         at%stiffness = factor*(3.75_dp*s - 1.75_dp*u*s1 + u**2*s2/4)
         at%dstiffness = at%stiffness/(2*overlap) - factor*u/(2*overlap)*(2*s1 - 1.25_dp*u*s2 + u**2*s3/4)
         at%along = factor*overlap**2*s1/reach
         at%along_by_overlap = factor*overlap*(2*s1 - u*s2/2)/reach
         at%along_stiffness = factor*overlap**2*s2/reach**2
      end associate
   end function force_of_end

   !> Hertz's ellipse of the round end of the unbarred wire on the barred one, at any angle.
   pure type(hertz_ellipse_t) function ellipse_of_end(pair, angle) result(ellipse)
      type(wire_pair_t), intent(in) :: pair
      !> [rad]
      real(dp), intent(in) :: angle
      integer :: info

      call hertz_ellipse(pair%radius, pair%young, pair%poisson, angle, ellipse, info, [.false., .true.])
      if (info /= hertz_ok) ellipse = hertz_ellipse_t()
   end function ellipse_of_end

end module litz_round_end
