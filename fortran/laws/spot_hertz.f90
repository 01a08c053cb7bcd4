!> HERTZ: elliptic spot with Holm's constriction resistance, `R_c = (rho1 + rho2) K(m)/(2 pi a)`.
!>
!> Source: theory section 6; the ellipse is that of litz_hertz.
module litz_spot_hertz
   use litz_kinds, only: dp
   use litz_law_input, only: law_input_t
   use litz_spot_law, only: spot_law_t, contact_spot_t, spot_ok
   implicit none
   private
   public :: spot_hertz, hertz_spot

contains

   pure function spot_hertz() result(law)
      type(spot_law_t) :: law

      law%name = 'HERTZ'
      law%meaning = 'elliptic Hertz spot with Holm''s constriction resistance'
      law%uses_ellipse = .true.
      law%is_elastic = .true.
      law%is_of_mechanics = .true.
      law%serves_lines = .true.
      law%spot_of_force => hertz_spot
   end function spot_hertz

   pure subroutine hertz_spot(given, spot, info)
      type(law_input_t), intent(in) :: given
      type(contact_spot_t), intent(out) :: spot
      !> `spot_ok`
      integer, intent(out) :: info

      info = spot_ok
      associate (ellipse => given%ellipse, force => given%force)
         spot%semi_major = ellipse%semi_major*force**(1.0_dp/3)
         spot%semi_minor = ellipse%ratio*spot%semi_major
         spot%approach = ellipse%approach*force**(1.0_dp/3)*force**(1.0_dp/3)
         ! R_c = (rho1+rho2) K/(2 pi a)
         spot%conductance = 3*force/(sum(given%wires%resistivity)*ellipse%modulus*spot%approach)
         spot%dconductance_dforce = spot%conductance/(3*force)
         spot%dconductance_dresistivity = -spot%conductance/sum(given%wires%resistivity)
         spot%dconductance_dangle = -spot%conductance*ellipse%dapproach_dangle/ellipse%approach
      end associate
   end subroutine hertz_spot

end module litz_spot_hertz
