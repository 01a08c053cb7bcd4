!> Numbers of the free unknowns, and cells that are scattered into the matrix, against dense sums.
!>
!> Ten nodes with displacements, rotations and some with potentials, of which random ones are prescribed; random cells
!> of two and of four nodes.
program test_equations
   use litz_equations, only: equations_t, system_t, number_equations, build_system
   use litz_communicator, only: one_process_t
   use litz_errors, only: error_t
   use litz_fields, only: n_slots, n_fields, n_groups, depends_on, group_mechanical, group_transport, &
      first_slot_of_group, last_slot_of_group, motion_slots, potential_slots, field_of_slot
   use litz_kinds, only: dp
   use litz_scatter, only: forces_t, clear_forces, scatter
   use litz_sparse_pattern, only: csr_position
   implicit none

   integer, parameter :: n_nodes = 10, pairs(2, 9) = reshape([1, 2, 2, 3, 3, 4, 4, 5, 6, 7, 7, 8, 8, 9, 9, 10, 2, 6], &
      [2, 9]), fours(4, 2) = reshape([1, 2, 7, 8, 3, 4, 8, 9], [4, 2])
   integer :: failures = 0

   call start_random_numbers()
   call free_unknowns_are_numbered_node_after_node()
   call what_is_gathered_is_spread_to_where_it_was()
   call cells_add_up_in_every_block()
   call prescribed_increments_act_on_the_right_side()
   call the_largest_force_of_a_cell_is_the_reference_of_its_field()
   if (failures > 0) error stop 1

contains

   subroutine free_unknowns_are_numbered_node_after_node()
      type(equations_t) :: equations
      logical :: fixed(n_slots, n_nodes), exists(n_slots, n_nodes)
      integer :: group, node, slot, next

      call draw_supports(fixed, exists)
      call number_equations(fixed, exists, equations)
      do group = 1, n_groups
         next = 0
         do node = 1, n_nodes
            do slot = first_slot_of_group(group), last_slot_of_group(group)
               if (exists(slot, node) .and. .not. fixed(slot, node)) then
                  next = next + 1
                  call check(equations%number(slot, node) == next, 'free unknowns follow one another')
               else
                  call check(equations%number(slot, node) == 0, 'what is prescribed or absent has no number')
               end if
            end do
         end do
         call check(equations%count(group) == next, 'each group counts its own')
      end do
   end subroutine free_unknowns_are_numbered_node_after_node

   subroutine what_is_gathered_is_spread_to_where_it_was()
      type(equations_t) :: equations
      type(system_t) :: matrix
      real(dp) :: nodal(n_slots, n_nodes), spread_out(n_slots, n_nodes)
      integer :: group

      call new_system(equations, matrix)
      call random_number(nodal)
      spread_out = -1
      do group = 1, n_groups
         call equations%spread_to_nodes(group, equations%gather(group, nodal), spread_out)
      end do
      call check(all(same(spread_out, merge(nodal, -1.0_dp, equations%number > 0))), &
         'free unknowns come back, others are left alone')
   end subroutine what_is_gathered_is_spread_to_where_it_was

   !> Mechanics with itself, potentials with themselves, and currents that depend on the motion.
   subroutine cells_add_up_in_every_block()
      type(equations_t) :: equations
      type(system_t) :: matrix
      type(forces_t) :: forces
      real(dp) :: nothing(n_slots, n_nodes), internal(n_slots, n_nodes)
      real(dp), allocatable :: dense(:, :)

      call new_system(equations, matrix)
      nothing = 0
      call clear_forces(one_process_t(), 1, reshape([0.0_dp], [3, n_nodes], [0.0_dp]), nothing, nothing, forces)
      allocate (dense(n_slots*n_nodes, n_slots*n_nodes), source=0.0_dp)
      internal = 0
      call add_random_cells(pairs, motion_slots, motion_slots, equations, matrix, forces, dense, internal)
      call add_random_cells(fours, motion_slots, motion_slots, equations, matrix, forces, dense, internal)
      call add_random_cells(fours, potential_slots, potential_slots, equations, matrix, forces, dense, internal)
      call add_random_cells(fours, potential_slots, motion_slots, equations, matrix, forces, dense, internal)
      call check(all(abs(forces%internal - internal) <= 1.0e-14_dp), 'forces of all nodes, prescribed ones too')
      call compare(group_mechanical, group_mechanical, equations, matrix, dense)
      call compare(group_transport, group_transport, equations, matrix, dense)
      call compare(group_transport, group_mechanical, equations, matrix, dense)
      call check(.not. depends_on(group_mechanical, group_transport) .and. &
         .not. allocated(matrix%block(group_mechanical, group_transport)%value), 'no block where nothing depends')
   end subroutine cells_add_up_in_every_block

   !> Random cells, scattered and summed up in a dense matrix and dense forces.
   subroutine add_random_cells(nodes, rows, columns, equations, matrix, forces, dense, internal)
      integer, intent(in) :: nodes(:, :), rows(2), columns(2)
      type(equations_t), intent(in) :: equations
      type(system_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces
      real(dp), intent(inout) :: dense(:, :), internal(:, :)
      real(dp) :: nothing(n_slots, n_nodes)
      real(dp), allocatable :: k(:, :, :), r(:, :)
      integer :: cell, a, b, i, j, n_rows, n_columns

      nothing = 0
      n_rows = rows(2) - rows(1) + 1
      n_columns = columns(2) - columns(1) + 1
      allocate (k(n_rows*size(nodes, 1), n_columns*size(nodes, 1), size(nodes, 2)))
      allocate (r(n_rows*size(nodes, 1), size(nodes, 2)))
      call random_number(k)
      call random_number(r)
      associate (block => matrix%block(merge(1, 2, rows(1) == 1), merge(1, 2, columns(1) == 1)))
         call scatter(equations, nodes, rows, columns, k, nothing, block, forces, r)
      end associate
      do cell = 1, size(nodes, 2)
         do a = 1, size(nodes, 1)
            do i = 1, n_rows
               associate (force => internal(rows(1) - 1 + i, nodes(a, cell)))
                  force = force + r((a - 1)*n_rows + i, cell)
               end associate
               do b = 1, size(nodes, 1)
                  do j = 1, n_columns
                     associate (entry => dense(place(rows(1) - 1 + i, nodes(a, cell)), &
                        place(columns(1) - 1 + j, nodes(b, cell))))
                        entry = entry + k((a - 1)*n_rows + i, (b - 1)*n_columns + j, cell)
                     end associate
                  end do
               end do
            end do
         end do
      end do
   end subroutine add_random_cells

   !> Each entry over free unknowns.
   subroutine compare(row_group, column_group, equations, matrix, dense)
      integer, intent(in) :: row_group, column_group
      type(equations_t), intent(in) :: equations
      type(system_t), intent(in) :: matrix
      real(dp), intent(in) :: dense(:, :)
      integer :: node, other, slot, column, row, position
      real(dp) :: value, worst

      worst = 0
      associate (block => matrix%block(row_group, column_group))
         do node = 1, n_nodes
            do slot = first_slot_of_group(row_group), last_slot_of_group(row_group)
               row = equations%number(slot, node)
               if (row == 0) cycle
               do other = 1, n_nodes
                  do column = first_slot_of_group(column_group), last_slot_of_group(column_group)
                     if (equations%number(column, other) == 0) cycle
                     position = csr_position(block, row, equations%number(column, other))
                     value = 0
                     if (position > 0) value = block%value(position)
                     worst = max(worst, abs(value - dense(place(slot, node), place(column, other))))
                  end do
               end do
            end do
         end do
      end associate
      call check(worst <= 1.0e-14_dp, 'entries are the sums over the cells')
   end subroutine compare

   subroutine prescribed_increments_act_on_the_right_side()
      type(equations_t) :: equations
      type(system_t) :: matrix
      type(forces_t) :: forces
      real(dp) :: nothing(n_slots, n_nodes), increment(n_slots, n_nodes), k(12, 12, 1), expected(12)

      call new_system(equations, matrix)
      nothing = 0
      call clear_forces(one_process_t(), 1, reshape([0.0_dp], [3, n_nodes], [0.0_dp]), nothing, nothing, forces)
      call random_number(increment)
      call random_number(k)
      call scatter(equations, pairs(:, 3:3), motion_slots, motion_slots, k, increment, &
         matrix%block(group_mechanical, group_mechanical), forces)
      expected = matmul(k(:, :, 1), reshape(increment(1:6, pairs(:, 3)), [12]))
      call check(all(abs(reshape(forces%prescribed(1:6, pairs(:, 3)), [12]) - expected) <= 1.0e-13_dp), &
         'tangent times what is prescribed')
      call check(.not. any(abs(forces%internal) > 0), 'a tangent alone is no force')
   end subroutine prescribed_increments_act_on_the_right_side

   subroutine the_largest_force_of_a_cell_is_the_reference_of_its_field()
      type(equations_t) :: equations
      type(system_t) :: matrix
      type(forces_t) :: forces
      real(dp) :: nothing(n_slots, n_nodes), k(12, 12, 2), r(12, 2), expected(n_fields)
      integer :: i

      call new_system(equations, matrix)
      nothing = 0
      call clear_forces(one_process_t(), 1, reshape([0.0_dp], [3, n_nodes], [0.0_dp]), nothing, nothing, forces)
      call random_number(r)
      r = r - 0.5_dp
      k = 0
      call scatter(equations, pairs(:, 1:2), motion_slots, motion_slots, k, nothing, &
         matrix%block(group_mechanical, group_mechanical), forces, r)
      expected = 0
      do i = 1, 12
         associate (largest => expected(field_of_slot(modulo(i - 1, 6) + 1)))
            largest = max(largest, maxval(abs(r(i, :))))
         end associate
      end do
      call check(all(same(forces%reference, expected)), 'largest force and moment of any cell, no current')
   end subroutine the_largest_force_of_a_cell_is_the_reference_of_its_field

   subroutine new_system(equations, matrix)
      type(equations_t), intent(out) :: equations
      type(system_t), intent(out) :: matrix
      logical :: fixed(n_slots, n_nodes), exists(n_slots, n_nodes)
      type(error_t), allocatable :: error
      integer :: i

      call draw_supports(fixed, exists)
      call number_equations(fixed, exists, equations)
      call build_system([(2*i - 1, i=1, size(pairs, 2)), (2*size(pairs, 2) + 4*i - 3, i=1, size(fours, 2) + 1)], &
         [reshape(pairs, [size(pairs)]), reshape(fours, [size(fours)])], equations, matrix, error)
      call check(.not. allocated(error), 'a small system can be built')
   end subroutine new_system

   !> A third of the unknowns is prescribed; nodes 5 and 10 have no potential.
   subroutine draw_supports(fixed, exists)
      logical, intent(out) :: fixed(:, :), exists(:, :)
      real(dp) :: draw(n_slots, n_nodes)

      call random_number(draw)
      fixed = draw < 1/3.0_dp
      exists = .true.
      exists(potential_slots(1):, [5, 10]) = .false.
   end subroutine draw_supports

   pure integer function place(slot, node)
      integer, intent(in) :: slot, node

      place = slot + (node - 1)*n_slots
   end function place

   elemental logical function same(a, b)
      real(dp), intent(in) :: a, b

      same = .not. abs(a - b) > 0
   end function same

   subroutine start_random_numbers()
      integer :: n, i

      call random_seed(size=n)
      call random_seed(put=[(2*i + 1, i=1, n)])
   end subroutine start_random_numbers

   subroutine check(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what

      if (holds) return
      failures = failures + 1
      print '(2a)', 'FAILED: ', what
   end subroutine check

end program test_equations
