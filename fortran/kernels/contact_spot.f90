!> From the contact force to the contact spot and its electrical conductance.
!>
!> Source: theory section 6; R. Holm, Electric Contacts, for the constriction resistance. In all laws `rho` is the
!> resistivity of the wires, `a` and `b` the semi-axes of the spot, `R_c = 1/G` its resistance:
!>
!> | law      | spot                                              | resistance                      | approach       |
!> |----------|---------------------------------------------------|---------------------------------|----------------|
!> | PAPER    | `a = (3 F r*/(4 E*))^(1/3)`, `r* = r rb/(r + rb)`  | `(rho1 + rho2)/(4 a)`           | `a^2/r*`       |
!> | HERTZ    | exact ellipse, see litz_hertz                     | `(rho1 + rho2) K(m)/(2 pi a)`   | Hertz          |
!> | PLASTIC  | `F = pi a^2 H`                                    | `(rho1 + rho2)/(4 a)`           | 0: rigid       |
!> | FILM     | as HERTZ                                          | HERTZ `+ sigma_f/(pi a b)`      | Hertz          |
!> | CONSTANT | none: semi-axes 0                                 | given                           | 0              |
!> | TABLE    | none: semi-axes 0                                 | `R_c(F)`, see `table_resistance_at` | 0          |
!>
!> PAPER is kept to replay the paper: its `r*` is that of two spheres, so that equal wires at 90 degrees get a spot 21 %
!> too small and a resistance 26 % too large (theory section 1).
!>
!> Without a force there is no spot: the conductance is 0, and so are both derivatives, although the slope of
!> `F^(1/3)` is infinite there. CONSTANT and TABLE, too, conduct only under a positive force.
module litz_contact_spot
   use litz_kinds, only: dp, pi
   use litz_laws, only: spot_none, spot_paper, spot_hertz, spot_plastic, spot_film, spot_constant, spot_table, &
      spot_law_uses_ellipse
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok, effective_modulus
   implicit none
   private
   public :: contact_spot_t, contact_spot, contact_spot_of_ellipse
   public :: spot_ok, spot_parallel, spot_unknown_law, spot_bad_table

   integer, parameter :: spot_ok = 0
   !> Laws of the Hertz ellipse: the axes are parallel and the ellipse infinitely long
   integer, parameter :: spot_parallel = -1
   integer, parameter :: spot_unknown_law = -2
   !> TABLE: no pair at all, forces not ascending, or an entry that is not positive
   integer, parameter :: spot_bad_table = -3

   !> A spot and its conductance. All are 0 where there is none.
   type :: contact_spot_t
      !> Semi-axes [m]
      real(dp) :: semi_major = 0, semi_minor = 0
      !> Elastic approach of the two axes [m]
      real(dp) :: approach = 0
      !> G [S], dG/dF [S/N] at fixed angle, dG/dangle [S/rad] at fixed force
      real(dp) :: conductance = 0, dconductance_dforce = 0, dconductance_dangle = 0
   end type contact_spot_t

contains

   !> Spot and conductance of one contact, with the derivatives of the conductance.
   pure subroutine contact_spot(law, force, radius, young, poisson, resistivity, angle, law_value, table_force, &
      table_resistance, spot, info)
      !> One of the constants `spot_...` of litz_laws
      integer, intent(in) :: law
      !> Contact force [N], positive in contact
      real(dp), intent(in) :: force
      !> Wire radii (2) [m]: barred, unbarred
      real(dp), intent(in) :: radius(2)
      !> Young's moduli (2) [Pa], Poisson's ratios (2) [-], resistivities (2) [ohm m]: barred, unbarred
      real(dp), intent(in) :: young(2), poisson(2), resistivity(2)
      !> Angle between the tangents [rad], in (0, pi)
      real(dp), intent(in) :: angle
      !> The number that is the law's data, see `spot_laws` of litz_laws: hardness, film resistivity, resistance
      real(dp), intent(in) :: law_value
      !> TABLE: forces (n) [N], ascending, and resistances (n) [ohm], all positive; else not used
      real(dp), intent(in) :: table_force(:), table_resistance(:)
      type(contact_spot_t), intent(out) :: spot
      !> `spot_ok`, or what is wrong; there is no spot then
      integer, intent(out) :: info
      type(hertz_ellipse_t) :: ellipse
      integer :: ellipse_info

      info = spot_parallel
      if (spot_law_uses_ellipse(law)) then
         call hertz_ellipse(radius, young, poisson, angle, ellipse, ellipse_info)
         if (ellipse_info /= hertz_ok) return
      end if
      call contact_spot_of_ellipse(law, force, radius, young, poisson, resistivity, ellipse, law_value, table_force, &
         table_resistance, spot, info)
   end subroutine contact_spot

   !> The same where the Hertz ellipse is already known (laws that do not use it do not look at it).
   pure subroutine contact_spot_of_ellipse(law, force, radius, young, poisson, resistivity, ellipse, law_value, &
      table_force, table_resistance, spot, info)
      !> One of the constants `spot_...` of litz_laws
      integer, intent(in) :: law
      !> Contact force [N], positive in contact
      real(dp), intent(in) :: force
      !> Wire radii (2) [m]: barred, unbarred
      real(dp), intent(in) :: radius(2)
      !> Young's moduli (2) [Pa], Poisson's ratios (2) [-], resistivities (2) [ohm m]: barred, unbarred
      real(dp), intent(in) :: young(2), poisson(2), resistivity(2)
      !> From `hertz_ellipse` at the present angle
      type(hertz_ellipse_t), intent(in) :: ellipse
      !> The number that is the law's data, see `spot_laws` of litz_laws: hardness, film resistivity, resistance
      real(dp), intent(in) :: law_value
      !> TABLE: forces (n) [N], ascending, and resistances (n) [ohm], all positive; else not used
      real(dp), intent(in), optional :: table_force(:), table_resistance(:)
      type(contact_spot_t), intent(out) :: spot
      !> `spot_ok`, or what is wrong; there is no spot then
      integer, intent(out) :: info
      real(dp) :: rho, r_star, film, resistance, slope

      info = spot_ok
      if (force <= 0) return
      rho = sum(resistivity)

      select case (law)
      case (spot_none)
         return
      case (spot_paper)
         r_star = product(radius)/sum(radius)
         spot%semi_major = (3*force*r_star/(4*effective_modulus(young, poisson)))**(1.0_dp/3)
         spot%semi_minor = spot%semi_major
         spot%approach = spot%semi_major**2/r_star
         spot%conductance = 4*spot%semi_major/rho                               ! R_c = (rho1+rho2)/(4a)
         spot%dconductance_dforce = spot%conductance/(3*force)
      case (spot_hertz, spot_film)
         spot%semi_major = ellipse%semi_major*force**(1.0_dp/3)
         spot%semi_minor = ellipse%ratio*spot%semi_major
         spot%approach = ellipse%approach*force**(1.0_dp/3)*force**(1.0_dp/3)
         spot%conductance = 3*force/(rho*ellipse%modulus*spot%approach)         ! R_c = (rho1+rho2) K/(2 pi a)
         spot%dconductance_dforce = spot%conductance/(3*force)
         spot%dconductance_dangle = -spot%conductance*ellipse%dapproach_dangle/ellipse%approach
         if (law == spot_film) then
            film = law_value/(pi*spot%semi_major*spot%semi_minor)               ! R_f = sigma_f/(pi a b)
            call add_in_series(film, -2*film/(3*force), -film*ellipse%dlog_area_dangle, spot)
         end if
      case (spot_plastic)
         spot%semi_major = sqrt(force/(pi*law_value))                           ! F = pi a^2 H
         spot%semi_minor = spot%semi_major
         spot%conductance = 4*spot%semi_major/rho
         spot%dconductance_dforce = spot%conductance/(2*force)
      case (spot_constant)
         spot%conductance = 1/law_value
      case (spot_table)
         info = spot_bad_table
         if (.not. (present(table_force) .and. present(table_resistance))) return
         call table_resistance_at(force, table_force, table_resistance, resistance, slope, info)
         if (info /= spot_ok) return
         spot%conductance = 1/resistance
         spot%dconductance_dforce = -slope/resistance**2
      case default
         info = spot_unknown_law
      end select
   end subroutine contact_spot_of_ellipse

   !> `1/G <- 1/G + R` and the derivatives that follow.
   pure subroutine add_in_series(resistance, dresistance_dforce, dresistance_dangle, spot)
      !> R [ohm], dR/dF [ohm/N], dR/dangle [ohm/rad]
      real(dp), intent(in) :: resistance, dresistance_dforce, dresistance_dangle
      type(contact_spot_t), intent(inout) :: spot
      real(dp) :: share

      share = 1/(1 + spot%conductance*resistance)
      spot%conductance = spot%conductance*share
      spot%dconductance_dforce = spot%dconductance_dforce*share**2 - spot%conductance**2*dresistance_dforce
      spot%dconductance_dangle = spot%dconductance_dangle*share**2 - spot%conductance**2*dresistance_dangle
   end subroutine add_in_series

   !> `R_c(F)` through the pairs of a table: smooth, and monotone wherever the table is.
   !>
   !> Piecewise cubic in `log R` over `log F` (power laws are straight there and reproduced exactly) with the slopes of
   !> Fritsch and Butland. Below the first and above the last pair the power law of the end slope continues, so that
   !> the resistance of a falling table grows without bound as the contact opens. One pair alone: constant.
   pure subroutine table_resistance_at(force, table_force, table_resistance, resistance, slope, info)
      !> F [N], positive
      real(dp), intent(in) :: force
      !> Forces (n) [N], ascending, and resistances (n) [ohm]
      real(dp), intent(in) :: table_force(:), table_resistance(:)
      !> R_c [ohm] and dR_c/dF [ohm/N]
      real(dp), intent(out) :: resistance, slope
      !> `spot_ok` or `spot_bad_table`
      integer, intent(out) :: info
      real(dp) :: x, h, s, d(2), y(2), value, derivative
      integer :: n, i

      resistance = 0
      slope = 0
      info = spot_bad_table
      n = size(table_force)
      if (n < 1 .or. size(table_resistance) /= n) return
      if (.not. (all(table_force > 0) .and. all(table_resistance > 0))) return
      if (any(table_force(2:) <= table_force(:n - 1))) return
      info = spot_ok
      if (n == 1) then
         resistance = table_resistance(1)
         return
      end if

      x = log(force)
      i = min(max(count(table_force <= force), 1), n - 1)
      h = log(table_force(i + 1)/table_force(i))
      s = (x - log(table_force(i)))/h
      y = log(table_resistance(i:i + 1))
      d = [table_slope(i, table_force, table_resistance), table_slope(i + 1, table_force, table_resistance)]
      if (s <= 0) then
         value = y(1) + d(1)*h*s
         derivative = d(1)
      else if (s >= 1) then
         value = y(2) + d(2)*h*(s - 1)
         derivative = d(2)
      else
         value = y(1)*(1 + 2*s)*(1 - s)**2 + y(2)*s**2*(3 - 2*s) + h*s*(1 - s)*(d(1)*(1 - s) - d(2)*s)
         derivative = 6*s*(1 - s)*(y(2) - y(1))/h + d(1)*(1 - s)*(1 - 3*s) + d(2)*s*(3*s - 2)
      end if
      resistance = exp(value)
      slope = derivative*resistance/force
   end subroutine table_resistance_at

   !> Slope of `log R` over `log F` at pair `i`.
   !>
   !> Source: F. N. Fritsch, J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300: the weighted harmonic mean of the two
   !> neighbouring slopes, 0 where they differ in sign; at an end that of the only neighbour.
   pure real(dp) function table_slope(i, table_force, table_resistance) result(slope)
      !> Number of the pair
      integer, intent(in) :: i
      !> Forces (n) [N], ascending
      real(dp), intent(in) :: table_force(:)
      !> Resistances (n) [ohm]
      real(dp), intent(in) :: table_resistance(:)
      real(dp) :: h(2), s(2), weight
      integer :: j, n

      n = size(table_force)
      do j = max(i - 1, 1), min(i, n - 1)
         h(j - i + 2) = log(table_force(j + 1)/table_force(j))
         s(j - i + 2) = log(table_resistance(j + 1)/table_resistance(j))/h(j - i + 2)
      end do
      if (i == 1) then
         slope = s(2)
      else if (i == n) then
         slope = s(1)
      else if (s(1)*s(2) > 0) then
         weight = (h(1) + 2*h(2))/(3*(h(1) + h(2)))
         slope = s(1)*s(2)/(weight*s(2) + (1 - weight)*s(1))
      else
         slope = 0
      end if
   end function table_slope

end module litz_contact_spot
