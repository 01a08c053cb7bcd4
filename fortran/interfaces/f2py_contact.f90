! The contact kernels for Python; the contracts are in fortran/kernels/.
! The data of a law have at least one entry, also where it does not look at them.
module f2py_contact
   use iso_c_binding, only: c_double, c_int
   use litz_elliptic, only: elliptic_t, elliptic_integrals, elliptic_integrals_complementary
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok
   use litz_law_input, only: wire_pair_t
   use litz_law_words, only: law_words_t
   use litz_normal_law, only: normal_law_t, force_of_gap_t, overlap_of_force_t, force_at_gap, overlap_at_force
   use litz_normal_laws, only: find_normal_law => normal_law, all_normal_laws
   use litz_spot_law, only: spot_law_t, contact_spot_t, core_contact_spot => contact_spot
   use litz_spot_laws, only: find_spot_law => spot_law, all_spot_laws
   use litz_closest_points, only: core_closest_points => closest_points
   use litz_contact_kinematics, only: core_contact_kinematics => contact_kinematics, contact_kinematics_t
   use litz_contact_mechanics, only: core_contact_mechanics => contact_mechanics
   use litz_friction_law, only: friction_law_t, friction_start_t, core_friction_law => friction_law, &
      core_mindlin_ratio => mindlin_ratio
   use litz_wire_friction, only: wire_slip_t, wire_slip, wire_friction_residual, wire_friction_tangent
   implicit none
   private :: names_of, ellipse_for
contains

   pure subroutine names_of(laws, names, values, needed)
      type(law_words_t), intent(in) :: laws(:)
      !> Names of the laws (32), empty beyond them
      character(len=16), intent(out) :: names(32)
      !> Names of the numbers of each (4, 32)
      character(len=16), intent(out) :: values(4, 32)
      !> How many of these must be given (32); the others follow them
      integer(c_int), intent(out) :: needed(32)
      integer :: i
      names = ''
      values = ''
      needed = 0
      do i = 1, size(laws)
         names(i) = laws(i)%name
         where (.not. laws(i)%fields%is_parameter) values(:, i) = laws(i)%fields%name
         needed(i) = laws(i)%n_needed()
      end do
   end subroutine names_of

   ! The Hertz ellipse for a law that uses it.
   pure subroutine ellipse_for(law, radius, young, poisson, angle, ellipse, info)
      class(law_words_t), intent(in) :: law
      !> Radii [m], Young's moduli [Pa] and Poisson's ratios (2)
      real(c_double), intent(in) :: radius(2), young(2), poisson(2)
      !> Between the axes [rad]
      real(c_double), intent(in) :: angle
      type(hertz_ellipse_t), intent(out) :: ellipse
      !> One of those of litz_hertz
      integer(c_int), intent(out) :: info
      info = hertz_ok
      if (law%uses_ellipse) call hertz_ellipse(radius, young, poisson, angle, ellipse, info)
   end subroutine ellipse_for

   ! Names of the normal laws and of their numbers, at the places of the laws; blank beyond the last one.
   subroutine normal_law_names(names, values, needed)
      !> Names in capitals, blank beyond the last one
      character(len=16), intent(out) :: names(32)
      !> Names of the numbers that are their data (place, law), blank where there is none
      character(len=16), intent(out) :: values(4, 32)
      !> How many of these must be given, at the place of each law
      integer(c_int), intent(out) :: needed(32)
      call names_of(all_normal_laws(), names, values, needed)
   end subroutine normal_law_names

   ! The same of the spot laws.
   subroutine spot_law_names(names, values, needed)
      !> Names in capitals, blank beyond the last one
      character(len=16), intent(out) :: names(32)
      !> Names of the numbers that are their data (place, law), blank where there is none
      character(len=16), intent(out) :: values(4, 32)
      !> How many of these must be given, at the place of each law
      integer(c_int), intent(out) :: needed(32)
      call names_of(all_spot_laws(), names, values, needed)
   end subroutine spot_law_names

   ! K, E, B, D, C, dK/dm, dE/dm at m, or with complementary /= 0 at 1 - m.
   subroutine elliptic(m, complementary, values)
      !> Parameter
      real(c_double), intent(in) :: m
      !> Not 0: `m` is the complementary parameter
      integer(c_int), intent(in) :: complementary
      !> K, E, B, D, C, dK/dm, dE/dm
      real(c_double), intent(out) :: values(7)
      type(elliptic_t) :: f
      if (complementary /= 0) then
         f = elliptic_integrals_complementary(m)
      else
         f = elliptic_integrals(m)
      end if
      values = [f%k, f%e, f%b, f%d, f%c, f%dk_dm, f%de_dm]
   end subroutine elliptic

   ! values: semi_major, semi_minor, approach, conductance, dconductance_dforce, dconductance_dangle
   subroutine contact_spots(n, n_sets, n_data, law, data, force, radius, young, poisson, resistivity, angle, values, &
      info)
      !f2py threadsafe
      !> Number of contacts; of sets of data of the law: n, or 1 for all
      integer(c_int), intent(in) :: n, n_sets
      !> Numbers that are the data of the law, at least 1
      integer(c_int), intent(in) :: n_data
      !> Place of the law in litz_spot_laws
      integer(c_int), intent(in) :: law
      !> Data of the law (n_data, n_sets), line after line
      real(c_double), intent(in) :: data(n_data, n_sets)
      !> Contact forces (n) [N], positive in contact
      real(c_double), intent(in) :: force(n)
      !> Radii (2, n) [m]: barred, unbarred
      real(c_double), intent(in) :: radius(2, n)
      !> Young's moduli (2, n) [Pa]
      real(c_double), intent(in) :: young(2, n)
      !> Poisson's ratios (2, n) [-]
      real(c_double), intent(in) :: poisson(2, n)
      !> Resistivities (2, n) [ohm m]
      real(c_double), intent(in) :: resistivity(2, n)
      !> Angles between the tangents (n) [rad]
      real(c_double), intent(in) :: angle(n)
      !> Semi-axes, approach [m], G [S], dG/dF [S/N], dG/dangle [S/rad] (6, n)
      real(c_double), intent(out) :: values(6, n)
      !> 0: all is well; else one of the constants of the law or of litz_hertz (n)
      integer(c_int), intent(out) :: info(n)
      type(hertz_ellipse_t) :: ellipse
      type(spot_law_t) :: spot_law
      type(contact_spot_t) :: spot
      integer :: i
      values = 0
      do i = 1, n
         if (i <= n_sets) spot_law = find_spot_law(law, data(:, i))
         call ellipse_for(spot_law, radius(:, i), young(:, i), poisson(:, i), angle(i), ellipse, info(i))
         if (info(i) /= hertz_ok) cycle
         call core_contact_spot(spot_law, force(i), wire_pair_t(radius(:, i), young(:, i), poisson(:, i), &
            resistivity(:, i)), ellipse, spot, info(i))
         values(:, i) = [spot%semi_major, spot%semi_minor, spot%approach, spot%conductance, spot%dconductance_dforce, &
            spot%dconductance_dangle]
      end do
   end subroutine contact_spots

   ! values: force, dforce_dgap, dforce_dangle, energy, denergy_dangle, d2energy_dangle2
   subroutine normal_force(law, n_data, data, gap, radius, young, poisson, angle, values, info)
      !> Place of the law in litz_normal_laws
      integer(c_int), intent(in) :: law
      !> Numbers that are the data of the law, at least 1
      integer(c_int), intent(in) :: n_data
      !> Data of the law (n_data)
      real(c_double), intent(in) :: data(n_data)
      !> Gap [m], negative in contact
      real(c_double), intent(in) :: gap
      !> Radii (2) [m]: barred, unbarred
      real(c_double), intent(in) :: radius(2)
      !> Young's moduli (2) [Pa]
      real(c_double), intent(in) :: young(2)
      !> Poisson's ratios (2) [-]
      real(c_double), intent(in) :: poisson(2)
      !> Angle between the tangents [rad]
      real(c_double), intent(in) :: angle
      !> F [N], dF/dgap [N/m], dF/dangle [N/rad], stored energy [J] and its derivatives by the angle [J/rad, J/rad^2]
      real(c_double), intent(out) :: values(6)
      !> 0: all is well; else one of the constants of litz_hertz
      integer(c_int), intent(out) :: info
      type(hertz_ellipse_t) :: ellipse
      type(normal_law_t) :: normal_law
      type(force_of_gap_t) :: found
      values = 0
      normal_law = find_normal_law(law, data)
      call ellipse_for(normal_law, radius, young, poisson, angle, ellipse, info)
      if (info /= hertz_ok) return
      found = force_at_gap(normal_law, gap, wire_pair_t(radius, young, poisson), ellipse)
      values = [found%force, found%dforce_dgap, found%dforce_dangle, found%energy, found%denergy_dangle, &
         found%d2energy_dangle2]
   end subroutine normal_force

   ! values: overlap, stiffness, dstiffness_dforce
   subroutine normal_overlap(law, n_data, data, force, radius, young, poisson, angle, values, info)
      !> Place of the law in litz_normal_laws
      integer(c_int), intent(in) :: law
      !> Numbers that are the data of the law, at least 1
      integer(c_int), intent(in) :: n_data
      !> Data of the law (n_data)
      real(c_double), intent(in) :: data(n_data)
      !> Contact force [N], positive in contact
      real(c_double), intent(in) :: force
      !> Radii (2) [m]: barred, unbarred
      real(c_double), intent(in) :: radius(2)
      !> Young's moduli (2) [Pa]
      real(c_double), intent(in) :: young(2)
      !> Poisson's ratios (2) [-]
      real(c_double), intent(in) :: poisson(2)
      !> Angle between the tangents [rad]
      real(c_double), intent(in) :: angle
      !> delta [m], dF/ddelta [N/m], its derivative with respect to the force [1/m]
      real(c_double), intent(out) :: values(3)
      !> 0: all is well; else one of the constants of litz_hertz
      integer(c_int), intent(out) :: info
      type(hertz_ellipse_t) :: ellipse
      type(normal_law_t) :: normal_law
      type(overlap_of_force_t) :: found
      values = 0
      normal_law = find_normal_law(law, data)
      call ellipse_for(normal_law, radius, young, poisson, angle, ellipse, info)
      if (info /= hertz_ok) return
      found = overlap_at_force(normal_law, force, wire_pair_t(radius, young, poisson), ellipse)
      values = [found%overlap, found%stiffness, found%dstiffness_dforce]
   end subroutine normal_overlap

   ! start is looked at when has_start /= 0.
   subroutine closest_points(n, x, t, length, start, axis, has_start, xi_bar, xi, status)
      !f2py threadsafe
      !> Number of pairs of elements
      integer(c_int), intent(in) :: n
      !> Nodal positions (3, 4, n) [m]: barred 1, barred 2, 1, 2
      real(c_double), intent(in) :: x(3, 4, n)
      !> Unit tangents of the nodes (3, 4, n)
      real(c_double), intent(in) :: t(3, 4, n)
      !> Reference lengths (2, n) [m]: barred, unbarred
      real(c_double), intent(in) :: length(2, n)
      !> Places (barred, unbarred) of an earlier solution (2, n)
      real(c_double), intent(in) :: start(2, n)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer(c_int), intent(in) :: axis
      !> Not 0: `start` counts
      integer(c_int), intent(in) :: has_start
      !> Places in the barred and the unbarred elements (n)
      real(c_double), intent(out) :: xi_bar(n), xi(n)
      !> One of `closest_...` (n)
      integer(c_int), intent(out) :: status(n)
      integer :: i
      !$omp parallel do schedule(static) if (n >= 1000)
      do i = 1, n
         if (has_start /= 0) then
            call core_closest_points(x(:, :, i), t(:, :, i), length(:, i), axis, xi_bar(i), xi(i), status(i), &
               start(:, i))
         else
            call core_closest_points(x(:, :, i), t(:, :, i), length(:, i), axis, xi_bar(i), xi(i), status(i))
         end if
      end do
   end subroutine closest_points

   ! rows: dgap, dxi_bar, dxi, dcos_angle, dangle; values: distance, gap, angle, cos_angle, side
   subroutine contact_kinematics(x, t, length, axis, radius, xi_bar, xi, side, values, normal, rows, info)
      !> Nodal positions (3, 4) [m]: barred 1, barred 2, 1, 2
      real(c_double), intent(in) :: x(3, 4)
      !> Unit tangents of the nodes (3, 4)
      real(c_double), intent(in) :: t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(c_double), intent(in) :: length(2)
      !> Radii (2) [m]: barred, unbarred
      real(c_double), intent(in) :: radius(2)
      !> Places in the barred and the unbarred element
      real(c_double), intent(in) :: xi_bar, xi
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer(c_int), intent(in) :: axis
      !> Remembered orientation +1 or -1; 0: none
      integer(c_int), intent(in) :: side
      !> Distance, gap [m], angle [rad], its cosine, side
      real(c_double), intent(out) :: values(5)
      !> Unit normal from the unbarred to the barred axis
      real(c_double), intent(out) :: normal(3)
      !> Derivatives with respect to the mechanical unknowns (24) of gap, xi_bar, xi, cosine, angle
      real(c_double), intent(out) :: rows(24, 5)
      !> 0: all is well; else one of the constants of the kernel
      integer(c_int), intent(out) :: info
      type(contact_kinematics_t) :: kinematics
      call core_contact_kinematics(x, t, length, axis, radius, xi_bar, xi, side, kinematics, info)
      values = [kinematics%distance, kinematics%gap, kinematics%angle, kinematics%cos_angle, &
         real(kinematics%side, c_double)]
      normal = kinematics%normal
      rows(:, 1) = kinematics%dgap
      rows(:, 2) = kinematics%rows%dxi_bar
      rows(:, 3) = kinematics%rows%dxi
      rows(:, 4) = kinematics%rows%dcos_angle
      rows(:, 5) = kinematics%rows%dangle
   end subroutine contact_kinematics

   ! Residual and tangent at given closest points, as a driver composes them.
   subroutine contact_mechanics(x, t, length, axis, radius, xi_bar, xi, side, force, stiffness, geometric_force, form, &
      dforce_dangle, k, r, info)
      !> Nodal positions (3, 4) [m]: barred 1, barred 2, 1, 2
      real(c_double), intent(in) :: x(3, 4)
      !> Unit tangents of the nodes (3, 4)
      real(c_double), intent(in) :: t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(c_double), intent(in) :: length(2)
      !> Radii (2) [m]: barred, unbarred
      real(c_double), intent(in) :: radius(2)
      !> Places in the barred and the unbarred element
      real(c_double), intent(in) :: xi_bar, xi
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer(c_int), intent(in) :: axis
      !> Remembered orientation +1 or -1; 0: none
      integer(c_int), intent(in) :: side
      !> `form_spin` or `form_hessian` of contact_mechanics
      integer(c_int), intent(in) :: form
      !> Contact force [N], positive in contact
      real(c_double), intent(in) :: force
      !> -dF/dg [N/m]
      real(c_double), intent(in) :: stiffness
      !> Force in the geometric part of the tangent [N]
      real(c_double), intent(in) :: geometric_force
      !> dF/dangle [N/rad]
      real(c_double), intent(in) :: dforce_dangle
      !> Tangent (24, 24)
      real(c_double), intent(out) :: k(24, 24)
      !> Residual (24) [N, N m]
      real(c_double), intent(out) :: r(24)
      !> 0: all is well; else one of the constants of the kernel
      integer(c_int), intent(out) :: info
      type(contact_kinematics_t) :: kinematics
      k = 0
      r = 0
      call core_contact_kinematics(x, t, length, axis, radius, xi_bar, xi, side, kinematics, info)
      if (info /= 0) return
      call core_contact_mechanics(kinematics, t, force, stiffness, geometric_force, form, k, r, dforce_dangle)
   end subroutine contact_mechanics

   ! values: traction (2), plastic slip (2), dissipation, status; derivatives: dT/dD (2, 2) and dT/dF
   subroutine friction_law(mu, force, stiffness, dstiffness_dforce, traction_start, slip, values, derivatives)
      !> Coefficient of friction [-]
      real(c_double), intent(in) :: mu
      !> Contact force [N], positive in contact
      real(c_double), intent(in) :: force
      !> Tangential stiffness [N/m]
      real(c_double), intent(in) :: stiffness
      !> Its derivative with respect to the force [1/m]
      real(c_double), intent(in) :: dstiffness_dforce
      !> Traction at the start of the increment (2) [N]
      real(c_double), intent(in) :: traction_start(2)
      !> Slip since then (2) [m]
      real(c_double), intent(in) :: slip(2)
      !> Traction (2) [N], plastic slip (2) [m], dissipation [J], status
      real(c_double), intent(out) :: values(6)
      !> dT/dD (2, 2) [N/m] and dT/dF (2) [-] as columns
      real(c_double), intent(out) :: derivatives(2, 3)
      type(friction_law_t) :: law
      law = core_friction_law(mu, force, stiffness, dstiffness_dforce, friction_start_t(traction_start, force), slip)
      values = [law%traction, law%plastic_slip, law%dissipation, real(law%status, c_double)]
      derivatives(:, 1:2) = law%dtraction_dslip
      derivatives(:, 3) = law%dtraction_dforce
   end subroutine friction_law

   subroutine mindlin_ratio(young, poisson, ratio)
      !> Young's moduli (2) [Pa]
      real(c_double), intent(in) :: young(2)
      !> Poisson's ratios (2) [-]
      real(c_double), intent(in) :: poisson(2)
      !> Tangential over normal stiffness [-]
      real(c_double), intent(out) :: ratio
      ratio = core_mindlin_ratio(young, poisson)
   end subroutine mindlin_ratio

   ! Residual and tangent of the traction at given closest points. force: F, dF/dg, dF/dangle; stiffness: k_t, dk_t/dF
   ! values: traction (2), plastic slip (2), dissipation, status, slip (2); on_bar: the force on the barred wire
   subroutine contact_friction(x, t, length, axis, radius, xi_bar, xi, side, along, turned, normal_before, moved, mu, &
      force, stiffness, traction_start, k, r, values, on_bar, info)
      !> Nodal positions (3, 4) [m]: barred 1, barred 2, 1, 2
      real(c_double), intent(in) :: x(3, 4)
      !> Unit tangents of the nodes (3, 4)
      real(c_double), intent(in) :: t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(c_double), intent(in) :: length(2)
      !> Radii (2) [m]: barred, unbarred
      real(c_double), intent(in) :: radius(2)
      !> Places in the barred and the unbarred element
      real(c_double), intent(in) :: xi_bar, xi
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer(c_int), intent(in) :: axis
      !> Remembered orientation +1 or -1; 0: none
      integer(c_int), intent(in) :: side
      !> The first direction of the slip is along the sum of the unit tangents times these factors (2)
      real(c_double), intent(in) :: along(2)
      !> Rotations of the nodes since the increment began (3, 3, 4)
      real(c_double), intent(in) :: turned(3, 3, 4)
      !> Normal when it began (3)
      real(c_double), intent(in) :: normal_before(3)
      !> How far the closest points have moved since in the directions of xib and xi (2) [m]
      real(c_double), intent(in) :: moved(2)
      !> Coefficient of friction [-]
      real(c_double), intent(in) :: mu
      !> F [N], dF/dg [N/m], dF/dangle [N/rad]
      real(c_double), intent(in) :: force(3)
      !> k_t [N/m], dk_t/dF [1/m]
      real(c_double), intent(in) :: stiffness(2)
      !> Traction at the start of the increment (2) [N]
      real(c_double), intent(in) :: traction_start(2)
      !> Tangent (24, 24)
      real(c_double), intent(out) :: k(24, 24)
      !> Residual (24) [N, N m]
      real(c_double), intent(out) :: r(24)
      !> Traction (2) [N], plastic slip (2) [m], dissipation [J], status, slip (2) [m]
      real(c_double), intent(out) :: values(8)
      !> Force on the barred wire (3) [N]
      real(c_double), intent(out) :: on_bar(3)
      !> 0: all is well; else one of the constants of the kernel
      integer(c_int), intent(out) :: info
      type(contact_kinematics_t) :: kinematics
      type(wire_slip_t) :: slip
      type(friction_law_t) :: law
      k = 0
      r = 0
      values = 0
      on_bar = 0
      call core_contact_kinematics(x, t, length, axis, radius, xi_bar, xi, side, kinematics, info)
      if (info /= 0) return
      slip = wire_slip(kinematics, x, t, length, axis, radius, along, turned, normal_before, moved)
      law = core_friction_law(mu, force(1), stiffness(1), stiffness(2), friction_start_t(traction_start, force(1)), &
         slip%slip)
      r = wire_friction_residual(slip, law%traction)
      k = wire_friction_tangent(kinematics, slip, slip%dslip, t, law, &
         force(2)*kinematics%dgap + force(3)*kinematics%rows%dangle, law%traction)
      values = [law%traction, law%plastic_slip, law%dissipation, real(law%status, c_double), slip%slip]
      on_bar = -matmul(slip%frame, law%traction)
   end subroutine contact_friction

end module f2py_contact
