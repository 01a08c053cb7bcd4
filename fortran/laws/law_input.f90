!> What a law of a contact is told of it.
module litz_law_input
   use litz_kinds, only: dp
   use litz_hertz, only: hertz_ellipse_t
   use litz_law_words, only: law_words_t, max_fields
   implicit none
   private
   public :: wire_pair_t, law_input_t, earlier_dent_t, tell

   !> The two wires: barred, unbarred.
   type :: wire_pair_t
      !> Radii [m], Young's moduli [Pa], Poisson's ratios [-], resistivities [ohm m]
      real(dp) :: radius(2) = 0, young(2) = 0, poisson(2) = 0, resistivity(2) = 0
      !> rho L0/(4 A) [ohm], see contact_electricity; 0: the paper's linear voltage
      real(dp) :: series_resistance(2) = 0
      !> How the resistivities change with the temperatures of the contact's places, and these with the places xi
      !> [ohm m/K, K]
      real(dp) :: dresistivity(2) = 0, dtemperature(2) = 0
   end type wire_pair_t

   !> What wires that yield have been pressed to before.
   type :: earlier_dent_t
      !> Largest force [N]; 0: none
      real(dp) :: force = 0
      !> Deepest overlap [m]: at any angle the dent is that of the largest force or, if that is smaller, of the force of
      !> first loading to this overlap. No place of it has been pressed deeper
      real(dp) :: overlap = huge(1.0_dp)
      !> What is felt of the force, as the contact has slid off a part of the dent [-]
      real(dp) :: left = 1
   end type earlier_dent_t

   type :: law_input_t
      !> Gap between the surfaces [m], negative in contact; contact force [N], positive in contact. A law is asked about
      !> one of them, the other is 0
      real(dp) :: gap = 0, force = 0
      !> Numbers of the law, see law_words_t
      real(dp) :: data(max_fields) = 0
      real(dp), allocatable :: table(:, :)
      type(wire_pair_t) :: wires
      !> At the present angle, where the law uses it
      type(hertz_ellipse_t) :: ellipse
      !> Of metal that yields: yield stress and hardness [Pa], and its dent
      real(dp) :: yield_stress = 0, hardness = 0
      type(earlier_dent_t) :: dent
   end type law_input_t

contains

   !> Put together what a law is told.
   pure subroutine tell(law, wires, ellipse, given, gap, force)
      class(law_words_t), intent(in) :: law
      type(wire_pair_t), intent(in) :: wires
      type(hertz_ellipse_t), intent(in) :: ellipse
      type(law_input_t), intent(out) :: given
      !> Gap [m]
      real(dp), intent(in), optional :: gap
      !> Contact force [N]
      real(dp), intent(in), optional :: force

      if (present(gap)) given%gap = gap
      if (present(force)) given%force = force
      given%data = law%data
      if (allocated(law%table)) given%table = law%table
      given%wires = wires
      given%ellipse = ellipse
   end subroutine tell

end module litz_law_input
