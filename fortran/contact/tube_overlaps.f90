!> How far two elements, as tubes, overlap at a place of each.
module litz_tube_overlaps
   use litz_kinds, only: dp
   use litz_axis, only: axis_shape, on_axis
   use litz_contact_points, only: axis_of_pair
   use litz_element_library, only: elements_t
   use litz_model, only: model_t
   use litz_wires, only: wires_t
   implicit none
   private
   public :: tube_overlap_t, overlap_at, overlap_of_reference, unseen_overlap

   !> Overlap without a contact that is round-off, over the smaller radius
   real(dp), parameter :: unseen_overlap = 1.0e-6_dp

   type :: tube_overlap_t
      !> In the barred and the unbarred element, in [-1, 1] (2)
      real(dp) :: place(2) = 0
      !> From the unbarred to the barred axis [m]
      real(dp) :: line(3) = 0
      !> Derivatives of the axes with respect to the places, barred first (3, 2) [m]
      real(dp) :: tangent(3, 2) = 0
      !> Over the smaller radius; negative: none
      real(dp) :: depth = 0
   end type tube_overlap_t

contains

   !> The overlap of two tubes.
   pure type(tube_overlap_t) function overlap_at(axis, radius, x, t, length, place) result(overlap)
      !> Axis that the law sees
      integer, intent(in) :: axis
      !> Radii (2), nodal positions (3, 4) [m], tangents (3, 4), reference lengths (2) [m], and places (2), barred first
      real(dp), intent(in) :: radius(2), x(3, 4), t(3, 4), length(2), place(2)
      real(dp), dimension(4) :: h, h1, h2

      overlap%place = place
      call axis_shape(axis, length(1), place(1), h, h1, h2)
      overlap%line = on_axis(h, x(:, 1:2), t(:, 1:2))
      overlap%tangent(:, 1) = on_axis(h1, x(:, 1:2), t(:, 1:2))
      call axis_shape(axis, length(2), place(2), h, h1, h2)
      overlap%line = overlap%line - on_axis(h, x(:, 3:4), t(:, 3:4))
      overlap%tangent(:, 2) = on_axis(h1, x(:, 3:4), t(:, 3:4))
      overlap%depth = (sum(radius) - norm2(overlap%line))/minval(radius)
   end function overlap_at

   !> The overlap in the reference configuration.
   pure type(tube_overlap_t) function overlap_of_reference(model, wires, elements, candidate, place) result(overlap)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      !> Barred element, unbarred element, contact pair (3)
      integer, intent(in) :: candidate(3)
      !> In [-1, 1] (2)
      real(dp), intent(in) :: place(2)
      real(dp) :: xe(3, 4), t(3, 4)
      integer :: k

      do k = 1, 2
         xe(:, 2*k - 1:2*k) = model%x(:, model%connectivity(:, candidate(k)))
         t(:, 2*k - 1:2*k) = wires%contact_tangents0(:, :, candidate(k))
      end do
      associate (pair => candidate(1:2))
         overlap = overlap_at(axis_of_pair(model, candidate(3)), elements%radius(pair), xe, t, elements%length(pair), &
            place)
      end associate
   end function overlap_of_reference

end module litz_tube_overlaps
