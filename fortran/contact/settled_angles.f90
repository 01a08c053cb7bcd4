!> Where the angle of a crossing is taken near a node, while the iteration goes on.
!>
!> The curvature of the axes has a jump at a node, and so has what the angle changes as the contact slides: a contact at
!> a node would go from one element to the other and back in every iteration. Source: theory section 10.
module litz_settled_angles
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_point_t
   implicit none
   private
   public :: holds_angle, settle_angle

   !> In units of xi: nearer to a node than this the angle of a crossing stays within an iteration
   real(dp), parameter :: near_node = 0.1_dp

contains

   !> The places at which the angle is taken are on the elements of the contact, and not far from it.
   pure logical function holds_angle(point)
      type(contact_point_t), intent(in) :: point

      holds_angle = all(point%angle_element == [point%element_bar, point%element]) .and. &
         all(abs(point%angle_at - [point%xi_bar, point%xi]) < 2*near_node)
   end function holds_angle

   !> The places at which the angle is taken, from now on.
   pure subroutine settle_angle(point)
      type(contact_point_t), intent(inout) :: point

      point%angle_element = [point%element_bar, point%element]
      point%angle_at = [point%xi_bar, point%xi]
      point%angle_stays = any(abs(point%angle_at) > 1 - near_node)
   end subroutine settle_angle

end module litz_settled_angles
