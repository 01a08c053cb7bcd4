!> Friction of two wires at a contact, on their surfaces: slip since the increment began, residual and exact tangent
!> over the 24 mechanical unknowns.
!>
!> The contact has moved along either wire by `moved`, and around it by the angle between the normal `n` and the normal
!> `n0` of the start that has turned with the section. In two directions `e1`, `e2 = n x e1` perpendicular to the normal
!> the barred wire has slipped over the other one by
!> `D_k = moved e_k.t - movedb e_k.tb - (1 - m) d phi_k(Ab) - m d phi_k(A)`, `phi_k(A) = e_k.A theta/s`,
!> `A = sum N_i R_i n0`, with the distance `d` of the axes, `m = r/(r + rb)`, the part `s` of `A` that is perpendicular
!> to the normal, and the angle `theta = atan2(s, n.A)` between the two.
!> A motion of the whole model changes nothing, and wires that roll on each other do not slip, however far they do.
!>
!> The virtual slip is that of the material surfaces at the present places,
!> `dv = dxb - dthb x (1 - m) w - dx - dth x m w`, with `w` from the axis of the unbarred to that of the barred wire:
!> the two surfaces meet in one point, and the forces `R = sum T_k e_k.dv` are in balance. It is the change of `D` when
!> the increment begins. Sections turn as the mean of their nodes: a cubic in its place would stick where the stretch is
!> linear.
!>
!> The kernel serves a crossing, whose places move on both wires; a place of a line and its foot, and a contact at an
!> end or a kink, where they move on one wire or on none. A contact that closes within the increment has a part of this
!> slip only, which `dslip` of the tangent is to have, too.
!>
!> Source: theory sections 5 and 10.
module litz_wire_friction
   use litz_kinds, only: dp
   use litz_axis, only: axis_shape, on_axis, axis_row
   use litz_closest_point_motion, only: add_turning_tangent
   use litz_closest_points, only: parallel_sine
   use litz_contact_kinematics, only: contact_kinematics_t
   use litz_friction_law, only: friction_law_t
   use litz_rotations, only: cross, identity3, skew
   implicit none
   private
   public :: wire_slip_t, wire_slip, side_at, wire_friction_residual, wire_friction_tangent

   !> First rotation unknown of the nodes
   integer, parameter :: first(4) = [4, 10, 16, 22]

   !> Angle below which four terms of the power series are enough
   real(dp), parameter :: small_angle = 0.02_dp
   !> Axes that are nearer to each other than this part of the sum of the radii do not tell how the normal turns
   real(dp), parameter :: least_distance = 0.1_dp

   !> The slip of a contact, and how it changes with the 24 mechanical unknowns. The first wire is the barred one.
   type :: wire_slip_t
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
      !> the place on the wire (4)
      real(dp), private :: arm(4) = 0, darm(4) = 0
      !> How the places on the two wires move (24, 2)
      real(dp), private :: dplace(24, 2) = 0
      !> Weights of the tangents there (4, 2), the tangents by xi (3, 2) [m], and how these change (3, 24, 2)
      real(dp), private :: h1(4, 2) = 0, tangent(3, 2) = 0, dtangent(3, 24, 2) = 0
   end type wire_slip_t

contains

   !> Slip since the increment began.
   pure type(wire_slip_t) function wire_slip(kinematics, x, t, length, axis, radius, along, turned, normal_before, &
      moved) result(s)
      !> Of the present places
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths and radii (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2), radius(2)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> `e1` is along the sum of the unit tangents times these factors (2)
      real(dp), intent(in) :: along(2)
      !> Rotations of the nodes since the increment began (3, 3, 4)
      real(dp), intent(in) :: turned(3, 3, 4)
      !> Normal when it began (3)
      real(dp), intent(in) :: normal_before(3)
      !> How far the places have moved since in the directions of xib and xi, of the length before loading (2) [m]
      real(dp), intent(in) :: moved(2)

      s%w = kinematics%distance*kinematics%normal
      s%dplace(:, 1) = kinematics%rows%dxi_bar
      s%dplace(:, 2) = kinematics%rows%dxi
      call add_axis(1, 1.0_dp, axis, length(1), kinematics%xi_bar, x(:, 1:2), t(:, 1:2), s)
      call add_axis(2, -1.0_dp, axis, length(2), kinematics%xi, x(:, 3:4), t(:, 3:4), s)
      s%step = s%step + s%motion
      call add_arms(kinematics, radius, s)
      call add_turn_of_normal(kinematics, sum(radius), s)
      call add_frame(kinematics%normal, along, s)
      call add_path_along(1, -1.0_dp, moved(1)*2/length(1), s)
      call add_path_along(2, 1.0_dp, moved(2)*2/length(2), s)
      call add_path_around(1, kinematics%xi_bar, kinematics, radius(1)/sum(radius), turned(:, :, 1:2), normal_before, s)
      call add_path_around(2, kinematics%xi, kinematics, radius(2)/sum(radius), turned(:, :, 3:4), normal_before, s)
   end function wire_slip

   !> One axis at its place: its part of `w` (1 or -1) and of how `w` changes.
   pure subroutine add_axis(k, part, axis, length, xi, x, t, s)
      !> Wire
      integer, intent(in) :: k
      !> 1: barred, -1: unbarred
      real(dp), intent(in) :: part
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> Reference length [m], and place in the element
      real(dp), intent(in) :: length, xi
      !> Nodal positions [m] and unit tangents (3, 2)
      real(dp), intent(in) :: x(3, 2), t(3, 2)
      type(wire_slip_t), intent(inout) :: s
      real(dp) :: h(4), h2(4)
      integer :: i

      call axis_shape(axis, length, xi, h, s%h1(:, k), h2)
      s%tangent(:, k) = on_axis(s%h1(:, k), x, t)
      s%dtangent(:, :, k) = outer(on_axis(h2, x, t), s%dplace(:, k))
      associate (own => unknowns_of(k))
         do i = 1, 3
            s%motion(i, own) = axis_row(h, t, part*identity3(:, i))
            s%dtangent(i, own, k) = s%dtangent(i, own, k) + axis_row(s%h1(:, k), t, identity3(:, i))
         end do
      end associate
      s%step = s%step + part*outer(s%tangent(:, k), s%dplace(:, k))
   end subroutine add_axis

   !> The unknowns of the nodes of one wire (12).
   pure function unknowns_of(k)
      !> Wire
      integer, intent(in) :: k
      integer :: unknowns_of(12), i

      unknowns_of = [(12*(k - 1) + i, i=1, 12)]
   end function unknowns_of

   !> Distance and direction from a place of one axis to one of another.
   pure subroutine side_at(x, t, length, axis, place, moves, side, normal, distance)
      !> As in `wire_slip`
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> Places on the barred and the unbarred axis (2)
      real(dp), intent(in) :: place(2)
      !> The place moves along the wire (2): the normal is perpendicular to its axis
      logical, intent(in) :: moves(2)
      !> That of the kinematics
      integer, intent(in) :: side
      !> (3), and the distance along it [m]
      real(dp), intent(out) :: normal(3), distance
      real(dp) :: w(3), tangent(3, 2), h(4), h1(4), h2(4), size_of_normal
      integer :: k

      w = 0
      do k = 1, 2
         associate (nodes => [2*k - 1, 2*k])
            call axis_shape(axis, length(k), place(k), h, h1, h2)
            w = w + (3 - 2*k)*on_axis(h, x(:, nodes), t(:, nodes))
            tangent(:, k) = on_axis(h1, x(:, nodes), t(:, nodes))
            tangent(:, k) = tangent(:, k)/norm2(tangent(:, k))
         end associate
      end do
      normal = w
      if (all(moves)) normal = cross(tangent(:, 2), tangent(:, 1))
      size_of_normal = norm2(normal)
      if (all(moves) .and. size_of_normal <= parallel_sine) normal = w*sign(1.0_dp, dot_product(w, normal))
      do k = 1, 2
         if (moves(k)) normal = normal - tangent(:, k)*dot_product(tangent(:, k), normal)
      end do
      normal = side*normal/norm2(normal)
      distance = dot_product(w, normal)
   end subroutine side_at

   !> The part of the virtual slip that the sections have by turning.
   pure subroutine add_arms(kinematics, radius, s)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> (2) [m]
      real(dp), intent(in) :: radius(2)
      type(wire_slip_t), intent(inout) :: s
      integer :: i

      s%arm(1:2) = radius(1)/sum(radius)*shares(kinematics%xi_bar)
      s%arm(3:4) = radius(2)/sum(radius)*shares(kinematics%xi)
      s%darm(1:2) = radius(1)/sum(radius)*[-0.5_dp, 0.5_dp]
      s%darm(3:4) = radius(2)/sum(radius)*[-0.5_dp, 0.5_dp]
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

   !> How the normal turns: it is that of `w`, and of a crossing whose axes all but meet that of both tangents.
   pure subroutine add_turn_of_normal(kinematics, sum_of_radii, s)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> [m]
      real(dp), intent(in) :: sum_of_radii
      type(wire_slip_t), intent(inout) :: s
      real(dp) :: change(3, 24), size_of_normal

      if (abs(kinematics%distance) > least_distance*sum_of_radii) then
         change = s%step
         size_of_normal = kinematics%distance
      else
         change = matmul(skew(s%tangent(:, 2)), s%dtangent(:, :, 1)) &
            - matmul(skew(s%tangent(:, 1)), s%dtangent(:, :, 2))
         size_of_normal = dot_product(kinematics%normal, cross(s%tangent(:, 2), s%tangent(:, 1)))
      end if
      s%normal_turn = (change - outer(kinematics%normal, matmul(kinematics%normal, change)))/size_of_normal
   end subroutine add_turn_of_normal

   !> Directions along and across, and how they turn with the normal and the tangents.
   pure subroutine add_frame(normal, along, s)
      !> Normal (3)
      real(dp), intent(in) :: normal(3)
      !> As in `wire_slip`
      real(dp), intent(in) :: along(2)
      type(wire_slip_t), intent(inout) :: s
      real(dp) :: u(3), du(3, 24), e(3), flat(3), about_normal(24), size_of_tangent
      integer :: k

      u = 0
      du = 0
      do k = 1, 2
         size_of_tangent = norm2(s%tangent(:, k))
         e = s%tangent(:, k)/size_of_tangent
         u = u + along(k)*e
         du = du + along(k)/size_of_tangent*(s%dtangent(:, :, k) - outer(e, matmul(e, s%dtangent(:, :, k))))
      end do
      flat = u - normal*dot_product(normal, u)
      s%frame(:, 1) = flat/norm2(flat)
      s%frame(:, 2) = cross(normal, s%frame(:, 1))
      about_normal = (matmul(s%frame(:, 2), du) - dot_product(normal, u)*matmul(s%frame(:, 2), s%normal_turn)) &
         /norm2(flat)
      s%turn(:, :, 1) = outer(s%frame(:, 2), about_normal) - outer(normal, matmul(s%frame(:, 1), s%normal_turn))
      s%turn(:, :, 2) = -outer(s%frame(:, 1), about_normal) - outer(normal, matmul(s%frame(:, 2), s%normal_turn))
   end subroutine add_frame

   !> What the place has moved along one wire: `moved e.t` of the unbarred, and `-movedb e.tb` of the barred one.
   pure subroutine add_path_along(k, part, moved, s)
      !> Wire
      integer, intent(in) :: k
      !> -1: barred, 1: unbarred
      real(dp), intent(in) :: part
      !> By how much of xib or xi
      real(dp), intent(in) :: moved
      type(wire_slip_t), intent(inout) :: s
      integer :: i

      do i = 1, 2
         associate (e => s%frame(:, i), tangent => s%tangent(:, k))
            s%slip(i) = s%slip(i) + part*moved*dot_product(e, tangent)
            s%dslip(:, i) = s%dslip(:, i) + part*(s%dplace(:, k)*dot_product(e, tangent) &
               + moved*(matmul(e, s%dtangent(:, :, k)) + matmul(tangent, s%turn(:, :, i))))
         end associate
      end do
   end subroutine add_path_along

   !> `-m d phi(A)` of one wire.
   pure subroutine add_path_around(k, place, kinematics, share_of_distance, turned, normal_before, s)
      !> Wire
      integer, intent(in) :: k
      !> xib or xi
      real(dp), intent(in) :: place
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Radius over the sum of the radii
      real(dp), intent(in) :: share_of_distance
      !> Rotations of its nodes (3, 3, 2), and the normal that they have turned (3)
      real(dp), intent(in) :: turned(3, 3, 2), normal_before(3)
      type(wire_slip_t), intent(inout) :: s
      real(dp) :: a(3), da(3, 24), of_node(3, 2), share(2), across(2), dacross(24, 2), up, dup(24), angle, dangle(2), &
         arm, darm(24)
      integer :: i, rotation

      share = shares(place)
      do i = 1, 2
         of_node(:, i) = matmul(turned(:, :, i), normal_before)
      end do
      a = matmul(of_node, share)
      da = outer((of_node(:, 2) - of_node(:, 1))/2, s%dplace(:, k))
      do i = 1, 2
         rotation = first(2*k - 2 + i)
         da(:, rotation:rotation + 2) = da(:, rotation:rotation + 2) - share(i)*skew(of_node(:, i))
      end do
      across = matmul(a, s%frame)
      up = dot_product(kinematics%normal, a)
      dup = matmul(kinematics%normal, da) + matmul(a, s%normal_turn)
      arm = share_of_distance*kinematics%distance
      darm = share_of_distance*matmul(kinematics%normal, s%step)
      do i = 1, 2
         dacross(:, i) = matmul(s%frame(:, i), da) + matmul(a, s%turn(:, :, i))
      end do
      call angle_over_sine(norm2(across), up, angle, dangle)
      do i = 1, 2
         s%slip(i) = s%slip(i) - arm*angle*across(i)
         s%dslip(:, i) = s%dslip(:, i) - darm*angle*across(i) - arm*(angle*dacross(:, i) &
            + across(i)*(dangle(1)*matmul(dacross, across) + dangle(2)*dup))
      end do
   end subroutine add_path_around

   !> `theta/s`, `theta = atan2(s, c)`, and its derivatives: by `s` over `s`, and by `c`.
   pure subroutine angle_over_sine(s, c, ratio, dratio)
      !> Not negative, and of any sign
      real(dp), intent(in) :: s, c
      !> [rad], and its derivatives
      real(dp), intent(out) :: ratio, dratio(2)
      real(dp) :: q

      if (s < small_angle*c) then
         q = (s/c)**2
         ratio = (1 - q*(1/3.0_dp - q*(1/5.0_dp - q/7)))/c
         dratio(1) = -2*(1/3.0_dp - q*(2/5.0_dp - q*(3/7.0_dp - q*4/9)))/c**3
      else
         ratio = atan2(s, c)/s
         dratio(1) = (c/(s**2 + c**2) - ratio)/s**2
      end if
      dratio(2) = -1/(s**2 + c**2)
   end subroutine angle_over_sine

   !> Forces and moments of a traction on the nodes.
   pure function wire_friction_residual(s, traction) result(r)
      type(wire_slip_t), intent(in) :: s
      !> T1, T2 [N]
      real(dp), intent(in) :: traction(2)
      real(dp) :: r(24)

      r = matmul(matmul(s%frame, traction), s%motion)
   end function wire_friction_residual

   !> Tangent with respect to spins.
   pure function wire_friction_tangent(kinematics, s, dslip, t, law, dforce, geometric_traction) result(k)
      type(contact_kinematics_t), intent(in) :: kinematics
      type(wire_slip_t), intent(in) :: s
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
      k(1:12, :) = k(1:12, :) + outer(axis_row(s%h1(:, 1), t(:, 1:2), force), s%dplace(:, 1))
      k(13:24, :) = k(13:24, :) + outer(axis_row(s%h1(:, 2), t(:, 3:4), -force), s%dplace(:, 2))
      do i = 1, 4
         j = first(i)
         k(j:j + 2, :) = k(j:j + 2, :) + s%arm(i)*matmul(skew(force), s%step) &
            + s%darm(i)*outer(cross(force, s%w), s%dplace(:, (i + 1)/2))
         call add_turning_tangent(t(:, i), kinematics%tangent_weight(i)*force, j, k)
      end do
   end function wire_friction_tangent

   pure function outer(a, b)
      !> Column (n) and row (m)
      real(dp), intent(in) :: a(:), b(:)
      real(dp) :: outer(size(a), size(b))

      outer = spread(a, 2, size(b))*spread(b, 1, size(a))
   end function outer

end module litz_wire_friction
