!> What one process has of a model that several hold together: its own elements first, then copies of those of others
!> that its contacts touch, and the nodes of both.
module share_of_model
   use litz_communicator, only: communicator_t
   use litz_errors, only: error_t
   use litz_initial_contacts, only: find_initial_overlap
   use litz_kinds, only: dp
   use litz_loading, only: load_targets
   use litz_model, only: model_t, named_set_t, nodal_value_t
   use litz_problem, only: problem_t, prepare_problem
   use litz_state, only: contact_t, state_t
   use litz_steps, only: begin_step
   use litz_term_list, only: list_terms
   implicit none
   private
   public :: share_t, find_share, make_problem

   !> Elements of a wire beyond that of a contact, on either side
   integer, parameter :: neighbours = 2

   type :: share_t
      !> Elements of the model, own ones first, and how many these are; nodes of the model, ascending
      integer, allocatable :: elements(:), nodes(:)
      integer :: n_own = 0
      !> Process of each element of the model, and the one that this is, from 1
      integer, allocatable :: owner(:)
      integer :: process = 1
   contains
      procedure :: has_contact
   end type share_t

contains

   !> A contact belongs to the process of the smaller of its elements.
   pure logical function has_contact(self, contact)
      class(share_t), intent(in) :: self
      !> With the numbers of the model
      class(contact_t), intent(in) :: contact

      has_contact = self%owner(min(contact%element_bar, contact%element)) == self%process
   end function has_contact

   subroutine find_share(model, contacts, owner, process, share)
      type(model_t), intent(in) :: model
      type(contact_t), intent(in) :: contacts(:)
      integer, intent(in) :: owner(:), process
      type(share_t), intent(out) :: share
      logical :: is_copy(model%n_elements), is_here(model%n_nodes)
      integer :: i, k

      share%owner = owner
      share%process = process
      is_copy = .false.
      do i = 1, size(contacts)
         if (share%has_contact(contacts(i))) is_copy([contacts(i)%element_bar, contacts(i)%element]) = .true.
      end do
      ! contacts see how their wires go on
      do k = 1, neighbours
         is_here = .false.
         do i = 1, size(is_copy)
            if (is_copy(i)) is_here(model%connectivity(:, i)) = .true.
         end do
         is_copy = [(any(is_here(model%connectivity(:, i))), i=1, size(is_copy))]
      end do
      is_copy = is_copy .and. owner /= process
      share%elements = [pack([(i, i=1, size(owner))], owner == process), pack([(i, i=1, size(owner))], is_copy)]
      share%n_own = count(owner == process)
      is_here = .false.
      do i = 1, size(share%elements)
         is_here(model%connectivity(:, share%elements(i))) = .true.
      end do
      share%nodes = pack([(i, i=1, size(is_here))], is_here)
   end subroutine find_share

   !> The problem of this process in the state of the whole one, at the end of its step.
   subroutine make_problem(whole, share, processes, problem)
      type(problem_t), intent(in) :: whole
      type(share_t), intent(in) :: share
      class(communicator_t), intent(in) :: processes
      type(problem_t), intent(inout) :: problem
      type(model_t) :: model
      type(error_t), allocatable :: error
      real(dp), allocatable :: resistivity(:)
      integer :: i

      model = part_of(whole%model, share, processes)
      call prepare_problem(model, problem, processes)
      call find_initial_overlap(problem, error)
      if (allocated(error)) error stop 'overlap'
      call take_state(whole%state, share%nodes, problem%state)
      associate (step => problem%model%steps(1))
         call begin_step(problem, step, 0, error)
         if (allocated(error)) error stop 'step'
         call load_targets(problem%model, step, step%total, step%total, problem%loading)
         ! copies are for contacts alone: they have no stiffness, and conduct into no node
         problem%elements%stiffness(:, share%n_own + 1:) = 0
         allocate (resistivity, source=problem%elements%resistivity)
         problem%elements%resistivity(share%n_own + 1:) = 0
         call list_terms(problem%domain_t, problem%contact, problem%terms)
         problem%elements%resistivity = resistivity
         do i = 1, size(problem%terms)
            call problem%terms(i)%term%apply_load(problem%domain_t, step, step%total, whole%state%time_increment)
         end do
      end associate
   end subroutine make_problem

   subroutine take_state(whole, nodes, state)
      type(state_t), intent(in) :: whole
      integer, intent(in) :: nodes(:)
      type(state_t), intent(inout) :: state

      state%step = whole%step
      state%increment = whole%increment
      state%time = whole%time
      state%step_time = whole%step_time
      state%time_increment = whole%time_increment
      state%energies = whole%energies
      state%value = whole%value(:, nodes)
      state%rotation = whole%rotation(:, :, nodes)
      state%load = whole%load(:, nodes)
      state%reaction = whole%reaction(:, nodes)
      state%outer_force = whole%outer_force(:, nodes)
      state%damping = whole%damping(:, nodes)
      state%mechanical_temperature = whole%mechanical_temperature(nodes)
   end subroutine take_state

   !> Sets of nodes have those that belong to the process, so that each is in one.
   function part_of(whole, share, processes) result(model)
      type(model_t), intent(in) :: whole
      type(share_t), intent(in) :: share
      class(communicator_t), intent(in) :: processes
      type(model_t) :: model
      integer :: node_at(whole%n_nodes), element_at(whole%n_elements), own_at(whole%n_nodes), i

      node_at = 0
      own_at = 0
      do i = 1, size(share%nodes)
         node_at(share%nodes(i)) = i
         if (processes%owns(i)) own_at(share%nodes(i)) = i
      end do
      element_at = 0
      element_at(share%elements) = [(i, i=1, size(share%elements))]
      model = whole
      model%n_nodes = size(share%nodes)
      model%node_id = whole%node_id(share%nodes)
      model%x = whole%x(:, share%nodes)
      model%n_elements = size(share%elements)
      model%element_id = whole%element_id(share%elements)
      model%element_type = whole%element_type(share%elements)
      model%element_section = whole%element_section(share%elements)
      model%connectivity = reshape([(node_at(whole%connectivity(:, share%elements(i))), i=1, model%n_elements)], &
         [2, model%n_elements])
      do i = 1, size(model%node_sets)
         call renumber_set(own_at, model%node_sets(i))
      end do
      do i = 1, size(model%element_sets)
         ! totals are over own elements, and contacts find those of both
         call renumber_set(element_at, model%element_sets(i))
      end do
      do i = 1, size(model%steps)
         call renumber_values(node_at, model%steps(i)%boundary)
         call renumber_values(node_at, model%steps(i)%load)
         model%steps(i)%heat = whole%steps(i)%heat(share%elements)
      end do
   end function part_of

   pure subroutine renumber_set(place, set)
      integer, intent(in) :: place(:)
      type(named_set_t), intent(inout) :: set

      set%members = pack(place(set%members), place(set%members) > 0)
   end subroutine renumber_set

   pure subroutine renumber_values(place, values)
      integer, intent(in) :: place(:)
      type(nodal_value_t), allocatable, intent(inout) :: values(:)

      values = pack(values, place(values%node) > 0)
      values%node = place(values%node)
   end subroutine renumber_values

end module share_of_model
