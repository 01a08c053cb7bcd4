!> The spot of two crossed wires whose metal yields: that of the law of their force, which knows how far it is open.
!>
!> Source: theory (15.9).
module litz_yielded_spots
   use litz_kinds, only: dp, pi
   use litz_contact_blocks, only: spot_in_circuit_t
   use litz_contact_points, only: contact_point_t
   use litz_cut_lens, only: is_cut
   use litz_law_input, only: wire_pair_t
   use litz_model, only: interaction_t
   use litz_normal_forces, only: weight_of_lens
   use litz_spot_resistance, only: spot_metal_t, set_conductance
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
      type(spot_metal_t) :: metal

      circuit%follows = 0
      if (.not. point%yielding%area > 0) return
      metal%resistivity = pair%resistivity
      if (law%spot%film_number > 0) metal%film = law%spot%data(law%spot%film_number)
      if (law%spot%path_number > 0) metal%resistivity_path = law%spot%data(law%spot%path_number)
      associate (spot => circuit%spot, state => point%yielding, ratio => point%ellipse%ratio, &
         weight => weight_of_lens(point))
         spot%semi_major = sqrt(state%area/(pi*ratio))
         spot%semi_minor = ratio*spot%semi_major
         call set_conductance(metal, state%disc, state%ddisc(:2), state%area, state%darea(:2), spot)
         ! next to ends the angle stays
         if (is_cut(point%lens)) spot%dconductance_dangle = 0
         circuit%dconductance = weight*(spot%dconductance_dangle*point%kinematics%dangle &
            - spot%dconductance_dforce*point%kinematics%dgap)
         spot%conductance = weight*spot%conductance
         spot%dconductance_dresistivity = weight*spot%dconductance_dresistivity
         spot%dconductance_dforce = 0
         spot%dconductance_dangle = 0
      end associate
   end subroutine find_yielded_spot

end module litz_yielded_spots
