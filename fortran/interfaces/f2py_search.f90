! The broad phase of the contact search for Python; the contract is in fortran/kernels/contact_search.f90.
module f2py_search
   use iso_c_binding, only: c_double, c_int
   use litz_contact_search, only: core_near_segments => near_segments
   implicit none
   private
   public :: find_near_segments, take_near_segments

   ! What was found, from one call to the next
   integer, allocatable :: found(:, :)

contains

   ! Find the pairs, and how many there are.
   subroutine find_near_segments(n, a, b, reach, n_pairs)
      integer(c_int), intent(in) :: n
      real(c_double), intent(in) :: a(3, n), b(3, n), reach(n)
      integer(c_int), intent(out) :: n_pairs

      call core_near_segments(a, b, reach, found)
      n_pairs = size(found, 2)
   end subroutine find_near_segments

   ! The pairs of the last search, counted from 1; they are forgotten.
   subroutine take_near_segments(n_pairs, pairs)
      integer(c_int), intent(in) :: n_pairs
      integer(c_int), intent(out) :: pairs(2, n_pairs)

      pairs = found
      deallocate (found)
   end subroutine take_near_segments

end module f2py_search
