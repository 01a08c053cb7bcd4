!> Linear solution for the fields of one group at fixed values of the others.
module litz_group_solution
   use litz_kinds, only: dp
   use litz_errors, only: error_t
   use litz_fields, only: n_slots, field_of_slot, first_slot_of_group, last_slot_of_group
   use litz_gmres, only: linear_map_t, gmres
   use litz_problem, only: problem_t
   use litz_sparse_pattern, only: csr_multiply
   implicit none
   private
   public :: solve_for_group, has_mutual_tangent, hold_fields

   !> The squared error of the conjugate gradients over that of the start; and their steps at most
   real(dp), parameter :: accurate = (1.0e-14_dp)**2
   integer, parameter :: max_steps = 100
   !> The residual of the generalized minimal residuals over that of the start, and where groups take turns anyway; and
   !> their steps at most
   real(dp), parameter :: accurate_residual = 1.0e-12_dp, accurate_in_turn = 1.0e-4_dp
   integer, parameter :: max_products = 200
   !> Of what a product is solved for: over those errors
   real(dp), parameter :: part_of_error = 0.01_dp

   !> The whole tangent of a group, with its own block of the matrix as preconditioner.
   type, extends(linear_map_t) :: group_map_t
      type(problem_t), pointer :: problem => null()
      integer :: group = 0
      !> Equations that are `x = 0` (equations of the group)
      logical, allocatable :: is_held(:)
      !> What residuals are measured by (equations of the group)
      real(dp), allocatable :: scale(:)
      !> Residual over that of the start
      real(dp) :: accuracy = accurate_residual
      !> Of a solution with the block
      type(error_t), allocatable :: error
   contains
      procedure :: apply => apply_tangent
      procedure :: precondition => solve_with_block
   end type group_map_t

contains

   !> Some term has a tangent beyond what the matrix of the group holds.
   logical function has_mutual_tangent(problem, group)
      type(problem_t), intent(in) :: problem
      !> One of the groups of litz_fields
      integer, intent(in) :: group
      integer :: i

      has_mutual_tangent = .false.
      do i = 1, size(problem%terms)
         if (problem%terms(i)%term%has_mutual_tangent(group)) has_mutual_tangent = .true.
      end do
      has_mutual_tangent = problem%processes%any(has_mutual_tangent)
   end function has_mutual_tangent

   !> Leave the other fields of a group as they are: their equations become `x = 0`.
   pure subroutine hold_fields(problem, group, free, b)
      type(problem_t), intent(inout) :: problem
      !> One of the groups of litz_fields, and the field in it that moves
      integer, intent(in) :: group, free
      !> Forces (equations of the group)
      real(dp), intent(inout) :: b(:)
      logical :: is_held(size(b))
      integer :: row, position

      is_held = held_equations(problem, group, free)
      associate (block => problem%matrix%block(group, group))
         do row = 1, block%n_rows
            do position = block%row_start(row), block%row_start(row + 1) - 1
               associate (column => block%column(position))
                  if (is_held(row) .or. is_held(column)) block%value(position) = merge(1, 0, row == column)
               end associate
            end do
         end do
      end associate
      where (is_held) b = 0
   end subroutine hold_fields

   !> Equations of a group of all its fields but one.
   pure function held_equations(problem, group, free) result(is_held)
      type(problem_t), intent(in) :: problem
      !> One of the groups of litz_fields, and the field in it that moves; 0: all do
      integer, intent(in) :: group, free
      logical :: is_held(problem%equations%count(group))
      integer :: slot

      is_held = .false.
      if (free == 0) return
      do slot = first_slot_of_group(group), last_slot_of_group(group)
         if (field_of_slot(slot) == free) cycle
         associate (number => problem%equations%number(slot, :))
            is_held(pack(number, number > 0)) = .true.
         end associate
      end do
   end function held_equations

   !> `K x = b` with the tangent `K` of the group; its own block of the matrix has been factored.
   !>
   !> Where cells of a term act on each other, `K` has more than that block, which then is the preconditioner: of
   !> conjugate gradients, or where `K` is not symmetric of generalized minimal residuals.
   subroutine solve_for_group(problem, group, free, allowed, b, x, error)
      type(problem_t), target, intent(inout) :: problem
      !> One of the groups of litz_fields, and the field in it that moves; 0: all do
      integer, intent(in) :: group, free
      !> Residuals of the fields that are allowed (n_fields)
      real(dp), intent(in) :: allowed(:)
      !> Forces (equations of the group)
      real(dp), intent(in) :: b(:)
      !> Values (equations of the group)
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error
      type(group_map_t) :: map
      real(dp) :: scale(n_slots, problem%model%n_nodes)

      if (.not. has_mutual_tangent(problem, group)) then
         call problem%scheme%solve_group(group, problem%matrix, b, x, error)
      else if (problem%matrix%symmetric(group)) then
         call solve_symmetric(problem, group, b, x, error)
      else
         map%problem => problem
         map%group = group
         map%is_held = held_equations(problem, group, free)
         scale = spread(allowed(field_of_slot), 2, size(scale, 2))
         map%scale = problem%equations%gather(group, scale)
         ! a field in which nothing flows yet has no measure of its own
         where (.not. map%scale > 0) map%scale = 1
         if (problem%scheme%is_swept) map%accuracy = accurate_in_turn
         call gmres(map, b/map%scale, map%accuracy, max_products, x)
         if (allocated(map%error)) call move_alloc(map%error, error)
      end if
   end subroutine solve_for_group

   subroutine apply_tangent(self, x, y)
      class(group_map_t), intent(inout) :: self
      !> (equations of the group)
      real(dp), intent(in) :: x(:)
      !> (equations of the group)
      real(dp), intent(out) :: y(:)

      call multiply(self%problem, self%group, part_of_error*self%accuracy, x, y)
      where (self%is_held) y = x
      y = y/self%scale
   end subroutine apply_tangent

   subroutine solve_with_block(self, x, y)
      class(group_map_t), intent(inout) :: self
      !> (equations of the group)
      real(dp), intent(in) :: x(:)
      !> (equations of the group)
      real(dp), intent(out) :: y(:)
      type(error_t), allocatable :: error

      call self%problem%scheme%solve_group(self%group, self%problem%matrix, self%scale*x, y, error)
      if (allocated(error)) call move_alloc(error, self%error)
   end subroutine solve_with_block

   !> Conjugate gradients.
   subroutine solve_symmetric(problem, group, b, x, error)
      type(problem_t), intent(inout) :: problem
      !> One of the groups of litz_fields
      integer, intent(in) :: group
      !> Forces (equations of the group)
      real(dp), intent(in) :: b(:)
      !> Values (equations of the group)
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error
      real(dp), dimension(size(b)) :: left, correction, direction, product
      real(dp) :: defect, defect_before, defect_allowed, step
      integer :: k

      call problem%scheme%solve_group(group, problem%matrix, b, x, error)
      if (allocated(error)) return
      left = b
      direction = x
      x = 0
      defect = dot_product(left, direction)
      defect_allowed = accurate*defect
      do k = 1, max_steps
         if (.not. defect > defect_allowed) exit
         call multiply(problem, group, part_of_error*sqrt(accurate), direction, product)
         step = defect/dot_product(direction, product)
         x = x + step*direction
         left = left - step*product
         call problem%scheme%solve_group(group, problem%matrix, left, correction, error)
         if (allocated(error)) return
         defect_before = defect
         defect = dot_product(left, correction)
         direction = correction + defect/defect_before*direction
      end do
   end subroutine solve_symmetric

   !> The whole tangent of a group times values.
   subroutine multiply(problem, group, accuracy, v, y)
      type(problem_t), intent(in) :: problem
      !> One of the groups of litz_fields
      integer, intent(in) :: group
      !> Of what is solved for within, relative
      real(dp), intent(in) :: accuracy
      !> Values of the free unknowns (equations of the group)
      real(dp), intent(in) :: v(:)
      !> Forces of the free unknowns (equations of the group)
      real(dp), intent(out) :: y(:)
      real(dp), dimension(n_slots, problem%model%n_nodes) :: value, force
      integer :: i

      call csr_multiply(problem%matrix%block(group, group), v, y)
      value = 0
      force = 0
      call problem%equations%spread_to_nodes(group, v, value)
      call problem%iterate%constraints%carry(value)
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%add_mutual_tangent(group, accuracy, value, force)
      end do
      call problem%iterate%constraints%collect(force, 1)
      y = y + problem%equations%gather(group, force)
   end subroutine multiply

end module litz_group_solution
