!> ELASTIC ROUGH per area: the conductance of rough elastic surfaces from their stiffness.
!>
!> Source: J. R. Barber, Proc. R. Soc. A 459 (2003) 53: conductance and incremental stiffness of an elastic contact are
!> proportional, `h = 2 (dp/ddelta)/(E* (rho + rho_b))`, whatever its roughness; (6.5) of the theory per area.
module litz_area_rough
   use litz_kinds, only: dp
   use litz_area_law, only: area_conductance_law_t, area_input_t, area_conductance_t, area_ok, joint_modulus
   implicit none
   private
   public :: area_rough

contains

   pure type(area_conductance_law_t) function area_rough() result(law)
      law%name = 'ELASTIC ROUGH'
      law%meaning = 'rough elastic surfaces, from the stiffness of their contact'
      law%uses_resistivity = .true.
      law%uses_elasticity = .true.
      law%conductance_of_pressure => rough_conductance
   end function area_rough

   pure subroutine rough_conductance(given, found, info)
      type(area_input_t), intent(in) :: given
      type(area_conductance_t), intent(out) :: found
      !> `area_ok`
      integer, intent(out) :: info
      real(dp) :: factor

      info = area_ok
      factor = 2/(joint_modulus(given%bodies)*sum(given%bodies%resistivity))
      found%conductance = factor*given%normal%stiffness                          ! h = 2 p'/(E* (rho + rho_b))
      found%dconductance_ddelta = factor*given%normal%dstiffness_ddelta
   end subroutine rough_conductance

end module litz_area_rough
