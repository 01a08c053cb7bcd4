!> LINEAR per area: a penalty, `p = p_a + eps_n delta` where that is positive.
!>
!> `p_a` is the pressure of augmentation (0 at first): Uzawa's iteration puts `p_a <- p` until the overlap is as small
!> as wanted. Source: P. Wriggers, Computational Contact Mechanics, 2nd ed. 2006, section 10.3.
module litz_area_linear
   use litz_area_law, only: pressure_law_t, area_input_t, pressure_t
   use litz_law_words, only: law_field_t
   implicit none
   private
   public :: area_linear

contains

   pure type(pressure_law_t) function area_linear() result(law)
      law%name = 'LINEAR'
      law%meaning = 'a penalty'
      law%fields(1) = law_field_t('eps_n', 'Pa/m', 'contact pressure per penetration')
      law%can_be_augmented = .true.
      law%pressure_of_overlap => linear_pressure
   end function area_linear

   pure function linear_pressure(given) result(found)
      type(area_input_t), intent(in) :: given
      type(pressure_t) :: found

      found%stiffness = given%data(1)
      found%pressure = given%augmentation + found%stiffness*given%overlap
   end function linear_pressure

end module litz_area_linear
