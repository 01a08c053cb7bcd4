!> Prescribed values, loads, currents and temperatures: from data lines to the complete list that holds in a step.
module litz_nodal_values
   use litz_kinds, only: dp
   use litz_text, only: to_text
   use litz_deck, only: token_t
   use litz_fields, only: fields, n_fields, field_rotation, field_displacement, last_dof, n_slots, &
      slot_of_dof, field_of_dof, dof_range
   use litz_model, only: model_t, nodal_value_t, rigid_body_t, dof_temperature, leave_step
   use litz_reader, only: reader_t, fail_at, parameter_of, choice_of, has_flag, keyword_of, name_of
   use litz_data_lines, only: read_line
   use litz_boundary_dofs, only: find_supports, find_boundary_dofs
   use litz_definitions, only: find_definition
   use litz_sets, only: find_item
   use litz_unknown_nodes, only: node_unknowns_t, find_unknowns, reason_for_lack_of
   implicit none
   private
   public :: value_list_t, kind_boundary, kind_temperature, kind_initial, field_of_load, start_list, begin_step, &
      read_nodal_values, no_longer_named

   !> The kinds of prescribed values, of temperatures that are no unknowns, and of those before the first step; that of
   !> loads is the first field with their keyword
   integer, parameter :: kind_boundary = 0, kind_temperature = -1, kind_initial = -2

   !> The list of one kind as it stands while the deck is read.
   !> Nodes of rigid surfaces and reference nodes of rigid bodies count as those of elements.
   type, extends(node_unknowns_t) :: value_list_t
      integer :: kind = kind_boundary
      type(nodal_value_t), allocatable :: items(:)
      integer :: n = 0
      !> Line of the deck that set each item last, 0: an earlier step
      integer, allocatable :: line(:)
      !> Item of each degree of freedom, 0: none (n_slots, n_nodes)
      integer, allocatable :: item(:, :)
      !> OP of the cards of this step: 0 none yet, 1 MOD, 2 NEW
      integer :: op = 0
      !> .true. before the first step
      logical :: model_part = .true.
      !> Equation that eliminates a degree of freedom, 0: none (n_slots, n_nodes)
      integer, allocatable :: eliminated_by(:, :)
      !> Rigid body that each node moves with, 0: none; the last degree of freedom that is not its own (n_nodes)
      integer, allocatable :: body(:), last_moved(:)
   end type value_list_t

contains

   pure subroutine start_list(list, kind, model)
      type(value_list_t), intent(out) :: list
      !> One of `kind_...`, or a field of which these are the loads
      integer, intent(in) :: kind
      type(model_t), intent(in) :: model
      integer :: e, k

      list%kind = kind
      allocate (list%items(16), list%line(16))
      allocate (list%item(n_slots, model%n_nodes), source=0)
      call find_unknowns(model, list)
      allocate (list%body(model%n_nodes), list%last_moved(model%n_nodes), source=0)
      do k = 1, size(model%rigid_bodies)
         associate (body => model%rigid_bodies(k))
            list%has_element(body%reference_node) = .true.
            list%body([body%tied, body%pinned]) = k
            list%last_moved(body%tied) = last_dof(field_rotation)
            list%last_moved(body%pinned) = last_dof(field_displacement)
         end associate
      end do
      allocate (list%eliminated_by(n_slots, model%n_nodes), source=0)
      do k = 1, size(model%equations)
         associate (this => model%equations(k))
            list%eliminated_by(slot_of_dof(this%dof(1)), this%node(1)) = k
            do e = 1, size(this%node)
               ! one without elements has what equations ask for
               list%has_element(this%node(e)) = .true.
               list%has_unknown(this%node(e), field_of_dof(this%dof(e))) = .true.
            end do
         end associate
      end do
      do k = 1, size(model%surfaces)
         if (model%surfaces(k)%node > 0) list%has_element(model%surfaces(k)%node) = .true.
      end do
   end subroutine start_list

   !> Carry the list into a new step.
   pure subroutine begin_step(list, model, previous_total)
      type(value_list_t), intent(inout) :: list
      type(model_t), intent(in) :: model
      !> Time of the previous step [s]
      real(dp), intent(in) :: previous_total
      real(dp) :: factor
      integer :: i

      list%model_part = .false.
      list%op = 0
      list%line(:list%n) = 0
      do i = 1, list%n
         associate (item => list%items(i))
            call leave_step(model, previous_total, item%amplitude, factor)
            item%value = factor*item%value
         end associate
      end do
   end subroutine begin_step

   !> All data lines of a *BOUNDARY, *CLOAD, *CECURRENT, *TEMPERATURE or *INITIAL CONDITIONS.
   subroutine read_nodal_values(self, model, card, list)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card
      integer, intent(in) :: card
      type(value_list_t), intent(inout) :: list
      type(token_t) :: amplitude_name
      integer :: line, amplitude, node, set, i
      !> First and last degree of freedom of each range that a line names (2, n)
      integer, allocatable :: dofs(:, :)
      logical :: ok, stays

      if (list%kind /= kind_initial) call apply_op(self, card, list)
      stays = .false.
      if (list%kind == kind_boundary) call read_fixed(self, card, list, stays)
      amplitude = 0
      amplitude_name = parameter_of(self, card, 'AMPLITUDE')
      if (amplitude_name%line > 0) call find_definition(self, self%amplitudes, 'amplitude', amplitude_name, amplitude)
      if (list%model_part .and. amplitude > 0) call fail_at(self, amplitude_name, &
         'an amplitude has no meaning before the first step, where all values are zero')
      do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
         call read_line(self, card, line, ok)
         if (.not. ok) cycle
         call find_item(self, 'node', self%node_sets, self%nodes, 1, node, set)
         call find_dofs(self, list%kind, dofs, ok)
         if (.not. ok) cycle
         if (list%model_part .and. list%kind == kind_boundary .and. abs(self%values%real(4)) > 0) then
            call fail_at(self, self%values%token(4), 'before the first step only zero values can be prescribed; '// &
               'put this *BOUNDARY into a step')
            cycle
         end if
         if (stays .and. abs(self%values%real(place_of_value(list%kind))) > 0) then
            call fail_at(self, self%values%token(place_of_value(list%kind)), &
               'what is FIXED stays what it is: leave out the value')
            cycle
         end if
         do i = 1, size(dofs, 2)
            if (node > 0) then
               call set_values(self, model, list, [node], dofs(1, i), dofs(2, i), amplitude, stays)
            else if (set > 0) then
               call set_values(self, model, list, model%node_sets(set)%members, dofs(1, i), dofs(2, i), amplitude, &
                  stays)
            end if
         end do
      end do
   end subroutine read_nodal_values

   !> Whether values stay what they are when the step begins.
   subroutine read_fixed(self, card, list, stays)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(value_list_t), intent(in) :: list
      !> The card says FIXED
      logical, intent(out) :: stays

      stays = has_flag(self, card, 'FIXED')
      if (.not. stays) return
      if (list%model_part) call fail_at(self, parameter_of(self, card, 'FIXED'), &
         'FIXED has no meaning before the first step, where all values are zero')
      associate (amplitude => parameter_of(self, card, 'AMPLITUDE'))
         if (amplitude%line > 0) call fail_at(self, amplitude, 'what is FIXED follows no amplitude')
      end associate
   end subroutine read_fixed

   !> Those of the last step's values that are no longer in the list.
   pure function no_longer_named(last, list) result(items)
      type(nodal_value_t), intent(in) :: last(:)
      type(value_list_t), intent(in) :: list
      type(nodal_value_t), allocatable :: items(:)
      integer :: i

      items = pack(last, [(list%item(slot_of_dof(last(i)%dof), last(i)%node) == 0, i=1, size(last))])
   end function no_longer_named

   !> OP=NEW removes what earlier steps left; within a step all cards must agree.
   subroutine apply_op(self, card, list)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(value_list_t), intent(inout) :: list
      type(token_t) :: token
      integer :: op, i

      token = parameter_of(self, card, 'OP')
      if (list%model_part .and. token%line > 0) then
         call fail_at(self, token, 'OP has no meaning before the first step')
         return
      end if
      op = merge(2, 1, choice_of(self, card, 'OP') == 'NEW')
      if (list%op > 0 .and. op /= list%op) then
         if (token%line == 0) token = self%deck%cards(card)%name
         call fail_at(self, token, 'all *'//keyword_of(self, card)// &
            ' of a step must have the same OP; this one has OP='// &
            trim(merge('NEW', 'MOD', op == 2))//', an earlier one OP='//trim(merge('NEW', 'MOD', list%op == 2)))
      else if (op == 2 .and. list%op == 0) then
         do i = 1, list%n
            list%item(slot_of_dof(list%items(i)%dof), list%items(i)%node) = 0
         end do
         list%n = 0
      end if
      if (list%op == 0) list%op = op
   end subroutine apply_op

   !> The first field whose loads have this keyword; 0: it is no keyword of loads.
   pure integer function field_of_load(keyword) result(field)
      !> In capitals, without the star
      character(len=*), intent(in) :: keyword

      field = findloc(fields%load_keyword == keyword, .true., 1)
   end function field_of_load

   !> The degrees of freedom that the line names.
   subroutine find_dofs(self, kind, dofs, ok)
      type(reader_t), intent(inout) :: self
      !> One of `kind_...`, or the first field of which these are the loads
      integer, intent(in) :: kind
      !> First and last of each range, with Abaqus's numbers (2, n)
      integer, allocatable, intent(out) :: dofs(:, :)
      !> .false.: an error was reported
      logical, intent(out) :: ok

      dofs = reshape([dof_temperature, dof_temperature], [2, 1])
      ok = .true.
      select case (kind)
      case (kind_boundary)
         call find_supports(self, dofs, ok)
         if (size(dofs) == 0) then
            dofs = reshape([0, 0], [2, 1])
            call find_boundary_dofs(self, dofs(1, 1), dofs(2, 1), ok)
         end if
      case (kind_temperature, kind_initial)
         continue
      case default
         call find_load_dof(self, kind, dofs(1, 1), ok)
         dofs(2, 1) = dofs(1, 1)
      end select
   end subroutine find_dofs

   !> Place of the value on a data line.
   pure integer function place_of_value(kind) result(place)
      !> One of `kind_...`, or the first field of which these are the loads
      integer, intent(in) :: kind

      select case (kind)
      case (kind_boundary)
         place = 4
      case (kind_temperature, kind_initial)
         place = 2
      case default
         place = 3
      end select
   end function place_of_value

   !> The degree of freedom of a load; of one that has a single direction it may be left out.
   subroutine find_load_dof(self, first_field, dof, ok)
      type(reader_t), intent(inout) :: self
      !> First field whose loads have the keyword of the line
      integer, intent(in) :: first_field
      !> With Abaqus's number
      integer, intent(out) :: dof
      !> .false.: an error was reported
      logical, intent(out) :: ok
      character(len=:), allocatable :: words
      integer :: field, last_field

      dof = fields(first_field)%first_dof
      if (self%values%given(2)) dof = self%values%whole(2)
      field = field_of_dof(dof)
      ok = .false.
      if (field > 0) ok = fields(field)%load_keyword == fields(first_field)%load_keyword
      if (ok) return
      last_field = findloc(fields%load_keyword == fields(first_field)%load_keyword, .true., 1, back=.true.)
      if (fields(first_field)%is_level) then
         words = 'a '//trim(fields(first_field)%flux_in_words)//' enters at degree of freedom '//dof_range(first_field)
      else
         words = 'forces and moments act in directions '//dof_range(first_field, last_field)
      end if
      words = words//'; found '//to_text(dof)
      if (field > 0 .and. .not. fields(first_field)%is_level) words = words//'; '//trim(fields(field)%flux_in_words)// &
         's are given by *'//trim(fields(field)%load_keyword)
      call fail_at(self, self%values%token(2), words)
   end subroutine find_load_dof

   !> Put a value into the list for all nodes and degrees of freedom that the line names.
   subroutine set_values(self, model, list, nodes, first, last, amplitude, stays)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(value_list_t), intent(inout) :: list
      !> Indices of the nodes (n)
      integer, intent(in) :: nodes(:)
      !> First and last degree of freedom, with Abaqus's numbers
      integer, intent(in) :: first, last
      !> Index of the amplitude; 0: none
      integer, intent(in) :: amplitude
      !> What is prescribed stays what it is when the step begins
      logical, intent(in) :: stays
      type(nodal_value_t) :: value
      integer :: i, dof
      logical :: ok

      value%amplitude = amplitude
      value%stays = stays
      value%value = self%values%real(place_of_value(list%kind))
      do i = 1, size(nodes)
         value%node = nodes(i)
         ok = list%has_element(nodes(i)) .or. self%broken_nodes .or. self%broken_elements .or. self%broken_bodies &
            .or. self%broken_equations
         if (.not. ok) then
            call fail_at(self, self%values%token(1), describe_node(self, model, nodes(i), nodes)// &
               ' belongs to no element')
            return
         end if
         ok = any(list%kind == [kind_temperature, kind_initial]) .or. &
            list%has_unknown(nodes(i), field_of_dof(first)) .or. self%broken_nodes .or. self%broken_elements .or. &
            self%broken_keywords .or. self%surfaces%missed .or. self%interactions%missed
         if (.not. ok) then
            call fail_at(self, self%values%token(1), describe_node(self, model, nodes(i), nodes)// &
               reason_for_lack_of(model, nodes(i), field_of_dof(first)))
            return
         end if
         ok = first > list%last_moved(nodes(i))
         if (.not. ok) then
            call fail_at(self, self%values%token(1), describe_node(self, model, nodes(i), nodes)// &
               ' has no degree of freedom '//to_text(first)//' of its own: it moves with '// &
               describe_body(model, model%rigid_bodies(list%body(nodes(i)))))
            return
         end if
         do dof = first, last
            value%dof = dof
            if (list%kind == kind_boundary) call refuse_eliminated(self, model, list, value, ok)
            if (.not. ok) return
            call set_value(self, model, list, value, ok)
            if (.not. ok) return
         end do
      end do
   end subroutine set_values

   !> What an equation eliminates follows from the others in it.
   subroutine refuse_eliminated(self, model, list, value, ok)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(value_list_t), intent(in) :: list
      type(nodal_value_t), intent(in) :: value
      !> .false.: an error was reported
      logical, intent(out) :: ok

      associate (i => list%eliminated_by(slot_of_dof(value%dof), value%node))
         ok = i == 0
         if (.not. ok) call fail_at(self, self%values%token(1), 'degree of freedom '//to_text(value%dof)// &
            ' of node '//to_text(model%node_id(value%node))//' is eliminated by the *EQUATION in '// &
            model%equations(i)%file//':'//to_text(model%equations(i)%line)// &
            '; prescribe another one of its terms, or begin it with another one')
      end associate
   end subroutine refuse_eliminated

   !> `node 5, the reference node of the *RIGID BODY in deck.inp:12`
   pure function describe_body(model, body) result(words)
      type(model_t), intent(in) :: model
      type(rigid_body_t), intent(in) :: body
      character(len=:), allocatable :: words

      words = 'node '//to_text(model%node_id(body%reference_node))//', the reference node of the *RIGID BODY in '// &
         body%file//':'//to_text(body%line)
   end function describe_body

   !> `node 7`, or `node 7 of WIRE`
   pure function describe_node(self, model, node, nodes) result(words)
      type(reader_t), intent(in) :: self
      type(model_t), intent(in) :: model
      !> Index of the node
      integer, intent(in) :: node
      !> Indices of all nodes that the line names (n)
      integer, intent(in) :: nodes(:)
      character(len=:), allocatable :: words

      words = 'node '//to_text(model%node_id(node))
      if (size(nodes) > 1) words = words//' of '//name_of(self, self%values%token(1))
   end function describe_node

   !> One value: new, in place of that of an earlier step, or together with others of this step.
   subroutine set_value(self, model, list, value, ok)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(value_list_t), intent(inout) :: list
      type(nodal_value_t), intent(in) :: value
      !> .false.: an error was reported
      logical, intent(out) :: ok
      integer :: at

      ok = .true.
      at = list%item(slot_of_dof(value%dof), value%node)
      if (at == 0) then
         call append(list, value)
         at = list%n
         list%item(slot_of_dof(value%dof), value%node) = at
      else if (list%line(at) == 0) then
         list%items(at) = value
      else
         call join_values(list%items(at))
      end if
      list%line(at) = self%values%token(1)%line

   contains

      !> The same degree of freedom again in this step.
      subroutine join_values(item)
         type(nodal_value_t), intent(inout) :: item

         if (list%kind <= kind_boundary) then
            ok = item%amplitude == value%amplitude .and. (item%stays .eqv. value%stays) .and. &
               .not. abs(item%value - value%value) > 0
            if (.not. ok) call fail_at(self, self%values%token(1), 'degree of freedom '//to_text(value%dof)// &
               ' of node '// &
               to_text(model%node_id(value%node))//' is prescribed twice with different values; first in '// &
               self%deck%place(list%line(at)))
         else
            ok = item%amplitude == value%amplitude
            if (.not. ok) call fail_at(self, self%values%token(1), 'node '//to_text(model%node_id(value%node))// &
               ' has loads of different amplitudes in the same direction; the other is in '// &
               self%deck%place(list%line(at)))
            item%value = item%value + value%value
         end if
      end subroutine join_values

   end subroutine set_value

   pure subroutine append(list, value)
      type(value_list_t), intent(inout) :: list
      type(nodal_value_t), intent(in) :: value
      type(nodal_value_t), allocatable :: items(:)
      integer, allocatable :: line(:)

      if (list%n == size(list%items)) then
         allocate (items(2*list%n), line(2*list%n))
         items(:list%n) = list%items
         line(:list%n) = list%line
         call move_alloc(items, list%items)
         call move_alloc(line, list%line)
      end if
      list%n = list%n + 1
      list%items(list%n) = value
      list%line(list%n) = 0
   end subroutine append

end module litz_nodal_values
