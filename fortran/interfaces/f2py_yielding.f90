! Contact of wires that yield, for Python; the contracts are in fortran/laws/yielding_spot.f90 and dent_spot.f90.
! A yield stress of 0 is metal that stays elastic.
module f2py_yielding
   use iso_c_binding, only: c_double, c_int
   use litz_dent_spot, only: yielded_spot
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok
   use litz_kinds, only: pi
   use litz_law_input, only: wire_pair_t
   use litz_line_law, only: line_wires, line_spot_t
   use litz_spot_law, only: contact_spot_t
   use litz_spot_resistance, only: spot_metal_t, elastic_spot
   use litz_yielding_line, only: yielding_line_t, yielding_line, line_dent_t, line_dent, line_state_t, &
      line_state_at_force, line_state_at_overlap, yielded_strip
   use litz_yielding_spot, only: yielding_t, yielding_crossing, dent_t, dent_of_force, yielding_state_t, &
      state_at_overlap, state_at_force, core_largest_onset => largest_onset
   implicit none
   private :: numbers_of, spot_of_force, crossing, beyond_elastic

   !> Yield stress over E* of metal that stays elastic: far above pressures at which the spot is smaller than a wire
   real(c_double), parameter :: beyond_elastic = 1.0e3_c_double
contains

   ! values: semi_major, semi_minor, approach, conductance, dconductance_dforce, dconductance_dangle
   subroutine spots_of_forces(n, force, largest_force, radius, young, poisson, resistivity, angle, yield_stress, &
      hardness, mean_free_path, film, values, widest, yield_pressure, info)
      !f2py threadsafe
      !> Number of contacts
      integer(c_int), intent(in) :: n
      !> F, and the largest that each contact has had (n) [N]
      real(c_double), intent(in) :: force(n), largest_force(n)
      !> Radii [m], Young's moduli [Pa], Poisson's ratios [-] and resistivities [ohm m] (2, n): barred, unbarred
      real(c_double), intent(in) :: radius(2, n), young(2, n), poisson(2, n), resistivity(2, n)
      !> Angles between the tangents (n) [rad]
      real(c_double), intent(in) :: angle(n)
      !> Yield stresses (2, n) [Pa]; 0: none
      real(c_double), intent(in) :: yield_stress(2, n)
      !> H (n) [Pa]; 0: 2.8 times the smaller yield stress
      real(c_double), intent(in) :: hardness(n)
      !> Of the electrons (2, n) [m]
      real(c_double), intent(in) :: mean_free_path(2, n)
      !> Film resistances times area (n) [ohm m^2]
      real(c_double), intent(in) :: film(n)
      !> Semi-axes, approach [m], G [S], dG/dF [S/N], dG/dangle [S/rad] (6, n)
      real(c_double), intent(out) :: values(6, n)
      !> Radii of circles with the area of the largest spot [m], and p_Y [Pa] (n)
      real(c_double), intent(out) :: widest(n), yield_pressure(n)
      !> 0: all is well; else one of the constants of litz_hertz or litz_yielding_spot (n)
      integer(c_int), intent(out) :: info(n)
      integer :: i
      do i = 1, n
         call spot_of_force(force(i), largest_force(i), wire_pair_t(radius(:, i), young(:, i), poisson(:, i), &
            resistivity(:, i)), angle(i), yield_stress(:, i), hardness(i), mean_free_path(:, i), film(i), &
            values(:, i), widest(i), yield_pressure(i), info(i))
      end do
   end subroutine spots_of_forces

   subroutine spot_of_force(force, largest_force, wires, angle, yield_stress, hardness, mean_free_path, film, values, &
      widest, yield_pressure, info)
      !> As of `spots_of_forces`
      real(c_double), intent(in) :: force, largest_force, angle, yield_stress(2), hardness, mean_free_path(2), film
      type(wire_pair_t), intent(in) :: wires
      !> As of `spots_of_forces`
      real(c_double), intent(out) :: values(6), widest, yield_pressure
      !> As of `spots_of_forces`
      integer(c_int), intent(out) :: info
      type(hertz_ellipse_t) :: ellipse
      type(yielding_t) :: law
      type(dent_t) :: dent
      type(contact_spot_t) :: spot
      type(spot_metal_t) :: metal
      values = 0
      widest = 0
      yield_pressure = 0
      call hertz_ellipse(wires%radius, wires%young, wires%poisson, angle, ellipse, info)
      if (info /= hertz_ok) return
      metal = spot_metal_t(wires%resistivity, wires%resistivity*mean_free_path, film)
      if (all(yield_stress > 0)) then
         call yielding_crossing(ellipse, wires%poisson, yield_stress, hardness, law, info)
         yield_pressure = law%yield_pressure
         if (info /= 0 .or. .not. force > 0) return
         dent = dent_of_force(law, max(force, largest_force))
         widest = sqrt(dent%area/pi)
         spot = yielded_spot(law, dent, ellipse%ratio, force, metal)
      else
         if (force > 0) spot = elastic_spot(ellipse, force, metal)
      end if
      values = [spot%semi_major, spot%semi_minor, spot%approach, spot%conductance, spot%dconductance_dforce, &
         spot%dconductance_dangle]
   end subroutine spot_of_force

   ! values: overlap, force, stiffness, its derivative by the force; dF by the angle and by the largest force;
   ! semi-axes, a_e; dent; energy, dissipation; derivatives of the area by overlap, angle, largest force, then of a_e;
   ! that of the energy by the largest force; radius of a circle as large as the spot of the largest force
   subroutine normal_law_of_points(n, n_sets, given, is_force, largest_force, radius, young, poisson, angle, &
      yield_stress, hardness, values, onset, info)
      !f2py threadsafe
      !> Number of points; of crossings: n, or 1 for all
      integer(c_int), intent(in) :: n, n_sets
      !> Overlaps [m], or forces [N] (n)
      real(c_double), intent(in) :: given(n)
      !> Not 0: forces
      integer(c_int), intent(in) :: is_force
      !> Largest forces that the contact has had (n) [N]
      real(c_double), intent(in) :: largest_force(n)
      !> Radii [m], Young's moduli [Pa], Poisson's ratios [-] (2, n_sets): barred, unbarred
      real(c_double), intent(in) :: radius(2, n_sets), young(2, n_sets), poisson(2, n_sets)
      !> Angles between the tangents (n_sets) [rad]
      real(c_double), intent(in) :: angle(n_sets)
      !> Yield stresses (2, n_sets) [Pa]; 0: none
      real(c_double), intent(in) :: yield_stress(2, n_sets)
      !> H (n_sets) [Pa]; 0: 2.8 times the smaller yield stress
      real(c_double), intent(in) :: hardness(n_sets)
      !> (20, n) in the units of the types of litz_yielding_spot
      real(c_double), intent(out) :: values(20, n)
      !> p_Y [Pa], F_Y [N], delta_Y [m], h, F_p [N] (5, n_sets)
      real(c_double), intent(out) :: onset(5, n_sets)
      !> 0: all is well; else one of the constants of litz_hertz or litz_yielding_spot (n_sets)
      integer(c_int), intent(out) :: info(n_sets)
      type(hertz_ellipse_t) :: ellipse
      type(yielding_t) :: law
      type(dent_t) :: dent
      type(yielding_state_t) :: state
      integer :: i
      values = 0
      do i = 1, n
         if (i <= n_sets) call crossing(radius(:, i), young(:, i), poisson(:, i), angle(i), yield_stress(:, i), &
            hardness(i), ellipse, law, onset(:, i), info(i))
         if (info(min(i, n_sets)) /= 0) cycle
         dent = dent_of_force(law, largest_force(i))
         if (is_force /= 0) then
            state = state_at_force(law, dent, given(i))
         else
            state = state_at_overlap(law, dent, given(i))
         end if
         if (state%loads) dent = dent_of_force(law, state%force)
         values(:, i) = numbers_of(state, ellipse%ratio, dent)
      end do
   end subroutine normal_law_of_points

   subroutine crossing(radius, young, poisson, angle, yield_stress, hardness, ellipse, law, onset, info)
      !> As of `normal_law_of_points`
      real(c_double), intent(in) :: radius(2), young(2), poisson(2), angle, yield_stress(2), hardness
      type(hertz_ellipse_t), intent(out) :: ellipse
      type(yielding_t), intent(out) :: law
      !> As of `normal_law_of_points`
      real(c_double), intent(out) :: onset(5)
      !> As of `normal_law_of_points`
      integer(c_int), intent(out) :: info
      real(c_double) :: stress(2)
      onset = 0
      call hertz_ellipse(radius, young, poisson, angle, ellipse, info)
      if (info /= hertz_ok) return
      stress = yield_stress
      if (.not. all(stress > 0)) stress = beyond_elastic*ellipse%modulus
      call yielding_crossing(ellipse, poisson, stress, hardness, law, info)
      onset = [law%yield_pressure, law%force, law%overlap, law%steepness, law%force*law%plastic_force]
   end subroutine crossing

   ! values: force, overlap, doverlap/dforce, b, g', dg'/dforce, dent
   subroutine line_law_of_points(n, given, is_overlap, largest_force, radius, young, poisson, resistivity, angle, &
      film, yield_stress, hardness, values, onset, too_wide)
      !> Number of points
      integer(c_int), intent(in) :: n
      !> Forces per length [N/m], or overlaps [m] (n)
      real(c_double), intent(in) :: given(n)
      !> Not 0: overlaps
      integer(c_int), intent(in) :: is_overlap
      !> Largest forces per length so far (n) [N/m]
      real(c_double), intent(in) :: largest_force(n)
      !> Radii [m], Young's moduli [Pa], Poisson's ratios [-] and resistivities [ohm m] (2, n): barred, unbarred
      real(c_double), intent(in) :: radius(2, n), young(2, n), poisson(2, n), resistivity(2, n)
      !> Angles between the axes [rad] (n)
      real(c_double), intent(in) :: angle(n)
      !> Film resistances times area (n) [ohm m^2]
      real(c_double), intent(in) :: film(n)
      !> Yield stresses (2, n) [Pa]
      real(c_double), intent(in) :: yield_stress(2, n)
      !> H (n) [Pa]; 0: 2.8 times the smaller yield stress
      real(c_double), intent(in) :: hardness(n)
      !> f [N/m], delta [m], ddelta/df [m^2/N], b [m], g' [S/m], dg'/df [S/N], dent [m] (7, n)
      real(c_double), intent(out) :: values(7, n)
      !> p_Y of parallel wires [Pa], force per length at the onset [N/m], b_Y of parallel wires [m] (3, n)
      real(c_double), intent(out) :: onset(3, n)
      !> Not 0: the strip is wider than the law holds for (n)
      integer(c_int), intent(out) :: too_wide(n)
      type(wire_pair_t) :: wires
      type(yielding_line_t) :: law
      type(line_dent_t) :: dent
      type(line_state_t) :: state
      type(line_spot_t) :: spot
      integer :: i
      values = 0
      do i = 1, n
         wires = wire_pair_t(radius(:, i), young(:, i), poisson(:, i), resistivity(:, i))
         law = yielding_line(line_wires(wires, angle(i)), wires, yield_stress(:, i), hardness(i), angle(i))
         onset(:, i) = [law%yield_pressure, law%onset, law%half_width]
         dent = line_dent(law, largest_force(i))
         if (is_overlap /= 0) then
            state = line_state_at_overlap(law, dent, given(i))
         else
            state = line_state_at_force(law, dent, given(i))
         end if
         if (state%loads) dent = line_dent(law, state%force)
         too_wide(i) = merge(1, 0, state%too_wide)
         values([2, 7], i) = [state%overlap, dent%depth]
         spot = yielded_strip(law, state, film(i))
         if (state%force > 0) values(:6, i) = [state%force, state%overlap, 1/state%stiffness, state%half_width, &
            spot%conductance, spot%dconductance_dforce]
      end do
   end subroutine line_law_of_points

   ! Pressure at the onset of yielding at most
   subroutine largest_onset(n, yield_stress, onset)
      !> Number of metals
      integer(c_int), intent(in) :: n
      !> (n) [Pa]
      real(c_double), intent(in) :: yield_stress(n)
      !> (n) [Pa]
      real(c_double), intent(out) :: onset(n)
      integer :: i
      do i = 1, n
         onset(i) = core_largest_onset(yield_stress(i))
      end do
   end subroutine largest_onset

   pure function numbers_of(state, ratio, dent) result(values)
      type(yielding_state_t), intent(in) :: state
      !> b/a
      real(c_double), intent(in) :: ratio
      !> That it leaves
      type(dent_t), intent(in) :: dent
      !> (20)
      real(c_double) :: values(20), a
      a = sqrt(state%area/(pi*ratio))
      values = [state%overlap, state%force, state%stiffness, state%dstiffness_dforce, state%dforce, a, ratio*a, &
         state%disc, dent%depth, state%energy, state%dissipation, state%darea, state%ddisc, &
         state%denergy_dlargest, sqrt(dent%area/pi)]
   end function numbers_of

end module f2py_yielding
