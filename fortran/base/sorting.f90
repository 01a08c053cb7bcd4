!> Sorting of integers.
module litz_sorting
   implicit none
   private
   public :: sort_integers

contains

   !> Ascending, in place. Source: heap sort (Williams 1964), O(n log n) in the worst case.
   pure subroutine sort_integers(values)
      integer, intent(inout) :: values(:)
      integer :: i, n, largest

      n = size(values)
      do i = n/2, 1, -1
         call sift_down(values, i, n)
      end do
      do i = n, 2, -1
         largest = values(1)
         values(1) = values(i)
         values(i) = largest
         call sift_down(values, 1, i - 1)
      end do
   end subroutine sort_integers

   !> Let the value at `root` sink into the heap of the first `n` values.
   pure subroutine sift_down(values, root, n)
      integer, intent(inout) :: values(:)
      integer, intent(in) :: root, n
      integer :: parent, child, sinking

      sinking = values(root)
      parent = root
      do
         child = 2*parent
         if (child > n) exit
         if (child < n) then
            if (values(child + 1) > values(child)) child = child + 1
         end if
         if (values(child) <= sinking) exit
         values(parent) = values(child)
         parent = child
      end do
      values(parent) = sinking
   end subroutine sift_down

end module litz_sorting
