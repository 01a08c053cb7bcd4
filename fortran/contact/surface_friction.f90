!> Friction of an element on a rigid surface, at the centre of the contact force.
!>
!> It acts on the surface of the wire. The slip since the increment began is that of the material point of the wire's
!> surface that touched then, relative to the point of the rigid surface that it touched: a wire that rolls does not
!> slip. Its components are along and across the wire. With the axis `x`, the normal `n0` at the start, turned by the
!> nodes, and the point `y` of the rigid surface, `D = e . v`, `v = x - r sum(N R n0) - y`, and the forces follow from
!> the virtual work `T . e . delta v`, with the moment on the surface of the point that is touched now: `y` has a
!> distance `n . v` from it where the wire slides along a curved surface. Source: theory section 12.
module litz_surface_friction
   use litz_kinds, only: dp
   use litz_axis, only: axis_shape, on_axis
   use litz_friction_law, only: friction_law_t, friction_law, friction_none
   use litz_law_input, only: wire_pair_t
   use litz_normal_law, only: overlap_of_force_t
   use litz_rigid_surface, only: rigid_surface_t, radial_motion, surface_distance, axis_motion, turn_twice
   use litz_rotations, only: cross, skew
   use litz_stick_laws, only: stick_stiffness_at
   use litz_surface_cells, only: surface_cell_t, wire_axis_t, centre_of_force
   use litz_surface_overlap, only: gap_at
   implicit none
   private
   public :: surface_slip_t, surface_slip, sticking_t, rub_cell, stick_stiffness_of, place_friction

   !> Young's modulus of the surface over that of the wire
   real(dp), parameter :: rigid = 1.0e30_dp

   !> How a contact sticks and slips.
   type :: sticking_t
      !> Coefficient of friction, place in `stick_laws`, and the number that belongs to it
      real(dp) :: mu = 0
      integer :: law = 0
      real(dp) :: value = 0
      !> Young's modulus [Pa] and Poisson's ratio of the wire
      real(dp) :: young = 0, poisson = 0
   end type sticking_t

   !> Slip since the increment began, and how it changes.
   type :: surface_slip_t
      !> Normal, and directions along and across the wire (3, 2)
      real(dp) :: normal(3) = 0, along(3, 2) = 0
      !> Slip (2) [m]
      real(dp) :: slip(2) = 0
      !> How the two points move apart with the unknowns (3, 18), how the directions turn (3, 18, 2), how the slip
      !> changes (2, 18)
      real(dp) :: motion(3, 18) = 0, turn(3, 18, 2) = 0, row(2, 18) = 0
      !> Parts of `v` that turn with the first and the second node and with the surface (3, 3) [m]
      real(dp) :: arm(3, 3) = 0
      !> From `y` to the point that is touched now, and how that changes (3, 18)
      real(dp) :: lever(3) = 0, dlever(3, 18) = 0
      !> Tangents of the nodes (3, 2), and their weights in the axis (2) [m]
      real(dp) :: tangent(3, 2) = 0, tangent_weight(2) = 0
   end type surface_slip_t

contains

   !> Kinematics of the place `xi` of an element.
   pure type(surface_slip_t) function surface_slip(before, axis_before, now, axis, turned, xi) result(s)
      !> Surface and axis when the increment began, and now
      type(rigid_surface_t), intent(in) :: before, now
      type(wire_axis_t), intent(in) :: axis_before, axis
      !> Rotations of the nodes since (3, 3, 2)
      real(dp), intent(in) :: turned(3, 3, 2)
      !> In the element
      real(dp), intent(in) :: xi
      real(dp) :: w(4), w1(4), w2(4), x0(3), x(3), x1(3), y(3), v(3), n0(3), distance, hessian(3, 3), &
         normal_turn(3, 18), about_normal(18), share(2)
      integer :: i, a

      call axis_shape(axis%interpolation, axis%length, xi, w, w1, w2)
      share = [1 - xi, 1 + xi]/2
      x0 = on_axis(w, axis_before%x, axis_before%t)
      call surface_distance(before, x0, distance, n0)
      ! the surface that was touched then has moved with it, and where its radius has changed across its axis
      y = x0 - axis%radius*n0 - before%centre + n0*radial_motion(before, now)
      y = matmul(now%rotation, matmul(y, before%rotation))
      x = on_axis(w, axis%x, axis%t)
      x1 = on_axis(w1, axis%x, axis%t)
      call surface_distance(now, x, distance, s%normal, hessian)
      s%along(:, 1) = x1 - s%normal*dot_product(s%normal, x1)
      s%along(:, 1) = s%along(:, 1)/norm2(s%along(:, 1))
      s%along(:, 2) = cross(s%normal, s%along(:, 1))

      s%motion = axis_motion(w, axis%t, x - now%centre)
      normal_turn = matmul(hessian, s%motion)
      normal_turn(:, 16:18) = normal_turn(:, 16:18) - skew(s%normal)
      about_normal = matmul(s%along(:, 2), axis_motion(w1, axis%t, x1))/norm2(x1)
      about_normal(13:18) = 0
      s%motion(:, 16:18) = skew(y)
      s%arm(:, 3) = y
      v = x - (now%centre + y)
      do i = 1, 2
         s%arm(:, i) = axis%radius*share(i)*matmul(turned(:, :, i), n0)
         v = v - s%arm(:, i)
         a = 6*i - 2
         s%motion(:, a:a + 2) = s%motion(:, a:a + 2) + skew(s%arm(:, i))
      end do
      do i = 1, 2
         s%turn(:, :, i) = -spread(s%normal, 2, 18)*spread(matmul(s%along(:, i), normal_turn), 1, 3) &
            + (3 - 2*i)*spread(s%along(:, 3 - i), 2, 18)*spread(about_normal, 1, 3)
      end do
      do i = 1, 2
         s%slip(i) = dot_product(s%along(:, i), v)
         s%row(i, :) = matmul(s%along(:, i), s%motion) + matmul(v, s%turn(:, :, i))
      end do
      s%lever = s%normal*dot_product(s%normal, v)
      s%dlever = spread(s%normal, 2, 18)*spread(matmul(v, normal_turn) + matmul(s%normal, s%motion), 1, 3) &
         + dot_product(s%normal, v)*normal_turn
      s%tangent_weight = w([2, 4])
      s%tangent = axis%t
   end function surface_slip

   !> Where friction acts in an increment in which a contact closes, and the part of the slip that follows the first
   !> touch, in proportional motion; see (5.10).
   pure subroutine place_friction(before, axis_before, now, axis, cell)
      !> Surface and axis when the increment began, and now
      type(rigid_surface_t), intent(in) :: before, now
      type(wire_axis_t), intent(in) :: axis_before, axis
      type(surface_cell_t), intent(inout) :: cell
      real(dp) :: gap, gap_before, unused_slope

      cell%has_place = .true.
      cell%xi = centre_of_force(cell)
      call gap_at(before, axis_before%p, axis%radius, cell%xi, gap_before, unused_slope)
      call gap_at(now, axis%p, axis%radius, cell%xi, gap, unused_slope)
      cell%part = 1
      if (gap_before > 0) cell%part = max(0.0_dp, -gap)/(gap_before + max(0.0_dp, -gap))
   end subroutine place_friction

   !> The traction of a cell that touches, its forces, and the tangent of what the iteration supposes: the traction is
   !> an independent variable of it, see litz_friction_iteration.
   pure subroutine rub_cell(stick, s, cell, k, r, difference)
      type(sticking_t), intent(in) :: stick
      type(surface_slip_t), intent(in) :: s
      type(surface_cell_t), intent(inout) :: cell
      !> Added to the tangent (18, 18), Hessian form, and to the residual (18)
      real(dp), intent(inout) :: k(:, :), r(:)
      !> What the supposed residual has beyond the true one (18)
      real(dp), intent(out) :: difference(:)
      type(friction_law_t) :: supposed
      real(dp) :: force_row(18)
      integer :: i

      force_row = 0
      do i = 1, size(cell%points)
         associate (point => cell%points(i))
            force_row = force_row - point%weight*point%sum_stiffness*point%row
         end associate
      end do
      cell%friction = friction_law(stick%mu, cell%force, cell%stick_stiffness, 0.0_dp, cell%memory%start, &
         cell%part*s%slip)
      cell%dfriction_work = cell%part*matmul(cell%friction%ddissipation_dslip, s%row) &
         + cell%friction%ddissipation_dforce*force_row
      cell%traction = -matmul(s%along, cell%friction%traction)
      associate (iteration => cell%iteration)
         if (iteration%status == friction_none) then
            iteration%status = cell%friction%status
            iteration%mixed_traction = cell%friction%traction
         end if
         supposed = friction_law(stick%mu, cell%force, cell%stick_stiffness, 0.0_dp, cell%memory%start, &
            cell%part*s%slip, iteration%status, iteration%mixed_traction)
         difference = work_of(s, matmul(s%along, supposed%traction - cell%friction%traction))
         r = r - work_of(s, cell%traction)
         cell%friction_by_force = work_of(s, matmul(s%along, supposed%dtraction_dforce))
         call add_friction_tangent(s, cell%part, supposed, cell%friction%traction, force_row, k)
         iteration%trial = supposed%trial
         iteration%dtrial(:18, :) = cell%part*cell%stick_stiffness*transpose(s%row)
         iteration%limit = stick%mu*cell%force
         iteration%dlimit(:18) = stick%mu*force_row
      end associate
   end subroutine rub_cell

   !> What a force between wire and surface does on the unknowns (18).
   pure function work_of(s, force) result(row)
      type(surface_slip_t), intent(in) :: s
      !> On the surface (3) [N]
      real(dp), intent(in) :: force(3)
      real(dp) :: row(18)

      row = matmul(force, s%motion)
      row(16:18) = row(16:18) + cross(force, s%lever)
   end function work_of

   !> Tangential stiffness of a cell that touches [N/m].
   pure real(dp) function stick_stiffness_of(stick, cell) result(stiffness)
      type(sticking_t), intent(in) :: stick
      type(surface_cell_t), intent(in) :: cell
      real(dp) :: dstiffness_dforce

      call stick_stiffness_at(stick%law, stick%value, stick%mu, cell%force, &
         overlap_of_force_t(stiffness=sum(cell%points%weight*cell%points%elastic_stiffness)), &
         wire_pair_t(young=[stick%young, rigid*stick%young], poisson=[stick%poisson, 0.0_dp]), stiffness, &
         dstiffness_dforce)
   end function stick_stiffness_of

   !> The tangent of friction, which is not symmetric.
   pure subroutine add_friction_tangent(s, part, law, traction, force_row, k)
      type(surface_slip_t), intent(in) :: s
      !> Of the slip since the increment began that counts
      real(dp), intent(in) :: part
      !> How the traction changes
      type(friction_law_t), intent(in) :: law
      !> The traction that turns (2) [N], and how the contact force changes with the unknowns (18)
      real(dp), intent(in) :: traction(2), force_row(18)
      !> (18, 18), Hessian form
      real(dp), intent(inout) :: k(:, :)
      real(dp) :: traction_row(2, 18), force(3), turned(3, 18)
      integer :: i, a

      traction_row = part*matmul(law%dtraction_dslip, s%row) &
         + spread(law%dtraction_dforce, 2, 18)*spread(force_row, 1, 2)
      force = matmul(s%along, traction)
      turned = matmul(s%along, traction_row) + traction(1)*s%turn(:, :, 1) + traction(2)*s%turn(:, :, 2)
      k = k + matmul(transpose(s%motion), turned)
      do i = 1, 2
         a = 6*i - 2
         k(a:a + 2, a:a + 2) = k(a:a + 2, a:a + 2) + s%tangent_weight(i)*turn_twice(s%tangent(:, i), force) &
            - turn_twice(s%arm(:, i), force)
      end do
      k(16:18, 16:18) = k(16:18, 16:18) - turn_twice(s%arm(:, 3), force) + skew(cross(force, s%lever))/2
      k(16:18, :) = k(16:18, :) - matmul(skew(s%lever), turned) + matmul(skew(force), s%dlever)
   end subroutine add_friction_tangent

end module litz_surface_friction
