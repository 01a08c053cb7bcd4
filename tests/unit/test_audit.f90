!> The audit passes a state that is right, and fails each that is wrong in one thing.
!>
!> Two wires of four nodes cross in their middles: the lower one (nodes 1, 2) along x, the upper one (3, 4) along y,
!> pressed together by a force `f`; a current `i` enters at node 1, crosses the spot and leaves at node 3.
program test_audit
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_positive_inf
   use litz_fields, only: n_slots, n_fields
   use litz_kinds, only: dp
   use litz_audit, only: audit_t, scales_t, audit_increment, audit_error
   use litz_communicator, only: one_process_t
   use litz_errors, only: error_t, exit_not_converged
   use litz_loading, only: loading_t
   use litz_model, only: model_t, nodal_value_t
   use litz_normal_laws, only: normal_law
   use litz_state, only: state_t
   use litz_unit_labels, only: si_labels
   implicit none

   real(dp), parameter :: radius = 1.0e-3_dp, half = 0.05_dp, f = 8, i = 3, overlap = 1.0e-5_dp
   real(dp), parameter :: r_wire = 2.0e-4_dp, r_spot = 5.0e-4_dp
   real(dp), parameter :: at_rest(n_fields, 4) = 0
   type(one_process_t) :: alone
   type(model_t) :: model
   type(state_t) :: right, wrong
   type(scales_t) :: scales
   type(loading_t) :: loading
   type(audit_t) :: audit
   real(dp) :: residual(n_fields, 4)
   type(error_t) :: error

   call make_model(model)
   call make_state(right)
   call make_loading(loading)
   scales%reference(:3) = [f/2, f/2*half, i]
   allocate (scales%round_off(n_fields, 4), source=0.0_dp)
   scales%round_off(:3, :) = spread(epsilon(1.0_dp)*[f, f*half, i], 2, 4)

   audit = audit_increment(alone, model, right, loading, at_rest, scales)
   call expect(len(audit%finding) == 0, 'the right state passes: '//audit%finding)
   call expect(max(audit%force, audit%moment, audit%current, audit%power) < 1.0e-12_dp, 'its sums vanish')
   call expect(abs(audit%penetration - overlap/radius) < 1.0e-12_dp, 'its overlap is that of the contact')

   ! equal and opposite residuals cancel in the sum over the model
   residual = at_rest
   residual(1, 2) = 1.0e-3_dp*f
   audit = audit_increment(alone, model, right, loading, residual, scales)
   call expect(index(audit%finding, 'the forces at node 12') == 1, 'a force is left: '//audit%finding)
   residual = at_rest
   residual(2, 3) = 1.0e-3_dp*f*half
   audit = audit_increment(alone, model, right, loading, residual, scales)
   call expect(index(audit%finding, 'the moments at node 13') == 1, 'a moment is left: '//audit%finding)

   ! round-off excuses a force at a stiff node, not the same force or half of it at a soft one
   scales%round_off(1, 4) = 1.0e-3_dp*f
   residual = at_rest
   residual(1, 4) = 1.0e-3_dp*f
   audit = audit_increment(alone, model, right, loading, residual, scales)
   call expect(len(audit%finding) == 0, 'a stiff node is passed: '//audit%finding)
   residual(1, 1) = 0.5e-3_dp*f
   audit = audit_increment(alone, model, right, loading, residual, scales)
   call expect(index(audit%finding, 'the forces at node 11') == 1, 'a soft node is not excused: '//audit%finding)
   scales%round_off(1, 4) = scales%round_off(1, 1)

   wrong = right
   wrong%reaction(3, 2) = wrong%reaction(3, 2)*(1 + 1.0e-3_dp)
   call expect_finding(wrong, 'the forces on the model do not balance')

   wrong = right
   wrong%reaction(1, 3) = 1
   wrong%reaction(1, 4) = -1
   call expect_finding(wrong, 'the moments on the model do not balance')

   wrong = right
   wrong%element_current(2) = wrong%element_current(2)*(1 + 1.0e-3_dp)
   call expect_finding(wrong, 'the currents at node 13 do not balance')

   wrong = right
   wrong%contacts(1)%voltage_gap = wrong%contacts(1)%voltage_gap*(1 + 1.0e-3_dp)
   call expect_finding(wrong, 'current and voltage of contact 7 disagree')

   wrong = right
   wrong%joule_heat(1) = wrong%joule_heat(1)*(1 + 1.0e-2_dp)
   call expect_finding(wrong, 'the power of the supports is not the Joule heat')

   ! a current of 1e-12 of the largest is left over at a node of a wire at 1e-15 V, all of it the power there is
   call make_state(wrong)
   wrong%contacts%current = 0
   wrong%contacts%voltage_gap = 0
   wrong%contacts%joule_heat = 0
   wrong%element_current = 0
   wrong%joule_heat = 0
   wrong%reaction(7, :) = 0
   wrong%value(7, :) = 1.0e-15_dp
   wrong%load(7, 2) = 1.0e-12_dp*i
   call expect_finding(wrong, 'the power of the supports is not the Joule heat')
   residual = at_rest
   residual(3, 2) = 1.0e-12_dp*i
   audit = audit_increment(alone, model, wrong, loading, residual, scales)
   call expect(len(audit%finding) == 0, 'a current that may be left over has its power: '//audit%finding)
   residual(3, 2) = 1.0e-13_dp*i
   audit = audit_increment(alone, model, wrong, loading, residual, scales)
   call expect(index(audit%finding, 'the power of the supports') == 1, 'more power than that is wrong')
   ! nor has a current that is fed in where a potential is prescribed more digits than it has
   wrong%value(7, :) = 1
   wrong%load(7, 2) = i*(1 + epsilon(1.0_dp))
   wrong%reaction(7, 2) = -i
   scales%round_off = 0
   audit = audit_increment(alone, model, wrong, loading, at_rest, scales)
   call expect(len(audit%finding) == 0, 'a current that enters and leaves has round-off: '//audit%finding)
   scales%round_off(:3, :) = spread(epsilon(1.0_dp)*[f, f*half, i], 2, 4)

   ! of what is prescribed only rotations, which follow one another, may be others
   loading%fixed(:, 3) = .true.
   loading%value(:, 3) = right%value(:, 3)
   loading%value(5, 3) = 1
   audit = audit_increment(alone, model, right, loading, at_rest, scales)
   call expect(len(audit%finding) == 0, 'what is prescribed is there: '//audit%finding)
   loading%value(7, 3) = right%value(7, 3) + 1.0e-6_dp
   call expect_finding(right, 'node 13 has a potential of -1.5e-04 V in degree of freedom 9 where -1.49e-04 is '// &
      'prescribed: they differ by 1e-06')
   loading%fixed(7, 3) = .false.
   audit = audit_increment(alone, model, right, loading, at_rest, scales)
   call expect(len(audit%finding) == 0, 'what is free may be anything: '//audit%finding)
   loading%value(2, 3) = 1.0e-9_dp
   call expect_finding(right, 'node 13 has a displacement of 0 m in degree of freedom 2 where 1e-09 is prescribed')
   ! round-off of what was far larger before: coordinates, values of the deck, values when the step began
   loading%value(2, 3) = epsilon(1.0_dp)*half
   audit = audit_increment(alone, model, right, loading, at_rest, scales)
   call expect(len(audit%finding) == 0, 'coordinates have round-off: '//audit%finding)
   loading%fixed(7, 3) = .true.
   loading%value(7, 3) = right%value(7, 3) + 1.0e-12_dp
   call expect_finding(right, 'node 13 has a potential')
   loading%start_value(7, 1) = 1
   audit = audit_increment(alone, model, right, loading, at_rest, scales)
   call expect(len(audit%finding) == 0, 'a potential that is small in the end had round-off: '//audit%finding)
   loading%start_value(7, 1) = 0
   wrong = right
   wrong%step = 1
   model%steps(1)%boundary = [nodal_value_t(node=1, dof=9, value=1.0_dp)]
   audit = audit_increment(alone, model, wrong, loading, at_rest, scales)
   call expect(len(audit%finding) == 0, 'so has one that a step has prescribed larger: '//audit%finding)
   model%steps(1)%boundary%value = 1.0e-3_dp
   call expect_finding(wrong, 'node 13 has a potential')
   model%steps(1)%boundary%amplitude = 1
   audit = audit_increment(alone, model, wrong, loading, at_rest, scales)
   call expect(len(audit%finding) == 0, 'or by an amplitude: '//audit%finding)
   call make_loading(loading)

   call check_rigid_body()

   wrong = right
   wrong%contacts(1)%normal = -wrong%contacts(1)%normal
   call expect_finding(wrong, 'the axes of contact 7 (elements 101 and 102) have passed each other')
   model%interactions(1)%unlimited_penetration = .true.
   audit = audit_increment(alone, model, wrong, loading, at_rest, scales)
   call expect(len(audit%finding) == 0, 'PENETRATION=UNLIMITED lets axes pass')
   call expect(audit%deepest == 0, 'PENETRATION=UNLIMITED has no deepest contact')
   model%interactions(1)%unlimited_penetration = .false.

   wrong = right
   wrong%value(7, 4) = ieee_value(1.0_dp, ieee_quiet_nan)
   call expect_finding(wrong, 'potential at node 14 is not a number')
   wrong = right
   wrong%section_forces(6, 2) = ieee_value(1.0_dp, ieee_quiet_nan)
   call expect_finding(wrong, 'bending_moment_3 in element 102 is not a number')
   wrong = right
   wrong%contacts(1)%resistance = ieee_value(1.0_dp, ieee_quiet_nan)
   call expect_finding(wrong, 'a value of contact 7 (elements 101 and 102) is not a number')


   wrong = right
   wrong%contacts(1)%resistance = ieee_value(1.0_dp, ieee_positive_inf)
   call expect_finding(wrong, 'current and voltage of contact 7 disagree')
   wrong%contacts%current = 0
   wrong%contacts%joule_heat = 0
   wrong%reaction(7, :) = 0
   wrong%load(7, :) = 0
   wrong%element_current = 0
   wrong%joule_heat = 0
   audit = audit_increment(alone, model, wrong, loading, at_rest, scales)
   call expect(len(audit%finding) == 0, 'an insulated contact without a current is right: '//audit%finding)

   wrong = right
   wrong%reaction(3, 1) = 0
   wrong%step = 2
   wrong%increment = 5
   error = audit_error(wrong, audit_increment(alone, model, wrong, loading, at_rest, scales))
   call expect(error%code == exit_not_converged, 'a failed audit is a failed run')
   call expect(index(error%message, 'step 2, increment 5') > 0, 'the increment is named')

   wrong = right
   wrong%contacts(1)%gap = -0.2_dp*radius
   ! the force over 5 % of the radius
   call expect_finding(wrong, 'contact 7 (elements 101 and 102) overlaps by 20 % of the smaller radius '// &
      '(above 5 %): a penalty of at least 160000 N/m would prevent this')
   model%interactions(1)%normal = normal_law('HERTZ')
   call expect_finding(wrong, 'contact 7 (elements 101 and 102) overlaps by 20 % of the smaller radius '// &
      '(above 5 %): the law of Hertz is valid for smaller ones')

   model%interactions(1)%normal = normal_law('LINEAR', [1.0_dp])
   call make_state(wrong)
   wrong%reaction = 0
   wrong%reaction(3, 1) = 1.0e-14_dp
   wrong%contacts = wrong%contacts(:0)
   wrong%reaction(7, :) = 0
   wrong%element_current = 0
   wrong%joule_heat = 0
   scales%reference(:3) = [1.0e-14_dp, 0.0_dp, 0.0_dp]
   scales%round_off(:3, :) = spread([1.0e-13_dp, 1.0e-14_dp, 0.0_dp], 2, 4)
   audit = audit_increment(alone, model, wrong, loading, at_rest, scales)
   call expect(len(audit%finding) == 0, 'a model at rest is not failed for its round-off: '//audit%finding)
   ! a main program keeps its variables to the end, which checkers of leaks take for lost ones

contains

   !> Node 2 has moved with node 1; it may not have done so by a little more, or less, nor have another rotation.
   subroutine check_rigid_body()
      real(dp), parameter :: turn(3, 3) = reshape([0, 1, 0, -1, 0, 0, 0, 0, 1], [3, 3])
      type(state_t) :: moved

      deallocate (model%rigid_bodies)
      allocate (model%rigid_bodies(1))
      model%rigid_bodies(1)%reference_node = 1
      model%rigid_bodies(1)%tied = [2]
      model%rigid_bodies(1)%pinned = [integer ::]
      call expect_rigid(right)
      moved = right
      ! a quarter of a turn about z, and a little along x
      moved%rotation(:, :, 1) = turn
      moved%rotation(:, :, 2) = turn
      moved%value(1:2, 2) = [-2*half, 2*half]
      moved%value(1, 1:2) = moved%value(1, 1:2) + 0.01_dp
      call expect_rigid(moved)
      moved%value(3, 2) = 1.0e-9_dp
      call expect_finding(moved, 'node 12 of the rigid body of node 11 has left its place by 1e-09 m')
      moved%value(3, 2) = 0
      moved%rotation(:, :, 2) = right%rotation(:, :, 2)
      call expect_finding(moved, 'node 12 of the rigid body of node 11 has another rotation')
      model%rigid_bodies(1)%tied = [integer ::]
      model%rigid_bodies(1)%pinned = [2]
      call expect_rigid(moved)
      deallocate (model%rigid_bodies)
      allocate (model%rigid_bodies(0))
   end subroutine check_rigid_body

   subroutine make_model(model)
      type(model_t), intent(out) :: model

      model%units = si_labels
      model%n_nodes = 4
      model%n_elements = 2
      model%node_id = [11, 12, 13, 14]
      model%element_id = [101, 102]
      model%x = reshape([-half, 0.0_dp, 0.0_dp, half, 0.0_dp, 0.0_dp, &
         0.0_dp, -half, 2*radius - overlap, 0.0_dp, half, 2*radius - overlap], [3, 4])
      model%connectivity = reshape([1, 2, 3, 4], [2, 2])
      model%element_section = [1, 1]
      allocate (model%sections(1), model%interactions(1), model%contact_pairs(1), model%steps(2), model%amplitudes(1))
      allocate (model%steps(1)%boundary(0), model%steps(2)%boundary(0))
      allocate (model%rigid_bodies(0))
      model%amplitudes(1)%factor = [0.0_dp, -1.0e3_dp]
      model%sections(1)%contact_radius = radius
      model%interactions(1)%normal = normal_law('LINEAR', [1.0_dp])
      model%contact_pairs(1)%interaction = 1
   end subroutine make_model

   subroutine make_state(state)
      type(state_t), intent(out) :: state
      real(dp), parameter :: unit_matrix(9) = [1, 0, 0, 0, 1, 0, 0, 0, 1]

      allocate (state%value(n_slots, 4), state%reaction(n_slots, 4), state%load(n_slots, 4), &
         state%outer_force(n_slots, 4), state%section_forces(6, 2), state%heat_made(2), &
         state%surface_heat(2), state%heat_stored(2), source=0.0_dp)
      state%rotation = spread(reshape(unit_matrix, [3, 3]), 3, 4)
      state%reaction(3, :) = [f/2, f/2, -f/2, -f/2]
      ! half of the current leaves each wire at either end of its element, as the linear voltage has it
      state%reaction(7, 1) = i
      state%reaction(7, 3) = -i
      state%element_current = [i/2, -i/2]
      allocate (state%contacts(1), state%surface_contacts(0))
      associate (c => state%contacts(1))
         c%id = 7
         c%pair = 1
         c%element_bar = 1
         c%element = 2
         c%gap = -overlap
         c%force = f
         c%normal = [0, 0, -1]
         c%point_bar = 0
         c%point = [0.0_dp, 0.0_dp, 2*radius - overlap]
         c%current = i
         c%resistance = r_spot
         c%voltage_gap = r_spot*i
         c%joule_heat = r_spot*i**2
      end associate
      ! each wire carries i/2, and the mean of its ends stands for its middle
      state%value(7, :) = [r_wire*i/4 + r_spot*i, -r_wire*i/4 + r_spot*i, -r_wire*i/4, r_wire*i/4]
      state%joule_heat = [r_wire, r_wire]*(i/2)**2
   end subroutine make_state

   !> Nothing is prescribed.
   subroutine make_loading(loading)
      type(loading_t), intent(out) :: loading

      allocate (loading%fixed(n_slots, 4), source=.false.)
      allocate (loading%value(n_slots, 4), loading%start_value(n_slots, 4), source=0.0_dp)
   end subroutine make_loading

   !> Whatever else is wrong.
   subroutine expect_rigid(state)
      type(state_t), intent(in) :: state

      audit = audit_increment(alone, model, state, loading, at_rest, scales)
      call expect(index(audit%finding, 'rigid body') == 0, 'the rigid body is in place: '//audit%finding)
   end subroutine expect_rigid

   subroutine expect_finding(state, text)
      type(state_t), intent(in) :: state
      character(len=*), intent(in) :: text

      audit = audit_increment(alone, model, state, loading, at_rest, scales)
      call expect(index(audit%finding, text) == 1, 'expected "'//text//'", found "'//audit%finding//'"')
   end subroutine expect_finding

   subroutine expect(holds, text)
      logical, intent(in) :: holds
      character(len=*), intent(in) :: text

      if (holds) return
      write (*, '(a)') text
      error stop
   end subroutine expect

end program test_audit
