!> The dents of wires that yield, and when contacts slide off them.
!>
!> Source: theory section 15. A dent has the size of the spot of its largest force. What a contact that has slid by the
!> vector `u` feels of this force is the overlap of the two spots, before and after, as part of one:
!> `eta = (2/pi) (acos(t) - t sqrt(1 - t^2))`, `t = |(u_a/(2 a), u_b/(2 b))|`.
module litz_dents
   use litz_kinds, only: dp, pi
   use litz_contact_history, only: dent_memory_t, left_dents_t
   use litz_contact_points, only: contact_point_t, contact_set_t
   use litz_cut_lens, only: is_cut
   use litz_element_library, only: elements_t
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok
   use litz_law_input, only: earlier_dent_t, wire_pair_t
   use litz_model, only: model_t
   use litz_normal_forces, only: apply_normal_law, is_lens, line_of_point, wires_of
   use litz_normal_law, only: normal_law_t
   use litz_normal_yielding, only: dent_of_wires
   use litz_ploughing, only: ploughing_coefficient, work_of_slide
   use litz_wires, only: wires_t, arc_from_to
   use litz_yielding_lens, only: yielding_lens_t
   use litz_yielding_spot, only: dent_t
   use litz_yielding_wires, only: depth_of_lens, lens_of_wires, part_yielded, place_of_wires
   implicit none
   private
   public :: follow_dents, find_left_dents, keep_left_dents, work_of_slides

   !> A contact whose force is this part of what it felt lies in its dent, not on top of it but for round-off
   real(dp), parameter :: below_top = 1 - 1.0e-6_dp

contains

   !> What dents have seen of an increment that has converged.
   subroutine follow_dents(model, wires, elements, points)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(inout) :: points(:)
      type(contact_point_t) :: whole(1)
      type(wire_pair_t) :: pair
      type(dent_memory_t) :: dent
      integer :: i

      do i = 1, size(points)
         associate (point => points(i), &
            law => model%interactions(model%contact_pairs(points(i)%pair)%interaction)%normal)
            if (.not. law%yields()) cycle
            pair = wires_of(model, elements, point)
            ! a crossing whose places carry all of it goes on to remember the force of the whole
            if (point%line_place == 0 .and. point%gap < 0 .and. .not. point%weight > 0) then
               whole = point
               whole%weight = 1
               call apply_normal_law(model, elements, whole)
               point%yielding_force = whole(1)%yielding_force
               point%felt_force = whole(1)%felt_force
            end if
            dent = point%history%dent
            call follow_dent(law, wires, pair, point, dent)
            dent%dissipation = dent%dissipation + point%ploughed + point%settled
            if (point%line_place == 0) call follow_slide(law, wires, pair, dent, point)
            point%history%dent = dent
            call show_dent(law, pair, point%history%dent, point)
         end associate
      end do
   end subroutine follow_dents

   !> A crossing has slid over its dent.
   pure subroutine follow_slide(law, wires, pair, dent, point)
      type(normal_law_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(wire_pair_t), intent(in) :: pair
      !> After the increment
      type(dent_memory_t), intent(inout) :: dent
      !> With the dent of the increment
      type(contact_point_t), intent(inout) :: point
      type(dent_t) :: made
      real(dp) :: unused(2)

      ! what leaving its dent changes of the energy of a lens is settled with its shares
      if (.not. is_lens(law, point)) dent%dissipation = dent%dissipation - work_of_slide(law, pair, point, dent)
      point%climbed = climb(law, wires, pair, point)
      call dent_here(law, pair, point, earlier_dent_t(dent%force, dent%overlap), made, unused)
      point%ploughing = ploughing_coefficient(law, pair, point, dent, max(0.0_dp, slide_over_dent(law, wires, pair, &
         point, dent, [point%arc_bar, point%arc])), sqrt(made%area/pi))
   end subroutine follow_slide

   !> Work by which an increment that has converged slides wires out of their dents, but for what ploughing dissipates.
   real(dp) function work_of_slides(model, wires, elements, points) result(work)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: points(:)
      type(wire_pair_t) :: pair
      type(dent_memory_t) :: dent
      integer :: i

      work = 0
      do i = 1, size(points)
         associate (point => points(i), &
            law => model%interactions(model%contact_pairs(points(i)%pair)%interaction)%normal)
            if (.not. law%yields() .or. is_lens(law, point)) cycle
            pair = wires_of(model, elements, point)
            dent = point%history%dent
            call follow_dent(law, wires, pair, point, dent)
            work = work + work_of_slide(law, pair, point, dent)
         end associate
      end do
   end function work_of_slides

   !> How far a contact that lies in its dent has slid up its side in the increment, over the width of the dent [-].
   pure real(dp) function climb(law, wires, pair, point)
      type(normal_law_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(wire_pair_t), intent(in) :: pair
      !> With the dent of the increment
      type(contact_point_t), intent(in) :: point

      climb = 0
      associate (history => point%history)
         if (.not. (history%closed .and. point%force < below_top*point%weight*point%felt_force)) return
         climb = slide_over_dent(law, wires, pair, point, history%dent, [point%arc_bar, point%arc]) &
            - slide_over_dent(law, wires, pair, point, history%dent, history%arc)
      end associate
   end function climb

   !> Wires that have parted and come back feel the dent of then where they meet in it.
   subroutine find_left_dents(model, wires, elements, left, points)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(left_dents_t), intent(in) :: left
      type(contact_point_t), intent(inout) :: points(:)
      type(wire_pair_t) :: pair
      real(dp) :: part
      integer :: i, k

      if (size(left%dents) == 0) return
      do i = 1, size(points)
         associate (point => points(i), &
            law => model%interactions(model%contact_pairs(points(i)%pair)%interaction)%normal)
            point%found_dent = 0
            if (point%predecessor > 0 .or. .not. law%yields()) cycle
            pair = wires_of(model, elements, point)
            ! the nearest one, if several do
            point%history%dent%left = 0
            do k = 1, size(left%dents)
               if (any(left%wires(:, k) /= wires_of_dent(wires, point))) cycle
               part = left%dents(k)%left
               if (point%line_place == 0) part = part_left(law, wires, pair, point, left%dents(k))
               if (.not. part > point%history%dent%left) cycle
               point%found_dent = k
               point%history%dent = left%dents(k)
               point%history%dent%left = part
               point%history%dent%felt = 0
               point%section_share = point%history%dent%share_of_section(point%section_share)
            end do
         end associate
      end do
   end subroutine find_left_dents

   !> The dents that no contact has any more when an increment has converged.
   subroutine keep_left_dents(wires, contact)
      type(wires_t), intent(in) :: wires
      type(contact_set_t), intent(inout) :: contact
      logical, allocatable :: is_kept(:)
      integer, allocatable :: old(:), new(:), new_places(:)
      integer :: i

      allocate (is_kept(size(contact%left_dents%dents)), source=.true.)
      call find_left(contact%converged, contact%points, is_kept, new)
      call find_left(contact%converged_line_points, contact%line_points, is_kept, new_places)
      if (all(is_kept) .and. size(new) + size(new_places) == 0) return
      old = pack([(i, i=1, size(is_kept))], is_kept)
      associate (left => contact%left_dents, crossings => contact%converged, places => contact%converged_line_points)
         left%wires = reshape([left%wires(:, old), (wires_of_dent(wires, crossings(new(i))), i=1, size(new)), &
            (wires_of_dent(wires, places(new_places(i))), i=1, size(new_places))], &
            [3, size(old) + size(new) + size(new_places)])
         left%dents = [left%dents(old), crossings(new)%history%dent, places(new_places)%history%dent]
      end associate
   end subroutine keep_left_dents

   !> Which contacts of the start of an increment have left their dents, and which dents have been found again.
   pure subroutine find_left(converged, points, is_kept, new)
      !> At the start and at the end of the increment
      type(contact_point_t), intent(in) :: converged(:), points(:)
      !> Dents that no contact has (n)
      logical, intent(inout) :: is_kept(:)
      !> Of `converged` (m)
      integer, allocatable, intent(out) :: new(:)
      logical :: is_left(size(converged))
      integer :: i

      is_left = converged%history%dent%force > 0
      do i = 1, size(points)
         if (points(i)%found_dent > 0) is_kept(points(i)%found_dent) = .false.
         if (points(i)%predecessor > 0) is_left(points(i)%predecessor) = .false.
      end do
      new = pack([(i, i=1, size(converged))], is_left)
   end subroutine find_left

   !> Contact pair and wires of a contact (3).
   pure function wires_of_dent(wires, point) result(numbers)
      type(wires_t), intent(in) :: wires
      type(contact_point_t), intent(in) :: point
      integer :: numbers(3)

      numbers = [point%pair, wires%wire(point%element_bar), wires%wire(point%element)]
      ! a place of a line remembers what it has felt itself
      if (point%line_place > 0) numbers(3) = -point%line_place
   end function wires_of_dent

   !> A force that the contact has not felt before makes a dent of its own.
   pure subroutine follow_dent(law, wires, pair, point, dent)
      type(normal_law_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      type(dent_memory_t), intent(inout) :: dent

      dent%dissipation = dent%dissipation + point%yielded
      if (dent%force > 0 .and. point%line_place == 0) dent%left = part_left(law, wires, pair, point, dent)
      dent%felt = felt_here(law, pair, point, dent)
      if (point%yielding_force > 0 .and. point%yielding_force >= dent%felt) then
         ! less than what is left of the largest force where the spot is shorter at this angle: that stays
         dent%force = max(point%yielding_force, dent%left*dent%force)
         ! a larger force at less overlap, as the spot has grown longer, does not fill what has been pressed deeper; of
         ! that the part is left which is left of its force: yielding metal has forces about in proportion to overlaps
         dent%overlap = dent%left*dent%overlap
         dent%arc = [point%arc_bar, point%arc]
         dent%left = 1
         dent%section_share = point%section_share*part_of(law, pair, dent, point)
      end if
      dent%overlap = max(dent%overlap, -point%gap)
      dent%felt = felt_here(law, pair, point, dent)
   end subroutine follow_dent

   !> Metal that has yielded keeps its far field, what is elastic does not: by the depth of the dent [-].
   pure real(dp) function part_of(law, pair, dent, point) result(part)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(dent_memory_t), intent(in) :: dent
      type(contact_point_t), intent(in) :: point
      type(contact_point_t) :: there

      there = point
      call show_dent(law, pair, dent, there)
      part = part_yielded(there%dent, there%deepest)
   end function part_of

   !> Force of a dent that is felt at the present angle [N], of a place of a line per length [N/m].
   pure real(dp) function felt_here(law, pair, point, dent) result(felt)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      type(dent_memory_t), intent(in) :: dent
      type(contact_point_t) :: there
      type(yielding_lens_t) :: lens
      type(dent_t) :: made
      real(dp) :: unused(2)

      felt = dent%felt_force()
      if (point%line_place > 0 .or. .not. felt > 0) return
      if (is_lens(law, point)) then
         there = point
         there%history%dent = dent
         there%line = line_of_point(pair, there)
         lens = lens_of_wires(law, pair, there)
         felt = lens%felt
      else
         call dent_here(law, pair, point, dent%at_any_angle(), made, unused)
         if (made%force > 0) felt = made%force
      end if
   end function felt_here

   !> What results show of a dent.
   pure subroutine show_dent(law, pair, dent, point)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(dent_memory_t), intent(in) :: dent
      type(contact_point_t), intent(inout) :: point
      type(contact_point_t) :: there
      type(yielding_lens_t) :: lens
      type(dent_t) :: made
      real(dp) :: half_axes(2)

      point%largest_force = dent%felt
      point%yield_dissipation = dent%dissipation
      there = point
      there%history%dent = dent
      if (point%line_place > 0) then
         call show_place(law, pair, there, point)
      else if (is_lens(law, point) .and. dent%felt > 0) then
         there%line = line_of_point(pair, there)
         lens = lens_of_wires(law, pair, there)
         point%deepest = lens%deepest
         point%dent = depth_of_lens(lens)
         half_axes(1) = sqrt(lens%dent%area/(pi*lens%ellipse%ratio))
         point%largest_semi_major = lens%strip_share*sqrt(2*sum(pair%radius)*lens%deepest)/point%law_sine &
            + (1 - lens%strip_share)*half_axes(1)
      else
         call dent_here(law, pair, point, dent%at_any_angle(), made, half_axes)
         point%deepest = made%overlap
         point%dent = made%depth
         point%largest_semi_major = half_axes(1)
         point%spot_share = sqrt(made%area/pi)/minval(pair%radius)
      end if
   end subroutine show_dent

   !> The dent of a place of a line: its largest force per length is that of the length that it stands for.
   pure subroutine show_place(law, pair, there, point)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> The point with its present memory
      type(contact_point_t), intent(in) :: there
      type(contact_point_t), intent(inout) :: point
      type(contact_point_t) :: now

      if (point%in_lens) point%deepest = max(point%deepest, point%lens_depth - point%gap)
      if (.not. point%weight > 0) return
      now = there
      now%deepest = point%deepest
      now%line = line_of_point(pair, now)
      now%yielding_place = place_of_wires(law, pair, now)
      point%largest_force = point%weight*now%yielding_place%dent%force
      point%dent = now%yielding_place%dent%depth
      point%largest_semi_major = now%yielding_place%dent%half_width
   end subroutine show_place

   !> The dent at the present angle; all 0 where there is no force, or the wires are parallel.
   pure subroutine dent_here(law, pair, point, earlier, dent, half_axes)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      type(earlier_dent_t), intent(in) :: earlier
      type(dent_t), intent(out) :: dent
      !> Of its spot, the longer one first (2) [m]
      real(dp), intent(out) :: half_axes(2)
      type(hertz_ellipse_t) :: ellipse
      integer :: info

      half_axes = 0
      if (is_cut(point%lens)) then
         ellipse = point%ellipse
         if (.not. ellipse%semi_major > 0) return
      else
         call hertz_ellipse(pair%radius, pair%young, pair%poisson, point%law_angle, ellipse, info)
         if (info /= hertz_ok) return
      end if
      dent = dent_of_wires(law, pair, ellipse, earlier)
      half_axes = sqrt(dent%area/(pi*ellipse%ratio))*[1.0_dp, ellipse%ratio]
   end subroutine dent_here

   !> Common area of the dent and a spot of its size where the contact is now, over its area [-].
   pure real(dp) function part_left(law, wires, pair, point, dent) result(part)
      type(normal_law_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      type(dent_memory_t), intent(in) :: dent
      real(dp) :: slide

      slide = slide_over_dent(law, wires, pair, point, dent, [point%arc_bar, point%arc])
      part = dent%left
      if (slide >= 0) part = common_part(slide)
   end function part_left

   !> Distance of two spots as large as the dent, in the dent and at a place, over their diameter: t of (15.17) [-];
   !> -1 where the wires are parallel.
   pure real(dp) function slide_over_dent(law, wires, pair, point, dent, arc) result(slide)
      type(normal_law_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      type(dent_memory_t), intent(in) :: dent
      !> Of the place along both wires (2) [m]
      real(dp), intent(in) :: arc(2)
      type(dent_t) :: made
      real(dp) :: moved(2), slip(2), along(2), half_axes(2)

      slide = -1
      call dent_here(law, pair, point, earlier_dent_t(dent%force, dent%overlap), made, half_axes)
      if (.not. made%area > 0) return
      moved = arc_from_to(dent%arc, arc, wires%circumference(wires%wire([point%element_bar, point%element])))
      moved = moved*wires%direction([point%element_bar, point%element])
      ! in a frame along the barred axis, which the other one crosses at the angle
      associate (angle => point%kinematics%angle)
         slip = moved(1)*[1.0_dp, 0.0_dp] - moved(2)*[cos(angle), sin(angle)]
         along = major_axis(pair%radius, angle)
      end associate
      slide = norm2([dot_product(slip, along), along(1)*slip(2) - along(2)*slip(1)]/(2*half_axes))
   end function slide_over_dent

   !> Direction of the longer axis of the spot in the plane of contact, where the curvatures together are least.
   pure function major_axis(radius, angle) result(along)
      !> Barred, unbarred (2) [m], and angle between the axes [rad]
      real(dp), intent(in) :: radius(2), angle
      real(dp) :: along(2), turned

      ! of the sum of t t^T/r over both wires, with their directions t, the larger principal axis
      turned = atan2(sin(2*angle)/radius(2), 1/radius(1) + cos(2*angle)/radius(2))/2
      along = [cos(turned), sin(turned)]
   end function major_axis

   !> Area that two equal circles have in common, over that of one.
   elemental real(dp) function common_part(t) result(part)
      !> Distance of their centres over their diameter [-]
      real(dp), intent(in) :: t

      part = 0
      if (t < 1) part = 2/pi*(acos(t) - t*sqrt((1 - t)*(1 + t)))
   end function common_part

end module litz_dents
