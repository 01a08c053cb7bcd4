!> The lens of elastic wires as the law of a crossing, and its overlap at a force.
module litz_lens_forces
   use litz_kinds, only: dp
   use litz_lens_law, only: lens_t, lens_force, lens_energy
   use litz_line_law, only: line_wires_t
   use litz_normal_law, only: force_of_gap_t
   implicit none
   private
   public :: law_of_lens, find_overlap_of_lens

   !> The overlap of a lens at a force is found when its logarithm changes by less than this; steps at most
   real(dp), parameter :: tolerance = 1.0e-9_dp
   integer, parameter :: max_iterations = 20

contains

   !> A lens as the law of a crossing.
   pure type(force_of_gap_t) function law_of_lens(line, lens, gap, sine, penalty) result(law)
      type(line_wires_t), intent(in) :: line
      type(lens_t), intent(in) :: lens
      !> Of its deepest place [m], sine of the lens, and eps_l [N/m^2] or 0
      real(dp), intent(in) :: gap, sine, penalty

      law = force_of_gap_t(lens%force, lens%dforce_dgap, lens%dforce_dangle)
      call lens_energy(line, gap, sine, penalty, law%energy, law%denergy_dangle, law%d2energy_dangle2)
   end function law_of_lens

   !> The overlap of a lens at a force, by Newton's method in their logarithms, between which there is nearly a straight
   !> line.
   pure subroutine find_overlap_of_lens(line, sine, penalty, force, start, overlap, lens)
      type(line_wires_t), intent(in) :: line
      !> Sine of the lens, eps_l [N/m^2] or 0, force [N], and an overlap to start from [m]
      real(dp), intent(in) :: sine, penalty, force, start
      !> [m]
      real(dp), intent(out) :: overlap
      !> The lens at this overlap
      type(lens_t), intent(out) :: lens
      real(dp) :: step
      integer :: iteration

      overlap = start
      lens = lens_force(line, -overlap, sine, penalty)
      do iteration = 1, max_iterations
         step = log(force/lens%force)*lens%force/(-lens%dforce_dgap*overlap)
         ! the lens is no longer than the wires are apart
         overlap = min(overlap*exp(step), 0.5_dp*sum(line%radius))
         lens = lens_force(line, -overlap, sine, penalty)
         if (abs(step) < tolerance) exit
      end do
   end subroutine find_overlap_of_lens

end module litz_lens_forces
