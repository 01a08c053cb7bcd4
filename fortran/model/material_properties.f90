!> The elasticity and the thermal strain of a material at a temperature.
!>
!> Thermal strain from secant coefficients `alpha` against `T_zero`, free of strain at the initial temperature `T_i`:
!>
!>     e_T = alpha(T) (T - T_zero) - alpha(T_i) (T_i - T_zero)                                                   (1)
!>
!> Source: Abaqus's *EXPANSION, ZERO=; theory section 14.
module litz_material_properties
   use litz_kinds, only: dp
   use litz_model, only: material_t
   use litz_property_table, only: property_at
   implicit none
   private
   public :: has_thermal_mechanics, has_thermal_resistivity, elasticity_at, thermal_strain

contains

   !> Its mechanics changes with the temperature.
   pure logical function has_thermal_mechanics(material)
      type(material_t), intent(in) :: material

      has_thermal_mechanics = allocated(material%elastic_table) .or. allocated(material%expansion_table)
   end function has_thermal_mechanics

   !> Its resistivity changes with the temperature.
   pure logical function has_thermal_resistivity(material)
      type(material_t), intent(in) :: material

      has_thermal_resistivity = .false.
      if (material%conductivity > 0) has_thermal_resistivity = size(material%resistivity, 2) > 1
   end function has_thermal_resistivity

   !> Young's modulus [Pa] and Poisson's ratio.
   pure function elasticity_at(material, temperature) result(elasticity)
      type(material_t), intent(in) :: material
      !> [K]
      real(dp), intent(in) :: temperature
      real(dp) :: elasticity(2), slope

      elasticity = [material%young, material%poisson]
      if (.not. allocated(material%elastic_table)) return
      call property_at(material%elastic_table([1, 2], :), temperature, elasticity(1), slope)
      call property_at(material%elastic_table([1, 3], :), temperature, elasticity(2), slope)
   end function elasticity_at

   !> Source: (1).
   pure real(dp) function thermal_strain(material, temperature, initial) result(strain)
      type(material_t), intent(in) :: material
      !> At present and before the first step [K]
      real(dp), intent(in) :: temperature, initial

      strain = 0
      if (allocated(material%expansion_table)) strain = secant_strain(temperature) - secant_strain(initial)

   contains

      pure real(dp) function secant_strain(t)
         !> [K]
         real(dp), intent(in) :: t
         real(dp) :: alpha, slope

         call property_at(material%expansion_table, t, alpha, slope)
         secant_strain = alpha*(t - material%expansion_zero)
      end function secant_strain

   end function thermal_strain

end module litz_material_properties
