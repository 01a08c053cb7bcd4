!> Tangential stiffness of a contact that sticks: the table of the choices of *FRICTION, and their formulas.
module litz_stick_laws
   use litz_kinds, only: dp
   use litz_friction_law, only: mindlin_ratio
   use litz_law_input, only: wire_pair_t
   use litz_normal_law, only: overlap_of_force_t
   implicit none
   private
   public :: stick_law_t, stick_laws, stick_mindlin, stick_stiffness, stick_stiffness_at

   !> Mindlin's ratio to the normal stiffness; limit of friction over a given elastic slip; a given stiffness
   integer, parameter :: stick_mindlin = 1, stick_elastic_slip = 2, stick_stiffness = 3

   type :: stick_law_t
      !> Parameter of *FRICTION that chooses it and has its number; empty: it is chosen by none
      character(len=24) :: parameter = ''
      !> Of the number
      character(len=12) :: unit = ''
      character(len=80) :: meaning = ''
   end type stick_law_t

   !> Each at the place of its number
   type(stick_law_t), parameter :: stick_laws(*) = [ &
      stick_law_t(), &
      stick_law_t('ELASTIC SLIP', 'm', 'slip at which friction reaches its limit [m], whatever the force'), &
      stick_law_t('STICK STIFFNESS', 'N/m', 'tangential stiffness of a contact [N/m] (litz extension)')]

contains

   !> Tangential stiffness and how it changes with the normal force.
   pure subroutine stick_stiffness_at(law, value, mu, force, normal, wires, stiffness, dstiffness_dforce)
      !> Place in `stick_laws`
      integer, intent(in) :: law
      !> The number of its parameter, coefficient of friction [-], normal force [N]
      real(dp), intent(in) :: value, mu, force
      !> Normal stiffness at this force
      type(overlap_of_force_t), intent(in) :: normal
      type(wire_pair_t), intent(in) :: wires
      !> [N/m], [1/m]
      real(dp), intent(out) :: stiffness, dstiffness_dforce

      select case (law)
      case (stick_elastic_slip)
         dstiffness_dforce = mu/value
         stiffness = dstiffness_dforce*force
      case (stick_stiffness)
         stiffness = value
         dstiffness_dforce = 0
      case default
         stiffness = mindlin_ratio(wires%young, wires%poisson)*normal%stiffness
         dstiffness_dforce = mindlin_ratio(wires%young, wires%poisson)*normal%dstiffness_dforce
         ! what yields around the spot of wires that stick is elastic for a shear
         if (normal%elastic_stiffness > 0) then
            stiffness = mindlin_ratio(wires%young, wires%poisson)*normal%elastic_stiffness
            dstiffness_dforce = mindlin_ratio(wires%young, wires%poisson)*normal%delastic_dforce
         end if
      end select
   end subroutine stick_stiffness_at

end module litz_stick_laws
