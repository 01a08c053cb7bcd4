!> The distance of a point of a wire's axis from a rigid surface, and how it changes when the wire and the surface move.
!>
!> The distance is signed: negative beyond a plane, inside a cylinder, outside a bore. Unknowns are those of the two
!> nodes of the element (12) and of the reference node of the surface (6): displacements, then spins, of each.
!>
!> The surface moves as a rigid body. With `z` from the reference node to the point, the motion of the point as seen
!> from the surface is, to the second order in the displacements and the rotation vectors of an increment,
!> `a = dx - du - dtheta x z - dtheta x (dx - du) + dtheta x (dtheta x z)/2`, and the distance changes by
!> `n . a + a . H a/2`, with its gradient `n` and its second derivative `H` at a fixed surface.
!> Source: theory section 12.
module litz_rigid_surface
   use litz_kinds, only: dp
   use litz_rotations, only: cross, identity3, skew
   use litz_surface_choices, only: surface_plane, surface_bore
   implicit none
   private
   public :: rigid_surface_t, moved_surface, radial_motion, surface_distance, distance_row, distance_hessian, &
      axis_motion, turn_twice

   !> A surface where it is now.
   type :: rigid_surface_t
      !> One of litz_surface_choices
      integer :: shape = surface_plane
      !> A point of the plane or of the axis [m]
      real(dp) :: point(3) = 0
      !> Unit normal of the plane, towards the wires; unit vector along the axis
      real(dp) :: direction(3) = 0
      !> Of a cylinder or bore [m]
      real(dp) :: radius = 0
      !> The reference node, about which it turns [m]
      real(dp) :: centre(3) = 0
      !> Since the reference
      real(dp) :: rotation(3, 3) = identity3
   end type rigid_surface_t

contains

   !> The surface after a motion of its reference node.
   pure type(rigid_surface_t) function moved_surface(surface, rotation, centre) result(moved)
      !> In the reference configuration
      type(rigid_surface_t), intent(in) :: surface
      !> Rotation of the reference node (3, 3), and where it is now (3) [m]
      real(dp), intent(in) :: rotation(3, 3), centre(3)

      moved = surface
      moved%centre = centre
      moved%rotation = rotation
      moved%point = centre + matmul(rotation, surface%point - surface%centre)
      moved%direction = matmul(rotation, surface%direction)
   end function moved_surface

   !> How far a change of the radius has moved the surface along its normal [m].
   pure real(dp) function radial_motion(before, now)
      !> When the increment began, and now
      type(rigid_surface_t), intent(in) :: before, now

      radial_motion = now%radius - before%radius
      if (now%shape == surface_bore) radial_motion = -radial_motion
   end function radial_motion

   !> Distance, gradient and second derivative at a point; on the axis of a cylinder the gradient is any perpendicular.
   pure subroutine surface_distance(surface, x, distance, normal, hessian)
      type(rigid_surface_t), intent(in) :: surface
      !> The point (3) [m]
      real(dp), intent(in) :: x(3)
      !> [m]
      real(dp), intent(out) :: distance
      !> Unit vector from the surface towards the point (3)
      real(dp), intent(out) :: normal(3)
      !> (3, 3) [1/m]
      real(dp), intent(out), optional :: hessian(3, 3)
      real(dp) :: across(3), rho, e(3), side

      associate (d => surface%direction)
         if (present(hessian)) hessian = 0
         if (surface%shape == surface_plane) then
            normal = d
            distance = dot_product(d, x - surface%point)
            return
         end if
         side = merge(-1.0_dp, 1.0_dp, surface%shape == surface_bore)
         across = (x - surface%point) - d*dot_product(d, x - surface%point)
         rho = norm2(across)
         distance = side*(rho - surface%radius)
         if (rho > epsilon(rho)*surface%radius) then
            normal = side*across/rho
         else
            e = 0
            e(minloc(abs(d), 1)) = 1
            normal = cross(d, e)/norm2(cross(d, e))
            rho = epsilon(rho)*surface%radius
         end if
         e = cross(d, normal)
         if (present(hessian)) hessian = side/rho*spread(e, 2, 3)*spread(e, 1, 3)
      end associate
   end subroutine surface_distance

   !> First derivatives of the distance.
   pure function distance_row(weight, t, z, normal) result(row)
      !> Weights of positions and tangents of the nodes (4), see axis_shape; the tangents (3, 2)
      real(dp), intent(in) :: weight(4), t(3, 2)
      !> From the reference node to the point (3) [m], and the gradient (3)
      real(dp), intent(in) :: z(3), normal(3)
      real(dp) :: row(18)

      row(1:3) = weight(1)*normal
      row(4:6) = weight(2)*cross(t(:, 1), normal)
      row(7:9) = weight(3)*normal
      row(10:12) = weight(4)*cross(t(:, 2), normal)
      row(13:15) = -normal
      row(16:18) = -cross(z, normal)
   end function distance_row

   !> Second derivatives of the distance for incremental rotation vectors.
   pure function distance_hessian(weight, t, z, normal, hessian) result(second)
      !> As in `distance_row`
      real(dp), intent(in) :: weight(4), t(3, 2), z(3), normal(3)
      !> Second derivative at a fixed surface (3, 3) [1/m]
      real(dp), intent(in) :: hessian(3, 3)
      real(dp) :: second(18, 18), motion(3, 18), coupling(18, 3)
      integer :: i, node

      motion = axis_motion(weight, t, z)
      coupling = -matmul(transpose(motion), skew(normal))
      coupling(16:18, :) = 0
      second = matmul(transpose(motion), matmul(hessian, motion))
      second(:, 16:18) = second(:, 16:18) + coupling
      second(16:18, :) = second(16:18, :) + transpose(coupling)
      do node = 1, 2
         i = 6*node - 2
         second(i:i + 2, i:i + 2) = second(i:i + 2, i:i + 2) + weight(2*node)*turn_twice(t(:, node), normal)
      end do
      second(16:18, 16:18) = second(16:18, 16:18) + turn_twice(z, normal)
   end function distance_hessian

   !> How a point of the axis moves relative to the surface.
   pure function axis_motion(weight, t, z) result(motion)
      !> As in `distance_row`
      real(dp), intent(in) :: weight(4), t(3, 2), z(3)
      real(dp) :: motion(3, 18)
      integer :: node

      do node = 1, 2
         motion(:, 6*node - 5:6*node - 3) = weight(2*node - 1)*identity3
         motion(:, 6*node - 2:6*node) = -weight(2*node)*skew(t(:, node))
      end do
      motion(:, 13:15) = -identity3
      motion(:, 16:18) = skew(z)
   end function axis_motion

   !> Second derivative of `n . exp(theta) v`: that of `n . (theta x (theta x v))/2`.
   pure function turn_twice(v, n)
      !> Two vectors (3)
      real(dp), intent(in) :: v(3), n(3)
      real(dp) :: turn_twice(3, 3)

      turn_twice = (spread(v, 2, 3)*spread(n, 1, 3) + spread(n, 2, 3)*spread(v, 1, 3))/2 - dot_product(v, n)*identity3
   end function turn_twice

end module litz_rigid_surface
