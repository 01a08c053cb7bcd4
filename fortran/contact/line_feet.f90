!> The feet of the places of each wire on other wires that are near.
module litz_line_feet
   use litz_kinds, only: dp
   use litz_axis, only: axis_polynomial, axis_sagitta, axis_shape, on_axis
   use litz_axis_choices, only: axis_hermite
   use litz_contact_candidates, only: skin
   use litz_contact_points, only: contact_set_t, pair_geometry, arc_at
   use litz_element_library, only: elements_t
   use litz_joint_radii, only: largest_radius
   use litz_line_contact, only: serves_lines
   use litz_line_foot, only: line_foot, foot_inside, foot_at_end, foot_beyond, foot_too_curved
   use litz_model, only: model_t
   use litz_parallel, only: worth_threads
   use litz_rotations, only: cross
   use litz_straight_segments, only: segment_distance
   use litz_wires, only: wires_t
   implicit none
   private
   public :: foot_t, find_feet, is_same_foot

   !> Feet on neighbouring elements that are nearer to each other than this, in lengths of an element, are one
   real(dp), parameter :: same_foot = 1.0e-6_dp
   !> Sine of the angle between elements below which an overlap may be long (15 degrees)
   real(dp), parameter :: small_sine = 0.2588_dp
   !> Relative error of a distance that is more than round-off
   real(dp), parameter :: near_round_off = 1.0e-9_dp
   !> Distance of the surfaces up to which two elements have points of line contacts, over the sum of their radii:
   !> around a crossing at a small angle its neighbours and their parts of the wires are open by less
   real(dp), parameter :: near_distance = 0.01_dp
   !> Half length of an overlap that is the matter of a crossing alone, in smaller radii
   real(dp), parameter :: longest_point = 0.5_dp

   !> Where a place has its foot.
   type :: foot_t
      !> Place and element of the foot, 0: none; candidate
      integer :: place = 0, element_bar = 0, candidate = 0
      real(dp) :: xi_bar = 0
      !> One of `foot_...` of litz_line_foot
      integer :: status = 0
   end type foot_t

   !> Those of two elements.
   type :: feet_t
      type(foot_t), allocatable :: feet(:)
      !> What its places are apart from the surface of the other element at least [m]
      real(dp) :: clear = -huge(1.0_dp)
   end type feet_t

contains

   !> The feet of all places that are near to another wire, each once: of pairs of elements that are near somewhere, and
   !> of those that are asked for.
   subroutine find_feet(model, wires, elements, x_start, rotation_start, x, rotation, is_wanted, contact, feet, only)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes) when the increment began, and now
      real(dp), intent(in) :: x_start(:, :), rotation_start(:, :, :), x(:, :), rotation(:, :, :)
      !> The pair has points however far apart it is (n_candidates)
      logical, intent(in) :: is_wanted(:)
      !> Out: how near its pairs are
      type(contact_set_t), intent(inout) :: contact
      type(foot_t), allocatable, intent(out) :: feet(:)
      !> Pairs to look at (n_candidates); absent: all
      logical, intent(in), optional :: only(:)
      type(feet_t), allocatable :: found(:)
      real(dp) :: near
      integer :: i, k, n

      allocate (found(size(contact%candidates, 2)))
      !$omp parallel do schedule(dynamic, 64) private(near) if (size(found) >= worth_threads)
      do i = 1, size(found)
         allocate (found(i)%feet(0))
         if (present(only)) then
            if (.not. only(i)) cycle
         end if
         contact%near%has_points(i) = .false.
         near = near_distance_of(wires, elements, contact%candidates(1:2, i))
         if (contact%near%clear(i) > near .and. .not. is_wanted(i)) cycle
         if (.not. serves_lines(model, contact%candidates(3, i))) cycle
         call find_feet_of_pair(model, wires, elements, x_start, rotation_start, x, rotation, contact, i, found(i))
         contact%near%clear(i) = found(i)%clear
         contact%near%has_points(i) = found(i)%clear <= near .or. is_wanted(i)
         if (.not. contact%near%has_points(i)) found(i)%feet = found(i)%feet(:0)
      end do
      !$omp end parallel do
      allocate (feet(sum([(size(found(i)%feet), i=1, size(found))])))
      n = 0
      do i = 1, size(found)
         do k = 1, size(found(i)%feet)
            n = n + 1
            feet(n) = found(i)%feet(k)
         end do
      end do
      call drop_doubles(wires, elements, size(contact%places%xi), feet)
   end subroutine find_feet

   !> Distance of the surfaces up to which two elements have points [m]: next to the end of a wire places share a lap,
   !> and none comes or goes.
   pure real(dp) function near_distance_of(wires, elements, pair) result(near)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Elements (2)
      integer, intent(in) :: pair(2)

      near = merge(skin/2, near_distance, any(wires%next(:, pair) == 0))*sum(elements%radius(pair))
   end function near_distance_of

   !> The feet of the places of two elements on each other: where the contact between them can be long.
   subroutine find_feet_of_pair(model, wires, elements, x_start, rotation_start, x, rotation, contact, candidate, &
      of_pair)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes) when the increment began, and now
      real(dp), intent(in) :: x_start(:, :), rotation_start(:, :, :), x(:, :), rotation(:, :, :)
      type(contact_set_t), intent(in) :: contact
      !> Number of the candidate
      integer, intent(in) :: candidate
      type(feet_t), intent(inout) :: of_pair
      type(foot_t), allocatable :: found(:)
      real(dp) :: xe(3, 4), t(3, 4), length(2), p(3, 0:3, 2), xi_bar, quality, thickness, distance, nearest
      real(dp), dimension(4) :: h, h1, h2
      integer :: side, place, n, status

      associate (pair => contact%candidates(1:2, candidate), places => contact%places)
         call pair_geometry(model, wires, elements, pair(1), pair(2), x, rotation, xe, t, length)
         p = axes_of(xe, t, length)
         thickness = largest_radius(wires, elements, pair(1)) + largest_radius(wires, elements, pair(2))
         of_pair%clear = surface_distance(xe, p, thickness)
         if (of_pair%clear > skin/2*sum(elements%radius(pair))) return
         if (.not. may_be_long(model, wires, elements, x_start, rotation_start, contact%depth, &
            pair)) return
         allocate (found(sum(places%n_parts(pair) + 1)))
         n = 0
         nearest = huge(nearest)
         do side = 1, 2
            associate (own => pair(side), other => pair(3 - side))
               do place = places%first(own), places%last(own)
                  call axis_shape(axis_hermite, length(side), places%xi(place), h, h1, h2)
                  call line_foot(p(:, :, 3 - side), on_axis(h, xe(:, 2*side - 1:2*side), t(:, 2*side - 1:2*side)), &
                     wires%next(:, other) == 0, xi_bar, quality, status)
                  distance = norm2(place_on_axis(p(:, :, side), places%xi(place)) - place_on_axis(p(:, :, 3 - side), &
                     max(-1.0_dp, min(1.0_dp, xi_bar))))
                  ! a foot that is hardly a minimum tells nothing of what is near
                  if (all(status /= [foot_inside, foot_at_end, foot_beyond])) nearest = -huge(nearest)
                  nearest = min(nearest, distance)
                  if (all(status /= [foot_inside, foot_at_end, foot_too_curved])) cycle
                  ! round-off must not take what the kinematics find within reach
                  if (distance > (1 + skin/2)*thickness*(1 + near_round_off)) cycle
                  n = n + 1
                  found(n) = foot_t(place, other, candidate, xi_bar, status)
               end do
            end associate
         end do
      end associate
      of_pair%feet = found(:n)
      of_pair%clear = max(of_pair%clear, nearest - thickness)
   end subroutine find_feet_of_pair

   !> The wires may overlap over a length that is long beside their radii: at small angles, and where the overlap is
   !> deep.
   !> So it was when the increment began: within it, places do not come and go.
   pure logical function may_be_long(model, wires, elements, x_start, rotation_start, depth, pair) result(may_be)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes) when the increment began
      real(dp), intent(in) :: x_start(:, :), rotation_start(:, :, :)
      !> Largest overlap of any contact then [m]
      real(dp), intent(in) :: depth
      !> Two elements
      integer, intent(in) :: pair(2)
      real(dp) :: xe(3, 4), t(3, 4), length(2), chord(3, 2), p(3, 0:3, 2), bow(2), sine

      call pair_geometry(model, wires, elements, pair(1), pair(2), x_start, rotation_start, xe, t, length)
      p = axes_of(xe, t, length)
      chord(:, 1) = (xe(:, 2) - xe(:, 1))/norm2(xe(:, 2) - xe(:, 1))
      chord(:, 2) = (xe(:, 4) - xe(:, 3))/norm2(xe(:, 4) - xe(:, 3))
      bow = 8*[axis_sagitta(p(:, :, 1)), axis_sagitta(p(:, :, 2))]/length
      ! a bow turns the axis on both sides, and bends it around the other wire: s^2 = q_1 q_2 - cos^2
      sine = max(0.0_dp, norm2(cross(chord(:, 1), chord(:, 2))) - sum(bow))
      sine = sqrt(max(0.0_dp, sine**2 - sum(elements%radius(pair))*sum(bow/length)))
      may_be = sine < small_sine
      if (may_be) return
      associate (radius => elements%radius(pair))
         ! the deepest place of the overlap may be on elements next to these; beyond its lens it is open by as much as
         ! there is overlap at sqrt(2) aW
         may_be = 2*sum(radius)*depth > (sine*longest_point*minval(radius))**2                  ! aW = sqrt(2 d delta)/s
         if (may_be) may_be = surface_distance(xe, p, sum(radius)) < depth
      end associate
   end function may_be_long

   !> The axes of two elements in powers of xi (3, 0:3, 2) [m].
   pure function axes_of(xe, t, length) result(p)
      !> Nodal positions [m] and unit tangents (3, 4), reference lengths (2) [m]
      real(dp), intent(in) :: xe(3, 4), t(3, 4), length(2)
      real(dp) :: p(3, 0:3, 2)
      integer :: side

      do side = 1, 2
         p(:, :, side) = axis_polynomial(axis_hermite, length(side), xe(:, 2*side - 1:2*side), t(:, 2*side - 1:2*side))
      end do
   end function axes_of

   !> Position on the axis of an element (3) [m].
   pure function place_on_axis(p, xi) result(x)
      !> Axis in powers of xi (3, 0:3) [m], and a place in [-1, 1]
      real(dp), intent(in) :: p(3, 0:3), xi
      real(dp) :: x(3)

      x = p(:, 0) + xi*(p(:, 1) + xi*(p(:, 2) + xi*p(:, 3)))
   end function place_on_axis

   !> Lower bound of the distance of the surfaces of two elements [m].
   pure real(dp) function surface_distance(xe, p, thickness)
      !> Nodal positions (3, 4) [m], axes in powers of xi (3, 0:3, 2) [m], sum of the radii [m]
      real(dp), intent(in) :: xe(3, 4), p(3, 0:3, 2), thickness

      surface_distance = segment_distance(xe) - axis_sagitta(p(:, :, 1)) - axis_sagitta(p(:, :, 2)) - thickness
   end function surface_distance

   !> A foot at a node is found on both of its elements; the first one keeps it.
   pure subroutine drop_doubles(wires, elements, n_places, feet)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Places on all wires
      integer, intent(in) :: n_places
      type(foot_t), allocatable, intent(inout) :: feet(:)
      !> The last foot of each place so far, and the one before each of them
      integer :: last(n_places), before(size(feet)), i, other
      logical :: keep(size(feet))
      type(foot_t), allocatable :: kept(:)

      last = 0
      keep = .true.
      do i = 1, size(feet)
         other = last(feet(i)%place)
         do while (other > 0)
            if (wires%wire(feet(i)%element_bar) == wires%wire(feet(other)%element_bar)) then
               keep(i) = keep(i) .and. .not. is_same_foot(wires, elements, feet(i)%element_bar, arc_of(feet(i)), &
                  arc_of(feet(other)))
            end if
            other = before(other)
         end do
         before(i) = last(feet(i)%place)
         if (keep(i)) last(feet(i)%place) = i
      end do
      allocate (kept(count(keep)))
      other = 0
      do i = 1, size(feet)
         if (.not. keep(i)) cycle
         other = other + 1
         kept(other) = feet(i)
      end do
      call move_alloc(kept, feet)

   contains

      !> Arc length of the foot along its wire [m].
      pure real(dp) function arc_of(foot)
         type(foot_t), intent(in) :: foot

         arc_of = arc_at(wires, elements, foot%element_bar, foot%xi_bar)
      end function arc_of

   end subroutine drop_doubles

   !> Two feet of one place on one wire are one.
   pure logical function is_same_foot(wires, elements, e, arc, other)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Element of the first one
      integer, intent(in) :: e
      !> Arc lengths of both along the wire [m]
      real(dp), intent(in) :: arc, other

      is_same_foot = wires%arc_between(wires%wire(e), arc, other) < same_foot*elements%length(e)
   end function is_same_foot

end module litz_line_feet
