! The contact kernels for Python; the contracts are in fortran/kernels/.
! Arrays of a table have at least one entry, also where the law does not look at them.
module f2py_contact
   use iso_c_binding, only: c_double, c_int
   use litz_elliptic, only: elliptic_t, elliptic_integrals, elliptic_integrals_complementary
   use litz_laws, only: spot_laws
   use litz_contact_spot, only: core_contact_spot => contact_spot
   use litz_normal_law, only: core_normal_force => normal_force, core_hertz_approach => hertz_approach
   use litz_closest_points, only: core_closest_points => closest_points
   use litz_contact_em, only: core_contact_em => contact_em, contact_em_t, contact_active
   use litz_contact_electricity, only: coupling_parts
   use litz_contact_kinematics, only: core_contact_kinematics => contact_kinematics, contact_kinematics_t
   use litz_contact_mechanics, only: core_contact_mechanics => contact_mechanics
   use litz_friction_law, only: friction_law_t, core_friction_law => friction_law, &
      core_mindlin_ratio => mindlin_ratio
   use litz_contact_friction, only: slip_t, slip_kinematics, friction_residual, friction_tangent
   implicit none
contains

   ! Names of the spot laws and of their values, at the places of their numbers; blank beyond the last one.
   subroutine spot_law_names(names, values)
      character(len=16), intent(out) :: names(32), values(32)
      names = ''
      values = ''
      names(:size(spot_laws)) = spot_laws%name
      values(:size(spot_laws)) = spot_laws%value_name
   end subroutine spot_law_names

   ! K, E, B, D, C, dK/dm, dE/dm at m, or with complementary /= 0 at 1 - m.
   subroutine elliptic(m, complementary, values)
      real(c_double), intent(in) :: m
      integer(c_int), intent(in) :: complementary
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
   subroutine contact_spot(law, force, radius, young, poisson, resistivity, angle, law_value, n_table, table_force, &
      table_resistance, values, info)
      integer(c_int), intent(in) :: law, n_table
      real(c_double), intent(in) :: force, radius(2), young(2), poisson(2), resistivity(2), angle, law_value
      real(c_double), intent(in) :: table_force(n_table), table_resistance(n_table)
      real(c_double), intent(out) :: values(6)
      integer(c_int), intent(out) :: info
      call core_contact_spot(law, force, radius, young, poisson, resistivity, angle, law_value, table_force, &
         table_resistance, values(1), values(2), values(3), values(4), values(5), values(6), info)
   end subroutine contact_spot

   ! values: force, dforce_dgap, dforce_dangle
   subroutine normal_force(law, penalty, gap, radius, young, poisson, angle, values, info)
      integer(c_int), intent(in) :: law
      real(c_double), intent(in) :: penalty, gap, radius(2), young(2), poisson(2), angle
      real(c_double), intent(out) :: values(3)
      integer(c_int), intent(out) :: info
      call core_normal_force(law, penalty, gap, radius, young, poisson, angle, values(1), values(2), values(3), info)
   end subroutine normal_force

   subroutine hertz_approach(force, radius, young, poisson, angle, delta, ddelta_dforce, info)
      real(c_double), intent(in) :: force, radius(2), young(2), poisson(2), angle
      real(c_double), intent(out) :: delta, ddelta_dforce
      integer(c_int), intent(out) :: info
      call core_hertz_approach(force, radius, young, poisson, angle, delta, ddelta_dforce, info)
   end subroutine hertz_approach

   ! start is looked at when has_start /= 0.
   subroutine closest_points(x, t, length, axis, has_start, start, xi_bar, xi, status)
      real(c_double), intent(in) :: x(3, 4), t(3, 4), length(2), start(2)
      integer(c_int), intent(in) :: axis, has_start
      real(c_double), intent(out) :: xi_bar, xi
      integer(c_int), intent(out) :: status
      if (has_start /= 0) then
         call core_closest_points(x, t, length, axis, xi_bar, xi, status, start)
      else
         call core_closest_points(x, t, length, axis, xi_bar, xi, status)
      end if
   end subroutine closest_points

   ! rows: dgap, dxi_bar, dxi, dcos_angle, dangle; values: distance, gap, angle, cos_angle, side
   subroutine contact_kinematics(x, t, length, axis, radius, xi_bar, xi, side, values, normal, rows, info)
      real(c_double), intent(in) :: x(3, 4), t(3, 4), length(2), radius(2), xi_bar, xi
      integer(c_int), intent(in) :: axis, side
      real(c_double), intent(out) :: values(5), normal(3), rows(24, 5)
      integer(c_int), intent(out) :: info
      type(contact_kinematics_t) :: kinematics
      call core_contact_kinematics(x, t, length, axis, radius, xi_bar, xi, side, kinematics, info)
      values = [kinematics%distance, kinematics%gap, kinematics%angle, kinematics%cos_angle, &
         real(kinematics%side, c_double)]
      normal = kinematics%normal
      rows(:, 1) = kinematics%dgap
      rows(:, 2) = kinematics%dxi_bar
      rows(:, 3) = kinematics%dxi
      rows(:, 4) = kinematics%dcos_angle
      rows(:, 5) = kinematics%dangle
   end subroutine contact_kinematics

   ! Residual and tangent at given closest points, as a driver composes them.
   subroutine contact_mechanics(x, t, length, axis, radius, xi_bar, xi, side, force, stiffness, geometric_force, form, &
      dforce_dangle, k, r, info)
      real(c_double), intent(in) :: x(3, 4), t(3, 4), length(2), radius(2), xi_bar, xi
      integer(c_int), intent(in) :: axis, side, form
      real(c_double), intent(in) :: force, stiffness, geometric_force, dforce_dangle
      real(c_double), intent(out) :: k(24, 24), r(24)
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
      real(c_double), intent(in) :: mu, force, stiffness, dstiffness_dforce, traction_start(2), slip(2)
      real(c_double), intent(out) :: values(6), derivatives(2, 3)
      type(friction_law_t) :: law
      law = core_friction_law(mu, force, stiffness, dstiffness_dforce, traction_start, slip)
      values = [law%traction, law%plastic_slip, law%dissipation, real(law%status, c_double)]
      derivatives(:, 1:2) = law%dtraction_dslip
      derivatives(:, 3) = law%dtraction_dforce
   end subroutine friction_law

   subroutine mindlin_ratio(young, poisson, ratio)
      real(c_double), intent(in) :: young(2), poisson(2)
      real(c_double), intent(out) :: ratio
      ratio = core_mindlin_ratio(young, poisson)
   end subroutine mindlin_ratio

   ! Residual and tangent of the traction at given closest points. force: F, dF/dg, dF/dangle; stiffness: k_t, dk_t/dF
   ! values: traction (2), plastic slip (2), dissipation, status; on_bar: the force on the barred wire
   subroutine contact_friction(x, t, length, axis, radius, xi_bar, xi, side, direction, moved, mu, force, stiffness, &
      traction_start, k, r, values, on_bar, info)
      real(c_double), intent(in) :: x(3, 4), t(3, 4), length(2), radius(2), xi_bar, xi
      integer(c_int), intent(in) :: axis, side, direction(2)
      real(c_double), intent(in) :: moved(2), mu, force(3), stiffness(2), traction_start(2)
      real(c_double), intent(out) :: k(24, 24), r(24), values(6), on_bar(3)
      integer(c_int), intent(out) :: info
      type(contact_kinematics_t) :: kinematics
      type(slip_t) :: slip
      type(friction_law_t) :: law
      k = 0
      r = 0
      values = 0
      on_bar = 0
      call core_contact_kinematics(x, t, length, axis, radius, xi_bar, xi, side, kinematics, info)
      if (info /= 0) return
      slip = slip_kinematics(kinematics, x, t, length, axis, direction, moved)
      law = core_friction_law(mu, force(1), stiffness(1), stiffness(2), traction_start, slip%slip)
      r = friction_residual(kinematics, slip, law%traction)
      k = friction_tangent(kinematics, slip, t, law, force(2)*kinematics%dgap + force(3)*kinematics%dangle, &
         law%traction)
      values = [law%traction, law%plastic_slip, law%dissipation, real(law%status, c_double)]
      on_bar = -matmul(slip%frame, law%traction)
   end subroutine contact_friction

   ! numbers: xi_bar, xi, gap, angle, force, semi_major, semi_minor, resistance, current, voltage_gap, side
   ! k_me: the five parts of the coupling block
   ! rotation_vectors are looked at when has_rotation_vectors /= 0.
   subroutine contact_em(x, t, length, v, radius, young, poisson, resistivity, normal_law, eps_n, spot_law, law_value, &
      n_table, table_force, table_resistance, axis, side, series_resistance, has_rotation_vectors, rotation_vectors, &
      k, r, numbers, normal, k_me, info)
      real(c_double), intent(in) :: x(3, 4), t(3, 4), length(2), v(4)
      real(c_double), intent(in) :: radius(2), young(2), poisson(2), resistivity(2)
      integer(c_int), intent(in) :: normal_law, spot_law, n_table, axis, side, has_rotation_vectors
      real(c_double), intent(in) :: eps_n, law_value, table_force(n_table), table_resistance(n_table)
      real(c_double), intent(in) :: series_resistance(2), rotation_vectors(3, 4)
      real(c_double), intent(out) :: k(28, 28), r(28), numbers(11), normal(3), k_me(4, 24, 5)
      integer(c_int), intent(out) :: info
      type(contact_em_t) :: contact
      if (has_rotation_vectors /= 0) then
         call core_contact_em(x, t, length, v, radius, young, poisson, resistivity, normal_law, eps_n, spot_law, &
            law_value, table_force, table_resistance, axis, side, series_resistance, k, r, contact, info, &
            rotation_vectors)
      else
         call core_contact_em(x, t, length, v, radius, young, poisson, resistivity, normal_law, eps_n, spot_law, &
            law_value, table_force, table_resistance, axis, side, series_resistance, k, r, contact, info)
      end if
      numbers = [contact%xi_bar, contact%xi, contact%gap, contact%angle, contact%force, contact%semi_major, &
         contact%semi_minor, contact%resistance, contact%current, contact%voltage_gap, real(contact%side, c_double)]
      normal = contact%normal
      k_me = 0
      if (info == contact_active) then
         call coupling_parts(contact%electricity, contact%kinematics, k_me(:, :, 1), k_me(:, :, 2), k_me(:, :, 3), &
            k_me(:, :, 4), k_me(:, :, 5))
      end if
   end subroutine contact_em

end module f2py_contact
