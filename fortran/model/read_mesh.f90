!> *NODE and *ELEMENT.
module litz_read_mesh
   use litz_kinds, only: dp
   use litz_text, only: to_text
   use litz_model, only: model_t, element_b31, element_b33
   use litz_reader, only: reader_t, fail_at, read_line, parameter_of, choice_of, keyword_of
   use litz_sets, only: open_set, add_member
   implicit none
   private
   public :: read_mesh

   !> An element shorter than this times the largest coordinate has no direction that could be trusted
   real(dp), parameter :: shortest = 1.0e-12_dp

contains

   subroutine read_mesh(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      integer :: card

      allocate (model%node_id(n_data_lines('NODE')), model%element_id(n_data_lines('ELEMENT')))
      allocate (model%x(3, size(model%node_id)), source=0.0_dp)
      allocate (model%connectivity(2, size(model%element_id)), model%element_type(size(model%element_id)), source=0)
      allocate (self%node_line(size(model%node_id)), self%node_ok(size(model%node_id)), &
         self%element_line(size(model%element_id)))
      do card = 1, self%deck%n_cards
         if (keyword_of(self, card) == 'NODE') call read_nodes(self, card, model)
      end do
      do card = 1, self%deck%n_cards
         if (keyword_of(self, card) == 'ELEMENT') call read_elements(self, card, model)
      end do
      model%node_id = model%node_id(:model%n_nodes)
      model%x = model%x(:, :model%n_nodes)
      model%element_id = model%element_id(:model%n_elements)
      model%element_type = model%element_type(:model%n_elements)
      model%connectivity = model%connectivity(:, :model%n_elements)

   contains

      integer function n_data_lines(keyword) result(n)
         character(len=*), intent(in) :: keyword

         n = 0
         do card = 1, self%deck%n_cards
            if (keyword_of(self, card) == keyword) n = n + self%deck%cards(card)%last_data - &
               self%deck%cards(card)%first_data + 1
         end do
      end function n_data_lines

   end subroutine read_mesh

   !> A node whose position could not be read is kept, so that what refers to it is not reported as well.
   subroutine read_nodes(self, card, model)
      type(reader_t), intent(inout) :: self
      integer, intent(in) :: card
      type(model_t), intent(inout) :: model
      integer :: line, set, known, n
      logical :: ok

      call open_set(self, self%node_sets, parameter_of(self, card, 'NSET'), set)
      do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
         call read_line(self, card, line, ok)
         self%broken_nodes = self%broken_nodes .or. .not. self%values%given(1)
         if (.not. self%values%given(1)) cycle
         associate (id => self%values%whole(1))
            known = self%nodes%get(id)
            if (known > 0) then
               call fail_at(self, self%values%token(1), 'node '//to_text(id)//' is defined twice; first in '// &
                  self%deck%place(self%node_line(known)))
               cycle
            end if
            n = model%n_nodes + 1
            model%n_nodes = n
            model%node_id(n) = id
            model%x(:, n) = self%values%real(2:4)
            self%node_line(n) = line
            self%node_ok(n) = ok
            call self%nodes%put(id, n)
            call add_member(self%node_sets, set, n)
         end associate
      end do
   end subroutine read_nodes

   subroutine read_elements(self, card, model)
      type(reader_t), intent(inout) :: self
      integer, intent(in) :: card
      type(model_t), intent(inout) :: model
      integer :: line, set, known, n, kind
      logical :: ok

      call open_set(self, self%element_sets, parameter_of(self, card, 'ELSET'), set)
      kind = merge(element_b33, element_b31, choice_of(self, card, 'TYPE') == 'B33')
      do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
         call read_line(self, card, line, ok)
         self%broken_elements = self%broken_elements .or. .not. ok
         if (.not. self%values%given(1)) cycle
         associate (id => self%values%whole(1))
            known = self%elements%get(id)
            if (known > 0) then
               self%broken_elements = .true.
               call fail_at(self, self%values%token(1), 'element '//to_text(id)//' is defined twice; first in '// &
                  self%deck%place(self%element_line(known)))
               cycle
            end if
            n = model%n_elements + 1
            model%n_elements = n
            model%element_id(n) = id
            model%element_type(n) = kind
            self%element_line(n) = line
            call self%elements%put(id, n)
            call add_member(self%element_sets, set, n)
            if (ok) call join_nodes(self, model, n)
         end associate
      end do
   end subroutine read_elements

   !> Find the nodes of the element on the line read last.
   subroutine join_nodes(self, model, element)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      integer, intent(in) :: element
      real(dp) :: length
      integer :: k

      do k = 1, 2
         associate (id => self%values%whole(k + 1))
            model%connectivity(k, element) = self%nodes%get(id)
            if (model%connectivity(k, element) > 0 .or. self%broken_nodes) cycle
            self%broken_elements = .true.
            call fail_at(self, self%values%token(k + 1), &
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
