!> Stiffnesses of cross-sections from the elasticity of their material.
module litz_section_stiffness
   use litz_kinds, only: dp
   use litz_model, only: section_t, shear_given, shear_round
   implicit none
   private
   public :: section_stiffness, section_stiffness_slope, shear_stiffness

contains

   !> EA, GA2, GA3, GJ, EI2, EI3 (6) [N, N m^2].
   pure function section_stiffness(section, young, poisson) result(stiffness)
      type(section_t), intent(in) :: section
      !> Young's modulus [Pa] and Poisson's ratio
      real(dp), intent(in) :: young, poisson
      real(dp) :: stiffness(6)

      stiffness = [young*section%area, section%ga2, section%ga3, young/(2*(1 + poisson))*section%j, &
         young*section%i2, young*section%i3]
      if (section%shear /= shear_given) stiffness(2:3) = shear_stiffness(section, young, poisson)
      stiffness = section%stiffness*stiffness
   end function section_stiffness

   !> How these change with the elasticity (6).
   pure function section_stiffness_slope(section, young, poisson, dyoung, dpoisson) result(slope)
      type(section_t), intent(in) :: section
      !> Young's modulus [Pa] and Poisson's ratio, and their changes
      real(dp), intent(in) :: young, poisson, dyoung, dpoisson
      real(dp) :: slope(6), shear, dshear

      shear = young/(2*(1 + poisson))
      dshear = shear*(dyoung/young - dpoisson/(1 + poisson))                       ! of G
      slope = [dyoung*section%area, 0.0_dp, 0.0_dp, dshear*section%j, dyoung*section%i2, dyoung*section%i3]
      if (section%shear /= shear_given) slope(2:3) = dshear*section%area*section%shear_factor
      if (section%shear == shear_round) slope(2:3) = shear_stiffness(section, young, poisson) &
         *(dyoung/young - 6*dpoisson/(7 + 6*poisson))                              ! of 3 E A/(7 + 6 nu)
      slope = section%stiffness*slope
   end function section_stiffness_slope

   !> Along both axes, of sections whose shear stiffness is not given (2) [N]. Source of the factor of round wires:
   !> Cowper, J. Appl. Mech. 33
   !> (1966) 335-340.
   pure function shear_stiffness(section, young, poisson) result(stiffness)
      type(section_t), intent(in) :: section
      !> Young's modulus [Pa] and Poisson's ratio
      real(dp), intent(in) :: young, poisson
      real(dp) :: stiffness(2), shear_factor(2)

      shear_factor = section%shear_factor
      if (section%shear == shear_round) shear_factor = 6*(1 + poisson)/(7 + 6*poisson)
      stiffness = shear_factor*young/(2*(1 + poisson))*section%area
   end function shear_stiffness

end module litz_section_stiffness
