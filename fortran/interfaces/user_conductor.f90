!> The conductor of current along a wire as other finite-element programs want it: two nodes with `ux uy uz v` each.
!>
!> Every model with voltages needs it: beams of other programs conduct no current. The kernel is litz_conductor, whose
!> signs hold here: currents that leave a node are positive, Newton's method solves `k dq = -r`.
module litz_user_conductor
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use litz_kinds, only: dp
   use litz_conductor, only: conductor
   implicit none
   private
   public :: user_conductor, check_user_conductor, n_conductor_unknowns, n_conductor_properties, n_conductor_history
   public :: conductor_reference_length, conductor_present_length, conductor_words_length

   integer, parameter :: n_conductor_unknowns = 8
   !> Properties: cross-section [m^2], resistivity [ohm m]
   integer, parameter :: n_conductor_properties = 2
   !> Results that a host keeps: current from node 1 to node 2 [A], Joule heat [W]
   integer, parameter :: n_conductor_history = 2
   !> Option: conduction over the length before loading, or over the present one
   integer, parameter :: conductor_reference_length = 0, conductor_present_length = 1
   !> Length of what `check_user_conductor` says
   integer, parameter :: conductor_words_length = 100

   !> Places of `ux uy uz` of both nodes, and of their voltages
   integer, parameter :: motions(6) = [1, 2, 3, 5, 6, 7], voltages(2) = [4, 8]

contains

   !> Tangent and residual of one element.
   pure subroutine user_conductor(coordinates, u, properties, option, history, k, r)
      !> Positions of the nodes before loading (3, 2) [m]
      real(dp), intent(in) :: coordinates(3, 2)
      !> Displacements [m] and voltages [V] (4, 2), totals
      real(dp), intent(in) :: u(4, 2)
      !> Properties (`n_conductor_properties`)
      real(dp), intent(in) :: properties(:)
      !> `conductor_reference_length` or `conductor_present_length`
      integer, intent(in) :: option
      !> Results (`n_conductor_history`)
      real(dp), intent(out) :: history(:)
      !> Tangent (8, 8) and residual (8): currents leaving the nodes [A]; the rows of the motions are 0
      real(dp), intent(out) :: k(8, 8), r(8)
      real(dp) :: k_ee(2, 2), r_e(2), k_me(2, 6)

      call conductor(coordinates + u(1:3, :), u(4, :), norm2(coordinates(:, 2) - coordinates(:, 1)), properties(1), &
         properties(2), option == conductor_present_length, k_ee, r_e, k_me, history(1), history(2))
      k = 0
      r = 0
      k(voltages, voltages) = k_ee
      k(voltages, motions) = k_me
      r(voltages) = r_e
   end subroutine user_conductor

   !> What is wrong with the input of an element, for the host to say; blank: nothing.
   pure function check_user_conductor(coordinates, properties, option) result(words)
      !> Positions of the nodes before loading (3, 2) [m]
      real(dp), intent(in) :: coordinates(3, 2)
      !> Properties (`n_conductor_properties`)
      real(dp), intent(in) :: properties(:)
      !> As of `user_conductor`
      integer, intent(in) :: option
      character(len=conductor_words_length) :: words

      words = ''
      if (size(properties) < n_conductor_properties) then
         words = 'fewer than 2 real properties: cross-section, resistivity'
      else if (.not. is_positive(properties(1))) then
         words = 'property 1, the cross-section of the conductor, must be greater than 0'
      else if (.not. is_positive(properties(2))) then
         words = 'property 2, the resistivity of the conductor, must be greater than 0'
      else if (all(option /= [conductor_reference_length, conductor_present_length])) then
         words = 'option 1, the length, must be 0 (before loading) or 1 (present)'
      else if (.not. norm2(coordinates(:, 2) - coordinates(:, 1)) > 0) then
         words = 'the two nodes of the conductor coincide'
      end if
   end function check_user_conductor

   !> Greater than zero, and neither infinite nor no number.
   pure logical function is_positive(value)
      !> Any
      real(dp), intent(in) :: value

      is_positive = .false.
      if (ieee_is_finite(value)) is_positive = value > 0
   end function is_positive

end module litz_user_conductor
