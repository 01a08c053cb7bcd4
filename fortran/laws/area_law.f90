!> What laws per area are: pressure from the gap between two surfaces, and the conductance per area that goes with it.
!>
!> Each law is a file `area_<name>.f90`; litz_area_laws is the table of all. Pressure and conductance are nominal, per
!> reference area. `delta = -g` is the overlap, `E*` the joint modulus, `rho` and `rho_b` the resistivities of the two
!> bodies:
!>
!> | pressure    | p                   | | conductance   | 1/h                                                  |
!> |-------------|---------------------|-|---------------|------------------------------------------------------|
!> | LINEAR      | `p_a + eps_n delta` | | CMY           | `sigma/(1.25 k m) (H/p)^0.95`, `k = 2/(rho + rho_b)` |
!> | EXPONENTIAL | `p_0 exp(delta/l)`  | | FILM          | that of CMY `+ sigma_f H/p`                          |
!> |             |                     | | ELASTIC ROUGH | `E* (rho + rho_b)/(2 dp/ddelta)`                     |
!> |             |                     | | CONSTANT      | given                                                |
!> |             |                     | | TABLE         | over p                                               |
!>
!> Source: M. G. Cooper, B. B. Mikic, M. M. Yovanovich, Int. J. Heat Mass Transfer 12 (1969) 279 (CMY), with the
!> conductivity of current in place of that of heat; J. R. Barber, Proc. R. Soc. A 459 (2003) 53 (ELASTIC ROUGH).
module litz_area_law
   use litz_kinds, only: dp
   use litz_law_words, only: law_words_t, max_fields
   implicit none
   private
   public :: pressure_law_t, area_conductance_law_t, body_pair_t, area_input_t, pressure_t, area_conductance_t
   public :: pressure_at_gap, conductance_at_pressure, joint_modulus
   public :: area_ok, area_bad_data

   integer, parameter :: area_ok = 0
   !> TABLE: no pair at all, pressures not ascending, or an entry that is not positive
   integer, parameter :: area_bad_data = -3

   !> The two bodies: barred, unbarred.
   type :: body_pair_t
      !> Young's moduli [Pa], Poisson's ratios [-], resistivities [ohm m]
      real(dp) :: young(2) = 0, poisson(2) = 0, resistivity(2) = 0
   end type body_pair_t

   !> All 0 where the surfaces do not touch.
   type :: pressure_t
      !> p [Pa], dp/ddelta [Pa/m], its derivative by delta [Pa/m^2]
      real(dp) :: pressure = 0, stiffness = 0, dstiffness_ddelta = 0
   end type pressure_t

   type :: area_conductance_t
      !> h [S/m^2] and dh/ddelta [S/m^3]
      real(dp) :: conductance = 0, dconductance_ddelta = 0
   end type area_conductance_t

   !> What a law is told.
   type :: area_input_t
      !> delta [m], negative where the surfaces are apart, and the pressure of augmentation p_a [Pa]
      real(dp) :: overlap = 0, augmentation = 0
      !> What the pressure law answers
      type(pressure_t) :: normal
      type(body_pair_t) :: bodies
      !> Numbers of the law, see law_words_t
      real(dp) :: data(max_fields) = 0
      real(dp), allocatable :: table(:, :)
   end type area_input_t

   type, extends(law_words_t) :: pressure_law_t
      !> It takes a pressure of augmentation
      logical :: can_be_augmented = .false.
      procedure(pressure_of_overlap), pointer, nopass :: pressure_of_overlap => null()
   end type pressure_law_t

   type, extends(law_words_t) :: area_conductance_law_t
      !> It looks at the resistivities, and at the elastic constants, of the bodies
      logical :: uses_resistivity = .false., uses_elasticity = .false.
      procedure(conductance_of_pressure), pointer, nopass :: conductance_of_pressure => null()
   end type area_conductance_law_t

   abstract interface
      pure function pressure_of_overlap(given) result(found)
         import :: area_input_t, pressure_t
         implicit none
         type(area_input_t), intent(in) :: given
         type(pressure_t) :: found
      end function pressure_of_overlap

      !> Asked about a pressure that is positive.
      pure subroutine conductance_of_pressure(given, found, info)
         import :: area_input_t, area_conductance_t
         implicit none
         type(area_input_t), intent(in) :: given
         type(area_conductance_t), intent(out) :: found
         !> `area_ok` or `area_bad_data`
         integer, intent(out) :: info
      end subroutine conductance_of_pressure
   end interface

contains

   !> Pressure at a gap; all 0 where the surfaces do not press each other.
   pure type(pressure_t) function pressure_at_gap(law, gap, augmentation) result(found)
      type(pressure_law_t), intent(in) :: law
      !> g [m], negative in contact
      real(dp), intent(in) :: gap
      !> p_a [Pa]
      real(dp), intent(in) :: augmentation
      type(area_input_t) :: given

      given%overlap = -gap
      given%augmentation = augmentation
      given%data = law%data
      found = law%pressure_of_overlap(given)
      if (.not. found%pressure > 0) found = pressure_t()
   end function pressure_at_gap

   !> Conductance per area at a pressure; 0 without one, or where no law is given (number 0).
   pure subroutine conductance_at_pressure(law, normal, bodies, found, info)
      type(area_conductance_law_t), intent(in) :: law
      type(pressure_t), intent(in) :: normal
      type(body_pair_t), intent(in) :: bodies
      type(area_conductance_t), intent(out) :: found
      !> `area_ok` or `area_bad_data`
      integer, intent(out) :: info
      type(area_input_t) :: given

      info = area_ok
      if (law%number == 0 .or. .not. normal%pressure > 0) return
      given%normal = normal
      given%bodies = bodies
      given%data = law%data
      if (allocated(law%table)) given%table = law%table
      call law%conductance_of_pressure(given, found, info)
   end subroutine conductance_at_pressure

   !> `1/E* = (1 - nu^2)/E + (1 - nu_b^2)/E_b` [Pa].
   pure real(dp) function joint_modulus(bodies)
      type(body_pair_t), intent(in) :: bodies

      joint_modulus = 1/sum((1 - bodies%poisson**2)/bodies%young)
   end function joint_modulus

end module litz_area_law
