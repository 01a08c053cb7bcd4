!> Mechanical residual and tangent of one contact.
!>
!> Source: theory section 5, with the force `F = eps |g|` or any other law: `R_m = -F b`, `b = dg`, and
!> `K_mm = -(dF/dg) b b^T - F d2g`; from the paper's `delta Pi_m` and its linearisation.
module litz_contact_mechanics
   use litz_kinds, only: dp
   use litz_rotations, only: identity3
   use litz_contact_kinematics, only: contact_kinematics_t
   implicit none
   private
   public :: contact_mechanics, mechanical_residual, form_spin, form_hessian

   !> Derivative with respect to spins (unsymmetric), or to the rotation vectors of an increment at zero (symmetric);
   !> see litz_rotation_forms
   integer, parameter :: form_spin = 1, form_hessian = 2

contains

   !> Residual and tangent over the 24 mechanical unknowns of `kinematics`.
   pure subroutine contact_mechanics(kinematics, t, force, stiffness, geometric_force, form, k, r, dforce_dangle)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Nodal unit tangents (3, 4)
      real(dp), intent(in) :: t(3, 4)
      !> Force in the residual [N], pushing the wires apart
      real(dp), intent(in) :: force
      !> -dF/dg [N/m]
      real(dp), intent(in) :: stiffness
      !> Force in the geometric part of the tangent [N]: `force` for the exact tangent; a mixed iteration has its own
      real(dp), intent(in) :: geometric_force
      !> `form_spin` or `form_hessian`
      integer, intent(in) :: form
      !> Tangent (24, 24) and residual (24)
      real(dp), intent(out) :: k(24, 24), r(24)
      !> dF/dangle [N/rad] of the Hertz law: with it the tangent is exact, without it (0) symmetric; what it adds is
      !> smaller than the rest by the ratio of approach to element length
      real(dp), intent(in) :: dforce_dangle
      real(dp) :: left(24, 5), right(24, 5)
      integer :: j

      r = mechanical_residual(kinematics, force)
      call factors_of_tangent(kinematics, stiffness, geometric_force, left, right)
      if (abs(dforce_dangle) > 0) right(:, 5) = right(:, 5) - dforce_dangle*kinematics%rows%dangle
      do j = 1, 24
         k(:, j) = left(:, 1)*right(j, 1) + left(:, 2)*right(j, 2) + left(:, 3)*right(j, 3) + left(:, 4)*right(j, 4) &
            + left(:, 5)*right(j, 5)
      end do
      call add_turning_tangents(kinematics, t, geometric_force, form, k)
   end subroutine contact_mechanics

   !> `R_m = -F b` (24).
   pure function mechanical_residual(kinematics, force) result(r)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> [N], pushing the wires apart
      real(dp), intent(in) :: force
      real(dp) :: r(24)

      r = -force*kinematics%dgap                                                        ! R_m = -F b
   end function mechanical_residual

   !> `stiffness b b^T - F d2g` as the product of two matrices of five columns: B (2), Q (2) and b.
   pure subroutine factors_of_tangent(kinematics, stiffness, geometric_force, left, right)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> -dF/dg [N/m]
      real(dp), intent(in) :: stiffness
      !> Force whose direction changes with the closest points [N]
      real(dp), intent(in) :: geometric_force
      !> (24, 5) each; their product is `left right^T`
      real(dp), intent(out) :: left(24, 5), right(24, 5)
      real(dp) :: from_b(24, 2)

      associate (b => kinematics%rows%b, q => kinematics%rows%q, m_inverse => kinematics%between_q)
         from_b = matmul(b, kinematics%between_b)                                       ! (G^-1 H M^-1) B
         left(:, 1:2) = b
         left(:, 3:4) = q
         left(:, 5) = kinematics%dgap
         right(:, 1:2) = geometric_force*(matmul(q, transpose(kinematics%between_bq)) - from_b)
         right(:, 3:4) = geometric_force*(matmul(b, kinematics%between_bq) + kinematics%distance*matmul(q, m_inverse))
         right(:, 5) = stiffness*kinematics%dgap
      end associate
   end subroutine factors_of_tangent

   !> A nodal tangent turns with its node while the force on it stays: `t f^T - (t.f) 1` on the node's rotation block
   !> in the spin form, its symmetric part in the Hessian form.
   pure subroutine add_turning_tangents(kinematics, t, geometric_force, form, k)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> Unit tangents of the nodes (3, 4): barred 1, barred 2, 1, 2
      real(dp), intent(in) :: t(3, 4)
      !> Force whose direction changes with the closest points [N]
      real(dp), intent(in) :: geometric_force
      !> `form_spin` or `form_hessian`
      integer, intent(in) :: form
      !> Tangent (24, 24), added to
      real(dp), intent(inout) :: k(24, 24)
      real(dp) :: f(3), block(3, 3)
      integer :: node, i, j

      do node = 1, 4
         f = -geometric_force*kinematics%tangent_weight(node)*kinematics%normal
         do j = 1, 3
            block(:, j) = t(:, node)*f(j)
         end do
         if (form == form_hessian) block = (block + transpose(block))/2
         block = block - dot_product(t(:, node), f)*identity3
         i = 6*node - 2
         k(i:i + 2, i:i + 2) = k(i:i + 2, i:i + 2) + block
      end do
   end subroutine add_turning_tangents

end module litz_contact_mechanics
