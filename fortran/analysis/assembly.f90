!> From elements to the system: internal forces of all unknowns, tangent over the free ones.
module litz_assembly
   use litz_kinds, only: dp
   use litz_conductor, only: conductor
   use litz_element_library, only: elements_t, evaluate_beam
   use litz_equations, only: equations_t, block_offset
   use litz_linear_solver, only: csr_matrix_t, system_matrix_t
   use litz_model, only: model_t
   use litz_parallel, only: worth_threads
   use litz_rotations, only: skew
   use litz_wires, only: wires_t
   implicit none
   private
   public :: iterate_t, forces_t
   public :: clear_system, assemble_beams, assemble_conductors, assemble_load_stiffness
   public :: add_mechanical, add_electric, add_coupling

   !> Elements evaluated between two scatters: parallel evaluation, serial scatter, one result for any thread count
   integer, parameter :: chunk = 4096

   !> The unknowns as they stand in the iteration.
   type :: iterate_t
      !> Positions (3, n_nodes) [m], rotations from the reference (3, 3, n_nodes), potentials (n_nodes) [V]
      real(dp), allocatable :: x(:, :), rotation(:, :, :), potential(:)
      !> Sum of the rotations of each node since the increment began (3, n_nodes): tells full turns apart
      real(dp), allocatable :: turn(:, :)
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

   !> Forces over all unknowns (7, n_nodes): three forces, three moments, a current leaving the node.
   type :: forces_t
      real(dp), allocatable :: internal(:, :)
      !> What contacts that the prediction and the present gap judge differently add for this iteration only
      real(dp), allocatable :: iteration(:, :)
      !> Tangent times the prescribed increments
      real(dp), allocatable :: prescribed(:, :)
      !> Largest nodal force, moment and current of any element or contact: the reference of convergence
      real(dp) :: reference(3) = 0
      !> Largest stiffness against displacement [N/m], and against rotation [N m]: the floor of round-off
      real(dp) :: stiffness(2) = 0
      !> Largest conductance of an element or a contact [S]
      real(dp) :: conductance = 0
      real(dp) :: strain_energy = 0
   end type forces_t

contains

   subroutine clear_system(n_nodes, matrix, forces)
      integer, intent(in) :: n_nodes
      type(system_matrix_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces

      matrix%mm%value = 0
      matrix%me%value = 0
      matrix%ee%value = 0
      matrix%mm_symmetric = .true.
      if (.not. allocated(forces%internal)) then
         allocate (forces%internal(7, n_nodes), forces%iteration(7, n_nodes), forces%prescribed(7, n_nodes))
      end if
      forces%internal = 0
      forces%iteration = 0
      forces%prescribed = 0
      forces%reference = 0
      forces%stiffness = 0
      forces%conductance = 0
      forces%strain_energy = 0
   end subroutine clear_system

   !> Beams: `R = B^T C e`, `K = B^T C B + G(sigma)`; theory sections 7 and 9.
   subroutine assemble_beams(model, wires, elements, equations, increment, iterate, matrix, forces)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(equations_t), intent(in) :: equations
      !> Prescribed increments of this iteration (7, n_nodes)
      real(dp), intent(in) :: increment(:, :)
      type(iterate_t), intent(inout) :: iterate
      type(system_matrix_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces
      real(dp), allocatable :: k(:, :, :), r(:, :), energy(:)
      real(dp) :: stiffest
      integer :: first, last, e

      last = min(chunk, model%n_elements)
      allocate (k(12, 12, last), r(12, last), energy(last))
      do first = 1, model%n_elements, chunk
         last = min(model%n_elements, first + chunk - 1)
         !$omp parallel do schedule(static) if (last - first >= worth_threads)
         do e = first, last
            call evaluate(e, k(:, :, e - first + 1), r(:, e - first + 1), energy(e - first + 1))
         end do
         !$omp end parallel do
         do e = first, last
            associate (nodes => model%connectivity(:, e), ke => k(:, :, e - first + 1), re => r(:, e - first + 1))
               call add_mechanical(equations, nodes, ke, re, increment, matrix, forces)
               forces%strain_energy = forces%strain_energy + energy(e - first + 1)
               ! axial strain and shear: whichever is stiffer
               stiffest = maxval(elements%rigidity(1:3, e))
               forces%stiffness(1) = max(forces%stiffness(1), stiffest/elements%length(e))
               forces%stiffness(2) = max(forces%stiffness(2), stiffest)
            end associate
         end do
      end do
      iterate%sigma_from_strain = .false.

   contains

      subroutine evaluate(e, ke, re, energy_e)
         integer, intent(in) :: e
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
            call evaluate_beam(model%element_type(e), x, triads, elements%length(e), elements%strain0(:, e), &
               elements%stiffness(:, e), k=ke, r=re, energy=energy_e, &
               section_forces=iterate%section_forces(:, e), strain=iterate%strain(:, e), b=iterate%b(:, :, e))
            iterate%sigma(:, e) = iterate%section_forces(:, e)
         else
            call evaluate_beam(model%element_type(e), x, triads, elements%length(e), elements%strain0(:, e), &
               elements%stiffness(:, e), iterate%sigma(:, e), ke, re, energy_e, &
               iterate%section_forces(:, e), iterate%strain(:, e), iterate%b(:, :, e))
         end if
      end subroutine evaluate

   end subroutine assemble_beams

   !> Conduction along the wires.
   subroutine assemble_conductors(model, elements, equations, increment, iterate, matrix, forces)
      type(model_t), intent(in) :: model
      type(elements_t), intent(in) :: elements
      type(equations_t), intent(in) :: equations
      real(dp), intent(in) :: increment(:, :)
      type(iterate_t), intent(inout) :: iterate
      type(system_matrix_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces
      real(dp) :: k(2, 2), r(2), k_me(2, 6), k_me_all(2, 12)
      integer :: e
      logical :: current_length

      do e = 1, model%n_elements
         if (elements%resistivity(e) <= 0) cycle
         associate (node => model%connectivity(:, e))
            current_length = model%sections(model%element_section(e))%current_length
            call conductor(iterate%x(:, node), iterate%potential(node), elements%length(e), elements%area(e), &
               elements%resistivity(e), current_length, k, r, k_me, iterate%element_current(e), iterate%joule_heat(e))
            call add_electric(equations, node, k, r, increment, matrix, forces)
            if (current_length) then
               k_me_all = 0
               k_me_all(:, 1:3) = k_me(:, 1:3)
               k_me_all(:, 7:9) = k_me(:, 4:6)
               call add_coupling(equations, node, k_me_all, increment, matrix, forces)
            end if
         end associate
      end do
   end subroutine assemble_conductors

   !> A moment about a fixed axis does not follow from a potential: what it takes off the Hessian of the energy.
   !>
   !> The same holds for the reaction moment at a node of which one rotation is held and two are free.
   subroutine assemble_load_stiffness(equations, load, forces, matrix)
      type(equations_t), intent(in) :: equations
      !> Applied loads (7, n_nodes)
      real(dp), intent(in) :: load(:, :)
      type(forces_t), intent(in) :: forces
      type(system_matrix_t), intent(inout) :: matrix
      real(dp) :: moment(3), k(6, 6)
      integer :: node
      logical :: free(3)

      do node = 1, size(load, 2)
         free = equations%mechanical(4:6, node) > 0
         if (count(free) < 2) cycle
         moment = merge(load(4:6, node), forces%internal(4:6, node), free)
         if (.not. any(abs(moment) > 0)) cycle
         matrix%mm_symmetric = .false.
         k = 0
         k(4:6, 4:6) = -skew(moment)/2
         call scatter_mechanical(equations, [node], k, matrix%mm)
      end do
   end subroutine assemble_load_stiffness

   !> Add a mechanical group of nodes: 6 unknowns each, `k(6n, 6n)`, `r(6n)`.
   subroutine add_mechanical(equations, nodes, k, r, increment, matrix, forces)
      type(equations_t), intent(in) :: equations
      integer, intent(in) :: nodes(:)
      real(dp), intent(in) :: k(:, :), r(:), increment(:, :)
      type(system_matrix_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces
      real(dp) :: product(size(r))
      integer :: a

      product = prescribed_product(k, increment(1:6, nodes))
      do a = 1, size(nodes)
         associate (block => r(6*a - 5:6*a))
            forces%internal(1:6, nodes(a)) = forces%internal(1:6, nodes(a)) + block
            forces%prescribed(1:6, nodes(a)) = forces%prescribed(1:6, nodes(a)) + product(6*a - 5:6*a)
            forces%reference(1) = max(forces%reference(1), maxval(abs(block(1:3))))
            forces%reference(2) = max(forces%reference(2), maxval(abs(block(4:6))))
         end associate
      end do
      call scatter_mechanical(equations, nodes, k, matrix%mm)
   end subroutine add_mechanical

   !> Add an electric group of nodes: `k(n, n)`, `r(n)`.
   subroutine add_electric(equations, nodes, k, r, increment, matrix, forces)
      type(equations_t), intent(in) :: equations
      integer, intent(in) :: nodes(:)
      real(dp), intent(in) :: k(:, :), r(:), increment(:, :)
      type(system_matrix_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces
      integer :: a, b, row, position

      forces%internal(7, nodes) = forces%internal(7, nodes) + r
      forces%prescribed(7, nodes) = forces%prescribed(7, nodes) + matmul(k, increment(7, nodes))
      forces%reference(3) = max(forces%reference(3), maxval(abs(r)))
      forces%conductance = max(forces%conductance, maxval(abs(k)))
      do b = 1, size(nodes)
         if (equations%electric(nodes(b)) == 0) cycle
         do a = 1, size(nodes)
            row = equations%electric(nodes(a))
            if (row == 0) cycle
            position = matrix%ee%row_start(row) + &
               equations%offset_electric(block_offset(equations, nodes(a), nodes(b)))
            matrix%ee%value(position) = matrix%ee%value(position) + k(a, b)
         end do
      end do
   end subroutine add_electric

   !> Add how the currents at nodes change with their motion: `k_me(n, 6n)`.
   subroutine add_coupling(equations, nodes, k_me, increment, matrix, forces)
      type(equations_t), intent(in) :: equations
      integer, intent(in) :: nodes(:)
      real(dp), intent(in) :: k_me(:, :), increment(:, :)
      type(system_matrix_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces
      integer :: a, b, row, position, j

      forces%prescribed(7, nodes) = forces%prescribed(7, nodes) + prescribed_product(k_me, increment(1:6, nodes))
      do b = 1, size(nodes)
         do a = 1, size(nodes)
            row = equations%electric(nodes(a))
            if (row == 0) cycle
            position = matrix%me%row_start(row) + &
               equations%offset_mechanical(block_offset(equations, nodes(a), nodes(b)))
            do j = 1, 6
               if (equations%mechanical(j, nodes(b)) == 0) cycle
               matrix%me%value(position) = matrix%me%value(position) + k_me(a, 6*b - 6 + j)
               position = position + 1
            end do
         end do
      end do
   end subroutine add_coupling

   pure subroutine scatter_mechanical(equations, nodes, k, mm)
      type(equations_t), intent(in) :: equations
      integer, intent(in) :: nodes(:)
      real(dp), intent(in) :: k(:, :)
      type(csr_matrix_t), intent(inout) :: mm
      integer :: a, b, i, j, row, position, offset

      do b = 1, size(nodes)
         if (equations%n_free(nodes(b)) == 0) cycle
         do a = 1, size(nodes)
            if (equations%n_free(nodes(a)) == 0) cycle
            offset = equations%offset_mechanical(block_offset(equations, nodes(a), nodes(b)))
            do i = 1, 6
               row = equations%mechanical(i, nodes(a))
               if (row == 0) cycle
               position = mm%row_start(row) + offset
               do j = 1, 6
                  if (equations%mechanical(j, nodes(b)) == 0) cycle
                  mm%value(position) = mm%value(position) + k(6*a - 6 + i, 6*b - 6 + j)
                  position = position + 1
               end do
            end do
         end do
      end do
   end subroutine scatter_mechanical

   !> Tangent times prescribed increments, where there are any.
   pure function prescribed_product(k, increment) result(product)
      real(dp), intent(in) :: k(:, :), increment(:, :)
      real(dp) :: product(size(k, 1))

      product = 0
      if (any(abs(increment) > 0)) product = matmul(k, reshape(increment, [size(increment)]))
   end function prescribed_product

end module litz_assembly
