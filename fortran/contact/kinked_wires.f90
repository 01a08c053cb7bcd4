!> Wires that turn by so much at a node that they are two wires there: contact at the kink is not modelled.
module litz_kinked_wires
   use litz_contact_points, only: contact_set_t
   use litz_model, only: model_t
   use litz_text, only: to_text
   use litz_wires, only: wires_t
   implicit none
   private
   public :: kink_warning

contains

   !> How many kinks there are in wires that may touch others, with an example; empty: none.
   function kink_warning(model, wires, contact) result(text)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(contact_set_t), intent(in) :: contact
      character(len=:), allocatable :: text
      integer :: node, n, example

      text = ''
      if (.not. contact%present) return
      n = 0
      example = 0
      do node = 1, model%n_nodes
         if (.not. is_kink(node)) cycle
         n = n + 1
         if (n == 1) example = node
      end do
      if (n > 0) text = 'wires that may touch others turn by 20 degrees or more at '//to_text(n)//' nodes, such as '// &
         to_text(model%node_id(example))//'; contact at a kink is not modelled, and the run ends where one is touched'

   contains

      !> Two elements meet there, alone, and do not continue one another.
      logical function is_kink(node)
         !> Node
         integer, intent(in) :: node
         integer :: a, b

         is_kink = wires%first_at_node(node + 1) - wires%first_at_node(node) == 2
         if (.not. is_kink) return
         a = abs(wires%at_node(wires%first_at_node(node)))
         b = abs(wires%at_node(wires%first_at_node(node) + 1))
         is_kink = .not. any(wires%next(:, a) == b) .and. any(contact%in_bar([a, b], :) .or. contact%in_set([a, b], :))
      end function is_kink

   end function kink_warning

end module litz_kinked_wires
