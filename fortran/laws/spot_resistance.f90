!> Resistance of a spot of any shape: Holm's constriction, what of it remains where electrons fly through, and a film.
!>
!> Source: theory section 15; R. Holm, Electric Contacts; G. Wexler, Proc. Phys. Soc. 89 (1966) 927-941. For a spot with
!> the conductance of a disc of radius `a_e` and the area `S`:
!> `1/G = sum of rho gamma(l/a_e)/(4 a_e) + (2/3) sum of rho l/S + sigma_f/S`, the sums over both wires. The product of
!> resistivity and mean free path, `rho l`, is a constant of the metal, whatever its temperature.
module litz_spot_resistance
   use litz_kinds, only: dp, pi
   use litz_hertz, only: hertz_ellipse_t
   use litz_spot_law, only: contact_spot_t, spot_law_t
   implicit none
   private
   public :: spot_metal_t, metal_of_law, elastic_spot, set_conductance

   !> `gamma(k) = (1 + above k)/(1 + below k)`: within 0.2 % of the solution of the Boltzmann equation
   real(dp), parameter :: above = 0.9_dp, below = 1.25_dp

   !> What conducts, barred before unbarred wire.
   type :: spot_metal_t
      !> rho (2) [ohm m], and rho l of the mean free path l of the electrons (2) [ohm m^2]
      real(dp) :: resistivity(2) = 0, resistivity_path(2) = 0
      !> sigma_f, film resistance times area [ohm m^2]; 0: none
      real(dp) :: film = 0
      !> l of both wires at the resistivities above, in place of rho l [m]; 0: not given
      real(dp) :: free_path = 0
   end type spot_metal_t

contains

   !> What conducts between wires of a spot of the mechanics.
   pure type(spot_metal_t) function metal_of_law(law, resistivity) result(metal)
      type(spot_law_t), intent(in) :: law
      !> Barred, unbarred (2) [ohm m]
      real(dp), intent(in) :: resistivity(2)

      metal%resistivity = resistivity
      if (law%film_number > 0) metal%film = law%data(law%film_number)
      if (law%path_number > 0) metal%resistivity_path = law%data(law%path_number)
      if (law%free_path_number > 0) metal%free_path = law%data(law%free_path_number)
   end function metal_of_law

   !> The spot of Hertz under a positive force.
   pure type(contact_spot_t) function elastic_spot(ellipse, force, metal) result(spot)
      type(hertz_ellipse_t), intent(in) :: ellipse
      !> F [N]
      real(dp), intent(in) :: force
      type(spot_metal_t), intent(in) :: metal
      real(dp) :: disc, area

      spot%semi_major = ellipse%semi_major*force**(1.0_dp/3)
      spot%semi_minor = ellipse%ratio*spot%semi_major
      spot%approach = ellipse%approach*force**(2.0_dp/3)
      area = pi*spot%semi_major*spot%semi_minor
      disc = 3*force/(4*ellipse%modulus*spot%approach)                                     ! pi a/(2 K)
      call set_conductance(metal, disc, disc*[1/(3*force), -ellipse%dapproach_dangle/ellipse%approach], &
         area, area*[2/(3*force), ellipse%dlog_area_dangle], spot)
   end function elastic_spot

   !> Conductance of a spot and its derivatives (15.9, 15.10).
   pure subroutine set_conductance(metal, disc, ddisc, area, darea, spot)
      type(spot_metal_t), intent(in) :: metal
      !> a_e [m], and its derivatives by the force at fixed angle [m/N], or by whatever else changes it, and by the
      !> angle at fixed force [m/rad]
      real(dp), intent(in) :: disc, ddisc(2)
      !> S [m^2], and its derivatives by the same [m^2/N, m^2/rad]
      real(dp), intent(in) :: area, darea(2)
      type(contact_spot_t), intent(inout) :: spot
      real(dp) :: constriction, dconstriction_ddisc, across, dresistance(2)
      real(dp), dimension(2) :: path, upper, lower

      path = metal%resistivity_path + metal%resistivity*metal%free_path
      associate (rho => metal%resistivity)
         upper = rho*disc + above*path
         lower = rho*disc + below*path
         constriction = sum(rho*upper/lower)/(4*disc)
         dconstriction_ddisc = sum((rho/lower)**2*(below - above)*path)/(4*disc) - constriction/disc
         across = 2*sum(path)/3 + metal%film
         spot%conductance = 1/(constriction + across/area)
         spot%dconductance_dresistivity = -spot%conductance**2*((rho*disc/lower*(1 - upper/lower) &
            + upper/lower)/(4*disc) + metal%free_path*(rho/(4*disc*lower)*(above - below*upper/lower) + 2/(3*area)))
      end associate
      dresistance = dconstriction_ddisc*ddisc - across/area**2*darea
      spot%dconductance_dforce = -spot%conductance**2*dresistance(1)
      spot%dconductance_dangle = -spot%conductance**2*dresistance(2)
   end subroutine set_conductance

end module litz_spot_resistance
