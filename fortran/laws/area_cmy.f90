!> CMY per area: nominally flat rough surfaces that yield at their asperities.
!>
!> Source: M. G. Cooper, B. B. Mikic, M. M. Yovanovich, Int. J. Heat Mass Transfer 12 (1969) 279: `h = 1.25 k (m/sigma)
!> (p/H)^0.95` with the harmonic mean `k` of the conductivities, here those of current: `k = 2/(rho + rho_b)`.
module litz_area_cmy
   use litz_kinds, only: dp
   use litz_area_law, only: area_conductance_law_t, area_input_t, area_conductance_t, area_ok
   use litz_law_words, only: law_field_t
   implicit none
   private
   public :: area_cmy, cmy_conductance

contains

   pure type(area_conductance_law_t) function area_cmy() result(law)
      law%name = 'CMY'
      law%meaning = 'rough surfaces that yield at their asperities'
      law%uses_resistivity = .true.
      law%fields(1) = law_field_t('hardness', 'Pa', 'of the softer body')
      law%fields(2) = law_field_t('slope', '', 'mean absolute slope of the asperities, of both surfaces together')
      law%fields(3) = law_field_t('roughness', 'm', 'standard deviation of the heights, of both surfaces together')
      law%conductance_of_pressure => cmy_conductance
   end function area_cmy

   pure subroutine cmy_conductance(given, found, info)
      type(area_input_t), intent(in) :: given
      type(area_conductance_t), intent(out) :: found
      !> `area_ok`
      integer, intent(out) :: info
      real(dp) :: conductivity

      info = area_ok
      conductivity = 2/sum(given%bodies%resistivity)                             ! k = 2/(rho + rho_b)
      associate (p => given%normal%pressure, hardness => given%data(1), m => given%data(2), sigma => given%data(3))
         found%conductance = 1.25_dp*conductivity*(m/sigma)*(p/hardness)**0.95_dp
         found%dconductance_ddelta = 0.95_dp*found%conductance/p*given%normal%stiffness
      end associate
   end subroutine cmy_conductance

end module litz_area_cmy
