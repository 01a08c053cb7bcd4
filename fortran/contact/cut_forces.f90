!> The force of a contact near the ends of its wires: from that of two wires without ends, and from what the ends leave
!> of its energy.
!>
!> With the energy `Q(delta, p) Pi(delta)` of the overlap and of both places along the wires (litz_cut_lens), its
!> derivatives are the normal force `Q F + Q_delta Pi`, and forces `Q_p Pi` along the wires. Source: theory section 10.
module litz_cut_forces
   use litz_kinds, only: dp, pi
   use litz_contact_points, only: contact_point_t
   use litz_cut_lens, only: cut_lens_t, lens_part_t, cut_energy, is_cut, is_whole
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_near_ends, hertz_ok
   use litz_law_input, only: wire_pair_t
   use litz_normal_law, only: normal_law_t, force_of_gap_t
   implicit none
   private
   public :: cut_force, settle_cut, ellipse_of_parts, spot_of_parts, kept_part, leaves_nothing, &
      conducting_part, scaled

   !> An end cuts a spot as one narrower by this, squared: what is beside it takes over (from half-spaces, see the
   !> theory)
   real(dp), parameter :: narrower = 0.5_dp
   !> Energy over force and overlap of Hertz
   real(dp), parameter :: energy_of_hertz = 0.4_dp
   !> Force over stiffness and overlap of Hertz
   real(dp), parameter :: by_overlap = 2/3.0_dp

contains

   !> Force and energy with the share that a crossing or the contact of an end carries, and what stays within an
   !> iteration besides.
   pure subroutine cut_force(law, pair, base, point)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> At the present gap, of two wires without ends
      type(force_of_gap_t), intent(in) :: base
      !> Out: with `at_gap`, and what is needed for the forces along the wires
      type(contact_point_t), intent(inout) :: point
      type(lens_part_t) :: part
      real(dp) :: q_delta, stiffness

      point%at_gap = force_of_gap_t()
      point%slide_force = 0
      if (.not. base%force > 0) return
      if (.not. point%lens%has_energies) call settle_cut(law, pair, base%energy, point)
      part = part_of_lens(point)
      associate (q => part%whole, weight => point%weight)
         q_delta = q%first(1)
         stiffness = -q%value*base%dforce_dgap + 2*q_delta*base%force + q%second(1, 1)*base%energy
         ! the angle stays, too
         point%at_gap = force_of_gap_t(weight*(q%value*base%force + q_delta*base%energy), -weight*stiffness, 0.0_dp, &
            weight*q%value*base%energy)
         point%slide_force = weight*q%first(2:3)*base%energy
         point%slide_by_overlap = weight*(q%first(2:3)*base%force + q%second(1, 2:3)*base%energy)
         point%slide_stiffness = weight*q%second(2:3, 2:3)*base%energy
         point%cut = q%value + q_delta*base%energy/base%force
         if (point%cut > 0) point%cut_stiffness = -stiffness/(point%cut*base%dforce_dgap)
      end associate
   end subroutine cut_force

   !> The contact is held at ends that cut it (2).
   pure function is_at_ends(point)
      type(contact_point_t), intent(in) :: point
      logical :: is_at_ends(2)

      is_at_ends = point%at_end .and. point%lens%near
   end function is_at_ends

   !> What the ends leave of the energy.
   pure type(lens_part_t) function part_of_lens(point) result(part)
      !> Closed
      type(contact_point_t), intent(in) :: point

      if (is_whole(point%lens, is_at_ends(point), -point%gap, point%place)) then
         part%whole%value = point%lens%share(1, 1)
         part%pair(1, 1) = part%whole
      else
         part = cut_energy(point%lens, is_at_ends(point), -point%gap, point%place)
      end if
   end function part_of_lens

   !> Bring up to date what stays within an iteration: the energies of the pairs of shapes, and what each has of the
   !> force of the spot, in parts of what it would have alone.
   pure subroutine settle_cut(law, pair, energy, point)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> Of two wires without ends at the present gap, as far as the section counts in their law [J]
      real(dp), intent(in) :: energy
      !> Closed
      type(contact_point_t), intent(inout) :: point
      type(lens_part_t) :: part
      integer :: i, j

      call find_energies(law, pair, energy, point)
      part = part_of_lens(point)
      do j = 1, 2
         do i = 1, 2
            point%force_part(i, j) = max(0.0_dp, (part%pair(i, j)%value - part%pair(i, j)%first(1)*energy_of_hertz &
               *point%gap)/point%lens%energy(i, j))
         end do
      end do
      associate (q => part%whole, overlap => -point%gap)
         point%stiff_part = max(0.0_dp, q%value + overlap*(2*by_overlap*q%first(1) &
            + energy_of_hertz*by_overlap*overlap*q%second(1, 1)))
      end associate
   end subroutine settle_cut

   !> Energies of ends on cylinders and of ends on ends over that of two cylinders, at one overlap. A law per length
   !> knows no round ends: they have the part of crossed wires that Hertz has. Where the section counts in the law of
   !> the cylinders, it does not in that of round ends.
   pure subroutine find_energies(law, pair, energy, point)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> Of two wires without ends at the present gap, as far as the section counts in their law [J]
      real(dp), intent(in) :: energy
      type(contact_point_t), intent(inout) :: point
      type(hertz_ellipse_t) :: cylinders, one(2, 2)
      real(dp) :: angle, factor, overlap
      integer :: i, j, info

      angle = point%law_angle
      factor = 1
      overlap = -point%gap
      if (law%line_penalty() > 0) then
         angle = pi/2
         factor = point%law_sine
      end if
      call hertz_ellipse(pair%radius, pair%young, pair%poisson, angle, cylinders, info)
      if (info /= hertz_ok) return
      if (point%section_share > 0) factor = energy_of_hertz*overlap*(overlap/cylinders%approach)**1.5_dp/energy
      do j = 1, 2
         do i = 1, 2
            point%lens%energy(i, j) = 1
            if (i + j == 2) cycle
            call hertz_ellipse(pair%radius, pair%young, pair%poisson, angle, one(i, j), info, [i, j] == 2)
            point%lens%energy(i, j) = factor*(cylinders%approach/one(i, j)%approach)**1.5_dp     ! delta = cd F^(2/3)
         end do
      end do
      point%lens%has_energies = .true.
      if (.not. law%line_penalty() > 0) call find_extents(pair%radius, cylinders, [one(2, 1), one(1, 2)], point%lens)
   end subroutine find_energies

   !> How far the spot reaches along the wires, and where the cylinder behind a round end on which a wire leans comes to
   !> be felt: as the spot of the round end reaches it.
   pure subroutine find_extents(radius, cylinders, ends, lens)
      !> Of the wires (2) [m]
      real(dp), intent(in) :: radius(2)
      !> Spot of the cylinders, and that of the round end of either wire on the other one (2)
      type(hertz_ellipse_t), intent(in) :: cylinders, ends(2)
      type(cut_lens_t), intent(inout) :: lens
      real(dp) :: twice(2), shift
      integer :: i

      associate (angle => cylinders%angle)
         do i = 1, 2
            ! the flattest direction lies between the wires: cosine and sine of twice its angle to this one
            twice = [radius(3 - i) + radius(i)*cos(2*angle), radius(i)*sin(2*angle)]
            twice = twice/max(norm2(twice), tiny(shift))
            lens%extent(i) = min(1.0_dp, narrower*lens%of_wedge*lens%bend(i)/(2*lens%distance) &
               *extent_of(cylinders, (1 + twice(1))/2))
            ! a sphere that leans by t touches r t away from its pole, less where the other wire is curved that way
            shift = radius(i)*(1 - radius(i)*sin(angle)**2/sum(radius))
            lens%receding(i) = (shift/lens%distance)**2/extent_of(ends(i), cos(angle)**2)
            lens%spot_of_end(i) = min(1.0_dp, extent_of(ends(i), cos(angle)**2)/(2*lens%distance))
         end do
      end associate
   end subroutine find_extents

   !> Square of half the length of a spot along a direction, over its approach [m].
   pure real(dp) function extent_of(ellipse, cosine_squared) result(extent)
      type(hertz_ellipse_t), intent(in) :: ellipse
      !> Of the angle between the direction and the major axis
      real(dp), intent(in) :: cosine_squared

      extent = ellipse%semi_major**2/ellipse%approach*(cosine_squared + ellipse%ratio**2*(1 - cosine_squared))
   end function extent_of

   !> The ellipse of the spot, which stays what it was while the iteration goes on but for its force.
   pure subroutine ellipse_of_parts(pair, point, info)
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(inout) :: point
      !> `hertz_ok` or `hertz_parallel`
      integer, intent(out) :: info
      type(hertz_ellipse_t) :: ellipse

      call hertz_near_ends(pair%radius, pair%young, pair%poisson, point%law_angle, point%force_part, ellipse, info)
      if (info /= hertz_ok) return
      point%ellipse = ellipse
      point%ellipse%dapproach_dangle = 0
      point%ellipse%dlog_area_dangle = 0
      point%ellipse%dlog_ratio_dangle = 0
   end subroutine ellipse_of_parts

   !> The same for what conducts: as large as its stiffness tells (Barber, Proc. R. Soc. A 459 (2003) 53-66), which ends
   !> leave more or less of than of the force.
   pure subroutine spot_of_parts(pair, point, info)
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(inout) :: point
      !> `hertz_ok` or `hertz_parallel`
      integer, intent(out) :: info
      real(dp) :: larger

      call ellipse_of_parts(pair, point, info)
      if (info /= hertz_ok) return
      larger = point%stiff_part/kept_part(point)
      point%ellipse%semi_major = larger*point%ellipse%semi_major
      point%ellipse%approach = point%ellipse%approach/larger                   ! G = 3F/(sum of rho E* delta)
   end subroutine spot_of_parts

   !> Part of the force of uncut cylinders that stays within the iteration.
   pure real(dp) function kept_part(point)
      type(contact_point_t), intent(in) :: point

      kept_part = 1
      if (point%lens%has_energies .and. any(point%force_part > 0)) kept_part = sum(point%force_part*point%lens%energy)
   end function kept_part

   !> The ends leave no force.
   pure logical function leaves_nothing(point)
      type(contact_point_t), intent(in) :: point

      leaves_nothing = point%lens%has_energies .and. .not. any(point%force_part > 0)
   end function leaves_nothing

   !> Part of the conductance of an uncut lens: as it conducts as it gives way, that of its stiffness.
   pure real(dp) function conducting_part(point) result(part)
      type(contact_point_t), intent(in) :: point

      part = 1
      if (is_cut(point%lens)) part = point%stiff_part
   end function conducting_part

   pure type(force_of_gap_t) function scaled(law, share)
      type(force_of_gap_t), intent(in) :: law
      !> Share of a contact [-]
      real(dp), intent(in) :: share

      scaled = force_of_gap_t(share*law%force, share*law%dforce_dgap, share*law%dforce_dangle, share*law%energy, &
         share*law%denergy_dangle, share*law%d2energy_dangle2, share*law%growth)
   end function scaled

end module litz_cut_forces
