! The broad phase of the contact search for Python; the contract is in fortran/kernels/contact_search.f90.
module f2py_search
   use iso_c_binding, only: c_double, c_int
   use litz_contact_search, only: core_near_segments => near_segments
   implicit none
contains

   ! The pairs that fit into the capacity, counted from 1, and how many there are.
   subroutine near_segments(n, capacity, a, b, reach, pairs, n_pairs)
      integer(c_int), intent(in) :: n, capacity
      real(c_double), intent(in) :: a(3, n), b(3, n), reach(n)
      integer(c_int), intent(out) :: pairs(2, capacity)
      integer(c_int), intent(out) :: n_pairs
      integer, allocatable :: found(:, :)
      integer :: stored

      call core_near_segments(a, b, reach, found)
      n_pairs = size(found, 2)
      stored = min(n_pairs, capacity)
      pairs(:, :stored) = found(:, :stored)
      pairs(:, stored + 1:) = 0
   end subroutine near_segments

end module f2py_search
