!> Lists of pairs of segments that the threads of a search have found.
module litz_pair_lists
   use litz_parallel, only: worth_threads
   implicit none
   private
   public :: pair_list_t, append, sort_pairs

   !> Pairs that one thread has found.
   type :: pair_list_t
      integer :: n = 0
      !> (2, at least n)
      integer, allocatable :: pairs(:, :)
   end type pair_list_t

contains

   pure subroutine append(list, i, j)
      type(pair_list_t), intent(inout) :: list
      !> Indices of the two segments, the smaller one first
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
      !> Number of segments
      integer, intent(in) :: n_segments
      type(pair_list_t), intent(in) :: lists(:)
      !> Indices of the two segments of each pair (2, pairs), the smaller one first
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
      !> Numbers (n). Out: the first `kept` are sorted, each once
      integer, intent(inout) :: values(:)
      !> Number of different values
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

end module litz_pair_lists
