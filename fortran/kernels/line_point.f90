!> One point of the contact of two wires along a line: a fixed place of the unbarred wire, with its foot on the barred
!> one.
!>
!> Source: theory section 10. Unknowns, order, block structure and signs are those of litz_contact_em; `k` and `r` hold
!> the law per length times the weight `W`, the length for which the point stands. The residual is the gradient of the
!> energy `W pi(-g)`. The steps, each its own kernel: foot, kinematics, law, and the blocks that these make.
module litz_line_point
   use litz_kinds, only: dp, pi
   use litz_axis_choices, only: axis_hermite
   use litz_normal_law, only: force_of_gap_t
   use litz_spot_law, only: contact_spot_t
   use litz_line_law, only: line_wires_t, line_force_t, line_force, line_spot_t, line_spot
   use litz_axis, only: axis_shape, axis_polynomial, on_axis
   use litz_line_foot, only: line_foot, foot_inside, foot_at_end, foot_beyond, foot_too_curved
   use litz_line_kinematics, only: line_kinematics
   use litz_contact_kinematics, only: contact_kinematics_t, kinematics_ok
   use litz_contact_blocks, only: contact_blocks, contact_force_t, spot_in_circuit_t
   use litz_contact_electricity, only: contact_electricity_t
   use litz_contact_mechanics, only: form_spin
   use litz_rotation_forms, only: spin_to_rotation_vectors
   implicit none
   private
   public :: line_point, line_laws_t, line_place_t, line_point_t, foot_of_place, force_of_line, spot_of_line
   public :: line_active, line_open, line_beyond, line_too_curved, line_not_converged, line_too_wide, line_axes_meet

   !> The wires touch
   integer, parameter :: line_active = 0
   !> The wires do not touch there: `k` and `r` are zero
   integer, parameter :: line_open = 1
   !> The foot lies beyond the barred element, where its wire goes on: `k` and `r` are zero
   integer, parameter :: line_beyond = 2
   !> Failures; `k` and `r` are zero. Wires that overlap where the barred one is curved about the place: see
   !> `least_quality` of litz_line_foot
   integer, parameter :: line_too_curved = -1
   !> The foot was not found: coincident nodes, or numbers that are not finite
   integer, parameter :: line_not_converged = -2
   !> The axes meet, so that there is no normal
   integer, parameter :: line_axes_meet = -3
   !> The strip is wider than the law holds for: `k` and `r` are those of its continuation, for iterates
   integer, parameter :: line_too_wide = -4

   !> How the wires act on each other.
   type :: line_laws_t
      !> `axis_linear` or `axis_hermite`
      integer :: axis = axis_hermite
      !> From `line_wires`, at the angle whose sine is that of the lens to which the point belongs; it is held fixed
      type(line_wires_t) :: wires
      !> eps_l of `f = eps_l delta` [N/m^2]; 0: the elastic law
      real(dp) :: penalty = 0
      !> .false.: no current
      logical :: conducts = .true.
      !> sigma_f [ohm m^2] and H [Pa], see `line_spot`; 0: none
      real(dp) :: film = 0, hardness = 0
      !> rho L0/(4 A) of the elements [ohm]: barred, unbarred; see contact_electricity
      real(dp) :: series_resistance(2) = 0
   end type line_laws_t

   !> The point, and what is known of it before.
   type :: line_place_t
      !> Place in the unbarred element
      real(dp) :: xi = 0
      !> W [m]
      real(dp) :: weight = 0
      !> Whether the barred axis ends at its first and at its second node
      logical :: ends(2) = .false.
      !> Normal of the last converged state; 0: none
      real(dp) :: normal_before(3) = 0
      !> Place of an earlier foot, where there is one
      logical :: has_start = .false.
      real(dp) :: start = 0
   end type line_place_t

   !> What is known of the contact besides `k` and `r`; zero where it is not active, except the foot and the gap.
   type :: line_point_t
      !> Foot in the barred element, its quality M/|xb'|^2, and whether it is held at an end of the barred axis
      real(dp) :: xi_bar = 0, quality = 0
      logical :: at_end = .false.
      !> Gap between the surfaces [m], negative in contact
      real(dp) :: gap = 0
      !> W f [N] and energy W pi [J]
      real(dp) :: force = 0, energy = 0
      !> f, df/ddelta, ... and b, g', ... per length
      type(line_force_t) :: normal
      type(line_spot_t) :: spot
      type(contact_kinematics_t) :: kinematics
      type(contact_electricity_t) :: electricity
   end type line_point_t

contains

   !> Tangent and residual of one point.
   pure subroutine line_point(x, t, length, v, place, laws, k, r, point, info, rotation_vectors)
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> Nodal voltages (4) [V]
      real(dp), intent(in) :: v(4)
      type(line_place_t), intent(in) :: place
      type(line_laws_t), intent(in) :: laws
      !> Tangent (28, 28) and residual (28); rotations are spins
      real(dp), intent(out) :: k(28, 28), r(28)
      type(line_point_t), intent(out) :: point
      !> One of the constants above
      integer, intent(out) :: info
      !> Rotation vectors of the nodes (3, 4) [rad], when rotations are additive changes of these instead
      real(dp), intent(in), optional :: rotation_vectors(3, 4)
      type(force_of_gap_t) :: force
      real(dp) :: k_mm(24, 24), r_m(24), k_me(4, 24), k_ee(4, 4), r_e(4)

      k = 0
      r = 0
      call find_point(x, t, length, place, laws, point, info)
      if (info /= line_active) return

      point%normal = line_force(laws%wires, -point%gap, laws%penalty)
      if (laws%conducts) point%spot = line_spot(laws%wires, point%normal%force, laws%film, laws%hardness)
      if (point%normal%too_wide .or. point%spot%too_wide) info = line_too_wide
      force = force_of_line(point%normal, place%weight)
      point%force = force%force
      point%energy = force%energy
      call contact_blocks(point%kinematics, t, v, &
         contact_force_t(force%force, force%force, -force%dforce_dgap, 0.0_dp, force), &
         spot_in_circuit_t(spot_of_line(point%spot, place%weight), series_resistance=laws%series_resistance), &
         form_spin, k_mm, r_m, k_me, k_ee, r_e, point%electricity)
      k(1:24, 1:24) = k_mm
      k(25:28, 1:24) = k_me
      k(25:28, 25:28) = k_ee
      r = [r_m, r_e]
      if (present(rotation_vectors)) call spin_to_rotation_vectors(k, r, rotation_vectors, [4, 10, 16, 22])
   end subroutine line_point

   !> Foot and kinematics; `info` is `line_active` when the wires overlap there.
   pure subroutine find_point(x, t, length, place, laws, point, info)
      !> Nodal positions (3, 4) [m]: barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4)
      !> Unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      type(line_place_t), intent(in) :: place
      type(line_laws_t), intent(in) :: laws
      type(line_point_t), intent(inout) :: point
      !> One of the constants above
      integer, intent(out) :: info
      integer :: status, kinematics_info

      call foot_of_place(x, t, length, laws%axis, place, point%xi_bar, point%quality, status)
      point%at_end = status == foot_at_end
      select case (status)
      case (foot_inside, foot_at_end, foot_too_curved)
         call line_kinematics(x, t, length, laws%axis, laws%wires%radius, point%xi_bar, place%xi, &
            status /= foot_inside, place%normal_before, point%kinematics, kinematics_info)
         info = line_axes_meet
         if (kinematics_info /= kinematics_ok) return
         point%gap = point%kinematics%gap
         info = line_active
         if (status == foot_too_curved) info = line_too_curved
         ! a wire that does not touch may be curved at will
         if (point%gap >= 0) info = line_open
      case (foot_beyond)
         info = line_beyond
      case default
         info = line_not_converged
      end select
   end subroutine find_point

   !> The force of a point, as that of a crossing. The angle is held fixed.
   pure type(force_of_gap_t) function force_of_line(normal, weight) result(force)
      type(line_force_t), intent(in) :: normal
      !> W [m]
      real(dp), intent(in) :: weight

      force = force_of_gap_t(force=weight*normal%force, dforce_dgap=-weight*normal%stiffness, &
         energy=weight*normal%energy)
   end function force_of_line

   !> The strip of a point, as the spot of a crossing: an ellipse of the same area, whose minor half axis is b. As force
   !> and conductance both go with the weight, dG/dF is dg'/df.
   pure type(contact_spot_t) function spot_of_line(strip, weight) result(spot)
      type(line_spot_t), intent(in) :: strip
      !> W [m]
      real(dp), intent(in) :: weight

      if (.not. strip%half_width > 0) return
      spot = contact_spot_t(semi_major=2*weight/pi, semi_minor=strip%half_width, &
         conductance=weight*strip%conductance, dconductance_dforce=strip%dconductance_dforce)
   end function spot_of_line

   !> Foot of a place of the unbarred element on the barred one.
   pure subroutine foot_of_place(x, t, length, axis, place, xi_bar, quality, status)
      !> Nodal positions (3, 4) [m]: barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4)
      !> Unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      type(line_place_t), intent(in) :: place
      !> Foot in the barred element
      real(dp), intent(out) :: xi_bar
      !> M/|xb'|^2 there
      real(dp), intent(out) :: quality
      !> One of the constants of litz_line_foot
      integer, intent(out) :: status
      real(dp) :: relative(3, 4), p_bar(3, 0:3), point(3), h(4), h1(4), h2(4)
      integer :: i

      do i = 1, 4
         relative(:, i) = x(:, i) - x(:, 3)
      end do
      call axis_shape(axis, length(2), place%xi, h, h1, h2)
      point = on_axis(h, relative(:, 3:4), t(:, 3:4))
      p_bar = axis_polynomial(axis, length(1), relative(:, 1:2), t(:, 1:2))
      if (place%has_start) then
         call line_foot(p_bar, point, place%ends, xi_bar, quality, status, place%start)
      else
         call line_foot(p_bar, point, place%ends, xi_bar, quality, status)
      end if
   end subroutine foot_of_place

end module litz_line_point
