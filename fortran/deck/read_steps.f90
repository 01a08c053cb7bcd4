!> *STEP to *END STEP, *BOUNDARY in the model part, and initial values. A step keeps what it does not redefine.
module litz_read_steps
   use litz_kinds, only: dp
   use litz_text, only: to_text
   use litz_growing_text, only: growing_text_t
   use litz_deck, only: token_t
   use litz_fields, only: fields, n_fields, field_displacement, field_temperature, field_of_dof, group_mechanical
   use litz_foreign_words, only: role_of, role_procedure
   use litz_model, only: model_t, step_t, solved_by_heat, solved_by_all
   use litz_reader, only: reader_t, fail_at, warn_at, parameter_of, choice_of, has_flag, integer_parameter, &
      real_parameter, &
      keyword_of, name_of, n_cards_of
   use litz_data_lines, only: read_line
   use litz_lookup, only: name_map_t
   use litz_nodal_values, only: value_list_t, kind_boundary, kind_temperature, kind_initial, field_of_load, &
      start_list, begin_step, read_nodal_values, no_longer_named
   use litz_read_element_loads, only: load_list_t, start_loads, begin_loads, read_element_loads
   use litz_read_element_heat, only: heat_cards_t, begin_heat, read_element_heat
   use litz_read_requests, only: request_list_t, begin_requests, read_request
   use litz_read_controls, only: read_controls, read_solver, read_solution_technique
   implicit none
   private
   public :: read_steps

   !> Smallest increment where the deck gives none, as a part of the step
   real(dp), parameter :: smallest_part = 1.0e-5_dp

   !> What limits the increments of a step over time
   character(len=6), parameter :: limits(2) = [character(len=6) :: 'DELTMX', 'ERROR']

   character(len=*), parameter :: rate_is_missing = &
      'END=SS needs the rate below which temperatures are steady, the fifth value of the data line'

   !> What holds at the place that the reading has reached.
   type :: so_far_t
      type(value_list_t) :: boundary, load(n_fields), temperature, initial
      type(request_list_t) :: requests
      type(name_map_t) :: names
      type(heat_cards_t) :: heat_cards
      type(load_list_t) :: element_loads
      !> Number of the step; its *STEP, the last *CLOAD, *DLOAD or *LORENTZ, and the last of *DFLUX, *FILM, *RADIATE in
      !> it (0: none)
      integer :: step = 0, step_card = 0, load_card = 0, heat_card = 0
      !> The step has a *STATIC or another procedure
      logical :: has_procedure = .false.
   end type so_far_t

contains

   subroutine read_steps(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      type(so_far_t) :: so_far
      integer :: card, field

      allocate (model%steps(self%n_steps))
      call start_list(so_far%boundary, kind_boundary, model)
      call start_list(so_far%temperature, kind_temperature, model)
      call start_list(so_far%initial, kind_initial, model)
      model%has_field(field_temperature) = n_cards_of(self, 'TEMPERATURE') + n_cards_of(self, 'INITIAL CONDITIONS') &
         > 0 .or. solves_temperatures(self)
      do field = 1, n_fields
         call start_list(so_far%load(field), field, model)
      end do
      call start_loads(self, model, so_far%element_loads)
      do card = 1, self%deck%n_cards
         if (self%step(card) > so_far%step) then
            if (so_far%step > 0) call close_step(self, model, so_far)
            call open_step(self, model, card, so_far)
         end if
         call read_card(self, model, card, so_far)
      end do
      if (so_far%step > 0) call close_step(self, model, so_far)
      model%initial = so_far%initial%items(:so_far%initial%n)
   end subroutine read_steps

   !> Some step of the deck does.
   logical function solves_temperatures(self)
      type(reader_t), intent(in) :: self

      solves_temperatures = n_cards_of(self, 'COUPLED THERMAL-ELECTRICAL') &
         + n_cards_of(self, 'COUPLED TEMPERATURE-DISPLACEMENT') > 0
   end function solves_temperatures

   subroutine read_card(self, model, card, so_far)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      !> Index of the card
      integer, intent(in) :: card
      type(so_far_t), intent(inout) :: so_far
      character(len=:), allocatable :: keyword
      integer :: field

      keyword = keyword_of(self, card)
      associate (step => so_far%step)
         select case (keyword)
         case ('BOUNDARY')
            call read_nodal_values(self, model, card, so_far%boundary)
         case ('INITIAL CONDITIONS')
            call read_nodal_values(self, model, card, so_far%initial)
         case ('TEMPERATURE')
            call read_nodal_values(self, model, card, so_far%temperature)
         case ('')
            ! one that has been reported already, such as *DYNAMIC
            so_far%has_procedure = so_far%has_procedure .or. &
               role_of(self%deck%text(self%deck%cards(card)%name)) == role_procedure
         case ('STATIC', 'COUPLED THERMAL-ELECTRICAL', 'COUPLED TEMPERATURE-DISPLACEMENT')
            call read_procedure(self, model, card, so_far)
         case ('NODE PRINT', 'EL PRINT', 'CONTACT PRINT', 'ENERGY PRINT', 'ELECTRODE PRINT', 'NODE FILE', 'EL FILE', &
            'CONTACT FILE')
            call read_request(self, model, card, so_far%requests, model%steps(step))
         case ('RESTART')
            model%steps(step)%restart_frequency = 0
            if (has_flag(self, card, 'WRITE')) model%steps(step)%restart_frequency = &
               integer_parameter(self, card, 'FREQUENCY', 1)
         case ('DFLUX', 'FILM', 'RADIATE')
            so_far%heat_card = card
            call read_element_heat(self, model, card, model%steps(step)%heat, so_far%heat_cards)
         case ('DLOAD', 'LORENTZ')
            so_far%load_card = card
            call read_element_loads(self, model, card, so_far%element_loads)
         case ('CONTROLS')
            call refuse_second(self, so_far%step_card, card, 'PARAMETERS')
            call read_controls(self, card, model%steps(step)%controls)
         case ('SOLVER')
            call refuse_second(self, so_far%step_card, card)
            call read_solver(self, card, model%steps(step))
         case ('SOLUTION TECHNIQUE')
            call refuse_second(self, so_far%step_card, card)
            call read_solution_technique(self, card, model%steps(step))
         case default
            field = field_of_load(keyword)
            if (field > 0) call read_nodal_values(self, model, card, so_far%load(field))
            if (field == field_displacement) so_far%load_card = card
         end select
      end associate
   end subroutine read_card

   !> A step says once how it is solved: of two cards the user would not see which one holds.
   subroutine refuse_second(self, step_card, card, parameter)
      type(reader_t), intent(inout) :: self
      !> Index of the *STEP, and of the card
      integer, intent(in) :: step_card, card
      !> Cards that differ in this choice are of different kinds
      character(len=*), intent(in), optional :: parameter
      character(len=:), allocatable :: what
      integer :: other

      what = '*'//keyword_of(self, card)
      do other = step_card + 1, card - 1
         if (keyword_of(self, other) /= keyword_of(self, card)) cycle
         if (present(parameter)) then
            if (choice_of(self, card, parameter) == '') return
            if (choice_of(self, other, parameter) /= choice_of(self, card, parameter)) cycle
            what = what//', '//parameter//'='//self%deck%shown(parameter_of(self, card, parameter))
         end if
         call fail_at(self, self%deck%cards(card)%name, 'this step has two '//what//'; first in '// &
            self%deck%place(self%deck%cards(other)%name%line))
         return
      end do
   end subroutine refuse_second

   !> A step has what the one before it has.
   subroutine open_step(self, model, card, so_far)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      !> Index of its *STEP
      integer, intent(in) :: card
      type(so_far_t), intent(inout) :: so_far
      real(dp) :: previous_total
      integer :: field

      so_far%step = self%step(card)
      so_far%step_card = card
      so_far%load_card = 0
      so_far%heat_card = 0
      so_far%has_procedure = .false.
      previous_total = 0
      associate (step => so_far%step, this => model%steps(so_far%step))
         if (step > 1) then
            this%controls = model%steps(step - 1)%controls
            this%solver = model%steps(step - 1)%solver
            this%coupling = model%steps(step - 1)%coupling
            this%reform_kernel = model%steps(step - 1)%reform_kernel
            this%output_frequency = model%steps(step - 1)%output_frequency
            this%contact_frequency = model%steps(step - 1)%contact_frequency
            this%restart_frequency = model%steps(step - 1)%restart_frequency
            this%nlgeom = model%steps(step - 1)%nlgeom
            previous_total = model%steps(step - 1)%total
         end if
         call begin_step(so_far%boundary, model, previous_total)
         call begin_step(so_far%temperature, model, previous_total)
         do field = 1, n_fields
            call begin_step(so_far%load(field), model, previous_total)
         end do
         call begin_loads(so_far%element_loads, model, previous_total)
         call begin_heat(model, step, so_far%heat_cards)
         call begin_requests(so_far%requests)
         call read_step_line(self, card, so_far%names, this)
      end associate
   end subroutine open_step

   !> What holds in a step, all of whose cards have been read.
   subroutine close_step(self, model, so_far)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      type(so_far_t), intent(in) :: so_far
      integer :: field

      associate (this => model%steps(so_far%step), boundary => so_far%boundary, temperature => so_far%temperature, &
         load => so_far%load, heat_card => so_far%heat_card)
         if (.not. so_far%has_procedure) call fail_at(self, self%deck%cards(so_far%step_card)%name, &
            'this step has no *STATIC')
         call check_increments(self, so_far%step_card, this, so_far%has_procedure)
         if (.not. this%solves(field_displacement)) call refuse_motions(self, boundary, so_far%load_card)
         if (.not. this%solves(field_temperature) .and. heat_card > 0) call fail_at(self, &
            self%deck%cards(heat_card)%name, 'a step that does not solve for temperatures has no *'// &
            keyword_of(self, heat_card)//'; put it into a *COUPLED THERMAL-ELECTRICAL or'// &
            ' *COUPLED TEMPERATURE-DISPLACEMENT')
         this%has_solved = this%solves
         if (so_far%step > 1) this%has_solved = this%solves .or. model%steps(so_far%step - 1)%has_solved
         this%boundary = boundary%items(:boundary%n)
         this%predefined = temperature%items(:temperature%n)
         if (so_far%step > 1) this%let_go = no_longer_named(model%steps(so_far%step - 1)%predefined, temperature)
         this%element_loads = so_far%element_loads%items(:so_far%element_loads%n)
         this%load = [(load(field)%items(:load(field)%n), field=1, n_fields)]
         if (.not. this%solves(field_temperature) .and. solves_temperatures(self)) call set_temperatures_aside(self, &
            this, boundary, load(field_temperature))
         this%requests = so_far%requests%items(:so_far%requests%n)
      end associate
   end subroutine close_step

   !> What other steps prescribe of temperatures, and feed in of heat, is nothing to one that does not solve for them.
   subroutine set_temperatures_aside(self, step, boundary, load)
      type(reader_t), intent(inout) :: self
      type(step_t), intent(inout) :: step
      !> Prescribed values, and heat that is fed in
      type(value_list_t), intent(in) :: boundary, load

      call refuse(boundary)
      call refuse(load)
      step%boundary = pack(step%boundary, field_of_dof(step%boundary%dof) /= field_temperature)
      step%load = pack(step%load, field_of_dof(step%load%dof) /= field_temperature)

   contains

      subroutine refuse(list)
         type(value_list_t), intent(in) :: list
         integer :: i

         do i = 1, list%n
            if (list%line(i) == 0 .or. field_of_dof(list%items(i)%dof) /= field_temperature) cycle
            call fail_at(self, self%deck%line_token(list%line(i)), 'this step does not solve for temperatures; give'// &
               ' them by *TEMPERATURE, or use *COUPLED TEMPERATURE-DISPLACEMENT')
            return
         end do
      end subroutine refuse

   end subroutine set_temperatures_aside

   !> What the step solves for.
   subroutine read_procedure(self, model, card, so_far)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      !> Index of the card
      integer, intent(in) :: card
      type(so_far_t), intent(inout) :: so_far

      if (so_far%has_procedure) call fail_at(self, self%deck%cards(card)%name, 'this step has two *'// &
         keyword_of(self, card))
      so_far%has_procedure = .true.
      if (keyword_of(self, card) == 'COUPLED THERMAL-ELECTRICAL') model%steps(so_far%step)%solves = solved_by_heat
      if (keyword_of(self, card) == 'COUPLED TEMPERATURE-DISPLACEMENT') model%steps(so_far%step)%solves = solved_by_all
      call read_transient(self, card, model%steps(so_far%step))
      call read_increments(self, card, model%steps(so_far%step))
      call check_procedure(self, model, card, so_far%step)
   end subroutine read_procedure

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
      step%nlgeom = step%nlgeom .or. has_flag(self, card, 'NLGEOM')
      if (choice_of(self, card, 'NLGEOM') == 'NO') call warn_at(self, parameter_of(self, card, 'NLGEOM'), &
         'large_displacements', 'NLGEOM=NO is not possible: litz takes large displacements into account in every step')
   end subroutine read_step_line

   !> *STATIC or *COUPLED THERMAL-ELECTRICAL
   subroutine read_increments(self, card, step)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(step_t), intent(inout) :: step
      logical :: ok

      ! as in Abaqus, what limits the change of temperatures lets increments grow and shrink
      step%direct = has_flag(self, card, 'DIRECT') .or. (step%transient .and. &
         .not. max(step%largest_change, step%largest_error) > 0)
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
         if (step%solves(field_temperature)) call read_rate(self, card, step)
         step%total = merge(values%real(2), 1.0_dp, values%given(2))
         step%first = step%total
         ! nothing tells the error of the first one
         if (step%largest_error > 0) step%first = merge(values%real(3), smallest_part*step%total, values%given(3))
         if (values%given(1)) step%first = values%real(1)
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
         step%first = merge(smallest_part, 1.0_dp, step%largest_error > 0)
         step%smallest = smallest_part
         step%largest = 1
      end subroutine set_default_increments

   end subroutine read_increments

   !> What a step that solves for temperatures needs.
   subroutine check_procedure(self, model, card, step)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card of the procedure, and number of the step
      integer, intent(in) :: card, step
      integer :: i

      associate (token => self%deck%cards(card)%name, procedure => '*'//keyword_of(self, card))
         if (.not. model%steps(step)%solves(field_temperature)) return
         if (model%steps(step)%transient .and. .not. self%broken_keywords) call require_storage(self, model, card)
         if (model%steps(step)%solves(field_displacement)) call require_electrical(self, model, card)
         do i = 1, size(model%materials)
            associate (material => model%materials(i))
               if (allocated(material%heat_conductivity) .or. .not. material%conductivity > 0 .or. &
                  self%broken_keywords) cycle
               call fail_at(self, token, 'the material '//material%name//' conducts currents, but not their heat;'// &
                  ' give it *CONDUCTIVITY')
            end associate
         end do
      end associate
   end subroutine check_procedure

   !> Steady or over time.
   subroutine read_transient(self, card, step)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(step_t), intent(inout) :: step
      integer :: i
      type(token_t) :: token

      if (.not. step%solves(field_temperature)) return
      step%transient = .not. has_flag(self, card, 'STEADY STATE')
      step%largest_change = real_parameter(self, card, 'DELTMX', 0.0_dp)
      step%largest_error = real_parameter(self, card, 'ERROR', 0.0_dp)
      do i = 1, size(limits)
         token = parameter_of(self, card, trim(limits(i)))
         if (token%line == 0 .or. (step%transient .and. .not. has_flag(self, card, 'DIRECT'))) cycle
         call fail_at(self, token, trim(limits(i))//' chooses the increments of steps over time: it is not possible'// &
            ' with STEADY STATE or DIRECT')
      end do
      if (choice_of(self, card, 'END') == 'PERIOD') return
      token = parameter_of(self, card, 'END')
      if (.not. step%transient) then
         call fail_at(self, token, 'END=SS ends a step over time; one with STEADY STATE is steady from its start')
      else if (self%deck%cards(card)%last_data < self%deck%cards(card)%first_data) then
         call fail_at(self, token, rate_is_missing)
      end if
   end subroutine read_transient

   !> The fifth value of the data line, which END=SS needs.
   subroutine read_rate(self, card, step)
      type(reader_t), intent(inout) :: self
      !> Index of the card, whose data line is the one read last
      integer, intent(in) :: card
      type(step_t), intent(inout) :: step

      if (choice_of(self, card, 'END') == 'SS') then
         step%steady_rate = self%values%real(5)
         if (.not. self%values%given(5)) call fail_at(self, parameter_of(self, card, 'END'), rate_is_missing)
      else if (self%values%given(5)) then
         call fail_at(self, self%values%token(5), 'a rate below which temperatures are steady needs END=SS')
      end if
   end subroutine read_rate

   !> What conducts heat stores it.
   subroutine require_storage(self, model, card)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card
      integer, intent(in) :: card
      integer :: i

      do i = 1, size(model%materials)
         associate (material => model%materials(i))
            if (.not. allocated(material%heat_conductivity)) cycle
            if (material%density > 0 .and. allocated(material%specific_heat)) cycle
            call fail_at(self, self%deck%cards(card)%name, 'the material '//material%name// &
               ' conducts heat; in a step without STEADY STATE it needs *DENSITY and *SPECIFIC HEAT')
         end associate
      end do
   end subroutine require_storage

   !> Currents flow in every step that moves wires; in Abaqus they do with this parameter only.
   subroutine require_electrical(self, model, card)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card
      integer, intent(in) :: card
      integer :: i

      if (has_flag(self, card, 'ELECTRICAL')) return
      i = findloc(model%materials%conductivity > 0, .true., 1)
      if (i > 0) call fail_at(self, self%deck%cards(card)%name, 'the material '//model%materials(i)%name// &
         ' conducts currents, which make heat: *COUPLED TEMPERATURE-DISPLACEMENT needs the parameter ELECTRICAL')
   end subroutine require_electrical

   !> Where motions are held none can be prescribed and no force can be given.
   subroutine refuse_motions(self, boundary, load_card)
      type(reader_t), intent(inout) :: self
      type(value_list_t), intent(in) :: boundary
      !> Index of a card with forces in the step; 0: it has none
      integer, intent(in) :: load_card
      character(len=*), parameter :: held = 'motions are held in *COUPLED THERMAL-ELECTRICAL'
      integer :: i

      if (load_card > 0) call fail_at(self, self%deck%cards(load_card)%name, held// &
         '; put this *'//keyword_of(self, load_card)//' into a *STATIC')
      do i = 1, boundary%n
         if (boundary%line(i) == 0 .or. fields(field_of_dof(boundary%items(i)%dof))%group /= group_mechanical) cycle
         call fail_at(self, self%deck%line_token(boundary%line(i)), held//'; prescribe them in a *STATIC')
         return
      end do
   end subroutine refuse_motions

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
