!> On which side of each other two crossing wires are: a fact of converged states, never of iterates.
!>
!> Two axes that cross are left-handed or right-handed: the sign of `w . (x' x xb')`, `w = xb - x`, with both tangents
!> along their wires. Every motion keeps it but two: axes that pass each other, and axes that turn through the
!> parallel. Near the parallel the line from one axis to the other is compared instead.
module litz_contact_side
   use litz_kinds, only: dp
   use litz_contact_kinematics, only: contact_kinematics_t
   implicit none
   private
   public :: crossing_t, crossing_of, have_passed, have_kept

   !> Crossings with a sine below this may have turned through the parallel (30 degrees)
   real(dp), parameter :: shallow_sine = 0.5_dp
   !> Cosine of the largest turn of normal and angle that shows a crossing to be the same as before (60 degrees)
   real(dp), parameter :: small_turn = 0.5_dp

   !> What distinguishes a crossing of two wires from its mirror image, and where it is.
   type :: crossing_t
      logical :: known = .false.
      !> +1, -1: right-handed, left-handed, with both tangents along their wires; 0: at an end or a kink, which has no
      !> hand
      integer :: hand = 0
      !> Unit normal from the unbarred to the barred wire
      real(dp) :: normal(3) = 0
      !> Angle between the axes, both along their wires [rad]
      real(dp) :: angle = 0
      !> Arc lengths along the barred and the unbarred wire (2) [m]
      real(dp) :: arc(2) = 0
   end type crossing_t

contains

   !> The crossing with the orientation that its kinematics have.
   pure type(crossing_t) function crossing_of(kinematics, direction, arc, is_at_end) result(crossing)
      type(contact_kinematics_t), intent(in) :: kinematics
      !> +1: the element runs along its wire, -1: against it; barred, unbarred (2)
      integer, intent(in) :: direction(2)
      !> Arc lengths along the barred and the unbarred wire (2) [m]
      real(dp), intent(in) :: arc(2)
      !> One of the wires touches with its end or at a kink
      logical, intent(in) :: is_at_end

      crossing%known = .true.
      if (.not. is_at_end) crossing%hand = kinematics%side*product(direction)
      crossing%normal = kinematics%normal
      crossing%angle = kinematics%angle
      if (product(direction) < 0) crossing%angle = acos(-1.0_dp) - kinematics%angle
      crossing%arc = arc
   end function crossing_of

   !> Whether the axes have gone through each other since: no, if nothing is known of how they were.
   pure logical function have_passed(before, now)
      type(crossing_t), intent(in) :: before, now

      have_passed = .false.
      if (.not. before%known) return
      if (min(sin(before%angle), sin(now%angle)) < shallow_sine .or. before%hand*now%hand == 0) then
         have_passed = dot_product(before%normal, now%normal) < 0
      else
         have_passed = before%hand /= now%hand
      end if
   end function have_passed

   !> Whether two states show the same crossing beyond doubt: the same hand, after small turns only.
   pure logical function have_kept(before, now)
      type(crossing_t), intent(in) :: before, now

      have_kept = before%known .and. now%known .and. dot_product(before%normal, now%normal) > small_turn
      if (before%hand*now%hand == 0) return
      have_kept = have_kept .and. before%hand == now%hand .and. cos(before%angle - now%angle) > small_turn
   end function have_kept

end module litz_contact_side
