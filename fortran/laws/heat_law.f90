!> How heat passes between wires that touch.
!>
!> | law          | heat conductance                                                                        |
!> |--------------|-----------------------------------------------------------------------------------------|
!> | CONDUCTIVITY | of the constrictions in both wires, by their heat conductivities                        |
!> | METAL        | the same of Wiedemann-Franz metals, `lambda rho = L T`, whose current heats the spot    |
!> | CONSTANT     | given                                                                                   |
!> | TABLE        | `h(F)`                                                                                  |
!>
!> Source: theory section 13.
module litz_heat_law
   use litz_kinds, only: dp
   use litz_law_words, only: law_words_t, law_field_t
   use litz_spot_law, only: spot_law_t
   use litz_spot_laws, only: spot_law
   implicit none
   private
   public :: heat_law_t, heat_law, all_heat_laws, heat_metal_law

   !> Places in the table of the laws
   integer, parameter :: heat_conductivity_law = 1, heat_metal_law = 2, heat_constant_law = 3, heat_table_law = 4
   integer, parameter :: n_laws = heat_table_law

   !> Number 0: heat passes where a current can, by CONDUCTIVITY.
   type, extends(law_words_t) :: heat_law_t
      !> The heat conductance of CONSTANT and TABLE is per length of wires that touch along lines [W/(m K)]
      logical :: is_per_length = .false.
      !> Lorenz number of METAL [V^2/K^2]; 0: that of each wire from its lambda and rho
      real(dp) :: lorenz = 0
      !> Resistance to heat of a film in the spots of CONDUCTIVITY and METAL, times area [K m^2/W]
      real(dp) :: film = 0
      !> Temperatures at which the metal of a spot softens and melts [K], where they are given; and it may melt
      logical :: has_softening = .false., has_melting = .false., may_melt = .false.
      real(dp) :: softening = 0, melting = 0
      !> Part of the work of friction that becomes heat
      real(dp) :: friction_fraction = 1
      !> Part of that heat that enters a wire which rubs on a rigid surface
      real(dp) :: surface_share = 0.5_dp
   contains
      procedure :: is_given
      procedure :: as_spot_law
   end type heat_law_t

   interface heat_law
      procedure :: heat_law_of_number, heat_law_of_name
   end interface heat_law

contains

   pure function heat_law_of_number(number) result(law)
      !> Place in the table
      integer, intent(in) :: number
      type(heat_law_t) :: law

      law%number = number
      select case (number)
      case (heat_conductivity_law)
         law%name = 'CONDUCTIVITY'
         law%meaning = 'constrictions in both wires by *CONDUCTIVITY, in the spot of the current or of elastic wires'
         law%uses_ellipse = .true.
      case (heat_metal_law)
         law%name = 'METAL'
         law%meaning = 'the same of Wiedemann-Franz metals, lambda rho = L T, whose spot is heated by its current'
         law%uses_ellipse = .true.
      case (heat_constant_law)
         law%name = 'CONSTANT'
         law%meaning = 'a given heat conductance'
         law%fields(1) = law_field_t('h', 'W/K', 'heat conductance of a contact, whatever its force')
      case (heat_table_law)
         law%name = 'TABLE'
         law%meaning = 'heat conductance over force'
         law%has_table = .true.
         law%fields(1) = law_field_t('F', 'N', 'contact force; ascending')
         law%fields(2) = law_field_t('h', 'W/K', 'heat conductance of a contact at that force; outside the table'// &
            ' the power law of its first, or last, two pairs goes on, with a warning (outside_table)')
      end select
   end function heat_law_of_number

   !> Without a name where there is none.
   pure function heat_law_of_name(name) result(law)
      !> In capitals
      character(len=*), intent(in) :: name
      type(heat_law_t) :: law, other
      integer :: number

      do number = 1, n_laws
         other = heat_law(number)
         if (other%name == name) law = other
      end do
   end function heat_law_of_name

   !> What decks, their reference and Python know of all laws, each at the place of its number.
   pure function all_heat_laws() result(laws)
      type(law_words_t) :: laws(n_laws)
      type(heat_law_t) :: law
      integer :: i

      do i = 1, n_laws
         law = heat_law(i)
         laws(i) = law%law_words_t
      end do
   end function all_heat_laws

   !> The heat conductance is given, and not that of a spot.
   pure logical function is_given(self)
      class(heat_law_t), intent(in) :: self

      is_given = self%number == heat_constant_law .or. self%number == heat_table_law
   end function is_given

   !> What is given as a law of a resistance to heat, which heat meets as a current meets that of its spot.
   pure type(spot_law_t) function as_spot_law(self) result(law)
      class(heat_law_t), intent(in) :: self

      law = spot_law(trim(self%name))
      law%is_per_length = self%is_per_length
      if (self%number == heat_table_law) then
         law%table = self%table
         law%table(2, :) = 1/self%table(2, :)
      else
         law%data(1) = 1/self%data(1)
      end if
   end function as_spot_law

end module litz_heat_law
