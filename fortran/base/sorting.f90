!> Sorting of integers.
module litz_sorting
   implicit none
   private
   public :: sort_integers

contains

   !> Ascending, in place. Source: heap sort (Williams 1964), O(n log n) in the worst case.
   pure subroutine sort_integers(values)
      !> Numbers (n); equal ones are kept
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
      !> Numbers (at least n); below `root` they are a heap already: no child is larger than its parent
      integer, intent(inout) :: values(:)
      !> Place of the number that sinks
      integer, intent(in) :: root
      !> Length of the heap
      integer, intent(in) :: n
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
