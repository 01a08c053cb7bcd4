!> The integer constants that name the choices of a contact: axis interpolation, normal law, contact-spot law, stiffness
!> of friction before it slips.
!>
!> They stand below both the kernels, which act on them, and the model, which stores them.
module litz_laws
   implicit none
   private
   public :: axis_linear, axis_hermite
   public :: normal_linear, normal_hertz
   public :: stick_mindlin, stick_elastic_slip, stick_stiffness
   public :: spot_none, spot_paper, spot_hertz, spot_plastic, spot_film, spot_constant, spot_table
   public :: spot_law_t, spot_laws, spot_law_number, spot_law_uses_ellipse

   !> Interpolation of the contact axis, theory section 3
   integer, parameter :: axis_linear = 1, axis_hermite = 2
   !> Normal contact laws
   integer, parameter :: normal_linear = 1, normal_hertz = 2
   !> Tangential stiffness of a contact that sticks: Mindlin's ratio to the normal stiffness; limit of friction over a
   !> given elastic slip [m]; a given stiffness [N/m]
   integer, parameter :: stick_mindlin = 1, stick_elastic_slip = 2, stick_stiffness = 3
   !> Contact-spot laws, force -> spot -> conductance; `spot_none`: no current crosses the contact
   integer, parameter :: spot_none = 0, spot_paper = 1, spot_hertz = 2, spot_plastic = 3, spot_film = 4, &
      spot_constant = 5, spot_table = 6

   !> A contact-spot law as decks, their reference and Python know it.
   type :: spot_law_t
      !> In decks, and in lower case in Python
      character(len=8) :: name
      !> The end of `NAME: ...` in the deck reference
      character(len=80) :: meaning
      !> It acts on the Hertz ellipse of the contact
      logical :: uses_ellipse = .false.
      !> Its data are pairs of force and resistance
      logical :: has_table = .false.
      !> The one positive number that is its data: name (empty: there is none), unit, meaning
      character(len=16) :: value_name = ''
      character(len=12) :: value_unit = ''
      character(len=40) :: value_meaning = ''
   end type spot_law_t

   !> All laws but `spot_none`, each at the place of its number. `contact_spot` has their formulas.
   type(spot_law_t), parameter :: spot_laws(*) = [ &
      spot_law_t('PAPER', 'circular spot of the paper by Boso, Litewka, Schrefler and Wriggers'), &
      spot_law_t('HERTZ', 'elliptic Hertz spot with Holm''s constriction resistance', uses_ellipse=.true.), &
      spot_law_t('PLASTIC', 'spot area is force/hardness', value_name='H', value_unit='Pa', value_meaning='hardness'), &
      spot_law_t('FILM', 'HERTZ with a film in series', uses_ellipse=.true., value_name='sigma_f', &
         value_unit='ohm m^2', value_meaning='film resistance times area'), &
      spot_law_t('CONSTANT', 'given resistance', value_name='R_c', value_unit='ohm', &
         value_meaning='resistance of a contact'), &
      spot_law_t('TABLE', 'resistance over force', has_table=.true.)]

contains

   !> Number of the law of this name; `spot_none` where there is none.
   pure integer function spot_law_number(name) result(number)
      !> In capitals
      character(len=*), intent(in) :: name

      do number = size(spot_laws), 1, -1
         if (spot_laws(number)%name == name) return
      end do
      number = spot_none
   end function spot_law_number

   !> Whether a law needs the Hertz ellipse; false for numbers that are none.
   pure logical function spot_law_uses_ellipse(law) result(uses)
      !> One of `spot_...`, or any other number
      integer, intent(in) :: law

      uses = .false.
      if (law >= 1 .and. law <= size(spot_laws)) uses = spot_laws(law)%uses_ellipse
   end function spot_law_uses_ellipse

end module litz_laws
