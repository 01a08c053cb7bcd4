!> The contact ledger: one row per contact and increment that is written, as a table and as points that ParaView shows.
module litz_contact_ledger
   use litz_kinds, only: dp
   use litz_errors, only: error_t
   use litz_model, only: model_t
   use litz_number_text, only: line_length, put_integer, put_real, put_text
   use litz_state, only: state_t, contact_t
   use litz_output_files, only: text_file_t
   use litz_quantities, only: quantity_t, quantity_table_t
   use litz_result_quantities, only: contact_table
   use litz_vtkhdf_writer, only: vtkhdf_file_t, vtk_vertex
   use litz_wire_results, only: most_written_increments
   implicit none
   private
   public :: contact_ledger_t, row_text

   !> Values of the column `status`: not there in the last increment that is written | with the same elements as then |
   !> now with others
   character(len=*), parameter :: status_new = 'new', status_active = 'active', status_moved = 'moved'

   type :: contact_ledger_t
      type(text_file_t), private :: table
      type(vtkhdf_file_t), private :: file
      !> Elements (barred, unbarred) of the contacts of the last increment written, by the contact's id; 0 0: not there
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
      type(quantity_table_t) :: columns
      integer :: i

      if (allocated(error)) return
      allocate (self%last_elements(2, 0))
      if (allocated(state%contacts)) call remember(state%contacts, self%last_elements)
      call self%table%create(table_path, error)
      columns = contact_table([contact_t ::])
      call self%table%write_line(model%units%in_header(header(columns%quantities)), error)
      call self%table%flush(error)
      call self%file%create(points_path, 1, 1, most_written_increments(model), error)
      self%file%units = model%units
      do i = 1, size(columns%quantities)
         if (columns%quantities(i)%is_result()) call self%file%add_field(columns%quantities(i), 1, error)
      end do
   end subroutine ledger_open

   pure function header(quantities) result(line)
      type(quantity_t), intent(in) :: quantities(:)
      character(len=:), allocatable :: line
      integer :: i

      line = 'step,increment,time [s]'
      do i = 1, size(quantities)
         if (quantities(i)%is_result()) line = line//quantities(i)%columns(',', with_units=.true.)
      end do
      line = line//',status'
   end function header

   !> Adds the contacts of an increment to the table.
   subroutine ledger_write_table(self, model, state, error)
      class(contact_ledger_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(state_t), intent(in) :: state
      type(error_t), allocatable, intent(inout) :: error
      type(quantity_table_t) :: rows
      character(len=80) :: place
      integer :: i

      if (allocated(error) .or. .not. allocated(state%contacts)) return
      rows = shown_contacts(model, state%contacts)
      write (place, '(*(g0, :, ","))') state%step, state%increment, state%time
      do i = 1, size(state%contacts)
         call self%table%write_line(trim(place)//row_text(rows, i)//','// &
            trim(contact_status(state%contacts(i), self%last_elements)), error)
      end do
      call self%table%flush(error)
      call remember(state%contacts, self%last_elements)
   end subroutine ledger_write_table

   !> The contacts with the elements' numbers in the deck.
   pure function shown_contacts(model, contacts) result(rows)
      type(model_t), intent(in) :: model
      type(contact_t), intent(in) :: contacts(:)
      type(quantity_table_t) :: rows
      integer :: i

      rows = contact_table(contacts)
      do i = 1, size(rows%quantities)
         associate (elements => rows%integers(rows%quantities(i)%first, :))
            if (rows%quantities(i)%is_element) elements = model%element_id(elements)
         end associate
      end do
   end function shown_contacts

   !> The values of a row, each with a comma before it.
   pure function row_text(rows, row) result(text)
      type(quantity_table_t), intent(in) :: rows
      !> Of the table
      integer, intent(in) :: row
      character(len=:), allocatable :: text
      character(len=line_length) :: line
      integer :: i, k, used

      used = 0
      do i = 1, size(rows%quantities)
         associate (quantity => rows%quantities(i))
            if (.not. quantity%is_result()) cycle
            do k = quantity%first, quantity%last()
               call put_text(',', line, used)
               if (quantity%words /= '') then
                  call put_text(quantity%word(rows%integers(k, row)), line, used)
               else if (quantity%is_integer) then
                  call put_integer(rows%integers(k, row), line, used)
               else
                  call put_real(rows%reals(k, row), line, used)
               end if
            end do
         end associate
      end do
      text = line(:used)
   end function row_text

   pure function contact_status(contact, last_elements) result(status)
      type(contact_t), intent(in) :: contact
      !> Elements of each contact of the increment written before, by its number (2, n)
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
      !> Elements of each contact, by its number (2, n)
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
      type(quantity_table_t) :: rows
      integer :: i, n

      n = 0
      if (allocated(state%contacts)) n = size(state%contacts)
      rows = shown_contacts(model, state%contacts(:n))
      call self%file%write_cells(vtk_vertex, reshape([(i, i=1, n)], [1, n]), n, error)
      call self%file%write_points(reshape([(spot_position(state%contacts(i), model), i=1, n)], [3, n]), error)
      do i = 1, size(rows%quantities)
         associate (quantity => rows%quantities(i))
            if (.not. quantity%is_result()) cycle
            if (quantity%is_integer) then
               call self%file%write_field(quantity%name, rows%integers(quantity%first, :), error)
            else
               call self%file%write_field(quantity%name, rows%reals(quantity%first:quantity%last(), :), error)
            end if
         end associate
      end do
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
      !> The run came to its end
      logical, intent(in) :: finished
      type(error_t), allocatable, intent(inout) :: error

      call self%table%close(error)
      call self%file%close(finished, error)
   end subroutine ledger_close

end module litz_contact_ledger
