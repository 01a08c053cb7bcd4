!> The unknowns as they stand in the iteration, and how they move.
module litz_iterate
   use litz_kinds, only: dp
   use litz_fields, only: fields, n_fields, first_slot, last_slot, field_displacement, motion_slots, temperature_slots
   use litz_linear_constraints, only: linear_constraints_t
   use litz_positions, only: agree
   use litz_rigid_bodies, only: rigid_bodies_t
   use litz_rotations, only: rotation_exp
   use litz_state, only: state_t
   implicit none
   private
   public :: iterate_t

   !> Of the lag of the temperatures that the mechanics sees an extrapolation takes up no less and no more
   real(dp), parameter :: least = 0.1_dp, most = 10

   type :: iterate_t
      !> Values (n_slots, n_nodes); those of rotations are the rotation vector when the increment began and the turns
      !> since, which distinguishes full turns
      real(dp), allocatable :: value(:, :)
      !> Sum of the corrections since the increment began (n_slots, n_nodes)
      real(dp), allocatable :: change(:, :)
      !> What is prescribed of the correction of this iteration (n_slots, n_nodes)
      real(dp), allocatable :: prescribed(:, :)
      !> Positions (3, n_nodes) [m] and rotations from the reference (3, 3, n_nodes) that belong to the values
      real(dp), allocatable :: x(:, :), rotation(:, :, :)
      !> Temperatures that the mechanics sees (n_nodes) [K]: those when motions began to take their turn
      real(dp), allocatable :: mechanical_temperature(:)
      !> By how much they lagged when their turn ended the last time (n_nodes) [K], and what of it they then took up
      real(dp), allocatable, private :: lag(:)
      real(dp), private :: taken_up = 1
      !> Positions when the increment began (3, n_nodes) [m]
      real(dp), allocatable :: x_start(:, :)
      !> Nodes that move with others
      type(rigid_bodies_t) :: bodies
      !> Unknowns that linear equations eliminate
      type(linear_constraints_t) :: constraints
   contains
      procedure :: start
      procedure :: move
      procedure :: carry
      procedure :: warm_mechanics
      procedure :: extrapolate
      procedure :: mechanics_lags
   end type iterate_t

contains

   !> Take over the last converged state.
   pure subroutine start(self, state, x_reference)
      class(iterate_t), intent(inout) :: self
      type(state_t), intent(in) :: state
      !> Positions in the reference configuration (3, n_nodes) [m]
      real(dp), intent(in) :: x_reference(:, :)

      self%change = 0*state%value
      self%prescribed = self%change
      self%value = state%value
      self%rotation = state%rotation
      self%x = x_reference + state%value(first_slot(field_displacement):last_slot(field_displacement), :)
      self%x_start = self%x
      if (allocated(self%lag)) deallocate (self%lag)
      self%taken_up = 1
   end subroutine start

   !> The mechanics does not see the present temperatures.
   pure logical function mechanics_lags(self)
      class(iterate_t), intent(in) :: self

      mechanics_lags = any(abs(self%value(temperature_slots(1), :) - self%mechanical_temperature) > 0)
   end function mechanics_lags

   !> Temperatures for the next turn of the mechanics, from those of its last two.
   pure subroutine extrapolate(self, temperature)
      class(iterate_t), intent(inout) :: self
      !> (n_nodes) [K]
      real(dp), intent(out) :: temperature(:)
      real(dp), dimension(size(temperature)) :: lag, change

      lag = self%value(temperature_slots(1), :) - self%mechanical_temperature
      if (allocated(self%lag)) then
         change = lag - self%lag
         if (dot_product(change, change) > 0) self%taken_up = min(most, max(least, &
            -self%taken_up*dot_product(self%lag, change)/dot_product(change, change)))
      end if
      self%lag = lag
      temperature = self%mechanical_temperature + self%taken_up*lag
   end subroutine extrapolate

   !> The mechanics sees the present temperatures.
   pure subroutine warm_mechanics(self)
      class(iterate_t), intent(inout) :: self

      self%mechanical_temperature = self%value(temperature_slots(1), :)
   end subroutine warm_mechanics

   !> Set the changes of what is no unknown of its own: what equations eliminate, and what moves with rigid bodies.
   pure subroutine carry(self, change)
      class(iterate_t), intent(in) :: self
      !> (n_slots, n_nodes) [m, rad, V, K]
      real(dp), intent(inout) :: change(:, :)

      call self%constraints%carry(change)
      call self%bodies%carry(self%x, change)
   end subroutine carry

   !> `q <- q + dq`: positions and potentials add up, rotations follow one another; what moves with other nodes is
   !> placed by these.
   pure subroutine move(self, state, x_reference, dq, first)
      class(iterate_t), intent(inout) :: self
      !> The state in which the increment began
      type(state_t), intent(in) :: state
      !> Positions in the reference configuration (3, n_nodes) [m]
      real(dp), intent(in) :: x_reference(:, :)
      !> Corrections, those of eliminated unknowns with those of the others (slots, n_nodes)
      real(dp), intent(in) :: dq(:, :)
      !> Slot of the first correction, which begins a field
      integer, intent(in) :: first
      integer :: field, node

      do field = 1, n_fields
         associate (a => first_slot(field), b => last_slot(field))
            if (a < first .or. a > first + size(dq, 1) - 1) cycle
            associate (dq_f => dq(a - first + 1:b - first + 1, :))
               if (fields(field)%is_rotation) then
                  do node = 1, size(dq, 2)
                     if (any(abs(dq_f(:, node)) > 0)) self%rotation(:, :, node) = &
                        matmul(rotation_exp(dq_f(:, node)), self%rotation(:, :, node))
                  end do
                  self%change(a:b, :) = self%change(a:b, :) + dq_f
                  self%value(a:b, :) = state%value(a:b, :) + self%change(a:b, :)
                  cycle
               end if
               self%value(a:b, :) = self%value(a:b, :) + dq_f
               if (field == field_displacement) then
                  self%x = self%x + dq_f
                  call agree(x_reference, self%x, self%value(a:b, :))
               end if
               self%change(a:b, :) = self%value(a:b, :) - state%value(a:b, :)
            end associate
         end associate
      end do
      call self%constraints%place(x_reference, state%value, self%x, self%value, self%change)
      if (first <= motion_slots(2)) call self%bodies%place(x_reference, state%value, self%x, self%rotation, &
         self%value, self%change)
   end subroutine move

end module litz_iterate
