!> *LORENTZ, ALONG of two axes: a magnetic field that is given over a plane of places, bilinear between them.
!>
!> Each element gets the field that touches the bilinear one in its middle before any deformation, and sees that at its
!> present place. Lines may come in any order; each place along one axis has to come with each along the other.
module litz_field_maps
   use litz_kinds, only: dp
   use litz_deck, only: token_t
   use litz_element_loads, only: field_axes
   use litz_model, only: model_t
   use litz_reader, only: reader_t, fail_at
   use litz_text, only: to_text
   implicit none
   private
   public :: field_map_t

   !> Where places are far apart the divergence between four of them is not quite zero: it may be this part of the
   !> largest derivative
   real(dp), parameter :: largest_divergence = 0.25_dp

   type :: field_map_t
      !> 1 to 3: the axes; 0: the card gives no field over a plane
      integer :: axes(2) = 0
      !> Lines read of this table
      integer :: n = 0
      !> What the lines name: index of an element or of a set, 0: not that
      integer :: element = 0, set = 0
      !> Elements (m)
      integer, allocatable :: members(:)
      !> Places along both axes (2, n) [m], and the field there (3, n) [N/(A m)], with room for more
      real(dp), allocatable :: place(:, :), field(:, :)
      !> Where the lines name the elements (n)
      type(token_t), allocatable :: token(:)
   contains
      procedure :: is_of => map_is_of
      procedure :: start => map_start
      procedure :: take => map_take
      procedure :: finish => map_finish
   end type field_map_t

contains

   !> Whether a line that names this belongs to the table.
   pure logical function map_is_of(self, element, set) result(is_of)
      class(field_map_t), intent(in) :: self
      !> Indices, 0: none
      integer, intent(in) :: element, set

      is_of = self%n > 0 .and. self%element == element .and. self%set == set
   end function map_is_of

   pure subroutine map_start(self, element, set, members)
      class(field_map_t), intent(inout) :: self
      !> Indices, 0: none
      integer, intent(in) :: element, set
      !> Elements (m)
      integer, intent(in) :: members(:)

      self%n = 0
      self%element = element
      self%set = set
      self%members = members
      if (.not. allocated(self%place)) allocate (self%place(2, 16), self%field(3, 16), self%token(16))
   end subroutine map_start

   !> The line that was read last.
   pure subroutine map_take(self, reader)
      class(field_map_t), intent(inout) :: self
      type(reader_t), intent(in) :: reader
      real(dp), allocatable :: place(:, :), field(:, :)
      type(token_t), allocatable :: token(:)

      associate (n => self%n)
         if (n == size(self%token)) then
            allocate (place(2, 2*n), field(3, 2*n), token(2*n))
            place(:, :n) = self%place
            field(:, :n) = self%field
            token(:n) = self%token
            call move_alloc(place, self%place)
            call move_alloc(field, self%field)
            call move_alloc(token, self%token)
         end if
         n = n + 1
         self%field(:, n) = reader%values%real(2:4)
         self%place(:, n) = reader%values%real(5:6)
         self%token(n) = reader%values%token(1)
      end associate
   end subroutine map_take

   !> After the last line of a table: what it gives to its elements.
   subroutine map_finish(self, reader, model, elements, values)
      class(field_map_t), intent(inout) :: self
      type(reader_t), intent(inout) :: reader
      type(model_t), intent(in) :: model
      !> None after an error (m)
      integer, allocatable, intent(out) :: elements(:)
      !> Field at the origin and its derivatives, as *LORENTZ has them (12, m)
      real(dp), allocatable, intent(out) :: values(:, :)
      real(dp), allocatable :: first(:), second(:)
      integer, allocatable :: line(:, :)
      logical :: ok
      integer :: i

      allocate (elements(0), values(12, 0))
      if (self%n == 0) return
      first = places_in_order(self%place(1, :self%n))
      second = places_in_order(self%place(2, :self%n))
      call find_lines(self, reader, first, second, line, ok)
      if (ok) call refuse_divergence(self, reader, first, second, line, ok)
      if (ok) call refuse_outside(self, reader, model, first, second, ok)
      self%n = 0
      if (.not. ok) return
      elements = self%members
      values = reshape([(field_about(self, first, second, line, middle(self, model, i)), i=1, size(elements))], &
         [12, size(elements)])
   end subroutine map_finish

   !> Which line has the field at each place along the first and the second axis.
   subroutine find_lines(self, reader, first, second, line, ok)
      class(field_map_t), intent(in) :: self
      type(reader_t), intent(inout) :: reader
      !> Places along the axes, ascending (n_first), (n_second) [m]
      real(dp), intent(in) :: first(:), second(:)
      !> (n_first, n_second)
      integer, allocatable, intent(out) :: line(:, :)
      !> .false.: an error was reported
      logical, intent(out) :: ok
      integer :: i, j, k

      ok = min(size(first), size(second)) > 1
      if (.not. ok) then
         call fail_at(reader, self%token(1), 'a field over a plane needs two places or more along each axis; along '// &
            field_axes(self%axes(merge(1, 2, size(first) == 1)))//' there is one')
         return
      end if
      ok = real(size(first), dp)*size(second) <= self%n
      if (.not. ok) then
         i = sparsest(self%place(1, :self%n), first)
         call fail_at(reader, self%token(findloc(self%place(1, :self%n), first(i), 1)), 'a field over a plane is'// &
            ' given at each place along '//field_axes(self%axes(1))//' together with each along '// &
            field_axes(self%axes(2))//': '//to_text(size(first))//' times '//to_text(size(second))//' places; '// &
            to_text(self%n)//' lines follow, at '//field_axes(self%axes(1))//' = '//to_text(first(i))//' there are '// &
            to_text(count(self%place(1, :self%n) <= first(i) .and. self%place(1, :self%n) >= first(i))))
         return
      end if
      allocate (line(size(first), size(second)), source=0)
      do k = 1, self%n
         i = last_below(first, self%place(1, k)) + 1
         j = last_below(second, self%place(2, k)) + 1
         ok = line(i, j) == 0
         if (.not. ok) then
            call fail_at(reader, self%token(k), 'the field at '//describe_place(self, self%place(:, k))// &
               ' is given twice; first in '//reader%deck%place(self%token(line(i, j))%line))
            return
         end if
         line(i, j) = k
      end do
   end subroutine find_lines

   !> The first of the places along an axis with the fewest lines.
   pure integer function sparsest(given, places)
      !> Of the lines (n), and in order (m) [m]
      real(dp), intent(in) :: given(:), places(:)
      integer :: lines(size(places)), k, i

      lines = 0
      do k = 1, size(given)
         i = last_below(places, given(k)) + 1
         lines(i) = lines(i) + 1
      end do
      sparsest = minloc(lines, 1)
   end function sparsest

   !> Between each four places what enters on one side leaves on another.
   subroutine refuse_divergence(self, reader, first, second, line, ok)
      class(field_map_t), intent(in) :: self
      type(reader_t), intent(inout) :: reader
      !> Places along the axes, ascending (n_first), (n_second) [m]
      real(dp), intent(in) :: first(:), second(:)
      !> Line of each place (n_first, n_second)
      integer, intent(in) :: line(:, :)
      !> .false.: an error was reported
      logical, intent(out) :: ok
      real(dp) :: slope(3, 2), trace, worst, largest
      integer :: i, j, at(2)

      worst = 0
      largest = 0
      at = 1
      do j = 1, size(second) - 1
         do i = 1, size(first) - 1
            slope = slopes(self, first, second, line, i, j, [0.5_dp, 0.5_dp])
            trace = slope(self%axes(1), 1) + slope(self%axes(2), 2)
            largest = max(largest, maxval(abs(slope)))
            if (abs(trace) <= abs(worst)) cycle
            worst = trace
            at = [i, j]
         end do
      end do
      ok = abs(worst) <= largest_divergence*largest
      if (ok) return
      associate (a => field_axes(self%axes(1)), b => field_axes(self%axes(2)))
         call fail_at(reader, self%token(line(at(1), at(2))), 'a magnetic field has no divergence: from '// &
            describe_place(self, [first(at(1)), second(at(2))])//' to '//describe_place(self, [first(at(1) + 1), &
            second(at(2) + 1)])//' dB'//a//'/d'//a//' + dB'//b//'/d'//b//' is '//to_text(worst)//', where the'// &
            ' largest derivative of the table is '//to_text(largest)//'; are components or axes exchanged?')
      end associate
   end subroutine refuse_divergence

   !> Elements beside the places have no field.
   subroutine refuse_outside(self, reader, model, first, second, ok)
      class(field_map_t), intent(in) :: self
      type(reader_t), intent(inout) :: reader
      type(model_t), intent(in) :: model
      !> Places along the axes, ascending (n_first), (n_second) [m]
      real(dp), intent(in) :: first(:), second(:)
      !> .false.: an error was reported
      logical, intent(out) :: ok
      real(dp) :: at(2), low(2), high(2)
      integer :: i

      low = [first(1), second(1)]
      high = [first(size(first)), second(size(second))]
      do i = 1, size(self%members)
         at = middle(self, model, i)
         ok = all(at >= low .and. at <= high)
         if (ok) cycle
         call fail_at(reader, self%token(1), 'element '//to_text(model%element_id(self%members(i)))// &
            ' has its middle at '//describe_place(self, at)//', outside of the places of the field, '// &
            describe_place(self, low)//' to '//describe_place(self, high))
         return
      end do
      ok = .true.
   end subroutine refuse_outside

   !> The field that touches the bilinear one at a place: at the origin, and its derivatives (12).
   pure function field_about(self, first, second, line, at) result(value)
      class(field_map_t), intent(in) :: self
      !> Places along the axes, ascending (n_first), (n_second) [m]
      real(dp), intent(in) :: first(:), second(:)
      !> Line of each place (n_first, n_second)
      integer, intent(in) :: line(:, :)
      !> The place (2) [m]
      real(dp), intent(in) :: at(2)
      real(dp) :: value(12), part(2), slope(3, 2), there(3)
      integer :: i, j, k

      i = interval(first, at(1))
      j = interval(second, at(2))
      part = [(at(1) - first(i))/(first(i + 1) - first(i)), (at(2) - second(j))/(second(j + 1) - second(j))]
      there = (1 - part(2))*((1 - part(1))*self%field(:, line(i, j)) + part(1)*self%field(:, line(i + 1, j))) &
         + part(2)*((1 - part(1))*self%field(:, line(i, j + 1)) + part(1)*self%field(:, line(i + 1, j + 1)))
      slope = slopes(self, first, second, line, i, j, part)
      value = 0
      value(:3) = there - matmul(slope, at)
      do k = 1, 2
         value(3*self%axes(k) + 1:3*self%axes(k) + 3) = slope(:, k)
      end do
   end function field_about

   !> Derivatives of the bilinear field along both axes (3, 2) [N/(A m^2)].
   pure function slopes(self, first, second, line, i, j, part) result(slope)
      class(field_map_t), intent(in) :: self
      !> Places along the axes, ascending (n_first), (n_second) [m]
      real(dp), intent(in) :: first(:), second(:)
      !> Line of each place (n_first, n_second)
      integer, intent(in) :: line(:, :)
      !> The intervals
      integer, intent(in) :: i, j
      !> Where in these (2) [-]
      real(dp), intent(in) :: part(2)
      real(dp) :: slope(3, 2)

      associate (f => self%field, low => line(i, j), high => line(i + 1, j + 1))
         slope(:, 1) = ((1 - part(2))*(f(:, line(i + 1, j)) - f(:, low)) &
            + part(2)*(f(:, high) - f(:, line(i, j + 1))))/(first(i + 1) - first(i))
         slope(:, 2) = ((1 - part(1))*(f(:, line(i, j + 1)) - f(:, low)) &
            + part(1)*(f(:, high) - f(:, line(i + 1, j))))/(second(j + 1) - second(j))
      end associate
   end function slopes

   !> Middle of a member along both axes, before any deformation (2) [m].
   pure function middle(self, model, i) result(at)
      class(field_map_t), intent(in) :: self
      type(model_t), intent(in) :: model
      !> Index of the member
      integer, intent(in) :: i
      real(dp) :: at(2)

      at = sum(model%x(self%axes, model%connectivity(:, self%members(i))), 2)/2
   end function middle

   !> `X = 0.1, Y = 0.2`.
   function describe_place(self, at) result(words)
      class(field_map_t), intent(in) :: self
      !> (2) [m]
      real(dp), intent(in) :: at(2)
      character(len=:), allocatable :: words

      words = field_axes(self%axes(1))//' = '//to_text(at(1))//', '//field_axes(self%axes(2))//' = '//to_text(at(2))
   end function describe_place

   !> The values of a list, ascending, each once.
   pure function places_in_order(values) result(places)
      !> (n)
      real(dp), intent(in) :: values(:)
      real(dp), allocatable :: places(:)
      real(dp) :: sorted(size(values))
      integer :: k, n, i

      n = 0
      do k = 1, size(values)
         i = last_below(sorted(:n), values(k)) + 1
         if (i <= n) then
            if (sorted(i) <= values(k)) cycle
         end if
         sorted(i + 1:n + 1) = sorted(i:n)
         sorted(i) = values(k)
         n = n + 1
      end do
      places = sorted(:n)
   end function places_in_order

   !> The interval of ascending places in which a value lies.
   pure integer function interval(places, value)
      !> (n), n > 1
      real(dp), intent(in) :: places(:)
      !> Not outside of them
      real(dp), intent(in) :: value

      interval = max(1, last_below(places, value))
   end function interval

   !> How many of ascending places lie below a value.
   pure integer function last_below(places, value) result(low)
      !> (n)
      real(dp), intent(in) :: places(:)
      !> What they are compared with
      real(dp), intent(in) :: value
      integer :: high, between

      low = 0
      high = size(places) + 1
      do while (high - low > 1)
         between = (low + high)/2
         if (places(between) < value) then
            low = between
         else
            high = between
         end if
      end do
   end function last_below

end module litz_field_maps
