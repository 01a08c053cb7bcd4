!> *NODE, *ELEMENT, and *MESH, which holds both in a file.
module litz_read_mesh
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use litz_kinds, only: dp
   use litz_deck, only: token_t
   use litz_element_types, only: element_type_named, element_b31, foreign_type_t, foreign_type_named
   use litz_source_files, only: relative_to
   use litz_errors, only: error_t
   use litz_keywords, only: largest_number
   use litz_lookup, only: id_map_t
   use litz_mesh_file, only: mesh_file_t, mesh_set_t, read_mesh_file
   use litz_text, only: to_text, shown
   use litz_model, only: model_t
   use litz_reader, only: reader_t, set_builder_t, fail_at, warn_at, parameter_of, choice_of, keyword_of
   use litz_data_lines, only: read_line
   use litz_sets, only: open_set, open_named_set, continue_set, add_member, add_once
   implicit none
   private
   public :: read_mesh

   !> An element shorter than this times the largest coordinate has no direction that could be trusted
   real(dp), parameter :: shortest = 1.0e-12_dp

contains

   subroutine read_mesh(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      type(mesh_file_t), allocatable :: files(:)
      integer, allocatable :: card_of_file(:)
      integer :: card, i

      card_of_file = pack([(card, card=1, self%deck%n_cards)], &
         [(keyword_of(self, card) == 'MESH', card=1, self%deck%n_cards)])
      allocate (files(size(card_of_file)))
      do i = 1, size(files)
         call open_mesh_file(self, card_of_file(i), files(i))
      end do
      if (self%missed_mesh) return
      call allocate_mesh(self, files, model)
      do card = 1, self%deck%n_cards
         if (keyword_of(self, card) == 'NODE') call read_nodes(self, card, model)
      end do
      do i = 1, size(files)
         call take_nodes(self, card_of_file(i), files(i), model)
      end do
      do card = 1, self%deck%n_cards
         if (keyword_of(self, card) == 'ELEMENT') call read_elements(self, card, model)
      end do
      do i = 1, size(files)
         call take_elements(self, card_of_file(i), files(i), model)
      end do
      call number_halves(self, model)
      do i = 1, size(files)
         call take_sets(self, card_of_file(i), 'node', files(i)%node_sets, self%node_sets, self%nodes, model%n_nodes)
         call take_sets(self, card_of_file(i), 'element', files(i)%element_sets, self%element_sets, self%elements, &
            model%n_elements)
      end do
      model%node_id = model%node_id(:model%n_nodes)
      model%x = model%x(:, :model%n_nodes)
      model%element_id = model%element_id(:model%n_elements)
      model%element_type = model%element_type(:model%n_elements)
      model%connectivity = model%connectivity(:, :model%n_elements)
   end subroutine read_mesh

   !> What a *MESH names.
   subroutine open_mesh_file(self, card, mesh)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(mesh_file_t), intent(out) :: mesh
      type(error_t), allocatable :: error
      type(token_t) :: token

      token = parameter_of(self, card, 'INPUT')
      self%missed_mesh = self%missed_mesh .or. token%last < token%first
      if (token%last < token%first) return
      call read_mesh_file(relative_to(self%deck%sources(self%deck%lines(token%line)%source)%path, &
         self%deck%text(token)), mesh, error)
      if (.not. allocated(error)) return
      self%missed_mesh = .true.
      call fail_at(self, token, 'the mesh file '//self%deck%shown(token)//': '//error%message)
   end subroutine open_mesh_file

   !> Room for all nodes and elements of the deck and of its mesh files.
   subroutine allocate_mesh(self, files, model)
      type(reader_t), intent(inout) :: self
      type(mesh_file_t), intent(in) :: files(:)
      type(model_t), intent(inout) :: model
      integer :: n_nodes, n_elements, i

      n_nodes = n_data_lines('NODE', 1)
      n_elements = n_data_lines('ELEMENT', 2)
      do i = 1, size(files)
         n_nodes = n_nodes + size(files(i)%node_id)
         n_elements = n_elements + size(files(i)%element_id)
      end do
      allocate (model%node_id(n_nodes), self%node_line(n_nodes), self%node_ok(n_nodes))
      allocate (model%x(3, n_nodes), source=0.0_dp)
      allocate (model%element_id(n_elements), self%element_line(n_elements))
      allocate (self%has_half(n_elements), source=.false.)
      allocate (model%connectivity(2, n_elements), model%element_type(n_elements), source=0)

   contains

      integer function n_data_lines(keyword, most) result(n)
         !> The keyword as the table has it
         character(len=*), intent(in) :: keyword
         !> Most items that come of a line
         integer, intent(in) :: most
         type(foreign_type_t) :: foreign
         integer :: card, lines

         n = 0
         do card = 1, self%deck%n_cards
            if (keyword_of(self, card) /= keyword) cycle
            lines = self%deck%cards(card)%last_data - self%deck%cards(card)%first_data + 1
            if (most > 1) foreign = foreign_type_named(choice_of(self, card, 'TYPE'))
            if (most > 1 .and. foreign%has_middle) lines = most*lines
            n = n + lines
         end do
      end function n_data_lines

   end subroutine allocate_mesh

   subroutine read_nodes(self, card, model)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(model_t), intent(inout) :: model
      integer :: line, set
      logical :: ok

      call open_set(self, self%node_sets, parameter_of(self, card, 'NSET'), set)
      do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
         call read_line(self, card, line, ok)
         self%broken_nodes = self%broken_nodes .or. .not. self%values%given(1)
         if (.not. self%values%given(1)) cycle
         call add_node(self, model, self%values%token(1), self%values%whole(1), self%values%real(2:4), ok, set)
      end do
   end subroutine read_nodes

   subroutine take_nodes(self, card, mesh, model)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(mesh_file_t), intent(in) :: mesh
      type(model_t), intent(inout) :: model
      type(token_t) :: token
      integer :: i
      logical :: ok

      token = parameter_of(self, card, 'INPUT')
      do i = 1, size(mesh%node_id)
         associate (id => mesh%node_id(i), position => mesh%position(:, i))
            ok = all(ieee_is_finite(position))
            if (ok) ok = all(abs(position) <= largest_number)
            if (id < 1) then
               self%broken_nodes = .true.
               call fail_at(self, token, 'the mesh file has a node with the number '//to_text(id)// &
                  '; numbers must be greater than 0')
               cycle
            end if
            if (.not. ok) call fail_at(self, token, 'the position of node '//to_text(id)// &
               ' in the mesh file is not finite or above 1e60, the largest number that litz accepts')
            ! as in text, zero has no sign
            call add_node(self, model, token, id, position + 0.0_dp, ok, 0)
         end associate
      end do
   end subroutine take_nodes

   !> A node whose position could not be read is kept, so that what refers to it is not reported as well.
   subroutine add_node(self, model, token, id, position, ok, set)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      !> Where it is defined
      type(token_t), intent(in) :: token
      !> The user's number
      integer, intent(in) :: id
      !> Position [m]
      real(dp), intent(in) :: position(3)
      !> The position could be read
      logical, intent(in) :: ok
      !> Set that it is put into; 0: none
      integer, intent(in) :: set
      integer :: known, n

      known = self%nodes%get(id)
      if (known > 0) then
         call fail_at(self, token, 'node '//to_text(id)//' is defined twice; first in '// &
            self%deck%place(self%node_line(known)))
         return
      end if
      n = model%n_nodes + 1
      model%n_nodes = n
      model%node_id(n) = id
      model%x(:, n) = position
      self%node_line(n) = token%line
      self%node_ok(n) = ok
      call self%nodes%put(id, n)
      call add_member(self%node_sets, set, n)
   end subroutine add_node

   subroutine read_elements(self, card, model)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(model_t), intent(inout) :: model
      type(foreign_type_t) :: foreign
      integer :: line, set, kind, element
      logical :: ok

      call open_set(self, self%element_sets, parameter_of(self, card, 'ELSET'), set)
      if (len(choice_of(self, card, 'TYPE')) == 0) then
         ! a type that litz lacks, or none: what its lines hold is not known
         self%broken_elements = .true.
         self%line_read(self%deck%cards(card)%first_data:self%deck%cards(card)%last_data) = .true.
         return
      end if
      foreign = foreign_type_named(choice_of(self, card, 'TYPE'))
      kind = max(element_b31, foreign%element_type, element_type_named(choice_of(self, card, 'TYPE')))
      if (foreign%has_middle) call warn_at(self, parameter_of(self, card, 'TYPE'), 'split_elements', 'each '// &
         trim(foreign%name)//' is taken as two B31, which are straight and linear between their nodes: compare'// &
         ' with a'// &
         ' finer mesh')
      do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
         call read_line(self, card, line, ok)
         self%broken_elements = self%broken_elements .or. .not. ok
         if (.not. self%values%given(1)) cycle
         associate (token => self%values%token, id => self%values%whole)
            call add_element(self, model, token(1), id(1), kind, set, element)
            if (.not. ok .or. element == 0) cycle
            call join_nodes(self, model, element, token(2:3), id(2:3))
            if (foreign%has_middle) call add_half(self, model, element, token(3:4), id(3:4), set)
         end associate
      end do
   end subroutine read_elements

   !> The second half of an element with a node in the middle; it gets its number when all others are known.
   subroutine add_half(self, model, element, tokens, ids, set)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      !> Index of the first half, the last element so far
      integer, intent(in) :: element
      !> Where the middle and the last node are named
      type(token_t), intent(in) :: tokens(2)
      !> Their numbers, and the set that the element is put into (0: none)
      integer, intent(in) :: ids(2), set

      model%n_elements = element + 1
      self%has_half(element) = .true.
      model%element_id(element + 1) = model%element_id(element)
      model%element_type(element + 1) = model%element_type(element)
      self%element_line(element + 1) = self%element_line(element)
      call add_member(self%element_sets, set, element + 1)
      call join_nodes(self, model, element + 1, tokens, ids)
   end subroutine add_half

   !> Second halves are numbered above all elements of the deck, which does not know these numbers: ranges do not have
   !> them.
   subroutine number_halves(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      integer :: e, number

      if (.not. any(self%has_half)) return
      number = maxval(model%element_id(:model%n_elements))
      do e = 1, model%n_elements - 1
         if (.not. self%has_half(e)) cycle
         if (number == huge(number)) then
            call fail_at(self, self%deck%line_token(self%element_line(e)), 'there are no numbers left for the'// &
               ' second'// &
               ' half of this element, which are above those of all elements')
            return
         end if
         number = number + 1
         model%element_id(e + 1) = number
      end do
   end subroutine number_halves

   subroutine take_elements(self, card, mesh, model)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(mesh_file_t), intent(in) :: mesh
      type(model_t), intent(inout) :: model
      type(token_t) :: token
      integer :: i, element

      token = parameter_of(self, card, 'INPUT')
      do i = 1, size(mesh%element_id)
         associate (id => mesh%element_id(i))
            if (id < 1) then
               self%broken_elements = .true.
               call fail_at(self, token, 'the mesh file has an element with the number '//to_text(id)// &
                  '; numbers must be greater than 0')
               cycle
            end if
            call add_element(self, model, token, id, mesh%element_type(i), 0, element)
         end associate
         if (element > 0) call join_nodes(self, model, element, [token, token], mesh%element_nodes(:, i))
      end do
   end subroutine take_elements

   subroutine add_element(self, model, token, id, kind, set, element)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      !> Where it is defined
      type(token_t), intent(in) :: token
      !> The user's number
      integer, intent(in) :: id
      !> One of `element_...` of litz_model
      integer, intent(in) :: kind
      !> Set that it is put into; 0: none
      integer, intent(in) :: set
      !> Index of the new element; 0 after an error
      integer, intent(out) :: element
      integer :: known

      known = self%elements%get(id)
      element = 0
      if (known > 0) then
         self%broken_elements = .true.
         call fail_at(self, token, 'element '//to_text(id)//' is defined twice; first in '// &
            self%deck%place(self%element_line(known)))
         return
      end if
      element = model%n_elements + 1
      model%n_elements = element
      model%element_id(element) = id
      model%element_type(element) = kind
      self%element_line(element) = token%line
      call self%elements%put(id, element)
      call add_member(self%element_sets, set, element)
   end subroutine add_element

   !> The sets of a mesh file, which may have members defined elsewhere.
   subroutine take_sets(self, card, what, sets, builder, map, n_items)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> `node` or `element`
      character(len=*), intent(in) :: what
      type(mesh_set_t), intent(in) :: sets(:)
      type(set_builder_t), intent(inout) :: builder
      type(id_map_t), intent(in) :: map
      !> Number of nodes or elements
      integer, intent(in) :: n_items
      type(token_t) :: token
      integer :: i, k, set, member

      token = parameter_of(self, card, 'INPUT')
      do i = 1, size(sets)
         call open_named_set(self, builder, token, sets(i)%name, set)
         if (set == 0) cycle
         call continue_set(builder, set, n_items)
         do k = 1, size(sets(i)%ids)
            member = map%get(sets(i)%ids(k))
            if (member > 0) then
               call add_once(builder, set, member)
            else if (.not. (self%broken_nodes .or. self%broken_elements)) then
               call fail_at(self, token, 'the '//what//' set '//shown(sets(i)%name)//' of the mesh file has '//what// &
                  ' '//to_text(sets(i)%ids(k))//', which is not defined')
               exit
            end if
         end do
      end do
   end subroutine take_sets

   !> Find the nodes of an element by their numbers.
   subroutine join_nodes(self, model, element, tokens, ids)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      !> Index of the element
      integer, intent(in) :: element
      !> Where the nodes are named, and their numbers
      type(token_t), intent(in) :: tokens(2)
      !> Numbers of the nodes
      integer, intent(in) :: ids(2)
      real(dp) :: length
      integer :: k

      do k = 1, 2
         associate (id => ids(k))
            model%connectivity(k, element) = self%nodes%get(id)
            if (model%connectivity(k, element) > 0 .or. self%broken_nodes) cycle
            self%broken_elements = .true.
            call fail_at(self, tokens(k), &
               'element '//to_text(model%element_id(element))//' has node '//to_text(id)//', which is not defined')
         end associate
      end do
      associate (node => model%connectivity(:, element))
         if (any(node == 0)) return
         if (.not. all(self%node_ok(node))) return
         length = norm2(model%x(:, node(2)) - model%x(:, node(1)))
         if (length <= shortest*maxval(abs(model%x(:, node)))) then
            self%broken_elements = .true.
            call fail_at(self, &
               self%deck%line_token(self%element_line(element)), 'element '//to_text(model%element_id(element))// &
               ' has no length: its nodes '//to_text(model%node_id(node(1)))//' and '// &
               to_text(model%node_id(node(2)))// &
               ' are at the same place')
         end if
      end associate
   end subroutine join_nodes

end module litz_read_mesh
