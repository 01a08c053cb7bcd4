!> The electric-mechanical beam-to-beam contact element as a user element: nodal positions, tangents and voltages in,
!> the 28x28 tangent and the residual out.
!>
!> Source: the paper, "FE discretisation". Unknowns in its order `{ub (12), u (12), Vb (2), V (2)}`, each node
!> `ux uy uz phix phiy phiz`, and its block structure `K = [K_mm 0; K_me K_ee]`, `R = [R_m; R_e]`. Residual: internal
!> minus external forces [N], moments [N m] and currents leaving the nodes [A]; Newton solves `K dq = -R`.
!>
!> The steps, each its own kernel: closest points, kinematics, force, spot, and the blocks that these make. Where a wire
!> touches with its round end, or at a kink, the place on it is its node, and the law is that of a hemisphere.
module litz_contact_em
   use litz_axis_choices, only: axis_hermite
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok
   use litz_dent_spot, only: spot_of_state
   use litz_kinds, only: dp, pi
   use litz_law_input, only: earlier_dent_t, wire_pair_t
   use litz_normal_law, only: normal_law_t, force_of_gap_t, force_at_gap
   use litz_normal_yielding, only: dent_of_wires, state_of_wires
   use litz_spot_law, only: spot_law_t, contact_spot_t, contact_spot, spot_ok, spot_bad_data
   use litz_axis, only: axis_shape, axis_polynomial
   use litz_closest_points, only: closest_points, closest_inside, closest_beyond, closest_parallel, closest_not_unique
   use litz_contact_kinematics, only: contact_kinematics_t, contact_kinematics, kinematics_ok, kinematics_parallel
   use litz_end_kinematics, only: end_kinematics
   use litz_line_foot, only: line_foot, foot_inside, foot_beyond
   use litz_contact_blocks, only: contact_blocks, residual_blocks, contact_force_t, spot_in_circuit_t
   use litz_contact_electricity, only: contact_electricity_t
   use litz_contact_mechanics, only: form_spin
   use litz_contact_turning, only: contact_turning, turning_residual, turning_t
   use litz_rotation_forms, only: spin_to_rotation_vectors, residual_to_rotation_vectors
   use litz_yielding_spot, only: dent_t, yielding_state_t, widest_spot
   implicit none
   private
   public :: contact_em, contact_em_residual, contact_em_t, wire_pair_t, contact_laws_t
   public :: contact_active, contact_open, contact_beyond, contact_parallel, contact_not_unique, &
      contact_not_converged, contact_unknown_law, contact_bad_data, contact_compacts

   !> The wires touch
   integer, parameter :: contact_active = 0
   !> The wires do not touch: `k` and `r` are zero
   integer, parameter :: contact_open = 1
   !> The closest points lie beyond an end of an element: `k` and `r` are zero
   integer, parameter :: contact_beyond = 2
   !> Failures; `k` and `r` are zero. Wires that overlap and are parallel there
   integer, parameter :: contact_parallel = -1
   !> Wires that overlap, with two closest pairs of points or a whole line of them
   integer, parameter :: contact_not_unique = -2
   !> The closest points were not found: coincident nodes, or numbers that are not finite
   integer, parameter :: contact_not_converged = -3
   integer, parameter :: contact_unknown_law = -4
   !> A length, radius, Young's modulus or resistivity that is not positive, or a table that does not ascend
   integer, parameter :: contact_bad_data = -5
   !> The spot of wires that yield is too large for their thickness
   integer, parameter :: contact_compacts = -6

   !> How the wires act on each other.
   type :: contact_laws_t
      !> `axis_linear` or `axis_hermite`
      integer :: axis = axis_hermite
      !> The end, -1 or 1, with which the barred, the unbarred wire touches (2); 0: with its side
      integer :: ends(2) = 0
      !> See litz_normal_laws; of wires that yield, the largest force of their dent [N], and whether a spot that opens
      !> is conducting metal as wide as that force has made it
      type(normal_law_t) :: normal
      real(dp) :: dent_force = 0
      logical :: keeps_spot = .false.
      !> See litz_spot_laws; left as it is: no current
      type(spot_law_t) :: spot
   end type contact_laws_t

   !> What is known of the contact besides `k` and `r`; zero where it is not active, except the places and the gap.
   type :: contact_em_t
      !> Places in the barred and the unbarred element
      real(dp) :: xi_bar = 0, xi = 0
      !> Gap between the surfaces [m], negative in contact
      real(dp) :: gap = 0
      !> Unit normal from the unbarred to the barred axis (until they pass each other)
      real(dp) :: normal(3) = 0
      !> Angle between the tangents [rad]
      real(dp) :: angle = 0
      !> +1 or -1: the orientation to be remembered, see contact_kinematics
      integer :: side = 0
      !> Contact force [N], pushing the wires apart, and elastic energy of the normal law [J]
      real(dp) :: force = 0, energy = 0
      !> Of wires that yield: largest force so far, this one included [N], and overlap at which they part [m]
      real(dp) :: largest_force = 0, dent = 0
      !> Semi-axes of the spot [m]
      real(dp) :: semi_major = 0, semi_minor = 0
      !> Resistance of the spot [ohm] (0: no electric contact), current from barred to unbarred [A], voltage across the
      !> spot [V]
      real(dp) :: resistance = 0, current = 0, voltage_gap = 0
      type(contact_kinematics_t) :: kinematics
      type(contact_electricity_t) :: electricity
   end type contact_em_t

   !> What the force and the spot of a contact do.
   type :: acting_t
      type(contact_force_t) :: force
      type(contact_spot_t) :: spot
      !> The energy depends on the angle: there is a torque
      logical :: turns = .false.
      type(turning_t) :: turning
   end type acting_t

   !> First rotation of each node among the unknowns
   integer, parameter :: rotations(4) = [4, 10, 16, 22]

contains

   !> Tangent and residual of one pair of elements.
   pure subroutine contact_em(x, t, length, v, wires, laws, side, k, r, contact, info, rotation_vectors)
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> Nodal voltages (4) [V]
      real(dp), intent(in) :: v(4)
      type(wire_pair_t), intent(in) :: wires
      type(contact_laws_t), intent(in) :: laws
      !> Remembered orientation +1 or -1, or 0, see contact_kinematics
      integer, intent(in) :: side
      !> Tangent (28, 28) and residual (28); rotations are spins
      real(dp), intent(out) :: k(28, 28), r(28)
      type(contact_em_t), intent(out) :: contact
      !> One of the constants above
      integer, intent(out) :: info
      !> Rotation vectors of the nodes (3, 4) [rad], when rotations are additive changes of these instead
      real(dp), intent(in), optional :: rotation_vectors(3, 4)
      type(acting_t) :: acting
      real(dp) :: k_mm(24, 24), r_m(24), k_me(4, 24), k_ee(4, 4), r_e(4), k_turning(24, 24), r_turning(24)

      k = 0
      r = 0
      call find_what_acts(x, t, length, wires, laws, side, contact, acting, info)
      if (info /= contact_active) return

      call contact_blocks(contact%kinematics, t, v, acting%force, &
         spot_in_circuit_t(acting%spot, series_resistance=wires%series_resistance), form_spin, k_mm, r_m, k_me, k_ee, &
         r_e, contact%electricity)
      if (acting%turns) then
         call contact_turning(contact%kinematics, x, t, length, laws%axis, acting%turning, form_spin, k_turning, &
            r_turning)
         k_mm = k_mm + k_turning
         r_m = r_m + r_turning
      end if
      k(1:24, 1:24) = k_mm
      k(25:28, 1:24) = k_me
      k(25:28, 25:28) = k_ee
      r = [r_m, r_e]
      if (present(rotation_vectors)) call spin_to_rotation_vectors(k, r, rotation_vectors, rotations)
      call describe_current(acting%spot, contact)
   end subroutine contact_em

   !> The residual alone, to the last bit that of `contact_em`.
   pure subroutine contact_em_residual(x, t, length, v, wires, laws, side, r, contact, info, rotation_vectors)
      !> As of `contact_em`
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2), v(4)
      type(wire_pair_t), intent(in) :: wires
      type(contact_laws_t), intent(in) :: laws
      !> Remembered orientation +1 or -1, or 0, see contact_kinematics
      integer, intent(in) :: side
      !> Residual (28)
      real(dp), intent(out) :: r(28)
      type(contact_em_t), intent(out) :: contact
      !> One of the constants above
      integer, intent(out) :: info
      !> As of `contact_em`
      real(dp), intent(in), optional :: rotation_vectors(3, 4)
      type(acting_t) :: acting
      real(dp) :: r_m(24), r_e(4)

      r = 0
      call find_what_acts(x, t, length, wires, laws, side, contact, acting, info)
      if (info /= contact_active) return
      call residual_blocks(contact%kinematics, v, acting%force, &
         spot_in_circuit_t(acting%spot, series_resistance=wires%series_resistance), r_m, r_e, contact%electricity)
      if (acting%turns) r_m = r_m + turning_residual(contact%kinematics, acting%turning)
      r = [r_m, r_e]
      if (present(rotation_vectors)) call residual_to_rotation_vectors(r, rotation_vectors, rotations)
      call describe_current(acting%spot, contact)
   end subroutine contact_em_residual

   !> The points that touch, the force between them, and the spot that it makes.
   pure subroutine find_what_acts(x, t, length, wires, laws, side, contact, acting, info)
      !> As of `contact_em`
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      type(wire_pair_t), intent(in) :: wires
      type(contact_laws_t), intent(in) :: laws
      !> Remembered orientation +1 or -1, or 0, see contact_kinematics
      integer, intent(in) :: side
      type(contact_em_t), intent(out) :: contact
      type(acting_t), intent(out) :: acting
      !> One of the constants above
      integer, intent(out) :: info
      type(hertz_ellipse_t) :: ellipse
      type(force_of_gap_t) :: normal, of_spot
      integer :: law_info
      logical :: is_round(2)

      info = contact_bad_data
      if (.not. (all(length > 0) .and. all(wires%radius > 0))) return
      is_round = laws%ends /= 0
      if (any(is_round)) then
         call find_contact_at_ends(x, t, length, laws%axis, wires%radius, laws%ends, contact, info)
      else
         call find_contact(x, t, length, laws%axis, wires%radius, side, contact, info)
      end if
      if (info /= contact_active) return

      ! the force ...
      if (laws%normal%uses_ellipse .or. laws%spot%uses_ellipse) then
         info = contact_bad_data
         if (.not. all(wires%young > 0)) return
         if (any(is_round)) then
            call hertz_ellipse(wires%radius, wires%young, wires%poisson, contact%angle, ellipse, law_info, is_round)
         else
            call hertz_ellipse(wires%radius, wires%young, wires%poisson, contact%angle, ellipse, law_info)
         end if
         info = contact_parallel
         if (law_info /= hertz_ok) return
      end if
      info = contact_unknown_law
      if (.not. laws%normal%exists()) return
      normal = force_at_gap(laws%normal, contact%gap, wires, ellipse, earlier_dent_t(laws%dent_force))
      contact%force = normal%force
      contact%energy = normal%energy

      ! ... makes the spot
      of_spot = normal
      if (laws%normal%yields()) then
         call find_yielded_spot(wires, laws, ellipse, contact, acting%spot, info)
         if (info /= contact_active) return
      end if
      if (.not. (laws%normal%yields() .and. laws%spot%is_of_mechanics)) then
         call contact_spot(laws%spot, contact%force, wires, ellipse, acting%spot, law_info)
         if (law_info == spot_bad_data) info = contact_bad_data
         if (law_info /= spot_ok) return
         info = contact_bad_data
         ! without a resistivity it is not finite
         if (.not. abs(acting%spot%conductance) <= huge(1.0_dp)) return
      else
         ! what it follows is the overlap, and the angle at fixed overlap
         of_spot = force_of_gap_t(normal%force, -1.0_dp)
      end if
      info = contact_active
      acting%force = contact_force_t(contact%force, contact%force, -normal%dforce_dgap, normal%dforce_dangle, of_spot)
      acting%turns = abs(normal%denergy_dangle) > 0 .or. abs(normal%d2energy_dangle2) > 0
      acting%turning = turning_t(normal%denergy_dangle, normal%d2energy_dangle2, normal%dforce_dangle, normal%growth)
   end subroutine find_what_acts

   !> The spot and what flows through it.
   pure subroutine describe_current(spot, contact)
      type(contact_spot_t), intent(in) :: spot
      type(contact_em_t), intent(inout) :: contact

      contact%semi_major = spot%semi_major
      contact%semi_minor = spot%semi_minor
      if (spot%conductance > 0) contact%resistance = 1/spot%conductance
      contact%current = contact%electricity%current
      contact%voltage_gap = contact%electricity%voltage_gap
   end subroutine describe_current

   !> The dent and the spot of wires that yield. Source: theory section 15.
   pure subroutine find_yielded_spot(wires, laws, ellipse, contact, spot, info)
      type(wire_pair_t), intent(in) :: wires
      type(contact_laws_t), intent(in) :: laws
      type(hertz_ellipse_t), intent(in) :: ellipse
      type(contact_em_t), intent(inout) :: contact
      type(contact_spot_t), intent(out) :: spot
      !> `contact_active`, `contact_open` over the dent, or `contact_compacts`
      integer, intent(out) :: info
      type(yielding_state_t) :: state
      type(dent_t) :: dent
      real(dp) :: unused

      contact%largest_force = max(contact%force, laws%dent_force)
      dent = dent_of_wires(laws%normal, wires, ellipse, earlier_dent_t(contact%largest_force))
      contact%dent = dent%depth
      info = contact_open
      if (.not. contact%force > 0) return
      call state_of_wires(laws%normal, wires, ellipse, earlier_dent_t(laws%dent_force), contact%gap, laws%keeps_spot, &
         state, unused)
      info = contact_compacts
      if (dent%area > pi*(widest_spot*minval(wires%radius))**2) return
      if (laws%spot%exists() .and. laws%spot%is_of_mechanics) then
         spot = spot_of_state(laws%spot, wires%resistivity, state, ellipse%ratio)
      end if
      info = contact_active
   end subroutine find_yielded_spot

   !> Closest points and kinematics; `info` is `contact_active` when the wires overlap within both elements.
   pure subroutine find_contact(x, t, length, axis, radius, side, contact, info)
      !> Nodal positions (3, 4) [m]: barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4)
      !> Unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> Radii (2) [m]: barred, unbarred
      real(dp), intent(in) :: radius(2)
      !> Remembered orientation +1 or -1, or 0, see contact_kinematics
      integer, intent(in) :: side
      type(contact_em_t), intent(inout) :: contact
      !> One of the constants above
      integer, intent(out) :: info
      integer :: status, kinematics_info

      call closest_points(x, t, length, axis, contact%xi_bar, contact%xi, status)
      contact%gap = distance_at(x, t, length, axis, contact%xi_bar, contact%xi) - sum(radius)
      select case (status)
      case (closest_inside)
         call contact_kinematics(x, t, length, axis, radius, contact%xi_bar, contact%xi, side, contact%kinematics, &
            kinematics_info)
         info = contact_not_unique
         if (kinematics_info == kinematics_parallel) info = contact_parallel
         if (kinematics_info /= kinematics_ok) return
         contact%gap = contact%kinematics%gap
         contact%normal = contact%kinematics%normal
         contact%angle = contact%kinematics%angle
         contact%side = contact%kinematics%side
         info = contact_active
         if (contact%gap >= 0) info = contact_open
      case (closest_beyond)
         info = contact_beyond
      case (closest_parallel, closest_not_unique)
         ! wires that do not touch need no unique closest points
         info = contact_open
         if (contact%gap < 0) info = merge(contact_parallel, contact_not_unique, status == closest_parallel)
      case default
         info = contact_not_converged
      end select
   end subroutine find_contact

   !> The foot of an end of one wire on the other one, or the distance of two ends.
   pure subroutine find_contact_at_ends(x, t, length, axis, radius, ends, contact, info)
      !> As in `find_contact`
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> Radii (2) [m]: barred, unbarred
      real(dp), intent(in) :: radius(2)
      !> -1 or 1: the end of the barred, of the unbarred wire; 0: its side (2)
      integer, intent(in) :: ends(2)
      type(contact_em_t), intent(inout) :: contact
      !> One of the constants above
      integer, intent(out) :: info
      real(dp) :: xi(2), quality, origin(3)
      integer :: other, first, status, kinematics_info

      xi = ends
      origin = x(:, 1)
      if (any(ends == 0)) then
         other = minloc(abs(ends), 1)
         first = 2*other - 1
         associate (node => 2*(3 - other) - merge(1, 0, ends(3 - other) < 0))
            call line_foot(axis_polynomial(axis, length(other), x(:, first:first + 1) - spread(origin, 2, 2), &
               t(:, first:first + 1)), x(:, node) - origin, [.false., .false.], xi(other), quality, status)
         end associate
      else
         status = foot_inside
      end if
      contact%xi_bar = xi(1)
      contact%xi = xi(2)
      contact%gap = distance_at(x, t, length, axis, xi(1), xi(2)) - sum(radius)
      info = merge(contact_beyond, contact_not_converged, status == foot_beyond)
      if (status /= foot_inside) return
      call end_kinematics(x, t, length, axis, radius, xi(1), xi(2), ends /= 0, [0.0_dp, 0.0_dp, 0.0_dp], &
         contact%kinematics, kinematics_info)
      info = contact_not_unique
      if (kinematics_info /= kinematics_ok) return
      contact%normal = contact%kinematics%normal
      contact%angle = contact%kinematics%angle
      info = merge(contact_open, contact_active, contact%gap >= 0)
   end subroutine find_contact_at_ends

   !> Distance of two axis points [m].
   pure real(dp) function distance_at(x, t, length, axis, xi_bar, xi) result(distance)
      !> Nodal positions (3, 4) [m]: barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4)
      !> Unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> Places in the barred and the unbarred element
      real(dp), intent(in) :: xi_bar, xi
      real(dp), dimension(4) :: h, h1, h2, hb
      real(dp) :: w(3)

      call axis_shape(axis, length(2), xi, h, h1, h2)
      call axis_shape(axis, length(1), xi_bar, hb, h1, h2)
      w = hb(1)*(x(:, 1) - x(:, 3)) + hb(2)*t(:, 1) + hb(3)*(x(:, 2) - x(:, 3)) + hb(4)*t(:, 2) &
         - (h(2)*t(:, 3) + h(3)*(x(:, 4) - x(:, 3)) + h(4)*t(:, 4))
      distance = norm2(w)
   end function distance_at

end module litz_contact_em
