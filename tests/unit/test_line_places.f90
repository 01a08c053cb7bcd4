!> Places of line contact stand for the whole length of each wire, whichever way its elements run.
program test_line_places
   use litz_contact_points, only: arc_at
   use litz_deck_reader, only: read_deck
   use litz_errors, only: error_list_t
   use litz_kinds, only: dp, pi
   use litz_line_places, only: line_places_t, prepare_line_places, place_at, spacing_of_places
   use litz_model, only: model_t
   use litz_problem, only: problem_t, prepare_problem
   implicit none

   character(len=*), parameter :: nl = new_line('a')
   !> Elements of the straight wire, the third of which runs against it, and all with the ring
   integer, parameter :: n_straight = 5, n_all = 29
   real(dp), parameter :: radius = 1.0e-3_dp
   type(problem_t) :: problem
   type(line_places_t) :: places
   integer :: failures = 0

   call prepare()
   call prepare_line_places(problem%wires, problem%elements%length, radius, places)
   call places_stand_for_the_length_of_each_wire()
   call places_follow_each_other_along_an_element()
   call neighbours_share_the_place_at_their_node()
   call weights_are_those_of_even_parts()
   call places_are_close_to_each_other()
   if (failures > 0) error stop 1

contains

   subroutine places_stand_for_the_length_of_each_wire()
      integer :: wire, e

      do wire = 1, problem%wires%n_wires
         call check(near(sum(places%length, problem%wires%wire(places%element) == wire), &
            sum(problem%elements%length, [(problem%wires%wire(e) == wire, e=1, n_all)])), 'length of a wire')
      end do
   end subroutine places_stand_for_the_length_of_each_wire

   !> A place by its number lies at even distances in the element, on this one or on the neighbour that has the node.
   subroutine places_follow_each_other_along_an_element()
      integer :: e, i, place

      do e = 1, n_all
         do i = 0, places%n_parts(e)
            place = place_at(places, e, i)
            associate (wires => problem%wires, elements => problem%elements)
               call check(near(wires%arc_between(wires%wire(e), &
                  arc_at(wires, elements, e, -1 + 2*real(i, dp)/places%n_parts(e)), &
                  arc_at(wires, elements, places%element(place), places%xi(place))), 0.0_dp), 'where a place lies')
            end associate
         end do
      end do
   end subroutine places_follow_each_other_along_an_element

   subroutine neighbours_share_the_place_at_their_node()
      integer :: e, next

      do e = 1, n_all
         next = problem%wires%next(2, e)
         if (next == 0) cycle
         call check(any(places%at_end(:, next) == places%at_end(2, e)), 'a node has one place')
      end do
      ! an open wire has a place more than parts
      call check(count(places%element <= n_straight) == sum(places%n_parts(:n_straight)) + 1, 'places of an open wire')
      call check(count(places%element > n_straight) == sum(places%n_parts(n_straight + 1:)), 'places of a ring')
   end subroutine neighbours_share_the_place_at_their_node

   !> Even parts, with halves at the ends of a wire.
   subroutine weights_are_those_of_even_parts()
      associate (l => problem%elements%length, n => places%n_parts)
         call check(near(places%length(place_at(places, 1, 0)), l(1)/(2*n(1))), 'half a part at the end of a wire')
         call check(near(places%length(place_at(places, 1, 1)), l(1)/n(1)), 'a part within an element')
         call check(near(places%length(place_at(places, 1, n(1))), (l(1)/n(1) + l(2)/n(2))/2), 'half of each at a node')
      end associate
   end subroutine weights_are_those_of_even_parts

   subroutine places_are_close_to_each_other()
      associate (spacing => problem%elements%length/places%n_parts)
         call check(all(spacing <= 0.4_dp*radius*(1 + 1.0e-12_dp)), 'no wider than 0.4 radii')
         call check(near(spacing_of_places(places, [1, 2], problem%elements%length(1:2)), maxval(spacing(1:2))), &
            'spacing of two elements')
      end associate
   end subroutine places_are_close_to_each_other

   !> A straight wire of elements of 2 to 6 mm, and a ring of 24.
   subroutine prepare()
      type(model_t) :: model
      type(error_list_t) :: errors, warnings
      integer :: unit, i

      open (newunit=unit, file='line_places.inp', action='write', status='replace')
      write (unit, '(a)') '*NODE'
      do i = 1, 6
         write (unit, '(i0, a, es23.16, a)') i, ', ', 1.0e-3_dp*(i + i*(i - 1)/2), ', 0, 0'
      end do
      do i = 0, 23
         write (unit, '(i0, 2(a, es23.16), a)') 7 + i, ', ', 0.01_dp*cos(i*pi/12), ', ', 0.01_dp*sin(i*pi/12), ', 0.05'
      end do
      write (unit, '(a)') '*ELEMENT, TYPE=B33, ELSET=ALL'
      write (unit, '(a)') '1, 1, 2'//nl//'2, 2, 3'//nl//'3, 4, 3'//nl//'4, 4, 5'//nl//'5, 5, 6'
      do i = 0, 23
         write (unit, '(i0, 2(a, i0))') 6 + i, ', ', 7 + i, ', ', 7 + modulo(i + 1, 24)
      end do
      write (unit, '(a)') '*MATERIAL, NAME=M'//nl//'*ELASTIC'//nl//'1e11, 0.3'//nl// &
         '*BEAM SECTION, ELSET=ALL, MATERIAL=M, SECTION=CIRC'//nl//'1e-3'//nl// &
         '*STEP'//nl//'*STATIC'//nl//'1., 1.'//nl//'*BOUNDARY'//nl//'1, 1, 6'//nl//'7, 1, 6'//nl//'*END STEP'
      close (unit)
      call read_deck('line_places.inp', model, errors, warnings)
      if (errors%count > 0) then
         print '(a)', errors%text()
         error stop 1
      end if
      call prepare_problem(model, problem)
   end subroutine prepare

   elemental logical function near(a, b)
      real(dp), intent(in) :: a, b

      near = abs(a - b) <= 1.0e-14_dp
   end function near

   subroutine check(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what

      if (holds) return
      failures = failures + 1
      print '(2a)', 'FAILED: ', what
   end subroutine check

end program test_line_places
