!> HERTZ: the inverse of the exact approach `delta(F) = cd F^(2/3)`, with `delta = -g`: the real compliance of two round
!> wires, which leaves no penalty to guess. The energy is `2 F delta/5`.
!>
!> Source: theory section 6; `cd` is that of litz_hertz.
module litz_normal_hertz
   use litz_kinds, only: dp
   use litz_law_input, only: law_input_t
   use litz_normal_law, only: normal_law_t, force_of_gap_t, overlap_of_force_t
   implicit none
   private
   public :: normal_hertz, elastic_force, elastic_overlap

contains

   pure function normal_hertz() result(law)
      type(normal_law_t) :: law

      law%name = 'HERTZ'
      law%meaning = 'the elastic approach of two wires, no data; the default when the keyword is left out'
      law%uses_ellipse = .true.
      law%is_elastic_line = .true.
      law%summary = 'Hertz force'
      law%title = 'law of Hertz'
      law%force_of_gap => elastic_force
      law%overlap_of_force => elastic_overlap
   end function normal_hertz

   pure function elastic_force(given) result(found)
      type(law_input_t), intent(in) :: given
      type(force_of_gap_t) :: found
      real(dp) :: scaled, slope

      associate (gap => given%gap, ellipse => given%ellipse)
         scaled = -gap/ellipse%approach
         found%force = scaled*sqrt(scaled)                                       ! delta = cd F^(2/3)
         found%dforce_dgap = 3*found%force/(2*gap)
         found%dforce_dangle = -3*found%force*ellipse%dapproach_dangle/(2*ellipse%approach)
         found%energy = 0.4_dp*found%force*abs(gap)                              ! 2 F delta/5
         slope = ellipse%dapproach_dangle/ellipse%approach
         found%denergy_dangle = -1.5_dp*found%energy*slope                       ! it goes with cd^(-3/2)
         found%d2energy_dangle2 = 1.5_dp*found%energy*(2.5_dp*slope**2 - ellipse%d2approach_dangle2/ellipse%approach)
      end associate
   end function elastic_force

   pure function elastic_overlap(given) result(found)
      type(law_input_t), intent(in) :: given
      type(overlap_of_force_t) :: found
      real(dp) :: cube_root

      if (given%force <= 0) return
      associate (cd => given%ellipse%approach)
         cube_root = given%force**(1.0_dp/3)
         found%overlap = cd*cube_root**2                                         ! delta = cd F^(2/3)
         found%stiffness = 1/(2*cd/(3*cube_root))
         found%dstiffness_dforce = found%stiffness/(3*given%force)               ! it goes with F^(1/3)
      end associate
   end function elastic_overlap

end module litz_normal_hertz
