!> The contacts with rigid surfaces: one row per element that touches and increment.
module litz_surface_ledger
   use litz_contact_ledger, only: row_text
   use litz_errors, only: error_t
   use litz_model, only: model_t
   use litz_output_files, only: text_file_t
   use litz_quantities, only: quantity_table_t
   use litz_result_quantities, only: surface_contact_table
   use litz_state, only: state_t, surface_contact_t
   implicit none
   private
   public :: surface_ledger_t

   type :: surface_ledger_t
      type(text_file_t), private :: table
      !> The model has rigid surfaces; without them there is no file
      logical, private :: is_open = .false.
   contains
      procedure :: open => ledger_open
      procedure :: write => ledger_write
      procedure :: publish => ledger_publish
      procedure :: close => ledger_close
   end type surface_ledger_t

contains

   subroutine ledger_open(self, model, path, error)
      class(surface_ledger_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> The .csv file
      character(len=*), intent(in) :: path
      type(error_t), allocatable, intent(inout) :: error
      type(quantity_table_t) :: columns
      character(len=:), allocatable :: header
      integer :: i

      if (allocated(error) .or. size(model%surface_pairs) == 0) return
      self%is_open = .true.
      columns = surface_contact_table([surface_contact_t ::])
      header = 'step,increment,time [s]'
      do i = 1, size(columns%quantities)
         if (columns%quantities(i)%is_result()) header = header//columns%quantities(i)%columns(',', with_units=.true.)
      end do
      header = header//',wires,surface'
      call self%table%create(path, error)
      call self%table%write_line(model%units%in_header(header), error)
      call self%table%flush(error)
   end subroutine ledger_open

   !> Adds the contacts of an increment.
   subroutine ledger_write(self, model, state, error)
      class(surface_ledger_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      type(state_t), intent(in) :: state
      type(error_t), allocatable, intent(inout) :: error
      type(quantity_table_t) :: rows
      type(surface_contact_t), allocatable :: shown(:)
      character(len=80) :: place
      integer :: i

      if (allocated(error) .or. .not. self%is_open) return
      shown = state%surface_contacts
      shown%element = model%element_id(shown%element)
      rows = surface_contact_table(shown)
      write (place, '(*(g0, :, ","))') state%step, state%increment, state%time
      do i = 1, size(shown)
         associate (pair => model%surface_pairs(shown(i)%pair))
            call self%table%write_line(trim(place)//row_text(rows, i)//','//model%element_sets(pair%set)%name//','// &
               model%surfaces(pair%surface)%name, error)
         end associate
      end do
      call self%table%flush(error)
   end subroutine ledger_write

   !> Puts the file in the place of an older one.
   subroutine ledger_publish(self, error)
      class(surface_ledger_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error

      if (self%is_open) call self%table%publish(error)
   end subroutine ledger_publish

   subroutine ledger_close(self, error)
      class(surface_ledger_t), intent(inout) :: self
      type(error_t), allocatable, intent(inout) :: error

      if (self%is_open) call self%table%close(error)
   end subroutine ledger_close

end module litz_surface_ledger
