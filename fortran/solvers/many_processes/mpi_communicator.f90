!> Processes of MPI that hold a model together.
module litz_mpi_communicator
   use, intrinsic :: iso_c_binding, only: c_double, c_int
   use litz_communicator, only: communicator_t
   use litz_kinds, only: dp
   implicit none
   private
   public :: mpi_communicator_t

   type, extends(communicator_t) :: mpi_communicator_t
      !> Numbers of the nodes of this process in the whole model, ascending (n_nodes)
      integer, allocatable, private :: numbers(:)
      !> A process before this one has the node, too (n_nodes)
      logical, allocatable, private :: is_foreign(:)
      !> Processes that have some of the nodes, ascending, and how many; these nodes, one neighbour after the other
      integer, allocatable, private :: neighbours(:), counts(:), nodes(:)
   contains
      procedure :: start
      procedure :: gather_numbers
      procedure :: gather_counts
      procedure :: owns
      procedure :: number
      procedure :: shared_nodes
      procedure :: add_shared
   end type mpi_communicator_t

   interface
      subroutine find_process(process, n_processes) bind(c, name='litz_find_process')
         import :: c_int
         implicit none
         !> From 0, and how many there are
         integer(c_int), intent(out) :: process, n_processes
      end subroutine find_process

      subroutine all_counts(n, own, counts, gathered) bind(c, name='litz_gather_counts')
         import :: c_int
         implicit none
         !> How many this process has
         integer(c_int), value :: n
         !> These (n), and how many each process has (n_processes)
         integer(c_int), intent(in) :: own(*), counts(*)
         !> Of all processes, one after the other (sum of counts)
         integer(c_int), intent(inout) :: gathered(*)
      end subroutine all_counts

      subroutine all_numbers(n, own, counts, gathered) bind(c, name='litz_gather_numbers')
         import :: c_int, c_double
         implicit none
         !> How many this process has
         integer(c_int), value :: n
         !> These (n)
         real(c_double), intent(in) :: own(*)
         !> How many each process has (n_processes)
         integer(c_int), intent(in) :: counts(*)
         !> Of all processes, one after the other (sum of counts)
         real(c_double), intent(inout) :: gathered(*)
      end subroutine all_numbers

      subroutine exchange(n_neighbours, neighbours, counts, sent, received) bind(c, name='litz_exchange_numbers')
         import :: c_int, c_double
         implicit none
         !> How many processes this one has to do with
         integer(c_int), value :: n_neighbours
         !> Which ones, from 0, and how many numbers go to each and come from it (n_neighbours)
         integer(c_int), intent(in) :: neighbours(*), counts(*)
         !> One neighbour after the other (sum of counts)
         real(c_double), intent(in) :: sent(*)
         !> The same
         real(c_double), intent(inout) :: received(*)
      end subroutine exchange
   end interface

contains

   !> Who has which nodes. All processes begin together, and MPI has begun before.
   subroutine start(self, numbers)
      class(mpi_communicator_t), intent(inout) :: self
      !> Of the nodes of this process in the whole model, ascending (n_nodes)
      integer, intent(in) :: numbers(:)
      integer, allocatable :: sizes(:), of_all(:), common(:)
      integer :: other, first

      call find_process(self%process, self%n_processes)
      self%process = self%process + 1
      self%numbers = numbers
      allocate (self%is_foreign(size(numbers)), source=.false.)
      allocate (self%neighbours(0), self%counts(0), self%nodes(0))
      sizes = self%gather([size(numbers)])
      of_all = self%gather(numbers)
      first = 0
      do other = 1, self%n_processes
         common = places_of_common(numbers, of_all(first + 1:first + sizes(other)))
         first = first + sizes(other)
         if (other == self%process .or. size(common) == 0) cycle
         self%neighbours = [self%neighbours, other - 1]
         self%counts = [self%counts, size(common)]
         self%nodes = [self%nodes, common]
         if (other < self%process) self%is_foreign(common) = .true.
      end do
   end subroutine start

   !> Places of those of the first numbers that are among the second ones.
   pure function places_of_common(numbers, others) result(places)
      !> Ascending (n), (m)
      integer, intent(in) :: numbers(:), others(:)
      integer, allocatable :: places(:)
      logical :: is_common(size(numbers))
      integer :: i, k

      is_common = .false.
      k = 1
      do i = 1, size(numbers)
         do while (k < size(others))
            if (others(k) >= numbers(i)) exit
            k = k + 1
         end do
         if (size(others) > 0) is_common(i) = others(k) == numbers(i)
      end do
      places = pack([(i, i=1, size(numbers))], is_common)
   end function places_of_common

   !> Of all processes, one after the other.
   function gather_counts(self, own) result(gathered)
      class(mpi_communicator_t), intent(in) :: self
      !> Of this process (n)
      integer, intent(in) :: own(:)
      integer, allocatable :: gathered(:)
      integer :: sizes(self%n_processes)

      call all_counts(1, [size(own)], spread(1, 1, self%n_processes), sizes)
      allocate (gathered(sum(sizes)))
      call all_counts(size(own), own, sizes, gathered)
   end function gather_counts

   !> Of all processes, one after the other.
   function gather_numbers(self, own) result(gathered)
      class(mpi_communicator_t), intent(in) :: self
      !> Of this process (n)
      real(dp), intent(in) :: own(:)
      real(dp), allocatable :: gathered(:)
      integer :: sizes(self%n_processes)

      call all_counts(1, [size(own)], spread(1, 1, self%n_processes), sizes)
      allocate (gathered(sum(sizes)))
      call all_numbers(size(own), own, sizes, gathered)
   end function gather_numbers

   pure logical function owns(self, node)
      class(mpi_communicator_t), intent(in) :: self
      !> Index of the node in this process
      integer, intent(in) :: node

      owns = .not. self%is_foreign(node)
   end function owns

   pure integer function number(self, node)
      class(mpi_communicator_t), intent(in) :: self
      !> Index of the node in this process
      integer, intent(in) :: node

      number = self%numbers(node)
   end function number

   !> Each once, ascending (n).
   pure function shared_nodes(self) result(nodes)
      class(mpi_communicator_t), intent(in) :: self
      integer, allocatable :: nodes(:)
      logical :: is_shared(size(self%numbers))
      integer :: node

      is_shared = .false.
      is_shared(self%nodes) = .true.
      nodes = pack([(node, node=1, size(is_shared))], is_shared)
   end function shared_nodes

   !> What each process has added up at shared nodes becomes the sum of all, in the order of the processes.
   subroutine add_shared(self, values)
      class(mpi_communicator_t), intent(in) :: self
      !> (values of a node, n_nodes)
      real(dp), intent(inout) :: values(:, :)
      real(dp) :: received(size(values, 1), size(self%nodes)), total(size(values, 1), size(values, 2))
      integer :: i, first
      logical :: own_is_in

      call exchange(size(self%neighbours), self%neighbours, size(values, 1)*self%counts, values(:, self%nodes), &
         received)
      total = 0
      own_is_in = .false.
      first = 0
      do i = 1, size(self%neighbours)
         if (.not. own_is_in .and. self%neighbours(i) >= self%process) then
            total = total + values
            own_is_in = .true.
         end if
         associate (there => self%nodes(first + 1:first + self%counts(i)))
            total(:, there) = total(:, there) + received(:, first + 1:first + self%counts(i))
         end associate
         first = first + self%counts(i)
      end do
      if (.not. own_is_in) total = total + values
      values = total
   end subroutine add_shared

end module litz_mpi_communicator
