!> *MATERIAL and *AMPLITUDE with what belongs to them.
module litz_read_properties
   use litz_kinds, only: dp
   use litz_critical_law, only: superconductor_t
   use litz_text, only: to_text
   use litz_deck, only: token_t
   use litz_model, only: model_t
   use litz_reader, only: reader_t, definitions_t, fail_at, parameter_of, choice_of, keyword_of, real_parameter, &
      n_cards_of, may_be_used
   use litz_data_lines, only: read_line, read_only_line
   use litz_definitions, only: add_definition
   use litz_read_superconductor, only: read_superconductor
   implicit none
   private
   public :: read_materials, read_amplitudes, report_unused

contains

   subroutine read_materials(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      real(dp), allocatable :: table(:, :)
      type(superconductor_t) :: superconductor
      integer :: card, material, i
      logical :: ok

      allocate (model%materials(n_cards_of(self, 'MATERIAL')))
      material = 0
      do card = 1, self%deck%n_cards
         select case (keyword_of(self, card))
         case ('MATERIAL')
            call add_named(self, self%materials, 'material', card, material)
            if (material > 0) model%materials(material)%name = self%materials%names%name(material)
         case ('ELASTIC')
            call read_property(self, card, 2, table, ok)
            if (material == 0) cycle
            associate (this => model%materials(material))
               if (this%young > 0) call fail_at(self, self%deck%cards(card)%name, &
                  'the material '//this%name//' has two *ELASTIC')
               ! wrong values were reported; the material then counts as complete
               this%young = table(2, 1)
               this%poisson = table(3, 1)
               if (size(table, 2) > 1) this%elastic_table = table
            end associate
         case ('ELECTRICAL CONDUCTIVITY')
            call read_property(self, card, 1, table, ok)
            if (material == 0) cycle
            associate (this => model%materials(material))
               if (this%conductivity > 0) call fail_at(self, self%deck%cards(card)%name, &
                  'the material '//this%name//' has two *ELECTRICAL CONDUCTIVITY')
               this%conductivity = table(2, 1)
               table(2, :) = 1/table(2, :)
               this%resistivity = table
            end associate
         case ('EXPANSION')
            call read_property(self, card, 1, table, ok)
            if (material == 0) cycle
            associate (this => model%materials(material))
               if (allocated(this%expansion_table)) call fail_at(self, self%deck%cards(card)%name, &
                  'the material '//this%name//' has two *EXPANSION')
               this%expansion_table = table
               this%expansion_zero = real_parameter(self, card, 'ZERO', 0.0_dp)
            end associate
         case ('CONDUCTIVITY')
            call read_property(self, card, 1, table, ok)
            if (material == 0) cycle
            associate (this => model%materials(material))
               if (allocated(this%heat_conductivity)) call fail_at(self, self%deck%cards(card)%name, &
                  'the material '//this%name//' has two *CONDUCTIVITY')
               this%heat_conductivity = table
            end associate
         case ('DENSITY', 'SPECIFIC HEAT', 'LATENT HEAT')
            call read_storage(self, model, card, material)
         case ('SUPERCONDUCTOR')
            call read_superconductor(self, card, superconductor)
            if (material == 0) cycle
            associate (this => model%materials(material))
               if (allocated(this%superconductor)) call fail_at(self, self%deck%cards(card)%name, &
                  'the material '//this%name//' has two *SUPERCONDUCTOR')
               this%superconductor = superconductor
            end associate
         case ('JOULE HEAT FRACTION')
            call read_only_line(self, card, ok)
            if (.not. ok .or. material == 0) cycle
            model%materials(material)%joule_fraction = self%values%real(1)
            if (self%values%real(1) > 1) call fail_at(self, self%values%token(1), &
               'the part of the electric power that becomes heat cannot be more than 1; found '// &
               to_text(self%values%real(1)))
         end select
      end do
      model%materials = model%materials(:self%materials%names%n)
      do i = 1, size(model%materials)
         if (allocated(model%materials(i)%superconductor) .and. .not. model%materials(i)%conductivity > 0) then
            call fail_at(self, self%materials%token(i), 'the material '//model%materials(i)%name// &
               ' has *SUPERCONDUCTOR, but no *ELECTRICAL CONDUCTIVITY of the metal around it')
         end if
         if (model%materials(i)%young > 0) cycle
         call fail_at(self, self%materials%token(i), 'the material '//model%materials(i)%name//' has no *ELASTIC')
      end do
   end subroutine read_materials

   !> What says how much heat a material stores.
   subroutine read_storage(self, model, card, material)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      !> Index of the card, and of the material (0: in error)
      integer, intent(in) :: card, material
      real(dp), allocatable :: table(:, :)
      logical :: ok, twice

      select case (keyword_of(self, card))
      case ('DENSITY')
         call read_only_line(self, card, ok)
         table = reshape([merge(self%values%real(1), 1.0_dp, ok)], [1, 1])
      case ('SPECIFIC HEAT')
         call read_property(self, card, 1, table, ok)
      case ('LATENT HEAT')
         call read_latent_heat(self, card, table)
      end select
      if (material == 0) return
      associate (this => model%materials(material))
         select case (keyword_of(self, card))
         case ('DENSITY')
            twice = this%density > 0
            this%density = table(1, 1)
         case ('SPECIFIC HEAT')
            twice = allocated(this%specific_heat)
            this%specific_heat = table
         case default
            twice = allocated(this%latent_heat)
            this%latent_heat = table
         end select
         if (twice) call fail_at(self, self%deck%cards(card)%name, 'the material '//this%name//' has two *'// &
            keyword_of(self, card))
      end associate
   end subroutine read_storage

   !> Heats, and the temperatures between which each is taken up (3, n); ascending.
   subroutine read_latent_heat(self, card, table)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> Heats [J/kg], solidus and liquidus temperatures [K] (3, n)
      real(dp), allocatable, intent(out) :: table(:, :)
      integer :: line
      logical :: ok
      real(dp) :: last

      allocate (table(3, 0))
      do line = self%deck%cards(card)%first_data, self%deck%cards(card)%last_data
         call read_line(self, card, line, ok)
         if (.not. ok) cycle
         associate (values => self%values%real)
            last = -huge(last)
            if (size(table, 2) > 0) last = table(3, size(table, 2))
            if (values(3) <= values(2)) then
               call fail_at(self, self%values%token(3), 'the liquidus must be above the solidus; '// &
                  to_text(values(3))//' follows '//to_text(values(2)))
            else if (values(2) < last) then
               call fail_at(self, self%values%token(2), 'changes of phase must ascend; '//to_text(values(2))// &
                  ' is below the liquidus of the one before, '//to_text(last))
            else
               table = reshape([table, values(:3)], [3, size(table, 2) + 1])
            end if
         end associate
      end do
   end subroutine read_latent_heat

   !> Properties over temperature, on lines of their values and the temperature.
   subroutine read_property(self, card, n_values, table, ok)
      type(reader_t), intent(inout) :: self
      !> Index of the card, and values before the temperature
      integer, intent(in) :: card, n_values
      !> Temperatures and values (1 + n_values, n), one line at least
      real(dp), allocatable, intent(out) :: table(:, :)
      !> .false.: something was reported; the table is then one that does no harm
      logical, intent(out) :: ok
      integer :: line
      logical :: line_ok

      ok = .true.
      allocate (table(1 + n_values, 0))
      associate (this => self%deck%cards(card), values => self%values, at => n_values + 1)
         do line = this%first_data, this%last_data
            call read_line(self, card, line, line_ok)
            ok = ok .and. line_ok
            if (.not. line_ok) cycle
            if (.not. values%given(at) .and. this%last_data > this%first_data) then
               if (ok) call fail_at(self, values%token(at), 'a temperature is missing: every line of a table has one')
               ok = .false.
            else if (size(table, 2) > 0) then
               if (values%real(at) <= table(1, size(table, 2))) then
                  call fail_at(self, values%token(at), 'the temperatures of *'//keyword_of(self, card)// &
                     ' must ascend; '//to_text(values%real(at))//' follows '//to_text(table(1, size(table, 2))))
                  ok = .false.
               end if
            end if
            table = reshape([table, values%real(at), values%real(:n_values)], [at, size(table, 2) + 1])
         end do
      end associate
      ok = ok .and. size(table, 2) > 0
      if (.not. ok) table = reshape([0.0_dp, 1.0_dp, spread(0.0_dp, 1, n_values - 1)], [1 + n_values, 1])
   end subroutine read_property

   !> The name a card defines; 0 where it has none or it exists already.
   subroutine add_named(self, definitions, what, card, index)
      type(reader_t), intent(inout) :: self
      type(definitions_t), intent(inout) :: definitions
      !> What is defined, as messages name it
      character(len=*), intent(in) :: what
      !> Index of the card
      integer, intent(in) :: card
      !> Index of the definition
      integer, intent(out) :: index
      type(token_t) :: token

      index = 0
      token = parameter_of(self, card, 'NAME')
      if (token%last >= token%first) call add_definition(self, definitions, what, token, index)
   end subroutine add_named

   subroutine read_amplitudes(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      integer :: card, amplitude

      allocate (model%amplitudes(n_cards_of(self, 'AMPLITUDE')))
      do card = 1, self%deck%n_cards
         if (keyword_of(self, card) /= 'AMPLITUDE') cycle
         call add_named(self, self%amplitudes, 'amplitude', card, amplitude)
         if (amplitude == 0) cycle
         model%amplitudes(amplitude)%name = self%amplitudes%names%name(amplitude)
         model%amplitudes(amplitude)%total_time = choice_of(self, card, 'TIME') == 'TOTALTIME'
         call read_points(self, card, model%amplitudes(amplitude)%time, model%amplitudes(amplitude)%factor)
      end do
      model%amplitudes = model%amplitudes(:self%amplitudes%names%n)
   end subroutine read_amplitudes

   !> The pairs of all data lines, with ascending times.
   subroutine read_points(self, card, time, factor)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      !> Times (n) [s], ascending
      real(dp), allocatable, intent(out) :: time(:)
      !> Factors at these times (n)
      real(dp), allocatable, intent(out) :: factor(:)
      integer :: line, i, n
      logical :: ok

      associate (this => self%deck%cards(card))
         allocate (time(4*max(1, this%last_data - this%first_data + 1)), factor(4*max(1, &
            this%last_data - this%first_data + 1)))
         n = 0
         do line = this%first_data, this%last_data
            call read_line(self, card, line, ok)
            if (.not. ok) cycle
            do i = 1, self%values%n - 1, 2
               if (n > 0) then
                  if (self%values%real(i) <= time(n)) call fail_at(self, self%values%token(i), &
                     'the times of an amplitude must ascend; '//to_text(self%values%real(i))//' follows '// &
                     to_text(time(n)))
               end if
               n = n + 1
               time(n) = self%values%real(i)
               factor(n) = self%values%real(i + 1)
            end do
         end do
      end associate
      time = time(:n)
      factor = factor(:n)
   end subroutine read_points

   !> A definition that nothing refers to is most often a misspelled reference.
   subroutine report_unused(self, definitions, what)
      type(reader_t), intent(inout) :: self
      type(definitions_t), intent(in) :: definitions
      !> What is defined, as messages name it
      character(len=*), intent(in) :: what
      integer :: i

      if (definitions%missed) return
      do i = 1, definitions%names%n
         if (definitions%used(i) .or. may_be_used(self, definitions%names%name(i))) cycle
         call fail_at(self, definitions%token(i), 'the '//what//' '//definitions%names%name(i)// &
            ' is defined but never used; use it or remove it')
      end do
   end subroutine report_unused

end module litz_read_properties
