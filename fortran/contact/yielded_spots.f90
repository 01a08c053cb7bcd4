!> The spot of two crossed wires whose metal yields: that of the law of their force, which knows how far it is open.
!>
!> Source: theory (15.9).
module litz_yielded_spots
   use litz_contact_blocks, only: spot_in_circuit_t
   use litz_contact_points, only: contact_point_t
   use litz_dent_spot, only: spot_of_state
   use litz_law_input, only: wire_pair_t
   use litz_model, only: interaction_t
   implicit none
   private
   public :: find_yielded_spot, has_yielded_spot

contains

   !> The spot is that of the force; a resistance that is given is not.
   pure logical function has_yielded_spot(law)
      type(interaction_t), intent(in) :: law

      has_yielded_spot = law%normal%yields() .and. law%spot%is_of_mechanics
   end function has_yielded_spot

   !> Spot, conductance, and how this changes with the overlap and the angle.
   pure subroutine find_yielded_spot(law, pair, point, circuit)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> With the state of its yielding
      type(contact_point_t), intent(in) :: point
      type(spot_in_circuit_t), intent(inout) :: circuit

      circuit%follows = 0
      if (.not. allocated(point%yielding)) return
      if (.not. point%yielding%area > 0) return
      circuit%spot = spot_of_state(law%spot, pair%resistivity, point%yielding, point%ellipse%ratio)
      associate (spot => circuit%spot)
         circuit%dconductance_dgap = -point%weight*spot%dconductance_dforce
         circuit%dconductance = circuit%dconductance_dgap*point%kinematics%dgap
         spot%conductance = point%weight*spot%conductance
         spot%dconductance_dresistivity = point%weight*spot%dconductance_dresistivity
         spot%dconductance_dforce = 0
         spot%dconductance_dangle = point%weight*spot%dconductance_dangle
      end associate
   end subroutine find_yielded_spot

end module litz_yielded_spots
