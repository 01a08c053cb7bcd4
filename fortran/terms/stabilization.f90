!> Damping of loose wires and of snaps: every free displacement and rotation of an increment is resisted a little.
!>
!> A node that moves by `du` in an increment `dt` of a step of length `T` is resisted by `s du T/dt`, a turn alike. What
!> stands still is not resisted, so that the end of a movement is an equilibrium without help; what a part that floats
!> does is determined. The work against it is `ALLSD`.
module litz_stabilization
   use litz_kinds, only: dp
   use litz_assembly, only: iterate_t, motion_slots
   use litz_equations, only: equations_t, system_t
   use litz_fields, only: group_mechanical, field_displacement, field_of_slot
   use litz_model, only: model_t
   use litz_scatter, only: forces_t, scatter
   implicit none
   private
   public :: damping_stiffness, assemble_stabilization

contains

   !> `s` against displacement [N/m] and against rotation [N m]: parts of the least stiffness of any element in tension
   !> and in bending.
   pure function damping_stiffness(model, length, factor, fraction) result(stiffness)
      type(model_t), intent(in) :: model
      !> Reference lengths of the elements (n_elements) [m]
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
   subroutine assemble_stabilization(stiffness, equations, increment, iterate, matrix, forces)
      !> Against displacement [N/m] and against rotation [N m] (2)
      real(dp), intent(in) :: stiffness(2)
      type(equations_t), intent(in) :: equations
      !> Prescribed increments of this iteration (n_slots, n_nodes)
      real(dp), intent(in) :: increment(:, :)
      type(iterate_t), intent(in) :: iterate
      type(system_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces
      real(dp), allocatable :: k(:, :, :), r(:, :)
      integer :: n, node, slot

      n = size(increment, 2)
      associate (first => motion_slots(1), last => motion_slots(2))
         allocate (k(last, last, n), r(last, n), source=0.0_dp)
         do node = 1, n
            do slot = first, last
               if (equations%number(slot, node) == 0) cycle
               associate (s => stiffness(merge(1, 2, field_of_slot(slot) == field_displacement)))
                  k(slot, slot, node) = s
                  r(slot, node) = s*iterate%change(slot, node)
                  forces%damping_work = forces%damping_work + s*iterate%change(slot, node)**2
               end associate
            end do
         end do
         call scatter(equations, reshape([(node, node=1, n)], [1, n]), motion_slots, motion_slots, k, increment, &
            matrix%block(group_mechanical, group_mechanical), forces, r)
         forces%damping(first:last, :) = r
      end associate
   end subroutine assemble_stabilization

end module litz_stabilization
