!> Heat of friction in steps over time, as its work enters the rate of the enthalpy.
!>
!> The enthalpy less the work of friction changes by the flow of heat alone, and BDF2 takes this difference: of the
!> works D of the last two increments of a contact comes
!>
!>     (a D_n - b D_(n-1))/dt                                                                                       (1)
!>
!> to the nodes of its wires, with the weights of the enthalpy, so that over a step the wires take up all that friction
!> has done and no more, whatever the increments. Where friction sets in or ends, (1) would be far from the rate of
!> either increment, and such an increment takes backward Euler, b = 0. So do nodes of prescribed temperature, as what
!> they store does. Source: theory section 13.
module litz_rubbing
   use litz_communicator, only: communicator_t
   use litz_kinds, only: dp
   implicit none
   private
   public :: rubbing_t, is_abrupt, add_heat_beyond, power_of

   !> The rate at a contact has jumped when it changes by this part of the larger one; contacts of less than this part
   !> of all heat of friction, or that warm half an element at less than this part of the fastest rate, do not count
   real(dp), parameter :: largest_change = 0.5_dp, least_part = 0.01_dp

   !> A contact that has friction in this increment or had it in the last one.
   type :: rubbing_t
      !> Both elements, 0 for a rigid surface, and the places in them, barred first
      integer :: element(2) = 0
      real(dp) :: xi(2) = 0
      !> Of what enters an element there, the parts that come to its nodes (2, 2)
      real(dp) :: part(2, 2) = 0
      !> Part of the heat that enters either
      real(dp) :: share(2) = 0.5_dp
      !> Heat that friction makes in this increment and made in the last one [J]
      real(dp) :: heat = 0, heat_before = 0
      !> Heat that half of either element takes up per kelvin [J/K]
      real(dp) :: capacity(2) = 0
      !> Node of a rigid surface with a temperature, and the one that moves the surface; 0: none
      integer :: node = 0, mover = 0
      !> How the heat of this increment on a rigid surface changes with the motions of the nodes of the wire and of the
      !> surface (18), and with the temperatures of the former (2) [J/K]
      real(dp) :: dheat(18) = 0, dheat_dtemperature(2) = 0
   end type rubbing_t

contains

   !> Friction sets in or ends at a contact that matters.
   logical function is_abrupt(processes, rubbing, increment, before, warming)
      class(communicator_t), intent(in) :: processes
      type(rubbing_t), intent(in) :: rubbing(:)
      !> This increment and the last one [s]
      real(dp), intent(in) :: increment, before
      !> By which any temperature changes, at most [K/s]
      real(dp), intent(in) :: warming
      real(dp), dimension(size(rubbing)) :: now, earlier
      real(dp) :: total
      integer :: i

      now = rubbing%heat/increment
      earlier = rubbing%heat_before/before
      total = processes%sum(sum(max(now, earlier)))
      is_abrupt = processes%any(any(abs(now - earlier) > largest_change*max(now, earlier) .and. max(now, earlier) > &
         least_part*total .and. [(matters(rubbing(i), abs(now(i) - earlier(i))), i=1, size(now))]))

   contains

      pure logical function matters(this, jump)
         type(rubbing_t), intent(in) :: this
         !> Of the rate [W]
         real(dp), intent(in) :: jump

         matters = any(this%share*jump > least_part*warming*this%capacity .and. this%element > 0)
      end function matters

   end function is_abrupt

   !> (1) [W].
   pure real(dp) function power_of(rubbing, weights, increment) result(power)
      type(rubbing_t), intent(in) :: rubbing
      !> a and b
      real(dp), intent(in) :: weights(2)
      !> [s]
      real(dp), intent(in) :: increment

      power = (weights(1)*rubbing%heat - weights(2)*rubbing%heat_before)/increment
   end function power_of

   !> What the nodes get of (1) beyond backward Euler; `made` is the same by elements, with what their films take
   !> between the nodes.
   pure subroutine add_heat_beyond(rubbing, connectivity, is_led, weights, increment, leaving, made, through_film)
      type(rubbing_t), intent(in) :: rubbing(:)
      !> Nodes of the elements (2, n_elements)
      integer, intent(in) :: connectivity(:, :)
      !> Nodes that have backward Euler (n_nodes)
      logical, intent(in) :: is_led(:)
      !> a and b of (1)
      real(dp), intent(in) :: weights(2)
      !> [s]
      real(dp), intent(in) :: increment
      !> Heat that leaves the nodes (n_nodes) [W]
      real(dp), intent(inout) :: leaving(:)
      !> (n_elements) [W]
      real(dp), intent(inout) :: made(:), through_film(:)
      real(dp) :: heat, enters(2)
      integer :: i, side, k

      do i = 1, size(rubbing)
         do side = 1, 2
            associate (part => rubbing(i)%part(:, side), e => rubbing(i)%element(side), xi => rubbing(i)%xi(side))
               if (e == 0) cycle
               heat = rubbing(i)%share(side)*power_of(rubbing(i), weights - [1, 0], increment)
               enters = [1 - xi, 1 + xi]/2
               do k = 1, 2
                  associate (node => connectivity(k, e))
                     if (is_led(node)) cycle
                     leaving(node) = leaving(node) - heat*part(k)
                  end associate
                  made(e) = made(e) + heat*enters(k)
                  through_film(e) = through_film(e) + heat*(enters(k) - part(k))
               end do
            end associate
         end do
      end do
   end subroutine add_heat_beyond

end module litz_rubbing
