!> Shear of sections whose walls are a chain of thin plates, open or closed around one cell: shear centre, compliance.
!>
!> Along the mean line the shear flow of a force `V` is `q = q0 - integral of t g.y ds`, `g = I^-1 V`, `y` from the
!> centroid: zero at free edges, and without a twist of the cell where the chain is closed.
!>
!> Source: S. P. Timoshenko, Strength of Materials, part I, 3rd edition (1955), sections 53 (open sections) and part II,
!> section 47 (closed ones).
module litz_thin_walls
   use litz_kinds, only: dp
   implicit none
   private
   public :: wall_shear_t, shear_of_walls

   type :: wall_shear_t
      !> Shear centre, in the axes of the points (2) [m]
      real(dp) :: centre(2) = 0
      !> Energy of the shear flow, `V.f V/(2 G)` (2, 2) [1/m^2]
      real(dp) :: compliance(2, 2) = 0
   end type wall_shear_t

   !> Points and weights of Gauss in [0, 1], exact for the square of a shear flow, which is of degree 4
   real(dp), parameter :: gauss_place(3) = 0.5_dp + [-0.5_dp, 0.0_dp, 0.5_dp]*sqrt(0.6_dp)
   real(dp), parameter :: gauss_weight(3) = [5, 8, 5]/18.0_dp

contains

   pure type(wall_shear_t) function shear_of_walls(points, thickness) result(shear)
      !> Ends of the plates one after the other, the last one on the first where they are closed (2, n + 1) [m]
      real(dp), intent(in) :: points(:, :)
      !> Of the plates (n) [m]
      real(dp), intent(in) :: thickness(:)
      !> Shear flows of unit forces along both axes at the points of Gauss (force, point, plate) [1/m]
      real(dp) :: flow(2, 3, size(thickness))
      real(dp) :: length(size(thickness)), along(2), moment(2)
      integer :: i, p

      length = [(norm2(points(:, i + 1) - points(:, i)), i=1, size(thickness))]
      flow = shear_flows(points, thickness, length)
      moment = 0
      do i = 1, size(thickness)
         along = points(:, i + 1) - points(:, i)
         do p = 1, 3
            moment = moment + gauss_weight(p)*flow(:, p, i)*(points(1, i)*along(2) - points(2, i)*along(1))
            shear%compliance = shear%compliance + gauss_weight(p)*length(i)/thickness(i) &
               *spread(flow(:, p, i), 2, 2)*spread(flow(:, p, i), 1, 2)
         end do
      end do
      ! a force along 2 turns about the origin by its arm along 1, one along 1 the other way round
      shear%centre = [moment(2), -moment(1)]
   end function shear_of_walls

   pure function shear_flows(points, thickness, length) result(flow)
      !> As in `shear_of_walls`, and lengths of the plates (n) [m]
      real(dp), intent(in) :: points(:, :), thickness(:), length(:)
      real(dp) :: flow(2, 3, size(thickness))
      real(dp) :: centroid(2), second(2, 2), y(2), along(2), g(2, 2), start(2), twist(2)
      integer :: i, p

      centroid = 0
      do i = 1, size(thickness)
         centroid = centroid + thickness(i)*length(i)*(points(:, i) + points(:, i + 1))/2
      end do
      centroid = centroid/sum(thickness*length)
      second = 0
      do i = 1, size(thickness)
         do p = 1, 3
            y = points(:, i) + gauss_place(p)*(points(:, i + 1) - points(:, i)) - centroid
            second = second + gauss_weight(p)*thickness(i)*length(i)*spread(y, 2, 2)*spread(y, 1, 2)
         end do
      end do
      g = reshape([second(2, 2), -second(1, 2), -second(1, 2), second(1, 1)], [2, 2]) &
         /(second(1, 1)*second(2, 2) - second(1, 2)**2)

      start = 0
      do i = 1, size(thickness)
         y = points(:, i) - centroid
         along = points(:, i + 1) - points(:, i)
         do p = 1, 3
            flow(:, p, i) = start - thickness(i)*length(i)*gauss_place(p)*matmul(g, y + gauss_place(p)/2*along)
         end do
         start = start - thickness(i)*length(i)*matmul(g, y + along/2)
      end do
      if (norm2(points(:, size(thickness) + 1) - points(:, 1)) > 1.0e-6_dp*sum(length)) return
      twist = 0
      do i = 1, size(thickness)
         twist = twist + length(i)/thickness(i)*matmul(flow(:, :, i), gauss_weight)
      end do
      flow = flow - spread(spread(twist/sum(length/thickness), 2, 3), 3, size(thickness))
   end function shear_flows

end module litz_thin_walls
