!> Numbers from text, fast and strict: the whole text is one finite number, or it is refused with a reason.
module litz_numbers
   use litz_kinds, only: dp, int64
   implicit none
   private
   public :: parse_integer, parse_real
   public :: number_ok, number_not_one, number_not_finite, number_too_large, number_too_small

   integer, parameter :: number_ok = 0, number_not_one = 1, number_not_finite = 2, number_too_large = 3, &
      number_too_small = 4

   !> Powers of ten that a double holds exactly
   real(dp), parameter :: exact_power(0:22) = [1.0e0_dp, 1.0e1_dp, 1.0e2_dp, 1.0e3_dp, 1.0e4_dp, 1.0e5_dp, 1.0e6_dp, &
      1.0e7_dp, 1.0e8_dp, 1.0e9_dp, 1.0e10_dp, 1.0e11_dp, 1.0e12_dp, 1.0e13_dp, 1.0e14_dp, 1.0e15_dp, 1.0e16_dp, &
      1.0e17_dp, 1.0e18_dp, 1.0e19_dp, 1.0e20_dp, 1.0e21_dp, 1.0e22_dp]
   !> Integers up to here are exact in a double
   integer(int64), parameter :: largest_exact = 2_int64**53
   !> Digits that surely fit into a 64-bit integer
   integer, parameter :: max_digits = 18
   !> Exponents are not counted further than this
   integer, parameter :: largest_exponent = 100000

contains

   pure subroutine parse_integer(text, value, status)
      !> Without blanks around it
      character(len=*), intent(in) :: text
      !> The number; 0 unless `status` is `number_ok`
      integer, intent(out) :: value
      !> `number_ok`, or why the text is no number: one of `number_...`
      integer, intent(out) :: status
      integer(int64) :: magnitude
      integer :: i, first

      value = 0
      status = number_not_one
      first = after_sign(text, 1)
      if (first > len(text)) return
      magnitude = 0
      do i = first, len(text)
         if (.not. is_digit(text(i:i))) return
         if (magnitude <= huge(value)) magnitude = 10*magnitude + (iachar(text(i:i)) - iachar('0'))
      end do
      status = number_too_large
      if (magnitude > huge(value)) return
      value = int(magnitude)
      if (text(1:1) == '-') value = -value
      status = number_ok
   end subroutine parse_integer

   !> Correctly rounded. Numbers of few digits need one exact multiplication or division (Clinger's fast path); the
   !> others go through the run-time library.
   pure subroutine parse_real(text, value, status)
      !> Without blanks around it; `1`, `-.5`, `2.e3`, `1.5d-3`
      character(len=*), intent(in) :: text
      !> The number; 0 where the text is none
      real(dp), intent(out) :: value
      !> `number_ok`, or why the text is no number: one of `number_...`
      integer, intent(out) :: status
      integer(int64) :: mantissa
      integer :: exponent, n_digits

      value = 0
      call split_number(text, mantissa, exponent, n_digits, status)
      if (status /= number_ok .or. n_digits == 0) return
      if (n_digits <= max_digits .and. mantissa <= largest_exact .and. abs(exponent) <= 22) then
         if (exponent >= 0) then
            value = real(mantissa, dp)*exact_power(exponent)
         else
            value = real(mantissa, dp)/exact_power(-exponent)
         end if
         if (text(1:1) == '-') value = -value
      else
         call parse_long_real(text, n_digits + exponent, value, status)
      end if
   end subroutine parse_real

   !> Digits and exponent of a decimal number `mantissa * 10^exponent`.
   pure subroutine split_number(text, mantissa, exponent, n_digits, status)
      !> Without blanks around it
      character(len=*), intent(in) :: text
      !> The first `max_digits` digits as one number, without the sign
      integer(int64), intent(out) :: mantissa
      !> Power of ten that belongs to the complete digits
      integer, intent(out) :: exponent
      !> Digits from the first that is not zero on; 0: the number is zero; more than `max_digits`: `mantissa` is not
      !> complete
      integer, intent(out) :: n_digits
      !> `number_ok`, or why the text is no number: one of `number_...`
      integer, intent(out) :: status
      integer :: i, n_all, after_point
      logical :: point

      mantissa = 0
      exponent = 0
      n_digits = 0
      n_all = 0
      after_point = 0
      point = .false.
      i = after_sign(text, 1)
      do while (i <= len(text))
         if (is_digit(text(i:i))) then
            n_all = n_all + 1
            if (point) after_point = after_point + 1
            if (n_digits > 0 .or. text(i:i) /= '0') n_digits = n_digits + 1
            if (n_digits <= max_digits) mantissa = 10*mantissa + (iachar(text(i:i)) - iachar('0'))
         else if (text(i:i) == '.' .and. .not. point) then
            point = .true.
         else
            exit
         end if
         i = i + 1
      end do
      status = number_not_one
      if (n_all == 0) then
         if (is_not_finite(text(min(after_sign(text, 1), len(text) + 1):))) status = number_not_finite
         return
      end if
      if (i <= len(text)) then
         call read_exponent(text, i, exponent, status)
         if (status /= number_ok) return
      end if
      exponent = exponent - after_point
      status = number_ok
   end subroutine split_number

   pure subroutine read_exponent(text, first, exponent, status)
      !> The whole number with its exponent
      character(len=*), intent(in) :: text
      !> Where the exponent letter should be
      integer, intent(in) :: first
      !> With its sign; 0 unless `status` is `number_ok`
      integer, intent(out) :: exponent
      !> `number_ok`, or why the text is no number: one of `number_...`
      integer, intent(out) :: status
      integer :: i, start

      exponent = 0
      status = number_not_one
      if (scan(text(first:first), 'eEdD') == 0) return
      start = after_sign(text, first + 1)
      if (start > len(text)) return
      do i = start, len(text)
         if (.not. is_digit(text(i:i))) return
         exponent = min(largest_exponent, 10*exponent + iachar(text(i:i)) - iachar('0'))
      end do
      if (text(first + 1:first + 1) == '-') exponent = -exponent
      status = number_ok
   end subroutine read_exponent

   pure subroutine parse_long_real(text, magnitude, value, status)
      !> A decimal number in good form
      character(len=*), intent(in) :: text
      !> The number is below `10^magnitude` and at least a tenth of it
      integer, intent(in) :: magnitude
      !> The number, correctly rounded; meaningless unless `status` is `number_ok`
      real(dp), intent(out) :: value
      !> `number_ok`, or why the text is no number: one of `number_...`
      integer, intent(out) :: status
      character(len=16) :: form
      integer :: iostat

      value = 0
      status = number_too_large
      ! the last power of ten that fits is not used to its end, so that nothing overflows on the way
      if (magnitude > range(value) + 1) return
      status = number_too_small
      if (magnitude < -range(value) - 1) return
      write (form, '("(f", i0, ".0)")') len(text)
      read (text, form, iostat=iostat) value
      status = number_ok
      if (abs(value) < tiny(value)) status = number_too_small
      if (iostat /= 0 .or. .not. abs(value) <= huge(value)) status = number_too_large
   end subroutine parse_long_real

   !> First position behind an optional sign at `first`.
   pure integer function after_sign(text, first) result(position)
      !> Without blanks around it
      character(len=*), intent(in) :: text
      !> Position of the optional sign, 1 to one beyond the text
      integer, intent(in) :: first

      position = first
      if (first > len(text)) return
      if (text(first:first) == '+' .or. text(first:first) == '-') position = first + 1
   end function after_sign

   pure logical function is_digit(character)
      !> The character to be judged
      character(len=1), intent(in) :: character

      is_digit = character >= '0' .and. character <= '9'
   end function is_digit

   pure logical function is_not_finite(text)
      !> A number without its sign, or anything else
      character(len=*), intent(in) :: text

      select case (text)
      case ('nan', 'NaN', 'NAN', 'Nan', 'inf', 'Inf', 'INF', 'infinity', 'Infinity', 'INFINITY')
         is_not_finite = .true.
      case default
         is_not_finite = .false.
      end select
   end function is_not_finite

end module litz_numbers
