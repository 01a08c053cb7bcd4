!> Conduction along the wires.
module litz_conductor_term
   use litz_kinds, only: dp
   use litz_domain, only: domain_t, element_flow_t
   use litz_element_loads, only: element_load_t, load_lorentz
   use litz_errors, only: error_t
   use litz_fields, only: field_potential, motion_slots, potential_slots, temperature_slots
   use litz_loading, only: element_loads_at
   use litz_model, only: step_t
   use litz_parallel, only: worth_threads
   use litz_scatter, only: chunk
   use litz_term, only: term_t
   implicit none
   private
   public :: conductor_term_t, new_conductor_term

   !> Current over the critical one of filaments that are normal
   real(dp), parameter :: most_loaded = 1.0e9_dp

   type, extends(term_t) :: conductor_term_t
      !> Elements that conduct
      integer, allocatable :: conducting(:)
      !> From the first to the second node [A], and heat [W], of each element (n_elements)
      real(dp), allocatable :: element_current(:), joule_heat(:)
   contains
      procedure :: request_slots
      procedure :: apply_load
      procedure :: start
      procedure :: evaluate
      procedure :: predict
      procedure :: follow
      procedure :: link
      procedure :: accept
   end type conductor_term_t

contains

   pure type(conductor_term_t) function new_conductor_term(resistivity) result(conductors)
      !> (n_elements) [ohm m]; 0: does not conduct
      real(dp), intent(in) :: resistivity(:)
      integer :: e

      allocate (conductors%conducting, source=pack([(e, e=1, size(resistivity))], resistivity > 0))
      allocate (conductors%element_current(size(resistivity)), conductors%joule_heat(size(resistivity)), source=0.0_dp)
   end function new_conductor_term

   subroutine request_slots(self, domain, exists)
      class(conductor_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> (n_slots, n_nodes)
      logical, intent(inout) :: exists(:, :)
      integer :: i

      do i = 1, size(self%conducting)
         exists(potential_slots(1):potential_slots(2), domain%model%connectivity(:, self%conducting(i))) = .true.
      end do
   end subroutine request_slots

   !> The flux density about superconducting filaments: of *LORENTZ, and without one that of the material.
   subroutine apply_load(self, domain, step, step_time, increment)
      class(conductor_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      type(step_t), intent(in) :: step
      !> Time of the step at the end of the increment, and the increment [s]
      real(dp), intent(in) :: step_time, increment
      type(element_load_t) :: loads(size(step%element_loads))
      integer :: i

      associate (there => domain%superconductors, model => domain%model)
         if (size(there%members) == 0) return
         there%flux_density = 0
         do i = 1, size(there%members)
            there%flux_density(1, i) = model%materials(model%sections(model%element_section(there%members(i))) &
               %material)%superconductor%field
         end do
         loads = element_loads_at(model, step, step_time, domain%state%time - domain%state%step_time)
         do i = 1, size(loads)
            if (loads(i)%kind /= load_lorentz) cycle
            if (there%place(loads(i)%element) > 0) there%flux_density(:, there%place(loads(i)%element)) = loads(i)%value
         end do
      end associate
   end subroutine apply_load

   subroutine start(self, domain)
      class(conductor_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain

      domain%superconductors%current = domain%state%element_current(domain%superconductors%members)
   end subroutine start

   subroutine evaluate(self, domain, error)
      class(conductor_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Never
      type(error_t), allocatable, intent(out) :: error
      real(dp), allocatable :: k(:, :, :), r(:, :), k_me(:, :, :)
      integer :: first, n, i

      call domain%find_superconducting_flows()
      n = min(chunk, size(self%conducting))
      allocate (k(2, 2, n), r(2, n), k_me(2, 12, n))
      do first = 1, size(self%conducting), chunk
         n = min(chunk, size(self%conducting) - first + 1)
         associate (members => self%conducting(first:first + n - 1), model => domain%model)
            !$omp parallel do schedule(static) if (n >= worth_threads)
            do i = 1, n
               call evaluate_element(members(i), k(:, :, i), r(:, i), k_me(:, :, i))
            end do
            !$omp end parallel do
            call domain%add_cells(model%connectivity(:, members), potential_slots, potential_slots, k(:, :, :n), &
               r(:, :n))
            if (any(model%sections(model%element_section(members))%current_length .or. &
               domain%superconductors%place(members) > 0)) call domain%add_cells(model%connectivity(:, members), &
               potential_slots, motion_slots, k_me(:, :, :n))
         end associate
      end do

   contains

      subroutine evaluate_element(e, ke, re, k_me_e)
         !> Element
         integer, intent(in) :: e
         !> Conductances (2, 2) [S], currents that leave the nodes (2) [A], and their derivatives by the motion (2, 12)
         real(dp), intent(out) :: ke(2, 2), re(2), k_me_e(2, 12)
         type(element_flow_t) :: flow

         ! with temperatures as unknowns, the heat term has the derivative by them
         flow = domain%flow_in(e)
         ke = flow%by_voltage*reshape([1.0_dp, -1.0_dp, -1.0_dp, 1.0_dp], [2, 2])
         re = flow%current*[1, -1]
         k_me_e = spread(flow%by_motion, 1, 2)
         k_me_e(2, :) = -k_me_e(1, :)
         self%element_current(e) = flow%current
         self%joule_heat(e) = flow%current*flow%voltage
      end subroutine evaluate_element

   end subroutine evaluate

   !> Currents in superconducting filaments follow a step that has potentials in it. Prescribed ones are taken whole.
   subroutine predict(self, domain, eta, correction)
      class(conductor_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Fraction of the step that is taken, and the step (n_slots, n_nodes)
      real(dp), intent(in) :: eta, correction(:, :)

      ! motions alone take their turn
      associate (of_potentials => correction(potential_slots(1):potential_slots(2), :))
         if (.not. any(abs(of_potentials) > 0) .and. any(abs(correction) > 0)) return
      end associate
      if (size(domain%superconductors%members) > 0) call follow(self, domain, &
         merge(correction, eta*correction, domain%loading%fixed))
   end subroutine predict

   !> Currents in superconducting filaments follow changes of the unknowns.
   subroutine follow(self, domain, correction)
      class(conductor_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> (n_slots, n_nodes)
      real(dp), intent(in) :: correction(:, :)
      integer :: i

      do i = 1, size(domain%superconductors%members)
         associate (node => domain%model%connectivity(:, domain%superconductors%members(i)))
            call domain%superconductors%move(i, correction(potential_slots(1), node(1)) &
               - correction(potential_slots(1), node(2)), sum(correction(temperature_slots(1), node)), &
               reshape(correction(motion_slots(1):motion_slots(2), node), [2*motion_slots(2)]))
         end associate
      end do
   end subroutine follow

   subroutine link(self, domain, field, pairs)
      class(conductor_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> One of the fields of litz_fields
      integer, intent(in) :: field
      !> Nodes of the elements that conduct (2, pairs)
      integer, allocatable, intent(out) :: pairs(:, :)

      allocate (pairs(2, merge(size(self%conducting), 0, field == field_potential)))
      if (size(pairs) > 0) pairs = domain%model%connectivity(:, self%conducting)
   end subroutine link

   subroutine accept(self, domain)
      class(conductor_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      real(dp) :: critical
      integer :: i

      associate (state => domain%state, model => domain%model)
         state%element_current = self%element_current
         state%current_density = self%element_current/model%sections(model%element_section)%area
         state%joule_heat = self%joule_heat
         call domain%note_metal()
         if (size(domain%superconductors%members) == 0) return
         do i = 1, size(domain%superconductors%members)
            associate (flow => domain%superconductors%flows(i), wire => domain%superconductors%wires(i), &
               current => domain%superconductors%current(i), e => domain%superconductors%members(i))
               critical = wire%area*wire%law%critical
               state%superconductors(:, e) = [flow%field, critical, min(abs(current)/max(critical, tiny(critical)), &
                  most_loaded), flow%field*current]
            end associate
         end do
      end associate
   end subroutine accept

end module litz_conductor_term
