!> The user elements of FEAP and FEAPpv, called as `elmlib` of that program calls them: lines read with missing numbers
!> as zeros, arrays zeroed before a call, history in `hr`, elements with more nodes and unknowns in the same mesh.
program test_feap_host
   use litz_kinds, only: dp
   use host_stand_ins, only: start_host, n_stops, line_t, lines
   use litz_user_element, only: user_contact, n_history, history_force
   implicit none
   include 'hdata.h'
   include 'comblk.h'
   include 'cdata.h'
   include 'eldata.h'
   include 'iofile.h'
   include 'umac1.h'

   real(dp), parameter :: length = 0.02_dp, radius = 1.0e-3_dp, overlap = 2.0e-6_dp
   real(dp), parameter :: wires(8) = [radius, 2*radius, 120.0e9_dp, 100.0e9_dp, 0.34_dp, 0.3_dp, 1.7e-8_dp, 2.0e-8_dp]
   integer, parameter :: read_data = 1, check = 2, tangent = 3, results = 4, mass = 5, residual = 6
   integer, parameter :: ndf = 9, most_nodes = 5, n = ndf*most_nodes
   real(dp) :: d(500), coordinates(3, most_nodes), ul(ndf, most_nodes, 6), s(n, n), r(n)
   integer :: ix(ndf*(most_nodes + 1))

   nen = most_nodes
   ma = 3
   n_el = 41
   iow = 0
   nh1 = 11
   nh2 = 31
   coordinates = 0
   coordinates(:, :4) = reshape([-0.5_dp, 0.0_dp, 0.0_dp, 0.5_dp, 0.1_dp, 0.0_dp, -0.1_dp, -0.4_dp, 0.0_dp, 0.1_dp, &
      0.6_dp, 0.0_dp]*length, [3, 4])
   coordinates(3, 1:2) = 3*radius - overlap

   call test_a_name_is_given_before_there_is_a_mesh()
   call test_the_element_is_that_of_the_kernel()
   call test_laws_with_more_numbers_are_read()
   call test_what_is_missing_is_told_by_its_value()
   call test_the_control_data_are_checked()
   call test_failures_are_told_apart()
   call test_results_are_printed()
   call test_the_conductor()

contains

   subroutine test_a_name_is_given_before_there_is_a_mesh()
      real(dp) :: one(1)
      integer :: none(1)

      one = 0
      none = 0
      utx(1) = 'user'
      call elmt01(one, one, one, none, one, one, one, 1, 1, 1, -1)
      call expect(utx(1) == 'wirecontact', 'name of the contact element')
      call elmt02(one, one, one, none, one, one, one, 1, 1, 1, -1)
      call expect(utx(1) == 'wireconductor', 'name of the conductor')
   end subroutine test_a_name_is_given_before_there_is_a_mesh

   !> Nothing has been said or printed yet.
   subroutine start()
      logical :: is_open

      call start_host()
      inquire (unit=iow, opened=is_open)
      if (is_open .and. iow /= 0) close (iow)
      open (newunit=iow, status='scratch')
   end subroutine start

   !> Read the data of a contact element.
   subroutine read_contact(laws, choices, table)
      !> Penalty and numbers of the spot law, options, pairs of a table
      real(dp), intent(in) :: laws(:), choices(:), table(:, :)
      integer :: i

      call start()
      lines = [line_t(wires), line_t(laws), line_t(choices), (line_t(table(:, i)), i=1, size(table, 2))]
      d = 0
      ix = 7
      call elmt01(d, ul, coordinates, ix, [0.0_dp], s, r, ndf, 3, n, read_data)
   end subroutine read_contact

   subroutine call_contact(isw)
      !> What is asked for
      integer, intent(in) :: isw

      nel = 4
      s = 0
      r = 0
      call elmt01(d, ul, coordinates, ix, [0.0_dp], s, r, ndf, 3, n, isw)
   end subroutine call_contact

   subroutine test_the_element_is_that_of_the_kernel()
      real(dp) :: k(28, 28), force(28), history(n_history)
      integer :: rows(28), others(n - 28), info, i, j

      nh1 = 0
      call read_contact([1.0e6_dp], [1.0_dp, 2.0_dp, 2.0_dp], reshape([real(dp) ::], [2, 0]))
      call expect(n_stops == 0 .and. size(lines) == 0, 'three lines are read')
      call expect(nh1 == n_history .and. all(ix(:7) == 7) .and. all(ix(8:9) == 0), 'history and unknowns of a node')
      nh1 = 11
      hr = 0
      hr(nh1 + 1:nh1 + n_history - 1) = -1
      ul = 0
      ul(3, 1:2, 1) = -1.0e-6_dp
      ul(4:6, :4, 1) = reshape([0.02_dp, -0.03_dp, 0.1_dp, -0.05_dp, 0.01_dp, 0.2_dp, 0.03_dp, 0.02_dp, -0.1_dp, &
         0.01_dp, -0.02_dp, 0.15_dp]/1000, [3, 4])
      ul(7, :4, 1) = [2.0e-3_dp, 1.0e-3_dp, 0.0_dp, -1.0e-3_dp]
      history = hr(nh1:nh1 + n_history - 1)
      call user_contact(coordinates(:, :4), ul(:7, :4, 1), [wires, 1.0e6_dp, 0.0_dp], [1, 2, 2, 0, 1], history, k, &
         force, info)
      call expect(info == 0 .and. history(history_force) > 1, 'the wires touch')
      rows = [((ndf*(i - 1) + j, j=1, 7), i=1, 4)]
      others = pack([(i, i=1, n)], [(all(rows /= i), i=1, n)])
      call call_contact(tangent)
      call expect(all(abs(s(rows, rows) - k) <= 0) .and. all(abs(r(rows) + force) <= 0), 'tangent and residual')
      call expect(all(abs(s(others, :)) <= 0) .and. all(abs(s(:, others)) <= 0) .and. all(abs(r(others)) <= 0), &
         'unknowns of others')
      call expect(all(abs(hr(nh2:nh2 + n_history - 1) - history) <= 0), 'the present history')
      call expect(all(abs(hr(nh1 + 1:nh1 + n_history - 1) + 1) <= 0), 'that of the last converged state')
      call call_contact(residual)
      call expect(all(abs(s) <= 0) .and. all(abs(r(rows) + force) <= 0), 'residual alone')
      call call_contact(mass)
      call expect(all(abs(s) <= 0) .and. all(abs(r) <= 0), 'no mass')
      call call_contact(check)
      call expect(n_stops == 0, 'nothing wrong')
   end subroutine test_the_element_is_that_of_the_kernel

   subroutine test_laws_with_more_numbers_are_read()
      real(dp), parameter :: no_table(2, 0) = reshape([real(dp) ::], [2, 0])

      call read_contact([0.0_dp, 1.0e-15_dp, 1.0e-8_dp], [2.0_dp, 7.0_dp, 2.0_dp], no_table)             ! SHARVIN
      call call_contact(tangent)
      call expect(n_stops == 0 .and. maxval(abs(s)) > 0, 'a law of two numbers')
      call read_contact([0.0_dp], [2.0_dp, 6.0_dp, 2.0_dp, 0.0_dp, 2.0_dp], &
         reshape([1.0_dp, 2.0e-3_dp, 10.0_dp, 1.0e-3_dp], [2, 2]))
      call expect(size(lines) == 0, 'the table is read')
      call call_contact(tangent)
      call expect(n_stops == 0 .and. maxval(abs(s)) > 0, 'a table')
   end subroutine test_laws_with_more_numbers_are_read

   !> FEAP fills what is missing with zeros, so that only values tell.
   subroutine test_what_is_missing_is_told_by_its_value()
      real(dp), parameter :: no_table(2, 0) = reshape([real(dp) ::], [2, 0])
      integer :: i
      character(len=20), parameter :: words(8) = [character(len=20) :: 'radii', 'radii', 'Young', 'Young', '', '', &
         'resistivities', 'resistivities']

      do i = 1, 8
         if (words(i) == '') cycle
         call read_contact([1.0e6_dp], [1.0_dp, 2.0_dp, 2.0_dp], no_table)
         d(6 + i) = 0
         call refuse(words(i))
      end do
      call read_contact([0.0_dp], [1.0_dp, 2.0_dp, 2.0_dp], no_table)
      call refuse('penalty')
      call read_contact([1.0e6_dp], [0.0_dp], no_table)
      call refuse('option 1')
      call read_contact([1.0e6_dp], [1.0_dp, 0.0_dp], no_table)
      call refuse('option 3')
      call read_contact([1.0e6_dp], [1.0_dp, 3.0_dp, 2.0_dp], no_table)
      call refuse('PLASTIC')
      call read_contact([1.0e6_dp], [1.0_dp, 6.0_dp, 2.0_dp], no_table)
      call refuse('TABLE')
      call start()
      lines = [line_t(wires)]
      call elmt01(d, ul, coordinates, ix, [0.0_dp], s, r, ndf, 3, n, read_data)
      call expect(n_stops >= 1, 'a line is missing')
      call expect_printed('the line of penalty and spot law is missing')
   end subroutine test_what_is_missing_is_told_by_its_value

   subroutine refuse(words)
      !> What the message says
      character(len=*), intent(in) :: words

      call start()
      call call_contact(check)
      call expect(n_stops == 1, 'message of '//words)
      call expect_printed(trim(words))
      call expect_printed('material 3, element 41')
   end subroutine refuse

   !> A line of the output file has these words.
   subroutine expect_printed(words)
      !> Part of a line
      character(len=*), intent(in) :: words
      character(len=300) :: line
      integer :: status
      logical :: found

      found = .false.
      rewind (iow)
      do
         read (iow, '(a)', iostat=status) line
         if (status /= 0) exit
         found = found .or. index(line, words) > 0
      end do
      ! the next line is written behind the last one
      backspace (iow)
      call expect(found, 'printed: '//words)
   end subroutine expect_printed

   subroutine test_the_control_data_are_checked()
      call start()
      lines = [line_t(wires), line_t([1.0e6_dp]), line_t([1.0_dp, 2.0_dp, 2.0_dp])]
      call elmt01(d, ul, coordinates, ix, [0.0_dp], s, r, 6, 3, 6*most_nodes, read_data)
      call expect(n_stops == 1, 'unknowns of a node')
      call expect_printed('7 unknowns')
      call start()
      lines = [line_t(wires), line_t([1.0e6_dp]), line_t([1.0_dp, 2.0_dp, 2.0_dp])]
      call elmt01(d, ul, coordinates, ix, [0.0_dp], s, r, 7, 2, 7*most_nodes, read_data)
      call expect(n_stops == 1, 'dimensions')
      call expect_printed('3 space dimensions')
      call start()
      lines = [line_t(wires), line_t([1.0e6_dp]), line_t([1.0_dp, 2.0_dp, 2.0_dp])]
      call elmt01(d, ul, coordinates, ix, [0.0_dp], s, r, 7, 3, 28, read_data)
      call expect(n_stops == 1, 'arrays')
      call expect_printed('element arrays are smaller')
      call read_contact([1.0e6_dp], [1.0_dp, 2.0_dp, 2.0_dp], reshape([real(dp) ::], [2, 0]))
      nel = 3
      call elmt01(d, ul, coordinates, ix, [0.0_dp], s, r, ndf, 3, n, check)
      call expect_printed('it must have 4 nodes, not 3')
   end subroutine test_the_control_data_are_checked

   subroutine test_failures_are_told_apart()
      real(dp) :: kept(3, most_nodes)

      kept = coordinates
      call read_contact([1.0e6_dp], [1.0_dp, 2.0_dp, 2.0_dp], reshape([real(dp) ::], [2, 0]))
      nh1 = 11
      ul = 0
      coordinates(:, 3:4) = coordinates(:, 1:2)
      coordinates(3, 3:4) = coordinates(3, 1:2) - radius
      call call_contact(tangent)
      call expect(n_stops == 1, 'parallel')
      call expect_printed('where their axes are parallel')
      coordinates = kept
      ! straight axes between nodes that a motion has brought together
      call read_contact([1.0e6_dp], [1.0_dp, 2.0_dp, 1.0_dp], reshape([real(dp) ::], [2, 0]))
      nh1 = 11
      ul(:3, 2, 1) = coordinates(:, 1) - coordinates(:, 2)
      call call_contact(tangent)
      call expect(n_stops == 1, 'no closest points')
      call expect_printed('the closest points were not found')
      ul = 0
      coordinates(:, 2) = coordinates(:, 1)
      call start()
      call call_contact(tangent)
      call expect(n_stops >= 1, 'coincident nodes')
      call expect_printed('nodes 1 and 2')
      coordinates = kept
   end subroutine test_failures_are_told_apart

   subroutine test_results_are_printed()
      call read_contact([1.0e6_dp], [1.0_dp, 2.0_dp, 2.0_dp], reshape([real(dp) ::], [2, 0]))
      nh1 = 11
      hr = 0
      ul = 0
      ul(7, :2, 1) = 1.0e-3_dp
      call call_contact(results)
      call expect_printed('contact element      41  gap')
      call expect_printed('force  2.00000E+00')
      call expect(all(abs(r) <= 0) .and. all(abs(hr(nh2:nh2 + n_history - 1)) <= 0), 'nothing else')
   end subroutine test_results_are_printed

   subroutine test_the_conductor()
      integer, parameter :: voltages(2) = [7, ndf + 7]

      call start()
      lines = [line_t([1.0e-6_dp, 2.0e-8_dp])]
      d = 0
      ix = 7
      call elmt02(d, ul, coordinates, ix, [0.0_dp], s, r, ndf, 3, n, read_data)
      call expect(nh1 == 2 .and. all(ix(4:6) == 0) .and. ix(7) == 7 .and. all(ix(8:9) == 0), 'its unknowns')
      nh1 = 11
      nel = 2
      coordinates(:, 1:2) = reshape([0.0_dp, 0.0_dp, 0.0_dp, 0.3_dp, 0.4_dp, 0.0_dp], [3, 2])
      ul = 0
      ul(7, 1:2, 1) = [3.0e-3_dp, 1.0e-3_dp]
      s = 0
      r = 0
      call elmt02(d, ul, coordinates, ix, [0.0_dp], s, r, ndf, 3, n, tangent)
      call expect(abs(r(voltages(1)) + 0.2_dp) < 1.0e-14_dp .and. abs(s(voltages(1), voltages(2)) + 100) < 1.0e-11_dp, &
         'Ohm''s law')
      call expect(abs(hr(nh2) - 0.2_dp) < 1.0e-14_dp .and. abs(hr(nh2 + 1) - 0.4e-3_dp) < 1.0e-15_dp, 'results')
      call elmt02(d, ul, coordinates, ix, [0.0_dp], s, r, ndf, 3, n, results)
      call expect_printed('conductor            41  current  2.00000E-01')
      d(1) = 0
      call elmt02(d, ul, coordinates, ix, [0.0_dp], s, r, ndf, 3, n, check)
      call expect(n_stops == 1, 'bad input')
      call expect_printed('cross-section of the conductor')
   end subroutine test_the_conductor

   subroutine expect(condition, what)
      !> What must hold
      logical, intent(in) :: condition
      !> In words
      character(len=*), intent(in) :: what

      if (condition) return
      print '(2a)', 'does not hold: ', trim(what)
      error stop 1
   end subroutine expect

end program test_feap_host
