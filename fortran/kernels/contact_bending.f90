!> The force by which a contact resists to be bent otherwise: residual and tangent over the 24 mechanical unknowns.
!>
!> The energy of a contact depends on the curvatures `kappa` of both axes: `R = Pi_kappa dkappa`. A curvature changes as
!> its axis bends, as the normal turns, and as the contact moves along it: how the axis bends is taken at a place that
!> stays within an iteration, and what the contact moves from there along curvatures that stay, too. The tangent is
!> found by differences of the residual, for wires at small angles alone, where closest points go far as they turn.
!>
!> Source: theory (10.14b).
module litz_contact_bending
   use litz_kinds, only: dp
   use litz_axis, only: axis_row, axis_shape, on_axis
   use litz_closest_points, only: parallel_sine
   use litz_contact_kinematics, only: contact_kinematics_t, contact_kinematics, kinematics_ok, n_motions
   use litz_rotations, only: cross
   implicit none
   private
   public :: bends_seen_t, contact_bending, risen

   !> Sine of the angle between the axes up to which the tangent counts: beyond it is 1e-5 of that of the contact
   real(dp), parameter :: small_sine = 0.5_dp
   !> Changes for differences: of rotations [rad], and of positions over the length of an element [-]
   real(dp), parameter :: small_change = 1.0e-7_dp

   !> Curvature vectors of both axes as the law sees them, barred first.
   type :: bends_seen_t
      !> At the first node of each element, and how they change up to the second one (3, 2) [1/m]
      real(dp), dimension(3, 2) :: at_first = 0, change = 0
      !> How much force there is on the elements: all but near nodes and kinks (2) [-]; and the
      !> places at which they bend (2)
      real(dp) :: part(2) = 1, place(2) = 0
   end type bends_seen_t

contains

   !> Residual and tangent; the tangent is symmetric.
   pure subroutine contact_bending(kinematics, x, t, length, axis, radius, seen, by_curvature, k, r)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> Radii (2) [m]
      real(dp), intent(in) :: radius(2)
      type(bends_seen_t), intent(in) :: seen
      !> Pi_kappa (2) [J m]
      real(dp), intent(in) :: by_curvature(2)
      !> Tangent (24, 24) and residual (24)
      real(dp), intent(out) :: k(n_motions, n_motions), r(n_motions)
      real(dp), dimension(3, 4) :: moved, turned
      real(dp) :: step, direction(3)
      type(contact_kinematics_t) :: changed
      integer :: node, i, j, info

      r = matmul(rows_of_curvature(kinematics, x, t, length, axis, seen), by_curvature)
      k = 0
      ! of parallel axes the side on which they are is a matter of round-off
      if (sin(kinematics%angle) > small_sine .or. .not. sin(kinematics%angle) > parallel_sine) return
      do node = 1, 4
         do i = 1, 6
            j = 6*(node - 1) + i
            moved = x
            turned = t
            direction = 0
            direction(merge(i, i - 3, i <= 3)) = 1
            if (i <= 3) then
               step = small_change*length(merge(1, 2, node <= 2))
               moved(:, node) = x(:, node) + step*direction
            else
               step = small_change
               turned(:, node) = t(:, node) + step*cross(direction, t(:, node))
            end if
            call contact_kinematics(moved, turned, length, axis, radius, kinematics%xi_bar + step &
               *kinematics%rows%dxi_bar(j), kinematics%xi + step*kinematics%rows%dxi(j), kinematics%side, changed, info)
            if (info /= kinematics_ok) cycle
            k(:, j) = (matmul(rows_of_curvature(changed, moved, turned, length, axis, seen), by_curvature) - r)/step
         end do
      end do
      k = (k + transpose(k))/2
   end subroutine contact_bending

   !> How the curvatures change with the unknowns (24, 2): of the axes at places that stay those of the elements
   !> themselves, so that forces and moments are in balance.
   pure function rows_of_curvature(kinematics, x, t, length, axis, seen) result(rows)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      type(bends_seen_t), intent(in) :: seen
      real(dp) :: rows(n_motions, 2)
      real(dp), dimension(4) :: h, h1, hb, hb1, unused, there, bends, bends_bar
      real(dp), dimension(3) :: x1, xb1

      call axis_shape(axis, length(1), kinematics%xi_bar, hb, hb1, unused)
      call axis_shape(axis, length(2), kinematics%xi, h, h1, unused)
      xb1 = on_axis(hb1, x(:, 1:2), t(:, 1:2))
      x1 = on_axis(h1, x(:, 3:4), t(:, 3:4))
      call axis_shape(axis, length(1), seen%place(1), there, unused, bends_bar)
      call axis_shape(axis, length(2), seen%place(2), there, unused, bends)
      ! over |x'|^2 of axes that do not stretch
      bends_bar = seen%part(1)*bends_bar/(length(1)/2)**2
      bends = seen%part(2)*bends/(length(2)/2)**2
      associate (n => kinematics%normal)
         rows(:, 1) = turned_normal(on_axis(bends_bar, x(:, 1:2), t(:, 1:2)) + seen%change(:, 1) &
            *(risen(kinematics%xi_bar) - risen(seen%place(1)))) &
            + slope_at(kinematics%xi_bar)*dot_product(n, seen%change(:, 1))*kinematics%rows%dxi_bar
         rows(1:12, 1) = rows(1:12, 1) + axis_row(bends_bar, t(:, 1:2), n)
         rows(:, 2) = -turned_normal(on_axis(bends, x(:, 3:4), t(:, 3:4)) + seen%change(:, 2) &
            *(risen(kinematics%xi) - risen(seen%place(2)))) &
            - slope_at(kinematics%xi)*dot_product(n, seen%change(:, 2))*kinematics%rows%dxi
         rows(13:24, 2) = rows(13:24, 2) - axis_row(bends, t(:, 3:4), n)
      end associate

   contains

      !> `v.dn = v.(1 - n n^T)(S dp + xb' dxib - x' dxi)/d`
      pure function turned_normal(v) result(row)
         !> (3)
         real(dp), intent(in) :: v(3)
         real(dp) :: row(n_motions), across(3)

         across = v - dot_product(v, kinematics%normal)*kinematics%normal
         row = [axis_row(hb, t(:, 1:2), across), axis_row(h, t(:, 3:4), -across)]
         row = (row + dot_product(xb1, across)*kinematics%rows%dxi_bar - dot_product(x1, across)*kinematics%rows%dxi) &
            /kinematics%distance
      end function turned_normal

   end function rows_of_curvature

   !> What of the change of a curvature along an element there is at a place, `3 u^2 - 2 u^3` with `u = (1 + xi)/2`: at
   !> nodes, where its slope would have a jump, it has none.
   pure real(dp) function risen(xi)
      !> In the element
      real(dp), intent(in) :: xi

      associate (u => (1 + max(-1.0_dp, min(1.0_dp, xi)))/2)
         risen = u**2*(3 - 2*u)
      end associate
   end function risen

   !> Its derivative by xi.
   pure real(dp) function slope_at(xi)
      !> In the element
      real(dp), intent(in) :: xi

      associate (u => (1 + max(-1.0_dp, min(1.0_dp, xi)))/2)
         slope_at = 3*u*(1 - u)
      end associate
   end function slope_at

end module litz_contact_bending
