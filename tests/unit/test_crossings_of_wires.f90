!> What is found among sorted crossings is what a look at all of them finds.
program test_crossings_of_wires
   use litz_contact_points, only: contact_point_t
   use litz_crossings_of_wires, only: crossings_of_wires_t, sort_crossings
   use litz_kinds, only: dp, pi
   use litz_wires, only: wires_t
   implicit none

   integer, parameter :: n_wires = 4, n_crossings = 300, n_points = 400
   type(wires_t) :: wires
   type(contact_point_t) :: crossings(n_crossings), points(n_points)
   type(crossings_of_wires_t) :: sorted
   integer :: i, failures = 0

   ! an element each; the third wire is closed
   wires%n_wires = n_wires
   wires%wire = [(i, i=1, n_wires)]
   wires%circumference = [0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp]
   call scatter(crossings)
   call scatter(points)
   sorted = sort_crossings(wires, crossings)
   call the_nearest_crossing_of_the_same_wires_is_found()
   call lenses_that_reach_into_each_other_are_found()
   call waves_are_one_overlap_as_they_close()
   if (failures > 0) error stop 1

contains

   !> Anywhere, in steps of a hundredth, so that some are equally near.
   subroutine scatter(points)
      type(contact_point_t), intent(inout) :: points(:)
      real(dp) :: u(4)
      integer :: k

      do k = 1, size(points)
         call random_number(u)
         points(k)%element_bar = 1 + int(n_wires*u(1))
         points(k)%element = 1 + int(n_wires*u(2))
         points(k)%arc_bar = nint(100*u(3))/100.0_dp
         points(k)%arc = nint(100*u(4))/100.0_dp
      end do
   end subroutine scatter

   subroutine the_nearest_crossing_of_the_same_wires_is_found()
      real(dp), parameter :: reaches(3) = [0.005_dp, 0.055_dp, 10.0_dp], of_foot = 0.205_dp
      real(dp) :: least, distance
      integer :: p, r, nearest, k, legs(2)

      do p = 1, n_points
         do r = 1, size(reaches)
            call sorted%find_nearest(wires, reaches(r), of_foot, points(p), nearest, distance, legs)
            least = reaches(r)
            do k = 1, n_crossings
               least = min(least, distance_of(k, points(p), of_foot, .false.), &
                  distance_of(k, points(p), of_foot, .true.))
            end do
            if (nearest == 0) then
               call check(.not. least < reaches(r), 'a crossing within reach')
               cycle
            end if
            call check(abs(distance - least) <= 0, 'the least distance')
            call check(min(distance_of(nearest, points(p), of_foot, .false.), &
               distance_of(nearest, points(p), of_foot, .true.)) <= least, 'the nearest crossing')
         end do
      end do
   end subroutine the_nearest_crossing_of_the_same_wires_is_found

   !> Of a crossing from a point along the wire of its place; huge: of other wires, or beyond the reach of the foot.
   pure real(dp) function distance_of(k, point, of_foot, is_turned)
      !> Number of the crossing
      integer, intent(in) :: k
      type(contact_point_t), intent(in) :: point
      !> Along the wire of the foot [m]
      real(dp), intent(in) :: of_foot
      !> The barred wire of the crossing is that of the foot
      logical, intent(in) :: is_turned

      distance_of = huge(distance_of)
      associate (c => crossings(k))
         if (any([c%element_bar, c%element] /= merge([point%element_bar, point%element], &
            [point%element, point%element_bar], is_turned))) return
         if (wires%arc_between(point%element_bar, point%arc_bar, merge(c%arc_bar, c%arc, is_turned)) > of_foot) return
         distance_of = wires%arc_between(point%element, point%arc, merge(c%arc, c%arc_bar, is_turned))
      end associate
   end function distance_of

   !> By how much each other crossing of the same wires makes an overlap of it: the nearer and the deeper it is, but for
   !> those so near that both are one lens.
   subroutine lenses_that_reach_into_each_other_are_found()
      real(dp) :: half_length(n_crossings), expected(n_crossings), apart
      integer :: a, b

      call random_number(half_length)
      half_length = max(0.0_dp, 0.04_dp*(half_length - 0.3_dp))
      call random_number(crossings%gap)
      crossings%gap = -crossings%gap
      expected = 0
      do a = 1, n_crossings
         do b = 1, n_crossings
            if (a == b .or. .not. min(half_length(a), half_length(b)) > 0) cycle
            if (crossings(a)%element_bar /= crossings(b)%element_bar .or. crossings(a)%element /= &
               crossings(b)%element) cycle
            apart = max(wires%arc_between(crossings(a)%element_bar, crossings(a)%arc_bar, crossings(b)%arc_bar), &
               wires%arc_between(crossings(a)%element, crossings(a)%arc, crossings(b)%arc))
            expected(a) = max(expected(a), rising((pi - apart/(half_length(a) + half_length(b)))/(pi/2)) &
               *rising(5*apart/(half_length(a) + half_length(b)))*rising(2*crossings(b)%gap/crossings(a)%gap))
         end do
      end do
      call sorted%mark_common_lenses(wires, half_length, crossings)
      call check(any(expected >= 1) .and. any(expected > 0 .and. expected < 1), 'some reach into each other')
      call check(all(abs(crossings%long_share - expected) < 1.0e-9_dp), 'lenses that reach into each other')
   end subroutine lenses_that_reach_into_each_other_are_found

   !> From 0 to 1 between 0 and 1.
   pure real(dp) function rising(u)
      !> [-]
      real(dp), intent(in) :: u

      rising = 3*max(0.0_dp, min(1.0_dp, u))**2 - 2*max(0.0_dp, min(1.0_dp, u))**3
   end function rising

   !> Two wires the distance of which goes in waves, `-overlap + A (1 - cos(2 pi s/L))`: one overlap as it closes on the
   !> crests, where they overlap by 2 A; two lenses where each reaches over less than a third of the wave.
   subroutine waves_are_one_overlap_as_they_close()
      real(dp), parameter :: amplitude = 1.0e-3_dp, wave = 0.1_dp
      type(contact_point_t) :: two(2)
      real(dp) :: before, share
      integer :: k

      two%element_bar = 1
      two%element = 2
      two%arc_bar = [0.4_dp, 0.4_dp + wave]
      two%arc = two%arc_bar
      before = 0
      do k = 0, 10
         two%gap = -amplitude*(0.5_dp + 1.5_dp*k/10)
         two%long_share = 0
         associate (of_two => sort_crossings(wires, two))
            call of_two%mark_common_lenses(wires, wave/(2*pi)*sqrt(-2*two%gap/amplitude), two)
         end associate
         share = two(1)%long_share
         call check(abs(two(2)%long_share - share) <= 0, 'equal waves')
         if (k == 0) call check(share < 1.0e-12_dp, 'waves that overlap over a third')
         if (k > 0) call check(share > before, 'more as they overlap more')
         before = share
      end do
      call check(abs(share - 1) < 1.0e-12_dp, 'waves that close')
   end subroutine waves_are_one_overlap_as_they_close

   subroutine check(ok, what)
      logical, intent(in) :: ok
      !> What should hold
      character(len=*), intent(in) :: what

      if (ok) return
      failures = failures + 1
      print '(2a)', 'failed: ', what
   end subroutine check

end program test_crossings_of_wires
