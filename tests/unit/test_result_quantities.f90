!> The list of results holds all of a state, under names and texts that fit, and a table of contacts gives them back.
program test_result_quantities
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
   use litz_fields, only: n_slots
   use litz_kinds, only: dp
   use litz_quantities, only: quantity_table_t, on_points, on_cells
   use litz_result_quantities, only: wire_quantity_t, list_wire_quantities, requested_names, contact_table, &
      contacts_of_table
   use litz_state, only: state_t, contact_t
   implicit none

   integer, parameter :: n_nodes = 3
   type(state_t), target :: state
   type(wire_quantity_t), allocatable :: list(:)
   type(quantity_table_t) :: table
   type(contact_t), allocatable :: contacts(:)
   integer :: i

   allocate (state%value(n_slots, n_nodes), state%reaction(n_slots, n_nodes), state%load(n_slots, n_nodes), &
      source=0.0_dp)
   call list_wire_quantities(state, list)
   do i = 1, size(list)
      if (associated(list(i)%values)) list(i)%values = 1
   end do
   ! what a run goes on from is in the list: no field may be missing
   call expect(all(nint(state%value) == 1), 'every field is a result')
   call expect(all(nint(state%reaction) == 1), 'every reaction is a result')
   call expect(all(nint(state%load) == 1), 'every load is a result')

   do i = 1, size(list)
      call expect(len_trim(list(i)%text) < len(list(i)%text), 'no text is cut off')
      call expect(count(list%name == list(i)%name) == 1, 'each name stands for one result: '//trim(list(i)%name))
      call expect(any(list(i)%components == [1, 3]), 'results are scalars or vectors')
   end do
   call expect(requested_names(on_cells) == 'SF|EPG|JOULE|SC|SFN|SE|SK|E11|S11|DLOAD|HFL|QSIDE|QSTORE', &
      'decks ask for section forces by one word')
   call expect(requested_names(on_points, means_only=.true.) == 'U|UR|EPOT|NT', 'forces and currents are summed')

   allocate (contacts(2))
   contacts(1)%id = 7
   contacts(2)%pair = 3
   contacts(2)%gap = -1.0e-6_dp
   contacts(2)%traction = [1.0_dp, 2.0_dp, 3.0_dp]
   contacts(2)%friction_status = 2
   contacts(1)%resistance = ieee_value(1.0_dp, ieee_positive_inf)
   table = contact_table(contacts)
   deallocate (contacts)
   call contacts_of_table(table, contacts)
   call expect(size(contacts) == 2, 'all contacts come back')
   call expect(contacts(1)%id == 7 .and. contacts(2)%pair == 3 .and. contacts(2)%friction_status == 2, 'whole numbers')
   call expect(abs(contacts(2)%gap + 1.0e-6_dp) <= 0, 'a real')
   call expect(all(abs(contacts(2)%traction - [1.0_dp, 2.0_dp, 3.0_dp]) <= 0), 'a vector')
   call expect(contacts(1)%resistance > huge(1.0_dp), 'an infinite resistance')
   do i = 1, size(table%quantities)
      associate (quantity => table%quantities(i))
         call expect(len_trim(quantity%text) < len(quantity%text), 'no text is cut off')
         if (quantity%name == 'pair') call expect(.not. quantity%is_result(), 'no result shows the pair')
         if (quantity%name == 'traction') call expect(quantity%columns(',', .true.) == &
            ',traction_x [N],traction_y [N],traction_z [N]', 'heads of a vector')
         if (quantity%name == 'friction') call expect(quantity%word(2) == 'slip', 'words of friction')
      end associate
   end do

contains

   subroutine expect(holds, text)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: text

      if (holds) return
      write (*, '(a)') text
      error stop
   end subroutine expect

end program test_result_quantities
