!> Gap and normal of a fixed place of the unbarred wire over its foot on the barred wire, and how they change with the
!> 24 mechanical unknowns; and the sine by which the lens of a crossing is as long as it is.
!>
!> Source: theory section 10, with the rows of litz_contact_kinematics, whose type this fills: a line point then has the
!> mechanics and the electricity of a crossing. At a fixed xi only the foot moves, `dxib = -C dp/M`,
!> `M = xb'.xb' + w.xb''`, `C = B + d Q`, `B = xb'^T S`, `Q = n^T Sb1`. With the directions `e1`, along the barred axis,
!> and `e2 = n x e1`, the projector is `1 - n n^T = e1 e1^T + e2 e2^T`, and of (4.5)
!> `d2g = (H/(G M)) B^T B - (Q^T B + B^T Q)/M - (d/M) Q^T Q + S^T e2 e2^T S/d`, `G = xb'.xb'`, `H = n.xb''`:
!> the form of (4.7) with `S^T e2` as the second row of B.
module litz_line_kinematics
   use litz_kinds, only: dp
   use litz_rotations, only: cross
   use litz_axis, only: axis_shape, axis_third_derivative, on_axis, axis_row
   use litz_contact_kinematics, only: contact_kinematics_t, kinematics_ok, kinematics_singular
   implicit none
   private
   public :: line_kinematics, lens_sine, sine_at_angle, crossing_qualities, line_profile_t, line_profile, &
      line_course_t, line_course

   !> The distance to the barred wire along the unbarred one, round a place: `D(s) = D + t s + k s^2/2`.
   type :: line_profile_t
      !> Slope along xi [-] and curvature [1/m], k
      real(dp) :: slope = 0, bend = 0
      !> Sine of the angle at which the barred axis runs into the surface, along its xi
      real(dp) :: slope_bar = 0
      !> q (10.3) of a foot on the barred and on the unbarred wire
      real(dp) :: quality(2) = 0
   end type line_profile_t

   !> The same along the unbarred wire before loading, and how it changes with the 24 mechanical unknowns.
   type :: line_course_t
      !> Slope [-] and curvature [1/m]
      real(dp) :: slope = 0, bend = 0
      real(dp) :: dslope(24) = 0, dbend(24) = 0
   end type line_course_t

contains

   !> Everything at a given foot.
   pure subroutine line_kinematics(x, t, length, axis, radius, xi_bar, xi, at_end, normal_before, kinematics, info)
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer, intent(in) :: axis
      !> Radii (2) [m]: barred, unbarred
      real(dp), intent(in) :: radius(2)
      !> The foot, from `line_foot`, and the place that stays
      real(dp), intent(in) :: xi_bar, xi
      !> The foot is held at an end of the barred axis
      logical, intent(in) :: at_end
      !> Normal of the last converged state, which keeps the sign of the gap when the axes pass each other; 0: none
      real(dp), intent(in) :: normal_before(3)
      type(contact_kinematics_t), intent(out) :: kinematics
      !> `kinematics_ok`, or `kinematics_singular` where the axes meet; `kinematics` is complete only with the former
      integer, intent(out) :: info
      real(dp), dimension(4) :: h, h1, h2, hb, hb1, hb2
      real(dp), dimension(3) :: w, x1, xb1, n
      real(dp) :: relative(3, 4)
      integer :: i

      allocate (kinematics%rows)
      call axis_shape(axis, length(2), xi, h, h1, h2)
      call axis_shape(axis, length(1), xi_bar, hb, hb1, hb2)
      ! measured from one node, so that the distance does not suffer from far-away origins
      do i = 1, 4
         relative(:, i) = x(:, i) - x(:, 3)
      end do
      w = on_axis(hb, relative(:, 1:2), t(:, 1:2)) - on_axis(h, relative(:, 3:4), t(:, 3:4))
      x1 = on_axis(h1, x(:, 3:4), t(:, 3:4))
      xb1 = on_axis(hb1, x(:, 1:2), t(:, 1:2))
      info = kinematics_singular
      if (.not. norm2(w) > epsilon(1.0_dp)*sum(radius)) return
      info = kinematics_ok

      kinematics%xi_bar = xi_bar
      kinematics%xi = xi
      kinematics%point = on_axis(h, x(:, 3:4), t(:, 3:4))
      kinematics%point_bar = kinematics%point + w
      kinematics%side = merge(-1, 1, dot_product(w, normal_before) < 0)
      n = kinematics%side*w/norm2(w)
      kinematics%normal = n
      kinematics%distance = dot_product(w, n)                                              ! d
      kinematics%gap = kinematics%distance - sum(radius)                                   ! g = d - (rb + r)
      kinematics%angle = atan2(norm2(cross(x1, xb1)), dot_product(x1, xb1))
      kinematics%cos_angle = cos(kinematics%angle)
      kinematics%tangent_weight = [hb(2), hb(4), -h(2), -h(4)]
      kinematics%dgap = over_w(h, hb, t, n)                                                ! dg = n^T S
      if (at_end) then
         call add_held_foot(h, hb, t, kinematics)
      else
         call add_moving_foot(h, hb, hb1, t, xb1, on_axis(hb2, x(:, 1:2), t(:, 1:2)), kinematics)
      end if
   end subroutine line_kinematics

   !> The foot moves by `dxib = -C dp/M`.
   pure subroutine add_moving_foot(h, hb, hb1, t, xb1, xb2, kinematics)
      !> Shape functions (4): unbarred, barred, and the first derivatives of the latter
      real(dp), dimension(4), intent(in) :: h, hb, hb1
      !> Unit tangents of the nodes (3, 4)
      real(dp), intent(in) :: t(3, 4)
      !> First and second derivative of the barred axis by xi (3) [m]
      real(dp), dimension(3), intent(in) :: xb1, xb2
      type(contact_kinematics_t), intent(inout) :: kinematics
      real(dp) :: g, curvature, m

      associate (n => kinematics%normal, d => kinematics%distance)
         g = dot_product(xb1, xb1)                                                         ! G
         curvature = dot_product(n, xb2)                                                   ! H
         m = g + d*curvature                                                               ! M
         kinematics%rows%b(:, 1) = over_w(h, hb, t, xb1)                                        ! B
         kinematics%rows%b(:, 2) = over_w(h, hb, t, cross(n, xb1)/sqrt(g))
         kinematics%rows%q(1:12, 1) = axis_row(hb1, t(:, 1:2), n)                               ! Q
         kinematics%between_b(1, 1) = curvature/(g*m)
         kinematics%between_b(2, 2) = 1/d
         kinematics%between_q(1, 1) = 1/m
         kinematics%between_bq = kinematics%between_q
         kinematics%rows%dxi_bar = -(kinematics%rows%b(:, 1) + d*kinematics%rows%q(:, 1))/m               ! -C/M
      end associate
   end subroutine add_moving_foot

   !> The foot stays at an end: `d2g = S^T (1 - n n^T) S/d`, with any two directions perpendicular to the normal.
   pure subroutine add_held_foot(h, hb, t, kinematics)
      !> Shape functions (4): unbarred, barred
      real(dp), dimension(4), intent(in) :: h, hb
      !> Unit tangents of the nodes (3, 4)
      real(dp), intent(in) :: t(3, 4)
      type(contact_kinematics_t), intent(inout) :: kinematics
      real(dp) :: e(3)
      integer :: i

      associate (n => kinematics%normal)
         e = 0
         e(minloc(abs(n), 1)) = 1
         e = cross(n, e)/norm2(cross(n, e))
         kinematics%rows%b(:, 1) = over_w(h, hb, t, e)
         kinematics%rows%b(:, 2) = over_w(h, hb, t, cross(n, e))
      end associate
      do i = 1, 2
         kinematics%between_b(i, i) = 1/kinematics%distance
      end do
   end subroutine add_held_foot

   !> `v^T S`: how `v . w` changes with the unknowns at fixed places.
   pure function over_w(h, hb, t, v) result(row)
      !> Shape functions (4): unbarred, barred
      real(dp), dimension(4), intent(in) :: h, hb
      !> Unit tangents of the nodes (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: t(3, 4)
      !> A direction (3)
      real(dp), intent(in) :: v(3)
      real(dp) :: row(24)

      row(1:12) = axis_row(hb, t(:, 1:2), v)
      row(13:24) = axis_row(h, t(:, 3:4), -v)
   end function over_w

   !> How the distance changes along the unbarred wire.
   pure type(line_profile_t) function line_profile(x, t, length, axis, xi_bar, xi, normal, distance) result(profile)
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer, intent(in) :: axis
      !> The foot, and the place
      real(dp), intent(in) :: xi_bar, xi
      !> Normal (3) and distance of the axes [m] there
      real(dp), intent(in) :: normal(3), distance
      real(dp), dimension(4) :: h, h1, h2
      real(dp), dimension(3) :: x1, x2, xb1, xb2
      real(dp) :: along, square, square_bar, tilt

      call axis_shape(axis, length(2), xi, h, h1, h2)
      x1 = on_axis(h1, x(:, 3:4), t(:, 3:4))
      x2 = on_axis(h2, x(:, 3:4), t(:, 3:4))
      call axis_shape(axis, length(1), xi_bar, h, h1, h2)
      xb1 = on_axis(h1, x(:, 1:2), t(:, 1:2))
      xb2 = on_axis(h2, x(:, 1:2), t(:, 1:2))
      associate (n => normal, d => distance, quality => profile%quality)
         along = dot_product(x1, xb1)
         square = dot_product(x1, x1)
         square_bar = dot_product(xb1, xb1)
         profile%slope = -dot_product(n, x1)/sqrt(square)
         tilt = abs(dot_product(n, x1))/sqrt(square)                                            ! |t|
         profile%slope_bar = dot_product(n, xb1)/norm2(xb1)
         quality = 1 - d*[-dot_product(n, xb2)/square_bar, dot_product(n, x2)/square]           ! q of either pass
         profile%bend = (quality(2) - along**2/(square*square_bar*quality(1)) - tilt**2)/d      ! k
      end associate
   end function line_profile

   !> Slope and curvature of the distance round a place, and their variations, from those of (10.1): with
   !> `D' = -n.x'`, `D'' = (x'.x' - (x'.xb')^2/M - D'^2)/D - n.x''` and `dn = (1 - n n^T)(S dp + xb' dxib)/D`.
   pure type(line_course_t) function line_course(x, t, length, axis, at_end, kinematics) result(course)
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite` of litz_axis_choices
      integer, intent(in) :: axis
      !> The foot is held at an end of the barred axis
      logical, intent(in) :: at_end
      !> Of `line_kinematics`
      type(contact_kinematics_t), intent(in) :: kinematics
      real(dp), dimension(4) :: h, h1, h2, hb, hb1, hb2
      real(dp), dimension(3) :: x1, x2, xb1, xb2, xb3
      real(dp), dimension(24) :: dslope, dbend, dalong, dm
      real(dp) :: slope, bend, along, m

      call axis_shape(axis, length(2), kinematics%xi, h, h1, h2)
      call axis_shape(axis, length(1), kinematics%xi_bar, hb, hb1, hb2)
      x1 = on_axis(h1, x(:, 3:4), t(:, 3:4))
      x2 = on_axis(h2, x(:, 3:4), t(:, 3:4))
      xb1 = on_axis(hb1, x(:, 1:2), t(:, 1:2))
      xb2 = on_axis(hb2, x(:, 1:2), t(:, 1:2))
      xb3 = on_axis(axis_third_derivative(axis, length(1)), x(:, 1:2), t(:, 1:2))
      associate (n => kinematics%normal, d => kinematics%distance, dxib => kinematics%rows%dxi_bar)
         slope = -dot_product(n, x1)
         along = dot_product(x1, xb1)
         m = dot_product(xb1, xb1) + d*dot_product(n, xb2)                                      ! M
         dslope = -turned_normal(x1 + slope*n) - of_place(h1, n)
         dalong = of_place(h1, xb1) + of_foot(hb1, x1) + dot_product(x1, xb2)*dxib
         dm = 2*of_foot(hb1, xb1) + 3*dot_product(xb1, xb2)*dxib + over_w(h, hb, t, xb2) &
            + d*(of_foot(hb2, n) + dot_product(n, xb3)*dxib)
         if (at_end) then
            along = 0
            dalong = 0
         end if
         bend = (dot_product(x1, x1) - along**2/m - slope**2)/d
         dbend = (2*of_place(h1, x1) - (2*dalong - along/m*dm)*along/m - 2*slope*dslope - bend*kinematics%dgap)/d &
            - turned_normal(x2 - dot_product(n, x2)*n) - of_place(h2, n)
         bend = bend - dot_product(n, x2)
      end associate
      course = line_course_t(2/length(2)*slope, (2/length(2))**2*bend, 2/length(2)*dslope, (2/length(2))**2*dbend)

   contains

      !> `v.dn` of a direction perpendicular to the normal.
      pure function turned_normal(v) result(row)
         !> (3)
         real(dp), intent(in) :: v(3)
         real(dp) :: row(24)

         row = (over_w(h, hb, t, v) + dot_product(xb1, v)*kinematics%rows%dxi_bar)/kinematics%distance
      end function turned_normal

      !> How the product of a direction with a derivative of the unbarred axis changes.
      pure function of_place(weight, v) result(row)
         !> Shape functions (4), a direction (3)
         real(dp), intent(in) :: weight(4), v(3)
         real(dp) :: row(24)

         row(1:12) = 0
         row(13:24) = axis_row(weight, t(:, 3:4), v)
      end function of_place

      !> The same of the barred axis, at a foot that stays.
      pure function of_foot(weight, v) result(row)
         !> Shape functions (4), a direction (3)
         real(dp), intent(in) :: weight(4), v(3)
         real(dp) :: row(24)

         row(1:12) = axis_row(weight, t(:, 1:2), v)
         row(13:24) = 0
      end function of_foot

   end function line_course

   !> Sine `s` of a crossing by which `aW = sqrt(2 d delta)/s` is the half length of the lens of overlap, the mean of
   !> those along the two wires: `sqrt(2 d delta q)/s0`, `s0^2 = det M/(|x'|^2 |xb'|^2)` and `q = M/|x'|^2` of each
   !> diagonal. It is the sine of the angle of straight wires, and 0 for wires that follow each other, at any angle.
   pure real(dp) function lens_sine(kinematics) result(sine)
      !> Of `contact_kinematics`
      type(contact_kinematics_t), intent(in) :: kinematics
      real(dp) :: slope, curvature

      call sine_at_angle(crossing_qualities(kinematics), kinematics%angle, sine, slope, curvature)
   end function lens_sine

   !> The same with `det M = (q qb - cos^2 psi) |x'|^2 |xb'|^2`, as wires turn that are curved about each other no
   !> otherwise.
   pure subroutine sine_at_angle(quality, angle, sine, slope, curvature)
      !> q of both wires (2), and the angle of the axes [rad]
      real(dp), intent(in) :: quality(2), angle
      !> 0 of wires that follow each other; and its first and second derivative by the angle
      real(dp), intent(out) :: sine, slope, curvature
      real(dp) :: square, factor

      sine = 0
      slope = 0
      curvature = 0
      if (.not. all(quality > 0)) return
      square = product(quality) - 1 + sin(angle)**2
      if (.not. square > 0) return
      factor = 2/sum(sqrt(quality))
      sine = factor*sqrt(square)
      slope = factor**2*sin(angle)*cos(angle)/sine
      curvature = (factor**2*cos(2*angle) - slope**2)/sine
   end subroutine sine_at_angle

   !> q (10.3) of a foot on the unbarred and on the barred wire of a crossing (2): the diagonal of M.
   pure function crossing_qualities(kinematics) result(quality)
      !> Of `contact_kinematics`
      type(contact_kinematics_t), intent(in) :: kinematics
      real(dp) :: quality(2)

      associate (m_inverse => kinematics%between_q)
         quality = [m_inverse(2, 2), m_inverse(1, 1)]/kinematics%squares &
            /(m_inverse(1, 1)*m_inverse(2, 2) - m_inverse(1, 2)*m_inverse(2, 1))
      end associate
   end function crossing_qualities

end module litz_line_kinematics
