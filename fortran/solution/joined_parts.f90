!> Parts of a model within which a flux can pass, also where processes have a piece of it each.
!>
!> Each process joins its own nodes. Pieces on several processes are one part where they share a node: all processes
!> learn which shared nodes are in the same piece anywhere, and join these in the same way. What is known of the pieces
!> of a part can then be put together.
module litz_joined_parts
   use litz_communicator, only: communicator_t
   use litz_kinds, only: dp
   use litz_lookup, only: id_map_t
   implicit none
   private
   public :: parts_t

   type :: parts_t
      !> For each node one of its piece nearer to the representative, which has itself (n_nodes)
      integer, allocatable :: root(:)
      !> Representatives of pieces of parts that are on several processes, and the numbers of these parts (n)
      integer, allocatable, private :: pieces(:), numbers(:)
      !> How many parts have such a number
      integer, private :: n_numbers = 0
   contains
      procedure :: start
      procedure :: join
      procedure :: join_processes
      procedure :: find
      procedure :: any_of_pieces
      procedure :: sum_of_pieces
      procedure :: keep_first_piece
   end type parts_t

contains

   !> Each node is a part of its own.
   pure subroutine start(self, n_nodes)
      class(parts_t), intent(inout) :: self
      !> Of this process
      integer, intent(in) :: n_nodes
      integer :: i

      self%root = [(i, i=1, n_nodes)]
   end subroutine start

   !> Two nodes are of one part.
   pure subroutine join(self, a, b)
      class(parts_t), intent(inout) :: self
      !> The nodes
      integer, intent(in) :: a, b

      call join_roots(self%root, a, b)
   end subroutine join

   pure subroutine join_roots(root, a, b)
      !> As in `parts_t` (n)
      integer, intent(inout) :: root(:)
      !> Two members
      integer, intent(in) :: a, b
      integer :: i, j

      call find_root(root, a, i)
      call find_root(root, b, j)
      root(max(i, j)) = min(i, j)
   end subroutine join_roots

   !> Representative of what a member belongs to; paths are halved on the way.
   pure subroutine find_root(root, member, i)
      !> As in `parts_t` (n)
      integer, intent(inout) :: root(:)
      !> The member
      integer, intent(in) :: member
      !> Its representative
      integer, intent(out) :: i

      i = member
      do while (root(i) /= i)
         root(i) = root(root(i))
         i = root(i)
      end do
   end subroutine find_root

   !> Representative of the piece that a node belongs to.
   integer function find(self, node)
      class(parts_t), intent(inout) :: self
      !> Node
      integer, intent(in) :: node

      call find_root(self%root, node, find)
   end function find

   !> Once all nodes are joined: pieces that share nodes over the processes. A piece goes by the number of its
   !> representative in the whole model.
   subroutine join_processes(self, processes)
      class(parts_t), intent(inout) :: self
      class(communicator_t), intent(in) :: processes
      integer, allocatable :: shared(:), links(:), root(:)
      logical :: is_piece(size(self%root))
      type(id_map_t) :: places
      integer :: i, n

      if (processes%n_processes == 1) return
      shared = processes%shared_nodes()
      allocate (links(2*size(shared)))
      do i = 1, size(shared)
         links(2*i - 1:2*i) = [processes%number(shared(i)), processes%number(self%find(shared(i)))]
      end do
      links = processes%gather(links)
      n = 0
      do i = 1, size(links)
         if (places%get(links(i)) > 0) cycle
         n = n + 1
         call places%put(links(i), n)
      end do
      root = [(i, i=1, n)]
      do i = 1, size(links), 2
         call join_roots(root, places%get(links(i)), places%get(links(i + 1)))
      end do
      self%n_numbers = n
      is_piece = .false.
      do i = 1, size(shared)
         is_piece(self%find(shared(i))) = .true.
      end do
      self%pieces = pack([(i, i=1, size(is_piece))], is_piece)
      allocate (self%numbers(size(self%pieces)))
      do i = 1, size(self%pieces)
         call find_root(root, places%get(processes%number(self%pieces(i))), self%numbers(i))
      end do
   end subroutine join_processes

   !> A flag that some piece of a part has, all its pieces have.
   subroutine any_of_pieces(self, processes, flags)
      class(parts_t), intent(in) :: self
      class(communicator_t), intent(in) :: processes
      !> Of representatives (n_nodes)
      logical, intent(inout) :: flags(:)
      logical :: of_part(self%n_numbers)
      integer :: i

      if (processes%n_processes == 1) return
      of_part = .false.
      do i = 1, size(self%pieces)
         of_part(self%numbers(i)) = of_part(self%numbers(i)) .or. flags(self%pieces(i))
      end do
      of_part = processes%any(of_part)
      flags(self%pieces) = of_part(self%numbers)
   end subroutine any_of_pieces

   !> All pieces of a part have the sum of what each has.
   subroutine sum_of_pieces(self, processes, values)
      class(parts_t), intent(in) :: self
      class(communicator_t), intent(in) :: processes
      !> Of representatives (n_nodes)
      real(dp), intent(inout) :: values(:)
      real(dp) :: of_part(self%n_numbers)
      integer :: i

      if (processes%n_processes == 1) return
      of_part = 0
      do i = 1, size(self%pieces)
         of_part(self%numbers(i)) = of_part(self%numbers(i)) + values(self%pieces(i))
      end do
      of_part = processes%sum(of_part)
      values(self%pieces) = of_part(self%numbers)
   end subroutine sum_of_pieces

   !> Of the pieces of a part that have a flag, the first one keeps it: the first of the first process.
   subroutine keep_first_piece(self, processes, flags)
      class(parts_t), intent(in) :: self
      class(communicator_t), intent(in) :: processes
      !> Of representatives (n_nodes)
      logical, intent(inout) :: flags(:)
      logical :: of_part(self%n_numbers)
      integer :: i

      if (processes%n_processes == 1) return
      of_part = .false.
      do i = 1, size(self%pieces)
         associate (number => self%numbers(i), piece => self%pieces(i))
            flags(piece) = flags(piece) .and. .not. of_part(number)
            of_part(number) = of_part(number) .or. flags(piece)
         end associate
      end do
      of_part = processes%is_first(of_part)
      flags(self%pieces) = flags(self%pieces) .and. of_part(self%numbers)
   end subroutine keep_first_piece

end module litz_joined_parts
