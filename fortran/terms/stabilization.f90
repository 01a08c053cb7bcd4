!> Damping of loose wires and of snaps: every free displacement and rotation of an increment is resisted a little.
!>
!> A node that moves by `du` in an increment `dt` of a step of length `T` is resisted by `s du T/dt`, a turn alike. What
!> stands still is not resisted, so that the end of a movement is an equilibrium without help; what a part that floats
!> does is determined. The work against it is `ALLSD`.
module litz_stabilization
   use litz_kinds, only: dp
   use litz_assembly, only: iterate_t, forces_t, add_mechanical
   use litz_equations, only: equations_t
   use litz_linear_solver, only: system_matrix_t
   use litz_model, only: model_t
   implicit none
   private
   public :: damping_stiffness, assemble_stabilization

contains

   !> `s` against displacement [N/m] and against rotation [N m]: parts of the least stiffness of any element in tension
   !> and in bending.
   pure function damping_stiffness(model, length, factor, fraction) result(stiffness)
      type(model_t), intent(in) :: model
      !> Of the elements [m]
      real(dp), intent(in) :: length(:)
      !> As *CONTROLS has it, and `dt/T`
      real(dp), intent(in) :: factor, fraction
      real(dp) :: stiffness(2)
      integer :: e

      stiffness = huge(1.0_dp)
      do e = 1, model%n_elements
         associate (section => model%sections(model%element_section(e)))
            associate (young => model%materials(section%material)%young)
               stiffness(1) = min(stiffness(1), young*section%area/length(e))
               stiffness(2) = min(stiffness(2), young*min(section%i2, section%i3)/length(e))
            end associate
         end associate
      end do
      stiffness = factor/fraction*stiffness
   end function damping_stiffness

   !> Add the damping of what has moved since the increment began.
   subroutine assemble_stabilization(stiffness, equations, x_start, increment, iterate, matrix, forces)
      real(dp), intent(in) :: stiffness(2)
      type(equations_t), intent(in) :: equations
      !> Positions when the increment began (3, n_nodes) [m]
      real(dp), intent(in) :: x_start(:, :)
      !> Prescribed increments of this iteration (7, n_nodes)
      real(dp), intent(in) :: increment(:, :)
      type(iterate_t), intent(in) :: iterate
      type(system_matrix_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces
      real(dp), allocatable :: k(:, :, :), r(:, :)
      real(dp) :: s(6), moved(6)
      integer :: n, node, i

      n = size(x_start, 2)
      allocate (k(6, 6, n), r(6, n), source=0.0_dp)
      s = [spread(stiffness(1), 1, 3), spread(stiffness(2), 1, 3)]
      do node = 1, n
         moved = [iterate%x(:, node) - x_start(:, node), iterate%turn(:, node)]
         do i = 1, 6
            if (equations%mechanical(i, node) == 0) cycle
            k(i, i, node) = s(i)
            r(i, node) = s(i)*moved(i)
         end do
      end do
      call add_mechanical(equations, reshape([(node, node=1, n)], [1, n]), k, r, increment, matrix, forces)
      forces%damping = r
      forces%damping_work = sum(r**2/spread(s, 2, n))
   end subroutine assemble_stabilization

end module litz_stabilization
