!> Sums and maxima of one process, which are what it has, and of two, the other one of which says what it is told to;
!> and parts of which each of the two has pieces. `model_over_processes.f90` does the same with processes of MPI.
program test_communicator
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
   use litz_communicator, only: one_process_t
   use litz_joined_parts, only: parts_t
   use litz_kinds, only: dp
   use scripted_process, only: scripted_t, counts_t
   implicit none

   real(dp), parameter :: third = 1/3.0_dp
   integer, target :: call_number = 0
   integer :: failures = 0
   type(scripted_t) :: two

   two%n_processes = 2
   two%call_number => call_number
   two%shared = [1, 4]
   two%foreign = [4]
   two%number_of = [10, 20, 30, 40, 50]
   call one_process_has_what_it_counts()
   call sums_are_in_the_order_of_processes()
   call the_largest_is_that_of_any()
   call flags_and_texts_of_others_are_known()
   call a_shared_node_counts_once()
   call pieces_on_two_processes_are_one_part()
   if (failures > 0) error stop 1

contains

   subroutine one_process_has_what_it_counts()
      type(one_process_t) :: one
      type(parts_t) :: parts
      real(dp) :: value, there(1), values(1, 2)
      logical :: flags(2)

      call check(all(same([one%sum(third), one%largest(-third)], [third, -third])), 'a number')
      call check(all(same([sum(one%sum([third, third])), real(one%sum(3), dp)], [2*third, 3.0_dp])), 'several')
      call check(one%any(.true.) .and. one%owns(7) .and. one%number(7) == 7, 'a flag, and nodes')
      call check(one%first_text('words') == 'words' .and. size(one%shared_nodes()) == 0, 'its own words')
      call check(size(one%gather([1, 2])) == 2 .and. size(one%gather([third])) == 1, 'what it has')
      call check(one%count_nodes(5) == 5 .and. same(sum(one%own_part([third, third])), 2*third), 'all nodes')
      flags = one%is_first([.true., .false.])
      call check(flags(1) .and. .not. flags(2), 'it is the first')
      value = third
      there = 2
      values = third
      call one%take_largest(value, there)
      call one%add_shared(values)
      call check(same(value, third) .and. same(there(1), 2.0_dp) .and. same(values(1, 1), third), 'nothing is changed')
      call parts%start(2)
      call parts%join_processes(one)
      call parts%any_of_pieces(one, flags)
      call check(parts%find(2) == 2, 'parts are those of the process')
      call check(flags(1) .and. .not. flags(2), 'flags of its parts')
   end subroutine one_process_has_what_it_counts

   subroutine sums_are_in_the_order_of_processes()
      two%numbers = [1.0_dp]
      ! to the last bit
      call check(same(two%sum(epsilon(1.0_dp)/2), epsilon(1.0_dp)/2 + 1), 'a sum')
      two%numbers = [1.0_dp, 10.0_dp]
      call check(same(sum(two%sum([2.0_dp, 20.0_dp])*[1, 100]), 3003.0_dp), 'sums')
      call others_count([5])
      call check(two%sum(3) == 8, 'a sum of counts')
   end subroutine sums_are_in_the_order_of_processes

   subroutine the_largest_is_that_of_any()
      real(dp) :: value, there(2)

      two%numbers = [-1.0_dp]
      call check(same(two%largest(-2.0_dp), -1.0_dp), 'the largest of negative ones')
      two%numbers = [ieee_value(1.0_dp, ieee_quiet_nan)]
      call check(ieee_is_nan(two%largest(5.0_dp)), 'what is not a number wins')
      two%numbers = [9.0_dp]
      call check(ieee_is_nan(two%largest(ieee_value(1.0_dp, ieee_quiet_nan))), 'also the first')
      two%numbers = [4.0_dp, 7.0_dp, 8.0_dp]
      value = 3
      there = [1, 2]
      call two%take_largest(value, there)
      call check(same(value, 4.0_dp) .and. same(there(1), 7.0_dp) .and. same(there(2), 8.0_dp), 'what belongs to it')
      value = 4
      there = [1, 2]
      call two%take_largest(value, there)
      call check(same(value, 4.0_dp) .and. same(there(1), 1.0_dp), 'of equal ones that of the first process')
   end subroutine the_largest_is_that_of_any

   subroutine flags_and_texts_of_others_are_known()
      logical :: flags(2)

      call others_count([1])
      call check(two%any(.false.), 'a flag of the other process')
      call others_count([1, 1])
      flags = two%is_first([.true., .false.])
      call check(flags(1) .and. .not. flags(2), 'of two that have a flag the first')
      call others_count([2], [iachar('n'), iachar('o')])
      call check(two%first_text('') == 'no', 'words of the other process')
      call check(call_number == 2, 'all processes make the same calls')
      call others_count([2])
      call check(two%first_text('yes') == 'yes', 'words of the first that has some')
      call others_count([0])
      call check(two%first_text('') == '', 'no words')
   end subroutine flags_and_texts_of_others_are_known

   subroutine a_shared_node_counts_once()
      real(dp) :: values(2, 5)

      values = 1
      call check(same(sum(two%own_part(values)), 8.0_dp), 'values of own nodes')
      call check(same(sum(two%own_part(values(1, :))), 4.0_dp), 'a value of own nodes')
      call others_count([3])
      call check(two%count_nodes(5) == 7, 'nodes of both')
   end subroutine a_shared_node_counts_once

   !> Here nodes 1 and 2, and 3 and 4; the other process has nodes 1 and 4 in one piece.
   subroutine pieces_on_two_processes_are_one_part()
      type(parts_t) :: parts
      logical :: flags(5)
      real(dp) :: values(5)

      call parts%start(5)
      call parts%join(1, 2)
      call parts%join(4, 3)
      call others_count([10, 10, 40, 10])
      call parts%join_processes(two)
      call check(all([parts%find(2), parts%find(4), parts%find(5)] == [1, 3, 5]), 'pieces of this process')
      ! the numbers of the model that are told: 10, 40, 30; the part goes by the first
      flags = [.false., .false., .true., .false., .true.]
      call others_count([0, 0, 0])
      call parts%any_of_pieces(two, flags)
      call check(flags(1) .and. flags(3) .and. flags(5), 'what one piece has the other one has, too')
      flags = .false.
      call others_count([1, 0, 0])
      call parts%any_of_pieces(two, flags)
      call check(flags(1) .and. flags(3) .and. .not. flags(5), 'what a piece of the other process has')
      values = [1, 0, 2, 0, 4]
      two%numbers = [10.0_dp, 0.0_dp, 0.0_dp]
      call parts%sum_of_pieces(two, values)
      call check(same(values(1), 13.0_dp) .and. same(values(3), 13.0_dp) .and. same(values(5), 4.0_dp), 'sums of parts')
      flags = .true.
      call others_count([1, 0, 0])
      call parts%keep_first_piece(two, flags)
      call check(flags(1) .and. .not. flags(3) .and. flags(5), 'one piece of each part')
      two%process = 2
      call others_count([1, 0, 0])
      flags = .true.
      call parts%keep_first_piece(two, flags)
      call check(.not. (flags(1) .or. flags(3)) .and. flags(5), 'none where a process before has one')
      two%process = 1
   end subroutine pieces_on_two_processes_are_one_part

   !> What the other process has at the next calls.
   subroutine others_count(first, second)
      integer, intent(in) :: first(:)
      integer, intent(in), optional :: second(:)

      call_number = 0
      if (allocated(two%counts)) deallocate (two%counts)
      allocate (two%counts(2))
      two%counts(1)%values = first
      allocate (two%counts(2)%values(0))
      if (present(second)) two%counts(2)%values = second
   end subroutine others_count

   elemental logical function same(a, b)
      real(dp), intent(in) :: a, b

      same = .not. abs(a - b) > 0
   end function same

   subroutine check(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what

      if (holds) return
      failures = failures + 1
      print '(2a)', 'FAILED: ', what
   end subroutine check

end program test_communicator
