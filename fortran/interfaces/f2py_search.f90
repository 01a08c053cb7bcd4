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

   ! Find the pairs, and how many there are; -1: more than `most_pairs`.
   subroutine find_near_segments(n, a, b, reach, most_pairs, n_pairs)
      integer(c_int), intent(in) :: n, most_pairs
      real(c_double), intent(in) :: a(3, n), b(3, n), reach(n)
      integer(c_int), intent(out) :: n_pairs
      logical :: too_many

      call core_near_segments(a, b, reach, most_pairs, found, too_many)
      n_pairs = size(found, 2)
      if (too_many) n_pairs = -1
   end subroutine find_near_segments

   ! The pairs of the last search, counted from 1; they are forgotten.
   subroutine take_near_segments(n_pairs, pairs)
      integer(c_int), intent(in) :: n_pairs
      integer(c_int), intent(out) :: pairs(2, n_pairs)

      pairs = found
      deallocate (found)
   end subroutine take_near_segments

end module f2py_search
