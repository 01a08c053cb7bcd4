!> The spot of two wires whose metal yields, from the force and the dent that the largest force has made.
!>
!> Source: theory (15.9).
module litz_dent_spot
   use litz_kinds, only: dp, pi
   use litz_spot_law, only: contact_spot_t, spot_law_t
   use litz_spot_resistance, only: spot_metal_t, metal_of_law, set_conductance
   use litz_yielding_spot, only: yielding_t, dent_t, yielding_state_t, state_at_force
   implicit none
   private
   public :: yielded_spot, spot_of_state

contains

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

   !> The spot of a state at an overlap, all 0 where there is none; its conductance has derivatives by the overlap at
   !> fixed angle, in place of that by the force, and by the angle at fixed overlap.
   pure type(contact_spot_t) function spot_of_state(law, resistivity, state, ratio) result(spot)
      !> Of a spot of the mechanics
      type(spot_law_t), intent(in) :: law
      !> Barred, unbarred (2) [ohm m]
      real(dp), intent(in) :: resistivity(2)
      type(yielding_state_t), intent(in) :: state
      !> b/a of the ellipse
      real(dp), intent(in) :: ratio

      if (.not. state%area > 0) return
      spot%semi_major = sqrt(state%area/(pi*ratio))
      spot%semi_minor = ratio*spot%semi_major
      spot%approach = state%overlap
      call set_conductance(metal_of_law(law, resistivity), state%disc, state%ddisc(:2), state%area, state%darea(:2), &
         spot)
   end function spot_of_state

end module litz_dent_spot
