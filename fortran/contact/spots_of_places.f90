!> What the places of a line conduct: the strip along it, and near a crossing what its spot is and was.
!>
!> Source: theory section 10. All cells in a lens together conduct as the crossing does that carries it, so that it does
!> not matter which of them carries how much of the contact.
module litz_spots_of_places
   use litz_kinds, only: dp, pi
   use litz_contact_blocks, only: spot_in_circuit_t
   use litz_contact_points, only: contact_point_t, law_bad_data
   use litz_law_input, only: wire_pair_t
   use litz_lens_at_place, only: deepest_overlap_t, deepest_overlap, lens_at_place_t, lens_at_place, integral_at_place
   use litz_lens_law, only: n_depths, share_of_line, slope_of_line_share
   use litz_line_cell, only: cell_samples_t, cell_samples, cell_integral, n_of_cell, n_samples
   use litz_line_kinematics, only: line_course_t
   use litz_line_law, only: line_force_t, line_overlap_t, line_overlap, line_spot_t, line_spot
   use litz_model, only: interaction_t
   use litz_round_end, only: end_force_t, force_of_end, ellipse_of_end
   use litz_spot_law, only: contact_spot_t, contact_spot, spot_law_t, spot_ok
   use litz_yielding_place, only: place_force
   implicit none
   private
   public :: spot_of_cell, spot_per_length, is_round, strip_of, number_of

   !> A quantity, and its derivatives with respect to overlap, slope and curvature at the place (3)
   type :: varying_t
      real(dp) :: value = 0, derivative(n_of_cell) = 0
      !> Derivatives of a conductance by the resistivities of the wires (2) [S/(ohm m)]
      real(dp) :: by_resistivity(2) = 0
      !> Derivative of a conductance by the logarithm of the force that makes it, at the overlap that there is [S]
      real(dp) :: by_ln_force = 0
   end type varying_t

contains

   !> What a place of a line conducts: the integral over the part of its cell that touches.
   pure subroutine spot_of_cell(law, pair, spot_force, course, point, circuit)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> That makes the spot at the place [N/m]
      real(dp), intent(in) :: spot_force
      type(line_course_t), intent(in) :: course
      type(contact_point_t), intent(inout) :: point
      !> Out: the spot, and how its conductance changes; `follows` is known
      type(spot_in_circuit_t), intent(inout) :: circuit
      type(cell_samples_t) :: samples
      type(line_overlap_t) :: made
      type(varying_t) :: of_strip
      real(dp) :: deeper, density, half_width

      samples = cell_samples(point%cell)
      deeper = 0
      if (.not. circuit%follows > 0) then
         made = line_overlap(point%line, spot_force, law%normal%line_penalty())
         deeper = max(0.0_dp, made%overlap - point%cell%overlap)
         ! the strip stays as it was made while less of it touches
         samples%doverlap(1, :samples%n) = samples%doverlap(1, :samples%n) - 1
      end if
      call find_strip(law, pair, samples, deeper, point, of_strip, half_width)
      if (point%in_lens) call add_crossing(law, pair, samples, deeper, point, of_strip)
      density = point%weight/sum(point%cell%reach)
      circuit%spot%conductance = density*of_strip%value
      circuit%spot%dconductance_dresistivity = density*of_strip%by_resistivity
      circuit%spot%semi_minor = half_width
      circuit%spot%semi_major = density*sum(samples%weight(:samples%n))/2
      ! an ellipse of the same area
      if (.not. law%spot%is_per_length) circuit%spot%semi_major = 4/pi*circuit%spot%semi_major
      circuit%dconductance_dgap = -density*of_strip%derivative(1)
      circuit%dconductance = density*(of_strip%derivative(2)*course%dslope + of_strip%derivative(3)*course%dbend) &
         + circuit%dconductance_dgap*point%kinematics%dgap
      circuit%dconductance_dln_force = circuit%follows*density*of_strip%by_ln_force
      point%lap%round_end%share_of_conductance = 0
      if (point%lap%round_end%hertz > 0 .and. point%gap < 0) call add_round_end(law, pair, deeper, point, circuit)
   end subroutine spot_of_cell

   !> What the round end of the wire conducts: as much of the spot of its Hertz contact as it has of that.
   pure subroutine add_round_end(law, pair, deeper, point, circuit)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> How much deeper the wires were when the spot was made [m]
      real(dp), intent(in) :: deeper
      type(contact_point_t), intent(inout) :: point
      !> In: with the strip
      type(spot_in_circuit_t), intent(inout) :: circuit
      type(end_force_t) :: at
      type(contact_spot_t) :: whole
      real(dp) :: overlap, force, by_overlap, by_ln_force
      integer :: info

      if (law%spot%is_per_length) return
      overlap = deeper - point%gap
      associate (round => point%lap%round_end)
         at = force_of_end(round, overlap)
         force = round%hertz*overlap**1.5_dp
         call contact_spot(law%spot, force, pair, ellipse_of_end(pair, point%kinematics%angle), whole, info)
      end associate
      if (info /= spot_ok) point%law_status = law_bad_data
      by_ln_force = circuit%follows*at%part*whole%dconductance_dforce*force
      by_overlap = 1.5_dp*by_ln_force/overlap + circuit%follows*at%dpart*whole%conductance
      circuit%spot%conductance = circuit%spot%conductance + at%part*whole%conductance
      if (circuit%spot%conductance > 0) point%lap%round_end%share_of_conductance = at%part*whole%conductance &
         /circuit%spot%conductance
      circuit%spot%dconductance_dresistivity = circuit%spot%dconductance_dresistivity &
         + at%part*whole%dconductance_dresistivity
      circuit%dconductance = circuit%dconductance - by_overlap*point%kinematics%dgap
      circuit%dconductance_dgap = circuit%dconductance_dgap - by_overlap
      circuit%dconductance_dln_force = circuit%dconductance_dln_force + by_ln_force
   end subroutine add_round_end

   !> The strip on the part of a cell that touches.
   pure subroutine find_strip(law, pair, samples, deeper, point, strip, half_width)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(cell_samples_t), intent(in) :: samples
      !> How much deeper the wires were when the spot was made [m]
      real(dp), intent(in) :: deeper
      type(contact_point_t), intent(inout) :: point
      type(varying_t), intent(out) :: strip
      !> Of the widest place [m]
      real(dp), intent(out) :: half_width
      type(contact_spot_t) :: at(n_samples)
      type(line_force_t) :: force(n_samples)
      integer :: i, info

      do i = 1, samples%n
         force(i) = place_force(point%yielding_place, point%line, samples%overlap(i) + deeper, &
            law%normal%line_penalty())
         call spot_per_length(law, pair, point, force(i)%force, at(i), info)
         if (info /= spot_ok) point%law_status = law_bad_data
      end do
      associate (n => samples%n)
         half_width = maxval(at(:n)%semi_minor)
         call cell_integral(samples, at(:n)%conductance, at(:n)%dconductance_dforce*force(:n)%stiffness, strip%value, &
            strip%derivative)
         do i = 1, 2
            strip%by_resistivity(i) = dot_product(samples%weight(:n), at(:n)%dconductance_dresistivity(i))
         end do
         strip%by_ln_force = dot_product(samples%weight(:n), at(:n)%dconductance_dforce*force(:n)%force)
      end associate
   end subroutine find_strip

   !> What a cell in the lens of a crossing has of its spot: of the round one of wires that yield, and of that of the
   !> largest force, which conducts as a whole as far as the lens was short.
   pure subroutine add_crossing(law, pair, samples, deeper, point, of_cell)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(cell_samples_t), intent(in) :: samples
      !> How much deeper the wires were when the spot of the place was made [m]
      real(dp), intent(in) :: deeper
      type(contact_point_t), intent(inout) :: point
      !> In: the strip, out: what the cell conducts
      type(varying_t), intent(inout) :: of_cell
      type(deepest_overlap_t) :: deepest
      type(lens_at_place_t) :: now, made
      type(varying_t) :: touching, spot
      real(dp) :: ones(n_samples)

      if (.not. point%cell%bend > 0) return
      ones = 1
      call cell_integral(samples, ones(:samples%n), 0*ones(:samples%n), touching%value, touching%derivative)
      associate (bend => point%cell%bend, penalty => law%normal%line_penalty())
         deepest = deepest_overlap(point%cell, deeper)
         made = lens_at_place(point%line, deepest, bend, penalty)
         if (.not. made%force > 0) return
         if (is_round(law)) then
            call find_round_spot(law, pair, made, point, spot)
            of_cell = blend(of_cell, even_share(spot, made, touching), share_of_spot(made, pair))
         end if
         if (.not. law%spot_memory) return
         if (point%kept_overlap > deepest%value) made = lens_at_place(point%line, &
            deepest_overlap_t(point%kept_overlap), bend, penalty)
         now = lens_at_place(point%line, deepest_overlap(point%cell, 0.0_dp), bend, penalty)
         if (.not. (now%half_length > 0 .and. made%half_length > now%half_length)) return
         call find_whole_spot(law, pair, made, point, spot)
         of_cell = blend(of_cell, even_share(spot, now, touching), share_of_spot(made, pair))
      end associate
   end subroutine add_crossing

   !> The spot of a crossing whose lens it is, touching or not: the strip along it, as far as the spot is not round.
   pure subroutine find_whole_spot(law, pair, lens, point, spot)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(lens_at_place_t), intent(in) :: lens
      type(contact_point_t), intent(inout) :: point
      type(varying_t), intent(out) :: spot
      type(contact_spot_t) :: at(n_depths)
      type(varying_t) :: round
      real(dp) :: unused_slope(n_of_cell)
      integer :: i, info

      do i = 1, n_depths
         call spot_per_length(law, pair, point, lens%along(i)%force, at(i), info)
         if (info /= spot_ok) point%law_status = law_bad_data
      end do
      call integral_at_place(lens, at%conductance, at%dconductance_dforce, spot%value, spot%derivative)
      do i = 1, 2
         call integral_at_place(lens, at%dconductance_dresistivity(i), 0*at%conductance, spot%by_resistivity(i), &
            unused_slope)
      end do
      if (.not. is_round(law)) return
      call find_round_spot(law, pair, lens, point, round)
      spot = blend(spot, round, share_of_spot(lens, pair))
   end subroutine find_whole_spot

   !> The round spot of wires that yield.
   pure subroutine find_round_spot(law, pair, lens, point, spot)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(lens_at_place_t), intent(in) :: lens
      type(contact_point_t), intent(inout) :: point
      type(varying_t), intent(out) :: spot
      type(contact_spot_t) :: at_force
      integer :: info

      call contact_spot(law%spot, lens%force, pair, point%ellipse, at_force, info)
      if (info /= spot_ok) point%law_status = law_bad_data
      spot = varying_t(at_force%conductance, at_force%dconductance_dforce*lens%dforce, &
         at_force%dconductance_dresistivity, at_force%dconductance_dforce*lens%force)
   end subroutine find_round_spot

   !> The spot of a crossing depends on its force alone, whatever its lens.
   pure logical function is_round(law)
      type(interaction_t), intent(in) :: law

      is_round = law%spot%hardness_number > 0 .and. .not. law%normal%is_per_length_only()
   end function is_round

   !> How much of a lens is a point, by its length.
   pure type(varying_t) function share_of_spot(lens, pair) result(share)
      type(lens_at_place_t), intent(in) :: lens
      type(wire_pair_t), intent(in) :: pair

      associate (radius => minval(pair%radius))
         share%value = 1 - share_of_line(lens%half_length/radius)
         share%derivative = -slope_of_line_share(lens%half_length/radius)*lens%dhalf_length/radius
      end associate
   end function share_of_spot

   !> What a part that touches has of a spot that is spread evenly over a lens.
   pure type(varying_t) function even_share(spot, lens, touching) result(part)
      !> [S]
      type(varying_t), intent(in) :: spot
      type(lens_at_place_t), intent(in) :: lens
      !> Length [m]
      type(varying_t), intent(in) :: touching

      part%value = spot%value*touching%value/(2*lens%half_length)
      part%by_resistivity = spot%by_resistivity*touching%value/(2*lens%half_length)
      part%by_ln_force = spot%by_ln_force*touching%value/(2*lens%half_length)
      part%derivative = (spot%derivative*touching%value + spot%value*touching%derivative)/(2*lens%half_length) &
         - part%value/lens%half_length*lens%dhalf_length
   end function even_share

   pure type(varying_t) function blend(first, second, share) result(both)
      type(varying_t), intent(in) :: first, second
      !> Of the second one
      type(varying_t), intent(in) :: share

      both%value = (1 - share%value)*first%value + share%value*second%value
      both%by_resistivity = (1 - share%value)*first%by_resistivity + share%value*second%by_resistivity
      both%by_ln_force = (1 - share%value)*first%by_ln_force + share%value*second%by_ln_force
      both%derivative = (1 - share%value)*first%derivative + share%value*second%derivative &
         + (second%value - first%value)*share%derivative
   end function blend

   !> Conductance per length under a force per length, and how wide the strip is.
   pure subroutine spot_per_length(law, pair, point, force, spot, info)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> [N/m]
      real(dp), intent(in) :: force
      type(contact_spot_t), intent(out) :: spot
      !> `spot_ok`, or what is wrong
      integer, intent(out) :: info
      type(line_spot_t) :: strip

      info = spot_ok
      if (law%spot%is_per_length) then
         call contact_spot(law%spot, force, pair, point%ellipse, spot, info)
         return
      end if
      strip = strip_of(law%spot, point, force)
      spot%semi_minor = strip%half_width
      spot%conductance = strip%conductance
      spot%dconductance_dforce = strip%dconductance_dforce
      spot%dconductance_dresistivity = strip%dconductance_dresistivity
   end subroutine spot_per_length

   !> The strip at a place of a line, made by a force per length.
   pure type(line_spot_t) function strip_of(law, point, spot_force) result(strip)
      type(spot_law_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point
      !> [N/m]
      real(dp), intent(in) :: spot_force

      strip = line_spot(point%line, spot_force, number_of(law, law%film_number), number_of(law, law%hardness_number))
   end function strip_of

   !> One of the numbers of a law; 0 where it has none.
   pure real(dp) function number_of(law, place)
      type(spot_law_t), intent(in) :: law
      !> Which of its numbers, or 0
      integer, intent(in) :: place

      number_of = 0
      if (place > 0) number_of = law%data(place)
   end function number_of

end module litz_spots_of_places
