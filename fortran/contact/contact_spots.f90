!> The spots of closed contacts between conductors.
module litz_contact_spots
   use litz_kinds, only: dp, pi
   use litz_axis_choices, only: axis_hermite
   use litz_contact_blocks, only: spot_in_circuit_t
   use litz_contact_electricity, only: contact_electricity_t
   use litz_contact_history, only: force_of_spot
   use litz_contact_points, only: contact_point_t, law_bad_data
   use litz_friction_law, only: friction_slip
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok
   use litz_law_input, only: wire_pair_t
   use litz_lens_at_place, only: lens_at_place_t, lens_at_place
   use litz_lens_law, only: lens_t, lens_force, lens_spot_t, lens_spot, lens_integral, n_depths, &
      share_of_line, slope_of_line_share
   use litz_line_cell, only: cell_samples_t, cell_samples, cell_integral, n_of_cell, n_samples
   use litz_line_kinematics, only: line_course_t, line_course
   use litz_line_law, only: line_force_t, line_force, line_overlap_t, line_overlap, line_spot_t, line_spot
   use litz_model, only: interaction_t
   use litz_normal_forces, only: is_lens, law_of_spot, share_of_ellipse, overlap_of_point, weight_of_lens
   use litz_normal_law, only: force_of_gap_t, overlap_of_force_t
   use litz_spot_law, only: contact_spot_t, contact_spot, spot_law_t, spot_ok
   use litz_wires, only: wires_t, arc_from_to
   implicit none
   private
   public :: find_spot, keep_current

contains

   !> The spot of a closed contact between conductors.
   !>
   !> What makes a spot that is remembered is the largest force, of a crossing as a whole or of a place of a line per
   !> length; at the present angle.
   subroutine find_spot(law, wires, pair, x, t, length, point, circuit)
      type(interaction_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(wire_pair_t), intent(in) :: pair
      !> Nodal positions [m] and unit tangents (3, 4), reference lengths (2) [m]: barred before unbarred
      real(dp), intent(in) :: x(3, 4), t(3, 4), length(2)
      type(contact_point_t), intent(inout) :: point
      type(spot_in_circuit_t), intent(out) :: circuit
      real(dp) :: spot_force
      type(contact_spot_t) :: of_ellipse

      circuit%series_resistance = pair%series_resistance
      if (law%spot_memory) point%new_spot = leaves_spot(law, wires, pair, point)
      call force_of_spot(law%spot_memory, point%history, point%force/point%weight, point%new_spot, spot_force, &
         circuit%follows)
      if (point%line_place > 0) then
         call spot_of_cell(law, pair, spot_force, line_course(x, t, length, axis_hermite, point%foot_at_end, &
            point%kinematics), point, circuit)
      else if (law%spot%is_per_length) then
         call spot_per_length(law, pair, spot_force, point, circuit%spot)
      else if (is_lens(law%normal, point)) then
         circuit%spot = spot_of_lens(law, pair, point, lens_of_spot(law, pair, point, spot_force))
         if (share_of_ellipse(law%normal, point) > 0) then
            call spot_of_crossing(law, pair, spot_force, point, of_ellipse)
            of_ellipse%dconductance_dforce = of_ellipse%dconductance_dforce*point%at_gap%dforce_dgap &
               /slope_of(law, point)
            circuit%spot = between(circuit%spot, of_ellipse, share_of_ellipse(law%normal, point))
         end if
      else
         call spot_of_crossing(law, pair, spot_force, point, circuit%spot)
      end if
      ! the resistivities are those at the temperatures of the places
      associate (by_place => circuit%spot%dconductance_dresistivity*pair%dresistivity*pair%dtemperature)
         circuit%dconductance = circuit%dconductance + by_place(1)*point%kinematics%dxi_bar &
            + by_place(2)*point%kinematics%dxi
      end associate
   end subroutine find_spot

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
      spot%dconductance_dresistivity = point%weight*spot%dconductance_dresistivity
   end subroutine spot_of_crossing

   !> A spot that turns from one law into another, at the angle of a lens, which stays.
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
      type(contact_spot_t) :: at(n_samples)
      type(line_force_t) :: force(n_samples)
      real(dp) :: deeper, integral, derivative(n_of_cell), by_resistivity(2), density
      integer :: i, n, info

      samples = cell_samples(point%cell)
      n = samples%n
      deeper = 0
      if (.not. circuit%follows > 0) then
         made = line_overlap(point%line, spot_force, law%normal%line_penalty())
         deeper = max(0.0_dp, made%overlap - point%cell%overlap)
         ! the strip stays as it was made while less of it touches
         samples%doverlap(1, :n) = samples%doverlap(1, :n) - 1
      end if
      do i = 1, n
         force(i) = line_force(point%line, samples%overlap(i) + deeper, law%normal%line_penalty())
         call spot_at_sample(law, pair, point, force(i)%force, at(i), info)
         if (info /= spot_ok) point%law_status = law_bad_data
      end do
      call cell_integral(samples, at(:n)%conductance, at(:n)%dconductance_dforce*force(:n)%stiffness, integral, &
         derivative)
      do i = 1, 2
         by_resistivity(i) = dot_product(samples%weight(:n), at(:n)%dconductance_dresistivity(i))
      end do
      call blend_spot_of_crossing(law, pair, samples, deeper, circuit%follows, point, integral, derivative, &
         by_resistivity)
      density = point%weight/sum(point%cell%reach)
      circuit%spot%conductance = density*integral
      circuit%spot%dconductance_dresistivity = density*by_resistivity
      circuit%spot%semi_minor = maxval(at(:n)%semi_minor)
      circuit%spot%semi_major = density*sum(samples%weight(:n))/2
      ! an ellipse of the same area
      if (.not. law%spot%is_per_length) circuit%spot%semi_major = 4/pi*circuit%spot%semi_major
      circuit%dconductance = density*(derivative(2)*course%dslope + derivative(3)*course%dbend &
         - derivative(1)*point%kinematics%dgap)
   end subroutine spot_of_cell

   !> As far as the overlap is short beside the radii, wires that yield conduct by the spot of their crossing: spread
   !> over the lens, a cell has what touches of it.
   pure subroutine blend_spot_of_crossing(law, pair, samples, deeper, follows, point, integral, derivative, &
      by_resistivity)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> Of the cell
      type(cell_samples_t), intent(in) :: samples
      !> How much deeper the wires were when the spot was made [m]; 1: it follows the present force, 0: it stays
      real(dp), intent(in) :: deeper, follows
      type(contact_point_t), intent(inout) :: point
      !> In: of the strip, out: of both; by overlap, slope and curvature (3)
      real(dp), intent(inout) :: integral, derivative(n_of_cell)
      !> Likewise, by the resistivities
      real(dp), intent(inout) :: by_resistivity(2)
      type(lens_at_place_t) :: lens
      type(contact_spot_t) :: spot
      real(dp) :: share, dshare(n_of_cell), touching, dtouching(n_of_cell), density, ddensity(n_of_cell)
      real(dp) :: ones(n_samples)
      integer :: info

      if (law%spot%hardness_number == 0 .or. law%normal%is_per_length_only() .or. .not. point%in_lens) return
      lens = lens_at_place(point%line, point%cell%overlap + deeper, point%cell%slope, point%cell%bend, &
         law%normal%line_penalty())
      if (.not. lens%force > 0) return
      associate (radius => minval(pair%radius))
         share = 1 - share_of_line(lens%half_length/radius)
         dshare = -slope_of_line_share(lens%half_length/radius)*lens%dhalf_length/radius
      end associate
      call contact_spot(law%spot, lens%force, pair, point%ellipse, spot, info)
      if (info /= spot_ok) point%law_status = law_bad_data
      density = spot%conductance/(2*lens%half_length)
      ddensity = spot%dconductance_dforce/(2*lens%half_length)*lens%dforce - density/lens%half_length*lens%dhalf_length
      ! how deep it was stays
      if (.not. follows > 0) then
         ddensity(1) = 0
         dshare(1) = 0
      end if
      ones = 1
      call cell_integral(samples, ones(:samples%n), 0*ones(:samples%n), touching, dtouching)
      derivative = (1 - share)*derivative + share*(density*dtouching + ddensity*touching) &
         + dshare*(density*touching - integral)
      integral = (1 - share)*integral + share*density*touching
      by_resistivity = (1 - share)*by_resistivity + share*touching*spot%dconductance_dresistivity/(2*lens%half_length)
   end subroutine blend_spot_of_crossing

   !> Conductance per length under a force per length, and how wide the strip is.
   pure subroutine spot_at_sample(law, pair, point, force, spot, info)
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
   end subroutine spot_at_sample

   !> A resistance that is given per length, over the lens of a crossing.
   pure subroutine spot_per_length(law, pair, spot_force, point, spot)
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
      weight = weight_of_lens(point)
      spot%conductance = weight*spot%conductance
      ! by the force that the point has, which may be that of an ellipse
      spot%dconductance_dforce = weight*dconductance_dgap/slope_of(law, point)
      spot%semi_major = lens%half_length
   end subroutine spot_per_length

   !> The strip at a place of a line, made by a force per length.
   pure type(line_spot_t) function strip_of(law, point, spot_force) result(strip)
      type(spot_law_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point
      !> [N/m]
      real(dp), intent(in) :: spot_force

      strip = line_spot(point%line, spot_force, number_of(law, law%film_number), number_of(law, law%hardness_number))
   end function strip_of

   !> The lens of a crossing in which its spot was made: the present one, or that of a larger force.
   pure type(lens_t) function lens_of_spot(law, pair, point, spot_force) result(lens)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> Not smaller than the present force [N]
      real(dp), intent(in) :: spot_force
      type(overlap_of_force_t) :: made
      real(dp) :: gap

      gap = point%gap
      if (spot_force > point%force/point%weight) then
         made = overlap_of_point(law%normal, pair, point, point%weight*spot_force, point%weight)
         gap = -made%overlap
      end if
      lens = lens_force(point%line, gap, point%law_sine, law%normal%line_penalty())
   end function lens_of_spot

   !> The strip along the lens of a crossing.
   pure type(contact_spot_t) function spot_of_lens(law, pair, point, lens) result(spot)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      type(lens_t), intent(in) :: lens
      type(lens_spot_t) :: strip

      strip = lens_spot(point%line, lens, number_of(law%spot, law%spot%film_number), &
         number_of(law%spot, law%spot%hardness_number))
      spot%semi_major = lens%half_length
      spot%semi_minor = strip%half_width
      spot%conductance = weight_of_lens(point)*strip%conductance
      spot%dconductance_dforce = weight_of_lens(point)*strip%dconductance_dgap/slope_of(law, point)
      spot%dconductance_dresistivity = weight_of_lens(point)*strip%dconductance_dresistivity
   end function spot_of_lens

   !> dF/dg of the force by which the spot of a lens follows the gap [N/m].
   pure real(dp) function slope_of(law, point)
      type(interaction_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point
      type(force_of_gap_t) :: followed

      followed = law_of_spot(law%normal, point)
      slope_of = followed%dforce_dgap
   end function slope_of

   !> One of the numbers of a law; 0 where it has none.
   pure real(dp) function number_of(law, place)
      type(spot_law_t), intent(in) :: law
      !> Which of its numbers, or 0
      integer, intent(in) :: place

      number_of = 0
      if (place > 0) number_of = law%data(place)
   end function number_of

   !> What results show of a current.
   pure subroutine keep_current(electricity, circuit, point)
      type(contact_electricity_t), intent(in) :: electricity
      type(spot_in_circuit_t), intent(in) :: circuit
      type(contact_point_t), intent(inout) :: point

      point%semi_major = circuit%spot%semi_major
      point%semi_minor = circuit%spot%semi_minor
      point%conductance = circuit%spot%conductance
      point%current = electricity%current
      point%voltage_gap = electricity%voltage_gap
      point%series_resistance = circuit%series_resistance
      point%heat_inside = point%current**2*circuit%series_resistance*(1 - [point%xi_bar, point%xi]**2)
   end subroutine keep_current

   !> A contact that remembers its spot is no longer at it. With friction it has slipped; without, it has moved along
   !> one of its wires by more than the spot.
   pure logical function leaves_spot(law, wires, pair, point) result(leaves)
      type(interaction_t), intent(in) :: law
      type(wires_t), intent(in) :: wires
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      real(dp) :: moved(2)

      leaves = point%friction%status == friction_slip
      if (law%friction > 0 .or. .not. point%history%largest_force > 0) return
      moved = abs(arc_from_to(point%history%spot_arc, [point%arc_bar, point%arc], &
         wires%circumference(wires%wire([point%element_bar, point%element]))))
      leaves = maxval(moved) > size_of_spot(law, pair, point, point%history%largest_force)
   end function leaves_spot

   !> Greater half axis of a spot, half length of a lens, half width of a strip [m]; where the law has none, those of
   !> elastic wires.
   pure real(dp) function size_of_spot(law, pair, point, force) result(half_size)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> That has made the spot: of a crossing [N], of a place of a line per length [N/m]
      real(dp), intent(in) :: force
      type(contact_spot_t) :: spot
      type(line_spot_t) :: strip
      type(lens_t) :: lens
      integer :: info

      if (point%line_place > 0) then
         strip = strip_of(law%spot, point, force)
         half_size = strip%half_width
      else if (law%spot%is_per_length .or. is_lens(law%normal, point)) then
         lens = lens_of_spot(law, pair, point, force)
         half_size = lens%half_length
      else
         call contact_spot(law%spot, force, pair, point%ellipse, spot, info)
         half_size = spot%semi_major
         if (info /= spot_ok .or. .not. half_size > 0) half_size = ellipse_of(pair, point%law_angle)*force**(1.0_dp/3)
      end if
   end function size_of_spot

   !> Greater half axis of the Hertz ellipse of 1 N [m].
   pure real(dp) function ellipse_of(pair, angle) result(semi_major)
      type(wire_pair_t), intent(in) :: pair
      !> Between the axes [rad]
      real(dp), intent(in) :: angle
      type(hertz_ellipse_t) :: ellipse
      integer :: info

      semi_major = 0
      call hertz_ellipse(pair%radius, pair%young, pair%poisson, angle, ellipse, info)
      if (info == hertz_ok) semi_major = ellipse%semi_major
   end function ellipse_of

end module litz_contact_spots
