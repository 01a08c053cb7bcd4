!> *DLOAD and *LORENTZ: forces on the length of elements, from data lines to the complete list that holds in a step.
module litz_read_element_loads
   use litz_kinds, only: dp
   use litz_data_lines, only: read_line
   use litz_deck, only: token_t
   use litz_definitions, only: find_definition
   use litz_element_loads, only: element_load_t, load_kind_named, load_label, load_grav, load_lorentz, n_load_kinds, &
      n_dload_kinds, field_axes, field_planes, axes_of_planes
   use litz_field_maps, only: field_map_t
   use litz_field_tables, only: field_table_t
   use litz_model, only: model_t, leave_step
   use litz_reader, only: reader_t, fail_at, parameter_of, choice_of, keyword_of, n_cards_of, name_of
   use litz_sets, only: elements_of, find_item
   use litz_text, only: to_text
   implicit none
   private
   public :: load_list_t, start_loads, begin_loads, read_element_loads

   !> The loads as they stand while the deck is read.
   type :: load_list_t
      type(element_load_t), allocatable :: items(:)
      integer :: n = 0
      !> Line of the deck that set each item last, 0: an earlier step
      integer, allocatable :: line(:)
      !> Item of each load, 0: none (n_load_kinds, n_elements); without elements where the deck has no such card
      integer, allocatable :: item(:, :)
      !> OP of the cards of this step, of *DLOAD and of *LORENTZ: 0 none yet, 1 MOD, 2 NEW
      integer :: op(2) = 0
   end type load_list_t

   !> A trace of the derivatives of a field beyond this part of the largest of them is no round-off
   real(dp), parameter :: largest_divergence = 1.0e-6_dp

contains

   subroutine start_loads(self, model, list)
      type(reader_t), intent(in) :: self
      type(model_t), intent(in) :: model
      type(load_list_t), intent(out) :: list

      allocate (list%items(0), list%line(0))
      allocate (list%item(n_load_kinds, merge(model%n_elements, 0, n_cards_of(self, 'DLOAD') &
         + n_cards_of(self, 'LORENTZ') > 0)), source=0)
   end subroutine start_loads

   !> Carry the list into a new step; what has come to nothing is left out.
   pure subroutine begin_loads(list, model, previous_total)
      type(load_list_t), intent(inout) :: list
      type(model_t), intent(in) :: model
      !> Time of the previous step [s]
      real(dp), intent(in) :: previous_total
      real(dp) :: factor
      integer :: i, n

      n = 0
      list%op = 0
      do i = 1, list%n
         associate (load => list%items(i))
            call leave_step(model, previous_total, load%amplitude, factor)
            load%value = factor*load%value
            load%before = load%value
            load%before_amplitude = load%amplitude
            list%item(load%kind, load%element) = 0
            if (.not. any(abs(load%value) > 0)) cycle
            n = n + 1
            list%items(n) = load
            list%item(load%kind, load%element) = n
         end associate
      end do
      list%n = n
      list%line(:n) = 0
   end subroutine begin_loads

   subroutine read_element_loads(self, model, card, list)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card
      integer, intent(in) :: card
      type(load_list_t), intent(inout) :: list
      type(token_t) :: token
      type(element_load_t) :: load
      type(field_table_t) :: table
      type(field_map_t) :: map
      integer :: line, element, set, i
      logical :: ok

      call apply_op(self, card, list)
      token = parameter_of(self, card, 'AMPLITUDE')
      if (token%line > 0) call find_definition(self, self%amplitudes, 'amplitude', token, load%amplitude)
      if (keyword_of(self, card) == 'LORENTZ') then
         table%axis = findloc(field_axes == choice_of(self, card, 'ALONG'), .true., 1)
         i = findloc(field_planes == choice_of(self, card, 'ALONG'), .true., 1)
         if (i > 0) map%axes = axes_of_planes(:, i)
         ! what its lines mean is not known where that is in error
         token = parameter_of(self, card, 'ALONG')
         if (token%line > 0 .and. table%axis == 0 .and. i == 0) return
      end if
      do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
         call read_line(self, card, line, ok)
         if (.not. ok) cycle
         if (table%axis > 0) then
            call read_place(self, model, load, table, list)
            cycle
         else if (map%axes(1) > 0) then
            call read_place_of_map(self, model, load, map, list)
            cycle
         end if
         if (keyword_of(self, card) == 'LORENTZ') then
            call take_field(self, load, ok)
         else
            call take_force(self, load, ok)
         end if
         if (.not. ok) cycle
         associate (token => self%values%token(1))
            if (token%last < token%first) then
               call set_loads(self, model, [(i, i=1, model%n_elements)], load, list)
               cycle
            end if
         end associate
         call find_item(self, 'element', self%element_sets, self%elements, 1, element, set)
         call set_loads(self, model, elements_of(self, model, element, set), load, list)
      end do
      if (table%axis > 0) call table%finish(self, model)
      if (map%n > 0) call finish_map(self, model, load, map, list)
   end subroutine read_element_loads

   !> A line of *LORENTZ, ALONG: lines for the same elements that follow each other are one table.
   subroutine read_place(self, model, load, table, list)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(element_load_t), intent(inout) :: load
      type(field_table_t), intent(inout) :: table
      type(load_list_t), intent(inout) :: list
      integer, allocatable :: elements(:)
      integer :: element, set

      call find_item(self, 'element', self%element_sets, self%elements, 1, element, set)
      if (element == 0 .and. set == 0) return
      if (.not. table%is_of(element, set)) then
         call table%finish(self, model)
         call table%start(element, set, elements_of(self, model, element, set))
      end if
      load%kind = load_lorentz
      call table%take(self, model, elements, load%value)
      call set_loads(self, model, elements, load, list)
   end subroutine read_place

   !> A line of *LORENTZ, ALONG of two axes: lines for the same elements that follow each other are one table.
   subroutine read_place_of_map(self, model, load, map, list)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(element_load_t), intent(inout) :: load
      type(field_map_t), intent(inout) :: map
      type(load_list_t), intent(inout) :: list
      integer :: element, set

      call find_item(self, 'element', self%element_sets, self%elements, 1, element, set)
      if (element == 0 .and. set == 0) return
      if (.not. map%is_of(element, set)) then
         call finish_map(self, model, load, map, list)
         call map%start(element, set, elements_of(self, model, element, set))
      end if
      call map%take(self)
   end subroutine read_place_of_map

   !> After the last line of such a table.
   subroutine finish_map(self, model, load, map, list)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(element_load_t), intent(inout) :: load
      type(field_map_t), intent(inout) :: map
      type(load_list_t), intent(inout) :: list
      integer, allocatable :: elements(:)
      real(dp), allocatable :: values(:, :)

      if (map%n == 0) return
      load%kind = load_lorentz
      call map%finish(self, model, elements, values)
      call set_loads(self, model, elements, load, list, values, map%token(1))
   end subroutine finish_map

   !> OP=NEW removes what earlier steps left, over the step; within a step all cards must agree.
   subroutine apply_op(self, card, list)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(load_list_t), intent(inout) :: list
      type(token_t) :: token
      integer :: op, i, which

      which = merge(2, 1, keyword_of(self, card) == 'LORENTZ')
      op = merge(2, 1, choice_of(self, card, 'OP') == 'NEW')
      if (all(list%op(which) /= [0, op])) then
         token = parameter_of(self, card, 'OP')
         if (token%line == 0) token = self%deck%cards(card)%name
         call fail_at(self, token, 'all *'//keyword_of(self, card)//' of a step must have the same OP')
      else if (op == 2 .and. list%op(which) == 0) then
         do i = 1, list%n
            associate (load => list%items(i))
               if ((load%kind == load_lorentz) .neqv. which == 2) cycle
               load%value = 0
               load%amplitude = 0
            end associate
         end do
      end if
      list%op(which) = op
   end subroutine apply_op

   !> The load that a line of *DLOAD gives.
   subroutine take_force(self, load, ok)
      type(reader_t), intent(inout) :: self
      type(element_load_t), intent(inout) :: load
      !> .false.: an error was reported
      logical, intent(out) :: ok

      ok = .false.
      associate (values => self%values)
         load%kind = load_kind_named(name_of(self, values%token(2)))
         load%value = 0
         if (load%kind /= load_grav) then
            if (values%n > 3) then
               call fail_at(self, values%token(4), load_label(load%kind)//' has one value, force per length; a'// &
                  ' direction belongs to GRAV')
            else if (values%token(1)%last < values%token(1)%first) then
               call fail_at(self, values%token(1), 'value 1, element, is missing; GRAV alone acts on the whole'// &
                  ' model without it')
            else
               load%value(1) = values%real(3)
               ok = .true.
            end if
         else if (.not. any(abs(values%real(4:6)) > 0)) then
            call fail_at(self, values%token(4), 'GRAV needs a direction, x, y, z, behind its magnitude, such as'// &
               ' 9.81, 0, 0, -1')
         else
            ! scaled first: squares of large numbers overflow
            load%value(:3) = values%real(4:6)/maxval(abs(values%real(4:6)))
            load%value(:3) = values%real(3)*load%value(:3)/norm2(load%value(:3))
            ok = .true.
         end if
      end associate
   end subroutine take_force

   !> The field that a line of *LORENTZ gives.
   subroutine take_field(self, load, ok)
      type(reader_t), intent(inout) :: self
      type(element_load_t), intent(inout) :: load
      !> .false.: an error was reported
      logical, intent(out) :: ok
      real(dp) :: trace

      load%kind = load_lorentz
      load%value = self%values%real(2:13)
      trace = load%value(4) + load%value(8) + load%value(12)
      ok = abs(trace) <= largest_divergence*maxval(abs(load%value(4:)))
      if (.not. ok) call fail_at(self, self%values%token(5), 'a magnetic field has no divergence: dBx/dx + dBy/dy +'// &
         ' dBz/dz must be zero; found '//to_text(trace))
   end subroutine take_field

   !> Put a load on elements that the line read last names, or lines before it.
   subroutine set_loads(self, model, elements, load, list, values, named)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Indices of elements (n)
      integer, intent(in) :: elements(:)
      type(element_load_t), intent(in) :: load
      type(load_list_t), intent(inout) :: list
      !> Of each element, in place of that of the load (12, n)
      real(dp), intent(in), optional :: values(:, :)
      !> Where they are named, if not on the line read last
      type(token_t), intent(in), optional :: named
      type(token_t) :: token
      character(len=:), allocatable :: what
      real(dp) :: value(12)
      integer :: i

      what = ''
      token = self%values%token(1)
      if (present(named)) token = named
      ! a line that names none points at its label
      if (token%last < token%first) token = self%values%token(2)
      value = load%value
      do i = 1, size(elements)
         if (present(values)) value = values(:, i)
         if (.not. self%broken_keywords) what = reason_against(model, elements(i), load%kind)
         if (len(what) == 0) call set_load(elements(i))
         if (len(what) == 0) cycle
         call fail_at(self, token, 'element '//to_text(model%element_id(elements(i)))//' '//what)
         return
      end do

   contains

      !> New, in place of that of an earlier step, or together with others of this step.
      subroutine set_load(element)
         !> Index of the element
         integer, intent(in) :: element
         integer :: at

         at = list%item(load%kind, element)
         if (at == 0) then
            call append(list)
            at = list%n
            list%items(at)%element = element
            list%items(at)%kind = load%kind
            list%item(load%kind, element) = at
         end if
         associate (item => list%items(at))
            if (list%line(at) == 0) then
               item%value = value
               item%amplitude = load%amplitude
            else if (item%amplitude /= load%amplitude) then
               what = 'has loads '//load_label(load%kind)//' of different amplitudes; the other is in '// &
                  self%deck%place(list%line(at))
            else
               item%value = item%value + value
            end if
         end associate
         list%line(at) = token%line
      end subroutine set_load

   end subroutine set_loads

   !> Room for one more item, which is zero.
   pure subroutine append(list)
      type(load_list_t), intent(inout) :: list
      type(element_load_t), allocatable :: items(:)
      integer, allocatable :: line(:)

      if (list%n == size(list%items)) then
         allocate (items(max(16, 2*list%n)), line(max(16, 2*list%n)))
         items(:list%n) = list%items
         line(:list%n) = list%line
         call move_alloc(items, list%items)
         call move_alloc(line, list%line)
      end if
      list%n = list%n + 1
      list%items(list%n) = element_load_t()
      list%line(list%n) = 0
   end subroutine append

   !> Why an element cannot have such a load; empty: it can. Sections and materials in error are passed over.
   function reason_against(model, element, kind) result(words)
      type(model_t), intent(in) :: model
      !> Index of the element, and one of `load_...`
      integer, intent(in) :: element, kind
      character(len=:), allocatable :: words

      words = ''
      if (kind < n_dload_kinds .or. model%element_section(element) == 0) return
      associate (section => model%sections(model%element_section(element)))
         if (section%material == 0) return
         associate (material => model%materials(section%material))
            if (kind == load_grav .and. .not. material%density > 0) then
               words = 'has no weight: its material '//material%name//' has no *DENSITY'
            else if (kind == load_lorentz .and. .not. material%conductivity > 0) then
               words = 'carries no current: its material '//material%name//' has no *ELECTRICAL CONDUCTIVITY'
            end if
         end associate
      end associate
   end function reason_against

end module litz_read_element_loads
