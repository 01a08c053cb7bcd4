!> PAPER: circular spot of the paper by Boso, Litewka, Schrefler and Wriggers, kept to replay it.
!>
!> Source: theory section 6. Its `r* = r rb/(r + rb)` is that of two spheres, so that equal wires at 90 degrees get a
!> spot 21 % too small and a resistance 26 % too large (theory section 1).
module litz_spot_paper
   use litz_kinds, only: dp
   use litz_hertz, only: effective_modulus
   use litz_law_input, only: law_input_t
   use litz_spot_law, only: spot_law_t, contact_spot_t, spot_ok
   implicit none
   private
   public :: spot_paper

contains

   pure function spot_paper() result(law)
      type(spot_law_t) :: law

      law%name = 'PAPER'
      law%meaning = 'circular spot of the paper by Boso, Litewka, Schrefler and Wriggers'
      law%is_elastic = .true.
      law%spot_of_force => paper_spot
   end function spot_paper

   pure subroutine paper_spot(given, spot, info)
      type(law_input_t), intent(in) :: given
      type(contact_spot_t), intent(out) :: spot
      !> `spot_ok`
      integer, intent(out) :: info
      real(dp) :: r_star

      info = spot_ok
      associate (wires => given%wires, force => given%force)
         r_star = product(wires%radius)/sum(wires%radius)
         spot%semi_major = (3*force*r_star/(4*effective_modulus(wires%young, wires%poisson)))**(1.0_dp/3)
         spot%semi_minor = spot%semi_major
         spot%approach = spot%semi_major**2/r_star
         spot%conductance = 4*spot%semi_major/sum(wires%resistivity)            ! R_c = (rho1+rho2)/(4a)
         spot%dconductance_dforce = spot%conductance/(3*force)
         spot%dconductance_dresistivity = -spot%conductance/sum(wires%resistivity)
      end associate
   end subroutine paper_spot

end module litz_spot_paper
