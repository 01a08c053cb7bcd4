!> *EQUATION: forces on unknowns that linear equations eliminate act on the others in these equations instead.
!>
!> This term comes after all that make forces. Source: theory section 17.
module litz_equation_term
   use litz_kinds, only: dp
   use litz_domain, only: domain_t
   use litz_errors, only: error_t
   use litz_fields, only: fields, field_of_slot, first_slot, group_mechanical, motion_slots, n_slots, slot_of_dof
   use litz_model, only: n_nodes_of_deck
   use litz_term, only: term_t
   implicit none
   private
   public :: equation_term_t, new_equation_term

   type, extends(term_t) :: equation_term_t
      !> What each equation holds its eliminated unknown by, over its weight (n) [N, N m, A, W]
      real(dp), allocatable :: force(:)
   contains
      procedure :: request_slots
      procedure :: evaluate
      procedure :: link
      procedure :: hold
      procedure :: accept
   end type equation_term_t

contains

   pure type(equation_term_t) function new_equation_term(n) result(term)
      !> Number of equations
      integer, intent(in) :: n

      allocate (term%force(n), source=0.0_dp)
   end function new_equation_term

   !> The unknowns are those that equations do not eliminate. Motions are unknowns in every step, held where it does not
   !> solve for them.
   subroutine request_slots(self, domain, exists)
      class(equation_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> (n_slots, n_nodes)
      logical, intent(inout) :: exists(:, :)
      integer :: i, k

      associate (constraints => domain%iterate%constraints)
         do i = 1, constraints%n
            ! motions that a step does not solve for are there, and held
            associate (field => field_of_slot(constraints%slot(i)))
               if (.not. domain%loading%solves(field) .and. fields(field)%group /= group_mechanical) cycle
            end associate
            do k = constraints%start(i), constraints%start(i + 1) - 1
               exists(constraints%master_slot(k), constraints%master_node(k)) = .true.
            end do
         end do
         where (constraints%of > 0) exists = .false.
      end associate
   end subroutine request_slots

   subroutine evaluate(self, domain, error)
      class(equation_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Never
      type(error_t), allocatable, intent(out) :: error
      integer :: first, i

      associate (constraints => domain%iterate%constraints, forces => domain%forces, load => domain%loading%load)
         if (constraints%n == 0) return
         ! rows of motions that stand have been moved already
         first = merge(motion_slots(2) + 1, 1, domain%motions_stand)
         do i = 1, constraints%n
            associate (slot => constraints%slot(i), node => constraints%node(i))
               if (slot < first) cycle
               self%force(i) = forces%internal(slot, node) - load(slot, node)
               forces%internal(slot, node) = self%force(i)
            end associate
         end do
         call constraints%collect(forces%internal, first)
         call constraints%collect(forces%iteration, first)
         call constraints%collect(forces%prescribed, first)
         call constraints%collect(forces%sensitivity, first, absolute=.true.)
         do i = 1, constraints%n
            associate (slot => constraints%slot(i), node => constraints%node(i))
               if (slot >= first) forces%internal(slot, node) = load(slot, node)
            end associate
         end do
      end associate
   end subroutine evaluate

   !> An equation leads the flux of its field from one of its nodes to the others.
   subroutine link(self, domain, field, pairs)
      class(equation_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> One of the fields of litz_fields
      integer, intent(in) :: field
      !> (2, pairs)
      integer, allocatable, intent(out) :: pairs(:, :)
      integer :: i, k

      allocate (pairs(2, 0))
      associate (constraints => domain%iterate%constraints)
         do i = 1, constraints%n
            if (constraints%slot(i) /= first_slot(field)) cycle
            do k = constraints%start(i), constraints%start(i + 1) - 1
               pairs = reshape([pairs, constraints%node(i), constraints%master_node(k)], [2, size(pairs, 2) + 1])
            end do
         end do
      end associate
   end subroutine link

   !> An equation whose coefficients have a sum determines the level of its field.
   subroutine hold(self, domain, field, held)
      class(equation_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> One of the fields of litz_fields
      integer, intent(in) :: field
      !> (n_nodes)
      logical, intent(inout) :: held(:)
      integer :: i

      associate (constraints => domain%iterate%constraints)
         do i = 1, constraints%n
            if (constraints%slot(i) /= first_slot(field)) cycle
            associate (weights => constraints%weight(constraints%start(i):constraints%start(i + 1) - 1))
               if (abs(1 - sum(weights)) > epsilon(1.0_dp)*size(weights)*maxval(abs(weights))) then
                 held(constraints%node(i)) = .true.
               end if
            end associate
         end do
      end associate
   end subroutine hold

   !> What an equation does to the nodes in it balances over all of them as its coefficients say.
   subroutine accept(self, domain)
      class(equation_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      real(dp) :: force(n_slots, domain%model%n_nodes)
      integer :: i

      associate (constraints => domain%iterate%constraints)
         if (constraints%n == 0) return
         force = 0
         do i = 1, constraints%n
            force(constraints%slot(i), constraints%node(i)) = -self%force(i)
         end do
         call constraints%collect(force, 1)
         do i = 1, constraints%n
            force(constraints%slot(i), constraints%node(i)) = self%force(i)
         end do
         domain%state%outer_force = domain%state%outer_force + force
      end associate
      call turn_to_global_axes(domain)
   end subroutine accept

   !> Results have what supports and loads along local axes do to a node as forces along the global ones.
   pure subroutine turn_to_global_axes(domain)
      type(domain_t), intent(inout) :: domain
      integer :: i, slot

      if (.not. allocated(domain%model%local_axes)) return
      associate (state => domain%state)
         do i = 1, size(domain%model%local_axes)
            associate (local => domain%model%local_axes(i), along => n_nodes_of_deck(domain%model) + i)
               do slot = slot_of_dof(local%first_dof), motion_slots(2), 3
                  associate (node => local%node, first => slot, last => slot + 2)
                     state%reaction(first:last, node) = matmul(local%axes, state%reaction(first:last, along))
                     state%load(first:last, node) = matmul(local%axes, state%load(first:last, along))
                     ! the equations have them, too
                     state%outer_force(first:last, node) = state%outer_force(first:last, node) &
                        - state%reaction(first:last, node) - state%load(first:last, node)
                  end associate
               end do
            end associate
         end do
      end associate
   end subroutine turn_to_global_axes

end module litz_equation_term
