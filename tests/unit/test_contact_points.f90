!> Crossings that slide along their wires are known again: two long wires of ten elements, and a closed ring of 24.
program test_contact_points
   use litz_contact_matching, only: match_points, slides_of
   use litz_contact_points, only: contact_point_t, arc_at, chain_by_wire, points_by_wire_t
   use litz_deck_reader, only: read_deck
   use litz_errors, only: error_list_t
   use litz_kinds, only: dp, pi
   use litz_model, only: model_t
   use litz_problem, only: problem_t, prepare_problem
   implicit none

   character(len=*), parameter :: nl = new_line('a')
   !> Length of the elements of the straight wires [m]
   real(dp), parameter :: length = 0.01_dp
   !> First element of the second straight wire, and of the ring
   integer, parameter :: second = 10, ring = 20
   integer :: failures = 0

   call arc_lengths_of_neighbours_meet_at_their_node()
   call a_crossing_that_stays_is_itself()
   call a_crossing_is_handed_over_to_the_next_element()
   call crossings_do_not_exchange_their_memory()
   call a_crossing_of_other_wires_is_not_taken()
   call the_way_over_the_seam_of_a_ring_is_short()
   call a_long_slide_is_followed_by_the_motion_of_the_nodes()
   call chains_hold_the_points_of_each_wire()
   if (failures > 0) error stop 1

contains

   subroutine arc_lengths_of_neighbours_meet_at_their_node()
      type(problem_t) :: problem
      integer :: e

      call prepare(problem)
      do e = 1, 9
         call check(near(arc_at(problem%wires, problem%elements, e, 1.0_dp), &
            arc_at(problem%wires, problem%elements, e + 1, -1.0_dp)), 'a node has one arc length')
      end do
   end subroutine arc_lengths_of_neighbours_meet_at_their_node

   subroutine a_crossing_that_stays_is_itself()
      type(problem_t) :: problem
      integer, allocatable :: origin(:)

      call prepare(problem)
      call match_points(problem%wires, problem%elements, [point(problem, 3, 0.2_dp, second + 4, 0.0_dp)], &
         [point(problem, 3, 0.3_dp, second + 4, 0.1_dp)], origin)
      call check(all(origin == [1]), 'the same two elements')
   end subroutine a_crossing_that_stays_is_itself

   subroutine a_crossing_is_handed_over_to_the_next_element()
      type(problem_t) :: problem
      integer, allocatable :: origin(:)

      call prepare(problem)
      call match_points(problem%wires, problem%elements, [point(problem, 3, 0.9_dp, second + 4, 0.9_dp)], &
         [point(problem, 4, -0.9_dp, second + 5, -0.9_dp)], origin)
      call check(all(origin == [1]), 'over a node of both wires')
   end subroutine a_crossing_is_handed_over_to_the_next_element

   !> Two crossings of the same two wires move by one element: the elements of one are those that the other had.
   subroutine crossings_do_not_exchange_their_memory()
      type(problem_t) :: problem
      integer, allocatable :: origin(:)

      call prepare(problem)
      call match_points(problem%wires, problem%elements, &
         [point(problem, 2, 0.8_dp, second + 4, 0.0_dp), point(problem, 6, 0.8_dp, second + 4, 0.0_dp)], &
         [point(problem, 3, -0.8_dp, second + 4, 0.0_dp), point(problem, 7, -0.8_dp, second + 4, 0.0_dp)], origin)
      call check(all(origin == [1, 2]), 'each continues the nearest')
   end subroutine crossings_do_not_exchange_their_memory

   subroutine a_crossing_of_other_wires_is_not_taken()
      type(problem_t) :: problem
      integer, allocatable :: origin(:)

      call prepare(problem)
      call match_points(problem%wires, problem%elements, [point(problem, 3, 0.2_dp, ring + 2, 0.0_dp)], &
         [point(problem, 3, 0.2_dp, second + 2, 0.0_dp)], origin)
      call check(all(origin == [0]), 'another wire is another contact')
   end subroutine a_crossing_of_other_wires_is_not_taken

   subroutine the_way_over_the_seam_of_a_ring_is_short()
      type(problem_t) :: problem
      integer, allocatable :: origin(:)

      call prepare(problem)
      call match_points(problem%wires, problem%elements, [point(problem, 3, 0.2_dp, ring + 24, 0.9_dp)], &
         [point(problem, 3, 0.2_dp, ring + 1, -0.9_dp)], origin)
      call check(all(origin == [1]), 'where the numbering of a closed wire begins')
   end subroutine the_way_over_the_seam_of_a_ring_is_short

   !> The second wire is moved along the first one by five elements.
   subroutine a_long_slide_is_followed_by_the_motion_of_the_nodes()
      type(problem_t) :: problem
      type(contact_point_t) :: before(1)
      integer, allocatable :: origin(:)
      real(dp), allocatable :: x(:, :)
      real(dp) :: slides(2, 1)

      call prepare(problem)
      before = [point(problem, 3, 0.0_dp, second + 5, 1.0_dp)]
      x = problem%model%x
      x(1, 12:22) = x(1, 12:22) + 5*length
      slides = slides_of(problem%model, problem%wires, problem%elements, before, problem%model%x, x)
      call check(near(slides(1, 1), 5*length) .and. near(slides(2, 1), 0.0_dp), 'along the first wire only')
      call match_points(problem%wires, problem%elements, before, &
         [point(problem, 3, 0.0_dp, second + 5, 1.0_dp), point(problem, 8, 0.0_dp, second + 5, 1.0_dp)], origin)
      call check(all(origin == [1, 0]), 'without the motion it is where it was')
      call match_points(problem%wires, problem%elements, before, [point(problem, 8, 0.0_dp, second + 5, 1.0_dp)], &
         origin, slides)
      call check(all(origin == [1]), 'with the motion it is found where the nodes have taken it')
   end subroutine a_long_slide_is_followed_by_the_motion_of_the_nodes

   subroutine chains_hold_the_points_of_each_wire()
      type(problem_t) :: problem
      type(points_by_wire_t) :: by_wire
      integer :: wire, k, n

      call prepare(problem)
      by_wire = chain_by_wire(problem%wires, [point(problem, 1, 0.0_dp, second + 1, 0.0_dp), &
         point(problem, second + 1, 0.0_dp, ring + 1, 0.0_dp), point(problem, 2, 0.0_dp, ring + 1, 0.0_dp)])
      wire = problem%wires%wire(1)
      k = by_wire%first(wire)
      n = 0
      do while (k > 0)
         call check(k == 1 .or. k == 3, 'points of the first wire')
         n = n + 1
         k = by_wire%next(k)
      end do
      call check(n == 2 .and. by_wire%first(problem%wires%wire(ring + 1)) == 0, 'all of them, and none of another')
   end subroutine chains_hold_the_points_of_each_wire

   type(contact_point_t) function point(problem, element_bar, xi_bar, element, xi)
      type(problem_t), intent(in) :: problem
      integer, intent(in) :: element_bar, element
      real(dp), intent(in) :: xi_bar, xi

      point%element_bar = element_bar
      point%element = element
      point%xi_bar = xi_bar
      point%xi = xi
      point%arc_bar = arc_at(problem%wires, problem%elements, element_bar, xi_bar)
      point%arc = arc_at(problem%wires, problem%elements, element, xi)
   end function point

   !> Elements 1 to 10 along x, 11 to 20 along y above the middle of element 3, 21 to 44 a ring.
   subroutine prepare(problem)
      type(problem_t), intent(inout) :: problem
      type(model_t) :: model
      type(error_list_t) :: errors, warnings
      character(len=100) :: line
      integer :: unit, i

      open (newunit=unit, file='contact_points.inp', action='write', status='replace')
      write (unit, '(a)') '*NODE'
      do i = 0, 10
         write (unit, '(i0, 2(a, es23.16), a)') i + 1, ', ', i*length, ', ', 0.0_dp, ', 0'
      end do
      do i = 0, 10
         write (unit, '(i0, 2(a, es23.16), a)') i + 12, ', ', 2.5_dp*length, ', ', (i - 5)*length, ', 0.005'
      end do
      do i = 0, 23
         write (unit, '(i0, 2(a, es23.16), a)') i + 23, ', ', 0.02_dp*cos(i*pi/12), ', ', 0.02_dp*sin(i*pi/12), ', 0.05'
      end do
      write (unit, '(a)') '*ELEMENT, TYPE=B33, ELSET=ALL'
      do i = 1, 44
         write (line, '(i0, a, i0, a, i0)') i, ', ', i + merge(0, merge(1, 2, i <= 20), i <= 10), ', ', &
            merge(23, i + merge(1, merge(2, 3, i <= 20), i <= 10), i == 44)
         write (unit, '(a)') trim(line)
      end do
      write (unit, '(a)') '*MATERIAL, NAME=M'//nl//'*ELASTIC'//nl//'1e11, 0.3'//nl// &
         '*BEAM SECTION, ELSET=ALL, MATERIAL=M, SECTION=CIRC'//nl//'1e-3'//nl// &
         '*SURFACE INTERACTION, NAME=T'//nl//'*CONTACT PAIR, INTERACTION=T'//nl//'ALL'//nl// &
         '*STEP'//nl//'*STATIC'//nl//'1., 1.'//nl//'*BOUNDARY'//nl//'1, 1, 6'//nl//'*END STEP'
      close (unit)
      call read_deck('contact_points.inp', model, errors, warnings)
      if (errors%count > 0) then
         print '(a)', errors%text()
         error stop 1
      end if
      call prepare_problem(model, problem)
   end subroutine prepare

   elemental logical function near(a, b)
      real(dp), intent(in) :: a, b

      near = abs(a - b) <= 1.0e-12_dp
   end function near

   subroutine check(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what

      if (holds) return
      failures = failures + 1
      print '(2a)', 'FAILED: ', what
   end subroutine check

end program test_contact_points
