!> How much of a Newton step the contacts can bear: a linear step past the reach of its own linearisation would throw
!> wires through or far off each other.
module litz_contact_step
   use litz_kinds, only: dp
   use litz_contact_kinematics, only: n_motions
   use litz_contact_points, only: contact_point_t
   use litz_element_library, only: elements_t
   use litz_fields, only: motion_slots
   use litz_model, only: model_t
   implicit none
   private
   public :: bearable_fraction

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

end module litz_contact_step
