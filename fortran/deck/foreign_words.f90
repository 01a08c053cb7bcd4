!> Keywords of Abaqus and CalculiX that litz does not have, and what to write in their place.
!>
!> The table drives the messages of the reader, `litz keywords NAME`, and a chapter of the reference of the deck.
module litz_foreign_words
   use litz_text, only: squeezed, words_of, word_length
   implicit none
   private
   public :: foreign_word_t, foreign_words, foreign_keyword, advice_about, advice_about_more
   public :: role_of, role_procedure, role_idle, role_mesh, role_join, role_data

   !> What a keyword that litz lacks is about: the model, the analysis of a step, what changes no result of litz,
   !> such as output: it is ignored with a warning, nodes and elements, nodes that move with others, or what data lines
   !> mean
   integer, parameter :: role_model = 0, role_procedure = 1, role_idle = 2, role_mesh = 3, role_join = 4, role_data = 5

   !> Lists are separated by bars.
   type :: foreign_word_t
      !> Keywords: those that litz lacks, or, with `parameters` or `values`, those of litz that lack them
      character(len=200) :: keywords
      !> Parameters that litz lacks, or the one whose values it lacks
      character(len=120) :: parameters
      !> Values of the parameter, or of a data line; `+`: more values than a data line takes, `VALUE+`: than it takes
      !> with this value of the parameter
      character(len=200) :: values
      !> What to do in litz, as the end of a sentence
      character(len=240) :: advice
      !> One of `role_...`
      integer :: role = role_model
   end type foreign_word_t

   !> Keywords about the analysis and the model
   type(foreign_word_t), parameter :: of_model(*) = [ &
      foreign_word_t('DYNAMIC|MODAL DYNAMIC|DIRECT CYCLIC', '', '', 'there is no inertia: use *STATIC, and'// &
      ' *CONTROLS, PARAMETERS=STABILIZE where wires snap or are unsupported', &
      role_procedure), &
      foreign_word_t('VISCO|CREEP|VISCOELASTIC', '', '', 'nothing is rate-dependent: use *STATIC and *ELASTIC', &
      role_procedure), &
      foreign_word_t('PIEZOELECTRIC|ELECTROMAGNETICS|ELECTROMAGNETIC|GEOSTATIC|SOILS', '', '', &
      'use *STATIC, which solves forces and currents together, or *COUPLED TEMPERATURE-DISPLACEMENT for'// &
      ' temperatures', &
      role_procedure), &
      foreign_word_t('HEAT TRANSFER', '', '', 'use *COUPLED THERMAL-ELECTRICAL', &
      role_procedure), &
      foreign_word_t('FREQUENCY|BUCKLE|COMPLEX FREQUENCY|STEADY STATE DYNAMICS|GREEN|SUBSTRUCTURE GENERATE|RANDOM'// &
      ' RESPONSE', '', '', &
      'there are no eigenvalues: *STATIC follows the wires through large displacements', &
      role_procedure), &
      foreign_word_t('IMPERFECTION', '', '', 'put it into the coordinates of *NODE'), &
      foreign_word_t('TIME POINTS', '', '', 'leave it out; the fourth value of *STATIC is the largest increment', &
      role_idle), &
      foreign_word_t('SOLVER CONTROLS', '', '', 'leave it out; *SOLVER chooses the solver'), &
      foreign_word_t('MODEL CHANGE', '', '', 'elements and contact pairs are the same in all steps'), &
      foreign_word_t('PREPRINT|FILE FORMAT|MONITOR|PRINT|DIAGNOSTICS|NO PRINT|FILTER', '', '', &
      'leave it out; the files DECK.sta and DECK.cvg report every increment and iteration', &
      role_idle), &
      foreign_word_t('PARAMETER', '', '', 'write the values; litz.sweep of Python fills in {names}, litz.Deck'// &
      ' changes values'), &
      foreign_word_t('PART|END PART|ASSEMBLY|END ASSEMBLY|INSTANCE|END INSTANCE', '', '', &
      'the program reads flat decks: `litz run` and `litz check` of the Python package place the instances, and'// &
      ' `litz convert THIS.inp NEW.inp` writes the flat deck'), &
      foreign_word_t('NGEN|NFILL|NCOPY|ELGEN|ELCOPY|SYSTEM', '', '', '`litz run`, `check` and `convert`'// &
      ' of the Python package write out the nodes and elements, with the parameters that docs/tutorials/deck.md'// &
      ' names alone', &
      role_mesh), &
      foreign_word_t('NMAP', '', '', 'write the coordinates of the nodes', &
      role_mesh), &
      foreign_word_t('NORMAL', '', '', 'leave it out: the second data line of'// &
      ' *BEAM SECTION is the first axis of the section'), &
      foreign_word_t('ORIENTATION', '', '', 'leave it out: it is of no use to beams, whose first axis is the second'// &
      ' data line of *BEAM SECTION', role_idle), &
      foreign_word_t('COUPLING|KINEMATIC|DISTRIBUTING|KINEMATIC COUPLING|DISTRIBUTING COUPLING|MPC|TIE|'// &
      'EMBEDDED ELEMENT', '', '', 'nodes that move with another one are a *RIGID BODY, REF NODE=..., TIE NSET=...'// &
      ' (or PIN NSET=...), which `litz convert THIS.inp NEW.inp` writes where they are the same; wires that are'// &
      ' joined share a node', &
      role_join), &
      foreign_word_t('RELEASE', '', '', 'a hinge is two nodes at one place, an end of a beam each, that share'// &
      ' displacements: *RIGID BODY, REF NODE=..., PIN NSET=..., or *EQUATION for each of 1 to 3'), &
      foreign_word_t('BASE MOTION', '', '', 'there is no inertia: prescribe the motion of supports by *BOUNDARY,'// &
      ' AMPLITUDE=...'), &
      foreign_word_t('SPRING|DASHPOT|CONNECTOR SECTION|CONNECTOR BEHAVIOR|GAP|MASS|ROTARY INERTIA', '', '', &
      'only beams are available: a spring is a thin beam, of stiffness EA/L'), &
      foreign_word_t('SOLID SECTION|SHELL SECTION|MEMBRANE SECTION|FRAME SECTION', '', '', &
      'only beams are available: use *BEAM SECTION, ELSET=..., MATERIAL=..., SECTION=CIRC')]

   !> Keywords about materials, contact, loads and results
   type(foreign_word_t), parameter :: of_laws(*) = [ &
      foreign_word_t('DAMPING', '', '', 'leave it out: there is no inertia', &
      role_idle), &
      foreign_word_t('SECTION CONTROLS', '', '', 'leave it out: beams have none of what it controls', &
      role_idle), &
      foreign_word_t('PLASTIC|HYPERELASTIC|DEFORMATION PLASTICITY|CYCLIC HARDENING|USER MATERIAL|DEPVAR', '', '', &
      'beams are elastic: use *ELASTIC; contact spots may yield (*SURFACE BEHAVIOR, YIELD)'), &
      foreign_word_t('SURFACE|NODE SURFACE|SURFACE DEFINITION', '', '', &
      'leave it out: *CONTACT PAIR names element sets, which `litz convert THIS.inp NEW.inp` makes of surfaces'// &
      ' around beams'), &
      foreign_word_t('CONTACT|CONTACT INCLUSIONS|CONTACT EXCLUSIONS|CONTACT PROPERTY ASSIGNMENT|'// &
      'SURFACE PROPERTY ASSIGNMENT', '', '', 'use *CONTACT PAIR, INTERACTION=...; one element set in its data'// &
      ' line: all its wires may touch (`litz convert THIS.inp NEW.inp` does)'), &
      foreign_word_t('CONTACT INTERFERENCE', '', '', 'use *CONTACT PAIR, INTERFERENCE FIT'), &
      foreign_word_t('CONTACT CONTROLS|CONTACT STABILIZATION|CONTACT DAMPING', '', '', &
      'leave it out; *CONTROLS, PARAMETERS=STABILIZE damps what only contacts can hold'), &
      foreign_word_t('CLEARANCE', '', '', 'leave it out: gaps follow from the nodes and radii'), &
      foreign_word_t('GAP RADIATION', '', '', 'wires radiate into their surroundings only: *RADIATE'), &
      foreign_word_t('DSLOAD', '', '', 'beams have no surfaces: *DLOAD gives forces per length'), &
      foreign_word_t('DECURRENT|DSECURRENT', '', '', 'distribute the current over the nodes: *CECURRENT'), &
      foreign_word_t('OUTPUT|FILE OUTPUT', '', '', 'leave it out: fields are always written (*NODE FILE says how'// &
      ' often), and *NODE PRINT, *EL PRINT, *ELECTRODE PRINT request values over time', &
      role_idle), &
      foreign_word_t('NODE OUTPUT', '', '', 'leave it out: fields are always written; *NODE PRINT, NSET=...'// &
      ' requests'// &
      ' values over time', &
      role_idle), &
      foreign_word_t('ELEMENT OUTPUT', '', '', 'leave it out: fields are always written; *EL PRINT, ELSET=...'// &
      ' requests'// &
      ' values over time', &
      role_idle), &
      foreign_word_t('CONTACT OUTPUT', '', '', 'leave it out: every contact is written to DECK_contacts.csv and'// &
      ' .vtkhdf, as often as *CONTACT FILE says', &
      role_idle), &
      foreign_word_t('ENERGY OUTPUT|ENERGY FILE|INCREMENTATION OUTPUT', '', '', 'use *ENERGY PRINT', &
      role_idle), &
      foreign_word_t('SECTION PRINT|SECTION FILE|INTEGRATED OUTPUT|INTEGRATED OUTPUT SECTION', '', '', &
      'use *EL PRINT with SF, or *NODE PRINT with RF and TOTALS=ONLY', &
      role_idle)]

   !> Parameters
   type(foreign_word_t), parameter :: of_parameters(*) = [ &
      foreign_word_t('STATIC', 'RIKS', '', 'there is no arc length: prescribe displacements instead of the load,'// &
      ' or use *CONTROLS, PARAMETERS=STABILIZE'), &
      foreign_word_t('STATIC', 'STABILIZE|ALLSDTOL|FACTOR|CONTINUE', '', 'use *CONTROLS, PARAMETERS=STABILIZE'), &
      foreign_word_t('STATIC', 'SOLVER', '', 'use *SOLVER, NAME=...'), &
      foreign_word_t('STEP', 'PERTURBATION', '', 'every step is nonlinear: leave it out'), &
      foreign_word_t('STEP', 'AMPLITUDE', '', 'values ramp over the step; *AMPLITUDE defines other histories,'// &
      ' which `litz convert THIS.inp NEW.inp` writes for AMPLITUDE=STEP'), &
      foreign_word_t('STEP', 'UNSYMM|EXTRAPOLATION|CONVERT SDI|SOLVER', '', 'leave it out: litz chooses'// &
      ' automatically'), &
      foreign_word_t('RIGID BODY', 'ROT NODE', '', 'REF NODE has the rotations, too: degrees of freedom 4-6'), &
      foreign_word_t('RIGID BODY', 'ELSET|ANALYTICAL SURFACE', '', 'give the nodes, by TIE NSET=... or PIN NSET=...'), &
      foreign_word_t('RIGID BODY', 'POSITION|ISOTHERMAL', '', 'leave it out: the reference node stays where it is'), &
      foreign_word_t('NODE|NSET|ELEMENT|ELSET', 'INPUT', '', 'write *INCLUDE, INPUT=... in place of its data lines', &
      role_mesh), &
      foreign_word_t('NODE', 'SYSTEM', '', 'write x, y, z: `litz run`, `check` and `convert` of the Python'// &
      ' package take cylindrical coordinates (C), too, but no spherical ones (S)'), &
      foreign_word_t('NSET|ELSET', 'INSTANCE', '', 'the program reads flat decks: `litz run` of the Python package'// &
      ' places the instances, and `litz convert THIS.inp NEW.inp` writes the flat deck'), &
      foreign_word_t('NSET|ELSET', 'UNSORTED', '', 'members of sets are in the order of their numbers: leave it out'// &
      ' where no *EQUATION takes them one by one; `litz convert THIS.inp NEW.inp` writes such an *EQUATION for each'// &
      ' node'), &
      foreign_word_t('BEAM SECTION|BEAM GENERAL SECTION', 'TEMPERATURE|ROTARY INERTIA', '', &
      'leave it out: temperatures are the same over a section, and there is no inertia', role_idle), &
      foreign_word_t('BEAM SECTION|BEAM GENERAL SECTION', 'POISSON|LUMPED', '', 'leave it out: sections do not'// &
      ' change as wires are stretched', &
      role_idle), &
      foreign_word_t('BEAM SECTION|BEAM GENERAL SECTION', 'ORIENTATION', '', 'the direction of the first axis is'// &
         ' the'// &
      ' second data line'), &
      foreign_word_t('BEAM SECTION|BEAM GENERAL SECTION', 'NODAL THICKNESS', '', 'a section is the same along an'// &
      ' element: give its dimensions'), &
      foreign_word_t('ELASTIC|EXPANSION|ELECTRICAL CONDUCTIVITY', 'DEPENDENCIES|MODULI|USER', '', 'leave it out:'// &
      ' material data may depend on temperature alone'), &
      foreign_word_t('AMPLITUDE', 'VALUE', '', 'leave it out where it is RELATIVE; where it is ABSOLUTE, write 1 as'// &
      ' the value of the loads, too'), &
      foreign_word_t('AMPLITUDE', 'DEFINITION|SMOOTH|FIXED INTERVAL|BEGIN', '', 'an amplitude is a table of'// &
      ' factors, linear between the points, which `litz convert THIS.inp NEW.inp` writes of PERIODIC, MODULATED,'// &
      ' DECAY, SMOOTH STEP, EQUALLY SPACED and SMOOTH', &
      role_data), &
      foreign_word_t('SURFACE BEHAVIOR', 'PENALTY|AUGMENTED LAGRANGE|DIRECT', '', 'leave it out: the law is'// &
      ' satisfied exactly'), &
      foreign_word_t('SURFACE BEHAVIOR', 'NO SEPARATION', '', 'wires that touch can always separate'), &
      foreign_word_t('FRICTION', 'SLIP TOLERANCE|LAGRANGE|TAUMAX', '', 'leave it out, or use ELASTIC SLIP'), &
      foreign_word_t('FRICTION', 'ROUGH', '', 'give a large coefficient'), &
      foreign_word_t('CONTACT PAIR', 'TYPE|SMALL SLIDING|TRACKING|MECHANICAL CONSTRAINT|EXTENSION ZONE', '', &
      'leave it out: wires touch at points, which may slide any distance'), &
      foreign_word_t('CONTACT PAIR', 'ADJUST', '', 'move the nodes, or use INTERFERENCE FIT'), &
      foreign_word_t('TEMPERATURE', 'FILE|BSTEP|BINC|ESTEP|EINC|INPUT|INTERPOLATE|MIDSIDE|DRIVING ELSETS|USER|OUTPUT', &
      '', 'give the values of the nodes in data lines'), &
      foreign_word_t('INITIAL CONDITIONS', 'FILE|STEP|INC|INPUT|INTERPOLATE|MIDSIDE|DRIVING ELSETS|USER|OUTPUT', '', &
      'give the values of the nodes in data lines'), &
      foreign_word_t('BOUNDARY', 'TYPE', '', 'leave it out where it is DISPLACEMENT; for a velocity write the'// &
      ' displacement at the end of the step, velocity times time: values ramp, or `litz convert THIS.inp NEW.inp`'// &
      ' writes it; there is no inertia for accelerations'), &
      foreign_word_t('BOUNDARY', 'USER|LOAD CASE|SUBMODEL|REGION TYPE', '', 'leave it out: values are'// &
      ' displacements, rotations, potentials and temperatures, which may follow an *AMPLITUDE'), &
      foreign_word_t('CLOAD', 'FOLLOWER', '', 'forces keep their direction and do not turn with their node'), &
      foreign_word_t('CLOAD', 'LOAD CASE|USER|SECTOR', '', 'leave it out'), &
      foreign_word_t('NODE PRINT|EL PRINT|ENERGY PRINT|CONTACT PRINT', 'FREQUENCY|FREQUENCYF|TIME POINTS|SUMMARY|'// &
      'GLOBAL|POSITION', '', 'leave it out: every increment is written, in global axes', &
      role_idle), &
      foreign_word_t('CONTACT PRINT', 'MASTER|SLAVE|NSET|TOTALS', '', 'leave it out: the line is about all contacts', &
      role_idle), &
      foreign_word_t('NODE FILE|EL FILE', 'OUTPUT|NSET|ELSET|GLOBAL|SECTION FORCES|POSITION|TIME POINTS|'// &
      'FREQUENCYF|CONTACT ELEMENTS|CONTACT ELEMENT|LAST ITERATIONS', '', 'leave it out: all fields of all nodes'// &
      ' and elements are written', &
      role_idle), &
      foreign_word_t('CONTACT FILE', 'OUTPUT|NSET|GLOBAL|TIME POINTS|FREQUENCYF|CONTACT ELEMENTS|LAST ITERATIONS|'// &
      'MASTER|SLAVE', '', 'leave it out: all contacts are written', &
      role_idle), &
      foreign_word_t('RESTART', 'READ|STEP|INCREMENT|ITERATION', '', 'continue a run with `litz run DECK.inp'// &
      ' --restart FILE.restart.h5[:STEP:INCREMENT] -o DIR`'), &
      foreign_word_t('RESTART', 'OVERLAY|NUMBER INTERVAL|TIME MARKS', '', 'leave it out', &
      role_idle), &
      foreign_word_t('CONTROLS', 'RESET|ANALYSIS', '', 'leave the keyword out')]

   !> Values of parameters and of data lines
   type(foreign_word_t), parameter :: of_values(*) = [ &
      foreign_word_t('ELEMENT', 'TYPE', 'B31OS|B31OSH|B32OS|B32OSH', 'warping of open sections is free: use B31'// &
      ' or B33'), &
      foreign_word_t('ELEMENT', 'TYPE', 'PIPE31|PIPE31H|PIPE32|PIPE32H', 'use B31 with SECTION=PIPE'), &
      foreign_word_t('ELEMENT', 'TYPE', 'U1', 'use B31; the fifth value of its section is a shear factor in'// &
      ' CalculiX,'// &
      ' the torsion constant in litz'), &
      foreign_word_t('ELEMENT', '', '+', 'a node that gives the first axis of the section is not read: its'// &
      ' direction is'// &
      ' the second line of *BEAM SECTION'), &
      foreign_word_t('ELEMENT', 'TYPE', 'B21|B21H|B22|B22H|B23|B23H', 'models are three-dimensional: use B31 or'// &
      ' B33, and prescribe 3, 4 and 5 to keep the model in its plane'), &
      foreign_word_t('ELEMENT', 'TYPE', 'T3D2|T3D3|T2D2|SPRINGA|SPRING1|SPRING2|CONN3D2', 'use a thin beam'), &
      foreign_word_t('BEAM SECTION|BEAM GENERAL SECTION', 'SECTION', 'HEX|TRAPEZOID|THICK PIPE|ARBITRARY|ELBOW'// &
      '|MESHED|NONLINEAR GENERAL', &
      'use GENERAL with A, I11, I12, I22, J, and CONTACT RADIUS where it touches'), &
      foreign_word_t('BEAM SECTION|BEAM GENERAL SECTION', 'SECTION', 'CIRC+', 'as in Abaqus it is the radius: two'// &
      ' values are diameters,'// &
      ' as in CalculiX; write half of them as the radius, or `litz convert THIS.inp NEW.inp --dialect ccx`'), &
      foreign_word_t('ELASTIC', 'TYPE', 'ENGINEERING CONSTANTS|ORTHOTROPIC|ANISOTROPIC|ORTHO|ANISO|LAMINA', &
      'give E along the wire, and Poisson''s ratio'), &
      foreign_word_t('SURFACE BEHAVIOR', 'PRESSURE-OVERCLOSURE', 'HARD|EXPONENTIAL|TABULAR|TIED|SCALE FACTOR', &
      'HERTZ needs no data, LINEAR a penalty'), &
      foreign_word_t('GAP ELECTRICAL CONDUCTANCE', 'LAW', 'CMY|ELASTIC ROUGH', &
      'it is a law per area, of the kernels for surfaces, and wires touch in spots: CLUSTER has many'), &
      foreign_word_t('NODE PRINT|NODE FILE', '', 'U1|U2|U3|UR1|UR2|UR3|RF1|RF2|RF3|RM1|RM2|RM3|CF1|CF2|CF3|CM1'// &
      '|CM2|CM3', &
      'all three components are written: use U, UR, RF, RM, CF or CM', &
      role_idle), &
      foreign_word_t('EL PRINT|EL FILE', '', 'SF1|SF2|SF3|SM1|SM2|SM3|SM', 'SF has forces and moments, all of them', &
      role_idle), &
      foreign_word_t('NODE FILE|EL FILE|EL PRINT', '', 'S|E|LE|EE|PE|PEEQ|ENER|MISES|ME|ZZS|NOE|ERR|THE|CEEQ|SDV|'// &
      'MAXS|MAXE|SINV|SP|EP|PEMAG|ALPHA|CE|SVF', &
      'beams have section forces (SF), and the extreme strains and stresses of fibres (E11, S11)', &
      role_idle), &
      foreign_word_t('EL PRINT|EL FILE', '', 'ELSE|ELKE|EVOL|EMAS|COORD|CENT|EBHE|ELEN|ELEDEN|TEMP|HFLF|HER|SPOS'// &
      '|SNEG|SMID|'// &
      'NFORC|ESF1|SJP|PHS|ECD|EMFB|EMFE|MDST|FV', 'ask for SF, SE or SK, or leave it out', &
      role_idle), &
      foreign_word_t('NODE PRINT|NODE FILE', '', 'V|A|COORD|COOR1|COOR2|COOR3|TF|VF|POR|POT|PNT|PRF|PU|MAXU|SEN'// &
      '|TT|TS|PT|PS|'// &
      'CP|MACH|MF|DTF|TURB|TTF|TSF|HCRI|KEQ|RT|TM|PHID', 'ask for U, UR, RF, RM, CF or CM, or leave it out', &
      role_idle), &
      foreign_word_t('BEAM SECTION|BEAM GENERAL SECTION', 'SECTION', 'RECTANGULAR|CIRCULAR', 'write the first four'// &
      ' letters, which CalculiX reads'), &
      foreign_word_t('DLOAD', '', 'CENTRIF|ROTA|ROTDYNF|CORIO|NEWTON', 'give each element its force per length, as'// &
      ' PX, PY and PZ'), &
      foreign_word_t('ELASTIC|EXPANSION', '', '+', 'material data depend on temperature alone'), &
      foreign_word_t('EXPANSION', 'TYPE', 'ORTHO|ANISO|SHORT FIBER', 'give the coefficient along the wire'), &
      foreign_word_t('TEMPERATURE|INITIAL CONDITIONS', '', '+', 'the temperature is the same over a cross-section'), &
      foreign_word_t('INITIAL CONDITIONS', 'TYPE', 'STRESS|STRAIN|DISPLACEMENT|VELOCITY|FIELD|SOLUTION|HARDENING|'// &
      'PLASTIC STRAIN|ROTATING VELOCITY|CONCENTRATION|REF COORDINATE|CONTACT', 'a run begins without stress and'// &
      ' current; apply initial loads in a first *STEP'), &
      foreign_word_t('FRICTION', '', '+', 'a stiffness before slip is the parameter STICK STIFFNESS')]

contains

   !> The whole table.
   pure function foreign_words() result(words)
      type(foreign_word_t), allocatable :: words(:)

      words = [of_model, of_laws, of_parameters, of_values]
   end function foreign_words

   !> What to do in litz, or an empty string when nothing is known about the word.
   pure function advice_about(keyword, parameter, value) result(advice)
      !> The keyword in any case
      character(len=*), intent(in) :: keyword
      !> Parameter of the keyword; empty: none in particular
      character(len=*), intent(in), optional :: parameter
      !> Value of the parameter, or of a data line (`+`: more values than litz takes); empty: none
      character(len=*), intent(in), optional :: value
      character(len=:), allocatable :: advice
      type(foreign_word_t) :: word

      word = row_of(keyword, parameter, value)
      advice = trim(word%advice)
   end function advice_about

   !> What the word is about, one of `role_...`; the model where nothing is known about it.
   pure integer function role_of(keyword, parameter, value) result(role)
      !> The keyword in any case
      character(len=*), intent(in) :: keyword
      !> Parameter of the keyword, and its value or that of a data line; as for `advice_about`
      character(len=*), intent(in), optional :: parameter, value
      type(foreign_word_t) :: word

      word = row_of(keyword, parameter, value)
      role = word%role
   end function role_of

   !> The row of the table that has the word; one without advice where there is none.
   pure type(foreign_word_t) function row_of(keyword, parameter, value) result(row)
      !> The keyword in any case
      character(len=*), intent(in) :: keyword
      !> Parameter of the keyword, and its value or that of a data line; as for `advice_about`
      character(len=*), intent(in), optional :: parameter, value

      row = foreign_word_t('', '', '', '')
      if (present(parameter) .or. present(value)) then
         call look_in(of_parameters)
         call look_in(of_values)
      else
         call look_in(of_model)
         call look_in(of_laws)
      end if

   contains

      pure subroutine look_in(words)
         type(foreign_word_t), intent(in) :: words(:)
         integer :: i

         do i = 1, size(words)
            if (len_trim(row%advice) > 0) return
            if (is_one_of(words(i)%keywords, keyword) .and. fits(words(i)%parameters, parameter) .and. &
               fits(words(i)%values, value)) row = words(i)
         end do
      end subroutine look_in

   end function row_of

   !> What to do about more values than a data line takes, or an empty string.
   pure function advice_about_more(keyword, choice) result(advice)
      !> The keyword in any case
      character(len=*), intent(in) :: keyword
      !> `PARAMETER=VALUE` with which the line takes that many, or empty
      character(len=*), intent(in) :: choice
      character(len=:), allocatable :: advice
      integer :: equals

      equals = index(choice, '=')
      advice = ''
      if (equals > 0) advice = advice_about(keyword, choice(:equals - 1), trim(choice(equals + 1:))//'+')
      if (len(advice) == 0) advice = advice_about(keyword, value='+')
   end function advice_about_more

   !> A keyword that litz lacks, as the table spells it; empty when it is none.
   pure function foreign_keyword(name) result(keyword)
      !> As the user wrote it
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: keyword

      keyword = ''
      call look_in(of_model)
      call look_in(of_laws)

   contains

      pure subroutine look_in(words)
         type(foreign_word_t), intent(in) :: words(:)
         character(len=word_length), allocatable :: list(:)
         integer :: i, j

         do i = 1, size(words)
            if (.not. is_one_of(words(i)%keywords, name)) cycle
            list = words_of(words(i)%keywords)
            do j = 1, size(list)
               if (squeezed(trim(list(j))) == squeezed(name)) keyword = trim(list(j))
            end do
         end do
      end subroutine look_in

   end function foreign_keyword

   !> Is the word in the list, or are both empty?
   pure logical function fits(list, word)
      !> Words with bars between them
      character(len=*), intent(in) :: list
      !> A word in any case; empty or absent: none
      character(len=*), intent(in), optional :: word

      if (.not. present(word)) then
         fits = len_trim(list) == 0
      else if (len_trim(word) == 0) then
         fits = len_trim(list) == 0
      else
         fits = is_one_of(list, word)
      end if
   end function fits

   !> Is the word in a list, however it is written?
   pure logical function is_one_of(list, word)
      !> Words with bars between them
      character(len=*), intent(in) :: list
      !> A word in any case, with or without blanks
      character(len=*), intent(in) :: word

      is_one_of = index('|'//squeezed(list)//'|', '|'//squeezed(word)//'|') > 0
   end function is_one_of

end module litz_foreign_words
