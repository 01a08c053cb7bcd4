!> Beams: `R = B^T C e`, `K = B^T C B + G(sigma)`.
!>
!> The section forces `sigma` of the geometric stiffness are independent variables of the iteration. Source: theory
!> sections 7 and 9.
module litz_beam_term
   use litz_kinds, only: dp
   use litz_beam_axes, only: along_principal_axes, along_section_axes
   use litz_domain, only: domain_t
   use litz_element_library, only: heated_beam_t, beam_at_temperature, beam_by_temperature, evaluate_beam
   use litz_end_forces, only: forces_at_ends
   use litz_errors, only: error_t
   use litz_fields, only: first_slot, last_slot, field_rotation, motion_slots, temperature_slots
   use litz_model, only: step_t
   use litz_parallel, only: worth_threads
   use litz_scatter, only: chunk
   use litz_state, only: energies_t
   use litz_term, only: term_t
   use litz_timing, only: phase_elements, phase_assembly
   implicit none
   private
   public :: beam_term_t, new_beam_term

   type, extends(term_t) :: beam_term_t
      !> Section forces as independent variables (6, n_elements)
      real(dp), allocatable :: sigma(:, :)
      !> The next evaluation takes the section forces of the strains instead
      logical :: sigma_from_strain = .true.
      !> Strains and their derivatives as last evaluated (6, n_elements), (6, 12, n_elements)
      real(dp), allocatable :: strain(:, :), b(:, :, :)
      !> Section forces of these strains (6, n_elements) [N, N m], and their energy [J]
      real(dp), allocatable :: section_forces(:, :)
      real(dp) :: strain_energy = 0
   contains
      procedure :: request_slots
      procedure :: start
      procedure :: evaluate
      procedure :: bearable_fraction
      procedure :: predict
      procedure :: agree
      procedure :: add_energies
      procedure :: accept
   end type beam_term_t

contains

   pure type(beam_term_t) function new_beam_term(n_elements) result(beams)
      !> Elements of the model
      integer, intent(in) :: n_elements

      allocate (beams%sigma(6, n_elements), beams%strain(6, n_elements), beams%b(6, 12, n_elements), &
         beams%section_forces(6, n_elements), source=0.0_dp)
   end function new_beam_term

   subroutine request_slots(self, domain, exists)
      class(beam_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> (n_slots, n_nodes)
      logical, intent(inout) :: exists(:, :)
      integer :: e

      do e = 1, domain%model%n_elements
         exists(motion_slots(1):motion_slots(2), domain%model%connectivity(:, e)) = .true.
      end do
   end subroutine request_slots

   !> The forces of the last increment: those of its strains, which at new temperatures are those of a wire that cannot
   !> move.
   subroutine start(self, domain)
      class(beam_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      integer :: e

      self%sigma_from_strain = size(domain%elements%heated) == 0
      if (self%sigma_from_strain) return
      do e = 1, domain%model%n_elements
         self%sigma(:, e) = along_principal_axes(domain%elements%axes(e), domain%state%section_forces(:, e))
      end do
   end subroutine start

   subroutine evaluate(self, domain, error)
      class(beam_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Never
      type(error_t), allocatable, intent(out) :: error
      real(dp), allocatable :: k(:, :, :), r(:, :), energy(:)
      integer :: first, last, n, e

      if (domain%motions_stand) return
      n = min(chunk, domain%model%n_elements)
      allocate (k(12, 12, n), r(12, n), energy(n))
      self%strain_energy = 0
      do first = 1, domain%model%n_elements, chunk
         last = min(domain%model%n_elements, first + chunk - 1)
         n = last - first + 1
         !$omp parallel do schedule(dynamic, 64) if (n >= worth_threads)
         do e = first, last
            call evaluate_element(e, k(:, :, e - first + 1), r(:, e - first + 1), energy(e - first + 1))
         end do
         !$omp end parallel do
         self%strain_energy = self%strain_energy + sum(energy(:n))
         call domain%timing%lap(phase_elements)
         call domain%add_cells(domain%model%connectivity(:, first:last), motion_slots, motion_slots, k(:, :, :n), &
            r(:, :n))
         call domain%timing%lap(phase_assembly)
      end do
      if (size(domain%superconductors%members) > 0) call tell_strains(self, domain)
      if (domain%coupled_step) call add_temperatures(self, domain)
      if (size(domain%iterate%bodies%dependents) > 0) call suppose_forces(self, domain)
      self%sigma_from_strain = .false.

   contains

      subroutine evaluate_element(e, ke, re, energy_e)
         !> Element
         integer, intent(in) :: e
         !> Tangent (12, 12), residual (12) [N, N m], and strain energy [J]
         real(dp), intent(out) :: ke(12, 12), re(12), energy_e
         real(dp) :: x(3, 2), triads(3, 3, 2)
         integer :: side

         associate (node => domain%model%connectivity(:, e), iterate => domain%iterate)
            do side = 1, 2
               x(:, side) = iterate%x(:, node(side))
               triads(:, :, side) = matmul(iterate%rotation(:, :, node(side)), domain%wires%triads0(:, :, side, e))
            end do
         end associate
         associate (element_type => domain%model%element_type(e), elements => domain%elements)
            if (self%sigma_from_strain) then
               call evaluate_beam(element_type, elements, e, x, triads, k=ke, r=re, energy=energy_e, &
                  section_forces=self%section_forces(:, e), strain=self%strain(:, e), b=self%b(:, :, e))
               self%sigma(:, e) = self%section_forces(:, e)
            else
               call evaluate_beam(element_type, elements, e, x, triads, self%sigma(:, e), ke, re, energy_e, &
                  self%section_forces(:, e), self%strain(:, e), self%b(:, :, e))
            end if
         end associate
      end subroutine evaluate_element

   end subroutine evaluate

   !> The axial strains of elements with superconducting filaments.
   subroutine tell_strains(self, domain)
      class(beam_term_t), intent(in) :: self
      type(domain_t), intent(inout) :: domain
      type(heated_beam_t) :: by_temperature
      integer :: i

      associate (there => domain%superconductors, heated => domain%elements%heated)
         there%strain = self%strain(1, there%members)
         there%strain_by_motion = self%b(1, :, there%members)
         there%strain_by_temperature = 0
         if (.not. domain%coupled_step) return
         do i = 1, size(heated)
            if (there%place(heated(i)) == 0) cycle
            by_temperature = beam_by_temperature(domain%model, domain%elements, heated(i))
            there%strain_by_temperature(there%place(heated(i))) = -by_temperature%thermal_strain(1)
         end do
      end associate
   end subroutine tell_strains

   !> What temperatures do to the forces, `L B^T (C' e - C g e_T')`, half of it by each node. Source: theory (14.2).
   subroutine add_temperatures(self, domain)
      class(beam_term_t), intent(in) :: self
      type(domain_t), intent(inout) :: domain
      real(dp), allocatable :: k(:, :, :)
      integer :: i

      associate (heated => domain%elements%heated)
         allocate (k(size(self%b, 2), 2, size(heated)))
         do i = 1, size(heated)
            associate (e => heated(i))
               k(:, :, i) = spread(domain%elements%length(e)*matmul(forces_by_temperature(self, domain, e), &
                  self%b(:, :, e))/2, 2, 2)
            end associate
         end do
         call domain%add_cells(domain%model%connectivity(:, heated), motion_slots, temperature_slots, k)
      end associate
   end subroutine add_temperatures

   !> How the section forces of the strains change with the mean temperature of an element (6) [N/K, N m/K].
   pure function forces_by_temperature(self, domain, e) result(slope)
      class(beam_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      !> Element
      integer, intent(in) :: e
      real(dp) :: slope(6)
      type(heated_beam_t) :: by_temperature

      by_temperature = beam_by_temperature(domain%model, domain%elements, e)
      slope = by_temperature%rigidity*self%strain(:, e) - domain%elements%rigidity(:, e)*by_temperature%thermal_strain
   end function forces_by_temperature

   !> `L B^T (sigma - C e)` at the nodes: what belongs to the geometric stiffness of the arms of rigid bodies, too.
   subroutine suppose_forces(self, domain)
      class(beam_term_t), intent(in) :: self
      type(domain_t), intent(inout) :: domain
      real(dp) :: force(3, 2, 2)
      integer :: e, side

      domain%forces%supposed = 0*domain%iterate%x
      do e = 1, domain%model%n_elements
         associate (nodes => domain%model%connectivity(:, e), supposed => domain%forces%supposed)
            if (.not. any(domain%iterate%bodies%reference(nodes) > 0)) cycle
            ! displacements and rotations of either node
            force = reshape(domain%elements%length(e)*matmul(self%sigma(:, e) - self%section_forces(:, e), &
               self%b(:, :, e)), [3, 2, 2])
            do side = 1, 2
               supposed(:, nodes(side)) = supposed(:, nodes(side)) + force(:, 1, side)
            end do
         end associate
      end do
   end subroutine suppose_forces

   !> No node turns by more than the cap on rotations in one iteration.
   real(dp) function bearable_fraction(self, domain, step, correction)
      class(beam_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      type(step_t), intent(in) :: step
      !> Linear step of the unknowns (n_slots, n_nodes)
      real(dp), intent(in) :: correction(:, :)
      real(dp) :: rotation

      rotation = sqrt(maxval(sum(correction(first_slot(field_rotation):last_slot(field_rotation), :)**2, 1)))
      bearable_fraction = 1
      if (rotation > step%controls%rotation_cap) bearable_fraction = step%controls%rotation_cap/rotation
   end function bearable_fraction

   !> `sigma <- (1 - eta) sigma + eta C (e + B dq)`; after prescribed motion they are those of the strains.
   subroutine predict(self, domain, eta, correction)
      class(beam_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain
      !> Fraction of the step that is taken, and the step (n_slots, n_nodes)
      real(dp), intent(in) :: eta, correction(:, :)
      real(dp) :: dq(2*motion_slots(2))
      integer :: e

      !$omp parallel do schedule(static) private(dq) if (domain%model%n_elements >= worth_threads)
      do e = 1, domain%model%n_elements
         dq = reshape(correction(motion_slots(1):motion_slots(2), domain%model%connectivity(:, e)), [size(dq)])
         self%sigma(:, e) = (1 - eta)*self%sigma(:, e) + eta*domain%elements%rigidity(:, e)* &
            (self%strain(:, e) + matmul(self%b(:, :, e), dq))
      end do
      !$omp end parallel do
      if (domain%coupled_step) then
         do e = 1, size(domain%elements%heated)
            associate (heated => domain%elements%heated(e))
               self%sigma(:, heated) = self%sigma(:, heated) + eta*forces_by_temperature(self, domain, heated) &
                  *sum(correction(temperature_slots(1), domain%model%connectivity(:, heated)))/2
            end associate
         end do
      end if
      self%sigma_from_strain = any(abs(domain%iterate%prescribed(motion_slots(1):motion_slots(2), :)) > 0)
   end subroutine predict

   subroutine agree(self)
      class(beam_term_t), intent(inout) :: self

      self%sigma_from_strain = .true.
   end subroutine agree

   subroutine add_energies(self, domain, energies)
      class(beam_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      type(energies_t), intent(inout) :: energies

      energies%strain = energies%strain + self%strain_energy
      energies%thermal = energies%thermal + thermal_work(self, domain)
   end subroutine add_energies

   !> What the change of temperature has done in the increment: the change of the elastic energy where nothing moves,
   !> mean of that at its start and that at its end. Source: theory section 14.
   pure real(dp) function thermal_work(self, domain) result(work)
      class(beam_term_t), intent(in) :: self
      type(domain_t), intent(in) :: domain
      type(heated_beam_t) :: before
      real(dp) :: strain(6)
      integer :: i

      work = 0
      associate (elements => domain%elements, temperature => domain%state%mechanical_temperature)
         do i = 1, size(elements%heated)
            associate (e => elements%heated(i), length => elements%length(elements%heated(i)))
               before = beam_at_temperature(domain%model, elements, i, &
                  sum(temperature(domain%model%connectivity(:, e)))/2)
               strain = along_principal_axes(elements%axes(e), domain%state%section_forces(:, e))/before%rigidity
               work = work - energy_of(length, before%rigidity, strain) &
                  + energy_of(length, elements%rigidity(:, e), strain - elements%thermal_strain(:, e) &
                  + before%thermal_strain)
               strain = self%strain(:, e)
               work = work + energy_of(length, elements%rigidity(:, e), strain) &
                  - energy_of(length, before%rigidity, strain - before%thermal_strain &
                  + elements%thermal_strain(:, e))
            end associate
         end do
      end associate
      work = work/2
   end function thermal_work

   pure real(dp) function energy_of(length, rigidity, strain)
      !> Reference length [m], rigidities and strains (6)
      real(dp), intent(in) :: length, rigidity(6), strain(6)

      energy_of = length/2*dot_product(rigidity*strain, strain)
   end function energy_of

   subroutine accept(self, domain)
      class(beam_term_t), intent(inout) :: self
      type(domain_t), intent(inout) :: domain

      integer :: e

      do e = 1, domain%model%n_elements
         domain%state%section_forces(:, e) = along_section_axes(domain%elements%axes(e), self%section_forces(:, e))
      end do
      if (.not. domain%state%has_section_results) return
      do e = 1, domain%model%n_elements
         domain%state%section_ends(:, e) = forces_at_ends(domain, e, domain%elements%length(e) &
            *matmul(self%section_forces(:, e), self%b(:, :, e)))
      end do
   end subroutine accept

end module litz_beam_term
