!> The force of a crossing of wires that yield whose lens is long beside the radii: of the spot of crossed wires as far
!> as the lens is short, of the strip along the lens as far as it is long.
!>
!> Source: theory section 15. What is remembered is the largest force of the whole: with the deepest overlap, which had
!> it, every place of the lens had one of its own, which is that of its dent.
module litz_yielding_lens
   use litz_kinds, only: dp
   use litz_hertz, only: hertz_ellipse_t
   use litz_law_input, only: earlier_dent_t
   use litz_lens_law, only: lens_t, lens_force, lens_energy, gauss_depth, gauss_weight, n_depths
   use litz_line_law, only: line_wires_t
   use litz_normal_law, only: force_of_gap_t, overlap_of_force_t
   use litz_yielding_line, only: yielding_line_t, line_dent_t, line_dent, line_state_t, line_state_at_overlap, &
      returned_by_line, dissipated_by_line
   use litz_yielding_place, only: yielding_place_t, pressure_of_place
   use litz_yielding_spot, only: yielding_t, dent_t, dent_of_force, yielding_state_t, state_at_overlap
   implicit none
   private
   public :: yielding_lens_t, lens_state_t, with_dent, state_of_lens, overlap_of_yielding_lens, &
      deepest_strip, pressure_of_lens, lens_at_force, hertz_force

   !> The overlap at a force is known to this part of it
   real(dp), parameter :: tolerance = 1.0e-11_dp
   integer, parameter :: max_iterations = 200
   !> Relative change of the overlap for a difference
   real(dp), parameter :: small_change = 1.0e-5_dp

   type :: yielding_lens_t
      type(yielding_line_t) :: strip
      type(yielding_t) :: spot
      type(hertz_ellipse_t) :: ellipse
      !> Sine of the lens, and how much the strip counts in it
      real(dp) :: sine = 1, strip_share = 1
      !> Deepest overlap so far [m], 0: none, and the dent of the spot then
      real(dp) :: deepest = 0
      type(dent_t) :: dent
      !> Force whose dent is felt [N]
      real(dp) :: felt = 0
   end type yielding_lens_t

   type :: lens_state_t
      !> At this overlap, as the law of a crossing has it
      type(force_of_gap_t) :: law
      !> It differs from the lens of elastic wires
      logical :: has_yielded = .false.
      !> dF/ddelta of the metal around, which stays elastic [N/m]
      real(dp) :: elastic_stiffness = 0
      !> What making the dents larger has dissipated [J]
      real(dp) :: dissipated = 0
      !> The lens of elastic wires, its strips, the dents that they have now, and the spot
      type(lens_t) :: elastic
      type(line_state_t) :: along(n_depths)
      type(line_dent_t) :: dents(n_depths)
      type(yielding_state_t) :: spot
   end type lens_state_t

contains

   !> The lens as if its wires had never touched.
   pure type(yielding_lens_t) function virgin_lens(lens) result(virgin)
      type(yielding_lens_t), intent(in) :: lens

      virgin = lens
      virgin%deepest = 0
      virgin%dent = dent_t()
      virgin%felt = 0
   end function virgin_lens

   !> The lens with the dents that its wires have been pressed to, at the present angle.
   pure type(yielding_lens_t) function with_dent(given, earlier) result(lens)
      !> Whatever its dent
      type(yielding_lens_t), intent(in) :: given
      !> Of the whole contact
      type(earlier_dent_t), intent(in) :: earlier
      type(yielding_state_t) :: spot

      lens = virgin_lens(given)
      lens%felt = earlier%left*earlier%force
      if (.not. lens%felt > 0) return
      if (earlier%overlap < huge(lens%felt)) lens%felt = earlier%left*min(earlier%force, force_of_lens(lens, &
         earlier%overlap))
      lens%deepest = overlap_of_yielding_lens(lens, lens%felt)
      spot = state_at_overlap(lens%spot, dent_t(), lens%deepest)
      lens%dent = dent_of_force(lens%spot, spot%force)
   end function with_dent

   !> Dent of the strip at the deepest place.
   pure type(line_dent_t) function deepest_dent(lens) result(dent)
      type(yielding_lens_t), intent(in) :: lens
      type(line_state_t) :: made

      if (.not. lens%deepest > 0) return
      made = line_state_at_overlap(lens%strip, line_dent_t(), lens%deepest)
      dent = line_dent(lens%strip, made%force)
   end function deepest_dent

   !> The strip at the deepest place.
   pure type(line_state_t) function deepest_strip(lens, overlap) result(strip)
      type(yielding_lens_t), intent(in) :: lens
      !> [m]
      real(dp), intent(in) :: overlap

      strip = line_state_at_overlap(lens%strip, deepest_dent(lens), overlap)
   end function deepest_strip

   !> Pressure in the middle of strip and spot at the deepest place [Pa].
   pure real(dp) function pressure_of_lens(lens, overlap) result(pressure)
      type(yielding_lens_t), intent(in) :: lens
      !> [m]
      real(dp), intent(in) :: overlap
      type(yielding_state_t) :: spot

      pressure = lens%strip_share*pressure_of_place(yielding_place_t(lens%strip, deepest_dent(lens)), overlap)
      if (.not. lens%strip_share < 1) return
      spot = state_at_overlap(lens%spot, lens%dent, overlap)
      pressure = pressure + (1 - lens%strip_share)*spot%pressure
   end function pressure_of_lens

   !> Force, energy and spot at an overlap.
   pure type(lens_state_t) function state_of_lens(lens, overlap) result(state)
      type(yielding_lens_t), intent(in) :: lens
      !> Of the deepest place [m]
      real(dp), intent(in) :: overlap
      type(force_of_gap_t) :: elastic
      real(dp) :: change

      if (.not. overlap > 0) return
      state%elastic = lens_force(lens%strip%line, -overlap, lens%sine, 0.0_dp)
      elastic%force = state%elastic%force
      elastic%dforce_dangle = state%elastic%dforce_dangle
      call lens_energy(lens%strip%line, -overlap, lens%sine, 0.0_dp, elastic%energy, elastic%denergy_dangle, &
         elastic%d2energy_dangle2)
      call add_strip(lens, overlap, elastic, state)
      call add_spot(lens, overlap, elastic, state)
      state%has_yielded = lens%deepest > 0 .and. any(state%dents%yielded) .or. lens%dent%evenness > 0 &
         .or. any(state%along%force > lens%strip%onset) .or. state%spot%dissipation > 0
      ! away from where it begins to load again
      change = small_change*overlap
      if (overlap < lens%deepest) change = -change
      state%law%dforce_dgap = -(4*force_of_lens(lens, overlap + change/2) - force_of_lens(lens, overlap + change) &
         - 3*state%law%force)/change
   end function state_of_lens

   !> Of the deepest place and all others [N].
   pure real(dp) function force_of_lens(lens, overlap) result(force)
      type(yielding_lens_t), intent(in) :: lens
      !> [m]
      real(dp), intent(in) :: overlap
      type(lens_t) :: elastic
      type(yielding_state_t) :: spot
      type(line_state_t) :: along(n_depths)
      type(line_dent_t) :: before(n_depths)

      force = 0
      if (.not. overlap > 0) return
      elastic = lens_force(lens%strip%line, -overlap, lens%sine, 0.0_dp)
      if (lens%strip_share < 1) then
         spot = state_at_overlap(lens%spot, lens%dent, overlap)
         force = (1 - lens%strip_share)*spot%force*elastic%force/hertz_force(lens, overlap)
      end if
      if (.not. lens%strip_share > 0) return
      call find_strips(lens, overlap, elastic, before, along)
      force = force + lens%strip_share*elastic%half_length*dot_product(gauss_weight, along%force)
   end function force_of_lens

   !> The strips along the lens, and the dents that were there.
   pure subroutine find_strips(lens, overlap, elastic, before, along)
      type(yielding_lens_t), intent(in) :: lens
      !> [m]
      real(dp), intent(in) :: overlap
      !> At this overlap
      type(lens_t), intent(in) :: elastic
      type(line_dent_t), intent(out) :: before(n_depths)
      type(line_state_t), intent(out) :: along(n_depths)
      type(line_state_t) :: made
      integer :: i

      do i = 1, n_depths
         if (lens%deepest > 0) then
            made = line_state_at_overlap(lens%strip, line_dent_t(), lens%deepest - overlap*(1 - gauss_depth(i)))
            before(i) = line_dent(lens%strip, made%force)
         end if
         along(i) = line_state_at_overlap(lens%strip, before(i), overlap*gauss_depth(i))
         ! what has not yielded has the force of elastic wires, to the last digit
         if (before(i)%yielded .or. elastic%along(i)%force > lens%strip%onset) cycle
         along(i)%force = elastic%along(i)%force
      end do
   end subroutine find_strips

   pure subroutine add_strip(lens, overlap, elastic, state)
      type(yielding_lens_t), intent(in) :: lens
      !> [m]
      real(dp), intent(in) :: overlap
      !> Law of elastic wires
      type(force_of_gap_t), intent(in) :: elastic
      type(lens_state_t), intent(inout) :: state
      type(line_dent_t) :: before(n_depths)
      real(dp) :: energy, stiffness, weight, force
      integer :: i

      call find_strips(lens, overlap, state%elastic, before, state%along)
      state%dents = before
      if (.not. lens%strip_share > 0) return
      energy = 0
      stiffness = 0
      do i = 1, n_depths
         associate (strip => state%along(i), dent => state%dents(i))
            if (.not. strip%force > 0) cycle
            weight = lens%strip_share*state%elastic%half_length*gauss_weight(i)
            if (strip%loads .or. .not. before(i)%yielded) dent = line_dent(lens%strip, strip%force)
            energy = energy + weight*returned_by_line(lens%strip, dent, merge(strip%opening, 1.0_dp, &
               before(i)%yielded .and. .not. strip%loads))
            if (strip%loads) state%dissipated = state%dissipated + weight*dissipated_by_line(lens%strip, before(i), &
               dent)
            stiffness = stiffness + weight*strip%elastic_stiffness
         end associate
      end do
      force = lens%strip_share*state%elastic%half_length*dot_product(gauss_weight, state%along%force)
      state%elastic_stiffness = stiffness
      state%law%force = force
      state%law%energy = energy
      ! with the angle both change as those of elastic wires do
      state%law%dforce_dangle = force/elastic%force*elastic%dforce_dangle
      state%law%denergy_dangle = energy/elastic%energy*elastic%denergy_dangle
      state%law%d2energy_dangle2 = energy/elastic%energy*elastic%d2energy_dangle2
   end subroutine add_strip

   !> The part of the elastic force that the force of crossed wires is of Hertz's.
   pure subroutine add_spot(lens, overlap, elastic, state)
      type(yielding_lens_t), intent(in) :: lens
      !> [m]
      real(dp), intent(in) :: overlap
      !> Law of elastic wires
      type(force_of_gap_t), intent(in) :: elastic
      type(lens_state_t), intent(inout) :: state
      real(dp) :: hertz, stored, slope, share

      share = 1 - lens%strip_share
      if (.not. share > 0) return
      hertz = hertz_force(lens, overlap)
      stored = 0.4_dp*hertz*overlap
      slope = -1.5_dp*lens%ellipse%dapproach_dangle/lens%ellipse%approach
      state%spot = state_at_overlap(lens%spot, lens%dent, overlap)
      if (.not. state%spot%force > 0) return
      associate (spot => state%spot, law => state%law)
         law%force = law%force + share*spot%force/hertz*elastic%force
         law%dforce_dangle = law%dforce_dangle + share/hertz*(spot%force*elastic%dforce_dangle &
            + (spot%dforce(1) - spot%force*slope)*elastic%force)
         law%energy = law%energy + share*spot%energy/stored*elastic%energy
         law%denergy_dangle = law%denergy_dangle + share/stored*(spot%energy*elastic%denergy_dangle &
            + (spot%torque - spot%energy*slope)*elastic%energy)
         law%d2energy_dangle2 = law%d2energy_dangle2 + share*spot%energy/stored*elastic%d2energy_dangle2
         state%elastic_stiffness = state%elastic_stiffness + share*2*lens%spot%modulus*spot%disc*elastic%force/hertz
         if (.not. spot%loads) return
         state%dissipated = state%dissipated + share*elastic%force/hertz*spot%dissipation
         if (lens%dent%evenness > 0) state%dissipated = state%dissipated &
            - share*elastic%force/hertz*(lens%dent%work - lens%dent%energy)
      end associate
   end subroutine add_spot

   !> Force of elastic crossed wires [N].
   pure real(dp) function hertz_force(lens, overlap) result(force)
      type(yielding_lens_t), intent(in) :: lens
      !> [m]
      real(dp), intent(in) :: overlap

      force = (overlap/lens%ellipse%approach)**1.5_dp
   end function hertz_force

   !> Overlap at a force [m]: by secants between bounds. One that the law of the strip does not reach has its largest.
   pure real(dp) function overlap_of_yielding_lens(lens, force) result(overlap)
      type(yielding_lens_t), intent(in) :: lens
      !> [N]
      real(dp), intent(in) :: force
      real(dp) :: low, high, f_low, f_high, f, largest
      integer :: i, kept

      low = 0
      f_low = -force
      largest = max(lens%deepest, lens%strip%line%max_overlap)
      high = min(largest, max(lens%deepest, lens%ellipse%approach*force**(2.0_dp/3)))
      do
         f_high = force_of_lens(lens, high) - force
         if (f_high >= 0 .or. high >= largest) exit
         low = high
         f_low = f_high
         high = min(largest, 2*high)
      end do
      overlap = high
      if (f_high < 0) return
      kept = 0
      do i = 1, max_iterations
         if (high - low <= tolerance*high .or. abs(f_high) <= tolerance*force) exit
         overlap = high - f_high*(high - low)/(f_high - f_low)
         f = force_of_lens(lens, overlap) - force
         if (abs(f) <= tolerance*force) return
         ! the Illinois rule: an end that has stayed twice counts half
         if (f > 0) then
            high = overlap
            f_high = f
            if (kept > 0) f_low = f_low/2
            kept = 1
         else
            low = overlap
            f_low = f
            if (kept < 0) f_high = f_high/2
            kept = -1
         end if
      end do
      overlap = high
   end function overlap_of_yielding_lens

   !> The lens at a force, with the stiffness of the elastic metal around.
   pure type(overlap_of_force_t) function lens_at_force(lens, force) result(found)
      type(yielding_lens_t), intent(in) :: lens
      !> [N]
      real(dp), intent(in) :: force
      type(lens_state_t) :: state, below

      found%overlap = overlap_of_yielding_lens(lens, force)
      state = state_of_lens(lens, found%overlap)
      below = state_of_lens(lens, (1 - small_change)*found%overlap)
      found%stiffness = -state%law%dforce_dgap
      found%elastic_stiffness = state%elastic_stiffness
      if (state%law%force > below%law%force) found%delastic_dforce = (state%elastic_stiffness &
         - below%elastic_stiffness)/(state%law%force - below%law%force)
   end function lens_at_force

end module litz_yielding_lens
