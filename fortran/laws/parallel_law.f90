!> A superconductor in parallel with a normal metal: its power law, and Ohm's law of the metal, at one electric field.
!>
!>     J(E) = s E + jc (E/Ec)^(1/n)                                                                                  (1)
!>
!> `s` is the conductivity of the metal and `jc` the critical current density, each with its part of the cross-section,
!> `J` the current per whole area; both signs. The current of a field is (1); the field of a current is found with the
!> logarithms of both, between which the slope of (1) lies in [1/n, 1]: `ln J` is convex over `ln E`, so Newton's method
!> from the field that either conductor alone would need descends to the root, over as many decades as there are.
!>
!> Source: theory section 18.
module litz_parallel_law
   use litz_kinds, only: dp
   implicit none
   private
   public :: parallel_law_t, parallel_field_t, field_of_current, current_of_field

   type :: parallel_law_t
      !> s [S/m], positive; jc [A/m^2]; Ec [V/m]; n
      real(dp) :: conductivity = 0, critical = 0, criterion = 1, exponent = 1
   end type parallel_law_t

   !> An electric field and what changes it.
   type :: parallel_field_t
      !> E [V/m]
      real(dp) :: value = 0
      !> Derivatives by J [ohm m], s [V^2/A] and jc [ohm m] at the others
      real(dp) :: by_current = 0, by_conductivity = 0, by_critical = 0
   end type parallel_field_t

   !> Newton's iterations, of which some six are needed, and what is left of ln E then
   integer, parameter :: max_iterations = 50
   real(dp), parameter :: accurate = 4*epsilon(1.0_dp)
   !> Below this, ln E counts as that of no field
   real(dp), parameter :: least_log = log(tiny(1.0_dp))

contains

   !> Source: (1).
   pure real(dp) function current_of_field(law, field) result(current)
      type(parallel_law_t), intent(in) :: law
      !> E [V/m]
      real(dp), intent(in) :: field

      current = law%conductivity*field + sign(law%critical*(abs(field)/law%criterion)**(1/law%exponent), field)
   end function current_of_field

   !> The inverse of (1).
   pure type(parallel_field_t) function field_of_current(law, current) result(field)
      type(parallel_law_t), intent(in) :: law
      !> J [A/m^2]
      real(dp), intent(in) :: current
      real(dp) :: j, log_field, share, slope, change
      integer :: i

      j = abs(current)
      if (.not. law%critical > 0) then
         field = parallel_field_t(current/law%conductivity, 1/law%conductivity, -current/law%conductivity**2, 0.0_dp)
         return
      end if
      if (.not. j > 0) then
         if (law%exponent <= 1) field%by_current = 1/(law%conductivity + law%critical/law%criterion)
         return
      end if
      ! ln(E/Ec), from above
      log_field = min(log(j/(law%conductivity*law%criterion)), law%exponent*log(j/law%critical))
      do i = 1, max_iterations
         if (log_field < least_log) return
         call logarithm_of_current(law, log_field, change, share, slope)
         change = (log(j) - change)/slope
         log_field = log_field + change
         if (abs(change) <= accurate*max(1.0_dp, abs(log_field))) exit
      end do
      if (log_field + log(law%criterion) < least_log) return
      call logarithm_of_current(law, log_field, change, share, slope)
      field%value = law%criterion*exp(log_field)
      field%by_current = field%value/j/slope
      field%by_conductivity = -sign(field%value*share/law%conductivity/slope, current)
      field%by_critical = -sign(field%value*(1 - share)/law%critical/slope, current)
      field%value = sign(field%value, current)
   end function field_of_current

   !> ln J over ln(E/Ec).
   pure subroutine logarithm_of_current(law, log_field, log_current, share, slope)
      type(parallel_law_t), intent(in) :: law
      !> ln(E/Ec)
      real(dp), intent(in) :: log_field
      !> ln J, the part of the current in the metal, and d ln J/d ln E
      real(dp), intent(out) :: log_current, share, slope
      real(dp) :: metal, filaments, larger

      metal = log(law%conductivity*law%criterion) + log_field
      filaments = log(law%critical) + log_field/law%exponent
      larger = max(metal, filaments)
      log_current = larger + log(exp(metal - larger) + exp(filaments - larger))
      share = exp(metal - log_current)
      slope = share + (1 - share)/law%exponent
   end subroutine logarithm_of_current

end module litz_parallel_law
