!> Broad phase of the contact search: all pairs of straight segments that come near each other, in a time that grows
!> like their number, whatever mixture of lengths and thicknesses they have.
!>
!> Segments are cut into pieces not much longer than the mean segment, so that their boxes hug them. The boxes are
!> sorted by size into grids whose cells are as wide as their largest box; a box lies in the one cell of its lower
!> corner. So it can only meet boxes of the cells around it in its own grid, and of a few cells in each grid of larger
!> boxes.
!> The cells of a grid are folded onto a table with an entry or two per box: empty space costs nothing. Cells that
!> follow one another along x have entries that do, so that a row of cells is one list of boxes.
module litz_contact_search
   use litz_kinds, only: dp, sp, int64
   use litz_parallel, only: worth_threads
   use litz_pair_lists, only: pair_list_t, append, sort_pairs
!$ use omp_lib, only: omp_get_max_threads, omp_get_thread_num
   implicit none
   private
   public :: near_segments

   !> A segment is cut where it is longer than this many times its reach, and than this fraction of the mean length
   real(dp), parameter :: longest_in_reaches = 16.0_dp, longest_in_means = 0.25_dp

   !> Boxes smaller than the largest by more than this power of two share the last grid
   integer, parameter :: max_grids = 24

   !> Cells are shorter along x than wide by this factor, which a row does not cost more for
   integer, parameter :: cells_per_width = 4

   !> Most pairs of boxes, so that the next power of two still is a default integer
   integer, parameter :: max_found = 2**30 - 2**26

   !> Boxes of like size, sorted by cell.
   type :: grid_t
      !> No box is wider, and lengths of a cell [m]
      real(dp) :: width = 1, edge(3) = 1
      !> Number of cells along each direction, with an empty one on both sides
      integer(int64) :: cells(3) = 0
      !> Entries of the table, a power of two, less one
      integer(int64) :: mask = 0
      !> (0:mask + 1) first box of each entry of the table
      integer, allocatable :: start(:)
      !> Segment of each box
      integer, allocatable :: segment(:)
      !> Lower and upper corner from the common origin, rounded outwards (6, boxes) [m]
      real(sp), allocatable :: corners(:, :)
      !> Ends and reach of the segment of each box (7, boxes): a copy that lies where it is wanted
      real(dp), allocatable :: ends(:, :)
   end type grid_t

contains

   !> Pairs `(i, j)`, `i < j`, of segments whose distance is at most the sum of their reaches, sorted by i, then j.
   subroutine near_segments(a, b, reach, max_pairs, pairs, too_many)
      !> End points (3, n) [m]
      real(dp), intent(in) :: a(:, :), b(:, :)
      !> Half the distance at which two such segments are near (n) [m]: radius and half a skin
      real(dp), intent(in) :: reach(:)
      !> Up to how many pairs are wanted
      integer, intent(in) :: max_pairs
      !> (2, number of pairs)
      integer, allocatable, intent(out) :: pairs(:, :)
      !> There are more, or more than can be counted; `pairs` is incomplete
      logical, intent(out) :: too_many
      type(grid_t), allocatable :: grids(:)
      type(pair_list_t), allocatable :: lists(:)
      integer :: g, box, coarser, threads, thread

      too_many = .false.
      allocate (pairs(2, 0))
      if (size(reach) < 2) return
      call build_grids(a, b, reach, grids)
      threads = 1
!$    threads = omp_get_max_threads()
      allocate (lists(threads))
      !$omp parallel private(thread, g, box, coarser) if (size(reach) >= worth_threads)
      thread = 1
!$    thread = omp_get_thread_num() + 1
      allocate (lists(thread)%pairs(2, 64))
      do g = 1, size(grids)
         !$omp do schedule(dynamic, 256)
         do box = 1, size(grids(g)%segment)
            if (lists(thread)%n > max_found) cycle
            call visit_own_grid(grids(g), box, lists(thread))
            do coarser = 1, g - 1
               call visit_coarser_grid(grids(g), box, grids(coarser), lists(thread))
            end do
         end do
         !$omp end do nowait
      end do
      !$omp end parallel
      too_many = sum(int(lists%n, int64)) > max_found
      if (too_many) return
      call sort_pairs(size(reach), lists, pairs)
      too_many = size(pairs, 2) > max_pairs
   end subroutine near_segments

   !> Pieces of all segments, sorted into grids of decreasing box size.
   subroutine build_grids(a, b, reach, grids)
      !> Ends of the segments (3, n) [m]
      real(dp), intent(in) :: a(:, :), b(:, :)
      !> Radius around each segment (n) [m]
      real(dp), intent(in) :: reach(:)
      type(grid_t), allocatable, intent(out) :: grids(:)
      real(dp), allocatable :: length(:), extent(:)
      integer, allocatable :: pieces(:), level(:), members(:)
      real(dp) :: origin(3), corner(3), slack, longest, largest
      integer :: i, g, n, first(max_grids + 1), free(max_grids)

      n = size(reach)
      allocate (length(n), extent(n), pieces(n), level(n), members(n))
      origin = huge(1.0_dp)
      corner = -huge(1.0_dp)
      !$omp parallel do schedule(static) reduction(min: origin) reduction(max: corner) if (n >= worth_threads)
      do i = 1, n
         length(i) = sqrt(sum((b(:, i) - a(:, i))**2))
         origin = min(origin, min(a(:, i), b(:, i)) - reach(i))
         corner = max(corner, max(a(:, i), b(:, i)) + reach(i))
      end do
      !$omp end parallel do
      longest = longest_in_means*sum(length)/n
      ! rounding to single precision moves a corner by half of this at most
      slack = epsilon(1.0_sp)*maxval(corner - origin)
      largest = 0
      !$omp parallel do schedule(static) reduction(max: largest) if (n >= worth_threads)
      do i = 1, n
         pieces(i) = max(1, ceiling(length(i)/max(longest_in_reaches*reach(i), longest, tiny(1.0_dp))))
         extent(i) = max(maxval(abs(b(:, i) - a(:, i)))/pieces(i) + 2*reach(i) + 4*slack, tiny(1.0_dp))
         largest = max(largest, extent(i))
      end do
      !$omp end parallel do
      !$omp parallel do schedule(static) if (n >= worth_threads)
      do i = 1, n
         level(i) = min(max_grids, exponent(largest/extent(i)))
      end do
      !$omp end parallel do
      call count_by(level, first)
      free = first(:max_grids)
      do i = 1, n
         members(free(level(i))) = i
         free(level(i)) = free(level(i)) + 1
      end do
      allocate (grids(count(first(2:) > first(:max_grids))))
      n = 0
      do g = 1, max_grids
         if (first(g + 1) == first(g)) cycle
         n = n + 1
         associate (member => members(first(g):first(g + 1) - 1))
            call size_grid(corner - origin, maxval(extent(member)), sum(pieces(member)), grids(n))
            call fill_grid(member, a, b, reach, pieces, origin, slack, grids(n))
         end associate
      end do
   end subroutine build_grids

   !> First place of each value 1, 2, ... when the values are sorted, and one past the last place.
   pure subroutine count_by(values, first)
      !> Numbers (n) from 1 to `size(first) - 1`
      integer, intent(in) :: values(:)
      !> First place of each value, and one past the last (values + 1)
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

   !> Cells and table of a grid.
   pure subroutine size_grid(extent, largest, n_boxes, grid)
      !> Of all boxes together, and the widest box of the grid [m]
      real(dp), intent(in) :: extent(3), largest
      !> Number of boxes of the grid
      integer, intent(in) :: n_boxes
      type(grid_t), intent(out) :: grid
      !> Most cells along one direction: their number stays within 64 bits
      integer(int64), parameter :: max_cells = 2_int64**19

      grid%width = max(largest, maxval(extent)/max_cells)
      grid%edge = grid%width*[1.0_dp/cells_per_width, 1.0_dp, 1.0_dp]
      ! odd numbers of cells spread the layers over the table
      grid%cells = 2*(int(extent/grid%edge, int64)/2) + 5
      grid%mask = 1
      do while (grid%mask < 2_int64*n_boxes)
         grid%mask = 2*grid%mask
      end do
      grid%mask = grid%mask - 1
   end subroutine size_grid

   !> Counting sort of the boxes of some segments by the entries of the table that their cells are folded onto.
   subroutine fill_grid(members, a, b, reach, pieces, origin, slack, grid)
      !> Indices of the segments of this grid (n)
      integer, intent(in) :: members(:)
      !> Ends of the segments (3, n) [m]
      real(dp), intent(in) :: a(:, :), b(:, :)
      !> Radius around each segment (n) [m]
      real(dp), intent(in) :: reach(:)
      !> Number of pieces that each segment is cut into (n)
      integer, intent(in) :: pieces(:)
      !> Common origin of all grids [m]
      real(dp), intent(in) :: origin(3)
      !> What boxes are larger by on each side, for single precision [m]
      real(dp), intent(in) :: slack
      type(grid_t), intent(inout) :: grid
      integer, allocatable :: first(:), place(:)
      real(sp) :: corners(6)
      integer(int64) :: entry
      integer :: i, k, n

      allocate (first(size(members) + 1))
      first(1) = 1
      do i = 1, size(members)
         first(i + 1) = first(i) + pieces(members(i))
      end do
      n = first(size(first)) - 1
      ! the entry of each box, then its place
      allocate (place(n))
      !$omp parallel do schedule(static) private(k, corners) if (n >= worth_threads)
      do i = 1, size(members)
         do k = 1, pieces(members(i))
            corners = piece_corners(members(i), k)
            place(first(i) + k - 1) = int(iand(cell_number(grid, cell_of(grid, real(corners(:3), dp))), grid%mask))
         end do
      end do
      !$omp end parallel do
      ! one entry ahead: filling moves each start to where the next one belongs
      allocate (grid%start(0:grid%mask + 2), source=0)
      do i = 1, n
         grid%start(place(i) + 2) = grid%start(place(i) + 2) + 1
      end do
      grid%start(:1) = 1
      do entry = 1, grid%mask
         grid%start(entry + 1) = grid%start(entry) + grid%start(entry + 1)
      end do
      do i = 1, n
         entry = place(i)
         place(i) = grid%start(entry + 1)
         grid%start(entry + 1) = grid%start(entry + 1) + 1
      end do
      allocate (grid%segment(n), grid%corners(6, n), grid%ends(7, n))
      !$omp parallel do schedule(static) private(k) if (n >= worth_threads)
      do i = 1, size(members)
         do k = 1, pieces(members(i))
            associate (box => place(first(i) + k - 1), segment => members(i))
               grid%segment(box) = segment
               grid%corners(:, box) = piece_corners(segment, k)
               grid%ends(:3, box) = a(:, segment)
               grid%ends(4:6, box) = b(:, segment)
               grid%ends(7, box) = reach(segment)
            end associate
         end do
      end do
      !$omp end parallel do

   contains

      !> Box around piece k of a segment.
      pure function piece_corners(segment, k) result(corners)
         !> Index of the segment
         integer, intent(in) :: segment
         !> Number of the piece, 1 to `pieces(segment)`
         integer, intent(in) :: k
         real(sp) :: corners(6)
         real(dp) :: p(3), q(3)

         associate (step => (b(:, segment) - a(:, segment))/pieces(segment))
            p = a(:, segment) + (k - 1)*step - origin
            q = a(:, segment) + k*step - origin
         end associate
         corners(:3) = real(min(p, q) - reach(segment) - slack, sp)
         corners(4:) = real(max(p, q) + reach(segment) + slack, sp)
      end function piece_corners

   end subroutine fill_grid

   !> Cell of a point, from the common origin, for which it is (1, 1, 1).
   pure function cell_of(grid, point) result(cell)
      type(grid_t), intent(in) :: grid
      !> Position from the common origin [m]
      real(dp), intent(in) :: point(3)
      integer(int64) :: cell(3)

      cell = floor(point/grid%edge, int64) + 1
   end function cell_of

   pure integer(int64) function cell_number(grid, cell)
      type(grid_t), intent(in) :: grid
      !> Place along x, y, z
      integer(int64), intent(in) :: cell(3)

      cell_number = cell(1) + grid%cells(1)*(cell(2) + grid%cells(2)*cell(3))
   end function cell_number

   !> Partners of a box within its grid that come later in the order of layers, rows and boxes.
   subroutine visit_own_grid(grid, box, list)
      type(grid_t), intent(in) :: grid
      !> Index of the box in its grid
      integer, intent(in) :: box
      type(pair_list_t), intent(inout) :: list
      integer(int64) :: own(3), first(3), last(3), j, k

      own = cell_of(grid, real(grid%corners(:3, box), dp))
      first = cell_of(grid, grid%corners(:3, box) - grid%width)
      last = cell_of(grid, real(grid%corners(4:, box), dp))
      call visit_row(grid, box, grid, [own(1), last(1)], own(2), own(3), box + 1, list)
      do j = own(2) + 1, last(2)
         call visit_row(grid, box, grid, [first(1), last(1)], j, own(3), 1, list)
      end do
      do k = own(3) + 1, last(3)
         do j = first(2), last(2)
            call visit_row(grid, box, grid, [first(1), last(1)], j, k, 1, list)
         end do
      end do
   end subroutine visit_own_grid

   !> Partners of a box in a grid of larger boxes.
   subroutine visit_coarser_grid(grid, box, coarser, list)
      !> The box and its grid
      type(grid_t), intent(in) :: grid
      !> Index of the box in its grid
      integer, intent(in) :: box
      type(grid_t), intent(in) :: coarser
      type(pair_list_t), intent(inout) :: list
      integer(int64) :: first(3), last(3), j, k

      first = cell_of(coarser, grid%corners(:3, box) - coarser%width)
      last = cell_of(coarser, real(grid%corners(4:, box), dp))
      do k = first(3), last(3)
         do j = first(2), last(2)
            call visit_row(grid, box, coarser, [first(1), last(1)], j, k, 1, list)
         end do
      end do
   end subroutine visit_coarser_grid

   !> Note all boxes of a row of cells, from the box `from` on, whose segments are near that of the given box.
   !> A box of another row that is folded onto the same entries can only be noted rightly, and once more.
   subroutine visit_row(grid, box, other_grid, range, j, k, from, list)
      !> The box and its grid
      type(grid_t), intent(in) :: grid
      !> Index of the box in its grid
      integer, intent(in) :: box
      !> Where the row is: cells `range` along x, and their places along y and z
      type(grid_t), intent(in) :: other_grid
      !> First and last cell of the row along x
      integer(int64), intent(in) :: range(2)
      !> Place of the row along y and z
      integer(int64), intent(in) :: j, k
      !> First box that counts
      integer, intent(in) :: from
      type(pair_list_t), intent(inout) :: list
      integer(int64) :: entry, left, more
      integer :: other, first
      real(sp) :: corners(6)
      logical :: apart

      corners = grid%corners(:, box)
      first = from
      entry = iand(cell_number(other_grid, [range(1), j, k]), other_grid%mask)
      left = range(2) - range(1)
      do while (left >= 0)
         ! cells that follow one another have entries that do, up to the end of the table
         more = min(left, other_grid%mask - entry)
         do other = max(first, other_grid%start(entry)), other_grid%start(entry + more + 1) - 1
            associate (others => other_grid%corners(:, other))
               apart = max(max(max(others(1) - corners(4), corners(1) - others(4)), &
                  max(others(2) - corners(5), corners(2) - others(5))), &
                  max(others(3) - corners(6), corners(3) - others(6))) > 0
            end associate
            if (apart) cycle
            if (other_grid%segment(other) == grid%segment(box)) cycle
            call note_near(other)
         end do
         entry = 0
         first = 1
         left = left - more - 1
      end do

   contains

      !> The segment of the smaller number first, so that no grid and no share of a search decides what round-off does.
      subroutine note_near(other)
         !> A box of the other grid
         integer, intent(in) :: other

         associate (i => grid%segment(box), j => other_grid%segment(other), p => grid%ends(:, box), &
            q => other_grid%ends(:, other))
            if (i < j) then
               if (are_near(p, q)) call append(list, i, j)
            else
               if (are_near(q, p)) call append(list, j, i)
            end if
         end associate
      end subroutine note_near

   end subroutine visit_row

   !> Whether the least distance between two straight segments is at most the sum of their reaches, also where they are
   !> parallel or have no length.
   !>
   !> Source: minimum of a convex quadratic over the unit square, by clamping one parameter after the other.
   pure logical function are_near(a, b)
      !> End points and reach (7) [m]
      real(dp), intent(in) :: a(7), b(7)
      real(dp) :: u(3), v(3), w(3), uu, uv, vv, uw, vw, s, t, determinant

      u = a(4:6) - a(1:3)
      v = b(4:6) - b(1:3)
      w = a(1:3) - b(1:3)
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
      are_near = sum((w + s*u - t*v)**2) <= (a(7) + b(7))**2

   contains

      pure real(dp) function clamp(value)
         !> Any number
         real(dp), intent(in) :: value

         clamp = max(0.0_dp, min(1.0_dp, value))
      end function clamp

   end function are_near

end module litz_contact_search
