!> The terms of the equations of a model. A new one is registered here.
module litz_term_list
   use litz_beam_term, only: new_beam_term
   use litz_capacity_term, only: new_capacity_term
   use litz_conductor_term, only: new_conductor_term
   use litz_contact_heat_term, only: new_contact_heat_term
   use litz_contact_points, only: contact_set_t
   use litz_contact_term, only: contact_term_t
   use litz_distributed_load_term, only: new_distributed_load_term
   use litz_domain, only: domain_t
   use litz_equation_term, only: new_equation_term
   use litz_heat_term, only: new_heat_term
   use litz_lorentz_term, only: new_lorentz_term
   use litz_moment_term, only: moment_term_t
   use litz_radiation_term, only: radiation_term_t
   use litz_rigid_body_term, only: rigid_body_term_t
   use litz_stabilization_term, only: stabilization_term_t
   use litz_surface_heat_term, only: surface_heat_term_t
   use litz_surface_term, only: new_surface_term
   use litz_term, only: term_t, term_entry_t
   implicit none
   private
   public :: list_terms

contains

   !> All terms that the model has, in the order in which they are evaluated.
   subroutine list_terms(domain, contact, terms)
      type(domain_t), intent(in) :: domain
      type(contact_set_t), pointer, intent(in) :: contact
      type(term_entry_t), allocatable, intent(out) :: terms(:)

      allocate (terms(0))
      call add(new_beam_term(domain%model%n_elements))
      ! after the strains, before all that asks for currents
      call add(new_conductor_term(domain%elements%resistivity))
      call add(new_surface_term(domain))
      call add(new_heat_term(domain%model))
      call add(radiation_term_t())
      call add(new_capacity_term(domain%model))
      call add(new_distributed_load_term())
      call add(new_lorentz_term())
      call add(surface_heat_term_t())
      if (contact%present) call add(contact_term_t(contact))
      if (contact%present) call add(new_contact_heat_term(contact))
      ! after all that has unknowns of dependent nodes and makes forces on them
      call add(rigid_body_term_t())
      ! after all that makes moments
      call add(moment_term_t())
      call add(stabilization_term_t())
      ! after all that makes forces
      call add(new_equation_term(domain%iterate%constraints%n))

   contains

      subroutine add(term)
         class(term_t), intent(in) :: term
         type(term_entry_t), allocatable :: longer(:)
         integer :: i

         allocate (longer(size(terms) + 1))
         do i = 1, size(terms)
            call move_alloc(terms(i)%term, longer(i)%term)
         end do
         allocate (longer(size(longer))%term, source=term)
         call move_alloc(longer, terms)
      end subroutine add

   end subroutine list_terms

end module litz_term_list
