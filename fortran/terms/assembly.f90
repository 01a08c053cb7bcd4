!> From elements to the system: internal forces of all unknowns, tangent over the free ones.
module litz_assembly
   use litz_kinds, only: dp
   use litz_conductor, only: conductor
   use litz_element_library, only: elements_t, evaluate_beam
   use litz_equations, only: equations_t, block_offset
   use litz_linear_solver, only: csr_matrix_t, system_matrix_t
   use litz_model, only: model_t
   use litz_parallel, only: worth_threads, owned
   use litz_rotations, only: skew
   use litz_timing, only: timing_t, phase_elements, phase_assembly
   use litz_wires, only: wires_t
   implicit none
   private
   public :: iterate_t, forces_t
   public :: clear_system, assemble_beams, assemble_conductors, assemble_load_stiffness
   public :: chunk, add_mechanical, add_electric, add_coupling

   !> Elements evaluated between two scatters: their tangents stay in the cache
   integer, parameter :: chunk = 8192

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
      !> How large the unknowns are (7, n_nodes) [m, -, V]: the node's position, 1 for the entries of its rotation, and
      !> the largest potential of any node, because no node's own zero of potential is more than a convention
      real(dp), allocatable :: magnitude(:, :)
      !> What a relative change of these in every part of the model makes at most of the forces (7, n_nodes): the sum of
      !> `|K| |q|` over the elements and contacts at the node. Times epsilon it is the round-off of the residual there
      real(dp), allocatable :: sensitivity(:, :)
      real(dp) :: strain_energy = 0
      !> Stabilization: forces on the free unknowns, part of the internal ones (6, n_nodes), and their work [J]
      real(dp), allocatable :: damping(:, :)
      real(dp) :: damping_work = 0
   end type forces_t

contains

   subroutine clear_system(iterate, matrix, forces)
      type(iterate_t), intent(in) :: iterate
      type(system_matrix_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces
      integer :: n_nodes

      n_nodes = size(iterate%potential)
      matrix%mm%value = 0
      matrix%me%value = 0
      matrix%ee%value = 0
      matrix%mm_symmetric = .true.
      if (.not. allocated(forces%internal)) then
         allocate (forces%internal(7, n_nodes), forces%iteration(7, n_nodes), forces%prescribed(7, n_nodes), &
            forces%magnitude(7, n_nodes), forces%sensitivity(7, n_nodes))
      end if
      forces%internal = 0
      forces%iteration = 0
      forces%prescribed = 0
      forces%reference = 0
      forces%magnitude(1:3, :) = spread(maxval(abs(iterate%x), 1), 1, 3)
      forces%magnitude(4:6, :) = 1
      forces%magnitude(7, :) = maxval(abs(iterate%potential))
      forces%sensitivity = 0
      forces%strain_energy = 0
      forces%damping = reshape([real(dp) ::], [6, n_nodes], [0.0_dp])
      forces%damping_work = 0
   end subroutine clear_system

   !> Beams: `R = B^T C e`, `K = B^T C B + G(sigma)`; theory sections 7 and 9.
   subroutine assemble_beams(model, wires, elements, equations, increment, iterate, matrix, forces, timing)
      type(model_t), intent(in) :: model
      type(wires_t), intent(in) :: wires
      type(elements_t), intent(in) :: elements
      type(equations_t), intent(in) :: equations
      !> Prescribed increments of this iteration (7, n_nodes)
      real(dp), intent(in) :: increment(:, :)
      type(iterate_t), intent(inout) :: iterate
      type(system_matrix_t), intent(inout) :: matrix
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
         call add_mechanical(equations, model%connectivity(:, first:last), k(:, :, :n), r(:, :n), increment, matrix, &
            forces)
         call timing%lap(phase_assembly)
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
            call add_electric(equations, model%connectivity(:, members), k(:, :, :n), r(:, :n), increment, matrix, &
               forces)
            if (any(model%sections(model%element_section(members))%current_length)) then
               call add_coupling(equations, model%connectivity(:, members), k_me(:, :, :n), increment, matrix, forces)
            end if
         end associate
      end do

   contains

      subroutine evaluate(e, ke, re, k_me_e)
         integer, intent(in) :: e
         real(dp), intent(out) :: ke(2, 2), re(2), k_me_e(2, 12)
         real(dp) :: k_mu(2, 6)

         associate (node => model%connectivity(:, e))
            call conductor(iterate%x(:, node), iterate%potential(node), elements%length(e), elements%area(e), &
               elements%resistivity(e), model%sections(model%element_section(e))%current_length, ke, re, k_mu, &
               iterate%element_current(e), iterate%joule_heat(e))
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
         call scatter_mechanical_rows(equations, 1, [node], k, matrix%mm)
      end do
   end subroutine assemble_load_stiffness

   !> Add mechanical groups of nodes, such as the elements of a chunk: 6 unknowns for each node.
   !>
   !> Every thread adds the rows of its own nodes, group after group: no row has two writers, and each sum has the same
   !> order for any number of threads.
   subroutine add_mechanical(equations, nodes, k, r, increment, matrix, forces)
      type(equations_t), intent(in) :: equations
      !> Nodes (n, groups), tangents (6 n, 6 n, groups), forces (6 n, groups)
      integer, intent(in) :: nodes(:, :)
      real(dp), intent(in) :: k(:, :, :), r(:, :)
      !> Prescribed increments (7, n_nodes)
      real(dp), intent(in) :: increment(:, :)
      type(system_matrix_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces
      real(dp) :: largest_force, largest_moment, dq(size(k, 1))
      integer :: group, a, node

      largest_force = forces%reference(1)
      largest_moment = forces%reference(2)
      !$omp parallel private(group, a, node, dq) reduction(max: largest_force, largest_moment) &
      !$omp& if (size(nodes, 2) >= worth_threads)
      do group = 1, size(nodes, 2)
         do a = 1, size(nodes, 1)
            node = nodes(a, group)
            if (.not. owned(node)) cycle
            associate (block => r(6*a - 5:6*a, group))
               forces%internal(1:6, node) = forces%internal(1:6, node) + block
               largest_force = max(largest_force, maxval(abs(block(1:3))))
               largest_moment = max(largest_moment, maxval(abs(block(4:6))))
            end associate
            dq = reshape(increment(1:6, nodes(:, group)), [size(dq)])
            if (any(abs(dq) > 0)) forces%prescribed(1:6, node) = forces%prescribed(1:6, node) &
               + matmul(k(6*a - 5:6*a, :, group), dq)
            call add_sensitivity(nodes(:, group), k(6*a - 5:6*a, :, group), forces%magnitude(1:6, :), &
               forces%sensitivity(1:6, node))
            call scatter_mechanical_rows(equations, a, nodes(:, group), k(:, :, group), matrix%mm)
         end do
      end do
      !$omp end parallel
      forces%reference(1:2) = [largest_force, largest_moment]
   end subroutine add_mechanical

   !> Add electric groups of nodes: `k(n, n, groups)`, `r(n, groups)`.
   subroutine add_electric(equations, nodes, k, r, increment, matrix, forces)
      type(equations_t), intent(in) :: equations
      integer, intent(in) :: nodes(:, :)
      real(dp), intent(in) :: k(:, :, :), r(:, :), increment(:, :)
      type(system_matrix_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces
      integer :: group, a, b, node, row, position

      forces%reference(3) = max(forces%reference(3), maxval(abs(r)))
      !$omp parallel private(group, a, b, node, row, position) if (size(nodes, 2) >= worth_threads)
      do group = 1, size(nodes, 2)
         do a = 1, size(nodes, 1)
            node = nodes(a, group)
            if (.not. owned(node)) cycle
            forces%internal(7, node) = forces%internal(7, node) + r(a, group)
            forces%prescribed(7, node) = forces%prescribed(7, node) &
               + dot_product(k(a, :, group), increment(7, nodes(:, group)))
            call add_sensitivity(nodes(:, group), k(a:a, :, group), forces%magnitude(7:7, :), &
               forces%sensitivity(7:7, node))
            row = equations%electric(node)
            if (row == 0) cycle
            do b = 1, size(nodes, 1)
               if (equations%electric(nodes(b, group)) == 0) cycle
               position = matrix%ee%row_start(row) + &
                  equations%offset_electric(block_offset(equations, node, nodes(b, group)))
               matrix%ee%value(position) = matrix%ee%value(position) + k(a, b, group)
            end do
         end do
      end do
      !$omp end parallel
   end subroutine add_electric

   !> Add how the currents at nodes change with their motion: `k_me(n, 6 n, groups)`.
   subroutine add_coupling(equations, nodes, k_me, increment, matrix, forces)
      type(equations_t), intent(in) :: equations
      integer, intent(in) :: nodes(:, :)
      real(dp), intent(in) :: k_me(:, :, :), increment(:, :)
      type(system_matrix_t), intent(inout) :: matrix
      type(forces_t), intent(inout) :: forces
      real(dp) :: dq(size(k_me, 2))
      integer :: group, a, b, j, node, row, position

      !$omp parallel private(group, a, b, j, node, row, position, dq) if (size(nodes, 2) >= worth_threads)
      do group = 1, size(nodes, 2)
         do a = 1, size(nodes, 1)
            node = nodes(a, group)
            if (.not. owned(node)) cycle
            dq = reshape(increment(1:6, nodes(:, group)), [size(dq)])
            forces%prescribed(7, node) = forces%prescribed(7, node) + dot_product(k_me(a, :, group), dq)
            call add_sensitivity(nodes(:, group), k_me(a:a, :, group), forces%magnitude(1:6, :), &
               forces%sensitivity(7:7, node))
            row = equations%electric(node)
            if (row == 0) cycle
            do b = 1, size(nodes, 1)
               position = matrix%me%row_start(row) + &
                  equations%offset_mechanical(block_offset(equations, node, nodes(b, group)))
               do j = 1, 6
                  if (equations%mechanical(j, nodes(b, group)) == 0) cycle
                  matrix%me%value(position) = matrix%me%value(position) + k_me(a, 6*b - 6 + j, group)
                  position = position + 1
               end do
            end do
         end do
      end do
      !$omp end parallel
   end subroutine add_coupling

   !> Add `|K| |q|` of some rows of a group.
   pure subroutine add_sensitivity(nodes, k, magnitude, sensitivity)
      integer, intent(in) :: nodes(:)
      !> Rows of the tangent (rows, unknowns of a node x nodes), and how large the unknowns of all nodes are
      real(dp), intent(in) :: k(:, :), magnitude(:, :)
      !> Of these rows
      real(dp), intent(inout) :: sensitivity(:)
      integer :: b, i, column

      column = 0
      do b = 1, size(nodes)
         do i = 1, size(magnitude, 1)
            column = column + 1
            sensitivity = sensitivity + abs(k(:, column))*magnitude(i, nodes(b))
         end do
      end do
   end subroutine add_sensitivity

   !> Add the rows of node `a` of a group to the matrix.
   pure subroutine scatter_mechanical_rows(equations, a, nodes, k, mm)
      type(equations_t), intent(in) :: equations
      integer, intent(in) :: a, nodes(:)
      real(dp), intent(in) :: k(:, :)
      type(csr_matrix_t), intent(inout) :: mm
      integer :: b, i, j, row, position, offset

      if (equations%n_free(nodes(a)) == 0) return
      do b = 1, size(nodes)
         if (equations%n_free(nodes(b)) == 0) cycle
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
   end subroutine scatter_mechanical_rows

end module litz_assembly
