!> PLASTIC: circular spot whose area is force over hardness, `F = pi a^2 H`.
!>
!> Source: theory section 6.
module litz_spot_plastic
   use litz_kinds, only: pi
   use litz_law_input, only: law_input_t
   use litz_law_words, only: law_field_t
   use litz_spot_law, only: spot_law_t, contact_spot_t, spot_ok
   implicit none
   private
   public :: spot_plastic

contains

   pure function spot_plastic() result(law)
      type(spot_law_t) :: law

      law%name = 'PLASTIC'
      law%meaning = 'spot area is force/hardness'
      law%fields(1) = law_field_t('H', 'Pa', 'hardness')
      law%serves_lines = .true.
      law%hardness_number = 1
      law%spot_of_force => plastic_spot
   end function spot_plastic

   pure subroutine plastic_spot(given, spot, info)
      type(law_input_t), intent(in) :: given
      type(contact_spot_t), intent(out) :: spot
      !> `spot_ok`
      integer, intent(out) :: info

      info = spot_ok
      spot%semi_major = sqrt(given%force/(pi*given%data(1)))                     ! F = pi a^2 H
      spot%semi_minor = spot%semi_major
      spot%conductance = 4*spot%semi_major/sum(given%wires%resistivity)          ! R_c = (rho1+rho2)/(4a)
      spot%dconductance_dforce = spot%conductance/(2*given%force)
      spot%dconductance_dresistivity = -spot%conductance/sum(given%wires%resistivity)
   end subroutine plastic_spot

end module litz_spot_plastic
