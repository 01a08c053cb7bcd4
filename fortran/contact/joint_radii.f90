!> Radii of wires where legs of different radius meet: a joint is a ball of the thickest leg, and the thinner ones come
!> out of it within its radius.
!>
!> So the surface does not depend on which of the legs a contact is attributed to, and has no step. Source: theory
!> section 10.
module litz_joint_radii
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_point_t
   use litz_element_library, only: elements_t
   use litz_lens_law, only: smooth_step
   use litz_line_laps, only: distances_to_ends
   use litz_wires, only: wires_t
   implicit none
   private
   public :: add_balls, largest_radius

   !> A difference of radii that is no more than round-off, in radii
   real(dp), parameter :: same = 1.0e-9_dp

contains

   !> What the balls at joints add to the radii of a contact, in its gap.
   pure subroutine add_balls(wires, elements, point)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Out: with its radii
      type(contact_point_t), intent(inout) :: point
      real(dp) :: extra(2), slope(2)
      integer :: i

      associate (pair => [point%element_bar, point%element], arc => [point%arc_bar, point%arc], &
         kinematics => point%kinematics)
         point%radius = elements%radius(pair)
         if (all(wires%is_free(:, wires%wire(pair)))) return
         do i = 1, 2
            call ball_at(wires, elements, pair(i), arc(i), extra(i), point%ball_slope(i), point%ball_bend(i))
         end do
         if (.not. any(extra > 0)) return
         point%radius = point%radius + extra
         kinematics%gap = kinematics%gap - sum(extra)
         slope = point%ball_slope*wires%direction(pair)*elements%length(pair)/2
         kinematics%dgap = kinematics%dgap - slope(1)*kinematics%rows%dxi_bar - slope(2)*kinematics%rows%dxi
      end associate
   end subroutine add_balls

   !> The largest radius of an element [m].
   pure real(dp) function largest_radius(wires, elements, e) result(radius)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      real(dp) :: to_ends(2), ball, beyond
      integer :: k

      radius = elements%radius(e)
      to_ends = distances_to_ends(wires, elements, e, wires%arc(e)) - elements%length(e)/2
      do k = 1, 2
         if (wires%is_free(k, wires%wire(e))) cycle
         call find_ball(wires, elements, wires%wire(e), k, ball, beyond)
         if (to_ends(k) < ball) radius = max(radius, elements%radius(e) + beyond)
      end do
   end function largest_radius

   !> What balls add to the radius of a wire at a place, and how that changes along it.
   pure subroutine ball_at(wires, elements, e, arc, extra, slope, bend)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      !> Arc length along its wire [m]
      real(dp), intent(in) :: arc
      !> [m], [-], [1/m]
      real(dp), intent(out) :: extra, slope, bend
      real(dp) :: to_ends(2), ball, beyond, u
      integer :: k

      extra = 0
      slope = 0
      bend = 0
      to_ends = distances_to_ends(wires, elements, e, arc)
      do k = 1, 2
         if (wires%is_free(k, wires%wire(e))) cycle
         call find_ball(wires, elements, wires%wire(e), k, ball, beyond)
         u = max(0.0_dp, to_ends(k)/ball)
         if (.not. u < 1) cycle
         extra = extra + beyond*(1 - smooth_step(u))
         slope = slope + (2*k - 3)*beyond*6*u*(1 - u)/ball
         bend = bend - beyond*6*(1 - 2*u)/ball**2
      end do
   end subroutine ball_at

   !> The ball at an end of a wire that is joined to others.
   pure subroutine find_ball(wires, elements, wire, k, ball, beyond)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Wire, and its first or second end
      integer, intent(in) :: wire, k
      !> Radius, and by how much that of the wire is smaller [m]
      real(dp), intent(out) :: ball, beyond
      real(dp) :: own
      integer :: i

      own = radius_at_node(merge(-1, 1, (wires%direction(end_element()) > 0) .eqv. k == 1)*end_element())
      ball = own
      associate (node => wires%end_node(k, wire))
         do i = wires%first_at_node(node), wires%first_at_node(node + 1) - 1
            ball = max(ball, radius_at_node(wires%at_node(i)))
         end do
      end associate
      beyond = ball - own
      if (beyond <= same*ball) beyond = 0

   contains

      !> Last element of the wire there.
      pure integer function end_element()
         end_element = wires%element(merge(wires%first(wire), wires%first(wire + 1) - 1, k == 1))
      end function end_element

      !> Of an element at one of its nodes [m].
      pure real(dp) function radius_at_node(signed)
         !> +-element (- : its first node)
         integer, intent(in) :: signed

         radius_at_node = elements%radius(abs(signed)) + sign(1, signed)*elements%taper(abs(signed))
      end function radius_at_node

   end subroutine find_ball

end module litz_joint_radii
