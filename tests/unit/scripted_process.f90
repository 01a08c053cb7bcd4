!> One of two processes, the other one of which says what a test tells it to.
module scripted_process
   use litz_communicator, only: communicator_t
   use litz_kinds, only: dp
   implicit none
   private
   public :: scripted_t, counts_t

   type :: counts_t
      integer, allocatable :: values(:)
   end type counts_t

   type, extends(communicator_t) :: scripted_t
      !> What the other one has at the next call; of counts at each of the next calls
      real(dp), allocatable :: numbers(:)
      type(counts_t), allocatable :: counts(:)
      integer, pointer :: call_number => null()
      !> Nodes that both have, and those of them that do not belong to this one; numbers in the model of all nodes
      integer, allocatable :: shared(:), foreign(:), number_of(:)
   contains
      procedure :: gather_numbers
      procedure :: gather_counts
      procedure :: owns
      procedure :: number
      procedure :: shared_nodes
      procedure :: add_shared
   end type scripted_t

contains

   function gather_numbers(self, own) result(gathered)
      class(scripted_t), intent(in) :: self
      real(dp), intent(in) :: own(:)
      real(dp), allocatable :: gathered(:)

      allocate (gathered, source=[own, self%numbers])
   end function gather_numbers

   function gather_counts(self, own) result(gathered)
      class(scripted_t), intent(in) :: self
      integer, intent(in) :: own(:)
      integer, allocatable :: gathered(:)

      self%call_number = self%call_number + 1
      if (self%process == 1) allocate (gathered, source=[own, self%counts(self%call_number)%values])
      if (self%process == 2) allocate (gathered, source=[self%counts(self%call_number)%values, own])
   end function gather_counts

   pure logical function owns(self, node)
      class(scripted_t), intent(in) :: self
      integer, intent(in) :: node

      owns = .not. any(self%foreign == node)
   end function owns

   pure integer function number(self, node)
      class(scripted_t), intent(in) :: self
      integer, intent(in) :: node

      number = self%number_of(node)
   end function number

   pure function shared_nodes(self) result(nodes)
      class(scripted_t), intent(in) :: self
      integer, allocatable :: nodes(:)

      allocate (nodes, source=self%shared)
   end function shared_nodes

   subroutine add_shared(self, values)
      class(scripted_t), intent(in) :: self
      real(dp), intent(inout) :: values(:, :)

      values(:, self%shared) = values(:, self%shared) + spread(self%numbers, 1, size(values, 1))
   end subroutine add_shared

end module scripted_process
