!> Where a contact is along its wires, as seen from their ends, and how that changes with the 24 mechanical unknowns.
!>
!> Of a wire along which the contact moves it is the distance to the end, `p = (end - xi) L0/2`; of one at whose end it
!> is held, `p = w.tau`, the projection of the line to the other wire on the way from the end into its own wire, which
!> is minus the distance times the slope with which the distance grows. What acts along the wires are the forces
!> `lambda = dPi/dp`, so that rows `dp` and the matrix `lambda d2p` are what residual and tangent need.
!>
!> Source: theory section 10. At fixed places `dw = S dp`, `dx' = S1 dp`; moved along by `dxi` and `dxib`, `dw = S dp
!> - x'
!> dxi + xb' dxib` and so on. The conditions `F = (-w.x', w.xb') = 0` of the places that move, differentiated twice,
!> give `d2xi = -M^-1 D2F`, where `D2` is the second derivative along `dxi` and `dxib`.
module litz_end_places
   use litz_kinds, only: dp
   use litz_axis, only: axis_shape, axis_third_derivative, axis_row, on_axis
   use litz_contact_kinematics, only: contact_kinematics_t
   use litz_rotations, only: cross, identity3
   implicit none
   private
   public :: place_at_end_t, place_rows, place_tangent

   !> One of the two wires, as the contact lies to its end.
   type :: place_at_end_t
      !> The place is held in the element
      logical :: held = .false.
      !> Not held: 1 where the end lies in the direction of xi, -1 where it lies against it; 0: it has none
      integer :: direction = 0
      !> Held at the end: tangent from there into the wire (3), of length 1 but for strain; 0: it is held elsewhere
      real(dp) :: inward(3) = 0
      !> Node of the four of the pair at which it is held, and whether the tangent turns with it
      integer :: node = 0
      logical :: turns = .true.
      !> One that does not is the way to this node of the pair over the reference length [m] (0: to another one, it
      !> stays)
      integer :: other_node = 0
      real(dp) :: length = 0
   end type place_at_end_t

   !> Axes, and how they change, at the places of a contact.
   type :: moving_places_t
      !> w, and derivatives of the unbarred and the barred axis by xi, first to third (3, 3) [m]
      real(dp) :: w(3) = 0, x(3, 3) = 0, xb(3, 3) = 0
      !> How w, x', xb', x'' and xb'' change at fixed places (24, 3)
      real(dp), dimension(24, 3) :: s = 0, s1 = 0, sb1 = 0, s2 = 0, sb2 = 0
      !> How much of each nodal tangent is in w, x' and xb' (4) [m]
      real(dp), dimension(4) :: in_w = 0, in_x1 = 0, in_xb1 = 0
   end type moving_places_t

contains

   !> How both places change, `dp` (24, 2).
   pure function place_rows(x, t, length, axis, kinematics, ends) result(rows)
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer, intent(in) :: axis
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Of the barred, of the unbarred wire
      type(place_at_end_t), intent(in) :: ends(2)
      real(dp) :: rows(24, 2)
      type(moving_places_t) :: at
      real(dp) :: move(24, 2)
      integer :: i

      at = moving_places(x, t, length, axis, kinematics)
      move = moves_of(kinematics)
      rows = 0
      do i = 1, 2
         if (.not. ends(i)%held) then
            rows(:, i) = -ends(i)%direction*length(i)/2*move(:, i)
         else if (norm2(ends(i)%inward) > 0) then
            rows(:, i) = facing(i)*(matmul(total_of_w(at, move), ends(i)%inward) &
               + matmul(rows_of_tangent(ends(i)), at%w))
         end if
      end do
   end function place_rows

   !> `sum lambda d2p` as a matrix over the unknowns (24, 24), for rotation vectors of the increment at zero.
   pure function place_tangent(x, t, length, axis, kinematics, ends, force) result(tangent)
      !> Nodal positions [m] and unit tangents (3, 4)
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer, intent(in) :: axis
      type(contact_kinematics_t), intent(in) :: kinematics
      type(place_at_end_t), intent(in) :: ends(2)
      !> lambda (2) [N]
      real(dp), intent(in) :: force(2)
      real(dp) :: tangent(24, 24)
      type(moving_places_t) :: at
      real(dp) :: half(24, 24), move(24, 2), dw(24, 3), multiplier(2), along(3), lambda
      integer :: i

      at = moving_places(x, t, length, axis, kinematics)
      move = moves_of(kinematics)
      dw = total_of_w(at, move)
      multiplier = multipliers(at, length, ends, force)
      ! what is multiplied by D2w
      along = multiplier(1)*at%xb(:, 1) - multiplier(2)*at%x(:, 1)
      half = multiplier(1)*half_of_axis(at%w, dw, at%sb1, at%sb2, at%xb, move(:, 1)) &
         - multiplier(2)*half_of_axis(at%w, dw, at%s1, at%s2, at%x, move(:, 2))
      tangent = 0
      call add_turning(t, at%w, multiplier(1)*at%in_xb1 - multiplier(2)*at%in_x1, tangent)
      do i = 1, 2
         if (.not. ends(i)%held .or. .not. norm2(ends(i)%inward) > 0) cycle
         lambda = force(i)*facing(i)
         along = along + lambda*ends(i)%inward
         half = half + lambda*matmul(dw, transpose(rows_of_tangent(ends(i))))
         if (ends(i)%turns) call add_turning(spread(ends(i)%inward, 2, 4), at%w, lambda*unit(ends(i)%node), tangent)
      end do
      half = half + outer(matmul(at%sb1, along), move(:, 1)) - outer(matmul(at%s1, along), move(:, 2)) &
         + dot_product(along, at%xb(:, 2))/2*outer(move(:, 1), move(:, 1)) &
         - dot_product(along, at%x(:, 2))/2*outer(move(:, 2), move(:, 2))
      call add_turning(t, along, at%in_w, tangent)
      tangent = tangent + half + transpose(half)
   end function place_tangent

   !> The line from this wire to the other one, in terms of w: `-w` of the barred, `w` of the unbarred one.
   pure integer function facing(i)
      !> 1: barred, 2: unbarred
      integer, intent(in) :: i

      facing = 2*i - 3
   end function facing

   !> How the places move (24, 2): barred, unbarred.
   pure function moves_of(kinematics) result(move)
      type(contact_kinematics_t), intent(in) :: kinematics
      real(dp) :: move(24, 2)

      move(:, 1) = kinematics%rows%dxi_bar
      move(:, 2) = kinematics%rows%dxi
   end function moves_of

   pure type(moving_places_t) function moving_places(x, t, length, axis, kinematics) result(at)
      !> Nodal positions [m] and unit tangents (3, 4)
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer, intent(in) :: axis
      type(contact_kinematics_t), intent(in) :: kinematics
      real(dp), dimension(4) :: h, h1, h2, hb, hb1, hb2
      real(dp) :: e(3)
      integer :: j

      call axis_shape(axis, length(2), kinematics%xi, h, h1, h2)
      call axis_shape(axis, length(1), kinematics%xi_bar, hb, hb1, hb2)
      at%w = kinematics%point_bar - kinematics%point
      at%x(:, 1) = on_axis(h1, x(:, 3:4), t(:, 3:4))
      at%x(:, 2) = on_axis(h2, x(:, 3:4), t(:, 3:4))
      at%x(:, 3) = on_axis(axis_third_derivative(axis, length(2)), x(:, 3:4), t(:, 3:4))
      at%xb(:, 1) = on_axis(hb1, x(:, 1:2), t(:, 1:2))
      at%xb(:, 2) = on_axis(hb2, x(:, 1:2), t(:, 1:2))
      at%xb(:, 3) = on_axis(axis_third_derivative(axis, length(1)), x(:, 1:2), t(:, 1:2))
      do j = 1, 3
         e = identity3(:, j)
         at%s(1:12, j) = axis_row(hb, t(:, 1:2), e)
         at%s(13:24, j) = axis_row(h, t(:, 3:4), -e)
         at%s1(13:24, j) = axis_row(h1, t(:, 3:4), e)
         at%s2(13:24, j) = axis_row(h2, t(:, 3:4), e)
         at%sb1(1:12, j) = axis_row(hb1, t(:, 1:2), e)
         at%sb2(1:12, j) = axis_row(hb2, t(:, 1:2), e)
      end do
      at%in_w = [hb(2), hb(4), -h(2), -h(4)]
      at%in_x1(3:4) = h1([2, 4])
      at%in_xb1(1:2) = hb1([2, 4])
   end function moving_places

   !> How w changes along with the places (24, 3).
   pure function total_of_w(at, move) result(dw)
      type(moving_places_t), intent(in) :: at
      !> (24, 2)
      real(dp), intent(in) :: move(24, 2)
      real(dp) :: dw(24, 3)

      dw = at%s + outer(move(:, 1), at%xb(:, 1)) - outer(move(:, 2), at%x(:, 1))
   end function total_of_w

   !> How the tangent at an end changes (24, 3).
   pure function rows_of_tangent(end) result(rows)
      type(place_at_end_t), intent(in) :: end
      real(dp) :: rows(24, 3)
      integer :: j

      rows = 0
      do j = 1, 3
         if (end%turns) then
            rows(6*end%node - 2:6*end%node, j) = cross(end%inward, identity3(:, j))
         else if (end%other_node > 0) then
            rows(6*end%other_node - 6 + j, j) = 1/end%length
            rows(6*end%node - 6 + j, j) = -1/end%length
         end if
      end do
   end function rows_of_tangent

   !> What multiplies the second derivatives of `w.xb'` and `-w.x'`, which are zero where the places move: -M^-1 of what
   !> multiplies d2xib and d2xi (2).
   pure function multipliers(at, length, ends, force) result(multiplier)
      type(moving_places_t), intent(in) :: at
      !> Reference lengths (2) [m]
      real(dp), intent(in) :: length(2)
      type(place_at_end_t), intent(in) :: ends(2)
      !> lambda (2) [N]
      real(dp), intent(in) :: force(2)
      real(dp) :: multiplier(2), of_move(2), m(2, 2), determinant

      of_move = 0
      if (.not. ends(1)%held) of_move(1) = -ends(1)%direction*length(1)/2*force(1) &
         + force(2)*dot_product(ends(2)%inward, at%xb(:, 1))
      if (.not. ends(2)%held) of_move(2) = -ends(2)%direction*length(2)/2*force(2) &
         + force(1)*dot_product(ends(1)%inward, at%x(:, 1))
      m(1, 1) = dot_product(at%xb(:, 1), at%xb(:, 1)) + dot_product(at%w, at%xb(:, 2))
      m(2, 2) = dot_product(at%x(:, 1), at%x(:, 1)) - dot_product(at%w, at%x(:, 2))
      m(1, 2) = -dot_product(at%x(:, 1), at%xb(:, 1))
      if (any(ends%held)) m(1, 2) = 0
      multiplier = 0
      if (.not. any(ends%held)) then
         determinant = m(1, 1)*m(2, 2) - m(1, 2)**2
         multiplier = -[m(2, 2)*of_move(1) - m(1, 2)*of_move(2), m(1, 1)*of_move(2) - m(1, 2)*of_move(1)]/determinant
      else if (.not. ends(1)%held) then
         multiplier(1) = -of_move(1)/m(1, 1)
      else if (.not. ends(2)%held) then
         multiplier(2) = -of_move(2)/m(2, 2)
      end if
   end function multipliers

   !> Half of what an axis has in the second derivative of `w.x'`, but for the turning of tangents and D2w.
   pure function half_of_axis(w, dw, s1, s2, x, move) result(half)
      !> w (3) [m], how it changes (24, 3), and how x' and x'' do at fixed places (24, 3)
      real(dp), intent(in) :: w(3), dw(24, 3), s1(24, 3), s2(24, 3)
      !> Derivatives of the axis (3, 3) [m], and how the place moves (24)
      real(dp), intent(in) :: x(3, 3), move(24)
      real(dp) :: half(24, 24)

      half = matmul(dw, transpose(s1 + outer(move, x(:, 2)))) + outer(matmul(s2, w), move) &
         + dot_product(w, x(:, 3))/2*outer(move, move)
   end function half_of_axis

   !> Add the second derivatives of nodal tangents, times a fixed vector: `(t v^T + v t^T)/2 - (t.v) 1`.
   pure subroutine add_turning(t, v, weight, tangent)
      !> Unit tangents of the nodes (3, 4), the vector (3), and how much of each tangent there is (4)
      real(dp), intent(in) :: t(3, 4), v(3), weight(4)
      !> (24, 24)
      real(dp), intent(inout) :: tangent(24, 24)
      real(dp) :: block(3, 3)
      integer :: node, i

      do node = 1, 4
         block = outer(t(:, node), v)
         block = weight(node)*((block + transpose(block))/2 - dot_product(t(:, node), v)*identity3)
         i = 6*node - 2
         tangent(i:i + 2, i:i + 2) = tangent(i:i + 2, i:i + 2) + block
      end do
   end subroutine add_turning

   !> 1 for one of the four nodes.
   pure function unit(node)
      !> Its number
      integer, intent(in) :: node
      real(dp) :: unit(4)

      unit = 0
      unit(node) = 1
   end function unit

   pure function outer(a, b) result(c)
      !> Two rows (any)
      real(dp), intent(in) :: a(:), b(:)
      real(dp) :: c(size(a), size(b))

      c = spread(a, 2, size(b))*spread(b, 1, size(a))
   end function outer

end module litz_end_places
