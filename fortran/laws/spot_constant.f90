!> CONSTANT: a given resistance under any positive force, without a spot.
module litz_spot_constant
   use litz_law_input, only: law_input_t
   use litz_law_words, only: law_field_t
   use litz_spot_law, only: spot_law_t, contact_spot_t, spot_ok
   implicit none
   private
   public :: spot_constant

contains

   pure function spot_constant() result(law)
      type(spot_law_t) :: law

      law%name = 'CONSTANT'
      law%meaning = 'given resistance'
      law%fields(1) = law_field_t('R_c', 'ohm', 'resistance of a contact; with PER=LENGTH resistance times'// &
         ' length [ohm m]')
      law%can_be_per_length = .true.
      law%spot_of_force => constant_spot
   end function spot_constant

   pure subroutine constant_spot(given, spot, info)
      type(law_input_t), intent(in) :: given
      type(contact_spot_t), intent(out) :: spot
      !> `spot_ok`
      integer, intent(out) :: info

      info = spot_ok
      spot%conductance = 1/given%data(1)
   end subroutine constant_spot

end module litz_spot_constant
