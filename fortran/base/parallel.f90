!> When threads pay.
module litz_parallel
   implicit none
   private
   public :: worth_threads

   !> A loop over fewer elements or contacts than this is done before a second thread has woken up
   integer, parameter :: worth_threads = 512
end module litz_parallel
