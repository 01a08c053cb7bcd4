!> What wires that yield conduct along lines: the strip with its dent, and in the lens of a crossing as far as that is
!> short the spot of the crossing.
!>
!> Source: theory section 15; the rest is that of elastic wires, (10.23) and (10.26).
module litz_yielded_cells
   use litz_kinds, only: dp, pi
   use litz_contact_blocks, only: spot_in_circuit_t
   use litz_contact_points, only: contact_point_t
   use litz_law_input, only: wire_pair_t
   use litz_lens_at_place, only: deepest_overlap, lens_at_place_t, lens_at_place
   use litz_lens_law, only: gauss_weight, n_depths
   use litz_line_cell, only: cell_samples_t, cell_samples, cell_integral, line_cell_t, n_samples
   use litz_line_kinematics, only: line_course_t
   use litz_line_law, only: line_spot_t
   use litz_model, only: interaction_t
   use litz_normal_forces, only: weight_of_lens
   use litz_spot_law, only: contact_spot_t
   use litz_spot_resistance, only: spot_metal_t, set_conductance
   use litz_spots_of_places, only: blend, even_share, number_of, varying_t
   use litz_yielding_lens, only: yielding_lens_t, lens_state_t, state_of_lens
   use litz_yielding_line, only: line_dent_t, line_dent, line_state_t, line_state_at_overlap, yielding_line_t, &
      yielded_strip
   use litz_yielding_place, only: yielding_place_t
   use litz_yielding_spot, only: dent_t, yielding_state_t, state_at_overlap
   use litz_yielding_wires, only: lens_of_wires
   implicit none
   private
   public :: find_yielded_cell, find_yielded_lens

   !> Relative change of the overlap for a difference
   real(dp), parameter :: small_change = 1.0e-5_dp

contains

   !> What a place of a line conducts: the integral over the part of its cell that touches beyond its dent.
   pure subroutine find_yielded_cell(law, pair, course, point, circuit)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(line_course_t), intent(in) :: course
      type(contact_point_t), intent(in) :: point
      type(spot_in_circuit_t), intent(inout) :: circuit
      type(yielding_place_t) :: place
      type(line_cell_t) :: cell
      type(cell_samples_t) :: samples
      type(varying_t) :: conductance
      real(dp) :: half_width, density

      circuit%follows = 0
      place = point%yielding_place
      place%strip%line = point%line
      cell = point%cell
      cell%overlap = cell%overlap - place%strip_share*place%strip_dent%depth
      samples = cell_samples(cell)
      if (samples%n == 0) return
      call find_strip(law, place, point%cell%overlap, samples, conductance, half_width)
      if (place%strip_share < 1) call add_crossing(law, pair, place, cell, samples, point, conductance)
      density = point%weight/sum(point%cell%reach)
      circuit%spot%conductance = density*conductance%value
      circuit%spot%dconductance_dresistivity = density*conductance%by_resistivity
      circuit%spot%semi_minor = half_width
      ! an ellipse of the same area
      circuit%spot%semi_major = 4/pi*density*sum(samples%weight(:samples%n))/2
      circuit%dconductance = density*(conductance%derivative(2)*course%dslope &
         + conductance%derivative(3)*course%dbend - conductance%derivative(1)*point%kinematics%dgap)
   end subroutine find_yielded_cell

   !> The strip on the part of a cell that touches. Beside its place the dent is as much deeper as the wires are.
   pure subroutine find_strip(law, place, overlap, samples, strip, half_width)
      type(interaction_t), intent(in) :: law
      type(yielding_place_t), intent(in) :: place
      !> At the place [m]
      real(dp), intent(in) :: overlap
      !> Of the cell less the dent
      type(cell_samples_t), intent(in) :: samples
      type(varying_t), intent(out) :: strip
      !> Of the widest place [m]
      real(dp), intent(out) :: half_width
      type(line_spot_t) :: at(n_samples)
      type(line_dent_t) :: dent
      type(line_state_t) :: state(n_samples), made
      real(dp) :: here
      integer :: i

      do i = 1, samples%n
         here = samples%overlap(i) + place%strip_share*place%strip_dent%depth
         dent = line_dent_t()
         if (place%strip_dent%evenness > 0) then
            made = line_state_at_overlap(place%strip, dent, place%strip_dent%overlap + here - overlap)
            dent = line_dent(place%strip, made%force)
         end if
         state(i) = line_state_at_overlap(place%strip, dent, here)
         call keep_strip(law, dent, state(i))
         at(i) = yielded_strip(place%strip, state(i), number_of(law%spot, law%spot%film_number))
      end do
      associate (n => samples%n)
         half_width = maxval(state(:n)%half_width)
         call cell_integral(samples, at(:n)%conductance, at(:n)%dconductance_dforce*state(:n)%stiffness, strip%value, &
            strip%derivative)
         do i = 1, 2
            strip%by_resistivity(i) = dot_product(samples%weight(:n), at(:n)%dconductance_dresistivity(i))
         end do
      end associate
   end subroutine find_strip

   !> A strip that has welded stays as wide as the largest force has made it.
   pure subroutine keep_strip(law, dent, state)
      type(interaction_t), intent(in) :: law
      type(line_dent_t), intent(in) :: dent
      type(line_state_t), intent(inout) :: state

      if (.not. law%spot_memory .or. .not. state%force > 0 .or. state%force >= dent%force) return
      state%half_width = dent%half_width
      state%lens = dent%lens
      state%dhalf_width_dforce = 0
      state%lens_slope = 0
   end subroutine keep_strip

   !> What a cell in the lens of a crossing has of its spot, as far as that is short.
   pure subroutine add_crossing(law, pair, place, cell, samples, point, of_cell)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(yielding_place_t), intent(in) :: place
      !> Less the dent
      type(line_cell_t), intent(in) :: cell
      type(cell_samples_t), intent(in) :: samples
      type(contact_point_t), intent(in) :: point
      !> In: the strip, out: what the cell conducts
      type(varying_t), intent(inout) :: of_cell
      type(lens_at_place_t) :: lens
      type(yielding_state_t) :: state
      type(contact_spot_t) :: spot
      type(varying_t) :: touching, round
      real(dp) :: ones(n_samples)

      if (.not. cell%bend > 0) return
      ones = 1
      call cell_integral(samples, ones(:samples%n), 0*ones(:samples%n), touching%value, touching%derivative)
      lens = lens_at_place(point%line, deepest_overlap(cell, 0.0_dp), cell%bend, 0.0_dp)
      if (.not. lens%half_length > 0) return
      state = state_at_overlap(place%spot, place%spot_dent, lens%deepest%value &
         + place%strip_share*place%strip_dent%depth)
      if (.not. state%force > 0) return
      call spot_of_state(law, pair, place%spot_dent, state, spot)
      round = varying_t(spot%conductance, spot%dconductance_dforce*lens%deepest%derivative, &
         spot%dconductance_dresistivity)
      of_cell = blend(of_cell, even_share(round, lens, touching), varying_t(1 - place%strip_share))
   end subroutine add_crossing

   !> The spot of a crossing, and how it changes with the overlap instead of the force.
   pure subroutine spot_of_state(law, pair, dent, state, spot)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(dent_t), intent(in) :: dent
      type(yielding_state_t), intent(in) :: state
      type(contact_spot_t), intent(out) :: spot
      type(spot_metal_t) :: metal

      metal%resistivity = pair%resistivity
      metal%film = number_of(law%spot, law%spot%film_number)
      metal%resistivity_path = 0
      if (law%spot%path_number > 0) metal%resistivity_path = law%spot%data(law%spot%path_number)
      if (law%spot_memory .and. state%opening < 1) then
         call set_conductance(metal, dent%disc, [0.0_dp, 0.0_dp], dent%area, [0.0_dp, 0.0_dp], spot)
      else
         call set_conductance(metal, state%disc, state%ddisc(:2), state%area, state%darea(:2), spot)
      end if
   end subroutine spot_of_state

   !> What a crossing whose section counts conducts: its spot and the strip along its lens.
   pure subroutine find_yielded_lens(law, pair, point, circuit)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      type(spot_in_circuit_t), intent(inout) :: circuit
      type(yielding_lens_t) :: lens
      type(contact_spot_t) :: other
      real(dp) :: change

      circuit%follows = 0
      if (.not. point%gap < 0) return
      lens = lens_of_wires(law%normal, pair, point)
      circuit%spot = whole_spot(law, pair, lens, -point%gap)
      change = small_change*abs(point%gap)
      if (-point%gap < lens%deepest) change = -change
      other = whole_spot(law, pair, lens, -point%gap + change)
      associate (spot => circuit%spot, weight => weight_of_lens(point))
         circuit%dconductance = -weight*(other%conductance - spot%conductance)/change*point%kinematics%dgap
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
         call keep_strip(law, state%dents(i), state%along(i))
         at = yielded_strip(lens%strip, state%along(i), number_of(law%spot, law%spot%film_number))
         associate (length => lens%strip_share*state%elastic%half_length*gauss_weight(i))
            spot%conductance = spot%conductance + length*at%conductance
            spot%dconductance_dresistivity = spot%dconductance_dresistivity + length*at%dconductance_dresistivity
            spot%semi_minor = max(spot%semi_minor, state%along(i)%half_width)
         end associate
      end do
      spot%semi_major = state%elastic%half_length
      if (.not. (lens%strip_share < 1 .and. state%spot%force > 0)) return
      call spot_of_state(law, pair, lens%dent, state%spot, round)
      associate (share => 1 - lens%strip_share)
         spot%conductance = spot%conductance + share*round%conductance
         spot%dconductance_dresistivity = spot%dconductance_dresistivity + share*round%dconductance_dresistivity
      end associate
   end function whole_spot

end module litz_yielded_cells
