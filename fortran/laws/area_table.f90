!> TABLE per area: resistance times area over the pressure, interpolated as the resistance of a spot over its force.
module litz_area_table
   use litz_kinds, only: dp
   use litz_area_law, only: area_conductance_law_t, area_input_t, area_conductance_t, area_ok, area_bad_data
   use litz_law_words, only: law_field_t
   use litz_spot_law, only: spot_ok
   use litz_spot_table, only: table_resistance_at
   implicit none
   private
   public :: area_table

contains

   pure type(area_conductance_law_t) function area_table() result(law)
      law%name = 'TABLE'
      law%meaning = 'resistance times area over pressure'
      law%has_table = .true.
      law%fields(1) = law_field_t('p', 'Pa', 'contact pressure; ascending')
      law%fields(2) = law_field_t('R', 'ohm m^2', 'resistance times area at that pressure')
      law%conductance_of_pressure => table_conductance
   end function area_table

   pure subroutine table_conductance(given, found, info)
      type(area_input_t), intent(in) :: given
      type(area_conductance_t), intent(out) :: found
      !> `area_ok` or `area_bad_data`
      integer, intent(out) :: info
      real(dp) :: resistance, slope

      info = area_bad_data
      if (.not. allocated(given%table)) return
      call table_resistance_at(given%normal%pressure, given%table(1, :), given%table(2, :), resistance, slope, info)
      info = merge(area_ok, area_bad_data, info == spot_ok)
      if (info /= area_ok) return
      found%conductance = 1/resistance
      found%dconductance_ddelta = -slope/resistance**2*given%normal%stiffness
   end subroutine table_conductance

end module litz_area_table
