!> The contact of two wires of metal that yields per length along which they touch: the strip, the overlap, the dent.
!>
!> Source: theory section 15; the elastic law is that of litz_line_law, section 10, whose logarithm `Lam` sees the half
!> width as it is. Above the onset the half width goes on along its tangent, so that the mean pressure rises to twice
!> that at the onset; unloading is that of strips of less and less width in the same lens.
module litz_yielding_line
   use litz_kinds, only: dp, pi
   use litz_law_input, only: wire_pair_t
   use litz_line_law, only: line_wires_t, line_overlap_t, line_overlap, line_spot_t
   use litz_yielding_spot, only: onset_factor
   implicit none
   private
   public :: yielding_line_t, yielding_line, line_dent_t, line_dent, line_state_t, line_state_at_force, &
      line_state_at_overlap, yielded_strip, returned_by_line, dissipated_by_line, pressure_of_strip

   !> Newton stops at this relative change of the force; the error left is of the order of its square
   real(dp), parameter :: step_tolerance = 1.0e-9_dp
   integer, parameter :: max_iterations = 100
   !> Below this argument the inverse hyperbolic tangent is that of its own, else it is the difference of logarithms
   real(dp), parameter :: small_argument = 0.5_dp
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
   end type yielding_line_t

   !> What the largest force per length has made; all 0 where there was none.
   type :: line_dent_t
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

contains

   !> Onset of two wires that touch along a line (15.11).
   pure type(yielding_line_t) function yielding_line(line, wires, yield_stress) result(law)
      type(line_wires_t), intent(in) :: line
      type(wire_pair_t), intent(in) :: wires
      !> Of the barred and of the unbarred wire (2) [Pa], positive
      real(dp), intent(in) :: yield_stress(2)

      law%line = line
      law%yield_pressure = minval(onset_factor(wires%poisson, 0.0_dp)*yield_stress)
      law%half_width = pi*line%square_per_force*law%yield_pressure/2                       ! b_Y = 2 R p_Y/E*
      law%force = pi*law%half_width*law%yield_pressure/2
   end function yielding_line

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
      if (.not. force > law%force) return
      dent%evenness = 2*force/(pi*law%yield_pressure*dent%half_width) - 1                  ! (15.13)
      dent%depth = dent%overlap - drop(law, dent, 0.0_dp, 1.0_dp)
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
      else if (force >= dent%force .or. .not. dent%evenness > 0) then
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
      step = 0
      high = max(dent%force, law%force)
      do iteration = 1, max_iterations
         state = line_state_at_force(law, dent, high)
         if (state%overlap >= overlap) exit
         low = high
         high = 2*high
      end do
      force = (low + high)/2
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

   !> What the strip conducts per length, `1/g' = ((rho + rhob)/pi) Lam_e + sigma_f/(2 b)`, with A of the lens as it is.
   pure type(line_spot_t) function yielded_strip(law, state, film) result(spot)
      type(yielding_line_t), intent(in) :: law
      type(line_state_t), intent(in) :: state
      !> sigma_f, film resistance times area [ohm m^2]; 0: none
      real(dp), intent(in) :: film
      real(dp) :: section, width_slope, share

      if (.not. state%force > 0) return
      section = law%line%electric_section*state%half_width**2                              ! B_e
      width_slope = state%force*state%dhalf_width_dforce/state%half_width                  ! d ln b/d ln f
      share = (state%lens_slope*state%lens/2 + width_slope*section)/(state%lens + section) ! -d Lam_e/d ln f
      spot%half_width = state%half_width
      spot%too_wide = state%too_wide
      spot%conductance = 1/(-law%line%resistivity/(2*pi)*log(state%lens + section) + film/(2*state%half_width))
      spot%dconductance_dforce = spot%conductance**2/state%force &
         *(law%line%resistivity/pi*share + width_slope*film/(2*state%half_width))
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

   !> What loading up to a dent has dissipated per length: its work less what comes back [J/m].
   pure real(dp) function dissipated_by_line(law, dent) result(lost)
      type(yielding_line_t), intent(in) :: law
      type(line_dent_t), intent(in) :: dent
      type(line_state_t) :: state
      integer :: i

      lost = 0
      if (.not. dent%evenness > 0) return
      lost = returned_by_line(law, line_dent(law, law%force), 1.0_dp) - returned_by_line(law, dent, 1.0_dp)
      associate (beyond => dent%force - law%force)
         do i = 1, size(places)
            ! next to the onset little is dissipated
            state = loading_state(law, law%force + beyond*places(i))
            lost = lost + weights(i)*beyond*state%force/state%stiffness
         end do
      end associate
   end function dissipated_by_line

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
      real(dp) :: b, slope, square, widening

      elastic = line_overlap(law%line, force, 0.0_dp)
      state%force = force
      state%overlap = elastic%overlap
      state%stiffness = elastic%stiffness
      square = law%line%square_per_force                                                   ! b_H^2 = square f
      b = sqrt(square*force)
      slope = b/(2*force)
      if (force > law%force) then
         slope = 1/(pi*law%yield_pressure)
         b = law%half_width + (force - law%force)*slope
         ! the logarithm is less by ln(b/b_H), and the wires are flattened beyond that strip; 2 R = pi E* square/2
         associate (modulus => law%line%modulus)
            widening = log(b**2/(square*force))/2
            state%overlap = state%overlap + 2*(b**2/square - force*(1 + widening))/(pi*modulus)
            state%stiffness = 1/(1/elastic%stiffness &
               + 2*(2*b*slope/square - 1 - widening - (force*slope/b - 0.5_dp))/(pi*modulus))
         end associate
      end if
      state%half_width = b
      state%dhalf_width_dforce = slope
      state%lens = law%line%lens*b**2/(square*force)
      state%lens_slope = 2*force*slope/b - 1
      state%elastic_stiffness = 1/elastic_compliance(law, state%lens, law%line%section*b**2)
      state%too_wide = b > law%line%max_half_width*(1 + 4*epsilon(b)) .or. state%lens > max(widest_lens, law%line%lens)
   end function loading_state

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
