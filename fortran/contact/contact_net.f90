!> Whether every overlap of near wires is a contact of the ledger.
!>
!> A wire is a tube with round joints and round ends. Contact is where the distance of two tubes has a local minimum
!> below zero; all such minima of all near pairs of elements are looked up among the contacts. What is missing there is
!> not modelled: it is named, and the state is no solution.
module litz_contact_net
   use litz_kinds, only: dp
   use litz_axis, only: axis_polynomial, axis_sagitta, axis_shape, on_axis
   use litz_closest_points, only: local_minima, max_minima
   use litz_straight_segments, only: segment_distance
   use litz_contact_findings, only: finding_t, worse_of, finding_none, finding_deep, finding_missed, finding_second, &
      finding_joined, finding_end, finding_kink, finding_line, finding_passed
   use litz_contact_joints, only: end_paths, path_between, lead_apart, walk_along, joint_radii
   use litz_contact_pairs, only: are_joined, self_contact_distance
   use litz_contact_points, only: contact_set_t, contact_point_t, pair_geometry, chain_by_wire
   use litz_element_library, only: elements_t
   use litz_model, only: model_t, axis_hermite, axis_linear
   use litz_normal_law, only: penalty_that_holds
   use litz_parallel, only: worth_threads
   use litz_rotations, only: cross
   use litz_wires, only: wires_t
   implicit none
   private
   public :: inspect_contacts, allowed_penetration

   !> Overlap of a contact that is allowed, over the smaller radius
   real(dp), parameter :: allowed_penetration = 0.05_dp
   !> Overlap without a contact that is round-off, over the smaller radius
   real(dp), parameter :: unseen_overlap = 1.0e-6_dp
   !> Half length of the overlap along the wires beyond which a contact is no point, in smaller radii
   real(dp), parameter :: longest_point = 2.0_dp
   !> Overlaps at angles with a sine below this are side by side (10 degrees)
   real(dp), parameter :: side_by_side = 0.17_dp
   !> Cosine between the line to the other wire and an axis that counts as zero
   real(dp), parameter :: flat = 1.0e-6_dp
   !> Places nearer to a contact than this, in sums of radii, are that contact
   real(dp), parameter :: same_contact = 0.2_dp

contains

   !> The worst of what is wrong; `finding_none`: nothing.
   function inspect_contacts(model, wires, elements, contact, x, rotation) result(worst)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> With the candidates and points of this state
      type(contact_set_t), intent(in) :: contact
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(finding_t) :: worst
      type(finding_t), allocatable :: found(:)
      !> Point of each candidate (n_candidates), the first of each barred wire, and the next one of each; 0: none
      integer, allocatable :: point_of(:), first_of_wire(:), next_of_wire(:)
      integer :: i, n

      call chain_by_wire(wires, contact%points, first_of_wire, next_of_wire)
      allocate (point_of(size(contact%candidates, 2)), source=0)
      point_of(contact%points%candidate) = [(i, i=1, size(contact%points))]
      n = size(contact%candidates, 2)
      allocate (found(n + size(contact%joined, 2)))
      !$omp parallel do schedule(dynamic, 64) if (size(found) >= worth_threads)
      do i = 1, size(found)
         if (i <= n) then
            call inspect_pair(contact%candidates(:, i), point_of(i), .false., found(i))
         else
            call inspect_pair(contact%joined(:, i - n), 0, .true., found(i))
         end if
      end do
      !$omp end parallel do
      do i = 1, size(found)
         worst = worse_of(worst, found(i))
      end do
      do i = 1, size(contact%points)
         worst = worse_of(worst, inspect_point(contact%points(i)))
      end do

   contains

      !> A contact that is too deep, as long as a line, or on the wrong side.
      type(finding_t) function inspect_point(point) result(finding)
         type(contact_point_t), intent(in) :: point
         real(dp) :: sine2, half_length, radius

         if (.not. point%gap < 0) return
         if (is_unlimited(point%pair)) return
         radius = minval(elements%radius([point%element_bar, point%element]))
         finding%elements = [point%element_bar, point%element]
         finding%overlap = -point%gap/radius
         if (finding%overlap > allowed_penetration) finding%kind = finding_deep
         associate (law => model%interactions(model%contact_pairs(point%pair)%interaction))
            finding%penalty = penalty_that_holds(law%normal, point%force, allowed_penetration*radius)
            finding%law_title = law%normal%title
            if (law%axis == axis_linear .and. has_neighbour(point)) finding%kind = finding_kink
         end associate
         ! the distance is a paraboloid there: `det M` over the squared tangents is sin^2 of the angle of straight wires
         associate (m_inverse => point%kinematics%between_q, length => elements%length(finding%elements))
            sine2 = 16/((m_inverse(1, 1)*m_inverse(2, 2) - m_inverse(1, 2)*m_inverse(2, 1))*product(length)**2)
         end associate
         half_length = sqrt(2*max(point%kinematics%distance, 0.0_dp)*(-point%gap)/max(sine2, tiny(1.0_dp)))
         if (half_length > longest_point*radius) finding%kind = finding_line
         if (point%kinematics%distance <= 0) finding%kind = finding_passed
      end function inspect_point

      !> Another contact of the same two wires is next to this one: at a kink of a straight axis both of its elements
      !> have one, and the force would count twice.
      pure logical function has_neighbour(point)
         type(contact_point_t), intent(in) :: point
         integer :: k

         has_neighbour = .false.
         k = first_of_wire(wires%wire(point%element_bar))
         do while (k > 0 .and. .not. has_neighbour)
            if (contact%points(k)%gap < 0 .and. contact%points(k)%candidate /= point%candidate) then
               has_neighbour = is_at(contact%points(k), [point%element_bar, point%element], [point%arc_bar, point%arc])
            end if
            k = next_of_wire(k)
         end do
      end function has_neighbour

      !> A contact is that of two wires at these arc lengths, barred first.
      pure logical function is_at(point, pair, arc)
         type(contact_point_t), intent(in) :: point
         !> Elements, and arc lengths (2) [m]
         integer, intent(in) :: pair(2)
         real(dp), intent(in) :: arc(2)
         real(dp) :: allowed

         is_at = .false.
         if (wires%wire(point%element) /= wires%wire(pair(2))) return
         allowed = same_contact*sum(elements%radius(pair))
         is_at = wires%arc_between(wires%wire(pair(1)), arc(1), point%arc_bar) < allowed .and. &
            wires%arc_between(wires%wire(pair(2)), arc(2), point%arc) < allowed
      end function is_at

      pure logical function is_unlimited(pair)
         integer, intent(in) :: pair

         is_unlimited = model%interactions(model%contact_pairs(pair)%interaction)%unlimited_penetration
      end function is_unlimited

      !> All local minima of the distance of two elements that overlap.
      subroutine inspect_pair(candidate, point, is_joined, finding)
         !> Barred element, unbarred element, contact pair
         integer, intent(in) :: candidate(3)
         !> The contact point of this pair; 0: none
         integer, intent(in) :: point
         !> The elements are joined, and no candidate
         logical, intent(in) :: is_joined
         type(finding_t), intent(out) :: finding
         real(dp) :: xe(3, 4), t(3, 4), length(2), places(2, max_minima), arc(2), reach, overlap
         real(dp) :: w(3), tangent(3, 2), leave(2)
         integer :: k, n_places, axis, beyond(2), kind

         associate (eb => candidate(1), e => candidate(2), radius => elements%radius(candidate(1:2)))
            axis = axis_of(candidate)
            reach = sum(radius)
            call pair_geometry(model, wires, elements, eb, e, x, rotation, xe, t, length)
            leave(1) = axis_sagitta(axis_polynomial(axis, length(1), xe(:, 1:2), t(:, 1:2)))
            leave(2) = axis_sagitta(axis_polynomial(axis, length(2), xe(:, 3:4), t(:, 3:4)))
            if (segment_distance(xe) - sum(leave) > reach) return
            if (is_joined) then
               if (lead_apart(model, elements, candidate(1:2), xe, leave)) return
            end if
            call local_minima(xe, t, length, axis, places, n_places)
            do k = 1, n_places
               call axes_at(axis, xe, t, length, places(:, k), w, tangent)
               overlap = (reach - norm2(w))/minval(radius)
               if (overlap < unseen_overlap) cycle
               arc = wires%arc([eb, e]) + wires%direction([eb, e])*places(:, k)*length/2
               beyond = [element_beyond(candidate(3), eb, places(1, k), w), &
                  element_beyond(candidate(3), e, places(2, k), -w)]
               if (any(beyond > 0)) then
                  ! further along it is found again, but towards a joint it would be called part of that
                  if (.not. leads_to_joint(candidate, beyond)) cycle
                  if (overlap_of_reference(candidate, places(:, k)) > 0) cycle
                  kind = finding_joined
               else if (is_joined) then
                  if (path_between(wires, elements, candidate(1:2), places(:, k), end_paths(model, wires, elements, &
                     candidate(1:2), self_contact_distance*maxval(radius))) < joint_radii*maxval(radius)) cycle
                  kind = finding_joined
               else
                  if (is_known(candidate, arc)) cycle
                  kind = kind_of(candidate, places(:, k), tangent, point > 0)
               end if
               finding = worse_of(finding, finding_t(kind, candidate(1:2), overlap))
            end do
            if (is_joined) call inspect_legs(candidate, finding)
         end associate
      end subroutine inspect_pair

      !> Two elements that share a node, where their wires fold up: do these overlap where joined elements end to be
      !> without contact, and did not in the reference configuration?
      subroutine inspect_legs(candidate, finding)
         !> Barred element, unbarred element, contact pair
         integer, intent(in) :: candidate(3)
         type(finding_t), intent(inout) :: finding
         real(dp) :: xe(3, 4), t(3, 4), length(2), w(3), tangent(3, 2), place(2), apart, overlap
         integer :: i, j, leg(3)

         leg(3) = candidate(3)
         apart = self_contact_distance*maxval(elements%radius(candidate(1:2)))
         do i = 1, 2
            do j = 1, 2
               if (model%connectivity(i, candidate(1)) /= model%connectivity(j, candidate(2))) cycle
               call walk_along(wires, elements, candidate(1), i, apart/2, leg(1), place(1))
               call walk_along(wires, elements, candidate(2), j, apart/2, leg(2), place(2))
               if (any(leg == 0)) cycle
               call pair_geometry(model, wires, elements, leg(1), leg(2), x, rotation, xe, t, length)
               call axes_at(axis_of(leg), xe, t, length, place, w, tangent)
               overlap = (sum(elements%radius(leg(1:2))) - norm2(w))/minval(elements%radius(leg(1:2)))
               if (overlap < unseen_overlap) cycle
               if (overlap_of_reference(leg, place) > 0) cycle
               finding = worse_of(finding, finding_t(finding_joined, leg(1:2), overlap))
            end do
         end do
      end subroutine inspect_legs

      !> Overlap at two places in the reference configuration over the smaller radius; negative: none.
      real(dp) function overlap_of_reference(candidate, place) result(overlap)
         !> Barred element, unbarred element, contact pair
         integer, intent(in) :: candidate(3)
         !> In [-1, 1] (2)
         real(dp), intent(in) :: place(2)
         real(dp) :: xe(3, 4), t(3, 4), w(3), tangent(3, 2)
         integer :: k

         do k = 1, 2
            xe(:, 2*k - 1:2*k) = model%x(:, model%connectivity(:, candidate(k)))
            t(:, 2*k - 1:2*k) = wires%contact_tangents0(:, :, candidate(k))
         end do
         associate (pair => candidate(1:2))
            call axes_at(axis_of(candidate), xe, t, elements%length(pair), place, w, tangent)
            overlap = (sum(elements%radius(pair)) - norm2(w))/minval(elements%radius(pair))
         end associate
      end function overlap_of_reference

      pure integer function axis_of(candidate)
         integer, intent(in) :: candidate(3)

         axis_of = model%interactions(model%contact_pairs(candidate(3))%interaction)%axis
      end function axis_of

      !> One of two elements, or the one beyond its end, is joined to the other one or to that beyond its end.
      logical function leads_to_joint(candidate, beyond)
         !> Barred element, unbarred element, contact pair; elements beyond their ends, 0: none
         integer, intent(in) :: candidate(3), beyond(2)
         integer :: next(2)

         next = merge(beyond, candidate(1:2), beyond > 0)
         leads_to_joint = are_joined(model, wires, elements, next(1), next(2)) .and. &
            .not. are_joined(model, wires, elements, candidate(1), candidate(2))
      end function leads_to_joint

      !> The element of the contact pair that is joined to an end of this one, and along which the distance falls
      !> further; 0: none.
      integer function element_beyond(pair, e, xi, w)
         integer, intent(in) :: pair, e
         !> Place in the element, and the line from the other wire to this one (3) [m]
         real(dp), intent(in) :: xi, w(3)
         real(dp) :: away(3)
         integer :: i, other, node, side

         element_beyond = 0
         if (abs(xi) < 1) return
         node = model%connectivity(merge(1, 2, xi < 0), e)
         do i = wires%first_at_node(node), wires%first_at_node(node + 1) - 1
            other = abs(wires%at_node(i))
            if (other == e .or. .not. is_named(other, pair)) cycle
            side = merge(1, 2, wires%at_node(i) < 0)
            if (model%interactions(model%contact_pairs(pair)%interaction)%axis == axis_hermite) then
               away = (3 - 2*side)*matmul(rotation(:, :, node), wires%contact_tangents0(:, side, other))
            else
               away = x(:, model%connectivity(3 - side, other)) - x(:, node)
               away = away/norm2(away)
            end if
            if (dot_product(w, away) < -flat*norm2(w)) then
               element_beyond = other
               return
            end if
         end do
      end function element_beyond

      logical function is_named(e, pair)
         integer, intent(in) :: e, pair

         is_named = contact%in_bar(e, pair) .or. contact%in_set(e, pair)
      end function is_named

      !> The contacts have one of these two wires at this place.
      logical function is_known(candidate, arc)
         integer, intent(in) :: candidate(3)
         !> Arc lengths on the barred and the unbarred wire (2) [m]
         real(dp), intent(in) :: arc(2)
         integer :: k

         is_known = .false.
         k = first_of_wire(wires%wire(candidate(1)))
         do while (k > 0 .and. .not. is_known)
            is_known = is_at(contact%points(k), candidate(1:2), arc)
            k = next_of_wire(k)
         end do
      end function is_known

      !> Why there is no contact.
      integer function kind_of(candidate, place, tangent, has_point) result(kind)
         integer, intent(in) :: candidate(3)
         !> Place (2), and tangents there (3, 2) [m]
         real(dp), intent(in) :: place(2), tangent(3, 2)
         logical, intent(in) :: has_point
         integer :: i, k, node

         kind = merge(finding_second, finding_missed, has_point)
         if (norm2(cross(tangent(:, 1), tangent(:, 2))) < side_by_side*product(norm2(tangent, 1))) then
            kind = finding_line
         else
            do k = 1, 2
               if (abs(place(k)) < 1) cycle
               node = model%connectivity(merge(1, 2, place(k) < 0), candidate(k))
               kind = merge(finding_end, finding_kink, count([(is_named(abs(wires%at_node(i)), candidate(3)), &
                  i=wires%first_at_node(node), wires%first_at_node(node + 1) - 1)]) == 1)
               if (kind == finding_end) return
            end do
         end if
      end function kind_of

   end function inspect_contacts

   !> The line from the unbarred to the barred axis, and both tangents.
   pure subroutine axes_at(axis, x, t, length, place, w, tangent)
      integer, intent(in) :: axis
      !> Nodal positions [m], tangents (3, 4), reference lengths (2) [m], and places (2), barred first
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2), place(2)
      !> (3) [m], and derivatives with respect to the places (3, 2) [m], barred first
      real(dp), intent(out) :: w(3), tangent(3, 2)
      real(dp), dimension(4) :: h, h1, h2

      call axis_shape(axis, length(1), place(1), h, h1, h2)
      w = on_axis(h, x(:, 1:2), t(:, 1:2))
      tangent(:, 1) = on_axis(h1, x(:, 1:2), t(:, 1:2))
      call axis_shape(axis, length(2), place(2), h, h1, h2)
      w = w - on_axis(h, x(:, 3:4), t(:, 3:4))
      tangent(:, 2) = on_axis(h1, x(:, 3:4), t(:, 3:4))
   end subroutine axes_at

end module litz_contact_net
