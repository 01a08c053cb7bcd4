!> FILM: the spot of HERTZ with the resistance of a film, `R_f = sigma_f/(pi a b)`, in series.
!>
!> Source: theory section 6.
module litz_spot_film
   use litz_kinds, only: dp, pi
   use litz_law_input, only: law_input_t
   use litz_law_words, only: law_field_t, film_meaning
   use litz_spot_hertz, only: hertz_spot
   use litz_spot_law, only: spot_law_t, contact_spot_t, spot_ok, add_in_series
   implicit none
   private
   public :: spot_film

contains

   pure function spot_film() result(law)
      type(spot_law_t) :: law

      law%name = 'FILM'
      law%meaning = 'HERTZ with a film in series, such as an oxide, or a coating of tin, nickel or silver'
      law%uses_ellipse = .true.
      law%is_elastic = .true.
      law%is_of_mechanics = .true.
      law%serves_lines = .true.
      law%film_number = 1
      law%fields(1) = law_field_t('sigma_f', 'ohm m^2', film_meaning)
      law%spot_of_force => film_spot
   end function spot_film

   pure subroutine film_spot(given, spot, info)
      type(law_input_t), intent(in) :: given
      type(contact_spot_t), intent(out) :: spot
      !> `spot_ok`
      integer, intent(out) :: info
      real(dp) :: film

      call hertz_spot(given, spot, info)
      if (info /= spot_ok) return
      film = given%data(1)/(pi*spot%semi_major*spot%semi_minor)                  ! R_f = sigma_f/(pi a b)
      call add_in_series(film, -2*film/(3*given%force), -film*given%ellipse%dlog_area_dangle, spot)
   end subroutine film_spot

end module litz_spot_film
