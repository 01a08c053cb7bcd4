!> The history table: the quantities that *NODE PRINT, *EL PRINT, *ENERGY PRINT and *ELECTRODE PRINT ask for, over time.
!>
!> The columns are those of all steps together, each once, and every increment fills all of them.
module litz_history
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf, ieee_quiet_nan
   use litz_kinds, only: dp
   use litz_errors, only: error_t, fail, exit_internal
   use litz_model, only: model_t, output_request_t, request_node, request_element, request_electrode, &
      request_energy
   use litz_state, only: state_t, energies_t
   implicit none
   private
   public :: history_t

   !> How the members of a column become one number
   integer, parameter :: the_one = 1, the_sum = 2, the_mean = 3

   !> What a column holds; the order is that of `quantities`, then the three of electrodes
   integer, parameter :: quantity_u = 1, quantity_ur = 2, quantity_rf = 3, quantity_rm = 4, quantity_cf = 5, &
      quantity_cm = 6, quantity_epot = 7, quantity_rcurr = 8, quantity_cecur = 9, quantity_sf = 10, quantity_epg = 11, &
      quantity_joule = 12, electrode_voltage = 13, electrode_current = 14, electrode_resistance = 15, &
      quantity_energy = 16

   !> A quantity that a deck may ask for.
   type :: quantity_t
      character(len=8) :: keyword
      integer :: kind, components
      character(len=4) :: unit
      !> Totals over a set are sums; of the others they are means
      logical :: is_extensive
   end type quantity_t

   type(quantity_t), parameter :: quantities(12) = [ &
      quantity_t('U', request_node, 3, 'm', .false.), quantity_t('UR', request_node, 3, 'rad', .false.), &
      quantity_t('RF', request_node, 3, 'N', .true.), quantity_t('RM', request_node, 3, 'N m', .true.), &
      quantity_t('CF', request_node, 3, 'N', .true.), quantity_t('CM', request_node, 3, 'N m', .true.), &
      quantity_t('EPOT', request_node, 1, 'V', .false.), quantity_t('RCURR', request_node, 1, 'A', .true.), &
      quantity_t('CECUR', request_node, 1, 'A', .true.), quantity_t('SF', request_element, 6, 'N', .false.), &
      quantity_t('EPG', request_element, 1, 'A', .false.), quantity_t('JOULE', request_element, 1, 'W', .true.)]

   character(len=*), parameter :: section_force_names(6) = ['N ', 'Q2', 'Q3', 'T ', 'M2', 'M3']

   !> Abaqus's names of the energies: external work, in the beams, in the contacts, heat of friction, and what of these
   !> does not balance
   character(len=*), parameter :: energy_names(6) = [character(len=6) :: 'ALLWK', 'ALLSE', 'ALLCCE', 'ALLFD', 'ALLSD', &
      'ETOTAL']

   type :: column_t
      character(len=:), allocatable :: name
      integer :: quantity = 0, component = 1, reduction = the_one
      !> Node or element indices; electrodes: nodes of the positive and the negative one
      integer, allocatable :: members(:), members_2(:)
   end type column_t

   type :: history_t
      type(column_t), allocatable, private :: columns(:)
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
   subroutine history_build(self, model, error)
      class(history_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(error_t), allocatable, intent(inout) :: error
      !> Columns of single nodes and elements that are there already, by quantity
      logical :: seen(max(model%n_nodes, model%n_elements), size(quantities))
      integer :: i, j

      if (allocated(error)) return
      allocate (self%columns(16))
      self%n_columns = 0
      self%largest_conductance = largest_conductance(model)
      seen = .false.
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
      logical, intent(inout) :: seen(:, :)
      type(error_t), allocatable, intent(inout) :: error
      integer :: i, q

      select case (request%kind)
      case (request_electrode)
         call add_electrodes(self, model, request)
      case (request_energy)
         do i = 1, size(energy_names)
            call add_column(self, trim(energy_names(i))//' [J]', quantity_energy, i, the_one, [integer ::])
         end do
      case (request_node, request_element)
         do i = 1, size(request%quantities)
            q = quantity_index(request%quantities(i), request%kind)
            if (q == 0) then
               error = fail(exit_internal, 'the history has no quantity "'//trim(request%quantities(i))//'"')
               return
            end if
            if (request%totals) then
               call add_totals(self, model, request, q)
            else
               call add_members(self, model, request, q, seen(:, q))
            end if
         end do
      end select
   end subroutine add_request

   pure integer function quantity_index(keyword, kind) result(q)
      character(len=*), intent(in) :: keyword
      integer, intent(in) :: kind

      do q = 1, size(quantities)
         if (quantities(q)%keyword == keyword .and. quantities(q)%kind == kind) return
      end do
      q = 0
   end function quantity_index

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
               electrode_voltage + i - 1, 1, the_one, plus%members, minus%members)
         end do
      end associate
   end subroutine add_electrodes

   !> Sum or mean over a set.
   subroutine add_totals(self, model, request, q)
      type(history_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(output_request_t), intent(in) :: request
      integer, intent(in) :: q
      character(len=:), allocatable :: set_name
      integer, allocatable :: members(:)
      integer :: component, reduction

      if (request%kind == request_node) then
         set_name = model%node_sets(request%set)%name
         members = model%node_sets(request%set)%members
      else
         set_name = model%element_sets(request%set)%name
         members = model%element_sets(request%set)%members
      end if
      reduction = merge(the_sum, the_mean, quantities(q)%is_extensive)
      do component = 1, quantities(q)%components
         call add_column(self, component_name(q, component)//trim(merge(' sum  ', ' mean ', &
            quantities(q)%is_extensive))//' '//set_name//' ['//component_unit(q, component)//']', &
            q, component, reduction, members)
      end do
   end subroutine add_totals

   !> Every member of a set by itself.
   subroutine add_members(self, model, request, q, seen)
      type(history_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(output_request_t), intent(in) :: request
      integer, intent(in) :: q
      logical, intent(inout) :: seen(:)
      integer, allocatable :: members(:)
      character(len=32) :: who
      integer :: i, component

      if (request%kind == request_node) then
         members = model%node_sets(request%set)%members
      else
         members = model%element_sets(request%set)%members
      end if
      do i = 1, size(members)
         if (seen(members(i))) cycle
         seen(members(i)) = .true.
         if (request%kind == request_node) write (who, '(a, i0)') ' node ', model%node_id(members(i))
         if (request%kind == request_element) write (who, '(a, i0)') ' element ', model%element_id(members(i))
         do component = 1, quantities(q)%components
            call append_column(self, component_name(q, component)//trim(who)//' ['//component_unit(q, component)//']', &
               q, component, the_one, members(i:i))
         end do
      end do
   end subroutine add_members

   pure function component_name(q, component) result(name)
      integer, intent(in) :: q, component
      character(len=:), allocatable :: name
      character(len=1) :: number

      if (q == quantity_sf) then
         name = trim(section_force_names(component))
      else if (quantities(q)%components == 1) then
         name = trim(quantities(q)%keyword)
         if (q == quantity_epg) name = 'current'
      else
         write (number, '(i1)') component
         name = trim(quantities(q)%keyword)//number
      end if
   end function component_name

   pure function component_unit(q, component) result(unit)
      integer, intent(in) :: q, component
      character(len=:), allocatable :: unit

      unit = trim(quantities(q)%unit)
      if (q == quantity_sf .and. component > 3) unit = 'N m'
   end function component_unit

   !> Adds a column unless one of that name is there.
   subroutine add_column(self, name, quantity, component, reduction, members, members_2)
      type(history_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      !> As in `column_t`
      integer, intent(in) :: quantity, component, reduction, members(:)
      integer, intent(in), optional :: members_2(:)
      integer :: i

      do i = 1, self%n_columns
         if (self%columns(i)%name == name) return
      end do
      call append_column(self, name, quantity, component, reduction, members, members_2)
   end subroutine add_column

   subroutine append_column(self, name, quantity, component, reduction, members, members_2)
      type(history_t), intent(inout) :: self
      character(len=*), intent(in) :: name
      !> As in `column_t`
      integer, intent(in) :: quantity, component, reduction, members(:)
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
         column%reduction = reduction
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
      type(state_t), intent(in) :: state
      character(len=:), allocatable :: line
      integer, parameter :: widest_number = 32
      character(len=widest_number*(self%n_columns + 3)) :: buffer
      integer :: i

      write (buffer, '(*(g0, :, ","))') state%step, state%increment, state%time, &
         (column_value(self, self%columns(i), state), i=1, self%n_columns)
      line = trim(buffer)
   end function history_line

   pure real(dp) function column_value(self, column, state) result(value)
      class(history_t), intent(in) :: self
      type(column_t), intent(in) :: column
      type(state_t), intent(in) :: state
      integer :: i

      if (column%quantity == quantity_energy) then
         value = energy_value(state%energies, column%component)
         return
      end if
      if (column%quantity >= electrode_voltage) then
         value = electrode_value(self, column%quantity, column%members, column%members_2, state)
         return
      end if
      value = 0
      do i = 1, size(column%members)
         value = value + member_value(column%quantity, column%component, column%members(i), state)
      end do
      if (column%reduction == the_mean) value = value/max(1, size(column%members))
   end function column_value

   pure real(dp) function member_value(quantity, component, member, state) result(value)
      integer, intent(in) :: quantity, component, member
      type(state_t), intent(in) :: state

      value = 0
      select case (quantity)
      case (quantity_u)
         value = state%value(component, member)
      case (quantity_ur)
         value = state%value(3 + component, member)
      case (quantity_rf)
         value = state%reaction(component, member)
      case (quantity_rm)
         value = state%reaction(3 + component, member)
      case (quantity_cf)
         value = state%load(component, member)
      case (quantity_cm)
         value = state%load(3 + component, member)
      case (quantity_epot)
         value = state%value(7, member)
      case (quantity_rcurr)
         value = state%reaction(7, member)
      case (quantity_cecur)
         value = state%load(7, member)
      case (quantity_sf)
         value = state%section_forces(component, member)
      case (quantity_epg)
         value = state%element_current(member)
      case (quantity_joule)
         value = state%joule_heat(member)
      end select
   end function member_value

   pure real(dp) function energy_value(energies, component) result(value)
      type(energies_t), intent(in) :: energies
      !> Index into `energy_names`
      integer, intent(in) :: component
      real(dp) :: values(5)

      values = [energies%work, energies%strain, energies%contact, energies%friction, energies%stabilization]
      if (component <= size(values)) then
         value = values(component)
      else
         value = sum(values(2:)) - values(1)
      end if
   end function energy_value

   !> Voltage of the positive against the negative electrode (means over their nodes), the current that enters the body
   !> at the positive one, and their quotient: positive for a passive body, infinite where there is no current but
   !> that of round-off.
   pure real(dp) function electrode_value(self, quantity, plus, minus, state) result(value)
      class(history_t), intent(in) :: self
      integer, intent(in) :: quantity, plus(:), minus(:)
      type(state_t), intent(in) :: state
      real(dp) :: voltage, current, round_off

      voltage = sum(state%value(7, plus))/size(plus) - sum(state%value(7, minus))/size(minus)
      current = sum(state%reaction(7, plus) + state%load(7, plus))
      select case (quantity)
      case (electrode_voltage)
         value = voltage
      case (electrode_current)
         value = current
      case default
         round_off = 100*epsilon(value)*self%largest_conductance*maxval(abs(state%value(7, :)))
         if (abs(current) > round_off) then
            value = voltage/current
         else if (abs(voltage) > 0) then
            value = ieee_value(value, ieee_positive_inf)
         else
            value = ieee_value(value, ieee_quiet_nan)
         end if
      end select
   end function electrode_value

end module litz_history
