!> The stretches of a wire at a round end or joint, and what each of them has of a contact there.
!>
!> A wire is a tube: smooth stretches between round ends and joints (kinks, branches). Along each stretch the overlap
!> with the other wire is a parabola, of which its cylinder has the integral between the ends of the stretch; a round
!> end or joint has what the cylinders there leave. All stretches at a joint count alike, whichever of them the contact
!> is attributed to, so that nothing depends on the order of elements. Source: theory section 10.
module litz_contact_legs
   use litz_kinds, only: dp, pi
   use litz_contact_lens, only: cut_ends, flatness, least_bend, sine_of_overlap
   use litz_contact_points, only: contact_point_t, leg_t, joint_parts_t, arc_at
   use litz_element_library, only: elements_t, material_at
   use litz_joint_ways, only: view_t, joint_t, way_t, view_from, overlap_of, find_ways
   use litz_lens_law, only: smooth_step
   use litz_line_laps, only: distances_to_ends
   use litz_model, only: model_t
   use litz_rotations, only: cross
   use litz_wires, only: wires_t
   implicit none
   private
   public :: measure_legs

   !> Sine of an angle that counts, at least
   real(dp), parameter :: least_sine = 1.0e-3_dp

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
      call take_means(point%present_parts)
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
      if (.not. any(point%held)) sine = max(sine_of_overlap(point), sin(point%kinematics%angle))
      length = sqrt(2*point%kinematics%distance*overlap_of(point))
      associate (pair => [point%element_bar, point%element])
         u = distances_to_ends(wires, elements, pair(side), merge(point%arc_bar, point%arc, side == 1))
         where (cut_ends(wires, elements, pair(side), minval(point%radius))) u = huge(u)
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
      call add_material(model, elements, view%side, e, point%legs(size(point%legs))%part, point)
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
      covered = here%share*max(0.0_dp, 1 - covered)*scale
      point%present_parts%of_end(view%side) = point%present_parts%of_end(view%side) + covered
      do i = 1, size(ways)
         call add_material(model, elements, view%side, ways(i)%element, covered/size(ways), point)
      end do
   end subroutine add_joint

   !> What the cylinder of a stretch has, of the force that it would have with the overlap at the joint.
   pure real(dp) function of_cylinder(way)
      type(way_t), intent(in) :: way

      of_cylinder = flatness(way%tilt)*(way%part/(1 - min(way%u, 0.0_dp)**2)**1.5_dp)
   end function of_cylinder

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
         direction=direction/norm2(direction), part=part, overlap=joint%overlap)]
      associate (cylinder => point%present_parts%of_cylinder(view%side))
         cylinder = cylinder + part
      end associate
      call add_material(model, elements, view%side, way%element, part, point)
   end subroutine add_way

   !> The material of a leg counts with its part of the force, that of a round joint is the mean of its legs,
   !> each at its mean temperature.
   pure subroutine add_material(model, elements, side, e, part, point)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> 1: of the barred, 2: of the unbarred wire, and an element of the leg
      integer, intent(in) :: side, e
      !> Part of the force [-]
      real(dp), intent(in) :: part
      type(contact_point_t), intent(inout) :: point

      associate (parts => point%present_parts, weight => max(part, 0.0_dp), own => merge(point%element_bar, &
         point%element, side == 1), leg => material_at(model, elements, e, 0.0_dp))
         if (model%element_section(e) /= model%element_section(own)) parts%is_mixed(side) = .true.
         parts%sum_of_parts(side) = parts%sum_of_parts(side) + weight
         parts%young(side) = parts%young(side) + weight*leg%young
         parts%poisson(side) = parts%poisson(side) + weight*leg%poisson
         parts%resistivity(side) = parts%resistivity(side) + weight*leg%resistivity
      end associate
   end subroutine add_material

   !> From sums to means.
   pure subroutine take_means(parts)
      type(joint_parts_t), intent(inout) :: parts

      parts%is_mixed = parts%is_mixed .and. parts%sum_of_parts > 0
      where (parts%is_mixed)
         parts%young = parts%young/parts%sum_of_parts
         parts%poisson = parts%poisson/parts%sum_of_parts
         parts%resistivity = parts%resistivity/parts%sum_of_parts
      end where
   end subroutine take_means

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
