!> Broad phase of the contact search: all pairs of straight segments that come near each other, in a time that grows
!> like their number, whatever mixture of lengths and thicknesses they have.
!>
!> Segments are cut into pieces not much longer than the mean segment, so that their boxes hug them. The boxes are sorted
!> by size into grids whose cells are as large as their largest box; a box lies in the one cell of its lower corner. So
!> it can only meet boxes of the cells around it in its own grid, and of a few cells in each grid of larger boxes.
!> The cells of a grid are folded onto a table with an entry or two per box: empty space costs nothing.
module litz_contact_search
   use litz_kinds, only: dp, int64
   use litz_parallel, only: worth_threads
!$ use omp_lib, only: omp_get_max_threads, omp_get_thread_num
   implicit none
   private
   public :: near_segments

   !> A segment is cut where it is longer than this many times its reach, and than this fraction of the mean length
   real(dp), parameter :: longest_in_reaches = 16.0_dp, longest_in_means = 0.25_dp

   !> Boxes smaller than the largest by more than this power of two share the last grid
   integer, parameter :: most_grids = 24

   !> Boxes of like size, sorted by cell.
   type :: grid_t
      !> Lower corner of the cell (1, 1, 1), and length of a cell [m]
      real(dp) :: origin(3) = 0, edge = 1
      !> Number of cells along each direction, with an empty one on both sides
      integer(int64) :: cells(3) = 0
      !> Entries of the table, a power of two, less one
      integer(int64) :: mask = 0
      !> (0:mask + 1) first box of each entry of the table
      integer, allocatable :: start(:)
      !> Cell and segment of each box, and its lower and upper corner (6, boxes)
      integer(int64), allocatable :: cell(:)
      integer, allocatable :: segment(:)
      real(dp), allocatable :: corners(:, :)
      !> Ends and reach of the segment of each box (7, boxes): a copy that lies where it is wanted
      real(dp), allocatable :: ends(:, :)
   end type grid_t

   !> Pairs that one thread has found.
   type :: pair_list_t
      integer :: n = 0
      !> (2, at least n)
      integer, allocatable :: pairs(:, :)
   end type pair_list_t

contains

   !> Pairs `(i, j)`, `i < j`, of segments whose distance is at most the sum of their reaches, sorted by i, then j.
   subroutine near_segments(a, b, reach, pairs)
      !> End points (3, n) [m]
      real(dp), intent(in) :: a(:, :), b(:, :)
      !> Half the distance at which two such segments are near (n) [m]: radius and half a skin
      real(dp), intent(in) :: reach(:)
      !> (2, number of pairs)
      integer, allocatable, intent(out) :: pairs(:, :)
      type(grid_t), allocatable :: grids(:)
      type(pair_list_t), allocatable :: lists(:)
      integer :: g, box, threads, thread

      call build_grids(a, b, reach, grids)
      threads = 1
!$    threads = omp_get_max_threads()
      allocate (lists(threads))
      !$omp parallel private(thread, g, box) if (size(reach) >= worth_threads)
      thread = 1
!$    thread = omp_get_thread_num() + 1
      allocate (lists(thread)%pairs(2, 64))
      do g = 1, size(grids)
         !$omp do schedule(dynamic, 256)
         do box = 1, size(grids(g)%segment)
            call visit_own_grid(a, b, reach, grids(g), box, lists(thread))
            call visit_coarser_grids(a, b, reach, grids, g, box, lists(thread))
         end do
         !$omp end do nowait
      end do
      !$omp end parallel
      call sort_pairs(size(reach), lists, pairs)
   end subroutine near_segments

   !> Pieces of all segments, sorted into grids of decreasing box size.
   subroutine build_grids(a, b, reach, grids)
      real(dp), intent(in) :: a(:, :), b(:, :), reach(:)
      type(grid_t), allocatable, intent(out) :: grids(:)
      real(dp), allocatable :: length(:), lower(:, :), upper(:, :), extent(:)
      integer, allocatable :: segment(:), level(:), members(:)
      real(dp) :: mean, largest
      integer :: i, g, n, first(most_grids + 1), free(most_grids)

      n = size(reach)
      allocate (length(n))
      !$omp parallel do schedule(static) if (n >= worth_threads)
      do i = 1, n
         length(i) = norm2(b(:, i) - a(:, i))
      end do
      !$omp end parallel do
      mean = sum(length)/max(1, n)
      call cut_segments(a, b, reach, length, longest_in_means*mean, segment, lower, upper)

      n = size(segment)
      allocate (extent(n), level(n), members(n))
      largest = 0
      !$omp parallel do schedule(static) reduction(max: largest) if (n >= worth_threads)
      do i = 1, n
         extent(i) = max(maxval(upper(:, i) - lower(:, i)), tiny(1.0_dp))
         largest = max(largest, extent(i))
      end do
      !$omp end parallel do
      !$omp parallel do schedule(static) if (n >= worth_threads)
      do i = 1, n
         level(i) = min(most_grids, exponent(largest/extent(i)))
      end do
      !$omp end parallel do
      call count_by(level, first)
      free = first(:most_grids)
      do i = 1, n
         members(free(level(i))) = i
         free(level(i)) = free(level(i)) + 1
      end do
      allocate (grids(count(first(2:) > first(:most_grids))))
      n = 0
      do g = 1, most_grids
         if (first(g + 1) == first(g)) cycle
         n = n + 1
         call build_grid(members(first(g):first(g + 1) - 1), a, b, reach, segment, lower, upper, grids(n))
      end do
   end subroutine build_grids

   !> First place of each value 1, 2, ... when the values are sorted, and one past the last place.
   pure subroutine count_by(values, first)
      integer, intent(in) :: values(:)
      integer, intent(out) :: first(:)
      integer :: i

      first = 0
      do i = 1, size(values)
         first(values(i) + 1) = first(values(i) + 1) + 1
      end do
      first(1) = 1
      do i = 1, size(first) - 1
         first(i + 1) = first(i) + first(i + 1)
      end do
   end subroutine count_by

   !> Boxes around the pieces of all segments.
   subroutine cut_segments(a, b, reach, length, longest, segment, lower, upper)
      real(dp), intent(in) :: a(:, :), b(:, :), reach(:)
      !> Of each segment, and of a piece that is longer than thick [m]
      real(dp), intent(in) :: length(:), longest
      !> Segment of each piece, and corners of its box (3, pieces) [m]
      integer, allocatable, intent(out) :: segment(:)
      real(dp), allocatable, intent(out) :: lower(:, :), upper(:, :)
      real(dp) :: p(3), q(3)
      integer :: i, k, pieces, n
      integer, allocatable :: first(:)

      allocate (first(size(reach) + 1))
      first(1) = 1
      do i = 1, size(reach)
         first(i + 1) = first(i) + max(1, ceiling(length(i)/max(longest_in_reaches*reach(i), longest, tiny(1.0_dp))))
      end do
      n = first(size(first)) - 1
      allocate (segment(n), lower(3, n), upper(3, n))
      !$omp parallel do schedule(static) private(k, pieces, n, p, q) if (size(reach) >= worth_threads)
      do i = 1, size(reach)
         pieces = first(i + 1) - first(i)
         q = a(:, i)
         do k = 1, pieces
            p = q
            q = b(:, i)
            if (k < pieces) q = a(:, i) + real(k, dp)/pieces*(b(:, i) - a(:, i))
            n = first(i) + k - 1
            segment(n) = i
            lower(:, n) = min(p, q) - reach(i)
            upper(:, n) = max(p, q) + reach(i)
         end do
      end do
      !$omp end parallel do
   end subroutine cut_segments

   !> Counting sort of some boxes by the entries of the table that their cells are folded onto.
   subroutine build_grid(members, a, b, reach, segment, lower, upper, grid)
      integer, intent(in) :: members(:), segment(:)
      real(dp), intent(in) :: a(:, :), b(:, :), reach(:)
      real(dp), intent(in) :: lower(:, :), upper(:, :)
      type(grid_t), intent(out) :: grid
      !> Most cells along one direction: their number stays within 64 bits
      integer(int64), parameter :: most_cells = 2_int64**20
      integer(int64), allocatable :: cell(:)
      integer, allocatable :: free(:), member_at(:)
      real(dp) :: extent(3), origin(3), corner(3), edge
      integer :: i, n
      integer(int64) :: entry

      n = size(members)
      origin = huge(1.0_dp)
      corner = -huge(1.0_dp)
      edge = tiny(1.0_dp)
      !$omp parallel do schedule(static) reduction(min: origin) reduction(max: corner, edge) if (n >= worth_threads)
      do i = 1, n
         origin = min(origin, lower(:, members(i)))
         corner = max(corner, lower(:, members(i)))
         edge = max(edge, maxval(upper(:, members(i)) - lower(:, members(i))))
      end do
      !$omp end parallel do
      grid%origin = origin
      extent = corner - origin
      grid%edge = max(edge, maxval(extent)/most_cells)
      ! odd numbers of cells spread the layers over the table
      grid%cells = 2*(int(extent/grid%edge, int64)/2) + 5
      grid%mask = 1
      do while (grid%mask < 2*n)
         grid%mask = 2*grid%mask
      end do
      grid%mask = grid%mask - 1

      allocate (cell(n), member_at(n))
      !$omp parallel do schedule(static) if (n >= worth_threads)
      do i = 1, n
         cell(i) = cell_number(grid, cell_of(grid, lower(:, members(i))))
      end do
      !$omp end parallel do
      allocate (grid%start(0:grid%mask + 1), source=0)
      do i = 1, n
         entry = iand(cell(i), grid%mask)
         grid%start(entry + 1) = grid%start(entry + 1) + 1
      end do
      grid%start(0) = 1
      do entry = 0, grid%mask
         grid%start(entry + 1) = grid%start(entry) + grid%start(entry + 1)
      end do
      allocate (free(0:grid%mask))
      free = grid%start(:grid%mask)
      do i = 1, n
         entry = iand(cell(i), grid%mask)
         member_at(free(entry)) = i
         free(entry) = free(entry) + 1
      end do
      allocate (grid%cell(n), grid%segment(n), grid%corners(6, n), grid%ends(7, n))
      !$omp parallel do schedule(static) if (n >= worth_threads)
      do i = 1, n
         associate (member => members(member_at(i)))
            grid%cell(i) = cell(member_at(i))
            grid%segment(i) = segment(member)
            grid%corners(:3, i) = lower(:, member)
            grid%corners(4:, i) = upper(:, member)
            grid%ends(:3, i) = a(:, segment(member))
            grid%ends(4:6, i) = b(:, segment(member))
            grid%ends(7, i) = reach(segment(member))
         end associate
      end do
      !$omp end parallel do
   end subroutine build_grid

   !> Cell of a point, (1, 1, 1) for the origin.
   pure function cell_of(grid, point) result(cell)
      type(grid_t), intent(in) :: grid
      real(dp), intent(in) :: point(3)
      integer(int64) :: cell(3)

      cell = floor((point - grid%origin)/grid%edge, int64) + 1
   end function cell_of

   pure integer(int64) function cell_number(grid, cell)
      type(grid_t), intent(in) :: grid
      integer(int64), intent(in) :: cell(3)

      cell_number = cell(1) + grid%cells(1)*(cell(2) + grid%cells(2)*cell(3))
   end function cell_number

   !> Partners of a box within its grid: later ones of its own cell, and those of half of the cells around.
   subroutine visit_own_grid(a, b, reach, grid, box, list)
      real(dp), intent(in) :: a(:, :), b(:, :), reach(:)
      type(grid_t), intent(in) :: grid
      integer, intent(in) :: box
      type(pair_list_t), intent(inout) :: list
      integer(int64) :: cell, row, layer

      cell = grid%cell(box)
      row = grid%cells(1)
      layer = row*grid%cells(2)
      call visit_cells(a, b, reach, grid, cell, cell, box + 1, grid%segment(box), grid%corners(:3, box), &
         grid%corners(4:, box), list)
      call visit(cell + 1, cell + 1)
      call visit(cell + row - 1, cell + row + 1)
      call visit(cell + layer - row - 1, cell + layer - row + 1)
      call visit(cell + layer - 1, cell + layer + 1)
      call visit(cell + layer + row - 1, cell + layer + row + 1)

   contains

      subroutine visit(first_cell, last_cell)
         integer(int64), intent(in) :: first_cell, last_cell

         call visit_cells(a, b, reach, grid, first_cell, last_cell, 1, grid%segment(box), grid%corners(:3, box), &
            grid%corners(4:, box), list)
      end subroutine visit

   end subroutine visit_own_grid

   !> Partners of a box in the grids of larger boxes.
   subroutine visit_coarser_grids(a, b, reach, grids, g, box, list)
      real(dp), intent(in) :: a(:, :), b(:, :), reach(:)
      type(grid_t), intent(in) :: grids(:)
      !> Grid of the box
      integer, intent(in) :: g, box
      type(pair_list_t), intent(inout) :: list
      integer(int64) :: first(3), last(3), j, k
      integer :: coarser

      do coarser = 1, g - 1
         associate (grid => grids(coarser), lower => grids(g)%corners(:3, box), &
            upper => grids(g)%corners(4:, box))
            first = max(1_int64, cell_of(grid, lower - grid%edge))
            last = min(grid%cells - 2, cell_of(grid, upper))
            if (any(first > last)) cycle
            do k = first(3), last(3)
               do j = first(2), last(2)
                  call visit_cells(a, b, reach, grid, cell_number(grid, [first(1), j, k]), &
                     cell_number(grid, [last(1), j, k]), 1, grids(g)%segment(box), lower, upper, list)
               end do
            end do
         end associate
      end do
   end subroutine visit_coarser_grids

   !> Note all boxes of a row of cells, from the box `from` on, whose segments are near the given one.
   subroutine visit_cells(a, b, reach, grid, first_cell, last_cell, from, segment, lower, upper, list)
      real(dp), intent(in) :: a(:, :), b(:, :), reach(:)
      type(grid_t), intent(in) :: grid
      integer(int64), intent(in) :: first_cell, last_cell
      integer, intent(in) :: from, segment
      !> Box of a piece of the segment
      real(dp), intent(in) :: lower(3), upper(3)
      type(pair_list_t), intent(inout) :: list
      integer(int64) :: cell, entry, more
      integer :: box, other
      real(dp) :: separation

      cell = first_cell
      do while (cell <= last_cell)
         entry = iand(cell, grid%mask)
         ! cells that follow one another have entries that do, up to the end of the table
         more = min(last_cell - cell, grid%mask - entry)
         do box = max(from, grid%start(entry)), grid%start(entry + more + 1) - 1
            associate (corners => grid%corners(:, box))
               separation = max( &
                  max(max(corners(1) - upper(1), lower(1) - corners(4)), max(corners(2) - upper(2), lower(2) - corners(5))), &
                  max(corners(3) - upper(3), lower(3) - corners(6)))
            end associate
            if (separation > 0) cycle
            if (grid%cell(box) < cell .or. grid%cell(box) > cell + more) cycle
            other = grid%segment(box)
            if (other == segment) cycle
            if (segment_distance(a(:, segment), b(:, segment), grid%ends(:3, box), grid%ends(4:6, box)) &
               <= reach(segment) + grid%ends(7, box)) call append(list, min(segment, other), max(segment, other))
         end do
         cell = cell + more + 1
      end do
   end subroutine visit_cells

   pure subroutine append(list, i, j)
      type(pair_list_t), intent(inout) :: list
      integer, intent(in) :: i, j
      integer, allocatable :: larger(:, :)

      if (list%n == size(list%pairs, 2)) then
         allocate (larger(2, 2*list%n))
         larger(:, :list%n) = list%pairs
         call move_alloc(larger, list%pairs)
      end if
      list%n = list%n + 1
      list%pairs(1, list%n) = i
      list%pairs(2, list%n) = j
   end subroutine append

   !> All lists as one, sorted, every pair once: an order that depends neither on the grids nor on the threads.
   subroutine sort_pairs(n_segments, lists, pairs)
      integer, intent(in) :: n_segments
      type(pair_list_t), intent(in) :: lists(:)
      integer, allocatable, intent(out) :: pairs(:, :)
      integer, allocatable :: start(:), free(:), second(:), kept(:)
      integer :: l, p, i

      allocate (start(n_segments + 1), kept(n_segments), source=0)
      do l = 1, size(lists)
         do p = 1, lists(l)%n
            start(lists(l)%pairs(1, p) + 1) = start(lists(l)%pairs(1, p) + 1) + 1
         end do
      end do
      start(1) = 1
      do i = 1, n_segments
         start(i + 1) = start(i) + start(i + 1)
      end do
      allocate (free, source=start)
      allocate (second(start(n_segments + 1) - 1))
      do l = 1, size(lists)
         do p = 1, lists(l)%n
            associate (place => free(lists(l)%pairs(1, p)))
               second(place) = lists(l)%pairs(2, p)
               place = place + 1
            end associate
         end do
      end do
      !$omp parallel do schedule(static) if (n_segments >= worth_threads)
      do i = 1, n_segments
         call sort_once(second(start(i):start(i + 1) - 1), kept(i))
      end do
      !$omp end parallel do
      free(1) = 0
      do i = 1, n_segments
         free(i + 1) = free(i) + kept(i)
      end do
      allocate (pairs(2, free(n_segments + 1)))
      !$omp parallel do schedule(static) private(p) if (n_segments >= worth_threads)
      do i = 1, n_segments
         do p = 1, kept(i)
            pairs(1, free(i) + p) = i
            pairs(2, free(i) + p) = second(start(i) + p - 1)
         end do
      end do
      !$omp end parallel do
   end subroutine sort_pairs

   !> Insertion sort of a short list that keeps equal values once, at the front.
   pure subroutine sort_once(values, kept)
      integer, intent(inout) :: values(:)
      integer, intent(out) :: kept
      integer :: i, k, value

      kept = 0
      do i = 1, size(values)
         value = values(i)
         k = kept
         do while (k > 0)
            if (values(k) <= value) exit
            k = k - 1
         end do
         if (k > 0) then
            if (values(k) == value) cycle
         end if
         values(k + 2:kept + 1) = values(k + 1:kept)
         values(k + 1) = value
         kept = kept + 1
      end do
   end subroutine sort_once

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
