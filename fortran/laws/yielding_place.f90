!> The force per length of metal that yields, at a place of a line.
!>
!> Source: theory section 15. All places in a short lens together have the force of the crossing.
module litz_yielding_place
   use litz_kinds, only: dp
   use litz_line_law, only: line_wires_t, line_force_t, line_force
   use litz_yielding_line, only: yielding_line_t, line_dent_t, line_dent, line_state_t, line_state_at_overlap, &
      returned_by_line, dissipated_by_line, pressure_of_strip
   implicit none
   private
   public :: yielding_place_t, place_state_t, state_of_place, force_of_place, place_force, overlap_of_place, &
      pressure_of_place

   !> The overlap at a force is known to this part of it
   real(dp), parameter :: tolerance = 1.0e-11_dp
   integer, parameter :: max_iterations = 100
   !> Relative change of the overlap for a difference
   real(dp), parameter :: small_change = 1.0e-5_dp

   type :: yielding_place_t
      type(yielding_line_t) :: strip
      type(line_dent_t) :: dent
   end type yielding_place_t

   !> All 0 where there is no force.
   type :: place_state_t
      !> The metal has not yielded
      logical :: is_elastic = .false.
      !> f [N/m], df/ddelta [N/m^2], and that of the metal around the spot, which stays elastic
      real(dp) :: force = 0, stiffness = 0, elastic_stiffness = 0
      !> What comes back, and what has been dissipated since the dents were made [J/m]
      real(dp) :: energy = 0, dissipated = 0
      !> Of the strip
      type(line_state_t) :: strip
   end type place_state_t

contains

   !> The law at an overlap.
   pure type(place_state_t) function state_of_place(place, overlap) result(state)
      type(yielding_place_t), intent(in) :: place
      !> delta [m]
      real(dp), intent(in) :: overlap
      type(line_dent_t) :: made

      state = force_of_place(place, overlap)
      if (state%is_elastic .or. .not. state%force > 0) return
      associate (strip => state%strip)
         made = place%dent
         if (strip%loads) made = line_dent(place%strip, strip%force)
         state%energy = returned_by_line(place%strip, made, strip%opening)
         if (strip%loads) state%dissipated = dissipated_by_line(place%strip, place%dent, made)
      end associate
   end function state_of_place

   !> The law at an overlap without the energies of metal that yields, which take longer.
   pure type(place_state_t) function force_of_place(place, overlap) result(state)
      type(yielding_place_t), intent(in) :: place
      !> delta [m]
      real(dp), intent(in) :: overlap
      type(line_force_t) :: elastic

      if (.not. overlap > 0) return
      state%strip = line_state_at_overlap(place%strip, place%dent, overlap)
      elastic = line_force(place%strip%line, overlap, 0.0_dp)
      state%is_elastic = .not. place%dent%yielded .and. elastic%force <= place%strip%onset
      if (state%is_elastic) then
         ! what has not yielded has the force of elastic wires, to the last digit
         state%force = elastic%force
         state%stiffness = elastic%stiffness
         state%elastic_stiffness = elastic%stiffness
         state%energy = elastic%energy
      else if (state%strip%force > 0) then
         state%force = state%strip%force
         state%stiffness = state%strip%stiffness
         state%elastic_stiffness = state%strip%elastic_stiffness
      end if
   end function force_of_place

   !> The same as the law of elastic wires has it.
   pure type(line_force_t) function place_force(place, line, overlap, penalty) result(law)
      !> Not present: the wires are elastic
      type(yielding_place_t), intent(in), optional :: place
      !> Of elastic wires
      type(line_wires_t), intent(in) :: line
      !> [m], and eps_l [N/m^2]; 0: the elastic law
      real(dp), intent(in) :: overlap, penalty
      type(place_state_t) :: state

      if (.not. present(place)) then
         law = line_force(line, overlap, penalty)
         return
      end if
      state = state_of_place(place, overlap)
      law%force = state%force
      law%stiffness = state%stiffness
      law%energy = state%energy
      law%too_wide = state%strip%too_wide
   end function place_force

   !> The overlap at a force per length, by Newton's method between bounds, with the stiffness of the elastic metal and
   !> how that changes with the force.
   pure subroutine overlap_of_place(place, force, overlap, state, delastic_dforce)
      type(yielding_place_t), intent(in) :: place
      !> [N/m]
      real(dp), intent(in) :: force
      !> [m]
      real(dp), intent(out) :: overlap
      type(place_state_t), intent(out) :: state
      !> [1/m]
      real(dp), intent(out) :: delastic_dforce
      type(place_state_t) :: below
      real(dp) :: low, high
      integer :: i

      delastic_dforce = 0
      low = 0
      high = max(place%dent%overlap, 2*force/place%strip%line%modulus)
      do i = 1, max_iterations
         state = state_of_place(place, high)
         if (state%force >= force) exit
         low = high
         high = 2*high
      end do
      overlap = high
      do i = 1, max_iterations
         if (state%force >= force) high = overlap
         if (state%force < force) low = overlap
         if (high - low <= tolerance*high .or. abs(state%force - force) <= tolerance*force) exit
         if (state%stiffness > 0) overlap = overlap + (force - state%force)/state%stiffness
         if (.not. (overlap > low .and. overlap < high)) overlap = (low + high)/2
         state = state_of_place(place, overlap)
      end do
      below = state_of_place(place, overlap*(1 - small_change))
      if (state%force > below%force) delastic_dforce = (state%elastic_stiffness - below%elastic_stiffness) &
         /(state%force - below%force)
   end subroutine overlap_of_place

   !> Pressure in the middle of the strip at an overlap [Pa].
   pure real(dp) function pressure_of_place(place, overlap) result(pressure)
      type(yielding_place_t), intent(in) :: place
      !> [m]
      real(dp), intent(in) :: overlap
      type(line_state_t) :: strip
      type(line_dent_t) :: dent

      strip = line_state_at_overlap(place%strip, place%dent, overlap)
      dent = place%dent
      if (strip%opening >= 1) dent = line_dent(place%strip, strip%force)
      pressure = pressure_of_strip(dent, strip)
   end function pressure_of_place

end module litz_yielding_place
