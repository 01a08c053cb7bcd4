!> The normal force of every contact at its present gap, and what an iteration linearises about.
!>
!> The contact force is an independent variable of the iteration (theory section 9): the law is linearised as
!> `delta(F)`, whether a point is active follows from the predicted gap and force, and the geometric stiffness takes the
!> independent force. The converged force is that of the law at the true gap.
module litz_normal_forces
   use litz_kinds, only: dp, pi
   use litz_contact_lens, only: angle_of_law
   use litz_contact_points, only: contact_point_t, law_ok, law_parallel, law_too_curved, law_compacts
   use litz_cut_forces, only: cut_force, settle_cut, ellipse_of_parts, spot_of_parts, kept_part, leaves_nothing, scaled
   use litz_cut_lens, only: is_cut
   use litz_element_library, only: elements_t, material_at, material_place_t
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_ok
   use litz_lap_of_place, only: lap_force_t, force_along_lap
   use litz_law_input, only: wire_pair_t
   use litz_lens_forces, only: law_of_lens, find_overlap_of_lens
   use litz_lens_law, only: lens_t, lens_force, lens_energy
   use litz_model, only: model_t, interaction_t
   use litz_normal_law, only: normal_law_t, force_of_gap_t, force_at_gap, linearise
   use litz_normal_yielding, only: dent_of_wires, state_of_wires
   use litz_parallel, only: worth_threads
   use litz_place_forces, only: place_law_t, law_of_place
   use litz_round_end, only: ellipse_of_end
   use litz_turned_lenses, only: line_of_point, turn_lens
   use litz_yielding_lens, only: yielding_lens_t, lens_state_t, state_of_lens, overlap_of_yielding_lens, &
      with_dent
   use litz_yielding_place, only: place_state_t, state_of_place
   use litz_yielding_spot, only: dent_t, yielding_state_t, widest_spot
   use litz_yielding_wires, only: lens_of_wires, place_of_wires, depth_of_lens
   implicit none
   private
   public :: apply_normal_law, wires_of, line_of_point, is_lens, law_of_spot, share_of_ellipse, weight_of_lens
   public :: settle_ends, first_overlap

   !> At first touch the line of the Hertz law goes to the force of an overlap of at most this fraction of the radius
   real(dp), parameter :: first_overlap = 1.0e-3_dp

contains

   !> Both wires of a point, barred first, at the temperatures of its places.
   pure type(wire_pair_t) function wires_of(model, elements, point) result(pair)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point
      type(material_place_t) :: there(2)
      integer :: both(2)

      both = [point%element_bar, point%element]
      there = [material_at(model, elements, both(1), point%xi_bar), material_at(model, elements, both(2), point%xi)]
      pair%young = merge(point%lens%young, there%young, point%lens%is_mixed)
      pair%poisson = merge(point%lens%poisson, there%poisson, point%lens%is_mixed)
      pair%resistivity = merge(point%present_parts%resistivity, there%resistivity, point%present_parts%is_mixed)
      pair%dresistivity = merge(0.0_dp, there%dresistivity, point%present_parts%is_mixed)
      pair%dtemperature = there%dtemperature
      ! stiffness is that of the reference section, in contacts as in beams; gaps see the swelling
      pair%radius = model%sections(model%element_section(both))%contact_radius + point%lens%of_ball
      ! bent ones as the straight ones that stand for them
      if (point%bends%as_equal) pair%radius = 2*product(pair%radius)/sum(pair%radius)
      pair%radius = pair%radius/point%bends%ratio
      if (model%interactions(model%contact_pairs(point%pair)%interaction)%voltage_correction) then
         pair%series_resistance = elements%resistivity(both)*elements%length(both)/(4*elements%area(both))
         ! filaments carry the current without a voltage
         where (elements%superconducting(both)) pair%series_resistance = 0
      end if
   end function wires_of

   !> Force of every point at its present gap, and the force and stiffness this iteration linearises about.
   subroutine apply_normal_law(model, elements, points)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(inout) :: points(:)
      integer :: i

      !$omp parallel do schedule(static) if (size(points) >= worth_threads)
      do i = 1, size(points)
         call evaluate(model, elements, points(i))
      end do
      !$omp end parallel do
   end subroutine apply_normal_law

   subroutine evaluate(model, elements, point)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(inout) :: point
      type(wire_pair_t) :: pair
      integer :: info
      logical :: needs_line

      info = hertz_ok
      call find_dent(model, elements, point)
      point%closed = point%gap < -point%dent_depth .and. point%weight > 0
      point%active = merge(point%predicted_gap < -point%dent_depth, point%closed, point%predicted) &
         .and. point%weight > 0
      point%at_gap = force_of_gap_t()
      point%at_mixed = force_of_gap_t()
      point%slide_force = 0
      point%lap%round_end%force = 0
      if (point%law_status /= law_too_curved) point%law_status = law_ok
      point%force = 0
      point%stiffness = 0
      point%iteration_force = 0
      point%geometric_force = 0
      if (point%active .or. point%closed) point%geometric_force = max(point%mixed_force, 0.0_dp)
      if (.not. point%active) point%mixed_force = 0
      associate (law => model%interactions(model%contact_pairs(point%pair)%interaction))
         needs_line = point%weight > 0 .and. (point%line_place > 0 .or. is_lens(law%normal, point) .or. &
            law%spot%is_per_length .or. law%heat%is_per_length .or. law%spot_memory)
         if (.not. (point%active .or. point%closed .or. needs_line)) return
         pair = wires_of(model, elements, point)
         if (needs_line) point%line = line_of_point(pair, point)
         if (.not. (point%active .or. point%closed)) return
         if (point%line_place > 0) then
            call find_law_of_end(law%normal, pair, point)
            call press_line(law%normal%line_penalty(), point)
         else if (is_lens(law%normal, point)) then
            if ((law%spot%uses_ellipse .or. law%heat%uses_ellipse) .and. share_of_ellipse(law%normal, point) > 0) then
               call find_ellipse(pair, point)
            end if
            if (law%normal%yields()) then
               call press_yielding_lens(law%normal, pair, point)
            else
               call press_lens(law%normal, pair, point)
            end if
         else
            if (law%normal%yields()) then
               call find_ellipse_of_metal(law%normal, pair, point)
            else if (law%normal%uses_ellipse .or. law%spot%uses_ellipse .or. law%heat%uses_ellipse) then
               call find_ellipse(pair, point)
            end if
            if (point%law_status /= law_ok) return
            call press_point(law%normal, pair, point)
            if (law%normal%yields()) call follow_yielding(law, pair, point)
         end if
         if (point%line_place == 0 .and. point%closed .and. is_shaped(law%normal, point)) then
            call spot_of_parts(pair, point, info)
         end if
      end associate
      point%force = point%at_gap%force
   end subroutine evaluate

   !> The dent that wires which yield have from before, at the present angle.
   pure subroutine find_dent(model, elements, point)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(inout) :: point
      type(wire_pair_t) :: pair
      type(dent_t) :: dent
      type(yielding_lens_t) :: lens

      associate (law => model%interactions(model%contact_pairs(point%pair)%interaction)%normal)
         if (.not. law%yields()) return
         point%dent_depth = 0
         point%yielding = yielding_state_t()
         point%yielded = 0
         point%yielding_force = 0
         point%felt_force = point%history%dent%felt_force()
         if (.not. point%weight > 0) return
         pair = wires_of(model, elements, point)
         if (point%line_place > 0) then
            point%line = line_of_point(pair, point)
            point%yielding_place = place_of_wires(law, pair, point)
            point%dent_depth = point%yielding_place%dent%depth
            return
         end if
         point%deepest = 0
         if (.not. point%felt_force > 0) return
         if (is_lens(law, point)) then
            point%line = line_of_point(pair, point)
            lens = lens_of_wires(law, pair, point)
            point%felt_force = lens%felt
            point%deepest = lens%deepest
            point%dent_depth = depth_of_lens(lens)
            return
         end if
         call find_ellipse_of_metal(law, pair, point)
         if (.not. point%ellipse%semi_major > 0) return
         dent = dent_of_wires(law, pair, point%ellipse, point%history%dent%at_any_angle())
         point%felt_force = dent%force
         point%deepest = dent%overlap
         point%dent_depth = dent%depth
      end associate
   end subroutine find_dent

   !> What the contact of wires that yield is at the present gap.
   pure subroutine follow_yielding(law, pair, point)
      type(interaction_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(inout) :: point
      type(yielding_state_t) :: before
      real(dp) :: dissipated

      if (.not. point%closed) return
      call state_of_wires(law%normal, pair, point%ellipse, point%history%dent%at_any_angle(), point%gap, &
         law%spot_memory, point%yielding, dissipated)
      if (point%yielding%area > pi*(widest_spot*minval(pair%radius))**2) point%law_status = law_compacts
      ! less the energy by which turning out of the dent presses the wires
      if (has_turned_in_dent(point)) then
         call state_of_wires(law%normal, pair, point%ellipse, point%history%dent%at_last_angle(), point%gap, &
            law%spot_memory, before, dissipated)
         dissipated = dissipated + before%energy - point%yielding%energy
      end if
      point%yielded = point%weight*dissipated
      point%yielding_force = point%yielding%force
   end subroutine follow_yielding

   !> The dent that is felt is not that at the last angle.
   pure logical function has_turned_in_dent(point)
      type(contact_point_t), intent(in) :: point

      has_turned_in_dent = point%history%dent%felt > 0 .and. abs(point%felt_force - point%history%dent%felt) > 0
   end function has_turned_in_dent

   !> A crossing whose force is the integral of the law per length over its lens.
   pure logical function is_lens(law, point)
      type(normal_law_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point

      is_lens = point%line_place == 0 .and. (point%section_share > 0 .or. law%is_per_length_only())
   end function is_lens

   !> What the spot of crossed wires counts beside the strip along the lens, whose conductances differ where there is a
   !> film or a hardness: all as the section begins to count, nothing where it wholly does.
   pure real(dp) function share_of_ellipse(law, point) result(share)
      type(normal_law_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point

      share = 1 - point%section_share
      if (law%is_per_length_only()) share = 0
   end function share_of_ellipse

   pure subroutine find_ellipse(pair, point)
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(inout) :: point
      integer :: info

      call hertz_ellipse(pair%radius, pair%young, pair%poisson, point%law_angle, point%ellipse, info)
      if (info /= hertz_ok) point%law_status = law_parallel
   end subroutine find_ellipse

   !> The same where the metal yields: next to an end or a joint it feels one ellipse that has the force of all shapes
   !> there, as elastic wires would. It stays within an iteration.
   pure subroutine find_ellipse_of_metal(law, pair, point)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(inout) :: point
      integer :: info

      if (is_cut(point%lens)) then
         if (point%gap < 0 .and. .not. point%lens%has_energies) call settle_ends(law, pair, point)
         if (any(point%force_part > 0)) then
            call ellipse_of_parts(pair, point, info)
            if (info == hertz_ok) return
         end if
      end if
      call find_ellipse(pair, point)
   end subroutine find_ellipse_of_metal

   !> The law of a point that ends or joints cut: a penalty per contact does not ask for its shape, and metal that
   !> yields has the ellipse of all shapes.
   pure logical function is_shaped(law, point)
      type(normal_law_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point

      is_shaped = is_cut(point%lens) .and. .not. (law%is_straight .or. law%yields())
   end function is_shaped

   !> The law that its spot follows, by the angle of the axes: a lens has what the ends leave of it as in the last state
   !> in balance.
   pure type(force_of_gap_t) function law_of_spot(law, point) result(found)
      type(normal_law_t), intent(in) :: law
      type(contact_point_t), intent(in) :: point

      real(dp) :: slope, curvature

      found = point%at_gap
      call angle_of_law(point, slope, curvature)
      found%dforce_dangle = found%dforce_dangle*slope
      if (is_lens(law, point) .and. point%cut > 0) found%dforce_dgap = found%dforce_dgap*kept_part(point) &
         /(point%cut*point%cut_stiffness)
   end function law_of_spot

   !> Share of the contact that its lens carries, as it stays within an iteration.
   pure real(dp) function weight_of_lens(point) result(weight)
      type(contact_point_t), intent(in) :: point

      weight = point%weight*kept_part(point)
   end function weight_of_lens

   !> Bring up to date what ends and joints change of the law.
   pure subroutine settle_ends(law, pair, point)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> Closed, with its shares
      type(contact_point_t), intent(inout) :: point
      real(dp) :: energy, by_angle(2)

      energy = 0
      if (is_lens(law, point)) call lens_energy(line_of_point(pair, point), point%gap, point%law_sine, &
         law%line_penalty(), energy, by_angle(1), by_angle(2))
      call settle_cut(law, pair, energy, point)
   end subroutine settle_ends

   !> A crossing, with the share that it carries.
   pure subroutine press_point(law, pair, point)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(inout) :: point
      type(force_of_gap_t) :: base
      real(dp) :: weight

      base = force_at_gap(law, point%gap, pair, point%ellipse, point%history%dent%at_any_angle())
      call press(law, pair, base, point)
      if (.not. point%active) return
      weight = point%weight*point%cut
      point%mixed_force = point%mixed_force/weight
      call linearise(law, point%gap, first_overlap*minval(pair%radius), pair, point%ellipse, point%mixed_force, &
         point%stiffness, point%iteration_force, point%at_mixed, point%history%dent%at_any_angle(), point%dent_depth)
      point%at_mixed = scaled(point%at_mixed, weight)
      call follow_cut(weight, point)
   end subroutine press_point

   !> Force and energy at the present gap.
   pure subroutine press(law, pair, base, point)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> Of a whole contact without ends
      type(force_of_gap_t), intent(in) :: base
      type(contact_point_t), intent(inout) :: point

      if (is_cut(point%lens) .and. (is_shaped(law, point) .or. is_lens(law, point) .and. .not. law%yields())) then
         call cut_force(law, pair, base, point)
      else
         point%cut = 1
         if (is_cut(point%lens) .and. law%yields()) then
            ! the ellipse of a short one is that of its parts
            if (is_lens(law, point)) point%cut = kept_part(point)
            if (leaves_nothing(point)) point%cut = 0
         end if
         point%cut_stiffness = 1
         point%at_gap = scaled(base, point%weight*point%cut)
      end if
      ! nothing is left between its ends
      if (.not. point%cut > 0 .or. point%closed .and. .not. point%at_gap%force > 0) then
         point%active = .false.
         point%closed = .false.
         point%at_gap = force_of_gap_t()
      end if
   end subroutine press

   !> What an iteration follows, from that of a whole contact without ends: its force at the present gap, but for
   !> squares of what the mixed force is off, and how it changes from there, which the ends may make much less.
   pure subroutine follow_cut(weight, point)
      !> Part of its force
      real(dp), intent(in) :: weight
      !> In: with these forces and the stiffness of the whole contact
      type(contact_point_t), intent(inout) :: point

      point%mixed_force = weight*point%mixed_force
      point%iteration_force = weight*point%iteration_force
      point%stiffness = weight*point%cut_stiffness*point%stiffness
   end subroutine follow_cut

   !> A crossing whose lens is long beside the radii: the integral of the law per length over it. At first touch the
   !> line goes through the touch, as `linearise` has it.
   pure subroutine press_lens(normal, pair, point)
      type(normal_law_t), intent(in) :: normal
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(inout) :: point
      type(lens_t) :: lens
      type(force_of_gap_t) :: base
      real(dp) :: penalty, first, overlap, weight

      penalty = normal%line_penalty()
      lens = lens_force(point%line, point%gap, point%law_sine, penalty)
      base = law_of_lens(point%line, lens, point%gap, point%law_sine, penalty)
      call press(normal, pair, base, point)
      if (.not. point%active) return
      weight = point%weight*point%cut
      first = first_overlap*minval(pair%radius)
      if (point%mixed_force > 0) then
         call find_overlap_of_lens(point%line, point%law_sine, penalty, point%mixed_force/weight, &
            max(-point%gap, first), overlap, lens)
      else
         overlap = merge(min(-point%gap, first), first, point%gap < 0)
         lens = lens_force(point%line, -overlap, point%law_sine, penalty)
      end if
      point%stiffness = -lens%dforce_dgap
      if (.not. point%mixed_force > 0) point%stiffness = lens%force/overlap
      point%mixed_force = lens%force
      point%iteration_force = point%mixed_force + point%stiffness*(-point%gap - overlap)
      point%at_mixed = scaled(law_of_lens(point%line, lens, -overlap, point%law_sine, penalty), weight)
      call follow_cut(weight, point)
   end subroutine press_lens

   !> The same of wires that yield.
   pure subroutine press_yielding_lens(normal, pair, point)
      type(normal_law_t), intent(in) :: normal
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(inout) :: point
      type(yielding_lens_t) :: lens
      type(lens_state_t) :: state, before
      real(dp) :: overlap, weight

      if (is_cut(point%lens) .and. point%gap < 0 .and. .not. point%lens%has_energies) call settle_ends(normal, pair, &
         point)
      lens = lens_of_wires(normal, pair, point)
      state = state_of_lens(lens, -point%gap)
      if (state%has_yielded) call turn_lens(normal, pair, point, -point%gap, state%law)
      call press(normal, pair, state%law, point)
      if (point%closed) then
         point%yielding = state%spot
         point%yielded = point%weight*point%cut*state%dissipated
         if (has_turned_in_dent(point)) then
            before = state_of_lens(with_dent(lens, point%history%dent%at_last_angle()), -point%gap)
            point%yielded = point%weight*point%cut*(before%dissipated + before%law%energy - state%law%energy)
         end if
         point%yielding_force = state%law%force
      end if
      if (.not. point%active) return
      weight = point%weight*point%cut
      overlap = point%dent_depth + first_overlap*minval(pair%radius)
      if (point%mixed_force > 0) then
         overlap = overlap_of_yielding_lens(lens, point%mixed_force/weight)
      else if (point%gap < -point%dent_depth) then
         overlap = min(overlap, -point%gap)
      end if
      state = state_of_lens(lens, overlap)
      point%stiffness = -state%law%dforce_dgap
      if (.not. point%mixed_force > 0) point%stiffness = state%law%force/(overlap - point%dent_depth)
      point%mixed_force = state%law%force
      point%iteration_force = point%mixed_force + point%stiffness*(-point%gap - overlap)
      if (state%has_yielded) call turn_lens(normal, pair, point, overlap, state%law)
      point%at_mixed = scaled(state%law, weight)
      call follow_cut(weight, point)
   end subroutine press_yielding_lens

   !> The Hertz contact of the round end of a wire; elastic metal alone has it.
   pure subroutine find_law_of_end(law, pair, point)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      !> At a place
      type(contact_point_t), intent(inout) :: point
      type(hertz_ellipse_t) :: ellipse

      associate (round => point%lap%round_end)
         round%hertz = 0
         if (.not. round%share > 0 .or. law%yields() .or. law%line_penalty() > 0) return
         ellipse = ellipse_of_end(pair, point%kinematics%angle)
         if (ellipse%approach > 0) round%hertz = ellipse%approach**(-1.5_dp)                 ! delta = cd F^(2/3)
      end associate
   end subroutine find_law_of_end

   !> A point of a line contact: the law per length times the length that it stands for, linearised about the gap that
   !> was predicted: what the motion has done to the gap besides is a matter of the next step, not of the force.
   pure subroutine press_line(penalty, point)
      !> eps_l [N/m^2]; 0: the elastic law
      real(dp), intent(in) :: penalty
      type(contact_point_t), intent(inout) :: point
      type(place_law_t) :: law
      type(lap_force_t) :: along

      law = law_of_place(point, -point%gap, penalty)
      if (allocated(point%yielding_place)) call follow_place(point)
      point%at_gap = force_of_gap_t(force=law%force, dforce_dgap=-law%stiffness, energy=law%energy)
      point%lap%round_end%force = law%of_end%force
      point%lap%force = law%per_length%force
      point%lap%stiffness = law%per_length%stiffness
      if (point%lens%near(1) .and. point%closed) then
         along = force_along_lap(point%lap, point%line, point%weight, law%per_length, law%of_end)
         point%slide_force = [along%force, 0.0_dp]
         point%slide_by_overlap = [along%by_overlap, 0.0_dp]
         point%slide_stiffness = 0
         point%slide_stiffness(1, 1) = along%stiffness
      end if
      if (.not. point%active) return
      if (.not. point%predicted) point%predicted_gap = point%gap
      law = law_of_place(point, -point%predicted_gap, penalty)
      point%mixed_force = law%force
      point%geometric_force = point%mixed_force
      point%stiffness = law%stiffness
      point%iteration_force = point%mixed_force + point%stiffness*(point%predicted_gap - point%gap)
   end subroutine press_line

   !> What yielding has dissipated at a place, and the force per length that makes its dent.
   pure subroutine follow_place(point)
      type(contact_point_t), intent(inout) :: point
      type(place_state_t) :: state

      if (.not. point%closed) return
      state = state_of_place(point%yielding_place, -point%gap)
      point%yielded = point%weight*state%dissipated
      point%yielding_force = state%strip%force
   end subroutine follow_place

end module litz_normal_forces
