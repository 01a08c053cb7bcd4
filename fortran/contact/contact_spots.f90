!> The spots of closed contacts between conductors.
module litz_contact_spots
   use litz_kinds, only: dp
   use litz_axis_choices, only: axis_hermite
   use litz_contact_blocks, only: spot_in_circuit_t
   use litz_contact_electricity, only: contact_electricity_t
   use litz_contact_history, only: spot_shape_t, force_of_spot
   use litz_contact_lens, only: angle_of_law, half_length_of, longest
   use litz_contact_points, only: contact_point_t, law_bad_data
   use litz_cut_forces, only: conducting_part
   use litz_cut_lens, only: is_cut
   use litz_element_library, only: elements_t
   use litz_law_input, only: wire_pair_t
   use litz_lens_law, only: lens_t, kept_lens, lens_spot_t, lens_spot, lens_integral, n_depths, share_of_line
   use litz_line_kinematics, only: line_course
   use litz_line_law, only: line_wires_t
   use litz_model, only: interaction_t, model_t
   use litz_normal_forces, only: apply_normal_law, is_lens, law_of_spot, line_of_point, share_of_ellipse
   use litz_normal_law, only: force_of_gap_t
   use litz_place_forces, only: force_along_line
   use litz_spot_law, only: contact_spot_t, contact_spot, spot_ok
   use litz_spot_memory, only: leaves_spot, lens_of_spot, as_it_was, shape_of_spot, keeps_shape, &
      overlap_of_spot, part_of_spot, uncut_force
   use litz_spots_of_places, only: spot_of_cell, spot_per_length, is_round, number_of
   use litz_turned_lenses, only: turned_by
   use litz_wires, only: wires_t
   use litz_yielded_cells, only: find_yielded_cell, find_yielded_lens
   use litz_yielded_spots, only: find_yielded_spot, has_yielded_spot
   implicit none
   private
   public :: find_spot, keep_current

   !> Change of the angle of a lens over its sine, for differences
   real(dp), parameter :: small_turn = 1.0e-4_dp
   !> Relative change of an overlap, for differences
   real(dp), parameter :: small_change = 1.0e-4_dp

contains

   !> The spot of a closed contact between conductors.
   !>
   !> What makes a spot that is remembered is the largest force, of a crossing as a whole or of a place of a line per
   !> length; at the present angle.
   subroutine find_spot(model, elements, law, wires, pair, x, t, length, point, circuit)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(interaction_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(wire_pair_t), intent(in) :: pair
      !> Nodal positions [m] and unit tangents (3, 4), reference lengths (2) [m]: barred before unbarred
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      type(contact_point_t), intent(inout) :: point
      type(spot_in_circuit_t), intent(out) :: circuit
      real(dp) :: slope, curvature, by_angle

      circuit%series_resistance = pair%series_resistance
      call find_spot_at_angle(law, wires, pair, x, t, length, point, circuit)
      associate (spot => circuit%spot)
         if (point%line_place > 0) then
            spot%dconductance_dangle = 0
         else
            call angle_of_law(point, slope, curvature)
            if (is_lens(law%normal, point) .and. abs(slope) > 0) then
               call turn_spot(model, elements, law, wires, pair, x, t, length, point, by_angle)
               spot%dconductance_dangle = by_angle - spot%dconductance_dforce*circuit%follows &
                  *point%at_gap%dforce_dangle
            end if
            spot%dconductance_dangle = spot%dconductance_dangle*slope
         end if
      end associate
      ! the resistivities are those at the temperatures of the places
      associate (by_place => circuit%spot%dconductance_dresistivity*pair%dresistivity*pair%dtemperature)
         circuit%dconductance = circuit%dconductance + by_place(1)*point%kinematics%rows%dxi_bar &
            + by_place(2)*point%kinematics%rows%dxi
      end associate
   end subroutine find_spot

   !> How the conductance of a lens changes with the angle of its law at a gap that stays, by a difference [S/rad].
   subroutine turn_spot(model, elements, law, wires, pair, x, t, length, point, by_angle)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(interaction_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(wire_pair_t), intent(in) :: pair
      !> Nodal positions [m] and unit tangents (3, 4), reference lengths (2) [m]: barred before unbarred
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      type(contact_point_t), intent(in) :: point
      !> dG/dtheta [S/rad]
      real(dp), intent(out) :: by_angle
      type(contact_point_t) :: turned(2)
      type(spot_in_circuit_t) :: circuit(2)
      real(dp) :: change
      integer :: side

      change = small_turn*point%law_sine
      turned = [turned_by(point, -change), turned_by(point, change)]
      call apply_normal_law(model, elements, turned)
      do side = 1, 2
         turned(side)%line = line_of_point(pair, turned(side))
         call find_spot_at_angle(law, wires, pair, x, t, length, turned(side), circuit(side))
      end do
      by_angle = (circuit(2)%spot%conductance - circuit(1)%spot%conductance)/(2*change)
   end subroutine turn_spot

   !> The spot at the angle of the law.
   subroutine find_spot_at_angle(law, wires, pair, x, t, length, point, circuit)
      type(interaction_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(wire_pair_t), intent(in) :: pair
      !> Nodal positions [m] and unit tangents (3, 4), reference lengths (2) [m]: barred before unbarred
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      type(contact_point_t), intent(inout) :: point
      type(spot_in_circuit_t), intent(inout) :: circuit

      if (has_yielded_spot(law)) then
         if (point%line_place > 0) then
            call find_yielded_cell(law, pair, line_course(x, t, length, axis_hermite, point%foot_at_end, &
               point%kinematics), point, circuit)
         else if (is_lens(law%normal, point)) then
            call find_yielded_lens(law, pair, point, circuit)
         else
            call find_yielded_spot(law, pair, point, circuit)
         end if
      else
         call find_spot_of_force(law, wires, pair, x, t, length, point, circuit)
      end if
   end subroutine find_spot_at_angle

   !> The spot that a force makes, or has made.
   subroutine find_spot_of_force(law, wires, pair, x, t, length, point, circuit)
      type(interaction_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(wire_pair_t), intent(in) :: pair
      !> Nodal positions [m] and unit tangents (3, 4), reference lengths (2) [m]: barred before unbarred
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      type(contact_point_t), intent(inout) :: point
      type(spot_in_circuit_t), intent(inout) :: circuit
      real(dp) :: spot_force, section
      type(contact_point_t) :: earlier
      type(line_wires_t) :: present
      type(spot_shape_t) :: shape

      if (law%spot_memory) point%new_spot = leaves_spot(law, wires, pair, point)
      call force_of_spot(law%spot_memory, point%history, force_along_line(point)/point%weight, uncut_force(point), &
         point%new_spot, spot_force, circuit%follows)
      present = point%line
      section = point%section_share
      shape = shape_of_spot(point)
      if (law%spot_memory .and. (point%spot_section > point%section_share .or. keeps_shape(law, point))) then
         earlier = as_it_was(law, pair, point)
         call take_shape(shape_of_spot(earlier), earlier%line, point)
         if (any(point%held)) point%section_share = earlier%section_share
      end if
      if (point%line_place > 0) then
         call spot_of_cell(law, pair, spot_force, line_course(x, t, length, axis_hermite, point%foot_at_end, &
            point%kinematics), point, circuit)
      else
         call find_whole_spot(law, pair, spot_force, point, circuit%spot)
         point%law_sine = shape%sine
         ! what is given for a whole spot stays as a whole
         if (.not. circuit%follows > 0 .and. (law%spot%serves_lines .or. law%spot%is_per_length)) then
            if (any(point%held)) then
               call keep_beside_end(law, pair, spot_force, point, circuit)
            else
               call keep_what_touches(law, pair, spot_force, point, circuit)
            end if
         end if
      end if
      ! those of the forces
      call take_shape(shape, present, point)
      point%section_share = section
      if (is_cut(point%lens) .and. .not. circuit%follows > 0) call widen_to_present(law, pair, point, circuit)
   end subroutine find_spot_of_force

   !> Beside ends, where a crossing may carry more of the contact as it is released, a spot that stays is no smaller
   !> than the present force makes it.
   pure subroutine widen_to_present(law, pair, point, circuit)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> In: with the spot that stays
      type(spot_in_circuit_t), intent(inout) :: circuit
      type(contact_point_t) :: without_memory
      type(contact_spot_t) :: present

      if (point%line_place > 0) return
      without_memory = point
      without_memory%history%spot_shape = spot_shape_t()
      call find_whole_spot(law, pair, force_along_line(point)/point%weight, without_memory, present)
      if (.not. present%conductance > circuit%spot%conductance) return
      circuit%spot = present
      circuit%follows = 1
      circuit%dconductance_dgap = 0
      circuit%dconductance = 0
   end subroutine widen_to_present

   !> From now on the point has the spot of this shape, and sees these wires.
   pure subroutine take_shape(shape, line, point)
      type(spot_shape_t), intent(in) :: shape
      type(line_wires_t), intent(in) :: line
      type(contact_point_t), intent(inout) :: point

      point%ellipse = shape%ellipse
      point%law_sine = shape%sine
      point%line = line
   end subroutine take_shape

   !> The spot that a force makes of a crossing.
   pure subroutine find_whole_spot(law, pair, spot_force, point, spot)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> [N]
      real(dp), intent(in) :: spot_force
      type(contact_point_t), intent(inout) :: point
      type(contact_spot_t), intent(out) :: spot
      type(contact_spot_t) :: of_ellipse, strip

      if (law%spot%is_per_length) then
         call spot_over_length(law, pair, spot_force, point, spot)
      else if (is_lens(law%normal, point)) then
         spot = spot_of_lens(law, pair, point, lens_of_spot(law, pair, point, spot_force))
         if (share_of_ellipse(law%normal, point) > 0) then
            call spot_of_crossing(law, pair, spot_force, point, of_ellipse)
            of_ellipse%dconductance_dforce = of_ellipse%dconductance_dforce*point%at_gap%dforce_dgap &
               /slope_of(law, point)
            strip = spot
            spot = between(strip, of_ellipse, share_of_ellipse(law%normal, point))
            ! metal that is elastic conducts as it gives way, wherever its far field ends
            if (conducts_as_stiff(law)) then
               spot%conductance = strip%conductance
               spot%dconductance_dforce = strip%dconductance_dforce
               spot%dconductance_dresistivity = strip%dconductance_dresistivity
            end if
         end if
      else
         call spot_of_crossing(law, pair, spot_force, point, spot)
      end if
   end subroutine find_whole_spot

   !> The conductance is the stiffness of the contact, over the modulus and the resistivity of the wires.
   pure logical function conducts_as_stiff(law)
      type(interaction_t), intent(in) :: law

      conducts_as_stiff = law%spot%film_number == 0 .and. law%spot%hardness_number == 0 .and. .not. law%normal%yields()
   end function conducts_as_stiff

   !> The spot is an ellipse as far as the lens is short, which conducts otherwise than the strip along it.
   pure logical function has_ellipse(law)
      type(interaction_t), intent(in) :: law

      has_ellipse = .not. (law%spot%is_per_length .or. law%normal%is_per_length_only() .or. conducts_as_stiff(law))
   end function has_ellipse

   !> Of the largest force of a crossing the spot stays as a whole as far as its lens was short then; as far as that was
   !> long, the strip stays where the wires still touch.
   pure subroutine keep_what_touches(law, pair, spot_force, point, circuit)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> The largest one [N]
      real(dp), intent(in) :: spot_force
      type(contact_point_t), intent(inout) :: point
      !> In: with the whole spot
      type(spot_in_circuit_t), intent(inout) :: circuit
      type(lens_t) :: made, now
      real(dp) :: long, round, of_whole, whole(2), touching(2), half_width
      real(dp), dimension(2) :: whole_by_resistivity, touching_by_resistivity
      type(contact_spot_t) :: round_spot

      made = lens_of_spot(law, pair, as_it_was(law, pair, point), spot_force)
      long = share_of_line(made%half_length/minval(pair%radius))
      ! between the ends of both wires it counts as far as these are apart
      if (is_cut(point%lens)) long = min(long, point%spot_section)
      if (.not. (law%normal%serves_lines() .and. long > 0)) return
      now = kept_lens(point%line, point%gap, point%law_sine, law%normal%line_penalty(), -made%gap)
      call spot_along_lens(law, pair, now, point, touching, touching_by_resistivity, half_width)
      call spot_along_lens(law, pair, made, point, whole, whole_by_resistivity, half_width)
      round = 0
      round_spot = contact_spot_t()
      if (is_round(law) .or. is_cut(point%lens) .and. has_ellipse(law)) then
         round = 1 - long
         call spot_of_crossing(law, pair, spot_force, point, round_spot)
      end if
      of_whole = point%weight*part_of_spot(law, point)*(1 - round)
      associate (spot => circuit%spot, of_strip => point%weight*conducting_part(point)*(1 - round), &
         of_round => round*round_spot%conductance, left => now%half_length/made%half_length)
         spot = contact_spot_t()
         spot%semi_major = (1 - long)*made%half_length + long*now%half_length
         spot%semi_minor = half_width
         spot%conductance = of_whole*(1 - long)*whole(1) + of_strip*long*touching(1) + of_round*(1 - long + long*left)
         spot%dconductance_dresistivity = of_whole*(1 - long)*whole_by_resistivity &
            + of_strip*long*touching_by_resistivity &
            + round*round_spot%dconductance_dresistivity*(1 - long + long*left)
         circuit%dconductance_dgap = long*(of_strip*touching(2) + of_round*now%dhalf_length_dgap/made%half_length)
         circuit%dconductance = circuit%dconductance_dgap*point%kinematics%dgap
      end associate
   end subroutine keep_what_touches

   !> The same of the contact of an end, whose overlap is a wedge: as far as the wires no longer touch, the spot is that
   !> of the present force.
   pure subroutine keep_beside_end(law, pair, spot_force, point, circuit)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> The largest one [N]
      real(dp), intent(in) :: spot_force
      type(contact_point_t), intent(inout) :: point
      !> In: with the whole spot
      type(spot_in_circuit_t), intent(inout) :: circuit
      real(dp) :: overlap, made, now, slope, long, left, made_conductance
      type(contact_spot_t) :: present

      if (any(point%held .and. .not. point%at_end) .or. .not. law%normal%serves_lines()) return
      overlap = overlap_of_spot(law, pair, point, spot_force)
      if (.not. (point%gap < 0 .and. overlap > -point%gap)) return
      made = length_at(overlap)
      now = length_at(-point%gap)
      slope = (length_at(-point%gap*(1 + small_change)) - length_at(-point%gap*(1 - small_change))) &
         /(-2*small_change*point%gap)
      long = share_of_line(made/minval(pair%radius))
      left = 1 - long + long*now/made
      if (.not. left < 1) return
      call find_whole_spot(law, pair, force_along_line(point)/point%weight, point, present)
      made_conductance = circuit%spot%conductance
      circuit%spot = between(present, circuit%spot, left)
      circuit%dconductance_dgap = (1 - left)*present%dconductance_dforce*point%at_gap%dforce_dgap/point%weight &
         - (made_conductance - present%conductance)*long*slope/made
      circuit%dconductance = circuit%dconductance_dgap*point%kinematics%dgap

   contains

      !> How far the wires touch, along a lap as far as lengths are told [m].
      pure real(dp) function length_at(overlap)
         !> [m]
         real(dp), intent(in) :: overlap
         type(contact_point_t) :: deeper

         deeper = point
         deeper%gap = -overlap
         length_at = min(half_length_of(deeper, overlap), longest*minval(point%radius))
      end function length_at

   end subroutine keep_beside_end

   !> Conductance along a lens, and its derivative with respect to the gap.
   pure subroutine spot_along_lens(law, pair, lens, point, conductance, by_resistivity, half_width)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(lens_t), intent(in) :: lens
      type(contact_point_t), intent(inout) :: point
      !> [S], [S/m], and half width of the widest strip at a Gauss point [m]
      real(dp), intent(out) :: conductance(2), half_width
      !> Derivatives of the conductance by the resistivities (2) [S/(ohm m)]
      real(dp), intent(out) :: by_resistivity(2)
      type(contact_spot_t) :: at(n_depths)
      real(dp) :: unused_slope
      integer :: i, info

      do i = 1, n_depths
         call spot_per_length(law, pair, point, lens%along(i)%force, at(i), info)
         if (info /= spot_ok) point%law_status = law_bad_data
      end do
      call lens_integral(lens, at%conductance, at%dconductance_dforce, conductance(1), conductance(2))
      do i = 1, 2
         call lens_integral(lens, at%dconductance_dresistivity(i), 0*at%conductance, by_resistivity(i), unused_slope)
      end do
      half_width = maxval(at%semi_minor)
   end subroutine spot_along_lens

   !> The spot of wires that cross, as far as this point carries the contact.
   pure subroutine spot_of_crossing(law, pair, spot_force, point, spot)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> That makes the spot [N]
      real(dp), intent(in) :: spot_force
      type(contact_point_t), intent(inout) :: point
      type(contact_spot_t), intent(out) :: spot
      integer :: info

      call contact_spot(law%spot, spot_force, pair, point%ellipse, spot, info)
      if (info /= spot_ok) point%law_status = law_bad_data
      spot%conductance = point%weight*spot%conductance
      spot%dconductance_dangle = point%weight*spot%dconductance_dangle
      spot%dconductance_dresistivity = point%weight*spot%dconductance_dresistivity
   end subroutine spot_of_crossing

   !> A spot that turns from one law into another.
   pure type(contact_spot_t) function between(first, second, share) result(spot)
      type(contact_spot_t), intent(in) :: first, second
      !> Of the second one
      real(dp), intent(in) :: share

      spot%semi_major = (1 - share)*first%semi_major + share*second%semi_major
      spot%semi_minor = (1 - share)*first%semi_minor + share*second%semi_minor
      spot%conductance = (1 - share)*first%conductance + share*second%conductance
      spot%dconductance_dforce = (1 - share)*first%dconductance_dforce + share*second%dconductance_dforce
      spot%dconductance_dresistivity = (1 - share)*first%dconductance_dresistivity &
         + share*second%dconductance_dresistivity
   end function between

   !> A resistance that is given per length, over the lens of a crossing.
   pure subroutine spot_over_length(law, pair, spot_force, point, spot)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> That makes the spot [N]
      real(dp), intent(in) :: spot_force
      type(contact_point_t), intent(inout) :: point
      type(contact_spot_t), intent(out) :: spot
      type(contact_spot_t) :: at(n_depths)
      type(lens_t) :: lens
      real(dp) :: dconductance_dgap, weight
      integer :: i, info

      lens = lens_of_spot(law, pair, point, spot_force)
      do i = 1, n_depths
         call contact_spot(law%spot, lens%along(i)%force, pair, point%ellipse, at(i), info)
         if (info /= spot_ok) point%law_status = law_bad_data
      end do
      call lens_integral(lens, at%conductance, at%dconductance_dforce, spot%conductance, dconductance_dgap)
      weight = point%weight*part_of_spot(law, point)
      spot%conductance = weight*spot%conductance
      ! by the force that the point has, which may be that of an ellipse
      spot%dconductance_dforce = weight*dconductance_dgap/slope_of(law, point)
      spot%semi_major = lens%half_length
   end subroutine spot_over_length

   !> The strip along the lens of a crossing.
   pure type(contact_spot_t) function spot_of_lens(law, pair, point, lens) result(spot)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      type(lens_t), intent(in) :: lens
      type(lens_spot_t) :: strip
      real(dp) :: weight

      strip = lens_spot(point%line, lens, number_of(law%spot, law%spot%film_number), &
         number_of(law%spot, law%spot%hardness_number))
      weight = point%weight*part_of_spot(law, point)
      spot%semi_major = lens%half_length
      spot%semi_minor = strip%half_width
      spot%conductance = weight*strip%conductance
      spot%dconductance_dforce = weight*strip%dconductance_dgap/slope_of(law, point)
      spot%dconductance_dresistivity = weight*strip%dconductance_dresistivity
   end function spot_of_lens

   !> dF/dg of the force by which the spot of a lens follows the gap [N/m].
   pure real(dp) function slope_of(law, point)
      type(interaction_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point
      type(force_of_gap_t) :: followed

      followed = law_of_spot(law%normal, point)
      slope_of = followed%dforce_dgap
   end function slope_of

   !> What results show of a current.
   pure subroutine keep_current(electricity, circuit, dforce_dgap, point)
      type(contact_electricity_t), intent(in) :: electricity
      type(spot_in_circuit_t), intent(in) :: circuit
      !> Of the force that the spot follows [N/m]
      real(dp), intent(in) :: dforce_dgap
      type(contact_point_t), intent(inout) :: point

      point%semi_major = circuit%spot%semi_major
      point%semi_minor = circuit%spot%semi_minor
      point%conductance = circuit%spot%conductance
      if (point%conductance > 0) point%constriction = -circuit%spot%dconductance_dresistivity &
         /point%conductance**2
      point%dconductance = electricity%dconductance
      associate (by_force => circuit%spot%dconductance_dforce*circuit%follows)
         point%dconductance_dgap = by_force*dforce_dgap + circuit%dconductance_dgap
         point%dconductance_dln_force = by_force*point%force + circuit%dconductance_dln_force
      end associate
      point%current = electricity%current
      point%voltage_gap = electricity%voltage_gap
      point%series_resistance = circuit%series_resistance
      point%heat_inside = point%current**2*circuit%series_resistance*(1 - [point%xi_bar, point%xi]**2)
   end subroutine keep_current

end module litz_contact_spots
