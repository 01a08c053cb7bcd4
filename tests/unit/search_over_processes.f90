!> The contact search with a share on each process of MPI: each has the segments of its share alone, and the first one
!> gathers the pairs. It prints how many there are, and fails where they are not those of one search, in their order.
program search_over_processes
   use, intrinsic :: iso_c_binding, only: c_int
   use litz_contact_search, only: near_segments
   use litz_kinds, only: dp
   use litz_search_shares, only: owners_of_segments, members_of_share, pairs_of_share, join_shares
   use random_segments, only: make_segments
   implicit none

   interface
      subroutine begin(rank, size) bind(c, name='test_begin_processes')
         import :: c_int
         implicit none
         integer(c_int), intent(out) :: rank, size
      end subroutine begin
      !> Values of the first process for all
      subroutine broadcast(n, values) bind(c, name='test_broadcast')
         import :: c_int
         implicit none
         integer(c_int), value :: n
         integer(c_int), intent(inout) :: values(n)
      end subroutine broadcast
      !> Values of all processes, one after the other, for the first; counts(size) are those that each has
      subroutine gather(n, values, counts, gathered) bind(c, name='test_gather')
         import :: c_int
         implicit none
         integer(c_int), value :: n
         integer(c_int), intent(in) :: values(n), counts(*)
         integer(c_int), intent(inout) :: gathered(*)
      end subroutine gather
      subroutine end_all(code) bind(c, name='test_end_processes')
         import :: c_int
         implicit none
         integer(c_int), value :: code
      end subroutine end_all
   end interface

   integer, parameter :: n = 20000, max_pairs = 10**7
   real(dp), allocatable :: a(:, :), b(:, :), reach(:)
   integer, allocatable :: owner(:), members(:), own(:, :), counts(:), gathered(:), joined(:, :), whole(:, :)
   integer(c_int) :: rank, n_ranks
   logical :: too_many

   call begin(rank, n_ranks)
   call make_segments(n, a, b, reach)
   ! the first process decides who has what
   owner = owners_of_segments(a, b, n_ranks)
   if (rank > 0) owner = 0
   call broadcast(n, owner)
   members = members_of_share(a, b, reach, owner, rank + 1)
   call keep_members()
   call pairs_of_share(a, b, reach, members, owner(members) == rank + 1, max_pairs, own, too_many)
   if (too_many) call end_all(2_c_int)

   allocate (counts(n_ranks))
   call gather(1_c_int, [size(own)], [spread(1, 1, n_ranks)], counts)
   call broadcast(n_ranks, counts)
   allocate (gathered(sum(counts)))
   call gather(size(own), reshape(own, [size(own)]), counts, gathered)
   if (rank > 0) call end_all(0_c_int)

   joined = join_shares(n, reshape(gathered, [2, size(gathered)/2]))
   call make_segments(n, a, b, reach)
   call near_segments(a, b, reach, max_pairs, whole, too_many)
   if (too_many .or. size(joined, 2) /= size(whole, 2)) call end_all(1_c_int)
   if (any(joined /= whole)) call end_all(1_c_int)
   print '(a, *(1x, i0))', 'pairs, and those of each process:', size(whole, 2), counts/2
   call end_all(0_c_int)

contains

   !> The other segments are not on this process.
   subroutine keep_members()
      a = a(:, members)
      b = b(:, members)
      reach = reach(members)
   end subroutine keep_members

end program search_over_processes
