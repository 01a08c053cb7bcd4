!> SHARVIN: the spot of HERTZ, small against the mean free path of the electrons or not, and a film in series.
!>
!> Source: theory (15.9) and (15.10), between Holm's and Sharvin's resistance.
module litz_spot_sharvin
   use litz_law_input, only: law_input_t
   use litz_law_words, only: law_field_t, film_meaning
   use litz_spot_law, only: spot_law_t, contact_spot_t, spot_ok
   use litz_spot_resistance, only: spot_metal_t, elastic_spot
   implicit none
   private
   public :: spot_sharvin

contains

   pure function spot_sharvin() result(law)
      type(spot_law_t) :: law

      law%name = 'SHARVIN'
      law%meaning = 'HERTZ with Sharvin''s resistance of small spots, and a film if there is one'
      law%uses_ellipse = .true.
      law%is_elastic = .true.
      law%is_of_mechanics = .true.
      law%path_number = 1
      law%film_number = 2
      law%free_path_number = 3
      law%fields(1) = law_field_t('rho_l', 'ohm m^2', 'resistivity times mean free path of the electrons, a'// &
         ' constant of the metal (of both wires); blank with MEAN FREE PATH', has_substitute=.true.)
      law%fields(2) = law_field_t('sigma_f', 'ohm m^2', film_meaning, is_optional=.true.)
      law%fields(3) = law_field_t('MEAN FREE PATH', 'm', 'of SHARVIN, in place of rho_l: mean free path of the'// &
         ' electrons in both wires [m], whose resistivity does not depend on the temperature', is_optional=.true., &
         is_parameter=.true.)
      law%spot_of_force => sharvin_spot
   end function spot_sharvin

   pure subroutine sharvin_spot(given, spot, info)
      type(law_input_t), intent(in) :: given
      type(contact_spot_t), intent(out) :: spot
      !> `spot_ok`
      integer, intent(out) :: info

      info = spot_ok
      spot = elastic_spot(given%ellipse, given%force, spot_metal_t(given%wires%resistivity, given%data(1), &
         given%data(2), given%data(3)))
   end subroutine sharvin_spot

end module litz_spot_sharvin
