!> The tangent that a run composes, against differences of the forces that it composes.
!>
!> Decks with every term that adds to the equations: beams of both types, conductors (current lengths too), contacts
!> with every normal law, spots, friction, several contacts on one element, damping, fixed moments, rigid bodies. Each
!> is brought to a converged state; from there all unknowns are moved at random, the section forces and the contact
!> forces are those of the moved state, and random directions are followed by differences of the sixth order.
!>
!> The forces are those of spins, the tangent is the Hessian for incremental rotation vectors: between them is half the
!> skew matrix of the moment that is left over (theory section 3). A run leaves one term out, which would make the
!> tangent unsymmetric: how the angle changes the force of a contact. With it the tangent is exact. The
!> force by which contacts resist to be bent otherwise (10.14b) is none here: its tangent, left out beyond 30 degrees,
!> has test_contact_bending, and that it is the force of the energy is seen in tests/system/test_bent_wires.py.
program test_tangents
   use litz_kinds, only: dp
   use litz_assembly, only: evaluate
   use litz_beam_term, only: beam_term_t
   use litz_contact_points, only: contact_point_t
   use litz_deck_reader, only: read_deck
   use litz_errors, only: error_t, error_list_t
   use litz_hertz, only: effective_modulus
   use litz_fields, only: n_slots, n_groups, field_rotation, first_slot, last_slot, fields, potential_slots, &
      temperature_slots
   use litz_initial_contacts, only: find_initial_overlap
   use litz_loading, only: load_targets
   use litz_law_input, only: wire_pair_t
   use litz_model, only: model_t
   use litz_newton, only: start_iterate
   use litz_normal_forces, only: wires_of
   use litz_problem, only: problem_t, prepare_problem
   use litz_rotations, only: cross
   use litz_sparse_pattern, only: csr_multiply
   use litz_surface_term, only: surface_term_t
   use litz_step_control, only: course_t
   use litz_superconductor, only: current_at
   use litz_steps, only: run_step, begin_step
   use silent_observer, only: silent_t
   implicit none

   character(len=*), parameter :: nl = new_line('a')
   character(len=*), parameter :: penalty = '*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR'//nl//'1e7'//nl
   character(len=*), parameter :: hertz = '*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ'//nl
   character(len=*), parameter :: yielding = '*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ, YIELD=1e8'//nl
   character(len=*), parameter :: rubbing = '*FRICTION'//nl//'0.01'//nl
   character(len=*), parameter :: spot = '*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ'//nl
   character(len=*), parameter :: penalty_of_line = '*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR'//nl//', 1e9'//nl
   !> Without the resistance in the elements, by which the currents of points depend on each other: how motions change
   !> that is not in the tangent
   character(len=*), parameter :: clean = '*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ, VOLTAGE=LINEAR'//nl
   !> Forces and moments on the reference nodes of rigid bodies
   character(len=*), parameter :: loads_of_bodies = '*CLOAD'//nl//'21, 4, 0.02'//nl//'21, 6, -0.03'//nl//'21, 2, 0.3' &
      //nl//'12, 5, 0.01'//nl//'12, 1, -0.2'//nl
   !> Differences are right to this part of the largest force that changes
   real(dp), parameter :: exact = 2.0e-7_dp
   !> The points at which the forces of a lens on a rigid surface are added up move with its ends, which the tangent
   !> leaves out: their sum hardly depends on where they are. Of elastic metal on the same plane that is 1e-3
   real(dp), parameter :: of_quadrature = 3.0e-3_dp
   !> Temperatures of all nodes of the wires, unlike each other
   character(len=*), parameter :: heat = '*TEMPERATURE'//nl//'1, 10'//nl//'2, 90'//nl//'3, 20'//nl//'4, 40'//nl// &
      '11, 5'//nl//'12, 60'//nl//'13, 10'//nl//'14, 80'//nl
   !> Card of the material that expands, and its data
   character(len=:), allocatable :: expansion, elasticity, conductivity
   !> Shapes of the sections of both wires, and their data
   character(len=:), allocatable :: section_a, section_b
   integer :: failures = 0, term
   !> Which terms of the list have added something in some deck
   logical, allocatable :: has_added(:)

   call start_random_numbers()
   expansion = ''
   section_a = 'CIRC'//nl//'1e-3'
   section_b = 'CIRC'//nl//'0.8e-3'
   elasticity = '1.1e11, 0.3'//nl
   conductivity = '5e7'//nl
   call check_terms('B33 and B31', 'B33', 'B31', penalty, '', '', exact)
   call check_terms('conductors and spots of a penalty', 'B33', 'B33', penalty//spot, '', '', exact)
   call check_terms('paper spot', 'B33', 'B31', penalty//'*GAP ELECTRICAL CONDUCTANCE, LAW=PAPER'//nl, '', '', exact)
   call check_terms('plastic spot', 'B33', 'B33', penalty//'*GAP ELECTRICAL CONDUCTANCE, LAW=PLASTIC'//nl//'1e9'//nl, &
      '', '', exact)
   call check_terms('film', 'B33', 'B33', penalty//'*GAP ELECTRICAL CONDUCTANCE, LAW=FILM'//nl//'1e-12'//nl, '', '', &
      exact)
   call check_terms('constant spot', 'B33', 'B33', penalty//'*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT'//nl//'1e-3' &
      //nl, '', '', exact)
   call check_terms('table of spots', 'B33', 'B33', penalty//'*GAP ELECTRICAL CONDUCTANCE, LAW=TABLE'//nl// &
      '0.01, 1e-2'//nl//'1000, 1e-4'//nl, '', '', exact)
   call check_terms('linear axes', 'B33', 'B33', penalty//spot, ', AXIS=LINEAR', '', exact)
   call check_terms('Hertz', 'B33', 'B31', hertz//spot, '', '', exact)
   call check_yielding('wires that yield', spot, [0.01_dp, 2.0_dp], exact)
   call check_yielding('wires in their dent', spot, [1.1_dp, 2.0_dp], exact)
   call check_yielding('film between wires that yield', '*GAP ELECTRICAL CONDUCTANCE, LAW=FILM'//nl//'1e-12'//nl, &
      [0.01_dp, 2.0_dp], exact)
   call check_yielding('kept spots in a dent', '*GAP ELECTRICAL CONDUCTANCE, LAW=HERTZ, SPOT=LARGEST FORCE'//nl, &
      [1.1_dp, 2.0_dp], exact)
   ! it would slip if it were moved as far as the others; what the motion since the increment began changes in the rows
   ! of the slip is left out: of the order of that motion over the radius
   call check_terms('friction that sticks', 'B33', 'B33', penalty//'*FRICTION'//nl//'0.8'//nl, '', '', 1.0e-4_dp, &
      0.01_dp)
   call check_terms('friction that slips', 'B33', 'B33', penalty//'*FRICTION'//nl//'1e-4'//nl, '', '', exact)
   call check_terms('fixed moments and forces', 'B31', 'B33', penalty, '', &
      '*CLOAD'//nl//'3, 4, 0.02'//nl//'3, 6, -0.03'//nl//'13, 5, 0.01'//nl//'4, 2, 0.3'//nl, exact)
   call check_terms('tied nodes', 'B31', 'B33', penalty//spot, '', loads_of_bodies, exact, bodies=bodies_of('TIE'))
   call check_terms('pinned nodes', 'B33', 'B33', penalty//spot, '', loads_of_bodies, exact, bodies=bodies_of('PIN'))
   call check_terms('tied nodes that stick', 'B33', 'B33', penalty//'*FRICTION'//nl//'0.8'//nl, '', loads_of_bodies, &
      1.0e-4_dp, 0.01_dp, bodies_of('TIE'))
   call check_terms('tied nodes that slip', 'B33', 'B33', penalty//'*FRICTION'//nl//'1e-4'//nl, '', loads_of_bodies, &
      exact, bodies=bodies_of('TIE'))
   call check_sections()
   ! each surface on a cantilever
   call check_terms('rigid surfaces', 'B33', 'B31', surfaces('PLANE', '0, 0, -1.02e-3, 2e-4, -0.005, 1'), '', '', &
      exact)
   call check_terms('drum', 'B33', 'B33', surfaces('CYLINDER', '0, 0, -6.12e-3, 0.9, 0.5, 0.05, 5e-3'), '', '', &
      exact)
   call check_terms('bore', 'B33', 'B33', surfaces('BORE', '0, 0, 8.93e-3, 1, 0.02, 0, 10e-3'), '', '', &
      exact)
   call check_surfaces_that_yield('plane, metal that yields', 'PLANE', '0, 0, -1.02e-3, 2e-4, -0.005, 1')
   call check_surfaces_that_yield('drum, metal that yields', 'CYLINDER', '0, 0, -6.12e-3, 0.9, 0.5, 0.05, 5e-3')
   call check_terms('plane with friction that sticks', 'B33', 'B31', surfaces('PLANE', &
      '0, 0, -1.02e-3, 2e-4, -0.005, 1', '0.8'), '', '', exact, 0.01_dp)
   call check_terms('drum with friction that slips', 'B33', 'B33', surfaces('CYLINDER', &
      '0, 0, -6.12e-3, 0.9, 0.5, 0.05, 5e-3', '1e-3'), '', '', exact)
   call check_terms('damping', 'B33', 'B33', penalty, '', '*CONTROLS, PARAMETERS=STABILIZE'//nl//'1e-3'//nl, exact)
   ! radii that change along the elements: what their change makes of the curvature of the gap is left out, of the order
   ! of the swelling over the length of an element
   expansion = '*EXPANSION'//nl//'17e-6'//nl
   call check_terms('heated wires', 'B33', 'B31', penalty//spot, '', heat, exact)
   call check_terms('heated wires, Hertz', 'B33', 'B33', hertz//spot, '', heat, exact)
   call check_terms('heated wires on a plane', 'B33', 'B31', surfaces('PLANE', '0, 0, -1.02e-3, 2e-4, -0.005, 1'), '', &
      heat, exact)
   expansion = ''
   call check_contacts_over_temperature()
   call check_heat('heat', '5e7'//nl, '390'//nl, ', STEADY STATE')
   call check_heat('heat over temperature', '9e7, 100'//nl//'2e7, 900'//nl, '430, 100'//nl//'350, 900'//nl, &
      ', STEADY STATE')
   call check_heat('heat over time', '9e7, 100'//nl//'2e7, 900'//nl, '430, 100'//nl//'350, 900'//nl, '')
   call check_heat_of_contacts('heat through contacts', spot)
   call check_heat_of_contacts('heat through metal', spot//'*GAP CONDUCTANCE, LAW=METAL'//nl)
   call check_heat_of_contacts('heat through a Wiedemann-Franz metal', spot//'*GAP CONDUCTANCE, LAW=METAL, '// &
      'LORENZ=2.4e-8'//nl)
   call check_heat_of_contacts('heat through a film', '*GAP ELECTRICAL CONDUCTANCE, LAW=FILM'//nl//'1e-13'//nl)
   call check_heat_of_contacts('heat of given resistances', '*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT'//nl//'1e-3'// &
      nl//'*GAP CONDUCTANCE, LAW=CONSTANT'//nl//'0.05'//nl)
   call check_heat_of_contacts('heat through contacts over time', spot, '')
   call check_heat_of_contacts('heat over force', '*GAP CONDUCTANCE, LAW=TABLE'//nl//'0.01, 0.02'//nl//'1000, 2'//nl)
   call check_coupled_steps()
   call check_heat_of_friction('heat of friction, Hertz', hertz//rubbing, exact)
   call check_heat_of_friction('heat of friction, penalty', penalty//rubbing, exact)
   call check_heat_of_friction('heat of friction between wires that pass heat', hertz//rubbing//'*GAP CONDUCTANCE, '// &
      'LAW=CONSTANT'//nl//'1e-6'//nl, exact)
   ! what sticks while the wires get softer gives way: of the order of the elastic slip over the slip
   elasticity = '1.2e11, 0.3, -100'//nl//'0.8e11, 0.35, 300'//nl
   call check_heat_of_friction('heat of friction, softening', hertz//rubbing, 1.0e-5_dp)
   elasticity = '1.1e11, 0.3'//nl
   call check_superconductors()
   call check_heat_of_friction('heat of friction on a plane', surfaces('PLANE', &
      '0, 0, -1.02e-3, 2e-4, -0.005, 1', '1e-2'), exact)
   call check_heat_of_friction('heat of friction on a drum', surfaces('CYLINDER', &
      '0, 0, -6.12e-3, 0.9, 0.5, 0.05, 5e-3', '1e-2'), exact)
   call note_rubbed_surface()
   call check_yielding('wires turned in their dent', spot, [3.0_dp, 1.03_dp], exact/4)
   call check_yielding('long spot of wires turned in their dent', spot, [3.0_dp, 1.12_dp], exact/4, &
      '11, -0.028, -0.013, 0.002'//nl//'12, -0.01, -0.0045, 0.0019'//nl//'13, 0.009, 0.0042, 0.002'//nl// &
      '14, 0.028, 0.012, 0.002'//nl)
   call check_lines('line of a penalty', penalty_of_line//clean, 0.0_dp, 3.0e-5_dp, 0.02_dp)
   call check_lines('line of Hertz', hertz//clean, 0.0_dp, 4.0e-6_dp, 0.1_dp)
   call check_lines('short lap', hertz, 0.0_dp, 4.0e-6_dp, 0.05_dp, shift=0.019_dp)
   call check_lines('lap of wires that nearly end together', hertz, 0.0_dp, 4.0e-6_dp, 0.05_dp, shift=0.00095_dp)
   call check_lines('line with a film', hertz//'*GAP ELECTRICAL CONDUCTANCE, LAW=FILM, VOLTAGE=LINEAR'//nl//'1e-12' &
      //nl, 0.0_dp, 4.0e-6_dp, 0.1_dp)
   call check_lines('bow over a straight wire, penalty', penalty_of_line//clean, 5.0_dp, 3.0e-5_dp, 0.01_dp)
   call check_lines('bow over a straight wire, Hertz', hertz//clean, 5.0_dp, 1.2e-5_dp, 0.02_dp)
   call check_lines('bow over a straight wire, given conductance', hertz//'*GAP ELECTRICAL CONDUCTANCE, '// &
      'LAW=CONSTANT, PER=LENGTH, VOLTAGE=LINEAR'//nl//'1e-7'//nl, 5.0_dp, 1.2e-5_dp, 0.02_dp)
   call check_lines('bow over a straight wire, spots of the largest force', hertz//'*GAP ELECTRICAL CONDUCTANCE, '// &
      'LAW=HERTZ, VOLTAGE=LINEAR, SPOT=LARGEST FORCE'//nl, 5.0_dp, 1.2e-5_dp, 0.02_dp)
   call check_lines('bow over a straight wire, wires that yield', hertz//'*GAP ELECTRICAL CONDUCTANCE, '// &
      'LAW=PLASTIC, VOLTAGE=LINEAR'//nl//'1e9'//nl, 1.0_dp, 1.2e-5_dp, 0.02_dp)
   call check_lines('bow over a straight wire, spots of a larger force', hertz// &
      '*GAP ELECTRICAL CONDUCTANCE, LAW=PLASTIC, VOLTAGE=LINEAR, SPOT=LARGEST FORCE'//nl//'1e9'//nl, 1.0_dp, &
      1.2e-5_dp, 0.02_dp, 2.0_dp)
   ! how the pull on the ends of a line changes with a dent that grows is left out; a lens in its dents has its slopes
   ! from differences
   call check_lines('line of wires that yield', yielding//clean, 0.0_dp, 4.0e-6_dp, 0.02_dp, 0.01_dp, &
      tolerance=1.0e-5_dp)
   ! the force of a place in its dent is found to 1e-9, which shorter differences would magnify
   call check_lines('line of wires in their dents', yielding//clean, 0.0_dp, 4.0e-6_dp, 0.002_dp, 1.2_dp, &
      steps=4.0e-3_dp)
   call check_lines('bow over a straight wire that yields', yielding//clean, 5.0_dp, 1.2e-5_dp, 0.005_dp, 0.01_dp)
   call check_lines('bow over a straight wire, in its dents', yielding//clean, 5.0_dp, 1.2e-5_dp, 0.002_dp, 1.1_dp, &
      tolerance=1.0e-6_dp)
   call check_lines('film between wires that yield along a line', yielding//'*GAP ELECTRICAL CONDUCTANCE, '// &
      'LAW=FILM, VOLTAGE=LINEAR'//nl//'1e-12'//nl, 0.0_dp, 4.0e-6_dp, 0.02_dp, 0.01_dp, tolerance=1.0e-5_dp)
   call check_lines('line that sticks', hertz//'*FRICTION'//nl//'1e3'//nl, 0.0_dp, 4.0e-6_dp, 0.02_dp)
   call check_lines('line of a penalty that sticks', penalty_of_line//'*FRICTION, ELASTIC SLIP=1e-7'//nl//'1e3'//nl, &
      1.0_dp, 3.5e-5_dp, 0.01_dp)
   call check_lines('line that slips', hertz//'*FRICTION'//nl//'1e-4'//nl, 0.0_dp, 4.0e-6_dp, 0.02_dp)
   call check_lines('bow that slips on a straight wire', hertz//'*FRICTION'//nl//'1e-4'//nl, 5.0_dp, 1.2e-5_dp, 0.02_dp)
   call check_ends('end on a wire', hertz//spot, 'end', 'A, B')
   call check_ends('end of the barred wire on a wire', hertz//spot, 'end', 'B, A')
   call check_ends('end that sticks', hertz//'*FRICTION'//nl//'1e3'//nl, 'end', 'A, B')
   call check_ends('end of the barred wire that sticks', penalty//'*FRICTION, ELASTIC SLIP=1e-7'//nl//'1e3'//nl, &
      'end', 'B, A')
   call check_ends('end that slips', hertz//'*FRICTION'//nl//'1e-4'//nl, 'end', 'A, B')
   call check_ends('end of the barred wire that slips', hertz//'*FRICTION'//nl//'1e-4'//nl, 'end', 'B, A')
   call check_ends('kink on a wire', hertz//spot, 'kink', 'A, B')
   call check_ends('kink that slips', hertz//'*FRICTION'//nl//'1e-4'//nl, 'kink', 'A, B')
   call check_ends('thin leg next to a joint', hertz//spot, 'leg', 'AC, B')
   call check_ends('thin leg of the unbarred wire next to a joint', hertz//spot, 'leg', 'B, AC')
   call check_ends('end on an end', penalty_of_line//clean, 'tips', 'A, B')
   call check_ends('end on an end that slips', hertz//'*FRICTION'//nl//'1e-4'//nl, 'tips', 'A, B')
   ! contacts that slide off an end, of which that cuts a part: crossings, ends, and where both wires end
   call check_ends('crossing next to an end', hertz//spot, 'before', 'A, B')
   call check_ends('crossing next to the end of the barred wire', hertz//clean, 'before', 'B, A')
   call check_ends('crossing next to an end, penalty', penalty_of_line//clean, 'before', 'A, B')
   call check_ends('end next to the side of a wire', hertz//spot, 'behind', 'A, B')
   call check_ends('end next to the side of the barred wire', hertz//clean, 'behind', 'B, A')
   call check_ends('end next to the side of a wire, penalty', penalty_of_line//clean, 'behind', 'A, B')
   call check_ends('crossing next to two ends', hertz//spot, 'before both', 'A, B')
   call check_ends('end next to another one', hertz//spot, 'behind one', 'A, B')
   call check_ends('end on an end next to both sides', penalty_of_line//clean, 'behind both', 'A, B')
   call check_ends('end on an end next to both sides, Hertz', hertz//spot, 'behind both', 'A, B')
   ! wires side by side that lead opposite ways, and lean on each other
   call check_ends('end beside that of the other wire', hertz//spot, 'beside end', 'A, B')
   call check_ends('end beside that of the other wire, penalty', penalty_of_line//clean, 'beside end', 'B, A')
   call check_ends('end beyond that of the other wire', hertz//spot, 'beyond end', 'A, B')
   call check_ends('end beyond that of the other wire, penalty', penalty_of_line//clean, 'beyond end', 'B, A')
   call check_ends('end next to the side of a straight axis', hertz, 'behind', 'A, B', ', AXIS=LINEAR')
   call check_ends('end on a rigid plane', surfaces('PLANE', '4.459e-4, 0, -8.918e-4, -0.5, 0, 1'), 'tips', 'A, B')
   call check_element_loads()
   call check_equations()
   call check_flows_to_surfaces('CONSTANT', '1e-3'//nl, 'CONSTANT', '20'//nl)
   call check_flows_to_surfaces('TABLE', '10, 1e-3'//nl//'1e4, 2e-4'//nl, 'TABLE', '10, 2'//nl//'1e4, 30'//nl)
   do term = 1, size(has_added)
      if (has_added(term)) cycle
      failures = failures + 1
      print '(a, i0, a)', 'failed: term ', term, ' of litz_term_list adds nothing in any of these decks'
   end do
   if (failures > 0) error stop 1

contains

   !> Two wires pressed together, each clamped or led at its ends, with a current from one to the other.
   function deck_of(type_1, type_2, laws, options, loads, bodies, upper) result(deck)
      character(len=*), intent(in) :: type_1, type_2, laws, options, loads, bodies
      !> Lines of the nodes of the upper wire; absent: it crosses at about a right angle
      character(len=*), intent(in), optional :: upper
      character(len=:), allocatable :: deck

      deck = '*NODE'//nl//'1, -0.03, 0, 0'//nl//'2, -0.012, 0, 0'//nl//'3, 0.009, 0.001, 0'//nl//'4, 0.03, 0, 0'//nl
      if (present(upper)) then
         deck = deck//upper
      else
         deck = deck//'11, 0.003, -0.03, 0.002'//nl//'12, 0, -0.008, 0.0019'//nl//'13, 0, 0.011, 0.002'//nl// &
            '14, -0.001, 0.03, 0.002'//nl
      end if
      deck = deck//elements_and_contact(type_1, type_2, options, laws)//bodies//'*BOUNDARY'//nl//'1, 1, 6'//nl// &
         '4, 1, 6'//nl
      deck = deck//step_of(-4.0e-4_dp, '')//step_of(-5.0e-4_dp, loads)
   end function deck_of

   !> A wire above another one and along it, in a bow above its middle; the nodes do not match.
   function deck_along(laws, bow, push, loads, shift) result(deck)
      !> The loads are those of the second step
      character(len=*), intent(in) :: laws, loads
      !> Curvature of the upper wire [1/m], and how far its ends are lowered [m]
      real(dp), intent(in) :: bow, push
      !> How far the upper wire is moved along the lower one [m]
      real(dp), intent(in) :: shift
      character(len=:), allocatable :: deck
      character(len=64) :: node
      real(dp), parameter :: x(4) = [-0.010_dp, -0.003_dp, 0.005_dp, 0.011_dp]
      integer :: i

      deck = '*NODE'//nl//'1, -0.012, 0, 0'//nl//'2, -0.004, 0, 0'//nl//'3, 0.004, 0, 0'//nl//'4, 0.012, 0, 0'//nl
      do i = 1, 4
         write (node, '(i0, ", ", es24.16, ", 0, ", es24.16)') 10 + i, x(i) + shift, 1.8e-3_dp + bow*x(i)**2/2
         deck = deck//trim(node)//nl
      end do
      deck = deck//elements_and_contact('B33', 'B33', '', laws)//'*BOUNDARY'//nl//'1, 1, 6'//nl//'4, 1, 6'//nl// &
         step_of(-push, '')//step_of(-1.25_dp*push, loads)
   end function deck_along

   !> A wire whose end is lowered on another one, or meets its end; or one that is lowered on the kink of another.
   function deck_at_end(laws, place, pair, options) result(deck)
      !> `end`, `tips`, `kink`, `leg` next to a kink, or where a wire crosses another one next to its end; and the data
      !> line of the contact pair
      character(len=*), intent(in) :: laws, place, pair
      !> Parameters of the interaction
      character(len=*), intent(in), optional :: options
      character(len=:), allocatable :: deck
      character(len=*), parameter :: cantilever = '*NODE'//nl//'1, -0.03, 0, 0'//nl//'2, -0.02, 0.001, 0'//nl// &
         '3, -0.01, 0.001, 0'//nl//'4, 0, 0, 0'//nl
      character(len=:), allocatable :: cards
      character(len=12) :: number
      logical :: both

      select case (place)
      case ('end')
         deck = '*NODE'//nl//'1, -0.03, 0, 0'//nl//'2, -0.012, 0, 0'//nl//'3, 0.009, 0.001, 0'//nl//'4, 0.03, 0, 0'// &
            nl//'11, 0.012, 0.009, 0.016'//nl//'12, 0.009, 0.006, 0.0112'//nl//'13, 0.005, 0.003, 0.0065'//nl// &
            '14, 0.001, 0.0004, 0.0018'//nl
      case ('tips')
         deck = '*NODE'//nl//'1, -0.03, 0, 0'//nl//'2, -0.02, 0, 0'//nl//'3, -0.01, 0.001, 0'//nl//'4, 0, 0, 0'// &
            nl//'11, 0.02, 0.009, 0.016'//nl//'12, 0.014, 0.006, 0.0112'//nl//'13, 0.008, 0.003, 0.0065'//nl// &
            '14, 0.0009, 0.0004, 0.0016'//nl
      case ('before', 'behind')
         deck = cantilever//nodes_across(merge(3.0e-6_dp, 2.0e-5_dp, place == 'before'), 0.02_dp)
      case ('before both', 'behind one', 'behind both')
         deck = cantilever//nodes_across(merge(-2.1e-6_dp, 2.0e-5_dp, place == 'before both'), &
            merge(-3.0e-5_dp, 2.0e-5_dp, place == 'behind both'))
      case ('beside end', 'beyond end')
         write (number, '(es12.4)') merge(2.0e-5_dp, -1.5e-4_dp, place == 'beyond end')
         deck = '*NODE'//nl//'1, -0.03, 0, 0'//nl//'2, -0.02, 0, 0'//nl//'3, -0.01, 1e-4, 0'//nl//'4, 0, 0, 0'//nl// &
            '11, 0.02, 2e-4, 0.0022'//nl//'12, 0.014, 1e-4, 0.00208'//nl//'13, 0.008, 1e-4, 0.00196'//nl// &
            '14, '//number//', 0, 0.0018'//nl
      case ('leg')
         deck = '*NODE'//nl//'1, -0.02, 0, -0.008'//nl//'2, -0.008, 0.001, -0.0032'//nl//'3, 0, 0, 0'//nl// &
            '4, 0.02, 0, -0.008'//nl//'11, 0.0012, -0.02, 0.00142'//nl//'12, 0.001, -0.006, 0.00142'//nl// &
            '13, 0.0011, 0.008, 0.00142'//nl//'14, 0.0009, 0.02, 0.00142'//nl
      case ('kink')
         deck = '*NODE'//nl//'1, -0.02, 0, -0.008'//nl//'2, -0.008, 0.001, -0.0032'//nl//'3, 0, 0, 0'//nl// &
            '4, 0.02, 0, -0.008'//nl//'11, 0.0002, -0.02, 0.00185'//nl//'12, -0.0002, -0.006, 0.00185'//nl// &
            '13, 0.0001, 0.008, 0.00185'//nl//'14, -0.0003, 0.02, 0.00185'//nl
      end select
      cards = ''
      if (present(options)) cards = options
      deck = deck//elements_and_contact('B33', 'B33', cards, laws, pair)//'*BOUNDARY'//nl//'1, 1, 6'//nl
      if (any(place == [character(len=4) :: 'end', 'kink', 'leg'])) deck = deck//'4, 1, 6'//nl
      both = any(place == [character(len=6) :: 'kink', 'leg', 'before', 'behind'])
      deck = deck//step_of(-2.0e-4_dp, '', both)//step_of(-2.4e-4_dp, '', both)
   end function deck_at_end

   !> A wire that touches another one from above, and leads across it.
   function nodes_across(x, end) result(cards)
      !> Where it crosses the x axis, and how far it goes on along y [m]
      real(dp), intent(in) :: x, end
      character(len=:), allocatable :: cards
      character(len=80) :: line
      real(dp) :: y(4)
      integer :: i

      y = [-0.02_dp, -0.009_dp, merge(-0.002_dp, 0.006_dp, end < 0.01_dp), end]
      cards = ''
      do i = 1, 4
         write (line, '(i0, 3(a, es14.6))') 10 + i, ',', x + 0.3_dp*y(i), ',', y(i), ',', 1.8e-3_dp
         cards = cards//trim(line)//nl
      end do
   end function nodes_across

   !> The elements of two wires of four nodes each, and their contact.
   function elements_and_contact(type_1, type_2, options, laws, pair) result(cards)
      character(len=*), intent(in) :: type_1, type_2, options, laws
      !> The data line of the contact pair, if it is not `A, B`
      character(len=*), intent(in), optional :: pair
      character(len=:), allocatable :: cards, names

      names = 'A, B'
      if (present(pair)) names = pair

      cards = '*ELEMENT, TYPE='//type_1//', ELSET=A'//nl//'1, 1, 2'//nl//'2, 2, 3'//nl
      ! a leg of its own
      if (index(names, 'C') > 0) cards = cards//'*BEAM SECTION, ELSET=C, MATERIAL=M, SECTION=CIRC'//nl//'0.7e-3'//nl// &
         '*ELSET, ELSET=AC'//nl//'1, 2, 3'//nl//'*ELEMENT, TYPE='//type_1//', ELSET=C'//nl
      cards = cards//'3, 3, 4'//nl// &
         '*ELEMENT, TYPE='//type_2//', ELSET=B'//nl//'11, 11, 12'//nl//'12, 12, 13'//nl//'13, 13, 14'//nl// &
         '*MATERIAL, NAME=M'//nl//'*ELASTIC'//nl//elasticity//expansion// &
         '*ELECTRICAL CONDUCTIVITY'//nl//conductivity// &
         '*BEAM SECTION, ELSET=A, MATERIAL=M, CONTACT RADIUS=1e-3, SECTION='//section_a//nl// &
         '*BEAM SECTION, ELSET=B, MATERIAL=M, CONTACT RADIUS=0.8e-3, SECTION='//section_b//nl// &
         '*SURFACE INTERACTION, NAME=T'//options//nl//laws//'*CONTACT PAIR, INTERACTION=T'//nl//names//nl
   end function elements_and_contact

   !> Two rigid bodies, with a node on each of the elements that touch: one whose reference node is outside the wires,
   !> and one whose reference node is the other node of the element.
   function bodies_of(kind) result(cards)
      character(len=*), intent(in) :: kind
      character(len=:), allocatable :: cards

      cards = '*NODE'//nl//'21, 0.004, 0.006, -0.005'//nl//'*NSET, NSET=N2'//nl//'2'//nl//'*NSET, NSET=N3'//nl//'3'// &
         nl//'*NSET, NSET=N13'//nl//'13'//nl//'*RIGID BODY, REF NODE=21, '//kind//' NSET=N3'
      ! what is pinned at one point only may turn about it
      if (kind == 'PIN') cards = cards//', TIE NSET=N2'
      cards = cards//nl//'*RIGID BODY, REF NODE=12, '//kind//' NSET=N13'//nl
   end function bodies_of
   !> A rigid surface on a cantilever, below the lower wire.
   function surfaces(shape, place, friction, law) result(words)
      character(len=*), intent(in) :: shape, place
      character(len=*), intent(in), optional :: friction
      !> Of the surface; absent: a penalty
      character(len=*), intent(in), optional :: law
      character(len=:), allocatable :: words

      words = penalty//'*SURFACE INTERACTION, NAME=F'//nl
      if (present(friction)) words = words//'*FRICTION, STICK STIFFNESS=1e5'//nl//friction//nl
      if (present(law)) then
         words = words//law
      else
         words = words//'*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR'//nl//'1e7, 1e10'//nl
      end if
      words = words//'*NODE'//nl//'21, 0.002, 0.003, -0.004'//nl//'22, 0.01, 0.02, -0.03'//nl// &
         '*ELEMENT, TYPE=B33, ELSET=C'//nl//'21, 21, 22'//nl//'*MATERIAL, NAME=INSULATOR'//nl//'*ELASTIC'//nl// &
         '1e11, 0.3'//nl// &
         '*BEAM SECTION, ELSET=C, MATERIAL=INSULATOR, SECTION=CIRC'//nl// &
         '2e-3'//nl//'*RIGID SURFACE, NAME=S, REF NODE=21, TYPE='//shape//nl//place//nl// &
         '*CONTACT PAIR, INTERACTION=F'//nl//'A, S'//nl//'*BOUNDARY'//nl//'22, 1, 6'//nl
   end function surfaces

   function step_of(push, loads, both_ends) result(step)
      real(dp), intent(in) :: push
      character(len=*), intent(in) :: loads
      !> The second wire is led at both of its ends; absent: it is
      logical, intent(in), optional :: both_ends
      character(len=:), allocatable :: step
      character(len=24) :: number
      logical :: both

      both = .true.
      if (present(both_ends)) both = both_ends
      write (number, '(es12.4)') push
      step = '*STEP, INC=200'//nl//'*STATIC'//nl//'0.25, 1.'//nl//loads//'*BOUNDARY'//nl//'11, 1, 2'//nl// &
         '11, 4, 6'//nl//'11, 3, 3, '//number//nl
      if (both) step = step//'14, 1, 2'//nl//'14, 4, 6'//nl//'14, 3, 3, '//number//nl
      step = step//'1, 9, 9, 0.001'//nl//'11, 9, 9, 0'//nl//'*END STEP'//nl
   end function step_of

   subroutine check_terms(name, type_1, type_2, laws, options, loads, tolerance, part, bodies, coupled_step)
      character(len=*), intent(in) :: name, type_1, type_2, laws, options, loads
      real(dp), intent(in) :: tolerance
      !> Of the usual random motion
      real(dp), intent(in), optional :: part
      !> Cards of rigid bodies
      character(len=*), intent(in), optional :: bodies
      !> Motions and potentials are in one Newton step; absent: they are not
      logical, intent(in), optional :: coupled_step
      type(problem_t) :: problem
      character(len=:), allocatable :: cards
      real(dp) :: motion
      integer :: trial

      motion = 1
      if (present(part)) motion = part
      cards = ''
      if (present(bodies)) cards = bodies
      call solve_first_step(deck_of(type_1, type_2, laws, options, loads, cards), problem)
      if (present(coupled_step)) problem%coupled_step = coupled_step
      do trial = 1, 3
         call compare(name, problem, tolerance, motion)
      end do
      call note_terms(problem)
   end subroutine check_terms

   !> An element on a surface, on the loading curve and in the dents of overlaps that were 3 % deeper.
   subroutine check_surfaces_that_yield(name, shape, place)
      character(len=*), intent(in) :: name, shape, place
      type(problem_t) :: problem
      integer :: trial, i

      call solve_first_step(deck_of('B33', 'B33', surfaces(shape, place, law=yielding), '', '', ''), problem)
      do trial = 1, 2
         call compare(name, problem, of_quadrature, 0.01_dp)
         select type (surfaces => problem%terms(2)%term)
         type is (surface_term_t)
            call check(any(surfaces%cells%dents%dissipation > 0), name//': metal that has yielded', 0.0_dp)
            do i = 1, size(surfaces%cells)
               associate (deepest => surfaces%cells(i)%dents%deepest)
                  deepest = 1.03_dp*deepest
               end associate
               if (allocated(surfaces%cells(i)%yielding%dent)) deallocate (surfaces%cells(i)%yielding%dent)
            end do
         end select
      end do
   end subroutine check_surfaces_that_yield

   !> Crossed wires whose dents are those of forces larger or smaller than the present ones.
   subroutine check_yielding(name, law_of_spot, larger, tolerance, upper)
      character(len=*), intent(in) :: name, law_of_spot
      !> Times the present force and overlap are those of the dent (2)
      real(dp), intent(in) :: larger(2)
      !> Of the largest force that changes
      real(dp), intent(in) :: tolerance
      !> As in `deck_of`
      character(len=*), intent(in), optional :: upper
      type(problem_t) :: problem
      integer :: trial

      call solve_first_step(deck_of('B33', 'B33', '*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HERTZ, YIELD=1e8'//nl// &
         law_of_spot, '', '', '', upper), problem)
      associate (dent => problem%contact%converged%history%dent)
         dent%force = larger(1)*dent%force
         dent%overlap = larger(2)*dent%overlap
      end associate
      ! what sticks is tested below
      problem%contact%converged%history%ploughing = 0
      do trial = 1, 3
         ! where the dent of the angle is, is found to fewer digits than the forces have
         call compare(name, problem, tolerance, 0.01_dp, 1.0e-2_dp)
         call check(any(problem%contact%points%closed .and. have_yielded(problem%contact%points)), &
            name//': metal that has yielded', 0.0_dp)
         call check(any(problem%contact%points%closed .and. (problem%contact%points%force < &
            problem%contact%points%weight*problem%contact%points%felt_force .eqv. all(larger > 1))), &
            name//': on the way back or not', problem%contact%points(1)%felt_force)
      end do
   end subroutine check_yielding

   elemental logical function have_yielded(point)
      type(contact_point_t), intent(in) :: point

      have_yielded = allocated(point%yielding)
      if (have_yielded) have_yielded = point%yielding%dissipation > 0
   end function have_yielded

   !> Contacts whose resistivities are those of the temperatures of their places, which move with them; and whose
   !> elasticity is.
   subroutine check_contacts_over_temperature()
      conductivity = '8e7, 0'//nl//'2e7, 100'//nl
      call check_terms('resistivity of places, paper', 'B33', 'B31', penalty//'*GAP ELECTRICAL CONDUCTANCE, LAW=PAPER' &
         //nl, '', heat, exact)
      call check_terms('resistivity of places, Hertz', 'B33', 'B33', hertz//spot, '', heat, exact)
      call check_terms('resistivity of places, plastic', 'B33', 'B33', penalty// &
         '*GAP ELECTRICAL CONDUCTANCE, LAW=PLASTIC'//nl//'1e9'//nl, '', heat, exact)
      call check_terms('resistivity of places, film', 'B33', 'B33', hertz//'*GAP ELECTRICAL CONDUCTANCE, LAW=FILM'//nl &
         //'1e-12'//nl, '', heat, exact)
      call check_lines('resistivity of places, line', hertz//clean, 0.0_dp, 4.0e-6_dp, 0.1_dp, loads=heat)
      call check_lines('resistivity of places, line of metal that yields', hertz//'*GAP ELECTRICAL CONDUCTANCE, '// &
         'LAW=PLASTIC, VOLTAGE=LINEAR'//nl//'1e9'//nl, 5.0_dp, 1.2e-5_dp, 0.02_dp, loads=heat)
      elasticity = '1.2e11, 0.3, 0'//nl//'0.8e11, 0.35, 100'//nl
      call check_terms('elasticity of places', 'B33', 'B33', hertz//spot, '', heat, exact)
      elasticity = '1.1e11, 0.3'//nl
      conductivity = '5e7'//nl
   end subroutine check_contacts_over_temperature

   !> Wires that touch along a line, `part` of the usual random motion away from equilibrium.
   subroutine check_lines(name, laws, bow, push, part, larger, loads, tolerance, steps, shift)
      character(len=*), intent(in) :: name, laws
      real(dp), intent(in) :: bow, push, part
      !> Times the present one are the largest forces that places remember, and dents; absent: 1
      real(dp), intent(in), optional :: larger
      !> Cards of the second step
      character(len=*), intent(in), optional :: loads
      !> Of the largest force that changes; absent: `exact`
      real(dp), intent(in), optional :: tolerance
      !> As in `compare`
      real(dp), intent(in), optional :: steps
      !> Of the upper wire along the lower one [m]
      real(dp), intent(in), optional :: shift
      type(problem_t) :: problem
      character(len=:), allocatable :: cards
      real(dp) :: right, along
      integer :: trial

      cards = ''
      if (present(loads)) cards = loads
      along = 0
      if (present(shift)) along = shift
      right = exact
      if (present(tolerance)) right = tolerance
      ! the same motions whatever was checked before: none of them brings a place to the verge of touching
      call start_random_numbers()
      call solve_first_step(deck_along(laws, bow, push, cards, along), problem)
      if (present(larger)) then
         associate (history => problem%contact%converged_line_points%history)
            history%largest_force = larger*history%largest_force
            history%dent%force = larger*history%dent%force
         end associate
         associate (dent => problem%contact%converged%history%dent)
            dent%force = larger*dent%force
            dent%overlap = larger*dent%overlap
         end associate
      end if
      do trial = 1, 3
         call compare(name, problem, right, part, steps)
         call check(count(problem%contact%line_points%closed) > 1, name//': points of a line in contact', 0.0_dp)
      end do
   end subroutine check_lines

   !> Wires that touch with an end or at a kink.
   subroutine check_ends(name, laws, place, pair, options)
      character(len=*), intent(in) :: name, laws, place, pair
      !> Parameters of the interaction
      character(len=*), intent(in), optional :: options
      type(problem_t) :: problem
      integer :: trial, i

      call start_random_numbers()
      call solve_first_step(deck_at_end(laws, place, pair, options), problem)
      do trial = 1, 3
         call compare(name, problem, exact, 0.01_dp, merge(0.01_dp, 1.0e-3_dp, place(1:2) == 'be'))
         select type (surfaces => problem%terms(2)%term)
         type is (surface_term_t)
            if (any([(any(surfaces%cells(i)%law_of_end > 0) .and. surfaces%cells(i)%force > 0, &
               i=1, size(surfaces%cells))])) cycle
         end select
         associate (points => problem%contact%points)
            if (place(1:2) == 'be') then
               call check(any([(maxval(abs(points(i)%slide_force)) > 1.0e-6_dp*points(i)%force .and. &
                  count(points(i)%held) == held_of(place), i=1, size(points))]), name//': cut by an end', 0.0_dp)
            else if (place == 'leg') then
               call check(any([(maxval(abs(points(i)%ball_slope)) > 0.1_dp .and. points(i)%closed, &
                  i=1, size(points))]), name//': a radius that changes', 0.0_dp)
            else
               call check(any([(any(points(i)%held) .and. points(i)%closed, i=1, size(points))]), &
                  name//': an end in contact', 0.0_dp)
            end if
         end associate
      end do
   end subroutine check_ends

   !> At how many ends the contact is.
   integer function held_of(place)
      !> As in `deck_at_end`
      character(len=*), intent(in) :: place

      held_of = 1
      if (place(1:6) == 'before') held_of = 0
      if (place == 'behind both' .or. place == 'beyond end') held_of = 2
   end function held_of

   !> Steps that solve for motions, potentials and temperatures at once: all blocks of the tangent.
   subroutine check_coupled_steps()
      character(len=*), parameter :: warm = '*CONDUCTIVITY'//nl//'430, 100'//nl//'350, 900'//nl
      character(len=*), parameter :: sigma = '9e7, 100'//nl//'2e7, 900'//nl

      expansion = warm//'*EXPANSION, ZERO=250'//nl//'17e-6, 100'//nl//'25e-6, 900'//nl
      conductivity = sigma
      call check_coupled('coupled, Hertz', 'B33', hertz//spot, exact)
      call check_coupled('coupled, metal', 'B31', hertz//spot//'*GAP CONDUCTANCE, LAW=METAL'//nl, exact)
      call check_coupled('coupled, film', 'B33', hertz//'*GAP ELECTRICAL CONDUCTANCE, LAW=FILM'//nl//'1e-13'//nl, exact)
      call check_coupled('coupled, heat over force', 'B33', hertz//'*GAP CONDUCTANCE, LAW=TABLE'//nl//'0.01, 0.02'// &
         nl//'1000, 2'//nl, exact)
      call check_coupled('coupled, heat alone', 'B33', hertz//'*GAP CONDUCTANCE, LAW=CONDUCTIVITY'//nl, exact)
      call check_coupled('coupled, friction that slips', 'B33', hertz//spot//'*FRICTION'//nl//'1e-4'//nl, exact)
      call check_shared('coupled, contacts on one element', spot)
      ! how swelling moves places along the wires is left out, of the order of a thermal strain
      call check_strips('coupled, a line', spot, 'B, C', 1.0e-5_dp)
      call check_strips('coupled, a line of a given conductance', '*GAP ELECTRICAL CONDUCTANCE, LAW=CONSTANT, '// &
         'PER=LENGTH'//nl//'1e-7'//nl, 'B, C', 1.0e-5_dp)
      ! how motions change what strips beside each other do to each other is left out
      call check_strips('coupled, strips beside each other', spot, 'A, C', 1.0e-4_dp)
      ! how the conductivity changes what the film takes of the heat of contacts is left out
      expansion = '*CONDUCTIVITY'//nl//'400'//nl//'*EXPANSION, ZERO=250'//nl//'17e-6, 100'//nl//'25e-6, 900'//nl
      call check_shared('coupled, contacts on one element in a film', spot, loads='*FILM'//nl//'A, F, 290, 2e4'//nl// &
         'B, F, 310, 1e4'//nl)
      expansion = warm//'*EXPANSION, ZERO=250'//nl//'17e-6, 100'//nl//'25e-6, 900'//nl
      ! the arms of friction, which grow with the radius, are left out: a thermal strain of 1e-5 of its moments
      call check_coupled('coupled, a plane with friction that sticks', 'B33', surfaces('PLANE', &
         '0, 0, -1.02e-3, 2e-4, -0.005, 1', '0.8'), 1.0e-5_dp)
      call check_coupled('coupled, a drum with friction that slips', 'B33', surfaces('CYLINDER', &
         '0, 0, -6.12e-3, 0.9, 0.5, 0.05, 5e-3', '1e-3'), exact)
      elasticity = '1.2e11, 0.3, 200'//nl//'0.8e11, 0.35, 600'//nl
      call check_coupled('coupled, softening', 'B33', hertz//spot, exact)
      call check_coupled('coupled, softening, B31', 'B31', penalty//spot, exact)
      elasticity = '1.1e11, 0.3'//nl
      conductivity = '5e7'//nl
      expansion = ''
   end subroutine check_coupled_steps

   !> Unknowns that linear equations eliminate: of one node and of several, displacements by rotations, rotations of two
   !> nodes that turn alike, of single axes, of reference nodes of rigid bodies, potentials and temperatures;
   !> and motions along local axes.
   subroutine check_equations()
      character(len=*), parameter :: motions = '*EQUATION'//nl//'3'//nl//'3, 1, 2, 2, 1, -1'//nl//'2, 4, 0.001'//nl// &
         '2'//nl//'12, 3, 1, 13, 3, -0.5'//nl//'2'//nl//'2, 2, 1, 13, 2, 0.2'//nl
      character(len=*), parameter :: alike = '2'//nl//'13, 4, 1, 12, 4, -1'//nl//'2'//nl//'13, 5, 1, 12, 5, -1'//nl// &
         '2'//nl//'13, 6, 1, 12, 6, -1'//nl, single = '2'//nl//'3, 5, 1, 2, 6, -0.4'//nl//'2'//nl// &
         '13, 6, 1, 2, 6, -1'//nl, potentials = '2'//nl//'3, 9, 1, 2, 9, -0.6'//nl//'3'//nl// &
         '13, 9, 1, 12, 9, -0.5, 2, 9, -0.5'//nl
      character(len=*), parameter :: loads = '*CLOAD'//nl//'3, 1, 0.5'//nl//'13, 5, 0.02'//nl//'3, 5, 0.01'//nl// &
         '2, 6, 0.03'//nl, cold = '2'//nl//'3, 11, 1, 2, 11, -1'//nl
      character(len=*), parameter :: axes = '*NSET, NSET=TURNED'//nl//'2, 3, 13'//nl//'*TRANSFORM, NSET=TURNED'//nl// &
         '1, 0.3, -0.2, 0.4, 1, 0.5'//nl

      call start_random_numbers()
      call check_terms('equations of motions', 'B33', 'B31', penalty//spot, '', loads, exact, bodies=motions//alike)
      call check_terms('equations of single rotations', 'B33', 'B33', penalty//spot, '', loads, exact, &
         bodies=motions//single)
      call check_terms('equations of potentials', 'B33', 'B33', penalty//spot, '', '', exact, &
         bodies='*EQUATION'//nl//potentials)
      call check_terms('equations of nodes that slip', 'B33', 'B33', penalty//'*FRICTION'//nl//'1e-4'//nl, '', loads, &
         exact, bodies=motions//alike)
      call check_terms('equations of rigid bodies', 'B33', 'B33', penalty//spot, '', '*CLOAD'//nl//'21, 4, 0.02'//nl// &
         '21, 6, -0.03'//nl//'12, 5, 0.01'//nl, exact, bodies=bodies_of('TIE')//'*EQUATION'//nl//'3'//nl// &
         '21, 1, 1, 12, 1, -0.3, 2, 5, 0.001'//nl//'2'//nl//'12, 6, 1, 2, 6, -0.5'//nl)
      expansion = '*CONDUCTIVITY'//nl//'430, 100'//nl//'350, 900'//nl//'*EXPANSION, ZERO=250'//nl//'17e-6, 100'//nl// &
         '25e-6, 900'//nl
      call check_coupled('equations of all unknowns', 'B33', hertz//spot, exact, loads, &
         '*EQUATION'//nl//'2'//nl//'3, 1, 2, 2, 1, -1'//nl//alike//potentials//cold)
      call check_shared('equations of contacts on one element', spot, '*EQUATION'//nl//'2'//nl//'3, 9, 1, 2, 9, -0.6' &
         //nl//'2'//nl//'3, 11, 1, 2, 11, -1'//nl)
      expansion = ''
      call start_random_numbers()
      call check_terms('local axes', 'B33', 'B31', penalty//spot, '', loads, exact, bodies=axes)
      call check_terms('equations along local axes', 'B33', 'B33', penalty//spot, '', loads, exact, &
         bodies=motions//single//axes)
   end subroutine check_equations

   !> Centroids and shear centres beside the nodes, principal axes that are not those of the sections, and a factor of
   !> stiffness.
   subroutine check_sections()
      section_a = 'L, STIFFNESS=0.7'//nl//'2.2e-3, 1.6e-3, 0.4e-3, 0.3e-3'//nl//'0, 1, 0.3'
      section_b = 'BOX, STIFFNESS=0.6, OFFSET1=0.4, OFFSET2=-0.7'//nl// &
         '1.2e-3, 1.8e-3, 0.2e-3, 0.1e-3, 0.3e-3, 0.25e-3'
      call check_terms('sections beside their nodes', 'B33', 'B31', penalty//spot, '', '', exact)
      call check_terms('unsymmetric sections', 'B31', 'B33', penalty//spot, '', loads_of_bodies, exact, &
         bodies=bodies_of('TIE'))
      expansion = '*CONDUCTIVITY'//nl//'430, 100'//nl//'350, 900'//nl//'*EXPANSION, ZERO=250'//nl//'17e-6, 100'//nl// &
         '25e-6, 900'//nl
      elasticity = '1.2e11, 0.3, 200'//nl//'0.8e11, 0.35, 600'//nl
      call check_coupled('unsymmetric sections that soften', 'B33', hertz//spot, exact)
      expansion = ''
      elasticity = '1.1e11, 0.3'//nl
      section_a = 'CIRC'//nl//'1e-3'
      section_b = 'CIRC'//nl//'0.8e-3'
   end subroutine check_sections

   !> Forces on the length of elements: of fixed direction, turning with the sections, and of a magnetic field on the
   !> current, whose change with potentials and temperatures is part of the tangent where one step solves for them.
   subroutine check_element_loads()
      character(len=*), parameter :: fixed = '*DLOAD'//nl//'A, PX, 20'//nl//'A, PY, -30'//nl//'B, PZ, 40'//nl// &
         ', GRAV, 9.81, 1, -2, -3'//nl, turning = '*DLOAD'//nl//'A, P1, 200'//nl//'2, P2, -300'//nl//'B, P1, 50'//nl
      character(len=*), parameter :: magnet = '*LORENTZ'//nl// &
         'A, 0.1, 0.2, -0.3, 10, 20, -30, 5, 8, -6, 7, 11, -18'//nl//'B, -0.1, 0.3, 0.2'//nl

      call start_random_numbers()
      expansion = '*DENSITY'//nl//'8960'//nl
      call check_terms('forces per length', 'B33', 'B31', penalty, '', fixed, exact)
      expansion = ''
      call check_terms('forces that turn', 'B33', 'B31', penalty, '', turning, exact)
      call check_terms('forces that turn on rigid bodies', 'B31', 'B33', penalty, '', turning, exact, &
         bodies=bodies_of('TIE'))
      call check_terms('currents in a field and potentials', 'B33', 'B31', hertz//spot, '', magnet// &
         '*SOLVER, NAME=BLOCK, COUPLING=FULL'//nl, exact, coupled_step=.true.)
      expansion = '*CONDUCTIVITY'//nl//'430, 100'//nl//'350, 900'//nl//'*EXPANSION, ZERO=250'//nl//'17e-6, 100'//nl// &
         '25e-6, 900'//nl
      conductivity = '9e7, 100'//nl//'2e7, 900'//nl
      call check_coupled('currents in a field and temperatures', 'B31', hertz//spot, exact, magnet)
      conductivity = '5e7'//nl
      expansion = ''
   end subroutine check_element_loads

   !> Superconducting wires that are stretched, in a field that changes from place to place, with and without
   !> temperatures as unknowns.
   subroutine check_superconductors()
      character(len=*), parameter :: magnet = '*LORENTZ'//nl// &
         'A, 0.1, 0.2, 11, 10, 20, -30, 5, 8, -6, 7, 11, -18'//nl//'B, -0.1, 8, 0.2'//nl
      character(len=*), parameter :: nb3sn = '*SUPERCONDUCTOR, LAW=NB3SN, N=7, FRACTION=0.5, STRAIN=-3e-3'//nl// &
         '7.5e10, 33, 16, 0.6, 2.1, 44, 4, 2.56e-3, 5e-4'//nl
      character(len=*), parameter :: full = '*SOLVER, NAME=BLOCK, COUPLING=FULL'//nl
      type(problem_t) :: problem
      integer :: trial

      call start_random_numbers()
      expansion = nb3sn
      call solve_first_step(deck_of('B33', 'B31', hertz//spot, '', magnet//full, ''), problem)
      problem%coupled_step = .true.
      do trial = 1, 3
         ! short differences, as the slope of the current over the voltage changes fast where that is small
         call compare('superconductors', problem, exact, 1.0_dp, steps=1.0e-4_dp)
      end do
      expansion = nb3sn(:index(nb3sn, '16,') - 1)//'900'//nb3sn(index(nb3sn, '16,') + 2:)//'*CONDUCTIVITY'//nl// &
         '430, 100'//nl//'350, 900'//nl//'*EXPANSION, ZERO=250'//nl//'17e-6, 1'//nl//'25e-6, 900'//nl
      conductivity = '9e7, 1'//nl//'2e7, 900'//nl
      ! what the strain of the filaments does to the heat between contacts on an element is left out
      call check_coupled('superconductors and temperatures', 'B33', hertz//spot, 1.0e-4_dp, magnet)
      conductivity = '5e7'//nl
      expansion = ''
   end subroutine check_superconductors

   !> Two wires that press each other, one warmer than the other.
   subroutine check_coupled(name, element_type, laws, tolerance, loads, equations)
      character(len=*), intent(in) :: name, element_type, laws
      !> Of the largest force that changes
      real(dp), intent(in) :: tolerance
      !> Cards of the second step besides the heating
      character(len=*), intent(in), optional :: loads
      !> Cards of the model
      character(len=*), intent(in), optional :: equations
      character(len=*), parameter :: start = '*NSET, NSET=ALL'//nl//'1, 2, 3, 4, 11, 12, 13, 14'//nl// &
         '*INITIAL CONDITIONS, TYPE=TEMPERATURE'//nl//'ALL, 300'//nl//'*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0'//nl
      character(len=*), parameter :: heating = '*BOUNDARY'//nl//'1, 11, 11, 305'//nl//'4, 11, 11, 302'//nl// &
         '11, 11, 11, 300'//nl//'*DFLUX'//nl//'A, BF, 1e4'//nl
      type(problem_t) :: problem
      character(len=:), allocatable :: cards, of_model
      integer :: trial

      cards = heating
      if (present(loads)) cards = heating//loads
      of_model = start
      if (present(equations)) of_model = start//equations
      call solve_first_step(coupled(deck_of(element_type, 'B33', laws, '', cards, of_model)), problem)
      problem%coupled_step = .true.
      do trial = 1, 3
         call compare(name, problem, tolerance, 0.1_dp, warmer=1.0_dp)
      end do
   end subroutine check_coupled

   !> A wire that another one touches along a line, or two of them do.
   subroutine check_strips(name, laws, second, tolerance)
      !> `second` is the data line of another contact pair
      character(len=*), intent(in) :: name, laws, second
      !> Of the largest force that changes
      real(dp), intent(in) :: tolerance
      character(len=*), parameter :: upper = '*NODE, NSET=ALL'//nl//'11, -0.010, 0, 1.8e-3'//nl// &
         '12, -0.003, 0, 1.8e-3'//nl//'13, 0.005, 0, 1.8e-3'//nl//'14, 0.011, 0, 1.8e-3'//nl
      character(len=*), parameter :: aside = '21, -0.011, 1.6e-3, -7e-4'//nl//'22, -0.002, 1.6e-3, -7e-4'//nl// &
         '23, 0.010, 1.6e-3, -7e-4'//nl
      character(len=*), parameter :: heating = '1, 11, 11, 305'//nl//'4, 11, 11, 302'//nl//'14, 11, 11, 301'//nl// &
         '21, 11, 11, 303'//nl//'14, 9, 9, 0.02'//nl//'21, 9, 9, -0.03'//nl
      type(problem_t) :: problem
      integer :: trial

      call start_random_numbers()
      call solve_first_step(coupled('*NODE, NSET=ALL'//nl//'1, -0.012, 0, 0'//nl//'2, -0.004, 0, 0'//nl// &
         '3, 0.004, 0, 0'//nl//'4, 0.012, 0, 0'//nl//upper//aside//'*ELEMENT, TYPE=B33, ELSET=C'//nl//'21, 21, 22'// &
         nl//'22, 22, 23'//nl//'*BEAM SECTION, ELSET=C, MATERIAL=M, SECTION=CIRC'//nl//'0.74642e-3'//nl// &
         elements_and_contact('B33', 'B33', '', hertz//laws, 'A, B')//'*CONTACT PAIR, INTERACTION=T'//nl//second//nl// &
         '*INITIAL CONDITIONS, TYPE=TEMPERATURE'//nl//'ALL, 300'//nl//'*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0'//nl// &
         '*BOUNDARY'//nl//'1, 1, 6'//nl//'4, 1, 6'//nl//'21, 1, 6'//nl//'23, 1, 6'//nl//step_of(-4.0e-6_dp, '')// &
         step_of(-5.0e-6_dp, '*BOUNDARY'//nl//heating)), problem)
      problem%coupled_step = .true.
      do trial = 1, 3
         call compare(name, problem, tolerance, 0.02_dp, warmer=1.0_dp)
         call check(count(problem%contact%line_points%closed) > 1, name//': points of a line in contact', 0.0_dp)
      end do
   end subroutine check_strips

   !> Wires that rub against each other in a step over time: what backward Euler gives them, and what BDF2 does. No
   !> current flows, and the metal conducts and stores next to no heat, so that this is most of what changes.
   subroutine check_heat_of_friction(name, laws, tolerance)
      character(len=*), intent(in) :: name, laws
      real(dp), intent(in) :: tolerance
      character(len=*), parameter :: start = '*NSET, NSET=ALL'//nl//'1, 2, 3, 4, 11, 12, 13, 14'//nl// &
         '*INITIAL CONDITIONS, TYPE=TEMPERATURE'//nl//'ALL, 0'//nl//'*PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15'//nl
      type(problem_t) :: problem
      integer :: trial

      expansion = '*CONDUCTIVITY'//nl//'1e-3'//nl//'*DENSITY'//nl//'1e-6'//nl//'*SPECIFIC HEAT'//nl//'385'//nl// &
         '*EXPANSION, ZERO=0'//nl//'17e-6'//nl
      call solve_first_step(over_time(deck_of('B33', 'B33', laws, '', '', start)), problem)
      expansion = ''
      problem%coupled_step = .true.
      do trial = 1, 3
         call compare(name, problem, tolerance, 0.1_dp, warmer=1.0_dp)
      end do
      problem%heat_weights = [1.5_dp, 0.5_dp]
      problem%contact%converged%history%last_dissipation = 1.0e-9_dp
      problem%state%temperature_before = problem%state%value(temperature_slots(1), :)
      do trial = 1, 3
         ! some temperatures are prescribed, or not
         problem%is_led(::2) = trial == 3
         call compare(name//' after an increment with it', problem, tolerance, 0.1_dp, warmer=1.0_dp)
      end do
   end subroutine check_heat_of_friction

   !> Three wires that cross one element of another one, which moves.
   subroutine check_shared(name, laws, equations, loads)
      character(len=*), intent(in) :: name, laws
      !> Cards of the model, and of the second step
      character(len=*), intent(in), optional :: equations, loads
      character(len=*), parameter :: supply = '*BOUNDARY'//nl//'1, 9, 9, 0.1'//nl//'11, 9'//nl//'13, 9, 9, 0.01'//nl// &
         '15, 9, 9, -0.02'//nl
      character(len=*), parameter :: heating = '*BOUNDARY'//nl//'1, 11, 11, 305'//nl//'4, 11, 11, 302'//nl// &
         '11, 11, 11, 301'//nl//'*DFLUX'//nl//'A, BF, 1e6'//nl
      type(problem_t) :: problem
      character(len=:), allocatable :: cards, further
      real(dp) :: part
      integer :: trial

      further = ''
      if (present(loads)) further = loads
      cards = ''
      part = 0.1_dp
      if (present(equations)) then
         cards = equations
         ! no contact opens
         part = 0.01_dp
      end if
      call solve_first_step(coupled('*NODE, NSET=ALL'//nl//'1, -0.02, 0, 0'//nl//'2, -0.005, 0, 0'//nl// &
         '3, 0.012, 0, 0'//nl//'4, 0.02, 0, 0'//nl//'11, -0.002, -0.004, 1.9998e-3'//nl// &
         '12, -0.002, 0.016, 1.9998e-3'//nl//'13, 0.001, -0.014, 1.9997e-3'//nl//'14, 0.004, 0.006, 1.9997e-3'//nl// &
         '15, 0.009, -0.004, 1.9996e-3'//nl//'16, 0.006, 0.006, 1.9996e-3'//nl//'*ELEMENT, TYPE=B33, ELSET=A'//nl// &
         '1, 1, 2'//nl//'2, 2, 3'//nl//'3, 3, 4'//nl//'*ELEMENT, TYPE=B33, ELSET=B'//nl//'4, 11, 12'//nl// &
         '5, 13, 14'//nl//'6, 15, 16'//nl//'*MATERIAL, NAME=M'//nl//'*ELASTIC'//nl//elasticity//expansion// &
         '*ELECTRICAL CONDUCTIVITY'//nl//conductivity// &
         '*BEAM SECTION, ELSET=A, MATERIAL=M, SECTION=CIRC'//nl//'1e-3'//nl// &
         '*BEAM SECTION, ELSET=B, MATERIAL=M, SECTION=CIRC'//nl//'1e-3'//nl// &
         '*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0'//nl//'*SURFACE INTERACTION, NAME=I'//nl//hertz//laws// &
         '*CONTACT PAIR, INTERACTION=I'//nl//'A, B'//nl//'*INITIAL CONDITIONS, TYPE=TEMPERATURE'//nl//'ALL, 300'//nl// &
         '*NSET, NSET=B, GENERATE'//nl//'11, 16, 1'//nl//cards//'*BOUNDARY'//nl//'1, 1, 6'//nl//'4, 1, 6'//nl// &
         'B, 1, 6' &
         //nl// &
         '*STEP'//nl//'*STATIC'//nl//supply//'*END STEP'//nl//'*STEP'//nl//'*STATIC'//nl//supply//heating//further// &
         '*END STEP'//nl), problem)
      problem%coupled_step = .true.
      do trial = 1, 3
         call compare(name, problem, exact, part, warmer=1.0_dp)
      end do
   end subroutine check_shared

   !> Current and heat into each surface, by conductances per length; alone and with motions in one Newton step. Motions
   !> are small: where the wire touches at a small angle the ends of what touches move far.
   subroutine check_flows_to_surfaces(electric_law, electric_data, heat_law, heat_data)
      character(len=*), intent(in) :: electric_law, electric_data, heat_law, heat_data
      character(len=*), parameter :: shape(3) = [character(len=8) :: 'PLANE', 'CYLINDER', 'BORE']
      character(len=*), parameter :: place(3) = [character(len=48) :: '0, 0, -1.02e-3, 2e-4, -0.005, 1', &
         '0, 0, -6.12e-3, 0.9, 0.5, 0.05, 5e-3', '0, 0, 8.93e-3, 1, 0.02, 0, 10e-3']
      character(len=*), parameter :: stiff = '*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR'//nl//'1e7, 1e10'//nl
      ! a film whose exchange with what enters depends on the conductivity
      character(len=*), parameter :: warm = '*BOUNDARY'//nl//'1, 11, 11, 305'//nl//'11, 11, 11, 303'//nl// &
         '*FILM'//nl//'A, F, 290, 2e4'//nl
      type(problem_t) :: problem
      character(len=:), allocatable :: current, heat_words
      integer :: i, trial

      current = '*GAP ELECTRICAL CONDUCTANCE, PER=LENGTH, LAW='//electric_law//nl//electric_data
      heat_words = '*GAP CONDUCTANCE, PER=LENGTH, LAW='//heat_law//nl//heat_data
      do i = 1, size(shape)
         call check_terms('current into a surface, '//electric_law//', '//trim(shape(i)), 'B33', 'B33', &
            surfaces(trim(shape(i)), trim(place(i)), law=stiff//current), '', '', exact, 0.1_dp)
         expansion = '*CONDUCTIVITY'//nl//'400, 290'//nl//'250, 320'//nl//'*EXPANSION'//nl//'17e-6'//nl
         call solve_first_step(coupled(deck_of('B33', 'B33', surfaces(trim(shape(i)), trim(place(i)), &
            law=stiff//current//heat_words), '', warm, '*INITIAL CONDITIONS, TYPE=TEMPERATURE'//nl// &
            '1, 300'//nl)), problem)
         expansion = ''
         problem%coupled_step = .true.
         do trial = 1, 3
            call compare('heat into a surface, '//heat_law//', '//trim(shape(i)), problem, exact, 0.03_dp, &
               warmer=1.0_dp)
         end do
      end do
   end subroutine check_flows_to_surfaces

   !> A deck whose last step solves for motions, potentials and temperatures at once.
   function coupled(deck) result(cards)
      character(len=*), intent(in) :: deck
      character(len=:), allocatable :: cards
      character(len=*), parameter :: static = '*STATIC'//nl
      integer :: last

      last = index(deck, static, back=.true.)
      cards = deck(:last - 1)//'*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL, STEADY STATE'//nl// &
         deck(last + len(static):)
      last = index(cards, '*END STEP', back=.true.)
      cards = cards(:last - 1)//'*SOLVER, NAME=BLOCK, COUPLING=FULL'//nl//cards(last:)
   end function coupled

   !> The same over time.
   function over_time(deck) result(cards)
      character(len=*), intent(in) :: deck
      character(len=:), allocatable :: cards
      character(len=*), parameter :: steady = ', STEADY STATE'
      integer :: place

      cards = coupled(deck)
      place = index(cards, steady)
      cards = cards(:place - 1)//cards(place + len(steady):)
   end function over_time

   !> A wire that rubs on a drum, in a step over time: its heat is no matter of the tangent.
   subroutine note_rubbed_surface()
      character(len=*), parameter :: start = '*NSET, NSET=ALL'//nl//'1, 2, 3, 4, 11, 12, 13, 14'//nl// &
         '*INITIAL CONDITIONS, TYPE=TEMPERATURE'//nl//'ALL, 300'//nl
      character(len=*), parameter :: static = '*STATIC'//nl
      character(len=:), allocatable :: deck
      type(problem_t) :: problem
      real(dp), allocatable :: still(:, :), force(:, :)
      integer :: last

      expansion = '*CONDUCTIVITY'//nl//'400'//nl//'*DENSITY'//nl//'8960'//nl//'*SPECIFIC HEAT'//nl//'385'//nl
      deck = deck_of('B33', 'B33', surfaces('CYLINDER', '0, 0, -6.12e-3, 0.9, 0.5, 0.05, 5e-3', '1e-3'), '', '', start)
      expansion = ''
      last = index(deck, static, back=.true.)
      call solve_first_step(deck(:last - 1)//'*COUPLED TEMPERATURE-DISPLACEMENT, ELECTRICAL'//nl// &
         deck(last + len(static):), problem)
      allocate (still(n_slots, problem%model%n_nodes), force(n_slots, problem%model%n_nodes), source=0.0_dp)
      call forces_at(problem, random_values(problem, [(1.0e-5_dp, last=1, n_slots)]), still, 0.0_dp, force)
      call note_terms(problem)
   end subroutine note_rubbed_surface

   !> Currents and heat in a wire with a branch that conducts heat alone.
   subroutine check_heat(name, sigma, lambda, steady)
      !> Data lines of *ELECTRICAL CONDUCTIVITY and *CONDUCTIVITY
      character(len=*), intent(in) :: name, sigma, lambda
      !> Parameters of the procedure
      character(len=*), intent(in) :: steady
      character(len=*), parameter :: storage = '*DENSITY'//nl//'8960'//nl//'*SPECIFIC HEAT'//nl//'300, 100'//nl// &
         '400, 900'//nl//'*LATENT HEAT'//nl//'1e6, -1e5, 1e5'//nl
      character(len=*), parameter :: step = &
         '*BOUNDARY'//nl//'1, 11, 11, 300'//nl//'4, 11, 11, 350'//nl//'1, 9'//nl//'4, 9, 9, 0.3'//nl// &
         '*CFLUX'//nl//'5, 11, 0.02'//nl//'*DFLUX'//nl//'A, BF, 1e5'//nl//'*FILM'//nl//'A, F, 290, 2e4'//nl// &
         '*RADIATE'//nl//'B, R, 280, 0.9'//nl//'2, R, 280, 0.5'//nl//'*END STEP'//nl
      type(problem_t) :: problem
      character(len=:), allocatable :: whole_step
      integer :: trial

      whole_step = '*STEP'//nl//'*COUPLED THERMAL-ELECTRICAL'//steady//nl//step
      call solve_first_step('*NODE'//nl//'1, 0, 0, 0'//nl//'2, 0.03, 0, 0'//nl//'3, 0.05, 0.01, 0'//nl// &
         '4, 0.1, 0, 0'//nl//'5, 0.05, 0.08, 0'//nl//'*ELEMENT, TYPE=B33, ELSET=A'//nl//'1, 1, 2'//nl//'2, 2, 3'//nl// &
         '3, 3, 4'//nl//'*ELEMENT, TYPE=B33, ELSET=B'//nl//'4, 3, 5'//nl//'*MATERIAL, NAME=M'//nl//'*ELASTIC'//nl// &
         '1e11, 0.3'//nl//'*ELECTRICAL CONDUCTIVITY'//nl//sigma//'*CONDUCTIVITY'//nl//lambda//storage// &
         '*JOULE HEAT FRACTION'//nl//'0.8'//nl//'*MATERIAL, NAME=N'//nl//'*ELASTIC'//nl//'1e11, 0.3'//nl// &
         '*CONDUCTIVITY'//nl//'2'//nl//storage//'*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0,'//nl// &
         'STEFAN BOLTZMANN=5.67e-8'//nl// &
         '*BEAM SECTION, ELSET=A, MATERIAL=M, SECTION=CIRC'//nl//'1e-3'//nl// &
         '*BEAM SECTION, ELSET=B, MATERIAL=N, SECTION=CIRC'//nl//'1e-3'//nl//whole_step//whole_step, problem)
      do trial = 1, 3
         call compare(name, problem, exact, 1.0e3_dp)
      end do
      call note_terms(problem)
   end subroutine check_heat

   !> Three wires that cross one element of another wire, insulated where they cross a wire that conducts no current.
   subroutine check_heat_of_contacts(name, laws, parameters)
      !> Of currents and heat
      character(len=*), intent(in) :: name, laws
      !> Of the procedure; none: a steady state
      character(len=*), intent(in), optional :: parameters
      character(len=*), parameter :: storage = '*DENSITY'//nl//'8960'//nl//'*SPECIFIC HEAT'//nl//'300, 100'//nl// &
         '400, 900'//nl
      character(len=*), parameter :: copper = '*MATERIAL, NAME=M'//nl//'*ELASTIC'//nl//'1e11, 0.3'//nl// &
         '*ELECTRICAL CONDUCTIVITY'//nl//'9e7, 100'//nl//'2e7, 900'//nl//'*CONDUCTIVITY'//nl//'430, 100'//nl// &
         '350, 900'//nl//'*JOULE HEAT FRACTION'//nl//'0.8'//nl
      character(len=*), parameter :: loads = '*BOUNDARY'//nl//'1, 11, 11, 300'//nl//'4, 11, 11, 350'//nl// &
         '11, 11, 11, 310'//nl//'1, 9, 9, 0.1'//nl// &
         '11, 9'//nl//'13, 9, 9, 0.01'//nl//'15, 9, 9, -0.02'//nl//'*DFLUX'//nl//'A, BF, 1e6'//nl//'*END STEP'//nl
      character(len=:), allocatable :: step
      type(problem_t) :: problem
      integer :: trial

      step = ', STEADY STATE'
      if (present(parameters)) step = parameters
      step = '*STEP'//nl//'*COUPLED THERMAL-ELECTRICAL'//step//nl//loads
      call solve_first_step('*NODE, NSET=ALL'//nl//'1, -0.02, 0, 0'//nl//'2, -0.005, 0, 0'//nl//'3, 0.012, 0, 0'//nl// &
         '4, 0.02, 0, 0'//nl//'11, -0.002, -0.004, 1.9998e-3'//nl//'12, -0.002, 0.016, 1.9998e-3'//nl// &
         '13, 0.001, -0.014, 1.9997e-3'//nl//'14, 0.004, 0.006, 1.9997e-3'//nl//'15, 0.009, -0.004, 1.9996e-3'//nl// &
         '16, 0.006, 0.006, 1.9996e-3'//nl//'17, -0.012, -0.004, 1.9996e-3'//nl//'18, -0.012, 0.006, 1.9996e-3'//nl// &
         '*ELEMENT, TYPE=B33, ELSET=A'//nl//'1, 1, 2'//nl//'2, 2, 3'//nl//'3, 3, 4'//nl// &
         '*ELEMENT, TYPE=B33, ELSET=B'//nl//'4, 11, 12'//nl//'5, 13, 14'//nl//'6, 15, 16'//nl// &
         '*ELEMENT, TYPE=B33, ELSET=C'//nl//'7, 17, 18'//nl//copper//storage//'*MATERIAL, NAME=N'//nl// &
         '*ELASTIC'//nl// &
         '1e11, 0.3'//nl//'*CONDUCTIVITY'//nl//'20, 100'//nl//'30, 900'//nl//storage// &
         '*BEAM SECTION, ELSET=A, MATERIAL=M, SECTION=CIRC'//nl//'1e-3'//nl// &
         '*BEAM SECTION, ELSET=B, MATERIAL=M, SECTION=CIRC'//nl//'1e-3'//nl// &
         '*BEAM SECTION, ELSET=C, MATERIAL=N, SECTION=CIRC'//nl//'1e-3'//nl// &
         '*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0'//nl//'*SURFACE INTERACTION, NAME=I'//nl//hertz//laws// &
         '*SURFACE INTERACTION, NAME=J'//nl//hertz//'*GAP CONDUCTANCE, LAW=CONDUCTIVITY'//nl// &
         '*CONTACT PAIR, INTERACTION=I'//nl//'A, B'//nl//'*CONTACT PAIR, INTERACTION=J'//nl//'A, C'//nl// &
         '*INITIAL CONDITIONS, TYPE=TEMPERATURE'//nl//'ALL, 300'//nl//'*BOUNDARY'//nl//'ALL, 1, 6'//nl//step//step, &
         problem)
      do trial = 1, 3
         call compare(name, problem, exact, 1.0e3_dp)
      end do
      call check_motions_that_stand(name, problem)
      call note_terms(problem)
   end subroutine check_heat_of_contacts

   !> Where only potentials and temperatures have changed, the rest of the system is not evaluated again.
   subroutine check_motions_that_stand(name, problem)
      character(len=*), intent(in) :: name
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable :: error
      real(dp) :: change(n_slots, problem%model%n_nodes)
      real(dp), allocatable :: before(:), partly(:), whole(:), sensitivity(:, :)

      before = all_of(problem)
      change = random_values(problem, spread(1.0e-2_dp, 1, n_slots))
      associate (first => potential_slots(1))
         call problem%iterate%move(problem%state, problem%model%x, change(first:, :), first)
      end associate
      call evaluate(problem, error, motions_stand=.true.)
      call stop_on(error)
      partly = all_of(problem)
      sensitivity = problem%forces%sensitivity
      call evaluate(problem, error)
      call stop_on(error)
      whole = all_of(problem)
      call check(any(abs(whole - before) > 0), name//': potentials change the system', maxval(abs(whole)))
      call check(all(abs(partly - whole) <= 1.0e-10_dp*abs(whole)), name//': motions stand', &
         maxval(abs(partly - whole)))
      call check(all(abs(sensitivity - problem%forces%sensitivity) <= 1.0e-10_dp*sensitivity), &
         name//': round-off where motions stand', maxval(abs(sensitivity - problem%forces%sensitivity)))
   end subroutine check_motions_that_stand

   !> Which terms change what those before them have made.
   subroutine note_terms(problem)
      type(problem_t), intent(inout) :: problem
      type(error_t), allocatable :: error
      real(dp), allocatable :: before(:)
      integer :: i

      if (.not. allocated(has_added)) allocate (has_added(size(problem%terms)), source=.false.)
      call problem%clear_system()
      do i = 1, size(problem%terms)
         before = all_of(problem)
         call problem%terms(i)%term%evaluate(problem%domain_t, error)
         call stop_on(error)
         has_added(i) = has_added(i) .or. any(abs(all_of(problem) - before) > 0)
      end do
   end subroutine note_terms

   !> All forces and tangents.
   function all_of(problem) result(values)
      type(problem_t), intent(in) :: problem
      real(dp), allocatable :: values(:)
      integer :: j

      values = reshape(problem%forces%internal, [size(problem%forces%internal)])
      do j = 1, n_groups
         values = [values, problem%matrix%block(j, j)%value]
      end do
   end function all_of

   !> The state in the middle of the second step is what the comparison starts from.
   subroutine solve_first_step(deck, problem)
      character(len=*), intent(in) :: deck
      type(problem_t), intent(out) :: problem
      type(model_t) :: model
      type(error_list_t) :: errors, warnings
      type(error_t), allocatable :: error
      type(course_t) :: course
      type(silent_t) :: silent
      integer :: unit, i

      open (newunit=unit, file='tangents.inp', action='write', status='replace')
      write (unit, '(a)') deck
      close (unit)
      call read_deck('tangents.inp', model, errors, warnings)
      if (errors%count > 0) then
         print '(a)', errors%text()
         error stop 1
      end if
      call prepare_problem(model, problem)
      call find_initial_overlap(problem, error)
      call stop_on(error)
      call run_step(problem, 1, 0, .false., course, silent, error)
      call stop_on(error)
      call begin_step(problem, model%steps(2), 0, error)
      call stop_on(error)
      call load_targets(model, model%steps(2), 0.5_dp, 1.5_dp, problem%loading)
      do i = 1, size(problem%terms)
         call problem%terms(i)%term%apply_load(problem%domain_t, model%steps(2), 0.5_dp, 0.5_dp)
      end do
   end subroutine solve_first_step

   !> A random state near the converged one; then `K v` against the change of the forces along `v`.
   subroutine compare(name, problem, tolerance, motion, steps, warmer)
      character(len=*), intent(in) :: name
      type(problem_t), intent(inout) :: problem
      real(dp), intent(in) :: tolerance, motion
      !> Of the differences, in these motions; absent: 1e-3. Where forces follow the places on the wires, which are
      !> found to fewer digits than the distance that is least there, it is more
      real(dp), intent(in), optional :: steps
      !> Random temperatures [K]
      real(dp), intent(in), optional :: warmer
      real(dp), dimension(n_slots, problem%model%n_nodes) :: there, v, product, differences, force
      real(dp), parameter :: weight(3) = [45.0_dp, -9.0_dp, 1.0_dp]/60
      real(dp) :: scale(n_slots), h
      integer :: k, field

      h = 1.0e-3_dp
      if (present(steps)) h = steps
      scale = 1.0e-5_dp
      scale(first_slot(field_rotation):last_slot(field_rotation)) = 1.0e-3_dp
      do field = 1, size(fields)
         if (fields(field)%is_level) scale(first_slot(field)) = 1.0e-4_dp
      end do
      scale = motion*scale
      if (present(warmer)) scale(temperature_slots(1)) = warmer
      do k = 1, 2
         problem%contact%points%bends%by_curvature(k) = 0
         problem%contact%converged%bends%by_curvature(k) = 0
      end do
      there = random_values(problem, scale)
      v = random_values(problem, scale)
      call forces_at(problem, there, v, 0.0_dp, force)
      product = tangent_times(problem, v, force)
      differences = 0
      do k = 1, 3
         call forces_at(problem, there, v, k*h, force)
         differences = differences + weight(k)*force/h
         call forces_at(problem, there, v, -k*h, force)
         differences = differences - weight(k)*force/h
      end do
      where (problem%equations%number == 0) differences = 0
      do field = 1, size(fields)
         associate (a => product(first_slot(field):last_slot(field), :), &
            b => differences(first_slot(field):last_slot(field), :))
            call check(maxval(abs(a - b)) <= tolerance*maxval(abs(b)), name//': '//trim(fields(field)%flux), &
               maxval(abs(a - b))/max(maxval(abs(b)), tiny(1.0_dp)))
         end associate
      end do
   end subroutine compare

   !> Between -scale and scale at the free unknowns, with these at those that are eliminated, 0 at others. Further
   !> fields take the draws of the potential, of other nodes, so that the motions are the same with any fields.
   function random_values(problem, scale) result(values)
      type(problem_t), intent(in) :: problem
      real(dp), intent(in) :: scale(n_slots)
      real(dp) :: values(n_slots, problem%model%n_nodes)
      integer :: slot

      associate (last => potential_slots(2))
         call random_number(values(:last, :))
         do slot = last + 1, n_slots
            values(slot, :) = cshift(values(last, :), slot - last)
         end do
      end associate
      values = merge((2*values - 1)*spread(scale, 2, size(values, 2)), 0.0_dp, problem%equations%number > 0)
      call problem%iterate%constraints%carry(values)
   end function random_values

   !> Forces at `there`, and from there on by `t v`; the tangent is left in the problem.
   subroutine forces_at(problem, there, v, t, force)
      type(problem_t), intent(inout) :: problem
      real(dp), intent(in) :: there(:, :), v(:, :), t
      real(dp), intent(out) :: force(:, :)
      type(error_t), allocatable :: error

      call start_iterate(problem)
      call problem%iterate%move(problem%state, problem%model%x, there, 1)
      call problem%iterate%move(problem%state, problem%model%x, t*v, 1)
      call problem%iterate%warm_mechanics()
      call evaluate(problem, error)
      call stop_on(error)
      ! again, about the forces of this very state
      select type (beams => problem%terms(1)%term)
      type is (beam_term_t)
         beams%sigma_from_strain = .true.
      end select
      call suppose_currents(problem)
      call suppose_what_is(problem%contact%points)
      call suppose_what_is(problem%contact%line_points)
      call evaluate(problem, error)
      call stop_on(error)
      force = problem%forces%internal
   end subroutine forces_at

   !> The currents in superconducting filaments are those of the voltages.
   subroutine suppose_currents(problem)
      type(problem_t), intent(inout) :: problem
      integer :: i

      associate (there => problem%superconductors)
         if (size(there%members) == 0) return
         there%current = [(current_at(there%wires(i), there%voltage(i)), i=1, size(there%members))]
      end associate
   end subroutine suppose_currents

   !> What an iteration supposes of contacts is what it has found.
   subroutine suppose_what_is(points)
      type(contact_point_t), intent(inout) :: points(:)
      integer :: i

      points%mixed_force = points%force
      points%predicted = .false.
      do i = 1, size(points)
         if (.not. allocated(points(i)%friction_iteration)) cycle
         points(i)%friction_iteration%status = points(i)%friction%status
         points(i)%friction_iteration%mixed_traction = points(i)%friction%traction
      end do
   end subroutine suppose_what_is

   !> `K v` of the free unknowns, turned from the Hessian to the derivative of forces of spins.
   function tangent_times(problem, v, force) result(product)
      type(problem_t), intent(in) :: problem
      real(dp), intent(in) :: v(:, :), force(:, :)
      real(dp) :: product(n_slots, size(v, 2))
      real(dp), allocatable :: part(:)
      real(dp) :: mutual(n_slots, size(v, 2))
      integer :: i, j, node

      product = 0
      do i = 1, n_groups
         part = 0*problem%equations%gather(i, v)
         do j = 1, n_groups
            if (problem%matrix%has_block(i, j)) part = part + times(problem, i, j, v)
         end do
         call problem%equations%spread_to_nodes(i, part, product)
      end do
      mutual = 0
      do i = 1, n_groups
         do j = 1, size(problem%terms)
            call problem%terms(j)%term%add_mutual_tangent(i, 1.0e-14_dp, v, mutual)
         end do
      end do
      call problem%iterate%constraints%collect(mutual, 1)
      product = product + mutual
      associate (first => first_slot(field_rotation), last => last_slot(field_rotation), &
         load => problem%loading%load)
         do node = 1, size(v, 2)
            if (any(problem%equations%number(first:last, node) == 0)) cycle
            ! about single axes it is the derivative of forces of spins already
            if (problem%iterate%constraints%turns_alone(node)) cycle
            product(first:last, node) = product(first:last, node) - cross(force(first:last, node) &
               - load(first:last, node), v(first:last, node))/2
         end do
      end associate
      call add_modulus_term(problem, v, product)
      where (problem%equations%number == 0) product = 0
   end function tangent_times

   !> How the elasticity of the places of each contact changes, with which an elastic force goes.
   subroutine add_modulus_term(problem, v, product)
      type(problem_t), intent(in) :: problem
      real(dp), intent(in) :: v(:, :)
      real(dp), intent(inout) :: product(:, :)
      real(dp) :: term(24)
      integer :: i, nodes(4)

      do i = 1, size(problem%contact%points)
         associate (point => problem%contact%points(i))
            if (.not. point%closed) cycle
            nodes = [problem%model%connectivity(:, point%element_bar), problem%model%connectivity(:, point%element)]
            term = (point%torque*point%kinematics%rows%dangle - point%force*point%kinematics%dgap) &
               *slope_of_modulus(problem, point, reshape(v(1:6, nodes), [24]))
            product(1:6, nodes) = product(1:6, nodes) + reshape(term, [6, 4])
         end associate
      end do
   end subroutine add_modulus_term

   !> How ln E* of a contact's places changes as they move by `v`; 0 of a penalty.
   real(dp) function slope_of_modulus(problem, point, v) result(slope)
      type(problem_t), intent(in) :: problem
      type(contact_point_t), intent(in) :: point
      real(dp), intent(in) :: v(24)
      real(dp), parameter :: step = 1.0_dp
      type(contact_point_t) :: moved
      type(wire_pair_t) :: pair(2)
      integer :: side

      slope = 0
      if (problem%model%interactions(problem%model%contact_pairs(point%pair)%interaction)%normal%is_straight) return
      do side = 1, 2
         moved = point
         moved%xi_bar = point%xi_bar + (2*side - 3)*step*dot_product(point%kinematics%rows%dxi_bar, v)
         moved%xi = point%xi + (2*side - 3)*step*dot_product(point%kinematics%rows%dxi, v)
         pair(side) = wires_of(problem%model, problem%elements, moved)
      end do
      slope = log(effective_modulus(pair(2)%young, pair(2)%poisson)/effective_modulus(pair(1)%young, pair(1)%poisson)) &
         /(2*step)
   end function slope_of_modulus

   !> One block of the tangent times `v`.
   function times(problem, row_group, column_group, v) result(y)
      type(problem_t), intent(in) :: problem
      integer, intent(in) :: row_group, column_group
      real(dp), intent(in) :: v(:, :)
      real(dp) :: y(problem%equations%count(row_group))

      call csr_multiply(problem%matrix%block(row_group, column_group), problem%equations%gather(column_group, v), y)
   end function times

   subroutine check(condition, what, found)
      logical, intent(in) :: condition
      character(len=*), intent(in) :: what
      real(dp), intent(in) :: found

      if (condition) return
      failures = failures + 1
      print '(2a, es9.2)', 'failed: ', what, found
   end subroutine check

   subroutine stop_on(error)
      type(error_t), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      print '(a)', error%text()
      error stop 1
   end subroutine stop_on

   !> The same numbers in every run.
   subroutine start_random_numbers()
      integer :: length, k

      call random_seed(size=length)
      call random_seed(put=[(1000 + 17*k, k=1, length)])
   end subroutine start_random_numbers

end program test_tangents
