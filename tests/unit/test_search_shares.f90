!> The contact search in shares finds the pairs of one search, in the same order.
program test_search_shares
   use litz_contact_search, only: near_segments
   use litz_kinds, only: dp
   use litz_search_shares, only: owners_of_segments, members_of_share, pairs_of_share, join_shares
   use random_segments, only: make_segments
   implicit none

   integer, parameter :: n = 3000, max_pairs = 10**6
   integer :: failures = 0, n_shares

   do n_shares = 1, 7
      call all_shares_are_one_search(n_shares)
   end do
   call shares_are_of_like_numbers()
   call a_share_has_few_copies()
   call fewer_segments_than_shares()
   if (failures > 0) error stop 1

contains

   subroutine all_shares_are_one_search(shares)
      integer, intent(in) :: shares
      real(dp), allocatable :: a(:, :), b(:, :), reach(:)
      integer, allocatable :: whole(:, :), joined(:, :)
      logical :: too_many

      call make_segments(n, a, b, reach)
      call near_segments(a, b, reach, max_pairs, whole, too_many)
      joined = join_shares(n, search_in_shares(a, b, reach, shares))
      call check(.not. too_many .and. size(whole, 2) > n, 'there are pairs to be found')
      call check(size(joined, 2) == size(whole, 2), 'each pair is in one share')
      if (size(joined, 2) == size(whole, 2)) call check(all(joined == whole), 'the same pairs in the same order')
   end subroutine all_shares_are_one_search

   !> The pairs of one share after the other.
   function search_in_shares(a, b, reach, shares) result(pairs)
      real(dp), intent(in) :: a(:, :), b(:, :), reach(:)
      integer, intent(in) :: shares
      integer, allocatable :: pairs(:, :), found(:, :), members(:)
      integer :: owner(size(reach)), share
      logical :: too_many

      allocate (pairs(2, 0))
      owner = owners_of_segments(a, b, shares)
      do share = 1, shares
         members = members_of_share(a, b, reach, owner, share)
         call pairs_of_share(a(:, members), b(:, members), reach(members), members, owner(members) == share, &
            max_pairs, found, too_many)
         pairs = reshape([pairs, found], [2, size(pairs, 2) + size(found, 2)])
      end do
   end function search_in_shares

   subroutine shares_are_of_like_numbers()
      real(dp), allocatable :: a(:, :), b(:, :), reach(:)
      integer :: owner(n), share

      call make_segments(n, a, b, reach)
      owner = owners_of_segments(a, b, 7)
      do share = 1, 7
         call check(abs(7*count(owner == share) - n) <= 21, 'shares of like numbers')
      end do
   end subroutine shares_are_of_like_numbers

   !> Wires side by side, cut across: copies are those next to the cut.
   subroutine a_share_has_few_copies()
      integer, parameter :: wires = 10, elements = 100
      real(dp), dimension(3, wires*elements) :: a, b
      real(dp) :: reach(wires*elements)
      integer :: owner(wires*elements), wire, element

      do wire = 1, wires
         do element = 1, elements
            a(:, (element - 1)*wires + wire) = [real(element, dp), 0.01_dp*wire, 0.0_dp]
         end do
      end do
      b = a
      b(1, :) = b(1, :) + 1
      reach = 0.01_dp
      owner = owners_of_segments(a, b, 2)
      call check(size(members_of_share(a, b, reach, owner, 1)) == wires*(elements/2 + 1), 'one layer of copies')
   end subroutine a_share_has_few_copies

   subroutine fewer_segments_than_shares()
      real(dp) :: a(3, 2), b(3, 2)

      a = 0
      b = 1
      call check(size(search_in_shares(a, b, [1.0_dp, 1.0_dp], 4)) == 2, 'a pair in one of four shares')
   end subroutine fewer_segments_than_shares

   subroutine check(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what

      if (holds) return
      failures = failures + 1
      print '(2a)', 'FAILED: ', what
   end subroutine check

end program test_search_shares
