!> What wires that yield cannot have.
module litz_check_yielding
   use litz_deck, only: token_t
   use litz_model, only: model_t
   use litz_reader, only: reader_t, fail_at
   use litz_text, only: to_text
   implicit none
   private
   public :: check_elasticity

contains

   !> The law of wires that yield knows the dent of a force at one elasticity: a dent keeps its shape as metal softens.
   subroutine check_elasticity(self, model, interaction, element, token, ok)
      type(reader_t), intent(inout) :: self
      type(model_t), intent(in) :: model
      !> Index into the interactions, 0 after an error; and number of the element in the model
      integer, intent(in) :: interaction, element
      !> The set that it is in
      type(token_t), intent(in) :: token
      !> The element may touch others here
      logical, intent(out) :: ok

      ok = .true.
      if (interaction == 0 .or. model%sections(model%element_section(element))%material == 0) return
      associate (law => model%interactions(interaction), &
         material => model%materials(model%sections(model%element_section(element))%material))
         ok = .not. (law%normal%yields() .and. allocated(material%elastic_table))
         if (.not. ok) call fail_at(self, token, 'element '//to_text(model%element_id(element))//' can touch others'// &
            ' here, and its material '//material%name//' has an elasticity over temperature, which YIELD of surface'// &
            ' interaction '//law%name//' does not follow: give *ELASTIC one line, or leave YIELD out')
      end associate
   end subroutine check_elasticity

end module litz_check_yielding
