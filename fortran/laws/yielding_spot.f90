!> The contact of two crossed wires of metal that yields: force, spot and stored energy at an overlap, or at a force.
!>
!> Source: theory section 15. Loading goes from Hertz at the onset `F_Y` to the hardness with power laws, each explicit
!> both ways; unloading is that of an elastic half-space under the pressure that has been reached, so that the
!> conductance of the spot follows from the stiffness by (6.5). The one thing remembered is the largest force `F_m`: the
!> dent that it has made is computed at the present angle.
module litz_yielding_spot
   use litz_kinds, only: dp, pi
   use litz_elliptic, only: elliptic_t, elliptic_integrals_complementary
   use litz_hertz, only: hertz_ellipse_t
   use litz_unloading_curve, only: unloaded_depth, opening_of_rise, opening_of_force, relative_unloading, &
      returned_parts, segment
   implicit none
   private
   public :: yielding_t, yielding_crossing, dent_t, dent_of_force, yielding_state_t, state_at_overlap, state_at_force
   public :: onset_factor, largest_onset, default_hardness, yielding_ok, yielding_bad_data, yielding_too_soft

   !> Radius of a circle of the area of the spot over that of the thinner wire, beyond which H falls, and the metal is
   !> compacted: the law does not hold
   real(dp), parameter, public :: wide_spot = 0.3_dp, widest_spot = 0.5_dp

   integer, parameter :: yielding_ok = 0
   !> A yield stress that is not positive, or a hardness that is negative
   integer, parameter :: yielding_bad_data = -11
   !> The hardness is not above the pressure at which the metal begins to yield
   integer, parameter :: yielding_too_soft = -12

   !> Hardness over yield stress, where none is given (D. Tabor, The Hardness of Metals)
   real(dp), parameter :: hardness_ratio = 2.8_dp

   !> What the law needs of two wires at an angle.
   type :: yielding_t
      !> p_Y, H and E* [Pa]
      real(dp) :: yield_pressure = 0, hardness = 0, modulus = 0
      !> Onset of yielding: F_Y [N], delta_Y [m], A_Y [m^2]
      real(dp) :: force = 0, overlap = 0, area = 0
      !> h, and with it F_p/F_Y, the force beyond which H acts [-]; s of the area between [-]
      real(dp) :: steepness = 0, plastic_force = 0, exponent = 0
      !> `a_e = disc sqrt(area)`
      real(dp) :: disc = 0
      !> Derivatives by the angle of ln p_Y, ln F_Y, ln delta_Y, ln A_Y, ln h, ln disc and of s [1/rad]
      real(dp) :: dlog_pressure = 0, dlog_force = 0, dlog_overlap = 0, dlog_area = 0, dlog_steepness = 0, dlog_disc = 0
      real(dp) :: dexponent = 0
   end type yielding_t

   !> What the largest force has made; all 0 where there was none.
   type :: dent_t
      !> F_m [N], delta_m [m], dF/ddelta of the loading there [N/m] and its derivative by the force [1/m]
      real(dp) :: force = 0, overlap = 0, stiffness = 0, dstiffness_dforce = 0
      !> Area of the spot [m^2], a_e [m]; phi, 0 of Hertz's pressure and 1 of an even one; delta_res [m]
      real(dp) :: area = 0, disc = 0, evenness = 0, depth = 0
      !> Derivatives by the angle at this force, and by the force (2)
      real(dp) :: doverlap(2) = 0, darea(2) = 0, ddisc(2) = 0, devenness(2) = 0
      !> Work that has made it and the part of it that comes back [J]
      real(dp) :: work = 0, energy = 0
   end type dent_t

   !> The contact at an overlap or a force; all 0 but the overlap and the dissipation where there is no force.
   type :: yielding_state_t
      !> The force is the largest so far: it makes the dent
      logical :: loads = .false.
      !> delta [m], F [N], dF/ddelta [N/m] and its derivative by the force [1/m]
      real(dp) :: overlap = 0, force = 0, stiffness = 0, dstiffness_dforce = 0
      !> dF at fixed overlap by the angle [N/rad], and by the largest force [-] (2)
      real(dp) :: dforce(2) = 0
      !> Half axes of the spot over those of the largest one
      real(dp) :: opening = 0
      !> Area of the spot [m^2] and radius of the disc of the same conductance [m]
      real(dp) :: area = 0, disc = 0
      !> Their derivatives by the overlap, the angle and the largest force (3)
      real(dp) :: darea(3) = 0, ddisc(3) = 0
      !> What comes back on unloading, and what yielding has dissipated [J]; how the former changes at fixed overlap
      !> with the angle [J/rad] and with the largest force [m]
      real(dp) :: energy = 0, dissipation = 0, torque = 0, denergy_dlargest = 0
      !> Pressure in the middle of the spot [Pa]
      real(dp) :: pressure = 0
   end type yielding_state_t

contains

   !> C_Y, the largest pressure at the onset of yielding over the yield stress (15.1).
   elemental real(dp) function onset_factor(poisson, ratio)
      !> Poisson's ratio [-], and b/a of the spot
      real(dp), intent(in) :: poisson, ratio

      onset_factor = 1.295_dp*exp(0.736_dp*poisson)*(1 + 0.11_dp*(1 - ratio)**2.8_dp)
   end function onset_factor

   !> Pressure at the onset of yielding at most, at any angle and of any elastic metal [Pa].
   pure real(dp) function largest_onset(yield_stress)
      !> [Pa]
      real(dp), intent(in) :: yield_stress

      largest_onset = onset_factor(0.5_dp, 0.0_dp)*yield_stress
   end function largest_onset

   !> H of the softer metal where it is not given [Pa].
   pure real(dp) function default_hardness(yield_stress)
      !> (2) [Pa]
      real(dp), intent(in) :: yield_stress(2)

      default_hardness = hardness_ratio*minval(yield_stress)
   end function default_hardness

   !> Onset, limit and slopes of the law of two wires, and their derivatives by the angle.
   pure subroutine yielding_crossing(ellipse, poisson, yield_stress, hardness, law, info)
      type(hertz_ellipse_t), intent(in) :: ellipse
      !> Poisson's ratios (2) [-] and yield stresses (2) [Pa]: barred, unbarred
      real(dp), intent(in) :: poisson(2), yield_stress(2)
      !> H [Pa]; 0: 2.8 times the smaller yield stress
      real(dp), intent(in) :: hardness
      type(yielding_t), intent(out) :: law
      !> `yielding_ok` or what is wrong with the data
      integer, intent(out) :: info
      type(elliptic_t) :: f
      real(dp) :: area_per_force, e, dlog_ratio, of_angle, kappa, dlog_kappa, dplastic

      info = yielding_bad_data
      if (.not. all(yield_stress > 0) .or. .not. hardness >= 0) return
      e = ellipse%ratio
      dlog_ratio = ellipse%dlog_ratio_dangle
      law%yield_pressure = minval(onset_factor(poisson, e)*yield_stress)
      law%hardness = hardness
      if (.not. hardness > 0) law%hardness = default_hardness(yield_stress)
      info = yielding_too_soft
      if (.not. law%hardness > law%yield_pressure) return
      info = yielding_ok
      law%modulus = ellipse%modulus
      of_angle = 0.11_dp*(1 - e)**1.8_dp
      law%dlog_pressure = -2.8_dp*of_angle/(1 + of_angle*(1 - e))*e*dlog_ratio

      area_per_force = pi*ellipse%ratio*ellipse%semi_major**2                              ! pi a b = .. F^(2/3)
      law%force = (2*law%yield_pressure*area_per_force/3)**3                               ! 3 F/(2 pi a b) = p_Y
      law%area = area_per_force*law%force**(2.0_dp/3)
      law%overlap = ellipse%approach*law%force**(2.0_dp/3)
      law%dlog_force = 3*(law%dlog_pressure + ellipse%dlog_area_dangle)
      law%dlog_area = ellipse%dlog_area_dangle + 2*law%dlog_force/3
      law%dlog_overlap = ellipse%dapproach_dangle/ellipse%approach + 2*law%dlog_force/3

      ! kappa = delta_Y/(a b sqrt(A B)) is K/sqrt(D B) of the ellipse
      f = elliptic_integrals_complementary(e**2)
      kappa = f%k/sqrt(f%d*f%b)
      dlog_kappa = -f%b/f%k - (f%c/f%d - 1 - f%m1*f%c/f%b)/2                               ! by ln(b/a)
      law%steepness = kappa*law%hardness/law%yield_pressure
      law%dlog_steepness = dlog_kappa*dlog_ratio - law%dlog_pressure
      law%disc = sqrt(pi/e)/(2*f%k)                                                        ! a_e = pi a/(2 K)
      law%dlog_disc = (f%b/f%k - 0.5_dp)*dlog_ratio

      associate (h => law%steepness, f_p => law%plastic_force, s => law%exponent)
         f_p = 1 + 1.125_dp*(h**4 - 1)
         dplastic = 4.5_dp*h**4*law%dlog_steepness
         s = log(law%hardness/law%yield_pressure)/log(f_p)
         law%dexponent = -(law%dlog_pressure + s*dplastic/f_p)/log(f_p)
      end associate
   end subroutine yielding_crossing

   !> The dent of a force that the wires have loaded up to.
   pure type(dent_t) function dent_of_force(law, force) result(dent)
      type(yielding_t), intent(in) :: law
      !> F_m [N]; what is not positive makes none
      real(dp), intent(in) :: force
      real(dp) :: pressure, dpressure(2), range, omega, dforce_dangle

      if (.not. force > 0) return
      dent%force = force
      omega = relative_overlap(law%steepness, force/law%force)
      dent%overlap = law%overlap*omega
      call add_loading_slopes(law, omega, dent, dforce_dangle)
      dent%doverlap = [-dforce_dangle, 1.0_dp]/dent%stiffness
      call add_area(law, dent)
      dent%disc = law%disc*sqrt(dent%area)
      dent%ddisc = dent%disc*([law%dlog_disc, 0.0_dp] + dent%darea/(2*dent%area))
      if (force > law%force) then
         ! (15.4): the mean pressure between those of Hertz at the onset and of the hardness
         pressure = force/dent%area
         dpressure = [0.0_dp, 1/dent%area] - pressure*dent%darea/dent%area
         range = law%hardness - 2*law%yield_pressure/3
         dent%evenness = max((pressure - 2*law%yield_pressure/3)/range, 0.0_dp)
         dent%devenness = (dpressure &
            - [2*law%yield_pressure*law%dlog_pressure/3*(1 - dent%evenness), 0.0_dp])/range
      end if
      if (dent%evenness > 0) then
         dent%depth = dent%overlap - force/(law%modulus*dent%disc)*unloaded_depth(dent%evenness, 1.0_dp)
      end if
      dent%energy = returned_energy(law, dent, 1.0_dp, 0.0_dp)
   end function dent_of_force

   !> Stiffness, work and angle of the loading curve (15.2).
   pure subroutine add_loading_slopes(law, omega, dent, dforce_dangle)
      type(yielding_t), intent(in) :: law
      !> delta/delta_Y
      real(dp), intent(in) :: omega
      type(dent_t), intent(inout) :: dent
      !> At fixed overlap [N/rad]
      real(dp), intent(out) :: dforce_dangle
      real(dp) :: work, middle, beyond

      associate (h => law%steepness, unit => law%force/law%overlap)
         middle = min(omega, h**3)
         beyond = omega - middle
         if (omega <= 1) then
            dent%stiffness = 1.5_dp*unit*sqrt(omega)
            dent%dstiffness_dforce = 1/(2*dent%overlap)
            work = 0.4_dp*omega**2.5_dp
         else
            dent%stiffness = 1.5_dp*unit*middle**(1.0_dp/3)
            if (.not. beyond > 0) dent%dstiffness_dforce = 1/(3*dent%overlap)
            work = 0.4_dp - (middle - 1)/8 + 27*(middle**(7.0_dp/3) - 1)/56 &
               + (law%plastic_force + 0.75_dp*h*beyond)*beyond
         end if
         dent%work = law%force*law%overlap*work
         dforce_dangle = dent%force*law%dlog_force - dent%stiffness*dent%overlap*law%dlog_overlap &
            + law%force*1.5_dp*h*law%dlog_steepness*beyond
      end associate
   end subroutine add_loading_slopes

   !> Area of the spot on loading (15.3), and its derivatives.
   pure subroutine add_area(law, dent)
      type(yielding_t), intent(in) :: law
      type(dent_t), intent(inout) :: dent
      real(dp) :: f, middle, n, power, integral, dintegral, dmiddle

      f = dent%force/law%force
      if (f <= 1) then
         dent%area = law%area*f**(2.0_dp/3)
         dent%darea = dent%area*[law%dlog_area - 2*law%dlog_force/3, 2/(3*dent%force)]
         return
      end if
      n = 1 - law%exponent
      middle = min(f, law%plastic_force)
      dmiddle = -f*law%dlog_force
      if (f > middle) dmiddle = 4.5_dp*law%steepness**4*law%dlog_steepness
      power = middle**n
      integral = (power - 1)/n
      dintegral = power/middle*dmiddle - (power*log(middle) - integral)/n*law%dexponent
      dent%area = law%area*(1 + 2*integral/3)
      dent%darea(1) = dent%area*law%dlog_area + 2*law%area/3*dintegral
      dent%darea(2) = power/(middle*law%yield_pressure)
      if (.not. f > middle) return
      dent%area = dent%area + law%force*(f - middle)/law%hardness
      dent%darea(1) = dent%darea(1) - law%force*(dmiddle + middle*law%dlog_force)/law%hardness
      dent%darea(2) = 1/law%hardness
   end subroutine add_area

   !> The contact at an overlap, with the dent that the largest force has made.
   pure type(yielding_state_t) function state_at_overlap(law, dent, overlap) result(state)
      type(yielding_t), intent(in) :: law
      type(dent_t), intent(in) :: dent
      !> delta = -g [m]
      real(dp), intent(in) :: overlap
      type(dent_t) :: new
      real(dp) :: s, lambda

      if (overlap > 0 .and. (overlap >= dent%overlap .or. .not. dent%evenness > 0)) then
         new = dent_of_force(law, law%force*relative_force(law%steepness, overlap/law%overlap))
         state = loading_state(law, new, dent)
      else
         call opening_of_overlap(law, dent, overlap, lambda, s)
         state = unloading_state(law, dent, lambda, s)
         state%force = dent%force*relative_unloading(dent%evenness, lambda, s)
      end if
      state%overlap = overlap
   end function state_at_overlap

   !> The contact at a force, with the dent that the largest force has made.
   pure type(yielding_state_t) function state_at_force(law, dent, force) result(state)
      type(yielding_t), intent(in) :: law
      type(dent_t), intent(in) :: dent
      !> F [N]; what is not positive leaves the dent only
      real(dp), intent(in) :: force
      real(dp) :: s, lambda

      if (force > 0 .and. (force >= dent%force .or. .not. dent%evenness > 0)) then
         state = loading_state(law, dent_of_force(law, force), dent)
         state%overlap = law%overlap*relative_overlap(law%steepness, force/law%force)
      else
         call opening_of_force(dent%evenness, force/max(dent%force, tiny(force)), lambda, s)
         state = unloading_state(law, dent, lambda, s)
         if (dent%force > 0) state%overlap = overlap_of_opening(law, dent, lambda, s)
      end if
      state%force = max(force, 0.0_dp)
   end function state_at_force

   !> On the loading curve, or on the elastic one of wires that have not yielded.
   pure type(yielding_state_t) function loading_state(law, new, dent) result(state)
      type(yielding_t), intent(in) :: law
      !> What the force makes, and what was there
      type(dent_t), intent(in) :: new, dent
      real(dp) :: slopes(2)

      state%loads = new%force >= dent%force
      state%force = new%force
      state%stiffness = new%stiffness
      state%dstiffness_dforce = new%dstiffness_dforce
      state%dforce(1) = -new%stiffness*new%doverlap(1)
      state%opening = 1
      if (.not. state%loads) state%opening = sqrt(new%area/dent%area)
      state%area = new%area
      state%disc = new%disc
      state%darea(:2) = new%darea(2)*[new%stiffness, state%dforce(1)] + [0.0_dp, new%darea(1)]
      state%ddisc(:2) = new%ddisc(2)*[new%stiffness, state%dforce(1)] + [0.0_dp, new%ddisc(1)]
      state%energy = new%energy
      state%pressure = (1.5_dp - new%evenness/2)*new%force/new%area
      slopes = energy_slopes(law, new, 1.0_dp, 0.0_dp, new%force*new%doverlap)
      state%torque = slopes(1)
      if (.not. new%force > law%force) return
      state%denergy_dlargest = slopes(2)
      state%dissipation = new%work - new%energy
   end function loading_state

   !> On the way back from the largest force, all but the force and the overlap (15.5 to 15.7).
   pure type(yielding_state_t) function unloading_state(law, dent, lambda, s) result(state)
      type(yielding_t), intent(in) :: law
      type(dent_t), intent(in) :: dent
      !> Half axes of the spot over the largest ones, and sqrt(1 - lambda^2)
      real(dp), intent(in) :: lambda, s
      real(dp) :: phi, length, slope, dlog_length(2), ddrop(2), dsquare(3), slopes(2)

      phi = dent%evenness
      if (phi > 0) state%dissipation = dent%work - dent%energy
      if (.not. lambda > 0) return
      length = dent%force/(law%modulus*dent%disc)
      dlog_length = [0.0_dp, 1/dent%force] - dent%ddisc/dent%disc
      slope = 1.5_dp*(1 - phi)*s + 2*phi/pi                                                ! d(drop)/ds
      ! change of (15.5) at fixed overlap and s, then that of lambda^2 = 1 - s^2
      ddrop = dent%doverlap/length - unloaded_depth(phi, s)*dlog_length + (0.75_dp*s - 2/pi)*s*dent%devenness
      dsquare = -2*s/slope*[-1/length, ddrop]

      state%opening = lambda
      state%stiffness = 2*law%modulus*dent%disc*lambda                                     ! F' = 2 E* a_e lambda
      state%dstiffness_dforce = state%stiffness*s/(2*dent%force*lambda**3*slope)
      state%dforce = [0.0_dp, relative_unloading(phi, lambda, s)] - 2*dent%force*lambda*ddrop &
         + dent%force*(2*segment(lambda, s)/pi - lambda**3)*dent%devenness
      state%area = dent%area*lambda**2
      state%darea = dent%area*dsquare + lambda**2*[0.0_dp, dent%darea]
      state%disc = dent%disc*lambda
      state%ddisc = dent%disc*dsquare/(2*lambda) + lambda*[0.0_dp, dent%ddisc]
      state%energy = returned_energy(law, dent, lambda, s)
      state%pressure = (1.5_dp*(1 - phi)*lambda + 2*phi/pi*atan2(lambda, s))*dent%force/dent%area
      slopes = energy_slopes(law, dent, lambda, s, dent%force*relative_unloading(phi, lambda, s)*length*ddrop)
      state%torque = slopes(1)
      if (phi > 0) state%denergy_dlargest = slopes(2)
   end function unloading_state

   !> f(omega) of the loading (15.2).
   pure real(dp) function relative_force(h, omega) result(f)
      !> h, and delta/delta_Y
      real(dp), intent(in) :: h, omega

      if (omega <= 1) then
         f = omega*sqrt(omega)
      else if (omega <= h**3) then
         f = 1 + 1.125_dp*(omega**(4.0_dp/3) - 1)
      else
         f = 1 + 1.125_dp*(h**4 - 1) + 1.5_dp*h*(omega - h**3)
      end if
   end function relative_force

   !> omega(f), its inverse.
   pure real(dp) function relative_overlap(h, f) result(omega)
      !> h, and F/F_Y
      real(dp), intent(in) :: h, f
      real(dp) :: plastic

      plastic = 1 + 1.125_dp*(h**4 - 1)
      if (f <= 1) then
         omega = f**(2.0_dp/3)
      else if (f <= plastic) then
         omega = (1 + (f - 1)/1.125_dp)**0.75_dp
      else
         omega = h**3 + (f - plastic)/(1.5_dp*h)
      end if
   end function relative_overlap

   !> Overlap on the way back, from the end of the branch that it is near [m].
   pure real(dp) function overlap_of_opening(law, dent, lambda, s) result(overlap)
      type(yielding_t), intent(in) :: law
      type(dent_t), intent(in) :: dent
      !> lambda and sqrt(1 - lambda^2) [-]
      real(dp), intent(in) :: lambda, s
      real(dp) :: length, t

      length = dent%force/(law%modulus*dent%disc)
      t = lambda**2/(1 + s)
      if (s < 0.5_dp) then
         overlap = dent%overlap - length*unloaded_depth(dent%evenness, s)
      else
         overlap = dent%depth + length*t*((1 - dent%evenness)*(1.5_dp - 0.75_dp*t) + 2*dent%evenness/pi)
      end if
   end function overlap_of_opening

   !> lambda and s at an overlap on the way back, each from the end of the branch that it is near.
   pure subroutine opening_of_overlap(law, dent, overlap, lambda, s)
      type(yielding_t), intent(in) :: law
      type(dent_t), intent(in) :: dent
      !> delta [m], at most that of the dent
      real(dp), intent(in) :: overlap
      !> [-]
      real(dp), intent(out) :: lambda, s
      real(dp) :: stiffness

      lambda = 0
      s = 1
      if (.not. overlap > dent%depth) return
      stiffness = law%modulus*dent%disc/dent%force
      call opening_of_rise(dent%evenness, (overlap - dent%depth)*stiffness, (dent%overlap - overlap)*stiffness, &
         lambda, s)
   end subroutine opening_of_overlap

   !> What comes back on the way from lambda to the dent [J] (15.8).
   pure real(dp) function returned_energy(law, dent, lambda, s) result(energy)
      type(yielding_t), intent(in) :: law
      type(dent_t), intent(in) :: dent
      !> lambda and sqrt(1 - lambda^2) [-]
      real(dp), intent(in) :: lambda, s
      real(dp) :: parts(3)

      parts = returned_parts(lambda, s)
      associate (phi => dent%evenness)
         energy = dent%force**2/(2*law%modulus*dent%disc) &
            *((1 - phi)**2*parts(1) + phi*(1 - phi)*parts(2) + phi**2*parts(3))
      end associate
   end function returned_energy

   !> How what comes back changes at fixed overlap with the angle [J/rad] and with the largest force [m] (2): through
   !> the disc, through phi, and as lambda follows the overlap of the dent, where its change is the force times that of
   !> the overlap.
   pure function energy_slopes(law, dent, lambda, s, work) result(slopes)
      type(yielding_t), intent(in) :: law
      type(dent_t), intent(in) :: dent
      !> lambda and sqrt(1 - lambda^2) [-]
      real(dp), intent(in) :: lambda, s
      !> Force times change of the overlap at fixed lambda, by the angle [J/rad] and by the largest force [m] (2)
      real(dp), intent(in) :: work(2)
      real(dp) :: slopes(2), parts(3)

      parts = returned_parts(lambda, s)
      associate (phi => dent%evenness)
         slopes = returned_energy(law, dent, lambda, s)*([0.0_dp, 2/dent%force] - dent%ddisc/dent%disc) - work &
            + dent%force**2/(2*law%modulus*dent%disc)*dent%devenness &
            *(-2*(1 - phi)*parts(1) + (1 - 2*phi)*parts(2) + 2*phi*parts(3))
      end associate
   end function energy_slopes

end module litz_yielding_spot
