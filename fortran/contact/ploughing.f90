!> What it takes to slide wires out of the dent in which they lie.
!>
!> Source: theory section 15. As the contact slides by `u`, it feels a smaller part `f = eta F_m` of the largest force:
!> at the same overlap the wires then hold more elastic energy, or make their dent anew. The force along the wires that
!> does this work, `P = -(dPi/df) F_m d(eta)/du`, is a part of the limit of friction.
module litz_ploughing
   use litz_kinds, only: dp, pi
   use litz_contact_history, only: dent_memory_t
   use litz_contact_points, only: contact_point_t
   use litz_law_input, only: earlier_dent_t, wire_pair_t
   use litz_model, only: interaction_t
   use litz_normal_forces, only: is_lens, line_of_point
   use litz_normal_law, only: normal_law_t
   use litz_normal_yielding, only: dent_of_wires, state_of_wires
   use litz_yielding_lens, only: lens_state_t, state_of_lens, yielding_lens_t
   use litz_yielding_spot, only: dent_t, yielding_state_t
   use litz_yielding_wires, only: lens_of_wires
   implicit none
   private
   public :: coefficient_of_friction, split_dissipation, ploughing_coefficient, work_of_slide

   !> Relative change of the force that a lens feels of its dent, for a difference
   real(dp), parameter :: small_change = 1.0e-4_dp

contains

   !> Limit of the traction over the normal force: friction, and the ploughing of the dent as it was when the increment
   !> began.
   elemental real(dp) function coefficient_of_friction(law, point) result(mu)
      type(interaction_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point

      mu = law%friction + point%history%ploughing
   end function coefficient_of_friction

   !> What the slip dissipates is done by friction and by ploughing as they share in the limit.
   pure subroutine split_dissipation(law, point)
      type(interaction_t), intent(in) :: law
      type(contact_point_t), intent(inout) :: point

      point%ploughed = 0
      if (.not. point%history%ploughing > 0) return
      associate (by_slip => point%friction%dissipation/coefficient_of_friction(law, point))
         point%ploughed = by_slip*point%history%ploughing
         point%friction%dissipation = by_slip*law%friction
      end associate
   end subroutine split_dissipation

   !> P over the normal force in the state that an increment has come to [-].
   pure real(dp) function ploughing_coefficient(law, pair, point, dent, slide, radius) result(ratio)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> After the increment
      type(dent_memory_t), intent(in) :: dent
      !> How far the contact has left the dent: t of (15.17), and radius of a round dent of the same area [m]
      real(dp), intent(in) :: slide, radius
      real(dp) :: rate

      ratio = 0
      if (.not. (point%closed .and. dent%felt > 0 .and. slide < 1 .and. radius > 0)) return
      rate = 2/pi*sqrt((1 - slide)*(1 + slide))/radius                                     ! -d(eta)/du, t = u/(2 a)
      if (is_lens(law, point)) then
         ratio = rate*resistance_of_lens(law, pair, point, dent)
      else
         ratio = rate*resistance_of_spot(law, pair, point, dent)
      end if
   end function ploughing_coefficient

   !> What the energy at the same overlap rises by with the part of the dent that is no longer felt, over the force [m].
   pure real(dp) function resistance_of_spot(law, pair, point, dent) result(resistance)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> After the increment
      type(dent_memory_t), intent(in) :: dent
      type(dent_t) :: made
      type(yielding_state_t) :: state
      real(dp) :: unused

      resistance = 0
      call state_of_wires(law, pair, point%ellipse, dent%at_any_angle(), point%gap, .false., state, unused)
      if (.not. (state%force > 0 .and. state%denergy_dlargest < 0)) return
      made = dent_of_wires(law, pair, point%ellipse, earlier_dent_t(dent%force, dent%overlap))
      resistance = -state%denergy_dlargest*made%force/state%force
   end function resistance_of_spot

   !> The same of a crossing whose section counts, by a difference.
   pure real(dp) function resistance_of_lens(law, pair, point, dent) result(resistance)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> After the increment
      type(dent_memory_t), intent(in) :: dent
      type(contact_point_t) :: there
      type(yielding_lens_t) :: lens
      type(lens_state_t) :: state, beyond

      resistance = 0
      there = point
      there%history%dent = dent
      there%line = line_of_point(pair, there)
      lens = lens_of_wires(law, pair, there)
      state = state_of_lens(lens, -point%gap)
      if (.not. (state%law%force > 0 .and. state%has_yielded)) return
      there%history%dent%left = (1 - small_change)*dent%left
      lens = lens_of_wires(law, pair, there)
      beyond = state_of_lens(lens, -point%gap)
      resistance = max((beyond%law%energy + beyond%dissipated - state%law%energy - state%dissipated) &
         /(small_change*dent%left*state%law%force), 0.0_dp)
   end function resistance_of_lens

   !> Work that takes the contact from what it felt of its dent in the increment to what it will feel in the next one,
   !> at the same overlap [J]: that of the force along the wires, but for what this dissipates.
   pure real(dp) function work_of_slide(law, pair, point, after) result(work)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> With the dent of the increment
      type(contact_point_t), intent(in) :: point
      !> The dent of the next one
      type(dent_memory_t), intent(in) :: after
      type(dent_t) :: made
      type(yielding_state_t) :: state
      real(dp) :: dissipated

      work = 0
      associate (felt => point%felt_force)
         if (.not. felt > 0 .or. .not. point%weight > 0 .or. .not. abs(after%felt - felt) > 0) return
         ! what has loaded the dent further is where the next increment begins
         if (point%closed .and. point%force >= point%weight*felt) return
         made = dent_of_wires(law, pair, point%ellipse, earlier_dent_t(felt))
         if (.not. made%evenness > 0) return
      end associate
      call state_of_wires(law, pair, point%ellipse, after%at_any_angle(), point%gap, .false., state, dissipated)
      work = point%weight*(state%energy + dissipated) - point%at_gap%energy
   end function work_of_slide

end module litz_ploughing
