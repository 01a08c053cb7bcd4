!> The torque of a contact whose energy depends on the angle between the wires: residual and exact tangent over the 24
!> mechanical unknowns.
!>
!> Source: theory (5.1a). With the energy `Pi(g, psi)` of the contact, `F = -dPi/dg`, the angle has the residual
!> `R = Pi_psi dpsi` and the tangent
!> `K = Pi_psipsi dpsi^T dpsi - F_psi dpsi^T dg + Pi_psi d2psi`; the other half of the mixed derivative,
!> `-F_psi dg^T dpsi`, is in the tangent of the normal force.
!>
!> The angle follows the derivatives `a = x'` and `b = xb'` of the axes. With the unit vectors `e` along a and `u`
!> towards b, perpendicular to it in their plane, `dpsi/da = -u/|a|` and
!> `d2psi/da2 = (e u^T + u e^T + cot(psi) n n^T)/|a|^2`, likewise for b, and `d2psi/dadb = -n n^T/(|a| |b| sin(psi))`.
module litz_contact_turning
   use litz_kinds, only: dp
   use litz_rotations, only: cross
   use litz_axis, only: axis_row
   use litz_closest_points, only: parallel_sine
   use litz_closest_point_motion, only: axis_point_t, axis_point, tangent_of_closest_points, add_turning_tangent
   use litz_contact_kinematics, only: contact_kinematics_t, n_motions
   use litz_contact_mechanics, only: form_hessian
   implicit none
   private
   public :: contact_turning, turning_residual, turning_t

   !> Energy of a contact by the angle between the axes.
   type :: turning_t
      !> Pi_psi [J/rad], Pi_psipsi [J/rad^2] and F_psi [N/rad]
      real(dp) :: denergy = 0, d2energy = 0, dforce = 0
      !> What a dent that grows with the force adds to F_psi as the derivative of the torque by the overlap [N/rad]
      real(dp) :: growth = 0
   end type turning_t

   !> One axis at its closest point, as the angle sees it.
   type :: turning_axis_t
      !> Derivative of the angle with respect to that of the axis (3) [1/m]
      real(dp) :: slope(3) = 0
      !> How the derivative of the axis changes along itself, towards the other axis, and along the normal, over its
      !> length (24) [per unknown]
      real(dp), dimension(n_motions) :: along = 0, towards = 0, out = 0
      !> Product of `slope` with the mixed derivative of the axis by the unknowns and the place (24)
      real(dp) :: mixed(n_motions) = 0
   end type turning_axis_t

contains

   !> Residual and tangent of the angle; zero tangents of parallel wires, whose angle has no derivative.
   pure subroutine contact_turning(kinematics, x, t, length, axis, turning, form, k, r)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      type(turning_t), intent(in) :: turning
      !> `form_spin` or `form_hessian` of litz_contact_mechanics
      integer, intent(in) :: form
      !> Tangent (24, 24) and residual (24)
      real(dp), intent(out) :: k(n_motions, n_motions), r(n_motions)
      integer :: j

      r = turning_residual(kinematics, turning)
      k = 0
      if (.not. any(abs(kinematics%rows%dangle) > 0)) return
      associate (fixed => kinematics%fixed_share)
         if (fixed < 1) call add_second_variation(kinematics, x, t, length, axis, .false., (1 - fixed) &
            *turning%denergy, k)
         if (fixed > 0) call add_second_variation(kinematics, x, t, length, axis, .true., fixed*turning%denergy, k)
      end associate
      if (form == form_hessian) k = (k + transpose(k))/2
      do j = 1, n_motions
         k(:, j) = k(:, j) + kinematics%rows%dangle*(turning%d2energy*kinematics%rows%dangle(j) &
            - (turning%dforce + turning%growth)*kinematics%dgap(j))
      end do
   end subroutine contact_turning

   !> Residual of the angle (24).
   pure function turning_residual(kinematics, turning) result(r)
      type(contact_kinematics_t), intent(in) :: kinematics
      type(turning_t), intent(in) :: turning
      real(dp) :: r(n_motions)

      r = turning%denergy*kinematics%rows%dangle                                                ! R = Pi_psi dpsi
   end function turning_residual

   !> `moment d2psi` in the spin form.
   pure subroutine add_second_variation(kinematics, x, t, length, axis, is_fixed, moment, k)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Nodal positions [m] and unit tangents (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: x(3, 4), t(3, 4)
      !> Reference lengths (2) [m]: barred, unbarred
      real(dp), intent(in) :: length(2)
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> Of the angle at its fixed places
      logical, intent(in) :: is_fixed
      !> Pi_psi [J/rad]
      real(dp), intent(in) :: moment
      !> Tangent (24, 24), added to
      real(dp), intent(inout) :: k(n_motions, n_motions)
      type(axis_point_t) :: a, b
      type(turning_axis_t) :: of_a, of_b
      real(dp), dimension(n_motions, 10) :: left, right
      real(dp) :: no_change(n_motions, 2), xi(n_motions), xi_bar(n_motions), places(2), cotangent, sine
      integer :: i

      places = [kinematics%xi_bar, kinematics%xi]
      xi = kinematics%rows%dxi
      xi_bar = kinematics%rows%dxi_bar
      if (is_fixed) then
         places = kinematics%angle_at
         xi = 0
         xi_bar = 0
      end if
      a = axis_point(axis, length(2), places(2), x(:, 3:4), t(:, 3:4))
      b = axis_point(axis, length(1), places(1), x(:, 1:2), t(:, 1:2))
      sine = norm2(cross(a%x(:, 1), b%x(:, 1)))/(norm2(a%x(:, 1))*norm2(b%x(:, 1)))
      if (.not. sine > parallel_sine) return
      of_a = turning_axis(kinematics%normal, a, b%x(:, 1), t(:, 3:4), 12, xi)
      of_b = turning_axis(kinematics%normal, b, a%x(:, 1), t(:, 1:2), 0, xi_bar)
      cotangent = dot_product(a%x(:, 1), b%x(:, 1))/(norm2(a%x(:, 1))*norm2(b%x(:, 1))*sine)
      left = reshape([of_a%along, of_a%towards, of_a%out, of_a%mixed, xi, &
         of_b%along, of_b%towards, of_b%out, of_b%mixed, xi_bar], shape(left))
      right = reshape([of_a%towards, of_a%along, cotangent*of_a%out - of_b%out/sine, xi, &
         of_a%mixed + dot_product(of_a%slope, a%x(:, 3))*xi, &
         of_b%towards, of_b%along, cotangent*of_b%out - of_a%out/sine, xi_bar, &
         of_b%mixed + dot_product(of_b%slope, b%x(:, 3))*xi_bar], shape(right))
      k = k + moment*matmul(left, transpose(right))
      do i = 1, 2
         call add_turning_tangent(t(:, i), moment*b%h(2*i, 1)*of_b%slope, 6*i - 2, k)
         call add_turning_tangent(t(:, 2 + i), moment*a%h(2*i, 1)*of_a%slope, 12 + 6*i - 2, k)
      end do
      if (is_fixed) return
      no_change = 0
      k = k + tangent_of_closest_points(kinematics, a, b, t, moment*[dot_product(of_a%slope, a%x(:, 2)), &
         dot_product(of_b%slope, b%x(:, 2))], no_change)
   end subroutine add_second_variation

   !> What the angle feels of one axis.
   pure type(turning_axis_t) function turning_axis(normal, a, other, t, first, dxi) result(found)
      !> Of the contact (3)
      real(dp), intent(in) :: normal(3)
      type(axis_point_t), intent(in) :: a
      !> Derivative of the other axis (3) [m]
      real(dp), intent(in) :: other(3)
      !> Unit tangents of its nodes (3, 2)
      real(dp), intent(in) :: t(3, 2)
      !> Unknowns before those of its nodes
      integer, intent(in) :: first
      !> How its place moves (24); 0: it stays
      real(dp), intent(in) :: dxi(n_motions)
      real(dp), dimension(3) :: e, eb, u
      real(dp) :: size_of_a

      size_of_a = norm2(a%x(:, 1))
      e = a%x(:, 1)/size_of_a
      eb = other/norm2(other)
      u = eb - dot_product(eb, e)*e
      u = u/norm2(u)
      found%slope = -u/size_of_a                                                           ! dpsi/da
      found%along = change_along(e)
      found%towards = change_along(u)
      found%out = change_along(normal)
      found%mixed(first + 1:first + 12) = axis_row(a%h(:, 2), t, found%slope)

   contains

      pure function change_along(direction) result(row)
         !> Unit vector (3)
         real(dp), intent(in) :: direction(3)
         real(dp) :: row(n_motions)

         row = dot_product(direction, a%x(:, 2))*dxi
         row(first + 1:first + 12) = row(first + 1:first + 12) + axis_row(a%h(:, 1), t, direction)
         row = row/size_of_a
      end function change_along

   end function turning_axis

end module litz_contact_turning
