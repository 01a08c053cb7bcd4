!> Sets of nodes and elements: growing while the deck is read, then sorted lists of indices.
module litz_sets
   use litz_text, only: to_text, shown, upper
   use litz_numbers, only: parse_integer, number_ok, number_not_one
   use litz_sorting, only: sort_integers
   use litz_deck, only: token_t
   use litz_lookup, only: id_map_t
   use litz_model, only: model_t, named_set_t, name_length
   use litz_reader, only: halves_of, reader_t, set_builder_t, fail_at, warn_at, parameter_of, has_flag, name_of, &
      keyword_of, names_hint, may_be_defined
   use litz_data_lines, only: read_line
   implicit none
   private
   public :: open_set, open_named_set, continue_set, add_member, add_once, read_sets, find_set, find_item, &
      elements_of

   !> Most members that all sets of one kind may have: they are counted in default integers, and room for them doubles
   integer, parameter :: max_members = 2**30

contains

   !> The set of a name, new or not; 0 after an error.
   subroutine open_set(self, builder, token, set)
      type(reader_t), intent(inout) :: self
      type(set_builder_t), intent(inout) :: builder
      !> The name; empty when the card has none
      type(token_t), intent(in) :: token
      !> Index of the set; 0: the card names none, or its name was refused
      integer, intent(out) :: set

      set = 0
      if (token%last >= token%first) call open_named_set(self, builder, token, self%deck%text(token), set)
   end subroutine open_set

   !> The set of a name, new or not, upper and lower case alike; 0 after an error.
   subroutine open_named_set(self, builder, token, name, set)
      type(reader_t), intent(inout) :: self
      type(set_builder_t), intent(inout) :: builder
      !> Where it is named
      type(token_t), intent(in) :: token
      !> The name as the user wrote it
      character(len=*), intent(in) :: name
      !> Index of the set; 0 after an error
      integer, intent(out) :: set
      integer, allocatable :: grown(:)
      integer :: number, status

      set = 0
      call parse_integer(name, number, status)
      builder%has_numbers = builder%has_numbers .or. status == number_ok
      if (len(name) > name_length) then
         call fail_at(self, token, 'the name of a set must not be longer than '//to_text(name_length)// &
            ' characters; found '//shown(name))
         return
      end if
      call builder%names%put(upper(name), set)
      if (.not. allocated(builder%head)) then
         allocate (builder%head(64), builder%member(1024), builder%next(1024))
         builder%head = 0
      end if
      if (set > size(builder%head)) then
         allocate (grown(2*size(builder%head)), source=0)
         grown(:size(builder%head)) = builder%head
         call move_alloc(grown, builder%head)
      end if
   end subroutine open_named_set

   !> A member that the set does not have yet.
   pure subroutine add_member(builder, set, member)
      type(set_builder_t), intent(inout) :: builder
      !> 0: nothing is done
      integer, intent(in) :: set
      !> Index of the node or element
      integer, value :: member
      integer, allocatable :: members(:), next(:)
      integer :: status

      if (set == 0 .or. builder%is_full) return
      if (builder%n == size(builder%member)) then
         builder%is_full = builder%n >= max_members
         if (builder%is_full) return
         allocate (members(2*builder%n), next(2*builder%n), stat=status)
         builder%is_full = status /= 0
         if (builder%is_full) return
         members(:builder%n) = builder%member
         next(:builder%n) = builder%next
         call move_alloc(members, builder%member)
         call move_alloc(next, builder%next)
      end if
      builder%n = builder%n + 1
      builder%member(builder%n) = member
      builder%next(builder%n) = builder%head(set)
      builder%head(set) = builder%n
   end subroutine add_member

   !> A member that the set, made ready by `continue_set`, may have already.
   pure subroutine add_once(builder, set, member)
      type(set_builder_t), intent(inout) :: builder
      !> Index of the set
      integer, intent(in) :: set
      !> A copy: it may come from the list that grows here
      integer, value :: member

      if (builder%put_into(member) == set) return
      builder%put_into(member) = set
      call add_member(builder, set, member)
   end subroutine add_once

   !> Mark the members that the set has.
   pure subroutine continue_set(builder, set, n_items)
      type(set_builder_t), intent(inout) :: builder
      !> Index of the set; 0: none
      integer, intent(in) :: set
      !> Number of nodes or elements
      integer, intent(in) :: n_items
      integer :: entry

      if (.not. allocated(builder%put_into)) allocate (builder%put_into(n_items), source=0)
      if (set == 0) return
      entry = builder%head(set)
      do while (entry > 0)
         builder%put_into(builder%member(entry)) = set
         entry = builder%next(entry)
      end do
   end subroutine continue_set

   !> *NSET and *ELSET, and all sets into the model.
   subroutine read_sets(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      integer :: card

      do card = 1, self%deck%n_cards
         select case (keyword_of(self, card))
         case ('NSET')
            call read_set(self, card, 'node', self%node_sets, self%nodes, model%node_id)
            call add_nodes_of_elements(self, card, model%connectivity)
         case ('ELSET')
            call read_set(self, card, 'element', self%element_sets, self%elements, model%element_id)
         end select
         if (self%node_sets%is_full .or. self%element_sets%is_full) exit
      end do
      if (card <= self%deck%n_cards) call fail_at(self, self%deck%cards(card)%name, &
         'not enough memory for the members of all sets; so far there are '// &
         to_text(self%node_sets%n)//' nodes and '//to_text(self%element_sets%n)//' elements')
      call finish_sets(self%node_sets, model%n_nodes, model%node_sets)
      call finish_sets(self%element_sets, model%n_elements, model%element_sets)
   end subroutine read_sets

   subroutine read_set(self, card, what, builder, map, ids)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> `node` or `element`
      character(len=*), intent(in) :: what
      type(set_builder_t), intent(inout) :: builder
      type(id_map_t), intent(in) :: map
      !> The user's numbers by index (n)
      integer, intent(in) :: ids(:)
      integer :: line, set
      logical :: ok

      call open_set(self, builder, parameter_of(self, card, keyword_of(self, card)), set)
      call continue_set(builder, set, size(ids))
      associate (this => self%deck%cards(card))
         do line = this%first_data, this%last_data
            call read_line(self, card, line, ok)
            if (has_flag(self, card, 'GENERATE')) then
               if (ok) call generate_members(self, what, builder, set, map, ids)
            else
               call list_members(self, what, builder, set, map)
            end if
         end do
      end associate
   end subroutine read_set

   !> The nodes of the element set that a *NSET names; what the set has already is marked.
   subroutine add_nodes_of_elements(self, card, connectivity)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> Nodes of the elements (2, n_elements); 0: not understood
      integer, intent(in) :: connectivity(:, :)
      integer :: set, elements, entry, i

      call find_set(self, 'element', self%element_sets, parameter_of(self, card, 'ELSET'), elements)
      if (elements == 0) return
      call open_set(self, self%node_sets, parameter_of(self, card, 'NSET'), set)
      if (set == 0) return
      entry = self%element_sets%head(elements)
      do while (entry > 0)
         do i = 1, 2
            associate (node => connectivity(i, self%element_sets%member(entry)))
               if (node > 0) call add_once(self%node_sets, set, node)
            end associate
         end do
         entry = self%element_sets%next(entry)
      end do
   end subroutine add_nodes_of_elements

   !> A node, or an element with its second half where it has one.
   subroutine add_item(self, what, builder, set, index)
      type(reader_t), intent(in) :: self
      !> `node` or `element`
      character(len=*), intent(in) :: what
      type(set_builder_t), intent(inout) :: builder
      !> Index of the set, and of the node or element
      integer, intent(in) :: set, index

      call add_once(builder, set, index)
      if (what == 'node') return
      if (self%has_half(index)) call add_once(builder, set, index + 1)
   end subroutine add_item

   !> A line of numbers and names of other sets.
   subroutine list_members(self, what, builder, set, map)
      type(reader_t), intent(inout) :: self
      !> `node` or `element`
      character(len=*), intent(in) :: what
      type(set_builder_t), intent(inout) :: builder
      !> Index of the set; 0: none
      integer, intent(in) :: set
      type(id_map_t), intent(in) :: map
      integer :: i, other, entry, index

      do i = 1, self%values%n
         if (.not. self%values%given(i)) cycle
         call find_item(self, what, builder, map, i, index, other, is_member=.true.)
         if (set == 0) cycle
         if (index > 0) call add_item(self, what, builder, set, index)
         if (other == 0 .or. other == set) cycle
         entry = builder%head(other)
         do while (entry > 0)
            call add_once(builder, set, builder%member(entry))
            entry = builder%next(entry)
         end do
      end do
   end subroutine list_members

   !> `first, last, step`. Gaps in the numbering are passed over, but a range with nothing in it is an error.
   subroutine generate_members(self, what, builder, set, map, ids)
      type(reader_t), intent(inout) :: self
      !> `node` or `element`
      character(len=*), intent(in) :: what
      type(set_builder_t), intent(inout) :: builder
      !> Index of the set; 0: none
      integer, intent(in) :: set
      type(id_map_t), intent(in) :: map
      !> The user's numbers by index (n)
      integer, intent(in) :: ids(:)
      integer :: first, last, step, i, n
      logical :: found

      if (set == 0) return
      first = self%values%whole(1)
      last = self%values%whole(2)
      step = merge(self%values%whole(3), 1, self%values%given(3))
      if (last < first) then
         call fail_at(self, self%values%token(2), 'the last number of the range, '//to_text(last)// &
            ', is smaller than the first, '//to_text(first))
         return
      end if
      found = .false.
      n = (last - first)/step
      if (n <= size(ids)) then
         do i = 0, n
            if (map%get(first + i*step) > 0) call take(map%get(first + i*step))
         end do
      else
         do i = 1, size(ids)
            if (map%get(ids(i)) == i .and. ids(i) >= first .and. ids(i) <= last) then
               if (mod(ids(i) - first, step) == 0) call take(i)
            end if
         end do
      end if
      if (.not. (found .or. is_broken(self, what))) call fail_at(self, self%values%token(1), 'there is no '//what// &
         ' with a number in this range')

   contains

      subroutine take(member)
         !> Index of the node or element
         integer, intent(in) :: member

         found = .true.
         call add_item(self, what, builder, set, member)
      end subroutine take

   end subroutine generate_members

   !> Nodes or elements may be missing because their lines could not be read, which was reported.
   pure logical function is_broken(self, what)
      type(reader_t), intent(in) :: self
      !> `node` or `element`
      character(len=*), intent(in) :: what

      is_broken = (what == 'node' .and. self%broken_nodes) .or. (what == 'element' .and. self%broken_elements)
   end function is_broken

   !> What value `i` of the line names: an index by its number, or a set by its name. Both 0 after an error.
   !> A number is that of a node or element where there is one, as in Abaqus and CalculiX, and otherwise the name of a
   !> set.
   subroutine find_item(self, what, builder, map, i, index, set, is_member)
      type(reader_t), intent(inout) :: self
      !> `node` or `element`
      character(len=*), intent(in) :: what
      type(set_builder_t), intent(in) :: builder
      type(id_map_t), intent(in) :: map
      !> Place of the value on the data line
      integer, intent(in) :: i
      !> Index of the node or element; 0: a set is named, or there is none
      integer, intent(out) :: index
      !> Index of the set; 0: a number is named, or there is none
      integer, intent(out) :: set
      !> It is named as a member of a set, where numbers are those of nodes or elements in any case
      logical, intent(in), optional :: is_member
      integer :: number, status

      index = 0
      set = 0
      associate (token => self%values%token(i))
         call parse_integer(self%deck%text(token), number, status)
         if (status == number_not_one) then
            call find_set(self, what, builder, token, set)
         else
            index = map%get(self%values%whole(i))
            if (builder%has_numbers) then
               set = builder%names%get(name_of(self, token))
               if (index > 0 .and. set > 0 .and. .not. present(is_member)) call warn_at(self, token, 'number_of_set', &
                  self%deck%text(token)// &
                  ' is a '//what//' and the name of a '//what//' set; it is taken as the '//what)
               if (index > 0) set = 0
            end if
            if (index == 0 .and. set == 0 .and. .not. is_broken(self, what)) call fail_at(self, token, &
               'there is no '// &
               what//' '//self%deck%text(token))
         end if
      end associate
   end subroutine find_item

   !> A set by its name; 0 and an error when there is none.
   subroutine find_set(self, what, builder, token, set, or_surface)
      type(reader_t), intent(inout) :: self
      !> `node` or `element`
      character(len=*), intent(in) :: what
      type(set_builder_t), intent(in) :: builder
      type(token_t), intent(in) :: token
      !> Index of the set; 0 after an error
      integer, intent(out) :: set
      !> A rigid surface could be named here as well, and was not
      logical, intent(in), optional :: or_surface
      logical :: with_surfaces

      set = 0
      with_surfaces = .false.
      if (present(or_surface)) with_surfaces = or_surface
      if (token%last < token%first) return
      set = builder%names%get(name_of(self, token))
      if (set > 0) return
      if (may_be_defined(self, trim(merge('NSET ', 'ELSET', what == 'node')), token)) return
      ! surfaces, which contact pairs of other programs name
      if (what == 'element' .and. may_be_defined(self, 'NAME', token)) return
      if (is_known_as_missing()) return
      if (with_surfaces) then
         call fail_at(self, token, 'there is no element set or rigid surface '//self%deck%shown(token)//other_kind()// &
            names_hint(self, builder%names, token, self%surfaces%names))
      else
         call fail_at(self, token, 'there is no '//what//' set '//self%deck%shown(token)//other_kind()// &
            names_hint(self, builder%names, token))
      end if

   contains

      !> A set that is missing is told once, however often it is named.
      logical function is_known_as_missing() result(is_known)
         integer :: n, i

         n = self%missing_sets%n
         call self%missing_sets%put(what//' '//name_of(self, token), i)
         is_known = self%missing_sets%n == n
      end function is_known_as_missing

      !> A set of this name, but of the other kind; or a number.
      function other_kind()
         character(len=:), allocatable :: other_kind
         integer :: number, status

         other_kind = ''
         call parse_integer(self%deck%text(token), number, status)
         if (what == 'node' .and. self%element_sets%names%get(name_of(self, token)) > 0) then
            other_kind = ' (there is an element set of this name; *NSET, NSET=..., ELSET=... has its nodes)'
         else if (what == 'element' .and. self%node_sets%names%get(name_of(self, token)) > 0) then
            other_kind = ' (there is a node set of this name)'
         else if (what == 'element' .and. self%surfaces%names%get(name_of(self, token)) > 0) then
            other_kind = ' (there is a rigid surface of this name, which *CONTACT PAIR names after the wires)'
         else if (status == number_ok) then
            other_kind = ' (a name is needed here; a set may hold one '//what//')'
         end if
      end function other_kind

   end subroutine find_set

   !> Sort the members of each set.
   pure subroutine finish_sets(builder, n_items, sets)
      type(set_builder_t), intent(in) :: builder
      !> Number of nodes or elements
      integer, intent(in) :: n_items
      type(named_set_t), allocatable, intent(out) :: sets(:)
      integer, allocatable :: members(:)
      integer :: set, n, entry

      allocate (sets(builder%names%n), members(n_items))
      do set = 1, size(sets)
         n = 0
         entry = builder%head(set)
         do while (entry > 0)
            n = n + 1
            members(n) = builder%member(entry)
            entry = builder%next(entry)
         end do
         call sort_integers(members(:n))
         sets(set)%name = builder%names%name(set)
         sets(set)%members = members(:n)
      end do
   end subroutine finish_sets

   !> The elements that `find_item` has found (n); none after an error.
   function elements_of(self, model, element, set) result(elements)
      type(reader_t), intent(in) :: self
      type(model_t), intent(in) :: model
      !> Indices of an element or of a set, 0: not that
      integer, intent(in) :: element, set
      integer, allocatable :: elements(:)

      allocate (elements(0))
      if (element > 0) elements = halves_of(self, element)
      if (set > 0) elements = model%element_sets(set)%members
   end function elements_of

end module litz_sets
