!> *TRANSFORM: nodes whose supports, loads and equations are along axes of their own.
!>
!> Such a node gets a second one, of no element, which stands for its motions along these axes: what the deck says of
!> them is said of the second node, and linear constraints make the motions of the first one from those of the second.
!> Source: theory section 17.
module litz_read_transforms
   use litz_kinds, only: dp
   use litz_data_lines, only: read_only_line
   use litz_deck, only: token_t
   use litz_fields, only: field_displacement, field_rotation, last_dof
   use litz_model, only: model_t, local_axes_t
   use litz_reader, only: reader_t, fail_at, choice_of, keyword_of, n_cards_of, name_of, parameter_of
   use litz_rotations, only: cross
   use litz_sets, only: find_set
   use litz_text, only: to_text
   implicit none
   private
   public :: read_transforms

   !> Directions differ, and places are not those of the axis, beyond this part of their size
   real(dp), parameter :: smallest = 1.0e-8_dp

   !> The system of a card.
   type :: system_t
      !> R, C or S
      character(len=1) :: type = 'R'
      !> Points (3) [m]
      real(dp) :: a(3) = 0, b(3) = 0
      type(token_t) :: token
   end type system_t

contains

   !> After the steps, whose supports and loads say for which nodes axes are needed.
   subroutine read_transforms(self, model)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      type(system_t) :: systems(n_cards_of(self, 'TRANSFORM'))
      !> Of each node, 0: none (n_nodes)
      integer :: system_of(model%n_nodes)
      integer :: card, n

      allocate (model%local_axes(0))
      if (size(systems) == 0) return
      system_of = 0
      n = 0
      do card = 1, self%deck%n_cards
         if (keyword_of(self, card) /= 'TRANSFORM') cycle
         n = n + 1
         call read_system(self, card, systems(n))
         call claim_nodes(self, model, card, n, system_of)
      end do
      if (self%errors%count == 0) call find_axes(self, model, systems, system_of)
      if (self%errors%count == 0) call add_nodes(model)
   end subroutine read_transforms

   subroutine read_system(self, card, system)
      type(reader_t), intent(inout) :: self
      !> Index of the card
      integer, intent(in) :: card
      type(system_t), intent(out) :: system
      logical :: ok

      system%type = choice_of(self, card, 'TYPE')
      call read_only_line(self, card, ok)
      if (.not. ok) return
      system%token = self%values%token(1)
      system%a = self%values%real(1:3)
      system%b = self%values%real(4:6)
      associate (a => system%a, b => system%b)
         if (system%type == 'R') then
            if (.not. norm2(cross(a, b)) > smallest*norm2(a)*norm2(b)) call fail_at(self, system%token, &
               'the origin and the points a and b of a rectangular system must not lie on one line')
         else if (.not. norm2(b - a) > smallest*max(norm2(a), norm2(b))) then
            call fail_at(self, system%token, 'the points a and b are the same; the axis of the system leads from'// &
               ' a to b')
         end if
      end associate
   end subroutine read_system

   !> A node has one system at most.
   subroutine claim_nodes(self, model, card, system, system_of)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index of the card, and of its system
      integer, intent(in) :: card, system
      !> Of each node, 0: none (n_nodes)
      integer, intent(inout) :: system_of(:)
      type(token_t) :: token
      integer :: set, i

      token = parameter_of(self, card, 'NSET')
      call find_set(self, 'node', self%node_sets, token, set)
      if (set == 0) return
      associate (members => model%node_sets(set)%members)
         do i = 1, size(members)
            if (system_of(members(i)) > 0) then
               call fail_at(self, token, 'node '//to_text(model%node_id(members(i)))//' of '//name_of(self, token)// &
                  ' has a *TRANSFORM already; one system is possible')
               return
            end if
            system_of(members(i)) = system
         end do
      end associate
   end subroutine claim_nodes

   !> Axes of the nodes that have supports, loads or equations.
   subroutine find_axes(self, model, systems, system_of)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(inout) :: model
      type(system_t), intent(in) :: systems(:)
      !> Of each node, 0: none (n_nodes)
      integer, intent(in) :: system_of(:)
      !> First degree of freedom that is the node's own (n_nodes)
      integer :: first_dof(model%n_nodes)
      logical :: needed(model%n_nodes), ok
      integer, allocatable :: nodes(:)
      integer :: i, node

      call mark_needed(model, needed)
      first_dof = 1
      do i = 1, size(model%rigid_bodies)
         first_dof(model%rigid_bodies(i)%tied) = last_dof(field_rotation) + 1
         first_dof(model%rigid_bodies(i)%pinned) = last_dof(field_displacement) + 1
      end do
      nodes = pack([(i, i=1, model%n_nodes)], needed .and. system_of > 0 .and. first_dof <= last_dof(field_rotation))
      deallocate (model%local_axes)
      allocate (model%local_axes(size(nodes)))
      do i = 1, size(nodes)
         node = nodes(i)
         associate (system => systems(system_of(node)))
            model%local_axes(i)%node = node
            model%local_axes(i)%first_dof = first_dof(node)
            call axes_at(system, model%x(:, node), model%local_axes(i)%axes, ok)
            if (ok) cycle
            call fail_at(self, system%token, 'node '//to_text(model%node_id(node))// &
               ' lies on the axis of its *TRANSFORM, TYPE='//system%type//', where no direction is radial')
            return
         end associate
      end do
   end subroutine find_axes

   !> Nodes with supports, loads or terms of equations in degrees of freedom 1 to 6.
   subroutine mark_needed(model, needed)
      type(model_t), intent(in) :: model
      !> (n_nodes)
      logical, intent(out) :: needed(:)
      integer :: i

      needed = .false.
      do i = 1, size(model%steps)
         call mark(model%steps(i)%boundary%node, model%steps(i)%boundary%dof)
         call mark(model%steps(i)%load%node, model%steps(i)%load%dof)
      end do
      do i = 1, size(model%equations)
         call mark(model%equations(i)%node, model%equations(i)%dof)
      end do

   contains

      subroutine mark(node, dof)
         !> Nodes and their degrees of freedom in Abaqus's numbers (n)
         integer, intent(in) :: node(:), dof(:)
         integer :: k

         do k = 1, size(node)
            if (dof(k) <= last_dof(field_rotation)) needed(node(k)) = .true.
         end do
      end subroutine mark

   end subroutine mark_needed

   !> Axes of a system at a place.
   pure subroutine axes_at(system, x, axes, ok)
      type(system_t), intent(in) :: system
      !> [m]
      real(dp), intent(in) :: x(3)
      !> Unit vectors, as columns
      real(dp), intent(out) :: axes(3, 3)
      !> .false.: the place is on the axis of the system
      logical, intent(out) :: ok
      real(dp) :: axis(3), radius(3), around(3)

      ok = .true.
      if (system%type == 'R') then
         axes(:, 1) = system%a/norm2(system%a)
         axes(:, 3) = cross(system%a, system%b)/norm2(cross(system%a, system%b))
         axes(:, 2) = cross(axes(:, 3), axes(:, 1))
         return
      end if
      axis = (system%b - system%a)/norm2(system%b - system%a)
      radius = x - system%a
      around = cross(axis, radius)
      axes = 0
      ok = norm2(around) > smallest*max(norm2(x), norm2(system%a))
      if (.not. ok) return
      axes(:, 2) = around/norm2(around)
      if (system%type == 'S') then
         axes(:, 1) = radius/norm2(radius)
         axes(:, 3) = cross(axes(:, 1), axes(:, 2))
      else
         axes(:, 3) = axis
         axes(:, 1) = cross(axes(:, 2), axis)
      end if
   end subroutine axes_at

   !> The nodes that stand for motions along axes, and what is said of these.
   pure subroutine add_nodes(model)
      type(model_t), intent(inout) :: model
      !> The node that stands for the motions along the axes of each node; itself: none (n_nodes)
      integer :: along(model%n_nodes)
      integer, allocatable :: nodes(:)
      integer :: i

      nodes = model%local_axes%node
      along = [(i, i=1, model%n_nodes)]
      along(nodes) = model%n_nodes + [(i, i=1, size(nodes))]
      model%node_id = [model%node_id, model%node_id(nodes)]
      model%x = reshape([model%x, model%x(:, nodes)], [3, model%n_nodes + size(nodes)])
      model%n_nodes = model%n_nodes + size(nodes)
      do i = 1, size(model%steps)
         call redirect(model%steps(i)%boundary%node, model%steps(i)%boundary%dof)
         call redirect(model%steps(i)%load%node, model%steps(i)%load%dof)
      end do
      do i = 1, size(model%equations)
         call redirect(model%equations(i)%node, model%equations(i)%dof)
      end do

   contains

      pure subroutine redirect(node, dof)
         !> Nodes (n)
         integer, intent(inout) :: node(:)
         !> Their degrees of freedom in Abaqus's numbers (n)
         integer, intent(in) :: dof(:)
         integer :: k

         do k = 1, size(node)
            if (dof(k) <= last_dof(field_rotation)) node(k) = along(node(k))
         end do
      end subroutine redirect

   end subroutine add_nodes

end module litz_read_transforms
