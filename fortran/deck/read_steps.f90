!> *STEP to *END STEP, *BOUNDARY in the model part, and initial values. A step keeps what it does not redefine.
module litz_read_steps
   use litz_kinds, only: dp
   use litz_text, only: to_text
   use litz_growing_text, only: growing_text_t
   use litz_deck, only: token_t
   use litz_fields, only: n_fields, field_temperature
   use litz_foreign_words, only: advice_about
   use litz_model, only: model_t, step_t
   use litz_reader, only: reader_t, fail_at, parameter_of, choice_of, has_flag, integer_parameter, keyword_of, &
      name_of, n_cards_of
   use litz_data_lines, only: read_line
   use litz_lookup, only: name_map_t
   use litz_nodal_values, only: value_list_t, kind_boundary, kind_temperature, kind_initial, field_of_load, &
      start_list, begin_step, read_nodal_values
   use litz_read_requests, only: request_list_t, begin_requests, read_request
   use litz_read_controls, only: read_controls, read_solver, read_solution_technique
   implicit none
   private
   public :: read_steps

   !> Smallest increment where the deck gives none, as a part of the step
   real(dp), parameter :: smallest_part = 1.0e-5_dp

contains

   subroutine read_steps(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      type(value_list_t) :: boundary, load(n_fields), temperature, initial
      type(request_list_t) :: requests
      type(name_map_t) :: names
      integer :: card, step, step_card, field
      logical :: has_procedure

      allocate (model%steps(self%n_steps))
      call start_list(boundary, kind_boundary, model)
      call start_list(temperature, kind_temperature, model)
      call start_list(initial, kind_initial, model)
      model%has_field(field_temperature) = n_cards_of(self, 'TEMPERATURE') + n_cards_of(self, 'INITIAL CONDITIONS') > 0
      do field = 1, n_fields
         call start_list(load(field), field, model)
      end do
      step = 0
      step_card = 0
      has_procedure = .false.
      do card = 1, self%deck%n_cards
         if (self%step(card) > step) then
            if (step > 0) call close_step()
            step = self%step(card)
            step_card = card
            has_procedure = .false.
            call open_step()
         end if
         select case (keyword_of(self, card))
         case ('BOUNDARY')
            call read_nodal_values(self, model, card, boundary)
         case ('INITIAL CONDITIONS')
            call read_nodal_values(self, model, card, initial)
         case ('TEMPERATURE')
            call read_nodal_values(self, model, card, temperature)
         case ('')
            ! one that has been reported already, such as *DYNAMIC
            has_procedure = has_procedure .or. &
               index(advice_about(self%deck%text(self%deck%cards(card)%name)), 'use *STATIC') > 0
         case ('STATIC')
            if (has_procedure) call fail_at(self, self%deck%cards(card)%name, 'this step has two *STATIC')
            has_procedure = .true.
            call read_static(self, card, model%steps(step))
         case ('NODE PRINT', 'EL PRINT', 'CONTACT PRINT', 'ENERGY PRINT', 'ELECTRODE PRINT', 'NODE FILE', 'EL FILE')
            call read_request(self, model, card, requests, model%steps(step))
         case ('RESTART')
            model%steps(step)%restart_frequency = 0
            if (has_flag(self, card, 'WRITE')) model%steps(step)%restart_frequency = &
               integer_parameter(self, card, 'FREQUENCY', 1)
         case ('CONTROLS')
            call read_controls(self, card, model%steps(step)%controls)
         case ('SOLVER')
            call read_solver(self, card, model%steps(step))
         case ('SOLUTION TECHNIQUE')
            call read_solution_technique(self, card, model%steps(step))
         case default
            field = field_of_load(keyword_of(self, card))
            if (field > 0) call read_nodal_values(self, model, card, load(field))
         end select
      end do
      if (step > 0) call close_step()
      model%initial = initial%items(:initial%n)

   contains

      subroutine open_step()
         real(dp) :: previous_total

         previous_total = 0
         associate (this => model%steps(step))
            if (step > 1) then
               this%controls = model%steps(step - 1)%controls
               this%solver = model%steps(step - 1)%solver
               this%coupling = model%steps(step - 1)%coupling
               this%reform_kernel = model%steps(step - 1)%reform_kernel
               this%output_frequency = model%steps(step - 1)%output_frequency
               this%restart_frequency = model%steps(step - 1)%restart_frequency
               previous_total = model%steps(step - 1)%total
            end if
            call begin_step(boundary, model, previous_total)
            call begin_step(temperature, model, previous_total)
            do field = 1, n_fields
               call begin_step(load(field), model, previous_total)
            end do
            call begin_requests(requests)
            call read_step_line(self, card, names, this)
         end associate
      end subroutine open_step

      subroutine close_step()
         if (.not. has_procedure) call fail_at(self, self%deck%cards(step_card)%name, 'this step has no *STATIC')
         call check_increments(self, step_card, model%steps(step), has_procedure)
         model%steps(step)%boundary = boundary%items(:boundary%n)
         model%steps(step)%predefined = temperature%items(:temperature%n)
         model%steps(step)%load = [(load(field)%items(:load(field)%n), field=1, n_fields)]
         model%steps(step)%requests = requests%items(:requests%n)
      end subroutine close_step

   end subroutine read_steps

   !> *STEP: its name, title and parameters.
   subroutine read_step_line(self, card, names, step)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(name_map_t), intent(inout) :: names
      type(step_t), intent(inout) :: step
      type(token_t) :: token
      type(growing_text_t) :: title
      integer :: line, index

      token = parameter_of(self, card, 'NAME')
      if (token%last >= token%first) then
         call title%append(' '//self%deck%text(token))
         if (names%get(name_of(self, token)) > 0) call fail_at(self, token, 'there are two steps with the name '// &
            self%deck%shown(token))
         call names%put(name_of(self, token), index)
      end if
      do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
         call title%append(' '//self%deck%text(self%deck%line_token(line)))
      end do
      step%title = title%text()
      ! the first word has no blank before it
      step%title = step%title(2:)
      step%max_increments = integer_parameter(self, card, 'INC', step%max_increments)
      if (choice_of(self, card, 'NLGEOM') == 'NO') call fail_at(self, parameter_of(self, card, 'NLGEOM'), &
         'NLGEOM=NO is not possible: litz always takes large displacements into account; leave it out')
   end subroutine read_step_line

   subroutine read_static(self, card, step)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(step_t), intent(inout) :: step
      logical :: ok

      step%direct = has_flag(self, card, 'DIRECT')
      associate (this => self%deck%cards(card), values => self%values)
         if (this%last_data < this%first_data) then
            call set_default_increments()
            return
         end if
         call read_line(self, card, this%first_data, ok)
         if (.not. ok) then
            call set_default_increments()
            return
         end if
         step%total = merge(values%real(2), 1.0_dp, values%given(2))
         step%first = merge(values%real(1), step%total, values%given(1))
         step%smallest = merge(values%real(3), min(smallest_part*step%total, step%first), values%given(3))
         step%largest = merge(values%real(4), step%total, values%given(4))
         if (step%direct) step%largest = step%first
         if (step%first > step%total) call fail_at(self, values%token(1), 'the first increment, '// &
            to_text(step%first)// &
            ', is larger than the step, '//to_text(step%total))
         if (values%given(3) .and. step%smallest > step%first) call fail_at(self, values%token(3), &
            'the smallest increment, '// &
            to_text(step%smallest)//', is larger than the first, '//to_text(step%first))
         if (values%given(4) .and. step%largest < step%first) call fail_at(self, values%token(4), &
            'the largest increment, '// &
            to_text(step%largest)//', is smaller than the first, '//to_text(step%first))
      end associate

   contains

      subroutine set_default_increments()
         step%total = 1
         step%first = 1
         step%smallest = smallest_part
         step%largest = 1
      end subroutine set_default_increments

   end subroutine read_static

   !> A step whose largest increments do not reach its end cannot finish.
   subroutine check_increments(self, card, step, has_procedure)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(step_t), intent(in) :: step
      !> .true.: the step has a *STATIC
      logical, intent(in) :: has_procedure
      type(token_t) :: token
      real(dp) :: needed

      if (.not. has_procedure) return
      needed = step%total/step%largest
      if (needed <= step%max_increments*(1 + 1.0e-9_dp)) return
      token = parameter_of(self, card, 'INC')
      if (token%line == 0) token = self%deck%cards(card)%name
      call fail_at(self, token, 'the step needs '//to_text(real(ceiling(min(needed, 1.0e9_dp)*(1 - 1.0e-12_dp)), &
         dp))// &
         ' increments at least, but INC allows '//to_text(step%max_increments))
   end subroutine check_increments

end module litz_read_steps
