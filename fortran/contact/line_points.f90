!> Where wires lie side by side: a point for each place of one wire with its foot on another.
!>
!> Each of two wires in turn is the one with the places (half passes), so that nothing depends on their order. A point
!> is known again by its place and its foot. Source: theory section 10.
module litz_line_points
   use litz_kinds, only: dp
   use litz_axis_choices, only: axis_hermite
   use litz_contact_candidates, only: skin
   use litz_contact_kinematics, only: kinematics_ok
   use litz_contact_points, only: contact_point_t, contact_set_t, pair_geometry, arc_at, clearance_of, &
      add_taper, inherit, points_by_place_t, chain_by_place
   use litz_crossings_of_wires, only: crossings_of_wires_t, sort_crossings
   use litz_element_library, only: elements_t
   use litz_joint_radii, only: add_balls
   use litz_line_cell, only: touching_length
   use litz_line_contact, only: serves_lines
   use litz_line_feet, only: foot_t, find_feet, is_same_foot
   use litz_line_foot, only: foot_at_end
   use litz_line_kinematics, only: line_kinematics, line_course_t, line_course
   use litz_line_shares, only: share_line_point, has_grown
   use litz_model, only: model_t
   use litz_line_laps, only: slide_along_lap
   use litz_parallel, only: worth_threads
   use litz_wires, only: wires_t
   implicit none
   private
   public :: locate_line_points, add_line_points, give_rows

contains

   !> Find the points of line contacts in the present configuration; they carry on the memory of those of the last call.
   subroutine locate_line_points(model, wires, elements, x_start, rotation_start, x, rotation, contact)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes) when the increment began, and now
      real(dp), intent(in) :: x_start(:, :), rotation_start(:, :, :), x(:, :), rotation(:, :, :)
      !> With the candidates and the crossings of this configuration
      type(contact_set_t), intent(inout) :: contact
      type(contact_point_t), allocatable :: old(:), points(:)
      type(foot_t), allocatable :: feet(:)

      if (.not. has_lines(model)) return
      call contact%near%follow(model, wires, elements, contact%candidates, x, rotation)
      call find_feet(model, wires, elements, x_start, rotation_start, x, rotation, should_touch(contact), contact, feet)
      call move_alloc(contact%line_points, old)
      call make_points(model, wires, elements, contact, x, rotation, feet, old, points)
      ! each is some kilobytes, and there may be a million
      deallocate (old)
      call keep_regular(points)
      call move_alloc(points, contact%line_points)
   end subroutine locate_line_points

   !> A linear step may bring pairs of elements into contact that have been too far apart for points: they get them in
   !> the present configuration, so that what follows the step sees them.
   subroutine add_line_points(model, wires, elements, x_start, rotation_start, x, rotation, displacement, spin, &
      contact, n_before)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes) when the increment began, and now
      real(dp), intent(in) :: x_start(:, :), rotation_start(:, :, :), x(:, :), rotation(:, :, :)
      !> The step (3, n_nodes) [m], [rad]
      real(dp), intent(in) :: displacement(:, :), spin(:, :)
      !> With the line points of this configuration; out: new ones behind them
      type(contact_set_t), intent(inout) :: contact
      !> Number of points before
      integer, intent(out) :: n_before
      type(contact_point_t), allocatable :: points(:), all_points(:)
      type(foot_t), allocatable :: feet(:)
      logical :: comes_near(size(contact%candidates, 2))

      n_before = size(contact%line_points)
      if (.not. has_lines(model)) return
      comes_near = contact%near%come_near(model, elements, contact%candidates, displacement, spin)
      if (.not. any(comes_near)) return
      call find_feet(model, wires, elements, x_start, rotation_start, x, rotation, comes_near, contact, feet, &
         only=comes_near)
      if (size(feet) == 0) return
      feet = pack(feet, are_new(wires, elements, contact, feet))
      call make_points(model, wires, elements, contact, x, rotation, feet, contact%line_points(:0), points)
      call keep_regular(points)
      if (size(points) == 0) return
      allocate (all_points(n_before + size(points)))
      all_points(:n_before) = contact%line_points
      all_points(n_before + 1:) = points
      call move_alloc(all_points, contact%line_points)
   end subroutine add_line_points

   !> Some contact pair serves lines.
   pure logical function has_lines(model)
      type(model_t), intent(in) :: model
      integer :: i

      has_lines = any([(serves_lines(model, i), i=1, size(model%contact_pairs))])
   end function has_lines

   !> Pairs with a point that is closed as the last step has predicted (n_candidates).
   pure function should_touch(contact) result(should)
      type(contact_set_t), intent(in) :: contact
      logical :: should(size(contact%candidates, 2))
      integer :: i

      should = .false.
      do i = 1, size(contact%line_points)
         associate (point => contact%line_points(i))
            if (.not. (point%predicted .and. point%predicted_gap < 0)) cycle
            ! candidates may have been collected since
            if (point%candidate > size(should)) cycle
            associate (pair => contact%candidates(1:2, point%candidate))
               should(point%candidate) = should(point%candidate) .or. all([point%element_bar, point%element] == pair) &
                  .or. all([point%element, point%element_bar] == pair)
            end associate
         end associate
      end do
   end function should_touch

   !> Feet that no point of the set has (n_feet).
   pure function are_new(wires, elements, contact, feet) result(new)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      type(foot_t), intent(in) :: feet(:)
      logical :: new(size(feet))
      type(points_by_place_t) :: by_place
      integer :: i, k

      by_place = chain_by_place(size(contact%places%xi), contact%line_points)
      new = .true.
      do i = 1, size(feet)
         k = by_place%last(feet(i)%place)
         do while (k > 0)
            associate (point => contact%line_points(k), e => feet(i)%element_bar)
               if (wires%wire(point%element_bar) == wires%wire(e)) then
                  new(i) = new(i) .and. .not. is_same_foot(wires, elements, e, arc_at(wires, elements, e, &
                     feet(i)%xi_bar), point%arc_bar)
               end if
            end associate
            k = by_place%before(k)
         end do
      end do
   end function are_new

   !> The points of feet; they carry on the memory of earlier ones.
   subroutine make_points(model, wires, elements, contact, x, rotation, feet, old, points)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the crossings of this configuration
      type(contact_set_t), intent(in) :: contact
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(foot_t), intent(in) :: feet(:)
      !> Points of the last iterate
      type(contact_point_t), intent(in) :: old(:)
      type(contact_point_t), allocatable, intent(out) :: points(:)
      integer, allocatable :: newest(:), converged(:)
      type(crossings_of_wires_t) :: sorted
      integer :: i

      allocate (points(size(feet)))
      !$omp parallel do schedule(static) if (size(feet) >= worth_threads)
      do i = 1, size(feet)
         call place_point(wires, elements, contact, feet(i), points(i))
      end do
      !$omp end parallel do
      call match_line_points(wires, size(contact%places%xi), old, points, newest)
      call match_line_points(wires, size(contact%places%xi), contact%converged_line_points, points, converged)
      points%predecessor = converged
      sorted = sort_crossings(wires, contact%points)
      !$omp parallel do schedule(static) if (size(points) >= worth_threads)
      do i = 1, size(points)
         call inherit(old, newest(i), contact%converged_line_points, converged(i), points(i))
         call set_geometry(model, wires, elements, contact, sorted, x, rotation, feet(i), &
            newest(i) == 0 .and. converged(i) == 0, points(i))
      end do
      !$omp end parallel do
   end subroutine make_points

   !> Points whose axes have a normal, and are near.
   subroutine keep_regular(points)
      type(contact_point_t), allocatable, intent(inout) :: points(:)
      type(contact_point_t), allocatable :: kept(:)
      integer :: i, n

      if (all(points%regular)) return
      allocate (kept(count(points%regular)))
      n = 0
      do i = 1, size(points)
         if (.not. points(i)%regular) cycle
         n = n + 1
         kept(n) = points(i)
      end do
      call move_alloc(kept, points)
   end subroutine keep_regular

   !> Where a new point is.
   pure subroutine place_point(wires, elements, contact, foot, point)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_set_t), intent(in) :: contact
      type(foot_t), intent(in) :: foot
      type(contact_point_t), intent(inout) :: point

      point%line_place = foot%place
      point%candidate = foot%candidate
      point%pair = contact%candidates(3, foot%candidate)
      point%element_bar = foot%element_bar
      point%xi_bar = foot%xi_bar
      point%element = contact%places%element(foot%place)
      point%xi = contact%places%xi(foot%place)
      point%arc_bar = arc_at(wires, elements, point%element_bar, point%xi_bar)
      point%arc = arc_at(wires, elements, point%element, point%xi)
   end subroutine place_point

   !> Which of some earlier points each point continues: that of the same place with the nearest foot on the same wire,
   !> and on the same turn of it; 0: none.
   subroutine match_line_points(wires, n_places, earlier, points, origin)
      type(wires_t), intent(in) :: wires
      !> Places on all wires
      integer, intent(in) :: n_places
      type(contact_point_t), intent(in) :: earlier(:), points(:)
      !> (points)
      integer, allocatable, intent(out) :: origin(:)
      type(points_by_place_t) :: by_place
      real(dp) :: distance, nearest
      integer :: i, k

      allocate (origin(size(points)), source=0)
      if (size(earlier) == 0 .or. size(points) == 0) return
      by_place = chain_by_place(n_places, earlier)
      !$omp parallel do schedule(static) private(distance, nearest, k) if (size(points) >= worth_threads)
      do i = 1, size(points)
         nearest = huge(nearest)
         k = by_place%last(points(i)%line_place)
         do while (k > 0)
            if (wires%wire(earlier(k)%element_bar) == wires%wire(points(i)%element_bar)) then
               distance = wires%arc_between(wires%wire(points(i)%element_bar), points(i)%arc_bar, earlier(k)%arc_bar)
               if (distance < nearest .and. is_same_turn(wires, earlier(k), points(i), distance)) then
                  origin(i) = k
                  nearest = distance
               end if
            end if
            k = by_place%before(k)
         end do
      end do
      !$omp end parallel do
   end subroutine match_line_points

   !> A foot on the wire of its own place has not slid by half of the way between the two: it is not on another turn.
   pure logical function is_same_turn(wires, earlier, point, slid)
      type(wires_t), intent(in) :: wires
      !> Two points of one place, with feet on one wire
      type(contact_point_t), intent(in) :: earlier, point
      !> Distance of the feet along it [m]
      real(dp), intent(in) :: slid

      is_same_turn = .true.
      associate (wire => wires%wire(point%element))
         if (wires%wire(point%element_bar) == wire) is_same_turn = slid < 0.5_dp*min( &
            wires%arc_between(wire, point%arc, point%arc_bar), wires%arc_between(wire, earlier%arc, earlier%arc_bar))
      end associate
   end function is_same_turn

   !> Kinematics and gap of a point, on the side on which its wires were in the last converged state.
   pure subroutine set_geometry(model, wires, elements, contact, sorted, x, rotation, foot, is_new, point)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the crossings and what is left of interference, and the crossings along their wires
      type(contact_set_t), intent(in) :: contact
      type(crossings_of_wires_t), intent(in) :: sorted
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(foot_t), intent(in) :: foot
      !> No earlier point says what is carried along the line
      logical, intent(in) :: is_new
      type(contact_point_t), intent(inout) :: point
      real(dp) :: xe(3, 4), t(3, 4), length(2)
      integer :: info, unused_crossing

      point%foot_at_end = foot%status == foot_at_end
      associate (radius => elements%radius([point%element_bar, point%element]))
         call pair_geometry(model, wires, elements, point%element_bar, point%element, x, rotation, xe, t, length)
         call set_kinematics(wires, elements, xe, t, length, point, info)
         point%gap = point%kinematics%gap + clearance_of(point%fit, contact%clearance(point%pair))
         point%regular = info == kinematics_ok .and. point%kinematics%gap < skin/2*sum(radius)
      end associate
      call slide_along_lap(wires, elements, point)
      if (.not. point%regular) return
      if (is_new .or. has_grown(point)) call share_line_point(wires, elements, contact, sorted, xe, t, length, point, &
         unused_crossing)
      if (has_strip(model, elements, point)) call set_cell(line_course(xe, t, length, axis_hermite, point%foot_at_end, &
         point%kinematics), point)
      if (.not. may_matter(point)) deallocate (point%kinematics%rows)
   end subroutine set_geometry

   pure subroutine set_kinematics(wires, elements, xe, t, length, point, info)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Nodal positions [m] and unit tangents (3, 4), reference lengths (2) [m]: element of the foot first
      real(dp), intent(in) :: xe(3, 4), t(3, 4), length(2)
      type(contact_point_t), intent(inout) :: point
      !> One of `kinematics_...`
      integer, intent(out) :: info

      associate (pair => [point%element_bar, point%element])
         call line_kinematics(xe, t, length, axis_hermite, elements%radius(pair), point%xi_bar, point%xi, &
            point%foot_at_end, point%normal_before, point%kinematics, info)
         call add_taper(elements%taper(pair), point%kinematics)
      end associate
      call add_balls(wires, elements, point)
   end subroutine set_kinematics

   !> Places that were open and are supposed to press take part in the tangent.
   subroutine give_rows(model, wires, elements, x, rotation, points)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(contact_point_t), intent(inout) :: points(:)
      real(dp) :: xe(3, 4), t(3, 4), length(2)
      integer :: i, unused_info

      !$omp parallel do schedule(static) private(xe, t, length, unused_info) if (size(points) >= worth_threads)
      do i = 1, size(points)
         associate (point => points(i))
            if (allocated(point%kinematics%rows) .or. .not. may_matter(point)) cycle
            call pair_geometry(model, wires, elements, point%element_bar, point%element, x, rotation, xe, t, length)
            call set_kinematics(wires, elements, xe, t, length, point, unused_info)
         end associate
      end do
      !$omp end parallel do
   end subroutine give_rows

   !> A place presses or conducts, or was to press as the last step has predicted: most places are near and open.
   pure logical function may_matter(point)
      type(contact_point_t), intent(in) :: point

      may_matter = point%gap < 0 .or. point%cell_touches .or. (point%predicted .and. point%predicted_gap < 0)
   end function may_matter

   !> A current or heat can pass.
   pure logical function has_strip(model, elements, point)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point
      integer :: both(2)

      both = [point%element_bar, point%element]
      associate (law => model%interactions(model%contact_pairs(point%pair)%interaction), &
         material => model%sections(model%element_section(both))%material)
         has_strip = law%spot%exists() .and. all(elements%resistivity(both) > 0)
         if (law%heat%exists()) has_strip = has_strip .or. allocated(model%materials(material(1))%heat_conductivity) &
            .and. allocated(model%materials(material(2))%heat_conductivity)
         ! what carries nothing conducts nothing, but may have a spot to remember
         has_strip = has_strip .and. (point%weight > 0 .or. law%spot_memory)
      end associate
   end function has_strip

   !> The overlap along the part of the wire for which a point stands.
   pure subroutine set_cell(course, point)
      type(line_course_t), intent(in) :: course
      type(contact_point_t), intent(inout) :: point

      point%cell%overlap = -point%gap
      point%cell%slope = course%slope
      point%cell%bend = course%bend
      point%cell_touches = touching_length(point%cell) > 0
   end subroutine set_cell

end module litz_line_points
