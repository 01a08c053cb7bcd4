!> Beams whose centroid or shear centre is beside their nodes, or whose principal axes are not those of the section.
!>
!> The axis of the kernel is the line of shear centres, `x_i + d_i`, `d_i = L_i d0` on rigid arms, and its triads are
!> the nodal ones turned to the principal axes. With the spin `delta` the end of an arm moves by
!>
!>     u + delta x d + delta x (delta x d)/2                                                                      (1)
!>
!> Fibres stretch from the centroid, which lies `c` from that axis, along the principal axes 2 and 3:
!>
!>     e1 <- e1 + c3 e5 - c2 e6                                                                                   (2)
!>
!> Section forces and strains that the terms see are those of the kernel with (2): N and moments at the centroid, T and
!> shear forces at the shear centre, all of them along the principal axes; `along_section_axes` turns them.
module litz_beam_axes
   use litz_kinds, only: dp
   use litz_model, only: section_t
   use litz_rotations, only: identity3, skew
   implicit none
   private
   public :: beam_axes_t, beam_axes_of, axis_of_beam, forces_at_nodes, forces_of_axis, add_eccentricity, &
      along_section_axes, along_principal_axes, at_section_centres

   type :: beam_axes_t
      !> Nothing to do: all are at the node, and the principal axes those of the section
      logical :: plain = .true.
      !> Shear centre from the node, and centroid from the shear centre, along the section axes (2) [m]
      real(dp) :: arm(2) = 0, centroid(2) = 0
      !> Centroid from the shear centre, along the principal axes (2) [m]
      real(dp) :: eccentricity(2) = 0
      !> Principal axes as columns, in the section axes
      real(dp) :: turn(2, 2) = reshape([1, 0, 0, 1], [2, 2])
   end type beam_axes_t

contains

   pure type(beam_axes_t) function beam_axes_of(section) result(axes)
      type(section_t), intent(in) :: section

      axes%arm = section%shear_centre
      axes%centroid = section%centroid
      associate (c => cos(section%turn), s => sin(section%turn))
         axes%turn = reshape([c, s, -s, c], [2, 2])
      end associate
      axes%eccentricity = matmul(axes%centroid, axes%turn)
      axes%plain = .not. (any(abs([axes%arm, axes%centroid]) > 0) .or. abs(section%turn) > 0)
   end function beam_axes_of

   !> Ends of the axis of the kernel and its triads, from those of the nodes.
   pure subroutine axis_of_beam(axes, x, triads)
      type(beam_axes_t), intent(in) :: axes
      !> Positions (3, node) [m], and triads (3, axis, node): tangent, first, second section axis
      real(dp), intent(inout) :: x(3, 2), triads(3, 3, 2)
      integer :: side

      if (axes%plain) return
      do side = 1, 2
         x(:, side) = x(:, side) + matmul(triads(:, 2:3, side), axes%arm)
         triads(:, 2:3, side) = matmul(triads(:, 2:3, side), axes%turn)
      end do
   end subroutine axis_of_beam

   !> Section forces whose geometric stiffness the kernel must have for these: (2), transposed.
   pure function forces_of_axis(axes, sigma) result(forces)
      type(beam_axes_t), intent(in) :: axes
      !> N, Q2, Q3, T, M2, M3 at the centroid (6) [N, N m]
      real(dp), intent(in) :: sigma(6)
      !> Moments at the shear centre (6) [N, N m]
      real(dp) :: forces(6)

      forces = sigma
      forces(5:6) = sigma(5:6) + sigma(1)*[axes%eccentricity(2), -axes%eccentricity(1)]
   end function forces_of_axis

   !> The kernel's results for strains along the line of centroids. Source: (2).
   pure subroutine add_eccentricity(axes, length, ea, k, r, energy, section_forces, strain, b)
      type(beam_axes_t), intent(in) :: axes
      !> Reference length [m], axial stiffness [N]
      real(dp), intent(in) :: length, ea
      !> As in the kernels
      real(dp), intent(inout) :: k(12, 12), r(12), energy, section_forces(6), strain(6), b(6, 12)
      real(dp) :: row(12), stretch

      associate (c => axes%eccentricity)
         row = b(1, :) + c(2)*b(5, :) - c(1)*b(6, :)
         stretch = strain(1) + c(2)*strain(5) - c(1)*strain(6)
      end associate
      k = k + length*ea*(spread(row, 2, 12)*spread(row, 1, 12) - spread(b(1, :), 2, 12)*spread(b(1, :), 1, 12))
      r = r + length*ea*(stretch*row - strain(1)*b(1, :))
      energy = energy + length*ea*(stretch**2 - strain(1)**2)/2
      section_forces(1) = ea*stretch
      strain(1) = stretch
      b(1, :) = row
   end subroutine add_eccentricity

   !> The kernel's results for displacements and spins of the nodes. Source: (1).
   pure subroutine forces_at_nodes(axes, triads, force, k, r, b)
      type(beam_axes_t), intent(in) :: axes
      !> Triads of the nodes (3, axis, node)
      real(dp), intent(in) :: triads(3, 3, 2)
      !> Forces on the ends of the axis that the geometric stiffness takes (3, node) [N]
      real(dp), intent(in) :: force(3, 2)
      !> Tangent (12, 12), residual (12), and derivatives of the strains (6, 12), as in the kernels
      real(dp), intent(inout) :: k(12, 12), r(12), b(6, 12)
      real(dp) :: arm(3), by_spin(3, 3)
      integer :: side, u, w

      if (.not. any(abs(axes%arm) > 0)) return
      do side = 1, 2
         arm = matmul(triads(:, 2:3, side), axes%arm)
         by_spin = -skew(arm)
         u = 6*side - 5
         w = u + 3
         b(:, w:w + 2) = b(:, w:w + 2) + matmul(b(:, u:u + 2), by_spin)
         r(w:w + 2) = r(w:w + 2) + matmul(r(u:u + 2), by_spin)
         k(:, w:w + 2) = k(:, w:w + 2) + matmul(k(:, u:u + 2), by_spin)
         k(w:w + 2, :) = k(w:w + 2, :) + matmul(transpose(by_spin), k(u:u + 2, :))
         associate (f => force(:, side))
            k(w:w + 2, w:w + 2) = k(w:w + 2, w:w + 2) - dot_product(arm, f)*identity3 &
               + (spread(arm, 2, 3)*spread(f, 1, 3) + spread(f, 2, 3)*spread(arm, 1, 3))/2
         end associate
      end do
   end subroutine forces_at_nodes

   !> Section forces or strains, from the principal axes to those of the section.
   pure function along_section_axes(axes, values) result(turned)
      type(beam_axes_t), intent(in) :: axes
      !> As N, Q2, Q3, T, M2, M3 (6)
      real(dp), intent(in) :: values(6)
      real(dp) :: turned(6)

      turned = turned_by(axes%turn, values)
   end function along_section_axes

   !> The other way round.
   pure function along_principal_axes(axes, values) result(turned)
      type(beam_axes_t), intent(in) :: axes
      !> As N, Q2, Q3, T, M2, M3 (6)
      real(dp), intent(in) :: values(6)
      real(dp) :: turned(6)

      turned = turned_by(transpose(axes%turn), values)
   end function along_principal_axes

   !> What lies across the axis, turned.
   pure function turned_by(turn, values) result(turned)
      !> Rotation of the section (2, 2)
      real(dp), intent(in) :: turn(2, 2)
      !> As N, Q2, Q3, T, M2, M3 (6)
      real(dp), intent(in) :: values(6)
      real(dp) :: turned(6)

      turned = [values(1), matmul(turn, values(2:3)), values(4), matmul(turn, values(5:6))]
   end function turned_by

   !> Section forces at a node with T at the shear centre and moments at the centroid instead of all at the node.
   pure function at_section_centres(axes, forces) result(moved)
      type(beam_axes_t), intent(in) :: axes
      !> N, Q2, Q3, T, M2, M3 along the section axes (6) [N, N m]
      real(dp), intent(in) :: forces(6)
      real(dp) :: moved(6), centroid(2)

      centroid = axes%arm + axes%centroid
      moved = forces
      moved(4) = forces(4) - axes%arm(1)*forces(3) + axes%arm(2)*forces(2)
      moved(5:6) = forces(5:6) - forces(1)*[centroid(2), -centroid(1)]
   end function at_section_centres

end module litz_beam_axes
