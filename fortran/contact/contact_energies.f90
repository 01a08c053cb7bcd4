!> What contacts have done and hold at the end of an increment.
!>
!> Work is mean contact force times resolved interference, with the friction of a contact that begins to slip taken
!> along its path. The balance closes as the increments become small.
module litz_contact_energies
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_set_t, contact_point_t, clearance_of
   use litz_element_library, only: elements_t, end_swelling, material_at, material_place_t
   use litz_hertz, only: effective_modulus
   use litz_model, only: model_t
   use litz_state, only: energies_t
   implicit none
   private
   public :: add_contact_energies, work_of_swelling, work_of_softening, work_on_surfaces, &
      softening_on_surfaces

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
            energies%contact = energies%contact + elastic_energy(point) + point%history%elastic_energy &
               + point%friction%elastic_work
            energies%friction = energies%friction + point%friction%dissipation
            energies%yielding = energies%yielding + point%yielded + point%settled + point%ploughed
         end associate
      end do
      ! what a contact held elastically when it opened is lost
      energies%friction = energies%friction + elastic_energy_lost(converged, points)
   end subroutine add_contact_energies

   !> What the normal force has done since first touch [J].
   elemental real(dp) function elastic_energy(point) result(energy)
      type(contact_point_t), intent(in) :: point

      energy = point%energy_ratio*point%at_gap%energy
   end function elastic_energy

   !> Half of the work that resolving an interference does on one contact: its force at one end of the increment.
   pure real(dp) function work_of_interference(contact, point) result(work)
      type(contact_set_t), intent(in) :: contact
      type(contact_point_t), intent(in) :: point

      work = point%force*(clearance_of(point%fit, contact%converged_clearance(point%pair)) &
         - clearance_of(point%fit, contact%clearance(point%pair)))/2
   end function work_of_interference

   !> What the change of the radii in an increment does on contacts: mean force times swelling at their places.
   pure real(dp) function work_of_swelling(model, elements, before, now, converged, points) result(work)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> Temperatures at the start of the increment, and at its end (n_nodes) [K]
      real(dp), intent(in) :: before(:), now(:)
      !> At the start of the increment, and at its end
      type(contact_point_t), intent(in) :: converged(:), points(:)
      real(dp) :: swelling(2, model%n_elements)
      integer :: i

      work = 0
      if (size(elements%heated) == 0) return
      swelling = 0
      do i = 1, size(elements%heated)
         swelling(:, elements%heated(i)) = end_swelling(model, elements, i, now) &
            - end_swelling(model, elements, i, before)
      end do
      do i = 1, size(converged)
         work = work + half_of_work(converged(i))
      end do
      do i = 1, size(points)
         if (points(i)%closed) work = work + half_of_work(points(i))
      end do

   contains

      pure real(dp) function half_of_work(point)
         type(contact_point_t), intent(in) :: point

         half_of_work = point%force/4*(dot_product([1 - point%xi_bar, 1 + point%xi_bar], &
            swelling(:, point%element_bar)) + dot_product([1 - point%xi, 1 + point%xi], swelling(:, point%element)))
      end function half_of_work

   end function work_of_swelling

   !> What the change of the elasticity in an increment does on contacts: their elastic energy goes with `E*` of their
   !> places where nothing moves. Source: theory (14.5).
   pure real(dp) function work_of_softening(model, elements, before, converged, points) result(work)
      type(model_t), intent(in) :: model
      !> At the temperatures of the end of the increment
      type(elements_t), intent(in) :: elements
      !> Temperatures at its start (n_nodes) [K]
      real(dp), intent(in) :: before(:)
      !> At the start of the increment, and at its end
      type(contact_point_t), intent(in) :: converged(:), points(:)
      integer :: i

      work = 0
      if (size(elements%heated) == 0) return
      do i = 1, size(converged)
         if (is_elastic(converged(i))) work = work + elastic_energy(converged(i))*(1/stiffer_before(converged(i)) &
            - 1)/2
      end do
      do i = 1, size(points)
         if (is_elastic(points(i))) work = work + elastic_energy(points(i))*(1 - stiffer_before(points(i)))/2
      end do

   contains

      pure logical function is_elastic(point)
         type(contact_point_t), intent(in) :: point

         associate (law => model%interactions(model%contact_pairs(point%pair)%interaction)%normal)
            is_elastic = point%at_gap%energy > 0 .and. .not. (law%is_straight .or. law%line_penalty() > 0)
         end associate
      end function is_elastic

      !> E* before over E* now.
      pure real(dp) function stiffer_before(point) result(ratio)
         type(contact_point_t), intent(in) :: point
         type(material_place_t) :: now(2), then(2)

         now = [material_at(model, elements, point%element_bar, point%xi_bar), &
            material_at(model, elements, point%element, point%xi)]
         then = [material_at(model, elements, point%element_bar, point%xi_bar, before), &
            material_at(model, elements, point%element, point%xi, before)]
         ratio = effective_modulus(then%young, then%poisson)/effective_modulus(now%young, now%poisson)
      end function stiffer_before

   end function work_of_softening

   !> The same of wires on rigid surfaces, which see the mean radius of an element.
   pure real(dp) function work_on_surfaces(model, elements, before, now, element, force) result(work)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> Temperatures at the start of the increment, and at its end (n_nodes) [K]
      real(dp), intent(in) :: before(:), now(:)
      !> Element of each contact (n)
      integer, intent(in) :: element(:)
      !> Mean of its forces at the start and at the end (n) [N]
      real(dp), intent(in) :: force(:)
      real(dp) :: swelling(model%n_elements)
      integer :: i

      work = 0
      if (size(elements%heated) == 0) return
      swelling = 0
      do i = 1, size(elements%heated)
         swelling(elements%heated(i)) = sum(end_swelling(model, elements, i, now) &
            - end_swelling(model, elements, i, before))/2
      end do
      work = dot_product(force, swelling(element))
   end function work_on_surfaces

   !> What the change of the elasticity does on contacts with rigid surfaces.
   pure real(dp) function softening_on_surfaces(model, elements, before, element, xi, energy_before, energy) &
      result(work)
      type(model_t), intent(in) :: model
      !> At the temperatures of the end of the increment
      type(elements_t), intent(in) :: elements
      !> Temperatures at its start (n_nodes) [K]
      real(dp), intent(in) :: before(:)
      !> Element of each contact (n)
      integer, intent(in) :: element(:)
      !> Place of its law in the element (n)
      real(dp), intent(in) :: xi(:)
      !> Its elastic energies at the start and at the end (n) [J]
      real(dp), intent(in) :: energy_before(:), energy(:)
      type(material_place_t) :: now, then
      real(dp) :: stiffer_before
      integer :: i

      work = 0
      if (size(elements%heated) == 0) return
      do i = 1, size(element)
         now = material_at(model, elements, element(i), xi(i))
         then = material_at(model, elements, element(i), xi(i), before)
         stiffer_before = then%young/(1 - then%poisson**2)*(1 - now%poisson**2)/now%young
         work = work + (energy_before(i)*(1/stiffer_before - 1) + energy(i)*(1 - stiffer_before))/2
      end do
   end function softening_on_surfaces

   !> Elastic energy of friction at the start of the increment that no contact carries on.
   pure real(dp) function elastic_energy_lost(converged, points) result(energy)
      !> At the start of the increment, and at its end
      type(contact_point_t), intent(in) :: converged(:), points(:)

      energy = sum(converged%history%elastic_energy) - sum(points%history%elastic_energy, mask=points%closed)
   end function elastic_energy_lost

end module litz_contact_energies
