!> What a material is at a temperature: elasticity, thermal strain and resistivity.
!>
!> Thermal strain from secant coefficients `alpha` against `T_zero`, free of strain at the initial temperature `T_i`:
!>
!>     e_T = alpha(T) (T - T_zero) - alpha(T_i) (T_i - T_zero)                                                   (1)
!>
!> Source: Abaqus's *EXPANSION, ZERO=; theory section 13. Resistivity, not conductivity, is linear between the lines
!> of a table: for metals it is nearly straight.
module litz_material_properties
   use litz_kinds, only: dp
   use litz_model, only: material_t
   use litz_temperature_tables, only: table_values
   implicit none
   private
   public :: depends_on_temperature, elasticity_at, thermal_strain, resistivity_at

contains

   !> Some property changes with the temperature.
   pure logical function depends_on_temperature(material)
      type(material_t), intent(in) :: material

      depends_on_temperature = allocated(material%elastic_table) .or. allocated(material%resistivity_table) .or. &
         expands(material)
   end function depends_on_temperature

   !> It has a coefficient of expansion.
   pure logical function expands(material)
      type(material_t), intent(in) :: material

      expands = allocated(material%expansion_table)
   end function expands

   !> Young's modulus [Pa] and Poisson's ratio.
   pure function elasticity_at(material, temperature) result(elasticity)
      type(material_t), intent(in) :: material
      !> [K]
      real(dp), intent(in) :: temperature
      real(dp) :: elasticity(2)

      elasticity = [material%young, material%poisson]
      if (allocated(material%elastic_table)) elasticity = table_values(material%elastic_table, temperature)
   end function elasticity_at

   !> Source: (1).
   pure real(dp) function thermal_strain(material, temperature, initial) result(strain)
      type(material_t), intent(in) :: material
      !> At present and before the first step [K]
      real(dp), intent(in) :: temperature, initial

      strain = 0
      if (expands(material)) strain = secant_strain(temperature) - secant_strain(initial)

   contains

      pure real(dp) function secant_strain(t)
         !> [K]
         real(dp), intent(in) :: t

         secant_strain = sum(table_values(material%expansion_table, t))*(t - material%expansion_zero)
      end function secant_strain

   end function thermal_strain

   !> [ohm m]; 0: it does not conduct.
   pure real(dp) function resistivity_at(material, temperature) result(resistivity)
      type(material_t), intent(in) :: material
      !> [K]
      real(dp), intent(in) :: temperature

      resistivity = 0
      if (material%conductivity > 0) resistivity = 1/material%conductivity
      if (allocated(material%resistivity_table)) resistivity = &
         sum(table_values(material%resistivity_table, temperature))
   end function resistivity_at

end module litz_material_properties
