!> When two moving axes meet: they are cut into straight pieces, and each pair of pieces is followed.
module litz_moving_axes
   use litz_kinds, only: dp
   use litz_contact_joints, only: end_paths, path_between, joint_length, joined_radii
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_moving_segments, only: meeting_time, never
   use litz_wires, only: wires_t
   implicit none
   private
   public :: find_meeting

   !> Straight pieces leave the axis by this part of the smaller radius at most
   real(dp), parameter :: chord_tolerance = 0.02_dp
   integer, parameter :: max_pieces = 64

contains

   !> The first meeting of two axes that move uniformly; of joined elements, and of one wire, beyond their joint.
   pure subroutine find_meeting(model, wires, elements, pair, is_joined, p0, p1, leave, limit, time, place)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Elements (2)
      integer, intent(in) :: pair(2)
      !> The elements are joined
      logical, intent(in) :: is_joined
      !> Axes in powers of xi at the start and at the end (3, 0:3, 2) [m]
      real(dp), intent(in) :: p0(3, 0:3, 2), p1(3, 0:3, 2)
      !> How far the axes leave their chords (2), and distance at which they meet [m]
      real(dp), intent(in) :: leave(2), limit
      !> First meeting, or `never`, and where: middles of the pieces (2) in [-1, 1]
      real(dp), intent(out) :: time, place(2)
      real(dp) :: a(3, 2, 0:max_pieces), b(3, 2, 0:max_pieces), meeting, middle(2), between(2, 2), apart
      integer :: i, j, pieces(2)

      apart = 0
      if (is_joined) apart = joined_radii*maxval(elements%radius(pair))
      if (wires%wire(pair(1)) == wires%wire(pair(2))) apart = joint_length(wires, elements, pair)
      pieces = number_of_pieces(leave, minval(elements%radius(pair)), apart, elements%length(pair))
      call cut(p0(:, :, 1), p1(:, :, 1), pieces(1), a)
      call cut(p0(:, :, 2), p1(:, :, 2), pieces(2), b)
      time = never
      place = 0
      if (apart > 0) between = end_paths(model, wires, elements, pair, apart)
      do i = 1, pieces(1)
         do j = 1, pieces(2)
            middle = [-1 + (2*i - 1)/real(pieces(1), dp), -1 + (2*j - 1)/real(pieces(2), dp)]
            if (apart > 0) then
               if (path_between(wires, elements, pair, middle, between) < apart) cycle
            end if
            meeting = meeting_time(reshape([a(:, 1, i - 1:i), b(:, 1, j - 1:j)], [3, 4]), &
               reshape([a(:, 2, i - 1:i), b(:, 2, j - 1:j)], [3, 4]), limit)
            if (meeting >= time) cycle
            time = meeting
            place = middle
         end do
      end do
   end subroutine find_meeting

   !> Into how many straight pieces each axis is cut.
   pure function number_of_pieces(leave, radius, apart, length) result(pieces)
      !> How far the axes leave their chords (2), and the smaller radius [m]
      real(dp), intent(in) :: leave(2), radius
      !> Pieces nearer to each other than this are part of a joint; 0: there is no joint [m]
      real(dp), intent(in) :: apart
      !> Reference lengths (2) [m]
      real(dp), intent(in) :: length(2)
      integer :: pieces(2)

      pieces = max(1, min(max_pieces, ceiling(sqrt(leave/(chord_tolerance*radius)))))
      if (apart > 0) pieces = max(pieces, min(max_pieces, ceiling(4*length/apart)))
   end function number_of_pieces

   !> Ends of the pieces of an axis at the start and at the end.
   pure subroutine cut(p0, p1, n, ends)
      !> The axis in powers of xi at the start and at the end (3, 0:3) [m]
      real(dp), intent(in) :: p0(3, 0:3), p1(3, 0:3)
      !> Number of pieces
      integer, intent(in) :: n
      !> At the start and at the end (3, 2, 0:max_pieces) [m]
      real(dp), intent(inout) :: ends(3, 2, 0:max_pieces)
      real(dp) :: xi
      integer :: i

      do i = 0, n
         xi = -1 + 2*real(i, dp)/n
         ends(:, 1, i) = p0(:, 0) + xi*(p0(:, 1) + xi*(p0(:, 2) + xi*p0(:, 3)))
         ends(:, 2, i) = p1(:, 0) + xi*(p1(:, 1) + xi*(p1(:, 2) + xi*p1(:, 3)))
      end do
   end subroutine cut

end module litz_moving_axes
