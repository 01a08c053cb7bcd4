!> Wires as a reader of the results sees them: elements that follow one another between free ends and branches, also
!> over kinks, which end the smooth wires of `litz_wires`.
module litz_wire_chains
   implicit none
   private
   public :: wire_chains_t, find_wire_chains

   type :: wire_chains_t
      !> Wire of each element, counted from 1 in the order of the first elements of the wires (n_elements)
      integer, allocatable :: wire(:)
      !> Place of each element along its wire, counted from 1 (n_elements)
      integer, allocatable :: place(:)
      !> +1: the element runs along its wire, as the first element of each wire does; -1: against it (n_elements)
      integer, allocatable :: direction(:)
   end type wire_chains_t

contains

   pure subroutine find_wire_chains(connectivity, n_nodes, chains)
      !> Nodes of each element (2, n_elements)
      integer, intent(in) :: connectivity(:, :)
      !> Number of nodes
      integer, intent(in) :: n_nodes
      type(wire_chains_t), intent(out) :: chains
      !> Sum of the elements at each node where these are two, else 0 (n_nodes)
      integer :: pair(n_nodes)
      integer :: e, first, node, n_wires

      allocate (chains%wire(size(connectivity, 2)), chains%place(size(connectivity, 2)), &
         chains%direction(size(connectivity, 2)), source=0)
      pair = sums_of_pairs(connectivity, n_nodes)
      n_wires = 0
      do e = 1, size(connectivity, 2)
         if (chains%wire(e) /= 0) cycle
         n_wires = n_wires + 1
         call find_start(connectivity, pair, e, first, node)
         call number_chain(connectivity, pair, n_wires, first, node, chains)
      end do
   end subroutine find_wire_chains

   pure function sums_of_pairs(connectivity, n_nodes) result(pair)
      !> Nodes of each element (2, n_elements)
      integer, intent(in) :: connectivity(:, :)
      !> Number of nodes
      integer, intent(in) :: n_nodes
      !> Sum of the elements at each node where these are two, else 0 (n_nodes)
      integer :: pair(n_nodes)
      integer :: counts(n_nodes), e, side

      counts = 0
      pair = 0
      do e = 1, size(connectivity, 2)
         do side = 1, 2
            associate (node => connectivity(side, e))
               counts(node) = counts(node) + 1
               pair(node) = pair(node) + merge(e, 0, counts(node) <= 2)
            end associate
         end do
      end do
      where (counts /= 2) pair = 0
   end function sums_of_pairs

   !> Where the wire of an element begins, when it is followed against the direction of this element.
   pure subroutine find_start(connectivity, pair, e, first, node)
      !> Nodes of each element (2, n_elements); sum of the elements at each node where these are two, else 0 (n_nodes)
      integer, intent(in) :: connectivity(:, :), pair(:)
      !> The element
      integer, intent(in) :: e
      !> First element of its wire, and the node by which the wire enters it; those of `e` itself where it is closed
      integer, intent(out) :: first, node
      integer :: before

      first = e
      node = connectivity(1, e)
      do
         if (pair(node) == 0) exit
         before = pair(node) - first
         node = sum(connectivity(:, before)) - node
         first = before
         if (first == e) exit
      end do
      if (first == e) node = connectivity(1, e)
   end subroutine find_start

   !> Numbers the elements of a wire from its first one on.
   pure subroutine number_chain(connectivity, pair, wire, first, first_node, chains)
      !> Nodes of each element (2, n_elements); sum of the elements at each node where these are two, else 0 (n_nodes)
      integer, intent(in) :: connectivity(:, :), pair(:)
      !> Number of the wire, its first element, and the node by which the wire enters it
      integer, intent(in) :: wire, first, first_node
      type(wire_chains_t), intent(inout) :: chains
      integer :: e, node, n

      e = first
      node = first_node
      n = 0
      do
         n = n + 1
         chains%wire(e) = wire
         chains%place(e) = n
         chains%direction(e) = merge(1, -1, connectivity(1, e) == node)
         node = sum(connectivity(:, e)) - node
         if (pair(node) == 0) exit
         e = pair(node) - e
         if (chains%wire(e) /= 0) exit
      end do
   end subroutine number_chain

end module litz_wire_chains
