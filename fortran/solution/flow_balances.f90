!> Balances of currents, power and heat in a state.
!>
!> Source: theory section 8, the invariants of every run.
module litz_flow_balances
   use litz_communicator, only: communicator_t
   use litz_fields, only: first_slot, field_potential, field_temperature
   use litz_kinds, only: dp
   use litz_model, only: model_t
   use litz_state, only: state_t, contact_t
   implicit none
   private
   public :: current_imbalance, spot_imbalance, power_imbalance, heat_imbalance, power_left_over

   integer, parameter :: current_slot = first_slot(field_potential), heat_slot = first_slot(field_temperature)

contains

   !> Kirchhoff's law: current that enters each node from outside less what leaves it into elements and spots [A].
   function current_imbalance(processes, model, state) result(left)
      class(communicator_t), intent(in) :: processes
      type(model_t), intent(in) :: model
      type(state_t), intent(in) :: state
      real(dp) :: left(model%n_nodes), of_all(1, model%n_nodes)
      integer :: i

      left = processes%own_part(state%reaction(current_slot, :) + state%load(current_slot, :) &
         + state%outer_force(current_slot, :))
      do i = 1, model%n_elements
         associate (node => model%connectivity(:, i))
            left(node(1)) = left(node(1)) - state%element_current(i)
            left(node(2)) = left(node(2)) + state%element_current(i)
         end associate
      end do
      do i = 1, size(state%contacts)
         associate (c => state%contacts(i))
            call share(c%element_bar, c%xi_bar, -c%current)
            call share(c%element, c%xi, c%current)
         end associate
      end do
      do i = 1, size(state%surface_contacts)
         associate (c => state%surface_contacts(i))
            associate (nodes => model%connectivity(:, c%element), &
               node => model%surfaces(model%surface_pairs(c%pair)%surface)%node)
               left(nodes) = left(nodes) - c%current_of_nodes
               if (node > 0) left(node) = left(node) + c%current
            end associate
         end associate
      end do
      of_all(1, :) = left
      call processes%add_shared(of_all)
      left = of_all(1, :)

   contains

      !> A current into an element at `xi` comes to its nodes as the linear voltage has it.
      pure subroutine share(element, xi, current)
         !> Index of the element
         integer, intent(in) :: element
         !> Place in [-1, 1], and current [A]
         real(dp), intent(in) :: xi, current

         associate (node => model%connectivity(:, element))
            left(node(1)) = left(node(1)) + (1 - xi)/2*current
            left(node(2)) = left(node(2)) + (1 + xi)/2*current
         end associate
      end subroutine share

   end function current_imbalance

   !> Current of each spot less what its voltage drives through its resistance [A].
   pure function spot_imbalance(contacts) result(left)
      type(contact_t), intent(in) :: contacts(:)
      real(dp) :: left(size(contacts))

      left = contacts%current
      where (contacts%resistance > 0) left = contacts%current - contacts%voltage_gap/contacts%resistance
   end function spot_imbalance

   !> `sum V I` over what comes in, less the heat in elements and spots [W].
   real(dp) function power_imbalance(processes, state) result(left)
      class(communicator_t), intent(in) :: processes
      type(state_t), intent(in) :: state

      left = processes%sum(sum(processes%own_part(state%value(current_slot, :)*(state%reaction(current_slot, :) &
         + state%load(current_slot, :)))) &
         - sum(state%joule_heat) - sum(state%contacts%joule_heat) - sum(state%surface_contacts%joule_heat))
   end function power_imbalance

   !> What comes in at nodes and on the length of the wires and is not stored [W].
   real(dp) function heat_imbalance(processes, state) result(left)
      class(communicator_t), intent(in) :: processes
      type(state_t), intent(in) :: state

      left = sum(processes%own_part(state%reaction(heat_slot, :) + state%load(heat_slot, :) &
         + state%outer_force(heat_slot, :))) &
         + sum(state%heat_made) &
         + sum(state%contacts%heat_bar + state%contacts%heat) - sum(state%surface_heat) - sum(state%heat_stored) &
         + sum(state%surface_contacts%heat + state%surface_contacts%heat_of_surface)
      left = processes%sum(left)
   end function heat_imbalance

   !> What the currents that are left over, and the round-off of those fed in, make of the power at most [W].
   real(dp) function power_left_over(processes, state, residual) result(left)
      class(communicator_t), intent(in) :: processes
      type(state_t), intent(in) :: state
      !> Current that is left over at each node (n_nodes) [A]
      real(dp), intent(in) :: residual(:)

      left = processes%sum(sum(processes%own_part(abs(state%value(current_slot, :)) &
         *(residual + epsilon(1.0_dp)*abs(state%load(current_slot, :))))))
   end function power_left_over

end module litz_flow_balances
