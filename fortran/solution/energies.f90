!> The energy balance of a run: what the supports and loads have done, what is stored, what friction has made heat.
!>
!> Work is the sum over the increments of mean force times displacement (mean moment times rotation, mean contact force
!> times resolved interference), with the friction of a contact that begins to slip taken along its path. The balance
!> closes as the increments become small. Electric energy has its own balance, in every increment.
module litz_energies
   use litz_kinds, only: dp
   use litz_assembly, only: iterate_t, motion_slots
   use litz_contact_points, only: contact_set_t, contact_point_t, clearance_of
   use litz_loading, only: loading_t
   use litz_state, only: state_t, energies_t
   implicit none
   private
   public :: advanced_energies

contains

   !> Energies at the end of an increment that has converged; `state` is still that of its start.
   pure function advanced_energies(state, iterate, loading, internal, strain_energy, contact) result(energies)
      type(state_t), intent(in) :: state
      type(iterate_t), intent(in) :: iterate
      type(loading_t), intent(in) :: loading
      !> Internal forces (n_slots, n_nodes) [N, N m, A], and energy of the beams [J]
      real(dp), intent(in) :: internal(:, :), strain_energy
      type(contact_set_t), intent(in) :: contact
      type(energies_t) :: energies
      integer :: i

      energies%work = state%energies%work + work_of_increment(state, iterate, loading, internal)
      do i = 1, size(contact%converged)
         energies%work = energies%work + work_of_interference(contact, contact%converged(i))
      end do
      energies%strain = strain_energy
      energies%friction = state%energies%friction
      do i = 1, size(contact%points)
         associate (point => contact%points(i))
            if (.not. point%closed) cycle
            energies%work = energies%work + work_of_interference(contact, point) + point%friction%work_beyond_mean
            energies%contact = energies%contact + point%at_gap%energy + point%history%elastic_energy &
               + point%friction%elastic_work
            energies%friction = energies%friction + point%friction%dissipation
         end associate
      end do
      ! what a contact held elastically when it opened is lost
      energies%friction = energies%friction + elastic_energy_lost(contact)
   end function advanced_energies

   pure real(dp) function work_of_increment(state, iterate, loading, internal) result(work)
      type(state_t), intent(in) :: state
      type(iterate_t), intent(in) :: iterate
      type(loading_t), intent(in) :: loading
      !> Internal forces (n_slots, n_nodes) [N, N m]
      real(dp), intent(in) :: internal(:, :)
      integer :: node
      real(dp), dimension(motion_slots(2)) :: outer_start, outer

      work = 0
      do node = 1, size(internal, 2)
         associate (first => motion_slots(1), last => motion_slots(2))
            outer_start = state%reaction(first:last, node) + state%load(first:last, node)
            outer = merge(internal(first:last, node), loading%load(first:last, node), loading%fixed(first:last, node))
            work = work + dot_product(outer_start + outer, iterate%change(first:last, node))/2
         end associate
      end do
   end function work_of_increment

   !> Half of the work that resolving an interference does on one contact: its force at one end of the increment.
   pure real(dp) function work_of_interference(contact, point) result(work)
      type(contact_set_t), intent(in) :: contact
      type(contact_point_t), intent(in) :: point

      work = point%force*(clearance_of(point%fit, contact%converged_clearance(point%pair)) &
         - clearance_of(point%fit, contact%clearance(point%pair)))/2
   end function work_of_interference

   !> Elastic energy of friction at the start of the increment that no contact carries on.
   pure real(dp) function elastic_energy_lost(contact) result(energy)
      type(contact_set_t), intent(in) :: contact

      energy = sum(contact%converged%history%elastic_energy) &
         - sum(contact%points%history%elastic_energy, mask=contact%points%closed)
   end function elastic_energy_lost

end module litz_energies
