!> How the distance to the other wire grows along the stretches of a wire that lead away from a joint.
!>
!> Source: theory section 10.
module litz_joint_ways
   use litz_kinds, only: dp, pi
   use litz_axis, only: axis_shape, on_axis
   use litz_contact_lens, only: least_bend, deepest, least_overlap, small_sine, moderate_sine
   use litz_contact_points, only: contact_point_t, pair_geometry, away_from
   use litz_element_library, only: elements_t
   use litz_lens_law, only: smooth_step
   use litz_line_kinematics, only: line_profile_t, line_profile
   use litz_model, only: model_t
   use litz_rotations, only: cross
   use litz_wires, only: wires_t
   implicit none
   private
   public :: view_t, joint_t, way_t, view_from, overlap_of, find_ways

   !> Angles by which a wire turns at a joint up to which it is a smooth bend to the law, and from which on a corner
   !> [rad] (20 and 40 degrees)
   real(dp), parameter :: smooth_up_to = 20*pi/180, corner_from = 40*pi/180

   !> Slope of a distance that counts as none
   real(dp), parameter :: flat = 1.0e-9_dp

   !> What one wire of a contact sees of the other one, and how deep the contact is.
   type :: view_t
      !> 1: the barred, 2: the unbarred wire sees the other one, which has this element and this place in it
      integer :: side = 0, other = 0
      real(dp) :: xi = 0
      !> The contact is at an end or joint of the other wire
      logical :: is_point = .false.
      !> Position (3) [m], direction (3), and curvature (3) [1/m] of its axis
      real(dp) :: at(3) = 0, along(3) = 0, curvature(3) = 0
      !> Directions of all its stretches there (3, n)
      real(dp), allocatable :: ways(:, :)
      !> Distance of the axes, overlap, smaller radius [m]
      real(dp) :: distance = 0, overlap = 0, radius = 0
      !> `axis_linear` or `axis_hermite`
      integer :: axis = 0
   end type view_t

   !> An end or joint of a wire at which a contact is, or in whose overlap it lies.
   type :: joint_t
      !> Node, and the element that leads there from the contact; 0: the contact is there
      integer :: node = 0, from = 0
      !> From the node to the other wire (3), distance of the axes, overlap, and length of wire from the contact [m]
      real(dp) :: normal(3) = 0, distance = 0, overlap = 0, path = 0
      !> What lies on the stretch that leads there, of a parabola that goes on beyond the joint
      real(dp) :: part_before = 0
      !> What belongs to this contact, where several lie next to the joint
      real(dp) :: share = 1
   end type joint_t

   !> One stretch as it leads away from a joint.
   type :: way_t
      integer :: element = 0
      !> The joint in the element: -1 or 1
      real(dp) :: xi = 0
      !> Unit vector away from the joint (3)
      real(dp) :: away(3) = 0
      !> Slope and curvature of the distance along it, as they are and as the law sees them: smooth bends are no corners
      real(dp) :: slope = 0, profile_bend = 0, tilt = 0, bend = 0
      !> Part of its parabola that lies on it, and twice its middle over its length
      real(dp) :: part = 0, u = 0
   end type way_t

contains

   !> What counts of the overlap of a contact; at first touch a tilt of round-off makes no difference [m].
   pure real(dp) function overlap_of(point) result(overlap)
      type(contact_point_t), intent(in) :: point

      overlap = min(-point%gap, deepest*minval(point%radius))
      if (point%gap >= 0) overlap = least_overlap*sum(point%radius)
   end function overlap_of

   !> What a wire of a contact sees of the other one.
   pure type(view_t) function view_from(side, model, wires, elements, axis, x, rotation, point) result(view)
      !> 1: from the barred wire, 2: from the unbarred one; `axis_linear` or `axis_hermite`
      integer, intent(in) :: side, axis
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(contact_point_t), intent(in) :: point
      real(dp) :: xe(3, 4), t(3, 4), length(2), h(4), h1(4), h2(4), x1(3), x2(3)

      view%side = side
      view%axis = axis
      view%other = merge(point%element, point%element_bar, side == 1)
      view%xi = merge(point%xi, point%xi_bar, side == 1)
      view%is_point = point%held(3 - side)
      call pair_geometry(model, wires, elements, point%element_bar, point%element, x, rotation, xe, t, length)
      associate (first => merge(3, 1, side == 1))
         call axis_shape(axis, length(3 - side), view%xi, h, h1, h2)
         view%at = on_axis(h, xe(:, first:first + 1), t(:, first:first + 1))
         x1 = on_axis(h1, xe(:, first:first + 1), t(:, first:first + 1))
         x2 = on_axis(h2, xe(:, first:first + 1), t(:, first:first + 1))
      end associate
      view%along = x1/norm2(x1)
      view%ways = reshape(view%along, [3, 1])
      if (view%is_point) view%ways = ways_at(model, wires, axis, model%connectivity(merge(1, 2, view%xi < 0), &
         view%other), x, rotation)
      view%curvature = (x2 - dot_product(x2, view%along)*view%along)/dot_product(x1, x1)
      view%distance = point%kinematics%distance
      view%radius = minval(point%radius)
      view%overlap = overlap_of(point)
   end function view_from

   !> Directions away from a node of all stretches there (3, n).
   pure function ways_at(model, wires, axis, node, x, rotation) result(ways)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      !> `axis_linear` or `axis_hermite`; node
      integer, intent(in) :: axis, node
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      real(dp), allocatable :: ways(:, :)
      integer :: i

      associate (here => wires%at_node(wires%first_at_node(node):wires%first_at_node(node + 1) - 1))
         ways = reshape([(away_from(model, wires, axis, abs(here(i)), merge(1, 2, here(i) < 0), x, rotation), &
            i=1, size(here))], [3, size(here)])
      end associate
   end function ways_at

   !> Slopes and curvatures of the distance along all stretches at a joint. One that turns by little more than a smooth
   !> bend is hardly a corner to a wire across: the law sees a part of its tilt.
   pure subroutine find_ways(model, wires, elements, x, rotation, view, joint, ways)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(view_t), intent(in) :: view
      type(joint_t), intent(in) :: joint
      !> In the order of the elements at the node
      type(way_t), intent(out) :: ways(:)
      type(line_profile_t) :: profile
      real(dp) :: straight, sharp, cosine(size(ways))
      integer :: i, j, signed

      do i = 1, size(ways)
         signed = wires%at_node(wires%first_at_node(joint%node) + i - 1)
         ways(i)%element = abs(signed)
         ways(i)%xi = sign(1, signed)
         ways(i)%away = away_from(model, wires, view%axis, abs(signed), merge(1, 2, signed < 0), x, rotation)
         profile = profile_along(model, wires, elements, x, rotation, view, joint, ways(i))
         ways(i)%profile_bend = profile%bend
         ways(i)%slope = -ways(i)%xi*profile%slope
         ! where a contact is at a joint the distance grows along all stretches, but for round-off
         if (joint%from == 0 .or. ways(i)%slope > -flat) ways(i)%slope = max(0.0_dp, ways(i)%slope)
      end do
      do i = 1, size(ways)
         ways(i)%tilt = ways(i)%slope
         if (size(ways) > 1) then
            cosine = [(-dot_product(ways(i)%away, ways(j)%away), j=1, size(ways))]
            cosine(i) = -2
            j = maxloc(cosine, 1)
            straight = max(0.0_dp, -ways(j)%slope)
            sharp = max(smooth_step((acos(min(1.0_dp, cosine(j))) - smooth_up_to)/(corner_from - smooth_up_to)), &
               side_by_side(view, joint, ways(i)))
            if (ways(i)%slope > straight) ways(i)%tilt = straight + sharp*(ways(i)%slope - straight)
         end if
         ways(i)%bend = least_bend(merge(1/joint%distance, ways(i)%profile_bend, view%is_point), joint%overlap, &
            view%radius)
         ways(i)%u = -ways(i)%tilt/sqrt(2*ways(i)%bend*joint%overlap + ways(i)%tilt**2)
         ways(i)%part = smooth_step((1 + ways(i)%u)/2)
      end do
   end subroutine find_ways

   !> 1 where a stretch leads away from a joint along a stretch of the other wire, as seen along the line between the
   !> two, 0 where it crosses that.
   pure real(dp) function side_by_side(view, joint, way)
      type(view_t), intent(in) :: view
      type(joint_t), intent(in) :: joint
      type(way_t), intent(in) :: way
      real(dp) :: level(3), sine
      integer :: i

      level = way%away - dot_product(way%away, joint%normal)*joint%normal
      sine = minval([(norm2(cross(level, view%ways(:, i))), i=1, size(view%ways, 2))])/max(norm2(level), tiny(level))
      side_by_side = 1 - smooth_step((sine - small_sine)/(moderate_sine - small_sine))
   end function side_by_side

   !> How the distance changes along a stretch from a joint on.
   pure type(line_profile_t) function profile_along(model, wires, elements, x, rotation, view, joint, way) &
      result(profile)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(view_t), intent(in) :: view
      type(joint_t), intent(in) :: joint
      type(way_t), intent(in) :: way
      real(dp) :: xe(3, 4), t(3, 4), length(2)

      call pair_geometry(model, wires, elements, view%other, way%element, x, rotation, xe, t, length)
      profile = line_profile(xe, t, length, view%axis, view%xi, way%xi, joint%normal, joint%distance)
   end function profile_along

end module litz_joint_ways
