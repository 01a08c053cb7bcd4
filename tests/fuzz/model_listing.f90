!> A model as lines of text that another reader of the deck can produce and compare. Numbers stand there with all
!> their bits.
module litz_model_listing
   use litz_kinds, only: dp, int64
   use litz_model, only: model_t, step_t, named_set_t, nodal_value_t, amplitude_t, section_t, interaction_t, &
      n_nodes_of_deck, solved_by_heat
   use litz_text, only: to_text
   implicit none
   private
   public :: print_model

   interface show
      module procedure show_integers, show_reals
   end interface show

contains

   subroutine print_model(unit, model)
      integer, intent(in) :: unit
      type(model_t), intent(in) :: model
      integer :: i

      write (unit, '(a)') 'absolute zero'//show([model%absolute_zero, model%stefan_boltzmann])
      do i = 1, n_nodes_of_deck(model)
         write (unit, '(a)') 'node'//show([model%node_id(i)])//show(model%x(:, i))
      end do
      do i = 1, model%n_elements
         write (unit, '(a)') 'element'//show([model%element_id(i), model%element_type(i), &
            model%node_id(model%connectivity(:, i)), model%element_section(i)])
      end do
      call print_sets(unit, 'nset', model%node_sets, model%node_id)
      call print_sets(unit, 'elset', model%element_sets, model%element_id)
      do i = 1, size(model%materials)
         associate (this => model%materials(i))
            write (unit, '(a)') 'material '//this%name//show([this%young, this%poisson, this%conductivity, &
               this%joule_fraction])//show_table(this%resistivity)//show_table(this%heat_conductivity)
         end associate
      end do
      do i = 1, size(model%sections)
         call print_section(unit, model%sections(i))
      end do
      do i = 1, size(model%amplitudes)
         call print_amplitude(unit, model%amplitudes(i))
      end do
      do i = 1, size(model%interactions)
         call print_interaction(unit, model%interactions(i))
      end do
      do i = 1, size(model%contact_pairs)
         associate (this => model%contact_pairs(i))
            write (unit, '(a)') 'pair'//show([this%interaction, this%set_bar, this%set, &
               merge(1, 0, this%interference_fit)])
         end associate
      end do
      call print_values(unit, 'initial', model, model%initial)
      do i = 1, size(model%steps)
         call print_step(unit, model, model%steps(i))
      end do
   end subroutine print_model

   subroutine print_sets(unit, what, sets, ids)
      integer, intent(in) :: unit
      character(len=*), intent(in) :: what
      type(named_set_t), intent(in) :: sets(:)
      !> The user's numbers by index
      integer, intent(in) :: ids(:)
      integer :: i

      do i = 1, size(sets)
         write (unit, '(a)') what//' '//sets(i)%name//show(ids(sets(i)%members))
      end do
   end subroutine print_sets

   subroutine print_section(unit, section)
      integer, intent(in) :: unit
      type(section_t), intent(in) :: section

      write (unit, '(a, 4(1x, es17.9e3))') 'section '//section%element_set//show([section%material, &
         merge(1, 0, section%current_length)])//show([section%contact_radius])//show(section%n1), &
         section%area, section%i2, section%i3, section%j
   end subroutine print_section

   subroutine print_amplitude(unit, amplitude)
      integer, intent(in) :: unit
      type(amplitude_t), intent(in) :: amplitude

      write (unit, '(a)') 'amplitude '//amplitude%name//show([merge(1, 0, amplitude%total_time)])// &
         show(amplitude%time)//show(amplitude%factor)
   end subroutine print_amplitude

   subroutine print_interaction(unit, interaction)
      integer, intent(in) :: unit
      type(interaction_t), intent(in) :: interaction
      character(len=:), allocatable :: table

      associate (normal => interaction%normal, spot => interaction%spot)
         table = ''
         if (allocated(spot%table)) table = show(spot%table(1, :))//show(spot%table(2, :))
         write (unit, '(a)') 'interaction '//interaction%name//show([normal%number, spot%number, &
            interaction%axis, merge(1, 0, interaction%unlimited_penetration), &
            merge(1, 0, interaction%voltage_correction), interaction%stick_law, &
            merge(1, 0, interaction%spot_memory), merge(1, 0, interaction%mutual_resistance)])// &
            show([normal%data(1), spot%data(1), interaction%friction, interaction%stick_value, &
            normal%yield_stress, normal%hardness])//table
      end associate
   end subroutine print_interaction

   subroutine print_step(unit, model, step)
      integer, intent(in) :: unit
      type(model_t), intent(in) :: model
      type(step_t), intent(in) :: step
      integer :: i

      write (unit, '(a)') 'step'//show([step%max_increments, step%output_frequency, step%solver, step%coupling, &
         merge(1, 0, step%direct), merge(1, 0, all(step%solves .eqv. solved_by_heat)) + &
         merge(2, 0, all(step%solves))])// &
         show([step%first, step%total, step%largest])
      associate (c => step%controls)
         write (unit, '(a)') 'controls'//show([c%i_c, c%i_l, c%i_g, c%i_a])// &
            show([c%r_n, c%c_n, c%d_f, c%d_b, c%d_d, c%rotation_cap])
      end associate
      call print_values(unit, 'boundary', model, step%boundary)
      call print_values(unit, 'load', model, step%load)
      call print_values(unit, 'given', model, step%predefined)
      do i = 1, size(step%heat)
         associate (this => step%heat(i))
            if (.not. max(abs(this%source_before), abs(this%source), this%film, this%emissivity) > 0) cycle
            write (unit, '(a)') 'heat'//show([model%element_id(i)])//show([this%source_before, this%source, &
               merge([this%sink, this%film], [0.0_dp, 0.0_dp], this%film > 0), &
               merge([this%surroundings, this%emissivity], [0.0_dp, 0.0_dp], this%emissivity > 0)])// &
               show([this%source_amplitude, this%before_amplitude, &
               merge([this%sink_amplitude, this%film_amplitude], 0, this%film > 0), &
               merge(this%surroundings_amplitude, 0, this%emissivity > 0)])
         end associate
      end do
      do i = 1, size(step%element_loads)
         associate (this => step%element_loads(i))
            write (unit, '(a, 24(1x, es17.9e3))') 'force'//show([model%element_id(this%element), this%kind, &
               this%amplitude, this%before_amplitude]), this%value, this%before
         end associate
      end do
      do i = 1, size(step%requests)
         associate (this => step%requests(i))
            write (unit, '(a, *(1x, a))') 'request'//show([this%kind, this%set, this%set_2, &
               merge(1, 0, this%totals)]), this%quantities
         end associate
      end do
   end subroutine print_step

   subroutine print_values(unit, what, model, values)
      integer, intent(in) :: unit
      character(len=*), intent(in) :: what
      type(model_t), intent(in) :: model
      type(nodal_value_t), intent(in) :: values(:)
      integer :: i

      do i = 1, size(values)
         write (unit, '(a)') what//show([model%node_id(values(i)%node), values(i)%dof, values(i)%amplitude])// &
            show([values(i)%value])
      end do
   end subroutine print_values

   !> A property over temperature; empty: there is none.
   function show_table(table) result(text)
      real(dp), allocatable, intent(in) :: table(:, :)
      character(len=:), allocatable :: text

      text = ' table'
      if (allocated(table)) text = text//show(table(1, :))//show(table(2, :))
   end function show_table

   function show_integers(numbers) result(text)
      integer, intent(in) :: numbers(:)
      character(len=:), allocatable :: text
      integer :: i

      text = ''
      do i = 1, size(numbers)
         text = text//' '//to_text(numbers(i))
      end do
   end function show_integers

   !> The 64 bits of each number in hexadecimal digits.
   function show_reals(numbers) result(text)
      real(dp), intent(in) :: numbers(:)
      character(len=:), allocatable :: text
      character(len=16) :: digits
      integer :: i

      text = ''
      do i = 1, size(numbers)
         write (digits, '(z16.16)') transfer(numbers(i), 0_int64)
         text = text//' '//digits
      end do
   end function show_reals

end module litz_model_listing
