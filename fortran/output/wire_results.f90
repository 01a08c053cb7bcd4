!> The result file of the wires: which fields it holds, and how they come out of the state.
!>
!> The points are the current positions, so that the wires and the contacts of `litz_contact_ledger` lie on each other
!> without a filter; the reference positions are a field.
module litz_wire_results
   use litz_kinds, only: dp, pi
   use litz_errors, only: error_t
   use litz_model, only: model_t, section_t, named_set_t, n_nodes_of_deck, radius_at
   use litz_quantities, only: quantity_t, on_points, on_cells
   use litz_result_quantities, only: wire_quantity_t, choose_results, list_wire_quantities
   use litz_state, only: state_t
   use litz_surface_choices, only: surface_shapes
   use litz_text, only: to_text
   use litz_hdf5_files, only: hid_t, hdf5_create_group, hdf5_flush
   use litz_hdf5_attributes, only: hdf5_write_attribute, hdf5_write_text
   use litz_hdf5_rows, only: hdf5_rows_t, hdf5_real, hdf5_integer
   use litz_run_warnings, only: run_warnings_t
   use litz_warning_rows, only: warning_rows_t
   use litz_wire_chains, only: wire_chains_t, find_wire_chains
   use litz_vtkhdf_writer, only: vtkhdf_file_t, vtk_line
   implicit none
   private
   public :: wire_results_t, most_written_increments

   !> More steps than this make no difference to the layout of the file
   integer, parameter :: most_increments = 10000

   character(len=*), parameter :: unit_system = &
      'SI (m, N, s, V, A, W, rad), or the consistent set the deck is written in'
   character(len=*), parameter :: table_names(11) = [character(len=17) :: 'step', 'increment', 'iterations', 'time', &
      'step_time', 'time_increment', 'force_balance', 'moment_balance', 'current_balance', 'power_balance', &
      'penetration_ratio']

   type, extends(vtkhdf_file_t) :: wire_results_t
      !> A row per written increment, in the order of `table_names`
      type(hdf5_rows_t), private :: tables(size(table_names))
      !> Step and increment of each increment whose contacts are in the ledger
      type(hdf5_rows_t), private :: contact_increments
      type(warning_rows_t), private :: warnings
      !> The rigid surfaces
      type(hdf5_rows_t), allocatable, private :: surfaces(:)
   contains
      procedure :: open => wire_results_open
      procedure :: write => wire_results_write
      procedure :: note_contacts => wire_results_note_contacts
      procedure :: write_warnings => wire_results_write_warnings
   end type wire_results_t

contains

   !> Begins the file: the mesh, what does not change over time, and the deck.
   subroutine wire_results_open(self, model, path, error)
      class(wire_results_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Where the file will be once it is published
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error

      call self%create(path, n_nodes_of_deck(model), model%n_elements, most_written_increments(model), error)
      call self%write_cells(vtk_line, model%connectivity, n_nodes_of_deck(model), error)
      self%units = model%units
      call add_fields(self, model, error)
      call write_static_fields(self, model, error)
      call write_origin(self, model, error)
      call write_outlines(self%litz_group, model, error)
      call write_sets(self%litz_group, 'node_sets', model%node_sets, model%node_id, error)
      call write_sets(self%litz_group, 'element_sets', model%element_sets, model%element_id, error)
      call create_surfaces(self, model, error)
      call hdf5_flush(self%file, error)
   end subroutine wire_results_open

   !> The start, and the increments of all steps as often as they are written.
   pure integer function most_written_increments(model) result(n)
      type(model_t), intent(in) :: model
      integer :: i

      n = 1
      if (.not. allocated(model%steps)) return
      do i = 1, size(model%steps)
         associate (step => model%steps(i))
            n = n + min(most_increments, step%max_increments/step%output_frequency + 1)
         end associate
      end do
      n = min(n, most_increments)
   end function most_written_increments

   subroutine add_fields(file, model, error)
      class(vtkhdf_file_t), intent(inout) :: file
      type(model_t), intent(in) :: model
      type(error_t), allocatable, intent(inout) :: error
      type(state_t) :: nothing
      type(wire_quantity_t), allocatable :: list(:)
      integer :: i

      call choose_results(model, nothing)
      call list_wire_quantities(nothing, list)
      do i = 1, size(list)
         call file%add_field(list(i), merge(n_nodes_of_deck(model), model%n_elements, &
            list(i)%place == on_points), error)
      end do
   end subroutine add_fields

   !> What does not change over time.
   subroutine write_static_fields(file, model, error)
      class(vtkhdf_file_t), intent(inout) :: file
      type(model_t), intent(in) :: model
      type(error_t), allocatable, intent(inout) :: error
      type(wire_chains_t) :: chains
      integer :: i, n

      n = n_nodes_of_deck(model)
      call file%add_field(quantity_t('reference_position', 'm', 'position before any deformation', on_points, 3), &
         n, error)
      call file%write_field('reference_position', model%x(:, :n), error)
      call file%add_field(quantity_t('radius', 'm', &
         'radius that touches other wires; without one, that of a circle with the area of the section', on_cells), &
         model%n_elements, error)
      call file%write_field('radius', reshape([(drawn_radius(model%sections(model%element_section(i))), &
         i=1, model%n_elements)], [1, model%n_elements]), error)
      call add_numbers('node_id', 'number of the node in the deck', on_points, model%node_id(:n))
      call add_numbers('element_id', 'number of the element in the deck', on_cells, model%element_id)
      call add_numbers('section', 'number of the *BEAM SECTION in the deck, from 1', on_cells, model%element_section)
      call find_wire_chains(model%connectivity, model%n_nodes, chains)
      call add_numbers('wire', &
         'number of the wire, from 1: elements one after another between free ends and branches', on_cells, chains%wire)
      call add_numbers('place_in_wire', 'place of the element along its wire, from 1', on_cells, chains%place)
      call add_numbers('direction_in_wire', '1: the element runs along its wire, -1: against it', on_cells, &
         chains%direction)

   contains

      subroutine add_numbers(name, text, place, numbers)
         !> Of the field, and what it means
         character(len=*), intent(in) :: name, text
         !> `on_points` or `on_cells`, and a number for each of them (n)
         integer, intent(in) :: place, numbers(:)

         call file%add_field(quantity_t(name, '1', text, place, is_integer=.true.), size(numbers), error)
         call file%write_field(name, numbers, error)
      end subroutine add_numbers

   end subroutine write_static_fields

   pure real(dp) function drawn_radius(section)
      type(section_t), intent(in) :: section

      drawn_radius = section%contact_radius
      if (drawn_radius <= 0) drawn_radius = sqrt(section%area/pi)
   end function drawn_radius

   !> The group /litz: where the results come from, and the table of the increments.
   subroutine write_origin(self, model, error)
      class(wire_results_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(error_t), allocatable, intent(inout) :: error
      integer(hid_t) :: increments
      integer :: i

      associate (group => self%litz_group)
         call hdf5_write_attribute(group, 'unit_system', unit_system, error)
         call hdf5_write_attribute(group, 'heading', text_or_nothing(model%heading), error)
         call hdf5_write_text(group, 'deck', text_or_nothing(model%deck_text), error)
         call hdf5_create_group(group, 'increments', increments, error)
         call self%contact_increments%create(group, 'contact_increments', 2, hdf5_integer, 1, error)
         call self%warnings%create(self%file, group, error)
      end associate
      do i = 1, size(table_names)
         call self%tables(i)%create(increments, trim(table_names(i)), 1, &
            merge(hdf5_integer, hdf5_real, i <= 3), 1, error)
         call hdf5_write_attribute(self%tables(i)%dataset, 'unit', merge('s', '1', i > 3 .and. i <= 6), error)
      end do
   end subroutine write_origin

   !> Sets as datasets of the user's numbers, by their names.
   subroutine write_sets(parent, name, sets, ids, error)
      !> Identifier of the group that they are written into
      integer(hid_t), intent(in) :: parent
      !> Of the group of sets
      character(len=*), intent(in) :: name
      type(named_set_t), allocatable, intent(in) :: sets(:)
      !> The user's numbers of all nodes or elements (n)
      integer, intent(in) :: ids(:)
      type(error_t), allocatable, intent(inout) :: error
      integer(hid_t) :: group
      type(hdf5_rows_t) :: rows
      integer :: i, n

      call hdf5_create_group(parent, name, group, error)
      if (.not. allocated(sets)) return
      do i = 1, size(sets)
         n = size(sets(i)%members)
         call rows%create(group, link_name(sets(i)%name), 1, hdf5_integer, n, error)
         call rows%append(reshape(int(ids(sets(i)%members), kind(rows%n_rows)), [1, n]), error)
      end do
   end subroutine write_sets

   !> Outlines of sections that are not round, by the numbers of the sections: corners along the section axes from the
   !> node, and the approximate direction of the first one.
   subroutine write_outlines(parent, model, error)
      !> Identifier of the group that they are written into
      integer(hid_t), intent(in) :: parent
      type(model_t), intent(in) :: model
      type(error_t), allocatable, intent(inout) :: error
      integer(hid_t) :: outlines, axes
      type(hdf5_rows_t) :: rows
      integer :: i, n

      if (.not. any([(allocated(model%sections(i)%corners), i=1, size(model%sections))])) return
      call hdf5_create_group(parent, 'outlines', outlines, error)
      call hdf5_create_group(parent, 'first_axes', axes, error)
      do i = 1, size(model%sections)
         associate (this => model%sections(i))
            if (.not. allocated(this%corners)) cycle
            n = size(this%corners, 2)
            call rows%create(outlines, to_text(i), 2, hdf5_real, n, error)
            call rows%append(this%corners + spread(this%shear_centre + this%centroid, 2, n), error)
            call rows%create(axes, to_text(i), 3, hdf5_real, 1, error)
            call rows%append(reshape(this%n1, [3, 1]), error)
         end associate
      end do
   end subroutine write_outlines

   !> The rigid surfaces by their names, where there are some: point, direction and radius before any deformation, total
   !> time 0, with shape and reference node.
   subroutine create_surfaces(self, model, error)
      class(wire_results_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(error_t), allocatable, intent(inout) :: error
      integer(hid_t) :: group
      integer :: i

      if (allocated(self%surfaces)) deallocate (self%surfaces)
      allocate (self%surfaces(0))
      if (.not. allocated(model%surfaces)) return
      if (size(model%surfaces) == 0) return
      call hdf5_create_group(self%litz_group, 'rigid_surfaces', group, error)
      deallocate (self%surfaces)
      allocate (self%surfaces(size(model%surfaces)))
      do i = 1, size(model%surfaces)
         associate (this => model%surfaces(i), rows => self%surfaces(i))
            call rows%create(group, link_name(this%name), 8, hdf5_real, 1, error)
            call append_surface(self, model, i, radius_at(model, i, 0.0_dp), 0.0_dp, error)
            call hdf5_write_attribute(rows%dataset, 'type', trim(surface_shapes(this%shape)), error)
            ! 0: it is fixed in space
            call hdf5_write_attribute(rows%dataset, 'reference_node', number_of_node(model, this%node), error)
         end associate
      end do
   end subroutine create_surfaces

   !> A row of a surface.
   subroutine append_surface(self, model, i, radius, time, error)
      class(wire_results_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the surface
      integer, intent(in) :: i
      !> Radius [m] at the total time [s]
      real(dp), intent(in) :: radius, time
      type(error_t), allocatable, intent(inout) :: error

      associate (this => model%surfaces(i))
         call self%surfaces(i)%append(reshape([this%point, this%direction, radius, time], [8, 1]), error)
      end associate
   end subroutine append_surface

   !> The user's number of a node; 0 for none.
   pure integer function number_of_node(model, node) result(number)
      type(model_t), intent(in) :: model
      !> Index, or 0
      integer, intent(in) :: node

      number = 0
      if (node > 0) number = model%node_id(node)
   end function number_of_node

   !> A slash would open a group inside HDF5.
   pure function link_name(name) result(link)
      !> Of a set
      character(len=*), intent(in) :: name
      character(len=len(name)) :: link
      integer :: i

      link = name
      do i = 1, len(name)
         if (name(i:i) == '/') link(i:i) = '|'
      end do
   end function link_name

   pure function text_or_nothing(text) result(copy)
      !> Not allocated: there is none
      character(len=:), allocatable, intent(in) :: text
      character(len=:), allocatable :: copy

      copy = ''
      if (allocated(text)) copy = text
   end function text_or_nothing

   !> Adds an increment.
   subroutine wire_results_write(self, model, state, error)
      class(wire_results_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(state_t), intent(in), target :: state
      type(error_t), allocatable, intent(inout) :: error
      type(wire_quantity_t), allocatable :: list(:)
      integer :: i, n

      n = n_nodes_of_deck(model)
      call self%write_points(model%x(:, :n) + state%value(1:3, :n), error)
      call list_wire_quantities(state, list)
      do i = 1, size(list)
         associate (last => merge(n, model%n_elements, list(i)%place == on_points))
            call self%write_field(list(i)%name, list(i)%values(:, :last), error)
         end associate
      end do
      do i = 1, size(self%surfaces)
         if (model%surfaces(i)%radius_amplitude == 0 .or. .not. state%time > 0) cycle
         call append_surface(self, model, i, state%surface_radius(i), state%time, error)
      end do
      call write_tables(self, state, error)
      call self%end_step(state%time, error)
   end subroutine wire_results_write

   !> The contacts of this increment are in the ledger.
   subroutine wire_results_note_contacts(self, state, error)
      class(wire_results_t), intent(inout) :: self
      type(state_t), intent(in) :: state
      type(error_t), allocatable, intent(inout) :: error

      call self%contact_increments%append(reshape(int([state%step, state%increment], &
         kind(self%contact_increments%n_rows)), [2, 1]), error)
      call hdf5_flush(self%file, error)
   end subroutine wire_results_note_contacts

   !> Brings the list of warnings up to date.
   subroutine wire_results_write_warnings(self, warnings, error)
      class(wire_results_t), intent(inout) :: self
      type(run_warnings_t), intent(in) :: warnings
      type(error_t), allocatable, intent(inout) :: error

      call self%warnings%write(warnings, error)
   end subroutine wire_results_write_warnings

   subroutine write_tables(self, state, error)
      class(wire_results_t), intent(inout) :: self
      type(state_t), intent(in) :: state
      type(error_t), allocatable, intent(inout) :: error
      integer :: counts(3), i
      real(dp) :: reals(size(table_names) - 3)

      counts = [state%step, state%increment, state%iterations]
      reals = [state%time, state%step_time, state%time_increment, state%audit]
      do i = 1, size(counts)
         call self%tables(i)%append(int(counts(i), kind(self%tables(i)%n_rows)), error)
      end do
      do i = 1, size(reals)
         call self%tables(size(counts) + i)%append(reshape(reals(i:i), [1, 1]), error)
      end do
   end subroutine write_tables

end module litz_wire_results
