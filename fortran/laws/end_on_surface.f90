!> The round end of a wire, or the round joint of a kink, on a rigid surface.
!>
!> Source: theory section 12. An end that nothing is beside is a sphere. The cylinders that lead to it have the law per
!> length along their axes, which takes them for longer than they are where they rise from the surface: their lowest
!> line begins where the sphere ends. Where that is a short contact the sphere has what both have in a half-space
!> together, less what the law per length gives.
module litz_end_on_surface
   use litz_cut_lens, only: energy_below
   use litz_gauss, only: six_places, six_weights
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse
   use litz_jets, only: jet_t, constant, composed, operator(+), operator(-), operator(*), operator(**)
   use litz_kinds, only: dp, pi
   use litz_lens_law, only: smooth_step, point_up_to, line_from
   use litz_line_law, only: line_wires_t, line_force_t, line_force
   use litz_rigid_line, only: rigid
   use litz_yielding_spot, only: yielding_t, yielding_crossing
   implicit none
   private
   public :: rigid_end, yielding_end, wire_end_t, end_energy

   !> Unit of length, in radii, of an overlap from the end of a wire on: up to two of them the end carries it, from six
   !> on the wire beside it; where it takes the place of the law per length, and where it is added to that
   real(dp), parameter :: instead_of_line = 0.45_dp, beside_line = 0.26_dp
   !> What a cylinder adds to the energy of the sphere, (12.2c): a fit within 1.5 % of the force
   real(dp), parameter :: size_of_e = 0.1_dp, of_curvature = 1.25_dp, of_slope = 3.4_dp, of_length = 0.375_dp
   !> Slope v from which on that holds however the wire is bent
   real(dp), parameter :: steep = 0.2_dp

   !> What stays within an iteration.
   type :: wire_end_t
      !> r [m], and curvature k of the distance along the wire [1/m]
      real(dp) :: radius = 1, bend = 0
      !> rho of the sphere, relative to the surface [m], and kappa of the cylinder, over 1/rho [-]
      real(dp) :: sphere = 1, cylinder = 0
      !> Part of the sphere that this wire has of those which meet there [-], and length of its element [m]
      real(dp) :: part = 1, length = huge(1.0_dp)
      !> eps_l [N/m^2], or 0
      real(dp) :: penalty = 0
      !> It has touched in a state in balance, and the metal does not yield: it takes the place of the law per length
      !> beside it
      logical :: replaces_line = .false.
      type(line_wires_t) :: law
   end type wire_end_t

contains

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
   !> cylinder leaves (12.2b).
   pure subroutine end_energy(end, whole, overlap, slope, energy, of_line)
      type(wire_end_t), intent(in) :: end
      !> Energy of an end that nothing is beside, at this overlap [J]
      type(jet_t), intent(in) :: whole
      !> Overlap at the end, positive [m], and slope t of the distance from there on [-]
      type(jet_t), intent(in) :: overlap, slope
      !> [J]
      type(jet_t), intent(out) :: energy
      !> What of the law per length it takes the place of [J]
      real(dp), intent(out) :: of_line
      type(jet_t) :: square, length, share, inside, v, steepness, line, beside

      energy = constant(0.0_dp)
      of_line = 0
      square = slope*slope + 2*bend_away(end)*overlap
      if (.not. square%value > 0) return
      length = slope + square**0.5_dp
      if (.not. length%value > 0) return
      share = share_of_end(end, 0.5_dp*length*overlap**(-1.0_dp))
      if (.not. share%value > 0) return
      length = 2.0_dp*overlap*length**(-1.0_dp)                                            ! L
      v = sqrt(end%sphere)*slope*overlap**(-0.5_dp)
      inside = part_inside(v)
      energy = share*whole*(end%part - inside)
      if (.not. (end%replaces_line .and. slope%value > 0)) return
      ! 1 - (1 - u^2)(1 - sigma)
      steepness = 1.0_dp - 2*bend_away(end)*overlap*square**(-1.0_dp)*(1.0_dp - smooth(v))
      beside = whole*cylinder_beside(end, v)
      line = energy_of_line(end, overlap, slope, length)
      if (length%value > end%length) then
         beside = beside*line**(-1.0_dp)
         line = energy_of_line(end, overlap, slope, constant(end%length))
         beside = beside*line
      end if
      energy = energy + share*steepness*(whole*inside + beside - line)
      of_line = share%value*steepness%value*line%value
   end subroutine end_energy

   !> What of the contact is carried by the end: by the inverse of the length of the overlap, which goes with the slope.
   !> By the length itself it would change so fast with the slope that wires snap off.
   pure type(jet_t) function share_of_end(end, inverse) result(share)
      type(wire_end_t), intent(in) :: end
      !> 1/L, positive [1/m]
      type(jet_t), intent(in) :: inverse
      real(dp) :: u, rate

      associate (least => 1/(line_from*spacing_of_end(end)), most => 1/(point_up_to*spacing_of_end(end)))
         rate = 1/(most - least)
         u = max(0.0_dp, min(1.0_dp, (inverse%value - least)*rate))
      end associate
      share = composed(inverse, smooth_step(u), 6*u*(1 - u)*rate, merge(6*(1 - 2*u)*rate**2, 0.0_dp, u > 0 .and. u < 1))
   end function share_of_end

   !> Part of the sphere's lens that is on the side of the cylinder, beyond where the sphere ends: `E(-v/sqrt(2))`.
   pure type(jet_t) function part_inside(v) result(part)
      !> `t sqrt(rho/delta)`
      type(jet_t), intent(in) :: v

      part = constant(merge(1.0_dp, 0.0_dp, v%value < 0))
      if (abs(v%value) < sqrt(2.0_dp)) part = energy_below((-sqrt(0.5_dp))*v)
   end function part_inside

   !> Unit of length of an overlap from the end on [m].
   pure real(dp) function spacing_of_end(end) result(spacing)
      type(wire_end_t), intent(in) :: end

      spacing = merge(instead_of_line, beside_line, end%replaces_line)*end%radius
   end function spacing_of_end

   !> k of a wire that is bent away from the surface [1/m]; one that is bent towards it leaves it as a straight one.
   pure real(dp) function bend_away(end) result(bend)
      type(wire_end_t), intent(in) :: end

      bend = max(end%bend, 0.0_dp)
   end function bend_away

   !> `e(v)` of (12.2c), by which the cylinder raises the energy of the sphere in a half-space.
   pure type(jet_t) function cylinder_beside(end, v) result(e)
      type(wire_end_t), intent(in) :: end
      !> `t sqrt(rho/delta)`, positive
      type(jet_t), intent(in) :: v

      e = constant(0.0_dp)
      if (v%value >= 1 .or. end%cylinder >= 1) return
      e = size_of_e*(1 - end%cylinder)**of_curvature*(1.0_dp - v)**of_slope*(of_length*end%cylinder + v*v)**(-0.5_dp)
   end function cylinder_beside

   !> What the law per length has from the end on up to where the wire leaves the surface [J].
   pure type(jet_t) function energy_of_line(end, overlap, slope, length) result(energy)
      type(wire_end_t), intent(in) :: end
      !> At the end [m], t [-], and how far the overlap goes [m]
      type(jet_t), intent(in) :: overlap, slope, length
      type(jet_t) :: s, there
      type(line_force_t) :: law
      integer :: i

      energy = constant(0.0_dp)
      do i = 1, size(six_places)
         s = ((1 + six_places(i))/2)*length
         there = overlap - slope*s - (end%bend/2)*s*s
         law = line_force(end%law, there%value, end%penalty)
         energy = energy + (six_weights(i)/2)*length*composed(there, law%energy, law%force, law%stiffness)
      end do
   end function energy_of_line

   !> From 0 to 1 as v goes from 0 to where a cylinder is steep.
   pure type(jet_t) function smooth(v)
      type(jet_t), intent(in) :: v

      smooth = constant(1.0_dp)
      if (v%value < steep) smooth = (1/steep**2)*v*v*(3.0_dp - (2/steep)*v)
   end function smooth

end module litz_end_on_surface
