!> *NODE PRINT, *EL PRINT, *CONTACT PRINT, *ENERGY PRINT, *ELECTRODE PRINT, *NODE FILE, *EL FILE and *CONTACT FILE.
!>
!> A step that asks for a kind of output replaces all requests of that kind; the others are carried over.
module litz_read_requests
   use litz_fields, only: fields, field_potential, field_temperature
   use litz_text, only: to_text, words_of, word_length
   use litz_deck, only: token_t
   use litz_model, only: model_t, has_superconductors, step_t, output_request_t, request_node, request_element, &
      request_contact, request_electrode, request_energy
   use litz_reader, only: reader_t, fail_at, warn_of_idle, parameter_of, choice_of, integer_parameter, keyword_of, &
      name_of
   use litz_result_quantities, only: asks_for_sections
   use litz_data_lines, only: read_line
   use litz_sets, only: find_set
   use litz_unknown_nodes, only: nodes_with_unknown
   implicit none
   private
   public :: request_list_t, begin_requests, read_request

   type :: request_list_t
      type(output_request_t), allocatable :: items(:)
      integer :: n = 0
      !> Kinds that this step has asked for
      logical :: asked(5) = .false.
   end type request_list_t

contains

   pure subroutine begin_requests(list)
      type(request_list_t), intent(inout) :: list

      if (.not. allocated(list%items)) allocate (list%items(16))
      list%asked = .false.
   end subroutine begin_requests

   subroutine read_request(self, model, card, list, step)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card
      integer, intent(in) :: card
      type(request_list_t), intent(inout) :: list
      type(step_t), intent(inout) :: step
      type(output_request_t) :: request
      integer :: i

      allocate (request%quantities(0))
      select case (keyword_of(self, card))
      case ('NODE PRINT')
         request%kind = request_node
         call read_print(self, model, card, 'NSET', list, request)
      case ('EL PRINT')
         request%kind = request_element
         call read_print(self, model, card, 'ELSET', list, request)
         do i = 1, size(request%quantities)
            step%has_section_results = step%has_section_results .or. asks_for_sections(request%quantities(i))
         end do
      case ('CONTACT PRINT')
         request%kind = request_contact
         call add_request(list, request)
      case ('ENERGY PRINT')
         request%kind = request_energy
         call add_request(list, request)
      case ('ELECTRODE PRINT')
         request%kind = request_electrode
         call read_electrodes(self, model, card, list, request)
      case ('CONTACT FILE')
         step%contact_frequency = integer_parameter(self, card, 'FREQUENCY', step%contact_frequency)
      case default
         step%output_frequency = integer_parameter(self, card, 'FREQUENCY', step%output_frequency)
         call check_quantities(self, card, step)
      end select
   end subroutine read_request

   pure subroutine add_request(list, request)
      type(request_list_t), intent(inout) :: list
      type(output_request_t), intent(in) :: request
      type(output_request_t), allocatable :: grown(:)
      integer :: i, n

      if (.not. list%asked(request%kind)) then
         n = 0
         do i = 1, list%n
            if (list%items(i)%kind == request%kind) cycle
            n = n + 1
            list%items(n) = list%items(i)
         end do
         list%n = n
         list%asked(request%kind) = .true.
      end if
      if (list%n == size(list%items)) then
         allocate (grown(2*list%n))
         grown(:list%n) = list%items
         call move_alloc(grown, list%items)
      end if
      list%n = list%n + 1
      list%items(list%n) = request
   end subroutine add_request

   !> *NODE PRINT or *EL PRINT: members, sums, or both.
   subroutine read_print(self, model, card, parameter, list, request)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card
      integer, intent(in) :: card
      !> NSET or ELSET
      character(len=*), intent(in) :: parameter
      type(request_list_t), intent(inout) :: list
      type(output_request_t), intent(inout) :: request
      type(token_t) :: token
      integer :: line
      logical :: ok

      token = parameter_of(self, card, parameter)
      if (token%line == 0) call warn_of_idle(self, card, self%deck%cards(card)%name, '*'//keyword_of(self, card)// &
         ' has no '//parameter//': fields of the whole model are always in the result file; ignored')
      if (parameter == 'NSET') then
         call find_set(self, 'node', self%node_sets, parameter_of(self, card, parameter), request%set)
      else
         call find_set(self, 'element', self%element_sets, parameter_of(self, card, parameter), request%set)
      end if
      do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
         call read_line(self, card, line, ok)
         call add_quantities(self, model, card, request)
      end do
      if (request%set == 0 .or. size(request%quantities) == 0) return
      if (choice_of(self, card, 'TOTALS') /= 'ONLY') call add_request(list, request)
      request%totals = .true.
      if (choice_of(self, card, 'TOTALS') /= 'NO') call add_request(list, request)
   end subroutine read_print

   !> The quantities of the line read last.
   subroutine add_quantities(self, model, card, request)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card
      integer, intent(in) :: card
      type(output_request_t), intent(inout) :: request
      character(len=word_length), allocatable :: words(:)
      character(len=8), allocatable :: grown(:)
      character(len=8) :: quantity
      integer :: i

      allocate (words, source=words_of(self%table%keywords(self%spec(card))%data(1)%fields(1)%choices))
      do i = 1, self%values%n
         if (.not. self%values%given(i)) cycle
         quantity = words(self%values%whole(i))(:8)
         if (belongs_to_absent_field(model, quantity)) then
            call fail_at(self, self%values%token(i), trim(quantity)//' cannot be printed: the model has no'// &
               ' temperatures; *INITIAL CONDITIONS, TYPE=TEMPERATURE or *TEMPERATURE give some')
         else if (quantity == 'SC' .and. .not. has_superconductors(model)) then
            call fail_at(self, self%values%token(i), trim(quantity)//' cannot be printed: no element is of a'// &
               ' material with *SUPERCONDUCTOR')
         else if (quantity == 'DLOAD' .and. .not. has_line_loads(self)) then
            call fail_at(self, self%values%token(i), 'DLOAD cannot be printed: no *DLOAD or *LORENTZ gives a force'// &
               ' on the length of wires')
         else if (any(request%quantities == quantity)) then
            call fail_at(self, self%values%token(i), 'the quantity '//trim(quantity)//' is requested twice')
         else
            allocate (grown(size(request%quantities) + 1))
            grown(:size(request%quantities)) = request%quantities
            grown(size(grown)) = quantity
            call move_alloc(grown, request%quantities)
         end if
      end do
   end subroutine add_quantities

   !> Whether any step has loads on the length of wires.
   pure logical function has_line_loads(self)
      type(reader_t), intent(in) :: self
      integer :: card

      has_line_loads = .false.
      do card = 1, self%deck%n_cards
         if (all(keyword_of(self, card) /= [character(len=7) :: 'DLOAD', 'LORENTZ'])) cycle
         associate (this => self%deck%cards(card))
            has_line_loads = has_line_loads .or. this%last_data >= this%first_data
         end associate
      end do
   end function has_line_loads

   !> The quantity is one of a field that the model does not have.
   pure logical function belongs_to_absent_field(model, quantity) result(absent)
      type(model_t), intent(in) :: model
      !> As decks ask for it
      character(len=*), intent(in) :: quantity

      absent = any(.not. model%has_field .and. (fields%value_word == quantity .or. fields%reaction_word == quantity &
         .or. fields%load_word == quantity)) .or. (.not. model%has_field(field_temperature) .and. &
         any(quantity == [character(len=8) :: 'HFL', 'QSIDE', 'QSTORE']))
   end function belongs_to_absent_field

   !> The quantities of *NODE FILE and *EL FILE have to exist; some are in files that ask for them alone.
   subroutine check_quantities(self, card, step)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(step_t), intent(inout) :: step
      integer :: line, i
      logical :: ok

      do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
         call read_line(self, card, line, ok)
         do i = 1, self%values%n
            step%has_section_results = step%has_section_results .or. &
               asks_for_sections(name_of(self, self%values%token(i)))
         end do
      end do
   end subroutine check_quantities

   subroutine read_electrodes(self, model, card, list, request)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card
      integer, intent(in) :: card
      type(request_list_t), intent(inout) :: list
      type(output_request_t), intent(inout) :: request
      logical, allocatable :: has_potential(:), positive(:)
      integer :: line, i
      logical :: ok

      allocate (has_potential, source=nodes_with_unknown(model, field_potential))
      do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
         call read_line(self, card, line, ok)
         if (.not. ok) cycle
         call find_set(self, 'node', self%node_sets, self%values%token(1), request%set)
         call find_set(self, 'node', self%node_sets, self%values%token(2), request%set_2)
         if (request%set == 0 .or. request%set_2 == 0) cycle
         call check_electrode(self%values%token(1), model%node_sets(request%set)%members)
         call check_electrode(self%values%token(2), model%node_sets(request%set_2)%members)
         allocate (positive(model%n_nodes), source=.false.)
         positive(model%node_sets(request%set)%members) = .true.
         do i = 1, size(model%node_sets(request%set_2)%members)
            associate (node => model%node_sets(request%set_2)%members(i))
               if (.not. positive(node)) cycle
               call fail_at(self, self%values%token(2), 'node '//to_text(model%node_id(node))//' is in both electrodes')
               exit
            end associate
         end do
         deallocate (positive)
         call add_request(list, request)
      end do

   contains

      subroutine check_electrode(token, members)
         type(token_t), intent(in) :: token
         !> Indices of the nodes of the electrode (n)
         integer, intent(in) :: members(:)
         integer :: k

         do k = 1, size(members)
            if (has_potential(members(k)) .or. self%broken_nodes .or. self%broken_elements .or. &
               self%broken_keywords) cycle
            call fail_at(self, token, 'node '//to_text(model%node_id(members(k)))//' of '//self%deck%text(token)// &
               ' has no electric potential')
            return
         end do
      end subroutine check_electrode

   end subroutine read_electrodes

end module litz_read_requests
