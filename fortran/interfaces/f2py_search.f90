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

   ! Find the pairs, and how many there are; -1: more than `max_pairs`.
   subroutine find_near_segments(n, a, b, reach, max_pairs, n_pairs)
      !> Number of segments
      integer(c_int), intent(in) :: n
      !> Search ends where there are more pairs
      integer(c_int), intent(in) :: max_pairs
      !> Ends of the segments (3, n) [m]
      real(c_double), intent(in) :: a(3, n), b(3, n)
      !> Radius around each segment (n) [m]
      real(c_double), intent(in) :: reach(n)
      !> Number of pairs, or -1
      integer(c_int), intent(out) :: n_pairs
      logical :: too_many

      call core_near_segments(a, b, reach, max_pairs, found, too_many)
      n_pairs = size(found, 2)
      if (too_many) n_pairs = -1
   end subroutine find_near_segments

   ! The pairs of the last search, counted from 1; they are forgotten.
   subroutine take_near_segments(n_pairs, pairs)
      !> Number of pairs that was found
      integer(c_int), intent(in) :: n_pairs
      !> Numbers of the two segments of each pair (2, n_pairs), from 1
      integer(c_int), intent(out) :: pairs(2, n_pairs)

      pairs = found
      deallocate (found)
   end subroutine take_near_segments

end module f2py_search
