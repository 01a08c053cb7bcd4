!> What a contact-spot law is: from the contact force to the spot and its electrical conductance.
!>
!> Source: theory section 6; R. Holm, Electric Contacts, for the constriction resistance. Each law is a file
!> `spot_<name>.f90`; litz_spot_laws is the table of all. In all of them `rho` is the resistivity of the wires, `a` and
!> `b` the semi-axes of the spot, `R_c = 1/G` its resistance:
!>
!> | law      | spot                                              | resistance                      | approach       |
!> |----------|---------------------------------------------------|---------------------------------|----------------|
!> | PAPER    | `a = (3 F r*/(4 E*))^(1/3)`, `r* = r rb/(r + rb)`  | `(rho1 + rho2)/(4 a)`           | `a^2/r*`       |
!> | HERTZ    | exact ellipse, see litz_hertz                     | `(rho1 + rho2) K(m)/(2 pi a)`   | Hertz          |
!> | PLASTIC  | `F = pi a^2 H`                                    | `(rho1 + rho2)/(4 a)`           | 0: rigid       |
!> | FILM     | as HERTZ                                          | HERTZ `+ sigma_f/(pi a b)`      | Hertz          |
!> | CONSTANT | none: semi-axes 0                                 | given                           | 0              |
!> | TABLE    | none: semi-axes 0                                 | `R_c(F)`, see litz_spot_table   | 0              |
!> | SHARVIN  | as HERTZ                                          | see litz_spot_resistance        | Hertz          |
!> | CLUSTER  | as HERTZ, n spots in it                           | see litz_spot_cluster           | Hertz          |
!>
!> Without a force there is no spot: the conductance is 0, and so are both derivatives, although the slope of
!> `F^(1/3)` is infinite there. CONSTANT and TABLE, too, conduct only under a positive force.
module litz_spot_law
   use litz_kinds, only: dp
   use litz_hertz, only: hertz_ellipse_t
   use litz_law_input, only: law_input_t, wire_pair_t, tell
   use litz_law_words, only: law_words_t
   implicit none
   private
   public :: spot_law_t, contact_spot_t, contact_spot, add_in_series
   public :: spot_ok, spot_unknown_law, spot_bad_data

   integer, parameter :: spot_ok = 0
   integer, parameter :: spot_unknown_law = -2
   !> TABLE: no pair at all, forces not ascending, or an entry that is not positive
   integer, parameter :: spot_bad_data = -3

   !> A spot and its conductance. All are 0 where there is none.
   type :: contact_spot_t
      !> Semi-axes [m]
      real(dp) :: semi_major = 0, semi_minor = 0
      !> Elastic approach of the two axes [m]
      real(dp) :: approach = 0
      !> G [S], dG/dF [S/N] at fixed angle, dG/dangle [S/rad] at fixed force
      real(dp) :: conductance = 0, dconductance_dforce = 0, dconductance_dangle = 0
      !> dG/drho of the barred and of the unbarred wire (2) [S/(ohm m)]
      real(dp) :: dconductance_dresistivity(2) = 0
   end type contact_spot_t

   !> Number 0: no current crosses the contact.
   type, extends(law_words_t) :: spot_law_t
      !> It is the constriction of the metal in the spot that the mechanics has: of wires that yield that of their dent
      logical :: is_of_mechanics = .false.
      !> It holds along a line, too: see `line_spot` of litz_line_law. Which of its numbers are the film resistance
      !> times area and the hardness there; 0: it has none
      logical :: serves_lines = .false.
      integer :: film_number = 0, hardness_number = 0
      !> Which of its numbers are rho l, resistivity times mean free path, and the mean free path itself, one of which
      !> is given; 0: it has none
      integer :: path_number = 0, free_path_number = 0
      !> Its resistance can be meant per length [ohm m], over a force per length, of wires that touch along a line; and
      !> it is
      logical :: can_be_per_length = .false., is_per_length = .false.
      procedure(spot_of_force), pointer, nopass :: spot_of_force => null()
   end type spot_law_t

   abstract interface
      !> Asked about a force that is positive.
      pure subroutine spot_of_force(given, spot, info)
         import :: law_input_t, contact_spot_t
         implicit none
         type(law_input_t), intent(in) :: given
         type(contact_spot_t), intent(out) :: spot
         !> `spot_ok` or `spot_bad_data`
         integer, intent(out) :: info
      end subroutine spot_of_force
   end interface

contains

   !> Spot and conductance of one contact, with the derivatives of the conductance.
   pure subroutine contact_spot(law, force, wires, ellipse, spot, info)
      type(spot_law_t), intent(in) :: law
      !> Contact force [N], positive in contact
      real(dp), intent(in) :: force
      type(wire_pair_t), intent(in) :: wires
      !> At the present angle; looked at by laws that use it
      type(hertz_ellipse_t), intent(in) :: ellipse
      type(contact_spot_t), intent(out) :: spot
      !> `spot_ok`, or what is wrong; there is no spot then
      integer, intent(out) :: info
      type(law_input_t) :: given

      info = spot_ok
      if (force <= 0 .or. law%number == 0) return
      info = spot_unknown_law
      if (.not. associated(law%spot_of_force)) return
      call tell(law, wires, ellipse, given, force=force)
      call law%spot_of_force(given, spot, info)
   end subroutine contact_spot

   !> `1/G <- 1/G + R` and the derivatives that follow.
   pure subroutine add_in_series(resistance, dresistance_dforce, dresistance_dangle, spot)
      !> R [ohm], dR/dF [ohm/N], dR/dangle [ohm/rad]
      real(dp), intent(in) :: resistance, dresistance_dforce, dresistance_dangle
      type(contact_spot_t), intent(inout) :: spot
      real(dp) :: share

      share = 1/(1 + spot%conductance*resistance)
      spot%conductance = spot%conductance*share
      spot%dconductance_dresistivity = spot%dconductance_dresistivity*share**2
      spot%dconductance_dforce = spot%dconductance_dforce*share**2 - spot%conductance**2*dresistance_dforce
      spot%dconductance_dangle = spot%dconductance_dangle*share**2 - spot%conductance**2*dresistance_dangle
   end subroutine add_in_series

end module litz_spot_law
