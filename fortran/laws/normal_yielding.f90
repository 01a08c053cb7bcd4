!> HERTZ with YIELD: two crossed wires whose metal yields in the spot, and keeps the dent of the largest force.
!>
!> Source: theory section 15; the law is that of litz_yielding_spot. While no metal has yielded it is that of Hertz.
!> The energy is the elastic one: it does not grow with what yielding dissipates.
module litz_normal_yielding
   use litz_kinds, only: dp
   use litz_hertz, only: hertz_ellipse_t, hertz_ellipse
   use litz_law_input, only: earlier_dent_t, law_input_t, wire_pair_t
   use litz_normal_hertz, only: normal_hertz, elastic_force, elastic_overlap
   use litz_normal_law, only: normal_law_t, force_of_gap_t, overlap_of_force_t
   use litz_yielding_spot, only: yielding_t, yielding_crossing, dent_t, dent_of_force, yielding_state_t, &
      state_at_overlap, state_at_force
   implicit none
   private
   public :: normal_yielding, dent_of_wires, state_of_wires, felt_by_wires

   !> Step of differences, over the sine of the angle and over the overlap
   real(dp), parameter :: part_of_step = 1.0e-4_dp

contains

   pure function normal_yielding(yield_stress, hardness) result(law)
      !> Of the softer metal [Pa]; a hardness of 0 is 2.8 times the yield stress
      real(dp), intent(in) :: yield_stress, hardness
      type(normal_law_t) :: law

      law = normal_hertz()
      law%yield_stress = yield_stress
      law%hardness = hardness
      law%title = 'law of wires that yield'
      law%force_of_gap => force_of_gap
      law%overlap_of_force => overlap_of_force
   end function normal_yielding

   pure function force_of_gap(given) result(found)
      type(law_input_t), intent(in) :: given
      type(force_of_gap_t) :: found
      type(yielding_t) :: law
      type(dent_t) :: dent
      type(yielding_state_t) :: state
      real(dp) :: felt, dfelt

      call yielding_of(given, law, felt, dfelt, dent)
      state = state_at_overlap(law, dent, -given%gap)
      if (is_elastic(law, dent, state%force)) then
         found = elastic_force(given)
      else
         found%force = state%force
         found%dforce_dgap = -state%stiffness
         found%dforce_dangle = state%dforce(1) + state%dforce(2)*dfelt
         found%energy = state%energy
         found%denergy_dangle = state%torque
         call add_torque_slopes(given, law, state, found)
      end if
   end function force_of_gap

   !> How the torque changes with the angle, and with the overlap otherwise than the force with the angle, where the
   !> dent changes with either: by central differences, whose error is some 1e-8 of what they give.
   pure subroutine add_torque_slopes(given, law, state, found)
      type(law_input_t), intent(in) :: given
      type(yielding_t), intent(in) :: law
      !> At the gap
      type(yielding_state_t), intent(in) :: state
      type(force_of_gap_t), intent(inout) :: found
      real(dp) :: step

      associate (angle => given%ellipse%angle, overlap => -given%gap)
         step = part_of_step*sin(angle)
         found%d2energy_dangle2 = (torque_at_angle(given, angle + step, state%loads) &
            - torque_at_angle(given, angle - step, state%loads))/(2*step)
         if (.not. state%loads) then
            ! dT/ddelta is F_psi of the dent as it is
            found%growth = state%dforce(1) - found%dforce_dangle
            return
         end if
         step = part_of_step*overlap
         found%growth = (torque_on_loading(law, overlap + step) - torque_on_loading(law, overlap - step))/(2*step) &
            - state%dforce(1)
      end associate
   end subroutine add_torque_slopes

   !> The torque at the gap and another angle, on the same branch [J/rad].
   pure real(dp) function torque_at_angle(given, angle, loads) result(torque)
      type(law_input_t), intent(in) :: given
      !> [rad]
      real(dp), intent(in) :: angle
      !> The force is the largest so far
      logical, intent(in) :: loads
      type(law_input_t) :: turned
      type(yielding_t) :: law
      type(dent_t) :: dent
      type(yielding_state_t) :: state
      real(dp) :: unused, unused_slope
      integer :: unused_info

      turned = given
      call hertz_ellipse(given%wires%radius, given%wires%young, given%wires%poisson, angle, turned%ellipse, unused_info)
      call yielding_of(turned, law, unused, unused_slope, dent)
      if (loads) then
         torque = torque_on_loading(law, -given%gap)
      else
         state = state_at_overlap(law, dent, -given%gap)
         torque = state%torque
      end if
   end function torque_at_angle

   !> The torque where the dent is that of the present force [J/rad].
   pure real(dp) function torque_on_loading(law, overlap) result(torque)
      type(yielding_t), intent(in) :: law
      !> [m]
      real(dp), intent(in) :: overlap
      type(yielding_state_t) :: state

      state = state_at_overlap(law, dent_t(), overlap)
      torque = state%torque
   end function torque_on_loading

   pure function overlap_of_force(given) result(found)
      type(law_input_t), intent(in) :: given
      type(overlap_of_force_t) :: found
      type(yielding_t) :: law
      type(dent_t) :: dent
      type(yielding_state_t) :: state
      real(dp) :: unused, unused_slope

      call yielding_of(given, law, unused, unused_slope, dent)
      if (is_elastic(law, dent, given%force)) then
         found = elastic_overlap(given)
      else
         state = state_at_force(law, dent, given%force)
         found%overlap = state%overlap
         found%stiffness = state%stiffness
         found%dstiffness_dforce = state%dstiffness_dforce
         found%elastic_stiffness = 2*law%modulus*state%disc                                ! F' = 2 E* a_e lambda
         found%delastic_dforce = 2*law%modulus*state%ddisc(1)/state%stiffness
      end if
   end function overlap_of_force

   !> The dent at the present angle.
   pure type(dent_t) function dent_of_wires(law, wires, ellipse, earlier) result(dent)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: wires
      !> At the present angle
      type(hertz_ellipse_t), intent(in) :: ellipse
      type(earlier_dent_t), intent(in) :: earlier
      type(yielding_t) :: unused
      real(dp) :: unused_force, unused_slope

      call yielding_of(law_input_t(wires=wires, ellipse=ellipse, yield_stress=law%yield_stress, &
         hardness=law%hardness, dent=earlier), unused, unused_force, unused_slope, dent)
   end function dent_of_wires

   !> The force whose dent wires feel at the present angle [N].
   pure real(dp) function felt_by_wires(law, wires, ellipse, earlier) result(felt)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: wires
      !> At the present angle
      type(hertz_ellipse_t), intent(in) :: ellipse
      type(earlier_dent_t), intent(in) :: earlier
      type(yielding_t) :: unused
      type(dent_t) :: unused_dent
      real(dp) :: unused_slope

      call yielding_of(law_input_t(wires=wires, ellipse=ellipse, yield_stress=law%yield_stress, &
         hardness=law%hardness, dent=earlier), unused, felt, unused_slope, unused_dent)
   end function felt_by_wires

   !> The contact at a gap.
   pure subroutine state_of_wires(law, wires, ellipse, earlier, gap, keeps_spot, state, dissipated)
      type(normal_law_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: wires
      !> At the present angle
      type(hertz_ellipse_t), intent(in) :: ellipse
      type(earlier_dent_t), intent(in) :: earlier
      !> Between the surfaces, negative in contact [m]
      real(dp), intent(in) :: gap
      !> A spot that opens is conducting metal as wide as the largest force has made it
      logical, intent(in) :: keeps_spot
      type(yielding_state_t), intent(out) :: state
      !> What making the dent larger has dissipated, at the present angle [J]
      real(dp), intent(out) :: dissipated
      type(yielding_t) :: wires_that_yield
      type(dent_t) :: dent
      real(dp) :: felt, dfelt

      call yielding_of(law_input_t(wires=wires, ellipse=ellipse, yield_stress=law%yield_stress, &
         hardness=law%hardness, dent=earlier), wires_that_yield, felt, dfelt, dent)
      state = state_at_overlap(wires_that_yield, dent, -gap)
      if (keeps_spot .and. state%force > 0 .and. state%opening < 1) then
         state%area = dent%area
         state%darea = [0.0_dp, dent%darea]
         state%disc = dent%disc
         state%ddisc = [0.0_dp, dent%ddisc]
      end if
      ! the dent that is felt changes with the angle
      state%dforce(1) = state%dforce(1) + state%dforce(2)*dfelt
      state%darea(2) = state%darea(2) + state%darea(3)*dfelt
      state%ddisc(2) = state%ddisc(2) + state%ddisc(3)*dfelt
      dissipated = state%dissipation
      if (dent%evenness > 0) dissipated = dissipated - (dent%work - dent%energy)
   end subroutine state_of_wires

   !> Nothing has yielded, and nothing yields at this force.
   pure logical function is_elastic(law, dent, force)
      type(yielding_t), intent(in) :: law
      type(dent_t), intent(in) :: dent
      !> [N]
      real(dp), intent(in) :: force

      is_elastic = .not. dent%evenness > 0 .and. force <= law%force
   end function is_elastic

   !> The law at the present angle, and the dent that is felt.
   pure subroutine yielding_of(given, law, felt, dfelt, dent)
      type(law_input_t), intent(in) :: given
      type(yielding_t), intent(out) :: law
      !> Force of this dent [N], and how it changes with the angle [N/rad]
      real(dp), intent(out) :: felt, dfelt
      type(dent_t), intent(out) :: dent
      type(yielding_state_t) :: first
      integer :: unused_info

      call yielding_crossing(given%ellipse, given%wires%poisson, [given%yield_stress, given%yield_stress], &
         given%hardness, law, unused_info)
      felt = given%dent%left*given%dent%force
      dfelt = 0
      if (felt > 0 .and. given%dent%overlap < huge(felt)) then
         first = state_at_overlap(law, dent_t(), given%dent%overlap)
         if (first%force < given%dent%force) then
            felt = given%dent%left*first%force
            dfelt = given%dent%left*first%dforce(1)
         end if
      end if
      dent = dent_of_force(law, felt)
   end subroutine yielding_of

end module litz_normal_yielding
