!> The contact of two wires per length along which they touch: force, energy, half width of the strip and conductance.
!>
!> Source: theory section 10. Two exact limits are joined: the strip between parallel wires, whose far field is the
!> section of the wires, and the ellipse of crossed ones, whose far field is the lens in which they overlap. With
!> `A = exp(-2 Lam_H)` of the lens and `B = exp(-2 Lam2)` of the section, `Lam = -ln(A + B)/2` and
!> `delta = 2 f Lam/(pi E*)`. As `b^2` goes with `f`, so does `B`, and all that follows is in closed form.
module litz_line_law
   use litz_kinds, only: dp, pi
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok, effective_modulus
   use litz_law_input, only: wire_pair_t
   implicit none
   private
   public :: line_wires_t, line_wires, line_force_t, line_force, line_overlap_t, line_overlap, line_spot_t, line_spot
   public :: line_change_t, change_by_section
   public :: widest_strip

   !> Largest half width of the strip, as a share of the smaller radius, at which the law holds
   real(dp), parameter :: widest_strip = 0.25_dp
   !> Newton stops at this change of ln f; the error left is of the order of its square
   real(dp), parameter :: step_tolerance = 1.0e-8_dp
   integer, parameter :: max_iterations = 30
   !> Above all values of Lam, whose B is at least the smallest normal number
   real(dp), parameter :: largest_logarithm = 400
   !> Overlaps that are a smaller part of the radius are none
   real(dp), parameter :: smallest_overlap = 1.0e-100_dp
   !> Below this B/A the energy comes from its series
   real(dp), parameter :: small_ratio = 0.02_dp
   !> No strip of wires that yield is wider than half of its far field: the largest A
   real(dp), parameter :: largest_lens = 0.25_dp

   !> What the laws need of two wires at an angle: to be made once for many points.
   type :: line_wires_t
      !> Radii of the barred and of the unbarred wire [m]
      real(dp) :: radius(2) = 0
      !> E* [Pa]
      real(dp) :: modulus = 0
      !> rho + rhob [ohm m]
      real(dp) :: resistivity = 0
      !> Lam2 + ln b of the current in the barred and in the unbarred wire, less their mean [-]
      real(dp) :: electric_offset(2) = 0
      !> Square of the half width over the force per length [m^3/N]
      real(dp) :: square_per_force = 0
      !> A [-], 0 of parallel wires, and its derivatives with respect to the angle [1/rad, 1/rad^2]
      real(dp) :: lens = 0, dlens_dangle = 0, d2lens_dangle2 = 0
      !> B/b^2 of the force and of the conductance [1/m^2]
      real(dp) :: section = 0, electric_section = 0
      !> Largest half width at which the law holds [m], and the force per length [N/m] and overlap [m] with it
      real(dp) :: max_half_width = 0, max_force = 0, max_overlap = 0
   end type line_wires_t

   !> The law at an overlap; all 0 where there is none.
   type :: line_force_t
      !> f [N/m], df/ddelta [N/m^2], df/dangle [N/(m rad)] and its derivative [N/(m rad^2)] at fixed overlap
      real(dp) :: force = 0, stiffness = 0, dforce_dangle = 0, d2force_dangle2 = 0
      !> Integral of f over the overlap [J/m]
      real(dp) :: energy = 0
      !> The strip is wider than the law holds for; from there on the force is a straight line over the overlap
      logical :: too_wide = .false.
   end type line_force_t

   !> How the law at an overlap changes with ln(B), of which the energy has a second derivative, too.
   type :: line_change_t
      !> [J/m], [N/m], [J/m]
      real(dp) :: energy = 0, force = 0, d2energy = 0
   end type line_change_t

   !> The law at a force per length; all 0 where there is none.
   type :: line_overlap_t
      !> delta [m], df/ddelta [N/m^2] and its derivative with respect to f [1/m]
      real(dp) :: overlap = 0, stiffness = 0, dstiffness_dforce = 0
   end type line_overlap_t

   !> The strip and its conductance; all 0 where there is no force.
   type :: line_spot_t
      !> b [m]
      real(dp) :: half_width = 0
      !> g' [S/m], dg'/df [S/N] at fixed angle, dg'/dangle [S/(m rad)] at fixed force
      real(dp) :: conductance = 0, dconductance_dforce = 0, dconductance_dangle = 0
      !> dg'/drho of the barred and of the unbarred wire (2) [S/(ohm m^2)]
      real(dp) :: dconductance_dresistivity(2) = 0
      !> The strip is wider than the law holds for; the conductance is that of the widest one
      logical :: too_wide = .false.
   end type line_spot_t

contains

   !> Coefficients of the laws of two wires.
   pure type(line_wires_t) function line_wires(wires, angle) result(line)
      type(wire_pair_t), intent(in) :: wires
      !> Angle whose sine is that of the lens [rad], from 0 (parallel) to pi
      real(dp), intent(in) :: angle
      real(dp) :: softness(2), r(2), reduced_radius

      r = wires%radius
      softness = (1 - wires%poisson**2)/wires%young                                        ! c
      reduced_radius = r(1)*r(2)/sum(r)                                                    ! R
      line%radius = r
      line%modulus = effective_modulus(wires%young, wires%poisson)
      line%resistivity = sum(wires%resistivity)
      line%square_per_force = 4*reduced_radius/(pi*line%modulus)                           ! b^2 = 4 f R/(pi E*)
      ! Lam2 + ln b, the mean of what each section gives
      line%section = exp(-2*mean(log(2*r) - 1/(8*(1 - wires%poisson)), softness))
      line%electric_section = exp(-2*mean(log(2*r) + 0.125_dp, wires%resistivity))
      line%electric_offset = log(2*r) - mean(log(2*r), wires%resistivity)
      call add_lens(wires, angle, line)
      line%max_half_width = widest_strip*minval(r)
      line%max_force = line%max_half_width**2/line%square_per_force
      line%max_overlap = line%max_force/(pi*line%modulus)*2*logarithm(line, line%max_force)
   end function line_wires

   !> `A = exp(-2 Lam_H)`, `Lam_H = pi E*/(2 k_H)`, with `k_H = (3/4) C sin psi/sqrt(2 (r + rb))` of `F = C delta^1.5`.
   pure subroutine add_lens(wires, angle, line)
      type(wire_pair_t), intent(in) :: wires
      !> Angle between the axes [rad]
      real(dp), intent(in) :: angle
      type(line_wires_t), intent(inout) :: line
      type(hertz_ellipse_t) :: ellipse
      real(dp) :: stiffness, log_slope, change
      integer :: info

      if (.not. sin(angle) > 0) return
      call hertz_ellipse(wires%radius, wires%young, wires%poisson, angle, ellipse, info)
      if (info /= hertz_ok) return
      stiffness = 0.75_dp*sin(angle)/(ellipse%approach*sqrt(2*sum(wires%radius)*ellipse%approach))   ! k_H
      log_slope = 1/tan(angle) - 1.5_dp*ellipse%dapproach_dangle/ellipse%approach          ! d ln k_H/dangle
      line%lens = exp(-pi*line%modulus/stiffness)
      ! of wires that are as good as parallel
      if (.not. line%lens > 0) return
      line%dlens_dangle = line%lens*pi*line%modulus/stiffness*log_slope
      change = -1/sin(angle)**2 - 1.5_dp*(ellipse%d2approach_dangle2/ellipse%approach &
         - (ellipse%dapproach_dangle/ellipse%approach)**2)                                 ! d2 ln k_H/dangle2
      line%d2lens_dangle2 = line%dlens_dangle*(pi*line%modulus/stiffness - 1)*log_slope &
         + line%lens*pi*line%modulus/stiffness*change
   end subroutine add_lens

   !> Force per length, its derivatives and the energy at an overlap.
   pure type(line_force_t) function line_force(line, overlap, penalty) result(found)
      type(line_wires_t), intent(in) :: line
      !> delta = -g [m]
      real(dp), intent(in) :: overlap
      !> eps_l [N/m^2] of `f = eps_l delta`; 0: the elastic law
      real(dp), intent(in) :: penalty
      type(line_overlap_t) :: inverse
      real(dp) :: f, beyond, b

      if (.not. overlap > smallest_overlap*line%radius(1)) return
      if (penalty > 0) then
         found%force = penalty*overlap
         found%stiffness = penalty
         found%energy = found%force*overlap/2
         found%too_wide = found%force > line%max_force
         return
      end if
      beyond = max(overlap - line%max_overlap, 0.0_dp)
      found%too_wide = beyond > 0
      f = line%max_force
      if (.not. found%too_wide) f = elastic_force(line, overlap)
      inverse = line_overlap(line, f, penalty)
      b = relative_section(line, f)
      found%stiffness = inverse%stiffness
      found%force = f + inverse%stiffness*beyond
      found%dforce_dangle = inverse%stiffness*f*line%dlens_dangle/(pi*line%modulus*(line%lens + b))
      found%d2force_dangle2 = second_by_angle(line, f, b, inverse)
      found%energy = f**2/(pi*line%modulus)*(logarithm(line, f) - energy_deficit(line, f)/2) &
         + (f + inverse%stiffness*beyond/2)*beyond
   end function line_force

   !> Second derivative of the force by the angle at fixed overlap [N/(m rad^2)], from those of
   !> `delta = -f ln(A + B)/(pi E*)` by f and A.
   pure real(dp) function second_by_angle(line, f, b, inverse) result(second)
      type(line_wires_t), intent(in) :: line
      !> f [N/m] and B [-]
      real(dp), intent(in) :: f, b
      !> At this force
      type(line_overlap_t), intent(in) :: inverse
      real(dp) :: whole, by_lens, of_lens, of_both, of_force

      second = 0
      if (.not. line%lens > 0) return
      associate (k => inverse%stiffness)
         whole = pi*line%modulus*(line%lens + b)
         by_lens = k*f/whole                                                               ! df/dA
         of_lens = f/(whole*(line%lens + b))                                               ! d2delta/dA2
         of_both = -line%lens/(whole*(line%lens + b))                                      ! d2delta/(df dA)
         of_force = -inverse%dstiffness_dforce/k**2                                        ! d2delta/df2
         second = by_lens*line%d2lens_dangle2 &
            - k*(of_lens + (2*of_both + of_force*by_lens)*by_lens)*line%dlens_dangle**2
      end associate
   end function second_by_angle

   !> `f(delta)` by Newton in `ln f`.
   !>
   !> `ln delta` is an increasing, concave and almost straight function of `ln f`: from a start below the solution the
   !> iteration stays below it, and needs no safeguard.
   pure real(dp) function elastic_force(line, overlap) result(f)
      type(line_wires_t), intent(in) :: line
      !> delta [m], positive, at most that of the widest strip
      real(dp), intent(in) :: overlap
      real(dp) :: scaled, lam, step
      integer :: iteration

      scaled = overlap*pi*line%modulus/2                                                   ! f Lam
      f = scaled/logarithm(line, scaled/largest_logarithm)
      do iteration = 1, max_iterations
         lam = logarithm(line, f)
         step = log(scaled/(f*lam))/(1 - section_share(line, f)/(2*lam))
         f = f*exp(step)
         if (abs(step) <= step_tolerance) exit
      end do
   end function elastic_force

   !> What another bound of the far field changes at the same overlap: `d Pi_l/d ln B = f^2 h/(pi E*)` with the `h` of
   !> the energy, and `d(f^2 h)/d ln f = f^2 B/(A + B)`.
   pure type(line_change_t) function change_by_section(line, force) result(change)
      type(line_wires_t), intent(in) :: line
      !> f [N/m], at most that of the widest strip
      real(dp), intent(in) :: force
      real(dp) :: share, deficit, by_force

      if (.not. force > 0) return
      share = section_share(line, force)
      deficit = energy_deficit(line, force)
      by_force = share/(2*logarithm(line, force) - share)                                  ! d ln f/d ln B
      change%force = by_force*force
      change%energy = force**2*deficit/(pi*line%modulus)
      change%d2energy = force**2*(share*(1 + by_force) - 2*deficit)/(pi*line%modulus)
   end function change_by_section

   !> Overlap and stiffness at a force per length.
   pure type(line_overlap_t) function line_overlap(line, force, penalty) result(found)
      type(line_wires_t), intent(in) :: line
      !> f [N/m]
      real(dp), intent(in) :: force
      !> eps_l [N/m^2] of `f = eps_l delta`; 0: the elastic law
      real(dp), intent(in) :: penalty
      real(dp) :: f, share, lam

      if (penalty > 0) found%stiffness = penalty
      if (.not. force > 0) return
      if (penalty > 0) then
         found%overlap = force/penalty
         return
      end if
      f = min(force, line%max_force)
      lam = logarithm(line, f)
      share = section_share(line, f)
      found%stiffness = pi*line%modulus/(2*lam - share)                                    ! 1/(ddelta/df)
      found%overlap = 2*f*lam/(pi*line%modulus) + (force - f)/found%stiffness              ! delta = 2 f Lam/(pi E*)
      if (force > f) return
      found%dstiffness_dforce = found%stiffness**2*share*(2 - share)/(pi*line%modulus*f)
   end function line_overlap

   !> The strip of a force per length and its conductance, `1/g' = ((rho + rhob)/pi) Lam_e + sigma_f/(2 b)`.
   !>
   !> `A` is the square of the half width over the length of the far field, which is that of the lens whether the wires
   !> yield or not: with the half width `b` of a hardness it is `A (b/b_H)^2`, `b_H` of the elastic strip.
   pure type(line_spot_t) function line_spot(line, force, film, hardness) result(spot)
      type(line_wires_t), intent(in) :: line
      !> f [N/m]
      real(dp), intent(in) :: force
      !> sigma_f, film resistance times area [ohm m^2]; 0: none
      real(dp), intent(in) :: film
      !> H [Pa] of `f = 2 b H`; 0: the elastic strip
      real(dp), intent(in) :: hardness
      real(dp) :: b, log_slope, section, of_film, lens, dlens_dangle, lens_slope, share

      if (.not. force > 0) return
      if (hardness > 0) then
         b = force/(2*hardness)
         log_slope = 1                                                                     ! d ln b/d ln f
      else
         b = sqrt(line%square_per_force*force)
         log_slope = 0.5_dp
      end if
      spot%half_width = b
      spot%too_wide = b > line%max_half_width*(1 + 4*epsilon(b))
      b = min(b, line%max_half_width)
      if (spot%too_wide) log_slope = 0
      lens = line%lens
      dlens_dangle = line%dlens_dangle
      lens_slope = 0                                                                       ! d ln A/d ln f
      if (hardness > 0) call widen_lens(line, b/(2*hardness*line%square_per_force), log_slope, lens, dlens_dangle, &
         lens_slope)

      section = line%electric_section*b**2                                                 ! B_e
      share = (lens_slope*lens/2 + log_slope*section)/(lens + section)                     ! -d Lam_e/d ln f
      of_film = film/(2*b)
      spot%conductance = 1/(-line%resistivity/(2*pi)*log(lens + section) + of_film)
      spot%dconductance_dforce = spot%conductance**2/force*(line%resistivity/pi*share + log_slope*of_film)
      spot%dconductance_dangle = spot%conductance**2*line%resistivity/(2*pi)*dlens_dangle/(lens + section)
      spot%dconductance_dresistivity = spot%conductance**2/(2*pi)*(log(lens + section) &
         - 2*section/(lens + section)*line%electric_offset)
   end function line_spot

   !> `A (b/b_H)^2` of wires that yield, and its derivatives.
   pure subroutine widen_lens(line, square, log_slope, lens, dlens_dangle, lens_slope)
      type(line_wires_t), intent(in) :: line
      !> (b/b_H)^2, which goes with b, and d ln b/d ln f [-]
      real(dp), intent(in) :: square, log_slope
      !> A [-], its derivative with respect to the angle [1/rad], and d ln A/d ln f [-]
      real(dp), intent(out) :: lens, dlens_dangle, lens_slope

      lens = square*line%lens
      dlens_dangle = square*line%dlens_dangle
      lens_slope = log_slope
      if (lens <= largest_lens) return
      lens = largest_lens
      dlens_dangle = 0
      lens_slope = 0
   end subroutine widen_lens

   !> `Lam = -ln(A + B)/2`.
   pure real(dp) function logarithm(line, force) result(lam)
      type(line_wires_t), intent(in) :: line
      !> f [N/m]
      real(dp), intent(in) :: force

      lam = -log(line%lens + relative_section(line, force))/2
   end function logarithm

   !> `B = exp(-2 Lam2)`, which goes with the force.
   pure real(dp) function relative_section(line, force) result(b)
      type(line_wires_t), intent(in) :: line
      !> f [N/m]
      real(dp), intent(in) :: force

      b = max(line%section*line%square_per_force*force, tiny(b))
   end function relative_section

   !> `B/(A + B)`: 1 for parallel wires.
   pure real(dp) function section_share(line, force) result(share)
      type(line_wires_t), intent(in) :: line
      !> f [N/m]
      real(dp), intent(in) :: force

      share = relative_section(line, force)
      share = share/(line%lens + share)
   end function section_share

   !> `h` of the energy `f^2/(pi E*) (Lam - h/2)`: the integral of `z s^2/(1 + z s)` over s from 0 to 1, with `z = B/A`,
   !> which is `1/2 - 1/z + ln(1 + z)/z^2`.
   pure real(dp) function energy_deficit(line, force) result(h)
      type(line_wires_t), intent(in) :: line
      !> f [N/m]
      real(dp), intent(in) :: force
      real(dp) :: b, inverse, z

      b = relative_section(line, force)
      if (b < small_ratio*line%lens) then
         z = b/line%lens
         h = z*(1.0_dp/3 - z*(0.25_dp - z*(0.2_dp - z*(1.0_dp/6 - z*(1.0_dp/7 - z*(0.125_dp - z*(1.0_dp/9 - z/10)))))))
      else
         inverse = line%lens/b
         h = 0.5_dp - inverse
         if (inverse > 0) h = h + inverse**2*log(1 + 1/inverse)
      end if
   end function energy_deficit

   pure real(dp) function mean(values, weights)
      !> Of the barred and of the unbarred wire (2)
      real(dp), intent(in) :: values(2)
      !> Their weights (2)
      real(dp), intent(in) :: weights(2)

      mean = dot_product(values, weights)/sum(weights)
   end function mean

end module litz_line_law
