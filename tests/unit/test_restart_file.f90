!> A restart file gives back every number that it was given, to the last bit, and is refused by another model.
!>
!> The numbers are random, as no run would make them: what is lost or exchanged on the way shows.
program test_restart_file
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_positive_inf
   use litz_contact_points, only: contact_point_t
   use litz_deck_reader, only: read_deck
   use litz_errors, only: error_t, error_list_t, exit_files, exit_input
   use litz_fields, only: n_slots
   use litz_initial_contacts, only: find_initial_overlap
   use litz_kinds, only: dp, int64
   use litz_model, only: model_t
   use litz_problem, only: problem_t, prepare_problem
   use litz_restart_file, only: restart_file_t, read_restart
   use litz_state, only: contact_t, energies_t
   use litz_step_control, only: course_t
   implicit none

   character(len=*), parameter :: nl = new_line('a'), path = 'test_restart_file.restart.h5'
   !> The usual place of a node of the deck
   character(len=*), parameter :: place = '2, 0.02, 0, 0'
   integer :: failures = 0

   call what_is_written_comes_back()
   call another_model_is_refused()
   call a_missing_increment_is_refused()
   call a_file_without_an_increment_is_discarded()
   if (failures > 0) error stop 1

contains

   !> Of three increments with different numbers of contacts each one, and the last one where none is named.
   subroutine what_is_written_comes_back()
      call write_increments([1, 2, 3])
      call expect_increment(1, 1, [1])
      call expect_increment(1, 2, [1, 2])
      call expect_increment(1, 3, [1, 2, 3])
      call expect_increment(0, 0, [1, 2, 3])
   end subroutine what_is_written_comes_back

   subroutine another_model_is_refused()
      type(problem_t) :: fitted, without_steps

      call write_increments([1, 2])
      call expect_refusal_with('2, 0.021, 0, 0', 1, 1, exit_input, 'the nodes: positions changed')
      ! a node that no element has changes the size of all arrays of nodes
      call expect_refusal_with(place//nl//'99, 1, 1, 1', 1, 1, exit_input, &
         'the deck differs from that of the run that wrote it')
      call new_problem(place, fitted)
      fitted%model%contact_pairs(1)%interference_fit = .true.
      call expect_refusal(fitted, 1, 1, exit_input, 'the deck differs from that of the run that wrote it')
      call new_problem(place, without_steps)
      deallocate (without_steps%model%steps)
      allocate (without_steps%model%steps(0))
      call expect_refusal(without_steps, 1, 1, exit_input, 'it stands in step 1, but the deck has 0')
   end subroutine another_model_is_refused

   subroutine a_missing_increment_is_refused()
      call write_increments([3, 5])
      call expect_refusal_with(place, 1, 4, exit_input, 'it has no increment 1:4; it has 1:3 1:5')
   end subroutine a_missing_increment_is_refused

   subroutine a_file_without_an_increment_is_discarded()
      logical :: is_there

      call write_increments([integer ::])
      inquire (file=path, exist=is_there)
      call check(.not. is_there, 'no file without an increment')
      call expect_refusal_with(place, 0, 0, exit_files, 'does not exist')
   end subroutine a_file_without_an_increment_is_discarded

   !> What comes back for this step and increment is what the last of these has written.
   subroutine expect_increment(step, increment, increments)
      integer, intent(in) :: step, increment, increments(:)
      type(problem_t) :: written, found
      type(course_t) :: written_course, course
      type(error_t), allocatable :: error
      integer :: i

      call new_problem(place, written)
      do i = 1, size(increments)
         call fill(written, written_course, increments(i))
      end do
      call new_problem(place, found)
      call read_restart(path, step, increment, found, course, error)
      call stop_on(error)
      call compare(written, written_course, found, course)
   end subroutine expect_increment

   !> Two wires that cross, with this line among the nodes of the first.
   subroutine new_problem(node, problem)
      character(len=*), intent(in) :: node
      type(problem_t), intent(inout) :: problem
      type(model_t) :: model
      type(error_list_t) :: errors, warnings
      type(error_t), allocatable :: error
      integer :: unit

      open (newunit=unit, file='test_restart_file.inp', action='write', status='replace')
      write (unit, '(a)') '*NODE', '1, -0.02, 0, 0', node, '11, 0, -0.02, 0.002', '12, 0, 0.02, 0.002', &
         '*ELEMENT, TYPE=B31, ELSET=A', '1, 1, 2', '*ELEMENT, TYPE=B31, ELSET=B', '11, 11, 12', &
         '*INITIAL CONDITIONS, TYPE=TEMPERATURE', '1, 293', '*MATERIAL, NAME=M', '*ELASTIC', '1.1e11, 0.3', &
         '*ELECTRICAL CONDUCTIVITY', '5e7', &
         '*BEAM SECTION, ELSET=A, MATERIAL=M, SECTION=CIRC', '1e-3', &
         '*BEAM SECTION, ELSET=B, MATERIAL=M, SECTION=CIRC', '1e-3', &
         '*SURFACE INTERACTION, NAME=T', '*CONTACT PAIR, INTERACTION=T', 'A, B', &
         '*STEP', '*STATIC', '*BOUNDARY', '1, 1, 6', '11, 1, 6', '1, 9, 9, 1', '11, 9', '*END STEP'
      close (unit)
      call read_deck('test_restart_file.inp', model, errors, warnings)
      if (errors%count > 0) then
         print '(a)', errors%text()
         error stop 1
      end if
      call prepare_problem(model, problem)
      call find_initial_overlap(problem, error)
      call stop_on(error)
   end subroutine new_problem

   !> Random numbers in everything that the next increment depends on, the same for each increment of step 1.
   subroutine fill(problem, course, increment)
      type(problem_t), intent(inout) :: problem
      type(course_t), intent(out) :: course
      integer, intent(in) :: increment
      real(dp) :: numbers(11)
      integer :: n_contacts

      call start_random_numbers(increment)
      n_contacts = 2*(increment - 1)
      associate (state => problem%state)
         call random_number(state%value)
         call random_number(state%rotation)
         call random_number(state%reaction)
         call random_number(state%load)
         call random_number(state%damping)
         call random_number(state%section_forces)
         call random_number(state%element_current)
         call random_number(state%current_density)
         call random_number(state%joule_heat)
         call random_number(state%metal)
         call random_number(state%has_potential)
         call random_number(state%audit)
         ! what arithmetic would not keep: the sign of zero, the smallest and the largest number
         state%value(1:3, 1) = [-0.0_dp, tiny(1.0_dp)/3, -huge(1.0_dp)]
         call random_number(numbers)
         state%step = 1
         state%increment = increment
         state%iterations = 17 + increment
         state%time = numbers(1)
         state%step_time = numbers(2)
         state%time_increment = numbers(3)
         course%start_time = numbers(4)
         course%control%wanted = numbers(5)
         course%control%quick = 2 + increment
         state%energies = energies_t(numbers(6), numbers(7), numbers(8), numbers(9), numbers(10))
         state%contacts = contacts_of(n_contacts)
      end associate
      call fill_loading(problem)
      associate (contact => problem%contact)
         contact%last_id = 40 + increment
         contact%clearance = numbers(11)
         contact%converged = points_of(n_contacts)
         contact%candidates = reshape([1, 2, 1], [3, 1])
         call random_number(contact%x_collected)
      end associate
      call problem%warnings%set_place(1, increment, problem%state%time)
      call problem%warnings%add('penetration', 'wires overlap', [1, 11], numbers(1), '%')
   end subroutine fill

   subroutine fill_loading(problem)
      type(problem_t), intent(inout) :: problem
      real(dp) :: part(n_slots, problem%model%n_nodes)

      associate (loading => problem%loading)
         if (.not. allocated(loading%load)) allocate (loading%start_value, loading%start_load, loading%value, &
            loading%load, loading%converged_value, mold=part)
         call random_number(loading%start_value)
         call random_number(loading%start_load)
         call random_number(loading%value)
         call random_number(loading%load)
         call random_number(loading%converged_value)
         call random_number(part)
         loading%fixed = part > 0.5_dp
      end associate
   end subroutine fill_loading

   function contacts_of(n) result(contacts)
      integer, intent(in) :: n
      type(contact_t), allocatable :: contacts(:)
      real(dp) :: r(17), v(3, 4)
      integer :: i

      allocate (contacts(n))
      do i = 1, n
         call random_number(r)
         call random_number(v)
         contacts(i) = contact_t(id=i + 7, element_bar=1, element=2, xi_bar=r(1), xi=r(2), pair=1, angle=r(3), &
            gap=r(4), normal=v(:, 1), point_bar=v(:, 2), point=v(:, 3), force=r(5), friction_status=2, &
            traction=v(:, 4), slip_path=r(6), dissipation=r(7), semi_major=r(8), semi_minor=r(9), pressure=r(14), &
            resistance=r(10), current=r(11), voltage_gap=r(12), joule_heat=r(13))
         if (i == 1) contacts(i)%resistance = ieee_value(1.0_dp, ieee_positive_inf)
      end do
   end function contacts_of

   function points_of(n) result(points)
      integer, intent(in) :: n
      type(contact_point_t), allocatable :: points(:)
      real(dp) :: r(8), v(3), h(11)
      integer :: i

      allocate (points(n))
      do i = 1, n
         call random_number(r)
         call random_number(v)
         call random_number(h)
         associate (point => points(i), kinematics => points(i)%kinematics, history => points(i)%history)
            point%id = i + 7
            point%element_bar = 1
            point%element = 2
            point%pair = 1
            point%closed = mod(i, 2) == 1
            point%xi_bar = r(1)
            point%xi = r(2)
            point%arc_bar = r(3)
            point%arc = r(4)
            point%gap = r(5)
            point%fit = r(6)
            point%force = r(7)
            kinematics%gap = r(8)
            kinematics%normal = v
            kinematics%side = (-1)**i
            kinematics%angle = h(11)
            history%closed = mod(i, 2) == 0
            history%arc = h(1:2)
            history%force = h(3)
            history%traction = h(4:5)
            history%slip_path = h(6)
            history%dissipation = h(7)
            history%elastic_energy = h(8)
            history%largest_force = h(9)
            history%spot_arc = [h(10), h(1)]
         end associate
      end do
   end function points_of

   !> A file with these increments of step 1.
   subroutine write_increments(increments)
      integer, intent(in) :: increments(:)
      type(problem_t) :: problem
      type(restart_file_t) :: file
      type(course_t) :: course
      type(error_t), allocatable :: error
      integer :: i

      call remove()
      call new_problem(place, problem)
      call file%open(path, problem, error)
      do i = 1, size(increments)
         call fill(problem, course, increments(i))
         call file%write(problem, course, error)
      end do
      call file%close(error)
      call stop_on(error)
   end subroutine write_increments

   subroutine compare(written, written_course, found, course)
      type(problem_t), intent(in) :: written, found
      type(course_t), intent(in) :: written_course, course

      associate (a => written%state, b => found%state)
         call check(same([a%value], [b%value]), 'values of nodes')
         call check(same([a%rotation], [b%rotation]), 'rotation matrices')
         call check(same([a%reaction], [b%reaction]), 'reactions')
         call check(same([a%load], [b%load]), 'loads')
         call check(same([a%damping], [b%damping]), 'damping')
         call check(same([a%section_forces], [b%section_forces]), 'section forces')
         call check(same(a%element_current, b%element_current), 'currents of elements')
         call check(same(a%current_density, b%current_density), 'current densities')
         call check(same(a%joule_heat, b%joule_heat), 'heat of elements')
         call check(same([a%metal], [b%metal]), 'resistivities and resistances of elements')
         call check(same([a%has_potential], [b%has_potential]), 'which nodes have a potential')
         call check(all([a%step, a%increment, a%iterations] == [b%step, b%increment, b%iterations]), &
            'place and iterations')
         call check(same([a%time, a%step_time, a%time_increment], [b%time, b%step_time, b%time_increment]), 'times')
         call check(same(a%audit, b%audit), 'audit')
         call check(same(energies(a%energies), energies(b%energies)), 'energies')
      end associate
      call check(written_course%control%quick == course%control%quick .and. same([written_course%start_time, &
         written_course%control%wanted], [course%start_time, course%control%wanted]), 'control of increments')
      call compare_loading(written, found)
      call compare_contact(written, found)
      call check(found%warnings%n == 1 .and. found%warnings%items(1)%text() == written%warnings%items(1)%text(), &
         'warnings')
   end subroutine compare

   subroutine compare_loading(written, found)
      type(problem_t), intent(in) :: written, found

      associate (a => written%loading, b => found%loading)
         if (.not. (allocated(b%fixed) .and. allocated(b%start_value) .and. allocated(b%start_load) .and. &
            allocated(b%value) .and. allocated(b%load) .and. allocated(b%converged_value))) then
            call check(.false., 'values and loads are there')
            return
         end if
         call check(all(a%fixed .eqv. b%fixed), 'what is prescribed')
         call check(same([a%start_value], [b%start_value]), 'values at the start of the step')
         call check(same([a%start_load], [b%start_load]), 'loads at the start of the step')
         call check(same([a%value], [b%value]), 'prescribed values')
         call check(same([a%load], [b%load]), 'applied loads')
         call check(same([a%converged_value], [b%converged_value]), 'converged values')
      end associate
   end subroutine compare_loading

   subroutine compare_contact(written, found)
      type(problem_t), intent(in) :: written, found
      integer :: i

      associate (a => written%contact, b => found%contact)
         call check(a%last_id == b%last_id, 'number of the last contact')
         call check(same(a%clearance, b%clearance), 'clearances')
         call check(same(a%clearance, b%converged_clearance), 'converged clearances')
         call check(all(a%candidates == b%candidates), 'candidates')
         call check(same([a%x_collected], [b%x_collected]), 'positions at the search')
         call check(size(a%converged) == size(b%converged), 'number of points')
         call check(size(written%state%contacts) == size(found%state%contacts), 'number of contacts')
         do i = 1, min(size(a%converged), size(b%converged))
            call compare_points(a%converged(i), b%converged(i))
            call compare_contacts(written%state%contacts(i), found%state%contacts(i))
         end do
      end associate
   end subroutine compare_contact

   subroutine compare_points(a, b)
      type(contact_point_t), intent(in) :: a, b

      call check(all([a%id, a%element_bar, a%element, a%pair, a%kinematics%side] == [b%id, b%element_bar, b%element, &
         b%pair, b%kinematics%side]), 'whole numbers of points')
      call check((a%closed .eqv. b%closed) .and. (a%history%closed .eqv. b%history%closed), 'closed points')
      call check(same(numbers_of_point(a), numbers_of_point(b)), 'numbers of points')
   end subroutine compare_points

   pure function numbers_of_point(p) result(numbers)
      type(contact_point_t), intent(in) :: p
      real(dp), allocatable :: numbers(:)

      associate (k => p%kinematics, h => p%history)
         numbers = [p%xi_bar, p%xi, p%arc_bar, p%arc, p%gap, p%fit, p%force, k%gap, k%normal, k%angle, h%arc, h%force, &
            h%traction, h%slip_path, h%dissipation, h%elastic_energy, h%largest_force, h%spot_arc]
      end associate
   end function numbers_of_point

   subroutine compare_contacts(a, b)
      type(contact_t), intent(in) :: a, b

      call check(all([a%id, a%element_bar, a%element, a%pair, a%friction_status] == [b%id, b%element_bar, b%element, &
         b%pair, b%friction_status]), 'whole numbers of contacts')
      call check(same(numbers_of_contact(a), numbers_of_contact(b)), 'numbers of contacts')
   end subroutine compare_contacts

   pure function numbers_of_contact(c) result(numbers)
      type(contact_t), intent(in) :: c
      real(dp), allocatable :: numbers(:)

      numbers = [c%xi_bar, c%xi, c%angle, c%gap, c%normal, c%point_bar, c%point, c%force, c%traction, c%slip_path, &
         c%dissipation, c%semi_major, c%semi_minor, c%pressure, c%resistance, c%current, c%voltage_gap, c%joule_heat]
   end function numbers_of_contact

   pure function energies(e) result(numbers)
      type(energies_t), intent(in) :: e
      real(dp) :: numbers(5)

      numbers = [e%work, e%strain, e%contact, e%friction, e%stabilization]
   end function energies

   !> The problem cannot go on from the increment, with this exit code and these words.
   subroutine expect_refusal(problem, step, increment, code, words)
      type(problem_t), intent(inout) :: problem
      integer, intent(in) :: step, increment, code
      character(len=*), intent(in) :: words
      type(course_t) :: course
      type(error_t), allocatable :: error

      call read_restart(path, step, increment, problem, course, error)
      call check(allocated(error), 'refused: '//words)
      if (.not. allocated(error)) return
      call check(error%code == code, 'exit code of: '//error%message)
      call check(index(error%message, words) > 0 .and. index(error%message, path) > 0, words//': '//error%message)
   end subroutine expect_refusal

   !> The same for the problem with this line among its nodes.
   subroutine expect_refusal_with(node, step, increment, code, words)
      integer, intent(in) :: step, increment, code
      character(len=*), intent(in) :: node, words
      type(problem_t) :: problem

      call new_problem(node, problem)
      call expect_refusal(problem, step, increment, code, words)
   end subroutine expect_refusal_with

   !> To the last bit, the sign of zero too.
   pure logical function same(a, b)
      real(dp), intent(in) :: a(:), b(:)

      same = size(a) == size(b)
      if (same) same = all(transfer(a, [0_int64]) == transfer(b, [0_int64]))
   end function same

   subroutine remove()
      integer :: unit

      open (newunit=unit, file=path)
      close (unit, status='delete')
   end subroutine remove

   subroutine check(holds, what)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: what

      if (holds) return
      failures = failures + 1
      print '(2a)', 'FAILED: ', what
   end subroutine check

   subroutine stop_on(error)
      type(error_t), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      print '(a)', error%text()
      error stop 1
   end subroutine stop_on

   !> The same numbers for the same increment.
   subroutine start_random_numbers(increment)
      integer, intent(in) :: increment
      integer :: n

      call random_seed(size=n)
      call random_seed(put=spread(20260 + increment, 1, n))
   end subroutine start_random_numbers

end program test_restart_file
