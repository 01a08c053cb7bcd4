!> A sum over numbers that changes when one of their bits changes or two of them change places.
!>
!> Source: J. G. Fletcher, An arithmetic checksum for serial transmissions, IEEE Trans. Commun. 30 (1982) 247-252, with
!> words of 32 bits and a prime modulus.
module litz_checksum
   use litz_kinds, only: dp, int64
   implicit none
   private
   public :: checksum

   interface checksum
      procedure :: checksum_of_integers
      procedure :: checksum_of_reals
   end interface checksum

   integer(int64), parameter :: modulus = 2_int64**31 - 1, half = 2_int64**32 - 1

contains

   pure integer(int64) function checksum_of_integers(numbers) result(total)
      !> (components, rows)
      integer(int64), intent(in) :: numbers(:, :)
      integer(int64) :: first, second
      integer :: i, j, word

      first = 1
      second = 0
      do j = 1, size(numbers, 2)
         do i = 1, size(numbers, 1)
            do word = 0, 1
               first = modulo(first + iand(ishft(numbers(i, j), -32*word), half), modulus)
               second = modulo(second + first, modulus)
            end do
         end do
      end do
      total = ior(ishft(second, 31), first)
   end function checksum_of_integers

   !> Of their bits, so that no value is like another, not a number included.
   pure integer(int64) function checksum_of_reals(numbers) result(total)
      !> (components, rows)
      real(dp), intent(in) :: numbers(:, :)
      integer(int64) :: bits(size(numbers, 1), 1)
      integer(int64), allocatable :: column_sums(:, :)
      integer :: j

      allocate (column_sums(1, size(numbers, 2)))
      do j = 1, size(numbers, 2)
         bits(:, 1) = transfer(numbers(:, j), bits(:, 1))
         column_sums(1, j) = checksum(bits)
      end do
      total = checksum(column_sums)
   end function checksum_of_reals

end module litz_checksum
