!> Numbers as text, as the edit descriptor `g0` writes them, in a tenth of its time: a table of contacts has millions.
!>
!> A number times a power of ten has its 17 significant digits before the point, and an error far below one in a kind of
!> 64 bits. Where that might change the last digit, and outside the range, the run-time library writes the number.
module litz_number_text
   use litz_kinds, only: dp, int64
   implicit none
   private
   public :: put_real, put_integer, put_text, line_length

   !> Of a line of a table, at most
   integer, parameter :: line_length = 2048
   !> Significant digits of a real
   integer, parameter :: n_digits = 17
   !> With 18 digits or more, if there is such a kind
   integer, parameter :: long = merge(selected_real_kind(18), dp, selected_real_kind(18) > 0)
   !> Exponents `e` of `0.d1d2d3... 10^e`: below, the power of ten is beyond the table, above, no digit is behind the
   !> point
   integer, parameter :: least_exponent = -23, largest_exponent = n_digits - 1
   integer :: i
   !> Correctly rounded
   real(long), parameter :: power(0:n_digits - least_exponent) = [(10.0_long**i, i=0, n_digits - least_exponent)]
   !> Error of the digits at most: of the power and of the product
   real(long), parameter :: doubt = epsilon(1.0_long)*power(n_digits)

contains

   !> Write a real behind the first characters of a text.
   pure subroutine put_real(value, text, used)
      !> Any number, also one that is not finite
      real(dp), intent(in) :: value
      !> A line
      character(len=line_length), intent(inout) :: text
      !> Characters of it so far
      integer, intent(inout) :: used
      character(len=n_digits) :: digits
      character(len=40) :: buffer
      integer :: exponent
      logical :: is_known

      if (abs(value) <= 0) then
         call put_text(trim(merge('-', ' ', sign(1.0_dp, value) < 0))//'0.0000000000000000', text, used)
         return
      end if
      call find_digits(abs(value), digits, exponent, is_known)
      if (.not. is_known) then
         write (buffer, '(g0)') value
         call put_text(trim(buffer), text, used)
         return
      end if
      if (value < 0) call put_text('-', text, used)
      if (exponent > 0) then
         call put_text(digits(:exponent)//'.'//digits(exponent + 1:), text, used)
         return
      end if
      call put_text('0.'//digits, text, used)
      if (exponent == 0) return
      call put_text('E', text, used)
      call put_integer(exponent, text, used)
   end subroutine put_real

   !> The same with an integer.
   pure subroutine put_integer(number, text, used)
      !> Any integer
      integer, intent(in) :: number
      !> As in `put_real`
      character(len=line_length), intent(inout) :: text
      !> As there
      integer, intent(inout) :: used
      character(len=20) :: digits
      integer(int64) :: rest
      integer :: first

      if (number < 0) call put_text('-', text, used)
      rest = abs(int(number, int64))
      first = len(digits) + 1
      do
         first = first - 1
         digits(first:first) = achar(iachar('0') + int(mod(rest, 10_int64)))
         rest = rest/10
         if (rest == 0) exit
      end do
      call put_text(digits(first:), text, used)
   end subroutine put_integer

   !> The same with text.
   pure subroutine put_text(more, text, used)
      !> Any text
      character(len=*), intent(in) :: more
      !> As in `put_real`
      character(len=line_length), intent(inout) :: text
      !> As there
      integer, intent(inout) :: used

      text(used + 1:used + len(more)) = more
      used = used + len(more)
   end subroutine put_text

   !> The significant digits of a number, and its exponent as in `0.d1d2d3... 10^e`.
   pure subroutine find_digits(magnitude, digits, exponent, is_known)
      !> Greater than 0
      real(dp), intent(in) :: magnitude
      !> The first one is not 0
      character(len=n_digits), intent(out) :: digits
      !> e
      integer, intent(out) :: exponent
      !> They are what the run-time library would write
      logical, intent(out) :: is_known
      real(long) :: scaled
      integer(int64) :: whole
      integer :: k

      is_known = .false.
      digits = ''
      exponent = 0
      if (.not. (magnitude > 10.0_dp**(least_exponent + 1) .and. magnitude < 10.0_dp**(largest_exponent - 1))) return
      exponent = floor(log10(magnitude)) + 1
      if (magnitude*power(n_digits - exponent) < power(n_digits - 1)) exponent = exponent - 1
      scaled = magnitude*power(n_digits - exponent)
      whole = int(scaled, int64)
      ! near the middle between two integers, or next to a power of ten
      if (abs(scaled - whole - 0.5_long) <= doubt) return
      if (scaled - whole > 0.5_long) whole = whole + 1
      is_known = whole >= 10_int64**(n_digits - 1) .and. whole < 10_int64**n_digits
      do k = n_digits, 1, -1
         digits(k:k) = achar(iachar('0') + int(mod(whole, 10_int64)))
         whole = whole/10
      end do
   end subroutine find_digits

end module litz_number_text
