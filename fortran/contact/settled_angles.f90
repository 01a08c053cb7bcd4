!> Where the angle of a crossing is taken near a node, while the iteration goes on.
!>
!> The curvature of the axes has a jump at a node, and so has what the angle changes as the contact slides: a contact at
!> a node would go from one element to the other and back in every iteration. Farther from it the angle comes to be that
!> of the closest points, so that the forces have no jump as the contact comes near. Source: theory section 10.
module litz_settled_angles
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_point_t
   use litz_lens_law, only: smooth_step
   implicit none
   private
   public :: holds_angle, settle_angle

   !> In units of xi: nearer to a node than this the angle of a crossing stays within an iteration; from this distance
   !> on it does not
   real(dp), parameter :: near_node = 0.1_dp, far_from_node = 0.4_dp

contains

   !> The places at which the angle is taken are on the elements of the contact.
   pure logical function holds_angle(point)
      type(contact_point_t), intent(in) :: point

      holds_angle = all(point%angle_element == [point%element_bar, point%element])
   end function holds_angle

   !> The places at which the angle is taken, from now on.
   pure subroutine settle_angle(point)
      type(contact_point_t), intent(inout) :: point

      point%angle_element = [point%element_bar, point%element]
      point%angle_at = [point%xi_bar, point%xi]
      point%fixed_share = smooth_step((maxval(abs(point%angle_at)) - (1 - far_from_node))/(far_from_node - near_node))
   end subroutine settle_angle

end module litz_settled_angles
