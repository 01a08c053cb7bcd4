!> Whether wires passed through each other on the way from the start of an increment to its end.
!>
!> The way is that of litz_contact_path, leg by leg. Within a leg the nodes and their tangents move uniformly, and
!> with them every point of the axes, which are cubic curves in them. Each pair of axes is followed
!> (litz_moving_axes). Where no axes meet, the end of the increment can be reached from its start without a passage.
!> Where they meet, the increment is rejected, but for a crossing that shows the same side at both ends after a small
!> turn: there the way is to blame, which is a guess.
module litz_contact_sweep
   use litz_kinds, only: dp
   use litz_axis, only: axis_polynomial, axis_sagitta
   use litz_contact_findings, only: finding_t, worse_of, finding_none, finding_passed
   use litz_contact_joints, only: lead_apart
   use litz_contact_path, only: contact_path_t
   use litz_contact_points, only: contact_set_t, contact_point_t, pair_geometry, arc_at, crossing_at
   use litz_contact_side, only: have_kept
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_moving_axes, only: find_meeting
   use litz_moving_segments, only: never, largest_relative_motion
   use litz_parallel, only: worth_threads
   use litz_straight_segments, only: segment_distance
   use litz_wires, only: wires_t
   implicit none
   private
   public :: sweep_contacts

   !> Axes that come nearer than this part of the sum of their radii have met
   real(dp), parameter :: met = 0.9_dp
   !> Joined elements overlap near their joint: they have met where their axes do
   real(dp), parameter :: met_joined = 0.05_dp

contains

   !> The worst passage of all near pairs of elements; `finding_none`: there is none.
   function sweep_contacts(model, wires, elements, contact, departed, path) result(worst)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the candidates and points of the end of the increment
      type(contact_set_t), intent(in) :: contact
      !> Pairs of elements of contacts that are gone, see find_departed_pairs (3, n)
      integer, intent(in) :: departed(:, :)
      type(contact_path_t), intent(in) :: path
      type(finding_t) :: worst
      type(finding_t), allocatable :: found(:)
      real(dp), allocatable :: x_start(:, :), rotation_start(:, :, :), x(:, :), rotation(:, :, :)
      !> Barred element, unbarred element, contact pair: joined ones first (3, n)
      integer, allocatable :: pairs(:, :)
      integer :: leg, i, n, n_joined

      n_joined = size(contact%joined, 2)
      n = n_joined + size(contact%candidates, 2)
      allocate (pairs(3, n + size(departed, 2)))
      pairs(:, :n_joined) = contact%joined
      pairs(:, n_joined + 1:n) = contact%candidates
      pairs(:, n + 1:) = departed
      allocate (found(size(pairs, 2)))
      x = path%positions(model, wires, 0.0_dp)
      rotation = path%rotations(0.0_dp)
      do leg = 1, path%n_legs
         x_start = x
         rotation_start = rotation
         x = path%positions(model, wires, real(leg, dp)/path%n_legs)
         rotation = path%rotations(real(leg, dp)/path%n_legs)
         !$omp parallel do schedule(dynamic, 64) if (size(found) >= worth_threads)
         do i = 1, size(found)
            call sweep_pair(model, wires, elements, contact, pairs(:, i), i <= n_joined, x_start, &
               rotation_start, x, rotation, found(i))
         end do
         !$omp end parallel do
         do i = 1, size(found)
            worst = worse_of(worst, found(i))
         end do
         if (worst%kind /= finding_none) return
      end do
   end function sweep_contacts

   !> Whether the axes of two elements met.
   subroutine sweep_pair(model, wires, elements, contact, candidate, is_joined, x_start, rotation_start, x, rotation, &
      finding)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      !> Barred element, unbarred element, contact pair (3)
      integer, intent(in) :: candidate(3)
      !> The elements are joined: only what lies beyond their joint is followed
      logical, intent(in) :: is_joined
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes) at the start and at the end of the leg
      real(dp), intent(in) :: x_start(:, :), rotation_start(:, :, :), x(:, :), rotation(:, :, :)
      type(finding_t), intent(out) :: finding
      real(dp) :: x0(3, 4), t0(3, 4), x1(3, 4), t1(3, 4), length(2), p0(3, 0:3, 2), p1(3, 0:3, 2)
      real(dp) :: leave(2), motion, limit, time, place(2)
      integer :: k

      associate (pair => candidate(1:2), &
         law => model%interactions(model%contact_pairs(candidate(3))%interaction))
         if (law%unlimited_penetration) return
         call pair_geometry(model, wires, elements, pair(1), pair(2), x_start, rotation_start, x0, t0, length)
         call pair_geometry(model, wires, elements, pair(1), pair(2), x, rotation, x1, t1, length)
         do k = 1, 2
            p0(:, :, k) = axis_polynomial(law%axis, length(k), x0(:, 2*k - 1:2*k), t0(:, 2*k - 1:2*k))
            p1(:, :, k) = axis_polynomial(law%axis, length(k), x1(:, 2*k - 1:2*k), t1(:, 2*k - 1:2*k))
            leave(k) = max(axis_sagitta(p0(:, :, k)), axis_sagitta(p1(:, :, k)))
         end do
         limit = merge(met_joined, met, is_joined)*sum(elements%radius(pair))
         if (is_joined) then
            if (lead_apart(model, elements, pair, x0, leave) .and. lead_apart(model, elements, pair, x1, leave)) return
         end if
         motion = largest_relative_motion(x0, x1)
         ! chords that approach each other at this speed at most, axes that leave them by this much
         if (segment_distance(x0) + segment_distance(x1) - motion - 2*sum(leave) > 2*limit) return
         call find_meeting(model, wires, elements, pair, is_joined, p0, p1, leave, limit, time, place)
         if (time >= never) return
         if (is_crossing_kept(wires, elements, contact, pair, place)) return
         finding%kind = finding_passed
         finding%elements = pair
      end associate
   end subroutine sweep_pair

   !> Whether the axes met only on the way that was guessed: one crossing of the two wires was near this place at the
   !> start, and is there at the end, on the same side.
   pure logical function is_crossing_kept(wires, elements, contact, pair, place) result(kept)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      !> Barred and unbarred element (2)
      integer, intent(in) :: pair(2)
      !> Where they met (barred, unbarred) in [-1, 1] (2)
      real(dp), intent(in) :: place(2)
      real(dp) :: arc(2)
      integer :: i, n_kept, n_start

      arc = arc_at(wires, elements, pair, place)
      n_kept = 0
      do i = 1, size(contact%points)
         associate (point => contact%points(i))
            if (.not. point%start%known) cycle
            if (.not. is_near(wires, elements, pair, arc, point, point%start%arc)) cycle
            kept = have_kept(point%start, crossing_at(wires, point))
            if (.not. kept) return
            n_kept = n_kept + 1
         end associate
      end do
      n_start = 0
      do i = 1, size(contact%converged)
         associate (point => contact%converged(i))
            if (is_near(wires, elements, pair, arc, point, [point%arc_bar, point%arc])) n_start = n_start + 1
         end associate
      end do
      kept = n_kept == 1 .and. n_start <= 1
   end function is_crossing_kept

   !> A point is one of these two wires, and on both of them a place lies between where it was and where it is, or not
   !> much beyond.
   pure logical function is_near(wires, elements, pair, arc, point, arc_before)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Barred and unbarred element (2)
      integer, intent(in) :: pair(2)
      !> Arc lengths of the place on the barred and the unbarred wire (2) [m]
      real(dp), intent(in) :: arc(2)
      type(contact_point_t), intent(in) :: point
      !> Arc lengths where the point was (2) [m]
      real(dp), intent(in) :: arc_before(2)
      real(dp) :: arc_now(2), apart
      integer :: k

      is_near = .false.
      if (any(wires%wire([point%element_bar, point%element]) /= wires%wire(pair))) return
      arc_now = [point%arc_bar, point%arc]
      do k = 1, 2
         associate (wire => wires%wire(pair(k)))
            apart = wires%arc_between(wire, arc_now(k), arc_before(k))
            is_near = wires%arc_between(wire, arc(k), arc_now(k)) + wires%arc_between(wire, arc(k), arc_before(k)) &
               <= 2*apart + elements%length(pair(k)) + 8*maxval(elements%radius(pair))
         end associate
         if (.not. is_near) return
      end do
   end function is_near

end module litz_contact_sweep
