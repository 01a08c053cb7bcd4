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
      if (problem%fed_node > 0 .and. .not. may_close(problem)) error = fail(exit_input, describe_fed_part(problem))
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
   end function describe_fed_part

   !> Which nodes have a path to a prescribed value of a field.
   subroutine find_connected(problem, field, connected)
      type(problem_t), intent(in) :: problem
      !> One of the fields of litz_fields, with one component
      integer, intent(in) :: field
      !> (n_nodes)
      logical, intent(out) :: connected(:)
      integer :: root(size(connected)), i
      logical, dimension(size(connected)) :: prescribed, of_part

      call find_parts(problem, field, root)
      prescribed = problem%loading%fixed(first_slot(field), :)
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%hold(problem%domain_t, field, prescribed)
      end do
      of_part = .false.
      do i = 1, size(connected)
         if (prescribed(i)) of_part(find_root(root, i)) = .true.
      end do
      do i = 1, size(connected)
         connected(i) = of_part(find_root(root, i))
      end do
   end subroutine find_connected

   subroutine ground_field(problem, field)
      type(problem_t), intent(inout) :: problem
      !> One of the fields of litz_fields, with one component
      integer, intent(in) :: field
      integer :: root(problem%model%n_nodes), i, node, row
      logical, dimension(problem%model%n_nodes) :: held, held_node
      real(dp) :: fed(problem%model%n_nodes), scale

      call find_parts(problem, field, root)
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
               i = find_root(root, node)
               held(i) = held(i) .or. fixed(node) .or. held_node(node)
               fed(i) = fed(i) + load(node)
            end do
            scale = max(maxval(abs(block%value)), tiny(1.0_dp))
            do node = 1, problem%model%n_nodes
               row = problem%equations%number(slot, node)
               if (row == 0) cycle
               i = find_root(root, node)
               if (held(i)) cycle
               ! heat is made inside, too
               if (field == field_temperature) fed(i) = huge(fed)
               if (abs(fed(i)) > epsilon(1.0_dp)*sum(abs(load)) .and. problem%fed_node == 0) then
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
   subroutine find_parts(problem, field, root)
      type(problem_t), intent(in) :: problem
      !> One of the fields of litz_fields
      integer, intent(in) :: field
      !> For each node one of its part nearer to the representative, which has itself (n_nodes)
      integer, intent(out) :: root(:)
      integer, allocatable :: pairs(:, :)
      integer :: i, k

      root = [(i, i=1, size(root))]
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%link(problem%domain_t, field, pairs)
         do k = 1, size(pairs, 2)
            call join(root, pairs(1, k), pairs(2, k))
         end do
      end do
   end subroutine find_parts

   !> Representative of the part that a node belongs to; paths are halved on the way.
   integer function find_root(root, node) result(i)
      !> As of `find_parts` (n_nodes)
      integer, intent(inout) :: root(:)
      !> Node
      integer, intent(in) :: node

      i = node
      do while (root(i) /= i)
         root(i) = root(root(i))
         i = root(i)
      end do
   end function find_root

   subroutine join(root, a, b)
      !> As for `find_root` (n_nodes)
      integer, intent(inout) :: root(:)
      !> Two nodes
      integer, intent(in) :: a, b
      integer :: i, j

      i = find_root(root, a)
      j = find_root(root, b)
      root(max(i, j)) = min(i, j)
   end subroutine join

end module litz_grounding
