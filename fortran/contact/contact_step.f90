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
   public :: bearable_fraction, predict_contacts, suppose_contacts, n_changed

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
      real(dp) :: dq(n_motions), warmer(4)
      integer :: i

      !$omp parallel do schedule(static) private(dq, warmer) if (size(points) >= worth_threads)
      do i = 1, size(points)
         call changes_of_nodes(model, step, points(i), dq, warmer)
         if (allocated(points(i)%friction_iteration)) call predict_friction(eta*dq, points(i)%friction_iteration)
         call predict_normal(eta, dq, warmer, points(i))
      end do
      !$omp end parallel do
   end subroutine predict_contacts

   !> The contacts are supposed to be as the whole step has them; what friction supposes stays.
   subroutine suppose_contacts(model, step, points)
      type(model_t), intent(in) :: model
      !> (n_slots, n_nodes)
      real(dp), intent(in) :: step(:, :)
      type(contact_point_t), intent(inout) :: points(:)
      real(dp) :: dq(n_motions), warmer(4)
      integer :: i

      !$omp parallel do schedule(static) private(dq, warmer) if (size(points) >= worth_threads)
      do i = 1, size(points)
         call changes_of_nodes(model, step, points(i), dq, warmer)
         call predict_normal(1.0_dp, dq, warmer, points(i))
      end do
      !$omp end parallel do
   end subroutine suppose_contacts

   !> Number of contacts that the whole step closes or opens against what the iteration has supposed.
   integer function n_changed(model, step, points)
      type(model_t), intent(in) :: model
      !> (n_slots, n_nodes)
      real(dp), intent(in) :: step(:, :)
      type(contact_point_t), intent(in) :: points(:)
      real(dp) :: dq(n_motions), warmer(4), gap, force
      integer :: i

      n_changed = 0
      !$omp parallel do schedule(static) private(dq, warmer, gap, force) reduction(+:n_changed) &
      !$omp if (size(points) >= worth_threads)
      do i = 1, size(points)
         if (.not. points(i)%weight > 0) cycle
         call changes_of_nodes(model, step, points(i), dq, warmer)
         call after_step(points(i), 1.0_dp, dq, warmer, gap, force)
         if (points(i)%active .neqv. gap < -points(i)%dent_depth) n_changed = n_changed + 1
      end do
      !$omp end parallel do
   end function n_changed

   !> What a step does to the nodes of a contact.
   pure subroutine changes_of_nodes(model, step, point, dq, warmer)
      type(model_t), intent(in) :: model
      !> (n_slots, n_nodes)
      real(dp), intent(in) :: step(:, :)
      type(contact_point_t), intent(in) :: point
      !> Motions (24) [m, rad] and temperatures (4) [K]
      real(dp), intent(out) :: dq(n_motions), warmer(4)
      integer :: nodes(4)

      nodes = [model%connectivity(:, point%element_bar), model%connectivity(:, point%element)]
      dq = reshape(step(motion_slots(1):motion_slots(2), nodes), [n_motions])
      warmer = step(temperature_slots(1), nodes)
   end subroutine changes_of_nodes

   !> Gap and force of a contact after a part of a step.
   pure subroutine after_step(point, eta, dq, warmer, gap, force)
      type(contact_point_t), intent(in) :: point
      !> Part of the step; what it does to the nodes: motions (24) [m, rad], temperatures (4) [K]
      real(dp), intent(in) :: eta, dq(n_motions), warmer(4)
      !> [m], and force [N]: of a point that the iteration has not supposed to press 0, of a place of a line what it was
      real(dp), intent(out) :: gap, force
      real(dp) :: dgap

      dgap = dot_product(point%kinematics%dgap, dq) + dot_product(point%dgap_dtemperature, warmer)
      if (point%line_place > 0) then
         gap = (1 - eta)*merge(point%predicted_gap, point%gap, point%predicted) + eta*(point%gap + dgap)
         force = point%mixed_force
         return
      end if
      gap = point%gap + eta*dgap
      force = 0
      if (.not. point%active) return
      force = (1 - eta)*point%mixed_force + eta*(point%iteration_force - point%stiffness*dgap &
         + point%turning%dforce*dot_product(point%kinematics%rows%dangle, dq) &
         + dot_product(point%dforce_dtemperature, warmer))
      ! a contact that would have to pull opens, even if the linearised law leaves it an overlap
      if (force <= 0) gap = max(gap, -point%dent_depth)
      ! one that presses stays closed: the line of a loading that is steeper than the way back ends above the dent
      if (force > 0 .and. point%dent_depth > 0) gap = min(gap, -(1 + 2*epsilon(force))*point%dent_depth)
      force = max(force, 0.0_dp)
   end subroutine after_step

   pure subroutine predict_normal(eta, dq, warmer, point)
      !> As in `after_step`
      real(dp), intent(in) :: eta, dq(n_motions), warmer(4)
      type(contact_point_t), intent(inout) :: point
      real(dp) :: gap, force

      call after_step(point, eta, dq, warmer, gap, force)
      point%predicted_gap = gap
      point%predicted = .true.
      if (point%active .and. point%line_place == 0) point%mixed_force = force
   end subroutine predict_normal

end module litz_contact_step
