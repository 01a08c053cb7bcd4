!> The stretches of a wire at a round end or joint, and what each of them has of a contact there.
!>
!> A wire is a tube: smooth stretches between round ends and joints (kinks, branches). Along each stretch the overlap
!> with the other wire is a parabola, of which its cylinder has the integral between the ends of the stretch; a round
!> end or joint has what the cylinders there leave. All stretches at a joint count alike, whichever of them the contact
!> is attributed to, so that nothing depends on the order of elements. Source: theory section 10.
module litz_contact_legs
   use litz_kinds, only: dp, pi
   use litz_axis, only: axis_shape, on_axis
   use litz_contact_lens, only: cut_ends, flatness, least_bend, deepest, least_overlap, small_sine, moderate_sine
   use litz_contact_points, only: contact_point_t, leg_t, pair_geometry, away_from, arc_at
   use litz_element_library, only: elements_t
   use litz_lens_law, only: smooth_step
   use litz_line_kinematics, only: line_profile_t, line_profile, lens_sine
   use litz_line_laps, only: distances_to_ends
   use litz_model, only: model_t
   use litz_rotations, only: cross
   use litz_wires, only: wires_t
   implicit none
   private
   public :: measure_legs

   !> Angles by which a wire turns at a joint up to which it is a smooth bend to the law, and from which on a corner
   !> [rad] (20 and 40 degrees)
   real(dp), parameter :: smooth_up_to = 20*pi/180, corner_from = 40*pi/180

   !> Sine of an angle that counts, at least
   real(dp), parameter :: least_sine = 1.0e-3_dp
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

   !> The stretches at a contact that is at an end or joint, or near a joint, and what joints change of it. Free ends
   !> are the matter of litz_cut_lens.
   pure subroutine measure_legs(model, wires, elements, axis, x, rotation, point)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(contact_point_t), intent(inout) :: point
      type(view_t) :: view(2)
      integer :: side

      if (.not. any(point%held)) then
         if (.not. (point%gap < 0 .and. point%kinematics%distance > 0)) return
         if (all([(reach_of_joints(wires, elements, side, point) >= 1, side=1, 2)])) return
      end if
      allocate (point%legs(0))
      do side = 1, 2
         view(side) = view_from(side, model, wires, elements, axis, x, rotation, point)
      end do
      do side = 1, 2
         if (point%at_end(side)) then
            call add_end(model, wires, elements, x, rotation, view(side), point)
         else if (point%held(side)) then
            point%present_parts%of_cylinder(side) = 0
            call add_joint(model, wires, elements, x, rotation, view(side), joint_of_contact(model, view(side), &
               point), point)
         else
            point%present_parts%of_cylinder(side) = 0
            call add_own_stretch(model, wires, elements, x, rotation, view(side), view(3 - side)%along, point)
         end if
         if (point%held(side)) call set_tilt(view(side), point)
      end do
      point%present_parts%angle = angle_of_legs(point%legs, point%kinematics%angle)
   end subroutine measure_legs

   !> The distances of a contact from both ends of its wire, over the half length of its overlap, where these are less
   !> than 1 and the ends are at joints (2).
   pure function reach_of_joints(wires, elements, side, point) result(u)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> 1: of the barred, 2: of the unbarred wire
      integer, intent(in) :: side
      type(contact_point_t), intent(in) :: point
      real(dp) :: u(2), sine, length

      sine = 1
      if (.not. any(point%held)) sine = max(lens_sine(point%kinematics), sin(point%kinematics%angle))
      length = sqrt(2*point%kinematics%distance*overlap_of(elements, point))
      associate (pair => [point%element_bar, point%element])
         u = distances_to_ends(wires, elements, pair(side), merge(point%arc_bar, point%arc, side == 1))
         where (cut_ends(wires, elements, pair(side), minval(elements%radius(pair)))) u = huge(u)
      end associate
      u = min(min(u, sqrt(huge(u)))*sine, length)/length
   end function reach_of_joints

   !> The wire at the free end of which the contact is.
   pure subroutine add_end(model, wires, elements, x, rotation, view, point)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(view_t), intent(in) :: view
      type(contact_point_t), intent(inout) :: point
      type(way_t) :: way(1)

      associate (joint => joint_of_contact(model, view, point))
         call find_ways(model, wires, elements, x, rotation, view, joint, way)
      end associate
      point%legs = [point%legs, leg_t(side=view%side, element=way(1)%element, xi=way(1)%xi, &
         arc=arc_at(wires, elements, way(1)%element, way(1)%xi), at_contact=.true., tilt=way(1)%slope, &
         bend=way(1)%profile_bend, bend_of_law=way(1)%profile_bend, along=-way(1)%xi*way(1)%away, &
         direction=way(1)%away, part=1.0_dp)]
   end subroutine add_end

   !> What counts of the overlap of a contact; at first touch a tilt of round-off makes no difference [m].
   pure real(dp) function overlap_of(elements, point) result(overlap)
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point

      associate (radius => elements%radius([point%element_bar, point%element]))
         overlap = min(-point%gap, deepest*minval(radius))
         if (point%gap >= 0) overlap = least_overlap*sum(radius)
      end associate
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
      view%radius = minval(elements%radius([point%element_bar, point%element]))
      view%overlap = overlap_of(elements, point)
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

   !> The end or joint at which the contact is.
   pure type(joint_t) function joint_of_contact(model, view, point) result(joint)
      type(model_t), intent(in) :: model
      type(view_t), intent(in) :: view
      type(contact_point_t), intent(in) :: point

      associate (e => merge(point%element_bar, point%element, view%side == 1), &
         xi => merge(point%xi_bar, point%xi, view%side == 1))
         joint%node = model%connectivity(merge(1, 2, xi < 0), e)
      end associate
      joint%normal = (2*view%side - 3)*point%kinematics%normal
      joint%distance = view%distance
      joint%overlap = view%overlap
   end function joint_of_contact

   !> The stretch on which a contact lies between two ends or joints.
   pure subroutine add_own_stretch(model, wires, elements, x, rotation, view, along, point)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(view_t), intent(in) :: view
      !> Unit vector along the axis (3)
      real(dp), intent(in) :: along(3)
      type(contact_point_t), intent(inout) :: point
      type(joint_t) :: joint
      real(dp) :: u(2), part(2)
      integer :: k, e

      e = merge(point%element_bar, point%element, view%side == 1)
      u = reach_of_joints(wires, elements, view%side, point)
      part = smooth_step((1 + u)/2)
      associate (own => minval(part) - (1 - maxval(part)), cylinder => point%present_parts%of_cylinder(view%side))
         cylinder = cylinder + own
         point%legs = [point%legs, leg_t(side=view%side, element=e, xi=merge(point%xi_bar, point%xi, view%side == 1), &
            arc=merge(point%arc_bar, point%arc, view%side == 1), at_contact=.true., along=along, direction=along, &
            part=own)]
      end associate
      do k = 1, 2
         if (.not. u(k) < 1) cycle
         joint = joint_beyond(wires%wire(e), k, model, wires, x, view)
         joint%overlap = view%overlap*(1 - u(k)**2)
         joint%path = 0
         joint%part_before = part(k)
         call add_joint(model, wires, elements, x, rotation, view, joint, point)
      end do
   end subroutine add_own_stretch

   !> The end or joint where a wire ends.
   pure type(joint_t) function joint_beyond(wire, k, model, wires, x, view) result(joint)
      !> Wire, and its first or second end
      integer, intent(in) :: wire, k
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      !> Positions (3, n_nodes) [m]
      real(dp), intent(in) :: x(:, :)
      type(view_t), intent(in) :: view
      real(dp) :: line(3), s

      joint%from = wires%element(merge(wires%first(wire), wires%first(wire + 1) - 1, k == 1))
      joint%node = model%connectivity(merge(1, 2, (wires%direction(joint%from) > 0) .eqv. k == 1), joint%from)
      line = view%at - x(:, joint%node)
      if (.not. view%is_point) then
         ! the foot on the other wire, as it goes on from the contact
         s = -dot_product(line, view%along)
         line = line + s*view%along + s**2/2*view%curvature
      end if
      joint%distance = norm2(line)
      joint%normal = line/joint%distance
   end function joint_beyond

   !> A round end or joint, and all stretches that lead away from there.
   pure recursive subroutine add_joint(model, wires, elements, x, rotation, view, joint, point)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(view_t), intent(in) :: view
      type(joint_t), intent(in) :: joint
      type(contact_point_t), intent(inout) :: point
      type(way_t) :: ways(wires%first_at_node(joint%node + 1) - wires%first_at_node(joint%node))
      type(joint_t) :: here
      real(dp) :: covered, scale
      integer :: i

      call find_ways(model, wires, elements, x, rotation, view, joint, ways)
      point%present_parts%is_near = .true.
      here = joint
      ! what leads away from several contacts belongs to all of them
      here%share = joint%share/max(1, count(ways%slope < 0 .or. ways%element == joint%from))
      scale = (joint%overlap/view%overlap)**1.5_dp
      covered = joint%part_before
      do i = 1, size(ways)
         if (ways(i)%element == joint%from) cycle
         if (ways(i)%slope < 0) then
            covered = covered + ways(i)%part
         else
            call add_way(model, wires, elements, x, rotation, view, here, ways(i), point)
            covered = covered + merge(ways(i)%part, of_cylinder(ways(i)), size(ways) == 1)
         end if
      end do
      associate (of_end => point%present_parts%of_end(view%side))
         of_end = of_end + here%share*max(0.0_dp, 1 - covered)*scale
      end associate
   end subroutine add_joint

   !> What the cylinder of a stretch has, of the force that it would have with the overlap at the joint.
   pure real(dp) function of_cylinder(way)
      type(way_t), intent(in) :: way

      of_cylinder = flatness(way%tilt)*(way%part/(1 - min(way%u, 0.0_dp)**2)**1.5_dp)
   end function of_cylinder

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

   !> A stretch that leads away from a joint, up to where it ends in its turn.
   pure recursive subroutine add_way(model, wires, elements, x, rotation, view, joint, way, point)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(view_t), intent(in) :: view
      type(joint_t), intent(in) :: joint
      type(way_t), intent(in) :: way
      type(contact_point_t), intent(inout) :: point
      type(joint_t) :: next
      real(dp) :: to_ends(2), arc, length, part, slope, direction(3)
      integer :: ahead

      part = of_cylinder(way)
      ahead = merge(2, 1, way%xi*wires%direction(way%element) < 0)
      arc = arc_at(wires, elements, way%element, way%xi)
      to_ends = distances_to_ends(wires, elements, way%element, arc)
      length = to_ends(ahead)
      if (joint%path + length < view%radius) then
         next = joint_beyond(wires%wire(way%element), ahead, model, wires, x, view)
         next%overlap = joint%overlap - (way%tilt + way%bend*length/2)*length
         next%path = joint%path + length
         next%share = joint%share
         if (next%overlap > 0) then
            slope = way%tilt + way%bend*length
            next%part_before = 1 - smooth_step((1 - slope/sqrt(2*way%bend*next%overlap + slope**2))/2)
            part = part*(1 - (1 - next%part_before)/max(way%part, tiny(part)))
            call add_joint(model, wires, elements, x, rotation, view, next, point)
         end if
      end if
      part = joint%share*part*(joint%overlap/view%overlap)**1.5_dp
      direction = way%away + (way%slope - way%tilt)*joint%normal
      point%legs = [point%legs, leg_t(side=view%side, element=way%element, xi=way%xi, arc=arc, &
         at_contact=joint%from == 0, tilt=way%slope, bend=way%profile_bend, bend_of_law=way%profile_bend &
         *(1 - way%tilt**2)/max(1 - way%slope**2, least_sine**2), along=-way%xi*way%away, &
         direction=direction/norm2(direction), part=part)]
      associate (cylinder => point%present_parts%of_cylinder(view%side))
         cylinder = cylinder + part
      end associate
   end subroutine add_way

   !> Where the contact is: the slope along the stretch along which the distance grows least, and the curvature of an
   !> overlap that is as long as those of all stretches in the mean.
   pure subroutine set_tilt(view, point)
      !> From the wire that is at its end or joint
      type(view_t), intent(in) :: view
      type(contact_point_t), intent(inout) :: point
      type(leg_t), allocatable :: legs(:)
      real(dp), allocatable :: weight(:)
      integer :: i

      associate (side => view%side)
         legs = pack(point%legs, point%legs%side == side .and. point%legs%at_contact)
         point%tilt(side) = minval(legs%tilt)
         point%bend(side) = legs(1)%bend
         if (size(legs) == 1) return
         weight = max(legs%part, tiny(1.0_dp))
         point%bend(side) = (sum(weight)/sum([(weight(i)/sqrt(least_bend(legs(i)%bend_of_law, view%overlap, &
            view%radius)), i=1, size(legs))]))**2
      end associate
   end subroutine set_tilt

   !> Angle at which an overlap is as long as those of all stretches of one wire with all of the other one in the mean,
   !> by their parts [rad].
   pure real(dp) function angle_of_legs(legs, angle) result(mean)
      type(leg_t), intent(in) :: legs(:)
      !> Angle of the axes at the contact, as the elements point [rad]
      real(dp), intent(in) :: angle
      real(dp) :: weight, weights, over_sine
      integer :: i, j

      mean = angle
      if (size(legs) < 3) return
      weights = 0
      over_sine = 0
      do i = 1, size(legs)
         if (legs(i)%side /= 1) cycle
         do j = 1, size(legs)
            if (legs(j)%side /= 2) cycle
            ! equal parts where no cylinder has any
            weight = max(legs(i)%part*legs(j)%part, tiny(weight))
            weights = weights + weight
            over_sine = over_sine + weight/max(norm2(cross(legs(i)%direction, legs(j)%direction)), least_sine)
         end do
      end do
      mean = asin(min(1.0_dp, weights/over_sine))
      if (angle > pi/2) mean = pi - mean
   end function angle_of_legs

end module litz_contact_legs
