!> The tables of the laws per area. A new one is a file beside this one, and a line in `pressure_law` or
!> `area_conductance_law`.
module litz_area_laws
   use litz_kinds, only: dp
   use litz_area_law, only: pressure_law_t, area_conductance_law_t
   use litz_area_linear, only: area_linear
   use litz_area_exponential, only: area_exponential
   use litz_area_cmy, only: area_cmy
   use litz_area_film, only: area_film
   use litz_area_rough, only: area_rough
   use litz_area_constant, only: area_constant
   use litz_area_table, only: area_table
   implicit none
   private
   public :: pressure_law, area_conductance_law

contains

   !> The law of this number with its data; without a name and procedures where there is none.
   pure type(pressure_law_t) function pressure_law(number, data) result(law)
      !> Place in the table
      integer, intent(in) :: number
      !> Its numbers (n); absent: it has none
      real(dp), intent(in), optional :: data(:)

      select case (number)
      case (1); law = area_linear()
      case (2); law = area_exponential()
      end select
      law%number = number
      if (present(data)) call law%take(data)
   end function pressure_law

   !> The law of this number with its data; without a name and procedures where there is none.
   pure type(area_conductance_law_t) function area_conductance_law(number, data) result(law)
      !> Place in the table
      integer, intent(in) :: number
      !> Its numbers, line after line (n); absent: it has none
      real(dp), intent(in), optional :: data(:)

      select case (number)
      case (1); law = area_cmy()
      case (2); law = area_film()
      case (3); law = area_rough()
      case (4); law = area_constant()
      case (5); law = area_table()
      end select
      law%number = number
      if (present(data)) call law%take(data)
   end function area_conductance_law

end module litz_area_laws
