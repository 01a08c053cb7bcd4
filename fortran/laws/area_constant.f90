!> CONSTANT per area: a given resistance times area under any positive pressure.
module litz_area_constant
   use litz_area_law, only: area_conductance_law_t, area_input_t, area_conductance_t, area_ok
   use litz_law_words, only: law_field_t
   implicit none
   private
   public :: area_constant

contains

   pure type(area_conductance_law_t) function area_constant() result(law)
      law%name = 'CONSTANT'
      law%meaning = 'given resistance times area'
      law%fields(1) = law_field_t('resistance', 'ohm m^2', 'resistance times area')
      law%conductance_of_pressure => constant_conductance
   end function area_constant

   pure subroutine constant_conductance(given, found, info)
      type(area_input_t), intent(in) :: given
      type(area_conductance_t), intent(out) :: found
      !> `area_ok`
      integer, intent(out) :: info

      info = area_ok
      found%conductance = 1/given%data(1)
   end subroutine constant_conductance

end module litz_area_constant
