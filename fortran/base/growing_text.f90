!> Text that is put together from many pieces in a time proportional to its length.
module litz_growing_text
   implicit none
   private
   public :: growing_text_t

   type :: growing_text_t
      private
      character(len=:), allocatable :: buffer
      integer :: length = 0
   contains
      procedure :: append
      procedure :: text
      procedure :: codes
   end type growing_text_t

contains

   pure subroutine append(self, piece)
      class(growing_text_t), intent(inout) :: self
      !> What the text goes on with; nothing is trimmed
      character(len=*), intent(in) :: piece
      character(len=:), allocatable :: grown
      integer :: capacity

      capacity = 0
      if (allocated(self%buffer)) capacity = len(self%buffer)
      if (self%length + len(piece) > capacity) then
         allocate (character(len=2*(self%length + len(piece))) :: grown)
         if (self%length > 0) grown(:self%length) = self%buffer(:self%length)
         call move_alloc(grown, self%buffer)
      end if
      self%buffer(self%length + 1:self%length + len(piece)) = piece
      self%length = self%length + len(piece)
   end subroutine append

   pure function text(self)
      class(growing_text_t), intent(in) :: self
      character(len=:), allocatable :: text

      text = ''
      if (self%length > 0) text = self%buffer(:self%length)
   end function text

   !> The text as numbers of characters (1, characters), for files that hold numbers.
   pure function codes(self) result(numbers)
      class(growing_text_t), intent(in) :: self
      integer, allocatable :: numbers(:, :)
      integer :: i

      allocate (numbers(1, self%length))
      do i = 1, self%length
         numbers(1, i) = iachar(self%buffer(i:i))
      end do
   end function codes

end module litz_growing_text
