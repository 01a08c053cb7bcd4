!> The law per length at the angle of a point, and how a lens of wires that have yielded changes with that angle.
!>
!> Source: theory sections 10 and 15.
module litz_turned_lenses
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_point_t
   use litz_law_input, only: earlier_dent_t, wire_pair_t
   use litz_line_law, only: line_wires_t, line_wires
   use litz_normal_law, only: normal_law_t, force_of_gap_t
   use litz_yielding_lens, only: yielding_lens_t, lens_state_t, state_of_lens, with_dent
   use litz_yielding_wires, only: lens_of_wires
   implicit none
   private
   public :: line_of_point, turned_by, turn_lens

   !> Change of the angle of a lens over its sine, for differences
   real(dp), parameter :: small_turn = 5.0e-4_dp
   !> Part of its overlap from which on a dent may begin to load within such a change
   real(dp), parameter :: near_top = 2*small_turn

contains

   !> The law per length of a point, at the angle of the lens to which it belongs.
   pure type(line_wires_t) function line_of_point(pair, point) result(line)
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point

      line = line_wires(pair, point%law_angle)
      ! what bounds the far field in place of the section
      line%section = point%section_share*line%section + point%lap%strip_bound
      line%electric_section = point%section_share*line%electric_section + point%lap%strip_bound
   end function line_of_point

   !> The point with another angle of its law, and all else as it was.
   pure type(contact_point_t) function turned_by(point, change) result(turned)
      type(contact_point_t), intent(in) :: point
      !> [rad]
      real(dp), intent(in) :: change

      turned = point
      turned%law_angle = point%law_angle + change
      turned%law_sine = sin(turned%law_angle)
   end function turned_by

   !> How force and energy of a lens of wires that have yielded change with the angle, by differences. The torque is
   !> that of the dent as it is, which the present force has made where it is the largest.
   pure subroutine turn_lens(normal, pair, point, overlap, law)
      type(normal_law_t), intent(in) :: normal
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> [m]
      real(dp), intent(in) :: overlap
      !> In: at the angle of the point
      type(force_of_gap_t), intent(inout) :: law
      type(yielding_lens_t) :: lens(2), here, now
      !> With the dent that is felt at either angle, at the angle of the point, and at the opposite one
      type(lens_state_t) :: own(2), same(2), other(2)
      type(earlier_dent_t) :: felt
      real(dp) :: change
      integer :: side

      change = small_turn*point%law_sine
      do side = 1, 2
         lens(side) = turned_lens(normal, pair, point, (2*side - 3)*change)
         own(side) = state_of_lens(lens(side), overlap)
      end do
      law%dforce_dangle = (own(2)%law%force - own(1)%law%force)/(2*change)
      felt = earlier_dent_t(force=max(point%felt_force, law%force))
      here = lens_of_wires(normal, pair, point)
      now = with_dent(here, felt)
      if (overlap > (1 - near_top)*now%deepest) then
         call turn_out_of_dent(overlap, [lens(1), here, lens(2), turned_lens(normal, pair, point, 2*change), &
            turned_lens(normal, pair, point, 3*change)], change, law)
         return
      end if
      same = own
      if (abs(lens(2)%felt - lens(1)%felt) > 0) then
         do side = 1, 2
            same(side) = state_of_lens(with_dent(lens(side), felt), overlap)
            other(side) = state_of_lens(with_dent(lens(side), earlier_dent_t(force=lens(3 - side)%felt)), overlap)
         end do
         law%growth = (same(2)%law%force - same(1)%law%force)/(2*change) - law%dforce_dangle
      end if
      law%denergy_dangle = (same(2)%law%energy - same(1)%law%energy)/(2*change)
      law%d2energy_dangle2 = (same(2)%law%energy - 2*law%energy + same(1)%law%energy)/change**2
      if (abs(lens(2)%felt - lens(1)%felt) > 0) law%d2energy_dangle2 = law%d2energy_dangle2 &
         + (own(2)%law%energy + own(1)%law%energy - other(2)%law%energy - other(1)%law%energy)/(2*change)**2
   end subroutine turn_lens

   !> Where the dent bears as a whole.
   pure subroutine turn_out_of_dent(overlap, lens, change, law)
      !> [m]
      real(dp), intent(in) :: overlap
      !> At the angle before, at that of the point, and at the three after
      type(yielding_lens_t), intent(in) :: lens(-1:3)
      !> Of the angle [rad]
      real(dp), intent(in) :: change
      type(force_of_gap_t), intent(inout) :: law

      law%denergy_dangle = torque_of_dent(overlap, lens(0:2), change)
      law%d2energy_dangle2 = (torque_of_dent(overlap, lens(1:3), change) - torque_of_dent(overlap, lens(-1:1), &
         change))/(2*change)
      law%growth = (torque_of_dent((1 + small_turn)*overlap, lens(0:2), change) - torque_of_dent((1 &
         - small_turn)*overlap, lens(0:2), change))/(2*small_turn*overlap) - law%dforce_dangle
   end subroutine turn_out_of_dent

   !> Wires that are turned to a shorter lens lie in their dent, and otherwise they load: the derivative of the energy
   !> of the dent is that on the side where it stays.
   pure real(dp) function torque_of_dent(overlap, lens, change) result(torque)
      !> [m]
      real(dp), intent(in) :: overlap
      !> At an angle, and turned once and twice
      type(yielding_lens_t), intent(in) :: lens(3)
      !> Of the angle [rad]
      real(dp), intent(in) :: change
      type(lens_state_t) :: state
      type(earlier_dent_t) :: made
      real(dp) :: energy(3)
      integer :: i

      state = state_of_lens(lens(1), overlap)
      made = earlier_dent_t(force=max(lens(1)%felt, state%law%force))
      do i = 1, 3
         state = state_of_lens(with_dent(lens(i), made), overlap)
         energy(i) = state%law%energy
      end do
      torque = dot_product([-3, 4, -1], energy)/(2*change)
   end function torque_of_dent

   !> The lens at another angle of its law, and all else as it was.
   pure type(yielding_lens_t) function turned_lens(normal, pair, point, change) result(lens)
      type(normal_law_t), intent(in) :: normal
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> [rad]
      real(dp), intent(in) :: change
      type(contact_point_t) :: turned

      turned = turned_by(point, change)
      turned%line = line_of_point(pair, turned)
      lens = lens_of_wires(normal, pair, turned)
   end function turned_lens

end module litz_turned_lenses
