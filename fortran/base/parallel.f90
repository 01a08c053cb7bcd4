!> How loops are shared among threads.
module litz_parallel
!$ use omp_lib, only: omp_get_num_threads, omp_get_thread_num
   implicit none
   private
   public :: worth_threads, owned

   !> A loop over fewer elements or contacts than this is done before a second thread has woken up
   integer, parameter :: worth_threads = 512

   !> Neighbouring nodes with one owner: their rows share cache lines
   integer, parameter :: nodes_together = 8

contains

   !> Within a parallel region: this thread is the one that writes the rows of a node.
   logical function owned(node)
      !> Index of a node
      integer, intent(in) :: node

      owned = .true.
!$    owned = mod(node/nodes_together, omp_get_num_threads()) == omp_get_thread_num()
   end function owned

end module litz_parallel
