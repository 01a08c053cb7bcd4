!> What the far field of a lens changes of its energy, as the lens grows and as its wires turn.
!>
!> Within an iteration force and torque are those of the far field of when the shares were found. The energy of a lens
!> is what its force has done from first touch on, while the section of the wires came to count: `Pi(delta, psi)`. That
!> of the crossing and of its places is their own, at the present far field, times the ratio `Pi/Pi_0` of the whole
!> lens; and what `Pi_psi` is more than their torques is one more torque about the normal, which stays within an
!> iteration, too.
!>
!> Source: theory (10.16a) and (10.16b).
module litz_lens_growth
   use litz_kinds, only: dp
   use litz_contact_lens, only: has_lens, half_length_of, deepest
   use litz_contact_points, only: contact_point_t
   use litz_cut_lens, only: is_cut
   use litz_law_input, only: wire_pair_t
   use litz_lens_law, only: lens_t, lens_force, lens_energy, grown_energy, share_of_line, gauss_depth, gauss_weight
   use litz_line_kinematics, only: crossing_qualities, sine_at_angle
   use litz_line_law, only: line_wires_t, line_wires
   use litz_normal_law, only: normal_law_t
   implicit none
   private
   public :: settle_growth, settled_torque

   !> Relative change of the square of the sine of a lens, for differences
   real(dp), parameter :: small_turn = 1.0e-3_dp

   !> A lens at an angle of the axes.
   type :: turned_lens_t
      !> At the angle of the law, with the whole section
      type(line_wires_t) :: line
      !> Sines of the law and of the lens, and derivative of the latter by the angle
      real(dp) :: law_sine = 0, sine = 0, slope = 0
   end type turned_lens_t

contains

   !> Bring up to date the energy of a crossing, and what the torques of itself and of its places lack.
   pure subroutine settle_growth(law, pair, point)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> With the shares of an earlier state; out: `energy_ratio`, `lacking_torque` and `lacking_torque_of_places`
      type(contact_point_t), intent(inout) :: point
      type(turned_lens_t) :: now, turned
      real(dp) :: reach, longest, change, of_growth, grown(2), kept(2)
      integer :: side

      point%energy_ratio = 1
      point%lacking_torque = 0
      point%lacking_torque_of_places = 0
      ! a penalty does not depend on the far field
      if (.not. law%uses_ellipse .or. law%yields() .or. law%line_penalty() > 0) return
      if (any(point%held) .or. is_cut(point%lens) .or. .not. point%gap < 0) return
      if (.not. has_lens(point)) return

      now = lens_at(pair, point, point%kinematics%angle)
      longest = deepest*minval(point%radius)
      reach = half_length_of(point, longest)/minval(point%radius)
      point%energy_ratio = grown_energy(now%line, point%gap, now%law_sine, reach, longest) &
         /energy_of_kept_section(now, point%gap, share_of_line(reach))
      change = small_turn*now%sine**2/sin(point%kinematics%angle)
      do side = 1, 2
         turned = lens_at(pair, point, point%kinematics%angle + (2*side - 3)*change)
         grown(side) = grown_energy(turned%line, point%gap, turned%law_sine, reach*now%sine/turned%sine, longest)
         kept(side) = energy_of_kept_section(turned, point%gap, share_of_line(reach))
      end do
      of_growth = (grown(2) - grown(1))/(2*change)
      point%lacking_torque = of_growth - (kept(2) - kept(1))/(2*change)
      point%lacking_torque_of_places = of_growth - torque_of_places(now, point%gap, share_of_line(reach))
   end subroutine settle_growth

   !> What the torques of a crossing and of the places in its lens lack [N m].
   pure real(dp) function settled_torque(point) result(torque)
      type(contact_point_t), intent(in) :: point

      torque = 0
      if (point%gap < 0) torque = point%weight*point%lacking_torque &
         + (1 - point%weight)*(1 - point%long_share)*point%lacking_torque_of_places
   end function settled_torque

   !> The lens as the axes turn, with its law.
   pure type(turned_lens_t) function lens_at(pair, point, angle) result(turned)
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> Of the axes [rad]
      real(dp), intent(in) :: angle
      real(dp) :: unused

      call sine_at_angle(crossing_qualities(point%kinematics), angle, turned%sine, turned%slope, unused)
      turned%law_sine = (1 - point%lens_share)*sin(angle) + point%lens_share*turned%sine
      turned%line = line_wires(pair, asin(min(1.0_dp, turned%law_sine)))
   end function lens_at

   !> Integral of the force over the overlap where the section counts all the way as it does now [J].
   pure real(dp) function energy_of_kept_section(turned, gap, section_share) result(energy)
      type(turned_lens_t), intent(in) :: turned
      !> [m], and how much the section counts [-]
      real(dp), intent(in) :: gap, section_share
      real(dp) :: unused(2)

      call lens_energy(with_section(turned, section_share), gap, turned%law_sine, 0.0_dp, energy, unused(1), unused(2))
   end function energy_of_kept_section

   !> Torque of the forces along the whole lens: as the wires turn, the gap of a place at `u aW` from its middle changes
   !> by `2 delta u^2 ds/s` [N m].
   pure real(dp) function torque_of_places(turned, gap, section_share) result(torque)
      type(turned_lens_t), intent(in) :: turned
      !> [m], and how much the section counts [-]
      real(dp), intent(in) :: gap, section_share
      type(lens_t) :: lens

      lens = lens_force(with_section(turned, section_share), gap, turned%law_sine, 0.0_dp)
      torque = 2*gap*turned%slope/turned%sine*lens%half_length &
         *dot_product(gauss_weight*(1 - gauss_depth), lens%along%force)
   end function torque_of_places

   pure type(line_wires_t) function with_section(turned, section_share) result(line)
      type(turned_lens_t), intent(in) :: turned
      !> [-]
      real(dp), intent(in) :: section_share

      line = turned%line
      line%section = section_share*line%section
   end function with_section

end module litz_lens_growth
