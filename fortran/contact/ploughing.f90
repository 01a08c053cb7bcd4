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
   use litz_normal_law, only: normal_law_t
   use litz_normal_yielding, only: dent_of_wires, state_of_wires
   use litz_yielding_spot, only: dent_t, yielding_state_t
   implicit none
   private
   public :: coefficient_of_friction, split_dissipation, ploughing_coefficient, work_of_slide

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

   !> P over the normal force in the state that an increment has come to [-], of a round spot of the same area.
   pure real(dp) function ploughing_coefficient(law, pair, point, dent, slide) result(ratio)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> After the increment
      type(dent_memory_t), intent(in) :: dent
      !> How far the contact has left the dent: t of (15.17)
      real(dp), intent(in) :: slide
      type(dent_t) :: made
      type(yielding_state_t) :: state
      real(dp) :: unused, rate

      ratio = 0
      if (.not. (point%closed .and. dent%felt > 0 .and. slide < 1)) return
      call state_of_wires(law, pair, point%ellipse, dent%at_any_angle(), point%gap, .false., state, unused)
      if (.not. (state%force > 0 .and. state%denergy_dlargest < 0)) return
      made = dent_of_wires(law, pair, point%ellipse, earlier_dent_t(dent%force, dent%overlap))
      rate = 2/pi*sqrt((1 - slide)*(1 + slide))/sqrt(made%area/pi)                         ! -d(eta)/du, t = u/(2 a)
      ratio = -state%denergy_dlargest*made%force*rate/state%force
   end function ploughing_coefficient

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
