!> Numbers from text against the run-time library, hash tables and sorting against plain searches, words.
program test_text_tools
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_negative_inf
   use litz_kinds, only: dp, int64
   use litz_lookup, only: id_map_t, name_map_t
   use litz_numbers, only: parse_integer, parse_real, number_ok, number_not_one, number_not_finite, number_too_large, &
      number_too_small
   use litz_number_text, only: line_length, put_integer, put_real, put_text
   use litz_sorting, only: sort_integers
   use litz_text, only: to_text, nearest_word, shown, join_words, words_of, wrapped
   implicit none

   integer :: failures = 0

   call start_random_numbers()
   call numbers_are_rounded_as_the_library_rounds_them()
   call what_is_not_a_number_is_refused()
   call whole_numbers_have_limits()
   call ids_are_found_whatever_their_steps()
   call names_are_found_and_new_ones_counted()
   call sorted_values_ascend()
   call numbers_are_written_with_six_digits()
   call numbers_of_tables_are_those_of_the_library()
   call the_nearest_word_is_near()
   if (failures > 0) error stop 1

contains

   !> The same numbers in every run.
   subroutine start_random_numbers()
      integer, allocatable :: seed(:)
      integer :: n, i

      call random_seed(size=n)
      allocate (seed(n))
      seed = [(104729*i, i=1, n)]
      call random_seed(put=seed)
   end subroutine start_random_numbers

   subroutine require(condition, what)
      logical, intent(in) :: condition
      character(len=*), intent(in) :: what

      if (condition) return
      failures = failures + 1
      print '(2a)', 'failed: ', what
   end subroutine require

   !> Up to 25 digits and exponents over the whole range, bit by bit.
   subroutine numbers_are_rounded_as_the_library_rounds_them()
      character(len=80) :: text
      real(dp) :: draw(30), value, expected
      integer :: i, j, n_digits, point, status, n_compared

      n_compared = 0
      do i = 1, 20000
         call random_number(draw)
         n_digits = 1 + int(25*draw(26))
         point = int((n_digits + 1)*draw(27))
         text = merge('-', '+', draw(28) < 0.5_dp)
         do j = 1, n_digits
            if (j == point + 1) text = trim(text)//'.'
            text = trim(text)//achar(iachar('0') + int(10*draw(j)))
         end do
         if (draw(29) < 0.8_dp) write (text, '(2a, i0)') trim(text), 'e', nint((2*draw(30) - 1)*merge(25, 280, &
            draw(29) < 0.5_dp))
         call parse_real(trim(text), value, status)
         read (text, *) expected
         if (abs(expected) < tiny(expected) .or. abs(expected) > huge(expected)) cycle
         n_compared = n_compared + 1
         call require(status == number_ok, trim(text)//' is a number')
         call require(transfer(value, 0_int64) == transfer(expected, 0_int64), trim(text)//' is rounded correctly')
      end do
      call require(n_compared > 19000, 'most draws are normal numbers')
   end subroutine numbers_are_rounded_as_the_library_rounds_them

   subroutine what_is_not_a_number_is_refused()
      character(len=12), parameter :: wrong(*) = [character(len=12) :: '', '+', '-', '.', 'e5', '1e', '1e+', '1..2', &
         '1.2.3', '1,2', '1 2', 'abc', '1.5x', '--1', '+-1', '1e5.', '0x10', '1_2', '"1"', '1+5']
      real(dp) :: value
      integer :: i, status

      do i = 1, size(wrong)
         call parse_real(trim(wrong(i)), value, status)
         call require(status == number_not_one, '"'//trim(wrong(i))//'" is not a number')
      end do
      call parse_real('-inf', value, status)
      call require(status == number_not_finite, '-inf')
      call parse_real('NaN', value, status)
      call require(status == number_not_finite, 'NaN')
      call parse_real('1.8e308', value, status)
      call require(status == number_too_large, '1.8e308')
      call parse_real('1e99999999999999999999', value, status)
      call require(status == number_too_large, 'huge exponent')
      call parse_real('1e-310', value, status)
      call require(status == number_too_small, '1e-310')
      call parse_real('0e-99999', value, status)
      call require(status == number_ok .and. .not. abs(value) > 0, 'zero with an exponent')
      call parse_real(repeat('0', 400)//'.5', value, status)
      call require(status == number_ok .and. abs(value - 0.5_dp) < 1.0e-300_dp, 'leading zeros')
      call parse_real('1'//repeat('0', 400)//'e-400', value, status)
      call require(status == number_ok .and. abs(value - 1) < epsilon(1.0_dp), 'many digits and a small exponent')
   end subroutine what_is_not_a_number_is_refused

   subroutine whole_numbers_have_limits()
      integer :: value, status

      call parse_integer('2147483647', value, status)
      call require(status == number_ok .and. value == huge(value), 'the largest whole number')
      call parse_integer('2147483648', value, status)
      call require(status == number_too_large, 'one more')
      call parse_integer(repeat('9', 100), value, status)
      call require(status == number_too_large, 'very many digits')
      call parse_integer('-007', value, status)
      call require(status == number_ok .and. value == -7, 'sign and leading zeros')
      call parse_integer('7.', value, status)
      call require(status == number_not_one, '7. is not a whole number')
      call parse_integer('', value, status)
      call require(status == number_not_one, 'nothing is not a number')
   end subroutine whole_numbers_have_limits

   subroutine ids_are_found_whatever_their_steps()
      integer, parameter :: steps(*) = [1, 2, 7, 64, 1000, 4096, 65536], n = 20000
      type(id_map_t) :: map
      integer :: i, s

      do s = 1, size(steps)
         map = id_map_t()
         call require(map%get(1) == 0, 'nothing is in an empty map')
         do i = 1, n
            call map%put(steps(s)*i, i)
         end do
         call require(all([(map%get(steps(s)*i), i=1, n)] == [(i, i=1, n)]), 'every id is found, step '// &
            to_text(steps(s)))
         call require(map%get(steps(s)*(n + 1)) == 0 .and. map%get(-1) == 0, 'other ids are not there')
      end do
   end subroutine ids_are_found_whatever_their_steps

   subroutine names_are_found_and_new_ones_counted()
      type(name_map_t) :: map
      integer :: i, index
      integer, parameter :: n = 5000

      call require(map%get('A') == 0, 'nothing is in an empty map')
      do i = 1, n
         call map%put('SET_'//to_text(i), index)
         call require(index == i, 'a new name has the next number')
      end do
      call map%put('SET_17', index)
      call require(index == 17 .and. map%n == n, 'a known name keeps its number')
      call require(map%get('SET_4999') == 4999 .and. map%get('SET_') == 0, 'names are found')
      call require(map%name(321) == 'SET_321', 'names come back')
   end subroutine names_are_found_and_new_ones_counted

   subroutine sorted_values_ascend()
      real(dp) :: draw(1000)
      integer :: values(1000), n, i

      do n = 0, 1000, 37
         call random_number(draw)
         values = int(500*draw)
         i = sum(values(:n))
         call sort_integers(values(:n))
         call require(all(values(2:n) >= values(:n - 1)), 'values ascend')
         call require(sum(values(:n)) == i, 'no value is lost')
      end do
   end subroutine sorted_values_ascend

   subroutine numbers_are_written_with_six_digits()
      real(dp), parameter :: numbers(*) = [0.0_dp, 1.0_dp, -0.5_dp, 100.0_dp, 999999.0_dp, 1.0e6_dp, 1.0e-3_dp, &
         9.9e-4_dp, &
         1.2e11_dp, 123456.7_dp, 0.1234567_dp, -2.5e-300_dp]
      character(len=12), parameter :: texts(*) = [character(len=12) :: '0', '1', '-0.5', '100', '999999', '1e+06', &
         '0.001', &
         '9.9e-04', '1.2e+11', '123457', '0.123457', '-2.5e-300']
      integer :: i

      do i = 1, size(numbers)
         call require(to_text(numbers(i)) == texts(i), trim(texts(i))//' is not '//to_text(numbers(i)))
      end do
      call require(to_text(-12) == '-12', 'whole numbers')
   end subroutine numbers_are_written_with_six_digits

   subroutine the_nearest_word_is_near()
      character(len=8), parameter :: words(3) = ['MATERIAL', 'ELASTIC ', 'NODE    ']

      call require(nearest_word('MATREIAL', words) == 'MATERIAL', 'two letters changed places')
      call require(nearest_word('elastik', words) == 'ELASTIC', 'one letter is wrong, case does not matter')
      call require(nearest_word('NOD', words) == 'NODE', 'a letter is missing')
      call require(nearest_word('BOUNDARY', words) == '', 'nothing is near')
      call require(shown('a'//achar(9)//'b') == '"a?b"', 'control characters are not shown')
      call require(len(shown(repeat('x', 1000))) < 80, 'long text is cut')
      call require(join_words(words_of('A|B|C'), 'or') == 'A, B or C', 'words of a list')
      call require(wrapped('one two three', 9, 2) == 'one two'//new_line('a')//'  three'//new_line('a'), 'two lines')
      call require(wrapped('one two', 7, 2) == 'one two'//new_line('a'), 'a line that just fits')
      call require(wrapped('unbreakable', 4, 2) == 'unbreakable'//new_line('a'), 'a word longer than the line')
   end subroutine the_nearest_word_is_near

   !> Over more than the range that needs no library, next to powers of ten, with few digits, and integers.
   subroutine numbers_of_tables_are_those_of_the_library()
      integer, parameter :: whole(*) = [0, 7, -10, 123456789, huge(0), -huge(0) - 1]
      real(dp), parameter :: special(*) = [0.0_dp, -0.0_dp, tiny(1.0_dp), -huge(1.0_dp), 0.1_dp, -1.0_dp, 1.0e16_dp, &
         1.0e17_dp]
      character(len=line_length) :: text, expected
      real(dp) :: draw(3), value
      integer :: i, used

      do i = 1, 40000 + size(special)
         call random_number(draw)
         select case (mod(i, 4))
         case (0)
            value = (draw(1) - 0.5_dp)*10.0_dp**(60*draw(2) - 35)
         case (1)
            value = int(1000*draw(1))*10.0_dp**int(40*draw(2) - 25)
         case (2)
            value = 10.0_dp**int(60*draw(1) - 35)*(1 + epsilon(value)*int(8*draw(2) - 4))
         case default
            value = int(1.0e6_dp*draw(1))/8.0_dp
         end select
         if (i > 40000) value = special(max(1, i - 40000))
         if (i == 1) value = ieee_value(value, ieee_quiet_nan)
         if (i == 2) value = ieee_value(value, ieee_negative_inf)
         write (expected, '(g0, a)') value, ';'
         text = ''
         used = 0
         call put_real(value, text, used)
         call put_text(';', text, used)
         call require(text == expected .and. used == len_trim(expected), trim(expected)//' is not '//trim(text))
      end do
      do i = 1, size(whole)
         write (expected, '(i0)') whole(i)
         text = ''
         used = 0
         call put_integer(whole(i), text, used)
         call require(text == expected .and. used == len_trim(expected), trim(expected)//' is not '//trim(text))
      end do
   end subroutine numbers_of_tables_are_those_of_the_library

end program test_text_tools
