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
   use litz_yielding_line, only: yielding_line_t, yielding_strip, add_crossing
   use litz_yielding_spot, only: yielding_t, yielding_crossing
   implicit none
   private
   public :: relative_curvature_t, rigid_line, rigid_end, end_energy, yielding_on_surface, yielding_end

   !> Young's modulus of the surface over that of the wire
   real(dp), parameter :: rigid = 1.0e30_dp

   !> How wire and surface part from each other.
   type :: relative_curvature_t
      !> Relative curvature of the surfaces across and along the wire, and the mixed one [1/m]
      real(dp) :: across = 0, along = 0, mixed = 0
      !> Second derivative of the gap along the wire [1/m]
      real(dp) :: opening = 0
   end type relative_curvature_t

contains

   pure type(line_wires_t) function rigid_line(radius, young, poisson, curvature) result(line)
      !> Of the wire: radius [m], Young's modulus [Pa], Poisson's ratio
      real(dp), intent(in) :: radius, young, poisson
      type(relative_curvature_t), intent(in) :: curvature
      type(line_overlap_t) :: widest

      line%radius = radius
      line%modulus = young/(1 - poisson**2)
      line%square_per_force = 4/(max(curvature%across, 1.0e-3_dp/radius)*pi*line%modulus)
      line%section = exp(-2*(log(2*radius) - 1/(8*(1 - poisson))))
      line%lens = lens_of(young, poisson, curvature, line%modulus)
      line%max_half_width = widest_strip*radius
      line%max_force = line%max_half_width**2/line%square_per_force
      widest = line_overlap(line, line%max_force, 0.0_dp)
      line%max_overlap = widest%overlap
   end function rigid_line

   !> The same of metal that yields, on a surface that does not.
   pure type(yielding_line_t) function yielding_on_surface(line, young, poisson, curvature, yield_stress, hardness) &
      result(law)
      type(line_wires_t), intent(in) :: line
      !> Of the wire [Pa], [-]
      real(dp), intent(in) :: young, poisson
      type(relative_curvature_t), intent(in) :: curvature
      !> [Pa]; a hardness of 0 is 2.8 times the yield stress
      real(dp), intent(in) :: yield_stress, hardness
      type(hertz_ellipse_t) :: ellipse
      logical :: exists

      law = yielding_strip(line, [poisson, poisson], [yield_stress, yield_stress])
      call find_ellipse(young, poisson, curvature, ellipse, exists)
      if (exists) call add_crossing(ellipse, [poisson, poisson], [yield_stress, yield_stress], hardness, &
         curvature%opening, law)
   end function yielding_on_surface

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

      ellipse = ellipse_of_end(radius, young, poisson, curvature)
      coefficient = ellipse%approach**(-1.5_dp)                                            ! delta = cd F^(2/3)
      if (.not. penalty > 0) return
      call hertz_ellipse([radius, radius], [young, rigid*young], [poisson, 0.0_dp], pi/2, crossed, info)
      coefficient = coefficient*crossed%approach**1.5_dp*4*penalty*sqrt(4*radius)/3        ! (4/3) eps_l delta aW
   end function rigid_end

   !> Spot of the round end of a wire on the surface.
   pure type(hertz_ellipse_t) function ellipse_of_end(radius, young, poisson, curvature) result(ellipse)
      !> As in `rigid_end`
      real(dp), intent(in) :: radius, young, poisson, curvature
      integer :: unused_info

      call hertz_ellipse([radius, 1/(1/radius + curvature)], [young, rigid*young], [poisson, 0.0_dp], pi/2, ellipse, &
         unused_info)
   end function ellipse_of_end

   !> Law of a round end of metal that yields.
   pure type(yielding_t) function yielding_end(radius, young, poisson, curvature, yield_stress, hardness) result(law)
      !> As in `rigid_end`
      real(dp), intent(in) :: radius, young, poisson, curvature
      !> [Pa]; a hardness of 0 is 2.8 times the yield stress
      real(dp), intent(in) :: yield_stress, hardness
      integer :: unused_info

      call yielding_crossing(ellipse_of_end(radius, young, poisson, curvature), [poisson, poisson], &
         [yield_stress, yield_stress], hardness, law, unused_info)
   end function yielding_end

   !> Energy of an end beside the wire along which the surface lies: nothing of a long overlap; of a short one, where
   !> the wire is nearest to the surface at its end or beyond, or so near to it that the overlap is cut there, what the
   !> cylinder leaves.
   pure type(jet_t) function end_energy(whole, bend, spacing, overlap, slope) result(energy)
      !> Energy of an end that nothing is beside, at this overlap [J]
      type(jet_t), intent(in) :: whole
      !> k [1/m], and unit of length of an overlap from the end on [m]
      real(dp), intent(in) :: bend, spacing
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
      energy = whole*composed(length, share, dshare, curvature_of_share(length%value, spacing)) &
         *(1.0_dp - energy_below(u))
   end function end_energy

   !> `A = exp(-2 Lam_H)`, `Lam_H = pi E*/(2 k_H)`, with `k_H = (3/4) C sqrt(D''/2)` of `F = C delta^1.5`: the integral
   !> of `k_H delta` over the lens is then the law of Hertz. 0 where there is no lens.
   pure real(dp) function lens_of(young, poisson, curvature, modulus) result(lens)
      !> As in `rigid_line`
      real(dp), intent(in) :: young, poisson
      type(relative_curvature_t), intent(in) :: curvature
      !> E* [Pa]
      real(dp), intent(in) :: modulus
      type(hertz_ellipse_t) :: ellipse
      real(dp) :: stiffness
      logical :: exists

      lens = 0
      call find_ellipse(young, poisson, curvature, ellipse, exists)
      if (.not. exists) return
      stiffness = 0.75_dp*sqrt(curvature%opening/2)/(ellipse%approach*sqrt(ellipse%approach))
      lens = exp(-pi*modulus/stiffness)
   end function lens_of

   !> The spot of a short lens, where there is one.
   pure subroutine find_ellipse(young, poisson, curvature, ellipse, exists)
      !> As in `rigid_line`
      real(dp), intent(in) :: young, poisson
      type(relative_curvature_t), intent(in) :: curvature
      type(hertz_ellipse_t), intent(out) :: ellipse
      !> There is one
      logical, intent(out) :: exists
      real(dp) :: mean, half_difference, principal(2)
      integer :: info

      mean = (curvature%across + curvature%along)/2
      half_difference = hypot((curvature%across - curvature%along)/2, curvature%mixed)
      principal = [mean + half_difference, mean - half_difference]
      exists = curvature%opening > 0 .and. principal(2) > epsilon(mean)*principal(1)
      if (.not. exists) return
      call hertz_ellipse(1/principal, [young, rigid*young], [poisson, 0.0_dp], pi/2, ellipse, info)
      exists = info == hertz_ok
   end subroutine find_ellipse

end module litz_rigid_line
