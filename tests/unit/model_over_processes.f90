!> Sums and maxima over a model that the processes of MPI hold together, each its share, against those of the whole one.
!>
!> Wires in two layers are pressed together and carry a current; some wires touch nothing. Each process solves the whole
!> model by itself. Then it takes its share alone, evaluates the terms of that, and asks for norms, scales, energies,
!> audit, connected parts and history with the communicator of all. It prints how many contacts and nodes each has, and
!> fails where an answer is not that of the whole model.
program model_over_processes
   use, intrinsic :: iso_c_binding, only: c_int
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan, ieee_quiet_nan, ieee_value
   use litz_audit, only: audit_t, audit_increment, scales_t
   use litz_capture, only: capture_state
   use litz_communicator, only: communicator_t, one_process_t
   use litz_convergence, only: measure_residual, measure_scales, nodal_residual
   use litz_deck_reader, only: read_deck
   use litz_equations, only: build_system
   use litz_errors, only: error_t, error_list_t
   use litz_fields, only: field_potential, first_slot, n_fields
   use litz_flow_balances, only: current_imbalance
   use litz_grounding, only: ground_floating_parts, describe_fed_part, find_connected
   use litz_history, only: history_t
   use litz_initial_contacts, only: find_initial_overlap
   use litz_kinds, only: dp
   use litz_model, only: model_t
   use litz_mpi_communicator, only: mpi_communicator_t
   use litz_problem, only: problem_t, prepare_problem
   use litz_reports, only: iteration_report_t
   use litz_search_shares, only: owners_of_segments
   use litz_step_control, only: course_t
   use litz_steps, only: run_step
   use litz_term, only: status_t
   use share_of_model, only: share_t, find_share, make_problem
   use silent_observer, only: silent_t
   implicit none

   interface
      subroutine begin(rank, size) bind(c, name='test_begin_processes')
         import :: c_int
         implicit none
         integer(c_int), intent(out) :: rank, size
      end subroutine begin
      subroutine end_all(code) bind(c, name='test_end_processes')
         import :: c_int
         implicit none
         integer(c_int), value :: code
      end subroutine end_all
   end interface

   !> Sums of other order than that of the whole model
   real(dp), parameter :: round_off = 1.0e-11_dp
   integer, parameter :: slot = first_slot(field_potential)
   integer(c_int) :: rank, n_ranks
   type(problem_t) :: whole, part
   type(share_t) :: share
   type(mpi_communicator_t) :: processes
   integer :: failures = 0

   call begin(rank, n_ranks)
   call solve(whole)
   associate (x => whole%model%x, ends => whole%model%connectivity)
      call find_share(whole%model, whole%state%contacts, &
         owners_of_segments(x(:, ends(1, :)), x(:, ends(2, :)), n_ranks), rank + 1, share)
   end associate
   call processes%start(share%nodes)
   call check_communicator()
   call make_problem(whole, share, processes, part)
   call evaluate_terms(whole)
   call evaluate_terms(part, share)
   call processes%add_shared(part%forces%internal)
   call processes%add_shared(part%forces%sensitivity)
   call check_forces()
   call check_status()
   call check_residuals()
   call check_parts()
   call capture_state(whole)
   call capture_state(part)
   call check_energies()
   call check_audit()
   call check_history()
   if (processes%sum(failures) > 0) call end_all(1_c_int)
   call report()
   call end_all(0_c_int)

contains

   subroutine report()
      integer :: contacts(n_ranks), nodes(n_ranks)

      contacts = processes%gather([size(part%state%contacts)])
      nodes = processes%gather([part%model%n_nodes])
      if (rank == 0) print '(a, *(1x, i0))', 'contacts, and those of each process, and its nodes:', &
         size(whole%state%contacts), contacts, nodes
   end subroutine report

   !> Four wires along x, four on top of them along y that are lowered, and two along y apart, one of them loaded.
   subroutine write_deck(path)
      character(len=*), intent(in) :: path
      integer, parameter :: n_wires = 4, n_nodes = 7
      real(dp), parameter :: spacing = 0.01_dp
      character(len=*), parameter :: form_of_node = '(i0, 3(", ", es12.5))'
      integer :: unit, wire, i

      open (newunit=unit, file=path, action='write', status='replace')
      do wire = 1, n_wires + 2
         write (unit, '(a)') '*NODE'
         do i = 0, n_nodes - 1
            if (wire <= n_wires) write (unit, form_of_node) 100*wire + i, spacing*i, spacing*(wire + 0.5_dp), 0.0_dp
            ! so long that the shares cut them
            if (wire > n_wires) write (unit, form_of_node) 100*wire + i, spacing*(wire + 5), 4*spacing*i, 0.0_dp
         end do
         write (unit, '(a)') '*ELEMENT, TYPE=B33, ELSET=LOWER'
         write (unit, '(2(i0, ", "), i0)') (100*wire + i, 100*wire + i, 100*wire + i + 1, i=0, n_nodes - 2)
      end do
      do wire = 1, n_wires
         write (unit, '(a)') '*NODE'
         do i = 0, n_nodes - 1
            write (unit, form_of_node) 1000*wire + i, spacing*(wire + 0.5_dp), spacing*i, 0.002_dp
         end do
         write (unit, '(a)') '*ELEMENT, TYPE=B33, ELSET=UPPER'
         write (unit, '(2(i0, ", "), i0)') (1000*wire + i, 1000*wire + i, 1000*wire + i + 1, i=0, n_nodes - 2)
      end do
      write (unit, '(a)') '*NSET, NSET=PLUS', '300, 400', '*NSET, NSET=MINUS', '1006, 2006, 3006, 4006', &
         '*NSET, NSET=HELD', '100, 200, 300, 400, 106, 206, 306, 406, 500, 506, 600, 606', &
         '*NSET, NSET=MOVING', '1000, 2000, 3000, 4000, 1006, 2006, 3006, 4006', &
         '*MATERIAL, NAME=M', '*ELASTIC', '1.2e11, 0.34', '*ELECTRICAL CONDUCTIVITY', '5.8e7', &
         '*BEAM SECTION, ELSET=LOWER, MATERIAL=M, SECTION=CIRC', '1e-3', &
         '*BEAM SECTION, ELSET=UPPER, MATERIAL=M, SECTION=CIRC', '1e-3', &
         '*SURFACE INTERACTION, NAME=T', '*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ', &
         '*CONTACT PAIR, INTERACTION=T', 'LOWER, UPPER', &
         '*STEP', '*STATIC', '1., 1.', '*CONTROLS, PARAMETERS=STABILIZE', '1e-6', &
         '*BOUNDARY', 'HELD, ENCASTRE', 'MOVING, 1, 2', 'MOVING, 4, 6', &
         'MOVING, 3, 3, -5e-5', 'PLUS, 9, 9, 1e-3', 'MINUS, 9, 9, 0.', &
         '*CLOAD', '603, 3, -2.', '203, 2, 0.3', '3003, 1, 0.2', &
         '*NODE PRINT, NSET=MOVING, TOTALS=ONLY', 'RF, U', '*ENERGY PRINT', '*ELECTRODE PRINT', 'PLUS, MINUS', &
         '*END STEP'
      close (unit)
   end subroutine write_deck

   subroutine solve(problem)
      type(problem_t), intent(inout) :: problem
      type(model_t) :: model
      type(error_list_t) :: errors, warnings
      type(error_t), allocatable :: error
      type(course_t) :: course
      type(silent_t) :: silent
      character(len=32) :: path

      write (path, '(a, i0, a, i0, a)') 'over_processes_', rank, '_of_', n_ranks, '.inp'
      call write_deck(path)
      call read_deck(path, model, errors, warnings)
      if (errors%count > 0) then
         print '(a)', errors%text()
         call end_all(2_c_int)
      end if
      call prepare_problem(model, problem)
      call find_initial_overlap(problem, error)
      call stop_on(error)
      call run_step(problem, 1, 0, .false., course, silent, error)
      call stop_on(error)
   end subroutine solve

   !> Forces and tangent at the end of the increment.
   subroutine evaluate_terms(problem, share)
      type(problem_t), intent(inout) :: problem
      !> Absent: of the whole model
      type(share_t), intent(in), optional :: share
      type(error_t), allocatable :: error
      integer :: i

      call problem%iterate%start(problem%state, problem%model%x)
      call problem%iterate%warm_mechanics()
      problem%motions_stand = .false.
      problem%iterate%change = problem%state%value
      ! places along wires count from where these begin in each process
      deallocate (problem%contact%converged)
      allocate (problem%contact%converged(0))
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%start(problem%domain_t)
      end do
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%locate(problem%domain_t, error)
         call stop_on(error)
      end do
      if (present(share)) call keep_own_contacts(problem, share)
      call build_pattern(problem)
      call problem%clear_system()
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%evaluate(problem%domain_t, error)
         call stop_on(error)
      end do
   end subroutine evaluate_terms

   !> The search has found those of copies among each other, too.
   subroutine keep_own_contacts(problem, share)
      type(problem_t), intent(inout) :: problem
      type(share_t), intent(in) :: share
      logical :: is_own(size(problem%contact%points))
      integer :: i

      do i = 1, size(is_own)
         associate (point => problem%contact%points(i))
            is_own(i) = share%owner(min(share%elements(point%element_bar), share%elements(point%element))) &
               == share%process
         end associate
      end do
      problem%contact%points = pack(problem%contact%points, is_own)
   end subroutine keep_own_contacts

   subroutine build_pattern(problem)
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable :: error
      integer, allocatable :: members(:), start(:)
      integer :: i

      associate (connectivity => problem%model%connectivity, points => problem%contact%points)
         allocate (members, source=[connectivity, (connectivity(:, points(i)%element_bar), &
            connectivity(:, points(i)%element), i=1, size(points))])
         allocate (start, source=[(2*i - 1, i=1, size(connectivity, 2)), &
            (2*size(connectivity, 2) + 4*i - 3, i=1, size(points) + 1)])
      end associate
      call build_system(start, members, problem%equations, problem%matrix, error)
      call stop_on(error)
   end subroutine build_pattern

   !> What processes tell each other, whatever it is of.
   subroutine check_communicator()
      real(dp) :: value, there(1)
      integer, allocatable :: gathered(:)
      logical :: flags(2)
      integer :: i, k

      call check(processes%sum(rank + 1) == n_ranks*(n_ranks + 1)/2, 'a sum of counts')
      call check(all(nint(processes%sum([1.0_dp, real(rank, dp)])) == [n_ranks, n_ranks*(n_ranks - 1)/2]), 'sums')
      call check(nint(processes%largest(-real(rank, dp))) == 0, 'the largest of negative ones')
      value = 1
      if (rank == n_ranks - 1) value = ieee_value(value, ieee_quiet_nan)
      call check(ieee_is_nan(processes%largest(value)), 'what is not a number wins')
      value = merge(2, 1, rank > 0)
      there = rank
      call processes%take_largest(value, there)
      call check(nint(there(1)) == merge(1, 0, n_ranks > 1), 'of equal ones that of the first process')
      flags = processes%any([rank == n_ranks - 1, .false.])
      call check(flags(1) .and. .not. flags(2), 'a flag of one process')
      flags = processes%is_first([.true., rank > 0])
      call check((flags(1) .eqv. rank == 0) .and. (flags(2) .eqv. rank == 1), 'the first process with a flag')
      call check(processes%first_text(repeat('x', rank)) == merge('x', ' ', n_ranks > 1), 'the first to speak')
      gathered = processes%gather([(rank, i=1, rank)])
      call check(size(gathered) == n_ranks*(n_ranks - 1)/2, 'numbers of values that differ')
      call check(all(gathered == [((k, i=1, k), k=0, n_ranks - 1)]), 'in the order of the processes')
      call check(processes%count_nodes(size(share%nodes)) == whole%model%n_nodes, 'each node belongs to one process')
   end subroutine check_communicator

   !> Internal forces at all nodes are those of all elements and contacts.
   subroutine check_forces()
      real(dp) :: largest
      integer :: i

      associate (all_forces => whole%forces%internal, forces => part%forces%internal, nodes => share%nodes)
         do i = 1, size(forces, 1)
            largest = maxval(abs(all_forces(i, :)))
            call check(all(abs(forces(i, :) - all_forces(i, nodes)) <= round_off*largest), 'internal forces')
            largest = maxval(whole%forces%sensitivity(i, :))
            call check(all(abs(part%forces%sensitivity(i, :) - whole%forces%sensitivity(i, nodes)) &
               <= round_off*largest), 'how large forces are')
         end do
         call check(all(abs(part%loading%load - whole%loading%load(:, nodes)) <= 0), 'loads')
         call check(all(part%loading%fixed .eqv. whole%loading%fixed(:, nodes)), 'supports')
      end associate
      call check(maxval(abs(whole%forces%internal(slot, :))) > 0, 'a current flows')
   end subroutine check_forces

   subroutine check_status()
      type(status_t) :: status, of_part
      integer :: i

      do i = 1, size(whole%terms)
         call whole%terms(i)%term%count_status(status)
      end do
      do i = 1, size(part%terms)
         call part%terms(i)%term%count_status(of_part)
      end do
      call check(status%active > 4, 'several contacts are closed')
      call check(processes%sum(of_part%active) == status%active, 'closed contacts of all processes')
      call compare(processes%sum(of_part%force), status%force, 'sum of contact forces')
      call compare(processes%largest(of_part%penetration), status%penetration, 'deepest overlap')
   end subroutine check_status

   !> Norms and what they are measured by, also where a node of one process has most left over.
   subroutine check_residuals()
      type(iteration_report_t) :: report, of_part
      type(scales_t) :: scales, of_share
      logical :: at_round_off, at_round_off_there
      integer, allocatable :: node_at(:)
      integer :: field, node

      scales = measure_scales(whole)
      of_share = measure_scales(part)
      do field = 1, n_fields
         call compare(of_share%reference(field), scales%reference(field), 'what residuals are measured by')
      end do
      ! a force that no node of another process can have by chance
      node = 4
      whole%forces%internal(2, node) = whole%forces%internal(2, node) + 7
      node_at = pack([(field, field=1, size(share%nodes))], share%nodes == node)
      part%forces%internal(2, node_at) = part%forces%internal(2, node_at) + 7
      call measure_residual(whole, whole%model%steps(1), report, at_round_off)
      call measure_residual(part, part%model%steps(1), of_part, at_round_off_there)
      call check(at_round_off .eqv. at_round_off_there, 'accepted for round-off')
      call check(report%residual_node(1) == whole%model%node_id(node), 'the node that has most left over')
      call check(of_part%residual_node(1) == report%residual_node(1), 'all know that node')
      call compare(of_part%residual(1), report%residual(1), 'residual force')
      call compare(of_part%allowed(1), report%allowed(1), 'allowed residual force')
      whole%forces%internal(2, node) = whole%forces%internal(2, node) - 7
      part%forces%internal(2, node_at) = part%forces%internal(2, node_at) - 7
   end subroutine check_residuals

   !> Wires without a potential have one ground each, on whatever processes they are; a current into one is found.
   subroutine check_parts()
      type(error_t), allocatable :: error
      character(len=:), allocatable :: text
      logical :: connected(whole%model%n_nodes), of_part(part%model%n_nodes)
      integer :: fed, out

      call check(grounds_of(whole, one_process_t()) == 2, 'two wires have no potential')
      call check(grounds_of(part, processes) == 2, 'nor have they on several processes')
      call find_connected(whole, field_potential, connected)
      call find_connected(part, field_potential, of_part)
      call check(count(.not. connected) == 14, 'nodes without a potential')
      call check(all(of_part .eqv. connected(share%nodes)), 'the same on several processes')
      fed = findloc(whole%model%node_id, 605, 1)
      whole%loading%load(slot, fed) = 1
      where (share%nodes == fed) part%loading%load(slot, :) = 1
      call check(grounds_of(whole, one_process_t()) == 2, 'a wire with a current is held, too')
      call check(grounds_of(part, processes) == 2, 'with one ground on several processes')
      call check(whole%is_fed .and. part%is_fed, 'a current has no way out')
      text = describe_fed_part(part)
      call check(text == describe_fed_part(whole) .and. index(text, '605') > 0, 'all know where it is fed: '//text)
      ! what comes in at one end goes out at the other
      out = findloc(whole%model%node_id, 601, 1)
      whole%loading%load(slot, out) = -1
      where (share%nodes == out) part%loading%load(slot, :) = -1
      call check(grounds_of(whole, one_process_t()) == 2, 'a wire through which a current goes')
      call check(grounds_of(part, processes) == 2, 'through several processes')
      call check(.not. (whole%is_fed .or. part%is_fed), 'nothing is left in it')
      whole%loading%load(slot, [fed, out]) = 0
      where (share%nodes == fed .or. share%nodes == out) part%loading%load(slot, :) = 0
      call ground_floating_parts(whole, error)
      call stop_on(error)
      call ground_floating_parts(part, error)
      call stop_on(error)
   end subroutine check_parts

   !> Grounds that are added: they change what round-off there is at their nodes.
   integer function grounds_of(problem, of_whom) result(n)
      type(problem_t), intent(inout) :: problem
      class(communicator_t), intent(in) :: of_whom
      type(error_t), allocatable :: error
      real(dp), allocatable :: before(:, :)

      allocate (before, source=problem%forces%sensitivity)
      problem%forces%magnitude(slot, :) = 1
      call ground_floating_parts(problem, error)
      call stop_on(error)
      n = of_whom%sum(count(problem%forces%sensitivity(slot, :) > before(slot, :)))
      problem%forces%sensitivity = before
   end function grounds_of

   subroutine check_energies()
      associate (energies => whole%state%energies, of_all => part%state%energies)
         call check(energies%work > 0 .and. energies%contact > 0 .and. energies%strain > 0, 'there are energies')
         call compare(of_all%work, energies%work, 'work')
         call compare(of_all%strain, energies%strain, 'energy of the beams')
         call compare(of_all%contact, energies%contact, 'energy of the contacts')
         call compare(of_all%stabilization, energies%stabilization, 'energy taken by damping')
      end associate
      call check(all(abs(part%state%has_potential - whole%state%has_potential(share%nodes)) <= 0), 'who has potentials')
   end subroutine check_energies

   !> The same figures; and where one process alone has a state that is wrong, all know.
   subroutine check_audit()
      type(audit_t) :: audit, of_part
      real(dp) :: left(whole%model%n_nodes), left_in_part(part%model%n_nodes)
      integer :: node

      left = current_imbalance(one_process_t(), whole%model, whole%state)
      left_in_part = current_imbalance(processes, part%model, part%state)
      call check(all(abs(left_in_part - left(share%nodes)) <= round_off*maxval(abs(whole%state%reaction(slot, :)))), &
         'currents into nodes')
      audit = audit_of(whole)
      of_part = audit_of(part)
      call check(audit%finding == '' .and. of_part%finding == '', 'the audit passes: '//of_part%finding)
      call check(abs(of_part%force - audit%force) < round_off .and. abs(of_part%moment - audit%moment) < round_off &
         .and. abs(of_part%current - audit%current) < round_off .and. abs(of_part%power - audit%power) < round_off, &
         'figures of the audit')
      call compare(of_part%penetration, audit%penetration, 'deepest overlap over the radius')
      ! the supports and loads of all nodes balance
      node = findloc(whole%model%node_id, 3003, 1)
      where (share%nodes == node) part%state%load(1, :) = part%state%load(1, :) + 0.1_dp
      of_part = audit_of(part)
      call check(index(of_part%finding, 'the forces on the model do not balance') == 1, 'a force too many: '// &
         of_part%finding)
      where (share%nodes == node) part%state%load(1, :) = ieee_value(1.0_dp, ieee_quiet_nan)
      of_part = audit_of(part)
      call check(index(of_part%finding, 'at node 3003 is not a number') > 0, 'no number: '//of_part%finding)
      part%state%load = whole%state%load(:, share%nodes)
   end subroutine check_audit

   function audit_of(problem) result(audit)
      type(problem_t), intent(in) :: problem
      type(audit_t) :: audit

      audit = audit_increment(problem%processes, problem%model, problem%state, problem%loading, &
         nodal_residual(problem), measure_scales(problem))
   end function audit_of

   !> Electrodes, totals over sets, and energies.
   subroutine check_history()
      type(history_t) :: history, of_part
      type(error_t), allocatable :: error
      real(dp), allocatable :: row(:), row_of_part(:)
      real(dp) :: largest
      integer :: i

      call history%build(one_process_t(), whole%model, error)
      call of_part%build(processes, part%model, error)
      call stop_on(error)
      call check(history%header() == of_part%header(), 'columns of the history')
      call check(index(history%header(), 'resistance PLUS to MINUS') > 0, 'with electrodes')
      allocate (row, source=numbers_of(history%line(whole%state)))
      allocate (row_of_part, source=numbers_of(of_part%line(part%state)))
      call check(size(row) == size(row_of_part), 'numbers of the history')
      ! forces and moments that balance leave the round-off of the largest
      largest = maxval(abs(whole%state%reaction))
      do i = 1, size(row)
         call check(abs(row_of_part(i) - row(i)) <= round_off*abs(row(i)) + 10*epsilon(largest)*largest, &
            'a sum of the history')
      end do
   end subroutine check_history

   !> What stands between the commas.
   pure function numbers_of(line) result(numbers)
      character(len=*), intent(in) :: line
      real(dp), allocatable :: numbers(:)
      integer :: i

      allocate (numbers(count([(line(i:i) == ',', i=1, len(line))]) + 1))
      read (line, *) numbers
   end function numbers_of

   subroutine compare(found, expected, what)
      real(dp), intent(in) :: found, expected
      character(len=*), intent(in) :: what

      call check(abs(found - expected) <= round_off*abs(expected), what)
   end subroutine compare

   subroutine check(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what

      if (holds) return
      failures = failures + 1
      print '(a, i0, 2a)', 'FAILED on process ', rank + 1, ': ', what
   end subroutine check

   subroutine stop_on(error)
      type(error_t), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      print '(a)', error%message
      call end_all(2_c_int)
   end subroutine stop_on

end program model_over_processes
