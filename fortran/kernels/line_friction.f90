!> Friction at a point of a line contact, on the surfaces of the wires: slip since the increment began, residual and
!> exact tangent over the 24 mechanical unknowns.
!>
!> Slip in the directions `e1`, along the unbarred wire and perpendicular to the normal, and `e2 = n x e1`. The point
!> has moved along the barred wire by `moved`, and around either wire by the angle between the normal `n` and the
!> normal `n0` of the start that has turned with the section:
!> `D_k = -(moved e_k.tb + rb phi_k(Ab) + r phi_k(A))`, `phi_k(A) = atan2(e_k.A, n.A)`, `A = sum N_i R_i n0`.
!> A motion of the whole model changes nothing, and wires that roll on each other do not slip, however far they do.
!>
!> The virtual slip is that of the material surfaces at the present place,
!> `dv = dxb - dthb x (1 - m) w - dx - dth x m w`, with `w` from the axis of the unbarred to that of the barred wire
!> and `m = r/(r + rb)`, so that the two surfaces meet in one point and the forces `R = sum T_k e_k.dv` are in balance.
!> It is the change of `D` but for the overlap over the radii. Sections turn as the mean of their nodes: a cubic in its
!> place would stick where the stretch is linear.
!>
!> A point that closes within the increment has a part of this slip only, which `dslip` of the tangent is to have, too.
!>
!> Source: theory section 10.
module litz_line_friction
   use litz_kinds, only: dp
   use litz_axis, only: axis_shape, on_axis, axis_row
   use litz_axis_choices, only: axis_hermite
   use litz_closest_point_motion, only: add_turning_tangent
   use litz_contact_kinematics, only: contact_kinematics_t
   use litz_friction_law, only: friction_law_t
   use litz_rotations, only: cross, identity3, skew
   implicit none
   private
   public :: line_slip_t, line_slip, side_at, line_friction_residual, line_friction_tangent

   !> First rotation unknown of the nodes
   integer, parameter :: first(4) = [4, 10, 16, 22]

   !> The slip of a point, and how it changes with the 24 mechanical unknowns.
   type :: line_slip_t
      !> D1, D2 [m]; derivatives (24, 2)
      real(dp) :: slip(2) = 0, dslip(24, 2) = 0
      !> e1, e2 in space (3, 2)
      real(dp) :: frame(3, 2) = 0
      !> Virtual slip of the surfaces (3, 24)
      real(dp), private :: motion(3, 24) = 0
      !> How e1, e2 turn (3, 24, 2), and how the normal does (3, 24)
      real(dp), private :: turn(3, 24, 2) = 0, normal_turn(3, 24) = 0
      !> w [m], and how it changes (3, 24)
      real(dp), private :: w(3) = 0, step(3, 24) = 0
      !> Share of each node in the turning of its section, times the share of its wire in w (4), and the derivative by
      !> the place of the foot (4)
      real(dp), private :: arm(4) = 0, darm(4) = 0
      !> First derivatives of the shape functions at the foot (4)
      real(dp), private :: hb1(4) = 0
   end type line_slip_t

contains

   !> Slip since the increment began.
   pure type(line_slip_t) function line_slip(kinematics, x, t, length, radius, turned, normal_before, moved) result(s)
      !> Of the present place and foot
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths and radii (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2), radius(2)
      !> Rotations of the nodes since the increment began (3, 3, 4)
      real(dp), intent(in) :: turned(3, 3, 4)
      !> Normal when it began (3)
      real(dp), intent(in) :: normal_before(3)
      !> How far the foot has moved since in the direction of xib, of the length before loading [m]
      real(dp), intent(in) :: moved
      real(dp), dimension(4) :: h, h1, h2, hb, hb2
      real(dp) :: dx1(3, 24), tangent(3), dtangent(3, 24)
      integer :: i

      call axis_shape(axis_hermite, length(2), kinematics%xi, h, h1, h2)
      call axis_shape(axis_hermite, length(1), kinematics%xi_bar, hb, s%hb1, hb2)
      s%w = kinematics%distance*kinematics%normal
      tangent = on_axis(s%hb1, x(:, 1:2), t(:, 1:2))
      dx1 = 0
      do i = 1, 3
         s%motion(i, :) = [axis_row(hb, t(:, 1:2), identity3(:, i)), axis_row(h, t(:, 3:4), -identity3(:, i))]
         s%step(i, :) = s%motion(i, :) + tangent(i)*kinematics%dxi_bar
         dx1(i, 13:24) = axis_row(h1, t(:, 3:4), identity3(:, i))
         dtangent(i, 1:12) = axis_row(s%hb1, t(:, 1:2), identity3(:, i))
         dtangent(i, 13:24) = 0
      end do
      dtangent = dtangent + outer(on_axis(hb2, x(:, 1:2), t(:, 1:2)), kinematics%dxi_bar)
      call add_arms(kinematics, radius, s)
      call add_frame(kinematics%normal, kinematics%distance, on_axis(h1, x(:, 3:4), t(:, 3:4)), dx1, s)
      call add_path_of_foot(moved, 2/length(1), tangent, dtangent, kinematics%dxi_bar, s)
      call add_path_around(kinematics, 0, radius(1), turned(:, :, 1:2), normal_before, s)
      call add_path_around(kinematics, 2, radius(2), turned(:, :, 3:4), normal_before, s)
   end function line_slip

   !> Distance and direction from a place of one axis to one of another.
   pure subroutine side_at(x, t, length, xi_bar, xi, side, normal, distance)
      !> As in `line_slip`
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      !> Places on the barred and the unbarred axis; -1: the barred one has passed the other
      real(dp), intent(in) :: xi_bar, xi
      !> 1: barred, 2: unbarred
      integer, intent(in) :: side
      !> Perpendicular to the barred axis (3), and the distance along it [m]
      real(dp), intent(out) :: normal(3), distance
      real(dp), dimension(4) :: h, hb, h1, h2
      real(dp) :: w(3), tangent(3)

      call axis_shape(axis_hermite, length(2), xi, h, h1, h2)
      call axis_shape(axis_hermite, length(1), xi_bar, hb, h1, h2)
      w = on_axis(hb, x(:, 1:2), t(:, 1:2)) - on_axis(h, x(:, 3:4), t(:, 3:4))
      tangent = on_axis(h1, x(:, 1:2), t(:, 1:2))
      normal = w - tangent*(dot_product(tangent, w)/dot_product(tangent, tangent))
      normal = side*normal/norm2(normal)
      distance = dot_product(w, normal)
   end subroutine side_at

   !> The part of the virtual slip that the sections have by turning.
   pure subroutine add_arms(kinematics, radius, s)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> (2) [m]
      real(dp), intent(in) :: radius(2)
      type(line_slip_t), intent(inout) :: s
      integer :: i

      s%arm(1:2) = radius(1)/sum(radius)*shares(kinematics%xi_bar)
      s%arm(3:4) = radius(2)/sum(radius)*shares(kinematics%xi)
      s%darm(1:2) = radius(1)/sum(radius)*[-0.5_dp, 0.5_dp]
      do i = 1, 4
         associate (rotation => s%motion(:, first(i):first(i) + 2))
            rotation = rotation + s%arm(i)*skew(s%w)
         end associate
      end do
   end subroutine add_arms

   !> Shares of the two nodes of an element in the turning of a section.
   pure function shares(xi)
      !> Its place
      real(dp), intent(in) :: xi
      real(dp) :: shares(2)

      shares = [1 - xi, 1 + xi]/2
   end function shares

   !> Directions along and across, and how they turn with the normal and the tangent.
   pure subroutine add_frame(normal, distance, x1, dx1, s)
      !> Normal (3), and distance of the axes [m]
      real(dp), intent(in) :: normal(3), distance
      !> First derivative of the unbarred axis (3), and how it changes (3, 24) [m]
      real(dp), intent(in) :: x1(3), dx1(3, 24)
      type(line_slip_t), intent(inout) :: s
      real(dp) :: flat(3), about_normal(24)

      s%normal_turn = (s%step - outer(normal, matmul(normal, s%step)))/distance
      flat = x1 - normal*dot_product(normal, x1)
      s%frame(:, 1) = flat/norm2(flat)
      s%frame(:, 2) = cross(normal, s%frame(:, 1))
      about_normal = (matmul(s%frame(:, 2), dx1) - dot_product(normal, x1)*matmul(s%frame(:, 2), s%normal_turn)) &
         /norm2(flat)
      s%turn(:, :, 1) = outer(s%frame(:, 2), about_normal) - outer(normal, matmul(s%frame(:, 1), s%normal_turn))
      s%turn(:, :, 2) = -outer(s%frame(:, 1), about_normal) - outer(normal, matmul(s%frame(:, 2), s%normal_turn))
   end subroutine add_frame

   !> `-moved e.tb`.
   pure subroutine add_path_of_foot(moved, per_length, tangent, dtangent, dxi_bar, s)
      !> As in `line_slip`, and xib over length [1/m]
      real(dp), intent(in) :: moved, per_length
      !> First derivative of the barred axis (3), how it changes (3, 24) [m], and how the place does (24)
      real(dp), intent(in) :: tangent(3), dtangent(3, 24), dxi_bar(24)
      type(line_slip_t), intent(inout) :: s
      integer :: k

      do k = 1, 2
         associate (e => s%frame(:, k))
            s%slip(k) = s%slip(k) - moved*per_length*dot_product(e, tangent)
            s%dslip(:, k) = s%dslip(:, k) - dxi_bar*dot_product(e, tangent) &
               - moved*per_length*(matmul(e, dtangent) + matmul(tangent, s%turn(:, :, k)))
         end associate
      end do
   end subroutine add_path_of_foot

   !> `-r phi(A)` of one wire.
   pure subroutine add_path_around(kinematics, before, radius, turned, normal_before, s)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Nodes before those of the wire
      integer, intent(in) :: before
      !> [m]
      real(dp), intent(in) :: radius
      !> Rotations of its nodes (3, 3, 2), and the normal that they have turned (3)
      real(dp), intent(in) :: turned(3, 3, 2), normal_before(3)
      type(line_slip_t), intent(inout) :: s
      real(dp) :: a(3), da(3, 24), of_node(3, 2), share(2), sine, cosine
      integer :: i, k

      share = shares(merge(kinematics%xi_bar, kinematics%xi, before == 0))
      da = 0
      do i = 1, 2
         of_node(:, i) = matmul(turned(:, :, i), normal_before)
         da(:, first(before + i):first(before + i) + 2) = -share(i)*skew(of_node(:, i))
      end do
      a = matmul(of_node, share)
      if (before == 0) da = da + outer((of_node(:, 2) - of_node(:, 1))/2, kinematics%dxi_bar)
      do k = 1, 2
         sine = dot_product(s%frame(:, k), a)
         cosine = dot_product(kinematics%normal, a)
         s%slip(k) = s%slip(k) - radius*atan2(sine, cosine)
         s%dslip(:, k) = s%dslip(:, k) - radius/(sine**2 + cosine**2) &
            *(cosine*(matmul(s%frame(:, k), da) + matmul(a, s%turn(:, :, k))) &
            - sine*(matmul(kinematics%normal, da) + matmul(a, s%normal_turn)))
      end do
   end subroutine add_path_around

   !> Forces and moments of a traction on the nodes.
   pure function line_friction_residual(s, traction) result(r)
      type(line_slip_t), intent(in) :: s
      !> T1, T2 [N]
      real(dp), intent(in) :: traction(2)
      real(dp) :: r(24)

      r = matmul(matmul(s%frame, traction), s%motion)
   end function line_friction_residual

   !> Tangent with respect to spins.
   pure function line_friction_tangent(kinematics, s, dslip, t, law, dforce, geometric_traction) result(k)
      type(contact_kinematics_t), intent(in) :: kinematics
      type(line_slip_t), intent(in) :: s
      !> How the slip changes that the law has seen (24, 2)
      real(dp), intent(in) :: dslip(24, 2)
      !> Nodal unit tangents (3, 4)
      real(dp), intent(in) :: t(3, 4)
      type(friction_law_t), intent(in) :: law
      !> How the normal force changes (24)
      real(dp), intent(in) :: dforce(24)
      !> Traction in the geometric part [N]: `law%traction` for the exact tangent; a mixed iteration has its own
      real(dp), intent(in) :: geometric_traction(2)
      real(dp) :: k(24, 24)
      real(dp) :: force(3), dvector(3, 24)
      integer :: i, j

      force = matmul(s%frame, geometric_traction)
      dvector = 0
      do i = 1, 2
         dvector = dvector + outer(s%frame(:, i), &
            matmul(dslip, law%dtraction_dslip(i, :)) + law%dtraction_dforce(i)*dforce) &
            + geometric_traction(i)*s%turn(:, :, i)
      end do
      k = matmul(transpose(s%motion), dvector)
      k(1:12, :) = k(1:12, :) + outer(axis_row(s%hb1, t(:, 1:2), force), kinematics%dxi_bar)
      do i = 1, 4
         j = first(i)
         k(j:j + 2, :) = k(j:j + 2, :) + s%arm(i)*matmul(skew(force), s%step) &
            + s%darm(i)*outer(cross(force, s%w), kinematics%dxi_bar)
         call add_turning_tangent(t(:, i), kinematics%tangent_weight(i)*force, j, k)
      end do
   end function line_friction_tangent

   pure function outer(a, b)
      !> Column (n) and row (m)
      real(dp), intent(in) :: a(:), b(:)
      real(dp) :: outer(size(a), size(b))

      outer = spread(a, 2, size(b))*spread(b, 1, size(a))
   end function outer

end module litz_line_friction
