!> *EQUATION: which degrees of freedom linear equations eliminate.
module litz_read_equations
   use litz_kinds, only: dp
   use litz_data_lines, only: read_line
   use litz_deck, only: token_t
   use litz_fields, only: fields, field_of_dof, describe_dofs, group_mechanical, last_dof, field_displacement, &
      field_rotation, n_slots, slot_of_dof
   use litz_model, only: model_t, equation_t
   use litz_numbers, only: parse_integer, number_ok
   use litz_reader, only: reader_t, fail_at, keyword_of, n_cards_of
   use litz_sets, only: find_item
   use litz_sorting, only: sort_integers
   use litz_text, only: to_text
   use litz_unknown_nodes, only: node_unknowns_t, find_unknowns, reason_for_lack_of
   implicit none
   private
   public :: read_equations

   !> A term as a line gives it: nodes of a set, or a single one.
   type :: term_t
      type(token_t) :: token
      integer, allocatable :: nodes(:)
      integer :: dof = 0
      real(dp) :: coefficient = 0
   end type term_t

   !> The equations as they stand while the deck is read, and what nodes have as unknowns.
   type, extends(node_unknowns_t) :: equation_list_t
      type(equation_t), allocatable :: items(:)
      integer :: n = 0
   end type equation_list_t

contains

   subroutine read_equations(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      type(equation_list_t) :: list
      integer :: card

      allocate (list%items(0))
      if (n_cards_of(self, 'EQUATION') > 0) call find_unknowns(model, list)
      do card = 1, self%deck%n_cards
         if (keyword_of(self, card) == 'EQUATION') call read_card(self, model, card, list)
      end do
      model%equations = list%items(:list%n)
      call check_chains(self, model)
   end subroutine read_equations

   !> The equations of a card: for each the number of its terms on a line, and then the terms.
   subroutine read_card(self, model, card, list)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card
      integer, intent(in) :: card
      type(equation_list_t), intent(inout) :: list
      type(term_t), allocatable :: terms(:)
      integer :: line, first_line, n_terms, found
      logical :: ok, all_ok

      n_terms = 0
      found = 0
      all_ok = .true.
      do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
         call read_line(self, card, line, ok)
         if (found == n_terms) then
            call read_count(self, ok, n_terms)
            if (.not. ok) exit
            allocate (terms(n_terms))
            first_line = line
            found = 0
            all_ok = .true.
            cycle
         end if
         if (ok) call read_terms(self, model, terms, found, ok)
         all_ok = all_ok .and. ok
         if (.not. ok) exit
         if (found < n_terms) cycle
         call add_equations(self, model, terms, first_line, list)
         deallocate (terms)
      end do
      if (.not. ok) self%broken_equations = .true.
      if (ok .and. found < n_terms) then
         self%broken_equations = .true.
         call fail_at(self, self%deck%line_token(first_line), 'this equation has '//to_text(n_terms)//' terms; '// &
            to_text(found)//' of them follow')
      end if
   end subroutine read_card

   !> The number of terms, alone on a line.
   subroutine read_count(self, ok, n_terms)
      type(reader_t), intent(inout) :: self
      !> In: the line could be read. Out: it has a number of terms
      logical, intent(inout) :: ok
      !> At least 2
      integer, intent(out) :: n_terms
      integer :: status

      n_terms = 0
      if (.not. ok) return
      call parse_integer(self%deck%text(self%values%token(1)), n_terms, status)
      ok = status == number_ok .and. self%values%n == 1 .and. n_terms >= 2
      if (.not. ok) call fail_at(self, self%values%token(1), 'an equation begins with a line that has the number of'// &
         ' its terms, at least 2; found '//self%deck%shown(self%values%token(1))//more_words())
      ! each has three values on the lines that follow
      if (ok) ok = n_terms <= 3*self%deck%n_lines*16
      if (.not. ok) n_terms = 0

   contains

      function more_words() result(words)
         character(len=:), allocatable :: words

         words = ''
         if (self%values%n > 1) words = ' and other values behind it'
      end function more_words

   end subroutine read_count

   !> The terms of a line: node, degree of freedom and coefficient of each.
   subroutine read_terms(self, model, terms, found, ok)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Of the equation (n_terms)
      type(term_t), intent(inout) :: terms(:)
      !> How many of them have been read
      integer, intent(inout) :: found
      !> .false.: an error was reported
      logical, intent(out) :: ok
      integer :: i, k, node, set

      ok = .true.
      do i = 1, self%values%n, 3
         associate (values => self%values)
            if (found == size(terms)) then
               ok = .false.
               call fail_at(self, values%token(i), 'this equation has '//to_text(size(terms))//' terms; this would'// &
                  ' be another one')
               return
            end if
            do k = i + 1, i + 2
               if (values%given(k)) cycle
               ok = .false.
               call fail_at(self, values%token(k), 'a term of an equation has three values: node or node set,'// &
                  ' degree of freedom and coefficient')
               return
            end do
            found = found + 1
            associate (this => terms(found))
               this%token = values%token(i)
               this%dof = values%whole(i + 1)
               this%coefficient = values%real(i + 2)
               if (field_of_dof(this%dof) == 0) then
                  ok = .false.
                  call fail_at(self, values%token(i + 1), 'degree of freedom '//to_text(this%dof)//' does not'// &
                     ' exist; there are '//describe_dofs('and'))
                  return
               end if
               if (found == 1 .and. .not. abs(this%coefficient) > 0) then
                  ok = .false.
                  call fail_at(self, values%token(i + 2), 'the first degree of freedom is eliminated: its'// &
                     ' coefficient must not be zero')
                  return
               end if
               call find_item(self, 'node', self%node_sets, self%nodes, i, node, set)
               ok = node > 0 .or. set > 0
               if (.not. ok) return
               if (node > 0) this%nodes = [node]
               if (set > 0) this%nodes = by_number(self, model, model%node_sets(set)%members)
            end associate
         end associate
      end do
   end subroutine read_terms

   !> Nodes in the order of the numbers that the deck gives them.
   function by_number(self, model, members) result(nodes)
      type(reader_t), intent(in) :: self
      type(model_t), intent(in) :: model
      !> Indices of nodes (n)
      integer, intent(in) :: members(:)
      integer :: nodes(size(members))
      integer :: numbers(size(members)), i

      numbers = model%node_id(members)
      call sort_integers(numbers)
      nodes = [(self%nodes%get(numbers(i)), i=1, size(numbers))]
   end function by_number

   !> One equation for each node of the sets, in the order of their numbers.
   subroutine add_equations(self, model, terms, line, list)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(term_t), intent(in) :: terms(:)
      !> Line of the deck on which it begins
      integer, intent(in) :: line
      type(equation_list_t), intent(inout) :: list
      type(equation_t) :: equation
      integer :: i, k, n
      logical :: ok

      call check_terms(self, model, terms, list, ok)
      if (.not. ok) then
         self%broken_equations = .true.
         return
      end if
      n = maxval([(size(terms(k)%nodes), k=1, size(terms))])
      call make_room(list, n)
      associate (at => self%deck%lines(line))
         equation%line = at%number
         equation%file = self%deck%sources(at%source)%path
      end associate
      do i = 1, n
         equation%node = [(terms(k)%nodes(min(i, size(terms(k)%nodes))), k=1, size(terms))]
         equation%dof = terms%dof
         equation%coefficient = terms%coefficient
         list%items(list%n + i) = equation
      end do
      list%n = list%n + n
   end subroutine add_equations

   !> Room for some more equations.
   subroutine make_room(list, n)
      type(equation_list_t), intent(inout) :: list
      !> How many
      integer, intent(in) :: n
      type(equation_t), allocatable :: longer(:)

      if (list%n + n <= size(list%items)) return
      allocate (longer(max(list%n + n, 2*size(list%items))))
      longer(:list%n) = list%items(:list%n)
      call move_alloc(longer, list%items)
   end subroutine make_room

   !> What an equation may have as terms.
   subroutine check_terms(self, model, terms, unknowns, ok)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(term_t), intent(in) :: terms(:)
      class(node_unknowns_t), intent(in) :: unknowns
      !> .false.: an error was reported
      logical, intent(out) :: ok
      integer :: k, other

      ok = .true.
      do k = 1, size(terms)
         associate (this => terms(k), n => size(terms(k)%nodes), first => terms(1))
            if (n /= size(first%nodes) .and. n /= 1) then
               call refuse(this%token, 'has '//to_text(n)//' nodes, the first term has '//to_text(size(first%nodes))// &
                  ': sets of an equation have the same number of nodes, or one')
            else if (n == 0) then
               call refuse(this%token, 'has no nodes')
            else if (.not. alike(first%dof, this%dof)) then
               call refuse(this%token, 'is a '//trim(fields(field_of_dof(this%dof))%name)//': an equation between'// &
                  ' motions and other unknowns, or between potentials and temperatures, is not possible')
            end if
            do other = 1, k - 1
               if (terms(other)%dof /= this%dof .or. .not. ok) cycle
               if (any(terms(other)%nodes(min(size(terms(other)%nodes), spread_index(n, size(first%nodes)))) &
                  == this%nodes(min(n, spread_index(n, size(first%nodes)))))) call refuse(this%token, 'names a'// &
                  ' degree of freedom that another term has already; give it one coefficient')
            end do
         end associate
         if (.not. ok) return
         call check_nodes(self, model, terms(k), unknowns, ok)
         if (.not. ok) return
      end do

   contains

      !> `1, 2, ..., n` of the longer set.
      pure function spread_index(n, n_first) result(i)
         !> Nodes of the term, and of the first term
         integer, intent(in) :: n, n_first
         integer :: i(max(n, n_first))
         integer :: j

         i = [(j, j=1, size(i))]
      end function spread_index

      subroutine refuse(token, words)
         type(token_t), intent(in) :: token
         !> Behind the number of the term
         character(len=*), intent(in) :: words

         ok = .false.
         call fail_at(self, token, 'term '//to_text(k)//' of the equation '//words)
      end subroutine refuse

      !> Degrees of freedom that may be in one equation.
      pure logical function alike(dof, other_dof)
         !> In Abaqus's numbers
         integer, intent(in) :: dof, other_dof

         associate (a => fields(field_of_dof(dof)), b => fields(field_of_dof(other_dof)))
            alike = a%group == b%group .and. (a%group == group_mechanical .or. a%name == b%name)
         end associate
      end function alike

   end subroutine check_terms

   !> Nodes that have the degree of freedom, which belongs to them alone.
   subroutine check_nodes(self, model, term, unknowns, ok)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(term_t), intent(in) :: term
      class(node_unknowns_t), intent(in) :: unknowns
      !> .false.: an error was reported
      logical, intent(out) :: ok
      integer :: i, b, last

      ok = self%broken_elements .or. self%broken_nodes .or. self%broken_keywords
      if (.not. ok) then
         ! a node without elements takes part in equations alone
         i = findloc(unknowns%has_unknown(term%nodes, field_of_dof(term%dof)) .or. .not. &
            unknowns%has_element(term%nodes), .false., 1)
         ok = i == 0
         if (.not. ok) then
            call fail_at(self, term%token, 'node '//to_text(model%node_id(term%nodes(i)))// &
               reason_for_lack_of(model, term%nodes(i), field_of_dof(term%dof)))
            return
         end if
      end if
      do b = 1, size(model%rigid_bodies)
         associate (body => model%rigid_bodies(b))
            do i = 1, size(term%nodes)
               last = 0
               if (any(body%pinned == term%nodes(i))) last = last_dof(field_displacement)
               if (any(body%tied == term%nodes(i))) last = last_dof(field_rotation)
               if (term%dof > last) cycle
               ok = .false.
               call fail_at(self, term%token, 'node '//to_text(model%node_id(term%nodes(i)))// &
                  ' has no degree of freedom '//to_text(term%dof)//' of its own: it moves with node '// &
                  to_text(model%node_id(body%reference_node))//', the reference node of the *RIGID BODY in '// &
                  body%file//':'//to_text(body%line))
               return
            end do
         end associate
      end do
      ok = .true.
   end subroutine check_nodes

   !> A degree of freedom is eliminated once, and is then in no other equation.
   subroutine check_chains(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Equation that eliminates a degree of freedom; 0: none
      integer :: eliminated_by(n_slots, model%n_nodes)
      integer :: i, k, other

      eliminated_by = 0
      do i = 1, size(model%equations)
         associate (this => model%equations(i))
            other = eliminated_by(slot_of_dof(this%dof(1)), this%node(1))
            if (other > 0) then
               call refuse(i, other, 1, 'is eliminated by two equations')
               return
            end if
            eliminated_by(slot_of_dof(this%dof(1)), this%node(1)) = i
         end associate
      end do
      do i = 1, size(model%equations)
         associate (this => model%equations(i))
            do k = 2, size(this%node)
               other = eliminated_by(slot_of_dof(this%dof(k)), this%node(k))
               if (other == 0) cycle
               call refuse(i, other, k, 'is in this equation, and eliminated by another one')
               return
            end do
         end associate
      end do

   contains

      subroutine refuse(i, other, k, words)
         !> Equation, the other one, and the term
         integer, intent(in) :: i, other, k
         !> What is wrong
         character(len=*), intent(in) :: words

         self%broken_equations = .true.
         associate (this => model%equations(i), by => model%equations(other))
            call fail_at(self, self%deck%line_token(line_of(this)), 'degree of freedom '//to_text(this%dof(k))// &
               ' of node '//to_text(model%node_id(this%node(k)))//' '//words//', in '//by%file//':'// &
               to_text(by%line)//'; begin that equation with another degree of freedom')
         end associate
      end subroutine refuse

      !> Index into the lines of the deck.
      integer function line_of(equation) result(line)
         type(equation_t), intent(in) :: equation

         do line = 1, self%deck%n_lines
            if (self%deck%lines(line)%number == equation%line .and. &
               self%deck%sources(self%deck%lines(line)%source)%path == equation%file) return
         end do
      end function line_of

   end subroutine check_chains

end module litz_read_equations
