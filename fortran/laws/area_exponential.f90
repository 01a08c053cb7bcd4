!> EXPONENTIAL per area: rough surfaces, `p = p_0 exp(delta/l)`, also where the mean planes are apart.
!>
!> Source: J. A. Greenwood, J. B. P. Williamson, Proc. R. Soc. A 295 (1966) 300, for an exponential distribution of
!> heights, of which `l` is the standard deviation.
module litz_area_exponential
   use litz_area_law, only: pressure_law_t, area_input_t, pressure_t
   use litz_law_words, only: law_field_t
   implicit none
   private
   public :: area_exponential

contains

   pure type(pressure_law_t) function area_exponential() result(law)
      law%name = 'EXPONENTIAL'
      law%meaning = 'rough surfaces'
      law%fields(1) = law_field_t('p_0', 'Pa', 'contact pressure at gap 0')
      law%fields(2) = law_field_t('decay', 'm', 'distance over which the pressure falls by 1/e')
      law%pressure_of_overlap => exponential_pressure
   end function area_exponential

   pure function exponential_pressure(given) result(found)
      type(area_input_t), intent(in) :: given
      type(pressure_t) :: found

      associate (p_0 => given%data(1), l => given%data(2))
         found%pressure = p_0*exp(given%overlap/l)                               ! p = p_0 exp(delta/l)
         found%stiffness = found%pressure/l
         found%dstiffness_ddelta = found%stiffness/l
      end associate
   end function exponential_pressure

end module litz_area_exponential
