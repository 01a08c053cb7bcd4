!> Forces along the wires, of a contact whose energy changes as it slides next to an end.
!>
!> With the places p along both wires (litz_end_places) and the overlap, the energy has the derivatives `lambda =
!> dPi/dp`: `R = lambda dp` and its tangent. Source: theory section 10.
module litz_sliding_forces
   use litz_kinds, only: dp
   use litz_contact_kinematics, only: n_motions
   use litz_contact_lens, only: ends_of_wires, second_ends
   use litz_contact_points, only: contact_point_t
   use litz_element_library, only: elements_t
   use litz_end_places, only: place_at_end_t, place_rows, place_tangent
   use litz_wires, only: wires_t
   implicit none
   private
   public :: find_sliding

contains

   !> What is along the wires of the residual and the tangent of a contact.
   pure subroutine find_sliding(wires, elements, axis, x, t, length, point, k, r, dforce)
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> `axis_linear` or `axis_hermite`
      integer, intent(in) :: axis
      !> Nodal positions [m] and unit tangents (3, 4), reference lengths of the elements (2) [m]: barred first
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      type(contact_point_t), intent(in) :: point
      !> Tangent (24, 24), Hessian form, and residual (24)
      real(dp), intent(out) :: k(n_motions, n_motions), r(n_motions)
      !> How the normal force changes as the contact slides (24)
      real(dp), intent(out) :: dforce(n_motions)
      type(place_at_end_t) :: ends(2)
      real(dp) :: rows(n_motions, 2)
      integer :: j

      k = 0
      r = 0
      dforce = 0
      if (any(abs(point%ball_slope) > 0)) k = tangent_of_balls()
      if (.not. any(abs(point%slide_force) > 0)) return
      ends = ends_of_wires(wires, elements, axis, point)
      rows = place_rows(x, t, length, axis, point%kinematics, ends)
      dforce = matmul(rows, point%slide_by_overlap)
      r = matmul(rows, point%slide_force)
      k = k + place_tangent(x, t, length, axis, point%kinematics, ends, point%slide_force) &
         + matmul(rows, matmul(point%slide_stiffness, transpose(rows)))
      do j = 1, n_motions
         k(:, j) = k(:, j) - point%kinematics%dgap*dforce(j) - dforce*point%kinematics%dgap(j)
      end do

   contains

      !> The radii change along the wires next to the balls of joints: `F d2r`.
      pure function tangent_of_balls() result(tangent)
         real(dp) :: tangent(n_motions, n_motions), rows(n_motions, 2)
         type(place_at_end_t) :: ends(2)

         ends = second_ends(wires, point)
         rows = place_rows(x, t, length, axis, point%kinematics, ends)
         tangent = place_tangent(x, t, length, axis, point%kinematics, ends, -point%geometric_force*point%ball_slope) &
            + point%geometric_force*matmul(rows*spread(point%ball_bend, 1, n_motions), transpose(rows))
      end function tangent_of_balls

   end subroutine find_sliding

end module litz_sliding_forces
