!> What processes that hold a model together tell each other: sums and maxima over it, and values at shared nodes.
!>
!> An element or a contact belongs to one process, a node to the first of those whose elements have it. Each process
!> counts what belongs to it, and here that of all is put together, sums in the order of the processes: all have the
!> same answer, and one process alone has what it counted, to the last bit. All make the same calls in the same order.
module litz_communicator
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use litz_kinds, only: dp
   implicit none
   private
   public :: communicator_t, one_process_t

   type, abstract :: communicator_t
      !> Number of processes, and which of them this is, from 1
      integer :: n_processes = 1, process = 1
   contains
      !> What each process has, one after the other, for all
      generic :: gather => gather_numbers, gather_counts
      procedure(gather_numbers), deferred :: gather_numbers
      procedure(gather_counts), deferred :: gather_counts
      generic :: sum => sum_number, sum_numbers, sum_count
      procedure, private :: sum_number, sum_numbers, sum_count
      generic :: largest => largest_number, largest_numbers
      procedure, private :: largest_number, largest_numbers
      procedure :: take_largest
      generic :: any => any_flag, any_flags
      procedure, private :: any_flag, any_flags
      procedure :: is_first
      procedure :: first_text
      !> Nodes
      procedure(owns), deferred :: owns
      procedure(number), deferred :: number
      procedure(shared_nodes), deferred :: shared_nodes
      procedure(add_shared), deferred :: add_shared
      generic :: own_part => own_part_of_nodes, own_part_of_slots
      procedure, private :: own_part_of_nodes, own_part_of_slots
      procedure :: count_nodes
   end type communicator_t

   abstract interface
      function gather_numbers(self, own) result(gathered)
         import :: communicator_t, dp
         implicit none
         class(communicator_t), intent(in) :: self
         !> Of this process (n), any number of them
         real(dp), intent(in) :: own(:)
         real(dp), allocatable :: gathered(:)
      end function gather_numbers

      function gather_counts(self, own) result(gathered)
         import :: communicator_t
         implicit none
         class(communicator_t), intent(in) :: self
         !> Of this process (n), any number of them
         integer, intent(in) :: own(:)
         integer, allocatable :: gathered(:)
      end function gather_counts

      !> A node belongs to this process.
      pure logical function owns(self, node)
         import :: communicator_t
         implicit none
         class(communicator_t), intent(in) :: self
         !> Index of the node in this process
         integer, intent(in) :: node
      end function owns

      !> Number of a node in the whole model, from 1.
      pure integer function number(self, node)
         import :: communicator_t
         implicit none
         class(communicator_t), intent(in) :: self
         !> Index of the node in this process
         integer, intent(in) :: node
      end function number

      !> Nodes of this process that others have, too (n).
      pure function shared_nodes(self) result(nodes)
         import :: communicator_t
         implicit none
         class(communicator_t), intent(in) :: self
         integer, allocatable :: nodes(:)
      end function shared_nodes

      !> What each process has added up at shared nodes becomes the sum of all, in the order of the processes.
      subroutine add_shared(self, values)
         import :: communicator_t, dp
         implicit none
         class(communicator_t), intent(in) :: self
         !> (values of a node, n_nodes)
         real(dp), intent(inout) :: values(:, :)
      end subroutine add_shared
   end interface

   !> This process has the whole model.
   type, extends(communicator_t) :: one_process_t
   contains
      procedure :: gather_numbers => keep_numbers
      procedure :: gather_counts => keep_counts
      procedure :: owns => owns_all
      procedure :: number => same_number
      procedure :: shared_nodes => no_nodes
      procedure :: add_shared => add_nothing
   end type one_process_t

contains

   !> Over the processes; of the same unit as the number.
   real(dp) function sum_number(self, own) result(total)
      class(communicator_t), intent(in) :: self
      !> Of this process
      real(dp), intent(in) :: own
      real(dp) :: totals(1)

      totals = self%sum_numbers([own])
      total = totals(1)
   end function sum_number

   !> Over the processes, of each number by itself.
   function sum_numbers(self, own) result(total)
      class(communicator_t), intent(in) :: self
      !> Of this process (n), as many as in the others
      real(dp), intent(in) :: own(:)
      real(dp) :: total(size(own))
      real(dp) :: of_all(size(own), self%n_processes)
      integer :: i

      total = own
      if (self%n_processes == 1) return
      of_all = reshape(self%gather(own), shape(of_all))
      total = of_all(:, 1)
      do i = 2, self%n_processes
         total = total + of_all(:, i)
      end do
   end function sum_numbers

   integer function sum_count(self, own) result(total)
      class(communicator_t), intent(in) :: self
      !> Of this process
      integer, intent(in) :: own
      integer :: of_all(self%n_processes)

      total = own
      if (self%n_processes == 1) return
      of_all = self%gather([own])
      total = sum(of_all)
   end function sum_count

   !> Of all processes; a value that is not a number wins.
   real(dp) function largest_number(self, own) result(largest)
      class(communicator_t), intent(in) :: self
      !> Of this process
      real(dp), intent(in) :: own
      real(dp) :: all_largest(1)

      all_largest = self%largest_numbers([own])
      largest = all_largest(1)
   end function largest_number

   !> Of all processes, of each number by itself; a value that is not a number wins.
   function largest_numbers(self, own) result(largest)
      class(communicator_t), intent(in) :: self
      !> Of this process (n), as many as in the others
      real(dp), intent(in) :: own(:)
      real(dp) :: largest(size(own))
      real(dp) :: of_all(size(own), self%n_processes)
      integer :: i, k

      largest = own
      if (self%n_processes == 1) return
      of_all = reshape(self%gather(own), shape(of_all))
      do i = 1, size(own)
         k = place_of_largest(of_all(i, :))
         largest(i) = of_all(i, k)
      end do
   end function largest_numbers

   !> The largest value of all processes, with what belongs to it; of equal ones that of the first process.
   subroutine take_largest(self, value, belongings)
      class(communicator_t), intent(in) :: self
      !> Of this process; out: of all
      real(dp), intent(inout) :: value
      !> Numbers that belong to the value (n), as many as in the others
      real(dp), intent(inout) :: belongings(:)
      real(dp) :: of_all(size(belongings) + 1, self%n_processes)
      integer :: k

      if (self%n_processes == 1) return
      of_all = reshape(self%gather([value, belongings]), shape(of_all))
      k = place_of_largest(of_all(1, :))
      value = of_all(1, k)
      belongings = of_all(2:, k)
   end subroutine take_largest

   !> The first of the largest ones, or of those that are not numbers.
   pure integer function place_of_largest(values) result(place)
      !> (n), at least one
      real(dp), intent(in) :: values(:)
      integer :: i

      place = 1
      do i = 2, size(values)
         if (ieee_is_nan(values(place))) return
         if (values(i) > values(place) .or. ieee_is_nan(values(i))) place = i
      end do
   end function place_of_largest

   !> Some process has set the flag.
   logical function any_flag(self, own)
      class(communicator_t), intent(in) :: self
      !> Of this process
      logical, intent(in) :: own

      any_flag = any(self%any_flags([own]))
   end function any_flag

   !> Some process has set the flag, for each flag by itself.
   function any_flags(self, own)
      class(communicator_t), intent(in) :: self
      !> Of this process (n), as many as in the others
      logical, intent(in) :: own(:)
      logical :: any_flags(size(own))

      any_flags = own
      if (self%n_processes > 1) any_flags = any(flags_of_all(self, own), 2)
   end function any_flags

   !> Of those that have set the flag, this process is the first, for each flag by itself.
   function is_first(self, own)
      class(communicator_t), intent(in) :: self
      !> Of this process (n), as many as in the others
      logical, intent(in) :: own(:)
      logical :: is_first(size(own)), of_all(size(own), self%n_processes)

      is_first = own
      if (self%n_processes == 1) return
      of_all = flags_of_all(self, own)
      is_first = own .and. .not. any(of_all(:, :self%process - 1), 2)
   end function is_first

   !> Flags (n, processes).
   function flags_of_all(self, own) result(of_all)
      class(communicator_t), intent(in) :: self
      !> Of this process (n), as many as in the others
      logical, intent(in) :: own(:)
      logical :: of_all(size(own), self%n_processes)
      integer :: counts(size(own)*self%n_processes)

      counts = self%gather(merge(1, 0, own))
      of_all = reshape(counts == 1, shape(of_all))
   end function flags_of_all

   !> What the first process that has something to say says; empty: none has.
   function first_text(self, own) result(text)
      class(communicator_t), intent(in) :: self
      !> Of this process; empty: nothing
      character(len=*), intent(in) :: own
      character(len=:), allocatable :: text
      integer, allocatable :: letters(:)
      integer :: i, speaker, lengths(self%n_processes)

      text = own
      if (self%n_processes == 1) return
      lengths = self%gather([len(own)])
      speaker = findloc(lengths > 0, .true., 1)
      if (speaker == 0) return
      allocate (letters(lengths(speaker)))
      letters = self%gather([(iachar(own(i:i)), i=1, merge(len(own), 0, self%process == speaker))])
      text = repeat(' ', size(letters))
      do i = 1, size(letters)
         text(i:i) = achar(letters(i))
      end do
   end function first_text

   !> Values of the nodes that belong to this process, zero at those of others (n_nodes).
   pure function own_part_of_nodes(self, values) result(part)
      class(communicator_t), intent(in) :: self
      !> (n_nodes)
      real(dp), intent(in) :: values(:)
      real(dp) :: part(size(values))
      integer :: node

      part = values
      if (self%n_processes == 1) return
      do node = 1, size(values)
         if (.not. self%owns(node)) part(node) = 0
      end do
   end function own_part_of_nodes

   !> Values of the nodes that belong to this process, zero at those of others (values of a node, n_nodes).
   pure function own_part_of_slots(self, values) result(part)
      class(communicator_t), intent(in) :: self
      !> (values of a node, n_nodes)
      real(dp), intent(in) :: values(:, :)
      real(dp) :: part(size(values, 1), size(values, 2))
      integer :: node

      part = values
      if (self%n_processes == 1) return
      do node = 1, size(values, 2)
         if (.not. self%owns(node)) part(:, node) = 0
      end do
   end function own_part_of_slots

   !> Nodes of the whole model.
   integer function count_nodes(self, n_nodes)
      class(communicator_t), intent(in) :: self
      !> That this process has
      integer, intent(in) :: n_nodes
      integer :: node

      count_nodes = self%sum(count([(self%owns(node), node=1, n_nodes)]))
   end function count_nodes

   function keep_numbers(self, own) result(gathered)
      class(one_process_t), intent(in) :: self
      !> (n)
      real(dp), intent(in) :: own(:)
      real(dp), allocatable :: gathered(:)

      gathered = own
   end function keep_numbers

   function keep_counts(self, own) result(gathered)
      class(one_process_t), intent(in) :: self
      !> (n)
      integer, intent(in) :: own(:)
      integer, allocatable :: gathered(:)

      gathered = own
   end function keep_counts

   pure logical function owns_all(self, node)
      class(one_process_t), intent(in) :: self
      !> Index of the node
      integer, intent(in) :: node

      owns_all = .true.
   end function owns_all

   pure integer function same_number(self, node) result(number)
      class(one_process_t), intent(in) :: self
      !> Index of the node
      integer, intent(in) :: node

      number = node
   end function same_number

   pure function no_nodes(self) result(nodes)
      class(one_process_t), intent(in) :: self
      integer, allocatable :: nodes(:)

      allocate (nodes(0))
   end function no_nodes

   !> No node is shared.
   subroutine add_nothing(self, values)
      class(one_process_t), intent(in) :: self
      !> (values of a node, n_nodes)
      real(dp), intent(inout) :: values(:, :)
   end subroutine add_nothing

end module litz_communicator
