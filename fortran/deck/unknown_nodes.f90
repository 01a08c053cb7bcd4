!> At which nodes a field has an equation.
module litz_unknown_nodes
   use litz_conduction, only: conducts, surface_conducts
   use litz_fields, only: field_potential, field_temperature, n_fields
   use litz_model, only: model_t
   implicit none
   private
   public :: node_unknowns_t, find_unknowns, nodes_with_unknown, reason_for_lack_of

   !> What the elements of a model, and those that extend this, give its nodes.
   type :: node_unknowns_t
      !> The node belongs to an element (n_nodes)
      logical, allocatable :: has_element(:)
      !> A field has an equation there (n_nodes, n_fields)
      logical, allocatable :: has_unknown(:, :)
   end type node_unknowns_t

contains

   pure subroutine find_unknowns(model, unknowns)
      type(model_t), intent(in) :: model
      class(node_unknowns_t), intent(inout) :: unknowns
      integer :: e, k

      allocate (unknowns%has_unknown(model%n_nodes, n_fields))
      do k = 1, n_fields
         unknowns%has_unknown(:, k) = nodes_with_unknown(model, k)
      end do
      allocate (unknowns%has_element(model%n_nodes), source=.false.)
      do e = 1, model%n_elements
         do k = 1, 2
            if (model%connectivity(k, e) > 0) unknowns%has_element(model%connectivity(k, e)) = .true.
         end do
      end do
   end subroutine find_unknowns

   !> Nodes of elements and surfaces that conduct the flux of a field; all nodes for fields that need no conductor.
   pure function nodes_with_unknown(model, field) result(has_unknown)
      type(model_t), intent(in) :: model
      !> One of litz_fields
      integer, intent(in) :: field
      logical :: has_unknown(model%n_nodes)
      integer :: e, k

      has_unknown = .not. any(field == [field_potential, field_temperature])
      do e = 1, model%n_elements
         if (.not. conducts(model, e, field)) cycle
         do k = 1, 2
            if (model%connectivity(k, e) > 0) has_unknown(model%connectivity(k, e)) = .true.
         end do
      end do
      do k = 1, size(model%surfaces)
         if (surface_conducts(model, k, field)) has_unknown(model%surfaces(k)%node) = .true.
      end do
   end function nodes_with_unknown

   !> Why a node does not have the unknown of a field, behind the name of the node.
   pure function reason_for_lack_of(model, node, field) result(words)
      type(model_t), intent(in) :: model
      !> Index of the node, and one of litz_fields
      integer, intent(in) :: node, field
      character(len=:), allocatable :: words
      character(len=:), allocatable :: lack, of_elements, of_surface

      if (field == field_temperature) then
         lack = ' has no temperature as an unknown, as '
         of_elements = 'no material of its elements conducts heat; temperatures are given by *TEMPERATURE'
         of_surface = 'no contact pair passes heat to its rigid surface (*GAP CONDUCTANCE, PER=LENGTH does)'
      else
         lack = ' has no electric potential: '
         of_elements = 'no material of its elements has *ELECTRICAL CONDUCTIVITY'
         of_surface = 'no contact pair passes a current to its rigid surface (*GAP ELECTRICAL CONDUCTANCE,'// &
            ' PER=LENGTH does)'
      end if
      words = lack//of_elements
      if (any(model%surfaces%node == node) .and. .not. any(model%connectivity == node)) words = lack//of_surface
   end function reason_for_lack_of

end module litz_unknown_nodes
