!> Degrees of freedom that linear equations eliminate: `q_d = sum w_i q_i`. Source: theory section 17.
!>
!> Values of displacements, potentials and temperatures fulfil them exactly, rotations by their increments: with weights
!> of one between all three rotations of two nodes these turn alike. Those of a node with local axes are the motions
!> along these: `q = A q_local`, which is as exact for rotations, as axes do not turn.
module litz_linear_constraints
   use litz_kinds, only: dp
   use litz_fields, only: fields, n_slots, first_slot, field_displacement, field_of_slot, motion_slots, &
      rotation_slots, slot_of_dof
   use litz_model, only: model_t, local_axes_t, n_nodes_of_deck
   implicit none
   private
   public :: linear_constraints_t, new_linear_constraints

   type :: linear_constraints_t
      !> How many there are; node and slot of the unknown that each eliminates (n)
      integer :: n = 0
      integer, allocatable :: node(:), slot(:)
      !> Where the terms of each begin, and one more (n + 1); nodes, slots and weights of the terms
      integer, allocatable :: start(:), master_node(:), master_slot(:)
      real(dp), allocatable :: weight(:)
      !> Equation that eliminates an unknown, 0: none (n_slots, n_nodes)
      integer, allocatable :: of(:, :)
      !> Some unknown of the node is eliminated (n_nodes)
      logical, allocatable :: has_any(:)
      !> Rotations of the node are in equations that do not make it turn with another one (n_nodes)
      logical, allocatable :: turns_alone(:)
   contains
      procedure :: carry
      procedure :: collect
      procedure :: place
      procedure :: extend_cliques
   end type linear_constraints_t

contains

   !> Those of a model: its equations, and behind them those of local axes.
   pure type(linear_constraints_t) function new_linear_constraints(model) result(new)
      type(model_t), intent(in) :: model
      integer :: i, k

      allocate (new%node(0), new%slot(0), new%start(1), new%master_node(0), new%master_slot(0), new%weight(0))
      allocate (new%of(n_slots, model%n_nodes), source=0)
      allocate (new%has_any(model%n_nodes), new%turns_alone(model%n_nodes), source=.false.)
      new%start(1) = 1
      do i = 1, size(model%equations)
         associate (this => model%equations(i))
            call add(new, this%node(1), slot_of_dof(this%dof(1)), this%node(2:), &
               [(slot_of_dof(this%dof(k)), k=2, size(this%dof))], -this%coefficient(2:)/this%coefficient(1))
         end associate
      end do
      do i = 1, new%n
         call note_turns(new, i)
      end do
      if (.not. allocated(model%local_axes)) return
      do i = 1, size(model%local_axes)
         call add_local_axes(new, model%local_axes(i), n_nodes_of_deck(model) + i)
      end do
   end function new_linear_constraints

   !> One more.
   pure subroutine add(self, node, slot, nodes, slots, weights)
      type(linear_constraints_t), intent(inout) :: self
      !> Of the unknown that it eliminates
      integer, intent(in) :: node, slot
      !> Of the others in it (n)
      integer, intent(in) :: nodes(:), slots(:)
      !> Of these (n)
      real(dp), intent(in) :: weights(:)

      self%n = self%n + 1
      self%node = [self%node, node]
      self%slot = [self%slot, slot]
      self%master_node = [self%master_node, nodes]
      self%master_slot = [self%master_slot, slots]
      self%weight = [self%weight, weights]
      self%start = [self%start, self%start(self%n) + size(nodes)]
      self%of(slot, node) = self%n
      self%has_any(node) = .true.
   end subroutine add

   !> Motions of a node from those along its axes, or from what equations make of the latter.
   pure subroutine add_local_axes(self, local, along)
      type(linear_constraints_t), intent(inout) :: self
      type(local_axes_t), intent(in) :: local
      !> The node that has the motions along the axes
      integer, intent(in) :: along
      integer, allocatable :: nodes(:), slots(:)
      real(dp), allocatable :: weights(:)
      integer :: slot, first, i, k

      do slot = slot_of_dof(local%first_dof), motion_slots(2)
         first = first_slot(field_of_slot(slot))
         allocate (nodes(0), slots(0), weights(0))
         do k = 1, 3
            associate (weight => local%axes(slot - first + 1, k))
               if (.not. abs(weight) > 0) cycle
               i = self%of(first + k - 1, along)
               if (i == 0) then
                  nodes = [nodes, along]
                  slots = [slots, first + k - 1]
                  weights = [weights, weight]
               else
                  associate (a => self%start(i), b => self%start(i + 1) - 1)
                     nodes = [nodes, self%master_node(a:b)]
                     slots = [slots, self%master_slot(a:b)]
                     weights = [weights, weight*self%weight(a:b)]
                  end associate
               end if
            end associate
         end do
         call add(self, local%node, slot, nodes, slots, weights)
         deallocate (nodes, slots, weights)
      end do
      self%turns_alone(local%node) = self%turns_alone(along)
   end subroutine add_local_axes

   !> A node turns with another one where each of its rotations is that of the other; all others turn alone.
   pure subroutine note_turns(self, i)
      type(linear_constraints_t), intent(inout) :: self
      !> Equation
      integer, intent(in) :: i
      integer :: slot, other

      if (.not. fields(field_of_slot(self%slot(i)))%is_rotation) then
         associate (terms => [(other, other=self%start(i), self%start(i + 1) - 1)])
            do other = 1, size(terms)
               if (fields(field_of_slot(self%master_slot(terms(other))))%is_rotation) then
                 self%turns_alone(self%master_node(terms(other))) = .true.
               end if
            end do
         end associate
         return
      end if
      do slot = rotation_slots(1), rotation_slots(2)
         other = self%of(slot, self%node(i))
         if (other > 0) then
            associate (first => self%start(other))
               if (self%start(other + 1) == first + 1 .and. self%master_slot(first) == slot .and. &
                  .not. abs(self%weight(first) - 1) > 0 .and. &
                  self%master_node(first) == self%master_node(self%start(i))) cycle
            end associate
         end if
         self%turns_alone(self%node(i)) = .true.
         self%turns_alone(self%master_node(self%start(i):self%start(i + 1) - 1)) = .true.
         return
      end do
   end subroutine note_turns

   !> Small changes of eliminated unknowns, from those of the others.
   pure subroutine carry(self, change)
      class(linear_constraints_t), intent(in) :: self
      !> (n_slots, n_nodes)
      real(dp), intent(inout) :: change(:, :)
      integer :: i

      do i = 1, self%n
         change(self%slot(i), self%node(i)) = weighted_sum(self, i, change)
      end do
   end subroutine carry

   !> `sum w_i q_i` of an equation.
   pure real(dp) function weighted_sum(self, i, values)
      type(linear_constraints_t), intent(in) :: self
      !> Equation
      integer, intent(in) :: i
      !> (n_slots, n_nodes)
      real(dp), intent(in) :: values(:, :)
      integer :: k

      weighted_sum = 0
      do k = self%start(i), self%start(i + 1) - 1
         weighted_sum = weighted_sum + self%weight(k)*values(self%master_slot(k), self%master_node(k))
      end do
   end function weighted_sum

   !> Move forces on eliminated unknowns to the others.
   pure subroutine collect(self, force, first, absolute)
      class(linear_constraints_t), intent(in) :: self
      !> (n_slots, n_nodes)
      real(dp), intent(inout) :: force(:, :)
      !> The first slot that is moved
      integer, intent(in) :: first
      !> They are magnitudes, which add up; absent: they are not
      logical, intent(in), optional :: absolute
      real(dp) :: weight
      integer :: i, k

      do i = 1, self%n
         if (self%slot(i) < first) cycle
         associate (own => force(self%slot(i), self%node(i)))
            do k = self%start(i), self%start(i + 1) - 1
               weight = self%weight(k)
               if (present(absolute)) weight = abs(weight)
               associate (to => force(self%master_slot(k), self%master_node(k)))
                  to = to + weight*own
               end associate
            end do
            own = 0
         end associate
      end do
   end subroutine collect

   !> Set the eliminated values, exactly, whatever the way there; rotations have been turned by their increments.
   pure subroutine place(self, x_reference, start, x, value, change)
      class(linear_constraints_t), intent(in) :: self
      !> Positions in the reference configuration (3, n_nodes) [m]
      real(dp), intent(in) :: x_reference(:, :)
      !> Values of all unknowns when the increment began (n_slots, n_nodes)
      real(dp), intent(in) :: start(:, :)
      !> Positions (3, n_nodes) [m]
      real(dp), intent(inout) :: x(:, :)
      !> Values of all unknowns, and their change since the increment began (n_slots, n_nodes)
      real(dp), intent(inout) :: value(:, :), change(:, :)
      integer :: i

      do i = 1, self%n
         associate (slot => self%slot(i), node => self%node(i), field => field_of_slot(self%slot(i)))
            if (fields(field)%is_rotation) cycle
            value(slot, node) = weighted_sum(self, i, value)
            change(slot, node) = value(slot, node) - start(slot, node)
            if (field /= field_displacement) cycle
            associate (axis => slot - first_slot(field) + 1)
               x(axis, node) = x_reference(axis, node) + value(slot, node)
            end associate
         end associate
      end do
   end subroutine place

   !> What is coupled to eliminated unknowns is coupled to those of their equations, too.
   pure subroutine extend_cliques(self, start, members)
      class(linear_constraints_t), intent(in) :: self
      !> Where each group of nodes begins among the members, and one more (n_groups + 1); nodes of all groups
      integer, allocatable, intent(inout) :: start(:), members(:)
      integer, allocatable :: longer_start(:), longer(:), more(:)
      integer :: i, n, k

      allocate (longer_start(size(start)))
      n = size(members)
      do k = 1, size(members)
         if (self%has_any(members(k))) n = n + size(masters_of(self, members(k)))
      end do
      allocate (longer(n))
      n = 0
      do i = 1, size(start) - 1
         longer_start(i) = n + 1
         do k = start(i), start(i + 1) - 1
            n = n + 1
            longer(n) = members(k)
            if (.not. self%has_any(members(k))) cycle
            more = masters_of(self, members(k))
            longer(n + 1:n + size(more)) = more
            n = n + size(more)
         end do
      end do
      longer_start(size(start)) = n + 1
      call move_alloc(longer_start, start)
      call move_alloc(longer, members)
   end subroutine extend_cliques

   !> Nodes that the eliminated unknowns of a node depend on.
   pure function masters_of(self, node) result(masters)
      type(linear_constraints_t), intent(in) :: self
      !> Node
      integer, intent(in) :: node
      !> With repetitions (n)
      integer, allocatable :: masters(:)
      integer :: slot

      allocate (masters(0))
      do slot = 1, n_slots
         associate (i => self%of(slot, node))
            if (i > 0) masters = [masters, self%master_node(self%start(i):self%start(i + 1) - 1)]
         end associate
      end do
   end function masters_of

end module litz_linear_constraints
