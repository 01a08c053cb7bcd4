!> CLUSTER: n spots of `F = n pi a^2 H` in the ellipse of HERTZ, through which the current comes together once more.
!>
!> A film, or a coating, lies in series on the area of the spots, `F/H`.
!>
!> Source: theory (6.6); J. A. Greenwood, Br. J. Appl. Phys. 17 (1966) 1621-1632; R. Holm, Electric Contacts. The spots
!> raise each other's potential by the constriction of the ellipse, but for that of a part 1/n of it.
module litz_spot_cluster
   use litz_kinds, only: dp, pi
   use litz_law_input, only: law_input_t
   use litz_law_words, only: law_field_t, film_meaning
   use litz_spot_hertz, only: hertz_spot
   use litz_spot_law, only: spot_law_t, contact_spot_t, spot_bad_data
   implicit none
   private
   public :: spot_cluster

contains

   pure function spot_cluster() result(law)
      type(spot_law_t) :: law

      law%name = 'CLUSTER'
      law%meaning = 'many plastic spots within the ellipse of HERTZ, and a film if there is one'
      law%uses_ellipse = .true.
      law%is_elastic = .true.
      law%fields(1) = law_field_t('H', 'Pa', 'hardness')
      law%fields(2) = law_field_t('n', '-', 'number of spots', is_count=.true.)
      law%fields(3) = law_field_t('sigma_f', 'ohm m^2', film_meaning//', on the area of the spots, F/H', &
         is_optional=.true.)
      law%spot_of_force => cluster_spot
   end function spot_cluster

   pure subroutine cluster_spot(given, spot, info)
      type(law_input_t), intent(in) :: given
      !> Half axes and approach are those of the ellipse
      type(contact_spot_t), intent(out) :: spot
      !> `spot_ok`, or `spot_bad_data` for less than one spot
      integer, intent(out) :: info
      real(dp) :: single, whole, film

      info = spot_bad_data
      associate (hardness => given%data(1), n => given%data(2), rho => sum(given%wires%resistivity), f => given%force)
         if (.not. n >= 1) return
         call hertz_spot(given, spot, info)
         single = rho/(4*sqrt(n*f/(pi*hardness)))                        ! (rho1 + rho2)/(4 n a), a = sqrt(F/(n pi H))
         whole = (1 - 1/sqrt(n))/spot%conductance
         film = given%data(3)*hardness/f                                 ! sigma_f/(n pi a^2)
         spot%conductance = 1/(single + whole + film)
         spot%dconductance_dforce = spot%conductance**2*(single/2 + whole/3 + film)/f
         spot%dconductance_dangle = -spot%conductance**2*whole*given%ellipse%dapproach_dangle/given%ellipse%approach
         spot%dconductance_dresistivity = -spot%conductance**2*(single + whole)/rho
      end associate
   end subroutine cluster_spot

end module litz_spot_cluster
