!> What two records of models differ in (litz_model_record), as text for a message.
module litz_record_differences
   use litz_kinds, only: dp
   use litz_lookup, only: name_map_t
   use litz_model_record, only: kind_real, kind_sum
   use litz_text, only: to_text
   implicit none
   private
   public :: record_differences

   character(len=1), parameter :: nl = new_line('a'), tab = achar(9)
   !> Differences that a message names one by one
   integer, parameter :: max_named = 3

   !> A line of a record, taken apart.
   type :: line_t
      integer :: step = 0
      character(len=:), allocatable :: subject, what, kind, value
   end type line_t

contains

   !> What two records differ in, as text for a message; empty: nothing that matters.
   function record_differences(before, now, last_step) result(words)
      !> Records of the run that is continued, and of the deck
      character(len=*), intent(in) :: before, now
      !> Steps after this one have not begun, and may differ
      integer, intent(in) :: last_step
      character(len=:), allocatable :: words
      type(line_t), allocatable :: old(:), new(:)
      type(name_map_t) :: old_places, new_places
      character(len=:), allocatable :: missing
      integer :: i, place, n

      call take_apart(before, last_step, old, old_places)
      call take_apart(now, last_step, new, new_places)
      words = ''
      missing = ''
      n = 0
      do i = 1, size(old)
         place = new_places%get(key_of(old(i)))
         if (place == 0) then
            call report(old(i), ' in the restart file, but not in the deck')
         else if (old(i)%kind//old(i)%value /= new(place)%kind//new(place)%value) then
            call report(old(i), comparison(old(i), new(place)))
         end if
      end do
      do i = 1, size(new)
         if (old_places%get(key_of(new(i))) == 0) call report(new(i), ' in the deck, but not in the restart file')
      end do
      if (n > max_named) words = words//'; and '//to_text(n - max_named)//' more'

   contains

      !> Name a difference, but no part of something that is missing as a whole.
      subroutine report(line, what)
         type(line_t), intent(in) :: line
         !> What is different about the line, as the end of a clause
         character(len=*), intent(in) :: what

         if (line%subject == missing) return
         if (len(line%what) == 0) missing = line%subject
         n = n + 1
         if (n > max_named) return
         if (n > 1) words = words//'; '
         words = words//name_of(line)//what
      end subroutine report

   end function record_differences

   pure function comparison(old, new) result(words)
      type(line_t), intent(in) :: old, new
      character(len=:), allocatable :: words
      character(len=:), allocatable :: before, now

      words = ' changed'
      if (old%kind == kind_sum .or. new%kind == kind_sum) return
      before = readable(old)
      now = readable(new)
      if (before == now) then
         before = old%value
         now = new%value
      end if
      words = ' '//before//' in the restart file, '//now//' in the deck'
   end function comparison

   !> A number with few digits.
   pure function readable(line) result(text)
      type(line_t), intent(in) :: line
      character(len=:), allocatable :: text
      real(dp) :: number
      integer :: status

      text = line%value
      if (line%kind /= kind_real) return
      read (line%value, *, iostat=status) number
      if (status == 0) text = to_text(number)
   end function readable

   pure function name_of(line) result(name)
      type(line_t), intent(in) :: line
      character(len=:), allocatable :: name

      name = line%subject
      if (len(line%what) > 0) name = name//': '//line%what
   end function name_of

   pure function key_of(line) result(key)
      type(line_t), intent(in) :: line
      character(len=:), allocatable :: key

      key = to_text(line%step)//tab//line%subject//tab//line%what
   end function key_of

   !> The lines of a record that belong to the model or to steps that have begun, and their places by name.
   pure subroutine take_apart(record, last_step, lines, places)
      !> Lines of a record, each with its end
      character(len=*), intent(in) :: record
      !> Number of the last step that has begun; the lines of later ones do not count
      integer, intent(in) :: last_step
      type(line_t), allocatable, intent(out) :: lines(:)
      type(name_map_t), intent(inout) :: places
      type(line_t), allocatable :: found(:)
      character(len=:), allocatable :: rest
      integer :: at, next, i, n, status, place

      n = 0
      do i = 1, len(record)
         if (record(i:i) == nl) n = n + 1
      end do
      allocate (found(n))
      n = 0
      at = 1
      do while (at <= len(record))
         next = index(record(at:), nl)
         if (next == 0) exit
         rest = record(at:at + next - 2)
         at = at + next
         read (rest(:index(rest, tab)), *, iostat=status) i
         if (status /= 0 .or. i > last_step) cycle
         rest = rest(index(rest, tab) + 1:)
         n = n + 1
         found(n)%step = i
         found(n)%subject = rest(:index(rest, tab) - 1)
         rest = rest(index(rest, tab) + 1:)
         found(n)%what = rest(:index(rest, tab) - 1)
         rest = rest(index(rest, tab) + 1:)//' '
         found(n)%kind = rest(:1)
         found(n)%value = trim(rest(2:))
         call places%put(key_of(found(n)), place)
      end do
      lines = found(:n)
   end subroutine take_apart

end module litz_record_differences
