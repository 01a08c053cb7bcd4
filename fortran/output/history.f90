!> The history table: the quantities that *NODE PRINT, *EL PRINT, *ENERGY PRINT and *ELECTRODE PRINT ask for, over time.
!>
!> The columns are those of all steps together, each once, and every increment fills all of them.
module litz_history
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf, ieee_quiet_nan
   use litz_kinds, only: dp
   use litz_communicator, only: communicator_t
   use litz_errors, only: error_t, fail, exit_internal
   use litz_fields, only: first_slot, field_potential, field_temperature
   use litz_model, only: model_t, named_set_t, output_request_t, request_node, request_element, request_electrode, &
      request_energy
   use litz_quantities, only: on_points, on_cells
   use litz_result_quantities, only: wire_quantity_t, choose_results, list_wire_quantities
   use litz_state, only: state_t, energies_t
   use litz_text, only: to_text
   implicit none
   private
   public :: history_t

   !> What a column holds that is no quantity of litz_result_quantities
   integer, parameter :: electrode_voltage = -1, electrode_current = -2, electrode_resistance = -3, energy = -4

   !> Abaqus's names of the energies: external work, in the beams, in the contacts, heat of friction, damping, and what
   !> of these does not balance; and the work of temperatures, in models that have some
   character(len=*), parameter :: energy_names(8) = [character(len=6) :: 'ALLWK', 'ALLSE', 'ALLCCE', 'ALLFD', 'ALLSD', &
      'ETOTAL', 'ALLTW', 'ALLPD']

   type :: column_t
      character(len=:), allocatable :: name
      !> Place among `list_wire_quantities`, or `electrode_...`, or `energy`
      integer :: quantity = 0
      integer :: component = 1
      !> The mean of its members, and not their sum
      logical :: is_mean = .false.
      !> Node or element indices; electrodes: nodes of the positive and the negative one
      integer, allocatable :: members(:), members_2(:)
   end type column_t

   type :: history_t
      class(communicator_t), allocatable, private :: processes
      type(column_t), allocatable, private :: columns(:)
      !> What may be asked for, without values
      type(wire_quantity_t), allocatable, private :: quantities(:)
      integer, private :: n_columns = 0
      !> Of all elements [S]: round-off makes currents of about its product with the potential
      real(dp), private :: largest_conductance = 0
   contains
      procedure :: build => history_build
      procedure :: header => history_header
      procedure :: line => history_line
   end type history_t

contains

   !> Collects the columns that the steps ask for.
   subroutine history_build(self, processes, model, error)
      class(history_t), intent(inout) :: self
      class(communicator_t), intent(in) :: processes
      type(model_t), intent(in) :: model
      type(error_t), allocatable, intent(inout) :: error
      !> Columns of single nodes and elements that are there already, by quantity
      logical, allocatable :: seen(:, :)
      type(state_t) :: nothing
      integer :: i, j

      if (allocated(error)) return
      allocate (self%processes, source=processes)
      call choose_results(model, nothing)
      call list_wire_quantities(nothing, self%quantities)
      allocate (self%columns(16))
      self%n_columns = 0
      self%largest_conductance = processes%largest(largest_conductance(model))
      allocate (seen(max(model%n_nodes, model%n_elements), size(self%quantities)), source=.false.)
      if (.not. allocated(model%steps)) return
      do i = 1, size(model%steps)
         if (.not. allocated(model%steps(i)%requests)) cycle
         do j = 1, size(model%steps(i)%requests)
            call add_request(self, model, model%steps(i)%requests(j), seen, error)
         end do
      end do
   end subroutine history_build

   pure real(dp) function largest_conductance(model) result(largest)
      type(model_t), intent(in) :: model
      real(dp) :: length
      integer :: i

      largest = 0
      do i = 1, model%n_elements
         length = norm2(model%x(:, model%connectivity(2, i)) - model%x(:, model%connectivity(1, i)))
         associate (section => model%sections(model%element_section(i)))
            largest = max(largest, model%materials(section%material)%conductivity*section%area/length)
         end associate
      end do
   end function largest_conductance

   subroutine add_request(self, model, request, seen, error)
      type(history_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(output_request_t), intent(in) :: request
      !> Quantities that a member has a column of already (n_quantities, n_members)
      logical, intent(inout) :: seen(:, :)
      type(error_t), allocatable, intent(inout) :: error
      integer :: i

      select case (request%kind)
      case (request_electrode)
         call add_electrodes(self, model, request)
      case (request_energy)
         do i = 1, size(energy_names)
            if (energy_names(i) == 'ALLTW' .and. .not. model%has_field(field_temperature)) cycle
            if (energy_names(i) == 'ALLPD' .and. .not. any(model%interactions%normal%yield_stress > 0)) cycle
            call add_column(self, trim(energy_names(i))//' [J]', energy, i, .false., [integer ::])
         end do
      case (request_node, request_element)
         do i = 1, size(request%quantities)
            call add_quantity(self, model, request, request%quantities(i), seen, error)
         end do
      end select
   end subroutine add_request

   !> All that a word of the deck asks for.
   subroutine add_quantity(self, model, request, word, seen, error)
      type(history_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(output_request_t), intent(in) :: request
      !> As the deck writes it, such as `U` or `EPOT`
      character(len=*), intent(in) :: word
      !> Quantities that a member has a column of already (n_quantities, n_members)
      logical, intent(inout) :: seen(:, :)
      type(error_t), allocatable, intent(inout) :: error
      integer, allocatable :: these(:)
      integer :: q

      these = pack([(q, q=1, size(self%quantities))], self%quantities%request == word .and. &
         self%quantities%place == merge(on_points, on_cells, request%kind == request_node))
      if (size(these) == 0) then
         error = fail(exit_internal, 'the history has no quantity "'//trim(word)//'"')
      else if (request%totals) then
         call add_totals(self, model, request, these)
      else
         call add_members(self, model, request, these, seen)
      end if
   end subroutine add_quantity

   !> Voltage, current and resistance between two electrodes.
   subroutine add_electrodes(self, model, request)
      type(history_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(output_request_t), intent(in) :: request
      character(len=*), parameter :: names(3) = ['voltage   ', 'current   ', 'resistance']
      character(len=*), parameter :: units(3) = ['V  ', 'A  ', 'ohm']
      integer :: i

      associate (plus => model%node_sets(request%set), minus => model%node_sets(request%set_2))
         do i = 1, 3
            call add_column(self, trim(names(i))//' '//plus%name//' to '//minus%name//' ['//trim(units(i))//']', &
               electrode_voltage - i + 1, 1, .false., plus%members, minus%members)
         end do
      end associate
   end subroutine add_electrodes

   !> Sum or mean over a set.
   subroutine add_totals(self, model, request, these)
      type(history_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(output_request_t), intent(in) :: request
      !> Places of the quantities (n)
      integer, intent(in) :: these(:)
      type(named_set_t) :: set
      integer :: i, component

      set = set_of(model, request)
      do i = 1, size(these)
         associate (quantity => self%quantities(these(i)))
            do component = 1, quantity%components
               call add_column(self, column_name(quantity, component, trim(merge('sum ', 'mean', quantity%is_sum))// &
                  ' '//set%name), these(i), component, .not. quantity%is_sum, set%members)
            end do
         end associate
      end do
   end subroutine add_totals

   !> Every member of a set by itself.
   subroutine add_members(self, model, request, these, seen)
      type(history_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(output_request_t), intent(in) :: request
      !> Places of the quantities (n)
      integer, intent(in) :: these(:)
      !> Quantities that a member has a column of already (n_quantities, n_members)
      logical, intent(inout) :: seen(:, :)
      type(named_set_t) :: set
      character(len=:), allocatable :: who
      integer :: i, k, component

      set = set_of(model, request)
      do i = 1, size(set%members)
         if (seen(set%members(i), these(1))) cycle
         seen(set%members(i), these) = .true.
         if (request%kind == request_node) who = 'node '//to_text(model%node_id(set%members(i)))
         if (request%kind == request_element) who = 'element '//to_text(model%element_id(set%members(i)))
         do k = 1, size(these)
            do component = 1, self%quantities(these(k))%components
               call append_column(self, column_name(self%quantities(these(k)), component, who), these(k), component, &
                  .false., set%members(i:i))
            end do
         end do
      end do
   end subroutine add_members

   pure type(named_set_t) function set_of(model, request) result(set)
      type(model_t), intent(in) :: model
      type(output_request_t), intent(in) :: request

      if (request%kind == request_node) set = model%node_sets(request%set)
      if (request%kind == request_element) set = model%element_sets(request%set)
   end function set_of

   !> `U1 node 7 [m]`
   pure function column_name(quantity, component, of_whom) result(name)
      type(wire_quantity_t), intent(in) :: quantity
      !> Of the quantity, from 1
      integer, intent(in) :: component
      !> Number or name of the node, element or set
      character(len=*), intent(in) :: of_whom
      character(len=:), allocatable :: name

      name = trim(quantity%column)
      if (quantity%components > 1) name = name//to_text(component)
      name = name//' '//of_whom//' ['//trim(quantity%unit)//']'
   end function column_name

   !> Adds a column unless one of that name is there.
   subroutine add_column(self, name, quantity, component, is_mean, members, members_2)
      type(history_t), intent(inout) :: self
      !> Of the column
      character(len=*), intent(in) :: name
      !> As in `column_t`; nodes or elements (n)
      integer, intent(in) :: quantity, component, members(:)
      !> Of the members; else their sum
      logical, intent(in) :: is_mean
      !> Of the second set (n), where two are compared
      integer, intent(in), optional :: members_2(:)
      integer :: i

      do i = 1, self%n_columns
         if (self%columns(i)%name == name) return
      end do
      call append_column(self, name, quantity, component, is_mean, members, members_2)
   end subroutine add_column

   subroutine append_column(self, name, quantity, component, is_mean, members, members_2)
      type(history_t), intent(inout) :: self
      !> Of the column
      character(len=*), intent(in) :: name
      !> As in `column_t`; nodes or elements (n)
      integer, intent(in) :: quantity, component, members(:)
      !> Of the members; else their sum
      logical, intent(in) :: is_mean
      !> Of the second set (n), where two are compared
      integer, intent(in), optional :: members_2(:)
      type(column_t), allocatable :: grown(:)

      if (self%n_columns == size(self%columns)) then
         allocate (grown(2*self%n_columns))
         grown(:self%n_columns) = self%columns
         call move_alloc(grown, self%columns)
      end if
      self%n_columns = self%n_columns + 1
      associate (column => self%columns(self%n_columns))
         column%name = name
         column%quantity = quantity
         column%component = component
         column%is_mean = is_mean
         column%members = members
         if (present(members_2)) column%members_2 = members_2
      end associate
   end subroutine append_column

   function history_header(self) result(line)
      class(history_t), intent(in) :: self
      character(len=:), allocatable :: line
      integer :: i

      line = 'step,increment,time [s]'
      do i = 1, self%n_columns
         line = line//','//self%columns(i)%name
      end do
   end function history_header

   !> The row of an increment.
   function history_line(self, state) result(line)
      class(history_t), intent(in) :: self
      type(state_t), intent(in), target :: state
      character(len=:), allocatable :: line
      integer, parameter :: widest_number = 32
      character(len=widest_number*(self%n_columns + 3)) :: buffer
      type(wire_quantity_t), allocatable :: list(:)
      integer :: i

      call list_wire_quantities(state, list)
      write (buffer, '(*(g0, :, ","))') state%step, state%increment, state%time, &
         (column_value(self, self%columns(i), list, state), i=1, self%n_columns)
      line = trim(buffer)
   end function history_line

   real(dp) function column_value(self, column, list, state) result(value)
      type(history_t), intent(in) :: self
      type(column_t), intent(in) :: column
      !> The quantities of the state
      type(wire_quantity_t), intent(in) :: list(:)
      type(state_t), intent(in) :: state

      if (column%quantity == energy) then
         value = energy_value(state%energies, column%component)
      else if (column%quantity < 0) then
         value = electrode_value(self, column%quantity, column%members, column%members_2, state)
      else
         value = self%processes%sum(sum(list(column%quantity)%values(column%component, column%members)))
         if (column%is_mean) value = value/max(1, self%processes%sum(size(column%members)))
      end if
   end function column_value

   pure real(dp) function energy_value(energies, component) result(value)
      type(energies_t), intent(in) :: energies
      !> Index into `energy_names`
      integer, intent(in) :: component
      real(dp) :: values(8)

      values(:5) = [energies%work, energies%strain, energies%contact, energies%friction, energies%stabilization]
      values(7:8) = [energies%thermal, energies%yielding]
      values(6) = sum(values(2:5)) + values(8) - values(1) - values(7)
      value = values(component)
   end function energy_value

   !> Voltage of the positive against the negative electrode (means over their nodes), the current that enters the body
   !> at the positive one, and their quotient: positive for a passive body, infinite where there is no current. One
   !> that is round-off is none.
   real(dp) function electrode_value(self, quantity, plus, minus, state) result(value)
      class(history_t), intent(in) :: self
      !> Which one of an electrode pair, and the nodes of the positive and the negative set (n), (m)
      integer, intent(in) :: quantity, plus(:), minus(:)
      type(state_t), intent(in) :: state
      integer, parameter :: slot = first_slot(field_potential)
      real(dp) :: voltage, current

      associate (processes => self%processes)
         voltage = processes%sum(sum(state%value(slot, plus)))/processes%sum(size(plus)) &
            - processes%sum(sum(state%value(slot, minus)))/processes%sum(size(minus))
         current = processes%sum(sum(state%reaction(slot, plus) + state%load(slot, plus)))
         if (abs(current) <= 100*epsilon(value)*self%largest_conductance &
            *processes%largest(maxval(abs(state%value(slot, :))))) current = 0
      end associate
      select case (quantity)
      case (electrode_voltage)
         value = voltage
      case (electrode_current)
         value = current
      case default
         if (abs(current) > 0) then
            value = voltage/current
         else if (abs(voltage) > 0) then
            value = ieee_value(value, ieee_positive_inf)
         else
            value = ieee_value(value, ieee_quiet_nan)
         end if
      end select
   end function electrode_value

end module litz_history
