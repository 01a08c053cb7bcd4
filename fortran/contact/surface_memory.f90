!> What elements on rigid surfaces remember from one increment to the next, as numbers of the state.
module litz_surface_memory
   use litz_kinds, only: dp
   use litz_domain, only: domain_t
   use litz_friction_law, only: friction_start_t
   use litz_surface_cells, only: surface_cell_t, surface_memory_t, advanced_memory, advanced_dents
   use litz_surface_dents, only: dents_of_numbers, numbers_of_dents, n_of_dents, find_dents
   use litz_surface_forces, only: energies_of_cell
   use litz_surface_poses, only: present_surface, element_axis
   implicit none
   private
   public :: n_remembered, recall_memory, keep_memory

   !> Numbers of the memory of a cell but for its dents
   integer, parameter :: n_remembered = 10

contains

   !> Take the memory of the last converged state.
   subroutine recall_memory(domain, cells)
      type(domain_t), intent(inout) :: domain
      type(surface_cell_t), intent(inout) :: cells(:)
      integer :: i

      associate (state => domain%state, model => domain%model)
         if (.not. allocated(state%surface_memory)) then
            allocate (state%surface_memory(n_remembered, size(cells)), source=0.0_dp)
         end if
         do i = 1, size(cells)
            associate (m => state%surface_memory(:, i))
               cells(i)%memory = surface_memory_t(m(1) > 0, friction_start_t(m(2:3), m(4), m(5), m(6)), m(7), m(8), &
                  m(9), m(10))
            end associate
         end do
         if (.not. any([(model%interactions(model%surface_pairs(i)%interaction)%normal%yields(), &
            i=1, size(model%surface_pairs))])) return
         if (.not. allocated(state%surface_dents)) then
            allocate (state%surface_dents(n_of_dents, size(cells)), source=0.0_dp)
         end if
         do i = 1, size(cells)
            cells(i)%dents = dents_of_numbers(state%surface_dents(:, i))
            if (allocated(cells(i)%yielding%dent)) deallocate (cells(i)%yielding%dent)
         end do
      end associate
   end subroutine recall_memory

   !> What cells remember of an increment that has converged.
   subroutine keep_memory(domain, cells)
      type(domain_t), intent(inout) :: domain
      type(surface_cell_t), intent(inout) :: cells(:)
      real(dp) :: energies(2)
      integer :: i

      do i = 1, size(cells)
         associate (cell => cells(i))
            energies = energies_of_cell(cell)
            cell%memory = advanced_memory(cell, energies(1))
            associate (m => cell%memory)
               domain%state%surface_memory(:, i) = [merge(1.0_dp, 0.0_dp, m%closed), m%start%traction, m%start%force, &
                  m%start%stiffness, m%start%elastic_energy, m%slip_path, m%dissipation, m%energy, m%last_dissipation]
            end associate
            if (.not. cell%yielding%yields) cycle
            cell%dents = advanced_dents(present_surface(domain, cell%pair), element_axis(domain, cell%element, &
               cell%pair), cell, energies(2))
            if (allocated(cell%yielding%dent)) deallocate (cell%yielding%dent)
            if (cell%force > 0) call find_dents(cell%dents, cell%yielding)
            domain%state%surface_dents(:, i) = numbers_of_dents(cell%dents)
         end associate
      end do
   end subroutine keep_memory

end module litz_surface_memory
