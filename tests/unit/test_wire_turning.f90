!> A wire touches itself only where it has turned far enough to come back: what is left out has no nearest places.
program test_wire_turning
   use litz_axis, only: axis_turning, axis_polynomial
   use litz_axis_choices, only: axis_hermite
   use litz_contact_tangents, only: axis_of_element
   use litz_deck_reader, only: read_deck
   use litz_errors, only: error_list_t
   use litz_kinds, only: dp, pi
   use litz_model, only: model_t
   use litz_problem, only: problem_t, prepare_problem
   use litz_rotations, only: cross, rotation_exp
   use litz_wire_turning, only: wire_turning_t, measure_turning
   implicit none

   character(len=*), parameter :: nl = new_line('a')
   !> Wires that bend at random, elements of each, and samples along each element of the brute force
   integer, parameter :: n_wires = 12, n_along = 60, n_samples = 8
   !> Elements of the ring that follows, and of the arc of 160 degrees
   integer, parameter :: n_ring = 36, n_arc = 20
   integer, parameter :: n_random = n_wires*n_along, first_arc = n_random + n_ring + 1
   type(problem_t) :: problem
   type(model_t) :: model
   type(wire_turning_t) :: turning
   integer :: failures = 0

   call prepare()
   call no_axis_turns_by_more_than_its_bound()
   call measure(problem, turning)
   call the_bound_of_a_wire_is_close_to_its_turning()
   call nearest_places_lie_where_a_wire_has_come_back()
   call a_ring_comes_back_by_both_ways()
   call an_arc_that_is_no_half_circle_does_not_come_back()
   call what_has_turned_before_counts()
   if (failures > 0) error stop 1

contains

   !> Cubics of all kinds, loops and cusps included, and the polygon of their chords.
   subroutine no_axis_turns_by_more_than_its_bound()
      real(dp) :: p(3, 0:3)
      integer :: i

      do i = 1, 2000
         call random_number(p)
         p = 2*p - 1
         call check(axis_turning(p) >= sampled_turning(p)*(1 - 1.0e-12_dp), 'bound of the turning of a cubic')
      end do
      p = axis_polynomial(axis_hermite, pi/6, &
         reshape([0.0_dp, 0.0_dp, 0.0_dp, 0.5_dp, 1 - sqrt(0.75_dp), 0.0_dp], [3, 2]), &
         reshape([1.0_dp, 0.0_dp, 0.0_dp, sqrt(0.75_dp), 0.5_dp, 0.0_dp], [3, 2]))
      call check(abs(axis_turning(p) - pi/6) < 1.0e-12_dp, 'an arc of 30 degrees')
   end subroutine no_axis_turns_by_more_than_its_bound

   !> Sampled tangents turn by a little less than the bound: within 5 % for these wires, which twist out of planes.
   subroutine the_bound_of_a_wire_is_close_to_its_turning()
      real(dp) :: sampled
      integer :: w, e

      do w = 1, n_wires
         sampled = 0
         do e = (w - 1)*n_along + 1, w*n_along
            sampled = sampled + sampled_turning(axis(e))
         end do
         associate (bound => turning%along(problem%wires, (w - 1)*n_along + 1, w*n_along))
            call check(bound >= sampled .and. bound <= 1.05_dp*sampled, 'the bound of a wire')
         end associate
      end do
   end subroutine the_bound_of_a_wire_is_close_to_its_turning

   !> Brute force: all places of a wire with all others. Where their distance is less than that of all places around
   !> them, their wire has come back between them. There are many such places, and most pairs of elements are left out.
   subroutine nearest_places_lie_where_a_wire_has_come_back()
      integer, parameter :: n = n_along*n_samples
      real(dp) :: x(3, n), square(n, n)
      integer :: w, i, j, n_found, n_left_out

      n_found = 0
      n_left_out = 0
      do w = 1, n_wires
         do i = 1, n
            x(:, i) = sample(w, i)
         end do
         do j = 1, n
            square(:, j) = sum((x - spread(x(:, j), 2, n))**2, 1)
         end do
         do j = 2, n - 1
            do i = 2, j - 2
               if (minloc(pack(square(i - 1:i + 1, j - 1:j + 1), .true.), 1) /= 5) cycle
               n_found = n_found + 1
               call check(comes_back(element(w, i), element(w, j)), 'a wire has come back to its nearest place')
            end do
         end do
         do j = (w - 1)*n_along + 1, w*n_along
            n_left_out = n_left_out + count([(.not. comes_back(i, j), i=(w - 1)*n_along + 1, j - 1)])
         end do
      end do
      call check(n_found > 2*n_wires, 'wires come back to themselves often')
      call check(n_left_out > n_wires*n_along, 'neighbours are left out')
   end subroutine nearest_places_lie_where_a_wire_has_come_back

   !> Places of a ring have nearest places on its other side alone: both ways round must turn.
   subroutine a_ring_comes_back_by_both_ways()
      integer :: i, apart

      do i = 1, n_ring
         apart = min(i - 1, n_ring - i + 1)
         ! with both elements the short way round turns by 10 degrees for each element: 165 are needed
         call check(comes_back(n_random + 1, n_random + i) .eqv. 10*(apart + 1) > 165, 'a ring by the short way')
      end do
   end subroutine a_ring_comes_back_by_both_ways

   subroutine an_arc_that_is_no_half_circle_does_not_come_back()
      integer :: i, j

      do i = first_arc, first_arc + n_arc - 1
         do j = i + 1, first_arc + n_arc - 1
            call check(.not. comes_back(i, j), 'an arc of 160 degrees')
         end do
      end do
   end subroutine an_arc_that_is_no_half_circle_does_not_come_back

   !> A ring that is straightened was one when the increment began.
   subroutine what_has_turned_before_counts()
      type(wire_turning_t) :: later
      real(dp) :: x(3, model%n_nodes), rotation(3, 3, model%n_nodes)
      integer :: i

      x = model%x
      rotation = no_rotation()
      do i = 1, n_arc + 1
         associate (node => model%n_nodes - n_arc - 1 + i)
            ! the arc straightened: its nodes along x, turned back to it
            x(:, node) = [1.0_dp*i, 0.0_dp, 0.0_dp]
            rotation(:, :, node) = rotation_exp([0.0_dp, 0.0_dp, -(i - 1)*160*pi/180/n_arc])
         end associate
      end do
      call measure_turning(problem%model, problem%wires, problem%elements, x, rotation, later)
      call check(later%along(problem%wires, first_arc, first_arc + n_arc - 1) < 0.1_dp, 'a straightened arc')
      call measure_turning(problem%model, problem%wires, problem%elements, x, rotation, later, turning)
      call check(later%along(problem%wires, first_arc, first_arc + n_arc - 1) >= 160*pi/180*(1 - 1.0e-3_dp), &
         'an arc that was bent')
   end subroutine what_has_turned_before_counts

   ! Sampling

   !> By what angle the tangent of a cubic turns, by many samples: no more than it does.
   real(dp) function sampled_turning(p) result(angle)
      !> In powers of xi (3, 0:3)
      real(dp), intent(in) :: p(3, 0:3)
      integer, parameter :: n = 400
      real(dp) :: a(3), b(3), xi
      integer :: i

      angle = 0
      a = p(:, 1) - 2*p(:, 2) + 3*p(:, 3)
      do i = 1, n
         xi = -1 + 2*real(i, dp)/n
         b = p(:, 1) + xi*(2*p(:, 2) + xi*3*p(:, 3))
         angle = angle + atan2(norm2(cross(a, b)), dot_product(a, b))
         a = b
      end do
   end function sampled_turning

   pure integer function element(w, i)
      !> Wire, and number of the sample
      integer, intent(in) :: w, i

      element = (w - 1)*n_along + (i - 1)/n_samples + 1
   end function element

   function sample(w, i) result(x)
      !> Wire, and number of the sample
      integer, intent(in) :: w, i
      real(dp) :: x(3), p(3, 0:3), xi

      p = axis(element(w, i))
      xi = -1 + (2*modulo(i - 1, n_samples) + 1)/real(n_samples, dp)
      x = p(:, 0) + xi*(p(:, 1) + xi*(p(:, 2) + xi*p(:, 3)))
   end function sample

   function axis(e) result(p)
      !> Element
      integer, intent(in) :: e
      real(dp) :: p(3, 0:3)

      p = axis_of_element(problem%model, problem%wires, problem%elements, e, problem%model%x, no_rotation())
   end function axis

   logical function comes_back(a, b)
      !> Elements
      integer, intent(in) :: a, b

      comes_back = turning%comes_back(problem%wires, a, b)
   end function comes_back

   subroutine measure(of, found)
      type(problem_t), intent(in) :: of
      type(wire_turning_t), intent(inout) :: found

      call measure_turning(of%model, of%wires, of%elements, of%model%x, no_rotation(), found)
   end subroutine measure

   function no_rotation() result(rotation)
      real(dp) :: rotation(3, 3, model%n_nodes)
      integer :: i

      rotation = 0
      do i = 1, 3
         rotation(i, i, :) = 1
      end do
   end function no_rotation

   ! The wires

   !> Wires that wind at random, a ring, and an arc of 160 degrees.
   subroutine prepare()
      type(error_list_t) :: errors, warnings
      integer :: unit, w, i, node

      call random_seed(put=[(104729*i, i=1, 64)])
      open (newunit=unit, file='wire_turning.inp', action='write', status='replace')
      write (unit, '(a)') '*NODE'
      do w = 1, n_wires
         call write_random_wire(unit, (w - 1)*(n_along + 1))
      end do
      node = n_wires*(n_along + 1)
      do i = 1, n_ring
         associate (angle => i*2*pi/n_ring)
            write (unit, '(i0, 2(a, es23.16), a)') node + i, ', ', 10*cos(angle), ', ', 10*sin(angle), ', 0'
         end associate
      end do
      do i = 0, n_arc
         associate (angle => i*160*pi/180/n_arc)
            write (unit, '(i0, 2(a, es23.16), a)') node + n_ring + 1 + i, ', ', 7*sin(angle), ', ', &
               7*(1 - cos(angle)), ', 50'
         end associate
      end do
      write (unit, '(a)') '*ELEMENT, TYPE=B33, ELSET=ALL'
      do w = 1, n_wires
         do i = 1, n_along
            write (unit, '(i0, 2(a, i0))') (w - 1)*n_along + i, ', ', (w - 1)*(n_along + 1) + i, ', ', &
               (w - 1)*(n_along + 1) + i + 1
         end do
      end do
      do i = 1, n_ring
         write (unit, '(i0, 2(a, i0))') n_random + i, ', ', node + i, ', ', node + modulo(i, n_ring) + 1
      end do
      do i = 1, n_arc
         write (unit, '(i0, 2(a, i0))') n_random + n_ring + i, ', ', node + n_ring + i, ', ', node + n_ring + i + 1
      end do
      write (unit, '(a)') '*MATERIAL, NAME=M'//nl//'*ELASTIC'//nl//'1e11, 0.3'//nl// &
         '*BEAM SECTION, ELSET=ALL, MATERIAL=M, SECTION=CIRC'//nl//'1e-1'//nl//'*BOUNDARY'
      do i = 1, node + n_ring + n_arc + 1
         write (unit, '(i0, a)') i, ', 1, 6'
      end do
      write (unit, '(a)') '*STEP'//nl//'*STATIC'//nl//'1., 1.'//nl//'*END STEP'
      close (unit)
      call read_deck('wire_turning.inp', model, errors, warnings)
      if (errors%count > 0) then
         print '(a)', errors%text()
         error stop 1
      end if
      call prepare_problem(model, problem)
      model = problem%model
   end subroutine prepare

   !> Elements of length 1 whose directions turn by 15 degrees, about an axis that wanders.
   subroutine write_random_wire(unit, before)
      !> File, and number of the last node so far
      integer, intent(in) :: unit, before
      real(dp) :: x(3), tangent(3), pole(3), kick(3)
      integer :: i

      x = 0
      call random_number(tangent)
      tangent = tangent/norm2(tangent)
      call random_number(pole)
      pole = 2*pole - 1
      do i = 1, n_along + 1
         write (unit, '(i0, 3(a, es23.16))') before + i, ', ', x(1), ', ', x(2), ', ', x(3)
         x = x + tangent
         call random_number(kick)
         pole = pole + 0.3_dp*(2*kick - 1)
         pole = pole - dot_product(pole, tangent)*tangent
         pole = pole/norm2(pole)
         tangent = matmul(rotation_exp(15*pi/180*pole), tangent)
      end do
   end subroutine write_random_wire

   subroutine check(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what

      if (holds) return
      failures = failures + 1
      print '(2a)', 'FAILED: ', what
   end subroutine check

end program test_wire_turning
