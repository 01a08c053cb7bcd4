!> The contact ledger: one row per contact and increment, as a table and as points that ParaView shows.
module litz_contact_ledger
   use litz_kinds, only: dp
   use litz_errors, only: error_t
   use litz_model, only: model_t
   use litz_state, only: state_t, contact_t
   use litz_version, only: version
   use litz_output_files, only: text_file_t
   use litz_hdf5_files, only: hid_t, hdf5_create_group
   use litz_hdf5_attributes, only: hdf5_write_attribute
   use litz_vtkhdf_writer, only: vtkhdf_file_t, on_points, vtk_vertex
   use litz_wire_results, only: format_version, most_written_increments
   implicit none
   private
   public :: contact_ledger_t

   character(len=*), parameter :: header = &
      'step,increment,time [s],id,element_bar,element,xi_bar,xi,angle [rad],gap [m],'// &
      'force [N],normal_x,normal_y,normal_z,point_bar_x [m],point_bar_y [m],point_bar_z [m],'// &
      'point_x [m],point_y [m],point_z [m],semi_major [m],semi_minor [m],resistance [ohm],current [A],'// &
      'voltage_gap [V],joule_heat [W],traction_x [N],traction_y [N],traction_z [N],slip_path [m],'// &
      'dissipation [J],friction,status'

   !> Values of the column `friction`, by `friction_...` of litz_friction_law
   character(len=*), parameter :: friction_names(0:2) = [character(len=5) :: 'none', 'stick', 'slip']
   !> Values of the column `status`: not there in the last increment | with the same elements as then | now with others
   character(len=*), parameter :: status_new = 'new', status_active = 'active', status_moved = 'moved'

   type :: contact_ledger_t
      type(text_file_t), private :: table
      type(vtkhdf_file_t), private :: file
      integer(hid_t), private :: litz_group = -1
      !> Elements (barred, unbarred) of the contacts of the last increment, by the contact's id; 0 0: not there
      integer, allocatable, private :: last_elements(:, :)
   contains
      procedure :: open => ledger_open
      procedure :: write_table => ledger_write_table
      procedure :: write_points => ledger_write_points
      procedure :: publish => ledger_publish
      procedure :: close => ledger_close
   end type contact_ledger_t

contains

   subroutine ledger_open(self, model, state, table_path, points_path, error)
      class(contact_ledger_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Where the run starts: its contacts are not new
      type(state_t), intent(in) :: state
      !> The .csv and the .vtkhdf file
      character(len=*), intent(in) :: table_path, points_path
      type(error_t), allocatable, intent(inout) :: error

      if (allocated(error)) return
      allocate (self%last_elements(2, 0))
      if (allocated(state%contacts)) call remember(state%contacts, self%last_elements)
      call self%table%create(table_path, error)
      call self%table%write_line(model%units%in_header(header), error)
      call self%table%flush(error)
      call self%file%create(points_path, 1, 1, most_written_increments(model), error)
      call hdf5_create_group(self%file%file, 'litz', self%litz_group, error)
      call hdf5_write_attribute(self%litz_group, 'format_version', format_version, error)
      call hdf5_write_attribute(self%litz_group, 'version', version, error)
      call hdf5_write_attribute(self%litz_group, 'finished', 0, error)
      self%file%units = model%units
      call add_fields(self%file, error)
   end subroutine ledger_open

   subroutine add_fields(file, error)
      type(vtkhdf_file_t), intent(inout) :: file
      type(error_t), allocatable, intent(inout) :: error

      call file%add_field(on_points, 'id', 1, '1', 'number of the contact, the same while it lives', 1, error, .true.)
      call file%add_field(on_points, 'element_bar', 1, '1', 'barred element, number in the deck', 1, error, .true.)
      call file%add_field(on_points, 'element', 1, '1', 'unbarred element, number in the deck', 1, error, .true.)
      call file%add_field(on_points, 'xi_bar', 1, '1', 'position in the barred element, -1 to 1', 1, error)
      call file%add_field(on_points, 'xi', 1, '1', 'position in the unbarred element, -1 to 1', 1, error)
      call file%add_field(on_points, 'angle', 1, 'rad', 'angle between the axes', 1, error)
      call file%add_field(on_points, 'gap', 1, 'm', 'gap between the surfaces, negative in contact', 1, error)
      call file%add_field(on_points, 'force', 1, 'N', 'contact force, pushing the wires apart', 1, error)
      call file%add_field(on_points, 'normal', 3, '1', 'unit normal from the unbarred to the barred wire', 1, error)
      call file%add_field(on_points, 'point_bar', 3, 'm', 'point of the barred axis', 1, error)
      call file%add_field(on_points, 'point', 3, 'm', 'point of the unbarred axis', 1, error)
      call file%add_field(on_points, 'semi_major', 1, 'm', 'longer semi-axis of the spot', 1, error)
      call file%add_field(on_points, 'semi_minor', 1, 'm', 'shorter semi-axis of the spot', 1, error)
      call file%add_field(on_points, 'resistance', 1, 'ohm', &
         'contact resistance, infinite where no current can pass', 1, error)
      call file%add_field(on_points, 'current', 1, 'A', 'current from the barred to the unbarred wire', 1, error)
      call file%add_field(on_points, 'voltage_gap', 1, 'V', 'potential of the barred minus the unbarred wire', 1, error)
      call file%add_field(on_points, 'joule_heat', 1, 'W', 'heat in the spot', 1, error)
      call file%add_field(on_points, 'friction', 1, '1', '0 none, 1 stick, 2 slip', 1, error, .true.)
      call file%add_field(on_points, 'traction', 3, 'N', 'what the barred wire feels of friction', 1, error)
      call file%add_field(on_points, 'slip_path', 1, 'm', 'path of the slip since the contact closed', 1, error)
      call file%add_field(on_points, 'dissipation', 1, 'J', 'heat of friction since the contact closed', 1, error)
   end subroutine add_fields

   !> Adds the contacts of an increment to the table.
   subroutine ledger_write_table(self, model, state, error)
      class(contact_ledger_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(state_t), intent(in) :: state
      type(error_t), allocatable, intent(inout) :: error
      character(len=1024) :: line
      integer :: i

      if (allocated(error) .or. .not. allocated(state%contacts)) return
      do i = 1, size(state%contacts)
         associate (c => state%contacts(i))
            write (line, '(*(g0, :, ","))') state%step, state%increment, state%time, c%id, &
               model%element_id(c%element_bar), model%element_id(c%element), c%xi_bar, c%xi, c%angle, c%gap, c%force, &
               c%normal, c%point_bar, c%point, c%semi_major, c%semi_minor, c%resistance, c%current, c%voltage_gap, &
               c%joule_heat, c%traction, c%slip_path, c%dissipation, trim(friction_names(c%friction_status)), &
               trim(contact_status(c, self%last_elements))
         end associate
         call self%table%write_line(trim(line), error)
      end do
      call self%table%flush(error)
      call remember(state%contacts, self%last_elements)
   end subroutine ledger_write_table

   pure function contact_status(contact, last_elements) result(status)
      type(contact_t), intent(in) :: contact
      integer, intent(in) :: last_elements(:, :)
      character(len=6) :: status

      status = status_new
      if (contact%id > size(last_elements, 2)) return
      if (all(last_elements(:, contact%id) == 0)) return
      status = status_active
      if (any(last_elements(:, contact%id) /= [contact%element_bar, contact%element])) status = status_moved
   end function contact_status

   pure subroutine remember(contacts, last_elements)
      type(contact_t), intent(in) :: contacts(:)
      integer, allocatable, intent(inout) :: last_elements(:, :)
      integer :: i

      deallocate (last_elements)
      allocate (last_elements(2, maxval([0, contacts%id])), source=0)
      do i = 1, size(contacts)
         last_elements(:, contacts(i)%id) = [contacts(i)%element_bar, contacts(i)%element]
      end do
   end subroutine remember

   !> Adds the contacts of an increment to the points.
   subroutine ledger_write_points(self, model, state, error)
      class(contact_ledger_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(state_t), intent(in) :: state
      type(error_t), allocatable, intent(inout) :: error
      type(contact_t), allocatable :: contacts(:)
      integer :: i, n

      allocate (contacts(0))
      if (allocated(state%contacts)) contacts = state%contacts
      n = size(contacts)
      call self%file%write_cells(vtk_vertex, reshape([(i, i=1, n)], [1, n]), n, error)
      call self%file%write_points(reshape([(spot_position(contacts(i), model), i=1, n)], [3, n]), error)
      call write_integer_fields(self%file, model, contacts, error)
      call write_real_fields(self%file, contacts, error)
      call self%file%end_step(state%time, error)
   end subroutine ledger_write_points

   !> Midway between the two surfaces.
   pure function spot_position(contact, model) result(position)
      type(contact_t), intent(in) :: contact
      type(model_t), intent(in) :: model
      real(dp) :: position(3)
      real(dp) :: radius_bar, radius

      radius_bar = model%sections(model%element_section(contact%element_bar))%contact_radius
      radius = model%sections(model%element_section(contact%element))%contact_radius
      position = (contact%point_bar - radius_bar*contact%normal + contact%point + radius*contact%normal)/2
   end function spot_position

   subroutine write_integer_fields(file, model, contacts, error)
      type(vtkhdf_file_t), intent(inout) :: file
      type(model_t), intent(in) :: model
      type(contact_t), intent(in) :: contacts(:)
      type(error_t), allocatable, intent(inout) :: error

      call file%write_field('id', contacts%id, error)
      call file%write_field('element_bar', model%element_id(contacts%element_bar), error)
      call file%write_field('element', model%element_id(contacts%element), error)
      call file%write_field('friction', contacts%friction_status, error)
   end subroutine write_integer_fields

   subroutine write_real_fields(file, contacts, error)
      type(vtkhdf_file_t), intent(inout) :: file
      type(contact_t), intent(in) :: contacts(:)
      type(error_t), allocatable, intent(inout) :: error
      integer :: i, n

      n = size(contacts)
      call file%write_field('xi_bar', contacts%xi_bar, error)
      call file%write_field('xi', contacts%xi, error)
      call file%write_field('angle', contacts%angle, error)
      call file%write_field('gap', contacts%gap, error)
      call file%write_field('force', contacts%force, error)
      call file%write_field('normal', reshape([(contacts(i)%normal, i=1, n)], [3, n]), error)
      call file%write_field('point_bar', reshape([(contacts(i)%point_bar, i=1, n)], [3, n]), error)
      call file%write_field('point', reshape([(contacts(i)%point, i=1, n)], [3, n]), error)
      call file%write_field('semi_major', contacts%semi_major, error)
      call file%write_field('semi_minor', contacts%semi_minor, error)
      call file%write_field('resistance', contacts%resistance, error)
      call file%write_field('current', contacts%current, error)
      call file%write_field('voltage_gap', contacts%voltage_gap, error)
      call file%write_field('joule_heat', contacts%joule_heat, error)
      call file%write_field('traction', reshape([(contacts(i)%traction, i=1, n)], [3, n]), error)
      call file%write_field('slip_path', contacts%slip_path, error)
      call file%write_field('dissipation', contacts%dissipation, error)
   end subroutine write_real_fields

   !> Puts both files in the place of older ones.
   subroutine ledger_publish(self, error)
      class(contact_ledger_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error

      call self%file%publish(error)
      call self%table%publish(error)
   end subroutine ledger_publish

   !> Closes both files, and notes whether the run came to its end.
   subroutine ledger_close(self, finished, error)
      class(contact_ledger_t), intent(inout) :: self
      logical, intent(in) :: finished
      type(error_t), allocatable, intent(inout) :: error

      call self%table%close(error)
      if (self%file%file < 0) return
      if (finished) call hdf5_write_attribute(self%litz_group, 'finished', 1, error)
      call self%file%close(error)
   end subroutine ledger_close

end module litz_contact_ledger
