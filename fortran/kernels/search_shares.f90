!> The contact search in shares that processes can do apart from each other: each has segments of its own, and copies of
!> those of others that may come near them.
!>
!> A pair belongs to the share that owns its segment of the smaller number, so that each pair is in one share, and all
!> shares joined are what one search finds, in the same order.
module litz_search_shares
   use litz_kinds, only: dp, int64
   use litz_contact_search, only: near_segments
   implicit none
   private
   public :: owners_of_segments, members_of_share, pairs_of_share, join_shares

contains

   !> The share of each segment (n), numbered from 1: boxes of like numbers of segments, by bisection of their middles.
   pure function owners_of_segments(a, b, n_shares) result(owner)
      !> End points (3, n) [m]
      real(dp), intent(in) :: a(:, :), b(:, :)
      !> Number of shares
      integer, intent(in) :: n_shares
      integer :: owner(size(a, 2)), order(size(a, 2)), i

      order = [(i, i=1, size(order))]
      call bisect(a + b, order, 1, n_shares, owner)
   end function owners_of_segments

   !> Give segments to shares: along the direction in which they reach farthest, the first ones to the first half.
   pure recursive subroutine bisect(middles, segments, first, n_shares, owner)
      !> Of all segments, doubled (3, n) [m]
      real(dp), intent(in) :: middles(:, :)
      !> Numbers of the segments to be given (m); out: in the order of the shares
      integer, intent(inout) :: segments(:)
      !> First share, and how many there are
      integer, intent(in) :: first, n_shares
      !> (n)
      integer, intent(inout) :: owner(:)
      integer :: along, half, n

      if (n_shares == 1) then
         owner(segments) = first
         return
      end if
      half = n_shares/2
      n = int(int(size(segments), int64)*half/n_shares)
      if (size(segments) > 1) then
         along = maxloc(maxval(middles(:, segments), 2) - minval(middles(:, segments), 2), 1)
         call sort_by(middles(along, :), segments)
      end if
      call bisect(middles, segments(:n), first, half, owner)
      call bisect(middles, segments(n + 1:), first + half, n_shares - half, owner)
   end subroutine bisect

   !> Merge sort of numbers by their values, of equal ones by themselves.
   pure recursive subroutine sort_by(values, numbers)
      !> (n)
      real(dp), intent(in) :: values(:)
      !> (m)
      integer, intent(inout) :: numbers(:)
      integer :: merged(size(numbers)), half, i, j, k
      logical :: is_first

      half = size(numbers)/2
      if (half == 0) return
      call sort_by(values, numbers(:half))
      call sort_by(values, numbers(half + 1:))
      i = 1
      j = half + 1
      do k = 1, size(numbers)
         is_first = j > size(numbers)
         if (.not. is_first .and. i <= half) is_first = values(numbers(i)) < values(numbers(j)) .or. &
            (.not. values(numbers(j)) < values(numbers(i)) .and. numbers(i) < numbers(j))
         merged(k) = numbers(merge(i, j, is_first))
         i = i + merge(1, 0, is_first)
         j = j + merge(0, 1, is_first)
      end do
      numbers = merged
   end subroutine sort_by

   !> The segments that a share needs, in the order of their numbers: its own, and those whose boxes meet the box around
   !> its own.
   pure function members_of_share(a, b, reach, owner, share) result(members)
      !> End points (3, n) and half the distance at which two segments are near (n) [m]
      real(dp), intent(in) :: a(:, :), b(:, :), reach(:)
      !> Share of each segment (n), and the share that is meant
      integer, intent(in) :: owner(:), share
      integer, allocatable :: members(:)
      real(dp) :: lower(3), upper(3)
      logical :: is_member(size(owner))
      integer :: i

      lower = huge(1.0_dp)
      upper = -huge(1.0_dp)
      do i = 1, size(owner)
         if (owner(i) /= share) cycle
         lower = min(lower, min(a(:, i), b(:, i)) - reach(i))
         upper = max(upper, max(a(:, i), b(:, i)) + reach(i))
      end do
      do i = 1, size(owner)
         is_member(i) = owner(i) == share
         if (.not. is_member(i)) is_member(i) = all(min(a(:, i), b(:, i)) - reach(i) <= upper) .and. &
            all(max(a(:, i), b(:, i)) + reach(i) >= lower)
      end do
      members = pack([(i, i=1, size(owner))], is_member)
   end function members_of_share

   !> The pairs that belong to a share, by the numbers of all segments, sorted by the first, then the second one.
   subroutine pairs_of_share(a, b, reach, members, is_own, max_pairs, pairs, too_many)
      !> Of the members: end points (3, m), reach (m) [m]
      real(dp), intent(in) :: a(:, :), b(:, :), reach(:)
      !> Their numbers, which ascend (m)
      integer, intent(in) :: members(:)
      !> They belong to this share (m)
      logical, intent(in) :: is_own(:)
      !> Up to how many pairs are wanted
      integer, intent(in) :: max_pairs
      !> (2, number of pairs)
      integer, allocatable, intent(out) :: pairs(:, :)
      !> There are more than that among the members
      logical, intent(out) :: too_many
      integer, allocatable :: found(:, :)
      integer :: i, n

      call near_segments(a, b, reach, max_pairs, found, too_many)
      n = 0
      do i = 1, size(found, 2)
         if (.not. is_own(found(1, i))) cycle
         n = n + 1
         found(:, n) = members(found(:, i))
      end do
      pairs = found(:, :n)
   end subroutine pairs_of_share

   !> The pairs of all shares in the order of one search.
   pure function join_shares(n_segments, pairs) result(joined)
      !> Number of segments
      integer, intent(in) :: n_segments
      !> Those of one share after the other, each sorted (2, n)
      integer, intent(in) :: pairs(:, :)
      integer :: joined(2, size(pairs, 2)), next(n_segments + 1), i

      next = 0
      do i = 1, size(pairs, 2)
         next(pairs(1, i) + 1) = next(pairs(1, i) + 1) + 1
      end do
      next(1) = 1
      do i = 1, n_segments
         next(i + 1) = next(i) + next(i + 1)
      end do
      do i = 1, size(pairs, 2)
         joined(:, next(pairs(1, i))) = pairs(:, i)
         next(pairs(1, i)) = next(pairs(1, i)) + 1
      end do
   end function join_shares

end module litz_search_shares
