!> What contacts have done and hold at the end of an increment.
!>
!> Work is mean contact force times resolved interference, with the friction of a contact that begins to slip taken
!> along its path. The balance closes as the increments become small.
module litz_contact_energies
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_set_t, contact_point_t, clearance_of
   use litz_state, only: energies_t
   implicit none
   private
   public :: add_contact_energies

contains

   !> Energies at the end of an increment that has converged.
   pure subroutine add_contact_energies(contact, converged, points, energies)
      !> What is left of interference
      type(contact_set_t), intent(in) :: contact
      !> At the start of the increment, and at its end
      type(contact_point_t), intent(in) :: converged(:), points(:)
      type(energies_t), intent(inout) :: energies
      integer :: i

      do i = 1, size(converged)
         energies%work = energies%work + work_of_interference(contact, converged(i))
      end do
      do i = 1, size(points)
         associate (point => points(i))
            if (.not. point%closed) cycle
            energies%work = energies%work + work_of_interference(contact, point) + point%friction%work_beyond_mean
            energies%contact = energies%contact + point%at_gap%energy + point%history%elastic_energy &
               + point%friction%elastic_work
            energies%friction = energies%friction + point%friction%dissipation
         end associate
      end do
      ! what a contact held elastically when it opened is lost
      energies%friction = energies%friction + elastic_energy_lost(converged, points)
   end subroutine add_contact_energies

   !> Half of the work that resolving an interference does on one contact: its force at one end of the increment.
   pure real(dp) function work_of_interference(contact, point) result(work)
      type(contact_set_t), intent(in) :: contact
      type(contact_point_t), intent(in) :: point

      work = point%force*(clearance_of(point%fit, contact%converged_clearance(point%pair)) &
         - clearance_of(point%fit, contact%clearance(point%pair)))/2
   end function work_of_interference

   !> Elastic energy of friction at the start of the increment that no contact carries on.
   pure real(dp) function elastic_energy_lost(converged, points) result(energy)
      !> At the start of the increment, and at its end
      type(contact_point_t), intent(in) :: converged(:), points(:)

      energy = sum(converged%history%elastic_energy) - sum(points%history%elastic_energy, mask=points%closed)
   end function elastic_energy_lost

end module litz_contact_energies
