!> Heat of friction in steps over time, as its work enters the rate of the enthalpy.
!>
!> The enthalpy less the work of friction changes by the flow of heat alone, and BDF2 takes this difference: of the
!> works D of the last two increments of a contact comes
!>
!>     (a D_n - b D_(n-1))/dt                                                                                       (1)
!>
!> to the nodes of its wires, with the weights of the enthalpy, so that over a step the wires take up all that friction
!> has done and no more, whatever the increments. Of (1) the spots and the ledger have D_n/dt; the rest is here. Where
!> friction sets in or ends, (1) would be far from the rate of either increment, and such an increment takes backward
!> Euler, b = 0. Source: theory section 13.
module litz_friction_heat
   use litz_contact_points, only: contact_point_t, contact_set_t
   use litz_domain, only: domain_t
   use litz_fields, only: temperature_slots
   use litz_heated_contacts, only: can_pass_heat
   use litz_kinds, only: dp
   implicit none
   private
   public :: rubbing_t, find_rubbing, is_abrupt, add_difference

   !> The rate at a contact has jumped when it changes by this part of the larger one; contacts of less than this part
   !> of all heat do not count
   real(dp), parameter :: largest_change = 0.5_dp, least_part = 0.01_dp

   !> A contact that has friction in this increment or had it in the last one.
   type :: rubbing_t
      !> Both elements, and the places in them, barred first
      integer :: element(2) = 0
      real(dp) :: xi(2) = 0
      !> Heat that friction makes in this increment and made in the last one [J]
      real(dp) :: heat = 0, heat_before = 0
   end type rubbing_t

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

      rubbing%element = [point%element_bar, point%element]
      rubbing%xi = [point%xi_bar, point%xi]
      associate (law => domain%model%interactions(domain%model%contact_pairs(point%pair)%interaction)%heat)
         rubbing%heat = law%friction_fraction*work
         rubbing%heat_before = law%friction_fraction*work_before
      end associate
   end function rubbing_of

   !> Friction sets in or ends at a contact that matters.
   pure logical function is_abrupt(rubbing, increment, before)
      type(rubbing_t), intent(in) :: rubbing(:)
      !> This increment and the last one [s]
      real(dp), intent(in) :: increment, before
      real(dp), dimension(size(rubbing)) :: now, earlier

      now = rubbing%heat/increment
      earlier = rubbing%heat_before/before
      is_abrupt = any(abs(now - earlier) > largest_change*max(now, earlier) .and. max(now, earlier) > &
         least_part*sum(max(now, earlier)))
   end function is_abrupt

   !> What the nodes get of (1) beyond the rate of this increment; `made` is the same by elements.
   pure subroutine add_difference(rubbing, connectivity, weights, increment, leaving, made)
      type(rubbing_t), intent(in) :: rubbing(:)
      !> Nodes of the elements (2, n_elements)
      integer, intent(in) :: connectivity(:, :)
      !> a and b of (1)
      real(dp), intent(in) :: weights(2)
      !> [s]
      real(dp), intent(in) :: increment
      !> Heat that leaves the nodes (n_nodes) [W]
      real(dp), intent(inout) :: leaving(:)
      !> (n_elements) [W]
      real(dp), intent(inout) :: made(:)
      real(dp) :: heat
      integer :: i, side

      do i = 1, size(rubbing)
         heat = ((weights(1) - 1)*rubbing(i)%heat - weights(2)*rubbing(i)%heat_before)/increment
         do side = 1, 2
            associate (xi => rubbing(i)%xi(side), e => rubbing(i)%element(side))
               associate (nodes => connectivity(:, e))
                  leaving(nodes) = leaving(nodes) - heat/2*[1 - xi, 1 + xi]/2
               end associate
               made(e) = made(e) + heat/2
            end associate
         end do
      end do
   end subroutine add_difference

end module litz_friction_heat
