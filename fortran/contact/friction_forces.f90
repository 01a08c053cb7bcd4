!> Friction of one contact: stiffness of the stick, and the kernel, of a crossing or of a point of a line, with the
!> memory of the contact.
module litz_friction_forces
   use litz_kinds, only: dp
   use litz_contact_kinematics, only: contact_kinematics_t, n_motions
   use litz_contact_friction, only: slip_t, slip_kinematics, friction_residual, friction_tangent
   use litz_contact_points, only: contact_point_t
   use litz_end_kinematics, only: mirrored, mirrored_nodes, mirrored_motions
   use litz_friction_iteration, only: place_touch, place_line_touch
   use litz_friction_law, only: friction_law_t, friction_start_t, friction_law, friction_none, friction_stick, &
      friction_slip
   use litz_law_input, only: wire_pair_t
   use litz_line_friction, only: line_slip_t, line_slip, side_at, line_friction_residual, line_friction_tangent
   use litz_model, only: interaction_t
   use litz_normal_forces, only: overlap_of_point
   use litz_rotation_forms, only: spin_to_hessian
   use litz_stick_laws, only: stick_stiffness_at
   use litz_wires, only: wires_t, arc_from_to
   implicit none
   private
   public :: find_friction, increment_start_t

   !> The two elements of a contact when the increment began, and what has happened since.
   type :: increment_start_t
      !> Displacements and rotations of the four nodes since (24) [m, rad], and what the clearance of an interference
      !> has closed the gap by [m]
      real(dp) :: dq(n_motions) = 0, closing = 0
      !> The load goes on as in the increment before: not the first increment of a step
      logical :: goes_on = .false.
      !> The iteration begins with the motions of the increment before, and not where that has ended
      logical :: is_ahead = .false.
      !> Of a point of a line contact: nodal positions [m] and unit tangents (3, 4) of then, and the rotations of the
      !> nodes since (3, 3, 4)
      real(dp) :: x(3, 4) = 0, t(3, 4) = 0, turned(3, 3, 4) = 0
   end type increment_start_t

   !> Slip since the increment began or the contact closed, by the kernel that it is of.
   type :: contact_slip_t
      !> D1, D2 [m]; derivatives (24, 2)
      real(dp) :: slip(2) = 0, dslip(n_motions, 2) = 0
      !> Directions (3, 2)
      real(dp) :: frame(3, 2) = 0
      !> On the surfaces; and with the two wires exchanged, where the barred one is that with the place
      logical :: is_of_line = .false., is_mirrored = .false.
      type(slip_t) :: crossing
      type(line_slip_t) :: line
   contains
      procedure :: residual
      procedure :: tangent
   end type contact_slip_t

   !> A traction less than this share below the limit of friction is at the limit, but for round-off
   real(dp), parameter :: at_limit = 1.0e-6_dp

contains

   !> Residual and tangent of the traction of a contact.
   pure subroutine find_friction(law, wires, x, t, length, pair, before, dforce_sliding, point, k, r)
      type(interaction_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      !> Nodal positions [m] and unit tangents (3, 4), reference lengths (2) [m]: barred first
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      type(wire_pair_t), intent(in) :: pair
      type(increment_start_t), intent(in) :: before
      !> How the normal force changes as the contact slides next to an end (24)
      real(dp), intent(in) :: dforce_sliding(n_motions)
      !> Gets the traction, and what the iteration supposes of it
      type(contact_point_t), intent(inout) :: point
      !> Tangent (24, 24), in Hessian form, and residual (24)
      real(dp), intent(out) :: k(n_motions, n_motions), r(n_motions)
      type(contact_slip_t) :: slip
      type(friction_law_t) :: supposed
      type(friction_start_t) :: start
      real(dp) :: force, dforce(n_motions), stiffness, dstiffness_dforce, r_supposed(n_motions)

      if (.not. (point%history%closed .or. point%friction_iteration%touched)) then
         call find_touch(wires, length, pair%radius, before, point)
      end if
      if (is_on_surfaces(point)) then
         slip = slip_on_line(wires, x, t, length, pair%radius, before, point)
      else
         slip = slip_of_crossing(law%axis, wires, x, t, length, point)
      end if
      start = start_of_friction(law, pair, point)
      ! what sticks keeps its force, whatever its components
      if (point%has_changed_kind) start%traction = -matmul(point%traction_before, slip%frame)
      k = 0
      r = 0
      if (point%closed) then
         call stick(law, pair, point%force, settled_weight(point), point, stiffness, dstiffness_dforce)
         point%friction = friction_law(law%friction, point%force, stiffness, dstiffness_dforce, start, slip%slip)
         point%traction = -matmul(slip%frame, point%friction%traction)
         r = slip%residual(point%kinematics, point%friction%traction)
         if (.not. point%history%closed) call grow_with_force(dot_product(r, before%dq), point%friction)
      end if

      if (point%friction_iteration%status == friction_none) then
         call suppose(law%friction, before%goes_on, before%is_ahead, start%traction, point)
      end if
      associate (iteration => point%friction_iteration)
         iteration%difference = -r
         iteration%limit = 0
         iteration%dtrial = 0
         iteration%along = 0
         if (.not. point%active) return
         force = max(0.0_dp, point%iteration_force)
         dforce = dforce_sliding - point%stiffness*point%kinematics%dgap
         if (.not. force > 0) return
         call stick(law, pair, force, settled_weight(point), point, stiffness, dstiffness_dforce)
         supposed = friction_law(law%friction, force, stiffness, dstiffness_dforce, start, slip%slip, iteration%status)
         r_supposed = slip%residual(point%kinematics, supposed%traction)
         k = slip%tangent(point%kinematics, t, supposed, dforce, iteration%mixed_traction)
         call spin_to_hessian(k, r_supposed, [4, 10, 16, 22])
         iteration%difference = r_supposed - r
         iteration%trial = supposed%trial
         iteration%dtrial = stiffness*slip%dslip
         iteration%limit = law%friction*force
         iteration%dlimit = law%friction*dforce
         iteration%along = slip%residual(point%kinematics, supposed%dtraction_dforce)/law%friction
      end associate
   end subroutine find_friction

   !> What the iteration supposes of a contact at first: one that was closed before goes on to slip or to stick, and
   !> sticks where a step begins, since there a motion is likely to turn back; a slip that turns back all the same is
   !> found by the first iteration. One that was open does what it would do here: a stick far beyond the limit would
   !> throw open again a contact that closes with a small force.
   pure subroutine suppose(mu, goes_on, is_ahead, traction_before, point)
      !> Coefficient of friction
      real(dp), intent(in) :: mu
      !> As in `increment_start_t`
      logical, intent(in) :: goes_on, is_ahead
      !> When the increment began (2) [N]
      real(dp), intent(in) :: traction_before(2)
      type(contact_point_t), intent(inout) :: point

      associate (iteration => point%friction_iteration)
         iteration%status = friction_stick
         if (point%predicted .or. is_ahead .or. .not. point%history%closed) then
            if (point%closed) iteration%status = point%friction%status
            if (point%closed .and. is_ahead) iteration%mixed_traction = point%friction%traction
         else
            if (goes_on .and. norm2(traction_before) >= (1 - at_limit)*mu*point%history%force) then
               iteration%status = friction_slip
            end if
            iteration%mixed_traction = traction_before
         end if
      end associate
   end subroutine suppose

   !> Slip of a crossing.
   pure type(contact_slip_t) function slip_of_crossing(axis, wires, x, t, length, point) result(slip)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      type(wires_t), intent(in) :: wires
      !> As in `find_friction`
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      type(contact_point_t), intent(in) :: point

      associate (elements => [point%element_bar, point%element])
         slip%crossing = slip_kinematics(point%kinematics, x, t, length, axis, wires%direction(elements), &
            arc_from_to(start_of_slip(point), [point%arc_bar, point%arc], wires%circumference(wires%wire(elements))))
      end associate
      slip%slip = slip%crossing%slip
      slip%dslip = slip%crossing%dslip
      slip%frame = slip%crossing%frame
   end function slip_of_crossing

   !> Friction acts on the surfaces: along lines, and at ends and kinks.
   pure logical function is_on_surfaces(point)
      type(contact_point_t), intent(in) :: point

      is_on_surfaces = point%line_place > 0 .or. any(point%held)
   end function is_on_surfaces

   !> The place stays on the barred wire, and the foot is on the unbarred one.
   pure logical function is_mirrored(point)
      type(contact_point_t), intent(in) :: point

      is_mirrored = point%held(1) .and. .not. point%held(2)
   end function is_mirrored

   !> Slip on the surfaces at a place of one wire over its foot on the other.
   pure type(contact_slip_t) function slip_on_line(wires, x, t, length, radius, before, point) result(slip)
      type(wires_t), intent(in) :: wires
      !> As in `find_friction`, and radii (2) [m]
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2), radius(2)
      type(increment_start_t), intent(in) :: before
      type(contact_point_t), intent(in) :: point
      real(dp) :: arc, normal(3), part

      slip%is_of_line = .true.
      slip%is_mirrored = is_mirrored(point)
      arc = point%friction_iteration%arc_before
      normal = point%friction_iteration%normal_before
      part = point%friction_iteration%part
      if (point%history%closed) then
         arc = point%history%arc(merge(2, 1, slip%is_mirrored))
         normal = point%normal_before
         part = 1
      end if
      if (slip%is_mirrored) then
         associate (m => mirrored_nodes, e => point%element)
            slip%line = line_slip(mirrored(point%kinematics), x(:, m), t(:, m), length([2, 1]), radius([2, 1]), &
               before%turned(:, :, m), -normal, wires%direction(e)*arc_from_to(arc, point%arc, &
               wires%circumference(wires%wire(e))))
         end associate
         slip%dslip = part*slip%line%dslip(mirrored_motions, :)
         slip%frame = -slip%line%frame
      else
         associate (e => point%element_bar)
            slip%line = line_slip(point%kinematics, x, t, length, radius, before%turned, normal, &
               wires%direction(e)*arc_from_to(arc, point%arc_bar, wires%circumference(wires%wire(e))))
         end associate
         slip%dslip = part*slip%line%dslip
         slip%frame = slip%line%frame
      end if
      slip%slip = part*slip%line%slip
   end function slip_on_line

   pure function residual(self, kinematics, traction) result(r)
      class(contact_slip_t), intent(in) :: self
      type(contact_kinematics_t), intent(in) :: kinematics
      !> (2) [N]
      real(dp), intent(in) :: traction(2)
      real(dp) :: r(n_motions)

      if (self%is_of_line) then
         r = line_friction_residual(self%line, traction)
         if (self%is_mirrored) r = r(mirrored_motions)
      else
         r = friction_residual(kinematics, self%crossing, traction)
      end if
   end function residual

   !> Tangent with respect to spins.
   pure function tangent(self, kinematics, t, law, dforce, geometric_traction) result(k)
      class(contact_slip_t), intent(in) :: self
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Unit tangents of the nodes (3, 4)
      real(dp), intent(in) :: t(3, 4)
      type(friction_law_t), intent(in) :: law
      !> How the normal force changes (24), and the traction of the geometric part (2) [N]
      real(dp), intent(in) :: dforce(n_motions), geometric_traction(2)
      real(dp) :: k(n_motions, n_motions)

      if (self%is_mirrored) then
         associate (m => mirrored_motions)
            k = line_friction_tangent(mirrored(kinematics), self%line, self%dslip(m, :), t(:, mirrored_nodes), law, &
               dforce(m), geometric_traction)
            k = k(m, m)
         end associate
      else if (self%is_of_line) then
         k = line_friction_tangent(kinematics, self%line, self%dslip, t, law, dforce, geometric_traction)
      else
         k = friction_tangent(kinematics, self%crossing, t, law, dforce, geometric_traction)
      end if
   end function tangent

   !> Where the foot was when an increment began in which it closes, and how much of the increment
   !> follows the touch, for a motion in proportion.
   pure subroutine find_line_touch(wires, length, radius, before, gap, point)
      type(wires_t), intent(in) :: wires
      !> Reference lengths and radii (2) [m]
      real(dp), intent(in) :: length(2), radius(2)
      type(increment_start_t), intent(in) :: before
      !> Now, below zero [m]
      real(dp), intent(in) :: gap
      type(contact_point_t), intent(inout) :: point
      real(dp) :: xi, distance, normal(3), surfaces

      associate (kinematics => point%kinematics, m => mirrored_nodes)
         surfaces = sum(radius) - (point%gap - kinematics%gap + before%closing)
         if (is_mirrored(point)) then
            xi = point%xi - dot_product(kinematics%dxi, before%dq)
            call side_at(before%x(:, m), before%t(:, m), length([2, 1]), xi, point%xi_bar, kinematics%side, normal, &
               distance)
            call place_line_touch(distance - surfaces, gap, point%arc + wires%direction(point%element)*length(2)/2 &
               *(xi - point%xi), -normal, point%friction_iteration)
         else
            xi = point%xi_bar - dot_product(kinematics%dxi_bar, before%dq)
            call side_at(before%x, before%t, length, xi, point%xi, kinematics%side, normal, distance)
            call place_line_touch(distance - surfaces, gap, point%arc_bar + wires%direction(point%element_bar) &
               *length(1)/2*(xi - point%xi_bar), normal, point%friction_iteration)
         end if
      end associate
   end subroutine find_line_touch

   !> Place at which a contact that was open when the increment began has closed.
   pure subroutine find_touch(wires, length, radius, before, point)
      type(wires_t), intent(in) :: wires
      !> Reference lengths and radii (2) [m]
      real(dp), intent(in) :: length(2), radius(2)
      type(increment_start_t), intent(in) :: before
      type(contact_point_t), intent(inout) :: point
      real(dp) :: gap, gap_start

      gap = point%gap
      if (point%predicted) gap = min(gap, point%predicted_gap)
      if (is_on_surfaces(point)) then
         call find_line_touch(wires, length, radius, before, gap, point)
         return
      end if
      gap_start = point%gap - dot_product(point%kinematics%dgap, before%dq) + before%closing
      call place_touch(gap_start, gap, [point%arc_bar, point%arc], &
         wires%direction([point%element_bar, point%element])*length/2* &
         [dot_product(point%kinematics%dxi_bar, before%dq), dot_product(point%kinematics%dxi, before%dq)], &
         point%friction_iteration)
   end subroutine find_touch

   !> Arc lengths from which a contact slips in this increment (2) [m].
   pure function start_of_slip(point) result(arc)
      type(contact_point_t), intent(in) :: point
      real(dp) :: arc(2)

      arc = point%friction_iteration%touch
      if (point%history%closed) arc = point%history%arc
   end function start_of_slip

   !> The contact when the increment began, with the stiffness that its force of then has in the present geometry.
   pure type(friction_start_t) function start_of_friction(law, pair, point) result(start)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      real(dp) :: dstiffness_dforce

      if (.not. point%history%closed) return
      start%traction = point%history%traction
      start%force = point%history%force
      start%elastic_energy = point%history%elastic_energy
      call stick(law, pair, start%force, point%history%weight, point, start%stiffness, dstiffness_dforce)
   end function start_of_friction

   !> Work where the normal force has grown from nothing, in proportion to the slip since the contact closed: none on
   !> the way before.
   pure subroutine grow_with_force(work, friction)
      !> Of the present traction in the motion since the increment began [J]
      real(dp), intent(in) :: work
      type(friction_law_t), intent(inout) :: friction

      friction%work_beyond_mean = friction%elastic_work + friction%dissipation - work/2
   end subroutine grow_with_force

   !> Share of a crossing [-] or length of a place [m] by which friction tells its stiffness: within an iteration it
   !> stays.
   pure real(dp) function settled_weight(point)
      type(contact_point_t), intent(in) :: point

      settled_weight = merge(point%settled_weight, point%weight, point%line_place > 0)
   end function settled_weight

   !> Tangential stiffness of a contact that sticks, and how it changes with the normal force.
   pure subroutine stick(law, pair, force, weight, point, stiffness, dstiffness_dforce)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> Normal force, greater than 0 [N], and the share of a crossing [-] or the length of a line [m] that has it
      real(dp), intent(in) :: force, weight
      type(contact_point_t), intent(in) :: point
      !> [N/m], [1/m]
      real(dp), intent(out) :: stiffness, dstiffness_dforce

      call stick_stiffness_at(law%stick_law, law%stick_value, law%friction, force, &
         overlap_of_point(law%normal, pair, point, force, weight), pair, stiffness, dstiffness_dforce)
   end subroutine stick

end module litz_friction_forces
