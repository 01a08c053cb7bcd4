!> *RIGID BODY: which nodes move with which.
module litz_read_rigid_bodies
   use litz_deck, only: token_t
   use litz_model, only: model_t, rigid_body_t
   use litz_numbers, only: parse_integer, number_not_one
   use litz_reader, only: reader_t, fail_at, keyword_of, name_of, parameter_of
   use litz_sets, only: find_set
   use litz_text, only: to_text
   implicit none
   private
   public :: read_rigid_bodies

contains

   subroutine read_rigid_bodies(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      !> Card that each node moves by, and the one of which it is the reference node (n_nodes); 0: none
      integer :: moved_by(model%n_nodes), led_by(model%n_nodes)
      type(rigid_body_t), allocatable :: grown(:)
      type(rigid_body_t) :: body
      integer :: card
      logical :: ok

      allocate (model%rigid_bodies(0))
      moved_by = 0
      led_by = 0
      do card = 1, self%deck%n_cards
         if (keyword_of(self, card) /= 'RIGID BODY') cycle
         call read_body(self, model, card, body, ok)
         if (.not. ok) cycle
         call claim_nodes(self, model, card, body, moved_by, led_by)
         allocate (grown(size(model%rigid_bodies) + 1))
         grown(:size(model%rigid_bodies)) = model%rigid_bodies
         grown(size(grown)) = body
         call move_alloc(grown, model%rigid_bodies)
      end do
      call check_reference_nodes(self, model, moved_by, led_by)
      call check_elements(self, model, led_by)
   end subroutine read_rigid_bodies

   subroutine read_body(self, model, card, body, ok)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card
      integer, intent(in) :: card
      type(rigid_body_t), intent(out) :: body
      !> .false.: an error was reported
      logical, intent(out) :: ok
      type(token_t) :: tie, pin, other

      call find_reference_node(self, model, parameter_of(self, card, 'REF NODE'), body%reference_node)
      tie = parameter_of(self, card, 'TIE NSET')
      other = parameter_of(self, card, 'NSET')
      pin = parameter_of(self, card, 'PIN NSET')
      ok = tie%line == 0 .or. other%line == 0
      if (.not. ok) call fail_at(self, other, 'NSET means the same as TIE NSET; give one of them')
      if (tie%line == 0) tie = other
      if (tie%line == 0 .and. pin%line == 0) call fail_at(self, self%deck%cards(card)%name, &
         '*RIGID BODY needs the parameter TIE NSET=... or PIN NSET=... (node sets that move with the reference node)')
      call find_members(self, model, tie, body%reference_node, body%tied)
      call find_members(self, model, pin, body%reference_node, body%pinned)
      ok = ok .and. body%reference_node > 0 .and. size(body%tied) + size(body%pinned) > 0
      self%broken_bodies = self%broken_bodies .or. .not. ok
      associate (line => self%deck%lines(self%deck%cards(card)%name%line))
         body%line = line%number
         body%file = self%deck%sources(line%source)%path
      end associate
   end subroutine read_body

   !> A number, or a set of one node.
   subroutine find_reference_node(self, model, token, node)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(token_t), intent(in) :: token
      !> Index of the node; 0 after an error
      integer, intent(out) :: node
      integer :: number, status, set

      node = 0
      if (token%last < token%first) return
      call parse_integer(self%deck%text(token), number, status)
      if (status == number_not_one) then
         call find_set(self, 'node', self%node_sets, token, set)
         if (set == 0) return
         associate (members => model%node_sets(set)%members)
            if (size(members) == 1) then
               node = members(1)
            else if (.not. self%broken_nodes) then
               call fail_at(self, token, 'a rigid body has one reference node; the node set '//name_of(self, token)// &
                  ' has '//to_text(size(members))//' members')
            end if
         end associate
      else
         node = self%nodes%get(number)
         if (node == 0 .and. .not. self%broken_nodes) call fail_at(self, token, 'there is no node '// &
            self%deck%text(token))
      end if
   end subroutine find_reference_node

   !> Members of a set, which must have some, without the reference node.
   subroutine find_members(self, model, token, reference_node, members)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Name of the set; no line: there is none
      type(token_t), intent(in) :: token
      !> Index of the node; 0: not known
      integer, intent(in) :: reference_node
      !> Indices of the nodes (n); empty after an error
      integer, allocatable, intent(out) :: members(:)
      integer :: set

      allocate (members(0))
      if (token%line == 0) return
      call find_set(self, 'node', self%node_sets, token, set)
      if (set == 0) return
      members = model%node_sets(set)%members
      if (size(members) == 0 .and. .not. self%broken_nodes) call fail_at(self, token, 'the node set '// &
         name_of(self, token)//' has no members')
      if (any(members == reference_node)) then
         call fail_at(self, token, 'node '//to_text(model%node_id(reference_node))//' of '//name_of(self, token)// &
            ' is the reference node of this rigid body; it cannot move with itself')
         members = pack(members, members /= reference_node)
      end if
   end subroutine find_members

   !> A node moves with one rigid body at most, in one way, and is the reference node of one.
   subroutine claim_nodes(self, model, card, body, moved_by, led_by)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card
      integer, intent(in) :: card
      type(rigid_body_t), intent(inout) :: body
      !> Card that each node moves by, and the one of which it is the reference node (n_nodes); 0: none
      integer, intent(inout) :: moved_by(:), led_by(:)
      integer :: first

      associate (reference => body%reference_node, at => self%deck%cards(card)%name)
         if (led_by(reference) > 0) then
            call fail_at(self, at, 'node '//to_text(model%node_id(reference))//' is the reference node of two rigid'// &
               ' bodies; the other is in '//place_of(self, led_by(reference))//'. One *NSET can join their sets')
         else
            led_by(reference) = card
         end if
         call claim(body%tied)
         call claim(body%pinned)
      end associate

   contains

      !> What is claimed already is left out.
      subroutine claim(members)
         !> Indices of the nodes (n)
         integer, allocatable, intent(inout) :: members(:)

         first = findloc(moved_by(members) > 0, .true., 1)
         if (first > 0) then
            associate (node => members(first))
               if (moved_by(node) == card) then
                  call fail_at(self, self%deck%cards(card)%name, 'node '//to_text(model%node_id(node))// &
                     ' is in TIE NSET and in PIN NSET')
               else
                  call fail_at(self, self%deck%cards(card)%name, 'node '//to_text(model%node_id(node))// &
                     ' would move with two rigid bodies; the other is in '//place_of(self, moved_by(node)))
               end if
            end associate
         end if
         members = pack(members, moved_by(members) == 0)
         moved_by(members) = card
      end subroutine claim

   end subroutine claim_nodes

   !> No chains: a reference node does not move with another rigid body.
   subroutine check_reference_nodes(self, model, moved_by, led_by)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Card that each node moves by, and the one of which it is the reference node (n_nodes); 0: none
      integer, intent(in) :: moved_by(:), led_by(:)
      integer :: node

      do node = 1, size(moved_by)
         if (moved_by(node) == 0 .or. led_by(node) == 0) cycle
         call fail_at(self, self%deck%cards(led_by(node))%name, 'the reference node of this rigid body, '// &
            to_text(model%node_id(node))//', moves with the rigid body in '//place_of(self, moved_by(node)))
      end do
   end subroutine check_reference_nodes

   !> A rigid body without any element would float.
   subroutine check_elements(self, model, led_by)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Card of which each node is the reference node (n_nodes); 0: none
      integer, intent(in) :: led_by(:)
      logical :: has_element(0:model%n_nodes)
      integer :: i

      if (self%broken_nodes .or. self%broken_elements) return
      has_element = .false.
      do i = 1, model%n_elements
         has_element(model%connectivity(:, i)) = .true.
      end do
      do i = 1, size(model%rigid_bodies)
         associate (body => model%rigid_bodies(i))
            if (any(has_element([body%reference_node, body%tied, body%pinned]))) cycle
            call fail_at(self, self%deck%cards(led_by(body%reference_node))%name, &
               'no node of this rigid body belongs to an element')
         end associate
      end do
   end subroutine check_elements

   !> `file:line` of a card.
   pure function place_of(self, card) result(text)
      type(reader_t), intent(in) :: self
      !> Index of the card
      integer, intent(in) :: card
      character(len=:), allocatable :: text

      text = self%deck%place(self%deck%cards(card)%name%line)
   end function place_of

end module litz_read_rigid_bodies
