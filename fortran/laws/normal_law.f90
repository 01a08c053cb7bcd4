!> What a normal law is: the contact force from the gap between the surfaces, the gap from the force, and the energy.
!>
!> Each law is a file `normal_<name>.f90`; litz_normal_laws is the table of all.
module litz_normal_law
   use litz_kinds, only: dp
   use litz_hertz, only: hertz_ellipse_t
   use litz_law_input, only: earlier_dent_t, law_input_t, wire_pair_t, tell
   use litz_law_words, only: law_words_t
   implicit none
   private
   public :: normal_law_t, force_of_gap_t, overlap_of_force_t
   public :: force_at_gap, overlap_at_force, linearise, find_stiffer_penalty

   !> The law at a gap; all 0 where that is open.
   type :: force_of_gap_t
      !> F [N], pushing the wires apart, dF/dg [N/m] (negative in contact), dF/dangle [N/rad]
      real(dp) :: force = 0, dforce_dgap = 0, dforce_dangle = 0
      !> Integral of the force over the overlap [J], and its derivatives by the angle [J/rad, J/rad^2]
      real(dp) :: energy = 0, denergy_dangle = 0, d2energy_dangle2 = 0
      !> What a dent that grows adds to the derivative of the torque denergy/dangle by the overlap, which otherwise is
      !> dF/dangle [N/rad]; then the second derivative above is that of the torque by the angle
      real(dp) :: growth = 0
   end type force_of_gap_t

   !> The law at a force.
   type :: overlap_of_force_t
      !> delta = -g [m], dF/ddelta [N/m] and its derivative with respect to the force [1/m]
      real(dp) :: overlap = 0, stiffness = 0, dstiffness_dforce = 0
      !> The same of the metal around the spot, which stays elastic where that yields; 0: `stiffness` is that
      real(dp) :: elastic_stiffness = 0, delastic_dforce = 0
   end type overlap_of_force_t

   type, extends(law_words_t) :: normal_law_t
      !> The force is a straight line over the gap, which Newton's method follows beyond the touch. Any other law is
      !> linearised about the force, which is an unknown of the iteration
      logical :: is_straight = .false.
      !> Its first number is a stiffness [N/m] that may be raised where wires overlap too much
      logical :: has_penalty = .false.
      !> It holds along a line, too, as the elastic law of litz_line_law, or that of metal that yields
      logical :: is_elastic_line = .false.
      !> Which of its numbers is a stiffness per length [N/m^2] of wires that touch along a line; 0: none
      integer :: line_penalty_number = 0
      !> What is said of it before its numbers, as `Hertz force`
      character(len=40) :: summary = ''
      !> What a law without a penalty is called where wires overlap too much, as `law of Hertz`
      character(len=40) :: title = ''
      !> Yield stress [Pa], 0: the wires are elastic; and hardness [Pa], 0: 2.8 times the yield stress
      real(dp) :: yield_stress = 0, hardness = 0
      procedure(force_of_gap), pointer, nopass :: force_of_gap => null()
      procedure(overlap_of_force), pointer, nopass :: overlap_of_force => null()
   contains
      procedure :: line_penalty
      procedure :: serves_lines
      procedure :: is_per_length_only
      procedure :: yields
      procedure :: called
   end type normal_law_t

   abstract interface
      !> Asked about a gap that is negative.
      pure function force_of_gap(given) result(found)
         import :: law_input_t, force_of_gap_t
         implicit none
         type(law_input_t), intent(in) :: given
         type(force_of_gap_t) :: found
      end function force_of_gap

      !> Asked about a force that is not negative; without one a law that is not straight has no stiffness.
      pure function overlap_of_force(given) result(found)
         import :: law_input_t, overlap_of_force_t
         implicit none
         type(law_input_t), intent(in) :: given
         type(overlap_of_force_t) :: found
      end function overlap_of_force
   end interface

contains

   !> Force, its derivatives and the energy at a gap; all 0 when that is open.
   pure function force_at_gap(law, gap, wires, ellipse, dent) result(found)
      type(normal_law_t), intent(in) :: law
      !> Gap between the surfaces [m], negative in contact
      real(dp), intent(in) :: gap
      type(wire_pair_t), intent(in) :: wires
      !> At the present angle; looked at by laws that use it
      type(hertz_ellipse_t), intent(in) :: ellipse
      !> Of wires that yield; absent: none
      type(earlier_dent_t), intent(in), optional :: dent
      type(force_of_gap_t) :: found
      type(law_input_t) :: given

      if (gap >= 0) return
      call tell(law, wires, ellipse, given, gap=gap)
      call tell_of_yielding(law, given, dent)
      found = law%force_of_gap(given)
   end function force_at_gap

   !> Overlap and stiffness at a force.
   pure function overlap_at_force(law, force, wires, ellipse, dent) result(found)
      type(normal_law_t), intent(in) :: law
      !> Contact force [N]; what is negative counts as 0
      real(dp), intent(in) :: force
      type(wire_pair_t), intent(in) :: wires
      !> At the present angle; looked at by laws that use it
      type(hertz_ellipse_t), intent(in) :: ellipse
      !> Of wires that yield; absent: none
      type(earlier_dent_t), intent(in), optional :: dent
      type(overlap_of_force_t) :: found
      type(law_input_t) :: given

      call tell(law, wires, ellipse, given, force=max(force, 0.0_dp))
      call tell_of_yielding(law, given, dent)
      found = law%overlap_of_force(given)
   end function overlap_at_force

   pure subroutine tell_of_yielding(law, given, dent)
      type(normal_law_t), intent(in) :: law
      type(law_input_t), intent(inout) :: given
      !> Absent: there is none
      type(earlier_dent_t), intent(in), optional :: dent

      given%yield_stress = law%yield_stress
      given%hardness = law%hardness
      if (present(dent)) given%dent = dent
   end subroutine tell_of_yielding

   !> The straight line that an iteration follows: `F = iteration_force - stiffness dg` (theory section 9).
   !>
   !> `delta(F)` is close to a straight line where `F(delta)` is steep, so that a law which is not straight is
   !> linearised about the force that the last iteration predicted. Of a contact that has had no force yet none is
   !> known, and the line goes from there through the touch: the tangent of a law that grows faster than the overlap
   !> would have the contact pull from a third of its overlap on (Hertz), and open though it presses.
   pure subroutine linearise(law, gap, first_overlap, wires, ellipse, mixed_force, stiffness, iteration_force, &
      at_mixed, dent, dent_depth)
      type(normal_law_t), intent(in) :: law
      !> Gap [m], and largest overlap about which a contact is linearised that has had no force [m]
      real(dp), intent(in) :: gap, first_overlap
      type(wire_pair_t), intent(in) :: wires
      type(hertz_ellipse_t), intent(in) :: ellipse
      !> Force that the last iteration predicted [N], not positive: none. What this one is linearised about
      real(dp), intent(inout) :: mixed_force
      !> [N/m], [N]
      real(dp), intent(out) :: stiffness, iteration_force
      !> The law at the overlap with this force; of a straight line, which does not depend on the angle, nothing
      type(force_of_gap_t), intent(out) :: at_mixed
      !> Of wires that yield
      type(earlier_dent_t), intent(in) :: dent
      !> Overlap beyond which they touch in it [m]; 0: there is none
      real(dp), intent(in) :: dent_depth
      type(overlap_of_force_t) :: found
      type(force_of_gap_t) :: at_first
      real(dp) :: first
      logical :: is_first

      if (law%is_straight) then
         found = overlap_at_force(law, 0.0_dp, wires, ellipse)
         stiffness = found%stiffness
         iteration_force = -stiffness*gap
         return
      end if
      is_first = mixed_force <= 0
      if (is_first) then
         first = -dent_depth - first_overlap
         at_first = force_at_gap(law, merge(max(gap, first), first, gap < -dent_depth), wires, ellipse, dent)
         mixed_force = at_first%force
      end if
      found = overlap_at_force(law, mixed_force, wires, ellipse, dent)
      stiffness = found%stiffness
      if (is_first) stiffness = mixed_force/(found%overlap - dent_depth)
      iteration_force = mixed_force + stiffness*(-gap - found%overlap)
      at_mixed = force_at_gap(law, -found%overlap, wires, ellipse, dent)
   end subroutine linearise

   !> eps_l of `f = eps_l |g|` along a line [N/m^2]; 0: it has none.
   pure real(dp) function line_penalty(self)
      class(normal_law_t), intent(in) :: self

      line_penalty = 0
      if (self%line_penalty_number > 0) line_penalty = self%data(self%line_penalty_number)
   end function line_penalty

   !> Wires may touch along lines.
   pure logical function serves_lines(self)
      class(normal_law_t), intent(in) :: self

      serves_lines = self%is_elastic_line .or. self%line_penalty() > 0
   end function serves_lines

   !> What messages call it, as the deck does.
   pure function called(self) result(words)
      class(normal_law_t), intent(in) :: self
      character(len=:), allocatable :: words

      words = trim(self%name)
      if (self%yields()) words = words//' with YIELD'
   end function called

   !> The metal of the wires yields in the spot, which keeps a dent.
   pure logical function yields(self)
      class(normal_law_t), intent(in) :: self

      yields = self%yield_stress > 0
   end function yields

   !> Of wires that cross, it gives the force by the integral over their overlap.
   pure logical function is_per_length_only(self)
      class(normal_law_t), intent(in) :: self

      is_per_length_only = self%line_penalty() > 0 .and. .not. self%data(1) > 0
   end function is_per_length_only

   !> Penalty with which a force would leave a smaller overlap.
   pure subroutine find_stiffer_penalty(law, force, overlap, allowed, along_line, penalty, unit)
      type(normal_law_t), intent(in) :: law
      !> Force [N], overlap that it leaves now, and the smaller one [m]
      real(dp), intent(in) :: force, overlap, allowed
      !> It is a place of wires that touch along a line
      logical, intent(in) :: along_line
      !> 0 for a law that has none
      real(dp), intent(out) :: penalty
      !> Its unit
      character(len=8), intent(out) :: unit

      penalty = 0
      unit = 'N/m'
      if (.not. law%has_penalty) return
      penalty = force/allowed
      if (.not. (along_line .or. law%is_per_length_only())) return
      ! the overlap of wires that cross gets longer with its depth
      penalty = law%line_penalty()*(overlap/allowed)**merge(1.0_dp, 1.5_dp, along_line)
      unit = 'N/m^2'
   end subroutine find_stiffer_penalty

end module litz_normal_law
