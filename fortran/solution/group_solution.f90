!> Linear solution for the fields of one group at fixed values of the others.
module litz_group_solution
   use litz_kinds, only: dp
   use litz_errors, only: error_t
   use litz_fields, only: n_slots, field_of_slot, first_slot_of_group, last_slot_of_group
   use litz_problem, only: problem_t
   use litz_sparse_pattern, only: csr_multiply
   implicit none
   private
   public :: solve_for_group, has_mutual_tangent, hold_fields

   !> The squared error of the conjugate gradients over that of the start; and their steps at most
   real(dp), parameter :: accurate = (1.0e-14_dp)**2
   integer, parameter :: max_steps = 100

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
   end function has_mutual_tangent

   !> Leave the other fields of a group as they are: their equations become `x = 0`.
   pure subroutine hold_fields(problem, group, free, b)
      type(problem_t), intent(inout) :: problem
      !> One of the groups of litz_fields, and the field in it that moves
      integer, intent(in) :: group, free
      !> Forces (equations of the group)
      real(dp), intent(inout) :: b(:)
      logical :: is_held(size(b))
      integer :: row, position, slot

      is_held = .false.
      do slot = first_slot_of_group(group), last_slot_of_group(group)
         if (field_of_slot(slot) == free) cycle
         associate (number => problem%equations%number(slot, :))
            is_held(pack(number, number > 0)) = .true.
         end associate
      end do
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

   !> `K x = b` with the tangent `K` of the group; its own block of the matrix has been factored.
   !>
   !> Where cells of a term act on each other, `K` has more than that block: conjugate gradients with the block as
   !> preconditioner.
   subroutine solve_for_group(problem, group, b, x, error)
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
      if (allocated(error) .or. .not. has_mutual_tangent(problem, group)) return
      left = b
      direction = x
      x = 0
      defect = dot_product(left, direction)
      defect_allowed = accurate*defect
      do k = 1, max_steps
         if (.not. defect > defect_allowed) exit
         call multiply(problem, group, direction, product)
         step = defect/dot_product(direction, product)
         x = x + step*direction
         left = left - step*product
         call problem%scheme%solve_group(group, problem%matrix, left, correction, error)
         if (allocated(error)) return
         defect_before = defect
         defect = dot_product(left, correction)
         direction = correction + defect/defect_before*direction
      end do
   end subroutine solve_for_group

   !> The whole tangent of a group times values.
   subroutine multiply(problem, group, v, y)
      type(problem_t), intent(in) :: problem
      !> One of the groups of litz_fields
      integer, intent(in) :: group
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
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%add_mutual_tangent(group, value, force)
      end do
      y = y + problem%equations%gather(group, force)
   end subroutine multiply

end module litz_group_solution
