!> Conductors without a path to a prescribed potential.
!>
!> Their potential is not determined by the equations, but no current can flow either: one node of each such part is
!> held at the potential it has. That changes no current, and the potential of a wire that has lost its last contact
!> stays where it was.
module litz_grounding
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_set_t
   use litz_element_library, only: elements_t
   use litz_equations, only: equations_t, system_t
   use litz_errors, only: error_t, fail, exit_input
   use litz_fields, only: group_electric, field_potential, first_slot
   use litz_model, only: model_t
   implicit none
   private
   public :: ground_floating_conductors

contains

   !> Add a ground to the diagonal of the electric block for every part that floats.
   subroutine ground_floating_conductors(model, elements, contact, equations, fixed, current, matrix, error)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      type(equations_t), intent(in) :: equations
      !> The potential of the node is prescribed (n_nodes)
      logical, intent(in) :: fixed(:)
      !> Applied currents (n_nodes) [A]
      real(dp), intent(in) :: current(:)
      type(system_t), intent(inout) :: matrix
      type(error_t), allocatable, intent(out) :: error
      integer :: root(model%n_nodes), e, i, node, row, position
      logical :: held(model%n_nodes)
      real(dp) :: injected(model%n_nodes), scale
      character(len=16) :: number

      if (equations%count(group_electric) == 0) return
      root = [(i, i=1, model%n_nodes)]
      do e = 1, model%n_elements
         if (elements%resistivity(e) > 0) call join(root, model%connectivity(1, e), model%connectivity(2, e))
      end do
      do i = 1, size(contact%points)
         associate (point => contact%points(i))
            if (point%conductance > 0) call join(root, model%connectivity(1, point%element_bar), &
               model%connectivity(1, point%element))
         end associate
      end do
      held = .false.
      injected = 0
      do node = 1, model%n_nodes
         i = find_root(root, node)
         held(i) = held(i) .or. fixed(node)
         injected(i) = injected(i) + current(node)
      end do
      associate (block => matrix%block(group_electric, group_electric))
      scale = max(maxval(abs(block%value)), tiny(1.0_dp))
      do node = 1, model%n_nodes
         row = equations%number(first_slot(field_potential), node)
         if (row == 0) cycle
         i = find_root(root, node)
         if (held(i)) cycle
         if (abs(injected(i)) > epsilon(1.0_dp)*maxval(abs(current))) then
            if (.not. abs(current(node)) > 0) cycle
            write (number, '(i0)') model%node_id(node)
            error = fail(exit_input, 'a current is fed into the conductor at node '//trim(number)// &
               ', which has no path to a prescribed potential')
            return
         end if
         held(i) = .true.
         do position = block%row_start(row), block%row_start(row + 1) - 1
            if (block%column(position) == row) block%value(position) = block%value(position) + scale
         end do
      end do
      end associate
   end subroutine ground_floating_conductors

   !> Representative of the part that a node belongs to; paths are halved on the way.
   integer function find_root(root, node) result(i)
      !> For each node one of its part nearer to the representative, which has itself (n_nodes)
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
