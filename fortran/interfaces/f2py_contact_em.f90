! The contact element for Python, of many pairs of elements at once; the contract is in fortran/kernels/contact_em.f90.
! The data of a law have at least one entry, also where it does not look at them.
module f2py_contact_em
   use iso_c_binding, only: c_double, c_int
   use litz_law_input, only: wire_pair_t
   use litz_normal_laws, only: find_normal_law => normal_law
   use litz_normal_yielding, only: normal_yielding
   use litz_spot_laws, only: find_spot_law => spot_law
   use litz_contact_em, only: core_contact_em => contact_em, contact_em_residual, contact_em_t, contact_laws_t, &
      contact_active
   use litz_contact_electricity, only: coupling_parts
   implicit none
   private :: chunk_of_pairs, set_laws, chunk

   !> Pairs that one thread computes before it takes more; fewer are not shared among threads
   integer, parameter :: chunk = 64
contains

   ! numbers: xi_bar, xi, gap, angle, force, semi_major, semi_minor, resistance, current, voltage_gap, side,
   ! largest_force, dent
   ! rotation_vectors are looked at when has_rotation_vectors /= 0.
   subroutine contact_em(n, n_sets, n_normal_data, n_spot_data, x, t, length, v, radius, young, poisson, resistivity, &
      side, series_resistance, ends, largest_force, rotation_vectors, normal_law, normal_data, yielding, keeps_spot, &
      spot_law, spot_data, axis, has_rotation_vectors, n_k, k, wants_k, n_parts, r, numbers, normal, k_me, info)
      !f2py threadsafe
      !> Number of pairs; of sets of data of the laws: n, or 1 for all
      integer(c_int), intent(in) :: n, n_sets
      !> Numbers that are the data of the normal law and of the spot law, at least 1
      integer(c_int), intent(in) :: n_normal_data, n_spot_data
      !> Nodal positions (3, 4, n) [m]: barred 1, barred 2, 1, 2
      real(c_double), intent(in) :: x(3, 4, n)
      !> Unit tangents of the nodes (3, 4, n)
      real(c_double), intent(in) :: t(3, 4, n)
      !> Reference lengths (2, n) [m]: barred, unbarred
      real(c_double), intent(in) :: length(2, n)
      !> Voltages of the nodes (4, n) [V]
      real(c_double), intent(in) :: v(4, n)
      !> Radii [m], Young's moduli [Pa], Poisson's ratios [-], resistivities [ohm m] (2, n): barred, unbarred
      real(c_double), intent(in) :: radius(2, n), young(2, n), poisson(2, n), resistivity(2, n)
      !> Remembered orientations +1 or -1 (n); 0: none
      integer(c_int), intent(in) :: side(n)
      !> rho L0/(4 A) (2, n) [ohm]; 0: the paper's linear voltage
      real(c_double), intent(in) :: series_resistance(2, n)
      !> Ends, -1 or 1, with which each wire touches (2, n): barred, unbarred; 0: with its side
      integer(c_int), intent(in) :: ends(2, n)
      !> Of wires that yield: the largest forces so far (n) [N]
      real(c_double), intent(in) :: largest_force(n)
      !> Rotation vectors of the nodes (3, 4, n) [rad]
      real(c_double), intent(in) :: rotation_vectors(3, 4, n)
      !> Place of the normal law in litz_normal_laws
      integer(c_int), intent(in) :: normal_law
      !> Data of the normal law (n_normal_data, n_sets)
      real(c_double), intent(in) :: normal_data(n_normal_data, n_sets)
      !> Of wires that yield (2, n_sets): yield stress [Pa], 0: they do not; hardness [Pa], 0: 2.8 times that
      real(c_double), intent(in) :: yielding(2, n_sets)
      !> Not 0: the spot stays as wide as the largest force has made it
      integer(c_int), intent(in) :: keeps_spot
      !> Place of the spot law in litz_spot_laws; 0: no current
      integer(c_int), intent(in) :: spot_law
      !> Data of the spot law (n_spot_data, n_sets), line after line
      real(c_double), intent(in) :: spot_data(n_spot_data, n_sets)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer(c_int), intent(in) :: axis
      !> Not 0: `rotation_vectors` count
      integer(c_int), intent(in) :: has_rotation_vectors
      !> Number of tangents: n, or 1 where they are not wanted; of coupling blocks in parts: n, or 0
      integer(c_int), intent(in) :: n_k, n_parts
      !> Tangents (28, 28, n_k): the only large result; Python makes room for it without filling it first
      real(c_double), intent(inout) :: k(28, 28, n_k)
      !> Not 0: the tangents are wanted
      integer(c_int), intent(in) :: wants_k
      !> Residuals (28, n) [N, N m, A]
      real(c_double), intent(out) :: r(28, n)
      !> xi_bar, xi, gap [m], angle [rad], force [N], semi-axes [m], resistance [ohm], current [A], voltage across the
      !> spot [V], side, largest force [N], dent [m] (13, n)
      real(c_double), intent(out) :: numbers(13, n)
      !> Unit normals from the unbarred to the barred axis (3, n)
      real(c_double), intent(out) :: normal(3, n)
      !> The five parts of the coupling blocks (4, 24, 5, n_parts)
      real(c_double), intent(out) :: k_me(4, 24, 5, n_parts)
      !> 0: all is well; else one of the constants of the kernel (n)
      integer(c_int), intent(out) :: info(n)
      integer :: first, last, first_set, last_set, last_k

      !$omp parallel do schedule(dynamic) private(last, first_set, last_set, last_k) if (n > chunk)
      do first = 1, n, chunk
         last = min(first + chunk - 1, n)
         first_set = min(first, n_sets)
         last_set = min(last, n_sets)
         last_k = merge(last, 0, wants_k /= 0)
         call chunk_of_pairs(last - first + 1, last_set - first_set + 1, n_normal_data, n_spot_data, &
            x(:, :, first:last), t(:, :, first:last), length(:, first:last), v(:, first:last), radius(:, first:last), &
            young(:, first:last), poisson(:, first:last), resistivity(:, first:last), side(first:last), &
            series_resistance(:, first:last), ends(:, first:last), largest_force(first:last), &
            rotation_vectors(:, :, first:last), normal_law, normal_data(:, first_set:last_set), &
            yielding(:, first_set:last_set), keeps_spot, spot_law, spot_data(:, first_set:last_set), axis, &
            has_rotation_vectors, k(:, :, first:last_k), r(:, first:last), numbers(:, first:last), &
            normal(:, first:last), k_me(:, :, :, first:min(last, n_parts)), info(first:last))
      end do
   end subroutine contact_em

   ! Some of the pairs of `contact_em`, with its arguments; without tangents or parts, `k` or `k_me` has no last extent.
   subroutine chunk_of_pairs(n, n_sets, n_normal_data, n_spot_data, x, t, length, v, radius, young, poisson, &
      resistivity, side, series_resistance, ends, largest_force, rotation_vectors, normal_law, normal_data, yielding, &
      keeps_spot, spot_law, spot_data, axis, has_rotation_vectors, k, r, numbers, normal, k_me, info)
      !> As of `contact_em`
      integer(c_int), intent(in) :: n, n_sets, n_normal_data, n_spot_data
      !> As of `contact_em`
      real(c_double), intent(in) :: x(3, 4, n), t(3, 4, n), length(2, n), v(4, n)
      !> As of `contact_em`
      real(c_double), intent(in) :: radius(2, n), young(2, n), poisson(2, n), resistivity(2, n)
      !> As of `contact_em`
      integer(c_int), intent(in) :: side(n), ends(2, n), normal_law, keeps_spot, spot_law, axis, has_rotation_vectors
      !> As of `contact_em`
      real(c_double), intent(in) :: series_resistance(2, n), largest_force(n), rotation_vectors(3, 4, n)
      !> As of `contact_em`
      real(c_double), intent(in) :: normal_data(n_normal_data, n_sets), yielding(2, n_sets), &
         spot_data(n_spot_data, n_sets)
      !> Tangents (28, 28, n) and parts of the coupling (4, 24, 5, n), or 0 in place of n; the others as of `contact_em`
      real(c_double), intent(inout) :: k(:, :, :), r(28, n), numbers(13, n), normal(3, n), k_me(:, :, :, :)
      !> As of `contact_em`
      integer(c_int), intent(inout) :: info(n)
      type(contact_em_t) :: contact
      type(wire_pair_t) :: wires
      type(contact_laws_t) :: laws
      integer :: i
      logical :: wants_tangents, wants_parts

      wants_tangents = size(k, 3) > 0
      wants_parts = size(k_me, 4) > 0
      laws%axis = axis
      laws%keeps_spot = keeps_spot /= 0
      do i = 1, n
         if (i <= n_sets) call set_laws(normal_law, normal_data(:, i), yielding(:, i), spot_law, spot_data(:, i), laws)
         laws%ends = ends(:, i)
         laws%dent_force = largest_force(i)
         wires = wire_pair_t(radius(:, i), young(:, i), poisson(:, i), resistivity(:, i), series_resistance(:, i))
         if (wants_tangents .and. has_rotation_vectors /= 0) then
            call core_contact_em(x(:, :, i), t(:, :, i), length(:, i), v(:, i), wires, laws, side(i), k(:, :, i), &
               r(:, i), contact, info(i), rotation_vectors(:, :, i))
         else if (wants_tangents) then
            call core_contact_em(x(:, :, i), t(:, :, i), length(:, i), v(:, i), wires, laws, side(i), k(:, :, i), &
               r(:, i), contact, info(i))
         else if (has_rotation_vectors /= 0) then
            call contact_em_residual(x(:, :, i), t(:, :, i), length(:, i), v(:, i), wires, laws, side(i), r(:, i), &
               contact, info(i), rotation_vectors(:, :, i))
         else
            call contact_em_residual(x(:, :, i), t(:, :, i), length(:, i), v(:, i), wires, laws, side(i), r(:, i), &
               contact, info(i))
         end if
         numbers(:, i) = [contact%xi_bar, contact%xi, contact%gap, contact%angle, contact%force, contact%semi_major, &
            contact%semi_minor, contact%resistance, contact%current, contact%voltage_gap, &
            real(contact%side, c_double), contact%largest_force, contact%dent]
         normal(:, i) = contact%normal
         if (wants_parts) k_me(:, :, :, i) = 0
         if (wants_parts .and. info(i) == contact_active) then
            call coupling_parts(contact%electricity, contact%kinematics, k_me(:, :, 1, i), k_me(:, :, 2, i), &
               k_me(:, :, 3, i), k_me(:, :, 4, i), k_me(:, :, 5, i))
         end if
      end do
   end subroutine chunk_of_pairs

   pure subroutine set_laws(normal_law, normal_data, yielding, spot_law, spot_data, laws)
      !> Places of the laws in litz_normal_laws and litz_spot_laws
      integer(c_int), intent(in) :: normal_law, spot_law
      !> Their numbers (n), line after line
      real(c_double), intent(in) :: normal_data(:), spot_data(:)
      !> Yield stress and hardness (2) [Pa]; 0: none
      real(c_double), intent(in) :: yielding(2)
      type(contact_laws_t), intent(inout) :: laws
      laws%normal = find_normal_law(normal_law, normal_data)
      if (yielding(1) > 0) laws%normal = normal_yielding(yielding(1), yielding(2))
      laws%spot = find_spot_law(spot_law, spot_data)
   end subroutine set_laws

end module f2py_contact_em
