!> What every accepted increment must fulfil, checked from the state that goes into the results, apart from the
!> iteration that has found it.
!>
!> Source: theory section 8, the invariants of every run.
module litz_audit
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
   use litz_fields, only: fields, n_fields, n_slots, first_slot, last_slot, field_displacement, field_rotation, &
      field_potential, field_temperature, field_of_slot, field_of_dof
   use litz_kinds, only: dp
   use litz_communicator, only: communicator_t
   use litz_contact_net, only: allowed_penetration
   use litz_errors, only: error_t, fail, exit_not_converged
   use litz_flow_balances, only: current_imbalance, spot_imbalance, power_imbalance, heat_imbalance, power_left_over
   use litz_loading, only: loading_t
   use litz_model, only: model_t
   use litz_normal_law, only: find_stiffer_penalty
   use litz_quantities, only: quantity_table_t, on_points
   use litz_result_quantities, only: wire_quantity_t, list_wire_quantities, contact_table
   use litz_rotations, only: cross
   use litz_state, only: state_t, contact_t
   use litz_text, only: to_text
   implicit none
   private
   public :: audit_t, scales_t, audit_increment, audit_error
   public :: force_imbalance, moment_imbalance, current_imbalance, spot_imbalance, power_imbalance, heat_imbalance, &
      not_finite, not_prescribed, crossed_contact, deepest_contact
   public :: allowed_imbalance, vanishing
   public :: penetration, describe_contact

   !> A sum that should vanish may be this part of the largest force, moment, current or power in it. The residuals that
   !> *CONTROLS allows by itself are far below: more is a mistake, or a tolerance that lets a wrong answer pass.
   real(dp), parameter :: allowed_imbalance = 1.0e-4_dp

   !> Forces and currents below this are zero: their squares, and those of their round-off, vanish among the numbers.
   !> A current that is switched off falls by a factor of round-off in each increment
   real(dp), parameter :: vanishing = sqrt(tiny(1.0_dp))/epsilon(1.0_dp)

   !> A value may depart from the prescribed one by this part of the largest of its field: round-off of a value that was
   !> far larger before.
   real(dp), parameter :: allowed_departure = 1.0e-10_dp

   integer, parameter :: current_slot = first_slot(field_potential), heat_slot = first_slot(field_temperature)

   !> What the sums are measured by.
   type :: scales_t
      !> Largest nodal force [N], moment [N m] and current [A] of any element, contact or load
      real(dp) :: reference(n_fields) = 0
      !> What round-off makes of each at every node (n_fields, n_nodes)
      real(dp), allocatable :: round_off(:, :)
   end type scales_t

   !> The worst figures, each over its scale.
   type :: audit_t
      !> Largest sum of forces, of moments, at a node or over the model; of currents at a node or spot; power less heat
      real(dp) :: force = 0, moment = 0, current = 0, power = 0
      !> Deepest overlap over the smaller radius, and its place among the contacts (0: none)
      real(dp) :: penetration = 0
      integer :: deepest = 0
      !> What is wrong, in words; empty: nothing
      character(len=:), allocatable :: finding
   end type audit_t

contains

   function audit_increment(processes, model, state, loading, residual, scales) result(audit)
      class(communicator_t), intent(in) :: processes
      type(model_t), intent(in) :: model
      type(state_t), intent(in) :: state
      !> As the state should have it
      type(loading_t), intent(in) :: loading
      !> Largest force [N], moment [N m] and current [A] that are left over at each node (n_fields, n_nodes)
      real(dp), intent(in) :: residual(:, :)
      type(scales_t), intent(in) :: scales
      type(audit_t) :: audit
      real(dp) :: extent, power, potential, total_round_off(n_fields), not_shown
      integer :: worst, field

      audit%finding = processes%first_text(not_finite(model, state))
      if (len(audit%finding) > 0) return
      audit%finding = processes%first_text(not_prescribed(processes, model, state, loading))
      if (len(audit%finding) == 0) audit%finding = not_rigid(processes, model, state)
      extent = maxval(processes%largest(maxval(model%x, 2)) + processes%largest(-minval(model%x, 2)))
      potential = processes%largest(maxval(abs(state%value(current_slot, :))))
      ! twice what is left over, which has round-off itself
      power = max(processes%sum(sum(abs(state%joule_heat)) + sum(abs(state%contacts%joule_heat)) &
         + sum(abs(state%surface_contacts%joule_heat))), &
         2*power_left_over(processes, state, residual(field_potential, :))/allowed_imbalance)
      if (len(audit%finding) == 0) audit%finding = not_finite_stiffness(model, scales)
      total_round_off = processes%sum(sum(processes%own_part(scales%round_off), 2))
      call weigh_nodes('forces', residual(field_displacement, :), field_displacement, audit%force)
      call weigh_nodes('moments', residual(field_rotation, :), field_rotation, audit%moment)
      call weigh('the forces on the model do not balance', norm2(force_imbalance(processes, state)), &
         scales%reference(field_displacement), total_round_off(field_displacement), audit%force)
      call weigh('the moments on the model do not balance', norm2(moment_imbalance(processes, model, state)), &
         scales%reference(field_rotation) + scales%reference(field_displacement)*extent, &
         total_round_off(field_rotation) + total_round_off(field_displacement)*extent, audit%moment)
      call weigh_nodes('currents', abs(current_imbalance(processes, model, state)), field_potential, audit%current)
      if (size(state%contacts) > 0) then
         associate (spots => abs(spot_imbalance(state%contacts)))
            worst = maxloc(spots, 1)
            call weigh('current and voltage of contact '//to_text(state%contacts(worst)%id)//' disagree', &
               spots(worst), scales%reference(field_potential), total_round_off(field_potential), audit%current)
         end associate
      end if
      call weigh('the power of the supports is not the Joule heat', abs(power_imbalance(processes, state)), power, &
         total_round_off(field_potential)*potential, audit%power)
      not_shown = 0
      call weigh('the heat that leaves the wires or is stored is not that which is made in them', &
         abs(heat_imbalance(processes, state)), &
         processes%sum(sum(abs(state%heat_made) + abs(state%surface_heat) + abs(state%heat_stored)) &
         + sum(abs(state%contacts%heat_bar) + abs(state%contacts%heat)) + sum(abs(state%surface_contacts%heat)) &
         + sum(abs(processes%own_part(state%reaction(heat_slot, :))))), &
         total_round_off(field_temperature), &
         not_shown)
      do field = 1, n_fields
         if (any(field == [field_displacement, field_rotation, field_potential])) cycle
         call weigh_nodes(trim(fields(field)%flux_in_words)//'s', residual(field, :), field, not_shown)
      end do
      worst = crossed_contact(model, state%contacts)
      if (worst > 0 .and. len(audit%finding) == 0) then
         audit%finding = 'the axes of '//describe_contact(model, state%contacts(worst))//' have passed each other'
      end if
      audit%deepest = deepest_contact(model, state%contacts)
      if (audit%deepest > 0) audit%penetration = penetration(model, state%contacts(audit%deepest))
      if (audit%penetration > allowed_penetration .and. len(audit%finding) == 0) then
         audit%finding = describe_overlap(model, state%contacts(audit%deepest))
      end if
      call share_audit(processes, audit)

   contains

      !> The node whose sum is the worst for its round-off.
      pure subroutine weigh_nodes(what, imbalance, field, figure)
         !> Such as `forces`
         character(len=*), intent(in) :: what
         !> Of every node (n_nodes)
         real(dp), intent(in) :: imbalance(:)
         !> One of litz_fields
         integer, intent(in) :: field
         !> The worst of all, over its scale; made larger
         real(dp), intent(inout) :: figure
         integer :: node

         associate (allowed => allowed_imbalance*scales%reference(field) + scales%round_off(field, :))
            node = maxloc(imbalance/max(allowed, tiny(1.0_dp)), 1)
         end associate
         call weigh('the '//what//' at node '//to_text(model%node_id(node))//' do not balance', imbalance(node), &
            scales%reference(field), scales%round_off(field, node), figure)
      end subroutine weigh_nodes

      pure subroutine weigh(words, imbalance, scale, round_off, figure)
         !> What does not balance
         character(len=*), intent(in) :: words
         !> What is left over, the largest quantity in it, and what round-off makes of it
         real(dp), intent(in) :: imbalance, scale, round_off
         !> The larger of this one and what it was
         real(dp), intent(inout) :: figure
         real(dp) :: measure

         ! a field of nothing but round-off has no scale of its own
         measure = max(scale + round_off/allowed_imbalance, vanishing/allowed_imbalance)
         figure = max(figure, imbalance/measure)
         if (imbalance <= allowed_imbalance*measure .or. len(audit%finding) > 0) return
         audit%finding = words//': '//to_text(imbalance)//' of '//to_text(scale)//', where the allowed fraction is '// &
            to_text(allowed_imbalance)
      end subroutine weigh

   end function audit_increment

   !> The worst figures of all processes, and what the first one has found.
   subroutine share_audit(processes, audit)
      class(communicator_t), intent(in) :: processes
      type(audit_t), intent(inout) :: audit
      real(dp) :: worst(5)

      worst = processes%largest([audit%force, audit%moment, audit%current, audit%power, audit%penetration])
      audit%force = worst(1)
      audit%moment = worst(2)
      audit%current = worst(3)
      audit%power = worst(4)
      audit%penetration = worst(5)
      audit%finding = processes%first_text(audit%finding)
   end subroutine share_audit

   !> A failed audit ends the run.
   pure function audit_error(state, audit) result(error)
      type(state_t), intent(in) :: state
      type(audit_t), intent(in) :: audit
      type(error_t) :: error

      error = fail(exit_not_converged, 'step '//to_text(state%step)//', increment '//to_text(state%increment)// &
         ' has converged, but fails its audit: '//audit%finding//'. It is not in the results. Smaller tolerances of'// &
         ' *CONTROLS, PARAMETERS=FIELD or smaller increments may help; if not, this is a bug in litz')
   end function audit_error

   !> The node, element or contact with a result that is not a finite number, in words; empty: none.
   function not_finite(model, state) result(words)
      type(model_t), intent(in) :: model
      type(state_t), intent(in), target :: state
      character(len=:), allocatable :: words
      type(wire_quantity_t), allocatable :: list(:)
      integer :: i, place

      words = ''
      call list_wire_quantities(state, list)
      do i = 1, size(list)
         if (.not. associated(list(i)%values)) cycle
         place = findloc(all(ieee_is_finite(list(i)%values), 1), .false., 1)
         if (place == 0) cycle
         words = trim(list(i)%name)//' in element '//to_text(model%element_id(min(place, model%n_elements)))
         if (list(i)%place == on_points) words = trim(list(i)%name)//' at node '//to_text(model%node_id(place))
         words = words//' is not a number'
         return
      end do
      place = contact_not_finite(contact_table(state%contacts))
      if (place > 0) words = 'a value of '//describe_contact(model, state%contacts(place))//' is not a number'
   end function not_finite

   !> The node at which a row of the tangent is not finite, in words; empty: none. Where all is prescribed, no solver
   !> has seen it.
   pure function not_finite_stiffness(model, scales) result(words)
      type(model_t), intent(in) :: model
      type(scales_t), intent(in) :: scales
      character(len=:), allocatable :: words
      integer :: node

      words = ''
      node = findloc(all(ieee_is_finite(scales%round_off), 1), .false., 1)
      if (node > 0) words = 'a stiffness at node '//to_text(model%node_id(node))//' is not a number'
   end function not_finite_stiffness

   !> The row of the first contact with a value that is not a finite number; 0: none.
   pure integer function contact_not_finite(table) result(row)
      type(quantity_table_t), intent(in) :: table
      integer :: i

      row = 0
      do i = 1, size(table%quantities)
         associate (quantity => table%quantities(i))
            if (quantity%is_integer) cycle
            associate (values => table%reals(quantity%first:quantity%last(), :))
               if (quantity%may_be_infinite) row = findloc(any(ieee_is_nan(values), 1), .true., 1)
               if (.not. quantity%may_be_infinite) row = findloc(all(ieee_is_finite(values), 1), .false., 1)
            end associate
         end associate
         if (row > 0) return
      end do
   end function contact_not_finite

   !> A value that is not the prescribed one, in words; empty: none. Rotations follow one another and are not compared.
   function not_prescribed(processes, model, state, loading) result(words)
      class(communicator_t), intent(in) :: processes
      type(model_t), intent(in) :: model
      type(state_t), intent(in) :: state
      type(loading_t), intent(in) :: loading
      character(len=:), allocatable :: words
      real(dp) :: present(n_fields)
      integer :: node, slot

      words = ''
      present = largest_present(processes, model, state, loading)
      do node = 1, model%n_nodes
         do slot = 1, n_slots
            associate (field => fields(field_of_slot(slot)), value => state%value(slot, node), &
               target => loading%value(slot, node), &
               departure => abs(state%value(slot, node) - loading%value(slot, node)))
               if (field%is_rotation .or. .not. loading%fixed(slot, node)) cycle
               if (departure <= allowed_departure*present(field_of_slot(slot))) cycle
               if (departure <= allowed_departure*largest_prescribed(model, state%step, field_of_slot(slot))) cycle
               words = 'node '//to_text(model%node_id(node))//' has a '//trim(field%name)//' of '//to_text(value)// &
                  model%units%after(trim(field%unit))//' in degree of freedom '// &
                  to_text(field%first_dof + slot - field%first_slot)//' where '//to_text(target)// &
                  ' is prescribed: they differ by '//to_text(departure)
               return
            end associate
         end do
      end do
   end function not_prescribed

   !> A node that is not where its rigid body takes it, in words; empty: none.
   function not_rigid(processes, model, state) result(words)
      class(communicator_t), intent(in) :: processes
      type(model_t), intent(in) :: model
      type(state_t), intent(in) :: state
      character(len=:), allocatable :: words
      real(dp) :: largest, departure(3)
      integer :: i, k

      words = ''
      associate (u => state%value(first_slot(field_displacement):last_slot(field_displacement), :))
         largest = processes%largest(max(maxval(abs(model%x)), maxval(abs(u))))
         do i = 1, size(model%rigid_bodies)
            associate (r => model%rigid_bodies(i)%reference_node, n_tied => size(model%rigid_bodies(i)%tied), &
               nodes => [model%rigid_bodies(i)%tied, model%rigid_bodies(i)%pinned])
               do k = 1, size(nodes)
                  associate (arm => model%x(:, nodes(k)) - model%x(:, r), rotation => state%rotation(:, :, r))
                     departure = u(:, nodes(k)) - u(:, r) + arm - matmul(rotation, arm)
                     if (norm2(departure) > allowed_departure*largest) then
                        words = 'has left its place by '//to_text(norm2(departure))//model%units%after('m')
                     else if (k <= n_tied .and. any(abs(state%rotation(:, :, nodes(k)) - rotation) &
                        > allowed_departure)) then
                        words = 'has another rotation'
                     end if
                  end associate
                  if (len(words) == 0) cycle
                  words = 'node '//to_text(model%node_id(nodes(k)))//' of the rigid body of node '// &
                     to_text(model%node_id(r))//' '//words
                  return
               end do
            end associate
         end do
      end associate
   end function not_rigid

   !> The largest values of each field, at present and when the step began; with displacements the coordinates, whose
   !> round-off they have.
   function largest_present(processes, model, state, loading) result(largest)
      class(communicator_t), intent(in) :: processes
      type(model_t), intent(in) :: model
      type(state_t), intent(in) :: state
      type(loading_t), intent(in) :: loading
      real(dp) :: largest(n_fields)
      integer :: field

      do field = 1, n_fields
         associate (first => first_slot(field), last => last_slot(field))
            largest(field) = max(maxval(abs(state%value(first:last, :))), &
               maxval(abs(loading%start_value(first:last, :))))
         end associate
      end do
      largest(field_displacement) = max(largest(field_displacement), maxval(abs(model%x)))
      largest = processes%largest(largest)
   end function largest_present

   !> The largest value of a field that the steps so far have prescribed.
   pure real(dp) function largest_prescribed(model, last_step, field) result(largest)
      type(model_t), intent(in) :: model
      !> Present step, and one of the fields of litz_fields
      integer, intent(in) :: last_step, field
      real(dp) :: factor
      integer :: step, i

      largest = 0
      do step = 1, last_step
         do i = 1, size(model%steps(step)%boundary)
            associate (item => model%steps(step)%boundary(i))
               if (field_of_dof(item%dof) /= field) cycle
               factor = 1
               if (item%amplitude > 0) factor = maxval(abs(model%amplitudes(item%amplitude)%factor))
               largest = max(largest, factor*abs(item%value))
            end associate
         end do
      end do
   end function largest_prescribed

   !> Sum of what supports and loads do to the model [N].
   function force_imbalance(processes, state) result(total)
      class(communicator_t), intent(in) :: processes
      type(state_t), intent(in) :: state
      real(dp) :: total(3)

      associate (first => first_slot(field_displacement), last => last_slot(field_displacement))
         total = processes%sum(sum(processes%own_part(state%reaction(first:last, :) + state%load(first:last, :) &
            + state%outer_force(first:last, :)), 2))
      end associate
   end function force_imbalance

   !> The same for moments, about the centre of the nodes in their present places [N m].
   function moment_imbalance(processes, model, state) result(total)
      class(communicator_t), intent(in) :: processes
      type(model_t), intent(in) :: model
      type(state_t), intent(in) :: state
      real(dp) :: total(3), centre(3), x(3, model%n_nodes), force(n_slots)
      integer :: node

      x = model%x + state%value(first_slot(field_displacement):last_slot(field_displacement), :)
      centre = processes%sum(sum(processes%own_part(x), 2))/processes%count_nodes(model%n_nodes)
      total = 0
      do node = 1, model%n_nodes
         if (.not. processes%owns(node)) cycle
         force = state%reaction(:, node) + state%load(:, node) + state%outer_force(:, node)
         total = total + force(first_slot(field_rotation):last_slot(field_rotation)) + cross(x(:, node) - centre, &
            force(first_slot(field_displacement):last_slot(field_displacement)))
      end do
      total = processes%sum(total)
   end function moment_imbalance

   !> A contact whose axes are on the wrong side of each other, where the deck does not allow that; 0: none.
   pure integer function crossed_contact(model, contacts) result(i)
      type(model_t), intent(in) :: model
      type(contact_t), intent(in) :: contacts(:)

      do i = 1, size(contacts)
         if (is_unlimited(model, contacts(i))) cycle
         if (dot_product(contacts(i)%point_bar - contacts(i)%point, contacts(i)%normal) <= 0) return
      end do
      i = 0
   end function crossed_contact

   !> The contact of the deepest overlap for its radius; 0: none. Overlaps that the deck allows do not count.
   pure integer function deepest_contact(model, contacts) result(deepest)
      type(model_t), intent(in) :: model
      type(contact_t), intent(in) :: contacts(:)
      real(dp) :: largest
      integer :: i

      deepest = 0
      largest = 0
      do i = 1, size(contacts)
         if (is_unlimited(model, contacts(i))) cycle
         if (penetration(model, contacts(i)) <= largest) cycle
         largest = penetration(model, contacts(i))
         deepest = i
      end do
   end function deepest_contact

   !> Overlap over the smaller radius.
   pure real(dp) function penetration(model, contact)
      type(model_t), intent(in) :: model
      type(contact_t), intent(in) :: contact

      penetration = max(0.0_dp, -contact%gap)/smaller_radius(model, contact)
   end function penetration

   pure real(dp) function smaller_radius(model, contact)
      type(model_t), intent(in) :: model
      type(contact_t), intent(in) :: contact

      smaller_radius = minval(model%sections(model%element_section([contact%element_bar, &
         contact%element]))%contact_radius)
   end function smaller_radius

   pure logical function is_unlimited(model, contact)
      type(model_t), intent(in) :: model
      type(contact_t), intent(in) :: contact

      is_unlimited = model%interactions(model%contact_pairs(contact%pair)%interaction)%unlimited_penetration
   end function is_unlimited

   pure function describe_contact(model, contact) result(words)
      type(model_t), intent(in) :: model
      type(contact_t), intent(in) :: contact
      character(len=:), allocatable :: words

      words = 'contact '//to_text(contact%id)//' (elements '//to_text(model%element_id(contact%element_bar))// &
         ' and '//to_text(model%element_id(contact%element))//')'
   end function describe_contact

   !> A contact that overlaps too much, and what would hold it.
   pure function describe_overlap(model, contact) result(words)
      type(model_t), intent(in) :: model
      type(contact_t), intent(in) :: contact
      character(len=:), allocatable :: words
      real(dp) :: penalty, allowed
      character(len=8) :: unit

      words = describe_contact(model, contact)//' overlaps by '//to_text(100*penetration(model, contact))// &
         ' % of the smaller radius (above '//to_text(100*allowed_penetration)//' %)'
      associate (law => model%interactions(model%contact_pairs(contact%pair)%interaction)%normal)
         allowed = allowed_penetration*smaller_radius(model, contact)
         call find_stiffer_penalty(law, contact%force, -contact%gap, allowed, contact%length > 0, penalty, unit)
         if (law%has_penalty) then
            words = words//': a penalty of at least '//to_text(penalty)//model%units%after(trim(unit))// &
               ' would prevent this'
         else
            words = words//': the '//trim(law%title)//' is valid for smaller ones'
         end if
      end associate
   end function describe_overlap

end module litz_audit
