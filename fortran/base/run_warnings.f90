!> What a user must know of a run that is no error: one list, from the deck to the last increment.
!>
!> A warning is known by its kind, a code word such as `shallow_angle`, and the elements that it is about. One that
!> comes again is no new entry: the entry counts the increments, and keeps the first, the last and the worst value. The
!> list is bounded, however long the run and however many contacts it has.
module litz_run_warnings
   use litz_kinds, only: dp
   use litz_growing_text, only: growing_text_t
   use litz_text, only: plural, to_text
   implicit none
   private
   public :: run_warning_t, run_warnings_t
   public :: is_worse, kind_length, max_pairs

   integer, parameter :: kind_length = 32
   !> Entries of one kind, each about other elements; what comes beyond them shares one more entry
   integer, parameter :: max_pairs = 100
   !> Longest message that is kept
   integer, parameter :: max_message = 1000
   character(len=*), parameter :: number_format = '(8(i0, 1x), 3(es25.16e3, 1x), i0)'

   type :: run_warning_t
      character(len=kind_length) :: kind = ''
      !> When it first came up, as a message has it
      character(len=:), allocatable :: message
      !> The user's numbers; 0: about no element, or about one only
      integer :: elements(2) = 0
      !> First and last increment that has it, as step and increment; 0, 0: the start of the run
      integer :: first(2) = 0, last(2) = 0
      !> Total time of both [s]
      real(dp) :: first_time = 0, last_time = 0
      !> Number of increments that have it, the start counted as one
      integer :: count = 1
      !> The worst value so far, and its unit, `-` if it has no name; without a unit there is no value
      real(dp) :: worst = 0
      character(len=:), allocatable :: unit
      !> It stands for all elements of its kind that have no entry
      logical :: is_rest = .false.
   contains
      procedure :: text => warning_text
      procedure :: record => warning_record
   end type run_warning_t

   type :: run_warnings_t
      integer :: n = 0
      type(run_warning_t), allocatable :: items(:)
      !> Entries that the user has been shown
      integer :: n_shown = 0
      !> Where the run is: step and increment, and total time [s]
      integer, private :: place(2) = 0
      real(dp), private :: time = 0
   contains
      procedure :: set_place => warnings_set_place
      procedure :: add => warnings_add
      procedure :: counts => warnings_counts
      procedure :: to_numbers => warnings_to_numbers
      procedure :: from_numbers => warnings_from_numbers
   end type run_warnings_t

contains

   !> The increment that the warnings to come belong to; 0, 0: the start of the run.
   pure subroutine warnings_set_place(self, step, increment, time)
      class(run_warnings_t), intent(inout) :: self
      !> Numbers of the step and of the increment in it
      integer, intent(in) :: step, increment
      !> Total time [s]
      real(dp), intent(in) :: time

      self%place = [step, increment]
      self%time = time
   end subroutine warnings_set_place

   !> Takes down a warning of the present increment.
   pure subroutine warnings_add(self, kind, message, elements, value, unit, smaller_is_worse)
      class(run_warnings_t), intent(inout) :: self
      !> The code word
      character(len=*), intent(in) :: kind
      !> A sentence without a full stop
      character(len=*), intent(in) :: message
      !> The user's numbers of the elements that it is about (1 or 2)
      integer, intent(in), optional :: elements(:)
      !> How bad it is
      real(dp), intent(in), optional :: value
      !> Unit of `value`, such as `degrees`; empty: one that the deck does not name
      character(len=*), intent(in), optional :: unit
      !> .true.: of repeated warnings the smallest value is kept, not the largest
      logical, intent(in), optional :: smaller_is_worse
      type(run_warning_t) :: new
      logical :: downwards
      integer :: i

      new%kind = kind
      new%message = one_line(message)
      if (present(elements)) new%elements(:size(elements)) = elements
      new%first = self%place
      new%last = self%place
      new%first_time = self%time
      new%last_time = self%time
      if (present(value)) new%worst = value
      new%unit = ''
      if (present(unit)) then
         new%unit = unit
         if (len_trim(unit) == 0) new%unit = '-'
      end if
      downwards = .false.
      if (present(smaller_is_worse)) downwards = smaller_is_worse
      call find_entry(self, new, i)
      if (i > 0) then
         call repeat_warning(self%items(i), new, downwards)
      else
         call append(self, new)
      end if
   end subroutine warnings_add

   !> A message is a line of a table: what would end it becomes a blank.
   pure function one_line(text) result(line)
      !> A message of any length
      character(len=*), intent(in) :: text
      character(len=:), allocatable :: line
      integer :: i

      line = text(:min(len(text), max_message))
      do i = 1, len(line)
         if (iachar(line(i:i)) < 32) line(i:i) = ' '
      end do
   end function one_line

   !> The entry that a warning repeats; 0: it is a new one. Where there are too many of its kind, it becomes one of the
   !> rest.
   pure subroutine find_entry(self, new, i)
      type(run_warnings_t), intent(in) :: self
      type(run_warning_t), intent(inout) :: new
      !> Index of the entry
      integer, intent(out) :: i
      integer :: n_alike, rest

      n_alike = 0
      rest = 0
      do i = 1, self%n
         if (self%items(i)%kind /= new%kind) cycle
         if (self%items(i)%is_rest) then
            rest = i
            cycle
         end if
         if (all(self%items(i)%elements == new%elements) .and. is_same_finding(self%items(i), new)) return
         n_alike = n_alike + 1
      end do
      i = rest
      if (rest > 0 .or. n_alike < max_pairs) return
      new%is_rest = .true.
      new%elements = 0
      new%message = 'more than '//to_text(max_pairs)//' places have this warning; the next one: '//new%message
   end subroutine find_entry

   !> Of the start of a run, those about no element are known by their messages: each is about another place of the
   !> deck.
   pure logical function is_same_finding(item, new) result(is_same)
      type(run_warning_t), intent(in) :: item, new

      is_same = .true.
      if (all(new%elements == 0) .and. all(new%first == 0) .and. all(item%first == 0)) is_same = &
         item%message == new%message
   end function is_same_finding

   pure subroutine append(self, new)
      type(run_warnings_t), intent(inout) :: self
      type(run_warning_t), intent(in) :: new
      type(run_warning_t), allocatable :: grown(:)

      if (.not. allocated(self%items)) allocate (self%items(8))
      if (self%n == size(self%items)) then
         allocate (grown(2*self%n))
         grown(:self%n) = self%items
         call move_alloc(grown, self%items)
      end if
      self%n = self%n + 1
      self%items(self%n) = new
   end subroutine append

   pure subroutine repeat_warning(item, new, downwards)
      type(run_warning_t), intent(inout) :: item
      type(run_warning_t), intent(in) :: new
      !> Smaller values are worse
      logical, intent(in) :: downwards

      if (is_worse(new%worst, item%worst, downwards)) item%worst = new%worst
      ! several places of the same elements in one increment, or a check that a run which goes on has made before
      if (all(item%last == new%last) .or. all(new%last == 0)) return
      item%count = item%count + 1
      item%last = new%last
      item%last_time = new%last_time
   end subroutine repeat_warning

   !> Whether a value is worse than another one of the same kind of warning.
   pure logical function is_worse(value, other, smaller_is_worse)
      !> How bad it is, in the same unit
      real(dp), intent(in) :: value, other
      !> Smaller values are worse
      logical, intent(in) :: smaller_is_worse

      is_worse = merge(value < other, value > other, smaller_is_worse)
   end function is_worse

   !> The message, and where it has come again: in how many increments, from where to where, and how bad it was.
   pure function warning_text(self) result(text)
      class(run_warning_t), intent(in) :: self
      character(len=:), allocatable :: text

      text = self%message
      if (self%count == 1) return
      text = text//' ('//plural(self%count, 'increment')//', '//describe_place(self%first)//' to '// &
         describe_place(self%last)
      if (len(self%unit) > 0) then
         text = text//', worst '//to_text(self%worst)
         if (self%unit /= '-') text = text//' '//self%unit
      end if
      text = text//')'
   end function warning_text

   !> Step and increment as `litz run --restart` takes them.
   pure function describe_place(place) result(words)
      !> Step and increment; 0, 0: the start of the run
      integer, intent(in) :: place(2)
      character(len=:), allocatable :: words

      words = to_text(place(1))//':'//to_text(place(2))
      if (all(place == 0)) words = 'the start'
   end function describe_place

   !> A line with what does not change over the run, between tabulators: kind, unit, message.
   pure function warning_record(self) result(line)
      class(run_warning_t), intent(in) :: self
      character(len=:), allocatable :: line

      line = trim(self%kind)//achar(9)//self%unit//achar(9)//self%message//new_line('a')
   end function warning_record

   !> `3 warnings (shallow_angle: 2, side_by_side: 1)`
   pure function warnings_counts(self) result(text)
      class(run_warnings_t), intent(in) :: self
      character(len=:), allocatable :: text
      logical :: counted(self%n)
      integer :: i, j, n

      text = plural(self%n, 'warning')//' ('
      counted = .false.
      do i = 1, self%n
         if (counted(i)) cycle
         n = 0
         do j = i, self%n
            if (self%items(j)%kind /= self%items(i)%kind) cycle
            counted(j) = .true.
            n = n + 1
         end do
         if (i > 1) text = text//', '
         text = text//trim(self%items(i)%kind)//': '//to_text(n)
      end do
      text = text//')'
   end function warnings_counts

   !> The list as numbers of characters, for files that hold numbers.
   pure function warnings_to_numbers(self) result(numbers)
      class(run_warnings_t), intent(in) :: self
      !> (1, characters)
      integer, allocatable :: numbers(:, :)
      type(growing_text_t) :: lines
      character(len=320) :: buffer
      integer :: i

      do i = 1, self%n
         associate (item => self%items(i))
            write (buffer, number_format) item%elements, item%first, item%last, item%count, merge(1, 0, item%is_rest), &
               item%first_time, item%last_time, item%worst, i
            call lines%append(trim(buffer)//new_line('a')//item%record())
         end associate
      end do
      allocate (numbers, source=lines%codes())
   end function warnings_to_numbers

   !> The list of an earlier run; what it has shown is not shown again.
   subroutine warnings_from_numbers(self, numbers, ok)
      class(run_warnings_t), intent(inout) :: self
      !> (1, characters)
      integer, intent(in) :: numbers(:, :)
      !> They are what `to_numbers` makes
      logical, intent(out) :: ok
      type(run_warning_t) :: item
      character(len=:), allocatable :: text, line
      integer :: i, first, number, is_rest, status

      self%n = 0
      ok = all(numbers >= 0 .and. numbers < 256)
      if (.not. ok) return
      allocate (character(len=size(numbers)) :: text)
      do i = 1, len(text)
         text(i:i) = achar(numbers(1, i))
      end do
      first = 1
      do while (ok .and. first <= len(text))
         line = next_word(new_line('a'))
         read (line, *, iostat=status) item%elements, item%first, item%last, item%count, is_rest, &
            item%first_time, item%last_time, item%worst, number
         item%is_rest = is_rest == 1
         item%kind = next_word(achar(9))
         item%unit = next_word(achar(9))
         item%message = next_word(new_line('a'))
         ok = ok .and. status == 0
         if (ok) call append(self, item)
      end do
      self%n_shown = self%n

   contains

      !> What comes before the next mark.
      function next_word(mark) result(word)
         !> The character that ends the word
         character(len=1), intent(in) :: mark
         character(len=:), allocatable :: word
         integer :: length

         length = index(text(first:), mark)
         ok = ok .and. length > 0
         word = text(first:first + length - 2)
         first = first + length
      end function next_word

   end subroutine warnings_from_numbers

end module litz_run_warnings
