!> What is wrong with the contacts of a converged iterate, so that it is no solution.
module litz_lost_contacts
   use litz_contact_findings, only: finding_t, worse_of
   use litz_contact_matching, only: find_unfollowed
   use litz_contact_net, only: inspect_contacts, allowed_penetration
   use litz_contact_path, only: contact_path_t, find_path
   use litz_contact_sweep, only: sweep_contacts
   use litz_departed_contacts, only: find_departed_pairs, find_departed_contacts, find_departed_lines
   use litz_fields, only: first_slot, last_slot, field_rotation
   use litz_problem, only: problem_t
   use litz_surface_findings, only: inspect_surfaces
   use litz_tight_bends, only: inspect_bends
   implicit none
   private
   public :: find_lost_contacts

contains

   !> The worst of wires that have passed through each other, overlap without a contact, or whose contact is not known
   !> any more; `finding_none`: there is none.
   type(finding_t) function find_lost_contacts(problem) result(worst)
      type(problem_t), intent(in) :: problem
      type(contact_path_t) :: path
      integer, allocatable :: departed(:, :)

      worst = inspect_surfaces(problem%domain_t)
      if (.not. problem%contact%present) return
      associate (model => problem%model, wires => problem%wires, elements => problem%elements, &
         contact => problem%contact, iterate => problem%iterate)
         call find_path(model, wires, elements, iterate%x_start, problem%state%rotation, iterate%x, iterate%rotation, &
            iterate%change(first_slot(field_rotation):last_slot(field_rotation), :), &
            any(contact%in_bar .or. contact%in_set, 2), path)
         call find_departed_pairs(model, wires, contact, departed)
         worst = worse_of(worst, inspect_contacts(model, wires, elements, contact, iterate%x, iterate%rotation))
         worst = worse_of(worst, inspect_bends(model, wires, elements, contact, iterate%x, iterate%rotation, &
            allowed_penetration))
         worst = worse_of(worst, sweep_contacts(model, wires, elements, contact, departed, path))
         worst = worse_of(worst, find_departed_contacts(model, wires, elements, contact, departed, &
            iterate%x, iterate%rotation))
         worst = worse_of(worst, find_departed_lines(model, wires, elements, contact, iterate%x, iterate%rotation))
         worst = worse_of(worst, find_unfollowed(model, wires, elements, contact, iterate%x_start, iterate%x))
      end associate
   end function find_lost_contacts

end module litz_lost_contacts
