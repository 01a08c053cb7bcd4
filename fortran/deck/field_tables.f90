!> *LORENTZ, ALONG: a magnetic field that is given at places along an axis, linear between them.
!>
!> Each two places that follow each other give a field that changes evenly, to the elements whose middle lies between
!> them before any deformation. So an element sees one such field, and sees it at its present place.
module litz_field_tables
   use litz_kinds, only: dp
   use litz_deck, only: token_t
   use litz_element_loads, only: field_axes
   use litz_model, only: model_t
   use litz_reader, only: reader_t, fail_at
   use litz_text, only: to_text
   implicit none
   private
   public :: field_table_t

   type :: field_table_t
      !> 1 to 3: the axis
      integer :: axis = 0
      !> Lines read of this table
      integer :: n = 0
      !> What the lines name: index of an element or of a set, 0: not that
      integer :: element = 0, set = 0
      !> Elements (n)
      integer, allocatable :: members(:)
      !> Last place [m], and the field there [N/(A m)]
      real(dp) :: place = 0, field(3) = 0
      !> Where the last line has its place
      type(token_t) :: token
   contains
      procedure :: is_of => table_is_of
      procedure :: start => table_start
      procedure :: take => table_take
      procedure :: finish => table_finish
   end type field_table_t

contains

   !> Whether a line that names this belongs to the table.
   pure logical function table_is_of(self, element, set) result(is_of)
      class(field_table_t), intent(in) :: self
      !> Indices, 0: none
      integer, intent(in) :: element, set

      is_of = self%n > 0 .and. self%element == element .and. self%set == set
   end function table_is_of

   pure subroutine table_start(self, element, set, members)
      class(field_table_t), intent(inout) :: self
      !> Indices, 0: none
      integer, intent(in) :: element, set
      !> Elements (n)
      integer, intent(in) :: members(:)

      self%n = 0
      self%element = element
      self%set = set
      self%members = members
   end subroutine table_start

   !> The line that was read last: what it gives to the elements between its place and the one before.
   subroutine table_take(self, reader, model, elements, value)
      class(field_table_t), intent(inout) :: self
      type(reader_t), intent(inout) :: reader
      type(model_t), intent(in) :: model
      !> None after an error, and of the first line (n)
      integer, allocatable, intent(out) :: elements(:)
      !> Field at the origin and its derivatives, as *LORENTZ has them
      real(dp), intent(out) :: value(12)
      real(dp) :: place, field(3), slope(3)
      real(dp), allocatable :: middle(:)

      allocate (elements(0))
      value = 0
      field = reader%values%real(2:4)
      place = reader%values%real(5)
      self%n = self%n + 1
      if (self%n == 1) then
         call refuse_before(self, reader, model, place)
      else if (.not. place > self%place) then
         call fail_at(reader, reader%values%token(5), 'the places of a field have to rise from line to line; found '// &
            to_text(place)//' behind '//to_text(self%place))
      else
         slope = (field - self%field)/(place - self%place)
         if (abs(slope(self%axis)) > 0) then
            call fail_at(reader, reader%values%token(1 + self%axis), 'a magnetic field has no divergence: along '// &
               field_axes(self%axis)//' its component B'//field_axes(self%axis)//' stays as it is; found '// &
               to_text(field(self%axis))//' behind '//to_text(self%field(self%axis)))
         else
            middle = middles(self, model)
            elements = pack(self%members, middle <= place .and. (middle > self%place .or. &
               (self%n == 2 .and. middle >= self%place)))
            value(:3) = self%field - slope*self%place
            value(3*self%axis + 1:3*self%axis + 3) = slope
         end if
      end if
      self%place = place
      self%field = field
      self%token = reader%values%token(5)
   end subroutine table_take

   !> Elements before the first place have no field.
   subroutine refuse_before(self, reader, model, place)
      class(field_table_t), intent(in) :: self
      type(reader_t), intent(inout) :: reader
      type(model_t), intent(in) :: model
      !> The first place [m]
      real(dp), intent(in) :: place
      real(dp), allocatable :: middle(:)
      integer :: i

      if (size(self%members) == 0) return
      middle = middles(self, model)
      i = minloc(middle, 1)
      if (middle(i) < place) call fail_at(reader, reader%values%token(5), outside(self, model, i, middle(i))// &
         ', before the first place of the field')
   end subroutine refuse_before

   !> After the last line of a table: nor have those behind the last place.
   subroutine table_finish(self, reader, model)
      class(field_table_t), intent(inout) :: self
      type(reader_t), intent(inout) :: reader
      type(model_t), intent(in) :: model
      real(dp), allocatable :: middle(:)
      integer :: i

      if (self%n == 1) then
         call fail_at(reader, self%token, 'a field along '//field_axes(self%axis)//' needs two places or more; one'// &
            ' that is the same everywhere is a line without ALONG')
      else if (self%n > 1 .and. size(self%members) > 0) then
         middle = middles(self, model)
         i = maxloc(middle, 1)
         if (middle(i) > self%place) call fail_at(reader, self%token, outside(self, model, i, middle(i))// &
            ', behind the last place of the field')
      end if
      self%n = 0
   end subroutine table_finish

   !> Middles of the elements along the axis, before any deformation (n) [m].
   pure function middles(self, model) result(middle)
      class(field_table_t), intent(in) :: self
      type(model_t), intent(in) :: model
      real(dp) :: middle(size(self%members))

      associate (nodes => model%connectivity(:, self%members))
         middle = (model%x(self%axis, nodes(1, :)) + model%x(self%axis, nodes(2, :)))/2
      end associate
   end function middles

   function outside(self, model, i, middle) result(words)
      class(field_table_t), intent(in) :: self
      type(model_t), intent(in) :: model
      !> Index of the member
      integer, intent(in) :: i
      !> Its middle [m]
      real(dp), intent(in) :: middle
      character(len=:), allocatable :: words

      words = 'element '//to_text(model%element_id(self%members(i)))//' has its middle at '// &
         field_axes(self%axis)//' = '//to_text(middle)
   end function outside

end module litz_field_tables
