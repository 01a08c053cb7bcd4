!> What a law of the critical current density returns.
module litz_critical_density
   use litz_kinds, only: dp
   implicit none
   private
   public :: critical_density_t, least_field

   !> Fits grow without bounds as the flux density vanishes: one of less than this part of the upper critical one, less
   !> than that of a strand's own current, counts as that
   real(dp), parameter :: least_field = 1.0e-3_dp

   type :: critical_density_t
      !> Of the superconductor's part of the cross-section [A/m^2]
      real(dp) :: value = 0
      !> Derivatives by temperature [A/(m^2 K)], flux density [A/(m^2 T)] and strain [A/m^2]
      real(dp) :: by_temperature = 0, by_field = 0, by_strain = 0
   end type critical_density_t

end module litz_critical_density
