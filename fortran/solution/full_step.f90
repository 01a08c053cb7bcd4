!> One Newton step of motions, potentials and temperatures together.
!>
!> The whole tangent acts by its products: the blocks of the matrix, and what terms have beyond them. Preconditioner of
!> generalized minimal residuals is forward substitution through the blocks, motions before potentials and temperatures,
!> with the factors of the blocks on the diagonal. Source: theory section 13.
module litz_full_step
   use litz_kinds, only: dp
   use litz_errors, only: error_t
   use litz_fields, only: n_slots, n_groups, group_mechanical, group_transport, field_of_slot
   use litz_gmres, only: linear_map_t, gmres
   use litz_problem, only: problem_t
   use litz_sparse_pattern, only: csr_add_product
   implicit none
   private
   public :: factor_full, solve_full

   !> Residual of the linear equations over that of the start, and over what is allowed, which is enough; products at
   !> most
   real(dp), parameter :: accurate = 1.0e-4_dp, enough = 0.1_dp
   !> Of what a product is solved for
   real(dp), parameter :: accuracy = 0.01_dp*accurate
   integer, parameter :: max_products = 80

   type, extends(linear_map_t) :: full_map_t
      type(problem_t), pointer :: problem => null()
      !> Equations before those of each group, and of all
      integer :: start(n_groups + 1) = 0
      !> What residuals are measured by (equations)
      real(dp), allocatable :: scale(:)
      !> The factors have stood the test of a first solution
      logical :: is_sound = .false.
      !> Of a solution with a block
      type(error_t), allocatable :: error
   contains
      procedure :: apply => apply_tangent
      procedure :: precondition => substitute
   end type full_map_t

contains

   !> Factor both blocks on the diagonal.
   subroutine factor_full(problem, error)
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable, intent(out) :: error

      call problem%scheme%factor(problem%matrix, error)
      if (.not. allocated(error)) call problem%scheme%factor_group(group_transport, problem%matrix, error)
   end subroutine factor_full

   !> The corrections of all free unknowns.
   subroutine solve_full(problem, allowed, rhs, correction, error)
      type(problem_t), target, intent(inout) :: problem
      !> Residuals of the fields that are allowed (n_fields), and forces (n_slots, n_nodes)
      real(dp), intent(in) :: allowed(:), rhs(:, :)
      !> Set for the free unknowns (n_slots, n_nodes)
      real(dp), intent(inout) :: correction(:, :)
      type(error_t), allocatable, intent(out) :: error
      type(full_map_t) :: map
      real(dp), dimension(sum(problem%equations%count)) :: b, x
      real(dp) :: force(n_slots, problem%model%n_nodes)
      integer :: group

      map%problem => problem
      do group = 1, n_groups
         map%start(group + 1) = map%start(group) + problem%equations%count(group)
      end do
      allocate (map%scale(size(b)))
      call gather_all(map, spread(allowed(field_of_slot), 2, size(rhs, 2)), map%scale)
      ! a field in which nothing flows yet has no measure of its own
      where (.not. map%scale > 0) map%scale = 1
      force = -rhs
      call add_beyond_blocks(problem, problem%iterate%prescribed, force)
      call gather_all(map, -force, b)
      b = b/map%scale
      call gmres(map, b, max(accurate, enough/max(norm2(b), enough)), max_products, x)
      if (allocated(map%error)) then
         call move_alloc(map%error, error)
         return
      end if
      call spread_all(map, x, correction)
   end subroutine solve_full

   pure subroutine gather_all(map, nodal, entries)
      type(full_map_t), intent(in) :: map
      !> (n_slots, n_nodes)
      real(dp), intent(in) :: nodal(:, :)
      !> (equations)
      real(dp), intent(out) :: entries(:)
      integer :: group

      do group = 1, n_groups
         entries(map%start(group) + 1:map%start(group + 1)) = map%problem%equations%gather(group, nodal)
      end do
   end subroutine gather_all

   pure subroutine spread_all(map, entries, nodal)
      type(full_map_t), intent(in) :: map
      !> (equations)
      real(dp), intent(in) :: entries(:)
      !> (n_slots, n_nodes)
      real(dp), intent(inout) :: nodal(:, :)
      integer :: group

      do group = 1, n_groups
         call map%problem%equations%spread_to_nodes(group, entries(map%start(group) + 1:map%start(group + 1)), nodal)
      end do
   end subroutine spread_all

   !> Products of all blocks, and of what potentials and temperatures have beyond them.
   subroutine apply_tangent(self, x, y)
      class(full_map_t), intent(inout) :: self
      !> (equations)
      real(dp), intent(in) :: x(:)
      !> (equations)
      real(dp), intent(out) :: y(:)
      real(dp), dimension(n_slots, self%problem%model%n_nodes) :: value, force
      integer :: i, j

      y = 0
      do i = 1, n_groups
         do j = 1, n_groups
            call csr_add_product(self%problem%matrix%block(i, j), 1.0_dp, x(self%start(j) + 1:self%start(j + 1)), &
               y(self%start(i) + 1:self%start(i + 1)))
         end do
      end do
      value = 0
      force = 0
      call spread_all(self, x, value)
      call self%problem%iterate%carry(value)
      call add_beyond_blocks(self%problem, value, force)
      associate (y_t => y(self%start(group_transport) + 1:))
         y_t = y_t + self%problem%equations%gather(group_transport, force)
      end associate
      y = y/self%scale
   end subroutine apply_tangent

   !> What potentials and temperatures have beyond the blocks.
   subroutine add_beyond_blocks(problem, value, force)
      type(problem_t), intent(in) :: problem
      !> (n_slots, n_nodes)
      real(dp), intent(in) :: value(:, :)
      !> (n_slots, n_nodes)
      real(dp), intent(inout) :: force(:, :)
      integer :: i

      do i = 1, size(problem%terms)
         call problem%terms(i)%term%add_mutual_tangent(group_transport, accuracy, value, force)
      end do
      call problem%iterate%constraints%collect(force, 1)
   end subroutine add_beyond_blocks

   subroutine substitute(self, x, y)
      class(full_map_t), intent(inout) :: self
      !> (equations)
      real(dp), intent(in) :: x(:)
      !> (equations)
      real(dp), intent(out) :: y(:)
      type(error_t), allocatable :: error
      real(dp) :: left(size(x))

      if (allocated(self%error)) then
         y = 0
         return
      end if
      left = self%scale*x
      associate (u => [1, self%start(group_mechanical + 1)], t => [self%start(group_transport) + 1, size(x)], &
         matrix => self%problem%matrix)
         call solve_block(self, group_mechanical, left(u(1):u(2)), y(u(1):u(2)), error)
         if (.not. allocated(error)) then
            call csr_add_product(matrix%block(group_transport, group_mechanical), -1.0_dp, y(u(1):u(2)), &
               left(t(1):t(2)))
            call solve_block(self, group_transport, left(t(1):t(2)), y(t(1):t(2)), error)
         end if
      end associate
      self%is_sound = .true.
      if (allocated(error)) call move_alloc(error, self%error)
   end subroutine substitute

   !> The first solution with a factor tells whether that is singular.
   subroutine solve_block(self, group, b, x, error)
      class(full_map_t), intent(inout) :: self
      !> One of the groups of litz_fields
      integer, intent(in) :: group
      !> (equations of the group)
      real(dp), intent(in) :: b(:)
      !> (equations of the group)
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error

      if (self%is_sound) then
         call self%problem%scheme%precondition_group(group, b, x, error)
      else
         call self%problem%scheme%solve_group(group, self%problem%matrix, b, x, error)
      end if
   end subroutine solve_block

end module litz_full_step
