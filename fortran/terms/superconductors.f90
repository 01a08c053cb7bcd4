!> Elements that have superconducting filaments: their currents, which are unknowns of the iteration, and what flows in
!> them at the present iterate.
!>
!> Source: theory section 18.
module litz_superconductors
   use litz_kinds, only: dp
   use litz_model, only: model_t
   use litz_superconductor, only: superconductor, superconductor_flow_t, superconductor_wire_t, current_at, &
      moved_current, wire_of_material, critical_density_t
   implicit none
   private
   public :: superconductors_t, superconducting_state_t, new_superconductors

   !> What an element and its surroundings are at the iterate.
   type :: superconducting_state_t
      !> Positions of the nodes (3, 2) [m]
      real(dp) :: x(3, 2) = 0
      !> Length that conducts, and its derivative by the positions (6) [m, -]
      real(dp) :: length = 0, length_by_motion(6) = 0
      !> Of the cross-section [m^2]
      real(dp) :: area = 0
      !> Of the metal, and its derivative by the temperature [ohm m, ohm m/K]
      real(dp) :: resistivity = 0, dresistivity = 0
      !> Mean of the nodes, from absolute zero [K]
      real(dp) :: temperature = 0
      !> V1 - V2, and its round-off [V]
      real(dp) :: voltage = 0, round_off = 0
      !> Both potentials are prescribed: no equation is left, and the current is that of the law
      logical :: is_led = .false.
   end type superconducting_state_t

   type :: superconductors_t
      !> Elements (n), and the place of every element among them (n_elements); 0: it is none
      integer, allocatable :: members(:), place(:)
      !> Axial strain of the beam (n), and its derivative by the motions (12, n) [1/m, -]
      real(dp), allocatable :: strain(:), strain_by_motion(:, :)
      !> Its derivative by the mean temperature (n) [1/K], where motions see the temperatures of the iterate
      real(dp), allocatable :: strain_by_temperature(:)
      !> Flux density at the origin and its derivatives by x, y and z (12, n) [T, T/m]; of its norm in the middle of an
      !> element the law is asked
      real(dp), allocatable :: flux_density(:, :)
      !> I (n) [A], and V1 - V2 when it was last evaluated (n) [V]
      real(dp), allocatable :: current(:), voltage(:)
      !> As last evaluated (n)
      type(superconductor_wire_t), allocatable :: wires(:)
      type(superconductor_flow_t), allocatable :: flows(:)
      !> Derivatives of I* by the temperature of either node (n) [A/K] and by the motions (12, n) [A/m, A]
      real(dp), allocatable :: by_temperature(:), by_motion(:, :)
   contains
      procedure :: evaluate
      procedure :: move
   end type superconductors_t

contains

   pure type(superconductors_t) function new_superconductors(model) result(self)
      type(model_t), intent(in) :: model
      integer :: e, n

      allocate (self%members, source=pack([(e, e=1, model%n_elements)], [(allocated(model%materials(model%sections( &
         model%element_section(e))%material)%superconductor), e=1, model%n_elements)]))
      n = size(self%members)
      allocate (self%place(model%n_elements), source=0)
      self%place(self%members) = [(e, e=1, n)]
      allocate (self%strain(n), self%strain_by_temperature(n), self%strain_by_motion(12, n), &
         self%flux_density(12, n), self%current(n), self%voltage(n), self%by_temperature(n), self%by_motion(12, n), &
         source=0.0_dp)
      allocate (self%wires(n), self%flows(n))
   end function new_superconductors

   !> What flows in an element. Source: theory (18.3) to (18.5).
   pure subroutine evaluate(self, model, i, now)
      class(superconductors_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Place among the members
      integer, intent(in) :: i
      type(superconducting_state_t), intent(in) :: now
      type(critical_density_t) :: critical
      real(dp) :: flux(3), gradient(3, 3), norm, by_place(3)

      associate (material => model%materials(model%sections(model%element_section(self%members(i)))%material) &
         %superconductor, wire => self%wires(i), flow => self%flows(i))
         gradient = reshape(self%flux_density(4:, i), [3, 3])
         flux = self%flux_density(:3, i) + matmul(gradient, sum(now%x, 2)/2)
         norm = norm2(flux)
         wire%length = now%length
         wire%area = now%area
         wire%resistivity = now%resistivity
         call wire_of_material(material, now%temperature, norm, self%strain(i), wire, critical)
         self%voltage(i) = now%voltage
         if (now%is_led) self%current(i) = current_at(wire, now%voltage)
         flow = superconductor(wire, self%current(i), now%voltage, now%round_off)
         self%by_temperature(i) = (flow%by_critical*material%fraction*(critical%by_temperature &
            + critical%by_strain*self%strain_by_temperature(i)) + now%dresistivity &
            *(flow%by_resistivity - flow%by_conductivity*wire%law%conductivity/now%resistivity))/2
         by_place = 0
         if (norm > 0) by_place = flow%by_critical*material%fraction*critical%by_field*matmul(flux/norm, gradient)/2
         self%by_motion(:, i) = flow%by_critical*material%fraction*critical%by_strain*self%strain_by_motion(:, i)
         self%by_motion(1:3, i) = self%by_motion(1:3, i) + by_place + flow%by_length*now%length_by_motion(:3)
         self%by_motion(7:9, i) = self%by_motion(7:9, i) + by_place + flow%by_length*now%length_by_motion(4:)
      end associate
   end subroutine evaluate

   !> The potentials, temperatures and motions of the nodes of an element change.
   pure subroutine move(self, i, voltage, temperature, motion)
      class(superconductors_t), intent(inout) :: self
      !> Place among the members
      integer, intent(in) :: i
      !> Change of V1 - V2 [V], and sum of those of both temperatures [K]
      real(dp), intent(in) :: voltage, temperature
      !> Changes of the motions (12) [m, -]
      real(dp), intent(in) :: motion(12)

      associate (flow => self%flows(i))
         self%current(i) = moved_current(self%wires(i), self%current(i), flow%current + flow%by_voltage*voltage &
            + self%by_temperature(i)*temperature + dot_product(self%by_motion(:, i), motion), flow%drop, &
            self%voltage(i) + voltage)
      end associate
   end subroutine move

end module litz_superconductors
