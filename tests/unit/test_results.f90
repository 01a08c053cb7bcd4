!> Writes the result files of a made-up run: two crossed wires, three increments with 0, 2 and 1 contacts.
!>
!> Arguments: the output directory (default: results_of_test), and one of
!>    killed    leave without closing the files
!>    waiting   wait for a line of input before closing them
!>    seldom    write fields at every second increment only
!>    limited   take a limit on the size of files for a full disk, not for a signal to end by
!> The values are simple functions of node, element and increment, which test_results.py reads back.
program test_results
   use litz_kinds, only: dp
   use litz_communicator, only: one_process_t
   use litz_errors, only: error_t
   use litz_fields, only: n_slots
   use litz_friction_law, only: friction_slip
   use litz_element_types, only: element_b31
   use litz_unit_labels, only: si_labels
   use litz_model, only: model_t, section_t, material_t, named_set_t, step_t, output_request_t, &
      request_node, request_element, request_electrode
   use litz_state, only: state_t, contact_t
   use litz_output_files, only: make_directory
   use litz_reports, only: iteration_report_t, increment_report_t
   use litz_results, only: results_t
   implicit none

   character(len=*), parameter :: nl = new_line('a')
   type(model_t) :: model
   type(state_t) :: state
   type(results_t) :: results
   type(error_t), allocatable :: error
   character(len=512) :: directory, how
   integer :: increment

   directory = 'results_of_test'
   how = ''
   if (command_argument_count() >= 1) call get_command_argument(1, directory)
   if (command_argument_count() >= 2) call get_command_argument(2, how)

   if (how == 'limited') call ignore_file_size_signal()
   call make_crossed_wires(model)
   if (how == 'seldom') model%steps(1)%output_frequency = 2
   call make_directory(trim(directory), error)
   call stop_on(error)
   call results%open(one_process_t(), model, trim(directory)//'/crossed', state, error)
   call stop_on(error)
   do increment = 1, 3
      call make_state(model, increment, state)
      call write_iterations(increment)
      call results%write_increment(model, state, state%step == 0, error)
      call stop_on(error)
      call write_status(increment, error)
      call stop_on(error)
   end do
   if (how == 'killed') call leave_at_once()
   if (how == 'waiting') read (*, *)
   call results%close(.true., error)
   call stop_on(error)

contains

   !> Five nodes and four elements with gappy numbers: a wire along x, and one along y above it.
   subroutine make_crossed_wires(model)
      type(model_t), intent(out) :: model
      integer :: i

      model%heading = 'Two crossed wires'
      model%units = si_labels
      model%deck_text = '*HEADING'//nl//'Two crossed wires, ⌀ 2 mm'//nl
      model%n_nodes = 6
      model%n_elements = 4
      model%node_id = [(10*i, i=1, 6)]
      model%x = reshape([-1.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 0.0_dp, 1.0_dp, 0.0_dp, 0.0_dp, &
         0.0_dp, -1.0_dp, 0.02_dp, 0.0_dp, 0.0_dp, 0.02_dp, 0.0_dp, 1.0_dp, 0.02_dp], [3, 6])
      model%element_id = [(100 + i, i=1, 4)]
      model%element_type = [(element_b31, i=1, 4)]
      model%connectivity = reshape([1, 2, 2, 3, 4, 5, 5, 6], [2, 4])
      model%element_section = [1, 1, 2, 2]
      allocate (model%materials(1))
      model%materials(1)%conductivity = 5.0e7_dp
      allocate (model%sections(2))
      model%sections%material = 1
      model%sections%area = 4.0e-4_dp
      model%sections(1)%contact_radius = 0.01_dp
      allocate (model%node_sets(4), model%element_sets(1))
      call name_set(model%node_sets(1), 'LEFT', [1])
      call name_set(model%node_sets(2), 'BACK', [6])
      call name_set(model%node_sets(3), 'ENDS', [1, 3])
      call name_set(model%node_sets(4), 'LOOSE', [5])
      call name_set(model%element_sets(1), 'LOWER', [1, 2])
      allocate (model%steps(2), model%surfaces(0), model%surface_pairs(0))
      call ask_for_history(model%steps)
   end subroutine make_crossed_wires

   !> A structure constructor would do, but gfortran 12 forgets what it allocates in one.
   subroutine name_set(set, name, members)
      type(named_set_t), intent(out) :: set
      character(len=*), intent(in) :: name
      integer, intent(in) :: members(:)

      set%name = name
      set%members = members
   end subroutine name_set

   subroutine write_status(increment, error)
      integer, intent(in) :: increment
      type(error_t), allocatable, intent(out) :: error
      type(increment_report_t) :: report

      report%step = 1
      report%increment = increment
      report%attempts = merge(2, 1, increment == 2)
      report%iterations = 3
      report%time = state%time
      report%step_time = state%step_time
      report%time_increment = state%time_increment
      report%residual(:3) = [1.0e-9_dp, 1.0e-12_dp, 0.0_dp]
      report%negative_pivots = 0
      report%contacts = size(state%contacts)
      report%remark = ''
      if (increment == 2) report%remark = 'cut back: residual grew'
      call results%write_status(model, report, error)
   end subroutine write_status

   !> The second step asks for other columns than the first; the history holds both.
   subroutine ask_for_history(steps)
      type(step_t), intent(inout) :: steps(:)
      type(output_request_t) :: ends, totals, elements, electrodes, open_circuit

      ends = output_request_t(request_node, 3, 0, [character(len=8) :: 'U', 'RF'], .false.)
      totals = output_request_t(request_node, 3, 0, [character(len=8) :: 'RF', 'U'], .true.)
      elements = output_request_t(request_element, 1, 0, [character(len=8) :: 'SF', 'EPG'], .false.)
      electrodes = output_request_t(request_electrode, 1, 2, [character(len=8) ::], .false.)
      open_circuit = output_request_t(request_electrode, 4, 2, [character(len=8) ::], .false.)
      steps%total = 0.75_dp
      allocate (steps(1)%requests, source=[ends, totals])
      allocate (steps(2)%requests, source=[ends, elements, electrodes, open_circuit])
   end subroutine ask_for_history

   subroutine make_state(model, increment, state)
      type(model_t), intent(in) :: model
      integer, intent(in) :: increment
      type(state_t), intent(out) :: state
      integer :: i, j, n

      n = model%n_nodes
      state%step = 1
      state%increment = increment
      state%iterations = 3
      state%time_increment = 0.25_dp
      state%time = increment*0.25_dp
      state%step_time = state%time
      state%ends_step = increment == 3
      state%has_field = model%has_field
      allocate (state%value(n_slots, n), state%reaction(n_slots, n), state%load(n_slots, n))
      state%value(1:3, :) = increment*1.0e-3_dp*reshape([((i + 10*j, i=1, 3), j=1, n)], [3, n])
      state%value(4:6, :) = increment*1.0e-2_dp*reshape([((i + 10*j, i=1, 3), j=1, n)], [3, n])
      state%value(7, :) = [(increment*real(j, dp), j=1, n)]
      state%reaction(1:6, :) = increment*reshape([((i + 10.0_dp*j, i=1, 6), j=1, n)], [6, n])
      state%load(1:6, :) = -state%reaction(1:6, :)
      state%reaction(7, :) = [(increment*2.0_dp*j, j=1, n)]
      state%load(7, :) = [(0.0_dp, j=1, n)]
      ! what enters at the fifth node leaves it again but for round-off
      state%load(7, 5) = -state%reaction(7, 5) + 1.0e-14_dp
      state%section_forces = increment*reshape([((i + 10.0_dp*j, i=1, 6), j=1, 4)], [6, 4])
      state%has_line_loads = .false.
      state%has_section_results = .false.
      state%has_superconductors = .false.
      state%element_current = [(increment*3.0_dp*j, j=1, 4)]
      state%current_density = state%element_current/4.0e-4_dp
      state%joule_heat = [(increment*4.0_dp*j, j=1, 4)]
      state%has_potential = [(1.0_dp, j=1, n)]
      state%metal = spread([2.0e-8_dp, increment*1.0e-3_dp], 2, 4)
      state%contacts = made_up_contacts(increment)
   end subroutine make_state

   !> None, then contacts 1 and 2, then contact 2 alone, which has slid to another element.
   function made_up_contacts(increment) result(contacts)
      integer, intent(in) :: increment
      type(contact_t), allocatable :: contacts(:)
      type(contact_t) :: contact

      contact = contact_t(id=1, element_bar=1, element=3, xi_bar=0.5_dp, xi=-0.5_dp, pair=1, angle=1.5_dp, &
         gap=-1.0e-6_dp, &
         normal=[0.0_dp, 0.0_dp, -1.0_dp], point_bar=[0.0_dp, 0.0_dp, 0.0_dp], point=[0.0_dp, 0.0_dp, 0.02_dp], &
         force=10.0_dp*increment, semi_major=2.0e-5_dp, semi_minor=1.0e-5_dp, resistance=1.0e-3_dp, current=5.0_dp, &
         voltage_gap=5.0e-3_dp, joule_heat=2.5e-2_dp, friction_status=friction_slip, &
         traction=[3.0_dp, 0.0_dp, 0.0_dp], slip_path=1.0e-4_dp*increment, dissipation=3.0e-4_dp*increment)
      allocate (contacts(0))
      if (increment == 1) return
      if (increment == 2) contacts = [contact]
      contact%id = 2
      contact%element = merge(3, 4, increment == 2)
      contacts = [contacts, contact]
   end function made_up_contacts

   subroutine write_iterations(increment)
      integer, intent(in) :: increment
      type(iteration_report_t) :: report
      integer :: i

      do i = 1, 3
         report%step = 1
         report%increment = increment
         report%iteration = i
         report%residual(:3) = 10.0_dp**(-2**i)*[1.0_dp, 0.1_dp, 0.01_dp]
         report%allowed(:3) = [1.0e-7_dp, 1.0e-8_dp, 1.0e-9_dp]
         report%correction = report%residual
         report%correction_node(:3) = [10*i, 10*i + 10, 0]
         report%contacts_active = increment - 1
         report%penetration = 1.0e-6_dp
         call results%write_iteration(model, report, error)
         call stop_on(error)
      end do
   end subroutine write_iterations

   !> Ends the program as a signal would: nothing is flushed or closed.
   subroutine leave_at_once()
      interface
         subroutine c_exit(status) bind(c, name='_exit')
            use, intrinsic :: iso_c_binding, only: c_int
            implicit none
            integer(c_int), value :: status
         end subroutine c_exit
      end interface

      call c_exit(0)
   end subroutine leave_at_once

   !> In place of the handler that the library of gfortran sets up.
   subroutine ignore_file_size_signal()
      use, intrinsic :: iso_c_binding, only: c_int, c_intptr_t
      integer(c_int), parameter :: sigxfsz = 25
      integer(c_intptr_t), parameter :: sig_ign = 1
      integer(c_intptr_t) :: before
      interface
         integer(c_intptr_t) function c_signal(number, handler) bind(c, name='signal')
            use, intrinsic :: iso_c_binding, only: c_int, c_intptr_t
            implicit none
            integer(c_int), value :: number
            integer(c_intptr_t), value :: handler
         end function c_signal
      end interface

      before = c_signal(sigxfsz, sig_ign)
   end subroutine ignore_file_size_signal

   subroutine stop_on(error)
      type(error_t), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      write (*, '(a)') error%text()
      error stop
   end subroutine stop_on

end program test_results
