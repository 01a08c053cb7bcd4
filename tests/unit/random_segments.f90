!> Segments for tests of the contact search: clusters, a few long ones, and some of no length.
module random_segments
   use litz_kinds, only: dp
   implicit none
   private
   public :: make_segments

contains

   !> The same for the same number, whatever else has drawn random numbers.
   subroutine make_segments(n, a, b, reach)
      !> How many
      integer, intent(in) :: n
      !> End points (3, n) and half the distance at which two are near (n) [m]
      real(dp), allocatable, intent(out) :: a(:, :), b(:, :), reach(:)
      integer, allocatable :: seed(:)
      real(dp), allocatable :: along(:, :)
      integer :: i, n_seeds

      call random_seed(size=n_seeds)
      allocate (seed(n_seeds), source=[(37*i + 11, i=1, n_seeds)])
      call random_seed(put=seed)
      allocate (a(3, n), along(3, n), reach(n))
      call random_number(a)
      call random_number(along)
      call random_number(reach)
      ! half of them in a corner, all in a slab
      a(:, :n/2) = 0.2_dp*a(:, :n/2)
      a(3, :) = 0.1_dp*a(3, :)
      along = (along - 0.5_dp)*spread(merge(0.5_dp, 0.03_dp, [(mod(i, 50) == 0, i=1, n)]), 1, 3)
      along(:, ::97) = 0
      b = a + along
      reach = 0.002_dp + 0.003_dp*reach
   end subroutine make_segments

end module random_segments
