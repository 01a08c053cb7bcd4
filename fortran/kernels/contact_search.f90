!> Broad phase of the contact search: all pairs of straight segments that come near each other, in a time that grows
!> like their number.
!>
!> Boxes around the segments find the pairs whose true distance is worth computing. They are sorted into the cells of a
!> regular grid; a pair that shares several cells is reported in one of them only, the cell of the lower corner of its
!> common region.
module litz_contact_search
   use litz_kinds, only: dp
   implicit none
   private
   public :: near_segments

   !> Most grid cells per box: bounds the memory of the grid when a few boxes lie far away from the rest
   integer, parameter :: cells_per_box = 4

contains

   !> Pairs `(i, j)`, `i < j`, of segments whose distance is at most the sum of their reaches, sorted by i, then j.
   pure subroutine near_segments(a, b, reach, pairs)
      !> End points (3, n) [m]
      real(dp), intent(in) :: a(:, :), b(:, :)
      !> Half the distance at which two such segments are near (n) [m]: radius and half a skin
      real(dp), intent(in) :: reach(:)
      !> (2, number of pairs)
      integer, allocatable, intent(out) :: pairs(:, :)
      integer, allocatable :: boxes(:, :)
      logical, allocatable :: near(:)
      integer :: i, n

      call overlapping_boxes(min(a, b) - spread(reach, 1, 3), max(a, b) + spread(reach, 1, 3), boxes)
      allocate (near(size(boxes, 2)))
      do n = 1, size(boxes, 2)
         associate (p => boxes(1, n), q => boxes(2, n))
            near(n) = segment_distance(a(:, p), b(:, p), a(:, q), b(:, q)) <= reach(p) + reach(q)
         end associate
      end do
      allocate (pairs(2, count(near)))
      i = 0
      do n = 1, size(boxes, 2)
         if (.not. near(n)) cycle
         i = i + 1
         pairs(:, i) = boxes(:, n)
      end do
   end subroutine near_segments

   !> Pairs `(i, j)`, `i < j`, of closed axis-parallel boxes that have a point in common, sorted by i, then j.
   pure subroutine overlapping_boxes(lower, upper, pairs)
      !> Lower and upper corners (3, n) [m]
      real(dp), intent(in) :: lower(:, :), upper(:, :)
      !> (2, number of pairs)
      integer, allocatable, intent(out) :: pairs(:, :)
      integer, allocatable :: first(:, :), last(:, :), cell_start(:), cell_box(:)
      integer :: cells(3), n_pairs

      if (size(lower, 2) < 2) then
         allocate (pairs(2, 0))
         return
      end if
      call place_in_grid(lower, upper, cells, first, last)
      call sort_into_cells(cells, first, last, cell_start, cell_box)
      allocate (pairs(2, 0))
      call visit_pairs(lower, upper, cells, first, cell_start, cell_box, .false., pairs, n_pairs)
      deallocate (pairs)
      allocate (pairs(2, n_pairs))
      call visit_pairs(lower, upper, cells, first, cell_start, cell_box, .true., pairs, n_pairs)
      call sort_pairs(size(lower, 2), pairs)
   end subroutine overlapping_boxes

   !> Grid of cubes about as large as the mean box, and the range of cells of each box.
   pure subroutine place_in_grid(lower, upper, cells, first, last)
      real(dp), intent(in) :: lower(:, :), upper(:, :)
      integer, intent(out) :: cells(3)
      integer, allocatable, intent(out) :: first(:, :), last(:, :)
      real(dp) :: origin(3), extent(3), edge
      integer :: n, i

      n = size(lower, 2)
      origin = minval(lower, 2)
      extent = maxval(upper, 2) - origin
      edge = sum(maxval(upper - lower, 1))/n
      edge = max(edge, maxval(extent)/1.0e6_dp, tiny(edge))
      do
         cells = max(1, ceiling(extent/edge))
         if (real(cells(1), dp)*cells(2)*cells(3) <= real(cells_per_box, dp)*n + 8) exit
         edge = 1.25_dp*edge
      end do
      allocate (first(3, n), last(3, n))
      do i = 1, n
         first(:, i) = min(cells, 1 + int((lower(:, i) - origin)/edge))
         last(:, i) = min(cells, 1 + int((upper(:, i) - origin)/edge))
      end do
   end subroutine place_in_grid

   pure integer function cell_index(cells, i, j, k)
      integer, intent(in) :: cells(3), i, j, k

      cell_index = i + cells(1)*((j - 1) + cells(2)*(k - 1))
   end function cell_index

   !> Counting sort of the boxes by the cells they touch.
   pure subroutine sort_into_cells(cells, first, last, cell_start, cell_box)
      integer, intent(in) :: cells(3), first(:, :), last(:, :)
      integer, allocatable, intent(out) :: cell_start(:), cell_box(:)
      integer, allocatable :: fill(:)
      integer :: n_cells, box, i, j, k, c

      n_cells = product(cells)
      allocate (cell_start(n_cells + 1), source=0)
      do box = 1, size(first, 2)
         do k = first(3, box), last(3, box)
            do j = first(2, box), last(2, box)
               do i = first(1, box), last(1, box)
                  c = cell_index(cells, i, j, k)
                  cell_start(c + 1) = cell_start(c + 1) + 1
               end do
            end do
         end do
      end do
      cell_start(1) = 1
      do c = 1, n_cells
         cell_start(c + 1) = cell_start(c + 1) + cell_start(c)
      end do
      allocate (cell_box(cell_start(n_cells + 1) - 1))
      allocate (fill, source=cell_start)
      do box = 1, size(first, 2)
         do k = first(3, box), last(3, box)
            do j = first(2, box), last(2, box)
               do i = first(1, box), last(1, box)
                  c = cell_index(cells, i, j, k)
                  cell_box(fill(c)) = box
                  fill(c) = fill(c) + 1
               end do
            end do
         end do
      end do
   end subroutine sort_into_cells

   !> Count the overlapping pairs, and store them where asked.
   pure subroutine visit_pairs(lower, upper, cells, first, cell_start, cell_box, store, pairs, n_pairs)
      real(dp), intent(in) :: lower(:, :), upper(:, :)
      integer, intent(in) :: cells(3), first(:, :), cell_start(:), cell_box(:)
      logical, intent(in) :: store
      integer, intent(inout) :: pairs(:, :)
      integer, intent(out) :: n_pairs
      integer :: c, p, q, a, b, corner(3)

      n_pairs = 0
      do c = 1, size(cell_start) - 1
         do p = cell_start(c), cell_start(c + 1) - 2
            a = cell_box(p)
            do q = p + 1, cell_start(c + 1) - 1
               b = cell_box(q)
               if (any(lower(:, a) > upper(:, b)) .or. any(lower(:, b) > upper(:, a))) cycle
               corner = max(first(:, a), first(:, b))
               if (cell_index(cells, corner(1), corner(2), corner(3)) /= c) cycle
               n_pairs = n_pairs + 1
               if (store) pairs(:, n_pairs) = [min(a, b), max(a, b)]
            end do
         end do
      end do
   end subroutine visit_pairs

   !> Two counting sorts, by the second and then by the first box: an order that does not depend on the grid.
   pure subroutine sort_pairs(n_boxes, pairs)
      integer, intent(in) :: n_boxes
      integer, intent(inout) :: pairs(:, :)
      integer, allocatable :: sorted(:, :), start(:)
      integer :: row, i, b

      allocate (sorted, mold=pairs)
      allocate (start(n_boxes + 1))
      do row = 2, 1, -1
         start = 0
         do i = 1, size(pairs, 2)
            start(pairs(row, i) + 1) = start(pairs(row, i) + 1) + 1
         end do
         start(1) = 1
         do b = 1, n_boxes
            start(b + 1) = start(b + 1) + start(b)
         end do
         do i = 1, size(pairs, 2)
            b = pairs(row, i)
            sorted(:, start(b)) = pairs(:, i)
            start(b) = start(b) + 1
         end do
         pairs = sorted
      end do
   end subroutine sort_pairs

   !> Least distance between two straight segments, also where they are parallel or have no length.
   !>
   !> Source: minimum of a convex quadratic over the unit square, by clamping one parameter after the other.
   pure real(dp) function segment_distance(a1, a2, b1, b2) result(distance)
      !> End points (3) [m]
      real(dp), intent(in) :: a1(3), a2(3), b1(3), b2(3)
      real(dp) :: u(3), v(3), w(3), uu, uv, vv, uw, vw, s, t, determinant

      u = a2 - a1
      v = b2 - b1
      w = a1 - b1
      uu = dot_product(u, u)
      uv = dot_product(u, v)
      vv = dot_product(v, v)
      uw = dot_product(u, w)
      vw = dot_product(v, w)
      determinant = uu*vv - uv**2
      s = 0
      if (determinant > epsilon(1.0_dp)*uu*vv) s = clamp((uv*vw - vv*uw)/determinant)
      t = 0
      if (vv > 0) t = clamp((uv*s + vw)/vv)
      if (uu > 0) s = clamp((uv*t - uw)/uu)
      if (vv > 0) t = clamp((uv*s + vw)/vv)
      distance = norm2(w + s*u - t*v)

   contains

      pure real(dp) function clamp(value)
         real(dp), intent(in) :: value

         clamp = max(0.0_dp, min(1.0_dp, value))
      end function clamp

   end function segment_distance

end module litz_contact_search
