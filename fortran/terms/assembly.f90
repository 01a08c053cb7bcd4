!> From elements to the system: internal forces of all unknowns, tangent over the free ones.
module litz_assembly
   use litz_kinds, only: dp
   use litz_conductor, only: conductor
   use litz_element_library, only: elements_t, evaluate_beam
   use litz_equations, only: equations_t, system_t
   use litz_fields, only: n_groups, group_mechanical, group_electric, depends_on, field_displacement, field_rotation, &
      field_potential, first_slot, last_slot
   use litz_model, only: model_t
   use litz_parallel, only: worth_threads
   use litz_rotations, only: skew
   use litz_scatter, only: forces_t, clear_forces, scatter, scatter_tangent, chunk
   use litz_timing, only: timing_t, phase_elements, phase_assembly
   use litz_wires, only: wires_t
   implicit none
   private
   public :: iterate_t, clear_system, assemble_beams, assemble_conductors, assemble_load_stiffness
   public :: motion_slots, rotation_slots, potential_slots

   !> First and last slot of displacements and rotations, of rotations, and of potentials
   integer, parameter :: motion_slots(2) = [first_slot(field_displacement), last_slot(field_rotation)]
   integer, parameter :: rotation_slots(2) = [first_slot(field_rotation), last_slot(field_rotation)]
   integer, parameter :: potential_slots(2) = [first_slot(field_potential), last_slot(field_potential)]

   !> The unknowns as they stand in the iteration.
   type :: iterate_t
      !> Values (n_slots, n_nodes); those of rotations are the rotation vector when the increment began and the turns
      !> since, which distinguishes full turns
      real(dp), allocatable :: value(:, :)
      !> Sum of the corrections since the increment began (n_slots, n_nodes)
      real(dp), allocatable :: change(:, :)
      !> Positions (3, n_nodes) [m] and rotations from the reference (3, 3, n_nodes) that belong to these
      real(dp), allocatable :: x(:, :), rotation(:, :, :)
      !> Section forces as independent variables (6, n_elements), theory section 9
      real(dp), allocatable :: sigma(:, :)
      !> The next assembly takes the section forces of the strains instead
      logical :: sigma_from_strain = .true.
      !> Strains and their derivatives as of the last assembly (6, n_elements), (6, 12, n_elements)
      real(dp), allocatable :: strain(:, :), b(:, :, :)
      !> Section forces of these strains (6, n_elements)
      real(dp), allocatable :: section_forces(:, :)
      !> Current [A], heat [W] of each element
      real(dp), allocatable :: element_current(:), joule_heat(:)
   end type iterate_t

contains

   !> Nothing has been added yet.
   subroutine clear_system(iterate, matrix, forces)
      type(iterate_t), intent(in) :: iterate
      type(system_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces
      integer :: row_group, column_group

      do column_group = 1, n_groups
         do row_group = 1, n_groups
            if (depends_on(row_group, column_group)) matrix%block(row_group, column_group)%value = 0
         end do
      end do
      matrix%symmetric = .true.
      call clear_forces(iterate%x, iterate%value, iterate%change, forces)
   end subroutine clear_system

   !> Beams: `R = B^T C e`, `K = B^T C B + G(sigma)`; theory sections 7 and 9.
   subroutine assemble_beams(model, wires, elements, equations, increment, iterate, matrix, forces, timing)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(equations_t), intent(in) :: equations
      !> Prescribed increments of this iteration (n_slots, n_nodes)
      real(dp), intent(in) :: increment(:, :)
      type(iterate_t), intent(inout) :: iterate
      type(system_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces
      type(timing_t), intent(inout) :: timing
      real(dp), allocatable :: k(:, :, :), r(:, :), energy(:)
      integer :: first, last, n, e

      n = min(chunk, model%n_elements)
      allocate (k(12, 12, n), r(12, n), energy(n))
      do first = 1, model%n_elements, chunk
         last = min(model%n_elements, first + chunk - 1)
         n = last - first + 1
         !$omp parallel do schedule(dynamic, 64) if (n >= worth_threads)
         do e = first, last
            call evaluate(e, k(:, :, e - first + 1), r(:, e - first + 1), energy(e - first + 1))
         end do
         !$omp end parallel do
         forces%strain_energy = forces%strain_energy + sum(energy(:n))
         call timing%lap(phase_elements)
         call scatter(equations, model%connectivity(:, first:last), motion_slots, motion_slots, k(:, :, :n), &
            increment, matrix%block(group_mechanical, group_mechanical), forces, r(:, :n))
         call timing%lap(phase_assembly)
      end do
      iterate%sigma_from_strain = .false.

   contains

      subroutine evaluate(e, ke, re, energy_e)
         !> Element
         integer, intent(in) :: e
         !> Tangent (12, 12), residual (12) [N, N m], and strain energy [J]
         real(dp), intent(out) :: ke(12, 12), re(12), energy_e
         real(dp) :: x(3, 2), triads(3, 3, 2)
         integer :: side

         associate (node => model%connectivity(:, e))
            do side = 1, 2
               x(:, side) = iterate%x(:, node(side))
               triads(:, :, side) = matmul(iterate%rotation(:, :, node(side)), wires%triads0(:, :, side, e))
            end do
         end associate
         if (iterate%sigma_from_strain) then
            call evaluate_beam(model%element_type(e), elements, e, x, triads, k=ke, r=re, energy=energy_e, &
               section_forces=iterate%section_forces(:, e), strain=iterate%strain(:, e), b=iterate%b(:, :, e))
            iterate%sigma(:, e) = iterate%section_forces(:, e)
         else
            call evaluate_beam(model%element_type(e), elements, e, x, triads, iterate%sigma(:, e), ke, re, energy_e, &
               iterate%section_forces(:, e), iterate%strain(:, e), iterate%b(:, :, e))
         end if
      end subroutine evaluate

   end subroutine assemble_beams

   !> Conduction along the wires.
   subroutine assemble_conductors(model, elements, equations, increment, iterate, matrix, forces)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(equations_t), intent(in) :: equations
      !> Prescribed increments of this iteration (n_slots, n_nodes)
      real(dp), intent(in) :: increment(:, :)
      type(iterate_t), intent(inout) :: iterate
      type(system_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces
      real(dp), allocatable :: k(:, :, :), r(:, :), k_me(:, :, :)
      integer, allocatable :: conducting(:)
      integer :: first, n, i, e

      conducting = pack([(e, e=1, model%n_elements)], elements%resistivity > 0)
      n = min(chunk, size(conducting))
      allocate (k(2, 2, n), r(2, n), k_me(2, 12, n))
      do first = 1, size(conducting), chunk
         n = min(chunk, size(conducting) - first + 1)
         associate (members => conducting(first:first + n - 1))
            !$omp parallel do schedule(static) if (n >= worth_threads)
            do i = 1, n
               call evaluate(members(i), k(:, :, i), r(:, i), k_me(:, :, i))
            end do
            !$omp end parallel do
            call scatter(equations, model%connectivity(:, members), potential_slots, potential_slots, k(:, :, :n), &
               increment, matrix%block(group_electric, group_electric), forces, r(:, :n))
            if (any(model%sections(model%element_section(members))%current_length)) then
               call scatter(equations, model%connectivity(:, members), potential_slots, motion_slots, k_me(:, :, :n), &
                  increment, matrix%block(group_electric, group_mechanical), forces)
            end if
         end associate
      end do

   contains

      subroutine evaluate(e, ke, re, k_me_e)
         !> Element
         integer, intent(in) :: e
         !> Conductances (2, 2) [S], currents that leave the nodes (2) [A], and their derivatives by the motion (2, 12)
         real(dp), intent(out) :: ke(2, 2), re(2), k_me_e(2, 12)
         real(dp) :: k_mu(2, 6)

         associate (node => model%connectivity(:, e))
            call conductor(iterate%x(:, node), iterate%value(potential_slots(1), node), elements%length(e), &
               elements%area(e), elements%resistivity(e), model%sections(model%element_section(e))%current_length, &
               ke, re, k_mu, iterate%element_current(e), iterate%joule_heat(e))
         end associate
         k_me_e = 0
         k_me_e(:, 1:3) = k_mu(:, 1:3)
         k_me_e(:, 7:9) = k_mu(:, 4:6)
      end subroutine evaluate

   end subroutine assemble_conductors

   !> A moment about a fixed axis does not follow from a potential: what it takes off the Hessian of the energy.
   !>
   !> The same holds for the reaction moment at a node of which one rotation is held and two are free.
   subroutine assemble_load_stiffness(equations, load, forces, matrix)
      type(equations_t), intent(in) :: equations
      !> Applied loads (n_slots, n_nodes)
      real(dp), intent(in) :: load(:, :)
      type(forces_t), intent(in) :: forces
      type(system_t), intent(inout) :: matrix
      real(dp) :: moment(3)
      integer :: node
      logical :: free(3)

      associate (first => rotation_slots(1), last => rotation_slots(2), &
         block => matrix%block(group_mechanical, group_mechanical))
         do node = 1, size(load, 2)
            free = equations%number(first:last, node) > 0
            if (count(free) < 2) cycle
            moment = merge(load(first:last, node), forces%internal(first:last, node), free)
            if (.not. any(abs(moment) > 0)) cycle
            matrix%symmetric(group_mechanical) = .false.
            call scatter_tangent(equations, [node], rotation_slots, rotation_slots, -skew(moment)/2, block)
         end do
      end associate
   end subroutine assemble_load_stiffness

end module litz_assembly
