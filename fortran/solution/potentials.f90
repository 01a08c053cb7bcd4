!> Linear solution for the potentials at fixed displacements.
module litz_potentials
   use litz_kinds, only: dp
   use litz_equations, only: equations_t, system_t
   use litz_fields, only: group_electric, field_potential, first_slot, n_slots
   use litz_errors, only: error_t
   use litz_scheme, only: scheme_t
   use litz_shared_conductors, only: shared_conductors_t
   use litz_sparse_pattern, only: csr_multiply
   implicit none
   private
   public :: solve_potentials

   !> The squared error of the conjugate gradients over that of the start; and their steps at most
   real(dp), parameter :: accurate = (1.0e-14_dp)**2
   integer, parameter :: max_steps = 100

contains

   !> `K x = b` with the electric tangent `K`; the group's own block has been factored.
   !>
   !> Where contacts share elements, `K` has more than `K_ee`: conjugate gradients with `K_ee` as preconditioner.
   subroutine solve_potentials(scheme, matrix, equations, shared, b, x, error)
      type(scheme_t), intent(inout) :: scheme
      type(system_t), intent(in) :: matrix
      type(equations_t), intent(in) :: equations
      type(shared_conductors_t), intent(in) :: shared
      !> (equations of the group) [A]
      real(dp), intent(in) :: b(:)
      !> (equations of the group) [V]
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error
      real(dp), dimension(size(b)) :: left, correction, direction, product
      real(dp) :: defect, defect_before, defect_allowed, step
      integer :: k

      call scheme%solve_group(group_electric, matrix, b, x, error)
      if (allocated(error) .or. .not. shared%present) return
      left = b
      direction = x
      x = 0
      defect = dot_product(left, direction)
      defect_allowed = accurate*defect
      do k = 1, max_steps
         if (.not. defect > defect_allowed) exit
         call multiply(direction, product)
         step = defect/dot_product(direction, product)
         x = x + step*direction
         left = left - step*product
         call scheme%solve_group(group_electric, matrix, left, correction, error)
         if (allocated(error)) return
         defect_before = defect
         defect = dot_product(left, correction)
         direction = correction + defect/defect_before*direction
      end do

   contains

      subroutine multiply(v, y)
         !> Potentials of the free nodes (n) [V]
         real(dp), intent(in) :: v(:)
         !> Currents that leave the free nodes (n) [A]
         real(dp), intent(out) :: y(:)
         real(dp), dimension(n_slots, size(equations%number, 2)) :: potential, leaving

         call csr_multiply(matrix%block(group_electric, group_electric), v, y)
         potential = 0
         leaving = 0
         associate (slot => first_slot(field_potential))
            call equations%spread_to_nodes(group_electric, v, potential)
            call shared%add_product(potential(slot, :), leaving(slot, :))
            y = y + equations%gather(group_electric, leaving)
         end associate
      end subroutine multiply

   end subroutine solve_potentials

end module litz_potentials
