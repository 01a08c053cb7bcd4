!> Friction of one contact: stiffness of the stick, and the kernel with the memory of the contact.
module litz_friction_forces
   use litz_kinds, only: dp
   use litz_contact_kinematics, only: n_motions
   use litz_contact_points, only: contact_point_t
   use litz_friction_iteration, only: forget_friction, place_touch
   use litz_friction_law, only: friction_law_t, friction_start_t, friction_law, friction_none, friction_stick, &
      friction_slip
   use litz_law_input, only: wire_pair_t
   use litz_model, only: model_t, interaction_t
   use litz_normal_forces, only: law_of_spot
   use litz_normal_law, only: force_of_gap_t
   use litz_overlap_of_force, only: overlap_of_point
   use litz_ploughing, only: coefficient_of_friction, split_dissipation
   use litz_rotation_forms, only: spin_to_hessian
   use litz_stick_laws, only: stick_stiffness_at
   use litz_wire_friction, only: wire_slip_t, wire_slip, side_at, wire_friction_residual, wire_friction_tangent
   use litz_wires, only: wires_t, arc_from_to
   implicit none
   private
   public :: find_friction, clear_friction, increment_start_t

   !> The two elements of a contact when the increment began, and what has happened since.
   type :: increment_start_t
      !> Displacements and rotations of the four nodes since (24) [m, rad], and what the clearance of an interference
      !> has closed the gap by [m]
      real(dp) :: dq(n_motions) = 0, closing = 0
      !> The load goes on as in the increment before: not the first increment of a step
      logical :: goes_on = .false.
      !> Nodal positions [m] and unit tangents (3, 4) of then, and the rotations of the nodes since (3, 3, 4)
      real(dp) :: x(3, 4) = 0, t(3, 4) = 0, turned(3, 3, 4) = 0
   end type increment_start_t

   !> Wires that cross at an angle with a smaller cosine (127 degrees) all but run against each other: the sum of their
   !> tangents may vanish, and the difference is taken
   real(dp), parameter :: least_cosine = -0.6_dp

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
      type(wire_slip_t) :: slip
      type(friction_law_t) :: supposed
      type(friction_start_t) :: start
      type(force_of_gap_t) :: at_gap
      real(dp) :: mu, force, dforce(n_motions), stiffness, dstiffness_dforce, r_supposed(n_motions)

      if (.not. allocated(point%friction_iteration)) allocate (point%friction_iteration)
      mu = coefficient_of_friction(law, point)
      if (.not. (point%history%closed .or. point%friction_iteration%touched)) then
         call find_touch(law%axis, wires, length, pair%radius, before, point)
      end if
      point%friction_iteration%reverses = reverses(wires, point)
      slip = slip_since(law%axis, wires, x, t, length, pair%radius, before, point)
      start = start_of_friction(law, pair, point)
      ! what sticks keeps its force, whatever its components
      if (point%has_changed_kind) start%traction = -matmul(point%traction_before, slip%frame)
      k = 0
      r = 0
      if (point%closed) then
         call stick(law, pair, point%force, settled_weight(point), point, stiffness, dstiffness_dforce)
         point%friction = friction_law(mu, point%force, stiffness, dstiffness_dforce, start, slip%slip)
         point%traction = -matmul(slip%frame, point%friction%traction)
         r = wire_friction_residual(slip, point%friction%traction)
         if (.not. point%history%closed) call grow_with_force(dot_product(r, before%dq), point%friction)
         call split_dissipation(law, point)
         at_gap = law_of_spot(law%normal, point)
         point%dfriction_work_dforce = law%friction/mu*point%friction%ddissipation_dforce
         point%dfriction_work = law%friction/mu*matmul(slip%dslip, point%friction%ddissipation_dslip) &
            + point%dfriction_work_dforce*(dforce_sliding + at_gap%dforce_dgap*point%kinematics%dgap)
      end if

      associate (iteration => point%friction_iteration)
         force = merge(point%iteration_force, 0.0_dp, point%active)
         if (.not. force > 0) then
            call forget_friction(iteration)
            iteration%difference = -r
            return
         end if
         if (iteration%status == friction_none) call suppose(before%goes_on, start%traction, point)
         dforce = dforce_sliding - point%stiffness*point%kinematics%dgap
         call stick(law, pair, force, settled_weight(point), point, stiffness, dstiffness_dforce)
         supposed = friction_law(mu, force, stiffness, dstiffness_dforce, start, slip%slip, iteration%status, &
            iteration%mixed_traction)
         r_supposed = wire_friction_residual(slip, supposed%traction)
         k = wire_friction_tangent(point%kinematics, slip, slip%dslip, t, supposed, dforce, iteration%mixed_traction)
         call spin_to_hessian(k, r_supposed, [4, 10, 16, 22])
         iteration%difference = r_supposed - r
         iteration%trial = supposed%trial
         iteration%dtrial = stiffness*slip%dslip
         iteration%limit = mu*force
         iteration%dlimit = mu*dforce
         iteration%along = wire_friction_residual(slip, supposed%dtraction_dforce)/mu
      end associate
   end subroutine find_friction

   !> What the iteration supposes of a contact at first: one that was closed before goes on to slip or to stick, and
   !> sticks where a step begins, since there a motion is likely to turn back; a slip that turns back all the same is
   !> found by the first iteration. One that was open does what it would do here: a stick far beyond the limit would
   !> throw open again a contact that closes with a small force. A slip of it expects no traction yet: its tangent is
   !> the secant from there.
   pure subroutine suppose(goes_on, traction_before, point)
      !> As in `increment_start_t`
      logical, intent(in) :: goes_on
      !> When the increment began (2) [N]
      real(dp), intent(in) :: traction_before(2)
      type(contact_point_t), intent(inout) :: point

      associate (iteration => point%friction_iteration)
         iteration%status = friction_stick
         if (point%predicted .or. .not. point%history%closed) then
            if (point%closed) iteration%status = point%friction%status
         else
            if (goes_on .and. point%history%slips) iteration%status = friction_slip
            iteration%mixed_traction = traction_before
         end if
      end associate
   end subroutine suppose

   !> Slip since the increment began, or the part of it since the contact has closed.
   pure type(wire_slip_t) function slip_since(axis, wires, x, t, length, radius, before, point) result(slip)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      type(wires_t), intent(in) :: wires
      !> As in `find_friction`, and radii (2) [m]
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2), radius(2)
      type(increment_start_t), intent(in) :: before
      type(contact_point_t), intent(in) :: point
      real(dp) :: arc(2), normal(3), part

      if (point%history%closed) then
         arc = point%history%arc
         normal = point%normal_before
         part = 1
      else
         arc = point%friction_iteration%arc_before
         normal = point%friction_iteration%normal_before
         part = point%friction_iteration%part
      end if
      associate (elements => [point%element_bar, point%element])
         slip = wire_slip(point%kinematics, x, t, length, axis, radius, directions(wires, point), before%turned, &
            normal, wires%direction(elements)*arc_from_to(arc, [point%arc_bar, point%arc], &
            wires%circumference(wires%wire(elements))))
      end associate
      slip%slip = part*slip%slip
      slip%dslip = part*slip%dslip
   end function slip_since

   !> Parts of the two tangents in the first direction of the slip (2): of the wire with the place along lines, else of
   !> both wires, so that neither comes first. They run along the wires, so that the memory holds where the contact goes
   !> on in the next elements.
   pure function directions(wires, point)
      type(wires_t), intent(in) :: wires
      type(contact_point_t), intent(in) :: point
      real(dp) :: directions(2)

      directions = [0, 1]
      if (point%line_place > 0) return
      directions = wires%direction([point%element_bar, point%element])
      if (point%friction_iteration%reverses) directions(1) = -directions(1)
   end function directions

   !> The first direction of the slip is between the one wire and the reverse of the other, for as long as the contact
   !> is closed.
   pure logical function reverses(wires, point)
      type(wires_t), intent(in) :: wires
      type(contact_point_t), intent(in) :: point

      reverses = point%history%reverses
      if (.not. point%history%closed) reverses = product(wires%direction([point%element_bar, point%element])) &
         *point%kinematics%cos_angle < least_cosine
   end function reverses

   !> Where the places of a contact were when the increment began in which it closes, and how much of the increment
   !> follows the touch, for a motion in proportion.
   pure subroutine find_touch(axis, wires, length, radius, before, point)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      type(wires_t), intent(in) :: wires
      !> Reference lengths and radii (2) [m]
      real(dp), intent(in) :: length(2), radius(2)
      type(increment_start_t), intent(in) :: before
      type(contact_point_t), intent(inout) :: point
      real(dp) :: gap, move(2), distance, normal(3), surfaces

      gap = point%gap
      if (point%predicted) gap = min(gap, point%predicted_gap)
      associate (kinematics => point%kinematics)
         surfaces = sum(radius) - (point%gap - kinematics%gap + before%closing)
         move = [dot_product(kinematics%rows%dxi_bar, before%dq), dot_product(kinematics%rows%dxi, before%dq)]
         call side_at(before%x, before%t, length, axis, [point%xi_bar, point%xi] - move, moves_along(point), &
            kinematics%side, normal, distance)
         call place_touch(distance - surfaces, gap, [point%arc_bar, point%arc] &
            - wires%direction([point%element_bar, point%element])*length/2*move, normal, point%friction_iteration)
      end associate
   end subroutine find_touch

   !> The place moves along the wire, and the normal is perpendicular to its axis (2).
   pure function moves_along(point)
      type(contact_point_t), intent(in) :: point
      logical :: moves_along(2)

      moves_along = .not. point%held
      if (point%line_place > 0) moves_along = [.true., .false.]
   end function moves_along

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

      call stick_stiffness_at(law%stick_law, law%stick_value, coefficient_of_friction(law, point), force, &
         overlap_of_point(law%normal, pair, point, force, weight), pair, stiffness, dstiffness_dforce)
   end subroutine stick

   !> What an iteration supposes of friction ends with the contact, and where it comes to a pair without friction.
   pure subroutine clear_friction(model, points)
      type(model_t), intent(in) :: model
      type(contact_point_t), intent(inout) :: points(:)
      integer :: i

      do i = 1, size(points)
         associate (point => points(i), law => model%interactions(model%contact_pairs(points(i)%pair)%interaction))
            if (allocated(point%friction_iteration) .and. .not. ((point%active .or. point%closed) .and. &
               coefficient_of_friction(law, point) > 0)) call forget_friction(point%friction_iteration)
            point%friction = friction_law_t()
            point%traction = 0
         end associate
      end do
   end subroutine clear_friction

end module litz_friction_forces
