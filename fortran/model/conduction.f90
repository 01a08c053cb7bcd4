!> What conducts in a model: elements by their materials, contacts with rigid surfaces by their laws.
module litz_conduction
   use litz_fields, only: field_potential, field_temperature
   use litz_model, only: model_t, interaction_t
   implicit none
   private
   public :: conducts, passes_to_surface, surface_conducts, surface_obstacle

contains

   !> Elements whose section or material is in error count as conductors, so that no second error follows.
   pure logical function conducts(model, element, field)
      type(model_t), intent(in) :: model
      !> Index of the element, and one of litz_fields
      integer, intent(in) :: element, field

      conducts = .true.
      if (all(field /= [field_potential, field_temperature]) .or. model%element_section(element) == 0) return
      associate (section => model%sections(model%element_section(element)))
         if (section%material == 0) return
         if (field == field_potential) conducts = model%materials(section%material)%conductivity > 0
         if (field == field_temperature) conducts = allocated(model%materials(section%material)%heat_conductivity)
      end associate
   end function conducts

   !> The flux of a field passes from wires to the surface of a pair.
   pure logical function passes_to_surface(model, pair, field) result(passes)
      type(model_t), intent(in) :: model
      !> Index of the pair, and one of litz_fields
      integer, intent(in) :: pair, field

      passes = .false.
      if (model%surface_pairs(pair)%interaction == 0 .or. model%surface_pairs(pair)%surface == 0) return
      if (model%surfaces(model%surface_pairs(pair)%surface)%node == 0) return
      associate (law => model%interactions(model%surface_pairs(pair)%interaction))
         if (field == field_potential) passes = law%spot%exists()
         if (field == field_temperature) passes = law%heat%exists()
      end associate
   end function passes_to_surface

   !> A rigid surface has a value of a field, at its reference node.
   pure logical function surface_conducts(model, surface, field)
      type(model_t), intent(in) :: model
      !> Index of the surface, and one of litz_fields
      integer, intent(in) :: surface, field
      integer :: pair, i

      surface_conducts = .true.
      do pair = 1, size(model%surface_pairs)
         if (model%surface_pairs(pair)%surface /= surface .or. .not. passes_to_surface(model, pair, field)) cycle
         associate (members => model%element_sets(model%surface_pairs(pair)%set)%members)
            do i = 1, size(members)
               if (conducts(model, members(i), field)) return
            end do
         end associate
      end do
      surface_conducts = .false.
   end function surface_conducts

   !> What of an interaction has no meaning on a rigid surface, and what is possible instead; empty: nothing.
   pure function surface_obstacle(law) result(words)
      type(interaction_t), intent(in) :: law
      character(len=:), allocatable :: words
      character(len=*), parameter :: allowed = '; possible are LAW=CONSTANT and LAW=TABLE with PER=LENGTH'

      words = ''
      if (law%spot%exists() .and. .not. law%spot%is_per_length) then
         words = '*GAP ELECTRICAL CONDUCTANCE, LAW='//trim(law%spot%name)//', a law of spots between wires'//allowed
      else if (law%spot_memory) then
         words = 'SPOT=LARGEST FORCE of *GAP ELECTRICAL CONDUCTANCE, which is for spots between wires'// &
            '; possible is SPOT=PRESENT FORCE'
      else if (law%mutual_resistance) then
         words = 'MUTUAL RESISTANCE=YES of *GAP ELECTRICAL CONDUCTANCE, which is for spots between wires'// &
            '; possible is NO'
      else if (law%heat%exists() .and. .not. law%heat%is_per_length) then
         words = '*GAP CONDUCTANCE, LAW='//trim(law%heat%name)//', a law of spots between wires'//allowed
      else if (law%heat%has_softening .or. law%heat%has_melting) then
         words = 'TSOFT or TMELT of *GAP CONDUCTANCE, which are of spots between wires; leave them out'
      end if
   end function surface_obstacle

end module litz_conduction
