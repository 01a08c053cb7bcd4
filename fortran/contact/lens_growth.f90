!> What the angle of the wires and the growth of its lens change of the energy of a contact.
!>
!> Within an iteration force and torque are those of the lens and of the far field of when the shares were found. The
!> energy of a contact is what its force has done from first touch on, while the lens grew and the section of the wires
!> came to count: `Pi(delta, psi)`. That of the crossing and of its places is their own, at the present far field, times
!> the ratio `Pi/Pi_0` of the whole lens. What `Pi_psi` is more than their torques is one more torque about the normal,
!> which stays within an iteration, too. Metal that has yielded has no such growth: a dent keeps the far field with
!> which it was made. Of places in a dent the torque is the sum of theirs.
!>
!> Source: theory (10.16a), (10.16b) and (15.23).
module litz_lens_growth
   use litz_kinds, only: dp
   use litz_bent_contacts, only: bends_of, is_bent, qualities_of
   use litz_bent_wires, only: bent_crossing_t
   use litz_contact_lens, only: has_lens, half_length_of, deepest
   use litz_contact_points, only: contact_point_t
   use litz_contact_turning, only: turning_t
   use litz_cut_lens, only: is_cut
   use litz_law_input, only: wire_pair_t
   use litz_lens_law, only: lens_t, lens_force, lens_energy, grown_energy, share_of_line, smooth_step, gauss_depth, &
      gauss_weight
   use litz_line_kinematics, only: sine_at_angle
   use litz_line_law, only: line_wires_t, line_wires
   use litz_normal_law, only: normal_law_t
   use litz_shares_at_ends, only: share_at_crossing
   use litz_turned_lenses, only: line_of_point
   use litz_yielding_lens, only: yielding_lens_t
   use litz_yielding_wires, only: depth_of_lens, lens_of_wires, part_yielded
   implicit none
   private
   public :: settle_growth, settled_turning, lacks_torque

   !> Relative change of the square of the sine of a lens, for differences
   real(dp), parameter :: small_turn = 1.0e-3_dp

   !> Half lengths beside the smaller radius between which a lens becomes a line, along which nothing grows any more
   real(dp), parameter :: grows_up_to = 3, line_from = 9

   !> A lens at an angle of the axes.
   type :: turned_lens_t
      !> At the angle of the law, with the whole section
      type(line_wires_t) :: line
      !> Sines of the law and of the lens, and their derivatives by the angle of the axes
      real(dp) :: law_sine = 0, sine = 0, law_slope = 0, slope = 0
   end type turned_lens_t

contains

   !> Bring up to date the energy of a crossing, and what the torques of itself and of its places lack.
   pure subroutine settle_growth(law, pair, point)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> With the shares of an earlier state; out: `energy_ratio`, `lacking_torque` and `lacking_torque_of_places`
      type(contact_point_t), intent(inout) :: point
      type(turned_lens_t) :: now, turned
      type(line_wires_t) :: line
      type(lens_t) :: lens
      real(dp) :: sine, longest, reach, change, kept, of_growth, by_angle, grown(-1:1), unused, growing
      integer :: side

      point%energy_ratio = 1
      point%lacking_torque = 0
      point%lacking_torque_of_places = 0
      ! a penalty does not depend on the far field
      if (law%is_straight) return
      if (any(point%held) .or. is_cut(point%lens) .or. .not. point%gap < 0) return
      if (.not. has_lens(point)) return
      longest = deepest*minval(point%radius)
      reach = half_length_of(point, longest)/minval(point%radius)
      ! short lenses that crossings carry have the energy of the ellipse
      if (share_of_line((1 + small_turn)*reach) <= 0 .and. point%weight >= 1 .and. .not. (point%lens_share > 0 .and. &
         point%lens_share < 1)) return
      growing = 1 - part_that_yielded(law, pair, point)
      if (.not. growing > 0) return
      now = lens_at(pair, point, point%kinematics%angle, point%lens_share)
      sine = sin(point%kinematics%angle)
      if (.not. sine > 0) return
      change = small_turn*now%sine**2/sine
      do side = -1, 1
         turned = lens_at(pair, point, point%kinematics%angle + side*change, point%lens_share)
         line = turned%line
         line%section = share_of_line(reach)*line%section
         call lens_energy(line, point%gap, turned%law_sine, 0.0_dp, kept, by_angle, unused)
         associate (angle => point%kinematics%angle + side*change)
            if (side /= 0) turned = lens_at(pair, point, angle, share_at_crossing(law, point, angle))
         end associate
         grown(side) = grown_energy(turned%line, point%gap, turned%law_sine, reach*now%sine/turned%sine, longest) - kept
         if (side /= 0) cycle
         if (kept > 0) point%energy_ratio = 1 + growing*grown(0)/kept
         lens = lens_force(line, point%gap, turned%law_sine, 0.0_dp)
         ! as the wires turn, the overlap of a place at u aW from the middle changes by -2 delta u^2 ds/s
         point%lacking_torque_of_places = by_angle*now%law_slope - 2*point%gap*now%slope/now%sine*lens%half_length &
            *dot_product(gauss_weight*(1 - gauss_depth), lens%along%force)
      end do
      of_growth = (grown(1) - grown(-1))/(2*change)
      point%lacking_torque = growing*of_growth/sine
      ! of places in a dent that of their law is the sum of theirs
      if (point%lens_has_dent) point%lacking_torque_of_places = 0
      point%lacking_torque_of_places = (point%lacking_torque_of_places + growing*of_growth)/sine &
         *(1 - smooth_step((reach - grows_up_to)/(line_from - grows_up_to)))
   end subroutine settle_growth

   !> How far a crossing of metal that yields has done so: a dent keeps the far field with which it was made.
   pure real(dp) function part_that_yielded(law, pair, point) result(part)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      type(contact_point_t) :: there
      type(yielding_lens_t) :: lens

      part = 0
      if (.not. (law%yields() .and. point%history%dent%force > 0)) return
      there = point
      there%line = line_of_point(pair, point)
      lens = lens_of_wires(law, pair, there)
      part = part_yielded(depth_of_lens(lens), lens%deepest)
   end function part_that_yielded

   elemental logical function lacks_torque(point)
      type(contact_point_t), intent(in) :: point

      lacks_torque = point%gap < 0 .and. any(abs([point%lacking_torque, &
         point%lacking_torque_of_places, point%torque_of_dents]) > 0)
   end function lacks_torque

   !> What the torques of a crossing and of the places in its lens lack. Over the sine of the angle they stay, so that
   !> they are smooth where the wires come to lie side by side.
   pure type(turning_t) function settled_turning(point, angle) result(turning)
      type(contact_point_t), intent(in) :: point
      !> Of the axes [rad]
      real(dp), intent(in) :: angle
      real(dp) :: over_sine

      if (point%gap >= 0) return
      over_sine = point%weight*point%lacking_torque &
         + (1 - point%weight)*(1 - point%long_share)*point%lacking_torque_of_places + point%torque_of_dents
      turning%denergy = over_sine*sin(angle)
      turning%d2energy = over_sine*cos(angle)
   end function settled_turning

   !> The lens as the axes turn, with its law.
   pure type(turned_lens_t) function lens_at(pair, point, angle, share) result(turned)
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> Of the axes [rad], and how much the lens counts beside it [-]
      real(dp), intent(in) :: angle, share
      type(bent_crossing_t) :: straight
      real(dp) :: unused, sine, slope

      call sine_at_angle(qualities_of(point), angle, turned%sine, turned%slope, unused)
      sine = sin(angle)
      slope = cos(angle)
      if (is_bent(point)) then
         straight = bends_of(point, angle)
         sine = straight%sine
         slope = straight%slope*cosine(sine)
      end if
      turned%law_sine = (1 - share)*sine + share*turned%sine
      turned%law_slope = ((1 - share)*slope + share*turned%slope)/cosine(turned%law_sine)
      turned%line = line_wires(pair, asin(min(1.0_dp, turned%law_sine)))
   end function lens_at

   !> Of an angle up to nearly 90 degrees.
   pure real(dp) function cosine(sine)
      !> [-]
      real(dp), intent(in) :: sine

      cosine = sqrt(max(epsilon(sine), (1 - sine)*(1 + sine)))
   end function cosine

end module litz_lens_growth
