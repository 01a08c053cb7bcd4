!> Wires that lie side by side: they touch along a line, which point contact does not describe.
module litz_parallel_wires
   use litz_kinds, only: dp, pi
   use litz_straight_segments, only: segment_distance
   use litz_contact_points, only: contact_set_t
   use litz_element_library, only: elements_t
   use litz_line_contact, only: serves_lines
   use litz_model, only: model_t
   use litz_rotations, only: cross
   use litz_text, only: to_text
   implicit none
   private
   public :: shallow_angle, parallel_warning, lie_side_by_side

   !> Below this crossing angle [rad] a point contact does not describe the line in which wires touch
   real(dp), parameter :: shallow_angle = 10*pi/180
   !> Wires are close when their surfaces are nearer than this fraction of the smaller radius
   real(dp), parameter :: close_gap = 0.1_dp

contains

   !> How many candidates lie side by side in the reference configuration; empty: none.
   function parallel_warning(model, elements, contact) result(text)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> With the candidates of the reference configuration
      type(contact_set_t), intent(in) :: contact
      character(len=:), allocatable :: text
      integer :: i, n

      n = 0
      do i = 1, size(contact%candidates, 2)
         if (serves_lines(model, contact%candidates(3, i))) cycle
         associate (pair => contact%candidates(1:2, i))
            if (lie_side_by_side(model, elements, pair(1), pair(2), shallow_angle)) n = n + 1
         end associate
      end do
      text = ''
      if (n > 0) text = to_text(n)//' pairs of elements lie close side by side, at less than 10'// &
         ' degrees; contact along lines is not modelled with their surface interaction, and the run ends where'// &
         ' such wires touch'
   end function parallel_warning

   !> Two elements are close to each other, and nearly parallel, in the reference configuration.
   pure logical function lie_side_by_side(model, elements, a, b, angle)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      !> Two elements
      integer, intent(in) :: a, b
      !> Largest one between them [rad]
      real(dp), intent(in) :: angle
      real(dp) :: distance

      associate (a1 => model%x(:, model%connectivity(1, a)), a2 => model%x(:, model%connectivity(2, a)), &
         b1 => model%x(:, model%connectivity(1, b)), b2 => model%x(:, model%connectivity(2, b)))
         lie_side_by_side = norm2(cross(a2 - a1, b2 - b1)) < sin(angle)*norm2(a2 - a1)*norm2(b2 - b1)
         if (.not. lie_side_by_side) return
         distance = segment_distance(reshape([a1, a2, b1, b2], [3, 4]))
         lie_side_by_side = distance < sum(elements%radius([a, b])) + close_gap*minval(elements%radius([a, b]))
      end associate
   end function lie_side_by_side

end module litz_parallel_wires
