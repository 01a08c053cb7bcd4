!> The line law of a wire on a rigid surface: the limit of two wires of which one is infinitely hard.
!>
!> Source: theory sections 10 and 12. Only the section of the wire gives way: `E* = E/(1 - nu^2)`,
!> `Lam2 = ln(2 r/b) - 1/(8 (1 - nu))`, and `b^2 = 4 f R/(pi E*)` with the relative curvature `1/R` across the wire.
!> The lens is that of the relative curvatures of wire and surface at the deepest place.
module litz_rigid_line
   use litz_kinds, only: dp, pi
   use litz_cut_lens, only: energy_below
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok
   use litz_jets, only: jet_t, constant, composed, operator(+), operator(-), operator(*), operator(**)
   use litz_lens_law, only: share_of_point, curvature_of_share, line_from
   use litz_line_law, only: line_wires_t, line_overlap_t, line_overlap, widest_strip
   implicit none
   private
   public :: rigid_line, rigid_end, end_energy

   !> Young's modulus of the surface over that of the wire
   real(dp), parameter :: rigid = 1.0e30_dp

contains

   pure type(line_wires_t) function rigid_line(radius, young, poisson, across, along, mixed, opening) result(line)
      !> Of the wire: radius [m], Young's modulus [Pa], Poisson's ratio
      real(dp), intent(in) :: radius, young, poisson
      !> Relative curvature of the surfaces across and along the wire, and the mixed one [1/m]
      real(dp), intent(in) :: across, along, mixed
      !> Second derivative of the gap along the wire [1/m]
      real(dp), intent(in) :: opening
      type(line_overlap_t) :: widest

      line%radius = radius
      line%modulus = young/(1 - poisson**2)
      line%square_per_force = 4/(max(across, 1.0e-3_dp/radius)*pi*line%modulus)
      line%section = exp(-2*(log(2*radius) - 1/(8*(1 - poisson))))
      line%lens = lens_of(young, poisson, across, along, mixed, opening, line%modulus)
      line%max_half_width = widest_strip*radius
      line%max_force = line%max_half_width**2/line%square_per_force
      widest = line_overlap(line, line%max_force, 0.0_dp)
      line%max_overlap = widest%overlap
   end function rigid_line

   !> Force of the round end of a wire on the surface, over the overlap to the power of 3/2 [N/m^1.5]: that of Hertz for
   !> a sphere; with a penalty per length the part of the force of two such wires crossed that Hertz has.
   pure real(dp) function rigid_end(radius, young, poisson, penalty, curvature) result(coefficient)
      !> Of the wire: radius [m], Young's modulus [Pa], Poisson's ratio
      real(dp), intent(in) :: radius, young, poisson
      !> eps_l [N/m^2]; 0: the elastic law
      real(dp), intent(in) :: penalty
      !> Of the surface, in the direction in which it is curved [1/m]: positive of a cylinder, negative of a bore
      real(dp), intent(in) :: curvature
      type(hertz_ellipse_t) :: ellipse, crossed
      integer :: info

      call hertz_ellipse([radius, 1/(1/radius + curvature)], [young, rigid*young], [poisson, 0.0_dp], pi/2, ellipse, &
         info)
      coefficient = ellipse%approach**(-1.5_dp)                                            ! delta = cd F^(2/3)
      if (.not. penalty > 0) return
      call hertz_ellipse([radius, radius], [young, rigid*young], [poisson, 0.0_dp], pi/2, crossed, info)
      coefficient = coefficient*crossed%approach**1.5_dp*4*penalty*sqrt(4*radius)/3        ! (4/3) eps_l delta aW
   end function rigid_end

   !> Energy of an end beside the wire along which the surface lies: nothing of a long overlap; of a short one, where
   !> the wire is nearest to the surface at its end or beyond, or so near to it that the overlap is cut there, what the
   !> cylinder leaves.
   pure type(jet_t) function end_energy(coefficient, bend, spacing, overlap, slope) result(energy)
      !> Of `rigid_end` [N/m^1.5], k [1/m], and unit of length of an overlap from the end on [m]
      real(dp), intent(in) :: coefficient, bend, spacing
      !> Overlap at the end, positive [m], and slope t of the distance from there on [-]
      type(jet_t), intent(in) :: overlap, slope
      type(jet_t) :: square, length, u
      real(dp) :: share, dshare

      energy = constant(0.0_dp)
      square = slope*slope + 2*bend*overlap
      if (.not. square%value > 0) return
      length = slope + square**0.5_dp
      if (.not. length%value > overlap%value/(line_from*spacing)) return
      length = 2.0_dp*overlap*length**(-1.0_dp)
      call share_of_point(length%value, spacing, share, dshare)
      if (.not. share > 0) return
      u = (-1.0_dp)*slope*square**(-0.5_dp)
      energy = (0.4_dp*coefficient)*overlap**2.5_dp*composed(length, share, dshare, curvature_of_share(length%value, &
         spacing))*(1.0_dp - energy_below(u))
   end function end_energy

   !> `A = exp(-2 Lam_H)`, `Lam_H = pi E*/(2 k_H)`, with `k_H = (3/4) C sqrt(D''/2)` of `F = C delta^1.5`: the integral
   !> of `k_H delta` over the lens is then the law of Hertz. 0 where there is no lens.
   pure real(dp) function lens_of(young, poisson, across, along, mixed, opening, modulus) result(lens)
      !> As in `rigid_line`
      real(dp), intent(in) :: young, poisson, across, along, mixed, opening
      !> E* [Pa]
      real(dp), intent(in) :: modulus
      type(hertz_ellipse_t) :: ellipse
      real(dp) :: mean, half_difference, curvature(2), stiffness
      integer :: info

      lens = 0
      mean = (across + along)/2
      half_difference = hypot((across - along)/2, mixed)
      curvature = [mean + half_difference, mean - half_difference]
      if (.not. (opening > 0 .and. curvature(2) > epsilon(mean)*curvature(1))) return
      call hertz_ellipse(1/curvature, [young, rigid*young], [poisson, 0.0_dp], pi/2, ellipse, info)
      if (info /= hertz_ok) return
      stiffness = 0.75_dp*sqrt(opening/2)/(ellipse%approach*sqrt(ellipse%approach))
      lens = exp(-pi*modulus/stiffness)
   end function lens_of

end module litz_rigid_line
