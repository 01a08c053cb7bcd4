!> How far the two ends of an element are turned against each other.
!>
!> The beams see the relative rotation of their nodes as the logarithm of a matrix, which jumps at 180 degrees: beyond,
!> an element answers with a smaller rotation the other way round. A state like that is in equilibrium, and wrong. What
!> tells the two apart is the way: the relative rotation of the last converged state, and what the increment adds.
module litz_turned_ends
   use litz_kinds, only: dp, pi
   use litz_iterate, only: iterate_t
   use litz_fields, only: first_slot, last_slot, field_rotation
   use litz_model, only: model_t
   use litz_rotations, only: nearest_rotation_vector, rotation_log
   use litz_text, only: to_text
   use litz_wires, only: wires_t
   implicit none
   private
   public :: turned_ends_t, most_turned_ends

   !> Largest relative rotation of the ends of an element [rad]: 150 degrees, well below where the logarithm jumps
   real(dp), parameter :: max_turn = 150*pi/180

   type :: turned_ends_t
      !> The element whose ends are turned the most
      integer :: element = 0
      !> Relative rotation of its ends [rad]
      real(dp) :: angle = 0
   contains
      procedure :: too_far
      procedure :: describe
   end type turned_ends_t

contains

   !> The element whose ends have come to be turned against each other the most.
   pure type(turned_ends_t) function most_turned_ends(model, wires, rotation_start, iterate) result(most)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      !> Rotations (3, 3, n_nodes) of the last converged state
      real(dp), intent(in) :: rotation_start(:, :, :)
      type(iterate_t), intent(in) :: iterate
      real(dp) :: triads(3, 3, 2), relative(3), turn(3, 2)
      integer :: e

      do e = 1, model%n_elements
         associate (nodes => model%connectivity(:, e))
            triads = triads_of(rotation_start(:, :, nodes), wires%triads0(:, :, :, e))
            relative = rotation_log(matmul(transpose(triads(:, :, 1)), triads(:, :, 2)))
            triads = triads_of(iterate%rotation(:, :, nodes), wires%triads0(:, :, :, e))
            turn = iterate%change(first_slot(field_rotation):last_slot(field_rotation), nodes)
            relative = relative + matmul(turn(:, 2) - turn(:, 1), triads(:, :, 1))
            relative = nearest_rotation_vector(matmul(transpose(triads(:, :, 1)), triads(:, :, 2)), relative)
         end associate
         if (norm2(relative) <= most%angle) cycle
         most%element = e
         most%angle = norm2(relative)
      end do
   end function most_turned_ends

   !> Triads at both ends of an element.
   pure function triads_of(rotation, triads0) result(triads)
      !> Rotations of its nodes (3, 3, 2), and its triads in the reference configuration (3, 3, 2)
      real(dp), intent(in) :: rotation(3, 3, 2), triads0(3, 3, 2)
      real(dp) :: triads(3, 3, 2)
      integer :: side

      do side = 1, 2
         triads(:, :, side) = matmul(rotation(:, :, side), triads0(:, :, side))
      end do
   end function triads_of

   !> No element follows such a rotation.
   pure logical function too_far(self)
      class(turned_ends_t), intent(in) :: self

      too_far = self%angle > max_turn
   end function too_far

   pure function describe(self, model) result(text)
      class(turned_ends_t), intent(in) :: self
      type(model_t), intent(in) :: model
      character(len=:), allocatable :: text

      text = 'the ends of element '//to_text(model%element_id(self%element))//' are rotated relative to each other'// &
         ' by '// &
         to_text(nint(self%angle*180/pi))//' degrees; the limit is 150'
   end function describe

end module litz_turned_ends
