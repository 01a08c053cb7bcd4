!> Whether every overlap of near wires is a contact of the ledger.
!>
!> A wire is a tube with round joints and round ends. Contact is where the distance of two tubes has a local minimum
!> below zero; all such minima of all near pairs of elements are looked up among the contacts (litz_missed_contacts).
!> What is missing there is not modelled: it is named, and the state is no solution. Neither is one with contacts that
!> are too deep, or as long as a line.
module litz_contact_net
   use litz_kinds, only: dp
   use litz_contact_findings, only: finding_t, worse_of, finding_deep, finding_kink, finding_line, finding_passed
   use litz_contact_lens, only: half_length_of
   use litz_contact_points, only: contact_set_t, contact_point_t, points_by_wire_t, points_by_place_t, &
      chain_by_wire, chain_by_place
   use litz_element_library, only: elements_t
   use litz_contact_candidates, only: find_contact_pair
   use litz_line_contact, only: serves_lines, line_obstacle
   use litz_missed_contacts, only: inspect_pair, is_at
   use litz_model, only: model_t, axis_linear
   use litz_normal_law, only: find_stiffer_penalty
   use litz_parallel, only: worth_threads
   use litz_wires, only: wires_t
   implicit none
   private
   public :: inspect_contacts, allowed_penetration

   !> Overlap of a contact that is allowed, over the smaller radius
   real(dp), parameter :: allowed_penetration = 0.05_dp
   !> Half length of the overlap along the wires beyond which a contact is no point, in smaller radii
   real(dp), parameter :: longest_point = 2.0_dp

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
      type(finding_t) :: worst, found_here
      type(finding_t), allocatable :: found(:)
      type(points_by_wire_t) :: by_wire
      type(points_by_place_t) :: by_place
      !> The candidate has a point (n_candidates)
      logical, allocatable :: has_point(:)
      integer :: i, n, roles(2), pair
      logical :: is_final

      by_wire = chain_by_wire(wires, contact%points)
      by_place = chain_by_place(size(contact%places%xi), contact%line_points)
      n = size(contact%candidates, 2)
      allocate (has_point(n), source=.false.)
      has_point(contact%points%candidate) = .true.
      allocate (found(n + size(contact%joined, 2)))
      !$omp parallel do schedule(dynamic, 64) if (size(found) >= worth_threads)
      do i = 1, size(found)
         if (i <= n) then
            call inspect_pair(model, wires, elements, contact, by_wire, by_place, contact%candidates(:, i), &
               has_point(i), .false., x, rotation, found(i))
         else
            call inspect_pair(model, wires, elements, contact, by_wire, by_place, contact%joined(:, i - n), &
               .false., .true., x, rotation, found(i))
         end if
      end do
      !$omp end parallel do
      do i = 1, size(found)
         worst = worse_of(worst, found(i))
      end do
      is_final = .false.
      do i = 1, size(contact%points)
         found_here = inspect_point(model, wires, elements, contact%points, by_wire, contact%points(i))
         is_final = is_final .or. found_here%is_final
         worst = worse_of(worst, found_here)
      end do
      do i = 1, size(contact%line_points)
         worst = worse_of(worst, inspect_line_point(model, elements, contact%line_points(i)))
      end do
      if (worst%kind /= finding_line) return
      worst%is_final = is_final
      call find_contact_pair(model, wires, contact, worst%elements(1), worst%elements(2), roles, pair)
      if (pair > 0) worst%obstacle = line_obstacle(model%interactions(model%contact_pairs(pair)%interaction))
   end function inspect_contacts

   !> A contact that is too deep, as long as a line, or on the wrong side.
   pure type(finding_t) function inspect_point(model, wires, elements, points, by_wire, point) result(finding)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> All points, these by their barred wires, and the one to inspect
      type(contact_point_t), intent(in) :: points(:)
      type(points_by_wire_t), intent(in) :: by_wire
      type(contact_point_t), intent(in) :: point
      real(dp) :: half_length, radius

      if (.not. point%gap < 0) return
      associate (law => model%interactions(model%contact_pairs(point%pair)%interaction))
         if (law%unlimited_penetration) return
         radius = minval(elements%radius([point%element_bar, point%element]))
         finding%elements = [point%element_bar, point%element]
         finding%overlap = -point%gap/radius
         if (finding%overlap > allowed_penetration) finding%kind = finding_deep
         call find_stiffer_penalty(law%normal, point%force, -point%gap, allowed_penetration*radius, &
            law%normal%line_penalty() > 0 .and. .not. point%force > 0, finding%penalty, finding%unit)
         finding%law_title = law%normal%title
         if (law%axis == axis_linear) then
            if (has_neighbour(wires, elements, points, by_wire, point)) finding%kind = finding_kink
         end if
      end associate
      if (any(point%held)) then
         half_length = half_length_of(point, huge(radius))
      else
         half_length = sqrt(2*max(point%kinematics%distance, 0.0_dp)*(-point%gap) &
            /max(squared_sine(elements, point), tiny(1.0_dp)))
      end if
      if (half_length > longest_point*radius .and. .not. serves_lines(model, point%pair)) finding%kind = finding_line
      finding%is_final = finding%kind == finding_line
      if (point%kinematics%distance <= 0) finding%kind = finding_passed
   end function inspect_point

   !> A point of a line contact that is too deep, or on the wrong side.
   pure type(finding_t) function inspect_line_point(model, elements, point) result(finding)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point

      if (.not. point%closed) return
      finding%elements = [point%element_bar, point%element]
      finding%overlap = -point%gap/minval(elements%radius(finding%elements))
      if (finding%overlap > allowed_penetration) finding%kind = finding_deep
      associate (law => model%interactions(model%contact_pairs(point%pair)%interaction)%normal)
         finding%law_title = law%title
         call find_stiffer_penalty(law, 0.0_dp, finding%overlap, allowed_penetration, .true., finding%penalty, &
            finding%unit)
      end associate
      if (point%kinematics%distance <= 0) finding%kind = finding_passed
   end function inspect_line_point

   !> Squared sine of the angle of straight wires between which the distance would grow as it does round this point.
   pure real(dp) function squared_sine(elements, point) result(sine2)
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point

      ! the distance is a paraboloid there: `det M` over the squared tangents is sin^2 of the angle of straight wires
      associate (m_inverse => point%kinematics%between_q, &
         length => elements%length([point%element_bar, point%element]))
         sine2 = 16/((m_inverse(1, 1)*m_inverse(2, 2) - m_inverse(1, 2)*m_inverse(2, 1))*product(length)**2)
      end associate
   end function squared_sine

   !> Another contact of the same two wires is next to this one: at a kink of a straight axis both of its elements
   !> have one, and the force would count twice.
   pure logical function has_neighbour(wires, elements, points, by_wire, point)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> All points, these by their barred wires, and one of them
      type(contact_point_t), intent(in) :: points(:)
      type(points_by_wire_t), intent(in) :: by_wire
      type(contact_point_t), intent(in) :: point
      integer :: k

      has_neighbour = .false.
      k = by_wire%first(wires%wire(point%element_bar))
      do while (k > 0 .and. .not. has_neighbour)
         if (points(k)%gap < 0 .and. points(k)%candidate /= point%candidate) then
            has_neighbour = is_at(wires, elements, points(k), [point%element_bar, point%element], &
               [point%arc_bar, point%arc])
         end if
         k = by_wire%next(k)
      end do
   end function has_neighbour

end module litz_contact_net
