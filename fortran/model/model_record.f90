!> What a model was, as lines of text: every definition that decides the results, so that a run can go on only with the
!> model that it began with.
!>
!> `model_record` is the one place that walks a model for this. A new field of the types of litz_model gets a line
!> there; `tests/system/test_changed_models.py` fails for one that has none, and is not listed as free to change.
!>
!> Free to change are names of sets, output, controls, solvers, and steps that have not begun: what no definition uses
!> is not in the record. Lists of numbers are in it as their checksums.
module litz_model_record
   use litz_kinds, only: dp, int64
   use litz_checksum, only: checksum
   use litz_critical_law, only: superconductor_t, critical_table
   use litz_element_loads, only: load_label, n_load_kinds
   use litz_fields, only: fields, n_fields, n_slots, field_displacement, field_temperature, field_of_dof, slot_of_dof
   use litz_law_words, only: law_words_t
   use litz_model, only: model_t, interaction_t, step_t, nodal_value_t, rigid_body_t, n_nodes_of_deck, &
      radius_course
   use litz_record_lines, only: record_t, kind_real, kind_sum, sum_text, bits, checksum_of_text
   use litz_text, only: to_text
   implicit none
   private
   public :: model_record, kind_real, kind_sum

contains

   !> All lines of a model.
   function model_record(model) result(text)
      type(model_t), intent(in) :: model
      character(len=:), allocatable :: text
      type(record_t) :: record
      integer :: i

      call record_units(model, record)
      call record_mesh(model, record)
      call record_initial_values(model, record)
      call record_sections(model, record)
      do i = 1, size(model%rigid_bodies)
         call record_rigid_body(model, model%rigid_bodies(i), record)
      end do
      call record_equations(model, record)
      call record_local_axes(model, record)
      do i = 1, size(model%contact_pairs)
         call record_contact_pair(model, i, record)
      end do
      do i = 1, size(model%surface_pairs)
         call record_surface_pair(model, i, record)
      end do
      do i = 1, size(model%steps)
         record%step = i
         call record_step(model, model%steps(i), record)
      end do
      text = record%lines%text()
   end function model_record

   pure subroutine record_units(model, record)
      type(model_t), intent(in) :: model
      type(record_t), intent(inout) :: record

      call record%begin('the units (*UNITS)')
      call record%value('length', trim(model%units%length))
      call record%value('force', trim(model%units%force))
      call record%value('time', trim(model%units%time))
      call record%value('current', trim(model%units%current))
      call record%value('voltage', trim(model%units%voltage))
      if (.not. model%has_field(field_temperature)) return
      call record%value('temperature', trim(model%units%temperature))
      call record%value('ABSOLUTE ZERO', model%absolute_zero)
      call record%value('STEFAN BOLTZMANN', model%stefan_boltzmann)
   end subroutine record_units

   !> Where nothing is given all of them are zero.
   pure subroutine record_initial_values(model, record)
      type(model_t), intent(in) :: model
      type(record_t), intent(inout) :: record
      real(dp) :: value(n_slots, model%n_nodes)
      integer :: i

      if (size(model%initial) == 0) return
      value = 0
      do i = 1, size(model%initial)
         value(slot_of_dof(model%initial(i)%dof), model%initial(i)%node) = model%initial(i)%value
      end do
      call record%begin('the *INITIAL CONDITIONS')
      call record%list('values', value)
   end subroutine record_initial_values

   pure subroutine record_mesh(model, record)
      type(model_t), intent(in) :: model
      type(record_t), intent(inout) :: record

      call record%begin('the nodes')
      call record%value('number of them', to_text(n_nodes_of_deck(model)))
      call record%list('numbers', reshape(model%node_id, [1, model%n_nodes]))
      call record%list('positions', model%x)
      call record%begin('the elements')
      call record%value('number of them', to_text(model%n_elements))
      call record%list('numbers', reshape(model%element_id, [1, model%n_elements]))
      call record%list('nodes', model%connectivity)
      call record%list('types', reshape(model%element_type, [1, model%n_elements]))
   end subroutine record_mesh

   !> Sections that have elements, and their materials.
   pure subroutine record_sections(model, record)
      type(model_t), intent(in) :: model
      type(record_t), intent(inout) :: record
      !> Elements of each section: how many, and a checksum of them
      integer :: n_members(size(model%sections))
      integer(int64) :: members(size(model%sections))
      logical :: used(size(model%materials))
      integer :: e, s, m

      n_members = 0
      members = 0
      used = .false.
      do e = 1, model%n_elements
         s = model%element_section(e)
         n_members(s) = n_members(s) + 1
         members(s) = checksum(reshape([members(s), int(e, int64)], [2, 1]))
      end do
      do s = 1, size(model%sections)
         if (n_members(s) == 0) cycle
         associate (this => model%sections(s))
            used(this%material) = .true.
            call record%begin('the section of '//this%element_set)
            call record%value('number of its elements', to_text(n_members(s)))
            call record%add('elements', kind_sum, sum_text(members(s)))
            call record%value('material', model%materials(this%material)%name)
            call record%value('contact radius', this%contact_radius)
            call record%value('area', this%area)
            call record%value('second moment of area about the first axis', this%i2)
            call record%value('second moment of area about the second axis', this%i3)
            call record%value('torsion constant', this%j)
            call record%value('shear stiffness along the first axis', this%ga2)
            call record%value('shear stiffness along the second axis', this%ga3)
            if (allocated(model%materials(this%material)%elastic_table)) call record%value( &
               'how the shear stiffness follows from the elasticity', this%shear)
            call record%list('shear stiffness over G A', reshape(this%shear_factor, [2, 1]))
            if (allocated(this%corners)) call record%list('corners', this%corners)
            call record%value('angle of the principal axes', this%turn)
            call record%list('shear centre', reshape(this%shear_centre, [2, 1]))
            call record%list('centroid', reshape(this%centroid, [2, 1]))
            if (abs(this%stiffness - 1) > 0) call record%value('STIFFNESS', this%stiffness)
            call record%value('outer radius', this%outer_radius)
            call record%list('direction of the first axis', reshape(this%n1, [3, 1]))
            call record%value('CONDUCTION', trim(merge('CURRENT LENGTH  ', 'REFERENCE LENGTH', this%current_length)))
         end associate
      end do
      do m = 1, size(model%materials)
         if (.not. used(m)) cycle
         associate (this => model%materials(m))
            call record%begin('material '//this%name)
            call record%value('Young''s modulus', this%young)
            call record%value('Poisson''s ratio', this%poisson)
            call record%value('electrical conductivity', this%conductivity)
            if (allocated(this%resistivity)) then
               if (size(this%resistivity, 2) > 1) call record%list('table of *ELECTRICAL CONDUCTIVITY', &
                  this%resistivity)
            end if
            if (allocated(this%superconductor)) call record_superconductor(record, this%superconductor)
            if (allocated(this%heat_conductivity)) then
               call record%list('*CONDUCTIVITY', this%heat_conductivity)
               call record%value('*JOULE HEAT FRACTION', this%joule_fraction)
            end if
            if (this%density > 0) call record%value('*DENSITY', this%density)
            if (allocated(this%specific_heat)) call record%list('*SPECIFIC HEAT', this%specific_heat)
            if (allocated(this%latent_heat)) call record%list('*LATENT HEAT', this%latent_heat)
            if (allocated(this%elastic_table)) call record%list('elasticity over temperature', this%elastic_table)
            if (.not. allocated(this%expansion_table)) cycle
            call record%list('expansion over temperature', this%expansion_table)
            call record%value('ZERO of *EXPANSION', this%expansion_zero)
         end associate
      end do
   end subroutine record_sections

   !> What *SUPERCONDUCTOR says.
   pure subroutine record_superconductor(record, this)
      type(record_t), intent(inout) :: record
      type(superconductor_t), intent(in) :: this

      call record%value('LAW of *SUPERCONDUCTOR', this%law)
      call record%list('N, EC, part of the cross-section, FIELD and STRAIN of *SUPERCONDUCTOR', reshape([ &
         this%exponent, this%criterion, this%fraction, this%field, this%strain], [1, 5]))
      if (this%law == critical_table) then
         call record%list('temperatures of *SUPERCONDUCTOR', reshape(this%temperature, [1, size(this%temperature)]))
         call record%list('flux densities of *SUPERCONDUCTOR', reshape(this%flux_density, &
            [1, size(this%flux_density)]))
         call record%list('critical current densities', this%density)
      else
         call record%list('parameters of *SUPERCONDUCTOR', reshape(this%parameters, [1, size(this%parameters)]))
      end if
   end subroutine record_superconductor

   pure subroutine record_rigid_body(model, body, record)
      type(model_t), intent(in) :: model
      type(rigid_body_t), intent(in) :: body
      type(record_t), intent(inout) :: record

      call record%begin('the rigid body of node '//to_text(model%node_id(body%reference_node)))
      call record%value('number of tied nodes', to_text(size(body%tied)))
      call record%list('tied nodes', reshape(body%tied, [1, size(body%tied)]))
      call record%value('number of pinned nodes', to_text(size(body%pinned)))
      call record%list('pinned nodes', reshape(body%pinned, [1, size(body%pinned)]))
   end subroutine record_rigid_body

   !> All equations, in their order.
   pure subroutine record_equations(model, record)
      type(model_t), intent(in) :: model
      type(record_t), intent(inout) :: record
      integer(int64) :: sums(1, size(model%equations))
      integer :: i

      if (size(sums) == 0) return
      do i = 1, size(model%equations)
         associate (this => model%equations(i))
            sums(1, i) = checksum(reshape([int(this%node, int64), int(this%dof, int64), bits(this%coefficient)], &
               [3*size(this%node), 1]))
         end associate
      end do
      call record%begin('the equations (*EQUATION)')
      call record%value('number of them', to_text(size(model%equations)))
      call record%add('terms', kind_sum, sum_text(checksum(sums)))
   end subroutine record_equations

   !> All local axes, in the order of the nodes that stand for motions along them.
   pure subroutine record_local_axes(model, record)
      type(model_t), intent(in) :: model
      type(record_t), intent(inout) :: record
      integer :: i

      if (size(model%local_axes) == 0) return
      call record%begin('the local axes (*TRANSFORM)')
      call record%value('number of nodes with supports, loads or equations along them', &
         to_text(size(model%local_axes)))
      call record%list('nodes', reshape(model%node_id(model%local_axes%node), [1, size(model%local_axes)]))
      call record%list('axes', reshape([(model%local_axes(i)%axes, i=1, size(model%local_axes))], &
         [9, size(model%local_axes)]))
   end subroutine record_local_axes

   !> A contact pair and the laws of its interaction.
   subroutine record_contact_pair(model, i, record)
      type(model_t), intent(in) :: model
      !> Number of the contact pair in the deck
      integer, intent(in) :: i
      type(record_t), intent(inout) :: record

      associate (pair => model%contact_pairs(i))
         call record%begin('*CONTACT PAIR '//to_text(i)//' of the deck')
         call record_members('first set', model%element_sets(pair%set_bar)%members, record)
         call record_members('second set', model%element_sets(pair%set)%members, record)
         call record%value('INTERFERENCE FIT', yes_or_no(pair%interference_fit))
         call record_interaction(model%interactions(pair%interaction), '*CONTACT PAIR '//to_text(i), record)
      end associate
   end subroutine record_contact_pair

   !> A pair of wires and a rigid surface, the surface, and the laws.
   subroutine record_surface_pair(model, i, record)
      type(model_t), intent(in) :: model
      !> Number of the pair among those with surfaces
      integer, intent(in) :: i
      type(record_t), intent(inout) :: record
      character(len=:), allocatable :: which

      which = '*CONTACT PAIR '//to_text(i)//' with a rigid surface'
      associate (pair => model%surface_pairs(i))
         call record%begin(which//' of the deck')
         call record_members('set', model%element_sets(pair%set)%members, record)
         associate (this => model%surfaces(pair%surface))
            call record%value('rigid surface', this%name)
            call record%begin('rigid surface '//this%name)
            call record%value('TYPE', this%shape)
            call record%list('point', reshape(this%point, [3, 1]))
            call record%list('direction', reshape(this%direction, [3, 1]))
            call record%list('radius over time', radius_course(model, pair%surface))
            call record%value('REF NODE', this%node)
         end associate
         call record_interaction(model%interactions(pair%interaction), which, record)
      end associate
   end subroutine record_surface_pair

   subroutine record_interaction(this, pair, record)
      type(interaction_t), intent(in) :: this
      !> The *CONTACT PAIR that refers to it
      character(len=*), intent(in) :: pair
      type(record_t), intent(inout) :: record

      call record%value('interaction', this%name)
      call record%begin('interaction '//this%name//' of '//pair)
      call record_law('normal law (*SURFACE BEHAVIOR)', this%normal)
      if (this%normal%yields()) then
         call record%value('YIELD', this%normal%yield_stress)
         call record%value('HARDNESS', this%normal%hardness)
      end if
      call record%value('PENETRATION', trim(merge('UNLIMITED', 'LIMITED  ', this%unlimited_penetration)))
      call record%value('coefficient of friction', this%friction)
      call record%value('stiffness of sticking (*FRICTION)', this%stick_law)
      call record%value('elastic slip or stick stiffness', this%stick_value)
      call record_law('law of the spot (*GAP ELECTRICAL CONDUCTANCE)', this%spot)
      call record_law('law of the heat (*GAP CONDUCTANCE)', this%heat)
      call record%value('LORENZ', this%heat%lorenz)
      call record%value('FILM of the heat', this%heat%film)
      if (this%heat%has_softening) call record%value('TSOFT', this%heat%softening)
      if (this%heat%has_melting) call record%value('TMELT', this%heat%melting)
      call record%value('MELTING', trim(merge('WARN', 'END ', this%heat%may_melt)))
      call record%value('heat of friction (*GAP HEAT GENERATION)', this%heat%friction_fraction)
      call record%value('heat of friction on surfaces (*GAP HEAT GENERATION)', this%heat%surface_share)
      call record%value('PER of *GAP CONDUCTANCE', trim(merge('LENGTH', 'SPOT  ', this%heat%is_per_length)))
      call record%value('AXIS', this%axis)
      call record%value('VOLTAGE', trim(merge('CORRECTED', 'LINEAR   ', this%voltage_correction)))
      call record%value('MUTUAL RESISTANCE', trim(merge('YES', 'NO ', this%mutual_resistance)))
      call record%value('SUPERTEMPERATURE', trim(merge('YES', 'NO ', this%supertemperature)))
      call record%value('PER', trim(merge('LENGTH', 'SPOT  ', this%spot%is_per_length)))
      call record%value('SPOT', trim(merge('LARGEST FORCE', 'PRESENT FORCE', this%spot_memory)))

   contains

      !> A law and its numbers.
      subroutine record_law(what, law)
         !> Kind of law and its keyword
         character(len=*), intent(in) :: what
         class(law_words_t), intent(in) :: law
         integer :: i

         call record%value(what, trim(law%name))
         if (allocated(law%table)) call record%list('table of the '//what, law%table)
         if (law%has_table) return
         do i = 1, law%n_numbers()
            call record%value(trim(law%fields(i)%name)//' of the '//what, law%data(i))
         end do
      end subroutine record_law

   end subroutine record_interaction

   !> How many elements a set has, and which.
   subroutine record_members(what, members, record)
      !> Which of the two sets of the pair
      character(len=*), intent(in) :: what
      !> Indices of its elements (n)
      integer, intent(in) :: members(:)
      type(record_t), intent(inout) :: record

      call record%value('number of elements of the '//what, to_text(size(members)))
      call record%list('elements of the '//what, reshape(members, [1, size(members)]))
   end subroutine record_members

   !> What a step prescribes, and the amplitudes that it uses.
   subroutine record_step(model, step, record)
      type(model_t), intent(in) :: model
      type(step_t), intent(in) :: step
      type(record_t), intent(inout) :: record
      logical :: used(size(model%amplitudes))
      integer :: i

      used = .false.
      call record%begin('step '//to_text(record%step))
      if (step%solves(field_temperature)) call record%value('procedure', trim(merge( &
         '*COUPLED TEMPERATURE-DISPLACEMENT', '*COUPLED THERMAL-ELECTRICAL      ', step%solves(field_displacement))))
      if (step%transient) call record%value('heat', 'stored')
      call record%value('its time (*STATIC)', step%total)
      call record_values('*BOUNDARY', step%boundary)
      call record_values('*TEMPERATURE', step%predefined)
      if (step%solves(field_temperature)) then
         call record%list('*DFLUX', reshape([step%heat%source, step%heat%source_before], [model%n_elements, 2]))
         call record%list('*FILM', reshape([step%heat%film, step%heat%sink], [model%n_elements, 2]))
         call record%list('*RADIATE', reshape([step%heat%emissivity, step%heat%surroundings], [model%n_elements, 2]))
         call record_amplitudes('*DFLUX', [step%heat%source_amplitude, step%heat%before_amplitude])
         call record_amplitudes('*FILM', [step%heat%sink_amplitude, step%heat%film_amplitude])
         call record_amplitudes('*RADIATE', step%heat%surroundings_amplitude)
      end if
      do i = 1, n_load_kinds
         call record_element_loads(i)
      end do
      do i = 1, n_fields
         call record_values('*'//trim(fields(i)%load_keyword), pack(step%load, field_of_dof(step%load%dof) == i))
      end do
      do i = 1, size(model%amplitudes)
         if (.not. used(i)) cycle
         associate (this => model%amplitudes(i))
            call record%begin('amplitude '//this%name//' of step '//to_text(record%step))
            call record%value('TIME', trim(merge('TOTAL TIME', 'STEP TIME ', this%total_time)))
            call record%list('times', reshape(this%time, [1, size(this%time)]))
            call record%list('factors', reshape(this%factor, [1, size(this%factor)]))
         end associate
      end do

   contains

      !> A checksum for each degree of freedom, node by node: a deck may name them in another order.
      subroutine record_values(keyword, items)
         !> The keyword that gives such values
         character(len=*), intent(in) :: keyword
         type(nodal_value_t), intent(in) :: items(:)
         !> Checksums of the values at each node; 0: there is none
         integer(int64) :: at_node(1, model%n_nodes)
         integer :: dof, j

         do dof = 1, maxval([0, items%dof])
            if (.not. any(items%dof == dof)) cycle
            at_node = 0
            do j = 1, size(items)
               associate (item => items(j))
                  if (item%dof /= dof) cycle
                  at_node(1, item%node) = checksum(reshape([at_node(1, item%node), bits(item%value), &
                     amplitude_sum(item%amplitude), merge(1_int64, 0_int64, item%stays)], [4, 1]))
                  if (item%amplitude > 0) used(item%amplitude) = .true.
               end associate
            end do
            call record%add(keyword//' of degree of freedom '//to_text(dof), kind_sum, sum_text(checksum(at_node)))
         end do
      end subroutine record_values

      !> A checksum for each kind of load on elements, element by element.
      subroutine record_element_loads(kind)
         !> One of `load_...`
         integer, intent(in) :: kind
         !> Checksums of the load on each element; 0: there is none
         integer(int64) :: at_element(1, model%n_elements)
         integer :: j

         at_element = 0
         do j = 1, size(step%element_loads)
            associate (load => step%element_loads(j))
               if (load%kind /= kind) cycle
               at_element(1, load%element) = checksum(reshape([bits(load%value), bits(load%before), &
                  amplitude_sum(load%amplitude), amplitude_sum(load%before_amplitude)], [26, 1]))
               used(pack([load%amplitude, load%before_amplitude], [load%amplitude, load%before_amplitude] > 0)) = .true.
            end associate
         end do
         if (any(at_element /= 0)) call record%add('loads '//load_label(kind)//' on elements', kind_sum, &
            sum_text(checksum(at_element)))
      end subroutine record_element_loads

      !> What values on the length of elements follow.
      subroutine record_amplitudes(keyword, amplitude)
         !> The keyword that gives such values
         character(len=*), intent(in) :: keyword
         !> Indices of amplitudes, element by element for one value, then for the next; 0: none (n)
         integer, intent(in) :: amplitude(:)
         integer :: j

         if (all(amplitude == 0)) return
         used(pack(amplitude, amplitude > 0)) = .true.
         call record%add('amplitudes of '//keyword, kind_sum, &
            sum_text(checksum(reshape([(amplitude_sum(amplitude(j)), j=1, size(amplitude))], [1, size(amplitude)]))))
      end subroutine record_amplitudes

      !> Of the amplitude's name; its points have lines of their own.
      pure integer(int64) function amplitude_sum(amplitude) result(total)
         !> Index of the amplitude; 0: none
         integer, intent(in) :: amplitude

         total = 0
         if (amplitude > 0) total = checksum_of_text(model%amplitudes(amplitude)%name)
      end function amplitude_sum

   end subroutine record_step

   pure function yes_or_no(yes) result(word)
      !> The answer
      logical, intent(in) :: yes
      character(len=:), allocatable :: word

      word = trim(merge('yes', 'no ', yes))
   end function yes_or_no

end module litz_model_record
