!> Properties over temperature that wires cannot have under the laws by which they touch.
module litz_check_over_temperature
   use litz_deck, only: token_t
   use litz_model, only: model_t
   use litz_reader, only: reader_t, fail_at
   use litz_spot_law, only: spot_law_t
   use litz_text, only: to_text
   implicit none
   private
   public :: check_over_temperature

contains

   !> The law of wires that yield knows the dent of a force at one elasticity: a dent keeps its shape as metal softens.
   !> As a metal gets warmer, its mean free path falls as its conductivity does: one that is given belongs to one
   !> conductivity.
   subroutine check_over_temperature(self, model, interaction, element, token, ok)
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
         if (law%normal%yields() .and. allocated(material%elastic_table)) then
            call refuse('an elasticity over temperature, which YIELD of surface interaction '//law%name// &
               ' does not follow: give *ELASTIC one line, or leave YIELD out')
         else if (has_free_path(law%spot) .and. allocated(material%resistivity)) then
            if (size(material%resistivity, 2) > 1) call refuse('a conductivity over temperature, with which the'// &
               ' MEAN FREE PATH of surface interaction '//law%name//' would change: give rho_l, which does not')
         end if
      end associate

   contains

      subroutine refuse(what)
         !> What its material has, and what to do
         character(len=*), intent(in) :: what

         ok = .false.
         call fail_at(self, token, 'element '//to_text(model%element_id(element))//' can touch others here, and'// &
            ' its material '//model%materials(model%sections(model%element_section(element))%material)%name// &
            ' has '//what)
      end subroutine refuse

   end subroutine check_over_temperature

   !> It is given, and not its product with the resistivity.
   pure logical function has_free_path(law)
      type(spot_law_t), intent(in) :: law

      has_free_path = .false.
      if (law%free_path_number > 0) has_free_path = law%data(law%free_path_number) > 0
   end function has_free_path

end module litz_check_over_temperature
