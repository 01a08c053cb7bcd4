!> The normal force of every contact at its present gap, and what an iteration linearises about.
!>
!> The contact force is an independent variable of the iteration (theory section 9): the law is linearised as
!> `delta(F)`, whether a point is active follows from the predicted gap and force, and the geometric stiffness takes the
!> independent force. The converged force is that of the law at the true gap.
module litz_normal_forces
   use litz_kinds, only: dp, pi
   use litz_contact_points, only: contact_point_t, law_ok, law_parallel, law_too_curved
   use litz_element_library, only: elements_t
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse, hertz_near_ends, hertz_ok
   use litz_law_input, only: wire_pair_t
   use litz_lens_law, only: lens_t, lens_force, lens_energy
   use litz_line_point, only: force_of_line
   use litz_line_law, only: line_wires_t, line_wires, line_force_t, line_force, line_overlap_t, line_overlap
   use litz_model, only: model_t
   use litz_normal_law, only: normal_law_t, force_of_gap_t, overlap_of_force_t, force_at_gap, overlap_at_force, &
      linearise
   use litz_parallel, only: worth_threads
   implicit none
   private
   public :: apply_normal_law, wires_of, is_lens, share_of_ellipse, weight_of_lens, overlap_of_point

   !> At first touch the Hertz law is linearised about the force of an overlap of at most this fraction of the radius
   real(dp), parameter :: first_overlap = 1.0e-3_dp
   !> The overlap of a lens at a force is found when its logarithm changes by less than this; steps at most
   real(dp), parameter :: tolerance = 1.0e-9_dp
   integer, parameter :: max_iterations = 20

contains

   !> Both wires of a point, barred first.
   pure type(wire_pair_t) function wires_of(model, elements, point) result(pair)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(contact_point_t), intent(in) :: point
      integer :: i, both(2)

      both = [point%element_bar, point%element]
      do i = 1, 2
         associate (material => model%materials(model%sections(model%element_section(both(i)))%material))
            pair%young(i) = material%young
            pair%poisson(i) = material%poisson
         end associate
      end do
      pair%radius = elements%radius(both)
      pair%resistivity = elements%resistivity(both)
      if (model%interactions(model%contact_pairs(point%pair)%interaction)%voltage_correction) then
         pair%series_resistance = pair%resistivity*elements%length(both)/(4*elements%area(both))
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
      logical :: needs_line

      point%closed = point%gap < 0 .and. point%weight > 0
      point%active = merge(point%predicted_gap < 0, point%closed, point%predicted) .and. point%weight > 0
      point%at_gap = force_of_gap_t()
      if (point%law_status /= law_too_curved) point%law_status = law_ok
      point%force = 0
      point%stiffness = 0
      point%iteration_force = 0
      point%geometric_force = 0
      if (point%active .or. point%closed) point%geometric_force = max(point%mixed_force, 0.0_dp)
      if (.not. point%active) point%mixed_force = 0
      associate (law => model%interactions(model%contact_pairs(point%pair)%interaction))
         needs_line = point%weight > 0 .and. (point%line_place > 0 .or. is_lens(law%normal, point) .or. &
            law%spot%is_per_length)
         if (.not. (point%active .or. point%closed .or. needs_line)) return
         pair = wires_of(model, elements, point)
         if (needs_line) point%line = line_of_point(pair, point)
         if (.not. (point%active .or. point%closed)) return
         if (point%line_place > 0) then
            call press_line(law%normal%line_penalty(), point)
         else if (is_lens(law%normal, point)) then
            if (law%spot%uses_ellipse .and. share_of_ellipse(law%normal, point) > 0) call find_ellipse(pair, point)
            call press_lens(law%normal, pair, point)
         else
            if (law%normal%uses_ellipse .or. law%spot%uses_ellipse) call find_ellipse(pair, point)
            if (point%law_status /= law_ok) return
            call press_point(law%normal, pair, point)
         end if
      end associate
      point%force = point%at_gap%force
   end subroutine evaluate

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

      if (is_near_end(point)) then
         call hertz_near_ends(pair%radius, pair%young, pair%poisson, point%law_angle, point%of_cylinder, point%of_end, &
            point%of_crossing, point%ellipse, info)
      else
         call hertz_ellipse(pair%radius, pair%young, pair%poisson, point%law_angle, point%ellipse, info)
      end if
      if (info /= hertz_ok) point%law_status = law_parallel
   end subroutine find_ellipse

   !> The end of a wire has a part of the force, or several legs of a joint have.
   pure logical function is_near_end(point)
      type(contact_point_t), intent(in) :: point

      is_near_end = any(point%of_end > 0 .or. abs(point%of_cylinder - 1) > 0)
   end function is_near_end

   !> Share of the contact that its lens carries. A law per length knows no round ends: they have the part of the force
   !> of crossed wires that Hertz has for the same overlap; the force of a penalty goes with the length of the lens.
   pure real(dp) function weight_of_lens(law, pair, point) result(weight)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      type(hertz_ellipse_t) :: ellipse, near_end
      real(dp) :: angle, of_cylinder
      integer :: info

      weight = point%weight
      if (.not. is_near_end(point)) return
      angle = point%law_angle
      of_cylinder = 0
      if (law%line_penalty() > 0) then
         angle = pi/2
         of_cylinder = point%of_crossing*product(point%of_cylinder)
      end if
      call hertz_ellipse(pair%radius, pair%young, pair%poisson, angle, ellipse, info)
      call hertz_near_ends(pair%radius, pair%young, pair%poisson, angle, point%of_cylinder, point%of_end, &
         point%of_crossing, near_end, info)
      weight = (ellipse%approach/near_end%approach)**1.5_dp                                ! delta = cd F^(2/3)
      if (law%line_penalty() > 0) weight = of_cylinder + (weight - of_cylinder)*point%law_sine
      weight = point%weight*weight
   end function weight_of_lens

   !> A crossing, with the share that it carries.
   pure subroutine press_point(law, pair, point)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(inout) :: point

      point%at_gap = scaled(force_at_gap(law, point%gap, pair, point%ellipse), point%weight)
      if (.not. point%active) return
      point%mixed_force = point%mixed_force/point%weight
      call linearise(law, point%gap, first_overlap*minval(pair%radius), pair, point%ellipse, point%mixed_force, &
         point%stiffness, point%iteration_force)
      point%mixed_force = point%weight*point%mixed_force
      point%stiffness = point%weight*point%stiffness
      point%iteration_force = point%weight*point%iteration_force
   end subroutine press_point

   !> A crossing whose lens is long beside the radii: the integral of the law per length over it.
   pure subroutine press_lens(normal, pair, point)
      type(normal_law_t), intent(in) :: normal
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(inout) :: point
      type(lens_t) :: lens
      type(force_of_gap_t) :: law
      real(dp) :: penalty, first, overlap, weight

      penalty = normal%line_penalty()
      weight = weight_of_lens(normal, pair, point)
      lens = lens_force(point%line, point%gap, point%law_sine, penalty)
      law = force_of_gap_t(lens%force, lens%dforce_dgap, lens%dforce_dangle, &
         lens_energy(point%line, point%gap, point%law_sine, penalty))
      point%at_gap = scaled(law, weight)
      if (.not. point%active) return
      first = first_overlap*minval(pair%radius)
      if (point%mixed_force > 0) then
         call find_overlap_of_lens(point%line, point%law_sine, penalty, point%mixed_force/weight, &
            max(-point%gap, first), overlap, lens)
      else
         overlap = merge(min(-point%gap, first), first, point%gap < 0)
         lens = lens_force(point%line, -overlap, point%law_sine, penalty)
      end if
      point%mixed_force = weight*lens%force
      point%stiffness = -weight*lens%dforce_dgap
      point%iteration_force = point%mixed_force + point%stiffness*(-point%gap - overlap)
   end subroutine press_lens

   !> The overlap of a lens at a force, by Newton's method in their logarithms, between which there is nearly a straight
   !> line.
   pure subroutine find_overlap_of_lens(line, sine, penalty, force, start, overlap, lens)
      type(line_wires_t), intent(in) :: line
      !> Sine of the lens, eps_l [N/m^2] or 0, force [N], and an overlap to start from [m]
      real(dp), intent(in) :: sine, penalty, force, start
      !> [m]
      real(dp), intent(out) :: overlap
      !> The lens at this overlap
      type(lens_t), intent(out) :: lens
      real(dp) :: step
      integer :: iteration

      overlap = start
      lens = lens_force(line, -overlap, sine, penalty)
      do iteration = 1, max_iterations
         step = log(force/lens%force)*lens%force/(-lens%dforce_dgap*overlap)
         ! the lens is no longer than the wires are apart
         overlap = min(overlap*exp(step), 0.5_dp*sum(line%radius))
         lens = lens_force(line, -overlap, sine, penalty)
         if (abs(step) < tolerance) exit
      end do
   end subroutine find_overlap_of_lens

   !> A point of a line contact: the law per length times the length that it stands for, linearised about the gap that
   !> was predicted: what the motion has done to the gap besides is a matter of the next step, not of the force.
   pure subroutine press_line(penalty, point)
      !> eps_l [N/m^2]; 0: the elastic law
      real(dp), intent(in) :: penalty
      type(contact_point_t), intent(inout) :: point
      type(line_force_t) :: law

      point%at_gap = force_of_line(line_force(point%line, -point%gap, penalty), point%weight)
      if (.not. point%active) return
      if (.not. point%predicted) point%predicted_gap = point%gap
      law = line_force(point%line, -point%predicted_gap, penalty)
      point%mixed_force = point%weight*law%force
      point%geometric_force = point%mixed_force
      point%stiffness = point%weight*law%stiffness
      point%iteration_force = point%mixed_force + point%stiffness*(point%predicted_gap - point%gap)
   end subroutine press_line

   !> The overlap of a point at a force, and its stiffness.
   pure type(overlap_of_force_t) function overlap_of_point(law, pair, point, force, weight) result(found)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> Greater than 0 [N], and the share of a crossing [-] or the length of a line [m] that carries it
      real(dp), intent(in) :: force, weight
      type(line_overlap_t) :: line
      real(dp) :: share

      if (point%line_place > 0) then
         line = line_overlap(point%line, force/weight, law%line_penalty())
         found = overlap_of_force_t(line%overlap, line%stiffness, line%dstiffness_dforce)
      else if (is_lens(law, point)) then
         share = weight*weight_of_lens(law, pair, point)/point%weight
         found = overlap_of_lens(law, pair, point, force/share)
         found%stiffness = share*found%stiffness
         return
      else
         found = overlap_at_force(law, force/weight, pair, point%ellipse)
      end if
      found%stiffness = weight*found%stiffness
   end function overlap_of_point

   !> The force of a lens goes with a power of the overlap, which hardly changes: with the exponent `k delta/F` the
   !> stiffness `k` changes by `(k - F/delta)/F`.
   pure type(overlap_of_force_t) function overlap_of_lens(law, pair, point, force) result(found)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point
      !> [N]
      real(dp), intent(in) :: force
      type(lens_t) :: lens

      call find_overlap_of_lens(point%line, point%law_sine, law%line_penalty(), force, &
         max(-point%gap, first_overlap*minval(pair%radius)), found%overlap, lens)
      found%stiffness = -lens%dforce_dgap
      found%dstiffness_dforce = (found%stiffness - force/found%overlap)/force
   end function overlap_of_lens

   pure type(force_of_gap_t) function scaled(law, share)
      type(force_of_gap_t), intent(in) :: law
      !> Share of a contact [-]
      real(dp), intent(in) :: share

      scaled = force_of_gap_t(share*law%force, share*law%dforce_dgap, share*law%dforce_dangle, share*law%energy)
   end function scaled

   !> The law per length of a point, at the angle of the lens to which it belongs.
   pure type(line_wires_t) function line_of_point(pair, point) result(line)
      type(wire_pair_t), intent(in) :: pair
      type(contact_point_t), intent(in) :: point

      line = line_wires(pair, point%law_angle)
      line%section = point%section_share*line%section
      line%electric_section = point%section_share*line%electric_section
   end function line_of_point

end module litz_normal_forces
