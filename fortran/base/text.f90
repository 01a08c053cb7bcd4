!> Words and numbers as text: case, blanks, lists, and the nearest of several words.
module litz_text
   use litz_kinds, only: dp
   implicit none
   private
   public :: upper, lower, squeezed, to_text, shown, plural, nearest_word, words_of, join_words, wrapped

   !> Longest word that a list of words holds
   integer, parameter, public :: word_length = 32

   !> Longest piece of the user's text that a message repeats
   integer, parameter :: shown_length = 60

   interface to_text
      module procedure integer_to_text, real_to_text
   end interface to_text

contains

   pure function upper(text) result(capitals)
      !> Letters beyond ASCII stay as they are
      character(len=*), intent(in) :: text
      character(len=len(text)) :: capitals
      integer :: i

      do i = 1, len(text)
         if (text(i:i) >= 'a' .and. text(i:i) <= 'z') then
            capitals(i:i) = achar(iachar(text(i:i)) - 32)
         else
            capitals(i:i) = text(i:i)
         end if
      end do
   end function upper

   pure function lower(text) result(small)
      !> Letters beyond ASCII stay as they are
      character(len=*), intent(in) :: text
      character(len=len(text)) :: small
      integer :: i

      small = text
      do i = 1, len(text)
         if (text(i:i) >= 'A' .and. text(i:i) <= 'Z') small(i:i) = achar(iachar(text(i:i)) + 32)
      end do
   end function lower

   !> Capitals without any blank: the form in which keywords and choices are compared.
   pure function squeezed(text) result(word)
      !> A keyword or a choice as the user wrote it
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: word
      integer, parameter :: tabulator = 9, blank = 32
      character(len=len(text)) :: buffer
      integer :: i, n

      n = 0
      do i = 1, len_trim(text)
         ! by number: gfortran calls a function for each comparison with a blank
         if (iachar(text(i:i)) == tabulator .or. iachar(text(i:i)) == blank) cycle
         n = n + 1
         buffer(n:n) = text(i:i)
      end do
      word = upper(buffer(:n))
   end function squeezed

   pure function integer_to_text(number) result(text)
      !> Any integer
      integer, intent(in) :: number
      character(len=:), allocatable :: text
      character(len=12) :: buffer

      write (buffer, '(i0)') number
      text = trim(buffer)
   end function integer_to_text

   !> At most six significant digits, without padding: 0.001, 1.2e+11, 384.6
   pure function real_to_text(number) result(text)
      !> Any real number, infinities included
      real(dp), intent(in) :: number
      character(len=:), allocatable :: text
      character(len=24) :: buffer, form
      integer :: exponent_at, power

      if (.not. abs(number) <= huge(number)) then
         text = 'not finite'
      else if (.not. abs(number) > 0) then
         text = '0'
      else if (abs(number) >= 1.0e-3_dp .and. abs(number) < 1.0e6_dp) then
         ! a zero before the point comes from the width
         write (form, '("(f20.", i0, ")")') 5 - floor(log10(abs(number)))
         write (buffer, form) number
         text = without_trailing_zeros(trim(adjustl(buffer)))
      else
         write (buffer, '(es16.5e3)') number
         buffer = adjustl(buffer)
         exponent_at = index(buffer, 'E')
         read (buffer(exponent_at + 1:), '(i4)') power
         text = without_trailing_zeros(buffer(:exponent_at - 1))
         write (buffer, '(sp, i0.2)') power
         text = text//'e'//trim(buffer)
      end if
   end function real_to_text

   !> Without the zeros behind the point, and without the point when nothing is left behind it.
   pure function without_trailing_zeros(digits) result(text)
      !> A decimal number without an exponent
      character(len=*), intent(in) :: digits
      character(len=:), allocatable :: text
      integer :: last

      last = len_trim(digits)
      if (index(digits, '.') > 0) then
         do while (digits(last:last) == '0')
            last = last - 1
         end do
         if (digits(last:last) == '.') last = last - 1
      end if
      text = digits(:last)
   end function without_trailing_zeros

   !> The user's text in quotes, fit for a message: one line, no control characters, not too long.
   pure function shown(text) result(quoted)
      !> As the user wrote it
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: quoted
      integer :: i

      quoted = text(:min(len(text), shown_length))
      do i = 1, len(quoted)
         if (iachar(quoted(i:i)) < 32 .or. iachar(quoted(i:i)) == 127) quoted(i:i) = '?'
      end do
      if (len(text) > shown_length) quoted = quoted//'...'
      quoted = '"'//quoted//'"'
   end function shown

   !> `1 node`, `2 nodes`
   pure function plural(number, noun) result(text)
      !> How many there are
      integer, intent(in) :: number
      !> In the singular; its plural must end in `s`
      character(len=*), intent(in) :: noun
      character(len=:), allocatable :: text

      text = to_text(number)//' '//noun
      if (number /= 1) text = text//'s'
   end function plural

   !> Split `A|B|C` into words.
   pure function words_of(list) result(words)
      !> The words with bars between them; blanks around a word do not count
      character(len=*), intent(in) :: list
      character(len=word_length), allocatable :: words(:)
      integer :: i, first, last, n

      n = 0
      if (len_trim(list) > 0) n = 1 + count([(list(i:i) == '|', i=1, len(list))])
      allocate (words(n))
      first = 1
      do i = 1, n
         last = index(list(first:), '|') + first - 2
         if (i == n) last = len_trim(list)
         words(i) = adjustl(list(first:last))
         first = last + 2
      end do
   end function words_of

   !> `A, B or C`
   pure function join_words(words, conjunction) result(text)
      !> The words (n); blanks at their ends do not count
      character(len=*), intent(in) :: words(:)
      !> What stands before the last word: `and`, `or`
      character(len=*), intent(in) :: conjunction
      character(len=:), allocatable :: text
      integer :: i

      text = ''
      do i = 1, size(words)
         if (i > 1 .and. i == size(words)) then
            text = text//' '//conjunction//' '
         else if (i > 1) then
            text = text//', '
         end if
         text = text//trim(words(i))
      end do
   end function join_words

   !> Lines of at most `width` columns, each ended by a new-line character.
   pure function wrapped(text, width, indent) result(lines)
      !> One line of words
      character(len=*), intent(in) :: text
      !> Most columns of a line
      integer, intent(in) :: width
      !> Blanks before the second and later lines
      integer, intent(in) :: indent
      character(len=:), allocatable :: lines
      integer :: first, last, room

      lines = ''
      first = 1
      room = width
      do while (len(text) - first + 1 > room)
         last = first + index(text(first:first + room), ' ', back=.true.) - 2
         if (last < first) exit
         lines = lines//text(first:last)//new_line('a')//repeat(' ', indent)
         first = last + 2
         room = width - indent
      end do
      lines = lines//text(first:)//new_line('a')
   end function wrapped

   !> The word that was probably meant, or an empty string when none is near.
   pure function nearest_word(word, candidates) result(nearest)
      !> As the user wrote it
      character(len=*), intent(in) :: word
      !> The words (n) that are allowed
      character(len=*), intent(in) :: candidates(:)
      character(len=:), allocatable :: nearest
      integer :: i, distance, best

      nearest = ''
      if (len(word) > 2*word_length) return
      best = 1 + max(1, len(word)/3)
      do i = 1, size(candidates)
         if (abs(len_trim(candidates(i)) - len(word)) >= best) cycle
         distance = edit_distance(squeezed(word), squeezed(candidates(i)))
         if (distance < best) then
            best = distance
            nearest = trim(candidates(i))
         end if
      end do
   end function nearest_word

   !> Fewest insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b`.
   !> Source: optimal string alignment distance (restricted Damerau-Levenshtein).
   pure integer function edit_distance(a, b) result(distance)
      !> The two words
      character(len=*), intent(in) :: a, b
      integer :: d(0:len(a), 0:len(b)), i, j

      d(:, 0) = [(i, i=0, len(a))]
      d(0, :) = [(j, j=0, len(b))]
      do j = 1, len(b)
         do i = 1, len(a)
            d(i, j) = min(d(i - 1, j) + 1, d(i, j - 1) + 1, d(i - 1, j - 1) + merge(0, 1, a(i:i) == b(j:j)))
            if (i > 1 .and. j > 1) d(i, j) = min(d(i, j), swapped(i, j))
         end do
      end do
      distance = d(len(a), len(b))

   contains

      !> Cost when the last two letters have changed places.
      pure integer function swapped(last_a, last_b)
         !> Position of the last letter of the parts of `a` and `b` that are compared, both at least 2
         integer, intent(in) :: last_a, last_b

         swapped = huge(swapped)
         if (a(last_a:last_a) == b(last_b - 1:last_b - 1) .and. a(last_a - 1:last_a - 1) == b(last_b:last_b)) then
            swapped = d(last_a - 2, last_b - 2) + 1
         end if
      end function swapped

   end function edit_distance

end module litz_text
