!> The record of a model as it grows: lines of text, and checksums of what means nothing to a reader.
!>
!> A line is `step tab subject tab what tab kind value`; an empty `what` says that there is such a subject.
module litz_record_lines
   use litz_kinds, only: dp, int64
   use litz_checksum, only: checksum
   use litz_growing_text, only: growing_text_t
   use litz_text, only: to_text
   implicit none
   private
   public :: record_t, kind_real, kind_text, kind_sum, sum_text, bits, checksum_of_text

   character(len=1), parameter :: nl = new_line('a'), tab = achar(9)

   type :: record_t
      type(growing_text_t) :: lines
      !> The step that the next lines belong to; 0: the model
      integer :: step = 0
      character(len=:), allocatable :: subject
   contains
      procedure :: begin
      procedure :: add
      procedure, private :: add_real, add_reals, add_integer, add_integers, add_text
      generic :: value => add_real, add_integer, add_text
      generic :: list => add_reals, add_integers
   end type record_t

   !> What a value is: a number, a word, a number or sum that means nothing to a reader
   character(len=1), parameter :: kind_real = 'r', kind_text = 't', kind_sum = 's'

contains

   !> Whether there is a thing at all is a line of its own: what is missing is then named once.
   pure subroutine begin(self, subject)
      class(record_t), intent(inout) :: self
      !> What the lines to come belong to, as messages name it
      character(len=*), intent(in) :: subject

      self%subject = subject
      call self%add('', kind_text, '')
   end subroutine begin

   pure subroutine add(self, what, kind, value)
      class(record_t), intent(inout) :: self
      !> Name of the quantity within the subject
      character(len=*), intent(in) :: what
      !> One letter that says how values are compared, one of `kind_...`
      character(len=*), intent(in) :: kind
      !> The value as text
      character(len=*), intent(in) :: value

      call self%lines%append(to_text(self%step)//tab//self%subject//tab//what//tab//kind//value//nl)
   end subroutine add

   pure subroutine add_real(self, what, value)
      class(record_t), intent(inout) :: self
      !> Name of the quantity within the subject
      character(len=*), intent(in) :: what
      !> Any finite number
      real(dp), intent(in) :: value
      character(len=32) :: buffer

      ! 18 digits distinguish any two numbers; plus zero: there is one zero only
      write (buffer, '(es25.17e3)') value + 0.0_dp
      call self%add(what, kind_real, trim(adjustl(buffer)))
   end subroutine add_real

   !> One of several choices.
   pure subroutine add_integer(self, what, value)
      class(record_t), intent(inout) :: self
      !> Name of the quantity within the subject
      character(len=*), intent(in) :: what
      !> Number of the choice
      integer, intent(in) :: value

      call self%add(what, kind_sum, to_text(value))
   end subroutine add_integer

   pure subroutine add_text(self, what, value)
      class(record_t), intent(inout) :: self
      !> Name of the quantity within the subject
      character(len=*), intent(in) :: what
      !> The value; may be empty
      character(len=*), intent(in) :: value

      call self%add(what, kind_text, value)
   end subroutine add_text

   pure subroutine add_reals(self, what, values)
      class(record_t), intent(inout) :: self
      !> Name of the quantity within the subject
      character(len=*), intent(in) :: what
      !> Numbers (components, items)
      real(dp), intent(in) :: values(:, :)

      call self%add(what, kind_sum, sum_text(checksum(values + 0.0_dp)))
   end subroutine add_reals

   pure subroutine add_integers(self, what, values)
      class(record_t), intent(inout) :: self
      !> Name of the quantity within the subject
      character(len=*), intent(in) :: what
      !> Numbers (components, items)
      integer, intent(in) :: values(:, :)

      call self%add(what, kind_sum, sum_text(checksum(int(values, int64))))
   end subroutine add_integers

   pure function sum_text(total) result(text)
      !> A checksum
      integer(int64), intent(in) :: total
      character(len=:), allocatable :: text
      character(len=24) :: buffer

      write (buffer, '(i0)') total
      text = trim(buffer)
   end function sum_text

   elemental integer(int64) function bits(value)
      !> The number whose bits are wanted; both zeros count as one
      real(dp), intent(in) :: value

      bits = transfer(value + 0.0_dp, bits)
   end function bits

   pure integer(int64) function checksum_of_text(text) result(total)
      !> ASCII
      character(len=*), intent(in) :: text
      integer(int64) :: codes(len(text), 1)
      integer :: i

      do i = 1, len(text)
         codes(i, 1) = iachar(text(i:i))
      end do
      total = checksum(codes)
   end function checksum_of_text

end module litz_record_lines
