!> FILM per area: the asperities of CMY with a film on them, `1/h = 1/h_CMY + sigma_f H/p`.
!>
!> The film carries current over the true area of contact, a part `p/H` of the nominal one, as that of `FILM` per spot
!> does over the area of the spot.
module litz_area_film
   use litz_kinds, only: dp
   use litz_area_cmy, only: area_cmy, cmy_conductance
   use litz_area_law, only: area_conductance_law_t, area_input_t, area_conductance_t
   use litz_law_words, only: law_field_t
   implicit none
   private
   public :: area_film

contains

   pure type(area_conductance_law_t) function area_film() result(law)
      law = area_cmy()
      law%name = 'FILM'
      law%meaning = 'CMY with a film in series'
      law%fields(4) = law_field_t('sigma_f', 'ohm m^2', 'film resistance times true area')
      law%conductance_of_pressure => film_conductance
   end function area_film

   pure subroutine film_conductance(given, found, info)
      type(area_input_t), intent(in) :: given
      type(area_conductance_t), intent(out) :: found
      !> `area_ok`
      integer, intent(out) :: info
      real(dp) :: film, share

      call cmy_conductance(given, found, info)
      associate (p => given%normal%pressure, hardness => given%data(1), sigma_f => given%data(4))
         film = sigma_f*hardness/p                                               ! sigma_f H/p
         share = 1/(1 + found%conductance*film)
         found%conductance = found%conductance*share
         found%dconductance_ddelta = found%dconductance_ddelta*share**2 &
            + found%conductance**2*film/p*given%normal%stiffness
      end associate
   end subroutine film_conductance

end module litz_area_film
