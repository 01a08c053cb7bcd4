!> Resistance of a spot of any shape: Holm's constriction, what of it remains where electrons fly through, and a film.
!>
!> Source: theory section 15; R. Holm, Electric Contacts; G. Wexler, Proc. Phys. Soc. 89 (1966) 927-941. For a spot with
!> the conductance of a disc of radius `a_e` and the area `S`:
!> `1/G = sum of rho gamma(l/a_e)/(4 a_e) + (2/3) sum of rho l/S + sigma_f/S`, the sums over both wires.
module litz_spot_resistance
   use litz_kinds, only: dp, pi
   use litz_hertz, only: hertz_ellipse_t
   use litz_spot_law, only: contact_spot_t
   use litz_yielding_spot, only: yielding_t, dent_t, yielding_state_t, state_at_force
   implicit none
   private
   public :: spot_metal_t, elastic_spot, yielded_spot, set_conductance

   !> `gamma(k) = (1 + above k)/(1 + below k)`: within 0.2 % of the solution of the Boltzmann equation
   real(dp), parameter :: above = 0.9_dp, below = 1.25_dp

   !> What conducts, barred before unbarred wire.
   type :: spot_metal_t
      !> Resistivities (2) [ohm m] and mean free paths of the electrons (2) [m]
      real(dp) :: resistivity(2) = 0, mean_free_path(2) = 0
      !> sigma_f, film resistance times area [ohm m^2]; 0: none
      real(dp) :: film = 0
   end type spot_metal_t

contains

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

   !> The spot of metal that yields under a positive force, with the dent that the largest force has made.
   pure type(contact_spot_t) function yielded_spot(law, dent, ratio, force, metal) result(spot)
      type(yielding_t), intent(in) :: law
      type(dent_t), intent(in) :: dent
      !> b/a of the ellipse, and F [N]
      real(dp), intent(in) :: ratio, force
      type(spot_metal_t), intent(in) :: metal
      type(yielding_state_t) :: state
      real(dp) :: by_force(2)

      state = state_at_force(law, dent, force)
      spot%semi_major = sqrt(state%area/(pi*ratio))
      spot%semi_minor = ratio*spot%semi_major
      spot%approach = state%overlap
      by_force = [1.0_dp, -state%dforce(1)]/state%stiffness                               ! ddelta by F and by the angle
      call set_conductance(metal, state%disc, state%ddisc(1)*by_force + [0.0_dp, state%ddisc(2)], &
         state%area, state%darea(1)*by_force + [0.0_dp, state%darea(2)], spot)
   end function yielded_spot

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

      associate (rho => metal%resistivity, l => metal%mean_free_path)
         constriction = sum(rho*(disc + above*l)/(disc + below*l))/(4*disc)
         dconstriction_ddisc = sum(rho*(below - above)*l/(disc + below*l)**2)/(4*disc) - constriction/disc
         across = 2*dot_product(rho, l)/3 + metal%film
      end associate
      spot%conductance = 1/(constriction + across/area)
      dresistance = dconstriction_ddisc*ddisc - across/area**2*darea
      spot%dconductance_dforce = -spot%conductance**2*dresistance(1)
      spot%dconductance_dangle = -spot%conductance**2*dresistance(2)
      associate (l => metal%mean_free_path)
         spot%dconductance_dresistivity = -spot%conductance**2*((disc + above*l)/(disc + below*l)/(4*disc) &
            + 2*l/(3*area))
      end associate
   end subroutine set_conductance

end module litz_spot_resistance
