!> How the unknowns of the iteration move.
module litz_iterate_motion
   use litz_kinds, only: dp
   use litz_fields, only: fields, n_fields, first_slot, last_slot, field_displacement
   use litz_problem, only: problem_t
   use litz_rotations, only: rotation_exp
   implicit none
   private
   public :: move_iterate

contains

   !> `q <- q + dq`: positions and potentials add up, rotations follow one another.
   subroutine move_iterate(problem, dq, first)
      type(problem_t), intent(inout) :: problem
      !> Corrections (slots, n_nodes)
      real(dp), intent(in) :: dq(:, :)
      !> Slot of the first correction, which begins a field
      integer, intent(in) :: first
      integer :: field, node

      associate (iterate => problem%iterate, state => problem%state)
         do field = 1, n_fields
            associate (a => first_slot(field), b => last_slot(field))
               if (a < first .or. a > first + size(dq, 1) - 1) cycle
               associate (dq_f => dq(a - first + 1:b - first + 1, :))
                  if (fields(field)%is_rotation) then
                     do node = 1, size(dq, 2)
                        if (any(abs(dq_f(:, node)) > 0)) iterate%rotation(:, :, node) = &
                           matmul(rotation_exp(dq_f(:, node)), iterate%rotation(:, :, node))
                     end do
                     iterate%change(a:b, :) = iterate%change(a:b, :) + dq_f
                     iterate%value(a:b, :) = state%value(a:b, :) + iterate%change(a:b, :)
                     cycle
                  else if (field == field_displacement) then
                     iterate%x = iterate%x + dq_f
                     iterate%value(a:b, :) = iterate%x - problem%model%x
                  else
                     iterate%value(a:b, :) = iterate%value(a:b, :) + dq_f
                  end if
                  iterate%change(a:b, :) = iterate%value(a:b, :) - state%value(a:b, :)
               end associate
            end associate
         end do
      end associate
   end subroutine move_iterate

end module litz_iterate_motion
