!> What a restart file holds: everything that the next increment depends on.
module litz_restart_content
   use litz_kinds, only: dp
   use litz_contact_points, only: contact_point_t
   use litz_errors, only: error_t, fail, exit_files
   use litz_fields, only: n_slots, field_temperature, slots_of_fields
   use litz_problem, only: problem_t
   use litz_quantities, only: quantity_table_t
   use litz_restart_arrays, only: restart_arrays_t, reading
   use litz_restart_points, only: point_table, points_of_table
   use litz_result_quantities, only: wire_quantity_t, list_wire_quantities, contact_table, contacts_of_table, &
      surface_contact_table, surface_contacts_of_table
   use litz_run_warnings, only: run_warnings_t
   use litz_contact_history, only: left_dents_t, dent_memory_t
   use litz_state, only: state_t, contact_t, energies_t
   use litz_surface_dents, only: n_of_dents
   use litz_surface_memory, only: n_remembered
   use litz_step_control, only: course_t
   implicit none
   private
   public :: exchange_all

contains

   !> Everything that the next increment depends on; a line for each array, the same for all that is done with it.
   subroutine exchange_all(arrays, problem, course, error)
      type(restart_arrays_t), intent(inout) :: arrays
      type(problem_t), intent(inout) :: problem
      type(course_t), intent(inout) :: course
      type(error_t), allocatable, intent(inout) :: error
      integer, allocatable :: slots(:)

      arrays%next = 0
      allocate (slots, source=slots_of_fields(problem%model%has_field))
      call exchange_course(arrays, problem, course, error)
      associate (state => problem%state, loading => problem%loading, contact => problem%contact)
         call exchange_wires(arrays, state, error)
         call arrays%array('rotation_matrix', state%rotation, error)
         call exchange_slots(arrays, 'damping', state%damping, slots, error)
         if (state%has_field(field_temperature)) then
            call arrays%array('temperature_before', state%temperature_before, error)
            call arrays%array('temperature_earlier', state%temperature_earlier, error)
            call arrays%array('mechanical_temperature', state%mechanical_temperature, error)
         end if
         call exchange_marks(arrays, 'loading_fixed', loading%fixed, slots, error)
         call exchange_slots(arrays, 'loading_start_value', loading%start_value, slots, error)
         call exchange_slots(arrays, 'loading_start_load', loading%start_load, slots, error)
         call exchange_slots(arrays, 'loading_value', loading%value, slots, error)
         call exchange_slots(arrays, 'loading_load', loading%load, slots, error)
         call exchange_slots(arrays, 'loading_converged_value', loading%converged_value, slots, error)
         call arrays%array('candidates', contact%candidates, 3, error)
         call exchange_coupled(arrays, contact%coupled, error)
         call arrays%array('positions_at_search', contact%x_collected, error, 3)
         call exchange_left_dents(arrays, contact%left_dents, error)
         if (arrays%mode == reading .and. .not. allocated(error)) then
            if (.not. contact%present) deallocate (contact%x_collected)
         end if
         call exchange_points(arrays, 'points', contact%converged, error)
         call exchange_points(arrays, 'line_points', contact%converged_line_points, error)
         call exchange_contacts(arrays, state%contacts, error)
         call exchange_surfaces(arrays, state, error)
      end associate
      call exchange_warnings(arrays, problem%warnings, error)
   end subroutine exchange_all

   !> Which candidates the pattern of the matrix couples: the order of elimination, and with it round-off, follows it.
   subroutine exchange_coupled(arrays, coupled, error)
      type(restart_arrays_t), intent(inout) :: arrays
      !> (n_candidates)
      logical, allocatable, intent(inout) :: coupled(:)
      type(error_t), allocatable, intent(inout) :: error
      logical, allocatable :: marks(:, :)

      marks = reshape(coupled, [1, size(coupled)])
      call arrays%array('coupled', marks, 1, error)
      if (.not. allocated(error)) coupled = marks(1, :)
   end subroutine exchange_coupled

   !> Values of the fields of the model.
   subroutine exchange_slots(arrays, name, values, slots, error)
      type(restart_arrays_t), intent(inout) :: arrays
      !> Name of the dataset
      character(len=*), intent(in) :: name
      !> (n_slots, n_nodes); zero in other slots
      real(dp), allocatable, intent(inout) :: values(:, :)
      !> Those of the fields of the model (n)
      integer, intent(in) :: slots(:)
      type(error_t), allocatable, intent(inout) :: error
      real(dp), allocatable :: rows(:, :)

      if (allocated(values)) rows = values(slots, :)
      call arrays%array(name, rows, error, size(slots))
      if (allocated(error) .or. arrays%mode /= reading) return
      if (allocated(values)) deallocate (values)
      allocate (values(n_slots, size(rows, 2)), source=0.0_dp)
      values(slots, :) = rows
   end subroutine exchange_slots

   !> The same of truth values.
   subroutine exchange_marks(arrays, name, marks, slots, error)
      type(restart_arrays_t), intent(inout) :: arrays
      !> Name of the dataset
      character(len=*), intent(in) :: name
      !> (n_slots, n_nodes); .false. in other slots
      logical, allocatable, intent(inout) :: marks(:, :)
      !> Those of the fields of the model (n)
      integer, intent(in) :: slots(:)
      type(error_t), allocatable, intent(inout) :: error
      logical, allocatable :: rows(:, :)

      if (allocated(marks)) rows = marks(slots, :)
      call arrays%array(name, rows, size(slots), error)
      if (allocated(error) .or. arrays%mode /= reading) return
      if (allocated(marks)) deallocate (marks)
      allocate (marks(n_slots, size(rows, 2)), source=.false.)
      marks(slots, :) = rows
   end subroutine exchange_marks

   !> What results show of nodes and elements.
   subroutine exchange_wires(arrays, state, error)
      type(restart_arrays_t), intent(inout) :: arrays
      type(state_t), intent(inout), target :: state
      type(error_t), allocatable, intent(inout) :: error
      type(wire_quantity_t), allocatable :: list(:)
      real(dp), allocatable :: values(:, :)
      logical :: has_line_loads, has_section_results
      integer :: i

      ! what output asks for, and steps to come have, may be another in the run that goes on
      has_line_loads = state%has_line_loads
      state%has_line_loads = .false.
      has_section_results = state%has_section_results
      state%has_section_results = .false.
      call list_wire_quantities(state, list)
      state%has_line_loads = has_line_loads
      state%has_section_results = has_section_results
      call exchange_asked(arrays, 'force_on_length', state%has_line_loads, state%line_load, error)
      call exchange_asked(arrays, 'section_ends', state%has_section_results, state%section_ends, error)
      call exchange_asked(arrays, 'section_strains', state%has_section_results, state%section_strains, error)
      do i = 1, size(list)
         values = list(i)%values
         call arrays%array(trim(list(i)%name), values, error)
         if (allocated(error) .or. arrays%mode /= reading) cycle
         ! a file of another mesh is refused once its step is known, too
         arrays%fits_mesh = arrays%fits_mesh .and. size(values, 2) == size(list(i)%values, 2)
         if (arrays%fits_mesh) list(i)%values = values
      end do
   end subroutine exchange_wires

   !> What results show of elements where the run that writes asks for it; one that goes on may ask for something else.
   subroutine exchange_asked(arrays, name, is_asked, values, error)
      type(restart_arrays_t), intent(inout) :: arrays
      !> Name of the dataset
      character(len=*), intent(in) :: name
      !> It has rows
      logical, intent(in) :: is_asked
      !> (components, n_elements)
      real(dp), allocatable, intent(inout) :: values(:, :)
      type(error_t), allocatable, intent(inout) :: error
      real(dp), allocatable :: rows(:, :)

      rows = values(:, :merge(size(values, 2), 0, is_asked))
      call arrays%array(name, rows, error)
      if (allocated(error) .or. arrays%mode /= reading) return
      if (size(rows, 2) == size(values, 2)) values = rows
   end subroutine exchange_asked

   !> Where the run stands: numbers of the state and of the control of increments.
   subroutine exchange_course(arrays, problem, course, error)
      type(restart_arrays_t), intent(inout) :: arrays
      type(problem_t), intent(inout) :: problem
      type(course_t), intent(inout) :: course
      type(error_t), allocatable, intent(inout) :: error
      integer, allocatable :: numbers(:, :)
      real(dp), allocatable :: reals(:), energies(:)

      associate (state => problem%state, contact => problem%contact, control => course%control)
         numbers = reshape([state%step, state%increment], [2, 1])
         call arrays%array('increment', numbers, 2, error)
         if (.not. allocated(error)) then
            state%step = numbers(1, 1)
            state%increment = numbers(2, 1)
         end if
         numbers = reshape([state%iterations, control%quick, contact%last_id], [3, 1])
         call arrays%array('counts', numbers, 3, error)
         reals = [state%time, state%step_time, state%time_increment, state%time_increment_before, course%start_time, &
            control%wanted, state%audit]
         call arrays%array('times', reals, error)
         energies = [state%energies%work, state%energies%strain, state%energies%contact, state%energies%friction, &
            state%energies%yielding, state%energies%stabilization]
         if (state%has_field(field_temperature)) energies = [energies, state%energies%thermal]
         call arrays%array('energies', energies, error)
         call arrays%array('clearance', contact%clearance, error)
         if (allocated(error) .or. arrays%mode /= reading) return
         state%iterations = numbers(1, 1)
         control%quick = numbers(2, 1)
         contact%last_id = numbers(3, 1)
         state%time = reals(1)
         state%step_time = reals(2)
         state%time_increment = reals(3)
         state%time_increment_before = reals(4)
         course%start_time = reals(5)
         control%wanted = reals(6)
         state%audit = reals(7:)
         state%energies = energies_t(energies(1), energies(2), energies(3), energies(4), energies(5), energies(6))
         if (state%has_field(field_temperature)) state%energies%thermal = energies(7)
         contact%converged_clearance = contact%clearance
         if (allocated(problem%left_over)) deallocate (problem%left_over)
      end associate
   end subroutine exchange_course

   !> The warnings so far, as the character codes of their text.
   subroutine exchange_warnings(arrays, warnings, error)
      type(restart_arrays_t), intent(inout) :: arrays
      type(run_warnings_t), intent(inout) :: warnings
      type(error_t), allocatable, intent(inout) :: error
      integer, allocatable :: numbers(:, :)
      logical :: ok

      allocate (numbers, source=warnings%to_numbers())
      call arrays%array('warnings', numbers, 1, error)
      if (allocated(error) .or. arrays%mode /= reading) return
      call warnings%from_numbers(numbers, ok)
      if (.not. ok) error = fail(exit_files, 'its dataset warnings is not what was written: the file is damaged')
   end subroutine exchange_warnings

   !> What the next increment needs of crossings or of the points of line contacts.
   subroutine exchange_points(arrays, name, points, error)
      type(restart_arrays_t), intent(inout) :: arrays
      !> Beginning of the names of the datasets
      character(len=*), intent(in) :: name
      type(contact_point_t), allocatable, intent(inout) :: points(:)
      type(error_t), allocatable, intent(inout) :: error
      type(quantity_table_t) :: rows

      rows = point_table(points)
      call exchange_table(arrays, name, rows, error)
      if (.not. allocated(error) .and. arrays%mode == reading) call points_of_table(rows, points)
   end subroutine exchange_points

   !> The dents of contacts that have parted.
   subroutine exchange_left_dents(arrays, left, error)
      type(restart_arrays_t), intent(inout) :: arrays
      type(left_dents_t), intent(inout) :: left
      type(error_t), allocatable, intent(inout) :: error
      type(dent_memory_t) :: dent
      real(dp), allocatable :: numbers(:, :)
      integer :: i

      if (.not. allocated(left%dents)) allocate (left%wires(3, 0), left%dents(0))
      allocate (numbers(8, size(left%dents)))
      do i = 1, size(left%dents)
         dent = left%dents(i)
         numbers(:, i) = [dent%force, dent%arc, dent%overlap, dent%left, dent%felt, &
            dent%dissipation, dent%section_share]
      end do
      call arrays%array('left_dent_wires', left%wires, 3, error)
      call arrays%array('left_dents', numbers, error, 8)
      if (allocated(error) .or. arrays%mode /= reading) return
      left%dents = [(dent_memory_t(numbers(1, i), numbers(2:3, i), numbers(4, i), numbers(5, i), numbers(6, i), &
         numbers(7, i), numbers(8, i)), i=1, size(numbers, 2))]
   end subroutine exchange_left_dents

   !> What results show of the contacts.
   subroutine exchange_contacts(arrays, contacts, error)
      type(restart_arrays_t), intent(inout) :: arrays
      type(contact_t), allocatable, intent(inout) :: contacts(:)
      type(error_t), allocatable, intent(inout) :: error
      type(quantity_table_t) :: rows

      rows = contact_table(contacts)
      call exchange_table(arrays, 'contacts', rows, error)
      if (.not. allocated(error) .and. arrays%mode == reading) call contacts_of_table(rows, contacts)
   end subroutine exchange_contacts

   !> The same of contacts with rigid surfaces.
   subroutine exchange_surfaces(arrays, state, error)
      type(restart_arrays_t), intent(inout) :: arrays
      type(state_t), intent(inout) :: state
      type(error_t), allocatable, intent(inout) :: error
      type(quantity_table_t) :: rows

      rows = surface_contact_table(state%surface_contacts)
      call exchange_table(arrays, 'surface_contacts', rows, error)
      call arrays%array('surface_radius', state%surface_radius, error)
      call arrays%array('surface_memory', state%surface_memory, error, n_remembered)
      call arrays%array('surface_dents', state%surface_dents, error, n_of_dents)
      if (allocated(error) .or. arrays%mode /= reading) return
      call surface_contacts_of_table(rows, state%surface_contacts)
   end subroutine exchange_surfaces

   !> A table as two datasets, whose columns have names.
   subroutine exchange_table(arrays, name, table, error)
      type(restart_arrays_t), intent(inout) :: arrays
      !> Beginning of the names of the datasets
      character(len=*), intent(in) :: name
      type(quantity_table_t), intent(inout) :: table
      type(error_t), allocatable, intent(inout) :: error

      call arrays%array(name//'_reals', table%reals, error)
      call arrays%columns(name//'_reals', table%quantities, .false., error)
      call arrays%array(name//'_integers', table%integers, size(table%integers, 1), error)
      call arrays%columns(name//'_integers', table%quantities, .true., error)
   end subroutine exchange_table

end module litz_restart_content
