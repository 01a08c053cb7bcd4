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
   public :: has_thermal_mechanics, has_thermal_resistivity, elasticity_at, elasticity_slope, thermal_strain, &
      thermal_strain_slope

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

   !> How Young's modulus [Pa/K] and Poisson's ratio [1/K] change with the temperature.
   pure function elasticity_slope(material, temperature) result(slope)
      type(material_t), intent(in) :: material
      !> [K]
      real(dp), intent(in) :: temperature
      real(dp) :: slope(2), unused

      slope = 0
      if (.not. allocated(material%elastic_table)) return
      call property_at(material%elastic_table([1, 2], :), temperature, unused, slope(1))
      call property_at(material%elastic_table([1, 3], :), temperature, unused, slope(2))
   end function elasticity_slope

   !> Derivative of (1) by T [1/K].
   pure real(dp) function thermal_strain_slope(material, temperature) result(slope)
      type(material_t), intent(in) :: material
      !> [K]
      real(dp), intent(in) :: temperature
      real(dp) :: alpha, dalpha

      slope = 0
      if (.not. allocated(material%expansion_table)) return
      call property_at(material%expansion_table, temperature, alpha, dalpha)
      slope = alpha + dalpha*(temperature - material%expansion_zero)
   end function thermal_strain_slope

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
