!> Spots that stay as large as the largest force has made them, and when contacts leave them.
!>
!> Source: theory section 10. Whatever a point carries of a contact, it remembers what the whole contact has made.
module litz_spot_memory
   use litz_kinds, only: dp
   use litz_contact_history, only: spot_shape_t
   use litz_contact_points, only: contact_point_t
   use litz_cut_forces, only: conducting_part
   use litz_cut_lens, only: is_cut
   use litz_element_library, only: elements_t
   use litz_friction_law, only: friction_slip
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok
   use litz_law_input, only: wire_pair_t
   use litz_lens_law, only: lens_t, lens_force
   use litz_line_law, only: line_spot_t
   use litz_model, only: model_t, interaction_t
   use litz_normal_forces, only: apply_normal_law, is_lens, line_of_point, wires_of
   use litz_overlap_of_force, only: overlap_of_point
   use litz_normal_law, only: overlap_of_force_t
   use litz_place_forces, only: force_along_line
   use litz_spot_law, only: contact_spot_t, contact_spot, spot_ok
   use litz_spots_of_places, only: strip_of
   use litz_wires, only: wires_t, arc_from_to
   implicit none
   private
   public :: follow_spots, leaves_spot, lens_of_spot, as_it_was, shape_of_spot, keeps_shape, overlap_of_spot, &
      part_of_spot, uncut_force

contains

   !> What remembered spots have seen of an increment that has converged: of contacts that other points carry, too.
   subroutine follow_spots(model, wires, elements, points)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(inout) :: points(:)
      type(contact_point_t) :: whole(1)
      type(wire_pair_t) :: pair
      integer :: i

      points%whole_force = 0
      points%uncut_force = 0
      do i = 1, size(points)
         associate (point => points(i), law => model%interactions(model%contact_pairs(points(i)%pair)%interaction))
            if (.not. law%spot_memory) cycle
            point%kept_overlap = merge(point%kept_overlap, 0.0_dp, point%line_place > 0)
            if (.not. point%gap < 0) cycle
            whole = point
            pair = wires_of(model, elements, point)
            if (.not. point%weight > 0) then
               whole%weight = 1
               call apply_normal_law(model, elements, whole)
               point%new_spot = has_moved_off(law, wires, pair, whole(1))
            end if
            if (.not. whole(1)%force > 0) cycle
            point%whole_force = force_along_line(whole(1))/whole(1)%weight
            point%uncut_force = uncut_force(whole(1))
            if (point%line_place > 0 .or. any(point%held)) cycle
            point%kept_overlap = -point%gap
            if (point%new_spot .or. point%history%spot_shape%uncut_force <= point%uncut_force) cycle
            point%kept_overlap = overlap_of_spot(law, pair, as_it_was(law, pair, whole(1)), &
               point%history%largest_force)
         end associate
      end do
   end subroutine follow_spots

   !> A contact that remembers its spot is no longer at it. With friction it has slipped; without, it has moved along
   !> one of its wires by more than the spot.
   pure logical function leaves_spot(law, wires, pair, point) result(leaves)
      type(interaction_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point

      leaves = point%friction%status == friction_slip
      if (.not. law%friction > 0) leaves = leaves .or. has_moved_off(law, wires, pair, point)
   end function leaves_spot

   !> It has moved along one of its wires by more than the spot.
   pure logical function has_moved_off(law, wires, pair, point) result(leaves)
      type(interaction_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      real(dp) :: moved(2)

      leaves = .false.
      if (.not. point%history%largest_force > 0) return
      moved = abs(arc_from_to(point%history%spot_arc, [point%arc_bar, point%arc], &
         wires%circumference(wires%wire([point%element_bar, point%element]))))
      leaves = maxval(moved) > size_of_spot(law, pair, point, point%history%largest_force)
   end function has_moved_off

   !> Greater half axis of a spot, half length of a lens, half width of a strip [m]; where the law has none, those of
   !> elastic wires.
   pure real(dp) function size_of_spot(law, pair, point, force) result(half_size)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> That has made the spot: of a crossing [N], of a place of a line per length [N/m]
      real(dp), intent(in) :: force
      type(contact_spot_t) :: spot
      type(line_spot_t) :: strip
      type(lens_t) :: lens
      integer :: info

      if (point%line_place > 0) then
         strip = strip_of(law%spot, point, force)
         half_size = strip%half_width
      else if (law%spot%is_per_length .or. is_lens(law%normal, point)) then
         lens = lens_of_spot(law, pair, point, force)
         half_size = lens%half_length
      else
         call contact_spot(law%spot, force, pair, point%ellipse, spot, info)
         half_size = spot%semi_major
         if (info /= spot_ok .or. .not. half_size > 0) half_size = ellipse_of(pair, point%law_angle)*force**(1.0_dp/3)
      end if
   end function size_of_spot

   !> Greater half axis of the Hertz ellipse of 1 N [m].
   pure real(dp) function ellipse_of(pair, angle) result(semi_major)
      type(wire_pair_t), intent(in) :: pair
      !> Between the axes [rad]
      real(dp), intent(in) :: angle
      type(hertz_ellipse_t) :: ellipse
      integer :: info

      semi_major = 0
      call hertz_ellipse(pair%radius, pair%young, pair%poisson, angle, ellipse, info)
      if (info == hertz_ok) semi_major = ellipse%semi_major
   end function ellipse_of

   !> The lens of a crossing in which its spot was made: the present one, or that of a larger force.
   pure type(lens_t) function lens_of_spot(law, pair, point, spot_force) result(lens)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> Not smaller than the present force [N]
      real(dp), intent(in) :: spot_force
      real(dp) :: gap

      gap = point%gap
      ! between ends the force may rise as the overlap falls
      if (spot_force > point%force/point%weight .or. keeps_shape(law, point) .and. .not. any(point%held)) gap &
         = -overlap_of_spot(law, pair, point, spot_force)
      lens = lens_force(point%line, gap, point%law_sine, law%normal%line_penalty())
   end function lens_of_spot

   !> Overlap of a crossing that has a force [m].
   pure real(dp) function overlap_of_spot(law, pair, point, force)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> Of the whole contact [N]
      real(dp), intent(in) :: force
      type(overlap_of_force_t) :: made

      overlap_of_spot = point%history%spot_shape%overlap
      if (keeps_shape(law, point)) return
      made = overlap_of_point(law%normal, pair, point, point%weight*force, point%weight)
      overlap_of_spot = made%overlap
   end function overlap_of_spot

   !> Next to an end a spot that stays has the shape that it had under the largest force: what a smaller overlap is cut
   !> to, and the angle that its law sees, are others.
   pure logical function keeps_shape(law, point)
      type(interaction_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point

      keeps_shape = law%spot_memory .and. point%line_place == 0 .and. is_cut(point%lens) .and. .not. law%normal%yields()
      keeps_shape = keeps_shape .and. .not. point%new_spot .and. point%history%spot_shape%overlap > 0 &
         .and. point%history%spot_shape%uncut_force > uncut_force(point)
   end function keeps_shape

   !> Force of the whole contact if no wire ended there [N]; of an end with it, of a place of a line per length [N/m].
   pure real(dp) function uncut_force(point) result(force)
      !> That carries some of it
      type(contact_point_t), intent(in) :: point

      force = force_along_line(point)/point%weight
      if (point%line_place > 0 .or. any(point%held)) return
      if (is_cut(point%lens) .and. point%cut > 0) force = force/point%cut
   end function uncut_force

   !> Of the lens of a crossing, what ends have left of it when the spot was made [-].
   pure real(dp) function part_of_spot(law, point)
      type(interaction_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point

      part_of_spot = conducting_part(point)
      if (keeps_shape(law, point)) part_of_spot = point%history%spot_shape%part
   end function part_of_spot

   !> The present one.
   pure type(spot_shape_t) function shape_of_spot(point) result(shape)
      type(contact_point_t), intent(in) :: point

      shape = spot_shape_t(point%ellipse, point%law_sine, max(0.0_dp, -point%gap), conducting_part(point))
      ! of one that other points carry, as it would be
      shape%uncut_force = point%uncut_force
      if (point%closed) shape%uncut_force = uncut_force(point)
   end function shape_of_spot

   !> The point with the law that it had when its spot was made: the section counts as in its largest lens.
   pure type(contact_point_t) function as_it_was(law, pair, point) result(earlier)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point

      earlier = point
      ! the force of a crossing does not depend on the section if it has a penalty
      if (point%line_place > 0 .or. .not. law%normal%line_penalty() > 0) earlier%section_share &
         = max(point%section_share, point%spot_section)
      if (keeps_shape(law, point)) then
         associate (shape => point%history%spot_shape, ellipse => point%history%spot_shape%ellipse)
            earlier%law_sine = shape%sine
            ! which no longer changes with the angle
            if (ellipse%semi_major > 0 .and. .not. law%normal%is_straight) earlier%ellipse = &
               hertz_ellipse_t(ellipse%ratio, ellipse%semi_major, ellipse%approach, ellipse%modulus)
         end associate
      end if
      earlier%line = line_of_point(pair, earlier)
   end function as_it_was

end module litz_spot_memory
