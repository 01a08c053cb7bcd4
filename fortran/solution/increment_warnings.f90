!> What is to be warned of at the start of a run, and in an increment that has converged.
module litz_increment_warnings
   use litz_fields, only: fields, n_fields, first_slot, last_slot, field_displacement, field_potential, &
      temperature_slots
   use litz_kinds, only: dp, pi
   use litz_audit, only: audit_t, scales_t, penetration, describe_contact, allowed_imbalance, vanishing
   use litz_coarse_curves, only: describe_coarse_curves
   use litz_contact_net, only: allowed_penetration
   use litz_convergence, only: measure_scales
   use litz_energy_warnings, only: add_energy_balance
   use litz_errors, only: error_list_t
   use litz_model, only: model_t, request_electrode
   use litz_outcome, only: outcome_t
   use litz_line_contact, only: serves_lines
   use litz_parallel_wires, only: shallow_angle, parallel_warning
   use litz_run_warnings, only: run_warnings_t
   use litz_shared_warnings, only: shared_warnings_t
   use litz_state, only: contact_t, surface_contact_t
   use litz_stored_heat, only: changes_by_heat
   use litz_step_end, only: reaches_end, fastest_change
   use litz_problem, only: problem_t
   use litz_text, only: to_text
   use litz_tight_bends, only: describe_tight_bends
   use litz_unpaired_overlaps, only: describe_unpaired_overlaps
   use litz_yielding_spot, only: wide_spot
   implicit none
   private
   public :: add_deck_warnings, add_start_warnings, add_increment_warnings

   !> Length of elements over the radius up to which the pressure along a line is smooth: 3 along the axis about which
   !> wires are laid at up to 30 degrees
   real(dp), parameter :: longest_smooth = 3.5_dp
   !> Nodes lie opposite each other to this part of half an element
   real(dp), parameter :: opposite = 0.2_dp
   !> Part of the way between places up to which a place beside a crossing stands for nothing that would vary
   real(dp), parameter :: least_length = 1.0e-3_dp
   !> Part of its width by which a contact may slide up the side of its dent in an increment
   real(dp), parameter :: longest_climb = 0.25_dp
   !> Largest error of an increment of backward Euler over its change, of a temperature that comes to rest:
   !> (1 - (1 + z) exp(-z))/z where it is largest, with z increments to the time constant
   real(dp), parameter :: largest_part = 0.3_dp
   !> Error over the temperature from absolute zero up to which a step of a single increment is not warned of
   real(dp), parameter :: least_share = 1.0e-3_dp
   !> Displacements of so many times the round-off of coordinates are lost in these
   real(dp), parameter :: lost_motion = 10.0_dp
   !> Flows of currents or heat up to so many times their round-off are none: no path leads where they could go
   real(dp), parameter :: no_flow = 10.0_dp
   integer, parameter :: slot = temperature_slots(1)

contains

   !> Those that reading the deck has shown to the user.
   subroutine add_deck_warnings(found, warnings)
      type(error_list_t), intent(in) :: found
      type(run_warnings_t), intent(inout) :: warnings
      integer :: i

      call warnings%set_place(0, 0, 0.0_dp)
      do i = 1, found%count
         call warnings%add(trim(found%items(i)%kind), found%items(i)%message, [found%items(i)%element])
      end do
      warnings%n_shown = warnings%n
   end subroutine add_deck_warnings

   !> Those of the reference configuration, with the candidates of it.
   subroutine add_start_warnings(problem)
      type(problem_t), intent(inout) :: problem
      character(len=:), allocatable :: text

      call problem%warnings%set_place(0, 0, 0.0_dp)
      text = parallel_warning(problem%model, problem%elements, problem%contact)
      if (len(text) > 0) call problem%warnings%add('side_by_side', text)
      call add_coarse_curves(problem, [contact_t ::])
      call add_tight_bends(problem)
      call add_unpaired_overlaps(problem, problem%model%x)
   end subroutine add_start_warnings

   !> Wires that may touch themselves, and are bent more tightly than they are thick.
   subroutine add_tight_bends(problem)
      type(problem_t), intent(inout) :: problem
      character(len=:), allocatable :: text

      if (.not. problem%contact%present) return
      text = describe_tight_bends(problem%model, problem%wires, problem%elements, problem%contact)
      if (len(text) > 0) call problem%warnings%add('tight_bend', text)
   end subroutine add_tight_bends

   !> Curves that are drawn as kinks, and lie along other wires or their own turns.
   subroutine add_coarse_curves(problem, contacts)
      type(problem_t), intent(inout) :: problem
      !> Of a state, or none at the start
      type(contact_t), intent(in) :: contacts(:)
      character(len=:), allocatable :: text

      if (.not. problem%contact%present) return
      text = describe_coarse_curves(problem%model, problem%elements, problem%contact, contacts)
      if (len(text) > 0) call problem%warnings%add('coarse_curve', text)
   end subroutine add_coarse_curves

   !> Overlapping wires that no contact pair names.
   subroutine add_unpaired_overlaps(problem, x)
      type(problem_t), intent(inout) :: problem
      !> Positions (3, n_nodes) [m]
      real(dp), intent(in) :: x(:, :)
      character(len=:), allocatable :: text

      text = describe_unpaired_overlaps(problem%model, problem%wires, problem%elements, problem%contact, x, &
         problem%state%rotation)
      if (len(text) > 0) call problem%warnings%add('unpaired_overlap', text)
   end subroutine add_unpaired_overlaps

   subroutine add_increment_warnings(problem, outcome, audit)
      type(problem_t), intent(inout) :: problem
      type(outcome_t), intent(in) :: outcome
      !> Without a finding: a run that a finding ends has an error in place of warnings
      type(audit_t), intent(in) :: audit
      type(shared_warnings_t) :: shared
      integer :: i

      if (len(audit%finding) > 0) return
      associate (state => problem%state, warnings => problem%warnings)
         if (state%increment > 1) then
            ! the first tangent of an increment is that of the state before
            call warnings%set_place(state%step, state%increment - 1, state%time - state%time_increment)
            call add_negative_pivots(outcome%negative_pivots_at_start, warnings)
         end if
         call warnings%set_place(state%step, state%increment, state%time)
         if (.not. outcome%only_start_factored) call add_negative_pivots(outcome%negative_pivots, warnings)
         call add_round_off(problem, outcome)
         call add_third_electrodes(problem)
         call add_not_steady(problem)
         call add_first_increment(problem)
         call add_energy_balance(problem)
         do i = 1, size(state%contacts)
            call add_contact(problem%model, state%contacts(i), shared)
         end do
         do i = 1, size(state%surface_contacts)
            call add_table_ends_on_surface(problem%model, state%surface_contacts(i), shared)
         end do
         call shared%report(warnings)
         call add_tight_bends(problem)
         call add_long_elements(problem)
         call add_coarse_curves(problem, state%contacts)
         call add_unpaired_overlaps(problem, problem%model%x &
            + state%value(first_slot(field_displacement):last_slot(field_displacement), :))
      end associate
   end subroutine add_increment_warnings

   subroutine add_negative_pivots(n, warnings)
      !> Of the tangent; -1: not known
      integer, intent(in) :: n
      type(run_warnings_t), intent(inout) :: warnings

      if (n > 0) call warnings%add('negative_pivots', &
         'the tangent has '//to_text(n)//' negative pivot'//trim(merge(' ', 's', n == 1))//': the equilibrium lies'// &
         ' beyond a critical load and may not be stable. A small bow or side load shows where wires give way, and'// &
         ' *CONTROLS, PARAMETERS=STABILIZE follows a snap', value=real(n, dp), unit='negative pivots')
   end subroutine add_negative_pivots

   !> A step that was to end in a steady state, and has come to its time before.
   subroutine add_not_steady(problem)
      type(problem_t), intent(inout) :: problem
      character(len=:), allocatable :: label
      real(dp) :: rate

      label = problem%model%units%after('K/s')
      associate (step => problem%model%steps(problem%state%step))
         if (.not. step%steady_rate > 0 .or. .not. reaches_end(step, problem%state%step_time)) return
         rate = fastest_change(problem)
         if (rate < step%steady_rate) return
         call problem%warnings%add('not_steady', 'the step has ended at its time, and a temperature still changes'// &
            ' by '//to_text(rate)//label//', where END=SS asks for less than '//to_text(step%steady_rate)//label, &
            value=rate, unit=trim(adjustl(label)))
      end associate
   end subroutine add_not_steady

   !> Nothing bounds the error of the first increment of a step over time: it shows in the second one, or there is none.
   subroutine add_first_increment(problem)
      type(problem_t), intent(inout) :: problem
      real(dp), dimension(problem%model%n_nodes, 2) :: change
      logical :: is_free(problem%model%n_nodes), is_alone
      real(dp) :: error, allowed
      character(len=:), allocatable :: label

      label = problem%model%units%after('K')
      associate (step => problem%model%steps(problem%state%step), state => problem%state)
         is_alone = state%increment == 1 .and. reaches_end(step, state%step_time)
         if (.not. step%transient .or. .not. (is_alone .or. state%increment == 2 .and. step%largest_error > 0)) return
         is_free = problem%equations%number(slot, :) > 0
         change = changes_by_heat(problem%model, problem%elements%length, reshape([state%value(slot, :), &
            state%temperature_before, state%temperature_earlier], [size(is_free), 3]))
         if (is_alone) then
            allowed = step%largest_error
            if (.not. allowed > 0) allowed = least_share*problem%processes%largest(maxval(abs(state%value(slot, :) &
               - problem%model%absolute_zero)))
            error = problem%processes%largest(maxval([0.0_dp, largest_part*abs(change(:, 1))], [.true., is_free]))
            if (error > allowed) call problem%warnings%add('first_increment', 'the step over time is a single'// &
               ' increment, which tells nothing of its error: temperatures that come to rest within it may be off'// &
               ' by 30 % of their change, '//to_text(error)//label//' of the largest one, those that change evenly'// &
               ' are exact; increments (first value of the procedure), or a small first one with ERROR=, tell', &
               value=error, unit=trim(adjustl(label)))
            return
         end if
         associate (h => state%time_increment, h1 => state%time_increment_before)
            ! h1^2/2 T'', by the rates at the end of either increment
            error = problem%processes%largest(maxval([0.0_dp, min(largest_part*abs(change(:, 2)), h1**2/(2*h) &
               *(h1 + 2*h)/(h1 + h)*abs(change(:, 1)/h - change(:, 2)/h1))], [.true., is_free]))
         end associate
         if (error > step%largest_error) call problem%warnings%add('first_increment', 'the first increment has'// &
            ' added an error of about '//to_text(error)//label//', where ERROR='//to_text(step%largest_error)// &
            ' is allowed: it should be smaller (first value of the procedure)', value=error, &
            unit=trim(adjustl(label)))
      end associate
   end subroutine add_first_increment

   !> Residuals above the tolerance of their field that were accepted because round-off leaves no less. A field that has
   !> nothing but round-off has no residual to speak of.
   subroutine add_round_off(problem, outcome)
      type(problem_t), intent(inout) :: problem
      type(outcome_t), intent(in) :: outcome
      type(scales_t) :: scales
      real(dp) :: tolerance, least
      integer :: field

      scales = measure_scales(problem)
      tolerance = max(allowed_imbalance, problem%model%steps(problem%state%step)%controls%r_n)
      do field = 1, n_fields
         least = problem%processes%largest(maxval(scales%round_off(field, :)))
         if (fields(field)%is_level) least = no_flow*least
         if (scales%reference(field) <= max(vanishing, least)) then
            call add_lost(problem, field, scales)
            cycle
         end if
         associate (share => outcome%last%residual(field)/scales%reference(field))
            if (share > tolerance) call problem%warnings%add('round_off', 'accepted at the limit of round-off: the '// &
               trim(fields(field)%flux_in_words)//' residual is '//to_text(100*share)//' % of the largest '// &
               trim(fields(field)%flux_in_words), &
               value=100*share, unit='%')
         end associate
      end do
   end subroutine add_round_off

   !> Loads, or prescribed displacements, that vanish in the round-off of forces.
   subroutine add_lost(problem, field, scales)
      type(problem_t), intent(inout) :: problem
      !> Its forces are smaller than their round-off
      integer, intent(in) :: field
      type(scales_t), intent(in) :: scales
      character(len=:), allocatable :: what
      real(dp) :: load, moved, extent
      integer :: i

      associate (loading => problem%loading, first => first_slot(field), last => last_slot(field), &
         step => problem%model%steps(problem%state%step), units => problem%model%units, named => fields(field))
         load = problem%processes%largest(maxval(abs(loading%load(first:last, :))))
         extent = problem%processes%largest(maxval(abs(problem%model%x)))
         moved = 0
         if (field == field_displacement) then
            if (problem%processes%any(any([(any(abs(step%element_loads(i)%value) > 0), &
               i=1, size(step%element_loads))]))) load = max(load, scales%reference(field))
            moved = problem%processes%largest(maxval(abs(loading%value(first:last, :)), &
               mask=loading%prescribed(first:last, :)))
            ! a value that passes zero, or has come back to it, is round-off of its way there
            if (loading%largest_motion > lost_motion*epsilon(1.0_dp)*extent) moved = 0
         end if
         if (load > vanishing) then
            what = 'loads of at most '//to_text(load)//units%after(trim(named%flux_unit))
         else if (moved > 0) then
            what = 'prescribed displacements of at most '//to_text(moved)//units%after('m')
         else
            return
         end if
         call problem%warnings%add('round_off', what//' are lost in the round-off of the '// &
            trim(named%flux_in_words)//' at a node, '// &
            to_text(problem%processes%largest(maxval(scales%round_off(field, :))))// &
            units%after(trim(named%flux_unit))//': motions are those of linear solutions, and reactions, forces in'// &
            ' wires and contacts have no digits', value=100.0_dp, unit='%')
      end associate
   end subroutine add_lost

   !> A contact where a point is a poor description, or where the wires overlap too much.
   subroutine add_contact(model, contact, warnings)
      type(model_t), intent(in) :: model
      type(contact_t), intent(in) :: contact
      type(shared_warnings_t), intent(inout) :: warnings
      integer :: elements(2)
      real(dp) :: angle

      elements = model%element_id([contact%element_bar, contact%element])
      if (sin(contact%angle) < sin(shallow_angle) .and. .not. serves_lines(model, contact%pair)) then
         angle = min(contact%angle, pi - contact%angle)*180/pi
         call warnings%add('shallow_angle', describe_contact(model, contact)//' crosses at '//to_text(angle)// &
            ' degrees, below 10, where spots are long and point contact is less accurate', elements, angle, 'degrees', &
            smaller_is_worse=.true.)
      end if
      call add_table_ends(model, contact, elements, warnings)
      call add_hot_spot(model, contact, elements, warnings)
      call add_dent(model, contact, elements, warnings)
      if (penetration(model, contact) <= allowed_penetration) return
      call warnings%add('unlimited_penetration', describe_contact(model, contact)//' overlaps by '// &
         to_text(100*penetration(model, contact))//' % of the smaller radius, which PENETRATION=UNLIMITED'// &
         ' allows; the laws of contact are for less than '//to_text(100*allowed_penetration)//' %', elements, &
         100*penetration(model, contact), '% of the radius')
   end subroutine add_contact

   !> A spot whose metal softens or melts.
   subroutine add_hot_spot(model, contact, elements, warnings)
      type(model_t), intent(in) :: model
      type(contact_t), intent(in) :: contact
      !> The user's numbers of its elements
      integer, intent(in) :: elements(2)
      type(shared_warnings_t), intent(inout) :: warnings
      character(len=:), allocatable :: change

      associate (law => model%interactions(model%contact_pairs(contact%pair)%interaction)%heat)
         change = ''
         if (law%has_softening .and. contact%temperature_max > law%softening) change = 'softens above '// &
            to_text(law%softening)
         if (law%has_melting .and. contact%temperature_max > law%melting) change = 'melts above '//to_text(law%melting)
      end associate
      if (len(change) > 0) call warnings%add('hot_spot', describe_contact(model, contact)//' is at '// &
         to_text(contact%temperature_max)//model%units%after('K')//' in its spot, whose metal '//change, &
         elements, contact%temperature_max, model%units%label('K'))
   end subroutine add_hot_spot

   !> A spot of metal that yields which is wide for its wires, or a contact that has jumped up the side of its dent.
   subroutine add_dent(model, contact, elements, warnings)
      type(model_t), intent(in) :: model
      type(contact_t), intent(in) :: contact
      !> The user's numbers of its elements
      integer, intent(in) :: elements(2)
      type(shared_warnings_t), intent(inout) :: warnings

      if (contact%spot_share > wide_spot) call warnings%add('wide_spot', describe_contact(model, contact)//' has'// &
         ' yielded to a spot with the area of a circle of '//to_text(contact%spot_share)//' times the radius of the'// &
         ' thinner wire; beyond '//to_text(wide_spot)//' the metal around it gives way, and the hardness falls'// &
         ' (by 15 % there)', elements, contact%spot_share, 'radii')
      if (contact%climbed > longest_climb) call warnings%add('left_dent', describe_contact(model, contact)//' has'// &
         ' slid up the side of its dent by '//to_text(contact%climbed)//' of the width of the dent in one'// &
         ' increment: its force jumps; increments in which it slides by less than '//to_text(longest_climb)// &
         ' follow it', elements, contact%climbed, 'widths')
   end subroutine add_dent

   !> Elements too long for the pressure along a line to be smooth, where their nodes do not lie opposite those of the
   !> other wire: the longest.
   subroutine add_long_elements(problem)
      type(problem_t), intent(inout) :: problem
      real(dp) :: longest, relative
      integer :: i, worst

      worst = 0
      longest = longest_smooth
      do i = 1, size(problem%state%contacts)
         associate (contact => problem%state%contacts(i), elements => problem%elements)
            if (.not. contact%length > least_length*contact%spacing) cycle
            ! opposite nodes: places and feet lie in the same parts of their elements
            if (abs(abs(contact%xi) - abs(contact%xi_bar)) < opposite) cycle
            relative = maxval(elements%length([contact%element_bar, contact%element])/elements%radius( &
               [contact%element_bar, contact%element]))
            if (.not. relative > longest) cycle
            longest = relative
            worst = i
         end associate
      end do
      if (worst > 0) call problem%warnings%add('long_elements', describe_contact(problem%model, &
         problem%state%contacts(worst))//' is a place of a contact along a line, with elements of up to '// &
         to_text(longest)//' radii and nodes that do not lie opposite each other: the pressure varies along such'// &
         ' elements, although forces and deflections are right; it is smooth with elements of up to 3 radii', &
         value=longest, unit='radii')
   end subroutine add_long_elements

   !> A contact with a force for which a table of its laws has no value.
   subroutine add_table_ends(model, contact, elements, warnings)
      type(model_t), intent(in) :: model
      type(contact_t), intent(in) :: contact
      !> The user's numbers of its elements
      integer, intent(in) :: elements(2)
      type(shared_warnings_t), intent(inout) :: warnings

      ! no force: the end of a line beside it
      if (.not. contact%force > 0) return
      associate (law => model%interactions(model%contact_pairs(contact%pair)%interaction))
         if (law%spot%has_table .and. contact%resistance <= huge(1.0_dp)) call add_table_end(model, &
            describe_contact(model, contact), contact%force, merge(contact%length, -1.0_dp, law%spot%is_per_length), &
            law%spot%table(1, :), 'resistance', law%spot_memory, elements, warnings)
         if (law%heat%has_table .and. abs(contact%heat_bar) + abs(contact%heat) > 0) call add_table_end(model, &
            describe_contact(model, contact), contact%force, merge(contact%length, -1.0_dp, law%heat%is_per_length), &
            law%heat%table(1, :), 'heat conductance', .false., elements, warnings)
      end associate
   end subroutine add_table_ends

   !> An element on a rigid surface with such a force per length, in the mean.
   subroutine add_table_ends_on_surface(model, contact, warnings)
      type(model_t), intent(in) :: model
      type(surface_contact_t), intent(in) :: contact
      type(shared_warnings_t), intent(inout) :: warnings
      character(len=:), allocatable :: words

      associate (pair => model%surface_pairs(contact%pair), element => model%element_id(contact%element))
         words = 'element '//to_text(element)//' on the rigid surface '//model%surfaces(pair%surface)%name
         associate (law => model%interactions(pair%interaction))
            if (law%spot%has_table .and. contact%conductance > 0) call add_table_end(model, words, contact%force, &
               contact%length, law%spot%table(1, :), 'resistance', .false., [element], warnings)
            if (law%heat%has_table .and. abs(contact%heat) > 0) call add_table_end(model, words, contact%force, &
               contact%length, law%heat%table(1, :), 'heat conductance', .false., [element], warnings)
         end associate
      end associate
   end subroutine add_table_ends_on_surface

   subroutine add_table_end(model, words, contact_force, length, forces, what, is_remembered, elements, warnings)
      type(model_t), intent(in) :: model
      !> The contact
      character(len=*), intent(in) :: words
      !> Its force [N], and the length to which forces of the table refer [m]; negative: they are those of contacts
      real(dp), intent(in) :: contact_force, length
      !> Of the table (n) [N, N/m]
      real(dp), intent(in) :: forces(:)
      !> What it gives
      character(len=*), intent(in) :: what
      !> A value stays under a falling force
      logical, intent(in) :: is_remembered
      !> The user's numbers of its elements (n)
      integer, intent(in) :: elements(:)
      type(shared_warnings_t), intent(inout) :: warnings
      character(len=:), allocatable :: unit
      real(dp) :: first, last, factor, force

      if (.not. abs(length) > 0) return
      force = contact_force
      unit = 'N'
      if (length > 0) then
         force = force/length
         unit = 'N/m'
      end if
      if (size(forces) < 2) return
      first = forces(1)
      last = forces(size(forces))
      factor = force/last
      if (.not. is_remembered) factor = max(factor, first/force)
      if (factor <= 1) return
      call warnings%add('outside_table', words//' has a force of '//to_text(force)// &
         model%units%after(unit)//', outside the table of its '//what//' (from '//to_text(first)//' to '// &
         to_text(last)//model%units%after(unit)//'), which is continued there as a power law', elements, &
         factor, 'times beyond the table')
   end subroutine add_table_end

   !> Pairs of electrodes between which a resistance is asked for, although part of the current goes elsewhere.
   subroutine add_third_electrodes(problem)
      type(problem_t), intent(inout) :: problem
      type(scales_t) :: scales
      integer, parameter :: slot = first_slot(field_potential)
      real(dp) :: plus, minus, elsewhere
      integer :: i

      scales = measure_scales(problem)
      associate (model => problem%model, state => problem%state)
         do i = 1, size(model%steps(state%step)%requests)
            associate (request => model%steps(state%step)%requests(i))
               if (request%kind /= request_electrode) cycle
               plus = current_into(request%set)
               minus = current_into(request%set_2)
               elsewhere = abs(plus + minus)
               if (elsewhere <= allowed_imbalance*max(abs(plus), abs(minus)) + round_off_at(request%set) &
                  + round_off_at(request%set_2)) cycle
               elsewhere = elsewhere/max(abs(plus), abs(minus))
               call problem%warnings%add('third_electrode', 'of the current of the electrodes '// &
                  model%node_sets(request%set)%name//' and '//model%node_sets(request%set_2)%name//', '// &
                  to_text(100*elsewhere)//' % enters or leaves elsewhere: their voltage over the current of '// &
                  model%node_sets(request%set)%name//' is not the resistance between them', value=100*elsewhere, &
                  unit='% of the current')
            end associate
         end do
      end associate

   contains

      !> Current that enters the body at the nodes of a set [A].
      real(dp) function current_into(set)
         !> Index of the node set
         integer, intent(in) :: set

         associate (nodes => problem%model%node_sets(set)%members)
            current_into = problem%processes%sum(sum(problem%state%reaction(slot, nodes) &
               + problem%state%load(slot, nodes)))
         end associate
      end function current_into

      !> Round-off in it [A].
      real(dp) function round_off_at(set)
         !> Index of the node set
         integer, intent(in) :: set

         round_off_at = problem%processes%sum(sum(scales%round_off(field_potential, &
            problem%model%node_sets(set)%members)))
      end function round_off_at

   end subroutine add_third_electrodes

end module litz_increment_warnings
