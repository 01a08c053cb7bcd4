!> Gap, normal and angle of a pair of axes at their closest points, and how they change with the 24 mechanical unknowns.
!>
!> Source: theory section 4. The unknowns are the displacements and the spins of the nodes barred 1, barred 2, 1, 2:
!> `ux uy uz phix phiy phiz` each. A nodal tangent turns with its node, `delta t = dtheta x t`, so that
!> `v . (s delta t) = s (t x v) . dtheta`: this is how each row below comes by its rotation entries.
!>
!> With `w = xb - x` and `T = [-x', xb']`, the closest points fulfil `T^T w = 0`. Rows over the unknowns `p`:
!> `B = T^T S` (how `w` changes along the tangents), `Q = [-n^T S1; n^T Sb1]` (how the tangents change along `n`), where
!> `S dp = dw`, `S1 dp = dx'`, `Sb1 dp = dxb'` at fixed xi. Matrices in (xi, xib): `G = T^T T`,
!> `H = diag(-n.x'', n.xb'')` and `M = G + d H`, `d` the distance. Linearised: `M dxi = -(B + d Q) dp`.
!>
!> The second variation of the gap, `d2g = (S^T Pn S - C^T M^-1 C)/d` with `C = B + d Q`, is formed with
!> `S^T Pn S = B^T G^-1 B` and `(G^-1 - M^-1)/d = G^-1 H M^-1` as
!> `d2g = B^T (G^-1 H M^-1) B - Q^T M^-1 B - B^T M^-1 Q - d Q^T M^-1 Q`, which has no division by the distance and so
!> holds also where the axes meet or have passed each other. It has rank 4.
!>
!> Where the tangents are parallel (bent wires that touch along their common plane), `x' x xb'` gives no normal and `G`
!> no inverse. The normal is then that of `w` itself, and with `E = [e1 e2]` perpendicular to it, `A = T^T E` and
!> `C = A E^T S + d Q` the second variation is, with `B = E^T S`,
!> `d2g = B^T ((1 - A^T M^-1 A)/d) B - B^T (A^T M^-1) Q - Q^T (M^-1 A) B - d Q^T M^-1 Q`.
module litz_contact_kinematics
   use litz_kinds, only: dp
   use litz_rotations, only: cross
   use litz_axis, only: axis_shape, on_axis, axis_row
   use litz_closest_points, only: parallel_sine
   implicit none
   private
   public :: contact_kinematics_t, contact_kinematics, fix_angle, n_motions
   public :: kinematics_ok, kinematics_parallel, kinematics_singular

   integer, parameter :: kinematics_ok = 0
   !> The sine of the crossing angle is below `parallel_sine` of litz_closest_points and the axes are too near to each
   !> other to have a normal
   integer, parameter :: kinematics_parallel = -1
   !> The distance has no strict minimum at the given points: a slight move would send them anywhere
   integer, parameter :: kinematics_singular = -2

   !> Parallel axes that are nearer to each other than this part of the sum of the radii have no normal
   real(dp), parameter :: least_distance = 0.1_dp

   !> Displacements and rotations of the four nodes of a pair of elements
   integer, parameter :: n_motions = 24

   !> Rows over the unknowns that only a contact needs that presses or conducts: wires side by side have many more
   !> places that are near and open.
   type :: kinematics_rows_t
      real(dp) :: dxi_bar(24) = 0, dxi(24) = 0, dcos_angle(24) = 0, dangle(24) = 0
      !> B and Q
      real(dp) :: b(24, 2) = 0, q(24, 2) = 0
   end type kinematics_rows_t

   type :: contact_kinematics_t
      !> Where it was evaluated
      real(dp) :: xi_bar = 0, xi = 0
      !> Axis points of the barred and the unbarred wire (3) [m]
      real(dp) :: point_bar(3) = 0, point(3) = 0
      !> Unit normal, from the unbarred to the barred axis until they pass each other
      real(dp) :: normal(3) = 0
      !> d = n . (xb - x) [m], negative after the axes have passed each other; g = d - (rb + r) [m]
      real(dp) :: distance = 0, gap = 0
      !> The orientation in use, +1 or -1: to be remembered while the contact lives
      integer :: side = 0
      !> Angle between the tangents x' and xb' [rad], in (0, pi), and its cosine
      real(dp) :: angle = 0, cos_angle = 0
      !> How much of the angle is that at fixed places of the barred and the unbarred axis, and not at the closest
      !> points [-], and these places (2)
      real(dp) :: fixed_share = 0, angle_at(2) = 0
      !> First variation of the gap (24), and of all else
      real(dp) :: dgap(24) = 0
      type(kinematics_rows_t), allocatable :: rows
      !> Second variation of the gap: what is between the rows of B and Q: `G^-1 H M^-1` between B and B, `M^-1` between
      !> B and Q and between Q and Q, in the order (xi, xib)
      real(dp) :: between_b(2, 2) = 0, between_bq(2, 2) = 0, between_q(2, 2) = 0
      !> `|x'|^2` and `|xb'|^2` (2) [m^2]
      real(dp) :: squares(2) = 0
      !> How much of each nodal tangent is in w (barred 1, barred 2, 1, 2) [m]
      real(dp) :: tangent_weight(4) = 0
   end type contact_kinematics_t

contains

   !> Everything at given closest points.
   pure subroutine contact_kinematics(x, t, length, axis, radius, xi_bar, xi, side, kinematics, info)
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer, intent(in) :: axis
      !> Radii (2) [m]: barred, unbarred
      real(dp), intent(in) :: radius(2)
      !> The closest points, from `closest_points`
      real(dp), intent(in) :: xi_bar, xi
      !> +1 or -1: sign of `w . (x' x xb')` when the contact began, which keeps the sign of the gap when the axes pass
      !> each other; 0: the present sign (+1 where the axes meet exactly)
      integer, intent(in) :: side
      type(contact_kinematics_t), intent(out) :: kinematics
      !> One of the constants above; `kinematics` is complete only with `kinematics_ok`
      integer, intent(out) :: info
      real(dp), dimension(4) :: h, h1, h2, hb, hb1, hb2
      real(dp), dimension(3) :: w, x1, x2, xb1, xb2, n
      real(dp) :: sine, g(2, 2), curvature(2), m(2, 2), relative(3, 4)
      logical :: is_parallel
      integer :: i

      allocate (kinematics%rows)
      call axis_shape(axis, length(2), xi, h, h1, h2)
      call axis_shape(axis, length(1), xi_bar, hb, hb1, hb2)
      x1 = on_axis(h1, x(:, 3:4), t(:, 3:4))
      x2 = on_axis(h2, x(:, 3:4), t(:, 3:4))
      xb1 = on_axis(hb1, x(:, 1:2), t(:, 1:2))
      xb2 = on_axis(hb2, x(:, 1:2), t(:, 1:2))
      ! measured from one node, so that the distance does not suffer from far-away origins
      do i = 1, 4
         relative(:, i) = x(:, i) - x(:, 3)
      end do
      w = on_axis(hb, relative(:, 1:2), t(:, 1:2)) - on_axis(h, relative(:, 3:4), t(:, 3:4))

      n = cross(x1, xb1)
      sine = norm2(n)
      kinematics%xi_bar = xi_bar
      kinematics%xi = xi
      kinematics%point = on_axis(h, x(:, 3:4), t(:, 3:4))
      kinematics%point_bar = kinematics%point + w
      kinematics%angle = atan2(sine, dot_product(x1, xb1))
      kinematics%cos_angle = dot_product(x1, xb1)/(norm2(x1)*norm2(xb1))
      kinematics%squares = [dot_product(x1, x1), dot_product(xb1, xb1)]
      is_parallel = .not. sine > parallel_sine*norm2(x1)*norm2(xb1)
      info = kinematics_parallel
      if (is_parallel .and. .not. norm2(w) > least_distance*sum(radius)) return

      kinematics%side = side
      if (side == 0) kinematics%side = merge(1, -1, dot_product(w, n) >= 0)
      if (is_parallel) then
         n = merge(w, -w, (kinematics%side > 0) .eqv. dot_product(w, n) >= 0)/norm2(w)
      else
         n = kinematics%side*n/sine
      end if
      kinematics%normal = n
      kinematics%distance = dot_product(w, n)                                              ! d
      kinematics%gap = kinematics%distance - sum(radius)                                   ! g = d - (rb + r)

      g(:, 1) = [dot_product(x1, x1), -dot_product(x1, xb1)]
      g(:, 2) = [-dot_product(x1, xb1), dot_product(xb1, xb1)]                             ! G = T^T T
      curvature = [-dot_product(n, x2), dot_product(n, xb2)]                               ! H
      m = g
      m(1, 1) = m(1, 1) + kinematics%distance*curvature(1)
      m(2, 2) = m(2, 2) + kinematics%distance*curvature(2)                                 ! M = G + d H
      info = kinematics_singular
      if (.not. abs(m(1, 1)*m(2, 2) - m(1, 2)*m(2, 1)) > parallel_sine**2*g(1, 1)*g(2, 2)) return
      info = kinematics_ok
      kinematics%between_q = inverse(m)

      kinematics%tangent_weight = [hb(2), hb(4), -h(2), -h(4)]
      kinematics%dgap = [axis_row(hb, t(:, 1:2), n), axis_row(h, t(:, 3:4), -n)]            ! dg = n^T S
      kinematics%rows%b(:, 1) = [axis_row(hb, t(:, 1:2), -x1), axis_row(h, t(:, 3:4), x1)]       ! B
      kinematics%rows%b(:, 2) = [axis_row(hb, t(:, 1:2), xb1), axis_row(h, t(:, 3:4), -xb1)]
      kinematics%rows%q(13:24, 1) = axis_row(h1, t(:, 3:4), -n)                                 ! Q
      kinematics%rows%q(1:12, 2) = axis_row(hb1, t(:, 1:2), n)
      call add_moves(kinematics)
      call add_angle(kinematics, t, x1, x2, xb1, xb2, h1, hb1)
      if (is_parallel) then
         call span_by_directions(h, hb, t, x1, xb1, kinematics)
      else
         call span_by_tangents(inverse(g), curvature, kinematics)
      end if
   end subroutine contact_kinematics

   !> The second variation by the rows of B: regular as long as the wires cross.
   pure subroutine span_by_tangents(g_inverse, curvature, kinematics)
      !> `G^-1` (2, 2) [1/m^2] and the diagonal of `H` (2) [m]
      real(dp), intent(in) :: g_inverse(2, 2), curvature(2)
      !> With B, Q and `M^-1`
      type(contact_kinematics_t), intent(inout) :: kinematics
      integer :: i

      do i = 1, 2
         kinematics%between_b(:, i) = matmul(g_inverse, curvature*kinematics%between_q(:, i))
      end do
      kinematics%between_bq = kinematics%between_q
   end subroutine span_by_tangents

   !> The second variation by two directions perpendicular to the normal: regular as long as the axes are apart.
   pure subroutine span_by_directions(h, hb, t, x1, xb1, kinematics)
      !> Shape functions (4): unbarred, barred
      real(dp), dimension(4), intent(in) :: h, hb
      !> Unit tangents of the nodes (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: t(3, 4)
      !> Derivatives of the axes by xi (3) [m]
      real(dp), dimension(3), intent(in) :: x1, xb1
      !> With Q and `M^-1`
      type(contact_kinematics_t), intent(inout) :: kinematics
      real(dp) :: e(3, 2), a(2, 2)
      integer :: i

      e(:, 1) = xb1/norm2(xb1)
      e(:, 2) = cross(kinematics%normal, e(:, 1))
      a = reshape([-dot_product(x1, e(:, 1)), dot_product(xb1, e(:, 1)), -dot_product(x1, e(:, 2)), 0.0_dp], [2, 2])
      do i = 1, 2
         kinematics%rows%b(:, i) = [axis_row(hb, t(:, 1:2), e(:, i)), axis_row(h, t(:, 3:4), -e(:, i))]
      end do
      kinematics%between_bq = matmul(transpose(a), kinematics%between_q)                   ! A^T M^-1
      kinematics%between_b = -matmul(kinematics%between_bq, a)
      do i = 1, 2
         kinematics%between_b(i, i) = kinematics%between_b(i, i) + 1
      end do
      kinematics%between_b = kinematics%between_b/kinematics%distance                      ! (1 - A^T M^-1 A)/d
   end subroutine span_by_directions

   !> How the closest points move: `dxi = -M^-1 (B + d Q)`.
   pure subroutine add_moves(kinematics)
      !> With B over the tangents, Q and `M^-1`
      type(contact_kinematics_t), intent(inout) :: kinematics
      real(dp) :: c(24, 2)

      c = kinematics%rows%b + kinematics%distance*kinematics%rows%q
      associate (m_inverse => kinematics%between_q)
         kinematics%rows%dxi = -m_inverse(1, 1)*c(:, 1) - m_inverse(1, 2)*c(:, 2)
         kinematics%rows%dxi_bar = -m_inverse(2, 1)*c(:, 1) - m_inverse(2, 2)*c(:, 2)
      end associate
   end subroutine add_moves

   !> A mean of the angle at the closest points and of that at places that stay while these move.
   pure subroutine fix_angle(x, t, length, axis, places, share, kinematics)
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer, intent(in) :: axis
      !> In the barred and the unbarred element (2)
      real(dp), intent(in) :: places(2)
      !> Of the angle there [-]
      real(dp), intent(in) :: share
      type(contact_kinematics_t), intent(inout) :: kinematics
      real(dp), dimension(4) :: h, h1, h2, hb, hb1, hb2
      real(dp), dimension(3) :: x1, xb1
      real(dp) :: angle, dangle(n_motions)

      call axis_shape(axis, length(2), places(2), h, h1, h2)
      call axis_shape(axis, length(1), places(1), hb, hb1, hb2)
      x1 = on_axis(h1, x(:, 3:4), t(:, 3:4))
      xb1 = on_axis(hb1, x(:, 1:2), t(:, 1:2))
      kinematics%fixed_share = share
      kinematics%angle_at = places
      angle = kinematics%angle
      dangle = kinematics%rows%dangle
      kinematics%angle = atan2(norm2(cross(x1, xb1)), dot_product(x1, xb1))
      kinematics%cos_angle = cos(kinematics%angle)
      kinematics%rows%dangle = 0
      call add_angle(kinematics, t, x1, 0*x1, xb1, 0*xb1, h1, hb1)
      kinematics%angle = (1 - share)*angle + share*kinematics%angle
      kinematics%rows%dangle = (1 - share)*dangle + share*kinematics%rows%dangle
      kinematics%cos_angle = cos(kinematics%angle)
      kinematics%rows%dcos_angle = -sin(kinematics%angle)*kinematics%rows%dangle
   end subroutine fix_angle

   !> How the angle changes: through the unit tangents `e`, by the nodes and by the move of the closest points.
   pure subroutine add_angle(kinematics, t, x1, x2, xb1, xb2, h1, hb1)
      type(contact_kinematics_t), intent(inout) :: kinematics
      !> Unit tangents of the nodes (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: t(3, 4)
      !> First and second derivatives of the unbarred and of the barred axis by xi [m]
      real(dp), dimension(3), intent(in) :: x1, x2, xb1, xb2
      !> First derivatives of the shape functions (4): unbarred, barred
      real(dp), dimension(4), intent(in) :: h1, hb1
      real(dp), dimension(3) :: e, eb, v, vb

      e = x1/norm2(x1)
      eb = xb1/norm2(xb1)
      v = (eb - kinematics%cos_angle*e)/norm2(x1)                                          ! dcos/dx'
      vb = (e - kinematics%cos_angle*eb)/norm2(xb1)                                        ! dcos/dxb'
      kinematics%rows%dcos_angle = dot_product(v, x2)*kinematics%rows%dxi + dot_product(vb, xb2)*kinematics%rows%dxi_bar
      kinematics%rows%dcos_angle(1:12) = kinematics%rows%dcos_angle(1:12) + axis_row(hb1, t(:, 1:2), vb)
      kinematics%rows%dcos_angle(13:24) = kinematics%rows%dcos_angle(13:24) + axis_row(h1, t(:, 3:4), v)
      ! of parallel tangents the angle is stationary
      associate (rows => kinematics%rows)
         if (sin(kinematics%angle) > parallel_sine) rows%dangle = -rows%dcos_angle/sin(kinematics%angle)
      end associate
   end subroutine add_angle

   pure function inverse(a) result(b)
      !> Regular matrix
      real(dp), intent(in) :: a(2, 2)
      real(dp) :: b(2, 2)

      b(:, 1) = [a(2, 2), -a(2, 1)]
      b(:, 2) = [-a(1, 2), a(1, 1)]
      b = b/(a(1, 1)*a(2, 2) - a(1, 2)*a(2, 1))
   end function inverse

end module litz_contact_kinematics
