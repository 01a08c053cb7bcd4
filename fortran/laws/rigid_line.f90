!> The line law of a wire on a rigid surface: the limit of two wires of which one is infinitely hard.
!>
!> Source: theory sections 10 and 12. Only the section of the wire gives way: `E* = E/(1 - nu^2)`,
!> `Lam2 = ln(2 r/b) - 1/(8 (1 - nu))`, and `b^2 = 4 f R/(pi E*)` with the relative curvature `1/R` across the wire.
!> The lens is that of the relative curvatures of wire and surface at the deepest place. As between wires, the section
!> is no part of the far field while the lens is short.
module litz_rigid_line
   use litz_kinds, only: dp, pi
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok
   use litz_lens_law, only: share_of_line, lens_energy, grown_energy
   use litz_line_law, only: line_wires_t, line_force_t, line_force, line_overlap_t, line_overlap, widest_strip
   use litz_yielding_line, only: yielding_line_t, yielding_strip, add_crossing
   implicit none
   private
   public :: relative_curvature_t, rigid_line, growth_of_lens, same_law, yielding_on_surface

   !> Young's modulus of the surface over that of the wire
   real(dp), parameter, public :: rigid = 1.0e30_dp

   !> How wire and surface part from each other.
   type :: relative_curvature_t
      !> Relative curvature of the surfaces across and along the wire, and the mixed one [1/m]
      real(dp) :: across = 0, along = 0, mixed = 0
      !> Curvature of the surface along the wire [1/m]
      real(dp) :: of_surface = 0
      !> Second derivative of the gap along the wire [1/m]
      real(dp) :: opening = 0
      !> Deepest overlap of the lens in which the place lies [m]
      real(dp) :: deepest = 0
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
      if (line%lens > 0) line%section = share_of_line(half_length(curvature)/radius)*line%section
      line%max_half_width = widest_strip*radius
      line%max_force = line%max_half_width**2/line%square_per_force
      widest = line_overlap(line, line%max_force, 0.0_dp)
      line%max_overlap = widest%overlap
   end function rigid_line

   !> Energy of a lens over that which it would have if its far field had always been the present one: the section has
   !> come to count while the lens grew.
   pure real(dp) function growth_of_lens(line, curvature) result(ratio)
      !> From `rigid_line`
      type(line_wires_t), intent(in) :: line
      type(relative_curvature_t), intent(in) :: curvature
      type(line_wires_t) :: whole
      real(dp) :: share, kept, unused(2)

      ratio = 1
      if (.not. line%lens > 0) return
      share = share_of_line(half_length(curvature)/line%radius(1))
      if (.not. share > 0) return
      whole = line
      whole%section = line%section/share
      ! the sine is a factor of both
      call lens_energy(line, -curvature%deepest, 1.0_dp, 0.0_dp, kept, unused(1), unused(2))
      if (kept > 0) ratio = grown_energy(whole, -curvature%deepest, 1.0_dp, half_length(curvature)/line%radius(1), &
         curvature%deepest)/kept
   end function growth_of_lens

   !> The far field and the elasticity of a law are those of another one, at an overlap.
   pure logical function same_law(before, now, overlap, tolerance)
      type(line_wires_t), intent(in) :: before, now
      !> [m]; relative
      real(dp), intent(in) :: overlap, tolerance
      type(line_force_t) :: deepest

      deepest = line_force(now, overlap, 0.0_dp)
      same_law = abs(far_field(now, deepest%force) - far_field(before, deepest%force)) &
         <= tolerance*abs(far_field(now, deepest%force))
      same_law = same_law .and. abs(now%modulus - before%modulus) <= tolerance*now%modulus
   end function same_law

   !> `-2 Lam` at a force per length.
   pure real(dp) function far_field(law, force)
      type(line_wires_t), intent(in) :: law
      !> f [N/m]
      real(dp), intent(in) :: force

      far_field = log(max(law%lens + law%section*law%square_per_force*force, tiny(1.0_dp)))
   end function far_field

   !> aW of the lens in which the place lies [m].
   pure real(dp) function half_length(curvature)
      !> Of a lens
      type(relative_curvature_t), intent(in) :: curvature

      half_length = sqrt(2*curvature%deepest/curvature%opening)
   end function half_length

   !> The law of a line of metal that yields, on a surface that does not.
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
      principal(1) = mean + half_difference
      ! a difference of the two would be round-off where wires conform to the surface
      principal(2) = (curvature%across*curvature%along - curvature%mixed**2)/principal(1)
      exists = curvature%opening > 0 .and. principal(2) > epsilon(mean)*principal(1)
      if (.not. exists) return
      call hertz_ellipse(1/principal, [young, rigid*young], [poisson, 0.0_dp], pi/2, ellipse, info)
      exists = info == hertz_ok
   end subroutine find_ellipse

end module litz_rigid_line
