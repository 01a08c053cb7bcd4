!> The user element of Abaqus gives what `contact_em` gives, in its order, with its signs, and so do those of solids in
!> the plane. What else a host asks for is in test_uel_host and test_feap_host.
program test_user_elements
   use litz_kinds, only: dp
   use litz_contact_em, only: contact_em, contact_em_t, wire_pair_t, contact_laws_t, contact_active, contact_bad_data
   use litz_axis_choices, only: axis_hermite
   use litz_normal_laws, only: normal_law
   use litz_spot_laws, only: spot_law
   use litz_rotations, only: rotation_exp
   use litz_user_element, only: n_history, n_properties, n_options, history_side, history_gap, history_force, &
      history_current, history_energy
   use litz_user_surface, only: user_node_to_segment, user_segment_to_segment, n_surface_properties, surface_active
   implicit none

   real(dp), parameter :: length = 0.02_dp, radius = 1.0e-3_dp, overlap = 2.0e-6_dp, penalty = 1.0e6_dp
   real(dp), parameter :: properties(n_properties) = [radius, radius, 120.0e9_dp, 100.0e9_dp, 0.34_dp, 0.3_dp, &
      1.7e-8_dp, 2.0e-8_dp, penalty, 0.0_dp]
   integer, parameter :: tangent_and_residual = 1, tangent = 2, mass = 4, residual = 5
   real(dp) :: coordinates(3, 4), u(7, 4), k(28, 28), r(28), svars(n_history), pnewdt, elastic
   integer :: options(n_options)

   coordinates = reshape([-0.5_dp, 0.0_dp, 0.0_dp, 0.5_dp, 0.1_dp, 0.0_dp, -0.1_dp, -0.4_dp, 0.0_dp, 0.1_dp, &
      0.6_dp, 0.0_dp]*length, [3, 4])
   coordinates(3, 1:2) = 2*radius - overlap
   options = [1, 2, axis_hermite, 0, 0]                                          ! LINEAR, HERTZ
   u = 0
   u(4:6, :) = reshape([0.02_dp, -0.03_dp, 0.1_dp, -0.05_dp, 0.01_dp, 0.2_dp, 0.03_dp, 0.02_dp, -0.1_dp, 0.01_dp, &
      -0.02_dp, 0.15_dp], [3, 4])
   u(3, 1:2) = -3.0e-4_dp
   u(7, :) = [2.0e-3_dp, 1.0e-3_dp, 0.0_dp, -1.0e-3_dp]

   call test_abaqus_equals_the_kernel()
   call test_the_kernel_refuses_a_table_that_was_never_given()
   call test_the_kernel_refuses_wires_without_properties()
   call test_abaqus_gives_what_it_is_asked_for()
   call test_the_tangent_is_the_derivative()
   call test_a_pair_that_is_apart_gives_nothing()
   call test_parallel_wires_ask_for_a_shorter_increment()
   call test_surfaces_have_their_unknowns_node_by_node()

contains

   !> `ux uy v` of each node: balances, and columns that are the differences of the residual.
   subroutine test_surfaces_have_their_unknowns_node_by_node()
      real(dp), parameter :: step = 1.0e-5_dp
      real(dp) :: start(3, 4), moved(3, 4)
      real(dp) :: k_3(9, 9), r_3(9), k_4(12, 12), r_4(12), ends_3(9, 2), ends_4(12, 2)
      integer :: unknown, side, info(2)

      start = 0
      start(2, 3:4) = -0.15_dp
      start(3, :) = [1.0_dp, 1.4_dp, 0.2_dp, 0.1_dp]
      start(1, 3) = 0.5_dp
      call surfaces(start, k_3, r_3, k_4, r_4, info)
      call expect(all(info == surface_active), 'the surfaces press each other')
      do unknown = 1, 3
         call expect(near(1 + sum(r_3(unknown::3)), 1.0_dp) .and. near(1 + sum(r_4(unknown::3)), 1.0_dp) .and. &
            maxval(abs(r_4(unknown::3))) > 0.001_dp, 'forces and currents balance')
      end do
      do unknown = 1, 12
         do side = 1, 2
            moved = start + reshape([spread(0.0_dp, 1, unknown - 1), (3 - 2*side)*step, &
               spread(0.0_dp, 1, 12 - unknown)], [3, 4])
            call surfaces(moved, k_3, ends_3(:, side), k_4, ends_4(:, side), info)
         end do
         call surfaces(start, k_3, r_3, k_4, r_4, info)
         call expect(maxval(abs((ends_4(:, 1) - ends_4(:, 2))/(2*step) - k_4(:, unknown))) < 1.0e-7_dp, &
            'columns of the tangent of segments')
         if (unknown <= 9) call expect(maxval(abs((ends_3(:, 1) - ends_3(:, 2))/(2*step) - k_3(:, unknown))) &
            < 1.0e-7_dp, 'columns of the tangent of a node')
      end do
   end subroutine test_surfaces_have_their_unknowns_node_by_node

   subroutine surfaces(u, k_3, r_3, k_4, r_4, info)
      !> Displacements and voltages (3, 4)
      real(dp), intent(in) :: u(3, 4)
      !> Of the node against the segment
      real(dp), intent(out) :: k_3(9, 9), r_3(9)
      !> Of the segments
      real(dp), intent(out) :: k_4(12, 12), r_4(12)
      !> Of both
      integer, intent(out) :: info(2)
      real(dp), parameter :: corners(2, 4) = reshape([1.0_dp, 0.1_dp, 0.0_dp, 0.0_dp, -0.2_dp, 0.0_dp, 1.3_dp, &
         0.05_dp], [2, 4])
      real(dp), parameter :: given(n_surface_properties) = [3.0_dp, 2.0_dp, 0.3_dp, 0.2_dp, 0.7_dp, 0.4_dp, 5.0_dp, &
         0.0_dp, 7.0_dp, 0.2_dp, 0.3_dp, 0.0_dp]
      real(dp) :: results(5)

      call user_node_to_segment(corners(:, 1:3), u(:, 1:3), 0.6_dp, given, [1, 1], k_3, r_3, results(:3), info(1))
      call user_segment_to_segment(corners, u, [0.9_dp, 1.4_dp], given, [1, 1], k_4, r_4, results, info(2))
   end subroutine surfaces

   !> Against the kernel, entry by entry: node n has rows 7n-6 to 7n-1 and 7n.
   subroutine test_abaqus_equals_the_kernel()
      real(dp) :: k_kernel(28, 28), r_kernel(28)
      type(contact_em_t) :: contact
      integer :: info, node, other, i, j

      call call_kernel('HERTZ', k_kernel, r_kernel, contact, info)
      call expect(info == contact_active .and. contact%current > 0, 'the wires touch, and current flows')

      svars = 0
      call call_uel(tangent_and_residual, k, r)
      do node = 1, 4
         do i = 1, 6
            call expect(near(-r(7*(node - 1) + i), r_kernel(6*(node - 1) + i)), 'forces and moments at their places')
            do other = 1, 4
               do j = 1, 6
                  call expect(near(k(7*(node - 1) + i, 7*(other - 1) + j), &
                     k_kernel(6*(node - 1) + i, 6*(other - 1) + j)), 'stiffness at its place')
               end do
               call expect(near(k(7*other, 7*(node - 1) + i), k_kernel(24 + other, 6*(node - 1) + i)), 'coupling')
            end do
         end do
         call expect(near(-r(7*node), r_kernel(24 + node)), 'currents at their places')
         do other = 1, 4
            call expect(near(k(7*node, 7*other), k_kernel(24 + node, 24 + other)), 'conductances at their places')
         end do
      end do
      call expect(near(svars(history_gap), contact%gap), 'gap')
      call expect(near(svars(history_force), contact%force), 'force')
      call expect(near(svars(history_current), contact%current), 'current')
      call expect(nint(svars(history_side)) == contact%side, 'side')
      call expect(near(elastic, penalty*contact%gap**2/2), 'energy of the penalty')
      call expect(svars(history_energy) > 0, 'energy is kept')
   end subroutine test_abaqus_equals_the_kernel

   subroutine test_the_kernel_refuses_a_table_that_was_never_given()
      real(dp) :: k_kernel(28, 28), r_kernel(28)
      type(contact_em_t) :: contact
      integer :: info

      call call_kernel('TABLE', k_kernel, r_kernel, contact, info)
      call expect(info == contact_bad_data, 'no table')
   end subroutine test_the_kernel_refuses_a_table_that_was_never_given

   !> What a program that calls the kernel by itself forgets to set is zero, or anything.
   subroutine test_the_kernel_refuses_wires_without_properties()
      real(dp), parameter :: x(3, 4) = reshape([-0.01_dp, 0.0_dp, 0.001998_dp, 0.01_dp, 0.0_dp, 0.001998_dp, &
         0.0_dp, -0.01_dp, 0.0_dp, 0.0_dp, 0.01_dp, 0.0_dp], [3, 4])
      real(dp), parameter :: t(3, 4) = reshape(real([1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0], dp), [3, 4])
      real(dp) :: k_kernel(28, 28), r_kernel(28), length(2)
      type(wire_pair_t) :: wires
      type(contact_laws_t) :: laws
      type(contact_em_t) :: contact
      integer :: missing, info
      integer, parameter :: nothing = 0, radii = 1, moduli = 2, resistivities = 3, lengths = 4

      laws%normal = normal_law('HERTZ')
      laws%spot = spot_law('HERTZ')
      do missing = nothing, lengths
         wires%radius = merge(0.0_dp, 1.0e-3_dp, missing == radii)
         wires%young = merge(0.0_dp, 120.0e9_dp, missing == moduli)
         wires%poisson = 0.34_dp
         wires%resistivity = merge(0.0_dp, 1.7e-8_dp, missing == resistivities)
         length = merge(0.0_dp, 0.02_dp, missing == lengths)
         call contact_em(x, t, length, [1.0e-3_dp, 1.0e-3_dp, 0.0_dp, 0.0_dp], wires, laws, 0, k_kernel, r_kernel, &
            contact, info)
         call expect(info == merge(contact_active, contact_bad_data, missing == nothing), 'what is missing is seen')
         if (missing /= nothing) call expect(all(abs(r_kernel) <= 0), 'no forces')
      end do
   end subroutine test_the_kernel_refuses_wires_without_properties

   subroutine call_kernel(spot_name, k_kernel, r_kernel, contact, info)
      character(len=*), intent(in) :: spot_name
      real(dp), intent(out) :: k_kernel(28, 28), r_kernel(28)
      type(contact_em_t), intent(out) :: contact
      integer, intent(out) :: info
      real(dp) :: x(3, 4), t(3, 4), lengths(2)
      type(contact_laws_t) :: laws
      integer :: node, other

      lengths = [norm2(coordinates(:, 2) - coordinates(:, 1)), norm2(coordinates(:, 4) - coordinates(:, 3))]
      x = coordinates + u(1:3, :)
      do node = 1, 4
         other = (node + 1)/2*2
         t(:, node) = matmul(rotation_exp(u(4:6, node)), coordinates(:, other) - coordinates(:, other - 1))
         t(:, node) = t(:, node)/norm2(t(:, node))
      end do
      laws%normal = normal_law('LINEAR', [penalty])
      laws%spot = spot_law(spot_name)
      call contact_em(x, t, lengths, u(7, :), &
         wire_pair_t(properties(1:2), properties(3:4), properties(5:6), properties(7:8)), laws, 0, k_kernel, r_kernel, &
         contact, info)
   end subroutine call_kernel

   subroutine test_abaqus_gives_what_it_is_asked_for()
      real(dp) :: k_asked(28, 28), r_asked(28)

      call call_uel(tangent, k_asked, r_asked)
      call expect(all(near(k_asked, k)) .and. all(near(r_asked, 0.0_dp)), 'tangent alone')
      call call_uel(residual, k_asked, r_asked)
      call expect(all(near(k_asked, 0.0_dp)) .and. all(near(r_asked, r)), 'residual alone')
      call call_uel(mass, k_asked, r_asked)
      call expect(all(near(k_asked, 0.0_dp)) .and. all(near(r_asked, 0.0_dp)), 'contact has no mass')
   end subroutine test_abaqus_gives_what_it_is_asked_for

   !> Central differences of the right-hand side; truncation and round-off are near 1e-7 of the largest entry of a
   !> block.
   subroutine test_the_tangent_is_the_derivative()
      real(dp), parameter :: step = 1.0e-8_dp, allowed = 1.0e-5_dp
      real(dp) :: unused(28, 28), above(28), below(28), difference(28, 28)
      integer :: i, j, node

      options(5) = 1
      svars = 0
      call call_uel(tangent_and_residual, k, r)
      do i = 1, 28
         node = (i + 6)/7
         j = i - 7*(node - 1)
         u(j, node) = u(j, node) + step
         call call_uel(residual, unused, above)
         u(j, node) = u(j, node) - 2*step
         call call_uel(residual, unused, below)
         u(j, node) = u(j, node) + step
         difference(:, i) = -(above - below)/(2*step)
      end do
      do i = 1, 28
         do j = 1, 28
            call expect(abs(k(i, j) - difference(i, j)) <= allowed*scale_of(i, j), 'the tangent is the derivative')
         end do
      end do
      call call_uel(residual, unused, above)
   end subroutine test_the_tangent_is_the_derivative

   !> Largest entry of the tangent among those of the same unit.
   real(dp) function scale_of(i, j) result(scale)
      integer, intent(in) :: i, j
      integer :: p, q

      scale = 0
      do p = 1, 28
         do q = 1, 28
            if (kind_of(p) == kind_of(i) .and. kind_of(q) == kind_of(j)) scale = max(scale, abs(k(p, q)))
         end do
      end do
   end function scale_of

   !> 1: displacement, 2: rotation, 3: voltage
   pure integer function kind_of(i)
      integer, intent(in) :: i

      kind_of = merge(3, 1 + (mod(i - 1, 7))/3, mod(i, 7) == 0)
   end function kind_of

   subroutine test_a_pair_that_is_apart_gives_nothing()
      u(3, 1:2) = u(3, 1:2) + 10*radius
      call call_uel(tangent_and_residual, k, r)
      call expect(all(near(k, 0.0_dp)) .and. all(near(r, 0.0_dp)), 'no contact')
      call expect(svars(history_gap) > 0 .and. nint(svars(history_side)) == 0, 'the gap is told, the side forgotten')
   end subroutine test_a_pair_that_is_apart_gives_nothing

   subroutine test_parallel_wires_ask_for_a_shorter_increment()
      u = 0
      coordinates(:, 3) = coordinates(:, 1) - [0.0_dp, 0.0_dp, radius]
      coordinates(:, 4) = coordinates(:, 2) - [0.0_dp, 0.0_dp, radius]
      call call_uel(tangent_and_residual, k, r)
      call expect(pnewdt < 1, 'shorter')
   end subroutine test_parallel_wires_ask_for_a_shorter_increment

   !> As Abaqus calls a user element in a static step; the history is put back, as for every iteration.
   subroutine call_uel(wanted, amatrx, rhs)
      integer, intent(in) :: wanted
      real(dp), intent(out) :: amatrx(28, 28), rhs(28)
      real(dp) :: right(28, 1), energy(8), du(28, 1), still(28), nothing(1), none(1, 1), field(2, 1, 4)
      integer :: no_loads(1, 1)

      right = 0
      energy = 0
      du = 0
      still = 0
      nothing = 0
      none = 0
      field = 0
      no_loads = 0
      pnewdt = 1
      call uel(right, amatrx, svars, energy, 28, 1, n_history, properties, n_properties, coordinates, 3, 4, &
         reshape(u, [28]), du, still, still, 1, [1.0_dp, 1.0_dp], 1.0_dp, 1, 1, 1, nothing, 0, no_loads, none, field, &
         1, [1, 1, wanted, 0, 0], 28, none, 1, pnewdt, options, n_options, 1.0_dp)
      rhs = right(:, 1)
      elastic = energy(2)
   end subroutine call_uel

   !> Equal but for the order of the operations.
   elemental logical function near(a, b)
      real(dp), intent(in) :: a, b

      near = abs(a - b) <= 1.0e-12_dp*max(abs(a), abs(b))
   end function near

   subroutine expect(condition, what)
      logical, intent(in) :: condition
      character(len=*), intent(in) :: what

      if (condition) return
      print '(2a)', 'does not hold: ', what
      error stop 1
   end subroutine expect

end program test_user_elements
