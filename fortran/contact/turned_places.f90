!> The torque of places in the lens of a crossing that has yielded.
!>
!> As the wires turn, the law of a place sees another angle at the same overlap, with the dent of the same force. What
!> it holds and dissipates more then is the work of the turn: a torque about the normal of the crossing, which stays
!> within an iteration.
!>
!> Source: theory (15.23).
module litz_turned_places
   use litz_kinds, only: dp
   use litz_bent_contacts, only: qualities_of
   use litz_contact_points, only: contact_point_t
   use litz_element_library, only: elements_t
   use litz_law_input, only: wire_pair_t
   use litz_line_kinematics, only: sine_at_angle
   use litz_model, only: model_t
   use litz_normal_forces, only: wires_of
   use litz_turned_lenses, only: line_of_point, turned_by
   use litz_yielding_place, only: place_state_t, state_of_place
   use litz_yielding_wires, only: place_of_wires
   implicit none
   private
   public :: add_torque_of_place

   !> Change of the angle of a place over its sine, for differences
   real(dp), parameter :: small_turn = 5.0e-4_dp

contains

   !> Add what a place has of it, over the sine of the angle of the axes.
   pure subroutine add_torque_of_place(model, elements, place, crossing)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: place
      !> In whose lens it lies
      type(contact_point_t), intent(inout) :: crossing
      type(wire_pair_t) :: pair
      type(contact_point_t) :: turned
      type(place_state_t) :: state
      real(dp) :: change, sine, slope, unused, work(2), law_slope
      integer :: side

      associate (angle => crossing%kinematics%angle, &
         law => model%interactions(model%contact_pairs(place%pair)%interaction)%normal)
         call sine_at_angle(qualities_of(crossing), angle, sine, slope, unused)
         if (.not. (place%gap < 0 .and. place%weight > 0 .and. min(sine, sin(angle), place%law_sine) > 0)) return
         pair = wires_of(model, elements, place)
         change = small_turn*place%law_sine
         do side = 1, 2
            turned = turned_by(place, (2*side - 3)*change)
            turned%line = line_of_point(pair, turned)
            state = state_of_place(place_of_wires(law, pair, turned), -place%gap)
            work(side) = state%energy + state%dissipated
         end do
         ! the sine of the law is that of the lens, but for how the place has settled
         law_slope = place%law_sine*slope/(sine*cos(place%law_angle))
         crossing%torque_of_dents = crossing%torque_of_dents &
            + place%weight*(work(2) - work(1))/(2*change)*law_slope/sin(angle)
      end associate
   end subroutine add_torque_of_place

end module litz_turned_places
