!> How far an iterate is from equilibrium, and whether that is near enough.
!>
!> Source: theory section 9.
module litz_convergence
   use litz_kinds, only: dp
   use litz_audit, only: scales_t, vanishing
   use litz_communicator, only: communicator_t
   use litz_fields, only: fields, n_fields, first_slot, last_slot, field_displacement, field_potential
   use litz_model, only: model_t, step_t
   use litz_problem, only: problem_t
   use litz_reports, only: iteration_report_t
   use litz_text, only: to_text
   implicit none
   private
   public :: measure_residual, vanishes_in_round_off, left_before, nodal_residual, measure_scales, has_converged, &
      group_converged, part_of_allowed, corrections_small, worst_field

   !> Residuals accepted only because of round-off are reported above this fraction of the reference
   real(dp), parameter :: worth_reporting = 1.0e-6_dp

contains

   !> True residual over the free unknowns, and what is allowed: of each field those of the node where the first is the
   !> largest part of the second. What round-off excuses differs from node to node, by the stiffness there.
   subroutine measure_residual(problem, step, report, at_round_off)
      type(problem_t), intent(in) :: problem
      type(step_t), intent(in) :: step
      type(iteration_report_t), intent(inout) :: report
      !> A residual is accepted for round-off only, above its own tolerance
      logical, intent(out) :: at_round_off
      type(scales_t) :: scales
      real(dp) :: residual(n_fields, problem%model%n_nodes), worst(n_fields), part, allowed
      integer :: node, field

      scales = measure_scales(problem)
      residual = nodal_residual(problem)
      report%residual = 0
      report%residual_node = 0
      report%allowed = step%controls%r_n*scales%reference
      worst = 0
      at_round_off = .false.
      do node = 1, size(residual, 2)
         do field = 1, n_fields
            associate (r => residual(field, node), reference => scales%reference(field))
               if (r > max(max(step%controls%r_n, worth_reporting)*reference, vanishing)) at_round_off = .true.
               allowed = max(step%controls%r_n*reference, scales%round_off(field, node), vanishing)
               part = part_of(r, allowed)
               ! a value that is not a number wins
               if (part <= worst(field) .or. .not. worst(field) <= huge(part)) cycle
               worst(field) = part
               report%residual(field) = r
               report%residual_node(field) = problem%model%node_id(node)
               report%allowed(field) = allowed
            end associate
         end do
      end do
      at_round_off = problem%processes%any(at_round_off)
      call take_worst(problem%processes, worst, report)
   end subroutine measure_residual

   !> Of each field the worst node of all processes.
   subroutine take_worst(processes, worst, report)
      class(communicator_t), intent(in) :: processes
      !> Largest part of the allowed residual in this process; out: in all (n_fields)
      real(dp), intent(inout) :: worst(:)
      type(iteration_report_t), intent(inout) :: report
      real(dp) :: there(3)
      integer :: field

      do field = 1, n_fields
         there = [report%residual(field), report%allowed(field), real(report%residual_node(field), dp)]
         call processes%take_largest(worst(field), there)
         report%residual(field) = there(1)
         report%allowed(field) = there(2)
         report%residual_node(field) = nint(there(3))
      end do
   end subroutine take_worst

   !> The loads of an increment have changed, but by less than what round-off makes of the forces at its start. These
   !> count as balanced as they are, and what has changed is a matter of one linear solution.
   logical function vanishes_in_round_off(problem, step) result(vanishes)
      type(problem_t), intent(in) :: problem
      type(step_t), intent(in) :: step
      type(scales_t) :: scales
      real(dp), allocatable :: change(:, :)
      integer :: field

      associate (load => problem%loading%load)
         vanishes = problem%processes%any(size(step%element_loads) > 0 .or. any(abs(load - problem%state%load) > 0))
         if (.not. vanishes) return
         vanishes = .false.
         scales = measure_scales(problem)
         change = abs(load - problem%forces%internal - left_before(problem))
      end associate
      do field = 1, n_fields
         associate (first => first_slot(field), last => last_slot(field))
            vanishes = vanishes .or. any(problem%equations%number(first:last, :) > 0 .and. change(first:last, :) > &
               max(max(step%controls%r_n, worth_reporting)*scales%reference(field), vanishing))
         end associate
      end do
      vanishes = problem%processes%any(vanishes)
   end function vanishes_in_round_off

   !> What the last increment has left over of its loads (n_slots, n_nodes), at the start of the next one. Behind a
   !> restart the loads on elements count as those of the next one.
   pure function left_before(problem) result(left)
      type(problem_t), intent(in) :: problem
      real(dp), allocatable :: left(:, :)

      if (allocated(problem%left_over)) then
         left = problem%left_over
      else
         left = problem%state%load - problem%forces%internal
      end if
   end function left_before

   !> Largest force [N], moment [N m] and current [A] that are left over at each node (n_fields, n_nodes). At the nodes
   !> of superconducting filaments it is at least by what their current differs from that of the law, to first order:
   !> wires that are alike balance at any voltage.
   pure function nodal_residual(problem) result(residual)
      type(problem_t), intent(in) :: problem
      real(dp), allocatable :: residual(:, :)
      real(dp) :: missing
      integer :: node, field, i, side

      associate (internal => problem%forces%internal, load => problem%loading%load, equations => problem%equations)
         allocate (residual(n_fields, size(load, 2)))
         do node = 1, size(load, 2)
            associate (free => equations%number(:, node) > 0, r => abs(internal(:, node) - load(:, node)))
               do field = 1, n_fields
                  associate (first => first_slot(field), last => last_slot(field))
                     residual(field, node) = largest(r(first:last), free(first:last))
                  end associate
               end do
            end associate
         end do
      end associate
      associate (there => problem%superconductors)
         do i = 1, size(there%members)
            missing = abs(there%flows(i)%current - there%current(i))
            do side = 1, 2
               associate (left => residual(field_potential, problem%model%connectivity(side, there%members(i))))
                  if (.not. missing <= left) left = missing
               end associate
            end do
         end do
      end associate

   contains

      !> A value that is not a number wins.
      pure real(dp) function largest(entries, mask)
         !> Magnitudes of the entries (n)
         real(dp), intent(in) :: entries(:)
         !> The entry counts (n)
         logical, intent(in) :: mask(:)
         integer :: i

         largest = 0
         do i = 1, size(entries)
            if (.not. mask(i) .or. entries(i) <= largest) cycle
            largest = entries(i)
            if (.not. largest <= huge(largest)) return
         end do
      end function largest

   end function nodal_residual

   !> `residual/allowed`, or the largest number where that is not finite.
   pure real(dp) function part_of(residual, allowed) result(part)
      !> Both of the same unit
      real(dp), intent(in) :: residual, allowed
      real(dp) :: divisor

      divisor = max(allowed, tiny(1.0_dp))
      part = huge(1.0_dp)
      if (divisor < 1 .and. residual > divisor*huge(1.0_dp)) return
      part = residual/divisor
   end function part_of

   !> What residuals are measured by: the largest forces at any node, and the round-off at each.
   function measure_scales(problem) result(scales)
      type(problem_t), intent(in) :: problem
      type(scales_t) :: scales
      integer :: field

      associate (load => problem%loading%load, forces => problem%forces)
         allocate (scales%round_off(n_fields, size(load, 2)))
         do field = 1, n_fields
            associate (first => first_slot(field), last => last_slot(field))
               scales%reference(field) = max(forces%reference(field), maxval(abs(load(first:last, :))))
               scales%round_off(field, :) = epsilon(1.0_dp)*maxval(forces%sensitivity(first:last, :), 1)
            end associate
         end do
      end associate
      scales%reference = problem%processes%largest(scales%reference)
   end function measure_scales

   !> The fields of the groups up to this one are within their tolerances.
   pure logical function has_converged(report, last_group)
      type(iteration_report_t), intent(in) :: report
      !> One of the groups of litz_fields
      integer, intent(in) :: last_group

      has_converged = all(report%residual <= report%allowed .or. fields%group > last_group)
   end function has_converged

   !> The fields of a group are within their tolerances.
   pure logical function group_converged(report, group)
      type(iteration_report_t), intent(in) :: report
      !> One of the groups of litz_fields
      integer, intent(in) :: group

      group_converged = all(report%residual <= report%allowed .or. fields%group /= group)
   end function group_converged

   !> The largest residual of a group over the allowed one.
   pure real(dp) function part_of_allowed(report, group) result(part)
      type(iteration_report_t), intent(in) :: report
      !> One of the groups of litz_fields
      integer, intent(in) :: group
      integer :: field

      part = 0
      do field = 1, n_fields
         if (fields(field)%group == group) part = max(part, part_of(report%residual(field), report%allowed(field)))
      end do
   end function part_of_allowed

   !> The second criterion of *CONTROLS, asked for with a non-zero C_n.
   logical function corrections_small(processes, step, change, report)
      class(communicator_t), intent(in) :: processes
      type(step_t), intent(in) :: step
      !> Sum of the corrections since the increment began (n_slots, n_nodes)
      real(dp), intent(in) :: change(:, :)
      type(iteration_report_t), intent(in) :: report

      corrections_small = step%controls%c_n <= 0
      if (corrections_small) return
      corrections_small = report%correction(field_displacement) <= step%controls%c_n &
         *processes%largest(maxval(abs(change(first_slot(field_displacement):last_slot(field_displacement), :))))
   end function corrections_small

   !> Why the iteration limit was met: the field that is farthest from its tolerance. Voltages that are found after the
   !> displacements are not to blame while these are not.
   function worst_field(model, n_coupled, report) result(text)
      type(model_t), intent(in) :: model
      !> Groups that are in a Newton step
      integer, intent(in) :: n_coupled
      type(iteration_report_t), intent(in) :: report
      character(len=:), allocatable :: text
      integer :: field
      logical :: to_blame(n_fields)

      to_blame = fields%group <= n_coupled .or. has_converged(report, n_coupled)
      field = maxloc(report%residual/max(report%allowed, tiny(1.0_dp)), 1, to_blame)
      text = 'the largest '//trim(fields(field)%flux_in_words)//' residual is'// &
         in_short(report%residual(field))//model%units%after(trim(fields(field)%flux_unit))// &
         ', allowed are'//in_short(report%allowed(field))//', after '//to_text(report%iteration)//' iterations'
      if (report%residual_node(field) > 0) text = text//', at node '//to_text(report%residual_node(field))
   end function worst_field

   !> A number of three digits. An exponent of three digits keeps its E.
   pure function in_short(value) result(text)
      !> Any number
      real(dp), intent(in) :: value
      character(len=:), allocatable :: text
      character(len=10) :: buffer
      real(dp), parameter :: of_two_digits(2) = [1.0e-99_dp, 1.0e99_dp]

      if (abs(value) > 0 .and. (abs(value) < of_two_digits(1) .or. abs(value) > of_two_digits(2))) then
         write (buffer, '(es10.2e3)') value
         text = buffer
      else
         write (buffer, '(es9.2)') value
         text = trim(buffer)
      end if
   end function in_short

end module litz_convergence
