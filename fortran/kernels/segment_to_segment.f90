!> A slave segment against a master segment in the plane, electro-mechanical: what runs of solids would take.
!>
!> The slave segment is cut where the master's nodes project onto it, along the master's normal; two Gauss points on the
!> piece opposite the master are points of litz_surface_point. The pieces of one slave segment opposite neighbouring
!> masters join without gap or overlap where these are in line, so that a uniform pressure passes exactly (patch test).
!> The cuts move with the nodes, and the tangent contains that.
module litz_segment_to_segment
   use litz_kinds, only: dp
   use litz_node_to_segment, only: surface_active, surface_open, surface_beyond, surface_degenerate
   use litz_surface_point, only: slave_point_t, surface_laws_t, surface_point_t, segment_t, segment_of, &
      add_surface_point
   implicit none
   private
   public :: segment_to_segment

   !> Gauss points on [-1, 1] have weight 1
   real(dp), parameter :: gauss(2) = [-1, 1]/sqrt(3.0_dp)

   !> An end of the piece: its place on the slave segment, and the derivative of that by the displacements.
   type :: cut_t
      real(dp) :: s = 0, ds(8) = 0
   end type cut_t

contains

   pure subroutine segment_to_segment(x_bar, x, v_bar, v, length, width, laws, k, r, points, place, info)
      !> Nodes of master and slave segment (2, 2) [m]; their bodies lie on the left of the ways from node 1 to node 2
      real(dp), intent(in) :: x_bar(2, 2), x(2, 2)
      !> Their voltages (2) [V]
      real(dp), intent(in) :: v_bar(2), v(2)
      !> Reference length of the slave segment [m], and width of the surface at its nodes (2) [m]: 2 pi times the radius
      !> for bodies of revolution
      real(dp), intent(in) :: length, width(2)
      type(surface_laws_t), intent(in) :: laws
      !> Tangent (12, 12) and residual (12) in the order {master 1 (2), master 2 (2), slave 1 (2), slave 2 (2), V master
      !> (2), V slave (2)}
      real(dp), intent(out) :: k(12, 12), r(12)
      type(surface_point_t), intent(out) :: points(2)
      !> Places of the points on the slave segment, which is [-1, 1] (2)
      real(dp), intent(out) :: place(2)
      !> One of the constants of litz_node_to_segment, or `area_bad_data` of litz_area_law
      integer, intent(out) :: info
      type(segment_t) :: master, slave
      type(cut_t) :: cuts(2)
      type(slave_point_t) :: at
      integer :: i

      k = 0
      r = 0
      place = 0
      info = surface_degenerate
      master = segment_of(x_bar)
      slave = segment_of(x)
      if (.not. (master%length > 0 .and. slave%length > 0)) return
      info = surface_beyond
      ! surfaces that face each other run in opposite directions
      if (.not. dot_product(master%tangent, slave%tangent) < 0) return
      do i = 1, 2
         cuts(i) = cut_at(master, x_bar(:, i), i, x)
      end do
      ! master 2 is opposite the beginning of the slave
      if (.not. cuts(1)%s > cuts(2)%s) return

      do i = 1, 2
         at = point_between(cuts(2), cuts(1), gauss(i), length, width)
         place(i) = at%shape(2) - at%shape(1)
         call add_surface_point(master, x, v_bar, v, at, laws, k, r, points(i), info)
         if (info /= surface_active) exit
      end do
      if (info == surface_active .and. .not. any(points%normal%pressure > 0)) info = surface_open
   end subroutine segment_to_segment

   !> The point at `zeta` of the piece between two cuts.
   pure type(slave_point_t) function point_between(first, last, zeta, length, width) result(at)
      type(cut_t), intent(in) :: first, last
      !> Place on the piece, which is [-1, 1]
      real(dp), intent(in) :: zeta
      !> Reference length of the slave segment [m], and width of the surface at its nodes (2) [m]
      real(dp), intent(in) :: length, width(2)
      real(dp) :: s, ds(8), half, dhalf(8), w, dw_ds

      half = (last%s - first%s)/2
      dhalf = (last%ds - first%ds)/2
      s = (first%s + last%s)/2 + zeta*half
      ds = (first%ds + last%ds)/2 + zeta*dhalf
      w = dot_product(width, [1 - s, 1 + s])/2
      dw_ds = (width(2) - width(1))/2
      at = slave_point_t([1 - s, 1 + s]/2, [-0.5_dp, 0.5_dp], ds, half*length/2*w, length/2*(dhalf*w + half*dw_ds*ds))
   end function point_between

   !> Where a master node projects onto the slave segment: `t . (x(s) - x_j) = 0`, not beyond its ends.
   pure type(cut_t) function cut_at(master, node, number, x) result(cut)
      type(segment_t), intent(in) :: master
      !> x_j (2) [m]
      real(dp), intent(in) :: node(2)
      !> j: 1 or 2
      integer, intent(in) :: number
      !> Slave nodes (2, 2) [m]
      real(dp), intent(in) :: x(2, 2)
      real(dp) :: along, to_node(2)

      associate (t => master%tangent, n => master%normal)
         along = dot_product(t, x(:, 2) - x(:, 1))/2                             ! t . dx/ds
         cut%s = dot_product(t, node - (x(:, 1) + x(:, 2))/2)/along
         if (abs(cut%s) >= 1) then
            cut%s = sign(1.0_dp, cut%s)
            return
         end if
         to_node = node - (x(:, 1)*(1 - cut%s) + x(:, 2)*(1 + cut%s))/2
         ! dt = n (n . (dx_bar2 - dx_bar1))/l
         cut%ds(:4) = dot_product(n, to_node)/master%length*[-n, n]
         cut%ds(2*number - 1:2*number) = cut%ds(2*number - 1:2*number) + t
         cut%ds(5:) = [-t*(1 - cut%s)/2, -t*(1 + cut%s)/2]
         cut%ds = cut%ds/along
      end associate
   end function cut_at

end module litz_segment_to_segment
