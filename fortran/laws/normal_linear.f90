!> LINEAR: a penalty, `F = eps |g|`, with the energy `eps g^2/2`; per length along which wires touch, or in place of it,
!> `f = eps_l |g|`, whose integral over the overlap of wires that cross is their force (litz_lens_law).
!>
!> Source: theory sections 6 and 10.
module litz_normal_linear
   use litz_kinds, only: dp
   use litz_law_input, only: law_input_t
   use litz_law_words, only: law_field_t
   use litz_normal_law, only: normal_law_t, force_of_gap_t, overlap_of_force_t
   implicit none
   private
   public :: normal_linear

contains

   pure function normal_linear() result(law)
      type(normal_law_t) :: law

      law%name = 'LINEAR'
      law%meaning = 'a penalty'
      law%fields(1) = law_field_t('penalty', 'N/m', 'contact force per penetration, where wires cross; without it'// &
         ' that follows from eps_l', is_optional=.true.)
      law%fields(2) = law_field_t('eps_l', 'N/m^2', 'contact force per length and penetration, for wires that touch'// &
         ' along a line', is_optional=.true.)
      law%line_penalty_number = 2
      law%is_straight = .true.
      law%has_penalty = .true.
      law%force_of_gap => force_of_gap
      law%overlap_of_force => overlap_of_force
   end function normal_linear

   pure function force_of_gap(given) result(found)
      type(law_input_t), intent(in) :: given
      type(force_of_gap_t) :: found

      associate (eps => given%data(1))
         found%force = -eps*given%gap                                            ! F = eps |g|
         found%dforce_dgap = -eps
      end associate
      found%energy = 0.5_dp*found%force*abs(given%gap)
   end function force_of_gap

   pure function overlap_of_force(given) result(found)
      type(law_input_t), intent(in) :: given
      type(overlap_of_force_t) :: found

      found%overlap = given%force/given%data(1)
      found%stiffness = given%data(1)
   end function overlap_of_force

end module litz_normal_linear
