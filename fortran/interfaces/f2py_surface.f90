! The kernels of surfaces in the plane for Python, of many at once; the contracts are in
! fortran/kernels/node_to_segment.f90 and fortran/kernels/segment_to_segment.f90, the laws in fortran/laws/area_law.f90.
! The data of a law have at least one entry, also where it does not look at them.
module f2py_surface
   use iso_c_binding, only: c_double, c_int
   use litz_area_law, only: pressure_law_t, area_conductance_law_t, body_pair_t
   use litz_area_laws, only: pressure_law, area_conductance_law
   use litz_node_to_segment, only: core_node_to_segment => node_to_segment
   use litz_segment_to_segment, only: core_segment_to_segment => segment_to_segment
   use litz_surface_point, only: surface_laws_t, surface_point_t, segment_t, segment_of
   implicit none
   private :: laws_of
contains

   ! Names of the pressure laws and of their numbers, at the places of the laws; blank beyond the last one.
   subroutine pressure_law_names(names, values, augmented)
      !> Names in capitals, blank beyond the last one
      character(len=16), intent(out) :: names(32)
      !> Names of the numbers that are their data (place, law), blank where there is none
      character(len=16), intent(out) :: values(4, 32)
      !> Not 0: takes a pressure of augmentation
      integer(c_int), intent(out) :: augmented(32)
      type(pressure_law_t) :: law
      integer :: i
      do i = 1, 32
         law = pressure_law(i)
         names(i) = law%name
         values(:, i) = law%fields%name
         augmented(i) = merge(1, 0, law%can_be_augmented)
      end do
   end subroutine pressure_law_names

   ! The same of the conductance laws.
   subroutine conductance_law_names(names, values, looks_at)
      !> Names in capitals, blank beyond the last one
      character(len=16), intent(out) :: names(32)
      !> Names of the numbers that are their data (place, law), blank where there is none
      character(len=16), intent(out) :: values(4, 32)
      !> Not 0: it uses resistivities, elastic constants, a table (3, law)
      integer(c_int), intent(out) :: looks_at(3, 32)
      type(area_conductance_law_t) :: law
      integer :: i
      do i = 1, 32
         law = area_conductance_law(i)
         names(i) = law%name
         values(:, i) = law%fields%name
         looks_at(:, i) = merge(1, 0, [law%uses_resistivity, law%uses_elasticity, law%has_table])
      end do
   end subroutine conductance_law_names

   pure function laws_of(normal, normal_data, spot, spot_data, bodies) result(laws)
      !> Places of the laws in litz_area_laws; 0 of the second: no current
      integer(c_int), intent(in) :: normal, spot
      !> Their data (n)
      real(c_double), intent(in) :: normal_data(:), spot_data(:)
      !> Young's moduli [Pa], Poisson's ratios, resistivities [ohm m] (2, 3)
      real(c_double), intent(in) :: bodies(2, 3)
      type(surface_laws_t) :: laws
      laws%normal = pressure_law(normal, normal_data)
      laws%conductance = area_conductance_law(spot, spot_data)
      laws%bodies = body_pair_t(bodies(:, 1), bodies(:, 2), bodies(:, 3))
   end function laws_of

   ! numbers: xi_bar, gap, pressure, h, current, voltage_gap
   subroutine node_to_segment(n, n_sets, x_bar, x, v_bar, v, area, reach, augmentation, normal_law, n_normal, &
      normal_data, spot_law, n_spot, spot_data, bodies, k, r, numbers, normal, info)
      !f2py threadsafe
      !> Number of pairs; of sets of data of the laws: n, or 1 for all
      integer(c_int), intent(in) :: n, n_sets
      !> Nodes of the master segments (2, 2, n) [m]
      real(c_double), intent(in) :: x_bar(2, 2, n)
      !> Slave nodes (2, n) [m]
      real(c_double), intent(in) :: x(2, n)
      !> Voltages of the masters (2, n) [V]
      real(c_double), intent(in) :: v_bar(2, n)
      !> Voltages of the slaves (n) [V]
      real(c_double), intent(in) :: v(n)
      !> Reference areas (n) [m^2]
      real(c_double), intent(in) :: area(n)
      !> How far the segments go on beyond their nodes, in lengths of the segments (2, n)
      real(c_double), intent(in) :: reach(2, n)
      !> Pressures of augmentation (n) [Pa]
      real(c_double), intent(in) :: augmentation(n)
      !> Place of the pressure law in litz_area_laws
      integer(c_int), intent(in) :: normal_law
      !> Numbers that are its data, at least 1
      integer(c_int), intent(in) :: n_normal
      !> Its data (n_normal, n_sets)
      real(c_double), intent(in) :: normal_data(n_normal, n_sets)
      !> Place of the conductance law there; 0: no current
      integer(c_int), intent(in) :: spot_law
      !> Numbers that are its data, at least 1
      integer(c_int), intent(in) :: n_spot
      !> Its data (n_spot, n_sets)
      real(c_double), intent(in) :: spot_data(n_spot, n_sets)
      !> Young's moduli [Pa], Poisson's ratios, resistivities [ohm m] (2, 3, n_sets): barred, unbarred
      real(c_double), intent(in) :: bodies(2, 3, n_sets)
      !> Tangents (9, 9, n)
      real(c_double), intent(out) :: k(9, 9, n)
      !> Residuals (9, n) [N, A]
      real(c_double), intent(out) :: r(9, n)
      !> See above (6, n)
      real(c_double), intent(out) :: numbers(6, n)
      !> Unit normals, into the masters' bodies (2, n)
      real(c_double), intent(out) :: normal(2, n)
      !> 0: all is well; else one of the constants of the kernel (n)
      integer(c_int), intent(out) :: info(n)
      type(surface_point_t) :: point
      type(segment_t) :: segment
      type(surface_laws_t) :: laws
      integer :: i
      do i = 1, n
         if (i <= n_sets) laws = laws_of(normal_law, normal_data(:, i), spot_law, spot_data(:, i), bodies(:, :, i))
         laws%augmentation = augmentation(i)
         call core_node_to_segment(x_bar(:, :, i), x(:, i), v_bar(:, i), v(i), area(i), reach(:, i), &
            laws, k(:, :, i), r(:, i), &
            point, info(i))
         numbers(:, i) = [point%xi_bar, point%gap, point%normal%pressure, point%spot%conductance, point%current, &
            point%voltage_gap]
         segment = segment_of(x_bar(:, :, i))
         normal(:, i) = segment%normal
      end do
   end subroutine node_to_segment

   ! numbers of both points: xi_bar, xi, gap, area, pressure, h, current, voltage_gap
   subroutine segment_to_segment(n, n_sets, x_bar, x, v_bar, v, length, width, augmentation, normal_law, n_normal, &
      normal_data, spot_law, n_spot, spot_data, bodies, k, r, numbers, normal, info)
      !f2py threadsafe
      !> Number of pairs; of sets of data of the laws: n, or 1 for all
      integer(c_int), intent(in) :: n, n_sets
      !> Nodes of the master segments (2, 2, n) [m]
      real(c_double), intent(in) :: x_bar(2, 2, n)
      !> Nodes of the slave segments (2, 2, n) [m]
      real(c_double), intent(in) :: x(2, 2, n)
      !> Voltages of the masters (2, n) [V]
      real(c_double), intent(in) :: v_bar(2, n)
      !> Voltages of the slaves (2, n) [V]
      real(c_double), intent(in) :: v(2, n)
      !> Reference lengths of the slaves (n) [m]
      real(c_double), intent(in) :: length(n)
      !> Widths at the nodes of the slaves (2, n) [m]
      real(c_double), intent(in) :: width(2, n)
      !> Pressures of augmentation (n) [Pa]
      real(c_double), intent(in) :: augmentation(n)
      !> Place of the pressure law in litz_area_laws
      integer(c_int), intent(in) :: normal_law
      !> Numbers that are its data, at least 1
      integer(c_int), intent(in) :: n_normal
      !> Its data (n_normal, n_sets)
      real(c_double), intent(in) :: normal_data(n_normal, n_sets)
      !> Place of the conductance law there; 0: no current
      integer(c_int), intent(in) :: spot_law
      !> Numbers that are its data, at least 1
      integer(c_int), intent(in) :: n_spot
      !> Its data (n_spot, n_sets)
      real(c_double), intent(in) :: spot_data(n_spot, n_sets)
      !> Young's moduli [Pa], Poisson's ratios, resistivities [ohm m] (2, 3, n_sets): barred, unbarred
      real(c_double), intent(in) :: bodies(2, 3, n_sets)
      !> Tangents (12, 12, n)
      real(c_double), intent(out) :: k(12, 12, n)
      !> Residuals (12, n) [N, A]
      real(c_double), intent(out) :: r(12, n)
      !> See above (8, 2, n)
      real(c_double), intent(out) :: numbers(8, 2, n)
      !> Unit normals, into the masters' bodies (2, n)
      real(c_double), intent(out) :: normal(2, n)
      !> 0: all is well; else one of the constants of the kernel (n)
      integer(c_int), intent(out) :: info(n)
      type(surface_point_t) :: points(2)
      type(segment_t) :: segment
      type(surface_laws_t) :: laws
      real(c_double) :: place(2)
      integer :: i, j
      do i = 1, n
         if (i <= n_sets) laws = laws_of(normal_law, normal_data(:, i), spot_law, spot_data(:, i), bodies(:, :, i))
         laws%augmentation = augmentation(i)
         call core_segment_to_segment(x_bar(:, :, i), x(:, :, i), v_bar(:, i), v(:, i), length(i), width(:, i), &
            laws, k(:, :, i), r(:, i), &
            points, place, info(i))
         do j = 1, 2
            numbers(:, j, i) = [points(j)%xi_bar, place(j), points(j)%gap, points(j)%area, &
               points(j)%normal%pressure, points(j)%spot%conductance, points(j)%current, points(j)%voltage_gap]
         end do
         segment = segment_of(x_bar(:, :, i))
         normal(:, i) = segment%normal
      end do
   end subroutine segment_to_segment

end module f2py_surface
