!> The cell of a place of a line contact: the part of the wire for which the place stands, as far as it touches.
!>
!> Source: theory section 10. Along the cell the overlap is `delta - t s - k s^2/2`, with the slope `t` and the
!> curvature `k` of the distance at the place. The conductance per length of clean metal hardly depends on the force, so
!> that it begins with a step where the wires touch: what a cell conducts goes with the part of it that touches. The
!> rule is the same wherever the contact ends, and continuous in `delta`, `t` and `k`: the cell is divided where the
!> overlap is extreme, and each part has three Gauss points in the square root of the distance from its shallow end.
module litz_line_cell
   use litz_kinds, only: dp
   implicit none
   private
   public :: line_cell_t, cell_samples_t, cell_samples, cell_integral, touching_length
   public :: n_of_cell, n_samples

   !> Gauss points in (0, 1), and their weights times twice their place: those of the square of the place
   integer, parameter :: n_gauss = 3
   real(dp), parameter :: root_place(n_gauss) = 0.5_dp + 0.5_dp*[-0.77459666924148337704_dp, 0.0_dp, &
      0.77459666924148337704_dp]
   real(dp), parameter :: root_weight(n_gauss) = 2*root_place*[5.0_dp, 8.0_dp, 5.0_dp]/18
   !> Parts between the ends of a cell and the extreme overlap, and samples of both
   integer, parameter :: n_parts = 2, n_samples = n_parts*n_gauss
   !> What the overlap depends on: its value, slope and curvature at the place
   integer, parameter :: n_of_cell = 3
   !> Overlaps that differ by less than this part of them along a cell have no extreme
   real(dp), parameter :: even = 1.0e-9_dp

   !> Lengths are those before loading.
   type :: line_cell_t
      !> From the place to the ends of the cell, against and along the axis of its element [m]
      real(dp) :: reach(2) = 0
      !> Overlap at the place [m], which may be negative; slope [-] and curvature [1/m] of the distance along the wire
      real(dp) :: overlap = 0, slope = 0, bend = 0
   end type line_cell_t

   !> Points of a quadrature over the part of a cell that touches.
   type :: cell_samples_t
      integer :: n = 0
      !> Weights [m] and overlaps [m]
      real(dp) :: weight(n_samples) = 0, overlap(n_samples) = 0
      !> How both change with overlap, slope and curvature at the place
      real(dp) :: dweight(n_of_cell, n_samples) = 0, doverlap(n_of_cell, n_samples) = 0
   end type cell_samples_t

   !> A part of a cell, in which the overlap falls from its deep end.
   type :: part_t
      !> Deep end along the cell [m], +1: the shallow one lies further on, -1: it does not; length [m]
      real(dp) :: deep = 0, ahead = 0, length = 0
      !> How the length changes with overlap, slope and curvature, where one end is the extreme
      real(dp) :: dlength(n_of_cell) = 0
      !> The deep end is the extreme
      logical :: from_extreme = .false.
   end type part_t

contains

   !> The points of the quadrature; none where the cell does not touch.
   pure type(cell_samples_t) function cell_samples(cell) result(samples)
      type(line_cell_t), intent(in) :: cell
      type(part_t) :: parts(n_parts)
      integer :: n, i

      call divide(cell, parts, n)
      do i = 1, n
         call add_part(cell, parts(i), samples)
      end do
   end function cell_samples

   !> Length of the part that touches [m].
   pure real(dp) function touching_length(cell) result(length)
      type(line_cell_t), intent(in) :: cell
      type(cell_samples_t) :: samples

      samples = cell_samples(cell)
      length = sum(samples%weight(:samples%n))
   end function touching_length

   !> Integral over the cell of what depends on the overlap, and its derivatives with respect to overlap, slope and
   !> curvature at the place.
   pure subroutine cell_integral(samples, value, slope, integral, derivative)
      type(cell_samples_t), intent(in) :: samples
      !> At the samples, and its derivative with respect to their overlap [per m] (samples%n)
      real(dp), intent(in) :: value(:), slope(:)
      !> Over the length [m], and its derivatives (3) [-, m, m^2]
      real(dp), intent(out) :: integral, derivative(n_of_cell)
      integer :: i

      integral = 0
      derivative = 0
      do i = 1, samples%n
         integral = integral + samples%weight(i)*value(i)
         derivative = derivative + samples%dweight(:, i)*value(i) &
            + samples%weight(i)*slope(i)*samples%doverlap(:, i)
      end do
   end subroutine cell_integral

   !> The parts in which the overlap only falls or only grows.
   pure subroutine divide(cell, parts, n)
      type(line_cell_t), intent(in) :: cell
      type(part_t), intent(out) :: parts(n_parts)
      !> Their number, 1 or 2
      integer, intent(out) :: n
      real(dp) :: ends(2), extreme, dextreme(n_of_cell)
      integer :: side

      ends = [-cell%reach(1), cell%reach(2)]
      n = 1
      parts(1)%length = sum(cell%reach)
      parts(1)%ahead = sign(1.0_dp, cell%slope + cell%bend*sum(ends)/2)
      parts(1)%deep = merge(ends(1), ends(2), parts(1)%ahead > 0)
      if (abs(cell%bend)*sum(cell%reach)**2 <= even*abs(cell%overlap)) return
      extreme = -cell%slope/cell%bend
      if (extreme <= ends(1) .or. extreme >= ends(2)) return
      n = 2
      dextreme = [0.0_dp, -1.0_dp, -extreme]/cell%bend
      do side = 1, 2
         associate (part => parts(side), outwards => 2.0_dp*side - 3)
            part%length = outwards*(ends(side) - extreme)
            part%dlength = -outwards*dextreme
            part%from_extreme = cell%bend > 0
            part%deep = merge(extreme, ends(side), part%from_extreme)
            part%ahead = merge(outwards, -outwards, part%from_extreme)
         end associate
      end do
   end subroutine divide

   !> Samples of one part: with the distance `y` from its deep end the overlap is `delta_d - tau y - k y^2/2`.
   pure subroutine add_part(cell, part, samples)
      type(line_cell_t), intent(in) :: cell
      type(part_t), intent(in) :: part
      type(cell_samples_t), intent(inout) :: samples
      real(dp) :: deepest, tau, touching, y
      real(dp), dimension(n_of_cell) :: ddeepest, dtau, dtouching, dy
      integer :: i

      associate (k => cell%bend)
         deepest = cell%overlap - (cell%slope + k*part%deep/2)*part%deep
         if (.not. deepest > 0) return
         ! an extreme moves, which does not change the overlap there
         ddeepest = [1.0_dp, -part%deep, -part%deep**2/2]
         tau = 0
         dtau = 0
         if (.not. part%from_extreme) then
            tau = max(0.0_dp, part%ahead*(cell%slope + k*part%deep))
            dtau = part%ahead*[0.0_dp, 1.0_dp, part%deep]
         end if
         call find_edge(k, part, deepest, tau, ddeepest, dtau, touching, dtouching)
         do i = 1, n_gauss
            associate (n => samples%n, u2 => root_place(i)**2)
               n = n + 1
               y = touching*(1 - u2)
               dy = dtouching*(1 - u2)
               samples%weight(n) = touching*root_weight(i)
               samples%dweight(:, n) = dtouching*root_weight(i)
               samples%overlap(n) = deepest - (tau + k*y/2)*y
               samples%doverlap(:, n) = ddeepest - dtau*y - [0.0_dp, 0.0_dp, y**2/2] - (tau + k*y)*dy
            end associate
         end do
      end associate
   end subroutine add_part

   !> How far a part touches from its deep end on: `delta_d = tau y + k y^2/2`.
   pure subroutine find_edge(k, part, deepest, tau, ddeepest, dtau, touching, dtouching)
      !> Curvature of the distance [1/m]
      real(dp), intent(in) :: k
      type(part_t), intent(in) :: part
      !> Overlap [m] and slope [-] at the deep end, with their derivatives (3)
      real(dp), intent(in) :: deepest, tau, ddeepest(n_of_cell), dtau(n_of_cell)
      !> Length that touches [m], and its derivatives (3)
      real(dp), intent(out) :: touching, dtouching(n_of_cell)
      real(dp) :: square, steepness

      touching = part%length
      dtouching = part%dlength
      square = tau**2 + 2*k*deepest
      if (.not. square > 0) return
      steepness = sqrt(square)
      if (2*deepest >= part%length*(tau + steepness)) return
      touching = 2*deepest/(tau + steepness)
      dtouching = (ddeepest - dtau*touching - [0.0_dp, 0.0_dp, touching**2/2])/steepness
   end subroutine find_edge

end module litz_line_cell
