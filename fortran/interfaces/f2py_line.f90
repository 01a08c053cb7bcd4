! The kernels of line contact for Python, of many points at once; the contracts are in fortran/laws/line_law.f90,
! fortran/laws/lens_law.f90, fortran/kernels/line_point.f90 and fortran/kernels/wire_friction.f90.
module f2py_line
   use iso_c_binding, only: c_double, c_int
   use litz_law_input, only: wire_pair_t
   use litz_line_law, only: core_line_wires => line_wires, line_wires_t, line_force_t, core_line_force => line_force, &
      line_overlap_t, core_line_overlap => line_overlap, line_spot_t, core_line_spot => line_spot
   use litz_lens_law, only: lens_t, lens_force, lens_spot_t, lens_spot, lens_energy, &
      core_share_of_point => share_of_point
   use litz_contact_kinematics, only: contact_kinematics, contact_kinematics_t
   use litz_axis_choices, only: axis_hermite
   use litz_friction_law, only: friction_law_t, friction_start_t, core_friction_law => friction_law
   use litz_wire_friction, only: wire_slip_t, wire_slip, wire_friction_residual, wire_friction_tangent
   use litz_line_kinematics, only: core_lens_sine => lens_sine, line_kinematics
   use litz_line_point, only: core_line_point => line_point, line_laws_t, line_place_t, line_point_t
   implicit none
   private :: numbers_of, one_point, chunk

   !> Points that one thread computes before it takes more; fewer are not shared among threads
   integer, parameter :: chunk = 64
contains

   ! values: b, delta, ddelta/df, g', dg'/df
   subroutine line_laws(n, force, radius, young, poisson, resistivity, angle, film, values, too_wide)
      !> Number of points
      integer(c_int), intent(in) :: n
      !> Forces per length (n) [N/m]
      real(c_double), intent(in) :: force(n)
      !> Radii (2, n) [m]: barred, unbarred
      real(c_double), intent(in) :: radius(2, n)
      !> Young's moduli (2, n) [Pa]
      real(c_double), intent(in) :: young(2, n)
      !> Poisson's ratios (2, n) [-]
      real(c_double), intent(in) :: poisson(2, n)
      !> Resistivities (2, n) [ohm m]
      real(c_double), intent(in) :: resistivity(2, n)
      !> Angles between the axes (n) [rad]
      real(c_double), intent(in) :: angle(n)
      !> Film resistances times area (n) [ohm m^2]
      real(c_double), intent(in) :: film(n)
      !> b [m], delta [m], ddelta/df [m^2/N], g' [S/m], dg'/df [S/N] (5, n)
      real(c_double), intent(out) :: values(5, n)
      !> Not 0: the strip is wider than the law holds for (n)
      integer(c_int), intent(out) :: too_wide(n)
      type(wire_pair_t) :: wires
      type(line_wires_t) :: line
      type(line_overlap_t) :: found
      type(line_spot_t) :: spot
      integer :: i
      values = 0
      too_wide = 0
      do i = 1, n
         if (.not. force(i) > 0) cycle
         wires = wire_pair_t(radius(:, i), young(:, i), poisson(:, i), resistivity(:, i))
         line = core_line_wires(wires, angle(i))
         found = core_line_overlap(line, force(i), 0.0_c_double)
         spot = core_line_spot(line, force(i), film(i), 0.0_c_double)
         values(:, i) = [spot%half_width, found%overlap, 1/found%stiffness, spot%conductance, spot%dconductance_dforce]
         too_wide(i) = merge(1, 0, spot%too_wide)
      end do
   end subroutine line_laws

   ! at_overlap: f, df/ddelta, df/dangle, energy; at_force: delta, df/ddelta, its derivative;
   ! spot: b, g', dg'/df, dg'/dangle; the last two are asked about the force of the first
   subroutine line_law(overlap, radius, young, poisson, resistivity, angle, penalty, film, hardness, at_overlap, &
      at_force, spot, too_wide)
      !> delta [m]
      real(c_double), intent(in) :: overlap
      !> Radii (2) [m]: barred, unbarred
      real(c_double), intent(in) :: radius(2)
      !> Young's moduli (2) [Pa]
      real(c_double), intent(in) :: young(2)
      !> Poisson's ratios (2) [-]
      real(c_double), intent(in) :: poisson(2)
      !> Resistivities (2) [ohm m]
      real(c_double), intent(in) :: resistivity(2)
      !> Angle between the axes [rad]
      real(c_double), intent(in) :: angle
      !> eps_l [N/m^2]; 0: the elastic law
      real(c_double), intent(in) :: penalty
      !> sigma_f [ohm m^2]
      real(c_double), intent(in) :: film
      !> H [Pa]; 0: the elastic strip
      real(c_double), intent(in) :: hardness
      !> f [N/m], df/ddelta [N/m^2], df/dangle [N/(m rad)], energy [J/m]
      real(c_double), intent(out) :: at_overlap(4)
      !> delta [m], df/ddelta [N/m^2], its derivative by f [1/m]
      real(c_double), intent(out) :: at_force(3)
      !> b [m], g' [S/m], dg'/df [S/N], dg'/dangle [S/(m rad)]
      real(c_double), intent(out) :: spot(4)
      !> Not 0: wider than the law holds for (2): the law at the overlap, the spot
      integer(c_int), intent(out) :: too_wide(2)
      type(line_wires_t) :: line
      type(line_force_t) :: normal
      type(line_overlap_t) :: inverse
      type(line_spot_t) :: strip
      line = core_line_wires(wire_pair_t(radius, young, poisson, resistivity), angle)
      normal = core_line_force(line, overlap, penalty)
      inverse = core_line_overlap(line, normal%force, penalty)
      strip = core_line_spot(line, normal%force, film, hardness)
      at_overlap = [normal%force, normal%stiffness, normal%dforce_dangle, normal%energy]
      at_force = [inverse%overlap, inverse%stiffness, inverse%dstiffness_dforce]
      spot = [strip%half_width, strip%conductance, strip%dconductance_dforce, strip%dconductance_dangle]
      too_wide = merge(1, 0, [normal%too_wide, strip%too_wide])
   end subroutine line_law

   ! force: aW, F, dF/dg, dF/dangle, energy and its two derivatives by the angle;
   ! spot: G, dG/dg, dG/dangle, b at the deepest place
   subroutine lens_law(gap, sine, radius, young, poisson, resistivity, penalty, film, hardness, force, spot)
      !> Gap [m], negative in contact
      real(c_double), intent(in) :: gap
      !> Sine of the crossing, corrected for the curvature of the wires
      real(c_double), intent(in) :: sine
      !> Radii (2) [m]: barred, unbarred
      real(c_double), intent(in) :: radius(2)
      !> Young's moduli (2) [Pa]
      real(c_double), intent(in) :: young(2)
      !> Poisson's ratios (2) [-]
      real(c_double), intent(in) :: poisson(2)
      !> Resistivities (2) [ohm m]
      real(c_double), intent(in) :: resistivity(2)
      !> eps_l [N/m^2]; 0: the elastic law
      real(c_double), intent(in) :: penalty
      !> sigma_f [ohm m^2]
      real(c_double), intent(in) :: film
      !> H [Pa]; 0: the elastic strip
      real(c_double), intent(in) :: hardness
      !> aW [m], F [N], dF/dg [N/m], dF/dangle [N/rad], energy [J], its derivatives by the angle [J/rad, J/rad^2]
      real(c_double), intent(out) :: force(7)
      !> G [S], dG/dg [S/m], dG/dangle [S/rad], b [m]
      real(c_double), intent(out) :: spot(4)
      type(line_wires_t) :: line
      type(lens_t) :: lens
      type(lens_spot_t) :: strip
      real(c_double) :: energy, denergy_dangle, d2energy_dangle2
      line = core_line_wires(wire_pair_t(radius, young, poisson, resistivity), asin(min(sine, 1.0_c_double)))
      lens = lens_force(line, gap, sine, penalty)
      strip = lens_spot(line, lens, film, hardness)
      call lens_energy(line, gap, sine, penalty, energy, denergy_dangle, d2energy_dangle2)
      force = [lens%half_length, lens%force, lens%dforce_dgap, lens%dforce_dangle, energy, denergy_dangle, &
         d2energy_dangle2]
      spot = [strip%conductance, strip%dconductance_dgap, strip%dconductance_dangle, strip%half_width]
   end subroutine lens_law

   subroutine share_of_point(half_length, spacing, share, slope)
      !> Half length of the lens [m]
      real(c_double), intent(in) :: half_length
      !> Distance of neighbouring line points [m]
      real(c_double), intent(in) :: spacing
      !> Share that the point carries [-]
      real(c_double), intent(out) :: share
      !> Its derivative by the half length [1/m]
      real(c_double), intent(out) :: slope
      call core_share_of_point(half_length, spacing, share, slope)
   end subroutine share_of_point

   ! At given closest points.
   subroutine lens_sine(x, t, length, axis, radius, xi_bar, xi, sine, info)
      !> Nodal positions (3, 4) [m]: barred 1, barred 2, 1, 2
      real(c_double), intent(in) :: x(3, 4)
      !> Unit tangents of the nodes (3, 4)
      real(c_double), intent(in) :: t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(c_double), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer(c_int), intent(in) :: axis
      !> Radii (2) [m]: barred, unbarred
      real(c_double), intent(in) :: radius(2)
      !> Places in the barred and the unbarred element
      real(c_double), intent(in) :: xi_bar, xi
      !> s
      real(c_double), intent(out) :: sine
      !> 0: all is well; else one of the constants of contact_kinematics
      integer(c_int), intent(out) :: info
      type(contact_kinematics_t) :: kinematics
      sine = 0
      call contact_kinematics(x, t, length, axis, radius, xi_bar, xi, 0, kinematics, info)
      if (info == 0) sine = core_lens_sine(kinematics)
   end subroutine lens_sine

   ! Residual and tangent of the traction at a given place and foot. force: F, dF/dg; stiffness: k_t, dk_t/dF
   ! values: slip (2), traction (2), status; frame: e1, e2
   subroutine line_friction(x, t, length, radius, xi_bar, xi, at_end, normal_side, turned, normal_before, moved, mu, &
      force, stiffness, traction_start, k, r, values, frame, info)
      !> Nodal positions (3, 4) [m]: barred 1, barred 2, 1, 2
      real(c_double), intent(in) :: x(3, 4)
      !> Unit tangents of the nodes (3, 4)
      real(c_double), intent(in) :: t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(c_double), intent(in) :: length(2)
      !> Radii (2) [m]: barred, unbarred
      real(c_double), intent(in) :: radius(2)
      !> The foot in the barred and the place in the unbarred element
      real(c_double), intent(in) :: xi_bar, xi
      !> Not 0: the foot is held at an end
      integer(c_int), intent(in) :: at_end
      !> A vector on the side of the normal (3); 0: none
      real(c_double), intent(in) :: normal_side(3)
      !> Rotations of the nodes since the increment began (3, 3, 4)
      real(c_double), intent(in) :: turned(3, 3, 4)
      !> Normal when it began (3)
      real(c_double), intent(in) :: normal_before(3)
      !> How far the foot has moved since [m]
      real(c_double), intent(in) :: moved
      !> Coefficient of friction [-]
      real(c_double), intent(in) :: mu
      !> F [N], dF/dg [N/m]
      real(c_double), intent(in) :: force(2)
      !> k_t [N/m], dk_t/dF [1/m]
      real(c_double), intent(in) :: stiffness(2)
      !> Traction at the start of the increment (2) [N]
      real(c_double), intent(in) :: traction_start(2)
      !> Tangent (24, 24)
      real(c_double), intent(out) :: k(24, 24)
      !> Residual (24) [N, N m]
      real(c_double), intent(out) :: r(24)
      !> Slip (2) [m], traction (2) [N], status
      real(c_double), intent(out) :: values(5)
      !> Directions of the slip (3, 2)
      real(c_double), intent(out) :: frame(3, 2)
      !> 0: all is well; else one of the constants of the kernel
      integer(c_int), intent(out) :: info
      type(contact_kinematics_t) :: kinematics
      type(wire_slip_t) :: slip
      type(friction_law_t) :: law
      k = 0
      r = 0
      values = 0
      frame = 0
      call line_kinematics(x, t, length, axis_hermite, radius, xi_bar, xi, at_end /= 0, normal_side, kinematics, info)
      if (info /= 0) return
      slip = wire_slip(kinematics, x, t, length, axis_hermite, radius, [0.0_c_double, 1.0_c_double], turned, &
         normal_before, [moved, 0.0_c_double])
      law = core_friction_law(mu, force(1), stiffness(1), stiffness(2), friction_start_t(traction_start, force(1)), &
         slip%slip)
      r = wire_friction_residual(slip, law%traction)
      k = wire_friction_tangent(kinematics, slip, slip%dslip, t, law, force(2)*kinematics%dgap, law%traction)
      values = [slip%slip, law%traction, real(law%status, c_double)]
      frame = slip%frame
   end subroutine line_friction

   ! numbers: xi_bar, gap, angle, force, half width, resistance, current, voltage_gap, force per length, energy,
   ! quality, at_end. start and rotation_vectors are looked at when has_start, has_rotation_vectors /= 0.
   subroutine line_points(n, x, t, length, v, xi, weight, radius, young, poisson, resistivity, angle, penalty, film, &
      hardness, ends, normal_before, start, series_resistance, rotation_vectors, axis, has_start, &
      has_rotation_vectors, n_k, k, wants_k, r, numbers, normal, info)
      !f2py threadsafe
      !> Number of points
      integer(c_int), intent(in) :: n
      !> Nodal positions (3, 4, n) [m]: barred 1, barred 2, 1, 2
      real(c_double), intent(in) :: x(3, 4, n)
      !> Unit tangents of the nodes (3, 4, n)
      real(c_double), intent(in) :: t(3, 4, n)
      !> Reference lengths (2, n) [m]: barred, unbarred
      real(c_double), intent(in) :: length(2, n)
      !> Voltages of the nodes (4, n) [V]
      real(c_double), intent(in) :: v(4, n)
      !> Places in the unbarred element (n)
      real(c_double), intent(in) :: xi(n)
      !> Lengths for which the points stand (n) [m]
      real(c_double), intent(in) :: weight(n)
      !> Radii (2, n) [m]: barred, unbarred
      real(c_double), intent(in) :: radius(2, n)
      !> Young's moduli (2, n) [Pa]
      real(c_double), intent(in) :: young(2, n)
      !> Poisson's ratios (2, n) [-]
      real(c_double), intent(in) :: poisson(2, n)
      !> Resistivities (2, n) [ohm m]
      real(c_double), intent(in) :: resistivity(2, n)
      !> Angles whose sine is that of the lens (n) [rad]
      real(c_double), intent(in) :: angle(n)
      !> eps_l (n) [N/m^2]; 0: the elastic law
      real(c_double), intent(in) :: penalty(n)
      !> sigma_f (n) [ohm m^2]
      real(c_double), intent(in) :: film(n)
      !> H (n) [Pa]; 0: the elastic strip
      real(c_double), intent(in) :: hardness(n)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer(c_int), intent(in) :: axis
      !> Not 0: the barred axis ends at its first, its second node (2, n)
      integer(c_int), intent(in) :: ends(2, n)
      !> Normals of the last converged state (3, n); 0: none
      real(c_double), intent(in) :: normal_before(3, n)
      !> Not 0: `start` counts
      integer(c_int), intent(in) :: has_start
      !> Places of earlier feet (n)
      real(c_double), intent(in) :: start(n)
      !> rho L0/(4 A) (2, n) [ohm]; 0: the paper's linear voltage
      real(c_double), intent(in) :: series_resistance(2, n)
      !> Not 0: `rotation_vectors` count
      integer(c_int), intent(in) :: has_rotation_vectors
      !> Rotation vectors of the nodes (3, 4, n) [rad]
      real(c_double), intent(in) :: rotation_vectors(3, 4, n)
      !> Number of tangents: n, or 1 where they are not wanted
      integer(c_int), intent(in) :: n_k
      !> Tangents (28, 28, n_k): the only large result; Python makes room for it without filling it first
      real(c_double), intent(inout) :: k(28, 28, n_k)
      !> Not 0: the tangents are wanted
      integer(c_int), intent(in) :: wants_k
      !> Residuals (28, n) [N, N m, A]
      real(c_double), intent(out) :: r(28, n)
      !> See above (12, n)
      real(c_double), intent(out) :: numbers(12, n)
      !> Unit normals from the unbarred to the barred axis (3, n)
      real(c_double), intent(out) :: normal(3, n)
      !> 0: all is well; else one of the constants of the kernel (n)
      integer(c_int), intent(out) :: info(n)
      type(wire_pair_t) :: wires
      type(line_laws_t) :: laws
      type(line_place_t) :: place
      integer :: first, i
      !$omp parallel do schedule(dynamic) private(i, wires, laws, place) if (n > chunk)
      do first = 1, n, chunk
         do i = first, min(first + chunk - 1, n)
            wires = wire_pair_t(radius(:, i), young(:, i), poisson(:, i), resistivity(:, i))
            laws = line_laws_t(axis, core_line_wires(wires, angle(i)), penalty(i), .true., film(i), hardness(i), &
               series_resistance(:, i))
            place = line_place_t(xi(i), weight(i), ends(:, i) /= 0, normal_before(:, i), has_start /= 0, start(i))
            call one_point(x(:, :, i), t(:, :, i), length(:, i), v(:, i), place, laws, has_rotation_vectors /= 0, &
               rotation_vectors(:, :, i), k(:, :, i:merge(i, 0, wants_k /= 0)), r(:, i), numbers(:, i), normal(:, i), &
               info(i))
         end do
      end do
   end subroutine line_points

   subroutine one_point(x, t, length, v, place, laws, has_rotation_vectors, rotation_vectors, k, r, numbers, normal, &
      info)
      !> As of `line_points`
      real(c_double), intent(in) :: x(3, 4), t(3, 4), length(2), v(4), rotation_vectors(3, 4)
      type(line_place_t), intent(in) :: place
      type(line_laws_t), intent(in) :: laws
      !> As of `line_points`
      logical, intent(in) :: has_rotation_vectors
      !> Tangent (28, 28, 1), or (28, 28, 0) where it is not wanted; the others as of `line_points`
      real(c_double), intent(inout) :: k(:, :, :), r(28), numbers(12), normal(3)
      !> As of `line_points`
      integer(c_int), intent(inout) :: info
      type(line_point_t) :: point
      real(c_double) :: tangent(28, 28)

      if (has_rotation_vectors) then
         call core_line_point(x, t, length, v, place, laws, tangent, r, point, info, rotation_vectors)
      else
         call core_line_point(x, t, length, v, place, laws, tangent, r, point, info)
      end if
      if (size(k, 3) > 0) k(:, :, 1) = tangent
      numbers = numbers_of(point, place%weight)
      normal = point%kinematics%normal
   end subroutine one_point

   pure function numbers_of(point, weight) result(numbers)
      type(line_point_t), intent(in) :: point
      !> Length for which the point stands [m]
      real(c_double), intent(in) :: weight
      real(c_double) :: numbers(12)
      real(c_double) :: resistance
      resistance = 0
      if (point%spot%conductance > 0) resistance = 1/(weight*point%spot%conductance)
      numbers = [point%xi_bar, point%gap, point%kinematics%angle, point%force, point%spot%half_width, resistance, &
         point%electricity%current, point%electricity%voltage_gap, point%normal%force, point%energy, point%quality, &
         merge(1.0_c_double, 0.0_c_double, point%at_end)]
   end function numbers_of

end module f2py_line
