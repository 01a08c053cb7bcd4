!> The way of wires through an increment of which only the start and the end are known.
!>
!> The chord of each element turns and stretches uniformly. A wire is put together from its chords, from the node on
!> that moves least, which goes straight on: wires that turn keep their lengths, which they would not if each node
!> went straight. Nodes of a rigid body go round its reference node, which goes straight on, and with them the wires
!> that they are on. The way is cut into legs so short that within one of them nodes do go straight.
module litz_contact_path
   use litz_kinds, only: dp
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_rotations, only: cross, nearest_rotation_vector, rotation_exp
   use litz_wires, only: wires_t
   implicit none
   private
   public :: contact_path_t, find_path, legs_of_arc

   !> Straight legs leave the way by this part of the radius at most
   real(dp), parameter :: leg_tolerance = 0.1_dp
   integer, parameter :: max_legs = 1024
   !> A wire that turns by more than this (150 degrees) has been farther from its end than at its start: what it may
   !> have met is not among the candidates [rad]
   real(dp), parameter :: max_turn = 2.618_dp

   type :: contact_path_t
      !> Straight legs; 1: all nodes go straight
      integer :: n_legs = 1
      !> An element that turns by more than `max_turn` on its way; 0: none
      integer :: turned_element = 0
      !> Positions at the start and at the end (3, n_nodes) [m], rotations at the start (3, 3, n_nodes)
      real(dp), allocatable :: x_start(:, :), x_end(:, :), rotation_start(:, :, :)
      !> Rotation vector of each node over the increment (3, n_nodes) [rad]
      real(dp), allocatable :: turn(:, :)
      !> Reference node of the rigid body of each node; 0: it is in none (n_nodes)
      integer, allocatable :: reference(:)
      !> How each chord turns: with the mean of its nodes, and by what is left (3, n_elements) [rad]
      real(dp), allocatable :: chord_turn(:, :), chord_rest(:, :)
   contains
      procedure :: positions
      procedure :: rotations
   end type contact_path_t

contains

   !> Prepare the way, and see how many legs it needs.
   pure subroutine find_path(model, wires, elements, x_start, rotation_start, x_end, rotation_end, turn, is_swept, path)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Positions (3, n_nodes) [m] and rotations (3, 3, n_nodes) at the start and at the end of the increment
      real(dp), intent(in) :: x_start(:, :), rotation_start(:, :, :), x_end(:, :), rotation_end(:, :, :)
      !> Sum of the rotations of each node in the increment (3, n_nodes) [rad]: distinguishes full turns
      real(dp), intent(in) :: turn(:, :)
      !> The element may touch others (n_elements)
      logical, intent(in) :: is_swept(:)
      type(contact_path_t), intent(out) :: path
      real(dp) :: angle, longest
      integer :: node, e, w

      path%x_start = x_start
      path%x_end = x_end
      path%rotation_start = rotation_start
      allocate (path%turn(3, size(x_start, 2)))
      do node = 1, size(x_start, 2)
         path%turn(:, node) = nearest_rotation_vector( &
            matmul(rotation_end(:, :, node), transpose(rotation_start(:, :, node))), turn(:, node))
      end do
      path%reference = references(model, size(x_start, 2))
      allocate (path%chord_turn(3, model%n_elements), path%chord_rest(3, model%n_elements))
      do e = 1, model%n_elements
         associate (nodes => model%connectivity(:, e))
            path%chord_turn(:, e) = sum(path%turn(:, nodes), 2)/2
            path%chord_rest(:, e) = turn_between(matmul(rotation_exp(path%chord_turn(:, e)), &
               x_start(:, nodes(2)) - x_start(:, nodes(1))), x_end(:, nodes(2)) - x_end(:, nodes(1)))
         end associate
      end do
      do w = 1, wires%n_wires
         associate (members => wires%element(wires%first(w):wires%first(w + 1) - 1))
            if (.not. any(is_swept(members))) cycle
            angle = maxval(norm2(path%chord_turn(:, members), 1) + norm2(path%chord_rest(:, members), 1))
            if (angle > max_turn) path%turned_element = members(1)
            ! an arc of this angle and of the length of the wire leaves its chord by length angle^2/8
            longest = sqrt(8*leg_tolerance*minval(elements%radius(members))/sum(elements%length(members)))
            path%n_legs = max(path%n_legs, ceiling(min(angle/longest, real(max_legs, dp))), &
               legs_of_bodies(path, [model%connectivity(:, members)], minval(elements%radius(members))))
         end associate
      end do
   end subroutine find_path

   !> Reference nodes of the rigid bodies that nodes are in (n_nodes).
   pure function references(model, n_nodes) result(reference)
      type(model_t), intent(in) :: model
      !> Number of nodes
      integer, intent(in) :: n_nodes
      integer :: reference(n_nodes)
      integer :: i

      reference = 0
      do i = 1, size(model%rigid_bodies)
         associate (body => model%rigid_bodies(i))
            reference(body%tied) = body%reference_node
            reference(body%pinned) = body%reference_node
         end associate
      end do
   end function references

   !> Straight legs for nodes that go round reference nodes.
   pure integer function legs_of_bodies(path, nodes, radius) result(n_legs)
      type(contact_path_t), intent(in) :: path
      !> Of a wire (n)
      integer, intent(in) :: nodes(:)
      !> Of the wire [m]
      real(dp), intent(in) :: radius
      integer :: k

      n_legs = 1
      do k = 1, size(nodes)
         associate (centre => path%reference(nodes(k)))
            if (centre > 0) n_legs = max(n_legs, legs_of_arc(norm2(path%turn(:, centre)), &
               norm2(path%x_start(:, nodes(k)) - path%x_start(:, centre)), radius))
         end associate
      end do
   end function legs_of_bodies

   !> Straight legs for an arc of the angle a and the radius R, which leaves its chord by R a^2/8.
   pure integer function legs_of_arc(angle, radius, radius_of_wire) result(n_legs)
      !> [rad], [m], [m]
      real(dp), intent(in) :: angle, radius, radius_of_wire

      n_legs = max(1, ceiling(min(angle*sqrt(radius/(8*leg_tolerance*radius_of_wire)), real(max_legs, dp))))
   end function legs_of_arc

   !> Rotation vector of the smallest turn from one direction to another.
   pure function turn_between(a, b) result(turn)
      !> The two directions (3), of any length
      real(dp), intent(in) :: a(3), b(3)
      real(dp) :: turn(3), axis(3)

      axis = cross(a, b)
      turn = 0
      if (norm2(axis) > 0) turn = axis/norm2(axis)*atan2(norm2(axis), dot_product(a, b))
   end function turn_between

   !> Positions of all nodes at a time from 0 to 1 (3, n_nodes) [m].
   pure function positions(self, model, wires, time) result(x)
      class(contact_path_t), intent(in) :: self
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      !> 0: start of the increment, 1: its end
      real(dp), intent(in) :: time
      real(dp) :: x(3, size(self%x_start, 2))
      integer :: w, node

      x = (1 - time)*self%x_start + time*self%x_end
      if (self%n_legs == 1 .or. time <= 0 .or. time >= 1) return
      do node = 1, size(x, 2)
         if (self%reference(node) > 0) x(:, node) = in_body(self, node, time)
      end do
      do w = 1, wires%n_wires
         call put_together(self, model, wires, w, time, x)
      end do
   end function positions

   !> A node of a rigid body at a time from 0 to 1 (3) [m].
   pure function in_body(path, node, time) result(x)
      type(contact_path_t), intent(in) :: path
      !> Index of the node
      integer, intent(in) :: node
      !> 0: start of the increment, 1: its end
      real(dp), intent(in) :: time
      real(dp) :: x(3)

      associate (centre => path%reference(node))
         x = (1 - time)*path%x_start(:, centre) + time*path%x_end(:, centre) &
            + matmul(rotation_exp(time*path%turn(:, centre)), path%x_start(:, node) - path%x_start(:, centre))
      end associate
   end function in_body

   !> Put a wire together from its chords, between and beyond its nodes in rigid bodies, or from the one that moves
   !> least.
   pure subroutine put_together(path, model, wires, w, time, x)
      type(contact_path_t), intent(in) :: path
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      !> Wire
      integer, intent(in) :: w
      !> 0: start of the increment, 1: its end
      real(dp), intent(in) :: time
      !> Positions (3, n_nodes) [m]; in: nodes gone straight, or with their rigid bodies; out: those of this wire put
      !> together
      real(dp), intent(inout) :: x(:, :)
      real(dp) :: along(3, 0:wires%first(w + 1) - wires%first(w)), gap(3), before(3), part
      integer :: nodes(0:wires%first(w + 1) - wires%first(w)), j, k, n, last
      logical :: stays(0:wires%first(w + 1) - wires%first(w))

      n = wires%first(w + 1) - wires%first(w)
      along(:, 0) = 0
      do k = 1, n
         associate (e => wires%element(wires%first(w) + k - 1))
            nodes(k - 1:k) = model%connectivity(:, e)
            if (wires%direction(e) < 0) nodes(k - 1:k) = model%connectivity([2, 1], e)
            along(:, k) = along(:, k - 1) + wires%direction(e)*chord_at(path, model, e, time)
         end associate
      end do
      if (nodes(n) == nodes(0)) then
         ! a closed wire stays closed
         gap = along(:, n)
         do k = 1, n
            along(:, k) = along(:, k) - real(k, dp)/n*gap
         end do
      end if
      stays = path%reference(nodes) > 0
      if (.not. any(stays)) stays(minloc(norm2(path%x_end(:, nodes) - path%x_start(:, nodes), 1), 1) - 1) = .true.
      last = -1
      do k = 0, n
         if (.not. stays(k)) cycle
         gap = x(:, nodes(k)) - along(:, k)
         if (last < 0) before = gap
         do j = last + 1, k - 1
            part = real(j - last, dp)/(k - last)
            x(:, nodes(j)) = along(:, j) + (1 - part)*before + part*gap
         end do
         last = k
         before = gap
      end do
      do j = last + 1, n
         x(:, nodes(j)) = along(:, j) + gap
      end do
   end subroutine put_together

   !> From the first to the second node of an element [m].
   pure function chord_at(path, model, e, time) result(chord)
      type(contact_path_t), intent(in) :: path
      type(model_t), intent(in) :: model
      !> Element
      integer, intent(in) :: e
      !> 0: start of the increment, 1: its end
      real(dp), intent(in) :: time
      real(dp) :: chord(3), before(3), after(3)

      associate (nodes => model%connectivity(:, e))
         before = path%x_start(:, nodes(2)) - path%x_start(:, nodes(1))
         after = path%x_end(:, nodes(2)) - path%x_end(:, nodes(1))
      end associate
      chord = matmul(rotation_exp(time*path%chord_turn(:, e)), before)*(1 + time*(norm2(after)/norm2(before) - 1))
      chord = matmul(rotation_exp(time*path%chord_rest(:, e)), chord)
   end function chord_at

   !> Rotations of all nodes from the reference at a time from 0 to 1 (3, 3, n_nodes).
   pure function rotations(self, time) result(rotation)
      class(contact_path_t), intent(in) :: self
      !> 0: start of the increment, 1: its end
      real(dp), intent(in) :: time
      real(dp) :: rotation(3, 3, size(self%x_start, 2))
      integer :: node

      do node = 1, size(rotation, 3)
         rotation(:, :, node) = matmul(rotation_exp(time*self%turn(:, node)), self%rotation_start(:, :, node))
      end do
   end function rotations

end module litz_contact_path
