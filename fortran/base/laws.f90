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

end module litz_laws
