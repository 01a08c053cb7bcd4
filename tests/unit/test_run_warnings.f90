!> The list of warnings: what repeats is counted, what is different has its own entry, and the list is bounded.
program test_run_warnings
   use litz_kinds, only: dp
   use litz_run_warnings, only: run_warnings_t, max_pairs
   implicit none
   type(run_warnings_t) :: list, copy
   logical :: ok
   integer :: i, step

   ! a shallow contact through two steps of 50000 increments, worst at increment 700 of the first
   do step = 1, 2
      do i = 1, 50000
         call list%set_place(step, i, (step - 1)*5.0_dp + 1.0e-4_dp*i)
         call list%add('shallow_angle', 'wires cross', [3, 13], merge(2.0_dp, 7.0_dp, step == 1 .and. i == 700), &
            'degrees', smaller_is_worse=.true.)
      end do
   end do
   call expect(list%n == 1, 'what repeats is one entry')
   associate (item => list%items(1))
      call expect(item%count == 100000, 'each increment is counted')
      call expect(all(item%first == [1, 1]) .and. all(item%last == [2, 50000]), 'first and last increment are kept')
      call expect(abs(item%first_time - 1.0e-4_dp) < 1.0e-12_dp .and. abs(item%last_time - 10) < 1.0e-12_dp, &
         'with their times')
      call expect(abs(item%worst - 2) < 1.0e-12_dp, 'the smallest angle is the worst')
      call expect(item%text() == 'wires cross (100000 increments, 1:1 to 2:50000, worst 2 degrees)', &
         'in words: '//item%text())
   end associate

   ! two contacts of the same elements in one increment are one increment
   call list%add('shallow_angle', 'wires cross', [3, 13], 1.0_dp, 'degrees', smaller_is_worse=.true.)
   call expect(list%items(1)%count == 100000, 'an increment is counted once')
   call expect(abs(list%items(1)%worst - 1) < 1.0e-12_dp, 'the worse of two in one increment is kept')

   call list%add('shallow_angle', 'others cross', [3, 14], 5.0_dp, 'degrees', smaller_is_worse=.true.)
   call list%add('penetration', 'wires overlap', [3, 13], 9.0_dp, '%')
   call list%add('penetration', 'wires overlap', [3, 13], 8.0_dp, '%')
   call list%add('round_off', 'accepted'//new_line('a')//'all the same'//achar(9))
   call expect(list%n == 4, 'other elements and other kinds have their own entries')
   call expect(abs(list%items(3)%worst - 9) < 1.0e-12_dp, 'the largest overlap is the worst')
   call expect(list%items(4)%text() == 'accepted all the same ', 'a message is one line: '//list%items(4)%text())
   call expect(list%counts() == '4 warnings (shallow_angle: 2, penetration: 1, round_off: 1)', &
      'they are counted by kind: '//list%counts())

   ! a mat in which more and more contacts overlap
   do i = 1, 3000
      call list%set_place(3, i, real(i, dp))
      call list%add('penetration', 'wires overlap', [i, i + 10000], real(i, dp), '%')
   end do
   call expect(list%n == 4 + max_pairs, 'entries of a kind are bounded')
   associate (rest => list%items(list%n))
      call expect(rest%is_rest .and. all(rest%elements == 0), 'the last one stands for the rest')
      ! the first pair of this kind came before
      call expect(rest%count == 3000 - max_pairs + 1, 'it counts the increments of the rest')
      call expect(abs(rest%worst - 3000) < 1.0e-12_dp, 'and has their worst')
   end associate
   call list%add('penetration', 'wires overlap', [5, 10005], 1.0_dp, '%')
   call expect(list%items(9)%count == 2, 'those that have an entry go on')

   call copy%from_numbers(list%to_numbers(), ok)
   call expect(ok .and. copy%n == list%n, 'the list comes back from a file')
   call expect(copy%n_shown == copy%n, 'and is not shown again')
   do i = 1, list%n
      call expect(copy%items(i)%text() == list%items(i)%text() .and. copy%items(i)%kind == list%items(i)%kind .and. &
         all(copy%items(i)%elements == list%items(i)%elements) .and. &
         .not. abs(copy%items(i)%last_time - list%items(i)%last_time) > 0 .and. &
         (copy%items(i)%is_rest .eqv. list%items(i)%is_rest), 'entry by entry, bit for bit')
   end do
   ! the run goes on: one more increment, and the checks of the start once more
   call copy%set_place(3, 3001, 3001.0_dp)
   call copy%add('penetration', 'wires overlap', [5, 10005], 1.0_dp, '%')
   call expect(copy%items(9)%count == 3 .and. copy%n == list%n, 'a run that goes on counts on')
   call copy%set_place(0, 0, 0.0_dp)
   call copy%add('round_off', 'accepted')
   call expect(copy%items(4)%count == 1, 'a check of the start that is made again is not counted')
   call copy%from_numbers(reshape([120, 10], [1, 2]), ok)
   call expect(.not. ok, 'what is no list is refused')
   call copy%from_numbers(reshape([-1], [1, 1]), ok)
   call expect(.not. ok, 'numbers that are no characters are refused')

contains

   subroutine expect(condition, what)
      logical, intent(in) :: condition
      character(len=*), intent(in) :: what

      if (condition) return
      print '(2a)', 'failed: ', what
      error stop 1
   end subroutine expect

end program test_run_warnings
