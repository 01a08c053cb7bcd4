!> Which crossing is which: points of one state find those of an earlier one that they continue.
!>
!> A crossing belongs to two wires and slides along both. In a long slide it passes many elements at once, and another
!> crossing may come to where it was: it is looked for where the motion of its elements takes it. Where two straight
!> wires cross once their nodes have moved, follows from the nodes alone.
module litz_contact_matching
   use litz_kinds, only: dp, int64
   use litz_contact_findings, only: finding_t, finding_unfollowed
   use litz_contact_points, only: contact_point_t, contact_set_t, points_by_wire_t, chain_by_wire
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_wires, only: wires_t, arc_from_to
   implicit none
   private
   public :: match_points, slides_of, find_unfollowed

   !> A slide by more than this part of the lengths of the two elements is long
   real(dp), parameter :: long_slide = 0.25_dp
   !> Sine of the angle below which the motion does not tell where wires cross (10 degrees)
   real(dp), parameter :: shallow_sine = 0.17_dp

contains

   !> For each point the one of an earlier state that it continues; 0: none.
   !>
   !> First by the pair of elements; what is left by the nearest place on the same two wires (a hand-over).
   subroutine match_points(wires, elements, old, points, origin, slides)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: old(:), points(:)
      !> (n_points)
      integer, allocatable, intent(out) :: origin(:)
      !> By how much the old points have slid along their barred and unbarred wires since (2, n) [m]
      real(dp), intent(in), optional :: slides(:, :)
      logical :: taken(size(old))
      !> The old points of each barred wire, as chains
      type(points_by_wire_t) :: by_wire
      real(dp) :: slid(2, size(old)), distance, nearest
      integer :: i, j

      slid = 0
      if (present(slides)) slid = slides
      call match_pairs(wires, elements, old, points, slid, origin)
      taken = .false.
      do i = 1, size(points)
         if (origin(i) > 0) taken(origin(i)) = .true.
      end do
      if (all(taken)) return
      by_wire = chain_by_wire(wires, old)
      do i = 1, size(points)
         if (origin(i) /= 0) cycle
         nearest = huge(nearest)
         j = by_wire%first(wires%wire(points(i)%element_bar))
         do while (j > 0)
            if (.not. taken(j) .and. wires%wire(old(j)%element) == wires%wire(points(i)%element)) then
               distance = distance_from(wires, old(j), slid(:, j), points(i))
               if (distance < min(nearest, reach_of(elements, points(i)) + sum(abs(slid(:, j))))) then
                  nearest = distance
                  origin(i) = j
               end if
            end if
            j = by_wire%next(j)
         end do
         if (origin(i) > 0) taken(origin(i)) = .true.
      end do
   end subroutine match_points

   !> Points on the same two elements, but for those that must have slid elsewhere. Both lists are in the order of
   !> their pairs of elements.
   subroutine match_pairs(wires, elements, old, points, slid, origin)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: old(:), points(:)
      !> (2, n) [m]
      real(dp), intent(in) :: slid(:, :)
      !> As in `match_points` (n_points)
      integer, allocatable, intent(out) :: origin(:)
      integer(int64) :: key
      logical :: taken(size(old))
      real(dp) :: distance, nearest
      integer :: i, j, k

      allocate (origin(size(points)), source=0)
      taken = .false.
      j = 1
      do i = 1, size(points)
         key = pair_key(points(i))
         do while (j <= size(old))
            if (pair_key(old(j)) >= key) exit
            j = j + 1
         end do
         if (j > size(old)) return
         nearest = reach_of(elements, points(i))
         do k = j, size(old)
            if (pair_key(old(k)) /= key) exit
            distance = distance_from(wires, old(k), slid(:, k), points(i))
            if (taken(k) .or. distance > nearest) cycle
            nearest = distance
            origin(i) = k
         end do
         if (origin(i) > 0) taken(origin(i)) = .true.
      end do

   contains

      pure integer(int64) function pair_key(point)
         type(contact_point_t), intent(in) :: point

         pair_key = int(min(point%element_bar, point%element), int64)*size(wires%wire) &
            + max(point%element_bar, point%element)
      end function pair_key

   end subroutine match_pairs

   !> How far a point may be from where it is looked for [m].
   pure real(dp) function reach_of(elements, point) result(reach)
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point

      reach = sum(elements%length([point%element_bar, point%element]))
   end function reach_of

   !> How far a point is from where an old one of the same two wires must be now, along both wires [m].
   pure real(dp) function distance_from(wires, old, slid, point) result(distance)
      type(wires_t), intent(in) :: wires
      type(contact_point_t), intent(in) :: old, point
      !> (2) [m]
      real(dp), intent(in) :: slid(2)

      distance = sum(abs(arc_from_to([old%arc_bar, old%arc] + slid, [point%arc_bar, point%arc], &
         wires%circumference(wires%wire([point%element_bar, point%element])))))
   end function distance_from

   !> By how much points have slid along both wires, from the motion of their elements; 0: a little, or not known.
   pure function slides_of(model, wires, elements, points, x_start, x) result(slides)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: points(:)
      !> Positions of the nodes when these were the points, and now (3, n_nodes) [m]
      real(dp), intent(in) :: x_start(:, :), x(:, :)
      !> Along the barred and the unbarred wire (2, n) [m]
      real(dp) :: slides(2, size(points))
      real(dp) :: apart(3), t_bar(3), t(3), cosine
      integer :: k

      slides = 0
      do k = 1, size(points)
         if (.not. is_long_slide(model, elements, points(k), x_start, x)) cycle
         associate (eb => points(k)%element_bar, e => points(k)%element)
            apart = distance_of_places(model, points(k), x)
            t_bar = direction_along(eb)
            t = direction_along(e)
         end associate
         if (any(points(k)%held)) then
            ! the foot of the end
            if (.not. points(k)%held(1)) slides(1, k) = -dot_product(t_bar, apart)
            if (.not. points(k)%held(2)) slides(2, k) = dot_product(t, apart)
            cycle
         end if
         cosine = dot_product(t_bar, t)
         if (1 - cosine**2 < shallow_sine**2) cycle
         ! the closest points of two straight lines
         slides(1, k) = (cosine*dot_product(t, apart) - dot_product(t_bar, apart))/(1 - cosine**2)
         slides(2, k) = (dot_product(t, apart) - cosine*dot_product(t_bar, apart))/(1 - cosine**2)
      end do

   contains

      !> Unit vector along the wire of an element.
      pure function direction_along(element) result(direction)
         !> Its index
         integer, intent(in) :: element
         real(dp) :: direction(3)

         associate (nodes => model%connectivity(:, element))
            direction = wires%direction(element)*(x(:, nodes(2)) - x(:, nodes(1)))
         end associate
         direction = direction/norm2(direction)
      end function direction_along

   end function slides_of

   !> The places where two wires touched have moved so far past each other that the contact is on other elements now.
   pure logical function is_long_slide(model, elements, point, x_start, x)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point
      !> Positions when this was the point, and now (3, n_nodes) [m]
      real(dp), intent(in) :: x_start(:, :), x(:, :)

      is_long_slide = norm2(distance_of_places(model, point, x) - distance_of_places(model, point, x_start)) &
         > long_slide*reach_of(elements, point)
   end function is_long_slide

   !> From the place of a point on the unbarred wire to that on the barred one, as the nodes are now [m].
   pure function distance_of_places(model, point, x) result(distance)
      type(model_t), intent(in) :: model
      type(contact_point_t), intent(in) :: point
      !> (3, n_nodes) [m]
      real(dp), intent(in) :: x(:, :)
      real(dp) :: distance(3)

      associate (nodes_bar => model%connectivity(:, point%element_bar), nodes => model%connectivity(:, point%element))
         distance = matmul(x(:, nodes_bar), [1 - point%xi_bar, 1 + point%xi_bar])/2 &
            - matmul(x(:, nodes), [1 - point%xi, 1 + point%xi])/2
      end associate
   end function distance_of_places

   !> A contact that slides far in one increment, and may be any of several, or none, of those there are now;
   !> `finding_none`: each is known.
   type(finding_t) function find_unfollowed(model, wires, elements, contact, x_start, x) result(finding)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the points of this state, and those of the last converged one
      type(contact_set_t), intent(in) :: contact
      !> Positions when the increment began, and now (3, n_nodes) [m]
      real(dp), intent(in) :: x_start(:, :), x(:, :)
      type(points_by_wire_t) :: by_wire
      real(dp) :: slid(2, size(contact%converged))
      integer :: k

      slid = slides_of(model, wires, elements, contact%converged, x_start, x)
      by_wire = chain_by_wire(wires, contact%points)
      do k = 1, size(contact%converged)
         associate (point => contact%converged(k))
            if (.not. point%history%closed) cycle
            if (.not. is_long_slide(model, elements, point, x_start, x)) cycle
            if (.not. is_in_doubt(k)) cycle
            finding = finding_t(finding_unfollowed, [point%element_bar, point%element])
            return
         end associate
      end do

   contains

      !> A contact of the same two wires, of which nothing else is known, might be this one; or one that is nearly as
      !> near as the one it is taken for.
      pure logical function is_in_doubt(k)
         !> A closed point of the last converged state
         integer, intent(in) :: k
         real(dp) :: own, nearest_other
         integer :: i

         is_in_doubt = .false.
         own = huge(own)
         nearest_other = huge(own)
         i = by_wire%first(wires%wire(contact%converged(k)%element_bar))
         do while (i > 0)
            associate (point => contact%points(i), before => contact%converged(k))
               if (point%closed .and. wires%wire(point%element) == wires%wire(before%element)) then
                  if (point%predecessor == k) then
                     own = distance_from(wires, before, slid(:, k), point)
                  else
                     nearest_other = min(nearest_other, distance_from(wires, before, slid(:, k), point))
                     is_in_doubt = is_in_doubt .or. point%predecessor == 0
                  end if
               end if
            end associate
            i = by_wire%next(i)
         end do
         if (own < huge(own)) is_in_doubt = nearest_other < 2*own
      end function is_in_doubt

   end function find_unfollowed

end module litz_contact_matching
