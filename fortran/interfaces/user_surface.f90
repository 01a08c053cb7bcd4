!> Contact of solids in the plane as other finite-element programs want it: unknowns node by node, `ux uy v`.
!>
!> The kernels are litz_node_to_segment and litz_segment_to_segment, whose signs and states hold here. Bodies lie on the
!> left of the way from node 1 to node 2 of their segments.
module litz_user_surface
   use litz_kinds, only: dp
   use litz_area_law, only: body_pair_t
   use litz_area_laws, only: pressure_law, area_conductance_law
   use litz_node_to_segment, only: node_to_segment, surface_active, surface_open, surface_beyond, surface_degenerate
   use litz_segment_to_segment, only: segment_to_segment
   use litz_surface_point, only: surface_laws_t, surface_point_t
   implicit none
   private
   public :: user_node_to_segment, user_segment_to_segment, n_surface_properties
   ! what `info` may be, besides `area_bad_data` of litz_area_law
   public :: surface_active, surface_open, surface_beyond, surface_degenerate

   !> Properties, of the master and the slave: Young's moduli [Pa], Poisson's ratios [-], resistivities [ohm m]; then
   !> two numbers of the pressure law, and up to four of the conductance law, or the pairs of its table
   integer, parameter :: n_surface_properties = 12

contains

   !> Nodes: master 1, master 2, slave.
   pure subroutine user_node_to_segment(coordinates, u, area, properties, options, k, r, results, info)
      !> Positions of the nodes before loading (2, 3) [m]
      real(dp), intent(in) :: coordinates(2, 3)
      !> Displacements [m] and voltages [V] (3, 3), totals
      real(dp), intent(in) :: u(3, 3)
      !> Reference area for which the slave node stands [m^2]
      real(dp), intent(in) :: area
      !> Properties (`n_surface_properties`, with a table more)
      real(dp), intent(in) :: properties(:)
      !> Numbers of the pressure law and the conductance law in litz_area_laws (2); 0 of the latter: no current
      integer, intent(in) :: options(2)
      !> Tangent (9, 9) and residual (9), internal minus external: forces [N], currents leaving [A]
      real(dp), intent(out) :: k(9, 9), r(9)
      !> Gap [m], pressure [Pa], current from master to slave [A]
      real(dp), intent(out) :: results(3)
      !> One of the constants of the kernel
      integer, intent(out) :: info
      real(dp) :: x(2, 3), k_kernel(9, 9), r_kernel(9)
      type(surface_point_t) :: point

      x = coordinates + u(1:2, :)
      call node_to_segment(x(:, 1:2), x(:, 3), u(3, 1:2), u(3, 3), area, [0.0_dp, 0.0_dp], &
         laws_of(properties, options), k_kernel, r_kernel, point, info)
      k = k_kernel(by_node(3), by_node(3))
      r = r_kernel(by_node(3))
      results = [point%gap, point%normal%pressure, point%current]
   end subroutine user_node_to_segment

   !> Nodes: master 1, master 2, slave 1, slave 2.
   pure subroutine user_segment_to_segment(coordinates, u, width, properties, options, k, r, results, info)
      !> Positions of the nodes before loading (2, 4) [m]
      real(dp), intent(in) :: coordinates(2, 4)
      !> Displacements [m] and voltages [V] (3, 4), totals
      real(dp), intent(in) :: u(3, 4)
      !> Width of the surface at the slave nodes (2) [m]: the thickness, or 2 pi times the reference radius
      real(dp), intent(in) :: width(2)
      !> Properties (`n_surface_properties`, with a table more)
      real(dp), intent(in) :: properties(:)
      !> Numbers of the pressure law and the conductance law in litz_area_laws (2); 0 of the latter: no current
      integer, intent(in) :: options(2)
      !> Tangent (12, 12) and residual (12), internal minus external: forces [N], currents leaving [A]
      real(dp), intent(out) :: k(12, 12), r(12)
      !> Gap [m] and pressure [Pa] of the first, of the second point, current from master to slave [A]
      real(dp), intent(out) :: results(5)
      !> One of the constants of the kernel
      integer, intent(out) :: info
      real(dp) :: x(2, 4), k_kernel(12, 12), r_kernel(12), place(2)
      type(surface_point_t) :: points(2)

      x = coordinates + u(1:2, :)
      call segment_to_segment(x(:, 1:2), x(:, 3:4), u(3, 1:2), u(3, 3:4), &
         norm2(coordinates(:, 4) - coordinates(:, 3)), width, laws_of(properties, options), k_kernel, r_kernel, &
         points, place, info)
      k = k_kernel(by_node(4), by_node(4))
      r = r_kernel(by_node(4))
      results = [points(1)%gap, points(1)%normal%pressure, points(2)%gap, points(2)%normal%pressure, &
         sum(points%current)]
   end subroutine user_segment_to_segment

   !> Places of `ux uy v` of each node in the order of the kernels, displacements before voltages.
   pure function by_node(n_nodes) result(place)
      !> Nodes of the element
      integer, intent(in) :: n_nodes
      integer :: place(3*n_nodes), i

      place = [(2*i - 1, 2*i, 2*n_nodes + i, i=1, n_nodes)]
   end function by_node

   pure type(surface_laws_t) function laws_of(properties, options) result(laws)
      !> Properties (`n_surface_properties`, with a table more)
      real(dp), intent(in) :: properties(:)
      !> Numbers of the laws (2)
      integer, intent(in) :: options(2)

      laws%bodies = body_pair_t(properties(1:2), properties(3:4), properties(5:6))
      laws%normal = pressure_law(options(1), properties(7:8))
      laws%conductance = area_conductance_law(options(2), properties(9:))
   end function laws_of

end module litz_user_surface
