!> Processor time of the contact element and of a point of line contact: tangent and residual of one pair, on one core.
!>
!> Build and run: `ninja -C build verification/contact_em_performance && build/verification/contact_em_performance`.
program contact_em_performance
   use litz_kinds, only: dp, pi
   use litz_axis_choices, only: axis_linear, axis_hermite
   use litz_normal_laws, only: normal_law
   use litz_spot_laws, only: spot_law
   use litz_rotations, only: rotation_exp
   use litz_closest_points, only: closest_points
   use litz_line_law, only: line_wires
   use litz_line_point, only: line_point, line_laws_t, line_place_t, line_point_t, line_active
   use litz_contact_em, only: contact_em, contact_em_t, wire_pair_t, contact_laws_t, contact_active
   implicit none
   integer, parameter :: n_pairs = 512, repetitions = 200, rounds = 7
   real(dp), parameter :: length(2) = [2.0e-3_dp, 2.2e-3_dp], v(4) = [0.1_dp, 0.09_dp, 0.01_dp, 0.0_dp]
   type(wire_pair_t), parameter :: wires = wire_pair_t(radius=[1.0e-4_dp, 1.5e-4_dp], young=[120.0e9_dp, 70.0e9_dp], &
      poisson=[0.34_dp, 0.33_dp], resistivity=[1.7e-8_dp, 2.7e-8_dp])
   real(dp) :: x(3, 4, n_pairs), t(3, 4, n_pairs)

   call make_pairs()
   write (*, '(a)') 'Tangent and residual of a contact pair, closest points included; best of several rounds'
   write (*, '(a)') 'axis     normal law  spot law   microseconds   pairs per second'
   call report_element('hermite  LINEAR      PAPER   ', axis_hermite, 'LINEAR', 'PAPER')
   call report_element('hermite  HERTZ       HERTZ   ', axis_hermite, 'HERTZ', 'HERTZ')
   call report_element('linear   LINEAR      PAPER   ', axis_linear, 'LINEAR', 'PAPER')
   call report_element('linear   HERTZ       HERTZ   ', axis_linear, 'HERTZ', 'HERTZ')
   call report_line_point('hermite  line point          ', axis_hermite)
   call report_line_point('linear   line point          ', axis_linear)
   call report_closest_points()

contains

   !> Slightly bent wires that overlap by a tenth to a fifth of a radius, at all angles from 20 degrees.
   subroutine make_pairs()
      real(dp) :: u(8), s(2), directions(3, 2), bend(3)
      integer :: pair, node, beam, n_seed

      call random_seed(size=n_seed)
      call random_seed(put=[(1000 + 37*node, node=1, n_seed)])
      do pair = 1, n_pairs
         call random_number(u)
         s = 1.6_dp*u(1:2) - 0.8_dp
         directions(:, 1) = [1.0_dp, 0.0_dp, 0.0_dp]
         directions(:, 2) = [cos(pi*(1 + 7*u(3))/9), sin(pi*(1 + 7*u(3))/9), 0.0_dp]
         do node = 1, 4
            beam = (node + 1)/2
            x(:, node, pair) = directions(:, beam)*length(beam)/2*(real(2*node - 4*beam + 1, dp) - s(beam))
            if (beam == 1) x(3, node, pair) = sum(wires%radius) - 0.1_dp*wires%radius(1)*(1 + u(4))
            bend = 0.02_dp*(u(5:7) - 0.5_dp)*real(2*node - 4*beam + 1, dp)
            t(:, node, pair) = matmul(rotation_exp(bend), directions(:, beam))
         end do
      end do
   end subroutine make_pairs

   subroutine report_element(title, axis, normal_name, spot_name)
      character(len=*), intent(in) :: title
      integer, intent(in) :: axis
      character(len=*), intent(in) :: normal_name, spot_name
      type(contact_laws_t) :: laws
      type(contact_em_t) :: contact
      real(dp) :: k(28, 28), r(28), checksum, best
      real(dp) :: start, finish
      integer :: round, repetition, pair, info, n_active

      laws%axis = axis
      laws%normal = normal_law(normal_name, [1.0e6_dp])
      laws%spot = spot_law(spot_name)
      best = huge(best)
      checksum = 0
      do round = 1, rounds
         n_active = 0
         call cpu_time(start)
         do repetition = 1, repetitions
            do pair = 1, n_pairs
               call contact_em(x(:, :, pair), t(:, :, pair), length, v, wires, laws, 0, k, r, contact, info)
               checksum = checksum + k(1, 1) + r(28)
               if (info == contact_active) n_active = n_active + 1
            end do
         end do
         call cpu_time(finish)
         best = min(best, (finish - start)/(n_pairs*repetitions))
      end do
      write (*, '(a,f17.3,es19.3,a,f6.1,a)') title, 1.0e6_dp*best, 1/best, '   (', &
         100.0_dp*n_active/(n_pairs*repetitions), ' % in contact)'
      if (.not. abs(checksum) < huge(checksum)) error stop 'the results are not finite'
   end subroutine report_element

   !> A place near the crossing, of wires that overlap by a twentieth of a radius.
   subroutine report_line_point(title, axis)
      character(len=*), intent(in) :: title
      integer, intent(in) :: axis
      type(line_laws_t) :: laws
      type(line_place_t) :: place
      type(line_point_t) :: point
      real(dp) :: y(3, 4, n_pairs), k(28, 28), r(28), xi(n_pairs), xi_bar, checksum, best
      real(dp) :: start, finish
      integer :: round, repetition, pair, info, n_active

      laws%axis = axis
      laws%wires = line_wires(wires, 0.0_dp)
      place%weight = length(2)/6
      y = x
      do pair = 1, n_pairs
         call closest_points(x(:, :, pair), t(:, :, pair), length, axis, xi_bar, xi(pair), info)
         place%xi = xi(pair)
         call line_point(x(:, :, pair), t(:, :, pair), length, v, place, laws, k, r, point, info)
         y(3, 1:2, pair) = y(3, 1:2, pair) - point%gap - 0.05_dp*wires%radius(1)
      end do
      best = huge(best)
      checksum = 0
      do round = 1, rounds
         n_active = 0
         call cpu_time(start)
         do repetition = 1, repetitions
            do pair = 1, n_pairs
               place%xi = xi(pair)
               call line_point(y(:, :, pair), t(:, :, pair), length, v, place, laws, k, r, point, info)
               checksum = checksum + k(1, 1) + r(28)
               if (info == line_active) n_active = n_active + 1
            end do
         end do
         call cpu_time(finish)
         best = min(best, (finish - start)/(n_pairs*repetitions))
      end do
      write (*, '(a,f17.3,es19.3,a,f6.1,a)') title, 1.0e6_dp*best, 1/best, '   (', &
         100.0_dp*n_active/(n_pairs*repetitions), ' % in contact)'
      if (.not. abs(checksum) < huge(checksum)) error stop 'the results are not finite'
   end subroutine report_line_point

   subroutine report_closest_points()
      real(dp) :: xi_bar, xi, checksum, best
      real(dp) :: start, finish
      integer :: round, repetition, pair, status

      best = huge(best)
      checksum = 0
      do round = 1, rounds
         call cpu_time(start)
         do repetition = 1, repetitions
            do pair = 1, n_pairs
               call closest_points(x(:, :, pair), t(:, :, pair), length, axis_hermite, xi_bar, xi, status)
               checksum = checksum + xi_bar + xi
            end do
         end do
         call cpu_time(finish)
         best = min(best, (finish - start)/(n_pairs*repetitions))
      end do
      write (*, '(a,f17.3,es19.3)') 'hermite  closest points alone', 1.0e6_dp*best, 1/best
      if (.not. abs(checksum) < huge(checksum)) error stop 'the results are not finite'
   end subroutine report_closest_points

end program contact_em_performance
