!> A node against a segment in the plane, electro-mechanical: the classical element of solids in contact.
!>
!> The electric contact of the beam element was first formulated for this one. Kinematics, residual and tangent are
!> those of litz_surface_point with one slave node. A segment is half open, `-1 <= xi_bar < 1`, so that a node opposite
!> a joint of two segments is counted once; at an end of the surface `reach` takes in what is just beyond it. The
!> element does not pass the patch test: litz_segment_to_segment does.
module litz_node_to_segment
   use litz_kinds, only: dp
   use litz_surface_point, only: slave_point_t, surface_laws_t, surface_point_t, segment_t, segment_of, &
      add_surface_point
   implicit none
   private
   public :: node_to_segment
   public :: surface_active, surface_open, surface_beyond, surface_degenerate

   !> The bodies press each other
   integer, parameter :: surface_active = 0
   !> They do not, there: `k` and `r` are zero
   integer, parameter :: surface_open = 1
   !> The slave is not opposite the master segment: `k` and `r` are zero
   integer, parameter :: surface_beyond = 2
   !> The nodes of a segment coincide: `k` and `r` are zero
   integer, parameter :: surface_degenerate = -1

contains

   pure subroutine node_to_segment(x_bar, x, v_bar, v, area, reach, laws, k, r, point, info)
      !> Nodes of the master segment (2, 2) and the slave node (2) [m]
      real(dp), intent(in) :: x_bar(2, 2), x(2)
      !> Their voltages (2), scalar [V]
      real(dp), intent(in) :: v_bar(2), v
      !> Reference area for which the node stands [m^2]
      real(dp), intent(in) :: area
      !> How far the segment goes on straight beyond its nodes, in lengths of the segment (2)
      real(dp), intent(in) :: reach(2)
      type(surface_laws_t), intent(in) :: laws
      !> Tangent (9, 9) and residual (9) in the order {master 1 (2), master 2 (2), slave (2), V master (2), V slave}
      real(dp), intent(out) :: k(9, 9), r(9)
      type(surface_point_t), intent(out) :: point
      !> One of the constants above, or `area_bad_data` of litz_area_law
      integer, intent(out) :: info
      type(segment_t) :: segment
      type(slave_point_t) :: at

      k = 0
      r = 0
      info = surface_degenerate
      segment = segment_of(x_bar)
      if (.not. segment%length > 0) return
      point%xi_bar = 2*dot_product(segment%tangent, x - segment%origin)/segment%length - 1
      info = surface_beyond
      if (point%xi_bar < -1 - 2*reach(1) .or. point%xi_bar >= 1 + 2*reach(2)) return

      at = slave_point_t([1.0_dp], [0.0_dp], spread(0.0_dp, 1, 6), area, spread(0.0_dp, 1, 6))
      call add_surface_point(segment, reshape(x, [2, 1]), v_bar, [v], at, laws, k, r, point, info)
      if (info == surface_active .and. .not. point%normal%pressure > 0) info = surface_open
   end subroutine node_to_segment

end module litz_node_to_segment
