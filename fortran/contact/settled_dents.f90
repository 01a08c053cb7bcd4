!> What shares that have been brought up to date change of the energy of wires that yield.
!>
!> Force and energy of a contact are those of its present share and far field, and of the dent as it is there. What
!> changes of them while nothing moves is no work. Over an increment the contact does the work `V - V_0` of its
!> potential `V`, the energy that comes back and what yielding has dissipated, with the shares of the end and the dent
!> of the start; `V_0` is that at the gap of the start. What it held then was not `V_0` but the energy of the shares of
!> then: the difference has been dissipated, or comes back out of what has been.
!>
!> Source: theory (15.22).
module litz_settled_dents
   use litz_contact_points, only: contact_point_t
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_normal_forces, only: apply_normal_law, is_lens
   implicit none
   private
   public :: settle_dents, remember_energies

contains

   !> Find `settled`, what they have dissipated so in an increment that has converged.
   subroutine settle_dents(model, elements, converged, points)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> At the start of the increment
      type(contact_point_t), intent(in) :: converged(:)
      !> At its end
      type(contact_point_t), intent(inout) :: points(:)
      type(contact_point_t) :: there(1)
      integer :: i

      do i = 1, size(points)
         associate (point => points(i), &
            law => model%interactions(model%contact_pairs(points(i)%pair)%interaction)%normal)
            point%settled = 0
            if (.not. law%yields() .or. point%predecessor == 0) cycle
            ! a lens that is elastic dissipates nothing; one that has yielded hands energy to places that have not
            if (.not. (point%dent_depth > 0 .or. point%lens_has_dent)) cycle
            if (point%line_place == 0 .and. .not. is_lens(law, point)) cycle
            associate (before => converged(point%predecessor))
               there = point
               there%gap = before%gap
               there%law_angle = before%held_angle
               there%law_sine = before%law_sine
               there%predicted = .false.
               there%yielded = 0
               if (there(1)%gap < 0) call apply_normal_law(model, elements, there)
               ! what the growth of the lens has changed of the energy is held, too
               point%settled = before%held_energy + (1 - point%energy_ratio)*point%at_gap%energy
               if (there(1)%gap < 0) point%settled = point%settled - there(1)%at_gap%energy - there(1)%yielded
            end associate
         end associate
      end do
   end subroutine settle_dents

   !> What contacts of a converged state hold, before their shares are brought up to date for the next increment.
   elemental subroutine remember_energies(point)
      type(contact_point_t), intent(inout) :: point

      point%held_energy = point%energy_ratio*point%at_gap%energy
      point%held_angle = point%law_angle
   end subroutine remember_energies

end module litz_settled_dents
