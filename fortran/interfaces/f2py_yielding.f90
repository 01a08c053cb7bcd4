! Contact of wires that yield, for Python; the contracts are in fortran/laws/yielding_spot.f90 and spot_resistance.f90.
! A yield stress of 0 is metal that stays elastic.
module f2py_yielding
   use iso_c_binding, only: c_double, c_int
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok
   use litz_kinds, only: pi
   use litz_spot_law, only: contact_spot_t
   use litz_spot_resistance, only: spot_metal_t, elastic_spot, yielded_spot
   use litz_yielding_spot, only: yielding_t, yielding_crossing, dent_t, dent_of_force, yielding_state_t, &
      state_at_overlap, state_at_force
   implicit none
   private :: numbers_of, beyond_elastic

   !> Yield stress over E* of metal that stays elastic: far above pressures at which the spot is smaller than a wire
   real(c_double), parameter :: beyond_elastic = 1.0e3_c_double
contains

   ! values: semi_major, semi_minor, approach, conductance, dconductance_dforce, dconductance_dangle
   subroutine spot_of_force(force, largest_force, radius, young, poisson, resistivity, angle, yield_stress, hardness, &
      mean_free_path, film, values, widest, yield_pressure, info)
      !> F, and the largest that the contact has had [N]
      real(c_double), intent(in) :: force, largest_force
      !> Radii [m], Young's moduli [Pa], Poisson's ratios [-] and resistivities [ohm m] (2): barred, unbarred
      real(c_double), intent(in) :: radius(2), young(2), poisson(2), resistivity(2)
      !> Angle between the tangents [rad]
      real(c_double), intent(in) :: angle
      !> Yield stresses (2) [Pa]; 0: none
      real(c_double), intent(in) :: yield_stress(2)
      !> H [Pa]; 0: 2.8 times the smaller yield stress
      real(c_double), intent(in) :: hardness
      !> Of the electrons (2) [m]
      real(c_double), intent(in) :: mean_free_path(2)
      !> Film resistance times area [ohm m^2]
      real(c_double), intent(in) :: film
      !> Semi-axes, approach [m], G [S], dG/dF [S/N], dG/dangle [S/rad]
      real(c_double), intent(out) :: values(6)
      !> Radius of a circle with the area of the largest spot [m], and p_Y [Pa]
      real(c_double), intent(out) :: widest, yield_pressure
      !> 0: all is well; else one of the constants of litz_hertz or litz_yielding_spot
      integer(c_int), intent(out) :: info
      type(hertz_ellipse_t) :: ellipse
      type(yielding_t) :: law
      type(dent_t) :: dent
      type(contact_spot_t) :: spot
      type(spot_metal_t) :: metal
      values = 0
      widest = 0
      yield_pressure = 0
      call hertz_ellipse(radius, young, poisson, angle, ellipse, info)
      if (info /= hertz_ok) return
      metal = spot_metal_t(resistivity, mean_free_path, film)
      if (all(yield_stress > 0)) then
         call yielding_crossing(ellipse, poisson, yield_stress, hardness, law, info)
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
   ! semi-axes, a_e; dent; energy, dissipation; derivatives of the area by overlap, angle, largest force, then of a_e
   subroutine normal_law_of_points(n, given, is_force, largest_force, radius, young, poisson, angle, yield_stress, &
      hardness, values, onset, info)
      !> Number of points
      integer(c_int), intent(in) :: n
      !> Overlaps [m], or forces [N] (n)
      real(c_double), intent(in) :: given(n)
      !> Not 0: forces
      integer(c_int), intent(in) :: is_force
      !> Largest forces that the contact has had (n) [N]
      real(c_double), intent(in) :: largest_force(n)
      !> Radii [m], Young's moduli [Pa], Poisson's ratios [-] (2): barred, unbarred
      real(c_double), intent(in) :: radius(2), young(2), poisson(2)
      !> Angle between the tangents [rad]
      real(c_double), intent(in) :: angle
      !> Yield stresses (2) [Pa]; 0: none
      real(c_double), intent(in) :: yield_stress(2)
      !> H [Pa]; 0: 2.8 times the smaller yield stress
      real(c_double), intent(in) :: hardness
      !> (18, n) in the units of the types of litz_yielding_spot
      real(c_double), intent(out) :: values(18, n)
      !> p_Y [Pa], F_Y [N], delta_Y [m], h, F_p [N]
      real(c_double), intent(out) :: onset(5)
      !> 0: all is well; else one of the constants of litz_hertz or litz_yielding_spot
      integer(c_int), intent(out) :: info
      type(hertz_ellipse_t) :: ellipse
      type(yielding_t) :: law
      type(dent_t) :: dent
      type(yielding_state_t) :: state
      real(c_double) :: stress(2)
      integer :: i
      values = 0
      onset = 0
      call hertz_ellipse(radius, young, poisson, angle, ellipse, info)
      if (info /= hertz_ok) return
      stress = yield_stress
      if (.not. all(stress > 0)) stress = beyond_elastic*ellipse%modulus
      call yielding_crossing(ellipse, poisson, stress, hardness, law, info)
      onset = [law%yield_pressure, law%force, law%overlap, law%steepness, law%force*law%plastic_force]
      if (info /= 0) return
      do i = 1, n
         dent = dent_of_force(law, largest_force(i))
         if (is_force /= 0) then
            state = state_at_force(law, dent, given(i))
         else
            state = state_at_overlap(law, dent, given(i))
         end if
         if (state%loads) dent = dent_of_force(law, state%force)
         values(:, i) = numbers_of(state, ellipse%ratio, dent%depth)
      end do
   end subroutine normal_law_of_points

   pure function numbers_of(state, ratio, depth) result(values)
      type(yielding_state_t), intent(in) :: state
      !> b/a, and the overlap at which the wires part [m]
      real(c_double), intent(in) :: ratio, depth
      !> (18)
      real(c_double) :: values(18), a
      a = sqrt(state%area/(pi*ratio))
      values = [state%overlap, state%force, state%stiffness, state%dstiffness_dforce, state%dforce, a, ratio*a, &
         state%disc, depth, state%energy, state%dissipation, state%darea, state%ddisc]
   end function numbers_of

end module f2py_yielding
