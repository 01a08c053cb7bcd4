!> From a deck to a model: everything checked, all errors of the deck in one pass.
module litz_deck_reader
   use litz_errors, only: error_t, error_list_t
   use litz_deck_scanner, only: scan_deck
   use litz_growing_text, only: growing_text_t
   use litz_keyword_table, only: keyword_table
   use litz_deck, only: token_t
   use litz_foreign_words, only: advice_about
   use litz_text, only: squeezed
   use litz_material_properties, only: has_thermal_mechanics, has_thermal_resistivity
   use litz_model, only: model_t, material_t, n_nodes_of_deck
   use litz_fields, only: field_temperature
   use litz_reader, only: reader_t, fail_at, keyword_of, parameter_of, real_parameter
   use litz_data_lines, only: read_line
   use litz_card_checks, only: check_cards
   use litz_read_mesh, only: read_mesh
   use litz_sets, only: read_sets
   use litz_read_properties, only: read_materials, read_amplitudes, report_unused
   use litz_read_sections, only: read_sections
   use litz_read_contact, only: read_interactions, read_contact_pairs
   use litz_read_equations, only: read_equations
   use litz_read_rigid_bodies, only: read_rigid_bodies
   use litz_read_steps, only: read_steps
   use litz_read_surfaces, only: read_surfaces
   use litz_read_transforms, only: read_transforms
   use litz_model_checks, only: finding_t, check_connections
   use litz_unit_labels, only: unit_length, si_labels
   implicit none
   private
   public :: read_deck

contains

   !> The model of a deck. It is complete when `errors` is empty.
   subroutine read_deck(path, model, errors, warnings)
      !> The deck file, as the user wrote it
      character(len=*), intent(in) :: path
      type(model_t), intent(out) :: model
      type(error_list_t), intent(out) :: errors, warnings
      type(reader_t) :: self

      call scan_deck(path, self%deck, model%deck_text, self%errors)
      if (self%deck%n_sources > 0) then
         self%table = keyword_table()
         allocate (self%line_read(self%deck%n_lines), source=.false.)
         call read_cards(self, model)
         call check_unread_lines(self)
         warnings = self%warnings
         if (self%errors%count == 0) call report_findings(self, model, warnings)
         call warn_about_spare_nodes(self, model, warnings)
         call warn_about_temperatures(self, model, warnings)
         call warn_about_spots(self, model, warnings)
      end if
      errors = self%errors
      call errors%sort()
      call warnings%sort()
   end subroutine read_deck

   !> In the order in which one part needs another, whatever their order in the deck.
   subroutine read_cards(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model

      if (has_parts(self)) return
      call check_cards(self)
      if (self%deck%n_lines == 0) then
         call report_empty_deck(self)
         return
      end if
      call read_heading(self, model)
      call read_units(self, model)
      call read_constants(self, model)
      call read_mesh(self, model)
      if (self%missed_mesh) return
      call read_sets(self, model)
      call read_materials(self, model)
      call read_sections(self, model)
      call read_amplitudes(self, model)
      call read_interactions(self, model)
      call read_surfaces(self, model)
      call read_contact_pairs(self, model)
      call read_rigid_bodies(self, model)
      call read_equations(self, model)
      if (self%errors%count == 0 .and. model%n_elements == 0) call fail_at(self, &
         self%deck%end_of_line(self%deck%n_lines), 'the deck has no *ELEMENT')
      call read_steps(self, model)
      call read_transforms(self, model)
      call report_unused(self, self%materials, 'material')
      call report_unused(self, self%amplitudes, 'amplitude')
      call report_unused(self, self%interactions, 'surface interaction')
      call report_unused(self, self%surfaces, 'rigid surface')
   end subroutine read_cards

   !> Instances of parts have numbers and names of their own, so that all else that is wrong would be a follow-up error.
   logical function has_parts(self)
      type(reader_t), intent(inout) :: self
      integer :: card

      has_parts = .false.
      allocate (self%spec(self%deck%n_cards), source=0)
      do card = 1, self%deck%n_cards
         if (squeezed(self%deck%text(self%deck%cards(card)%name)) /= 'PART') cycle
         has_parts = .true.
         call fail_at(self, self%deck%cards(card)%name, 'litz has no *PART: '//advice_about('PART')// &
            '; nothing else in'// &
            ' this deck was checked')
         return
      end do
      deallocate (self%spec)
   end function has_parts

   !> Data lines behind something that was wrong, such as a name that does not exist: their errors are reported
   !> in the same pass.
   subroutine check_unread_lines(self)
      type(reader_t), intent(inout) :: self
      integer :: card, line
      logical :: ok

      if (self%errors%count == 0) return
      do card = 1, self%deck%n_cards
         if (self%spec(card) == 0) cycle
         do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
            if (.not. self%line_read(line)) call read_line(self, card, line, ok)
         end do
      end do
   end subroutine check_unread_lines

   !> Components are assigned one by one: gfortran 12 writes beyond the end of the text when a structure constructor
   !> takes a component of deferred length for one of its own.
   subroutine report_empty_deck(self)
      type(reader_t), intent(inout) :: self
      type(error_t) :: error

      error%message = 'the deck is empty'
      error%file = self%deck%sources(1)%path
      call self%errors%add(error)
   end subroutine report_empty_deck

   subroutine read_heading(self, model)
      type(reader_t), intent(in) :: self
      type(model_t), intent(inout) :: model
      type(growing_text_t) :: heading
      integer :: card, line

      do card = 1, self%deck%n_cards
         if (keyword_of(self, card) /= 'HEADING') cycle
         do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
            call heading%append(self%deck%text(self%deck%line_token(line))//new_line('a'))
         end do
      end do
      model%heading = heading%text()
      ! the last line has no end
      model%heading = model%heading(:len(model%heading) - 1)
   end subroutine read_heading

   subroutine read_constants(self, model)
      type(reader_t), intent(in) :: self
      type(model_t), intent(inout) :: model
      integer :: card

      do card = 1, self%deck%n_cards
         if (keyword_of(self, card) /= 'PHYSICAL CONSTANTS') cycle
         model%absolute_zero = real_parameter(self, card, 'ABSOLUTE ZERO', model%absolute_zero)
         model%stefan_boltzmann = real_parameter(self, card, 'STEFAN BOLTZMANN', model%stefan_boltzmann)
      end do
   end subroutine read_constants

   !> *UNITS: labels, which go into heads of tables, where blanks and brackets mean something; those of SI where it is
   !> said to be the system, or for what has no label.
   subroutine read_units(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      logical :: found
      integer :: card

      found = .false.
      do card = 1, self%deck%n_cards
         if (keyword_of(self, card) /= 'UNITS') cycle
         if (found) call fail_at(self, self%deck%cards(card)%name, 'the deck has two *UNITS')
         found = .true.
         model%units = si_labels
         call read_label(self, card, 'LENGTH', model%units%length)
         call read_label(self, card, 'FORCE', model%units%force)
         call read_label(self, card, 'TIME', model%units%time)
         call read_label(self, card, 'CURRENT', model%units%current)
         call read_label(self, card, 'VOLTAGE', model%units%voltage)
         call read_label(self, card, 'TEMPERATURE', model%units%temperature)
      end do
   end subroutine read_units

   subroutine read_label(self, card, quantity, label)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> Parameter that gives the label
      character(len=*), intent(in) :: quantity
      !> In: the label that holds without the parameter. Out: the one of the deck
      character(len=unit_length), intent(inout) :: label
      type(token_t) :: token
      character(len=:), allocatable :: text

      token = parameter_of(self, card, quantity)
      if (token%last < token%first) return
      text = self%deck%text(token)
      if (len(text) > unit_length .or. scan(text, ' []/^()') > 0) then
         call fail_at(self, token, 'a label of a unit has at most 12 letters, without blanks, brackets, / and ^; '// &
            'found '//self%deck%shown(token))
      else
         label = text
      end if
   end subroutine read_label

   !> What the checks of the whole model found, at the line of the element it is about.
   subroutine report_findings(self, model, warnings)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(error_list_t), intent(inout) :: warnings
      type(finding_t), allocatable :: findings(:)
      type(error_t) :: error
      integer :: i

      call check_connections(model, findings)
      do i = 1, size(findings)
         error = self%deck%error_at(self%deck%line_token(self%element_line(findings(i)%element)), findings(i)%message)
         error%kind = findings(i)%kind
         error%element = model%element_id(findings(i)%element)
         error%is_warning = len_trim(error%kind) > 0
         if (error%is_warning) then
            call warnings%add(error)
         else
            call self%errors%add(error)
         end if
      end do
   end subroutine report_findings

   !> Temperatures of materials that do not depend on them are results and nothing else.
   subroutine warn_about_temperatures(self, model, warnings)
      type(reader_t), intent(in) :: self
      type(model_t), intent(in) :: model
      type(error_list_t), intent(inout) :: warnings
      integer :: card, i

      if (self%errors%count > 0) return
      do card = 1, self%deck%n_cards
         if (.not. any(keyword_of(self, card) == [character(len=18) :: 'TEMPERATURE', 'INITIAL CONDITIONS'])) cycle
         if (.not. any([(depends_on_temperature(model%materials(i)), i=1, size(model%materials))])) then
            call warn(self, warnings, card, 'idle_temperatures', 'temperatures have no effect: no material of'// &
               ' the model depends on temperature')
         end if
         return
      end do

   contains

      pure logical function depends_on_temperature(material)
         type(material_t), intent(in) :: material

         depends_on_temperature = has_thermal_mechanics(material) .or. allocated(material%heat_conductivity) .or. &
            has_thermal_resistivity(material) .or. allocated(material%superconductor)
      end function depends_on_temperature

   end subroutine warn_about_temperatures

   !> A temperature at which metal softens or melts, and spots of which no temperature is known.
   subroutine warn_about_spots(self, model, warnings)
      type(reader_t), intent(in) :: self
      type(model_t), intent(in) :: model
      type(error_list_t), intent(inout) :: warnings
      type(token_t) :: limit
      integer :: card, i

      if (self%errors%count > 0) return
      do card = 1, self%deck%n_cards
         if (keyword_of(self, card) /= 'GAP CONDUCTANCE') cycle
         limit = parameter_of(self, card, 'TSOFT')
         if (.not. limit%last >= limit%first) limit = parameter_of(self, card, 'TMELT')
         if (limit%last >= limit%first) exit
      end do
      if (card > self%deck%n_cards) return
      if (.not. model%has_field(field_temperature)) then
         call warn(self, warnings, card, 'unwatched_spots', 'no spot is held against TSOFT or TMELT: the hottest'// &
            ' place is above its wires, and the model has no temperatures; give them by *INITIAL CONDITIONS,'// &
            ' TYPE=TEMPERATURE')
         return
      end if
      do i = 1, size(model%contact_pairs)
         associate (pair => model%contact_pairs(i))
            associate (heat => model%interactions(pair%interaction)%heat)
               if (.not. (heat%has_softening .or. heat%has_melting)) cycle
            end associate
            if (all_conduct_heat(pair%set_bar) .and. all_conduct_heat(pair%set)) cycle
            call warn(self, warnings, card, 'unwatched_spots', 'TSOFT and TMELT are held against the temperatures'// &
               ' of the wires, not of what a current makes of the spot, where a material has no *CONDUCTIVITY:'// &
               ' elements of '//model%element_sets(merge(pair%set, pair%set_bar, &
               all_conduct_heat(pair%set_bar)))%name)
            return
         end associate
      end do

   contains

      pure logical function all_conduct_heat(set)
         !> Element set
         integer, intent(in) :: set
         integer :: k

         associate (elements => model%element_sets(set)%members)
            all_conduct_heat = all([(allocated(model%materials(model%sections(model%element_section(elements(k))) &
               %material)%heat_conductivity), k=1, size(elements))])
         end associate
      end function all_conduct_heat

   end subroutine warn_about_spots

   subroutine warn(self, warnings, card, kind, words)
      type(reader_t), intent(in) :: self
      type(error_list_t), intent(inout) :: warnings
      !> Index of the card
      integer, intent(in) :: card
      !> Of the warning, and what it says
      character(len=*), intent(in) :: kind, words
      type(error_t) :: error

      error = self%deck%error_at(self%deck%cards(card)%name, words)
      error%is_warning = .true.
      error%kind = kind
      call warnings%add(error)
   end subroutine warn

   !> Nodes of no element do nothing; the user may have meant more elements.
   subroutine warn_about_spare_nodes(self, model, warnings)
      type(reader_t), intent(in) :: self
      type(model_t), intent(in) :: model
      type(error_list_t), intent(inout) :: warnings
      logical, allocatable :: spare(:)
      type(error_t) :: error
      character(len=12) :: number
      integer :: e, first

      if (self%errors%count > 0) return
      allocate (spare(model%n_nodes), source=.true.)
      ! what stands for motions of other nodes
      spare(n_nodes_of_deck(model) + 1:) = .false.
      spare(model%local_axes%node) = .false.
      do e = 1, model%n_elements
         spare(model%connectivity(:, e)) = .false.
      end do
      spare(model%rigid_bodies%reference_node) = .false.
      do first = 1, size(model%equations)
         spare(model%equations(first)%node) = .false.
      end do
      do first = 1, size(model%surfaces)
         if (model%surfaces(first)%node > 0) spare(model%surfaces(first)%node) = .false.
      end do
      if (.not. any(spare)) return
      first = findloc(spare, .true., 1)
      write (number, '(i0)') model%node_id(first)
      error = self%deck%error_at(self%deck%line_token(self%node_line(first)), 'node '//trim(number)// &
         ' belongs to no element')
      write (number, '(i0)') count(spare) - 1
      if (count(spare) > 1) error%message = error%message//', nor do '//trim(number)//' others'
      error%is_warning = .true.
      error%kind = 'spare_nodes'
      call warnings%add(error)
   end subroutine warn_about_spare_nodes

end module litz_deck_reader
