!> Parts of a model without a path to a prescribed value, for fields of which only differences matter.
!>
!> Their level is not determined by the equations, but no flux can pass either: one node of each such part is held at
!> the value of the last converged state. That changes no flux, and the potential of a wire that has lost its last
!> contact stays as it was, whatever the iteration has made of it meanwhile. A part into which a flux is fed is held,
!> too, as the iteration may connect it still; a converged state cannot have one. Temperatures that float are an error.
module litz_grounding
   use litz_conduction, only: surface_conducts
   use litz_kinds, only: dp
   use litz_errors, only: error_t, fail, exit_input
   use litz_fields, only: fields, n_fields, field_temperature, dof_range, first_slot
   use litz_joined_parts, only: parts_t
   use litz_linear_solver, only: csr_matrix_t
   use litz_problem, only: problem_t
   use litz_text, only: to_text
   implicit none
   private
   public :: ground_floating_parts, describe_fed_part, find_connected

contains

   !> Add a ground to the diagonal for every part that floats.
   subroutine ground_floating_parts(problem, error)
      type(problem_t), intent(inout) :: problem
      !> A flux is fed into a part that floats, and the model has nothing that could connect it
      type(error_t), allocatable, intent(out) :: error
      integer :: field

      problem%fed_node = 0
      do field = 1, n_fields
         if (.not. fields(field)%is_level) cycle
         if (problem%equations%count(fields(field)%group) > 0) call ground_field(problem, field)
      end do
      problem%is_fed = problem%processes%any(problem%fed_node > 0)
      if (.not. problem%is_fed) return
      if (.not. may_close(problem)) error = fail(exit_input, describe_fed_part(problem))
   end subroutine ground_floating_parts

   !> Contacts that may close yet could lead the flux to what is prescribed.
   pure logical function may_close(problem)
      type(problem_t), intent(in) :: problem
      integer :: i

      may_close = problem%contact%present .or. any([(surface_conducts(problem%model, i, problem%fed_field), &
         i=1, size(problem%model%surfaces))])
   end function may_close

   !> Into what a flux is fed that floats; empty: nothing.
   function describe_fed_part(problem) result(text)
      type(problem_t), intent(in) :: problem
      character(len=:), allocatable :: text

      text = problem%processes%first_text(describe_own_part(problem))
   end function describe_fed_part

   !> The same, if the node is one of this process.
   function describe_own_part(problem) result(text)
      type(problem_t), intent(in) :: problem
      character(len=:), allocatable :: text
      integer :: surface

      text = ''
      if (problem%fed_node == 0) return
      surface = findloc(problem%model%surfaces%node, problem%fed_node, 1)
      if (surface > 0 .and. .not. any(problem%model%connectivity == problem%fed_node)) then
         text = 'the '//trim(fields(problem%fed_field)%name)//' of the rigid surface '// &
            problem%model%surfaces(surface)%name//' is not determined: prescribe degree of freedom '// &
            dof_range(problem%fed_field)//' of its reference node '// &
            to_text(problem%model%node_id(problem%fed_node))// &
            ' (*BOUNDARY); no wire that it touches has a prescribed one'
         return
      end if
      if (problem%fed_field == field_temperature) then
         text = 'the temperature of the wires at node '//to_text(problem%model%node_id(problem%fed_node))// &
            ' is not determined: they have no prescribed temperature (*BOUNDARY, degree of freedom '// &
            dof_range(field_temperature)//'), nothing leaves their sides (*FILM, *RADIATE), and no contact'// &
            ' passes heat (*GAP CONDUCTANCE)'
         return
      end if
      associate (field => fields(problem%fed_field))
         text = 'a '//trim(field%flux_in_words)//' is fed into the conductor at node '// &
            to_text(problem%model%node_id(problem%fed_node))//', which has no path to a prescribed '//trim(field%name)
      end associate
   end function describe_own_part

   !> Which nodes have a path to a prescribed value of a field.
   subroutine find_connected(problem, field, connected)
      type(problem_t), intent(in) :: problem
      !> One of the fields of litz_fields, with one component
      integer, intent(in) :: field
      !> (n_nodes)
      logical, intent(out) :: connected(:)
      type(parts_t) :: parts
      integer :: i
      logical, dimension(size(connected)) :: prescribed, of_part

      call find_parts(problem, field, parts)
      prescribed = problem%loading%fixed(first_slot(field), :)
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%hold(problem%domain_t, field, prescribed)
      end do
      of_part = .false.
      do i = 1, size(connected)
         if (prescribed(i)) of_part(parts%find(i)) = .true.
      end do
      call parts%any_of_pieces(problem%processes, of_part)
      do i = 1, size(connected)
         connected(i) = of_part(parts%find(i))
      end do
   end subroutine find_connected

   subroutine ground_field(problem, field)
      type(problem_t), intent(inout) :: problem
      !> One of the fields of litz_fields, with one component
      integer, intent(in) :: field
      type(parts_t) :: parts
      integer :: i, node, row
      logical, dimension(problem%model%n_nodes) :: held, held_node
      real(dp) :: fed(problem%model%n_nodes), scale, least

      call find_parts(problem, field, parts)
      held_node = .false.
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%hold(problem%domain_t, field, held_node)
      end do
      held = .false.
      fed = 0
      associate (slot => first_slot(field), group => fields(field)%group)
         associate (block => problem%matrix%block(group, group), load => problem%loading%load(slot, :), &
            fixed => problem%loading%fixed(slot, :))
            do node = 1, problem%model%n_nodes
               i = parts%find(node)
               held(i) = held(i) .or. fixed(node) .or. held_node(node)
               if (problem%processes%owns(node)) fed(i) = fed(i) + load(node)
            end do
            call parts%any_of_pieces(problem%processes, held)
            call parts%sum_of_pieces(problem%processes, fed)
            least = epsilon(1.0_dp)*problem%processes%sum(sum(abs(problem%processes%own_part(load))))
            scale = max(problem%processes%largest(maxval(abs(block%value))), tiny(1.0_dp))
            call hold_other_pieces(problem, parts, slot, held)
            do node = 1, problem%model%n_nodes
               row = problem%equations%number(slot, node)
               if (row == 0 .or. .not. problem%processes%owns(node)) cycle
               i = parts%find(node)
               if (held(i)) cycle
               ! heat is made inside, too
               if (field == field_temperature) fed(i) = huge(fed)
               if (abs(fed(i)) > least .and. problem%fed_node == 0) then
                  if (field /= field_temperature .and. .not. abs(load(node)) > 0) cycle
                  problem%fed_node = node
                  problem%fed_field = field
               end if
               held(i) = .true.
               call add_to_diagonal(block, row, scale)
               associate (forces => problem%forces)
                  forces%internal(slot, node) = forces%internal(slot, node) &
                     + scale*(problem%iterate%value(slot, node) - problem%state%value(slot, node))
                  forces%sensitivity(slot, node) = forces%sensitivity(slot, node) + scale*forces%magnitude(slot, node)
               end associate
            end do
         end associate
      end associate
   end subroutine ground_field

   !> Of a part that floats and is on several processes one piece with an unknown is grounded, a loaded one if there is.
   subroutine hold_other_pieces(problem, parts, slot, held)
      type(problem_t), intent(in) :: problem
      type(parts_t), intent(inout) :: parts
      !> Of the field
      integer, intent(in) :: slot
      !> Of representatives: the part needs no ground (n_nodes)
      logical, intent(inout) :: held(:)
      logical, dimension(size(held)) :: is_free, is_loaded, has_loaded
      integer :: node, i

      if (problem%processes%n_processes == 1) return
      is_free = .false.
      is_loaded = .false.
      do node = 1, size(held)
         if (problem%equations%number(slot, node) == 0 .or. .not. problem%processes%owns(node)) cycle
         i = parts%find(node)
         is_free(i) = .true.
         is_loaded(i) = is_loaded(i) .or. abs(problem%loading%load(slot, node)) > 0
      end do
      has_loaded = is_loaded
      call parts%any_of_pieces(problem%processes, has_loaded)
      is_free = is_free .and. (is_loaded .or. .not. has_loaded)
      call parts%keep_first_piece(problem%processes, is_free)
      held = held .or. .not. is_free
   end subroutine hold_other_pieces

   pure subroutine add_to_diagonal(block, row, value)
      type(csr_matrix_t), intent(inout) :: block
      !> Row
      integer, intent(in) :: row
      !> In the unit of the entries
      real(dp), intent(in) :: value
      integer :: position

      do position = block%row_start(row), block%row_start(row + 1) - 1
         if (block%column(position) == row) block%value(position) = block%value(position) + value
      end do
   end subroutine add_to_diagonal

   !> Join the nodes between which the flux of a field can pass.
   subroutine find_parts(problem, field, parts)
      type(problem_t), intent(in) :: problem
      !> One of the fields of litz_fields
      integer, intent(in) :: field
      type(parts_t), intent(out) :: parts
      integer, allocatable :: pairs(:, :)
      integer :: i, k

      call parts%start(problem%model%n_nodes)
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%link(problem%domain_t, field, pairs)
         do k = 1, size(pairs, 2)
            call parts%join(pairs(1, k), pairs(2, k))
         end do
      end do
      call parts%join_processes(problem%processes)
   end subroutine find_parts

end module litz_grounding
