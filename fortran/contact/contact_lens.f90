!> How far the overlap of a contact reaches along its wires, and what the end of a wire changes of its law.
!>
!> The overlap of a crossing falls from its middle as a parabola. Where it is cut by the end of a wire the cylinder has
!> its integral up to there, and the round end has the rest, so that a contact slides on to the round end without a
!> jump. Source: theory section 10.
module litz_contact_lens
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_point_t, leg_t, is_contact_of
   use litz_lens_law, only: smooth_step
   use litz_line_kinematics, only: lens_sine
   implicit none
   private
   public :: has_lens, half_length_of, half_length_on, divide_at_ends, tells_shares, angle_of_axes, flatness
   public :: least_bend, wedge_length, deepest, least_overlap, small_sine, moderate_sine

   !> Sines of the angle between an axis and the surface of the other wire up to which they lie side by side, and from
   !> which on one runs into the other (5 and 15 degrees)
   real(dp), parameter :: flat_tilt = 0.0872_dp, steep_tilt = 0.2588_dp
   !> Sines of the angle between the axes up to which the lens alone gives the angle of the law, and from which on the
   !> axes do (5 and 10 degrees)
   real(dp), parameter :: small_sine = 0.0872_dp, moderate_sine = 0.1736_dp
   !> Overlap beyond which a lens counts as no longer, in smaller radii
   real(dp), parameter :: deepest = 0.02_dp
   !> Overlap at an end by which its length is told, at least, in distances of the axes
   real(dp), parameter :: least_overlap = 1.0e-5_dp
   !> Overlap over the distance of the axes that is no more than round-off
   real(dp), parameter :: near_round_off = 1.0e-12_dp

contains

   !> The overlap has an end, and its length is known.
   pure logical function has_lens(point)
      !> A crossing, or the contact of an end
      type(contact_point_t), intent(in) :: point

      has_lens = point%kinematics%distance > 0
      if (has_lens .and. .not. any(point%held)) has_lens = lens_sine(point%kinematics) > 0
   end function has_lens

   !> `aW = sqrt(2 d delta)/s` of a crossing; from the end of a wire on that of a wedge, the longest at a joint [m].
   pure real(dp) function half_length_of(point, largest_overlap) result(half_length)
      !> With a lens
      type(contact_point_t), intent(in) :: point
      !> Overlap that counts at most [m]: iterates overlap deeply for a moment, which makes no lines of them
      real(dp), intent(in) :: largest_overlap
      integer :: i, j

      if (.not. any(point%held)) then
         half_length = sqrt(2*point%kinematics%distance*max(0.0_dp, min(-point%gap, largest_overlap))) &
            /lens_sine(point%kinematics)
         return
      end if
      half_length = 0
      do i = 1, size(point%legs)
         do j = 1, size(point%legs)
            if (is_contact_of(point%legs(i), point%legs(j))) half_length = max(half_length, half_length_on(point, &
               point%legs(i), point%legs(j), largest_overlap))
         end do
      end do
   end function half_length_of

   !> How far the overlap of a contact at an end or joint reaches along two of its legs [m].
   pure real(dp) function half_length_on(point, bar, leg, largest_overlap) result(half_length)
      type(contact_point_t), intent(in) :: point
      !> Of the barred and the unbarred wire
      type(leg_t), intent(in) :: bar, leg
      !> Overlap that counts at most [m]
      real(dp), intent(in) :: largest_overlap
      real(dp) :: overlap

      ! at first touch a tilt of round-off would tell lines from ends
      overlap = max(min(-point%gap, largest_overlap), least_overlap*point%kinematics%distance)
      half_length = huge(half_length)
      if (point%held(1)) half_length = wedge_length(bar%tilt, bar%bend, overlap)
      if (point%held(2)) half_length = min(half_length, wedge_length(leg%tilt, leg%bend, overlap))
   end function half_length_on

   !> How far an overlap reaches from the end of a wire on, where the distance grows:
   !> `2 delta/(t + sqrt(t^2 + 2 k delta))` [m].
   pure real(dp) function wedge_length(tilt, bend, overlap) result(length)
      !> t [-], k [1/m] and delta [m], which is positive
      real(dp), intent(in) :: tilt, bend, overlap
      real(dp) :: square

      square = tilt**2 + 2*bend*overlap
      length = huge(length)
      if (square > 0) length = 2*overlap/max(tilt + sqrt(square), tiny(square))
   end function wedge_length

   !> What the cylinders and the round ends of the two wires have of the force. What has been found for a closed contact
   !> stays until the forces balance.
   pure subroutine divide_at_ends(point)
      type(contact_point_t), intent(inout) :: point

      if (point%is_divided .or. point%gap >= 0 .or. .not. point%kinematics%distance > 0) return
      point%is_divided = tells_shares(point)
      point%of_cylinder = point%present_parts%of_cylinder
      point%of_end = point%present_parts%of_end
      point%joint_angle = point%present_parts%joint_angle
      ! cylinders that are cut on both sides have nothing between their ends
      point%of_crossing = 1
      if (all(point%of_end > 0)) point%of_crossing = &
         smooth_step((sin(angle_of_axes(point)) - flat_tilt)/(steep_tilt - flat_tilt))
   end subroutine divide_at_ends

   !> The overlap is more than that of round-off at first touch, so that what is found of it may stay.
   pure logical function tells_shares(point)
      type(contact_point_t), intent(in) :: point

      tells_shares = -point%gap > near_round_off*point%kinematics%distance
   end function tells_shares

   !> Angle of the axes, the mean one at a joint [rad].
   pure real(dp) function angle_of_axes(point) result(angle)
      type(contact_point_t), intent(in) :: point

      angle = merge(point%joint_angle, point%kinematics%angle, point%joint_angle > 0)
   end function angle_of_axes

   !> Curvature of the distance along a wire from its end on, of an overlap that is no longer than a radius [1/m].
   pure real(dp) function least_bend(bend, overlap, radius)
      !> [1/m], [m], [m]
      real(dp), intent(in) :: bend, overlap, radius

      least_bend = max(bend, 2*overlap/radius**2)
   end function least_bend

   !> 1 where an axis lies along the surface of the other wire, 0 where it runs into it.
   pure real(dp) function flatness(tilt)
      !> Sine of the angle
      real(dp), intent(in) :: tilt

      flatness = 1 - smooth_step((tilt - flat_tilt)/(steep_tilt - flat_tilt))
   end function flatness

end module litz_contact_lens
