!> The crossings of wires as the iteration sees them, and the set of all.
module litz_contact_points
   use litz_kinds, only: dp
   use litz_bent_wires, only: bends_t
   use litz_contact_history, only: contact_history_t, left_dents_t
   use litz_contact_bending, only: bends_seen_t
   use litz_contact_kinematics, only: contact_kinematics_t
   use litz_contact_turning, only: turning_t
   use litz_contact_side, only: crossing_t, crossing_of
   use litz_cut_lens, only: cut_lens_t
   use litz_element_library, only: elements_t
   use litz_friction_iteration, only: friction_iteration_t
   use litz_friction_law, only: friction_law_t
   use litz_hertz, only: hertz_ellipse_t
   use litz_lap_of_place, only: lap_of_place_t
   use litz_line_cell, only: line_cell_t
   use litz_line_law, only: line_wires_t
   use litz_line_places, only: line_places_t
   use litz_model, only: model_t, axis_hermite
   use litz_near_pairs, only: near_pairs_t
   use litz_normal_law, only: force_of_gap_t
   use litz_shared_conductors, only: shared_conductors_t
   use litz_state, only: contact_t
   use litz_wire_turning, only: wire_turning_t
   use litz_wires, only: wires_t
   use litz_yielding_place, only: yielding_place_t
   use litz_yielding_spot, only: yielding_state_t
   implicit none
   private
   public :: contact_point_t, contact_set_t, points_by_wire_t, points_by_place_t, leg_t, joint_parts_t
   public :: law_ok, law_parallel, law_bad_data, law_too_curved, law_compacts
   public :: pair_geometry, away_from, axis_of_pair, arc_at, crossing_at, clearance_of, add_taper, chain_by_wire, &
      chain_by_place, inherit, is_contact_of

   !> What has become of the laws of a contact: nothing; the axes are parallel, so that there is no Hertz ellipse; the
   !> data of the law are none for it; a wire is curved about the other so much that the foot of a line is hardly known;
   !> the spot of wires that yield is too large for their thickness
   integer, parameter :: law_ok = 0, law_parallel = 1, law_bad_data = 2, law_too_curved = 3, law_compacts = 4

   !> A stretch of a wire of a contact, up to its next round end or joint: one on which the contact is, or one that
   !> leads away from a joint near by.
   type :: leg_t
      !> 1: of the barred, 2: of the unbarred wire
      integer :: side = 0
      !> Element, and a place in it: of the contact, or of the joint
      integer :: element = 0
      real(dp) :: xi = 0
      !> Arc length along its wire there [m]
      real(dp) :: arc = 0
      !> The contact is on this stretch, or at its end
      logical :: at_contact = .false.
      !> From the joint on: slope [-] and curvature [1/m] of the distance to the other wire
      real(dp) :: tilt = 0, bend = 0
      !> Curvature as the law sees it, which takes a part of the tilt for a bend [1/m]
      real(dp) :: bend_of_law = 0
      !> Overlap at the joint [m]
      real(dp) :: overlap = 0
      !> Unit vectors along the axis of the element (3), and as the law sees it
      real(dp) :: along(3) = 0, direction(3) = 0
      !> What its cylinder has of the force, in parts of what a cylinder would have alone
      real(dp) :: part = 0
   end type leg_t

   !> What joints of two wires change of a contact by the geometry of an iterate.
   type :: joint_parts_t
      !> It is at a joint of either wire, or a joint cuts its overlap
      logical :: is_near = .false.
      !> Parts of the force, of what they would have alone: of cylinders and of round joints (barred, unbarred wire)
      real(dp) :: of_cylinder(2) = 1, of_end(2) = 0
      !> Mean angle of the legs with the other wire [rad]
      real(dp) :: angle = 0
      !> The legs of a wire are not of one material (2), and the means of these by what the legs have of the force:
      !> Young's modulus [Pa], Poisson's ratio and resistivity [ohm m] (2), of the sums of these parts (2)
      logical :: is_mixed(2) = .false.
      real(dp), dimension(2) :: young = 0, poisson = 0, resistivity = 0, sum_of_parts = 0
   end type joint_parts_t

   !> A crossing of two wires, open or closed: the contact that results show, and what the iteration needs besides.
   type, extends(contact_t) :: contact_point_t
      !> Its place among the candidates
      integer :: candidate = 0
      !> Point of the last converged state that it continues; 0: none
      integer :: predecessor = 0
      !> Arc lengths along the two wires [m]
      real(dp) :: arc_bar = 0, arc = 0
      type(contact_kinematics_t) :: kinematics
      !> Radii of both wires there (2) [m], and next to the ball of a joint how they change along the wires (2) [-] and
      !> how that does (2) [1/m]
      real(dp) :: radius(2) = 0, ball_slope(2) = 0, ball_bend(2) = 0
      !> On the barred, on the unbarred wire it is at a round end, or at the round joint of a kink
      logical :: held(2) = .false.
      !> Near the end of a wire: how that cuts its overlap, what the pairs of cylinders and round ends have of the
      !> force, in parts of what they would have alone (2, 2), and what stiffness is left: within an iteration all stay
      type(cut_lens_t) :: lens
      real(dp) :: force_part(2, 2) = 0, stiff_part = 1
      !> Places as litz_cut_lens has them (2) [m]; the energy is a function of them and of the overlap, its derivatives
      !> by them are forces along the wires (2) [N], which change with the overlap (2) [N/m] and the places (2, 2) [N/m]
      real(dp) :: place(2) = 0, slide_force(2) = 0, slide_by_overlap(2) = 0, slide_stiffness(2, 2) = 0
      !> Of the force and of its stiffness what that of uncut cylinders at the same overlap is multiplied by
      real(dp) :: cut = 1, cut_stiffness = 1
      !> It is held at a free end of the barred, of the unbarred wire, and not at a joint
      logical :: at_end(2) = .false.
      !> Tangents (3, 2): of the axis along xi where it moves along its wire, from a free end into the wire where it is
      !> held there
      real(dp) :: tangent(3, 2) = 0
      !> What joints change of it
      type(joint_parts_t) :: present_parts
      !> At an end or a joint, or near a joint: the stretches of both wires there
      type(leg_t), allocatable :: legs(:)
      !> Of a point of a line contact: what it has of the lap, and the length that it stood for when the shares were
      !> found, which friction sees [m]
      type(lap_of_place_t) :: lap
      real(dp) :: settled_weight = 0
      !> Where it is at an end or a joint: slope of the distance along the leg from there along which it grows least,
      !> not negative, and mean curvature (2) [-, 1/m]
      real(dp) :: tilt(2) = 0, bend(2) = 0
      !> The crossing of the same two wires that it was when the increment began
      type(crossing_t) :: start
      !> .false.: the axes are nearly parallel there, or touch along a line
      logical :: regular = .true.
      !> Share of the contact that this point carries, the rest of which is carried along the line; of a point of a line
      !> contact the length that it stands for [m]
      real(dp) :: weight = 1
      !> Of a point of a line contact: share of the contact that is carried along the line there
      real(dp) :: line_share = 0
      !> Angle that the law sees [rad], and its sine, which the curvature of the wires can make greater than 1: of the
      !> axes, or of straight wires whose lens of overlap is as long (litz_line_kinematics); what metal that yields
      !> held in the last converged state [J], and the angle of that [rad]
      real(dp) :: law_angle = 0, law_sine = 0, held_energy = 0, held_angle = 0
      !> Sine of straight wires whose lens of overlap is as long as that of this crossing, how much it counts beside the
      !> angle of the axes, and how much the section of the wires counts, both between 0 and 1
      real(dp) :: lens_sine = 0, lens_share = 0, section_share = 0
      !> q of both wires as this sine sees them, which stay within an iteration while the wires turn (2) [-]; 0 next to
      !> ends and joints, where the sine stays
      real(dp) :: lens_quality(2) = 0
      !> Near a node, where the curvature of the axes has a jump, the angle is that at these places of both elements as
      !> long as the contact is on them (barred, unbarred), with this share [-]: within an iteration they stay
      integer :: angle_element(2) = 0
      real(dp) :: fixed_share = 0, angle_at(2) = 0
      !> How the wires are bent as the law sees it, and how that changes along them: both stay within an iteration
      type(bends_t) :: bends
      type(bends_seen_t) :: bends_seen
      !> Energy over that of the present far field [-], and what the torque about the normal lacks as wires turn, over
      !> the sine of their angle: as a crossing, as places, and of places in its dent (litz_lens_growth) [N m]
      real(dp) :: energy_ratio = 1, lacking_torque = 0, lacking_torque_of_places = 0, torque_of_dents = 0
      !> How far the wires overlap on beyond its lens, between 0 and 1: ripples of long overlaps look like short ones
      real(dp) :: long_share = 0
      !> How much the section counts in what it conducts, that of its largest lens if spots are remembered; and the
      !> deepest overlap of that lens [m], of a point of a line contact that of the crossing in whose lens it lies
      real(dp) :: spot_section = 0, kept_overlap = 0
      !> Where a spot is remembered: force of the whole contact, and that if no wire ended there, of a place per length
      real(dp) :: whole_force = 0, uncut_force = 0
      !> Overlap at which these shares were found [m]; 0: nothing overlapped. While it grows little they stay
      real(dp) :: shared_overlap = 0
      !> Of a point of a line contact: it lies in the lens of a crossing; its foot is held at the end of a wire; of it
      !> and of a crossing: its lens has yielded
      logical :: in_lens = .false., foot_at_end = .false., lens_has_dent = .false.
      !> Point of a line contact: its place on the unbarred wire, see litz_line_places; 0: the wires cross here
      integer :: line_place = 0
      !> Of a point of a line contact between conductors: the part of the wire for which it stands, and whether the
      !> wires touch anywhere in it
      type(line_cell_t) :: cell
      logical :: cell_touches = .false.
      !> Normal in the last converged state (3); 0: none
      real(dp) :: normal_before(3) = 0
      !> Law per length at the present angle, of a point of a line contact
      type(line_wires_t) :: line
      !> Hertz ellipse at the present angle, where a law needs it
      type(hertz_ellipse_t) :: ellipse
      !> The last iteration predicted the gap and the force of this point [m, N]
      logical :: predicted = .false.
      real(dp) :: predicted_gap = 0, mixed_force = 0
      !> Overlap of the reference configuration that an interference fit resolves here [m], in the gap as far as left
      real(dp) :: fit = 0
      !> Overlap beyond which wires that have yielded touch in their dent [m]; what this increment has dissipated by
      !> yielding, and by shares [J]; and what the contact of wires that yield is now: all 0 where there is no force
      real(dp) :: dent_depth = 0, yielded = 0, settled = 0
      type(yielding_state_t), allocatable :: yielding
      !> Force whose dent wires that yield feel at the present angle: of a crossing [N], of a place per length [N/m]
      real(dp) :: felt_force = 0
      !> Deepest overlap that a crossing of wires that yield has had, as far as its dent tells [m]; of a place in its
      !> lens the same, and how much deeper the lens is than the place [m]
      real(dp) :: deepest = 0, lens_depth = 0
      !> Force of wires that yield, whatever its share: of a crossing [N], of a point of a line per length [N/m]
      real(dp) :: yielding_force = 0
      !> Law per length of wires that yield, of a point of a line contact
      type(yielding_place_t), allocatable :: yielding_place
      !> Which of the dents of earlier contacts it has found again; 0: none
      integer :: found_dent = 0
      !> In contact as the iteration takes it (prediction) and as it is
      logical :: active = .false., closed = .false.
      !> Law at the present gap, and the force that this iteration linearises about [N]
      type(force_of_gap_t) :: at_gap
      real(dp) :: iteration_force = 0
      !> Law of a crossing at the overlap with the mixed force, where it depends on the angle; how this iteration
      !> depends on the angle of the axes; and the torques about the normal, of the law at the present gap and as this
      !> iteration supposes it [N m]
      type(force_of_gap_t) :: at_mixed
      type(turning_t) :: turning
      real(dp) :: torque = 0, iteration_torque = 0
      !> A law or what it builds on has failed here: one of `law_...`
      integer :: law_status = law_ok
      !> Force of the geometric stiffness [N]; zero at first touch, where no force is known yet
      real(dp) :: geometric_force = 0
      !> Memory of the converged state: from when the increment began until it has converged
      type(contact_history_t) :: history
      !> It was at an end or a kink then and is no longer, or the other way round; and the friction of then, as the
      !> barred wire felt it (3) [N]
      logical :: has_changed_kind = .false.
      real(dp) :: traction_before(3) = 0
      !> It has left the spot of its largest force: by slip, or without friction by moving
      logical :: new_spot = .false.
      !> How the gap, and where that stays the force, change with the temperatures of its nodes (4) [m/K, N/K], where
      !> these are in the same Newton step as the motions
      real(dp) :: dgap_dtemperature(4) = 0, dforce_dtemperature(4) = 0
      !> Traction at the present place
      type(friction_law_t) :: friction
      !> How its dissipation in this increment changes with the normal force [m] and, of one that presses with friction,
      !> with the motions of the nodes (24) [N, N m]
      real(dp) :: dfriction_work_dforce = 0
      real(dp), allocatable :: dfriction_work(:)
      !> What ploughing has dissipated in this increment [J], and its part of the limit of friction in the next one [-]
      real(dp) :: ploughed = 0, ploughing = 0
      !> Of a contact that presses with friction, or has in this increment
      type(friction_iteration_t), allocatable :: friction_iteration
      !> rho L0/(4 A) of both elements, 0 where the voltage is not corrected [ohm], and heat in them that the linear
      !> voltage misses [W] (theory section 7)
      real(dp) :: series_resistance(2) = 0, heat_inside(2) = 0
      !> Resistance of the constriction in one wire over its resistivity [1/m]; 0: none is known
      real(dp) :: constriction(2) = 0
      !> How the conductance of the spot changes with the gap [S/m], how much it would grow with ln(F) [S], and, of one
      !> that conducts, how it changes with the motions of its nodes (24) [S/m, S/rad]
      real(dp) :: dconductance_dgap = 0, dconductance_dln_force = 0
      real(dp), allocatable :: dconductance(:)
      !> What it has more heat than it would have if its strip were the only one on its wires [W]
      real(dp) :: heat_of_others = 0
   end type contact_point_t

   type :: contact_set_t
      logical :: present = .false.
      !> Element belongs to the barred / the unbarred set of each contact pair (n_elements, n_pairs)
      logical, allocatable :: in_bar(:, :), in_set(:, :)
      !> The same of wires, with any of their elements (n_wires, n_pairs)
      logical, allocatable :: wire_in_bar(:, :), wire_in_set(:, :)
      !> Elements of any contact pair
      integer, allocatable :: members(:)
      !> Barred element, unbarred element, contact pair (3, n_candidates); sorted by the smaller, then the larger one
      integer, allocatable :: candidates(:, :)
      !> Candidates whose nodes the pattern of the matrix couples (n_candidates)
      logical, allocatable :: coupled(:)
      !> Pairs that would be candidates, but are joined (3, n_joined)
      integer, allocatable :: joined(:, :)
      !> Positions of the nodes when the candidates were collected (3, n_nodes)
      real(dp), allocatable :: x_collected(:, :)
      !> Candidates hold while no node has moved by this much since they were collected (n_nodes) [m], and no axis
      !> leaves its chord by more than this (n_elements) [m]
      real(dp), allocatable :: valid_motion(:), valid_sagitta(:)
      !> How the wires turn when the increment began, and at most of then and now
      type(wire_turning_t) :: turning_at_start, turning
      !> Elements with several contacts that carry a current
      type(shared_conductors_t) :: shared
      !> Largest overlap when the increment began [m]
      real(dp) :: depth = 0
      !> The points now, and those of the last converged state
      type(contact_point_t), allocatable :: points(:), converged(:)
      !> Which candidates have points of line contacts, and how far apart the others are
      type(near_pairs_t) :: near
      !> Where lines are touched, and the points of line contacts now and in the last converged state
      type(line_places_t) :: places
      type(contact_point_t), allocatable :: line_points(:), converged_line_points(:)
      integer :: last_id = 0
      type(left_dents_t) :: left_dents
      !> How often shares have been renewed in this increment: of line contacts where forces balanced, and all before
      integer :: n_settled = 0, n_anticipated = 0
      !> They have changed by little, which counts from the next increment on
      logical :: shares_wait = .false.
      !> Largest overlap of the reference configuration that an interference fit resolves, one per contact pair [m];
      !> 0: the pair is none
      real(dp), allocatable :: overlap(:)
      !> Clearance that stands for the interference left at this time, one per contact pair [m]
      real(dp), allocatable :: clearance(:)
      !> The same in the last converged state
      real(dp), allocatable :: converged_clearance(:)
   end type contact_set_t

   !> The points of each barred wire, as chains in their order.
   type :: points_by_wire_t
      !> First point of each wire (n_wires), and the next one of each point (n_points); 0: none
      integer, allocatable :: first(:), next(:)
   end type points_by_wire_t

   !> The points of line contacts of each place, as chains.
   type :: points_by_place_t
      !> Last point of each place (n_places), and the one before each point (n_points); 0: none
      integer, allocatable :: last(:), before(:)
   end type points_by_place_t

contains

   !> Nodal positions and tangents, barred element first, as the kernels want them.
   pure subroutine pair_geometry(model, wires, elements, eb, e, x, rotation, xe, t, length)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Barred and unbarred element
      integer, intent(in) :: eb, e
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      !> Nodal positions [m] and unit tangents of the axes there (3, 4), reference lengths of the elements (2) [m]
      real(dp), intent(out) :: xe(3, 4), t(3, 4), length(2)
      integer :: side

      do side = 1, 2
         associate (node_bar => model%connectivity(side, eb), node => model%connectivity(side, e))
            xe(:, side) = x(:, node_bar)
            xe(:, 2 + side) = x(:, node)
            t(:, side) = matmul(rotation(:, :, node_bar), wires%contact_tangents0(:, side, eb))
            t(:, 2 + side) = matmul(rotation(:, :, node), wires%contact_tangents0(:, side, e))
         end associate
      end do
      length = elements%length([eb, e])
   end subroutine pair_geometry

   !> Unit tangent of the axis of an element that leads away from one of its nodes (3).
   pure function away_from(model, wires, axis, e, side, x, rotation) result(away)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      !> `axis_linear` or `axis_hermite`, element, and its first or second node
      integer, intent(in) :: axis, e, side
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      real(dp) :: away(3)

      associate (node => model%connectivity(side, e), other => model%connectivity(3 - side, e))
         if (axis == axis_hermite) then
            away = (3 - 2*side)*matmul(rotation(:, :, node), wires%contact_tangents0(:, side, e))
         else
            away = x(:, other) - x(:, node)
            away = away/norm2(away)
         end if
      end associate
   end function away_from

   !> Clearance that stands for what is left of the fit of a crossing [m].
   elemental real(dp) function clearance_of(fit, left)
      !> Overlap that the fit resolves at the crossing, and what is left at this time of the largest one of the pair [m]
      real(dp), intent(in) :: fit, left

      clearance_of = min(fit, left)
   end function clearance_of

   !> Radii that change along the elements: the gap is that of the radii at its places. Source: theory section 14.
   pure subroutine add_taper(taper, kinematics)
      !> Of the barred and the unbarred element (2) [m]
      real(dp), intent(in) :: taper(2)
      type(contact_kinematics_t), intent(inout) :: kinematics

      if (.not. any(abs(taper) > 0)) return
      kinematics%gap = kinematics%gap - taper(1)*kinematics%xi_bar - taper(2)*kinematics%xi
      kinematics%dgap = kinematics%dgap - taper(1)*kinematics%rows%dxi_bar - taper(2)*kinematics%rows%dxi
   end subroutine add_taper

   !> Which axis the law of a contact pair sees: one of the constants of the model.
   pure integer function axis_of_pair(model, pair) result(axis)
      type(model_t), intent(in) :: model
      !> Contact pair
      integer, intent(in) :: pair

      axis = model%interactions(model%contact_pairs(pair)%interaction)%axis
   end function axis_of_pair

   !> Arc length along its wire of a place in an element [m].
   elemental real(dp) function arc_at(wires, elements, e, xi) result(arc)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Element
      integer, intent(in) :: e
      !> Place in [-1, 1]
      real(dp), intent(in) :: xi

      arc = wires%arc(e) + wires%direction(e)*xi*elements%length(e)/2
   end function arc_at

   !> The crossing that a point is, as it would be with both elements along their wires.
   pure type(crossing_t) function crossing_at(wires, point) result(crossing)
      type(wires_t), intent(in) :: wires
      type(contact_point_t), intent(in) :: point

      crossing = crossing_of(point%kinematics, wires%direction([point%element_bar, point%element]), &
         [point%arc_bar, point%arc], any(point%held))
   end function crossing_at

   !> What a point takes over: predictions of the last iterate, identity and memory of the last converged state.
   pure subroutine inherit(old, from, converged, from_converged, point)
      !> Points of the last iterate, and of the last converged state
      type(contact_point_t), intent(in) :: old(:), converged(:)
      !> Those that the point continues; 0: none
      integer, intent(in) :: from, from_converged
      type(contact_point_t), intent(inout) :: point

      if (from > 0) then
         point%predicted = old(from)%predicted
         point%predicted_gap = old(from)%predicted_gap
         point%mixed_force = old(from)%mixed_force
         if (allocated(old(from)%friction_iteration)) then
            if (all(old(from)%held .eqv. point%held)) point%friction_iteration = old(from)%friction_iteration
         end if
         call take_shares(old(from), point)
      else if (from_converged > 0) then
         call take_shares(converged(from_converged), point)
      end if
      if (from_converged > 0) then
         point%id = converged(from_converged)%id
         point%history = converged(from_converged)%history
         point%fit = converged(from_converged)%fit
         point%normal_before = converged(from_converged)%kinematics%normal
         point%has_changed_kind = any(converged(from_converged)%held .neqv. point%held)
         point%traction_before = converged(from_converged)%traction
      end if
   end subroutine inherit

   !> What it carries of the contact, and by which law, stay what they were.
   pure subroutine take_shares(earlier, point)
      type(contact_point_t), intent(in) :: earlier
      type(contact_point_t), intent(inout) :: point

      point%shared_overlap = earlier%shared_overlap
      point%long_share = earlier%long_share
      point%weight = earlier%weight
      point%line_share = earlier%line_share
      point%cell%reach = earlier%cell%reach
      point%section_share = earlier%section_share
      point%in_lens = earlier%in_lens
      point%lens_has_dent = earlier%lens_has_dent
      point%spot_section = earlier%spot_section
      point%kept_overlap = earlier%kept_overlap
      point%deepest = earlier%deepest
      point%lens_depth = earlier%lens_depth
      point%lens_share = earlier%lens_share
      point%lens_sine = earlier%lens_sine
      point%lens_quality = earlier%lens_quality
      point%angle_element = earlier%angle_element
      point%fixed_share = earlier%fixed_share
      point%angle_at = earlier%angle_at
      point%bends = earlier%bends
      point%bends_seen = earlier%bends_seen
      point%energy_ratio = earlier%energy_ratio
      point%lacking_torque = earlier%lacking_torque
      point%lacking_torque_of_places = earlier%lacking_torque_of_places
      point%torque_of_dents = earlier%torque_of_dents
      point%law_angle = earlier%law_angle
      point%law_sine = earlier%law_sine
      point%lens = earlier%lens
      point%force_part = earlier%force_part
      point%stiff_part = earlier%stiff_part
      point%cut = earlier%cut
      point%cut_stiffness = earlier%cut_stiffness
      point%place = earlier%place
      point%lap = earlier%lap
      point%settled_weight = earlier%settled_weight
      if (earlier%law_status == law_too_curved) point%law_status = law_too_curved
   end subroutine take_shares

   !> The contact is on both of these legs: the first one of the barred, the second one of the unbarred wire.
   elemental logical function is_contact_of(leg_bar, leg)
      type(leg_t), intent(in) :: leg_bar, leg

      is_contact_of = leg_bar%at_contact .and. leg%at_contact .and. leg_bar%side == 1 .and. leg%side == 2
   end function is_contact_of

   !> Put points into chains, one for each barred wire.
   pure type(points_by_wire_t) function chain_by_wire(wires, points) result(by_wire)
      type(wires_t), intent(in) :: wires
      type(contact_point_t), intent(in) :: points(:)
      integer :: k

      allocate (by_wire%first(wires%n_wires), by_wire%next(size(points)), source=0)
      do k = size(points), 1, -1
         associate (head => by_wire%first(wires%wire(points(k)%element_bar)))
            by_wire%next(k) = head
            head = k
         end associate
      end do
   end function chain_by_wire

   !> Put points of line contacts into chains, one for each place.
   pure type(points_by_place_t) function chain_by_place(n_places, points) result(by_place)
      !> Places on all wires
      integer, intent(in) :: n_places
      type(contact_point_t), intent(in) :: points(:)
      integer :: k

      allocate (by_place%last(n_places), by_place%before(size(points)), source=0)
      do k = 1, size(points)
         by_place%before(k) = by_place%last(points(k)%line_place)
         by_place%last(points(k)%line_place) = k
      end do
   end function chain_by_place

end module litz_contact_points
