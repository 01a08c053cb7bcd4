!> What wires that yield conduct along lines, and in lenses whose section counts.
!>
!> Source: theory section 15; the rest is that of elastic wires, (10.23) and (10.26).
module litz_yielded_cells
   use litz_kinds, only: dp, pi
   use litz_contact_blocks, only: spot_in_circuit_t
   use litz_contact_points, only: contact_point_t
   use litz_law_input, only: wire_pair_t
   use litz_lens_law, only: gauss_weight, lens_spot, lens_spot_t, n_depths
   use litz_line_cell, only: cell_samples_t, cell_samples, cell_integral, line_cell_t, n_of_cell, n_samples
   use litz_line_kinematics, only: line_course_t
   use litz_line_law, only: line_spot_t
   use litz_model, only: interaction_t
   use litz_normal_forces, only: weight_of_lens
   use litz_spot_law, only: contact_spot_t
   use litz_spot_resistance, only: metal_of_law, set_conductance
   use litz_spots_of_places, only: number_of
   use litz_yielding_lens, only: yielding_lens_t, lens_state_t, deepest_strip, hertz_force, state_of_lens
   use litz_yielding_line, only: line_dent_t, line_dent, line_state_t, line_state_at_overlap, yielded_strip
   use litz_yielding_place, only: yielding_place_t
   use litz_yielding_spot, only: yielding_state_t
   use litz_yielding_wires, only: lens_of_wires
   implicit none
   private
   public :: find_yielded_cell, find_yielded_lens

   !> Relative change of the overlap for a difference
   real(dp), parameter :: small_change = 1.0e-5_dp
   integer, parameter :: max_halvings = 50

   !> What conducts in a cell, per share of it.
   type :: strips_t
      !> Length [m] and largest half width [m]
      real(dp) :: length = 0, half_width = 0
      !> [S], and its derivatives by slope and curvature of the distance (2), and by the resistivities (2)
      real(dp) :: conductance = 0, by_course(2) = 0, by_resistivity(2) = 0
   end type strips_t

contains

   !> What a place of a line conducts: the integral over the part of its cell that touches.
   pure subroutine find_yielded_cell(law, pair, course, point, circuit)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(line_course_t), intent(in) :: course
      type(contact_point_t), intent(in) :: point
      type(spot_in_circuit_t), intent(inout) :: circuit
      type(yielding_place_t) :: place
      type(line_cell_t) :: cell
      type(strips_t) :: strips, near, far
      real(dp) :: density, change, by_overlap

      circuit%follows = 0
      if (allocated(point%yielding_place)) place = point%yielding_place
      ! with the section as the spot sees it
      place%strip%line = point%line
      cell = point%cell
      strips = strips_of_cell(law, pair, place, cell)
      if (.not. strips%conductance > 0) return
      ! of the deepest overlap that the cell may have
      associate (reach => maxval(cell%reach))
         change = small_change*(abs(cell%overlap) + abs(cell%slope)*reach + abs(cell%bend)*reach**2/2)
      end associate
      if (cell%overlap < place%dent%overlap) change = -change
      cell%overlap = point%cell%overlap + change/2
      near = strips_of_cell(law, pair, place, cell)
      cell%overlap = point%cell%overlap + change
      far = strips_of_cell(law, pair, place, cell)
      by_overlap = one_sided([strips%conductance, near%conductance, far%conductance])/change
      density = point%weight/sum(cell%reach)
      circuit%spot%conductance = density*strips%conductance
      circuit%spot%dconductance_dresistivity = density*strips%by_resistivity
      circuit%spot%semi_minor = strips%half_width
      ! an ellipse of the same area
      circuit%spot%semi_major = 4/pi*density*strips%length/2
      circuit%dconductance_dgap = -density*by_overlap
      circuit%dconductance = density*(strips%by_course(1)*course%dslope + strips%by_course(2)*course%dbend) &
         + circuit%dconductance_dgap*point%kinematics%dgap
   end subroutine find_yielded_cell

   !> The strips on the part of a cell that touches. Beside its place the wires have been as much deeper as there.
   pure type(strips_t) function strips_of_cell(law, pair, place, cell) result(strips)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(yielding_place_t), intent(in) :: place
      type(line_cell_t), intent(in) :: cell
      type(line_cell_t) :: beyond
      type(cell_samples_t) :: samples
      type(line_spot_t) :: at(n_samples), near, far
      real(dp) :: slope(n_samples), derivative(n_of_cell), drop, edge, step
      integer :: i

      drop = place%dent%overlap - cell%overlap
      edge = edge_of_dent(place, drop)
      beyond = cell
      beyond%overlap = cell%overlap - edge
      samples = cell_samples(beyond)
      if (samples%n == 0) return
      do i = 1, samples%n
         associate (here => samples%overlap(i) + edge)
            at(i) = strip_beside(law, place, here, drop)
            step = small_change*here
            near = strip_beside(law, place, here + step/2, drop)
            far = strip_beside(law, place, here + step, drop)
            slope(i) = one_sided([at(i)%conductance, near%conductance, far%conductance])/step
         end associate
      end do
      associate (n => samples%n)
         strips%length = sum(samples%weight(:n))
         strips%half_width = maxval(at(:n)%half_width)
         call cell_integral(samples, at(:n)%conductance, slope(:n), strips%conductance, derivative)
         strips%by_course = derivative(2:3)
         do i = 1, size(pair%resistivity)
            strips%by_resistivity(i) = dot_product(samples%weight(:n), at(:n)%dconductance_dresistivity(i))
         end do
      end associate
   end function strips_of_cell

   !> Slope from a value and those half a step and a step away, times the step.
   pure real(dp) function one_sided(values)
      !> (3)
      real(dp), intent(in) :: values(3)

      one_sided = dot_product([-3.0_dp, 4.0_dp, -1.0_dp], values)
   end function one_sided

   !> The strip where the wires overlap by this much, and have overlapped by more.
   pure type(line_spot_t) function strip_beside(law, place, overlap, drop) result(spot)
      type(interaction_t), intent(in) :: law
      type(yielding_place_t), intent(in) :: place
      !> [m], and how much deeper the wires have been [m]
      real(dp), intent(in) :: overlap, drop
      type(line_dent_t) :: dent
      type(line_state_t) :: state

      if (place%dent%yielded) then
         state = line_state_at_overlap(place%strip, line_dent_t(), overlap + drop)
         dent = line_dent(place%strip, state%force)
      end if
      state = line_state_at_overlap(place%strip, dent, overlap)
      spot = yielded_strip(place%strip, state, number_of(law%spot, law%spot%film_number))
   end function strip_beside

   !> Overlap where wires part that have been deeper by this much [m]: there all of it comes back.
   pure real(dp) function edge_of_dent(place, drop) result(edge)
      type(yielding_place_t), intent(in) :: place
      !> [m]
      real(dp), intent(in) :: drop
      type(line_dent_t) :: dent
      real(dp) :: low, high
      integer :: i

      edge = 0
      if (.not. (place%dent%yielded .and. drop > 0)) return
      low = 0
      high = place%dent%force
      do i = 1, max_halvings
         dent = line_dent(place%strip, (low + high)/2)
         if (dent%overlap - dent%depth < drop) then
            low = dent%force
         else
            high = dent%force
         end if
      end do
      dent = line_dent(place%strip, high)
      edge = max(dent%overlap - drop, 0.0_dp)
   end function edge_of_dent

   !> The spot of a crossing, and how it changes with the overlap instead of the force.
   pure subroutine spot_of_state(law, pair, state, spot)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(yielding_state_t), intent(in) :: state
      type(contact_spot_t), intent(out) :: spot

      call set_conductance(metal_of_law(law%spot, pair%resistivity), state%disc, state%ddisc(:2), state%area, &
         state%darea(:2), spot)
   end subroutine spot_of_state

   !> What a crossing whose section counts conducts: its spot and the strip along its lens.
   pure subroutine find_yielded_lens(law, pair, point, circuit)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      type(spot_in_circuit_t), intent(inout) :: circuit
      type(yielding_lens_t) :: lens
      type(contact_spot_t) :: near, far
      real(dp) :: change

      circuit%follows = 0
      if (.not. point%gap < 0) return
      lens = lens_of_wires(law%normal, pair, point)
      circuit%spot = whole_spot(law, pair, lens, -point%gap)
      change = small_change*abs(point%gap)
      if (-point%gap < lens%deepest) change = -change
      near = whole_spot(law, pair, lens, -point%gap + change/2)
      far = whole_spot(law, pair, lens, -point%gap + change)
      associate (spot => circuit%spot, weight => weight_of_lens(point))
         circuit%dconductance_dgap = -weight*one_sided([spot%conductance, near%conductance, far%conductance])/change
         circuit%dconductance = circuit%dconductance_dgap*point%kinematics%dgap
         spot%conductance = weight*spot%conductance
         spot%dconductance_dresistivity = weight*spot%dconductance_dresistivity
      end associate
   end subroutine find_yielded_lens

   !> Spot and strip at an overlap of the deepest place, of a whole contact.
   pure type(contact_spot_t) function whole_spot(law, pair, lens, overlap) result(spot)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(yielding_lens_t), intent(in) :: lens
      !> [m]
      real(dp), intent(in) :: overlap
      type(lens_state_t) :: state
      type(line_spot_t) :: at
      type(contact_spot_t) :: round
      integer :: i

      state = state_of_lens(lens, overlap)
      do i = 1, n_depths
         if (.not. state%along(i)%force > 0) cycle
         at = yielded_strip(lens%strip, state%along(i), number_of(law%spot, law%spot%film_number))
         associate (length => lens%strip_share*state%elastic%half_length*gauss_weight(i))
            spot%conductance = spot%conductance + length*at%conductance
            spot%dconductance_dresistivity = spot%dconductance_dresistivity + length*at%dconductance_dresistivity
         end associate
      end do
      call set_axes(lens, overlap, state, spot)
      if (.not. (lens%strip_share < 1 .and. state%spot%force > 0)) return
      round = round_spot(law, pair, lens, overlap, state)
      associate (share => 1 - lens%strip_share)
         spot%conductance = spot%conductance + share*round%conductance
         spot%dconductance_dresistivity = spot%dconductance_dresistivity + share*round%dconductance_dresistivity
      end associate
   end function whole_spot

   !> Half axes: those of the spot of crossed wires and of the ellipse that is as wide as the strip along the lens is at
   !> its deepest place, and has its area, as far as each counts.
   pure subroutine set_axes(lens, overlap, state, spot)
      type(yielding_lens_t), intent(in) :: lens
      !> Of the deepest place [m]
      real(dp), intent(in) :: overlap
      !> There
      type(lens_state_t), intent(in) :: state
      type(contact_spot_t), intent(inout) :: spot
      type(line_state_t) :: deepest
      real(dp) :: area, of_spot

      deepest = deepest_strip(lens, overlap)
      if (deepest%half_width > 0) then
         area = 2*state%elastic%half_length*dot_product(gauss_weight, state%along%half_width)
         spot%semi_minor = lens%strip_share*deepest%half_width
         spot%semi_major = lens%strip_share*area/(pi*deepest%half_width)
      end if
      of_spot = (1 - lens%strip_share)*sqrt(state%spot%area/(pi*lens%ellipse%ratio))
      spot%semi_major = spot%semi_major + of_spot
      spot%semi_minor = spot%semi_minor + lens%ellipse%ratio*of_spot
   end subroutine set_axes

   !> The spot of crossed wires in a lens whose section counts. The lens of elastic wires conducts more or less than the
   !> ellipse at the same overlap: clean metal as it gives way, under a film as the ellipse of its force. The spot does
   !> so in proportion.
   pure type(contact_spot_t) function round_spot(law, pair, lens, overlap, state) result(spot)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(yielding_lens_t), intent(in) :: lens
      !> Of the deepest place [m]
      real(dp), intent(in) :: overlap
      type(lens_state_t), intent(in) :: state
      type(yielding_state_t) :: round
      type(lens_spot_t) :: elastic
      real(dp) :: hertz, part

      hertz = hertz_force(lens, overlap)
      if (law%spot%film_number == 0) then
         elastic = lens_spot(lens%strip%line, state%elastic, 0.0_dp, 0.0_dp)
         part = state%spot%disc/(3*hertz/(4*lens%spot%modulus*overlap))
         spot%conductance = part*elastic%conductance
         spot%dconductance_dresistivity = part*elastic%dconductance_dresistivity
      else
         part = (state%elastic%force/hertz)**(1.0_dp/3)
         round = state%spot
         round%disc = part*round%disc
         round%area = part**2*round%area
         call spot_of_state(law, pair, round, spot)
      end if
   end function round_spot

end module litz_yielded_cells
