!> Electrical residual and tangent of one contact, and its coupling to the mechanics.
!>
!> Source: theory section 5 and the paper's "Electric contact": `delta Pi_e = I delta g_V`, with the parts of its
!> linearisation named as in the paper, `K_me1`, `K_me2` and `K_me3`. Two more, which the paper does not have: `K_me4`
!> where the conductance depends on the crossing angle, `K_me5` where the voltage is corrected.
!>
!> Correction of the voltage (theory section 7): the voltage within an element is linear, so that a current entering
!> it at xi is seen through a resistance too small by `s (1 - xi^2)` per beam, `s = rho L0/(4 A)`. It is added in series
!> to the spot; `s = 0` gives the paper's linear voltage.
module litz_contact_electricity
   use litz_kinds, only: dp
   use litz_contact_kinematics, only: contact_kinematics_t
   use litz_normal_law, only: force_of_gap_t
   use litz_spot_law, only: contact_spot_t
   implicit none
   private
   public :: contact_electricity_t, contact_electricity, current_of_spot, coupling_tangent, coupling_parts, &
      conductance_row

   type :: contact_electricity_t
      !> I [A], from the barred to the unbarred beam
      real(dp) :: current = 0
      !> Voltage across the spot itself [V], I R_c; without a correction it is the paper's `g_V = Vb - V`
      real(dp) :: voltage_gap = 0
      !> N_V, with `g_V = N_V . V` over the voltages of barred 1, barred 2, 1, 2
      real(dp) :: n_v(4) = 0
      !> Currents leaving the four nodes [A], and the tangent over their voltages [S]
      real(dp) :: r_e(4) = 0, k_ee(4, 4) = 0
      !> Rows over the 24 mechanical unknowns that N_V multiplies in K_me1, K_me2, K_me4 and K_me5; along a line K_me2
      !> has what touches of a part of it, too
      real(dp) :: me1(24) = 0, me2(24) = 0, me4(24) = 0, me5(24) = 0
      !> How the conductance changes with these unknowns [S/m, S/rad]
      real(dp) :: dconductance(24) = 0
   end type contact_electricity_t

contains

   !> Currents and tangents of a spot that the contact force makes, which follows the gap and the angle.
   pure subroutine current_of_spot(kinematics, v, normal, spot, follows, series_resistance, dconductance, electricity)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Nodal voltages (4) [V]: barred 1, barred 2, 1, 2
      real(dp), intent(in) :: v(4)
      type(force_of_gap_t), intent(in) :: normal
      type(contact_spot_t), intent(in) :: spot
      !> 1: the spot is that of the present force, 0: that of an earlier one
      real(dp), intent(in) :: follows
      !> s = rho L0/(4 A) (2) [ohm]: barred, unbarred; 0: no correction
      real(dp), intent(in) :: series_resistance(2)
      !> How the conductance changes with the mechanical unknowns besides (24) [S/m, S/rad]
      real(dp), intent(in) :: dconductance(24)
      type(contact_electricity_t), intent(out) :: electricity

      associate (dg_dforce => spot%dconductance_dforce*follows)
         call contact_electricity(kinematics, v, spot%conductance, dg_dforce*normal%dforce_dgap, &
            spot%dconductance_dangle + dg_dforce*normal%dforce_dangle, dconductance, series_resistance, electricity)
      end associate
   end subroutine current_of_spot

   !> Currents and tangents of a spot of known conductance.
   pure subroutine contact_electricity(kinematics, v, conductance, dconductance_dgap, dconductance_dangle, &
      dconductance, series_resistance, electricity)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Nodal voltages (4) [V]: barred 1, barred 2, 1, 2
      real(dp), intent(in) :: v(4)
      !> Of the spot: G [S], dG/dg [S/m] at fixed angle and dG/dangle [S/rad] at fixed gap
      real(dp), intent(in) :: conductance, dconductance_dgap, dconductance_dangle
      !> How it changes with the mechanical unknowns besides (24) [S/m, S/rad]
      real(dp), intent(in) :: dconductance(24)
      !> s = rho L0/(4 A) (2) [ohm]: barred, unbarred; 0: no correction
      real(dp), intent(in) :: series_resistance(2)
      type(contact_electricity_t), intent(out) :: electricity
      real(dp) :: g, g_v, current, share, slope_bar, slope
      integer :: j

      associate (xi_bar => kinematics%xi_bar, xi => kinematics%xi, n_v => electricity%n_v, s => series_resistance)
         n_v = [(1 - xi_bar)/2, (1 + xi_bar)/2, -(1 - xi)/2, -(1 + xi)/2]
         g_v = dot_product(n_v, v)                                                          ! g_V = Vb - V
         slope_bar = (v(2) - v(1))/2                                                        ! Vb'
         slope = (v(4) - v(3))/2                                                            ! V'
         ! 1/(R_c + sum s (1-xi^2)) = G share, and its derivative with respect to G is share^2
         share = share_of_spot(kinematics, conductance, s)
         g = conductance*share
         current = g*g_v                                                                    ! I = G g_V

         electricity%current = current
         electricity%voltage_gap = share*g_v
         electricity%r_e = current*n_v                                                      ! R_e = I N_V
         do j = 1, 4
            electricity%k_ee(:, j) = g*(n_v*n_v(j))                                         ! K_ee = G N_V N_V^T
         end do
         electricity%dconductance = conductance_row(kinematics, dconductance_dgap, dconductance_dangle, dconductance)
         electricity%me1 = g*(slope_bar*kinematics%rows%dxi_bar - slope*kinematics%rows%dxi)   ! G (Vb' dxib - V' dxi)
         electricity%me2 = g_v*share**2*(dconductance_dgap*kinematics%dgap + dconductance)  ! (dI/dg) dg
         electricity%me4 = g_v*share**2*dconductance_dangle*kinematics%rows%dangle               ! (dI/dangle) dangle
         electricity%me5 = 2*g*current*(s(1)*xi_bar*kinematics%rows%dxi_bar + s(2)*xi*kinematics%rows%dxi)
      end associate
   end subroutine contact_electricity

   !> How the conductance of a spot changes with the 24 mechanical unknowns [S/m, S/rad].
   pure function conductance_row(kinematics, dconductance_dgap, dconductance_dangle, dconductance) result(row)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> As of `contact_electricity`
      real(dp), intent(in) :: dconductance_dgap, dconductance_dangle, dconductance(24)
      real(dp) :: row(24)

      row = dconductance_dgap*kinematics%dgap + dconductance_dangle*kinematics%rows%dangle + dconductance
   end function conductance_row

   !> Of the voltage between the wires, what is across the spot.
   pure real(dp) function share_of_spot(kinematics, conductance, series_resistance) result(share)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Of the spot [S], and s (2) [ohm]
      real(dp), intent(in) :: conductance, series_resistance(2)

      associate (xi_bar => kinematics%xi_bar, xi => kinematics%xi, s => series_resistance)
         share = 1/(1 + conductance*(s(1)*(1 - xi_bar**2) + s(2)*(1 - xi**2)))
      end associate
   end function share_of_spot

   !> The coupling block `K_me = K_me1 + ... + K_me5` (4, 24).
   pure function coupling_tangent(electricity, kinematics) result(k_me)
      type(contact_electricity_t), intent(in) :: electricity
      type(contact_kinematics_t), intent(in) :: kinematics
      real(dp) :: k_me(4, 24)
      real(dp) :: row(24)
      integer :: j

      row = electricity%me1 + electricity%me2 + electricity%me4 + electricity%me5
      do j = 1, 24
         k_me(:, j) = electricity%n_v*row(j) &
            + k_me3_column(electricity%current, kinematics%rows%dxi_bar(j), kinematics%rows%dxi(j))
      end do
   end function coupling_tangent

   !> The parts of the coupling block one by one (4, 24 each).
   pure subroutine coupling_parts(electricity, kinematics, k_me1, k_me2, k_me3, k_me4, k_me5)
      type(contact_electricity_t), intent(in) :: electricity
      type(contact_kinematics_t), intent(in) :: kinematics
      !> The points move along the wires: `G N_V (Vb' dxib - V' dxi)`
      real(dp), intent(out) :: k_me1(4, 24)
      !> The force changes the spot: `(dI/dg) N_V dg`
      real(dp), intent(out) :: k_me2(4, 24)
      !> The current enters at another place: `I [-dxib/2, dxib/2, dxi/2, -dxi/2]`
      real(dp), intent(out) :: k_me3(4, 24)
      !> The angle changes the spot: `(dI/dangle) N_V dangle`
      real(dp), intent(out) :: k_me4(4, 24)
      !> The correction of the voltage changes along the wires: `2 G I N_V (sb xib dxib + s xi dxi)`
      real(dp), intent(out) :: k_me5(4, 24)
      integer :: j

      k_me1 = along(electricity%n_v, electricity%me1)
      k_me2 = along(electricity%n_v, electricity%me2)
      k_me4 = along(electricity%n_v, electricity%me4)
      k_me5 = along(electricity%n_v, electricity%me5)
      do j = 1, 24
         k_me3(:, j) = k_me3_column(electricity%current, kinematics%rows%dxi_bar(j), kinematics%rows%dxi(j))
      end do
   end subroutine coupling_parts

   pure function k_me3_column(current, dxi_bar, dxi) result(column)
      !> Current from the barred to the unbarred wire [A]
      real(dp), intent(in) :: current
      !> Derivatives of the places with respect to one unknown [1/m, 1/rad]
      real(dp), intent(in) :: dxi_bar, dxi
      real(dp) :: column(4)

      column = current*[-dxi_bar, dxi_bar, dxi, -dxi]/2
   end function k_me3_column

   pure function along(n_v, row) result(k)
      !> Shares of the nodal voltages (4)
      real(dp), intent(in) :: n_v(4)
      !> A row over the mechanical unknowns (24)
      real(dp), intent(in) :: row(24)
      real(dp) :: k(4, 24)

      k = spread(n_v, 2, 24)*spread(row, 1, 4)
   end function along

end module litz_contact_electricity
