!> The contact of two wires of metal that yields per length along which they touch: the strip, the overlap, the dent.
!>
!> Source: theory section 15; the elastic law is that of litz_line_law, section 10. Between wires side by side the half
!> width goes on along its tangent above the onset, so that the mean pressure rises to twice that at the onset. In a
!> short lens the law is the one that adds up to that of the crossing, litz_yielding_profile. In between each counts as
!> far as the section or the lens is the far field. Unloading is that of strips of less and less width.
module litz_yielding_line
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok
   use litz_kinds, only: dp, pi
   use litz_law_input, only: wire_pair_t
   use litz_line_law, only: line_wires_t, line_force_t, line_force, line_overlap_t, line_overlap, line_spot_t
   use litz_yielding_profile, only: profile_t, profile_at, profile_of_force
   use litz_yielding_spot, only: onset_factor, yielding_t, yielding_crossing, yielding_ok
   implicit none
   private
   public :: yielding_line_t, yielding_line, yielding_strip, add_crossing, line_dent_t, line_dent, line_state_t, &
      line_state_at_force, line_state_at_overlap, yielded_strip, returned_by_line, dissipated_by_line, pressure_of_strip

   !> Part of an overlap that is no more than round-off
   real(dp), parameter :: round_off = 16*epsilon(1.0_dp)
   !> Newton stops at this relative change of the force; the error left is of the order of its square
   real(dp), parameter :: step_tolerance = 1.0e-9_dp
   integer, parameter :: max_iterations = 100
   !> Below this argument the inverse hyperbolic tangent is that of its own, else it is the difference of logarithms
   real(dp), parameter :: small_argument = 0.5_dp
   !> A lens of a smaller part of the section is that of wires as good as parallel
   real(dp), parameter :: small_lens = 1.0e-12_dp
   !> Largest A of a strip that has widened in a lens, which is half as wide as its far field then
   real(dp), parameter :: widest_lens = 0.25_dp
   !> Gauss points in (0, 1) and their weights, for energies
   real(dp), parameter :: half_places(4) = [0.18343464249564980494_dp, 0.52553240991632898582_dp, &
      0.79666647741362673959_dp, 0.96028985649753623168_dp]
   real(dp), parameter :: half_weights(4) = [0.36268378337836198297_dp, 0.31370664587788728734_dp, &
      0.22238103445337447054_dp, 0.10122853629037625915_dp]
   real(dp), parameter :: places(8) = 0.5_dp + 0.5_dp*[-half_places, half_places]
   real(dp), parameter :: weights(8) = 0.5_dp*[half_weights, half_weights]

   !> What the law needs of two wires at an angle.
   type :: yielding_line_t
      type(line_wires_t) :: line
      !> p_Y [Pa]
      real(dp) :: yield_pressure = 0
      !> f_Y [N/m] and b_Y [m]
      real(dp) :: force = 0, half_width = 0
      !> How far the lens of a crossing is the far field at the onset, and the section of the wires [-]
      real(dp) :: of_lens = 0, of_section = 1
      !> The crossing; Lam_H [-], and force per length of its elastic lens at the onset [N/m]
      type(yielding_t) :: spot
      real(dp) :: lens_logarithm = 0, lens_force = 0
      !> Force per length beyond which metal yields [N/m]
      real(dp) :: onset = 0
      !> Mean pressure over the strip at the onset, and in the end [Pa]
      real(dp) :: first_pressure = 0, last_pressure = 0
      !> Width of the spot of a crossing over that of the strips along its lens, as far as the lens counts [-]
      real(dp) :: spot_width = 1
   end type yielding_line_t

   !> What the largest force per length has made; all 0 where there was none.
   type :: line_dent_t
      !> The metal has yielded
      logical :: yielded = .false.
      !> f_m [N/m], delta_m [m], b [m]; phi, 0 of Hertz's pressure and 1 of an even one; delta_res [m]
      real(dp) :: force = 0, overlap = 0, half_width = 0, evenness = 0, depth = 0
      !> A of that strip in the lens [-]
      real(dp) :: lens = 0
   end type line_dent_t

   !> The contact at a force per length or at an overlap; all 0 but the overlap where there is no force.
   type :: line_state_t
      !> The force is the largest so far
      logical :: loads = .false.
      !> 1 - sqrt(1 - lambda^2) of the strip, 1 where it is the largest one [-]
      real(dp) :: opening = 1
      !> delta [m], f [N/m], df/ddelta [N/m^2]
      real(dp) :: overlap = 0, force = 0, stiffness = 0
      !> df/ddelta of the metal around the strip, which stays elastic [N/m^2]
      real(dp) :: elastic_stiffness = 0
      !> b [m] and its derivative by f [m^2/N]
      real(dp) :: half_width = 0, dhalf_width_dforce = 0
      !> A of the strip in the lens [-], and d ln A/d ln f
      real(dp) :: lens = 0, lens_slope = 0
      !> The strip is wider than the law holds for
      logical :: too_wide = .false.
   end type line_state_t

   !> What yielding adds to the elastic law at a force per length.
   type :: yielding_excess_t
      !> To `Lam` of the overlap, to `ln b`, and their derivatives by ln f [-]
      real(dp) :: logarithm = 0, dlogarithm = 0, widening = 0, dwidening = 0
      !> A of the metal around as it is then, and d ln A/d ln f [-]
      real(dp) :: lens = 0, lens_slope = 0
   end type yielding_excess_t

contains

   !> Onset of two wires that touch along a line (15.11), and of the crossing of which it may be a part.
   pure type(yielding_line_t) function yielding_line(line, wires, yield_stress, hardness, angle) result(law)
      type(line_wires_t), intent(in) :: line
      type(wire_pair_t), intent(in) :: wires
      !> Of the barred and of the unbarred wire (2) [Pa], positive; H [Pa], 0: 2.8 times the smaller of them
      real(dp), intent(in) :: yield_stress(2), hardness
      !> That of the line [rad]
      real(dp), intent(in) :: angle
      type(hertz_ellipse_t) :: ellipse
      integer :: info

      law = yielding_strip(line, wires%poisson, yield_stress)
      if (.not. has_lens(law)) return
      call hertz_ellipse(wires%radius, wires%young, wires%poisson, angle, ellipse, info)
      if (info == hertz_ok) call add_crossing(ellipse, wires%poisson, yield_stress, hardness, &
         sin(angle)**2/sum(wires%radius), law)
   end function yielding_line

   !> The same of wires side by side, without a lens.
   pure type(yielding_line_t) function yielding_strip(line, poisson, yield_stress) result(law)
      type(line_wires_t), intent(in) :: line
      !> (2) [-], and (2) [Pa]
      real(dp), intent(in) :: poisson(2), yield_stress(2)

      law%line = line
      law%yield_pressure = minval(onset_factor(poisson, 0.0_dp)*yield_stress)
      law%half_width = pi*line%square_per_force*law%yield_pressure/2                       ! b_Y = 2 R p_Y/E*
      law%force = pi*law%half_width*law%yield_pressure/2
      law%onset = law%force
      law%first_pressure = pi*law%yield_pressure/4
      law%last_pressure = 2*law%first_pressure
   end function yielding_strip

   !> The lens of a crossing is some of the far field.
   pure logical function has_lens(law)
      type(yielding_line_t), intent(in) :: law

      has_lens = law%line%lens > small_lens*law%line%section*law%half_width**2
   end function has_lens

   !> The law of the crossing per length of its lens, where that is some of the far field.
   pure subroutine add_crossing(ellipse, poisson, yield_stress, hardness, opening, law)
      type(hertz_ellipse_t), intent(in) :: ellipse
      !> (2) [-], (2) [Pa], and H [Pa]
      real(dp), intent(in) :: poisson(2), yield_stress(2), hardness
      !> Second derivative of the gap along the lens [1/m]
      real(dp), intent(in) :: opening
      type(yielding_line_t), intent(inout) :: law
      real(dp) :: half_width, spot_width, share
      integer :: info

      if (.not. has_lens(law)) return
      call yielding_crossing(ellipse, poisson, yield_stress, hardness, law%spot, info)
      if (info /= yielding_ok) return
      share = law%line%lens/(law%line%lens + law%line%section*law%half_width**2)
      law%of_lens = share
      law%of_section = 1 - share
      law%lens_logarithm = -log(law%line%lens)/2
      law%lens_force = pi*law%line%modulus/(2*law%lens_logarithm)*law%spot%overlap         ! k_H delta_Y
      law%onset = law%lens_force
      if (law%line%section > 0) law%onset = min(law%lens_force, law%force)
      half_width = sqrt(law%line%square_per_force*law%lens_force)
      ! pi a b over pi b_H aW, with aW = sqrt(2 delta/g'')
      spot_width = law%spot%area/(pi*half_width*sqrt(2*law%spot%overlap/opening))
      law%spot_width = spot_width**share
      law%first_pressure = share*law%lens_force/(2*half_width) + (1 - share)*law%first_pressure
      law%last_pressure = share*law%spot%hardness*spot_width + (1 - share)*law%last_pressure
   end subroutine add_crossing

   !> The dent of a force per length that the wires have loaded up to.
   pure type(line_dent_t) function line_dent(law, force) result(dent)
      type(yielding_line_t), intent(in) :: law
      !> f_m [N/m]; what is not positive makes none
      real(dp), intent(in) :: force
      type(line_state_t) :: state

      if (.not. force > 0) return
      state = loading_state(law, force)
      dent%force = force
      dent%overlap = state%overlap
      dent%half_width = state%half_width
      dent%lens = state%lens
      if (.not. force > law%onset) return
      dent%yielded = .true.
      associate (first => law%first_pressure, last => law%last_pressure)
         dent%evenness = (force/(2*dent%half_width) - first)/(last - first)                ! (15.13)
      end associate
      dent%evenness = min(max(dent%evenness, 0.0_dp), 1.0_dp)
      dent%depth = dent%overlap - drop(law, dent, 0.0_dp, 1.0_dp)
      ! at the onset a difference of equal lengths
      if (dent%depth < round_off*dent%overlap) dent%depth = 0
   end function line_dent

   !> The contact at a force per length, with the dent that the largest one has made.
   pure type(line_state_t) function line_state_at_force(law, dent, force) result(state)
      type(yielding_line_t), intent(in) :: law
      type(line_dent_t), intent(in) :: dent
      !> f [N/m]; what is not positive leaves the dent only
      real(dp), intent(in) :: force
      real(dp) :: share, t, lambda, slope, square

      if (.not. force > 0) then
         state%opening = 0
         state%overlap = dent%depth
      else if (force >= dent%force .or. .not. dent%yielded) then
         state = loading_state(law, force)
         state%loads = force >= dent%force
      else
         ! f/f_m = (1 - phi) lambda^2 + phi (1 - s), with t = 1 - s and lambda^2 = t (2 - t)
         share = force/dent%force
         associate (phi => dent%evenness)
            t = 2*share/(2 - phi + sqrt((2 - phi)**2 - 4*(1 - phi)*share))
            lambda = sqrt(t*(2 - t))
            slope = 2*(1 - phi)*(1 - t) + phi
         end associate
         state%force = force
         state%opening = t
         state%overlap = dent%overlap - drop(law, dent, lambda, 1 - t)
         state%half_width = lambda*dent%half_width
         state%dhalf_width_dforce = state%half_width*(1 - t)/(lambda**2*slope*dent%force)
         state%lens = dent%lens
         square = law%line%section*state%half_width**2
         state%stiffness = 1/elastic_compliance(law, dent%lens, square)
         state%elastic_stiffness = state%stiffness
         state%too_wide = dent%half_width > law%line%max_half_width .or. dent%lens > max(widest_lens, law%line%lens)
      end if
   end function line_state_at_force

   !> The contact at an overlap: the force is found by Newton's method between bounds.
   pure type(line_state_t) function line_state_at_overlap(law, dent, overlap) result(state)
      type(yielding_line_t), intent(in) :: law
      type(line_dent_t), intent(in) :: dent
      !> delta [m]
      real(dp), intent(in) :: overlap
      real(dp) :: low, high, force, step
      integer :: iteration

      state%overlap = overlap
      if (.not. overlap > dent%depth) return
      low = 0
      high = huge(high)
      step = 0
      force = force_near(law, dent, overlap)
      do iteration = 1, max_iterations
         state = line_state_at_force(law, dent, force)
         if (state%overlap < overlap) low = force
         if (state%overlap >= overlap) high = force
         step = (overlap - state%overlap)*state%stiffness
         if (abs(step) <= step_tolerance*force) exit
         if (force + step > low .and. force + step < high) then
            force = force + step
         else
            force = (low + high)/2
         end if
      end do
      state = line_state_at_force(law, dent, force + step)
      state%overlap = overlap
   end function line_state_at_overlap

   !> A force per length that is about that at an overlap, positive [N/m].
   pure real(dp) function force_near(law, dent, overlap) result(force)
      type(yielding_line_t), intent(in) :: law
      type(line_dent_t), intent(in) :: dent
      !> delta [m], beyond the dent
      real(dp), intent(in) :: overlap
      type(line_force_t) :: elastic
      type(profile_t) :: profile

      if (dent%yielded .and. overlap < dent%overlap) then
         force = dent%force*(overlap - dent%depth)/(dent%overlap - dent%depth)
         return
      end if
      elastic = line_force(law%line, overlap, 0.0_dp)
      force = elastic%force
      if (.not. (law%of_lens > law%of_section .and. force > law%lens_force)) return
      profile = profile_at(law%spot, overlap/law%spot%overlap)
      force = law%lens_force*profile%force
   end function force_near

   !> What the strip conducts per length, `1/g' = ((rho + rhob)/pi) Lam_e + sigma_f/(2 b)`, with A of the lens as it is.
   pure type(line_spot_t) function yielded_strip(law, state, film) result(spot)
      type(yielding_line_t), intent(in) :: law
      type(line_state_t), intent(in) :: state
      !> sigma_f, film resistance times area [ohm m^2]; 0: none
      real(dp), intent(in) :: film
      real(dp) :: section, width_slope, share, of_film

      if (.not. state%force > 0) return
      section = law%line%electric_section*state%half_width**2                              ! B_e
      width_slope = state%force*state%dhalf_width_dforce/state%half_width                  ! d ln b/d ln f
      share = (state%lens_slope*state%lens/2 + width_slope*section)/(state%lens + section) ! -d Lam_e/d ln f
      of_film = film/(2*state%half_width*law%spot_width)
      spot%half_width = state%half_width
      spot%too_wide = state%too_wide
      spot%conductance = 1/(-law%line%resistivity/(2*pi)*log(state%lens + section) + of_film)
      spot%dconductance_dforce = spot%conductance**2/state%force &
         *(law%line%resistivity/pi*share + width_slope*of_film)
      spot%dconductance_dresistivity = spot%conductance**2/(2*pi)*(log(state%lens + section) &
         - 2*section/(state%lens + section)*law%line%electric_offset)
   end function yielded_strip

   !> What comes back per length on the way to the dent, the integral of f over the overlap [J/m], with
   !> `t = 1 - sqrt(1 - lambda^2)` as `t_1 v^2`.
   pure real(dp) function returned_by_line(law, dent, opening) result(energy)
      type(yielding_line_t), intent(in) :: law
      !> Of the largest force, elastic or not
      type(line_dent_t), intent(in) :: dent
      !> t_1 [-]
      real(dp), intent(in) :: opening
      real(dp) :: t, square
      integer :: i

      energy = 0
      do i = 1, size(places)
         associate (phi => dent%evenness, f_m => dent%force)
            t = opening*places(i)**2
            square = law%line%section*dent%half_width**2*t*(2 - t)
            energy = energy + weights(i)*2*opening*places(i)*f_m**2*((1 - phi)*t*(2 - t) + phi*t) &
               *(2*(1 - phi)*(1 - t) + phi)*elastic_compliance(law, dent%lens, square)
         end associate
      end do
   end function returned_by_line

   !> What loading from a dent to another one dissipates per length: its work less what comes back of it [J/m].
   pure real(dp) function dissipated_by_line(law, before, after) result(lost)
      type(yielding_line_t), intent(in) :: law
      type(line_dent_t), intent(in) :: before, after
      type(line_dent_t) :: start
      real(dp) :: middle

      lost = 0
      if (.not. after%yielded .or. before%force >= after%force) return
      start = before
      if (.not. before%yielded) start = line_dent(law, law%onset)
      middle = min(max(start%force, law%force, law%lens_force), after%force)
      lost = returned_by_line(law, start, 1.0_dp) - returned_by_line(law, after, 1.0_dp)
      if (middle > start%force) lost = lost + work_between(law, start%force, middle)
      if (after%force > middle) lost = lost + work_between(law, middle, after%force)
   end function dissipated_by_line

   !> Work of loading from a force per length to another [J/m].
   pure real(dp) function work_between(law, from, to) result(work)
      type(yielding_line_t), intent(in) :: law
      !> [N/m]
      real(dp), intent(in) :: from, to
      type(line_state_t) :: state
      integer :: i

      work = 0
      do i = 1, size(places)
         state = loading_state(law, from + (to - from)*places(i))
         work = work + weights(i)*(to - from)*state%force/state%stiffness
      end do
   end function work_between

   !> Pressure in the middle of the strip [Pa].
   pure real(dp) function pressure_of_strip(dent, state) result(pressure)
      !> Of the largest force
      type(line_dent_t), intent(in) :: dent
      type(line_state_t), intent(in) :: state

      pressure = 0
      if (.not. state%force > 0) return
      associate (t => state%opening, phi => dent%evenness)
         pressure = dent%force/(pi*dent%half_width)*(2*(1 - phi)*sqrt(t*(2 - t)) + phi*acos(1 - t))
      end associate
   end function pressure_of_strip

   !> ddelta/df of a strip in an elastic half-space [m^2/N].
   pure real(dp) function elastic_compliance(law, lens, square) result(compliance)
      type(yielding_line_t), intent(in) :: law
      !> A, and B of the strip [-]
      real(dp), intent(in) :: lens, square

      compliance = (-log(lens + square) - square/(lens + square))/(pi*law%line%modulus)
   end function elastic_compliance

   !> On the loading curve (15.12).
   pure type(line_state_t) function loading_state(law, force) result(state)
      type(yielding_line_t), intent(in) :: law
      !> f [N/m]
      real(dp), intent(in) :: force
      type(line_overlap_t) :: elastic
      type(yielding_excess_t) :: beyond

      elastic = line_overlap(law%line, force, 0.0_dp)
      beyond%lens = law%line%lens
      if (force > law%onset) call add_excess(law, force, beyond)
      state%force = force
      associate (modulus => law%line%modulus)
         state%overlap = elastic%overlap + 2*force*beyond%logarithm/(pi*modulus)
         state%stiffness = 1/(1/elastic%stiffness + 2*(beyond%logarithm + beyond%dlogarithm)/(pi*modulus))
      end associate
      state%half_width = sqrt(law%line%square_per_force*force)*exp(beyond%widening)
      state%dhalf_width_dforce = state%half_width/force*(0.5_dp + beyond%dwidening)
      state%lens = beyond%lens
      state%lens_slope = beyond%lens_slope
      state%elastic_stiffness = 1/elastic_compliance(law, state%lens, law%line%section*state%half_width**2)
      state%too_wide = state%half_width > law%line%max_half_width*(1 + 4*epsilon(force)) &
         .or. state%lens > max(widest_lens, law%line%lens)
   end function loading_state

   !> What yielding adds beyond the onset.
   pure subroutine add_excess(law, force, beyond)
      type(yielding_line_t), intent(in) :: law
      !> f [N/m]
      real(dp), intent(in) :: force
      type(yielding_excess_t), intent(inout) :: beyond

      if (force > law%force) call add_strip(law, force, beyond)
      if (law%of_lens > 0 .and. force > law%lens_force) call add_lens(law, force, beyond)
   end subroutine add_excess

   !> Of wires side by side: the logarithm is less by ln(b/b_H), and they are flattened beyond that strip.
   pure subroutine add_strip(law, force, beyond)
      type(yielding_line_t), intent(in) :: law
      !> f [N/m]
      real(dp), intent(in) :: force
      type(yielding_excess_t), intent(inout) :: beyond
      real(dp) :: b, square, dsquare

      b = law%half_width + (force - law%force)/(pi*law%yield_pressure)
      square = b**2/(law%line%square_per_force*force)                                      ! (b/b_H)^2
      dsquare = 2*force/(pi*law%yield_pressure*b) - 1                                      ! d ln/d ln f
      associate (share => law%of_section)
         beyond%logarithm = beyond%logarithm + share*(square - 1 - log(square)/2)
         beyond%dlogarithm = beyond%dlogarithm + share*(square - 0.5_dp)*dsquare
         beyond%widening = beyond%widening + share*log(square)/2
         beyond%dwidening = beyond%dwidening + share*dsquare/2
      end associate
   end subroutine add_strip

   !> Of a short lens.
   pure subroutine add_lens(law, force, beyond)
      type(yielding_line_t), intent(in) :: law
      !> f [N/m]
      real(dp), intent(in) :: force
      type(yielding_excess_t), intent(inout) :: beyond
      type(profile_t) :: profile
      real(dp) :: dzeta

      profile = profile_of_force(law%spot, force/law%lens_force)
      dzeta = profile%force/profile%dforce                                                 ! dzeta/d ln f
      associate (share => law%of_lens, of_lens => law%lens_logarithm)
         beyond%logarithm = beyond%logarithm + share*of_lens*(profile%zeta/profile%force - 1)
         beyond%dlogarithm = beyond%dlogarithm + share*of_lens*(dzeta - profile%zeta)/profile%force
         beyond%widening = beyond%widening + share*log(profile%width/sqrt(profile%force))
         beyond%dwidening = beyond%dwidening + share*(profile%dwidth/profile%width*dzeta - 0.5_dp)
         beyond%lens = exp(-2*of_lens/profile%elastic)
         beyond%lens_slope = 2*of_lens*profile%delastic/profile%elastic**2*dzeta
      end associate
   end subroutine add_lens

   !> delta_m - delta on the way back (15.14) [m].
   pure real(dp) function drop(law, dent, lambda, s)
      type(yielding_line_t), intent(in) :: law
      type(line_dent_t), intent(in) :: dent
      !> lambda and sqrt(1 - lambda^2) [-]
      real(dp), intent(in) :: lambda, s
      real(dp) :: section, of_hertz

      section = law%line%section*dent%half_width**2
      of_hertz = -log(dent%lens + section)/2
      if (lambda > 0) of_hertz = of_hertz + lambda**2*log(dent%lens + section*lambda**2)/2
      drop = 2*dent%force/(pi*law%line%modulus) &
         *((1 - dent%evenness)*of_hertz + dent%evenness*even_drop(dent%lens, section, lambda, s))
   end function drop

   !> U of an even pressure (15.15): the integral over s of `Lam - B/(2 (A + B))`, `B` with `lambda^2 = 1 - s^2`.
   pure real(dp) function even_drop(lens, section, lambda, s) result(u)
      !> A, and B of the largest strip [-]
      real(dp), intent(in) :: lens, section
      !> lambda and sqrt(1 - lambda^2) [-]
      real(dp), intent(in) :: lambda, s
      real(dp) :: root, factor, present_log

      ! a lens that is the only far field gives way in proportion to the force
      if (.not. section > epsilon(section)**2*lens) then
         u = -s*log(lens)/2
         return
      end if
      root = sqrt(section/(lens + section))
      factor = (lens + 2*section)/(2*root*(lens + section))
      ! as a strip closes between parallel wires, what multiplies its logarithm goes to 0
      present_log = 0
      if (lambda > 0 .or. lens > 0) present_log = -log(lens + section*lambda**2)/2
      if (s*root < small_argument) then
         u = s*present_log + s/2 - factor*atanh(s*root)
      else
         u = (s - factor)*present_log + s/2 - factor*(log(lens + section)/2 + log(1 + s*root))
      end if
   end function even_drop

end module litz_yielding_line
