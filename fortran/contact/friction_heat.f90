!> Contacts of wires that make heat of friction in steps over time.
module litz_friction_heat
   use litz_contact_points, only: contact_point_t, contact_set_t
   use litz_domain, only: domain_t
   use litz_fin, only: fin_parts
   use litz_heated_contacts, only: can_pass_heat
   use litz_kinds, only: dp
   use litz_rubbing, only: rubbing_t
   implicit none
   private
   public :: find_rubbing

contains

   !> A contact that has ended gives what it had in the last increment where it was then.
   subroutine find_rubbing(domain, set, found)
      type(domain_t), intent(in) :: domain
      type(contact_set_t), intent(in) :: set
      type(rubbing_t), allocatable, intent(out) :: found(:)
      logical :: goes_on(set%last_id)
      integer :: n

      allocate (found(size(set%points) + size(set%line_points) + size(set%converged) + size(set%converged_line_points)))
      n = 0
      goes_on = .false.
      call add_present(set%points)
      call add_present(set%line_points)
      call add_ended(set%converged)
      call add_ended(set%converged_line_points)
      found = found(:n)

   contains

      subroutine add_present(points)
         type(contact_point_t), intent(in) :: points(:)
         integer :: i

         do i = 1, size(points)
            associate (point => points(i))
               if (.not. point%closed) cycle
               if (.not. point%friction%dissipation + point%history%last_dissipation > 0) cycle
               if (point%id > 0) goes_on(point%id) = .true.
               call add(point, point%friction%dissipation)
            end associate
         end do
      end subroutine add_present

      subroutine add_ended(points)
         !> Of the last converged state
         type(contact_point_t), intent(in) :: points(:)
         integer :: i

         do i = 1, size(points)
            associate (point => points(i))
               if (.not. point%history%last_dissipation > 0) cycle
               if (goes_on(point%id)) cycle
               call add(point, 0.0_dp)
            end associate
         end do
      end subroutine add_ended

      subroutine add(point, work)
         type(contact_point_t), intent(in) :: point
         !> Of friction in this increment [J]
         real(dp), intent(in) :: work

         if (.not. can_pass_heat(domain, point)) return
         n = n + 1
         found(n) = rubbing_of(domain, point, work, point%history%last_dissipation)
      end subroutine add

   end subroutine find_rubbing

   type(rubbing_t) function rubbing_of(domain, point, work, work_before) result(rubbing)
      type(domain_t), intent(in) :: domain
      type(contact_point_t), intent(in) :: point
      !> Of friction in this increment and in the last one [J]
      real(dp), intent(in) :: work, work_before
      real(dp) :: unused(2)
      integer :: side

      rubbing%element = [point%element_bar, point%element]
      rubbing%xi = [point%xi_bar, point%xi]
      do side = 1, 2
         call fin_parts(domain%film_between_nodes(rubbing%element(side)), rubbing%xi(side), rubbing%part(:, side), &
            unused)
         rubbing%capacity(side) = domain%least_capacity(rubbing%element(side))
      end do
      associate (law => domain%model%interactions(domain%model%contact_pairs(point%pair)%interaction)%heat)
         rubbing%heat = law%friction_fraction*work
         rubbing%heat_before = law%friction_fraction*work_before
      end associate
   end function rubbing_of

end module litz_friction_heat
