!> Critical current density of a superconductor over temperature, flux density and strain: a value or table, or a fit.
!>
!> The laws are in the files critical_...; here are what they have in common and the choice among them.
module litz_critical_law
   use litz_kinds, only: dp
   use litz_critical_density, only: critical_density_t
   use litz_critical_nb3sn, only: nb3sn_density, n_nb3sn
   use litz_critical_nbti, only: nbti_density, n_nbti
   use litz_critical_table, only: table_density
   implicit none
   private
   public :: superconductor_t, critical_density, critical_choices, critical_table, critical_nb3sn, critical_nbti, &
      n_parameters, critical_density_t

   !> What decks call them, in the order of the constants
   character(len=*), parameter :: critical_choices = 'TABLE|NB3SN|NBTI'
   integer, parameter :: critical_table = 1, critical_nb3sn = 2, critical_nbti = 3
   !> Numbers of each law, a table apart
   integer, parameter :: n_parameters(3) = [0, n_nb3sn, n_nbti]

   !> What *SUPERCONDUCTOR says of a material.
   type :: superconductor_t
      !> One of `critical_...`
      integer :: law = critical_table
      !> Of the fits (n_parameters); as the law has them
      real(dp), allocatable :: parameters(:)
      !> Of a table: temperatures (n_t) [K], flux densities (n_b) [T], critical current densities (n_t, n_b) [A/m^2]
      real(dp), allocatable :: temperature(:), flux_density(:), density(:, :)
      !> Part of the cross-section that is superconductor
      real(dp) :: fraction = 0
      !> Electric field at the critical current [V/m], and the exponent n of the power law
      real(dp) :: criterion = 1.0e-4_dp, exponent = 0
      !> Flux density where no *LORENTZ gives one [T], and strain that the filaments have before the beam has any
      real(dp) :: field = 0, strain = 0
   end type superconductor_t

contains

   !> `jc(T, B, e)` and its derivatives; 0 beyond the critical surface.
   pure type(critical_density_t) function critical_density(material, temperature, field, strain) result(critical)
      type(superconductor_t), intent(in) :: material
      !> From absolute zero [K]; flux density [T]; axial strain of the filaments [-]
      real(dp), intent(in) :: temperature, field, strain

      select case (material%law)
      case (critical_nb3sn)
         critical = nb3sn_density(material%parameters, temperature, field, strain)
      case (critical_nbti)
         critical = nbti_density(material%parameters, temperature, field)
      case default
         critical = table_density(material%temperature, material%flux_density, material%density, temperature, field)
      end select
   end function critical_density

end module litz_critical_law
