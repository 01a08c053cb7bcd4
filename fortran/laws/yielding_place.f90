!> The force per length of metal that yields, at a place of a line: that of a strip along the wires, and in the short
!> lens of a crossing that of its spot.
!>
!> Source: theory section 15. As far as the lens is short its places have, of the elastic force per length at each, the
!> same part: that which the force of the whole crossing is of Hertz's. So all of them together have the force of the
!> crossing, on its way up and back.
module litz_yielding_place
   use litz_kinds, only: dp
   use litz_hertz, only: hertz_ellipse_t
   use litz_line_law, only: line_wires_t, line_force_t, line_force
   use litz_yielding_line, only: yielding_line_t, line_dent_t, line_dent, line_state_t, line_state_at_overlap, &
      returned_by_line, dissipated_by_line, pressure_of_strip
   use litz_yielding_spot, only: yielding_t, dent_t, dent_of_force, yielding_state_t, state_at_overlap
   implicit none
   private
   public :: yielding_place_t, place_state_t, state_of_place, place_force, overlap_of_place, spot_of_place, &
      pressure_of_place

   !> The overlap at a force is known to this part of it
   real(dp), parameter :: tolerance = 1.0e-11_dp
   integer, parameter :: max_iterations = 100
   !> Relative change of the overlap for a difference
   real(dp), parameter :: small_change = 1.0e-5_dp

   type :: yielding_place_t
      !> .false.: the wires are elastic, or there is no place
      logical :: yields = .false.
      type(yielding_line_t) :: strip
      type(line_dent_t) :: strip_dent
      !> How much the strip counts; the crossing in whose lens the place lies has the rest
      real(dp) :: strip_share = 1
      !> The crossing at the angle of the place, and its dent
      type(yielding_t) :: spot
      type(dent_t) :: spot_dent
      !> delta of 1 N of its Hertz ellipse [m], and how much deeper its lens is than the place [m]
      real(dp) :: approach = 0, deeper = 0
   end type yielding_place_t

   !> All 0 where there is no force.
   type :: place_state_t
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
      type(line_force_t) :: elastic

      if (.not. overlap > 0) return
      elastic = line_force(place%strip%line, overlap, 0.0_dp)
      state%strip = strip_at(place, overlap)
      call add_strip(place, elastic, state)
      if (place%strip_share < 1) call add_spot(place, elastic, overlap, state)
   end function state_of_place

   !> The strip.
   pure type(line_state_t) function strip_at(place, overlap) result(strip)
      type(yielding_place_t), intent(in) :: place
      !> [m]
      real(dp), intent(in) :: overlap

      strip = line_state_at_overlap(place%strip, place%strip_dent, overlap)
   end function strip_at

   !> What the strip gives.
   pure subroutine add_strip(place, elastic, state)
      type(yielding_place_t), intent(in) :: place
      !> Law of elastic wires at this overlap
      type(line_force_t), intent(in) :: elastic
      !> With the strip
      type(place_state_t), intent(inout) :: state
      type(line_dent_t) :: made

      associate (strip => state%strip, share => place%strip_share)
         if (.not. place%strip_dent%evenness > 0 .and. elastic%force <= place%strip%force) then
            state%force = share*elastic%force
            state%stiffness = share*elastic%stiffness
            state%elastic_stiffness = state%stiffness
            state%energy = share*elastic%energy
            return
         end if
         if (.not. strip%force > 0) return
         made = place%strip_dent
         if (strip%loads) made = line_dent(place%strip, strip%force)
         state%force = share*strip%force
         state%stiffness = share*strip%stiffness
         state%elastic_stiffness = share*strip%elastic_stiffness
         state%energy = share*returned_by_line(place%strip, made, strip%opening)
         if (strip%loads) state%dissipated = share*(dissipated_by_line(place%strip, made) &
            - dissipated_by_line(place%strip, place%strip_dent))
      end associate
   end subroutine add_strip

   !> What the crossing gives: the part of the elastic force that its own force is of Hertz's.
   pure subroutine add_spot(place, elastic, overlap, state)
      type(yielding_place_t), intent(in) :: place
      !> Law of elastic wires at this overlap
      type(line_force_t), intent(in) :: elastic
      !> [m]
      real(dp), intent(in) :: overlap
      type(place_state_t), intent(inout) :: state
      type(yielding_state_t) :: spot
      real(dp) :: hertz, share, deepest

      share = 1 - place%strip_share
      deepest = overlap + place%deeper
      hertz = (deepest/place%approach)**1.5_dp
      if (.not. place%spot_dent%evenness > 0 .and. hertz <= place%spot%force) then
         state%force = state%force + share*elastic%force
         state%stiffness = state%stiffness + share*elastic%stiffness
         state%elastic_stiffness = state%elastic_stiffness + share*elastic%stiffness
         state%energy = state%energy + share*elastic%energy
         return
      end if
      spot = state_at_overlap(place%spot, place%spot_dent, deepest)
      if (.not. spot%force > 0) return
      associate (part => spot%force/hertz, per_length => share*elastic%force/hertz)
         state%force = state%force + share*part*elastic%force
         state%stiffness = state%stiffness + share*part*elastic%stiffness &
            + per_length*(spot%stiffness - 1.5_dp*spot%force/deepest)
         state%elastic_stiffness = state%elastic_stiffness + share*part*elastic%stiffness &
            + per_length*(2*place%spot%modulus*spot%disc - 1.5_dp*spot%force/deepest)
         state%energy = state%energy + per_length*spot%energy
         state%dissipated = state%dissipated + per_length*dissipated_since(place%spot_dent, spot)
      end associate
   end subroutine add_spot

   !> What making the dent of a spot larger has dissipated [J].
   pure real(dp) function dissipated_since(dent, state) result(lost)
      !> That of before
      type(dent_t), intent(in) :: dent
      type(yielding_state_t), intent(in) :: state

      lost = state%dissipation
      if (dent%evenness > 0) lost = lost - (dent%work - dent%energy)
   end function dissipated_since

   !> The same as the law of elastic wires has it.
   pure type(line_force_t) function place_force(place, line, overlap, penalty) result(law)
      type(yielding_place_t), intent(in) :: place
      !> Of elastic wires
      type(line_wires_t), intent(in) :: line
      !> [m], and eps_l [N/m^2]; 0: the elastic law
      real(dp), intent(in) :: overlap, penalty
      type(place_state_t) :: state

      if (.not. place%yields) then
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
      high = max(place%strip_dent%overlap, 2*force/place%strip%line%modulus)
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

   !> Pressure in the middle of strip and spot at an overlap [Pa].
   pure real(dp) function pressure_of_place(place, overlap) result(pressure)
      type(yielding_place_t), intent(in) :: place
      !> [m]
      real(dp), intent(in) :: overlap
      type(line_state_t) :: strip
      type(line_dent_t) :: dent
      type(yielding_state_t) :: spot

      strip = line_state_at_overlap(place%strip, place%strip_dent, overlap)
      dent = place%strip_dent
      if (strip%opening >= 1) dent = line_dent(place%strip, strip%force)
      pressure = place%strip_share*pressure_of_strip(dent, strip)
      if (.not. place%strip_share < 1) return
      spot = state_at_overlap(place%spot, place%spot_dent, overlap + place%deeper)
      pressure = pressure + (1 - place%strip_share)*spot%pressure
   end function pressure_of_place

   !> The crossing in whose lens a place lies, which has been pressed as deep as this.
   pure subroutine spot_of_place(ellipse, deepest, deeper, place)
      !> At the angle of the place
      type(hertz_ellipse_t), intent(in) :: ellipse
      !> Deepest overlap so far, and how much deeper the lens is than the place now [m]
      real(dp), intent(in) :: deepest, deeper
      !> With the law of the spot
      type(yielding_place_t), intent(inout) :: place
      type(yielding_state_t) :: made

      place%approach = ellipse%approach
      place%deeper = deeper
      if (.not. deepest > 0) return
      made = state_at_overlap(place%spot, dent_t(), deepest)
      place%spot_dent = dent_of_force(place%spot, made%force)
   end subroutine spot_of_place

end module litz_yielding_place
