!> What a Newton step does to contacts, and how much of it they can bear: a linear step past the reach of its own
!> linearisation would throw wires through or far off each other.
module litz_contact_step
   use litz_kinds, only: dp
   use litz_contact_kinematics, only: n_motions
   use litz_contact_points, only: contact_point_t
   use litz_element_library, only: elements_t
   use litz_fields, only: motion_slots, temperature_slots
   use litz_friction_iteration, only: predict_friction
   use litz_model, only: model_t
   use litz_parallel, only: worth_threads
   implicit none
   private
   public :: bearable_fraction, predict_contacts

   !> A step may take a crossing this far into contact, and off it, over the smaller radius
   real(dp), parameter :: reach_into = 1.5_dp, reach_off = 0.5_dp

contains

   !> The part of a step, at most 1, by which no crossing gets deeper than its reach, and none that is closed opens by
   !> more than its own. A crossing that is deep already, or open already, is not held back.
   pure real(dp) function bearable_fraction(model, elements, points, step) result(eta)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: points(:)
      !> Linear step of the unknowns (n_slots, n_nodes)
      real(dp), intent(in) :: step(:, :)
      real(dp) :: dgap, radius
      integer :: i

      eta = 1
      do i = 1, size(points)
         associate (point => points(i))
            if (model%interactions(model%contact_pairs(point%pair)%interaction)%unlimited_penetration) cycle
            dgap = change_of_gap(point)
            radius = minval(elements%radius([point%element_bar, point%element]))
            if (dgap < 0) then
               associate (limit => reach_into*radius)
                  if (point%gap > -limit/2 .and. point%gap + dgap < -limit) eta = min(eta, (point%gap + limit)/(-dgap))
               end associate
            else if (point%gap <= 0 .and. point%kinematics%distance > 0) then
               associate (limit => reach_off*radius)
                  if (point%gap + dgap > limit) eta = min(eta, max(limit, -point%gap)/dgap)
               end associate
            end if
         end associate
      end do

   contains

      pure real(dp) function change_of_gap(point)
         type(contact_point_t), intent(in) :: point
         integer :: nodes(4)

         nodes = [model%connectivity(:, point%element_bar), model%connectivity(:, point%element)]
         change_of_gap = dot_product(point%kinematics%dgap, &
            reshape(step(motion_slots(1):motion_slots(2), nodes), [n_motions]))
      end function change_of_gap

   end function bearable_fraction

   !> Take each point's force and gap along with the step `eta dq` of the unknowns.
   subroutine predict_contacts(model, eta, step, points)
      type(model_t), intent(in) :: model
      !> Fraction of the step that is taken, and the step (n_slots, n_nodes)
      real(dp), intent(in) :: eta, step(:, :)
      type(contact_point_t), intent(inout) :: points(:)
      real(dp) :: dq(n_motions), warmer(4), dgap, force
      integer :: i, nodes(4)

      !$omp parallel do schedule(static) private(dq, warmer, dgap, force, nodes) if (size(points) >= worth_threads)
      do i = 1, size(points)
         associate (point => points(i))
            nodes = [model%connectivity(:, point%element_bar), model%connectivity(:, point%element)]
            dq = reshape(step(motion_slots(1):motion_slots(2), nodes), [n_motions])
            warmer = step(temperature_slots(1), nodes)
            dgap = dot_product(point%kinematics%dgap, dq) + dot_product(point%dgap_dtemperature, warmer)
            if (allocated(point%friction_iteration)) call predict_friction(eta*dq, point%friction_iteration)
            if (point%line_place > 0) then
               if (.not. point%predicted) point%predicted_gap = point%gap
               point%predicted_gap = (1 - eta)*point%predicted_gap + eta*(point%gap + dgap)
               point%predicted = .true.
               cycle
            end if
            point%predicted = .true.
            point%predicted_gap = point%gap + eta*dgap
            if (.not. point%active) cycle
            force = (1 - eta)*point%mixed_force + eta*(point%iteration_force - point%stiffness*dgap &
               + point%turning%dforce*dot_product(point%kinematics%rows%dangle, dq) &
               + dot_product(point%dforce_dtemperature, warmer))
            ! a contact that would have to pull opens, even if the linearised law leaves it an overlap
            if (force <= 0) point%predicted_gap = max(point%predicted_gap, -point%dent_depth)
            ! one that presses stays closed: the line of a loading that is steeper than the way back ends above the dent
            if (force > 0 .and. point%dent_depth > 0) point%predicted_gap = min(point%predicted_gap, &
               -(1 + 2*epsilon(force))*point%dent_depth)
            point%mixed_force = max(force, 0.0_dp)
         end associate
      end do
      !$omp end parallel do
   end subroutine predict_contacts

end module litz_contact_step
