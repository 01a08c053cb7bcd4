!> Forces on the length of a two-node beam, as forces and moments on its nodes.
!>
!> The axis between the nodes is that of litz_axis: straight, or Hermite's cubic through the nodes along their tangents
!> `t`. A force `f` per reference length does the work `f . delta x` along it, which gives every node its share
!>
!>     F_a = L0 int h_a f,    M_a = L0 t_a x int g_a f,    `h` and `g` the weights of positions and tangents    (1)
!>
!> A force that turns with the sections, `f = p1 n1 + p2 n2`, is quadratic between its values at the nodes and in the
!> middle, where the section is that of the mid triad of litz_beam_kinematics, turned by the shortest way so that it is
!> normal to a cubic axis. A force in a magnetic field is `I x' x B(x)` per unit of the parameter of the axis, with the
!> current `I` of the element.                                                                                     (2)
!>
!> Residuals are internal forces, minus those of the load. Tangents have the Hessian form: the derivative of the forces
!> of spins, and half the skew matrix of each nodal moment (theory section 3). Source: theory section 16.
module litz_line_forces
   use litz_kinds, only: dp
   use litz_axis, only: axis_shape, axis_row, on_axis
   use litz_axis_choices, only: axis_hermite
   use litz_beam_kinematics, only: chord_rotation, chord_rotation_t
   use litz_rotations, only: cross, identity3, skew
   implicit none
   private
   public :: distributed_force, lorentz_force

   !> Integrals of the weights of positions times the parabolas that are one at the first node, in the middle and at the
   !> second node (3, node), over the reference length; straight axis and cubic one
   real(dp), parameter :: linear_weight(3, 2) = reshape([1.0_dp, 2.0_dp, 0.0_dp, 0.0_dp, 2.0_dp, 1.0_dp], [3, 2])/6
   real(dp), parameter :: cubic_weight(3, 2) = reshape([11.0_dp, 20.0_dp, -1.0_dp, -1.0_dp, 20.0_dp, 11.0_dp], &
      [3, 2])/60
   !> The same of the weights of tangents, over the square of the reference length
   real(dp), parameter :: cubic_arm(3, 2) = reshape([1.0_dp, 4.0_dp, 0.0_dp, 0.0_dp, -4.0_dp, -1.0_dp], [3, 2])/60

   !> Gauss's rule of five points, exact for a cubic axis in a field that is linear
   integer, parameter :: n_points = 5
   real(dp), parameter :: inner = sqrt(5 - 2*sqrt(10.0_dp/7))/3, outer = sqrt(5 + 2*sqrt(10.0_dp/7))/3
   real(dp), parameter :: point(n_points) = [-outer, -inner, 0.0_dp, inner, outer]
   real(dp), parameter :: heavy = (322 + 13*sqrt(70.0_dp))/900, light = (322 - 13*sqrt(70.0_dp))/900
   real(dp), parameter :: point_weight(n_points) = [light, heavy, 128.0_dp/225, heavy, light]

contains

   !> Forces of fixed direction, and forces that turn with the sections. Source: (1).
   pure subroutine distributed_force(axis, x, triads, length, fixed, turning, k, r)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer, intent(in) :: axis
      !> Nodal positions (3, node) [m]
      real(dp), intent(in) :: x(3, 2)
      !> Nodal triads (3, axis, node), axes: tangent, first, second section axis
      real(dp), intent(in) :: triads(3, 3, 2)
      !> Reference length [m]
      real(dp), intent(in) :: length
      !> Force per reference length along the global axes, and along the first and second section axis [N/m]
      real(dp), intent(in) :: fixed(3), turning(2)
      !> Tangent in the Hessian form (12, 12) [N/m, N, N m]; symmetric where nothing turns
      real(dp), intent(out) :: k(12, 12)
      !> Internal forces and moments (12) [N, N m]
      real(dp), intent(out) :: r(12)
      type(chord_rotation_t) :: q
      real(dp) :: force(3, 3), slopes(3, 12, 3), weight(3, 2), arm(3, 2), lever(3)
      integer :: node, place

      weight = merge(cubic_weight, linear_weight, axis == axis_hermite)
      arm = merge(length*cubic_arm, 0.0_dp, axis == axis_hermite)
      q = chord_rotation(x, triads, length)
      force(:, 1) = matmul(triads(:, 2:3, 1), turning)
      force(:, 2) = matmul(q%mid(:, 2:3), turning)
      force(:, 3) = matmul(triads(:, 2:3, 2), turning)
      slopes = forces_by_spins(q, force)
      if (axis == axis_hermite) call turn_to_axis(x, triads(:, 1, :), q, force(:, 2), slopes(:, :, 2))
      force = force + spread(fixed, 2, 3)

      k = 0
      do node = 1, 2
         associate (t => triads(:, 1, node), first => 6*node - 5)
            lever = matmul(force, arm(:, node))
            r(first:first + 2) = -length*matmul(force, weight(:, node))
            r(first + 3:first + 5) = -length*cross(t, lever)
            do place = 1, 3
               associate (slope => length*slopes(:, :, place))
                  k(first:first + 2, :) = k(first:first + 2, :) - weight(place, node)*slope
                  k(first + 3:first + 5, :) = k(first + 3:first + 5, :) - arm(place, node)*matmul(skew(t), slope)
               end associate
            end do
            k(first + 3:first + 5, first + 3:first + 5) = k(first + 3:first + 5, first + 3:first + 5) &
               - length*matmul(skew(lever), skew(t)) + skew(r(first + 3:first + 5))/2
         end associate
      end do
   end subroutine distributed_force

   !> How forces turn: `delta f = omega x f` with the spins of the nodes and of the mid triad, which is
   !> `(delta1 + delta2)/2 - (w/2) psi x (delta2 - delta1)`. Source: litz_beam_kinematics (5).
   pure function forces_by_spins(q, force) result(slopes)
      type(chord_rotation_t), intent(in) :: q
      !> At the first node, in the mid triad, and at the second node (3, place) [N/m]
      real(dp), intent(in) :: force(3, 3)
      !> Derivatives by displacements and spins of the nodes (3, 12, place)
      real(dp) :: slopes(3, 12, 3)
      real(dp) :: half_turn(3, 3)

      half_turn = q%w/2*skew(q%turn)
      slopes = 0
      slopes(:, 4:6, 1) = -skew(force(:, 1))
      slopes(:, 4:6, 2) = -matmul(skew(force(:, 2)), identity3/2 + half_turn)
      slopes(:, 10:12, 2) = -matmul(skew(force(:, 2)), identity3/2 - half_turn)
      slopes(:, 10:12, 3) = -skew(force(:, 3))
   end function forces_by_spins

   !> Turn a force in the mid triad as its tangent `a` turns into the direction `e` of a cubic axis in the middle:
   !> `f - c (a + e)`, `c = (e . f)/(1 + a . e)`. Source: theory (16.2).
   pure subroutine turn_to_axis(x, t, q, force, slope)
      !> Nodal positions [m] and unit tangents (3, node)
      real(dp), intent(in) :: x(3, 2), t(3, 2)
      type(chord_rotation_t), intent(in) :: q
      !> Along the section axes of the mid triad; turned (3) [N/m]
      real(dp), intent(inout) :: force(3)
      !> Its derivatives by displacements and spins of the nodes (3, 12)
      real(dp), intent(inout) :: slope(3, 12)
      real(dp) :: h(4), h1(4), h2(4), e(3), along, c, dc(12), da(3, 12), de(3, 12), tangents(3, 12, 3)

      call axis_shape(axis_hermite, q%length, 0.0_dp, h, h1, h2)
      e = on_axis(h1, x, t)
      along = norm2(e)
      e = e/along
      de = axis_matrix(h1, t)/along
      de = de - spread(e, 2, 12)*spread(matmul(e, de), 1, 3)
      associate (a => q%mid(:, 1))
         tangents = forces_by_spins(q, spread(a, 2, 3))
         da = tangents(:, :, 2)
         c = dot_product(e, force)/(1 + dot_product(a, e))
         dc = (matmul(force, de) + matmul(e, slope) - c*(matmul(e, da) + matmul(a, de)))/(1 + dot_product(a, e))
         slope = slope - spread(a + e, 2, 12)*spread(dc, 1, 3) - c*(da + de)
         force = force - c*(a + e)
      end associate
   end subroutine turn_to_axis

   !> Forces on a current in a magnetic field that is linear in the position. Source: (2).
   pure subroutine lorentz_force(axis, x, t, length, current, field, gradient, k, r, by_current)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer, intent(in) :: axis
      !> Nodal positions [m] and unit tangents (3, node)
      real(dp), intent(in) :: x(3, 2), t(3, 2)
      !> Reference length [m], and current from the first to the second node [A]
      real(dp), intent(in) :: length, current
      !> Flux density at the origin (3) [N/(A m)], and its derivatives (component, coordinate) [N/(A m^2)]
      real(dp), intent(in) :: field(3), gradient(3, 3)
      !> Tangent in the Hessian form at a constant current (12, 12) [N/m, N, N m]
      real(dp), intent(out) :: k(12, 12)
      !> Internal forces and moments (12) [N, N m], and their derivative by the current (12) [N/A, N m/A]
      real(dp), intent(out) :: r(12), by_current(12)
      real(dp) :: h(4), h1(4), h2(4), along(3), b(3), force(3), place(3, 12), slope(3, 12), df(3, 12)
      integer :: i, node

      k = 0
      by_current = 0
      do i = 1, n_points
         call axis_shape(axis, length, point(i), h, h1, h2)
         along = on_axis(h1, x, t)
         b = field + matmul(gradient, on_axis(h, x, t))
         force = point_weight(i)*cross(along, b)
         by_current = by_current - axis_row(h, t, force)

         place = axis_matrix(h, t)
         slope = axis_matrix(h1, t)
         df = point_weight(i)*(matmul(skew(along), matmul(gradient, place)) - matmul(skew(b), slope))
         k = k - current*matmul(transpose(place), df)
         do node = 1, 2
            ! the tangent in the moment turns
            associate (rows => 6*node - 2)
               k(rows:rows + 2, rows:rows + 2) = k(rows:rows + 2, rows:rows + 2) &
                  - current*h(2*node)*matmul(skew(force), skew(t(:, node)))
            end associate
         end do
      end do
      r = current*by_current
      do node = 1, 2
         associate (rows => 6*node - 2)
            k(rows:rows + 2, rows:rows + 2) = k(rows:rows + 2, rows:rows + 2) + skew(r(rows:rows + 2))/2
         end associate
      end do
   end subroutine lorentz_force

   !> Derivative of a point of the axis, or of its derivative, by displacements and spins of the nodes.
   pure function axis_matrix(weight, t) result(d)
      !> Weights of x1, t1, x2, t2 (4), and unit tangents of the nodes (3, 2)
      real(dp), intent(in) :: weight(4), t(3, 2)
      real(dp) :: d(3, 12)

      d(:, 1:3) = weight(1)*identity3
      d(:, 4:6) = -weight(2)*skew(t(:, 1))
      d(:, 7:9) = weight(3)*identity3
      d(:, 10:12) = -weight(4)*skew(t(:, 2))
   end function axis_matrix

end module litz_line_forces
