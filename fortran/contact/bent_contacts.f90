!> How wires are bent where they cross: what the law of the contact sees of it, and the force that belongs to that.
!>
!> The curvature of the axes has a jump at each node. The law sees one that has none: at a node a mean of both elements
!> by which straight stays straight, between nodes a cubic without a slope at them. Within an iteration it stays, and so
!> does what the energy of the contact changes with it: the force by which the contact resists to be bent, rolled, or
!> moved along its wires to where they are bent otherwise.
!>
!> Source: theory section 10, with (10.14a) and (10.14b).
module litz_bent_contacts
   use litz_kinds, only: dp, pi
   use litz_axis_curvature, only: curvature_at_nodes, axis_curvature
   use litz_bent_wires, only: bent_crossing_t, bent_crossing
   use litz_closest_points, only: parallel_sine
   use litz_contact_bending, only: bends_seen_t, risen
   use litz_contact_points, only: contact_point_t, axis_of_pair
   use litz_cut_lens, only: is_cut
   use litz_element_library, only: elements_t
   use litz_lens_law, only: smooth_step
   use litz_model, only: model_t
   use litz_normal_law, only: normal_law_t
   use litz_parallel, only: worth_threads
   use litz_wires, only: wires_t
   implicit none
   private
   public :: feels_bends, is_bent, resists_bending, bends_of, sine_of_bends, qualities_of, see_bends, settle_bends, &
      follow_bends, change_of_bends, change_of_resistance

   !> Angle by which a wire turns at a node from which on that begins to be a kink, which it is at 20 degrees
   real(dp), parameter :: begins_to_kink = 10*pi/180, is_kink = 20*pi/180
   !> Places from which on the force on an element is whole, and has gone
   real(dp), parameter :: far_from_node = 0.8_dp, at_node = 0.95_dp
   !> Cosine of the angle of the law below which the energy is a parabola over it
   real(dp), parameter :: flat = 1.0e-4_dp

contains

   !> A penalty does not depend on how the surfaces part; a dent has their shape, which stays as the wires bend on.
   pure logical function feels_bends(law)
      type(normal_law_t), intent(in) :: law

      feels_bends = law%uses_ellipse .and. .not. law%yields()
   end function feels_bends

   !> Its energy changes with the curvatures.
   pure logical function resists_bending(point)
      type(contact_point_t), intent(in) :: point

      resists_bending = any(abs(point%bends%by_curvature) > 0) .and. .not. any(point%held)
   end function resists_bending

   pure logical function is_bent(point)
      type(contact_point_t), intent(in) :: point

      is_bent = any(abs(point%bends%curvature) > 0)
   end function is_bent

   !> q (10.3) of a foot on the unbarred and on the barred wire (2): `1 + d k`, with curvatures that have no jump at
   !> nodes.
   pure function qualities_of(point) result(quality)
      !> A crossing
      type(contact_point_t), intent(in) :: point
      real(dp) :: quality(2)

      quality = 1 + point%kinematics%distance*point%bends%of_axes([2, 1])
   end function qualities_of

   !> The straight wires for which the law takes the two.
   pure type(bent_crossing_t) function bends_of(point, angle) result(straight)
      type(contact_point_t), intent(in) :: point
      !> Of the axes [rad]
      real(dp), intent(in) :: angle

      ! of parallel axes the angle is stationary
      associate (least => asin(parallel_sine))
         straight = bent_crossing(point%radius, point%bends%curvature, max(least, min(pi - least, angle)))
      end associate
   end function bends_of

   !> Sine of the angle that the law sees.
   pure real(dp) function sine_of_bends(point, angle) result(sine)
      type(contact_point_t), intent(in) :: point
      !> Of the axes [rad]
      real(dp), intent(in) :: angle
      type(bent_crossing_t) :: straight

      sine = sin(angle)
      if (.not. is_bent(point)) return
      straight = bends_of(point, angle)
      sine = straight%sine
   end function sine_of_bends

   !> Bring up to date the curvatures that the law sees, and what the energy changes by them.
   pure subroutine settle_bends(model, wires, elements, x, rotation, law, point)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(normal_law_t), intent(in) :: law
      !> Closed, with the law at its gap
      type(contact_point_t), intent(inout) :: point

      point%bends%by_curvature = 0
      if (feels_bends(law) .and. .not. (any(point%held) .or. is_cut(point%lens))) then
         point%bends%by_curvature = energy_by_curvature(point)
      end if
      call see_bends(model, wires, elements, x, rotation, law, .false., .false., point)
   end subroutine settle_bends

   !> The curvatures of wires that do not touch, at the end of an increment: of those that do they are settled.
   subroutine follow_bends(model, wires, elements, x, rotation, points)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(contact_point_t), intent(inout) :: points(:)
      integer :: i

      !$omp parallel do schedule(static) if (size(points) >= worth_threads)
      do i = 1, size(points)
         if (points(i)%gap < 0) cycle
         points(i)%bends%by_curvature = 0
         call see_bends(model, wires, elements, x, rotation, model%interactions(model%contact_pairs( &
            points(i)%pair)%interaction)%normal, .false., .false., points(i))
      end do
      !$omp end parallel do
   end subroutine follow_bends

   !> How the wires are bent, and the curvatures that the law of the contact sees.
   pure subroutine see_bends(model, wires, elements, x, rotation, law, stay, places_stay, point)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      type(normal_law_t), intent(in) :: law
      !> The curvatures do, and the places at which the axes bend
      logical, intent(in) :: stay, places_stay
      !> With its kinematics
      type(contact_point_t), intent(inout) :: point
      real(dp) :: of_axes(3, 2)
      logical :: resists

      resists = feels_bends(law) .and. .not. places_stay .and. resists_bending(point)
      if (stay .and. .not. resists) return
      call find_curvatures(model, wires, elements, point, x, rotation, of_axes, point%bends_seen)
      if (stay) return
      point%bends%are_known = .true.
      point%bends%of_axes = away(of_axes)
      point%bends%curvature = 0
      if (feels_bends(law)) point%bends%curvature = away(reshape([curvature_at(point%bends_seen, 1, point%xi_bar), &
         curvature_at(point%bends_seen, 2, point%xi)], [3, 2]))

   contains

      !> From each other, of the barred and the unbarred axis (2) [1/m].
      pure function away(curvature)
         !> Of both (3, 2) [1/m]
         real(dp), intent(in) :: curvature(:, :)
         real(dp) :: away(2)

         away = [1, -1]*matmul(point%kinematics%normal, curvature)
      end function away

   end subroutine see_bends

   !> How the energy of a contact changes with the curvatures of its two axes (2) [J m].
   pure function energy_by_curvature(point) result(derivative)
      type(contact_point_t), intent(in) :: point
      real(dp) :: derivative(2), by_sine, cosine
      type(bent_crossing_t) :: straight

      straight = bends_of(point, point%kinematics%angle)
      cosine = cos(point%law_angle)
      associate (law => point%at_gap)
         if (abs(cosine) > flat) then
            by_sine = law%denergy_dangle/cosine
         else
            by_sine = -law%d2energy_dangle2
         end if
         ! the force goes with the root of the radii
         derivative = by_sine*straight%dsine - law%energy/(2*straight%ratio)*straight%dratio
      end associate
   end function energy_by_curvature

   !> Curvatures of both axes of a contact, without a jump at nodes: of the axes, and what the law sees of them.
   pure subroutine find_curvatures(model, wires, elements, point, x, rotation, of_axes, seen)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes)
      real(dp), intent(in) :: x(:, :), rotation(:, :, :)
      !> Of the barred and the unbarred axis (3, 2) [1/m]
      real(dp), intent(out) :: of_axes(3, 2)
      type(bends_seen_t), intent(out) :: seen
      real(dp) :: at_node(3, 2), part(2)
      integer :: i, side

      associate (pair => [point%element_bar, point%element], xi => [point%xi_bar, point%xi])
         do i = 1, 2
            at_node = curvature_at_nodes(model, wires, elements, axis_of_pair(model, point%pair), pair(i), x, rotation)
            of_axes(:, i) = axis_curvature(model, wires, elements, axis_of_pair(model, point%pair), pair(i), xi(i), &
               x, rotation)
            part = [(part_seen(model, wires, pair(i), side), side=1, 2)]
            seen%at_first(:, i) = part(1)*at_node(:, 1)
            seen%change(:, i) = part(2)*at_node(:, 2) - part(1)*at_node(:, 1)
            seen%part(i) = away_from_nodes(xi(i))*((part(1) + part(2))/2 + xi(i)*(part(2) - part(1))/2)
            seen%place(i) = point%angle_at(i)
         end do
      end associate
   end subroutine find_curvatures

   !> How much of the force on the element itself there is: next to a node, where it would go over to another element,
   !> there is none.
   pure real(dp) function away_from_nodes(xi)
      !> In the element
      real(dp), intent(in) :: xi

      away_from_nodes = 1 - smooth_step((abs(xi) - far_from_node)/(at_node - far_from_node))
   end function away_from_nodes

   !> At a place of one of the elements (3) [1/m].
   pure function curvature_at(seen, i, xi) result(curvature)
      type(bends_seen_t), intent(in) :: seen
      !> 1: the barred, 2: the unbarred one
      integer, intent(in) :: i
      !> In it
      real(dp), intent(in) :: xi
      real(dp) :: curvature(3)

      curvature = seen%at_first(:, i) + risen(xi)*seen%change(:, i)
   end function curvature_at

   !> What the law sees of the curvature at the first or second node of an element [-]: nothing at kinks and where wires
   !> join.
   pure real(dp) function part_seen(model, wires, e, side) result(part)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      !> Element, and 1 or 2
      integer, intent(in) :: e, side
      real(dp) :: turn
      integer :: next, node

      node = model%connectivity(side, e)
      next = wires%next(side, e)
      if (next == 0) then
         part = merge(1.0_dp, 0.0_dp, wires%first_at_node(node + 1) - wires%first_at_node(node) == 1)
         return
      end if
      turn = acos(min(1.0_dp, abs(dot_product(chord(e), chord(next)))))
      part = 1 - smooth_step((turn - begins_to_kink)/(is_kink - begins_to_kink))

   contains

      !> Reference direction of an element (3).
      pure function chord(element)
         !> Index
         integer, intent(in) :: element
         real(dp) :: chord(3)

         associate (nodes => model%connectivity(:, element))
            chord = model%x(:, nodes(2)) - model%x(:, nodes(1))
         end associate
         chord = chord/norm2(chord)
      end function chord

   end function part_seen

   !> Relative change of the force by that of the curvatures, about.
   pure real(dp) function change_of_bends(earlier, point) result(change)
      type(contact_point_t), intent(in) :: earlier, point
      type(bent_crossing_t) :: before, now

      before = bends_of(earlier, point%kinematics%angle)
      now = bends_of(point, point%kinematics%angle)
      change = abs(now%ratio/before%ratio - 1)/2
      if (before%sine > 0) change = change + abs(now%sine/before%sine - 1)
   end function change_of_bends

   !> Relative change of the force by which the contact resists to be bent otherwise.
   pure real(dp) function change_of_resistance(earlier, point) result(change)
      type(contact_point_t), intent(in) :: earlier, point

      associate (before => earlier%bends%by_curvature, now => point%bends%by_curvature)
         change = maxval(abs(now - before))/max(maxval(abs(now)), maxval(abs(before)), tiny(now))
      end associate
   end function change_of_resistance

end module litz_bent_contacts
