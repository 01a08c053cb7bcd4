!> The heat of contacts that the temperatures within elements have followed. Source: theory section 13, (13.13).
module litz_settled_heats
   use litz_heat_of_contacts, only: contact_heat_t
   use litz_heat_within, only: slow_and_fast
   use litz_heated_contacts, only: left_of_settled
   use litz_kinds, only: dp
   implicit none
   private
   public :: settled_heat

   !> 1 - xi^2 of a contact that is as good as at a node, where nothing settles
   real(dp), parameter :: least_rise = 1.0e-6_dp

contains

   !> Heat in whose steady state the temperatures at a contact are when the increment has ended, slow and fast part,
   !> barred and unbarred (2, 2) [W].
   pure function settled_heat(self, i) result(heat)
      type(contact_heat_t), intent(in) :: self
      !> Contact
      integer, intent(in) :: i
      real(dp) :: heat(2, 2), steady
      integer :: side

      heat = 0
      do side = 1, 2
         associate (contact => self%contacts(i), element => self%elements(self%ends%place_of(side, i)))
            associate (at_place => element%steady_heat_series*contact%own(side), &
               reached => contact%reached(:, side))
               if (.not. at_place > least_rise*element%steady_heat_series) cycle
               steady = (self%rise(side, i)/at_place - left_of_settled(contact, side))/sum(slow_and_fast*reached)
               heat(:, side) = reached*steady + (1 - reached)*contact%settled_heat(:, side)
            end associate
         end associate
      end do
   end function settled_heat

end module litz_settled_heats
