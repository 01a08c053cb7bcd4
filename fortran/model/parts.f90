!> Connected parts of a model: elements that hang together through shared nodes.
module litz_parts
   use litz_text, only: to_text
   use litz_model, only: model_t
   implicit none
   private
   public :: parts_t, find_parts, describe_part, join, find_root

   type :: parts_t
      integer :: n = 0
      !> Part of each element and of each node; 0: none (n_elements), (n_nodes)
      integer, allocatable :: of_element(:), of_node(:)
      !> First element and number of elements of each part (n)
      integer, allocatable :: first_element(:), n_elements(:)
      !> Index of an element set that is just this part, 0: none (n)
      integer, allocatable :: set(:)
   end type parts_t

contains

   !> Numbered in the order of their first elements.
   pure subroutine find_parts(model, included, parts, with_bodies)
      type(model_t), intent(in) :: model
      !> Elements that count (n_elements)
      logical, intent(in) :: included(:)
      type(parts_t), intent(out) :: parts
      !> Rigid bodies connect their nodes, too; default: they do not
      logical, intent(in), optional :: with_bodies
      integer, allocatable :: root(:)
      integer :: e, i, node

      root = [(i, i=1, model%n_nodes)]
      do e = 1, model%n_elements
         if (included(e)) call join(root, model%connectivity(1, e), model%connectivity(2, e))
      end do
      if (present(with_bodies)) then
         if (with_bodies) call join_bodies(model, root)
      end if
      allocate (parts%of_element(model%n_elements), parts%of_node(model%n_nodes), &
         parts%first_element(model%n_elements), parts%n_elements(model%n_elements), source=0)
      do e = 1, model%n_elements
         if (.not. included(e)) cycle
         node = find_root(root, model%connectivity(1, e))
         if (parts%of_node(node) == 0) then
            parts%n = parts%n + 1
            parts%of_node(node) = parts%n
            parts%first_element(parts%n) = e
         end if
         parts%of_element(e) = parts%of_node(node)
         parts%n_elements(parts%of_element(e)) = parts%n_elements(parts%of_element(e)) + 1
      end do
      do i = 1, model%n_nodes
         parts%of_node(i) = parts%of_node(find_root(root, i))
      end do
      call find_own_sets(model, parts)
   end subroutine find_parts

   !> Nodes of a rigid body are of one part.
   pure subroutine join_bodies(model, root)
      type(model_t), intent(in) :: model
      !> As of `join` (n_nodes)
      integer, intent(inout) :: root(:)
      integer :: i, k

      do i = 1, size(model%rigid_bodies)
         associate (nodes => [model%rigid_bodies(i)%tied, model%rigid_bodies(i)%pinned])
            do k = 1, size(nodes)
               call join(root, model%rigid_bodies(i)%reference_node, nodes(k))
            end do
         end associate
      end do
   end subroutine join_bodies

   !> Element sets that hold exactly one part give it its name.
   pure subroutine find_own_sets(model, parts)
      type(model_t), intent(in) :: model
      type(parts_t), intent(inout) :: parts
      integer :: s, part

      allocate (parts%set(parts%n), source=0)
      do s = 1, size(model%element_sets)
         associate (members => model%element_sets(s)%members)
            if (size(members) == 0) cycle
            part = parts%of_element(members(1))
            if (part == 0) cycle
            if (parts%n_elements(part) /= size(members)) cycle
            if (all(parts%of_element(members) == part)) parts%set(part) = s
         end associate
      end do
   end subroutine find_own_sets

   !> `wire LOWER (20 elements from 1 on)`
   pure function describe_part(model, parts, part) result(words)
      type(model_t), intent(in) :: model
      type(parts_t), intent(in) :: parts
      !> Index of the part
      integer, intent(in) :: part
      character(len=:), allocatable :: words, first

      first = to_text(model%element_id(parts%first_element(part)))
      if (parts%n_elements(part) == 1) then
         words = 'element '//first
      else
         words = to_text(parts%n_elements(part))//' connected elements from element '//first//' on'
      end if
      if (parts%set(part) > 0) words = model%element_sets(parts%set(part))%name//' ('//words//')'
   end function describe_part

   !> Put two members into the same tree.
   pure subroutine join(root, a, b)
      !> For each member another one of the same tree, nearer to the root; the root for itself (members)
      integer, intent(inout) :: root(:)
      !> The two members
      integer, intent(in) :: a, b
      integer :: i, j

      i = a
      call halve_path(root, i)
      j = b
      call halve_path(root, j)
      ! the smaller number stays the root
      root(max(i, j)) = min(i, j)
   end subroutine join

   !> Walk to the root, and shorten the way for the next time.
   pure subroutine halve_path(root, i)
      !> For each member another one of the same tree, nearer to the root; the root for itself (members)
      integer, intent(inout) :: root(:)
      !> In: a member. Out: the root of its tree
      integer, intent(inout) :: i

      do while (root(i) /= i)
         root(i) = root(root(i))
         i = root(i)
      end do
   end subroutine halve_path

   pure integer function find_root(root, member) result(i)
      !> For each member another one of the same tree, nearer to the root; the root for itself (members)
      integer, intent(in) :: root(:)
      !> Any member of the tree
      integer, intent(in) :: member

      i = member
      do while (root(i) /= i)
         i = root(i)
      end do
   end function find_root

end module litz_parts
