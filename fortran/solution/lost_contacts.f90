!> What is wrong with the contacts of a converged iterate, so that it is no solution.
module litz_lost_contacts
   use litz_contact_findings, only: finding_t, worse_of, finding_turned
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

      if (.not. problem%contact%present .and. size(problem%model%surface_pairs) == 0) return
      associate (model => problem%model, wires => problem%wires, elements => problem%elements, &
         contact => problem%contact, iterate => problem%iterate)
         call find_path(model, wires, elements, iterate%x_start, problem%state%rotation, iterate%x, iterate%rotation, &
            iterate%change(first_slot(field_rotation):last_slot(field_rotation), :), &
            may_touch(problem), path)
         worst = inspect_surfaces(problem%domain_t, path)
         if (path%turned_element > 0) worst = worse_of(worst, finding_t(finding_turned, &
            spread(path%turned_element, 1, 2)))
         if (.not. contact%present) return
         call find_departed_pairs(model, wires, contact, departed)
         worst = worse_of(worst, inspect_contacts(model, wires, elements, contact, iterate%x, iterate%rotation))
         worst = worse_of(worst, inspect_bends(model, wires, elements, contact, iterate%x, iterate%rotation, &
            allowed_penetration))
         if (path%turned_element == 0) worst = worse_of(worst, sweep_contacts(model, wires, elements, contact, &
            departed, path))
         worst = worse_of(worst, find_departed_contacts(model, wires, elements, contact, departed, &
            iterate%x, iterate%rotation))
         worst = worse_of(worst, find_departed_lines(model, wires, elements, contact, iterate%x, iterate%rotation))
         worst = worse_of(worst, find_unfollowed(model, wires, elements, contact, iterate%x_start, iterate%x))
      end associate
   end function find_lost_contacts

   !> Elements that a contact pair names, with wires or with a rigid surface (n_elements).
   pure function may_touch(problem) result(may)
      type(problem_t), intent(in) :: problem
      logical :: may(problem%model%n_elements)
      integer :: pair

      may = .false.
      if (problem%contact%present) may = any(problem%contact%in_bar .or. problem%contact%in_set, 2)
      do pair = 1, size(problem%model%surface_pairs)
         may(problem%model%element_sets(problem%model%surface_pairs(pair)%set)%members) = .true.
      end do
   end function may_touch

end module litz_lost_contacts
