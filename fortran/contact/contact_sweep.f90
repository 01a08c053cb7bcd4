!> Whether wires passed through each other on the way from the start of an increment to its end.
!>
!> The way is that of litz_contact_path, leg by leg. Within a leg the nodes and their tangents move uniformly, and
!> with them every point of the axes, which are cubic curves in them. Axes are cut into straight pieces, and each pair
!> of pieces is followed (litz_moving_segments). Where no axes meet, the end of the increment can be reached from its
!> start without a passage. Where they meet, the increment is rejected, but for a crossing that shows the same side at
!> both ends after a small turn: there the way is to blame, which is a guess.
module litz_contact_sweep
   use litz_kinds, only: dp
   use litz_axis, only: axis_polynomial, axis_sagitta
   use litz_straight_segments, only: segment_distance
   use litz_contact_findings, only: finding_t, worse_of, finding_none, finding_passed, finding_turned
   use litz_contact_joints, only: end_paths, path_between, lead_apart, joint_radii
   use litz_contact_path, only: contact_path_t
   use litz_contact_points, only: contact_set_t, pair_geometry
   use litz_contact_side, only: crossing_t, crossing_of, have_kept
   use litz_departed_contacts, only: find_departed_pairs
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_moving_segments, only: meeting_time, never, largest_relative_motion
   use litz_parallel, only: worth_threads
   use litz_wires, only: wires_t
   implicit none
   private
   public :: sweep_contacts

   !> Axes that come nearer than this part of the sum of their radii have met
   real(dp), parameter :: met = 0.9_dp
   !> Joined elements overlap near their joint: they have met where their axes do
   real(dp), parameter :: met_joined = 0.05_dp
   !> Straight pieces leave the axis by this part of the smaller radius at most
   real(dp), parameter :: chord_tolerance = 0.02_dp
   integer, parameter :: max_pieces = 64

contains

   !> The worst passage of all near pairs of elements; `finding_none`: there is none.
   function sweep_contacts(model, wires, elements, contact, path) result(worst)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the candidates and points of the end of the increment
      type(contact_set_t), intent(in) :: contact
      type(contact_path_t), intent(in) :: path
      type(finding_t) :: worst
      type(finding_t), allocatable :: found(:)
      real(dp), allocatable :: x_start(:, :), rotation_start(:, :, :), x(:, :), rotation(:, :, :)
      !> Barred element, unbarred element, contact pair: joined ones first (3, n)
      integer, allocatable :: pairs(:, :), departed(:, :)
      integer :: leg, i, n, n_joined

      if (path%turned_element > 0) then
         worst = finding_t(finding_turned, spread(path%turned_element, 1, 2))
         return
      end if
      n_joined = size(contact%joined, 2)
      call find_departed_pairs(model, wires, contact, departed)
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
            call sweep_pair(pairs(:, i), i <= n_joined, found(i))
         end do
         !$omp end parallel do
         do i = 1, size(found)
            worst = worse_of(worst, found(i))
         end do
         if (worst%kind /= finding_none) return
      end do

   contains

      subroutine sweep_pair(candidate, is_joined, finding)
         !> Barred element, unbarred element, contact pair
         integer, intent(in) :: candidate(3)
         !> The elements are joined: only what lies beyond their joint is followed
         logical, intent(in) :: is_joined
         type(finding_t), intent(out) :: finding
         real(dp) :: x0(3, 4), t0(3, 4), x1(3, 4), t1(3, 4), length(2), p0(3, 0:3, 2), p1(3, 0:3, 2)
         real(dp) :: leave(2), motion, limit, apart, time, place(2)
         integer :: k, pieces(2)

         associate (eb => candidate(1), e => candidate(2), &
            law => model%interactions(model%contact_pairs(candidate(3))%interaction))
            if (law%unlimited_penetration) return
            call pair_geometry(model, wires, elements, eb, e, x_start, rotation_start, x0, t0, length)
            call pair_geometry(model, wires, elements, eb, e, x, rotation, x1, t1, length)
            do k = 1, 2
               p0(:, :, k) = axis_polynomial(law%axis, length(k), x0(:, 2*k - 1:2*k), t0(:, 2*k - 1:2*k))
               p1(:, :, k) = axis_polynomial(law%axis, length(k), x1(:, 2*k - 1:2*k), t1(:, 2*k - 1:2*k))
               leave(k) = max(axis_sagitta(p0(:, :, k)), axis_sagitta(p1(:, :, k)))
            end do
            limit = merge(met_joined, met, is_joined)*sum(elements%radius([eb, e]))
            if (is_joined) then
               if (lead_apart(model, elements, [eb, e], x0, leave) .and. &
                  lead_apart(model, elements, [eb, e], x1, leave)) return
            end if
            motion = largest_relative_motion(x0, x1)
            ! chords that approach each other at this speed at most, axes that leave them by this much
            if (segment_distance(x0) + segment_distance(x1) - motion - 2*sum(leave) > 2*limit) return
            pieces = max(1, min(max_pieces, ceiling(sqrt(leave/(chord_tolerance*minval(elements%radius([eb, e])))))))
            apart = 0
            if (is_joined) then
               apart = joint_radii*maxval(elements%radius([eb, e]))
               pieces = max(pieces, min(max_pieces, ceiling(2*length/apart)))
            end if
            call follow([eb, e], p0, p1, pieces, apart, limit, time, place)
            if (time >= never) return
            if (is_crossing_kept(candidate, place, length)) return
            finding%kind = finding_passed
            finding%elements = candidate(1:2)
         end associate
      end subroutine sweep_pair

      !> Whether the axes met only on the way that was guessed: one crossing of the two wires was near this place at the
      !> start, and is there at the end, on the same side.
      pure logical function is_crossing_kept(candidate, place, length) result(kept)
         integer, intent(in) :: candidate(3)
         !> Where they met (barred, unbarred) in [-1, 1], and reference lengths (2) [m]
         real(dp), intent(in) :: place(2), length(2)
         real(dp) :: arc(2)
         integer :: i, n_kept, n_start

         arc = wires%arc(candidate(1:2)) + wires%direction(candidate(1:2))*place*length/2
         n_kept = 0
         do i = 1, size(contact%points)
            associate (point => contact%points(i))
               if (.not. point%start%known) cycle
               if (any(wires%wire([point%element_bar, point%element]) /= wires%wire(candidate(1:2)))) cycle
               if (.not. is_between(candidate, arc, [point%arc_bar, point%arc], point%start%arc)) cycle
               kept = have_kept(point%start, crossing_of(point%kinematics, &
                  wires%direction([point%element_bar, point%element]), [point%arc_bar, point%arc]))
               if (.not. kept) return
               n_kept = n_kept + 1
            end associate
         end do
         n_start = 0
         do i = 1, size(contact%converged)
            associate (point => contact%converged(i))
               if (any(wires%wire([point%element_bar, point%element]) /= wires%wire(candidate(1:2)))) cycle
               if (.not. is_between(candidate, arc, [point%arc_bar, point%arc], [point%arc_bar, point%arc])) cycle
               n_start = n_start + 1
            end associate
         end do
         kept = n_kept == 1 .and. n_start <= 1
      end function is_crossing_kept

      !> On both wires a place lies between two others, or not much beyond.
      pure logical function is_between(candidate, arc, one, other)
         integer, intent(in) :: candidate(3)
         !> Arc lengths on the barred and the unbarred wire: the place, and the two others (2) [m]
         real(dp), intent(in) :: arc(2), one(2), other(2)
         real(dp) :: apart
         integer :: k

         do k = 1, 2
            associate (wire => wires%wire(candidate(k)))
               apart = wires%arc_between(wire, one(k), other(k))
               is_between = wires%arc_between(wire, arc(k), one(k)) + wires%arc_between(wire, arc(k), other(k)) &
                  <= 2*apart + elements%length(candidate(k)) + 8*maxval(elements%radius(candidate(1:2)))
            end associate
            if (.not. is_between) return
         end do
      end function is_between

      !> Follow all pieces of two moving axes.
      pure subroutine follow(pair, p0, p1, pieces, apart, limit, time, place)
         !> Elements; axes in powers of xi at the start and at the end (3, 0:3, 2) [m]; number of pieces (2)
         integer, intent(in) :: pair(2), pieces(2)
         real(dp), intent(in) :: p0(3, 0:3, 2), p1(3, 0:3, 2)
         !> Pieces nearer along the wires than this are left out, and distance at which they meet [m]
         real(dp), intent(in) :: apart, limit
         !> First meeting, or `never`, and where: middles of the pieces (2) in [-1, 1]
         real(dp), intent(out) :: time, place(2)
         real(dp) :: a(3, 2, 0:max_pieces), b(3, 2, 0:max_pieces), meeting, middle(2), between(2, 2)
         integer :: i, j

         call cut(p0(:, :, 1), p1(:, :, 1), pieces(1), a)
         call cut(p0(:, :, 2), p1(:, :, 2), pieces(2), b)
         time = never
         place = 0
         if (apart > 0) between = end_paths(model, wires, elements, pair, 2*apart)
         do i = 1, pieces(1)
            do j = 1, pieces(2)
               middle = [-1 + (2*i - 1)/real(pieces(1), dp), -1 + (2*j - 1)/real(pieces(2), dp)]
               if (apart > 0) then
                  if (path_between(wires, elements, pair, middle, between) < 2*apart) cycle
               end if
               meeting = meeting_time(reshape([a(:, 1, i - 1:i), b(:, 1, j - 1:j)], [3, 4]), &
                  reshape([a(:, 2, i - 1:i), b(:, 2, j - 1:j)], [3, 4]), limit)
               if (meeting >= time) cycle
               time = meeting
               place = middle
            end do
         end do
      end subroutine follow

   end function sweep_contacts

   !> Ends of the pieces of an axis at the start and at the end.
   pure subroutine cut(p0, p1, n, ends)
      real(dp), intent(in) :: p0(3, 0:3), p1(3, 0:3)
      integer, intent(in) :: n
      real(dp), intent(inout) :: ends(3, 2, 0:max_pieces)
      real(dp) :: xi
      integer :: i

      do i = 0, n
         xi = -1 + 2*real(i, dp)/n
         ends(:, 1, i) = p0(:, 0) + xi*(p0(:, 1) + xi*(p0(:, 2) + xi*p0(:, 3)))
         ends(:, 2, i) = p1(:, 0) + xi*(p1(:, 1) + xi*(p1(:, 2) + xi*p1(:, 3)))
      end do
   end subroutine cut

end module litz_contact_sweep
