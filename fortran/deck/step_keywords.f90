!> The keywords of steps: loads, output, and how the equations are solved.
module litz_step_keywords
   use litz_element_loads, only: load_choices, field_axes, field_planes
   use litz_fields, only: fields, n_fields, field_displacement, field_rotation, dof_range, describe_dofs, list_units
   use litz_keywords, only: keyword_t, keyword_table_t, field_spec_t, place_step, place_both, place_begins_step, &
      limit_positive, limit_not_negative
   use litz_keyword_builders, only: begin, finish, integer_field, real_field, dofs_of, choice_field, name_field, &
      item_field, text_field, unused, flag, choice, name, number, count_of
   use litz_quantities, only: on_points, on_cells
   use litz_result_quantities, only: requested_names, described_requests
   use litz_text, only: join_words, words_of
   implicit none
   private
   public :: add_step, add_loads, add_element_loads, add_element_heat, add_given_values, add_output, add_solution

   !> Nothing but the removal of what earlier steps prescribed
   character(len=*), parameter :: new_alone = 'OP=NEW'

   !> What time is in steps that solve for temperatures
   character(len=*), parameter :: over_time = ' With STEADY STATE, time scales the loads: values without an'// &
      ' amplitude ramp over the step. Without it, wires store heat, and such values are there from the start of the'// &
      ' step.'

contains

   pure subroutine add_step(table)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t) :: k

      call begin(k, 'STEP', place_begins_step, &
         'Begins a step. Steps follow each other and keep what they do not redefine:'// &
         ' prescribed values, loads, output requests, controls, solver.')
      call k%add(name('NAME', 'name of the step'))
      call k%add(choice('NLGEOM', 'YES|NO', 'large displacements, which litz always takes into account; it says so'// &
         ' where the parameter is missing, and warns where it is NO', default='YES', value_optional=.true.))
      call k%add(count_of('INC', 'maximum number of increments', '100'))
      call k%add_data([text_field('title', 'any text')], required=.false., last=0)
      call finish(table, k)

      call begin(k, 'STATIC', place_step, 'Equilibrium of forces, moments and currents. Time increments are'// &
         ' adapted automatically; values without an amplitude ramp over the step.')
      call add_increments(k)
      call finish(table, k)

      call begin(k, 'COUPLED THERMAL-ELECTRICAL', place_step, 'Currents and temperatures together: currents'// &
         ' make heat, temperatures change conductivities. Motions are held.'//over_time// &
         ' A step that moves wires takes up the temperatures that the one before it has left, over its time.'// &
         '')
      call add_transient(k)
      call add_increments(k, [rate_field()])
      call finish(table, k)

      call begin(k, 'COUPLED TEMPERATURE-DISPLACEMENT', place_step, 'Equilibrium of forces and moments,'// &
         ' temperatures and currents together: wires expand with the temperatures that are solved for.'//over_time// &
         ' A *STATIC after it keeps the temperatures.')
      call add_transient(k)
      call k%add(flag('ELECTRICAL', 'with currents and their heat; needed where a material conducts them'))
      call add_increments(k, [rate_field()])
      call finish(table, k)

      call begin(k, 'END STEP', place_step, 'Ends a step.')
      call finish(table, k)
   end subroutine add_step

   !> Steady or over time.
   pure subroutine add_transient(k)
      type(keyword_t), intent(inout) :: k

      call k%add(flag('STEADY STATE', 'no heat is stored; without it, materials that conduct heat need *DENSITY and'// &
         ' *SPECIFIC HEAT'))
      call k%add(number('DELTMX', 'largest change of a free temperature in an increment [K]; without it and ERROR'// &
         ' the increments of a step over time are all as large as the first', limit_positive))
      call k%add(number('ERROR', 'largest error of a free temperature that an increment of a step over time may add'// &
         ' [K], which chooses the increments, the first one is the smallest unless it is given (litz extension);'// &
         ' DELTMX may limit them as well', limit_positive))
      call k%add(choice('END', 'PERIOD|SS', 'SS: a step over time ends as soon as no free temperature changes'// &
         ' faster than the rate, and amplitudes have come to their ends', default='PERIOD'))
   end subroutine add_transient

   !> Time of the step, and how it is divided.
   pure subroutine add_increments(k, more)
      type(keyword_t), intent(inout) :: k
      !> Values behind them
      type(field_spec_t), intent(in), optional :: more(:)
      type(field_spec_t), allocatable :: values(:)

      call k%add(flag('DIRECT', 'increments of fixed size'))
      values = [real_field('first', 's', 'first increment, the whole step when left out', limit_positive, &
         .false.), &
         real_field('total', 's', 'time of the step, 1 when left out', limit_positive, .false.), &
         real_field('smallest', 's', 'smallest increment, 1e-5 of the step when left out', limit_positive, .false.), &
         real_field('largest', 's', 'largest increment, the whole step when left out', limit_positive, .false.)]
      if (present(more)) values = [values, more]
      call k%add_data(values, required=.false.)
   end subroutine add_increments

   !> What END=SS waits for.
   pure type(field_spec_t) function rate_field() result(spec)
      spec = real_field('rate', 'K/s', 'with END=SS: change of temperatures below which they are steady', &
         limit_positive, .false.)
   end function rate_field

   pure subroutine add_loads(table)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t) :: k
      character(len=:), allocatable :: flux
      integer :: i

      call begin(k, 'BOUNDARY', place_both, &
         'Prescribed values of degrees of freedom: '//describe_dofs('and')//'. Before the first step they must'// &
         ' be zero. ENCASTRE ('//dof_range(field_displacement, field_rotation)//') and PINNED ('// &
         dof_range(field_displacement)//') can be given instead of numbers, and the symmetries XSYMM (1, 5, 6),'// &
         ' YSYMM'// &
         ' (2, 4, 6), ZSYMM (3, 4, 5), XASYMM (2, 3, 4), YASYMM (1, 3, 5) and ZASYMM (1, 2, 6). All three'// &
         ' rotations of a node are its'// &
         ' rotation vector. One or two alone are angles applied incrementally about these axes, in addition to the'// &
         ' free rotation: where that is large, the result depends on the increments.')
      call add_op(k, 'prescribed values')
      call k%add(flag('FIXED', 'in a step: what is named stays what it is when the step begins; no values are given'))
      call k%add_data([item_field('node', 'number of a node or name of a node set'), &
         dofs_of([(i, i=1, n_fields)], name_field('first', 'first degree of freedom, or the name of a support')), &
         integer_field('last', 'last degree of freedom, the first when left out', limit_positive, required=.false.), &
         real_field('value', list_units(), 'prescribed value, 0 when left out', required=.false.)], last=0, &
         optional_with=new_alone)
      call finish(table, k)

      call begin(k, 'CLOAD', place_step, &
         'Concentrated forces ('//dof_range(field_displacement)//') and moments ('//dof_range(field_rotation)// &
         '), of fixed direction. Lines for the same node and direction add up.')
      call add_op(k, 'loads')
      call k%add_data([item_field('node', 'number of a node or name of a node set'), &
         dofs_of([field_displacement, field_rotation], integer_field('dof', 'direction, '// &
         dof_range(field_displacement, field_rotation), limit_positive)), &
         real_field('value', 'N, N m', 'force or moment')], &
         last=0, optional_with=new_alone)
      call finish(table, k)

      do i = 1, n_fields
         if (.not. fields(i)%is_level) cycle
         flux = trim(fields(i)%flux_in_words)
         call begin(k, trim(fields(i)%load_keyword), place_step, &
            'Concentrated '//flux//'s, positive into the body. Lines for the same node add up.')
         call add_op(k, flux//'s')
         call k%add_data([item_field('node', 'number of a node or name of a node set'), &
            dofs_of([i], integer_field('dof', dof_range(i)//' or empty', limit_positive, required=.false.)), &
            real_field('value', trim(fields(i)%flux_unit), flux)], last=0, optional_with=new_alone)
         call finish(table, k)
      end do
   end subroutine add_loads

   !> Forces on the length of elements.
   pure subroutine add_element_loads(table)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t) :: k
      type(field_spec_t) :: whole_model
      integer :: i

      call begin(k, 'DLOAD', place_step, 'Forces on the length of wires, per reference length. PX, PY, PZ: along'// &
         ' the global axes, of fixed direction. P1, P2: along the first and second section axis (*BEAM SECTION),'// &
         ' with which they turn; those of CalculiX are pressures (litz convert). GRAV: weight, density (*DENSITY)'// &
         ' times area times an acceleration, whose direction may have any length. All act along the line of the'// &
         ' nodes (the beam axis of Abaqus), also where the section lies beside it. Nodal moments that belong to'// &
         ' them act on B33, none on B31. Lines of a step for the same element and label add up.')
      call add_op(k, 'loads')
      whole_model = item_field('element', 'number of an element or name of an element set; GRAV without it acts on all')
      whole_model%required = .false.
      call k%add_data([whole_model, choice_field('label', load_choices(), 'direction of the force, or weight'), &
         real_field('value', 'N/m', 'force per length; for GRAV the acceleration [m/s^2]'), &
         real_field('x', '', 'GRAV: its direction', required=.false.), &
         real_field('y', '', 'GRAV: its direction', required=.false.), &
         real_field('z', '', 'GRAV: its direction', required=.false.)], last=0, optional_with=new_alone)
      call finish(table, k)

      call begin(k, 'LORENTZ', place_step, 'Force of a magnetic field on the currents in wires (litz extension):'// &
         ' per length current times field, across both. The current is the one that is computed in the element,'// &
         ' the field is given, B(x) = B0 + x dB/dx + y dB/dy + z dB/dz at the present place x, y, z of the wire,'// &
         ' without the field of the wires themselves; with ALONG it is given at places along an axis or over a'// &
         ' plane. 1 T = 1 N/(A m). Lines of a step for the same element add up. Motions and potentials are then in'// &
         ' one Newton step, or take turns with *SOLVER, COUPLING=UPDATED.')
      call add_op(k, 'fields')
      call k%add(choice('ALONG', 'X|Y|Z|XY|XZ|YZ', 'each line gives the field at a place along this axis; lines for'// &
         ' the same elements that follow each other are one table, linear from place to place, within which the'// &
         ' middles of the elements have to lie before any deformation. The component along the axis stays as it'// &
         ' is, as a field has no divergence. Two axes: lines, in any order, for each place along the first together'// &
         ' with each along the second one, bilinear in between and the same along the third axis, as maps of'// &
         ' magnets are; each element sees the field that touches it in its middle'))
      do i = 1, 3
         call k%add_data([item_field('element', 'number of an element or name of an element set'), &
            real_field('Bx', 'N/(A m)', 'field there'), real_field('By', 'N/(A m)', 'field there'), &
            real_field('Bz', 'N/(A m)', 'field there'), real_field('place', 'm', 'place along the axis, higher than'// &
            ' that of the line before')], when='ALONG='//field_axes(i), last=0, optional_with=new_alone)
      end do
      do i = 1, 3
         call k%add_data([item_field('element', 'number of an element or name of an element set'), &
            real_field('Bx', 'N/(A m)', 'field there'), real_field('By', 'N/(A m)', 'field there'), &
            real_field('Bz', 'N/(A m)', 'field there'), real_field('place', 'm', 'place along the first axis'), &
            real_field('second place', 'm', 'place along the second axis')], when='ALONG='//field_planes(i), last=0, &
            optional_with=new_alone)
      end do
      call k%add_data([item_field('element', 'number of an element or name of an element set'), &
         real_field('Bx', 'N/(A m)', 'field at the origin'), real_field('By', 'N/(A m)', 'field at the origin'), &
         real_field('Bz', 'N/(A m)', 'field at the origin'), derivative_of('x', 'x'), derivative_of('y', 'x'), &
         derivative_of('z', 'x'), derivative_of('x', 'y'), derivative_of('y', 'y'), derivative_of('z', 'y'), &
         derivative_of('x', 'z'), derivative_of('y', 'z'), derivative_of('z', 'z')], last=0, optional_with=new_alone)
      call finish(table, k)

   contains

      pure type(field_spec_t) function derivative_of(component, coordinate) result(spec)
         !> Of the field, and of the position
         character(len=1), intent(in) :: component, coordinate

         spec = real_field('dB'//component//'/d'//coordinate, 'N/(A m^2)', 'its derivative, 0 when left out', &
            required=.false.)
      end function derivative_of

   end subroutine add_element_loads

   !> Heat on the length of elements.
   pure subroutine add_element_heat(table)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t) :: k

      call begin(k, 'DFLUX', place_step, 'Heat sources in wires, which ramp over the step. Lines for the same'// &
         ' element add up.')
      call add_heat_op(k, 'of the heat over time; without it the heat ramps over the step, or is there at once in a'// &
         ' step over time')
      call k%add_data([element_field(), choice_field('label', 'BF', 'BF: in the volume'), &
         real_field('value', 'W/m^3', 'heat per volume')], last=0, optional_with=new_alone)
      call finish(table, k)

      call begin(k, 'FILM', place_step, 'Heat that passes from the sides of wires to their surroundings, h (T - Ts)'// &
         ' per area; the side has the perimeter 2 pi r. It does not ramp.')
      call add_heat_op(k, 'of the temperature of the surroundings over time; without it that is there at once')
      call k%add(name('FILM AMPLITUDE', 'factor of the heat transfer coefficient over time'))
      call k%add_data([element_field(), choice_field('label', 'F', 'F: the side'), &
         real_field('Ts', 'K', 'temperature of the surroundings'), &
         real_field('h', 'W/(m^2 K)', 'heat transfer coefficient', limit_positive)], last=0, optional_with=new_alone)
      call finish(table, k)

      call begin(k, 'RADIATE', place_step, 'Heat that wires radiate from their sides, eps sigma (T^4 - Ts^4) per'// &
         ' area, from absolute zero; the side has the perimeter 2 pi r. It does not ramp.')
      call add_heat_op(k, 'of the temperature of the surroundings over time; without it that is there at once')
      call k%add_data([element_field(), choice_field('label', 'R', 'R: the side'), &
         real_field('Ts', 'K', 'temperature of the surroundings'), &
         real_field('eps', '-', 'emissivity, up to 1', limit_positive)], last=0, optional_with=new_alone)
      call finish(table, k)

   contains

      pure type(field_spec_t) function element_field() result(spec)
         spec = item_field('element', 'number of an element or name of an element set')
      end function element_field

   end subroutine add_element_heat

   pure subroutine add_heat_op(k, of_what)
      type(keyword_t), intent(inout) :: k
      !> What AMPLITUDE is the factor of
      character(len=*), intent(in) :: of_what

      call k%add(choice('OP', 'MOD|NEW', 'MOD changes or adds to what earlier steps gave, NEW removes it all, with'// &
         ' or without data lines', default='MOD'))
      call k%add(name('AMPLITUDE', 'factor '//of_what))
   end subroutine add_heat_op

   pure subroutine add_given_values(table)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t) :: k

      call begin(k, 'TEMPERATURE', place_step, 'Temperatures of nodes, where they are no unknowns. Without an'// &
         ' amplitude they ramp over the step from what they were; nodes that no *TEMPERATURE names have their'// &
         ' initial temperature (*INITIAL CONDITIONS), or keep that which an earlier step has solved for.')
      call k%add(choice('OP', 'MOD|NEW', 'MOD changes or adds to the temperatures of earlier steps; NEW removes'// &
         ' them all, with or without data lines: nodes not named again return to their initial temperature over the'// &
         ' step', default='MOD'))
      call k%add(name('AMPLITUDE', 'factor over time; without it the value ramps over the step'))
      call k%add_data([item_field('node', 'number of a node or name of a node set'), &
         real_field('value', 'K', 'temperature')], last=0, optional_with=new_alone)
      call finish(table, k)
   end subroutine add_given_values

   pure subroutine add_op(k, what)
      type(keyword_t), intent(inout) :: k
      !> What the keyword prescribes, in the plural
      character(len=*), intent(in) :: what

      call k%add(choice('OP', 'MOD|NEW', 'MOD changes or adds to the '//what//' of earlier steps, NEW removes'// &
         ' them all, with or without data lines', default='MOD'))
      call k%add(name('AMPLITUDE', 'factor over time; without it the value ramps over the step'))
   end subroutine add_op

   subroutine add_output(table)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t) :: k

      call begin(k, 'NODE PRINT', place_step, 'Requests nodal quantities in the history file.')
      call k%add(name('NSET', 'the nodes; without it nothing is requested, as fields of all nodes are always written'))
      call k%add(choice('TOTALS', 'YES|NO|ONLY', &
         'sums over the set (means of '//means(on_points)//'): in addition to the nodes, not at all, or only', &
         default='NO'))
      call k%add_data([choice_field('quantity', requested_names(on_points), described_requests(on_points))], &
         last=0, repeats=0)
      call finish(table, k)

      call begin(k, 'EL PRINT', place_step, 'Requests element quantities in the history file.')
      call k%add(name('ELSET', 'the elements; without it nothing is requested, as fields of all elements are always'// &
         ' written'))
      call k%add(choice('TOTALS', 'YES|NO|ONLY', &
         'sums over the set (means of '//means(on_cells)//'): in addition to the elements, not at all, or only', &
         default='NO'))
      call k%add_data([choice_field('quantity', requested_names(on_cells), described_requests(on_cells))], &
         last=0, repeats=0)
      call finish(table, k)

      call begin(k, 'CONTACT PRINT', place_step, &
         'Requests a line about the contacts at every increment in the terminal; the'// &
         ' contact ledger is written as *CONTACT FILE says.')
      call k%add_data([text_field('quantity', 'accepted, but the line has always the same quantities')], &
         required=.false., last=0)
      call finish(table, k)

      call begin(k, 'ENERGY PRINT', place_step, &
         'Requests energies since the start of the run in the history file. ALLWK: work of supports, loads and'// &
         ' interference fits.'// &
         ' ALLSE: in the beams. ALLCCE: in the contacts. ALLFD: dissipated by friction.'// &
         ' ALLPD: dissipated by spots that yield, in models with YIELD.'// &
         ' ALLSD: dissipated by stabilization.'// &
         ' ALLTW: done by changes of temperature, in models with temperatures.'// &
         ' ETOTAL: ALLSE + ALLCCE + ALLFD + ALLPD + ALLSD - ALLWK - ALLTW,'// &
         ' which goes to zero with the increment size, except for the error of B31 elements at contacts,'// &
         ' which goes to zero with the element size, and of contacts that turn or slide next to ends and kinks of'// &
         ' wires, or turn from a crossing into a line: at most what they hold.')
      call finish(table, k)

      call begin(k, 'ELECTRODE PRINT', place_step, &
         'Requests voltage, current and resistance between two node sets in the'// &
         ' history file (litz extension): the mean potential of the first minus that of the second, the current'// &
         ' that enters at the first, and their ratio. It is the resistance between the two if all of this'// &
         ' current leaves at the second; otherwise there is a warning (third_electrode).')
      call k%add_data([name_field('NSET_A', 'positive electrode'), name_field('NSET_B', 'negative electrode')], last=0)
      call finish(table, k)

      call begin(k, 'NODE FILE', place_step, 'Fields are always written to the result file; this sets how often.')
      call k%add(count_of('FREQUENCY', 'every n-th increment, and the last of the step', '1'))
      call k%add_data([choice_field('quantity', requested_names(on_points), 'accepted, but all are always written')], &
         required=.false., last=0, repeats=0)
      call finish(table, k)

      call begin(k, 'RESTART', place_step, &
         'Saves increments from which a run can be continued, in DECK.restart.h5: litz run DECK.inp --restart'// &
         ' DECK.restart.h5[:STEP:INCREMENT]. Applies to later steps too.')
      call k%add(flag('WRITE', 'save increments; without it, stop saving'))
      call k%add(count_of('FREQUENCY', 'every n-th increment, and the last of the step; 0: none', '1', &
         limit_not_negative))
      call finish(table, k)

      call begin(k, 'EL FILE', place_step, 'As *NODE FILE.')
      call k%add(count_of('FREQUENCY', 'every n-th increment, and the last of the step', '1'))
      call k%add_data([choice_field('quantity', requested_names(on_cells), 'accepted, but all are always written;'// &
         ' SFN, SE, SK, E11 and S11 where a step asks for one of them')], &
         required=.false., last=0, repeats=0)
      call finish(table, k)

      call begin(k, 'CONTACT FILE', place_step, 'How often the contacts are written, to DECK_contacts.csv and'// &
         ' .vtkhdf: a row for each crossing and each place of a line. Applies to later steps too. The contacts with'// &
         ' rigid surfaces (DECK_surfaces.csv) are written at every increment.')
      call k%add(count_of('FREQUENCY', 'every n-th increment, and the last of the step; 0: none', '1', &
         limit_not_negative))
      call k%add_data([text_field('quantity', 'accepted, but all are always written')], required=.false., last=0)
      call finish(table, k)
   end subroutine add_output

   !> Quantities whose totals are means: `U, UR and EPOT`.
   function means(place) result(text)
      !> `on_points` or `on_cells`
      integer, intent(in) :: place
      character(len=:), allocatable :: text

      text = join_words(words_of(requested_names(place, means_only=.true.)), 'and')
   end function means

   pure subroutine add_solution(table)
      type(keyword_table_t), intent(inout) :: table
      type(keyword_t) :: k

      call begin(k, 'CONTROLS', place_step, 'Convergence and increments, with CalculiX''s names and order. FIELD:'// &
         ' convergence. TIME INCREMENTATION: counts of iterations, then factors. ROTATION: limit per iteration'// &
         ' (litz extension). STABILIZE: damping of all free motion, for wires without support and'// &
         ' snap-through (litz extension); its energy is ALLSD, also in the .sta file. Values left empty are'// &
         ' unchanged.')
      call k%add(choice('PARAMETERS', 'FIELD|TIME INCREMENTATION|ROTATION|STABILIZE', 'kind of data', &
         required=.true.))
      call k%add_data([real_field('R_n', '-', 'largest residual over the reference of its field', limit_positive, &
         .false.), &
         real_field('C_n', '-', 'largest correction over the increment; 0: not checked', limit_not_negative, &
         .false.)], &
         when='PARAMETERS=FIELD')
      call k%add_data([unused('I_0'), unused('I_R'), unused('I_P'), &
         integer_field('I_C', 'maximum number of iterations before the increment is cut; those that only open and'// &
         ' close contacts as predicted do not count, up to four times as many, and one that leaves no more than'// &
         ' a tenth of all residuals has others after it', limit_positive, .false.), &
         integer_field('I_L', 'more iterations than this shrink the next increment', limit_positive, .false.), &
         integer_field('I_G', 'two successive increments of at most this many enlarge the next', limit_positive, &
         .false.), &
         unused('I_S'), integer_field('I_A', 'maximum number of cut-backs of one increment', limit_positive, &
         .false.)], &
         when='PARAMETERS=TIME INCREMENTATION')
      call k%add_data([real_field('D_f', '-', 'factor of the increment after a failed one', limit_positive, .false.), &
         unused('D_C'), real_field('D_B', '-', 'factor after a slow one', limit_positive, .false.), unused('D_A'), &
         unused('D_S'), unused('D_H'), real_field('D_D', '-', 'factor after quick ones', limit_positive, .false.)], &
         when='PARAMETERS=TIME INCREMENTATION', first=2, required=.false.)
      call k%add_data([real_field('cap', 'rad', 'largest rotation of a node in one iteration', limit_positive)], &
         when='PARAMETERS=ROTATION')
      call k%add_data([real_field('factor', '-', &
         'damping relative to the smallest element stiffness, 1e-8 without this line; 0: none', limit_not_negative)], &
         when='PARAMETERS=STABILIZE', required=.false.)
      call finish(table, k)

      call begin(k, 'SOLVER', place_step, &
         'Linear solver of this step and the later ones (litz extension). BLOCK, the default, takes Cholesky where'// &
         ' it can, else MUMPS or UMFPACK; MUMPS takes L D L^T or LU by MUMPS for every matrix. MONOLITHIC:'// &
         ' voltages are solved in the same linear step as displacements. UPDATED: with the new displacements. Where'// &
         ' temperatures or magnetic forces act back on displacements, in *COUPLED TEMPERATURE-DISPLACEMENT and with'// &
         ' *LORENTZ, all are in one Newton step (FULL, the default there), or take turns with UPDATED.')
      call k%add(choice('NAME', 'BLOCK|UMFPACK|SKYLINE|MUMPS', 'the solver', required=.true.))
      call k%add(choice('COUPLING', 'MONOLITHIC|UPDATED|FULL', 'when voltages and temperatures are solved for'))
      call finish(table, k)
      call begin(k, 'SOLUTION TECHNIQUE', place_step, &
         'How often this step and the later ones factorise the tangent, as in Abaqus. NEWTON, the default: in every'// &
         ' iteration, or, where that pays, as in large networks, in the first one of each increment, whose factor'// &
         ' then helps to solve with the tangents of the others. MODIFIED NEWTON (litz extension): a factor is'// &
         ' reused, also from one increment to the next, as long as each iteration leaves at most a hundredth of the'// &
         ' residual and no contact opens or closes; convergence is then linear, to the same solution.')
      call k%add(choice('TYPE', 'NEWTON|MODIFIED NEWTON', 'when the tangent is factored', required=.true.))
      call k%add(count_of('REFORM KERNEL', 'maximum number of iterations with the same factor', '8'))
      call finish(table, k)
   end subroutine add_solution

end module litz_step_keywords
