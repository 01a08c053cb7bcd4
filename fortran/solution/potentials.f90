!> Linear solution for the potentials at fixed displacements.
module litz_potentials
   use litz_kinds, only: dp
   use litz_equations, only: equations_t
   use litz_errors, only: error_t
   use litz_linear_solver, only: linear_solver_t, system_matrix_t
   use litz_shared_conductors, only: shared_conductors_t
   use litz_sparse_pattern, only: csr_multiply
   implicit none
   private
   public :: solve_potentials

   !> The squared error of the conjugate gradients over that of the start; and their steps at most
   real(dp), parameter :: accurate = (1.0e-14_dp)**2
   integer, parameter :: most_steps = 100

contains

   !> `K x = b` with the electric tangent `K`; the factor of `matrix%ee` is at hand.
   !>
   !> Where contacts share elements, `K` has more than `K_ee`: conjugate gradients with `K_ee` as preconditioner.
   subroutine solve_potentials(solver, matrix, equations, shared, b, x, error)
      class(linear_solver_t), intent(inout) :: solver
      type(system_matrix_t), intent(in) :: matrix
      type(equations_t), intent(in) :: equations
      type(shared_conductors_t), intent(in) :: shared
      !> (n_electric) [A]
      real(dp), intent(in) :: b(:)
      !> (n_electric) [V]
      real(dp), intent(out) :: x(:)
      type(error_t), allocatable, intent(out) :: error
      real(dp), dimension(size(b)) :: left, correction, direction, product
      real(dp) :: defect, defect_before, defect_allowed, step
      integer :: k

      call solver%solve_electric(matrix, b, x, error)
      if (allocated(error) .or. .not. shared%present) return
      left = b
      direction = x
      x = 0
      defect = dot_product(left, direction)
      defect_allowed = accurate*defect
      do k = 1, most_steps
         if (.not. defect > defect_allowed) exit
         call multiply(direction, product)
         step = defect/dot_product(direction, product)
         x = x + step*direction
         left = left - step*product
         call solver%solve_electric(matrix, left, correction, error)
         if (allocated(error)) return
         defect_before = defect
         defect = dot_product(left, correction)
         direction = correction + defect/defect_before*direction
      end do

   contains

      subroutine multiply(v, y)
         real(dp), intent(in) :: v(:)
         real(dp), intent(out) :: y(:)
         real(dp) :: potential(size(equations%electric)), leaving(size(equations%electric))
         integer :: node

         call csr_multiply(matrix%ee, v, y)
         potential = 0
         leaving = 0
         do node = 1, size(potential)
            if (equations%electric(node) > 0) potential(node) = v(equations%electric(node))
         end do
         call shared%add_product(potential, leaving)
         do node = 1, size(potential)
            associate (equation => equations%electric(node))
               if (equation > 0) y(equation) = y(equation) + leaving(node)
            end associate
         end do
      end subroutine multiply

   end subroutine solve_potentials

end module litz_potentials
